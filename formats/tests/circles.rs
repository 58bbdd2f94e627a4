//! No module imports one that imports it: leaves come first, and the registry last.

#[path = "../../tests/support/imports.rs"]
#[allow(dead_code)]
mod imports;

use imports::{circles, imports, modules};

#[test]
fn no_modules_import_each_other_in_a_circle() {
    let modules = modules(concat!(env!("CARGO_MANIFEST_DIR"), "/src"));
    let imports = imports(&modules);
    assert!(imports.len() > 20 && imports.values().any(|used| used.len() > 5), "{imports:?}");
    let circles = circles(imports);
    assert!(circles.is_empty(), "{circles:#?}");
}
