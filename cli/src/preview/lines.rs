//! Segments over a tile, as wide everywhere and hidden by what is in front of them.

use glam::{DVec3, Vec3};

use super::Line;
use super::camera::{Camera, Projected};
use super::raster::{Visibility, sample_center, samples_between};

/// Draws segments over what is seen; segment i becomes item `first_item + i`.
///
/// `width` is in samples. A segment on a surface is half hidden by it where the surface rises
/// towards the eye, so it is drawn as if it were one and a half widths nearer.
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
            let bias = camera.bias(point.inverse_depth, 3.0 * self.half_width);
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
