//! Light on a surface: matte clay, with small glints.
//!
//! The lamps behind the glints stand where the edges between the three visible sides of an
//! upright box mirror them to the eye: a chamfer there catches one, a flat side does not.

use glam::{Vec2, Vec3};
use image::RgbImage;

use super::camera::TOWARD_EYE;
use super::color;

/// The neutral material.
pub(super) const CLAY: Vec3 = Vec3::new(0.40, 0.388, 0.372);

/// Backs are darker and violet, so that holes and flipped triangles stand out.
const BACK: Vec3 = Vec3::new(0.34, 0.22, 0.38);

/// Light from above and from below that has no direction.
const SKY: Vec3 = Vec3::new(0.27, 0.29, 0.32);
const GROUND: Vec3 = Vec3::new(0.11, 0.10, 0.09);

/// Extra reflection where a surface turns away from the eye.
const RIM: f32 = 0.10;

/// Checks per unit of UV.
const CHECKS: f32 = 16.0;

/// A lamp at infinity that clay scatters.
struct Lamp {
    toward: Vec3,
    /// Light on a surface that faces the lamp.
    light: Vec3,
}

/// A lamp at infinity that is only seen as a glint.
struct Glint {
    toward: Vec3,
    strength: f32,
}

/// The lights of a picture.
pub(super) struct Lights {
    lamps: [Lamp; 2],
    glints: [Glint; 3],
}

/// What is seen at a sample.
pub(super) struct SurfacePoint {
    /// Unit length.
    pub normal: Vec3,
    /// Unit length.
    pub toward_eye: Vec3,
    /// The color of the material.
    pub albedo: Vec3,
    /// Whether the back of a triangle is seen.
    pub is_back: bool,
}

impl Lights {
    /// Key light from the upper left, fill light from the right, a glint for each edge direction
    /// of a box.
    pub fn studio() -> Self {
        // Each glint is off the middle of its edge, or it would bleach the many flat faces at 45
        // degrees that models have.
        Lights {
            lamps: [
                Lamp {
                    toward: Vec3::new(-0.35, 0.78, 0.52).normalize(),
                    light: Vec3::new(1.0, 0.965, 0.92),
                },
                Lamp {
                    toward: Vec3::new(0.9, 0.1, 0.3).normalize(),
                    light: Vec3::new(0.15, 0.165, 0.185),
                },
            ],
            glints: [
                Glint { toward: mirrored_by(Vec3::new(0.0, 0.5, 0.87)), strength: 0.54 },
                Glint { toward: mirrored_by(Vec3::new(0.87, 0.0, 0.5)), strength: 0.46 },
                Glint { toward: mirrored_by(Vec3::new(0.87, 0.5, 0.0)), strength: 0.46 },
            ],
        }
    }

    /// The light that a point sends to the eye.
    pub fn shade(&self, point: &SurfacePoint) -> Vec3 {
        if point.is_back {
            return self.scattered(-point.normal) * BACK * point.albedo;
        }
        let turned_away = 1.0 - point.normal.dot(point.toward_eye).clamp(0.0, 1.0);
        let rim = RIM * turned_away * turned_away * turned_away;
        self.scattered(point.normal) * point.albedo + Vec3::splat(self.mirrored(point) + rim)
    }

    fn scattered(&self, normal: Vec3) -> Vec3 {
        let ambient = GROUND.lerp(SKY, normal.y * 0.5 + 0.5);
        self.lamps
            .iter()
            .fold(ambient, |sum, lamp| sum + lamp.light * normal.dot(lamp.toward).max(0.0))
    }

    fn mirrored(&self, point: &SurfacePoint) -> f32 {
        let glint = |glint: &Glint| {
            let half = (glint.toward + point.toward_eye).normalize_or_zero();
            glint.strength * highlight(point.normal.dot(half))
        };
        self.glints.iter().map(glint).sum()
    }
}

/// The direction that an edge with this normal mirrors to the eye.
fn mirrored_by(edge_normal: Vec3) -> Vec3 {
    let (normal, eye) = (edge_normal.normalize(), TOWARD_EYE.normalize().as_vec3());
    2.0 * normal.dot(eye) * normal - eye
}

/// The 32nd power, by squaring: the platform's `pow` may differ in the last bit.
fn highlight(cosine: f32) -> f32 {
    (0..5).fold(cosine.max(0.0), |power, _| power * power)
}

/// A checker of two tones of clay that change their hue along u and v.
pub(super) fn checker(uv: Vec2) -> Vec3 {
    let cell = (uv * CHECKS).floor();
    let place = uv - uv.floor();
    let tint = Vec3::new(0.25 + 0.45 * place.x, 0.38, 0.25 + 0.45 * place.y);
    let is_dark = (cell.x + cell.y).rem_euclid(2.0) != 0.0;
    if is_dark { tint * 0.35 } else { tint.lerp(Vec3::ONE, 0.35) }
}

/// An image at a UV, repeated, between its four nearest texels.
pub(super) fn texture(image: &RgbImage, uv: Vec2) -> Vec3 {
    let (width, height) = image.dimensions();
    if width == 0 || height == 0 {
        return CLAY;
    }
    let place = (uv - uv.floor()) * Vec2::new(width as f32, height as f32) - 0.5;
    let low = place.floor();
    let share = place - low;
    let texel = |dx: i64, dy: i64| {
        let x = (low.x as i64 + dx).rem_euclid(i64::from(width)) as u32;
        let y = (low.y as i64 + dy).rem_euclid(i64::from(height)) as u32;
        color::decode(*image.get_pixel(x, y))
    };
    let top = texel(0, 0).lerp(texel(1, 0), share.x);
    let bottom = texel(0, 1).lerp(texel(1, 1), share.x);
    top.lerp(bottom, share.y)
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::Rgb;

    fn brightness(normal: Vec3, is_back: bool) -> f32 {
        let point = SurfacePoint {
            normal: normal.normalize(),
            toward_eye: TOWARD_EYE.normalize().as_vec3(),
            albedo: CLAY,
            is_back,
        };
        Lights::studio().shade(&point).element_sum()
    }

    #[test]
    fn a_chamfer_has_a_normal_that_is_brighter_than_both_of_its_sides() {
        for (a, b) in [(Vec3::X, Vec3::Y), (Vec3::Y, Vec3::Z), (Vec3::Z, Vec3::X)] {
            let across = (1..10).map(|step| brightness(a.lerp(b, step as f32 / 10.0), false));
            let sides = brightness(a, false).max(brightness(b, false));
            assert!(across.fold(0.0, f32::max) > sides * 1.4, "{a} {b}");
        }
    }

    #[test]
    fn the_visible_sides_of_a_box_differ() {
        let [top, front, side] = [Vec3::Y, Vec3::Z, Vec3::X].map(|n| brightness(n, false));
        assert!(top > front * 1.2 && front > side * 1.2);
    }

    #[test]
    fn a_back_is_darker_than_any_front() {
        for normal in [Vec3::X, Vec3::Y, Vec3::Z] {
            assert!(brightness(-normal, true) < brightness(Vec3::X, false) * 0.9);
        }
    }

    #[test]
    fn a_texture_is_mixed_between_texels_and_repeated() {
        let image = RgbImage::from_fn(2, 1, |x, _| Rgb([255 * x as u8; 3]));
        assert_eq!(texture(&image, Vec2::new(0.25, 0.5)), Vec3::ZERO);
        assert_eq!(texture(&image, Vec2::new(-1.25, 7.5)), Vec3::ONE);
        assert_eq!(texture(&image, Vec2::new(0.5, 0.5)), Vec3::splat(0.5));
        assert_eq!(texture(&RgbImage::new(0, 0), Vec2::ZERO), CLAY);
    }

    #[test]
    fn neighboring_checks_differ() {
        let check = |x: f32, y: f32| checker(Vec2::new(x, y) / CHECKS).element_sum();
        assert!(check(0.5, 0.5) > 2.0 * check(1.5, 0.5));
        assert!(check(1.5, 1.5) > 2.0 * check(-0.5, 0.5));
    }
}
