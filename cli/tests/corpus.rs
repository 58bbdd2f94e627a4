//! The built `chamfer` on all the real models beside the project: every file goes through, and
//! what comes out reads back as the report says.

#[path = "../../tests/support/own_models.rs"]
mod own_models;

use std::path::{Path, PathBuf};
use std::process::Command;

use chamfer_formats as formats;
use chamfer_formats::ReadOptions;
use serde_json::Value;

/// The models live beside the repository and are no part of it.
const CORPUS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../shared/corpus");

/// Models, as the folder's own list has it.
const MODELS: usize = 120;

#[test]
fn every_real_model_goes_through_and_reads_back() {
    let folder = tempfile::tempdir().unwrap();
    let own = folder.path().join("own");
    let (models, count) = if own_models::are_needed(Path::new(CORPUS)) {
        let count = own_models::stand_in(&own, CORPUS).len();
        (own.as_path(), count)
    } else {
        (Path::new(CORPUS), MODELS)
    };
    let report = chamfer_all(models, folder.path());
    let files = report["files"].as_array().unwrap();
    assert_eq!(files.len(), count);
    for file in files {
        let output = PathBuf::from(file["output"].as_str().unwrap());
        let expected: u64 = triangles_out(file).iter().sum();
        assert_eq!(triangles_of(&output), expected, "{}", output.display());
    }
}

/// Runs the command on the whole folder, at half a percent, and returns its report.
fn chamfer_all(models: &Path, folder: &Path) -> Value {
    let report = folder.join("report.json");
    let run = Command::new(env!("CARGO_BIN_EXE_chamfer"))
        .arg(models)
        .args(["--width-percent", "0.5", "-o"])
        .arg(folder.join("out/"))
        .arg("--report")
        .arg(&report)
        .output()
        .unwrap();
    assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
    serde_json::from_slice(&std::fs::read(&report).unwrap()).unwrap()
}

fn triangles_out(file: &Value) -> Vec<u64> {
    let meshes = file["meshes"].as_array().unwrap();
    meshes.iter().map(|mesh| mesh["triangles_out"].as_u64().unwrap()).collect()
}

/// How many triangles the reader finds in a file.
fn triangles_of(path: &Path) -> u64 {
    let document = formats::read(path, &ReadOptions::default())
        .unwrap_or_else(|error| panic!("{}: {error:#}", path.display()));
    let indices: usize = document.meshes().iter().map(|mesh| mesh.mesh.indices.len()).sum();
    indices as u64 / 3
}
