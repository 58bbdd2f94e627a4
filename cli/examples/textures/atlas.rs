//! An atlas for a model of flat, upright faces: a chart for each face, all to one scale.

use chamfer::{MeshBuffers, UvBuffer};
use glam::{Vec2, Vec3};
use image::{Rgb, RgbImage};

/// Pixels per side.
const SIZE: u32 = 600;

/// Free space around each chart, in units of the model.
const GAP: f32 = 0.03;

/// How much wider the atlas is than the widest chart.
const WIDTH: f32 = 1.55;

/// What no chart covers: a texel of it on the model is a mistake that nobody overlooks.
const OUTSIDE: [u8; 3] = [255, 0, 200];

const LINE: [u8; 3] = [20, 20, 24];

/// One face of the model.
struct Chart {
    vertices: Vec<usize>,
    low: Vec2,
    size: Vec2,
    /// Where its low corner lies in the atlas, in units of the model.
    place: Vec2,
}

/// The charts of a model.
pub struct Atlas {
    charts: Vec<Chart>,
    /// Units of the model per side of the atlas.
    side: f32,
}

impl Atlas {
    /// Gives a model an atlas in channel 0. Tangents are dropped: they belonged to the old UVs.
    pub fn unwrap(mesh: &mut MeshBuffers) -> Atlas {
        let flat: Vec<Vec2> =
            mesh.positions.iter().zip(&mesh.normals).map(|(p, n)| projected(*p, *n)).collect();
        let mut charts: Vec<Chart> =
            faces(mesh).into_iter().map(|vertices| Chart::around(vertices, &flat)).collect();
        let side = pack(&mut charts);
        let mut uvs = vec![Vec2::ZERO; flat.len()];
        for chart in &charts {
            for &vertex in &chart.vertices {
                uvs[vertex] = (flat[vertex] - chart.low + chart.place) / side;
            }
        }
        let values = uvs.iter().flat_map(|uv| uv.to_array()).collect();
        mesh.uvs[0] = UvBuffer { components: 2, values };
        mesh.tangents.clear();
        Atlas { charts, side }
    }

    /// A picture with boards for each chart.
    pub fn paint(&self) -> RgbImage {
        RgbImage::from_fn(SIZE, SIZE, |x, y| {
            let place = Vec2::new(x as f32 + 0.5, y as f32 + 0.5) / SIZE as f32 * self.side;
            let charts = self.charts.iter().enumerate();
            let mut colors = charts.filter_map(|(number, chart)| chart.color(number, place));
            Rgb(colors.next().unwrap_or(OUTSIDE))
        })
    }
}

impl Chart {
    fn around(vertices: Vec<usize>, flat: &[Vec2]) -> Chart {
        let places = || vertices.iter().map(|&vertex| flat[vertex]);
        let low = places().reduce(Vec2::min).unwrap_or_default();
        let high = places().reduce(Vec2::max).unwrap_or_default();
        Chart { vertices, low, size: high - low, place: Vec2::ZERO }
    }

    /// `None` outside; a bilinear sample at the border must not mix in what lies there.
    fn color(&self, number: usize, at: Vec2) -> Option<[u8; 3]> {
        let inside = at - self.place;
        let border = inside.min(self.size - inside).min_element();
        if border < -GAP / 3.0 {
            return None;
        }
        let across = if self.size.x > self.size.y { inside.y } else { inside.x };
        let board = (across / 0.06).floor() as i32;
        let tone = 0.75 + 0.25 * ((board * 7 + number as i32 * 5).rem_euclid(4) as f32) / 3.0;
        let wood = Vec3::new(205.0, 160.0 - 9.0 * (number % 6) as f32, 105.0) * tone;
        Some(wood.to_array().map(|value| value as u8))
    }
}

/// A point seen along the axis that its normal is nearest to.
fn projected([x, y, z]: [f32; 3], normal: [f32; 3]) -> Vec2 {
    let [nx, ny, _] = normal.map(f32::abs);
    if ny > 0.5 {
        Vec2::new(x, z)
    } else if nx > 0.5 {
        Vec2::new(z, y)
    } else {
        Vec2::new(x, y)
    }
}

/// The vertices of each set of triangles that share vertices, by their first.
fn faces(mesh: &MeshBuffers) -> Vec<Vec<usize>> {
    let mut first_of: Vec<usize> = (0..mesh.positions.len()).collect();
    loop {
        let before = first_of.clone();
        for triangle in mesh.indices.as_chunks::<3>().0 {
            let first = triangle.iter().map(|&v| first_of[v as usize]).min().unwrap_or(0);
            triangle.iter().for_each(|&v| first_of[v as usize] = first);
        }
        if first_of == before {
            break;
        }
    }
    let members = |first| (0..first_of.len()).filter(|&v| first_of[v] == first).collect();
    let all: Vec<Vec<usize>> = (0..first_of.len()).map(members).collect();
    all.into_iter().filter(|vertices| !vertices.is_empty()).collect()
}

/// Sets the charts in rows, the highest first, each in the first row with room; gives the side of
/// the square that holds all.
fn pack(charts: &mut [Chart]) -> f32 {
    charts.sort_by(|a, b| b.size.y.total_cmp(&a.size.y));
    let widest = charts.iter().map(|chart| chart.size.x).fold(0.0, f32::max);
    let width = widest * WIDTH;
    let mut rows: Vec<Vec2> = Vec::new();
    let mut top = GAP;
    for chart in charts {
        let row = rows.iter().position(|end| end.x + chart.size.x + GAP <= width);
        let row = row.unwrap_or_else(|| {
            rows.push(Vec2::new(GAP, top));
            top += chart.size.y + GAP;
            rows.len() - 1
        });
        chart.place = rows[row];
        rows[row].x += chart.size.x + GAP;
    }
    width.max(top)
}

/// The atlas with the outlines of a mesh's triangles on it.
pub fn outlined(image: &RgbImage, mesh: &MeshBuffers) -> RgbImage {
    let mut drawn = image.clone();
    let uvs = mesh.uvs[0].values.as_chunks::<2>().0;
    for triangle in mesh.indices.as_chunks::<3>().0 {
        let [a, b, c] = triangle.map(|v| Vec2::from(uvs[v as usize]) * SIZE as f32);
        [[a, b], [b, c], [c, a]].into_iter().for_each(|ends| line(&mut drawn, ends));
    }
    drawn
}

fn line(image: &mut RgbImage, [from, to]: [Vec2; 2]) {
    let steps = from.distance(to).ceil().max(1.0) as u32;
    for step in 0..=steps {
        let at = from.lerp(to, step as f32 / steps as f32);
        if let Some(pixel) = image.get_pixel_mut_checked(at.x as u32, at.y as u32) {
            *pixel = Rgb(LINE);
        }
    }
}
