//! Strips: two triangles for each chamfered edge, one where an end does not open (thesis 6.5).
//!
//! ```text
//!   a1 ----- b1      side one, pulled into its face
//!   |  strip  |
//!   a2 ----- b2      side two
//! ```

use glam::DVec3;

use crate::edges::HardEdge;
use crate::ids::Corner;
use crate::math::area_vector;
use crate::placement::Placement;
use crate::tolerance::EQUAL_FOLD;
use crate::validity::faces_out;

/// The corners of a strip in the order b1, a1, a2, b2: counter-clockwise seen from outside.
pub fn corners(edge: &HardEdge) -> [Corner; 4] {
    let [one, two] = edge.sides;
    [one.next(), one, two.next(), two]
}

/// A strip's four corners in space.
#[derive(Clone, Copy, Debug)]
pub struct Quad {
    /// b1, a1, a2, b2.
    pub points: [DVec3; 4],
    /// The vertex normals there.
    pub normals: [DVec3; 4],
}

/// How a strip is cut into triangles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cut {
    /// Neither end opens.
    Closed,
    /// Only end b opens.
    OpenAtB,
    /// Only end a opens.
    OpenAtA,
    /// By the diagonal from b1.
    FromB1,
    /// By the diagonal from a1.
    FromA1,
}

impl Cut {
    /// The triangles, as places in the strip's four corners.
    pub fn triangles(self) -> &'static [[usize; 3]] {
        match self {
            Cut::Closed => &[],
            Cut::OpenAtB => &[[0, 1, 3]],
            Cut::OpenAtA => &[[0, 1, 2]],
            Cut::FromB1 => &[[0, 1, 2], [0, 2, 3]],
            Cut::FromA1 => &[[0, 1, 3], [1, 2, 3]],
        }
    }
}

/// The strip of an edge where the sectors stand now.
#[inline]
pub fn quad(placement: &Placement, edge: &HardEdge) -> Quad {
    let [b1, a1, a2, b2] = corners(edge);
    // A side starts at the first corner of a sector, and ends at the last one of another.
    let (b1, a1) = (placement.at_end(b1, 1), placement.at_end(a1, 0));
    let (a2, b2) = (placement.at_end(a2, 1), placement.at_end(b2, 0));
    Quad { points: [b1.0, a1.0, a2.0, b2.0], normals: [b1.1, a1.1, a2.1, b2.1] }
}

/// Cuts the strip by the diagonal that folds less.
#[inline]
pub fn cut(points: [DVec3; 4]) -> Cut {
    let [b1, a1, a2, b2] = points;
    match (a1 == a2, b1 == b2) {
        (true, true) => Cut::Closed,
        (true, false) => Cut::OpenAtB,
        (false, true) => Cut::OpenAtA,
        (false, false) => {
            // A parallelogram folds nowhere.
            let more = if b1 - a1 == b2 - a2 { 0.0 } else { folds_more_from_b1(points) };
            let is_longer = || b1.distance_squared(a2) > a1.distance_squared(b2);
            let folds_alike = more.abs() <= EQUAL_FOLD;
            if more > EQUAL_FOLD || (folds_alike && is_longer()) {
                Cut::FromA1
            } else {
                Cut::FromB1
            }
        }
    }
}

/// How much more a strip folds along the diagonal from b1, as a difference of cosines.
#[inline(never)]
fn folds_more_from_b1([b1, a1, a2, b2]: [DVec3; 4]) -> f64 {
    fold([b1, a1, b2], [a1, a2, b2]) - fold([b1, a1, a2], [b1, a2, b2])
}

/// Whether all triangles of the cut strip face outwards, and neither pulled edge runs backwards.
#[inline]
pub fn is_valid(quad: &Quad, cut: Cut, edge: DVec3, resolution: f64) -> bool {
    let [b1, a1, a2, b2] = quad.points;
    let runs_along = |from: DVec3, to: DVec3| (to - from).dot(edge) > 0.0;
    let faces = |&[a, b, c]: &[usize; 3]| {
        let (at, normals) = (&quad.points, &quad.normals);
        faces_out([at[a], at[b], at[c]], [normals[a], normals[b], normals[c]], resolution)
    };
    runs_along(a1, b1) && runs_along(a2, b2) && cut.triangles().iter().all(faces)
}

/// The cosine between two triangles' normals.
#[inline]
fn fold(one: [DVec3; 3], other: [DVec3; 3]) -> f64 {
    let (one, other) = (area_vector(one), area_vector(other));
    let sizes = one.length() * other.length();
    if sizes > 0.0 { one.dot(other) / sizes } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    const UP: [DVec3; 4] = [DVec3::Z; 4];

    fn quad(points: [[f64; 3]; 4]) -> Quad {
        Quad { points: points.map(DVec3::from), normals: UP }
    }

    // a1 (0,1)   b1 (4,1)
    // a2 (0,0)   b2 (4,0)
    const FLAT: [[f64; 3]; 4] =
        [[4.0, 1.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 0.0], [4.0, 0.0, 0.0]];

    #[test]
    fn an_open_strip_is_two_triangles_that_face_out() {
        let quad = quad(FLAT);
        assert_eq!(cut(quad.points).triangles().len(), 2);
        assert!(is_valid(&quad, cut(quad.points), DVec3::X, 1e-6));
        assert!(
            !is_valid(&quad, cut(quad.points), DVec3::NEG_X, 1e-6),
            "the pulled edges are reversed"
        );
    }

    #[test]
    fn an_end_that_does_not_open_leaves_one_triangle() {
        let [b1, a1, a2, b2] = FLAT;
        assert_eq!(cut([b1, a1, a1, b2].map(DVec3::from)), Cut::OpenAtB);
        assert_eq!(cut([b1, a1, a2, b1].map(DVec3::from)), Cut::OpenAtA);
        assert_eq!(cut([b1, a1, a1, b1].map(DVec3::from)), Cut::Closed);
    }

    #[test]
    fn the_diagonal_that_folds_less_is_taken() {
        let [b1, a1, a2, b2] = FLAT;
        let shifted = quad([b1, [1.0, 1.0, 0.0], a2, b2]);
        assert_eq!(cut(shifted.points), Cut::FromA1, "flat: the shorter diagonal");
        let [mut low_b1, a1_again] = [b1, a1];
        low_b1[2] = -0.5;
        let twisted = quad([low_b1, a1_again, a2, b2]);
        let [b1, a1, a2, b2] = twisted.points;
        let folds = [fold([b1, a1, a2], [b1, a2, b2]), fold([b1, a1, b2], [a1, a2, b2])];
        assert_eq!(cut(twisted.points) == Cut::FromA1, folds[1] >= folds[0]);
    }
}
