//! The worst shapes at two sizes each: four times the size should take about four times as long.
//!
//! `cargo bench --bench worst`

#[path = "../tests/support/shaded.rs"]
mod shaded;
#[path = "../tests/support/worst.rs"]
mod worst;

use std::hint::black_box;

use chamfer::{MeshBuffers, Options, Verify, Width, chamfer, shapes};
use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};

/// A shape of that size.
type Make = fn(u32) -> MeshBuffers;

/// The larger of the two sizes, in what the shape counts.
const SHAPES: &[(&str, u32, Make)] = &[
    ("flat fan", 100_000, |size| worst::fan(size, true)),
    ("smooth fan", 100_000, |size| worst::fan(size, false)),
    ("pyramid", 100_000, shapes::pyramid),
    ("book", 10_000, worst::book),
    ("point", 100_000, worst::point),
    ("stack", 10_000, worst::stack),
    ("moebius strip", 25_000, worst::moebius_strip),
    ("klein bottle", 3_000, worst::klein_bottle),
    // A million borders, each of which may rest on something.
    ("posts", 125_000, worst::posts),
    ("spikes", 12_000, worst::spikes),
    ("star cone", 18_000, worst::star_cone),
    ("gear cone", 9_000, worst::gear_cone),
    ("wedges", 4_000, worst::wedges),
    ("turned quads", 25_000, worst::turned_quads),
    // So many quads each way.
    ("hills", 300, |size| worst::terrain(size, false)),
    ("hills with a texture", 300, |size| worst::terrain(size, true)),
    // So many holes each way.
    ("sieve", 316, worst::sieve),
    ("disc", 100_000, shapes::prism),
    ("bar", 12_500, worst::bar),
    ("slivers", 8_000, worst::slivers),
    ("huge cubes", 8_000, |size| worst::placed(shapes::cube_field(size), 1e30, 0.0)),
    ("tiny cubes", 8_000, |size| worst::placed(shapes::cube_field(size), 1e-30, 0.0)),
    ("denormal cubes", 8_000, |size| worst::placed(shapes::cube_field(size), 1e-42, 0.0)),
    ("far cubes", 8_000, |size| worst::placed(shapes::cube_field(size), 1.0, 1e6)),
];

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
