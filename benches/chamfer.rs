//! How long a chamfer takes, whole and stage by stage, beside what its floor is.
//!
//! `cargo bench`; `cargo run --release --example ratios` prints the same as a table of ratios.

#[allow(dead_code)]
#[path = "../tests/corpus/measure.rs"]
mod measure;
#[path = "support/models.rs"]
mod models;

use std::hint::black_box;
use std::path::Path;
use std::time::Duration;

use chamfer::{MeshBuffers, Options, Stage, Verify, Width, chamfer};
use chamfer_formats as formats;
use chamfer_formats::ReadOptions;
use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, Criterion, Throughput, criterion_group, criterion_main};

/// In percent of each model's extent.
const CORPUS_PERCENT: f32 = 1.0;

type Group<'a> = BenchmarkGroup<'a, WallTime>;

fn all(criterion: &mut Criterion) {
    for cubes in models::CUBES {
        let name = format!("cube field of {}", cubes * 12);
        model(criterion, &name, &models::cube_field(cubes));
    }
    model(criterion, "smooth sphere", &models::smooth_sphere());
    corpus(criterion);
}

fn model(criterion: &mut Criterion, name: &str, mesh: &MeshBuffers) {
    let mut group = criterion.benchmark_group(name);
    group.sample_size(10).throughput(Throughput::Elements(mesh.indices.len() as u64 / 3));
    group.bench_function("position remap", |b| b.iter(|| models::position_remap(mesh)));
    let one = models::options(Verify::Fast, 1);
    let Ok(result) = chamfer(&mesh.as_mesh(), &one) else { return };
    group.bench_function("copy", |b| b.iter(|| models::copy(mesh, &result)));
    drop(result);
    whole(&mut group, "fast", mesh, one);
    whole(&mut group, "fast, two threads", mesh, one.with_threads(2));
    whole(&mut group, "full", mesh, one.with_verify(Verify::Full));
    for (stage, _) in models::stage_times(mesh, &one) {
        group.bench_function(format!("stage {stage:?}"), |b| {
            b.iter_custom(|rounds| (0..rounds).map(|_| time_of(mesh, &one, stage)).sum());
        });
    }
}

fn whole(group: &mut Group, name: &str, mesh: &MeshBuffers, options: Options) {
    group.bench_function(name, |b| b.iter(|| black_box(chamfer(&mesh.as_mesh(), &options))));
}

fn time_of(mesh: &MeshBuffers, options: &Options, wanted: Stage) -> Duration {
    let times = models::stage_times(mesh, options);
    times.into_iter().filter(|(stage, _)| *stage == wanted).map(|(_, time)| time).sum()
}

/// All models of the corpus, one after the other; nothing without them.
fn corpus(criterion: &mut Criterion) {
    let read = ReadOptions::default();
    let documents: Vec<_> = measure::models(Path::new(measure::FOLDER))
        .iter()
        .filter_map(|path| formats::read(path, &read).ok())
        .collect();
    if documents.is_empty() {
        return println!("SKIPPED: no models in {}", measure::FOLDER);
    }
    let mut group = criterion.benchmark_group("corpus");
    group.sample_size(10);
    for verify in [Verify::Fast, Verify::Full] {
        let width = Width::PercentOfExtent(CORPUS_PERCENT);
        let options = Options::default().with_width(width).with_verify(verify).with_threads(1);
        group.bench_function(format!("{verify:?}").to_lowercase(), |b| {
            b.iter(|| {
                for source in documents.iter().flat_map(|document| document.meshes()) {
                    let _ = black_box(chamfer(&source.mesh.as_mesh(), &options));
                }
            });
        });
    }
}

criterion_group!(benches, all);
criterion_main!(benches);
