//! Cut: a block as a mesh of its own.

use super::Blocks;
use crate::ids::{Id, Vertex};
use crate::mesh::{MeshBuffers, Uv, UvBuffer};
use crate::view::View;

/// A block of a mesh, with all submeshes that the mesh has.
pub fn cut(view: &View, blocks: &Blocks, block: usize) -> MeshBuffers {
    let (mesh, vertices) = (&view.mesh, blocks.vertices.of(block));
    let uv = |uv: &Uv| UvBuffer {
        components: uv.components,
        values: values_of(uv.values, uv.components as usize, vertices),
    };
    let triangles = blocks.triangles.of(block);
    let corners = triangles.iter().flat_map(|triangle| triangle.corners());
    let counts = triangle_counts(view, blocks, block).into_iter();
    MeshBuffers {
        positions: of(mesh.positions, vertices),
        normals: of(mesh.normals, vertices),
        tangents: of(mesh.tangents, vertices),
        colors: of(mesh.colors, vertices),
        uvs: mesh.uvs.each_ref().map(uv),
        indices: corners.map(|corner| blocks.place[view.vertex_at(corner)]).collect(),
        submesh_index_counts: counts.map(|count| 3 * count).collect(),
    }
}

/// `#submeshes`: how many triangles of a block belong to each.
pub fn triangle_counts(view: &View, blocks: &Blocks, block: usize) -> Vec<u32> {
    let (mut triangles, mut end) = (blocks.triangles.of(block), 0);
    let count = |indices: &u32| {
        end += indices / 3;
        let (own, rest) = triangles.split_at(triangles.partition_point(|t| t.0 < end));
        triangles = rest;
        own.len() as u32
    };
    view.mesh.submesh_index_counts.iter().map(count).collect()
}

/// The values of some vertices; an absent stream stays absent.
fn of<T: Copy>(values: &[T], vertices: &[Vertex]) -> Vec<T> {
    let present = if values.is_empty() { &[] } else { vertices };
    present.iter().map(|vertex| values[vertex.index()]).collect()
}

fn values_of(values: &[f32], components: usize, vertices: &[Vertex]) -> Vec<f32> {
    let present = if components == 0 { &[] } else { vertices };
    let range = |vertex: &Vertex| vertex.index() * components..(vertex.index() + 1) * components;
    let mut own = Vec::with_capacity(present.len() * components);
    present.iter().for_each(|vertex| own.extend_from_slice(&values[range(vertex)]));
    own
}
