//! What came of the files of a run: told as they are done, and all of it at the end.

use std::path::Path;
use std::time::Duration;

use anyhow::Result;

use crate::args::Args;
use crate::console::{one_line, say, warn, with_causes};
use crate::html::{self, Pictures};
use crate::jobs::{Job, Plan};
use crate::pictures::{self, Drawn, Portrait};
use crate::report::{FileReport, MeshReport, Report};
use crate::summary;
use crate::write::{self, Written};

/// A file that was tried. A slow one keeps the others waiting, so no model is in it.
pub struct Done {
    pub result: Result<Finished>,
    /// From reading to writing.
    pub time: Duration,
}

/// What is left of a file once it is written.
pub struct Finished {
    pub reports: Vec<MeshReport>,
    pub notes: Vec<String>,
    /// Pictures, where some were asked for and there is something to see.
    pub drawn: Drawn,
    /// None where nothing is written.
    pub written: Option<Written>,
}

/// What is left of a run.
#[derive(Default)]
pub struct Outcome {
    files: Vec<FileReport>,
    /// `#files`: for the page.
    pictures: Vec<Pictures>,
    notes: Vec<String>,
    portraits: Vec<Portrait>,
    /// Whether somebody ended it before all was done.
    pub is_interrupted: bool,
    is_quiet: bool,
    is_verbose: bool,
}

impl Outcome {
    /// Of a run that has not begun.
    pub fn new(args: &Args, plan: &Plan) -> Outcome {
        let notes = plan.notes.clone();
        Outcome { notes, is_quiet: args.quiet, is_verbose: args.verbose, ..Outcome::default() }
    }

    /// How many files are done, or have failed.
    pub fn done(&self) -> usize {
        self.files.len()
    }

    /// Whether one has failed.
    pub fn has_failed(&self) -> bool {
        self.files.iter().any(|file| file.error.is_some())
    }

    /// Tells of a file that is done.
    pub fn add(&mut self, job: &Job, done: Done) {
        let mut file = FileReport::new(&job.input, &job.output, done.time);
        match done.result {
            Ok(Finished { reports, notes, drawn, written }) => {
                file.meshes = reports;
                file.notes = notes;
                self.portraits.extend(drawn.portrait);
                self.pictures.push(drawn.page);
                self.tell(&file);
                drop(written);
            }
            Err(error) => {
                let error = with_causes(&error);
                warn(format_args!("{}: {error}", one_line(&file.file)));
                file.error = Some(error);
                self.pictures.push(None);
            }
        }
        self.files.push(file);
    }

    fn tell(&self, file: &FileReport) {
        if self.is_quiet {
            return;
        }
        for note in &file.notes {
            warn(format_args!("{}: note: {}", one_line(&file.file), one_line(note)));
        }
        say(file);
        if self.is_verbose {
            summary::meshes(file).for_each(say);
        }
    }

    /// Says what came of all, and writes what was asked for besides the models.
    ///
    /// # Errors
    /// Where a file cannot be written.
    pub fn finish(self, args: &Args, planned: usize, time: Duration) -> Result<()> {
        let mut report = Report::new(args.asked(), self.files, self.notes);
        report.interrupted = self.is_interrupted;
        if !self.is_quiet && (planned > 1 || report.interrupted) {
            say(summary::closing(&report, planned, time));
        }
        let json = args.report.as_deref().map(|path| write::alone(path, report.to_json()?));
        let page = |path| write::alone(path, html::page(&report, &self.pictures, path).into());
        let page = args.html.as_deref().map(page);
        let draw = |path| draw(path, &self.portraits);
        let preview = args.preview.as_deref().map(draw);
        // One that fails is no reason to leave out the other.
        [json, page, preview].into_iter().flatten().fold(Ok(()), Result::and)
    }
}

fn draw(path: &Path, portraits: &[Portrait]) -> Result<()> {
    if portraits.is_empty() {
        warn(format_args!("{}: note: not drawn, there is no model to show", path.display()));
        return Ok(());
    }
    pictures::write_sheets(path, portraits)
}
