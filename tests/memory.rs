//! How much memory a call takes, and asks for before it takes it.

use std::alloc::{GlobalAlloc, Layout, System};
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

use chamfer::{Held, Mesh, MeshBuffers, Options, UvBuffer, Verify, Width, chamfer, shapes};

#[path = "support/shaded.rs"]
mod shaded;

/// Bytes that are allocated now, the most at one time, and the most that had been asked for by then.
static NOW: AtomicUsize = AtomicUsize::new(0);
static MOST: AtomicUsize = AtomicUsize::new(0);
static ASKED: AtomicUsize = AtomicUsize::new(0);

struct Counting;

/// What a call asks for is a piece of at least so many bytes, without alignment.
const LEAST_ASKED: usize = 1 << 20;

fn is_asking(layout: Layout) -> bool {
    layout.align() == 1 && layout.size() >= LEAST_ASKED
}

// SAFETY: the system's allocator does all; only sizes are added up.
#[allow(unsafe_code)]
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        if is_asking(layout) {
            ASKED.fetch_max(NOW.load(Relaxed) + layout.size(), Relaxed);
        } else {
            let now = NOW.fetch_add(layout.size(), Relaxed) + layout.size();
            MOST.fetch_max(now, Relaxed);
        }
        // SAFETY: as this function's.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        if !is_asking(layout) {
            NOW.fetch_sub(layout.size(), Relaxed);
        }
        // SAFETY: as this function's.
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// The most bytes that a call takes beside its input, and the most that it asks for.
fn taken_and_asked(mesh: &Mesh, options: &Options) -> [usize; 2] {
    let before = NOW.load(Relaxed);
    MOST.store(before, Relaxed);
    ASKED.store(before, Relaxed);
    assert!(chamfer(mesh, options).is_ok());
    [&MOST, &ASKED].map(|bytes| bytes.load(Relaxed) - before)
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

/// Loose triangles: every side of theirs is a border.
fn soup(triangles: u32) -> MeshBuffers {
    let corner = |k: u32| [(k * 7 % 101) as f32, (k * 13 % 89) as f32, (k * 29 % 97) as f32];
    let points: Vec<[f32; 3]> = (0..3 * triangles).map(corner).collect();
    shaded::shaded(&points, &(0..3 * triangles).collect::<Vec<_>>(), shaded::FLAT)
}

#[test]
fn a_call_takes_no_more_memory_than_it_asked_for() {
    // Of the first two it may ask for no more than twice what it takes.
    let cases = [
        ("cubes", shapes::cube_field(6000)),
        ("sphere", shapes::sphere(300, 300)),
        ("nothing", MeshBuffers::default()),
        ("cone", shapes::pyramid(2000)),
        ("ground", rough_ground(80)),
        ("soup", soup(6000)),
        ("dressed cubes", dressed(shapes::cube_field(600))),
        ("dressed ground", dressed(rough_ground(80))),
        ("dressed cone", dressed(shapes::pyramid(2000))),
    ];
    for (place, (name, mesh)) in cases.into_iter().enumerate() {
        // Of the large ones, pictures would take long.
        let is_large = place < 2;
        let all = [Verify::Fast, Verify::Full, Verify::Seen];
        for &verify in &all[..if is_large { 2 } else { 3 }] {
            for percent in [0.5, 20.0] {
                let width = Width::PercentOfExtent(percent);
                let options = Options::default().with_width(width).with_verify(verify);
                let [taken, asked] = taken_and_asked(&mesh.as_mesh(), &options);
                let case = format!("{name}, {verify:?}, {percent} %: {taken} of {asked}");
                println!("{case}");
                // A quarter is for allocators, which lose some between the pieces.
                assert!(taken + taken / 4 <= asked, "{case}");
                assert!(!is_large || asked <= 2 * taken + LEAST_ASKED, "{case}");
            }
        }
    }
    // One test: what is counted is counted for all.
    edges_that_get_vertices_take_no_more();
    what_a_stage_leaves_behind_is_given_back();
    the_peak_is_a_few_times_input_and_output();
}

/// The most bytes at one time, the input among them, for each byte of input and output, with `fast` and
/// with `full`; each a twentieth above what it takes. Blocks are put together as they are made, and
/// what some of them take is little beside that.
const MOST_OF_BLOCKS: [f64; 2] = [2.3; 2];

/// A smooth mesh is welded and copied, and nothing else.
const MOST_OF_SMOOTH: [f64; 2] = [1.1; 2];

/// One large part has what all stages know of it at the same time, beside the result, and with `full` the
/// tree in which collisions are looked for.
const MOST_OF_ONE_PART: [f64; 2] = [4.3, 5.7];

fn the_peak_is_a_few_times_input_and_output() {
    let width = Width::Units(0.02);
    for (name, mesh, most) in [
        ("blocks", shapes::cube_field(6000), MOST_OF_BLOCKS),
        ("smooth", shapes::sphere(300, 300), MOST_OF_SMOOTH),
        ("terrain", rough_ground(150), MOST_OF_ONE_PART),
    ] {
        for (verify, most) in [Verify::Fast, Verify::Full].into_iter().zip(most) {
            let options = Options::default().with_width(width).with_verify(verify);
            let [taken, _] = taken_and_asked(&mesh.as_mesh(), &options);
            let result = chamfer(&mesh.as_mesh(), &options).unwrap();
            let told = size_of_val(&*result.triangle_sources) + size_of_val(&*result.verdicts);
            let [input, output] = [bytes(&mesh), bytes(&result.mesh) + told];
            let times = (input + taken) as f64 / (input + output) as f64;
            println!("{name}, {verify:?}: {times:.2} times {input} and {output} bytes");
            assert!(times <= most, "{name}, {verify:?}: {times:.2} times input and output");
        }
    }
}

fn bytes(mesh: &MeshBuffers) -> usize {
    size_of_val(&*mesh.positions)
        + size_of_val(&*mesh.normals)
        + size_of_val(&*mesh.tangents)
        + size_of_val(&*mesh.colors)
        + mesh.uvs.iter().map(|uv| size_of_val(&*uv.values)).sum::<usize>()
        + size_of_val(&*mesh.indices)
}

/// The most bytes for each source triangle of a field of cubes that is done as a whole: all its edges
/// are hard, and each triangle becomes four.
const MOST_PER_TRIANGLE: usize = 1120;

/// So many cubes are too few to be done in blocks.
fn what_a_stage_leaves_behind_is_given_back() {
    let cubes = shapes::cube_field(2400);
    for verify in [Verify::Fast, Verify::Full] {
        let options = Options::default().with_width(Width::Units(0.02)).with_verify(verify);
        let [taken, _] = taken_and_asked(&cubes.as_mesh(), &options);
        let each = taken / (cubes.indices.len() / 3);
        println!("undivided cubes, {verify:?}: {each} bytes a triangle");
        assert!(each <= MOST_PER_TRIANGLE, "{verify:?}: {each}");
    }
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
        let width = Width::PercentOfExtent(0.1);
        let options = Options::default().with_width(width).with_verify(verify);
        assert!(chamfer(&mesh, &options).unwrap().pieces.len() > 800, "they are cut");
        let [taken, asked] = taken_and_asked(&mesh, &options);
        println!("held cubes, {verify:?}: {taken} of {asked}");
        assert!(taken + taken / 4 <= asked, "{verify:?}: {taken} of {asked}");
    }
}
