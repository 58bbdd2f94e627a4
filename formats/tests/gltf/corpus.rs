//! The real models: unchanged, and with a triangle more in every primitive.

#[path = "../../../tests/support/own_models.rs"]
mod own_models;

use std::fs;
use std::path::{Path, PathBuf};

use chamfer::MeshBuffers;
use chamfer_formats::{Document, encode};
use serde_json::Value;

use crate::support::{all_grown, folder, json_of, read, unchanged, write};

/// The models live beside the repository and are no part of it.
const CORPUS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../shared/corpus");

/// The real models, or our own; each test has a folder for these.
fn corpus(test: &str) -> Vec<PathBuf> {
    let real = Path::new(CORPUS);
    let own = folder(&format!("own_models_{test}"));
    let is_own = own_models::are_needed(real);
    if is_own {
        own_models::stand_in(&own, CORPUS);
    }
    let entries = fs::read_dir(if is_own { &own } else { real }).unwrap();
    let is_gltf = |path: &PathBuf| path.extension().is_some_and(|e| e == "glb" || e == "gltf");
    let mut models: Vec<PathBuf> = entries.map(|e| e.unwrap().path()).filter(is_gltf).collect();
    models.sort();
    models
}

#[test]
fn unchanged_real_models_go_out_byte_for_byte() {
    let out = folder("unchanged");
    for model in corpus("unchanged") {
        let document = read(&model).unwrap();
        let output = out.join(model.file_name().unwrap());
        let files = encode(&document, &output, &unchanged(&document)).unwrap().files;
        assert_eq!(files[0].bytes, fs::read(&model).unwrap(), "{}", model.display());
        write(&files);
        assert_eq!(read(&output).unwrap().meshes().len(), document.meshes().len());
    }
}

#[test]
fn changed_real_models_read_back_as_they_were_chamfered() {
    let out = folder("grown");
    for model in corpus("grown") {
        let document = read(&model).unwrap();
        let chamfered = all_grown(&document);
        let output = out.join(model.file_name().unwrap()).with_extension("glb");
        write(&encode(&document, &output, &chamfered).unwrap().files);
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
    for model in corpus("kept") {
        let document = read(&model).unwrap();
        let output = folder("kept").join("model.gltf");
        let files = encode(&document, &output, &all_grown(&document)).unwrap().files;
        let after: Value = serde_json::from_slice(&files[0].bytes).unwrap();
        let before = json_of(&fs::read(&model).unwrap());
        for (key, value) in before.as_object().unwrap() {
            if !["meshes", "accessors", "bufferViews", "buffers"].contains(&key.as_str()) {
                assert_eq!(after[key], *value, "{key} of {}", model.display());
            }
        }
    }
}
