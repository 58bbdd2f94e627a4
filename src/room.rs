//! Room: the shares at which the source triangles keep enough of their area and breadth.
//!
//! All sectors grow together. When a triangle has given away what it can, the sectors that press
//! on it stop, and the others grow on: so no sector gets less than it must, and two that compete
//! for one face get the same (progressive filling; D. Bertsekas and R. Gallager, "Data Networks",
//! 1992, calls the outcome max-min fair).

pub mod breadth;

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use glam::DVec3;

use crate::error::Error;
use crate::given::Given;
use crate::ids::{Corner, Few, IdVec, Sector, Triangle};
use crate::math::area_vector;
use crate::offsets::{Offset, parts};
use crate::resample::told_share;
use crate::sectors::Sectors;
use crate::surface::Surface;
use crate::threads::Threads;
use crate::watch::{Watch, sort};

/// A triangle may give away all but this share of its area. Somewhat more than what validity asks
/// for, so that rounding does not undo it.
const LEAST_SHARE: f64 = 0.02;

/// So many times the breadth that has to stay does, for the same reason.
const SAFETY: f64 = 1.0005;

/// How far the sectors can go.
pub struct Room {
    /// `#sectors by 2`: the largest share, up to 1, at which its first and its last edge leave room in
    /// all triangles of the sector.
    pub fronts: IdVec<Sector, [f64; 2]>,
    pub parts: KnownParts,
}

impl Room {
    /// `#sectors`: of the front that has more, of offsets that pull each as far as it has room
    /// (`given`); as far as what is painted on the mesh can be told.
    ///
    /// # Errors
    /// [`Error::Cancelled`] where the watch stops it.
    pub fn shares(&self, given: &Given, watch: &dyn Watch) -> Result<IdVec<Sector, f64>, Error> {
        let Given { surface, chamfers, offsets, .. } = *given;
        let is_painted = surface.view.is_painted();
        given.threads.map(
            self.fronts.len(),
            watch,
            #[inline(always)]
            |sector| {
                let [first, last] = self.fronts[sector];
                let share = larger(first, last);
                let told = || told_share(surface, chamfers.sectors, &offsets[sector], sector);
                if is_painted && share > 0.0 { smaller(share, told()) } else { share }
            },
        )
    }
}

/// The parts of offsets, each found when it is first asked for: see [`parts`].
pub struct KnownParts {
    /// `#sectors`: a place in the parts, or one of the two below.
    place: IdVec<Sector, u32>,
    parts: Vec<[DVec3; 2]>,
}

/// Nobody has asked yet.
const UNKNOWN: u32 = u32::MAX;

/// Both fronts go together.
const TOGETHER: u32 = u32::MAX - 1;

impl KnownParts {
    fn new(sectors: usize) -> KnownParts {
        KnownParts { place: IdVec::filled(UNKNOWN, sectors), parts: Vec::new() }
    }

    /// What pulls a sector's first and its last edge; none where both go together.
    pub fn of(&mut self, given: &Given, sector: Sector) -> Option<[DVec3; 2]> {
        if self.place[sector] == UNKNOWN {
            let Given { surface, chamfers, offsets, .. } = *given;
            let found = parts(surface, chamfers.sectors, sector, &offsets[sector]);
            self.place[sector] = found.map_or(TOGETHER, |_| self.parts.len() as u32);
            self.parts.extend(found);
        }
        self.known(sector)
    }

    /// The same where somebody has asked before.
    fn known(&self, sector: Sector) -> Option<[DVec3; 2]> {
        self.parts.get(self.place[sector] as usize).copied()
    }
}

/// `#triangles`: whether it is so large for how far its corners can go that it keeps its way and most of
/// its area and breadth wherever they stand, and half of each side. They take at most their way
/// along its sides of twice its area, and what two of them span; a breadth is that over the length of a
/// side. Half of its area is left then, within thirty degrees of its old plane, and no side turns around;
/// and as rounding counts, it is so where the corners are stored.
///
/// # Errors
/// [`Error::Cancelled`] where the watch stops it.
pub fn plenty(
    Surface { view, faces, .. }: Surface,
    sectors: &Sectors,
    offsets: &IdVec<Sector, Offset>,
    (threads, watch): (&Threads, &dyn Watch),
) -> Result<IdVec<Triangle, bool>, Error> {
    let stays = (1.0 - PLENTY) / view.least_breadth.max(LEAST_SHARE);
    let most_of_side = (stays / SAFETY - 1.0) / 2.0;
    let way_of = |sector: Sector| {
        if sector.is_some() { offsets[sector].vector.length_squared() } else { 0.0 }
    };
    threads.map(faces.normal.len(), watch, |triangle: Triangle| {
        let ways = triangle.corners().map(|corner| way_of(sectors.sector_of[corner]));
        let way = larger(larger(ways[0], ways[1]), ways[2]).sqrt() + view.resolution;
        let [a, b, c] = view.triangle(triangle);
        let sides = [b - a, c - b, a - c].map(DVec3::length_squared);
        // Three numbers are at most as much together as if all were their root mean square.
        let sum = (3.0 * (sides[0] + sides[1] + sides[2])).sqrt();
        let shortest = smaller(smaller(sides[0], sides[1]), sides[2]);
        way * (sum + 3.0 * way) < PLENTY * area_vector([a, b, c]).length()
            && way < most_of_side * shortest.sqrt()
            && !faces.is_line(triangle)
    })
}

/// Of two numbers; of what is none it does not matter which.
fn larger(one: f64, other: f64) -> f64 {
    if one > other { one } else { other }
}

/// The same.
fn smaller(one: f64, other: f64) -> f64 {
    if one < other { one } else { other }
}

/// The room that there is.
///
/// # Errors
/// [`Error::Cancelled`] where the watch stops it.
pub fn room(given: &Given, watch: &dyn Watch) -> Result<Room, Error> {
    let share = |sector: Sector| [if given.offsets[sector].moves() { GROWING } else { 0.0 }; 2];
    let fronts = given.threads.map(given.offsets.len(), watch, share)?;
    let parts = KnownParts::new(fronts.len());
    let (first, later, due) = (Vec::new(), BinaryHeap::new(), IdVec::default());
    let mut filling = Filling { given, fronts, parts, first, later, due };
    let triangles = given.surface.faces.normal.len();
    filling.due = given.threads.map(triangles, watch, |triangle| {
        let event = if given.plenty[triangle] { None } else { filling.event(triangle, 0.0) };
        event.map_or(GROWING, |event| event.share)
    })?;
    let pressed = filling.due.ids().filter(|&triangle| filling.due[triangle] != GROWING);
    let event = |triangle| Event { share: filling.due[triangle], triangle };
    filling.first = pressed.map(event).collect();
    sort(&mut filling.first, watch)?;
    while let Some(event) = filling.next_event() {
        watch.worked(1)?;
        filling.stop_around(&event);
    }
    let Filling { mut fronts, parts, .. } = filling;
    fronts.iter_mut().for_each(|fronts| *fronts = fronts.map(|share| share.min(1.0)));
    Ok(Room { fronts, parts })
}

/// A triangle that has given away all it can when everything has grown to a share.
struct Event {
    share: f64,
    triangle: Triangle,
}

impl Ord for Event {
    /// The smallest share comes first, and of equal ones the first triangle.
    fn cmp(&self, other: &Event) -> Ordering {
        other.share.total_cmp(&self.share).then(other.triangle.cmp(&self.triangle))
    }
}

impl PartialOrd for Event {
    fn partial_cmp(&self, other: &Event) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Event {
    fn eq(&self, other: &Event) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Event {}

struct Filling<'a> {
    given: &'a Given<'a>,
    /// `#sectors by 2`: the shares at which the fronts of each stopped. Those that are unlike have
    /// parts that are known.
    fronts: IdVec<Sector, [f64; 2]>,
    parts: KnownParts,
    /// What is known from the beginning, the earliest last. Nearly all events are: sorting them
    /// once takes less time than a heap of all.
    first: Vec<Event>,
    later: BinaryHeap<Event>,
    /// `#triangles`: the share of the event that counts, which others have taken the place of.
    due: IdVec<Triangle, f64>,
}

/// The share of a front that has not stopped.
const GROWING: f64 = f64::INFINITY;

/// A triangle whose corners go so little of its area, as [`plenty`] counts it, keeps all that it has to.
const PLENTY: f64 = 0.5;

/// What of a sector grows by itself.
#[derive(Clone, Copy)]
struct Load {
    /// The front; none where both go together.
    front: Option<usize>,
    growth: DVec3,
}

/// A triangle whose corners move in proportion to a common share, or stopped before.
struct Moving {
    /// The corners at share 0, the stopped ones where they stopped.
    start: [DVec3; 3],
    /// How each corner moves; zero where it stopped.
    growth: [DVec3; 3],
    /// Its area counts along this direction.
    normal: DVec3,
    /// The least that it may come down to.
    least: f64,
    /// `#sides`: the same, for each unit of the side's length along this vector.
    over: [DVec3; 3],
    /// What it may be off that by rounding.
    slack: f64,
}

impl Filling<'_> {
    fn sectors(&self, triangle: Triangle) -> [Sector; 3] {
        triangle.corners().map(|corner| self.given.chamfers.sectors.sector_of[corner])
    }

    /// The earliest event that is left.
    fn next_event(&mut self) -> Option<Event> {
        // The greater one comes first.
        if self.first.last() > self.later.peek() { self.first.pop() } else { self.later.pop() }
    }

    fn moving(&self, triangle: Triangle) -> Moving {
        let old = self.given.surface.view.triangle(triangle);
        let growth = [DVec3::ZERO; 3];
        let mut moving = Moving { start: old, growth, ..self.allowance(triangle, old) };
        for (k, sector) in self.sectors(triangle).into_iter().enumerate() {
            if sector.is_some() {
                let (whole, fronts) = (self.given.offsets[sector].vector, self.fronts[sector]);
                if fronts == [GROWING; 2] {
                    moving.growth[k] = whole;
                } else if fronts[0] == fronts[1] {
                    moving.start[k] += whole * fronts[0];
                } else {
                    let parts = self.parts.known(sector).unwrap_or_default();
                    for (part, share) in parts.into_iter().zip(fronts) {
                        if share == GROWING {
                            moving.growth[k] += part;
                        } else {
                            moving.start[k] += part * share;
                        }
                    }
                }
            }
        }
        moving
    }

    /// A triangle that does not move, with what has to be left of it.
    fn allowance(&self, triangle: Triangle, start: [DVec3; 3]) -> Moving {
        let (faces, area, growth) =
            (&self.given.surface.faces, area_vector(start), [DVec3::ZERO; 3]);
        if !faces.is_line(triangle) {
            let whole = area.length_squared();
            let (least, slack) = (LEAST_SHARE * whole, EXHAUSTED * whole);
            let share = (self.given.surface.view.least_breadth * SAFETY).min(1.0);
            let over = breadth::least(self.given, triangle, start, share);
            return Moving { start, growth, normal: area, least, over, slack };
        }
        // A line may not fold over, but for what rounding does.
        let longest = (0..3).map(|k| start[k].distance(start[(k + 1) % 3])).fold(0.0, f64::max);
        let rounding = longest * self.given.surface.view.resolution / 2.0;
        let normal = faces.normal[triangle];
        let least = area.dot(normal).min(0.0) - rounding;
        let slack = rounding * EXHAUSTED;
        Moving { start, growth, normal, least, over: [DVec3::ZERO; 3], slack }
    }

    /// A triangle, when it will have given away all it can, and of what. Heights that do not count
    /// are only told from those that do where they run out.
    fn exhausted(&self, triangle: Triangle, from: f64) -> Option<(Moving, f64, Bound)> {
        let mut moving = self.moving(triangle);
        loop {
            let (share, bound) = moving.exhausted_at(from)?;
            match bound {
                Bound::Height(k) if share < 1.0 && self.goes_on(triangle, k) => {
                    moving.over[k] = DVec3::ZERO;
                }
                _ => return Some((moving, share, bound)),
            }
        }
    }

    fn goes_on(&self, triangle: Triangle, side: usize) -> bool {
        breadth::goes_on(self.given, triangle, side, self.given.surface.view.triangle(triangle))
    }

    /// When the triangle will have given away all it can, from a share on.
    fn event(&self, triangle: Triangle, from: f64) -> Option<Event> {
        if !self.sectors(triangle).into_iter().any(|sector| self.is_growing(sector)) {
            return None;
        }
        let (_, share, _) = self.exhausted(triangle, from)?;
        (share < 1.0).then_some(Event { share, triangle })
    }

    fn is_growing(&self, sector: Sector) -> bool {
        sector.is_some() && self.fronts[sector].contains(&GROWING)
    }

    /// What of a sector grows by itself.
    fn loads(&mut self, sector: Sector) -> [Option<Load>; 2] {
        if !self.is_growing(sector) {
            return [None; 2];
        }
        match self.parts.of(self.given, sector) {
            None => [Some(Load { front: None, growth: self.given.offsets[sector].vector }), None],
            Some(parts) => [0, 1].map(|front| {
                let grows = self.fronts[sector][front] == GROWING;
                grows.then_some(Load { front: Some(front), growth: parts[front] })
            }),
        }
    }

    /// Stops what of a sector grows by itself.
    fn stop(&mut self, sector: Sector, front: Option<usize>, at: f64) {
        match front {
            None => self.fronts[sector] = [at; 2],
            Some(front) => self.fronts[sector][front] = at,
        }
    }

    /// Stops what presses on an exhausted triangle.
    fn stop_around(&mut self, event: &Event) {
        if self.due[event.triangle] != event.share {
            return;
        }
        self.due[event.triangle] = GROWING;
        let Some((moving, _, bound)) = self.exhausted(event.triangle, event.share) else { return };
        let sectors = self.sectors(event.triangle);
        let loads = sectors.map(|sector| self.loads(sector));
        let takes = |k: usize, load: &Load| moving.takes(k, load.growth, event.share, bound);
        // All of them if none does alone.
        let any = (0..3).any(|k| loads[k].iter().flatten().any(|load| takes(k, load)));
        let mut pressing = [false; 3];
        for k in 0..3 {
            for load in loads[k].iter().flatten().filter(|load| !any || takes(k, load)) {
                pressing[k] = true;
                self.stop(sectors[k], load.front, event.share);
            }
        }
        for k in (0..3).filter(|&k| pressing[k]) {
            let is_seen = |triangle: Triangle| {
                let around = self.sectors(triangle);
                (0..k).any(|seen| pressing[seen] && around.contains(&sectors[seen]))
            };
            let corners =
                self.given.chamfers.sectors.corners(self.given.surface.topology, sectors[k]);
            let triangles = corners.map(Corner::triangle).filter(|&triangle| !is_seen(triangle));
            triangles
                .collect::<Few<Triangle>>()
                .into_iter()
                .for_each(|t| self.renew(t, event.share));
        }
    }

    /// Puts a triangle's event where it belongs once something around it has stopped.
    fn renew(&mut self, triangle: Triangle, at: f64) {
        let event = self.event(triangle, at);
        let share = event.as_ref().map_or(GROWING, |event| event.share);
        if self.due[triangle] != share {
            self.due[triangle] = share;
            self.later.extend(event);
        }
    }
}

/// What a triangle can run out of.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Bound {
    Area,
    /// The height over the side of this number.
    Height(usize),
}

const BOUNDS: [Bound; 4] = [Bound::Area, Bound::Height(0), Bound::Height(1), Bound::Height(2)];

impl Moving {
    fn at(&self, share: f64) -> [DVec3; 3] {
        [0, 1, 2].map(|k| self.start[k] + self.growth[k] * share)
    }

    /// The first share, not before `from`, at which no more is left than has to be, and of what.
    fn exhausted_at(&self, from: f64) -> Option<(f64, Bound)> {
        let corners = self.at(from);
        let [a, b, c] = corners;
        let [grow_a, grow_b, grow_c] = self.growth;
        let (ab, ac) = (b - a, c - a);
        let (grow_ab, grow_ac) = (grow_b - grow_a, grow_c - grow_a);
        let area = self.normal.dot(ab.cross(ac));
        let linear = self.normal.dot(ab.cross(grow_ac) + grow_ab.cross(ac));
        let square = self.normal.dot(grow_ab.cross(grow_ac));
        let of = |bound: Bound| {
            let [least, grows] = self.least(bound, [corners, self.growth])?;
            let share = self.spent([area - least, linear - grows, square], from)?;
            Some((share, bound))
        };
        // Of equal ones the first.
        BOUNDS.into_iter().filter_map(of).min_by(|one, other| one.0.total_cmp(&other.0))
    }

    /// The least area that a bound asks for, of corners and of how they grow; none if it asks for
    /// nothing.
    fn least(&self, bound: Bound, [corners, growth]: [[DVec3; 3]; 2]) -> Option<[f64; 2]> {
        match bound {
            Bound::Area => Some([self.least, 0.0]),
            Bound::Height(k) if self.over[k] == DVec3::ZERO => None,
            Bound::Height(k) => {
                let along = |points: [DVec3; 3]| points[(k + 1) % 3] - points[k];
                Some([corners, growth].map(|points| self.over[k].dot(along(points))))
            }
        }
    }

    /// The first share, not before `from`, at which nothing is to spare: a root of a quadratic
    /// function of what the share has grown since.
    fn spent(&self, [spare, linear, square]: [f64; 3], from: f64) -> Option<f64> {
        // Rounding leaves a triangle that was stopped a little above or below its limit.
        if spare <= self.slack {
            return (linear < -self.slack).then_some(from);
        }
        // Where even what both terms take together leaves some, there is no root before share 1.
        let taken = linear.min(0.0) + square.min(0.0);
        if spare + taken > self.slack {
            return None;
        }
        first_root(square, linear, spare).map(|further| from + further)
    }

    /// Whether a growth of one corner takes away what runs out.
    fn takes(&self, k: usize, growth: DVec3, share: f64, bound: Bound) -> bool {
        let corners = self.at(share);
        let opposite = corners[(k + 1) % 3] - corners[(k + 2) % 3];
        let mut alone = [DVec3::ZERO; 3];
        alone[k] = growth;
        let asked = self.least(bound, [corners, alone]).map_or(0.0, |[_, grows]| grows);
        growth != DVec3::ZERO && self.normal.dot(growth.cross(opposite)) < asked - self.slack
    }
}

/// Within this share of the old area of its limit, a triangle is taken to have reached it.
const EXHAUSTED: f64 = 1e-9;

/// The smallest positive root of `square t^2 + linear t + constant`, for a positive constant.
fn first_root(square: f64, linear: f64, constant: f64) -> Option<f64> {
    let discriminant = linear * linear - 4.0 * square * constant;
    if discriminant < 0.0 {
        return None;
    }
    // The form that does not cancel; with a positive constant it is the root that comes first.
    let denominator = -linear + discriminant.sqrt();
    (denominator > 0.0).then(|| 2.0 * constant / denominator)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::given::tests::given_of;
    use crate::mesh::MeshBuffers;
    use crate::options::{Options, Width};
    use crate::shapes;
    use crate::stages::stages_with;
    use crate::watch::Unwatched;

    #[test]
    fn the_first_root_is_the_smallest_positive_one() {
        assert_eq!(first_root(1.0, -3.0, 2.0), Some(1.0));
        assert_eq!(first_root(0.0, -2.0, 1.0), Some(0.5));
        assert_eq!(first_root(-1.0, 0.0, 4.0), Some(2.0));
        assert_eq!(first_root(1.0, 1.0, 1.0), None);
        assert_eq!(first_root(1.0, 3.0, 2.0), None, "both roots are negative");
    }

    /// A unit right triangle whose corners move along x as given.
    fn moving(growth: [f64; 3]) -> Moving {
        let start = [DVec3::ZERO, DVec3::X, DVec3::Y];
        let growth = growth.map(|x| DVec3::X * x);
        let (normal, least, slack) = (DVec3::Z, LEAST_SHARE, EXHAUSTED);
        Moving { start, growth, normal, least, over: [DVec3::ZERO; 3], slack }
    }

    /// Which corners take away what runs out.
    fn taking(moving: &Moving, share: f64, bound: Bound) -> [bool; 3] {
        [0, 1, 2].map(|k| moving.takes(k, moving.growth[k], share, bound))
    }

    /// The shares of both fronts of each sector, on one face of a box of 4 by 1 by 4: a sector has
    /// its first edge along x or along z.
    fn shares_on(face: DVec3, mesh: &MeshBuffers, width: f32) -> Vec<(DVec3, [f64; 2])> {
        let stages = stages_with(mesh, &asking(width));
        let room = room(&given_of(&stages), &Unwatched).unwrap();
        let on_face = |sector: &Sector| {
            let corner = stages.sectors.fans[*sector].first;
            stages.faces.normal[corner.triangle()].dot(face) > 0.9
        };
        let of = |sector: Sector| {
            let first = stages.sectors.fans[sector].first;
            let along = stages.view.position_at(first.next()) - stages.view.position_at(first);
            (along.abs().normalize(), room.fronts[sector])
        };
        room.fronts.ids().filter(on_face).map(of).collect()
    }

    fn asking(width: f32) -> Options {
        let width = Width::Units(width);
        Options { width, least_breadth: 0.2, ..Options::default() }
    }

    // .-----------------------.     a side of a slab: too thin for both its long edges, which get
    // |.                     .|     two fifths of it each; its short edges have all the room that
    // '-----------------------'     they ask for
    #[test]
    fn an_edge_with_room_is_not_narrowed_by_one_beside_it() {
        let mut slab = shapes::plain_cube(4.0);
        slab.positions.iter_mut().for_each(|at| at[1] /= 4.0);
        let shares = shares_on(DVec3::X, &slab, 0.8);
        assert_eq!(shares.len(), 4);
        for (along, [first, last]) in shares {
            let (long, short) = if along == DVec3::Z { (first, last) } else { (last, first) };
            assert_eq!(short, 1.0, "{along} {first} {last}");
            assert!((long - 0.5).abs() < 0.001, "{long}");
        }
    }

    // Edges that run on nearly straight, as around a rim, are pulled together.
    #[test]
    fn edges_that_run_on_go_together() {
        let mesh = shapes::cylinder(24);
        let shares = shares_on(DVec3::Y, &mesh, 0.6);
        assert_eq!(shares.len(), 24);
        assert!(shares.iter().all(|(_, [one, other])| one == other && *one < 1.0), "{shares:?}");
    }

    #[test]
    fn corners_that_approach_each_other_stop_together() {
        let moving = moving([1.0, -1.0, 0.0]);
        let (share, bound) = moving.exhausted_at(0.0).unwrap();
        assert!((share - 0.49).abs() < 1e-12);
        assert_eq!(taking(&moving, share, bound), [true, true, false]);
    }

    #[test]
    fn a_corner_that_gives_room_does_not_stop() {
        let moving = moving([2.0, 0.5, 0.0]);
        let (share, bound) = moving.exhausted_at(0.0).unwrap();
        assert_eq!(taking(&moving, share, bound), [true, false, false]);
    }

    // 2
    // | .         its height over the side 0-1 may come down to a fifth: 2 stops, and 0 and 1,
    // |   .       which draw near each other, do not take it away
    // 0-----1
    #[test]
    fn who_takes_a_height_away_stops_and_who_shortens_the_side_does_not() {
        let mut moving = moving([0.1, -0.1, 0.0]);
        moving.growth[2] = -DVec3::Y;
        moving.over[0] = DVec3::X * 0.2;
        let (share, bound) = moving.exhausted_at(0.0).unwrap();
        assert_eq!(bound, Bound::Height(0));
        assert!((share - 0.8).abs() < 1e-12);
        assert_eq!(taking(&moving, share, bound), [false, false, true]);
    }
}
