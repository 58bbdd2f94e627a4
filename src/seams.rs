//! Seams: whose texture a chamfer continues (thesis 6.4).
//!
//! Where a UV channel differs across a hard edge, the chamfer belongs to one side's chart, its
//! owner. The owner's chart has a free band between the pulled edge and the old one, and the
//! strip is mapped onto exactly that: its far side lands on the old edge, at the foot of the
//! perpendicular from the pulled vertex. The owner also gives the strip its submesh.

use crate::attributes::{Attributes, Streams};
use crate::edges::HardEdge;
use std::collections::HashMap;

use crate::ids::{Corner, Edge, Id, IdVec, Ring, Sector, Triangle, Vertex};
use crate::mesh::UV_CHANNELS;
use crate::placement::{Placement, base};
use crate::plan::Plan;
use crate::report::Blend;
use crate::resample::uv_at;
use crate::strips;

/// UV values that differ by less than this share of their size are one: exporters round.
const EQUAL_UV: f32 = 1e-6;

/// `#hard edges`: which of its two sides owns the chamfer.
pub struct Owners {
    pub side: IdVec<Edge, usize>,
}

/// The side in the smooth region that comes first in the mesh owns: so a whole chain of edges
/// between two regions has one owner, and the texture does not zigzag.
pub fn owners(plan: &Plan) -> Owners {
    let region = regions(plan);
    let side = plan.edges.hard.iter().map(|edge| {
        let [one, two] = edge.sides.map(|side| region[side.triangle()]);
        usize::from(two < one)
    });
    Owners { side: IdVec::from_vec(side.collect()) }
}

/// `#triangles`: the first triangle that can be reached without crossing a chamfered edge.
fn regions(plan: &Plan) -> IdVec<Triangle, Triangle> {
    let mut region = IdVec::filled(Triangle::NONE, plan.view.corner_count() / 3);
    let mut front = Vec::new();
    for seed in plan.view.triangles() {
        if region[seed].is_some() {
            continue;
        }
        region[seed] = seed;
        front.push(seed);
        while let Some(triangle) = front.pop() {
            for side in triangle.corners() {
                let twin = plan.topology.twin[side];
                let is_crossed = plan.edges.chamfered_at[side].is_none() && twin.is_some();
                if is_crossed && region[twin.triangle()].is_none() {
                    region[twin.triangle()] = seed;
                    front.push(twin.triangle());
                }
            }
        }
    }
    region
}

/// The channels that differ across an edge, as bits.
pub fn seam_channels(plan: &Plan, edge: &HardEdge) -> u8 {
    let [one, two] = edge.sides;
    let pairs = [(one, two.next()), (one.next(), two)];
    let mut channels = 0;
    for (channel, uv) in plan.view.mesh.uvs.iter().enumerate().filter(|(_, uv)| uv.components > 0) {
        let value = |corner: Corner| uv_at(uv, plan.view.vertex_at(corner).index());
        let differs = |(one, other): (Corner, Corner)| {
            value(one)
                .iter()
                .zip(value(other))
                .any(|(&a, &b)| (a - b).abs() > EQUAL_UV * a.abs().max(1.0))
        };
        if pairs.into_iter().any(differs) {
            channels |= 1 << channel;
        }
    }
    channels
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
    let [from, to] = [half_edge, half_edge.next()].map(|corner| plan.view.vertex_at(corner).0);
    between(Blend::one(from), Blend::one(to), share.clamp(0.0, 1.0))
}

/// Between two blends of one source vertex each, or a mixture of two on one line.
pub fn between(from: Blend, to: Blend, share: f64) -> Blend {
    let weight = share as f32;
    if weight == 0.0 {
        return from;
    }
    if weight == 1.0 {
        return to;
    }
    let mut mixed =
        Blend { vertices: from.vertices, weights: from.weights.map(|w| w * (1.0 - weight)) };
    for (vertex, added) in to.vertices.into_iter().zip(to.weights.map(|w| w * weight)) {
        if added != 0.0 {
            add(&mut mixed, vertex, added);
        }
    }
    mixed
}

fn add(blend: &mut Blend, vertex: u32, weight: f32) {
    let same = (0..3).find(|&k| blend.vertices[k] == vertex && blend.weights[k] != 0.0);
    if let Some(k) = same.or_else(|| (0..3).find(|&k| blend.weights[k] == 0.0)) {
        blend.vertices[k] = vertex;
        blend.weights[k] += weight;
    }
}

/// Copies of vertices in other charts; each is made once.
#[derive(Default)]
pub struct Copies {
    /// Copies in the order of their making: of which output vertex, and which one it is.
    made: HashMap<u32, Vec<u32>>,
}

impl Copies {
    /// An output vertex with the given channels taken from a place in another chart.
    pub fn get(
        &mut self,
        plan: &Plan,
        streams: &mut Streams,
        vertex: u32,
        chart: &Blend,
        channels: u8,
    ) -> u32 {
        let copy = streams.append(Vertex(vertex));
        streams.rechart(plan, copy, chart, channels);
        let known = self.made.entry(vertex).or_default();
        let equal = std::iter::once(vertex).chain(known.iter().copied());
        match equal.into_iter().find(|&other| streams.are_equal(other, copy)) {
            Some(other) => {
                streams.pop();
                other
            }
            None => {
                known.push(copy);
                copy
            }
        }
    }
}

/// The output vertices of a strip's corners b1, a1, a2, b2, those of the far side moved into the
/// owner's chart.
pub fn strip_vertices(
    plan: &Plan,
    placement: &Placement,
    owner: usize,
    edge: &HardEdge,
    attributes: &mut Attributes,
    copies: &mut Copies,
) -> [u32; 4] {
    let corners = strips::corners(edge);
    let mut vertices = corners.map(|corner| attributes.vertex_at[corner]);
    let channels = seam_channels(plan, edge);
    if channels == 0 {
        return vertices;
    }
    // The far corner at either end, and the owner's corner there.
    let ends = if owner == 0 { [(2, 1), (3, 0)] } else { [(1, 2), (0, 3)] };
    for (far, near) in ends {
        let pulled = plan.sectors.sector_of[corners[near]];
        let foot = foot_on_edge(plan, placement, edge.sides[owner], pulled);
        vertices[far] = copies.get(plan, &mut attributes.streams, vertices[far], &foot, channels);
    }
    vertices
}

/// Which sector's chart a corner fill continues: one that moved and is convex, if there is any.
pub fn fill_owner(plan: &Plan, placement: &Placement, ring: &[Sector], owners: &Owners) -> usize {
    let owned = |sector: Sector| {
        let fan = &plan.sectors.fans[sector];
        let sides = [fan.first, fan.last.prev()];
        let owns = |side: Corner| {
            let edge = plan.edges.chamfered_at[side];
            edge.is_some() && plan.edges.hard[edge].sides[owners.side[edge]] == side
        };
        sides.into_iter().filter(|&side| owns(side)).count()
    };
    let is_convex = |sector: Sector| {
        let fan = &plan.sectors.fans[sector];
        let at = base(plan, sector);
        let first = plan.view.position_at(fan.first.next()) - at;
        let last = plan.view.position_at(fan.last.prev()) - at;
        first.cross(last).dot(plan.faces.normal[fan.first.triangle()]) > 0.0
    };
    let rank = |&place: &usize| {
        let sector = ring[place];
        (placement.has_moved(plan, sector), is_convex(sector), owned(sector), ring.len() - place)
    };
    (0..ring.len()).max_by_key(rank).unwrap_or(0)
}

/// The channels in which a ring's sectors do not lie around one point of one chart: there the
/// fill is mapped into its owner's chart.
pub fn fill_channels(plan: &Plan, ring: Ring) -> u8 {
    let closed = plan.sectors.rings[ring].closed;
    // One seam unfolds the faces around a closed ring; around an open one the border does.
    let mut seams = [usize::from(!closed); UV_CHANNELS];
    for &sector in plan.sectors.ring(ring) {
        let edge = plan.edges.chamfered_at[plan.sectors.fans[sector].last.prev()];
        if edge.is_none() {
            continue;
        }
        let channels = seam_channels(plan, &plan.edges.hard[edge]);
        for (channel, count) in seams.iter_mut().enumerate() {
            *count += usize::from(channels >> channel & 1);
        }
    }
    (0..UV_CHANNELS).filter(|&k| seams[k] > 1).fold(0, |channels, k| channels | 1 << k)
}

/// Where in the owner's chart the other sectors of a ring come to lie: from the feet on the
/// owner's two edges towards the old corner between them.
pub fn fill_feet(
    plan: &Plan,
    placement: &Placement,
    ring: Ring,
    owner: usize,
) -> Vec<(usize, Blend)> {
    let sectors = plan.sectors.ring(ring);
    let closed = plan.sectors.rings[ring].closed;
    let fan = &plan.sectors.fans[sectors[owner]];
    let corner = Blend::one(plan.view.vertex_at(fan.first).0);
    let foot = |half_edge: Corner| foot_on_edge(plan, placement, half_edge, sectors[owner]);
    let count = sectors.len();
    let (behind, before) =
        if closed { (count / 2, count - 1 - count / 2) } else { (count - 1 - owner, owner) };
    let last = foot(fan.last.prev());
    let first = foot(fan.first);
    let behind = (0..behind).map(|k| {
        let share = k as f64 / behind as f64;
        ((owner + 1 + k) % count, between(last, corner, share))
    });
    let before = (0..before).map(|k| {
        let share = k as f64 / before as f64;
        ((owner + count - 1 - k) % count, between(first, corner, share))
    });
    behind.chain(before).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::tests::plan_of;
    use crate::shapes;

    #[test]
    fn a_channel_that_differs_across_an_edge_is_a_seam_there() {
        let (seamed, plain) = (shapes::cube(1.0), shapes::plain_cube(1.0));
        let channels = |mesh| {
            let plan = plan_of(mesh, 0.1);
            plan.edges.hard.iter().map(|edge| seam_channels(&plan, edge)).collect::<Vec<_>>()
        };
        assert_eq!(channels(&seamed), [1; 12]);
        assert_eq!(channels(&plain), [0; 12]);
    }

    #[test]
    fn a_chain_of_edges_between_two_regions_has_one_owner() {
        let cylinder = shapes::cylinder(12);
        let plan = plan_of(&cylinder, 0.05);
        let owners = owners(&plan);
        let first = regions(&plan);
        for edge in plan.edges.hard.ids() {
            let owner = plan.edges.hard[edge].sides[owners.side[edge]].triangle();
            assert_eq!(first[owner], Triangle(0), "the side of the cylinder comes first");
        }
    }

    #[test]
    fn a_region_ends_at_hard_edges() {
        let cube = shapes::plain_cube(1.0);
        let region = regions(&plan_of(&cube, 0.1));
        let expected = (0..12).map(|triangle| Triangle(triangle - triangle % 2));
        assert!(region.iter().copied().eq(expected));
    }

    #[test]
    fn between_two_vertices_both_weigh_their_share() {
        let [a, b] = [Blend::one(3), Blend::one(5)];
        assert_eq!(between(a, b, 0.0), a);
        assert_eq!(between(a, b, 1.0), b);
        let mixed = between(a, b, 0.25);
        let weight_of = |vertex: u32| {
            let pairs = mixed.vertices.into_iter().zip(mixed.weights);
            pairs.filter(|(v, _)| *v == vertex).map(|(_, weight)| weight).sum::<f32>()
        };
        assert_eq!([3, 5].map(weight_of), [0.75, 0.25]);
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
        let weights: Vec<f32> = foot.weights.into_iter().filter(|weight| *weight != 0.0).collect();
        assert!((weights[0] - 0.9).abs() < 1e-6 && (weights[1] - 0.1).abs() < 1e-6, "{foot:?}");
    }
}
