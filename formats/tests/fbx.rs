//! FBX files, written here as text, and what becomes of them.

use std::fs;
use std::path::{Path, PathBuf};

use chamfer::{Options, Width, chamfer};
use chamfer_formats::{Document, ReadOptions, decode, encode};
use serde_json::Value;

#[path = "support/cube_fbx.rs"]
mod cube_fbx;

#[path = "support/binary_fbx.rs"]
mod binary_fbx;

use binary_fbx::binary_fbx;
use cube_fbx::cube_fbx;

fn read(text: &str) -> Result<Box<dyn Document + Send>, String> {
    read_bytes(text.as_bytes().to_vec())
}

fn read_bytes(bytes: Vec<u8>) -> Result<Box<dyn Document + Send>, String> {
    decode(Path::new("model.fbx"), bytes, &ReadOptions::default())
        .map_err(|error| format!("{error:#}"))
}

/// The JSON of the .glb that a model becomes, chamfered.
fn written(text: &str) -> (Value, Vec<u8>) {
    written_of(&*read(text).unwrap())
}

fn written_of(document: &dyn Document) -> (Value, Vec<u8>) {
    let options = Options::default().with_width(Width::PercentOfExtent(10.0));
    let chamfered: Vec<_> = document
        .meshes()
        .iter()
        .map(|source| chamfer(&source.mesh.as_mesh(), &options).unwrap())
        .collect();
    assert_eq!(chamfered[0].totals.chamfered, 12);
    let folder: PathBuf = Path::new(env!("CARGO_TARGET_TMPDIR")).join("fbx");
    fs::create_dir_all(&folder).unwrap();
    let files = encode(document, &folder.join("out.glb"), &chamfered).unwrap().files;
    assert_eq!(files.len(), 1);
    let length = u32::from_le_bytes(files[0].bytes[12..16].try_into().unwrap()) as usize;
    (serde_json::from_slice(&files[0].bytes[20..20 + length]).unwrap(), files[0].bytes.clone())
}

#[test]
fn a_cube_is_read_in_metres_with_its_streams() {
    let document = read(&cube_fbx()).unwrap();
    let [source] = document.meshes() else { panic!("{} meshes", document.meshes().len()) };
    assert_eq!(source.name, "box");
    let mesh = &source.mesh;
    assert_eq!((mesh.positions.len(), mesh.indices.len()), (24, 36));
    assert!(mesh.positions.as_flattened().iter().all(|at| (at.abs() - 0.01).abs() < 1e-8));
    assert_eq!(mesh.normals[0], [-1.0, 0.0, 0.0]);
    assert_eq!(mesh.uvs[0].values[..4], [0.0, 1.0, 1.0, 1.0]);
    assert_eq!(mesh.submesh_index_counts, [30, 6]);
    let [instance] = document.instances()[..] else { panic!("it stands more than once") };
    assert_eq!(instance.transform[3], [0.0, 5.0, 0.0, 1.0]);
    assert_eq!(document.notes(), ["of an FBX these do not go along: cameras (1)"]);
}

#[test]
fn skin_shapes_materials_and_hierarchy_go_along() {
    let (json, bytes) = written(&cube_fbx());
    let names = |key: &str| -> Vec<String> {
        let items = json[key].as_array().unwrap();
        items.iter().map(|item| item["name"].as_str().unwrap().to_owned()).collect()
    };
    assert_eq!(names("materials"), ["red", "lid"]);
    assert_eq!(names("nodes"), ["box", "left bone", "right bone", "eye"]);
    let factor = &json["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"];
    assert_eq!(factor, &serde_json::json!([1.0, 0.0, 0.0, 1.0]));
    assert_eq!(json["skins"][0]["joints"], serde_json::json!([1, 2]));
    assert_eq!(json["nodes"][0]["skin"], 0);
    assert_eq!(json["meshes"][0]["extras"]["targetNames"], serde_json::json!(["lift"]));
    let primitives = json["meshes"][0]["primitives"].as_array().unwrap();
    assert_eq!(primitives.len(), 2);
    for primitive in primitives {
        assert!(primitive["attributes"]["JOINTS_0"].is_u64());
        assert!(primitive["attributes"]["WEIGHTS_0"].is_u64());
        assert_eq!(primitive["targets"].as_array().unwrap().len(), 1);
    }
    let again = decode(Path::new("out.glb"), bytes, &ReadOptions::default());
    assert_eq!(again.unwrap().meshes()[0].mesh.indices.len(), 44 * 3);
}

/// The cube, whose red material shines, glows, lets light through and has pictures.
fn painted_cube() -> String {
    let property = |name: &str, kind: &str, value: &str| {
        format!("P: \"{name}\", \"{kind}\", \"\", \"A\",{value}\n")
    };
    let red = property("DiffuseColor", "Color", "1,0,0");
    let more = [
        red.clone(),
        property("EmissiveColor", "Color", "0,0.5,1"),
        property("EmissiveFactor", "Number", "0.5"),
        property("ShininessExponent", "Number", "25"),
        property("TransparentColor", "Color", "1,1,1"),
        property("TransparencyFactor", "Number", "0.25"),
    ];
    let texture = |id: u32, name: &str| {
        format!(
            "Texture: {id}, \"Texture::{name}\", \"\" {{\nType: \"TextureVideoClip\"\n\
             RelativeFilename: \"textures\\{name}.png\"\nFileName: \"c:\\{name}.png\"\n}}\n"
        )
    };
    let links = "C: \"OP\",20,4, \"DiffuseColor\"\nC: \"OP\",21,4, \"NormalMap\"\n";
    let cube = cube_fbx();
    assert!(cube.contains(red.trim_end()));
    let objects = ["Objects: {\n", &texture(20, "wood"), &texture(21, "bumps")].concat();
    cube.replace(red.trim_end(), &more.concat())
        .replace(
            "\"Material::red\", \"\" {\n",
            "\"Material::red\", \"\" {\nShadingModel: \"phong\"\n",
        )
        .replace("Objects: {\n", &objects)
        .replace("Connections: {\n", &format!("Connections: {{\n{links}"))
}

#[test]
fn colours_shine_and_pictures_go_along() {
    let folder = tempfile::tempdir().unwrap();
    let png = |what: &str| [b"\x89PNG\r\n\x1A\n", what.as_bytes()].concat();
    fs::create_dir(folder.path().join("textures")).unwrap();
    fs::write(folder.path().join("textures/wood.png"), png("wood")).unwrap();
    // Files are often moved together, without their folders.
    fs::write(folder.path().join("bumps.png"), png("bumps")).unwrap();
    let path = folder.path().join("model.fbx");
    fs::write(&path, painted_cube()).unwrap();
    let document = chamfer_formats::read(&path, &ReadOptions::default()).unwrap();
    assert_eq!(document.notes(), ["of an FBX these do not go along: cameras (1)"]);
    let (json, bytes) = written_of(&*document);
    let [red, lid] = &json["materials"].as_array().unwrap()[..] else { panic!("two materials") };
    let surface = &red["pbrMetallicRoughness"];
    assert_eq!(surface["baseColorFactor"], serde_json::json!([1.0, 0.0, 0.0, 0.75]));
    // An exponent of 25 is a roughness of a half: 1 - sqrt(25) / 10.
    assert_eq!((&surface["roughnessFactor"], &red["alphaMode"]), (&0.5.into(), &"BLEND".into()));
    assert_eq!(red["emissiveFactor"], serde_json::json!([0.0, 0.25, 0.5]));
    let image = |at: &Value| -> Value {
        let texture = &json["textures"][at["index"].as_u64().unwrap() as usize];
        json["images"][texture["source"].as_u64().unwrap() as usize]["name"].clone()
    };
    assert_eq!(image(&lid["pbrMetallicRoughness"]["baseColorTexture"]), "wood.png");
    assert_eq!(image(&lid["normalTexture"]), "bumps.png");
    let holds = |part: &[u8]| bytes.windows(part.len()).any(|window| window == part);
    assert!(holds(&png("wood")) && holds(&png("bumps")));
}

#[test]
fn a_picture_that_is_not_there_is_told_of() {
    let document = read(&painted_cube()).unwrap();
    let told = document.notes().join("\n");
    for name in ["wood.png", "bumps.png"] {
        assert!(told.contains(&format!("{name:?} is neither in the file nor beside it")), "{told}");
    }
}

/// Both kinds of file say the same.
#[test]
fn a_binary_file_is_read_as_its_text_is() {
    let (text, binary) = (read(&cube_fbx()).unwrap(), read_bytes(binary_fbx(&cube_fbx())).unwrap());
    let [source] = binary.meshes() else { panic!("{} meshes", binary.meshes().len()) };
    assert_eq!((source.name.as_str(), source.mesh.positions.len()), ("box", 24));
    assert_eq!(source.mesh, text.meshes()[0].mesh);
    assert_eq!(binary.notes(), text.notes());
    assert_eq!(written_of(&*binary), written_of(&*text));
}

#[test]
fn a_binary_file_cut_off_anywhere_is_read_or_refused() {
    let bytes = binary_fbx(&cube_fbx());
    assert!(read_bytes(bytes[..bytes.len() / 2].to_vec()).is_err());
    for length in (0..bytes.len()).step_by(11) {
        if let Ok(document) = read_bytes(bytes[..length].to_vec()) {
            assert!(document.meshes().len() <= 1);
        }
    }
}

/// Where the bones stand as they stood when they were bound, the skin leaves the cube in its place.
#[test]
fn bones_are_bound_where_they_were() {
    let (json, glb) = written(&cube_fbx());
    let accessor =
        &json["accessors"][json["skins"][0]["inverseBindMatrices"].as_u64().unwrap() as usize];
    let view = &json["bufferViews"][accessor["bufferView"].as_u64().unwrap() as usize];
    let start = 28 + u32::from_le_bytes(glb[12..16].try_into().unwrap()) as usize;
    let start = start + view["byteOffset"].as_u64().unwrap_or(0) as usize;
    let (words, _) = glb[start..start + 128].as_chunks();
    let numbers: Vec<f32> = words.iter().map(|word| f32::from_le_bytes(*word)).collect();
    let place = |node: usize| -> Vec<f64> {
        let place = json["nodes"][node]["translation"].as_array();
        place.map_or(vec![0.0; 3], |at| at.iter().map(|n| n.as_f64().unwrap()).collect())
    };
    assert_eq!(place(2), [3.0, 1.0, 0.0]);
    for (joint, matrix) in [1, 2].into_iter().zip(numbers.chunks_exact(16)) {
        let linear: Vec<f32> = (0..12).map(|n| if n % 5 == 0 { 1.0 } else { 0.0 }).collect();
        assert_eq!(matrix[..12], linear[..]);
        for axis in 0..3 {
            let skinned = place(joint)[axis] + f64::from(matrix[12 + axis]);
            assert!((skinned - place(0)[axis]).abs() < 1e-6, "{joint} {axis}: {matrix:?}");
        }
    }
}

#[test]
fn what_is_no_fbx_is_refused() {
    for text in ["hello", "Kaydara FBX Binary  \0\u{1a}\0", "; FBX 7.4.0 project file\nObjects: {"]
    {
        let told = read(text).err();
        // Text without any object is an empty scene.
        assert!(told.is_none_or(|told| told.starts_with("cannot be read as FBX: ")));
    }
    assert!(read("Kaydara FBX Binary  \0\u{1a}\0").is_err());
}

/// Cut off anywhere, and with a number or a letter wrong.
#[test]
fn damaged_files_are_read_or_refused() {
    let text = cube_fbx();
    for place in (0..text.len()).step_by(7) {
        if let Ok(document) = read(&text[..place]) {
            assert!(document.meshes().len() <= 1);
        }
        for wrong in ["9", "-", "\"", "}"] {
            let mut changed = text.clone();
            changed.replace_range(place..place + 1, wrong);
            if let Ok(document) = read(&changed) {
                for source in document.meshes() {
                    let count = source.mesh.positions.len();
                    assert!(source.mesh.indices.iter().all(|&index| (index as usize) < count));
                }
            }
        }
    }
}
