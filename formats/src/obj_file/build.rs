//! The mesh of an OBJ file, in the layout of the core.

use std::collections::HashMap;

use anyhow::{Context, Result};
use chamfer::{MeshBuffers, UvBuffer, split_by_angle};

use crate::document::NormalsRead;

use super::parse::{Corner, Item, Obj};
use super::polygon::triangulate;

/// What rounding to 32 bits does to the length of a unit vector: one within it stays as it is, so
/// that a file read and written again is the same.
const UNIT_TOLERANCE: f64 = 2e-7;

/// Where the vertices of the mesh come from.
#[derive(Debug, Default)]
pub struct Origin {
    /// `#vertices`: the number of the `v` of each.
    pub position_of: Vec<u32>,
    /// `#vertices`: whether the file gives it texture coordinates.
    pub has_texcoord: Vec<bool>,
}

/// A mesh, and what its file does not tell about it.
pub struct Built {
    pub mesh: MeshBuffers,
    pub origin: Origin,
    pub normals: NormalsRead,
}

/// What tells two vertices apart. Equal values under different numbers are one value.
type Key = (u32, Option<[u32; 3]>, [u32; 3]);

/// Builds the mesh: a vertex for each distinct position number, texture coordinate and normal, a
/// submesh for each run of faces.
///
/// # Errors
/// Where there are more triangles than 32-bit indices allow.
pub fn build(obj: &Obj, smoothing_angle: f32) -> Result<Built> {
    let (corners, submesh_index_counts) = triangles(obj)?;
    let normals = normals(obj, &corners, smoothing_angle);
    let mut builder = Builder::new(obj);
    for (corner, normal) in corners.iter().zip(normals) {
        builder.corner(corner, normal);
    }
    builder.mesh.submesh_index_counts = submesh_index_counts;
    let Builder { mesh, origin, .. } = builder;
    let normals = normals_read(obj, &corners, &mesh.indices);
    Ok(Built { mesh, origin, normals })
}

/// The corners of all triangles, and how many belong to each run of faces.
fn triangles(obj: &Obj) -> Result<(Vec<Corner>, Vec<u32>)> {
    let mut corners = Vec::with_capacity(obj.corners.len());
    let mut counts = Vec::new();
    let (mut polygon, mut start) = (0, 0);
    for item in &obj.items {
        let Item::Faces(last) = *item else { continue };
        let before = corners.len();
        for &end in &obj.polygon_ends[polygon..last] {
            push_triangles(obj, &obj.corners[start..end], &mut corners);
            start = end;
        }
        polygon = last;
        counts.push(u32::try_from(corners.len() - before).context("too many faces")?);
    }
    u32::try_from(corners.len()).context("more triangles than 32-bit indices allow")?;
    Ok((corners, counts))
}

fn push_triangles(obj: &Obj, polygon: &[Corner], corners: &mut Vec<Corner>) {
    if polygon.len() == 3 {
        corners.extend(polygon);
        return;
    }
    let points: Vec<_> = polygon.iter().map(|c| obj.positions[c.position as usize]).collect();
    corners.extend(triangulate(&points).as_flattened().iter().map(|&place| polygon[place]));
}

/// `#corners`: the normal that the file gives, or one by the smoothing angle. All faces take part
/// in the latter, so that a face without normals shades with its neighbours.
fn normals(obj: &Obj, corners: &[Corner], smoothing_angle: f32) -> Vec<[f32; 3]> {
    let given = |corner: &Corner| unit(obj.normals[corner.normal? as usize]);
    if let Some(normals) = corners.iter().map(given).collect() {
        return normals;
    }
    let indices: Vec<u32> = corners.iter().map(|corner| corner.position).collect();
    let smoothed = split_by_angle(&obj.positions, &indices, smoothing_angle);
    let computed = smoothed.indices.iter().map(|&index| smoothed.normals[index as usize]);
    corners.iter().zip(computed).map(|(corner, other)| given(corner).unwrap_or(other)).collect()
}

/// Files with few digits have normals that are a little off unit length. Those that are farther off
/// than this are wrong.
const PLAINLY_NOT_UNIT: f64 = 1e-3;

fn normals_read(obj: &Obj, corners: &[Corner], indices: &[u32]) -> NormalsRead {
    let mut read = NormalsRead::default();
    for (corner, &index) in corners.iter().zip(indices) {
        let stored = corner.normal.map(|number| obj.normals[number as usize]);
        read.computed |= stored.is_none();
        let is_wrong = |&vector: &[f32; 3]| (length(vector) - 1.0).abs() > PLAINLY_NOT_UNIT;
        read.repaired.extend(stored.filter(is_wrong).map(|normal| (index, normal)));
    }
    read
}

fn length(vector: [f32; 3]) -> f64 {
    vector.iter().map(|&value| f64::from(value).powi(2)).sum::<f64>().sqrt()
}

/// The vector at length one; nothing for one without a direction.
fn unit(vector: [f32; 3]) -> Option<[f32; 3]> {
    let length = length(vector);
    if (length - 1.0).abs() < UNIT_TOLERANCE {
        return Some(vector);
    }
    (length > 0.0).then(|| vector.map(|value| (f64::from(value) / length) as f32))
}

struct Builder<'a> {
    obj: &'a Obj,
    mesh: MeshBuffers,
    origin: Origin,
    vertices: HashMap<Key, u32>,
}

impl<'a> Builder<'a> {
    fn new(obj: &'a Obj) -> Self {
        let mut mesh = MeshBuffers::default();
        // Coordinates that no face uses are no stream.
        if obj.corners.iter().any(|corner| corner.texcoord.is_some()) {
            mesh.uvs[0] = UvBuffer { components: obj.texcoord_components, values: Vec::new() };
        }
        Builder { obj, mesh, origin: Origin::default(), vertices: HashMap::new() }
    }

    fn corner(&mut self, corner: &Corner, normal: [f32; 3]) {
        let texcoord = corner.texcoord.map(|number| self.obj.texcoords[number as usize]);
        let bits = |values: [f32; 3]| values.map(f32::to_bits);
        let key = (corner.position, texcoord.map(bits), bits(normal));
        let next = self.mesh.positions.len() as u32;
        let vertex = *self.vertices.entry(key).or_insert(next);
        if vertex == next {
            self.vertex(corner.position, texcoord, normal);
        }
        self.mesh.indices.push(vertex);
    }

    fn vertex(&mut self, position: u32, texcoord: Option<[f32; 3]>, normal: [f32; 3]) {
        self.mesh.positions.push(self.obj.positions[position as usize]);
        self.mesh.normals.push(normal);
        if self.obj.color_components > 0 {
            self.mesh.colors.push(self.obj.colors[position as usize]);
        }
        let uv = &mut self.mesh.uvs[0];
        uv.values.extend(&texcoord.unwrap_or_default()[..uv.components as usize]);
        self.origin.position_of.push(position);
        self.origin.has_texcoord.push(texcoord.is_some());
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::obj_file::parse::parse;

    fn built(text: &str) -> (MeshBuffers, Origin) {
        let Built { mesh, origin, .. } = build(&parse(text.as_bytes()).unwrap(), 30.0).unwrap();
        (mesh, origin)
    }

    #[test]
    fn equal_corners_are_one_vertex_and_runs_are_submeshes() {
        let (mesh, origin) = built(
            "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 0 1\nvn 0 0 1\n\
             f 1//1 2//1 3//1\ng b\nf 1//2 3//2 4//2\n",
        );
        assert_eq!(mesh.indices, [0, 1, 2, 0, 2, 3]);
        assert_eq!(mesh.submesh_index_counts, [3, 3]);
        assert_eq!(origin.position_of, [0, 1, 2, 3]);
    }

    #[test]
    fn a_different_normal_splits_a_vertex() {
        let (mesh, origin) = built(
            "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nvn 0 2 0\nf 1//1 2//1 3//1\nf 1//2 3//2 2//2\n",
        );
        assert_eq!(mesh.positions.len(), 6);
        assert_eq!(mesh.normals[3], [0.0, 1.0, 0.0]);
        assert_eq!(origin.position_of, [0, 1, 2, 0, 2, 1]);
    }

    #[test]
    fn a_corner_without_texture_coordinates_has_a_place_holder() {
        let (mesh, origin) =
            built("v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0.5 0.25\nvn 0 0 1\nf 1/1/1 2/1/1 3//1\n");
        assert_eq!(mesh.uvs[0].components, 2);
        assert_eq!(mesh.uvs[0].values, [0.5, 0.25, 0.5, 0.25, 0.0, 0.0]);
        assert_eq!(origin.has_texcoord, [true, true, false]);
    }

    #[test]
    fn unused_texture_coordinates_are_no_stream() {
        let (mesh, _) = built("v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\nf 1//1 2//1 3//1\n");
        assert_eq!(mesh.uvs[0], UvBuffer::default());
    }

    #[test]
    fn normals_of_unit_length_keep_their_bits() {
        for vector in [[0.1, -0.7, 0.4], [3.0, 1.0, 1e-3], [1.0, 1.0, 1.0]] {
            let once = unit(vector).unwrap();
            assert_eq!(unit(once), Some(once));
        }
        assert_eq!(unit([0.0; 3]), None);
    }

    #[test]
    fn missing_and_zero_normals_are_computed() {
        let (mesh, _) = built("v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 0\nvn 0 0 -1\nf 1 2//1 3//2\n");
        assert_eq!(mesh.normals, [[0.0, 0.0, 1.0], [0.0, 0.0, 1.0], [0.0, 0.0, -1.0]]);
    }
}
