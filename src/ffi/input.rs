//! From C pointers to the core's mesh and options.
//!
//! Only what concerns pointers, sizes and numbered options is checked here; what the values mean
//! is the core's to check. And what a call writes to must not lie in what it reads: arrays
//! of the mesh may overlap each other, but a result pointer or an error struct within one of them would
//! change the mesh under the library's hands, so nothing is written there, not even why.

use std::mem::offset_of;
use std::ops::Range;
use std::{array, ptr, slice};

use super::sized::{self, StatesSize, check_pointer};
use super::status::Failure;
use super::types::*;
use crate::view::MAX_CORNERS;
use crate::{
    ChamferSubmesh, Convexity, Error, Factors, Mesh, Options, UV_CHANNELS, Uv, Verify, Width,
    WidthMode,
};

const _: () = assert!(CHAMFER_UV_CHANNELS == UV_CHANNELS);

/// What a scene is made of, as the caller hands it over.
#[derive(Clone, Copy)]
pub struct SceneArrays {
    pub meshes: *const *const chamfer_mesh,
    pub mesh_count: usize,
    pub objects: *const chamfer_object,
    pub object_count: usize,
    pub options: *const chamfer_options,
}

/// Borrows a caller's mesh.
///
/// # Safety
/// `mesh` is NULL, misaligned, or points to a `chamfer_mesh` whose arrays hold what its counts
/// say, unchanged for `'a`.
pub unsafe fn borrow_mesh<'a>(mesh: *const chamfer_mesh) -> Result<Mesh<'a>, Failure> {
    // SAFETY: as this function's, here and for each array below.
    let mesh = unsafe { sized::read(mesh, "mesh") }?;
    let vertices = mesh.vertex_count as usize;
    unsafe {
        Ok(Mesh {
            positions: required(mesh.positions.cast(), vertices, "mesh->positions")?,
            normals: optional(mesh.normals.cast(), vertices, "mesh->normals")?,
            tangents: optional(mesh.tangents.cast(), vertices, "mesh->tangents")?,
            colors: optional(mesh.colors.cast(), vertices, "mesh->colors")?,
            uvs: borrow_uvs(&mesh.uvs, vertices)?,
            indices: required(mesh.indices, mesh.index_count as usize, "mesh->indices")?,
            submesh_index_counts: required(
                mesh.submesh_index_counts,
                mesh.submesh_count as usize,
                "mesh->submesh_index_counts",
            )?,
            held: required(mesh.held.cast(), mesh.held_count as usize, "mesh->held")?,
            factors: Factors {
                submeshes: optional(
                    mesh.submesh_factors,
                    mesh.submesh_count as usize,
                    "mesh->submesh_factors",
                )?,
                vertices: optional(mesh.vertex_factors, vertices, "mesh->vertex_factors")?,
                edges: required(
                    mesh.edge_factors.cast(),
                    mesh.edge_factor_count as usize,
                    "mesh->edge_factors",
                )?,
            },
        })
    }
}

/// # Safety
/// Each present channel holds `#vertices by components` floats, unchanged for `'a`.
unsafe fn borrow_uvs<'a>(
    uvs: &[chamfer_uv; CHAMFER_UV_CHANNELS],
    vertices: usize,
) -> Result<[Uv<'a>; UV_CHANNELS], Failure> {
    let mut borrowed = [Uv::default(); UV_CHANNELS];
    for (channel, (uv, slot)) in uvs.iter().zip(&mut borrowed).enumerate() {
        let components = uv.components;
        // Checked before there is a slice, as its length depends on it.
        if !matches!(components, 0 | 2..=4) {
            return Err(Error::UvComponents { channel: channel as u32, components }.into());
        }
        if components > 0 {
            let name = format!("mesh->uvs[{channel}].values");
            // A count past the address space saturates, and is refused like any such count.
            let count = vertices.saturating_mul(components as usize);
            // SAFETY: as this function's.
            let values = unsafe { required(uv.values, count, &name) }?;
            *slot = Uv { components, values };
        }
    }
    Ok(borrowed)
}

/// An array that must be there unless it has no elements.
///
/// # Safety
/// Where the pointer passes the checks, it points to `count` elements, unchanged for `'a`.
pub unsafe fn required<'a, T>(
    pointer: *const T,
    count: usize,
    name: &str,
) -> Result<&'a [T], Failure> {
    check_array(pointer, count, name)?;
    // SAFETY: not NULL, aligned, within the address space, and the caller vouches for the rest.
    Ok(if count == 0 { &[] } else { unsafe { slice::from_raw_parts(pointer, count) } })
}

/// Refuses what cannot be an array of so many elements.
pub fn check_array<T>(pointer: *const T, count: usize, name: &str) -> Result<(), Failure> {
    if count == 0 {
        return Ok(());
    }
    check_pointer(pointer, name)?;
    let bytes = count.checked_mul(size_of::<T>()).filter(|&bytes| bytes <= isize::MAX as usize);
    if bytes.and_then(|bytes| pointer.addr().checked_add(bytes)).is_none() {
        return Err(Failure::new(
            CHAMFER_STATUS_COUNT_OVERFLOW,
            format!(
                "{name} with {count} elements would not fit the address space: check the count"
            ),
        ));
    }
    Ok(())
}

/// An array that is absent where it is NULL.
///
/// # Safety
/// As [`required`].
unsafe fn optional<'a, T>(pointer: *const T, count: usize, name: &str) -> Result<&'a [T], Failure> {
    if pointer.is_null() {
        return Ok(&[]);
    }
    // SAFETY: as this function's.
    unsafe { required(pointer, count, name) }
}

/// Reads a caller's options; NULL stands for the defaults.
///
/// # Safety
/// `options` is NULL, misaligned, or points to a `chamfer_options` that states its size.
pub unsafe fn read_options(options: *const chamfer_options) -> Result<Options, Failure> {
    if options.is_null() {
        return Ok(Options::default());
    }
    // SAFETY: as this function's.
    if unsafe { sized::is_blank(options, "options") }? {
        return Ok(Options::default());
    }
    // SAFETY: as this function's.
    let options = unsafe { sized::read(options, "options") }?;
    Ok(Options {
        width: match options.width_unit {
            CHAMFER_WIDTH_MESH_UNITS => Width::Units(options.width),
            CHAMFER_WIDTH_PERCENT => Width::PercentOfExtent(options.width),
            other => return Err(bad_option("width_unit", other)),
        },
        least_breadth: or_default(options.least_breadth, Options::default().least_breadth),
        verify: match options.verify {
            CHAMFER_VERIFY_FAST => Verify::Fast,
            CHAMFER_VERIFY_FULL => Verify::Full,
            CHAMFER_VERIFY_SEEN => Verify::Seen,
            other => return Err(bad_option("verify", other)),
        },
        chamfer_submesh: match options.submesh_mode {
            CHAMFER_SUBMESH_OWNER => ChamferSubmesh::Owner,
            CHAMFER_SUBMESH_OWN => ChamferSubmesh::Own,
            CHAMFER_SUBMESH_GIVEN => ChamferSubmesh::Given(options.submesh),
            other => return Err(bad_option("submesh_mode", other)),
        },
        threads: options.threads,
        width_mode: match options.width_mode {
            CHAMFER_WIDTH_OFFSET => WidthMode::Offset,
            CHAMFER_WIDTH_CHORD => WidthMode::Chord,
            CHAMFER_WIDTH_DEPTH => WidthMode::Depth,
            CHAMFER_WIDTH_RADIUS => WidthMode::Radius,
            other => return Err(bad_option("width_mode", other)),
        },
        min_angle: options.min_angle,
        max_angle: or_default(options.max_angle, Options::default().max_angle),
        convexity: match options.convexity {
            CHAMFER_CONVEXITY_BOTH => Convexity::Both,
            CHAMFER_CONVEXITY_CONVEX => Convexity::Convex,
            CHAMFER_CONVEXITY_CONCAVE => Convexity::Concave,
            other => return Err(bad_option("convexity", other)),
        },
        hard_angle: or_default(options.hard_angle, Options::default().hard_angle),
        scale: match options.scale {
            zeros if zeros == [0.0; 9] => Options::default().scale,
            axes => [0, 3, 6].map(|first| [axes[first], axes[first + 1], axes[first + 2]]),
        },
        evenness: or_default(options.evenness, Options::default().evenness),
        segments: if options.segments == 0 { 1 } else { options.segments },
        profile: or_default(options.profile, Options::default().profile),
    })
}

/// Zero stands for the default, as in the structs of older callers.
fn or_default(value: f32, default: f32) -> f32 {
    if value == 0.0 { default } else { value }
}

fn bad_option(field: &str, value: u32) -> Failure {
    Failure::new(
        CHAMFER_STATUS_BAD_OPTION,
        format!("options->{field} is {value}: give one of the constants that chamfer.h lists"),
    )
}

// SAFETY: numbers and pointers only, the size first.
unsafe impl StatesSize for chamfer_mesh {
    const SIZES: &'static [usize] = &[
        offset_of!(chamfer_mesh, held_count),
        offset_of!(chamfer_mesh, submesh_factors),
        size_of::<chamfer_mesh>(),
    ];

    fn defaults() -> Self {
        chamfer_mesh {
            struct_size: size_of::<chamfer_mesh>() as u32,
            vertex_count: 0,
            positions: ptr::null(),
            normals: ptr::null(),
            tangents: ptr::null(),
            colors: ptr::null(),
            uvs: array::from_fn(|_| chamfer_uv { components: 0, values: ptr::null() }),
            submesh_count: 0,
            index_count: 0,
            submesh_index_counts: ptr::null(),
            indices: ptr::null(),
            held_count: 0,
            held: ptr::null(),
            submesh_factors: ptr::null(),
            vertex_factors: ptr::null(),
            edge_factor_count: 0,
            edge_factors: ptr::null(),
        }
    }
}

// SAFETY: numbers only, the size first.
unsafe impl StatesSize for chamfer_options {
    // Before the least breadth there were seven fields, before the width mode eight.
    const SIZES: &'static [usize] =
        &[28, 32, offset_of!(chamfer_options, evenness), size_of::<chamfer_options>()];

    fn defaults() -> Self {
        let options = Options::default();
        let (width, width_unit) = match options.width {
            Width::Units(width) => (width, CHAMFER_WIDTH_MESH_UNITS),
            Width::PercentOfExtent(percent) => (percent, CHAMFER_WIDTH_PERCENT),
        };
        let (submesh_mode, submesh) = match options.chamfer_submesh {
            ChamferSubmesh::Owner => (CHAMFER_SUBMESH_OWNER, 0),
            ChamferSubmesh::Own => (CHAMFER_SUBMESH_OWN, 0),
            ChamferSubmesh::Given(submesh) => (CHAMFER_SUBMESH_GIVEN, submesh),
        };
        chamfer_options {
            struct_size: size_of::<chamfer_options>() as u32,
            width,
            width_unit,
            verify: match options.verify {
                Verify::Fast => CHAMFER_VERIFY_FAST,
                Verify::Full => CHAMFER_VERIFY_FULL,
                Verify::Seen => CHAMFER_VERIFY_SEEN,
            },
            submesh_mode,
            submesh,
            threads: options.threads,
            least_breadth: options.least_breadth,
            width_mode: CHAMFER_WIDTH_OFFSET,
            min_angle: options.min_angle,
            max_angle: options.max_angle,
            convexity: CHAMFER_CONVEXITY_BOTH,
            hard_angle: options.hard_angle,
            scale: array::from_fn(|k| options.scale[k / 3][k % 3]),
            evenness: options.evenness,
            segments: options.segments,
            profile: options.profile,
        }
    }
}

/// Refuses an `out` or `error` that overlaps the mesh, or one the other.
///
/// # Safety
/// As [`borrow_mesh`]; `error` as for a call; `out` may be anything.
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
/// `meshes` holds `mesh_count` pointers, each as for [`borrow_mesh`], or is an array that
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
    if let Ok(pointers) = unsafe { required(meshes, mesh_count, "meshes") } {
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
/// As [`borrow_mesh`].
unsafe fn add_mesh(mesh: *const chamfer_mesh, ranges: &mut Vec<Range<usize>>) {
    // SAFETY: as this function's.
    let Ok(borrowed) = (unsafe { borrow_mesh(mesh) }) else {
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_defaults_are_those_of_the_core() {
        let defaults = chamfer_options::defaults();
        // SAFETY: the struct states its size.
        assert_eq!(unsafe { read_options(&defaults) }.unwrap(), Options::default());
    }

    /// Of the size of `today` or shorter, with all else zero but for what `set` does.
    fn zeroed(size: usize, set: impl Fn(&mut chamfer_options)) -> Options {
        // SAFETY: numbers only, so that zero bytes are a value.
        let mut options: chamfer_options = unsafe { std::mem::zeroed() };
        options.struct_size = size as u32;
        set(&mut options);
        // SAFETY: the struct states its size.
        unsafe { read_options(&options) }.unwrap()
    }

    #[test]
    fn zeroed_options_are_the_defaults_unless_something_is_set() {
        for &size in chamfer_options::SIZES {
            assert_eq!(zeroed(size, |_| {}), Options::default());
            let on_one_thread = zeroed(size, |options| options.threads = 1);
            assert_eq!(on_one_thread.width, Width::Units(0.0));
            let wide = zeroed(size, |options| options.width = 0.5);
            assert_eq!((wide.width, wide.verify), (Width::Units(0.5), Verify::Fast));
        }
        let least = zeroed(size_of::<chamfer_options>(), |options| options.least_breadth = 0.5);
        assert_eq!((least.width, least.least_breadth), (Width::Units(0.0), 0.5));
    }
}
