//! Models of our own, as files: they stand in for the real ones where these are not there, so that a
//! plain clone tries every rule on whole files of each kind.

use std::fmt::Write as _;
use std::fs;
use std::io::Write as _;
use std::path::{Path, PathBuf};

use chamfer::shapes::{self, Touch};
use chamfer::{Mesh, MeshBuffers};
use chamfer_formats::glb;

/// Whether they are needed: the real models are not there, or somebody wants to try these
/// (`CHAMFER_OWN_MODELS=1`).
pub fn are_needed(real: &Path) -> bool {
    !real.is_dir() || std::env::var_os("CHAMFER_OWN_MODELS").is_some()
}

/// Writes all into a folder, and tells, past the test runner, that no real model is tried.
pub fn stand_in(folder: &Path, missing: &str) -> Vec<PathBuf> {
    let line =
        format!("SKIPPED: {missing} is not there: models of our own stand in for real ones\n");
    std::io::stderr().write_all(line.as_bytes()).unwrap();
    let _ = fs::remove_dir_all(folder);
    fs::create_dir_all(folder).unwrap();
    let mut paths = Vec::new();
    for (name, mesh) in models() {
        let mut put = |ending: &str, bytes: Vec<u8>| {
            let path = folder.join(format!("{name}_{ending}.{ending}"));
            fs::write(&path, bytes).unwrap();
            paths.push(path);
        };
        put("glb", glb::encode(name, &mesh, &[], &[]).unwrap());
        put("obj", obj(&mesh.as_mesh()).into_bytes());
        put("stl", stl(&mesh.as_mesh()).into_bytes());
    }
    paths.sort();
    paths
}

fn models() -> Vec<(&'static str, MeshBuffers)> {
    let mut models = shapes::demo_models();
    models.extend([
        ("cube_field", shapes::cube_field(27)),
        ("open_box", shapes::open_box()),
        ("plate", shapes::plate()),
        ("pyramid", shapes::pyramid(7)),
        ("saddle", shapes::saddle()),
        ("sphere", shapes::sphere(8, 12)),
        ("touching", shapes::two_cubes_touching(Touch::Edge)),
        ("wedge_end", shapes::wedge_end()),
    ]);
    models
}

/// With its normals; positions once for each vertex, which the reader joins.
fn obj(mesh: &Mesh) -> String {
    let mut text = String::new();
    for [x, y, z] in mesh.positions {
        writeln!(text, "v {x} {y} {z}").unwrap();
    }
    for [x, y, z] in mesh.normals {
        writeln!(text, "vn {x} {y} {z}").unwrap();
    }
    for [a, b, c] in mesh.indices.as_chunks::<3>().0.iter().map(|t| t.map(|vertex| vertex + 1)) {
        writeln!(text, "f {a}//{a} {b}//{b} {c}//{c}").unwrap();
    }
    text
}

/// A soup without normals, as STL is: they are made by angle.
fn stl(mesh: &Mesh) -> String {
    let mut text = "solid model\n".to_owned();
    for triangle in mesh.indices.as_chunks::<3>().0 {
        text += "facet normal 0 0 0\nouter loop\n";
        for [x, y, z] in triangle.map(|vertex| mesh.positions[vertex as usize]) {
            writeln!(text, "vertex {x} {y} {z}").unwrap();
        }
        text += "endloop\nendfacet\n";
    }
    text + "endsolid model\n"
}
