//! The examples, run as the README says. Those in C are run by `tests/ffi`, those in C# by
//! `tests/unity`.

use std::env::consts::{DLL_PREFIX, DLL_SUFFIX, EXE_EXTENSION};
use std::io::Write;
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

#[test]
fn the_python_example_chamfers_a_cube() {
    if let Some(python) = python() {
        assert_eq!(
            run_python(&python, "examples/python/chamfer_cube.py"),
            "24 vertices, 44 triangles\n12 of 12 hard edges full\n"
        );
    }
}

#[test]
fn the_python_module_does_what_tools_rely_on() {
    if let Some(python) = python() {
        assert_eq!(run_python(&python, "tests/python/uses.py"), "all as it should be\n");
    }
}

/// Runs a script that finds the module, and the library as its argument.
fn run_python(python: &Path, script: &str) -> String {
    let root = Path::new(ROOT);
    let mut command = Command::new(python);
    command.arg("-B").arg(root.join(script)).arg(library());
    run(command.env("PYTHONPATH", root.join("examples/python")))
}

/// Where cargo put the library for these tests: beside their executable.
fn library() -> PathBuf {
    let name = format!("{DLL_PREFIX}chamfer{DLL_SUFFIX}");
    std::env::current_exe().unwrap().with_file_name(name)
}

/// A Python of our own with numpy; none, and loudly so, where that cannot be had.
fn python() -> Option<PathBuf> {
    static PYTHON: std::sync::LazyLock<Option<PathBuf>> = std::sync::LazyLock::new(|| {
        let made = make_python();
        if let Err(why) = &made {
            let line = format!("SKIPPED: {why}, so the Python example is untested\n");
            std::io::stderr().write_all(line.as_bytes()).unwrap();
        }
        made.ok()
    });
    PYTHON.clone()
}

fn make_python() -> Result<PathBuf, &'static str> {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("python");
    let (system, own) =
        if cfg!(windows) { ("python", "Scripts/python.exe") } else { ("python3", "bin/python") };
    let python = folder.join(own);
    let succeeds = |command: &mut Command| command.output().is_ok_and(|o| o.status.success());
    if succeeds(Command::new(&python).args(["-c", "import numpy"])) {
        return Ok(python);
    }
    if !succeeds(Command::new(system).args(["-m", "venv"]).arg(&folder)) {
        return Err("no Python that can make an environment (python3 with venv)");
    }
    if !succeeds(Command::new(&python).args(["-m", "pip", "install", "--quiet", "numpy"])) {
        return Err("pip cannot install numpy");
    }
    Ok(python)
}
