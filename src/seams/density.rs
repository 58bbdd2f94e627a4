//! Density: how much texture a triangle shows for its area.

use glam::{DVec2, DVec3};

use super::ground::Ground;
use crate::ids::{Corner, Id, Triangle};
use crate::math::area_vector;
use crate::mesh::Uv;
use crate::plan::Plan;

/// A chamfer that lies this many times denser or thinner on the texture than the face that it
/// continues looks smeared or noisy: then another way to map it is tried.
pub const MOST_STRETCH: f64 = 3.9;

/// Past the end of its chart a chamfer shows what belongs elsewhere, which is worse than any
/// stretch that can still be looked at.
const BEYOND: f64 = 100.0;

/// Single precision, and a little for the arithmetic of exporters.
const ROUNDING: f64 = 1e-6;

/// Two components of a vertex in a UV channel: what lies on the texture.
pub fn uv_point(uv: &Uv, vertex: u32) -> DVec2 {
    let first = vertex as usize * uv.components as usize;
    let [v, u] = [first + 1, first].map(|place| f64::from(uv.values[place]));
    DVec2::new(u, v)
}

/// UV area over surface area of a source triangle, negative where it is mirrored; 0 where it has
/// none.
pub fn density(plan: &Plan, triangle: Triangle, channel: usize) -> f64 {
    let uv = &plan.view.mesh.uvs[channel];
    let area = area_vector(plan.view.triangle(triangle)).length();
    let points = triangle.corners().map(|c| uv_point(uv, plan.view.vertex_at(c).index() as u32));
    if area > 0.0 && !is_line(points) { texture_area(points) / area } else { 0.0 }
}

/// Whether rounding its UVs can make a triangle's area vanish: models that are coloured by single
/// texels have all of a face at one place.
fn is_line(points: [DVec2; 3]) -> bool {
    let (area, least) = (texture_area(points), size(points) * ROUNDING);
    area * area <= longest_square(points) * (least * least)
}

/// Twice the area on the texture.
fn texture_area([a, b, c]: [DVec2; 3]) -> f64 {
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

/// A chamfer as it lies on the texture.
pub struct Lie<'a> {
    /// `#triangles`: places in the points.
    pub triangles: &'a [[usize; 3]],
    pub points: &'a [DVec3],
    /// `#points`.
    pub uvs: &'a [DVec2],
}

impl Lie<'_> {
    /// The triangles on the texture.
    fn texture(&self) -> impl Iterator<Item = [DVec2; 3]> + '_ {
        self.triangles.iter().map(|triangle| triangle.map(|place| self.uvs[place]))
    }
}

/// How a chamfer may lie on the texture.
#[derive(Clone, Copy, PartialEq)]
pub enum Facing {
    /// As the face that it continues does.
    AsFace,
    /// Mirrored too: between faces of which one is, the texture turns over somewhere.
    Either,
}

/// The factor by which the worst of some triangles lies denser or thinner on the texture than a
/// face of the given density: 1 at best, infinite where one is mirrored or has no UV area.
fn stretch(density: f64, facing: Facing, resolution: f64, lie: &Lie) -> f64 {
    if density == 0.0 {
        return 1.0;
    }
    let of_triangle = |triangle: &[usize; 3]| {
        let area = area_vector(triangle.map(|place| lie.points[place])).length();
        let signed = texture_area(triangle.map(|place| lie.uvs[place])) / density / area;
        let ratio = if facing == Facing::Either { signed.abs() } else { signed };
        let is_tiny = area <= resolution * resolution;
        match () {
            () if is_tiny => 1.0,
            () if ratio > 0.0 => ratio.max(1.0 / ratio),
            () => f64::INFINITY,
        }
    };
    lie.triangles.iter().map(of_triangle).fold(1.0, f64::max)
}

/// How badly a chamfer lies on the texture of a face: as [`stretch`], and many times as much where
/// it leaves the ground.
pub fn misfit(
    plan: &Plan,
    face: Corner,
    facing: Facing,
    channel: usize,
    ground: &Ground,
    lie: &Lie,
) -> f64 {
    let density = density(plan, face.triangle(), channel);
    let stretch = stretch(density, facing, plan.view.resolution, lie);
    if stretch.is_finite() && !lie.texture().all(|uvs| ground.covers(uvs)) {
        return stretch * BEYOND;
    }
    stretch
}

#[cfg(test)]
mod tests {
    use super::*;

    const UVS: [DVec2; 3] = [DVec2::ZERO, DVec2::X, DVec2::Y];

    #[test]
    fn thin_and_dense_are_alike_and_mirrored_is_worst() {
        let stretch = |facing: Facing, uvs: [DVec2; 3]| {
            let points = [DVec3::ZERO, DVec3::X, DVec3::Y];
            let lie = Lie { triangles: &[[0, 1, 2]], points: &points, uvs: &uvs };
            stretch(1.0, facing, 1e-6, &lie)
        };
        let of = |uvs| stretch(Facing::AsFace, uvs);
        assert_eq!(of(UVS), 1.0);
        assert_eq!(of(UVS.map(|uv| uv * 2.0)), 4.0);
        assert_eq!(of(UVS.map(|uv| uv * 0.5)), 4.0);
        assert_eq!(of([UVS[0], UVS[2], UVS[1]]), f64::INFINITY);
        assert_eq!(of([UVS[0]; 3]), f64::INFINITY);
        let either = |uvs| stretch(Facing::Either, uvs);
        assert_eq!(either([UVS[0], UVS[2], UVS[1]]), 1.0);
    }
}
