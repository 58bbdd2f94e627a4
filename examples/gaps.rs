//! Prints the longest time that passes without a word to whoever waits for a call, one thread.
//!
//! `cargo run --release --example gaps [-- NAME..]`
//!
//! Of the worst shapes, or of those whose names begin so. Each time is the least of a few runs, as a
//! machine may have other work to do.

#[path = "../tests/support/shaded.rs"]
mod shaded;
#[path = "../benches/support/shapes.rs"]
mod sizes;
#[path = "../tests/support/worst.rs"]
mod worst;

use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use chamfer::{MeshBuffers, Options, Verify, Width, chamfer_with_progress, shapes};
use sizes::SHAPES;

/// Runs of each.
const RUNS: usize = 3;

/// The largest field of cubes that others measure, in cubes.
const FIELD: u32 = 80_000;

fn main() {
    let names: Vec<String> = std::env::args().skip(1).collect();
    let percent = Width::PercentOfExtent(1.0);
    let full = Options::default().with_threads(1).with_verify(Verify::Full).with_width(percent);
    let is_asked =
        |name: &str| names.is_empty() || names.iter().any(|asked| name.starts_with(asked.as_str()));
    for &(name, size, make) in SHAPES.iter().filter(|shape| is_asked(shape.0)) {
        print_longest(name, &make(size), &full);
    }
    if is_asked("field") {
        let narrow = full.with_width(Width::Units(0.05));
        print_longest("field", &shapes::cube_field(FIELD), &narrow);
    }
}

fn print_longest(name: &str, mesh: &MeshBuffers, options: &Options) {
    let runs: Vec<Vec<(Duration, f32)>> = (0..RUNS).map(|_| gaps(mesh, options)).collect();
    // Calls come at the same steps in each run.
    let least = |call: usize| runs.iter().map(|gaps| gaps[call]).min_by_key(|gap| gap.0);
    let longest = (0..runs[0].len()).filter_map(least).max_by_key(|gap| gap.0);
    if let Some((time, share)) = longest {
        let (triangles, milliseconds) = (mesh.indices.len() / 3, time.as_secs_f64() * 1e3);
        println!("{name}: {triangles} triangles, {milliseconds:.0} ms before {share:.2} is told");
    }
}

/// The time before each call of progress, and what that tells; the last before the end.
fn gaps(mesh: &MeshBuffers, options: &Options) -> Vec<(Duration, f32)> {
    let (mut gaps, mut last) = (Vec::new(), Instant::now());
    let result = chamfer_with_progress(&mesh.as_mesh(), options, &mut |share| {
        gaps.push((last.elapsed(), share));
        last = Instant::now();
        ControlFlow::Continue(())
    });
    gaps.push((last.elapsed(), 1.0));
    if let Err(error) = result {
        println!("{error}");
    }
    gaps
}
