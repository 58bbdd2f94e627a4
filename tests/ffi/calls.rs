//! Every exported function, called as it should be.

use std::collections::BTreeSet;
use std::ffi::{CStr, c_char, c_void};
use std::mem::offset_of;
use std::{mem, ptr, slice, thread};

use crate::cube::{Cube, options};
use crate::library::LIBRARY;
use crate::types::*;

/// A result that frees itself.
pub struct Handle(pub *mut c_void);

impl Drop for Handle {
    fn drop(&mut self) {
        // SAFETY: the handle came from the library and is given up here.
        unsafe { (LIBRARY.chamfer_result_destroy)(self.0) }
    }
}

pub fn run(mesh: &chamfer_mesh, options: &chamfer_options) -> Handle {
    let mut result = ptr::null_mut();
    // SAFETY: all pointers are valid or allowed to be NULL.
    let status = unsafe {
        let no_error = ptr::null_mut();
        (LIBRARY.chamfer_run)(mesh, options, None, ptr::null_mut(), &mut result, no_error)
    };
    assert_eq!(status, CHAMFER_STATUS_OK);
    assert!(!result.is_null());
    Handle(result)
}

pub fn mesh_of(result: &Handle) -> chamfer_mesh {
    let mut mesh = Cube::empty_view();
    // SAFETY: the result lives, and the struct states its size.
    let status = unsafe { (LIBRARY.chamfer_result_mesh)(result.0, &mut mesh) };
    assert_eq!(status, CHAMFER_STATUS_OK);
    mesh
}

/// Copies an array that one of the library's functions shows.
pub fn array_of<T: Copy>(
    result: &Handle,
    function: unsafe extern "C" fn(*const c_void, *mut *const T, *mut u32) -> i32,
) -> Vec<T> {
    let (mut array, mut count) = (ptr::null(), 77);
    // SAFETY: the result lives, and the function fills in a valid array.
    unsafe {
        assert_eq!(function(result.0, &mut array, &mut count), CHAMFER_STATUS_OK);
        slice_or_empty(array, count as usize).to_vec()
    }
}

/// # Safety
/// The array has that many elements, or is NULL and has none.
pub unsafe fn slice_or_empty<'a, T>(array: *const T, count: usize) -> &'a [T] {
    assert_eq!(array.is_null(), count == 0);
    // SAFETY: as this function's.
    if count == 0 { &[] } else { unsafe { slice::from_raw_parts(array, count) } }
}

fn text(string: *const c_char) -> &'static str {
    // SAFETY: the library's strings end with NUL and live as long as it.
    unsafe { CStr::from_ptr(string) }.to_str().unwrap()
}

#[test]
fn versions() {
    // SAFETY: no arguments.
    unsafe {
        assert_eq!((LIBRARY.chamfer_abi_version)(), CHAMFER_ABI_VERSION);
        assert_eq!(text((LIBRARY.chamfer_version_string)()), env!("CARGO_PKG_VERSION"));
    }
}

#[test]
fn names() {
    // SAFETY: any number is allowed.
    unsafe {
        assert_eq!(text((LIBRARY.chamfer_status_string)(CHAMFER_STATUS_OK)), "ok");
        assert_eq!(text((LIBRARY.chamfer_status_string)(-5)), "unknown status");
        assert_eq!(text((LIBRARY.chamfer_reason_string)(CHAMFER_REASON_NO_ROOM)), "no_room");
        assert_eq!(text((LIBRARY.chamfer_reason_string)(u32::MAX)), "unknown_reason");
    }
}

/// The numbers that the header defines for names that start so.
fn numbers_of(prefix: &str) -> Vec<i32> {
    let header = include_str!("../../include/chamfer.h");
    let defines = header.lines().filter_map(|line| line.strip_prefix("#define "));
    let numbers = defines.filter_map(|define| define.strip_prefix(prefix)?.split_once(' '));
    numbers.map(|(_, number)| number.parse().unwrap()).collect()
}

#[test]
fn every_status_has_words_of_its_own() {
    let statuses = numbers_of("CHAMFER_STATUS_");
    // SAFETY: any number is allowed.
    let words = |&status: &i32| text(unsafe { (LIBRARY.chamfer_status_string)(status) });
    let different: BTreeSet<&str> = statuses.iter().map(words).collect();
    assert_eq!(different.len(), statuses.len());
    assert!(!different.contains("unknown status"));
}

#[test]
fn default_options() {
    let options = options();
    assert_eq!((options.width, options.width_unit), (0.5, CHAMFER_WIDTH_PERCENT));
    assert_eq!((options.verify, options.threads), (CHAMFER_VERIFY_FULL, 1));
    assert_eq!((options.submesh_mode, options.submesh), (CHAMFER_SUBMESH_OWNER, 0));
}

#[test]
fn an_initialized_mesh_is_empty() {
    let cube = Cube::new();
    let mut mesh = cube.view();
    // SAFETY: the struct states its size.
    let status = unsafe { (LIBRARY.chamfer_mesh_init)(&mut mesh) };
    assert_eq!((status, mesh.struct_size), (CHAMFER_STATUS_OK, size_of_val(&mesh) as u32));
    assert_eq!((mesh.vertex_count, mesh.index_count, mesh.submesh_count), (0, 0, 0));
    assert!(mesh.positions.is_null() && mesh.uvs[7].values.is_null() && mesh.indices.is_null());
}

#[test]
fn a_cube_is_chamfered() {
    let result = run(&Cube::new().view(), &options());
    let mesh = mesh_of(&result);
    assert_eq!((mesh.vertex_count, mesh.index_count / 3), (24, 44));
    // SAFETY: the result lives, and says how long its array is.
    let counts = unsafe { slice::from_raw_parts(mesh.submesh_index_counts, 2) };
    assert_eq!((mesh.submesh_count, counts[0] + counts[1]), (2, mesh.index_count));
}

#[test]
fn chamfers_go_to_the_submesh_that_is_asked_for() {
    let counts = |submesh_mode, submesh| {
        let result =
            run(&Cube::new().view(), &chamfer_options { submesh_mode, submesh, ..options() });
        let mesh = mesh_of(&result);
        // SAFETY: the result lives, and says how long its array is.
        unsafe { slice_or_empty(mesh.submesh_index_counts, mesh.submesh_count as usize) }.to_vec()
    };
    assert_eq!(counts(CHAMFER_SUBMESH_OWN, 0), [18, 18, 96]);
    assert_eq!(counts(CHAMFER_SUBMESH_GIVEN, 1), [18, 114]);
}

#[test]
fn a_cube_has_twelve_verdicts() {
    let result = run(&Cube::new().view(), &options());
    let verdicts = array_of(&result, LIBRARY.chamfer_result_verdicts);
    assert_eq!(verdicts.len(), 12);
    for verdict in verdicts {
        assert_eq!((verdict.outcome, verdict.reason), (CHAMFER_OUTCOME_FULL, CHAMFER_REASON_NONE));
        assert!(verdict.widths.iter().all(|width| (width - 0.01).abs() < 1e-5));
    }
}

#[test]
fn totals_agree_with_the_verdicts() {
    let result = run(&Cube::new().view(), &options());
    // SAFETY: zeros are a valid struct, which then states its size.
    let totals = unsafe {
        let mut totals: chamfer_totals = mem::zeroed();
        totals.struct_size = size_of_val(&totals) as u32;
        let status = (LIBRARY.chamfer_result_totals)(result.0, &mut totals);
        assert_eq!(status, CHAMFER_STATUS_OK);
        totals
    };
    assert_eq!((totals.hard_edges, totals.chamfered), (12, 12));
    assert_eq!((totals.narrowed, totals.skipped), (0, 0));
    assert_eq!(totals.skipped_by_reason, [0; CHAMFER_REASON_SLOTS]);
    assert!((totals.width - 0.01).abs() < 1e-6);
}

#[test]
fn each_element_has_a_source() {
    let result = run(&Cube::new().view(), &options());
    let mesh = mesh_of(&result);
    let vertices = array_of(&result, LIBRARY.chamfer_result_vertex_sources);
    assert_eq!(vertices.len(), mesh.vertex_count as usize);
    for source in vertices {
        assert!(source.surface.vertices.iter().all(|&vertex| vertex < 24));
        assert!((source.chart.weights.iter().sum::<f32>() - 1.0).abs() < 1e-5);
    }
    let triangles = array_of(&result, LIBRARY.chamfer_result_triangle_sources);
    assert_eq!(triangles.len(), mesh.index_count as usize / 3);
    assert!(triangles.iter().all(|source| source.kind <= CHAMFER_TRIANGLE_CORNER));
}

#[test]
fn vertex_sources_are_made_once() {
    let result = run(&Cube::new().view(), &options());
    let ask = || {
        let (mut sources, mut count) = (ptr::null(), 0);
        // SAFETY: the result lives, and both places are writable.
        let status =
            unsafe { (LIBRARY.chamfer_result_vertex_sources)(result.0, &mut sources, &mut count) };
        assert_eq!(status, CHAMFER_STATUS_OK);
        sources
    };
    assert_eq!(ask(), ask());
}

#[test]
fn a_result_can_be_chamfered_again() {
    let first = run(&Cube::new().view(), &options());
    let second = run(&mesh_of(&first), &options());
    let (first, second) = (mesh_of(&first), mesh_of(&second));
    assert_eq!((first.vertex_count, first.index_count), (second.vertex_count, second.index_count));
}

#[test]
fn an_empty_mesh_is_no_error() {
    let result = run(&Cube::empty_view(), &options());
    assert!(mesh_of(&result).positions.is_null());
    assert!(array_of(&result, LIBRARY.chamfer_result_verdicts).is_empty());
}

#[test]
fn every_thread_gets_the_same_bytes() {
    let positions = || {
        let result = run(&Cube::new().view(), &options());
        let mesh = mesh_of(&result);
        // SAFETY: the result lives, and says how long its array is.
        unsafe { slice_or_empty(mesh.positions, 3 * mesh.vertex_count as usize) }
            .iter()
            .map(|value| value.to_bits())
            .collect::<Vec<u32>>()
    };
    let expected = positions();
    thread::scope(|scope| {
        let threads: Vec<_> = (0..4).map(|_| scope.spawn(positions)).collect();
        for thread in threads {
            assert_eq!(thread.join().unwrap(), expected);
        }
    });
}

#[test]
fn normals_by_angle() {
    let cube = Cube::new();
    let bare = chamfer_mesh { normals: ptr::null(), ..cube.view() };
    let mut result = ptr::null_mut();
    // SAFETY: all pointers are valid or allowed to be NULL.
    let status =
        unsafe { (LIBRARY.chamfer_split_by_angle)(&bare, 30.0, &mut result, ptr::null_mut()) };
    assert_eq!(status, CHAMFER_STATUS_OK);
    let result = Handle(result);
    let mesh = mesh_of(&result);
    assert_eq!((mesh.vertex_count, mesh.submesh_count), (24, 2));
    // SAFETY: the result lives, and says how long its array is.
    let normals = unsafe { slice::from_raw_parts(mesh.normals, 72) };
    assert!(normals.iter().zip(&cube.normals).all(|(found, want)| (found - want).abs() < 1e-6));
}

/// What a progress callback saw, and after how many calls it cancels.
struct Progress {
    shares: Vec<f32>,
    cancel_after: usize,
}

unsafe extern "C" fn note(user: *mut c_void, done: f32) -> i32 {
    // SAFETY: `run_noting` hands one over.
    let progress = unsafe { &mut *user.cast::<Progress>() };
    progress.shares.push(done);
    i32::from(progress.shares.len() >= progress.cancel_after)
}

fn run_noting(cancel_after: usize) -> (i32, Vec<f32>) {
    let mut progress = Progress { shares: Vec::new(), cancel_after };
    let mut result = ptr::null_mut();
    let cube = Cube::new();
    let mesh = cube.view();
    let user = (&raw mut progress).cast();
    // SAFETY: all pointers are valid or allowed to be NULL.
    let status = unsafe {
        let no_error = ptr::null_mut();
        (LIBRARY.chamfer_run)(&mesh, ptr::null(), Some(note), user, &mut result, no_error)
    };
    assert_eq!(result.is_null(), status != CHAMFER_STATUS_OK);
    drop(Handle(result));
    (status, progress.shares)
}

#[test]
fn progress_rises_to_one() {
    let (status, shares) = run_noting(usize::MAX);
    assert_eq!(status, CHAMFER_STATUS_OK);
    assert!(shares.is_sorted() && shares[0] >= 0.0 && shares.last() == Some(&1.0));
}

#[test]
fn progress_can_cancel() {
    let (status, shares) = run_noting(1);
    assert_eq!((status, shares.len()), (CHAMFER_STATUS_CANCELLED, 1));
}

/// A caller of the header before there was a least breadth: what lies behind its options is not read.
#[test]
fn shorter_options_have_the_default_breadth() {
    let cube = Cube::new();
    let wide = chamfer_options { width: 9.0, ..options() };
    let struct_size = offset_of!(chamfer_options, least_breadth) as u32;
    let shorter = chamfer_options { struct_size, least_breadth: 0.9, ..wide };
    let unset = chamfer_options { least_breadth: 0.0, ..wide };
    let more = chamfer_options { least_breadth: 0.9, ..wide };
    let positions = |options: &chamfer_options| {
        let result = run(&cube.view(), options);
        let mesh = mesh_of(&result);
        // SAFETY: the mesh has that many positions.
        unsafe { slice_or_empty(mesh.positions, 3 * mesh.vertex_count as usize) }.to_vec()
    };
    assert_eq!(positions(&shorter), positions(&wide));
    assert_eq!(positions(&unset), positions(&wide));
    assert_ne!(positions(&more), positions(&wide));
}
