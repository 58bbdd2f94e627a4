//! 6.4: seams of the texture, across hard edges and along them.

use chamfer::{Chamfered, MeshBuffers, TriangleKind, shapes};

use crate::{chamfered, triangles};

fn uv(mesh: &MeshBuffers, vertex: usize) -> [f32; 2] {
    [mesh.uvs[0].values[2 * vertex], mesh.uvs[0].values[2 * vertex + 1]]
}

/// Twice the area of a triangle in the texture.
fn uv_area(mesh: &MeshBuffers, triangle: [usize; 3]) -> f64 {
    let [a, b, c] = triangle.map(|vertex| uv(mesh, vertex).map(f64::from));
    (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])
}

/// The place in the cube's atlas of three squares by two.
fn atlas_cell([u, v]: [f32; 2]) -> [i32; 2] {
    [(u * 3.0).floor() as i32, (v * 2.0).floor() as i32]
}

/// How far a point is inside the atlas square that it lies in, as a share of a cube's side; less
/// than nothing in the margin between two squares.
fn depth([u, v]: [f32; 2]) -> f32 {
    let inside = |along: f32| (along.fract() - 0.05).min(0.95 - along.fract()) / 0.9;
    inside(u * 3.0).min(inside(v * 2.0))
}

fn new_triangles(result: &Chamfered) -> Vec<[usize; 3]> {
    [triangles(result, TriangleKind::Edge), triangles(result, TriangleKind::Corner)].concat()
}

/// Figures 60 and 61: without recreated seams the chamfers would squeeze half the texture onto
/// themselves.
#[test]
fn no_chamfer_stretches_over_the_atlas() {
    let result = chamfered(&shapes::cube(1.0), 0.1);
    for triangle in new_triangles(&result) {
        let cells = triangle.map(|vertex| atlas_cell(uv(&result.mesh, vertex)));
        assert!(cells.iter().all(|cell| *cell == cells[0]), "{cells:?}");
    }
}

/// Figures 62 and 63: the strip lies in the band that its owner's face has left free, a tenth of
/// the face wide.
#[test]
fn a_chamfer_on_a_seam_lies_in_the_band_that_its_owner_left_free() {
    let result = chamfered(&shapes::cube(1.0), 0.1);
    for vertex in new_triangles(&result).concat() {
        let depth = depth(uv(&result.mesh, vertex));
        assert!((-1e-5..0.1 + 1e-5).contains(&depth), "{depth}");
    }
}

#[test]
fn a_strip_on_a_seam_has_an_area_in_the_texture_and_is_not_mirrored() {
    let result = chamfered(&shapes::cube(1.0), 0.1);
    for strip in triangles(&result, TriangleKind::Edge) {
        assert!(uv_area(&result.mesh, strip) > 1e-4, "{strip:?}");
    }
}

/// The far side of a strip keeps the position and the normal of its own face.
#[test]
fn a_duplicate_differs_from_its_vertex_in_the_texture_only() {
    let cube = shapes::cube(1.0);
    let result = chamfered(&cube, 0.1);
    assert!(result.mesh.positions.len() > 24);
    let own = |v: usize| [result.mesh.positions[v], result.mesh.normals[v]];
    for copy in 24..result.mesh.positions.len() {
        let original = (0..24).find(|&vertex| own(vertex) == own(copy)).unwrap();
        assert_ne!(uv(&result.mesh, copy), uv(&result.mesh, original));
    }
}

/// A box whose texture is continuous needs no duplicates, as long as it does not fold at an edge.
#[test]
fn where_the_texture_runs_on_no_duplicate_is_made() {
    let mut cube = shapes::cube(1.0);
    let projected = |p: &[f32; 3]| [9.0 * p[0] - p[2], 3.0 * p[0] - p[1]];
    cube.uvs[0].values = cube.positions.iter().flat_map(projected).collect();
    assert_eq!(chamfered(&cube, 0.1).mesh.positions.len(), 24);
}

/// Figures 45 and 46: the seam crosses the front face, and ends on the hard edges above and below
/// it.
///
/// ```text
///   +----+----+
///   |    S    |     S: the seam, at x = 2
///   |    S    |
///   +----+----+
/// ```
fn seam_across() -> MeshBuffers {
    let mut mesh = shapes::aligned_strip();
    let is_front = |vertex: usize| mesh.normals[vertex] == [0.0, 0.0, 1.0];
    let meets_left =
        |triangle: &[u32]| triangle.iter().any(|&v| mesh.positions[v as usize][0] < 2.0);
    let cut: Vec<usize> = (0..mesh.indices.len())
        .filter(|&corner| {
            let vertex = mesh.indices[corner] as usize;
            let first = corner - corner % 3;
            is_front(vertex)
                && mesh.positions[vertex][0] == 2.0
                && meets_left(&mesh.indices[first..first + 3])
        })
        .collect();
    let first_copy = mesh.positions.len() as u32;
    for &y in &[0.0, 1.0] {
        mesh.positions.push([2.0, y, 1.0]);
        mesh.normals.push([0.0, 0.0, 1.0]);
        mesh.tangents.push([1.0, 0.0, 0.0, 1.0]);
        mesh.uvs[0].values.extend([2.0, y]);
    }
    for corner in cut {
        let y = mesh.positions[mesh.indices[corner] as usize][1];
        mesh.indices[corner] = first_copy + y as u32;
    }
    // What is right of the seam lies elsewhere in the texture.
    for vertex in 0..first_copy as usize {
        if mesh.normals[vertex] == [0.0, 0.0, 1.0] && mesh.positions[vertex][0] >= 2.0 {
            mesh.uvs[0].values[2 * vertex] += 10.0;
        }
    }
    mesh
}

#[test]
fn both_sides_of_a_seam_that_meets_a_hard_edge_are_pulled_to_one_place() {
    let mesh = seam_across();
    let result = chamfered(&mesh, 0.1);
    let right =
        mesh.positions.iter().zip(&mesh.normals).position(|(position, normal)| {
            *position == [2.0, 1.0, 1.0] && *normal == [0.0, 0.0, 1.0]
        });
    let (left, right) = (mesh.positions.len() - 1, right.unwrap());
    assert_eq!(result.mesh.positions[left], result.mesh.positions[right]);
    assert!((result.mesh.positions[left][1] - 0.9).abs() < 1e-5);
}

#[test]
fn each_side_of_a_seam_that_meets_a_hard_edge_stays_in_its_chart() {
    let mesh = seam_across();
    let result = chamfered(&mesh, 0.1);
    for triangle in triangles(&result, TriangleKind::Source) {
        for vertex in triangle.into_iter().filter(|&v| result.mesh.normals[v][2] == 1.0) {
            let [x, y, _] = result.mesh.positions[vertex];
            let [u, v] = uv(&result.mesh, vertex);
            let u = if u > 5.0 { u - 10.0 } else { u };
            assert!((u - x).abs() < 1e-5 && (v - y).abs() < 1e-5, "{u} {v} at {x} {y}");
        }
    }
}

/// A seam that leans: its vertices slide along it, so that neither chart has to go on past it.
#[test]
fn both_sides_of_a_leaning_seam_stay_on_it() {
    let mut mesh = seam_across();
    for position in mesh.positions.iter_mut().filter(|p| p[0] == 2.0 && p[1] == 0.0) {
        position[0] = 2.5;
    }
    let result = chamfered(&mesh, 0.1);
    let last = mesh.positions.len() - 1;
    let [x, y, _] = result.mesh.positions[last];
    assert!((x - 2.05).abs() < 1e-5 && (y - 0.9).abs() < 1e-5, "{x} {y}");
}
