//! Small meshes that random ones were whittled down to, each for what once went wrong on it.

#[path = "support/shaded.rs"]
mod shaded;

use chamfer::check::{Rule, assert_sound, check};
use chamfer::{
    Chamfered, EdgeVerdict, MeshBuffers, Options, Outcome, UvBuffer, Verify, Width, chamfer, shapes,
};
use glam::{DQuat, DVec3};

fn chamfered(mesh: &MeshBuffers, width: Width) -> Chamfered {
    chamfer(&mesh.as_mesh(), &Options::default().with_width(width)).unwrap()
}

/// Two vertices at one position are not exchanged for each other.
#[test]
fn width_zero_keeps_the_vertices_of_a_collapsed_triangle() {
    let mesh = MeshBuffers {
        positions: vec![[0.0; 3], [0.0; 3]],
        normals: vec![[0.0, 1.0, 0.0], [1.0, 0.0, 0.0]],
        indices: vec![0, 0, 1],
        submesh_index_counts: vec![3],
        ..MeshBuffers::default()
    };
    assert_eq!(chamfered(&mesh, Width::Units(0.0)).mesh, mesh);
}

/// The tangent of a strip's owner is the normal of its other side, but for rounding: what is left
/// of it across that normal is noise.
#[test]
fn the_far_side_of_a_seam_on_a_turned_cube_has_a_right_tangent() {
    let mut cube = shapes::cube(1.0);
    let turn = DQuat::from_axis_angle(DVec3::new(0.6, 0.0, 0.8), 0.07);
    let turned =
        |[x, y, z]: [f32; 3]| (turn * DVec3::from([x, y, z].map(f64::from))).as_vec3().to_array();
    for tangent in &mut cube.tangents {
        let [x, y, z, handedness] = *tangent;
        let [x, y, z] = turned([x, y, z]);
        *tangent = [x, y, z, handedness];
    }
    cube.positions.iter_mut().for_each(|position| *position = turned(*position));
    cube.normals.iter_mut().for_each(|normal| *normal = turned(*normal));
    assert_sound("turned cube", &cube.as_mesh(), &chamfered(&cube, Width::Units(0.1)));
}

/// A vertex that is pulled past its triangle reads past the triangle's colours.
#[test]
fn a_colour_read_past_its_triangle_stays_in_range() {
    let mut strip = shapes::aligned_strip();
    strip.positions.iter_mut().for_each(|[_, y, z]| (*y, *z) = (*y * 3.0, *z * 3.0));
    for bright in 0..strip.positions.len() {
        strip.colors = vec![[0.5; 4]; strip.positions.len()];
        strip.colors[bright] = [0.6; 4];
        let result = chamfered(&strip, Width::Units(0.9));
        let findings = check(&strip.as_mesh(), &result, Verify::Fast);
        assert_eq!(findings.count(Rule::Colors), 0, "vertex {bright}: {findings}");
    }
}

/// At 3, 4 and 5 the outline is nearly straight, so the cap's triangle there is a sliver, and its
/// plane mostly rounding. A long pull in that plane leaves the cap.
#[test]
fn a_flat_face_with_a_sliver_stays_flat() {
    let points = [
        [-33.785378, -33.60235, -33.785965],
        [-34.15611, -33.670914, -33.61246],
        [-35.3882, -34.455154, -33.524628],
        [-34.665382, -34.94596, -34.41154],
        [-33.89849, -34.358974, -34.37937],
        [-33.60833, -34.06064, -34.300213],
        [-32.676353, -33.262383, -34.18652],
        [-33.41082, -34.124268, -33.191887],
        [-33.781548, -34.19283, -33.018383],
        [-35.013638, -34.97707, -32.930546],
        [-34.29082, -35.467876, -33.81746],
        [-33.52393, -34.880894, -33.78529],
        [-33.233772, -34.582558, -33.706135],
        [-32.301796, -33.7843, -33.59244],
    ];
    let mut indices = vec![7, 8, 9, 0, 2, 1, 13, 7, 9, 6, 2, 0, 13, 9, 10, 6, 3, 2];
    indices.extend([10, 11, 12, 3, 5, 4, 10, 12, 13, 3, 6, 5]);
    for a in 0..7 {
        let b = (a + 1) % 7;
        indices.extend([a, b, b + 7, a, b + 7, a + 7]);
    }
    let mesh = shaded::shaded(&points, &indices, shaded::FLAT);
    let result = chamfered(&mesh, Width::PercentOfExtent(12.964855));
    assert_sound("prism", &mesh.as_mesh(), &result);
}

/// Below 1e-38 all steps of single precision are of one size, and a cube of 1e-43 has 71 of them.
#[test]
fn a_cube_of_denormal_numbers_has_widths_as_told() {
    let mut cube = shapes::plain_cube(1.0);
    cube.positions.as_flattened_mut().iter_mut().for_each(|along| *along *= 1e-43);
    assert_sound("denormal cube", &cube.as_mesh(), &chamfered(&cube, Width::PercentOfExtent(9.0)));
}

/// So far from the origin, rounding swallows the move of the first vertex: its normal, which is not
/// unit length, stays as it is, and so does what the strip's triangles must face.
#[test]
fn a_move_that_rounding_swallows_leaves_the_normal() {
    let up = [-0.5558825, 0.66470605, -0.49915978];
    let tent = MeshBuffers {
        positions: vec![
            [936336.0, 1796921.0, -1220181.0],
            [936380.0, 1796921.0, -1220230.0],
            [936388.0, 1796975.0, -1220167.0],
            [936388.0, 1796921.0, -1220167.0],
            [936336.0, 1796921.0, -1220181.0],
            [936380.0, 1796921.0, -1220230.0],
        ],
        normals: [vec![[0.640625, 0.765625, 0.703125], up, up], vec![[0.0, -1.0, 0.0]; 3]].concat(),
        indices: vec![2, 1, 0, 3, 4, 5],
        submesh_index_counts: vec![6],
        ..MeshBuffers::default()
    };
    assert_sound("tent", &tent.as_mesh(), &chamfered(&tent, Width::Units(1.6)));
}

/// A triangle that folds onto itself has two sides on one edge, and is no cut through another.
#[test]
fn a_triangle_that_folds_onto_itself_is_what_it_was() {
    let (here, there) = ([0.0; 3], [1.0, 0.0, 0.0]);
    let mesh = MeshBuffers {
        positions: vec![here, here, there],
        normals: vec![[0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.0, 1.0, 0.0]],
        indices: vec![0, 2, 1],
        submesh_index_counts: vec![3],
        ..MeshBuffers::default()
    };
    assert_sound("folded", &mesh.as_mesh(), &chamfered(&mesh, Width::Units(0.1)));
}

/// Past a triangle whose values are nearly as large as numbers go there are none.
#[test]
fn texture_coordinates_read_past_a_triangle_stay_finite() {
    let mut cube = shapes::cube(1.0);
    for (vertex, uv) in cube.uvs[0].values.chunks_exact_mut(2).enumerate() {
        let sign = if vertex % 2 == 0 { 1.0 } else { -1.0 };
        uv.copy_from_slice(&[3e38 * sign, 1e38 * sign]);
    }
    let result = chamfered(&cube, Width::Units(0.3));
    assert!(result.mesh.uvs[0].values.iter().all(|value| value.is_finite()));
    assert_eq!(check(&cube.as_mesh(), &result, Verify::Fast).count(Rule::Finite), 0);
}

/// The same where the vertices go so far along a strip of triangles that the values leave the numbers.
#[test]
fn texture_coordinates_of_a_strip_that_are_read_past_a_triangle_stay_finite() {
    let mut strip = shapes::aligned_strip();
    let values = (0..strip.positions.len()).flat_map(|vertex| {
        let sign = if vertex % 2 == 0 { 1.0 } else { -1.0 };
        [3e38 * sign, 1e38 * sign]
    });
    strip.uvs[0] = UvBuffer { components: 2, values: values.collect() };
    let result = chamfered(&strip, Width::Units(0.9));
    assert!(result.totals.chamfered + result.totals.narrowed > 0);
    assert!(result.mesh.uvs[0].values.iter().all(|value| value.is_finite()));
    assert_eq!(check(&strip.as_mesh(), &result, Verify::Fast).count(Rule::Finite), 0);
}

/// Five triangles on a grid, three of them on one edge, whose chamfers are a few roundings wide.
#[test]
fn a_few_triangles_on_a_grid_stay_as_manifold_as_they_are() {
    let points = [
        [3.0, 1.0, -3.0],
        [0.0, -1.0, -2.0],
        [-1.0, -3.0, -1.0],
        [3.0, 3.0, -2.0],
        [3.0, 1.0, -2.0],
        [-3.0, 2.0, -1.0],
    ];
    let mesh =
        shaded::shaded(&points, &[0, 1, 2, 3, 4, 0, 1, 5, 0, 1, 0, 3, 0, 5, 1], shaded::FLAT);
    for percent in [0.000_116_8, 0.5] {
        let result = chamfered(&mesh, Width::PercentOfExtent(percent));
        let findings = check(&mesh.as_mesh(), &result, Verify::Full);
        assert!(findings.is_sound(), "{percent} %: {findings}");
        let [before, after] = [findings.before, findings.after].map(|f| f.non_manifold_edges);
        assert!(after <= before, "{percent} %: {before} -> {after}");
    }
}

/// Edges that nearly meet in one line would go far along each other: what holds them back is told.
#[test]
fn what_is_far_wider_than_asked_is_not_full() {
    let vertices = [
        ([-2.311, -4.185, -13.959], [-0.529, -0.479, -0.701]),
        ([-2.311, -4.185, -13.959], [-0.528, -0.48, -0.7]),
        ([-2.475, 10.437, -26.48], [-0.941, 0.317, -0.114]),
        ([-1.685, 11.288, -25.012], [-0.772, 0.634, 0.047]),
        ([-1.685, 11.288, -25.012], [-0.548, -0.458, -0.7]),
        ([-1.685, 11.288, -25.012], [-0.544, -0.473, -0.693]),
        ([-21.886, 71.577, -51.294], [-0.522, -0.482, -0.704]),
        ([8.577, 10.418, -32.024], [-0.472, -0.482, -0.738]),
        ([8.577, 10.418, -32.024], [0.513, 0.268, -0.815]),
    ];
    let mesh = MeshBuffers {
        positions: vertices.iter().map(|(position, _)| *position).collect(),
        normals: vertices.iter().map(|(_, normal)| *normal).collect(),
        indices: vec![2, 0, 4, 2, 3, 8, 6, 5, 1, 6, 7, 5],
        submesh_index_counts: vec![12],
        ..MeshBuffers::default()
    };
    let result = chamfered(&mesh, Width::PercentOfExtent(0.5));
    let widest = |verdict: &EdgeVerdict| verdict.widths[0].max(verdict.widths[1]) / result.width;
    let wide: Vec<&EdgeVerdict> = result.verdicts.iter().filter(|v| widest(v) > 1.1).collect();
    assert!(!wide.is_empty(), "{:?}", result.verdicts);
    assert!(wide.iter().all(|v| v.outcome == Outcome::Narrowed), "{wide:?}");
}

/// `T` stands on the edge from `R` to `Q`, so that their triangle is cut from it to `P`, where two others
/// meet: each half of the cut would be a side of a hard edge that the source has not.
#[test]
fn no_edge_lies_on_a_cut_along_an_edge_of_others() {
    let points = [
        [-73.0, -42.0, -75.0], // P
        [-1.0; 3],             // Q
        [-73.0; 3],            // R
        [-65.0, -73.0, -73.0], // S
        [-5.0; 3],             // T
    ];
    let [p, q, r, s, t] = [0, 1, 2, 3, 4];
    let mesh = shaded::shaded(&points, &[r, q, p, p, q, t, s, p, t, t, r, s], shaded::FLAT);
    for width in [0.5, 1.0, 2.0].map(Width::PercentOfExtent) {
        let result = chamfered(&mesh, width);
        assert_sound("a cut along an edge", &mesh.as_mesh(), &result);
        let mut ends = result.verdicts.iter().flat_map(|verdict| verdict.vertices);
        assert!(ends.all(|end| (end as usize) < mesh.positions.len()));
    }
}

/// As above, where no edge on the cut would be hard. Of a cube whose top is drawn out to `Q`, one triangle is
/// shaded otherwise, `T-R-S`: `T` stands on the edge from `R` to `Q`, and the back ends at the line from `T`
/// to `P`, along which the top would be cut.
///
/// ```text
///  R---T---Q
///   \  |  /
///    \ | /
///     \|/
///      P
/// ```
#[test]
fn no_triangle_is_cut_along_a_border_of_another() {
    let corner = |k: usize| [0, 1, 2].map(|axis| if k >> axis & 1 == 1 { 0.5 } else { -0.5 });
    let points: Vec<[f32; 3]> = (0..8).map(corner).chain([[0.5, 0.5, -1.921_875]]).collect();
    let [p, q, r, s, t] = [2, 8, 7, 1, 3];
    let otherwise = [s, t, r];
    let like_each_other =
        [[p, 6, r], [p, r, q], [0, s, 5], [0, 5, 4], [4, 5, r], [4, r, 6], [0, p, t], [0, t, s]];
    let corners = otherwise.iter().chain(like_each_other.as_flattened());
    let mesh = MeshBuffers {
        positions: corners.map(|&point| points[point]).collect(),
        normals: [[[1.0, 0.0, 0.0]; 3].as_slice(), &[[0.0, 0.0, 1.0]; 24]].concat(),
        indices: (0..27).collect(),
        submesh_index_counts: vec![27],
        ..MeshBuffers::default()
    };
    for width in [0.5, 1.0, 2.0].map(Width::PercentOfExtent) {
        assert_sound("a cut along a border", &mesh.as_mesh(), &chamfered(&mesh, width));
    }
}
