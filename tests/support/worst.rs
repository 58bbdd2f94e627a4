//! Shapes that are as bad as can be for the time or the precision of what works on them.

use chamfer::MeshBuffers;

use crate::shaded::{FLAT, shaded};

type Point = [f32; 3];

fn turn(turns: f64) -> [f64; 2] {
    let (sin, cos) = (turns * std::f64::consts::TAU).sin_cos();
    [cos, sin]
}

/// A cone without floor: so many triangles at one corner, of which every second edge is hard, or
/// none.
pub fn fan(sides: u32, is_flat: bool) -> MeshBuffers {
    let rim = |step: u32| {
        let [x, z] = turn(f64::from(step) / f64::from(sides));
        let radius = 1.0 + f64::from(step % 2) / 8.0;
        [(x * radius) as f32, 0.0, (-z * radius) as f32]
    };
    let points: Vec<Point> = (0..sides).map(rim).chain([[0.0, 1.0, 0.0]]).collect();
    let indices: Vec<u32> = (0..sides).flat_map(|step| [sides, step, (step + 1) % sides]).collect();
    shaded(&points, &indices, if is_flat { FLAT } else { 180.0 })
}

/// Faces on one edge, wound to and fro.
pub fn book(pages: u32) -> MeshBuffers {
    let outer = |page: u32| {
        let [x, z] = turn(f64::from(page) / f64::from(pages));
        [x as f32, 1.0, z as f32]
    };
    let points: Vec<Point> =
        [[0.0; 3], [0.0, 2.0, 0.0]].into_iter().chain((0..pages).map(outer)).collect();
    let page = |number: u32| match number % 2 {
        0 => [0, 1, number + 2],
        _ => [1, 0, number + 2],
    };
    let indices: Vec<u32> = (0..pages).flat_map(page).collect();
    shaded(&points, &indices, FLAT)
}

/// Every vertex at one place.
pub fn point(triangles: u32) -> MeshBuffers {
    MeshBuffers {
        positions: vec![[1.0, 2.0, 3.0]; 3 * triangles as usize],
        normals: vec![[0.0, 1.0, 0.0]; 3 * triangles as usize],
        indices: (0..3 * triangles).collect(),
        submesh_index_counts: vec![3 * triangles],
        ..MeshBuffers::default()
    }
}

/// One triangle, so many times.
pub fn stack(sheets: u32) -> MeshBuffers {
    let points = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.5]];
    let indices = [0, 1, 2].repeat(sheets as usize);
    shaded(&points, &indices, FLAT)
}

/// A grid of quads over points that wraps around in both directions, `across` of them one way.
fn grid(
    along: u32,
    across: u32,
    is_twisted: bool,
    at: impl Fn(f64, f64) -> [f64; 3],
) -> MeshBuffers {
    let place = |i: u32, j: u32| {
        // Past the seam of a twisted one, what was left is right.
        let j = if is_twisted && i == along { across - j % across } else { j };
        (i % along) * across + j % across
    };
    let position = |place: u32| {
        let (i, j) = (place / across, place % across);
        at(f64::from(i) / f64::from(along), f64::from(j) / f64::from(across)).map(|x| x as f32)
    };
    let points: Vec<Point> = (0..along * across).map(position).collect();
    let quad = |place_of: u32| {
        let (i, j) = (place_of / across, place_of % across);
        let [a, b, c, d] = [place(i, j), place(i + 1, j), place(i + 1, j + 1), place(i, j + 1)];
        [a, b, c, a, c, d]
    };
    let indices: Vec<u32> = (0..along * across).flat_map(quad).collect();
    shaded(&points, &indices, FLAT)
}

/// A bottle without inside, that passes through itself (the figure of eight, turned over once).
pub fn klein_bottle(along: u32) -> MeshBuffers {
    grid(along, 16, true, |u, v| {
        let ([cos, sin], [half_cos, half_sin], [_, v_sin], [_, v_two]) =
            (turn(u), turn(u / 2.0), turn(v), turn(2.0 * v));
        let out = 3.0 + half_cos * v_sin - half_sin * v_two;
        [out * cos, half_sin * v_sin + half_cos * v_two, out * sin]
    })
}

/// A band of quads with one side. Across it has a crease.
pub fn moebius_strip(steps: u32) -> MeshBuffers {
    let point = |step: u32, lane: u32| {
        let turns = f64::from(step) / f64::from(steps);
        let ([cos, sin], [half_cos, half_sin]) = (turn(turns), turn(turns / 2.0));
        let across = f64::from(lane) - 1.0;
        let out = 4.0 + across * half_cos;
        // The teeth make edges hard, and the seam is at an even step.
        let up = across * half_sin + f64::from(step % 2) / 8.0;
        [(out * cos) as f32, up as f32, (out * sin) as f32]
    };
    let points: Vec<Point> = (0..3 * steps).map(|place| point(place / 3, place % 3)).collect();
    let place = |step: u32, lane: u32| match step == steps {
        true => 2 - lane,
        false => 3 * step + lane,
    };
    let quads = (0..2 * steps).map(|quad| (quad / 2, quad % 2));
    let indices: Vec<u32> = quads
        .flat_map(|(step, lane)| {
            let [a, b] = [place(step, lane), place(step + 1, lane)];
            let [d, c] = [place(step, lane + 1), place(step + 1, lane + 1)];
            [a, b, c, a, c, d]
        })
        .collect();
    shaded(&points, &indices, FLAT)
}

/// Boxes a million times as long as they are high, side by side.
pub fn slivers(boxes: u32) -> MeshBuffers {
    let mut mesh = chamfer::shapes::cube_field(boxes);
    for [x, y, _] in &mut mesh.positions {
        (*x, *y) = (*x * 1e3, *y * 1e-3);
    }
    mesh
}

/// The same at another size or place, shaded alike.
pub fn placed(mut mesh: MeshBuffers, scale: f32, shift: f32) -> MeshBuffers {
    for along in mesh.positions.as_flattened_mut() {
        *along = *along * scale + shift;
    }
    mesh
}

/// Posts on plinths: on each cube stands a box without floor and lid, right beside the cube's
/// edges. So every second edge has an open rim within its chamfer, eight of them for each post.
pub fn posts(count: u32) -> MeshBuffers {
    let across = f64::from(count).sqrt().ceil() as u32;
    let corner = |low: f32, high: f32, k: u32| [low, high][k as usize];
    let (mut points, mut indices) = (Vec::new(), Vec::new());
    for post in 0..count {
        let (x, z) = ((post % across) as f32 * 3.0, (post / across) as f32 * 3.0);
        for (inset, y, height, sides) in [(0.0, 0.0, 1.0, 6), (0.004, 1.0, 1.0, 4)] {
            let first = points.len() as u32;
            points.extend((0..8).map(|k| {
                let along = |k: u32| corner(inset, 1.0 - inset, k);
                [x + along(k & 1), y + corner(0.0, height, k >> 1 & 1), z + along(k >> 2)]
            }));
            let quads = [
                [0, 2, 3, 1],
                [4, 5, 7, 6],
                [0, 4, 6, 2],
                [1, 3, 7, 5],
                [0, 1, 5, 4],
                [2, 6, 7, 3],
            ];
            for [a, b, c, d] in &quads[..sides] {
                indices.extend([a, b, c, a, c, d].map(|k| first + k));
            }
        }
    }
    shaded(&points, &indices, FLAT)
}
