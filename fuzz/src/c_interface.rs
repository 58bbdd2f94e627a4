//! The functions of `chamfer.h`, and memory for what they take and give.

use std::hash::{DefaultHasher, Hash, Hasher};
use std::{mem, ptr, slice};

// Links the library, whose symbols are declared below.
use chamfer as _;
use chamfer::MeshBuffers;
use core::ffi::{c_char, c_void};

#[path = "../../src/ffi/types.rs"]
mod types;

pub use types::*;

/// An opaque result.
#[repr(C)]
#[allow(non_camel_case_types)]
pub struct chamfer_result {
    _opaque: [u8; 0],
}

#[allow(missing_docs)]
unsafe extern "C" {
    pub fn chamfer_status_string(status: i32) -> *const c_char;
    pub fn chamfer_run(
        mesh: *const chamfer_mesh,
        options: *const chamfer_options,
        progress: chamfer_progress,
        user: *mut c_void,
        out: *mut *mut chamfer_result,
        error: *mut chamfer_error,
    ) -> i32;
    pub fn chamfer_scene_run(
        meshes: *const *const chamfer_mesh,
        mesh_count: u32,
        objects: *const chamfer_object,
        object_count: u32,
        options: *const chamfer_options,
        progress: chamfer_progress,
        user: *mut c_void,
        results: *mut *mut chamfer_result,
        error: *mut chamfer_error,
    ) -> i32;
    pub fn chamfer_split_by_angle(
        mesh: *const chamfer_mesh,
        angle_degrees: f32,
        out: *mut *mut chamfer_result,
        error: *mut chamfer_error,
    ) -> i32;
    pub fn chamfer_result_mesh(result: *const chamfer_result, mesh: *mut chamfer_mesh) -> i32;
    pub fn chamfer_result_totals(result: *const chamfer_result, totals: *mut chamfer_totals)
    -> i32;
    pub fn chamfer_result_verdicts(
        result: *const chamfer_result,
        verdicts: *mut *const chamfer_edge_verdict,
        count: *mut u32,
    ) -> i32;
    pub fn chamfer_result_vertex_sources(
        result: *const chamfer_result,
        sources: *mut *const chamfer_vertex_source,
        count: *mut u32,
    ) -> i32;
    pub fn chamfer_result_triangle_sources(
        result: *const chamfer_result,
        sources: *mut *const chamfer_triangle_source,
        count: *mut u32,
    ) -> i32;
    pub fn chamfer_result_destroy(result: *mut chamfer_result);
}

/// The arrays of a mesh, each in memory of just its size.
pub struct Memory(MeshBuffers);

impl Memory {
    /// A copy, so that no array has room to spare.
    pub fn new(mesh: &MeshBuffers) -> Memory {
        Memory(mesh.as_mesh().to_buffers())
    }

    /// The mesh, with as many vertices as its shortest stream has.
    pub fn view(&self) -> chamfer_mesh {
        let mesh = &self.0;
        let mut vertices = mesh.positions.len().min(mesh.normals.len());
        let mut uvs = [chamfer_uv { components: 0, values: ptr::null() }; CHAMFER_UV_CHANNELS];
        for (view, uv) in uvs.iter_mut().zip(&mesh.uvs) {
            *view = chamfer_uv { components: uv.components, values: uv.values.as_ptr() };
            if matches!(uv.components, 2..=4) {
                vertices = vertices.min(uv.values.len() / uv.components as usize);
            }
        }
        let or_null = |values: &[[f32; 4]]| match values.is_empty() {
            true => ptr::null(),
            false => values.as_ptr().cast(),
        };
        chamfer_mesh {
            struct_size: size_of::<chamfer_mesh>() as u32,
            vertex_count: vertices as u32,
            positions: mesh.positions.as_ptr().cast(),
            normals: mesh.normals.as_ptr().cast(),
            tangents: or_null(&mesh.tangents),
            colors: or_null(&mesh.colors),
            uvs,
            submesh_count: mesh.submesh_index_counts.len() as u32,
            index_count: mesh.indices.len() as u32,
            submesh_index_counts: mesh.submesh_index_counts.as_ptr(),
            indices: mesh.indices.as_ptr(),
            held_count: 0,
            held: ptr::null(),
            submesh_factors: ptr::null(),
            vertex_factors: ptr::null(),
            edge_factor_count: 0,
            edge_factors: ptr::null(),
        }
    }

    /// Changes where the library writes to what it may only read.
    pub fn hash(&self) -> u64 {
        let mut hasher = DefaultHasher::new();
        let mut add = |values: &[f32]| {
            values.iter().for_each(|value| value.to_bits().hash(&mut hasher));
        };
        add(self.0.positions.as_flattened());
        add(self.0.normals.as_flattened());
        add(self.0.tangents.as_flattened());
        add(self.0.colors.as_flattened());
        self.0.uvs.iter().for_each(|uv| add(&uv.values));
        (&self.0.indices, &self.0.submesh_index_counts).hash(&mut hasher);
        hasher.finish()
    }
}

/// An error struct before the call.
pub fn empty_error() -> chamfer_error {
    // SAFETY: zeros are a valid struct.
    unsafe { mem::zeroed() }
}

/// Whether the header has such a status.
pub fn is_known(status: i32) -> bool {
    // SAFETY: the library's strings end with NUL, and any number is allowed.
    let text = unsafe { std::ffi::CStr::from_ptr(chamfer_status_string(status)) };
    text != c"unknown status"
}

/// Reads all that a result shows, and checks that it fits together.
///
/// # Panics
/// Where it does not.
///
/// # Safety
/// The result came from the library and lives.
pub unsafe fn look_at(result: *const chamfer_result) {
    // SAFETY: as this function's; the structs state their sizes.
    unsafe {
        let mut mesh: chamfer_mesh = mem::zeroed();
        mesh.struct_size = size_of_val(&mesh) as u32;
        assert_eq!(chamfer_result_mesh(result, &mut mesh), CHAMFER_STATUS_OK);
        check_mesh(&mesh);
        let mut totals: chamfer_totals = mem::zeroed();
        totals.struct_size = size_of_val(&totals) as u32;
        assert_eq!(chamfer_result_totals(result, &mut totals), CHAMFER_STATUS_OK);
        let verdicts = array_of(result, chamfer_result_verdicts);
        assert_eq!(verdicts.len(), totals.hard_edges as usize);
        let vertices = array_of(result, chamfer_result_vertex_sources);
        assert_eq!(vertices.len(), mesh.vertex_count as usize);
        let triangles = array_of(result, chamfer_result_triangle_sources);
        assert_eq!(triangles.len(), mesh.index_count as usize / 3);
        assert!(triangles.iter().all(|source| source.kind <= CHAMFER_TRIANGLE_CORNER));
    }
}

/// # Safety
/// The arrays are as long as the counts say.
unsafe fn check_mesh(mesh: &chamfer_mesh) {
    let vertices = mesh.vertex_count as usize;
    // SAFETY: as this function's.
    unsafe {
        let indices = elements(mesh.indices, mesh.index_count as usize);
        assert!(indices.iter().all(|&index| (index as usize) < vertices));
        let counts = elements(mesh.submesh_index_counts, mesh.submesh_count as usize);
        assert_eq!(counts.iter().sum::<u32>(), mesh.index_count);
        for (values, width) in
            [(mesh.positions, 3), (mesh.normals, 3), (mesh.tangents, 4), (mesh.colors, 4)]
        {
            let values = if values.is_null() { &[] } else { elements(values, vertices * width) };
            assert!(values.iter().all(|value| value.is_finite()));
        }
        for uv in &mesh.uvs {
            let values = elements(uv.values, vertices * uv.components as usize);
            assert!(values.iter().all(|value| value.is_finite()));
        }
    }
}

/// # Safety
/// The result lives.
unsafe fn array_of<'a, T>(
    result: *const chamfer_result,
    function: unsafe extern "C" fn(*const chamfer_result, *mut *const T, *mut u32) -> i32,
) -> &'a [T] {
    let (mut array, mut count) = (ptr::null(), 77);
    // SAFETY: as this function's.
    unsafe {
        assert_eq!(function(result, &mut array, &mut count), CHAMFER_STATUS_OK);
        elements(array, count as usize)
    }
}

/// # Safety
/// There are so many, or none.
unsafe fn elements<'a, T>(array: *const T, count: usize) -> &'a [T] {
    if count == 0 {
        return &[];
    }
    assert!(!array.is_null());
    // SAFETY: as this function's.
    unsafe { slice::from_raw_parts(array, count) }
}
