//! What the `chamfer` command is made of: the batch that runs over many files, the check, the report
//! and the pictures. Model files are read and written by `chamfer-formats`.

pub mod close_up;
pub mod pictures;
pub mod preview;
pub mod scene;

mod args;
mod batch;
mod budget;
mod busiest;
mod chamfering;
mod check;
mod choices;
mod coats;
mod console;
mod demo;
mod fit;
mod html;
mod jobs;
mod length;
mod nothing;
mod outcome;
mod preset;
mod process;
mod report;
mod stretch;
mod summary;
mod verdict_lines;
mod write;

use std::ffi::OsString;
use std::process::ExitCode;

use args::Command;

/// Runs the command that the process was started with. The exit code is 0 when all went well, 1
/// when a file failed or a check found something, 2 when the arguments make no sense (or a file to
/// check cannot be read), 3 when a check found nothing but could not look at all, and 130 after an
/// interrupt.
pub fn run() -> ExitCode {
    let words: Vec<OsString> = std::env::args_os().collect();
    let args = preset::parse(&words).unwrap_or_else(|error| error.exit());
    if args.print_options && args.command.is_none() {
        print!("{}", preset::text(&args.choices));
        return ExitCode::SUCCESS;
    }
    if args.command.is_some() {
        write::on_interrupt(|| false);
    }
    match &args.command {
        Some(Command::Demo(demo)) => demo::run(demo),
        Some(Command::Check(args)) => check::run(args),
        None => batch::run(&args),
    }
}
