//! Which solid each triangle is part of: what merely touches another solid is judged by itself.

use super::origins::Origins;
use super::rules::{Element, Findings, Rule};
use super::surface::{HalfEdge, Surface};
use crate::groups::Groups;

/// Chamfers that lie on each other all along hide from which solid they are; after so many rounds
/// from edge to edge, what is left is judged by itself.
const MOST_ROUNDS: usize = 8;

/// With more sides on one edge, comparing all of them would take too long.
const MOST_SIDES: usize = 64;

/// The triangles of a mesh by solid.
///
/// Parts are connected across edges of two sides. One that is closed is a solid, whatever touches
/// it. The others belong together where they share an edge: who can tell which of them are one?
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
        let is_open = open_parts(surface, &part_of);
        for (forward, backward) in surface.edges() {
            let all = forward.iter().chain(backward).map(triangle);
            let open: Vec<u32> = all.filter(|&t| is_open[part_of[t as usize] as usize]).collect();
            open.windows(2).for_each(|pair| parts.join(pair[0], pair[1]));
        }
        Solids { of: parts.labels() }
    }

    /// Triangles of the source are part of the same solid as there, and new ones of the solid that
    /// they continue.
    pub fn carried(&self, after: &Surface, origins: &Origins) -> Solids {
        let mut known: Vec<Option<u32>> =
            origins.triangles.iter().map(|s| s.map(|[c, ..]| self.of[c as usize / 3])).collect();
        let across = Across::new(after);
        across.spread(&mut known);
        // Where only one solid lacks a side there is no doubt; where several do, the first one will.
        let mut is_sure = true;
        for _ in 0..MOST_ROUNDS {
            let adopted = adopt(after, &mut known, is_sure);
            if !adopted && !is_sure {
                break;
            }
            is_sure = adopted;
            across.spread(&mut known);
        }
        adopt_by_vertex(after, &mut known);
        // New solids, numbered past those of the source.
        let past = self.of.len() as u32;
        let own = |(triangle, label): (usize, Option<u32>)| label.unwrap_or(past + triangle as u32);
        Solids { of: known.into_iter().enumerate().map(own).collect() }
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

/// `#triangles`, by the first of each part: whether its own sides of some edge do not match.
fn open_parts(surface: &Surface, part_of: &[u32]) -> Vec<bool> {
    let mut is_open = vec![false; part_of.len()];
    let part = |half_edge: &HalfEdge| part_of[triangle(half_edge) as usize];
    for (forward, backward) in surface.edges() {
        match (forward, backward) {
            ([_], [_]) => {}
            _ => {
                let mut ways: Vec<(u32, i32)> = forward.iter().map(|h| (part(h), 1)).collect();
                ways.extend(backward.iter().map(|h| (part(h), -1)));
                ways.sort_unstable();
                for own in ways.chunk_by(|a, b| a.0 == b.0) {
                    is_open[own[0].0 as usize] |= own.iter().map(|(_, way)| way).sum::<i32>() != 0;
                }
            }
        }
    }
    is_open
}

/// Which triangles continue each other for sure: across edges of two sides.
struct Across {
    /// Sorted: a triangle, and one that it continues.
    pairs: Vec<[u32; 2]>,
}

impl Across {
    fn new(surface: &Surface) -> Across {
        let mut pairs = Vec::new();
        for (forward, backward) in surface.edges() {
            if let ([one], [other]) = (forward, backward) {
                let [one, other] = [one, other].map(triangle);
                pairs.extend([[one, other], [other, one]]);
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

/// A new triangle at an edge where a solid lacks a side of its direction is that side; where several
/// solids do, only if none has to be sure. Tells whether there was any.
fn adopt(surface: &Surface, known: &mut [Option<u32>], is_sure: bool) -> bool {
    let mut adopted = false;
    let few = |(a, b): &(&[HalfEdge], &[HalfEdge])| a.len() + b.len() <= MOST_SIDES;
    for (forward, backward) in surface.edges().filter(few) {
        for (here, there) in [(forward, backward), (backward, forward)] {
            for side in here.iter().map(triangle) {
                if known[side as usize].is_none() {
                    let mut lacking = lacking(known, here, there);
                    lacking.dedup();
                    if lacking.len() == 1 || !is_sure {
                        known[side as usize] = lacking.first().copied();
                        adopted |= !lacking.is_empty();
                    }
                }
            }
        }
    }
    adopted
}

/// The solids, sorted, that have more sides there than here.
fn lacking(known: &[Option<u32>], here: &[HalfEdge], there: &[HalfEdge]) -> Vec<u32> {
    let count = |sides: &[HalfEdge], label: u32| {
        sides.iter().filter(|h| known[triangle(h) as usize] == Some(label)).count()
    };
    let labels = there.iter().filter_map(|h| known[triangle(h) as usize]);
    let mut lacking: Vec<u32> =
        labels.filter(|&label| count(there, label) > count(here, label)).collect();
    lacking.sort_unstable();
    lacking
}

/// What is left is part of the first solid that it shares a vertex with.
fn adopt_by_vertex(surface: &Surface, known: &mut [Option<u32>]) {
    if known.iter().all(Option::is_some) {
        return;
    }
    let vertices = |triangle: usize| [0, 1, 2].map(|k| surface.vertex((3 * triangle + k) as u32));
    let mut solid_at: Vec<Option<u32>> = vec![None; surface.mesh.positions.len()];
    for (triangle, label) in known.iter().enumerate().filter(|(_, label)| label.is_some()) {
        for vertex in vertices(triangle) {
            solid_at[vertex] = solid_at[vertex].min(*label).or(*label);
        }
    }
    for (triangle, label) in known.iter_mut().enumerate().filter(|(_, label)| label.is_none()) {
        *label = vertices(triangle).iter().filter_map(|&vertex| solid_at[vertex]).min();
    }
}

/// No more sides of one solid meet on an edge than did where the edge comes from.
///
/// A skin that is there twice has four sides on each edge, before and after. Where several sides
/// meet on an edge of the source, its chamfers may have them too.
pub(super) fn check_sides(
    [before, after]: [&Surface; 2],
    [source, result]: [&Solids; 2],
    origins: &Origins,
    findings: &mut Findings,
) {
    let allowed = Allowed::new([before, after], source, origins);
    for edge in after.edges().filter(|(a, b)| a.len() + b.len() > 2) {
        let clusters = edge.0.first().or(edge.1.first()).map_or([0; 2], |h| h.clusters);
        let is_too_many =
            |&(solid, sides): &(u32, usize)| sides > 2 && sides > allowed.on(solid, clusters);
        if result.sides(&edge).iter().any(is_too_many) {
            findings.note(Rule::NonManifold, Element::Edge(clusters[0], clusters[1]));
        }
    }
}

/// How many sides of a solid may meet around each place of the result.
struct Allowed {
    /// Sorted: the solid, the cluster, and the most sides that met on one edge where it comes from.
    most: Vec<(u32, u32, usize)>,
}

impl Allowed {
    fn new([before, after]: [&Surface; 2], source: &Solids, origins: &Origins) -> Allowed {
        let mut at_source: Vec<(u32, u32, usize)> = Vec::new();
        for edge in before.edges().filter(|(a, b)| a.len() + b.len() > 2) {
            let clusters = edge.0.first().or(edge.1.first()).map_or([0; 2], |h| h.clusters);
            for (solid, sides) in source.sides(&edge) {
                at_source.extend(clusters.map(|cluster| (solid, cluster, sides)));
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
            let sides = at_source.at(solid, before.cluster(old)).unwrap_or(2);
            (solid, after.cluster(now), sides)
        });
        Allowed::sorted(carried.collect())
    }

    fn sorted(mut most: Vec<(u32, u32, usize)>) -> Allowed {
        // Of equal places the last one counts: that with most sides.
        most.sort_unstable();
        most.reverse();
        most.dedup_by_key(|&mut (solid, cluster, _)| (solid, cluster));
        most.reverse();
        Allowed { most }
    }

    fn at(&self, solid: u32, cluster: u32) -> Option<usize> {
        let key = (solid, cluster);
        let found = self.most.binary_search_by_key(&key, |&(solid, cluster, _)| (solid, cluster));
        found.ok().map(|place| self.most[place].2)
    }

    /// Nothing is known of the vertex in the middle of a corner: the other end tells.
    fn on(&self, solid: u32, clusters: [u32; 2]) -> usize {
        clusters.iter().filter_map(|&cluster| self.at(solid, cluster)).min().unwrap_or(2)
    }
}
