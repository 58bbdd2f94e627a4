//! Output: the mesh, its provenance, and the verdicts.
//!
//! Source vertices keep their indices and source triangles their order; what is new is appended,
//! per submesh: strips in the order of their edges, then fills in the order of their rings.

mod collapsed;
mod duplicates;

use crate::attributes::{Attributes, middles};
use crate::ids::{Corner, Edge, Ring, Triangle};
use crate::limits::{self, Limits};
use crate::mesh::MeshBuffers;
use crate::options::ChamferSubmesh;
use crate::plan::Plan;
use crate::report::{Chamfered, TriangleKind, TriangleSource};
use crate::seams::{self, Copies, FillLay, FillMap, Owners};
use crate::strips;
use crate::verdicts::{totals, verdicts};

/// The result of all stages.
pub fn output(
    plan: &Plan,
    limits: &Limits,
    attributes: Attributes,
    target: ChamferSubmesh,
) -> Chamfered {
    let owners = seams::owners(plan, &limits.placement, &attributes);
    let mut surface = Surface {
        plan,
        limits,
        owners,
        attributes,
        copies: Copies::default(),
        submeshes: Submeshes::new(plan, target),
        new: Vec::new(),
    };
    if plan.sectors.fans.ids().any(|sector| limits.placement.has_moved(plan, sector)) {
        collapsed::close(plan, &mut surface.attributes.vertex_at);
    }
    plan.edges.hard.ids().for_each(|edge| surface.add_strip(edge));
    plan.sectors.rings.ids().for_each(|ring| surface.add_fill(ring));
    surface.finish()
}

/// A new triangle and the submesh that it goes to.
struct NewTriangle {
    submesh: u32,
    vertices: [u32; 3],
    source: TriangleSource,
}

struct Surface<'a> {
    plan: &'a Plan<'a>,
    limits: &'a Limits,
    owners: Owners,
    attributes: Attributes,
    copies: Copies,
    submeshes: Submeshes,
    new: Vec<NewTriangle>,
}

impl Surface<'_> {
    fn add_strip(&mut self, edge: Edge) {
        let (plan, placement) = (self.plan, &self.limits.placement);
        let hard = &plan.edges.hard[edge];
        if hard.skipped.is_some() {
            return;
        }
        let cut = strips::cut(&strips::quad(plan, placement, hard));
        if cut.is_empty() {
            return;
        }
        let owner = self.owners.side[edge];
        let vertices = seams::strip_vertices(
            plan,
            placement,
            owner,
            hard,
            &mut self.attributes,
            &mut self.copies,
        );
        let source = TriangleSource { kind: TriangleKind::Edge, index: edge.0 };
        let submesh = self.submeshes.for_new(hard.sides[owner].triangle());
        self.new.extend(cut.iter().map(|triangle| NewTriangle {
            submesh,
            vertices: triangle.map(|place| vertices[place]),
            source,
        }));
    }

    fn add_fill(&mut self, ring: Ring) {
        let (plan, placement) = (self.plan, &self.limits.placement);
        // Limits end with fills that are valid, or with rings that did not move.
        let fill = limits::fill(plan, placement, ring).unwrap_or_default();
        if fill.triangles.is_empty() {
            return;
        }
        let sectors = plan.sectors.ring(ring);
        let map = FillMap::new(plan, placement, &self.attributes, ring, &fill);
        let streams = &mut self.attributes.streams;
        let FillLay { owner, channels, lay } = map.lay(streams, &self.owners);
        let mut vertices = map.vertices.clone();
        if channels != 0 {
            for (place, foot) in &lay.feet {
                let copies = &mut self.copies;
                vertices[*place] = copies.get(plan, streams, vertices[*place], foot, channels);
            }
        }
        for (places, foot) in fill.middles.iter().zip(&lay.middles) {
            vertices.push(middles::add(plan, placement, streams, sectors, places));
            streams.rechart(plan, vertices[vertices.len() - 1], foot, channels);
        }
        let first = plan.sectors.fans[sectors[owner]].first;
        let submesh = self.submeshes.for_new(first.triangle());
        let at = plan.view.vertex_at(plan.sectors.fans[sectors[0]].first);
        let source = TriangleSource { kind: TriangleKind::Corner, index: at.0 };
        self.new.extend(fill.triangles.iter().map(|triangle| NewTriangle {
            submesh,
            vertices: triangle.map(|place| vertices[place]),
            source,
        }));
    }

    fn finish(self) -> Chamfered {
        let verdicts = verdicts(self.plan, self.limits);
        let (mut indices, triangle_sources, submesh_index_counts) = self.triangles();
        let mut streams = self.attributes.streams;
        duplicates::join(&mut streams, self.plan.view.mesh.positions.len(), &mut indices);
        Chamfered {
            mesh: MeshBuffers { indices, submesh_index_counts, ..streams.vertices },
            vertex_sources: streams.sources,
            triangle_sources,
            totals: totals(self.plan, &verdicts),
            verdicts,
            width: self.plan.view.width as f32,
        }
    }

    fn triangles(&self) -> (Vec<u32>, Vec<TriangleSource>, Vec<u32>) {
        let mut indices = Vec::with_capacity(self.plan.view.corner_count() + self.new.len() * 3);
        let mut sources = Vec::with_capacity(indices.capacity() / 3);
        let mut counts = Vec::with_capacity(self.submeshes.count());
        let new_of = by_submesh(&self.new, self.submeshes.count());
        for (submesh, new) in new_of.iter().enumerate() {
            let before = indices.len();
            for triangle in self.submeshes.source_triangles(submesh) {
                indices.extend(triangle.corners().map(|c: Corner| self.attributes.vertex_at[c]));
                sources.push(TriangleSource { kind: TriangleKind::Source, index: triangle.0 });
            }
            for &place in new {
                indices.extend(self.new[place].vertices);
                sources.push(self.new[place].source);
            }
            counts.push((indices.len() - before) as u32);
        }
        (indices, sources, counts)
    }
}

/// The places of new triangles, for each submesh.
fn by_submesh(new: &[NewTriangle], submeshes: usize) -> Vec<Vec<usize>> {
    let mut places = vec![Vec::new(); submeshes];
    for (place, triangle) in new.iter().enumerate() {
        places[triangle.submesh as usize].push(place);
    }
    places
}

/// Which triangles belong to which submesh.
struct Submeshes {
    /// `#source submeshes + 1`: the first triangle of each, and the end.
    starts: Vec<u32>,
    target: ChamferSubmesh,
}

impl Submeshes {
    fn new(plan: &Plan, target: ChamferSubmesh) -> Submeshes {
        let mut starts = vec![0];
        for count in plan.view.mesh.submesh_index_counts {
            starts.push(starts[starts.len() - 1] + count / 3);
        }
        Submeshes { starts, target }
    }

    fn sources(&self) -> usize {
        self.starts.len() - 1
    }

    fn count(&self) -> usize {
        self.sources() + usize::from(self.target == ChamferSubmesh::Own)
    }

    fn source_triangles(&self, submesh: usize) -> impl Iterator<Item = Triangle> + use<> {
        let bounds = self.starts.get(submesh).zip(self.starts.get(submesh + 1));
        let (from, to) = bounds.map_or((0, 0), |(&from, &to)| (from, to));
        (from..to).map(Triangle)
    }

    /// Where a new triangle goes whose owner's face is the given one.
    fn for_new(&self, owner: Triangle) -> u32 {
        match self.target {
            ChamferSubmesh::Given(submesh) => submesh,
            ChamferSubmesh::Own => self.sources() as u32,
            ChamferSubmesh::Owner => {
                self.starts.partition_point(|&start| start <= owner.0) as u32 - 1
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::tests::plan_of;
    use crate::shapes;

    #[test]
    fn new_triangles_go_where_they_are_asked_to() {
        let bolt = shapes::bolt();
        let plan = plan_of(&bolt, 0.02);
        let head = bolt.submesh_index_counts[0] / 3;
        let submesh_of = |target: ChamferSubmesh| {
            let submeshes = Submeshes::new(&plan, target);
            [0, head - 1, head].map(|triangle| submeshes.for_new(Triangle(triangle)))
        };
        assert_eq!(submesh_of(ChamferSubmesh::Owner), [0, 0, 1]);
        assert_eq!(submesh_of(ChamferSubmesh::Own), [2; 3]);
        assert_eq!(submesh_of(ChamferSubmesh::Given(1)), [1; 3]);
    }

    #[test]
    fn each_submesh_has_its_own_triangles_and_a_new_one_has_none() {
        let bolt = shapes::bolt();
        let plan = plan_of(&bolt, 0.02);
        let submeshes = Submeshes::new(&plan, ChamferSubmesh::Own);
        let counts = [0, 1, 2].map(|submesh| submeshes.source_triangles(submesh).count() as u32);
        let [head, shank] = [0, 1].map(|submesh| bolt.submesh_index_counts[submesh] / 3);
        assert_eq!((submeshes.count(), counts), (3, [head, shank, 0]));
    }

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
