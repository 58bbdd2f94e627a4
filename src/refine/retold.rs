//! A result of a refined mesh with all its elements named as those of the source.

use super::shape::side_by_side;
use super::{Refined, WHOLE};
use crate::ids::{Few, Triangle};
use crate::mesh::Mesh;
use crate::report::{
    Blend, Chamfered, EdgeVerdict, Outcome, Piece, Totals, TriangleKind, TriangleSource,
};
use crate::rounding::joined;

/// What the elements of a refined mesh are in the source.
pub(super) struct Elements<'a> {
    pub source: &'a Mesh<'a>,
    pub refined: &'a Refined,
    /// `#verdicts` of the refined mesh: the one of the source that each belongs to.
    pub edge_of: Vec<u32>,
    /// `#new vertices` or empty: the source vertex that stands there.
    pub stands_at: &'a [u32],
}

impl Elements<'_> {
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
            TriangleKind::Edge => self.edge_of[index as usize],
            TriangleKind::Corner => match index.checked_sub(self.source.positions.len() as u32) {
                None => index,
                Some(added) => match self.stands_at.get(added as usize) {
                    Some(&vertex) => vertex,
                    None => nearer(&self.refined.added[added as usize].blend),
                },
            },
        };
        TriangleSource { kind, index }
    }

    /// The triangles of the result that are pieces. Those of the refined mesh may be in pieces, too.
    fn pieces(&self, fine: &Chamfered) -> Vec<Piece> {
        let kept = (0u32..).zip(&fine.triangle_sources);
        let kept = kept.filter(|(_, source)| source.kind == TriangleKind::Source);
        let piece = |(triangle, source): (u32, &TriangleSource)| {
            let inner = fine.pieces.binary_search_by_key(&triangle, |piece| piece.triangle).ok();
            let inner = inner.map(|place| fine.pieces[place].corners);
            let outer = self.refined.piece(Triangle(source.index)).map(|piece| piece.corners);
            let corners = match (inner, outer) {
                (None, None) => return None,
                (Some(inner), None) => inner,
                (None, Some(outer)) => outer.map(|weights| weights.map(|weight| weight as f32)),
                (Some(inner), Some(outer)) => within(inner, outer),
            };
            Some(Piece { triangle, corners })
        };
        kept.filter_map(piece).collect()
    }
}

/// Places in a piece as places in its triangle.
fn within(inner: [[f32; 3]; 3], outer: [[f64; 3]; 3]) -> [[f32; 3]; 3] {
    inner.map(|weights| match WHOLE.iter().position(|own| own.map(|w| w as f32) == weights) {
        Some(place) => outer[place].map(|weight| weight as f32),
        None => std::array::from_fn(|k| {
            let terms = (0..3).map(|corner| f64::from(weights[corner]) * outer[corner][k]);
            terms.sum::<f64>() as f32
        }),
    })
}

/// A result of a refined mesh as one of the source, with the verdicts of that.
pub(super) fn retold(
    elements: &Elements,
    fine: Chamfered,
    verdicts: Vec<EdgeVerdict>,
) -> Chamfered {
    let pieces = elements.pieces(&fine);
    let mut told = fine;
    told.pieces = pieces;
    told.totals = counted(&verdicts, told.totals);
    told.verdicts = verdicts;
    told.vertex_sources.replace(|blend| elements.blend(blend));
    told.triangle_sources.iter_mut().for_each(|source| *source = elements.triangle(*source));
    join_submeshes(elements, &mut told);
    told
}

/// Puts the pieces behind the source triangles of their submesh, and behind them what is new.
fn join_submeshes(elements: &Elements, told: &mut Chamfered) {
    let counts = std::mem::take(&mut told.mesh.submesh_index_counts);
    let refined = elements.refined;
    let own = elements.source.submesh_index_counts.len();
    let extra = own..own + refined.belong_to.len();
    let mut starts = vec![0];
    for count in &counts {
        starts.push(starts[starts.len() - 1] + *count as usize / 3);
    }
    let is_kept = |source: &TriangleSource| source.kind == TriangleKind::Source;
    let sources = &told.triangle_sources;
    let kept = |k: usize| sources[starts[k]..starts[k + 1]].partition_point(is_kept);
    let mut all = Vec::new();
    for submesh in (0..counts.len()).filter(|submesh| !extra.contains(submesh)) {
        let belongs = |k: &usize| refined.belong_to[k - own] as usize == submesh;
        let parts = || std::iter::once(submesh).chain(extra.clone().filter(belongs));
        let first = |k: usize| refined.mesh.submesh_index_counts.get(k).filter(|_| k < own);
        let first_piece = |k: usize| starts[k] + first(k).map_or(0, |count| *count as usize / 3);
        all.push(starts[submesh]..first_piece(submesh));
        let mut pieces: Vec<usize> =
            parts().flat_map(|k| first_piece(k)..starts[k] + kept(k)).collect();
        pieces.sort_by_key(|&place| sources[place].index);
        let whole =
            |source: u32| starts[submesh] + (source - sources[starts[submesh]].index) as usize;
        put_side_by_side(&mut pieces, told, whole);
        all.extend(pieces.into_iter().map(|place| place..place + 1));
        all.extend(parts().map(|k| starts[k] + kept(k)..starts[k + 1]));
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

/// Puts the pieces of each triangle, which stand together, behind such as they lie beside, from the one
/// on that stands for the whole: a piece that is in pieces itself is told by any of them.
fn put_side_by_side(pieces: &mut [usize], told: &Chamfered, whole: impl Fn(u32) -> usize) {
    let corners = |place: usize| {
        let found = told.pieces.binary_search_by_key(&(place as u32), |piece| piece.triangle);
        found.map_or(&[][..], |found| &told.pieces[found].corners)
    };
    let are_beside = |one: &usize, other: &usize| {
        let [one, other] = [*one, *other].map(corners);
        one.iter().filter(|corner| other.contains(corner)).count() == 2
    };
    let source = |place: usize| told.triangle_sources[place].index;
    for of_one in pieces.chunk_by_mut(|&one, &other| source(one) == source(other)) {
        let mut all = vec![whole(source(of_one[0]))];
        all.extend_from_slice(of_one);
        side_by_side(&mut all, are_beside);
        of_one.copy_from_slice(&all[1..]);
    }
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
