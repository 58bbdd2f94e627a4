//! What users of the crate get: few files, no tools of tests, and one address of the project.

use std::collections::BTreeSet;
use std::process::Command;

/// What a cargo command prints, without the network.
fn cargo(arguments: &[&str]) -> String {
    let mut command = Command::new(env!("CARGO"));
    command.current_dir(env!("CARGO_MANIFEST_DIR")).args(arguments).args(["--offline", "--locked"]);
    let output = command.output().unwrap();
    assert!(output.status.success(), "{command:?}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

#[test]
fn the_published_crate_is_small() {
    let list = cargo(&["package", "--list", "--allow-dirty", "--package", "chamfer"]);
    let files: BTreeSet<&str> = list.lines().collect();
    assert!(files.len() < 135, "{} files: leave out what users do not compile", files.len());
    for needed in ["README.md", "build.rs", "cbindgen.toml", "include/chamfer.h", "src/lib.rs"] {
        assert!(files.contains(needed), "{needed}");
    }
}

#[test]
fn users_of_the_crate_compile_no_cbindgen() {
    for (package, edges) in [("chamfer", "normal,build"), ("chamfer-cube", "all")] {
        let tree = cargo(&["tree", "--package", package, "--edges", edges, "--prefix", "none"]);
        assert!(tree.contains("glam v"), "{tree}");
        for tool in ["cbindgen v", "criterion v", "ufbx v"] {
            assert!(!tree.contains(tool), "{package} compiles {tool}:\n{tree}");
        }
    }
}

/// The demo of the README needs no reader: nothing of C and C++ is compiled, and little else.
#[test]
fn the_demo_compiles_little() {
    let tree = cargo(&[
        "tree",
        "--package",
        "chamfer-cli",
        "--no-default-features",
        "--edges",
        "normal,build",
        "--prefix",
        "none",
    ]);
    let crates: BTreeSet<&str> = tree.lines().filter_map(|line| line.split(' ').next()).collect();
    assert!(crates.contains("chamfer-formats") && crates.len() < 100, "{}", crates.len());
    for left_out in ["cbindgen", "cc", "draco-core", "meshopt", "moxcms", "ufbx"] {
        assert!(!crates.contains(left_out), "the demo compiles {left_out}");
    }
}
