//! The library for Windows, run by wine, gives the same bytes as that of this system.

#[path = "../support/raw_mesh.rs"]
mod raw_mesh;
mod tools;

use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use chamfer::{MeshBuffers, shapes};
use chamfer_formats as formats;
use chamfer_formats::ReadOptions;
use raw_mesh::Numbers;

const ROOT: &str = env!("CARGO_MANIFEST_DIR");
const CORPUS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../shared/corpus");

fn temporary(name: &str) -> PathBuf {
    Path::new(env!("CARGO_TARGET_TMPDIR")).join(name)
}

/// The real models in the order of their names; none where they are not there.
fn models() -> Vec<PathBuf> {
    let Ok(entries) = fs::read_dir(CORPUS) else {
        tools::skip(&format!("no {CORPUS}: no real model was compared"));
        return Vec::new();
    };
    let mut models: Vec<PathBuf> = entries.flatten().map(|entry| entry.path()).collect();
    models.sort();
    models
}

fn meshes_of(path: &Path) -> Vec<MeshBuffers> {
    let Ok(document) = formats::read(path, &ReadOptions::default()) else {
        return Vec::new();
    };
    document.meshes().iter().map(|source| source.mesh.clone()).collect()
}

/// The demo's meshes and those of the real models, in a file of plain numbers.
fn write_meshes(path: &Path) -> usize {
    let mut meshes: Vec<MeshBuffers> =
        shapes::demo_models().into_iter().map(|(_, mesh)| mesh).collect();
    meshes.extend(models().iter().flat_map(|path| meshes_of(path)));
    let mut file = Numbers::default();
    file.number(meshes.len());
    meshes.iter().for_each(|mesh| file.mesh(mesh));
    fs::write(path, file.bytes).unwrap();
    meshes.len()
}

/// Compiles a C file beside this one.
fn compile(compiler: &OsStr, source: &str, output: &Path, arguments: &[&str]) {
    let mut command = Command::new(compiler);
    command.args(["-std=gnu99", "-Wall", "-Wextra", "-Werror", "-I"]);
    command.arg(format!("{ROOT}/include")).arg(format!("{ROOT}/tests/wine/{source}"));
    command.arg("-o").arg(output).args(arguments);
    assert!(command.status().expect("a C compiler: install cc or set CC").success());
}

fn run(mut command: Command) {
    let output = command.output().unwrap();
    let complaint = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{command:?}: {}\n{complaint}", output.status);
}

fn through_this_system(meshes: &Path) -> Vec<u8> {
    let (program, result) = (temporary("through"), temporary("here.numbers"));
    let compiler = std::env::var_os("CC").unwrap_or("cc".into());
    compile(&compiler, "through.c", &program, &["-ldl"]);
    let library = std::env::current_exe().unwrap().with_file_name("libchamfer.so");
    let mut command = Command::new(program);
    command.arg(library).arg(meshes).arg(&result);
    run(command);
    fs::read(result).unwrap()
}

fn through_wine(library: &Path, meshes: &Path) -> Vec<u8> {
    let (program, result) = (temporary("through.exe"), temporary("wine.numbers"));
    let compiler = OsStr::new("x86_64-w64-mingw32-gcc");
    compile(compiler, "through.c", &program, &[]);
    let random = program.with_file_name("bcryptprimitives.dll");
    compile(compiler, "bcryptprimitives.c", &random, &["-shared", "-ladvapi32"]);
    // Windows looks beside the program; a path with slashes of the other kind would not do.
    fs::copy(library, program.with_file_name("chamfer.dll")).unwrap();
    let mut command = tools::wine();
    command.arg(program).arg("chamfer.dll").arg(meshes).arg(&result);
    run(command);
    fs::read(result).unwrap()
}

#[test]
fn the_windows_library_gives_the_same_bytes() {
    if cfg!(not(all(target_os = "linux", target_arch = "x86_64"))) {
        return tools::skip("wine is tried on Linux x86_64 only: no Windows library was run");
    }
    if let Err(missing) = tools::require() {
        return tools::skip(&format!("{missing}, so no Windows library was run"));
    }
    let library = tools::windows_library();
    let meshes = temporary("meshes.numbers");
    let count = write_meshes(&meshes);
    let [here, there] = [through_this_system(&meshes), through_wine(&library, &meshes)];
    let differs = here.iter().zip(&there).position(|(a, b)| a != b);
    assert_eq!(differs, None, "the first byte that differs, of {} meshes", count);
    assert_eq!(here.len(), there.len());
    println!("{count} meshes compared");
}
