//! Breadth: how much of a face has to stay between its chamfers.
//!
//! A triangle at a side where its face ends is as broad there as its third corner is far from that
//! side. On the face of a board, whose triangles reach from one long edge to the other, that is the
//! breadth of the board, however it is triangulated; a square that is pressed from all four sides
//! keeps a share of it each way. What an area tells is neither.

use glam::DVec3;

use crate::ids::{Corner, Triangle};
use crate::math::area_vector;
use crate::tolerance::LEAST_LEAN;

use crate::given::Given;

/// What has to stay of a triangle: for each of its sides at which the face ends, the least area
/// for each unit of the side's length, along the old side; zero for the others. Areas are counted
/// along the old area vector. Where the face [`goes_on`] behind, it does not count.
pub fn least(given: &Given, triangle: Triangle, old: [DVec3; 3], share: f64) -> [DVec3; 3] {
    let corners = triangle.corners();
    let whole = share * area_vector(old).length_squared();
    [0, 1, 2].map(|k| {
        let side = old[(k + 1) % 3] - old[k];
        if ends_face(given, corners[k]) {
            side * (whole / side.length_squared())
        } else {
            DVec3::ZERO
        }
    })
}

/// Whether a triangle is still as broad as it has to be, but for what rounding does.
pub fn is_kept(given: &Given, triangle: Triangle, [old, new]: [[DVec3; 3]; 2]) -> bool {
    let whole = area_vector(old);
    let area = whole.dot(area_vector(new));
    let least = given.surface.view.least_breadth * whole.length_squared();
    let sides = |[a, b, c]: [DVec3; 3]| [b - a, c - b, a - c];
    let (all_before, all_after) = (sides(old), sides(new));
    let rounding = || {
        let longest = all_after.iter().map(|side| side.length_squared()).fold(0.0, f64::max).sqrt();
        whole.length() * longest * given.surface.view.resolution
    };
    (0..3).all(|k| {
        let (before, after) = (all_before[k], all_after[k]);
        let (square, asked) = (before.length_squared(), least * before.dot(after));
        area * square >= asked
            || !ends_face(given, triangle.corners()[k])
            || (area + rounding()) * square >= asked
            || goes_on(given, triangle, k, old)
    })
}

/// Whether a face ends at a half-edge: at a chamfer, or at a border.
fn ends_face(given: &Given, side: Corner) -> bool {
    given.chamfers.edges.chamfered_at[side].is_some() || given.surface.topology.twin[side].is_none()
}

/// Whether a face goes on behind the corner that lies across from a side of a triangle: there are
/// more rows inside of it, or its rim leads on that way, to a vertex that does not come back.
pub fn goes_on(given: &Given, triangle: Triangle, side: usize, old: [DVec3; 3]) -> bool {
    let corner = triangle.corners()[(side + 2) % 3];
    let sector = given.chamfers.sectors.sector_of[corner];
    if sector.is_none() {
        return given.deep[given.surface.topology.cluster_at[corner]];
    }
    let inward = area_vector(old).cross(old[(side + 1) % 3] - old[side]);
    let leads =
        |way: DVec3, along: DVec3| way.dot(along) > LEAST_LEAN * way.length() * along.length();
    let fan = &given.chamfers.sectors.fans[sector];
    [fan.first.next(), fan.last.prev()].into_iter().any(|along_rim| {
        let way =
            given.surface.view.position_at(along_rim) - given.surface.view.position_at(corner);
        let moves = given.chamfers.sectors.sector_of[along_rim];
        let comes_back = moves.is_some() && leads(given.offsets[moves].vector, -inward);
        leads(way, inward) && !comes_back
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::given::tests::given_of;
    use crate::mesh::MeshBuffers;
    use crate::options::{Options, Width};
    use crate::shapes;
    use crate::stages::{split, stages_with};

    /// The faces of an upright box: how much of each stays along each of its sides, as a share.
    fn shares_kept(mesh: &MeshBuffers, options: &Options) -> Vec<f64> {
        let stages = stages_with(mesh, options);
        let placement = stages.placement();
        let kept = |face: DVec3, axis: DVec3| {
            let on_face = |t: &Triangle| stages.faces.normal[*t].dot(face) > 0.9;
            let corners = || stages.view.triangles().filter(on_face).flat_map(|t| t.corners());
            let old = extent(corners().map(|corner| stages.view.position_at(corner).dot(axis)));
            let new = extent(corners().map(|corner| placement.position_at(corner).dot(axis)));
            new / old
        };
        let faces = DVec3::AXES.into_iter().flat_map(|axis| [axis, -axis]);
        faces
            .flat_map(|face| {
                let along = DVec3::AXES.into_iter().filter(move |axis| axis.dot(face) == 0.0);
                along.map(move |axis| kept(face, axis)).collect::<Vec<_>>()
            })
            .collect()
    }

    fn extent(values: impl Iterator<Item = f64>) -> f64 {
        let ends = |[low, high]: [f64; 2], value: f64| [low.min(value), high.max(value)];
        let [low, high] = values.fold([f64::INFINITY, f64::NEG_INFINITY], ends);
        high - low
    }

    fn asking(width: f32, least_breadth: f32) -> Options {
        Options { width: Width::Units(width), least_breadth, ..Options::default() }
    }

    #[track_caller]
    fn assert_least(shares: &[f64], expected: f64) {
        let least = shares.iter().copied().fold(1.0, f64::min);
        assert!((expected..expected * 1.02 + 0.001).contains(&least), "{shares:?}");
    }

    // .---------------.     a side of a board, pressed from above and below: a fifth of its area,
    // | . . . . . . . |     as its length hardly changes
    // '---------------'
    #[test]
    fn a_board_keeps_a_fifth_of_its_thickness() {
        assert_least(&shares_kept(&shapes::plate(), &asking(0.5, 0.2)), 0.2);
    }

    // .-------.     pressed from all four sides: a fifth each way, a twenty-fifth of the area
    // |   .   |
    // '-------'
    #[test]
    fn a_square_keeps_a_fifth_each_way() {
        let shares = shares_kept(&shapes::plain_cube(1.0), &asking(9.0, 0.2));
        assert!(shares.iter().all(|share| (0.2..0.21).contains(share)), "{shares:?}");
    }

    #[test]
    fn as_much_stays_as_is_asked_for() {
        let cube = shapes::plain_cube(1.0);
        assert_least(&shares_kept(&cube, &asking(9.0, 0.6)), 0.6);
        assert_least(&shares_kept(&cube, &asking(9.0, 1.0)), 1.0);
        // A fiftieth of the area, whatever is asked for: else triangles become needles.
        assert_least(&shares_kept(&cube, &asking(9.0, 0.0)), 0.02_f64.sqrt());
    }

    /// A box of 2 by 2 by 2 under a lid of so many cells each way, smooth as its walls are.
    fn box_under_grid(cells: u32) -> MeshBuffers {
        let top = |x: u32, z: u32| x * (cells + 1) + z;
        let at = |step: u32| 2.0 * step as f32 / cells as f32;
        let places = (0..=cells).flat_map(|x| (0..=cells).map(move |z| (x, z)));
        let mut points: Vec<[f32; 3]> = places.map(|(x, z)| [at(x), 2.0, at(z)]).collect();
        let bottom = points.len() as u32;
        points.extend([[0.0; 3], [0.0, 0.0, 2.0], [2.0, 0.0, 2.0], [2.0, 0.0, 0.0]]);
        let mut indices = vec![bottom, bottom + 3, bottom + 2, bottom, bottom + 2, bottom + 1];
        for (x, z) in (0..cells).flat_map(|x| (0..cells).map(move |z| (x, z))) {
            let [a, b, c, d] = [top(x, z), top(x, z + 1), top(x + 1, z + 1), top(x + 1, z)];
            indices.extend([a, b, c, a, c, d]);
        }
        let rim = |side: u32, step: u32| match side {
            0 => top(0, step),
            1 => top(step, cells),
            2 => top(cells, cells - step),
            _ => top(cells - step, 0),
        };
        for side in 0..4 {
            let (from, to) = (bottom + side, bottom + (side + 1) % 4);
            for step in 0..cells {
                indices.extend([rim(side, step + 1), rim(side, step), from]);
            }
            indices.extend([rim(side, cells), from, to]);
        }
        split(&points, &indices)
    }

    /// How far the lid's rim is pulled at a width that is more than there is room for.
    fn pulled(cells: u32) -> f64 {
        let mesh = box_under_grid(cells);
        let options = Options { least_breadth: 0.2, ..asking(1.9, 0.2) };
        let stages = stages_with(&mesh, &options);
        let placement = stages.placement();
        let lid = stages.view.triangles().filter(|&t| stages.faces.normal[t].y > 0.9);
        let depth = |corner: Corner| placement.position_at(corner).x.min(9.0);
        lid.flat_map(|t| t.corners()).map(depth).fold(9.0, f64::min)
    }

    // .---.---.     the face ends on both sides of the row of vertices in its middle: a fifth of
    // |---+---|     what lies between it and each side stays, so a fifth of the whole
    // '---'---'
    #[test]
    fn two_rows_keep_a_fifth_each() {
        assert!((0.75..=0.8).contains(&pulled(2)), "{}", pulled(2));
    }

    // .-.-.-.-.     here it goes on behind the first row, which may be given away: the rest is
    // |-+-+-+-|     breadth enough
    // |-+-+-+-|
    #[test]
    fn the_first_of_several_rows_may_be_given_away() {
        assert!((0.41..0.5).contains(&pulled(4)), "{}", pulled(4));
    }

    #[test]
    fn a_triangle_below_its_breadth_is_not_kept() {
        let cube = shapes::plain_cube(1.0);
        let stages = stages_with(&cube, &asking(0.1, 0.2));
        let old = stages.view.triangle(Triangle(0));
        let middle = (old[0] + old[1] + old[2]) / 3.0;
        let at = |share: f64| old.map(|point| middle + (point - middle) * share);
        assert!(is_kept(&given_of(&stages), Triangle(0), [old, at(0.21)]));
        assert!(!is_kept(&given_of(&stages), Triangle(0), [old, at(0.19)]));
    }
}
