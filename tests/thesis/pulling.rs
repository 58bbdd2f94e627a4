//! 6.3: vertices on hard edges are pulled apart, inside their own faces.

use chamfer::{Outcome, TriangleKind, shapes};

use crate::prism::prism;
use crate::{assert_at, chamfered, count, pulled, triangles, vector};

const UP: [f32; 3] = [0.0, 1.0, 0.0];
const FRONT: [f32; 3] = [0.0, 0.0, 1.0];

/// Figure 37: 12 edges of two triangles and 8 corners of one are new; no vertex is.
#[test]
fn a_cube_gets_strips_and_corners_from_the_vertices_it_has() {
    let cube = shapes::plain_cube(2.0);
    let result = chamfered(&cube, 0.1);
    assert_eq!((cube.positions.len(), cube.indices.len() / 3), (24, 12));
    assert_eq!((result.mesh.positions.len(), result.mesh.indices.len() / 3), (24, 44));
    assert_eq!(count(&result, TriangleKind::Edge), 24);
    assert_eq!(count(&result, TriangleKind::Corner), 8);
    assert_eq!(result.totals.chamfered, 12);
}

#[test]
fn the_faces_of_a_cube_keep_their_normals_to_the_bit() {
    let cube = shapes::plain_cube(2.0);
    assert_eq!(chamfered(&cube, 0.1).mesh.normals, cube.normals);
}

/// Figures 47 and 48: the faces stay where they are and get smaller.
#[test]
fn a_face_of_a_cube_shrinks_in_its_plane() {
    let cube = shapes::plain_cube(2.0);
    for (position, normal) in chamfered(&cube, 0.1).mesh.positions.iter().zip(&cube.normals) {
        for axis in 0..3 {
            let expected = if normal[axis] != 0.0 { 1.0 } else { 0.9 };
            assert!((position[axis].abs() - expected).abs() < 2e-5, "{position:?} {normal:?}");
        }
    }
}

#[test]
fn a_pulled_edge_is_parallel_to_the_old_one_at_the_width() {
    let cube = shapes::plain_cube(2.0);
    let result = chamfered(&cube, 0.1);
    for verdict in &result.verdicts {
        let [a, b] = verdict.vertices.map(|v| v as usize);
        let [old_a, old_b] = [a, b].map(|v| vector(cube.positions[v]));
        let along = (old_b - old_a).normalize();
        for (new, old) in [(a, old_a), (b, old_b)] {
            let distance = (vector(result.mesh.positions[new]) - old).cross(along).length();
            assert!((distance - 0.1).abs() <= 1e-5 * 2.0, "{distance}");
        }
    }
}

/// Figure 53.
#[test]
fn rim_vertices_of_a_cylinder_slide_down_its_side() {
    let cylinder = shapes::cylinder(24);
    let result = chamfered(&cylinder, 0.05);
    let mut slid = 0;
    for (vertex, &[x, y, z]) in cylinder.positions.iter().enumerate() {
        if cylinder.normals[vertex][1] == 0.0 {
            let expected = if y == 1.0 { 0.95 } else { 0.05 };
            assert_at(&cylinder, result.mesh.positions[vertex], [x, expected, z]);
            slid += 1;
        }
    }
    assert_eq!(slid, 2 * 25, "both rims, with the seam's vertices");
}

#[test]
fn the_side_of_a_cylinder_keeps_its_shading() {
    let cylinder = shapes::cylinder(24);
    let result = chamfered(&cylinder, 0.05);
    assert_eq!(result.mesh.normals[..cylinder.normals.len()], cylinder.normals);
}

/// Across the caps the rim is pulled towards the axis, by a little more than the width: the
/// edges of a polygon of 24 sides meet at 165 degrees.
#[test]
fn the_cap_of_a_cylinder_shrinks_evenly() {
    let cylinder = shapes::cylinder(24);
    let result = chamfered(&cylinder, 0.05);
    let distance = 0.05 / (165.0_f64 / 2.0).to_radians().sin();
    for (vertex, normal) in cylinder.normals.iter().enumerate() {
        if normal[1] == 1.0 {
            let [x, y, z] = result.mesh.positions[vertex];
            assert!((f64::from(x).hypot(f64::from(z)) - (0.5 - distance)).abs() < 1e-5);
            assert_eq!(y, 1.0);
        }
    }
}

/// Figure 54: at B and its like the hard edges run on straight.
#[test]
fn between_aligned_edges_the_pull_is_square_to_them() {
    let strip = shapes::aligned_strip();
    let result = chamfered(&strip, 0.1);
    for x in [1.0, 2.0, 3.0] {
        let top = pulled(&strip, &result, [x, 1.0, 1.0], UP);
        assert_eq!(top.len(), 1);
        assert_at(&strip, top[0], [x, 1.0, 0.9]);
    }
}

/// Figures 56 and 57, with the width of 2 that they have: the top of a prism.
///
/// ```text
///   (-20,20)  (0,20)
///      +--------+
///      |        |
///      |        A-------B-------C        A (0,0): 270 degrees
///      |                         \       B (20,0): straight
///      +--------------------------D      C (40,0): 126.9 degrees
///   (-20,-20)                 (55,-20)
/// ```
fn figure_56() -> chamfer::MeshBuffers {
    let outline = [
        [-20.0, -20.0],
        [55.0, -20.0],
        [40.0, 0.0],
        [20.0, 0.0],
        [0.0, 0.0],
        [0.0, 20.0],
        [-20.0, 20.0],
    ];
    prism(&outline, &[[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5], [0, 5, 6]], 20.0)
}

#[test]
fn pulling_distances_differ_so_that_edges_stay_parallel() {
    let mesh = figure_56();
    let result = chamfered(&mesh, 2.0);
    for (x, expected, distance) in [(0.0, -2.0, 2.83), (20.0, 20.0, 2.0), (40.0, 39.0, 2.24)] {
        let place = pulled(&mesh, &result, [x, 0.0, 20.0], FRONT);
        assert_eq!(place.len(), 1);
        assert_at(&mesh, place[0], [expected, -2.0, 20.0]);
        let moved = vector(place[0]).distance(vector([x, 0.0, 20.0]));
        assert!((moved - distance).abs() < 0.005, "{moved}");
    }
    assert_eq!(result.totals.chamfered, result.totals.hard_edges);
}

/// Figure 55: where the face has more than 180 degrees, the bisector is inverted.
///
/// ```text
///   +---+
///   |   |
///   |   B---+      B is pulled to the lower left, away from the notch
///   | B'    |
///   +-------+
/// ```
#[test]
fn at_a_reflex_corner_the_pull_is_into_the_face() {
    let l = shapes::l_shape();
    let result = chamfered(&l, 0.1);
    let place = pulled(&l, &result, [1.0, 1.0, 1.0], FRONT);
    assert_eq!(place.len(), 1);
    assert_at(&l, place[0], [0.9, 0.9, 1.0]);
}

/// The walls of the notch part too: its concave edge is filled by a strip that rises.
#[test]
fn a_concave_edge_is_chamfered_like_a_convex_one() {
    let l = shapes::l_shape();
    let result = chamfered(&l, 0.1);
    let floor = pulled(&l, &result, [1.0, 1.0, 1.0], UP);
    assert_at(&l, floor[0], [1.1, 1.0, 0.9]);
    assert!(result.verdicts.iter().all(|verdict| verdict.outcome == Outcome::Full));
}

/// The ridge of the block falls from the rim into a smooth plain and ends there.
#[test]
fn a_hard_edge_that_ends_in_a_smooth_area_tapers_to_a_point() {
    let block = shapes::wedge_end();
    let result = chamfered(&block, 0.05);
    let end = [1.0, 1.0, 1.0];
    assert_eq!(pulled(&block, &result, end, UP), [end]);
    let at_end = |triangle: &[usize; 3]| triangle.iter().any(|&v| result.mesh.positions[v] == end);
    let strips = triangles(&result, TriangleKind::Edge);
    assert_eq!(strips.iter().filter(|triangle| at_end(triangle)).count(), 1);
    let ridge = result
        .verdicts
        .iter()
        .find(|verdict| verdict.vertices.iter().any(|&v| block.positions[v as usize] == end));
    let widths = ridge.unwrap().widths;
    assert_eq!(widths.iter().copied().fold(f32::INFINITY, f32::min), 0.0);
    assert!(widths.iter().any(|&width| width > 0.04), "{widths:?}");
}
