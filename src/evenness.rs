//! Evenness: widths that do not jump.
//!
//! Where something stands in the way of one end of an edge, its chamfer narrows there. The eye takes
//! an edge for one, so the rest of it narrows as well, by and by: along a side of an edge, and on
//! along those that it runs on into, a width is at most its neighbour's and what the way between
//! them allows. And of the two sides of an end neither is much wider than the other.
//! Widths only fall, the narrowest first, so each is looked at once.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use glam::DVec3;

use crate::error::Error;
use crate::given::Given;
use crate::ids::{Corner, Edge, Id, Sector};
use crate::room::Room;
use crate::tolerance::CREASE_COSINE;
use crate::watch::{Watch, stretches};

/// At an evenness of a half, how much wider a chamfer may get along its edge for each unit of the
/// way: from nothing to the whole width in four hundred widths. With four times as much an edge of ten
/// widths may be a tenth wider at one end, which shows, and along a model's longest edges half as much
/// still adds up.
const SLOPE: f64 = 0.0025;

/// A side that has less than this share of its width is not pulled at all, as where broken triangles
/// are in the way: it has no say in the other one, of which nothing would be left.
const LEAST_SHARE: f64 = 0.01;

/// So many sectors around a vertex are looked at for the edge that another one runs on into: where
/// more meet, as at the tip of a cone, none does, and looking at all for each would take quadratic
/// time.
const MOST_AROUND: usize = 8;

/// What of a sector is pulled from one of its two edges: the first or the last.
type Front = (Sector, usize);

/// Narrows what is next to something narrow, so far as an evenness of 0 (not at all) to 1 asks: at
/// 1 a side of an edge has one width, and both sides the same; at a half one side may be twice as
/// wide as the other.
///
/// # Errors
/// [`Error::Cancelled`] where the watch stops it.
pub fn evenness(
    given: &Given,
    room: Room,
    evenness: f64,
    watch: &dyn Watch,
) -> Result<Room, Error> {
    if evenness == 0.0 {
        return Ok(room);
    }
    let (slope, lopsided) = (SLOPE * (1.0 - evenness) / evenness, 1.0 / evenness);
    let mut leveling = Leveling { given, slope, lopsided, room, narrow: BinaryHeap::new() };
    leveling.narrow = leveling.seeds(watch)?;
    while let Some(Narrow { share, front }) = leveling.narrow.pop() {
        watch.worked(STEPS_OF_FRONT)?;
        if share == leveling.share(front) {
            for (other, most) in leveling.linked(front, share).into_iter().flatten() {
                leveling.lower(other, most);
            }
        }
    }
    Ok(leveling.room)
}

/// So many steps it takes to find a front in a large heap, and all that it is linked to.
const STEPS_OF_FRONT: usize = 4;

struct Leveling<'a> {
    given: &'a Given<'a>,
    slope: f64,
    /// How many times as wide as the other one a side of an end may be.
    lopsided: f64,
    room: Room,
    narrow: BinaryHeap<Narrow>,
}

/// A front that has less than the whole width.
#[derive(PartialEq)]
struct Narrow {
    share: f64,
    front: Front,
}

impl Eq for Narrow {}

impl Ord for Narrow {
    /// The narrowest comes first, and of equal ones the first.
    fn cmp(&self, other: &Narrow) -> Ordering {
        other.share.total_cmp(&self.share).then(other.front.cmp(&self.front))
    }
}

impl PartialOrd for Narrow {
    fn partial_cmp(&self, other: &Narrow) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Leveling<'_> {
    /// The fronts that narrow others from the beginning: few of those that are narrow. The others can
    /// only come to do so when they are lowered themselves.
    fn seeds(&mut self, watch: &dyn Watch) -> Result<BinaryHeap<Narrow>, Error> {
        let mut seeds = BinaryHeap::new();
        for stretch in stretches(self.room.fronts.len(), watch) {
            for sector in stretch?.map(Sector::new) {
                // Most are as wide as asked.
                if self.room.fronts[sector] != [1.0; 2] && self.given.offsets[sector].moves() {
                    seeds.extend([0, 1].into_iter().filter_map(|which| self.seed((sector, which))));
                }
            }
        }
        Ok(seeds)
    }

    fn seed(&mut self, front: Front) -> Option<Narrow> {
        let share = self.share(front);
        if share >= 1.0 {
            return None;
        }
        let mut linked = self.linked(front, share).into_iter().flatten();
        linked.any(|(other, most)| self.has_more(other, most)).then_some(Narrow { share, front })
    }

    fn share(&self, (sector, which): Front) -> f64 {
        self.room.fronts[sector][which]
    }

    fn has_more(&self, front: Front, most: f64) -> bool {
        let (sector, _) = front;
        sector.is_some() && self.given.offsets[sector].moves() && self.share(front) > most
    }

    /// The half-edge that a front is pulled from, on the sector's own side.
    #[inline]
    fn side(&self, (sector, which): Front) -> Corner {
        let fan = &self.given.chamfers.sectors.fans[sector];
        if which == 0 { fan.first } else { fan.last.prev() }
    }

    #[inline]
    fn edge(&self, front: Front) -> Edge {
        self.given.chamfers.edges.chamfered_at[self.side(front)]
    }

    /// From a front's vertex along its edge.
    fn way(&self, front: Front) -> DVec3 {
        let side = self.side(front);
        let [from, to] = [side, side.next()].map(|c| self.given.surface.view.position_at(c));
        if front.1 == 0 { to - from } else { from - to }
    }

    /// The sector on the other side of a front's edge, at the same vertex.
    #[inline]
    fn across(&self, front: Front) -> Sector {
        let twin = self.given.surface.topology.twin[self.side(front)];
        let corner = if front.1 == 0 { twin.next() } else { twin };
        self.given.chamfers.sectors.sector_of[corner]
    }

    /// The front of the edge that a front's edge runs straight on into, on the same side of both, where
    /// other edges end there on that side; none where it has no more than a share anyway. (Where no
    /// other edge ends there it is the same sector's, and the two go together.)
    fn onward(&self, front: Front, share: f64) -> Option<Front> {
        let sectors = self.given.chamfers.sectors;
        let around = sectors.ring(sectors.fans[front.0].ring).len();
        let mut other = (front.0, 1 - front.1);
        // Of the edges around, two are those of the front's own sector.
        for _ in 2..around.min(MOST_AROUND) {
            if self.edge(other).is_none() {
                return None;
            }
            other.0 = self.across(other);
            if self.has_more(other, share) && runs_on(self.way(front), self.way(other)) {
                return self.edge(other).is_some().then_some(other);
            }
        }
        None
    }

    /// The fronts next to one, and the most that each may have: along its edge, on along the edge
    /// that this one runs on into, across it, and that which goes together with it.
    fn linked(&mut self, front: Front, share: f64) -> [Option<(Front, f64)>; 4] {
        let mut linked = [None; 4];
        let ((sector, which), given) = (front, self.given);
        let (side, edge, sectors) = (self.side(front), self.edge(front), given.chamfers.sectors);
        let at = |corner: Corner| sectors.sector_of[corner];
        if edge.is_some() {
            let (far, across) = (if which == 0 { side.next() } else { side }, self.across(front));
            let along = (at(far), 1 - which);
            let [from, to] = [side, side.next()].map(|c| given.surface.view.position_at(c));
            let width = given.chamfers.edges.hard[edge].widest();
            linked[0] = Some((along, share + self.slope * from.distance(to) / width));
            if share >= LEAST_SHARE {
                linked[1] = Some(((across, 1 - which), share * self.lopsided));
                linked[3] = self.onward(front, share).map(|onward| (onward, share));
            }
        }
        let other = (sector, 1 - which);
        if self.share(other) > share && self.room.parts.of(given, sector).is_none() {
            linked[2] = Some((other, share));
        }
        linked
    }

    /// Lowers a front to what it may have.
    fn lower(&mut self, front: Front, most: f64) {
        if self.has_more(front, most) {
            self.room.fronts[front.0][front.1] = most;
            self.narrow.push(Narrow { share: most, front });
        }
    }
}

/// Whether two edges that meet, each told by the way from there, run straight on into each other.
fn runs_on(one: DVec3, other: DVec3) -> bool {
    let (cosine, lengths) = (one.dot(other), one.length_squared() * other.length_squared());
    cosine < 0.0 && cosine * cosine > CREASE_COSINE * CREASE_COSINE * lengths
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::given::tests::given_of;
    use crate::ids::Id;
    use crate::mesh::{Factors, Mesh, MeshBuffers};
    use crate::options::{Options, Width};
    use crate::shapes;
    use crate::stages::{Stages, split, stages_of, stages_of_mesh};
    use crate::strips;
    use crate::watch::Unwatched;

    fn room(given: &Given) -> Room {
        crate::room::room(given, &Unwatched).unwrap()
    }

    fn evened(given: &Given, room: Room, even: f64) -> Room {
        evenness(given, room, even, &Unwatched).unwrap()
    }

    /// The shares of an edge in the order of its strip's corners, where one front has so little
    /// room that it narrows all around it.
    fn shares(stages: &Stages, edge: Edge, narrow: f64, even: f64) -> [f64; 4] {
        let given = given_of(stages);
        let mut room = room(&given);
        let sectors = sectors(stages, edge);
        room.fronts[sectors[1]] = [narrow, 1.0];
        let room = evened(&given, room, even);
        let share = |(place, front): (usize, usize)| room.fronts[sectors[place]][front];
        [(0, 1), (1, 0), (2, 1), (3, 0)].map(share)
    }

    fn sectors(stages: &Stages, edge: Edge) -> [Sector; 4] {
        strips::corners(&stages.edges.hard[edge]).map(|c| stages.sectors.sector_of[c])
    }

    #[track_caller]
    fn assert_near(shares: [f64; 4], expected: [f64; 4]) {
        let is_near = shares.iter().zip(expected).all(|(one, other)| (one - other).abs() < 1e-6);
        assert!(is_near, "{shares:?}");
    }

    // b2------------a2      an edge of a cube of ten widths: a1 has little room, a2 may be twice as
    // |              |      wide; a quarter of a hundredth of the way more at the other end
    // b1------------a1
    #[test]
    fn a_width_grows_along_its_edge_and_twice_across_it() {
        let cube = shapes::plain_cube(1.0);
        let stages = stages_of(&cube, 0.1);
        assert_near(shares(&stages, Edge(0), 0.3, 0.5), [0.325, 0.3, 0.6, 0.625]);
        assert_near(shares(&stages, Edge(0), 0.3, 1.0), [0.3; 4]);
        assert_near(shares(&stages, Edge(0), 0.3, 0.0), [1.0, 0.3, 1.0, 1.0]);
    }

    #[test]
    fn a_side_that_is_not_pulled_at_all_has_no_say_in_the_other() {
        let cube = shapes::plain_cube(1.0);
        let stages = stages_of(&cube, 0.1);
        assert_near(shares(&stages, Edge(0), 0.0, 0.5), [0.025, 0.0, 0.075, 0.05]);
    }

    // b------------a      at a corner of the cube edges are to be twice as wide: the slope is told by
    // :            |      the wider end
    #[test]
    fn a_width_grows_by_the_larger_of_what_is_asked_at_both_ends() {
        let cube = shapes::plain_cube(1.0);
        let start = stages_of(&cube, 0.1).edges.hard[Edge(0)].sides[0];
        let wide = cube.positions[cube.indices[start.index()] as usize];
        let mask: Vec<f32> =
            cube.positions.iter().map(|at| if *at == wide { 2.0 } else { 1.0 }).collect();
        let factors = Factors { vertices: &mask, ..Factors::default() };
        let options = Options::default().with_width(Width::Units(0.1));
        let stages = stages_of_mesh(Mesh { factors, ..cube.as_mesh() }, &options);
        let [one, other] = stages.edges.hard[Edge(0)].widths;
        assert!((one - 0.2).abs() < 1e-6 && (other - 0.1).abs() < 1e-6, "{one}, {other}");
        assert_near(shares(&stages, Edge(0), 0.3, 0.5), [0.3125, 0.3, 0.6, 0.6125]);
    }

    /// A block whose front leans back on its right half, with the triangle between; its front edge on
    /// top runs straight on over where the two halves meet.
    fn leaning_block() -> MeshBuffers {
        let top = [[-2.0, 1.0, 1.0], [0.0, 1.0, 1.0], [2.0, 1.0, 1.0], [2.0, 1.0, -2.0]];
        let rest = [[-2.0, 1.0, -2.0], [-2.0, -1.0, 1.0], [0.0, -1.0, 1.0], [0.0, -1.0, 0.0]];
        let bottom = [[2.0, -1.0, 0.0], [2.0, -1.0, -2.0], [-2.0, -1.0, -2.0]];
        let points = [&top[..], &rest[..], &bottom[..]].concat();
        let fans: [&[u32]; 8] = [
            &[4, 0, 1, 2, 3],
            &[5, 6, 1, 0],
            &[1, 6, 7],
            &[7, 8, 2, 1],
            &[8, 9, 3, 2],
            &[9, 10, 4, 3],
            &[10, 5, 0, 4],
            &[7, 6, 5, 10, 9, 8],
        ];
        let triangles = |fan: &[u32]| -> Vec<u32> {
            fan[1..].windows(2).flat_map(|pair| [fan[0], pair[0], pair[1]]).collect()
        };
        let indices: Vec<u32> = fans.iter().flat_map(|fan| triangles(fan)).collect();
        split(&points, &indices)
    }

    /// A mesh without those triangles of which something is true: so many.
    fn without(mesh: &MeshBuffers, count: usize, is_left: impl Fn(&[u32]) -> bool) -> MeshBuffers {
        let kept = mesh.indices.chunks(3).filter(|corners| !is_left(corners));
        let indices: Vec<u32> = kept.flatten().copied().collect();
        assert_eq!(indices.len() + 3 * count, mesh.indices.len());
        MeshBuffers { submesh_index_counts: vec![indices.len() as u32], indices, ..mesh.clone() }
    }

    /// The sectors of its front at 1, on the left and on the right half.
    fn in_front(stages: &Stages) -> [Sector; 2] {
        let at = |corner: Corner| stages.view.mesh.positions[stages.view.vertex_at(corner).index()];
        let side = |from: [f32; 3], to: [f32; 3]| {
            let mut sides = stages.topology.twin.ids();
            sides.find(|&side| [at(side), at(side.next())] == [from, to]).unwrap()
        };
        let right = side([2.0, 1.0, 1.0], [0.0, 1.0, 1.0]).next();
        [side([0.0, 1.0, 1.0], [-2.0, 1.0, 1.0]), right].map(|c| stages.sectors.sector_of[c])
    }

    // 0------1------2     without the triangle between there is a gap, and nothing runs on over it
    // | left | right|
    // 5------6 7----8
    #[test]
    fn an_edge_does_not_run_on_over_a_gap() {
        let block = leaning_block();
        let is_between =
            |corners: &[u32]| corners.iter().all(|&c| block.positions[c as usize][0] == 0.0);
        let block = without(&block, 1, is_between);
        let stages = stages_of(&block, 0.05);
        let given = given_of(&stages);
        let [left, right] = in_front(&stages);
        let mut room = room(&given);
        room.fronts[left] = [0.3, 1.0];
        let before = room.fronts[right][1];
        assert_eq!(evened(&given, room, 0.5).fronts[right][1], before);
    }

    // 4------.            seen from above: 0-1 has two sides, and 1-2 is where the front ends
    // | top  |\
    // 0------1--------2
    #[test]
    fn an_edge_does_not_run_on_into_a_border() {
        let block = leaning_block();
        let is_top = |corners: &[u32]| {
            let at = |corner: &u32| block.positions[*corner as usize];
            corners.iter().all(|c| at(c)[1] == 1.0) && corners.iter().any(|c| at(c)[0] == 2.0)
        };
        let block = without(&block, 2, is_top);
        let stages = stages_of(&block, 0.05);
        let given = given_of(&stages);
        let [left, right] = in_front(&stages);
        let mut room = room(&given);
        room.fronts[left] = [0.3, 1.0];
        let before = room.fronts[right];
        assert!(stages.offsets[right].moves() && before[1] > 0.3, "{before:?}");
        assert_eq!(evened(&given, room, 0.5).fronts[right][1], before[1]);
    }

    #[test]
    fn what_is_not_pulled_at_all_has_no_say_in_what_it_runs_on_into() {
        let block = leaning_block();
        let stages = stages_of(&block, 0.025);
        let given = given_of(&stages);
        let [left, right] = in_front(&stages);
        let mut room = room(&given);
        room.fronts[left] = [LEAST_SHARE / 2.0, 1.0];
        assert_eq!(evened(&given, room, 0.5).fronts[right][1], 1.0);
    }

    #[test]
    fn what_runs_back_does_not_run_on() {
        assert!(runs_on(DVec3::X, -DVec3::X) && !runs_on(DVec3::X, DVec3::X));
        assert!(!runs_on(DVec3::X, DVec3::Y) && !runs_on(DVec3::X, DVec3::new(-1.0, 0.5, 0.0)));
    }

    // 0------1------2     seen from the front: at 1 two edges go down. What narrows 1-0 on this side
    // | left |\     |     narrows 1-2 here too, over the sector between, and not what goes down
    // 5------6-7----8
    #[test]
    fn an_edge_runs_on_over_where_others_end_on_one_side() {
        let block = leaning_block();
        let stages = stages_of(&block, 0.05);
        let given = given_of(&stages);
        let [left, right] = in_front(&stages);
        let mut room = room(&given);
        assert_eq!([room.fronts[left], room.fronts[right]], [[1.0; 2]; 2]);
        room.fronts[left] = [0.3, 1.0];
        let room = evened(&given, room, 0.5);
        assert_eq!(room.fronts[right][1], 0.3);
        assert!(room.fronts[right][0] > 0.9 && room.fronts[left][1] > 0.5, "{:?}", room.fronts);
    }

    #[test]
    fn what_has_room_everywhere_stays_as_it_is() {
        let cube: MeshBuffers = shapes::plain_cube(1.0);
        let stages = stages_of(&cube, 0.1);
        let room = evened(&given_of(&stages), room(&given_of(&stages)), 1.0);
        assert!(room.fronts.iter().all(|&fronts| fronts == [1.0; 2]));
    }

    #[test]
    fn nothing_jumps_where_all_is_done() {
        for mesh in [shapes::plate(), shapes::l_shape(), shapes::table(), shapes::bolt()] {
            let stages = stages_of(&mesh, 0.3);
            let given = given_of(&stages);
            let room = evened(&given, room(&given), 0.5);
            for edge in stages.edges.hard.ids() {
                let sectors = sectors(&stages, edge);
                let share = |(place, front): (usize, usize)| room.fronts[sectors[place]][front];
                let [b1, a1, a2, b2] = [(0, 1), (1, 0), (2, 1), (3, 0)].map(share);
                for [one, other] in [[a1, a2], [b1, b2]] {
                    assert!(one <= 2.0 * other + 1e-9 || other < LEAST_SHARE, "{one}, {other}");
                    assert!(other <= 2.0 * one + 1e-9 || one < LEAST_SHARE, "{other}, {one}");
                }
                let side = stages.edges.hard[edge].sides[0];
                let [from, to] = [side, side.next()].map(|c| stages.view.position_at(c));
                let most = SLOPE * from.distance(to) / stages.view.width + 1e-9;
                assert!((a1 - b1).abs() <= most && (a2 - b2).abs() <= most);
            }
        }
    }
}
