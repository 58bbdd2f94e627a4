//! The readers of compressed geometry, on data of any kind in files that are right around it.
#![no_main]

use chamfer_fuzz::compressed::wrap;
use chamfer_fuzz::documents::read_chamfer_write;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|input: &[u8]| {
    if let Some(file) = wrap(input) {
        read_chamfer_write("glb", &file);
    }
});
