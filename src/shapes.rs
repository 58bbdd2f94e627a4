//! Small models made by code, for demonstrations and tests.
//!
//! All have split vertices as an engine holds them, stand upright along y, and are wound so that
//! `cross(b - a, c - a)` points outward. Unless their text says otherwise they are closed, have
//! one submesh and no UVs; shapes with UVs have tangents too.
//!
//! A builder collects faces into a mesh; corners that agree in every stream become one vertex.

mod solids;

use std::collections::HashMap;

use glam::{Vec2, Vec3};

use crate::mesh::{MeshBuffers, UvBuffer};

pub use solids::{
    Touch, aligned_strip, bolt, cube, cube_field, cylinder, extruding_cubes, l_shape, open_box,
    plain_cube, plate, prism, pyramid, saddle, sphere, table, two_cubes_touching, wedge, wedge_end,
};

/// The demonstration models and their names.
pub fn demo_models() -> Vec<(&'static str, MeshBuffers)> {
    vec![
        ("cube", cube(1.0)),
        ("bolt", bolt()),
        ("cylinder", cylinder(24)),
        ("extruding_cubes", extruding_cubes()),
        ("table", table()),
        ("l_shape", l_shape()),
    ]
}

/// One corner of a face: position, normal and UV.
pub(super) type Corner = ([f32; 3], [f32; 3], [f32; 2]);

/// The faces of the unit box, each wound outward: its direction, and its corners by their place
/// (0 low, 1 high) along each axis.
pub(super) const BOX_FACES: [([i32; 3], [[usize; 3]; 4]); 6] = [
    ([1, 0, 0], [[1, 0, 0], [1, 1, 0], [1, 1, 1], [1, 0, 1]]),
    ([-1, 0, 0], [[0, 0, 0], [0, 0, 1], [0, 1, 1], [0, 1, 0]]),
    ([0, 1, 0], [[0, 1, 0], [0, 1, 1], [1, 1, 1], [1, 1, 0]]),
    ([0, -1, 0], [[0, 0, 0], [1, 0, 0], [1, 0, 1], [0, 0, 1]]),
    ([0, 0, 1], [[0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]]),
    ([0, 0, -1], [[0, 0, 0], [0, 1, 0], [1, 1, 0], [1, 0, 0]]),
];

/// The face of [`BOX_FACES`] that looks up.
pub(super) const LID: usize = 2;
/// The face of [`BOX_FACES`] that looks down.
pub(super) const FLOOR: usize = 3;

/// A mesh under construction.
#[derive(Default)]
pub(super) struct Builder {
    mesh: MeshBuffers,
    vertex_of: HashMap<[u32; 8], u32>,
    has_uvs: bool,
}

impl Builder {
    /// A builder that keeps the UVs of its corners in channel 0.
    pub fn with_uvs() -> Builder {
        Builder { has_uvs: true, ..Builder::default() }
    }

    /// Adds a face as a fan around its first corner.
    pub fn face(&mut self, corners: &[Corner]) {
        let vertices: Vec<u32> = corners.iter().map(|&corner| self.vertex(corner)).collect();
        for pair in vertices[1..].windows(2) {
            self.mesh.indices.extend([vertices[0], pair[0], pair[1]]);
        }
    }

    /// Adds a flat face as a fan around its first point, with the UVs of a box projection.
    pub fn polygon(&mut self, points: &[[f32; 3]]) {
        let normal = flat_normal(points);
        let corners: Vec<Corner> =
            points.iter().map(|&point| (point, normal, box_uv(point, normal))).collect();
        self.face(&corners);
    }

    /// Adds the faces of a box between two corners, all but those named by their number.
    pub fn block(&mut self, low: [f32; 3], high: [f32; 3], without: &[usize]) {
        let ends = [low, high];
        for (face, (_, corners)) in BOX_FACES.iter().enumerate() {
            if !without.contains(&face) {
                self.polygon(&corners.map(|at| [0, 1, 2].map(|axis| ends[at[axis]][axis])));
            }
        }
    }

    /// Adds a prism along z over an outline that runs counter-clockwise seen from +z. The outline
    /// must be visible whole from its first point.
    pub fn prism(&mut self, outline: &[[f32; 2]], low: f32, high: f32) {
        let at = |[x, y]: [f32; 2], z: f32| [x, y, z];
        let front: Vec<_> = outline.iter().map(|&point| at(point, high)).collect();
        let mut back: Vec<_> = outline.iter().map(|&point| at(point, low)).collect();
        back[1..].reverse();
        self.polygon(&front);
        self.polygon(&back);
        for (place, &a) in outline.iter().enumerate() {
            let b = outline[(place + 1) % outline.len()];
            self.polygon(&[at(a, low), at(b, low), at(b, high), at(a, high)]);
        }
    }

    /// Lets the next faces share no vertex with those before.
    pub fn next_body(&mut self) {
        self.vertex_of.clear();
    }

    /// Ends the submesh that the faces so far belong to.
    pub fn next_submesh(&mut self) {
        let ended: u32 = self.mesh.submesh_index_counts.iter().sum();
        self.mesh.submesh_index_counts.push(self.mesh.indices.len() as u32 - ended);
    }

    /// The mesh, with tangents where it has UVs.
    pub fn finish(mut self) -> MeshBuffers {
        self.next_submesh();
        if self.has_uvs {
            self.mesh.tangents = tangents(&self.mesh);
        }
        self.mesh
    }

    fn vertex(&mut self, (position, normal, uv): Corner) -> u32 {
        let uv = if self.has_uvs { uv } else { [0.0; 2] };
        let [[x, y, z], [nx, ny, nz]] = [position, normal];
        // Adding zero makes one zero of the two.
        let key = [x, y, z, nx, ny, nz, uv[0], uv[1]].map(|value| (value + 0.0).to_bits());
        let mesh = &mut self.mesh;
        let has_uvs = self.has_uvs;
        *self.vertex_of.entry(key).or_insert_with(|| {
            mesh.positions.push(position);
            mesh.normals.push(normal);
            if has_uvs {
                mesh.uvs[0].components = 2;
                mesh.uvs[0].values.extend(uv);
            }
            mesh.positions.len() as u32 - 1
        })
    }
}

/// The point at an angle (in full turns, counter-clockwise seen from above) around the y axis.
pub(super) fn around(turns: f64, radius: f32, y: f32) -> [f32; 3] {
    // `libm`, not the platform's: the same bytes everywhere.
    let (sine, cosine) = libm::sincos(turns * std::f64::consts::TAU);
    [(sine * f64::from(radius)) as f32, y, (cosine * f64::from(radius)) as f32]
}

/// The unit normal of a flat polygon (Newell's method).
fn flat_normal(points: &[[f32; 3]]) -> [f32; 3] {
    let mut sum = Vec3::ZERO;
    for (place, &point) in points.iter().enumerate() {
        let [a, b] = [point, points[(place + 1) % points.len()]].map(Vec3::from);
        sum += (a - Vec3::from(points[0])).cross(b - Vec3::from(points[0]));
    }
    // Adding zero makes one zero of the two.
    (sum.normalize() + Vec3::ZERO).to_array()
}

/// The two coordinates across the axis that a face looks along, unmirrored.
fn box_uv([x, y, z]: [f32; 3], normal: [f32; 3]) -> [f32; 2] {
    let [nx, ny, nz] = normal.map(f32::abs);
    let sign = |along: f32| along.signum();
    if nx >= ny && nx >= nz {
        [-z * sign(normal[0]), y]
    } else if ny >= nz {
        [x, -z * sign(normal[1])]
    } else {
        [x * sign(normal[2]), y]
    }
}

/// `#vertices by 4`: the direction of growing u, and whether v grows to its left (+1) or right.
fn tangents(mesh: &MeshBuffers) -> Vec<[f32; 4]> {
    let mut along = vec![(Vec3::ZERO, 0.0f32); mesh.positions.len()];
    for triangle in mesh.indices.chunks_exact(3) {
        let (direction, handedness) = triangle_tangent(mesh, triangle);
        for &vertex in triangle {
            along[vertex as usize].0 += direction;
            along[vertex as usize].1 += handedness;
        }
    }
    let finished = |(&(sum, handedness), &normal): (&(Vec3, f32), &[f32; 3])| {
        let normal = Vec3::from(normal);
        let tangent = sum.reject_from_normalized(normal).try_normalize();
        let tangent = tangent.unwrap_or_else(|| normal.any_orthonormal_vector());
        tangent.extend(if handedness < 0.0 { -1.0 } else { 1.0 }).to_array()
    };
    along.iter().zip(&mesh.normals).map(finished).collect()
}

fn triangle_tangent(mesh: &MeshBuffers, triangle: &[u32]) -> (Vec3, f32) {
    let UvBuffer { values, .. } = &mesh.uvs[0];
    let corner = |place: usize| {
        let vertex = triangle[place] as usize;
        (Vec3::from(mesh.positions[vertex]), Vec2::new(values[2 * vertex], values[2 * vertex + 1]))
    };
    let [(a, a_uv), (b, b_uv), (c, c_uv)] = [corner(0), corner(1), corner(2)];
    let (ab, ac) = (b_uv - a_uv, c_uv - a_uv);
    let handedness = ab.perp_dot(ac).signum();
    (((b - a) * ac.y - (c - a) * ab.y) * handedness, handedness)
}

#[cfg(test)]
mod tests;
