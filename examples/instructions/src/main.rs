//! One call, for a profiler that counts instructions: `scripts/instructions` runs it.

use std::path::Path;

use chamfer::{MeshBuffers, Options, Verify, Width, chamfer, shapes};
use chamfer_formats::{ReadOptions, read};

/// Of a width of 0.05: 12,000 triangles, all of whose edges are hard and have a seam.
const CUBES: u32 = 1000;

/// As many triangles, and no hard edge.
const SPHERE: (u32, u32) = (61, 100);

fn main() {
    let model = std::env::args().nth(1).expect("field, sphere or a file");
    let verify = if std::env::args().any(|a| a == "--full") { Verify::Full } else { Verify::Fast };
    let usual = Options::default().with_verify(verify);
    let (meshes, options) = match model.as_str() {
        "field" => (vec![shapes::cube_field(CUBES)], usual.with_width(Width::Units(0.05))),
        "sphere" => (vec![shapes::sphere(SPHERE.0, SPHERE.1)], usual),
        file => (meshes_of(Path::new(file)), usual),
    };
    let triangles: usize = meshes.iter().map(|mesh| mesh.indices.len() / 3).sum();
    for mesh in &meshes {
        chamfer(&mesh.as_mesh(), &options).expect("these meshes keep all rules");
    }
    println!("{triangles}");
}

fn meshes_of(file: &Path) -> Vec<MeshBuffers> {
    let document = read(file, &ReadOptions::default()).expect("a file that can be read");
    document.meshes().iter().map(|source| source.mesh.clone()).collect()
}
