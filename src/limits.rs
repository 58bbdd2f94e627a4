//! Limits: how much of its offset each sector may take.
//!
//! Full offsets overlap wherever a feature is narrower than the chamfer, so each sector is limited
//! by what happens around it, and by nothing else: bound it by the room that its own triangles
//! leave, build strips and fills, shrink the sectors of whatever fails, and give back what is safe.
//! A ring that still fails keeps its old position, so the result is never worse than the source.

mod breadth;
mod collisions;
mod crowds;
mod room;

use std::cmp::Ordering;

use glam::DVec3;

use crate::contacts::Wedge;
use crate::error::Error;
use crate::fills;
use crate::ids::{Corner, Edge, Few, IdVec, Ring, Sector, Triangle};
use crate::math::{area_vector, unit};
use crate::options::Verify;
use crate::placement::Placement;
use crate::plan::Plan;
use crate::report::Reason;
use crate::strips;
use crate::validity::{opens_along, stays_line, survives};

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

/// What each sector gets.
pub struct Limits {
    pub placement: Placement,
    /// `#sectors`: why it did not get all.
    pub reason: IdVec<Sector, Reason>,
}

/// # Errors
/// [`Error::OutOfMemory`] where what collisions need is not to be had.
pub fn limits(plan: &Plan, verify: Verify) -> Result<Limits, Error> {
    let room = room::room(plan);
    let mut limits = bounded(plan, &room);
    let bad = bad_elements(plan, &limits.placement);
    shrink(plan, &mut limits, bad);
    for _ in 0..GROW_PASSES {
        grow(plan, &room, &mut limits);
    }
    if verify != Verify::Fast {
        collisions::resolve(plan, &mut limits)?;
    }
    Ok(limits)
}

/// Every sector at the width that its own triangles leave room for.
fn bounded(plan: &Plan, shares: &IdVec<Sector, f64>) -> Limits {
    let reason = |sector: Sector| {
        let is_narrow = plan.offsets[sector].moves() && shares[sector] < 1.0;
        if is_narrow { Reason::NoRoom } else { Reason::None }
    };
    Limits {
        placement: Placement::at(plan, shares),
        reason: plan.view.threads.map(shares.len(), reason),
    }
}

/// Anything that can go bad.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Element {
    Surface(Triangle),
    Strip(Edge),
    Fill(Ring),
}

impl Element {
    /// Orders elements, by kind and number, with a single comparison.
    fn key(self) -> u64 {
        let (kind, number) = match self {
            Element::Surface(triangle) => (0, triangle.0),
            Element::Strip(edge) => (1, edge.0),
            Element::Fill(ring) => (2, ring.0),
        };
        kind << 32 | u64::from(number)
    }
}

/// Shrinks what is bad, and then what is bad around what has shrunk; tells all that has.
fn shrink(plan: &Plan, limits: &mut Limits, mut bad: Vec<Element>) -> Vec<Sector> {
    let mut all = Vec::new();
    for round in 0.. {
        let mut shrunk = Vec::new();
        for element in bad {
            let reason = match element {
                Element::Surface(_) => Reason::NoRoom,
                Element::Strip(edge) if !contacts_are_kept(plan, &limits.placement, edge) => {
                    Reason::Contact
                }
                Element::Strip(_) | Element::Fill(_) => Reason::Folds,
            };
            blame(plan, limits, element, reason, &mut shrunk);
        }
        if shrunk.is_empty() {
            break;
        }
        apply(plan, limits, round, &mut shrunk);
        bad = bad_around(plan, &limits.placement, &shrunk);
        all.extend(shrunk);
    }
    all
}

/// All that depends on the sectors and is bad.
fn bad_around(plan: &Plan, placement: &Placement, sectors: &[Sector]) -> Vec<Element> {
    let suspects = around(plan, sectors).into_iter();
    suspects.filter(|&element| !is_valid(plan, placement, element)).collect()
}

/// Shrinks sectors, each once; after some rounds together with their whole rings: to one share for
/// all, and then to nothing.
fn apply(plan: &Plan, limits: &mut Limits, round: usize, shrunk: &mut Vec<Sector>) {
    shrunk.sort_unstable();
    shrunk.dedup();
    if round >= SHRINK_ROUNDS {
        spread_over_rings(plan, limits, shrunk);
    }
    let mut least = (Ring::NONE, 0.0);
    for &sector in shrunk.iter() {
        let share = limits.placement.share[sector];
        let smaller = match round.cmp(&SHRINK_ROUNDS) {
            Ordering::Less => share * SHRINK,
            Ordering::Equal => {
                // They come ring by ring. Anew for each sector, a large ring would take quadratic
                // time.
                let ring = plan.sectors.fans[sector].ring;
                if least.0 != ring {
                    least = (ring, least_in_ring(plan, &limits.placement, ring));
                }
                least.1
            }
            Ordering::Greater => 0.0,
        };
        limits.placement.set(plan, sector, smaller);
    }
}

/// The smallest share in a ring, of those that moved.
fn least_in_ring(plan: &Plan, placement: &Placement, ring: Ring) -> f64 {
    let shares = plan.sectors.ring(ring).iter().map(|&sector| placement.share[sector]);
    shares.filter(|&share| share > 0.0).fold(1.0, f64::min)
}

/// Adds to the sectors all others of their rings that have moved, for the same reason.
fn spread_over_rings(plan: &Plan, limits: &mut Limits, shrunk: &mut Vec<Sector>) {
    let mut rings: Vec<(Ring, Reason)> = shrunk
        .iter()
        .map(|&sector| (plan.sectors.fans[sector].ring, limits.reason[sector]))
        .collect();
    rings.sort_unstable();
    rings.dedup_by_key(|(ring, _)| *ring);
    shrunk.clear();
    for (ring, reason) in rings {
        for &sector in plan.sectors.ring(ring) {
            if limits.placement.share[sector] > 0.0 {
                limits.reason[sector] = reason;
                shrunk.push(sector);
            }
        }
    }
}

/// Everything that is bad where the sectors stand now.
fn bad_elements(plan: &Plan, placement: &Placement) -> Vec<Element> {
    let threads = &plan.view.threads;
    let is_bad = |element| !is_valid(plan, placement, element);
    let triangles = threads.filter(plan.faces.normal.len(), |triangle| {
        is_touched(plan, triangle) && is_bad(Element::Surface(triangle))
    });
    let edges = threads.filter(plan.edges.hard.len(), |edge| {
        plan.edges.hard[edge].skipped.is_none() && is_bad(Element::Strip(edge))
    });
    let rings = threads.filter(plan.sectors.rings.len(), |ring| is_bad(Element::Fill(ring)));
    let surface = triangles.into_iter().map(Element::Surface);
    let strips = edges.into_iter().map(Element::Strip);
    surface.chain(strips).chain(rings.into_iter().map(Element::Fill)).collect()
}

fn is_touched(plan: &Plan, triangle: Triangle) -> bool {
    triangle.corners().iter().any(|&corner| plan.sectors.sector_of[corner].is_some())
}

/// Notes the sectors that a bad element depends on.
fn blame(
    plan: &Plan,
    limits: &mut Limits,
    element: Element,
    reason: Reason,
    shrunk: &mut Vec<Sector>,
) {
    for sector in sectors_of(plan, element) {
        if limits.placement.share[sector] > 0.0 {
            limits.reason[sector] = reason;
            shrunk.push(sector);
        }
    }
}

/// The sectors that an element's corners stand on.
fn sectors_of(plan: &Plan, element: Element) -> Few<Sector> {
    let sector_of = |corner: Corner| plan.sectors.sector_of[corner];
    match element {
        Element::Surface(triangle) => {
            triangle.corners().into_iter().map(sector_of).filter(|s| s.is_some()).collect()
        }
        Element::Strip(edge) => {
            strips::corners(&plan.edges.hard[edge]).into_iter().map(sector_of).collect()
        }
        Element::Fill(ring) => Few::from_slice(plan.sectors.ring(ring)),
    }
}

/// Everything that depends on the sectors, each once.
fn around(plan: &Plan, sectors: &[Sector]) -> Vec<Element> {
    let mut elements: Vec<Element> =
        sectors.iter().flat_map(|&sector| elements_of(plan, sector)).collect();
    elements.sort_unstable_by_key(|element| element.key());
    elements.dedup();
    elements
}

/// Everything that depends on one sector.
fn elements_of<'a>(plan: &'a Plan, sector: Sector) -> impl Iterator<Item = Element> + 'a {
    let fan = &plan.sectors.fans[sector];
    let surface = plan.sectors.corners(&plan.topology, sector);
    let sides = [fan.first, fan.last.prev()].map(|side| plan.edges.chamfered_at[side]);
    surface
        .map(|corner| Element::Surface(corner.triangle()))
        .chain(sides.into_iter().filter(|edge| edge.is_some()).map(Element::Strip))
        .chain(std::iter::once(Element::Fill(fan.ring)))
}

fn is_valid(plan: &Plan, placement: &Placement, element: Element) -> bool {
    match element {
        Element::Surface(triangle) => surface_is_valid(plan, placement, triangle),
        Element::Strip(edge) => {
            strip_is_valid(plan, placement, edge) && contacts_are_kept(plan, placement, edge)
        }
        Element::Fill(ring) => fill_is_valid(plan, placement, ring),
    }
}

fn surface_is_valid(plan: &Plan, placement: &Placement, triangle: Triangle) -> bool {
    let old = plan.view.triangle(triangle);
    let new = triangle.corners().map(|corner| placement.position_at(plan, corner));
    let faces = &plan.faces;
    if old == new {
        true
    } else if faces.normal[triangle] == DVec3::ZERO || faces.is_line(triangle) {
        let resolution = plan.view.resolution;
        stays_line(old, new, faces.normal[triangle], resolution)
            && opens_along(old, new, facing(plan, placement, triangle).map(unit), resolution)
    } else {
        survives(old, new)
            && breadth::is_kept(plan, triangle, [old, new])
            && still_faces_out(plan, placement, triangle, [old, new])
    }
}

/// Whether a triangle that faced the way its vertex normals point still does.
fn still_faces_out(
    plan: &Plan,
    placement: &Placement,
    triangle: Triangle,
    [old, new]: [[DVec3; 3]; 2],
) -> bool {
    let [before, after] = facing(plan, placement, triangle);
    area_vector(new).dot(after) > 0.0 || area_vector(old).dot(before) <= 0.0
}

/// The sums of a triangle's vertex normals, before and after.
fn facing(plan: &Plan, placement: &Placement, triangle: Triangle) -> [DVec3; 2] {
    let sum = |normals: [DVec3; 3]| normals[0] + normals[1] + normals[2];
    let corners = triangle.corners();
    let before = corners.map(|corner| plan.view.normal_at(corner));
    [sum(before), sum(corners.map(|corner| placement.normal_at(plan, corner)))]
}

fn strip_is_valid(plan: &Plan, placement: &Placement, edge: Edge) -> bool {
    let edge = &plan.edges.hard[edge];
    let quad = strips::quad(plan, placement, edge);
    let [from, to] = [edge.sides[0], edge.sides[0].next()].map(|c| plan.view.position_at(c));
    strips::is_valid(&quad, strips::cut(&quad), unit(to - from), plan.view.resolution)
}

/// Whether a strip leaves everything covered that rests beside its edge.
fn contacts_are_kept(plan: &Plan, placement: &Placement, edge: Edge) -> bool {
    // Beside most edges nothing rests.
    if plan.rests.of(edge).is_empty() {
        return true;
    }
    let [b1, a1, a2, b2] =
        strips::corners(&plan.edges.hard[edge]).map(|corner| placement.position_at(plan, corner));
    let wedge = Wedge::new(&plan.view, &plan.faces, plan.edges.hard[edge].sides);
    wedge.is_none_or(|wedge| plan.rests.are_kept(edge, &wedge, [[a1, b1], [a2, b2]]))
}

fn fill_is_valid(plan: &Plan, placement: &Placement, ring: Ring) -> bool {
    match *plan.sectors.ring(ring) {
        [a, b, c] => {
            let sectors = [a, b, c];
            let points = sectors.map(|sector| placement.point[sector]);
            let normals = sectors.map(|sector| placement.normals[sector][0]);
            fills::can_fill(points, normals, plan.view.resolution)
        }
        _ => fill(plan, placement, ring).is_some(),
    }
}

/// The fill of a ring where its sectors stand now; none if every way to fill it folds.
pub fn fill(plan: &Plan, placement: &Placement, ring: Ring) -> Option<fills::Fill> {
    let sectors = plan.sectors.ring(ring);
    if sectors.len() < 3 {
        return Some(fills::Fill::default());
    }
    let points: Few<_> = sectors.iter().map(|&sector| placement.point[sector]).collect();
    let normals: Few<_> = sectors.iter().map(|&sector| placement.normals[sector][0]).collect();
    fills::fill(&points, &normals, plan.view.resolution)
}

/// Gives back to every sector that was shrunk, up to its room, as much as it can take with all
/// others where they are.
fn grow(plan: &Plan, room: &IdVec<Sector, f64>, limits: &mut Limits) {
    for sector in room.ids() {
        let (mut good, mut bad) = (limits.placement.share[sector], room[sector]);
        let ring = plan.sectors.fans[sector].ring;
        if good == bad || plan.sectors.ring(ring).len() > LONGEST_GROWN {
            continue;
        }
        let mut found = obstacle(plan, &mut limits.placement, sector, bad, None);
        if found.is_none() {
            limits.reason[sector] = if bad < 1.0 { Reason::NoRoom } else { Reason::None };
            continue;
        }
        for _ in 0..GROW_STEPS {
            let middle = (good + bad) / 2.0;
            match obstacle(plan, &mut limits.placement, sector, middle, found) {
                None => good = middle,
                other => (bad, found) = (middle, other),
            }
        }
        limits.placement.set(plan, sector, good);
    }
}

/// What is bad of all that depends on the sector at this share, which it gets; none if nothing is.
/// What was bad at another share is looked at first.
fn obstacle(
    plan: &Plan,
    placement: &mut Placement,
    sector: Sector,
    share: f64,
    before: Option<Element>,
) -> Option<Element> {
    placement.set(plan, sector, share);
    let mut suspects = before.into_iter().chain(elements_of(plan, sector));
    suspects.find(|&element| !is_valid(plan, placement, element))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::MeshBuffers;
    use crate::plan::tests::plan_of;
    use crate::shapes;

    /// The shares of all sectors that can move.
    fn shares(mesh: &MeshBuffers, width: f32) -> Vec<f64> {
        let plan = plan_of(mesh, width);
        let limits = limits(&plan, Verify::Fast).unwrap();
        assert!(bad_elements(&plan, &limits.placement).is_empty());
        let movable = plan.sectors.fans.ids().filter(|&sector| plan.offsets[sector].moves());
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

    #[test]
    fn a_triangle_may_not_turn_from_its_vertex_normals() {
        let mut cube = shapes::plain_cube(1.0);
        let plan = plan_of(&cube, 0.1);
        let placement = Placement::unmoved(&plan);
        let old = plan.view.triangle(Triangle(0));
        let turned = [old[0], old[2], old[1]];
        assert!(still_faces_out(&plan, &placement, Triangle(0), [old, old]));
        assert!(!still_faces_out(&plan, &placement, Triangle(0), [old, turned]));
        cube.normals.iter_mut().for_each(|normal| *normal = normal.map(|part| -part));
        let plan = plan_of(&cube, 0.1);
        let placement = Placement::unmoved(&plan);
        assert!(still_faces_out(&plan, &placement, Triangle(0), [old, turned]), "it never did");
    }

    /// A corner that three unlike shares fold, and equal ones do not.
    #[test]
    fn a_ring_that_folds_gets_one_share_before_none() {
        let cube = shapes::plain_cube(1.0);
        let plan = plan_of(&cube, 0.1);
        let mut placement = Placement::unmoved(&plan);
        let ring = plan.sectors.ring(Ring(0)).to_vec();
        for (&sector, share) in ring.iter().zip([0.5, 0.25, 0.0]) {
            placement.set(&plan, sector, share);
        }
        let reason = IdVec::filled(Reason::Folds, plan.offsets.len());
        let mut limits = Limits { placement, reason };
        let shares = |limits: &Limits| ring.iter().map(|&s| limits.placement.share[s]).collect();
        apply(&plan, &mut limits, SHRINK_ROUNDS, &mut ring.clone());
        let even: Vec<f64> = shares(&limits);
        assert_eq!(even, [0.25, 0.25, 0.0]);
        apply(&plan, &mut limits, SHRINK_ROUNDS + 1, &mut ring.clone());
        let none: Vec<f64> = shares(&limits);
        assert_eq!(none, [0.0; 3]);
    }

    #[test]
    fn a_width_of_nothing_leaves_nothing_to_limit() {
        assert_eq!(shares(&shapes::plain_cube(1.0), 0.0), []);
    }
}
