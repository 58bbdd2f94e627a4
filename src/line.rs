//! A half-edge as a line, on which the vertices of others may stand.

use glam::DVec3;

use crate::ids::Corner;
use crate::view::View;

pub struct Line {
    pub border: Corner,
    pub from: DVec3,
    /// Unit.
    pub along: DVec3,
    pub length: f64,
}

impl Line {
    pub fn new(view: &View, border: Corner) -> Line {
        let [from, to] = [border, border.next()].map(|corner| view.position_at(corner));
        let length = from.distance(to);
        Line { border, from, along: (to - from) / length, length }
    }

    pub fn ends(&self) -> [DVec3; 2] {
        [self.from, self.from + self.along * self.length]
    }

    pub fn place(&self, point: DVec3) -> f64 {
        (point - self.from).dot(self.along)
    }

    pub fn distance(&self, point: DVec3) -> f64 {
        (point - self.from).cross(self.along).length()
    }

    /// Whether a point lies between its ends, within a reach of the line and not of them.
    pub fn holds(&self, point: DVec3, reach: f64) -> bool {
        let place = self.place(point);
        place > reach && place < self.length - reach && self.distance(point) <= reach
    }

    /// Where on it another line begins and ends that runs along a part of it; none where they are apart,
    /// or have no more than a reach in common.
    pub fn shared(&self, ends: [DVec3; 2], reach: f64) -> Option<[f64; 2]> {
        let [one, other] = ends.map(|end| self.place(end));
        let (start, end) = (one.min(other).max(0.0), one.max(other).min(self.length));
        let lies_on = ends.into_iter().all(|end| self.distance(end) <= reach);
        (lies_on && end - start > reach).then_some([start, end])
    }

    /// The normal of its face there, between those of its ends.
    pub fn normal(&self, view: &View, point: DVec3) -> DVec3 {
        let share = (self.place(point) / self.length).clamp(0.0, 1.0);
        let [one, other] = [self.border, self.border.next()].map(|end| view.normal_at(end));
        one.lerp(other, share)
    }
}
