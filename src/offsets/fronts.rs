//! The two fronts of an offset: what of it pulls each of its sector's edges, and how it gets narrower
//! for one of them.

use std::borrow::Cow;

use glam::DVec3;

use super::{Offset, arms};
use crate::breaks::same_chart;
use crate::foot::{Foot, locate};
use crate::ids::{Corner, IdVec, Sector};
use crate::math::unit;
use crate::sectors::Sectors;
use crate::surface::Surface;
use crate::tolerance::LEVEL_COSINE;

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
    let normal = faces.normal[fan.first.triangle()];
    let mut before: Option<Corner> = None;
    for corner in sectors.corners(topology, sector) {
        let is_level = faces.normal[corner.triangle()].dot(normal) > LEVEL_COSINE;
        let is_one = before.is_none_or(|before| {
            let [one, other] = [before, corner].map(|corner| view.vertex_at(corner));
            one == other || view.normal(one) == view.normal(other) && same_chart(view, one, other)
        });
        if !is_level || !is_one {
            return None;
        }
        before = Some(corner);
    }
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

/// The offsets, of which some have unlike shares for their two edges (`fronts: #sectors by 2`): the
/// one that has less goes less far.
pub fn narrowed<'a>(
    surface: Surface,
    sectors: &Sectors,
    offsets: &'a IdVec<Sector, Offset>,
    fronts: &IdVec<Sector, [f64; 2]>,
) -> Cow<'a, IdVec<Sector, Offset>> {
    let mut narrowed = Cow::Borrowed(offsets);
    for sector in fronts.ids().filter(|&sector| fronts[sector][0] != fronts[sector][1]) {
        let most = fronts[sector][0].max(fronts[sector][1]);
        let fronts = fronts[sector].map(|share| share / most);
        if let Some(offset) = narrow(surface, sectors, sector, &offsets[sector], fronts) {
            narrowed.to_mut()[sector] = offset;
        }
    }
    narrowed
}

fn narrow(
    surface: Surface,
    sectors: &Sectors,
    sector: Sector,
    offset: &Offset,
    fronts: [f64; 2],
) -> Option<Offset> {
    let Surface { view, topology, faces } = surface;
    let [first, last] = parts(surface, sectors, sector, offset)?;
    let sum = first * fronts[0] + last * fronts[1];
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
    Some(Offset { vector, within, foot, fronts, ..*offset })
}
