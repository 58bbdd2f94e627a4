//! Which source triangle and which source vertices an element comes from.

use super::matching::match_triangles;
use super::pieces::{Cut, Cuts, is_covered, pieces_in_order};
use super::rules::{Element, Facts, Findings, Rule};
use super::surface::Surface;
use crate::mesh::Mesh;
use crate::report::{Blend, Chamfered, TriangleKind, TriangleSource, VertexSource, VertexSources};

/// How far the weights of a blend may sum up past 1: many roundings, but no real error.
const WEIGHT_SUM_TOLERANCE: f32 = 1e-3;

/// Where the elements of a chamfered mesh come from.
pub(super) struct Origins<'a> {
    /// `#triangles`: the source corner of each corner of a triangle that is not new. All three are
    /// of one source triangle. A piece of one has all of its corners: [`Cut`] tells which of them
    /// are its own.
    pub triangles: Vec<Option<[u32; 3]>>,
    /// The triangles that are pieces of source triangles.
    cuts: Cuts,
    vertices: Option<&'a VertexSources>,
}

impl<'a> Origins<'a> {
    /// By the provenance of a chamfered mesh; none, and a breach, where that cannot be.
    pub fn told(before: &Mesh, after: &'a Chamfered, findings: &mut Findings) -> Option<Self> {
        let source_of =
            |source: &TriangleSource| (source.kind == TriangleKind::Source).then_some(source.index);
        let triangles: Vec<_> = after.triangle_sources.iter().map(source_of).collect();
        let kept = after.mesh.positions.len() >= before.positions.len()
            && keeps_triangles(before, &after.mesh.as_mesh(), &triangles)
            && is_covered(before.indices.len() / 3, &triangles, &after.pieces)
            && after.vertex_sources.len() == after.mesh.positions.len();
        if !kept {
            findings.note(Rule::Origins, Element::Mesh);
            return None;
        }
        let source_vertices = before.positions.len() as u32;
        for (vertex, source) in after.vertex_sources.iter().enumerate() {
            let blends = [source.surface, source.chart, source.owner];
            let continues = source.owner_channels != 0 || source.owner == source.chart;
            if !continues || !blends.iter().all(|blend| is_valid(blend, source_vertices)) {
                findings.note(Rule::Origins, Element::Vertex(vertex as u32));
            }
        }
        let corners = |source: Option<u32>| source.map(|t| [0, 1, 2].map(|side| 3 * t + side));
        (findings.count(Rule::Origins) == 0).then_some(Origins {
            triangles: triangles.into_iter().map(corners).collect(),
            cuts: after.pieces.iter().map(|piece| (piece.triangle, Cut::told(piece))).collect(),
            vertices: Some(&after.vertex_sources),
        })
    }

    /// By the order of the triangles: those of the source stand first in each submesh, or their
    /// first pieces in their place, and then the other pieces. None where there are too few.
    pub fn in_order([before, after]: &[Surface; 2]) -> Option<Self> {
        let mut triangles = Vec::with_capacity(after.triangle_count() as usize);
        let mut first = 0;
        for (submesh, &indices) in after.mesh.submesh_index_counts.iter().enumerate() {
            let before = before.mesh.submesh_index_counts.get(submesh).map_or(0, |count| count / 3);
            let added = (indices / 3).checked_sub(before)?;
            triangles.extend((3 * first..3 * (first + before)).step_by(3).map(Some));
            triangles.extend(std::iter::repeat_n(None, added as usize));
            first += before;
        }
        let corners = |first: u32| [0, 1, 2].map(|side| first + side);
        (first == before.triangle_count()).then(|| {
            let mut triangles: Vec<_> =
                triangles.into_iter().map(|first| first.map(corners)).collect();
            let cuts = pieces_in_order([before, after], &mut triangles);
            Origins { triangles, cuts, vertices: None }
        })
    }

    /// By the order of the triangles, each of which may begin at another corner. Pieces are not
    /// looked for.
    pub fn in_turned_order(surfaces: &[Surface; 2]) -> Option<Self> {
        let in_order = Origins::in_order(surfaces)?;
        let turned = |(triangle, corners): (usize, Option<[u32; 3]>)| {
            corners.map(|corners| nearest_turn(surfaces, triangle as u32, corners))
        };
        let triangles = in_order.triangles.into_iter().enumerate().map(turned).collect();
        Some(Origins { triangles, cuts: Cuts::new(), vertices: None })
    }

    /// By where the triangles are.
    pub fn by_geometry([before, after]: &[Surface; 2]) -> Self {
        let triangles = match_triangles(before, after);
        Origins { triangles, cuts: Cuts::new(), vertices: None }
    }

    /// Notes the triangles of the source that are not found. That is a breach only where there are
    /// fewer triangles than before: otherwise their parts may be there.
    pub fn check_lost(&self, findings: &mut Findings) {
        // What has no area may be thrown away: many tools do.
        let with_area = |facts: Facts| facts.triangles - facts.flat_triangles;
        if with_area(findings.after) < with_area(findings.before) {
            findings.note(Rule::Origins, Element::Mesh);
        }
        let mut found: Vec<u32> =
            self.triangles.iter().flatten().map(|[first, ..]| first / 3).collect();
        found.sort_unstable();
        found.dedup();
        findings.lost = findings.before.triangles - found.len();
        if findings.lost > 0 {
            for rule in [Rule::Flipped, Rule::FlatFace, Rule::FlatNormal, Rule::HardEdges] {
                findings.leave_out(rule, "not every triangle of the source is where it was");
            }
        }
    }

    /// Whether it is told from which vertices each was made.
    pub fn are_told(&self) -> bool {
        self.vertices.is_some()
    }

    /// `#vertices`: whether the place of each was made from a source vertex of a kind (`is_of_kind:
    /// #source vertices`); where nothing is told of one, as if it was.
    pub fn touches(&self, before: &Mesh, after: &Mesh, is_of_kind: &[bool]) -> Vec<bool> {
        if let Some(sources) = self.vertices {
            let touches = |blend: &Blend| {
                let mut used = blend.vertices.iter().zip(blend.weights).filter(|(_, w)| *w != 0.0);
                used.any(|(&vertex, _)| is_of_kind[vertex as usize])
            };
            // One that goes far is told by a triangle that need not be at its own place.
            let is_own = |vertex: usize| is_of_kind.get(vertex).is_some_and(|&is| is);
            let all = sources.iter().enumerate();
            return all.map(|(v, source)| is_own(v) || touches(&source.surface)).collect();
        }
        let mut known = vec![None; after.positions.len()];
        for (triangle, corners) in self.triangles.iter().enumerate() {
            for (side, &source) in corners.iter().flatten().enumerate() {
                let touches =
                    known[after.indices[3 * triangle + side] as usize].get_or_insert(false);
                *touches |= is_of_kind[before.indices[source as usize] as usize];
            }
        }
        known.into_iter().map(|touches| touches.unwrap_or(true)).collect()
    }

    /// `#vertices`: whether everything that each was made from satisfies a condition on source
    /// vertices (`holds: #source vertices`).
    pub fn all_hold(&self, before: &Mesh, after: &Mesh, holds: &[bool]) -> Vec<bool> {
        let holds_for = |blend: &Blend| {
            blend.vertices.iter().zip(blend.weights).all(|(&v, w)| w == 0.0 || holds[v as usize])
        };
        match self.vertices {
            Some(sources) => sources
                .iter()
                .map(|VertexSource { surface, chart, owner, .. }| {
                    [surface, chart, owner].iter().all(holds_for)
                })
                .collect(),
            None => self.corners_hold(before, after, holds),
        }
    }

    /// By the corners that a vertex is at; one that is only in new triangles may be made from
    /// anything.
    fn corners_hold(&self, before: &Mesh, after: &Mesh, holds: &[bool]) -> Vec<bool> {
        let mut by_corners = vec![None; after.positions.len()];
        for (triangle, corners) in self.triangles.iter().enumerate() {
            for (side, &source) in corners.iter().flatten().enumerate() {
                let vertex = after.indices[3 * triangle + side] as usize;
                let held = by_corners[vertex].get_or_insert(true);
                // What a cut has added is made from two of the corners.
                let made_from = match self.own_corner(3 * triangle as u32 + side as u32) {
                    Some(own) => own..own + 1,
                    None => source - source % 3..source - source % 3 + 3,
                };
                *held &= made_from
                    .into_iter()
                    .all(|source| holds[before.indices[source as usize] as usize]);
            }
        }
        let everything_holds = holds.iter().all(|&holds| holds);
        by_corners.into_iter().map(|held| held.unwrap_or(everything_holds)).collect()
    }

    /// `#source corners`: the corner of the result that each became; none where its triangle is
    /// lost.
    pub fn corners_after(&self, source_corners: usize) -> Vec<Option<u32>> {
        let mut after = vec![None; source_corners];
        for corner in 0..3 * self.triangles.len() as u32 {
            if let Some(source) = self.own_corner(corner) {
                after[source as usize] = Some(corner);
            }
        }
        after
    }

    /// The source corner that a corner of the result is; none of what is new, be it in a piece of
    /// a source triangle.
    pub fn own_corner(&self, corner: u32) -> Option<u32> {
        let (triangle, side) = (corner / 3, corner as usize % 3);
        let corners = self.triangles[triangle as usize]?;
        let is_own = self.cuts.get(&triangle).is_none_or(|cut| cut.is_own[side]);
        is_own.then_some(corners[side])
    }
}

/// The source corners of a triangle's, from the one on that brings them nearest.
fn nearest_turn([before, after]: &[Surface; 2], triangle: u32, corners: [u32; 3]) -> [u32; 3] {
    let turned = |by: usize| [0, 1, 2].map(|k| corners[(k + by) % 3]);
    let distance = |turn: &[u32; 3]| {
        let apart = |k: usize| {
            let [old, new] = [turn[k], 3 * triangle + k as u32];
            before.position(old).distance_squared(after.position(new))
        };
        (0..3).map(apart).sum::<f64>()
    };
    let turns = [0, 1, 2].map(turned);
    turns.into_iter().min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap_or(corners)
}

/// Whether every source triangle is there, in its submesh, in its order; pieces may follow.
fn keeps_triangles(before: &Mesh, after: &Mesh, origins: &[Option<u32>]) -> bool {
    if origins.len() != after.indices.len() / 3 {
        return false;
    }
    let mut rest = origins;
    let mut expected = 0;
    for (submesh, &indices) in after.submesh_index_counts.iter().enumerate() {
        let (here, later) = rest.split_at(indices as usize / 3);
        let before_here = before.submesh_index_counts.get(submesh).copied().unwrap_or(0) / 3;
        let of_here = expected..expected + before_here;
        let mut of_source = here.iter().flatten().copied();
        if !of_source.by_ref().take(of_here.len()).eq(of_here.clone())
            || !of_source.all(|piece| of_here.contains(&piece))
        {
            return false;
        }
        expected += before_here;
        rest = later;
    }
    expected as usize == before.indices.len() / 3
}

fn is_valid(blend: &Blend, source_vertices: u32) -> bool {
    let sum: f32 = blend.weights.iter().sum();
    (sum - 1.0).abs() <= WEIGHT_SUM_TOLERANCE
        && blend.vertices.iter().all(|&vertex| vertex < source_vertices)
}
