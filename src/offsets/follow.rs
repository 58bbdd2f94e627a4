//! How hidden faces go along with the visible ones in front of them.

use glam::DVec3;

use super::{CREASE_COSINE, LEVEL_COSINE, Offset};
use crate::faces::Faces;
use crate::foot::locate;
use crate::ids::{Corner, Few, IdVec, Sector};
use crate::math::{area_vector, unit};
use crate::sectors::Follower;
use crate::view::View;

/// A hidden face stays behind the visible ones: its corner goes along with theirs, as far as its
/// own plane lets it, but never out of the solid. None where the fan has no plane.
pub fn follow(
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
    let offset = Offset { vector, within, foot, is_capped: false, fronts: [1.0; 2] };
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
