//! What rests on what.

use super::*;
use crate::mesh::{Held, MeshBuffers};
use crate::options::Verify;
use crate::pipeline::chamfer;
use crate::report::{Chamfered, EdgeVerdict, Outcome, Reason};
use crate::shapes;
use crate::threads::Threads;
use crate::watch::Unwatched;

/// A cube of side 2 around the origin.
fn cube() -> MeshBuffers {
    shapes::plain_cube(2.0)
}

/// Chamfers a mesh by 0.1 with these lines resting on it.
fn chamfered(mesh: &MeshBuffers, lines: &[[[f32; 3]; 2]]) -> Chamfered {
    held(mesh, &lines.iter().map(|&[from, to]| Held { from, to, radius: 0.0 }).collect::<Vec<_>>())
}

fn held(mesh: &MeshBuffers, held: &[Held]) -> Chamfered {
    let options = Options { width: Width::Units(0.1), verify: Verify::Fast, ..Options::default() };
    let mesh = Mesh { held, ..mesh.as_mesh() };
    let result = chamfer(&mesh, &options).unwrap();
    let findings = crate::check::check(&mesh, &result, Verify::Full);
    assert!(findings.is_sound(), "{findings}");
    result
}

/// What became of the edge between two corners of the cube.
fn verdict(mesh: &MeshBuffers, result: &Chamfered, ends: [[f32; 3]; 2]) -> EdgeVerdict {
    let at = |vertex: u32| mesh.positions[vertex as usize];
    let is_it = |v: &&EdgeVerdict| {
        let [from, to] = v.vertices.map(at);
        [from, to] == ends || [to, from] == ends
    };
    *result.verdicts.iter().find(is_it).unwrap()
}

/// The edge on top in front.
const EDGE: [[f32; 3]; 2] = [[-1.0, 1.0, 1.0], [1.0, 1.0, 1.0]];

//   +-----------+
//  /           /|
// +===========+ |      = a line that rests on the edge
// |           | +
#[test]
fn what_rests_on_an_edge_holds_it_and_no_other() {
    let result = chamfered(&cube(), &[EDGE]);
    let edge = verdict(&cube(), &result, EDGE);
    assert_eq!((edge.outcome, edge.reason), (Outcome::Skipped, Reason::Contact));
    let others = result.verdicts.iter().filter(|v| v.outcome != Outcome::Skipped);
    assert_eq!(others.count(), 11);
}

//   +-----------+
//  /===========/|      a line on the top, 0.04 behind the edge
// +-----------+ |
#[test]
fn what_rests_beside_an_edge_narrows_it_to_leave_that() {
    let behind = EDGE.map(|[x, y, z]| [x, y, z - 0.04]);
    let edge = verdict(&cube(), &chamfered(&cube(), &[behind]), EDGE);
    assert_eq!((edge.outcome, edge.reason), (Outcome::Narrowed, Reason::Contact));
    assert!(edge.widths.iter().all(|&width| width < 0.1 && width > 0.02), "{edge:?}");
    let farther = EDGE.map(|[x, y, z]| [x, y, z - 0.11]);
    let edge = verdict(&cube(), &chamfered(&cube(), &[farther]), EDGE);
    assert_eq!(edge.outcome, Outcome::Full, "the chamfer ends before it");
}

#[test]
fn what_ends_inside_the_solid_right_behind_an_edge_must_not_come_out() {
    let inside = EDGE.map(|[x, y, z]| [x, y - 0.03, z - 0.03]);
    let edge = verdict(&cube(), &chamfered(&cube(), &[inside]), EDGE);
    assert_eq!((edge.outcome, edge.reason), (Outcome::Narrowed, Reason::Contact));
    let deeper = EDGE.map(|[x, y, z]| [x, y - 0.06, z - 0.06]);
    let edge = verdict(&cube(), &chamfered(&cube(), &[deeper]), EDGE);
    assert_eq!(edge.outcome, Outcome::Full, "the chamfer does not reach it");
}

#[test]
fn what_hovers_above_a_face_does_not_rest_there() {
    let above = EDGE.map(|[x, y, z]| [x, y + 0.01, z - 0.05]);
    assert_eq!(verdict(&cube(), &chamfered(&cube(), &[above]), EDGE).outcome, Outcome::Full);
    let rounded = EDGE.map(|[x, y, z]| [x, y + 1e-6, z]);
    let edge = verdict(&cube(), &chamfered(&cube(), &[rounded]), EDGE);
    assert_eq!(edge.reason, Reason::Contact, "off by what exporters round to");
}

#[test]
fn a_ball_holds_all_edges_that_come_near() {
    let corner = EDGE[0];
    let result = held(&cube(), &[Held { from: corner, to: corner, radius: 0.2 }]);
    let contacts = result.verdicts.iter().filter(|v| v.reason == Reason::Contact);
    assert_eq!(contacts.count(), 3, "those that meet at the corner");
}

//    ___
//   | | |      the rim of the open box rests on nothing but itself
//   |_|_|
#[test]
fn a_mesh_does_not_rest_on_its_own_rims() {
    let result = chamfered(&shapes::open_box(), &[]);
    assert!(result.verdicts.iter().all(|v| v.reason != Reason::Contact));
}

#[test]
fn a_concave_edge_loses_nothing() {
    // Two boxes in one: the step between them is an inner corner.
    let steps = shapes::extruding_cubes();
    let none = chamfered(&steps, &[]);
    let at = |vertex: u32| steps.positions[vertex as usize];
    let is_concave = |v: &&EdgeVerdict| {
        let topology = topology_of(&steps);
        let view = view(&steps.as_mesh(), &Options::default()).unwrap();
        let faces = faces(&view, &topology, &Threads::default());
        let ends = v.vertices.map(at);
        let side = topology.twin.ids().find(|&corner| {
            let [from, to] =
                [corner, corner.next()].map(|c| view.mesh.positions[view.vertex_at(c).0 as usize]);
            [from, to] == ends && topology.twin[corner].is_some()
        });
        side.is_some_and(|side| Wedge::new(&view, &faces, [side, topology.twin[side]]).is_none())
    };
    let concave = none.verdicts.iter().find(is_concave).unwrap().vertices.map(at);
    let result = chamfered(&steps, &[concave]);
    assert_ne!(verdict(&steps, &result, concave).reason, Reason::Contact);
}

fn topology_of(mesh: &MeshBuffers) -> Topology {
    let mesh = mesh.as_mesh();
    let view = view(&mesh, &Options::default()).unwrap();
    topology(&view, &weld(&mesh))
}

#[test]
fn segments_are_as_far_as_their_nearest_points() {
    let distance = |one: [[f64; 3]; 2], other: [[f64; 3]; 2]| {
        distance_between(one.map(DVec3::from), other.map(DVec3::from))
    };
    let along_x = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0]];
    assert_eq!(distance(along_x, [[1.0, -1.0, 3.0], [1.0, 1.0, 3.0]]), 3.0, "they cross");
    assert_eq!(distance(along_x, [[5.0, 0.0, 4.0], [9.0, 0.0, 4.0]]), 5.0, "one behind the other");
    assert_eq!(distance(along_x, [[1.0, 2.0, 0.0]; 2]), 2.0, "a point");
    assert_eq!(distance([[0.0; 3]; 2], [[0.0, 3.0, 4.0]; 2]), 5.0, "two points");
    assert_eq!(distance(along_x, [[-3.0, 1.0, 0.0], [3.0, 1.0, 0.0]]), 1.0, "side by side");
}

//   A, B and C are one line, told three times; D runs the other way, and E is thicker.
#[test]
fn lines_that_are_alike_are_one_place_in_the_order_of_the_first() {
    let [from, to] = EDGE;
    let [thin, back, thick] = [(from, to, 0.0), (to, from, 0.0), (from, to, 0.5)]
        .map(|(from, to, radius)| Held { from, to, radius });
    let (mesh, held) = (cube(), [thin, back, thin, thick, thin]);
    let mesh = Mesh { held: &held, ..mesh.as_mesh() };
    let view = view(&mesh, &Options::default()).unwrap();
    let topology = topology(&view, &weld(&mesh));
    let faces = faces(&view, &topology, &Threads::default());
    let contacts = contacts(&view, &topology, &faces, &Unwatched).unwrap();
    assert_eq!(contacts.starts[..], [0, 3, 4, 5]);
    let near: Vec<_> = contacts.beside_edge(EDGE.map(wide), 0.0).map(<[Rim]>::len).collect();
    assert_eq!(near, [3, 1, 1]);
}

/// The cube with triangles without thickness beside it, all around one point far left of [`EDGE`]: the
/// side of one runs along that edge, or so far above it.
fn cube_and_petals(above: f32) -> MeshBuffers {
    let mut mesh = cube();
    let tip = [-4.0, 1.0 + above, 1.0];
    let mut petal = |far: [[f32; 3]; 2]| {
        let first = mesh.positions.len() as u32;
        mesh.positions.extend([tip, far[0], far[1]]);
        mesh.normals.extend([[0.0, 0.0, 1.0]; 3]);
        mesh.indices.extend([first, first + 1, first + 2]);
    };
    petal([[3.0, tip[1], 1.0], [3.0, tip[1] + 1.0, 1.0]]);
    for turn in 0..40 {
        let at = |turns: f32| {
            let (sin, cos) = (turns / 80.0 * std::f32::consts::TAU).sin_cos();
            [tip[0] - sin, tip[1] - cos, 1.0]
        };
        petal([turn as f32 + 0.5, turn as f32].map(at));
    }
    mesh.submesh_index_counts = vec![mesh.indices.len() as u32];
    mesh
}

//  \ | /  _______
//  - * ====================     many triangles at one point: one of them rests on the edge
//  / | \  |       |
#[test]
fn one_of_a_crowd_of_sheets_rests_on_an_edge() {
    for above in [0.0, 1e-5] {
        let mesh = cube_and_petals(above);
        let result = chamfered(&mesh, &[]);
        assert_eq!(verdict(&mesh, &result, EDGE).reason, Reason::Contact);
        let others = result.verdicts.iter().filter(|v| v.outcome != Outcome::Skipped);
        assert_eq!(others.count(), 11);
    }
    let mesh = cube_and_petals(0.01);
    assert_eq!(verdict(&mesh, &chamfered(&mesh, &[]), EDGE).outcome, Outcome::Full);
}
