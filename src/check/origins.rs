//! Which source triangle and which source vertices an element comes from.

use super::matching::{Matched, match_triangles};
use super::rules::{Element, Findings, Matching, Rule};
use super::surface::Surface;
use super::triangles::normal_with_area;
use crate::mesh::Mesh;
use crate::report::{Blend, Chamfered, TriangleKind, TriangleSource, VertexSource};

/// How far the weights of a blend may sum up past 1: many roundings, but no real error.
const WEIGHT_SUM_TOLERANCE: f32 = 1e-3;

/// Where the elements of a chamfered mesh come from.
pub(super) struct Origins<'a> {
    /// `#triangles`: the source corner of each corner of a triangle that is not new. All three are
    /// of one source triangle.
    pub triangles: Vec<Option<[u32; 3]>>,
    vertices: Option<&'a [VertexSource]>,
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
            if ![source.surface, source.chart].iter().all(|blend| is_valid(blend, source_vertices))
            {
                findings.note(Rule::Origins, Element::Vertex(vertex as u32));
            }
        }
        let corners = |source: Option<u32>| source.map(|t| [0, 1, 2].map(|side| 3 * t + side));
        (findings.count(Rule::Origins) == 0).then_some(Origins {
            triangles: triangles.into_iter().map(corners).collect(),
            vertices: Some(&after.vertex_sources),
        })
    }

    /// By the order of the triangles, or by where they are; a breach for each that is lost.
    pub fn inferred([before, after]: &[Surface; 2], findings: &mut Findings) -> Self {
        let Matched { triangles, lost, order_kept } = match_triangles(before, after);
        findings.matching = if order_kept { Matching::Order } else { Matching::Geometry };
        // What has no area may be thrown away: many tools do.
        for triangle in lost {
            if normal_with_area(before.triangle(triangle)).is_some() {
                findings.note(Rule::Origins, Element::SourceTriangle(triangle));
            }
        }
        Origins { triangles, vertices: None }
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
                .map(|source| holds_for(&source.surface) && holds_for(&source.chart))
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
