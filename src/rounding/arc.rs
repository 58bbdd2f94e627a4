//! Arc: how a rounded chamfer bends from one point to another.
//!
//! A conic that leaves both points along their faces, with its control point where these meet. Seen
//! along the old edge it is a circle where both sides are equally wide, and else the ellipse that
//! touches both faces there.

use glam::DVec3;

use crate::math::unit;
use crate::tolerance::{LEAST_SLERP_SINE, LEAST_TURN};

/// Of the way from the circle to the control point, a curve goes at most so much: several edges may
/// have one control point, where they meet, and their curves stay apart.
const SHARPEST: f64 = 0.96875;

/// A point of a rounded patch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    pub point: DVec3,
    /// Unit.
    pub normal: DVec3,
}

/// A curve from one place to another.
#[derive(Clone, Copy, Debug)]
pub struct Arc {
    from: Place,
    to: Place,
    /// None where it is straight.
    bend: Option<Bend>,
}

#[derive(Clone, Copy, Debug)]
struct Bend {
    control: DVec3,
    /// Half the angle that the curve turns by, and its cosine: the weight of the control point.
    half_turn: f64,
    weight: f64,
    profile: f64,
}

impl Arc {
    pub fn straight(from: Place, to: Place) -> Arc {
        Arc { from, to, bend: None }
    }

    /// Towards a control point, as seen along an axis; `profile` is 0 for a straight line, 0.5 for
    /// the conic, and 1 for the way by the control point.
    pub fn towards(from: Place, to: Place, [control, axis]: [DVec3; 2], profile: f64) -> Arc {
        let across = |place: Place| {
            let way = place.point - control;
            unit(way - axis * axis.dot(way))
        };
        let [one, other] = [from, to].map(across);
        if one == DVec3::ZERO || other == DVec3::ZERO {
            return Arc::straight(from, to);
        }
        let weight = ((1.0 - one.dot(other)) / 2.0).max(0.0).sqrt();
        let half_turn = libm::acos(weight.min(1.0));
        let bend = Bend { control, half_turn, weight, profile };
        Arc { from, to, bend: (half_turn > LEAST_TURN).then_some(bend) }
    }

    /// Along the planes that the normals at both ends stand on; straight where it would have to
    /// bend both ways.
    pub fn between(from: Place, to: Place, profile: f64) -> Arc {
        let cosine = from.normal.dot(to.normal);
        let square = 1.0 - cosine * cosine;
        if square < LEAST_TURN {
            return Arc::straight(from, to);
        }
        let middle = (from.point + to.point) / 2.0;
        let [one, other] = [from, to].map(|place| (place.point - middle).dot(place.normal));
        let control = middle
            + from.normal * ((one - cosine * other) / square)
            + to.normal * ((other - cosine * one) / square);
        let chord = to.point - from.point;
        let is_between =
            (control - from.point).dot(chord) > 0.0 && (to.point - control).dot(chord) > 0.0;
        if !is_between {
            return Arc::straight(from, to);
        }
        let axis = unit(from.normal.cross(to.normal));
        Arc::towards(from, to, [control, axis], profile)
    }

    pub fn reversed(self) -> Arc {
        Arc { from: self.to, to: self.from, ..self }
    }

    /// The place at a share (0 to 1) of the whole turn. The normal turns evenly.
    pub fn at(&self, share: f64) -> Place {
        let normal = turned(self.from.normal, self.to.normal, share);
        let chord = self.from.point.lerp(self.to.point, share);
        let Some(bend) = self.bend else { return Place { point: chord, normal } };
        let round = self.on_conic(&bend, share);
        let point = match bend.profile {
            0.5 => round,
            flat if flat < 0.5 => chord.lerp(round, 2.0 * flat),
            sharp => round.lerp(self.by_control(&bend, share), sharpness(sharp)),
        };
        Place { point, normal }
    }

    fn on_conic(&self, bend: &Bend, share: f64) -> DVec3 {
        let angle = bend.half_turn * (2.0 * share - 1.0);
        let along = (1.0 + libm::tan(angle / 2.0) / libm::tan(bend.half_turn / 2.0)) / 2.0;
        let rest = 1.0 - along;
        let [one, control, other] = [rest * rest, 2.0 * bend.weight * along * rest, along * along];
        let sum = self.from.point * one + bend.control * control + self.to.point * other;
        sum / (one + control + other)
    }

    fn by_control(&self, bend: &Bend, share: f64) -> DVec3 {
        if share < 0.5 {
            self.from.point.lerp(bend.control, 2.0 * share)
        } else {
            bend.control.lerp(self.to.point, 2.0 * share - 1.0)
        }
    }
}

/// How far from the circle to the control point a profile above 0.5 goes.
pub fn sharpness(profile: f64) -> f64 {
    (2.0 * profile - 1.0).min(SHARPEST)
}

/// A share of the turn from one unit vector to another, along the great circle.
pub fn turned(from: DVec3, to: DVec3, share: f64) -> DVec3 {
    let (sine, cosine) = (from.cross(to).length(), from.dot(to));
    if sine < LEAST_SLERP_SINE {
        let mixed = unit(from.lerp(to, share));
        return if mixed == DVec3::ZERO { from } else { mixed };
    }
    let angle = libm::atan2(sine, cosine);
    let [one, other] = [1.0 - share, share].map(|part| libm::sin(part * angle));
    unit(from * one + to * other)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn place(point: [f64; 3], normal: [f64; 3]) -> Place {
        Place { point: DVec3::from(point), normal: DVec3::from(normal) }
    }

    const RIGHT: [[f64; 3]; 2] = [[1.0, 0.0, 0.0], [1.0, 0.0, 0.0]];
    const UP: [[f64; 3]; 2] = [[0.0, 1.0, 0.0], [0.0, 1.0, 0.0]];

    fn quarter(profile: f64) -> Arc {
        let [one, other] = [RIGHT, UP].map(|[point, normal]| place(point, normal));
        Arc::between(one, other, profile)
    }

    // Up ----.  control
    //        `.|
    //          Right
    #[test]
    fn equal_sides_make_a_circle_that_turns_evenly() {
        for step in 0..=8 {
            let share = f64::from(step) / 8.0;
            let Place { point, normal } = quarter(0.5).at(share);
            let (sin, cos) = (share * std::f64::consts::FRAC_PI_2).sin_cos();
            assert!(point.distance(DVec3::new(cos, sin, 0.0)) < 1e-12, "{point} at {share}");
            assert!(normal.distance(point) < 1e-12, "{normal} at {share}");
        }
    }

    #[test]
    fn the_profile_goes_from_the_chord_to_the_corner() {
        let half = |profile: f64| quarter(profile).at(0.5).point.x;
        assert!((half(0.0) - 0.5).abs() < 1e-12);
        assert!(half(1.0) > 0.99 && half(1.0) < 1.0, "they stay apart there");
        assert!((half(0.25) - (0.5 + 0.5_f64.sqrt()) / 2.0).abs() < 1e-12);
    }

    #[test]
    fn unequal_sides_make_an_ellipse_along_both_faces() {
        let arc = Arc::between(place([2.0, 0.0, 0.0], RIGHT[1]), place(UP[0], UP[1]), 0.5);
        for step in 0..=8 {
            let point = arc.at(f64::from(step) / 8.0).point;
            assert!(((point.x / 2.0).powi(2) + point.y.powi(2) - 1.0).abs() < 1e-12, "{point}");
        }
    }

    // _.  the normals lean the same way: it would be an S
    //  '-
    #[test]
    fn what_would_bend_both_ways_is_straight() {
        let lean = unit(DVec3::new(0.2, 1.0, 0.0));
        let from = Place { point: DVec3::ZERO, normal: DVec3::Y };
        let to = Place { point: DVec3::new(1.0, 0.5, 0.0), normal: lean };
        assert_eq!(Arc::between(from, to, 0.5).at(0.5).point, to.point / 2.0);
    }
}
