//! The Unity package, compiled against stand-ins of Unity's API and run on Mono with the real library.

mod carried;
mod glb;
mod layout;
mod mono;
mod packing;
mod players;
#[path = "../support/raw_mesh.rs"]
mod raw_mesh;

#[test]
fn the_package_passes_its_tests() {
    let Some(program) = mono::program() else { return };
    let printed = program.run(&[]);
    assert!(printed.ends_with(" passed, 0 failed\n"), "{printed}");
}

#[test]
fn structs_lie_in_memory_as_in_c() {
    let Some(program) = mono::program() else { return };
    let in_c = layout::of_header();
    for line in program.run(&["layout"]).lines() {
        assert!(in_c.lines().any(|other| other == line), "C# has {line}, C has\n{in_c}");
    }
}

/// Every field counts: a struct that grew in C must grow in C#.
#[test]
fn structs_have_all_fields_of_the_header() {
    let Some(program) = mono::program() else { return };
    let in_c_sharp = program.run(&["layout"]);
    for line in layout::of_header().lines() {
        let name = line.split(['.', ' ']).next().unwrap();
        if in_c_sharp.contains(&format!("{name} ")) {
            assert!(in_c_sharp.lines().any(|other| other == line), "C# lacks {line}");
        }
    }
}
