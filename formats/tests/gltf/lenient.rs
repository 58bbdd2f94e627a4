//! Broken rules that do not matter for geometry: the file is read, and a note says so.

use chamfer::{MeshBuffers, shapes};
use chamfer_formats::Document;
use serde_json::json;

use crate::support::{Model, SQUARE, SQUARE_INDICES};

/// A square with one stream more, which is not finite at its second vertex.
fn square_with(name: &str, values: &[[f32; 4]; 4]) -> Model {
    let mut model = Model::new();
    let mut attributes = model.square();
    if name == "WEIGHTS_0" {
        attributes["JOINTS_0"] = model.accessor(5121, "VEC4", 4, &[0; 16]).into();
    }
    attributes[name] = match name {
        "TEXCOORD_0" => model.floats(&values.map(|[u, v, ..]| [u, v])),
        "NORMAL" => model.floats(&values.map(|[x, y, z, _]| [x, y, z])),
        _ => model.floats(values),
    }
    .into();
    let indices = model.indices(&SQUARE_INDICES);
    model.mesh(json!([{"attributes": attributes, "indices": indices}]));
    model
}

#[test]
fn streams_that_geometry_can_do_without_may_have_holes() {
    let mut values = [[0.25, 0.5, 1.0, 0.0]; 4];
    values[1] = [f32::NAN, 0.5, f32::INFINITY, 0.0];
    for name in ["WEIGHTS_0", "TEXCOORD_0", "COLOR_0", "TANGENT", "_ACME"] {
        let model = square_with(name, &values);
        let document = model.read(&format!("hole_{name}")).unwrap();
        let notes = document.notes().join(" ");
        assert!(notes.contains("in 1 of its elements, first in element 1"), "{name}: {notes}");
        let written = model.grown(&format!("hole_{name}"));
        let pointer = format!("/meshes/0/primitives/0/attributes/{name}");
        assert!(written.floats(&pointer).iter().all(|number| number.is_finite()), "{name}");
    }
}

#[test]
fn a_place_that_no_triangle_uses_may_be_a_nan() {
    let mut model = Model::new();
    let mut positions = SQUARE.to_vec();
    positions.push([f32::NAN, 0.0, 0.0]);
    let positions = model.floats(&positions);
    let indices = model.indices(&SQUARE_INDICES);
    model.mesh(json!([{"attributes": {"POSITION": positions}, "indices": indices}]));
    let document = model.read("unused").unwrap();
    assert_eq!(document.meshes()[0].mesh.indices.len(), 6);
    assert!(document.notes()[0].starts_with("accessors[0] has an infinite value or a NaN"));

    let indices = model.indices(&[0, 1, 4]);
    model.json["meshes"][0]["primitives"][0]["indices"] = indices.into();
    let error = format!("{:#}", model.read("used").err().unwrap());
    assert!(error.contains("meshes[0].primitives[0] stands at") && error.contains("vertex 4"));
}

/// A cube whose normals are zero at some vertices.
fn cube_without_normals(is_zero: fn(usize) -> bool) -> (Model, MeshBuffers) {
    let mesh = shapes::cube(1.0);
    let mut normals = mesh.normals.clone();
    (0..normals.len()).filter(|&vertex| is_zero(vertex)).for_each(|v| normals[v] = [0.0; 3]);
    let mut model = Model::new();
    let (positions, normals) = (model.positions(&mesh.positions), model.floats(&normals));
    let indices = model.indices(&mesh.indices.iter().map(|&i| i as u8).collect::<Vec<_>>());
    let attributes = json!({"POSITION": positions, "NORMAL": normals});
    model.mesh(json!([{"attributes": attributes, "indices": indices}]));
    (model, mesh)
}

#[test]
fn normals_without_a_direction_are_made_anew() {
    let (model, cube) = cube_without_normals(|_| true);
    let document = model.read("no_normals").unwrap();
    assert!(document.normals()[0].computed);
    let told = "mesh mesh 0: 24 normals have no direction: they were made from the faces";
    assert_eq!(document.notes(), [told]);
    assert_eq!(document.meshes()[0].mesh.normals, cube.normals);
    let written = model.grown("no_normals");
    let normals = written.floats("/meshes/0/primitives/0/attributes/NORMAL");
    assert!(normals.as_chunks::<3>().0.iter().all(|[x, y, z]| x * x + y * y + z * z == 1.0));
}

/// Where only some have none, the vertices stay as they are: their faces say where up is.
#[test]
fn single_normals_without_a_direction_are_filled_in() {
    let (model, cube) = cube_without_normals(|vertex| vertex == 5);
    let document = model.read("one_normal").unwrap();
    let normal = document.meshes()[0].mesh.normals[5];
    let toward_face: f32 = normal.iter().zip(cube.normals[5]).map(|(a, b)| a * b).sum();
    assert!(toward_face > 0.5, "{normal:?}");
    assert_eq!(document.normals()[0].repaired, [(5, [0.0; 3])]);
    assert!(document.notes()[0].starts_with("mesh mesh 0: 1 normals have"));
}

//  1---3   4
//  | \ | / |      two strips in one list, with the last number of its type between
//  0---2   5
#[test]
fn strips_may_begin_anew() {
    let mut model = Model::new();
    let places = [[0.0, 0.0], [0.0, 1.0], [1.0, 0.0], [1.0, 1.0], [2.0, 1.0], [2.0, 0.0]];
    let positions = model.positions(&places.map(|[x, y]| [x, y, 0.0]));
    let indices: Vec<u8> =
        [0u16, 2, 1, 3, 65535, 2, 5, 4].iter().flat_map(|index| index.to_le_bytes()).collect();
    let indices = model.accessor(5123, "SCALAR", 8, &indices);
    model.mesh(json!([{"attributes": {"POSITION": positions}, "indices": indices, "mode": 5}]));
    for key in ["extensionsUsed", "extensionsRequired"] {
        model.json[key] = json!(["KHR_mesh_primitive_restart"]);
    }
    let document = model.read("restart").unwrap();
    assert_eq!(document.meshes()[0].mesh.indices, [0, 2, 1, 2, 3, 1, 2, 5, 4]);
    let written = model.grown("restart");
    assert_eq!(written.json["meshes"][0]["primitives"][0]["mode"], 4);
    assert!(!written.json.to_string().contains("KHR_mesh_primitive_restart"));
}
