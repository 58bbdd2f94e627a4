//! Limits: how much of its offset each sector may take.
//!
//! Full offsets overlap wherever a feature is narrower than the chamfer, so each sector is limited
//! by what happens around it, and by nothing else: bound it by the room that its own triangles
//! leave, build strips and fills, shrink the sectors of whatever fails, and give back what is safe.
//! A ring that still fails keeps its old position, so the result is never worse than the source.

mod collisions;
mod crowds;
mod elements;
mod valid;

use std::borrow::Cow;
use std::cmp::{Ordering, Reverse};

use crate::error::Error;
use crate::given::Given;
use crate::ids::{Id, IdVec, Ring, Sector};
use crate::offsets::{Offset, narrow};
use crate::options::Verify;
use crate::placement::Placement;
use crate::report::Reason;
use crate::watch::{Watch, collect, each_of, sort, stretches};

pub use elements::Element;

use elements::{around, elements_of, sectors_of};
use valid::{bad_elements, contacts_are_kept, is_valid};

/// How much a sector that takes part in something bad keeps in each round.
const SHRINK: f64 = 0.5;

/// After so many rounds a share is down to a sixteenth. A ring that is still bad then gets the same
/// share for all its sectors, which keeps its shape; if that is bad as well, no offset at all.
const SHRINK_ROUNDS: usize = 4;

/// Steps of bisection when width is given back: the rest is within 2 % of what would fit.
const GROW_STEPS: usize = 6;

/// A neighbour's growth can make room, or take it: twice around settles nearly everything.
const GROW_PASSES: usize = 2;

/// Every try of one sector looks at the fill of its whole ring: in a longer one, growing each would
/// take quadratic time.
const LONGEST_GROWN: usize = 64;

/// Each try looks at a dozen elements, most of them at once.
const STEPS_OF_GROWTH: usize = 64;

/// What each sector gets.
pub struct Limits<'a> {
    pub placement: Placement<'a>,
    /// `#sectors`: why it did not get all.
    pub reason: IdVec<Sector, Reason>,
}

/// The most that is sound, up to the room that each sector has (`room: #sectors`).
///
/// # Errors
/// [`Error::OutOfMemory`] where what collisions need is not to be had, and [`Error::Cancelled`]
/// where the watch stops it.
pub fn limits<'a>(
    given: &Given<'a>,
    room: &IdVec<Sector, f64>,
    verify: Verify,
    watch: &dyn Watch,
) -> Result<Limits<'a>, Error> {
    let mut limits = bounded(given, room, watch)?;
    let bad = bad_elements(given, &limits.placement, watch)?;
    let mut shrunk = shrink(given, &mut limits, bad, watch)?;
    sort(&mut shrunk, watch)?;
    shrunk.dedup();
    for _ in 0..GROW_PASSES {
        grow(given, room, &mut limits, &shrunk, watch)?;
    }
    let room = &mut Cow::Borrowed(room);
    take_back(given, room, &mut limits, watch)?;
    give_way(given, room, &mut limits, &shrunk, watch)?;
    if verify != Verify::Fast {
        collisions::resolve(given, &mut limits, watch)?;
    }
    Ok(limits)
}

/// What cuts where strips and fills are rounded gets less so: see [`collisions::lessen_cuts`].
///
/// # Errors
/// [`Error::OutOfMemory`] where what collisions need is not to be had, and [`Error::Cancelled`]
/// where the watch stops it.
pub fn lessen_cuts<S: Sync>(
    given: &Given,
    placement: &Placement,
    (state, rounded): (&mut S, &collisions::Rounded<S>),
    watch: &dyn Watch,
    lessen: impl FnMut(&mut S, &[Element]) -> Result<bool, Error>,
) -> Result<(), Error> {
    collisions::lessen_cuts(given, placement, state, rounded, watch, lessen)
}

/// Every sector at the width that its own triangles leave room for.
fn bounded<'a>(
    given: &Given<'a>,
    shares: &IdVec<Sector, f64>,
    watch: &dyn Watch,
) -> Result<Limits<'a>, Error> {
    let reason = |sector: Sector| {
        let is_narrow = shares[sector] < 1.0 && given.offsets[sector].moves();
        if is_narrow { Reason::NoRoom } else { Reason::None }
    };
    Ok(Limits {
        placement: given.placement(shares.clone(), watch)?,
        reason: given.threads.map(shares.len(), watch, reason)?,
    })
}

/// Shrinks what is bad, and then what is bad around what has shrunk; tells all that has.
fn shrink(
    given: &Given,
    limits: &mut Limits,
    mut bad: Vec<Element>,
    watch: &dyn Watch,
) -> Result<Vec<Sector>, Error> {
    let mut all = Vec::new();
    for round in 0.. {
        let mut shrunk = Vec::new();
        let reason = |element| (why(given, &limits.placement, element), element);
        watch.worked(bad.len())?;
        let mut blamed: Vec<(Reason, Element)> = bad.into_iter().map(reason).collect();
        // The last one is told: by what it is, not by who has the largest number.
        blamed.sort_by_key(|(reason, _)| *reason);
        for (reason, element) in blamed {
            blame(given, limits, element, reason, &mut shrunk);
        }
        if shrunk.is_empty() {
            break;
        }
        apply(given, limits, round, &mut shrunk);
        bad = bad_around(given, &limits.placement, &shrunk, watch)?;
        all.extend(shrunk);
    }
    Ok(all)
}

/// Why a bad element is bad.
fn why(given: &Given, placement: &Placement, element: Element) -> Reason {
    match element {
        Element::Surface(_) => Reason::NoRoom,
        Element::Strip(edge) if !contacts_are_kept(given, placement, edge) => Reason::Contact,
        Element::Strip(_) | Element::Fill(_) | Element::Flap(_) => Reason::Folds,
    }
}

/// All that depends on the sectors and is bad.
fn bad_around(
    given: &Given,
    placement: &Placement,
    sectors: &[Sector],
    watch: &dyn Watch,
) -> Result<Vec<Element>, Error> {
    let (suspects, mut bad) = (around(given, sectors, watch)?, Vec::new());
    for stretch in stretches(suspects.len(), watch) {
        let suspects = suspects[stretch?].iter().copied();
        bad.extend(suspects.filter(|&element| !is_valid(given, placement, element)));
    }
    Ok(bad)
}

/// Shrinks sectors, each once; after some rounds together with their whole rings: to one share for
/// all, and then to nothing.
fn apply(given: &Given, limits: &mut Limits, round: usize, shrunk: &mut Vec<Sector>) {
    shrunk.sort_unstable();
    shrunk.dedup();
    if round >= SHRINK_ROUNDS {
        spread_over_rings(given, limits, shrunk);
    }
    let mut least = (Ring::NONE, 0.0);
    for &sector in shrunk.iter() {
        let share = limits.placement.share[sector];
        let smaller = match round.cmp(&SHRINK_ROUNDS) {
            Ordering::Less => share * SHRINK,
            Ordering::Equal => {
                // They come ring by ring. Anew for each sector, a large ring would take quadratic
                // time.
                let ring = given.chamfers.sectors.fans[sector].ring;
                if least.0 != ring {
                    least = (ring, least_in_ring(given, &limits.placement, ring));
                }
                least.1
            }
            Ordering::Greater => 0.0,
        };
        limits.placement.set(sector, smaller);
    }
}

/// The smallest share in a ring, of those that moved.
fn least_in_ring(given: &Given, placement: &Placement, ring: Ring) -> f64 {
    let shares = given.chamfers.sectors.ring(ring).iter().map(|&sector| placement.share[sector]);
    shares.filter(|&share| share > 0.0).fold(1.0, f64::min)
}

/// Adds to the sectors all others of their rings that have moved, for the same reason.
fn spread_over_rings(given: &Given, limits: &mut Limits, shrunk: &mut Vec<Sector>) {
    let mut rings: Vec<(Ring, Reason)> = shrunk
        .iter()
        .map(|&sector| (given.chamfers.sectors.fans[sector].ring, limits.reason[sector]))
        .collect();
    rings.sort_unstable();
    rings.dedup_by_key(|(ring, _)| *ring);
    shrunk.clear();
    for (ring, reason) in rings {
        for &sector in given.chamfers.sectors.ring(ring) {
            if limits.placement.share[sector] > 0.0 {
                limits.reason[sector] = reason;
                shrunk.push(sector);
            }
        }
    }
}

/// Notes the sectors that a bad element depends on.
fn blame(
    given: &Given,
    limits: &mut Limits,
    element: Element,
    reason: Reason,
    shrunk: &mut Vec<Sector>,
) {
    for sector in sectors_of(given, element) {
        if limits.placement.share[sector] > 0.0 {
            limits.reason[sector] = reason;
            shrunk.push(sector);
        }
    }
}

/// Gives back to every one of some sectors that was shrunk, up to its room, as much as it can take with all
/// others where they are.
fn grow(
    given: &Given,
    room: &IdVec<Sector, f64>,
    limits: &mut Limits,
    sectors: &[Sector],
    watch: &dyn Watch,
) -> Result<(), Error> {
    for sector in in_turn(given, room, &limits.placement, sectors, watch)? {
        watch.worked(STEPS_OF_GROWTH)?;
        let (mut good, mut bad) = (limits.placement.share[sector], room[sector]);
        let mut found = obstacle(given, &mut limits.placement, sector, bad, None);
        if found.is_none() {
            limits.reason[sector] = if bad < 1.0 { Reason::NoRoom } else { Reason::None };
            continue;
        }
        for _ in 0..GROW_STEPS {
            let middle = (good + bad) / 2.0;
            match obstacle(given, &mut limits.placement, sector, middle, found) {
                None => good = middle,
                other => (bad, found) = (middle, other),
            }
        }
        limits.placement.set(sector, good);
    }
    Ok(())
}

/// Of a sector that would fold, whose fronts are unlike, first the wider one gives way, down to where
/// it is as wide as the other: else both would shrink, and the narrower one far below what its edge has
/// elsewhere. Then all around is settled once more.
fn give_way(
    given: &Given,
    room: &mut Cow<IdVec<Sector, f64>>,
    limits: &mut Limits,
    shrunk: &[Sector],
    watch: &dyn Watch,
) -> Result<(), Error> {
    watch.worked(shrunk.len())?;
    let folds = |sector: &Sector| limits.reason[*sector] == Reason::Folds;
    let folding: Vec<Sector> = shrunk.iter().copied().filter(folds).collect();
    let mut away = Vec::new();
    each_of(&folding, watch, |&sector| {
        away.extend(turned_away(given, room, &limits.placement, sector));
    })?;
    let turned = settle(given, room, limits, &away, watch)?;
    turned.into_iter().for_each(|sector| limits.reason[sector] = Reason::Folds);
    Ok(())
}

/// Where a run of sectors that gathers for the sake of [vanishing](crate::vanishing) edges would
/// fold, it goes straight on instead, as far as these leave it.
fn take_back(
    given: &Given,
    room: &mut Cow<IdVec<Sector, f64>>,
    limits: &mut Limits,
    watch: &dyn Watch,
) -> Result<(), Error> {
    let mut back = Vec::new();
    each_of(&given.vanishing.runs, watch, |run| {
        let share = |sector: Sector| run.share.min(room[sector]);
        let folds = |&(sector, _): &(Sector, Offset)| {
            limits.reason[sector] == Reason::Folds && limits.placement.share[sector] < share(sector)
        };
        if run.members.iter().any(folds) {
            back.extend(
                run.members.iter().map(|&(sector, offset)| (sector, offset, share(sector))),
            );
        }
    })?;
    settle(given, room, limits, &back, watch)?;
    Ok(())
}

/// Gives sectors other offsets, of which each gets a share at most, and settles all around once more.
fn settle(
    given: &Given,
    room: &mut Cow<IdVec<Sector, f64>>,
    limits: &mut Limits,
    turned: &[(Sector, Offset, f64)],
    watch: &dyn Watch,
) -> Result<Vec<Sector>, Error> {
    if turned.is_empty() {
        return Ok(Vec::new());
    }
    limits.placement.turn(turned, watch)?;
    if let Cow::Borrowed(all) = room {
        let own = collect(all.len(), watch, |place| all[Sector::new(place)])?;
        *room = Cow::Owned(IdVec::from_vec(own));
    }
    let own = room.to_mut();
    turned.iter().for_each(|&(sector, _, share)| own[sector] = share);
    let turned: Vec<Sector> = turned.iter().map(|&(sector, ..)| sector).collect();
    let bad = bad_around(given, &limits.placement, &turned, watch)?;
    let mut near = shrink(given, limits, bad, watch)?;
    let beside = around(given, &turned, watch)?.into_iter();
    near.extend(beside.flat_map(|element| sectors_of(given, element)));
    sort(&mut near, watch)?;
    near.dedup();
    grow(given, room, limits, &near, watch)?;
    Ok(turned)
}

/// A sector turned away from its wider front, to what it could take or as far as its narrower front
/// goes, and its share of that; none if it has no two such.
fn turned_away(
    given: &Given,
    room: &IdVec<Sector, f64>,
    placement: &Placement,
    sector: Sector,
) -> Option<(Sector, Offset, f64)> {
    let (offset, whole) = (placement.offset(sector), room[sector]);
    let narrower = whole * offset.fronts[0].min(offset.fronts[1]);
    let share = placement.share[sector].max(narrower);
    if share >= whole || narrower <= 0.0 {
        return None;
    }
    let shares = offset.fronts.map(|front| if front < 1.0 { whole / share } else { 1.0 });
    let offset = narrow(given.surface, given.chamfers.sectors, sector, offset, shares)?;
    Some((sector, offset, share))
}

/// Those of some sectors that were shrunk, in the order in which they are asked: those first that lost most.
/// Whoever is asked first may take what another one could have had, so it goes by their shape and
/// place, not by their numbers: the same mesh told otherwise gets the same. Rounded, as the last
/// bits of sums depend on the order of what is added. Positive numbers sort as their bits do.
fn in_turn(
    given: &Given,
    room: &IdVec<Sector, f64>,
    placement: &Placement,
    sectors: &[Sector],
    watch: &dyn Watch,
) -> Result<Vec<Sector>, Error> {
    let is_asked = |sector: &Sector| {
        let ring = given.chamfers.sectors.fans[*sector].ring;
        placement.share[*sector] != room[*sector]
            && given.chamfers.sectors.ring(ring).len() <= LONGEST_GROWN
    };
    watch.worked(sectors.len())?;
    let sectors: Vec<Sector> = sectors.iter().copied().filter(is_asked).collect();
    if sectors.len() > 1 {
        let center = given.surface.view.center();
        let key = |sector: Sector| {
            let (kept, lost) = (placement.share[sector], room[sector] - placement.share[sector]);
            let (base, way) = (placement.base(sector), given.offsets[sector].vector);
            let goal = base + way;
            let [near, far] = [base, goal].map(|at| at.distance(center));
            let [lost, rest @ ..] =
                [lost, near, way.length(), kept, far].map(|l| (l as f32).to_bits());
            // Those of a shape that is the same on two sides are told apart by nothing else.
            (Reverse(lost), rest, Reverse(goal.to_array().map(in_order)))
        };
        let mut keyed = collect(sectors.len(), watch, |place| (key(sectors[place]), place as u32))?;
        sort(&mut keyed, watch)?;
        return collect(keyed.len(), watch, |place| sectors[keyed[place].1 as usize]);
    }
    Ok(sectors)
}

/// Bits that sort as the numbers do, rounded, whatever their signs.
fn in_order(number: f64) -> u32 {
    let bits = (number as f32 + 0.0).to_bits();
    if bits >> 31 == 0 { bits | 1 << 31 } else { !bits }
}

/// What is bad of all that depends on the sector at this share, which it gets; none if nothing is.
/// What was bad at another share is looked at first.
fn obstacle(
    given: &Given,
    placement: &mut Placement,
    sector: Sector,
    share: f64,
    before: Option<Element>,
) -> Option<Element> {
    placement.set(sector, share);
    let mut suspects = before.into_iter().chain(elements_of(given, sector));
    suspects.find(|&element| !is_valid(given, placement, element))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::given::tests::given_of;
    use crate::mesh::MeshBuffers;
    use crate::options::{Options, Width};
    use crate::shapes;
    use crate::stages::{stages_of, stages_with};
    use crate::watch::Unwatched;

    /// The shares of all sectors that can move.
    fn shares(mesh: &MeshBuffers, width: f32) -> Vec<f64> {
        let stages = stages_of(mesh, width);
        let limits = stages.limits(Verify::Fast);
        assert!(
            bad_elements(&given_of(&stages), &limits.placement, &Unwatched).unwrap().is_empty()
        );
        let movable = stages.sectors.fans.ids().filter(|&sector| stages.offsets[sector].moves());
        movable.map(|sector| limits.placement.share[sector]).collect()
    }

    #[test]
    fn with_room_every_sector_gets_all() {
        assert_eq!(shares(&shapes::plain_cube(1.0), 0.1), [1.0; 24]);
    }

    #[test]
    fn without_room_every_sector_gets_some() {
        let shares = shares(&shapes::plate(), 0.5);
        assert!(shares.iter().all(|&share| share > 0.0), "{shares:?}");
        assert!(shares.iter().any(|&share| share < 0.1), "{shares:?}");
    }

    #[test]
    fn one_narrow_part_does_not_narrow_another() {
        // A cube, and far from it a plate that is too thin for the width.
        let (mut both, plate) = (shapes::plain_cube(2.0), shapes::plate());
        let first = both.positions.len() as u32;
        both.positions.extend(plate.positions.iter().map(|[x, y, z]| [x + 9.0, *y, *z]));
        both.normals.extend(&plate.normals);
        both.indices.extend(plate.indices.iter().map(|index| first + index));
        both.submesh_index_counts = vec![both.indices.len() as u32];
        let shares = shares(&both, 0.1);
        assert!(shares[..24].iter().all(|&share| share == 1.0), "{shares:?}");
        assert!(shares[24..].iter().any(|&share| share < 1.0), "{shares:?}");
    }

    /// A corner that three unlike shares fold, and equal ones do not.
    #[test]
    fn a_ring_that_folds_gets_one_share_before_none() {
        let cube = shapes::plain_cube(1.0);
        let stages = stages_of(&cube, 0.1);
        let mut placement = stages.placed(0.0);
        let ring = stages.sectors.ring(Ring(0)).to_vec();
        for (&sector, share) in ring.iter().zip([0.5, 0.25, 0.0]) {
            placement.set(sector, share);
        }
        let reason = IdVec::filled(Reason::Folds, stages.offsets.len());
        let mut limits = Limits { placement, reason };
        let shares = |limits: &Limits| ring.iter().map(|&s| limits.placement.share[s]).collect();
        apply(&given_of(&stages), &mut limits, SHRINK_ROUNDS, &mut ring.clone());
        let even: Vec<f64> = shares(&limits);
        assert_eq!(even, [0.25, 0.25, 0.0]);
        apply(&given_of(&stages), &mut limits, SHRINK_ROUNDS + 1, &mut ring.clone());
        let none: Vec<f64> = shares(&limits);
        assert_eq!(none, [0.0; 3]);
    }

    /// How far a sector of a slab is pulled from its narrow and from its wide edge, as shares of the
    /// width, where it took a share of what it has room for because it would fold.
    fn pulled(taken: f64) -> [f64; 2] {
        let mut slab = shapes::plain_cube(4.0);
        slab.positions.iter_mut().for_each(|at| at[1] /= 4.0);
        let options = Options { width: Width::Units(0.8), ..Options::default() };
        let stages = stages_with(&slab, &options);
        let given = Given { offsets: &stages.narrowed, ..given_of(&stages) };
        let room = &stages.shares;
        let is_unlike = |sector: &Sector| stages.narrowed[*sector].fronts != [1.0; 2];
        let sector = room.ids().find(is_unlike).unwrap();
        let mut limits = bounded(&given, room, &Unwatched).unwrap();
        limits.placement.set(sector, taken * room[sector]);
        limits.reason[sector] = Reason::Folds;
        let room = &mut Cow::Borrowed(room);
        give_way(&given, room, &mut limits, &[sector], &Unwatched).unwrap();
        assert_eq!(limits.reason[sector], Reason::Folds);
        let way = limits.placement.point[sector] - limits.placement.base(sector);
        let narrow = way.y.abs();
        [narrow, way.reject_from(glam::DVec3::Y).length()].map(|length| length / 0.8)
    }

    // .------------     on the thin side of a slab the long edge has room for half of what the short
    // |  .              one gets: where it folds, only the short one is lessened, until both are
    // |                 alike
    // '------------
    #[test]
    fn where_unlike_fronts_fold_the_wider_one_gives_way() {
        for (taken, [narrow, wide]) in [(1.0, [0.5, 1.0]), (0.75, [0.5, 0.75]), (0.1, [0.5, 0.5])] {
            let pulled = pulled(taken);
            let is_near = |one: f64, other: f64| (one - other).abs() < 0.001;
            assert!(is_near(pulled[0], narrow) && is_near(pulled[1], wide), "{taken}: {pulled:?}");
        }
    }

    // -----.          the corner of a plate, with a bevel that vanishes: where a sector at it would fold,
    // ---.  `.        both go straight on instead, as far as leaves three tenths of the bevel
    //    :    |
    #[test]
    fn what_gathers_around_a_vanishing_edge_goes_straight_on_where_it_folds() {
        let mut plate = shapes::Builder::with_uvs();
        plate.prism(&[[0.0, 0.0], [2.0, 0.0], [2.0, 1.9], [1.9, 2.0], [0.0, 2.0]], 0.0, 1.0);
        let plate = plate.finish();
        let stages = stages_of(&plate, 0.2);
        let given = Given { offsets: &stages.narrowed, ..given_of(&stages) };
        let run = &stages.vanishing.runs[0];
        let sectors = [0, 1].map(|k| run.members[k].0);
        for (taken, goes_straight) in [(0.9, false), (0.2, true)] {
            let mut limits = bounded(&given, &stages.shares, &Unwatched).unwrap();
            limits.placement.set(sectors[0], taken);
            limits.reason[sectors[0]] = Reason::Folds;
            let room = &mut Cow::Borrowed(&stages.shares);
            take_back(&given, room, &mut limits, &Unwatched).unwrap();
            let is_plain = |k: usize| *limits.placement.offset(sectors[k]) == run.members[k].1;
            assert_eq!([0, 1].map(is_plain), [goes_straight; 2], "{taken}");
            let at = sectors.map(|sector| limits.placement.point[sector]);
            let kept = at[0].distance(at[1]) / (0.1 * 2.0_f64.sqrt());
            assert!(!goes_straight || (kept - 0.3).abs() < 1e-4, "{kept}");
        }
    }

    #[test]
    fn on_a_table_some_fronts_give_way() {
        let table = shapes::table();
        let stages = stages_of(&table, 0.2);
        let limits = stages.limits(Verify::Fast);
        let turned = |s: &Sector| *limits.placement.offset(*s) != stages.narrowed[*s];
        let turned: Vec<Sector> = stages.narrowed.ids().filter(turned).collect();
        assert_eq!(turned.len(), 8);
        assert!(turned.iter().all(|&sector| limits.reason[sector] == Reason::Folds));
    }

    #[test]
    fn places_that_mirror_each_other_are_told_apart() {
        let numbers = [-2.0, -0.5, -0.0, 0.0, 0.5, 2.0].map(in_order);
        assert!(numbers.is_sorted() && numbers[2] == numbers[3], "{numbers:?}");
        assert!(numbers[1] < numbers[2] && numbers[3] < numbers[4], "{numbers:?}");
    }

    // .---.     all corners of a cube lose the same, as far from the middle: by where they go
    // |   |     each has a turn of its own, whatever number it has
    // '---'
    #[test]
    fn whose_turn_it_is_does_not_depend_on_numbers() {
        let cube = shapes::plain_cube(1.0);
        let mut other = cube.clone();
        let (first, rest) = cube.indices.split_at(cube.indices.len() / 2);
        other.indices = [rest, first].concat();
        let goals = |mesh: &MeshBuffers| -> Vec<[i32; 3]> {
            let stages = stages_of(mesh, 0.1);
            let (given, placement) = (given_of(&stages), stages.placed(0.5));
            let room = IdVec::filled(1.0, stages.offsets.len());
            let all: Vec<Sector> = room.ids().collect();
            let turns = in_turn(&given, &room, &placement, &all, &Unwatched).unwrap();
            let goal = |s: Sector| placement.base(s) + stages.offsets[s].vector;
            let round = |at: glam::DVec3| at.to_array().map(|x| (x * 1000.0).round() as i32);
            turns.into_iter().map(|sector| round(goal(sector))).collect()
        };
        assert_eq!(goals(&cube), goals(&other));
    }

    #[test]
    fn a_width_of_nothing_leaves_nothing_to_limit() {
        assert_eq!(shares(&shapes::plain_cube(1.0), 0.0), []);
    }
}
