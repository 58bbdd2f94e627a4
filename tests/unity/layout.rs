//! Where the fields of the header's structs lie, as a C compiler sees it.

use std::fmt::Write;
use std::path::Path;
use std::process::Command;
use std::sync::LazyLock;
use std::{env, fs};

/// A line `struct size` for each struct and a line `struct.field offset` for each field.
pub fn of_header() -> &'static str {
    static LAYOUT: LazyLock<String> = LazyLock::new(print_layout);
    &LAYOUT
}

fn print_layout() -> String {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let (source, program) = (folder.join("layout.c"), folder.join("layout"));
    fs::write(&source, c_program(include_str!("../../include/chamfer.h"))).unwrap();
    let compiler = env::var_os("CC").unwrap_or("cc".into());
    let include = concat!(env!("CARGO_MANIFEST_DIR"), "/include");
    let mut compile = Command::new(compiler);
    compile.args(["-I", include]).arg(&source).arg("-o").arg(&program);
    assert!(compile.status().expect("a C compiler: install cc or set CC").success());
    String::from_utf8(Command::new(&program).output().unwrap().stdout).unwrap()
}

/// A program that prints the layout of every struct that the header defines.
fn c_program(header: &str) -> String {
    let mut prints = String::new();
    let mut name = None;
    for line in header.lines().map(str::trim) {
        if let Some(opened) = line.strip_prefix("typedef struct ") {
            name = opened.strip_suffix(" {");
            if let Some(name) = name {
                writeln!(prints, "printf(\"{name} %zu\\n\", sizeof({name}));").unwrap();
            }
        } else if line.starts_with('}') {
            name = None;
        } else if let (Some(name), Some(field)) = (name, field_name(line)) {
            writeln!(prints, "printf(\"{name}.{field} %zu\\n\", offsetof({name}, {field}));")
                .unwrap();
        }
    }
    format!(
        "#include <stddef.h>\n#include <stdio.h>\n#include \"chamfer.h\"\n\
         int main(void) {{\n{prints}}}\n"
    )
}

fn field_name(line: &str) -> Option<&str> {
    let declaration = line.strip_suffix(';').filter(|_| !line.starts_with(['/', '*']))?;
    let name = declaration.split('[').next()?.rsplit([' ', '*']).next()?;
    Some(name)
}
