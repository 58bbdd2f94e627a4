use std::collections::HashMap;

use glam::DVec3;

use super::*;

fn closed_shapes() -> Vec<(&'static str, MeshBuffers)> {
    let mut shapes = demo_models();
    shapes.extend([
        ("plain_cube", plain_cube(2.0)),
        ("smallest cylinder", cylinder(3)),
        ("saddle", saddle()),
        ("aligned_strip", aligned_strip()),
        ("plate", plate()),
        ("wedge_end", wedge_end()),
        ("pyramid of three", pyramid(3)),
        ("pyramid of five", pyramid(5)),
        ("sphere", sphere(8, 12)),
        ("smallest sphere", sphere(2, 3)),
        ("cube_field", cube_field(9)),
        ("touching at a vertex", two_cubes_touching(Touch::Vertex)),
        ("touching along half an edge", two_cubes_touching(Touch::HalfEdge)),
    ]);
    shapes
}

fn triangles(mesh: &MeshBuffers) -> impl Iterator<Item = [usize; 3]> + '_ {
    mesh.indices.chunks_exact(3).map(|t| [t[0] as usize, t[1] as usize, t[2] as usize])
}

fn position(mesh: &MeshBuffers, vertex: usize) -> DVec3 {
    DVec3::from(mesh.positions[vertex].map(f64::from))
}

/// How often each directed edge between two welded positions is used.
fn edge_uses(mesh: &MeshBuffers) -> HashMap<[[u32; 3]; 2], u32> {
    let weld = |vertex: usize| mesh.positions[vertex].map(|along| (along + 0.0).to_bits());
    let mut uses = HashMap::new();
    for triangle in triangles(mesh) {
        for side in 0..3 {
            *uses.entry([triangle[side], triangle[(side + 1) % 3]].map(weld)).or_insert(0) += 1;
        }
    }
    uses
}

#[test]
fn closed_shapes_use_each_edge_once_in_both_directions() {
    for (name, mesh) in closed_shapes() {
        let uses = edge_uses(&mesh);
        for (&[a, b], &count) in &uses {
            assert_eq!((count, uses.get(&[b, a])), (1, Some(&1)), "{name}: {a:?} {b:?}");
        }
    }
}

#[test]
fn cubes_touching_along_an_edge_or_face_are_balanced() {
    for touch in [Touch::Edge, Touch::Face] {
        let uses = edge_uses(&two_cubes_touching(touch));
        assert!(uses.iter().all(|(&[a, b], count)| uses.get(&[b, a]) == Some(count)));
        assert!(uses.values().any(|&count| count == 2));
    }
}

#[test]
fn the_open_box_has_one_border_of_four_edges() {
    let uses = edge_uses(&open_box());
    assert_eq!(uses.keys().filter(|[a, b]| !uses.contains_key(&[*b, *a])).count(), 4);
}

#[test]
fn closed_shapes_have_positive_volume() {
    for (name, mesh) in closed_shapes() {
        let corner = |vertex| position(&mesh, vertex);
        let volume: f64 =
            triangles(&mesh).map(|[a, b, c]| corner(a).dot(corner(b).cross(corner(c)))).sum();
        assert!(volume > 0.0, "{name}: {volume}");
    }
}

#[test]
fn normals_are_unit_and_agree_with_the_winding() {
    for (name, mesh) in closed_shapes() {
        for triangle in triangles(&mesh) {
            let [a, b, c] = triangle.map(|vertex| position(&mesh, vertex));
            let winding = (b - a).cross(c - a);
            assert!(winding.length() > 1e-6, "{name}: {triangle:?} has no area");
            for vertex in triangle {
                let normal = DVec3::from(mesh.normals[vertex].map(f64::from));
                assert!((normal.length() - 1.0).abs() < 1e-6, "{name}: {normal}");
                assert!(normal.dot(winding.normalize()) > 0.1, "{name}: {triangle:?} {normal}");
            }
        }
    }
}

#[test]
fn tangents_are_unit_orthogonal_and_unmirrored() {
    for (name, mesh) in closed_shapes() {
        assert_eq!(mesh.tangents.is_empty(), mesh.uvs[0].values.is_empty() || name == "cube_field");
        for (tangent, normal) in mesh.tangents.iter().zip(&mesh.normals) {
            let along = DVec3::new(tangent[0].into(), tangent[1].into(), tangent[2].into());
            assert!((along.length() - 1.0).abs() < 1e-6, "{name}: {tangent:?}");
            assert!(along.dot(DVec3::from(normal.map(f64::from))).abs() < 1e-6, "{name}");
            assert_eq!(tangent[3], 1.0, "{name}");
        }
    }
}

#[test]
fn streams_and_submeshes_add_up() {
    for (name, mesh) in closed_shapes() {
        let vertices = mesh.positions.len();
        assert_eq!(mesh.normals.len(), vertices, "{name}");
        assert!([0, 2 * vertices].contains(&mesh.uvs[0].values.len()), "{name}");
        assert!([0, vertices].contains(&mesh.colors.len()), "{name}");
        assert!(mesh.indices.iter().all(|&index| (index as usize) < vertices), "{name}");
        let total: u32 = mesh.submesh_index_counts.iter().sum();
        assert_eq!(total as usize, mesh.indices.len(), "{name}");
    }
    assert_eq!(bolt().submesh_index_counts.len(), 2);
    assert!(!table().colors.is_empty());
}

#[test]
fn cubes_have_four_vertices_per_face() {
    for mesh in [cube(1.0), plain_cube(1.0), cube_field(1)] {
        assert_eq!((mesh.positions.len(), mesh.indices.len()), (24, 36));
    }
}

#[test]
fn the_middle_of_the_extruding_cubes_has_three_corner_connected_vertices() {
    let mesh = extruding_cubes();
    let middle: Vec<usize> =
        (0..mesh.positions.len()).filter(|&v| mesh.positions[v] == [1.0; 3]).collect();
    assert_eq!(middle.len(), 3);
    for vertex in middle {
        let around: Vec<[usize; 3]> =
            triangles(&mesh).filter(|triangle| triangle.contains(&vertex)).collect();
        let shared = around[0].iter().filter(|v| around.last().unwrap().contains(v)).count();
        assert_eq!(shared, 1, "the first and last face share vertex {vertex} only");
    }
}

#[test]
fn the_ridge_ends_in_one_shared_normal() {
    let mesh = wedge_end();
    let normals_at = |point: [f32; 3]| {
        let here = |&v: &usize| mesh.positions[v] == point && mesh.normals[v][1] > 0.0;
        (0..mesh.positions.len()).filter(here).count()
    };
    assert_eq!((normals_at([0.0, 1.5, 1.0]), normals_at([1.0, 1.0, 1.0])), (2, 1));
}
