//! What a call writes to must not lie in what it reads.
//!
//! Arrays of the mesh may overlap each other. But a result pointer or an error struct within one of
//! them would change the mesh under the library's hands, so nothing is written there, not even why.

use std::ops::Range;

use super::input::{self, SceneArrays, check_array};
use super::sized::{self, StatesSize, check_pointer};
use super::status::Failure;
use super::types::{CHAMFER_STATUS_OVERLAP, chamfer_error, chamfer_mesh};
use crate::mesh::Mesh;
use crate::view::MAX_CORNERS;

/// Refuses an `out` or `error` that overlaps the mesh, or one the other.
///
/// # Safety
/// As [`input::borrow_mesh`]; `error` as for a call; `out` may be anything.
pub unsafe fn check_apart<T>(
    mesh: *const chamfer_mesh,
    out: *const *mut T,
    error: *const chamfer_error,
) -> Result<(), Failure> {
    let mut read = Vec::new();
    // SAFETY: as this function's, and nothing is written while the borrow lives.
    let error = unsafe {
        add_mesh(mesh, &mut read);
        struct_range(error)
    };
    // Nothing is written to a pointer that is refused.
    let out = if check_pointer(out, "out").is_ok() { range(out, 1) } else { 0..0 };
    check(&read, out, error)
}

/// As [`check_apart`], of a scene: neither `results` nor `error` may lie in anything that is read.
///
/// # Safety
/// `meshes` holds `mesh_count` pointers, each as for [`input::borrow_mesh`], or is an array that
/// is refused; `options` and `error` as for a call; `objects` and `results` may be anything.
pub unsafe fn check_scene_apart<T>(
    scene: &SceneArrays,
    results: *const *mut T,
    error: *const chamfer_error,
) -> Result<(), Failure> {
    let SceneArrays { meshes, mesh_count, objects, object_count, options } = *scene;
    // SAFETY: as this function's, and nothing is written while the borrows live.
    let (mut read, error) = unsafe { (vec![struct_range(options)], struct_range(error)) };
    // SAFETY: as above.
    if let Ok(pointers) = unsafe { input::required(meshes, mesh_count, "meshes") } {
        read.push(range(meshes, mesh_count));
        // SAFETY: as above.
        pointers.iter().for_each(|&mesh| unsafe { add_mesh(mesh, &mut read) });
    }
    if check_array(objects, object_count, "objects").is_ok() {
        read.push(range(objects, object_count));
    }
    let is_place = check_array(results, mesh_count, "results").is_ok();
    check(&read, if is_place { range(results, mesh_count) } else { 0..0 }, error)
}

fn check(read: &[Range<usize>], out: Range<usize>, error: Range<usize>) -> Result<(), Failure> {
    if meet(&out, &error) || read.iter().any(|one| meet(one, &out) || meet(one, &error)) {
        return Err(Failure::new(
            CHAMFER_STATUS_OVERLAP,
            "out and error lie in the mesh or in each other: give each memory of its own".into(),
        ));
    }
    Ok(())
}

/// Adds where a mesh stands, and its arrays.
///
/// # Safety
/// As [`input::borrow_mesh`].
unsafe fn add_mesh(mesh: *const chamfer_mesh, ranges: &mut Vec<Range<usize>>) {
    // SAFETY: as this function's.
    let Ok(borrowed) = (unsafe { input::borrow_mesh(mesh) }) else {
        // What is wrong with the mesh is told when it is read.
        return;
    };
    // Counts past the limit are refused for what they are: the arrays are hardly that long.
    if borrowed.positions.len().max(borrowed.indices.len()) > MAX_CORNERS {
        return;
    }
    // SAFETY: as this function's.
    ranges.push(unsafe { struct_range(mesh) });
    add_arrays(&borrowed, ranges);
}

/// The addresses of as much of a struct as it states to have: nothing behind is looked at. Of a
/// struct that is refused for its size, that size; none of NULL.
///
/// # Safety
/// As [`sized::stated_size`].
unsafe fn struct_range<T: StatesSize>(pointer: *const T) -> Range<usize> {
    if pointer.is_null() {
        return 0..0;
    }
    // SAFETY: as this function's.
    let size = unsafe { sized::stated_size(pointer, "struct") }.unwrap_or(size_of::<u32>());
    range(pointer.cast::<u8>(), size)
}

fn meet(one: &Range<usize>, other: &Range<usize>) -> bool {
    one.start.max(other.start) < one.end.min(other.end)
}

/// Adds the addresses that each array takes.
fn add_arrays(mesh: &Mesh, ranges: &mut Vec<Range<usize>>) {
    ranges.extend([
        range(mesh.positions.as_ptr(), mesh.positions.len()),
        range(mesh.normals.as_ptr(), mesh.normals.len()),
        range(mesh.tangents.as_ptr(), mesh.tangents.len()),
        range(mesh.colors.as_ptr(), mesh.colors.len()),
        range(mesh.indices.as_ptr(), mesh.indices.len()),
        range(mesh.submesh_index_counts.as_ptr(), mesh.submesh_index_counts.len()),
        range(mesh.held.as_ptr(), mesh.held.len()),
        range(mesh.factors.submeshes.as_ptr(), mesh.factors.submeshes.len()),
        range(mesh.factors.vertices.as_ptr(), mesh.factors.vertices.len()),
        range(mesh.factors.edges.as_ptr(), mesh.factors.edges.len()),
    ]);
    ranges.extend(mesh.uvs.iter().map(|uv| range(uv.values.as_ptr(), uv.values.len())));
}

fn range<T>(first: *const T, count: usize) -> Range<usize> {
    first.addr()..first.addr().saturating_add(count * size_of::<T>())
}
