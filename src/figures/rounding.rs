//! How patches are rounded.

use super::drawing::Drawing;
use super::result::draw_result;
use super::scene::{Camera, FRONT};
use crate::mesh::MeshBuffers;
use crate::options::{Options, Width};
use crate::shapes;

/// A corner between convex and concave edges with one, two and four segments, and a pyramid's tip.
pub fn rounding() -> Drawing {
    let mut drawing = Drawing::new(720, 440);
    let options = |width: f32, segments: u32| {
        Options::default().with_width(Width::Units(width)).with_segments(segments)
    };
    let result = |mesh: &MeshBuffers, options: Options| {
        crate::chamfer(&mesh.as_mesh(), &options).unwrap_or_default()
    };
    let (saddle, pyramid) = (shapes::saddle(), shapes::pyramid(5));
    for (column, segments) in [1, 2, 4].into_iter().enumerate() {
        let x = 125.0 + 235.0 * column as f64;
        let title =
            if segments == 1 { "one segment".into() } else { format!("{segments} segments") };
        drawing.title(x, &title);
        let camera = Camera::new(FRONT, [1.0, 0.8, 1.0], 74.0, [x, 155.0]);
        draw_result(&mut drawing, &result(&saddle, options(0.3, segments)), camera);
        let camera = Camera::new([0.6, 3.0, 2.0], [0.0, 0.2, 0.0], 86.0, [x, 330.0]);
        draw_result(&mut drawing, &result(&pyramid, options(0.18, segments)), camera);
    }
    drawing.legend(&[("#7dafdc", "strip"), ("#f0ba5f", "fill")]);
    drawing
}
