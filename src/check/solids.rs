//! Which solid each triangle is part of: what merely touches another solid is judged by itself.

use std::cmp::Reverse;
use std::collections::btree_map::{BTreeMap, Entry};
use std::collections::{BTreeSet, BinaryHeap};

use glam::DVec3;

use super::origins::Origins;
use super::rules::{Element, Findings, Rule};
use super::surface::{HalfEdge, Surface};
use crate::groups::Groups;

/// Where chamfers lie on each other, it takes rounds from edge to edge to tell them apart: more than
/// so many hardly ever find anything.
const MOST_ROUNDS: usize = 8;

/// Sides whose directions about an edge differ by less than this, in radians, lie on each other.
const SAME_TURN: f64 = 1e-4;

/// With more sides on one edge, comparing all of them would take too long.
const MOST_SIDES: usize = 64;

/// The triangles of a mesh by solid: connected across edges of two sides, and where more sides meet
/// each with the next opposite one behind it, through the solid.
pub(super) struct Solids {
    /// `#triangles`: the number of its solid.
    pub of: Vec<u32>,
}

impl Solids {
    pub fn new(surface: &Surface) -> Solids {
        let mut parts = Groups::singles(surface.mesh.indices.len() / 3);
        for (forward, backward) in surface.edges() {
            if let ([one], [other]) = (forward, backward) {
                parts.join(triangle(one), triangle(other));
            }
        }
        let part_of = parts.clone().labels();
        for edge in surface.edges().filter(|(a, b)| a.len() + b.len() > 2) {
            for pair in behind_each_other(surface, edge, &part_of) {
                parts.join(pair[0], pair[1]);
            }
        }
        Solids { of: parts.labels() }
    }

    /// Triangles of the source are part of the same solid as there, and new ones of the solid that
    /// they continue. Where chamfers of several solids lie on each other all along, nobody can tell
    /// which of them a new triangle continues: it is one by itself.
    pub fn carried(&self, after: &Surface, origins: &Origins) -> Solids {
        let mut known: Vec<Option<u32>> =
            origins.triangles.iter().map(|s| s.map(|[c, ..]| self.of[c as usize / 3])).collect();
        let across = Across::new(after, &known);
        across.spread(&mut known);
        // Beside a triangle of the source a strip lies with its long side, beside other new ones with
        // an end, where the next solid may begin.
        let is_old = |triangle: u32| origins.triangles[triangle as usize].is_some();
        for _ in 0..MOST_ROUNDS {
            if !adopt(after, &mut known, &is_old) && !adopt(after, &mut known, &|_| true) {
                break;
            }
            across.spread(&mut known);
        }
        // Numbered past the solids of the source.
        let past = self.of.len() as u32;
        let own = |(triangle, label): (usize, Option<u32>)| label.unwrap_or(past + triangle as u32);
        Solids { of: known.into_iter().enumerate().map(own).collect() }
    }

    /// The solids whose skin lies on itself somewhere, as copies do: sides of one direction that run
    /// the same way about an edge. Rounding decides whether such skins cut each other.
    pub fn lying_on_themselves(&self, surface: &Surface) -> Vec<u32> {
        let mut found = Vec::new();
        for (forward, backward) in surface.edges().filter(|(a, b)| a.len() + b.len() > 2) {
            for same in [forward, backward] {
                let direction = |side: &HalfEdge| (self.of_side(side), frame(surface, side)[0]);
                let mut all: Vec<(u32, DVec3)> = same.iter().map(direction).collect();
                all.sort_by_key(|(solid, _)| *solid);
                let own = all.chunk_by(|a, b| a.0 == b.0).take(MOST_SIDES);
                found.extend(own.filter(|own| has_twice(own)).map(|own| own[0].0));
            }
        }
        found
    }

    /// The sides of an edge in pairs, each one that runs forward with one that runs backward. Of more
    /// than two these are the ones that have a solid between them, of one part first; none of very
    /// many.
    pub fn pairs<'s>(
        &self,
        surface: &Surface,
        (forward, backward): (&'s [HalfEdge], &'s [HalfEdge]),
    ) -> Vec<[&'s HalfEdge; 2]> {
        if let ([one], [other]) = (forward, backward) {
            return vec![[one, other]];
        }
        if forward.len() + backward.len() > MOST_SIDES {
            return Vec::new();
        }
        let behind = behind_each_other(surface, (forward, backward), &self.of);
        let mut left: Vec<&HalfEdge> = backward.iter().collect();
        let pair = |one: &'s HalfEdge| {
            let is_behind = |other: &&HalfEdge| behind.contains(&[triangle(one), triangle(other)]);
            let place = left.iter().position(is_behind)?;
            Some([one, left.remove(place)])
        };
        forward.iter().filter_map(pair).collect()
    }

    /// How many sides an edge has in each of its solids: their numbers, sorted, and the counts.
    pub fn sides(&self, (forward, backward): &(&[HalfEdge], &[HalfEdge])) -> Vec<(u32, usize)> {
        let mut all: Vec<u32> = forward.iter().chain(*backward).map(|h| self.of_side(h)).collect();
        all.sort_unstable();
        all.chunk_by(|a, b| a == b).map(|same| (same[0], same.len())).collect()
    }

    /// Edges with more than two sides, other than those along which solids touch that have two
    /// sides each.
    pub fn crowded_edges(&self, surface: &Surface) -> usize {
        let is_crowded = |edge: &(&[HalfEdge], &[HalfEdge])| {
            let sides = edge.0.len() + edge.1.len();
            sides > 2 && self.sides(edge).iter().any(|&(_, own)| own != 2)
        };
        surface.edges().filter(is_crowded).count()
    }

    fn of_side(&self, half_edge: &HalfEdge) -> u32 {
        self.of[triangle(half_edge) as usize]
    }
}

fn triangle(half_edge: &HalfEdge) -> u32 {
    half_edge.corners[0] / 3
}

/// Pairs of triangles at an edge of many sides that bound one solid: each is the next one of the other
/// if one turns from there to its back. Of several in one direction, those of its own part, or else
/// all: who can tell? Of too many sides, all are one.
fn behind_each_other(
    surface: &Surface,
    (forward, backward): (&[HalfEdge], &[HalfEdge]),
    part_of: &[u32],
) -> Vec<[u32; 2]> {
    let sides = || forward.iter().chain(backward);
    if forward.len() + backward.len() > MOST_SIDES || forward.is_empty() || backward.is_empty() {
        return sides().zip(sides().skip(1)).map(|(a, b)| [triangle(a), triangle(b)]).collect();
    }
    let [ahead, behind] = [(forward, backward), (backward, forward)]
        .map(|(here, there)| next_behind(surface, here, there, part_of));
    ahead.into_iter().filter(|&[one, other]| behind.contains(&[other, one])).collect()
}

/// For each side here, the next ones there.
fn next_behind(
    surface: &Surface,
    here: &[HalfEdge],
    there: &[HalfEdge],
    part_of: &[u32],
) -> Vec<[u32; 2]> {
    let mut pairs = Vec::new();
    for one in here {
        let turns = there.iter().map(|other| (turn(surface, one, other), triangle(other)));
        let turns: Vec<(f64, u32)> = turns.collect();
        let least = turns.iter().map(|(turn, _)| *turn).fold(f64::INFINITY, f64::min);
        let next = turns.iter().filter(|(turn, _)| *turn < least + SAME_TURN);
        let next: Vec<u32> = next.map(|(_, other)| *other).collect();
        let is_own = |other: &&u32| part_of[**other as usize] == part_of[triangle(one) as usize];
        let own: Vec<u32> = next.iter().filter(is_own).copied().collect();
        let all = if own.is_empty() { next } else { own };
        pairs.extend(all.into_iter().map(|other| [triangle(one), other]));
    }
    pairs
}

/// Whether two sides, of the first ones, lie on each other.
fn has_twice(own: &[(u32, DVec3)]) -> bool {
    let own = &own[..own.len().min(MOST_SIDES)];
    let lies_on = |a: &DVec3, b: &DVec3| a.angle_between(*b) < SAME_TURN;
    own.iter().enumerate().any(|(place, (_, a))| own[..place].iter().any(|(_, b)| lies_on(a, b)))
}

/// How far one turns about an edge from one side to another by way of its back, in radians. Of two
/// sides that lie on each other back to back, each is the last that the other one meets.
fn turn(surface: &Surface, one: &HalfEdge, other: &HalfEdge) -> f64 {
    let ([inward, up], [direction, _]) = (frame(surface, one), frame(surface, other));
    let turn = f64::atan2(-direction.dot(up), direction.dot(inward));
    if turn < SAME_TURN { turn + std::f64::consts::TAU } else { turn }
}

/// From an edge into the face of one of its sides, and out of the face; unit.
fn frame(surface: &Surface, side: &HalfEdge) -> [DVec3; 2] {
    let [from, to] = side.corners.map(|corner| surface.position(corner));
    let third = 9 * triangle(side) + 3 - side.corners[0] - side.corners[1];
    let along = (to - from).normalize_or_zero();
    let inward = (surface.position(third) - from).reject_from(along).normalize_or_zero();
    [inward, along.cross(inward)]
}

/// Which triangles continue each other for sure: across edges of two sides, and across others one of
/// the source and a new one that alone share both vertices.
struct Across {
    /// Sorted: a triangle, and one that it continues.
    pairs: Vec<[u32; 2]>,
}

impl Across {
    fn new(surface: &Surface, known: &[Option<u32>]) -> Across {
        let mut pairs = Vec::new();
        let mut join = |one: u32, other: u32| pairs.extend([[one, other], [other, one]]);
        for (forward, backward) in surface.edges() {
            if let ([one], [other]) = (forward, backward) {
                join(triangle(one), triangle(other));
                continue;
            }
            let mut sides: Vec<([usize; 2], bool, u32)> = forward
                .iter()
                .chain(backward)
                .map(|h| (ends(surface, h), h.reversed, triangle(h)))
                .collect();
            sides.sort_unstable();
            for same in sides.chunk_by(|a, b| a.0 == b.0) {
                if let [(_, false, one), (_, true, other)] = *same
                    && known[one as usize].is_some() != known[other as usize].is_some()
                {
                    join(one, other);
                }
            }
        }
        pairs.sort_unstable();
        Across { pairs }
    }

    /// Carries what is known on, from triangle to triangle.
    fn spread(&self, known: &mut [Option<u32>]) {
        let mut reached: Vec<u32> =
            (0..known.len() as u32).filter(|&t| known[t as usize].is_some()).collect();
        while let Some(from) = reached.pop() {
            let first = self.pairs.partition_point(|pair| pair[0] < from);
            for [_, to] in self.pairs[first..].iter().take_while(|pair| pair[0] == from) {
                if known[*to as usize].is_none() {
                    known[*to as usize] = known[from as usize];
                    reached.push(*to);
                }
            }
        }
    }
}

/// The vertices at the ends of a half-edge, in the order of their positions.
fn ends(surface: &Surface, half_edge: &HalfEdge) -> [usize; 2] {
    let [a, b] = half_edge.corners.map(|corner| surface.vertex(corner));
    if half_edge.reversed { [b, a] } else { [a, b] }
}

/// Where the new triangles on one side of an edge are as many as one solid alone lacks there, they
/// are its own, if all on the other side are of those to look at. Tells whether there were any.
fn adopt(surface: &Surface, known: &mut [Option<u32>], looks_at: &dyn Fn(u32) -> bool) -> bool {
    let mut adopted = false;
    let few = |(a, b): &(&[HalfEdge], &[HalfEdge])| a.len() + b.len() <= MOST_SIDES;
    for (forward, backward) in surface.edges().filter(few) {
        for (here, there) in [(forward, backward), (backward, forward)] {
            let new: Vec<u32> =
                here.iter().map(triangle).filter(|&t| known[t as usize].is_none()).collect();
            let knows = |t: u32| known[t as usize].is_some() && looks_at(t);
            let knows_all = there.iter().map(triangle).all(knows);
            if new.is_empty() || !knows_all {
                continue;
            }
            let lacking = lacking(known, here, there);
            if lacking.len() == new.len() && lacking.iter().all(|&solid| solid == lacking[0]) {
                new.iter().for_each(|&t| known[t as usize] = Some(lacking[0]));
                adopted = true;
            }
        }
    }
    adopted
}

/// The solids, sorted, that have more sides there than here, each as often as it lacks one.
fn lacking(known: &[Option<u32>], here: &[HalfEdge], there: &[HalfEdge]) -> Vec<u32> {
    let labels = |sides: &[HalfEdge]| -> Vec<u32> {
        sides.iter().filter_map(|h| known[triangle(h) as usize]).collect()
    };
    let mut lacking = labels(there);
    for label in labels(here) {
        if let Some(place) = lacking.iter().position(|&other| other == label) {
            lacking.swap_remove(place);
        }
    }
    lacking.sort_unstable();
    lacking
}

/// No more sides of one solid meet on an edge than did where the edge comes from, and no more of all
/// solids than these may have together.
///
/// A skin that is there twice has four sides on each edge, before and after. Where several sides
/// meet on an edge of the source, its chamfers may have them too. Only where the mesh has more such
/// sides than before is there anything to find: which solid a side belongs to is not always certain.
/// Chamfers that come to touch along an edge, each with vertices of its own there, touch as solids do.
/// What solids may have together goes for all that chamfers have brought together, as at T-junctions:
/// which of them a chamfer continues, nobody can tell.
pub(super) fn check_sides(
    [before, after]: [&Surface; 2],
    [source, result]: [&Solids; 2],
    origins: &Origins,
    findings: &mut Findings,
) {
    if after.sides_past_two() <= before.sides_past_two() {
        return;
    }
    let one = brought_together(after, result, source.of.len());
    let allowed = Allowed::new([before, after], [source, result], origins);
    let of_all = allowed.of_all(&one);
    for edge in after.edges().filter(|(a, b)| a.len() + b.len() > 2) {
        if is_closed_by_vertices(after, edge) {
            continue;
        }
        let clusters = edge.0.first().or(edge.1.first()).map_or([0; 2], |h| h.clusters);
        let allowed = allowed.on(clusters);
        let together =
            of_all.on(clusters).iter().map(|&(_, sides)| sides).sum::<usize>().max(LEAST_SIDES);
        let of = |solid: u32| {
            let place = allowed.binary_search_by_key(&solid, |&(solid, _)| solid);
            place.map_or(LEAST_SIDES, |place| allowed[place].1)
        };
        let is_too_many = |&(solid, sides): &(u32, usize)| sides > of(solid);
        if edge.0.len() + edge.1.len() > together || result.sides(&edge).iter().any(is_too_many) {
            findings.note(Rule::NonManifold, Element::Edge(clusters[0], clusters[1]));
        }
    }
}

/// `#solids, and new triangles past them`: the number that stands for all that chamfers have brought
/// together. Two solids are, where they share an edge of two sides.
fn brought_together(after: &Surface, result: &Solids, solids: usize) -> Vec<u32> {
    let mut one = Groups::singles(solids + result.of.len());
    for edge in after.edges() {
        if let ([side], [other]) = edge {
            one.join(result.of_side(side), result.of_side(other));
        }
    }
    one.labels()
}

/// Whether each side of an edge shares its two vertices with one other side alone, which runs back.
fn is_closed_by_vertices(
    surface: &Surface,
    (forward, backward): (&[HalfEdge], &[HalfEdge]),
) -> bool {
    let sorted = |sides: &[HalfEdge]| {
        let mut sorted: Vec<[usize; 2]> = sides.iter().map(|side| ends(surface, side)).collect();
        sorted.sort_unstable();
        sorted
    };
    let [forward, backward] = [forward, backward].map(sorted);
    forward == backward && forward.windows(2).all(|pair| pair[0] != pair[1])
}

/// Any edge may have two sides.
const LEAST_SIDES: usize = 2;

/// How many sides of a solid may meet around each place of the result.
struct Allowed {
    /// Sorted: the cluster, the solid, and the most sides that met on one edge where it comes from.
    most: Vec<(u32, u32, usize)>,
}

impl Allowed {
    fn new(
        [before, after]: [&Surface; 2],
        [source, result]: [&Solids; 2],
        origins: &Origins,
    ) -> Allowed {
        let mut at_source: Vec<(u32, u32, usize)> = Vec::new();
        for edge in before.edges().filter(|(a, b)| a.len() + b.len() > 2) {
            let clusters = edge.0.first().or(edge.1.first()).map_or([0; 2], |h| h.clusters);
            for (solid, sides) in source.sides(&edge) {
                at_source.extend(clusters.map(|cluster| (cluster, solid, sides)));
            }
        }
        let at_source = Allowed::sorted(at_source);
        let corners_of = |(triangle, corners): (usize, &Option<[u32; 3]>)| {
            let first = 3 * triangle as u32;
            corners.map(|corners| [0, 1, 2].map(|side| (first + side, corners[side as usize])))
        };
        let corners = origins.triangles.iter().enumerate().filter_map(corners_of).flatten();
        let carried = corners.map(|(now, old)| {
            let solid = source.of[old as usize / 3];
            let key = (before.cluster(old), solid);
            let place = at_source.most.binary_search_by_key(&key, |&(c, solid, _)| (c, solid));
            let sides = place.map_or(LEAST_SIDES, |place| at_source.most[place].2);
            (after.cluster(now), solid, sides.max(LEAST_SIDES))
        });
        let known = Allowed::sorted(carried.collect());
        Spread::new(after, result, source.of.len() as u32).from(known)
    }

    /// The same for all solids that one number stands for: as many as these may have together.
    fn of_all(&self, one: &[u32]) -> Allowed {
        let mut of_all = BTreeMap::new();
        for &(at, solid, sides) in &self.most {
            *of_all.entry((at, one[solid as usize])).or_insert(0) += sides;
        }
        let most = of_all.into_iter().map(|((at, one), sides)| (at, one, sides));
        Allowed { most: most.collect() }
    }

    fn sorted(mut most: Vec<(u32, u32, usize)>) -> Allowed {
        // Of equal places the last one counts: that with most sides.
        most.sort_unstable();
        most.reverse();
        most.dedup_by_key(|&mut (cluster, solid, _)| (cluster, solid));
        most.reverse();
        Allowed { most }
    }

    fn at(&self, cluster: u32) -> &[(u32, u32, usize)] {
        let first = self.most.partition_point(|&(other, ..)| other < cluster);
        let count = self.most[first..].partition_point(|&(other, ..)| other == cluster);
        &self.most[first..first + count]
    }

    /// The solids at both ends of an edge, sorted, and how many sides each may have.
    fn on(&self, [one, other]: [u32; 2]) -> Vec<(u32, usize)> {
        let other = self.at(other);
        let both = |&(_, solid, sides): &(u32, u32, usize)| {
            let place = other.binary_search_by_key(&solid, |&(_, solid, _)| solid).ok()?;
            Some((solid, sides.min(other[place].2)))
        };
        self.at(one).iter().filter_map(both).collect()
    }
}

/// How what is allowed reaches places that no triangle of the source has, such as the rows of a
/// rounded chamfer: each solid's from the nearest place that has some, along sides of new triangles
/// that are its own or nobody's.
struct Spread {
    /// Sorted: a cluster, one beside it, the solid of the triangle between, if known, and how far.
    ways: Vec<(u32, u32, Option<u32>, Length)>,
}

/// Bits of a positive number, which are in the order of their numbers.
type Length = u64;

impl Spread {
    fn new(after: &Surface, result: &Solids, solids: u32) -> Spread {
        let mut ways = Vec::new();
        for (forward, backward) in after.edges() {
            for side in forward.iter().chain(backward) {
                let [a, b] = side.corners.map(|corner| after.position(corner));
                let solid = Some(result.of_side(side)).filter(|&solid| solid < solids);
                let [one, other] = side.clusters;
                let length = a.distance(b).to_bits();
                ways.extend([(one, other, solid, length), (other, one, solid, length)]);
            }
        }
        ways.sort_unstable();
        ways.dedup();
        Spread { ways }
    }

    /// With what is known, and what is nearest to it elsewhere (Dijkstra's way).
    fn from(&self, known: Allowed) -> Allowed {
        let is_known: BTreeSet<u32> = known.most.iter().map(|&(cluster, ..)| cluster).collect();
        let start =
            known.most.iter().map(|&(c, solid, sides)| Reverse((0, c, solid, Reverse(sides))));
        // The nearest first, and of those as near the one with most sides.
        let mut open: BinaryHeap<_> = start.collect();
        let mut most = BTreeMap::new();
        while let Some(Reverse((so_far, cluster, solid, Reverse(sides)))) = open.pop() {
            let Entry::Vacant(place) = most.entry((cluster, solid)) else { continue };
            place.insert(sides);
            let first = self.ways.partition_point(|&(from, ..)| from < cluster);
            let ways = self.ways[first..].iter().take_while(|&&(from, ..)| from == cluster);
            let is_open = |to: u32| !is_known.contains(&to) && !most.contains_key(&(to, solid));
            for &(_, to, of, length) in ways {
                if of.is_none_or(|of| of == solid) && is_open(to) {
                    let length = f64::from_bits(so_far) + f64::from_bits(length);
                    open.push(Reverse((length.to_bits(), to, solid, Reverse(sides))));
                }
            }
        }
        let sorted = most.into_iter().map(|((cluster, solid), sides)| (cluster, solid, sides));
        Allowed { most: sorted.collect() }
    }
}
