//! T-junctions: borders that lie on others, of which the vertices stand elsewhere.

use glam::DVec3;

use super::surface::{HalfEdge, Surface};
use crate::bvh::{Aabb, Tree};

/// How far, in roundings, a vertex may be off a line on which it was put.
const REACH: f64 = 16.0;

/// Whether any border runs back along a part of another one that does not end where it does.
pub(super) fn any_junction(surface: &Surface) -> bool {
    let borders: Vec<&HalfEdge> = surface
        .edges()
        .filter(|(forward, backward)| forward.is_empty() || backward.is_empty())
        .flat_map(|(forward, backward)| forward.iter().chain(backward))
        .collect();
    let reach = REACH * surface.rounding();
    let around = |border: &&HalfEdge| {
        let [from, to] = border.corners.map(|corner| surface.position(corner));
        let box_ends = [from.min(to) - reach, from.max(to) + reach];
        Aabb::around(&box_ends.map(|point| point.as_vec3().to_array()))
    };
    let boxes: Vec<Aabb> = borders.iter().map(around).collect();
    let tree = Tree::new(&boxes, &[]);
    borders.iter().zip(&boxes).any(|(one, bounds)| {
        tree.overlapping(*bounds).any(|other| run_along(surface, one, borders[other as usize]))
    })
}

/// Whether two half-edges run opposite ways along a line, and have more than a point in common.
pub(super) fn run_along(surface: &Surface, one: &HalfEdge, other: &HalfEdge) -> bool {
    let [one, other] = [one, other].map(|side| side.corners.map(|corner| surface.position(corner)));
    lie_along(one, other, surface.rounding()) || lie_along(other, one, surface.rounding())
}

fn lie_along([from, to]: [DVec3; 2], other: [DVec3; 2], rounding: f64) -> bool {
    let (along, reach) = ((to - from).normalize_or_zero(), REACH * rounding);
    let [end, start] = other.map(|point| (point - from).dot(along));
    let is_near = |point: &DVec3| (*point - from).cross(along).length() <= reach;
    let shared = end.min(from.distance(to)) - start.max(0.0);
    other.iter().all(is_near) && shared > reach
}
