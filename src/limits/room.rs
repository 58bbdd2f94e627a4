//! Room: the shares at which the source triangles keep enough of their area.
//!
//! All sectors grow together. When a triangle has given away what it can, the sectors that press
//! on it stop, and the others grow on: so no sector gets less than it must, and two that compete
//! for one face get the same (progressive filling; D. Bertsekas and R. Gallager, "Data Networks",
//! 1992, calls the outcome max-min fair).

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use glam::DVec3;

use crate::ids::{Corner, Few, IdVec, Sector, Triangle};
use crate::math::area_vector;
use crate::plan::Plan;

/// A triangle may give away all but this share of its area. Somewhat more than what validity asks
/// for, so that rounding does not undo it.
const LEAST_SHARE: f64 = 0.02;

/// `#sectors`: the largest share, up to 1, that leaves room in all triangles of the sector.
pub fn room(plan: &Plan) -> IdVec<Sector, f64> {
    let share = |sector: Sector| if plan.offsets[sector].moves() { GROWING } else { 0.0 };
    let share = plan.view.threads.map(plan.offsets.len(), share);
    let mut filling = Filling { plan, share, first: Vec::new(), later: BinaryHeap::new() };
    filling.first = plan.view.triangles().filter_map(|t| filling.event(t, 0.0)).collect();
    filling.first.sort_unstable();
    while let Some(event) = filling.next_event() {
        filling.stop_around(&event);
    }
    filling.share.iter_mut().for_each(|share| *share = share.min(1.0));
    filling.share
}

/// A triangle that has given away all it can when everything has grown to a share.
struct Event {
    share: f64,
    triangle: Triangle,
}

impl Ord for Event {
    /// The smallest share comes first, and of equal ones the first triangle.
    fn cmp(&self, other: &Event) -> Ordering {
        other.share.total_cmp(&self.share).then(other.triangle.cmp(&self.triangle))
    }
}

impl PartialOrd for Event {
    fn partial_cmp(&self, other: &Event) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Event {
    fn eq(&self, other: &Event) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Event {}

struct Filling<'a> {
    plan: &'a Plan<'a>,
    /// `#sectors`: the share at which each stopped.
    share: IdVec<Sector, f64>,
    /// What is known from the beginning, the earliest last. Nearly all events are: sorting them
    /// once takes less time than a heap of all.
    first: Vec<Event>,
    later: BinaryHeap<Event>,
}

/// The share of a sector that has not stopped.
const GROWING: f64 = f64::INFINITY;

/// A triangle whose corners move in proportion to a common share, or stopped before.
struct Moving {
    /// The corners at share 0, the stopped ones where they stopped.
    start: [DVec3; 3],
    /// How each corner moves; zero where it stopped.
    growth: [DVec3; 3],
    /// Its area counts along this direction.
    normal: DVec3,
    /// The least that it may come down to.
    least: f64,
    /// What it may be off that by rounding.
    slack: f64,
}

impl Filling<'_> {
    fn sectors(&self, triangle: Triangle) -> [Sector; 3] {
        triangle.corners().map(|corner| self.plan.sectors.sector_of[corner])
    }

    /// The earliest event that is left.
    fn next_event(&mut self) -> Option<Event> {
        // The greater one comes first.
        if self.first.last() > self.later.peek() { self.first.pop() } else { self.later.pop() }
    }

    fn moving(&self, triangle: Triangle) -> Moving {
        let old = self.plan.view.triangle(triangle);
        let (normal, least, slack) = self.allowance(triangle, old);
        let mut moving = Moving { start: old, growth: [DVec3::ZERO; 3], normal, least, slack };
        for (k, sector) in self.sectors(triangle).into_iter().enumerate() {
            if sector.is_some() {
                let (vector, share) = (self.plan.offsets[sector].vector, self.share[sector]);
                if share == GROWING {
                    moving.growth[k] = vector;
                } else {
                    moving.start[k] += vector * share;
                }
            }
        }
        moving
    }

    /// Along which direction a triangle's area counts, how little of it may be left, and how exact
    /// that is.
    fn allowance(&self, triangle: Triangle, old: [DVec3; 3]) -> (DVec3, f64, f64) {
        let (faces, area) = (&self.plan.faces, area_vector(old));
        if !faces.is_line(triangle) {
            let whole = area.length_squared();
            return (area, LEAST_SHARE * whole, EXHAUSTED * whole);
        }
        // A line may not fold over, but for what rounding does.
        let longest = (0..3).map(|k| old[k].distance(old[(k + 1) % 3])).fold(0.0, f64::max);
        let rounding = longest * self.plan.view.resolution / 2.0;
        let normal = faces.normal[triangle];
        (normal, area.dot(normal).min(0.0) - rounding, rounding * EXHAUSTED)
    }

    /// When the triangle will have given away all it can, from a share on.
    fn event(&self, triangle: Triangle, from: f64) -> Option<Event> {
        let is_growing = |sector: Sector| sector.is_some() && self.share[sector] == GROWING;
        if !self.sectors(triangle).into_iter().any(is_growing) {
            return None;
        }
        let share = self.moving(triangle).exhausted_at(from)?;
        (share < 1.0).then_some(Event { share, triangle })
    }

    /// Stops the sectors that press on an exhausted triangle.
    fn stop_around(&mut self, event: &Event) {
        let moving = self.moving(event.triangle);
        // Sectors may have stopped since the event was noted: then another one has taken its place.
        if moving.exhausted_at(event.share).is_none_or(|share| share > event.share) {
            return;
        }
        let sectors = self.sectors(event.triangle);
        let pressing = moving.pressing(event.share);
        for k in (0..3).filter(|&k| pressing[k]) {
            self.share[sectors[k]] = event.share;
        }
        for k in (0..3).filter(|&k| pressing[k]) {
            let is_seen = |triangle: Triangle| {
                let around = self.sectors(triangle);
                (0..k).any(|seen| pressing[seen] && around.contains(&sectors[seen]))
            };
            let corners = self.plan.sectors.corners(&self.plan.topology, sectors[k]);
            let triangles = corners.map(Corner::triangle).filter(|&triangle| !is_seen(triangle));
            let events = triangles.filter_map(|triangle| self.event(triangle, event.share));
            self.later.extend(events.collect::<Few<Event>>());
        }
    }
}

impl Moving {
    fn at(&self, share: f64) -> [DVec3; 3] {
        [0, 1, 2].map(|k| self.start[k] + self.growth[k] * share)
    }

    /// The first share, not before `from`, at which only the least area is left: a root of a
    /// quadratic function.
    fn exhausted_at(&self, from: f64) -> Option<f64> {
        let [a, b, c] = self.at(from);
        let [grow_a, grow_b, grow_c] = self.growth;
        let (ab, ac) = (b - a, c - a);
        let (grow_ab, grow_ac) = (grow_b - grow_a, grow_c - grow_a);
        let spare = self.normal.dot(ab.cross(ac)) - self.least;
        let linear = self.normal.dot(ab.cross(grow_ac) + grow_ab.cross(ac));
        let square = self.normal.dot(grow_ab.cross(grow_ac));
        // Rounding leaves a triangle that was stopped a little above or below its limit.
        if spare <= self.slack {
            return (linear < 0.0).then_some(from);
        }
        // Where even what both terms take together leaves some, there is no root before share 1.
        let taken = linear.min(0.0) + square.min(0.0);
        if spare + taken > self.slack {
            return None;
        }
        first_root(square, linear, spare).map(|further| from + further)
    }

    /// Which growing corners take area away; all of them if none does alone.
    fn pressing(&self, share: f64) -> [bool; 3] {
        let corners = self.at(share);
        let grows = self.growth.map(|growth| growth != DVec3::ZERO);
        let pressing = [0, 1, 2].map(|k| {
            let opposite = corners[(k + 1) % 3] - corners[(k + 2) % 3];
            grows[k] && self.normal.dot(self.growth[k].cross(opposite)) < 0.0
        });
        if pressing.contains(&true) { pressing } else { grows }
    }
}

/// Within this share of the old area of its limit, a triangle is taken to have reached it.
const EXHAUSTED: f64 = 1e-9;

/// The smallest positive root of `square t^2 + linear t + constant`, for a positive constant.
fn first_root(square: f64, linear: f64, constant: f64) -> Option<f64> {
    let discriminant = linear * linear - 4.0 * square * constant;
    if discriminant < 0.0 {
        return None;
    }
    // The form that does not cancel; with a positive constant it is the root that comes first.
    let denominator = -linear + discriminant.sqrt();
    (denominator > 0.0).then(|| 2.0 * constant / denominator)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_root_is_the_smallest_positive_one() {
        assert_eq!(first_root(1.0, -3.0, 2.0), Some(1.0));
        assert_eq!(first_root(0.0, -2.0, 1.0), Some(0.5));
        assert_eq!(first_root(-1.0, 0.0, 4.0), Some(2.0));
        assert_eq!(first_root(1.0, 1.0, 1.0), None);
        assert_eq!(first_root(1.0, 3.0, 2.0), None, "both roots are negative");
    }

    /// A unit right triangle whose corners move along x as given.
    fn moving(growth: [f64; 3]) -> Moving {
        let start = [DVec3::ZERO, DVec3::X, DVec3::Y];
        let growth = growth.map(|x| DVec3::X * x);
        Moving { start, growth, normal: DVec3::Z, least: LEAST_SHARE, slack: EXHAUSTED }
    }

    #[test]
    fn corners_that_approach_each_other_stop_together() {
        let moving = moving([1.0, -1.0, 0.0]);
        let share = moving.exhausted_at(0.0).unwrap();
        assert!((share - 0.49).abs() < 1e-12);
        assert_eq!(moving.pressing(share), [true, true, false]);
    }

    #[test]
    fn a_corner_that_gives_room_does_not_stop() {
        let moving = moving([2.0, 0.5, 0.0]);
        let share = moving.exhausted_at(0.0).unwrap();
        assert_eq!(moving.pressing(share), [true, false, false]);
    }
}
