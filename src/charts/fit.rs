//! Fit: how badly a chamfer lies on the texture.

use glam::{DVec2, DVec3};

use super::feet::Room;
use super::ground::{Face, Ground, density, density_of, texture_area};
use crate::ids::Corner;
use crate::math::area_vector;
use crate::view::View;

/// A chamfer that lies this many times denser or thinner on the texture than the face that it
/// continues looks smeared or noisy: then another way to map it is tried.
pub const MOST_STRETCH: f64 = 3.9;

/// Less than that by far more than rounding.
const SURELY_NO_STRETCH: f64 = 3.8;

/// Past the end of its chart a chamfer shows what belongs elsewhere, which is worse than any
/// stretch that can still be looked at.
const BEYOND: f64 = 100.0;

/// A chamfer as it lies on the texture.
pub struct Lie<'a> {
    /// `#triangles`: places in the points.
    pub triangles: &'a [[u32; 3]],
    pub points: &'a [DVec3],
    /// `#points`.
    pub uvs: &'a [DVec2],
    /// Those of them of which it is not known that they lie on the ground.
    pub unsure: &'a [DVec2],
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
    let of_triangle = |triangle: &[u32; 3]| {
        let area = area_vector(triangle.map(|place| lie.points[place as usize])).length();
        let signed = texture_area(triangle.map(|place| lie.uvs[place as usize])) / density / area;
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
    view: &View,
    face: Corner,
    facing: Facing,
    channel: usize,
    ground: &Ground,
    lie: &Lie,
) -> f64 {
    let own = ground.own();
    let density = match face.triangle() == ground.triangle() {
        true => density_of(view, face.triangle(), &own),
        false => density(view, face.triangle(), channel),
    };
    let stretch = stretch(density, facing, view.resolution, lie);
    if stretch.is_finite() && !ground.covers(&own, (lie.triangles, lie.uvs), lie.unsure) {
        return stretch * BEYOND;
    }
    stretch
}

/// Whether a chamfer lies no worse than [`MOST_STRETCH`] on the texture of the face where the ground
/// begins: see [`misfit`], which takes longer, as it tells how badly.
pub fn fits(view: &View, facing: Facing, ground: &Ground, lie: &Lie) -> bool {
    let own = ground.own();
    let measure = Measure::new(view.triangle(ground.triangle()), &own);
    let is_alike = |triangle: &[u32; 3]| {
        let places = triangle.map(|place| place as usize);
        measure.is_surely_alike(places.map(|k| lie.points[k]), places.map(|k| lie.uvs[k]))
    };
    let density = || density_of(view, ground.triangle(), &own);
    (lie.triangles.iter().all(is_alike)
        || stretch(density(), facing, view.resolution, lie) <= MOST_STRETCH)
        && ground.covers(&own, (lie.triangles, lie.uvs), lie.unsure)
}

/// What triangles are measured by that continue a face.
pub struct Measure {
    /// The face's area, and that on the texture, each twice.
    area: f64,
    flat: f64,
    /// 1 or -1: whether it is mirrored there.
    turn: f64,
}

impl Measure {
    /// Of a face in space and on the texture.
    #[inline(always)]
    pub fn new(points: [DVec3; 3], face: &Face) -> Measure {
        let area = area_vector(points).length();
        Measure { area, flat: face.area.abs(), turn: 1.0_f64.copysign(face.area) }
    }

    /// Whether a triangle is the same way round on the texture as the face, and not much denser or thinner:
    /// then its [`stretch`] is no more than it may be, or is not told at all. As nothing is divided here,
    /// nothing need be told apart from zero.
    #[inline(always)]
    pub fn is_surely_alike(&self, points: [DVec3; 3], uvs: [DVec2; 3]) -> bool {
        let flat = texture_area(uvs) * self.turn * self.area;
        let expected = self.flat * area_vector(points).length();
        flat < expected * SURELY_NO_STRETCH && expected < flat * SURELY_NO_STRETCH
    }
}

/// Where the ground has the most room to lay a chamfer of a face flat, as dense as the face.
pub fn roomiest(view: &View, face: Corner, channel: usize, ground: &Ground) -> Room {
    let corner = Corner(3 * ground.roomiest().0);
    let densities = [face, corner].map(|at| density(view, at.triangle(), channel).abs());
    let scale = (densities[0] / densities[1]).sqrt();
    Room { corner, scale: if scale.is_finite() { scale } else { 1.0 } }
}

#[cfg(test)]
mod tests {
    use super::*;

    const UVS: [DVec2; 3] = [DVec2::ZERO, DVec2::X, DVec2::Y];

    #[test]
    fn thin_and_dense_are_alike_and_mirrored_is_worst() {
        let stretch = |facing: Facing, uvs: [DVec2; 3]| {
            let points = [DVec3::ZERO, DVec3::X, DVec3::Y];
            let lie = Lie { triangles: &[[0, 1, 2]], points: &points, uvs: &uvs, unsure: &uvs };
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
