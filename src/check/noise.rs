//! Normals that noise has set apart where vertices are split, of which no edge is made.

use glam::DVec3;

/// Normals of a round surface that differ by no more than five degrees may do so by noise (twice the
/// sine of half the angle, as is the next).
const LARGEST: f64 = 0.087_238_774_730_672_5;

/// A face of a round surface is turned from the normals there by less than 45 degrees.
const ROUNDEST: f64 = 0.765_366_864_730_179_6;

/// What differs by chance is off what it is to be told from by more than this share of itself.
const SHARE: f64 = 0.25;

/// The normals of two opposite half-edges at one end.
pub(super) struct Step {
    pub normals: [DVec3; 2],
    /// Where their triangles face; none where one has no area.
    pub facings: Option<[DVec3; 2]>,
    /// What those at the other end differ by.
    pub beyond: DVec3,
    /// By how much rounding may have turned any of these.
    pub slack: f64,
}

impl Step {
    /// Whether the normals differ by little, less than each is off its own triangle.
    pub fn is_round(&self) -> bool {
        self.is_round_within(0.0)
    }

    /// Whether they may do so, for all that rounding leaves to be told.
    pub fn may_be_round(&self) -> bool {
        self.is_round_within(self.slack)
    }

    fn is_round_within(&self, slack: f64) -> bool {
        let [a, b] = self.normals;
        let size = a.distance(b);
        size <= LARGEST + slack
            && self.facings().is_some_and(|[one, other]| {
                let turns = [a.distance(one), b.distance(other)];
                turns.iter().all(|&turn| size <= turn + slack && turn < ROUNDEST + slack)
            })
    }

    /// Whether they do so neither as the triangles do nor as at the other end.
    pub fn is_noise(&self) -> bool {
        self.is_noise_within(0.0)
    }

    /// Whether they may do so, for all that rounding leaves to be told.
    pub fn may_be_noise(&self) -> bool {
        self.is_noise_within(self.slack)
    }

    fn is_noise_within(&self, slack: f64) -> bool {
        let [a, b] = self.normals;
        let is_like = |known: DVec3| (a - b - known).length() <= SHARE * a.distance(b) - slack;
        self.is_round_within(slack)
            && !is_like(self.beyond)
            && self.facings().is_some_and(|[one, other]| !is_like(one - other))
    }

    /// Where the triangles face on the side of the normals.
    fn facings(&self) -> Option<[DVec3; 2]> {
        let turned = |side: usize, facing: DVec3| facing * facing.dot(self.normals[side]).signum();
        self.facings.map(|[one, other]| [turned(0, one), turned(1, other)])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two normals, one of which is that of its triangle but for so much of what they differ by.
    fn step(short_by: f64) -> Step {
        let normals = [DVec3::Z, DVec3::new(0.05, 0.0, 1.0)].map(DVec3::normalize);
        let turned = DVec3::new(0.05 * short_by, 0.0, 1.0).normalize();
        let facings = Some([DVec3::new(0.0, 0.3, 1.0).normalize(), turned]);
        Step { normals, facings, beyond: DVec3::ZERO, slack: 1e-4 }
    }

    #[test]
    fn rounding_does_not_tell_what_is_flat_from_what_is_round() {
        let told = |short_by: f64| (step(short_by).is_noise(), step(short_by).may_be_noise());
        assert_eq!(told(-0.001), (true, true));
        assert_eq!(told(0.001), (false, true));
        assert_eq!(told(0.1), (false, false));
    }
}
