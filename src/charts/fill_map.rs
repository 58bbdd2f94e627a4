//! Fill map: how a corner fill lies on the texture.

use std::cell::OnceCell;
use std::cmp::Reverse;

use glam::{DVec2, DVec3};

use super::feet::{Frame, Lay, Room, flat_lay, is_broken, kite};
use super::fit::{Facing, Lie, MOST_STRETCH, fits, misfit};
use super::ground::{Ground, density};
use super::owners::{Owners, Spoke};
use super::{FILL_WAYS, Given, TakenAt, Way, place_of};
use crate::attributes::Taken;
use crate::ids::{Corner, Few, Ring, Sector, Triangle};
use crate::math::{area_vector, unit};
use crate::patches::Parts;
use crate::report::Blend;
use crate::surface::Surface;

/// So many places of a ring are tried as owners: where more meet, as at the tip of a huge cone, it
/// would take the square of their number.
const MOST_OWNERS: usize = 64;

/// Whether a sector has moved, whether it is convex, and how many of the strips beside it have it
/// for their owner.
type Rank = (bool, bool, usize);

const BEST_RANK: Rank = (true, true, 2);

/// A fill, and what is around it.
struct FillMap<'a> {
    given: &'a Given<'a>,
    owners: &'a Owners,
    sectors: &'a [Sector],
    fill: Parts<'a>,
    /// Those of the ring, then the middles.
    points: &'a [DVec3],
    /// The fill laid flat, once that is asked for.
    frame: OnceCell<Frame>,
}

/// Lays a fill into the chart of its owner where its own vertices are in several, or fold there;
/// gives the owner's face, and the joint whose vertex is made first.
pub fn lay_fill(
    given: &Given,
    owners: &Owners,
    (ring, fill): (Ring, Parts),
    taken: &mut Vec<TakenAt>,
) -> (Triangle, usize) {
    let sectors = given.chamfers.sectors.ring(ring);
    let point = |sector: &Sector| given.placement.point[*sector];
    let mut points: Few<DVec3> = Few::new();
    points.extend(sectors.iter().map(point));
    points.extend(fill.middles.iter().map(|middle| middle.position));
    FillMap::new((given, owners), (sectors, fill), &points).lay_into_chart(taken)
}

impl<'a> FillMap<'a> {
    fn new(
        (given, owners): (&'a Given<'a>, &'a Owners),
        (sectors, fill): (&'a [Sector], Parts<'a>),
        points: &'a [DVec3],
    ) -> FillMap<'a> {
        FillMap { given, owners, sectors, fill, points, frame: OnceCell::new() }
    }

    /// The first way, and the first owner in rank, that fits in all channels that cannot run on; or
    /// else those that fit best.
    fn lay_into_chart(&self, taken: &mut Vec<TakenAt>) -> (Triangle, usize) {
        let broken = |channel: &&usize| !self.fits_as_it_is(**channel);
        let all = self.given.channels.iter();
        let channels = all.filter(broken).fold(0, |channels, k| channels | 1 << k);
        if channels == 0 {
            return (
                self.first(first_owner(self.given, self.owners, self.sectors).0).triangle(),
                0,
            );
        }
        let mut lay = Lay::default();
        let owner = self.best_lay(channels, &mut lay);
        let middles = lay.middles.iter().copied().map(Some);
        let places = lay.feet.iter().copied().chain(middles).zip(0..);
        taken.extend(
            places.filter_map(|(place, point)| Some((point, Taken { channels, place: place? }))),
        );
        (self.first(owner).triangle(), lay.begin)
    }

    /// Lays the fill for the best owner, which it gives.
    fn best_lay(&self, channels: u8, lay: &mut Lay) -> usize {
        let first = first_owner(self.given, self.owners, self.sectors).0;
        let mut best = (self.lay(channels, FILL_WAYS[0], first, lay), FILL_WAYS[0], first);
        if best.0 <= MOST_STRETCH {
            return first;
        }
        let ranked = self.ranked();
        let ways = FILL_WAYS.into_iter();
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

    /// The places of the ring that are tried as owners, the best first.
    fn ranked(&self) -> Few<usize> {
        let places = 0..self.sectors.len();
        let mut ranked: Few<_> = places.map(|place| (Reverse(self.rank(place)), place)).collect();
        ranked.sort_unstable();
        ranked.iter().take(MOST_OWNERS).map(|&(_, place)| place).collect()
    }

    /// Lays the fill in one way, and tells how badly it lies on the worst of some channels.
    fn lay(&self, channels: u8, way: Way, owner: usize, lay: &mut Lay) -> f64 {
        self.find_feet(way, owner, lay);
        let mapped = self.given.channels.iter().filter(|channel| channels >> **channel & 1 == 1);
        mapped.map(|&channel| self.misfit(channel, owner, lay)).fold(0.0, f64::max)
    }

    fn find_feet(&self, way: Way, owner: usize, lay: &mut Lay) {
        match way {
            Way::Kite(wings) => {
                let middles = self.fill.middles.len();
                let spokes = self.owners.spokes(self.given.chamfers, self.sectors[owner]);
                let below = self.owners.feet_below(&spokes);
                kite(self.given, self.sectors, (owner, wings, middles), below, lay);
            }
            _ => *lay = self.flat(Room { corner: self.first(owner), scale: 1.0 }),
        }
    }

    fn rank(&self, place: usize) -> Rank {
        let spokes = self.owners.spokes(self.given.chamfers, self.sectors[place]);
        rank(self.given, self.sectors[place], &spokes)
    }

    fn flat(&self, room: Room) -> Lay {
        let frame = self.frame.get_or_init(|| {
            let triangles = self.fill.triangles.iter();
            let normal = triangles.map(|t| area_vector(t.map(|k| self.points[k as usize]))).sum();
            Frame::new(self.points, self.sectors.len(), unit(normal))
        });
        flat_lay(self.given.surface.view, room, frame, self.sectors.len())
    }

    fn first(&self, place: usize) -> Corner {
        self.given.chamfers.sectors.fans[self.sectors[place]].first
    }

    /// Where the output vertex of a sector lies on the texture.
    fn own_uv(&self, place: usize, channel: usize) -> DVec2 {
        self.given.own_uv(self.first(place), channel)
    }

    /// How badly the fill lies on its owner's texture: see [`misfit`].
    fn misfit(&self, channel: usize, owner: usize, lay: &Lay) -> f64 {
        let uv = |(place, foot): (usize, &Option<Blend>)| match foot {
            Some(foot) => place_of(self.given.surface.view, channel, foot),
            None => self.own_uv(place, channel),
        };
        let mut uvs = Few::new();
        uvs.extend(lay.feet.iter().enumerate().map(uv));
        uvs.extend(
            lay.middles.iter().map(|middle| place_of(self.given.surface.view, channel, middle)),
        );
        let (surface, at) = (self.given.surface, [self.first(owner)]);
        let ground = Ground::new(surface, channel, &at);
        misfit(surface.view, at[0], Facing::AsFace, channel, &ground, &self.lie(&uvs))
    }

    /// Whether it fits where its vertices are in their own charts, and these are one around the
    /// corner.
    fn fits_as_it_is(&self, channel: usize) -> bool {
        let allowed = allowed_seams(self.given, self.sectors, self.fill.middles.len());
        if has_more_seams(self.given, self.sectors, (channel, allowed)) {
            return false;
        }
        let places = 0..self.sectors.len();
        let mut uvs: Few<DVec2> = places.map(|place| self.own_uv(place, channel)).collect();
        let middles = self.fill.middles.iter();
        uvs.extend(middles.map(|middle| place_of(self.given.surface.view, channel, &middle.near)));
        let facing = self.facing(channel);
        let mut owners = 0..self.sectors.len().min(MOST_OWNERS);
        owners.any(|owner| self.fits_on(channel, owner, facing, &uvs))
    }

    /// How the fill may lie between the faces around the corner.
    fn facing(&self, channel: usize) -> Facing {
        let places = 0..self.sectors.len();
        let turn = |place| {
            density(self.given.surface.view, self.first(place).triangle(), channel)
                .partial_cmp(&0.0)
        };
        let mut turns = places.map(turn);
        let first = turns.next().flatten();
        if turns.all(|turn| turn == first) { Facing::AsFace } else { Facing::Either }
    }

    /// Whether it lies well enough on its owner's texture.
    fn fits_on(&self, channel: usize, owner: usize, facing: Facing, uvs: &[DVec2]) -> bool {
        let (surface, at) = (self.given.surface, [self.first(owner)]);
        fits(surface.view, facing, &Ground::new(surface, channel, &at), &self.lie(uvs))
    }

    fn lie<'b>(&'b self, uvs: &'b [DVec2]) -> Lie<'b> {
        Lie { triangles: self.fill.triangles, points: self.points, uvs, unsure: uvs }
    }
}

/// One seam unfolds the faces around a closed ring; around an open one, and with vertices in the middle,
/// the border does.
#[inline(always)]
pub fn allowed_seams(given: &Given, sectors: &[Sector], middles: usize) -> usize {
    let ring = given.chamfers.sectors.fans[sectors[0]].ring;
    usize::from(given.chamfers.sectors.rings[ring].closed && middles == 0)
}

/// Whether a channel breaks more often around a ring than so many times, at edges and within sectors.
#[inline(always)]
pub fn has_more_seams(
    given: &Given,
    sectors: &[Sector],
    (channel, allowed): (usize, usize),
) -> bool {
    let Given { surface, chamfers, .. } = *given;
    let mut seams = 0;
    for &sector in sectors {
        let fan = &chamfers.sectors.fans[sector];
        let edge = chamfers.edges.chamfered_at[fan.last.prev()];
        let is_at_edge = edge.is_some() && chamfers.edges.hard[edge].seams >> channel & 1 == 1;
        seams += usize::from(is_at_edge) + usize::from(is_broken(surface.view, fan, channel));
        if seams > allowed {
            return true;
        }
    }
    false
}

/// The first of a ring's places in rank, and what is beside it.
#[inline(always)]
pub fn first_owner(given: &Given, owners: &Owners, sectors: &[Sector]) -> (usize, [Spoke; 2]) {
    // Nearly always that is as good as can be.
    let spokes = owners.spokes(given.chamfers, sectors[0]);
    let rank = rank(given, sectors[0], &spokes);
    if rank == BEST_RANK { (0, spokes) } else { better_owner(given, owners, sectors, rank) }
}

#[inline(never)]
fn better_owner(
    given: &Given,
    owners: &Owners,
    sectors: &[Sector],
    first: Rank,
) -> (usize, [Spoke; 2]) {
    let mut best = (first, 0);
    for (place, &sector) in sectors.iter().enumerate().skip(1) {
        let rank = rank(given, sector, &owners.spokes(given.chamfers, sector));
        if rank > best.0 {
            best = (rank, place);
        }
        if best.0 == BEST_RANK {
            break;
        }
    }
    (best.1, owners.spokes(given.chamfers, sectors[best.1]))
}

/// How good an owner a sector is.
#[inline(always)]
fn rank(given: &Given, sector: Sector, [out, back]: &[Spoke; 2]) -> Rank {
    let Surface { view, faces, .. } = given.surface;
    let owned = usize::from(out.is_owned) + usize::from(back.is_owned);
    let at = view.position_at(out.half_edge);
    let ahead = view.position_at(out.half_edge.next()) - at;
    let behind = view.position_at(back.half_edge) - at;
    let is_convex = ahead.cross(behind).dot(faces.normal[out.half_edge.triangle()]) > 0.0;
    (given.placement.point[sector] != at, is_convex, owned)
}
