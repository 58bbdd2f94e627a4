//! Seams: whose texture a chamfer continues (thesis 6.4).
//!
//! Where a UV channel differs across a hard edge, the chamfer belongs to one side's chart, its
//! owner. The owner's chart has a free band between the pulled edge and the old one, and the
//! strip is mapped onto exactly that: its far side lands on the old edge. The owner also gives the
//! strip its submesh.

mod density;
mod feet;
mod fill_map;
mod fit;
mod ground;
mod owners;
mod patch;
mod strip_map;

use glam::DVec2;

use crate::mesh::UV_CHANNELS;
use crate::plan::Plan;
use crate::report::Blend;

use density::uv_point;

pub use fill_map::add_fill;
pub use owners::{Owners, owners};
pub use patch::{Joint, Middle, Parts, Patches};
pub use strip_map::add_strip;

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
        let placement = limits(&plan, Verify::Fast).unwrap().placement;
        let cuts = strips(&plan, &placement);
        let owners = owners(&plan, &placement, &cuts, &attributes(&plan, &placement));
        for edge in plan.edges.hard.ids() {
            let owner = plan.edges.hard[edge].sides[owners.of(edge)].triangle();
            assert!(owner < Triangle(24), "the side of the cylinder comes first");
        }
    }
}
