//! The `chamfer` command line.

use std::process::ExitCode;

fn main() -> ExitCode {
    chamfer_cli::run()
}
