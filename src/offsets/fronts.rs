//! The two fronts of an offset: what of it pulls each of its sector's edges, and how it gets narrower
//! for one of them.

use glam::DVec3;

use super::{Offset, arms};
use crate::breaks::same_chart;
use crate::error::Error;
use crate::foot::{Foot, locate};
use crate::ids::{Corner, IdVec, Sector, Triangle};
use crate::math::unit;
use crate::sectors::Sectors;
use crate::surface::Surface;
use crate::tolerance::LEVEL_COSINE;
use crate::watch::{Watch, each};

/// Edges that meet at less than this (as a sine, 30 degrees), or run on so nearly straight, are
/// pulled together: a little less width of one of them alone would take the vertex far along the
/// other.
const LEAST_PART_SINE: f64 = 0.5;

/// The parts of an offset that pull the sector's first and its last edge: each leads along the other
/// edge, and leaves that where it is. None where the edges are not pulled each by itself: at borders,
/// on surfaces that bend, across seams, and where they run on straight.
pub fn parts(
    surface: Surface,
    sectors: &Sectors,
    sector: Sector,
    offset: &Offset,
) -> Option<[DVec3; 2]> {
    let Surface { view, topology, faces } = surface;
    let fan = &sectors.fans[sector];
    if fan.starts_at_border || fan.ends_at_border() || topology.twin[fan.first] == fan.last.prev() {
        return None;
    }
    if !is_one_face(surface, sectors, (sector, offset)) {
        return None;
    }
    let normal = faces.normal[fan.first.triangle()];
    let [ahead, _] = arms(view, fan.first);
    let [_, back] = arms(view, fan.last);
    let (ahead, back) = (unit(ahead), unit(back));
    let sine = ahead.cross(back).dot(normal);
    if sine.abs() < LEAST_PART_SINE {
        return None;
    }
    let along_last = back * (ahead.cross(offset.vector).dot(normal) / sine);
    Some([along_last, offset.vector - along_last])
}

/// Whether a sector lies on one flat face, and has one vertex there or such as could be one.
pub fn is_one_face(
    Surface { view, topology, faces }: Surface,
    sectors: &Sectors,
    (sector, offset): (Sector, &Offset),
) -> bool {
    if offset.is_even {
        return true;
    }
    let normal = faces.normal[sectors.fans[sector].first.triangle()];
    let mut before: Option<Corner> = None;
    sectors.corners(topology, sector).all(|corner| {
        let is_level = faces.normal[corner.triangle()].dot(normal) > LEVEL_COSINE;
        let is_one = before.replace(corner).is_none_or(|before| {
            let [one, other] = [before, corner].map(|corner| view.vertex_at(corner));
            one == other || view.normal(one) == view.normal(other) && same_chart(view, one, other)
        });
        is_level && is_one
    })
}

/// Of offsets that have unlike shares for their two edges (`fronts: #sectors by 2`), the one that has
/// less goes less far. The vertex may go farther along the other, so the triangles around it are not
/// known to have plenty any more (`plenty: #triangles`).
///
/// # Errors
/// [`Error::Cancelled`] where the watch stops it.
pub fn narrow_all(
    surface: Surface,
    sectors: &Sectors,
    (offsets, plenty): (&mut IdVec<Sector, Offset>, &mut IdVec<Triangle, bool>),
    fronts: &IdVec<Sector, [f64; 2]>,
    watch: &dyn Watch,
) -> Result<(), Error> {
    each(fronts.len(), watch, |sector: Sector| {
        let fronts = fronts[sector];
        if fronts[0] == fronts[1] {
            return;
        }
        let shares = fronts.map(|share| share / fronts[0].max(fronts[1]));
        if let Some(narrowed) = narrow(surface, sectors, sector, &offsets[sector], shares) {
            offsets[sector] = narrowed;
            let corners = sectors.corners(surface.topology, sector);
            corners.for_each(|corner| plenty[corner.triangle()] = false);
        }
    })
}

/// An offset that pulls its sector's first and its last edge by some shares of what it did; none where
/// these are not pulled each by itself.
pub fn narrow(
    surface: Surface,
    sectors: &Sectors,
    sector: Sector,
    offset: &Offset,
    shares: [f64; 2],
) -> Option<Offset> {
    let Surface { view, topology, faces } = surface;
    let [first, last] = parts(surface, sectors, sector, offset)?;
    let sum = first * shares[0] + last * shares[1];
    let corners = sectors.corners(topology, sector);
    let feet = corners.filter(|corner| !faces.is_line(corner.triangle())).filter_map(|corner| {
        // Fans are never quite flat: it goes down onto the triangle that it leads over.
        let normal = faces.normal[corner.triangle()];
        let vector = sum - normal * sum.dot(normal);
        let foot = locate(view, corner, view.position_at(corner), vector)?;
        Some((corner, vector, foot))
    });
    let inside = |foot: &Foot| foot.along[0].min(foot.along[1]);
    let (within, vector, foot) =
        feet.max_by(|one, other| inside(&one.2).total_cmp(&inside(&other.2)))?;
    let fronts = [0, 1].map(|front| offset.fronts[front] * shares[front]);
    Some(Offset { vector, within, foot, fronts, ..*offset })
}
