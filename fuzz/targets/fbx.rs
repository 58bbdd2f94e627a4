//! The reader of FBX, on bytes of any kind.
#![no_main]

use chamfer_fuzz::documents::read_chamfer_write;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| read_chamfer_write("fbx", bytes));
