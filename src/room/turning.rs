//! Turning: the diagonals that may be turned, and what they leave when they are.
//!
//! The diagonals of a flat face mean nothing: any other triangulation of it looks the same. Turning
//! the diagonal of a quad changes the surface and its streams most where the old diagonal crosses
//! the new one; if they agree there, nothing can be seen. (The region of triangles that are joined
//! by such diagonals is what a kinetic triangulation works on: O. Aichholzer and F. Aurenhammer,
//! "Straight skeletons for general polygonal figures in the plane", 1996.)

use std::collections::BTreeSet;

use glam::DVec3;

use crate::breaks::{is_hard, same_chart, uv_at};
use crate::given::Given;
use crate::ids::{Cluster, Corner, Id, IdVec, Triangle, Vertex};
use crate::math::{area_vector, unit};
use crate::tolerance::{LEVEL_HEIGHT, LINE_HEIGHT, SAME_COLOR, SAME_NORMAL, SAME_TEXTURE};
use crate::topology::Topology;

use super::triangulation::Triangulation;

/// The triangles of a mesh while diagonals are turned.
pub struct Turning<'a> {
    given: &'a Given<'a>,
    /// `#triangles`, or nothing: which are not to change.
    kept: &'a [bool],
    pub triangulation: Triangulation,
    /// Sorted: half-edges that something else depends on.
    bound: Vec<Corner>,
    /// Sorted: all edges that there were, by the clusters of their ends.
    edges: Vec<[Cluster; 2]>,
    /// Those that came.
    new_edges: BTreeSet<[Cluster; 2]>,
    is_turned: bool,
}

/// Two triangles on both sides of a diagonal that may be turned.
pub struct Quad {
    /// The ends of the diagonal, the corner across from it, and the one behind it.
    pub corners: [Corner; 4],
    /// The sides: half-edges of the source, from the corner across to the diagonal's start, and on
    /// around; none where it is a turned diagonal.
    pub outer: [Corner; 4],
}

impl<'a> Turning<'a> {
    pub fn new(given: &'a Given<'a>, kept: &'a [bool]) -> Turning<'a> {
        let topology = given.surface.topology;
        Turning {
            given,
            kept,
            triangulation: Triangulation::of_source(topology),
            bound: bound(given),
            edges: edges(topology),
            new_edges: BTreeSet::new(),
            is_turned: false,
        }
    }

    /// The quad around a diagonal that may be turned.
    pub fn quad(&self, diagonal: Corner) -> Option<Quad> {
        let triangulation = &self.triangulation;
        let other = triangulation.twin(diagonal);
        if other.is_none() || !self.may_change(diagonal) || !self.may_change(other) {
            return None;
        }
        let places = [diagonal.prev(), other.next(), other.prev(), diagonal.next()];
        let is_folded = places.iter().any(|&place| {
            let twin = triangulation.twin(place);
            twin.is_some() && [diagonal, other].iter().any(|p| p.triangle() == twin.triangle())
        });
        let at = |place: Corner| triangulation.corner_at(place);
        let corners = [at(diagonal), at(other), at(places[0]), at(places[2])];
        let is_one = self.is_one_surface([at(places[1]), at(places[3])], corners);
        let may_be = !is_folded && is_one && self.is_new(corners);
        may_be.then(|| Quad { corners, outer: places.map(|place| triangulation.side_at(place)) })
    }

    /// Turns a diagonal that may be; tells the triangle on its other side.
    pub fn turn(&mut self, diagonal: Corner) -> Triangle {
        let other = self.triangulation.twin(diagonal);
        self.triangulation.turn(diagonal);
        let ends = [diagonal, other].map(|place| self.triangulation.corner_at(place));
        self.new_edges.insert(self.ends(ends));
        self.is_turned = true;
        other.triangle()
    }

    /// The triangles, if any diagonal was turned.
    pub fn finish(self) -> Option<Triangulation> {
        self.is_turned.then_some(self.triangulation)
    }

    /// Whether a half-edge is a diagonal, and its triangle one that can have other corners.
    fn may_change(&self, diagonal: Corner) -> bool {
        let (surface, side) = (self.given.surface, self.triangulation.side_at(diagonal));
        let triangle = diagonal.triangle();
        let is_kept = self.kept.get(triangle.index()).is_some_and(|&kept| kept);
        if is_kept || surface.faces.is_line(triangle) {
            return false;
        }
        side.is_none()
            || self.given.chamfers.edges.chamfered_at[side].is_none()
                && !is_hard(surface.view, side, surface.topology.twin[side])
                && self.bound.binary_search(&side).is_err()
    }

    /// The clusters at the ends of an edge, in order.
    fn ends(&self, corners: [Corner; 2]) -> [Cluster; 2] {
        in_order(corners.map(|corner| self.given.surface.topology.cluster_at[corner]))
    }

    /// Whether the other diagonal of a quad is an edge that is not there.
    fn is_new(&self, [_, _, v, w]: [Corner; 4]) -> bool {
        let ends = self.ends([v, w]);
        ends[0] != ends[1]
            && self.edges.binary_search(&ends).is_err()
            && !self.new_edges.contains(&ends)
    }

    /// Whether the surface and all streams are the same with the other diagonal, and the quad is
    /// convex. `behind` are the corners behind the ends of the diagonal.
    fn is_one_surface(&self, behind: [Corner; 2], corners: [Corner; 4]) -> bool {
        let view = self.given.surface.view;
        let vertex = |corner: Corner| view.vertex_at(corner);
        let is_one = |one: Vertex, other: Vertex| {
            one == other || view.normal(one) == view.normal(other) && same_chart(view, one, other)
        };
        let in_one_submesh = self.submesh(corners[2].triangle()) == self.submesh(corners[3].triangle());
        in_one_submesh
            && (0..2).all(|k| is_one(vertex(corners[k]), vertex(behind[k])))
            && self.crossing(corners).is_some_and(|shares| self.agree(corners.map(vertex), shares))
    }

    fn submesh(&self, triangle: Triangle) -> usize {
        let mut end = 0;
        let counts = self.given.surface.view.mesh.submesh_index_counts;
        let ends = counts.iter().position(|count| {
            end += count / 3;
            triangle.0 < end
        });
        ends.unwrap_or(counts.len())
    }

    /// Where the diagonals of a quad cross, as shares of both; none if they do not, or in a triangle
    /// that would be a line.
    fn crossing(&self, corners: [Corner; 4]) -> Option<[f64; 2]> {
        let view = self.given.surface.view;
        let [a, b, v, w] = corners.map(|corner| view.position_at(corner));
        let normal = unit(area_vector([a, b, v]) + area_vector([b, a, w]));
        let (old, new) = (b - a, w - v);
        let across = old.cross(new).dot(normal);
        let shares = [new, old].map(|way| (v - a).cross(way).dot(normal) / across);
        let is_line = |points: [DVec3; 3]| {
            let area = area_vector(points).dot(normal);
            let longest = (0..3).map(|k| points[k].distance(points[(k + 1) % 3])).fold(0.0, f64::max);
            area <= longest * view.resolution * LINE_HEIGHT
        };
        let crosses = shares.iter().all(|share| (0.0..1.0).contains(share));
        (crosses && !is_line([w, v, a]) && !is_line([v, w, b])).then_some(shares)
    }

    /// Whether everything is the same where the diagonals cross.
    fn agree(&self, vertices: [Vertex; 4], shares: [f64; 2]) -> bool {
        let (view, [one, other]) = (self.given.surface.view, shares);
        let apart = |values: [DVec3; 4]| {
            let [a, b, v, w] = values;
            a.lerp(b, one).distance(v.lerp(w, other))
        };
        let parts_agree = |part: &dyn Fn(usize) -> f64, within: f64| {
            let [a, b, v, w] = vertices.map(|vertex| part(vertex.index()));
            (a + (b - a) * one - v - (w - v) * other).abs() <= within
        };
        let mesh = &view.mesh;
        let normals = vertices.map(|vertex| view.normal(vertex));
        apart(vertices.map(|vertex| view.position(vertex))) <= view.resolution * LEVEL_HEIGHT
            && (normals.iter().all(|&normal| normal == normals[0]) || apart(normals) <= SAME_NORMAL)
            && mesh.tangents.first().is_none_or(|_| {
                let tangent = |vertex: usize, k: usize| f64::from(mesh.tangents[vertex][k]);
                (0..4).all(|k| parts_agree(&|vertex| tangent(vertex, k), SAME_NORMAL))
            })
            && mesh.colors.first().is_none_or(|_| {
                (0..4).all(|k| parts_agree(&|vertex| mesh.colors[vertex][k].into(), SAME_COLOR))
            })
            && mesh.uvs.iter().all(|uv| {
                let part = |vertex: usize, k: usize| uv_at(uv, vertex)[k].into();
                let parts = if uv.values.is_empty() { 0 } else { uv.components as usize };
                (0..parts).all(|k| parts_agree(&|vertex| part(vertex, k), SAME_TEXTURE))
            })
    }
}

/// Sorted: half-edges inside of faces that something else depends on.
fn bound(given: &Given) -> Vec<Corner> {
    let (topology, sectors) = (given.surface.topology, given.chamfers.sectors);
    let mut bound: Vec<Corner> = topology.touching.as_flattened().to_vec();
    bound.extend(&topology.doubled);
    bound.extend(&topology.contacts);
    for &corner in &sectors.spanned {
        let around = sectors.corners(topology, sectors.sector_of[corner]);
        bound.extend(around.flat_map(|corner| [corner, corner.prev()]));
    }
    let twins: Vec<Corner> = bound.iter().map(|&side| topology.twin[side]).collect();
    bound.extend(twins.into_iter().filter(|side| side.is_some()));
    bound.sort_unstable();
    bound
}

fn in_order([one, other]: [Cluster; 2]) -> [Cluster; 2] {
    [one.min(other), one.max(other)]
}

/// Sorted: all edges by the clusters of their ends.
fn edges(topology: &Topology) -> Vec<[Cluster; 2]> {
    let at: &IdVec<Corner, Cluster> = &topology.cluster_at;
    let mut edges: Vec<[Cluster; 2]> =
        at.ids().map(|corner| in_order([at[corner], at[corner.next()]])).collect();
    edges.sort_unstable();
    edges.dedup();
    edges
}

#[cfg(test)]
mod tests {}
