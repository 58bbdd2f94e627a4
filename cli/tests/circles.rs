//! The modules of the command import each other in one direction, as those of the core do.

#[path = "../../tests/support/imports.rs"]
#[allow(dead_code)]
mod imports;

use imports::{circles_by_folder, modules};

#[test]
fn no_circle_of_imports() {
    let modules = modules(concat!(env!("CARGO_MANIFEST_DIR"), "/src"));
    assert!(modules.len() > 40);
    let circles = circles_by_folder(&modules);
    assert!(circles.is_empty(), "{circles:#?}");
}
