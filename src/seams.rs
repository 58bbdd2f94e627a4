//! Seams: whose texture a chamfer continues (thesis 6.4).
//!
//! Where a UV channel differs across a hard edge, the chamfer belongs to one side's chart, its
//! owner. The owner's chart has a free band between the pulled edge and the old one, and the
//! strip is mapped onto exactly that: its far side lands on the old edge. The owner also gives the
//! strip its submesh.

mod density;
mod feet;
mod owners;

use glam::{DVec2, DVec3};

use crate::attributes::{Attributes, Streams};
use crate::corners::{Fill, middle};
use crate::edges::HardEdge;
use crate::ids::{Corner, Edge, Few, Ring, Sector};
use crate::mesh::UV_CHANNELS;
use crate::output::Copies;
use crate::placement::{Placement, base};
use crate::plan::Plan;
use crate::report::Blend;
use crate::strips::{self, Cut};

use density::{MOST_STRETCH, density, stretch, uv_point};
use feet::{REACHES, is_broken, kite, strip_feet};

pub use feet::Kite;
pub use owners::{Owners, owners};

/// The UV channels that a mesh has.
fn channels_of(plan: &Plan) -> impl Iterator<Item = usize> + use<> {
    let present = plan.view.mesh.uvs.map(|uv| uv.components > 0);
    (0..UV_CHANNELS).filter(move |&channel| present[channel])
}

/// Where a blend lies in a UV channel.
fn place_of(plan: &Plan, channel: usize, blend: &Blend) -> DVec2 {
    let uv = &plan.view.mesh.uvs[channel];
    let terms = blend.vertices.iter().zip(blend.weights);
    terms.map(|(&vertex, weight)| uv_point(uv, vertex) * f64::from(weight)).sum()
}

/// How a strip lies on the texture of a channel.
struct StripMap<'a> {
    plan: &'a Plan<'a>,
    points: [DVec3; 4],
    cut: Cut,
    /// The strip's own vertices: b1, a1, a2, b2.
    vertices: [u32; 4],
}

impl<'a> StripMap<'a> {
    fn new(
        plan: &'a Plan,
        placement: &Placement,
        attributes: &Attributes,
        edge: &HardEdge,
        cut: Cut,
    ) -> Self {
        let corners = strips::corners(edge);
        let points = corners.map(|corner| placement.position_at(plan, corner));
        StripMap { plan, points, cut, vertices: corners.map(|c| attributes.vertex_at[c]) }
    }

    /// How much the strip stretches the texture of a face, with some corners moved to their feet.
    fn stretch(
        &self,
        streams: &Streams,
        channel: usize,
        face: Corner,
        feet: &[(usize, Blend)],
    ) -> f64 {
        let mut uvs = self.vertices.map(|vertex| streams.uv(vertex, channel));
        for (place, foot) in feet {
            uvs[*place] = place_of(self.plan, channel, foot);
        }
        let triangles = self.cut.triangles().iter();
        let triangles = triangles.map(|t| (t.map(|k| self.points[k]), t.map(|k| uvs[k])));
        stretch(density(self.plan, face.triangle(), channel), self.plan.view.resolution, triangles)
    }

    /// Whether the strip, as it runs on from both sides, stretches the texture of either too much.
    fn fits_no_side(&self, streams: &Streams, channel: usize, edge: &HardEdge) -> bool {
        let stretches = |side: Corner| self.stretch(streams, channel, side, &[]) > MOST_STRETCH;
        edge.sides.into_iter().all(stretches)
    }
}

/// A vertex whose chart blend weighs less than this somewhere lies outside of its chart.
const LEAST_WEIGHT: f32 = -1e-3;

/// Whether a vertex was pulled past the end of its chart: a seam runs through its sector.
fn strays(streams: &Streams, vertex: u32) -> bool {
    streams.sources[vertex as usize].chart.weights.iter().any(|&weight| weight < LEAST_WEIGHT)
}

/// The output vertices of a strip's corners b1, a1, a2, b2, those of the far side moved into the
/// owner's chart where theirs is another.
pub fn strip_vertices(
    plan: &Plan,
    placement: &Placement,
    owner: usize,
    edge: &HardEdge,
    cut: Cut,
    attributes: &mut Attributes,
    copies: &mut Copies,
) -> [u32; 4] {
    let map = StripMap::new(plan, placement, attributes, edge, cut);
    let feet = strip_feet(plan, placement, edge, owner);
    let face = edge.sides[owner];
    let mut channels = edge.seams;
    let streams = &mut attributes.streams;
    let seams = channels;
    for channel in channels_of(plan).filter(|&channel| seams >> channel & 1 == 0) {
        // Texture that is mirrored at the edge folds onto itself under the chamfer.
        let is_folded = map.fits_no_side(streams, channel, edge);
        let own = map.stretch(streams, channel, face, &[]);
        if is_folded && map.stretch(streams, channel, face, &feet) < own {
            channels |= 1 << channel;
        }
    }
    let mut vertices = map.vertices;
    if channels != 0 {
        for (place, foot) in &feet {
            vertices[*place] = copies.get(plan, streams, vertices[*place], foot, channels);
        }
    }
    vertices
}

/// How a fill lies on the texture.
pub struct FillMap<'a> {
    plan: &'a Plan<'a>,
    placement: &'a Placement,
    sectors: &'a [Sector],
    fill: &'a Fill,
    points: Few<DVec3>,
    /// `#sectors`: their output vertices.
    pub vertices: Few<u32>,
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
        let vertices = sectors.iter().map(own).collect();
        FillMap { plan, placement, sectors, fill, points, vertices }
    }

    fn first(&self, place: usize) -> Corner {
        self.plan.sectors.fans[self.sectors[place]].first
    }

    /// How much the fill stretches the texture of one of its sectors.
    fn stretch(&self, channel: usize, owner: usize, uvs: &[DVec2]) -> f64 {
        let face = density(self.plan, self.first(owner).triangle(), channel);
        let triangles = self.fill.triangles.iter();
        let triangles = triangles.map(|t| (t.map(|k| self.points[k]), t.map(|k| uvs[k])));
        stretch(face, self.plan.view.resolution, triangles)
    }

    fn own_stretch(&self, streams: &Streams, channel: usize, owner: usize) -> f64 {
        if !self.fill.middles.is_empty() {
            return 1.0;
        }
        let uvs: Few<DVec2> = self.vertices.iter().map(|&v| streams.uv(v, channel)).collect();
        self.stretch(channel, owner, &uvs)
    }

    fn kite_stretch(&self, streams: &Streams, channel: usize, (owner, reach): (usize, f64)) -> f64 {
        if strays(streams, self.vertices[owner]) {
            return f64::INFINITY;
        }
        let kite = self.kite((owner, reach));
        let middle = place_of(self.plan, channel, &kite.middle);
        let mut uvs: Few<DVec2> = self.points.iter().map(|_| middle).collect();
        uvs[owner] = streams.uv(self.vertices[owner], channel);
        for (place, foot) in &kite.feet {
            uvs[*place] = place_of(self.plan, channel, foot);
        }
        self.stretch(channel, owner, &uvs)
    }

    /// Where the fill lies in the chart of one of its sectors.
    pub fn kite(&self, (owner, reach): (usize, f64)) -> Kite {
        kite(self.plan, self.placement, self.sectors, owner, reach)
    }

    /// Which sector's chart the fill continues, and with what reach: the first in rank whose kite
    /// fits, or else the one that fits best.
    pub fn owner(&self, streams: &Streams, owners: &Owners) -> (usize, f64) {
        let mut ranked: Few<_> =
            (0..self.sectors.len()).map(|place| (self.rank(place, owners), place)).collect();
        ranked.sort_unstable_by(|one, other| other.cmp(one));
        let places: Few<usize> = ranked.iter().map(|&(_, place)| place).collect();
        let broken = channels_of(self.plan).find(|&channel| self.seams(channel) > 0);
        let mut best = (f64::INFINITY, (places[0], REACHES[0]));
        let Some(channel) = broken else { return best.1 };
        let kites = REACHES.iter().flat_map(|&reach| places.iter().map(move |&at| (at, reach)));
        for kite in kites {
            let stretch = self.kite_stretch(streams, channel, kite);
            if stretch <= MOST_STRETCH {
                return kite;
            }
            if stretch < best.0 {
                best = (stretch, kite);
            }
        }
        best.1
    }

    /// One that moved and is convex comes first, and one that owns the strips beside it.
    fn rank(&self, place: usize, owners: &Owners) -> (bool, bool, usize, usize) {
        let plan = self.plan;
        let sector = self.sectors[place];
        let fan = &plan.sectors.fans[sector];
        let owns = |side: &Corner| {
            let edge: Edge = plan.edges.chamfered_at[*side];
            edge.is_some() && plan.edges.hard[edge].sides[owners.side[edge]] == *side
        };
        let owned = [fan.first, fan.last.prev()].iter().filter(|side| owns(side)).count();
        let at = base(plan, sector);
        let first = plan.view.position_at(fan.first.next()) - at;
        let last = plan.view.position_at(fan.last.prev()) - at;
        let is_convex = first.cross(last).dot(plan.faces.normal[fan.first.triangle()]) > 0.0;
        let has_moved = self.placement.has_moved(plan, sector);
        (has_moved, is_convex, owned, self.sectors.len() - place)
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

    /// The channels, as bits, in which the fill is mapped onto its owner's kite: where the sectors
    /// do not lie around one point of one chart, or the one seam leaves too little around the corner.
    pub fn channels(&self, streams: &Streams, kite: (usize, f64)) -> u8 {
        let (owner, _) = kite;
        let ring = self.plan.sectors.fans[self.sectors[owner]].ring;
        let closed = self.plan.sectors.rings[ring].closed;
        // One seam unfolds the faces around a closed ring; around an open one the border does.
        let allowed = usize::from(closed && self.fill.middles.is_empty());
        let is_mapped = |channel: &usize| {
            let seams = self.seams(*channel);
            seams > allowed
                || seams > 0 && {
                    let own = self.own_stretch(streams, *channel, owner);
                    own > MOST_STRETCH && self.kite_stretch(streams, *channel, kite) < own
                }
        };
        channels_of(self.plan).filter(is_mapped).fold(0, |channels, k| channels | 1 << k)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::attributes::attributes;
    use crate::ids::Triangle;
    use crate::limits::limits;
    use crate::options::Verify;
    use crate::plan::tests::plan_of;
    use crate::shapes;
    use crate::strips::strips;

    #[test]
    fn a_chain_of_edges_between_two_regions_has_one_owner() {
        let cylinder = shapes::cylinder(12);
        let plan = plan_of(&cylinder, 0.05);
        let placement = limits(&plan, Verify::Fast).placement;
        let cuts = strips(&plan, &placement);
        let owners = owners(&plan, &placement, &cuts, &attributes(&plan, &placement));
        for edge in plan.edges.hard.ids() {
            let owner = plan.edges.hard[edge].sides[owners.side[edge]].triangle();
            assert!(owner < Triangle(24), "the side of the cylinder comes first");
        }
    }
}
