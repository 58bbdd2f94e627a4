//! Collisions: what would cut through itself, though no triangle flips.
//!
//! Each solid, and what else is joined by edges, is laid out as triangles, where its sectors stand, and searched. What
//! cuts shrinks, and the part is searched again, until nothing cuts; then half of what was taken
//! is tried again, and so on. Only parts that are clean in the source are kept clean: where one
//! cuts through itself already, a chamfer across the cut has to cut as well.

use std::sync::OnceLock;

use glam::DVec3;

use crate::bvh::Kin;
use crate::chamfers::Chamfers;
use crate::error::Error;
use crate::fills::{middle, ring_fill};
use crate::flaps::is_open;
use crate::ids::{self, Corner, Edge, Few, Id, IdVec, Ring, Sector};
use crate::intersect::{self, Asked, Triangle, cutting_pairs};
use crate::memory;
use crate::placement::Placement;
use crate::report::Reason;
use crate::strips;
use crate::topology::solids;
use crate::watch::{Watch, collect, each, sort, stretches};

use super::crowds::{Crowd, Crowds, crowds};
use super::elements::{Element, around, flap_joints, sectors_of};
use super::{Limits, apply, bad_around, blame, shrink};
use crate::given::Given;

/// The triangles of a strip or a fill that has more than one segment, in a state.
pub type Rounded<'a, S> = dyn Fn(&S, Element) -> Option<Vec<Triangle>> + Sync + 'a;

/// Rounds in which width is given back: the rest is within an eighth of what would fit.
const GIVE_BACK_ROUNDS: usize = 3;

/// Shrinks the sectors of all that cuts, until nothing does that did not in the source, and gives
/// back what is safe.
///
/// # Errors
/// [`Error::OutOfMemory`] where what searching the parts needs is not to be had, and
/// [`Error::Cancelled`] where the watch stops it.
pub fn resolve(given: &Given, limits: &mut Limits, watch: &dyn Watch) -> Result<(), Error> {
    let parts = parts(given, watch)?;
    memory::ask(memory::of_collisions(most_searched(given, &parts)))?;
    // Most parts are clean, and no part has a say in another: so all can be searched at once.
    let cuts =
        |watch: &dyn Watch, part: &Part| part.new_cuts(&limits.placement, &part.elements, watch);
    let cuts = given.threads.map_watched(&parts, watch, cuts)?;
    let free = limits.placement.share.clone();
    for (part, cuts) in parts.iter().zip(cuts).filter(|(_, cuts)| !cuts.is_empty()) {
        let shrunk = shrink_cuts(given, limits, (part, watch), cuts)?;
        give_back(given, limits, (part, watch), (&shrunk, &free))?;
    }
    drop(parts);
    watch.worked(given.surface.view.corner_count())
}

/// Looks for what cuts where strips and fills are rounded, and lets the state have fewer rounded ones,
/// until nothing cuts that did not in the source, or `lessen` leaves the state as it is.
///
/// # Errors
/// [`Error::OutOfMemory`] where what searching the parts needs is not to be had, and
/// [`Error::Cancelled`] where the watch stops it.
pub fn lessen_cuts<S: Sync>(
    given: &Given,
    placement: &Placement,
    state: &mut S,
    rounded: &Rounded<S>,
    watch: &dyn Watch,
    mut lessen: impl FnMut(&mut S, &[Element]) -> Result<bool, Error>,
) -> Result<(), Error> {
    let parts = parts(given, watch)?;
    let mut left: Vec<&Part> = parts.iter().collect();
    loop {
        let shared: &S = state;
        let lay = |element: Element| rounded(shared, element);
        memory::ask(memory::of_collisions(most_rounded(given, &left, &lay)))?;
        let cuts = |watch: &dyn Watch, part: &&Part| {
            let open = part.elements.iter().copied().filter(|&element| lay(element).is_some());
            let open: Vec<Element> = open.collect();
            part.new_cuts_of(placement, &open, Some(&lay), watch)
        };
        let cuts = given.threads.map_watched(&left, watch, cuts)?;
        left = left.into_iter().zip(&cuts).filter(|(_, c)| !c.is_empty()).map(|(p, _)| p).collect();
        if left.is_empty() || !lessen(state, &cuts.concat())? {
            return Ok(());
        }
    }
}

/// As [`most_searched`], where strips and fills are rounded.
fn most_rounded(given: &Given, parts: &[&Part], lay: &Lay) -> usize {
    let of = |part: &&Part| -> usize {
        let more = part.elements.iter().filter_map(|&element| lay(element));
        part.most_triangles() + more.map(|triangles| triangles.len()).sum::<usize>()
    };
    let sizes: Vec<usize> = parts.iter().map(of).collect();
    let largest = sizes.iter().copied().max().unwrap_or(0);
    sizes.iter().sum::<usize>().min(largest.saturating_mul(given.threads.count()))
}

/// The triangles of what is rounded.
type Lay<'a> = dyn Fn(Element) -> Option<Vec<Triangle>> + Sync + 'a;

/// How many triangles are searched at a time, at most: each thread has a part.
fn most_searched(given: &Given, parts: &[Part]) -> usize {
    let sizes = || parts.iter().map(Part::most_triangles);
    let largest = sizes().max().unwrap_or(0);
    sizes().sum::<usize>().min(largest.saturating_mul(given.threads.count()))
}

/// Shrinks until nothing in a part cuts; tells what has shrunk, in order.
fn shrink_cuts(
    given: &Given,
    limits: &mut Limits,
    (part, watch): (&Part, &dyn Watch),
    mut cutting: Vec<Element>,
) -> Result<Vec<Sector>, Error> {
    let mut all = Vec::new();
    for round in 0.. {
        let mut shrunk = Vec::new();
        for &element in &cutting {
            blame(given, limits, element, Reason::Intersects, &mut shrunk);
        }
        if shrunk.is_empty() {
            break;
        }
        apply(given, limits, round, &mut shrunk);
        let bad = bad_around(given, &limits.placement, &shrunk, watch)?;
        shrunk.extend(shrink(given, limits, bad, watch)?);
        cutting = part.cuts_now(&limits.placement, cutting, &shrunk, watch)?;
        all.extend(shrunk);
    }
    all.sort_unstable();
    all.dedup();
    Ok(all)
}

/// Bisects the shares of all sectors that lost some, together: whatever takes part in a cut goes
/// back to what was safe.
fn give_back(
    given: &Given,
    limits: &mut Limits,
    (part, watch): (&Part, &dyn Watch),
    (shrunk, free): (&[Sector], &IdVec<Sector, f64>),
) -> Result<(), Error> {
    let mut tries: Vec<Try> = shrunk
        .iter()
        .map(|&sector| (sector, limits.placement.share[sector], free[sector]))
        .filter(|(_, safe, free)| safe < free)
        .map(|(sector, safe, free)| Try { sector, safe, unsafe_from: free })
        .collect();
    let sectors: Vec<Sector> = tries.iter().map(|each| each.sector).collect();
    if tries.is_empty() {
        return Ok(());
    }
    for _ in 0..GIVE_BACK_ROUNDS {
        for each in &tries {
            limits.placement.set(each.sector, (each.safe + each.unsafe_from) / 2.0);
        }
        let mut cutting = part.cuts_now(&limits.placement, Vec::new(), &sectors, watch)?;
        loop {
            let mut bad = cutting.clone();
            bad.extend(bad_around(given, &limits.placement, &sectors, watch)?);
            let mut back: Vec<Sector> = bad.iter().flat_map(|&e| sectors_of(given, e)).collect();
            // Each once: the second time, what was safe would be taken for what was not.
            back.sort_unstable();
            back.dedup();
            back.retain(|&sector| take_back(limits, &mut tries, sector));
            if back.is_empty() {
                break;
            }
            cutting = part.cuts_now(&limits.placement, cutting, &back, watch)?;
        }
        for each in &mut tries {
            each.safe = limits.placement.share[each.sector];
        }
    }
    Ok(())
}

/// A sector that lost some of its share: what is safe for it, and what is not.
struct Try {
    sector: Sector,
    safe: f64,
    unsafe_from: f64,
}

/// Sets a sector back to what is safe, if it has more.
fn take_back(limits: &mut Limits, tries: &mut [Try], sector: Sector) -> bool {
    let Ok(place) = tries.binary_search_by_key(&sector, |each| each.sector) else { return false };
    let (each, share) = (&mut tries[place], limits.placement.share[sector]);
    if share <= each.safe {
        return false;
    }
    each.unsafe_from = share.min(each.unsafe_from);
    limits.placement.set(sector, each.safe);
    true
}

/// A solid, or what else is joined by edges, if some of it is chamfered.
struct Part<'a> {
    given: &'a Given<'a>,
    /// In order.
    elements: Vec<Element>,
    /// `#elements`: the crowd of each; none at all where there are none.
    crowds: Vec<Option<Crowd>>,
    /// Whether it cuts through itself in the source. Only looked for once it matters.
    was_cut: OnceLock<bool>,
}

/// What is known of a triangle of a part, beside its corners.
struct Laid {
    /// Place in the part's elements.
    element: u32,
    /// Whether it is new or has moved.
    is_changed: bool,
    /// Whether it may cut something that it did not before.
    is_open: bool,
}

impl Part<'_> {
    fn most_triangles(&self) -> usize {
        let of = |element: &Element| match element {
            Element::Surface(_) | Element::Flap(_) => 1,
            Element::Strip(_) => 2,
            Element::Fill(ring) => self.given.chamfers.sectors.ring(*ring).len(),
        };
        self.elements.iter().map(of).sum()
    }

    /// The elements that take part in a cut now, if some did before sectors have moved.
    fn cuts_now(
        &self,
        placement: &Placement,
        before: Vec<Element>,
        moved: &[Sector],
        watch: &dyn Watch,
    ) -> Result<Vec<Element>, Error> {
        let mut open = before;
        open.extend(around(self.given, moved, watch)?);
        sort(&mut open, watch)?;
        self.new_cuts(placement, &open, watch)
    }

    /// The elements that take part in a cut in which one of the open ones does, in order; none
    /// where the part cut through itself already. `open` in order.
    fn new_cuts(
        &self,
        placement: &Placement,
        open: &[Element],
        watch: &dyn Watch,
    ) -> Result<Vec<Element>, Error> {
        self.new_cuts_of(placement, open, None, watch)
    }

    fn new_cuts_of(
        &self,
        placement: &Placement,
        open: &[Element],
        rounded: Option<&Lay>,
        watch: &dyn Watch,
    ) -> Result<Vec<Element>, Error> {
        let (triangles, laid) = self.lay_out(placement, open, rounded, watch)?;
        let open = |number: u32| laid[number as usize].is_open;
        let pair = |a: u32, b: u32| {
            let [a, b] = [a, b].map(|number| &laid[number as usize]);
            (a.is_open | b.is_open) & (a.is_changed | b.is_changed)
        };
        let kin = self.kin(placement, (&triangles, &laid), watch)?;
        let source = || self.source_triangles(watch);
        let pairs = cutting_pairs(&triangles, &kin, source, &Asked { open, pair }, watch)?;
        // Giving back so much memory takes a while, too.
        drop(triangles);
        watch.worked(laid.len())?;
        if pairs.is_empty() || self.was_cut(watch)? {
            return Ok(Vec::new());
        }
        let mut places: Vec<u32> =
            pairs.iter().flat_map(|&(a, b)| [a, b]).map(|t| laid[t as usize].element).collect();
        places.sort_unstable();
        places.dedup();
        Ok(places.into_iter().map(|place| self.elements[place as usize]).collect())
    }

    fn was_cut(&self, watch: &dyn Watch) -> Result<bool, Error> {
        if let Some(&known) = self.was_cut.get() {
            return Ok(known);
        }
        let triangles = self.source_triangles(watch)?;
        let kin = intersect::crowds(&triangles).unwrap_or_default();
        let all = Asked { open: |_| true, pair: |_, _| true };
        let was_cut = !cutting_pairs(&triangles, &kin, || Ok(Vec::new()), &all, watch)?.is_empty();
        Ok(*self.was_cut.get_or_init(|| was_cut))
    }

    /// The part as it was.
    fn source_triangles(&self, watch: &dyn Watch) -> Result<Vec<Triangle>, Error> {
        let source = |element: &Element| match *element {
            Element::Surface(triangle) => Some(triangle.corners().map(|c| self.source(c))),
            Element::Strip(_) | Element::Fill(_) | Element::Flap(_) => None,
        };
        let mut triangles = Vec::with_capacity(self.elements.len());
        for stretch in stretches(self.elements.len(), watch) {
            triangles.extend(self.elements[stretch?].iter().filter_map(source));
        }
        Ok(triangles)
    }

    /// `#triangles`: where each lies as seen from where its crowd meets; none without any crowd.
    fn kin(
        &self,
        placement: &Placement,
        (triangles, laid): (&[Triangle], &[Laid]),
        watch: &dyn Watch,
    ) -> Result<Vec<Kin>, Error> {
        if self.crowds.is_empty() {
            return Ok(Vec::new());
        }
        let kin = |(corners, each): (&Triangle, &Laid)| {
            watch.worked(1)?;
            Ok(self.crowds[each.element as usize].map_or(Kin::NONE, |crowd| {
                let around = crowd.around(self.given, placement);
                Kin::new(crowd.name(), around.seen(corners))
            }))
        };
        triangles.iter().zip(laid).map(kin).collect()
    }

    fn source(&self, corner: Corner) -> [f32; 3] {
        let view = self.given.surface.view;
        view.stored_positions()[view.vertex_at(corner).index()]
    }

    /// All triangles of the part where the sectors stand now, as they are stored.
    fn lay_out(
        &self,
        placement: &Placement,
        open: &[Element],
        rounded: Option<&Lay>,
        watch: &dyn Watch,
    ) -> Result<(Vec<Triangle>, Vec<Laid>), Error> {
        let most = self.most_triangles();
        let (mut all, mut laid) = (Vec::with_capacity(most), Vec::with_capacity(most));
        let mut open = open.iter().peekable();
        for (place, &element) in (0..).zip(&self.elements) {
            watch.worked(1)?;
            while open.next_if(|next| next.key() < element.key()).is_some() {}
            let is_open = open.peek() == Some(&&element);
            let is_changed = self.is_changed(placement, element);
            let mut add = |corners: Triangle| {
                all.push(corners);
                laid.push(Laid { element: place, is_changed, is_open });
            };
            match rounded.and_then(|lay| lay(element)) {
                Some(triangles) => triangles.into_iter().for_each(add),
                None => self.each_triangle(placement, element, &mut add),
            }
        }
        Ok((all, laid))
    }

    fn is_changed(&self, placement: &Placement, element: Element) -> bool {
        let Element::Surface(triangle) = element else { return true };
        triangle.corners().into_iter().any(|corner| {
            let sector = self.given.chamfers.sectors.sector_of[corner];
            sector.is_some() && placement.has_moved(sector)
        })
    }

    fn each_triangle(
        &self,
        placement: &Placement,
        element: Element,
        add: &mut dyn FnMut(Triangle),
    ) {
        let given = self.given;
        match element {
            Element::Surface(triangle) => {
                add(triangle.corners().map(|corner| placement.stored_at(corner)));
            }
            Element::Strip(edge) => {
                let edge = &given.chamfers.edges.hard[edge];
                let triangles =
                    strips::cut(strips::quad(placement, edge).points).triangles().iter();
                let points = strips::corners(edge).map(|corner| placement.stored_at(corner));
                triangles.for_each(|corners| add(corners.map(|place| points[place])));
            }
            Element::Fill(ring) => self.each_of_fill(placement, ring, add),
            Element::Flap(place) => {
                let joints = flap_joints(given, place);
                if is_open(joints.map(|joint| placement.position_at(joint))) {
                    add(joints.map(|joint| placement.stored_at(joint)));
                }
            }
        }
    }

    fn each_of_fill(&self, placement: &Placement, ring: Ring, add: &mut dyn FnMut(Triangle)) {
        let (sectors, view) = (self.given.chamfers.sectors.ring(ring), self.given.surface.view);
        let fill = ring_fill(placement, sectors, view.resolution).unwrap_or_default();
        let stored = |point: DVec3| point.as_vec3().to_array();
        let joints: Few<_> = sectors.iter().map(|&sector| placement.point[sector]).collect();
        let mut points: Few<_> =
            sectors.iter().map(|&sector| stored(placement.stored(sector))).collect();
        let middles = fill.middles.iter().map(|places| view.stored(middle(&joints, places)));
        points.extend(middles.map(stored));
        fill.triangles.iter().for_each(|corners| add(corners.map(|place| points[place])));
    }
}

/// An element, and the solid that it belongs to.
type Labelled = (u32, Element);

/// The parts with chamfered edges.
fn parts<'a>(given: &'a Given<'a>, watch: &dyn Watch) -> Result<Vec<Part<'a>>, Error> {
    let label_of = solids(given.surface.topology, watch)?;
    let all = together(&labelled(given, &label_of, watch)?, label_of.len(), watch)?;
    drop(label_of);
    let crowds = crowds(given, watch)?;
    let part = |group: &[Labelled]| {
        let elements = collect(group.len(), watch, |place| group[place].1)?;
        let of = |crowds: &Crowds| {
            collect(elements.len(), watch, |place| crowds.of(given, elements[place]))
        };
        let crowds = crowds.as_ref().map(of).transpose()?;
        let crowds = crowds.filter(|all| all.iter().any(Option::is_some)).unwrap_or_default();
        Ok(Part { given, elements, crowds, was_cut: OnceLock::new() })
    };
    all.chunk_by(|one, other| one.0 == other.0).map(part).collect()
}

/// The elements of the parts with chamfered edges, in the order of their keys; `label_of: #triangles`.
fn labelled(given: &Given, label_of: &[u32], watch: &dyn Watch) -> Result<Vec<Labelled>, Error> {
    let chamfers = given.chamfers;
    let (hard, parted) = (&chamfers.edges.hard, &chamfers.edges.parted);
    let (rings, sectors) = (&chamfers.sectors.rings, chamfers.sectors);
    let label = |corner: Corner| label_of[corner.triangle().index()];
    let is_chamfered = chamfered(chamfers, label_of, watch)?;
    let mut all = Vec::with_capacity(label_of.len() + hard.len() + rings.len() + parted.len());
    let mut add = |label: u32, element: Element| {
        if is_chamfered[label as usize] {
            all.push((label, element));
        }
    };
    each(label_of.len(), watch, |triangle: ids::Triangle| {
        add(label_of[triangle.index()], Element::Surface(triangle));
    })?;
    each(hard.len(), watch, |edge: Edge| {
        if hard[edge].skipped.is_none() {
            add(label(hard[edge].sides[0]), Element::Strip(edge));
        }
    })?;
    each(rings.len(), watch, |ring: Ring| {
        if let [first, _, _, ..] = sectors.ring(ring) {
            add(label(sectors.fans[*first].first), Element::Fill(ring));
        }
    })?;
    for (place, parted) in (0..).zip(parted) {
        watch.worked(1)?;
        add(label(parted.corner), Element::Flap(place));
    }
    Ok(all)
}

/// `#labels`: whether some edge of the solid is chamfered.
fn chamfered(chamfers: Chamfers, label_of: &[u32], watch: &dyn Watch) -> Result<Vec<bool>, Error> {
    let (hard, mut is_chamfered) = (&chamfers.edges.hard, vec![false; label_of.len()]);
    each(hard.len(), watch, |edge: Edge| {
        if hard[edge].skipped.is_none() {
            is_chamfered[label_of[hard[edge].sides[0].triangle().index()] as usize] = true;
        }
    })?;
    Ok(is_chamfered)
}

/// Solid by solid, and each in the order of before; labels are below a number. Counted, as that takes
/// linear time and can be stopped anywhere.
fn together(all: &[Labelled], labels: usize, watch: &dyn Watch) -> Result<Vec<Labelled>, Error> {
    let mut starts = vec![0_u32; labels + 1];
    for stretch in stretches(all.len(), watch) {
        all[stretch?].iter().for_each(|&(label, _)| starts[label as usize + 1] += 1);
    }
    for stretch in stretches(labels, watch) {
        stretch?.for_each(|label| starts[label + 1] += starts[label]);
    }
    let mut sorted = collect(all.len(), watch, |_| all[0])?;
    for stretch in stretches(all.len(), watch) {
        for each in &all[stretch?] {
            let place = &mut starts[each.0 as usize];
            sorted[*place as usize] = *each;
            *place += 1;
        }
    }
    Ok(sorted)
}

#[cfg(test)]
mod tests {
    use std::cell::RefCell;

    use super::*;
    use crate::given::tests::given_of;
    use crate::intersect::cut_each_other;
    use crate::mesh::MeshBuffers;
    use crate::shapes;
    use crate::stages::stages_of;
    use crate::watch::Unwatched;

    /// For each part, how many elements it has.
    fn sizes(mesh: &MeshBuffers) -> Vec<usize> {
        parts(&given_of(&stages_of(mesh, 0.1)), &Unwatched)
            .unwrap()
            .iter()
            .map(|part| part.elements.len())
            .collect()
    }

    #[test]
    fn a_part_is_its_faces_edges_and_corners() {
        assert_eq!(sizes(&shapes::plain_cube(1.0)), [12 + 12 + 8]);
        assert_eq!(sizes(&shapes::cube_field(3)), [32; 3]);
        assert_eq!(sizes(&shapes::sphere(4, 6)), [], "nothing is chamfered");
    }

    #[test]
    fn what_stands_mixed_comes_together_in_its_order() {
        let all: Vec<Labelled> =
            [4, 0, 4, 2, 0].into_iter().zip((0..).map(Element::Flap)).collect();
        let sorted = together(&all, 5, &Unwatched).unwrap();
        assert_eq!(sorted, [1, 4, 3, 0, 2].map(|place: usize| all[place]));
        assert_eq!(together(&[], 0, &Unwatched).unwrap(), []);
    }

    /// The elements that cut where every sector stands at a share of its full width, whether there
    /// is room or not.
    fn cutting(mesh: &MeshBuffers, width: f32, share: f64) -> usize {
        let stages = stages_of(mesh, width);
        let placement = stages.placed(share);
        let given = given_of(&stages);
        let parts = parts(&given, &Unwatched).unwrap();
        let found = parts[0].new_cuts(&placement, &parts[0].elements, &Unwatched).unwrap();
        assert_eq!(found, each_with_each(&parts[0], &placement));
        found.len()
    }

    /// The same by comparing each with each.
    fn each_with_each(part: &Part, placement: &Placement) -> Vec<Element> {
        let (all, laid) = part.lay_out(placement, &part.elements, None, &Unwatched).unwrap();
        let cuts = |one: usize, other: usize| {
            (laid[one].is_changed || laid[other].is_changed)
                && cut_each_other(&all[one], &all[other])
        };
        let is_cut = |place: u32| {
            let own = || laid.iter().enumerate().filter(move |(_, one)| one.element == place);
            own().any(|(k, _)| (0..laid.len()).any(|other| other != k && cuts(k, other)))
        };
        let places = (0..).zip(&part.elements).filter(|(place, _)| is_cut(*place));
        places.map(|(_, element)| *element).collect()
    }

    #[test]
    fn all_cuts_are_found() {
        for (mesh, width) in [(shapes::plate(), 0.6), (shapes::l_shape(), 0.7)] {
            assert!(cutting(&mesh, width, 1.0) > 0);
            assert_eq!(cutting(&mesh, width, 0.01), 0);
        }
        assert_eq!(cutting(&shapes::plain_cube(1.0), 0.1, 1.0), 0, "there is room");
    }

    #[test]
    fn all_cuts_in_crowds_are_found() {
        assert!(cutting(&shapes::pyramid(60), 0.3, 1.0) > 0);
    }

    /// Notes what it is told, and stops the work when it is told so often.
    struct Notes {
        told: RefCell<Vec<usize>>,
        last: usize,
    }

    impl Watch for Notes {
        fn worked(&self, steps: usize) -> Result<(), Error> {
            self.told.borrow_mut().push(steps);
            if self.told.borrow().len() < self.last { Ok(()) } else { Err(Error::Cancelled) }
        }
    }

    /// A pyramid of many sides that shrinks, watched.
    fn watched(last: usize) -> (Result<(), Error>, Vec<usize>) {
        let mesh = shapes::pyramid(600);
        let stages = stages_of(&mesh, 0.3);
        let (given, placement) = (given_of(&stages), stages.placed(1.0));
        let reason = IdVec::filled(Reason::None, stages.offsets.len());
        let notes = Notes { told: RefCell::default(), last };
        let result = resolve(&given, &mut Limits { placement, reason }, &notes);
        (result, notes.told.into_inner())
    }

    #[test]
    fn the_caller_is_told_of_all_steps_a_few_at_a_time_and_can_stop_at_each() {
        let (result, told) = watched(usize::MAX);
        assert!(result.is_ok());
        // Its 1,198 faces, 600 strips of two and 601 fills, of which one has 600 sides, in a tree.
        let most = told.iter().max().unwrap();
        assert!(*most < 2 * 4_000, "{most} steps between two calls");
        assert!(told.iter().sum::<usize>() > 50 * 4_000 && told.len() > 100, "{}", told.len());
        for last in (1..=told.len()).step_by(told.len() / 40) {
            let (result, told) = watched(last);
            assert!(matches!(result, Err(Error::Cancelled)) && told.len() == last);
        }
    }
}
