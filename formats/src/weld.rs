//! Vertices that nearly touch: counted, or moved to one place.
//!
//! The core takes vertices for one where their positions are equal to the bit, so welding is moving.
//! A vertex goes to the first one before it that is near enough, and none goes to one that has
//! gone: so no vertex moves farther than the distance, however long a row of near ones is.

use std::collections::HashMap;

use crate::document::Weld;

/// How many steps of single precision rounding may set apart what was one place: some for each
/// transform that an exporter has applied.
const ROUNDING_STEPS: f32 = 8.0;

/// The same as a share of the largest side: text formats are mostly written with six digits.
const TEXT_PRECISION: f32 = 2e-6;

/// Moves vertices onto those that they are to be one with; how many.
pub fn weld(positions: &mut [[f32; 3]], weld: Weld) -> usize {
    let distance = match weld {
        Weld::Equal => return 0,
        Weld::Within(distance) => distance,
        Weld::Auto => rounding(positions),
    };
    let near = near(positions, distance);
    for (vertex, &first) in near.iter().enumerate() {
        positions[vertex] = positions[first as usize];
    }
    (0..).zip(&near).filter(|(vertex, first)| *vertex != **first).count()
}

/// A sentence for the user, if any vertex was moved.
pub fn note(moved: usize) -> Option<String> {
    (moved > 0).then(|| format!("{moved} vertices were welded onto others"))
}

/// How many of the places that triangles use are not equal to another one, but so near to it that
/// only rounding may have set them apart; and how near that is.
pub fn nearly_touching(positions: &[[f32; 3]], indices: &[u32]) -> (usize, f32) {
    let mut used: Vec<[u32; 3]> = indices
        .iter()
        .map(|&index| positions[index as usize].map(|at| (at + 0.0).to_bits()))
        .collect();
    used.sort_unstable();
    used.dedup();
    let places: Vec<[f32; 3]> = used.into_iter().map(|place| place.map(f32::from_bits)).collect();
    let distance = rounding(&places);
    let near = near(&places, distance);
    ((0..).zip(&near).filter(|(vertex, first)| *vertex != **first).count(), distance)
}

/// How far rounding may set vertices apart.
fn rounding(positions: &[[f32; 3]]) -> f32 {
    let finite = || positions.iter().filter(|position| position.iter().all(|at| at.is_finite()));
    let farthest = finite().flatten().fold(0.0f32, |most, at| most.max(at.abs()));
    let side = |axis: usize| {
        let range = finite().fold([f32::INFINITY, f32::NEG_INFINITY], |[low, high], position| {
            [low.min(position[axis]), high.max(position[axis])]
        });
        range[1] - range[0]
    };
    let extent = (0..3).map(side).fold(0.0, f32::max);
    (farthest * f32::EPSILON * ROUNDING_STEPS).max(extent * TEXT_PRECISION)
}

/// `#positions`: the vertex that each is to be one with, which is itself or before it.
fn near(positions: &[[f32; 3]], distance: f32) -> Vec<u32> {
    let mut near: Vec<u32> = (0..positions.len() as u32).collect();
    if distance <= 0.0 || !distance.is_finite() {
        return near;
    }
    // Who stays in which cell of a grid. What is near is in one of the few cells within reach.
    let mut stay: HashMap<[i64; 3], Vec<u32>> = HashMap::new();
    let size = f64::from(distance) * CELL_SIZE;
    let cell = |place: [f64; 3]| place.map(|at| (at / size).floor() as i64);
    for (vertex, &position) in positions.iter().enumerate() {
        let place = position.map(f64::from);
        let [low, high] =
            [-1.0, 1.0].map(|side| cell(place.map(|at| at + side * f64::from(distance))));
        let mut first: Option<u32> = None;
        for cell in cells(low, high) {
            let others = stay.get(&cell).into_iter().flatten().copied();
            let near = others.filter(|&other| {
                squared(position, positions[other as usize]) <= f64::from(distance).powi(2)
            });
            first = near.chain(first).min();
        }
        match first {
            Some(first) => near[vertex] = first,
            None => stay.entry(cell(place)).or_default().push(vertex as u32),
        }
    }
    near
}

/// Cells are so many distances wide: most places reach into one or two only, and those that stay
/// in one cell are few.
const CELL_SIZE: f64 = 4.0;

/// All cells from one corner to the other; at most two on each axis.
fn cells(low: [i64; 3], high: [i64; 3]) -> impl Iterator<Item = [i64; 3]> {
    let axis = move |axis: usize| low[axis]..=high[axis];
    axis(0).flat_map(move |x| axis(1).flat_map(move |y| axis(2).map(move |z| [x, y, z])))
}

fn squared(a: [f32; 3], b: [f32; 3]) -> f64 {
    (0..3).map(|axis| (f64::from(a[axis]) - f64::from(b[axis])).powi(2)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn welded(xs: &[f32], by: Weld) -> Vec<f32> {
        let mut positions: Vec<[f32; 3]> = xs.iter().map(|&x| [x, 1.0, 0.0]).collect();
        weld(&mut positions, by);
        positions.iter().map(|position| position[0]).collect()
    }

    #[test]
    fn vertices_go_to_the_first_that_is_near() {
        assert_eq!(welded(&[0.0, 0.5, 0.1, -0.1], Weld::Within(0.2)), [0.0, 0.5, 0.0, 0.0]);
        assert_eq!(welded(&[0.0, 0.3, 0.15], Weld::Within(0.2)), [0.0, 0.3, 0.0]);
        assert_eq!(welded(&[0.0, 0.1], Weld::Equal), [0.0, 0.1]);
        assert_eq!(welded(&[0.0, 0.1], Weld::Within(0.0)), [0.0, 0.1]);
    }

    /// A row of near ones does not collapse to a point.
    #[test]
    fn nobody_moves_farther_than_the_distance() {
        let row: Vec<f32> = (0..100).map(|at| at as f32 * 0.1).collect();
        let moved = welded(&row, Weld::Within(0.25));
        assert!(row.iter().zip(&moved).all(|(a, b)| (a - b).abs() <= 0.25));
        let distinct: std::collections::BTreeSet<u32> = moved.iter().map(|x| x.to_bits()).collect();
        assert!((30..60).contains(&distinct.len()), "{moved:?}");
    }

    #[test]
    fn rounding_is_told_from_detail() {
        let ulp = f32::EPSILON;
        assert_eq!(welded(&[1.0, 1.0 + ulp, 1.0 - ulp, 1.001], Weld::Auto), [1.0, 1.0, 1.0, 1.001]);
        assert_eq!(welded(&[5e4, 5e4 + 0.0039, 5e4 + 1.0], Weld::Auto), [5e4, 5e4, 5e4 + 1.0]);
    }

    #[test]
    fn only_places_in_use_count() {
        let positions = [[0.0, 0.0, 0.0], [1e-7, 0.0, 0.0], [1.0, 0.0, 0.0], [-0.0, 0.0, 0.0]];
        assert_eq!(nearly_touching(&positions, &[0, 2, 3]).0, 0);
        assert_eq!(nearly_touching(&positions, &[0, 1, 2]).0, 1);
    }

    #[test]
    fn places_at_the_end_of_the_range_are_no_trouble() {
        let mut far = [[f32::MAX; 3], [f32::MIN; 3], [f32::MAX; 3], [0.0; 3]];
        assert_eq!(weld(&mut far, Weld::Within(f32::MIN_POSITIVE)), 1);
    }
}
