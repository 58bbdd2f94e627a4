//! The mesh of an OBJ file, in the layout of the core.

use std::collections::{BTreeMap, HashMap};

use anyhow::{Context, Result};
use chamfer::{MeshBuffers, UvBuffer, split_by_angle};

use crate::document::{Normals, NormalsRead, ReadOptions};
use crate::polygon::triangulate;

use super::parse::{Corner, Item, Obj};

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
    /// `#triangles`: the polygon of each.
    pub polygon_of: Vec<u32>,
    /// `#triangles by 3`: the places of its corners in the polygon.
    pub places: Vec<[u32; 3]>,
}

/// A mesh, and what its file does not tell about it.
pub struct Built {
    pub mesh: MeshBuffers,
    pub origin: Origin,
    pub normals: NormalsRead,
    /// How many corners have a normal that is none.
    pub without_direction: usize,
}

/// What tells two vertices apart. Equal values under different numbers are one value.
type Key = (u32, Option<[u32; 3]>, [u32; 3]);

/// Builds the mesh: a vertex for each distinct position number, texture coordinate and normal, a
/// submesh for each run of faces.
///
/// # Errors
/// Where there are more triangles than 32-bit indices allow.
pub fn build(obj: &Obj, options: &ReadOptions) -> Result<Built> {
    let Triangles { corners, counts, polygon_of, places } = triangles(obj)?;
    let normals = normals(obj, &corners, &polygon_of, options)?;
    let mut builder = Builder::new(obj);
    for (corner, normal) in corners.iter().zip(normals) {
        builder.corner(corner, normal);
    }
    builder.mesh.submesh_index_counts = counts;
    let Builder { mesh, origin, .. } = builder;
    let origin = Origin { polygon_of, places, ..origin };
    let (normals, without_direction) = match options.normals {
        Normals::Keep => (normals_read(obj, &corners, &mesh.indices), zero_normals(obj, &corners)),
        Normals::Angle => (NormalsRead { computed: true, ..NormalsRead::default() }, 0),
    };
    Ok(Built { mesh, origin, normals, without_direction })
}

/// The triangles of all polygons, one polygon after the other.
#[derive(Default)]
struct Triangles {
    /// `#triangles by 3`, flattened.
    corners: Vec<Corner>,
    /// `#runs of faces`: how many corners belong to each.
    counts: Vec<u32>,
    /// As in [`Origin`].
    polygon_of: Vec<u32>,
    places: Vec<[u32; 3]>,
}

fn triangles(obj: &Obj) -> Result<Triangles> {
    let mut triangles = Triangles::default();
    let (mut polygon, mut start) = (0, 0);
    for item in &obj.items {
        let Item::Faces(last) = *item else { continue };
        let before = triangles.corners.len();
        while polygon < last {
            let end = obj.polygon_ends[polygon];
            triangles.push(obj, &obj.corners[start..end], polygon as u32);
            (polygon, start) = (polygon + 1, end);
        }
        let count = triangles.corners.len() - before;
        triangles.counts.push(u32::try_from(count).context("too many faces")?);
    }
    u32::try_from(triangles.corners.len()).context("more triangles than 32-bit indices allow")?;
    Ok(triangles)
}

impl Triangles {
    fn push(&mut self, obj: &Obj, polygon: &[Corner], number: u32) {
        let points: Vec<_> = polygon.iter().map(|c| obj.positions[c.position as usize]).collect();
        for triangle in triangulate(&points) {
            self.corners.extend(triangle.map(|place| polygon[place]));
            self.polygon_of.push(number);
            self.places.push(triangle.map(|place| place as u32));
        }
    }
}

/// `#corners`: the normal that the file gives, or one made. All faces take part in the latter, so
/// that a face without normals shades with its neighbours.
fn normals(
    obj: &Obj,
    corners: &[Corner],
    polygon_of: &[u32],
    options: &ReadOptions,
) -> Result<Vec<[f32; 3]>> {
    if options.normals == Normals::Angle {
        return smoothed(obj, corners, options.smoothing_angle);
    }
    let given = |corner: &Corner| unit(obj.normals[corner.normal? as usize]);
    if let Some(normals) = corners.iter().map(given).collect() {
        return Ok(normals);
    }
    let made = match obj.smoothing_groups.iter().any(|group| *group > 0) {
        true => grouped(obj, corners, polygon_of)?,
        false => smoothed(obj, corners, options.smoothing_angle)?,
    };
    Ok(corners.iter().zip(made).map(|(corner, made)| given(corner).unwrap_or(made)).collect())
}

/// `#corners`: by the angle at which faces meet.
fn smoothed(obj: &Obj, corners: &[Corner], angle: f32) -> Result<Vec<[f32; 3]>> {
    let indices: Vec<u32> = corners.iter().map(|corner| corner.position).collect();
    let smoothed = split_by_angle(&obj.positions, &indices, angle)?;
    Ok(smoothed.indices.iter().map(|&index| smoothed.normals[index as usize]).collect())
}

/// The angle at which all faces around a place shade as one.
const ALL_FACES: f32 = 180.0;

/// `#corners`: by smoothing groups. All faces of one shade as one surface; one of none is flat.
fn grouped(obj: &Obj, corners: &[Corner], polygon_of: &[u32]) -> Result<Vec<[f32; 3]>> {
    // The triangles of a flat polygon are a group of their own, which no other has.
    let key = |triangle: usize| {
        let polygon = polygon_of[triangle];
        match obj.smoothing_groups[polygon as usize] {
            0 => (0, polygon),
            group => (group, 0),
        }
    };
    let mut members: BTreeMap<(u32, u32), Vec<usize>> = BTreeMap::new();
    for triangle in 0..polygon_of.len() {
        members.entry(key(triangle)).or_default().push(triangle);
    }
    let mut normals = vec![[0.0; 3]; corners.len()];
    for ((group, _), triangles) in members {
        let own: Vec<usize> =
            triangles.iter().flat_map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect();
        let of_group = match group {
            0 => vec![face_normal(obj, corners, &own); own.len()],
            _ => smoothed_alone(obj, corners, &own)?,
        };
        own.into_iter().zip(of_group).for_each(|(corner, normal)| normals[corner] = normal);
    }
    Ok(normals)
}

/// The normals of some corners, as if there were no others.
fn smoothed_alone(obj: &Obj, corners: &[Corner], own: &[usize]) -> Result<Vec<[f32; 3]>> {
    let used: Vec<u32> = own.iter().map(|&corner| corners[corner].position).collect();
    let mut known: Vec<u32> = used.clone();
    known.sort_unstable();
    known.dedup();
    let positions: Vec<[f32; 3]> = known.iter().map(|&at| obj.positions[at as usize]).collect();
    let local = |position: &u32| known.partition_point(|other| other < position) as u32;
    let indices: Vec<u32> = used.iter().map(local).collect();
    let smoothed = split_by_angle(&positions, &indices, ALL_FACES)?;
    Ok(smoothed.indices.iter().map(|&index| smoothed.normals[index as usize]).collect())
}

/// The normal of some triangles together, each as heavy as its area.
fn face_normal(obj: &Obj, corners: &[Corner], own: &[usize]) -> [f32; 3] {
    let mut sum = [0.0f64; 3];
    for triangle in own.as_chunks::<3>().0 {
        let [a, b, c] =
            triangle.map(|corner| obj.positions[corners[corner].position as usize].map(f64::from));
        let side = |to: [f64; 3]| [0, 1, 2].map(|axis| to[axis] - a[axis]);
        let (u, v) = (side(b), side(c));
        for (axis, sum) in sum.iter_mut().enumerate() {
            let (next, last) = ((axis + 1) % 3, (axis + 2) % 3);
            *sum += u[next] * v[last] - u[last] * v[next];
        }
    }
    let length = sum.iter().map(|value| value * value).sum::<f64>().sqrt();
    // One without area has no direction, and any will do.
    if length > 0.0 { sum.map(|value| (value / length) as f32) } else { [0.0, 0.0, 1.0] }
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

fn zero_normals(obj: &Obj, corners: &[Corner]) -> usize {
    let stored = corners.iter().filter_map(|corner| corner.normal);
    stored.filter(|&number| obj.normals[number as usize] == [0.0; 3]).count()
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
        let Built { mesh, origin, .. } =
            build(&parse(text.as_bytes()).unwrap(), &ReadOptions::default()).unwrap();
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

    //   2-----3     a ridge of two faces, and one that stands on it
    //   |  1  |\
    //   0-----4 5
    const RIDGE: &str = "v 0 0 0\nv 4 0 0\nv 4 1 0\nv 0 1 0\nv 4 0 -4\nv 4 1 -4\nv 0 0 -4\n";

    fn normals_of(groups: &str) -> Vec<[f32; 3]> {
        let [first, second] = [0, 1].map(|at| groups.split('|').nth(at).unwrap());
        let text = format!("{RIDGE}{first}\nf 1 2 3 4\n{second}\nf 2 5 6 3\n");
        let (mesh, _) = built(&text);
        mesh.indices.iter().map(|&index| mesh.normals[index as usize]).collect()
    }

    #[test]
    fn faces_of_one_smoothing_group_shade_as_one() {
        let smooth = normals_of("s 3|");
        let half = std::f32::consts::FRAC_1_SQRT_2;
        let at_ridge = smooth.iter().filter(|normal| (normal[0] - half).abs() < 1e-6).count();
        assert_eq!(at_ridge, 6, "{smooth:?}");
        for flat in ["s 1|s 2", "s 1|s off", "s off|s 4"] {
            let normals = normals_of(flat);
            assert!(normals[..6].iter().all(|normal| *normal == [0.0, 0.0, 1.0]), "{normals:?}");
            assert!(normals[6..].iter().all(|normal| *normal == [1.0, 0.0, 0.0]), "{normals:?}");
        }
    }

    /// Many programs write `s off` whatever the shading is, so alone it says nothing.
    #[test]
    fn without_any_group_the_angle_decides() {
        let gable = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 -0.1\nv 2 1 -0.1\n\
                     s off\nf 1 2 3 4\nf 2 5 6 3\n";
        let (mesh, _) = built(gable);
        assert_eq!(mesh.positions.len(), 6, "the two faces meet at a small angle");
    }
}
