//! Simple fans: one triangle, or two in one plane, between two edges that ask for one width. Most are
//! such. Nothing needs to be unfolded: where the vertex goes is told in terms of the two edges.

use glam::DVec3;

use super::place::{FARTHEST, most_lean};
use super::{MITER_LIMIT, Offset, is_between_edges, widths};
use crate::edges::Edges;
use crate::foot::{Arms, Foot, arms};
use crate::ids::Corner;
use crate::sectors::Fan;
use crate::surface::Surface;
use crate::tolerance::{FLAT_COSINE, LEAST_WEIGHT};

/// Where edges run on so nearly straight (as a sine), what leads away from them is what is left of the
/// difference of two large vectors: unfolding tells it better.
const LEAST_SINE: f64 = 0.1;

/// Between edges that meet at an angle of a larger cosine, the miter limit cuts the distance off.
const SHARP_COSINE: f64 = 1.0 - 2.0 / (MITER_LIMIT * MITER_LIMIT);

/// The offset of a simple fan; none if it is not simple, or needs more thought.
#[inline(always)]
pub fn offset_of_simple(surface: Surface, edges: &Edges, fan: &Fan) -> Option<Offset> {
    let (Surface { view, faces, .. }, Fan { first, last, .. }) = (surface, *fan);
    let [width, other] = widths(edges, fan);
    if fan.is_broken
        || width != other
        || !is_between_edges(surface, edges, fan)
        || faces.is_line(first.triangle())
    {
        return None;
    }
    let normal = faces.normal[first.triangle()];
    let [ahead, beside] = arms(view, first);
    if first == last {
        let meeting = Meeting::new([ahead, beside], normal, width)?;
        return offset(first, [ahead, beside], meeting.along);
    }
    if !is_next(surface, fan) {
        return None;
    }
    let back = view.position_at(last.prev()) - view.position_at(first);
    let meeting = Meeting::new([ahead, back], normal, width)?;
    let areas = [ahead.cross(beside), beside.cross(back)].map(|area| area.dot(normal));
    let offset = match meeting.within(areas) {
        (false, along) => offset(first, [ahead, beside], along)?,
        (true, along) => offset(last, [beside, back], along)?,
    };
    let is_even = faces.normal[last.triangle()] == normal;
    (is_even || is_level(surface, fan, offset.vector)).then_some(Offset { is_even, ..offset })
}

/// Whether a fan's last corner follows the first one, and they have their vertices in common.
#[inline(always)]
fn is_next(Surface { view, topology, faces }: Surface, &Fan { first, last, .. }: &Fan) -> bool {
    topology.twin[first.prev()] == last
        && view.vertex_at(last) == view.vertex_at(first)
        && view.vertex_at(last.next()) == view.vertex_at(first.prev())
        && !faces.is_line(last.triangle())
}

/// Whether two triangles lean from each other by what rounding does, and a way on them leads to the same
/// place.
#[inline(never)]
fn is_level(Surface { view, faces, .. }: Surface, fan: &Fan, way: DVec3) -> bool {
    let [one, other] = [fan.first, fan.last].map(|corner| faces.normal[corner.triangle()]);
    let most = most_lean(view, way.length());
    one.dot(other) >= FLAT_COSINE && one.distance_squared(other) <= most * most
}

/// A way in terms of a corner's edges; none if it leads too far past the triangle for that to tell.
#[inline(always)]
fn offset(within: Corner, arms: Arms, along: [f64; 2]) -> Option<Offset> {
    let is_near = along[0].abs() <= FARTHEST && along[1].abs() <= FARTHEST;
    let vector = arms[0] * along[0] + arms[1] * along[1];
    let foot = Foot { along, ..Foot::at(within) };
    let even = Offset { is_plain: true, is_even: true, ..Offset::none(within) };
    is_near.then_some(Offset { vector, foot, ..even })
}

/// The place that is a width away from both edges of a fan.
struct Meeting {
    /// In terms of the edges, its first one and its last one.
    along: [f64; 2],
    /// Twice the area between the edges, less than none where the fan is more than half a turn.
    area: f64,
}

impl Meeting {
    /// None where edges run on straight or meet at a tip.
    #[inline(always)]
    fn new([ahead, back]: [DVec3; 2], normal: DVec3, width: f64) -> Option<Meeting> {
        let lengths = [ahead.length(), back.length()];
        let (area, product) = (ahead.cross(back).dot(normal), lengths[0] * lengths[1]);
        let is_clear =
            area.abs() > LEAST_SINE * product && ahead.dot(back) < SHARP_COSINE * product;
        let share = width / area;
        let along = [share * lengths[1], share * lengths[0]];
        is_clear.then_some(Meeting { along, area })
    }

    /// Whether it lies in the second of a fan's two triangles, and where, in terms of that one's edges.
    /// Of both, twice the area is known.
    #[inline(always)]
    fn within(&self, [one, other]: [f64; 2]) -> (bool, [f64; 2]) {
        let [ahead, back] = self.along;
        let aside = ahead * one - back * other;
        let (is_second, along) = if aside >= 0.0 {
            (false, [aside / one, back * self.area / one])
        } else {
            (true, [ahead * self.area / other, -aside / other])
        };
        let rounded = |weight: f64| if weight.abs() < LEAST_WEIGHT { 0.0 } else { weight };
        (is_second, along.map(rounded))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::offsets::{offset, unfold};
    use crate::shapes;
    use crate::stages::stages_of;

    /// How many fans of a shape are simple, all of which go where unfolding takes them.
    fn simple_fans(mesh: &crate::mesh::MeshBuffers) -> usize {
        let stages = stages_of(mesh, 0.1);
        let mut count = 0;
        for fan in stages.sectors.fans.iter() {
            let surface = stages.surface();
            let Some(simple) = offset_of_simple(surface, &stages.edges, fan) else { continue };
            let mut spread = Vec::new();
            let is_even = unfold(surface, fan, (&mut spread, usize::MAX)).unwrap();
            let unfolded = offset(surface, &stages.edges, fan, (&spread, is_even));
            assert!(simple.vector.distance(unfolded.vector) < 1e-9, "{simple:?}, {unfolded:?}");
            assert_eq!(
                (simple.is_even, simple.is_plain, simple.is_capped),
                (unfolded.is_even, unfolded.is_plain, unfolded.is_capped)
            );
            count += 1;
        }
        count
    }

    #[test]
    fn a_simple_fan_leads_where_it_would_unfolded() {
        assert_eq!(simple_fans(&shapes::plain_cube(2.0)), 24);
        assert!(simple_fans(&shapes::l_shape()) > 0);
        assert!(simple_fans(&shapes::pyramid(16)) > 0);
    }
}
