//! Streams vertex by vertex: lengths, finiteness, unit vectors, colour range.

use glam::DVec3;

use super::origins::Origins;
use super::rules::{Element, Findings, Rule};
use crate::mesh::Mesh;

/// How far a unit vector may be from length 1, and a tangent from a right angle: what importers
/// leave behind that store directions in 10 to 16 bits.
const UNIT_TOLERANCE: f64 = 1e-3;

/// How far a colour may leave the source's range, relative to its size: rounding of a blend.
const COLOR_TOLERANCE: f32 = 1e-6;

/// Whether a mesh can be walked: lengths fit, indices are in range, positions and normals finite.
pub(super) fn is_well_formed(mesh: &Mesh) -> bool {
    let mut findings = Findings::default();
    check_form(mesh, mesh, &mut findings);
    check_finite(mesh, &mut findings);
    findings.is_sound()
}

/// Same streams as before, one value per vertex, counts that add up, indices in range.
pub(super) fn check_form(before: &Mesh, after: &Mesh, findings: &mut Findings) {
    let vertices = after.positions.len();
    let fits = |before: usize, after: usize| after == if before == 0 { 0 } else { vertices };
    let total: u64 = after.submesh_index_counts.iter().map(|&count| u64::from(count)).sum();
    let well_formed = after.normals.len() == vertices
        && fits(before.tangents.len(), after.tangents.len())
        && fits(before.colors.len(), after.colors.len())
        && before.uvs.iter().zip(&after.uvs).all(|(before, after)| {
            before.components == after.components
                && after.values.len() == vertices * after.components as usize
        })
        && after.submesh_index_counts.len() >= before.submesh_index_counts.len()
        && after.submesh_index_counts.iter().all(|count| count % 3 == 0)
        && total == after.indices.len() as u64;
    if !well_formed {
        findings.note(Rule::Streams, Element::Mesh);
    }
    for (place, &index) in after.indices.iter().enumerate() {
        if index as usize >= vertices {
            findings.note(Rule::IndexRange, Element::Index(place as u32));
        }
    }
}

/// Every value of every stream is finite.
pub(super) fn check_finite(mesh: &Mesh, findings: &mut Findings) {
    let mut check = |values: &[f32], components: usize| {
        for (vertex, value) in values.chunks(components.max(1)).enumerate() {
            if !value.iter().all(|along| along.is_finite()) {
                findings.note(Rule::Finite, Element::Vertex(vertex as u32));
            }
        }
    };
    check(mesh.positions.as_flattened(), 3);
    check(mesh.normals.as_flattened(), 3);
    check(mesh.tangents.as_flattened(), 4);
    check(mesh.colors.as_flattened(), 4);
    for uv in &mesh.uvs {
        check(uv.values, uv.components as usize);
    }
}

/// Unit normals, where the source has such.
pub(super) fn check_normals(
    before: &Mesh,
    after: &Mesh,
    origins: &Origins,
    findings: &mut Findings,
) {
    let is_right = |mesh: &Mesh, vertex: usize| is_unit(vector(&mesh.normals[vertex]));
    check_vertices(before, after, origins, is_right, |vertex| {
        findings.note(Rule::Normals, Element::Vertex(vertex));
    });
}

/// Right tangents, where the source has such.
pub(super) fn check_tangents(
    before: &Mesh,
    after: &Mesh,
    origins: &Origins,
    findings: &mut Findings,
) {
    if before.tangents.is_empty() {
        return;
    }
    let is_right = |mesh: &Mesh, vertex: usize| {
        let [x, y, z, handedness] = mesh.tangents[vertex];
        let (tangent, normal) = (vector(&[x, y, z]), vector(&mesh.normals[vertex]));
        is_unit(tangent)
            && is_unit(normal)
            && tangent.dot(normal).abs() <= UNIT_TOLERANCE
            && handedness.abs() == 1.0
    };
    check_vertices(before, after, origins, is_right, |vertex| {
        findings.note(Rule::Tangents, Element::Vertex(vertex));
    });
}

/// Names each vertex that is not right although all that it was made from is.
fn check_vertices(
    before: &Mesh,
    after: &Mesh,
    origins: &Origins,
    is_right: impl Fn(&Mesh, usize) -> bool,
    mut note: impl FnMut(u32),
) {
    let right_before: Vec<bool> =
        (0..before.positions.len()).map(|vertex| is_right(before, vertex)).collect();
    for vertex in 0..after.positions.len() {
        if !is_right(after, vertex) && origins.all_hold(vertex, &right_before) {
            note(vertex as u32);
        }
    }
}

/// Colours within the least and greatest of the source, component by component.
pub(super) fn check_colors(before: &Mesh, after: &Mesh, findings: &mut Findings) {
    let mut range = [[f32::INFINITY, f32::NEG_INFINITY]; 4];
    for color in before.colors {
        for ([low, high], &value) in range.iter_mut().zip(color) {
            *low = low.min(value);
            *high = high.max(value);
        }
    }
    for (vertex, color) in after.colors.iter().enumerate() {
        let inside = range.iter().zip(color).all(|(&[low, high], &value)| {
            let slack = COLOR_TOLERANCE * low.abs().max(high.abs());
            value >= low - slack && value <= high + slack
        });
        if !inside {
            findings.note(Rule::Colors, Element::Vertex(vertex as u32));
        }
    }
}

/// A stored vector in double precision.
pub(super) fn vector(stored: &[f32; 3]) -> DVec3 {
    DVec3::from(stored.map(f64::from))
}

/// Whether a vector has length 1, as nearly as importers store it.
pub(super) fn is_unit(vector: DVec3) -> bool {
    (vector.length() - 1.0).abs() <= UNIT_TOLERANCE
}
