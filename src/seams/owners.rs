//! Owners: which side's texture each strip continues.

use super::feet::is_pair;
use super::strip_map::StripMap;
use crate::attributes::Attributes;
use crate::ids::{Corner, Edge, IdVec, Triangle};
use crate::placement::Placement;
use crate::plan::Plan;
use crate::strips::Cut;

/// `#hard edges`: which of its two sides owns the chamfer.
pub struct Owners {
    pub side: IdVec<Edge, usize>,
}

/// No side yet.
const UNDECIDED: usize = usize::MAX;

/// A whole chain of edges between two smooth regions has one owner, so that the texture does not
/// zigzag: the region whose band fits more of the strips, or else the one that comes first in the
/// mesh. Where its band does not fit at all but the other side's does, an edge has the other.
pub fn owners(
    plan: &Plan,
    placement: &Placement,
    cuts: &IdVec<Edge, Cut>,
    attributes: &Attributes,
) -> Owners {
    let region = regions(plan);
    let fits = fits(plan, placement, cuts, attributes);
    let misfits = misfits(plan, &region, &fits);
    let mut side = IdVec::filled(UNDECIDED, plan.edges.hard.len());
    for edge in plan.edges.hard.ids() {
        let [one, two] = plan.edges.hard[edge].sides.map(|side| region[side.triangle()]);
        if one != two {
            let between = [one.min(two), one.max(two)];
            let found = misfits.binary_search_by_key(&between, |misfits| misfits.between);
            let [first, second] = found.map_or([0; 2], |place| misfits[place].counts);
            let lower = usize::from(two < one);
            side[edge] = if second < first { 1 - lower } else { lower };
        } else if side[edge] == UNDECIDED {
            follow_chain(plan, &region, edge, &mut side);
        }
    }
    for edge in plan.edges.hard.ids() {
        let own = side[edge];
        if !fits[edge][own] && fits[edge][1 - own] {
            side[edge] = 1 - own;
        }
    }
    Owners { side }
}

/// `#hard edges`: for each side whether the strip fits onto its band.
fn fits(
    plan: &Plan,
    placement: &Placement,
    cuts: &IdVec<Edge, Cut>,
    attributes: &Attributes,
) -> IdVec<Edge, [bool; 2]> {
    let of_edge = |edge: Edge| {
        let hard = &plan.edges.hard[edge];
        let channels = if hard.skipped.is_some() { 0 } else { hard.seams };
        if channels == 0 {
            return [true; 2];
        }
        let channel = channels.trailing_zeros() as usize;
        let map = StripMap::new(plan, placement, attributes, hard, cuts[edge]);
        [0, 1].map(|owner| map.fits(&attributes.streams, channel, owner))
    };
    plan.view.threads.map(plan.edges.hard.len(), of_edge)
}

/// How many of the strips between two regions do not fit onto the bands of the first and of the
/// second.
struct Misfits {
    /// The regions, lower first.
    between: [Triangle; 2],
    counts: [u32; 2],
}

/// For each two regions between which something does not fit, sorted.
fn misfits(
    plan: &Plan,
    region: &IdVec<Triangle, Triangle>,
    fits: &IdVec<Edge, [bool; 2]>,
) -> Vec<Misfits> {
    let of_edge = |edge: Edge| {
        let [one, two] = plan.edges.hard[edge].sides.map(|side| region[side.triangle()]);
        let lower = usize::from(two < one);
        let counts = [lower, 1 - lower].map(|side| u32::from(!fits[edge][side]));
        Misfits { between: [one.min(two), one.max(two)], counts }
    };
    let bad = plan.edges.hard.ids().filter(|&edge| fits[edge] != [true; 2]);
    let mut misfits: Vec<Misfits> = bad.map(of_edge).collect();
    misfits.sort_unstable_by_key(|misfits| misfits.between);
    misfits.dedup_by(|next, sum| {
        let is_same = next.between == sum.between;
        if is_same {
            sum.counts = [0, 1].map(|side| sum.counts[side] + next.counts[side]);
        }
        is_same
    });
    misfits
}

/// Where one region lies on both sides, the sides keep to the chain: from an edge to the next one
/// where nothing else meets them.
fn follow_chain(
    plan: &Plan,
    region: &IdVec<Triangle, Triangle>,
    start: Edge,
    side: &mut IdVec<Edge, usize>,
) {
    side[start] = 0;
    let mut front: Vec<Corner> = vec![plan.edges.hard[start].sides[0]];
    while let Some(owner) = front.pop() {
        let sectors = [owner, owner.next()].map(|corner| plan.sectors.sector_of[corner]);
        for sector in sectors.into_iter().filter(|s| s.is_some() && is_pair(plan, *s)) {
            let fan = &plan.sectors.fans[sector];
            for half_edge in [fan.first, fan.last.prev()] {
                let edge = plan.edges.chamfered_at[half_edge];
                if edge.is_none() || side[edge] != UNDECIDED {
                    continue;
                }
                let sides = plan.edges.hard[edge].sides;
                let [one, two] = sides.map(|side| region[side.triangle()]);
                if one == two {
                    side[edge] = usize::from(sides[1] == half_edge);
                    front.push(half_edge);
                }
            }
        }
    }
}

/// `#triangles`: the first triangle that can be reached without crossing a chamfered edge.
fn regions(plan: &Plan) -> IdVec<Triangle, Triangle> {
    let mut region = IdVec::filled(Triangle::NONE, plan.view.corner_count() / 3);
    let mut front = Vec::new();
    for seed in plan.view.triangles() {
        if region[seed].is_some() {
            continue;
        }
        region[seed] = seed;
        front.push(seed);
        while let Some(triangle) = front.pop() {
            for side in triangle.corners() {
                let twin = plan.topology.twin[side];
                let is_crossed = plan.edges.chamfered_at[side].is_none() && twin.is_some();
                if is_crossed && region[twin.triangle()].is_none() {
                    region[twin.triangle()] = seed;
                    front.push(twin.triangle());
                }
            }
        }
    }
    region
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::tests::plan_of;
    use crate::shapes;

    #[test]
    fn a_region_ends_at_hard_edges() {
        let cube = shapes::plain_cube(1.0);
        let region = regions(&plan_of(&cube, 0.1));
        let expected = (0..12).map(|triangle| Triangle(triangle - triangle % 2));
        assert!(region.iter().copied().eq(expected));
    }
}
