//! FBX files, written here as text, and what becomes of them.

use std::fs;
use std::path::{Path, PathBuf};

use chamfer::{Options, Width, chamfer};
use chamfer_formats::{Document, ReadOptions, decode, encode};
use serde_json::Value;

/// A cube of two by two by two centimetres around a point five metres up, whose left half hangs on
/// one bone and whose right half on another, with a blend shape that lifts one corner, two
/// materials, and a camera.
fn cube_fbx() -> String {
    let corners: Vec<[i32; 3]> =
        (0..8).map(|n| [0, 1, 2].map(|axis| if n >> axis & 1 == 1 { 1 } else { -1 })).collect();
    let faces =
        [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
    let normals = [[-1, 0, 0], [1, 0, 0], [0, -1, 0], [0, 1, 0], [0, 0, -1], [0, 0, 1]]
        .map(|normal| [normal; 4]);
    let last = |face: [i32; 4]| [face[0], face[1], face[2], -1 - face[3]];
    let [left, right] = [-1, 1].map(|side| {
        let own = (0..8).filter(|&n| corners[n][0] == side).map(|n| n as i32);
        own.collect::<Vec<i32>>()
    });
    let array = |name: &str, numbers: &[i32]| {
        let text: Vec<String> = numbers.iter().map(i32::to_string).collect();
        format!("{name}: *{} {{ a: {} }}\n", numbers.len(), text.join(","))
    };
    let object = |kind: &str, id: u32, name: &str, class: &str, body: &str| {
        format!("{kind}: {id}, \"{name}\", \"{class}\" {{\n{body}}}\n")
    };
    let vertices = array("Vertices", corners.as_flattened());
    let indices = array("PolygonVertexIndex", faces.map(last).as_flattened());
    let layers = format!(
        "LayerElementNormal: 0 {{ MappingInformationType: \"ByPolygonVertex\"\n\
         ReferenceInformationType: \"Direct\"\n{} }}\n\
         LayerElementUV: 0 {{ Name: \"map\"\nMappingInformationType: \"ByPolygonVertex\"\n\
         ReferenceInformationType: \"IndexToDirect\"\n{}{} }}\n\
         LayerElementMaterial: 0 {{ MappingInformationType: \"ByPolygon\"\n\
         ReferenceInformationType: \"IndexToDirect\"\n{} }}\n\
         Layer: 0 {{ LayerElement: {{ Type: \"LayerElementNormal\"\nTypedIndex: 0 }}\n\
         LayerElement: {{ Type: \"LayerElementUV\"\nTypedIndex: 0 }}\n\
         LayerElement: {{ Type: \"LayerElementMaterial\"\nTypedIndex: 0 }} }}\n",
        array("Normals", normals.as_flattened().as_flattened()),
        array("UV", &[0, 0, 1, 0, 1, 1, 0, 1]),
        array("UVIndex", [[0, 1, 2, 3]; 6].as_flattened()),
        array("Materials", &[0, 0, 0, 0, 0, 1]),
    );
    let cluster = |id: u32, name: &str, own: &[i32]| {
        let matrix = array("Transform", &[1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]);
        let link = matrix.replace("Transform", "TransformLink");
        let weights = array("Weights", &vec![1; own.len()]);
        let body = format!("{}{weights}{matrix}{link}", array("Indexes", own));
        object("Deformer", id, &format!("SubDeformer::{name}"), "Cluster", &body)
    };
    let placed =
        "Properties70: { P: \"Lcl Translation\", \"Lcl Translation\", \"\", \"A\",0,500,0 }\n";
    let color = "Properties70: { P: \"DiffuseColor\", \"Color\", \"\", \"A\",1,0,0 }\n";
    let lifted =
        [array("Indexes", &[7]), array("Vertices", &[0, 1, 0]), array("Normals", &[0, 0, 0])]
            .concat();
    let objects = [
        object("Geometry", 1, "Geometry::", "Mesh", &[vertices, indices, layers].concat()),
        object("Model", 2, "Model::box", "Mesh", placed),
        object("Material", 3, "Material::red", "", color),
        object("Material", 4, "Material::lid", "", ""),
        object("Model", 5, "Model::left bone", "LimbNode", ""),
        object("Model", 6, "Model::right bone", "LimbNode", ""),
        object("NodeAttribute", 7, "NodeAttribute::", "LimbNode", "TypeFlags: \"Skeleton\"\n"),
        object("NodeAttribute", 8, "NodeAttribute::", "LimbNode", "TypeFlags: \"Skeleton\"\n"),
        object("Deformer", 9, "Deformer::skin", "Skin", "Link_DeformAcuracy: 50\n"),
        cluster(10, "left", &left),
        cluster(11, "right", &right),
        object("Deformer", 12, "Deformer::shapes", "BlendShape", ""),
        object(
            "Deformer",
            13,
            "SubDeformer::lift",
            "BlendShapeChannel",
            "DeformPercent: 0\nFullWeights: *1 { a: 100 }\n",
        ),
        object("Geometry", 14, "Geometry::lift", "Shape", &lifted),
        object("Model", 15, "Model::eye", "Camera", ""),
        object("NodeAttribute", 16, "NodeAttribute::", "Camera", "TypeFlags: \"Camera\"\n"),
    ];
    let links = [
        (1, 2),
        (2, 0),
        (3, 2),
        (4, 2),
        (5, 0),
        (6, 0),
        (7, 5),
        (8, 6),
        (9, 1),
        (10, 9),
        (11, 9),
        (5, 10),
        (6, 11),
        (12, 1),
        (13, 12),
        (14, 13),
        (15, 0),
        (16, 15),
    ];
    let link = |(from, to): (u32, u32)| format!("C: \"OO\",{from},{to}\n");
    format!(
        "; FBX 7.4.0 project file\nFBXHeaderExtension: {{ FBXHeaderVersion: 1003\nFBXVersion: 7400\n}}\n\
         GlobalSettings: {{ Version: 1000\nProperties70: {{\n\
         P: \"UpAxis\", \"int\", \"Integer\", \"\",1\nP: \"UpAxisSign\", \"int\", \"Integer\", \"\",1\n\
         P: \"FrontAxis\", \"int\", \"Integer\", \"\",2\nP: \"FrontAxisSign\", \"int\", \"Integer\", \"\",1\n\
         P: \"CoordAxis\", \"int\", \"Integer\", \"\",0\nP: \"CoordAxisSign\", \"int\", \"Integer\", \"\",1\n\
         P: \"UnitScaleFactor\", \"double\", \"Number\", \"\",1\n}} }}\n\
         Objects: {{\n{}}}\nConnections: {{\n{}}}\n",
        objects.concat(),
        links.map(link).concat()
    )
}

fn read(text: &str) -> Result<Box<dyn Document + Send>, String> {
    let options = ReadOptions { smoothing_angle: 30.0 };
    decode(Path::new("model.fbx"), text.as_bytes().to_vec(), &options)
        .map_err(|error| format!("{error:#}"))
}

/// The JSON of the .glb that a model becomes, chamfered.
fn written(text: &str) -> (Value, Vec<u8>) {
    let document = read(text).unwrap();
    let options = Options { width: Width::PercentOfExtent(10.0), ..Options::default() };
    let chamfered: Vec<_> = document
        .meshes()
        .iter()
        .map(|source| chamfer(&source.mesh.as_mesh(), &options).unwrap())
        .collect();
    assert_eq!(chamfered[0].totals.chamfered, 12);
    let folder: PathBuf = Path::new(env!("CARGO_TARGET_TMPDIR")).join("fbx");
    fs::create_dir_all(&folder).unwrap();
    let files = encode(&*document, &folder.join("out.glb"), &chamfered).unwrap();
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
    let again = decode(Path::new("out.glb"), bytes, &ReadOptions { smoothing_angle: 30.0 });
    assert_eq!(again.unwrap().meshes()[0].mesh.indices.len(), 44 * 3);
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
