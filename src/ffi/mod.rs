//! The C interface: every function of `include/chamfer.h`. `docs/abi.md` states its rules.
//!
//! An export checks pointers, hands borrowed slices to the core, and returns a status. Nothing
//! panics past it, nothing global is kept, and the caller's arrays are only read.

mod guard;
mod input;
mod output;
mod scene;
mod sized;
mod status;
// Callers need more of its names than the exports do: reasons have their numbers from the core.
#[allow(dead_code)]
mod types;

/// The characters at the border are those of the system's C, also where no test can run.
const _: fn(*const c_char) -> *const libc::c_char = |text| text;

use core::ffi::{c_char, c_void};
use std::ops::ControlFlow;
use std::ptr;
use std::sync::OnceLock;

use guard::{caught, guard};
use sized::{StatesSize, check_pointer};
use status::Failure;
use types::*;

use crate::{Chamfered, Error, Mesh, VertexSource, chamfer_with_progress};

/// What a call made: a mesh, where each of its elements came from, and a verdict for each hard
/// edge. It never changes, so any number of threads may read it at once.
#[allow(non_camel_case_types)]
pub struct chamfer_result {
    chamfered: Chamfered,
    /// One after the other, once somebody has asked for them.
    vertex_sources: OnceLock<Vec<VertexSource>>,
}

impl chamfer_result {
    fn new(chamfered: Chamfered) -> chamfer_result {
        chamfer_result { chamfered, vertex_sources: OnceLock::new() }
    }

    /// `#vertices`, made by the first call: fallibly, as no allocation may end the host's process.
    fn vertex_sources(&self) -> Result<&[VertexSource], Failure> {
        if self.vertex_sources.get().is_none() {
            let sources = &self.chamfered.vertex_sources;
            let mut all = Vec::new();
            all.try_reserve_exact(sources.len()).map_err(|_| Error::OutOfMemory)?;
            all.extend(sources.iter());
            // Where another thread was faster, its array is as good.
            drop(self.vertex_sources.set(all));
        }
        Ok(self.vertex_sources.get().map_or(&[], Vec::as_slice))
    }
}

/// The version of this interface that the library was built with: `CHAMFER_ABI_VERSION` of its
/// header.
#[unsafe(no_mangle)]
pub extern "C" fn chamfer_abi_version() -> u32 {
    CHAMFER_ABI_VERSION
}

/// The version of the library, such as "1.2.3". It lives as long as the library.
#[unsafe(no_mangle)]
pub extern "C" fn chamfer_version_string() -> *const c_char {
    const VERSION: &str = concat!(env!("CARGO_PKG_VERSION"), "\0");
    VERSION.as_ptr().cast()
}

/// What a status means, in a few English words. It lives as long as the library; never NULL.
#[unsafe(no_mangle)]
pub extern "C" fn chamfer_status_string(status: i32) -> *const c_char {
    status::status_text(status).as_ptr()
}

/// The short name of a `CHAMFER_REASON_*`, in lower case with underscores. It lives as long as the
/// library; never NULL.
#[unsafe(no_mangle)]
pub extern "C" fn chamfer_reason_string(reason: u32) -> *const c_char {
    status::reason_text(reason).as_ptr()
}

/// Fills in the default options. Set `struct_size` first.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn chamfer_options_init(options: *mut chamfer_options) -> i32 {
    let defaults = chamfer_options::defaults();
    // SAFETY: the caller's struct is as long as it states.
    let body = || unsafe { sized::write(options, &defaults, "options") };
    // SAFETY: there is no error struct.
    unsafe { guard(ptr::null_mut(), body) }
}

/// Makes the mesh empty, with every stream absent. Set `struct_size` first.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn chamfer_mesh_init(mesh: *mut chamfer_mesh) -> i32 {
    // SAFETY: the caller's struct is as long as it states.
    let body = || unsafe { sized::write(mesh, &chamfer_mesh::defaults(), "mesh") };
    // SAFETY: there is no error struct.
    unsafe { guard(ptr::null_mut(), body) }
}

/// Chamfers all hard edges of a mesh.
///
/// `mesh` is borrowed for the call. `options` may be NULL for the defaults, `progress` for none
/// (`user` is handed to it unchanged), `error` for no details. On success `*out` is a new result,
/// to be freed with `chamfer_result_destroy`; on failure it is NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn chamfer_run(
    mesh: *const chamfer_mesh,
    options: *const chamfer_options,
    progress: chamfer_progress,
    user: *mut c_void,
    out: *mut *mut chamfer_result,
    error: *mut chamfer_error,
) -> i32 {
    // SAFETY: the caller's pointers are NULL or valid, as `chamfer.h` asks.
    let body = |mesh: Mesh| unsafe {
        let options = input::read_options(options)?;
        Ok(chamfer_with_progress(&mesh, &options, &mut reporting(progress, user))?)
    };
    // SAFETY: as above.
    unsafe { produce(mesh, out, error, body) }
}

/// Gives a mesh normals by smoothing angle: faces joined by edges of at most `angle_degrees` (0 to
/// 180) shade as one surface, and vertices are split where normals differ.
///
/// The mesh's own normals are ignored and may be NULL; all other streams are copied along. The
/// result has no verdicts; `mesh`, `out` and `error` are as for `chamfer_run`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn chamfer_split_by_angle(
    mesh: *const chamfer_mesh,
    angle_degrees: f32,
    out: *mut *mut chamfer_result,
    error: *mut chamfer_error,
) -> i32 {
    let body = |mesh: Mesh| output::with_normals(&mesh, angle_degrees);
    // SAFETY: the caller's pointers are NULL or valid, as `chamfer.h` asks.
    unsafe { produce(mesh, out, error, body) }
}

/// Views the result's mesh. Set `struct_size` of `mesh` first.
///
/// Its arrays belong to the result and live until that is destroyed. The view can be given to
/// `chamfer_run` as it is.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn chamfer_result_mesh(
    result: *const chamfer_result,
    mesh: *mut chamfer_mesh,
) -> i32 {
    // SAFETY: the caller's struct is as long as it states.
    let write = |from: &chamfer_result| unsafe {
        sized::write(mesh, &output::view_mesh(&from.chamfered.mesh)?, "mesh")
    };
    // SAFETY: `result` is NULL or came from this library and is not destroyed.
    unsafe { inspect(result, write) }
}

/// Copies the sums over the result's verdicts. Set `struct_size` of `totals` first.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn chamfer_result_totals(
    result: *const chamfer_result,
    totals: *mut chamfer_totals,
) -> i32 {
    // SAFETY: the caller's struct is as long as it states.
    let write = |chamfer_result { chamfered, .. }: &chamfer_result| unsafe {
        sized::write(totals, &output::view_totals(&chamfered.totals, chamfered.width), "totals")
    };
    // SAFETY: `result` is NULL or came from this library and is not destroyed.
    unsafe { inspect(result, write) }
}

/// Views the verdicts: `#hard edges`, those whose sides share no edge last. The array lives as long as the result; NULL
/// if there are none.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn chamfer_result_verdicts(
    result: *const chamfer_result,
    verdicts: *mut *const chamfer_edge_verdict,
    count: *mut u32,
) -> i32 {
    // SAFETY: the caller's pointers are NULL or writable.
    let write = |from: &chamfer_result| unsafe {
        output::write_array(&from.chamfered.verdicts, verdicts, count)
    };
    // SAFETY: `result` is NULL or came from this library and is not destroyed.
    unsafe { inspect(result, write) }
}

/// Views what each vertex of the result's mesh came from: `#vertices`. The array is made by the
/// first call, if there is memory for it, and lives as long as the result; NULL if there are none.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn chamfer_result_vertex_sources(
    result: *const chamfer_result,
    sources: *mut *const chamfer_vertex_source,
    count: *mut u32,
) -> i32 {
    // SAFETY: the caller's pointers are NULL or writable.
    let write = |from: &chamfer_result| unsafe {
        output::write_array(from.vertex_sources()?, sources, count)
    };
    // SAFETY: `result` is NULL or came from this library and is not destroyed.
    unsafe { inspect(result, write) }
}

/// Views what each triangle of the result's mesh came from: `#triangles`. The array lives as long
/// as the result; NULL if there are none.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn chamfer_result_triangle_sources(
    result: *const chamfer_result,
    sources: *mut *const chamfer_triangle_source,
    count: *mut u32,
) -> i32 {
    // SAFETY: the caller's pointers are NULL or writable.
    let write = |from: &chamfer_result| unsafe {
        output::write_array(&from.chamfered.triangle_sources, sources, count)
    };
    // SAFETY: `result` is NULL or came from this library and is not destroyed.
    unsafe { inspect(result, write) }
}

/// Frees a result and every array viewed through it. NULL is allowed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn chamfer_result_destroy(result: *mut chamfer_result) {
    if check_pointer(result, "result").is_ok() {
        // SAFETY: it came from `produce`, and the caller gives it up.
        let freed = caught(|| drop(unsafe { Box::from_raw(result) }));
        // Nobody can be told of a fault, and nothing is left to undo.
        drop(freed);
    }
}

/// The caller's progress callback, as the core calls it.
///
/// # Safety
/// The callback may be called with `user` as long as what this gives lives.
unsafe fn reporting(
    progress: chamfer_progress,
    user: *mut c_void,
) -> impl FnMut(f32) -> ControlFlow<()> {
    move |done| match progress {
        // SAFETY: as this function's.
        Some(call) if unsafe { call(user, done) } != 0 => ControlFlow::Break(()),
        _ => ControlFlow::Continue(()),
    }
}

/// Runs `make` on a mesh and hands the result to the caller. `out` and `error` must not lie in the mesh.
///
/// # Safety
/// `mesh` as for [`input::borrow_mesh`]; `out` is NULL, misaligned or writable; `error` as for
/// [`guard`].
unsafe fn produce(
    mesh: *const chamfer_mesh,
    out: *mut *mut chamfer_result,
    error: *mut chamfer_error,
    make: impl FnOnce(Mesh) -> Result<Chamfered, Failure>,
) -> i32 {
    // SAFETY: as this function's.
    let apart = caught(|| unsafe { input::check_apart(mesh, out, error) });
    if let Err(failure) = apart.and_then(|apart| apart) {
        return failure.status;
    }
    let checked = check_pointer(out, "out");
    if checked.is_ok() {
        // SAFETY: checked, and the caller vouches for the rest. Cleared before anything can fail,
        // so that a result destroyed after a failure is NULL.
        unsafe { out.write(ptr::null_mut()) };
    }
    let body = || {
        checked?;
        // SAFETY: as this function's, and what is written is not what is read.
        let mesh = unsafe { input::borrow_mesh(mesh)? };
        let made = Box::new(chamfer_result::new(make(mesh)?));
        // SAFETY: as above.
        unsafe { out.write(Box::into_raw(made)) };
        Ok(())
    };
    // SAFETY: as this function's.
    unsafe { guard(error, body) }
}

/// Shows a result to `look`.
///
/// # Safety
/// `result` is NULL, misaligned, or came from [`produce`] and is not destroyed.
unsafe fn inspect(
    result: *const chamfer_result,
    look: impl FnOnce(&chamfer_result) -> Result<(), Failure>,
) -> i32 {
    let body = || {
        check_pointer(result, "result")?;
        // SAFETY: as this function's.
        look(unsafe { &*result })
    };
    // SAFETY: there is no error struct.
    unsafe { guard(ptr::null_mut(), body) }
}
