//! Hard edges whose two sides share no edge, and faces that are inside out: none is silently missing.

use chamfer::check::check;
use chamfer::{Chamfered, MeshBuffers, Options, Outcome, Reason, Verify, Width, chamfer, shapes};

type Point = [f32; 3];

/// Quads as seen from the side that they face, with a normal each.
fn quads(quads: &[([Point; 4], Point)]) -> MeshBuffers {
    let mut mesh = MeshBuffers::default();
    for (corners, normal) in quads {
        let first = mesh.positions.len() as u32;
        mesh.positions.extend(corners);
        mesh.normals.extend([*normal; 4]);
        mesh.indices.extend([0, 1, 2, 0, 2, 3].map(|corner| first + corner));
    }
    mesh.submesh_index_counts = vec![mesh.indices.len() as u32];
    mesh
}

/// Chamfered soundly at both depths.
#[track_caller]
fn chamfered(mesh: &MeshBuffers) -> Chamfered {
    let [_, full] = [Verify::Fast, Verify::Full].map(|verify| {
        let options = Options::default().with_width(Width::Units(0.05)).with_verify(verify);
        let result = chamfer(&mesh.as_mesh(), &options).unwrap();
        let findings = check(&mesh.as_mesh(), &result, verify);
        assert!(findings.is_sound(), "{verify:?}: {findings}");
        result
    });
    full
}

/// The ends of the edges that are left for a reason, lower first.
fn left(mesh: &MeshBuffers, result: &Chamfered, reason: Reason) -> Vec<[Point; 2]> {
    let verdicts = result.verdicts.iter().filter(|verdict| verdict.reason == reason);
    let ends = verdicts.map(|verdict| {
        assert_eq!((verdict.outcome, verdict.widths), (Outcome::Skipped, [0.0; 2]));
        let mut ends = verdict.vertices.map(|vertex| mesh.positions[vertex as usize]);
        ends.sort_by(|one, other| one.partial_cmp(other).unwrap());
        ends
    });
    let ends: Vec<[Point; 2]> = ends.collect();
    assert_eq!(result.totals.skipped[reason] as usize, ends.len());
    assert_eq!(result.totals.hard_edges as usize, result.verdicts.len());
    ends
}

const UP: Point = [0.0, 1.0, 0.0];
const FRONT: Point = [0.0, 0.0, 1.0];

//   .-----------.      a roof of one quad, and below its edge a wall whose columns end at the places
//  /           /       that are given: they touch the roof, and the columns left of them
// A---M---M---B
// |   |   |   |
fn roof_on_wall(columns: &[f32], roofs: &[[f32; 2]], front: Point) -> MeshBuffers {
    let roof = |[from, to]: [f32; 2]| {
        let corners = [[from, 0.0, 0.0], [to, 0.0, 0.0], [to, 0.0, -2.0], [from, 0.0, -2.0]];
        (corners, UP)
    };
    let column = |pair: &[f32]| {
        let [from, to] = [pair[0], pair[1]];
        let corners = [[from, -2.0, 0.0], [to, -2.0, 0.0], [to, 0.0, 0.0], [from, 0.0, 0.0]];
        (corners, front)
    };
    let roofs = roofs.iter().copied().map(roof);
    quads(&roofs.chain(columns.windows(2).map(column)).collect::<Vec<_>>())
}

#[test]
fn an_edge_that_is_one_above_and_several_below_says_so_once() {
    for columns in [&[0.0, 1.0, 4.0][..], &[0.0, 1.0, 2.0, 3.0, 4.0]] {
        let mesh = roof_on_wall(columns, &[[0.0, 4.0]], FRONT);
        let result = chamfered(&mesh);
        let junctions = left(&mesh, &result, Reason::TJunction);
        assert_eq!(junctions, [[[0.0; 3], [4.0, 0.0, 0.0]]], "{columns:?}");
        assert_eq!(result.mesh.positions, mesh.positions);
    }
}

//  A-------.---B       of edges that overlap, each longer one
//  .---.-------.
#[test]
fn edges_that_overlap_say_so() {
    let mesh = roof_on_wall(&[0.0, 1.0, 4.0], &[[0.0, 3.0], [3.0, 4.0]], FRONT);
    let result = chamfered(&mesh);
    let (from, to) = ([0.0; 3], [4.0, 0.0, 0.0]);
    let junctions = left(&mesh, &result, Reason::TJunction);
    assert!(junctions.contains(&[from, [3.0, 0.0, 0.0]]), "{junctions:?}");
    assert!(junctions.contains(&[[1.0, 0.0, 0.0], to]), "{junctions:?}");
    assert_eq!(junctions.len(), 2);
}

#[test]
fn where_both_sides_shade_as_one_there_is_no_edge() {
    let mesh = roof_on_wall(&[0.0, 1.0, 4.0], &[[0.0, 4.0]], UP);
    assert_eq!(chamfered(&mesh).totals.hard_edges, 0);
}

/// A wall one unit behind the roof's edge, and one that begins where the roof ends.
#[test]
fn what_only_lies_near_by_is_no_junction() {
    let mut behind = roof_on_wall(&[0.0, 1.0, 4.0], &[[0.0, 4.0]], FRONT);
    behind.positions[4..].iter_mut().for_each(|place| place[2] -= 1e-3);
    let beside = roof_on_wall(&[4.0, 5.0, 7.0], &[[0.0, 4.0]], FRONT);
    for mesh in [behind, beside] {
        let result = chamfered(&mesh);
        assert_eq!(left(&mesh, &result, Reason::TJunction), [[[0.0; 3]; 2]; 0]);
    }
}

/// The two triangles of a face of a cube turn over: its four edges have no twins.
#[test]
fn the_edges_of_a_face_that_is_inside_out_say_so() {
    for with_normals in [false, true] {
        let mut cube = shapes::cube(1.0);
        for triangle in cube.indices.chunks_exact_mut(3).take(2) {
            triangle.swap(1, 2);
        }
        if with_normals {
            cube.normals[..4].iter_mut().for_each(|normal| *normal = normal.map(|along| -along));
        }
        let result = chamfered(&cube);
        assert_eq!(left(&cube, &result, Reason::Winding).len(), 4);
        assert_eq!((result.totals.hard_edges, result.totals.skipped[Reason::Folds]), (12, 0));
    }
}

/// The normals of a cube, then its winding, each of which goes against the other.
#[test]
fn what_is_inside_out_as_a_whole_is_chamfered() {
    let mut against = shapes::cube(1.0);
    against.normals.iter_mut().for_each(|normal| *normal = normal.map(|along| -along));
    let mut turned = shapes::cube(1.0);
    turned.indices.chunks_exact_mut(3).for_each(|triangle| triangle.swap(1, 2));
    for mesh in [against, turned] {
        let result = chamfered(&mesh);
        assert_eq!((result.totals.chamfered, result.totals.hard_edges), (12, 12));
        assert_eq!(result.mesh.normals[..mesh.normals.len()], mesh.normals);
    }
}

/// The normals of some faces alone are turned: the edges at which a chamfer would have to face both
/// ways say which it was.
#[test]
fn faces_against_their_normals_are_named() {
    let mut half = shapes::cube(1.0);
    half.normals[..12].iter_mut().for_each(|normal| *normal = normal.map(|along| -along));
    let result = chamfered(&half);
    assert!(!left(&half, &result, Reason::Winding).is_empty());
    assert_eq!(result.totals.skipped[Reason::Folds], 0);
}
