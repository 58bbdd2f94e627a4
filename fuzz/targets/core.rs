//! The core on meshes and options of any kind.
#![no_main]

use chamfer_fuzz::meshes::{Spec, Wishes};
use chamfer_fuzz::oracle::chamfer_and_check;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|input: (Spec, Wishes)| {
    let (spec, wishes) = input;
    chamfer_and_check(&spec.mesh(), &wishes.options());
});
