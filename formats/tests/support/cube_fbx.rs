//! An FBX file with all that the reader looks at, as text.

/// A cube of two by two by two centimetres around a point five metres up, whose left half hangs on
/// one bone and whose right half on another, with a blend shape that lifts one corner, two
/// materials, and a camera.
pub fn cube_fbx() -> String {
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
