//! The `chamfer` command line.

fn main() {}
