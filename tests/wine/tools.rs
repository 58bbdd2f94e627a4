//! The tools that build a Windows library and run it here.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::Command;

const ROOT: &str = env!("CARGO_MANIFEST_DIR");

/// Debian's names. Its Rust brings the source of the standard library, to build it for Windows.
const PACKAGES: [&str; 6] =
    ["wine64", "wine", "gcc-mingw-w64-x86-64", "rustc-web", "cargo-web", "rust-web-src"];

/// Tells what is not tested, and not by eprintln, which the test runner keeps to itself.
pub fn skip(why: &str) {
    std::io::stderr().write_all(format!("SKIPPED: {why}\n").as_bytes()).unwrap();
}

/// Makes sure that the tools are here, from Debian's packages if need be.
///
/// # Errors
/// Names what is missing.
pub fn require() -> Result<(), String> {
    if missing().is_some() && !install() {
        return Err(missing().map_or_else(|| "no packages".to_owned(), |tool| format!("no {tool}")));
    }
    missing().map_or(Ok(()), |tool| Err(format!("no {tool}")))
}

fn missing() -> Option<&'static str> {
    let runs =
        |name| Command::new(name).arg("--version").output().is_ok_and(|o| o.status.success());
    if !runs("x86_64-w64-mingw32-gcc") {
        return Some("mingw");
    }
    if !has_debian_rust() && !has_rustup_target() {
        return Some("Rust for Windows");
    }
    (!Path::new("/usr/bin/wine").exists()).then_some("wine")
}

/// Whether Debian's Rust is here, with its library's source, and new enough for this package.
fn has_debian_rust() -> bool {
    let output = Command::new("/usr/bin/rustc").arg("--version").output();
    let version = output.map_or_else(|_| Vec::new(), |output| output.stdout);
    let minor = |text: &str| text.split('.').nth(1).and_then(|minor| minor.parse::<u32>().ok());
    let has = minor(&String::from_utf8_lossy(&version));
    Path::new("/usr/lib/rustlib/src/rust/library").is_dir()
        && has >= minor(env!("CARGO_PKG_RUST_VERSION"))
}

fn has_rustup_target() -> bool {
    let installed = Command::new("rustup").args(["target", "list", "--installed"]).output();
    installed.is_ok_and(|o| String::from_utf8_lossy(&o.stdout).contains("x86_64-pc-windows-gnu"))
}

/// Tries Debian's packages, which need the rights of root, where whoever runs the tests asks for it.
fn install() -> bool {
    if std::env::var_os("CHAMFER_INSTALL").is_none() {
        return false;
    }
    // A registry that does not answer must not hold up the tests.
    let patience = ["-o", "Acquire::http::Timeout=20", "-o", "Acquire::Retries=1"];
    let apt = |arguments: &[&str]| {
        let output = Command::new("apt-get").args(patience).args(arguments).output();
        output.is_ok_and(|o| o.status.success())
    };
    let install = [&["install", "-y", "--no-install-recommends"][..], &PACKAGES].concat();
    // Lists that are old name old versions. Where they cannot be had anew, those that are there may
    // do.
    apt(&["update"]);
    apt(&install)
}

/// Builds the library that goes into the Unity package.
pub fn windows_library() -> PathBuf {
    let script = Path::new(ROOT).join("scripts/build");
    let output = Command::new("bash").arg(script).args(["library", "windows"]).output().unwrap();
    let complaint = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{complaint}");
    let printed = String::from_utf8(output.stdout).unwrap();
    Path::new(ROOT).join(printed.lines().last().unwrap())
}

/// Wine with a folder of its own, which it fills in the first run.
pub fn wine() -> Command {
    let mut command = Command::new("/usr/bin/wine");
    command.env("WINEPREFIX", Path::new(env!("CARGO_TARGET_TMPDIR")).join("wine"));
    command.env("WINEDEBUG", "-all").env("WINEDLLOVERRIDES", "mscoree,mshtml=");
    command
}
