//! One-line texts in a fixed-width font.

use image::{Rgb, RgbImage};
use noto_sans_mono_bitmap::{FontWeight, RasterHeight, RasterizedChar, get_raster};

/// Height of a line of text, in pixels.
pub(super) const TEXT_HEIGHT: u32 = RasterHeight::Size16.val() as u32;

const WEIGHT: FontWeight = FontWeight::Regular;

/// Where a text may go.
pub(super) struct TextBox {
    pub left: u32,
    pub top: u32,
    pub width: u32,
}

/// Writes a text centered in its box; what is too long ends in dots, and characters that the font
/// lacks become question marks.
pub(super) fn write(image: &mut RgbImage, text: &str, place: &TextBox, ink: Rgb<u8>) {
    let advance = noto_sans_mono_bitmap::get_raster_width(WEIGHT, RasterHeight::Size16) as u32;
    let text = shortened(text, (place.width / advance) as usize);
    let mut left = place.left + (place.width - text.len() as u32 * advance) / 2;
    for character in text {
        if let Some(glyph) = glyph(character).or_else(|| glyph('?')) {
            stamp(image, &glyph, [left, place.top], ink);
        }
        left += advance;
    }
}

fn shortened(text: &str, room: usize) -> Vec<char> {
    let all: Vec<char> = text.chars().collect();
    if all.len() <= room {
        return all;
    }
    let dots = room.min(2);
    all[..room - dots].iter().copied().chain(std::iter::repeat_n('.', dots)).collect()
}

fn glyph(character: char) -> Option<RasterizedChar> {
    get_raster(character, WEIGHT, RasterHeight::Size16)
}

/// Mixes ink into the image by the glyph's coverage.
fn stamp(image: &mut RgbImage, glyph: &RasterizedChar, [left, top]: [u32; 2], ink: Rgb<u8>) {
    for (y, row) in (top..).zip(glyph.rows()) {
        for (x, &coverage) in (left..).zip(row) {
            if let Some(pixel) = image.get_pixel_mut_checked(x, y) {
                for (value, ink) in pixel.0.iter_mut().zip(ink.0) {
                    *value = mixed(*value, ink, coverage);
                }
            }
        }
    }
}

fn mixed(paper: u8, ink: u8, coverage: u8) -> u8 {
    let [paper, ink, coverage] = [paper, ink, coverage].map(u32::from);
    ((paper * (255 - coverage) + ink * coverage + 127) / 255) as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    fn text(text: &str, room: usize) -> String {
        shortened(text, room).into_iter().collect()
    }

    #[test]
    fn what_is_too_long_ends_in_dots() {
        assert_eq!(text("bolt", 4), "bolt");
        assert_eq!(text("cylinder", 5), "cyl..");
        assert_eq!(text("cylinder", 1), ".");
        assert_eq!(text("cylinder", 0), "");
    }

    #[test]
    fn ink_stays_in_the_box() {
        let mut image = RgbImage::new(40, TEXT_HEIGHT);
        write(&mut image, "W\u{4e2d}W", &TextBox { left: 8, top: 0, width: 24 }, Rgb([255; 3]));
        let inked = |x: u32| (0..TEXT_HEIGHT).any(|y| image.get_pixel(x, y).0 != [0; 3]);
        assert!((8..32).any(inked));
        assert!(!(0..8).chain(32..40).any(inked));
    }
}
