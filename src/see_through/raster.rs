//! How far the eye sees at each sample of a view.

use glam::DVec3;

use super::views::View;
use super::{SceneTriangle, wide};

/// A depth for each sample of a square view.
pub struct Depths {
    /// Samples per side.
    pub size: usize,
    /// `#samples`, row by row: how far behind the scene's middle the nearest front face lies;
    /// infinite where there is none.
    pub values: Vec<f32>,
}

impl Depths {
    /// Draws all triangles that face the eye.
    pub fn of(view: &View, triangles: &[SceneTriangle]) -> Depths {
        let size = view.size;
        let mut depths = Depths { size, values: vec![f32::INFINITY; size * size] };
        for triangle in triangles {
            depths.draw(triangle.map(|corner| view.project(wide(corner))));
        }
        depths
    }

    fn draw(&mut self, [a, b, c]: [DVec3; 3]) {
        let area = (b - a).truncate().perp_dot((c - a).truncate());
        // Not above zero also where a corner is not finite.
        if !(area > 0.0 && area.is_finite()) {
            return;
        }
        let edges = [Line::through(b, c), Line::through(c, a), Line::through(a, b)];
        let depth = Line::blend(&edges, [a.z, b.z, c.z], area);
        let columns = samples([a.x, b.x, c.x], self.size);
        for row in samples([a.y, b.y, c.y], self.size) {
            let y = row as f64 + 0.5;
            let inside = edges.iter().fold(columns.clone(), |span, edge| edge.cut(span, y));
            let row = &mut self.values[row * self.size..][..self.size];
            for (column, value) in inside.clone().zip(&mut row[inside]) {
                *value = value.min(depth.at(column as f64 + 0.5, y) as f32);
            }
        }
    }
}

/// The samples whose middles lie between the least and the largest of three coordinates.
fn samples(values: [f64; 3], size: usize) -> std::ops::Range<usize> {
    let low = values.into_iter().fold(f64::INFINITY, f64::min);
    let high = values.into_iter().fold(f64::NEG_INFINITY, f64::max);
    // Casts saturate.
    let start = ((low - 0.5).ceil().max(0.0) as usize).min(size);
    let end = (((high - 0.5).floor() + 1.0).max(0.0) as usize).min(size);
    start..end.max(start)
}

/// A function of a place on the picture: `x * dx + y * dy + at_origin`.
struct Line {
    dx: f64,
    dy: f64,
    at_origin: f64,
}

impl Line {
    /// Positive to the left of the way from one point to another. The same line backwards gives
    /// the same values but for the sign, bit for bit: no sample falls between two triangles.
    fn through(from: DVec3, to: DVec3) -> Line {
        Line { dx: from.y - to.y, dy: to.x - from.x, at_origin: from.x * to.y - to.x * from.y }
    }

    /// The function that has the three values at the corners that the three edges are opposite to.
    fn blend(edges: &[Line; 3], values: [f64; 3], area: f64) -> Line {
        let sum = |part: fn(&Line) -> f64| {
            (0..3).map(|k| part(&edges[k]) * values[k]).sum::<f64>() / area
        };
        Line { dx: sum(|l| l.dx), dy: sum(|l| l.dy), at_origin: sum(|l| l.at_origin) }
    }

    fn at(&self, x: f64, y: f64) -> f64 {
        x * self.dx + (y * self.dy + self.at_origin)
    }

    /// The part of a row of samples in which the function is not negative.
    fn cut(&self, span: std::ops::Range<usize>, y: f64) -> std::ops::Range<usize> {
        let is_inside = |column: usize| self.at(column as f64 + 0.5, y) >= 0.0;
        let (mut start, mut end) = (span.start, span.end);
        if start >= end {
            return span;
        }
        // Near where the function is zero; exactly where, the function itself decides.
        let zero = -(y * self.dy + self.at_origin) / self.dx - 0.5;
        if self.dx > 0.0 {
            start = (zero.max(0.0) as usize).saturating_sub(1).clamp(start, end);
            while start < end && !is_inside(start) {
                start += 1;
            }
        } else if self.dx < 0.0 {
            end = ((zero.max(0.0) as usize).saturating_add(3)).clamp(start, end);
            while end > start && !is_inside(end - 1) {
                end -= 1;
            }
        } else if !is_inside(start) {
            end = start;
        }
        start..end
    }
}

/// `#samples`: the largest depth within a square of `radius` samples to each side.
pub fn farthest_around(depths: &Depths, radius: usize) -> Vec<f32> {
    let size = depths.size;
    let mut along_rows = vec![0.0; size * size];
    for (row, into) in depths.values.chunks_exact(size).zip(along_rows.chunks_exact_mut(size)) {
        sliding_maximum(row, radius, into);
    }
    transpose(&mut along_rows, size);
    let mut both = vec![0.0; size * size];
    for (row, into) in along_rows.chunks_exact(size).zip(both.chunks_exact_mut(size)) {
        sliding_maximum(row, radius, into);
    }
    transpose(&mut both, size);
    both
}

/// The largest value within `radius` of each place, in time that does not depend on the radius
/// (M. van Herk, "A fast algorithm for local minimum and maximum filters", 1992): each window
/// is the end of one block and the beginning of the next.
fn sliding_maximum(values: &[f32], radius: usize, into: &mut [f32]) {
    let (count, block) = (values.len(), 2 * radius + 1);
    let mut from_start = values.to_vec();
    let mut from_end = values.to_vec();
    for k in 1..count {
        if k % block != 0 {
            from_start[k] = from_start[k].max(from_start[k - 1]);
        }
        let back = count - 1 - k;
        if (back + 1) % block != 0 {
            from_end[back] = from_end[back].max(from_end[back + 1]);
        }
    }
    for (k, largest) in into.iter_mut().enumerate() {
        let (first, last) = (k.saturating_sub(radius), (k + radius).min(count - 1));
        // A window that is cut off at the start of the row may lie within one block.
        *largest = from_start[last];
        if last - first == block - 1 || first % block != 0 {
            *largest = largest.max(from_end[first]);
        }
    }
}

fn transpose(values: &mut [f32], size: usize) {
    for row in 0..size {
        for column in 0..row {
            values.swap(row * size + column, column * size + row);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sliding_maximum_is_that_of_each_window() {
        for (count, radius) in [(1, 0), (7, 0), (20, 1), (20, 3), (20, 9), (5, 40)] {
            let values: Vec<f32> = (0..count).map(|k| (k * 37 % 11) as f32).collect();
            let mut found = vec![0.0; count];
            sliding_maximum(&values, radius, &mut found);
            for k in 0..count {
                let window = &values[k.saturating_sub(radius)..(k + radius + 1).min(count)];
                let expected = window.iter().copied().fold(0.0, f32::max);
                assert_eq!(found[k], expected, "{count} values, radius {radius}, place {k}");
            }
        }
    }
}
