//! What the thesis leaves open of 6.4: charts that mirror each other, channels with seams of their
//! own, and corners of four and more faces.

use chamfer::{Chamfered, MeshBuffers, TriangleKind, UvBuffer, shapes};

use crate::{chamfered, triangles, vector};

/// The cube of six squares in an atlas; `mirrored` faces lie in theirs the other way around, so
/// their tangents have the other handedness.
fn cube_of_islands(mirrored: impl Fn(usize) -> bool) -> MeshBuffers {
    let mut cube = shapes::cube(1.0);
    for vertex in 0..24 {
        let face = vertex / 4;
        if mirrored(face) {
            // About the middle of the face's own square.
            let middle = (face % 3) as f32 / 3.0 + 1.0 / 6.0;
            let u = &mut cube.uvs[0].values[2 * vertex];
            *u = 2.0 * middle - *u;
            let [x, y, z, w] = cube.tangents[vertex];
            cube.tangents[vertex] = [-x, -y, -z, -w];
        }
    }
    cube
}

fn uv(mesh: &MeshBuffers, channel: usize, vertex: usize) -> [f64; 2] {
    [0, 1].map(|along| f64::from(mesh.uvs[channel].values[2 * vertex + along]))
}

/// Twice the area in the texture, negative where it is mirrored.
fn uv_area(mesh: &MeshBuffers, channel: usize, triangle: [usize; 3]) -> f64 {
    let [a, b, c] = triangle.map(|vertex| uv(mesh, channel, vertex));
    (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])
}

fn new_triangles(result: &Chamfered) -> Vec<[usize; 3]> {
    [triangles(result, TriangleKind::Edge), triangles(result, TriangleKind::Corner)].concat()
}

/// Three faces of the cube lie mirrored: on each chamfer all three corners agree about the
/// handedness, and it is the one that the chamfer has on the texture.
#[test]
fn tangents_keep_the_handedness_of_the_island_that_the_chamfer_lies_on() {
    let cube = cube_of_islands(|face| face % 2 == 1);
    let sign = |result: &Chamfered, v: usize| f64::from(result.mesh.tangents[v][3]);
    let plain = uv_area(&cube, 0, [0, 1, 2]).signum() * f64::from(cube.tangents[0][3]);
    let result = chamfered(&cube, 0.1);
    let mut seen = [0, 0];
    for triangle in new_triangles(&result) {
        let side = uv_area(&result.mesh, 0, triangle).signum() * plain;
        for vertex in triangle {
            assert_eq!(sign(&result, vertex), side, "{triangle:?}");
        }
        seen[usize::from(side < 0.0)] += 1;
    }
    assert!(seen.iter().all(|&count| count > 0), "{seen:?}: chamfers on islands of both kinds");
}

#[test]
fn tangents_beside_mirrored_islands_are_unit_and_orthogonal() {
    let result = chamfered(&cube_of_islands(|face| face % 2 == 1), 0.1);
    for (&[x, y, z, w], &normal) in result.mesh.tangents.iter().zip(&result.mesh.normals) {
        let along = vector([x, y, z]);
        assert!((along.length() - 1.0).abs() < 1e-3 && w.abs() == 1.0, "{along} {w}");
        assert!(along.dot(vector(normal)).abs() < 1e-3, "{along} on {normal:?}");
    }
}

/// Channel 0 has a seam at every edge, channel 1 runs on over all of them: only the first takes
/// another chart's values.
#[test]
fn a_channel_without_seams_is_left_alone_where_another_has_them() {
    let mut cube = shapes::cube(1.0);
    // Neither folds at an edge nor lays a chamfer more thinly than a face.
    let projected = |p: &[f32; 3]| [9.0 * p[0] - p[2], 3.0 * p[0] - p[1]];
    let values = cube.positions.iter().flat_map(projected).collect();
    cube.uvs[1] = UvBuffer { components: 2, values };
    let result = chamfered(&cube, 0.1);
    assert!(result.mesh.positions.len() > 24, "the first channel takes copies");
    for (vertex, source) in result.vertex_sources.iter().enumerate() {
        assert_eq!(source.owner_channels & !1, 0, "vertex {vertex}");
        let [x, y, z] = result.mesh.positions[vertex].map(f64::from);
        let [u, v] = uv(&result.mesh, 1, vertex);
        assert!((u - (9.0 * x - z)).abs() < 1e-5 && (v - (3.0 * x - y)).abs() < 1e-5);
    }
}

/// Both channels are the same but for their place in the texture, so both take the same owner's
/// values, by the same weights.
#[test]
fn channels_with_the_same_seams_go_together() {
    let mut cube = shapes::cube(1.0);
    let values = cube.uvs[0].values.iter().map(|along| along + 3.0).collect();
    cube.uvs[1] = UvBuffer { components: 2, values };
    let result = chamfered(&cube, 0.1);
    assert!(result.vertex_sources.iter().any(|source| source.owner_channels == 0b11));
    for vertex in 0..result.mesh.positions.len() {
        let [first, second] = [0, 1].map(|channel| uv(&result.mesh, channel, vertex));
        assert!((0..2).all(|k| (second[k] - first[k] - 3.0).abs() < 1e-5), "vertex {vertex}");
    }
}

/// A pyramid whose faces have a square each, so that every edge is a seam.
fn pyramid_of_islands(sides: u32) -> MeshBuffers {
    let mut mesh = shapes::pyramid(sides);
    let count = sides as usize;
    let mut values = vec![0.0; 2 * mesh.positions.len()];
    for side in 0..count {
        for (corner, at) in [[0.1, 0.1], [0.9, 0.1], [0.5, 0.9]].into_iter().enumerate() {
            let vertex = 3 * side + corner;
            values[2 * vertex] = side as f32 + at[0];
            values[2 * vertex + 1] = at[1];
        }
    }
    for vertex in 3 * count..mesh.positions.len() {
        let [x, _, z] = mesh.positions[vertex];
        values[2 * vertex] = x;
        values[2 * vertex + 1] = z - 4.0;
    }
    mesh.uvs[0] = UvBuffer { components: 2, values };
    mesh
}

/// The fill at the apex of four, five and seven faces lies on one of them, with an area, none of it
/// mirrored; from five on it has a vertex in the middle.
#[test]
fn a_fill_of_many_faces_has_an_area_on_one_of_their_charts() {
    for sides in [4, 5, 7] {
        let mesh = pyramid_of_islands(sides);
        let result = chamfered(&mesh, 0.05);
        let place = |v: usize| result.mesh.positions[v];
        let at_apex = |triangle: &[usize; 3]| triangle.iter().all(|&v| place(v)[1] > 0.5);
        let fills: Vec<_> =
            triangles(&result, TriangleKind::Corner).into_iter().filter(at_apex).collect();
        assert_eq!(fills.len(), if sides == 4 { 2 } else { sides as usize });
        let side = uv_area(&mesh, 0, [0, 1, 2]).signum();
        let chart = uv(&result.mesh, 0, fills[0][0])[0].floor();
        for fill in fills {
            assert!(uv_area(&result.mesh, 0, fill) * side > 1e-5, "{sides} sides: {fill:?}");
            for vertex in fill {
                let [u, v] = uv(&result.mesh, 0, vertex);
                assert!(u.floor() == chart && (0.1..0.9001).contains(&v), "{sides}: {u} {v}");
            }
        }
    }
}
