//! Foot: a way over a source triangle, in terms of its edges.

use glam::DVec3;

use crate::ids::Corner;
use crate::report::Blend;
use crate::tolerance::{HARDLY_PAST, LEAST_WEIGHT};
use crate::view::View;

/// A way in the plane of a source triangle, in terms of the edges from one of its corners to the
/// next and to the previous one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Foot {
    pub corner: Corner,
    /// Where the way begins: at the corner, but for vertices in the middle of a side.
    pub start: [f64; 2],
    /// The whole way from there.
    pub along: [f64; 2],
}

/// Past so many times a triangle's sides its streams tell nothing, and single precision cannot add
/// the weights up to 1 any more.
pub const MOST_WEIGHT: f64 = 1024.0;

impl Foot {
    /// No way at all.
    pub fn at(corner: Corner) -> Foot {
        Foot { corner, start: [0.0; 2], along: [0.0; 2] }
    }

    /// How many times as far as along the triangle's sides the way goes.
    pub fn reach(&self) -> f64 {
        self.along[0].abs().max(self.along[1].abs())
    }

    /// Whether a share of the way ends within the triangle, or hardly past it.
    pub fn is_within(&self, share: f64) -> bool {
        let [to_next, to_prev] = [0, 1].map(|k| self.start[k] + self.along[k] * share);
        to_next.min(to_prev).min(1.0 - to_next - to_prev) > -HARDLY_PAST
    }

    /// The blend of the triangle's vertices at a share of the way.
    #[inline(always)]
    pub fn blend(&self, view: &View, share: f64) -> Blend {
        let [to_next, to_prev] = [0, 1].map(|k| self.start[k] + self.along[k] * share);
        if to_next.abs() > MOST_WEIGHT || to_prev.abs() > MOST_WEIGHT {
            return Blend::one(view.vertex_at(self.corner).0);
        }
        let corners = [self.corner, self.corner.next(), self.corner.prev()];
        let vertices = corners.map(|corner| view.vertex_at(corner).0);
        Blend::new(vertices, [1.0 - to_next - to_prev, to_next, to_prev])
    }
}

/// From a corner of a triangle to the next one and to the previous one.
pub type Arms = [DVec3; 2];

/// Those of a corner.
#[inline(always)]
pub fn arms(view: &View, corner: Corner) -> Arms {
    let at = view.position_at(corner);
    [view.position_at(corner.next()) - at, view.position_at(corner.prev()) - at]
}

/// The way from a point along a vector, projected onto the plane of a corner's triangle; none
/// where the triangle has no area.
#[inline]
pub fn locate(view: &View, corner: Corner, from: DVec3, vector: DVec3) -> Option<Foot> {
    locate_by(arms(view, corner), corner, from - view.position_at(corner), vector)
}

/// The same where the corner's arms are known, and the way to the point.
#[inline(always)]
pub fn locate_by(arms: Arms, corner: Corner, start: DVec3, vector: DVec3) -> Option<Foot> {
    // Nearly all ways begin at the corner.
    let start = if start == DVec3::ZERO { [0.0; 2] } else { in_edges(arms, start) };
    let along = in_edges(arms, vector);
    let is_finite = |way: [f64; 2]| way[0].is_finite() && way[1].is_finite();
    (is_finite(start) && is_finite(along)).then_some(Foot { corner, start, along })
}

/// A way in the plane of a corner's arms, in terms of these; what is none is not finite.
#[inline(always)]
pub fn in_edges([to_next, to_prev]: Arms, way: DVec3) -> [f64; 2] {
    let normal = to_next.cross(to_prev);
    let square = normal.length_squared();
    [way.cross(to_prev), to_next.cross(way)].map(|part| {
        let weight = part.dot(normal) / square;
        if weight.abs() < LEAST_WEIGHT { 0.0 } else { weight }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ids::Id;
    use crate::shapes;
    use crate::stages::stages_of;

    #[test]
    fn a_foot_blends_the_corners_of_its_triangle() {
        let cube = shapes::plain_cube(1.0);
        let stages = stages_of(&cube, 0.1);
        let blend = Foot { corner: Corner(1), start: [0.0; 2], along: [0.5, 0.25] }
            .blend(&stages.view, 0.5);
        assert_eq!(blend.vertices, [cube.indices[1], cube.indices[2], cube.indices[0]]);
        assert_eq!(blend.weights, [0.625, 0.25, 0.125]);
    }

    #[test]
    fn a_vector_is_projected_onto_the_plane_of_a_triangle() {
        let cube = shapes::plain_cube(1.0);
        let stages = stages_of(&cube, 0.1);
        let corner = Corner(0);
        let [a, b, _] = stages.view.triangle(corner.triangle());
        let normal = stages.faces.normal[corner.triangle()];
        let foot = locate(&stages.view, corner, a, (b - a) * 0.5 + normal).unwrap();
        assert!((foot.along[0] - 0.5).abs() < 1e-12 && foot.along[1].abs() < 1e-12);
    }

    #[test]
    fn far_past_a_sliver_a_vertex_keeps_its_own_values() {
        let cube = shapes::plain_cube(1.0);
        let stages = stages_of(&cube, 0.1);
        let far = Foot { corner: Corner::new(0), start: [0.0; 2], along: [1e7, -1e7] };
        assert_eq!(far.blend(&stages.view, 1.0), Blend::one(stages.view.vertex_at(far.corner).0));
    }
}
