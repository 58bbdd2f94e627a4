//! A quick look at two triangles, in double precision: most pairs whose boxes overlap are apart by
//! far more than rounding, and need no exact predicate.

use glam::DVec3;

use super::Triangle;

/// Far more than what is lost in the products below, relative to their largest terms.
const ROUNDING: f64 = 1e-13;

/// Whether a plane for certain keeps two triangles apart that have no corner in common.
pub fn are_apart(a: &Triangle, b: &Triangle) -> bool {
    let [a, b] = [a, b].map(|triangle| triangle.map(wide));
    Face::new(a).keeps_off(&b) || Face::new(b).keeps_off(&a)
}

/// The same for two triangles that have a corner in common, which comes first in both: the plane
/// leads through it, and all else is on its two sides.
pub fn are_apart_but_for_corner(a: &Triangle, b: &Triangle) -> bool {
    let [a, b] = [a, b].map(|triangle| triangle.map(wide));
    Face::new(a).keeps_off_beside_corner([b[1], b[2]])
        || Face::new(b).keeps_off_beside_corner([a[1], a[2]])
}

fn wide(point: [f32; 3]) -> DVec3 {
    DVec3::from(point.map(f64::from))
}

/// A triangle with the plane it lies in.
struct Face {
    corners: [DVec3; 3],
    normal: DVec3,
    /// How large the products that make up the normal can be.
    size: f64,
}

impl Face {
    fn new(corners: [DVec3; 3]) -> Face {
        let [one, other] = [corners[1] - corners[0], corners[2] - corners[0]];
        let size = largest(one) * largest(other);
        Face { corners, normal: one.cross(other), size }
    }

    /// Whether all points are on one side of the triangle's plane, or beyond one of its sides.
    fn keeps_off(&self, points: &[DVec3; 3]) -> bool {
        let side = |point: DVec3| self.above(point - self.corners[0]);
        let sides = points.map(side);
        if sides == [1; 3] || sides == [-1; 3] {
            return true;
        }
        (0..3).any(|k| {
            let from = self.corners[k];
            let along = self.corners[(k + 1) % 3] - from;
            points.iter().all(|&point| self.is_beyond(along, point - from))
        })
    }

    /// As [`Face::keeps_off`], for a triangle with the same first corner as this one.
    fn keeps_off_beside_corner(&self, others: [DVec3; 2]) -> bool {
        let ways = others.map(|point| point - self.corners[0]);
        let sides = ways.map(|way| self.above(way));
        let along = [self.corners[1] - self.corners[0], self.corners[0] - self.corners[2]];
        sides == [1; 2]
            || sides == [-1; 2]
            || along.into_iter().any(|along| ways.iter().all(|&way| self.is_beyond(along, way)))
    }

    /// 1 if a way from the plane leads up for certain, -1 if down.
    fn above(&self, way: DVec3) -> i8 {
        let height = self.normal.dot(way);
        let rounding = ROUNDING * self.size * largest(way);
        i8::from(height > rounding) - i8::from(height < -rounding)
    }

    /// Whether a way from a side of the triangle for certain leads away from the triangle.
    fn is_beyond(&self, along: DVec3, way: DVec3) -> bool {
        let inside = self.normal.cross(along).dot(way);
        inside < -ROUNDING * self.size * largest(along) * largest(way)
    }
}

fn largest(vector: DVec3) -> f64 {
    vector.abs().max_element()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::intersect::cut_each_other;

    const FLOOR: Triangle = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]];

    #[test]
    fn above_and_beside_are_apart() {
        let raised = FLOOR.map(|[x, y, z]| [x, y, z + 0.01]);
        let beside = FLOOR.map(|[x, y, z]| [x + 4.01, y, z]);
        assert!(are_apart(&FLOOR, &raised));
        assert!(are_apart(&FLOOR, &beside));
        assert!(!are_apart(&FLOOR, &FLOOR.map(|[x, y, z]| [x + 4.0, y, z])), "they touch");
    }

    #[test]
    fn around_a_corner_what_lies_in_other_directions_is_apart() {
        let beside = [FLOOR[0], [-1.0, 3.0, 0.0], [-3.0, 1.0, 0.0]];
        assert!(are_apart_but_for_corner(&FLOOR, &beside));
        let through = [FLOOR[0], [2.0, 2.0, 1.0], [2.0, 2.0, -1.0]];
        assert!(!are_apart_but_for_corner(&FLOOR, &through));
        assert!(cut_each_other(&FLOOR, &through));
    }
}
