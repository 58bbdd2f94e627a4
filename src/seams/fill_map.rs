//! Fill map: how a corner fill lies on the texture.

use glam::{DVec2, DVec3};

use super::density::{Facing, Lie, MOST_STRETCH, misfit};
use super::feet::{Lay, Wings, corner_lay, is_broken, kite};
use super::ground::Ground;
use super::{Owners, channels_of, place_of};
use crate::attributes::{Attributes, Streams, middles};
use crate::corners::{Fill, middle};
use crate::ids::{Corner, Edge, Few, Ring, Sector};
use crate::math::{area_vector, unit};
use crate::placement::{Placement, base};
use crate::plan::Plan;
use crate::report::Blend;

/// A way to lay a fill into the chart of its owner.
#[derive(Clone, Copy, Debug)]
enum Way {
    Kite(Wings),
    /// Into the triangle at the owner's first corner.
    Corner,
}

/// The ways to lay a fill, best first.
const WAYS: [Way; 5] = [
    Way::Kite(Wings::Far),
    Way::Kite(Wings::Near(1.0)),
    Way::Kite(Wings::Near(2.0)),
    Way::Kite(Wings::Near(4.0)),
    Way::Corner,
];

/// Whose texture a fill continues, and where it lies there.
pub struct FillLay {
    /// The owner, as a place in the ring.
    pub owner: usize,
    /// `#sectors`: their own output vertices.
    pub vertices: Few<u32>,
    /// The channels, as bits, that the fill has from its owner; the others run on as they are.
    pub channels: u8,
    pub lay: Lay,
}

/// A fill, and what is around it.
pub struct FillMap<'a> {
    plan: &'a Plan<'a>,
    placement: &'a Placement,
    sectors: &'a [Sector],
    fill: &'a Fill,
    points: Few<DVec3>,
    /// `#triangles`: twice their areas.
    areas: Few<f64>,
    /// `#sectors`: their output vertices.
    vertices: Few<u32>,
}

impl<'a> FillMap<'a> {
    pub fn new(
        plan: &'a Plan,
        placement: &'a Placement,
        attributes: &Attributes,
        ring: Ring,
        fill: &'a Fill,
    ) -> Self {
        let sectors = plan.sectors.ring(ring);
        let own = |sector: &Sector| attributes.vertex_at[plan.sectors.fans[*sector].first];
        let mut points: Few<DVec3> = sectors.iter().map(|&s| placement.point[s]).collect();
        let middles: Few<DVec3> = fill.middles.iter().map(|at| middle(&points, at)).collect();
        points.extend(middles);
        let area = |triangle: &[usize; 3]| area_vector(triangle.map(|k| points[k])).length();
        let areas = fill.triangles.iter().map(area).collect();
        let vertices = sectors.iter().map(own).collect();
        FillMap { plan, placement, sectors, fill, points, areas, vertices }
    }

    /// The first way, and the first owner in rank, that fits in all channels that cannot run on; or
    /// else those that fit best.
    pub fn lay(self, streams: &Streams, owners: &Owners) -> FillLay {
        let broken = |channel: &usize| self.own_misfit(streams, *channel) > MOST_STRETCH;
        let all = channels_of(self.plan);
        let channels = all.filter(broken).fold(0, |channels, k| channels | 1 << k);
        let (owner, channels, lay) = self.best_lay(streams, channels, &self.ranked(owners));
        FillLay { owner, vertices: self.vertices, channels, lay }
    }

    /// The places of the ring, best owner first.
    fn ranked(&self, owners: &Owners) -> Few<usize> {
        let places = 0..self.sectors.len();
        let mut ranked: Few<_> = places.map(|place| (self.rank(place, owners), place)).collect();
        ranked.sort_unstable_by(|one, other| other.cmp(one));
        ranked.iter().map(|&(_, place)| place).collect()
    }

    fn best_lay(&self, streams: &Streams, channels: u8, places: &[usize]) -> (usize, u8, Lay) {
        let worst = |owner: usize, lay: &Lay| {
            let mapped = channels_of(self.plan).filter(|channel| channels >> channel & 1 == 1);
            let misfits = mapped.map(|channel| self.misfit(streams, channel, owner, lay));
            misfits.fold(0.0, f64::max)
        };
        if channels == 0 {
            return (places[0], channels, self.laid(WAYS[0], places[0]));
        }
        let mut best: Option<(f64, usize, Lay)> = None;
        for (way, &owner) in WAYS.iter().flat_map(|way| places.iter().map(move |at| (way, at))) {
            let lay = self.laid(*way, owner);
            let misfit = worst(owner, &lay);
            if misfit <= MOST_STRETCH {
                return (owner, channels, lay);
            }
            if best.as_ref().is_none_or(|(least, ..)| misfit < *least) {
                best = Some((misfit, owner, lay));
            }
        }
        let none = || (0, 0, self.laid(WAYS[0], 0));
        best.map_or_else(none, |(_, owner, lay)| (owner, channels, lay))
    }

    fn laid(&self, way: Way, owner: usize) -> Lay {
        match way {
            Way::Kite(wings) => {
                let middles = self.fill.middles.len();
                kite(self.plan, self.placement, self.sectors, owner, wings, middles)
            }
            Way::Corner => {
                let triangles = self.fill.triangles.iter();
                let normal = triangles.map(|t| area_vector(t.map(|k| self.points[k]))).sum();
                let count = self.sectors.len();
                corner_lay(self.plan, self.first(owner), &self.points, count, unit(normal))
            }
        }
    }

    fn first(&self, place: usize) -> Corner {
        self.plan.sectors.fans[self.sectors[place]].first
    }

    /// How badly the fill lies on its owner's texture: see [`misfit`].
    fn misfit(&self, streams: &Streams, channel: usize, owner: usize, lay: &Lay) -> f64 {
        let mut uvs: Few<DVec2> = self.vertices.iter().map(|&v| streams.uv(v, channel)).collect();
        uvs.extend(lay.middles.iter().map(|middle| place_of(self.plan, channel, middle)));
        for (place, foot) in &lay.feet {
            uvs[*place] = place_of(self.plan, channel, foot);
        }
        self.misfit_on(channel, owner, Facing::AsFace, &uvs)
    }

    /// How badly it lies where its vertices are in their own charts; infinite where these are not
    /// one around the corner.
    fn own_misfit(&self, streams: &Streams, channel: usize) -> f64 {
        if self.seams(channel) > self.allowed_seams() {
            return f64::INFINITY;
        }
        let mut uvs: Few<DVec2> = self.vertices.iter().map(|&v| streams.uv(v, channel)).collect();
        let middle = |&at: &DVec3| -> Blend { middles::nearest(self.plan, self.sectors, at) };
        let middles = self.points[self.sectors.len()..].iter().map(middle);
        uvs.extend(middles.map(|blend| place_of(self.plan, channel, &blend)));
        let on = |owner: usize| self.misfit_on(channel, owner, Facing::Either, &uvs);
        (0..self.sectors.len()).map(on).fold(f64::INFINITY, f64::min)
    }

    fn misfit_on(&self, channel: usize, owner: usize, facing: Facing, uvs: &[DVec2]) -> f64 {
        let corners = [self.first(owner)];
        let ground = Ground::new(self.plan, channel, &corners);
        let lie = Lie { triangles: &self.fill.triangles, areas: &self.areas, uvs };
        misfit(self.plan, self.first(owner), facing, channel, &ground, &lie)
    }

    /// One seam unfolds the faces around a closed ring; around an open one the border does.
    fn allowed_seams(&self) -> usize {
        let ring = self.plan.sectors.fans[self.sectors[0]].ring;
        usize::from(self.plan.sectors.rings[ring].closed && self.fill.middles.is_empty())
    }

    /// How often a channel breaks around the ring, at edges and within sectors.
    fn seams(&self, channel: usize) -> usize {
        let plan = self.plan;
        let breaks = |&sector: &Sector| {
            let edge = plan.edges.chamfered_at[plan.sectors.fans[sector].last.prev()];
            let at_edge = edge.is_some() && plan.edges.hard[edge].seams >> channel & 1 == 1;
            usize::from(at_edge) + usize::from(is_broken(plan, sector, channel))
        };
        self.sectors.iter().map(breaks).sum()
    }

    /// One that moved and is convex comes first, and one that owns the strips beside it.
    fn rank(&self, place: usize, owners: &Owners) -> (bool, bool, usize, usize) {
        let plan = self.plan;
        let sector = self.sectors[place];
        let fan = &plan.sectors.fans[sector];
        let owns = |side: &Corner| {
            let edge: Edge = plan.edges.chamfered_at[*side];
            edge.is_some() && plan.edges.hard[edge].sides[owners.of(edge)] == *side
        };
        let owned = [fan.first, fan.last.prev()].iter().filter(|side| owns(side)).count();
        let at = base(plan, sector);
        let first = plan.view.position_at(fan.first.next()) - at;
        let last = plan.view.position_at(fan.last.prev()) - at;
        let is_convex = first.cross(last).dot(plan.faces.normal[fan.first.triangle()]) > 0.0;
        let has_moved = self.placement.has_moved(plan, sector);
        (has_moved, is_convex, owned, self.sectors.len() - place)
    }
}
