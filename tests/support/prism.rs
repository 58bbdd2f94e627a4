//! Prisms over any outline.

use chamfer::MeshBuffers;

use crate::shaded::{FLAT, shaded};

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
