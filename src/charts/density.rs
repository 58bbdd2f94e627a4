//! Density: how much texture a triangle shows for its area.

use glam::DVec2;

use crate::ids::{Id, Triangle};
use crate::math::area_vector;
use crate::mesh::Uv;
use crate::tolerance::EXPORTED_ROUNDING;
use crate::view::View;

/// Two components of a vertex in a UV channel: what lies on the texture.
pub fn uv_point(uv: &Uv, vertex: u32) -> DVec2 {
    let first = vertex as usize * uv.components as usize;
    let [v, u] = [first + 1, first].map(|place| f64::from(uv.values[place]));
    DVec2::new(u, v)
}

/// UV area over surface area of a source triangle, negative where it is mirrored; 0 where it has
/// none.
pub fn density(view: &View, triangle: Triangle, channel: usize) -> f64 {
    let uv = &view.mesh.uvs[channel];
    let area = area_vector(view.triangle(triangle)).length();
    let points = triangle.corners().map(|c| uv_point(uv, view.vertex_at(c).index() as u32));
    if area > 0.0 && !is_line(points) { texture_area(points) / area } else { 0.0 }
}

/// Whether rounding its UVs can make a triangle's area vanish: models that are coloured by single
/// texels have all of a face at one place.
fn is_line(points: [DVec2; 3]) -> bool {
    let (area, least) = (texture_area(points), size(points) * EXPORTED_ROUNDING);
    area * area <= longest_square(points) * (least * least)
}

/// Twice the area on the texture.
pub fn texture_area([a, b, c]: [DVec2; 3]) -> f64 {
    (b - a).perp_dot(c - a)
}

/// The square of the length of a triangle's longest side on the texture.
pub fn longest_square([a, b, c]: [DVec2; 3]) -> f64 {
    a.distance_squared(b).max(b.distance_squared(c)).max(c.distance_squared(a))
}

/// The largest coordinate of a triangle on the texture.
pub fn size([a, b, c]: [DVec2; 3]) -> f64 {
    a.abs().max(b.abs()).max(c.abs()).max_element()
}
