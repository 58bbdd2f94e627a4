//! Where on a mesh a point lies: the triangles near it, and the place on each.

use glam::DVec3;

use super::stored::normal_with_area;
use super::surface::Surface;
use crate::bvh::{Aabb, Tree};

/// How far, relative to the extent, a corner may be off the surface that it lies on.
const PLANE_TOLERANCE: f64 = 1e-5;

/// The triangles of a mesh, to be found by place.
pub(super) struct Ground<'a> {
    pub surface: &'a Surface<'a>,
    /// How far off the surface counts as on it.
    pub tolerance: f64,
    tree: Tree,
}

/// A place on a triangle.
#[derive(Clone, Copy)]
pub(super) struct Foot {
    pub triangle: u32,
    /// Of its three corners, of sum 1.
    pub weights: [f64; 3],
}

impl<'a> Ground<'a> {
    pub fn new(surface: &'a Surface<'a>) -> Ground<'a> {
        let around = |triangle| {
            Aabb::around(&surface.triangle(triangle).map(|point| point.as_vec3().to_array()))
        };
        let boxes: Vec<Aabb> = (0..surface.triangle_count()).map(around).collect();
        let tolerance = (PLANE_TOLERANCE * surface.extent()).max(2.0 * surface.rounding());
        Ground { surface, tolerance, tree: Tree::new(&boxes, &[]) }
    }

    /// The nearest place of each triangle that is at most so far away.
    pub fn near(&self, point: DVec3, reach: f64) -> impl Iterator<Item = Foot> {
        let [low, high] = [-reach, reach].map(|by| outward(point, by));
        let near = self.tree.overlapping(Aabb::around(&[low, high]));
        near.filter_map(move |triangle| self.within(triangle, point, reach))
    }

    /// The nearest place of a triangle, if that is at most so far away.
    pub fn within(&self, triangle: u32, point: DVec3, reach: f64) -> Option<Foot> {
        let corners = self.surface.triangle(triangle);
        let weights = nearest_weights(corners, point);
        let distance = at(corners, weights).distance(point);
        (distance <= reach).then_some(Foot { triangle, weights })
    }

    /// The same of triangles that do not face against a way; one without area never does.
    pub fn near_along(
        &self,
        way: Option<DVec3>,
        point: DVec3,
        reach: f64,
    ) -> impl Iterator<Item = Foot> {
        self.near(point, reach).filter(move |foot| {
            let facing = normal_with_area(self.surface.triangle(foot.triangle));
            facing.zip(way).is_none_or(|(facing, way)| facing.dot(way) > 0.0)
        })
    }

    /// The place on the plane of a triangle, be it past its sides, if that is at most so far away;
    /// none without area.
    pub fn on_plane(&self, triangle: u32, point: DVec3, reach: f64) -> Option<Foot> {
        let corners = self.surface.triangle(triangle);
        let weights = plane_weights(corners, point)?;
        (at(corners, weights).distance(point) <= reach).then_some(Foot { triangle, weights })
    }
}

/// A corner of the box around a point, rounded away from it.
fn outward(point: DVec3, by: f64) -> [f32; 3] {
    let along = |along: f64| {
        let rounded = (along + by) as f32;
        if by < 0.0 { rounded.next_down() } else { rounded.next_up() }
    };
    point.to_array().map(along)
}

/// The point of a triangle at some weights of its corners.
pub(super) fn at(corners: [DVec3; 3], weights: [f64; 3]) -> DVec3 {
    (0..3).map(|k| corners[k] * weights[k]).sum()
}

fn plane_weights(corners: [DVec3; 3], point: DVec3) -> Option<[f64; 3]> {
    let normal = normal_with_area(corners)?;
    let of = |k: usize| {
        let [b, c] = [corners[(k + 1) % 3], corners[(k + 2) % 3]];
        (c - b).cross(point - b).dot(normal) / normal.length_squared()
    };
    Some([of(0), of(1), of(2)])
}

/// Those of the nearest place of a closed triangle.
fn nearest_weights(corners: [DVec3; 3], point: DVec3) -> [f64; 3] {
    if let Some(weights) = plane_weights(corners, point).filter(|w| w.iter().all(|&w| w >= 0.0)) {
        return weights;
    }
    let on_side = |k: usize| {
        let [a, b] = [corners[k], corners[(k + 1) % 3]];
        let length = (b - a).length_squared();
        let share =
            if length > 0.0 { ((point - a).dot(b - a) / length).clamp(0.0, 1.0) } else { 0.0 };
        let mut weights = [0.0; 3];
        (weights[k], weights[(k + 1) % 3]) = (1.0 - share, share);
        weights
    };
    let distance = |weights: &[f64; 3]| at(corners, *weights).distance_squared(point);
    let sides = [on_side(0), on_side(1), on_side(2)];
    sides.into_iter().min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap_or([1.0, 0.0, 0.0])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes;

    #[test]
    fn a_place_inside_beside_and_above_a_triangle() {
        let corners = [DVec3::ZERO, DVec3::X, DVec3::Y];
        assert_eq!(nearest_weights(corners, DVec3::new(0.25, 0.25, 3.0)), [0.5, 0.25, 0.25]);
        assert_eq!(nearest_weights(corners, DVec3::new(0.25, -1.0, 0.0)), [0.75, 0.25, 0.0]);
        assert_eq!(nearest_weights(corners, DVec3::new(5.0, -1.0, 0.0)), [0.0, 1.0, 0.0]);
        assert_eq!(nearest_weights([DVec3::ZERO; 3], DVec3::X), [1.0, 0.0, 0.0]);
    }

    #[test]
    fn the_two_triangles_of_a_face_are_near_its_middle() {
        let cube = shapes::plain_cube(2.0);
        let mesh = cube.as_mesh();
        let surface = Surface::new(&mesh);
        let ground = Ground::new(&surface);
        assert_eq!(ground.near(DVec3::Z, 1e-6).count(), 2);
        assert_eq!(ground.near(DVec3::Z * 1.1, 1e-6).count(), 0);
        assert_eq!(ground.near(DVec3::Z * 1.1, 0.2).count(), 2);
        let along = |way| ground.near_along(way, DVec3::Z, 1e-6).count();
        assert_eq!([Some(DVec3::Z), Some(-DVec3::Z), None].map(along), [2, 0, 2]);
    }
}
