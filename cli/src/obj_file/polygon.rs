//! Cuts a polygon into triangles by clipping ears (Meisters 1975).
//!
//! No crate: those that there are leave out corners on straight sides, which opens a closed mesh
//! where another polygon uses them.

use robust::{Coord, orient2d};

/// The triangles of a polygon, as places in it: always two fewer than corners, and every corner
/// in one of them. A polygon that crosses itself is cut as well as it can be.
pub fn triangulate(polygon: &[[f32; 3]]) -> Vec<[usize; 3]> {
    let points = flatten(polygon);
    let mut ring: Vec<usize> = (0..polygon.len()).collect();
    let mut triangles = Vec::with_capacity(polygon.len().saturating_sub(2));
    // Starting at 1 cuts a convex quad as a fan around its first corner, as most programs do.
    let mut tip = 1;
    while ring.len() > 3 {
        tip = next_ear(&points, &ring, tip);
        triangles.push(around(&ring, tip));
        ring.remove(tip);
        // Past the corner that has just lost area: cutting on at it would make slivers.
        tip = (tip + 1) % ring.len();
    }
    if let [a, b, c] = ring[..] {
        triangles.push([a, b, c]);
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

/// The corner at a place of the ring between its neighbours.
fn around(ring: &[usize], place: usize) -> [usize; 3] {
    let before = (place + ring.len() - 1) % ring.len();
    [ring[before], ring[place], ring[(place + 1) % ring.len()]]
}

/// The first ear at or after `start`. Where there is none the polygon crosses itself or what is
/// left of it is a line: then the first corner that is not reflex goes, or any.
fn next_ear(points: &[Coord<f64>], ring: &[usize], start: usize) -> usize {
    let places = || (start..ring.len()).chain(0..start);
    let turn = |place| turn(points, around(ring, place));
    // Only a corner that is not convex can lie in an ear.
    let suspects: Vec<usize> =
        (0..ring.len()).filter(|&p| turn(p) <= 0.0).map(|place| ring[place]).collect();
    let is_ear = |&place: &usize| {
        let ear = around(ring, place);
        turn(place) > 0.0 && !suspects.iter().any(|&corner| is_inside(points, ear, corner))
    };
    let fallback = || places().find(|&place| turn(place) >= 0.0);
    places().find(is_ear).or_else(fallback).unwrap_or(start)
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

    #[test]
    fn points_on_a_line_or_one_point_still_end() {
        assert_eq!(triangulate(&flat(&[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [3.0, 0.0]])).len(), 2);
        assert_eq!(triangulate(&[[1.0; 3]; 5]).len(), 3);
        let bow_tie = flat(&[[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]]);
        assert_eq!(triangulate(&bow_tie).len(), 2);
    }
}
