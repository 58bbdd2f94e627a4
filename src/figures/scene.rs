//! Solids seen from a fixed direction, without perspective and without trigonometry.

use glam::{DVec2, DVec3};

use super::drawing::{Drawing, INK, Pen, mixed};
use crate::math::{area_vector, unit};
use crate::mesh::MeshBuffers;
use crate::view::wide;

/// A triangle in space and what it is painted with.
pub struct Facet {
    pub points: [DVec3; 3],
    pub paint: Paint,
}

/// From the front, a little from the right and from above.
pub const FRONT: [f64; 3] = [2.0, 2.2, 4.0];

/// Red, green and blue (0 to 255) in full light.
pub type Paint = [f64; 3];

pub const CLAY: Paint = [226.0, 222.0, 212.0];
pub const STRIP: Paint = [125.0, 175.0, 220.0];
pub const FILL: Paint = [240.0, 186.0, 95.0];
const INSIDE: Paint = [176.0, 171.0, 160.0];

/// A line is drawn in so many pieces, each of which is seen or hidden.
const PIECES: u32 = 32;

/// What lies behind a surface by less than this lies on it.
const ON_SURFACE: f64 = 1e-3;

/// Maps space to the paper: y up, the nearer the greater the depth.
pub struct Camera {
    right: DVec3,
    up: DVec3,
    toward: DVec3,
    middle: DVec3,
    scale: f64,
    at: DVec2,
}

impl Camera {
    /// Looks from a direction at a point, which comes to lie at a place on the paper.
    pub fn new(toward: [f64; 3], middle: [f64; 3], scale: f64, at: [f64; 2]) -> Camera {
        let toward = unit(DVec3::from(toward));
        let right = unit(DVec3::Y.cross(toward));
        let up = toward.cross(right);
        Camera { right, up, toward, middle: middle.into(), scale, at: at.into() }
    }

    pub fn flat(&self, point: DVec3) -> DVec2 {
        let way = point - self.middle;
        self.at + DVec2::new(way.dot(self.right), -way.dot(self.up)) * self.scale
    }

    /// What the camera looks at.
    pub fn middle(&self) -> DVec3 {
        self.middle
    }

    /// Whether a face with this normal shows its front.
    pub fn sees(&self, normal: DVec3) -> bool {
        normal.dot(self.toward) > 0.0
    }

    fn depth(&self, point: DVec3) -> f64 {
        point.dot(self.toward)
    }
}

/// Facets and the camera that sees them.
pub struct Scene {
    pub camera: Camera,
    facets: Vec<Facet>,
}

impl Scene {
    pub fn new(camera: Camera, facets: Vec<Facet>) -> Scene {
        Scene { camera, facets }
    }

    /// A mesh of one colour.
    pub fn of_mesh(camera: Camera, mesh: &MeshBuffers) -> Scene {
        let facets = triangles(mesh).map(|points| Facet { points, paint: CLAY }).collect();
        Scene::new(camera, facets)
    }

    /// A mesh whose faces stand apart: only those that show their fronts.
    pub fn of_fronts(camera: Camera, mesh: &MeshBuffers) -> Scene {
        let mut scene = Scene::of_mesh(camera, mesh);
        scene.facets.retain(|facet| scene.camera.sees(area_vector(facet.points)));
        scene
    }

    /// Paints the facets from back to front, those that show their backs as insides.
    pub fn paint(&self, drawing: &mut Drawing) {
        let mut order: Vec<&Facet> = self.facets.iter().collect();
        let depth = |facet: &Facet| self.camera.depth(facet.points.iter().sum());
        order.sort_by(|one, other| depth(one).total_cmp(&depth(other)));
        for backs in [true, false] {
            for facet in
                order.iter().filter(|facet| self.camera.sees(area_vector(facet.points)) != backs)
            {
                let paint = if backs { INSIDE } else { facet.paint };
                drawing.polygon(
                    &facet.points.map(|point| self.camera.flat(point)),
                    &shaded(facet.points, paint),
                );
            }
        }
    }

    /// Whether no facet lies before a point.
    pub fn shows(&self, point: DVec3) -> bool {
        !self.facets.iter().any(|facet| self.covers(facet.points, point))
    }

    fn covers(&self, points: [DVec3; 3], point: DVec3) -> bool {
        let at = self.camera.flat(point);
        let [a, b, c] = points.map(|corner| self.camera.flat(corner));
        let area = |p: DVec2, q: DVec2, r: DVec2| (q - p).perp_dot(r - p);
        let whole = area(a, b, c);
        if whole == 0.0 {
            return false;
        }
        let weights = [area(at, b, c), area(a, at, c), area(a, b, at)].map(|part| part / whole);
        let depth: f64 = weights
            .iter()
            .zip(points)
            .map(|(weight, corner)| weight * self.camera.depth(corner))
            .sum();
        weights.iter().all(|&weight| weight > 1e-9) && depth > self.camera.depth(point) + ON_SURFACE
    }

    /// The parts of a line that no facet hides.
    pub fn line(&self, drawing: &mut Drawing, [from, to]: [DVec3; 2], pen: Pen) {
        let at = |piece: u32| from + (to - from) * (f64::from(piece) / f64::from(PIECES));
        let shows = |piece: u32| self.shows((at(piece) + at(piece + 1)) / 2.0);
        let mut start = None;
        for piece in 0..=PIECES {
            let is_seen = piece < PIECES && shows(piece);
            match (start, is_seen) {
                (None, true) => start = Some(piece),
                (Some(first), false) => {
                    drawing.line(self.camera.flat(at(first)), self.camera.flat(at(piece)), pen);
                    start = None;
                }
                _ => {}
            }
        }
    }

    /// The visible sides of all facets, each once.
    pub fn outline(&self, drawing: &mut Drawing, pen: Pen) {
        let sides = self.facets.iter().flat_map(|Facet { points: [a, b, c], .. }| {
            [[*a, *b], [*b, *c], [*c, *a]].map(|[from, to]| {
                let (from, to) = (from.to_array(), to.to_array());
                if from < to { [from, to] } else { [to, from] }
            })
        });
        let mut sides: Vec<[[f64; 3]; 2]> = sides.collect();
        sides.sort_by(|one, other| one.partial_cmp(other).unwrap());
        sides.dedup();
        for side in sides {
            self.line(drawing, side.map(DVec3::from), pen);
        }
    }

    /// An arrow that is drawn whole if its beginning shows.
    pub fn arrow(&self, drawing: &mut Drawing, [from, to]: [DVec3; 2], pen: Pen) {
        if self.shows(from) {
            drawing.arrow(self.camera.flat(from), self.camera.flat(to), pen);
        }
    }

    pub fn dot(&self, drawing: &mut Drawing, at: DVec3, radius: f64, fill: &str) {
        if self.shows(at) {
            drawing.dot(self.camera.flat(at), radius, fill);
        }
    }

    pub fn label(&self, drawing: &mut Drawing, at: DVec3, text: &str) {
        if self.shows(at) {
            drawing.label(self.camera.flat(at), INK, text);
        }
    }
}

/// A paint in the light from above and from the side.
fn shaded(points: [DVec3; 3], paint: Paint) -> String {
    let light = unit(DVec3::new(0.35, 1.0, 0.6));
    let brightness = 0.5 + 0.5 * unit(area_vector(points)).dot(light);
    mixed(paint.map(|value| value * 0.72), paint.map(|value| (value * 1.08).min(255.0)), brightness)
}

/// The triangles of a mesh in space.
pub fn triangles(mesh: &MeshBuffers) -> impl Iterator<Item = [DVec3; 3]> + '_ {
    mesh.indices
        .chunks_exact(3)
        .map(|t| [t[0], t[1], t[2]].map(|vertex| wide(mesh.positions[vertex as usize])))
}

/// A mesh with every vertex moved along its normal, so that its faces stand apart.
pub fn exploded(mesh: &MeshBuffers, by: f32) -> MeshBuffers {
    let moved = |(p, n): (&[f32; 3], &[f32; 3])| [0, 1, 2].map(|axis| p[axis] + n[axis] * by);
    MeshBuffers {
        positions: mesh.positions.iter().zip(&mesh.normals).map(moved).collect(),
        ..mesh.clone()
    }
}
