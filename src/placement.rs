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
    #[cfg(test)]
    pub fn unmoved(plan: &Plan) -> Placement {
        Placement::at(plan, &IdVec::filled(0.0, plan.sectors.fans.len()))
    }

    /// Every sector at a share of its offset; `share: #sectors`.
    pub fn at(plan: &Plan, share: &IdVec<Sector, f64>) -> Placement {
        let (threads, count) = (&plan.view.threads, share.len());
        let point = threads.map(count, |sector| point_at(plan, sector, share[sector]));
        let normals = threads.map(count, |sector| {
            let has_moved = point[sector] != base(plan, sector);
            normals_at(plan, sector, share[sector], has_moved)
        });
        Placement { share: share.clone(), point, normals }
    }

    /// Moves a sector's vertex to a share of its offset.
    pub fn set(&mut self, plan: &Plan, sector: Sector, share: f64) {
        self.share[sector] = share;
        self.point[sector] = point_at(plan, sector, share);
        self.normals[sector] = normals_at(plan, sector, share, self.has_moved(plan, sector));
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

/// Where a sector's vertices stand at a share of its offset.
fn point_at(plan: &Plan, sector: Sector, share: f64) -> DVec3 {
    narrow(base(plan, sector) + plan.offsets[sector].vector * share)
}

/// The normals there, at the sector's first and at its last corner.
fn normals_at(plan: &Plan, sector: Sector, share: f64, has_moved: bool) -> [DVec3; 2] {
    let fan = &plan.sectors.fans[sector];
    let at = |corner: Corner| {
        // A move that rounding swallows leaves the vertex, and so its normal, as it was.
        if !has_moved {
            plan.view.normal_at(corner)
        } else {
            blended_normal(plan, &surface_foot(plan, sector, corner).blend(&plan.view, share))
        }
    };
    let first = at(fan.first);
    let is_one = plan.view.vertex_at(fan.first) == plan.view.vertex_at(fan.last);
    [first, if is_one { first } else { at(fan.last) }]
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
