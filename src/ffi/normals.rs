//! Normals by smoothing angle for a caller's whole mesh: every stream follows its split vertices.

use super::status::Failure;
use super::types::CHAMFER_STATUS_BAD_ANGLE;
use crate::memory;
use crate::view::{check_finite, check_indices};
use crate::{
    Blend, Chamfered, Mesh, MeshBuffers, Smoothed, TriangleKind, TriangleSource, Uv, UvBuffer,
    VertexSource, split_by_angle,
};

/// The mesh with new normals, its vertices split where they differ, and where each came from.
pub fn with_normals(mesh: &Mesh, angle_degrees: f32) -> Result<Chamfered, Failure> {
    if !(0.0..=180.0).contains(&angle_degrees) {
        return Err(Failure::new(
            CHAMFER_STATUS_BAD_ANGLE,
            format!("the smoothing angle is {angle_degrees}: give 0 to 180 degrees"),
        ));
    }
    // `split_by_angle` takes positions and indices on trust.
    check_indices(mesh)?;
    // Its normals are ignored, whatever they are; all else goes out again.
    check_finite(&Mesh { normals: &[], ..*mesh })?;
    memory::ask(memory::of_normals(mesh))?;
    let smoothed = split_by_angle(mesh.positions, mesh.indices, angle_degrees);
    let triangles = smoothed.indices.len() as u32 / 3;
    Ok(Chamfered {
        vertex_sources: smoothed.source_of.iter().map(|&v| copy_of(v)).collect(),
        triangle_sources: (0..triangles)
            .map(|index| TriangleSource { kind: TriangleKind::Source, index })
            .collect(),
        mesh: gather(mesh, smoothed),
        ..Chamfered::default()
    })
}

fn copy_of(vertex: u32) -> VertexSource {
    VertexSource::new(Blend::one(vertex), Blend::one(vertex))
}

fn gather(mesh: &Mesh, smoothed: Smoothed) -> MeshBuffers {
    let source_of = &smoothed.source_of;
    MeshBuffers {
        positions: gather_stream(mesh.positions, source_of, 1),
        tangents: gather_stream(mesh.tangents, source_of, 1),
        colors: gather_stream(mesh.colors, source_of, 1),
        uvs: mesh.uvs.map(|uv| gather_uv(uv, source_of)),
        normals: smoothed.normals,
        indices: smoothed.indices,
        submesh_index_counts: mesh.submesh_index_counts.to_vec(),
    }
}

fn gather_uv(uv: Uv, source_of: &[u32]) -> UvBuffer {
    let values = gather_stream(uv.values, source_of, uv.components as usize);
    UvBuffer { components: uv.components, values }
}

/// `source_of: #vertices`; the values are `#source vertices by width`, or none.
fn gather_stream<T: Copy>(values: &[T], source_of: &[u32], width: usize) -> Vec<T> {
    if values.is_empty() {
        return Vec::new();
    }
    let rows = source_of.iter().flat_map(|&v| &values[v as usize * width..][..width]);
    rows.copied().collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn streams_follow_their_vertices() {
        assert_eq!(gather_stream(&[1, 2, 3, 4], &[1, 0, 1], 2), [3, 4, 1, 2, 3, 4]);
        assert_eq!(gather_stream(&[0; 0], &[1, 0, 1], 2), [0; 0]);
    }
}
