//! Facts: what a mesh has, counted.

use super::loops::Loops;
use super::rules::Facts;
use super::solids::Solids;
use super::stored::normal_with_area;
use super::surface::Surface;
use super::values::count_odd;

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
        border_loops: Loops::new(surface).count(),
        non_manifold_edges: Solids::new(surface).crowded_edges(surface),
        hard_edges: surface.edges().filter(|edge| surface.is_hard(edge)).count(),
        flat_triangles: triangles.filter(has_no_area).count(),
        odd_normals,
        odd_tangents,
        self_intersections: None,
    }
}
