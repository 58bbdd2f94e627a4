//! A mesh, to be walked on.

use std::collections::HashMap;

use chamfer::Mesh;
use glam::DVec3;

/// Vertex normals that differ by less than a degree are those of a soft edge.
const SOFT_COSINE: f64 = 0.9998;

/// A mesh, to be walked on.
pub struct Ground<'a> {
    pub mesh: &'a Mesh<'a>,
    /// `#vertices`: the first vertex at the same position.
    pub place: Vec<usize>,
    pub points: Vec<DVec3>,
    /// The corners at which the half-edges between two places begin.
    pub half_edges: HashMap<[usize; 2], Vec<usize>>,
}

impl<'a> Ground<'a> {
    pub fn new(mesh: &'a Mesh<'a>) -> Ground<'a> {
        let mut first = HashMap::new();
        let bits = |at: &[f32; 3]| at.map(|part| (part + 0.0).to_bits());
        let places = mesh.positions.iter().enumerate();
        let place: Vec<usize> =
            places.map(|(vertex, at)| *first.entry(bits(at)).or_insert(vertex)).collect();
        let points = mesh.positions.iter().map(|at| DVec3::from(at.map(f64::from))).collect();
        let mut ground = Ground { mesh, place, points, half_edges: HashMap::new() };
        for corner in 0..mesh.indices.len() {
            let ends = [corner, next(corner)].map(|corner| ground.place[ground.vertex(corner)]);
            ground.half_edges.entry(ends).or_default().push(corner);
        }
        ground
    }

    pub fn vertex(&self, corner: usize) -> usize {
        self.mesh.indices[corner] as usize
    }

    pub fn place_at(&self, corner: usize) -> usize {
        self.place[self.vertex(corner)]
    }

    pub fn point(&self, corner: usize) -> DVec3 {
        self.points[self.vertex(corner)]
    }

    pub fn face_normal(&self, corner: usize) -> DVec3 {
        let [a, b, c] = [corner, next(corner), next(next(corner))].map(|k| self.point(k));
        (b - a).cross(c - a).normalize_or_zero()
    }

    /// The half-edge on the other side of a soft edge.
    pub fn across(&self, corner: usize) -> Option<usize> {
        let normal = |corner| DVec3::from(self.mesh.normals[self.vertex(corner)].map(f64::from));
        let agree = |one, other| normal(one).dot(normal(other)) > SOFT_COSINE;
        let ends = [next(corner), corner].map(|corner| self.place[self.vertex(corner)]);
        let mut others = self.half_edges.get(&ends)?.iter().copied();
        others.find(|&other| agree(next(corner), other) && agree(corner, next(other)))
    }
}

pub fn next(corner: usize) -> usize {
    if corner % 3 == 2 { corner - 2 } else { corner + 1 }
}

pub fn previous(corner: usize) -> usize {
    next(next(corner))
}
