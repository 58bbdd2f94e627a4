//! Where an edge is one on its one side and several on the other (a *T-junction*), the long side gets
//! the vertices of the short ones, so that all of them find their twins.
//!
//! ```text
//!   .-----------.            .-----------.
//!   |       .-' |            |  .-'/ .-' |      M stands on the side A-B of the triangle above,
//!   |   .-'     |            |.' .'.'    |      which gets a vertex there
//!   A-----------B            A--M--------B
//!   A--M--------B            A--M--------B
//!   |  |        |            |  |        |
//! ```
//! Ends that only rounding has set apart are put together.

use std::collections::{BTreeMap, BTreeSet};

use glam::DVec3;

use super::splits::is_even;
use crate::bvh::{Aabb, Kin, Target, Tree};
use crate::groups::Groups;
use crate::ids::{Cluster, Corner, Few, Vertex};
use crate::line::Line;
use crate::lines::Lines;
use crate::report::Reason;
use crate::shape::Shape;
use crate::tolerance::BACK_TO_BACK_COSINE;
use crate::topology::Topology;
use crate::unpaired::{Unpaired, meets};
use crate::view::View;

/// With more pairs of sides than this for each border, so many lie on each other that nobody can tell
/// which belong together, and looking for it would take long.
const MOST_PAIRS: usize = 8;

/// What brings the sides of edges together.
#[derive(Debug, Default)]
pub struct Stitches {
    /// Sides that get vertices, with the source vertices that stand on each.
    at: BTreeMap<Corner, Few<u32>>,
    /// Ends that only rounding has set apart, each with that of its place to which all are put.
    joins: BTreeMap<Cluster, Cluster>,
}

/// What is better left as it is.
#[derive(Debug, Default)]
pub struct Left {
    /// Sides that get no vertices.
    pub sides: BTreeSet<Corner>,
    /// Places at which nothing is put together.
    pub places: BTreeSet<Cluster>,
}

/// For a mesh with T-junctions: mostly nothing. Nothing either at a width at which nothing opens, so
/// that the mesh comes out as it was.
pub fn stitches(view: &View, shape: &Shape, unpaired: &[Unpaired]) -> Stitches {
    if view.width <= view.resolution {
        return Stitches::default();
    }
    let Shape { topology, contacts, .. } = shape;
    let (mut at, mut near, mut pairs) = (BTreeMap::new(), Vec::new(), 0);
    for &(side, _) in unpaired.iter().filter(|(_, reason)| *reason == Reason::TJunction) {
        let line = Line::new(view, side);
        let ends = [side, side.next()].map(|end| view.position_at(end));
        let others = contacts.borders_along(ends).flatten();
        for other in others.filter(|&other| topology.twin[other].is_none()) {
            let other = Line::new(view, other);
            if may_pair(shape, [side, other.border]) && meets(view, topology, &line, &other) {
                stand(view, &mut at, [&line, &other]);
                stand(view, &mut at, [&other, &line]);
                near.extend(near_ends(view, shape, [side, other.border]));
                pairs += 1;
            }
        }
        if pairs > MOST_PAIRS * contacts.len() {
            return Stitches::default();
        }
    }
    at.retain(|&side, _| is_plain(view, side));
    let crowded = crowded(view, &shape.topology, at.keys().copied());
    at.retain(|side, _| !crowded.contains(side));
    let cluster = |vertex: u32| shape.weld.cluster_of[Vertex(vertex)];
    for (&side, all) in &mut at {
        put_in_order(view, side, all);
        let pairs = all.windows(2).filter(|pair| !is_apart(view, side, pair));
        near.extend(pairs.map(|pair| [cluster(pair[0]), cluster(pair[1])]));
    }
    Stitches { at, joins: joins(view, shape, near) }
}

/// Those of the sides along which an edge runs that has two sides already: with a second side of their
/// own, more than two would lie there.
fn crowded(
    view: &View,
    topology: &Topology,
    sides: impl Iterator<Item = Corner>,
) -> BTreeSet<Corner> {
    let mut crowded = BTreeSet::new();
    let lines: Vec<Line> = sides.map(|side| Line::new(view, side)).collect();
    if lines.is_empty() {
        return crowded;
    }
    let around = |[from, to]: [DVec3; 2]| {
        let ends = [from.min(to) - view.reach(), from.max(to) + view.reach()];
        Aabb::around(&ends.map(|end| end.as_vec3().to_array()))
    };
    let boxes: Vec<Aabb> = lines.iter().map(|line| around(line.ends())).collect();
    // The boxes of slanted ones overlap by the thousand.
    let points = Lines::new(lines.iter().map(Line::ends), view.reach());
    let views = [lines.iter().map(|line| points.around(line.ends())).collect()];
    let tree = Tree::new(&boxes, &[]).with_views(&views);
    let is_pair = |&side: &Corner| topology.twin[side].is_some() && side < topology.twin[side];
    for side in topology.twin.ids().filter(is_pair) {
        let ends = [side, side.next()].map(|end| view.position_at(end));
        let (bounds, views) = (around(ends), [points.around(ends)]);
        let near = tree.near(Target { bounds, views, rod: None, is_out: |_: &Kin| false });
        let along = near
            .map(|number| &lines[number as usize])
            .filter(|line| line.shared(ends, view.reach()).is_some());
        crowded.extend(along.map(|line| line.border));
    }
    crowded
}

/// Puts the ends of one side on another one, within which they stand.
fn stand(view: &View, at: &mut BTreeMap<Corner, Few<u32>>, [on, other]: [&Line; 2]) {
    for end in [other.border, other.border.next()] {
        if on.holds(view.position_at(end), view.reach()) {
            at.entry(on.border).or_default().push(view.vertex_at(end).0);
        }
    }
}

/// The ends at which two sides nearly meet.
fn near_ends(view: &View, shape: &Shape, [one, other]: [Corner; 2]) -> Vec<[Cluster; 2]> {
    let ends = [[one, other.next()], [one.next(), other]];
    let near = ends.into_iter().filter(|ends| {
        let [at, to] = ends.map(|end| view.position_at(end));
        at != to && at.distance(to) <= view.rounding()
    });
    near.map(|ends| ends.map(|end| shape.topology.cluster_at[end])).collect()
}

/// Whether two sides are of real faces that are seen, with something to cut off between them.
fn may_pair(shape: &Shape, sides: [Corner; 2]) -> bool {
    let Shape { topology, faces, .. } = shape;
    let [one, other] = sides.map(|side| faces.normal[side.triangle()]);
    let is_face = |side: Corner| {
        let triangle = side.triangle();
        faces.normal[triangle] != DVec3::ZERO && !faces.is_line(triangle)
    };
    sides.into_iter().all(|side| is_face(side) && !topology.is_hidden(side))
        && one.dot(other) >= BACK_TO_BACK_COSINE
}

/// Whether the streams along a side are such that a vertex on it can be told as a blend.
fn is_plain(view: &View, side: Corner) -> bool {
    is_even(&view.mesh, [side, side.next()].map(|end| view.vertex_at(end).0 as usize))
}

/// Vertices on a side from its start on, one of each place.
fn put_in_order(view: &View, side: Corner, all: &mut Few<u32>) {
    let line = Line::new(view, side);
    let at = |vertex: u32| view.position(Vertex(vertex));
    let place = |vertex: u32| line.place(at(vertex));
    all.sort_unstable_by(|&one, &other| place(one).total_cmp(&place(other)).then(one.cmp(&other)));
    all.dedup_by(|one, other| at(*one) == at(*other));
}

/// Whether two vertices on a side stand so far apart that rounding does not matter.
fn is_apart(view: &View, side: Corner, pair: &[u32]) -> bool {
    let line = Line::new(view, side);
    let place = |vertex: u32| line.place(view.position(Vertex(vertex)));
    place(pair[1]) - place(pair[0]) > view.reach()
}

/// Each of the clusters that are near to another, with the one of its place to which all are put: of
/// those the nearest to the planes of the axes, which is what was meant. What reaches farther than
/// rounding stays apart.
fn joins(view: &View, shape: &Shape, near: Vec<[Cluster; 2]>) -> BTreeMap<Cluster, Cluster> {
    let mut all = near.as_flattened().to_vec();
    all.sort_unstable();
    all.dedup();
    let number = |cluster: Cluster| all.partition_point(|known| *known < cluster) as u32;
    let mut groups = Groups::singles(all.len());
    near.iter().for_each(|&[one, other]| groups.join(number(one), number(other)));
    let mut places: BTreeMap<u32, Vec<Cluster>> = BTreeMap::new();
    for (&cluster, group) in all.iter().zip(groups.labels()) {
        places.entry(group).or_default().push(cluster);
    }
    let at = |cluster: Cluster| view.position(shape.weld.first_vertex[cluster]);
    let off_axes = |cluster: &Cluster| at(*cluster).abs().to_array();
    let joined = places.into_values().filter_map(|place| {
        let nearer = |one: &&Cluster, other: &&Cluster| {
            let [one, other] = [one, other].map(|cluster| off_axes(cluster));
            one.partial_cmp(&other).unwrap_or(std::cmp::Ordering::Equal)
        };
        let to = *place.iter().min_by(nearer)?;
        let is_one = place.iter().all(|&cluster| at(cluster).distance(at(to)) <= view.rounding());
        is_one.then(|| place.into_iter().map(move |cluster| (cluster, to)))
    });
    joined.flatten().collect()
}

impl Left {
    pub fn is_empty(&self) -> bool {
        self.sides.is_empty() && self.places.is_empty()
    }
}

impl Stitches {
    /// Where a cluster goes.
    pub(super) fn place(&self, cluster: Cluster) -> Cluster {
        self.joins.get(&cluster).copied().unwrap_or(cluster)
    }

    pub(super) fn joins(&self) -> &BTreeMap<Cluster, Cluster> {
        &self.joins
    }

    pub(super) fn is_empty(&self) -> bool {
        self.at.is_empty() && self.joins.is_empty()
    }

    /// How many sides get vertices, and how many.
    pub(super) fn counts(&self) -> [usize; 2] {
        [self.at.len(), self.at.values().map(|at| at.len()).sum()]
    }

    /// The sides that get vertices, with one for each place on them, from their start on.
    pub(super) fn sides<'a>(
        &'a self,
        shape: &'a Shape,
    ) -> impl Iterator<Item = (Corner, Few<u32>)> + 'a {
        let place = |vertex: u32| self.place(shape.weld.cluster_of[Vertex(vertex)]);
        self.at.iter().map(move |(&side, all)| {
            let mut all = all.clone();
            all.dedup_by(|one, other| place(*one) == place(*other));
            (side, all)
        })
    }

    /// Leaves something as it is.
    pub fn leave(&mut self, left: &Left) {
        self.at.retain(|side, _| !left.sides.contains(side));
        self.joins.retain(|_, place| !left.places.contains(place));
    }

    /// Leaves the sides on which two vertices nearly meet that are not put together.
    pub(super) fn leave_unclear(&mut self, view: &View, shape: &Shape) {
        let is_unclear = |(side, all): &(Corner, Few<u32>)| {
            !all.windows(2).all(|pair| is_apart(view, *side, pair))
        };
        let sides = self.sides(shape).filter(is_unclear).map(|(side, _)| side).collect();
        self.leave(&Left { sides, ..Left::default() });
    }
}
