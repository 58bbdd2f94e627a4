//! glTF files in and out, as a program that reads the files sees them.

use std::fs;
use std::path::{Path, PathBuf};

use chamfer::{
    Blend, Chamfered, MeshBuffers, TriangleKind, TriangleSource, UV_CHANNELS, VertexSource,
};
use chamfer_cli::document::{Document, OutputFile, ReadOptions};
use chamfer_cli::gltf_file::GltfDocument;
use serde_json::{Value, json};

/// The models live beside the repository and are no part of it.
const CORPUS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../shared/corpus");

fn read(path: &Path) -> anyhow::Result<GltfDocument> {
    GltfDocument::read(path, &ReadOptions { smoothing_angle: 30.0 })
}

/// A folder of its own for a test.
fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("gltf").join(name);
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    folder
}

fn write(files: &[OutputFile]) {
    for file in files {
        fs::create_dir_all(file.path.parent().unwrap()).unwrap();
        fs::write(&file.path, &file.bytes).unwrap();
    }
}

fn identity(mesh: &MeshBuffers) -> Chamfered {
    let source = |v| VertexSource { surface: Blend::one(v), chart: Blend::one(v) };
    let triangle = |index| TriangleSource { kind: TriangleKind::Source, index };
    Chamfered {
        mesh: mesh.clone(),
        vertex_sources: (0..mesh.positions.len() as u32).map(source).collect(),
        triangle_sources: (0..mesh.indices.len() as u32 / 3).map(triangle).collect(),
        ..Chamfered::default()
    }
}

fn unchanged(document: &GltfDocument) -> Vec<Chamfered> {
    document.meshes().iter().map(|source| identity(&source.mesh)).collect()
}

/// Weights of the corners of a triangle that sum to 1 exactly.
const WEIGHTS: [f32; 3] = [0.5, 0.25, 0.25];

/// Adds to each submesh a vertex inside its first triangle, and a triangle that joins it to the
/// last vertex of the first triangle of the next submesh.
fn grown(mesh: &MeshBuffers) -> Chamfered {
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
    result.vertex_sources.push(VertexSource { surface: blend, chart: blend });
    out.positions.len() as u32 - 1
}

fn mean<const N: usize>(stream: &[[f32; N]], triangle: [u32; 3]) -> [f32; N] {
    std::array::from_fn(|axis| {
        let parts = triangle.iter().zip(WEIGHTS);
        parts.map(|(vertex, weight)| stream[*vertex as usize][axis] * weight).sum()
    })
}

fn all_grown(document: &GltfDocument) -> Vec<Chamfered> {
    let grow =
        |mesh: &MeshBuffers| if mesh.indices.is_empty() { identity(mesh) } else { grown(mesh) };
    document.meshes().iter().map(|source| grow(&source.mesh)).collect()
}

fn corpus() -> Vec<PathBuf> {
    let Ok(entries) = fs::read_dir(CORPUS) else {
        eprintln!("SKIPPED: {CORPUS} is not there, so no real glTF model was tried");
        return Vec::new();
    };
    let is_gltf = |path: &PathBuf| path.extension().is_some_and(|e| e == "glb" || e == "gltf");
    let mut models: Vec<PathBuf> = entries.map(|e| e.unwrap().path()).filter(is_gltf).collect();
    models.sort();
    models
}

#[test]
fn unchanged_real_models_go_out_byte_for_byte() {
    let out = folder("unchanged");
    for model in corpus() {
        let document = read(&model).unwrap();
        let output = out.join(model.file_name().unwrap());
        let files = document.encode(&output, &unchanged(&document)).unwrap();
        assert_eq!(files[0].bytes, fs::read(&model).unwrap(), "{}", model.display());
        write(&files);
        assert_eq!(read(&output).unwrap().meshes().len(), document.meshes().len());
    }
}

#[test]
fn changed_real_models_read_back_as_they_were_chamfered() {
    let out = folder("grown");
    for model in corpus() {
        let document = read(&model).unwrap();
        let chamfered = all_grown(&document);
        let output = out.join(model.file_name().unwrap()).with_extension("glb");
        write(&document.encode(&output, &chamfered).unwrap());
        let back = read(&output).unwrap();
        for (result, back) in chamfered.iter().zip(back.meshes()) {
            assert!(corners(&result.mesh) == corners(&back.mesh), "{}", model.display());
        }
    }
}

/// Position and normal of each corner of each triangle: vertices may be numbered differently, and
/// other streams may be absent from a primitive.
fn corners(mesh: &MeshBuffers) -> Vec<[[f32; 3]; 2]> {
    let corner = |vertex: &u32| [&mesh.positions, &mesh.normals].map(|s| s[*vertex as usize]);
    mesh.indices.iter().map(corner).collect()
}

#[test]
fn changed_real_models_keep_all_but_their_geometry() {
    for model in corpus() {
        let document = read(&model).unwrap();
        let output = folder("kept").join("model.gltf");
        let files = document.encode(&output, &all_grown(&document)).unwrap();
        let after: Value = serde_json::from_slice(&files[0].bytes).unwrap();
        let before = json_of(&fs::read(&model).unwrap());
        for (key, value) in before.as_object().unwrap() {
            if !["meshes", "accessors", "bufferViews", "buffers"].contains(&key.as_str()) {
                assert_eq!(after[key], *value, "{key} of {}", model.display());
            }
        }
    }
}

fn json_of(file: &[u8]) -> Value {
    if !file.starts_with(b"glTF") {
        return serde_json::from_slice(file).unwrap();
    }
    let length = u32::from_le_bytes(file[12..16].try_into().unwrap()) as usize;
    serde_json::from_slice(&file[20..20 + length]).unwrap()
}
