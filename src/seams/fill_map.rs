//! Fill map: how a corner fill lies on the texture.

use std::cell::OnceCell;
use std::cmp::Reverse;

use glam::{DVec2, DVec3};

use super::density::density;
use super::feet::{Frame, Lay, Room, Wings, flat_lay, is_broken, kite};
use super::fit::{Facing, Lie, MOST_STRETCH, misfit, roomiest};
use super::ground::Ground;
use super::patch::{Joint, Middle, Patches};
use super::{Owners, channels_of, place_of};
use crate::attributes::{Attributes, Taken, middles};
use crate::fills::{Fill, middle};
use crate::ids::{Corner, Edge, Few, Ring, Sector};
use crate::math::{area_vector, unit};
use crate::placement::{Placement, base};
use crate::plan::Plan;
use crate::report::{Blend, TriangleKind, TriangleSource};

/// A way to lay a fill into the chart of its owner.
#[derive(Clone, Copy, Debug)]
enum Way {
    Kite(Wings),
    /// Into the triangle at the owner's first corner.
    Corner,
    /// Into the triangle of the owner's chart that has the most room in a channel.
    Roomiest(usize),
}

/// The ways to lay a fill into what its chart leaves free at the corner, best first.
const WAYS: [Way; 5] = [
    Way::Kite(Wings::Far),
    Way::Kite(Wings::Near(1.0)),
    Way::Kite(Wings::Near(2.0)),
    Way::Kite(Wings::Near(4.0)),
    Way::Corner,
];

/// So many places of a ring are tried as owners: where more meet, as at the tip of a huge cone, it
/// would take the square of their number.
const MOST_OWNERS: usize = 64;

/// Whether a sector has moved, whether it is convex, and how many of the strips beside it have it
/// for their owner.
type Rank = (bool, bool, usize);

const BEST_RANK: Rank = (true, true, 2);

/// A fill, and what is around it.
struct FillMap<'a> {
    plan: &'a Plan<'a>,
    placement: &'a Placement,
    attributes: &'a Attributes,
    sectors: &'a [Sector],
    fill: &'a Fill,
    /// Those of the ring, then the middles.
    points: Few<DVec3>,
    /// The fill laid flat, once that is asked for.
    frame: OnceCell<Frame>,
}

/// Lays a fill into the chart of its owner where its own vertices are in several, or fold there.
pub fn add_fill(
    plan: &Plan,
    placement: &Placement,
    attributes: &Attributes,
    owners: &Owners,
    (ring, fill): (Ring, &Fill),
    patches: &mut Patches,
) {
    let sectors = plan.sectors.ring(ring);
    let (points, frame) = (Few::new(), OnceCell::new());
    let mut map = FillMap { plan, placement, attributes, sectors, fill, points, frame };
    map.points.extend(sectors.iter().map(|&sector| placement.point[sector]));
    for places in &fill.middles {
        let middle = middle(&map.points[..sectors.len()], places);
        map.points.push(middle);
    }
    map.add(owners, patches);
}

impl FillMap<'_> {
    /// The first way, and the first owner in rank, that fits in all channels that cannot run on; or
    /// else those that fit best.
    fn add(&self, owners: &Owners, patches: &mut Patches) {
        let broken = |channel: &usize| !self.fits_as_it_is(*channel);
        let all = channels_of(self.plan);
        let channels = all.filter(broken).fold(0, |channels, k| channels | 1 << k);
        let mut lay = Lay::default();
        let owner = self.best_lay(channels, owners, &mut lay);
        let taken = |place: Blend| (channels != 0).then_some(Taken { channels, place });
        let joints = lay
            .feet
            .iter()
            .enumerate()
            .map(|(place, foot)| Joint { corner: self.first(place), taken: foot.and_then(taken) });
        let middles = self.fill.middles.iter().zip(&lay.middles);
        let middles =
            middles.map(|(joints, &place)| Middle { joints: joints.clone(), taken: taken(place) });
        let at = self.plan.view.vertex_at(self.first(0));
        let source = TriangleSource { kind: TriangleKind::Corner, index: at.0 };
        let face = self.first(owner).triangle();
        patches.push(source, (face, lay.begin as u32), joints, middles, &self.fill.triangles);
    }

    /// Lays the fill for the best owner, which it gives.
    fn best_lay(&self, channels: u8, owners: &Owners, lay: &mut Lay) -> usize {
        let first = self.first_owner(owners);
        let mut best = (self.lay(channels, WAYS[0], first, lay), WAYS[0], first);
        if best.0 <= MOST_STRETCH {
            return first;
        }
        let ranked = self.ranked(owners);
        let elsewhere = Way::Roomiest(channels.trailing_zeros() as usize);
        let ways = WAYS.into_iter().chain([elsewhere]);
        for (way, &owner) in ways.flat_map(|way| ranked.iter().map(move |at| (way, at))) {
            let misfit = self.lay(channels, way, owner, lay);
            if misfit <= MOST_STRETCH {
                return owner;
            }
            if misfit < best.0 {
                best = (misfit, way, owner);
            }
        }
        let (_, way, owner) = best;
        self.lay(channels, way, owner, lay);
        owner
    }

    /// The first of the ring's places in rank.
    fn first_owner(&self, owners: &Owners) -> usize {
        let mut best = (Rank::default(), 0);
        for place in 0..self.sectors.len() {
            let rank = self.rank(place, owners);
            if rank > best.0 {
                best = (rank, place);
            }
            if best.0 == BEST_RANK {
                break;
            }
        }
        best.1
    }

    /// The places of the ring that are tried as owners, the best first.
    fn ranked(&self, owners: &Owners) -> Few<usize> {
        let places = 0..self.sectors.len();
        let mut ranked: Few<_> =
            places.map(|place| (Reverse(self.rank(place, owners)), place)).collect();
        ranked.sort_unstable();
        ranked.iter().take(MOST_OWNERS).map(|&(_, place)| place).collect()
    }

    /// Lays the fill in one way, and tells how badly it lies on the worst of some channels.
    fn lay(&self, channels: u8, way: Way, owner: usize, lay: &mut Lay) -> f64 {
        self.find_feet(way, owner, lay);
        let mapped = channels_of(self.plan).filter(|channel| channels >> channel & 1 == 1);
        mapped.map(|channel| self.misfit(channel, owner, way, lay)).fold(0.0, f64::max)
    }

    fn find_feet(&self, way: Way, owner: usize, lay: &mut Lay) {
        match way {
            Way::Kite(wings) => {
                let middles = self.fill.middles.len();
                kite(self.plan, self.placement, self.sectors, (owner, wings, middles), lay);
            }
            Way::Corner => {
                *lay = self.flat(Room { corner: self.first(owner), scale: 1.0 });
            }
            Way::Roomiest(channel) => *lay = self.flat(self.roomiest(owner, channel)),
        }
    }

    /// Where to lay the fill flat in its owner's chart.
    fn roomiest(&self, owner: usize, channel: usize) -> Room {
        let corners = [self.first(owner)];
        let ground = Ground::new(self.plan, channel, &corners);
        roomiest(self.plan, corners[0], channel, &ground)
    }

    fn flat(&self, room: Room) -> Lay {
        let frame = self.frame.get_or_init(|| {
            let triangles = self.fill.triangles.iter();
            let normal = triangles.map(|t| area_vector(t.map(|k| self.points[k]))).sum();
            Frame::new(&self.points, self.sectors.len(), unit(normal))
        });
        flat_lay(self.plan, room, frame, self.sectors.len())
    }

    fn first(&self, place: usize) -> Corner {
        self.plan.sectors.fans[self.sectors[place]].first
    }

    /// Where the output vertex of a sector lies on the texture.
    fn own_uv(&self, place: usize, channel: usize) -> DVec2 {
        self.attributes.streams.uv(self.attributes.vertex_at[self.first(place)], channel)
    }

    /// How badly the fill lies on its owner's texture: see [`misfit`].
    fn misfit(&self, channel: usize, owner: usize, way: Way, lay: &Lay) -> f64 {
        let uv = |(place, foot): (usize, &Option<Blend>)| match foot {
            Some(foot) => place_of(self.plan, channel, foot),
            None => self.own_uv(place, channel),
        };
        let mut uvs = Few::new();
        uvs.extend(lay.feet.iter().enumerate().map(uv));
        uvs.extend(lay.middles.iter().map(|middle| place_of(self.plan, channel, middle)));
        let at = match way {
            Way::Roomiest(channel) => self.roomiest(owner, channel).corner,
            Way::Kite(_) | Way::Corner => self.first(owner),
        };
        self.misfit_on(channel, owner, at, Facing::AsFace, &uvs)
    }

    /// Whether it fits where its vertices are in their own charts, and these are one around the
    /// corner.
    fn fits_as_it_is(&self, channel: usize) -> bool {
        if self.seams(channel) > self.allowed_seams() {
            return false;
        }
        let places = 0..self.sectors.len();
        let mut uvs: Few<DVec2> = places.map(|place| self.own_uv(place, channel)).collect();
        let middle = |&at: &DVec3| -> Blend { middles::nearest(self.plan, self.sectors, at) };
        let middles = self.points[self.sectors.len()..].iter().map(middle);
        uvs.extend(middles.map(|blend| place_of(self.plan, channel, &blend)));
        let facing = self.facing(channel);
        let on = |owner: usize| self.misfit_on(channel, owner, self.first(owner), facing, &uvs);
        (0..self.sectors.len().min(MOST_OWNERS)).any(|owner| on(owner) <= MOST_STRETCH)
    }

    /// How the fill may lie between the faces around the corner.
    fn facing(&self, channel: usize) -> Facing {
        let places = 0..self.sectors.len();
        let turn =
            |place| density(self.plan, self.first(place).triangle(), channel).partial_cmp(&0.0);
        let mut turns = places.map(turn);
        let first = turns.next().flatten();
        if turns.all(|turn| turn == first) { Facing::AsFace } else { Facing::Either }
    }

    fn misfit_on(
        &self,
        channel: usize,
        owner: usize,
        at: Corner,
        facing: Facing,
        uvs: &[DVec2],
    ) -> f64 {
        let corners = [at];
        let ground = Ground::new(self.plan, channel, &corners);
        let lie = Lie { triangles: &self.fill.triangles, points: &self.points, uvs };
        misfit(self.plan, self.first(owner), facing, channel, &ground, &lie)
    }

    /// One seam unfolds the faces around a closed ring; around an open one the border does.
    fn allowed_seams(&self) -> usize {
        let ring = self.plan.sectors.fans[self.sectors[0]].ring;
        usize::from(self.plan.sectors.rings[ring].closed && self.fill.middles.is_empty())
    }

    /// How often a channel breaks around the ring, at edges and within sectors.
    fn seams(&self, channel: usize) -> usize {
        let plan = self.plan;
        let breaks = |&sector: &Sector| {
            let edge = plan.edges.chamfered_at[plan.sectors.fans[sector].last.prev()];
            let at_edge = edge.is_some() && plan.edges.hard[edge].seams >> channel & 1 == 1;
            usize::from(at_edge) + usize::from(is_broken(plan, sector, channel))
        };
        self.sectors.iter().map(breaks).sum()
    }

    /// How good an owner a sector is.
    fn rank(&self, place: usize, owners: &Owners) -> Rank {
        let plan = self.plan;
        let sector = self.sectors[place];
        let fan = &plan.sectors.fans[sector];
        let owns = |side: &Corner| {
            let edge: Edge = plan.edges.chamfered_at[*side];
            edge.is_some() && plan.edges.hard[edge].sides[owners.of(edge)] == *side
        };
        let owned = [fan.first, fan.last.prev()].iter().filter(|side| owns(side)).count();
        let at = base(plan, sector);
        let first = plan.view.position_at(fan.first.next()) - at;
        let last = plan.view.position_at(fan.last.prev()) - at;
        let is_convex = first.cross(last).dot(plan.faces.normal[fan.first.triangle()]) > 0.0;
        (self.placement.has_moved(plan, sector), is_convex, owned)
    }
}
