//! An FBX file with all that the reader looks at, as text.

/// Faces of the cube, whose corner `n` is on the far side of an axis where that bit of `n` is set.
const FACES: [[i32; 4]; 6] =
    [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];

const NORMALS: [[i32; 3]; 6] =
    [[-1, 0, 0], [1, 0, 0], [0, -1, 0], [0, 1, 0], [0, 0, -1], [0, 0, 1]];

/// Where the right bone stands, in centimetres.
const RIGHT_BONE: [i32; 3] = [300, 100, 0];

/// What belongs to what, by number; 0 is the scene.
const LINKS: [(u32, u32); 18] = [
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

/// A cube of two by two by two centimetres around a point five metres up, whose left half hangs on
/// one bone and whose right half on another, with a blend shape that lifts one corner, two
/// materials, and a camera.
pub fn cube_fbx() -> String {
    let objects = [geometry(), models(), skin(), shapes()].concat();
    let links = LINKS.map(|(from, to)| format!("C: \"OO\",{from},{to}\n")).concat();
    let settings = [
        ("UpAxis", 1),
        ("UpAxisSign", 1),
        ("FrontAxis", 2),
        ("FrontAxisSign", 1),
        ("CoordAxis", 0),
        ("CoordAxisSign", 1),
        ("UnitScaleFactor", 1),
    ];
    let setting = |(name, value)| format!("P: \"{name}\", \"int\", \"Integer\", \"\",{value}\n");
    format!(
        "; FBX 7.4.0 project file\n\
         FBXHeaderExtension: {{ FBXHeaderVersion: 1003\nFBXVersion: 7400\n}}\n\
         GlobalSettings: {{ Version: 1000\nProperties70: {{\n{}}} }}\n\
         Objects: {{\n{objects}}}\nConnections: {{\n{links}}}\n",
        settings.map(setting).concat()
    )
}

fn object(kind: &str, id: u32, name: &str, class: &str, body: &str) -> String {
    format!("{kind}: {id}, \"{name}\", \"{class}\" {{\n{body}}}\n")
}

fn array(name: &str, numbers: &[i32]) -> String {
    let text: Vec<String> = numbers.iter().map(i32::to_string).collect();
    format!("{name}: *{} {{ a: {} }}\n", numbers.len(), text.join(","))
}

fn layer(kind: &str, mapping: &str, reference: &str, body: &str) -> String {
    format!(
        "{kind}: 0 {{ Name: \"\"\nMappingInformationType: \"{mapping}\"\n\
         ReferenceInformationType: \"{reference}\"\n{body} }}\n"
    )
}

fn corners() -> Vec<[i32; 3]> {
    (0..8).map(|n| [0, 1, 2].map(|axis| if n >> axis & 1 == 1 { 1 } else { -1 })).collect()
}

fn geometry() -> String {
    let last = |face: [i32; 4]| [face[0], face[1], face[2], -1 - face[3]];
    let normals = NORMALS.map(|normal| [normal; 4]);
    let uvs = [array("UV", &[0, 0, 1, 0, 1, 1, 0, 1]), array("UVIndex", &[0, 1, 2, 3].repeat(6))];
    let element =
        |kind: &str| format!("LayerElement: {{ Type: \"LayerElement{kind}\"\nTypedIndex: 0 }}\n");
    let body = [
        array("Vertices", corners().as_flattened()),
        array("PolygonVertexIndex", FACES.map(last).as_flattened()),
        layer(
            "LayerElementNormal",
            "ByPolygonVertex",
            "Direct",
            &array("Normals", normals.as_flattened().as_flattened()),
        ),
        layer("LayerElementUV", "ByPolygonVertex", "IndexToDirect", &uvs.concat()),
        layer(
            "LayerElementMaterial",
            "ByPolygon",
            "IndexToDirect",
            &array("Materials", &[0, 0, 0, 0, 0, 1]),
        ),
        format!("Layer: 0 {{ {} }}\n", ["Normal", "UV", "Material"].map(element).concat()),
    ];
    object("Geometry", 1, "Geometry::", "Mesh", &body.concat())
}

fn models() -> String {
    let placed = |[x, y, z]: [i32; 3]| {
        let name = "\"Lcl Translation\"";
        format!("Properties70: {{ P: {name}, {name}, \"\", \"A\",{x},{y},{z} }}\n")
    };
    let color = "Properties70: { P: \"DiffuseColor\", \"Color\", \"\", \"A\",1,0,0 }\n";
    let bone = "TypeFlags: \"Skeleton\"\n";
    [
        object("Model", 2, "Model::box", "Mesh", &placed([0, 500, 0])),
        object("Material", 3, "Material::red", "", color),
        object("Material", 4, "Material::lid", "", ""),
        object("Model", 5, "Model::left bone", "LimbNode", ""),
        object("Model", 6, "Model::right bone", "LimbNode", &placed(RIGHT_BONE)),
        object("NodeAttribute", 7, "NodeAttribute::", "LimbNode", bone),
        object("NodeAttribute", 8, "NodeAttribute::", "LimbNode", bone),
        object("Model", 15, "Model::eye", "Camera", ""),
        object("NodeAttribute", 16, "NodeAttribute::", "Camera", "TypeFlags: \"Camera\"\n"),
    ]
    .concat()
}

fn skin() -> String {
    let cluster = |id: u32, name: &str, side: i32| {
        let own = (0..8).filter(|&n| corners()[n][0] == side).map(|n| n as i32);
        let own: Vec<i32> = own.collect();
        // Where the bone was when it was bound, and the cube as the bone saw it then.
        let bone = if side > 0 { RIGHT_BONE } else { [0; 3] };
        let matrix = matrix("Transform", [-bone[0], 500 - bone[1], -bone[2]]);
        let link = self::matrix("TransformLink", bone);
        let weights = array("Weights", &vec![1; own.len()]);
        let body = [array("Indexes", &own), weights, matrix, link].concat();
        object("Deformer", id, &format!("SubDeformer::{name}"), "Cluster", &body)
    };
    let skin = object("Deformer", 9, "Deformer::skin", "Skin", "Link_DeformAcuracy: 50\n");
    [skin, cluster(10, "left", -1), cluster(11, "right", 1)].concat()
}

fn matrix(name: &str, [x, y, z]: [i32; 3]) -> String {
    array(name, &[1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, x, y, z, 1])
}

fn shapes() -> String {
    let channel = "DeformPercent: 0\nFullWeights: *1 { a: 100 }\n";
    let lifted =
        [array("Indexes", &[7]), array("Vertices", &[0, 1, 0]), array("Normals", &[0, 0, 0])];
    [
        object("Deformer", 12, "Deformer::shapes", "BlendShape", ""),
        object("Deformer", 13, "SubDeformer::lift", "BlendShapeChannel", channel),
        object("Geometry", 14, "Geometry::lift", "Shape", &lifted.concat()),
    ]
    .concat()
}
