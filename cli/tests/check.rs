//! `chamfer check` on files: each kind of defect, planted in a file, is found.

#[path = "support/run.rs"]
mod run;

use std::fs;
use std::path::PathBuf;
use std::process::Command;

use chamfer::shapes;
use chamfer::{Chamfered, MeshBuffers, Options, TriangleKind, Width, chamfer};
use chamfer_formats::glb;
use serde_json::{Value, json};
use tempfile::TempDir;

use run::Run;

const WIDTH: f32 = 0.05;

fn chamfered(before: &MeshBuffers) -> Chamfered {
    let options = Options::default().with_width(Width::Units(WIDTH));
    chamfer(&before.as_mesh(), &options).unwrap()
}

/// A folder with files to compare.
struct Folder(TempDir);

impl Folder {
    fn new() -> Folder {
        Folder(tempfile::tempdir().unwrap())
    }

    /// With `before.glb` and `after.glb`.
    fn with(before: &MeshBuffers, after: &MeshBuffers) -> Folder {
        let folder = Folder::new();
        folder.write("before.glb", glb::encode("shape", before, &[], &[]).unwrap());
        folder.write("after.glb", glb::encode("shape", after, &[], &[]).unwrap());
        folder
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn write(&self, name: &str, content: impl AsRef<[u8]>) {
        fs::write(self.path(name), content).unwrap();
    }

    /// Runs `chamfer` with these arguments.
    fn run(&self, arguments: &str) -> Run {
        let mut command = Command::new(env!("CARGO_BIN_EXE_chamfer"));
        Run(command.current_dir(self.0.path()).args(arguments.split(' ')).output().unwrap())
    }

    /// The exit code of a check of `after.glb`, and its report.
    fn check(&self, more: &str) -> (i32, Value) {
        let run = self.run(&format!("check before.glb after.glb --report r.json{more}"));
        let report = serde_json::from_slice(&fs::read(self.path("r.json")).unwrap()).unwrap();
        (run.0.status.code().unwrap(), report)
    }
}

/// The defects that a check finds once `plant` has changed the chamfered shape.
#[track_caller]
fn found(before: &MeshBuffers, plant: impl FnOnce(&mut Chamfered)) -> Vec<String> {
    let mut after = chamfered(before);
    plant(&mut after);
    let (code, report) = Folder::with(before, &after.mesh).check("");
    assert_eq!((code, &report["sound"]), (1, &Value::Bool(false)), "{report:#}");
    let defects = report["meshes"][0]["defects"].as_array().unwrap().iter();
    defects.map(|defect| defect["rule"].as_str().unwrap().to_owned()).collect()
}

/// Appends a triangle to the last submesh.
fn add_triangle(mesh: &mut MeshBuffers, vertices: [u32; 3]) {
    mesh.indices.extend(vertices);
    *mesh.submesh_index_counts.last_mut().unwrap() += 3;
}

/// Takes the last triangle away.
fn remove_triangle(mesh: &mut MeshBuffers) {
    mesh.indices.truncate(mesh.indices.len() - 3);
    *mesh.submesh_index_counts.last_mut().unwrap() -= 3;
}

/// Moves all vertices at the position of one.
fn move_cluster(mesh: &mut MeshBuffers, vertex: usize, by: [f32; 3]) {
    let from = mesh.positions[vertex];
    for position in mesh.positions.iter_mut().filter(|position| **position == from) {
        *position = [0, 1, 2].map(|axis| position[axis] + by[axis]);
    }
}

fn has(rules: &[String], rule: &str) -> bool {
    rules.iter().any(|name| name == rule)
}

#[test]
fn clean_pairs_are_sound() {
    for (name, before) in shapes::demo_models() {
        let folder = Folder::with(&before, &chamfered(&before).mesh);
        let (code, report) = folder.check(&format!(" --width {WIDTH}"));
        assert_eq!(code, 0, "{name}: {report:#}");
        // The submeshes of one material became one: that is another order.
        let order = if before.submesh_index_counts.len() > 1 { "geometry" } else { "order" };
        assert_eq!(report["meshes"][0]["matched_by"], order, "{name}");
        assert!(report["totals"]["chamfers"]["count"].as_u64() > Some(0), "{name}");
    }
}

#[test]
fn an_unchanged_file_is_sound_and_has_no_chamfers() {
    let cube = shapes::cube(1.0);
    let (code, report) = Folder::with(&cube, &cube).check("");
    assert_eq!((code, &report["totals"]["chamfers"]["count"]), (0, &0.into()));
    assert_eq!(report["totals"]["after"]["hard_edges"], 12);
}

#[test]
fn a_flip() {
    let rules = found(&shapes::cube(1.0), |after| after.mesh.indices.swap(0, 1));
    assert!(has(&rules, "flipped triangle") && has(&rules, "unbalanced edge"), "{rules:?}");
}

#[test]
fn a_hole() {
    let rules = found(&shapes::cube(1.0), |after| remove_triangle(&mut after.mesh));
    assert!(has(&rules, "unbalanced edge"), "{rules:?}");
}

#[test]
fn a_moved_vertex() {
    let rules = found(&shapes::cube(1.0), |after| {
        move_cluster(&mut after.mesh, 0, [0.004, -0.003, 0.005]);
    });
    assert!(has(&rules, "flat face bent"), "{rules:?}");
}

#[test]
fn an_edge_that_is_not_closed() {
    let rules = found(&shapes::cube(1.0), |after| {
        let [x, y, z] = after.mesh.positions[0];
        after.mesh.positions.push([x, y * 0.99, z * 0.99]);
        let vertex = after.mesh.positions.len() as u32 - 1;
        copy_streams(&mut after.mesh, 0);
        let place = after.mesh.indices.iter().position(|&index| index == 0).unwrap();
        after.mesh.indices[place] = vertex;
    });
    assert!(has(&rules, "unbalanced edge") && has(&rules, "border loops"), "{rules:?}");
}

/// Gives the vertex behind the last what another has.
fn copy_streams(mesh: &mut MeshBuffers, from: usize) {
    mesh.normals.push(mesh.normals[from]);
    mesh.tangents.extend(mesh.tangents.get(from).copied());
    mesh.colors.extend(mesh.colors.get(from).copied());
    for uv in &mut mesh.uvs {
        let width = uv.components as usize;
        uv.values.extend_from_within(from * width..(from + 1) * width);
    }
}

#[test]
fn a_degenerate_triangle() {
    let rules = found(&shapes::cube(1.0), |after| add_triangle(&mut after.mesh, [0, 1, 1]));
    assert!(has(&rules, "triangle without area"), "{rules:?}");
}

#[test]
fn a_self_intersection() {
    // A leg's foot stands in another leg.
    let rules = found(&shapes::table(), |after| {
        let is_foot = |p: &[f32; 3]| p[1] < 0.2 && p[0] > 0.0 && p[2] > 0.0;
        for position in after.mesh.positions.iter_mut().filter(|position| is_foot(position)) {
            position[0] -= 1.65;
            position[2] -= 0.03;
        }
    });
    assert!(has(&rules, "self-intersection"), "{rules:?}");
}

#[test]
fn a_normal_that_is_not_unit() {
    // Readers repair this one.
    let rules = found(&shapes::cube(1.0), |after| after.mesh.normals[3] = [0.0, 0.5, 0.0]);
    assert!(has(&rules, "normal not unit"), "{rules:?}");
}

#[test]
fn a_tangent_that_is_not_right() {
    let before = shapes::cube(1.0);
    let normal = before.normals[5];
    for tangent in [[0.0, 0.0, 0.0, 1.0], [normal[0], normal[1], normal[2], 1.0]] {
        let rules = found(&before, |after| after.mesh.tangents[5] = tangent);
        assert!(has(&rules, "tangent not right"), "{rules:?}");
    }
}

#[test]
fn a_border_loop_too_many() {
    let rules = found(&shapes::open_box(), |after| remove_triangle(&mut after.mesh));
    assert!(has(&rules, "border loops"), "{rules:?}");
}

#[test]
fn an_edge_of_four_triangles() {
    let rules = found(&shapes::cube(1.0), |after| {
        let [a, b] = [after.mesh.indices[0], after.mesh.indices[1]];
        after.mesh.positions.push([2.0, 2.0, 2.0]);
        copy_streams(&mut after.mesh, 0);
        let tip = after.mesh.positions.len() as u32 - 1;
        add_triangle(&mut after.mesh, [a, b, tip]);
        add_triangle(&mut after.mesh, [b, a, tip]);
    });
    assert!(has(&rules, "non-manifold edge"), "{rules:?}");
}

#[test]
fn a_new_hard_edge() {
    // One strip is shaded flat.
    let rules = found(&shapes::cube(1.0), |after| {
        let is_strip = |place: &usize| after.triangle_sources[*place].kind == TriangleKind::Edge;
        let strip = (0..after.triangle_sources.len()).find(is_strip).unwrap();
        let corners: [usize; 3] = [0, 1, 2].map(|side| 3 * strip + side);
        let vertices = corners.map(|corner| after.mesh.indices[corner] as usize);
        let sum = vertices.map(|vertex| glam::Vec3::from(after.mesh.normals[vertex]));
        let flat = sum.iter().sum::<glam::Vec3>().normalize();
        for (corner, vertex) in corners.into_iter().zip(vertices) {
            after.mesh.indices[corner] = after.mesh.positions.len() as u32;
            after.mesh.positions.push(after.mesh.positions[vertex]);
            copy_streams(&mut after.mesh, vertex);
            *after.mesh.normals.last_mut().unwrap() = flat.to_array();
        }
        after.mesh.tangents.clear();
    });
    assert!(has(&rules, "new hard edge"), "{rules:?}");
}

#[test]
fn a_hard_edge_that_is_left() {
    // One cube of two is as it was before.
    let [one, two] = [shapes::plain_cube(1.0), shapes::two_cubes_touching(shapes::Touch::Vertex)];
    assert_eq!(two.indices.len(), 2 * one.indices.len());
    let before = apart(&two);
    let mut after = chamfered(&first_half(&before)).mesh;
    let first = after.positions.len() as u32;
    let rest = before.positions.len() / 2;
    after.positions.extend(&before.positions[rest..]);
    after.normals.extend(&before.normals[rest..]);
    let half = before.indices.len() / 2;
    let moved: Vec<u32> =
        before.indices[half..].iter().map(|index| index - rest as u32 + first).collect();
    after.indices.splice(half..half, moved);
    after.submesh_index_counts = vec![after.indices.len() as u32];
    let folder = Folder::with(&before, &after);
    let (code, report) = folder.check("");
    assert_eq!((code, &report["totals"]["after"]["hard_edges"]), (0, &12.into()), "{report:#}");
    let (code, report) = folder.check(&format!(" --width {WIDTH}"));
    assert_eq!((code, &report["totals"]["left_without_need"]), (1, &12.into()));
    assert_eq!(report["meshes"][0]["defects"][0]["rule"], "hard edge left");
}

/// The streams that matter here, with the second half of the vertices farther away.
fn apart(mesh: &MeshBuffers) -> MeshBuffers {
    let mut apart = MeshBuffers {
        positions: mesh.positions.clone(),
        normals: mesh.normals.clone(),
        indices: mesh.indices.clone(),
        submesh_index_counts: vec![mesh.indices.len() as u32],
        ..MeshBuffers::default()
    };
    let half = apart.positions.len() / 2;
    apart.positions[half..].iter_mut().for_each(|position| position[0] += 3.0);
    apart
}

fn first_half(mesh: &MeshBuffers) -> MeshBuffers {
    let half = mesh.indices.len() / 2;
    MeshBuffers {
        positions: mesh.positions[..mesh.positions.len() / 2].to_vec(),
        normals: mesh.normals[..mesh.normals.len() / 2].to_vec(),
        indices: mesh.indices[..half].to_vec(),
        submesh_index_counts: vec![half as u32],
        ..MeshBuffers::default()
    }
}

#[test]
fn the_table_names_what_is_wrong() {
    let before = shapes::cube(1.0);
    let mut after = chamfered(&before).mesh;
    after.indices.swap(0, 1);
    let folder = Folder::with(&before, &after);
    let out = folder.run("check before.glb after.glb").exits(1).out();
    assert!(out.starts_with("mesh "), "{out}");
    assert!(out.contains("shape: flipped triangle: 1 (triangle 0)\n"), "{out}");
    assert!(out.contains("12 -> 0") && out.contains("0.05000"), "{out}");
    assert!(out.ends_with("not sound\n"), "{out}");
}

#[test]
fn triangles_in_another_order_are_found() {
    let before = shapes::plain_cube(1.0);
    let mut after = chamfered(&before).mesh;
    let triangles: Vec<u32> = after.indices.chunks(3).rev().flatten().copied().collect();
    after.indices = triangles;
    let (code, report) = Folder::with(&before, &after).check("");
    assert_eq!((code, &report["meshes"][0]["matched_by"]), (0, &"geometry".into()), "{report:#}");
    assert_eq!(report["totals"]["chamfers"]["count"], 12);
}

#[test]
fn an_obj_and_an_stl_are_checked_too() {
    let folder = Folder::new();
    let cube = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n\
        f 5 6 7 8\nf 4 3 2 1\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
    folder.write("cube.obj", cube);
    folder.run("cube.obj -o soft.obj").exits(0);
    folder.run("check cube.obj soft.obj --width-percent 1").exits(0);
    folder.run("cube.obj -o soft.glb").exits(0);
    folder.run("check cube.obj soft.glb").exits(0);
    // OBJ counts the second texture coordinate from below, glTF from above.
    let faces =
        cube.replace("f 5 6 7 8", "f 5/1 6/2 7/3 8/1").replace("f 1 2 6 5", "f 1/1 2/2 6/3 5/2");
    folder.write("painted.obj", format!("vt 0 0\nvt 1 0.25\nvt 1 1\n{faces}"));
    for to in ["painted_soft.obj", "painted_soft.glb"] {
        folder.run(&format!("painted.obj -o {to}")).exits(0);
        folder.run(&format!("check painted.obj {to}")).exits(0);
    }
    let corners = [[0, 0, 0], [0, 1, 0], [1, 0, 0], [0, 0, 1]];
    let facets = [[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]].map(|facet| {
        let vertices = facet.map(|corner: usize| {
            let [x, y, z] = corners[corner];
            format!("vertex {x} {y} {z}\n")
        });
        format!("facet normal 0 0 0\nouter loop\n{}endloop\nendfacet\n", vertices.concat())
    });
    folder.write("one.stl", format!("solid one\n{}endsolid one\n", facets.concat()));
    folder.run("one.stl -o soft.stl").exits(0);
    let out = folder.run("check one.stl soft.stl").exits(3).out();
    assert!(out.contains("not fully checked: new hard edge"), "{out}");
    assert!(out.ends_with("sound as far as checked\n"), "{out}");
    let bad = fs::read_to_string(folder.path("soft.obj")).unwrap().replacen("vn ", "vn 7", 1);
    folder.write("bad.obj", bad);
    let out = folder.run("check cube.obj bad.obj").exits(1).out();
    assert!(out.contains("normal not unit"), "{out}");
}

#[test]
fn files_that_cannot_be_read_and_nonsense_exit_with_two() {
    let cube = shapes::cube(1.0);
    let folder = Folder::with(&cube, &cube);
    folder.write("bad.glb", "nothing");
    for arguments in [
        "check before.glb",
        "check before.glb gone.glb",
        "check bad.glb after.glb",
        "check before.glb after.glb --width -1",
        "check before.glb after.glb --width 1 --width-percent 1",
        "check before.glb after.glb --report .",
        "check before.glb after.glb --preview .",
        "check before.glb after.glb --preview before.glb",
        "check before.glb after.glb --report r --preview r",
    ] {
        let run = folder.run(arguments).exits(2);
        assert!(!run.err().is_empty(), "{arguments}");
    }
}

/// A file with a mesh at each of these places: a vertical scale, and how far it is lifted.
fn glb_with(mesh: &MeshBuffers, places: &[[f32; 2]]) -> Vec<u8> {
    let glb = glb::encode("shape", mesh, &[], &[]).unwrap();
    let length = u32::from_le_bytes(glb[12..16].try_into().unwrap()) as usize;
    let mut root: Value = serde_json::from_slice(&glb[20..20 + length]).unwrap();
    let node = |[scale, lift]: &[f32; 2]| json!({ "mesh": 0, "scale": [1, scale, 1], "translation": [0, lift, 0] });
    root["nodes"] = places.iter().map(node).collect();
    root["scenes"][0]["nodes"] = (0..places.len()).collect();
    let mut text = serde_json::to_vec(&root).unwrap();
    text.resize(text.len().next_multiple_of(4), b' ');
    let rest = &glb[20 + length..];
    let size = |bytes: usize| (bytes as u32).to_le_bytes();
    let head = [&glb[..8], &size(20 + text.len() + rest.len()), &size(text.len()), &glb[16..20]];
    [head.concat(), text, rest.to_vec()].concat()
}

//   ____          ____
//  |    |        |    |   the lid's box is the other one, mirrored
//  |    |        |____ <- lifted by hand: light shows here
//  |    |   ->
//  |    |         ____
//  |    |        |    |
//  |____|        |____|
/// A closed box of two open ones, before and after; the upper one is lifted by so much after.
fn box_of_open_parts(lift: f32) -> Folder {
    let part = shapes::open_box();
    let folder = Folder::new();
    let places = |lift: f32| [[1.0, 0.0], [-1.0, 2.0 + lift]];
    folder.write("before.glb", glb_with(&part, &places(0.0)));
    folder.write("after.glb", glb_with(&chamfered(&part).mesh, &places(lift)));
    folder
}

#[test]
fn an_object_that_stands_elsewhere() {
    let (code, report) = box_of_open_parts(0.3).check(" --no-see-through");
    assert_eq!((code, &report["verdict"]), (1, &"not sound".into()), "{report:#}");
    assert_eq!(report["meshes"][0]["defects"][0]["rule"], "object placed otherwise");
}

#[test]
fn a_box_of_open_parts_is_sound() {
    let (code, report) = box_of_open_parts(0.0).check("");
    assert_eq!((code, &report["verdict"]), (0, &"sound".into()), "{report:#}");
    let width = report["see_through"]["width"].as_f64().unwrap();
    assert!((width - f64::from(WIDTH)).abs() < 1e-6, "{width}");
}

#[test]
fn light_that_shows_between_its_parts() {
    let folder = box_of_open_parts(0.3);
    let (code, report) = folder.check("");
    assert_eq!((code, &report["verdict"]), (1, &"not sound".into()), "{report:#}");
    let defects = report["meshes"][0]["defects"].as_array().unwrap();
    assert!(defects.iter().all(|defect| defect["rule"] == "object placed otherwise"), "{report:#}");
    let place = &report["see_through"]["places"][0];
    assert!((place["at"][1].as_f64().unwrap() - 1.15).abs() < 0.2, "{place:#}");
    assert_eq!(place["deeper"], Value::Null);
    let out = folder.run("check before.glb after.glb").exits(1).out();
    assert!(out.contains("light shows at (") && out.contains(" samples, nothing behind"), "{out}");
    assert!(out.ends_with("not sound\n"), "{out}");
    folder.run("check before.glb after.glb --width 0.05").exits(1);
}

#[test]
fn what_is_left_out_is_named() {
    let folder = box_of_open_parts(0.0);
    let told = |more: &str| folder.run(&format!("check before.glb after.glb{more}")).exits(3).out();
    let out = told(" --no-see-through");
    assert!(out.contains("not fully checked: see-through: left out by --no-see-through"), "{out}");
    let cube = shapes::cube(1.0);
    let folder = Folder::with(&cube, &chamfered(&cube).mesh);
    let out = folder.run("check before.glb after.glb --verify fast").exits(3).out();
    assert!(out.contains("self-intersection: left out by --verify fast"), "{out}");
    assert!(out.ends_with("sound as far as checked\n"), "{out}");
}

#[test]
fn a_scene_that_changed_without_chamfers_is_not_looked_through() {
    let cube = shapes::cube(1.0);
    let folder = Folder::new();
    folder.write("before.glb", glb_with(&cube, &[[1.0, 0.0]]));
    folder.write("after.glb", glb_with(&cube, &[[1.0, 0.5]]));
    let out = folder.run("check before.glb after.glb").exits(1).out();
    assert!(out.contains("object placed otherwise: 1 (object 0)"), "{out}");
    assert!(out.contains("see-through: there are no chamfers to tell the width"), "{out}");
}

#[test]
fn the_picture_shows_the_light_or_the_model() {
    for (lift, code, size) in [(0.0, 0, (1202, 656)), (0.3, 1, (642, 376))] {
        let folder = box_of_open_parts(lift);
        folder.run("check before.glb after.glb --preview p.png").exits(code);
        let picture = image::open(folder.path("p.png")).unwrap();
        assert_eq!(picture.width(), size.0, "lifted by {lift}");
        assert!(picture.height() >= size.1, "lifted by {lift}");
    }
}

/// Of a cube only the upright edges are chamfered: flaps stand at their ends, where edges that stay
/// hard come apart.
#[test]
fn edges_that_the_options_leave_out_are_no_chamfers_and_not_missed() {
    let prism = shapes::prism(6);
    let folder = Folder::new();
    folder.write("before.glb", glb::encode("shape", &prism, &[], &[]).unwrap());
    folder.write("some.toml", "width = 2\nmin_angle = 50\nmax_angle = 70\n");
    let made = folder.run("before.glb -o after.glb --options some.toml");
    assert!(made.0.status.success(), "{:?}", made.0);
    let chamfers = |report: &Value| report["meshes"][0]["chamfers"]["count"].clone();
    let (code, report) = folder.check(" --options some.toml");
    assert_eq!((code, chamfers(&report)), (0, json!(6)), "{report:#}");
    folder.write("after.glb", glb::encode("shape", &prism, &[], &[]).unwrap());
    let (code, report) = folder.check(" --options some.toml");
    let left = &report["meshes"][0]["left_without_need"];
    assert_eq!((code, left), (1, &json!(6)), "{report:#}");
    folder.run("before.glb -o after.glb --width-percent 2");
    let (code, report) = folder.check(" --options some.toml");
    let found = &report["meshes"][0]["defects"][0];
    assert_eq!((code, &found["count"]), (1, &json!(12)), "{report:#}");
    assert_eq!(found["rule"], "chamfered although not selected");
    let refused = folder.run("check before.glb after.glb --options none.toml");
    assert_eq!(refused.0.status.code(), Some(2));
}

//      +---+                +---+
//     /   /                /   /     plates hang from both ends of the upper edge of a beam: it
//   -+---+----------------+---+-     opens in its middle alone
//
#[test]
fn an_edge_that_opens_in_its_middle_is_not_missed() {
    let mut beam = shapes::plain_cube(1.0);
    beam.positions.iter_mut().for_each(|position| position[0] *= 10.0);
    for [from, to] in [[-5.0, -4.0], [4.0, 5.0]] {
        let first = beam.positions.len() as u32;
        let corners = [[from, 0.5, 0.5], [from, 0.2, 1.5], [to, 0.2, 1.5], [to, 0.5, 0.5]];
        beam.positions.extend(corners);
        beam.normals.extend([[0.0, 0.957_826_3, 0.287_347_9]; 4]);
        beam.indices.extend([0, 1, 2, 0, 2, 3].map(|corner| first + corner));
    }
    beam.submesh_index_counts = vec![beam.indices.len() as u32];
    let folder = Folder::new();
    folder.write("before.glb", glb::encode("shape", &beam, &[], &[]).unwrap());
    folder.run("before.glb -o after.glb --width 0.02 --report r.json --report-edges");
    let report: Value =
        serde_json::from_slice(&fs::read(folder.0.path().join("r.json")).unwrap()).unwrap();
    let edges = report["files"][0]["meshes"][0]["edges"].as_array().unwrap();
    let is_closed_at_its_ends = |edge: &&Value| edge["widths"] == json!([0.0, 0.0]);
    let found: Vec<&Value> = edges.iter().filter(is_closed_at_its_ends).collect();
    assert!(found.iter().any(|edge| edge["outcome"] == "narrowed"), "{edges:#?}");
    let (code, report) = folder.check(" --width 0.02");
    assert_eq!(code, 0, "{report:#}");
}

/// What is no edge by the angle that the model was chamfered with needs no chamfer, and counts for none.
#[test]
fn it_goes_by_the_angle_that_made_edges_hard() {
    let folder = Folder::with(&shapes::prism(8), &MeshBuffers::default());
    folder.write("some.toml", "width = 2\nhard_angle = 60\n");
    let made = folder.run("before.glb -o after.glb --options some.toml");
    assert_eq!(made.0.status.code(), Some(0), "{:?}", made.0);
    let hard_edges = |report: &Value| report["meshes"][0]["before"]["hard_edges"].clone();
    for told in [" --hard-angle 60", " --options some.toml"] {
        let (code, report) = folder.check(told);
        assert_eq!((code, hard_edges(&report)), (0, json!(16)), "{told}: {report}");
    }
    // The edges between the sides, too.
    for told in ["", " --options some.toml --hard-angle 1"] {
        assert_eq!(hard_edges(&folder.check(told).1), 24, "{told}");
    }
}
