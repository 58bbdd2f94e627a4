//! The modules of the core import each other in one direction: no circle, at the top or among the
//! files of one folder.

#[path = "support/imports.rs"]
mod imports;

use imports::{Imports, circles, circles_by_folder, modules, used};

const SOURCE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/src");

#[test]
fn no_circle_of_imports() {
    let modules = modules(SOURCE);
    assert!(modules.len() > 50);
    let circles = circles_by_folder(&modules);
    assert!(circles.is_empty(), "{circles:#?}");
}

#[test]
fn uses_are_read_and_circles_found() {
    let text = "use std::a;\npub use crate::b::{c, d::{E, f as g}};\n    use super::h;\n";
    assert_eq!(
        used(text),
        ["std::a", "crate::b::c", "crate::b::d::E", "crate::b::d::f", "super::h"]
    );
    let imports = |pairs: &[(&str, &[&str])]| -> Imports {
        let owned = |names: &[&str]| names.iter().map(|&name| name.to_owned()).collect();
        pairs.iter().map(|(name, others)| ((*name).to_owned(), owned(others))).collect()
    };
    let straight = imports(&[("a", &["b", "c"]), ("b", &["c"]), ("c", &[])]);
    assert!(circles(straight).is_empty());
    let round = imports(&[("a", &["b"]), ("b", &["c"]), ("c", &["b", "d"]), ("d", &[])]);
    assert_eq!(circles(round).len(), 2);
}
