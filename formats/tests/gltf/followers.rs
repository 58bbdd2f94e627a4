//! What the core does not know follows its provenance, in the type that it had.

use chamfer_formats::encode;
use serde_json::{Value, json};

use crate::support::{Model, SQUARE_INDICES, Written, all_grown, folder, json_of};

/// A square with more attributes; `targets` may be none.
fn square_with(model: &mut Model, more: &[(&str, usize)], targets: &[Value]) {
    let mut attributes = model.square();
    for (name, accessor) in more {
        attributes[*name] = (*accessor).into();
    }
    let indices = model.indices(&SQUARE_INDICES);
    let mut primitive = json!({"attributes": attributes, "indices": indices});
    if !targets.is_empty() {
        primitive["targets"] = targets.into();
    }
    model.mesh(json!([primitive]));
}

fn attribute(name: &str) -> String {
    format!("/meshes/0/primitives/0/attributes/{name}")
}

/// The model with a vertex that reads past the first triangle: half of the first vertex too much.
fn stretched(model: &Model, name: &str) -> Written {
    let document = model.read(name).unwrap();
    let mut chamfered = all_grown(&document);
    let mut sources: Vec<_> = chamfered[0].vertex_sources.iter().collect();
    let source = sources.last_mut().unwrap();
    (source.chart.weights, source.owner.weights) = ([1.5, -0.25, -0.25], [1.5, -0.25, -0.25]);
    chamfered[0].vertex_sources = sources.into_iter().collect();
    let files = encode(&document, &folder(name).join("out.glb"), &chamfered).unwrap().files;
    let bytes = files[0].bytes.clone();
    let json_length = u32::from_le_bytes(bytes[12..16].try_into().unwrap()) as usize;
    Written { json: json_of(&bytes), bytes: bytes[28 + json_length..].to_vec() }
}

#[test]
fn colours_of_two_bytes_keep_their_type() {
    let mut model = Model::new();
    let words = [[65535u16, 0, 0, 65535], [0; 4], [0; 4], [0; 4]];
    let bytes = words.as_flattened().iter().flat_map(|word| word.to_le_bytes());
    let colors = model.normalized(5123, "VEC4", 4, &bytes.collect::<Vec<u8>>());
    square_with(&mut model, &[("COLOR_0", colors)], &[]);
    let written = model.grown("word_colours");
    let colors = written.accessor(&attribute("COLOR_0"));
    assert_eq!((&colors["componentType"], &colors["normalized"]), (&json!(5123), &json!(true)));
    assert_eq!(written.bytes(colors)[..8], [255, 255, 0, 0, 0, 0, 255, 255]);
    assert_eq!(written.bytes(colors)[32..], [0, 128, 0, 0, 0, 0, 0, 128], "half, rounded");
}

#[test]
fn further_colours_stay_between_those_of_the_source() {
    let mut model = Model::new();
    let floats = model.floats(&[[0.5f32, 0.25, 0.5, 1.0], [0.25; 4], [0.25; 4], [0.25; 4]]);
    let bytes =
        model.normalized(5121, "VEC4", 4, &[[100, 0, 9, 255], [20; 4], [20; 4], [20; 4]].concat());
    square_with(&mut model, &[("COLOR_1", floats), ("COLOR_2", bytes)], &[]);
    let written = stretched(&model, "further_colours");
    assert_eq!(written.floats(&attribute("COLOR_1"))[16..], [0.5, 0.25, 0.5, 1.0]);
    let bytes = written.accessor(&attribute("COLOR_2"));
    assert_eq!(bytes["componentType"], 5121);
    assert_eq!(written.bytes(bytes)[16..], [100, 0, 9, 255]);
}

#[test]
fn channels_past_the_eighth_are_read_past_their_triangle() {
    let mut model = Model::new();
    let uvs = model.floats(&[[0.0f32, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]]);
    square_with(&mut model, &[("TEXCOORD_9", uvs)], &[]);
    let written = stretched(&model, "ninth_channel");
    assert_eq!(written.floats(&attribute("TEXCOORD_9"))[8..], [-2.0, -1.0]);
}

#[test]
fn custom_attributes_of_any_width_are_blended() {
    let mut model = Model::new();
    let two = model.floats(&[[4.0f32, 8.0], [0.0; 2], [0.0; 2], [0.0; 2]]);
    let three = model.floats(&[[4.0f32, 8.0, 2.0], [0.0; 3], [0.0; 3], [0.0; 3]]);
    let four = model.floats(&[[4.0f32, 8.0, 2.0, 6.0], [0.0; 4], [0.0; 4], [0.0; 4]]);
    let share =
        model.normalized(5120, "VEC4", 4, &[[100, 0x9c, 0, 50], [0; 4], [0; 4], [0; 4]].concat());
    let more = [("_TWO", two), ("_THREE", three), ("_FOUR", four), ("_SHARE", share)];
    square_with(&mut model, &more, &[]);
    let written = model.grown("custom");
    assert_eq!(written.floats(&attribute("_TWO"))[8..], [2.0, 4.0]);
    assert_eq!(written.floats(&attribute("_THREE"))[12..], [2.0, 4.0, 1.0]);
    assert_eq!(written.floats(&attribute("_FOUR"))[16..], [2.0, 4.0, 1.0, 3.0]);
    let share = written.accessor(&attribute("_SHARE"));
    assert_eq!(written.bytes(share)[16..], [50, (-50i8) as u8, 0, 25], "a signed share");
}

/// The first vertex has eight joints, the two others one each, of which one is new: the eight
/// strongest of nine stay.
#[test]
fn the_sets_of_a_skin_are_merged_and_share_one_sum() {
    let mut model = Model::new();
    let joints = |first: u8| [[first, first + 1, first + 2, first + 3], [1; 4], [9; 4], [9; 4]];
    let low = model.accessor(5121, "VEC4", 4, &joints(1).concat());
    let high = model.accessor(5121, "VEC4", 4, &joints(5).concat());
    let one = [1.0f32, 0.0, 0.0, 0.0];
    let first = model.floats(&[[0.125; 4], one, one, one]);
    let second = model.floats(&[[0.125f32; 4], [0.0; 4], [0.0; 4], [0.0; 4]]);
    let more = [("JOINTS_0", low), ("JOINTS_1", high), ("WEIGHTS_0", first), ("WEIGHTS_1", second)];
    square_with(&mut model, &more, &[]);
    let written = model.grown("two_sets");
    let joints = written.bytes(written.accessor(&attribute("JOINTS_0")));
    assert_eq!(joints[16..18], [1, 9], "the strongest first");
    let weights =
        [0, 1].map(|set| written.floats(&attribute(&format!("WEIGHTS_{set}")))[16..].to_vec());
    let sum: f32 = weights.iter().flatten().sum();
    assert!((sum - 1.0).abs() < 1e-6, "{weights:?}");
    assert!((weights[0][0] - 0.3125 / 0.9375).abs() < 1e-6, "{weights:?}");
    assert!(weights.iter().flatten().all(|weight| *weight > 0.0), "{weights:?}");
}

/// Half of the greatest step is no whole one, so floats take over where the blend needs them.
#[test]
fn quantized_morph_targets_stay_or_turn_into_floats() {
    let mut model = Model::new();
    let words = |first: i16, rest: i16| -> Vec<u8> {
        let rows = [[first, 0, 0, 0], [rest, 0, 0, 0], [rest, 0, 0, 0], [rest, 0, 0, 0]];
        rows.as_flattened().iter().flat_map(|word| word.to_le_bytes()).collect()
    };
    let even = model.normalized(5122, "VEC3", 4, &words(32767, 32767));
    let steep = model.normalized(5122, "VEC3", 4, &words(32767, 0));
    let normals =
        model.normalized(5120, "VEC3", 4, &[[127, 0, 0, 0], [0; 4], [0; 4], [0; 4]].concat());
    for (accessor, stride) in [(even, 8), (steep, 8), (normals, 4)] {
        let view = model.json["accessors"][accessor]["bufferView"].as_u64().unwrap();
        model.json["bufferViews"][view as usize]["byteStride"] = stride.into();
    }
    model.json["extensionsUsed"] = json!(["KHR_mesh_quantization"]);
    let targets = [json!({"POSITION": even}), json!({"POSITION": steep, "NORMAL": normals})];
    square_with(&mut model, &[], &targets);
    let written = model.grown("quantized_targets");
    let target = |place: &str| format!("/meshes/0/primitives/0/targets/{place}");
    assert_eq!(written.accessor(&target("0/POSITION"))["componentType"], 5122);
    for place in ["1/POSITION", "1/NORMAL"] {
        assert_eq!(written.accessor(&target(place))["componentType"], 5126);
        let values = written.floats(&target(place));
        assert_eq!((values[0], &values[12..]), (1.0, &[0.5, 0.0, 0.0][..]), "{place}");
    }
}

/// Half of an even step is a whole one, half of an odd step is none: then floats take over.
#[test]
fn sparse_quantized_morph_targets_stay_sparse() {
    let mut model = Model::new();
    let index = model.view(&[0, 0, 0, 0]);
    let mut sparse = |x: i16| {
        let value = model.view(&[x, 0, 0].map(i16::to_le_bytes).concat());
        let accessor = json!({
            "componentType": 5122, "normalized": true, "count": 4, "type": "VEC3",
            "max": [f64::from(x) / 32767.0, 0, 0], "min": [0, 0, 0],
            "sparse": {
                "count": 1,
                "indices": {"bufferView": index, "componentType": 5121},
                "values": {"bufferView": value},
            },
        });
        let accessors = model.json["accessors"].as_array_mut().unwrap();
        accessors.push(accessor);
        accessors.len() - 1
    };
    let (even, odd) = (sparse(32766), sparse(32767));
    model.json["extensionsUsed"] = json!(["KHR_mesh_quantization"]);
    square_with(&mut model, &[], &[json!({"POSITION": even}), json!({"POSITION": odd})]);
    let written = model.grown("sparse_quantized");
    let kept = written.accessor("/meshes/0/primitives/0/targets/0/POSITION");
    assert_eq!((&kept["componentType"], &kept["sparse"]["count"]), (&json!(5122), &json!(2)));
    let steps = written.bytes(&kept["sparse"]["values"]);
    let steps: Vec<i16> =
        steps.chunks_exact(2).map(|step| i16::from_le_bytes(step.try_into().unwrap())).collect();
    assert_eq!(steps, [32766, 0, 0, 16383, 0, 0]);
    let turned = written.accessor("/meshes/0/primitives/0/targets/1/POSITION");
    assert_eq!(turned["componentType"], 5126);
}

#[test]
fn custom_integer_vectors_are_those_of_the_nearest_vertex() {
    let mut model = Model::new();
    let rows = [[7u16, 70], [8, 80], [9, 90], [9, 90]];
    let bytes = rows.as_flattened().iter().flat_map(|word| word.to_le_bytes());
    let pairs = model.accessor(5123, "VEC2", 4, &bytes.collect::<Vec<u8>>());
    let colors = model.accessor(5121, "VEC4", 4, &[[1, 2, 3, 4], [9; 4], [9; 4], [9; 4]].concat());
    square_with(&mut model, &[("_PAIR", pairs), ("_FOUR", colors)], &[]);
    let written = model.grown("integer_vectors");
    let pairs = written.accessor(&attribute("_PAIR"));
    assert_eq!((&pairs["componentType"], &pairs["type"]), (&json!(5123), &json!("VEC2")));
    assert_eq!(written.bytes(pairs)[16..20], [7, 0, 70, 0], "not half of anything");
    assert_eq!(written.bytes(written.accessor(&attribute("_FOUR")))[16..20], [1, 2, 3, 4]);
}
