//! Angles without trigonometric functions, and a few vector helpers.
//!
//! Platform sine and arccosine differ in their last bits, so none are used: an angle is its cosine
//! and sine and a count of half turns, and sums and halves of angles need only a square root.

use std::cmp::Ordering;

use glam::DVec3;

/// A non-negative angle of any size: `half_turns` times pi, and a rest in [0, pi).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Turn {
    half_turns: u32,
    cos: f64,
    sin: f64,
}

impl Turn {
    pub const ZERO: Turn = Turn { half_turns: 0, cos: 1.0, sin: 0.0 };

    /// The angle (0 to pi) between two directions of any length; zero if one has no length.
    #[inline]
    pub fn between(a: DVec3, b: DVec3) -> Turn {
        let cos = a.dot(b);
        let sin = a.cross(b).length();
        Turn::below_half(cos, sin, (cos * cos + sin * sin).sqrt())
    }

    /// The angle (0 to pi) by which a direction in the upper half of a plane turns from ahead.
    #[inline]
    pub fn toward(ahead: f64, aside: f64) -> Turn {
        Turn::below_half(ahead, aside, ahead.hypot(aside))
    }

    /// The angle (0 to pi) of a direction of some length in the upper half of a plane.
    #[inline]
    fn below_half(ahead: f64, aside: f64, length: f64) -> Turn {
        let (cos, sin) = (ahead / length, aside / length);
        if length > 0.0 && sin == 0.0 && cos < 0.0 {
            Turn { half_turns: 1, cos: -cos, sin: 0.0 }
        } else if length > 0.0 {
            Turn { half_turns: 0, cos, sin }
        } else {
            Turn::ZERO
        }
    }

    /// The sum of two angles.
    #[inline]
    pub fn plus(self, other: Turn) -> Turn {
        let mut sum = self.rotated(other.cos, other.sin);
        sum.half_turns += other.half_turns;
        sum
    }

    /// The difference to a smaller angle.
    #[inline]
    pub fn minus(self, smaller: Turn) -> Turn {
        let cos = self.cos * smaller.cos + self.sin * smaller.sin;
        let sin = self.sin * smaller.cos - self.cos * smaller.sin;
        let half_turns = self.half_turns.saturating_sub(smaller.half_turns);
        if sin < 0.0 && half_turns > 0 {
            Turn { half_turns: half_turns - 1, cos: -cos, sin: -sin }
        } else {
            Turn { half_turns, cos, sin: sin.max(0.0) }
        }
    }

    #[inline]
    pub fn half(self) -> Turn {
        let [cos, sin] =
            [1.0 + self.cos, 1.0 - self.cos].map(|twice| (twice / 2.0).max(0.0).sqrt());
        let half_turns = self.half_turns / 2;
        if self.half_turns.is_multiple_of(2) {
            return Turn { half_turns, cos, sin };
        }
        Turn { half_turns, cos: 1.0, sin: 0.0 }.rotated(-sin, cos)
    }

    #[inline]
    pub fn sin(self) -> f64 {
        if self.half_turns.is_multiple_of(2) { self.sin } else { -self.sin }
    }

    #[inline]
    pub fn cos(self) -> f64 {
        if self.half_turns.is_multiple_of(2) { self.cos } else { -self.cos }
    }

    /// Whether the angle is below 180 degrees.
    pub fn is_convex(self) -> bool {
        self.half_turns == 0
    }

    /// Adds an angle of at most pi, given by its cosine and sine.
    #[inline]
    fn rotated(self, cos: f64, sin: f64) -> Turn {
        let new_cos = self.cos * cos - self.sin * sin;
        let new_sin = self.sin * cos + self.cos * sin;
        if new_sin < 0.0 || (new_sin == 0.0 && new_cos < 0.0) {
            Turn { half_turns: self.half_turns + 1, cos: -new_cos, sin: -new_sin }
        } else {
            Turn { half_turns: self.half_turns, cos: new_cos, sin: new_sin }
        }
    }
}

impl PartialOrd for Turn {
    fn partial_cmp(&self, other: &Turn) -> Option<Ordering> {
        match self.half_turns.cmp(&other.half_turns) {
            Ordering::Equal => other.cos.partial_cmp(&self.cos),
            unequal => Some(unequal),
        }
    }
}

/// Twice the area of a triangle, as a vector along its normal.
#[inline]
pub fn area_vector([a, b, c]: [DVec3; 3]) -> DVec3 {
    (b - a).cross(c - a)
}

/// The vector at unit length, or zero if it has none.
#[inline]
pub fn unit(vector: DVec3) -> DVec3 {
    let length = vector.length();
    if length > 0.0 { vector / length } else { DVec3::ZERO }
}

#[cfg(test)]
mod tests {
    use super::*;

    const RIGHT: Turn = Turn { half_turns: 0, cos: 0.0, sin: 1.0 };

    fn assert_close(turn: Turn, degrees: f64) {
        let (sin, cos) = degrees.to_radians().sin_cos();
        assert!((turn.sin() - sin).abs() < 1e-12, "{turn:?} is not {degrees} degrees");
        assert!((turn.cos() - cos).abs() < 1e-12, "{turn:?} is not {degrees} degrees");
    }

    #[test]
    fn angles_add_past_a_full_turn() {
        let mut sum = Turn::ZERO;
        for quarter in 1..=6 {
            sum = sum.plus(RIGHT);
            assert_close(sum, 90.0 * f64::from(quarter));
        }
        assert!(!sum.is_convex());
    }

    #[test]
    fn halves_of_reflex_angles_are_on_the_inside() {
        let three_quarters = RIGHT.plus(RIGHT).plus(RIGHT);
        assert_close(three_quarters.half(), 135.0);
        assert_close(three_quarters.plus(RIGHT).half(), 180.0);
        assert_close(RIGHT.half(), 45.0);
    }

    #[test]
    fn differences_undo_sums() {
        let sixty = Turn::between(DVec3::X, DVec3::new(0.5, 0.75_f64.sqrt(), 0.0));
        let sum = sixty.plus(RIGHT).plus(RIGHT);
        assert_close(sum.minus(RIGHT), 150.0);
        assert_close(sum.minus(sixty), 180.0);
        assert!(sixty < RIGHT && RIGHT < sum);
    }
}
