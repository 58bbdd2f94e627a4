//! Finding the source's triangles in a mesh whose order other tools have changed: each is the
//! triangle whose corners are nearest to its own, with nearly the same normals.
//!
//! What is not found is left out: the rules that need a triangle's source then hold for fewer. One
//! that turned over is not found either, but it faces away from its vertex normals.

use super::nearest::{NearestTree, Point};
use super::stored::normal_with_area;
use super::surface::Surface;

/// How far all corners together (as a root of squares) may move, in longest sides: a chamfer
/// leaves every triangle with some area inside the old one.
const FARTHEST: f64 = 0.7;

/// How much farther a triangle counts whose normals are opposite, in longest sides. Normals change
/// little where a surface is curved and not at all where it is flat, so that even a few degrees
/// tell more than positions do.
const OTHER_NORMALS: f64 = 10.0;

/// The cosine of the angle (about six degrees) by which the normal of a corner may turn: less than
/// from one side of a strip to the other, as that has a hard edge in its place.
const SAME_NORMAL: f64 = 0.995;

/// Triangles whose nearest one was nearer to another try again, this often at most.
const ROUNDS: usize = 6;

/// The corners of a triangle from each of them on.
const TURNS: [[u32; 3]; 3] = [[0, 1, 2], [1, 2, 0], [2, 0, 1]];

/// A source triangle and the one that it may be.
struct Candidate {
    cost: f64,
    source: u32,
    triangle: u32,
    /// The source corners of the triangle's.
    corners: [u32; 3],
}

struct Matcher<'a> {
    before: &'a Surface<'a>,
    after: &'a Surface<'a>,
    tree: NearestTree,
    matched: Vec<Option<[u32; 3]>>,
}

/// `#triangles`: the source corners of each triangle's, for those of the source that are found.
pub(super) fn match_triangles(before: &Surface, after: &Surface) -> Vec<Option<[u32; 3]>> {
    let triangles = 0..after.triangle_count();
    let mut matcher = Matcher {
        before,
        after,
        matched: vec![None; triangles.len()],
        tree: NearestTree::new(triangles.map(|t| point(after, own_corners(t))).collect()),
    };
    let (mut left, lines): (Vec<u32>, Vec<u32>) =
        (0..before.triangle_count()).partition(|&source| has_area(before, source));
    for _ in 0..ROUNDS {
        left = matcher.take_nearest(&left);
    }
    matcher.take_lines(&lines);
    matcher.matched
}

impl Matcher<'_> {
    /// Gives each of the sources the triangle nearest to it, the nearest pairs first. Returns
    /// those whose nearest one was taken.
    fn take_nearest(&mut self, sources: &[u32]) -> Vec<u32> {
        let mut candidates: Vec<Candidate> =
            sources.iter().filter_map(|&source| self.nearest(source)).collect();
        candidates.sort_by(|a, b| a.cost.total_cmp(&b.cost).then(a.source.cmp(&b.source)));
        candidates.retain(|&Candidate { triangle, corners, .. }| {
            let place = &mut self.matched[triangle as usize];
            let is_taken = place.is_some();
            place.get_or_insert(corners);
            is_taken
        });
        candidates.into_iter().map(|candidate| candidate.source).collect()
    }

    /// The nearest triangle that is nobody's yet.
    fn nearest(&self, source: u32) -> Option<Candidate> {
        let longest = longest_squared(self.before, source);
        let farthest = FARTHEST.powi(2) * longest;
        let mut best: Option<Candidate> = None;
        for sides in TURNS {
            let corners = sides.map(|side| 3 * source + side);
            let limit = best.as_ref().map_or(farthest, |best| best.cost.min(farthest));
            let point = point(self.before, corners);
            self.tree.visit_near(&point, limit, |triangle, distance, limit| {
                let Some(turn) = self.turn(corners, triangle) else { return limit };
                let cost = distance + OTHER_NORMALS.powi(2) * turn / 4.0 * longest;
                let is_better = best.as_ref().is_none_or(|best| cost < best.cost);
                if self.matched[triangle as usize].is_some() || !is_better {
                    return limit;
                }
                best = Some(Candidate { cost, source, triangle, corners });
                cost.min(limit)
            });
        }
        best
    }

    /// How far (mean square) a triangle's normals are from those of some source corners; none
    /// where that is too far.
    fn turn(&self, corners: [u32; 3], triangle: u32) -> Option<f64> {
        let mut sum = 0.0;
        for (old, new) in corners.into_iter().zip(own_corners(triangle)) {
            let [old, new] = [self.before.normal(old), self.after.normal(new)];
            if old.dot(new) < SAME_NORMAL * old.length() * new.length() {
                return None;
            }
            sum += old.distance_squared(new);
        }
        Some(sum / 3.0)
    }

    /// Triangles without area are one like the other.
    fn take_lines(&mut self, sources: &[u32]) {
        let after = self.after;
        let free = (0..).zip(&mut self.matched).filter(|(_, matched)| matched.is_none());
        let lines = free.filter(|(triangle, _)| !has_area(after, *triangle));
        for ((_, matched), &source) in lines.zip(sources) {
            *matched = Some(own_corners(source));
        }
    }
}

fn has_area(surface: &Surface, triangle: u32) -> bool {
    normal_with_area(surface.triangle(triangle)).is_some()
}

fn own_corners(triangle: u32) -> [u32; 3] {
    [0, 1, 2].map(|side| 3 * triangle + side)
}

fn point(surface: &Surface, corners: [u32; 3]) -> Point {
    let mut point = Point::default();
    for (position, corner) in point.as_chunks_mut::<3>().0.iter_mut().zip(corners) {
        let vertex = surface.mesh.indices[corner as usize];
        *position = surface.mesh.positions[vertex as usize];
    }
    point
}

fn longest_squared(surface: &Surface, triangle: u32) -> f64 {
    let [a, b, c] = surface.triangle(triangle);
    a.distance_squared(b).max(b.distance_squared(c)).max(c.distance_squared(a))
}
