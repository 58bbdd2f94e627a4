//! What comes out: patches, strips, fills, verdicts, output.

use glam::{DVec2, DVec3};

use super::drawing::{Anchor, Drawing, GREEN, INK, ORANGE, Pen, RED};
use super::models::{add_block, add_card, chamfered, nothing};
use super::scene::{CLAY, Camera, FILL, FRONT, Facet, Paint, STRIP, Scene, triangles};
use crate::ids::{Id, Patch};
use crate::mesh::{Factors, Mesh, MeshBuffers};
use crate::options::{Convexity, Options, Width};
use crate::report::{Chamfered, Outcome, TriangleKind};
use crate::shapes;
use crate::stages::stages_of;
use crate::strips as stage_strips;
use crate::view::wide;

pub const ABOVE: [f64; 3] = [0.6, 3.0, 2.0];

/// The result's triangles, painted by what they are.
pub fn draw_result(drawing: &mut Drawing, result: &Chamfered, camera: Camera) -> Scene {
    let paint = |kind| match kind {
        TriangleKind::Source => CLAY,
        TriangleKind::Edge => STRIP,
        TriangleKind::Corner => FILL,
    };
    let sources = result.triangle_sources.iter();
    let facets: Vec<Facet> = triangles(&result.mesh)
        .zip(sources)
        .map(|(points, source)| Facet { points, paint: paint(source.kind) })
        .collect();
    let scene = Scene::new(camera, facets);
    scene.paint(drawing);
    scene.outline(drawing, Pen::new(INK, 0.5));
    scene
}

/// The patches of a pyramid, lifted off its faces, with their joints and their middles.
pub fn patches() -> Drawing {
    let mut drawing = Drawing::new(720, 330);
    drawing.title(360.0, "ten strips and six fills: joints, triangles, and a point in the middle");
    let pyramid = shapes::pyramid(5);
    let stages = stages_of(&pyramid, 0.13);
    let placement = stages.placement();
    let patches = stages.patches(&placement);
    let mut facets: Vec<Facet> = (stages.view.triangles())
        .map(|t| t.corners().map(|corner| placement.position_at(corner)))
        .map(|points| Facet { points, paint: CLAY })
        .collect();
    let mut dots = Vec::new();
    for patch in (0..patches.len()).map(Patch::new) {
        let parts = patches.parts(patch);
        let joints = parts.joints.iter().map(|&joint| placement.position_at(joint));
        let points: Vec<DVec3> = joints.chain(parts.middles.iter().map(|m| m.position)).collect();
        let middle = points.iter().sum::<DVec3>() / points.len() as f64;
        let normal: DVec3 = parts.joints.iter().map(|&joint| placement.normal_at(joint)).sum();
        let lifted = |point: DVec3| middle + (point - middle) * 0.9 + normal.normalize() * LIFT;
        let paint = if patches.edge_or_ring(patch).is_ok() { STRIP } else { FILL };
        facets.extend(parts.triangles.iter().map(|triangle| Facet {
            points: triangle.map(|place| lifted(points[place as usize])),
            paint,
        }));
        let color = |place: usize| if place < parts.joints.len() { INK } else { RED };
        dots.extend(points.iter().enumerate().map(|(k, &point)| (lifted(point), color(k))));
    }
    let scene = Scene::new(Camera::new(ABOVE, [0.0, 0.2, 0.0], 128.0, [360.0, 170.0]), facets);
    scene.paint(&mut drawing);
    scene.outline(&mut drawing, Pen::new(INK, 0.5));
    for (at, color) in dots.into_iter().filter(|(at, _)| scene.shows(*at)) {
        scene.dot(&mut drawing, at, 3.0, color);
    }
    drawing.legend(&[("#7dafdc", "strip"), ("#f0ba5f", "fill")]);
    drawing
}

/// How far patches are drawn above where they are.
const LIFT: f64 = 0.05;

/// Results of asking for some edges only, or for unlike widths: the first row of that figure.
pub fn selection() -> Drawing {
    let mut drawing = Drawing::new(720, 520);
    let asked = |mesh: &MeshBuffers, factors: Factors, options: Options| {
        let mesh = Mesh { factors, ..mesh.as_mesh() };
        crate::chamfer(&mesh, &options).unwrap_or_default()
    };
    let options = |width: f32| Options { width: Width::Units(width), ..Options::default() };
    let corner = shapes::saddle();
    let convex = Options { convexity: Convexity::Convex, ..options(0.2) };
    let bolt = shapes::bolt();
    let submeshes = Factors { submeshes: &[1.0, 0.3], ..Factors::default() };
    let cube = shapes::plain_cube(2.0);
    let mask: Vec<f32> = cube.positions.iter().map(|at| 0.55 + 0.45 * at[0]).collect();
    let mask = Factors { vertices: &mask, ..Factors::default() };
    let pictures = [
        (
            "convex edges only",
            asked(&corner, Factors::default(), convex),
            Camera::new(FRONT, [1.0, 0.8, 1.0], 74.0, [125.0, 150.0]),
        ),
        (
            "a factor for each submesh",
            asked(&bolt, submeshes, options(0.06)),
            Camera::new(FRONT, [0.0, 0.45, 0.0], 52.0, [360.0, 108.0]),
        ),
        (
            "a mask, from 0.1 to 1",
            asked(&cube, mask, options(0.4)),
            Camera::new(FRONT, [0.0; 3], 66.0, [585.0, 150.0]),
        ),
    ];
    for (title, result, camera) in pictures {
        drawing.title(camera.flat(camera.middle()).x, title);
        draw_result(&mut drawing, &result, camera);
    }
    drawing
}

pub fn strips() -> Drawing {
    let mut drawing = Drawing::new(720, 320);
    drawing.title(185.0, "two triangles for each hard edge");
    drawing.title(540.0, "one where an end does not open");
    let cube = shapes::plain_cube(2.0);
    let camera = Camera::new(FRONT, [0.0; 3], 84.0, [185.0, 162.0]);
    let scene = draw_result(&mut drawing, &chamfered(&cube, 0.3), camera);
    let top_front = [DVec3::new(1.0, 1.0, 1.0), DVec3::new(-1.0, 1.0, 1.0)];
    name_corners(&mut drawing, &scene, &cube, 0.3, top_front);
    let ridge = shapes::wedge_end();
    let camera = Camera::new([-2.5, 3.4, 3.2], [0.8, 0.9, 1.0], 92.0, [540.0, 165.0]);
    draw_result(&mut drawing, &chamfered(&ridge, 0.15), camera);
    drawing.legend(&[("#7dafdc", "strip"), ("#f0ba5f", "fill")]);
    drawing
}

/// Writes a1, b1, a2, b2 at the corners of the strip of an edge, and draws the old edge.
fn name_corners(
    drawing: &mut Drawing,
    scene: &Scene,
    mesh: &MeshBuffers,
    width: f32,
    edge: [DVec3; 2],
) {
    let stages = stages_of(mesh, width);
    let placement = stages.placement();
    for hard in stages.edges.hard.iter() {
        let ends = [hard.sides[0], hard.sides[0].next()].map(|end| stages.view.position_at(end));
        if edge != ends && edge != [ends[1], ends[0]] {
            continue;
        }
        let points = stage_strips::quad(&placement, hard).points;
        let flat = edge.map(|end| scene.camera.flat(end));
        drawing.line(flat[0], flat[1], Pen::dashed(RED, 1.6));
        let middle = points.iter().sum::<DVec3>() / 4.0;
        for (point, name) in points.into_iter().zip(["b1", "a1", "a2", "b2"]) {
            drawing.dot(scene.camera.flat(point), 4.0, INK);
            let outward = scene.camera.flat(point) - scene.camera.flat(middle);
            let aside = DVec2::new(outward.x.signum() * 4.0, outward.y.signum() * 14.0);
            drawing.label(scene.camera.flat(point) + aside, INK, name);
        }
    }
}

pub fn fills() -> Drawing {
    let mut drawing = Drawing::new(720, 290);
    let saddle = shapes::saddle();
    let (three, four, five) = (shapes::plain_cube(2.0), shapes::pyramid(4), shapes::pyramid(5));
    let tip = [0.0, 0.4, 0.0];
    let pictures: [(&str, &MeshBuffers, f32, Camera); 4] = [
        ("three: a triangle", &three, 0.3, Camera::new(FRONT, [0.0; 3], 50.0, [90.0, 150.0])),
        ("four: two", &four, 0.2, Camera::new(ABOVE, tip, 82.0, [270.0, 150.0])),
        ("five: a middle vertex", &five, 0.2, Camera::new(ABOVE, tip, 82.0, [450.0, 150.0])),
        (
            "convex meets concave",
            &saddle,
            0.2,
            Camera::new(FRONT, [1.0, 0.8, 1.0], 58.0, [630.0, 150.0]),
        ),
    ];
    for (title, mesh, width, camera) in pictures {
        let middle = camera.flat(camera.middle()).x;
        draw_result(&mut drawing, &chamfered(mesh, width), camera);
        drawing.title(middle, title);
    }
    drawing.legend(&[("#7dafdc", "strip"), ("#f0ba5f", "fill")]);
    drawing
}

pub fn verdicts() -> Drawing {
    let mut drawing = Drawing::new(720, 330);
    let mut mesh = nothing();
    add_block(&mut mesh, [-1.0, 0.0, -0.7], [1.0, 0.6, 0.7]);
    add_block(&mut mesh, [-1.0, 0.0, 1.1], [1.0, 0.16, 1.26]);
    add_card(&mut mesh, [1.4, 0.0], [2.1, 1.1]);
    let result = chamfered(&mesh, 0.12);
    let camera = Camera::new(FRONT, [0.5, 0.4, 0.3], 95.0, [220.0, 165.0]);
    draw_outcomes(&mut drawing, camera, &mesh, &result);
    write_totals(&mut drawing, &result);
    drawing.legend(&[(GREEN, "full"), (ORANGE, "narrowed"), (RED, "skipped")]);
    drawing
}

/// A result with its strips painted by what became of their edges, and lines where edges stay.
pub fn draw_outcomes(
    drawing: &mut Drawing,
    camera: Camera,
    mesh: &MeshBuffers,
    result: &Chamfered,
) -> Scene {
    let paint = |place: usize| {
        let source = result.triangle_sources[place];
        match source.kind {
            TriangleKind::Edge => outcome_paint(result.verdicts[source.index as usize].outcome),
            _ => CLAY,
        }
    };
    let facets = triangles(&result.mesh)
        .enumerate()
        .map(|(place, points)| Facet { points, paint: paint(place) })
        .collect();
    let scene = Scene::new(camera, facets);
    scene.paint(drawing);
    for verdict in result.verdicts.iter().filter(|verdict| verdict.outcome == Outcome::Skipped) {
        let ends = verdict.vertices.map(|vertex| wide(mesh.positions[vertex as usize]));
        scene.line(drawing, ends, Pen::new(RED, 2.6));
    }
    scene
}

fn outcome_paint(outcome: Outcome) -> Paint {
    match outcome {
        Outcome::Full => [85.0, 165.0, 115.0],
        Outcome::Narrowed => [226.0, 150.0, 65.0],
        Outcome::Skipped => [197.0, 57.0, 43.0],
    }
}

/// What the verdicts say, with an example of each kind.
fn write_totals(drawing: &mut Drawing, result: &Chamfered) {
    let totals = &result.totals;
    let skipped = totals.skipped.total();
    let mut lines = vec![
        format!("width asked for  {}", result.width),
        format!("hard edges       {}", totals.hard_edges),
        format!("full             {}", totals.chamfered),
        format!("narrowed         {}", totals.narrowed),
        format!("skipped          {skipped}"),
        format!("mean width       {:.0} %", totals.mean_width * 100.0),
        String::new(),
    ];
    for outcome in [Outcome::Full, Outcome::Narrowed, Outcome::Skipped] {
        if let Some(verdict) = result.verdicts.iter().find(|verdict| verdict.outcome == outcome) {
            let (name, reason) = (outcome.name(), verdict.reason.name());
            lines
                .push(format!("{:?} {name}: {reason}, {:.2}", verdict.vertices, verdict.widths[0]));
        }
    }
    for (line, text) in lines.iter().enumerate() {
        drawing.code(DVec2::new(440.0, 70.0 + 19.0 * line as f64), text);
    }
}

pub fn output() -> Drawing {
    let mut drawing = Drawing::new(720, 350);
    let cube = shapes::cube(1.0);
    let result = chamfered(&cube, 0.1);
    drawing.title(185.0, "before");
    drawing.title(535.0, "after");
    let camera = Camera::new(FRONT, [0.0; 3], 115.0, [185.0, 140.0]);
    let scene = Scene::of_mesh(camera, &cube);
    scene.paint(&mut drawing);
    scene.outline(&mut drawing, Pen::new(INK, 0.5));
    let camera = Camera::new(FRONT, [0.0; 3], 115.0, [535.0, 140.0]);
    draw_result(&mut drawing, &result, camera);

    let count = |kind| result.triangle_sources.iter().filter(|from| from.kind == kind).count();
    let triangles = [TriangleKind::Source, TriangleKind::Edge, TriangleKind::Corner].map(count);
    let before = cube.positions.len();
    let vertices = [before, result.mesh.positions.len() - before];
    draw_array(&mut drawing, 262.0, "triangles", &triangles, &["source", "strips", "fills"]);
    draw_array(&mut drawing, 308.0, "vertices", &vertices, &["source", "copies at seams"]);
    drawing
}

/// An array as a bar: its parts in proportion, each with its name and its indices.
fn draw_array(drawing: &mut Drawing, y: f64, title: &str, counts: &[usize], names: &[&str]) {
    const COLORS: [&str; 3] = ["#d5d0c4", "#7dafdc", "#f0ba5f"];
    const LEFT: f64 = 110.0;
    const LENGTH: f64 = 580.0;
    let total: usize = counts.iter().sum();
    drawing.text(DVec2::new(LEFT - 50.0, y + 19.0), Anchor::Middle, INK, title);
    let mut start = 0;
    for (place, (&count, name)) in counts.iter().zip(names).enumerate() {
        let x = |index: usize| LEFT + LENGTH * index as f64 / total as f64;
        let [from, to] = [x(start), x(start + count)];
        let corners = [[from, y], [to, y], [to, y + 30.0], [from, y + 30.0]];
        drawing.polygon(&corners.map(DVec2::from), COLORS[place]);
        let middle = DVec2::new((from + to) / 2.0, y + 19.0);
        let last = start + count - 1;
        drawing.text(middle, Anchor::Middle, INK, &format!("{name} {start}..{last}"));
        start += count;
    }
}
