//! The C interface on structs of arbitrary content over memory that is there.
#![no_main]

use std::ffi::c_void;
use std::{ptr, slice};

use arbitrary::Arbitrary;
use chamfer_fuzz::c_interface::*;
use chamfer_fuzz::meshes::Spec;
use libfuzzer_sys::fuzz_target;

#[derive(Arbitrary, Debug)]
struct Input {
    mesh: Spec,
    held: Vec<Held>,
    factors: Factors,
    objects: Vec<Object>,
    pointers: Pointers,
    mesh_size: Size,
    options: Options,
    options_size: Size,
    out: Pointer,
    error: ErrorWish,
    /// After how many calls to cancel.
    cancel_after: Option<u8>,
    angle: f32,
}

#[derive(Arbitrary, Debug)]
struct Pointers {
    mesh: Pointer,
    options: Pointer,
    streams: [Pointer; 6],
    uv: Pointer,
    held: Pointer,
    factors: [Pointer; 3],
    meshes: Pointer,
    objects: Pointer,
}

/// A held place in eighths of a unit, and anything in one of its numbers.
#[derive(Arbitrary, Debug)]
struct Held {
    eighths: [i8; 7],
    any: Option<(u8, f32)>,
}

/// In eighths, with any number as one of the listed edges.
#[derive(Arbitrary, Debug)]
struct Factors {
    submeshes: Option<[u8; 8]>,
    /// Each vertex has one of these.
    vertices: Option<[u8; 4]>,
    edges: Vec<([u8; 2], u8)>,
    any: Option<([u32; 2], f32)>,
}

/// Moved and scaled in eighths, with anything in one place of its transform.
#[derive(Arbitrary, Debug)]
struct Object {
    mesh: u8,
    eighths: [[i8; 3]; 2],
    any: Option<(u8, f32)>,
}

/// A scene gives two, all other calls one.
const MOST_RESULTS: usize = 2;

/// So that a scene does not take longer than a mesh.
const MOST_HELD: usize = 8;
const MOST_OBJECTS: usize = 4;
const MOST_EDGES: usize = 64;

fn raw_held(wish: &Held) -> chamfer_held {
    let mut values = wish.eighths.map(|eighths| f32::from(eighths) / 8.0);
    if let Some((place, value)) = wish.any {
        values[usize::from(place) % 7] = value;
    }
    let [a, b, c, d, e, f, radius] = values;
    chamfer_held { from: [a, b, c], to: [d, e, f], radius }
}

fn raw_edges(wish: &Factors) -> Vec<chamfer_edge_factor> {
    let listed = wish.edges.iter().take(MOST_EDGES).map(|&(vertices, eighths)| {
        chamfer_edge_factor { vertices: vertices.map(u32::from), factor: eighth(eighths) }
    });
    let any = wish.any.map(|(vertices, factor)| chamfer_edge_factor { vertices, factor });
    listed.chain(any).collect()
}

fn eighth(count: u8) -> f32 {
    f32::from(count) / 8.0
}

/// So many, one after the other and again from the first.
fn repeated(eighths: &[u8], count: u32) -> Vec<f32> {
    eighths.iter().copied().map(eighth).cycle().take(count as usize).collect()
}

fn raw_object(wish: &Object) -> chamfer_object {
    let [scale, shift] = wish.eighths.map(|row| row.map(|eighths| f32::from(eighths) / 8.0));
    let mut transform = [0.0; 16];
    for axis in 0..3 {
        transform[5 * axis] = scale[axis];
        transform[12 + axis] = shift[axis];
    }
    if let Some((place, value)) = wish.any {
        transform[usize::from(place) % 16] = value;
    }
    chamfer_object { mesh: u32::from(wish.mesh % 3), transform }
}

#[derive(Arbitrary, Debug, Clone, Copy, PartialEq)]
enum Pointer {
    Right,
    /// So that most are right.
    RightToo,
    AlsoRight,
    Null,
    Misaligned,
}

impl Pointer {
    fn of<T>(self, right: *const T) -> *const T {
        match self {
            Pointer::Right | Pointer::RightToo | Pointer::AlsoRight => right,
            Pointer::Null => ptr::null(),
            Pointer::Misaligned => right.wrapping_byte_add(1),
        }
    }
}

/// What a struct says of its own size, and the bytes behind it.
#[derive(Arbitrary, Debug)]
enum Size {
    Right,
    RightToo,
    Longer(u8, bool),
    Any(u32),
}

#[derive(Arbitrary, Debug)]
struct Options {
    width: f32,
    is_small: bool,
    choices: [u8; 5],
    submesh: u8,
    threads: u8,
    least_breadth: f32,
    /// Least and largest in degrees, and the hard one.
    angles: Option<[u8; 3]>,
    any_angles: Option<[f32; 3]>,
    /// In eighths.
    scale: Option<[i8; 9]>,
    any_scale: Option<(u8, f32)>,
    segments: Option<u32>,
    profile: Option<f32>,
    evenness: Option<f32>,
}

#[derive(Arbitrary, Debug)]
enum ErrorWish {
    Right,
    RightToo,
    Null,
    Sized(Size),
}

/// A struct in memory of exactly as many bytes as it states to have.
struct Placed {
    words: Vec<u64>,
    shift: usize,
}

/// No struct is longer for the library: the bytes behind need not be there.
const LONGEST: usize = 4096;

impl Placed {
    fn new<T: Copy>(value: &T, size: &Size) -> Placed {
        let known = size_of::<T>();
        let (stated, tail) = match *size {
            Size::Right | Size::RightToo => (known as u32, 0),
            Size::Longer(by, zero) => ((known + usize::from(by)) as u32, u8::from(!zero)),
            Size::Any(size) => (size, 0),
        };
        let there = (stated as usize).clamp(4, LONGEST);
        let words = vec![0; (there + 8).div_ceil(8)];
        // At the end of the memory, so that a byte read past it is noticed, where alignment lets it.
        let shift = (words.len() * 8 - there) / align_of::<T>() * align_of::<T>();
        let mut placed = Placed { words, shift };
        let bytes = placed.bytes();
        bytes.fill(tail);
        // SAFETY: `T` is one of the header's structs, whose bytes may be looked at.
        let from = unsafe { slice::from_raw_parts(ptr::from_ref(value).cast::<u8>(), known) };
        let both = known.min(bytes.len());
        bytes[..both].copy_from_slice(&from[..both]);
        bytes[..4].copy_from_slice(&stated.to_ne_bytes());
        placed
    }

    fn bytes(&mut self) -> &mut [u8] {
        let whole = self.words.len() * 8;
        // SAFETY: words are made of bytes.
        let bytes = unsafe { slice::from_raw_parts_mut(self.words.as_mut_ptr().cast(), whole) };
        &mut bytes[self.shift..]
    }

    fn pointer<T>(&mut self) -> *mut T {
        self.bytes().as_mut_ptr().cast()
    }
}

struct Progress {
    calls: u32,
    cancel_after: u32,
}

unsafe extern "C" fn note(user: *mut c_void, done: f32) -> i32 {
    assert!((0.0..=1.0).contains(&done));
    // SAFETY: the call below hands one over.
    let progress = unsafe { &mut *user.cast::<Progress>() };
    assert!(progress.calls < progress.cancel_after, "called again after it cancelled");
    progress.calls += 1;
    i32::from(progress.calls >= progress.cancel_after)
}

fuzz_target!(|input: Input| {
    let memory = Memory::new(&input.mesh.mesh());
    let mut mesh = memory.view();
    let wish = &input.pointers;
    mesh.positions = wish.streams[0].of(mesh.positions);
    mesh.normals = wish.streams[1].of(mesh.normals);
    mesh.tangents = wish.streams[2].of(mesh.tangents);
    mesh.colors = wish.streams[3].of(mesh.colors);
    mesh.indices = wish.streams[4].of(mesh.indices);
    mesh.submesh_index_counts = wish.streams[5].of(mesh.submesh_index_counts);
    mesh.uvs[0].values = wish.uv.of(mesh.uvs[0].values);
    let held: Vec<_> = input.held.iter().take(MOST_HELD).map(raw_held).collect();
    mesh.held_count = held.len() as u32;
    mesh.held = wish.held.of(held.as_ptr());
    let factors = &input.factors;
    let submeshes = factors.submeshes.map(|eighths| repeated(&eighths, mesh.submesh_count));
    let vertices = factors.vertices.map(|eighths| repeated(&eighths, mesh.vertex_count));
    let edges = raw_edges(factors);
    let start = |values: &Option<Vec<f32>>| values.as_ref().map_or(ptr::null(), Vec::as_ptr);
    mesh.submesh_factors = wish.factors[0].of(start(&submeshes));
    mesh.vertex_factors = wish.factors[1].of(start(&vertices));
    mesh.edge_factor_count = edges.len() as u32;
    mesh.edge_factors = wish.factors[2].of(edges.as_ptr());
    let mut mesh = Placed::new(&mesh, &input.mesh_size);
    let mesh = wish.mesh.of(mesh.pointer::<chamfer_mesh>().cast_const());
    let before = memory.hash();
    run(&input, mesh);
    split(&input, mesh);
    run_scene(&input, mesh);
    assert_eq!(memory.hash(), before, "the library wrote to its input");
});

fn run(input: &Input, mesh: *const chamfer_mesh) {
    run_with(input, |options, user, out, error| {
        // SAFETY: memory is there; all else is for the library to check.
        unsafe { chamfer_run(mesh, options, Some(note), user, out, error) }
    });
}

fn run_with(
    input: &Input,
    run: impl FnOnce(
        *const chamfer_options,
        *mut c_void,
        *mut *mut chamfer_result,
        *mut chamfer_error,
    ) -> i32,
) {
    let mut options = Placed::new(&raw_options(&input.options), &input.options_size);
    let options = input.pointers.options.of(options.pointer::<chamfer_options>().cast_const());
    let cancel_after = input.cancel_after.map_or(u32::MAX, |calls| u32::from(calls % 8) + 1);
    let mut progress = Progress { calls: 0, cancel_after };
    let user = (&raw mut progress).cast();
    call(input, |out, error| run(options, user, out, error));
}

/// The mesh twice, in objects that may be of a third.
fn run_scene(input: &Input, mesh: *const chamfer_mesh) {
    let objects: Vec<_> = input.objects.iter().take(MOST_OBJECTS).map(raw_object).collect();
    let count = objects.len() as u32;
    let (meshes, wish) = ([mesh; 2], &input.pointers);
    run_with(input, |options, user, out, error| {
        let (meshes, objects) =
            (wish.meshes.of(meshes.as_ptr()), wish.objects.of(objects.as_ptr()));
        // SAFETY: as above.
        unsafe {
            chamfer_scene_run(meshes, 2, objects, count, options, Some(note), user, out, error)
        }
    });
}

fn split(input: &Input, mesh: *const chamfer_mesh) {
    call(input, |out, error| {
        // SAFETY: as above.
        unsafe { chamfer_split_by_angle(mesh, input.angle, out, error) }
    });
}

fn raw_options(wish: &Options) -> chamfer_options {
    let [width_unit, verify, submesh_mode, width_mode, convexity] =
        wish.choices.map(|choice| u32::from(choice % 5));
    let degrees = wish.angles.map(|angles| angles.map(f32::from));
    let [min_angle, max_angle, hard_angle] = wish.any_angles.or(degrees).unwrap_or_default();
    let mut scale = wish.scale.map_or([0.0; 9], |axes| axes.map(|count| f32::from(count) / 8.0));
    if let Some((place, value)) = wish.any_scale {
        scale[usize::from(place) % 9] = value;
    }
    chamfer_options {
        struct_size: 0,
        width: if wish.is_small { wish.width.abs() % 10.0 } else { wish.width },
        width_unit,
        verify,
        submesh_mode,
        submesh: u32::from(wish.submesh % 4),
        threads: u32::from(wish.threads % 4),
        least_breadth: wish.least_breadth,
        width_mode,
        min_angle,
        max_angle,
        convexity,
        hard_angle,
        scale,
        evenness: wish.evenness.unwrap_or_default(),
        segments: wish.segments.unwrap_or_default(),
        profile: wish.profile.unwrap_or_default(),
    }
}

/// Calls with a place for the result and for the error, and looks at what became of them.
fn call(input: &Input, make: impl FnOnce(*mut *mut chamfer_result, *mut chamfer_error) -> i32) {
    const UNTOUCHED: *mut chamfer_result = ptr::without_provenance_mut(0x5A5A);
    let mut place = [UNTOUCHED; MOST_RESULTS + 1];
    let out = input.out.of(place.as_mut_ptr().cast_const()).cast_mut();
    let size = match &input.error {
        ErrorWish::Sized(size) => size,
        _ => &Size::Right,
    };
    let mut error = Placed::new(&empty_error(), size);
    let told = match input.error {
        ErrorWish::Null => ptr::null_mut(),
        _ => error.pointer::<chamfer_error>(),
    };
    let status = make(out, told);
    assert!(is_known(status), "{status}");
    assert_ne!(status, CHAMFER_STATUS_INTERNAL, "a fault of the library");
    let is_place = !out.is_null() && out.is_aligned();
    assert!(is_place || place[0] == UNTOUCHED && status != CHAMFER_STATUS_OK);
    let written = place.into_iter().take_while(|&result| result != UNTOUCHED);
    assert!(place[MOST_RESULTS] == UNTOUCHED);
    for result in written {
        assert_eq!(result.is_null(), status != CHAMFER_STATUS_OK);
        if !result.is_null() {
            // SAFETY: it came from the library, and is given up here.
            unsafe {
                look_at(result);
                chamfer_result_destroy(result);
            }
        }
    }
}
