//! The Unity package is complete, and agrees with the library and its header.

use std::collections::BTreeSet;
use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};

use chamfer::Reason;

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

/// `no_room` as C# writes it.
fn pascal(name: &str) -> String {
    let word = |word: &str| word[..1].to_uppercase() + &word[1..];
    name.split('_').map(word).collect()
}

#[test]
fn constants_are_those_of_the_header() {
    let settings = read("Runtime/ChamferSettings.cs");
    let verdict = read("Runtime/EdgeVerdict.cs");
    let edges = read("Runtime/EdgeSettings.cs");
    let sources = [
        ("WIDTH_MESH_UNITS", &settings, "MeshUnits"),
        ("WIDTH_PERCENT", &settings, "PercentOfExtent"),
        ("VERIFY_FAST", &settings, "Fast"),
        ("VERIFY_FULL", &settings, "Full"),
        ("VERIFY_SEEN", &settings, "Seen"),
        ("WIDTH_OFFSET", &edges, "Offset"),
        ("WIDTH_CHORD", &edges, "Chord"),
        ("WIDTH_DEPTH", &edges, "Depth"),
        ("WIDTH_RADIUS", &edges, "Radius"),
        ("CONVEXITY_BOTH", &edges, "Both"),
        ("CONVEXITY_CONVEX", &edges, "Convex"),
        ("CONVEXITY_CONCAVE", &edges, "Concave"),
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
fn reasons_are_those_of_the_library() {
    let verdict = read("Runtime/EdgeVerdict.cs");
    let (_, list) = verdict.split_once("enum EdgeReason").unwrap();
    let members = list.split_once('}').unwrap().0.lines().map(str::trim);
    let members =
        members.filter(|line| line.contains(" = ")).map(|line| line.trim_end_matches(','));
    let member = |reason: &Reason| format!("{} = {}", pascal(reason.name()), *reason as u32);
    assert_eq!(members.collect::<Vec<_>>(), Reason::ALL.iter().map(member).collect::<Vec<_>>());
}

/// Whoever reads a report is told why, in words.
#[test]
fn every_reason_has_words() {
    let words = read("Editor/ReportText.cs");
    for reason in Reason::ALL.iter().filter(|reason| **reason != Reason::None) {
        let case = format!("case EdgeReason.{}: return", pascal(reason.name()));
        assert!(words.contains(&case), "ReportText lacks {case}");
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

#[test]
fn the_pictures_of_the_page_are_there() {
    let page = read("Documentation~/index.md");
    let pictures: Vec<&str> =
        page.split("](").skip(1).filter_map(|rest| rest.split(')').next()).collect();
    let pictures: Vec<&str> = pictures.into_iter().filter(|name| name.ends_with(".png")).collect();
    assert!(pictures.len() >= 2, "{pictures:?}");
    for picture in pictures {
        let bytes = fs::read(package().join("Documentation~").join(picture)).unwrap();
        assert!(bytes.starts_with(b"\x89PNG"), "{picture}");
    }
}

#[test]
fn every_sample_of_the_manifest_is_there_and_no_other() {
    let manifest = read("package.json");
    let listed: BTreeSet<&str> = manifest
        .lines()
        .filter_map(|line| line.trim().strip_prefix("\"path\": \"Samples~/")?.strip_suffix('"'))
        .collect();
    let folders = fs::read_dir(package().join("Samples~")).unwrap();
    let found: Vec<_> = folders.map(|folder| folder.unwrap().file_name()).collect();
    assert_eq!(listed, found.iter().map(|name| name.to_str().unwrap()).collect());
}

/// A tag can be moved to other code, a commit cannot.
#[test]
fn actions_of_the_workflows_are_pinned() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/.github/workflows");
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        for line in fs::read_to_string(&path).unwrap().lines() {
            let Some((_, action)) = line.split_once("uses: ") else { continue };
            let Some((_, pin)) = action.split_once('@') else { continue };
            let hash = pin.split(' ').next().unwrap();
            let is_commit = hash.len() == 40 && hash.chars().all(|c| c.is_ascii_hexdigit());
            assert!(is_commit && pin.contains("# v"), "{}: {action}", path.display());
        }
    }
}

/// A test that was renamed would be missed only on that system.
#[test]
fn tests_that_the_workflows_name_are_there() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let check = fs::read_to_string(root.join(".github/workflows/check.yml")).unwrap();
    let named: Vec<&str> =
        check.split("--test ").skip(1).filter_map(|t| t.split_whitespace().next()).collect();
    assert!(named.contains(&"determinism") && named.contains(&"streams"), "{named:?}");
    for name in named {
        let is_there = [format!("tests/{name}.rs"), format!("tests/{name}/main.rs")]
            .iter()
            .any(|path| root.join(path).is_file());
        assert!(is_there, "check.yml names the test {name}");
    }
}

/// Packing needs GNU tar.
#[cfg(target_os = "linux")]
mod archive {
    use std::process::Command;

    use super::*;

    /// The files of an archive of libraries that were built elsewhere: here, empty ones.
    fn archived() -> Vec<String> {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("archive");
        let _ = fs::remove_dir_all(&folder);
        fs::create_dir_all(&folder).unwrap();
        for library in ["libchamfer.so", "chamfer.dll", "libchamfer.dylib"] {
            fs::write(folder.join(library), "").unwrap();
        }
        let script = concat!(env!("CARGO_MANIFEST_DIR"), "/scripts/package-unity");
        let mut pack = Command::new("bash");
        pack.args([script, "--strict", "--libraries"]).arg(&folder).arg("--output").arg(&folder);
        assert!(pack.output().unwrap().status.success());
        let name = format!("com.chamfer.unity-{}.tgz", env!("CARGO_PKG_VERSION"));
        let list = Command::new("tar").arg("-tzf").arg(folder.join(name)).output().unwrap();
        let paths = String::from_utf8(list.stdout).unwrap();
        paths.lines().map(|path| path.trim_end_matches('/').to_owned()).collect()
    }

    #[test]
    fn nothing_is_missing_in_the_archive() {
        let archived = archived();
        let has = |path: &str| archived.iter().any(|known| known == &format!("package/{path}"));
        for path in [
            "package.json",
            "README.md",
            "CHANGELOG.md",
            "LICENSE.md",
            "LICENSE-MIT.md",
            "LICENSE-APACHE.md",
            "Documentation~/index.md",
            "Samples~/Pipeline/ChamferChildren.cs",
            "Runtime/Plugins/x86_64/libchamfer.so",
            "Runtime/Plugins/x86_64/chamfer.dll",
            "Runtime/Plugins/macOS/libchamfer.dylib",
        ] {
            assert!(has(path), "{path}");
        }
        for path in imported().iter().filter(|path| !path.ends_with(".gitignore")) {
            let path = path.strip_prefix(package()).unwrap().to_string_lossy().replace('\\', "/");
            assert!(has(&path), "{path}");
        }
        let is_imported = |path: &&String| !path.contains('~') && *path != "package";
        for path in archived.iter().filter(is_imported).filter(|path| !path.ends_with(".meta")) {
            assert!(archived.contains(&format!("{path}.meta")), "{path} has no meta");
        }
    }
}
