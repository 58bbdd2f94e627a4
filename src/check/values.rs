//! Streams vertex by vertex: lengths, finiteness, unit vectors, colour range.

use super::origins::Origins;
use super::rules::{Element, Findings, Rule};
use super::stored::{UNIT_TOLERANCE, is_unit, vector};
use crate::mesh::Mesh;

/// How far a colour may leave the source's range, relative to its size: rounding of a blend.
const COLOR_TOLERANCE: f32 = 1e-6;

/// Whether a mesh can be walked: lengths fit, indices are in range, every value is finite.
pub(super) fn is_well_formed(mesh: &Mesh) -> bool {
    let mut findings = Findings::default();
    check_form(mesh, &mut findings);
    check_finite(mesh, &mut findings);
    findings.is_sound()
}

/// One value per vertex in each stream that there is, counts that add up, indices in range.
pub(super) fn check_form(mesh: &Mesh, findings: &mut Findings) {
    let vertices = mesh.positions.len();
    let fits = |values: usize| values == 0 || values == vertices;
    let total: u64 = mesh.submesh_index_counts.iter().map(|&count| u64::from(count)).sum();
    let well_formed = mesh.normals.len() == vertices
        && fits(mesh.tangents.len())
        && fits(mesh.colors.len())
        && mesh.uvs.iter().all(|uv| uv.values.len() == vertices * uv.components as usize)
        && mesh.submesh_index_counts.iter().all(|count| count % 3 == 0)
        && total == mesh.indices.len() as u64;
    if !well_formed {
        findings.note(Rule::Streams, Element::Mesh);
    }
    for (place, &index) in mesh.indices.iter().enumerate() {
        if index as usize >= vertices {
            findings.note(Rule::IndexRange, Element::Index(place as u32));
        }
    }
}

/// The same streams and submeshes as before.
pub(super) fn check_same_streams(before: &Mesh, after: &Mesh, findings: &mut Findings) {
    let gains = |before: usize, after: usize| before == 0 && after > 0;
    let gains_any = gains(before.tangents.len(), after.tangents.len())
        || gains(before.colors.len(), after.colors.len())
        || before.uvs.iter().zip(&after.uvs).any(|(b, a)| gains(b.values.len(), a.values.len()));
    if gains_any || after.submesh_index_counts.len() < before.submesh_index_counts.len() {
        findings.note(Rule::Streams, Element::Mesh);
    }
    check_lost_streams(before, after, findings);
}

/// No stream is gone that was there before.
pub(super) fn check_lost_streams(before: &Mesh, after: &Mesh, findings: &mut Findings) {
    let is_lost = |before: usize, after: usize| before > 0 && after == 0;
    let loses = !after.positions.is_empty()
        && (is_lost(before.tangents.len(), after.tangents.len())
            || is_lost(before.colors.len(), after.colors.len()));
    let changes = before
        .uvs
        .iter()
        .zip(&after.uvs)
        .any(|(before, after)| before.components != 0 && before.components != after.components);
    if loses || changes {
        findings.note(Rule::Streams, Element::Mesh);
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
    check_vertices(before, after, origins, has_right_normal, |vertex| {
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
    if before.tangents.is_empty() || after.tangents.is_empty() {
        return;
    }
    check_vertices(before, after, origins, has_right_tangent, |vertex| {
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
    let was_right = origins.all_hold(before, after, &right_before);
    for (vertex, was_right) in was_right.into_iter().enumerate() {
        if was_right && !is_right(after, vertex) {
            note(vertex as u32);
        }
    }
}

/// How many vertices have a normal that is not right, and how many such a tangent.
pub(super) fn count_odd(mesh: &Mesh) -> [usize; 2] {
    let vertices = 0..mesh.positions.len();
    let odd_normals = vertices.clone().filter(|&vertex| !has_right_normal(mesh, vertex));
    let odd_tangents =
        vertices.filter(|&vertex| !mesh.tangents.is_empty() && !has_right_tangent(mesh, vertex));
    [odd_normals.count(), odd_tangents.count()]
}

pub(super) fn has_right_normal(mesh: &Mesh, vertex: usize) -> bool {
    is_unit(vector(&mesh.normals[vertex]))
}

pub(super) fn has_right_tangent(mesh: &Mesh, vertex: usize) -> bool {
    let [x, y, z, handedness] = mesh.tangents[vertex];
    let (tangent, normal) = (vector(&[x, y, z]), vector(&mesh.normals[vertex]));
    is_unit(tangent)
        && is_unit(normal)
        && tangent.dot(normal).abs() <= UNIT_TOLERANCE
        && handedness.abs() == 1.0
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
    if before.colors.is_empty() {
        return;
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
