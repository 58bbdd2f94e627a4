//! What the `chamfer` command is made of: the batch that runs over many files, the check, the report
//! and the pictures. Model files are read and written by `chamfer-formats`.

pub mod close_up;
pub mod pictures;
pub mod preview;
pub mod scene;

mod args;
mod batch;
mod busiest;
mod check;
mod coats;
mod console;
mod demo;
mod html;
mod jobs;
mod nothing;
mod outcome;
mod process;
mod report;
mod summary;
mod verdict_lines;
mod write;

use std::process::ExitCode;

use clap::Parser;

use args::{Args, Command};

/// Runs the command that the process was started with. The exit code is 0 when all went well, 1
/// when a file failed or a check found something, 2 when the arguments make no sense (or a file to
/// check cannot be read), 3 when a check found nothing but could not look at all, and 130 after an
/// interrupt.
pub fn run() -> ExitCode {
    let args = Args::parse();
    if args.command.is_some() {
        write::on_interrupt(|| false);
    }
    match &args.command {
        Some(Command::Demo(demo)) => demo::run(demo),
        Some(Command::Check(args)) => check::run(args),
        None => batch::run(&args),
    }
}
