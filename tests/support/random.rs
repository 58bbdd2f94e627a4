//! Strategies for random meshes. Coordinates come from coarse grids, so that coplanar faces,
//! straight runs of edges and parts that merely touch turn up as often as in models.

use std::collections::BTreeMap;
use std::fmt;

use chamfer::{MeshBuffers, UvBuffer};
use glam::{DMat3, DVec2, DVec3};
use proptest::collection::vec;
use proptest::prelude::*;

use crate::prism::prism;
use crate::shaded::{FLAT, shaded};

/// A random mesh; a failing one prints as literals.
#[derive(Clone)]
pub struct Model(pub MeshBuffers);

impl fmt::Debug for Model {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let MeshBuffers { positions, normals, indices, tangents, colors, uvs, .. } = &self.0;
        // Formatted apart: one line each, not one for each number.
        writeln!(f, "positions: {}", format_args!("{positions:?}"))?;
        writeln!(f, "normals: {}", format_args!("{normals:?}"))?;
        writeln!(f, "indices: {}", format_args!("{indices:?}"))?;
        let widths = uvs.each_ref().map(|uv| uv.components);
        write!(f, "tangents: {}, colors: {}, ", !tangents.is_empty(), !colors.is_empty())?;
        write!(f, "uvs: {}", format_args!("{widths:?}"))
    }
}

/// Meshes as models have them: consistently wound, each edge with one or two sides, or four where
/// bodies touch.
pub fn clean_mesh() -> impl Strategy<Value = Model> {
    let shapes = prop_oneof![prism_mesh(), roofed_mesh(), gridded_box(), blocks(), height_field()];
    (shapes, placement(), dress()).prop_map(|(mesh, placement, dress)| {
        Model(dress.put_on(reshaded(mesh, |point| placement.apply(point))))
    })
}

/// Triangles at random over few points: edges of many sides, winding at odds, triangles twice or
/// without area, and normals that may have nothing to do with them.
pub fn soup() -> impl Strategy<Value = Model> {
    let point = [-3..=3i32, -3..=3i32, -3..=3i32].prop_map(|at| at.map(|along| along as f32));
    let shapes = (3..12usize).prop_flat_map(move |count| {
        let triangle = [0..count as u32, 0..count as u32, 0..count as u32];
        (vec(point.clone(), count), vec(triangle, 1..25))
    });
    let smoothing = prop_oneof![Just(None), (0..180u32).prop_map(Some)];
    (shapes, smoothing, any::<u32>(), dress()).prop_map(
        |((points, triangles), smoothing, seed, dress)| {
            let mut mesh =
                shaded(&points, triangles.as_flattened(), smoothing.unwrap_or(60) as f32);
            if smoothing.is_none() {
                let mut noise = Noise(seed);
                mesh.normals.iter_mut().for_each(|normal| *normal = noise.unit().to_array());
            }
            Model(dress.put_on(mesh))
        },
    )
}

/// A shear, a turn and a shift.
#[derive(Clone, Copy, Debug)]
struct Placement {
    matrix: DMat3,
    shift: DVec3,
}

impl Placement {
    fn apply(&self, point: [f32; 3]) -> [f32; 3] {
        (self.matrix * DVec3::from(point.map(f64::from)) + self.shift).as_vec3().to_array()
    }
}

/// Often none at all: then coordinates are exact.
fn placement() -> impl Strategy<Value = Placement> {
    let nowhere = Placement { matrix: DMat3::IDENTITY, shift: DVec3::ZERO };
    let eighths = || (-4..=4i32).prop_map(|n| f64::from(n) / 8.0);
    let somewhere = ([eighths(), eighths(), eighths()], 0.0..3.0f64, -100..100i32);
    let placed = somewhere.prop_map(|([a, b, c], angle, shift)| {
        let shear = DMat3::from_cols(DVec3::X, DVec3::new(a, 1.0, 0.0), DVec3::new(b, c, 1.0));
        let turn = DMat3::from_axis_angle(DVec3::new(0.6, 0.0, 0.8), angle);
        Placement { matrix: turn * shear, shift: DVec3::splat(f64::from(shift)) }
    });
    prop_oneof![Just(nowhere), placed]
}

/// The same triangles over moved points, flat faces still flat-shaded and others still smooth.
fn reshaded(mesh: MeshBuffers, place: impl Fn([f32; 3]) -> [f32; 3]) -> MeshBuffers {
    let points: Vec<[f32; 3]> = mesh.positions.iter().map(|&point| place(point)).collect();
    let mut moved = shaded(&points, &mesh.indices, FLAT);
    // Vertices that were one before stay one: their faces are smooth.
    if moved.positions.len() > points.len() {
        moved = shaded(&points, &mesh.indices, 180.0);
    }
    moved
}

/// Points around the origin, counter-clockwise, at radii in eighths.
fn outline(count: usize, radii: std::ops::Range<i32>) -> impl Strategy<Value = Vec<[f32; 2]>> {
    let point = (0.0..0.45f64, radii);
    vec(point, count).prop_map(move |points| {
        let at = |(step, (jitter, radius)): (usize, (f64, i32))| {
            let turns = (step as f64 + jitter) / count as f64;
            let way = DVec2::from_angle(turns * std::f64::consts::TAU);
            (way * f64::from(radius) / 8.0).as_vec2().to_array()
        };
        points.into_iter().enumerate().map(at).collect()
    })
}

/// A flat-shaded prism over a star-shaped outline.
fn prism_mesh() -> impl Strategy<Value = MeshBuffers> {
    let outline = (3..11usize).prop_flat_map(|count| outline(count, 4..16));
    (outline, 1..30i32)
        .prop_map(|(outline, height)| prism(&outline, &clip_ears(&outline), height as f32 / 8.0))
}

/// A prism with a point in the middle of its top and of its floor: level, raised or sunk.
fn roofed_mesh() -> impl Strategy<Value = MeshBuffers> {
    let outline = (3..11usize).prop_flat_map(|count| outline(count, 4..16));
    (outline, -2..=4i32, 0..180u32).prop_map(|(outline, roof, smoothing)| {
        let count = outline.len() as u32;
        let at = |y: f32| outline.iter().map(move |&[x, z]| [x, y, -z]);
        let mut points: Vec<[f32; 3]> = at(0.0).chain(at(1.0)).collect();
        points.extend([[0.0; 3], [0.0, 1.0 + roof as f32 / 4.0, 0.0]]);
        let mut indices = Vec::new();
        for a in 0..count {
            let b = (a + 1) % count;
            indices.extend([a, b, b + count, a, b + count, a + count]);
            indices.extend([2 * count + 1, a + count, b + count, 2 * count, b, a]);
        }
        shaded(&points, &indices, smoothing as f32)
    })
}

/// The triangles of a simple polygon that runs counter-clockwise.
fn clip_ears(outline: &[[f32; 2]]) -> Vec<[u32; 3]> {
    let point = |k: u32| DVec2::from(outline[k as usize].map(f64::from));
    let turn = |a: u32, b: u32, c: u32| (point(b) - point(a)).perp_dot(point(c) - point(a));
    let mut rest: Vec<u32> = (0..outline.len() as u32).collect();
    let mut triangles = Vec::new();
    while rest.len() > 3 {
        let count = rest.len();
        let corners = |k: usize| [rest[(k + count - 1) % count], rest[k], rest[(k + 1) % count]];
        let is_ear = |k: &usize| {
            let [a, b, c] = corners(*k);
            let is_inside =
                |&p: &u32| turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0;
            let others = rest.iter().filter(|p| ![a, b, c].contains(p));
            turn(a, b, c) > 0.0 && others.filter(|p| is_inside(p)).count() == 0
        };
        let Some(ear) = (0..count).find(is_ear) else { break };
        triangles.push(corners(ear));
        rest.remove(ear);
    }
    triangles.extend(rest.chunks_exact(3).map(|t| [t[0], t[1], t[2]]));
    triangles
}

/// A box whose faces are divided at uneven places, along diagonals at random.
fn gridded_box() -> impl Strategy<Value = MeshBuffers> {
    let cuts = || proptest::collection::btree_set(1..16i32, 2..5);
    ([cuts(), cuts(), cuts()], any::<u32>()).prop_map(|(cuts, seed)| {
        let cuts = cuts.map(Vec::from_iter);
        let mut noise = Noise(seed);
        let mut net = Net::default();
        for axis in 0..3 {
            let [right, up] = [(axis + 1) % 3, (axis + 2) % 3];
            for (i, j) in cells(cuts[right].len() - 1, cuts[up].len() - 1) {
                for end in [0, cuts[axis].len() - 1] {
                    let mut quad =
                        [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)].map(|(i, j)| {
                            let mut at = [0; 3];
                            [at[axis], at[right], at[up]] =
                                [cuts[axis][end], cuts[right][i], cuts[up][j]];
                            at
                        });
                    if end == 0 {
                        quad.reverse();
                    }
                    net.add_quad(quad, noise.coin());
                }
            }
        }
        net.shaded(FLAT)
    })
}

/// The outside of unit cubes on a grid of three by three by three: stairs, bridges, holes, and
/// bodies that touch along edges and at corners.
fn blocks() -> impl Strategy<Value = MeshBuffers> {
    let filled = prop_oneof![3 => Just(false), 2 => Just(true)];
    (vec(filled, 27), any::<u32>()).prop_map(|(filled, seed)| {
        let is_filled = |at: [i32; 3]| {
            at.iter().all(|along| (0..3).contains(along))
                && filled[(at[0] + 3 * at[1] + 9 * at[2]) as usize]
        };
        let mut noise = Noise(seed);
        let mut net = Net::default();
        for cell in (0..27).map(|k| [k % 3, k / 3 % 3, k / 9]).filter(|&cell| is_filled(cell)) {
            for axis in 0..3 {
                for step in [-1, 1] {
                    let mut beside = cell;
                    beside[axis] += step;
                    if !is_filled(beside) {
                        net.add_quad(cube_side(cell, axis, step), noise.coin());
                    }
                }
            }
        }
        net.shaded(FLAT)
    })
}

/// One side of a unit cube, wound outward.
fn cube_side(cell: [i32; 3], axis: usize, step: i32) -> [[i32; 3]; 4] {
    let mut quad = [[0, 0], [1, 0], [1, 1], [0, 1]].map(|[right, up]| {
        let mut at = cell;
        at[axis] += i32::from(step > 0);
        at[(axis + 1) % 3] += right;
        at[(axis + 2) % 3] += up;
        at
    });
    if step < 0 {
        quad.reverse();
    }
    quad
}

/// A terrain over a grid, with holes, smooth up to a random angle.
fn height_field() -> impl Strategy<Value = MeshBuffers> {
    (2..7usize, 2..7usize)
        .prop_flat_map(|(width, depth)| {
            let heights = vec(-3..=3i32, (width + 1) * (depth + 1));
            let is_hole = prop_oneof![6 => Just(false), 1 => Just(true)];
            let cells = vec((is_hole, any::<bool>()), width * depth);
            (Just((width, depth)), heights, cells, 0..90u32)
        })
        .prop_map(|((width, depth), heights, kinds, smoothing)| {
            let mut net = Net::default();
            for ((i, j), (is_hole, diagonal)) in cells(width, depth).zip(kinds) {
                if !is_hole {
                    let corners = [(i, j), (i, j + 1), (i + 1, j + 1), (i + 1, j)];
                    let at = |(i, j): (usize, usize)| {
                        [4 * i as i32, heights[i * (depth + 1) + j], 4 * j as i32]
                    };
                    net.add_quad(corners.map(at), diagonal);
                }
            }
            net.shaded(smoothing as f32)
        })
}

fn cells(width: usize, depth: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..width).flat_map(move |i| (0..depth).map(move |j| (i, j)))
}

/// Triangles over points of an integer grid.
#[derive(Default)]
struct Net {
    number_of: BTreeMap<[i32; 3], u32>,
    points: Vec<[f32; 3]>,
    indices: Vec<u32>,
}

impl Net {
    fn add_quad(&mut self, corners: [[i32; 3]; 4], diagonal: bool) {
        let [a, b, c, d] = corners.map(|corner| self.number(corner));
        self.indices.extend(if diagonal { [a, b, c, a, c, d] } else { [b, c, d, b, d, a] });
    }

    fn number(&mut self, point: [i32; 3]) -> u32 {
        let points = &mut self.points;
        *self.number_of.entry(point).or_insert_with(|| {
            points.push(point.map(|along| along as f32));
            points.len() as u32 - 1
        })
    }

    fn shaded(&self, degrees: f32) -> MeshBuffers {
        shaded(&self.points, &self.indices, degrees)
    }
}

/// Which streams a mesh has besides positions and normals; their values are noise.
#[derive(Clone, Copy, Debug)]
struct Dress {
    uv_channels: [u32; 2],
    has_tangents: bool,
    has_colors: bool,
    seed: u32,
}

fn dress() -> impl Strategy<Value = Dress> {
    let width = || prop_oneof![Just(0), 2..=4u32];
    let parts = ([width(), width()], any::<bool>(), any::<bool>(), any::<u32>());
    parts.prop_map(|(uv_channels, has_tangents, has_colors, seed)| Dress {
        uv_channels,
        has_tangents,
        has_colors,
        seed,
    })
}

impl Dress {
    fn put_on(&self, mut mesh: MeshBuffers) -> MeshBuffers {
        let mut noise = Noise(self.seed);
        let count = mesh.positions.len();
        for (channel, &components) in self.uv_channels.iter().enumerate() {
            let values = (0..count * components as usize).map(|_| noise.share()).collect();
            mesh.uvs[3 * channel] = UvBuffer { components, values };
        }
        if self.has_tangents {
            let across = |normal: &[f32; 3]| {
                let normal = glam::Vec3::from(*normal);
                normal.any_orthonormal_vector().extend(if noise.coin() { 1.0 } else { -1.0 })
            };
            mesh.tangents = mesh.normals.iter().map(across).map(|t| t.to_array()).collect();
        }
        if self.has_colors {
            let mut color = || [0; 4].map(|_| if noise.coin() { 1.0 } else { 0.0 });
            mesh.colors = (0..count).map(|_| color()).collect();
        }
        mesh
    }
}

/// Numbers that look random (xorshift).
struct Noise(u32);

impl Noise {
    fn next(&mut self) -> u32 {
        // Zero would stay zero.
        self.0 |= u32::from(self.0 == 0);
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 17;
        self.0 ^= self.0 << 5;
        self.0
    }

    fn coin(&mut self) -> bool {
        self.next() & 0x100 != 0
    }

    /// From 0 up to 1.
    fn share(&mut self) -> f32 {
        (self.next() >> 8) as f32 / (1 << 24) as f32
    }

    fn unit(&mut self) -> glam::Vec3 {
        let along = [0; 3].map(|_| self.share() - 0.5);
        glam::Vec3::from(along).try_normalize().unwrap_or(glam::Vec3::Z)
    }
}
