//! The result of a refined mesh, told in terms of the source.

use glam::DVec3;

use super::Refined;
use super::retold::{Elements, retold};
use crate::edges::HardEdge;
use crate::ids::{Corner, Edge, Few, IdVec};
use crate::math::unit;
use crate::mesh::Mesh;
use crate::report::{Chamfered, EdgeVerdict, Outcome, Reason, TriangleKind};
use crate::view::wide;

/// What the elements of a refined mesh are in the source.
pub struct Origins<'a> {
    elements: Elements<'a>,
    /// `#hard edges` of the source.
    coarse: &'a IdVec<Edge, HardEdge>,
    /// `#hard edges` of the refined mesh.
    fine: &'a IdVec<Edge, HardEdge>,
    /// `#hard edges` of the source, and one more: where the parts of each begin.
    first: Vec<u32>,
}

impl<'a> Origins<'a> {
    /// From the hard edges of both, those of the finer mesh in the order of the edges that they are
    /// parts of.
    pub fn new(
        source: &'a Mesh<'a>,
        refined: &'a Refined,
        coarse: &'a IdVec<Edge, HardEdge>,
        fine: &'a IdVec<Edge, HardEdge>,
    ) -> Origins<'a> {
        let (mut edge_of, mut first) = (Vec::with_capacity(fine.len()), vec![0]);
        for edge in coarse.ids() {
            edge_of.extend(refined.parts_of_side(coarse[edge].sides[0]).map(|_| edge.0));
            first.push(edge_of.len() as u32);
        }
        Origins {
            elements: Elements { source, refined, edge_of, stands_at: &[] },
            coarse,
            fine,
            first,
        }
    }

    /// The parts of an edge of the source, in its direction.
    fn parts(&self, edge: Edge) -> Few<Edge> {
        let place = edge.0 as usize;
        (self.first[place]..self.first[place + 1]).map(Edge).collect()
    }
}

/// The result of a refined mesh as one of the source.
pub fn restored(origins: &Origins, fine: Chamfered) -> Chamfered {
    let verdicts = Verdicts::new(origins, &fine).all();
    retold(&origins.elements, fine, verdicts)
}

/// One verdict for all parts of an edge.
struct Verdicts<'a> {
    origins: &'a Origins<'a>,
    fine: &'a Chamfered,
    /// `#triangles` of the refined mesh: where each stands in the result.
    place_of: Vec<u32>,
}

impl<'a> Verdicts<'a> {
    fn new(origins: &'a Origins<'a>, fine: &'a Chamfered) -> Verdicts<'a> {
        let mut place_of = vec![0; origins.elements.refined.mesh.indices.len() / 3];
        for (place, triangle) in (0u32..).zip(&fine.triangle_sources) {
            if triangle.kind == TriangleKind::Source {
                place_of[triangle.index as usize] = place;
            }
        }
        Verdicts { origins, fine, place_of }
    }

    /// `#hard edges` of the source.
    fn all(&self) -> Vec<EdgeVerdict> {
        let verdict = |edge: Edge| match *self.origins.parts(edge) {
            // It is as it was.
            [part] => EdgeVerdict { vertices: self.ends(edge), ..self.of(part) },
            ref parts => self.merged(edge, parts),
        };
        self.origins.coarse.ids().map(verdict).collect()
    }

    fn of(&self, part: Edge) -> EdgeVerdict {
        self.fine.verdicts[part.0 as usize]
    }

    /// The source vertices at the ends of an edge.
    fn ends(&self, edge: Edge) -> [u32; 2] {
        let side = self.origins.coarse[edge].sides[0];
        [side, side.next()].map(|corner| self.origins.elements.source.indices[corner.0 as usize])
    }

    /// One verdict for an edge in several parts.
    fn merged(&self, edge: Edge, parts: &[Edge]) -> EdgeVerdict {
        let all = |outcome| parts.iter().all(|&part| self.of(part).outcome == outcome);
        let outcome = if all(Outcome::Full) {
            Outcome::Full
        } else if all(Outcome::Skipped) {
            Outcome::Skipped
        } else {
            Outcome::Narrowed
        };
        let widths = match outcome {
            Outcome::Skipped => [0.0; 2],
            _ => [0, 1].map(|end| self.width_at(edge, end, parts)),
        };
        let limited = parts.iter().map(|&part| self.of(part));
        let limited = limited.filter(|verdict| verdict.reason != Reason::None);
        let worst = limited.min_by(|one, other| {
            let rank = |verdict: &EdgeVerdict| verdict.widths[0] + verdict.widths[1];
            let is_free = |verdict: &EdgeVerdict| verdict.reason != Reason::Contact;
            is_free(one).cmp(&is_free(other)).then(rank(one).total_cmp(&rank(other)))
        });
        let reason = worst.map_or(Reason::None, |verdict| verdict.reason);
        let segments = parts.iter().map(|&part| self.of(part).segments);
        let segments = segments.filter(|&segments| segments > 0).min().unwrap_or(0);
        EdgeVerdict { vertices: self.ends(edge), outcome, reason, widths, segments }
    }

    /// The mean distance of both sides from the old edge at one of its ends.
    fn width_at(&self, edge: Edge, end: usize, parts: &[Edge]) -> f32 {
        let at = |vertex: u32| wide(self.origins.elements.source.positions[vertex as usize]);
        let [from, to] = self.ends(edge).map(at);
        let along = unit(to - from);
        let part = if end == 0 { parts[0] } else { parts[parts.len() - 1] };
        let sides = self.origins.fine[part].sides;
        let corners =
            if end == 0 { [sides[0], sides[1].next()] } else { [sides[0].next(), sides[1]] };
        let width = |corner: Corner| (self.position(corner) - from).cross(along).length();
        (corners.map(width).iter().sum::<f64>() / 2.0) as f32
    }

    /// Where a corner of the refined mesh stands in the result.
    fn position(&self, corner: Corner) -> DVec3 {
        let triangle = self.place_of[corner.triangle().0 as usize];
        let mesh = &self.fine.mesh;
        let vertex = mesh.indices[3 * triangle as usize + corner.0 as usize % 3];
        wide(mesh.positions[vertex as usize])
    }
}
