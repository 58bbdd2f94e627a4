//! Output: the mesh and its provenance.
//!
//! Source vertices keep their indices and source triangles their order, though a triangle may use
//! an equal vertex in place of its own. What is new is appended, per submesh: strips in the order
//! of their edges, then fills in the order of their rings. (A large mesh goes block by block: see
//! `blocks`.)

mod submeshes;

use crate::attributes::Attributes;
use crate::charts::{Chart, Charts};
use crate::flaps::Flap;
use crate::ids::{Cluster, Corner, Id, Patch};
use crate::mesh::MeshBuffers;
use crate::options::ChamferSubmesh;
use crate::patches::{Parts, Patches};
use crate::report::{Chamfered, TriangleKind, TriangleSource, VertexSources};
use crate::resample::blended_normal;
use crate::rounding::{Rounded, Rounding};
use crate::scale::Space;
use crate::view::{View, wide};
use crate::weld::Weld;

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
        largest_width: view.width as f32,
        ..Chamfered::default()
    }
}

/// The source with its moved vertices, and all patches; without verdicts.
pub fn output(
    space: Space,
    weld: &Weld,
    (patches, rounding): (&Patches, Option<&Rounding>),
    (charts, flaps): (&Charts, &[Flap]),
    attributes: Attributes,
    target: ChamferSubmesh,
) -> Chamfered {
    let count = rounding
        .map_or_else(|| patches.triangle_count(), |rounding| rounding.triangle_count(patches));
    let room = count + flaps.len();
    let submeshes = Submeshes::of_source(space.source, target, &attributes, room);
    let mut result = Result { space, weld, attributes, submeshes, rounding, vertices: Vec::new() };
    for patch in (0..patches.len()).map(Patch::new) {
        if !patches.parts(patch).triangles.is_empty() {
            result.add(patches, charts, patch);
        }
    }
    flaps.iter().for_each(|flap| result.add_flap(flap));
    result.finish()
}

/// The result in the making.
struct Result<'a> {
    space: Space<'a>,
    weld: &'a Weld,
    attributes: Attributes,
    submeshes: Submeshes,
    rounding: Option<&'a Rounding>,
    /// Those of the points of the patch that is being added.
    vertices: Vec<u32>,
}

impl Result<'_> {
    fn add(&mut self, patches: &Patches, charts: &Charts, patch: Patch) {
        self.find_vertices(patches, charts, patch);
        let parts = patches.parts(patch);
        let (kind, index) = match patches.edge_or_ring(patch) {
            Ok(edge) => (TriangleKind::Edge, edge.0),
            Err(_) => (TriangleKind::Corner, self.space.source.vertex_at(parts.joints[0]).0),
        };
        let face = charts.of(patch).face;
        let rounded = self.rounding.and_then(|rounding| rounding.of(patch));
        for triangle in rounded.map_or(parts.triangles, |rounded| rounded.triangles) {
            let vertices = triangle.map(|place| self.vertices[place as usize]);
            self.submeshes.add(face, vertices, TriangleSource { kind, index });
        }
    }

    /// A flap belongs to the face that it continues, whatever becomes of chamfers.
    fn add_flap(&mut self, Flap { joints, place }: &Flap) {
        let space = self.space;
        let [across, own, end] = joints.map(|joint| self.attributes.vertex_at[joint]);
        let cluster = self.cluster_at(joints[0]);
        let streams = &mut self.attributes.streams;
        let at = wide(streams.vertices.positions[across as usize]);
        let normal = blended_normal(space.source, place);
        let across = streams.add_between(space.source, cluster, (at, normal), (*place, None));
        let (kind, index) = (TriangleKind::Corner, space.source.vertex_at(joints[0]).0);
        let face = joints[2].triangle();
        self.submeshes.add_beside(face, [across, own, end], TriangleSource { kind, index });
    }

    /// Each joint has the vertex of its corner, or a copy of it that takes something from another
    /// chart; middles have vertices of their own.
    fn find_vertices(&mut self, patches: &Patches, charts: &Charts, patch: Patch) {
        let (parts, chart) = (patches.parts(patch), charts.of(patch));
        let (space, joints) = (self.space, parts.joints);
        self.vertices.clear();
        self.vertices.extend(joints.iter().map(|&joint| self.attributes.vertex_at[joint]));
        for point in (chart.begin..joints.len()).chain(0..chart.begin) {
            if let Some(taken) = chart.taken_at(point) {
                let (cluster, own) = (self.cluster_at(joints[point]), self.vertices[point]);
                let streams = &mut self.attributes.streams;
                self.vertices[point] = streams.add_copy(space.source, cluster, own, taken);
            }
        }
        if let Some(rounded) = self.rounding.and_then(|rounding| rounding.of(patch)) {
            self.find_rounded(rounded, (parts, chart));
            return;
        }
        for (middle, point) in parts.middles.iter().zip(joints.len()..) {
            let (cluster, taken) = (self.cluster_at(joints[0]), chart.taken_at(point));
            let at = (space.back(middle.position), space.normal_back(middle.normal));
            let streams = &mut self.attributes.streams;
            self.vertices.push(streams.add_between(
                space.source,
                cluster,
                at,
                (middle.near, taken),
            ));
        }
    }

    /// Those of the points of a rounded patch, which follow its joints: first the middles, then what
    /// lies between points that there are by then.
    fn find_rounded(&mut self, rounded: Rounded, (parts, chart): (Parts, Chart)) {
        let (source, first) = (self.space.source, parts.joints.len());
        for (point, at) in rounded.points.iter().zip(first..) {
            let joint = parts.joints.get(point.parents.places[0] as usize);
            let cluster = self.cluster_at(*joint.unwrap_or(&parts.joints[0]));
            let place = (self.space.back(point.position), self.space.normal_back(point.normal));
            let streams = &mut self.attributes.streams;
            self.vertices.push(if at < first + parts.middles.len() {
                streams.add_between(source, cluster, place, (point.near, chart.taken_at(at)))
            } else {
                let parents = point.parents.places.map(|place| self.vertices[place as usize]);
                let rounded = (point.near, parents, point.parents.weights, point.is_shared);
                streams.add_rounded(cluster, place, rounded)
            });
        }
    }

    fn cluster_at(&self, corner: Corner) -> Cluster {
        self.weld.cluster_of[self.space.source.vertex_at(corner)]
    }

    fn finish(self) -> Chamfered {
        let Triangles { indices, sources, index_counts } = self.submeshes.joined();
        let streams = self.attributes.streams;
        Chamfered {
            mesh: MeshBuffers { indices, submesh_index_counts: index_counts, ..streams.vertices },
            vertex_sources: streams.sources,
            triangle_sources: sources,
            width: self.space.measured.width as f32,
            ..Chamfered::default()
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
