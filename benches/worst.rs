//! The worst shapes at two sizes each: four times the size should take about four times as long.
//!
//! `cargo bench --bench worst`

#[path = "../tests/support/shaded.rs"]
mod shaded;
#[path = "support/shapes.rs"]
mod sizes;
#[path = "../tests/support/worst.rs"]
mod worst;

use std::hint::black_box;

use chamfer::{Options, Verify, Width, chamfer};
use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use sizes::SHAPES;

fn worst_shapes(criterion: &mut Criterion) {
    let options =
        Options::default().with_width(Width::PercentOfExtent(1.0)).with_verify(Verify::Full);
    for &(name, size, make) in SHAPES {
        let mut group = criterion.benchmark_group(name);
        group.sample_size(10);
        for size in [size / 4, size] {
            let mesh = make(size);
            group.throughput(Throughput::Elements(mesh.indices.len() as u64 / 3));
            group.bench_with_input(BenchmarkId::from_parameter(size), &mesh, |bencher, mesh| {
                bencher.iter(|| black_box(chamfer(&mesh.as_mesh(), &options)));
            });
        }
        group.finish();
    }
}

criterion_group!(benches, worst_shapes);
criterion_main!(benches);
