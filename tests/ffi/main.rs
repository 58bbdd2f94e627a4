//! The C interface as its callers meet it: the built library, loaded or linked from outside.

#![allow(unsafe_code)]

/// The header's structs as Rust knows them; `programs` checks that a C compiler agrees.
#[allow(dead_code)]
#[path = "../../src/ffi/types.rs"]
mod types;

mod calls;
mod cube;
mod library;
mod misuse;
#[cfg(unix)]
mod programs;
mod scene;
mod selection;
