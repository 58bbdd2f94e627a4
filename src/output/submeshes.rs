//! Submeshes: which triangles belong to which, and in what order.

use std::ops::Range;

use crate::attributes::Attributes;
use crate::ids::Triangle;
use crate::options::ChamferSubmesh;
use crate::report::{TriangleKind, TriangleSource};
use crate::view::View;

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

    /// Adds a new triangle whose owner's face is the given one.
    pub fn add(&mut self, owner: Triangle, vertices: [u32; 3], source: TriangleSource) {
        let submesh = self.of_new(owner);
        self.parts[submesh].indices.extend_from_slice(&vertices);
        self.parts[submesh].sources.push(source);
    }

    /// Adds a new triangle to the submesh of a face.
    pub fn add_beside(&mut self, face: Triangle, vertices: [u32; 3], source: TriangleSource) {
        let submesh = self.of_source_triangle(face);
        self.parts[submesh].indices.extend_from_slice(&vertices);
        self.parts[submesh].sources.push(source);
    }

    fn of_source_triangle(&self, triangle: Triangle) -> usize {
        self.starts.partition_point(|&start| start <= triangle.0) - 1
    }

    /// Where a new triangle goes whose owner's face is the given one.
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
    use crate::mesh::MeshBuffers;
    use crate::shapes;
    use crate::stages::stages_of;

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
        submeshes.add(
            Triangle(0),
            [7, 8, 9],
            TriangleSource { kind: TriangleKind::Edge, index: 5 },
        );
        let triangles = submeshes.joined();
        assert_eq!(triangles.index_counts, [head, shank, 3]);
        assert_eq!(triangles.indices[(head + shank) as usize..], [7, 8, 9]);
        assert!(triangles.sources[0].kind == TriangleKind::Source);
    }
}
