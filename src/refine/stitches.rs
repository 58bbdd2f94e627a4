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

use std::collections::{BTreeMap, BTreeSet};

use glam::DVec3;

use super::cuts::Point;
use super::splits::{is_tilted, tilted};
use super::{PointsOf, Refined, cut_all};
use crate::error::Error;
use crate::ids::{Cluster, Corner, Few, Id, Triangle, Vertex};
use crate::line::Line;
use crate::memory;
use crate::mesh::Mesh;
use crate::report::Reason;
use crate::shape::Shape;
use crate::tolerance::{BACK_TO_BACK_COSINE, LINE_HEIGHT};
use crate::unpaired::{Unpaired, meets};
use crate::view::{View, wide};

/// A mesh whose long sides have the vertices that stand on them.
#[derive(Debug)]
pub struct Stitched {
    pub(super) refined: Refined,
    /// `#new vertices`: the source vertex that stands there.
    pub(super) stands_at: Vec<u32>,
}

impl Stitched {
    /// The finer mesh, on which the same rests.
    pub fn as_mesh<'a>(&'a self, source: &Mesh<'a>) -> Mesh<'a> {
        self.refined.as_mesh(source)
    }
}

/// What brings the sides of edges together.
#[derive(Default)]
struct Stitches {
    /// Sides that get vertices, with the source vertices that stand on each.
    at: BTreeMap<Corner, Few<u32>>,
    /// Ends that only rounding has set apart, each with the earlier one that it is put to.
    joins: BTreeMap<Cluster, Cluster>,
}

/// The mesh with vertices where others stand on its hard edges; mostly none.
///
/// # Errors
/// [`Error::OutOfMemory`] where what the finer mesh needs is not to be had.
pub fn stitch(
    view: &View,
    shape: &Shape,
    unpaired: &[Unpaired],
) -> Result<Option<Stitched>, Error> {
    let mut stitches = junctions(view, shape, unpaired);
    if stitches.is_empty() {
        return Ok(None);
    }
    stitches.drop_bad_joins(view, shape);
    let counts = [stitches.at.len(), stitches.at.values().map(|at| at.len()).sum()];
    let (work, rims) = (shape.chamfers().work(), shape.contacts.len());
    memory::ask(memory::of_refined(&view.mesh, work, rims, counts))?;
    while !stitches.is_empty() {
        let stitched = stitched(view, shape, &stitches);
        let mut bad = tilted(view, shape, &stitched.refined);
        let crowded = crowded(shape, &stitches, &stitched.refined);
        if bad.is_empty() && crowded.is_empty() {
            return Ok(Some(stitched));
        }
        bad.sort_unstable();
        stitches.at.retain(|side, _| bad.binary_search(&side.triangle()).is_err());
        stitches.drop_crowded(shape, &stitched.refined, &crowded);
    }
    Ok(None)
}

/// The open sides along which others run back, where the ends of one are none of the other.
fn junctions(view: &View, shape: &Shape, unpaired: &[Unpaired]) -> Stitches {
    let Shape { topology, contacts, .. } = shape;
    let mut stitches = Stitches::default();
    for &(side, _) in unpaired.iter().filter(|(_, reason)| *reason == Reason::TJunction) {
        let line = Line::new(view, side);
        let others = contacts.borders_near(line.ends());
        for other in others.filter(|&other| topology.twin[other].is_none()) {
            let other = Line::new(view, other);
            let sides = [side, other.border];
            if !is_back_to_back(shape, sides) && meets(view, topology, &line, &other) {
                stitches.stand(view, &line, &other);
                stitches.stand(view, &other, &line);
                stitches.join(view, shape, sides);
            }
        }
    }
    let on_faces = stitches.at.into_iter().filter(|(side, _)| is_face(shape, *side));
    let ordered = on_faces.filter_map(|(side, all)| Some((side, in_order(view, side, all)?)));
    Stitches { at: ordered.collect(), joins: stitches.joins }
}

impl Stitches {
    fn is_empty(&self) -> bool {
        self.at.is_empty() && self.joins.is_empty()
    }

    /// The ends of a side that stand within another one.
    fn stand(&mut self, view: &View, on: &Line, other: &Line) {
        for end in [other.border, other.border.next()] {
            if on.holds(view.position_at(end), view.resolution * LINE_HEIGHT) {
                self.at.entry(on.border).or_default().push(view.vertex_at(end).0);
            }
        }
    }

    /// The ends at which two sides nearly meet.
    fn join(&mut self, view: &View, shape: &Shape, [one, other]: [Corner; 2]) {
        for ends in [[one, other.next()], [one.next(), other]] {
            let [at, to] = ends.map(|end| view.position_at(end));
            let [first, second] = ends.map(|end| shape.topology.cluster_at[end]);
            if first != second && at.distance(to) <= view.resolution * LINE_HEIGHT {
                self.joins.entry(first.max(second)).or_insert(first.min(second));
            }
        }
    }

    /// Leaves out what would put one to another that moves itself, and what would bend a triangle.
    fn drop_bad_joins(&mut self, view: &View, shape: &Shape) {
        let moving: Vec<Cluster> = self.joins.keys().copied().collect();
        self.joins.retain(|_, to| moving.binary_search(to).is_err());
        while !self.joins.is_empty() {
            let mut bad: Vec<Cluster> = Vec::new();
            for triangle in view.triangles() {
                let clusters = triangle.corners().map(|corner| shape.topology.cluster_at[corner]);
                let moves = || clusters.into_iter().filter(|at| self.joins.contains_key(at));
                if moves().next().is_some() && self.bends(view, shape, triangle) {
                    bad.extend(moves());
                }
            }
            if bad.is_empty() {
                return;
            }
            self.joins.retain(|from, _| !bad.contains(from));
        }
    }

    /// Leaves out what would bring more than two sides together.
    fn drop_crowded(&mut self, shape: &Shape, refined: &Refined, crowded: &[Corner]) {
        for &fine in crowded {
            if let Some(side) = refined.long_side(fine) {
                self.at.remove(&side);
            }
            for vertex in [fine, fine.next()].map(|end| refined.mesh.indices[end.index()]) {
                if (vertex as usize) < shape.weld.cluster_of.len() {
                    self.joins.remove(&shape.weld.cluster_of[Vertex(vertex)]);
                }
            }
        }
    }

    /// Whether joined ends turn a triangle over, or nearly.
    fn bends(&self, view: &View, shape: &Shape, triangle: Triangle) -> bool {
        let at = |corner: Corner| {
            let cluster = shape.topology.cluster_at[corner];
            let to = self.joins.get(&cluster).map(|&to| view.position(shape.weld.first_vertex[to]));
            to.unwrap_or(view.position_at(corner))
        };
        let normal = shape.faces.normal[triangle];
        normal != DVec3::ZERO && is_tilted(view, triangle.corners().map(at), normal)
    }
}

/// Whether there is nothing to cut off between two sides.
fn is_back_to_back(shape: &Shape, sides: [Corner; 2]) -> bool {
    let [one, other] = sides.map(|side| shape.faces.normal[side.triangle()]);
    one.dot(other) < BACK_TO_BACK_COSINE
}

fn is_face(shape: &Shape, side: Corner) -> bool {
    shape.faces.normal[side.triangle()] != DVec3::ZERO && !shape.faces.is_line(side.triangle())
}

/// The half-edges of the finer mesh that would find more than one to lie on, of those on long sides
/// and at joined ends: nobody can tell which of these open sides belong together.
fn crowded(shape: &Shape, stitches: &Stitches, refined: &Refined) -> Vec<Corner> {
    let vertices =
        |corner: Corner| [corner, corner.next()].map(|c| refined.mesh.indices[c.index()]);
    let key = |corner: Corner| {
        let ends = vertices(corner).map(|vertex| refined.mesh.positions[vertex as usize]);
        let mut ends = ends.map(|at| at.map(|along| (along + 0.0).to_bits()));
        ends.sort_unstable();
        ends
    };
    let is_joined = |vertex: u32| {
        let is_source = (vertex as usize) < shape.weld.cluster_of.len();
        is_source && stitches.joins.contains_key(&shape.weld.cluster_of[Vertex(vertex)])
    };
    let corners = || (0..refined.mesh.indices.len()).map(Corner::new);
    let is_new = |&corner: &Corner| {
        let joins = !stitches.joins.is_empty() && vertices(corner).into_iter().any(is_joined);
        joins || refined.long_side(corner).is_some()
    };
    let watched: BTreeSet<_> = corners().filter(is_new).map(key).collect();
    let mut on: BTreeMap<_, Few<Corner>> = BTreeMap::new();
    for corner in corners() {
        let key = key(corner);
        if key[0] != key[1] && watched.contains(&key) {
            on.entry(key).or_default().push(corner);
        }
    }
    on.into_values().filter(|all| all.len() > 2).flatten().collect()
}

/// Vertices on a side, from its start on, one of each place; none where two of them nearly meet.
fn in_order(view: &View, side: Corner, mut all: Few<u32>) -> Option<Few<u32>> {
    let line = Line::new(view, side);
    let at = |vertex: u32| wide(view.mesh.positions[vertex as usize]);
    let place = |vertex: u32| line.place(at(vertex));
    all.sort_unstable_by(|&one, &other| place(one).total_cmp(&place(other)).then(one.cmp(&other)));
    all.dedup_by(|one, other| at(*one) == at(*other));
    let reach = view.resolution * LINE_HEIGHT;
    let is_clear = all.windows(2).all(|pair| place(pair[1]) - place(pair[0]) > reach);
    is_clear.then_some(all)
}

/// A mesh with these vertices.
fn stitched(view: &View, shape: &Shape, stitches: &Stitches) -> Stitched {
    let mesh = &view.mesh;
    let mut stitched = Stitched { refined: Refined::whole(mesh), stands_at: Vec::new() };
    if !stitches.joins.is_empty() {
        for vertex in shape.weld.cluster_of.ids() {
            if let Some(&to) = stitches.joins.get(&shape.weld.cluster_of[vertex]) {
                let to = shape.weld.first_vertex[to];
                stitched.refined.mesh.positions[vertex.index()] = mesh.positions[to.index()];
            }
        }
    }
    let mut points = PointsOf::new();
    for (&side, all) in &stitches.at {
        let line = Line::new(view, side);
        let point = |&stands: &u32| {
            let at = stitched.refined.mesh.positions[stands as usize];
            let share = line.place(wide(at)) / line.length;
            let vertex = stitched.add((view, side), share);
            stitched.refined.mesh.positions[vertex as usize] = at;
            stitched.stands_at.push(stands);
            Point { vertex, share }
        };
        let on_side = all.iter().map(point).collect();
        points.entry(side.triangle()).or_default()[side.0 as usize % 3] = on_side;
    }
    // No triangle is so deep that it gets a vertex inside.
    cut_all(mesh, &points, f64::INFINITY, &mut stitched.refined);
    stitched
}

impl Stitched {
    fn add(&mut self, (view, side): (&View, Corner), share: f64) -> u32 {
        let [from, to] = [side, side.next()].map(|end| view.vertex_at(end).0);
        let blend = ([from, to, from], [1.0 - share, share, 0.0]);
        let (triangle, site): (Triangle, u32) = (side.triangle(), self.refined.next_site());
        self.refined.add_vertex(&view.mesh, blend, triangle, site)
    }
}
