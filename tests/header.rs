//! The committed C header is the one that the sources make.

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
