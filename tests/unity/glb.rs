//! Just enough of binary glTF to read what deforms a mesh, and to write one with every stream.

use chamfer::MeshBuffers;
use glam::Vec3;
use serde_json::{Value, json};

/// A binary glTF that holds all its data.
pub struct Glb {
    pub json: Value,
    pub bytes: Vec<u8>,
}

impl Glb {
    pub fn parse(file: &[u8]) -> Glb {
        let length = u32::from_le_bytes(file[12..16].try_into().unwrap()) as usize;
        let json = serde_json::from_slice(&file[20..20 + length]).unwrap();
        Glb { json, bytes: file.get(28 + length..).unwrap_or_default().to_vec() }
    }

    /// How many meshes there are; each must have one primitive.
    pub fn mesh_count(&self) -> usize {
        let meshes = self.json["meshes"].as_array().unwrap();
        let single = |mesh: &Value| mesh["primitives"].as_array().is_some_and(|p| p.len() == 1);
        assert!(meshes.iter().all(single));
        meshes.len()
    }

    pub fn primitive(&self, mesh: usize) -> &Value {
        &self.json["meshes"][mesh]["primitives"][0]
    }

    /// An attribute's numbers, one vertex after the other; none if the attribute is absent.
    pub fn attribute(&self, attributes: &Value, name: &str) -> Vec<f32> {
        attributes[name].as_u64().map_or(Vec::new(), |accessor| self.numbers(accessor as usize))
    }

    pub fn numbers(&self, accessor: usize) -> Vec<f32> {
        let accessor = &self.json["accessors"][accessor];
        assert!(accessor["sparse"].is_null(), "no sparse accessors");
        let number = |value: &Value| value.as_u64().unwrap_or(0) as usize;
        let view = &self.json["bufferViews"][number(&accessor["bufferView"])];
        let first = number(&view["byteOffset"]) + number(&accessor["byteOffset"]);
        let width = width_of(accessor["type"].as_str().unwrap());
        let (size, read) = component(number(&accessor["componentType"]));
        let stride = view["byteStride"].as_u64().map_or(size * width, |stride| stride as usize);
        let place = |index: usize| first + index / width * stride + index % width * size;
        let count = number(&accessor["count"]) * width;
        (0..count).map(|index| read(&self.bytes[place(index)..][..size])).collect()
    }
}

fn width_of(shape: &str) -> usize {
    ["SCALAR", "VEC2", "VEC3", "VEC4"].iter().position(|known| *known == shape).unwrap() + 1
}

type Read = fn(&[u8]) -> f32;

/// The size of a component, and how to read it.
fn component(code: usize) -> (usize, Read) {
    match code {
        5121 => (1, |bytes| f32::from(bytes[0])),
        5123 => (2, |bytes| f32::from(u16::from_le_bytes(bytes.try_into().unwrap()))),
        5125 => (4, |bytes| u32::from_le_bytes(bytes.try_into().unwrap()) as f32),
        5126 => (4, |bytes| f32::from_le_bytes(bytes.try_into().unwrap())),
        _ => panic!("component type {code}"),
    }
}

/// A glTF in the making.
#[derive(Default)]
struct Model {
    accessors: Vec<Value>,
    views: Vec<Value>,
    bytes: Vec<u8>,
}

impl Model {
    fn accessor(&mut self, code: u32, shape: &str, count: usize, bytes: &[u8]) -> usize {
        let view = json!({"buffer": 0, "byteOffset": self.bytes.len(), "byteLength": bytes.len()});
        self.bytes.extend_from_slice(bytes);
        self.views.push(view);
        let view = self.views.len() - 1;
        self.accessors.push(
            json!({"bufferView": view, "componentType": code, "count": count, "type": shape}),
        );
        self.accessors.len() - 1
    }

    fn floats<const N: usize>(&mut self, rows: &[[f32; N]]) -> usize {
        let bytes: Vec<u8> = rows.iter().flatten().flat_map(|f| f.to_le_bytes()).collect();
        self.accessor(5126, ["", "", "VEC2", "VEC3", "VEC4"][N], rows.len(), &bytes)
    }

    fn positions(&mut self, rows: &[[f32; 3]]) -> usize {
        let bound = |choose: fn(f32, f32) -> f32| -> Vec<f32> {
            (0..3).map(|axis| rows.iter().map(|row| row[axis]).reduce(choose).unwrap()).collect()
        };
        let accessor = self.floats(rows);
        self.accessors[accessor]["min"] = bound(f32::min).into();
        self.accessors[accessor]["max"] = bound(f32::max).into();
        accessor
    }

    fn shorts(&mut self, shape: &str, width: usize, values: &[u16]) -> usize {
        let bytes: Vec<u8> = values.iter().flat_map(|value| value.to_le_bytes()).collect();
        self.accessor(5123, shape, values.len() / width, &bytes)
    }

    fn glb(self, primitive: Value) -> Vec<u8> {
        let json = json!({
            "asset": {"version": "2.0"}, "accessors": self.accessors, "bufferViews": self.views,
            "buffers": [{"byteLength": self.bytes.len()}],
            "meshes": [{"name": "cube", "primitives": [primitive]}],
        });
        let mut text = json.to_string().into_bytes();
        text.resize(text.len().next_multiple_of(4), b' ');
        let length = 12 + 8 + text.len() + 8 + self.bytes.len();
        let word = |number: usize| (number as u32).to_le_bytes();
        let head = [*b"glTF", word(2), word(length), word(text.len()), *b"JSON"].concat();
        let binary_head = [word(self.bytes.len()), *b"BIN\0"].concat();
        [head, text, binary_head, self.bytes].concat()
    }
}

/// The mesh with every stream that glTF and Unity both have, made up and uneven.
pub fn with_everything(mesh: &MeshBuffers) -> Vec<u8> {
    let count = mesh.positions.len();
    let mut model = Model::default();
    let attributes = json!({
        "POSITION": model.positions(&mesh.positions),
        "NORMAL": model.floats(&mesh.normals),
        "TANGENT": model.floats(&mesh.normals.iter().map(tangent).collect::<Vec<_>>()),
        "TEXCOORD_0": model.floats(&uneven::<2>(count, 5)),
        "TEXCOORD_1": model.floats(&uneven::<2>(count, 11)),
        "COLOR_0": model.floats(&uneven::<4>(count, 2)),
        "JOINTS_0": model.shorts("VEC4", 4, &joints(count)),
        "WEIGHTS_0": model.floats(&vec![[0.5, 0.25, 0.125, 0.125]; count]),
    });
    let target = json!({
        "POSITION": model.floats(&uneven::<3>(count, 6)),
        "NORMAL": model.floats(&uneven::<3>(count, 9)),
        "TANGENT": model.floats(&uneven::<3>(count, 10)),
    });
    let indices: Vec<u16> = mesh.indices.iter().map(|index| *index as u16).collect();
    let indices = model.shorts("SCALAR", 1, &indices);
    model.glb(json!({"attributes": attributes, "indices": indices, "targets": [target]}))
}

fn tangent(normal: &[f32; 3]) -> [f32; 4] {
    let [x, y, z] = Vec3::from(*normal).any_orthonormal_vector().to_array();
    [x, y, z, -1.0]
}

/// Rows of numbers from 0 to 1 that differ from vertex to vertex.
fn uneven<const N: usize>(count: usize, step: usize) -> Vec<[f32; N]> {
    let number = |place: usize| (place * step % 17) as f32 / 17.0;
    (0..count).map(|vertex| std::array::from_fn(|axis| number(3 * vertex + axis))).collect()
}

/// Four joints a vertex, so that a blend of two vertices has more than it may keep.
fn joints(count: usize) -> Vec<u16> {
    (0..count)
        .flat_map(|vertex| [0, 1, 2, 3].map(|joint| (vertex % 7 * 4 + joint) as u16))
        .collect()
}
