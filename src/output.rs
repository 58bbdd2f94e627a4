//! Output: the mesh and its provenance.
//!
//! Source vertices keep their indices and source triangles their order, though a triangle may use
//! an equal vertex in place of its own. What is new is appended, per submesh: strips in the order
//! of their edges, then fills in the order of their rings. (A large mesh goes block by block: see
//! `blocks`.)
//!
//! Submeshes: which triangles belong to which, and in what order.

use std::ops::Range;

use crate::attributes::Attributes;
use crate::charts::{Chart, Charts};
use crate::error::Error;
use crate::flaps::Flap;
use crate::ids::{Cluster, Corner, Patch, Triangle};
use crate::mesh::MeshBuffers;
use crate::options::ChamferSubmesh;
use crate::patches::{Parts, Patches};
use crate::report::{Chamfered, TriangleKind, TriangleSource, VertexSources};
use crate::resample::blended_normal;
use crate::rounding::{Rounded, Rounding};
use crate::scale::Space;
use crate::view::{View, wide};
use crate::watch::{Times, Watch, each};
use crate::weld::Weld;

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
        hard_angle: view.hard_angle,
        ..Chamfered::default()
    }
}

/// The source with its moved vertices, and all patches; without verdicts.
///
/// # Errors
/// [`Error::Cancelled`] where the watch stops it.
pub fn output(
    space: Space,
    weld: &Weld,
    (patches, rounding): (&Patches, Option<&Rounding>),
    (charts, flaps): (&Charts, &[Flap]),
    attributes: Attributes,
    target: ChamferSubmesh,
    watch: &dyn Watch,
) -> Result<Chamfered, Error> {
    let count = rounding
        .map_or_else(|| patches.triangle_count(), |rounding| rounding.triangle_count(patches));
    let room = count + flaps.len();
    let submeshes = Submeshes::of_source(space.source, target, &attributes, room);
    watch.worked(space.source.corner_count() + room)?;
    let mut result = Made { space, weld, attributes, submeshes, rounding, vertices: Vec::new() };
    let watch = &Times(1 + room / patches.len().max(1), watch);
    each(patches.len(), watch, |patch: Patch| {
        let parts = patches.parts(patch);
        if !parts.triangles.is_empty() {
            let (kind, index) = match patches.edge_or_ring(patch) {
                Ok(edge) => (TriangleKind::Edge, edge.0),
                Err(_) => (TriangleKind::Corner, space.source.vertex_at(parts.joints[0]).0),
            };
            result.add((patch, parts), charts.of(patch), TriangleSource { kind, index });
        }
    })?;
    flaps.iter().for_each(|flap| result.add_flap(flap));
    Ok(result.finish())
}

/// The result in the making.
struct Made<'a> {
    space: Space<'a>,
    weld: &'a Weld,
    attributes: Attributes,
    submeshes: Submeshes,
    rounding: Option<&'a Rounding>,
    /// Those of the points of the patch that is being added.
    vertices: Vec<u32>,
}

impl Made<'_> {
    fn add(&mut self, (patch, parts): (Patch, Parts), chart: Chart, source: TriangleSource) {
        let rounded = self.rounding.and_then(|rounding| rounding.of(patch));
        self.find_vertices((source.kind, rounded), parts, chart);
        let submesh = self.submeshes.of_new(chart.face);
        let triangles = rounded.map_or(parts.triangles, |rounded| rounded.triangles);
        self.submeshes.parts[submesh].add_patch(triangles, &self.vertices, source);
    }

    /// A flap belongs to the face that it continues, whatever becomes of chamfers.
    fn add_flap(&mut self, Flap { joints, place }: &Flap) {
        let space = &self.space;
        let [across, own, end] = joints.map(|joint| self.attributes.vertex_at[joint]);
        let cluster = self.cluster_at(joints[0]);
        let streams = &mut self.attributes.streams;
        let at = wide(streams.vertices.positions[across as usize]);
        let normal = blended_normal(space.source, place);
        let across = streams.add_between(space.source, cluster, (at, normal), (*place, None));
        let (kind, index) = (TriangleKind::Corner, space.source.vertex_at(joints[0]).0);
        let submesh = self.submeshes.of_source_triangle(joints[2].triangle());
        self.submeshes.parts[submesh].add([across, own, end], TriangleSource { kind, index });
    }

    /// Each joint has the vertex of its corner, or a copy of it that takes something from another
    /// chart; middles have vertices of their own.
    fn find_vertices(
        &mut self,
        (kind, rounded): (TriangleKind, Option<Rounded>),
        parts: Parts,
        chart: Chart,
    ) {
        let (source, joints) = (self.space.source, parts.joints);
        self.vertices.clear();
        self.vertices.extend(joints.iter().map(|&joint| self.attributes.vertex_at[joint]));
        for taken_in_turn in chart.in_turn() {
            for (point, taken) in taken_in_turn {
                let Some(&joint) = joints.get(*point as usize) else { continue };
                let (cluster, own) = (self.cluster_at(joint), self.vertices[*point as usize]);
                let streams = &mut self.attributes.streams;
                // A fill often takes what a strip beside it has taken.
                let known = match kind {
                    TriangleKind::Corner => streams.find_copy(cluster, own, taken),
                    _ => None,
                };
                let add = || streams.add_copy(source, cluster, own, taken);
                self.vertices[*point as usize] = known.unwrap_or_else(add);
            }
        }
        if let Some(rounded) = rounded {
            self.find_rounded(rounded, (parts, chart));
            return;
        }
        for (middle, point) in parts.middles.iter().zip(joints.len()..) {
            let (cluster, taken) = (self.cluster_at(joints[0]), chart.taken_at(point));
            let space = &self.space;
            let at = (space.measured.stored(middle.position), space.normal_back(middle.normal));
            let streams = &mut self.attributes.streams;
            self.vertices.push(streams.add_between(source, cluster, at, (middle.near, taken)));
        }
    }

    /// Those of the points of a rounded patch, which follow its joints: first the middles, then what
    /// lies between points that there are by then.
    fn find_rounded(&mut self, rounded: Rounded, (parts, chart): (Parts, Chart)) {
        let (source, first) = (self.space.source, parts.joints.len());
        for (point, at) in rounded.points.iter().zip(first..) {
            let joint = parts.joints.get(point.parents.places[0] as usize);
            let cluster = self.cluster_at(*joint.unwrap_or(&parts.joints[0]));
            let place = (point.position, self.space.normal_back(point.normal));
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
            hard_angle: self.space.measured.hard_angle,
            ..Chamfered::default()
        }
    }
}

/// The triangles of each submesh: its source triangles, then new ones in the order of their coming.
pub struct Submeshes {
    /// `#source submeshes + 1`: the first source triangle of each, and the end.
    starts: Vec<u32>,
    target: ChamferSubmesh,
    parts: Vec<Part>,
}

#[derive(Default)]
struct Part {
    indices: Vec<u32>,
    sources: Vec<TriangleSource>,
}

impl Part {
    /// Some triangles of the source, with room for new ones.
    fn of_source(attributes: &Attributes, triangles: Range<u32>, room: usize) -> Part {
        let count = triangles.len() + room;
        let mut part =
            Part { indices: Vec::with_capacity(3 * count), sources: Vec::with_capacity(count) };
        let corners = triangles.start * 3..triangles.end * 3;
        part.indices.extend_from_slice(attributes.vertex_at.slice(corners));
        let kind = TriangleKind::Source;
        part.sources.extend(triangles.map(|index| TriangleSource { kind, index }));
        part
    }

    fn add(&mut self, vertices: [u32; 3], source: TriangleSource) {
        self.indices.extend_from_slice(&vertices);
        self.sources.push(source);
    }

    /// Adds triangles over some vertices, by their places among these.
    fn add_patch(&mut self, triangles: &[[u32; 3]], vertices: &[u32], source: TriangleSource) {
        for triangle in triangles {
            self.add(triangle.map(|place| vertices[place as usize]), source);
        }
    }
}

/// All triangles, one submesh after the other.
pub struct Triangles {
    /// `#triangles by 3`.
    pub indices: Vec<u32>,
    /// `#triangles`.
    pub sources: Vec<TriangleSource>,
    /// `#submeshes`.
    pub index_counts: Vec<u32>,
}

impl Submeshes {
    /// Those of the source, with the vertices that their corners have now, and room for new
    /// triangles.
    pub fn of_source(
        view: &View,
        target: ChamferSubmesh,
        attributes: &Attributes,
        room: usize,
    ) -> Submeshes {
        let mut starts = vec![0];
        for count in view.mesh.submesh_index_counts {
            starts.push(starts[starts.len() - 1] + count / 3);
        }
        let only = match target {
            ChamferSubmesh::Given(submesh) => submesh as usize,
            ChamferSubmesh::Own => starts.len() - 1,
            // Where several get some, they grow.
            ChamferSubmesh::Owner if starts.len() > 2 => usize::MAX,
            ChamferSubmesh::Owner => 0,
        };
        let part = |(submesh, bounds): (usize, &[u32])| {
            let room = if submesh == only { room } else { 0 };
            Part::of_source(attributes, bounds[0]..bounds[1], room)
        };
        let mut parts: Vec<Part> = starts.windows(2).enumerate().map(part).collect();
        if target == ChamferSubmesh::Own {
            parts.push(Part::of_source(attributes, 0..0, room));
        }
        Submeshes { starts, target, parts }
    }

    fn of_source_triangle(&self, triangle: Triangle) -> usize {
        if let [_, _] = self.starts[..] {
            return 0;
        }
        self.starts.partition_point(|&start| start <= triangle.0) - 1
    }

    /// Where new triangles go whose owner's face is the given one.
    fn of_new(&self, owner: Triangle) -> usize {
        match self.target {
            ChamferSubmesh::Given(submesh) => submesh as usize,
            ChamferSubmesh::Own => self.parts.len() - 1,
            ChamferSubmesh::Owner => self.of_source_triangle(owner),
        }
    }

    /// All triangles, one submesh after the other.
    pub fn joined(self) -> Triangles {
        let index_counts = self.parts.iter().map(|part| part.indices.len() as u32).collect();
        let mut parts = self.parts.into_iter();
        let Part { mut indices, mut sources } = parts.next().unwrap_or_default();
        for part in parts {
            indices.extend(part.indices);
            sources.extend(part.sources);
        }
        Triangles { indices, sources, index_counts }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes;
    use crate::stages::stages_of;
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

    fn submeshes(mesh: &MeshBuffers, target: ChamferSubmesh) -> Submeshes {
        let stages = stages_of(mesh, 0.02);
        let attributes = stages.attributes(&stages.placement());
        Submeshes::of_source(&stages.view, target, &attributes, 0)
    }

    #[test]
    fn new_triangles_go_where_they_are_asked_to() {
        let bolt = shapes::bolt();
        let head = bolt.submesh_index_counts[0] / 3;
        let submesh_of = |target: ChamferSubmesh| {
            let submeshes = submeshes(&bolt, target);
            [0, head - 1, head].map(|triangle| submeshes.of_new(Triangle(triangle)))
        };
        assert_eq!(submesh_of(ChamferSubmesh::Owner), [0, 0, 1]);
        assert_eq!(submesh_of(ChamferSubmesh::Own), [2; 3]);
        assert_eq!(submesh_of(ChamferSubmesh::Given(1)), [1; 3]);
    }

    #[test]
    fn each_submesh_has_its_own_triangles_then_the_new_ones() {
        let bolt = shapes::bolt();
        let [head, shank] = [0, 1].map(|submesh| bolt.submesh_index_counts[submesh]);
        let mut submeshes = submeshes(&bolt, ChamferSubmesh::Own);
        let own = submeshes.of_new(Triangle(0));
        let source = TriangleSource { kind: TriangleKind::Edge, index: 5 };
        submeshes.parts[own].add([7, 8, 9], source);
        let triangles = submeshes.joined();
        assert_eq!(triangles.index_counts, [head, shank, 3]);
        assert_eq!(triangles.indices[(head + shank) as usize..], [7, 8, 9]);
        assert!(triangles.sources[0].kind == TriangleKind::Source);
    }
}
