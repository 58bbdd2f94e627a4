//! Runs the built `chamfer` on files that the tests write.

#[path = "support/folder.rs"]
mod folder;
#[path = "support/run.rs"]
mod run;

use std::fs;
use std::process::Command;

use serde_json::Value;

use folder::Folder;
use run::Run;

const CUBE_OBJ: &str = "\
# a cube
mtllib cube.mtl
o cube
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
v 0 0 1
v 1 0 1
v 1 1 1
v 0 1 1
usemtl top
f 5 6 7 8
usemtl sides
f 4 3 2 1
f 1 2 6 5
f 2 3 7 6
f 3 4 8 7
f 4 1 5 8
";

const TRIANGLE_STL: &str = "solid one
facet normal 0 0 1
outer loop
vertex 0 0 0
vertex 1 0 0
vertex 0 1 0
endloop
endfacet
endsolid one
";

/// A .gltf of one triangle, its buffer inside.
const TRIANGLE_GLTF: &str = r#"{
"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
"meshes": [{"name": "tri", "primitives": [{"attributes": {"POSITION": 0}}]}],
"accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
  "min": [0, 0, 0], "max": [1, 1, 0]}],
"bufferViews": [{"buffer": 0, "byteLength": 36}],
"buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]
}"#;

#[test]
fn an_obj_stays_an_obj_with_its_materials() {
    let folder = Folder::with(&[("cube.obj", CUBE_OBJ), ("cube.mtl", "newmtl top\n")]);
    let run = folder.run("cube.obj -o soft/cube.obj").exits(0);
    assert!(run.out().starts_with("cube.obj -> soft/cube.obj: "), "{}", run.out());
    assert_eq!(run.out().lines().count(), 1);
    assert_eq!(run.err(), "");
    let text = folder.text("soft/cube.obj");
    assert!(text.starts_with("# a cube\nv "), "{text}");
    let order: Vec<&str> = text.lines().filter(|line| line.starts_with(['o', 'u', 'm'])).collect();
    assert_eq!(order, ["mtllib cube.mtl", "o cube", "usemtl top", "usemtl sides"]);
    assert_eq!(folder.files(), ["cube.mtl", "cube.obj", "soft/cube.mtl", "soft/cube.obj"]);
}

#[test]
fn an_obj_goes_out_as_glb_where_asked() {
    let folder = Folder::with(&[("cube.obj", CUBE_OBJ)]);
    folder.run("cube.obj -o cube.glb").exits(0);
    assert!(fs::read(folder.path("cube.glb")).unwrap().starts_with(b"glTF"));
}

/// The cube has a material for its top and one for its sides, and its faces stay squares: 12 strips
/// and 8 corners are new.
#[test]
fn chamfers_go_to_the_submesh_that_is_asked_for() {
    let folder = Folder::with(&[("cube.obj", CUBE_OBJ)]);
    let faces = |submesh: &str| -> Vec<usize> {
        folder.run(&format!("cube.obj -o out.obj --chamfer-submesh {submesh}")).exits(0);
        let text = folder.text("out.obj");
        let groups = text.split("usemtl ").skip(1);
        groups.map(|group| group.matches("\nf ").count()).collect()
    };
    assert_eq!(faces("own"), [1, 5, 32]);
    assert_eq!(faces("0"), [33, 5]);
    assert_eq!(faces("owner").iter().sum::<usize>(), 38);
    folder.run("cube.obj -o out.obj --chamfer-submesh 2").exits(1);
}

#[test]
fn results_are_compressed_where_asked() {
    let folder = Folder::with(&[("cube.obj", CUBE_OBJ)]);
    let run = folder.run("cube.obj -o small.glb --compress meshopt").exits(0);
    let told = "cube.obj: note: written with EXT_meshopt_compression: ";
    assert!(run.err().starts_with(told), "{}", run.err());
    let text = fs::read(folder.path("small.glb")).unwrap();
    assert!(String::from_utf8_lossy(&text).contains(r#""mode":"ATTRIBUTES""#));
    folder.run("check cube.obj small.glb").exits(0);
    let run = folder.run("cube.obj -o small.obj --compress meshopt").exits(1);
    assert!(run.err().contains("only .glb and .gltf can be compressed"), "{}", run.err());
    let run = folder.run("small.glb -o again.glb --compress meshopt").exits(0);
    assert!(!run.err().contains("is written without"), "{}", run.err());
}

#[test]
fn an_stl_goes_out_as_glb_unless_an_stl_is_asked_for() {
    let folder = Folder::with(&[("a.stl", TRIANGLE_STL)]);
    folder.run("a.stl").exits(0);
    assert!(fs::read(folder.path("a.chamfered.glb")).unwrap().starts_with(b"glTF"));
    folder.run("a.stl -o b.stl").exits(0);
    assert_eq!(fs::read(folder.path("b.stl")).unwrap().len(), 84 + 50);
}

#[test]
fn a_gltf_stays_one_or_becomes_a_glb() {
    let folder = Folder::with(&[("a.gltf", TRIANGLE_GLTF)]);
    folder.run("a.gltf -o b.gltf").exits(0);
    assert_eq!(folder.json("b.gltf")["meshes"][0]["name"], "tri");
    folder.run("a.gltf -o b.glb").exits(0);
    folder.run("b.glb -o c.glb").exits(0);
    assert!(fs::read(folder.path("c.glb")).unwrap().starts_with(b"glTF"));
    let run = folder.run("a.gltf -o a.obj").exits(2);
    assert!(run.err().contains(".gltf cannot be written as .obj"), "{}", run.err());
}

#[test]
fn one_bad_file_does_not_stop_the_others() {
    let folder = Folder::with(&[
        ("in/a/cube.obj", CUBE_OBJ),
        ("in/bad.obj", "v 0 0 0\nf 1 2 3\n"),
        ("in/c.stl", TRIANGLE_STL),
        ("in/notes.txt", "not a model"),
    ]);
    let run = folder.run("in -o out --report r.json").exits(1);
    let told: Vec<String> = run.err().lines().map(str::to_owned).collect();
    assert_eq!(told[0], "in/bad.obj: line 2: vertex 2 of 1 that the file has");
    assert!(told[1].starts_with("in/c.stl: note: it has no hard edges") && told.len() == 2);
    let lines: Vec<String> =
        run.out().lines().map(|line| line.chars().take(12).collect()).collect();
    assert_eq!(lines, ["in/a/cube.ob", "in/c.stl -> ", "3 files, 1 f"]);
    let results: Vec<String> =
        folder.files().into_iter().filter(|file| !file.starts_with("in/")).collect();
    assert_eq!(results, ["out/a/cube.obj", "out/c.glb", "r.json"]);
    let report = folder.json("r.json");
    assert_eq!(report["files"][1]["error"], "line 2: vertex 2 of 1 that the file has");
    assert_eq!(report["totals"]["failed"], 1);
}

#[test]
fn every_kind_of_bad_file_gives_one_line() {
    let folder = Folder::with(&[
        ("cut.stl", &TRIANGLE_STL[..100]),
        ("nan.stl", &TRIANGLE_STL.replace("1 0 0", "nan 0 0")),
        ("word.obj", "v a b c\n"),
        ("empty.glb", ""),
        ("text.gltf", "hello"),
        ("what.xyz", ""),
    ]);
    let missing = ["gone.obj", "gone.glb"];
    let broken = ["cut.stl", "nan.stl", "word.obj", "empty.glb", "text.gltf", "what.xyz"];
    for name in broken.into_iter().chain(missing) {
        let run = folder.run(&format!("{name} -o out/")).exits(1);
        assert_eq!(run.err().lines().count(), 1, "{}", run.err());
        assert!(run.err().starts_with(&format!("{name}: ")), "{}", run.err());
        assert_eq!(run.err().matches(name).count(), 1, "{}", run.err());
        assert_eq!(run.out(), "");
    }
    assert_eq!(folder.files().len(), broken.len());
}

#[test]
fn a_header_that_promises_too_much_is_no_reason_to_panic() {
    let folder = Folder::with(&[]);
    let mut bytes = vec![0; 80];
    bytes.extend(u32::MAX.to_le_bytes());
    fs::write(folder.path("big.stl"), bytes).unwrap();
    let run = folder.run("big.stl").exits(1);
    assert!(run.err().contains("announces 4294967295 triangles"), "{}", run.err());
}

#[test]
fn the_report_has_the_figures_of_each_mesh() {
    let folder = Folder::with(&[("cube.obj", CUBE_OBJ)]);
    folder.run("cube.obj -o out.obj --report sub/r.json --width 0.1").exits(0);
    let report = folder.json("sub/r.json");
    assert_eq!(report["files"][0]["file"], "cube.obj");
    assert_eq!(report["files"][0]["output"], "out.obj");
    assert!(report["files"][0].get("error").is_none());
    let mesh = &report["files"][0]["meshes"][0];
    assert_eq!((&mesh["name"], &mesh["triangles_in"]), (&"cube".into(), &12.into()));
    for key in ["triangles_out", "vertices_in", "vertices_out", "hard_edges", "full", "narrowed"] {
        assert!(mesh[key].is_u64(), "{key}");
        assert!(report["totals"][key].is_u64(), "{key}");
    }
    for key in ["mean_width", "width", "milliseconds"] {
        assert!(mesh[key].is_number(), "{key}");
    }
    assert!(mesh["skipped"].is_object());
}

#[test]
fn the_report_lists_every_hard_edge_where_asked() {
    let folder = Folder::with(&[("cube.obj", CUBE_OBJ)]);
    folder.run("cube.obj -o out.obj --report r.json --report-edges --width 0.1").exits(0);
    let report = folder.json("r.json");
    let edges = report["files"][0]["meshes"][0]["edges"].as_array().unwrap();
    assert_eq!(edges.len(), 12);
    for edge in edges {
        assert_eq!((&edge["outcome"], &edge["reason"]), (&"full".into(), &"none".into()));
        let [a, b] = [0, 1].map(|end| edge["positions"][end].as_array().unwrap());
        let along = a.iter().zip(b).filter(|(a, b)| a != b).count();
        assert_eq!((along, edge["vertices"].as_array().unwrap().len()), (1, 2));
        let is_asked = |width: &Value| (width.as_f64().unwrap() - 0.1).abs() < 1e-6;
        assert!(edge["widths"].as_array().unwrap().iter().all(is_asked), "{edge}");
    }
    folder.run("cube.obj -o out.obj --report r.json").exits(0);
    assert!(folder.json("r.json")["files"][0]["meshes"][0].get("edges").is_none());
}

#[test]
fn a_picture_shows_the_verdicts_where_asked() {
    let folder = Folder::with(&[("cube.obj", CUBE_OBJ)]);
    folder.run("cube.obj -o x.obj --preview plain.png").exits(0);
    folder.run("cube.obj -o x.obj --preview told.png --preview-verdicts").exits(0);
    let greens = |name: &str| {
        let picture = image::open(folder.path(name)).unwrap().into_rgb8();
        let (left, right): (Vec<_>, Vec<_>) =
            picture.enumerate_pixels().partition(|(x, ..)| 2 * x < picture.width());
        let is_green = |p: &image::Rgb<u8>| p.0[1] > 150 && p.0[0] < 100 && p.0[2] < 130;
        [left, right].map(|half| half.iter().filter(|(.., pixel)| is_green(pixel)).count())
    };
    assert_eq!(greens("plain.png"), [0, 0]);
    assert!(greens("told.png").iter().all(|&count| count > 500), "{:?}", greens("told.png"));
}

#[test]
fn a_model_without_triangles_passes_through() {
    let text = "# points\nv 0 0 0\nv 1   0 0\np 1 2\n";
    let folder = Folder::with(&[("points.obj", text)]);
    let run = folder.run("points.obj -o out.obj").exits(0);
    assert!(run.err().contains("points.obj: note: there are no triangles"), "{}", run.err());
    assert_eq!(folder.text("out.obj"), text);
}

#[test]
fn nonsense_arguments_exit_with_two_before_any_work() {
    let folder = Folder::with(&[("a.obj", CUBE_OBJ), ("b/a.obj", CUBE_OBJ)]);
    let before = folder.files();
    for arguments in [
        "",
        "a.obj --width 1 --width-percent 1",
        "a.obj --width -1",
        "a.obj --no-such-thing",
        "a.obj b/a.obj",
        "a.obj b/a.obj -o out",
        "b",
        "b -o b",
        "b -o out.glb",
        "a.obj -o out.xyz",
        "a.obj -o out.stl",
        "a.obj --report a.obj",
    ] {
        let run = folder.run(arguments).exits(2);
        assert!(run.err().contains("error: "), "{arguments}: {}", run.err());
        assert_eq!(folder.files(), before, "{arguments}");
    }
}

#[test]
fn an_input_is_replaced_only_by_name() {
    let folder = Folder::with(&[("a.obj", CUBE_OBJ)]);
    folder.run("a.obj -o .").exits(2);
    assert_eq!(folder.text("a.obj"), CUBE_OBJ);
    folder.run("a.obj -o a.obj").exits(0);
    assert_ne!(folder.text("a.obj"), CUBE_OBJ);
    assert_eq!(folder.files(), ["a.obj"]);
}

#[test]
fn results_do_not_depend_on_the_threads() {
    let folder =
        Folder::with(&[("in/a.obj", CUBE_OBJ), ("in/b.stl", TRIANGLE_STL), ("in/c.obj", CUBE_OBJ)]);
    folder.run("in -o one --threads 1").exits(0);
    folder.run("in -o four --threads 4").exits(0);
    for name in ["a.obj", "b.glb", "c.obj"] {
        let read = |run: &str| fs::read(folder.path(run).join(name)).unwrap();
        assert_eq!(read("one"), read("four"), "{name}");
    }
}

#[test]
fn previews_are_pictures() {
    let folder = Folder::with(&[("a.obj", CUBE_OBJ), ("b.stl", TRIANGLE_STL)]);
    folder.run("a.obj -o x.obj --preview one.png").exits(0);
    folder.run("a.obj b.stl -o out --preview p/two.png").exits(0);
    let one = image::open(folder.path("one.png")).unwrap();
    let two = image::open(folder.path("p/two.png")).unwrap();
    assert!(two.height() > one.height());
}

fn size_of(folder: &Folder, name: &str) -> (u32, u32) {
    let picture = image::open(folder.path(name)).unwrap();
    (picture.width(), picture.height())
}

/// A tile is 100 pixels wide, a line of text 28 high, and there are two pixels between tiles.
#[test]
fn previews_have_widths_and_a_close_up_in_the_size_asked_for() {
    let folder = Folder::with(&[("a.obj", CUBE_OBJ)]);
    let run = |more: &str| {
        folder
            .run(format!("a.obj -o x.obj --preview p.png --preview-size 100 {more}").trim_end())
            .exits(0);
        size_of(&folder, "p.png")
    };
    assert_eq!(run(""), (202, 156));
    assert_eq!(run("--preview-close-up"), (202, 312));
    assert_eq!(run("--preview-widths 0.5,2,8,20"), (508, 156));
    let picture = image::open(folder.path("p.png")).unwrap().into_rgb8();
    let tiles: Vec<Vec<u8>> = (0..5)
        .map(|tile| {
            let tile = image::imageops::crop_imm(&picture, 102 * tile, 28, 100, 100);
            tile.to_image().into_raw()
        })
        .collect();
    let differ =
        |a: usize, b: usize| tiles[a].iter().zip(&tiles[b]).filter(|(a, b)| a != b).count();
    assert!(
        differ(0, 1) < differ(0, 2) && differ(0, 2) < differ(0, 3) && differ(0, 3) < differ(0, 4)
    );
    folder.run("a.obj -o x.obj --preview-size 100").exits(2);
    folder.run("a.obj -o x.obj --preview p.png --preview-widths 1,-1").exits(2);
}

#[test]
fn many_models_go_to_pages() {
    let folder = Folder::with(&[]);
    fs::create_dir(folder.path("in")).unwrap();
    for number in 0..26 {
        fs::write(folder.path(&format!("in/{number}.obj")), CUBE_OBJ).unwrap();
    }
    folder.run("in -o out --preview sheet.png --preview-size 40 --verify fast").exits(0);
    let row = 40 + 56 + 2;
    assert_eq!(size_of(&folder, "sheet.png"), (2 * 82 + 2, 12 * row - 2));
    assert_eq!(size_of(&folder, "sheet-2.png"), (82, 2 * row - 2));
    assert!(!folder.path("sheet-3.png").exists());
}

/// The colours of its materials: the top is blue.
#[test]
fn previews_show_materials() {
    let folder = Folder::with(&[("a.obj", CUBE_OBJ), ("cube.mtl", "newmtl top\nKd 0.1 0.2 1\n")]);
    folder.run("a.obj -o x.obj --preview p.png").exits(0);
    folder.run("a.obj -o x.glb --preview q.png").exits(0);
    folder.run("x.glb -o y.glb --preview r.png").exits(0);
    for name in ["p.png", "q.png", "r.png"] {
        let picture = image::open(folder.path(name)).unwrap().into_rgb8();
        let is_blue = |p: &&image::Rgb<u8>| p.0[2] > 100 && p.0[2] / 2 > p.0[0];
        let count = picture.pixels().filter(is_blue).count();
        assert!(count > 10_000, "{name}: {count}");
    }
}

/// A wall that faces the eye's side, red below and green above, in an .obj, a .glb and a .gltf.
#[test]
fn previews_show_textures() {
    let wall = "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n\
                vn 0 0 1\nusemtl m\nf 1/1/1 2/2/1 3/3/1 4/4/1\n";
    let folder = Folder::with(&[("a.obj", wall), ("a.mtl", "newmtl m\nmap_Kd halves.png\n")]);
    let halves = image::RgbImage::from_fn(8, 8, |_, y| {
        image::Rgb(if y < 4 { [0, 255, 0] } else { [255, 0, 0] })
    });
    halves.save(folder.path("halves.png")).unwrap();
    for (from, to) in [("a.obj", "b.glb"), ("b.glb", "c.gltf"), ("c.gltf", "d.gltf")] {
        folder.run(&format!("{from} -o {to} --preview p.png --preview-size 100")).exits(0);
        let picture = image::open(folder.path("p.png")).unwrap().into_rgb8();
        let pixel = |y: u32| picture.get_pixel(50, 28 + y).0;
        let (above, below) = (pixel(30), pixel(70));
        assert!(above[1] / 2 > above[0], "{from}: {above:?}");
        assert!(below[0] / 2 > below[1], "{from}: {below:?}");
    }
}

#[test]
fn the_demo_needs_no_file() {
    let folder = Folder::with(&[]);
    let run = folder.run("demo -o shown").exits(0);
    assert!(run.out().starts_with("model"), "{}", run.out());
    let files = folder.files();
    assert!(files.contains(&"shown/demo.png".into()), "{files:?}");
    let ending = |end: &str| files.iter().filter(|file| file.ends_with(end)).count();
    assert!(ending(".before.glb") > 0);
    assert_eq!(ending(".before.glb"), ending(".after.glb"));
}

#[test]
fn what_is_in_the_way_is_named_and_stays() {
    let folder = Folder::with(&[("a.obj", CUBE_OBJ), ("file", "kept")]);
    let run = folder.run("a.obj -o file/a.obj").exits(1);
    assert!(run.err().starts_with("a.obj: cannot create the folder file: "), "{}", run.err());
    fs::create_dir(folder.path("taken.obj")).unwrap();
    fs::create_dir(folder.path("taken.obj/a.obj")).unwrap();
    let run = folder.run("a.obj -o taken.obj").exits(1);
    assert!(run.err().contains("a folder is in the way"), "{}", run.err());
    assert_eq!(folder.files(), ["a.obj", "file"]);
}

#[cfg(unix)]
mod on_unix {
    use super::*;
    use std::os::unix::fs::PermissionsExt;
    use std::process::Stdio;

    #[test]
    fn a_read_only_folder_is_named() {
        let folder = Folder::with(&[("a.obj", CUBE_OBJ), ("locked/out.obj", "old")]);
        fs::set_permissions(folder.path("locked"), fs::Permissions::from_mode(0o555)).unwrap();
        let anyone_may_write = fs::write(folder.path("locked/probe"), "").is_ok();
        if anyone_may_write {
            eprintln!("SKIPPED: this user may write to read-only folders");
            return;
        }
        let run = folder.run("a.obj -o locked/out.obj").exits(1);
        assert!(run.err().contains("cannot write locked/out.obj: permission"), "{}", run.err());
        assert_eq!(folder.text("locked/out.obj"), "old");
    }

    #[test]
    fn a_full_disk_leaves_the_old_file() {
        let points: String = (0..3000).map(|n| format!("v {n} 0 0\n")).collect();
        let folder = Folder::with(&[("a.obj", &format!("{points}{CUBE_OBJ}")), ("b.obj", "old")]);
        // A limit on the size of files fails a write half way, as a full disk does.
        let script = format!(
            "trap '' XFSZ; ulimit -f 4; exec {} a.obj -o b.obj",
            env!("CARGO_BIN_EXE_chamfer")
        );
        let mut command = Command::new("sh");
        let run = Run(command.args(["-c", &script]).current_dir(folder.path("")).output().unwrap());
        let run = run.exits(1);
        assert!(run.err().starts_with("a.obj: cannot write b.obj: "), "{}", run.err());
        assert_eq!(folder.text("b.obj"), "old");
        assert_eq!(folder.files(), ["a.obj", "b.obj"]);
    }

    #[test]
    fn an_interrupt_exits_with_130_and_leaves_nothing() {
        let folder = Folder::with(&[]);
        let pipe = folder.path("endless.obj");
        assert!(Command::new("mkfifo").arg(&pipe).status().unwrap().success());
        let mut command = folder.command();
        command.args(["endless.obj", "-o", "out.obj"]).stdout(Stdio::null());
        let mut child = command.spawn().unwrap();
        // Opens once the child reads from the other end, and keeps it waiting.
        let writer = fs::OpenOptions::new().write(true).open(&pipe).unwrap();
        let kill = Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
        assert!(kill.success());
        assert_eq!(child.wait().unwrap().code(), Some(130));
        drop(writer);
        assert_eq!(folder.files(), ["endless.obj"]);
    }

    #[test]
    fn a_closed_pipe_is_no_failure() {
        let folder = Folder::with(&[("a.obj", CUBE_OBJ)]);
        let mut command = folder.command();
        let mut child = command.args(["a.obj"]).stdout(Stdio::piped()).spawn().unwrap();
        drop(child.stdout.take());
        assert_eq!(child.wait().unwrap().code(), Some(0));
    }
}

/// Each says what it is and what to do.
#[test]
fn files_that_are_no_models_are_named() {
    let pointer = "version https://git-lfs.github.com/spec/v1\noid sha256:00\nsize 12345\n";
    for (name, text, told) in [
        ("a.glb", pointer, "a Git LFS pointer, not a model: fetch the file itself"),
        ("a.stl", "", "the file is empty"),
        ("a.gltf", "<!DOCTYPE html><p>Not found", "a web page, not a model"),
        ("a.glb", "hello there", "neither a .glb nor the JSON of a .gltf"),
        ("a.blend", "BLENDER-v405", "open it in Blender and export glTF"),
        ("a.txt", "v 0 0 0", "unknown kind of file: give .glb,"),
    ] {
        let folder = Folder::with(&[(name, text)]);
        let run = folder.run(&format!("{name} -o out/")).exits(1);
        assert!(run.err().contains(told), "{name}: {}", run.err());
        assert_eq!(run.err().lines().count(), 1);
    }
}

#[test]
fn a_file_without_triangles_is_sound_on_both_ways() {
    let folder = Folder::with(&[("a.stl", "solid nothing\nendsolid nothing\n")]);
    let run = folder.run("a.stl -o a.glb").exits(0);
    assert!(run.err().contains("there are no triangles in it"), "{}", run.err());
    folder.run("check a.stl a.glb").exits(0);
}

/// A cube of six faces, of whose vertices each is so far off, along x.
fn loose_cube(first: usize, off: impl Fn(usize) -> f32) -> String {
    let mesh = chamfer::shapes::plain_cube(1.0);
    let points = mesh.positions.iter().enumerate();
    let points = points.map(|(v, [x, y, z])| format!("v {} {y} {z}\n", x + off(v)));
    let face = |corners: &[u32]| {
        let [a, b, c] = [0, 1, 2].map(|corner| first + corners[corner] as usize + 1);
        format!("f {a} {b} {c}\n")
    };
    points.chain(mesh.indices.chunks_exact(3).map(face)).collect()
}

/// One whose faces do not quite meet.
fn cracked_cube() -> String {
    loose_cube(0, |vertex| if vertex.is_multiple_of(2) { 1e-7 } else { 0.0 })
}

/// Copies lie on each other once they are welded, and four faces meet at each edge of the result: a
/// check that has not welded them finds two there at most, and says what may be.
#[test]
fn copies_that_were_welded_are_checked_as_such() {
    let copies = loose_cube(0, |_| 0.0) + &loose_cube(24, |vertex| (vertex % 3) as f32 * 5e-7);
    let folder = Folder::with(&[("a.obj", &copies), ("c.obj", &loose_cube(0, |_| 0.0))]);
    let run = folder.run("a.obj -o b.obj --weld auto").exits(0);
    assert!(run.out().contains("24 hard edges: 24 full"), "{}", run.out());
    let run = folder.run("check a.obj b.obj").exits(1);
    assert!(run.out().contains("chamfered with --weld, check it with the same"), "{}", run.out());
    folder.run("check a.obj b.obj --weld auto").exits(0);
    folder.run("c.obj -o d.obj").exits(0);
    let run = folder.run("check c.obj a.obj --width 0.1").exits(1);
    assert!(!run.out().contains("--weld"), "{}", run.out());
}

#[test]
fn vertices_that_nearly_touch_are_counted_or_welded() {
    let folder = Folder::with(&[("a.obj", &cracked_cube())]);
    let run = folder.run("a.obj -o b.obj").exits(0);
    assert!(run.err().contains("vertices are not where others are"), "{}", run.err());
    for weld in ["auto", "0.001"] {
        let run = folder.run(&format!("a.obj -o b.obj --weld {weld}")).exits(0);
        assert!(run.out().contains("12 hard edges: 12 full"), "{}", run.out());
        assert!(run.err().contains("were welded onto others"), "{}", run.err());
        folder.run(&format!("check a.obj b.obj --weld {weld}")).exits(0);
    }
}
