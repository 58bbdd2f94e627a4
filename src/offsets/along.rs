//! What has no chamfer of its own and goes along with what it lies at: hidden faces with the visible
//! ones in front of them, lines with the edges whose gaps they close.

use glam::DVec3;

use super::{Offset, STEPS_OF_SECTOR};
use crate::error::Error;
use crate::faces::Faces;
use crate::foot::locate;
use crate::ids::{Corner, Few, IdVec, Sector, Triangle};
use crate::math::{area_vector, unit};
use crate::sectors::{Follower, Sectors};
use crate::surface::Surface;
use crate::tolerance::{CREASE_COSINE, LEVEL_COSINE};
use crate::view::View;
use crate::watch::{Times, Watch};

/// Hidden faces, and the lines along an edge, move as what they lie at does. Where it was known of their
/// triangles whether these have plenty of room (`plenty: #triangles`), it is not any more.
///
/// # Errors
/// [`Error::Cancelled`] where the watch stops it.
pub fn go_along(
    Surface { view, topology, faces }: Surface,
    sectors: &Sectors,
    (offsets, mut plenty): (&mut IdVec<Sector, Offset>, Option<&mut IdVec<Triangle, bool>>),
    watch: &dyn Watch,
) -> Result<(), Error> {
    let mut forget = |corners: &[Corner]| {
        let known = plenty.iter_mut();
        known.for_each(|plenty| corners.iter().for_each(|c| plenty[c.triangle()] = false));
    };
    let slow = &Times(STEPS_OF_SECTOR, watch);
    for followers in sectors.followers.chunk_by(|one, other| one.sector == other.sector) {
        slow.worked(followers.len())?;
        let sector = followers[0].sector;
        let corners: Vec<Corner> = sectors.corners(topology, sector).collect();
        watch.worked(corners.len())?;
        if let Some(offset) = follow(view, faces, offsets, &corners, followers) {
            offsets[sector] = offset;
            forget(&corners);
        }
    }
    for &corner in &sectors.spanned {
        slow.worked(1)?;
        let fan: Vec<Corner> = sectors.corners(topology, sectors.sector_of[corner]).collect();
        watch.worked(fan.len())?;
        if let Some(offset) = span(view, faces, sectors, offsets, &fan) {
            offsets[sectors.sector_of[corner]] = offset;
            forget(&fan);
        }
    }
    Ok(())
}

/// Goes along with the ends of the line that the first corner of a flat fan is in: the line closes
/// the gap between a chamfered edge and two that meet on it, and stays a line.
fn span(
    view: &View,
    faces: &Faces,
    sectors: &Sectors,
    offsets: &IdVec<Sector, Offset>,
    fan: &[Corner],
) -> Option<Offset> {
    let corner = fan[0];
    let ends = [corner.next(), corner.prev()];
    let vector = |end: Corner| {
        let sector = sectors.sector_of[end];
        if sector.is_none() { DVec3::ZERO } else { offsets[sector].vector }
    };
    let at = view.position_at(corner);
    let distance = |end: Corner| view.position_at(end).distance(at);
    let share = distance(ends[0]) / (distance(ends[0]) + distance(ends[1]));
    let vector = vector(ends[0]).lerp(vector(ends[1]), share);
    let normal = faces.normal[corner.triangle()];
    let is_level = |corner: &Corner| faces.normal[corner.triangle()].dot(normal) > LEVEL_COSINE;
    let within = |&corner: &Corner| {
        let foot = locate(view, corner, at, vector)?;
        Some(Offset { vector, foot, ..Offset::none(corner) })
    };
    let inside = |offset: &Offset| offset.foot.along[0].min(offset.foot.along[1]);
    let faces = fan.iter().filter(|corner| !faces.is_line(corner.triangle())).filter_map(within);
    let best = faces.max_by(|one, other| inside(one).total_cmp(&inside(other)));
    best.filter(|_| vector.is_finite() && fan.iter().all(is_level))
}

/// A hidden face stays behind the visible ones: its corner goes along with theirs, as far as its
/// own plane lets it, but never out of the solid. None where the fan has no plane.
fn follow(
    view: &View,
    faces: &Faces,
    offsets: &IdVec<Sector, Offset>,
    corners: &[Corner],
    followers: &[Follower],
) -> Option<Offset> {
    let area = |corner: &&Corner| area_vector(view.triangle(corner.triangle())).length_squared();
    let &within = corners.iter().max_by(|one, other| area(one).total_cmp(&area(other)))?;
    let normal = faces.normal[within.triangle()];
    let is_level = |corner: &Corner| faces.normal[corner.triangle()].dot(normal) > LEVEL_COSINE;
    if !corners.iter().all(is_level) {
        return None;
    }
    let at = view.position_at(within);
    let paths = followers.iter().map(|follower| Path::new(view, normal, at, follower));
    let paths: Few<Path> = paths.collect();
    let leads: Few<DVec3> =
        followers.iter().map(|follower| offsets[follower.leader].vector).collect();
    let vector = step(&paths, &leads, normal);
    let foot = locate(view, within, at, vector)?;
    let offset = Offset { vector, foot, ..Offset::none(within) };
    vector.is_finite().then_some(offset)
}

/// The border of a hidden face at one of its ends.
struct Path {
    /// From there along the border.
    along: DVec3,
    /// From the border into the face.
    inward: DVec3,
}

impl Path {
    fn new(view: &View, normal: DVec3, at: DVec3, follower: &Follower) -> Path {
        let [from, to] = [follower.border, follower.border.next()].map(|end| view.position_at(end));
        let along = unit(to - from);
        Path { along: if from == at { along } else { -along }, inward: normal.cross(along) }
    }

    /// How far the face goes in where the one in front of it moves by a vector. Where that leads
    /// in at all it goes as far: a chamfer is less deep anywhere between its sides.
    fn depth(&self, lead: DVec3) -> f64 {
        let is_inward = lead.dot(self.inward) > 0.0;
        if is_inward { (lead - self.along * lead.dot(self.along)).length() } else { 0.0 }
    }

    /// The same, and never past the end of the border.
    fn step(&self, lead: DVec3) -> DVec3 {
        self.along * lead.dot(self.along).max(0.0) + self.inward * self.depth(lead)
    }
}

/// How a hidden face moves at a corner of its borders, behind faces that lead by some vectors.
fn step(paths: &[Path], leads: &[DVec3], normal: DVec3) -> DVec3 {
    let [one, other] = paths else { return paths[0].step(leads[0]) };
    let (lead, is_same) = (leads[0], leads[0] == leads[1]);
    if is_same && one.along.dot(other.along) < -CREASE_COSINE {
        // The border runs on: its vertex may slide either way.
        one.along * lead.dot(one.along) + one.inward * one.depth(lead)
    } else if is_same {
        let is_inward = paths.iter().all(|path| lead.dot(path.inward) >= 0.0);
        if is_inward { lead - normal * lead.dot(normal) } else { DVec3::ZERO }
    } else if one.inward.dot(other.along) > 0.0 {
        // The chamfer of the edge that leaves here cuts the corner off.
        one.step(leads[0]) + other.step(leads[1])
    } else {
        // It covers a corner that goes inwards.
        DVec3::ZERO
    }
}
