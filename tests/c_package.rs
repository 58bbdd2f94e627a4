//! The archive for C and C++: programs are built against it with CMake and with pkg-config, as its
//! users do.
#![cfg(unix)]

use std::env::consts::{DLL_PREFIX, DLL_SUFFIX};
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::LazyLock;

const ROOT: &str = env!("CARGO_MANIFEST_DIR");
const CUBE: &str = "24 vertices, 44 triangles\n";

fn run(command: &mut Command) -> String {
    let output = command.output().unwrap_or_else(|error| panic!("{command:?}: {error}"));
    let [printed, told] =
        [output.stdout, output.stderr].map(|text| String::from_utf8_lossy(&text).into_owned());
    assert!(output.status.success(), "{command:?}: {}\n{printed}{told}", output.status);
    printed
}

/// Whether a tool is there; says so, loudly, where it is not.
fn has(tool: &str) -> bool {
    let is_there = Command::new(tool).arg("--version").output().is_ok();
    if !is_there {
        // Not by eprintln, which the test runner keeps to itself.
        let line =
            format!("SKIPPED: no {tool}, so nothing is built with it from the archive for C\n");
        std::io::stderr().write_all(line.as_bytes()).unwrap();
    }
    is_there
}

fn empty(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    folder
}

/// The unpacked archive, of the library as cargo built it for these tests.
static UNPACKED: LazyLock<PathBuf> = LazyLock::new(|| {
    let folder = empty("c_package");
    let libraries = std::env::current_exe().unwrap().parent().unwrap().to_owned();
    assert!(libraries.join(format!("{DLL_PREFIX}chamfer{DLL_SUFFIX}")).is_file());
    let mut pack = Command::new("bash");
    pack.arg(Path::new(ROOT).join("scripts/package-c"));
    pack.arg("--libraries").arg(libraries).arg("--output").arg(&folder);
    let archive = run(&mut pack);
    run(Command::new("tar").arg("-C").arg(&folder).arg("-xzf").arg(archive.trim()));
    let name = Path::new(archive.trim()).file_name().unwrap().to_string_lossy().into_owned();
    folder.join(name.trim_end_matches(".tar.gz"))
});

#[test]
fn nothing_is_missing() {
    for path in [
        "include/chamfer.h",
        "lib/libchamfer.a",
        "lib/cmake/chamfer/chamfer-config.cmake",
        "lib/pkgconfig/chamfer.pc",
        "examples/chamfer_cube.c",
        "abi.md",
        "LICENSE-MIT",
        "LICENSE-APACHE",
        "THIRD-PARTY.md",
    ] {
        assert!(UNPACKED.join(path).is_file(), "{path}");
    }
    for template in ["lib/cmake/chamfer/chamfer-config.cmake", "lib/pkgconfig/chamfer.pc"] {
        let filled = fs::read_to_string(UNPACKED.join(template)).unwrap();
        assert!(!filled.contains("@VERSION@") && !filled.contains("@STATIC"), "{template}");
    }
}

/// Four programs: C and C++, each with the shared and the static library.
const CMAKE: &str = "cmake_minimum_required(VERSION 3.16)
project(user C CXX)
find_package(chamfer 0.1 REQUIRED)
set(CMAKE_CXX_STANDARD 20)
add_compile_options(-Wall -Wextra -Wpedantic -Werror)
foreach(kind chamfer static)
  add_executable(c_${kind} cube.c)
  add_executable(cpp_${kind} cube.cpp)
  set_target_properties(c_${kind} PROPERTIES C_STANDARD 99)
  target_link_libraries(c_${kind} PRIVATE chamfer::${kind})
  target_link_libraries(cpp_${kind} PRIVATE chamfer::${kind})
endforeach()
";

#[test]
fn cmake_finds_both_libraries() {
    if !has("cmake") {
        return;
    }
    let folder = empty("c_package_cmake");
    fs::write(folder.join("CMakeLists.txt"), CMAKE).unwrap();
    for name in ["cube.c", "cube.cpp"] {
        fs::copy(UNPACKED.join("examples/chamfer_cube.c"), folder.join(name)).unwrap();
    }
    let built = folder.join("built");
    let mut configure = Command::new("cmake");
    configure.arg("-S").arg(&folder).arg("-B").arg(&built);
    run(configure.arg(format!("-DCMAKE_PREFIX_PATH={}", UNPACKED.display())));
    run(Command::new("cmake").arg("--build").arg(&built));
    for program in ["c_chamfer", "cpp_chamfer", "c_static", "cpp_static"] {
        assert_eq!(run(&mut Command::new(built.join(program))), CUBE, "{program}");
    }
}

#[test]
fn pkg_config_finds_the_library() {
    if !has("pkg-config") {
        return;
    }
    let folder = empty("c_package_pkg_config");
    let mut ask = Command::new("pkg-config");
    ask.env("PKG_CONFIG_PATH", UNPACKED.join("lib/pkgconfig"));
    let flags = run(ask.args(["--cflags", "--libs", "chamfer"]));
    for (compiler, standard, language) in [("cc", "-std=c99", "c"), ("c++", "-std=c++20", "c++")] {
        let program = folder.join(compiler);
        let mut compile = Command::new(compiler);
        compile.args([standard, "-Wall", "-Wextra", "-Wpedantic", "-Werror", "-x", language]);
        compile.arg(UNPACKED.join("examples/chamfer_cube.c"));
        compile.args(["-x", "none", "-o"]).arg(&program).args(flags.split_whitespace());
        run(compile.arg(format!("-Wl,-rpath,{}", UNPACKED.join("lib").display())));
        assert_eq!(run(&mut Command::new(program)), CUBE, "{compiler}");
    }
}
