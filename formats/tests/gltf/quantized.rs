//! Positions that are whole numbers stay so where the steps are fine enough.

use chamfer::{Chamfered, Options, Width, chamfer, shapes};
use chamfer_formats::{Document, Encoded, encode};
use serde_json::json;

use crate::support::{Model, json_of, path_in};

/// A cube with corners at the ends of the range, and its faces' normals in bytes.
fn cube(component: u32, most: i32, normalized: bool) -> Model {
    let mesh = shapes::plain_cube(1.0);
    let mut model = Model::new();
    let size = if component == 5120 { 1 } else { 2 };
    let position = |at: &[f32; 3]| -> Vec<u8> {
        let numbers = at.map(|at| if at > 0.0 { most } else { -most });
        let mut bytes: Vec<u8> =
            numbers.iter().flat_map(|number| number.to_le_bytes()[..size].to_vec()).collect();
        bytes.resize(4 * size, 0);
        bytes
    };
    let bytes: Vec<u8> = mesh.positions.iter().flat_map(position).collect();
    let positions = match normalized {
        true => model.normalized(component, "VEC3", 24, &bytes),
        false => model.accessor(component, "VEC3", 24, &bytes),
    };
    model.json["bufferViews"][0]["byteStride"] = (4 * size).into();
    let normals = model.floats(&mesh.normals);
    let indices = model.indices(&mesh.indices.iter().map(|&i| i as u8).collect::<Vec<_>>());
    let attributes = json!({"POSITION": positions, "NORMAL": normals});
    model.mesh(json!([{"attributes": attributes, "indices": indices}]));
    for key in ["extensionsUsed", "extensionsRequired"] {
        model.json[key] = json!(["KHR_mesh_quantization"]);
    }
    model
}

/// The type of the positions of the chamfered cube, and the notes.
fn written(model: &Model, name: &str, percent: f32) -> (u64, Vec<String>, bool) {
    let document = model.read(name).unwrap();
    let options = Options::default().with_width(Width::PercentOfExtent(percent));
    let results: Vec<Chamfered> =
        vec![chamfer(&document.meshes()[0].mesh.as_mesh(), &options).unwrap()];
    assert_eq!(results[0].totals.chamfered, 12);
    let output = path_in(name).join("out.glb");
    let Encoded { files, notes } = encode(&document, &output, &results).unwrap();
    let json = json_of(&files[0].bytes);
    let position = json["meshes"][0]["primitives"][0]["attributes"]["POSITION"].as_u64().unwrap();
    let is_listed = json.get("extensionsRequired").is_some();
    (json["accessors"][position as usize]["componentType"].as_u64().unwrap(), notes, is_listed)
}

#[test]
fn positions_stay_whole_numbers_where_the_steps_are_fine() {
    for (name, normalized) in [("shares", true), ("plain", false)] {
        let (kind, notes, is_listed) = written(&cube(5122, 32767, normalized), name, 3.3);
        assert_eq!((kind, notes, is_listed), (5122, vec![], true), "{name}");
    }
}

#[test]
fn positions_turn_into_floats_where_the_steps_are_coarse() {
    for (name, model, percent) in
        [("bytes", cube(5120, 127, true), 3.3), ("thin", cube(5122, 32767, true), 0.01)]
    {
        let (kind, notes, is_listed) = written(&model, name, percent);
        assert_eq!((kind, is_listed), (5126, false), "{name}");
        assert!(notes[0].starts_with("mesh mesh 0 was quantized, too coarse"), "{notes:?}");
    }
}
