//! Seams: whose texture a chamfer continues (thesis 6.4).
//!
//! Where a UV channel differs across a hard edge, the chamfer belongs to one side's chart, its
//! owner. The owner's chart has a free band between the pulled edge and the old one, and the
//! strip is mapped onto exactly that: its far side lands on the old edge. The owner also gives the
//! strip its submesh.

mod density;
mod feet;
mod fill_map;
mod ground;
mod owners;
mod strip_map;

use std::collections::HashMap;

use glam::DVec2;

use crate::attributes::Streams;
use crate::edges::HardEdge;
use crate::ids::{Corner, Id, Vertex};
use crate::mesh::UV_CHANNELS;
use crate::plan::Plan;
use crate::report::Blend;
use crate::resample::uv_at;

use density::uv_point;

pub use fill_map::{FillLay, FillMap};
pub use owners::{Owners, owners};
pub use strip_map::strip_vertices;

/// UV values that differ by less than this share of their size are one: exporters round.
const EQUAL_UV: f32 = 1e-6;

/// The channels that differ across an edge, as bits.
pub fn seam_channels(plan: &Plan, edge: &HardEdge) -> u8 {
    let [one, two] = edge.sides;
    let pairs = [(one, two.next()), (one.next(), two)];
    let differs = |channel: &usize| {
        pairs.into_iter().any(|(one, other)| seam_between(plan, *channel, one, other))
    };
    channels_of(plan).filter(differs).fold(0, |channels, channel| channels | 1 << channel)
}

/// Whether two corners at one position differ in a UV channel.
fn seam_between(plan: &Plan, channel: usize, one: Corner, other: Corner) -> bool {
    let uv = &plan.view.mesh.uvs[channel];
    let [one, other] = [one, other].map(|corner| uv_at(uv, plan.view.vertex_at(corner).index()));
    one.iter().zip(other).any(|(&a, &b)| (a - b).abs() > EQUAL_UV * a.abs().max(1.0))
}

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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::attributes::attributes;
    use crate::ids::Triangle;
    use crate::limits::limits;
    use crate::options::Verify;
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
        let placement = limits(&plan, Verify::Fast).placement;
        let owners = owners(&plan, &placement, &attributes(&plan, &placement));
        for edge in plan.edges.hard.ids() {
            let owner = plan.edges.hard[edge].sides[owners.side[edge]].triangle();
            assert!(owner < Triangle(24), "the side of the cylinder comes first");
        }
    }
}
