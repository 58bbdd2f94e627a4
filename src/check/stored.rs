//! Stored values in double precision.

use glam::{DMat3, DVec3};

/// How far a unit vector may be from length 1, and a tangent from a right angle: what importers
/// leave behind that store directions in 10 to 16 bits.
pub(super) const UNIT_TOLERANCE: f64 = 1e-3;

/// A triangle has no area if twice its area is at most this share of its longest side squared:
/// far above the rounding of a cross product in double precision (1e-16), far below the height
/// that single-precision corners give to anything but a line (1e-7).
const NO_AREA: f64 = 1e-10;

/// A stored vector in double precision.
pub(super) fn vector(stored: &[f32; 3]) -> DVec3 {
    DVec3::from(stored.map(f64::from))
}

/// The least height of a triangle.
pub(super) fn height(corners: [DVec3; 3]) -> f64 {
    let longest = (0..3).map(|k| corners[k].distance(corners[(k + 1) % 3])).fold(0.0, f64::max);
    normal_with_area(corners).map_or(0.0, |normal| normal.length() / longest)
}

/// A stretch, column by column. A mirror turns all triangles over, and changes no length and no angle:
/// so it is left out.
pub(super) fn axes(scale: [[f32; 3]; 3]) -> DMat3 {
    let [x, y, z] = scale.map(|axis| vector(&axis));
    let axes = DMat3::from_cols(x, y, z);
    if axes.determinant() < 0.0 { -axes } else { axes }
}

/// How many times as far off a coordinate may be there: sheared, it has something of each axis.
pub(super) fn farthest(to: DMat3) -> f64 {
    let rows = to.transpose();
    [rows.x_axis, rows.y_axis, rows.z_axis]
        .map(|row| row.abs().element_sum())
        .into_iter()
        .fold(0.0, f64::max)
}

/// How normals go along with a mesh that is stretched so: by the cofactors.
pub(super) fn normals_to(to: DMat3) -> DMat3 {
    let [x, y, z] = [to.x_axis, to.y_axis, to.z_axis];
    DMat3::from_cols(y.cross(z), z.cross(x), x.cross(y))
}

/// Whether a vector has length 1, as nearly as importers store it.
pub(super) fn is_unit(vector: DVec3) -> bool {
    (vector.length() - 1.0).abs() <= UNIT_TOLERANCE
}

/// The normal of a triangle, twice its area long; none where that is nothing.
pub(super) fn normal_with_area([a, b, c]: [DVec3; 3]) -> Option<DVec3> {
    let normal = (b - a).cross(c - a);
    let longest =
        [b - a, c - b, a - c].iter().map(|side| side.length_squared()).fold(0.0, f64::max);
    (normal.length() > NO_AREA * longest).then_some(normal)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sheared_a_place_is_off_by_what_all_axes_are() {
        assert_eq!(farthest(axes([[1.0, 0.0, 0.0], [0.0, 4.0, 0.0], [0.0, 0.0, 0.5]])), 4.0);
        assert_eq!(farthest(axes([[1.0, 0.0, 0.0], [-2.0, 1.0, 0.0], [0.5, 0.0, 1.0]])), 3.5);
    }
}
