//! The wedge that a chamfer cuts off along a convex edge.
//!
//! ```text
//!        edge
//!         /\
//!    x1  /  \  x2        across the edge: x1 and x2 count along the two faces;
//!       /----\           the chamfer runs where x1 / width1 + x2 / width2 = 1
//!      /      \
//! ```
//!
//! Where along an edge something rests on it, if only a part of it is held.

use glam::{DVec2, DVec3};

use super::{Contacts, HOLD_REACH, HOLD_SLACK};
use crate::faces::Faces;
use crate::ids::{Corner, Few};
use crate::math::unit;
use crate::tolerance::FLAT_SINE;
use crate::topology::Topology;
use crate::view::View;

/// The frame of a convex edge.
pub struct Wedge {
    ends: [DVec3; 2],
    /// Unit, from its first to its second end.
    along: DVec3,
    length: f64,
    /// Unit, from the edge into its two faces.
    into: [DVec3; 2],
    /// Of the angle between these.
    cosine: f64,
    sine: f64,
}

/// A place as seen from an edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// How far along the edge.
    pub along: f64,
    /// How far into each of the two faces.
    pub into: DVec2,
}

/// A stretch of something that rests in a wedge, from one place to another.
pub type Stretch = [Place; 2];

impl Wedge {
    /// None where the edge is not convex: the chamfer of a concave one cuts nothing off.
    pub fn new(view: &View, faces: &Faces, sides: [Corner; 2]) -> Option<Wedge> {
        let ends = [sides[0], sides[0].next()].map(|corner| view.position_at(corner));
        let length = ends[0].distance(ends[1]);
        let along = unit(ends[1] - ends[0]);
        let [one, two] = sides.map(|side| faces.normal[side.triangle()]);
        let into = [one.cross(along), along.cross(two)];
        let (cosine, sine) = (into[0].dot(into[1]), -into[1].dot(one));
        (sine > FLAT_SINE).then_some(Wedge { ends, along, length, into, cosine, sine })
    }

    pub fn ends(&self) -> [DVec3; 2] {
        self.ends
    }

    pub fn place(&self, point: DVec3) -> Place {
        let from = point - self.ends[0];
        let [one, two] = self.into.map(|into| from.dot(into));
        let across = DVec2::new(one - self.cosine * two, two - self.cosine * one);
        Place { along: from.dot(self.along), into: across / (self.sine * self.sine) }
    }

    /// Across the edge, around all that [`Wedge::clip`] keeps: seen from the edge, three corners.
    pub fn corners(&self, widths: [f64; 2], tolerance: f64) -> [DVec3; 3] {
        let out = tolerance / self.sine;
        // Where the chamfer runs on above a face, and so the other one is passed by.
        let [one, two] = [[0, 1], [1, 0]].map(|[k, other]| widths[k] * (1.0 + out / widths[other]));
        let [x, y] = self.into;
        [-(x + y) * out, x * one - y * out, y * two - x * out]
    }

    /// Whether a stretch reaches farther than this from both ends of the edge.
    pub fn is_inside_ends(&self, stretch: &Stretch, far: f64) -> bool {
        let [one, two] = stretch.map(|place| place.along);
        one.max(two) > far && one.min(two) < self.length - far
    }

    /// The part of a segment that is cut off where its sides are pulled by `widths`; what is
    /// farther above the faces than the tolerance is outside.
    pub fn clip(&self, segment: [DVec3; 2], widths: [f64; 2], tolerance: f64) -> Option<Stretch> {
        let places = segment.map(|point| self.place(point));
        let mut span = [0.0, 1.0];
        let width = widths[0].max(widths[1]);
        let share = DVec2::from(widths.map(|own| width / own));
        // Each is to be positive, and linear along the segment.
        let bounds: [&dyn Fn(&Place) -> f64; 5] = [
            &|place| place.along + tolerance,
            &|place| self.length + tolerance - place.along,
            &|place| place.into.x * self.sine + tolerance,
            &|place| place.into.y * self.sine + tolerance,
            &|place| width - place.into.x * share.x - place.into.y * share.y,
        ];
        for bound in bounds {
            cut(&mut span, places.each_ref().map(bound))?;
        }
        Some(span.map(|share| Place {
            along: mix(places[0].along, places[1].along, share),
            into: places[0].into.lerp(places[1].into, share),
        }))
    }
}

/// Keeps the part of a span in which a linear function, of these values at 0 and 1, is positive.
fn cut(span: &mut [f64; 2], [start, end]: [f64; 2]) -> Option<()> {
    if start < 0.0 && end < 0.0 {
        return None;
    }
    if (start < 0.0) != (end < 0.0) {
        let zero = start / (start - end);
        if start < 0.0 { span[0] = span[0].max(zero) } else { span[1] = span[1].min(zero) }
    }
    (span[0] <= span[1]).then_some(())
}

fn mix(from: f64, to: f64, share: f64) -> f64 {
    from + (to - from) * share
}

/// How wide each side of a chamfer is along its edge: pulled from one end to the other.
pub struct Cut {
    /// The pulled ends of both sides: `[side][end]`.
    pulled: [[DVec2; 2]; 2],
}

impl Cut {
    /// From the pulled ends of each side.
    pub fn new(wedge: &Wedge, pulled: [[DVec3; 2]; 2]) -> Cut {
        let side = |k: usize| {
            pulled[k].map(|point| {
                let from = point - wedge.ends[0];
                DVec2::new(from.dot(wedge.along), from.dot(wedge.into[k]))
            })
        };
        Cut { pulled: [side(0), side(1)] }
    }

    /// How wide a side is so far along the edge.
    fn width(&self, side: usize, along: f64) -> f64 {
        let [from, to] = self.pulled[side];
        let share = (along - from.x) / (to.x - from.x);
        mix(from.y, to.y, if share.is_finite() { share.clamp(0.0, 1.0) } else { 0.0 })
    }

    /// Whether a place is left uncovered by the chamfer: the cut goes deeper than it by more than
    /// the tolerance.
    pub fn uncovers(&self, place: &Place, tolerance: f64) -> bool {
        let [one, two] = [0, 1].map(|side| self.width(side, place.along).max(0.0));
        let into = place.into.max(DVec2::ZERO) + tolerance;
        into.x * two + into.y * one < one * two
    }
}

/// Halvings that tell to double precision where along an edge something begins to be near.
const HALVINGS: usize = 60;

impl Contacts {
    /// Where something rests on an edge that is [held](Contacts::holds): from where to where along
    /// it, in mesh units, with what room it needs there. In no order, and some over others.
    pub fn stretches(
        &self,
        view: &View,
        topology: &Topology,
        faces: &Faces,
        side: Corner,
    ) -> Few<[f64; 2]> {
        let ends = [side, side.next()].map(|corner| view.position_at(corner));
        let slack = self.tolerance * HOLD_SLACK;
        let first = self.beside_edge(ends, 0.0).map(|rims| &rims[0]);
        let balls = first.filter(|rim| rim.radius > self.tolerance);
        let mut all: Few<[f64; 2]> =
            balls.filter_map(|rim| within(ends, rim.ends, rim.radius, slack)).collect();
        if let Some(wedge) = Wedge::new(view, faces, [side, topology.twin[side]]) {
            let resting = self.in_wedge(topology, side, &wedge, [self.tolerance * HOLD_REACH; 2]);
            let resting = resting.iter().filter(|stretch| wedge.is_inside_ends(stretch, slack));
            all.extend(resting.map(|[from, to]| {
                [from.along.min(to.along) - slack, from.along.max(to.along) + slack]
            }));
        }
        all
    }
}

/// From where to where one segment is nearer to another than `far`, as lengths along it and a
/// slack more; none where it never is.
fn within(one: [DVec3; 2], other: [DVec3; 2], far: f64, slack: f64) -> Option<[f64; 2]> {
    let is_near = |share: f64| {
        let point = one[0].lerp(one[1], share);
        nearest_to(point, other).distance(point) < far
    };
    let nearest = nearest_on(one, other);
    is_near(nearest).then(|| {
        let length = one[0].distance(one[1]);
        // The distance to a segment grows both ways from where it is least.
        let reach = |end: f64| {
            let (mut near, mut past) = (nearest, end);
            for _ in 0..HALVINGS {
                let middle = (near + past) / 2.0;
                if is_near(middle) { near = middle } else { past = middle }
            }
            if is_near(end) { end } else { past }
        };
        [reach(0.0) * length - slack, reach(1.0) * length + slack]
    })
}

/// The share of one segment at which it is nearest to another.
fn nearest_on(one: [DVec3; 2], other: [DVec3; 2]) -> f64 {
    let (along_one, along_other) = (one[1] - one[0], other[1] - other[0]);
    let between = one[0] - other[0];
    let (a, b, c) =
        (along_one.length_squared(), along_one.dot(along_other), along_other.length_squared());
    let (d, e) = (along_one.dot(between), along_other.dot(between));
    // Where both lines come nearest, kept within one segment, and from there to the other.
    let on_one = share_of(b * e - c * d, a * c - b * b);
    let on_other = share_of(b * on_one + e, c);
    share_of(b * on_other - d, a)
}

/// The point of a segment that is nearest to another point.
fn nearest_to(point: DVec3, [from, to]: [DVec3; 2]) -> DVec3 {
    let along = to - from;
    from + along * share_of((point - from).dot(along), along.length_squared())
}

fn share_of(above: f64, below: f64) -> f64 {
    if below > 0.0 { (above / below).clamp(0.0, 1.0) } else { 0.0 }
}
