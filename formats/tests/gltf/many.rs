//! Meshes of many primitives, each with vertices of its own.

use std::time::{Duration, Instant};

use chamfer::{Chamfered, MeshBuffers, Options, chamfer, shapes};
use chamfer_formats::{Document, encode};
use serde_json::{Value, json};

use crate::support::{Model, path_in};

/// Few primitives, and how many times as many.
const FEW: usize = 150;
const TIMES: usize = 12;
/// Of the time that a square of the number would take, a share that a line stays under however
/// busy the machine is, and a square does not.
const SHARE: f64 = 0.3;

/// Cubes with further colours and skins: all that follows the provenance.
fn cubes(count: usize) -> Model {
    let MeshBuffers { positions, normals, indices, .. } = shapes::plain_cube(1.0);
    let vertices = positions.len();
    let mut model = Model::new();
    let bytes: Vec<u8> = indices.iter().map(|index| *index as u8).collect();
    let indices = model.indices(&bytes);
    let primitives = (0..count).map(|number| {
        let moved = |[x, y, z]: &[f32; 3]| [x + 4.0 * number as f32, *y, *z];
        let moved: Vec<[f32; 3]> = positions.iter().map(moved).collect();
        let attributes = json!({
            "POSITION": model.positions(&moved),
            "NORMAL": model.floats(&normals),
            "COLOR_1": model.floats(&vec![[0.5f32; 4]; vertices]),
            "JOINTS_0": model.accessor(5121, "VEC4", vertices, &vec![0; 4 * vertices]),
            "WEIGHTS_0": model.floats(&vec![[1.0f32, 0.0, 0.0, 0.0]; vertices]),
        });
        json!({"attributes": attributes, "indices": indices})
    });
    let primitives: Vec<Value> = primitives.collect();
    model.mesh(primitives.into());
    model
}

/// What reading and writing takes, without the making of the file and of the chamfers.
fn time(count: usize) -> Duration {
    let (model, name) = (cubes(count), format!("many_{count}"));
    let start = Instant::now();
    let document = model.read(&name).unwrap();
    let read = start.elapsed();
    let options = Options::default().with_width(chamfer::Width::Units(0.1));
    let mesh = document.meshes()[0].mesh.as_mesh();
    let chamfered: Vec<Chamfered> = vec![chamfer(&mesh, &options).unwrap()];
    assert_eq!(chamfered[0].totals.chamfered as usize, 12 * count);
    let start = Instant::now();
    let written = encode(&document, &path_in(&name).join("out.glb"), &chamfered).unwrap();
    assert_eq!(written.files.len(), 1);
    read + start.elapsed()
}

#[test]
fn many_primitives_take_linear_time() {
    let least = |count| (0..3).map(|_| time(count)).min().unwrap().as_secs_f64();
    let (few, many) = (least(FEW), least(FEW * TIMES));
    let square = few * (TIMES * TIMES) as f64;
    assert!(many < SHARE * square, "{FEW}: {few} s, {TIMES} times as many: {many} s");
}
