//! Noise: normals of a round surface that only chance has set apart.

use glam::DVec3;

use crate::ids::{Cluster, Corner};
use crate::tolerance::{CHORD_TURN, NOISE, NOISE_SHARE};
use crate::topology::Topology;
use crate::view::View;

/// The square of the cosine of what normals may differ by, and somewhat less for rounding.
const NEARLY_NOISE: f64 = 0.99;

/// Of the half-edges at which normals differ (`hard`: one of each edge), those, sorted, at whose start they
/// do by chance alone.
///
/// ```text
///   \ |  /      The surface that the normals tell is round: they stand off their faces.
///  .-\|_/-.     Where the vertex is split for the sake of a texture, noise has moved each of its
///  |  *   |     normals on its own: not as the faces turn, which would be a crease, nor as at the
///  '------'     other ends of the edges, which somebody would have meant.
/// ```
///
/// Where another edge is sharp or flat, what differs beside it is its end.
pub fn noise(view: &View, topology: &Topology, hard: &[Corner]) -> Vec<Corner> {
    let half_edges = || hard.iter().flat_map(|&side| [side, topology.twin[side]]);
    let end = |side: Corner| end_at(view, topology, side);
    let is_by_chance = |side: &Corner| {
        let normals = [*side, topology.twin[*side].next()].map(|corner| view.normal_at(corner));
        are_nearly_alike(normals) && end(*side).is_some_and(|end| end.is_by_chance(view))
    };
    let mut noise: Vec<Corner> = half_edges().filter(is_by_chance).collect();
    if noise.is_empty() {
        return noise;
    }
    noise.sort_unstable();
    let ends = || half_edges().filter_map(end);
    let place = |corner: Corner| topology.cluster_at[corner];
    let mut places: Vec<Cluster> = noise.iter().map(|&corner| place(corner)).collect();
    places.sort_unstable();
    let is_near = |end: &End| places.binary_search(&place(end.corners[0])).is_ok();
    let sharp = ends().filter(|end| is_near(end) && !end.is_round(view));
    let mut sharp: Vec<Cluster> = sharp.map(|end| place(end.corners[0])).collect();
    sharp.sort_unstable();
    noise.retain(|&corner| sharp.binary_search(&place(corner)).is_err());
    noise
}

/// How the normals of the two sides of an edge differ at its ends.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Ends {
    /// Not at all.
    Soft,
    /// By more than noise at one end, or at both.
    Hard,
    /// At one end at least by no more than noise, or little more.
    MayBeNoise,
}

/// The same of two half-edges that are twins.
#[inline(always)]
pub fn ends(view: &View, [side, twin]: [Corner; 2]) -> Ends {
    at_end(view, [side, twin.next()]).max(at_end(view, [side.next(), twin]))
}

/// The same at one end, of the corners of both sides.
#[inline(always)]
fn at_end(view: &View, corners: [Corner; 2]) -> Ends {
    let vertices = corners.map(|corner| view.vertex_at(corner));
    if vertices[0] == vertices[1] {
        return Ends::Soft;
    }
    let normals = vertices.map(|vertex| view.normal(vertex));
    match view.normals_differ(normals) {
        false => Ends::Soft,
        true if are_nearly_alike(normals) => Ends::MayBeNoise,
        true => Ends::Hard,
    }
}

/// Whether two normals are as near to each other as noise leaves them, or nearly so: most are not, and this
/// takes no root.
#[inline]
fn are_nearly_alike([one, other]: [DVec3; 2]) -> bool {
    let cosine = one.dot(other);
    let lengths = || one.length_squared() * other.length_squared();
    cosine > 0.0 && cosine * cosine >= NEARLY_NOISE * lengths()
}

/// One end of an edge at which its sides have normals of their own.
struct End {
    /// Of both sides, at the end.
    corners: [Corner; 2],
    /// The same at the other end.
    beyond: [Corner; 2],
    /// What the normals differ by.
    jump: DVec3,
}

/// The start of a half-edge, where normals differ from those of its twin.
fn end_at(view: &View, topology: &Topology, side: Corner) -> Option<End> {
    let twin = topology.twin[side];
    let corners = [side, if twin.is_some() { twin.next() } else { return None }];
    let [one, other] = corners.map(|corner| view.vertex_at(corner));
    if one == other || !view.normals_differ([view.normal(one), view.normal(other)]) {
        return None;
    }
    Some(End { corners, beyond: [side.next(), twin], jump: jump_at(view, corners) })
}

impl End {
    /// Whether its normals are those of a round surface, off each other by less than off their faces.
    fn is_round(&self, view: &View) -> bool {
        let size = self.jump.length();
        size <= NOISE
            && self.corners.into_iter().all(|corner| {
                let turn = facing_at(view, corner).distance(unit_at(view, corner));
                (size..CHORD_TURN).contains(&turn)
            })
    }

    /// Whether they are so, and neither as the faces are nor as at the other end.
    fn is_by_chance(&self, view: &View) -> bool {
        let is_as = |other: DVec3| self.jump.distance(other) <= NOISE_SHARE * self.jump.length();
        let bend = || {
            let [one, other] = self.corners.map(|corner| facing_at(view, corner));
            one - other
        };
        self.is_round(view) && !is_as(bend()) && !is_as(jump_at(view, self.beyond))
    }
}

fn jump_at(view: &View, [one, other]: [Corner; 2]) -> DVec3 {
    unit_at(view, one) - unit_at(view, other)
}

fn unit_at(view: &View, corner: Corner) -> DVec3 {
    view.normal_at(corner).normalize_or_zero()
}

/// The normal of a corner's face on the side to which that of the corner points, whichever way round
/// it is wound.
fn facing_at(view: &View, corner: Corner) -> DVec3 {
    let [a, b, c] = view.triangle(corner.triangle());
    let face = (b - a).cross(c - a).normalize_or_zero();
    if face.dot(view.normal_at(corner)) < 0.0 { -face } else { face }
}

#[cfg(test)]
mod tests {
    use crate::mesh::MeshBuffers;
    use crate::stages::stages_of;

    /// How many edges are hard where two faces meet along x, which each slope by half a bend, and their
    /// normals at both ends lean so (in degrees) across the edge and along it.
    ///
    /// ```text
    ///   2-------3
    ///   | near  |     z up, and y from far to near
    ///   0-------1
    ///   |  far  |
    ///   4-------5
    /// ```
    fn hard(bend: f32, near: [[f32; 2]; 2], far: [[f32; 2]; 2]) -> usize {
        let slope = (bend / 2.0).to_radians().tan();
        let at = |x: f32, y: f32| [x, y, -slope * y.abs()];
        let normal = |[across, along]: [f32; 2]| {
            let [(s, c), (t, d)] = [across, along].map(|angle| angle.to_radians().sin_cos());
            [t, s * d, c * d]
        };
        let places = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0], [0.0, -1.0], [1.0, -1.0]];
        let corners = [0, 1, 2, 3, 0, 1, 4, 5];
        let mesh = MeshBuffers {
            positions: corners.iter().map(|&c: &usize| at(places[c][0], places[c][1])).collect(),
            normals: [near, near, far, far].into_iter().flatten().map(normal).collect(),
            indices: vec![0, 1, 2, 2, 1, 3, 4, 6, 5, 6, 7, 5],
            submesh_index_counts: vec![12],
            ..MeshBuffers::default()
        };
        stages_of(&mesh, 0.01).edges.hard.len()
    }

    #[test]
    fn normals_of_a_round_surface_that_differ_by_chance_make_no_edge() {
        let (near, far) = ([[1.0, 7.0], [-1.0, -7.0]], [[-1.0, 9.0], [1.5, -7.5]]);
        assert_eq!(hard(15.0, near, far), 0);
        assert_eq!(hard(-15.0, near, far), 0);
        assert_eq!(hard(15.0, [[4.0, 7.0], [-1.0, -7.0]], far), 1, "more than noise is");
    }

    #[test]
    fn one_end_that_is_meant_is_enough() {
        let round = [[0.0, 8.0], [0.0, -8.0]];
        assert_eq!(hard(15.0, round, [[2.5, 8.0], [1.0, -6.0]]), 0);
        assert_eq!(hard(15.0, round, [[2.5, 8.0], [6.0, -8.0]]), 1);
    }

    #[test]
    fn a_flat_face_ends_where_its_normals_do() {
        let flat = [[0.0, 0.0], [0.0, 0.0]];
        assert_eq!(hard(0.0, flat, [[3.0, 0.5], [0.0, 0.0]]), 1);
        assert_eq!(hard(0.0, [[0.0, 5.0], [0.0, -5.0]], [[3.0, 5.5], [0.0, -5.0]]), 0);
    }

    /// A ridge around a smooth pillar, and its end: the normals turn along it, and break as it does.
    #[test]
    fn a_shallow_crease_of_a_round_surface_is_hard() {
        assert_eq!(hard(3.0, [[1.5, 8.0], [1.5, -8.0]], [[-1.5, 8.0], [-1.5, -8.0]]), 1);
        assert_eq!(hard(3.0, [[1.5, 8.0], [0.0, -8.0]], [[-1.5, 8.0], [0.0, -8.0]]), 1);
        assert_eq!(hard(3.0, [[-1.5, 8.0], [0.0, -8.0]], [[1.5, 8.0], [0.0, -8.0]]), 0);
    }

    /// Part of a bend is meant, and the rest round.
    #[test]
    fn what_breaks_alike_at_both_ends_is_hard() {
        assert_eq!(hard(12.0, [[2.4, 6.0], [2.4, -6.0]], [[-2.4, 6.0], [-2.2, -6.0]]), 1);
        assert_eq!(hard(12.0, [[2.4, 6.0], [0.0, -6.0]], [[-2.4, 6.0], [0.0, -6.0]]), 0);
    }
}
