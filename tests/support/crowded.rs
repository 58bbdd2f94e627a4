//! Whether a mesh has edges of more than two sides.

use std::collections::HashMap;

use chamfer::MeshBuffers;

/// Whether somewhere more than two triangles meet on one edge, by position.
pub fn has_crowded_edges(mesh: &MeshBuffers) -> bool {
    // Adding zero makes one zero of the two.
    let place = |index: u32| mesh.positions[index as usize].map(|along| (along + 0.0).to_bits());
    let mut sides = HashMap::new();
    for corners in mesh.indices.chunks_exact(3) {
        for side in 0..3 {
            let [from, to] = [corners[side], corners[(side + 1) % 3]].map(place);
            *sides.entry([from.min(to), from.max(to)]).or_insert(0) += 1;
        }
    }
    sides.values().any(|&count: &u32| count > 2)
}
