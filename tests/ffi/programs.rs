//! C programs, compiled strictly against the header and linked to the built library.

use std::collections::BTreeSet;
use std::env;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::library;

const ROOT: &str = env!("CARGO_MANIFEST_DIR");
const STRICT: [&str; 4] = ["-Wall", "-Wextra", "-pedantic", "-Werror"];

fn source(path: &str) -> PathBuf {
    Path::new(ROOT).join(path)
}

fn compiler() -> Command {
    let mut command = Command::new(env::var_os("CC").unwrap_or("cc".into()));
    command.args(STRICT).arg("-I").arg(source("include"));
    command
}

/// Compiles a C99 program, runs it, and returns what it printed.
fn run(name: &str, sources: &[&str]) -> String {
    let program = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let library = library::path();
    let mut compile = compiler();
    compile.arg("-std=c99").args(sources.iter().map(|path| source(path))).arg(&library);
    let folder = library.parent().unwrap().display().to_string();
    compile.arg(format!("-Wl,-rpath,{folder}")).args(["-lm", "-pthread", "-o"]).arg(&program);
    let status = compile.status().expect("a C compiler: install cc or set CC");
    assert!(status.success(), "{compile:?}");

    let output = Command::new(&program).output().unwrap();
    let [printed, told] =
        [output.stdout, output.stderr].map(|text| String::from_utf8(text).unwrap());
    assert!(output.status.success(), "{name}: {}\n{printed}{told}", output.status);
    printed
}

#[test]
fn a_c_program_chamfers_a_cube() {
    assert_eq!(run("cube", &["tests/c/cube.c", "tests/c/twice.c"]), "0 failures\n");
}

#[test]
fn the_example_chamfers_a_cube() {
    let printed = run("chamfer_cube", &["examples/c/chamfer_cube.c"]);
    assert_eq!(printed, "24 vertices, 44 triangles\n");
}

/// It is what readers of the README copy into programs of theirs.
#[test]
fn the_example_is_cpp_too() {
    let mut compile = Command::new(env::var_os("CXX").unwrap_or("c++".into()));
    compile.args(STRICT).args(["-std=c++20", "-fsyntax-only", "-x", "c++"]);
    compile.arg("-I").arg(source("include")).arg(source("examples/c/chamfer_cube.c"));
    let status = compile.status().expect("a C++ compiler: install c++ or set CXX");
    assert!(status.success(), "{compile:?}");
}

/// Rows of the table that nobody can try: the library has no known fault, and what is undefined has
/// no outcome.
const UNTRIED: [&str; 2] = [
    "a fault of the library itself | `INTERNAL`",
    "a result used after it was destroyed, or destroyed twice | undefined, as with `free`",
];

/// The table of misuse in docs/abi.md: what is wrong, and what that leads to, without remarks.
fn rows_of_the_page() -> BTreeSet<String> {
    let page = include_str!("../../docs/abi.md");
    let table = page.split_once("\n| misuse | status |\n|---|---|\n").expect("the table").1;
    let rows = table.lines().take_while(|line| line.starts_with('|'));
    let outcome = |row: &str| row.split_once(": ").map_or(row, |(outcome, _)| outcome).to_owned();
    rows.map(|row| outcome(row.trim_matches(['|', ' ']))).collect()
}

#[cfg(target_os = "linux")]
#[test]
fn misuse_leads_to_what_the_page_says() {
    let mut printed = run("misuse", &["tests/c/misuse.c"]);
    printed += &run("scarce", &["tests/c/scarce.c"]);
    let tried = printed.lines().map(str::to_owned).chain(UNTRIED.map(str::to_owned));
    assert_eq!(tried.collect::<BTreeSet<_>>(), rows_of_the_page());
}

#[cfg(target_os = "linux")]
#[test]
fn many_calls_leave_no_memory_behind() {
    assert_eq!(run("many", &["tests/c/many.c"]), "10000 calls\n");
}
