//! The committed C header is the one that the sources make, compiles as every C and C++, and its
//! page lists its statuses.

use std::io::Write;
use std::path::Path;
use std::process::Command;
use std::{env, fs};

use chamfer::Reason;

const GENERATED: &str = concat!(env!("OUT_DIR"), "/chamfer.h");
const COMMITTED: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/include/chamfer.h");

#[test]
fn the_committed_header_is_up_to_date() {
    let generated = fs::read(GENERATED).unwrap();
    if env::var_os("CHAMFER_UPDATE_HEADER").is_some() {
        fs::write(COMMITTED, &generated).unwrap();
    }
    assert!(
        fs::read(COMMITTED).is_ok_and(|committed| committed == generated),
        "include/chamfer.h is not what src/ffi and cbindgen.toml make: look at the difference to \
         {GENERATED}, then run CHAMFER_UPDATE_HEADER=1 cargo test --test header"
    );
}

#[test]
fn the_page_lists_every_status() {
    let page = include_str!("../docs/abi.md");
    for line in include_str!("../include/chamfer.h").lines() {
        let Some(define) = line.strip_prefix("#define CHAMFER_STATUS_") else { continue };
        let (name, number) = define.split_once(' ').unwrap();
        let row = format!("| {number} | `{name}` |");
        assert!(page.contains(&row), "docs/abi.md lacks a row that starts with {row}");
    }
}

#[test]
fn reasons_are_those_of_the_library() {
    let header = include_str!("../include/chamfer.h");
    let reasons = header.lines().filter_map(|line| line.strip_prefix("#define CHAMFER_REASON_"));
    let defined: Vec<&str> = reasons.filter(|define| !define.starts_with("SLOTS ")).collect();
    let define = |reason: &Reason| format!("{} {}", reason.name().to_uppercase(), *reason as u32);
    assert_eq!(defined, Reason::ALL.iter().map(define).collect::<Vec<_>>());
}

/// Twice the header, everything that it declares unused, and one constant and one call: what a
/// language takes amiss in a macro shows where that is used.
const UNIT: &str = "#include \"chamfer.h\"\n#include \"chamfer.h\"\n\
    #ifdef STANDS_IN\n\
    uint32_t chamfer_abi_version(void) { return CHAMFER_ABI_VERSION; }\n\
    #endif\n\
    uint32_t of_header(void);\n\
    uint32_t of_header(void) { return chamfer_abi_version() + CHAMFER_NO_ELEMENT; }\n";

/// Compiles [`UNIT`] to assembly; none, and loudly so, without the compiler.
fn compile(name: &str, compiler: &str, flags: &[&str]) -> Option<String> {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let unit = folder.join(name);
    fs::write(&unit, UNIT).unwrap();
    let assembly = unit.with_extension("s");
    let mut compile = Command::new(compiler);
    compile.args(flags).args(["-Wall", "-Wextra", "-pedantic", "-Werror", "-S", "-I"]);
    compile
        .arg(concat!(env!("CARGO_MANIFEST_DIR"), "/include"))
        .arg(&unit)
        .arg("-o")
        .arg(&assembly);
    match compile.status() {
        Ok(status) => assert!(status.success(), "{compile:?}"),
        Err(error) => {
            // Not by eprintln, which the test runner keeps to itself.
            let line =
                format!("SKIPPED: no {compiler} ({error}), so it does not read the header\n");
            std::io::stderr().write_all(line.as_bytes()).unwrap();
            return None;
        }
    }
    Some(fs::read_to_string(assembly).unwrap())
}

#[test]
fn the_header_is_clean_c() {
    let compiler = env::var("CC").unwrap_or("cc".to_owned());
    for standard in ["-std=c89", "-std=c99", "-std=c11"] {
        compile(&format!("unit{standard}.c"), &compiler, &[standard]);
    }
}

#[test]
fn the_header_is_clean_cpp() {
    let compiler = env::var("CXX").unwrap_or("c++".to_owned());
    for standard in ["-std=c++98", "-std=c++11", "-std=c++17"] {
        compile(&format!("unit{standard}.cpp"), &compiler, &[standard]);
    }
}

/// Without the word, calls go through a stub; with it, straight through the table of imports.
#[test]
fn windows_imports_from_the_dll_where_asked() {
    let compiler = "x86_64-w64-mingw32-gcc";
    let dll = compile("imports.c", compiler, &["-std=c89", "-DCHAMFER_DLL"]);
    let plain = compile("stubs.c", compiler, &["-std=c89"]);
    if let (Some(dll), Some(plain)) = (dll, plain) {
        assert!(dll.contains("__imp_chamfer_abi_version"), "{dll}");
        assert!(!plain.contains("__imp_"), "{plain}");
    }
}

/// A DLL of the caller's own that defines these functions exports them.
#[test]
fn windows_exports_where_asked() {
    let exports =
        compile("exports.c", "x86_64-w64-mingw32-gcc", &["-DCHAMFER_EXPORTS", "-DSTANDS_IN"]);
    if let Some(exports) = exports {
        assert!(
            exports.contains("-export:") && exports.contains("chamfer_abi_version"),
            "{exports}"
        );
    }
}

/// Where whoever includes it hides all that is not marked, the library's functions are found.
#[cfg(target_os = "linux")]
#[test]
fn functions_are_visible_where_others_are_hidden() {
    let compiler = env::var("CC").unwrap_or("cc".to_owned());
    let flags = ["-fvisibility=hidden", "-DSTANDS_IN"];
    if let Some(assembly) = compile("visible.c", &compiler, &flags) {
        assert!(assembly.contains(".hidden\tof_header"), "{assembly}");
        assert!(!assembly.contains(".hidden\tchamfer_abi_version"), "{assembly}");
    }
}
