//! Quads that share no vertices, shaded flat.

use chamfer::MeshBuffers;
use glam::DVec3;

pub fn quads(all: impl IntoIterator<Item = [[f32; 3]; 4]>) -> MeshBuffers {
    let mut mesh = MeshBuffers::default();
    for quad in all {
        let [a, b, c, _] = quad.map(|at| DVec3::from(at.map(f64::from)));
        let normal = (b - a).cross(c - a).normalize().as_vec3().to_array();
        let first = mesh.positions.len() as u32;
        mesh.positions.extend(quad);
        mesh.normals.extend([normal; 4]);
        mesh.indices.extend([0, 1, 2, 0, 2, 3].map(|corner| first + corner));
    }
    mesh.submesh_index_counts = vec![mesh.indices.len() as u32];
    mesh
}
