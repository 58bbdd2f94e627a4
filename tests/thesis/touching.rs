//! Bodies that merely touch are chamfered each on its own, and what is hidden stays so.

use chamfer::see_through::{Eyes, SceneTriangle, leaks};
use chamfer::shapes::{self, Touch};
use chamfer::{Chamfered, MeshBuffers, Outcome, Reason, TriangleKind};

use crate::{assert_at, chamfered, count, pulled, vector};

/// But for whole edges: there light would show between the two.
const APART: [Touch; 3] = [Touch::Vertex, Touch::HalfEdge, Touch::Face];

#[test]
fn two_cubes_that_touch_become_two_chamfered_cubes() {
    for touch in APART {
        let result = chamfered(&shapes::two_cubes_touching(touch), 0.1);
        assert_eq!(result.mesh.positions.len(), 2 * 24, "{touch:?}");
        assert_eq!(result.mesh.indices.len() / 3, 2 * 44, "{touch:?}");
        assert_eq!(count(&result, TriangleKind::Corner), 2 * 8, "{touch:?}");
        let is_full = |outcome: Outcome| outcome == Outcome::Full;
        assert!(result.verdicts.iter().all(|v| is_full(v.outcome)), "{touch:?}");
    }
}

#[test]
fn a_cube_that_touches_another_is_chamfered_as_if_alone() {
    let mut alone = shapes::plain_cube(1.0);
    for position in &mut alone.positions {
        *position = position.map(|along| along + 0.5);
    }
    let alone = chamfered(&alone, 0.1);
    for touch in APART {
        let result = chamfered(&shapes::two_cubes_touching(touch), 0.1);
        let pairs = alone.mesh.positions.iter().zip(&result.mesh.positions);
        for (&expected, &found) in pairs {
            assert!(vector(expected).distance(vector(found)) < 1e-6, "{touch:?}");
        }
    }
}

/// Where two cubes share an edge, air meets air along it: whatever was cut off one of them would
/// let light through. So both stay, with all that ends there.
#[test]
fn an_edge_along_which_two_cubes_touch_stays_and_closes_the_view() {
    let cubes = shapes::two_cubes_touching(Touch::Edge);
    let result = chamfered(&cubes, 0.1);
    let contacts = result.verdicts.iter().filter(|verdict| verdict.reason == Reason::Contact);
    assert!(contacts.clone().all(|verdict| verdict.outcome == Outcome::Skipped));
    assert_eq!(contacts.count(), 2, "one for each cube");
    assert_eq!(result.totals.chamfered + result.totals.narrowed + 2, result.totals.hard_edges);
    assert_closed_to_the_eye(&cubes, &result);
}

fn scene(mesh: &MeshBuffers) -> Vec<SceneTriangle> {
    let at = |&index: &u32| mesh.positions[index as usize];
    mesh.indices.chunks_exact(3).map(|t| [at(&t[0]), at(&t[1]), at(&t[2])]).collect()
}

fn assert_closed_to_the_eye(before: &MeshBuffers, after: &Chamfered) {
    let found = leaks(&scene(before), &scene(&after.mesh), after.width, Eyes::default());
    assert!(found.is_empty(), "light shows at {:?}", found[0].places[0]);
}

/// An L of which each face has vertices of its own, without textures, and in it a wall that nobody
/// sees: from an edge along z into the solid, with one side.
///
/// ```text
///  #####
///  #####
///  #####1---+     a wall from the inner edge 1, or from
///  #####|## |     the outer edge 2
///  #########2
/// ```
fn l_with_wall(from: [f32; 2], to: [f32; 2]) -> MeshBuffers {
    let l = shapes::l_shape();
    let mut mesh = MeshBuffers {
        positions: l.positions,
        normals: l.normals,
        indices: l.indices,
        ..MeshBuffers::default()
    };
    let [a, b, c, d] = [(from, 0.0), (to, 0.0), (to, 1.0), (from, 1.0)];
    let first = mesh.positions.len() as u32;
    mesh.positions.extend([a, b, c, d].map(|([x, y], z)| [x, y, z]));
    let across = vector([to[1] - from[1], from[0] - to[0], 0.0]).normalize();
    mesh.normals.extend([across.as_vec3().to_array(); 4]);
    mesh.indices.extend([0, 1, 2, 0, 2, 3].map(|corner| first + corner));
    mesh.submesh_index_counts = vec![mesh.indices.len() as u32];
    mesh
}

/// Whichever way the wall faces, which of the faces it comes next to, and in whichever order.
fn walls(from: [f32; 2], to: [f32; 2]) -> [MeshBuffers; 2] {
    let wall = l_with_wall(from, to);
    let mut turned = wall.clone();
    turned.indices.rotate_right(6);
    let first = wall.positions.len() - 4;
    turned.indices[..6].reverse();
    turned.normals[first..].iter_mut().for_each(|normal| *normal = normal.map(|part| -part));
    [wall, turned]
}

#[test]
fn a_wall_behind_an_inner_edge_stays_behind_its_chamfer() {
    for mesh in walls([1.0, 1.0], [0.9, 0.2]) {
        let result = chamfered(&mesh, 0.1);
        let is_full = |outcome: Outcome| outcome == Outcome::Full;
        assert!(result.verdicts.iter().all(|verdict| is_full(verdict.outcome)));
        assert_eq!(result.totals.hard_edges, 18, "those of the L");
        assert_closed_to_the_eye(&mesh, &result);
    }
}

#[test]
fn a_wall_inside_an_outer_edge_goes_back_behind_its_chamfer() {
    for mesh in walls([2.0, 0.0], [1.5, 0.5]) {
        let result = chamfered(&mesh, 0.1);
        let is_full = |outcome: Outcome| outcome == Outcome::Full;
        assert!(result.verdicts.iter().all(|verdict| is_full(verdict.outcome)));
        assert_closed_to_the_eye(&mesh, &result);
        // By the width, and away from the chamfer at the end: in the middle the chamfer is less
        // deep.
        let normal = *mesh.normals.last().unwrap();
        let places = pulled(&mesh, &result, [2.0, 0.0, 1.0], normal);
        let step = 0.1 / 2.0_f32.sqrt();
        assert_at(&mesh, places[0], [2.0 - step, step, 0.9]);
    }
}

/// A wall of one side on a smooth floor, with a corner: the floor goes on on its other side.
///
/// ```text
///      |  wall
///      |
///  ----+----  floor
/// ```
#[test]
fn a_floor_is_seen_on_both_sides_of_a_wall() {
    let floor = |x: f32| [[x, 0.0, 0.0], [x, 0.0, 1.0], [x + 1.0, 0.0, 1.0], [x + 1.0, 0.0, 0.0]];
    let wall = [[1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [1.0, 1.0, 1.0], [1.0, 0.0, 1.0]];
    let side = [[1.0, 0.0, 1.0], [1.0, 1.0, 1.0], [2.0, 1.0, 1.0], [2.0, 0.0, 1.0]];
    let quads = [
        (floor(0.0), [0.0, 1.0, 0.0]),
        (floor(1.0), [0.0, 1.0, 0.0]),
        (wall, [1.0, 0.0, 0.0]),
        (side, [0.0, 0.0, -1.0]),
    ];
    let mut mesh = MeshBuffers::default();
    for (points, normal) in quads {
        let first = mesh.positions.len() as u32;
        mesh.positions.extend(points);
        mesh.normals.extend([normal; 4]);
        mesh.indices.extend([0, 1, 2, 0, 2, 3].map(|corner| first + corner));
    }
    mesh.submesh_index_counts = vec![mesh.indices.len() as u32];
    let result = chamfered(&mesh, 0.1);
    let opened = result.totals.chamfered + result.totals.narrowed;
    assert_eq!(opened, 2, "the corner of the walls, and the floor's edge: {:?}", result.verdicts);
    assert_closed_to_the_eye(&mesh, &result);
}
