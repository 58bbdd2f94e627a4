//! A mesh that is prepared for several widths.

use core::ffi::c_void;

use super::guard::caught;
use super::sized::check_pointer;
use super::types::{chamfer_error, chamfer_mesh, chamfer_options, chamfer_progress};
use super::{chamfer_result, input, produce, produce_from, reporting};
use crate::mesh::{Held, Mesh, MeshBuffers};
use crate::pipeline::Prepared;
use crate::plan::Shape;

/// A copy of a mesh, with all that is known of it before anybody asks for a width. It never
/// changes, so any number of threads may run it at once.
#[allow(non_camel_case_types)]
pub struct chamfer_prepared {
    mesh: MeshBuffers,
    held: Vec<Held>,
    /// None where nothing can be hard.
    shape: Option<Shape>,
}

/// Prepares a mesh for several widths: each then takes less than `chamfer_run` would.
///
/// `mesh` is borrowed for the call and copied, so what becomes of it later does not matter; a mesh
/// that changed is prepared anew. `error` may be NULL. On success `*out` is to be freed with
/// `chamfer_prepared_destroy`; on failure it is NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn chamfer_prepare(
    mesh: *const chamfer_mesh,
    out: *mut *mut chamfer_prepared,
    error: *mut chamfer_error,
) -> i32 {
    let body = |mesh: Mesh| {
        let shape = Prepared::new(&mesh)?.into_shape();
        Ok(chamfer_prepared { mesh: mesh.to_buffers(), held: mesh.held.to_vec(), shape })
    };
    // SAFETY: the caller's pointers are NULL or valid, as `chamfer.h` asks.
    unsafe { produce_from(mesh, out, error, body) }
}

/// As `chamfer_run` of the mesh that was prepared, to the byte.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn chamfer_prepared_run(
    prepared: *const chamfer_prepared,
    options: *const chamfer_options,
    progress: chamfer_progress,
    user: *mut c_void,
    out: *mut *mut chamfer_result,
    error: *mut chamfer_error,
) -> i32 {
    // SAFETY: the caller's pointers are NULL or valid, as `chamfer.h` asks, and `prepared` came
    // from this library and is not destroyed.
    let body = || unsafe {
        check_pointer(prepared, "prepared")?;
        let chamfer_prepared { mesh, held, shape } = &*prepared;
        let mesh = Mesh { held, ..mesh.as_mesh() };
        let options = input::read_options(options)?;
        let prepared = Prepared::of_shape(mesh, shape.clone());
        let result = prepared.chamfer_with_progress(&options, &mut reporting(progress, user))?;
        Ok(chamfer_result::new(result))
    };
    // SAFETY: as above.
    unsafe { produce(out, error, body) }
}

/// Frees a prepared mesh. Results that came of it live on. NULL is allowed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn chamfer_prepared_destroy(prepared: *mut chamfer_prepared) {
    if check_pointer(prepared, "prepared").is_ok() {
        // SAFETY: it came from `produce`, and the caller gives it up.
        let freed = caught(|| drop(unsafe { Box::from_raw(prepared) }));
        // Nobody can be told of a fault, and nothing is left to undo.
        drop(freed);
    }
}
