//! What glTF can say of a mesh, in small models: read right, and written so that it still holds.

use std::fs;

use chamfer_formats::{Document, encode};
use serde_json::{Value, json};

use crate::support::{
    Model, SQUARE, SQUARE_INDICES, all_grown, folder, json_of, read, unchanged, write,
};

const ATTRIBUTES: &str = "/meshes/0/primitives/0/attributes";

fn attribute(name: &str) -> String {
    format!("{ATTRIBUTES}/{name}")
}

/// A square of two triangles with one more attribute.
fn square_with(name: &str, accessor: impl Fn(&mut Model) -> usize) -> Model {
    let mut model = Model::new();
    let mut attributes = model.square();
    attributes[name] = accessor(&mut model).into();
    let indices = model.indices(&SQUARE_INDICES);
    model.mesh(json!([{"attributes": attributes, "indices": indices}]));
    model
}

#[test]
fn lists_strips_fans_and_bare_vertices_are_triangles() {
    let mut model = Model::new();
    let attributes = model.square();
    let mut primitive = |mode: u32, indices: &[u8]| {
        let indices = model.indices(indices);
        json!({"attributes": attributes, "indices": indices, "mode": mode})
    };
    let primitives = json!([
        primitive(4, &SQUARE_INDICES),
        primitive(5, &[0, 1, 3, 2]),
        primitive(6, &[0, 1, 2, 3]),
        {"attributes": attributes, "mode": 6},
        primitive(0, &[0, 1]),
        primitive(3, &[0, 1]),
    ]);
    model.mesh(primitives);
    let document = model.read("modes").unwrap();
    let mesh = &document.meshes()[0].mesh;
    assert_eq!(mesh.submesh_index_counts, [6, 6, 6, 6]);
    assert_eq!(mesh.indices[6..12], [0, 1, 3, 1, 2, 3]);
    assert_eq!(mesh.indices[12..18], [1, 2, 0, 2, 3, 0]);
    assert_eq!(mesh.positions.len(), 4, "all primitives share their vertices");

    let written = model.grown("modes");
    let primitives = written.json["meshes"][0]["primitives"].as_array().unwrap();
    assert_eq!(primitives[1]["mode"], 4);
    assert_eq!(primitives[4..], model.json["meshes"][0]["primitives"].as_array().unwrap()[4..]);
    assert_eq!(primitives[0]["attributes"]["NORMAL"], primitives[3]["attributes"]["NORMAL"]);
    assert_ne!(
        primitives[4]["attributes"]["POSITION"], primitives[0]["attributes"]["POSITION"],
        "the points keep the old positions"
    );
}

#[test]
fn wide_indices_are_read() {
    let mut model = Model::new();
    let attributes = model.square();
    let wide: Vec<u8> = [0u32, 1, 2].iter().flat_map(|index| index.to_le_bytes()).collect();
    let narrow: Vec<u8> = [0u16, 2, 3].iter().flat_map(|index| index.to_le_bytes()).collect();
    let wide = model.accessor(5125, "SCALAR", 3, &wide);
    let narrow = model.accessor(5123, "SCALAR", 3, &narrow);
    model.mesh(json!([
        {"attributes": attributes, "indices": wide},
        {"attributes": attributes, "indices": narrow},
    ]));
    let document = model.read("indices").unwrap();
    assert_eq!(document.meshes()[0].mesh.indices, [0, 1, 2, 0, 2, 3]);
}

#[test]
fn primitives_of_other_accessors_have_their_own_attributes() {
    let mut model = Model::new();
    let plain = model.square();
    let mut colored = model.square();
    colored["COLOR_0"] = model.floats(&[[0.5f32, 0.25, 0.125]; 4]).into();
    let indices = model.indices(&SQUARE_INDICES);
    model.mesh(json!([
        {"attributes": plain, "indices": indices},
        {"attributes": colored, "indices": indices},
    ]));
    let document = model.read("blocks").unwrap();
    let mesh = &document.meshes()[0].mesh;
    assert_eq!(mesh.indices, [0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7]);
    assert_eq!(mesh.colors[0], [1.0; 4], "white where there is no colour");
    assert_eq!(mesh.colors[4], [0.5, 0.25, 0.125, 1.0]);

    let written = model.grown("blocks");
    let primitives = &written.json["meshes"][0]["primitives"];
    assert_eq!(primitives[0]["attributes"].get("COLOR_0"), None);
    let colors = written.accessor("/meshes/0/primitives/1/attributes/COLOR_0");
    assert_eq!(colors["type"], "VEC3", "no alpha where there was none");
    assert_eq!(colors["count"], 6, "its four vertices, a new one, and one of the other block");
}

#[test]
fn quantized_attributes_are_read_and_turn_into_floats_where_they_must() {
    let mut model = Model::new();
    let positions: Vec<u8> =
        [0i16, 0, 0, 0, 7, 0, 0, 0, 7, 7, 0, 0, 0, 7, 0, 0].map(i16::to_le_bytes).concat();
    let positions = model.accessor(5122, "VEC3", 4, &positions);
    let normals = model.normalized(5120, "VEC3", 4, &[0, 0, 127, 0].repeat(4));
    for view in [0, 1] {
        model.json["bufferViews"][view]["byteStride"] = [8, 4][view].into();
    }
    model.json["extensionsUsed"] = json!(["KHR_mesh_quantization"]);
    let indices = model.indices(&SQUARE_INDICES);
    let attributes = json!({"POSITION": positions, "NORMAL": normals});
    model.mesh(json!([{"attributes": attributes, "indices": indices}]));
    let document = model.read("quantized").unwrap();
    let mesh = &document.meshes()[0].mesh;
    assert_eq!(mesh.positions[2], [7.0, 7.0, 0.0]);
    assert_eq!(mesh.normals[2], [0.0, 0.0, 1.0]);

    let written = model.grown("quantized");
    assert_eq!(written.accessor(&attribute("POSITION"))["componentType"], 5126);
    assert_eq!(written.accessor(&attribute("NORMAL"))["componentType"], 5120);
    assert_eq!(written.json["extensionsUsed"], json!(["KHR_mesh_quantization"]));
}

#[test]
fn colours_keep_their_type() {
    let bytes = [255, 0, 0, 9, 0, 255, 0, 9, 0, 0, 255, 9, 255, 255, 255, 9];
    let model = square_with("COLOR_0", |model| {
        let colors = model.normalized(5121, "VEC3", 4, &bytes);
        model.json["bufferViews"][2]["byteStride"] = 4.into();
        colors
    });
    let written = model.grown("colours");
    let colors = written.accessor(&attribute("COLOR_0"));
    assert_eq!(colors["componentType"], 5121);
    assert_eq!(colors["normalized"], true);
    assert_eq!(written.bytes(colors)[4..8], [0, 255, 0, 0]);
    assert_eq!(written.bytes(colors)[16..20], [128, 64, 64, 0], "the mean, rounded");
}

#[test]
fn missing_normals_are_made_and_stale_tangents_dropped() {
    let mut model = Model::new();
    let positions = model.positions(&SQUARE);
    let tangents = model.floats(&[[1.0, 0.0, 0.0, 1.0]; 4]);
    let indices = model.indices(&SQUARE_INDICES);
    let attributes = json!({"POSITION": positions, "TANGENT": tangents});
    model.mesh(json!([{"attributes": attributes, "indices": indices}]));
    let document = model.read("smoothed").unwrap();
    assert_eq!(document.meshes()[0].mesh.normals.len(), 4);
    assert!(document.meshes()[0].mesh.tangents.is_empty());
    let written = model.grown("smoothed");
    assert_eq!(written.json.pointer(&attribute("TANGENT")), None);
    assert_eq!(written.floats(&attribute("NORMAL"))[..3], [0.0, 0.0, 1.0]);
}

#[test]
fn skins_are_blended_to_an_exact_sum() {
    let joints = [[1, 2, 0, 0], [2, 3, 0, 0], [4, 0, 0, 0], [5, 0, 0, 0]].concat();
    let weights = [[128, 127, 0, 0], [100, 155, 0, 0], [255, 0, 0, 0], [255, 0, 0, 0]].concat();
    let mut model = square_with("JOINTS_0", |model| model.accessor(5121, "VEC4", 4, &joints));
    let weights = model.normalized(5121, "VEC4", 4, &weights);
    *model.json.pointer_mut(ATTRIBUTES).unwrap().get_mut("JOINTS_0").unwrap() = 2.into();
    model.json["meshes"][0]["primitives"][0]["attributes"]["WEIGHTS_0"] = weights.into();
    let written = model.grown("skin");
    let joints = written.bytes(written.accessor(&attribute("JOINTS_0")));
    let weights = written.bytes(written.accessor(&attribute("WEIGHTS_0")));
    assert_eq!(weights[..4], [128, 127, 0, 0], "source vertices keep theirs");
    // Half of the first vertex, a quarter of each other: 2 and 3 and 4 and 1 all pull.
    assert_eq!(weights[16..].iter().map(|weight| u32::from(*weight)).sum::<u32>(), 255);
    assert_eq!(joints[16..], [2, 1, 4, 3]);
}

#[test]
fn morph_targets_follow_dense_and_sparse() {
    let mut model = Model::new();
    let attributes = model.square();
    let dense = model.positions(&[[0.0, 0.0, 4.0], [0.0; 3], [0.0; 3], [0.0; 3]]);
    let index = model.view(&[0, 0, 0, 0]);
    let value = model.view(&[8.0f32, 0.0, 0.0].map(f32::to_le_bytes).concat());
    let sparse = json!({
        "componentType": 5126, "count": 4, "type": "VEC3", "max": [8, 0, 0], "min": [0, 0, 0],
        "sparse": {
            "count": 1,
            "indices": {"bufferView": index, "componentType": 5121},
            "values": {"bufferView": value},
        },
    });
    model.json["accessors"].as_array_mut().unwrap().push(sparse);
    let indices = model.indices(&SQUARE_INDICES);
    let targets = json!([{"POSITION": dense}, {"POSITION": dense + 1}]);
    model.mesh(json!([{"attributes": attributes, "indices": indices, "targets": targets}]));
    let written = model.grown("morphs");
    let target = |number: u32| format!("/meshes/0/primitives/0/targets/{number}/POSITION");
    assert_eq!(written.floats(&target(0))[12..], [0.0, 0.0, 2.0], "half of the first vertex's");
    let accessor = written.accessor(&target(1));
    assert_eq!(accessor["sparse"]["count"], 2);
    assert_eq!(accessor["max"], json!([8.0, 0.0, 0.0]));
}

#[test]
fn custom_attributes_are_blended_or_taken_from_the_nearest() {
    let blended = square_with("_HEAT", |model| model.floats(&[[4.0f32], [8.0], [0.0], [0.0]]));
    assert_eq!(blended.grown("heat").floats(&attribute("_HEAT"))[4], 4.0);
    let labels = [7, 0, 8, 0, 9, 0, 9, 0];
    let nearest = square_with("_ID", |model| model.accessor(5123, "SCALAR", 4, &labels));
    let written = nearest.grown("id");
    let accessor = written.accessor(&attribute("_ID"));
    assert_eq!(accessor["componentType"], 5123);
    assert_eq!(written.bytes(accessor)[16..18], [7, 0]);
}

#[test]
fn further_channels_follow_the_chart() {
    let uvs = [[0.0f32, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]];
    let model = square_with("TEXCOORD_8", |model| model.floats(&uvs));
    assert_eq!(model.grown("channels").floats(&attribute("TEXCOORD_8"))[8..], [2.0, 1.0]);
}

#[test]
fn a_vertex_buffer_of_the_whole_scene_is_not_copied_into_each_mesh() {
    let mut model = Model::new();
    let attributes = model.square();
    let lower = model.indices(&[0, 1, 2]);
    let upper = model.indices(&[0, 2, 3]);
    for indices in [lower, upper, upper] {
        model.mesh(json!([{"attributes": attributes, "indices": indices}]));
    }
    let document = model.read("scene_buffer").unwrap();
    let positions = document.meshes().iter().map(|source| source.mesh.positions.len());
    assert_eq!(positions.collect::<Vec<_>>(), [3, 3, 3]);
    let written = model.grown("scene_buffer");
    let meshes = &written.json["meshes"];
    assert_ne!(meshes[0]["primitives"], meshes[1]["primitives"]);
    assert_eq!(meshes[1]["primitives"], meshes[2]["primitives"], "what is equal is shared");
}

#[test]
fn extensions_and_extras_come_out_unchanged() {
    let mut model = square_with("_HEAT", |model| model.floats(&[[1.0f32]; 4]));
    let keyframes = model.floats(&[[0.25f32], [0.5]]);
    let unknown = r#"{"ACME_wind":{"accessor":1,"strength":0.100000000000000005551}}"#;
    let primitive = &mut model.json["meshes"][0]["primitives"][0];
    primitive["extensions"] = json!({"KHR_materials_variants": {"mappings": []}});
    primitive["extras"] = json!({"outline": true});
    model.json["extensions"] = serde_json::from_str(unknown).unwrap();
    model.json["animations"] =
        json!([{"samplers": [{"input": keyframes, "output": keyframes}], "channels": []}]);
    let written = model.grown("extensions");
    assert_eq!(written.json["extensions"].to_string(), unknown, "to the last digit");
    let primitive = &written.json["meshes"][0]["primitives"][0];
    for key in ["extensions", "extras"] {
        assert_eq!(primitive[key], model.json["meshes"][0]["primitives"][0][key]);
    }
    assert_eq!(written.json["animations"], model.json["animations"]);
    assert_eq!(written.floats("/animations/0/samplers/0/input"), [0.25, 0.5]);
    assert_eq!(written.json["accessors"][1]["count"], 4, "an extension may refer to it");
    assert_eq!(written.accessor(&attribute("NORMAL"))["count"], 5);
}

#[test]
fn a_further_submesh_is_a_further_primitive_of_the_same_material() {
    let mut model = square_with("_HEAT", |model| model.floats(&[[1.0f32]; 4]));
    model.json["meshes"][0]["primitives"][0]["extras"] = "stone".into();
    let document = model.read("further").unwrap();
    let output = folder("further").join("out.glb");
    let mut chamfered = all_grown(&document);
    chamfered[0].mesh.submesh_index_counts = vec![6, 3];
    write(&encode(&document, &output, &chamfered).unwrap().files);
    assert_eq!(read(&output).unwrap().meshes()[0].mesh, chamfered[0].mesh);
    let json = json_of(&fs::read(&output).unwrap());
    let primitives = &json["meshes"][0]["primitives"];
    assert_eq!(primitives[1]["extras"], "stone");
    assert_eq!(primitives[0]["attributes"], primitives[1]["attributes"]);

    let mut same = unchanged(&document);
    same[0].mesh.submesh_index_counts.push(0);
    assert_eq!(encode(&document, &output, &same).unwrap().files[0].bytes, model.glb());
}

#[test]
fn bytes_that_nothing_refers_to_are_dropped() {
    let model = square_with("_HEAT", |model| model.floats(&[[1.0f32]; 4]));
    let written = model.grown("dropped");
    let views = written.json["bufferViews"].as_array().unwrap();
    let total: u64 = views.iter().map(|view: &Value| view["byteLength"].as_u64().unwrap()).sum();
    assert_eq!(views.len(), 4);
    assert!(written.bytes.len() as u64 <= total + 4 * 3, "no more than alignment between views");
}
