//! The Python package, with the library that cargo made beside these tests.

#[path = "../support/layout.rs"]
mod layout;

use std::collections::BTreeSet;
use std::env::consts::{DLL_PREFIX, DLL_SUFFIX};
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::{LazyLock, Mutex};

const ROOT: &str = env!("CARGO_MANIFEST_DIR");
const CUBE: &str = "24 vertices, 44 triangles\n12 of 12 hard edges full\n";

#[test]
fn the_example_chamfers_a_cube() {
    if let Some(python) = python() {
        assert_eq!(run(from_source(&python).arg("examples/python/chamfer_cube.py")), CUBE);
    }
}

#[test]
fn the_module_does_what_tools_rely_on() {
    if let Some(python) = python() {
        let printed = run(from_source(&python).arg("tests/python/uses.py"));
        assert_eq!(printed, "all as it should be\n");
    }
}

/// All of them and all their fields: a struct that grew in C must grow here.
#[test]
fn structs_lie_in_memory_as_in_c() {
    let Some(python) = python() else { return };
    let printed = run(from_source(&python).arg("tests/python/layout.py"));
    let here: BTreeSet<&str> = printed.lines().collect();
    // Held places are rows of an array there.
    let in_c = layout::of_header().lines().filter(|line| !line.starts_with("chamfer_held"));
    assert_eq!(here, in_c.collect());
}

#[test]
fn meshes_of_trimesh_are_chamfered() {
    if let Some(python) = python_with("trimesh") {
        let printed = run(from_source(&python).arg("examples/python/with_trimesh.py"));
        assert_eq!(printed, "12 -> 44 triangles, volume 8.00 -> 7.89\ntexture of 24 vertices\n");
    }
}

#[test]
fn types_are_told_and_right() {
    if let Some(python) = python_with("mypy") {
        let cache = Path::new(env!("CARGO_TARGET_TMPDIR")).join("mypy");
        let mut mypy = from_source(&python);
        mypy.args(["-m", "mypy", "--strict", "--cache-dir"]).arg(cache);
        mypy.args(["python/src/chamfer", "tests/python/typed.py"]);
        assert!(run(&mut mypy).starts_with("Success"));
    }
}

/// Any Python takes it, and it needs nothing from outside.
#[test]
fn a_wheel_has_the_library_inside() {
    let Some(python) = python_with("hatchling") else { return };
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("wheel");
    drop(fs::remove_dir_all(&folder));
    fs::create_dir_all(&folder).unwrap();
    let mut pip = from_source(&python);
    pip.args(["-m", "pip", "wheel", "--quiet", "--no-deps", "--no-build-isolation", "--wheel-dir"]);
    run(pip.arg(&folder).arg("./python"));
    let wheel = fs::read_dir(&folder).unwrap().next().unwrap().unwrap().path();
    let name = wheel.file_name().unwrap().to_string_lossy().into_owned();
    let start = format!("chamfer-{}-py3-none-", env!("CARGO_PKG_VERSION"));
    assert!(name.starts_with(&start) && !name.contains("any"), "{name}");
    let installed = folder.join("installed");
    let mut pip = Command::new(&python);
    pip.args(["-m", "pip", "install", "--quiet", "--no-deps", "--target"]).arg(&installed);
    run(pip.arg(&wheel));
    let mut example = Command::new(&python);
    example.current_dir(ROOT).env_remove("CHAMFER_LIBRARY").env("PYTHONPATH", installed);
    assert_eq!(run(example.arg("examples/python/chamfer_cube.py")), CUBE);
}

/// A Python that finds the package in this checkout, and the library where cargo put it.
fn from_source(python: &Path) -> Command {
    let library =
        std::env::current_exe().unwrap().with_file_name(format!("{DLL_PREFIX}chamfer{DLL_SUFFIX}"));
    let mut command = Command::new(python);
    command.current_dir(ROOT).arg("-B").env("CHAMFER_LIBRARY", library);
    command.env("PYTHONPATH", Path::new(ROOT).join("python/src"));
    command
}

fn run(command: &mut Command) -> String {
    let output = command.output().unwrap();
    let [printed, told] =
        [output.stdout, output.stderr].map(|text| String::from_utf8_lossy(&text).into_owned());
    assert!(output.status.success(), "{command:?}: {}\n{printed}{told}", output.status);
    printed.replace("\r\n", "\n")
}

/// A Python of our own with numpy; none, and loudly so, where that cannot be had.
fn python() -> Option<PathBuf> {
    python_with("numpy")
}

/// The same with another package.
fn python_with(package: &str) -> Option<PathBuf> {
    static PYTHON: LazyLock<Result<PathBuf, &str>> = LazyLock::new(make_python);
    static INSTALLING: Mutex<()> = Mutex::new(());
    let _one_at_a_time = INSTALLING.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
    let installed = PYTHON.as_ref().map_err(|&why| why.to_owned()).and_then(|python| {
        let has = install(python, "numpy") && install(python, package);
        has.then(|| python.clone()).ok_or(format!("pip cannot install {package}"))
    });
    if let Err(why) = &installed {
        let line = format!("SKIPPED: {why}, so a part of the Python package is untested\n");
        std::io::stderr().write_all(line.as_bytes()).unwrap();
    }
    installed.ok()
}

fn make_python() -> Result<PathBuf, &'static str> {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("python");
    let (system, own) =
        if cfg!(windows) { ("python", "Scripts/python.exe") } else { ("python3", "bin/python") };
    let python = folder.join(own);
    let is_there = succeeds(Command::new(&python).arg("--version"));
    if is_there || succeeds(Command::new(system).args(["-m", "venv"]).arg(&folder)) {
        return Ok(python);
    }
    Err("no Python that can make an environment (python3 with venv)")
}

fn install(python: &Path, package: &str) -> bool {
    succeeds(Command::new(python).args(["-c", &format!("import {package}")]))
        || succeeds(Command::new(python).args(["-m", "pip", "install", "--quiet", package]))
}

fn succeeds(command: &mut Command) -> bool {
    command.output().is_ok_and(|output| output.status.success())
}
