//! What is packed for Unity: its links, its branch, and the notices of what is linked in.
//! Packing needs GNU tar and git.
#![cfg(target_os = "linux")]

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

const ROOT: &str = env!("CARGO_MANIFEST_DIR");
const HOME: &str = "https://example.org/team/chamfer";

fn run(folder: &Path, program: &str, arguments: &[&str]) -> String {
    let mut command = Command::new(program);
    command.current_dir(folder).args(arguments);
    for (name, value) in [("NAME", "Tester"), ("EMAIL", "tester@example.org")] {
        command
            .env(format!("GIT_AUTHOR_{name}"), value)
            .env(format!("GIT_COMMITTER_{name}"), value);
    }
    let output = command.output().unwrap();
    let complaint = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{program} {arguments:?}: {complaint}");
    String::from_utf8(output.stdout).unwrap()
}

/// A repository of its own with the package and the script, and empty libraries.
fn repository() -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("packing");
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(folder.join("scripts")).unwrap();
    fs::create_dir_all(folder.join("libraries")).unwrap();
    fs::copy(format!("{ROOT}/scripts/package-unity"), folder.join("scripts/package-unity"))
        .unwrap();
    run(&folder, "cp", &["-R", &format!("{ROOT}/unity-package"), "unity-package"]);
    for library in ["libchamfer.so", "chamfer.dll", "libchamfer.dylib"] {
        fs::write(folder.join("libraries").join(library), library).unwrap();
    }
    run(&folder, "git", &["init", "--quiet"]);
    folder
}

#[test]
fn a_branch_has_the_package_with_its_libraries() {
    let folder = repository();
    let pack = ["scripts/package-unity", "--strict", "--libraries", "libraries", "--output", "out"];
    let publish = [&pack[..], &["--repository", HOME, "--branch", "upm"]].concat();
    run(&folder, "bash", &publish);
    let files = run(&folder, "git", &["ls-tree", "-r", "--name-only", "upm"]);
    for file in [
        "package.json",
        "Runtime/Plugins/x86_64/libchamfer.so",
        "Samples~/Pipeline/ChamferChildren.cs",
    ] {
        assert!(files.lines().any(|line| line == file), "{file} in {files}");
    }
    let tag = format!("upm/{}", env!("CARGO_PKG_VERSION"));
    let revision = |name: &str| run(&folder, "git", &["rev-parse", name]);
    assert_eq!(revision("upm"), revision(&tag));
    let manifest = run(&folder, "git", &["show", "upm:package.json"]);
    let manifest: serde_json::Value = serde_json::from_str(&manifest).unwrap();
    assert_eq!(manifest["repository"]["url"], format!("{HOME}.git"));
    assert_eq!(manifest["documentationUrl"], format!("{HOME}/blob/upm/Documentation~/index.md"));
    assert_eq!(manifest["changelogUrl"], format!("{HOME}/blob/upm/CHANGELOG.md"));
    assert_eq!(manifest["licensesUrl"], format!("{HOME}/blob/upm/LICENSE.md"));
    let links = run(&folder, "git", &["show", "upm:Runtime/PackageLinks.cs"]);
    assert!(links.contains(&format!("\"{HOME}/blob/upm/Documentation~/index.md\"")), "{links}");
    // Another version comes on top; the same one must not move its tag.
    run(&folder, "git", &["tag", "--delete", &tag]);
    let first = revision("upm");
    run(&folder, "bash", &publish);
    assert_eq!(revision("upm^"), first);
    assert!(
        run(&folder, "git", &["status", "--porcelain"]).lines().all(|line| line.starts_with("??"))
    );
}

#[test]
fn notices_name_all_that_is_linked_in() {
    let notices =
        fs::read_to_string(format!("{ROOT}/unity-package/Third Party Notices.md")).unwrap();
    let arguments = [
        "tree",
        "--package",
        "chamfer",
        "--edges",
        "normal",
        "--prefix",
        "none",
        "--offline",
        "--locked",
    ];
    for line in run(Path::new(ROOT), env!("CARGO"), &arguments).lines() {
        let name = line.split(' ').next().unwrap();
        assert!(name == "chamfer" || notices.contains(&format!("| {name} |")), "{name}");
    }
}
