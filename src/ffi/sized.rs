//! Structs that state their own size, so that library and caller may be of different age.
//!
//! An older caller's struct is shorter: fields that it lacks have their defaults. A newer caller's
//! is longer: what this library does not know must be zero, which every later field takes for its
//! default, so that no wish is dropped in silence.

use std::{ptr, slice};

use super::status::Failure;
use super::types::*;

/// A struct of the header with `struct_size` as its first field.
///
/// # Safety
/// `repr(C)`, the first field a `u32`, and any bytes a caller may write are valid values.
pub unsafe trait StatesSize: Copy {
    /// Every size that was ever released, ascending; the last is today's.
    const SIZES: &'static [usize];

    /// The struct with the default in each field, and today's size.
    fn defaults() -> Self;
}

/// No struct grows past this. A larger size is garbage, and reading that far could fault.
const LARGEST_SIZE: usize = 4096;

/// Refuses NULL and pointers that are not aligned for a `T`.
pub fn check_pointer<T>(pointer: *const T, name: &str) -> Result<(), Failure> {
    if pointer.is_null() {
        return Err(Failure::new(
            CHAMFER_STATUS_NULL_POINTER,
            format!("{name} is NULL: give a valid pointer"),
        ));
    }
    if !pointer.is_aligned() {
        return Err(Failure::new(
            CHAMFER_STATUS_MISALIGNED,
            format!("{name} is not aligned to {} bytes", align_of::<T>()),
        ));
    }
    Ok(())
}

/// The size that a caller's struct states, if it is one that can be worked with.
///
/// # Safety
/// `pointer` is NULL, misaligned, or points to a readable `u32`.
pub unsafe fn stated_size<T: StatesSize>(pointer: *const T, name: &str) -> Result<usize, Failure> {
    check_pointer(pointer, name)?;
    // SAFETY: not NULL, aligned, and the caller vouches for the rest.
    let size = unsafe { pointer.cast::<u32>().read() } as usize;
    let newer = size > size_of::<T>() && size <= LARGEST_SIZE;
    if newer || T::SIZES.contains(&size) {
        return Ok(size);
    }
    Err(Failure::new(
        CHAMFER_STATUS_STRUCT_SIZE,
        format!("{name}->struct_size is {size}: set it to sizeof, here {}", size_of::<T>()),
    ))
}

/// Whether nothing but its size is set in a caller's struct, as by `= {sizeof options}`: whoever writes
/// that wants the defaults.
///
/// # Safety
/// As [`read`].
pub unsafe fn is_blank<T: StatesSize>(pointer: *const T, name: &str) -> Result<bool, Failure> {
    // SAFETY: as this function's.
    let size = unsafe { stated_size(pointer, name) }?;
    // SAFETY: the struct has that many bytes, numbers only.
    let bytes = unsafe { slice::from_raw_parts(pointer.cast::<u8>(), size) };
    Ok(bytes[size_of::<u32>()..].iter().all(|&byte| byte == 0))
}

/// Reads a caller's struct.
///
/// # Safety
/// `pointer` is NULL, misaligned, or points to as many readable bytes as the struct states.
pub unsafe fn read<T: StatesSize>(pointer: *const T, name: &str) -> Result<T, Failure> {
    // SAFETY: as this function's.
    let size = unsafe { stated_size(pointer, name) }?;
    let known = size.min(size_of::<T>());
    let mut value = T::defaults();
    // SAFETY: both structs have `known` bytes, and any bytes are a valid `T`.
    let tail = unsafe {
        ptr::copy_nonoverlapping(pointer.cast::<u8>(), (&raw mut value).cast::<u8>(), known);
        slice::from_raw_parts(pointer.cast::<u8>().add(known), size - known)
    };
    if tail.iter().any(|&byte| byte != 0) {
        return Err(Failure::new(
            CHAMFER_STATUS_STRUCT_SIZE,
            format!("{name} sets fields that this older library does not know: leave them zero"),
        ));
    }
    Ok(value)
}

/// Fills a caller's struct, all but its size, as far as it reaches.
///
/// # Safety
/// `pointer` is NULL, misaligned, or points to as many writable bytes as the struct states.
pub unsafe fn write<T: StatesSize>(pointer: *mut T, value: &T, name: &str) -> Result<(), Failure> {
    const HEAD: usize = size_of::<u32>();
    // SAFETY: as this function's.
    let size = unsafe { stated_size(pointer, name) }?;
    let known = size.min(size_of::<T>());
    let from = ptr::from_ref(value).cast::<u8>();
    // SAFETY: the caller's struct has `size` bytes, and `value` at least `known` of them.
    unsafe {
        let to = pointer.cast::<u8>();
        ptr::copy_nonoverlapping(from.add(HEAD), to.add(HEAD), known - HEAD);
        ptr::write_bytes(to.add(known), 0, size - known);
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[repr(C)]
    #[derive(Clone, Copy, Debug, PartialEq)]
    struct Second {
        struct_size: u32,
        first: u32,
        added: u32,
    }

    // SAFETY: numbers only, the size first.
    unsafe impl StatesSize for Second {
        const SIZES: &'static [usize] = &[8, 12];

        fn defaults() -> Self {
            Second { struct_size: 12, first: 1, added: 2 }
        }
    }

    fn read_words(words: &[u32]) -> Result<Second, Failure> {
        // SAFETY: the tests state sizes within their arrays.
        unsafe { read(words.as_ptr().cast(), "options") }
    }

    fn write_words(words: &mut [u32]) {
        let value = Second { struct_size: 12, first: 7, added: 8 };
        // SAFETY: as above.
        unsafe { write(words.as_mut_ptr().cast(), &value, "options") }.unwrap();
    }

    #[test]
    fn a_shorter_struct_gets_defaults_for_what_it_lacks() {
        assert_eq!(read_words(&[8, 5]).unwrap(), Second { struct_size: 8, first: 5, added: 2 });
    }

    #[test]
    fn a_longer_struct_must_leave_the_unknown_zero() {
        assert_eq!(read_words(&[16, 5, 6, 0]).unwrap().added, 6);
        assert_eq!(read_words(&[16, 5, 6, 1]).unwrap_err().status, CHAMFER_STATUS_STRUCT_SIZE);
    }

    #[test]
    fn other_sizes_are_refused() {
        for size in [0, 4, 9, 11, 4097, u32::MAX] {
            assert_eq!(read_words(&[size, 5]).unwrap_err().status, CHAMFER_STATUS_STRUCT_SIZE);
        }
    }

    #[test]
    fn writing_stays_within_the_stated_size() {
        let mut shorter = [8, 9, 9];
        write_words(&mut shorter);
        assert_eq!(shorter, [8, 7, 9]);
        let mut longer = [16, 9, 9, 9, 9];
        write_words(&mut longer);
        assert_eq!(longer, [16, 7, 8, 0, 9]);
    }
}
