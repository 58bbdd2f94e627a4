//! Widths of their own: of edges, in a space of its own, and beside edges that stay hard.

use glam::{DVec2, DVec3};

use super::drawing::{Anchor, Drawing, INK};
use super::result::{self, ABOVE, draw_result};
use super::scene::{Camera, FRONT};
use crate::mesh::{EdgeFactor, Factors, Mesh, MeshBuffers};
use crate::options::{Options, Width};
use crate::report::Chamfered;
use crate::shapes;

/// Edges that are chosen, and then unlike widths at a corner, and a box that a scene stretches.
pub fn selection() -> Drawing {
    let (mut drawing, y) = (result::selection(), 385.0);
    let pictures = [
        ("a factor for each edge", unlike(), 56.0, 125.0),
        ("a box that a scene stretches", stretched(true), 48.0, 360.0),
        ("the same without its scale", stretched(false), 48.0, 595.0),
    ];
    for (title, result, size, x) in pictures {
        drawing.text(DVec2::new(x, y - 106.0), Anchor::Middle, INK, title);
        draw_result(&mut drawing, &result, Camera::new(FRONT, [0.0; 3], size, [x, y]));
    }
    drawing.legend(&[("#7dafdc", "strip"), ("#f0ba5f", "fill")]);
    drawing
}

/// Edges that end between others, which stay hard.
pub fn flaps() -> Drawing {
    let mut drawing = Drawing::new(720, 320);
    drawing.title(360.0, "upright edges alone: four flaps give back what the cut takes too much");
    draw_result(&mut drawing, &upright(), Camera::new(ABOVE, [0.0; 3], 78.0, [360.0, 160.0]));
    drawing.legend(&[("#7dafdc", "strip"), ("#f0ba5f", "flap")]);
    drawing
}

fn asked(mesh: &MeshBuffers, edges: &[EdgeFactor], options: Options) -> Chamfered {
    let factors = Factors { edges, ..Factors::default() };
    crate::chamfer(&Mesh { factors, ..mesh.as_mesh() }, &options).unwrap_or_default()
}

fn options(width: f32) -> Options {
    Options { width: Width::Units(width), ..Options::default() }
}

/// The hard edges of a mesh, with a factor for each by its ends; those without are left out.
fn edges(mesh: &MeshBuffers, factor: impl Fn([DVec3; 2]) -> Option<f32>) -> Vec<EdgeFactor> {
    let place = |v: u32| DVec3::from(mesh.positions[v as usize].map(f64::from));
    let all = asked(mesh, &[], options(0.01)).verdicts.into_iter().map(|edge| edge.vertices);
    let with_factor = |vertices: [u32; 2]| {
        factor(vertices.map(place)).map(|factor| EdgeFactor { vertices, factor })
    };
    all.filter_map(with_factor).collect()
}

/// Edges along the three axes have widths of their own.
fn unlike() -> Chamfered {
    let cube = shapes::plain_cube(2.0);
    let edges = edges(&cube, |[from, to]| {
        let along = (to - from).abs();
        Some(if along.x > 1.0 {
            1.0
        } else if along.y > 1.0 {
            2.0
        } else {
            4.0
        })
    });
    asked(&cube, &edges, options(0.12))
}

/// Chamfered with or without the matrix, and then stretched.
fn stretched(is_known: bool) -> Chamfered {
    let cube = shapes::plain_cube(1.0);
    let [x, y, z] = [3.0, 1.2, 1.2];
    let scale = [[x, 0.0, 0.0], [0.0, y, 0.0], [0.0, 0.0, z]];
    let options = options(0.12);
    let mut result = asked(&cube, &[], if is_known { options.with_scale(scale) } else { options });
    result.mesh.positions.iter_mut().for_each(|at| *at = [at[0] * x, at[1] * y, at[2] * z]);
    result
}

/// The corners of the cap are cut off.
fn upright() -> Chamfered {
    let cube = shapes::plain_cube(2.0);
    let edges = edges(&cube, |[from, to]| (from.y != to.y).then_some(1.0));
    asked(&cube, &edges, options(0.35))
}
