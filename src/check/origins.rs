//! Which source triangle and which source vertices an element comes from.

use super::matching::match_triangles;
use super::rules::{Element, Facts, Findings, Rule};
use super::surface::Surface;
use crate::mesh::Mesh;
use crate::report::{Blend, Chamfered, TriangleKind, TriangleSource, VertexSource, VertexSources};

/// How far the weights of a blend may sum up past 1: many roundings, but no real error.
const WEIGHT_SUM_TOLERANCE: f32 = 1e-3;

/// Where the elements of a chamfered mesh come from.
pub(super) struct Origins<'a> {
    /// `#triangles`: the source corner of each corner of a triangle that is not new. All three are
    /// of one source triangle.
    pub triangles: Vec<Option<[u32; 3]>>,
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
            vertices: Some(&after.vertex_sources),
        })
    }

    /// By the order of the triangles: those of the source stand first in each submesh. None where
    /// there are too few.
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
        (first == before.triangle_count()).then(|| Origins {
            triangles: triangles.into_iter().map(|first| first.map(corners)).collect(),
            vertices: None,
        })
    }

    /// By where the triangles are.
    pub fn by_geometry([before, after]: &[Surface; 2]) -> Self {
        Origins { triangles: match_triangles(before, after), vertices: None }
    }

    /// Notes the triangles of the source that are not found. That is a breach only where there are
    /// fewer triangles than before: otherwise their parts may be there.
    pub fn check_lost(&self, findings: &mut Findings) {
        // What has no area may be thrown away: many tools do.
        let with_area = |facts: Facts| facts.triangles - facts.flat_triangles;
        if with_area(findings.after) < with_area(findings.before) {
            findings.note(Rule::Origins, Element::Mesh);
        }
        findings.lost = findings.before.triangles - self.triangles.iter().flatten().count();
        if findings.lost > 0 {
            for rule in [Rule::Flipped, Rule::FlatFace, Rule::FlatNormal, Rule::HardEdges] {
                findings.leave_out(rule, "not every triangle of the source is where it was");
            }
        }
    }

    /// `#vertices`: whether the place of each was made from a source vertex of a kind (`is_of_kind:
    /// #source vertices`); where nothing is told of one, as if it was.
    pub fn touches(&self, before: &Mesh, after: &Mesh, is_of_kind: &[bool]) -> Vec<bool> {
        if let Some(sources) = self.vertices {
            let touches = |blend: &Blend| {
                let mut used = blend.vertices.iter().zip(blend.weights).filter(|(_, w)| *w != 0.0);
                used.any(|(&vertex, _)| is_of_kind[vertex as usize])
            };
            return sources.iter().map(|source| touches(&source.surface)).collect();
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
                *held &= holds[before.indices[source as usize] as usize];
            }
        }
        let everything_holds = holds.iter().all(|&holds| holds);
        by_corners.into_iter().map(|held| held.unwrap_or(everything_holds)).collect()
    }

    /// `#source corners`: the corner of the result that each became; none where its triangle is
    /// lost.
    pub fn corners_after(&self, source_corners: usize) -> Vec<Option<u32>> {
        let mut after = vec![None; source_corners];
        for (triangle, corners) in (0u32..).zip(&self.triangles) {
            for (side, &source) in (0u32..).zip(corners.iter().flatten()) {
                after[source as usize] = Some(3 * triangle + side);
            }
        }
        after
    }
}

/// Whether every source triangle is there once, in its submesh, in its order.
fn keeps_triangles(before: &Mesh, after: &Mesh, origins: &[Option<u32>]) -> bool {
    if origins.len() != after.indices.len() / 3 {
        return false;
    }
    let mut rest = origins;
    let mut expected = 0;
    for (submesh, &indices) in after.submesh_index_counts.iter().enumerate() {
        let (here, later) = rest.split_at(indices as usize / 3);
        let before_here = before.submesh_index_counts.get(submesh).copied().unwrap_or(0) / 3;
        let in_order = here.iter().flatten().copied().eq(expected..expected + before_here);
        if !in_order {
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
