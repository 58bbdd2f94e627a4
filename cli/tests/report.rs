//! What a run tells: on the terminal, and in its report.

#[path = "support/folder.rs"]
mod folder;
#[path = "support/run.rs"]
mod run;
#[path = "support/schema.rs"]
mod schema;

use std::fs;

use chamfer::{MeshBuffers, shapes};
use chamfer_formats::glb;
use serde_json::Value;

use folder::Folder;

const BROKEN: &str = "v 0 0 0\nf 1 2 3\n";

fn write(folder: &Folder, name: &str, mesh: &MeshBuffers) {
    let path = folder.path(name);
    fs::create_dir_all(path.parent().unwrap()).unwrap();
    fs::write(path, glb::encode("part", mesh, &[], &[]).unwrap()).unwrap();
}

/// A box a hundredth high: its chamfers are narrower than asked for.
fn slab() -> MeshBuffers {
    let mut slab = shapes::plain_cube(1.0);
    slab.positions.iter_mut().for_each(|position| position[1] *= 0.01);
    slab
}

/// A hundredth thick on two axes.
fn rod() -> MeshBuffers {
    let mut rod = slab();
    rod.positions.iter_mut().for_each(|position| position[2] *= 0.01);
    rod
}

fn smooth_cube() -> MeshBuffers {
    let mut cube = shapes::plain_cube(1.0);
    for (normal, position) in cube.normals.iter_mut().zip(&cube.positions) {
        *normal = position.map(|at| at.signum() / 3f32.sqrt());
    }
    cube
}

/// A card of two sides with hard edges between two halves that stand at an angle.
fn card() -> MeshBuffers {
    let mut card = shapes::plain_cube(1.0);
    card.positions.iter_mut().for_each(|position| position[1] = 0.0);
    card
}

#[track_caller]
fn conforms(report: &Value) {
    let text = include_str!("../../docs/report.schema.json");
    let schema: Value = serde_json::from_str(text).unwrap();
    let errors = schema::errors(&schema, report);
    assert!(errors.is_empty(), "{errors:#?}");
}

#[test]
fn reports_are_what_the_schema_says() {
    let folder = Folder::with(&[("in/broken.obj", BROKEN), ("in/flat.obj", "v 0 0 0\n")]);
    write(&folder, "in/cube.glb", &shapes::plain_cube(1.0));
    write(&folder, "in/slab.glb", &slab());
    write(&folder, "in/card.glb", &card());
    folder.run("in -o out --report plain.json").exits(1);
    folder.run(
        "in -o out --report full.json --report-edges --width 0.1 --weld auto --compress meshopt \
         --chamfer-submesh 0 --verify fast",
    );
    for name in ["plain.json", "full.json"] {
        let report = folder.json(name);
        assert_eq!(report["files"].as_array().unwrap().len(), 5);
        conforms(&report);
    }
    let options = &folder.json("full.json")["options"];
    let option = |name: &str| options[name].as_str().unwrap().to_owned();
    assert_eq!(options["width"], 0.1);
    assert_eq!((option("width_unit"), option("verify")), ("scene".into(), "fast".into()));
    assert_eq!((option("weld"), option("chamfer_submesh")), ("auto".into(), "0".into()));
    assert_eq!(folder.json("plain.json")["options"]["width_unit"], "percent");
    assert_eq!(folder.json("plain.json")["chamfer"], env!("CARGO_PKG_VERSION"));
}

#[test]
fn one_word_is_used_for_full() {
    let folder = Folder::with(&[]);
    write(&folder, "cube.glb", &shapes::plain_cube(1.0));
    let run = folder.run("cube.glb -o out.glb --report r.json --report-edges").exits(0);
    let line = "cube.glb -> out.glb: 12 hard edges: 12 full; 12 -> 44 triangles; ";
    assert!(run.out().starts_with(line), "{}", run.out());
    let report = folder.json("r.json");
    assert_eq!(report["totals"]["full"], 12);
    assert!((report["totals"]["mean_width"].as_f64().unwrap() - 1.0).abs() < 1e-5);
    let mesh = &report["files"][0]["meshes"][0];
    assert_eq!((&mesh["full"], &mesh["edges"][0]["outcome"]), (&12.into(), &"full".into()));
    assert!(!run.out().contains("chamfered") && !report.to_string().contains("\"chamfered\""));
}

#[test]
fn a_batch_ends_with_one_line_of_all() {
    let folder = Folder::with(&[("in/broken.obj", BROKEN)]);
    write(&folder, "in/cube.glb", &shapes::plain_cube(1.0));
    write(&folder, "in/slab.glb", &slab());
    let run = folder.run("in -o out").exits(1);
    let last = run.out().lines().last().unwrap().to_owned();
    assert!(
        last.starts_with("3 files, 1 failed: 24 hard edges: 16 full, 8 narrowed (mean 0."),
        "{last}"
    );
    assert!(last.contains("; 24 -> 88 triangles; ") && last.ends_with(" s"), "{last}");
    assert_eq!(run.out().lines().count(), 3);
}

#[test]
fn quiet_says_only_what_went_wrong_and_verbose_tells_of_meshes() {
    let folder = Folder::with(&[("in/broken.obj", BROKEN)]);
    write(&folder, "in/slab.glb", &slab());
    let run = folder.run("in -o out --quiet").exits(1);
    assert_eq!(run.out(), "");
    assert_eq!(run.err(), "in/broken.obj: line 2: vertex 2 of 1 that the file has\n");
    let run = folder.run("in -o out --verbose").exits(1);
    let line = run.out().lines().find(|line| line.starts_with("  part: ")).unwrap().to_owned();
    assert!(line.starts_with("  part: 12 hard edges: 4 full, 8 narrowed (mean 0."), "{line}");
    folder.run("in -o out --quiet --verbose").exits(2);
}

#[test]
fn nothing_to_chamfer_says_why() {
    let folder = Folder::with(&[
        ("bent.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 -1 .2\nf 1 2 3\nf 2 1 4\n"),
        ("flat.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n"),
        ("group.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\ns 1\nf 1 2 3\nf 2 1 4\n"),
    ]);
    write(&folder, "smooth.glb", &smooth_cube());
    write(&folder, "card.glb", &card());
    for (name, told) in [
        ("smooth.glb", "faces meet at up to 90 degrees, but all its normals are smooth there"),
        ("bent.obj", "faces meet at up to 11 degrees, but it came without normals"),
        ("group.obj", "up to 90 degrees, but its smoothing groups shade all of it as one"),
        ("flat.obj", "it has no hard edges: no two faces meet at an angle"),
        ("card.glb", "none of its hard edges is chamfered: "),
    ] {
        let run = folder.run(&format!("{name} -o out/")).exits(0);
        assert!(run.err().contains(told), "{name}: {}", run.err());
        assert_eq!(run.err().lines().count(), 1, "{}", run.err());
    }
    let run = folder.run("card.glb -o out/").exits(0);
    assert!(run.err().contains("zero_thickness 4; its faces lie back to back"), "{}", run.err());
}

#[test]
fn a_model_far_under_its_width_is_warned_of() {
    let folder = Folder::with(&[]);
    write(&folder, "rod.glb", &rod());
    let run = folder.run("rod.glb -o out.glb --width 0.1").exits(0);
    assert!(
        run.err().contains("% of the width asked for on average, under a third"),
        "{}",
        run.err()
    );
    let run = folder.run("rod.glb -o out.glb --width 0.002").exits(0);
    assert_eq!(run.err(), "");
}

#[cfg(unix)]
#[test]
fn an_interrupt_says_what_is_done_and_writes_the_report() {
    use std::process::{Command, Stdio};
    let folder = Folder::with(&[]);
    for name in ["a.glb", "b.glb"] {
        write(&folder, name, &shapes::plain_cube(1.0));
    }
    let pipe = folder.path("endless.obj");
    assert!(Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    let mut command = folder.command();
    command.args("endless.obj a.glb b.glb -o out --threads 2 --report r.json".split(' '));
    let child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    let writer = fs::OpenOptions::new().write(true).open(&pipe).unwrap();
    while !folder.path("out/b.glb").exists() {
        std::thread::sleep(std::time::Duration::from_millis(5));
    }
    assert!(
        Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap().success()
    );
    let run = run::Run(child.wait_with_output().unwrap()).exits(130);
    drop(writer);
    let last = run.out().lines().last().unwrap().to_owned();
    assert!(last.starts_with("interrupted: 2 of 3 files done: 24 hard edges: 24 full"), "{last}");
    let report = folder.json("r.json");
    conforms(&report);
    assert_eq!((&report["interrupted"], &report["totals"]["files"]), (&true.into(), &2.into()));
    assert_eq!(
        folder.files(),
        ["a.glb", "b.glb", "endless.obj", "out/a.glb", "out/b.glb", "r.json"]
    );
}
