//! Collisions: parts of the mesh that would cut through each other, though no triangle flips.
//!
//! Only edge-connected parts that are clean in the source are kept clean: where a part cuts
//! through itself already, a chamfer across the cut has to cut as well.

use crate::ids::{IdVec, Sector};
use crate::plan::Plan;
use crate::report::Reason;

use super::cells::Cells;
use super::{Limits, apply, bad_around, blame, sectors_of, shrink};

/// Rounds in which width is given back: the rest is within an eighth of what would fit.
const GIVE_BACK_ROUNDS: usize = 3;

/// Shrinks the sectors of all that cuts, until nothing does that did not in the source, and gives
/// back what is safe.
pub fn resolve(plan: &Plan, limits: &mut Limits) {
    let parts = plan.parts();
    let free = limits.placement.share.clone();
    let mut cells = Cells::new(plan, parts);
    for part in 0..parts.len() {
        cells.enter(part, &limits.placement);
        let shrunk = shrink_cuts(plan, limits, &mut cells);
        give_back(plan, limits, &mut cells, &shrunk, &free);
    }
}

/// Shrinks until nothing in a part cuts; tells what has shrunk, in order.
fn shrink_cuts(plan: &Plan, limits: &mut Limits, cells: &mut Cells) -> Vec<Sector> {
    let mut all = Vec::new();
    for round in 0.. {
        let mut shrunk = Vec::new();
        for element in cells.new_cuts() {
            blame(plan, limits, element, Reason::Intersects, &mut shrunk);
        }
        if shrunk.is_empty() {
            break;
        }
        apply(plan, limits, round, &mut shrunk);
        let bad = bad_around(plan, &limits.placement, &shrunk);
        shrunk.extend(shrink(plan, limits, bad));
        cells.follow(&limits.placement, &shrunk);
        all.extend(shrunk);
    }
    all.sort_unstable();
    all.dedup();
    all
}

/// Bisects the shares of all sectors that lost some, together: whatever takes part in a cut goes
/// back to what was safe.
fn give_back(
    plan: &Plan,
    limits: &mut Limits,
    cells: &mut Cells,
    shrunk: &[Sector],
    free: &IdVec<Sector, f64>,
) {
    let mut tries: Vec<Try> = shrunk
        .iter()
        .map(|&sector| (sector, limits.placement.share[sector], free[sector]))
        .filter(|(_, safe, free)| safe < free)
        .map(|(sector, safe, free)| Try { sector, safe, unsafe_from: free })
        .collect();
    let sectors: Vec<Sector> = tries.iter().map(|each| each.sector).collect();
    if tries.is_empty() {
        return;
    }
    for _ in 0..GIVE_BACK_ROUNDS {
        for each in &tries {
            limits.placement.set(plan, each.sector, (each.safe + each.unsafe_from) / 2.0);
        }
        cells.follow(&limits.placement, &sectors);
        loop {
            let mut bad = cells.new_cuts();
            bad.extend(bad_around(plan, &limits.placement, &sectors));
            let mut back: Vec<Sector> = bad.iter().flat_map(|&e| sectors_of(plan, e)).collect();
            // Each once: the second time, what was safe would be taken for what was not.
            back.sort_unstable();
            back.dedup();
            back.retain(|&sector| take_back(plan, limits, &mut tries, sector));
            if back.is_empty() {
                break;
            }
            cells.follow(&limits.placement, &back);
        }
        for each in &mut tries {
            each.safe = limits.placement.share[each.sector];
        }
    }
}

/// A sector that lost some of its share: what is safe for it, and what is not.
struct Try {
    sector: Sector,
    safe: f64,
    unsafe_from: f64,
}

/// Sets a sector back to what is safe, if it has more.
fn take_back(plan: &Plan, limits: &mut Limits, tries: &mut [Try], sector: Sector) -> bool {
    let Ok(place) = tries.binary_search_by_key(&sector, |each| each.sector) else { return false };
    let (each, share) = (&mut tries[place], limits.placement.share[sector]);
    if share <= each.safe {
        return false;
    }
    each.unsafe_from = share.min(each.unsafe_from);
    limits.placement.set(plan, sector, each.safe);
    true
}
