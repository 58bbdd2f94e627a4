//! Owners: which side's texture each strip continues.

use super::feet::is_pair;
use super::strip_map::{Band, StripMap};
use super::sure_strip::sure_band;
use super::{Given, Spread};
use crate::chamfers::Chamfers;
use crate::edges::Edges;
use crate::error::Error;
use crate::ids::{Corner, Edge, IdVec, Patch, Sector, Triangle};
use crate::patches::Patches;
use crate::report::Blend;
use crate::surface::Surface;
use crate::threads::Threads;
use crate::watch::{STEPS, Watch};

/// Who owns the chamfers.
pub struct Owners {
    /// `#hard edges`: which of its two sides.
    side: IdVec<Edge, u8>,
    /// `#hard edges`: how the strip fits onto that side's band: see [`StripMap::band`].
    pub band: IdVec<Edge, Option<Band>>,
}

impl Owners {
    /// Which of a hard edge's sides owns its chamfer.
    pub fn of(&self, edge: Edge) -> usize {
        self.side[edge].into()
    }

    /// What is beside a sector.
    #[inline(always)]
    pub fn spokes(&self, chamfers: Chamfers, sector: Sector) -> [Spoke; 2] {
        let fan = &chamfers.sectors.fans[sector];
        let edges = chamfers.edges;
        [self.spoke(edges, fan.first), self.spoke(edges, fan.last.prev())]
    }

    #[inline(always)]
    fn spoke(&self, edges: &Edges, half_edge: Corner) -> Spoke {
        let edge = edges.chamfered_at[half_edge];
        let is_owned = edge.is_some() && edges.hard[edge].sides[self.of(edge)] == half_edge;
        Spoke { half_edge, edge, is_owned }
    }

    /// Where the strips of a sector's two edges have their far corners, if they belong to its side and
    /// lie below themselves there.
    #[inline(always)]
    pub fn feet_below(&self, [out, back]: &[Spoke; 2]) -> [Option<Blend>; 2] {
        [self.foot_below(out, 0), self.foot_below(back, 1)]
    }

    #[inline(always)]
    fn foot_below(&self, spoke: &Spoke, end: usize) -> Option<Blend> {
        let band = if spoke.is_owned { self.band[spoke.edge].as_ref()? } else { return None };
        if band.spread == Spread::Far { band.far[end] } else { None }
    }
}

/// One of the two half-edges that a sector lies between: out of its corner, or back to it.
#[derive(Clone, Copy)]
pub struct Spoke {
    pub half_edge: Corner,
    /// None where it is not chamfered.
    pub edge: Edge,
    /// Whether the chamfer there has this side for its owner.
    pub is_owned: bool,
}

/// No side yet.
const UNDECIDED: u8 = u8::MAX;

/// A whole chain of edges between two smooth regions has one owner, so that the texture does not
/// zigzag: the region whose band fits more of the strips, or else the one that comes first in the
/// mesh. Where its band does not fit at all but the other side's does, an edge has the other.
///
/// # Errors
/// [`Error::Cancelled`] where the watch stops it.
pub fn owners(
    given: &Given,
    patches: &Patches,
    (threads, watch): (&Threads, &dyn Watch),
) -> Result<Owners, Error> {
    let Given { surface, chamfers, .. } = *given;
    let band = |edge: Edge, side: u8| {
        let hard = &chamfers.edges.hard[edge];
        if hard.skipped.is_some() || hard.seams == 0 {
            return Some(Band::ANY);
        }
        let triangles = patches.triangles(Patch(edge.0));
        let any_band = || StripMap::new(given, hard, triangles).band(side.into());
        sure_band(given, (hard, triangles), side.into()).or_else(any_band)
    };
    let region = regions(surface, chamfers.edges, watch)?;
    let side = sides_in_order(chamfers, &region);
    let own = threads.map(side.len(), watch, |edge| band(edge, side[edge]))?;
    let mut owners = Owners { side, band: own };
    let contested = contested(chamfers.edges, &region, &owners.band);
    let claims = threads.map_each(&contested, watch, |&(between, edge)| Claim {
        between,
        edge,
        own: owners.band[edge],
        other: band(edge, 1 - owners.side[edge]),
    })?;
    settle(&claims, &mut owners);
    Ok(owners)
}

/// The region that comes first in the mesh, or the side that the chain keeps to.
fn sides_in_order(chamfers: Chamfers, region: &IdVec<Triangle, Triangle>) -> IdVec<Edge, u8> {
    let mut side = IdVec::filled(UNDECIDED, chamfers.edges.hard.len());
    for edge in chamfers.edges.hard.ids() {
        let [one, two] = chamfers.edges.hard[edge].sides.map(|side| region[side.triangle()]);
        if one != two {
            side[edge] = u8::from(two < one);
        } else if side[edge] == UNDECIDED {
            follow_chain(chamfers, region, edge, &mut side);
        }
    }
    side
}

/// All edges between two regions that have a strip between them that does not fit, sorted by
/// regions, of which the lower stands first.
fn contested(
    edges: &Edges,
    region: &IdVec<Triangle, Triangle>,
    band: &IdVec<Edge, Option<Band>>,
) -> Vec<([Triangle; 2], Edge)> {
    let between = |edge: Edge| {
        let [one, two] = edges.hard[edge].sides.map(|side| region[side.triangle()]);
        [one.min(two), one.max(two)]
    };
    let mut bad: Vec<_> = band.ids().filter(|&edge| band[edge].is_none()).map(between).collect();
    if bad.is_empty() {
        return Vec::new();
    }
    bad.sort_unstable();
    bad.dedup();
    let all = band.ids().map(|edge| (between(edge), edge));
    let mut contested: Vec<_> =
        all.filter(|(between, _)| bad.binary_search(between).is_ok()).collect();
    contested.sort_unstable();
    contested
}

/// How a contested edge's strip fits onto the bands of the side that has it, and of the other.
struct Claim {
    between: [Triangle; 2],
    edge: Edge,
    own: Option<Band>,
    other: Option<Band>,
}

/// Gives the edges between two regions to the other one where fewer of them do not fit, and single
/// edges to the side that alone they fit.
fn settle(claims: &[Claim], owners: &mut Owners) {
    for between in claims.chunk_by(|one, next| one.between == next.between) {
        let misfits =
            |fits: fn(&Claim) -> bool| between.iter().filter(|claim| !fits(claim)).count();
        let [one, two] = between[0].between;
        let [own, other] =
            [misfits(|claim| claim.own.is_some()), misfits(|claim| claim.other.is_some())];
        let is_lost = one != two && other < own;
        for claim in between {
            let changes = match (claim.own, claim.other) {
                (None, Some(_)) => true,
                (Some(_), None) => false,
                _ => is_lost,
            };
            if changes {
                owners.side[claim.edge] = 1 - owners.side[claim.edge];
                owners.band[claim.edge] = claim.other;
            }
        }
    }
}

/// Where one region lies on both sides, the sides keep to the chain: from an edge to the next one
/// where nothing else meets them.
fn follow_chain(
    chamfers: Chamfers,
    region: &IdVec<Triangle, Triangle>,
    start: Edge,
    side: &mut IdVec<Edge, u8>,
) {
    side[start] = 0;
    let mut front: Vec<Corner> = vec![chamfers.edges.hard[start].sides[0]];
    while let Some(owner) = front.pop() {
        let sectors = [owner, owner.next()].map(|corner| chamfers.sectors.sector_of[corner]);
        for sector in sectors.into_iter().filter(|s| s.is_some() && is_pair(chamfers.sectors, *s)) {
            let fan = &chamfers.sectors.fans[sector];
            for half_edge in [fan.first, fan.last.prev()] {
                let edge = chamfers.edges.chamfered_at[half_edge];
                if edge.is_none() || side[edge] != UNDECIDED {
                    continue;
                }
                let sides = chamfers.edges.hard[edge].sides;
                let [one, two] = sides.map(|side| region[side.triangle()]);
                if one == two {
                    side[edge] = u8::from(sides[1] == half_edge);
                    front.push(half_edge);
                }
            }
        }
    }
}

/// `#triangles`: the first triangle that can be reached without crossing a chamfered edge.
fn regions(
    surface: Surface,
    edges: &Edges,
    watch: &dyn Watch,
) -> Result<IdVec<Triangle, Triangle>, Error> {
    let mut region = IdVec::filled(Triangle::NONE, surface.view.corner_count() / 3);
    let (mut front, mut reached) = (Vec::new(), 0_usize);
    for seed in surface.view.triangles() {
        if region[seed].is_some() {
            continue;
        }
        region[seed] = seed;
        front.push(seed);
        while let Some(triangle) = front.pop() {
            reached += 1;
            if reached.is_multiple_of(STEPS) {
                watch.worked(STEPS)?;
            }
            for side in triangle.corners() {
                let twin = surface.topology.twin[side];
                let is_crossed = edges.chamfered_at[side].is_none() && twin.is_some();
                if is_crossed && region[twin.triangle()].is_none() {
                    region[twin.triangle()] = seed;
                    front.push(twin.triangle());
                }
            }
        }
    }
    Ok(region)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes;
    use crate::stages::stages_of;
    use crate::watch::Unwatched;

    #[test]
    fn a_region_ends_at_hard_edges() {
        let cube = shapes::plain_cube(1.0);
        let region = {
            let stages = stages_of(&cube, 0.1);
            regions(stages.surface(), &stages.edges, &Unwatched).unwrap()
        };
        let expected = (0..12).map(|triangle| Triangle(triangle - triangle % 2));
        assert!(region.iter().copied().eq(expected));
    }
}
