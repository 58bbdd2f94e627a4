//! From the core's result to what C callers can look at, without copying an array.
//!
//! Normals by smoothing angle for a caller's whole mesh: every stream follows its split vertices.

use std::mem::offset_of;
use std::{array, ptr};

use super::sized::{StatesSize, check_pointer};
use super::status::Failure;
use super::types::*;
use crate::memory;
use crate::view::{check_finite, check_indices};
use crate::watch::Unwatched;
use crate::{
    Blend, Chamfered, EdgeFactor, EdgeVerdict, Error, Mesh, MeshBuffers, Outcome, Reason, Smoothed,
    Totals, TriangleKind, TriangleSource, Uv, UvBuffer, VertexSource, split_by_angle,
};

/// The core's array elements are handed out as they stand: same size, same places, same numbers.
const _: () = {
    assert!(size_of::<EdgeVerdict>() == size_of::<chamfer_edge_verdict>());
    assert!(offset_of!(EdgeVerdict, vertices) == offset_of!(chamfer_edge_verdict, vertices));
    assert!(offset_of!(EdgeVerdict, outcome) == offset_of!(chamfer_edge_verdict, outcome));
    assert!(offset_of!(EdgeVerdict, reason) == offset_of!(chamfer_edge_verdict, reason));
    assert!(offset_of!(EdgeVerdict, widths) == offset_of!(chamfer_edge_verdict, widths));
    assert!(offset_of!(EdgeVerdict, segments) == offset_of!(chamfer_edge_verdict, segments));
    assert!(size_of::<EdgeFactor>() == size_of::<chamfer_edge_factor>());
    assert!(offset_of!(EdgeFactor, factor) == offset_of!(chamfer_edge_factor, factor));
    assert!(size_of::<Blend>() == size_of::<chamfer_blend>());
    assert!(offset_of!(Blend, weights) == offset_of!(chamfer_blend, weights));
    assert!(size_of::<VertexSource>() == size_of::<chamfer_vertex_source>());
    assert!(offset_of!(VertexSource, chart) == offset_of!(chamfer_vertex_source, chart));
    assert!(offset_of!(VertexSource, owner) == offset_of!(chamfer_vertex_source, owner));
    assert!(
        offset_of!(VertexSource, owner_channels)
            == offset_of!(chamfer_vertex_source, owner_channels)
    );
    assert!(VertexSource::BETWEEN == CHAMFER_VERTEX_BETWEEN);
    assert!(size_of::<TriangleSource>() == size_of::<chamfer_triangle_source>());
    assert!(offset_of!(TriangleSource, kind) == offset_of!(chamfer_triangle_source, kind));
    assert!(offset_of!(TriangleSource, index) == offset_of!(chamfer_triangle_source, index));

    assert!(Outcome::Full as u32 == CHAMFER_OUTCOME_FULL);
    assert!(Outcome::Narrowed as u32 == CHAMFER_OUTCOME_NARROWED);
    assert!(Outcome::Skipped as u32 == CHAMFER_OUTCOME_SKIPPED);
    assert!(TriangleKind::Source as u32 == CHAMFER_TRIANGLE_SOURCE);
    assert!(TriangleKind::Edge as u32 == CHAMFER_TRIANGLE_EDGE);
    assert!(TriangleKind::Corner as u32 == CHAMFER_TRIANGLE_CORNER);
    assert!(Reason::ALL.len() <= CHAMFER_REASON_SLOTS);
};

/// The mesh, its arrays in place.
pub fn view_mesh(mesh: &MeshBuffers) -> Result<chamfer_mesh, Failure> {
    Ok(chamfer_mesh {
        vertex_count: count_of(&mesh.positions)?,
        positions: present(&mesh.positions).cast(),
        normals: present(&mesh.normals).cast(),
        tangents: present(&mesh.tangents).cast(),
        colors: present(&mesh.colors).cast(),
        uvs: array::from_fn(|channel| view_uv(&mesh.uvs[channel])),
        submesh_count: count_of(&mesh.submesh_index_counts)?,
        index_count: count_of(&mesh.indices)?,
        submesh_index_counts: present(&mesh.submesh_index_counts),
        indices: present(&mesh.indices),
        ..chamfer_mesh::defaults()
    })
}

fn view_uv(uv: &UvBuffer) -> chamfer_uv {
    chamfer_uv { components: uv.components, values: present(&uv.values) }
}

/// The sums, in the places of the header.
pub fn view_totals(totals: &Totals, width: f32) -> chamfer_totals {
    let mut skipped_by_reason = [0; CHAMFER_REASON_SLOTS];
    for (place, (_, count)) in skipped_by_reason.iter_mut().zip(totals.skipped.iter()) {
        *place = count;
    }
    chamfer_totals {
        hard_edges: totals.hard_edges,
        chamfered: totals.chamfered,
        narrowed: totals.narrowed,
        skipped: totals.skipped.total(),
        width,
        mean_width: totals.mean_width,
        skipped_by_reason,
        ..chamfer_totals::defaults()
    }
}

/// Writes where an array of the result stands and how long it is.
///
/// # Safety
/// `array` and `count` are each NULL, misaligned or writable. `C` is the header's name for the
/// layout of `T`.
pub unsafe fn write_array<T, C>(
    elements: &[T],
    array: *mut *const C,
    count: *mut u32,
) -> Result<(), Failure> {
    const { assert!(size_of::<T>() == size_of::<C>() && align_of::<T>() == align_of::<C>()) };
    check_pointer(array, "the pointer to the array")?;
    check_pointer(count, "count")?;
    let length = count_of(elements)?;
    // SAFETY: neither is NULL or misaligned, and the caller vouches for the rest.
    unsafe {
        array.write(present(elements).cast());
        count.write(length);
    }
    Ok(())
}

/// Where the array stands; NULL for none.
fn present<T>(array: &[T]) -> *const T {
    if array.is_empty() { ptr::null() } else { array.as_ptr() }
}

fn count_of<T>(array: &[T]) -> Result<u32, Failure> {
    u32::try_from(array.len()).map_err(|_| Error::TooLarge.into())
}

// SAFETY: numbers only, the size first.
unsafe impl StatesSize for chamfer_totals {
    const SIZES: &'static [usize] = &[size_of::<chamfer_totals>()];

    fn defaults() -> Self {
        chamfer_totals {
            struct_size: size_of::<chamfer_totals>() as u32,
            hard_edges: 0,
            chamfered: 0,
            narrowed: 0,
            skipped: 0,
            width: 0.0,
            mean_width: 0.0,
            skipped_by_reason: [0; CHAMFER_REASON_SLOTS],
        }
    }
}

/// The mesh with new normals, its vertices split where they differ, and where each came from.
pub fn with_normals(mesh: &Mesh, angle_degrees: f32) -> Result<Chamfered, Failure> {
    // `split_by_angle` knows of no submeshes and no other streams.
    check_indices(mesh)?;
    // The normals are ignored, whatever they are; all else goes out again.
    check_finite(&Mesh { normals: &[], ..*mesh }, &Unwatched)?;
    memory::ask(memory::of_normals(mesh))?;
    let smoothed = split_by_angle(mesh.positions, mesh.indices, angle_degrees)?;
    let triangles = smoothed.indices.len() as u32 / 3;
    Ok(Chamfered {
        vertex_sources: smoothed.source_of.iter().map(|&v| copy_of(v)).collect(),
        triangle_sources: (0..triangles)
            .map(|index| TriangleSource { kind: TriangleKind::Source, index })
            .collect(),
        mesh: gather(mesh, smoothed),
        ..Chamfered::default()
    })
}

fn copy_of(vertex: u32) -> VertexSource {
    VertexSource::new(Blend::one(vertex), Blend::one(vertex))
}

fn gather(mesh: &Mesh, smoothed: Smoothed) -> MeshBuffers {
    let source_of = &smoothed.source_of;
    MeshBuffers {
        positions: gather_stream(mesh.positions, source_of, 1),
        tangents: gather_stream(mesh.tangents, source_of, 1),
        colors: gather_stream(mesh.colors, source_of, 1),
        uvs: mesh.uvs.map(|uv| gather_uv(uv, source_of)),
        normals: smoothed.normals,
        indices: smoothed.indices,
        submesh_index_counts: mesh.submesh_index_counts.to_vec(),
    }
}

fn gather_uv(uv: Uv, source_of: &[u32]) -> UvBuffer {
    let values = gather_stream(uv.values, source_of, uv.components as usize);
    UvBuffer { components: uv.components, values }
}

/// `source_of: #vertices`; the values are `#source vertices by width`, or none.
fn gather_stream<T: Copy>(values: &[T], source_of: &[u32], width: usize) -> Vec<T> {
    if values.is_empty() {
        return Vec::new();
    }
    let rows = source_of.iter().flat_map(|&v| &values[v as usize * width..][..width]);
    rows.copied().collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn streams_follow_their_vertices() {
        assert_eq!(gather_stream(&[1, 2, 3, 4], &[1, 0, 1], 2), [3, 4, 1, 2, 3, 4]);
        assert_eq!(gather_stream(&[0; 0], &[1, 0, 1], 2), [0; 0]);
    }
}
