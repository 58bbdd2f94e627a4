//! The Unity package is complete, and agrees with the library and its header.

use std::collections::BTreeSet;
use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};

const PACKAGE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/unity-package");
const HEADER: &str = include_str!("../include/chamfer.h");
const MOST_LINES: usize = 250;

fn package() -> &'static Path {
    Path::new(PACKAGE)
}

/// Everything below the package's folder that Unity imports, metas included.
fn imported() -> Vec<PathBuf> {
    let mut found = Vec::new();
    let mut folders = vec![package().to_owned()];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            let name = path.file_name().unwrap().to_string_lossy().into_owned();
            if name.ends_with('~') || name.starts_with('.') {
                continue;
            }
            if path.is_dir() {
                folders.push(path.clone());
            }
            found.push(path);
        }
    }
    found
}

fn with_extension(extension: &str) -> Vec<PathBuf> {
    let mut paths = imported();
    paths.retain(|path| path.extension() == Some(OsStr::new(extension)));
    assert!(!paths.is_empty(), "no .{extension}");
    paths
}

fn read(path: impl AsRef<Path>) -> String {
    fs::read_to_string(package().join(path)).unwrap()
}

/// The library that a meta belongs to, which is built and not committed.
fn is_library(path: &Path) -> bool {
    path.starts_with(package().join("Runtime/Plugins")) && path.extension().is_some()
}

#[test]
fn every_file_and_folder_has_its_meta() {
    for path in imported() {
        if path.extension() == Some(OsStr::new("meta")) {
            let of = path.with_extension("");
            assert!(of.exists() || is_library(&of), "{} is of nothing", path.display());
        } else {
            let meta = PathBuf::from(format!("{}.meta", path.display()));
            assert!(meta.is_file(), "{} has none: run scripts/unity-meta", path.display());
        }
    }
}

#[test]
fn guids_are_unique() {
    let mut seen = BTreeSet::new();
    for meta in with_extension("meta") {
        let text = read(&meta);
        let guid = text.lines().find_map(|line| line.strip_prefix("guid: ")).unwrap().to_owned();
        let is_hex = |c: char| c.is_ascii_digit() || ('a'..='f').contains(&c);
        assert!(guid.len() == 32 && guid.chars().all(is_hex), "{}: {guid}", meta.display());
        assert!(seen.insert(guid), "{} has the guid of another", meta.display());
    }
}

/// What a plugin's meta switches on: the names of platforms, and the editor's system.
fn enabled(meta: &str) -> Vec<&str> {
    let mut enabled = Vec::new();
    let mut platform = "";
    for line in meta.lines().map(str::trim) {
        match line.split_once(": ").unwrap_or((line, "")) {
            ("Editor" | "Standalone", name) => platform = name,
            ("Any:", _) => platform = "Any",
            ("enabled", "1") => enabled.push(platform),
            ("OS", system) => enabled.push(system),
            _ => {}
        }
    }
    enabled
}

#[test]
fn each_library_is_for_its_own_platform_only() {
    let platforms = [
        ("x86_64/libchamfer.so", ["Editor", "Linux", "Linux64"]),
        ("x86_64/chamfer.dll", ["Editor", "Windows", "Win64"]),
        ("macOS/libchamfer.dylib", ["Editor", "OSX", "OSXUniversal"]),
    ];
    for (library, platform) in platforms {
        let meta = read(format!("Runtime/Plugins/{library}.meta"));
        assert_eq!(enabled(&meta), platform, "{library}");
        assert!(meta.contains("validateReferences: 1"), "{library}");
    }
}

#[test]
fn the_manifest_agrees_with_the_crate() {
    let manifest = read("package.json");
    let version = format!("\"version\": \"{}\"", env!("CARGO_PKG_VERSION"));
    assert!(manifest.contains(&version), "package.json lacks {version}");
    assert!(manifest.contains("\"unity\": \"2021.3\""));
    assert!(package().join("Samples~/Pipeline/ChamferChildren.cs").is_file());
    assert!(manifest.contains("\"path\": \"Samples~/Pipeline\""));
    let heading = format!("## [{}]", env!("CARGO_PKG_VERSION"));
    assert!(read("CHANGELOG.md").contains(&heading), "CHANGELOG.md lacks {heading}");
}

#[test]
fn licences_are_those_of_the_library() {
    assert_eq!(read("LICENSE-MIT.md"), include_str!("../LICENSE-MIT"));
    assert_eq!(read("LICENSE-APACHE.md"), include_str!("../LICENSE-APACHE"));
}

#[test]
fn every_entry_point_is_in_the_header() {
    let methods = read("Runtime/Interop/NativeMethods.cs");
    let names: Vec<&str> = methods.split("EntryPoint = \"").skip(1).collect();
    assert_eq!(names.len(), methods.matches("[DllImport(").count());
    for name in names {
        let (name, _) = name.split_once('"').unwrap();
        assert!(HEADER.contains(&format!("{name}(")), "the header lacks {name}");
    }
}

/// `NO_ROOM` as C# writes it.
fn pascal(name: &str) -> String {
    let word = |word: &str| word[..1].to_owned() + &word[1..].to_lowercase();
    name.split('_').map(word).collect()
}

#[test]
fn constants_are_those_of_the_header() {
    let settings = read("Runtime/ChamferSettings.cs");
    let verdict = read("Runtime/EdgeVerdict.cs");
    let sources = [
        ("WIDTH_MESH_UNITS", &settings, "MeshUnits"),
        ("WIDTH_PERCENT", &settings, "PercentOfExtent"),
        ("VERIFY_FAST", &settings, "Fast"),
        ("VERIFY_FULL", &settings, "Full"),
        ("SUBMESH_OWNER", &settings, "Owner"),
        ("SUBMESH_OWN", &settings, "Own"),
        ("SUBMESH_GIVEN", &settings, "Given"),
        ("OUTCOME_FULL", &verdict, "Full"),
        ("OUTCOME_NARROWED", &verdict, "Narrowed"),
        ("OUTCOME_SKIPPED", &verdict, "Skipped"),
    ];
    for (define, source, name) in sources {
        assert!(has_value(source, name, value(define)), "{name}");
    }
    let abi = format!("AbiVersion = {};", value("ABI_VERSION"));
    assert!(read("Runtime/Interop/NativeMethods.cs").contains(&abi));
}

#[test]
fn every_reason_of_the_header_is_known() {
    let verdict = read("Runtime/EdgeVerdict.cs");
    for define in HEADER.lines().filter_map(|line| line.strip_prefix("#define CHAMFER_REASON_")) {
        let (name, value) = define.split_once(' ').unwrap();
        if name != "SLOTS" {
            assert!(has_value(&verdict, &pascal(name), value), "EdgeReason lacks {name}");
        }
    }
}

fn value(define: &str) -> &'static str {
    let prefix = format!("#define CHAMFER_{define} ");
    HEADER.lines().find_map(|line| line.strip_prefix(&*prefix)).unwrap()
}

fn has_value(source: &str, name: &str, value: &str) -> bool {
    let member = format!("{name} = {value}");
    source.lines().any(|line| line.trim().trim_end_matches(',') == member)
}

#[test]
fn files_are_short() {
    for path in with_extension("cs") {
        let lines = read(&path).lines().count();
        assert!(lines <= MOST_LINES, "{} has {lines} lines", path.display());
    }
}
