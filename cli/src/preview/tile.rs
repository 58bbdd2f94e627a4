//! One tile: several samples per pixel, each lit by itself, then averaged.

use glam::{Vec2, Vec3};
use image::RgbImage;

use super::camera::{Camera, Projected};
use super::raster::{NOTHING, ScreenTriangle, Visibility, sample_center};
use super::scene::{Scene, Vertex};
use super::shade::{self, Lights, SurfacePoint};
use super::{Line, Surface, Wardrobe, color, lines};

/// Samples per side of a pixel.
pub(super) const SAMPLES: usize = 4;

/// Width of a line, in pixels.
const LINE_WIDTH: f64 = 1.2;

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
    /// Whether triangles seen from behind are left out.
    pub culls_backs: bool,
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
            lights: Lights::studio(),
        };
        for item in 0..tile.scene.triangles.len() {
            let shown = |triangle: &ScreenTriangle| !(tile.culls_backs && triangle.is_back);
            if let Some(triangle) = drawing.screen_triangle(item).filter(shown) {
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
        let surface = self.tile.surface;
        Some(Item::Facet(Facet { corners, screen, surface, origin: scene.origins[item] }))
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
    /// The place of its mesh, and its submesh.
    origin: [u32; 2],
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
            (Surface::Own(wardrobe), uv) => {
                self.coat(wardrobe, uv) * blend(weights, self.corners.map(|corner| corner.color))
            }
            (Surface::Checker, Some(uv)) => shade::checker(uv),
            (Surface::Texture(image), Some(uv)) => shade::texture(image, uv),
            _ => shade::CLAY,
        }
    }

    fn coat(&self, wardrobe: &Wardrobe, uv: Option<Vec2>) -> Vec3 {
        let [item, submesh] = self.origin.map(|number| number as usize);
        let coats = wardrobe.get(item).map_or(&[][..], Vec::as_slice);
        let Some(coat) = coats.get(submesh).or(coats.last()) else { return shade::CLAY };
        let color = Vec3::from(coat.color);
        match (coat.image, uv) {
            (Some(image), Some(uv)) if coat.flips => {
                color * shade::texture(image, Vec2::new(uv.x, 1.0 - uv.y))
            }
            (Some(image), Some(uv)) => color * shade::texture(image, uv),
            _ => color * shade::CLAY,
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

#[cfg(test)]
mod tests {
    use super::super::camera::TOWARD_EYE;
    use super::super::{Coat, Placed};
    use super::*;
    use chamfer::MeshBuffers;
    use image::Rgb;

    /// A square that faces the eye, `forward` nearer to it than the origin.
    fn square(size: f32, forward: f32) -> MeshBuffers {
        let back = TOWARD_EYE.normalize().as_vec3();
        let right = Vec3::Y.cross(back).normalize() * size;
        let up = back.cross(right);
        let corners = [-right - up, right - up, right + up, up - right];
        MeshBuffers {
            positions: corners.map(|corner| (corner + back * forward).to_array()).to_vec(),
            normals: vec![back.to_array(); 4],
            indices: vec![0, 1, 2, 0, 2, 3],
            ..MeshBuffers::default()
        }
    }

    fn render(meshes: &[&MeshBuffers], lines: &[Line], surface: Surface) -> RgbImage {
        let transform = glam::Mat4::IDENTITY.to_cols_array_2d();
        let placed = meshes.iter().map(|mesh| Placed { mesh: mesh.as_mesh(), transform });
        let scene = Scene::gather(&placed.collect::<Vec<_>>());
        let camera = Camera::frame(TOWARD_EYE, scene.corners(), 20 * SAMPLES);
        Tile {
            scene: &scene,
            lines,
            surface,
            camera: camera.as_ref(),
            pixels: 20,
            culls_backs: false,
        }
        .render()
    }

    fn middle(image: &RgbImage) -> Rgb<u8> {
        *image.get_pixel(10, 10)
    }

    #[test]
    fn a_square_that_faces_the_eye_covers_the_middle_and_not_the_margin() {
        let (empty, drawn) =
            (render(&[], &[], Surface::Clay), render(&[&square(1.0, 0.0)], &[], Surface::Clay));
        for (x, y, pixel) in drawn.enumerate_pixels() {
            let inside = (2..18).contains(&x) && (2..18).contains(&y);
            let margin = x == 0 || x == 19 || y == 0 || y == 19;
            assert!(!inside || pixel != empty.get_pixel(x, y));
            assert!(!margin || pixel == empty.get_pixel(x, y));
        }
    }

    #[test]
    fn the_nearer_square_hides_the_other() {
        let (near, far) = (square(0.5, 0.5), square(1.0, 0.0));
        let mut colored = near.clone();
        colored.colors = vec![[1.0, 0.0, 0.0, 1.0]; 4];
        for order in [[&colored, &far], [&far, &colored]] {
            let Rgb([red, green, _]) = middle(&render(&order, &[], Surface::VertexColors));
            assert!(red > 2 * green);
        }
    }

    #[test]
    fn a_flipped_triangle_is_darker() {
        let mut flipped = square(1.0, 0.0);
        flipped.indices = vec![0, 2, 1, 0, 3, 2];
        let front = middle(&render(&[&square(1.0, 0.0)], &[], Surface::Clay));
        let back = middle(&render(&[&flipped], &[], Surface::Clay));
        assert!(u32::from(back.0[1]) * 2 < u32::from(front.0[1]));
    }

    #[test]
    fn without_normals_a_face_is_flat() {
        let mut bare = square(1.0, 0.0);
        bare.normals.clear();
        let [smooth, flat] =
            [&square(1.0, 0.0), &bare].map(|mesh| middle(&render(&[mesh], &[], Surface::Clay)));
        assert!(smooth.0.iter().zip(flat.0).all(|(a, b)| a.abs_diff(b) <= 1));
    }

    #[test]
    fn a_line_crosses_the_square_in_its_color() {
        let color = [255, 0, 255];
        let mesh = square(1.0, 0.0);
        let line = Line { ends: [mesh.positions[0], mesh.positions[2]], color };
        let drawn = render(&[&mesh], &[line], Surface::Clay);
        assert!(drawn.pixels().any(|&pixel| pixel == Rgb(color)));
    }

    #[test]
    fn surfaces_that_need_uvs_are_clay_without_them() {
        let mesh = square(1.0, 0.0);
        let clay = render(&[&mesh], &[], Surface::Clay);
        let image = RgbImage::new(1, 1);
        assert_eq!(render(&[&mesh], &[], Surface::Checker), clay);
        assert_eq!(render(&[&mesh], &[], Surface::Texture(&image)), clay);
    }

    #[test]
    fn each_submesh_wears_its_own_coat() {
        let mut mesh = square(1.0, 0.0);
        mesh.uvs[0] = chamfer::UvBuffer { components: 2, values: vec![0.5; 8] };
        mesh.submesh_index_counts = vec![3, 3];
        let green = RgbImage::from_pixel(1, 1, Rgb([0, 255, 0]));
        let coat = |color, image| Coat { color, image, flips: false };
        let coats = vec![vec![coat([1.0, 0.0, 0.0], None), coat([1.0; 3], Some(&green))]];
        let drawn = render(&[&mesh], &[], Surface::Own(&coats));
        // The first triangle is on the right and below, the second on the left and above.
        let [red, green] = [(14, 16), (4, 4)].map(|(x, y)| drawn.get_pixel(x, y).0);
        assert!(red[0] > 2 * red[1] && red[0] > 2 * red[2], "{red:?}");
        assert!(green[1] > 2 * green[0] && green[1] > 2 * green[2], "{green:?}");
        let none = Vec::new();
        assert_eq!(
            render(&[&mesh], &[], Surface::Own(&none)),
            render(&[&mesh], &[], Surface::Clay)
        );
    }

    #[test]
    fn a_texture_shows_where_the_uvs_say() {
        let mut mesh = square(1.0, 0.0);
        let values = vec![0.0, 1.0, 1.0, 1.0, 1.0, 0.0, 0.0, 0.0];
        mesh.uvs[0] = chamfer::UvBuffer { components: 2, values };
        let halves = RgbImage::from_fn(8, 8, |_, y| Rgb([0, if y < 4 { 255 } else { 0 }, 0]));
        let drawn = render(&[&mesh], &[], Surface::Texture(&halves));
        let is_green = |y| drawn.get_pixel(10, y).0[1] > 2 * drawn.get_pixel(10, y).0[0];
        assert!(is_green(5) && !is_green(14));
    }
}
