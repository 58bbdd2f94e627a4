//! Output: the mesh, its provenance, and the verdicts.
//!
//! Source vertices keep their indices and source triangles their order, though a triangle may use
//! an equal vertex in place of its own. What is new is appended, per submesh: strips in the order
//! of their edges, then fills in the order of their rings.

mod submeshes;

use crate::attributes::{Attributes, middles};
use crate::fills::MIDDLE_FROM;
use crate::ids::{Edge, IdVec, Ring};
use crate::limits::{self, Limits};
use crate::mesh::MeshBuffers;
use crate::options::ChamferSubmesh;
use crate::plan::Plan;
use crate::report::{Chamfered, TriangleKind, TriangleSource, VertexSources};
use crate::seams::{self, Joint, Middle, Owners, Parts, Patches};
use crate::strips::Cut;
use crate::verdicts::{totals, verdicts};
use crate::view::View;

use submeshes::{Submeshes, Triangles};

/// The source as it is, for want of hard edges.
pub fn unchanged(view: &View, target: ChamferSubmesh) -> Chamfered {
    let kind = TriangleKind::Source;
    let mut mesh = view.mesh.to_buffers();
    if target == ChamferSubmesh::Own {
        mesh.submesh_index_counts.push(0);
    }
    Chamfered {
        vertex_sources: VertexSources::of_source(mesh.positions.len()),
        triangle_sources: view.triangles().map(|t| TriangleSource { kind, index: t.0 }).collect(),
        mesh,
        width: view.width as f32,
        ..Chamfered::default()
    }
}

/// The result of all stages.
pub fn output(
    plan: &Plan,
    limits: &Limits,
    cuts: &IdVec<Edge, Cut>,
    attributes: Attributes,
    target: ChamferSubmesh,
) -> Chamfered {
    let owners = seams::owners(plan, &limits.placement, cuts, &attributes);
    let room = most_new_triangles(plan, cuts);
    let submeshes = Submeshes::of_source(plan, target, &attributes, room);
    let mut surface = Surface { plan, limits, cuts, owners, attributes, submeshes };
    surface.add_strips();
    surface.add_fills();
    surface.finish()
}

/// How many triangles strips and fills have at most.
fn most_new_triangles(plan: &Plan, cuts: &IdVec<Edge, Cut>) -> usize {
    let of_strips: usize = cuts.iter().map(|cut| cut.triangles().len()).sum();
    let of_fill = |ring: Ring| match plan.sectors.ring(ring).len() {
        0..=2 => 0,
        sectors if sectors < MIDDLE_FROM => sectors - 2,
        sectors => sectors,
    };
    of_strips + plan.sectors.rings.ids().map(of_fill).sum::<usize>()
}

struct Surface<'a> {
    plan: &'a Plan<'a>,
    limits: &'a Limits,
    cuts: &'a IdVec<Edge, Cut>,
    owners: Owners,
    attributes: Attributes,
    submeshes: Submeshes,
}

impl Surface<'_> {
    fn add_strips(&mut self) {
        let (threads, count) = (&self.plan.view.threads, self.cuts.len());
        threads.blocks_then(count, self, Surface::lay_strip, Surface::add);
    }

    fn add_fills(&mut self) {
        let (threads, count) = (&self.plan.view.threads, self.plan.sectors.rings.len());
        threads.blocks_then(count, self, Surface::lay_fill, Surface::add);
    }

    fn lay_strip(&self, edge: Edge, patches: &mut Patches) {
        let cut = self.cuts[edge];
        if cut != Cut::Closed {
            let (placement, attributes) = (&self.limits.placement, &self.attributes);
            let strip = (edge, cut);
            seams::add_strip(self.plan, placement, attributes, &self.owners, strip, patches);
        }
    }

    fn lay_fill(&self, ring: Ring, patches: &mut Patches) {
        let (placement, attributes) = (&self.limits.placement, &self.attributes);
        // Limits end with fills that are valid, or with rings that did not move.
        if let Some(fill) = limits::fill(self.plan, placement, ring)
            && !fill.triangles.is_empty()
        {
            let fill = (ring, &fill);
            seams::add_fill(self.plan, placement, attributes, &self.owners, fill, patches);
        }
    }

    fn add(&mut self, patches: &mut Patches) {
        let mut vertices = Vec::new();
        for parts in patches.iter() {
            let own = |joint: &Joint| self.attributes.vertex_at[joint.corner];
            vertices.clear();
            vertices.extend(parts.joints.iter().map(own));
            self.copy(&parts, &mut vertices);
            for middle in parts.middles {
                vertices.push(self.add_middle(&parts, middle));
            }
            for triangle in parts.triangles {
                let vertices = triangle.map(|place| vertices[place as usize]);
                self.submeshes.add(parts.patch.face, vertices, parts.patch.source);
            }
        }
        patches.clear();
    }

    /// Puts copies in the place of vertices that take something from another chart.
    fn copy(&mut self, Parts { patch, joints, .. }: &Parts, vertices: &mut [u32]) {
        let begin = patch.begin as usize;
        for place in (begin..joints.len()).chain(0..begin) {
            if let Joint { corner, taken: Some(taken) } = &joints[place] {
                let cluster = self.plan.topology.cluster_at[*corner];
                let (streams, own) = (&mut self.attributes.streams, vertices[place]);
                vertices[place] = streams.add_copy(self.plan, cluster, own, taken);
            }
        }
    }

    fn add_middle(&mut self, parts: &Parts, middle: &Middle) -> u32 {
        let (plan, streams) = (self.plan, &mut self.attributes.streams);
        let corner = parts.joints[0].corner;
        let sectors = plan.sectors.ring(plan.sectors.fans[plan.sectors.sector_of[corner]].ring);
        let (placement, taken) = (&self.limits.placement, middle.taken.as_ref());
        middles::add(plan, placement, streams, sectors, &middle.joints, taken)
    }

    fn finish(self) -> Chamfered {
        let verdicts = verdicts(self.plan, self.limits, self.cuts);
        let Triangles { indices, sources, index_counts } = self.submeshes.joined();
        let streams = self.attributes.streams;
        Chamfered {
            mesh: MeshBuffers { indices, submesh_index_counts: index_counts, ..streams.vertices },
            vertex_sources: streams.sources,
            triangle_sources: sources,
            pieces: Vec::new(),
            totals: totals(self.plan, &verdicts),
            verdicts,
            width: self.plan.view.width as f32,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes;

    #[test]
    fn strips_stand_before_fills_in_the_order_of_their_edges() {
        let cube = shapes::plain_cube(1.0);
        let options = crate::Options { width: crate::Width::Units(0.1), ..Default::default() };
        let result = crate::chamfer(&cube.as_mesh(), &options).unwrap();
        let kinds: Vec<TriangleKind> = result.triangle_sources.iter().map(|s| s.kind).collect();
        assert!(kinds.is_sorted_by_key(|&kind| kind as u32));
        let edges = result.triangle_sources.iter().filter(|s| s.kind == TriangleKind::Edge);
        assert!(edges.map(|source| source.index).is_sorted());
    }
}
