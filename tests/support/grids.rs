//! Boxes whose faces are cut into cells that need not match those of the faces beside: T-junctions
//! along every edge.

use std::collections::BTreeMap;

use chamfer::{MeshBuffers, UvBuffer};
use glam::{DMat3, DVec3};

/// Places at which a face can be cut, on each of its sides.
const STEPS: u8 = 8;

/// How a face is cut.
///
/// ```text
///   .---.-------.
///   |   |       |      `across` [2], `along` [1, 2]: the lower row in two cells, the upper one in two
///   .---'---.---.      others
///   |       |   |
///   '-------'---'
/// ```
#[derive(Clone, Debug)]
pub struct Cells {
    /// As bits, one for each step: where rows begin.
    pub across: u8,
    /// The same for the cells of each row; the last one goes for all rows that follow.
    pub along: Vec<u8>,
    /// As bits, of one cell after the other: those cut along the other diagonal.
    pub diagonals: u16,
    /// How often the face is there.
    pub copies: u8,
}

/// A box and its faces, by axis, the lower one first.
#[derive(Clone, Debug)]
pub struct Grid {
    pub low: [f64; 3],
    pub high: [f64; 3],
    pub faces: Vec<Cells>,
}

/// How it is put into a mesh.
#[derive(Clone, Copy, Debug)]
pub struct Layout {
    pub turn: DMat3,
    pub offset: DVec3,
    /// Each coordinate is off by at most so many units in the last place,
    pub most_steps: u8,
    /// by other ones for each of these.
    pub seed: u32,
    /// Whether equal vertices are one.
    pub is_merged: bool,
    /// Whether all faces lie on one place of the texture, so that two may have the same coordinates at
    /// a corner.
    pub is_overlaid: bool,
}

impl Layout {
    /// Each coordinate as near as it can be, and nothing shared.
    pub fn exact(turn: DMat3, offset: DVec3) -> Layout {
        Layout { turn, offset, most_steps: 0, seed: 0, is_merged: false, is_overlaid: false }
    }
}

/// The mesh of all boxes; a submesh each.
pub fn grids(boxes: &[Grid], layout: &Layout) -> MeshBuffers {
    let mut mesh = MeshBuffers::default();
    mesh.uvs[0] = UvBuffer { components: 2, values: Vec::new() };
    for (number, grid) in boxes.iter().enumerate() {
        let first = mesh.indices.len();
        for (face, cells) in grid.faces.iter().enumerate() {
            let from = mesh.uvs[0].values.len();
            for _ in 0..cells.copies {
                add_face(&mut mesh, grid, face, cells, layout);
            }
            let place = if layout.is_overlaid { 0 } else { 6 * number + face };
            let all = mesh.uvs[0].values[from..].iter_mut().step_by(2);
            all.for_each(|u| *u += 1.5 * place as f32);
        }
        mesh.submesh_index_counts.push((mesh.indices.len() - first) as u32);
    }
    if layout.is_merged {
        merge(&mut mesh);
    }
    mesh
}

fn add_face(mesh: &mut MeshBuffers, grid: &Grid, face: usize, cells: &Cells, layout: &Layout) {
    let (axis, is_high) = (face / 2, face % 2 == 1);
    let place = |[u, v]: [f64; 2]| {
        let mut at = [0.0; 3];
        at[axis] = if is_high { grid.high[axis] } else { grid.low[axis] };
        for (k, share) in [(1, u), (2, v)] {
            let along = (axis + k) % 3;
            at[along] = grid.low[along] * (1.0 - share) + grid.high[along] * share;
        }
        layout.turn * DVec3::from(at) + layout.offset
    };
    let [one, two] = [[1.0, 0.0], [0.0, 1.0]].map(|end| place(end) - place([0.0; 2]));
    let normal = if is_high { one.cross(two) } else { two.cross(one) }.normalize();
    let mut number = 0;
    for (row, rows) in cuts(cells.across).windows(2).enumerate() {
        let along = cells.along.get(row).or(cells.along.last()).copied().unwrap_or(0);
        for cell in cuts(along).windows(2) {
            let [u, v] = [cell, rows].map(|ends| [ends[0], ends[1]]);
            let mut corners = [[u[0], v[0]], [u[1], v[0]], [u[1], v[1]], [u[0], v[1]]];
            if !is_high {
                corners.reverse();
            }
            let first = mesh.positions.len() as u32;
            for corner in corners {
                mesh.positions.push(rounded(place(corner), face, layout));
                mesh.normals.push(normal.as_vec3().to_array());
                mesh.uvs[0].values.extend(corner.map(|share| share as f32));
            }
            let is_turned = cells.diagonals >> (number % 16) & 1 == 1;
            let triangles = if is_turned { [1, 2, 3, 1, 3, 0] } else { [0, 1, 2, 0, 2, 3] };
            mesh.indices.extend(triangles.map(|corner| first + corner));
            number += 1;
        }
    }
}

fn cuts(bits: u8) -> Vec<f64> {
    let within = (1..STEPS).filter(|step| bits >> step & 1 == 1);
    let steps = [0].into_iter().chain(within).chain([STEPS]);
    steps.map(|step| f64::from(step) / f64::from(STEPS)).collect()
}

/// In single precision, off by a few steps, which are the same wherever a face has this place.
fn rounded(at: DVec3, face: usize, layout: &Layout) -> [f32; 3] {
    let at = at.as_vec3().to_array();
    let steps = u64::from(layout.most_steps) + 1;
    let mut hash = u64::from(layout.seed) ^ (face as u64) << 32;
    at.map(|along| {
        hash = (hash ^ u64::from(along.to_bits())).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        hash ^= hash >> 29;
        let moved = |next: fn(f32) -> f32| (0..hash % steps).fold(along, |value, _| next(value));
        if hash >> 40 & 1 == 0 { moved(f32::next_up) } else { moved(f32::next_down) }
    })
}

/// Makes vertices that are equal in every stream one.
fn merge(mesh: &mut MeshBuffers) {
    let mut known = BTreeMap::new();
    let uvs = &mesh.uvs[0].values;
    let key = |v: u32| {
        let v = v as usize;
        let [p, n] = [mesh.positions[v], mesh.normals[v]];
        let uv = [uvs[2 * v], uvs[2 * v + 1]];
        let bits = |value: f32| (value + 0.0).to_bits();
        (p.map(bits), n.map(bits), uv.map(bits))
    };
    mesh.indices = mesh.indices.iter().map(|&v| *known.entry(key(v)).or_insert(v)).collect();
}
