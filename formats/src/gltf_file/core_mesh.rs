//! The streams of the core, out of a mesh's blocks.

use chamfer::{Error, MeshBuffers, UV_CHANNELS, UvBuffer, split_by_angle};
use glam::Vec3;

use crate::document::{NormalsRead, no_direction};

use super::geometry::{Block, MeshGeometry, Origin, has_no_direction};

/// Normals within this of unit length are kept bit for bit; it covers the rounding of bytes, the
/// coarsest type that floats are likely to have been made from.
const UNIT_TOLERANCE: f32 = 1e-2;

/// Builds the mesh for the core. Where normals are missing, or none of a block has a direction, faces that meet at up to
/// `smoothing_angle` degrees share them, and vertices are split: the geometry learns of the copies.
pub fn build(geometry: &mut MeshGeometry, smoothing_angle: f32) -> Result<MeshBuffers, Error> {
    let mut indices = geometry.indices().to_vec();
    let smooth_normals = smooth(geometry, smoothing_angle, &mut indices)?;
    let mut normals = normals(geometry, &smooth_normals);
    fill_in(&mut normals, geometry, &indices)?;
    let mut uvs: [UvBuffer; UV_CHANNELS] = Default::default();
    for (channel, uv) in uvs.iter_mut().enumerate() {
        *uv = uv_channel(geometry, channel);
    }
    Ok(MeshBuffers {
        positions: stream(geometry, "POSITION", |_, value| array(value, 0.0)),
        normals,
        tangents: tangents(geometry, &smooth_normals),
        colors: stream_if_any(geometry, "COLOR_0", |_, value| array(value, 1.0)),
        uvs,
        submesh_index_counts: geometry.submesh_index_counts(),
        indices,
    })
}

/// Splits the vertices of the blocks without normals; gives all vertices normals (those of other
/// blocks are meaningless), or none where no block lacks them.
fn smooth(
    geometry: &mut MeshGeometry,
    angle: f32,
    indices: &mut [u32],
) -> Result<Vec<[f32; 3]>, Error> {
    if !geometry.blocks.iter().any(|block| block.smoothed) {
        return Ok(Vec::new());
    }
    let places: Vec<usize> = (0..indices.len())
        .filter(|place| {
            let origin = geometry.origins[indices[*place] as usize];
            geometry.blocks[origin.block as usize].smoothed
        })
        .collect();
    let corners: Vec<u32> = places.iter().map(|place| indices[*place]).collect();
    let positions = stream(geometry, "POSITION", |_, value| array(value, 0.0));
    let smoothed = split_by_angle(&positions, &corners, angle)?;
    for (place, index) in places.into_iter().zip(smoothed.indices) {
        indices[place] = index;
    }
    let known = geometry.origins.len();
    let copies = smoothed.source_of.iter().skip(known);
    let origins: Vec<Origin> = copies.map(|source| geometry.origins[*source as usize]).collect();
    geometry.origins.extend(origins);
    Ok(smoothed.normals)
}

fn normals(geometry: &MeshGeometry, smooth: &[[f32; 3]]) -> Vec<[f32; 3]> {
    let is_smoothed =
        |vertex: usize| geometry.blocks[geometry.origins[vertex].block as usize].smoothed;
    stream(geometry, "NORMAL", |vertex, value| match value {
        Some(_) if !is_smoothed(vertex) => unit(array(value, 0.0)),
        _ => unit(smooth.get(vertex).copied().unwrap_or_default()),
    })
}

/// Gives vertices whose normals have no direction that of their faces, where others of their block
/// have one.
fn fill_in(
    normals: &mut [[f32; 3]],
    geometry: &MeshGeometry,
    indices: &[u32],
) -> Result<(), Error> {
    let stored = geometry.streams(None, "NORMAL");
    let is_zero = |index: &u32| {
        let block = geometry.origins[*index as usize].block as usize;
        let value = stored.at(*index as usize).filter(|_| !geometry.blocks[block].smoothed);
        value.is_some_and(has_no_direction)
    };
    let places: Vec<usize> = (0..indices.len()).filter(|&at| is_zero(&indices[at])).collect();
    if places.is_empty() {
        return Ok(());
    }
    let positions = stream(geometry, "POSITION", |_, value| array(value, 0.0));
    let smoothed = split_by_angle(&positions, indices, ALL_FACES)?;
    for place in places {
        let normal = smoothed.normals[smoothed.indices[place] as usize];
        normals[indices[place] as usize] = normal;
    }
    Ok(())
}

/// The angle at which all faces around a place shade as one.
const ALL_FACES: f32 = 180.0;

/// Quantized normals are a little off unit length; what has no direction gets one.
fn unit(normal: [f32; 3]) -> [f32; 3] {
    let vector = Vec3::from(normal);
    if (vector.length() - 1.0).abs() <= UNIT_TOLERANCE && vector.length_squared() > 0.0 {
        return normal;
    }
    vector.try_normalize().unwrap_or(Vec3::Z).to_array()
}

/// Which normals are not those of the file.
pub fn normals_read(geometry: &MeshGeometry, mesh: &MeshBuffers) -> NormalsRead {
    let stored = geometry.streams(None, "NORMAL");
    let mut read = NormalsRead {
        computed: geometry.blocks.iter().any(|block| block.smoothed),
        ..NormalsRead::default()
    };
    for (vertex, &used) in (0..).zip(&mesh.normals) {
        let block = geometry.origins[vertex as usize].block as usize;
        let value = stored.at(vertex as usize).filter(|_| !geometry.blocks[block].smoothed);
        let value = value.map(|value| array(Some(value), 0.0));
        read.repaired.extend(value.filter(|&value| value != used).map(|value| (vertex, value)));
    }
    read
}

/// How many normals of blocks that have none with a direction.
pub fn without_direction(geometry: &MeshGeometry) -> usize {
    let is_unread = |origin: &&Origin| {
        let block = &geometry.blocks[origin.block as usize];
        block.smoothed && block.attribute("NORMAL").is_some()
    };
    geometry.origins.iter().filter(is_unread).count()
}

/// Says that normals of the file point nowhere; others were made.
pub fn note(name: &str, without: usize, read: &NormalsRead) -> Option<String> {
    let filled = read.repaired.iter().filter(|(_, stored)| *stored == [0.0; 3]).count();
    let count = filled + without;
    no_direction(count).map(|note| format!("mesh {name}: {note}"))
}

/// Tangents of a block without normals count for nothing, so the specification says.
fn tangents(geometry: &MeshGeometry, smooth: &[[f32; 3]]) -> Vec<[f32; 4]> {
    let has = |block: &Block| !block.smoothed && block.attribute("TANGENT").is_some();
    if !geometry.blocks.iter().any(has) {
        return Vec::new();
    }
    let normals = normals(geometry, smooth);
    stream(geometry, "TANGENT", |vertex, value| match value {
        Some(_) if has(&geometry.blocks[geometry.origins[vertex].block as usize]) => {
            array(value, 1.0)
        }
        _ => Vec3::from(normals[vertex]).any_orthonormal_vector().extend(1.0).to_array(),
    })
}

fn uv_channel(geometry: &MeshGeometry, channel: usize) -> UvBuffer {
    let name = format!("TEXCOORD_{channel}");
    let values: Vec<[f32; 2]> = stream_if_any(geometry, &name, |_, value| array(value, 0.0));
    UvBuffer { components: if values.is_empty() { 0 } else { 2 }, values: values.concat() }
}

fn stream_if_any<const N: usize>(
    geometry: &MeshGeometry,
    name: &str,
    value: impl Fn(usize, Option<&[f64]>) -> [f32; N],
) -> Vec<[f32; N]> {
    match geometry.streams(None, name).exist() {
        true => stream(geometry, name, value),
        false => Vec::new(),
    }
}

fn stream<const N: usize>(
    geometry: &MeshGeometry,
    name: &str,
    value: impl Fn(usize, Option<&[f64]>) -> [f32; N],
) -> Vec<[f32; N]> {
    let streams = geometry.streams(None, name);
    (0..geometry.origins.len()).map(|vertex| value(vertex, streams.at(vertex))).collect()
}

/// The first numbers of a value; what it lacks is `fill`.
fn array<const N: usize>(value: Option<&[f64]>, fill: f32) -> [f32; N] {
    let value = value.unwrap_or_default();
    std::array::from_fn(|index| value.get(index).map_or(fill, |number| *number as f32))
}
