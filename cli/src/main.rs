//! The `chamfer` command line.

mod document;

fn main() {}
