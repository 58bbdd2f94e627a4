//! Validity: when a triangle of the result is as good as the source.
//!
//! Positions are the rounded ones that will be stored; differences of them are exact enough in
//! double precision that no sign depends on the order of operations.

use glam::DVec3;

use crate::math::{area_vector, unit};
use crate::tolerance::{
    LEAST_AREA, LEAST_AREA_SHARE, LEAST_FACING_COSINE, LEAST_SLENDERNESS, LEAST_UPRIGHT_COSINE,
};

/// The square of no side is this many times the sum of the two others' squares, whatever rounding does:
/// twice is the most.
const MOST_OF_SIDES: f64 = 2.1;

/// Whether a source triangle that is hardly more than a line may become the new one: it may open,
/// but not fold over its neighbours, which lie in a plane of this normal.
pub fn stays_line(old: [DVec3; 3], new: [DVec3; 3], normal: DVec3, resolution: f64) -> bool {
    keeps_side([old, new], |area| area) && opens_along(old, new, [normal; 2], resolution)
}

/// Whether a line still has an area, and faces along with the old one: as long as it has any of its own, it
/// has a side that it may not turn away from. `measured` takes area vectors to where sides are told.
pub fn keeps_side([old, new]: [[DVec3; 3]; 2], measured: impl Fn(DVec3) -> DVec3) -> bool {
    let [old_area, new_area] = [old, new].map(|points| measured(area_vector(points)));
    !has_any_area(old) || has_any_area(new) && old_area.dot(new_area) > 0.0
}

/// Whether a triangle has more of an area than what rounding leaves in double precision.
pub fn has_any_area(points: [DVec3; 3]) -> bool {
    area_vector(points).length() > longest_side(points).powi(2) * LEAST_AREA
}

/// Whether a line that opens faces along a direction, from the one before to the one after, or no
/// more against it than it did, but for what rounding does.
pub fn opens_along(old: [DVec3; 3], new: [DVec3; 3], along: [DVec3; 2], resolution: f64) -> bool {
    let against = area_vector(old).dot(along[0]).min(0.0);
    area_vector(new).dot(along[1]) >= against - longest_side(new) * resolution
}

/// Whether a source triangle may become the new one.
pub fn survives(old: [DVec3; 3], new: [DVec3; 3]) -> bool {
    let (old_area, new_area) = (area_vector(old), area_vector(new));
    let [old_size, new_size] = [old_area, new_area].map(DVec3::length);
    new_size >= LEAST_AREA_SHARE * old_size
        && old_area.dot(new_area) >= LEAST_UPRIGHT_COSINE * old_size * new_size
        && keeps_direction(old, new)
}

/// A triangle whose corners all passed each other has its old normal again, but its sides are
/// reversed.
fn keeps_direction(old: [DVec3; 3], new: [DVec3; 3]) -> bool {
    let sides = |[a, b, c]: [DVec3; 3]| [b - a, c - b, a - c];
    let ([a, b, c], after) = (sides(old), sides(new));
    a.dot(after[0]) + b.dot(after[1]) + c.dot(after[2]) > 0.0
}

/// Whether a new triangle has area and faces the way its vertex normals point. `resolution` is
/// the least height that counts.
#[inline(always)]
pub fn faces_out(points: [DVec3; 3], normals: [DVec3; 3], resolution: f64) -> bool {
    let area = area_vector(points);
    faces(area, normals[0] + normals[1] + normals[2]) && has_area(points, area, resolution)
}

/// The cosine between a new triangle's normal and the sum of its vertex normals; none if the
/// triangle may not be.
pub fn facing(points: [DVec3; 3], normals: [DVec3; 3], resolution: f64) -> Option<f64> {
    let (area, normal) = (area_vector(points), normals[0] + normals[1] + normals[2]);
    let may_be = faces(area, normal) && has_area(points, area, resolution);
    may_be.then(|| unit(area).dot(unit(normal)))
}

/// Whether a triangle faces along a normal. Squares all over: this is asked for every new
/// triangle, and roots take longest.
#[inline(always)]
fn faces(area: DVec3, normal: DVec3) -> bool {
    let along = area.dot(normal);
    let least = LEAST_FACING_COSINE * LEAST_FACING_COSINE;
    along > 0.0 && along * along >= least * (area.length_squared() * normal.length_squared())
}

/// Whether a triangle is more than a line.
#[inline(always)]
fn has_area(points: [DVec3; 3], area: DVec3, resolution: f64) -> bool {
    let is_larger = |longest: f64| {
        let slender = longest * (LEAST_SLENDERNESS * LEAST_SLENDERNESS);
        let height =
            if slender > resolution * resolution { slender } else { resolution * resolution };
        area.length_squared() > longest * height
    };
    // Most triangles are large enough for far longer sides.
    let [a, b, c] = points;
    is_larger(MOST_OF_SIDES * ((b - a).length_squared() + (c - a).length_squared()))
        || is_larger(longest_square(points))
}

fn longest_side(points: [DVec3; 3]) -> f64 {
    longest_square(points).sqrt()
}

fn longest_square([a, b, c]: [DVec3; 3]) -> f64 {
    let squares = [(b - a), (c - b), (a - c)].map(|side| side.length_squared());
    squares[0].max(squares[1]).max(squares[2])
}

#[cfg(test)]
mod tests {
    use super::*;

    const OLD: [DVec3; 3] = [DVec3::ZERO, DVec3::X, DVec3::Y];
    const UP: [DVec3; 3] = [DVec3::Z; 3];

    #[test]
    fn a_shrunk_triangle_survives_and_a_flipped_one_does_not() {
        assert!(survives(OLD, OLD.map(|point| point * 0.5)));
        assert!(!survives(OLD, [DVec3::ZERO, DVec3::X, -DVec3::Y]));
        assert!(!survives(OLD, OLD.map(|point| point * 0.01)), "hardly any area is left");
    }

    #[test]
    fn a_triangle_turned_inside_out_does_not_survive() {
        assert!(!survives(OLD, OLD.map(|point| -point)));
    }

    // b           a terrain's border with a vertex in its middle, and the line that closes the
    // |           gap there: where b is pulled to the right, the line opens; it lies in the
    // c   b'      plane of the face behind it, and still shows its back, as the vertex normals
    // | .         say
    // a
    #[test]
    fn a_line_may_not_open_against_its_vertex_normals() {
        let old = [[0.0, 0.0, 0.0], [0.0, 0.0, -12.0], [0.0, 0.0, -6.0]].map(DVec3::from);
        let new = [old[0], DVec3::new(1.6, 0.6, -11.7), old[2]];
        let (plane, resolution) = (unit(area_vector(new)), 1e-5);
        let facing = unit(DVec3::new(1.9, -1.85, -0.1));
        assert!(stays_line(old, new, plane, resolution));
        assert!(!opens_along(old, new, [facing; 2], resolution));
        assert!(opens_along(old, new, [-facing; 2], resolution));
        let hardly = [old[0], DVec3::new(4e-6, 0.0, -12.0), old[2]];
        assert!(opens_along(old, hardly, [facing; 2], resolution), "that is rounding");
    }

    #[test]
    fn new_triangles_face_their_normals_and_have_area() {
        assert!(faces_out(OLD, UP, 1e-6));
        assert!(!faces_out([OLD[0], OLD[2], OLD[1]], UP, 1e-6));
        assert!(!faces_out([OLD[0], OLD[1], DVec3::X * 0.5], UP, 1e-6));
        assert!(!faces_out(OLD, UP, 2.0), "lower than the resolution");
    }
}
