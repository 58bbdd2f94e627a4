//! What a call writes to must not lie in what it reads.
//!
//! Arrays of the mesh may overlap each other. But a result pointer or an error struct within one of
//! them would change the mesh under the library's hands, so nothing is written there, not even why.

use std::ops::Range;

use super::input;
use super::status::Failure;
use super::types::{CHAMFER_STATUS_OVERLAP, chamfer_error, chamfer_mesh};
use crate::mesh::Mesh;
use crate::view::MAX_CORNERS;

/// Refuses an `out` or `error` that overlaps the mesh.
///
/// # Safety
/// As [`input::borrow_mesh`]; `out` and `error` may be anything.
pub unsafe fn check_apart<T>(
    mesh: *const chamfer_mesh,
    out: *const *mut T,
    error: *const chamfer_error,
) -> Result<(), Failure> {
    // SAFETY: as this function's, and nothing is written while the borrow lives.
    let Ok(borrowed) = (unsafe { input::borrow_mesh(mesh) }) else {
        // What is wrong with the mesh is told when it is read.
        return Ok(());
    };
    // Counts past the limit are refused for what they are: the arrays are hardly that long.
    if borrowed.positions.len().max(borrowed.indices.len()) > MAX_CORNERS {
        return Ok(());
    }
    let mut read = ranges(&borrowed);
    read.push(range(mesh, 1));
    let written = [range(out, 1), range(error, 1)];
    let meet = |one: &Range<usize>, other: &Range<usize>| {
        one.start < other.end && other.start < one.end && !one.is_empty()
    };
    if read.iter().any(|one| written.iter().any(|other| meet(one, other))) {
        return Err(Failure::new(
            CHAMFER_STATUS_OVERLAP,
            "out or error lies in the mesh: give them memory of their own".into(),
        ));
    }
    Ok(())
}

/// The addresses that each array takes.
fn ranges(mesh: &Mesh) -> Vec<Range<usize>> {
    let mut ranges = vec![
        range(mesh.positions.as_ptr(), mesh.positions.len()),
        range(mesh.normals.as_ptr(), mesh.normals.len()),
        range(mesh.tangents.as_ptr(), mesh.tangents.len()),
        range(mesh.colors.as_ptr(), mesh.colors.len()),
        range(mesh.indices.as_ptr(), mesh.indices.len()),
        range(mesh.submesh_index_counts.as_ptr(), mesh.submesh_index_counts.len()),
    ];
    ranges.extend(mesh.uvs.iter().map(|uv| range(uv.values.as_ptr(), uv.values.len())));
    ranges
}

fn range<T>(first: *const T, count: usize) -> Range<usize> {
    first.addr()..first.addr().saturating_add(count * size_of::<T>())
}
