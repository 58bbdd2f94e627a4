//! Strip map: how a strip lies on the texture.

use glam::{DVec2, DVec3};

use super::feet::{End, Frame, Room, band_foot, feet_at, flat_lay};
use super::fit::{Facing, Lie, MOST_STRETCH, fits, misfit, roomiest};
use super::ground::Ground;
use super::{BANDS, BESIDE_BANDS, Spread, Way};
use super::{Given, TakenAt, place_of};
use crate::attributes::Taken;
use crate::edges::HardEdge;
use crate::ids::{Corner, Edge, Few, Triangle};
use crate::math::{area_vector, unit};
use crate::report::Blend;
use crate::strips;

/// A way onto one of the edge's sides; none where every vertex stays in its own chart.
type Lay = Option<(Way, usize)>;

/// For the corners b1, a1, a2, b2: a place in the owner's chart, where they take one.
type Feet = [Option<Blend>; 4];

/// A strip, and what is around it.
pub struct StripMap<'a> {
    given: &'a Given<'a>,
    edge: &'a HardEdge,
    /// Places in the corners.
    triangles: &'a [[u32; 3]],
    /// Those of the strip: b1, a1, a2, b2.
    corners: [Corner; 4],
    /// Where they stand.
    points: [DVec3; 4],
}

impl<'a> StripMap<'a> {
    pub fn new(given: &'a Given, edge: &'a HardEdge, triangles: &'a [[u32; 3]]) -> Self {
        let corners = strips::corners(edge);
        let points = corners.map(|corner| given.placement.position_at(corner));
        StripMap { given, edge, triangles, corners, points }
    }

    /// The corners at the edge's ends, on one of its sides.
    fn ends(&self, side: usize) -> [Corner; 2] {
        let half_edge = self.edge.sides[side];
        [half_edge, half_edge.next()]
    }

    fn feet(&self, channel: usize, lay: Lay) -> Feet {
        let Some((way, side)) = lay else { return [None; 4] };
        let mut feet = match way {
            Way::Flat | Way::Roomiest => self.flat(self.room(channel, (way, side))),
            _ => self.feet_along(way, side),
        };
        // Two triangles have all four corners.
        if self.triangles.len() < 2 {
            for place in (0..4).filter(|&place| !self.is_used(place)) {
                feet[place] = None;
            }
        }
        feet
    }

    fn feet_along(&self, way: Way, side: usize) -> Feet {
        let [start, stop] = self.strip_ends(side);
        let [start_near, start_far] = feet_at(self.given.surface, &start, way);
        let [stop_near, stop_far] = feet_at(self.given.surface, &stop, way);
        in_turn(side, [start_near, stop_near], [start_far, stop_far])
    }

    /// The strip at the start and at the end of the owner's half-edge.
    fn strip_ends(&self, owner: usize) -> [End; 2] {
        let half_edge = self.edge.sides[owner];
        let edge = self.ends(owner).map(|corner| self.given.surface.view.position_at(corner));
        let end = |place: f64, [near, far]: [usize; 2]| End {
            half_edge,
            edge,
            place,
            near: self.points[near],
            far: self.points[far],
        };
        let [start, stop] = places(owner);
        [end(0.0, start), end(1.0, stop)]
    }

    /// Whether some triangle has the corner.
    fn is_used(&self, place: usize) -> bool {
        self.triangles.iter().any(|triangle| triangle.contains(&(place as u32)))
    }

    fn flat(&self, room: Room) -> Feet {
        let places: Few<usize> = (0..4).filter(|&place| self.is_used(place)).collect();
        let points: Few<DVec3> = places.iter().map(|&place| self.points[place]).collect();
        let areas = self.triangles.iter().map(|t| area_vector(t.map(|k| self.points[k as usize])));
        let normal = unit(areas.sum());
        let frame = Frame::new(&points, points.len(), normal);
        let lay = flat_lay(self.given.surface.view, room, &frame, points.len());
        let mut feet = [None; 4];
        for (k, foot) in lay.feet.into_iter().enumerate() {
            feet[places[k]] = foot;
        }
        feet
    }

    /// Where to lay the strip flat: in the owner's own triangle, or anywhere in its chart.
    fn room(&self, channel: usize, (way, side): (Way, usize)) -> Room {
        let own = self.edge.sides[side];
        if way == Way::Flat {
            return Room { corner: own, scale: 1.0 };
        }
        let (surface, ends) = (self.given.surface, self.ends(side));
        roomiest(surface.view, own, channel, &Ground::new(surface, channel, &ends))
    }

    /// How badly the strip lies on a channel in some way: see [`misfit`].
    fn misfit(&self, channel: usize, lay: Lay, feet: &Feet) -> f64 {
        let uv = |place: usize| match &feet[place] {
            Some(foot) => place_of(self.given.surface.view, channel, foot),
            None => self.given.own_uv(self.corners[place], channel),
        };
        let uvs = [0, 1, 2, 3].map(uv);
        match lay {
            None => {
                let on = |side: usize| self.misfit_on(side, &self.ends(side), channel, &uvs);
                let first = on(0);
                if first <= MOST_STRETCH { first } else { first.min(on(1)) }
            }
            Some((way @ (Way::Flat | Way::Roomiest), side)) => {
                let room = self.room(channel, (way, side));
                self.misfit_on(side, &[room.corner], channel, &uvs)
            }
            Some((_, side)) => self.misfit_on(side, &self.ends(side), channel, &uvs),
        }
    }

    fn misfit_on(&self, owner: usize, at: &[Corner], channel: usize, uvs: &[DVec2; 4]) -> f64 {
        let (surface, face) = (self.given.surface, self.edge.sides[owner]);
        let ground = Ground::new(surface, channel, at);
        misfit(surface.view, face, Facing::AsFace, channel, &ground, &self.lie(uvs, uvs))
    }

    fn lie<'b>(&'b self, uvs: &'b [DVec2], unsure: &'b [DVec2]) -> Lie<'b> {
        Lie { triangles: self.triangles, points: &self.points, uvs, unsure }
    }

    /// Whether it lies well enough between the faces where it is one chart with them.
    fn fits_as_it_is(&self, channel: usize) -> bool {
        let uvs = self.corners.map(|corner| self.given.own_uv(corner, channel));
        [0, 1].into_iter().any(|side| self.fits_on(side, channel, &self.lie(&uvs, &uvs)))
    }

    fn fits_on(&self, side: usize, channel: usize, lie: &Lie) -> bool {
        let (surface, ends) = (self.given.surface, self.ends(side));
        fits(surface.view, Facing::AsFace, &Ground::new(surface, channel, &ends), lie)
    }

    /// The first of [`BANDS`], of those of a side, on which the strip fits in its first channel with a
    /// seam.
    pub fn band(&self, owner: usize) -> Option<Band> {
        BANDS.into_iter().find_map(|spread| self.band_by(spread, owner))
    }

    /// The band of one way, if the strip fits on it.
    fn band_by(&self, spread: Spread, owner: usize) -> Option<Band> {
        let band = Band { spread, far: self.far_feet(spread, owner) };
        self.fits_on_band(first_seam(self.edge), owner, &band).then_some(band)
    }

    /// Where the far corners at the start and at the end of the owner's half-edge land on its band.
    fn far_feet(&self, spread: Spread, owner: usize) -> [Option<Blend>; 2] {
        let [start, stop] = self.strip_ends(owner);
        let foot = |end: &End| band_foot(self.given.surface, end, spread);
        let mut feet = [foot(&start), foot(&stop)];
        if self.triangles.len() < 2 {
            for (foot, [_, place]) in feet.iter_mut().zip(places(owner)) {
                *foot = foot.filter(|_| self.is_used(place));
            }
        }
        feet
    }

    /// What lies on the old edge, which is a side of the owner's triangle, is on the ground.
    fn fits_on_band(&self, channel: usize, owner: usize, band: &Band) -> bool {
        let mut uvs = [DVec2::ZERO; 4];
        let places = places(owner);
        for ([near, beyond], foot) in places.into_iter().zip(&band.far) {
            uvs[near] = self.given.own_uv(self.corners[near], channel);
            uvs[beyond] = match foot {
                Some(foot) => place_of(self.given.surface.view, channel, foot),
                None => self.given.own_uv(self.corners[beyond], channel),
            };
        }
        let near = places.map(|[near, _]| uvs[near]);
        let is_on_edge = band.spread != Spread::Narrow && band.far.iter().all(Option::is_some);
        let unsure = if is_on_edge { &near[..] } else { &uvs };
        self.fits_on(owner, channel, &self.lie(&uvs, unsure))
    }

    /// All ways, best first.
    fn lays(&self, channel: usize, owner: usize) -> impl Iterator<Item = Lay> {
        let own = (self.edge.seams >> channel & 1 == 0).then_some(None);
        let sides = [owner, 1 - owner];
        let bands = BANDS.map(Way::Band);
        let bands = sides.into_iter().flat_map(move |side| bands.map(|way| Some((way, side))));
        let beside = BESIDE_BANDS.into_iter().flat_map(move |way| sides.map(|s| Some((way, s))));
        own.into_iter().chain(bands).chain(beside)
    }

    /// The feet of the first way that fits, or else of the one that fits best, among those that
    /// agree with what other channels have taken.
    fn lay(&self, channel: usize, owner: usize, taken: &Feet) -> Feet {
        // Where there is no seam that is nearly always all.
        if self.edge.seams >> channel & 1 == 0 && self.fits_as_it_is(channel) {
            return [None; 4];
        }
        let mut best = None;
        for lay in self.lays(channel, owner) {
            let feet = self.feet(channel, lay);
            let agrees = |place: usize| match (taken[place], feet[place]) {
                (Some(one), Some(other)) => one == other,
                _ => true,
            };
            if !(0..4).all(agrees) {
                continue;
            }
            let misfit = self.misfit(channel, lay, &feet);
            if best.is_none_or(|(least, _)| misfit < least) {
                best = Some((misfit, feet));
            }
            if misfit <= MOST_STRETCH {
                break;
            }
        }
        best.map_or(*taken, |(_, feet)| feet)
    }
}

/// A band that a strip fits on.
#[derive(Clone, Copy)]
pub struct Band {
    pub spread: Spread,
    /// Where the far corners are, at the start and at the end of the owner's half-edge.
    pub far: [Option<Blend>; 2],
}

impl Band {
    /// That of a strip that needs none.
    pub const ANY: Band = Band { spread: BANDS[0], far: [None; 2] };
}

/// The first channel with a seam at an edge; none of the channels where there is no seam.
fn first_seam(edge: &HardEdge) -> usize {
    edge.seams.trailing_zeros() as usize
}

/// The owner's feet and the far ones, each at the start and at the end of its half-edge, in the order
/// that [`places`] tells.
fn in_turn(owner: usize, near: [Option<Blend>; 2], far: [Option<Blend>; 2]) -> Feet {
    if owner == 0 { [near[1], near[0], far[0], far[1]] } else { [far[0], far[1], near[1], near[0]] }
}

/// The places of the owner's corner and of the far one, at the start and at the end of its
/// half-edge.
#[inline(always)]
pub fn places(owner: usize) -> [[usize; 2]; 2] {
    if owner == 0 { [[1, 2], [0, 3]] } else { [[3, 0], [2, 1]] }
}

/// Lays a strip into its owner's chart, where it is known on which band it fits; gives the owner's
/// face.
pub fn lay_strip(
    given: &Given,
    (edge, triangles): (Edge, &[[u32; 3]]),
    (owner, band): (usize, Option<&Band>),
    taken_at: &mut Vec<TakenAt>,
) -> Triangle {
    let hard = &given.chamfers.edges.hard[edge];
    let face = hard.sides[owner].triangle();
    // Of most meshes that is all.
    if let (&[channel], Some(band)) = (given.channels, band.filter(|_| hard.seams != 0)) {
        for ([_, point], place) in places(owner).into_iter().zip(&band.far) {
            if let &Some(place) = place {
                taken_at.push((point as u32, Taken { channels: 1 << channel, place }));
            }
        }
        return face;
    }
    lay_channels(given, (hard, triangles), (owner, band), taken_at);
    face
}

/// As [`lay_strip`], channel by channel.
fn lay_channels(
    given: &Given,
    (hard, triangles): (&HardEdge, &[[u32; 3]]),
    (owner, band): (usize, Option<&Band>),
    taken_at: &mut Vec<TakenAt>,
) {
    let map = StripMap::new(given, hard, triangles);
    let (mut taken, mut channels): (Feet, [u8; 4]) = ([None; 4], [0; 4]);
    for &channel in given.channels {
        // What the owner was chosen by need not be looked for again.
        let known = band.filter(|_| first_seam(hard) == channel && channels == [0; 4]);
        if let Some(band) = known {
            for ([_, place], foot) in places(owner).into_iter().zip(band.far) {
                taken[place] = foot;
                channels[place] = u8::from(foot.is_some()) << channel;
            }
            continue;
        }
        let feet = map.lay(channel, owner, &taken);
        for place in (0..4).filter(|&place| feet[place].is_some()) {
            taken[place] = feet[place];
            channels[place] |= 1 << channel;
        }
    }
    for point in 0..4 {
        if let Some(place) = taken[point] {
            taken_at.push((point as u32, Taken { channels: channels[point], place }));
        }
    }
}
