//! Smoothing: normals for models that have none.
//!
//! Faces that meet at a small angle shade as one surface: each corner gets the mean normal of the
//! faces around it that it can reach over such edges, weighted by their corner angles (Thürmer and
//! Wüthrich, "Computing Vertex Normals from Polygonal Facets", 1998).

use glam::DVec3;

use crate::error::Error;
use crate::faces::faces;
use crate::ids::{Corner, Id, IdVec, Vertex};
use crate::math::unit;
use crate::memory;
use crate::mesh::Mesh;
use crate::options::Options;
use crate::threads::Threads;
use crate::topology::{Topology, topology};
use crate::view::{View, check_finite, check_indices, wide};
use crate::watch::Unwatched;
use crate::weld::weld;

/// What errors call the angle.
pub const SMOOTHING_ANGLE: &str = "the smoothing angle";

/// A mesh with normals, its vertices split where normals differ.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Smoothed {
    /// `#vertices`: the source vertex of each. Source vertices keep their indices; copies follow.
    pub source_of: Vec<u32>,
    /// `#vertices by 3`, unit length.
    pub normals: Vec<[f32; 3]>,
    /// `#triangles by 3`, flattened.
    pub indices: Vec<u32>,
}

/// Gives each corner the angle-weighted mean normal of the faces around its position that are
/// joined to its own face by edges of at most `angle_degrees`.
///
/// `positions` are `#vertices by 3`; `indices` `#triangles by 3`, flattened. Positions are welded bit
/// for bit first, so that triangle soups work. A triangle without area takes the normal of the face
/// behind its longest side.
///
/// # Errors
/// An angle that is not within 0 to 180 degrees, positions that are not finite, indices that are out
/// of range or no multiple of three, and more of either than 32 bits or the memory can hold: the same
/// as in C.
pub fn split_by_angle(
    positions: &[[f32; 3]],
    indices: &[u32],
    angle_degrees: f32,
) -> Result<Smoothed, Error> {
    if !(0.0..=180.0).contains(&angle_degrees) {
        let option = SMOOTHING_ANGLE;
        return Err(Error::BadAngle { option, degrees: angle_degrees, most: 180.0 });
    }
    let counts = [u32::try_from(indices.len()).map_err(|_| Error::TooLarge)?];
    let mesh = Mesh { positions, indices, submesh_index_counts: &counts, ..Mesh::default() };
    check_indices(&mesh)?;
    check_finite(&mesh, &Unwatched)?;
    memory::ask(memory::of_normals(&mesh))?;
    split(positions, indices, &counts, angle_degrees)
}

/// All rules are kept here.
fn split(
    positions: &[[f32; 3]],
    indices: &[u32],
    counts: &[u32],
    angle_degrees: f32,
) -> Result<Smoothed, Error> {
    let mut smoothed = Smoothed {
        source_of: (0..positions.len() as u32).collect(),
        normals: vec![UNSET; positions.len()],
        indices: indices.to_vec(),
    };
    // Where parts touch, topology looks at normals; zero for all says nothing.
    let normals = vec![[0.0; 3]; positions.len()];
    let mesh = Mesh {
        positions,
        normals: &normals,
        indices,
        submesh_index_counts: counts,
        ..Mesh::default()
    };
    let view = View::new(mesh, Options::default().hard_angle);
    let topology = topology(&view, &weld(&mesh, &Unwatched)?, &Unwatched)?;
    let faces = faces(&view, &topology, (&Threads::default(), &Unwatched))?.normal;
    let cosine = libm::cos(f64::from(angle_degrees).to_radians());
    let is_smooth = |side: Corner| {
        let twin = topology.twin[side];
        twin.is_some() && faces[side.triangle()].dot(faces[twin.triangle()]) >= cosine
    };
    let mut variants = Variants { next: vec![Vertex::NONE; positions.len()] };
    let mut sums = IdVec::filled(None, indices.len());
    for corner in (0..indices.len()).map(Corner::new) {
        let sum = sums[corner].unwrap_or_else(|| {
            let fan = fan_of(&topology, &is_smooth, corner);
            let sum = fan.iter().map(|&at| faces[at.triangle()] * corner_angle(&view, at)).sum();
            fan.into_iter().for_each(|at| sums[at] = Some(sum));
            sum
        });
        let normal = normal_of(sum, faces[corner.triangle()]);
        let vertex = variants.of(view.vertex_at(corner), normal, &mut smoothed);
        smoothed.indices[corner.index()] = vertex.0;
    }
    // Vertices that no triangle uses still need a normal.
    for normal in smoothed.normals.iter_mut().filter(|normal| **normal == UNSET) {
        *normal = [0.0, 0.0, 1.0];
    }
    Ok(smoothed)
}

/// With more normals at one vertex than this, as at the tip of a huge cone, not all are compared:
/// two that are equal then may get a vertex each.
const MOST_COMPARED: usize = 64;

/// No unit normal looks like this.
const UNSET: [f32; 3] = [0.0; 3];

/// The corners that smooth edges join to this one, in order; it comes first where they go all the
/// way round.
fn fan_of(topology: &Topology, is_smooth: &impl Fn(Corner) -> bool, corner: Corner) -> Vec<Corner> {
    let mut first = corner;
    while is_smooth(first) {
        first = topology.twin[first].next();
        if first == corner {
            break;
        }
    }
    let mut fan = vec![first];
    let mut at = first;
    while is_smooth(at.prev()) {
        at = topology.twin[at.prev()];
        if at == first {
            break;
        }
        fan.push(at);
    }
    fan
}

/// The direction of a sum of normals; that of the own face where they cancel out.
fn normal_of(sum: DVec3, own: DVec3) -> [f32; 3] {
    let normal = [unit(sum), own].into_iter().find(|normal| *normal != DVec3::ZERO);
    normal.unwrap_or(DVec3::Z).as_vec3().to_array()
}

fn corner_angle(view: &View, corner: Corner) -> f64 {
    let at = view.position_at(corner);
    let to_next = view.position_at(corner.next()) - at;
    let to_prev = view.position_at(corner.prev()) - at;
    libm::atan2(to_next.cross(to_prev).length(), to_next.dot(to_prev))
}

/// The vertices that one source vertex became, as linked lists.
struct Variants {
    /// `#vertices`: another vertex of the same source vertex.
    next: Vec<Vertex>,
}

impl Variants {
    /// The vertex with this normal: the source vertex if it has none yet, or a copy.
    fn of(&mut self, source: Vertex, normal: [f32; 3], smoothed: &mut Smoothed) -> Vertex {
        let mut vertex = source;
        for _ in 0..MOST_COMPARED {
            let stored = &mut smoothed.normals[vertex.index()];
            if *stored == UNSET {
                *stored = normal;
            }
            if is_equal(*stored, normal) {
                return vertex;
            }
            let next = self.next[vertex.index()];
            if next.is_none() {
                break;
            }
            vertex = next;
        }
        let copy = Vertex::new(smoothed.normals.len());
        smoothed.normals.push(normal);
        smoothed.source_of.push(source.0);
        self.next.push(self.next[vertex.index()]);
        self.next[vertex.index()] = copy;
        copy
    }
}

/// The same fan summed from another corner differs in the last bits.
fn is_equal(one: [f32; 3], other: [f32; 3]) -> bool {
    wide(one).distance_squared(wide(other)) < 1e-12
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::Stream;

    /// Two squares that meet at the edge 1-2 at the given angle: 0 is flat.
    ///
    /// ```text
    /// 3---2---5
    /// |   |   |
    /// 0---1---4
    /// ```
    fn fold(degrees: f64) -> Smoothed {
        let (sin, cos) = degrees.to_radians().sin_cos();
        let (x, z) = (1.0 + cos as f32, -sin as f32);
        let positions = [
            [0.0, 0.0, 0.0],
            [1.0, 0.0, 0.0],
            [1.0, 1.0, 0.0],
            [0.0, 1.0, 0.0],
            [x, 0.0, z],
            [x, 1.0, z],
        ];
        split_by_angle(&positions, &[0, 1, 2, 0, 2, 3, 1, 4, 5, 1, 5, 2], 30.0).unwrap()
    }

    #[test]
    fn a_small_angle_is_smooth_and_a_large_one_hard() {
        assert_eq!(fold(20.0).normals.len(), 6);
        let hard = fold(40.0);
        assert_eq!(hard.source_of[6..], [1, 2], "both ends of the fold are split");
        assert_eq!(hard.normals[1], [0.0, 0.0, 1.0]);
    }

    #[test]
    fn a_smooth_normal_lies_between_those_of_its_faces() {
        let normal = fold(20.0).normals[1];
        let half = 10.0_f32.to_radians();
        assert!((normal[0] - half.sin()).abs() < 1e-6 && (normal[2] - half.cos()).abs() < 1e-6);
    }

    #[test]
    fn soups_are_welded_and_lone_vertices_get_some_normal() {
        let soup = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [9.0; 3]];
        let smoothed = split_by_angle(&soup, &[0, 1, 2], 30.0).unwrap();
        assert_eq!(smoothed.normals, [[0.0, 0.0, 1.0]; 4]);
    }

    #[test]
    fn bad_input_is_refused_as_in_c() {
        let mut points = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        let range = Error::IndexRange { place: 2, index: 3, vertices: 3 };
        assert_eq!(split_by_angle(&points, &[0, 1, 3], 30.0), Err(range));
        let count = Error::IndexCount { submesh: 0, count: 4 };
        assert_eq!(split_by_angle(&points, &[0, 1, 2, 0], 30.0), Err(count));
        let told = split_by_angle(&points, &[0, 1, 2], 181.0).unwrap_err().to_string();
        assert_eq!(told, "the smoothing angle is 181: give degrees from 0 to 180");
        assert!(split_by_angle(&points, &[0, 1, 2], f32::NAN).is_err());
        points[1][2] = f32::INFINITY;
        let not_finite = Error::NotFinite { stream: Stream::Positions, vertex: 1 };
        assert_eq!(split_by_angle(&points, &[0, 1, 2], 30.0), Err(not_finite));
    }
}
