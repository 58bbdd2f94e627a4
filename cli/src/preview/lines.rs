//! Segments over a tile: equally wide everywhere, and hidden by what is in front of them.

use glam::{DVec3, Vec3};

use super::Line;
use super::camera::{Camera, Projected};
use super::raster::{Visibility, sample_center, samples_between};

/// How much nearer than it is a segment is drawn, in widths of it: where a surface rises towards
/// the eye, it would bury one side of the segments on it.
const LIFT: f64 = 1.5;

/// Draws segments, `width` samples wide, over what is seen; segment i becomes item
/// `first_item + i`.
pub(super) fn draw(
    seen: &mut Visibility,
    camera: &Camera,
    lines: &[Line],
    width: f64,
    first_item: u32,
) {
    for (item, line) in (first_item..).zip(lines) {
        let ends = line.ends.map(|end| Vec3::from(end).as_dvec3());
        if ends.iter().all(|&end| is_visible(camera, end)) {
            let [from, to] = ends.map(|end| camera.project(end));
            Stroke { from, to, half_width: width / 2.0 }.draw(seen, camera, item);
        }
    }
}

/// Whether a point has a place in the picture: it is finite and in front of the eye.
fn is_visible(camera: &Camera, point: DVec3) -> bool {
    point.is_finite() && camera.depth(point) > 0.0
}

struct Stroke {
    from: Projected,
    to: Projected,
    half_width: f64,
}

impl Stroke {
    /// Steps along the longer axis of the segment and fills across it.
    fn draw(&self, seen: &mut Visibility, camera: &Camera, item: u32) {
        let (dx, dy) = (self.to.x - self.from.x, self.to.y - self.from.y);
        let length = (dx * dx + dy * dy).sqrt();
        if !(length > 0.0 && length.is_finite()) {
            return;
        }
        let steep = dy.abs() > dx.abs();
        let [start, end] = [self.from, self.to].map(|p| if steep { p.y } else { p.x });
        let run = end - start;
        let reach = self.half_width * run.abs() / length;
        let across = self.half_width * length / run.abs();
        for along in samples_between(start.min(end) - reach, start.max(end) + reach, seen.size) {
            let t = (sample_center(along, 0).0 - start) / run;
            let point = self.at(t);
            let middle = if steep { point.x } else { point.y };
            let bias = camera.bias(point.inverse_depth, LIFT * 2.0 * self.half_width);
            for side in samples_between(middle - across, middle + across, seen.size) {
                let (column, row) = if steep { (side, along) } else { (along, side) };
                seen.offer(column, row, point.inverse_depth, bias, item);
            }
        }
    }

    /// The point a share `t` along; beyond the ends at the depth of the end.
    fn at(&self, t: f64) -> Projected {
        let mix = |a: f64, b: f64, t: f64| a + (b - a) * t;
        Projected {
            x: mix(self.from.x, self.to.x, t),
            y: mix(self.from.y, self.to.y, t),
            inverse_depth: mix(self.from.inverse_depth, self.to.inverse_depth, t.clamp(0.0, 1.0)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::camera::TOWARD_EYE;
    use super::super::raster::{NOTHING, ScreenTriangle};
    use super::*;

    const SIZE: usize = 40;

    /// A view of the unit sphere's corners, and its tile with a wall through the origin that
    /// faces the eye.
    fn wall() -> (Camera, Visibility) {
        let corners = [DVec3::NEG_ONE, DVec3::ONE];
        let camera = Camera::frame(TOWARD_EYE, corners.into_iter(), SIZE).unwrap();
        let inverse_depth = camera.project(DVec3::ZERO).inverse_depth;
        let corner = |x, y| Projected { x, y, inverse_depth };
        let whole = [corner(0.0, 0.0), corner(0.0, 100.0), corner(100.0, 0.0)];
        let mut seen = Visibility::new(SIZE);
        seen.draw(&ScreenTriangle::new(whole).unwrap(), 0);
        (camera, seen)
    }

    fn count(ends: [[f32; 3]; 2]) -> usize {
        let (camera, mut seen) = wall();
        draw(&mut seen, &camera, &[Line { ends, color: [0; 3] }], 2.0, 1);
        assert!(!seen.items.contains(&NOTHING));
        seen.items.iter().filter(|&&item| item == 1).count()
    }

    #[test]
    fn a_line_on_a_surface_or_before_it_is_seen() {
        assert!(count([[0.0, -0.3, 0.0], [0.0, 0.3, 0.0]]) > 10);
        assert!(count([[0.5, 0.5, 0.5], [0.5, 0.9, 0.5]]) > 10);
    }

    #[test]
    fn a_line_behind_a_surface_is_hidden() {
        assert_eq!(count([[-0.5, -0.5, -0.5], [-0.5, -0.9, -0.5]]), 0);
    }

    #[test]
    fn a_line_without_a_place_in_the_picture_is_left_out() {
        assert_eq!(count([[0.5; 3]; 2]), 0);
        assert_eq!(count([[0.5; 3], [f32::NAN; 3]]), 0);
        assert_eq!(count([[0.5; 3], [1e30; 3]]), 0);
    }
}
