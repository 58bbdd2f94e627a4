//! An offset of a sector that leads elsewhere.

use glam::DVec3;

use super::place::place;
use super::{Course, Offset, unfold};
use crate::ids::Sector;
use crate::math::{Turn, unit};
use crate::sectors::Sectors;
use crate::surface::Surface;

/// The offset by another vector in the plane of the sector's face; none where that leads out of its
/// fan.
pub fn turned(
    surface: Surface,
    sectors: &Sectors,
    sector: Sector,
    offset: &Offset,
    vector: DVec3,
) -> Option<Offset> {
    let fan = &sectors.fans[sector];
    let mut spread = Vec::new();
    let is_even = unfold(surface, fan, (&mut spread, usize::MAX))?;
    let ahead = unit(spread[0].arms[0]);
    let aside = surface.faces.normal[fan.first.triangle()].cross(ahead);
    let angle = direction(vector.dot(ahead), vector.dot(aside));
    let blade = spread.iter().find(|blade| angle <= blade.end)?;
    let (angle, distance) = (angle.minus(blade.start), vector.length());
    let course = Course { blade, angle, distance, is_capped: false };
    let (vector, foot) = place(surface, (&spread, is_even), &course)?;
    Some(Offset { vector, foot, within: blade.corner, is_capped: false, ..*offset })
}

/// The angle (0 to two pi) of a direction in the plane.
fn direction(ahead: f64, aside: f64) -> Turn {
    if aside >= 0.0 {
        Turn::toward(ahead, aside)
    } else {
        Turn::toward(-1.0, 0.0).plus(Turn::toward(-ahead, -aside))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes;
    use crate::stages::stages_of;

    #[test]
    fn a_direction_goes_all_around() {
        for (ahead, aside) in [(1.0, 0.0), (1.0, 2.0), (-3.0, 1.0), (-2.0, -1.0), (1.0, -4.0)] {
            let turn = direction(ahead, aside);
            let length = f64::hypot(ahead, aside);
            assert!((turn.cos() * length - ahead).abs() < 1e-12, "{ahead} {aside}");
            assert!((turn.sin() * length - aside).abs() < 1e-12, "{ahead} {aside}");
        }
        assert!(direction(-1.0, -0.01) > direction(-1.0, 0.01));
    }

    #[test]
    fn an_offset_leads_elsewhere_on_its_face_and_not_out_of_it() {
        let mesh = shapes::l_shape();
        let stages = stages_of(&mesh, 0.1);
        for sector in stages.offsets.ids() {
            let to = |vector: DVec3| {
                let offset = &stages.offsets[sector];
                turned(stages.surface(), &stages.sectors, sector, offset, vector)
            };
            let half = stages.offsets[sector].vector / 2.0;
            let found = to(half).unwrap();
            assert!(found.vector.distance(half) < 1e-12);
            let blend = found.foot.blend(&stages.view, 1.0);
            let corners = blend.vertices.map(|v| stages.view.position(crate::ids::Vertex(v)));
            let rebuilt = crate::resample::weighted_sum(&blend, corners);
            let goal = stages.placed(0.0).base(sector) + half;
            assert!(rebuilt.distance(goal) < 1e-6, "{rebuilt} instead of {goal}");
            assert_eq!(to(-half), None, "{sector:?}");
        }
    }
}
