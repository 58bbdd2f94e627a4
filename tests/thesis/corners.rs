//! 6.2 and 6.6: where hard edges meet.

use chamfer::{TriangleKind, shapes};

use crate::{assert_at, chamfered, count, pulled, triangles, vector};

const AXES: [[f32; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// Figures 40 to 43: in the middle of three extruding cubes each of three vertices is shared by
/// two faces that touch nowhere else.
#[test]
fn corner_connected_vertices_are_split() {
    let cubes = shapes::extruding_cubes();
    let result = chamfered(&cubes, 0.1);
    for normal in AXES {
        let places = pulled(&cubes, &result, [1.0; 3], normal);
        assert_eq!(places.len(), 2, "one for each of the two faces");
        let apart = vector(places[0]).distance(vector(places[1]));
        assert!((apart - 0.2 * 2.0_f64.sqrt()).abs() < 2e-5, "{apart}: they go opposite ways");
    }
    let one_each = |normal: &[f32; 3]| {
        let is_meant = |v: &usize| cubes.positions[*v] == [1.0; 3] && cubes.normals[*v] == *normal;
        (0..cubes.positions.len()).filter(is_meant).count()
    };
    assert_eq!(AXES.map(|normal| one_each(&normal)), [1; 3]);
}

/// Figure 42, right: the hole between the six faces is filled around its middle.
#[test]
fn six_faces_that_part_leave_a_hexagon_around_the_old_corner() {
    let cubes = shapes::extruding_cubes();
    let result = chamfered(&cubes, 0.1);
    let middle = result.mesh.positions.iter().position(|&p| p == [1.0; 3]);
    let middle = middle.expect("the mean of the six is where they were");
    let fills = triangles(&result, TriangleKind::Corner);
    assert_eq!(fills.iter().filter(|triangle| triangle.contains(&middle)).count(), 6);
}

/// One vertex in the middle, and as many triangles around it as there were edges.
#[test]
fn five_edges_at_a_corner_get_a_vertex_in_the_middle() {
    let pyramid = shapes::pyramid(5);
    let result = chamfered(&pyramid, 0.05);
    assert_eq!(result.mesh.positions.len(), pyramid.positions.len() + 1);
    let middle = pyramid.positions.len();
    let fills = triangles(&result, TriangleKind::Corner);
    assert_eq!(fills.iter().filter(|triangle| triangle.contains(&middle)).count(), 5);
    assert_eq!(fills.len(), 5 + 5, "a triangle at each corner of the base");
    let [x, y, z] = result.mesh.positions[middle];
    assert!(x.abs() < 1e-6 && z.abs() < 1e-6 && (0.9..1.0).contains(&y), "on the axis");
    let normal = vector(result.mesh.normals[middle]);
    assert!(normal.distance(glam::DVec3::Y) < 1e-6, "{normal}: the mean of the five faces");
}

#[test]
fn four_edges_at_a_corner_get_two_triangles_and_three_get_one() {
    for (sides, at_apex) in [(4, 2), (3, 1)] {
        let pyramid = shapes::pyramid(sides);
        let result = chamfered(&pyramid, 0.05);
        assert_eq!(result.mesh.positions.len(), pyramid.positions.len());
        assert_eq!(count(&result, TriangleKind::Corner), at_apex + sides as usize);
    }
}

/// A step in two directions: at the foot of the upper cube a convex edge meets two concave ones.
#[test]
fn a_corner_of_convex_and_concave_edges_is_filled() {
    let saddle = shapes::saddle();
    let result = chamfered(&saddle, 0.1);
    let places = pulled(&saddle, &result, [1.0; 3], [0.0, 1.0, 0.0]);
    assert_eq!(places.len(), 1);
    assert_at(&saddle, places[0], [1.1, 1.0, 1.1]);
    assert_eq!(result.totals.chamfered, result.totals.hard_edges);
}
