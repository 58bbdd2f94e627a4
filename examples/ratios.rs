//! Prints how long a chamfer takes in terms of meshoptimizer's position remap, in one run.
//!
//! `cargo run --release --example ratios -- [--rounds N] [--least] [--full] [--cubes N | --terrain N]`
//! `cargo run --release --example ratios -- --corpus [--rounds N] [--least]`
//!
//! A terrain is one connected mesh, shaded flat, of `N` by `N` quads; 708 by 708 are a million triangles.
//! Times are medians; `--least` takes the least instead, for machines that have other work to do.

#[path = "../benches/support/models.rs"]
mod models;

#[allow(dead_code)]
#[path = "../tests/corpus/measure.rs"]
mod measure;

#[path = "../tests/support/shaded.rs"]
mod shaded;

#[allow(dead_code)]
#[path = "../tests/support/worst.rs"]
mod worst;

use std::hint::black_box;
use std::path::Path;
use std::time::{Duration, Instant};

use chamfer::{MeshBuffers, Options, Stage, Verify, Width, chamfer};
use chamfer_formats as formats;
use chamfer_formats::ReadOptions;
use models::{CUBES, copy, cube_field, options, position_remap, smooth_sphere, stage_times};

/// In percent of each model's extent.
const CORPUS_PERCENT: f32 = 1.0;

/// What may pass between two pictures while a width is dragged.
const LONGEST_DRAG: Duration = Duration::from_millis(10);

/// The triangles of a large game asset.
const MOST_DRAGGED: usize = 50_000;

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    if let Some(model) = value_of(&arguments, "--peak-of") {
        return print_peak(model);
    }
    let rounds = value_of(&arguments, "--rounds").and_then(|n| n.parse().ok()).unwrap_or(7);
    let verify = if arguments.iter().any(|a| a == "--full") { Verify::Full } else { Verify::Fast };
    if arguments.iter().any(|argument| argument == "--corpus") {
        return corpus(rounds);
    }
    if let Some(cubes) = value_of(&arguments, "--cubes").and_then(|n| n.parse().ok()) {
        let name = format!("cube field, {} triangles", cubes * 12);
        return table(&name, &cube_field(cubes), verify, rounds);
    }
    if let Some(across) = value_of(&arguments, "--terrain").and_then(|n| n.parse().ok()) {
        return table("terrain", &worst::terrain(across, true), verify, rounds);
    }
    for cubes in CUBES {
        table(&format!("cube field, {} triangles", cubes * 12), &cube_field(cubes), verify, rounds);
    }
    table("smooth sphere", &smooth_sphere(), verify, rounds);
    for model in ["field", "sphere"] {
        let program = std::env::current_exe().expect("a running program has a path");
        let status = std::process::Command::new(program).args(["--peak-of", model]).status();
        assert!(status.is_ok_and(|status| status.success()), "the peak of {model} is not known");
    }
}

/// The corpus as a whole, `full` in terms of `fast`, and the meshes that are slow to drag.
fn corpus(rounds: usize) {
    let read = ReadOptions::default();
    let (mut fast, mut full, mut triangles) = (Duration::ZERO, Duration::ZERO, 0);
    for path in measure::models(Path::new(measure::FOLDER)) {
        let Ok(document) = formats::read(&path, &read) else { continue };
        for source in document.meshes() {
            let mesh = source.mesh.as_mesh();
            let time = |verify| {
                let width = Width::PercentOfExtent(CORPUS_PERCENT);
                let options = Options::default().with_width(width).with_verify(verify);
                median(rounds, || drop(black_box(chamfer(&mesh, &options))))
            };
            let [own_fast, own_full] = [Verify::Fast, Verify::Full].map(time);
            let count = mesh.indices.len() / 3;
            if own_fast > LONGEST_DRAG && count <= MOST_DRAGGED {
                let name = path.file_name().unwrap_or_default().to_string_lossy();
                let times = [own_fast, own_full].map(|time| time.as_secs_f64() * 1e3);
                println!(
                    "{name}: {count} triangles, fast {:.1} ms, full {:.1} ms",
                    times[0], times[1]
                );
            }
            fast += own_fast;
            full += own_full;
            triangles += count;
        }
    }
    println!(
        "corpus: {triangles} triangles, fast {:.0} ms, full {:.0} ms: {:.2} x",
        fast.as_secs_f64() * 1e3,
        full.as_secs_f64() * 1e3,
        full.as_secs_f64() / fast.as_secs_f64().max(f64::MIN_POSITIVE),
    );
}

fn value_of<'a>(arguments: &'a [String], name: &str) -> Option<&'a str> {
    let place = arguments.iter().position(|argument| argument == name)?;
    arguments.get(place + 1).map(String::as_str)
}

/// Times and their ratios for one model.
fn table(name: &str, mesh: &MeshBuffers, verify: Verify, rounds: usize) {
    let triangles = mesh.indices.len() as f64 / 3.0;
    let row = |what: &str, time: Duration, floor: Duration| {
        let each = time.as_secs_f64() / triangles * 1e9;
        let ratio = time.as_secs_f64() / floor.as_secs_f64();
        println!("{what:<24}{:>10.2} ms{each:>9.1} ns{ratio:>8.2} x", time.as_secs_f64() * 1e3);
    };
    let remap = median(rounds, || drop(black_box(position_remap(mesh))));
    println!("{name}: time, time for each triangle, in terms of the position remap");
    row("position remap", remap, remap);
    let [one, two] = [1, 2].map(|threads| options(verify, threads));
    let result = chamfer(&mesh.as_mesh(), &one).expect("the model is sound");
    row("copy of in and output", median(rounds, || drop(black_box(copy(mesh, &result)))), remap);
    drop(result);
    let whole = |options| median(rounds, || drop(black_box(chamfer(&mesh.as_mesh(), &options))));
    row("chamfer, one thread", whole(one), remap);
    row("chamfer, two threads", whole(two), remap);
    println!("stages of the whole mesh at once: one thread, two threads");
    let [alone, shared] = [one, two].map(|options| middle_stage_times(mesh, &options, rounds));
    for ((stage, alone), (_, shared)) in alone.iter().zip(&shared) {
        let [alone, shared] = [alone, shared].map(Duration::as_secs_f64);
        let name = format!("  {stage:?}").to_lowercase();
        println!(
            "{name:<24}{:>10.2} ms{:>10.2} ms{:>8.2}",
            alone * 1e3,
            shared * 1e3,
            shared / alone
        );
    }
    println!();
}

fn middle_stage_times(
    mesh: &MeshBuffers,
    options: &Options,
    rounds: usize,
) -> Vec<(Stage, Duration)> {
    let runs: Vec<_> = (0..rounds).map(|_| stage_times(mesh, options)).collect();
    let middle_of =
        |place: usize| middle(&mut runs.iter().map(|run| run[place].1).collect::<Vec<_>>());
    runs[0].iter().enumerate().map(|(place, &(stage, _))| (stage, middle_of(place))).collect()
}

fn median(rounds: usize, mut call: impl FnMut()) -> Duration {
    let time = |_| {
        let start = Instant::now();
        call();
        start.elapsed()
    };
    middle(&mut (0..rounds).map(time).collect::<Vec<_>>())
}

fn middle(times: &mut [Duration]) -> Duration {
    times.sort_unstable();
    let takes_least = std::env::args().any(|argument| argument == "--least");
    times[if takes_least { 0 } else { times.len() / 2 }]
}

/// Runs one chamfer in a process of its own, and tells its peak memory.
fn print_peak(model: &str) {
    let mesh = if model == "field" { cube_field(CUBES[2]) } else { smooth_sphere() };
    let before = peak();
    let result = chamfer(&mesh.as_mesh(), &options(Verify::Fast, 1)).expect("the model is sound");
    let (input, output) = (bytes(&mesh), bytes(&result.mesh) + provenance(&result));
    let mega = |bytes: u64| bytes as f64 / 1e6;
    println!(
        "peak memory, {model}: {:.0} MB (before the call {:.0} MB), {:.2} x input and output ({:.0} and {:.0} MB)",
        mega(peak()),
        mega(before),
        peak() as f64 / (input + output) as f64,
        mega(input),
        mega(output),
    );
}

fn bytes(mesh: &MeshBuffers) -> u64 {
    let floats = mesh.positions.len() * 6
        + (mesh.tangents.len() + mesh.colors.len()) * 4
        + mesh.uvs.iter().map(|uv| uv.values.len()).sum::<usize>();
    4 * (floats + mesh.indices.len()) as u64
}

/// Without that of vertices, which is kept compact.
fn provenance(result: &chamfer::Chamfered) -> u64 {
    (size_of_val(&*result.triangle_sources) + size_of_val(&*result.verdicts)) as u64
}

/// The most memory that this process ever had, in bytes; 0 where the system does not tell.
fn peak() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    let kilobytes = line.and_then(|line| line.split_whitespace().next()?.parse::<u64>().ok());
    kilobytes.unwrap_or(0) * 1024
}
