//! Where tiles, captions and separators go.

use image::{Rgb, RgbImage, imageops};

use super::Panel;
use super::camera::{Camera, TOWARD_EYE};
use super::caption::{self, TEXT_HEIGHT, TextBox};
use super::scene::Scene;
use super::tile::{SAMPLES, Tile};

/// Pixels per side of a tile of a picture of its own.
pub const LARGE_TILE: u32 = 600;
/// Pixels per side of a tile on a sheet.
pub const SMALL_TILE: u32 = 320;

/// A sheet with more panels than this has two columns.
const LONGEST_COLUMN: usize = 4;

/// Between tiles and between panels, in pixels.
const GAP: u32 = 2;

/// Height of a bar with a text, in pixels.
const BAR: u32 = TEXT_HEIGHT + 12;

const PAPER: Rgb<u8> = Rgb([24, 25, 28]);
const TITLE_INK: Rgb<u8> = Rgb([236, 236, 232]);
const CAPTION_INK: Rgb<u8> = Rgb([168, 172, 178]);

/// Draws one model before and after, side by side, each in a tile of so many pixels per side.
pub fn before_after(panel: &Panel, tile: u32) -> RgbImage {
    Drawn::new(panel, tile).image()
}

/// The tiles of a model before and after alone, without captions.
pub fn tiles(panel: &Panel, tile: u32) -> [RgbImage; 2] {
    let mut tiles = Drawn::new(panel, tile).tiles.into_iter();
    [(); 2].map(|()| tiles.next().unwrap_or_default())
}

/// Draws several models, each before and after, in tiles of so many pixels per side.
pub fn contact_sheet(panels: &[Panel], tile: u32) -> RgbImage {
    let rows: Vec<RgbImage> = panels.iter().map(|panel| before_after(panel, tile)).collect();
    sheet(&rows)
}

/// Puts pictures one below the other.
pub fn stacked(pictures: &[RgbImage]) -> RgbImage {
    let width = pictures.iter().map(RgbImage::width).max().unwrap_or(0);
    let height = pictures.iter().map(RgbImage::height).sum();
    let mut image = RgbImage::from_pixel(width, height, PAPER);
    let mut top = 0;
    for picture in pictures {
        imageops::replace(&mut image, picture, 0, top);
        top += i64::from(picture.height());
    }
    image
}

/// Puts pictures of models together: a row each, in two columns where there are many.
pub fn sheet(pictures: &[RgbImage]) -> RgbImage {
    let columns = if pictures.len() > LONGEST_COLUMN { 2 } else { 1 };
    let rows = pictures.len().div_ceil(columns).max(1);
    let largest = |side: fn(&RgbImage) -> u32| pictures.iter().map(side).max();
    let [width, height] = panel_size(SMALL_TILE);
    let width = largest(RgbImage::width).unwrap_or(width);
    let height = largest(RgbImage::height).unwrap_or(height);
    let spread = |count: usize, size: u32| count as u32 * (size + GAP) - GAP;
    let mut sheet = RgbImage::from_pixel(spread(columns, width), spread(rows, height), PAPER);
    for (number, picture) in pictures.iter().enumerate() {
        let x = (number % columns) as u32 * (width + GAP);
        let y = (number / columns) as u32 * (height + GAP);
        imageops::replace(&mut sheet, picture, x.into(), y.into());
    }
    sheet
}

fn panel_size(tile: u32) -> [u32; 2] {
    [2 * tile + GAP, tile + 2 * BAR]
}

/// A panel whose tiles are drawn.
struct Drawn<'a> {
    title: &'a str,
    tiles: Vec<RgbImage>,
    captions: Vec<String>,
}

impl<'a> Drawn<'a> {
    fn new(panel: &'a Panel, tile: u32) -> Self {
        let further = panel.further.iter().map(|(_, placed)| placed);
        let placed = [&panel.before, &panel.after].into_iter().chain(further);
        let scenes: Vec<Scene> = placed.map(|placed| Scene::gather(placed)).collect();
        let camera = camera(&scenes, panel, tile as usize * SAMPLES);
        let after = panel.after_name.as_deref().unwrap_or("after");
        let before = panel.before_name.as_deref().unwrap_or("before");
        let names = [before, after].into_iter();
        let names = names.chain(panel.further.iter().map(|(name, _)| &**name));
        let lines = [&panel.before_lines[..], &panel.after_lines];
        let render = |scene, lines| {
            let camera = camera.as_ref();
            let culls_backs = panel.toward_eye.is_some();
            let pixels = tile as usize;
            Tile { scene, lines, surface: panel.surface, camera, pixels, culls_backs }.render()
        };
        Drawn {
            title: &panel.caption,
            tiles: (0..)
                .zip(&scenes)
                .map(|(number, scene)| {
                    render(scene, lines.get(number).copied().unwrap_or_default())
                })
                .collect(),
            captions: names.zip(&scenes).map(|(name, scene)| count(name, scene)).collect(),
        }
    }

    /// The title above, the tiles, a caption below each.
    fn image(&self) -> RgbImage {
        let tile = self.tiles[0].width();
        let [_, height] = panel_size(tile);
        let width = self.tiles.len() as u32 * (tile + GAP) - GAP;
        let mut image = RgbImage::from_pixel(width, height, PAPER);
        let title = TextBox { left: 0, top: (BAR - TEXT_HEIGHT) / 2, width };
        caption::write(&mut image, self.title, &title, TITLE_INK);
        for (number, (drawn, text)) in (0..).zip(self.parts()) {
            let left = number * (tile + GAP);
            imageops::replace(&mut image, drawn, left.into(), BAR.into());
            let below = TextBox { left, top: BAR + tile + title.top, width: tile };
            caption::write(&mut image, text, &below, CAPTION_INK);
        }
        image
    }

    fn parts(&self) -> impl Iterator<Item = (&RgbImage, &String)> {
        self.tiles.iter().zip(&self.captions)
    }
}

fn count(when: &str, scene: &Scene) -> String {
    let triangles = grouped(scene.triangles.len());
    let noun = if scene.triangles.len() == 1 { "triangle" } else { "triangles" };
    format!("{when}: {triangles} {noun}")
}

/// A number with a comma before each three digits.
fn grouped(number: usize) -> String {
    let digits = number.to_string();
    let mut text = String::new();
    for (place, digit) in digits.char_indices() {
        if place > 0 && (digits.len() - place).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

/// One view of both scenes; `None` where neither has an extent.
fn camera(scenes: &[Scene], panel: &Panel, samples: usize) -> Option<Camera> {
    let toward_eye = panel.toward_eye.map(|direction| glam::Vec3::from(direction).as_dvec3());
    let camera = Camera::frame(
        toward_eye.unwrap_or(TOWARD_EYE),
        scenes.iter().flat_map(Scene::corners),
        samples,
    )?;
    let Some(zoom) = panel.zoom.filter(|zoom| zoom.factor > 0.0 && zoom.factor.is_finite()) else {
        return Some(camera);
    };
    let given = zoom.focus.map(|focus| glam::Vec3::from(focus).as_dvec3());
    let focus = given
        .filter(|&focus| camera.depth(focus) > 0.0 && focus.is_finite())
        .or_else(|| scenes.iter().find_map(|scene| nearest(&camera, scene)));
    Some(match focus {
        // Away from the middle of the model the direction would be another one.
        Some(focus) if toward_eye.is_some() => {
            camera.straight_before(focus).zoomed(zoom.factor.into(), focus)
        }
        Some(focus) => camera.zoomed(zoom.factor.into(), focus),
        None => camera,
    })
}

fn nearest(camera: &Camera, scene: &Scene) -> Option<glam::DVec3> {
    scene.corners().min_by(|&a, &b| camera.depth(a).total_cmp(&camera.depth(b)))
}

#[cfg(test)]
mod tests {
    use super::super::{Placed, Zoom};
    use super::*;

    const IDENTITY: [[f32; 4]; 4] =
        [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]];

    fn triangle() -> Vec<Placed<'static>> {
        let mesh = chamfer::Mesh {
            positions: &[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
            indices: &[0, 1, 2],
            ..chamfer::Mesh::default()
        };
        vec![Placed { mesh, transform: IDENTITY }]
    }

    fn panel() -> Panel<'static> {
        Panel { caption: "a triangle".into(), before: triangle(), ..Panel::default() }
    }

    #[test]
    fn the_same_panel_gives_the_same_bytes() {
        assert_eq!(before_after(&panel(), 40), before_after(&panel(), 40));
    }

    #[test]
    fn an_empty_panel_is_background() {
        assert_eq!(before_after(&Panel::default(), LARGE_TILE).dimensions(), (1202, 656));
        assert_eq!(contact_sheet(&[], SMALL_TILE).dimensions(), (642, 376));
    }

    #[test]
    fn a_long_sheet_has_two_columns() {
        let panels = |count| (0..count).map(|_| Panel::default()).collect::<Vec<_>>();
        assert_eq!(contact_sheet(&panels(2), SMALL_TILE).dimensions(), (642, 754));
        assert_eq!(contact_sheet(&panels(5), SMALL_TILE).dimensions(), (1286, 1132));
    }

    #[test]
    fn both_tiles_share_a_view() {
        let both = Panel { after: triangle(), ..panel() };
        let drawn = Drawn::new(&both, 40);
        assert_eq!(drawn.tiles[0], drawn.tiles[1]);
        assert_eq!(drawn.captions, ["before: 1 triangle", "after: 1 triangle"]);
    }

    #[test]
    fn a_zoom_fills_the_tile() {
        let corner = |zoom| *Drawn::new(&Panel { zoom, ..panel() }, 40).tiles[0].get_pixel(0, 39);
        let focus = Some([0.3, 0.3, 0.0]);
        let (whole, close) = (corner(None), corner(Some(Zoom { factor: 30.0, focus })));
        assert_ne!(whole, close);
        assert_eq!(whole, corner(Some(Zoom { factor: f32::NAN, focus })));
        assert_ne!(close, corner(Some(Zoom { factor: 30.0, focus: None })));
    }

    #[test]
    fn numbers_are_grouped_by_thousands() {
        assert_eq!([0, 999, 1000, 1234567].map(grouped), ["0", "999", "1,000", "1,234,567"]);
    }
}
