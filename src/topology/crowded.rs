//! Twins where more than two half-edges lie between the same two clusters.
//!
//! First half-edges that share both vertices, then the rest by angle about the edge: each face with
//! the next opposite one on its solid side (behind its normal), so that two boxes that touch stay
//! two boxes. Equal normals do not pair: the flush tops of two boxes side by side would join, and
//! the walls between them stay behind as a fin.

use std::cmp::Ordering;

use glam::DVec3;

use crate::ids::Corner;
use crate::math::{area_vector, unit};
use crate::view::View;

/// With more faces on one edge, comparing all of them would take quadratic time.
const MOST_FACES: usize = 64;

/// Faces whose directions about the edge differ by less than this (a hundredth of a degree) lie on
/// each other.
const SAME_DIRECTION: f64 = 1.0 - 1e-8;

/// Pairs half-edges that run forth with some that run back. What is left over is a border.
pub fn pairs(view: &View, mut forth: Vec<Corner>, mut back: Vec<Corner>) -> Vec<[Corner; 2]> {
    let mut pairs = Vec::new();
    if forth.len() + back.len() <= MOST_FACES {
        take_joined(view, &mut forth, &mut back, &mut pairs);
    }
    take_by_angle(view, forth, back, &mut pairs);
    pairs
}

/// The pairs that lie on another pair with both their faces: the two sides of a folded sheet.
pub fn doubled(view: &View, pairs: &[[Corner; 2]]) -> Vec<[Corner; 2]> {
    if pairs.len() < 2 || pairs.len() > MOST_FACES {
        return Vec::new();
    }
    let first = pairs[0][0];
    let axis = unit(view.position_at(first.next()) - view.position_at(first));
    let faces: Vec<[DVec3; 2]> =
        pairs.iter().map(|pair| pair.map(|side| inward(view, side, axis))).collect();
    let lies_on = |one: DVec3, other: DVec3| one.dot(other) > SAME_DIRECTION;
    let is_doubled = |place: usize| {
        let [one, two] = faces[place];
        faces.iter().enumerate().any(|(other, &[three, four])| {
            let is_same = lies_on(one, three) && lies_on(two, four);
            other != place && (is_same || lies_on(one, four) && lies_on(two, three))
        })
    };
    (0..pairs.len()).filter(|&place| is_doubled(place)).map(|place| pairs[place]).collect()
}

/// Takes the pairs that share both vertices with each other and with nothing else: two candidates
/// decide nothing.
fn take_joined(
    view: &View,
    forth: &mut Vec<Corner>,
    back: &mut Vec<Corner>,
    pairs: &mut Vec<[Corner; 2]>,
) {
    let partners = |one: Corner, others: &[Corner]| {
        let mut joined = others.iter().copied().filter(|&other| shares_vertices(view, one, other));
        joined.next().filter(|_| joined.next().is_none())
    };
    let found: Vec<[Corner; 2]> = forth
        .iter()
        .filter_map(|&one| {
            let other = partners(one, back)?;
            partners(other, forth).map(|_| [one, other])
        })
        .collect();
    forth.retain(|one| found.iter().all(|pair| pair[0] != *one));
    back.retain(|other| found.iter().all(|pair| pair[1] != *other));
    pairs.extend(found);
}

fn shares_vertices(view: &View, one: Corner, other: Corner) -> bool {
    view.vertex_at(one) == view.vertex_at(other.next())
        && view.vertex_at(one.next()) == view.vertex_at(other)
}

/// A face around the edge.
struct Leaf {
    half_edge: Corner,
    runs_forth: bool,
    /// Grows with the angle about the edge, from 0 to 4.
    angle: f64,
}

/// Faces that run forth open a solid, faces that run back close it: match them like parentheses
/// on a circle, going round into the solid.
fn take_by_angle(view: &View, forth: Vec<Corner>, back: Vec<Corner>, pairs: &mut Vec<[Corner; 2]>) {
    if forth.is_empty() || back.is_empty() {
        return;
    }
    let leaves = leaves(view, &forth, &back);
    let mut open: Vec<Corner> = Vec::new();
    let mut closed: Vec<Corner> = Vec::new();
    for leaf in leaves.iter().chain(&leaves) {
        if closed.contains(&leaf.half_edge) {
            continue;
        }
        if leaf.runs_forth {
            if !open.contains(&leaf.half_edge) {
                open.push(leaf.half_edge);
            }
        } else if let Some(opening) = open.pop() {
            pairs.push([opening, leaf.half_edge]);
            closed.extend([opening, leaf.half_edge]);
        }
    }
}

/// The faces in the order in which one meets them going round into the solids that run-forth
/// faces bound. Where two lie on each other, the one that closes a solid comes first.
fn leaves(view: &View, forth: &[Corner], back: &[Corner]) -> Vec<Leaf> {
    let axis = unit(view.position_at(forth[0].next()) - view.position_at(forth[0]));
    let reference = unit(inward(view, forth[0], axis));
    let leaf = |half_edge: Corner, runs_forth| Leaf {
        half_edge,
        runs_forth,
        angle: pseudo_angle(inward(view, half_edge, axis), reference, axis.cross(reference)),
    };
    let mut leaves: Vec<Leaf> = forth.iter().map(|&half_edge| leaf(half_edge, true)).collect();
    leaves.extend(back.iter().map(|&half_edge| leaf(half_edge, false)));
    leaves.sort_by(|one, other| {
        let falling = other.angle.partial_cmp(&one.angle).unwrap_or(Ordering::Equal);
        falling
            .then(one.runs_forth.cmp(&other.runs_forth))
            .then(one.half_edge.cmp(&other.half_edge))
    });
    leaves
}

/// From the edge into the face, perpendicular to the edge.
fn inward(view: &View, half_edge: Corner, axis: DVec3) -> DVec3 {
    let points = view.triangle(half_edge.triangle());
    let along = view.position_at(half_edge.next()) - view.position_at(half_edge);
    let direction = unit(area_vector(points).cross(along));
    if direction == DVec3::ZERO { axis.any_orthonormal_vector() } else { direction }
}

/// 0 to 4 as the angle from `x` towards `y` goes from 0 to 360 degrees.
fn pseudo_angle(direction: DVec3, x: DVec3, y: DVec3) -> f64 {
    let (along, across) = (direction.dot(x), direction.dot(y));
    let ratio = along / (along.abs() + across.abs());
    if across >= 0.0 { 1.0 - ratio } else { 3.0 + ratio }
}
