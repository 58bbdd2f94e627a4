//! Segments, by number and by how many triangles they may take.

#[path = "support/folder.rs"]
mod folder;
#[path = "support/run.rs"]
mod run;

use std::fs;

use chamfer::shapes;
use chamfer_formats::glb;
use folder::Folder;

/// A folder with a cube: with n segments it has 12 + 24 n + 8 n^2 triangles.
fn with_cube() -> Folder {
    let folder = Folder::with(&[]);
    let cube = glb::encode("cube", &shapes::plain_cube(1.0), &[], &[]).unwrap();
    fs::write(folder.path("a.glb"), cube).unwrap();
    folder
}

#[test]
fn a_dry_run_tells_what_would_come_out_and_writes_nothing() {
    let folder = with_cube();
    let told = folder.run("a.glb -o b.glb --segments 3 --dry-run").exits(0).err();
    assert!(told.contains("not written: 156 triangles, 80 vertices"), "{told}");
    assert!(!folder.path("b.glb").exists());
    folder.run("a.glb -o b.glb --segments 3").exits(0);
    assert!(folder.path("b.glb").exists());
}

#[test]
fn as_many_segments_as_triangles_allow() {
    let folder = with_cube();
    let told = |options: &str| folder.run(&format!("a.glb -o b.glb {options}")).exits(0).err();
    for (most, expected) in [
        ("--max-triangles 155", "2 segments, 92 triangles: within 155"),
        ("--max-triangles 156", "3 segments, 156 triangles: within 156"),
        ("--max-triangles 156 --segments 2", "2 segments, 92 triangles: within 156"),
        ("--max-triangles 44", "1 segment, 44 triangles: within 44"),
        ("--max-triangles 43", "with one segment there are 44 triangles, more than 43"),
    ] {
        assert!(told(most).contains(expected), "{most}: {}", told(most));
    }
}

#[test]
fn segments_and_profile_have_their_ranges() {
    let folder = with_cube();
    for wrong in ["--segments 0", "--segments 33", "--profile 1.5", "--profile -1"] {
        folder.run(&format!("a.glb -o b.glb {wrong}")).exits(2);
    }
    let options = folder.run("--print-options --segments 3 --profile 0.25").exits(0).out();
    assert!(options.contains("segments = 3\nprofile = 0.25\n"), "{options}");
}
