//! What survives of the surface shows what it showed before.

use std::collections::HashMap;

use chamfer::{Chamfered, Mesh, MeshBuffers, TriangleKind, UvBuffer};
use glam::DVec3;

use crate::charts::{Point, key, uv_at};
use crate::tally::Tally;

/// How far a value may be off at the same point, as a share of its size.
const VALUE: f64 = 1e-5;

/// Places in a triangle that are looked at.
const PLACES: [[f64; 3]; 3] = [[0.7, 0.2, 0.1], [0.1, 0.6, 0.3], [0.25, 0.15, 0.6]];

/// The first UV channel, where all triangles around each corner continue one affine map.
pub fn check(name: &str, before: &Mesh, after: &Chamfered, tally: &mut Tally) {
    if before.uvs[0].components == 0 {
        return;
    }
    let around = around(before);
    for (triangle, source) in after.triangle_sources.iter().enumerate() {
        if source.kind != TriangleKind::Source {
            continue;
        }
        let old = source.index as usize;
        let Some(field) = Field::new(before, old) else { continue };
        let corners = corners(before, old);
        let fits = |vertex: usize| around[vertex].iter().all(|&other| field.holds(before, other));
        if !corners.into_iter().all(fits) {
            continue;
        }
        let new = [0, 1, 2].map(|k| after.mesh.indices[3 * triangle + k] as usize);
        for weights in PLACES {
            let point = (0..3).map(|k| vector(after.mesh.positions[new[k]]) * weights[k]).sum();
            let mesh = after.mesh.as_mesh();
            let value =
                [0, 1].map(|k| (0..3).map(|c| uv_at(mesh.uvs[0], new[c])[k] * weights[c]).sum());
            let off = field.distance(point, value);
            tally.note("3 swims", name, (off > VALUE).then(|| format!("{old} by {off:.1e}")));
        }
    }
}

/// For each source vertex the triangles that use one with its position and UV.
fn around(mesh: &Mesh) -> Vec<Vec<usize>> {
    let place = |v: u32| {
        let uv = uv_at(mesh.uvs[0], v as usize).map(f64::to_bits);
        (key(mesh.positions[v as usize]), uv)
    };
    let mut at: HashMap<_, Vec<usize>> = HashMap::new();
    for (corner, &vertex) in mesh.indices.iter().enumerate() {
        at.entry(place(vertex)).or_default().push(corner / 3);
    }
    (0..mesh.positions.len() as u32)
        .map(|v| at.get(&place(v)).cloned().unwrap_or_default())
        .collect()
}

fn corners(mesh: &Mesh, triangle: usize) -> [usize; 3] {
    [0, 1, 2].map(|k| mesh.indices[3 * triangle + k] as usize)
}

/// A triangle's UVs as an affine map of its plane.
struct Field {
    at: DVec3,
    normal: DVec3,
    arms: [DVec3; 2],
    value: Point,
    along: [Point; 2],
    size: f64,
    reach: f64,
}

impl Field {
    fn new(mesh: &Mesh, triangle: usize) -> Option<Field> {
        let c = corners(mesh, triangle);
        let [a, b, d] = c.map(|v| vector(mesh.positions[v]));
        let [ua, ub, ud] = c.map(|v| uv_at(mesh.uvs[0], v));
        let arms = [b - a, d - a];
        let normal = arms[0].cross(arms[1]);
        let longest = arms[0].length().max(arms[1].length());
        // A sliver's field is mostly rounding.
        (normal.length() > 1e-2 * longest * longest).then(|| Field {
            at: a,
            normal: normal.normalize(),
            arms,
            value: ua,
            along: [[ub[0] - ua[0], ub[1] - ua[1]], [ud[0] - ua[0], ud[1] - ua[1]]],
            size: [ua, ub, ud].iter().flatten().fold(1.0, |m: f64, x| m.max(x.abs())),
            reach: longest,
        })
    }

    fn distance(&self, point: DVec3, value: Point) -> f64 {
        let way = point - self.at;
        let across = self.arms[0].cross(self.arms[1]);
        let s = way.cross(self.arms[1]).dot(across) / across.length_squared();
        let t = self.arms[0].cross(way).dot(across) / across.length_squared();
        let at = [0, 1].map(|k| self.value[k] + s * self.along[0][k] + t * self.along[1][k]);
        (at[0] - value[0]).hypot(at[1] - value[1]) / self.size
    }

    /// Whether another triangle lies in the plane and on the map of this one.
    fn holds(&self, mesh: &Mesh, triangle: usize) -> bool {
        corners(mesh, triangle).into_iter().all(|v| {
            let point = vector(mesh.positions[v]);
            let height = (point - self.at).dot(self.normal).abs();
            height < 1e-5 * self.reach && self.distance(point, uv_at(mesh.uvs[0], v)) < 1e-6
        })
    }
}

/// A mesh whose UVs and colours are affine in the position: no seam anywhere.
pub fn affine(mesh: &Mesh) -> MeshBuffers {
    let mut mesh = mesh.to_buffers();
    let size = mesh.positions.as_flattened().iter().fold(1e-30_f32, |m, x| m.max(x.abs()));
    let place = |p: &[f32; 3]| p.map(|x| x / size);
    let values = mesh.positions.iter().map(place).flat_map(|[x, y, z]| [x + 0.5 * y, z - y]);
    mesh.uvs = Default::default();
    mesh.uvs[0] = UvBuffer { components: 2, values: values.collect() };
    let color = |[x, y, z]: [f32; 3]| [x, y, z, 1.0].map(|c| 0.5 + 0.25 * c);
    mesh.colors = mesh.positions.iter().map(place).map(color).collect();
    mesh.tangents = Vec::new();
    mesh
}

/// In an affine field, every vertex of what survives has the value of its place.
pub fn check_affine(name: &str, after: &Chamfered, size: f32, tally: &mut Tally) {
    for (triangle, source) in after.triangle_sources.iter().enumerate() {
        if source.kind != TriangleKind::Source {
            continue;
        }
        for k in 0..3 {
            let vertex = after.mesh.indices[3 * triangle + k] as usize;
            let [x, y, z] = after.mesh.positions[vertex].map(|x| f64::from(x) / f64::from(size));
            let uv = uv_at(after.mesh.as_mesh().uvs[0], vertex);
            let color = after.mesh.colors[vertex].map(f64::from);
            let off = (uv[0] - x - 0.5 * y).abs().max((uv[1] - z + y).abs());
            let off = off.max((color[0] - 0.5 - 0.25 * x).abs());
            tally.note("3 affine", name, (off > VALUE).then(|| format!("{vertex} by {off:.1e}")));
        }
    }
}

fn vector(value: [f32; 3]) -> DVec3 {
    DVec3::from(value.map(f64::from))
}
