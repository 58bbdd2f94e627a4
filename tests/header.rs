//! The committed C header is the one that the sources make, and its page lists its statuses.

use std::{env, fs};

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
