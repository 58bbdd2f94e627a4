//! One tile: several samples per pixel, each lit by itself, then averaged.

use glam::{Vec2, Vec3};
use image::RgbImage;

use super::camera::{Camera, Projected};
use super::raster::{NOTHING, ScreenTriangle, Visibility, sample_center};
use super::scene::{Scene, Vertex};
use super::shade::{self, Lights, SurfacePoint};
use super::{Line, Surface, color, lines};

/// Samples per side of a pixel.
pub(super) const SAMPLES: usize = 4;

/// Width of a line, in pixels.
const LINE_WIDTH: f64 = 1.6;

/// The background at the top and at the bottom of a tile.
const BACKGROUND: [Vec3; 2] = [Vec3::new(0.075, 0.085, 0.105), Vec3::new(0.022, 0.025, 0.031)];

/// What a tile shows, and how.
pub(super) struct Tile<'a> {
    pub scene: &'a Scene,
    pub lines: &'a [Line],
    pub surface: Surface<'a>,
    /// `None` where there is nothing to see; otherwise for `SAMPLES` times as many samples.
    pub camera: Option<&'a Camera>,
    /// Pixels per side.
    pub pixels: usize,
}

impl Tile<'_> {
    pub fn render(&self) -> RgbImage {
        let size = self.pixels as u32;
        let Some(camera) = self.camera else {
            return RgbImage::from_fn(size, size, |_, y| color::encode(self.background(y)));
        };
        let drawing = Drawing::new(self, camera);
        let mut brush = Brush { drawing: &drawing, last: None };
        RgbImage::from_fn(size, size, |x, y| color::encode(brush.pixel(x, y, self.background(y))))
    }

    fn background(&self, row: u32) -> Vec3 {
        let [top, bottom] = BACKGROUND;
        top.lerp(bottom, (row as f32 + 0.5) / self.pixels as f32)
    }
}

/// A tile with what is seen at each sample.
struct Drawing<'a> {
    tile: &'a Tile<'a>,
    camera: &'a Camera,
    /// `#vertices`.
    projected: Vec<Projected>,
    /// Triangles are items by their own number, lines follow.
    seen: Visibility,
    lights: Lights,
}

impl<'a> Drawing<'a> {
    fn new(tile: &'a Tile, camera: &'a Camera) -> Self {
        let mut drawing = Drawing {
            tile,
            camera,
            projected: tile.scene.vertices.iter().map(|v| camera.project(v.position)).collect(),
            seen: Visibility::new(tile.pixels * SAMPLES),
            lights: Lights::three_point(),
        };
        for item in 0..tile.scene.triangles.len() {
            if let Some(triangle) = drawing.screen_triangle(item) {
                drawing.seen.draw(&triangle, item as u32);
            }
        }
        let first_line = tile.scene.triangles.len() as u32;
        let width = LINE_WIDTH * SAMPLES as f64;
        lines::draw(&mut drawing.seen, camera, tile.lines, width, first_line);
        drawing
    }

    fn screen_triangle(&self, triangle: usize) -> Option<ScreenTriangle> {
        let corners = self.tile.scene.triangles[triangle];
        ScreenTriangle::new(corners.map(|vertex| self.projected[vertex as usize]))
    }

    fn item(&self, item: u32) -> Option<Item<'_>> {
        let scene = self.tile.scene;
        let item = item as usize;
        if item >= scene.triangles.len() {
            let line = self.tile.lines.get(item - scene.triangles.len())?;
            return Some(Item::Line(color::decode(image::Rgb(line.color))));
        }
        let corners = scene.triangles[item].map(|vertex| &scene.vertices[vertex as usize]);
        let screen = self.screen_triangle(item)?;
        Some(Item::Facet(Facet { corners, screen, surface: self.tile.surface }))
    }
}

/// What a sample can see.
enum Item<'a> {
    Facet(Facet<'a>),
    Line(Vec3),
}

/// Lights samples. Neighbors mostly see the same item, so the last one is kept.
struct Brush<'a> {
    drawing: &'a Drawing<'a>,
    last: Option<(u32, Item<'a>)>,
}

impl Brush<'_> {
    /// The mean over the samples of a pixel.
    fn pixel(&mut self, x: u32, y: u32, background: Vec3) -> Vec3 {
        let (left, top) = (x as usize * SAMPLES, y as usize * SAMPLES);
        let mut sum = Vec3::ZERO;
        for row in top..top + SAMPLES {
            for column in left..left + SAMPLES {
                // What is too bright is cut off before averaging, or it would jag its outline.
                sum += self.sample(column, row).unwrap_or(background).min(Vec3::ONE);
            }
        }
        sum / (SAMPLES * SAMPLES) as f32
    }

    /// `None` where there is nothing.
    fn sample(&mut self, column: usize, row: usize) -> Option<Vec3> {
        let seen = &self.drawing.seen;
        let number = seen.items[row * seen.size + column];
        if number == NOTHING {
            return None;
        }
        if self.last.as_ref().is_none_or(|(last, _)| *last != number) {
            self.last = Some((number, self.drawing.item(number)?));
        }
        let (x, y) = sample_center(column, row);
        match &self.last.as_ref()?.1 {
            Item::Line(light) => Some(*light),
            Item::Facet(facet) => {
                let point = facet.at(x, y, self.drawing.camera);
                Some(self.drawing.lights.shade(&point))
            }
        }
    }
}

/// A triangle that is seen.
struct Facet<'a> {
    corners: [&'a Vertex; 3],
    screen: ScreenTriangle,
    surface: Surface<'a>,
}

impl Facet<'_> {
    fn at(&self, x: f64, y: f64, camera: &Camera) -> SurfacePoint {
        let weights = self.screen.weights(x, y);
        let smooth = blend(weights, self.corners.map(|c| c.normal)).normalize_or_zero();
        SurfacePoint {
            normal: if smooth == Vec3::ZERO { self.flat_normal() } else { smooth },
            toward_eye: camera.toward_eye(x, y),
            albedo: self.albedo(weights),
            is_back: self.screen.is_back,
        }
    }

    fn flat_normal(&self) -> Vec3 {
        let [a, b, c] = self.corners.map(|corner| corner.position);
        (b - a).cross(c - a).normalize_or_zero().as_vec3()
    }

    fn albedo(&self, weights: [f32; 3]) -> Vec3 {
        match (self.surface, self.uv(weights)) {
            (Surface::VertexColors, _) => {
                shade::CLAY * blend(weights, self.corners.map(|corner| corner.color))
            }
            (Surface::Checker, Some(uv)) => shade::checker(uv),
            (Surface::Texture(image), Some(uv)) => shade::texture(image, uv),
            _ => shade::CLAY,
        }
    }

    fn uv(&self, weights: [f32; 3]) -> Option<Vec2> {
        let [a, b, c] = self.corners.map(|corner| corner.uv);
        Some(a? * weights[0] + b? * weights[1] + c? * weights[2])
    }
}

fn blend([u, v, w]: [f32; 3], [a, b, c]: [Vec3; 3]) -> Vec3 {
    a * u + b * v + c * w
}
