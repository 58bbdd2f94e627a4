//! Meshes from plain points and triangles, with normals by smoothing angle.

use chamfer::{MeshBuffers, split_by_angle};

/// Faces that meet at more than this, in degrees, are flat-shaded.
pub const FLAT: f32 = 1.0;

/// A mesh of one submesh over `#vertices by 3` points and `#triangles by 3` indices. Faces that
/// meet at up to `degrees` shade as one.
pub fn shaded(points: &[[f32; 3]], indices: &[u32], degrees: f32) -> MeshBuffers {
    let smoothed = split_by_angle(points, indices, degrees);
    MeshBuffers {
        positions: smoothed.source_of.iter().map(|&point| points[point as usize]).collect(),
        normals: smoothed.normals,
        submesh_index_counts: vec![indices.len() as u32],
        indices: smoothed.indices,
        ..MeshBuffers::default()
    }
}

/// A flat-shaded prism along z over an outline that runs counter-clockwise seen from +z. `cap`
/// are the triangles of its top, counter-clockwise too.
pub fn prism(outline: &[[f32; 2]], cap: &[[u32; 3]], height: f32) -> MeshBuffers {
    let count = outline.len() as u32;
    let at = |z: f32| outline.iter().map(move |&[x, y]| [x, y, z]);
    let points: Vec<[f32; 3]> = at(0.0).chain(at(height)).collect();
    let mut indices: Vec<u32> = Vec::new();
    for &[a, b, c] in cap {
        indices.extend([a + count, b + count, c + count, a, c, b]);
    }
    for a in 0..count {
        let b = (a + 1) % count;
        indices.extend([a, b, b + count, a, b + count, a + count]);
    }
    shaded(&points, &indices, FLAT)
}
