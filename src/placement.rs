//! Placement: where every corner stands when each sector takes a share of its offset.

use glam::DVec3;

use crate::ids::{Corner, IdVec, Sector};
use crate::plan::Plan;
use crate::resample::{blended_normal, surface_foot};

/// Positions as they will be stored, so that what is checked is what comes out.
#[derive(Clone)]
pub struct Placement {
    /// `#sectors`: 0 (stays) to 1 (full width).
    pub share: IdVec<Sector, f64>,
    /// `#sectors`: the position of the sector's vertices.
    pub point: IdVec<Sector, DVec3>,
    /// `#sectors`: the normals at the sector's first and at its last corner.
    pub normals: IdVec<Sector, [DVec3; 2]>,
}

impl Placement {
    /// Every sector where it was.
    pub fn unmoved(plan: &Plan) -> Placement {
        let fans = || plan.sectors.fans.iter();
        let view = &plan.view;
        let normals = fans().map(|fan| [fan.first, fan.last].map(|corner| view.normal_at(corner)));
        Placement {
            share: IdVec::filled(0.0, plan.sectors.fans.len()),
            point: IdVec::from_vec(fans().map(|fan| view.position_at(fan.first)).collect()),
            normals: IdVec::from_vec(normals.collect()),
        }
    }

    /// Moves a sector's vertex to a share of its offset.
    pub fn set(&mut self, plan: &Plan, sector: Sector, share: f64) {
        let fan = &plan.sectors.fans[sector];
        let target = base(plan, sector) + plan.offsets[sector].vector * share;
        self.share[sector] = share;
        self.point[sector] = narrow(target);
        self.normals[sector] = [fan.first, fan.last].map(|corner| {
            if share == 0.0 {
                plan.view.normal_at(corner)
            } else {
                blended_normal(plan, &surface_foot(plan, sector, corner).blend(plan, share))
            }
        });
    }

    /// Whether the sector's vertices stand elsewhere than in the source.
    #[inline]
    pub fn has_moved(&self, plan: &Plan, sector: Sector) -> bool {
        self.point[sector] != base(plan, sector)
    }

    /// Where a corner of the source mesh stands now.
    #[inline]
    pub fn position_at(&self, plan: &Plan, corner: Corner) -> DVec3 {
        let sector = plan.sectors.sector_of[corner];
        if sector.is_none() { plan.view.position_at(corner) } else { self.point[sector] }
    }

    /// The normal at a corner; between the first and the last corner of a sector, the last one's.
    #[inline]
    pub fn normal_at(&self, plan: &Plan, corner: Corner) -> DVec3 {
        let sector = plan.sectors.sector_of[corner];
        if sector.is_none() {
            return plan.view.normal_at(corner);
        }
        let is_first = plan.sectors.fans[sector].first == corner;
        self.normals[sector][usize::from(!is_first)]
    }
}

/// Where the sector's vertices stand in the source.
#[inline]
pub fn base(plan: &Plan, sector: Sector) -> DVec3 {
    plan.view.position_at(plan.sectors.fans[sector].first)
}

/// Rounded to single precision.
#[inline]
fn narrow(point: DVec3) -> DVec3 {
    point.as_vec3().as_dvec3()
}
