//! The modules of the core import each other in one direction: no circle, at the top or among the
//! files of one folder.

#[path = "support/imports.rs"]
mod imports;

use std::collections::BTreeSet;

use imports::{Imports, circles, imports_within, modules, used};

const SOURCE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/src");

#[test]
fn no_circle_of_imports() {
    let modules = modules(SOURCE);
    assert!(modules.len() > 50);
    let folders: BTreeSet<&str> =
        modules.keys().filter_map(|n| Some(n.rsplit_once("::")?.0)).collect();
    for folder in std::iter::once("").chain(folders) {
        let circles = circles(imports_within(folder, &modules));
        assert!(circles.is_empty(), "circle of imports in {folder:?}: {circles:#?}");
    }
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
