//! Chamfers a cube made of arrays, and counts what comes out.

use chamfer::{Mesh, Options, Width, chamfer};

fn main() -> Result<(), chamfer::Error> {
    let (mut positions, mut normals, mut indices) = (vec![], vec![], vec![]);
    for axis in 0..3 {
        for side in [-1.0, 1.0] {
            let first = positions.len() as u32; // Four vertices a face, so its normals are its own.
            for (u, v) in [(-1.0, -1.0), (1.0, -1.0), (-1.0, 1.0), (1.0, 1.0)] {
                let (mut position, mut normal) = ([0.0; 3], [0.0; 3]);
                (position[axis], normal[axis]) = (side, side);
                (position[(axis + 1) % 3], position[(axis + 2) % 3]) = (u * side, v);
                positions.push(position);
                normals.push(normal);
            }
            indices.extend([0, 1, 2, 2, 1, 3].map(|corner| first + corner));
        }
    }
    let mesh = Mesh {
        positions: &positions,
        normals: &normals,
        indices: &indices,
        submesh_index_counts: &[indices.len() as u32],
        ..Mesh::default()
    };
    let result = chamfer(&mesh, &Options::default().with_width(Width::Units(0.1)))?;
    let triangles = result.mesh.indices.len() / 3;
    println!("{} vertices, {triangles} triangles", result.mesh.positions.len());
    println!("{} of {} hard edges full", result.totals.chamfered, result.totals.hard_edges);
    Ok(())
}
