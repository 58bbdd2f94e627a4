//! A small glTF file with all that the reader looks at: two meshes, several primitives, indices
//! and none, sparse and interleaved accessors, whole-number streams, a skin, morph targets, nodes,
//! an animation, images and extensions.

use chamfer::shapes;
use serde_json::{Value, json};

/// Bytes of the buffer that each accessor below reads.
const STREAMS: usize = 24 * (12 + 12 + 16 + 8 + 4 + 4 + 16 + 12) + 72;

/// The buffer: the streams of a cube one after the other, then the indices.
pub fn rich_binary() -> Vec<u8> {
    let cube = shapes::cube(1.0);
    let floats = |values: &[f32]| values.iter().flat_map(|v| v.to_le_bytes()).collect::<Vec<u8>>();
    let mut bytes = floats(cube.positions.as_flattened());
    bytes.extend(floats(cube.normals.as_flattened()));
    bytes.extend(floats(cube.tangents.as_flattened()));
    bytes.extend(floats(&cube.uvs[0].values));
    bytes.extend([255, 0, 128, 255].repeat(24));
    bytes.extend([0, 1, 0, 0].repeat(24));
    bytes.extend(floats(&[0.25, 0.75, 0.0, 0.0].repeat(24)));
    bytes.extend(floats(&[0.0, 0.5, 0.0].repeat(24)));
    bytes.extend(cube.indices.iter().flat_map(|&index| (index as u16).to_le_bytes()));
    assert_eq!(bytes.len(), STREAMS);
    bytes
}

/// The JSON, whose one buffer has no URI yet.
pub fn rich_json() -> Value {
    json!({
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [
            {"children": [1, 2, 3], "translation": [1, 0, 0], "rotation": [0, 0, 0, 1]},
            {"mesh": 0, "skin": 0, "scale": [2, 2, -2]},
            {"mesh": 1, "matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1], "weights": [0.5]},
            {"mesh": 2}
        ],
        "meshes": [
            {"name": "skinned", "primitives": [{
                "attributes": {"POSITION": 0, "NORMAL": 1, "TANGENT": 2, "TEXCOORD_0": 3,
                    "COLOR_0": 4, "JOINTS_0": 5, "WEIGHTS_0": 6, "_OWN": 7},
                "indices": 8, "material": 0
            }, {
                "attributes": {"POSITION": 0}, "mode": 1
            }]},
            {"name": "morphed", "weights": [0.0], "extras": {"targetNames": ["up"]}, "primitives": [{
                "attributes": {"POSITION": 0, "NORMAL": 1}, "indices": 8,
                "targets": [{"POSITION": 9}]
            }, {
                "attributes": {"POSITION": 0, "NORMAL": 1}, "indices": 10,
                "targets": [{"POSITION": 7}]
            }]},
            {"name": "loose", "primitives": [
                {"attributes": {"POSITION": 0}},
                {"attributes": {"POSITION": 0}, "indices": 8, "mode": 5}
            ]}
        ],
        "accessors": accessors(),
        "bufferViews": buffer_views(),
        "buffers": [{"byteLength": STREAMS}],
        "skins": [{"joints": [0, 1], "skeleton": 0}],
        "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}},
            "normalTexture": {"index": 0, "texCoord": 0}}],
        "textures": [{"source": 0}],
        "images": [{"uri": "a%20picture.png"}, {"bufferView": 3, "mimeType": "image/png"}],
        "animations": [{"channels": [{"sampler": 0, "target": {"node": 2, "path": "weights"}}],
            "samplers": [{"input": 11, "output": 11}]}],
        "extensionsUsed": ["KHR_texture_transform", "VENDOR_own"],
        "extensions": {"VENDOR_own": {"accessor": 1, "list": [0, 1]}}
    })
}

fn accessors() -> Value {
    let plain = |view: u32, component: u32, shape: &str| json!({"bufferView": view, "componentType": component, "count": 24, "type": shape});
    let mut accessors = vec![
        plain(0, 5126, "VEC3"),
        plain(1, 5126, "VEC3"),
        plain(2, 5126, "VEC4"),
        plain(3, 5126, "VEC2"),
        plain(4, 5121, "VEC4"),
        plain(5, 5121, "VEC4"),
        plain(6, 5126, "VEC4"),
        plain(7, 5126, "VEC3"),
    ];
    accessors[0]["min"] = json!([-0.5, -0.5, -0.5]);
    accessors[0]["max"] = json!([0.5, 0.5, 0.5]);
    accessors[4]["normalized"] = json!(true);
    accessors.push(json!({"bufferView": 8, "componentType": 5123, "count": 36, "type": "SCALAR"}));
    accessors.push(json!({"componentType": 5126, "count": 24, "type": "VEC3", "sparse": {
        "count": 2,
        "indices": {"bufferView": 8, "componentType": 5123, "byteOffset": 2},
        "values": {"bufferView": 7}
    }}));
    accessors.push(json!({"bufferView": 8, "byteOffset": 36, "componentType": 5123, "count": 18,
        "type": "SCALAR"}));
    accessors.push(json!({"bufferView": 3, "componentType": 5126, "count": 2, "type": "SCALAR"}));
    Value::Array(accessors)
}

fn buffer_views() -> Value {
    let mut offset = 0;
    let view = |length: usize| {
        let view = json!({"buffer": 0, "byteOffset": offset, "byteLength": length});
        offset += length;
        view
    };
    [12, 12, 16, 8, 4, 4, 16, 12].map(|size| 24 * size).into_iter().chain([72]).map(view).collect()
}

/// A .glb.
pub fn wrap_in_chunks(json: &Value, binary: &[u8]) -> Vec<u8> {
    let mut json = json.to_string().into_bytes();
    json.resize(json.len().next_multiple_of(4), b' ');
    let word = |number: usize| (number as u32).to_le_bytes();
    let total = 12 + 8 + json.len() + 8 + binary.len();
    let parts: [&[u8]; 9] = [
        b"glTF",
        &word(2),
        &word(total),
        &word(json.len()),
        b"JSON",
        &json,
        &word(binary.len()),
        b"BIN\0",
        binary,
    ];
    parts.concat()
}

/// A .gltf with its buffer inside.
pub fn wrap_in_json(mut json: Value, binary: &[u8]) -> Vec<u8> {
    let data: String = binary.iter().map(|byte| format!("%{byte:02X}")).collect();
    if let Some(buffer) = json.pointer_mut("/buffers/0").and_then(Value::as_object_mut) {
        buffer.insert("uri".into(), format!("data:,{data}").into());
    }
    json.to_string().into_bytes()
}
