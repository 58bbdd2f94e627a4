//! Lines as points: what lies on one line is near to each other there, however long and slanted it is.
//!
//! Boxes around slanted borders overlap by the thousand, such as around the zigzag at the foot of a
//! cone. But two that run along each other lie on one line, which has a direction, and a point where
//! it comes nearest to the middle. From both comes one point of space, so a tree that knows boxes
//! around these points, too, finds the few borders that are near to each other in either space.

use glam::DVec3;

use crate::bvh::Aabb;

/// Far more than rounding in single precision makes of a point that is a few units from the origin.
const SLACK: f64 = 1e-5;

/// Where lines are told as points.
#[derive(Clone, Copy)]
pub struct Lines {
    middle: DVec3,
    /// Nothing is farther than this from the middle.
    extent: f64,
    /// What comes that near to a line lies on it.
    reach: f64,
}

impl Lines {
    pub fn new(segments: impl Iterator<Item = [DVec3; 2]>, reach: f64) -> Lines {
        let none = [DVec3::INFINITY, DVec3::NEG_INFINITY];
        let [low, high] =
            segments.flatten().fold(none, |[low, high], point| [low.min(point), high.max(point)]);
        Lines { middle: (low + high) / 2.0, extent: high.distance(low), reach }
    }

    /// A box around the point of a segment's line. Those of two segments overlap where the ends of the
    /// shorter one lie on the line of the other.
    pub fn around(&self, [from, to]: [DVec3; 2]) -> Aabb {
        let length = from.distance(to);
        let along = (to - from) / length;
        let turn = 2.0 * self.reach / length;
        if !along.is_finite() || turn > 1.0 {
            return Aabb::ALL;
        }
        let way = (from - self.middle) / self.extent;
        let foot = way - along * way.dot(along);
        // The same for both directions of a line.
        let point = foot + DVec3::new(along.y * along.z, along.z * along.x, along.x * along.y);
        // A turn moves the foot by at most half of it, and the rest by all of it.
        let slack = self.reach / self.extent + 2.0 * turn + SLACK;
        let ends = [point - slack, point + slack];
        Aabb::around(&ends.map(|end| end.as_vec3().to_array()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const REACH: f64 = 1e-5;

    fn lines() -> Lines {
        Lines::new([[DVec3::splat(-1.0), DVec3::ONE]].into_iter(), REACH)
    }

    fn overlap(one: [DVec3; 2], other: [DVec3; 2]) -> bool {
        lines().around(one).overlaps(&lines().around(other))
    }

    //   a-----------b      the ends of the shorter one a little beside the line, to all sides
    //      d-----c
    #[test]
    fn what_runs_along_a_line_is_near_to_it() {
        let line = [DVec3::new(-0.9, 0.3, 0.2), DVec3::new(0.8, -0.4, 0.7)];
        for (start, length) in [(0.0, 1.0), (0.4, 0.3), (0.7, 0.01), (0.99, 1e-4), (0.5, 1e-5)] {
            for beside in DVec3::AXES.map(|axis| axis * REACH) {
                let ends = [start + length, start].map(|share| line[0].lerp(line[1], share));
                assert!(overlap(line, [ends[0] + beside, ends[1] - beside]), "{length} {beside}");
            }
        }
    }

    #[test]
    fn what_has_another_direction_or_lies_elsewhere_is_not() {
        let line = [DVec3::new(-0.9, 0.3, 0.2), DVec3::new(0.8, -0.4, 0.7)];
        assert!(!overlap(line, line.map(|end| end + DVec3::Z * 0.01)), "beside it");
        assert!(!overlap(line, [line[0], line[1] + DVec3::Z * 0.01]), "turned around its end");
    }
}
