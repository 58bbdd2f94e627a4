//! The result of a refined mesh, told in terms of the source.

use glam::DVec3;

use super::Refined;
use crate::edges::HardEdge;
use crate::ids::{Corner, Edge, Few, IdVec, Triangle};
use crate::math::unit;
use crate::mesh::Mesh;
use crate::report::{
    Blend, Chamfered, EdgeVerdict, Outcome, Piece, Reason, Totals, TriangleKind, TriangleSource,
};
use crate::rounding::joined;
use crate::view::wide;

/// What the elements of a refined mesh are in the source.
pub struct Origins<'a> {
    source: &'a Mesh<'a>,
    refined: &'a Refined,
    /// `#hard edges` of the source.
    coarse: &'a IdVec<Edge, HardEdge>,
    /// `#hard edges` of the refined mesh.
    fine: &'a IdVec<Edge, HardEdge>,
    /// `#hard edges` of the refined mesh: the one of the source that each is a part of.
    edge_of: Vec<Edge>,
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
            edge_of.extend(refined.parts_of_side(coarse[edge].sides[0]).map(|_| edge));
            first.push(edge_of.len() as u32);
        }
        Origins { source, refined, coarse, fine, edge_of, first }
    }

    /// The parts of an edge of the source, in its direction.
    fn parts(&self, edge: Edge) -> Few<Edge> {
        let place = edge.0 as usize;
        (self.first[place]..self.first[place + 1]).map(Edge).collect()
    }

    /// A blend of vertices that are blends themselves. All lie in one triangle of the source.
    fn blend(&self, blend: Blend) -> Blend {
        let first_added = self.source.positions.len() as u32;
        if blend.vertices.iter().all(|&vertex| vertex < first_added) {
            return blend;
        }
        let mut terms: Few<(u32, f64)> = Few::new();
        for (vertex, weight) in blend.vertices.into_iter().zip(blend.weights.map(f64::from)) {
            match vertex.checked_sub(first_added) {
                None => self.add_term(&mut terms, vertex, weight),
                Some(added) => {
                    let Blend { vertices, weights } = self.refined.added[added as usize].blend;
                    for k in 0..3 {
                        self.add_term(&mut terms, vertices[k], weight * f64::from(weights[k]));
                    }
                }
            }
        }
        if terms.len() > 3 {
            // As on rounded patches: the two that weigh most, and the rest on the first.
            return joined(|vertex| vertex, terms.into_iter().map(|(v, w)| (Blend::one(v), w)));
        }
        let first = terms[0].0;
        terms.retain(|(vertex, weight)| *vertex == first || *weight != 0.0);
        let term = |k: usize| terms.get(k).copied().unwrap_or((first, 0.0));
        let [one, two, three] = [0, 1, 2].map(term);
        Blend::new([one.0, two.0, three.0], [one.1, two.1, three.1])
    }

    /// Of vertices at one place, the first stands for all: a corner may be named by another vertex
    /// there than the one that a cut began at.
    fn add_term(&self, terms: &mut Few<(u32, f64)>, vertex: u32, weight: f64) {
        let at = |vertex: u32| self.source.positions[vertex as usize];
        match terms.iter_mut().find(|(known, _)| *known == vertex || at(*known) == at(vertex)) {
            Some((_, sum)) => *sum += weight,
            None => terms.push((vertex, weight)),
        }
    }

    fn triangle(&self, TriangleSource { kind, index }: TriangleSource) -> TriangleSource {
        let index = match kind {
            TriangleKind::Source if index as usize * 3 < self.source.indices.len() => index,
            TriangleKind::Source => {
                let first = self.refined.pieces.len() + index as usize
                    - self.refined.mesh.indices.len() / 3;
                self.refined.pieces[first].source.0
            }
            TriangleKind::Edge => self.edge_of[index as usize].0,
            TriangleKind::Corner => match index.checked_sub(self.source.positions.len() as u32) {
                None => index,
                Some(added) => nearer(&self.refined.added[added as usize].blend),
            },
        };
        TriangleSource { kind, index }
    }

    /// The triangles of the result that are pieces.
    fn pieces(&self, triangles: &[TriangleSource]) -> Vec<Piece> {
        let kept = (0u32..).zip(triangles).filter(|(_, t)| t.kind == TriangleKind::Source);
        let piece = |(triangle, source): (u32, &TriangleSource)| {
            let piece = self.refined.piece(Triangle(source.index))?;
            let corners = piece.corners.map(|weights| weights.map(|weight| weight as f32));
            Some(Piece { triangle, corners })
        };
        kept.filter_map(piece).collect()
    }
}

/// The result of a refined mesh as one of the source.
pub fn restored(origins: &Origins, fine: Chamfered) -> Chamfered {
    let verdicts = Verdicts::new(origins, &fine).all();
    let pieces = origins.pieces(&fine.triangle_sources);
    let mut told = fine;
    told.pieces = pieces;
    told.totals = counted(&verdicts, told.totals);
    told.verdicts = verdicts;
    told.vertex_sources.replace(|blend| origins.blend(blend));
    told.triangle_sources.iter_mut().for_each(|source| *source = origins.triangle(*source));
    join_submeshes(origins, &mut told);
    told
}

/// Puts the pieces behind the source triangles of their submesh, and behind them what is new.
fn join_submeshes(origins: &Origins, told: &mut Chamfered) {
    let counts = std::mem::take(&mut told.mesh.submesh_index_counts);
    let refined = origins.refined;
    let own = origins.source.submesh_index_counts.len();
    let extra = own..own + refined.belong_to.len();
    let mut starts = vec![0];
    for count in &counts {
        starts.push(starts[starts.len() - 1] + *count as usize / 3);
    }
    let kept = |k: usize| refined.mesh.submesh_index_counts.get(k).map_or(0, |count| count / 3);
    let mut all = Vec::new();
    for submesh in (0..counts.len()).filter(|submesh| !extra.contains(submesh)) {
        let belongs = |k: &usize| refined.belong_to[k - own] as usize == submesh;
        let parts = || std::iter::once(submesh).chain(extra.clone().filter(belongs));
        let middle = |k: usize| starts[k] + kept(k) as usize;
        all.extend(parts().map(|k| starts[k]..middle(k)));
        all.extend(parts().map(|k| middle(k)..starts[k + 1]));
        told.mesh.submesh_index_counts.push(parts().map(|k| counts[k]).sum());
    }
    let spans = || all.iter().cloned();
    let sources = spans().flat_map(|span| told.triangle_sources[span].iter().copied()).collect();
    let corners = |span: std::ops::Range<usize>| 3 * span.start..3 * span.end;
    let indices = spans().flat_map(|span| told.mesh.indices[corners(span)].iter().copied());
    let indices = indices.collect();
    let mut place_of = vec![0; starts[starts.len() - 1]];
    for (place, old) in (0u32..).zip(spans().flatten()) {
        place_of[old] = place;
    }
    told.pieces.iter_mut().for_each(|p| p.triangle = place_of[p.triangle as usize]);
    told.pieces.sort_unstable_by_key(|piece| piece.triangle);
    (told.triangle_sources, told.mesh.indices) = (sources, indices);
}

/// The end that a vertex on an edge is nearer to.
fn nearer(added: &Blend) -> u32 {
    added.vertices[usize::from(added.weights[1] > added.weights[0])]
}

fn counted(verdicts: &[EdgeVerdict], Totals { mean_width, counted, .. }: Totals) -> Totals {
    let hard_edges = verdicts.len() as u32;
    let mut totals = Totals { hard_edges, mean_width, counted, ..Totals::default() };
    for verdict in verdicts {
        match verdict.outcome {
            Outcome::Full => totals.chamfered += 1,
            Outcome::Narrowed => totals.narrowed += 1,
            Outcome::Skipped => totals.skipped[verdict.reason] += 1,
        }
    }
    totals
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
        let mut place_of = vec![0; origins.refined.mesh.indices.len() / 3];
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
        [side, side.next()].map(|corner| self.origins.source.indices[corner.0 as usize])
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
        let at = |vertex: u32| wide(self.origins.source.positions[vertex as usize]);
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
