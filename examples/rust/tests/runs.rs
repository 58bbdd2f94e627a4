//! The example prints what the README says.

use std::process::Command;

#[test]
fn the_example_chamfers_a_cube() {
    let output = Command::new(env!("CARGO_BIN_EXE_chamfer_cube")).output().unwrap();
    let printed = String::from_utf8(output.stdout).unwrap().replace("\r\n", "\n");
    assert!(output.status.success());
    assert_eq!(printed, "24 vertices, 44 triangles\n12 of 12 hard edges full\n");
}
