//! Fill map: how a corner fill lies on the texture.

use std::cell::OnceCell;
use std::cmp::Reverse;

use glam::{DVec2, DVec3};

use super::feet::{Frame, Lay, Room, feet_of_wings, flat_lay, is_broken, kite};
use super::fit::{Facing, Lie, MOST_STRETCH, misfit};
use super::ground::{Ground, density};
use super::owners::Owners;
use super::{FILL_WAYS, Given, TakenAt, Way, Wings, place_of};
use crate::attributes::Taken;
use crate::ids::{Corner, Edge, Few, Ring, Sector, Triangle};
use crate::math::{area_vector, unit};
use crate::patches::Parts;
use crate::report::Blend;

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
    let point = |sector: Sector| given.placement.point[sector];
    if let (&[a, b, c], []) = (sectors, fill.middles) {
        let points = [point(a), point(b), point(c)];
        let map = FillMap::new((given, owners), (sectors, fill), &points);
        return map.lay_triangle(taken).unwrap_or_else(|| map.lay_into_chart(taken));
    }
    let mut points: Few<DVec3> = Few::new();
    points.extend(sectors.iter().map(|&sector| point(sector)));
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

    /// As [`FillMap::lay_into_chart`], for three points around a corner at which the only channel has
    /// seams: nearly always the first way fits the first owner. None where it does not.
    fn lay_triangle(&self, taken: &mut Vec<TakenAt>) -> Option<(Triangle, usize)> {
        let &[channel] = self.given.channels else { return None };
        if !self.has_more_seams(channel, self.allowed_seams()) {
            return None;
        }
        let owner = self.first_owner();
        let wings = (self.sectors[owner], Wings::Far);
        let feet = feet_of_wings(self.given, wings, |side, end| self.foot_below(side, end));
        let places = [1, 2].map(|step| (owner + step) % 3);
        let mut uvs = [self.own_uv(owner, channel); 3];
        for (&place, foot) in places.iter().zip(&feet) {
            uvs[place] = place_of(self.given.surface.view, channel, foot);
        }
        if self.misfit_on(channel, owner, Facing::AsFace, &uvs) > MOST_STRETCH {
            return None;
        }
        let in_turn = if places[0] < places[1] { [0, 1] } else { [1, 0] };
        for k in in_turn {
            taken.push((places[k] as u32, Taken { channels: 1 << channel, place: feet[k] }));
        }
        Some((self.first(owner).triangle(), owner))
    }

    /// The first way, and the first owner in rank, that fits in all channels that cannot run on; or
    /// else those that fit best.
    fn lay_into_chart(&self, taken: &mut Vec<TakenAt>) -> (Triangle, usize) {
        let broken = |channel: &&usize| !self.fits_as_it_is(**channel);
        let all = self.given.channels.iter();
        let channels = all.filter(broken).fold(0, |channels, k| channels | 1 << k);
        if channels == 0 {
            return (self.first(self.first_owner()).triangle(), 0);
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
        let first = self.first_owner();
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

    /// The first of the ring's places in rank.
    fn first_owner(&self) -> usize {
        let mut best = (Rank::default(), 0);
        for place in 0..self.sectors.len() {
            let rank = self.rank(place);
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
                let below = |side, end| self.foot_below(side, end);
                kite(self.given, self.sectors, (owner, wings, middles), below, lay);
            }
            _ => *lay = self.flat(Room { corner: self.first(owner), scale: 1.0 }),
        }
    }

    /// See [`Owners::foot_below`].
    fn foot_below(&self, side: (Edge, Corner), end: usize) -> Option<Blend> {
        self.owners.foot_below(self.given.chamfers.edges, side, end)
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
        let attributes = self.given.attributes;
        attributes.streams.uv(attributes.vertex_at[self.first(place)], channel)
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
        self.misfit_on(channel, owner, Facing::AsFace, &uvs)
    }

    /// Whether it fits where its vertices are in their own charts, and these are one around the
    /// corner.
    fn fits_as_it_is(&self, channel: usize) -> bool {
        if self.has_more_seams(channel, self.allowed_seams()) {
            return false;
        }
        let places = 0..self.sectors.len();
        let mut uvs: Few<DVec2> = places.map(|place| self.own_uv(place, channel)).collect();
        let middles = self.fill.middles.iter();
        uvs.extend(middles.map(|middle| place_of(self.given.surface.view, channel, &middle.near)));
        let facing = self.facing(channel);
        let on = |owner: usize| self.misfit_on(channel, owner, facing, &uvs);
        (0..self.sectors.len().min(MOST_OWNERS)).any(|owner| on(owner) <= MOST_STRETCH)
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

    fn misfit_on(&self, channel: usize, owner: usize, facing: Facing, uvs: &[DVec2]) -> f64 {
        let corners = [self.first(owner)];
        let ground = Ground::new(self.given.surface, channel, &corners);
        let lie = Lie { triangles: self.fill.triangles, points: self.points, uvs, unsure: uvs };
        misfit(self.given.surface.view, corners[0], facing, channel, &ground, &lie)
    }

    /// One seam unfolds the faces around a closed ring; around an open one the border does.
    fn allowed_seams(&self) -> usize {
        let ring = self.given.chamfers.sectors.fans[self.sectors[0]].ring;
        usize::from(self.given.chamfers.sectors.rings[ring].closed && self.fill.middles.is_empty())
    }

    /// Whether a channel breaks more often around the ring than so many times, at edges and within sectors.
    fn has_more_seams(&self, channel: usize, allowed: usize) -> bool {
        let Given { surface, chamfers, .. } = *self.given;
        let is_at_edge = |sector: Sector| {
            let edge = chamfers.edges.chamfered_at[chamfers.sectors.fans[sector].last.prev()];
            edge.is_some() && chamfers.edges.hard[edge].seams >> channel & 1 == 1
        };
        let mut seams = 0;
        self.sectors.iter().any(|&sector| {
            let is_within = is_broken(surface.view, chamfers.sectors, sector, channel);
            seams += usize::from(is_at_edge(sector)) + usize::from(is_within);
            seams > allowed
        })
    }

    /// How good an owner a sector is.
    fn rank(&self, place: usize) -> Rank {
        let Given { surface, chamfers, .. } = *self.given;
        let sector = self.sectors[place];
        let fan = &chamfers.sectors.fans[sector];
        let owns = |side: &Corner| {
            let edge: Edge = chamfers.edges.chamfered_at[*side];
            edge.is_some() && chamfers.edges.hard[edge].sides[self.owners.of(edge)] == *side
        };
        let owned = [fan.first, fan.last.prev()].iter().filter(|side| owns(side)).count();
        let at = self.given.placement.base(sector);
        let first = surface.view.position_at(fan.first.next()) - at;
        let last = surface.view.position_at(fan.last.prev()) - at;
        let is_convex = first.cross(last).dot(surface.faces.normal[fan.first.triangle()]) > 0.0;
        (self.given.placement.has_moved(sector), is_convex, owned)
    }
}

#[cfg(test)]
mod tests {
    use super::super::{channels_of, owners::owners};
    use super::*;
    use crate::shapes;
    use crate::stages::stages_of;
    use crate::watch::{Unwatched, Watch};

    #[test]
    fn a_triangle_is_laid_as_any_other_fill() {
        let mut laid = 0;
        let cube = ("cube", shapes::cube(1.0));
        for (name, mesh) in shapes::demo_models().into_iter().chain([cube]) {
            let stages = stages_of(&mesh, 0.01);
            let placement = stages.placement();
            let (patches, attributes) = (stages.patches(&placement), stages.attributes(&placement));
            let channels: Few<usize> = channels_of(&stages.view).collect();
            let given = Given {
                surface: stages.surface(),
                chamfers: stages.chamfers(),
                placement: &placement,
                attributes: &attributes,
                channels: &channels,
            };
            let work = (&stages.threads, &Unwatched as &dyn Watch);
            let owners = &owners(&given, &patches, work).unwrap();
            for ring in stages.sectors.rings.ids() {
                let (sectors, fill) = (stages.sectors.ring(ring), patches.fill(ring));
                if sectors.len() != 3 || fill.triangles.is_empty() {
                    continue;
                }
                let points: Few<DVec3> = sectors.iter().map(|&at| placement.point[at]).collect();
                let map = FillMap::new((&given, owners), (sectors, fill), &points);
                let (mut quickly, mut taken) = (Vec::new(), Vec::new());
                let Some(face) = map.lay_triangle(&mut quickly) else { continue };
                assert_eq!(face, map.lay_into_chart(&mut taken), "{name}");
                assert_eq!(quickly, taken, "{name}");
                laid += 1;
            }
        }
        assert!(laid > 8, "those of the cube and more, but {laid}");
    }
}
