//! Boxes along axes of their own (S. Gottschalk, M. Lin and D. Manocha, *OBBTree*, 1996).
//!
//! Boxes along the axes of space tell long narrow triangles apart only where these run along one of
//! them. A box that is turned with what it holds is as narrow as that.

use glam::DVec3;

use super::Aabb;
use crate::tolerance::{NEARLY_FLAT, TURNED_BOX_SLACK};

/// A box along axes of its own.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TurnedBox {
    middle: DVec3,
    /// Unit, at right angles.
    axes: [DVec3; 3],
    /// How far it reaches from its middle along each.
    half: [f64; 3],
}

impl TurnedBox {
    /// A place.
    pub const NONE: TurnedBox =
        TurnedBox { middle: DVec3::ZERO, axes: DVec3::AXES, half: [0.0; 3] };

    /// Around some triangles: the smallest along a side of the largest triangle and its normal.
    pub fn around(triangles: &[[DVec3; 3]]) -> TurnedBox {
        let along = |axes| TurnedBox::along(axes, triangles.as_flattened().iter().copied());
        let sides = largest(triangles).into_iter().flat_map(frames);
        sides.map(along).reduce(TurnedBox::smaller).unwrap_or(TurnedBox::NONE)
    }

    /// Around two boxes, along the axes of one of them, whichever makes it smaller.
    pub fn around_both(one: &TurnedBox, other: &TurnedBox) -> TurnedBox {
        let corners = || one.corners().chain(other.corners());
        let [first, second] = [one.axes, other.axes].map(|axes| TurnedBox::along(axes, corners()));
        first.smaller(second)
    }

    /// The first of equals.
    fn smaller(self, other: TurnedBox) -> TurnedBox {
        if other.surface() < self.surface() { other } else { self }
    }

    fn along(axes: [DVec3; 3], points: impl Iterator<Item = DVec3>) -> TurnedBox {
        let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        for point in points {
            let place = DVec3::from(axes.map(|axis| axis.dot(point)));
            (low, high) = (low.min(place), high.max(place));
        }
        let middle = ((low + high) / 2.0).to_array();
        let slack = TURNED_BOX_SLACK * low.abs().max(high.abs()).max_element();
        let half = ((high - low) / 2.0 + slack).to_array();
        let middle = axes[0] * middle[0] + axes[1] * middle[1] + axes[2] * middle[2];
        TurnedBox { middle, axes, half }
    }

    fn corners(&self) -> impl Iterator<Item = DVec3> {
        let sides = [0, 1, 2].map(|k| self.axes[k] * self.half[k]);
        let middle = self.middle;
        (0..8).map(move |corner| {
            let side = |k: usize| if corner >> k & 1 == 0 { -sides[k] } else { sides[k] };
            middle + side(0) + side(1) + side(2)
        })
    }

    /// Half of it.
    fn surface(&self) -> f64 {
        let [x, y, z] = self.half;
        x * y + y * z + z * x
    }

    /// Whether one of its sides keeps off a box that is turned otherwise, or what is within the straight
    /// one around the same, for certain: a plane along an edge of each is not tried.
    pub fn keeps_off(&self, other: &TurnedBox, straight: &Aabb) -> bool {
        let (middle, half) = straight.middle_and_half();
        (0..3).any(|k| {
            let axis = self.axes[k];
            let is_beyond = |way: DVec3, reach: f64| axis.dot(way).abs() > self.half[k] + reach;
            let reach: f64 = (0..3).map(|of| axis.dot(other.axes[of]).abs() * other.half[of]).sum();
            is_beyond(other.middle - self.middle, reach)
                || is_beyond(middle - self.middle, half.dot(axis.abs()))
        })
    }
}

/// The first of the largest.
fn largest(triangles: &[[DVec3; 3]]) -> Option<&[DVec3; 3]> {
    let area = |&[a, b, c]: &[DVec3; 3]| (b - a).cross(c - a).length_squared();
    triangles.iter().reduce(|most, each| if area(each) > area(most) { each } else { most })
}

/// Axes along each side of a triangle, with its normal where it has one.
fn frames(&[a, b, c]: &[DVec3; 3]) -> [[DVec3; 3]; 3] {
    let normal = (b - a).cross(c - a);
    [b - a, c - b, a - c].map(|side| {
        let along = side.try_normalize().unwrap_or(DVec3::X);
        let is_flat = normal.length() > NEARLY_FLAT * side.length_squared();
        // Rounding leaves some of the side in the normal of a sliver.
        let up = (normal - along * along.dot(normal)).try_normalize().filter(|_| is_flat);
        let up = up.unwrap_or_else(|| along.any_orthonormal_vector());
        [along, up.cross(along), up]
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The box around some triangles, and the straight one.
    fn around(triangles: &[[DVec3; 3]]) -> (TurnedBox, Aabb) {
        let points: Vec<[f32; 3]> =
            triangles.as_flattened().iter().map(|point| point.as_vec3().to_array()).collect();
        (TurnedBox::around(triangles), Aabb::around(&points))
    }

    fn are_apart(one: (TurnedBox, Aabb), other: (TurnedBox, Aabb)) -> bool {
        one.0.keeps_off(&other.0, &other.1) || other.0.keeps_off(&one.0, &one.1)
    }

    /// A needle from a point along a direction of the plane, a thousandth as broad as long.
    fn needle(from: [f64; 2], turns: f64) -> [DVec3; 3] {
        let (sin, cos) = (turns * std::f64::consts::TAU).sin_cos();
        let (along, across) = (DVec3::new(cos, sin, 0.0), DVec3::new(-sin, cos, 0.0));
        let from = DVec3::new(from[0], from[1], 1.0);
        [from, from + along, from + across * 1e-3]
    }

    //   / / /    whose boxes along the axes all overlap
    #[test]
    fn needles_side_by_side_are_apart() {
        let needles = [0.0, 0.01, 0.02].map(|x| needle([x, 0.0], 0.125));
        let boxes = needles.map(|needle| around(&[needle]));
        assert!(are_apart(boxes[0], boxes[1]) && are_apart(boxes[2], boxes[1]));
        let both = TurnedBox::around_both(&boxes[0].0, &boxes[1].0);
        let both = (both, boxes[0].1.union(boxes[1].1));
        assert!(are_apart(both, boxes[2]), "two are as narrow as their row");
        assert!(!are_apart(both, boxes[0]) && !are_apart(both, boxes[1]));
    }

    #[test]
    fn what_touches_or_crosses_is_not_apart() {
        let one = needle([0.25, 0.5], 0.07).map(|point| point.as_vec3().as_dvec3());
        for turns in 0..50 {
            let [x, y, _] = one[1].to_array();
            let touching = needle([x, y], f64::from(turns) / 50.0);
            assert!(!are_apart(around(&[one]), around(&[touching])), "{turns}");
        }
        let middle = (one[0] + one[1]) / 2.0;
        let upright = |x: f64| around(&[needle([x, middle.y - 0.5], 0.25)]);
        assert!(!are_apart(around(&[one]), upright(middle.x)));
        assert!(are_apart(around(&[one]), upright(middle.x + 0.6)));
    }

    //     /|   a wedge above a needle: the smallest box around it is turned and reaches through
    //    / |   the needle, but the straight one does not
    //   --------
    #[test]
    fn the_straight_box_has_a_say_too() {
        let at = |x: f64, y: f64, z: f64| DVec3::new(x, y, z);
        let flat = [at(-9.0, 0.0, 0.0), at(9.0, 0.1, 0.0), at(-9.0, 0.1, 0.0)];
        let wedge = [
            [at(0.0, 0.2, -0.1), at(1.0, 1.2, -0.1), at(0.0, 0.2, 0.1)],
            [at(1.0, 0.2, -0.1), at(1.0, 1.2, -0.1), at(1.0, 0.2, 0.1)],
        ];
        let (turned, straight) = around(&wedge);
        let floor = TurnedBox::around(&[flat]);
        assert!(!floor.keeps_off(&turned, &Aabb::ALL) && !turned.keeps_off(&floor, &Aabb::ALL));
        assert!(floor.keeps_off(&turned, &straight));
    }

    #[test]
    fn all_points_are_within_at_any_turn_and_place() {
        for step in 0..200 {
            let far = f64::from(step % 7) * 1e6;
            let needles = [0.0, 0.3].map(|more| needle([far, 0.0], f64::from(step) / 77.0 + more));
            let [one, other] = needles.map(|needle| TurnedBox::around(&[needle]));
            let both = TurnedBox::around_both(&one, &other);
            for point in needles.as_flattened() {
                let place = TurnedBox::around(&[[*point; 3]]);
                let is_apart = both.keeps_off(&place, &Aabb::ALL);
                assert!(!is_apart && !place.keeps_off(&both, &Aabb::ALL), "{step}");
            }
        }
    }

    #[test]
    fn triangles_without_area_have_boxes() {
        let at = |x: f64| DVec3::new(x, x, x);
        let line = around(&[[at(0.0), at(0.25), at(1.0)]]);
        let place = |point: DVec3| around(&[[point; 3]]);
        assert!(!are_apart(line, place(at(0.5))));
        assert!(are_apart(line, place(at(1.5))));
        assert!(are_apart(line, place(DVec3::new(0.5, 0.5, 0.625))));
    }
}
