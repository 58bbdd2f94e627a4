//! All files of a run: several at a time, reported in their order.

use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::process::ExitCode;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread;
use std::time::{Duration, Instant};

use anyhow::{Result, anyhow};
use chamfer::MOST_SEGMENTS;
use indicatif::{ProgressBar, ProgressStyle};

use crate::args::Args;
use crate::console::warn;
use crate::fit::Wish;
use crate::jobs::{Job, Plan, plan};
use crate::outcome::{Done, Finished, Outcome};
use crate::pictures::Studio;
use crate::process::{Processed, Settings, Taken, process};
use crate::write::{self, Written};

/// The exit code where the arguments make no sense; that of the argument parser.
pub const USAGE: u8 = 2;
/// Parts of a file that the progress bar tells apart.
const STEPS: u64 = 1000;
/// How long an interrupted run waits for results that have their names to be told of.
const PATIENCE: Duration = Duration::from_secs(2);

/// What workers and the user tell the run.
enum Message {
    Done(usize, Box<Done>),
    Interrupted,
}

/// What the workers of a run share.
struct Shared<'a> {
    jobs: &'a [Job],
    settings: Settings,
    studio: Option<Studio>,
    /// The job that nobody has taken.
    next: AtomicUsize,
    bar: ProgressBar,
}

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
    let start = Instant::now();
    let (sender, receiver) = channel();
    let interrupt = sender.clone();
    write::on_interrupt(move || interrupt.send(Message::Interrupted).is_ok());
    let (shared, workers) = share(args, &plan);
    let mut outcome = Outcome::new(args, &plan);
    thread::scope(|scope| {
        for _ in 0..workers {
            let sender = sender.clone();
            scope.spawn(|| work(&shared, sender));
        }
        outcome.is_interrupted = !collect(&shared, &receiver, &mut outcome);
        shared.bar.finish_and_clear();
        if outcome.is_interrupted {
            // The workers are not waited for: one may be at a file that takes for ever.
            finish(args, std::mem::take(&mut outcome), &plan, start);
            std::process::exit(write::INTERRUPTED);
        }
    });
    drop(receiver);
    finish(args, outcome, &plan, start)
}

fn share<'a>(args: &Args, plan: &'a Plan) -> (Shared<'a>, usize) {
    let jobs = &plan.jobs[..];
    let cores = thread::available_parallelism().map_or(1, usize::from);
    let threads = if args.choices.threads == 0 { cores } else { args.choices.threads as usize };
    let workers = threads.min(jobs.len());
    let settings = Settings {
        read: args.choices.read_options(),
        wish: wish(args, (threads / workers) as u32),
        report_edges: args.report_edges,
        compresses: args.compress.is_some(),
        max_triangles: args.max_triangles,
        is_dry: args.dry_run,
        taken: Taken::new(jobs),
    };
    let studio = Studio::new(args, jobs.len());
    let bar = progress_bar(jobs.len());
    (Shared { jobs, settings, studio, next: AtomicUsize::new(0), bar }, workers)
}

/// What to ask of the meshes. Where triangles are counted, nothing but they bound the segments that
/// nobody has given.
fn wish(args: &Args, threads: u32) -> Wish {
    let wish = args.choices.wish(threads);
    let most = args.max_triangles.filter(|_| args.choices.segments.is_none());
    match most {
        Some(_) => Wish { core: wish.core.with_segments(MOST_SEGMENTS), ..wish },
        None => wish,
    }
}

/// Reports files in their order until all are done; whether they are.
fn collect(shared: &Shared, receiver: &Receiver<Message>, outcome: &mut Outcome) -> bool {
    let mut waiting = BTreeMap::new();
    let (jobs, bar) = (shared.jobs, &shared.bar);
    while outcome.done() < jobs.len() {
        match receiver.recv() {
            Ok(Message::Done(number, done)) => waiting.insert(number, done),
            _ => {
                // Those that wait for others are done all the same.
                receive_the_rest(receiver, &mut waiting);
                bar.suspend(|| {
                    waiting.into_iter().for_each(|(n, done)| outcome.add(&jobs[n], *done))
                });
                return false;
            }
        };
        while let Some(done) = waiting.remove(&outcome.done()) {
            bar.set_message(format!("{} of {}", outcome.done() + 1, jobs.len()));
            let job = &jobs[outcome.done()];
            bar.suspend(|| outcome.add(job, *done));
        }
    }
    true
}

/// Lets no further file get its name, and waits for those that have theirs.
fn receive_the_rest(receiver: &Receiver<Message>, waiting: &mut BTreeMap<usize, Box<Done>>) {
    write::stop();
    let end = Instant::now() + PATIENCE;
    let is_told = |waiting: &BTreeMap<usize, Box<Done>>| {
        waiting.values().filter(|done| done.result.is_ok()).count() >= Written::count()
    };
    while !is_told(waiting) && Instant::now() < end {
        if let Ok(Message::Done(number, done)) = receiver.recv_timeout(Duration::from_millis(10)) {
            waiting.insert(number, done);
        }
    }
}

fn finish(args: &Args, outcome: Outcome, plan: &Plan, start: Instant) -> ExitCode {
    let mut failed = plan.is_incomplete || outcome.has_failed();
    if let Err(error) = outcome.finish(args, plan.jobs.len(), start.elapsed()) {
        warn(format_args!("error: {error:#}"));
        failed = true;
    }
    ExitCode::from(u8::from(failed))
}

/// Takes one job after the other until none is left.
fn work(shared: &Shared, results: Sender<Message>) {
    loop {
        let number = shared.next.fetch_add(1, Ordering::Relaxed);
        let Some(job) = shared.jobs.get(number) else { return };
        let shown = AtomicUsize::new(0);
        let progress = |share: f32| {
            let steps = (share * STEPS as f32) as usize;
            shared.bar.inc(steps.saturating_sub(shown.swap(steps, Ordering::Relaxed)) as u64);
        };
        let start = Instant::now();
        let mut time = Duration::ZERO;
        // No file may take the others down, whatever is wrong with it or with us.
        let result = catch_unwind(AssertUnwindSafe(|| {
            let processed = process(job, &shared.settings, &progress);
            time = start.elapsed();
            finished(job, processed?, shared.studio.as_ref())
        }));
        progress(1.0);
        let result = result.unwrap_or_else(|_| Err(anyhow!("internal error: please report it")));
        if results.send(Message::Done(number, Box::new(Done { result, time }))).is_err() {
            return;
        }
    }
}

/// Lets go of the model once its picture is drawn.
fn finished(job: &Job, processed: Processed, studio: Option<&Studio>) -> Result<Finished> {
    let Processed { document, chamfered, reports, notes, written } = processed;
    let is_seen = chamfered.iter().any(|result| !result.mesh.indices.is_empty());
    let draw = |studio: &Studio| studio.draw(name_of(&job.input), &*document, &chamfered);
    let drawn = studio.filter(|_| is_seen).map(draw).transpose()?.unwrap_or_default();
    Ok(Finished { reports, notes, drawn, written })
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
