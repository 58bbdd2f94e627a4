//! Feet: where in its owner's chart the far vertices of a chamfer come to lie.

use crate::edges::HardEdge;
use crate::ids::{Corner, Few, Id, Sector};
use crate::mesh::UV_CHANNELS;
use crate::placement::Placement;
use crate::plan::Plan;
use crate::report::Blend;
use crate::resample::{chart_foot, uv_at};

/// A middle vertex lies halfway between the old corner and the pulled one.
const MIDDLE_SHARE: f64 = 0.5;

/// The far corners of a strip, as places in b1, a1, a2, b2, each with its foot.
pub fn strip_feet(
    plan: &Plan,
    placement: &Placement,
    edge: &HardEdge,
    owner: usize,
) -> [(usize, Blend); 2] {
    let [near, far] = [edge.sides[owner], edge.sides[1 - owner]];
    let foot = |near_corner: Corner, far_corner: Corner| {
        let [own, other] = [near_corner, far_corner].map(|c| plan.sectors.sector_of[c]);
        // Where nothing but two strips meet, one foot serves both: below the far vertex.
        let pulled = if is_pair(plan, own) { other } else { own };
        foot_on_edge(plan, placement, near, pulled)
    };
    let [start, end] = if owner == 0 { [2, 3] } else { [0, 1] };
    [(start, foot(near, far.next())), (end, foot(near.next(), far))]
}

/// Whether a sector and one other go all around their cluster.
pub fn is_pair(plan: &Plan, sector: Sector) -> bool {
    let ring = plan.sectors.fans[sector].ring;
    plan.sectors.rings[ring].closed && plan.sectors.ring(ring).len() == 2
}

/// The place on a half-edge at the foot of the perpendicular from a pulled vertex.
pub fn foot_on_edge(
    plan: &Plan,
    placement: &Placement,
    half_edge: Corner,
    pulled: Sector,
) -> Blend {
    let [from, to] = [half_edge, half_edge.next()].map(|corner| plan.view.position_at(corner));
    let along = to - from;
    let share = (placement.point[pulled] - from).dot(along) / along.length_squared();
    on_edge(plan, half_edge, share)
}

/// The place at a share of a half-edge.
fn on_edge(plan: &Plan, half_edge: Corner, share: f64) -> Blend {
    let [from, to] = [half_edge, half_edge.next()].map(|corner| plan.view.vertex_at(corner).0);
    let share = share.clamp(0.0, 1.0);
    match [1.0 - share, share].map(|weight| weight as f32) {
        [0.0, weight] => Blend { vertices: [to; 3], weights: [weight, 0.0, 0.0] },
        [weight, 0.0] => Blend { vertices: [from; 3], weights: [weight, 0.0, 0.0] },
        [near, far] => Blend { vertices: [from, to, from], weights: [near, far, 0.0] },
    }
}

/// A weighted sum of blends that have no more than three vertices between them; of others, those
/// that come first.
pub fn mixed(terms: &[(Blend, f64)]) -> Blend {
    let mut sum = Blend { vertices: [0; 3], weights: [0.0; 3] };
    let mut used = 0;
    for (blend, share) in terms {
        for (&vertex, &weight) in blend.vertices.iter().zip(&blend.weights) {
            let added = (f64::from(weight) * share) as f32;
            if added == 0.0 {
                continue;
            }
            let known = sum.vertices[..used].iter().position(|&other| other == vertex);
            let place = known.unwrap_or(used);
            if place < 3 {
                sum.vertices[place] = vertex;
                sum.weights[place] += added;
                used = used.max(place + 1);
            }
        }
    }
    for place in used..3 {
        sum.vertices[place] = sum.vertices[0];
    }
    sum
}

/// How far the feet of a fill may lie from the corner, in terms of where they would be: farther out
/// where the kite would be too small for the fill.
pub const REACHES: [f64; 3] = [1.0, 2.0, 4.0];

/// Where a fill lies in its owner's chart: on the kite between the pulled corner, the feet on the
/// owner's two edges, and the old corner.
pub struct Kite {
    /// The other sectors, as places in the ring.
    pub feet: Few<(usize, Blend)>,
    /// For vertices in the middle.
    pub middle: Blend,
}

/// The kite of one of a ring's sectors, its feet so many times as far from the corner as below the
/// pulled vertex. The others lie on a bow from foot to foot that bends towards the old corner, so
/// that no three of them are in line.
pub fn kite(
    plan: &Plan,
    placement: &Placement,
    sectors: &[Sector],
    owner: usize,
    reach: f64,
) -> Kite {
    let sector = sectors[owner];
    let [behind, before] = wings(plan, placement, sector, reach);
    let fan = &plan.sectors.fans[sector];
    let corner = Blend::one(plan.view.vertex_at(fan.first).0);
    let others = sectors.len() - 1;
    let on_bow = |k: usize| {
        let along = k as f64 / (others - 1).max(1) as f64;
        let [from, to] = [1.0 - along, along].map(|share| share * share * share);
        let foot = mixed(&[(behind, from), (corner, 1.0 - from - to), (before, to)]);
        ((owner + 1 + k) % sectors.len(), foot)
    };
    let share = placement.share[sector] * MIDDLE_SHARE;
    Kite {
        feet: (0..others).map(on_bow).collect(),
        middle: chart_foot(plan, sector, fan.first).blend(plan, share),
    }
}

/// The feet on a sector's last and first edge; the old corner itself where the last one lies in
/// another chart.
fn wings(plan: &Plan, placement: &Placement, sector: Sector, reach: f64) -> [Blend; 2] {
    let fan = &plan.sectors.fans[sector];
    let corner = plan.view.vertex_at(fan.first).0;
    let way = placement.point[sector] - plan.view.position_at(fan.first);
    let share = |other: Corner| {
        let along = plan.view.position_at(other) - plan.view.position_at(fan.first);
        reach * way.dot(along) / along.length_squared()
    };
    let before = on_edge(plan, fan.first, share(fan.first.next()));
    if !is_one_chart(plan, sector) {
        return [Blend::one(corner), before];
    }
    let last = plan.view.vertex_at(fan.last).0;
    let behind = on_edge(plan, fan.last.prev(), 1.0 - share(fan.last.prev()));
    let vertices = behind.vertices.map(|v| if v == last { corner } else { v });
    [Blend { vertices, ..behind }, before]
}

/// Whether the first and the last corner of a sector lie in one chart.
fn is_one_chart(plan: &Plan, sector: Sector) -> bool {
    (0..UV_CHANNELS).all(|channel| !is_broken(plan, sector, channel))
}

/// Whether a seam of a channel runs through a sector.
pub fn is_broken(plan: &Plan, sector: Sector, channel: usize) -> bool {
    let fan = &plan.sectors.fans[sector];
    let uv = &plan.view.mesh.uvs[channel];
    let [first, last] = [fan.first, fan.last].map(|c| plan.view.vertex_at(c).index());
    uv_at(uv, first) != uv_at(uv, last)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::tests::plan_of;
    use crate::shapes;

    fn weight_of(blend: &Blend, vertex: u32) -> f32 {
        let pairs = blend.vertices.into_iter().zip(blend.weights);
        pairs.filter(|(other, _)| *other == vertex).map(|(_, weight)| weight).sum()
    }

    #[test]
    fn blends_are_summed_vertex_by_vertex() {
        let [a, b] = [Blend::one(3), Blend::one(5)];
        assert_eq!(mixed(&[(a, 1.0), (b, 0.0)]), a);
        let once = mixed(&[(a, 0.75), (b, 0.25)]);
        assert_eq!([3, 5].map(|vertex| weight_of(&once, vertex)), [0.75, 0.25]);
        let twice = mixed(&[(once, 0.5), (a, 0.5)]);
        assert_eq!([3, 5].map(|vertex| weight_of(&twice, vertex)), [0.875, 0.125]);
    }

    #[test]
    fn the_foot_of_a_pulled_vertex_lies_on_the_old_edge() {
        let cube = shapes::cube(1.0);
        let plan = plan_of(&cube, 0.1);
        let mut placement = Placement::unmoved(&plan);
        let sector = Sector(0);
        placement.set(&plan, sector, 1.0);
        let side = plan.sectors.fans[sector].first;
        let foot = foot_on_edge(&plan, &placement, side, sector);
        let [from, to] = [side, side.next()].map(|corner| plan.view.vertex_at(corner).0);
        assert!((weight_of(&foot, from) - 0.9).abs() < 1e-6, "{foot:?}");
        assert!((weight_of(&foot, to) - 0.1).abs() < 1e-6, "{foot:?}");
    }
}
