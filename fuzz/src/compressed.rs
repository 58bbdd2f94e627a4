//! Small glTF files whose geometry is compressed.

use serde_json::{Value, json};

use crate::gltf::wrap_in_chunks;

/// How a file of a few bytes is to be taken, in front of the compressed data.
pub const HEAD: usize = 6;

/// A file around compressed data: what the first bytes say of the rest may be wrong.
///
/// The first tells Draco (even) from meshopt, the others are for meshopt alone: mode, a quarter of
/// the stride, filter, and the count in two bytes.
pub fn wrap(input: &[u8]) -> Option<Vec<u8>> {
    let (head, packed) = input.split_first_chunk::<HEAD>()?;
    let json =
        if head[0].is_multiple_of(2) { draco(packed.len()) } else { meshopt(head, packed.len()) };
    Some(wrap_in_chunks(&json, packed))
}

fn meshopt(head: &[u8; HEAD], length: usize) -> Value {
    let [_, mode, quarter, filter, low, high] = *head;
    let (stride, count) = (4 * usize::from(quarter), usize::from(u16::from_le_bytes([low, high])));
    let mode = ["ATTRIBUTES", "TRIANGLES", "INDICES"][usize::from(mode) % 3];
    let stride = if mode == "ATTRIBUTES" { stride } else { [2, 4][usize::from(quarter) % 2] };
    let filters = ["NONE", "OCTAHEDRAL", "QUATERNION", "EXPONENTIAL", "COLOR"];
    let (component, shape) = if mode == "ATTRIBUTES" { (5126, "VEC3") } else { (5123, "SCALAR") };
    json!({
        "asset": {"version": "2.0"},
        "buffers": [
            {"byteLength": length},
            {"byteLength": 0, "extensions": {"EXT_meshopt_compression": {"fallback": true}}},
        ],
        "bufferViews": [{
            "buffer": 1, "byteLength": stride * count,
            "extensions": {"EXT_meshopt_compression": {
                "buffer": 0, "byteLength": length, "byteStride": stride, "count": count,
                "mode": mode, "filter": filters[usize::from(filter) % filters.len()],
            }},
        }],
        "accessors": [
            {"bufferView": 0, "componentType": component, "type": shape, "count": count},
            {"componentType": 5126, "type": "VEC3", "count": 64},
        ],
        "meshes": [{"primitives": [match mode {
            "ATTRIBUTES" => json!({"attributes": {"POSITION": 0}}),
            _ => json!({"attributes": {"POSITION": 1}, "indices": 0}),
        }]}],
        "extensionsRequired": ["EXT_meshopt_compression"],
    })
}

fn draco(length: usize) -> Value {
    json!({
        "asset": {"version": "2.0"},
        "buffers": [{"byteLength": length}],
        "bufferViews": [{"buffer": 0, "byteLength": length}],
        "accessors": [
            {"componentType": 5126, "type": "VEC3", "count": 24},
            {"componentType": 5126, "type": "VEC3", "count": 24},
            {"componentType": 5123, "type": "SCALAR", "count": 36},
        ],
        "meshes": [{"primitives": [{
            "attributes": {"POSITION": 0, "NORMAL": 1}, "indices": 2,
            "extensions": {"KHR_draco_mesh_compression": {
                "bufferView": 0, "attributes": {"POSITION": 0, "NORMAL": 1},
            }},
        }]}],
        "extensionsRequired": ["KHR_draco_mesh_compression"],
    })
}
