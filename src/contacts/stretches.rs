//! Where along an edge something rests on it, if only a part of it is held.

use glam::DVec3;

use super::wedge::Wedge;
use super::{Contacts, HOLD_REACH, HOLD_SLACK};
use crate::faces::Faces;
use crate::ids::{Corner, Few};
use crate::topology::Topology;
use crate::view::View;

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
            let resting = self.in_wedge(topology, side, &wedge, self.tolerance * HOLD_REACH);
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
