//! Every mistake that a caller can make and the library can see: its status, its element, its
//! words, and that nothing else is written.

use std::ffi::{CStr, c_void};
use std::mem::offset_of;
use std::{mem, ptr};

use crate::cube::{Cube, options};
use crate::library::LIBRARY;
use crate::types::*;

const NONE: u32 = CHAMFER_NO_ELEMENT;

/// A pointer that the library must not follow, and must not leave behind.
const GARBAGE: *mut c_void = ptr::without_provenance_mut(0x5A5A);

/// What a failed call told.
#[derive(Debug)]
pub struct Told {
    pub status: i32,
    pub element: u32,
    pub message: String,
}

fn empty_error() -> chamfer_error {
    // SAFETY: zeros are a valid struct.
    let mut error: chamfer_error = unsafe { mem::zeroed() };
    error.struct_size = size_of_val(&error) as u32;
    error
}

/// Makes a call that must fail.
fn fail(call: impl FnOnce(*mut *mut c_void, *mut chamfer_error) -> i32) -> Told {
    let (mut result, mut error) = (GARBAGE, empty_error());
    let status = call(&mut result, &mut error);
    assert_ne!(status, CHAMFER_STATUS_OK);
    assert!(result.is_null(), "a failed call left a result");
    assert_eq!(error.status, status);
    // SAFETY: the library ends its messages with NUL.
    let message = unsafe { CStr::from_ptr(error.message.as_ptr()) }.to_str().unwrap().to_owned();
    assert!(!message.is_empty());
    Told { status, element: error.element, message }
}

pub fn fail_run(mesh: *const chamfer_mesh, options: *const chamfer_options) -> Told {
    // SAFETY: what the tests get wrong is what the library checks.
    fail(|out, error| unsafe {
        (LIBRARY.chamfer_run)(mesh, options, None, ptr::null_mut(), out, error)
    })
}

/// Chamfers a cube whose view `change` has spoiled.
fn with_mesh(change: impl FnOnce(&mut chamfer_mesh)) -> (i32, u32) {
    let cube = Cube::new();
    let mut mesh = cube.view();
    change(&mut mesh);
    let told = fail_run(&mesh, &options());
    (told.status, told.element)
}

/// Chamfers a cube whose data `change` has spoiled.
fn with_data(change: impl FnOnce(&mut Cube)) -> (i32, u32) {
    let mut cube = Cube::new();
    change(&mut cube);
    let before = format!("{cube:?}");
    let told = fail_run(&cube.view(), &options());
    assert_eq!(format!("{cube:?}"), before, "the library wrote to its input");
    (told.status, told.element)
}

/// Chamfers a cube with spoiled options.
fn with_options(change: impl FnOnce(&mut chamfer_options)) -> (i32, u32) {
    let mut options = options();
    change(&mut options);
    let told = fail_run(&Cube::new().view(), &options);
    (told.status, told.element)
}

#[test]
fn null_pointers() {
    const NULL: (i32, u32) = (CHAMFER_STATUS_NULL_POINTER, NONE);
    let told = fail_run(ptr::null(), ptr::null());
    assert_eq!((told.status, told.element), NULL);
    assert_eq!(told.message, "mesh is NULL: give a valid pointer");
    assert_eq!(with_mesh(|mesh| mesh.positions = ptr::null()), NULL);
    assert_eq!(with_mesh(|mesh| mesh.indices = ptr::null()), NULL);
    assert_eq!(with_mesh(|mesh| mesh.submesh_index_counts = ptr::null()), NULL);
    assert_eq!(with_mesh(|mesh| mesh.uvs[2].components = 2), NULL);
}

#[test]
fn no_place_for_the_result() {
    let (cube, mut error) = (Cube::new(), empty_error());
    let mut result = [GARBAGE; 2];
    // SAFETY: what the test gets wrong is what the library checks.
    let mut run = |out| unsafe {
        let no_user = ptr::null_mut();
        (LIBRARY.chamfer_run)(&cube.view(), ptr::null(), None, no_user, out, &mut error)
    };
    assert_eq!(run(ptr::null_mut()), CHAMFER_STATUS_NULL_POINTER);
    assert_eq!(run(result.as_mut_ptr().wrapping_byte_add(1)), CHAMFER_STATUS_MISALIGNED);
    assert_eq!(result, [GARBAGE; 2]);
    assert_eq!(error.status, CHAMFER_STATUS_MISALIGNED);
}

#[test]
fn misaligned_pointers() {
    const MISALIGNED: (i32, u32) = (CHAMFER_STATUS_MISALIGNED, NONE);
    fn shift<T>(pointer: &mut *const T) {
        *pointer = pointer.wrapping_byte_add(1);
    }
    assert_eq!(with_mesh(|mesh| shift(&mut mesh.positions)), MISALIGNED);
    assert_eq!(with_mesh(|mesh| shift(&mut mesh.normals)), MISALIGNED);
    assert_eq!(with_mesh(|mesh| mesh.tangents = mesh.positions.wrapping_byte_add(2)), MISALIGNED);
    assert_eq!(with_mesh(|mesh| mesh.colors = mesh.positions.wrapping_byte_add(3)), MISALIGNED);
    assert_eq!(with_mesh(|mesh| shift(&mut mesh.indices)), MISALIGNED);
    assert_eq!(with_mesh(|mesh| shift(&mut mesh.submesh_index_counts)), MISALIGNED);
    let (mesh, options) = (Cube::empty_view(), options());
    let mesh_moved = (&raw const mesh).wrapping_byte_add(4);
    assert_eq!(fail_run(mesh_moved, &options).status, CHAMFER_STATUS_MISALIGNED);
    let options_moved = (&raw const options).wrapping_byte_add(2);
    assert_eq!(fail_run(&mesh, options_moved).status, CHAMFER_STATUS_MISALIGNED);
}

#[test]
fn wrong_struct_sizes() {
    const SIZE: (i32, u32) = (CHAMFER_STATUS_STRUCT_SIZE, NONE);
    for size in [0, 4, size_of::<chamfer_mesh>() as u32 - 1, u32::MAX] {
        assert_eq!(with_mesh(|mesh| mesh.struct_size = size), SIZE);
        assert_eq!(with_options(|options| options.struct_size = size), SIZE);
    }
}

/// The options of a later version of the header.
#[repr(C)]
struct LaterOptions {
    today: chamfer_options,
    added: u32,
}

#[test]
fn longer_structs_must_be_zero_where_they_are_unknown() {
    let mut later = LaterOptions { today: options(), added: 1 };
    later.today.struct_size = size_of_val(&later) as u32;
    let cube = Cube::new();
    let pointer = (&raw const later).cast();
    assert_eq!(fail_run(&cube.view(), pointer).status, CHAMFER_STATUS_STRUCT_SIZE);
    later.added = 0;
    let mut result = ptr::null_mut();
    // SAFETY: all pointers are valid or allowed to be NULL.
    unsafe {
        let (pointer, null) = ((&raw const later).cast(), ptr::null_mut());
        let status =
            (LIBRARY.chamfer_run)(&cube.view(), pointer, None, null, &mut result, ptr::null_mut());
        assert_eq!(status, CHAMFER_STATUS_OK);
        (LIBRARY.chamfer_result_destroy)(result);
    }
}

#[test]
fn a_wrong_error_struct_stops_the_call() {
    let (cube, mut result) = (Cube::new(), GARBAGE);
    let mut error = empty_error();
    error.struct_size = 3;
    let mut run = |error| {
        // SAFETY: what the test gets wrong is what the library checks.
        unsafe {
            let (view, no_user) = (cube.view(), ptr::null_mut());
            (LIBRARY.chamfer_run)(&view, ptr::null(), None, no_user, &mut result, error)
        }
    };
    assert_eq!(run(&mut error), CHAMFER_STATUS_STRUCT_SIZE);
    assert_eq!(run((&raw mut error).wrapping_byte_add(1)), CHAMFER_STATUS_MISALIGNED);
    assert!(result.is_null());
    assert_eq!((error.status, error.message[0]), (0, 0));
}

#[test]
fn counts_past_the_address_space() {
    let near_the_end: *const f32 = ptr::without_provenance(usize::MAX - 15);
    let overflow = (CHAMFER_STATUS_COUNT_OVERFLOW, NONE);
    assert_eq!(with_mesh(|mesh| mesh.positions = near_the_end), overflow);
    assert_eq!(with_mesh(|mesh| mesh.colors = near_the_end), overflow);
    assert_eq!(with_mesh(|mesh| mesh.indices = near_the_end.cast()), overflow);
}

#[test]
fn bad_options() {
    const BAD: (i32, u32) = (CHAMFER_STATUS_BAD_OPTION, NONE);
    assert_eq!(with_options(|options| options.width_unit = 2), BAD);
    assert_eq!(with_options(|options| options.verify = 3), BAD);
    assert_eq!(with_options(|options| options.submesh_mode = u32::MAX), BAD);
    for share in [-0.1, 1.1, f32::NAN, f32::INFINITY] {
        assert_eq!(with_options(|options| options.least_breadth = share), BAD);
    }
    for width in [-1.0, f32::NAN, f32::INFINITY] {
        let bad = (CHAMFER_STATUS_BAD_WIDTH, NONE);
        assert_eq!(with_options(|options| options.width = width), bad);
    }
    let given = |options: &mut chamfer_options| {
        (options.submesh_mode, options.submesh) = (CHAMFER_SUBMESH_GIVEN, 2);
    };
    assert_eq!(with_options(given), (CHAMFER_STATUS_SUBMESH_RANGE, 2));
}

#[test]
fn bad_data() {
    let missing = (CHAMFER_STATUS_MISSING_NORMALS, NONE);
    assert_eq!(with_mesh(|mesh| mesh.normals = ptr::null()), missing);
    let components = (CHAMFER_STATUS_UV_COMPONENTS, 5);
    assert_eq!(with_mesh(|mesh| mesh.uvs[5].components = 1), components);
    assert_eq!(with_mesh(|mesh| mesh.uvs[5].components = u32::MAX), components);
    let not_finite = (CHAMFER_STATUS_NOT_FINITE, 17);
    assert_eq!(with_data(|cube| cube.positions[3 * 17] = f32::NAN), not_finite);
    assert_eq!(with_data(|cube| cube.normals[3 * 17 + 2] = f32::INFINITY), not_finite);
    assert_eq!(with_data(|cube| cube.indices[20] = 24), (CHAMFER_STATUS_INDEX_RANGE, 20));
    let counts = [
        (vec![18, 15], (CHAMFER_STATUS_INDEX_TOTAL, NONE)),
        (vec![u32::MAX, u32::MAX], (CHAMFER_STATUS_INDEX_TOTAL, NONE)),
        (vec![18, 17, 1], (CHAMFER_STATUS_INDEX_COUNT, 1)),
    ];
    for (counts, expected) in counts {
        assert_eq!(with_data(|cube| cube.submesh_index_counts = counts), expected);
    }
}

fn split_by_angle(cube: &Cube, angle: f32) -> (i32, u32) {
    // SAFETY: what the tests get wrong is what the library checks.
    let told = fail(|out, error| unsafe {
        (LIBRARY.chamfer_split_by_angle)(&cube.view(), angle, out, error)
    });
    (told.status, told.element)
}

#[test]
fn bad_input_to_smoothing() {
    let mut cube = Cube::new();
    for angle in [-1.0, 181.0, f32::NAN] {
        assert_eq!(split_by_angle(&cube, angle), (CHAMFER_STATUS_BAD_ANGLE, NONE));
    }
    cube.positions[5] = f32::NAN;
    assert_eq!(split_by_angle(&cube, 30.0), (CHAMFER_STATUS_NOT_FINITE, 1));
    cube.indices[35] = u32::MAX;
    assert_eq!(split_by_angle(&cube, 30.0), (CHAMFER_STATUS_INDEX_RANGE, 35));
    cube.submesh_index_counts = vec![35, 1];
    assert_eq!(split_by_angle(&cube, 30.0), (CHAMFER_STATUS_INDEX_COUNT, 0));
    cube.submesh_index_counts = vec![33];
    assert_eq!(split_by_angle(&cube, 30.0), (CHAMFER_STATUS_INDEX_TOTAL, NONE));
}

#[test]
fn initializers_refuse_what_they_cannot_fill() {
    let mut options = options();
    options.struct_size = offset_of!(chamfer_options, threads) as u32;
    let mut mesh = Cube::empty_view();
    mesh.struct_size = 0;
    // SAFETY: what the test gets wrong is what the library checks.
    unsafe {
        assert_eq!((LIBRARY.chamfer_options_init)(&mut options), CHAMFER_STATUS_STRUCT_SIZE);
        assert_eq!((LIBRARY.chamfer_options_init)(ptr::null_mut()), CHAMFER_STATUS_NULL_POINTER);
        assert_eq!((LIBRARY.chamfer_mesh_init)(&mut mesh), CHAMFER_STATUS_STRUCT_SIZE);
        assert_eq!((LIBRARY.chamfer_mesh_init)(ptr::null_mut()), CHAMFER_STATUS_NULL_POINTER);
    }
}

#[test]
fn getters_without_a_result_write_nothing() {
    let (mut array, mut count) = (GARBAGE.cast_const().cast(), 77);
    let mut mesh = Cube::empty_view();
    mesh.vertex_count = 77;
    let none = ptr::null();
    // SAFETY: what the test gets wrong is what the library checks.
    unsafe {
        let status = (LIBRARY.chamfer_result_verdicts)(none, &mut array, &mut count);
        assert_eq!(status, CHAMFER_STATUS_NULL_POINTER);
        let status = (LIBRARY.chamfer_result_mesh)(none, &mut mesh);
        assert_eq!(status, CHAMFER_STATUS_NULL_POINTER);
        (LIBRARY.chamfer_result_destroy)(ptr::null_mut());
    }
    assert_eq!((array.cast::<c_void>(), count), (GARBAGE.cast_const(), 77));
    assert_eq!(mesh.vertex_count, 77);
}

#[test]
fn getters_without_a_place_are_refused() {
    let (cube, mut result, mut count) = (Cube::new(), ptr::null_mut(), 77);
    let mut array = ptr::null();
    // SAFETY: what the test gets wrong is what the library checks.
    unsafe {
        let null = ptr::null_mut();
        let status =
            (LIBRARY.chamfer_run)(&cube.view(), ptr::null(), None, null, &mut result, null.cast());
        assert_eq!(status, CHAMFER_STATUS_OK);
        let refused = [
            (LIBRARY.chamfer_result_mesh)(result, ptr::null_mut()),
            (LIBRARY.chamfer_result_totals)(result, ptr::null_mut()),
            (LIBRARY.chamfer_result_verdicts)(result, &mut array, ptr::null_mut()),
            (LIBRARY.chamfer_result_vertex_sources)(result, ptr::null_mut(), &mut count),
            (LIBRARY.chamfer_result_triangle_sources)(result, ptr::null_mut(), &mut count),
        ];
        assert_eq!(refused, [CHAMFER_STATUS_NULL_POINTER; 5]);
        assert_eq!((array, count), (ptr::null(), 77));
        (LIBRARY.chamfer_result_destroy)(result);
    }
}
