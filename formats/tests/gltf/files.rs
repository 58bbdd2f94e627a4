//! One file or several: .glb and .gltf, buffers and images beside the model or inside it.

use std::fs;
use std::path::Path;

use chamfer_formats::{Document, encode};
use serde_json::{Value, json};

use crate::support::{Model, SQUARE_INDICES, all_grown, folder, json_of, read, unchanged, write};

fn square() -> Model {
    let mut model = Model::new();
    let attributes = model.square();
    let indices = model.indices(&SQUARE_INDICES);
    model.mesh(json!([{"attributes": attributes, "indices": indices}]));
    model
}

/// Writes a .gltf with its buffer at `uri` and an image beside it.
fn write_gltf(folder: &Path, uri: &str) -> std::path::PathBuf {
    let model = square();
    let mut json = model.json.clone();
    json["buffers"] = json!([{"uri": uri, "byteLength": model.bytes.len()}]);
    json["images"] = json!([{"uri": "Textures/color%20map.png"}]);
    fs::create_dir_all(folder.join("Textures")).unwrap();
    fs::write(folder.join("Textures/color map.png"), b"PNG").unwrap();
    fs::write(folder.join("shape.bin"), &model.bytes).unwrap();
    let path = folder.join("model.gltf");
    fs::write(&path, json.to_string()).unwrap();
    path
}

fn names(files: &[chamfer_formats::OutputFile], folder: &Path) -> Vec<String> {
    let name = |path: &Path| path.strip_prefix(folder).unwrap().to_string_lossy().into_owned();
    files.iter().map(|file| name(&file.path)).collect()
}

#[test]
fn a_gltf_to_another_folder_takes_its_files_along() {
    let (from, to) = (folder("along_from"), folder("along_to"));
    let document = read(&write_gltf(&from, "shape.bin")).unwrap();
    let output = to.join("out.gltf");
    let same = encode(&document, &output, &unchanged(&document)).unwrap().files;
    assert_eq!(names(&same, &to), ["out.gltf", "shape.bin", "Textures/color map.png"]);
    assert_eq!(same[0].bytes, fs::read(from.join("model.gltf")).unwrap());
    let changed = encode(&document, &output, &all_grown(&document)).unwrap().files;
    assert_eq!(names(&changed, &to), ["out.gltf", "out.bin", "Textures/color map.png"]);
    write(&changed);
    assert_eq!(read(&output).unwrap().meshes()[0].mesh.indices.len(), 9);
}

#[test]
fn beside_the_input_only_new_files_are_written() {
    let folder = folder("beside");
    let document = read(&write_gltf(&folder, "shape.bin")).unwrap();
    let output = folder.join("out.gltf");
    let same = encode(&document, &output, &unchanged(&document)).unwrap().files;
    assert_eq!(names(&same, &folder), ["out.gltf"]);
    let changed = encode(&document, &output, &all_grown(&document)).unwrap().files;
    assert_eq!(names(&changed, &folder), ["out.gltf", "out.bin"]);
}

#[test]
fn a_buffer_of_the_input_is_not_overwritten() {
    let folder = folder("protected");
    let document = read(&write_gltf(&folder, "shape.bin")).unwrap();
    let error = encode(&document, &folder.join("shape.gltf"), &all_grown(&document)).err().unwrap();
    assert!(error.to_string().contains("belongs to the input"));
}

#[test]
fn another_image_of_the_same_name_is_not_overwritten() {
    let (from, to) = (folder("taken_from"), folder("taken_to"));
    let document = read(&write_gltf(&from, "shape.bin")).unwrap();
    fs::create_dir_all(to.join("Textures")).unwrap();
    fs::write(to.join("Textures/color map.png"), b"another").unwrap();
    let error = encode(&document, &to.join("out.glb"), &all_grown(&document)).err().unwrap();
    assert!(error.to_string().contains("another content"));
}

#[test]
fn pictures_of_a_gltf_go_into_a_glb() {
    let (from, to) = (folder("embed_from"), folder("embed_to"));
    let path = write_gltf(&from, "shape.bin");
    let png = b"\x89PNG\r\n\x1A\n...";
    fs::write(from.join("Textures/color map.png"), png).unwrap();
    let document = read(&path).unwrap();
    for chamfered in [unchanged(&document), all_grown(&document)] {
        let files = encode(&document, &to.join("out.glb"), &chamfered).unwrap().files;
        assert_eq!(names(&files, &to), ["out.glb"]);
        let json = json_of(&files[0].bytes);
        let image = &json["images"][0];
        assert_eq!((&image["mimeType"], image.get("uri")), (&json!("image/png"), None));
        let view = &json["bufferViews"][image["bufferView"].as_u64().unwrap() as usize];
        let number = |key: &str| view[key].as_u64().unwrap() as usize;
        let start = files[0].bytes.len() - number("byteLength").next_multiple_of(4);
        assert_eq!(files[0].bytes[start..][..number("byteLength")], *png);
        assert_eq!(json["buffers"][0]["byteLength"], number("byteOffset") + png.len());
    }
    fs::remove_file(from.join("Textures/color map.png")).unwrap();
    let files = encode(&document, &to.join("out.glb"), &unchanged(&document)).unwrap().files;
    assert_eq!(json_of(&files[0].bytes)["images"][0]["uri"], "Textures/color%20map.png");
}

#[test]
fn data_uris_stay_data_uris() {
    let folder = folder("data");
    let uri = format!("data:application/octet-stream;base64,{}", base64(&square().bytes));
    let document = read(&write_gltf(&folder, &uri)).unwrap();
    let output = folder.join("out.gltf");
    let files = encode(&document, &output, &all_grown(&document)).unwrap().files;
    assert_eq!(names(&files, &folder), ["out.gltf"]);
    write(&files);
    assert_eq!(read(&output).unwrap().meshes()[0].mesh.indices.len(), 9);
}

fn base64(bytes: &[u8]) -> String {
    use base64::Engine;
    base64::engine::general_purpose::STANDARD.encode(bytes)
}

#[test]
fn formats_convert_into_each_other_and_back() {
    let folder = folder("convert");
    let path = folder.join("model.glb");
    fs::write(&path, square().glb()).unwrap();
    let document = read(&path).unwrap();
    write(&encode(&document, &folder.join("other.gltf"), &unchanged(&document)).unwrap().files);
    assert!(folder.join("other.bin").exists());
    let other = read(&folder.join("other.gltf")).unwrap();
    assert_eq!(other.meshes()[0].mesh, document.meshes()[0].mesh);
    let back = encode(&other, &folder.join("back.glb"), &unchanged(&other)).unwrap().files;
    assert_eq!(back.len(), 1);
    assert_eq!(json_of(&back[0].bytes), json_of(&square().glb()));
}

#[test]
fn several_buffers_are_folded_into_one() {
    let folder = folder("fold");
    let mut model = square();
    let mut json: Value = model.json.take();
    json["bufferViews"][0]["buffer"] = 1.into();
    json["buffers"] = json!([
        {"uri": "all.bin", "byteLength": model.bytes.len()},
        {"uri": "all.bin", "byteLength": model.bytes.len()},
    ]);
    fs::write(folder.join("all.bin"), &model.bytes).unwrap();
    fs::write(folder.join("model.gltf"), json.to_string()).unwrap();
    let document = read(&folder.join("model.gltf")).unwrap();
    write(&encode(&document, &folder.join("out.glb"), &unchanged(&document)).unwrap().files);
    let out = read(&folder.join("out.glb")).unwrap();
    assert_eq!(out.meshes()[0].mesh, document.meshes()[0].mesh);
}

#[test]
fn uris_that_leave_the_folder_are_refused() {
    let folder = folder("leave/inner");
    fs::write(folder.join("../shape.bin"), square().bytes).unwrap();
    for uri in ["../shape.bin", "/etc/hostname", "file:///etc/hostname", "http://a.b/shape.bin"] {
        let error = format!("{:#}", read(&write_gltf(&folder, uri)).err().unwrap());
        assert!(error.contains("leaves the model's folder"), "{uri}: {error}");
    }
}

#[test]
fn a_buffer_that_is_no_file_is_refused() {
    let folder = folder("no_file");
    for uri in ["Textures", "absent.bin"] {
        assert!(read(&write_gltf(&folder, uri)).is_err(), "{uri}");
    }
}
