//! Ends: the curves that rounded patches share.
//!
//! An end of a strip is a step of a ring, from one sector over the edge to the next. Its curve is
//! one side of the ring's fill as well, so strip and fill have the same points there. Where a ring
//! has but two sectors, the strips on both sides of it share one curve.
//!
//! Near: what a point on a rounded patch comes from.
//!
//! It lies on no face of the source. What has to follow there, such as skin weights, is blended from
//! what its corners come from, and from the old corner as far as it is bent towards that. Three
//! source vertices are all that provenance has: the old corner and the two that weigh most, with the
//! rest on the old corner.

use glam::DVec3;

use super::Given;
use super::arc::{Arc, Place};
use crate::edges::HardEdge;
use crate::ids::{Corner, Edge, Few, IdVec, Ring, Sector, Vertex};
use crate::math::unit;
use crate::report::Blend;

/// `#hard edges`: how many segments it has at the start and at the end of its first side.
pub type Rows = IdVec<Edge, [u8; 2]>;

/// A point on the curve of an end.
#[derive(Clone, Copy)]
pub struct EndPoint {
    pub place: Place,
    /// How much of the curve is on the other side of it, from the far end and from the near one: so
    /// much of either end it takes.
    pub shares: [f64; 2],
}

/// One end of a strip, by the side of the edge that ends there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct End(pub Corner);

impl End {
    /// Those of an edge: where its first side starts, and where it ends.
    pub fn of(edge: &HardEdge) -> [End; 2] {
        [End(edge.sides[1]), End(edge.sides[0])]
    }
}

impl Given<'_> {
    pub fn edge(&self, end: End) -> Edge {
        self.chamfers.edges.chamfered_at[end.0]
    }

    /// Which of its edge's two ends it is.
    pub fn place_of(&self, end: End) -> usize {
        usize::from(self.chamfers.edges.hard[self.edge(end)].sides[0] == end.0)
    }

    pub fn rows_at(&self, rows: &Rows, end: End) -> usize {
        rows[self.edge(end)][self.place_of(end)].into()
    }

    /// The corners on both sides, in the order of the ring.
    pub fn corners(&self, end: End) -> [Corner; 2] {
        let [one, two] = self.chamfers.edges.hard[self.edge(end)].sides;
        [end.0.next(), if one == end.0 { two } else { one }]
    }

    fn sectors(&self, end: End) -> [Sector; 2] {
        self.corners(end).map(|corner| self.chamfers.sectors.sector_of[corner])
    }

    pub fn ring_of(&self, end: End) -> Ring {
        self.chamfers.sectors.fans[self.sectors(end)[0]].ring
    }

    /// Whether both sides are apart.
    pub fn is_open(&self, end: End) -> bool {
        let [one, other] = self.sectors(end).map(|sector| self.placement.point[sector]);
        one != other
    }

    /// The end by which a sector of a ring is joined to the next one.
    pub fn after(&self, sector: Sector) -> Option<End> {
        let fan = &self.chamfers.sectors.fans[sector];
        let end = fan.last.prev();
        let is_end = fan.next.is_some() && self.chamfers.edges.chamfered_at[end].is_some();
        is_end.then_some(End(end))
    }

    /// Of a ring of two sectors the other end: both have one curve, which is made from the first.
    pub fn twin_of(&self, end: End) -> Option<End> {
        // In an open ring no end comes after the second sector.
        match *self.chamfers.sectors.ring(self.ring_of(end)) {
            [one, two] => self.after(if self.sectors(end)[0] == one { two } else { one }),
            _ => None,
        }
    }

    /// Whether its curve is that of its twin, which comes first.
    fn is_second(&self, end: End) -> bool {
        let members = self.chamfers.sectors.ring(self.ring_of(end));
        self.sectors(end)[0] != members[0] && self.twin_of(end).is_some()
    }

    /// From the first corner to the second.
    pub fn arc(&self, end: End, rows: usize) -> Arc {
        if let Some(twin) = self.twin_of(end).filter(|_| self.is_second(end)) {
            return self.arc(twin, rows).reversed();
        }
        let [from, to] = self.corners(end).map(|corner| Place {
            point: self.placement.position_at(corner),
            normal: unit(self.placement.normal_at(corner)),
        });
        if rows < 2 {
            return Arc::straight(from, to);
        }
        let base = self.base(end);
        let axis = self.axis(end);
        let middle = (from.point + to.point) / 2.0;
        let control = base + axis * (middle - base).dot(axis);
        Arc::towards(from, to, [control, axis], self.profile)
    }

    /// Where the end is in the source.
    fn base(&self, end: End) -> DVec3 {
        self.view.position_at(end.0.next())
    }

    /// Along the edge; where two edges share the curve, as it runs on from one to the other.
    fn axis(&self, end: End) -> DVec3 {
        let along = |end: End| unit(self.base(end) - self.view.position_at(end.0));
        let own = along(end);
        let runs_on = self.twin_of(end).map(|twin| unit(own - along(twin)));
        runs_on.filter(|axis| *axis != DVec3::ZERO).unwrap_or(own)
    }

    /// The points between the two corners, in the order of the ring, as they will be stored.
    pub fn points(&self, rows: &Rows, end: End) -> Few<EndPoint> {
        let count = self.rows_at(rows, end);
        if count < 2 || !self.is_open(end) {
            return Few::new();
        }
        if let Some(twin) = self.twin_of(end).filter(|_| self.is_second(end)) {
            let turned = |at: EndPoint| EndPoint { shares: [at.shares[1], at.shares[0]], ..at };
            return self.points(rows, twin).into_iter().rev().map(turned).collect();
        }
        let arc = self.arc(end, count);
        let places = (1..count)
            .map(|step| self.stored(self.sectors(end)[0], arc.at(step as f64 / count as f64)));
        with_shares([arc.at(0.0).point, arc.at(1.0).point], places.collect())
    }

    /// That by which the points of an end's curve are told apart.
    pub fn sector(&self, end: End) -> Sector {
        let first = self.twin_of(end).filter(|_| self.is_second(end)).unwrap_or(end);
        self.sectors(first)[0]
    }

    /// A place by a sector, rounded as it is measured.
    pub fn stored(&self, sector: Sector, place: Place) -> Place {
        let point = match self.placement.apart {
            Some(apart) => apart.point(sector, place.point),
            None => place.point.as_vec3().as_dvec3(),
        };
        Place { point, ..place }
    }

    /// What the surface of a point at an end is blended from.
    pub fn near_end(&self, end: End, point: &EndPoint) -> Blend {
        if let Some(twin) = self.twin_of(end).filter(|_| self.is_second(end)) {
            let shares = [point.shares[1], point.shares[0]];
            return self.near_end(twin, &EndPoint { shares, ..*point });
        }
        let corners = self.corners(end);
        near(self, self.sectors(end)[0], &corners, &point.shares, point.place.point)
    }
}

/// Points between two others, with their shares of the way.
fn with_shares([from, to]: [DVec3; 2], places: Few<Place>) -> Few<EndPoint> {
    let mut reached = Few::new();
    let (mut last, mut length) = (from, 0.0);
    for point in places.iter().map(|place| place.point).chain([to]) {
        length += last.distance(point);
        last = point;
        reached.push(length);
    }
    let end_point = |(place, reached): (Place, f64)| {
        let share = if length > 0.0 { reached / length } else { 0.0 };
        EndPoint { place, shares: [1.0 - share, share] }
    };
    places.into_iter().zip(reached).map(end_point).collect()
}

/// All ends of a ring, each with the place of the sector that it starts from.
pub fn ends_of<'a>(given: &'a Given, ring: Ring) -> impl Iterator<Item = (usize, End)> + 'a {
    let members = given.chamfers.sectors.ring(ring);
    members.iter().enumerate().filter_map(|(place, &sector)| Some((place, given.after(sector)?)))
}

/// The blend for a point of a ring that takes so much of each of some corners.
pub fn near(
    given: &Given,
    sector: Sector,
    corners: &[Corner],
    shares: &[f64],
    point: DVec3,
) -> Blend {
    let base = given.chamfers.sectors.fans[sector].first;
    let (view, placement) = (given.view, given.placement);
    let terms = || corners.iter().zip(shares);
    let flat: DVec3 = terms().map(|(&c, &share)| placement.position_at(c) * share).sum();
    let rise = view.position_at(base) - flat;
    let bent = (point - flat).dot(rise) / rise.length_squared();
    let bent = if bent.is_finite() { bent.clamp(0.0, 1.0) } else { 0.0 };
    let blends = terms().map(|(&c, &share)| (surface_of(given, c), share * (1.0 - bent)));
    let corner = Blend::one(view.vertex_at(base).0);
    joined(|vertex| view.position(Vertex(vertex)), [(corner, bent)].into_iter().chain(blends))
}

/// Where a corner's vertex comes from on the surface.
fn surface_of(given: &Given, corner: Corner) -> Blend {
    let sector = given.chamfers.sectors.sector_of[corner];
    if given.placement.has_moved(sector) {
        let foot = given.placement.surface_foot(sector, corner);
        foot.blend(given.view, given.placement.share[sector])
    } else {
        Blend::one(given.view.vertex_at(corner).0)
    }
}

/// A weighted mean of blends: of more than three vertices the first one and the two of most weight,
/// and the rest on the first. Vertices at one place count as one.
pub fn joined<P: PartialEq>(
    position: impl Fn(u32) -> P,
    blends: impl Iterator<Item = (Blend, f64)>,
) -> Blend {
    let mut terms: Few<(u32, f64)> = Few::new();
    for (blend, share) in blends {
        for (vertex, weight) in blend.vertices.into_iter().zip(blend.weights) {
            let weight = f64::from(weight) * share;
            let is_one = |other: u32| other == vertex || position(other) == position(vertex);
            match terms.iter().position(|&(other, _)| is_one(other)) {
                Some(known) => terms[known].1 += weight,
                None if weight != 0.0 || terms.is_empty() => terms.push((vertex, weight)),
                None => {}
            }
        }
    }
    if terms.len() > 3 {
        terms[1..].sort_by(|one, other| other.1.abs().total_cmp(&one.1.abs()));
        let rest: f64 = terms.drain(3..).map(|(_, weight)| weight).sum();
        terms[0].1 += rest;
    }
    let first = terms[0].0;
    let term = |k: usize| terms.get(k).copied().unwrap_or((first, 0.0));
    let [one, two, three] = [0, 1, 2].map(term);
    Blend::new([one.0, two.0, three.0], [one.1, two.1, three.1])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_two_that_weigh_most_stay_and_the_rest_goes_to_the_first() {
        let even = Blend { vertices: [1, 2, 3], weights: [0.5, 0.25, 0.25] };
        let other = Blend { vertices: [4, 2, 1], weights: [1.0, 0.0, 0.0] };
        let blend = joined(
            |vertex| vertex,
            [(Blend::one(0), 0.25), (even, 0.25), (other, 0.5)].into_iter(),
        );
        assert_eq!(blend.vertices, [0, 4, 1]);
        assert_eq!(blend.weights, [0.375, 0.5, 0.125]);
    }

    #[test]
    fn vertices_at_one_place_are_one() {
        let pair = Blend { vertices: [1, 2, 3], weights: [0.5, 0.25, 0.25] };
        let blend = joined(|vertex| vertex / 2, [(Blend::one(0), 0.5), (pair, 0.5)].into_iter());
        assert_eq!((blend.vertices, blend.weights), ([0, 2, 0], [0.75, 0.25, 0.0]));
    }
}
