//! Ranks: places of single precision told apart, so that what has different ranks is never at one.

use glam::DVec3;

use crate::ids::{IdVec, Sector};

/// A vertex of a rank stands at places of that rank alone. That of a place is the sum of its coordinates,
/// counted in steps of single precision.
pub struct Ranks {
    /// `#sectors`.
    rank: IdVec<Sector, u32>,
    /// How many there are.
    count: i32,
}

impl Ranks {
    /// `#sectors`.
    pub fn new(rank: IdVec<Sector, u32>) -> Ranks {
        let count = rank.iter().max().map_or(1, |&most| most as i32 + 1);
        Ranks { rank, count }
    }

    /// Whether there is but one: nothing is to be told apart.
    pub fn are_one(&self) -> bool {
        self.count == 1
    }

    /// Where a sector's vertex stands that was at a place and goes to another: it keeps the coordinates
    /// along which it does not move.
    pub fn moved(&self, sector: Sector, from: DVec3, to: DVec3) -> DVec3 {
        let rounded = to.as_vec3().as_dvec3();
        self.nearest(sector, to, |axis| rounded[axis] != from[axis])
    }

    /// Where a point inside of a rounded chamfer stands that ends at a sector.
    pub fn point(&self, sector: Sector, point: DVec3) -> DVec3 {
        self.nearest(sector, point, |_| true)
    }

    /// The nearest place of a sector's rank, along one of some axes.
    fn nearest(&self, sector: Sector, point: DVec3, goes_along: impl Fn(usize) -> bool) -> DVec3 {
        let rounded = point.as_vec3();
        let sum: i32 = rounded.to_array().iter().map(|&at| steps(at) % self.count).sum();
        let lacking = (self.rank[sector] as i32 - sum).rem_euclid(self.count);
        if lacking == 0 {
            return rounded.as_dvec3();
        }
        let mut best = (f64::INFINITY, rounded);
        for axis in (0..3).filter(|&axis| goes_along(axis)) {
            for by in [lacking, lacking - self.count] {
                let mut place = rounded;
                place[axis] = stepped(rounded[axis], by);
                let off = (f64::from(place[axis]) - point[axis]).abs();
                if off < best.0 {
                    best = (off, place);
                }
            }
        }
        best.1.as_dvec3()
    }
}

/// How many numbers of single precision there are from zero to a number.
pub fn steps(number: f32) -> i32 {
    let bits = number.to_bits();
    let size = (bits & (i32::MAX as u32)) as i32;
    if bits >> 31 == 0 { size } else { -size }
}

/// So many numbers of single precision farther.
pub fn stepped(number: f32, by: i32) -> f32 {
    let steps = steps(number) + by;
    let size = f32::from_bits(steps.unsigned_abs());
    if steps < 0 { -size } else { size }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ids::Id;

    fn rank_of(place: DVec3, ranks: i32) -> i32 {
        let along = place.as_vec3().to_array().map(|at| steps(at) % ranks);
        along.iter().sum::<i32>().rem_euclid(ranks)
    }

    #[test]
    fn numbers_are_counted_from_zero_to_both_sides() {
        assert_eq!([0.0, -0.0, f32::from_bits(1), -f32::from_bits(3)].map(steps), [0, 0, 1, -3]);
        assert_eq!([stepped(1.0, 1), stepped(-1.0, 1)], [1.0_f32.next_up(), (-1.0_f32).next_up()]);
        assert_eq!(stepped(-f32::from_bits(1), 2), f32::from_bits(1));
    }

    #[test]
    fn what_moves_to_one_place_stands_at_places_of_its_rank_beside_it() {
        let ranks = Ranks::new(IdVec::from_vec(vec![0, 1, 2]));
        let (from, to) = (DVec3::new(1.0, 0.0, -7.0), DVec3::new(1.3, 0.0, -6.7));
        for sector in 0..3 {
            let place = ranks.moved(Sector::new(sector), from, to);
            assert_eq!(rank_of(place, 3), sector as i32);
            assert!(place.distance(to) < 3e-7, "a step along one axis, and what rounding takes");
            assert_eq!(place.y, 0.0, "where it does not move it stays in its plane");
        }
    }

    #[test]
    fn what_does_not_move_stays() {
        let ranks = Ranks::new(IdVec::from_vec(vec![0, 1]));
        let place = DVec3::new(1.0, 2.0, -3.0);
        assert_eq!([0, 1].map(|s| ranks.moved(Sector::new(s), place, place)), [place; 2]);
    }
}
