//! The examples, run as the README says. Those in C are run by `tests/ffi`, those in C# by
//! `tests/unity`, those in Python by `tests/python`.

use std::env::consts::{DLL_PREFIX, DLL_SUFFIX, EXE_EXTENSION};
use std::path::{Path, PathBuf};
use std::process::Command;

const ROOT: &str = env!("CARGO_MANIFEST_DIR");

fn run(command: &mut Command) -> String {
    let output = command.output().unwrap();
    let [printed, told] =
        [output.stdout, output.stderr].map(|text| String::from_utf8_lossy(&text).into_owned());
    assert!(output.status.success(), "{command:?}: {}\n{printed}{told}", output.status);
    printed.replace("\r\n", "\n")
}

#[test]
fn the_rust_example_chamfers_a_cube() {
    let mut example = built_example().map(Command::new).unwrap_or_else(|| {
        let mut cargo = Command::new(env!("CARGO"));
        cargo.current_dir(ROOT).args(["run", "--quiet", "--locked", "--example", "chamfer_cube"]);
        cargo
    });
    assert_eq!(run(&mut example), "24 vertices, 44 triangles\n12 of 12 hard edges full\n");
}

/// The example as `cargo test` builds it along with all tests; none where only some of them are
/// run, or it is of an older library.
fn built_example() -> Option<PathBuf> {
    let folder = library().parent()?.with_file_name("examples");
    let example = folder.join("chamfer_cube").with_extension(EXE_EXTENSION);
    let built = |path: &Path| path.metadata().and_then(|file| file.modified()).ok();
    (built(&example)? >= built(&library())?).then_some(example)
}

/// Where cargo put the library for these tests: beside their executable.
fn library() -> PathBuf {
    let name = format!("{DLL_PREFIX}chamfer{DLL_SUFFIX}");
    std::env::current_exe().unwrap().with_file_name(name)
}
