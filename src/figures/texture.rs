//! What vertices carry: attributes, seams.

use glam::DVec2;

use super::drawing::{BLUE, Drawing, FAINT, INK, ORANGE, Pen};
use super::models::chamfered;
use super::scene::{CLAY, Camera, FILL, FRONT, Facet, Paint, STRIP, Scene, triangles};
use crate::mesh::{Mesh, MeshBuffers};
use crate::report::{Chamfered, TriangleKind};
use crate::shapes;
use crate::view::wide;

/// A square of the paper that shows texture space, v upwards.
struct Chart {
    corner: DVec2,
    scale: f64,
}

impl Chart {
    fn place(&self, mesh: &Mesh, vertex: u32) -> DVec2 {
        let uv = &mesh.uvs[0].values[2 * vertex as usize..];
        self.corner + DVec2::new(f64::from(uv[0]), -f64::from(uv[1])) * self.scale
    }
}

pub fn attributes() -> Drawing {
    let mut drawing = Drawing::new(720, 320);
    let cylinder = shapes::cylinder(12);
    let result = chamfered(&cylinder, 0.12);
    drawing.title(185.0, "normals of the side: the same surface");
    drawing.title(530.0, "its texture: the same places");
    draw_normals(&mut drawing, &cylinder, &result);
    draw_texture(&mut drawing, &cylinder, &result);
    drawing.legend(&[(FAINT, "source vertex"), (BLUE, "moved vertex, re-sampled")]);
    drawing
}

/// The normals of the smooth side before and after, as arrows.
fn draw_normals(drawing: &mut Drawing, source: &MeshBuffers, result: &Chamfered) {
    let camera = Camera::new([1.2, 1.6, 4.0], [0.0, 0.5, 0.0], 165.0, [185.0, 165.0]);
    let scene = Scene::of_mesh(camera, source);
    scene.paint(drawing);
    for (mesh, pen, radius) in
        [(source, Pen::new(FAINT, 1.4), 3.0), (&result.mesh, Pen::new(BLUE, 1.8), 3.5)]
    {
        for (position, normal) in mesh.positions.iter().zip(&mesh.normals) {
            let (at, normal) = (wide(*position), wide(*normal));
            if normal.y == 0.0 && scene.camera.sees(normal) && scene.shows(at + normal * 1e-3) {
                scene.arrow(drawing, [at + normal * 1e-3, at + normal * 0.16], pen);
                drawing.dot(scene.camera.flat(at), radius, pen.color);
            }
        }
    }
}

/// The triangles of the side in texture space, and where their vertices went.
fn draw_texture(drawing: &mut Drawing, source: &MeshBuffers, result: &Chamfered) {
    let chart = Chart { corner: DVec2::new(410.0, 275.0), scale: 235.0 };
    let (before, after) = (source.as_mesh(), result.mesh.as_mesh());
    let is_side = |triangle: &usize| {
        source.indices[3 * triangle..3 * triangle + 3]
            .iter()
            .all(|&vertex| source.normals[vertex as usize][1] == 0.0)
    };
    let sides: Vec<usize> = (0..source.indices.len() / 3).filter(is_side).collect();
    let corners = |mesh: &Mesh, triangle: usize| {
        [0, 1, 2].map(|k| chart.place(mesh, mesh.indices[3 * triangle + k]))
    };
    for &triangle in &sides {
        let old = corners(&before, triangle);
        drawing.polygon(&old, "#e2ded4");
    }
    for (mesh, pen, radius) in
        [(&before, Pen::new(FAINT, 0.8), 3.0), (&after, Pen::new(BLUE, 1.2), 3.5)]
    {
        for &triangle in &sides {
            let places = corners(mesh, triangle);
            (0..3).for_each(|k| drawing.line(places[k], places[(k + 1) % 3], pen));
        }
        for &triangle in &sides {
            corners(mesh, triangle).into_iter().for_each(|at| drawing.dot(at, radius, pen.color));
        }
    }
}

/// A colour for each face of the cube.
const FACES: [Paint; 6] = [
    [226.0, 160.0, 150.0],
    [200.0, 180.0, 215.0],
    [170.0, 205.0, 175.0],
    [225.0, 205.0, 150.0],
    [160.0, 190.0, 225.0],
    [205.0, 200.0, 190.0],
];

pub fn charts() -> Drawing {
    let mut drawing = Drawing::new(720, 330);
    let result = chamfered(&shapes::cube(1.0), 0.1);
    let mesh = &result.mesh;
    drawing.title(170.0, "each chamfer has the colour of its owner");
    drawing.title(530.0, "the texture: chamfers fill their owner's band");
    let camera = Camera::new(FRONT, [0.0; 3], 150.0, [170.0, 170.0]);
    let facets = triangles(mesh).enumerate().map(|(triangle, points)| Facet {
        points,
        paint: FACES[owner_face(&mesh.as_mesh(), triangle)],
    });
    let scene = Scene::new(camera, facets.collect());
    scene.paint(&mut drawing);
    scene.outline(&mut drawing, Pen::new(INK, 0.6));
    draw_atlas(&mut drawing, &result);
    drawing.legend(&[("#7dafdc", "strip"), ("#f0ba5f", "fill"), (INK, "old edge of the chart")]);
    drawing
}

/// The face of the cube in whose part of the atlas, three by two, a triangle lies.
fn owner_face(mesh: &Mesh, triangle: usize) -> usize {
    let chart = Chart { corner: DVec2::ZERO, scale: 1.0 };
    let places = [0, 1, 2].map(|k| chart.place(mesh, mesh.indices[3 * triangle + k]));
    let middle = places.iter().sum::<DVec2>() / 3.0;
    let (column, row) = ((middle.x * 3.0) as usize, (-middle.y * 2.0) as usize);
    (row * 3 + column).min(5)
}

/// All triangles in texture space, by what they are.
fn draw_atlas(drawing: &mut Drawing, result: &Chamfered) {
    let chart = Chart { corner: DVec2::new(405.0, 290.0), scale: 250.0 };
    let mesh = result.mesh.as_mesh();
    let source = shapes::cube(1.0);
    for triangle in 0..source.indices.len() / 3 {
        let face = owner_face(&source.as_mesh(), triangle);
        let places =
            [0, 1, 2].map(|k| chart.place(&source.as_mesh(), source.indices[3 * triangle + k]));
        let [r, g, b] = FACES[face].map(|value| (value + (255.0 - value) * 0.4) as u8);
        drawing.polygon(&places, &format!("#{r:02x}{g:02x}{b:02x}"));
    }
    for (triangle, from) in result.triangle_sources.iter().enumerate() {
        let places = [0, 1, 2].map(|k| chart.place(&mesh, mesh.indices[3 * triangle + k]));
        let paint = match from.kind {
            TriangleKind::Source => CLAY,
            TriangleKind::Edge => STRIP,
            TriangleKind::Corner => FILL,
        };
        if from.kind != TriangleKind::Source {
            let [r, g, b] = paint.map(|value| value as u8);
            drawing.polygon(&places, &format!("#{r:02x}{g:02x}{b:02x}"));
            let pen = Pen::new(if from.kind == TriangleKind::Edge { BLUE } else { ORANGE }, 0.7);
            (0..3).for_each(|k| drawing.line(places[k], places[(k + 1) % 3], pen));
        }
    }
    for face in 0..6 {
        let corners = [0, 1, 2, 3].map(|k| chart.place(&source.as_mesh(), 4 * face + k));
        (0..4).for_each(|k| drawing.line(corners[k], corners[(k + 1) % 4], Pen::new(INK, 1.2)));
    }
}
