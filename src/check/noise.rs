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
}

impl Step {
    /// Whether the normals differ by little, less than each is off its own triangle.
    pub fn is_round(&self) -> bool {
        let [a, b] = self.normals;
        let size = a.distance(b);
        size <= LARGEST
            && self.facings().is_some_and(|[one, other]| {
                let turns = [a.distance(one), b.distance(other)];
                turns.iter().all(|&turn| size <= turn && turn < ROUNDEST)
            })
    }

    /// Whether they do so neither as the triangles do nor as at the other end.
    pub fn is_noise(&self) -> bool {
        let [a, b] = self.normals;
        let is_like = |known: DVec3| (a - b - known).length() <= SHARE * a.distance(b);
        self.is_round()
            && !is_like(self.beyond)
            && self.facings().is_some_and(|[one, other]| !is_like(one - other))
    }

    /// Where the triangles face on the side of the normals.
    fn facings(&self) -> Option<[DVec3; 2]> {
        let turned = |side: usize, facing: DVec3| facing * facing.dot(self.normals[side]).signum();
        self.facings.map(|[one, other]| [turned(0, one), turned(1, other)])
    }
}
