//! Which source triangle and which source vertices an element comes from.

use super::rules::{Element, Findings, Rule};
use crate::mesh::Mesh;
use crate::report::{Blend, Chamfered, Outcome, TriangleKind, TriangleSource, VertexSource};

/// How far the weights of a blend may sum up past 1: many roundings, but no real error.
const WEIGHT_SUM_TOLERANCE: f32 = 1e-3;

/// Where the elements of a chamfered mesh come from.
pub(super) struct Origins<'a> {
    /// `#triangles`: the source triangle of each that is not new.
    pub triangles: Vec<Option<u32>>,
    vertices: Option<&'a [VertexSource]>,
}

impl<'a> Origins<'a> {
    /// By the provenance of a chamfered mesh; none, and a breach, where that cannot be.
    pub fn told(before: &Mesh, after: &'a Chamfered, findings: &mut Findings) -> Option<Self> {
        let source_of =
            |source: &TriangleSource| (source.kind == TriangleKind::Source).then_some(source.index);
        let triangles: Vec<_> = after.triangle_sources.iter().map(source_of).collect();
        let kept = keeps_vertices(before, &after.mesh.as_mesh())
            && keeps_triangles(before, &after.mesh.as_mesh(), &triangles)
            && after.vertex_sources.len() == after.mesh.positions.len();
        if !kept {
            findings.note(Rule::Origins, Element::Mesh);
            return None;
        }
        let source_vertices = before.positions.len() as u32;
        for (vertex, source) in after.vertex_sources.iter().enumerate() {
            let blends = [source.surface, source.chart, source.owner];
            if !blends.iter().all(|blend| is_valid(blend, source_vertices)) {
                findings.note(Rule::Origins, Element::Vertex(vertex as u32));
            }
        }
        check_verdicts(before, after, findings);
        findings.is_sound().then_some(Origins { triangles, vertices: Some(&after.vertex_sources) })
    }

    /// By the order of the triangles: in each submesh those of the source stand first.
    pub fn inferred(before: &Mesh, after: &Mesh, findings: &mut Findings) -> Option<Self> {
        let mut triangles = Vec::with_capacity(after.indices.len() / 3);
        let mut first = 0;
        for (submesh, &indices) in after.submesh_index_counts.iter().enumerate() {
            let kept = before.submesh_index_counts.get(submesh).copied().unwrap_or(0) / 3;
            triangles.extend((first..first + kept).map(Some));
            triangles.resize(triangles.len() + (indices / 3).saturating_sub(kept) as usize, None);
            first += kept;
        }
        let kept = keeps_vertices(before, after) && keeps_triangles(before, after, &triangles);
        if !kept {
            findings.note(Rule::Origins, Element::Mesh);
        }
        kept.then_some(Origins { triangles, vertices: None })
    }

    /// Whether everything that a vertex was made from satisfies a condition on source vertices
    /// (`holds: #source vertices`).
    pub fn all_hold(&self, vertex: usize, holds: &[bool]) -> bool {
        let holds_for = |blend: &Blend| {
            blend.vertices.iter().zip(blend.weights).all(|(&v, w)| w == 0.0 || holds[v as usize])
        };
        match self.vertices {
            Some(sources) => {
                let VertexSource { surface, chart, owner, .. } = &sources[vertex];
                [surface, chart, owner].into_iter().all(holds_for)
            }
            None if vertex < holds.len() => holds[vertex],
            None => holds.iter().all(|&holds| holds),
        }
    }
}

/// Each new triangle names a verdict or source vertex that exists, and the totals are those of the
/// verdicts.
fn check_verdicts(before: &Mesh, after: &Chamfered, findings: &mut Findings) {
    for (triangle, source) in (0u32..).zip(&after.triangle_sources) {
        let count = match source.kind {
            TriangleKind::Source => before.indices.len() / 3,
            TriangleKind::Edge => after.verdicts.len(),
            TriangleKind::Corner => before.positions.len(),
        };
        if source.index as usize >= count {
            findings.note(Rule::Verdicts, Element::Triangle(triangle));
        }
    }
    let with = |outcome: Outcome| {
        after.verdicts.iter().filter(|verdict| verdict.outcome == outcome).count() as u32
    };
    let totals = &after.totals;
    let add_up = totals.hard_edges as usize == after.verdicts.len()
        && totals.chamfered == with(Outcome::Full)
        && totals.narrowed == with(Outcome::Narrowed)
        && totals.skipped.iter().sum::<u32>() == with(Outcome::Skipped);
    if !add_up {
        findings.note(Rule::Verdicts, Element::Mesh);
    }
}

fn keeps_vertices(before: &Mesh, after: &Mesh) -> bool {
    after.positions.len() >= before.positions.len()
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
