//! Geometry compressed with meshopt and Draco, by encoders of other people.

use std::fs;
use std::path::Path;

use chamfer::{MeshBuffers, Options, Width, chamfer, shapes};
use chamfer_formats::{Document, Encoded, ReadOptions, compress, decode, encode, glb};
use serde_json::{Value, json};

use crate::draco::draco_bytes;
use crate::support::{Model, all_grown, folder, json_of, read, unchanged, write};

/// A cube with normals and texture coordinates, as a model whose views are its streams.
fn plain_cube() -> (Model, MeshBuffers) {
    let mesh = shapes::cube(1.0);
    let mut model = Model::new();
    let (uvs, _) = mesh.uvs[0].values.as_chunks::<2>();
    let positions = model.positions(&mesh.positions);
    let [normals, uvs] = [model.floats(&mesh.normals), model.floats(uvs)];
    let indices = model.indices(&mesh.indices.iter().map(|&i| i as u8).collect::<Vec<_>>());
    model.mesh(json!([{
        "attributes": {"POSITION": positions, "NORMAL": normals, "TEXCOORD_0": uvs},
        "indices": indices
    }]));
    (model, mesh)
}

/// The same with its views compressed: the buffer has only what the extension names, and another
/// buffer, which is not there, stands in for the views.
fn meshopt_cube() -> (Model, MeshBuffers) {
    let (plain, mesh) = plain_cube();
    let (uvs, _) = mesh.uvs[0].values.as_chunks::<2>();
    let mut model = Model { json: plain.json, bytes: Vec::new() };
    let packed = [
        (meshopt::encode_vertex_buffer(&mesh.positions), 12, "ATTRIBUTES", 24),
        (meshopt::encode_vertex_buffer(&mesh.normals), 12, "ATTRIBUTES", 24),
        (meshopt::encode_vertex_buffer(uvs), 8, "ATTRIBUTES", 24),
        (meshopt::encode_index_buffer(&mesh.indices, 24), 2, "TRIANGLES", 36),
    ];
    for (view, (bytes, stride, mode, count)) in packed.into_iter().enumerate() {
        let bytes = bytes.unwrap();
        let value = &mut model.json["bufferViews"][view];
        *value = json!({
            "buffer": 1, "byteOffset": 1000 * view, "byteLength": stride * count,
            "extensions": {"EXT_meshopt_compression": {
                "buffer": 0, "byteOffset": model.bytes.len(), "byteLength": bytes.len(),
                "byteStride": stride, "mode": mode, "count": count,
            }},
        });
        model.bytes.extend(bytes);
        model.bytes.resize(model.bytes.len().next_multiple_of(4), 0);
    }
    model.json["accessors"][3]["componentType"] = 5123.into();
    for key in ["extensionsUsed", "extensionsRequired"] {
        model.json[key] = json!(["EXT_meshopt_compression"]);
    }
    model.json["buffers"] = json!([
        {"byteLength": model.bytes.len()},
        {"byteLength": 4000, "extensions": {"EXT_meshopt_compression": {"fallback": true}}},
    ]);
    (model, mesh)
}

/// The cube as two primitives of one Draco mesh, in accessors without views.
fn draco_cube(speed: i32) -> (Model, MeshBuffers) {
    let (plain, mesh) = plain_cube();
    let mut model = Model { json: plain.json, bytes: Vec::new() };
    model.json["bufferViews"] = json!([]);
    let view = model.view(&draco_bytes(&mesh, speed));
    for accessor in model.json["accessors"].as_array_mut().unwrap() {
        accessor.as_object_mut().unwrap().remove("bufferView");
    }
    let extension = json!({"KHR_draco_mesh_compression": {
        "bufferView": view, "attributes": {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2},
    }});
    let primitives = model.json["meshes"][0]["primitives"].as_array_mut().unwrap();
    primitives[0]["extensions"] = extension;
    for key in ["extensionsUsed", "extensionsRequired"] {
        model.json[key] = json!(["KHR_draco_mesh_compression"]);
    }
    (model, mesh)
}

/// The corners of all triangles, wherever the triangle starts, in an order that does not depend on
/// that of the file.
fn triangles(mesh: &MeshBuffers) -> Vec<[[f32; 8]; 3]> {
    let corner = |index: &u32| {
        let vertex = *index as usize;
        let ([x, y, z], [a, b, c]) = (mesh.positions[vertex], mesh.normals[vertex]);
        let uv = &mesh.uvs[0].values[2 * vertex..];
        // Compression rounds.
        [x, y, z, a, b, c, uv[0], uv[1]].map(|number| (number * 64.0).round() / 64.0 + 0.0)
    };
    let mut triangles: Vec<[[f32; 8]; 3]> = Vec::new();
    for triangle in mesh.indices.as_chunks::<3>().0 {
        let corners = [0, 1, 2].map(|first| {
            [first, (first + 1) % 3, (first + 2) % 3].map(|place| corner(&triangle[place]))
        });
        triangles.extend(corners.into_iter().min_by(|a, b| a.partial_cmp(b).unwrap()));
    }
    triangles.sort_by(|a, b| a.partial_cmp(b).unwrap());
    triangles
}

/// Reads the model and writes it: without a trace of the compression, unchanged or not.
#[track_caller]
fn comes_out_plain(name: &str, model: &Model, mesh: &MeshBuffers, extension: &str) {
    let document = model.read(name).unwrap();
    assert_eq!(triangles(&document.meshes()[0].mesh), triangles(mesh));
    for (chamfered, added) in [(unchanged(&document), 0), (all_grown(&document), 1)] {
        for ending in ["glb", "gltf"] {
            let output =
                folder(&format!("{name}/{ending}{added}")).join("out").with_extension(ending);
            let encoded = encode(&document, &output, &chamfered).unwrap();
            let told = format!("it was compressed ({extension}), and is written without");
            assert_eq!(encoded.notes, [told]);
            let files = encoded.files;
            for file in &files {
                fs::write(&file.path, &file.bytes).unwrap();
            }
            let json = json_of(&files[0].bytes);
            assert!(!json.to_string().contains(extension), "{json}");
            assert_eq!(json["buffers"].as_array().unwrap().len(), 1);
            check_views(&json);
            let again = read(&output).unwrap();
            assert_eq!(again.meshes()[0].mesh.indices.len(), mesh.indices.len() + 3 * added);
            assert_eq!(again.meshes()[0].mesh.positions.len(), 24 + added);
        }
    }
}

/// Every view is used, and the buffer holds hardly more: nothing compressed is left.
fn check_views(json: &Value) {
    let number = |value: &Value, key: &str| value[key].as_u64().unwrap_or(0);
    let views = json["bufferViews"].as_array().unwrap();
    for view in 0..views.len() as u64 {
        let accessors = json["accessors"].as_array().unwrap();
        assert!(accessors.iter().any(|accessor| accessor["bufferView"] == view), "{json}");
    }
    let used: u64 = views.iter().map(|view| number(view, "byteLength").next_multiple_of(4)).sum();
    // What stood between the compressed views to align them may be left.
    let length = number(&json["buffers"][0], "byteLength");
    assert!((used..used + 4 * views.len() as u64 + 1).contains(&length.next_multiple_of(4)));
}

#[test]
fn meshopt_is_read_and_written_plain() {
    let (model, mesh) = meshopt_cube();
    comes_out_plain("meshopt", &model, &mesh, "EXT_meshopt_compression");
}

#[test]
fn the_newer_name_of_meshopt_is_known_too() {
    let (mut model, mesh) = meshopt_cube();
    let text = model.json.to_string().replace("EXT_meshopt", "KHR_meshopt");
    model.json = serde_json::from_str(&text).unwrap();
    comes_out_plain("khr_meshopt", &model, &mesh, "KHR_meshopt_compression");
}

/// A fallback is there for those who cannot unpack; what is packed need not even make sense.
#[test]
fn a_fallback_that_is_there_is_read() {
    let (mut model, mesh) = plain_cube();
    model.json["bufferViews"][0]["extensions"] = json!({"EXT_meshopt_compression": {
        "buffer": 1, "byteLength": 16, "byteStride": 12, "mode": "ATTRIBUTES", "count": 24,
    }});
    model.json["extensionsUsed"] = json!(["EXT_meshopt_compression"]);
    let uri = "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAAAAAA==";
    let fallback = json!({"EXT_meshopt_compression": {"fallback": true}});
    model.json["buffers"] = json!([
        {"byteLength": model.bytes.len(), "extensions": fallback}, {"byteLength": 16, "uri": uri},
    ]);
    comes_out_plain("fallback", &model, &mesh, "EXT_meshopt_compression");
}

#[test]
fn draco_is_read_and_written_plain() {
    for speed in [0, 5, 10] {
        let (model, mesh) = draco_cube(speed);
        comes_out_plain(&format!("draco{speed}"), &model, &mesh, "KHR_draco_mesh_compression");
    }
}

/// Two meshes name the same accessors for different data: each gets its own.
#[test]
fn draco_meshes_that_share_accessors_come_apart() {
    let (mut model, mesh) = draco_cube(5);
    let mut larger = shapes::cube(2.0);
    larger.tangents.clear();
    let view = model.view(&draco_bytes(&larger, 5));
    let mut other = model.json["meshes"][0].clone();
    other["primitives"][0]["extensions"]["KHR_draco_mesh_compression"]["bufferView"] = view.into();
    model.json["meshes"].as_array_mut().unwrap().push(other);
    let document = model.read("draco_shared").unwrap();
    let read: Vec<_> = document.meshes().iter().map(|mesh| triangles(&mesh.mesh)).collect();
    assert_eq!(read, [triangles(&mesh), triangles(&larger)]);
}

fn error(model: &Model, name: &str) -> String {
    format!("{:#}", model.read(name).err().expect("it should be refused"))
}

#[test]
fn what_cannot_be_unpacked_is_named() {
    let (mut model, _) = meshopt_cube();
    model.bytes[0] = 0x55;
    assert!(error(&model, "bad_meshopt").starts_with("bufferViews[0] cannot be unpacked"));
    let (mut model, _) = meshopt_cube();
    let extension = &mut model.json["bufferViews"][1]["extensions"]["EXT_meshopt_compression"];
    extension["byteLength"] = 1_000_000.into();
    assert!(error(&model, "far_meshopt").starts_with("bufferViews[1] reaches past the end"));
    let (mut model, _) = draco_cube(5);
    model.bytes[0] = b'X';
    let message = error(&model, "bad_draco");
    assert!(message.starts_with("the Draco data of meshes[0].primitives[0] cannot"), "{message}");
    let (mut model, _) = draco_cube(5);
    model.json["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"]["attributes"]
        ["NORMAL"] = 9.into();
    assert!(error(&model, "other_draco").contains("NORMAL: it is not there"));
}

/// Every byte wrong once, and the file cut off everywhere: read or refused, and never a panic.
#[test]
fn damaged_data_is_read_or_refused() {
    for (name, (model, _)) in [("meshopt", meshopt_cube()), ("draco", draco_cube(0))] {
        let path = folder(&format!("damaged_{name}")).join("model.glb");
        for place in 0..model.bytes.len() {
            for wrong in [0, 0x7F, 0xFF, model.bytes[place] ^ 1] {
                let mut bytes = model.bytes.clone();
                bytes[place] = wrong;
                read_or_refuse(&path, &Model { json: model.json.clone(), bytes });
            }
            let bytes = model.bytes[..place].to_vec();
            let mut json = model.json.clone();
            if name == "meshopt" {
                json["buffers"][0]["byteLength"] = place.into();
            }
            read_or_refuse(&path, &Model { json, bytes });
        }
    }
}

fn read_or_refuse(path: &Path, model: &Model) {
    let options = chamfer_formats::ReadOptions::default();
    match chamfer_formats::decode(path, model.glb(), &options) {
        Ok(document) => {
            for source in document.meshes() {
                let count = source.mesh.positions.len();
                assert!(source.mesh.indices.iter().all(|&index| (index as usize) < count));
            }
        }
        Err(error) => assert!(!error.to_string().is_empty()),
    }
}

fn binary_length(glb: &[u8]) -> usize {
    glb.len() - 28 - u32::from_le_bytes(glb[12..16].try_into().unwrap()) as usize
}

/// A field of cubes is compressed without loss: every stream and every index is as it was.
#[test]
fn what_is_compressed_here_is_read_again_bit_for_bit() {
    let field = shapes::cube_field(200);
    let plain = glb::encode("field", &field, &[], &[]).unwrap();
    let document = decode(Path::new("field.glb"), plain, &ReadOptions::default()).unwrap();
    let options = Options::default().with_width(Width::Units(0.1));
    let chamfered = [chamfer(&document.meshes()[0].mesh.as_mesh(), &options).unwrap()];
    for ending in ["glb", "gltf"] {
        let output = folder(&format!("packed_{ending}")).join("out").with_extension(ending);
        let mut encoded = encode(&*document, &output, &chamfered).unwrap();
        let size = |encoded: &Encoded| encoded.files.iter().map(|f| f.bytes.len()).sum::<usize>();
        let before = size(&encoded);
        compress(&mut encoded).unwrap();
        assert!(size(&encoded) * 2 < before, "{} of {before}", size(&encoded));
        assert!(encoded.notes[0].starts_with("written with EXT_meshopt_compression: "));
        let json = json_of(&encoded.files[0].bytes);
        assert_eq!(json["extensionsRequired"], json!(["EXT_meshopt_compression"]));
        let packed = &json["bufferViews"][0]["extensions"]["EXT_meshopt_compression"];
        assert_eq!((packed.get("filter"), &packed["buffer"]), (None, &json!(0)));
        assert_eq!(json["buffers"][1]["extensions"]["EXT_meshopt_compression"]["fallback"], true);
        // Of version 0, as the extension wants it.
        let bytes = &encoded.files[encoded.files.len() - 1].bytes;
        let start = if ending == "glb" { bytes.len() - binary_length(bytes) } else { 0 };
        assert_eq!(bytes[start + packed["byteOffset"].as_u64().unwrap() as usize], 0xA0);
        write(&encoded.files);
        let again = read(&output).unwrap();
        let mesh = &again.meshes()[0].mesh;
        assert_eq!(mesh.indices, chamfered[0].mesh.indices);
        assert_eq!(mesh.positions, chamfered[0].mesh.positions);
        assert_eq!(mesh.normals, chamfered[0].mesh.normals);
        assert_eq!(mesh.uvs, chamfered[0].mesh.uvs);
        let unchanged = unchanged(&again);
        let mut twice = encode(&again, &output, &unchanged).unwrap();
        compress(&mut twice).unwrap();
        assert_eq!(twice.notes.len(), 1, "{:?}", twice.notes);
    }
}

#[test]
fn pictures_and_other_formats_are_not_compressed() {
    let (mut model, _) = plain_cube();
    let picture = vec![7; 4000];
    let view = model.view(&picture);
    model.json["images"] = json!([{"bufferView": view, "mimeType": "image/png"}]);
    let document = model.read("packed_picture").unwrap();
    let folder = folder("packed_picture");
    let mut encoded = encode(&document, &folder.join("out.glb"), &all_grown(&document)).unwrap();
    compress(&mut encoded).unwrap();
    let json = json_of(&encoded.files[0].bytes);
    let image = &json["bufferViews"][json["images"][0]["bufferView"].as_u64().unwrap() as usize];
    assert_eq!((image.get("extensions"), &image["byteLength"]), (None, &json!(4000)));
    let start =
        28 + encoded.files[0].bytes[12..16].iter().rev().fold(0, |n, &b| n * 256 + b as usize);
    let offset = start + image["byteOffset"].as_u64().unwrap() as usize;
    assert_eq!(encoded.files[0].bytes[offset..offset + 4000], picture);

    encoded.files[0].path.set_extension("obj");
    assert!(compress(&mut encoded).unwrap_err().to_string().contains("only .glb and .gltf"));
}
