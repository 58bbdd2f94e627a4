//! Hard edges that were not there before.

use glam::DVec3;

use super::flatness::{LEAST_HEIGHT, is_low};
use super::junctions::run_along;
use super::origins::Origins;
use super::rules::{Element, Findings, Rule};
use super::stored::normal_with_area;
use super::surface::{HalfEdge, Surface};

/// A triangle whose normals lean by less (two degrees) from its own is shaded as flat: those of a
/// face may by one, and the corners of a small one are rounded.
const FLAT_COSINE: f64 = 0.999_4;

/// Every hard edge is one of the source's, between the same two triangles; where some of those are
/// not found, one that is not between two that are may be theirs. Where a chamfer tapers
/// to a point on a hard edge, both normals are left at that point, and edges of new triangles may
/// be hard between the two at that end.
pub(super) fn check_hard_edges(
    before: &Surface,
    after: &Surface,
    origins: &Origins,
    findings: &mut Findings,
) {
    let hard_before = hard_corners(before);
    let old_normals = old_normals(after, origins);
    for edge in after.edges().filter(|edge| after.is_hard(edge)) {
        let ([forward], [backward]) = edge else { continue };
        let is_old = match [forward, backward].map(|side| source_side(side, origins)) {
            // A cut through a triangle is no edge of the source. One that folds onto itself has two
            // sides on one edge, as it had.
            [Some(one), Some(other)] if one / 3 == other / 3 && !is_one(forward, backward) => false,
            [Some(one), Some(other)] => {
                hard_before[one as usize] && hard_before[other as usize]
                    || parted_before(before, one, other)
                    || [one, other].iter().any(|&side| closes_hard(before, &hard_before, side / 3))
            }
            _ if findings.lost > 0 => true,
            _ => [0, 1].iter().all(|&end| {
                let corners = [forward.corners[end], backward.corners[1 - end]];
                let is_left = |&corner: &u32| {
                    old_normals.binary_search(&normal_at(after, corner)).is_ok()
                        || continues_face(after, origins, corner / 3)
                };
                after.share_normal(corners) || corners.iter().all(is_left)
            }),
        };
        if !is_old {
            findings.note(Rule::HardEdges, Element::Edge(forward.clusters[0], forward.clusters[1]));
        }
    }
}

/// Whether two half-edges belong to one triangle.
fn is_one(one: &HalfEdge, other: &HalfEdge) -> bool {
    one.corners[0] / 3 == other.corners[0] / 3
}

/// The first corner of the source's half-edge that this one was.
fn source_side(half_edge: &HalfEdge, origins: &Origins) -> Option<u32> {
    let [from, to] = half_edge.corners;
    let corners = origins.triangles[from as usize / 3]?;
    let [from, to] = [from, to].map(|corner| corners[corner as usize % 3]);
    // A triangle that turned over runs the other way.
    let next = if from % 3 == 2 { from - 2 } else { from + 1 };
    Some(if next == to { from } else { to })
}

/// Whether a triangle of the source is but a line that lies along a hard edge: on which of its sides light
/// breaks, nobody can see until it opens.
fn closes_hard(before: &Surface, hard_before: &[bool], triangle: u32) -> bool {
    is_low(before.triangle(triangle), LEAST_HEIGHT * before.rounding())
        && (3 * triangle..3 * triangle + 3).any(|corner| hard_before[corner as usize])
}

/// Whether two half-edges of the source lay on each other with different normals, be it among
/// others or in part.
fn parted_before(before: &Surface, one: u32, other: u32) -> bool {
    let next = |corner: u32| if corner % 3 == 2 { corner - 2 } else { corner + 1 };
    let ends = [[one, next(other)], [next(one), other]];
    let is_parted = ends.iter().any(|&pair| !before.share_normal(pair));
    let half_edge = |first: u32| HalfEdge {
        clusters: [first, next(first)].map(|corner| before.cluster(corner)),
        reversed: false,
        corners: [first, next(first)],
    };
    let sides = [half_edge(one), half_edge(other)];
    run_along(before, &sides[0], &sides[1])
        && (is_parted
            || parted_between(before, &sides)
            || parted_between(before, &[sides[1], sides[0]]))
        || ends.iter().all(|[a, b]| before.cluster(*a) == before.cluster(*b))
            && ends.iter().any(|&pair| !before.share_normal(pair))
}

/// Whether the normal at an end of the first half-edge is another one than the second has there, at that
/// share of its length: a long side that is shaded alike at both ends may not be so where others end on it.
fn parted_between(before: &Surface, [one, other]: &[HalfEdge; 2]) -> bool {
    let [from, to] = other.corners.map(|corner| before.position(corner));
    let normals = other.corners.map(|corner| before.shading(corner).normalize_or_zero());
    one.corners.into_iter().any(|corner| {
        let along = to - from;
        let share = (before.position(corner) - from).dot(along) / along.length_squared();
        let between = normals[0].lerp(normals[1], share);
        (0.0..=1.0).contains(&share) && !before.shares_with(corner, between)
    })
}

/// `#corners`: whether the half-edge that starts there is a side of a hard edge.
fn hard_corners(surface: &Surface) -> Vec<bool> {
    let mut hard = vec![false; surface.mesh.indices.len()];
    for (forward, backward) in surface.edges().filter(|edge| surface.is_hard(edge)) {
        for half_edge in forward.iter().chain(backward) {
            hard[half_edge.corners[0] as usize] = true;
        }
    }
    hard
}

/// Whether a new triangle lies flat and is shaded so, as the face that a chamfer has cut it from: a
/// chamfer that ends beside it may be hard there.
fn continues_face(after: &Surface, origins: &Origins, triangle: u32) -> bool {
    let corners = after.triangle(triangle);
    let own = normal_with_area(corners).map(DVec3::normalize);
    // A low one leans as rounding has turned it.
    let least = if is_low(corners, LEAST_HEIGHT * after.rounding()) { 0.0 } else { FLAT_COSINE };
    let is_along = |own: DVec3| {
        let normals = [0, 1, 2].map(|side| after.shading(3 * triangle + side).normalize_or_zero());
        normals.iter().all(|normal| normal.dot(own) > least)
    };
    origins.triangles[triangle as usize].is_none() && own.is_some_and(is_along)
}

/// A cluster, and the bits of a normal there.
type NormalAt = (u32, [u32; 3]);

fn normal_at(surface: &Surface, corner: u32) -> NormalAt {
    let normal = surface.mesh.normals[surface.vertex(corner)];
    (surface.cluster(corner), normal.map(|along| (along + 0.0).to_bits()))
}

/// Sorted: the normals that the source's triangles have where they are now.
fn old_normals(after: &Surface, origins: &Origins) -> Vec<NormalAt> {
    let old = (0u32..).zip(&origins.triangles).filter(|(_, source)| source.is_some());
    let corners = old.flat_map(|(triangle, _)| 3 * triangle..3 * triangle + 3);
    let mut normals: Vec<NormalAt> = corners.map(|corner| normal_at(after, corner)).collect();
    normals.sort_unstable();
    normals.dedup();
    normals
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Mesh;

    //  A-----------B     the face above is shaded at A as those below are at M, and at B alike: at M it is
    //  A--M--------B     shaded otherwise, as its normals turn on the way
    #[test]
    fn light_may_break_in_the_middle_of_a_long_side() {
        let above = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [2.0, 3.0, 0.0]];
        let below = [[0.0, 0.0, 0.0], [0.0, -3.0, 0.0], [1.0, 0.0, 0.0], [4.0, 0.0, 0.0]];
        let positions = [&above[..], &below].concat();
        for (lean, is_parted) in [(0.0, false), (0.2, true)] {
            let mut normals = [[0.0, 0.0, 1.0]; 7];
            for vertex in [0, 3, 5] {
                normals[vertex] = [lean, 0.0, 1.0];
            }
            let mesh = Mesh {
                positions: &positions,
                normals: &normals,
                indices: &[0, 1, 2, 3, 4, 5, 5, 4, 6],
                submesh_index_counts: &[9],
                ..Mesh::default()
            };
            let [long, short] = [0, 8];
            let surface = Surface::new(&mesh);
            assert_eq!(parted_before(&surface, long, short), is_parted, "{lean}");
            assert_eq!(parted_before(&surface, short, long), is_parted, "{lean}");
        }
    }

    //  A-----------B     a line closes a hard edge between two faces: both of its sides may be that
    //  A-----M-----B
    #[test]
    fn a_line_along_a_hard_edge_closes_it() {
        let positions = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 0.0, 1.0]];
        let mesh = Mesh {
            positions: &positions,
            normals: &[[0.0, 1.0, 0.0]; 4],
            indices: &[0, 1, 2, 0, 3, 1],
            submesh_index_counts: &[6],
            ..Mesh::default()
        };
        let surface = Surface::new(&mesh);
        let hard = [true, false, false, false, false, true];
        assert!(closes_hard(&surface, &hard, 0));
        assert!(!closes_hard(&surface, &[false; 6], 0));
        assert!(!closes_hard(&surface, &hard, 1), "a face is no line");
    }
}
