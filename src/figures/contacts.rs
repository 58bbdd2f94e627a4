//! What rests on what, and what becomes of the edges below.

use glam::DVec3;

use super::drawing::{BLUE, Drawing, INK, ORANGE, Pen, RED};
use super::models::{add_block, nothing};
use super::result::{draw_outcomes, draw_result};
use super::scene::{Camera, FRONT, Scene};
use crate::mesh::{Held, Mesh, MeshBuffers};
use crate::options::{Options, Width};
use crate::view::wide;

pub fn contacts() -> Drawing {
    let mut drawing = Drawing::new(720, 300);
    drawing.title(125.0, "on an edge: held");
    drawing.title(360.0, "beside an edge: narrowed");
    drawing.title(595.0, "past the chamfer: full");
    for (x, inset) in [(125.0, 0.0), (360.0, 0.08), (595.0, 0.4)] {
        let camera = Camera::new(FRONT, [0.0, 0.4, 0.0], 80.0, [x, 155.0]);
        draw_block_below_rim(&mut drawing, camera, inset);
    }
    drawing.legend(&[
        (BLUE, "the rim of another object"),
        ("#55a573", "full"),
        (ORANGE, "narrowed"),
        (RED, "contact"),
    ]);
    drawing
}

/// A block on whose top a square rim rests, so far behind its edges in front and on the right.
fn draw_block_below_rim(drawing: &mut Drawing, camera: Camera, inset: f32) {
    let mut block = nothing();
    add_block(&mut block, [-1.0, 0.0, -1.0], [1.0, 0.8, 1.0]);
    let (low, high) = (-0.3, 1.0 - inset);
    let rim = [[low, low], [high, low], [high, high], [low, high]].map(|[x, z]| [x, 0.8, z]);
    let line = |k: usize| Held { from: rim[k], to: rim[(k + 1) % 4], radius: 0.0 };
    let held = [0, 1, 2, 3].map(line);
    let options = Options { width: Width::Units(0.2), ..Options::default() };
    let mesh = Mesh { held: &held, ..block.as_mesh() };
    let result = crate::chamfer(&mesh, &options).unwrap();
    let scene = draw_outcomes(drawing, camera, &block, &result);
    for Held { from, to, .. } in held {
        let [from, to] = [from, to].map(wide);
        scene.line(drawing, [from, to], Pen::new(BLUE, 1.8));
        scene.line(drawing, [from, from + DVec3::Y * 0.45], Pen::new(INK, 0.6));
        scene.line(drawing, [from + DVec3::Y * 0.45, to + DVec3::Y * 0.45], Pen::new(INK, 0.6));
    }
}

pub fn refine() -> Drawing {
    let mut drawing = Drawing::new(720, 300);
    drawing.title(185.0, "something rests on a part of an edge");
    drawing.title(540.0, "the edge gets vertices, its faces come in pieces");
    let mut beam = nothing();
    add_block(&mut beam, [-1.6, 0.0, -0.8], [1.6, 0.6, 0.8]);
    let rest = Held { from: [-0.25, 0.6, 0.8], to: [0.25, 0.6, 0.8], radius: 0.0 };
    let camera = |x| Camera::new(FRONT, [0.0, 0.3, 0.0], 76.0, [x, 150.0]);
    let scene = Scene::of_mesh(camera(185.0), &beam);
    scene.paint(&mut drawing);
    scene.outline(&mut drawing, Pen::new(INK, 0.5));
    draw_rest(&mut drawing, &scene, &rest);
    let scene = draw_result(&mut drawing, &chamfered_below(&beam, rest), camera(540.0));
    draw_rest(&mut drawing, &scene, &rest);
    drawing.legend(&[
        (BLUE, "the rim of another object"),
        ("#7dafdc", "strip"),
        ("#f0ba5f", "fill"),
    ]);
    drawing
}

fn chamfered_below(mesh: &MeshBuffers, rest: Held) -> crate::Chamfered {
    let options = Options { width: Width::Units(0.12), ..Options::default() };
    crate::chamfer(&Mesh { held: &[rest], ..mesh.as_mesh() }, &options).unwrap()
}

fn draw_rest(drawing: &mut Drawing, scene: &Scene, Held { from, to, .. }: &Held) {
    scene.line(drawing, [from, to].map(|&end| wide(end)), Pen::new(BLUE, 2.4));
}
