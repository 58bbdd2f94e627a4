//! Facts: what a mesh has, counted.

use super::rules::Facts;
use super::solids::Solids;
use super::stored::normal_with_area;
use super::surface::{HalfEdge, Surface};
use super::values::count_odd;
use crate::groups::Groups;

/// What a mesh has of everything.
pub(super) fn facts(surface: &Surface) -> Facts {
    let is_first = |(place, &label): (usize, &u32)| place as u32 == label;
    let triangles = 0..surface.triangle_count();
    let has_no_area = |&t: &u32| normal_with_area(surface.triangle(t)).is_none();
    let [odd_normals, odd_tangents] = count_odd(surface.mesh);
    Facts {
        vertices: surface.mesh.positions.len(),
        triangles: surface.mesh.indices.len() / 3,
        components: surface.components().iter().enumerate().filter(|&part| is_first(part)).count(),
        border_half_edges: surface.edges().map(|(a, b)| a.len().abs_diff(b.len())).sum(),
        border_loops: border_loops(surface),
        non_manifold_edges: Solids::new(surface).crowded_edges(surface),
        hard_edges: surface.edges().filter(|edge| surface.is_hard(edge)).count(),
        flat_triangles: triangles.filter(has_no_area).count(),
        odd_normals,
        odd_tangents,
        self_intersections: None,
    }
}

/// Border half-edges follow each other where a fan of triangles leads from one to the next, so
/// that loops which only touch count apart.
fn border_loops(surface: &Surface) -> usize {
    let mut loops = Groups::singles(surface.mesh.indices.len());
    for edge in surface.edges() {
        if let ([a], [b]) = edge {
            loops.join(a.corners[0], b.corners[1]);
            loops.join(a.corners[1], b.corners[0]);
        }
    }
    let border = || surface.edges().filter(is_border).flat_map(|(a, b)| [a, b].concat());
    for half_edge in border() {
        loops.join(half_edge.corners[0], half_edge.corners[1]);
    }
    let mut firsts: Vec<u32> = border().map(|h| loops.first_of(h.corners[0])).collect();
    firsts.sort_unstable();
    firsts.dedup();
    firsts.len()
}

fn is_border((a, b): &(&[HalfEdge], &[HalfEdge])) -> bool {
    a.is_empty() || b.is_empty()
}
