//! Meshes from plain points and triangles, with normals by smoothing angle.

use chamfer::{MeshBuffers, split_by_angle};

/// Faces that meet at more than this, in degrees, are flat-shaded.
pub const FLAT: f32 = 1.0;

/// A mesh of one submesh over `#vertices by 3` points and `#triangles by 3` indices. Faces that
/// meet at up to `degrees` shade as one.
pub fn shaded(points: &[[f32; 3]], indices: &[u32], degrees: f32) -> MeshBuffers {
    let smoothed = split_by_angle(points, indices, degrees).unwrap();
    MeshBuffers {
        positions: smoothed.source_of.iter().map(|&point| points[point as usize]).collect(),
        normals: smoothed.normals,
        submesh_index_counts: vec![indices.len() as u32],
        indices: smoothed.indices,
        ..MeshBuffers::default()
    }
}
