//! Output: the mesh, its provenance, and the verdicts.
//!
//! Source vertices keep their indices and source triangles their order, though a triangle may use
//! an equal vertex in place of its own. What is new is appended, per submesh: strips in the order
//! of their edges, then fills in the order of their rings.

mod collapsed;
mod copies;
mod submeshes;

use crate::attributes::{Attributes, Streams, middles};
use crate::corners::Fill;
use crate::ids::{Edge, IdVec, Ring};
use crate::limits::{self, Limits};
use crate::mesh::MeshBuffers;
use crate::options::ChamferSubmesh;
use crate::plan::Plan;
use crate::report::{Chamfered, TriangleKind, TriangleSource};
use crate::seams::{self, FillLay, FillMap, Owners, StripLay};
use crate::strips::Cut;
use crate::verdicts::{totals, verdicts};
use crate::view::View;

use submeshes::{Submeshes, Triangles};

pub use copies::Copies;

/// The source as it is, for want of hard edges.
pub fn unchanged(view: &View, target: ChamferSubmesh) -> Chamfered {
    let Streams { vertices, sources, .. } = Streams::of_source(view, 0);
    let kind = TriangleKind::Source;
    let mut submesh_index_counts = view.mesh.submesh_index_counts.to_vec();
    if target == ChamferSubmesh::Own {
        submesh_index_counts.push(0);
    }
    Chamfered {
        mesh: MeshBuffers { indices: view.mesh.indices.to_vec(), submesh_index_counts, ..vertices },
        vertex_sources: sources,
        triangle_sources: view.triangles().map(|t| TriangleSource { kind, index: t.0 }).collect(),
        width: view.width as f32,
        ..Chamfered::default()
    }
}

/// The result of all stages.
pub fn output(
    plan: &Plan,
    limits: &Limits,
    cuts: &IdVec<Edge, Cut>,
    mut attributes: Attributes,
    target: ChamferSubmesh,
) -> Chamfered {
    let owners = seams::owners(plan, &limits.placement, cuts, &attributes);
    let copies = Copies::new(plan, &mut attributes);
    if plan.sectors.fans.ids().any(|sector| limits.placement.has_moved(plan, sector)) {
        collapsed::close(plan, &mut attributes.vertex_at);
    }
    let submeshes = Submeshes::of_source(plan, target, &attributes);
    let mut surface = Surface { plan, limits, cuts, owners, attributes, copies, submeshes };
    surface.add_strips();
    surface.add_fills();
    surface.finish()
}

struct Surface<'a> {
    plan: &'a Plan<'a>,
    limits: &'a Limits,
    cuts: &'a IdVec<Edge, Cut>,
    owners: Owners,
    attributes: Attributes,
    copies: Copies,
    submeshes: Submeshes,
}

/// Strips and fills are laid out so many at a time, by all threads, and then added by one: more
/// would only need more memory.
const BATCH: usize = 8192;

/// A fill that is laid out.
struct LaidFill {
    fill: Fill,
    lay: FillLay,
}

impl Surface<'_> {
    fn add_strips(&mut self) {
        let count = self.plan.edges.hard.len();
        for start in (0..count).step_by(BATCH) {
            let size = BATCH.min(count - start);
            let lay = |place: Edge| self.strip(Edge(start as u32 + place.0));
            let laid = self.plan.view.threads.map(size, lay);
            for (edge, lay) in (start as u32..).map(Edge).zip(laid.iter()) {
                if let Some(lay) = lay {
                    self.add_strip(edge, lay);
                }
            }
        }
    }

    fn strip(&self, edge: Edge) -> Option<StripLay> {
        let (plan, cut) = (self.plan, self.cuts[edge]);
        let lay = || {
            seams::strip_lay(
                plan,
                &self.limits.placement,
                &self.attributes,
                &self.owners,
                (edge, cut),
            )
        };
        (cut != Cut::Closed).then(lay)
    }

    fn add_strip(&mut self, edge: Edge, lay: &StripLay) {
        let face = self.plan.edges.hard[edge].sides[self.owners.of(edge)].triangle();
        let vertices = lay.vertices(self.plan, &mut self.attributes.streams, &mut self.copies);
        let source = TriangleSource { kind: TriangleKind::Edge, index: edge.0 };
        for triangle in self.cuts[edge].triangles() {
            self.submeshes.add(face, triangle.map(|place| vertices[place]), source);
        }
    }

    fn add_fills(&mut self) {
        let count = self.plan.sectors.rings.len();
        for start in (0..count).step_by(BATCH) {
            let size = BATCH.min(count - start);
            let lay = |place: Ring| self.fill(Ring(start as u32 + place.0));
            let laid = self.plan.view.threads.map(size, lay);
            for (ring, laid) in (start as u32..).map(Ring).zip(laid.iter()) {
                if let Some(laid) = laid {
                    self.add_fill(ring, laid);
                }
            }
        }
    }

    fn fill(&self, ring: Ring) -> Option<LaidFill> {
        let (plan, placement) = (self.plan, &self.limits.placement);
        // Limits end with fills that are valid, or with rings that did not move.
        let fill = limits::fill(plan, placement, ring).unwrap_or_default();
        if fill.triangles.is_empty() {
            return None;
        }
        let map = FillMap::new(plan, placement, &self.attributes, ring, &fill);
        let lay = map.lay(&self.attributes.streams, &self.owners);
        Some(LaidFill { fill, lay })
    }

    fn add_fill(&mut self, ring: Ring, LaidFill { fill, lay }: &LaidFill) {
        let (plan, copies) = (self.plan, &mut self.copies);
        let streams = &mut self.attributes.streams;
        let sectors = plan.sectors.ring(ring);
        let first = |place: usize| plan.sectors.fans[sectors[place]].first;
        let cluster = plan.topology.cluster_at[first(0)];
        let FillLay { owner, vertices, channels, lay } = lay;
        let mut vertices = vertices.clone();
        if *channels != 0 {
            for (place, foot) in &lay.feet {
                vertices[*place] = copies.get(plan, streams, vertices[*place], foot, *channels);
            }
        }
        for (places, foot) in fill.middles.iter().zip(&lay.middles) {
            let middle = middles::add(plan, &self.limits.placement, streams, sectors, places);
            if *channels != 0 {
                streams.rechart(plan, middle, foot, *channels);
            }
            vertices.push(copies.settle(streams, cluster));
        }
        let at = plan.view.vertex_at(first(0));
        let source = TriangleSource { kind: TriangleKind::Corner, index: at.0 };
        for triangle in &fill.triangles {
            let vertices = triangle.map(|place| vertices[place]);
            self.submeshes.add(first(*owner).triangle(), vertices, source);
        }
    }

    fn finish(self) -> Chamfered {
        let verdicts = verdicts(self.plan, self.limits, self.cuts);
        let Triangles { indices, sources, index_counts } = self.submeshes.joined();
        let streams = self.attributes.streams;
        Chamfered {
            mesh: MeshBuffers { indices, submesh_index_counts: index_counts, ..streams.vertices },
            vertex_sources: streams.sources,
            triangle_sources: sources,
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
