//! Collisions: parts of the mesh that would cut through each other, though no triangle flips.
//!
//! Only edge-connected parts that are clean in the source are kept clean: where a part cuts
//! through itself already, a chamfer across the cut has to cut as well.

use std::cell::Cell;

use crate::corners;
use crate::groups::Groups;
use crate::ids::{Corner, Few, Id, IdVec, Sector, Triangle};
use crate::intersect;
use crate::plan::Plan;
use crate::report::Reason;
use crate::strips;

use super::{Element, Limits, apply, bad_around, blame, fill, sectors_of, shrink};

/// Rounds in which width is given back: the rest is within an eighth of what would fit.
const GIVE_BACK_ROUNDS: usize = 3;

/// Shrinks the sectors of all that cuts, until nothing does that did not in the source, and gives
/// back what is safe.
pub fn resolve(plan: &Plan, limits: &mut Limits) {
    let mut search = Search { plan, part_of: parts(plan), was_cut: None };
    let free = limits.placement.share.clone();
    for round in 0.. {
        let mut shrunk = Vec::new();
        for element in search.new_cuts(limits) {
            blame(plan, limits, element, Reason::Intersects, &mut shrunk);
        }
        if shrunk.is_empty() {
            break;
        }
        apply(plan, limits, round, &mut shrunk);
        let bad = bad_around(plan, &limits.placement, &shrunk);
        shrink(plan, limits, bad);
    }
    give_back(&mut search, limits, &free);
}

/// Bisects the shares of all sectors that lost some, together: whatever takes part in a cut goes
/// back to what was safe.
fn give_back(search: &mut Search, limits: &mut Limits, free: &IdVec<Sector, f64>) {
    let plan = search.plan;
    let mut safe = limits.placement.share.clone();
    let mut unsafe_from = free.clone();
    let shrunk: Vec<Sector> = free.ids().filter(|&s| safe[s] < free[s]).collect();
    if shrunk.is_empty() {
        return;
    }
    for _ in 0..GIVE_BACK_ROUNDS {
        for &sector in &shrunk {
            limits.placement.set(plan, sector, (safe[sector] + unsafe_from[sector]) / 2.0);
        }
        loop {
            let mut bad = search.new_cuts(limits);
            bad.extend(bad_around(plan, &limits.placement, &shrunk));
            let mut back: Vec<Sector> = bad.iter().flat_map(|&e| sectors_of(plan, e)).collect();
            back.retain(|&sector| limits.placement.share[sector] > safe[sector]);
            // Each once: the second time, what was safe would be taken for what was not.
            back.sort_unstable();
            back.dedup();
            if back.is_empty() {
                break;
            }
            for sector in back {
                unsafe_from[sector] = limits.placement.share[sector].min(unsafe_from[sector]);
                limits.placement.set(plan, sector, safe[sector]);
            }
        }
        for &sector in &shrunk {
            safe[sector] = limits.placement.share[sector];
        }
    }
}

/// What has to be known of the source to tell new cuts from old ones.
struct Search<'a> {
    plan: &'a Plan<'a>,
    /// `#triangles`.
    part_of: Vec<u32>,
    /// By part: whether it cuts through itself in the source. Only looked for once it matters.
    was_cut: Option<Vec<bool>>,
}

impl Search<'_> {
    /// All that takes part in a cut in a part that had none.
    fn new_cuts(&mut self, limits: &Limits) -> Vec<Element> {
        let soup = soup(self.plan, limits, &self.part_of);
        let is_changed = soup.changed(self.plan, limits);
        let part_of = |triangle: u32| soup.part_of[triangle as usize] as usize;
        let may_cut = |a: u32, b: u32| {
            part_of(a) == part_of(b) && (is_changed[a as usize] || is_changed[b as usize])
        };
        let search = intersect::Soup::new(&soup.points, &soup.triangles);
        if self.was_cut.is_none() {
            let is_cut = Cell::new(false);
            search.visit_cuts(|_| is_cut.get(), may_cut, |_, _| is_cut.set(true));
            if !is_cut.get() {
                return Vec::new();
            }
        }
        let was_cut = self.was_cut.get_or_insert_with(|| parts_that_cut(self.plan, &self.part_of));
        // Which pairs cut does not matter, and there may be very many: only what takes part.
        let mut takes_part = vec![false; soup.elements.len()];
        search.visit_cuts(
            |triangle| was_cut[part_of(triangle)],
            may_cut,
            |a, b| {
                takes_part[a as usize] = true;
                takes_part[b as usize] = true;
            },
        );
        soup.elements
            .iter()
            .zip(takes_part)
            .filter_map(|(&element, takes_part)| takes_part.then_some(element))
            .collect()
    }
}

/// The result as loose triangles, and what each is.
struct Soup {
    points: Vec<[f32; 3]>,
    triangles: Vec<[u32; 3]>,
    part_of: Vec<u32>,
    elements: Vec<Element>,
}

impl Soup {
    fn push(&mut self, corners: [glam::DVec3; 3], part: u32, element: Element) {
        let first = self.points.len() as u32;
        self.points.extend(corners.map(|point| point.as_vec3().to_array()));
        self.triangles.push([first, first + 1, first + 2]);
        self.part_of.push(part);
        self.elements.push(element);
    }

    /// `#triangles`: whether it is new or has moved.
    fn changed(&self, plan: &Plan, limits: &Limits) -> Vec<bool> {
        let has_moved = |corner: Corner| {
            let sector = plan.sectors.sector_of[corner];
            sector.is_some() && limits.placement.has_moved(plan, sector)
        };
        let is_changed = |element: &Element| match *element {
            Element::Surface(triangle) => triangle.corners().into_iter().any(has_moved),
            Element::Strip(_) | Element::Fill(_) => true,
        };
        self.elements.iter().map(is_changed).collect()
    }
}

fn soup(plan: &Plan, limits: &Limits, part_of: &[u32]) -> Soup {
    let placement = &limits.placement;
    let mut soup = Soup {
        points: Vec::new(),
        triangles: Vec::new(),
        part_of: Vec::new(),
        elements: Vec::new(),
    };
    for triangle in plan.view.triangles() {
        let corners = triangle.corners().map(|corner| placement.position_at(plan, corner));
        soup.push(corners, part_of[triangle.index()], Element::Surface(triangle));
    }
    for edge in plan.edges.hard.ids().filter(|&edge| plan.edges.hard[edge].skipped.is_none()) {
        let hard = &plan.edges.hard[edge];
        let quad = strips::quad(plan, placement, hard);
        let part = part_of[hard.sides[0].triangle().index()];
        for corners in strips::cut(&quad).triangles() {
            soup.push(corners.map(|place| quad.points[place]), part, Element::Strip(edge));
        }
    }
    for ring in plan.sectors.rings.ids() {
        let sectors = plan.sectors.ring(ring);
        let part = part_of[plan.sectors.fans[sectors[0]].first.triangle().index()];
        let fill = fill(plan, placement, ring).unwrap_or_default();
        let mut points: Few<_> = sectors.iter().map(|&sector| placement.point[sector]).collect();
        let middles: Few<_> =
            fill.middles.iter().map(|places| corners::middle(&points, places)).collect();
        points.extend(middles);
        for corners in &fill.triangles {
            soup.push(corners.map(|place| points[place]), part, Element::Fill(ring));
        }
    }
    soup
}

/// `#triangles`: a number for each part whose triangles are joined by edges, touching ones
/// included.
fn parts(plan: &Plan) -> Vec<u32> {
    let mut groups = Groups::singles(plan.view.corner_count() / 3);
    let mut join = |one: Corner, other: Corner| groups.join(one.triangle().0, other.triangle().0);
    for corner in plan.topology.twin.ids() {
        let twin = plan.topology.twin[corner];
        if twin.is_some() && corner < twin {
            join(corner, twin);
        }
    }
    plan.topology.touching.iter().for_each(|&[one, other]| join(one, other));
    groups.labels()
}

/// `#triangles`, by the number of a part: whether it cuts through itself in the source.
fn parts_that_cut(plan: &Plan, part_of: &[u32]) -> Vec<bool> {
    let cuts = vec![Cell::new(false); part_of.len()];
    let cuts_itself = |triangle: u32| &cuts[part_of[triangle as usize] as usize];
    let triangles: Vec<[u32; 3]> = plan
        .view
        .triangles()
        .map(|triangle: Triangle| triangle.corners().map(|corner| plan.view.vertex_at(corner).0))
        .collect();
    intersect::Soup::new(plan.view.mesh.positions, &triangles).visit_cuts(
        |triangle| cuts_itself(triangle).get(),
        |a, b| part_of[a as usize] == part_of[b as usize],
        |a, _| cuts_itself(a).set(true),
    );
    cuts.into_iter().map(Cell::into_inner).collect()
}
