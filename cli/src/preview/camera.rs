//! Where the eye stands, and how what it sees is framed.
//!
//! The eye looks at the middle of the box around all that is drawn, from outside of its bounding
//! sphere, so nothing is ever behind it. Framing and zooming shift and scale the picture plane
//! and leave the eye where it is, so a close-up shows the same view.

use glam::{DVec2, DVec3, Vec3};

/// From the model to the eye: a three-quarter view from above that shows the three sides of a
/// box differently wide. Front is +z, up is +y.
pub const TOWARD_EYE: DVec3 = DVec3::new(0.55, 0.45, 0.72);

/// Distance of the eye in radii of the bounding sphere: a mild perspective.
const EYE_DISTANCE: f64 = 4.0;

/// Share of a tile that stays free on each side.
const MARGIN: f64 = 0.07;

/// The view of both tiles of a panel.
pub(super) struct Camera {
    eye: DVec3,
    right: DVec3,
    up: DVec3,
    back: DVec3,
    /// The middle of the tile on the plane at distance 1 before the eye.
    center: DVec2,
    /// Samples per unit of that plane.
    scale: f64,
    /// Samples from the middle of the tile to its side.
    half: f64,
}

/// A point as a tile sees it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Projected {
    /// Samples from the left.
    pub x: f64,
    /// Samples from the top.
    pub y: f64,
    /// 1 / distance along the view: unlike the distance it is linear in x and y.
    pub inverse_depth: f64,
}

impl Camera {
    /// A square view, `size` samples wide, that holds all points; `None` where they have no extent.
    pub fn frame(
        toward_eye: DVec3,
        points: impl Iterator<Item = DVec3> + Clone,
        size: usize,
    ) -> Option<Camera> {
        let (low, high) =
            points.clone().fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), point| {
                (low.min(point), high.max(point))
            });
        let middle = (low + high) / 2.0;
        let radius = points.clone().map(|p| p.distance(middle)).fold(0.0, f64::max);
        if !(radius > 0.0 && radius.is_finite()) {
            return None;
        }
        Camera::looking_at(toward_eye, middle, radius, size).fitted(points)
    }

    /// The same view `factor` times larger around `focus`.
    pub fn zoomed(self, factor: f64, focus: DVec3) -> Camera {
        Camera { center: self.on_plane(focus), scale: self.scale * factor, ..self }
    }

    /// The same view with the eye moved sideways, until a point is straight before it.
    pub fn straight_before(self, point: DVec3) -> Camera {
        let to_point = point - self.eye;
        Camera { eye: point - self.back * to_point.dot(self.back), ..self }
    }

    /// How far a point is from the eye along the view; positive in front of it.
    pub fn depth(&self, point: DVec3) -> f64 {
        (self.eye - point).dot(self.back)
    }

    /// Where a point in front of the eye appears.
    pub fn project(&self, point: DVec3) -> Projected {
        let plane = (self.on_plane(point) - self.center) * self.scale;
        Projected {
            x: self.half + plane.x,
            y: self.half - plane.y,
            inverse_depth: 1.0 / self.depth(point),
        }
    }

    /// The unit vector from what is seen at a sample to the eye.
    pub fn toward_eye(&self, x: f64, y: f64) -> Vec3 {
        let plane = self.center + DVec2::new(x - self.half, self.half - y) / self.scale;
        (self.back - self.right * plane.x - self.up * plane.y).normalize().as_vec3()
    }

    /// How much nearer than `inverse_depth` a point is that lies `samples` sample widths nearer.
    pub fn bias(&self, inverse_depth: f64, samples: f64) -> f64 {
        // One sample is depth / scale wide, and d(1/depth) = d(depth) / depth^2.
        samples / self.scale * inverse_depth
    }

    fn looking_at(toward_eye: DVec3, middle: DVec3, radius: f64, size: usize) -> Camera {
        let back = toward_eye.normalize_or(TOWARD_EYE.normalize());
        // Straight from above or below, up is away from the viewer.
        let right = DVec3::Y.cross(back).try_normalize().unwrap_or(DVec3::X);
        Camera {
            eye: middle + back * radius * EYE_DISTANCE,
            right,
            up: back.cross(right),
            back,
            center: DVec2::ZERO,
            scale: 1.0,
            half: size as f64 / 2.0,
        }
    }

    fn fitted(self, points: impl Iterator<Item = DVec3>) -> Option<Camera> {
        let (low, high) =
            points.fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(low, high), point| {
                let plane = self.on_plane(point);
                (low.min(plane), high.max(plane))
            });
        let extent = (high - low).max_element();
        let scale = 2.0 * self.half * (1.0 - 2.0 * MARGIN) / extent;
        let visible = extent > 0.0 && scale.is_finite();
        visible.then_some(Camera { center: (low + high) / 2.0, scale, ..self })
    }

    fn on_plane(&self, point: DVec3) -> DVec2 {
        let offset = point - self.eye;
        DVec2::new(offset.dot(self.right), offset.dot(self.up)) / self.depth(point)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn box_corners(low: DVec3, high: DVec3) -> Vec<DVec3> {
        (0..8)
            .map(|corner| {
                DVec3::select(
                    glam::BVec3::new(corner & 1 != 0, corner & 2 != 0, corner & 4 != 0),
                    low,
                    high,
                )
            })
            .collect()
    }

    #[test]
    fn all_corners_are_inside_the_tile_and_touch_its_margin() {
        for high in [DVec3::ONE, DVec3::new(100.0, 1.0, 1.0), DVec3::new(1e-6, 3e-6, 0.0)] {
            let corners = box_corners(DVec3::ZERO, high);
            let camera = Camera::frame(TOWARD_EYE, corners.iter().copied(), 100).unwrap();
            let seen: Vec<_> = corners.iter().map(|&corner| camera.project(corner)).collect();
            let coordinates = || seen.iter().flat_map(|p| [p.x, p.y]);
            assert!(coordinates().all(|c| c > 6.9 && c < 93.1), "{high}: {seen:?}");
            assert!(coordinates().any(|c| c < 7.1));
        }
    }

    #[test]
    fn points_without_extent_have_no_view() {
        assert!(Camera::frame(TOWARD_EYE, [].into_iter(), 100).is_none());
        assert!(Camera::frame(TOWARD_EYE, [DVec3::ONE; 3].into_iter(), 100).is_none());
    }

    #[test]
    fn a_zoom_centers_its_focus() {
        let corners = box_corners(DVec3::ZERO, DVec3::ONE);
        let camera = Camera::frame(TOWARD_EYE, corners.iter().copied(), 100)
            .unwrap()
            .zoomed(5.0, corners[7]);
        let seen = camera.project(corners[7]);
        assert!((seen.x - 50.0).abs() < 1e-9 && (seen.y - 50.0).abs() < 1e-9);
    }

    #[test]
    fn straight_before_the_eye_a_point_is_seen_from_the_direction_asked_for() {
        let corners = box_corners(DVec3::ZERO, DVec3::new(9.0, 1.0, 1.0));
        let camera = Camera::frame(DVec3::Z, corners.iter().copied(), 100).unwrap();
        let depth = camera.depth(corners[7]);
        let camera = camera.straight_before(corners[7]).zoomed(5.0, corners[7]);
        assert!(camera.toward_eye(50.0, 50.0).distance(Vec3::Z) < 1e-6);
        assert!((camera.depth(corners[7]) - depth).abs() < 1e-9);
    }

    #[test]
    fn up_is_up() {
        let corners = box_corners(DVec3::ZERO, DVec3::ONE);
        let camera = Camera::frame(TOWARD_EYE, corners.iter().copied(), 100).unwrap();
        assert!(camera.project(DVec3::Y).y < camera.project(DVec3::ZERO).y);
        assert!(camera.project(DVec3::X).x > camera.project(DVec3::ZERO).x);
    }
}
