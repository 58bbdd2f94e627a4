//! Where vertices go: sectors, offsets, limits.

use glam::{DVec2, DVec3};

use super::drawing::{BLUE, Drawing, FAINT, GREEN, INK, ORANGE, PALETTE, Pen, RED};
use super::models::{add_block, nothing};
use super::scene::{Camera, FRONT, Scene};
use crate::ids::{Corner, Sector};
use crate::mesh::MeshBuffers;
use crate::options::{Options, Verify, Width};
use crate::shapes;
use crate::stages::Stages;
use crate::stages::{stages_of, stages_with};

/// Numbers nearer to each other than this could not be read.
const LABEL_SPACE: f64 = 40.0;

pub fn sectors() -> Drawing {
    let mut drawing = Drawing::new(720, 300);
    drawing.title(125.0, "three around a corner");
    drawing.title(360.0, "a fan over soft edges");
    drawing.title(595.0, "six around an inner corner");
    let cube = shapes::plain_cube(2.0);
    let camera = Camera::new(FRONT, [0.0; 3], 66.0, [125.0, 160.0]);
    draw_sectors(&mut drawing, &cube, camera, 0.55);
    let cylinder = shapes::cylinder(8);
    let camera = Camera::new([1.2, 2.0, 4.0], [0.0, 0.5, 0.0], 150.0, [360.0, 160.0]);
    draw_sectors(&mut drawing, &cylinder, camera, 0.15);
    let cubes = shapes::extruding_cubes();
    let camera = Camera::new([2.6, 2.4, 3.4], [0.9, 0.9, 0.9], 66.0, [595.0, 165.0]);
    draw_sectors(&mut drawing, &cubes, camera, 0.3);
    drawing.legend(&[(RED, "hard edge"), (BLUE, "one colour: one sector, which moves as one")]);
    drawing
}

/// Hard edges, and a fan of the given radius for each sector.
fn draw_sectors(drawing: &mut Drawing, mesh: &MeshBuffers, camera: Camera, radius: f64) {
    let stages = stages_of(mesh, 0.01);
    let scene = Scene::of_mesh(camera, mesh);
    scene.paint(drawing);
    soft_edges(drawing, &scene, &stages);
    for ring in stages.sectors.rings.ids() {
        for (place, &sector) in stages.sectors.ring(ring).iter().enumerate() {
            for corner in stages.sectors.corners(&stages.topology, sector) {
                let blade = blade(&stages, corner, radius);
                let middle = blade.iter().sum::<DVec3>() / 3.0;
                if scene.shows(middle) {
                    let flat = blade.map(|point| scene.camera.flat(point));
                    drawing.polygon(&flat, PALETTE[place]);
                }
            }
        }
    }
    hard_edges(drawing, &scene, &stages, Pen::new(RED, 2.2));
}

/// The tip of a triangle at one of its corners.
fn blade(stages: &Stages, corner: Corner, radius: f64) -> [DVec3; 3] {
    let at = stages.view.position_at(corner);
    let tip = |other: Corner| {
        let way = stages.view.position_at(other) - at;
        at + way * (radius / way.length()).min(0.45)
    };
    [at, tip(corner.next()), tip(corner.prev())]
}

fn ends(stages: &Stages, corner: Corner) -> [DVec3; 2] {
    [corner, corner.next()].map(|end| stages.view.position_at(end))
}

fn hard_edges(drawing: &mut Drawing, scene: &Scene, stages: &Stages, pen: Pen) {
    for edge in stages.edges.hard.iter() {
        scene.line(drawing, ends(stages, edge.sides[0]), pen);
    }
}

fn soft_edges(drawing: &mut Drawing, scene: &Scene, stages: &Stages) {
    for corner in stages.topology.twin.ids() {
        if stages.edges.chamfered_at[corner].is_none() {
            scene.line(drawing, ends(stages, corner), Pen::new(FAINT, 0.8));
        }
    }
}

pub fn offsets() -> Drawing {
    let mut drawing = Drawing::new(720, 310);
    drawing.title(125.0, "bisector, convex and reflex");
    drawing.title(360.0, "along a crease, along a border");
    drawing.title(595.0, "an end: the vertex stays");
    let camera = Camera::new(FRONT, [1.0, 1.0, 0.5], 70.0, [125.0, 165.0]);
    draw_offsets(&mut drawing, &shapes::l_shape(), 0.18, camera);
    let camera = Camera::new([1.2, 2.0, 4.0], [0.0, 0.5, 0.0], 105.0, [300.0, 165.0]);
    draw_offsets(&mut drawing, &shapes::cylinder(8), 0.12, camera);
    let camera = Camera::new(FRONT, [0.0, 0.5, 0.0], 50.0, [430.0, 165.0]);
    draw_offsets(&mut drawing, &shapes::open_box(), 0.25, camera);
    let camera = Camera::new([-2.5, 3.4, 3.2], [1.0, 0.7, 1.0], 66.0, [595.0, 165.0]);
    draw_offsets(&mut drawing, &shapes::wedge_end(), 0.15, camera);
    drawing.legend(&[(RED, "hard edge"), (INK, "offset"), (BLUE, "pulled edge, at the width")]);
    drawing
}

/// Arrows for the offsets, and the hard edges as they would be pulled.
fn draw_offsets(drawing: &mut Drawing, mesh: &MeshBuffers, width: f32, camera: Camera) {
    let stages = stages_of(mesh, width);
    let scene = Scene::of_mesh(camera, mesh);
    scene.paint(drawing);
    hard_edges(drawing, &scene, &stages, Pen::new(RED, 1.6));
    let pulled = |corner: Corner| {
        let sector = stages.sectors.sector_of[corner];
        stages.view.position_at(corner) + stages.offsets[sector].vector
    };
    for side in stages.edges.hard.iter().flat_map(|edge| edge.sides) {
        scene.line(drawing, [pulled(side), pulled(side.next())], Pen::new(BLUE, 1.6));
    }
    for sector in stages.sectors.fans.ids() {
        let (at, offset) = (stages.placed(0.0).base(sector), &stages.offsets[sector]);
        if scene.shows(at + offset.vector) {
            scene.arrow(drawing, [at, at + offset.vector], Pen::new(INK, 1.6));
            if !offset.moves() {
                scene.dot(drawing, at, 4.0, INK);
            }
        }
    }
}

pub fn vanishing() -> Drawing {
    let mut drawing = Drawing::new(720, 320);
    drawing.title(185.0, "a bevel");
    drawing.title(540.0, "a rounded corner");
    let (c, s) = (0.3 * (1.0 - 0.866_025_4), 0.15);
    let bevel = [[1.0, 0.75], [0.75, 1.0]];
    let rounded = [[1.0, 0.7], [1.0 - c, 0.7 + s], [0.7 + s, 1.0 - c], [0.7, 1.0]];
    for (x, corner) in [(185.0, &bevel[..]), (540.0, &rounded[..])] {
        let mut plate = shapes::Builder::default();
        let outline = [&[[-1.0, -0.4], [1.0, -0.4]][..], corner, &[[-1.0, 1.0]]].concat();
        plate.prism(&outline, 0.0, 0.9);
        let camera = Camera::new([0.6, 0.8, 4.0], [0.0, 0.3, 0.5], 115.0, [x, 165.0]);
        draw_vanishing(&mut drawing, &plate.finish(), 0.4, camera);
    }
    drawing.legend(&[
        (RED, "hard edge"),
        (ORANGE, "pulled by the width alone"),
        (INK, "offset"),
        (BLUE, "pulled edge"),
    ]);
    drawing
}

/// The front face of a mesh with its edges pulled, and as they would be if none vanished.
fn draw_vanishing(drawing: &mut Drawing, mesh: &MeshBuffers, width: f32, camera: Camera) {
    let stages = stages_of(mesh, width);
    let scene = Scene::of_mesh(camera, mesh);
    scene.paint(drawing);
    hard_edges(drawing, &scene, &stages, Pen::new(RED, 1.6));
    let members = || stages.vanishing.runs.iter().flat_map(|run| &run.members);
    let plain = |sector: Sector| {
        let changed = members().find(|(member, _)| *member == sector);
        changed.map_or(stages.offsets[sector].vector, |(_, plain)| plain.vector)
    };
    let at_front = |side: &Corner| stages.faces.normal[side.triangle()].z > 0.5;
    for side in stages.edges.hard.iter().flat_map(|edge| edge.sides).filter(at_front) {
        let ends = [side, side.next()];
        let sectors = ends.map(|end| stages.sectors.sector_of[end]);
        let at = ends.map(|end| stages.view.position_at(end));
        let straight = [0, 1].map(|k| at[k] + plain(sectors[k]));
        scene.line(drawing, straight, Pen::dashed(ORANGE, 1.2));
        let pulled = [0, 1].map(|k| at[k] + stages.offsets[sectors[k]].vector);
        scene.line(drawing, pulled, Pen::new(BLUE, 1.6));
        scene.arrow(drawing, [at[0], pulled[0]], Pen::new(INK, 1.2));
    }
}

pub fn room() -> Drawing {
    let mut drawing = Drawing::new(720, 320);
    drawing.title(185.0, "each edge has the room of its own face");
    drawing.title(540.0, "a rim goes together");
    let mut slab = nothing();
    add_block(&mut slab, [-1.0, 0.0, -0.6], [1.0, 0.3, 0.6]);
    let camera = Camera::new(FRONT, [0.0, 0.15, 0.0], 120.0, [185.0, 160.0]);
    draw_room(&mut drawing, (&slab, 0.2, 0.0), camera);
    let camera = Camera::new([1.2, 2.0, 4.0], [0.0, 0.5, 0.0], 150.0, [540.0, 160.0]);
    draw_room(&mut drawing, (&shapes::cylinder(12), 0.3, 0.0), camera);
    drawing.legend(&[(FAINT, "at full width"), (BLUE, "as far as there is room")]);
    drawing
}

pub fn evenness() -> Drawing {
    let mut drawing = Drawing::new(720, 320);
    for (x, evenness, title) in
        [(125.0, 0.0, "not at all"), (360.0, 0.5, "a half"), (595.0, 1.0, "one width")]
    {
        drawing.title(x, title);
        let camera = Camera::new(FRONT, [0.0, 0.2, 0.0], 82.0, [x, 160.0]);
        let mut parts = nothing();
        add_block(&mut parts, [-1.0, 0.0, -0.6], [1.0, 0.16, 0.6]);
        add_block(&mut parts, [-1.0, 0.5, -0.6], [1.0, 0.8, 0.6]);
        draw_room(&mut drawing, (&parts, 0.2, evenness), camera);
    }
    drawing.legend(&[(FAINT, "at full width"), (BLUE, "as even as asked for")]);
    drawing
}

/// The pulled edges of a mesh as far as there is room for a width, at an evenness.
fn draw_room(
    drawing: &mut Drawing,
    (mesh, width, evenness): (&MeshBuffers, f32, f32),
    camera: Camera,
) {
    let options = Options { width: Width::Units(width), evenness, ..Options::default() };
    let stages = stages_with(mesh, &options);
    let scene = Scene::of_mesh(camera, mesh);
    scene.paint(drawing);
    hard_edges(drawing, &scene, &stages, Pen::new(INK, 0.8));
    let limits = stages.limits(Verify::Fast);
    for side in stages.edges.hard.iter().flat_map(|edge| edge.sides) {
        let ends = [side, side.next()];
        let full = |corner: Corner| {
            let sector = stages.sectors.sector_of[corner];
            stages.view.position_at(corner) + stages.offsets[sector].vector
        };
        scene.line(drawing, ends.map(full), Pen::dashed(FAINT, 1.0));
        let limited = ends.map(|end| limits.placement.position_at(end));
        scene.line(drawing, limited, Pen::new(BLUE, 1.6));
    }
}

pub fn limits() -> Drawing {
    let mut drawing = Drawing::new(720, 320);
    drawing.title(185.0, "a narrow part narrows itself alone");
    drawing.title(540.0, "two that compete for a face get the same");
    let mut parts = nothing();
    add_block(&mut parts, [-1.0, 0.0, -0.7], [1.0, 0.6, 0.7]);
    add_block(&mut parts, [-1.0, 0.0, 1.3], [1.0, 0.2, 1.5]);
    let camera = Camera::new(FRONT, [0.0, 0.3, 0.4], 100.0, [185.0, 160.0]);
    draw_shares(&mut drawing, &parts, 0.15, camera);
    let mut slab = nothing();
    add_block(&mut slab, [-1.0, 0.0, -0.6], [1.0, 0.5, 0.6]);
    let camera = Camera::new(FRONT, [0.0, 0.25, 0.0], 120.0, [540.0, 160.0]);
    draw_shares(&mut drawing, &slab, 0.32, camera);
    drawing.legend(&[
        (FAINT, "at full width"),
        (BLUE, "as limited"),
        (GREEN, "share of the offset: all of it"),
        (ORANGE, "less"),
    ]);
    drawing
}

/// The pulled edges as limited, and the share of each sector.
fn draw_shares(drawing: &mut Drawing, mesh: &MeshBuffers, width: f32, camera: Camera) {
    let stages = stages_of(mesh, width);
    let placement = stages.placement();
    let scene = Scene::of_mesh(camera, mesh);
    scene.paint(drawing);
    hard_edges(drawing, &scene, &stages, Pen::new(INK, 0.8));
    for side in stages.edges.hard.iter().flat_map(|edge| edge.sides) {
        let full = |corner: Corner| {
            let sector = stages.sectors.sector_of[corner];
            stages.view.position_at(corner) + stages.offsets[sector].vector
        };
        let ends = [side, side.next()];
        scene.line(drawing, ends.map(full), Pen::dashed(FAINT, 1.0));
        let limited = ends.map(|end| placement.position_at(end));
        scene.line(drawing, limited, Pen::new(BLUE, 1.4));
    }
    let mut labels: Vec<(DVec2, String)> = Vec::new();
    let moved = |sector: &Sector| stages.offsets[*sector].moves();
    for sector in stages.sectors.fans.ids().filter(moved) {
        let (share, at) = (placement.share[sector], placement.point[sector]);
        scene.dot(drawing, at, 4.0, if share < 1.0 { ORANGE } else { GREEN });
        let beside = scene.camera.flat(at) + DVec2::new(0.0, -12.0);
        let has_space = labels.iter().all(|(other, _)| other.distance(beside) > LABEL_SPACE);
        if share < 1.0 && scene.shows(at) && has_space {
            labels.push((beside, format!("{share:.2}")));
        }
    }
    labels.iter().for_each(|(at, share)| drawing.label(*at, INK, share));
}
