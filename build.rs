//! Generates the C header into the build folder, where `tests/header.rs` compares it with the
//! committed `include/chamfer.h`.

use std::env;
use std::error::Error;
use std::path::Path;

/// The files that hold exports, in the order of the header. cbindgen reads them alone: looking
/// through the whole crate would need its dependencies.
const SOURCES: [&str; 2] = ["src/ffi/types.rs", "src/ffi/mod.rs"];

fn main() -> Result<(), Box<dyn Error>> {
    println!("cargo::rerun-if-changed=cbindgen.toml");
    println!("cargo::rerun-if-changed=src/ffi");
    let config = cbindgen::Config::from_file("cbindgen.toml")?;
    let builder = cbindgen::Builder::new().with_config(config);
    let builder = SOURCES.iter().fold(builder, |builder, source| builder.with_src(source));
    builder.generate()?.write_to_file(Path::new(&env::var("OUT_DIR")?).join("chamfer.h"));
    Ok(())
}
