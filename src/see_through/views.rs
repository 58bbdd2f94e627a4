//! From where a scene is looked at: parallel projections from directions all around.

use glam::DVec3;

use super::{SceneTriangle, wide};

/// From the scene to the eye, not yet unit length: the sides, edges and corners of a cube, so that
/// neighbours are some 45 degrees apart. The sides come first.
pub const DIRECTIONS: [[f64; 3]; 26] = [
    [1.0, 0.0, 0.0],
    [-1.0, 0.0, 0.0],
    [0.0, 1.0, 0.0],
    [0.0, -1.0, 0.0],
    [0.0, 0.0, 1.0],
    [0.0, 0.0, -1.0],
    [1.0, 1.0, 1.0],
    [-1.0, 1.0, 1.0],
    [1.0, -1.0, 1.0],
    [-1.0, -1.0, 1.0],
    [1.0, 1.0, -1.0],
    [-1.0, 1.0, -1.0],
    [1.0, -1.0, -1.0],
    [-1.0, -1.0, -1.0],
    [1.0, 1.0, 0.0],
    [-1.0, 1.0, 0.0],
    [1.0, -1.0, 0.0],
    [-1.0, -1.0, 0.0],
    [1.0, 0.0, 1.0],
    [-1.0, 0.0, 1.0],
    [1.0, 0.0, -1.0],
    [-1.0, 0.0, -1.0],
    [0.0, 1.0, 1.0],
    [0.0, -1.0, 1.0],
    [0.0, 1.0, -1.0],
    [0.0, -1.0, -1.0],
];

/// Models stand along the axes: seen exactly along one, half of their faces would be lines. So all
/// directions are turned by this much, towards no axis.
const ASKEW: [f64; 3] = [0.13, 0.29, -0.21];

/// Free around the scene, so that an outline has its outside.
const MARGIN: f64 = 1.02;

/// The sphere around a scene.
pub struct Frame {
    middle: DVec3,
    radius: f64,
}

impl Frame {
    /// None where nothing has an extent.
    pub fn around(triangles: &[SceneTriangle]) -> Option<Frame> {
        let points = || triangles.as_flattened().iter().map(|&p| wide(p)).filter(|p| p.is_finite());
        let start = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        let (low, high) = points().fold(start, |(low, high), p| (low.min(p), high.max(p)));
        let middle = (low + high) / 2.0;
        let radius = points().map(|point| point.distance_squared(middle)).fold(0.0, f64::max);
        let radius = radius.sqrt();
        (radius > 0.0 && radius.is_finite()).then_some(Frame { middle, radius })
    }

    pub fn views(&self, count: usize, size: usize) -> impl Iterator<Item = View> {
        DIRECTIONS.iter().take(count).map(move |&direction| {
            let direction = DVec3::from(direction).normalize();
            let toward_eye = (direction + direction.cross(DVec3::from(ASKEW))).normalize();
            let right = toward_eye.any_orthonormal_vector();
            let sample_size = 2.0 * self.radius * MARGIN / size as f64;
            View {
                middle: self.middle,
                toward_eye,
                samples_right: right / sample_size,
                samples_up: toward_eye.cross(right) / sample_size,
                size,
                sample_size,
            }
        })
    }
}

/// A square picture seen along a direction.
pub struct View {
    middle: DVec3,
    pub toward_eye: DVec3,
    /// To the right on the picture and up; their length is one over that of a sample.
    samples_right: DVec3,
    samples_up: DVec3,
    /// Samples per side.
    pub size: usize,
    /// In scene units.
    pub sample_size: f64,
}

impl View {
    /// Samples from the left, samples from the bottom, and how far behind the middle, in scene
    /// units.
    pub fn project(&self, point: DVec3) -> DVec3 {
        let (from, half) = (point - self.middle, self.size as f64 / 2.0);
        DVec3::new(
            from.dot(self.samples_right) + half,
            from.dot(self.samples_up) + half,
            -from.dot(self.toward_eye),
        )
    }

    /// What is seen at a sample, at a depth.
    pub fn place(&self, column: usize, row: usize, depth: f64) -> DVec3 {
        let half = self.size as f64 / 2.0;
        let along = |place: usize| (place as f64 + 0.5 - half) * self.sample_size.powi(2);
        self.middle + self.samples_right * along(column) + self.samples_up * along(row)
            - self.toward_eye * depth
    }
}
