//! What is known of the source: view, weld, topology, faces, edges.

use glam::{DVec2, DVec3};

use super::drawing::{BLUE, Drawing, FAINT, GREEN, INK, ORANGE, PALETTE, PURPLE, Pen, RED};
use super::scene::{Camera, FRONT, Scene, exploded};
use crate::ids::{Corner, Id, Triangle, Vertex};
use crate::mesh::MeshBuffers;
use crate::options::Options;
use crate::shapes::{self, Touch};
use crate::stages::Stages;
use crate::stages::stages_of;
use crate::view::wide;
use crate::watch::Unwatched;
use crate::{view as stage_view, weld as stage_weld};

pub fn view() -> Drawing {
    let mut drawing = Drawing::new(720, 300);
    let cube = shapes::plain_cube(2.0);
    let mesh = cube.as_mesh();
    let view = stage_view::view(&mesh, &Options::default()).unwrap();
    let apart = exploded(&cube, 0.4);
    let scene = Scene::of_fronts(Camera::new(FRONT, [0.0; 3], 62.0, [180.0, 160.0]), &apart);
    drawing.title(180.0, "24 vertices, 12 triangles");
    scene.paint(&mut drawing);
    scene.outline(&mut drawing, Pen::new(FAINT, 1.0));
    number_vertices(&mut drawing, &scene, &apart);

    let mut row = |line: usize, text: &str| {
        drawing.code(DVec2::new(380.0, 52.0 + 19.0 * line as f64), text);
    };
    row(0, "vertex  position    normal");
    for vertex in 0..4 {
        let [position, normal] = [cube.positions[vertex], cube.normals[vertex]];
        row(vertex + 1, &format!("{vertex:6}  {}   {}", triple(position), triple(normal)));
    }
    row(5, "     ..");
    row(7, &format!("indices      {:?} ..", &cube.indices[..6]).replace(['[', ']'], ""));
    let (width, extent) = (view.width as f32, mesh.extent());
    let percent = 100.0 * width / extent;
    row(9, &format!("width        {percent} % of {extent} = {width} mesh units"));
    row(10, &format!("resolution   {:.1e} mesh units", view.resolution));
    drawing
}

fn triple(value: [f32; 3]) -> String {
    value.map(|along| format!("{along:2}")).join(" ")
}

/// Writes each vertex's number beside it, inside its own face.
fn number_vertices(drawing: &mut Drawing, scene: &Scene, mesh: &MeshBuffers) {
    for face in 0..mesh.positions.len() / 4 {
        if !scene.camera.sees(wide(mesh.normals[4 * face])) {
            continue;
        }
        let corners = [0, 1, 2, 3].map(|k| wide(mesh.positions[4 * face + k]));
        let middle = corners.iter().sum::<DVec3>() / 4.0;
        for (k, corner) in corners.into_iter().enumerate() {
            let inside = corner + (middle - corner) * 0.25;
            if scene.shows(inside) && scene.shows(corner) {
                drawing.dot(scene.camera.flat(corner), 3.0, INK);
                scene.label(drawing, inside, &(4 * face + k).to_string());
            }
        }
    }
}

pub fn weld() -> Drawing {
    let mut drawing = Drawing::new(720, 300);
    let cube = shapes::plain_cube(2.0);
    let weld = stage_weld::weld(&cube.as_mesh(), &Unwatched).unwrap();
    let color = |vertex: usize| PALETTE[weld.cluster_of[Vertex::new(vertex)].index()];
    let apart = exploded(&cube, 0.4);
    let left = Scene::of_fronts(Camera::new(FRONT, [0.0; 3], 60.0, [180.0, 165.0]), &apart);
    let right = Scene::of_mesh(Camera::new(FRONT, [0.0; 3], 70.0, [530.0, 172.0]), &cube);
    drawing.title(180.0, "vertices, faces drawn apart");
    drawing.title(530.0, "cluster: its vertices");
    left.paint(&mut drawing);
    right.paint(&mut drawing);
    left.outline(&mut drawing, Pen::new(FAINT, 1.0));
    right.outline(&mut drawing, Pen::new(FAINT, 1.0));
    for (vertex, (&position, &normal)) in apart.positions.iter().zip(&apart.normals).enumerate() {
        if left.camera.sees(wide(normal)) {
            left.dot(&mut drawing, wide(position), 6.0, color(vertex));
        }
    }
    for cluster in weld.first_vertex.ids() {
        let members: Vec<String> = (0..cube.positions.len())
            .filter(|&vertex| weld.cluster_of[Vertex::new(vertex)] == cluster)
            .map(|vertex| vertex.to_string())
            .collect();
        let at = wide(cube.positions[weld.first_vertex[cluster].index()]);
        if right.shows(at) {
            right.dot(&mut drawing, at, 6.0, PALETTE[cluster.index()]);
            let beside = right.camera.flat(at) + DVec2::new(0.0, -14.0);
            drawing.label(beside, INK, &format!("{}: {}", cluster.index(), members.join(", ")));
        }
    }
    drawing
}

pub fn topology() -> Drawing {
    let mut drawing = Drawing::new(720, 340);
    let open = shapes::open_box();
    let stages = stages_of(&open, 0.1);
    let camera = Camera::new(FRONT, [0.0, 0.5, 0.0], 88.0, [185.0, 170.0]);
    let scene = Scene::of_mesh(camera, &open);
    drawing.title(185.0, "half-edges and their twins");
    scene.paint(&mut drawing);
    for corner in stages.topology.twin.ids() {
        let twin = stages.topology.twin[corner];
        let color = if twin.is_none() { ORANGE } else { BLUE };
        half_edge(&mut drawing, &scene, &stages, corner, color);
        if twin.is_some() && corner < twin {
            link(&mut drawing, &scene, &stages, [corner, twin], INK);
        }
    }
    touching_cubes(&mut drawing);
    drawing.legend(&[
        (BLUE, "has a twin"),
        (ORANGE, "border"),
        (INK, "twins"),
        (GREEN, "one pair on the edge"),
        (PURPLE, "the other"),
    ]);
    drawing
}

/// Four half-edges on one edge: who is whose twin.
fn touching_cubes(drawing: &mut Drawing) {
    let cubes = shapes::two_cubes_touching(Touch::Edge);
    let stages = stages_of(&cubes, 0.1);
    let camera = Camera::new([1.0, 1.6, 6.0], [1.0, 1.0, 0.5], 86.0, [540.0, 175.0]);
    let scene = Scene::of_mesh(camera, &cubes);
    drawing.title(540.0, "parts that touch keep to themselves");
    scene.paint(drawing);
    scene.outline(drawing, Pen::new(FAINT, 0.8));
    let is_shared = |corner: &Corner| {
        let ends = [*corner, corner.next()].map(|end| stages.view.position_at(end));
        ends.iter().all(|end| end.x == 1.0 && end.y == 1.0)
    };
    let shared: Vec<Corner> = stages.topology.twin.ids().filter(is_shared).collect();
    for &corner in &shared {
        let twin = stages.topology.twin[corner];
        let color = if corner.min(twin) == shared[0] { GREEN } else { PURPLE };
        let middle = |c: Corner| {
            let points = stages.view.triangle(c.triangle());
            points.iter().sum::<DVec3>() / 3.0
        };
        let edge = (stages.view.position_at(corner) + stages.view.position_at(corner.next())) / 2.0;
        let ends = [edge + (middle(corner) - edge) * 0.9, edge];
        drawing.line(scene.camera.flat(ends[0]), scene.camera.flat(ends[1]), Pen::new(color, 2.0));
        drawing.dot(scene.camera.flat(ends[0]), 5.0, color);
    }
}

/// An arrow inside the triangle, along the half-edge.
fn inset(stages: &Stages, corner: Corner) -> [DVec3; 2] {
    let points = stages.view.triangle(corner.triangle());
    let middle = points.iter().sum::<DVec3>() / 3.0;
    let ends = [corner, corner.next()].map(|end| stages.view.position_at(end));
    let [from, to] = ends.map(|end| end + (middle - end) * 0.18);
    [from + (to - from) * 0.08, to - (to - from) * 0.08]
}

fn half_edge(
    drawing: &mut Drawing,
    scene: &Scene,
    stages: &Stages,
    corner: Corner,
    color: &'static str,
) {
    let [from, to] = inset(stages, corner);
    if [from, (from + to) / 2.0, to].into_iter().all(|point| scene.shows(point)) {
        scene.arrow(drawing, [from, to], Pen::new(color, 1.6));
    }
}

fn link(
    drawing: &mut Drawing,
    scene: &Scene,
    stages: &Stages,
    sides: [Corner; 2],
    color: &'static str,
) {
    let [one, other] = sides.map(|side| {
        let [from, to] = inset(stages, side);
        (from + to) / 2.0
    });
    let [from, to] = [sides[0], sides[0].next()].map(|end| stages.view.position_at(end));
    let edge = (from + to) / 2.0;
    if scene.shows(one) && scene.shows(other) {
        for end in [one, other] {
            drawing.line(scene.camera.flat(end), scene.camera.flat(edge), Pen::new(color, 1.2));
        }
    }
}

pub fn faces() -> Drawing {
    let mut drawing = Drawing::new(720, 300);
    let shape = shapes::l_shape();
    let stages = stages_of(&shape, 0.1);
    let scene = Scene::of_mesh(Camera::new(FRONT, [1.0, 1.0, 0.5], 78.0, [185.0, 165.0]), &shape);
    drawing.title(185.0, "a normal for each triangle");
    scene.paint(&mut drawing);
    scene.outline(&mut drawing, Pen::new(FAINT, 1.0));
    for triangle in stages.view.triangles() {
        normal_arrow(&mut drawing, &scene, &stages, triangle, 0.45);
    }
    borrowed_normal(&mut drawing);
    drawing.legend(&[(BLUE, "normal"), (RED, "a line, and where its normal comes from")]);
    drawing
}

fn middle_of(stages: &Stages, triangle: Triangle) -> DVec3 {
    stages.view.triangle(triangle).iter().sum::<DVec3>() / 3.0
}

fn normal_arrow(
    drawing: &mut Drawing,
    scene: &Scene,
    stages: &Stages,
    triangle: Triangle,
    by: f64,
) {
    let middle = middle_of(stages, triangle);
    scene.arrow(
        drawing,
        [middle, middle + stages.faces.normal[triangle] * by],
        Pen::new(BLUE, 1.8),
    );
}

/// Two squares below one of twice their width; a triangle without height closes the gap between.
fn borrowed_normal(drawing: &mut Drawing) {
    let positions = [
        [0.0, 1.0, 0.0],
        [2.0, 1.0, 0.0],
        [2.0, 2.0, 0.0],
        [0.0, 2.0, 0.0],
        [1.0, 1.0, 0.0],
        [0.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [2.0, 0.0, 0.0],
    ];
    let indices = vec![0, 1, 2, 0, 2, 3, 5, 6, 4, 5, 4, 0, 6, 7, 1, 6, 1, 4, 0, 4, 1];
    let mesh = MeshBuffers {
        positions: positions.to_vec(),
        normals: vec![[0.0, 0.0, 1.0]; positions.len()],
        submesh_index_counts: vec![indices.len() as u32],
        indices,
        ..MeshBuffers::default()
    };
    let stages = stages_of(&mesh, 0.1);
    let camera = Camera::new([-1.0, 1.2, 3.0], [1.0, 1.0, 0.0], 92.0, [530.0, 165.0]);
    let scene = Scene::of_mesh(camera, &mesh);
    drawing.title(530.0, "a line borrows its normal");
    scene.paint(drawing);
    scene.outline(drawing, Pen::new(FAINT, 1.0));
    for triangle in stages.view.triangles().filter(|&triangle| !stages.faces.is_line(triangle)) {
        normal_arrow(drawing, &scene, &stages, triangle, 0.3);
    }
    for line in stages.view.triangles().filter(|&triangle| stages.faces.is_line(triangle)) {
        let corners = stages.view.triangle(line);
        for k in 0..3 {
            scene.line(drawing, [corners[k], corners[(k + 1) % 3]], Pen::new(RED, 3.0));
        }
        let lender = middle_of(&stages, stages.faces.lender[line].triangle());
        let place = lender + (middle_of(&stages, line) - lender) * 0.95;
        scene.arrow(drawing, [lender, place], Pen::new(RED, 1.8));
    }
}

pub fn edges() -> Drawing {
    let mut drawing = Drawing::new(720, 320);
    let cylinder = shapes::cylinder(12);
    let camera = Camera::new([1.2, 1.6, 4.0], [0.0, 0.5, 0.0], 175.0, [185.0, 160.0]);
    draw_edges(&mut drawing, &cylinder, camera);
    let open = shapes::open_box();
    let camera = Camera::new(FRONT, [0.0, 0.5, 0.0], 84.0, [530.0, 160.0]);
    draw_edges(&mut drawing, &open, camera);
    drawing.title(185.0, "a smooth side between flat caps");
    drawing.title(530.0, "a box without lid");
    drawing.legend(&[
        (RED, "hard: normals differ"),
        (BLUE, "seam: only UVs differ"),
        (FAINT, "soft"),
        (ORANGE, "border: no twin"),
    ]);
    drawing
}

fn draw_edges(drawing: &mut Drawing, mesh: &MeshBuffers, camera: Camera) {
    let stages = stages_of(mesh, 0.01);
    let scene = Scene::of_mesh(camera, mesh);
    scene.paint(drawing);
    let hard = &stages.edges.chamfered_at;
    let mut lines = Vec::new();
    for corner in stages.topology.twin.ids() {
        let twin = stages.topology.twin[corner];
        let pen = if twin.is_none() {
            Pen::new(ORANGE, 2.6)
        } else if twin < corner {
            continue;
        } else if hard[corner].is_some() {
            Pen::new(RED, 2.6)
        } else if stages.view.vertex_at(corner) != stages.view.vertex_at(twin.next()) {
            Pen::new(BLUE, 2.6)
        } else {
            Pen::new(FAINT, 1.0)
        };
        let ends = [corner, corner.next()].map(|end| stages.view.position_at(end));
        lines.push((ends, pen));
    }
    lines.sort_by(|one: &([DVec3; 2], Pen), other| one.1.width.total_cmp(&other.1.width));
    for (ends, pen) in lines {
        scene.line(drawing, ends, pen);
    }
}
