//! Triangles that turned over or lost their area.

use glam::DVec3;

use super::origins::Origins;
use super::rules::{Element, Findings, Rule};
use super::surface::Surface;

/// A triangle has no area if twice its area is at most this share of its longest side squared:
/// far above the rounding of a cross product in double precision (1e-16), far below the height
/// that single-precision corners give to anything but a line (1e-7).
const NO_AREA: f64 = 1e-10;

/// Source triangles against themselves, new ones against their vertex normals.
pub(super) fn check_triangles(
    before: &Surface,
    after: &Surface,
    origins: &Origins,
    findings: &mut Findings,
) {
    for (triangle, &origin) in (0u32..).zip(&origins.triangles) {
        let now = normal_with_area(after.triangle(triangle));
        let reference = match origin {
            Some([corner, ..]) => normal_with_area(before.triangle(corner / 3)),
            None => Some([0, 1, 2].map(|side| after.normal(3 * triangle + side)).iter().sum()),
        };
        match (reference, now) {
            (Some(_), None) => findings.note(Rule::Degenerate, Element::Triangle(triangle)),
            (Some(reference), Some(now)) if now.dot(reference) < 0.0 => {
                findings.note(Rule::Flipped, Element::Triangle(triangle));
            }
            _ => {}
        }
    }
}

/// The normal of a triangle, twice its area long; none where that is nothing.
pub(super) fn normal_with_area([a, b, c]: [DVec3; 3]) -> Option<DVec3> {
    let normal = (b - a).cross(c - a);
    let longest =
        [b - a, c - b, a - c].iter().map(|side| side.length_squared()).fold(0.0, f64::max);
    (normal.length() > NO_AREA * longest).then_some(normal)
}
