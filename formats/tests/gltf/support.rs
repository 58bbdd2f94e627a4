//! Small models made by code, and chamfered meshes made by hand.

use std::fs;
use std::path::{Path, PathBuf};

use chamfer::{
    Blend, Chamfered, MeshBuffers, TriangleKind, TriangleSource, UV_CHANNELS, VertexSource,
};
use chamfer_formats::gltf_file::GltfDocument;
use chamfer_formats::{Document, OutputFile, ReadOptions, encode};
use serde_json::{Value, json};

pub fn read(path: &Path) -> anyhow::Result<GltfDocument> {
    GltfDocument::read(path, &ReadOptions::default())
}

/// Where a test may write.
pub fn path_in(name: &str) -> PathBuf {
    Path::new(env!("CARGO_TARGET_TMPDIR")).join("gltf").join(name)
}

/// An empty folder of its own for a test.
pub fn folder(name: &str) -> PathBuf {
    let folder = path_in(name);
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    folder
}

pub fn write(files: &[OutputFile]) {
    for file in files {
        fs::create_dir_all(file.path.parent().unwrap()).unwrap();
        fs::write(&file.path, &file.bytes).unwrap();
    }
}

fn identity(mesh: &MeshBuffers) -> Chamfered {
    let source = |v| VertexSource::new(Blend::one(v), Blend::one(v));
    let triangle = |index| TriangleSource { kind: TriangleKind::Source, index };
    let mut result = Chamfered::default();
    result.mesh = mesh.clone();
    result.vertex_sources = (0..mesh.positions.len() as u32).map(source).collect();
    result.triangle_sources = (0..mesh.indices.len() as u32 / 3).map(triangle).collect();
    result
}

pub fn unchanged(document: &GltfDocument) -> Vec<Chamfered> {
    document.meshes().iter().map(|source| identity(&source.mesh)).collect()
}

/// Weights of the corners of a triangle that sum to 1 exactly.
const WEIGHTS: [f32; 3] = [0.5, 0.25, 0.25];

/// Adds to each submesh a vertex inside its first triangle, and a triangle that joins it to the
/// last vertex of the first triangle of the next submesh.
pub fn grown(mesh: &MeshBuffers) -> Chamfered {
    let mut result = identity(mesh);
    let firsts = first_triangles(mesh);
    result.mesh.indices.clear();
    let mut from = 0;
    for (submesh, first) in firsts.iter().enumerate() {
        let count = mesh.submesh_index_counts[submesh] as usize;
        let other = firsts[(submesh + 1) % firsts.len()][2];
        let new = push_blend(&mut result, mesh, *first);
        result.mesh.indices.extend(&mesh.indices[from..from + count]);
        result.mesh.indices.extend([first[0], other, new]);
        result.mesh.submesh_index_counts[submesh] += 3;
        result
            .triangle_sources
            .push(TriangleSource { kind: TriangleKind::Corner, index: first[0] });
        from += count;
    }
    result
}

fn first_triangles(mesh: &MeshBuffers) -> Vec<[u32; 3]> {
    let mut from = 0;
    let counts = mesh.submesh_index_counts.iter();
    counts
        .map(|count| {
            let first = [0, 1, 2].map(|corner| mesh.indices[from + corner]);
            from += *count as usize;
            first
        })
        .collect()
}

fn push_blend(result: &mut Chamfered, mesh: &MeshBuffers, triangle: [u32; 3]) -> u32 {
    let blend = Blend { vertices: triangle, weights: WEIGHTS };
    let first = triangle[0] as usize;
    let out = &mut result.mesh;
    out.positions.push(mean(&mesh.positions, triangle));
    out.normals.push(mesh.normals[first]);
    out.tangents.extend(mesh.tangents.get(first));
    if !mesh.colors.is_empty() {
        out.colors.push(mean(&mesh.colors, triangle));
    }
    for channel in (0..UV_CHANNELS).filter(|channel| mesh.uvs[*channel].components == 2) {
        let (uvs, _) = mesh.uvs[channel].values.as_chunks::<2>();
        out.uvs[channel].values.extend(mean(uvs, triangle));
    }
    let added = VertexSource::new(blend, blend);
    result.vertex_sources = result.vertex_sources.iter().chain([added]).collect();
    out.positions.len() as u32 - 1
}

fn mean<const N: usize>(stream: &[[f32; N]], triangle: [u32; 3]) -> [f32; N] {
    std::array::from_fn(|axis| {
        let parts = triangle.iter().zip(WEIGHTS);
        parts.map(|(vertex, weight)| stream[*vertex as usize][axis] * weight).sum()
    })
}

pub fn all_grown(document: &GltfDocument) -> Vec<Chamfered> {
    let grow =
        |mesh: &MeshBuffers| if mesh.indices.is_empty() { identity(mesh) } else { grown(mesh) };
    document.meshes().iter().map(|source| grow(&source.mesh)).collect()
}

/// The JSON of a .glb or .gltf.
pub fn json_of(file: &[u8]) -> Value {
    if !file.starts_with(b"glTF") {
        return serde_json::from_slice(file).unwrap();
    }
    let length = u32::from_le_bytes(file[12..16].try_into().unwrap()) as usize;
    serde_json::from_slice(&file[20..20 + length]).unwrap()
}

/// A glTF in the making, with one buffer.
pub struct Model {
    pub json: Value,
    pub bytes: Vec<u8>,
}

impl Model {
    pub fn new() -> Model {
        let json = json!({
            "asset": {"version": "2.0"}, "accessors": [], "bufferViews": [], "meshes": [],
        });
        Model { json, bytes: Vec::new() }
    }

    fn push(&mut self, list: &str, item: Value) -> usize {
        let items = self.json[list].as_array_mut().unwrap();
        items.push(item);
        items.len() - 1
    }

    pub fn view(&mut self, bytes: &[u8]) -> usize {
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        let offset = self.bytes.len();
        self.bytes.extend_from_slice(bytes);
        let view = json!({"buffer": 0, "byteOffset": offset, "byteLength": bytes.len()});
        self.push("bufferViews", view)
    }

    /// An accessor of a view of its own; `code` is that of the component type.
    pub fn accessor(&mut self, code: u32, shape: &str, count: usize, bytes: &[u8]) -> usize {
        let view = self.view(bytes);
        let accessor =
            json!({"bufferView": view, "componentType": code, "count": count, "type": shape});
        self.push("accessors", accessor)
    }

    pub fn normalized(&mut self, code: u32, shape: &str, count: usize, bytes: &[u8]) -> usize {
        let accessor = self.accessor(code, shape, count, bytes);
        self.json["accessors"][accessor]["normalized"] = true.into();
        accessor
    }

    pub fn floats<const N: usize>(&mut self, values: &[[f32; N]]) -> usize {
        let bytes: Vec<u8> = values.iter().flatten().flat_map(|f| f.to_le_bytes()).collect();
        let shape = ["SCALAR", "VEC2", "VEC3", "VEC4"][N - 1];
        self.accessor(5126, shape, values.len(), &bytes)
    }

    /// Positions with the bounds that glTF asks for.
    pub fn positions(&mut self, values: &[[f32; 3]]) -> usize {
        let accessor = self.floats(values);
        let bound = |choose: fn(f32, f32) -> f32| -> Vec<f32> {
            (0..3).map(|axis| values.iter().map(|p| p[axis]).reduce(choose).unwrap()).collect()
        };
        self.json["accessors"][accessor]["min"] = bound(f32::min).into();
        self.json["accessors"][accessor]["max"] = bound(f32::max).into();
        accessor
    }

    pub fn indices(&mut self, indices: &[u8]) -> usize {
        self.accessor(5121, "SCALAR", indices.len(), indices)
    }

    /// Four positions of a square, with normals up.
    pub fn square(&mut self) -> Value {
        let positions = self.positions(&SQUARE);
        let normals = self.floats(&[[0.0, 0.0, 1.0]; 4]);
        json!({"POSITION": positions, "NORMAL": normals})
    }

    pub fn mesh(&mut self, primitives: Value) -> usize {
        self.push("meshes", json!({"primitives": primitives}))
    }

    pub fn glb(&self) -> Vec<u8> {
        let mut json = self.json.clone();
        if json.get("buffers").is_none() {
            json["buffers"] = json!([{"byteLength": self.bytes.len()}]);
        }
        let mut text = json.to_string().into_bytes();
        text.resize(text.len().next_multiple_of(4), b' ');
        let mut binary = self.bytes.clone();
        binary.resize(binary.len().next_multiple_of(4), 0);
        let length = 12 + 8 + text.len() + 8 + binary.len();
        let word = |number: usize| (number as u32).to_le_bytes();
        [
            &b"glTF"[..],
            &word(2),
            &word(length),
            &word(text.len()),
            b"JSON",
            &text,
            &word(binary.len()),
            b"BIN\0",
            &binary,
        ]
        .concat()
    }

    /// Writes the model as a .glb and reads it.
    pub fn read(&self, name: &str) -> anyhow::Result<GltfDocument> {
        let path = folder(name).join("model.glb");
        fs::write(&path, self.glb()).unwrap();
        read(&path)
    }

    /// The model with a triangle more in each primitive.
    pub fn grown(&self, name: &str) -> Written {
        let document = self.read(name).unwrap();
        let output = path_in(name).join("grown.glb");
        let files = encode(&document, &output, &all_grown(&document)).unwrap().files;
        write(&files);
        Written { json: json_of(&files[0].bytes), bytes: buffer_of(&files[0].bytes) }
    }
}

//  3---2
//  | / |
//  0---1
pub const SQUARE: [[f32; 3]; 4] =
    [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
pub const SQUARE_INDICES: [u8; 6] = [0, 1, 2, 0, 2, 3];

fn buffer_of(glb: &[u8]) -> Vec<u8> {
    let length = u32::from_le_bytes(glb[12..16].try_into().unwrap()) as usize;
    glb[20 + length + 8..].to_vec()
}

/// A .glb that was written, taken apart.
pub struct Written {
    pub json: Value,
    pub bytes: Vec<u8>,
}

impl Written {
    /// The accessor of an attribute, `/meshes/0/primitives/0/attributes/POSITION`.
    pub fn accessor(&self, pointer: &str) -> &Value {
        let index = self.json.pointer(pointer).expect(pointer).as_u64().unwrap();
        &self.json["accessors"][index as usize]
    }

    /// The bytes of its view, which is its own.
    pub fn bytes(&self, accessor: &Value) -> &[u8] {
        let view = &self.json["bufferViews"][accessor["bufferView"].as_u64().unwrap() as usize];
        let number = |key: &str| view[key].as_u64().unwrap() as usize;
        &self.bytes[number("byteOffset")..][..number("byteLength")]
    }

    pub fn floats(&self, pointer: &str) -> Vec<f32> {
        let bytes = self.bytes(self.accessor(pointer));
        let (words, _) = bytes.as_chunks();
        words.iter().map(|word| f32::from_le_bytes(*word)).collect()
    }
}
