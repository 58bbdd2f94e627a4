//! Fits: which edges have room for the whole width in the flat faces beside them.
//!
//! An edge has room if each of its ends has, on both sides: the place where its vertex goes at full
//! width lies in the flat region of its faces, and no other edge at which that region ends is nearer
//! to it than the width. Where an edge ends in the middle of a face its chamfer tapers to a point,
//! which counts as room.

use chamfer::check::check;
use chamfer::{Chamfered, EdgeVerdict, Mesh, Outcome, Reason, Verify};
use glam::DVec3;

use super::ground::{Ground, next, previous};

/// Triangles within half a degree of each other are one flat region.
const LEVEL_COSINE: f64 = 0.99996;

/// No vertex goes farther than so many widths.
const MITER_LIMIT: f64 = 3.0;

/// Regions of more triangles are left out: looking for what is near would take too long.
const LARGEST: usize = 4000;

/// Rounding, as a share of the width.
const SLACK: f64 = 1e-4;

/// Lengths of hard edges.
#[derive(Clone, Copy, Default)]
pub struct Fits {
    pub whole: f64,
    pub has_room: f64,
    /// Of those that have room.
    pub full: f64,
    /// Of those too, what is not full and would be if nothing of a face had to stay, if widths could
    /// jump, and if both were so.
    pub held: [f64; 3],
    pub all_full: f64,
    /// Edges with room, and how many have one end more than a tenth wider than the other: without
    /// and with a verdict that says why.
    pub roomy: usize,
    pub uneven: usize,
    pub told: usize,
    /// Ends of chamfers, and how many have one side more than twice as wide as the other.
    pub ends: usize,
    pub lopsided: usize,
}

/// `freed`: the same mesh with a least breadth of 0, with an evenness of 0, and with both.
pub fn fits(mesh: &Mesh, after: &Chamfered, freed: &[Chamfered; 3]) -> Fits {
    let regions = Regions::new(Ground::new(mesh));
    let width = f64::from(after.width);
    let mut fits = Fits::default();
    for edge in check(mesh, after, Verify::Fast).edges {
        for end in edge.distances.iter().filter(|end| end.iter().all(|&side| side > 0.0)) {
            fits.ends += 1;
            fits.lopsided += usize::from(end[0].max(end[1]) > 2.02 * end[0].min(end[1]));
        }
    }
    for (number, verdict) in after.verdicts.iter().enumerate() {
        let ground = &regions.ground;
        let [from, to] = verdict.vertices.map(|vertex| ground.place[vertex as usize]);
        let length = ground.points[from].distance(ground.points[to]);
        let is_full = verdict.outcome == Outcome::Full;
        fits.whole += length;
        fits.all_full += if is_full { length } else { 0.0 };
        if regions.has_room([from, to], width) {
            fits.has_room += length;
            fits.full += if is_full { length } else { 0.0 };
            for (held, freed) in fits.held.iter_mut().zip(freed) {
                *held += if !is_full && is_full_in(freed, number, verdict) { length } else { 0.0 };
            }
            let [one, other] = verdict.widths;
            let is_uneven = !tapers(verdict) && (one - other).abs() > 0.1 * one.max(other);
            // Where something rests on an edge, or it would fold, its verdict says so.
            let is_told = !matches!(verdict.reason, Reason::None | Reason::NoRoom);
            fits.roomy += 1;
            fits.uneven += usize::from(is_uneven && !is_told);
            fits.told += usize::from(is_uneven && is_told);
        }
    }
    fits
}

/// Whether an edge is full in another result.
fn is_full_in(other: &Chamfered, number: usize, verdict: &EdgeVerdict) -> bool {
    let same = other.verdicts.get(number).filter(|same| same.vertices == verdict.vertices);
    same.is_some_and(|same| same.outcome == Outcome::Full)
}

/// Whether an edge comes down to a point at one end by design.
pub fn tapers(verdict: &EdgeVerdict) -> bool {
    let [one, other] = verdict.widths;
    verdict.outcome == Outcome::Full && one.min(other) < 0.01 * one.max(other)
}

/// The flat faces of a mesh.
struct Regions<'a> {
    ground: Ground<'a>,
    /// `#triangles`.
    region_of: Vec<usize>,
    /// `#regions`: the triangles of each.
    triangles: Vec<Vec<usize>>,
    /// `#regions`: the half-edges at which each ends hard.
    rims: Vec<Vec<usize>>,
}

impl<'a> Regions<'a> {
    fn new(ground: Ground<'a>) -> Regions<'a> {
        let count = ground.mesh.indices.len() / 3;
        let mut region_of = vec![usize::MAX; count];
        let (mut triangles, mut rims) = (Vec::new(), Vec::new());
        for seed in 0..count {
            if region_of[seed] != usize::MAX {
                continue;
            }
            region_of[seed] = triangles.len();
            let (mut members, mut rim) = (vec![seed], Vec::new());
            let mut done = 0;
            while done < members.len() {
                let triangle = members[done];
                for side in (0..3).map(|k| 3 * triangle + k) {
                    match ground.across(side) {
                        None => rim.push(side),
                        Some(other) => {
                            let level = ground.face_normal(side).dot(ground.face_normal(other));
                            if level > LEVEL_COSINE && region_of[other / 3] == usize::MAX {
                                region_of[other / 3] = triangles.len();
                                members.push(other / 3);
                            }
                        }
                    }
                }
                done += 1;
            }
            triangles.push(members);
            rims.push(rim);
        }
        Regions { ground, region_of, triangles, rims }
    }

    fn has_room(&self, [from, to]: [usize; 2], width: f64) -> bool {
        let sides = |ends: [usize; 2]| self.ground.half_edges.get(&ends).map_or(&[][..], |s| s);
        let ([one], [other]) = (sides([from, to]), sides([to, from])) else { return false };
        [*one, *other].iter().all(|&side| {
            let twin = if side == *one { *other } else { *one };
            self.start_fits(side, twin, width) && self.end_fits(side, twin, width)
        })
    }

    fn start_fits(&self, side: usize, twin: usize, width: f64) -> bool {
        let mut fan = vec![side];
        while let Some(corner) = self.ground.across(previous(fan[fan.len() - 1])) {
            if corner == side || fan.len() > 64 {
                return false;
            }
            fan.push(corner);
        }
        self.fan_fits(&fan, twin, width)
    }

    fn end_fits(&self, side: usize, twin: usize, width: f64) -> bool {
        let mut fan = vec![next(side)];
        while let Some(other) = self.ground.across(fan[fan.len() - 1]) {
            let corner = next(other);
            if corner == fan[0] || fan.len() > 64 {
                return false;
            }
            fan.push(corner);
        }
        fan.reverse();
        self.fan_fits(&fan, twin, width)
    }

    fn fan_fits(&self, fan: &[usize], twin: usize, width: f64) -> bool {
        let ground = &self.ground;
        let (first, last) = (fan[0], previous(fan[fan.len() - 1]));
        if first == twin || last == twin {
            return true;
        }
        let normal = ground.face_normal(first);
        if fan.iter().any(|&corner| ground.face_normal(corner).dot(normal) < LEVEL_COSINE) {
            return false;
        }
        let way =
            |from: usize, to: usize| (ground.point(to) - ground.point(from)).normalize_or_zero();
        let (arm, back) = (|c: usize| way(c, next(c)), |c: usize| way(c, previous(c)));
        let angle: f64 = fan.iter().map(|&c| arm(c).angle_between(back(c))).sum();
        let is_border = |side: usize| {
            let ends = [ground.place_at(next(side)), ground.place_at(side)];
            !ground.half_edges.contains_key(&ends)
        };
        let (turn, sine) = match (is_border(first), is_border(last)) {
            (false, false) => (angle / 2.0, (angle / 2.0).sin()),
            (true, false) => (0.0, angle.sin()),
            (false, true) => (angle, angle.sin()),
            (true, true) => return false,
        };
        if sine < 0.1 {
            return false;
        }
        let (along, aside) = (arm(first), normal.cross(arm(first)));
        let way = along * turn.cos() + aside * turn.sin();
        let place = ground.point(first) + way * (width / sine).min(width * MITER_LIMIT);
        self.is_free(ground.place_at(first), first / 3, place, width * (1.0 - SLACK))
    }

    fn is_free(&self, vertex: usize, triangle: usize, place: DVec3, width: f64) -> bool {
        let ground = &self.ground;
        let region = self.region_of[triangle];
        let members = &self.triangles[region];
        if members.len() > LARGEST {
            return false;
        }
        let normal = ground.face_normal(3 * triangle);
        let is_inside = members.iter().any(|&triangle| {
            (0..3).map(|k| 3 * triangle + k).all(|side| {
                let along = ground.point(next(side)) - ground.point(side);
                let out = along.cross(normal).normalize_or_zero();
                (place - ground.point(side)).dot(out) <= SLACK * width
            })
        });
        let is_near = |&side: &usize| {
            let ends = [ground.place_at(side), ground.place_at(next(side))];
            !ends.contains(&vertex) && {
                let [a, b] = ends.map(|end| ground.points[end]);
                let along = b - a;
                let share = ((place - a).dot(along) / along.length_squared()).clamp(0.0, 1.0);
                (a + along * share).distance(place) < width
            }
        };
        is_inside && !self.rims[region].iter().any(is_near)
    }
}
