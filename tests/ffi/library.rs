//! The built library, opened with `dlopen`.

use std::env::consts::{DLL_PREFIX, DLL_SUFFIX};
use std::ffi::{c_char, c_void};
use std::path::PathBuf;
use std::sync::LazyLock;
use std::{env, fs};

use object::Object;

use crate::types::*;

/// Where cargo put the library for these tests: beside their executable.
pub fn path() -> PathBuf {
    let path =
        env::current_exe().unwrap().with_file_name(format!("{DLL_PREFIX}chamfer{DLL_SUFFIX}"));
    assert!(path.is_file(), "cargo left no {}", path.display());
    path
}

macro_rules! library {
    ($($name:ident($($parameter:ty),*) $(-> $returned:ty)?;)*) => {
        /// Every exported function.
        pub struct Library {
            $(pub $name: unsafe extern "C" fn($($parameter),*) $(-> $returned)?,)*
        }

        const NAMES: &[&str] = &[$(stringify!($name)),*];

        /// The library, opened once and kept open.
        pub static LIBRARY: LazyLock<Library> = LazyLock::new(|| {
            // SAFETY: our own library, which runs nothing when it is opened; the signatures are
            // those of the header.
            unsafe {
                let library = Box::leak(Box::new(libloading::Library::new(path()).unwrap()));
                Library { $($name: *library.get(stringify!($name)).unwrap(),)* }
            }
        });
    };
}

library! {
    chamfer_abi_version() -> u32;
    chamfer_version_string() -> *const c_char;
    chamfer_status_string(i32) -> *const c_char;
    chamfer_reason_string(u32) -> *const c_char;
    chamfer_options_init(*mut chamfer_options) -> i32;
    chamfer_mesh_init(*mut chamfer_mesh) -> i32;
    chamfer_run(
        *const chamfer_mesh,
        *const chamfer_options,
        chamfer_progress,
        *mut c_void,
        *mut *mut c_void,
        *mut chamfer_error
    ) -> i32;
    chamfer_scene_run(
        *const *const chamfer_mesh,
        u32,
        *const chamfer_object,
        u32,
        *const chamfer_options,
        chamfer_progress,
        *mut c_void,
        *mut *mut c_void,
        *mut chamfer_error
    ) -> i32;
    chamfer_split_by_angle(*const chamfer_mesh, f32, *mut *mut c_void, *mut chamfer_error) -> i32;
    chamfer_result_mesh(*const c_void, *mut chamfer_mesh) -> i32;
    chamfer_result_totals(*const c_void, *mut chamfer_totals) -> i32;
    chamfer_result_verdicts(*const c_void, *mut *const chamfer_edge_verdict, *mut u32) -> i32;
    chamfer_result_vertex_sources(
        *const c_void,
        *mut *const chamfer_vertex_source,
        *mut u32
    ) -> i32;
    chamfer_result_triangle_sources(
        *const c_void,
        *mut *const chamfer_triangle_source,
        *mut u32
    ) -> i32;
    chamfer_result_destroy(*mut c_void);
}

fn sorted<T: Ord>(names: impl IntoIterator<Item = T>) -> Vec<T> {
    let mut names: Vec<T> = names.into_iter().collect();
    names.sort();
    names
}

/// The functions that the header declares.
fn declared() -> Vec<String> {
    let header = fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/include/chamfer.h"));
    let header = header.unwrap();
    let code = header.lines().filter(|line| !line.trim_start().starts_with(['/', '*']));
    sorted(code.filter_map(|line| {
        let before = line.split_once('(')?.0;
        let name = before.rsplit([' ', '*']).next()?;
        name.starts_with("chamfer_").then(|| name.to_owned())
    }))
}

/// The functions that the library exports.
fn exported() -> Vec<String> {
    let bytes = fs::read(path()).unwrap();
    let library = object::File::parse(&*bytes).unwrap();
    let names = library.exports().unwrap();
    let names = names.iter().map(|export| String::from_utf8_lossy(export.name()).into_owned());
    // Mach-O puts an underscore before each name.
    let names = names.map(|name| name.trim_start_matches('_').to_owned());
    sorted(names.filter(|name| name.starts_with("chamfer")))
}

#[test]
fn the_library_exports_what_the_header_declares() {
    assert_eq!(exported(), declared());
}

#[test]
fn these_tests_know_every_function() {
    assert_eq!(sorted(NAMES.iter().map(|name| name.to_string())), declared());
}
