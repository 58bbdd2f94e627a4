//! The one gate of the exports: panics end here, failures become a status and an error struct.
//!
//! Only exports that return a constant do without. The host's panic hook is left alone, so a fault
//! of this library may still print its place.

use core::ffi::c_char;
use std::mem::offset_of;
use std::panic::{AssertUnwindSafe, catch_unwind};

use super::sized::{self, StatesSize};
use super::status::Failure;
use super::types::{CHAMFER_MESSAGE_SIZE, CHAMFER_NO_ELEMENT, CHAMFER_STATUS_OK, chamfer_error};

/// Runs `body`; a panic in it becomes a failure.
///
/// What `body` was changing when it panicked must not be looked at afterwards: exports write
/// through their pointers only when nothing can fail any more.
pub fn caught<T>(body: impl FnOnce() -> T) -> Result<T, Failure> {
    catch_unwind(AssertUnwindSafe(body)).map_err(|payload| Failure::from_panic(payload.as_ref()))
}

/// Runs `body` and tells its outcome to the caller.
///
/// # Safety
/// `error` is NULL or points to a `chamfer_error` that states its own size.
pub unsafe fn guard(error: *mut chamfer_error, body: impl FnOnce() -> Result<(), Failure>) -> i32 {
    // SAFETY: as this function's.
    if let Err(failure) = unsafe { check_error_struct(error) } {
        return failure.status;
    }
    let outcome = caught(body).and_then(|outcome| outcome);
    let status = outcome.as_ref().err().map_or(CHAMFER_STATUS_OK, |failure| failure.status);
    if !error.is_null() {
        // SAFETY: not NULL, and checked above.
        let _ = unsafe { sized::write(error, &describe(&outcome), "error") };
    }
    status
}

/// # Safety
/// As [`guard`].
unsafe fn check_error_struct(error: *mut chamfer_error) -> Result<(), Failure> {
    if error.is_null() {
        return Ok(());
    }
    // SAFETY: as this function's.
    unsafe { sized::stated_size(error, "error") }.map(|_| ())
}

fn describe(outcome: &Result<(), Failure>) -> chamfer_error {
    let mut error = chamfer_error::defaults();
    if let Err(failure) = outcome {
        error.status = failure.status;
        error.element = failure.element;
        error.mesh = failure.mesh;
        error.message = message_of(&failure.message);
    }
    error
}

/// The text with its final NUL, cut between two characters where it is too long.
fn message_of(text: &str) -> [c_char; CHAMFER_MESSAGE_SIZE] {
    let mut message = [0; CHAMFER_MESSAGE_SIZE];
    let mut length = text.len().min(CHAMFER_MESSAGE_SIZE - 1);
    while !text.is_char_boundary(length) {
        length -= 1;
    }
    for (place, byte) in message.iter_mut().zip(text[..length].bytes()) {
        *place = byte as c_char;
    }
    message
}

// SAFETY: numbers and characters only, the size first.
unsafe impl StatesSize for chamfer_error {
    const SIZES: &'static [usize] = &[offset_of!(chamfer_error, mesh), size_of::<chamfer_error>()];

    fn defaults() -> Self {
        chamfer_error {
            struct_size: size_of::<chamfer_error>() as u32,
            status: CHAMFER_STATUS_OK,
            element: CHAMFER_NO_ELEMENT,
            message: [0; CHAMFER_MESSAGE_SIZE],
            mesh: CHAMFER_NO_ELEMENT,
        }
    }
}

#[cfg(test)]
mod tests {
    use std::ptr;

    use super::*;
    use crate::ffi::types::{CHAMFER_STATUS_BAD_OPTION, CHAMFER_STATUS_INTERNAL};

    fn text_of(error: &chamfer_error) -> String {
        let bytes = error.message.iter().map(|&c| c as u8).take_while(|&byte| byte != 0);
        String::from_utf8(bytes.collect()).unwrap()
    }

    #[test]
    fn a_panic_becomes_a_status() {
        let mut error = chamfer_error::defaults();
        // SAFETY: the struct states its size.
        let status = unsafe { guard(&mut error, || panic!("lost {}", "count")) };
        assert_eq!((status, error.status), (CHAMFER_STATUS_INTERNAL, CHAMFER_STATUS_INTERNAL));
        assert!(text_of(&error).ends_with("lost count"));
    }

    #[test]
    fn a_long_message_is_cut_between_characters() {
        let mut error = chamfer_error::defaults();
        let failure = || Failure::new(CHAMFER_STATUS_BAD_OPTION, "é".repeat(200));
        // SAFETY: the struct states its size.
        unsafe { guard(&mut error, || Err(failure())) };
        assert_eq!(text_of(&error), "é".repeat(127));
    }

    #[test]
    fn success_clears_an_old_error() {
        let mut error = chamfer_error { status: 5, element: 5, ..chamfer_error::defaults() };
        // SAFETY: the struct states its size.
        assert_eq!(unsafe { guard(&mut error, || Ok(())) }, CHAMFER_STATUS_OK);
        assert_eq!((error.status, error.element), (CHAMFER_STATUS_OK, CHAMFER_NO_ELEMENT));
    }

    #[test]
    fn an_error_struct_is_optional() {
        // SAFETY: NULL is allowed.
        assert_eq!(unsafe { guard(ptr::null_mut(), || Ok(())) }, CHAMFER_STATUS_OK);
    }
}
