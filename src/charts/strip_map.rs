//! Strip map: how a strip lies on the texture.

use std::cell::LazyCell;

use glam::{DVec2, DVec3};

use super::feet::{End, Frame, Room, band_foot, feet_at, flat_lay};
use super::fit::{Facing, Lie, MOST_STRETCH, misfit, roomiest};
use super::ground::Ground;
use super::{BANDS, BESIDE_BANDS, Spread, Way};
use super::{Given, TakenAt, place_of};
use crate::attributes::{Attributes, Taken};
use crate::edges::HardEdge;
use crate::ids::{Corner, Edge, Few, Triangle};
use crate::math::{area_vector, unit};
use crate::placement::Placement;
use crate::report::Blend;
use crate::strips;
use crate::surface::Surface;

/// A way onto one of the edge's sides; none where every vertex stays in its own chart.
type Lay = Option<(Way, usize)>;

/// For the corners b1, a1, a2, b2: a place in the owner's chart, where they take one.
type Feet = [Option<Blend>; 4];

/// A strip, and what is around it.
pub struct StripMap<'a> {
    surface: Surface<'a>,
    attributes: &'a Attributes,
    edge: &'a HardEdge,
    /// Places in the corners.
    triangles: &'a [[u32; 3]],
    points: [DVec3; 4],
    /// Those of the strip: b1, a1, a2, b2.
    corners: [Corner; 4],
    /// The corners at the edge's ends, on either side.
    ends: [[Corner; 2]; 2],
}

impl<'a> StripMap<'a> {
    pub fn new(
        surface: Surface<'a>,
        placement: &Placement,
        attributes: &'a Attributes,
        edge: &'a HardEdge,
        triangles: &'a [[u32; 3]],
    ) -> Self {
        let corners = strips::corners(edge);
        let points = corners.map(|corner| placement.position_at(corner));
        let ends = edge.sides.map(|side| [side, side.next()]);
        StripMap { surface, attributes, edge, triangles, points, corners, ends }
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
        let [start_near, start_far] = feet_at(self.surface, &start, way);
        let [stop_near, stop_far] = feet_at(self.surface, &stop, way);
        in_turn(side, [start_near, stop_near], [start_far, stop_far])
    }

    /// The strip at the start and at the end of the owner's half-edge.
    #[inline(always)]
    fn strip_ends(&self, owner: usize) -> [End; 2] {
        let half_edge = self.edge.sides[owner];
        let edge =
            [half_edge, half_edge.next()].map(|corner| self.surface.view.position_at(corner));
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
        let lay = flat_lay(self.surface.view, room, &frame, points.len());
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
        let ground = Ground::new(self.surface, channel, &self.ends[side]);
        roomiest(self.surface.view, own, channel, &ground)
    }

    /// How badly the strip lies on a channel in some way: see [`misfit`].
    fn misfit(&self, channel: usize, lay: Lay, feet: &Feet) -> f64 {
        let uv = |place: usize| match &feet[place] {
            Some(foot) => place_of(self.surface.view, channel, foot),
            None => self.own_uv(place, channel),
        };
        let uvs = [0, 1, 2, 3].map(uv);
        match lay {
            None => {
                let on = |side: usize| self.misfit_on(side, &self.ends[side], channel, uvs);
                let first = on(0);
                if first <= MOST_STRETCH { first } else { first.min(on(1)) }
            }
            Some((way @ (Way::Flat | Way::Roomiest), side)) => {
                let room = self.room(channel, (way, side));
                self.misfit_on(side, &[room.corner], channel, uvs)
            }
            Some((_, side)) => self.misfit_on(side, &self.ends[side], channel, uvs),
        }
    }

    fn misfit_on(&self, owner: usize, at: &[Corner], channel: usize, uvs: [DVec2; 4]) -> f64 {
        self.misfit_unsure((owner, at), channel, (&uvs, &uvs))
    }

    fn misfit_unsure(
        &self,
        (owner, at): (usize, &[Corner]),
        channel: usize,
        (uvs, unsure): (&[DVec2; 4], &[DVec2]),
    ) -> f64 {
        let ground = Ground::new(self.surface, channel, at);
        let lie = Lie { triangles: self.triangles, points: &self.points, uvs, unsure };
        misfit(self.surface.view, self.edge.sides[owner], Facing::AsFace, channel, &ground, &lie)
    }

    /// The first of [`BANDS`], of those of a side, on which the strip fits in its first channel with a
    /// seam.
    pub fn band(&self, owner: usize) -> Option<Band> {
        // Nearly all fit on the first, which is compiled by itself.
        let [first, others @ ..] = BANDS;
        let others = || others.into_iter().find_map(|way| self.band_by(way, owner));
        self.band_by(first, owner).or_else(others)
    }

    /// The band of one way, if the strip fits on it.
    #[inline(always)]
    fn band_by(&self, way: Way, owner: usize) -> Option<Band> {
        let far = self.far_feet(way, owner);
        let misfit = self.misfit_of_band(first_seam(self.edge), owner, (way, &far));
        (misfit <= MOST_STRETCH).then_some(Band { way, far })
    }

    /// Where the far corners at the start and at the end of the owner's half-edge land on its band.
    #[inline(always)]
    fn far_feet(&self, way: Way, owner: usize) -> [Option<Blend>; 2] {
        let Way::Band(spread) = way else { return [None; 2] };
        let [start, stop] = self.strip_ends(owner);
        let foot = |end: &End| band_foot(self.surface, end, spread);
        let mut feet = [foot(&start), foot(&stop)];
        if self.triangles.len() < 2 {
            for (foot, [_, place]) in feet.iter_mut().zip(places(owner)) {
                *foot = foot.filter(|_| self.is_used(place));
            }
        }
        feet
    }

    /// As [`StripMap::misfit`]. What lies on the old edge, which is a side of the owner's triangle, is on
    /// the ground.
    #[inline(always)]
    fn misfit_of_band(
        &self,
        channel: usize,
        owner: usize,
        (way, far): (Way, &[Option<Blend>; 2]),
    ) -> f64 {
        let mut uvs = [DVec2::ZERO; 4];
        let places = places(owner);
        for ([near, beyond], foot) in places.into_iter().zip(far) {
            uvs[near] = self.own_uv(near, channel);
            uvs[beyond] = match foot {
                Some(foot) => place_of(self.surface.view, channel, foot),
                None => self.own_uv(beyond, channel),
            };
        }
        let near = places.map(|[near, _]| uvs[near]);
        let is_on_edge = way != Way::Band(Spread::Narrow) && far.iter().all(Option::is_some);
        let unsure = if is_on_edge { &near[..] } else { &uvs };
        self.misfit_unsure((owner, &self.ends[owner]), channel, (&uvs, unsure))
    }

    /// Where the output vertex of a corner lies on the texture.
    fn own_uv(&self, place: usize, channel: usize) -> DVec2 {
        self.attributes.streams.uv(self.attributes.vertex_at[self.corners[place]], channel)
    }

    /// All ways, best first.
    fn lays(&self, channel: usize, owner: usize) -> impl Iterator<Item = Lay> {
        let own = (self.edge.seams >> channel & 1 == 0).then_some(None);
        let sides = [owner, 1 - owner];
        let bands = sides.into_iter().flat_map(|side| BANDS.map(|way| Some((way, side))));
        let beside = BESIDE_BANDS.into_iter().flat_map(move |way| sides.map(|s| Some((way, s))));
        own.into_iter().chain(bands).chain(beside)
    }

    /// The feet of the first way that fits, or else of the one that fits best, among those that
    /// agree with what other channels have taken.
    fn lay(&self, channel: usize, owner: usize, taken: &Feet) -> Feet {
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
    pub way: Way,
    /// Where the far corners are, at the start and at the end of the owner's half-edge.
    pub far: [Option<Blend>; 2],
}

impl Band {
    /// That of a strip that needs none.
    pub const ANY: Band = Band { way: BANDS[0], far: [None; 2] };
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
fn places(owner: usize) -> [[usize; 2]; 2] {
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
    let Given { surface, placement, attributes, .. } = *given;
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
    let map = LazyCell::new(|| StripMap::new(surface, placement, attributes, hard, triangles));
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
    face
}
