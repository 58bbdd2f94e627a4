//! STUB, to be replaced by the shape builders when those are merged.

use crate::mesh::MeshBuffers;

/// STUB: one square.
pub fn demo_models() -> Vec<(&'static str, MeshBuffers)> {
    let square = MeshBuffers {
        positions: vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]],
        normals: vec![[0.0, 0.0, 1.0]; 4],
        indices: vec![0, 1, 2, 0, 2, 3],
        submesh_index_counts: vec![6],
        ..MeshBuffers::default()
    };
    vec![("square", square)]
}
