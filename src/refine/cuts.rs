//! How a triangle that gets vertices on its sides is cut into pieces.

use super::WHOLE;
use crate::ids::Few;

/// A vertex on a side of a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    pub vertex: u32,
    /// How far along the side.
    pub share: f64,
}

/// A corner of a piece, with its place in the whole triangle as weights of the corners of that.
pub type CutCorner = (u32, [f64; 3]);

/// A triangle cut at the vertices on its sides, around one inside if there is such: itself without
/// any. No side keeps a vertex in its middle.
pub fn pieces(
    corners: [u32; 3],
    points: &[Few<Point>; 3],
    middle: Option<CutCorner>,
) -> Vec<[CutCorner; 3]> {
    let whole = [0, 1, 2].map(|k| (corners[k], WHOLE[k]));
    let points = [0, 1, 2].map(|side| on_side(&points[side], side));
    let mut pieces = Vec::new();
    match middle {
        None => cut(whole, points, &mut pieces),
        Some(middle) => cut_around(whole, &points, middle, &mut pieces),
    }
    side_by_side(pieces)
}

/// The first one, and then such as lie beside an earlier one.
fn side_by_side(mut pieces: Vec<[CutCorner; 3]>) -> Vec<[CutCorner; 3]> {
    let shared = |one: &[CutCorner; 3], other: &[CutCorner; 3]| {
        one.iter().filter(|(vertex, _)| other.iter().any(|(own, _)| own == vertex)).count()
    };
    for done in 1..pieces.len() {
        let (before, rest) = pieces.split_at(done);
        let is_beside = |piece: &[CutCorner; 3]| before.iter().any(|one| shared(one, piece) == 2);
        let next = rest.iter().position(is_beside).unwrap_or(0);
        pieces[done..=done + next].rotate_right(1);
    }
    pieces
}

/// Joins all vertices on the sides to one inside.
/// ```text
///            c
///          / | \
///        /  .s.  \
///      / .'  | `. \
///     a------m-----b
/// ```
fn cut_around(
    corners: [CutCorner; 3],
    points: &[Few<CutCorner>; 3],
    middle: CutCorner,
    pieces: &mut Vec<[CutCorner; 3]>,
) {
    for side in 0..3 {
        let [onward, back] = [(side + 1) % 3, (side + 2) % 3];
        let mut from = corners[side];
        for &to in points[side].iter().chain([&corners[onward]]) {
            let mut piece = [middle; 3];
            (piece[side], piece[onward], piece[back]) = (from, to, middle);
            pieces.push(piece);
            from = to;
        }
    }
}

/// The vertices on a side as corners of pieces.
fn on_side(points: &[Point], side: usize) -> Few<CutCorner> {
    let weights = |share: f64| {
        let mut weights = [0.0; 3];
        (weights[side], weights[(side + 1) % 3]) = (1.0 - share, share);
        weights
    };
    points.iter().map(|point| (point.vertex, weights(point.share))).collect()
}

/// Joins a vertex on a side to the corner across, and gives the others to the two halves.
/// ```text
///          c
///         /|\
///        / | \        the first half has a and c in their old places,
///       /  |  \       the second one b and c
///      a---m---b
/// ```
fn cut(corners: [CutCorner; 3], points: [Few<CutCorner>; 3], pieces: &mut Vec<[CutCorner; 3]>) {
    let Some(side) = (0..3).find(|&side| !points[side].is_empty()) else {
        pieces.push(corners);
        return;
    };
    let [onward, back] = [(side + 1) % 3, (side + 2) % 3];
    let middle = points[side][0];
    let mut halves = [corners; 2];
    halves[0][onward] = middle;
    halves[1][side] = middle;
    let mut left: [Few<CutCorner>; 3] = Default::default();
    let mut right: [Few<CutCorner>; 3] = Default::default();
    left[back] = points[back].clone();
    right[side] = Few::from_slice(&points[side][1..]);
    right[onward] = points[onward].clone();
    cut(halves[0], left, pieces);
    cut(halves[1], right, pieces);
}
