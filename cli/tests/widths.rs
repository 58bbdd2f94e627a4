//! Which edges are chamfered, and how wide, from the command line.

#[path = "support/folder.rs"]
mod folder;
#[path = "support/run.rs"]
mod run;

use std::fs;

use base64::Engine;
use chamfer::{ChamferSubmesh, Convexity, MeshBuffers, Options, Width, WidthMode, shapes};
use chamfer_formats::{Document, ReadOptions, glb, read};
use glam::{DVec3, Mat4, Vec3};
use serde_json::{Value, json};

use folder::Folder;

/// The JSON of a mesh as .gltf, with its buffer inside.
fn gltf(mesh: &MeshBuffers) -> Value {
    let file = glb::encode("box", mesh, &[], &[]).unwrap();
    let length = u32::from_le_bytes(file[12..16].try_into().unwrap()) as usize;
    let mut json: Value = serde_json::from_slice(&file[20..20 + length]).unwrap();
    let bytes = base64::engine::general_purpose::STANDARD.encode(&file[28 + length..]);
    json["buffers"][0]["uri"] = format!("data:application/octet-stream;base64,{bytes}").into();
    json
}

/// A scene of these nodes, each with mesh 0.
fn scene(mesh: &MeshBuffers, nodes: Value) -> String {
    let mut json = gltf(mesh);
    let numbers: Vec<usize> = (0..nodes.as_array().unwrap().len()).collect();
    json["scenes"] = json!([{"nodes": numbers}]);
    json["nodes"] = nodes;
    json.to_string()
}

fn document(folder: &Folder, name: &str) -> Box<dyn Document + Send> {
    read(&folder.path(name), &ReadOptions::default()).unwrap()
}

/// For each object of a scene of boxes around the origin, how far its vertices are from the planes
/// of its sides: from the three nearest, the farthest first.
fn distances(document: &dyn Document, sizes: &[[f32; 3]]) -> Vec<[f32; 3]> {
    let mut found = Vec::new();
    for (object, size) in document.instances().iter().zip(sizes) {
        let transform = Mat4::from_cols_array_2d(&object.transform);
        let centre = transform.transform_point3(Vec3::ZERO);
        let mesh = &document.meshes()[object.mesh].mesh;
        for position in &mesh.positions {
            let place = transform.transform_point3(Vec3::from(*position)) - centre;
            let mut off = (Vec3::from(*size) / 2.0 - place.abs()).to_array();
            off.sort_by(|a, b| b.total_cmp(a));
            found.push(off);
        }
    }
    found
}

// Where the pyramid comes from, a strip at its base faces away from the normals of its sides.
#[test]
fn a_tower_of_a_stretched_pyramid_is_sound() {
    let nodes = json!([{"mesh": 0, "scale": [1, 20, 1]}, {"mesh": 0, "scale": [-1, 1, 1]}]);
    let folder = Folder::with(&[("tower.gltf", &scene(&shapes::pyramid(4), nodes))]);
    folder.run("tower.gltf -o tower.glb --width 10mm").exits(0);
    folder.run("check tower.gltf tower.glb --width 10mm").exits(0);
    folder.run("check tower.gltf tower.glb --per-mesh --no-see-through").exits(1);
}

/// Whether all vertices were pulled by a width, in two directions each.
#[track_caller]
fn assert_pulled(document: &dyn Document, sizes: &[[f32; 3]], width: f32) {
    for off in distances(document, sizes) {
        let is_near =
            off.iter().zip([width, width, 0.0]).all(|(a, b)| (a - b).abs() < 1e-4 * width);
        assert!(is_near, "{off:?}, not by {width}");
    }
}

const WALL: [f32; 3] = [10.0, 3.0, 0.2];

//   +-----------------+
//   |                 |   a cube, stretched 50 times as long as thick
//   +-----------------+
#[test]
fn a_stretched_box_has_one_width_in_the_scene() {
    let cube = shapes::plain_cube(1.0);
    let wall = scene(&cube, json!([{"mesh": 0, "scale": WALL, "translation": [1, 2, 3]}]));
    let mirrored = scene(&cube, json!([{"mesh": 0, "scale": [10, -3, 0.2]}]));
    let folder = Folder::with(&[("wall.gltf", &wall), ("mirrored.gltf", &mirrored)]);
    for name in ["wall", "mirrored"] {
        folder.run(&format!("{name}.gltf -o out.glb --width 2cm")).exits(0);
        assert_pulled(&*document(&folder, "out.glb"), &[WALL], 0.02);
        folder.run(&format!("check {name}.gltf out.glb --width 2cm")).exits(0);
    }
    folder.run("wall.gltf -o out.glb --width-percent 0.2 --report r.json").exits(0);
    assert_pulled(&*document(&folder, "out.glb"), &[WALL], 0.02);
    let told = folder.json("r.json")["files"][0]["meshes"][0]["width"].as_f64().unwrap();
    let mean = ((100.0f64 + 9.0 + 0.04) / 3.0).sqrt();
    assert!((told - 0.02 / mean).abs() < 1e-7, "in the mesh's own units: {told}");

    folder.run("wall.gltf -o out.glb --width 0.02 --per-mesh").exits(0);
    let widest = distances(&*document(&folder, "out.glb"), &[WALL]);
    assert!(widest.iter().any(|off| (off[0] - 0.2).abs() < 1e-4), "stretched with the wall");
}

/// A wall and a knob beside it, as meshes of their own.
fn wall_and_knob() -> String {
    let cube = |size: [f32; 3]| {
        let mut cube = shapes::plain_cube(1.0);
        for position in &mut cube.positions {
            *position = [0, 1, 2].map(|axis| position[axis] * size[axis]);
        }
        cube
    };
    let mut mesh = cube(WALL);
    let knob = cube([0.1; 3]);
    let (vertices, indices) = (mesh.positions.len() as u32, knob.indices.len() as u32);
    mesh.positions.extend(&knob.positions);
    mesh.normals.extend(&knob.normals);
    mesh.indices.extend(knob.indices.iter().map(|index| index + vertices));
    mesh.submesh_index_counts.push(indices);
    mesh.uvs = Default::default();
    let names = [Some("wall".into()), Some("knob".into())];
    let file = glb::encode("both", &mesh, &names, &[]).unwrap();
    let length = u32::from_le_bytes(file[12..16].try_into().unwrap()) as usize;
    let mut json: Value = serde_json::from_slice(&file[20..20 + length]).unwrap();
    let bytes = base64::engine::general_purpose::STANDARD.encode(&file[28 + length..]);
    json["buffers"][0]["uri"] = format!("data:application/octet-stream;base64,{bytes}").into();
    let primitives = json["meshes"][0]["primitives"].clone();
    json["meshes"] = json!([{"primitives": [primitives[0]]}, {"primitives": [primitives[1]]}]);
    json["nodes"] = json!([{"mesh": 0}, {"mesh": 1, "translation": [0, 0, 1]}]);
    json["scenes"] = json!([{"nodes": [0, 1]}]);
    json.to_string()
}

#[test]
fn a_knob_has_the_width_of_the_wall_beside_it() {
    let folder = Folder::with(&[("both.gltf", &wall_and_knob())]);
    let sizes = [WALL, [0.1; 3]];
    for width in ["--width-percent 0.1", "--width 10mm", "--width 0.1%"] {
        folder.run(&format!("both.gltf -o out.glb {width}")).exits(0);
        assert_pulled(&*document(&folder, "out.glb"), &sizes, 0.01);
    }
    folder.run("both.gltf -o out.glb --width-percent 1 --per-mesh").exits(0);
    let found = distances(&*document(&folder, "out.glb"), &sizes);
    let widest =
        |range: std::ops::Range<usize>| found[range].iter().map(|off| off[0]).fold(0.0, f32::max);
    let half = found.len() / 2;
    assert!((widest(half..found.len()) - 0.001).abs() < 1e-6 && widest(0..half) > 0.05);
}

#[test]
fn a_mesh_that_stands_with_several_scales_has_a_copy_for_each() {
    let nodes = json!([
        {"mesh": 0, "name": "a"},
        {"mesh": 0, "name": "b", "scale": [2, 1, 1], "translation": [5, 0, 0], "extras": 7},
        {"mesh": 0, "name": "c", "scale": [1.005, 1, 1], "translation": [0, 5, 0]},
        {"mesh": 0, "name": "d", "scale": [2, 1, 1], "translation": [0, 0, 5]},
    ]);
    let mut json: Value = serde_json::from_str(&scene(&shapes::plain_cube(1.0), nodes)).unwrap();
    json["meshes"][0]["extras"] = json!({"price": 3});
    json["meshes"][0]["primitives"][0]["extras"] = json!("face");
    let folder = Folder::with(&[("a.gltf", &json.to_string())]);
    folder.run("a.gltf -o b.gltf --width 0.05 --verify full").exits(0);
    let out = folder.json("b.gltf");
    let meshes: Vec<&Value> = out["nodes"].as_array().unwrap().iter().map(|n| &n["mesh"]).collect();
    assert_eq!(meshes, [0, 1, 0, 1]);
    assert_eq!((&out["nodes"][1]["name"], &out["nodes"][1]["extras"]), (&json!("b"), &json!(7)));
    assert_eq!(out["meshes"].as_array().unwrap().len(), 2);
    for mesh in out["meshes"].as_array().unwrap() {
        assert_eq!((&mesh["name"], &mesh["extras"]["price"]), (&json!("box"), &json!(3)));
        assert_eq!(mesh["primitives"][0]["extras"], "face");
    }
    let written = document(&folder, "b.gltf");
    let long = [2.0, 1.0, 1.0];
    let off = distances(&*written, &[[1.0; 3], long, [1.005, 1.0, 1.0], long]);
    assert!(off.iter().all(|off| (off[0] - 0.05).abs() < 5.1e-4 && (off[1] - 0.05).abs() < 1e-6));
    folder.run("check a.gltf b.gltf --width 0.05").exits(0);
}

#[test]
fn a_mesh_without_hard_edges_gets_no_copies() {
    let smooth = {
        let mut cube = shapes::plain_cube(1.0);
        cube.normals =
            cube.positions.iter().map(|at| Vec3::from(*at).normalize().to_array()).collect();
        cube
    };
    let mut json: Value = serde_json::from_str(&wall_and_knob()).unwrap();
    let other = gltf(&smooth);
    // The normals of all vertices of the wall, bent until it is smooth.
    let nodes = json!([
        {"mesh": 0}, {"mesh": 0, "scale": [1, 2, 1], "translation": [0, 0, 9]},
        {"mesh": 1}, {"mesh": 1, "scale": [1, 2, 1], "translation": [0, 0, 5]},
    ]);
    json["nodes"] = nodes;
    json["scenes"] = json!([{"nodes": [0, 1, 2, 3]}]);
    json["buffers"].as_array_mut().unwrap().push(other["buffers"][0].clone());
    let accessor = |key: &str| {
        let mut accessor = other["accessors"]
            [other["meshes"][0]["primitives"][0]["attributes"][key].as_u64().unwrap() as usize]
            .clone();
        let mut view =
            other["bufferViews"][accessor["bufferView"].as_u64().unwrap() as usize].clone();
        view["buffer"] = 1.into();
        (accessor.take(), view)
    };
    for key in ["POSITION", "NORMAL"] {
        let (mut new, view) = accessor(key);
        new["bufferView"] = json["bufferViews"].as_array().unwrap().len().into();
        json["bufferViews"].as_array_mut().unwrap().push(view);
        json["accessors"].as_array_mut().unwrap().push(new);
        let number = json["accessors"].as_array().unwrap().len() - 1;
        json["meshes"][0]["primitives"][0]["attributes"][key] = number.into();
    }
    let folder = Folder::with(&[("a.gltf", &json.to_string())]);
    folder.run("a.gltf -o b.gltf --width 0.01 --verify full").exits(0);
    let out = folder.json("b.gltf");
    let meshes: Vec<&Value> = out["nodes"].as_array().unwrap().iter().map(|n| &n["mesh"]).collect();
    assert_eq!(meshes, [0, 0, 1, 2]);
    assert_eq!(out["meshes"].as_array().unwrap().len(), 3);
    folder.run("check a.gltf b.gltf --width 0.01 --no-see-through").exits(3);
    folder.run("a.gltf -o c.gltf --width 0.01 --verify full --report r.json").exits(0);
    assert_eq!(folder.json("r.json")["totals"]["meshes"], 3, "what is written");
}

/// A cube as .obj; its top and bottom are of metal.
const CUBE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n\
    usemtl Metal\nf 5 6 7 8\nf 4 3 2 1\nusemtl Wood\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

#[test]
fn units_are_those_of_the_file_where_nobody_knows_them() {
    let folder = Folder::with(&[("a.obj", CUBE)]);
    let told = folder.run("a.obj -o b.obj --width 5mm").exits(1).err();
    assert!(told.contains("5 mm was asked for, but this format does not say"), "{told}");
    let told = folder.run("a.obj -o b.obj --width 5km").exits(2).err();
    assert!(told.contains("5mm, 2cm"), "{told}");
    folder.run("a.obj -o b.obj --width 2%").exits(0);
    folder.run("a.obj -o c.obj --width-percent 2").exits(0);
    assert_eq!(folder.text("b.obj"), folder.text("c.obj"));
}

/// The counts of all files of a run with these arguments.
fn totals(folder: &Folder, arguments: &str) -> Value {
    folder.run(&format!("{arguments} --report r.json")).exits(0);
    folder.json("r.json")["totals"].clone()
}

#[test]
fn edges_are_selected() {
    let folder = Folder::with(&[("a.obj", CUBE)]);
    let left = |options: &str| {
        totals(&folder, &format!("a.obj -o b.obj {options}"))["skipped"]["not_selected"].clone()
    };
    assert_eq!(left("--min-angle 90 --max-angle 90 --convexity convex"), Value::Null);
    assert_eq!(left("--min-angle 91"), 12);
    assert_eq!(left("--max-angle 89"), 12);
    assert_eq!(left("--convexity concave"), 12);
    let bevelled = |angle| totals(&folder, &format!("a.obj -o b.obj --hard-angle {angle}"));
    assert_eq!((&bevelled(90)["hard_edges"], &bevelled(1)["hard_edges"]), (&json!(12), &json!(12)));
    let told = folder.run("a.obj -o b.obj --min-angle 90 --max-angle 80").exits(2).err();
    assert!(told.contains("--min-angle 90 is larger than --max-angle 80"), "{told}");
    for (wrong, range) in [("--hard-angle 0", "above 0, up to 90"), ("--max-angle 181", "0 to 180")]
    {
        let told = folder.run(&format!("a.obj {wrong}")).exits(2).err();
        assert!(told.contains(range) && told.contains(wrong.split(' ').next().unwrap()), "{told}");
    }
}

#[test]
fn a_width_can_be_measured_across_the_chamfer() {
    let cube = scene(&shapes::plain_cube(1.0), json!([{"mesh": 0}]));
    let folder = Folder::with(&[("a.gltf", &cube)]);
    let right = std::f32::consts::FRAC_1_SQRT_2;
    for (mode, offset) in
        [("chord", right), ("depth", 2.0 * right), ("radius", 1.0), ("offset", 1.0)]
    {
        folder.run(&format!("a.gltf -o b.glb --width 0.1 --width-mode {mode}")).exits(0);
        assert_pulled(&*document(&folder, "b.glb"), &[[1.0; 3]], 0.1 * offset);
    }
}

#[test]
fn materials_have_widths_of_their_own() {
    let folder = Folder::with(&[("a.obj", CUBE)]);
    let widths = |options: &str| {
        folder.run(&format!("a.obj -o b.obj {options} --report r.json --report-edges")).exits(0);
        let edges = folder.json("r.json")["files"][0]["meshes"][0]["edges"].clone();
        let width = |edge: &Value| (edge["widths"][0].as_f64().unwrap() * 1000.0).round() as i64;
        let mut widths: Vec<i64> = edges.as_array().unwrap().iter().map(width).collect();
        widths.sort_unstable();
        widths
    };
    let [four, eight] = [4, 8].map(|count| move |width: i64| vec![width; count]);
    let metal = "--width 0.1 --material-width Metal=0.05";
    assert_eq!(widths(metal), [eight(50), four(100)].concat(), "between two, the smaller");
    let both = "--width 0 --material-width Metal=5% --material-width Wood=0.05";
    assert_eq!(widths(both), vec![50; 12]);
    for none in ["--width 0.1 --material-width Metal=0", "--width 0 --material-width Wood=0.05"] {
        let left =
            totals(&folder, &format!("a.obj -o b.obj {none}"))["skipped"]["not_selected"].clone();
        assert_eq!(left, 8, "{none}");
    }
    let told = folder.run("a.obj -o b.obj --material-width Steel=1").exits(0).err();
    assert!(
        told.contains("--material-width Steel: its materials are \"Metal\", \"Wood\""),
        "{told}"
    );
}

#[test]
fn a_channel_of_the_colours_is_a_mask() {
    let mut cube = shapes::plain_cube(1.0);
    cube.colors = vec![[0.0, 0.5, 1.0, 1.0]; cube.positions.len()];
    let folder = Folder::with(&[
        ("a.gltf", &scene(&cube, json!([{"mesh": 0}]))),
        ("plain.gltf", &scene(&shapes::plain_cube(1.0), json!([{"mesh": 0}]))),
    ]);
    for (channel, width) in [("g", 0.05), ("b", 0.1), ("a", 0.1)] {
        folder.run(&format!("a.gltf -o b.glb --width 0.1 --mask {channel}")).exits(0);
        assert_pulled(&*document(&folder, "b.glb"), &[[1.0; 3]], width);
    }
    folder.run("a.gltf -o b.gltf --mask r").exits(0);
    assert_eq!(folder.text("a.gltf"), folder.text("b.gltf"), "black leaves all");
    let told = folder.run("plain.gltf -o b.glb --mask r").exits(0).err();
    assert!(told.contains("--mask: it has no vertex colours"), "{told}");
}

#[test]
fn normals_are_made_where_that_is_asked_for() {
    let mut smooth = shapes::plain_cube(1.0);
    smooth.normals =
        smooth.positions.iter().map(|at| Vec3::from(*at).normalize().to_array()).collect();
    let ply = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n\
        property float nx\nproperty float ny\nproperty float nz\nelement face 2\nproperty list uchar int vertex_indices\n\
        end_header\n0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 0 1\n0 0 -1 0 0 1\n3 0 1 2\n3 0 3 1\n";
    let obj = format!("{CUBE}vn 0 0 1\n").replace("f ", "f  ");
    let obj = obj.lines().map(|line| match line.strip_prefix("f  ") {
        Some(corners) => {
            let corners: Vec<String> = corners.split(' ').map(|c| format!("{c}//1")).collect();
            format!("f {}\n", corners.join(" "))
        }
        None => format!("{line}\n"),
    });
    let obj: String = format!("vn 0 0 1\n{}", obj.collect::<String>());
    let folder = Folder::with(&[
        ("a.gltf", &scene(&smooth, json!([{"mesh": 0}]))),
        ("b.obj", &obj),
        ("c.ply", ply),
    ]);
    for (name, edges) in [("a.gltf", 12), ("b.obj", 12), ("c.ply", 1)] {
        let hard = |options: &str| {
            totals(&folder, &format!("{name} -o out.glb {options}"))["hard_edges"].clone()
        };
        assert_eq!(hard("--verify fast"), 0, "{name}");
        assert_eq!(hard("--normals angle --verify fast"), edges, "{name}");
        assert_eq!(hard("--normals angle --smoothing-angle 95 --verify fast"), 0, "{name}");
    }
    folder.run("a.gltf -o out.glb --normals angle").exits(0);
    folder.run("check a.gltf out.glb --normals angle --width 1%").exits(0);
}

#[test]
fn options_come_from_a_file_and_the_command_line_wins() {
    let file =
        "width = 0.1\nwidth_unit = \"scene\"\nverify = \"fast\"\n[material_width]\nMetal = 0\n";
    let folder = Folder::with(&[("a.obj", CUBE), ("o.toml", file), ("bad.toml", "widht = 1\n")]);
    let asked = |options: &str| {
        folder.run(&format!("a.obj -o b.obj --report r.json {options}")).exits(0);
        folder.json("r.json")["options"].clone()
    };
    let found = asked("--options o.toml");
    assert_eq!((&found["width_unit"], &found["verify"]), (&json!("scene"), &json!("fast")));
    assert_eq!(folder.json("r.json")["totals"]["skipped"]["not_selected"], 8);
    let found = asked("--options o.toml --width-percent 3 --verify full --material-width Metal=2%");
    let told = [
        &found["width"],
        &found["width_unit"],
        &found["verify"],
        &found["material_width"]["Metal"],
    ];
    assert_eq!(told, [&json!(3.0), &json!("percent"), &json!("full"), &json!("2%")]);

    let left = folder.json("r.json")["totals"]["skipped"]["not_selected"].clone();
    assert_eq!(left, Value::Null, "of one material the last width counts");

    let printed = folder.run("--print-options --options o.toml --max-angle 100").exits(0).out();
    fs::write(folder.path("again.toml"), &printed).unwrap();
    assert!(
        printed.contains("max_angle = 100\n") && printed.contains("verify = \"fast\"\n"),
        "{printed}"
    );
    assert_eq!(folder.run("--print-options --options again.toml").exits(0).out(), printed);

    let told = folder.run("a.obj --options bad.toml").exits(2).err();
    assert!(
        told.contains("bad.toml: there is no option \"widht\": did you mean \"width\"?"),
        "{told}"
    );
    fs::write(folder.path("bad.toml"), "max_angle = 500").unwrap();
    let told = folder.run("a.obj --options bad.toml").exits(2).err();
    assert!(
        told.contains("bad.toml") && told.contains("'500'") && told.contains("0 to 180"),
        "{told}"
    );
    folder.run("a.obj --options none.toml").exits(2);
}

/// A matrix of a node by columns, with lengths of 1 to 100 along the axes, mirrored or not, and sheared
/// by up to a third of these.
fn random_matrix(state: &mut u32) -> [[f32; 3]; 3] {
    let mut share = || {
        *state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (*state >> 8) as f32 / (1 << 24) as f32
    };
    let lengths = [0; 3].map(|_| 100f32.powf(share()));
    let mirrored = if share() < 0.5 { -1.0 } else { 1.0 };
    let [x, y, z] = lengths;
    [
        [x * mirrored, (share() - 0.5) * x * 0.6, 0.0],
        [0.0, y, (share() - 0.5) * y * 0.6],
        [0.0, 0.0, z],
    ]
}

/// How far in the scene the vertices of a unit cube's faces were pulled from the edges of these, two
/// for each vertex: on the parallelogram that a face becomes.
fn pulled(mesh: &MeshBuffers, axes: [[f32; 3]; 3]) -> Vec<f64> {
    let axes = axes.map(|axis| DVec3::from(axis.map(f64::from)));
    let mut found = Vec::new();
    for at in &mesh.positions {
        let off = at.map(|along| 0.5 - f64::from(along.abs()));
        let face = (0..3).min_by(|&a, &b| off[a].total_cmp(&off[b])).unwrap();
        let (one, two) = ((face + 1) % 3, (face + 2) % 3);
        let area = axes[one].cross(axes[two]).length();
        found.extend([off[one] * area / axes[two].length(), off[two] * area / axes[one].length()]);
    }
    found
}

#[test]
fn boxes_under_random_matrices_have_one_width_in_the_scene() {
    let mut state = 1;
    let matrices: Vec<[[f32; 3]; 3]> = (0..60).map(|_| random_matrix(&mut state)).collect();
    let node = |[x, y, z]: &[[f32; 3]; 3]| {
        let last = [0.0, 0.0, 0.0, 1.0];
        let columns = [x, y, z].map(|axis| [axis[0], axis[1], axis[2], 0.0]);
        let matrix = [columns[0], columns[1], columns[2], last].concat();
        json!({"mesh": 0, "matrix": matrix})
    };
    let nodes: Value = matrices.iter().map(node).collect();
    let folder = Folder::with(&[("a.gltf", &scene(&shapes::plain_cube(1.0), nodes))]);
    folder.run("a.gltf -o b.glb --width 0.05 --verify fast").exits(0);
    let written = document(&folder, "b.glb");
    let objects = written.instances();
    assert_eq!(objects.len(), matrices.len());
    for (object, axes) in objects.iter().zip(matrices) {
        for width in pulled(&written.meshes()[object.mesh].mesh, axes) {
            assert!((width - 0.05).abs() < 1e-4, "{width} under {axes:?}");
        }
    }
}

#[test]
fn a_skinned_mesh_does_not_stand_where_its_node_is() {
    let cube = shapes::plain_cube(1.0);
    let mut json: Value = serde_json::from_str(&scene(&cube, json!([]))).unwrap();
    let count = cube.positions.len();
    let weights: Vec<u8> =
        [1f32, 0.0, 0.0, 0.0].repeat(count).iter().flat_map(|w| w.to_le_bytes()).collect();
    let bytes = base64::engine::general_purpose::STANDARD.encode(&weights);
    let views = json["bufferViews"].as_array().unwrap().len();
    let uri = format!("data:application/octet-stream;base64,{bytes}");
    json["buffers"].as_array_mut().unwrap().push(json!({"uri": uri, "byteLength": weights.len()}));
    let view = json!({"buffer": 1, "byteLength": weights.len()});
    json["bufferViews"].as_array_mut().unwrap().push(view);
    // All vertices hang on joint 0: four zero bytes each, which the weights have too.
    let zeros: Vec<u8> = vec![0; 4 * count];
    let uri = base64::engine::general_purpose::STANDARD.encode(&zeros);
    let uri = format!("data:application/octet-stream;base64,{uri}");
    json["buffers"].as_array_mut().unwrap().push(json!({"uri": uri, "byteLength": zeros.len()}));
    let view = json!({"buffer": 2, "byteLength": zeros.len()});
    json["bufferViews"].as_array_mut().unwrap().push(view);
    let accessors = json["accessors"].as_array_mut().unwrap();
    let first = accessors.len();
    for (view, kind) in [(views, 5126), (views + 1, 5121)] {
        accessors.push(
            json!({"bufferView": view, "componentType": kind, "count": count, "type": "VEC4"}),
        );
    }
    let attributes = &mut json["meshes"][0]["primitives"][0]["attributes"];
    attributes["WEIGHTS_0"] = first.into();
    attributes["JOINTS_0"] = (first + 1).into();
    json["skins"] = json!([{"joints": [1]}]);
    json["nodes"] = json!([{"mesh": 0, "skin": 0, "scale": [50, 1, 7]}, {"scale": [2, 2, 2]}]);
    json["scenes"] = json!([{"nodes": [0, 1]}]);
    let folder = Folder::with(&[("a.gltf", &json.to_string())]);
    folder.run("a.gltf -o b.glb --width 0.05 --verify fast").exits(0);
    let written = document(&folder, "b.glb");
    for width in
        pulled(&written.meshes()[0].mesh, [[2.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 2.0]])
    {
        assert!((width - 0.05).abs() < 1e-5, "as its bone has it: {width}");
    }
}

#[test]
fn each_wrong_value_is_told_with_its_option_and_its_range() {
    let folder = Folder::with(&[("a.obj", CUBE)]);
    let wrong = [
        ("width", "-1", "5mm, 2cm"),
        ("width-percent", "-1", "at least 0"),
        ("width-mode", "height", "offset, chord, depth, radius"),
        ("material-width", "Metal", "NAME=W"),
        ("mask", "x", "r, g, b, a"),
        ("min-angle", "-1", "0 to 180"),
        ("max-angle", "181", "0 to 180"),
        ("convexity", "round", "both, convex, concave"),
        ("hard-angle", "0", "above 0, up to 90"),
        ("segments", "33", "1..=32"),
        ("profile", "1.5", "0 to 1"),
        ("least-breadth", "101", "0 to 100"),
        ("evenness", "-1", "0 to 100"),
        ("verify", "twice", "seen, full, fast"),
        ("chamfer-submesh", "mine", "owner, own"),
        ("normals", "none", "keep, angle"),
        ("smoothing-angle", "200", "0 to 180"),
        ("weld", "-1", "at least 0, or auto"),
        ("threads", "-1", "threads"),
    ];
    for (option, value, range) in wrong {
        let told = folder.run(&format!("a.obj -o b.obj --{option}={value}")).exits(2).err();
        let parts = [format!("--{option}"), format!("'{value}'"), range.to_owned()];
        assert!(parts.iter().all(|part| told.contains(part)), "{parts:?} in: {told}");
    }
}

/// What the command line calls an option and its value, and the options that the library is given.
fn said(percent: f32) -> Vec<(&'static str, Options)> {
    let plain = Options::default().with_width(Width::PercentOfExtent(percent));
    vec![
        ("--width-mode depth", plain.with_width_mode(WidthMode::Depth)),
        ("--min-angle 45", plain.with_angles(45.0, 180.0)),
        ("--max-angle 45", plain.with_angles(0.0, 45.0)),
        ("--convexity convex", plain.with_convexity(Convexity::Convex)),
        ("--hard-angle 45", plain.with_hard_angle(45.0)),
        ("--segments 3", plain.with_segments(3)),
        ("--segments 3 --profile 0.9", plain.with_segments(3).with_profile(0.9)),
        ("--least-breadth 70", plain.with_least_breadth(0.7)),
        ("--evenness 0", plain.with_evenness(0.0)),
        ("--chamfer-submesh own", plain.with_chamfer_submesh(ChamferSubmesh::Own)),
    ]
}

#[test]
fn each_option_is_what_it_is_in_the_library() {
    // Submeshes without materials are one in a file.
    let is_one = |mesh: &MeshBuffers| mesh.submesh_index_counts.len() == 1;
    let models = shapes::demo_models().into_iter().filter(|(_, mesh)| is_one(mesh));
    let models = models.chain([("prism", shapes::prism(12))]);
    let models: Vec<_> = models.map(|(name, mesh)| (name.replace(' ', "_"), mesh)).collect();
    let folder = Folder::with(&[]);
    for (name, mesh) in &models {
        fs::write(folder.path(&format!("{name}.gltf")), gltf(mesh).to_string()).unwrap();
    }
    let chamfered = |name: &str, said: &str| {
        folder.run(&format!("{name}.gltf -o out.glb --width-percent {said}")).exits(0);
        document(&folder, "out.glb").meshes()[0].mesh.clone()
    };
    let plain: Vec<_> = models.iter().map(|(name, _)| chamfered(name, "4")).collect();
    for (arguments, options) in said(4.0) {
        let mut does_anything = false;
        for ((name, mesh), plain) in models.iter().zip(&plain) {
            let found = chamfered(name, &format!("4 {arguments}"));
            let expected = chamfer::chamfer(&mesh.as_mesh(), &options).unwrap().mesh;
            let of =
                |mesh: &MeshBuffers| (mesh.positions.clone(), mesh.submesh_index_counts.clone());
            assert_eq!(of(&found), of(&expected), "{name} {arguments}");
            does_anything |= of(&found) != of(plain);
        }
        assert!(does_anything, "{arguments}");
    }
}
