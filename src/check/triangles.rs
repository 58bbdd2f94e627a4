//! Triangles that turned over or lost their area.

use glam::DVec3;

use super::origins::Origins;
use super::rules::{Element, Findings, Rule};
use super::surface::Surface;

/// Source triangles against themselves, new ones against their vertex normals. Where some of the
/// source are not found, they may be among the new ones, and faced away before.
pub(super) fn check_triangles(
    [before, after]: [&Surface; 2],
    origins: &Origins,
    findings: &mut Findings,
) {
    let may_face_away = findings.lost > 0
        && (0..before.triangle_count()).any(|triangle| may_face_away(before, triangle));
    let sign = if is_inside_out(before) { -1.0 } else { 1.0 };
    for (triangle, &origin) in (0u32..).zip(&origins.triangles) {
        let now = after.facing(triangle);
        let reference = match origin {
            Some([corner, ..]) => before.facing(corner / 3),
            None => Some(shading(after, triangle) * sign),
        };
        match (reference, now) {
            (Some(_), None) => findings.note(Rule::Degenerate, Element::Triangle(triangle)),
            (Some(reference), Some(now))
                if now.dot(reference) < 0.0 && (origin.is_some() || !may_face_away) =>
            {
                findings.note(Rule::Flipped, Element::Triangle(triangle));
            }
            (None, Some(now)) if opens_against(after, triangle, now * sign) => {
                findings.note(Rule::Flipped, Element::Triangle(triangle));
            }
            _ => {}
        }
    }
}

/// Whether a triangle that had no area faces away from its vertex normals, by more than rounding.
fn opens_against(after: &Surface, triangle: u32, area: DVec3) -> bool {
    let [a, b, c] = after.triangle(triangle);
    let longest = [b - a, c - b, a - c].map(DVec3::length).into_iter().fold(0.0, f64::max);
    let shading = shading(after, triangle).normalize_or_zero();
    area.dot(shading) < -longest * after.rounding()
}

/// Whether no triangle faces along with its vertex normals: then none of the result can.
fn is_inside_out(surface: &Surface) -> bool {
    let mut any = false;
    (0..surface.triangle_count()).all(|triangle| {
        let area = surface.facing(triangle);
        let along = area.map_or(0.0, |area| area.dot(shading(surface, triangle)));
        any |= along < 0.0;
        along <= 0.0
    }) && any
}

/// Whether a triangle may face away from its vertex normals once its corners move.
fn may_face_away(surface: &Surface, triangle: u32) -> bool {
    surface.facing(triangle).is_none_or(|area| area.dot(shading(surface, triangle)) < 0.0)
}

/// The sum of the vertex normals.
fn shading(surface: &Surface, triangle: u32) -> DVec3 {
    [0, 1, 2].map(|side| surface.shading(3 * triangle + side)).iter().sum()
}
