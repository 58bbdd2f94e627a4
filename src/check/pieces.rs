//! Source triangles that were cut, because a hard edge beside them got vertices.

use std::collections::{BTreeMap, BTreeSet};

use glam::DVec3;

use super::origins::Cuts;
use super::stored::normal_with_area;
use super::surface::Surface;

use crate::report::Piece;

/// How far the areas of all pieces may be off that of their triangle, as a share of it: their
/// weights are stored in single precision.
const AREA_TOLERANCE: f64 = 1e-4;

/// How far, relative to the extent, a piece may be off its triangle: as a face that stays flat.
const OFF_TRIANGLE: f64 = 1e-5;

/// A triangle is hardly ever cut into so many pieces in a row.
const MOST_IN_A_ROW: usize = 64;

/// What of a piece has to lie within its triangle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Within {
    /// All its corners.
    Corners,
    /// Its middle: a corner that moved may stand right beside the triangle, on a neighbour in the
    /// same plane.
    Middle,
}

/// What is known of a triangle that is a piece of another one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Cut {
    /// Which of its corners are those of the source triangle.
    pub is_own: [bool; 3],
}

impl Cut {
    pub fn told(piece: &Piece) -> Cut {
        let is_own = |k: usize| piece.corners[k] == own_weights(k);
        Cut { is_own: [0, 1, 2].map(is_own) }
    }
}

fn own_weights(place: usize) -> [f32; 3] {
    std::array::from_fn(|k| f32::from(u8::from(k == place)))
}

/// Whether a source triangle is there once, or in pieces that are told and cover it: none is
/// turned, together they are as large, and each corner of the triangle is one of some piece.
/// `origins: #triangles`, the source triangle of each.
pub(super) fn is_covered(sources: usize, origins: &[Option<u32>], pieces: &[Piece]) -> bool {
    let mut whole = vec![0_u32; sources];
    for &origin in origins.iter().flatten() {
        whole[origin as usize] += 1;
    }
    let mut cut: BTreeMap<u32, (f64, [bool; 3])> = BTreeMap::new();
    let mut named = BTreeSet::new();
    for piece in pieces {
        let Some(&Some(source)) = origins.get(piece.triangle as usize) else { return false };
        let area = share_of_area(piece);
        let is_inside = piece.corners.as_flattened().iter().all(|weight| *weight >= 0.0);
        if area <= 0.0 || !is_inside || !named.insert(piece.triangle) {
            return false;
        }
        whole[source as usize] -= 1;
        let (sum, has) = cut.entry(source).or_default();
        *sum += area;
        let is_own = Cut::told(piece).is_own;
        *has = [0, 1, 2].map(|k| has[k] || is_own[k]);
    }
    let is_once = |(source, count): (u32, &u32)| match cut.get(&source) {
        None => *count == 1,
        Some((sum, has)) => *count == 0 && (sum - 1.0).abs() < AREA_TOLERANCE && *has == [true; 3],
    };
    (0u32..).zip(&whole).all(is_once)
}

/// How much of the source triangle a piece is.
fn share_of_area(piece: &Piece) -> f64 {
    let [a, b, c] = piece.corners.map(|weights| DVec3::from(weights.map(f64::from)));
    a.dot(b.cross(c))
}

/// Where nothing is told, looks for the pieces of each source triangle, whose first one stands in
/// its place: new triangles that lie on it and go on from there, or from another piece, smoothly
/// over an edge with the same vertices. Sets what they come from.
pub(super) fn pieces_in_order(
    [before, after]: &[Surface; 2],
    within: Within,
    triangles: &mut [Option<[u32; 3]>],
) -> Cuts {
    let mut pairs = Vec::new();
    let vertex = |corner: u32| after.mesh.indices[corner as usize];
    for (forward, backward) in after.edges() {
        if let ([one], [other]) = (forward, backward) {
            let are_same = vertex(one.corners[0]) == vertex(other.corners[1])
                && vertex(one.corners[1]) == vertex(other.corners[0]);
            let pair = [one, other].map(|half_edge| half_edge.corners[0] / 3);
            if are_same && pair.iter().any(|&triangle| triangles[triangle as usize].is_none()) {
                pairs.push(pair);
            }
        }
    }
    let off = OFF_TRIANGLE * f64::from(before.mesh.extent());
    let mut members: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
    for _ in 0..MOST_IN_A_ROW {
        let found = members.len() + members.values().map(Vec::len).sum::<usize>();
        for [one, other] in pairs.iter().flat_map(|&[one, other]| [[one, other], [other, one]]) {
            if let (Some(corners), None) = (triangles[one as usize], triangles[other as usize]) {
                let source = corners[0] / 3;
                if lies_on(before.triangle(source), after.triangle(other), within, off) {
                    triangles[other as usize] = Some(corners);
                    members.entry(source).or_insert_with(|| vec![one]).push(other);
                }
            }
        }
        if members.len() + members.values().map(Vec::len).sum::<usize>() == found {
            break;
        }
    }
    let mut cuts = Cuts::new();
    for (source, members) in members {
        add_cuts([before, after], source, &members, &mut cuts);
    }
    cuts
}

/// The corners nearest to those of the source triangle are taken for them.
fn add_cuts([before, after]: [&Surface; 2], source: u32, members: &[u32], cuts: &mut Cuts) {
    for side in 0..3 {
        let old = before.position(3 * source + side);
        let distance = |triangle: u32| after.position(3 * triangle + side).distance(old);
        let least = members.iter().map(|&member| distance(member)).fold(f64::INFINITY, f64::min);
        for &member in members {
            let cut = cuts.entry(member).or_insert(Cut { is_own: [false; 3] });
            cut.is_own[side as usize] = distance(member) == least;
        }
    }
}

/// Whether a triangle lies on another one, and within it.
fn lies_on(source: [DVec3; 3], triangle: [DVec3; 3], within: Within, off: f64) -> bool {
    let Some(normal) = normal_with_area(source).map(DVec3::normalize) else { return false };
    let faces = normal_with_area(triangle).is_some_and(|facing| facing.dot(normal) > 0.0);
    let is_inside = |point: DVec3| {
        (0..3).all(|k| {
            let (from, to) = (source[k], source[(k + 1) % 3]);
            normal.cross((to - from).normalize()).dot(point - from) >= -off
        })
    };
    let is_level = |point: &DVec3| (*point - source[0]).dot(normal).abs() <= off;
    faces
        && triangle.iter().all(is_level)
        && match within {
            Within::Corners => triangle.into_iter().all(is_inside),
            Within::Middle => is_inside((triangle[0] + triangle[1] + triangle[2]) / 3.0),
        }
}
