//! Broken files: each is an error that says what is wrong, never a panic.

use chamfer_formats::encode;
use serde_json::{Value, json};

use crate::support::{Model, SQUARE_INDICES, all_grown, folder};

fn square() -> Model {
    let mut model = Model::new();
    let mut attributes = model.square();
    let joints = model.accessor(5121, "VEC4", 4, &[0; 16]);
    let weights = model.floats(&[[1.0f32, 0.0, 0.0, 0.0]; 4]);
    attributes["JOINTS_0"] = joints.into();
    attributes["WEIGHTS_0"] = weights.into();
    let target = model.positions(&[[0.0, 0.0, 1.0]; 4]);
    let indices = model.indices(&SQUARE_INDICES);
    model.mesh(json!([{
        "attributes": attributes, "indices": indices, "targets": [{"POSITION": target}],
    }]));
    model.json["nodes"] = json!([{"mesh": 0, "children": [1]}, {"translation": [1, 2, 3]}]);
    model.json["scenes"] = json!([{"nodes": [0]}]);
    model
}

/// The error of the square with one value replaced.
fn error_with(pointer: &str, value: Value) -> String {
    let mut model = square();
    *model.json.pointer_mut(pointer).expect(pointer) = value;
    let error = model.read("broken").err();
    format!("{:#}", error.unwrap_or_else(|| panic!("{pointer} was accepted")))
}

#[test]
fn errors_name_the_place_and_the_rule() {
    let cases = [
        ("/asset/version", json!("1.0"), "only glTF 2"),
        ("/accessors/0/bufferView", json!(99), "bufferViews[99]"),
        ("/accessors/0/count", json!(1u64 << 60), "past the end of bufferViews[0]"),
        ("/accessors/0/count", json!(-1), "accessors[0].count is -1"),
        ("/accessors/0/type", json!("VEC2"), "POSITION of meshes[0].primitives[0]"),
        ("/accessors/0/componentType", json!(5127), "componentType is 5127"),
        ("/bufferViews/0/byteLength", json!(40), "accessors[0] of 4 elements reaches past the end"),
        ("/bufferViews/0/byteOffset", json!(1u64 << 62), "bufferViews[0] reaches past the end"),
        ("/bufferViews/0/buffer", json!(1), "buffers[1]"),
        ("/meshes/0/primitives/0/indices", json!(0), "plain unsigned integers"),
        ("/meshes/0/primitives/0/attributes/NORMAL", json!(1.5), "NORMAL is 1.5"),
        ("/nodes/1", json!({"children": [0]}), "its own ancestor"),
        ("/nodes/1/translation", json!([1, 2]), "3 finite numbers"),
        ("/scenes/0/nodes", json!([5]), "nodes[5]"),
    ];
    for (pointer, value, expected) in cases {
        let error = error_with(pointer, value);
        assert!(error.contains(expected), "{pointer}: {error}");
    }
}

#[test]
fn an_index_past_the_last_vertex_is_named() {
    let mut model = Model::new();
    let attributes = model.square();
    let indices = model.indices(&[0, 1, 4]);
    model.mesh(json!([{"attributes": attributes, "indices": indices}]));
    let error = format!("{:#}", model.read("range").err().unwrap());
    assert!(error.contains("index 2 of meshes[0].primitives[0] is 4"), "{error}");
}

#[test]
fn a_small_file_of_endless_meshes_is_refused() {
    let mut model = Model::new();
    let zeros = json!({"componentType": 5126, "count": 1 << 22, "type": "VEC3"});
    model.json["accessors"] = json!([zeros]);
    let mesh = json!({"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 0}}]});
    model.json["meshes"] = vec![mesh; 1000].into();
    let error = format!("{:#}", model.read("endless").err().unwrap());
    assert!(error.contains("far more numbers"), "{error}");
}

/// The numbers of the JSON one after the other, replaced by what breaks most.
#[test]
fn no_number_makes_the_reader_panic() {
    let output = folder("numbers").join("out.glb");
    let mut pointers = Vec::new();
    collect_numbers(&square().json, String::new(), &mut pointers);
    for pointer in pointers {
        for value in [json!(0), json!(1), json!(7), json!(-1), json!(1e39), json!(u64::MAX)] {
            let mut model = square();
            *model.json.pointer_mut(&pointer).unwrap() = value;
            if let Ok(document) = model.read("numbers") {
                let _ = encode(&document, &output, &all_grown(&document));
            }
        }
    }
}

fn collect_numbers(value: &Value, pointer: String, pointers: &mut Vec<String>) {
    match value {
        Value::Number(_) => pointers.push(pointer),
        Value::Array(items) => items.iter().enumerate().for_each(|(index, item)| {
            collect_numbers(item, format!("{pointer}/{index}"), pointers);
        }),
        Value::Object(fields) => fields.iter().for_each(|(key, field)| {
            collect_numbers(field, format!("{pointer}/{key}"), pointers);
        }),
        _ => {}
    }
}
