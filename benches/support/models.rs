//! Models and rivals of the benchmarks.

use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use chamfer::{Chamfered, MeshBuffers, Options, Stage, Verify, Width, chamfer_by_stages, shapes};
use meshopt::VertexDataAdapter;

/// Cubes in a field of 12,000, of 120,000 and of 1,000,008 triangles.
pub const CUBES: [u32; 3] = [1_000, 10_000, 83_334];

/// The chamfer width on the unit cubes of a field.
pub const WIDTH: f32 = 0.05;

/// Every edge hard: positions, normals and one UV channel.
pub fn cube_field(cubes: u32) -> MeshBuffers {
    shapes::cube_field(cubes)
}

/// A million triangles and no hard edge, with the same streams as a cube field.
pub fn smooth_sphere() -> MeshBuffers {
    MeshBuffers { tangents: Vec::new(), ..shapes::sphere(501, 1000) }
}

pub fn options(verify: Verify, threads: u32) -> Options {
    Options::default().with_width(Width::Units(WIDTH)).with_verify(verify).with_threads(threads)
}

/// What meshoptimizer, the fastest public way, takes to find equal positions alone.
pub fn position_remap(mesh: &MeshBuffers) -> Vec<u32> {
    let bytes: &[u8] = meshopt::typed_to_bytes(&mesh.positions);
    let adapter = VertexDataAdapter::new(bytes, size_of::<[f32; 3]>(), 0);
    meshopt::generate_position_remap(&adapter.expect("positions are whole vertices"))
}

/// The floor of memory: all that goes in and all that comes out, copied once.
pub fn copy(mesh: &MeshBuffers, result: &Chamfered) -> (MeshBuffers, Chamfered) {
    (mesh.clone(), result.clone())
}

/// How long each stage takes.
pub fn stage_times(mesh: &MeshBuffers, options: &Options) -> Vec<(Stage, Duration)> {
    let mut times = Vec::new();
    let mut last = Instant::now();
    let timed = chamfer_by_stages(&mesh.as_mesh(), options, &mut |stage| {
        times.push((stage, last.elapsed()));
        last = Instant::now();
        ControlFlow::Continue(())
    });
    drop(timed);
    times
}
