//! Triangles that turned over or lost their area.

use glam::{DMat3, DVec3};

use super::origins::Origins;
use super::rules::{Element, Findings, Rule};
use super::stored::{normal_with_area, vector};
use super::surface::Surface;

/// What faces where, as the mesh stands: between the normals of a stretched mesh there may be more
/// than a right angle where it comes from, and less where it stands.
pub(super) struct Facing {
    /// How normals go along with the mesh; none where it stands as it is.
    to: Option<DMat3>,
}

impl Facing {
    /// For a mesh that is scaled so, column by column, or stands as it is.
    pub fn new(scale: Option<[[f32; 3]; 3]>) -> Facing {
        let axes = scale.map(|axes| axes.map(|axis| vector(&axis)));
        // The cofactors: right for normals, and for area vectors. A mirror turns neither.
        let to = axes.map(|[x, y, z]| {
            let sign = x.cross(y).dot(z).signum();
            DMat3::from_cols(y.cross(z), z.cross(x), x.cross(y)) * sign
        });
        Facing { to }
    }

    /// Where a triangle faces, as long as its area; none without area.
    fn area(&self, surface: &Surface, triangle: u32) -> Option<DVec3> {
        let area = normal_with_area(surface.triangle(triangle))?;
        Some(self.to.map_or(area, |to| to * area))
    }

    /// The sum of the vertex normals: as long as they come, or of length 1 where they are stretched.
    fn shading(&self, surface: &Surface, triangle: u32) -> DVec3 {
        let normal = |side| {
            let stored = surface.normal(3 * triangle + side);
            self.to.map_or(stored, |to| (to * stored).normalize_or_zero())
        };
        [0, 1, 2].map(normal).iter().sum()
    }

    /// Whether no triangle faces along with its vertex normals: then none of the result can.
    fn is_inside_out(&self, surface: &Surface) -> bool {
        let mut any = false;
        (0..surface.triangle_count()).all(|triangle| {
            let area = self.area(surface, triangle);
            let along = area.map_or(0.0, |area| area.dot(self.shading(surface, triangle)));
            any |= along < 0.0;
            along <= 0.0
        }) && any
    }

    /// Whether a triangle may face away from its vertex normals once its corners move.
    fn may_face_away(&self, surface: &Surface, triangle: u32) -> bool {
        let area = self.area(surface, triangle);
        area.is_none_or(|area| area.dot(self.shading(surface, triangle)) < 0.0)
    }
}

/// Source triangles against themselves, new ones against their vertex normals. Where some of the
/// source are not found, they may be among the new ones, and faced away before.
pub(super) fn check_triangles(
    [before, after]: [&Surface; 2],
    origins: &Origins,
    facing: &Facing,
    findings: &mut Findings,
) {
    let may_face_away = findings.lost > 0
        && (0..before.triangle_count()).any(|triangle| facing.may_face_away(before, triangle));
    let sign = if facing.is_inside_out(before) { -1.0 } else { 1.0 };
    for (triangle, &origin) in (0u32..).zip(&origins.triangles) {
        let now = facing.area(after, triangle);
        let reference = match origin {
            Some([corner, ..]) => facing.area(before, corner / 3),
            None => Some(facing.shading(after, triangle) * sign),
        };
        match (reference, now) {
            (Some(_), None) => findings.note(Rule::Degenerate, Element::Triangle(triangle)),
            (Some(reference), Some(now))
                if now.dot(reference) < 0.0 && (origin.is_some() || !may_face_away) =>
            {
                findings.note(Rule::Flipped, Element::Triangle(triangle));
            }
            (None, Some(now)) if opens_against(after, triangle, now * sign, facing) => {
                findings.note(Rule::Flipped, Element::Triangle(triangle));
            }
            _ => {}
        }
    }
}

/// Whether a triangle that had no area faces away from its vertex normals, by more than rounding.
fn opens_against(after: &Surface, triangle: u32, area: DVec3, facing: &Facing) -> bool {
    let [a, b, c] = after.triangle(triangle);
    let longest = [b - a, c - b, a - c].map(DVec3::length).into_iter().fold(0.0, f64::max);
    let shading = facing.shading(after, triangle).normalize_or_zero();
    area.dot(shading) < -longest * after.rounding()
}
