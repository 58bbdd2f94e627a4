//! T-junctions: borders that lie on others, of which the vertices stand elsewhere.

use glam::DVec3;

use super::surface::{HalfEdge, Surface};
use crate::bvh::{Aabb, Kin, Target, Tree};
use crate::lines::Lines;

/// How far, in roundings, a vertex may be off a line on which it was put.
const REACH: f64 = 16.0;

/// Of many that lie on one line, comparing all of them would take quadratic time.
const MOST_ALONG: usize = 64;

/// The open borders of a mesh; what is but a line closes none.
pub(super) struct Borders<'a> {
    surface: &'a Surface<'a>,
    all: Vec<&'a HalfEdge>,
    lines: Lines,
    tree: Tree,
}

impl<'a> Borders<'a> {
    pub fn new(surface: &'a Surface<'a>) -> Borders<'a> {
        let is_whole = |side: &&HalfEdge| !surface.is_collapsed(side.corners[0]);
        let whole = |sides: &'a [HalfEdge]| sides.iter().filter(is_whole);
        let all: Vec<&HalfEdge> = surface
            .edges()
            .map(|(forward, backward)| [forward, backward].map(whole))
            .filter(|[forward, backward]| {
                forward.clone().next().is_none() || backward.clone().next().is_none()
            })
            .flat_map(|[forward, backward]| forward.chain(backward))
            .collect();
        let boxes: Vec<Aabb> = all.iter().map(|border| around(surface, border)).collect();
        // The boxes of slanted ones overlap by the thousand.
        let lines = Lines::new(all.iter().map(|border| ends(surface, border)), reach(surface));
        let points = all.iter().map(|border| lines.around(ends(surface, border))).collect();
        Borders { surface, all, lines, tree: Tree::new(&boxes, &[]).with_views(&[points]) }
    }

    /// Those that run back along a part of a half-edge.
    pub fn along(&self, side: &'a HalfEdge) -> impl Iterator<Item = &'a HalfEdge> {
        self.near(side).filter(move |other| run_along(self.surface, side, other))
    }

    /// Those that may.
    fn near(&self, side: &HalfEdge) -> impl Iterator<Item = &'a HalfEdge> {
        let views = [self.lines.around(ends(self.surface, side))];
        let bounds = around(self.surface, side);
        let near = self.tree.near(Target { bounds, views, rod: None, is_out: |_: &Kin| false });
        near.map(|other| self.all[other as usize])
    }

    /// Borders that run back along a part of each other: each with some of those along it, which are
    /// enough to tell what is joined.
    pub fn pairs(&'a self) -> impl Iterator<Item = [&'a HalfEdge; 2]> {
        let pairs = |side| self.along(side).take(MOST_ALONG).map(move |other| [side, other]);
        self.all.iter().flat_map(move |&side| pairs(side))
    }
}

fn around(surface: &Surface, side: &HalfEdge) -> Aabb {
    let (reach, [from, to]) = (reach(surface), ends(surface, side));
    let ends = [from.min(to) - reach, from.max(to) + reach];
    Aabb::around(&ends.map(|end| end.as_vec3().to_array()))
}

fn ends(surface: &Surface, side: &HalfEdge) -> [DVec3; 2] {
    side.corners.map(|corner| surface.position(corner))
}

/// What is nearer may have been put together.
pub(super) fn reach(surface: &Surface) -> f64 {
    REACH * surface.rounding()
}

/// Whether two half-edges run opposite ways along a line, and have more than a point in common.
pub(super) fn run_along(surface: &Surface, one: &HalfEdge, other: &HalfEdge) -> bool {
    let [one, other] = [one, other].map(|side| ends(surface, side));
    lie_along(one, other, surface.rounding()) || lie_along(other, one, surface.rounding())
}

fn lie_along([from, to]: [DVec3; 2], other: [DVec3; 2], rounding: f64) -> bool {
    let (along, reach) = ((to - from).normalize_or_zero(), REACH * rounding);
    let [end, start] = other.map(|point| (point - from).dot(along));
    let is_near = |point: &DVec3| (*point - from).cross(along).length() <= reach;
    let shared = end.min(from.distance(to)) - start.max(0.0);
    other.iter().all(is_near) && shared > reach
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Mesh;

    #[test]
    fn of_many_slanted_borders_few_are_compared() {
        let sides = 2000_u32;
        let (points, indices) = crate::stages::zigzag_cone(sides);
        let counts = [indices.len() as u32];
        let mesh = Mesh {
            positions: &points,
            indices: &indices,
            submesh_index_counts: &counts,
            ..Mesh::default()
        };
        let surface = Surface::new(&mesh);
        let borders = Borders::new(&surface);
        assert_eq!(borders.all.len(), sides as usize);
        assert!(borders.all.iter().all(|side| borders.near(side).any(|near| near == *side)));
        let near: usize = borders.all.iter().map(|side| borders.near(side).count()).sum();
        assert!(near < 4 * borders.all.len(), "{near}");
    }
}
