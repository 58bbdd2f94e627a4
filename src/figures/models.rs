//! Models that only the figures need, and results.

use crate::mesh::MeshBuffers;
use crate::options::{Options, Width};
use crate::report::Chamfered;
use crate::shapes;

/// The whole pipeline on a sound mesh, for a width in mesh units.
pub fn chamfered(mesh: &MeshBuffers, width: f32) -> Chamfered {
    let options = Options { width: Width::Units(width), ..Options::default() };
    crate::chamfer(&mesh.as_mesh(), &options).unwrap()
}

/// One submesh, empty.
pub fn nothing() -> MeshBuffers {
    MeshBuffers { submesh_index_counts: vec![0], ..MeshBuffers::default() }
}

/// A box between two corners.
pub fn add_block(mesh: &mut MeshBuffers, low: [f32; 3], high: [f32; 3]) {
    let cube = shapes::plain_cube(2.0);
    for face in 0..6 {
        let corners = [0, 1, 2, 3].map(|k| {
            let at = cube.positions[4 * face + k];
            [0, 1, 2].map(|axis| if at[axis] < 0.0 { low[axis] } else { high[axis] })
        });
        add_face(mesh, corners, cube.normals[4 * face]);
    }
}

/// An upright card that can be seen from both sides: two faces back to back.
pub fn add_card(mesh: &mut MeshBuffers, low: [f32; 2], high: [f32; 2]) {
    let [[left, bottom], [right, top]] = [low, high];
    let front = [[left, bottom], [right, bottom], [right, top], [left, top]];
    let front = front.map(|[x, y]| [x, y, 0.0]);
    add_face(mesh, front, [0.0, 0.0, 1.0]);
    add_face(mesh, [front[0], front[3], front[2], front[1]], [0.0, 0.0, -1.0]);
}

fn add_face(mesh: &mut MeshBuffers, corners: [[f32; 3]; 4], normal: [f32; 3]) {
    let first = mesh.positions.len() as u32;
    mesh.positions.extend(corners);
    mesh.normals.extend([normal; 4]);
    mesh.indices.extend([0, 1, 2, 0, 2, 3].map(|k| first + k));
    mesh.submesh_index_counts[0] += 6;
}
