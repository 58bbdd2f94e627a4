//! Scale: the mesh in the space in which widths are measured, and the way back.
//!
//! A box that is stretched to a wall is chamfered as the wall that it is. All geometry is that of
//! the stretched mesh; what moves is mapped back, and what stays is never touched.

use glam::{DMat3, DVec3};

use crate::edges::{Edges, HardEdge};
use crate::error::Error;
use crate::math::unit;
use crate::mesh::{Factors, Held, Mesh};
use crate::options::Options;
use crate::report::Reason;
use crate::view::{Stored, View, wide};

/// A stretch of all three axes that can be undone.
#[derive(Clone, Copy)]
pub struct Scale {
    to: DMat3,
    back: DMat3,
    /// How normals go along.
    normal_to: DMat3,
    normal_back: DMat3,
}

/// A mesh as it came, and as it is measured.
#[derive(Clone, Copy)]
pub struct Space<'a> {
    pub source: &'a View<'a>,
    pub measured: &'a View<'a>,
    /// None where both are one.
    pub scale: Option<Scale>,
}

impl Space<'_> {
    /// The unit normal, where the mesh came from, of what has one where it is measured.
    pub fn normal_back(&self, normal: DVec3) -> DVec3 {
        self.scale.map_or(normal, |scale| unit(scale.normal_back * normal))
    }

    /// Whether the mesh is measured as it is, and all of its hard edges alike.
    pub fn is_plain(&self, edges: &Edges) -> bool {
        let Factors { submeshes, vertices, edges: listed } = self.source.mesh.factors;
        let is_left = |edge: &HardEdge| edge.skipped == Some(Reason::NotSelected);
        let lists_all =
            || listed.iter().all(|listed| listed.factor == 1.0) && !edges.hard.iter().any(is_left);
        let is_unlike = !submeshes.is_empty() || !vertices.is_empty();
        self.scale.is_none() && !is_unlike && (listed.is_empty() || lists_all())
    }

    /// How many times as long an axis is measured at most.
    pub fn largest(&self) -> f64 {
        self.scale.map_or(1.0, |scale| longest_axis(scale.to))
    }
}

/// The geometry of a mesh in the space in which it is measured.
pub struct Measured {
    positions: Vec<[f32; 3]>,
    normals: Vec<[f32; 3]>,
    held: Vec<Held>,
}

impl Scale {
    /// None where the mesh is measured as it is.
    ///
    /// # Errors
    /// [`Error::BadScale`] where it cannot be undone.
    pub fn new(options: &Options) -> Result<Option<Scale>, Error> {
        if options.scale == Options::default().scale {
            return Ok(None);
        }
        let [x, y, z] = options.scale.map(wide);
        let given = DMat3::from_cols(x, y, z);
        // A mirror turns all triangles over, and changes no length and no angle: so it is left out.
        let to = if given.determinant() < 0.0 { -given } else { given };
        let back = to.inverse();
        let is_sound = to.is_finite() && back.is_finite() && flattens_little(to);
        let (normal_to, normal_back) = (back.transpose(), to.transpose());
        if is_sound {
            Ok(Some(Scale { to, back, normal_to, normal_back }))
        } else {
            Err(Error::BadScale)
        }
    }

    /// How what is measured is stored in the mesh that came.
    pub fn stored<'a>(&self, mesh: &Mesh<'a>) -> Stored<'a> {
        let Scale { to, back, normal_to, .. } = *self;
        Stored { positions: mesh.positions, normals: mesh.normals, to, back, normal_to }
    }

    pub fn measured(&self, mesh: &Mesh) -> Measured {
        let place = |at: [f32; 3]| (self.to * wide(at)).as_vec3().to_array();
        let normal = |n: &[f32; 3]| unit(self.normal_to * wide(*n)).as_vec3().to_array();
        let held = |held: &Held| Held {
            from: place(held.from),
            to: place(held.to),
            radius: held.radius * longest_axis(self.to) as f32,
        };
        Measured {
            positions: mesh.positions.iter().copied().map(place).collect(),
            normals: mesh.normals.iter().map(normal).collect(),
            held: mesh.held.iter().map(held).collect(),
        }
    }
}

/// The length of the longest axis.
pub fn longest_axis(to: DMat3) -> f64 {
    [to.x_axis, to.y_axis, to.z_axis].map(DVec3::length).into_iter().fold(0.0, f64::max)
}

/// Whether single precision can tell the flattest direction from nothing.
fn flattens_little(to: DMat3) -> bool {
    to.determinant().abs() > longest_axis(to).powi(3) * LEAST_VOLUME
}

/// A mesh that keeps less than this share of its volume is flat in single precision.
const LEAST_VOLUME: f64 = 1e-6;

impl Measured {
    /// The mesh as it is measured.
    pub fn mesh<'a>(&'a self, mesh: &Mesh<'a>) -> Mesh<'a> {
        Mesh { positions: &self.positions, normals: &self.normals, held: &self.held, ..*mesh }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::area_vector;
    use crate::shapes;
    use crate::view::view;

    /// What is sheared, and as high as ten.
    const SCALE: [[f32; 3]; 3] = [[2.0, 0.0, 0.0], [0.5, 10.0, 0.0], [0.0, 0.0, 1.0]];

    #[test]
    fn normals_stay_upright_on_slanted_faces_there_and_back() {
        let pyramid = shapes::pyramid(4);
        let options = Options::default().with_scale(SCALE);
        let scale = Scale::new(&options).unwrap().unwrap();
        let measured = scale.measured(&pyramid.as_mesh());
        let mesh = measured.mesh(&pyramid.as_mesh());
        let [source, measured] =
            [pyramid.as_mesh(), mesh].map(|mesh| view(&mesh, &options).unwrap());
        let measured = View { stored: Some(scale.stored(&source.mesh)), ..measured };
        let space = Space { source: &source, measured: &measured, scale: Some(scale) };
        for triangle in pyramid.indices.chunks(3) {
            let points = [0, 1, 2].map(|k| wide(mesh.positions[triangle[k] as usize]));
            for (&v, point) in triangle.iter().zip(points) {
                let at = wide(pyramid.positions[v as usize]);
                let there = DVec3::new(2.0 * at.x + 0.5 * at.y, 10.0 * at.y, at.z);
                assert!(point.distance(there) < 1e-6, "{point} is not {there}");
                assert!(space.measured.stored(point).distance(at) < 1e-6);
                let normal = wide(mesh.normals[v as usize]);
                assert!(normal.distance(unit(area_vector(points))) < 1e-6, "{normal}");
                let before = wide(pyramid.normals[v as usize]);
                assert!(space.normal_back(normal).distance(before) < 1e-6);
            }
        }
    }
}
