//! Light on a surface.
//!
//! The lights stand where the three edges between the visible sides of an upright box mirror
//! them to the eye: a chamfer there catches a highlight, a flat side does not.

use glam::{Vec2, Vec3};
use image::RgbImage;

use super::camera::TOWARD_EYE;
use super::color;

/// The neutral material.
pub(super) const CLAY: Vec3 = Vec3::new(0.50, 0.485, 0.465);

/// Backs are darker and violet, so that holes and flipped triangles stand out.
const BACK: Vec3 = Vec3::new(0.34, 0.22, 0.38);

/// Light from above and from below that has no direction.
const SKY: Vec3 = Vec3::new(0.27, 0.29, 0.32);
const GROUND: Vec3 = Vec3::new(0.11, 0.10, 0.09);

/// Extra reflection where a surface turns away from the eye.
const RIM: f32 = 0.10;

/// Checks per unit of UV.
const CHECKS: f32 = 16.0;

struct Light {
    toward: Vec3,
    /// Light on clay that faces it.
    diffuse: Vec3,
    /// Light that a highlight adds.
    specular: f32,
}

/// The lights of a picture, all at infinity.
pub(super) struct Lights([Light; 3]);

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
    /// Key light from the upper left, fill light from the lower right, rim light from behind.
    pub fn three_point() -> Self {
        Lights([
            Light {
                toward: mirrored_by(Vec3::new(0.0, 1.0, 1.0)),
                diffuse: Vec3::new(0.78, 0.75, 0.70),
                specular: 0.50,
            },
            Light {
                toward: mirrored_by(Vec3::new(1.0, 0.0, 1.0)),
                diffuse: Vec3::new(0.20, 0.22, 0.25),
                specular: 0.36,
            },
            Light {
                toward: mirrored_by(Vec3::new(1.0, 1.0, 0.0)),
                diffuse: Vec3::new(0.20, 0.21, 0.22),
                specular: 0.42,
            },
        ])
    }

    /// The light that a point sends to the eye.
    pub fn shade(&self, point: &SurfacePoint) -> Vec3 {
        let normal = if point.is_back { -point.normal } else { point.normal };
        let mut diffuse = GROUND.lerp(SKY, normal.y * 0.5 + 0.5);
        let mut specular = 0.0;
        for light in &self.0 {
            diffuse += light.diffuse * normal.dot(light.toward).max(0.0);
            let half = (light.toward + point.toward_eye).normalize_or_zero();
            specular += light.specular * highlight(normal.dot(half));
        }
        if point.is_back {
            return diffuse * BACK * point.albedo;
        }
        let turned_away = 1.0 - normal.dot(point.toward_eye).clamp(0.0, 1.0);
        let rim = RIM * turned_away * turned_away * turned_away;
        diffuse * point.albedo + Vec3::splat(specular + rim)
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
