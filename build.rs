//! Generates the C header into the build folder, where `tests/header.rs` compares it with the
//! committed `include/chamfer.h`.

use std::error::Error;
use std::path::Path;
use std::{env, fs};

/// The files that hold exports, in the order of the header. cbindgen reads them alone: looking
/// through the whole crate would need its dependencies.
const SOURCES: [&str; 2] = ["src/ffi/types.rs", "src/ffi/mod.rs"];

fn main() -> Result<(), Box<dyn Error>> {
    println!("cargo::rerun-if-changed=cbindgen.toml");
    println!("cargo::rerun-if-changed=src/ffi");
    let config = cbindgen::Config::from_file("cbindgen.toml")?;
    let builder = cbindgen::Builder::new().with_config(config);
    let builder = SOURCES.iter().fold(builder, |builder, source| builder.with_src(source));
    let mut header = Vec::new();
    builder.generate()?.write(&mut header);
    let header = with_short_comments(&String::from_utf8(header)?);
    fs::write(Path::new(&env::var("OUT_DIR")?).join("chamfer.h"), header)?;
    Ok(())
}

/// Comments of one line, which cbindgen spreads over three, on one.
fn with_short_comments(header: &str) -> String {
    let lines: Vec<&str> = header.lines().collect();
    let (mut short, mut next) = (String::new(), 0);
    while let Some(&line) = lines.get(next) {
        let text = lines.get(next + 1).and_then(|text| text.trim_start().strip_prefix("* "));
        let is_closed = lines.get(next + 2).is_some_and(|end| end.trim_start() == "*/");
        match text.filter(|_| line.trim_start() == "/**" && is_closed) {
            Some(text) => {
                short += &format!("{line} {text} */\n");
                next += 3;
            }
            None => {
                short += &format!("{line}\n");
                next += 1;
            }
        }
    }
    short
}
