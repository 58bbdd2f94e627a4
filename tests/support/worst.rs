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

/// A sphere of some triangles, on each of which stands a spike as high as the sphere is wide: three
/// times as many triangles, whose boxes overlap by the hundred.
pub fn spikes(count: u32) -> MeshBuffers {
    let rings = (f64::from(count) / 4.0).sqrt().round() as u32;
    let sphere = chamfer::shapes::sphere(rings, 2 * rings);
    let mut indices = Vec::new();
    // The sphere's seam and poles have several vertices at one place, and all is split anyway.
    let mut points = sphere.positions;
    let base = points.len() as u32;
    for (spike, corners) in (0..).zip(sphere.indices.chunks_exact(3)) {
        let [a, b, c] = [0, 1, 2].map(|k| points[corners[k] as usize]);
        points.push([0, 1, 2].map(|axis| a[axis] + b[axis] + c[axis]));
        let sides = [(0, 1), (1, 2), (2, 0)];
        indices.extend(sides.iter().flat_map(|&(i, j)| [corners[i], corners[j], base + spike]));
    }
    shaded(&points, &indices, FLAT)
}

/// A closed cone over an outline: the radius of each step around it.
fn cone(steps: u32, radius: impl Fn(u32) -> f64) -> MeshBuffers {
    let rim = |step: u32| {
        let [x, z] = turn(f64::from(step) / f64::from(steps));
        [(x * radius(step)) as f32, 0.0, (-z * radius(step)) as f32]
    };
    let ends = [[0.0, 1.0, 0.0], [0.0; 3]];
    let points: Vec<Point> = (0..steps).map(rim).chain(ends).collect();
    let sides = (0..steps).flat_map(|step| [steps, step, (step + 1) % steps]);
    let floor = (0..steps).flat_map(|step| [steps + 1, (step + 1) % steps, step]);
    shaded(&points, &sides.chain(floor).collect::<Vec<u32>>(), FLAT)
}

/// A cone over a star of so many points.
pub fn star_cone(points: u32) -> MeshBuffers {
    cone(2 * points, |step| if step % 2 == 0 { 1.0 } else { 0.4 })
}

/// A wheel of so many teeth, each half as long as the wheel's radius: a prism over a star.
pub fn star_wheel(teeth: u32) -> MeshBuffers {
    let steps = 2 * teeth;
    let place = |step: u32, height: f32| {
        let [x, y] = turn(f64::from(step) / f64::from(steps));
        let radius = if step.is_multiple_of(2) { 1.0 } else { 0.5 };
        [(x * radius) as f32, (y * radius) as f32, height]
    };
    let rims = [0.0, 1.0].map(|height| (0..steps).map(move |step| place(step, height)));
    let hubs = [[0.0; 3], [0.0, 0.0, 1.0]];
    let points: Vec<Point> = rims.into_iter().flatten().chain(hubs).collect();
    let indices = (0..steps).flat_map(|step| {
        let [a, b] = [step, (step + 1) % steps];
        let [c, d] = [a, b].map(|low| low + steps);
        let [low, high] = [2 * steps, 2 * steps + 1];
        [a, b, d, a, d, c, low, b, a, high, c, d]
    });
    shaded(&points, &indices.collect::<Vec<u32>>(), FLAT)
}

/// A comb of so many slanted teeth, whose back is a fan from one of its ends.
pub fn comb(teeth: u32) -> MeshBuffers {
    // Of each tooth its tip and the valley behind it; then both ends of the back.
    let along = |number: u32| {
        let tooth = f64::from(number / 2);
        if number.is_multiple_of(2) { [tooth + 1.0, 1.0] } else { [tooth + 1.5, 0.05] }
    };
    let ends = [[0.0, 0.0], [f64::from(teeth) + 1.0, 0.0]];
    let outline: Vec<[f64; 2]> = (0..2 * teeth).map(along).chain(ends).collect();
    let (from, to, count) = (2 * teeth, 2 * teeth + 1, 2 * teeth + 2);
    let at = |height: f32| outline.iter().map(move |&[x, y]| [x as f32, y as f32, height]);
    let points: Vec<Point> = at(0.0).chain(at(1.0)).collect();
    let back = (0..teeth).flat_map(|tooth| {
        let valley = 2 * tooth + 1;
        let before = if tooth == 0 { 0 } else { valley - 2 };
        let fan = [from, valley, before];
        if tooth == 0 { vec![fan] } else { vec![fan, [valley, valley - 1, before]] }
    });
    let top: Vec<[u32; 3]> = back.chain([[from, to, from - 1]]).collect();
    let walls =
        (1..from).map(|step| [step, step - 1]).chain([[0, from], [from, to], [to, from - 1]]);
    let wall = |[a, b]: [u32; 2]| [a, b, b + count, a, b + count, a + count];
    let sides = top.iter().flat_map(|&[a, b, c]| [a + count, b + count, c + count, a, c, b]);
    shaded(&points, &sides.chain(walls.flat_map(wall)).collect::<Vec<u32>>(), FLAT)
}

/// A cone over a gear of so many teeth.
pub fn gear_cone(teeth: u32) -> MeshBuffers {
    cone(4 * teeth, |step| if step % 4 < 2 { 1.0 } else { 0.8 })
}

/// Closed wedges around one edge, a gap as wide as each beside it.
pub fn wedges(count: u32) -> MeshBuffers {
    let outer = |place: u32| {
        let [x, z] = turn(f64::from(place) / f64::from(2 * count));
        [x as f32, 1.0, -z as f32]
    };
    let points: Vec<Point> =
        [[0.0; 3], [0.0, 2.0, 0.0]].into_iter().chain((0..2 * count).map(outer)).collect();
    let wedge = |number: u32| {
        let [a, b] = [2 * number + 2, 2 * number + 3];
        [0, a, 1, 0, 1, b, 0, b, a, 1, a, b]
    };
    shaded(&points, &(0..count).flat_map(wedge).collect::<Vec<u32>>(), FLAT)
}

/// Hills of so many quads each way, each triangle flat, with a texture laid over all from above or
/// without any.
pub fn terrain(across: u32, has_texture: bool) -> MeshBuffers {
    let height = |x: u32, z: u32| ((x * 37 + z * 71 + x * z * 13) % 17) as f32 / 17.0;
    let point = |place: u32| {
        let [x, z] = [place % (across + 1), place / (across + 1)];
        [x as f32, height(x, z), z as f32]
    };
    let points: Vec<Point> = (0..(across + 1) * (across + 1)).map(point).collect();
    let quad = |place: u32| {
        let first = place / across * (across + 1) + place % across;
        let [a, b, c, d] = [first, first + 1, first + across + 2, first + across + 1];
        [a, c, b, a, d, c]
    };
    let indices: Vec<u32> = (0..across * across).flat_map(quad).collect();
    let mut mesh = shaded(&points, &indices, FLAT);
    if has_texture {
        let uv = |[x, _, z]: &[f32; 3]| [x / across as f32, z / across as f32];
        let values = mesh.positions.iter().flat_map(uv).collect();
        mesh.uvs[0] = chamfer::UvBuffer { components: 2, values };
    }
    mesh
}

/// A band of separate narrow quads, turned further and further: their boxes overlap by the hundred.
pub fn turned_quads(count: u32) -> MeshBuffers {
    let (mut points, mut indices): (Vec<Point>, Vec<u32>) = (Vec::new(), Vec::new());
    for quad in 0..=count {
        let share = f64::from(quad) / f64::from(count);
        let [cos, sin] = turn(share / 2.0);
        points.extend(
            [-1.0, 1.0].map(|side: f64| [(side * cos) as f32, (side * sin) as f32, share as f32]),
        );
        if quad < count {
            let [a, b, c, d] = [0, 1, 3, 2].map(|k| 2 * quad + k);
            indices.extend([a, b, c, a, c, d]);
        }
    }
    shaded(&points, &indices, FLAT)
}

/// A plate with so many square holes each way: above and below a face with all of them.
pub fn sieve(across: u32) -> MeshBuffers {
    let row = across + 1;
    let level = row * row + 4 * across * across;
    let points = (0..2 * level).map(|place| {
        let (place, height) = (place % level, (place / level) as f32 / 4.0);
        if place < row * row {
            return [(place % row) as f32, height, (place / row) as f32];
        }
        let (cell, corner) = ((place - row * row) / 4, (place - row * row) % 4);
        let [x, z] = [[0.3, 0.3], [0.7, 0.3], [0.7, 0.7], [0.3, 0.7]][corner as usize];
        [(cell % across) as f32 + x, height, (cell / across) as f32 + z]
    });
    let quad = |[a, b, c, d]: [u32; 4]| [a, b, c, a, c, d];
    let mut indices = Vec::new();
    // Points of the lower level: around a cell, and around its hole.
    for cell in 0..across * across {
        let first = cell / across * row + cell % across;
        let (outer, hole) =
            ([first, first + 1, first + row + 1, first + row], row * row + 4 * cell);
        for [one, other] in [[0, 1], [1, 2], [2, 3], [3, 0]] {
            let [a, b] = [outer[one as usize], outer[other as usize]];
            let [c, d] = [hole + other, hole + one];
            indices.extend(quad([a, b, c, d]));
            indices.extend(quad([a, d, c, b].map(|point| point + level)));
            indices.extend(quad([d, c, c + level, d + level]));
        }
    }
    let rim = |step: u32| [step, row * step + across, row * row - 1 - step, row * (across - step)];
    for (step, side) in (0..across).flat_map(|step| (0..4).map(move |side| (step, side))) {
        let [from, to] = [step, step + 1].map(|step| rim(step)[side]);
        indices.extend(quad([to, from, from + level, to + level]));
    }
    shaded(&points.collect::<Vec<Point>>(), &indices, FLAT)
}

/// A bar of so many pieces, one behind the other.
pub fn bar(pieces: u32) -> MeshBuffers {
    let profile = [[0.0, 0.0], [0.0, 1.0], [1.0, 1.0], [1.0, 0.0]];
    let point = |place: u32| {
        let [y, z] = profile[place as usize % 4];
        [(place / 4) as f32 / 4.0, y, z]
    };
    let points: Vec<Point> = (0..4 * (pieces + 1)).map(point).collect();
    let quad = |[a, b, c, d]: [u32; 4]| [a, b, c, a, c, d];
    let around = (0..pieces).flat_map(|piece| (0..4).map(move |side| (4 * piece, side)));
    let sides = around.flat_map(|(first, side)| {
        let [a, b] = [first + side, first + (side + 1) % 4];
        quad([a, b, b + 4, a + 4])
    });
    let end = 4 * pieces;
    let ends = quad([3, 2, 1, 0]).into_iter().chain(quad([0, 1, 2, 3].map(|k| end + k)));
    shaded(&points, &sides.chain(ends).collect::<Vec<u32>>(), FLAT)
}
