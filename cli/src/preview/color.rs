//! Colors as light: linear red, green and blue from 0 to 1.

use glam::Vec3;
use image::Rgb;

/// The light that a pixel stands for. The square is close to the sRGB curve, and unlike it the
/// same on every platform.
pub(super) fn decode(Rgb(pixel): Rgb<u8>) -> Vec3 {
    let stored = Vec3::from(pixel.map(|value| f32::from(value) / 255.0));
    stored * stored
}

/// The pixel that stands for an amount of light; what is too bright is cut off.
pub(super) fn encode(light: Vec3) -> Rgb<u8> {
    let clamped = light.clamp(Vec3::ZERO, Vec3::ONE);
    Rgb(clamped.to_array().map(|value| (value.sqrt() * 255.0 + 0.5) as u8))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_value_comes_back() {
        for value in 0..=255 {
            let pixel = Rgb([value, 255 - value, 128]);
            assert_eq!(encode(decode(pixel)), pixel);
        }
    }
}
