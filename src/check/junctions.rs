//! T-junctions: borders that lie on others, of which the vertices stand elsewhere.

use glam::DVec3;

use super::surface::{HalfEdge, Surface};
use crate::bvh::{Aabb, Tree};

/// How far, in roundings, a vertex may be off a line on which it was put.
const REACH: f64 = 16.0;

/// Of many that lie on one line, comparing all of them would take quadratic time.
const MOST_ALONG: usize = 64;

/// The open borders of a mesh.
pub(super) struct Borders<'a> {
    surface: &'a Surface<'a>,
    all: Vec<&'a HalfEdge>,
    tree: Tree,
}

impl<'a> Borders<'a> {
    pub fn new(surface: &'a Surface<'a>) -> Borders<'a> {
        let all: Vec<&HalfEdge> = surface
            .edges()
            .filter(|(forward, backward)| forward.is_empty() || backward.is_empty())
            .flat_map(|(forward, backward)| forward.iter().chain(backward))
            .collect();
        let boxes: Vec<Aabb> = all.iter().map(|border| around(surface, border)).collect();
        Borders { surface, all, tree: Tree::new(&boxes, &[]) }
    }

    /// Those that run back along a part of a half-edge.
    pub fn along(&self, side: &'a HalfEdge) -> impl Iterator<Item = &'a HalfEdge> {
        let near = self.tree.overlapping(around(self.surface, side));
        let near = near.map(|other| self.all[other as usize]);
        near.filter(move |other| run_along(self.surface, side, other))
    }

    /// Borders that run back along a part of each other: each with some of those along it, which are
    /// enough to tell what is joined.
    pub fn pairs(&'a self) -> impl Iterator<Item = [&'a HalfEdge; 2]> {
        let pairs = |side| self.along(side).take(MOST_ALONG).map(move |other| [side, other]);
        self.all.iter().flat_map(move |&side| pairs(side))
    }
}

fn around(surface: &Surface, side: &HalfEdge) -> Aabb {
    let (reach, [from, to]) = (reach(surface), side.corners.map(|corner| surface.position(corner)));
    let ends = [from.min(to) - reach, from.max(to) + reach];
    Aabb::around(&ends.map(|end| end.as_vec3().to_array()))
}

/// What is nearer may have been put together.
pub(super) fn reach(surface: &Surface) -> f64 {
    REACH * surface.rounding()
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
