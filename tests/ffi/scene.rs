//! Meshes that stand together, and places that callers hold.

use std::ffi::{CStr, c_void};
use std::mem::offset_of;
use std::{mem, ptr, slice};

use crate::cube::{Cube, options};
use crate::library::LIBRARY;
use crate::types::*;

const NONE: u32 = CHAMFER_NO_ELEMENT;

/// What the library must not leave behind where it fails, nor touch where it may not write.
const GARBAGE: *mut c_void = ptr::without_provenance_mut(0x5A5A);

/// A cube whose face toward -x is open.
fn open_cube() -> Cube {
    let mut cube = Cube::new();
    cube.indices.drain(..6);
    cube.submesh_index_counts = vec![12, 18];
    cube
}

fn object(mesh: u32, [x, y, z]: [f32; 3]) -> chamfer_object {
    let mut transform = [0.0; 16];
    (transform[0], transform[5], transform[10], transform[15]) = (1.0, 1.0, 1.0, 1.0);
    (transform[12], transform[13], transform[14]) = (x, y, z);
    chamfer_object { mesh, transform }
}

/// What a call told.
#[derive(Debug, PartialEq)]
struct Told {
    status: i32,
    element: u32,
    mesh: u32,
    message: String,
}

fn empty_error() -> chamfer_error {
    // SAFETY: zeros are a valid struct.
    let mut error: chamfer_error = unsafe { mem::zeroed() };
    error.struct_size = size_of_val(&error) as u32;
    error
}

/// A pointer to a mesh that is there.
fn all(meshes: &[chamfer_mesh]) -> Vec<*const chamfer_mesh> {
    meshes.iter().map(ptr::from_ref).collect()
}

/// An outcome and its reason.
type Verdict = (u32, u32);

/// Chamfers a scene; `#meshes` verdicts where that went well.
fn run(
    meshes: &[*const chamfer_mesh],
    objects: &[chamfer_object],
    options: &chamfer_options,
) -> Result<Vec<Vec<Verdict>>, Told> {
    run_with(meshes, objects, options, None, ptr::null_mut())
}

fn run_with(
    meshes: &[*const chamfer_mesh],
    objects: &[chamfer_object],
    options: &chamfer_options,
    progress: chamfer_progress,
    user: *mut c_void,
) -> Result<Vec<Vec<Verdict>>, Told> {
    let mut results = vec![GARBAGE; meshes.len() + 1];
    let mut error = empty_error();
    // SAFETY: what the tests get wrong is what the library checks.
    let status = unsafe {
        let (meshes, count) = (meshes.as_ptr(), meshes.len() as u32);
        let (objects, object_count) = (objects.as_ptr(), objects.len() as u32);
        let out = results.as_mut_ptr();
        (LIBRARY.chamfer_scene_run)(
            meshes,
            count,
            objects,
            object_count,
            options,
            progress,
            user,
            out,
            &mut error,
        )
    };
    assert_eq!(results.pop(), Some(GARBAGE), "written past the results");
    assert_eq!(error.status, status);
    if status != CHAMFER_STATUS_OK {
        assert!(results.iter().all(|result| result.is_null()), "a failed call left a result");
        // SAFETY: the library ends its messages with NUL.
        let message = unsafe { CStr::from_ptr(error.message.as_ptr()) };
        let message = message.to_str().unwrap().to_owned();
        return Err(Told { status, element: error.element, mesh: error.mesh, message });
    }
    Ok(results.into_iter().map(verdicts_of).collect())
}

/// Copies the verdicts of a result, and frees it.
fn verdicts_of(result: *mut c_void) -> Vec<Verdict> {
    let (mut array, mut count) = (ptr::null::<chamfer_edge_verdict>(), 0);
    // SAFETY: the result came from the library, and is given up here.
    unsafe {
        let status = (LIBRARY.chamfer_result_verdicts)(result, &mut array, &mut count);
        assert_eq!(status, CHAMFER_STATUS_OK);
        let verdicts = match count {
            0 => Vec::new(),
            _ => slice::from_raw_parts(array, count as usize)
                .iter()
                .map(|verdict| (verdict.outcome, verdict.reason))
                .collect(),
        };
        (LIBRARY.chamfer_result_destroy)(result);
        verdicts
    }
}

/// How many edges stay as they are because something rests there.
fn held(verdicts: &[Verdict]) -> usize {
    let held = (CHAMFER_OUTCOME_SKIPPED, CHAMFER_REASON_CONTACT);
    verdicts.iter().filter(|&&verdict| verdict == held).count()
}

//    ______ ______
//   |      |      |    the cube is closed, and the open side of the other lies on its face
//   | cube | open |
//   |______|______|
#[test]
fn edges_are_held_that_the_rim_of_another_object_rests_on() {
    let (cube, open) = (Cube::new(), open_cube());
    let meshes = [cube.view(), open.view()];
    let held_at = |at: [f32; 3], verify| {
        let objects = [object(0, [0.0; 3]), object(1, at)];
        let options = chamfer_options { verify, ..options() };
        run(&all(&meshes), &objects, &options).unwrap().iter().map(|v| held(v)).sum::<usize>()
    };
    for verify in [CHAMFER_VERIFY_FAST, CHAMFER_VERIFY_FULL, CHAMFER_VERIFY_SEEN] {
        assert_eq!(held_at([2.0, 0.0, 0.0], verify), 4, "{verify}");
        assert_eq!(held_at([2.1, 0.0, 0.0], verify), 0, "{verify}");
    }
}

#[test]
fn one_mesh_stands_in_several_places() {
    let (cube, open) = (Cube::new(), open_cube());
    let meshes = [cube.view(), open.view()];
    let mut mirrored = object(1, [-2.0, 0.0, 0.0]);
    mirrored.transform[0] = -1.0;
    let objects = [object(0, [0.0; 3]), object(1, [2.0, 0.0, 0.0]), mirrored];
    let verdicts = run(&all(&meshes), &objects, &options()).unwrap();
    assert_eq!(held(&verdicts[0]), 8);
}

#[test]
fn the_last_row_of_a_transform_does_not_matter() {
    let (cube, open) = (Cube::new(), open_cube());
    let meshes = [cube.view(), open.view()];
    let mut objects = [object(0, [0.0; 3]), object(1, [2.0, 0.0, 0.0])];
    for object in &mut objects {
        [3, 7, 11, 15].into_iter().for_each(|place| object.transform[place] = 9.0);
    }
    assert_eq!(held(&run(&all(&meshes), &objects, &options()).unwrap()[0]), 4);
}

#[test]
fn meshes_without_objects_are_chamfered_alone() {
    let cube = Cube::new();
    for verify in [CHAMFER_VERIFY_FULL, CHAMFER_VERIFY_SEEN] {
        let options = chamfer_options { verify, ..options() };
        let verdicts = run(&all(&[cube.view()]), &[], &options).unwrap();
        assert!(verdicts[0].iter().all(|&(outcome, _)| outcome == CHAMFER_OUTCOME_FULL));
        assert_eq!(verdicts[0].len(), 12);
    }
    assert_eq!(run(&[], &[], &options()).map(|scene| scene.len()), Ok(0));
}

#[test]
fn an_object_that_is_flattened_is_not_there() {
    let (cube, open) = (Cube::new(), open_cube());
    let mut flat = object(1, [2.0, 0.0, 0.0]);
    flat.transform[0] = 0.0;
    let meshes = [cube.view(), open.view()];
    let verdicts = run(&all(&meshes), &[object(0, [0.0; 3]), flat], &options()).unwrap();
    assert_eq!(held(&verdicts[0]), 0);
}

#[test]
fn what_is_wrong_names_the_mesh() {
    let mut cubes = [Cube::new(), Cube::new()];
    cubes[1].positions[3 * 17] = f32::NAN;
    let views = cubes.each_ref().map(Cube::view);
    let told = run(&all(&views), &[], &options()).unwrap_err();
    assert_eq!((told.status, told.element, told.mesh), (CHAMFER_STATUS_NOT_FINITE, 17, 1));
    assert!(told.message.starts_with("mesh 1: positions of vertex 17"), "{}", told.message);
    let told = run(&[&raw const views[0], ptr::null()], &[], &options()).unwrap_err();
    assert_eq!((told.status, told.mesh), (CHAMFER_STATUS_NULL_POINTER, 1));
    let wrong = chamfer_options { width: -1.0, ..options() };
    let told = run(&all(&views), &[], &wrong).unwrap_err();
    assert_eq!((told.status, told.mesh), (CHAMFER_STATUS_BAD_WIDTH, 0));
}

#[test]
fn what_is_wrong_names_the_object() {
    let cube = Cube::new();
    let meshes = [cube.view()];
    let mut objects = [object(0, [0.0; 3]), object(1, [0.0; 3])];
    let told = run(&all(&meshes), &objects, &options()).unwrap_err();
    assert_eq!(
        told,
        Told {
            status: CHAMFER_STATUS_OBJECT_MESH,
            element: 1,
            mesh: NONE,
            message: "object 1 is of mesh 1, but there are 1 meshes".into(),
        }
    );
    for wrong in [f32::NAN, f32::INFINITY] {
        objects[1] = object(0, [0.0, wrong, 0.0]);
        let told = run(&all(&meshes), &objects, &options()).unwrap_err();
        assert_eq!((told.status, told.element), (CHAMFER_STATUS_BAD_TRANSFORM, 1));
        assert!(told.message.starts_with("object 1 has a transform"), "{}", told.message);
    }
}

/// What a progress callback saw, and after how many calls it cancels.
struct Progress {
    shares: Vec<f32>,
    cancel_after: usize,
}

unsafe extern "C" fn note(user: *mut c_void, done: f32) -> i32 {
    // SAFETY: the tests hand one over.
    let progress = unsafe { &mut *user.cast::<Progress>() };
    progress.shares.push(done);
    i32::from(progress.shares.len() >= progress.cancel_after)
}

#[test]
fn progress_rises_over_all_meshes_and_can_cancel() {
    let (cube, open) = (Cube::new(), open_cube());
    let meshes = [cube.view(), open.view()];
    let objects = [object(0, [0.0; 3]), object(1, [2.0, 0.0, 0.0])];
    for verify in [CHAMFER_VERIFY_FULL, CHAMFER_VERIFY_SEEN] {
        let options = chamfer_options { verify, ..options() };
        let noting = |cancel_after| {
            let mut progress = Progress { shares: Vec::new(), cancel_after };
            let user = (&raw mut progress).cast();
            let outcome = run_with(&all(&meshes), &objects, &options, Some(note), user);
            (outcome.map_err(|told| told.status).map(|_| ()), progress.shares)
        };
        let (outcome, shares) = noting(usize::MAX);
        assert_eq!(outcome, Ok(()));
        assert!(shares.is_sorted() && shares[0] < 0.5 && shares.last() == Some(&1.0));
        for call in 1..=shares.len() {
            let (outcome, seen) = noting(call);
            assert_eq!((outcome, seen.len()), (Err(CHAMFER_STATUS_CANCELLED), call));
        }
    }
}

fn run_one(mesh: &chamfer_mesh, options: &chamfer_options) -> Vec<Verdict> {
    let mut result = ptr::null_mut();
    // SAFETY: all pointers are valid or allowed to be NULL.
    let status = unsafe {
        let (null, no_error) = (ptr::null_mut(), ptr::null_mut());
        (LIBRARY.chamfer_run)(mesh, options, None, null, &mut result, no_error)
    };
    assert_eq!(status, CHAMFER_STATUS_OK);
    verdicts_of(result)
}

/// A line along one edge of the cube.
const ALONG: chamfer_held =
    chamfer_held { from: [1.0, 1.0, -1.0], to: [1.0, 1.0, 1.0], radius: 0.0 };

#[test]
fn a_held_line_keeps_the_edge_that_it_lies_on() {
    let cube = Cube::new();
    let mesh = chamfer_mesh { held_count: 1, held: &ALONG, ..cube.view() };
    assert_eq!(held(&run_one(&mesh, &options())), 1);
    let wide = chamfer_held { radius: 0.1, to: ALONG.from, ..ALONG };
    let mesh = chamfer_mesh { held_count: 1, held: &wide, ..cube.view() };
    let narrowed = (CHAMFER_OUTCOME_NARROWED, CHAMFER_REASON_CONTACT);
    let verdicts = run_one(&mesh, &options());
    let count = verdicts.iter().filter(|&&verdict| verdict == narrowed).count();
    assert_eq!(count, 3, "all that end in the corner, of which the rest is chamfered");
}

#[test]
fn callers_that_do_not_know_of_held_places_hold_none() {
    let cube = Cube::new();
    let mesh = chamfer_mesh {
        struct_size: offset_of!(chamfer_mesh, held_count) as u32,
        held_count: 1_000_000_000,
        held: ptr::without_provenance(0x5A5A5A5A),
        ..cube.view()
    };
    assert_eq!(run_one(&mesh, &options()).len(), 12);
    assert!(run(&[&mesh], &[object(0, [0.0; 3])], &options()).is_ok());
}

#[test]
fn callers_that_do_not_know_of_the_mesh_at_fault_are_told_the_rest() {
    let mut error = empty_error();
    error.struct_size = offset_of!(chamfer_error, mesh) as u32;
    error.mesh = 77;
    let mut results = [GARBAGE; 1];
    // SAFETY: what the test gets wrong is what the library checks.
    let status = unsafe {
        let (meshes, out, no_user) = ([ptr::null()], results.as_mut_ptr(), ptr::null_mut());
        let (objects, options) = (ptr::null(), ptr::null());
        let run = LIBRARY.chamfer_scene_run;
        run(meshes.as_ptr(), 1, objects, 0, options, None, no_user, out, &mut error)
    };
    assert_eq!((status, error.status), (CHAMFER_STATUS_NULL_POINTER, CHAMFER_STATUS_NULL_POINTER));
    assert_eq!((error.mesh, results), (77, [ptr::null_mut()]));
}
