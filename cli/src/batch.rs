//! All files of a run: several at a time, reported in their order.

use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::process::ExitCode;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{Sender, channel};
use std::thread;
use std::time::{Duration, Instant};

use anyhow::{Error, Result, anyhow};
use indicatif::{ProgressBar, ProgressStyle};

use crate::args::Args;
use crate::console::{one_line as told, say, warn};
use crate::jobs::{Job, Plan, plan};
use crate::pictures::{self, MOST_ROWS, Portrait, Studio};
use crate::process::{Processed, Settings, Taken, process};
use crate::report::{FileReport, MeshReport, Report};
use crate::write;

/// The exit code where the arguments make no sense; that of the argument parser.
pub const USAGE: u8 = 2;
/// Parts of a file that the progress bar tells apart.
const STEPS: u64 = 1000;

/// Chamfers the files that the arguments name.
pub fn run(args: &Args) -> ExitCode {
    let plan = match plan(args) {
        Ok(plan) => plan,
        Err(error) => {
            warn(format_args!("error: {error:#}"));
            return ExitCode::from(USAGE);
        }
    };
    plan.notes.iter().for_each(warn);
    let outcome = chamfer_all(args, &plan);
    let mut failed = plan.is_incomplete || outcome.files.iter().any(|file| file.error.is_some());
    if let Err(error) = write_extras(args, outcome) {
        warn(format_args!("error: {error:#}"));
        failed = true;
    }
    ExitCode::from(u8::from(failed))
}

/// A file that was tried. A slow one keeps the others waiting, so no model is in it.
struct Done {
    result: Result<Finished>,
    /// From reading to writing.
    time: Duration,
}

/// What is left of a file once it is written.
struct Finished {
    reports: Vec<MeshReport>,
    notes: Vec<String>,
    /// A picture, where one was asked for and there is something to see.
    picture: Option<Portrait>,
}

/// What is left of a run once all results are written.
#[derive(Default)]
struct Outcome {
    files: Vec<FileReport>,
    notes: Vec<String>,
    portraits: Vec<Portrait>,
    /// Models that would be in the picture if there were room.
    left_out: usize,
}

fn chamfer_all(args: &Args, plan: &Plan) -> Outcome {
    let jobs = &plan.jobs[..];
    let cores = thread::available_parallelism().map_or(1, usize::from);
    let threads = if args.threads == 0 { cores } else { args.threads as usize };
    let workers = threads.min(jobs.len());
    let settings = Settings {
        read: args.read_options(),
        core: args.options((threads / workers) as u32),
        report_edges: args.report_edges,
        compresses: args.compress.is_some(),
        taken: Taken::new(jobs),
    };
    let studio = args.preview.is_some().then(|| Studio::new(args, jobs.len()));
    let bar = progress_bar(jobs.len());
    let mut outcome = Outcome { notes: plan.notes.clone(), ..Outcome::default() };
    let next = AtomicUsize::new(0);
    let (sender, receiver) = channel();
    thread::scope(|scope| {
        for _ in 0..workers {
            let sender = sender.clone();
            scope.spawn(|| work(jobs, &settings, studio.as_ref(), &next, &bar, sender));
        }
        drop(sender);
        let mut waiting = BTreeMap::new();
        for (number, done) in receiver {
            waiting.insert(number, done);
            while let Some(done) = waiting.remove(&outcome.files.len()) {
                bar.set_message(format!("{} of {}", outcome.files.len() + 1, jobs.len()));
                let job = &jobs[outcome.files.len()];
                bar.suspend(|| outcome.add(job, done));
            }
        }
    });
    bar.finish_and_clear();
    outcome
}

/// Takes one job after the other until none is left.
fn work(
    jobs: &[Job],
    settings: &Settings,
    studio: Option<&Studio>,
    next: &AtomicUsize,
    bar: &ProgressBar,
    results: Sender<(usize, Done)>,
) {
    loop {
        let number = next.fetch_add(1, Ordering::Relaxed);
        let Some(job) = jobs.get(number) else { return };
        let shown = AtomicUsize::new(0);
        let progress = |share: f32| {
            let steps = (share * STEPS as f32) as usize;
            bar.inc(steps.saturating_sub(shown.swap(steps, Ordering::Relaxed)) as u64);
        };
        let start = Instant::now();
        // No file may take the others down, whatever is wrong with it or with us.
        let mut time = Duration::ZERO;
        let result = catch_unwind(AssertUnwindSafe(|| {
            let processed = process(job, settings, &progress);
            time = start.elapsed();
            finish(job, processed?, studio)
        }));
        progress(1.0);
        let result = result.unwrap_or_else(|_| Err(anyhow!("internal error: please report it")));
        if results.send((number, Done { result, time })).is_err() {
            return;
        }
    }
}

/// Lets go of the model once its picture is drawn.
fn finish(job: &Job, processed: Processed, studio: Option<&Studio>) -> Result<Finished> {
    let Processed { document, chamfered, reports, notes } = processed;
    let is_seen = chamfered.iter().any(|result| !result.mesh.indices.is_empty());
    let draw = |studio: &Studio| studio.draw(name_of(&job.input), &*document, &chamfered);
    let picture = studio.filter(|_| is_seen).map(draw).transpose()?;
    Ok(Finished { reports, notes, picture })
}

impl Outcome {
    /// Reports a file that is done.
    fn add(&mut self, job: &Job, done: Done) {
        let mut file = FileReport::new(&job.input, &job.output, done.time);
        match done.result {
            Ok(Finished { reports, notes, picture }) => {
                for note in &notes {
                    warn(format_args!("{}: note: {note}", told(&file.file)));
                }
                file.meshes = reports;
                file.notes = notes;
                say(&file);
                picture.into_iter().for_each(|picture| self.keep(picture));
            }
            Err(error) => {
                let error = one_line(&error);
                warn(format_args!("{}: {error}", told(&file.file)));
                file.error = Some(error);
            }
        }
        self.files.push(file);
    }

    fn keep(&mut self, portrait: Portrait) {
        if self.portraits.len() < MOST_ROWS {
            self.portraits.push(portrait);
        } else {
            self.left_out += 1;
        }
    }
}

fn write_extras(args: &Args, outcome: Outcome) -> Result<()> {
    let Outcome { files, notes, portraits, left_out } = outcome;
    let report = args.report.as_deref().map(|path| {
        let json = Report::new(files, notes).to_json()?;
        write::alone(path, json)
    });
    let draw = |path| draw(path, &portraits, left_out);
    let preview = args.preview.as_deref().map(draw);
    // One that fails is no reason to leave out the other.
    report.unwrap_or(Ok(())).and(preview.unwrap_or(Ok(())))
}

fn draw(path: &Path, portraits: &[Portrait], left_out: usize) -> Result<()> {
    if portraits.is_empty() {
        warn(format_args!("{}: note: not drawn, there is no model to show", path.display()));
        return Ok(());
    }
    if left_out > 0 {
        let path = path.display();
        warn(format_args!("{path}: note: {left_out} models left out after the first {MOST_ROWS}"));
    }
    pictures::write_sheet(path, portraits)
}

/// Drawn on a terminal only.
fn progress_bar(files: usize) -> ProgressBar {
    let bar = ProgressBar::new(files as u64 * STEPS);
    if let Ok(style) = ProgressStyle::with_template("{bar:40} {percent:>3} % {msg}") {
        bar.set_style(style);
    }
    bar.set_message(format!("0 of {files}"));
    bar
}

pub fn name_of(path: &Path) -> String {
    path.file_name().unwrap_or_default().to_string_lossy().into_owned()
}

pub fn one_line(error: &Error) -> String {
    format!("{error:#}").replace(['\n', '\r'], " ")
}
