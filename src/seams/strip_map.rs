//! Strip map: how a strip lies on the texture.

use glam::{DVec2, DVec3};

use super::feet::{Depth, End, Frame, Room, Spread, abreast, band_foot, flat_lay, inside};
use super::fit::{Facing, Lie, MOST_STRETCH, misfit, roomiest};
use super::ground::Ground;
use super::patch::{Joint, Patches};
use super::{Owners, channels_of, place_of};
use crate::attributes::{Attributes, Taken};
use crate::edges::HardEdge;
use crate::ids::{Corner, Edge, Few};
use crate::math::{area_vector, unit};
use crate::placement::Placement;
use crate::plan::Plan;
use crate::report::{Blend, TriangleKind, TriangleSource};
use crate::strips::{self, Cut};

/// A way to lay a strip on the texture. Owners are places in the edge's sides.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Way {
    /// Every vertex stays in its own chart.
    Own,
    /// On the band that the owner's side has left free, or a part of it.
    Band(usize, Spread, Depth),
    /// Along the edge, within the triangle of the owner's side.
    Inside(usize),
    /// Along the edge, and past that triangle.
    Abreast(usize),
    /// Flat, anywhere in a triangle of the owner's chart.
    Flat(usize, Room),
}

/// The ways onto one side's band, best first.
const BANDS: [(Spread, Depth); 6] = [
    (Spread::Far, Depth::Band),
    (Spread::Near, Depth::Band),
    (Spread::Whole, Depth::Band),
    (Spread::Far, Depth::Strip),
    (Spread::Near, Depth::Strip),
    (Spread::Whole, Depth::Strip),
];

fn bands(owner: usize) -> impl Iterator<Item = Way> {
    (0..BANDS.len()).map(move |band| on_band(owner, band))
}

fn on_band(owner: usize, band: usize) -> Way {
    let (spread, depth) = BANDS[band];
    Way::Band(owner, spread, depth)
}

/// For the corners b1, a1, a2, b2: a place in the owner's chart, where they take one.
type Feet = [Option<Blend>; 4];

/// A strip, and what is around it.
pub struct StripMap<'a> {
    plan: &'a Plan<'a>,
    attributes: &'a Attributes,
    edge: &'a HardEdge,
    cut: Cut,
    points: [DVec3; 4],
    /// Those of the strip: b1, a1, a2, b2.
    corners: [Corner; 4],
    /// The corners at the edge's ends, on either side.
    ends: [[Corner; 2]; 2],
}

impl<'a> StripMap<'a> {
    pub fn new(
        plan: &'a Plan,
        placement: &Placement,
        attributes: &'a Attributes,
        edge: &'a HardEdge,
        cut: Cut,
    ) -> Self {
        let corners = strips::corners(edge);
        let points = corners.map(|corner| placement.position_at(plan, corner));
        let ends = edge.sides.map(|side| [side, side.next()]);
        StripMap { plan, attributes, edge, cut, points, corners, ends }
    }

    fn feet(&self, way: Way) -> Feet {
        let mut feet = [None; 4];
        match way {
            Way::Own => {}
            Way::Band(owner, spread, depth) => {
                for (end, [_, far]) in self.strip_ends(owner).into_iter().zip(places(owner)) {
                    feet[far] = band_foot(self.plan, &end, spread, depth);
                }
            }
            Way::Abreast(owner) => {
                for (end, ends) in self.strip_ends(owner).into_iter().zip(places(owner)) {
                    for (place, foot) in
                        ends.into_iter().zip(abreast(self.plan, &end).into_iter().flatten())
                    {
                        feet[place] = Some(foot);
                    }
                }
            }
            Way::Flat(_, room) => feet = self.flat(room),
            Way::Inside(owner) => {
                for (end, ends) in self.strip_ends(owner).into_iter().zip(places(owner)) {
                    for (place, foot) in ends.into_iter().zip(inside(self.plan, &end)) {
                        feet[place] = Some(foot);
                    }
                }
            }
        }
        for place in (0..4).filter(|&place| !self.is_used(place)) {
            feet[place] = None;
        }
        feet
    }

    /// The strip at the start and at the end of the owner's half-edge.
    fn strip_ends(&self, owner: usize) -> [End; 2] {
        let half_edge = self.edge.sides[owner];
        let edge = [half_edge, half_edge.next()].map(|corner| self.plan.view.position_at(corner));
        let end = |(place, [near, far]): (f64, [usize; 2])| End {
            half_edge,
            edge,
            place,
            near: self.points[near],
            far: self.points[far],
        };
        let [start, stop] = places(owner);
        [(0.0, start), (1.0, stop)].map(end)
    }

    /// Whether some triangle has the corner.
    fn is_used(&self, place: usize) -> bool {
        match self.cut {
            Cut::Closed => false,
            Cut::OpenAtB => place != 2,
            Cut::OpenAtA => place != 3,
            Cut::FromB1 | Cut::FromA1 => true,
        }
    }

    fn flat(&self, room: Room) -> Feet {
        let places: Few<usize> = (0..4).filter(|&place| self.is_used(place)).collect();
        let points: Few<DVec3> = places.iter().map(|&place| self.points[place]).collect();
        let areas = self.cut.triangles().iter().map(|t| area_vector(t.map(|k| self.points[k])));
        let normal = unit(areas.sum());
        let frame = Frame::new(&points, points.len(), normal);
        let lay = flat_lay(self.plan, room, &frame, points.len());
        let mut feet = [None; 4];
        for (k, foot) in lay.feet.into_iter().enumerate() {
            feet[places[k]] = foot;
        }
        feet
    }

    /// Where to lay the strip flat into the owner's own triangle.
    fn own_room(&self, owner: usize) -> Room {
        Room { corner: self.edge.sides[owner], scale: 1.0 }
    }

    /// Where to lay it flat in the owner's chart.
    fn room(&self, channel: usize, owner: usize) -> Room {
        let ground = Ground::new(self.plan, channel, &self.ends[owner]);
        roomiest(self.plan, self.edge.sides[owner], channel, &ground)
    }

    /// How badly the strip lies on a channel in some way: see [`misfit`].
    fn misfit(&self, channel: usize, way: Way, feet: &Feet) -> f64 {
        let uv = |place: usize| match &feet[place] {
            Some(foot) => place_of(self.plan, channel, foot),
            None => {
                let vertex = self.attributes.vertex_at[self.corners[place]];
                self.attributes.streams.uv(vertex, channel)
            }
        };
        let uvs = [0, 1, 2, 3].map(uv);
        match way {
            Way::Own => {
                let on = |owner: usize| self.misfit_on(owner, &self.ends[owner], channel, uvs);
                let first = on(0);
                if first <= MOST_STRETCH { first } else { first.min(on(1)) }
            }
            Way::Flat(owner, room) => self.misfit_on(owner, &[room.corner], channel, uvs),
            Way::Band(owner, ..) | Way::Inside(owner) | Way::Abreast(owner) => {
                self.misfit_on(owner, &self.ends[owner], channel, uvs)
            }
        }
    }

    fn misfit_on(&self, owner: usize, at: &[Corner], channel: usize, uvs: [DVec2; 4]) -> f64 {
        let ground = Ground::new(self.plan, channel, at);
        let lie = Lie { triangles: self.cut.triangles(), points: &self.points, uvs: &uvs };
        misfit(self.plan, self.edge.sides[owner], Facing::AsFace, channel, &ground, &lie)
    }

    /// The first channel with a seam here; none of the channels where there is no seam.
    fn first_seam(&self) -> usize {
        self.edge.seams.trailing_zeros() as usize
    }

    /// Which of [`BANDS`] is the first on which the strip fits in its first channel with a seam, of
    /// those of a side; the first where nothing needs to fit.
    pub fn band(&self, owner: usize) -> Option<u8> {
        if self.edge.skipped.is_some() || self.edge.seams == 0 {
            return Some(0);
        }
        let channel = self.first_seam();
        let fits = |way: Way| {
            let feet = self.feet(way);
            self.misfit(channel, way, &feet) <= MOST_STRETCH
        };
        bands(owner).position(fits).map(|place| place as u8)
    }

    /// The feet of the first way that fits, or else of the one that fits best, among those that
    /// agree with what other channels have taken.
    fn lay(&self, channel: usize, owner: usize, taken: &Feet) -> Feet {
        let own = (self.edge.seams >> channel & 1 == 0).then_some(Way::Own);
        let ways = own.into_iter().chain(bands(owner)).chain(bands(1 - owner));
        let sides = [owner, 1 - owner];
        let along = sides.map(Way::Inside).into_iter().chain(sides.map(Way::Abreast));
        let flat = sides.map(|owner| Way::Flat(owner, self.own_room(owner)));
        let roomiest = sides.into_iter().map(|owner| Way::Flat(owner, self.room(channel, owner)));
        let mut best = (f64::INFINITY, *taken);
        let mut is_first = true;
        for way in ways.chain(along).chain(flat).chain(roomiest) {
            let feet = self.feet(way);
            let agrees = |place: usize| match (taken[place], feet[place]) {
                (Some(one), Some(other)) => one == other,
                _ => true,
            };
            if !(0..4).all(agrees) {
                continue;
            }
            let misfit = self.misfit(channel, way, &feet);
            if misfit < best.0 || is_first {
                (best, is_first) = ((misfit, feet), false);
            }
            if misfit <= MOST_STRETCH {
                break;
            }
        }
        best.1
    }
}

/// The places of the owner's corner and of the far one, at the start and at the end of its
/// half-edge.
fn places(owner: usize) -> [[usize; 2]; 2] {
    if owner == 0 { [[1, 2], [0, 3]] } else { [[3, 0], [2, 1]] }
}

/// Lays a strip into the owner's chart where its own is another, or folds or ends under the
/// chamfer.
pub fn add_strip(
    plan: &Plan,
    placement: &Placement,
    attributes: &Attributes,
    owners: &Owners,
    (edge, cut): (Edge, Cut),
    patches: &mut Patches,
) {
    let (hard, owner) = (&plan.edges.hard[edge], owners.of(edge));
    let map = StripMap::new(plan, placement, attributes, hard, cut);
    let (mut taken, mut channels): (Feet, [u8; 4]) = ([None; 4], [0; 4]);
    for channel in channels_of(plan) {
        // What the owner was chosen by need not be looked for again.
        let known = owners.band[edge].filter(|_| map.first_seam() == channel && taken == [None; 4]);
        let feet = match known {
            Some(band) => map.feet(on_band(owner, band.into())),
            None => map.lay(channel, owner, &taken),
        };
        for place in (0..4).filter(|&place| feet[place].is_some()) {
            taken[place] = feet[place];
            channels[place] |= 1 << channel;
        }
    }
    let joints = (0..4).map(|k| Joint {
        corner: map.corners[k],
        taken: taken[k].map(|place| Taken { channels: channels[k], place }),
    });
    let source = TriangleSource { kind: TriangleKind::Edge, index: edge.0 };
    let face = hard.sides[owner].triangle();
    patches.push(source, (face, 0), joints, [], cut.triangles());
}
