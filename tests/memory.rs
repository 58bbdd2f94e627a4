//! How much memory a call takes at most, against the bound that it asks for beforehand.

use std::alloc::{GlobalAlloc, Layout, System};
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

use chamfer::{
    Held, Mesh, MeshBuffers, Options, UvBuffer, Verify, Width, chamfer_with_progress, most_memory,
    shapes,
};

#[path = "support/shaded.rs"]
mod shaded;

/// Counts what is allocated, and the most that ever was.
struct Counting;

static NOW: AtomicUsize = AtomicUsize::new(0);
static MOST: AtomicUsize = AtomicUsize::new(0);

// SAFETY: all is handed to the system's allocator.
#[allow(unsafe_code)]
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        let now = NOW.fetch_add(layout.size(), Relaxed) + layout.size();
        MOST.fetch_max(now, Relaxed);
        // SAFETY: as this function's.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        NOW.fetch_sub(layout.size(), Relaxed);
        // SAFETY: as this function's.
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// The most bytes that a call takes beside its input. What it asks for beforehand is left out.
fn most_during(mesh: &Mesh, options: &Options) -> u64 {
    let before = NOW.load(Relaxed);
    let result = chamfer_with_progress(mesh, options, &mut |done| {
        if done < 0.2 {
            MOST.store(NOW.load(Relaxed), Relaxed);
        }
        ControlFlow::Continue(())
    });
    assert!(result.is_ok());
    (MOST.load(Relaxed) - before) as u64
}

/// With every stream, the texture coordinates at odds across each edge.
fn dressed(mut mesh: MeshBuffers) -> MeshBuffers {
    let count = mesh.positions.len();
    mesh.tangents = vec![[1.0, 0.0, 0.0, 1.0]; count];
    mesh.colors = vec![[0.5; 4]; count];
    for (channel, uv) in mesh.uvs.iter_mut().enumerate() {
        let values = (0..count * 4).map(|place| (place * 7 % (channel + 11)) as f32).collect();
        *uv = UvBuffer { components: 4, values };
    }
    mesh
}

/// A terrain whose every edge is hard: no shape has more chamfers for its size.
fn rough_ground(side: u32) -> MeshBuffers {
    let height = |x: u32, z: u32| ((x * 7 + z * 13) % 5) as f32 / 3.0;
    let at = |place: u32| (place / side, place % side);
    let points: Vec<[f32; 3]> =
        (0..side * side).map(at).map(|(x, z)| [x as f32, height(x, z), z as f32]).collect();
    let cells = (0..side * side).filter(|&place| at(place).0 + 1 < side && at(place).1 + 1 < side);
    let indices: Vec<u32> =
        cells.flat_map(|a| [a, a + 1, a + side + 1, a, a + side + 1, a + side]).collect();
    shaded::shaded(&points, &indices, shaded::FLAT)
}

#[test]
fn a_call_takes_no_more_memory_than_it_asked_for() {
    let cases = [
        ("nothing", MeshBuffers::default()),
        ("cubes", shapes::cube_field(600)),
        ("sphere", shapes::sphere(100, 100)),
        ("cone", shapes::pyramid(2000)),
        ("ground", rough_ground(80)),
        ("dressed cubes", dressed(shapes::cube_field(600))),
        ("dressed ground", dressed(rough_ground(80))),
        ("dressed cone", dressed(shapes::pyramid(2000))),
    ];
    let mut fullest = 0.0_f64;
    for (name, mesh) in cases {
        for verify in [Verify::Fast, Verify::Full, Verify::Seen] {
            for percent in [0.5, 20.0] {
                let width = Width::PercentOfExtent(percent);
                let options = Options { width, verify, ..Options::default() };
                let (bound, most) =
                    (most_memory(&mesh.as_mesh(), verify), most_during(&mesh.as_mesh(), &options));
                println!("{name}, {verify:?}, {percent} %: {most} of {bound}");
                // Half of it is for allocators, which lose some between the pieces.
                // A call that looks may run again, and then asks for what it takes once more.
                let again = u64::from(verify == Verify::Seen);
                let most = most.saturating_sub(again * most_memory(&mesh.as_mesh(), Verify::Full));
                assert!(2 * most <= bound, "{name}, {verify:?}, {percent} %: {most} of {bound}");
                fullest = fullest.max(most as f64 / bound as f64);
            }
        }
    }
    assert!(fullest > 0.25, "the bound is far too high: at most {fullest} of it is used");
    // One test: what is counted is counted for all.
    edges_that_get_vertices_take_no_more();
}

/// Cubes on whose edges something rests in the middle: as many vertices as a mesh may get.
fn edges_that_get_vertices_take_no_more() {
    let cubes = dressed(shapes::cube_field(600));
    let middles = cubes.indices.chunks_exact(36).take(150).map(|cube| {
        let at = |corner: usize| cubes.positions[cube[corner] as usize];
        let (from, to) = (at(0), at(1));
        let mix = |share: f32| std::array::from_fn(|k| from[k] + (to[k] - from[k]) * share);
        Held { from: mix(0.45), to: mix(0.55), radius: 0.0 }
    });
    let held: Vec<Held> = middles.collect();
    let mesh = Mesh { held: &held, ..cubes.as_mesh() };
    for verify in [Verify::Fast, Verify::Full] {
        let options = Options { width: Width::PercentOfExtent(0.1), verify, ..Options::default() };
        let result = chamfer_with_progress(&mesh, &options, &mut |_| ControlFlow::Continue(()));
        assert!(result.unwrap().pieces.len() > 800, "they are cut");
        let (bound, most) = (most_memory(&mesh, verify), most_during(&mesh, &options));
        println!("held cubes, {verify:?}: {most} of {bound}");
        assert!(2 * most <= bound, "{verify:?}: {most} of {bound}");
    }
}
