//! Cuts a polygon into triangles by clipping ears (Meisters 1975).
//!
//! No crate: those that there are leave out corners on straight sides, which opens a closed mesh
//! where another polygon uses them.

use robust::{Coord, orient2d};

/// The triangles of a polygon, as places in it: always two fewer than corners, and every corner
/// in one of them. A polygon that crosses itself is cut as well as it can be.
pub fn triangulate(polygon: &[[f32; 3]]) -> Vec<[usize; 3]> {
    let cuts = polygon.len().saturating_sub(2);
    let mut triangles = Vec::with_capacity(cuts);
    let mut ring = Ring::new(flatten(polygon));
    // Starting at 1 cuts a convex quad as a fan around its first corner, as most programs do.
    let mut tip = 1;
    for left in (1..=cuts).rev() {
        // The last three are a triangle whatever they look like, and told from the first of them.
        tip = if left == 1 { ring.second() } else { ring.next_ear(tip) };
        triangles.push(ring.around(tip));
        ring.cut(tip);
        // Past the corner that has just lost area: cutting on at it would make slivers.
        tip = ring.after[ring.after[tip]];
    }
    triangles
}

/// The polygon seen along its normal (Newell's), the normal pointing to the viewer: the two
/// coordinates that span the most area, exactly as they are.
fn flatten(polygon: &[[f32; 3]]) -> Vec<Coord<f64>> {
    let mut area = [0.0f64; 3];
    for (place, a) in polygon.iter().enumerate() {
        let b = polygon[(place + 1) % polygon.len()];
        for (axis, sum) in area.iter_mut().enumerate() {
            let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
            *sum += (f64::from(a[u]) - f64::from(b[u])) * (f64::from(a[v]) + f64::from(b[v]));
        }
    }
    let largest =
        (0..3).fold(0, |best, axis| if area[axis].abs() > area[best].abs() { axis } else { best });
    let (mut u, mut v) = ((largest + 1) % 3, (largest + 2) % 3);
    if area[largest] < 0.0 {
        std::mem::swap(&mut u, &mut v);
    }
    polygon.iter().map(|point| Coord { x: point[u].into(), y: point[v].into() }).collect()
}

/// The corners that are left of a polygon.
struct Ring {
    points: Vec<Coord<f64>>,
    /// `#corners`: the one on either side, of those that are left.
    before: Vec<usize>,
    after: Vec<usize>,
    /// `#corners`: whether it is left and does not turn left. Only such a one can lie in an ear.
    is_suspect: Vec<bool>,
    /// All corners by `x`, so that those near an ear are found soon.
    by_x: Vec<usize>,
    /// The lowest corner that is left.
    first: usize,
}

impl Ring {
    fn new(points: Vec<Coord<f64>>) -> Ring {
        let count = points.len();
        let mut ring = Ring {
            points,
            before: (0..count).map(|corner| (corner + count - 1) % count).collect(),
            after: (0..count).map(|corner| (corner + 1) % count).collect(),
            is_suspect: Vec::new(),
            by_x: (0..count).collect(),
            first: 0,
        };
        ring.is_suspect = (0..count).map(|corner| ring.turn(corner) <= 0.0).collect();
        ring.by_x.sort_by(|&one, &other| ring.points[one].x.total_cmp(&ring.points[other].x));
        ring
    }

    /// A corner between its neighbours.
    fn around(&self, corner: usize) -> [usize; 3] {
        [self.before[corner], corner, self.after[corner]]
    }

    /// The one that follows on the lowest that is left.
    fn second(&self) -> usize {
        self.after[self.first]
    }

    /// Positive where the path turns left at a corner.
    fn turn(&self, corner: usize) -> f64 {
        turn(&self.points, self.around(corner))
    }

    /// Takes a corner out.
    fn cut(&mut self, corner: usize) {
        let [before, _, after] = self.around(corner);
        (self.after[before], self.before[after]) = (after, before);
        if corner == self.first {
            self.first = after;
        }
        self.is_suspect[corner] = false;
        for neighbour in [before, after] {
            self.is_suspect[neighbour] = self.turn(neighbour) <= 0.0;
        }
    }

    /// The first ear at or after a corner. Where there is none the polygon crosses itself or what
    /// is left of it is a line: then the first corner that is not reflex goes, or any.
    fn next_ear(&self, start: usize) -> usize {
        let others = std::iter::successors(Some(self.after[start]), |&last| Some(self.after[last]));
        let corners = || std::iter::once(start).chain(others.clone().take_while(|&c| c != start));
        let fallback = || corners().find(|&corner| self.turn(corner) >= 0.0);
        corners().find(|&corner| self.is_ear(corner)).or_else(fallback).unwrap_or(start)
    }

    fn is_ear(&self, corner: usize) -> bool {
        let ear = self.around(corner);
        let x = ear.map(|corner| self.points[corner].x);
        let (least, most) = (x[0].min(x[1]).min(x[2]), x[0].max(x[1]).max(x[2]));
        let from = self.by_x.partition_point(|&suspect| self.points[suspect].x < least);
        let near = self.by_x[from..].iter().take_while(|&&at| self.points[at].x <= most);
        let mut suspects = near.filter(|&&suspect| self.is_suspect[suspect]);
        self.turn(corner) > 0.0 && !suspects.any(|&at| is_inside(&self.points, ear, at))
    }
}

/// Positive where the path turns left.
fn turn(points: &[Coord<f64>], [a, b, c]: [usize; 3]) -> f64 {
    orient2d(points[a], points[b], points[c])
}

/// Whether a corner lies in a triangle or on its side, without being one of its corners.
fn is_inside(points: &[Coord<f64>], [a, b, c]: [usize; 3], corner: usize) -> bool {
    let same = |other: usize| points[corner] == points[other];
    if same(a) || same(b) || same(c) {
        return false;
    }
    [[a, b], [b, c], [c, a]].iter().all(|&[from, to]| turn(points, [from, to, corner]) >= 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn flat(points: &[[f32; 2]]) -> Vec<[f32; 3]> {
        points.iter().map(|&[x, y]| [x, y, 0.0]).collect()
    }

    fn area(polygon: &[[f32; 3]], [a, b, c]: [usize; 3]) -> f32 {
        let (a, b, c) = (polygon[a], polygon[b], polygon[c]);
        ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2.0
    }

    #[test]
    fn a_square_is_a_fan_around_its_first_corner() {
        let square = flat(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]);
        assert_eq!(triangulate(&square), [[0, 1, 2], [0, 2, 3]]);
    }

    //  3---------2
    //   \   0   /      an arrowhead: the fan around its first side would leave it
    //    \ / \ /
    //     1   ...
    #[test]
    fn a_concave_polygon_keeps_its_area() {
        let arrow = flat(&[[0.0, 0.0], [2.0, -2.0], [0.0, 3.0], [-2.0, -2.0]]);
        let triangles = triangulate(&arrow);
        assert!(triangles.iter().all(|&triangle| area(&arrow, triangle) > 0.0));
        assert_eq!(triangles.iter().map(|&t| area(&arrow, t)).sum::<f32>(), 6.0);
    }

    #[test]
    fn the_winding_is_kept_from_every_side() {
        let l_shape =
            flat(&[[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]]);
        for turned in [[0, 1, 2], [1, 2, 0], [2, 0, 1], [1, 0, 2], [0, 2, 1], [2, 1, 0]] {
            let polygon: Vec<_> = l_shape.iter().map(|p| turned.map(|axis| p[axis])).collect();
            let triangles = triangulate(&polygon);
            assert_eq!(triangles.len(), 4);
            let areas: Vec<f32> = triangles.iter().map(|&t| area(&l_shape, t)).collect();
            assert!(areas.iter().all(|&area| area >= 0.0), "{areas:?}");
            assert_eq!(areas.iter().sum::<f32>(), 3.0);
        }
    }

    #[test]
    fn corners_on_straight_sides_are_used() {
        let square = flat(&[[0.0, 0.0], [0.5, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]);
        let triangles = triangulate(&square);
        assert_eq!(triangles.len(), 3);
        assert!(triangles.iter().all(|&triangle| area(&square, triangle) > 0.0));
    }

    /// Twenty thousand corners would take seconds if each cut looked at all of them.
    #[test]
    fn a_huge_polygon_is_cut_in_time() {
        let circle = |at: usize, radius: f32| {
            let angle = std::f32::consts::TAU * at as f32 / 20_000.0;
            [radius * angle.cos(), radius * angle.sin()]
        };
        let round: Vec<_> = (0..20_000).map(|at| circle(at, 1.0)).collect();
        let gear: Vec<_> = (0..20_000).map(|at| circle(at, 1.0 + (at % 2) as f32)).collect();
        for polygon in [round, gear] {
            let polygon = flat(&polygon);
            let triangles = triangulate(&polygon);
            assert_eq!(triangles.len(), 19_998);
            assert!(triangles.iter().all(|&triangle| area(&polygon, triangle) >= -1e-6));
        }
    }

    #[test]
    fn points_on_a_line_or_one_point_still_end() {
        assert_eq!(triangulate(&flat(&[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [3.0, 0.0]])).len(), 2);
        assert_eq!(triangulate(&[[1.0; 3]; 5]).len(), 3);
        let bow_tie = flat(&[[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]]);
        assert_eq!(triangulate(&bow_tie).len(), 2);
    }
}
