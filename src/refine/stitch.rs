//! The mesh whose long sides have the vertices that stand on them, and what of it is better left.

use std::collections::BTreeMap;

use glam::DVec3;

use super::shape::Point;
use super::splits::is_tilted;
use super::stitches::{Left, Stitches};
use super::{PointsOf, Refined, cut_all};
use crate::edges::Edges;
use crate::error::Error;
use crate::faces::Faces;
use crate::ids::{Cluster, Corner, Few, Triangle, Vertex};
use crate::line::Line;
use crate::math::{area_vector, unit};
use crate::memory;
use crate::mesh::{EdgeFactor, Factors, Mesh};
use crate::scale::Space;
use crate::shape::Shape;
use crate::tolerance::LEVEL_COSINE;
use crate::validity::keeps_side;
use crate::view::View;

/// Each round leaves out what the one before has found bad. Where so many do not do, nobody can tell
/// what belongs together.
const MOST_ROUNDS: usize = 8;

/// The mesh with these vertices, without those that bring nothing together; mostly none.
///
/// # Errors
/// [`Error::OutOfMemory`] where what the finer mesh needs is not to be had.
pub fn stitch(
    stitches: &mut Stitches,
    space: Space,
    shape: &Shape,
) -> Result<Option<Stitched>, Error> {
    for _ in 0..MOST_ROUNDS {
        stitches.leave_unclear(space.measured, shape);
        if stitches.is_empty() {
            return Ok(None);
        }
        let (work, rims) = (shape.chamfers().work(), shape.contacts.len());
        memory::ask(memory::of_refined(&space.source.mesh, work, rims, stitches.counts()))?;
        let mut stitched = Stitched::new(space, shape, stitches);
        let bad = stitched.bad(space.measured, shape);
        if bad.is_empty() {
            return Ok(Some(stitched));
        }
        stitches.leave(&bad);
    }
    Ok(None)
}

/// A mesh whose sides that lie on each other have the same vertices.
#[derive(Debug)]
pub struct Stitched {
    pub(super) refined: Refined,
    /// `#new vertices`: the source vertex that stands there.
    pub(super) stands_at: Vec<u32>,
    /// The sides that got vertices.
    long_sides: Vec<Corner>,
    /// Where each cluster went that was put together with others.
    joins: BTreeMap<Cluster, Cluster>,
    /// The half-edges of the finer mesh that are twins by this alone.
    new_twins: Vec<Meeting>,
    factors: OwnFactors,
}

/// The factors of the finer mesh.
#[derive(Debug, Default)]
struct OwnFactors {
    submeshes: Vec<f32>,
    vertices: Vec<f32>,
    edges: Vec<EdgeFactor>,
}

/// Half-edges of the finer mesh that lie on one edge.
#[derive(Debug, Default)]
struct Meeting {
    sides: Few<Corner>,
    /// Where the first one lay in the source.
    clusters: Option<[Cluster; 2]>,
    /// How many run to the later cluster, and how many to the earlier.
    counts: [u32; 2],
    /// Whether they come together by what was added alone.
    is_new: bool,
    /// Whether a triangle is cut there, and so has both sides.
    is_cut: bool,
}

impl Meeting {
    fn is_pair(&self) -> bool {
        self.is_new && !self.is_cut && self.counts == [1, 1]
    }

    /// Whether nobody can tell which belong together.
    fn is_crowded(&self) -> bool {
        self.is_new && self.sides.len() > 1 && self.counts != [1, 1]
    }
}

impl Stitched {
    fn new(space: Space, shape: &Shape, stitches: &Stitches) -> Stitched {
        let mesh = &space.source.mesh;
        let mut stitched = Stitched {
            refined: Refined::whole(mesh),
            stands_at: Vec::new(),
            long_sides: Vec::new(),
            joins: stitches.joins().clone(),
            new_twins: Vec::new(),
            factors: OwnFactors {
                submeshes: mesh.factors.submeshes.to_vec(),
                vertices: mesh.factors.vertices.to_vec(),
                edges: mesh.factors.edges.to_vec(),
            },
        };
        stitched.put_together(mesh, shape);
        let mut points = PointsOf::new();
        for (side, all) in stitches.sides(shape) {
            let line = Line::new(space.measured, side);
            let share =
                |vertex: u32| line.place(space.measured.position(Vertex(vertex))) / line.length;
            let on_side = all.iter().map(|&v| stitched.add((mesh, side), v, share(v))).collect();
            points.entry(side.triangle()).or_default()[side.0 as usize % 3] = on_side;
            stitched.long_sides.push(side);
        }
        // No triangle is so deep that it gets a vertex inside.
        cut_all(mesh, &points, f64::INFINITY, &mut stitched.refined);
        stitched.add_factors(mesh);
        stitched
    }

    /// Moves the ends that rounding alone has set apart.
    fn put_together(&mut self, mesh: &Mesh, shape: &Shape) {
        if self.joins.is_empty() {
            return;
        }
        for vertex in shape.weld.cluster_of.ids() {
            if let Some(&to) = self.joins.get(&shape.weld.cluster_of[vertex]) {
                let to = shape.weld.first_vertex[to];
                self.refined.mesh.positions[vertex.0 as usize] = mesh.positions[to.0 as usize];
            }
        }
    }

    /// Appends a vertex on a side, where another one stands.
    fn add(&mut self, (mesh, side): (&Mesh, Corner), stands: u32, share: f64) -> Point {
        let [from, to] = [side, side.next()].map(|end| mesh.indices[end.0 as usize]);
        let blend = ([from, to, from], [1.0 - share, share, 0.0]);
        let (triangle, site): (Triangle, u32) = (side.triangle(), self.refined.next_site());
        let vertex = self.refined.add_vertex(mesh, blend, triangle, site);
        self.refined.mesh.positions[vertex as usize] = self.refined.mesh.positions[stands as usize];
        self.stands_at.push(stands);
        let factors = &mut self.factors.vertices;
        if !factors.is_empty() {
            let [one, other] = [from, to].map(|end| f64::from(factors[end as usize]));
            factors.push((one * (1.0 - share) + other * share) as f32);
        }
        Point { vertex, share }
    }

    /// What is asked of a submesh goes for its pieces, and what is of a long side for its parts.
    fn add_factors(&mut self, mesh: &Mesh) {
        let Factors { submeshes, edges, .. } = mesh.factors;
        if !submeshes.is_empty() {
            let own = self.refined.belong_to.iter().map(|&submesh| submeshes[submesh as usize]);
            self.factors.submeshes.extend(own);
        }
        if edges.is_empty() {
            return;
        }
        let at = |vertex: u32| mesh.positions[vertex as usize].map(|x| (x + 0.0).to_bits());
        let ends = |[one, other]: [u32; 2]| {
            let (one, other) = (at(one), at(other));
            (one.min(other), one.max(other))
        };
        let mut listed = BTreeMap::new();
        for edge in edges {
            listed.entry(ends(edge.vertices)).or_insert(edge.factor);
        }
        let vertex = |end: Corner| self.refined.mesh.indices[end.0 as usize];
        for &side in &self.long_sides {
            let whole = [side, side.next()].map(|end| mesh.indices[end.0 as usize]);
            let Some(&factor) = listed.get(&ends(whole)) else { continue };
            let parts = self.refined.parts_of_side(side);
            let factor_of =
                |part: Corner| EdgeFactor { vertices: [part, part.next()].map(vertex), factor };
            self.factors.edges.extend(parts.map(factor_of));
        }
    }

    /// The finer mesh, on which the same rests.
    pub fn as_mesh<'a>(&'a self, source: &Mesh<'a>) -> Mesh<'a> {
        let OwnFactors { submeshes, vertices, edges } = &self.factors;
        Mesh { factors: Factors { submeshes, vertices, edges }, ..self.refined.as_mesh(source) }
    }

    /// The planes of the pieces: those of their source triangles. What stands on a side may be a little off
    /// it, and small pieces would lead what is pulled over them much farther off.
    pub fn planes(&self, source: &Faces) -> Vec<(Triangle, DVec3)> {
        let pieces = self.refined.pieces.iter();
        pieces.map(|piece| (piece.triangle, source.normal[piece.source])).collect()
    }

    /// What brings no chamfer, by the edges of the finer mesh.
    pub fn idle(&self, shape: &Shape, edges: &Edges) -> Left {
        let is_chamfered = |meeting: &&Meeting| edges.chamfered_at[meeting.sides[0]].is_some();
        self.all_but(shape, self.new_twins.iter().filter(is_chamfered))
    }

    /// All that none of these half-edges needs.
    fn all_but<'a>(&self, shape: &Shape, meetings: impl Iterator<Item = &'a Meeting>) -> Left {
        let mut left = Left {
            sides: self.long_sides.iter().copied().collect(),
            places: self.joins.values().copied().collect(),
        };
        for side in meetings.flat_map(|meeting| meeting.sides.iter().copied()) {
            self.refined.long_side(side).map(|side| left.sides.remove(&side));
            for end in self.ends(shape, side) {
                left.places.remove(&end);
            }
        }
        left
    }

    /// What would turn a triangle over, or nearly; what would cut a face beside; what would bring more than
    /// two sides together, as where a triangle is cut along an edge of others, or two that run the same
    /// way; and what brings none together.
    fn bad(&mut self, view: &View, shape: &Shape) -> Left {
        let mut meetings = self.meetings(shape);
        let mut bad = self.all_but(shape, meetings.iter().filter(|meeting| meeting.is_pair()));
        for &side in meetings.iter().filter(|m| m.is_crowded()).flat_map(|m| &m.sides) {
            bad.sides.extend(self.refined.long_side(side));
            bad.sides.extend(self.cut_at(side).into_iter().flat_map(|t| self.long_sides_of(t)));
            let ends = self.ends(shape, side).into_iter();
            bad.places.extend(ends.filter(|end| self.joins.contains_key(end)));
        }
        self.add_tilted(view, shape, &mut bad);
        self.add_cutting(view, shape, &mut bad);
        meetings.retain(Meeting::is_pair);
        self.new_twins = meetings;
        bad
    }

    /// The source triangle that is cut along a half-edge of the finer mesh.
    fn cut_at(&self, side: Corner) -> Option<Triangle> {
        let piece = self.refined.piece(side.triangle())?;
        piece.source_side(side.0 as usize % 3).is_none().then_some(piece.source)
    }

    /// Those of a source triangle.
    pub(super) fn long_sides_of(&self, triangle: Triangle) -> impl Iterator<Item = Corner> + '_ {
        let first = self.long_sides.partition_point(|side| side.triangle() < triangle);
        let own = self.long_sides[first..].iter();
        own.take_while(move |side| side.triangle() == triangle).copied()
    }

    fn add_tilted(&self, view: &View, shape: &Shape, bad: &mut Left) {
        let at =
            |corner: Corner| view.position(shape.weld.first_vertex[self.cluster(shape, corner)]);
        let is_low = |triangle: Triangle, source: Triangle| {
            bends(view, triangle.corners().map(at), shape.faces.normal[source])
        };
        for piece in &self.refined.pieces {
            if is_low(piece.triangle, piece.source) {
                bad.sides.extend(self.long_sides_of(piece.source));
            }
        }
        if self.joins.is_empty() {
            return;
        }
        for triangle in view.triangles() {
            let clusters = triangle.corners().map(|corner| shape.topology.cluster_at[corner]);
            let moved = || clusters.iter().filter_map(|cluster| self.joins.get(cluster));
            let place = |cluster: Cluster| self.joins.get(&cluster).copied().unwrap_or(cluster);
            let points = clusters.map(|c| view.position(shape.weld.first_vertex[place(c)]));
            let (old, normal) = (view.triangle(triangle), shape.faces.normal[triangle]);
            let is_worse = || {
                bends(view, points, normal) && !bends(view, old, normal)
                    || !keeps_side([old, points], |area| area)
            };
            if moved().next().is_some() && is_worse() {
                bad.places.extend(moved());
            }
        }
    }

    /// All half-edges on parts of long sides and on cuts, and at ends that are put together.
    fn meetings(&self, shape: &Shape) -> Vec<Meeting> {
        let parts = self.long_sides.iter().flat_map(|&side| self.refined.parts_of_side(side));
        let pieces = self.refined.pieces.iter().flat_map(|piece| piece.triangle.corners());
        let cuts = pieces.filter(|&side| self.cut_at(side).is_some());
        let cuts =
            cuts.map(|cut| (self.ends(shape, cut), Meeting { is_cut: true, ..Meeting::new() }));
        let parts = parts.map(|part| (self.ends(shape, part), Meeting::new()));
        let mut on: BTreeMap<[Cluster; 2], Meeting> = cuts.chain(parts).collect();
        let mut is_end = vec![false; shape.weld.first_vertex.len()];
        on.keys().flatten().for_each(|end| is_end[end.0 as usize] = true);
        for corner in (0..self.refined.mesh.indices.len() as u32).map(Corner) {
            let sources = [corner, corner.next()].map(|end| self.source_cluster(shape, end));
            let moves = sources.iter().any(|end| self.joins.contains_key(end));
            if !moves && !sources.iter().all(|end| is_end[end.0 as usize]) {
                continue;
            }
            let [from, to] = [corner, corner.next()].map(|end| self.cluster(shape, end));
            let across = self.cluster(shape, corner.next().next());
            let ends = [from.min(to), from.max(to)];
            let meeting = if moves { Some(on.entry(ends).or_default()) } else { on.get_mut(&ends) };
            if let Some(meeting) = meeting.filter(|_| from != to && !ends.contains(&across)) {
                let own = [sources[0].min(sources[1]), sources[0].max(sources[1])];
                meeting.is_new |= *meeting.clusters.get_or_insert(own) != own;
                meeting.counts[usize::from(from > to)] += 1;
                meeting.sides.push(corner);
            }
        }
        on.into_values().collect()
    }

    /// The clusters of a half-edge of the finer mesh, lower first.
    fn ends(&self, shape: &Shape, side: Corner) -> [Cluster; 2] {
        let ends = [side, side.next()].map(|end| self.cluster(shape, end));
        [ends[0].min(ends[1]), ends[0].max(ends[1])]
    }

    /// The cluster of the source that a corner of the finer mesh is put to.
    pub(super) fn cluster(&self, shape: &Shape, corner: Corner) -> Cluster {
        let cluster = self.source_cluster(shape, corner);
        self.joins.get(&cluster).copied().unwrap_or(cluster)
    }

    /// The cluster of the source that a corner of the finer mesh stands at.
    fn source_cluster(&self, shape: &Shape, corner: Corner) -> Cluster {
        let vertex = self.refined.mesh.indices[corner.0 as usize] as usize;
        let added = vertex.checked_sub(shape.weld.cluster_of.len());
        let vertex = added.map_or(vertex as u32, |added| self.stands_at[added]);
        shape.weld.cluster_of[Vertex(vertex)]
    }
}

impl Meeting {
    /// On a part of a long side, or where a triangle is cut.
    fn new() -> Meeting {
        Meeting { is_new: true, ..Meeting::default() }
    }
}

/// Whether a triangle would be so low that rounding turns it over, or leaves the plane that it was in.
fn bends(view: &View, points: [DVec3; 3], normal: DVec3) -> bool {
    is_tilted(view, points, normal) || unit(area_vector(points)).dot(normal) < LEVEL_COSINE
}
