//! Finding the source's triangles in a mesh that comes without provenance, as from a file.
//!
//! A chamfered mesh has them first in each submesh, in their order. Other tools change the order
//! of triangles, of their corners and of submeshes; then each source triangle is the one whose
//! corners are nearest to its own.

use super::nearest::{NearestTree, Point, squared_distance};
use super::surface::Surface;

/// How many source triangles tell whether the order is kept.
const SAMPLES: usize = 256;

/// What share of these must be nearest to the triangle at their own place: a wide chamfer can
/// move a few small triangles nearer to others.
const KEPT_SHARE: f64 = 0.9;

/// How far all corners together (as a root of squares) may move, in longest sides: a chamfer
/// leaves every triangle with some area inside the old one.
const FARTHEST: f64 = 1.0;

/// The same for a triangle at its own place that is believed without a look at others.
const CLOSE: f64 = 0.25;

/// Two things that count as distance, in longest sides. That a triangle is the other way around:
/// one that turned over, if there is no better one. And that vertex normals are opposite: a strip
/// may be nearer to a small triangle than that is to itself, but one of its normals is another;
/// where that one is at a right angle, the strip is too far away.
const REVERSED: f64 = 0.5;
const OTHER_NORMALS: f64 = 2.5;

/// Triangles whose nearest one was nearer to another try again, this often at most.
const ROUNDS: usize = 6;

/// A triangle's corners in the three orders of its winding, then in the three of the other.
const ORDERS: [[usize; 3]; 6] = [[0, 1, 2], [1, 2, 0], [2, 0, 1], [0, 2, 1], [2, 1, 0], [1, 0, 2]];

/// Which triangles are which.
pub(super) struct Matched {
    /// `#triangles`: the source corners of each that is not new.
    pub triangles: Vec<Option<[u32; 3]>>,
    /// The source triangles that were not found.
    pub lost: Vec<u32>,
    /// Whether the source's triangles stand first, in their order.
    pub order_kept: bool,
}

/// A source triangle and the one that it may be.
struct Candidate {
    cost: f64,
    source: u32,
    triangle: u32,
    /// The place in [`ORDERS`] of the source's corners.
    order: usize,
}

struct Matcher<'a> {
    before: &'a Surface<'a>,
    after: &'a Surface<'a>,
    tree: NearestTree,
    /// `#source triangles`: the triangle at the place of each.
    in_order: Vec<Option<u32>>,
    matched: Vec<Option<[u32; 3]>>,
}

pub(super) fn match_triangles(before: &Surface, after: &Surface) -> Matched {
    let triangles = after.mesh.indices.len() as u32 / 3;
    let mut matcher = Matcher {
        before,
        after,
        tree: NearestTree::new((0..triangles).map(|t| corners(after, t)).collect()),
        matched: vec![None; triangles as usize],
        in_order: in_order(before, after),
    };
    let order_kept = matcher.keeps_order();
    let mut lost: Vec<u32> = (0..matcher.in_order.len() as u32).collect();
    if order_kept {
        lost.retain(|&source| !matcher.take_own_place(source, CLOSE));
    }
    for _ in 0..ROUNDS {
        lost = matcher.take_nearest(&lost);
    }
    if order_kept {
        lost.retain(|&source| !matcher.take_own_place(source, f64::INFINITY));
    }
    Matched { triangles: matcher.matched, lost, order_kept }
}

impl Matcher<'_> {
    /// Whether nearly every triangle of a sample is nearest to the one at its own place.
    fn keeps_order(&self) -> bool {
        let count = self.in_order.len();
        let step = count.div_ceil(SAMPLES).max(1);
        let at_own_place = |&source: &usize| {
            let own = self.in_order[source].map(|own| self.cost(source as u32, own, 0));
            let best = self.nearest(source as u32).map_or(f64::INFINITY, |best| best.cost);
            own.is_some_and(|own| own <= best)
        };
        let kept = (0..count).step_by(step).filter(at_own_place).count();
        kept as f64 >= KEPT_SHARE * count.div_ceil(step) as f64
    }

    fn take_own_place(&mut self, source: u32, farthest: f64) -> bool {
        let Some(own) = self.in_order[source as usize] else { return false };
        let limit = farthest.powi(2) * longest_squared(&corners(self.before, source));
        let is_free = self.matched[own as usize].is_none();
        if is_free && self.cost(source, own, 0) <= limit {
            self.matched[own as usize] = Some([0, 1, 2].map(|side| 3 * source + side));
            return true;
        }
        false
    }

    /// Gives each of the sources the triangle nearest to it, the nearest pairs first. Returns
    /// those that got none.
    fn take_nearest(&mut self, sources: &[u32]) -> Vec<u32> {
        let mut candidates: Vec<Candidate> =
            sources.iter().filter_map(|&source| self.nearest(source)).collect();
        candidates.sort_by(|a, b| a.cost.total_cmp(&b.cost).then(a.source.cmp(&b.source)));
        let mut found = vec![false; self.in_order.len()];
        for Candidate { source, triangle, order, .. } in candidates {
            let place = &mut self.matched[triangle as usize];
            if place.is_none() {
                *place = Some(ORDERS[order].map(|side| 3 * source + side as u32));
                found[source as usize] = true;
            }
        }
        sources.iter().copied().filter(|&source| !found[source as usize]).collect()
    }

    /// The nearest triangle that is nobody's yet.
    fn nearest(&self, source: u32) -> Option<Candidate> {
        let point = corners(self.before, source);
        let farthest = FARTHEST.powi(2) * longest_squared(&point);
        let mut best: Option<Candidate> = None;
        for order in 0..ORDERS.len() {
            let limit = best.as_ref().map_or(farthest, |best| best.cost);
            self.tree.visit_near(&turned(&point, order), limit, |triangle, limit| {
                let cost = self.cost(source, triangle, order);
                if cost < limit && self.matched[triangle as usize].is_none() {
                    best = Some(Candidate { cost, source, triangle, order });
                    return cost;
                }
                limit
            });
        }
        best
    }

    /// How far the corners are apart, squared, with what else counts as distance.
    fn cost(&self, source: u32, triangle: u32, order: usize) -> f64 {
        let point = corners(self.before, source);
        let distance = squared_distance(&turned(&point, order), &corners(self.after, triangle));
        let normals = (0..3).zip(ORDERS[order]).map(|(to, from)| {
            let old = self.before.normal(3 * source + from as u32);
            old.distance_squared(self.after.normal(3 * triangle + to))
        });
        // Opposite unit normals are two apart.
        let other_normals = OTHER_NORMALS.powi(2) * normals.sum::<f64>() / 3.0 / 4.0;
        let reversed = if order < 3 { 0.0 } else { REVERSED.powi(2) };
        distance + (other_normals + reversed) * longest_squared(&point)
    }
}

/// `#source triangles`: the triangle at the same place of the same submesh.
fn in_order(before: &Surface, after: &Surface) -> Vec<Option<u32>> {
    let mut places = Vec::with_capacity(before.mesh.indices.len() / 3);
    let mut first = 0;
    for (submesh, count) in before.mesh.submesh_index_counts.iter().enumerate() {
        let there = after.mesh.submesh_index_counts.get(submesh).map_or(0, |count| count / 3);
        places.extend((0..count / 3).map(|place| (place < there).then_some(first + place)));
        first += there;
    }
    places
}

fn corners(surface: &Surface, triangle: u32) -> Point {
    let mut point = Point::default();
    for (side, corner) in point.as_chunks_mut::<3>().0.iter_mut().enumerate() {
        let vertex = surface.mesh.indices[3 * triangle as usize + side];
        *corner = surface.mesh.positions[vertex as usize];
    }
    point
}

fn turned(point: &Point, order: usize) -> Point {
    let corners = point.as_chunks::<3>().0;
    let mut turned = Point::default();
    for (to, from) in turned.as_chunks_mut::<3>().0.iter_mut().zip(ORDERS[order]) {
        *to = corners[from];
    }
    turned
}

fn longest_squared(point: &Point) -> f64 {
    let corners = point.as_chunks::<3>().0;
    let side = |a: usize, b: usize| {
        (0..3).map(|k| (f64::from(corners[a][k]) - f64::from(corners[b][k])).powi(2)).sum::<f64>()
    };
    side(0, 1).max(side(1, 2)).max(side(2, 0))
}
