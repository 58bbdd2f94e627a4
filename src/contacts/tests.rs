//! What rests on what.

use super::*;
use crate::ids::{Id, Triangle};
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
        let faces = faces(&view, &topology, (&Threads::default(), &Unwatched)).unwrap();
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
    topology(&view, &weld(&mesh, &Unwatched).unwrap(), &Unwatched).unwrap()
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
    let topology = topology(&view, &weld(&mesh, &Unwatched).unwrap(), &Unwatched).unwrap();
    let faces = faces(&view, &topology, (&Threads::default(), &Unwatched)).unwrap();
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

/// A mesh with more triangles, each flat and with vertices of its own.
fn with_triangles(mut mesh: MeshBuffers, triangles: &[[[f32; 3]; 3]]) -> MeshBuffers {
    for corners in triangles {
        let [a, b, c] = corners.map(wide);
        let normal = (b - a).cross(c - a).normalize_or_zero().as_vec3().to_array();
        let first = mesh.positions.len() as u32;
        mesh.positions.extend(corners);
        mesh.normals.extend([normal; 3]);
        mesh.indices.extend([first, first + 1, first + 2]);
    }
    let submesh_index_counts = vec![mesh.indices.len() as u32];
    let (tangents, uvs) = Default::default();
    MeshBuffers { submesh_index_counts, tangents, uvs, ..mesh }
}

/// Does something with what rests on a mesh, and with what that is found from.
fn with_contacts<T>(mesh: &Mesh, act: impl FnOnce(&Contacts, &View, &Topology, &Faces) -> T) -> T {
    let view = view(mesh, &Options::default()).unwrap();
    let topology = topology(&view, &weld(mesh, &Unwatched).unwrap(), &Unwatched).unwrap();
    let faces = faces(&view, &topology, (&Threads::default(), &Unwatched)).unwrap();
    let contacts = contacts(&view, &topology, &faces, &Unwatched).unwrap();
    act(&contacts, &view, &topology, &faces)
}

/// The half-edge from one place to another.
fn side(view: &View, ends: [[f32; 3]; 2]) -> Corner {
    let at = |corner: Corner| view.mesh.positions[view.vertex_at(corner).index()];
    let mut corners = view.triangles().flat_map(Triangle::corners);
    corners.find(|&side| [at(side), at(side.next())] == ends).unwrap()
}

//       ._/_.
//   +==/=/====+ ==      a sheet of two sides stands with its rim on the edge
//  /         /|
// +---------+ |
#[test]
fn the_rim_of_a_sheet_of_two_sides_rests_on_an_edge() {
    let [a, b, c] = [[-2.0, 1.0, 1.0], [2.0, 1.0, 1.0], [0.0, 3.0, 1.0]];
    let mesh = with_triangles(cube(), &[[a, b, c], [a, c, b]]);
    assert_eq!(verdict(&mesh, &chamfered(&mesh, &[]), EDGE).reason, Reason::Contact);
}

//   /|      a blade: its sharp edge, a sheet's rim, ends where edges of the blunt end begin
//  / |
// /__|
#[test]
fn a_sharp_edge_does_not_rest_on_those_that_it_meets() {
    let blade = [-1.0, 1.0].map(|x| [[x, 1.0, 0.0], [x, -1.0, 5e-4], [x, -1.0, -5e-4]]);
    let points = blade.concat();
    let indices = [0, 2, 1, 3, 4, 5, 0, 1, 4, 0, 4, 3, 2, 0, 3, 2, 3, 5, 1, 2, 5, 1, 5, 4];
    let mesh = crate::stages::split(&points, &indices);
    with_contacts(&mesh.as_mesh(), |contacts, view, topology, faces| {
        assert_eq!(contacts.len(), 1);
        let blunt = side(view, [points[0], points[2]]);
        let sides = [blunt, topology.twin[blunt]];
        assert!(contacts.beside(view, topology, faces, (sides, [0.01; 2])).is_empty());
    });
}

//   +=========+
//  /:\       /|      a wall within the cube hangs on the edge, and is cut off with it
// +---:-----+ |
//  \..:
#[test]
fn a_hidden_wall_goes_back_with_the_edge_that_it_hangs_on() {
    let [a, b] = EDGE;
    let [c, d] = [[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0]];
    let mesh = with_triangles(cube(), &[[a, b, c], [a, c, d]]);
    with_contacts(&mesh.as_mesh(), |contacts, view, topology, _| {
        assert_eq!(topology.hidden.len(), 1);
        let left: Vec<Corner> = contacts.borders().collect();
        assert_eq!(left, [side(view, [c, d])], "the border at its other end");
    });
}

#[test]
fn a_triangle_that_is_a_line_rests_on_nothing() {
    let [a, b] = [[-2.0, 1.0, 1.0], [2.0, 1.0, 1.0]];
    let mesh = with_triangles(cube(), &[[a, b, b]]);
    assert_eq!(verdict(&mesh, &chamfered(&mesh, &[]), EDGE).outcome, Outcome::Full);
}

//  o         near the middle of the edge, above it
//  =====
#[test]
fn a_ball_holds_the_edge_that_it_reaches_for_as_long_as_it_does() {
    let at = [0.4, 1.1, 1.0];
    let (mesh, held) = (cube(), [Held { from: at, to: at, radius: 0.2 }]);
    with_contacts(&Mesh { held: &held, ..mesh.as_mesh() }, |contacts, view, topology, faces| {
        let edge = side(view, [EDGE[1], EDGE[0]]);
        assert!(contacts.holds(view, topology, faces, edge));
        let other = side(view, [[1.0, -1.0, 1.0], [-1.0, -1.0, 1.0]]);
        assert!(!contacts.holds(view, topology, faces, other));
        let stretches = contacts.stretches(view, topology, faces, edge);
        let [[from, to]] = stretches[..] else { panic!("{stretches:?}") };
        // The edge runs from x = 1 to -1, and the ball reaches so far along it.
        let (middle, reach) = (0.6, f64::from(0.04_f32 - 0.01).sqrt());
        let slack = contacts.tolerance();
        assert!(from < middle - reach - slack && from > middle - reach - 10.0 * slack, "{from}");
        assert!(to > middle + reach + slack && to < middle + reach + 10.0 * slack, "{to}");
    });
}

#[test]
fn a_ball_touches_a_corner_that_it_reaches() {
    let touches = |x: f32| {
        let at = [x, 1.0, 1.0];
        let (mesh, held) = (cube(), [Held { from: at, to: at, radius: 0.2 }]);
        with_contacts(&Mesh { held: &held, ..mesh.as_mesh() }, |contacts, view, topology, _| {
            contacts.touch_corner(view, topology, side(view, [EDGE[1], EDGE[0]]))
        })
    };
    assert!(touches(1.1) && !touches(1.3));
}

#[test]
fn around_a_vertex_without_border_there_is_none() {
    let (cube, open) = (cube(), shapes::open_box());
    let topology = topology_of(&cube);
    assert!(!topology.twin.ids().any(|corner| is_around(&topology, Corner(0), corner)));
    let topology = topology_of(&open);
    let rim = topology.twin.ids().find(|&corner| topology.twin[corner].is_none()).unwrap();
    assert!(is_around(&topology, rim, rim));
}

#[test]
fn far_from_the_origin_touches_what_is_two_roundings_off() {
    let mut far = cube();
    far.positions.iter_mut().for_each(|at| at[0] += 131_072.0);
    let mesh = far.as_mesh();
    let view = view(&mesh, &Options::default()).unwrap();
    assert!(view.extent < 3.0 && tolerance(&view) >= 2.0 / 64.0, "{}", tolerance(&view));
}

#[test]
fn other_names_are_those_of_all_borders() {
    with_contacts(&shapes::open_box().as_mesh(), |contacts, _, _, _| {
        let names = |contacts: &Contacts| contacts.borders().map(|c| c.0).collect::<Vec<_>>();
        let next: Vec<u32> = names(contacts).into_iter().map(|name| name + 100).collect();
        assert_eq!(names(&contacts.renamed(|corner| Corner(corner.0 + 100))), next);
    });
}

#[test]
fn many_that_end_at_one_place_are_a_crowd_at_whichever_end() {
    let tip = [0.0, 1.0, 0.0];
    let petal = |k: u32| {
        let at = |turn: u32| {
            let (sin, cos) = (f64::from(turn) / 40.0 * std::f64::consts::TAU).sin_cos();
            [cos as f32, 0.0, sin as f32]
        };
        [tip, at(2 * k), at(2 * k + 1)]
    };
    let crowds = |petals: u32| {
        let petals: Vec<_> = (0..petals).map(petal).collect();
        with_contacts(
            &with_triangles(MeshBuffers::default(), &petals).as_mesh(),
            |contacts, _, _, _| !contacts.crowds.is_empty(),
        )
    };
    assert!(crowds(16) && !crowds(15), "two ends of each petal");
}

//        /\
//    x  /  \ x      what lies below the chamfer is not cut off, though it is near both faces' edge
//      /----\
#[test]
fn a_wedge_ends_at_the_chamfer() {
    let mesh = cube();
    with_contacts(&mesh.as_mesh(), |_, view, topology, faces| {
        let edge = side(view, [EDGE[1], EDGE[0]]);
        let wedge = Wedge::new(view, faces, [edge, topology.twin[edge]]).unwrap();
        let clipped = |depth: f64| {
            let line = EDGE.map(|at| wide(at) - DVec3::new(0.0, depth, depth));
            wedge.clip(line, [0.1; 2], 1e-6).is_some()
        };
        assert!(clipped(0.049) && !clipped(0.051));
    });
}

//     __
//    |  ''--..     pulled far down one face, and hardly into the other
#[test]
fn a_wedge_of_unlike_sides_is_as_thin_as_the_narrower() {
    let mesh = cube();
    with_contacts(&mesh.as_mesh(), |_, view, topology, faces| {
        let edge = side(view, [EDGE[1], EDGE[0]]);
        let wedge = Wedge::new(view, faces, [edge, topology.twin[edge]]).unwrap();
        let into = [edge, topology.twin[edge]].map(|side| {
            let normal = faces.normal[side.triangle()];
            if normal == DVec3::Z { DVec3::NEG_Y } else { DVec3::NEG_Z }
        });
        let (widths, tolerance) = ([0.2, 0.02], 1e-6);
        let cut = |[one, two]: [f64; 2]| {
            let line = EDGE.map(|at| wide(at) + into[0] * one + into[1] * two);
            wedge.clip(line, widths, tolerance).is_some()
        };
        assert!(cut([0.1, 0.0099]) && !cut([0.1, 0.0101]), "on its middle");
        assert!(cut([0.19, 0.0]) && !cut([0.0, 0.19]) && cut([0.0, 0.019]));
        // Its corners are around all of that.
        let [_, far, deep] = wedge.corners(widths, tolerance);
        assert!(far.distance(into[0] * 0.2) < 1e-4 && deep.distance(into[1] * 0.02) < 1e-4);
    });
}

#[test]
fn what_lies_on_the_chamfer_but_for_rounding_is_covered() {
    let mesh = cube();
    with_contacts(&mesh.as_mesh(), |_, view, topology, faces| {
        let edge = side(view, [EDGE[1], EDGE[0]]);
        let wedge = Wedge::new(view, faces, [edge, topology.twin[edge]]).unwrap();
        let along = |by: DVec3| [EDGE[1], EDGE[0]].map(|at| wide(at) - by);
        let sides = [along(DVec3::Y * 0.1), along(DVec3::Z * 0.1)];
        // In front the face goes down, on top it goes back.
        let front = faces.normal[edge.triangle()] == DVec3::Z;
        let cut = Cut::new(&wedge, if front { sides } else { [sides[1], sides[0]] });
        let uncovers = |depth: f64| {
            let place = wedge.place(DVec3::new(0.0, 1.0 - depth, 1.0 - depth));
            cut.uncovers(&place, 1e-6)
        };
        assert!(uncovers(0.049) && !uncovers(0.05 - 1e-8) && !uncovers(0.051));
    });
}

// What is found was cut off at the tolerance, and so lies that far beside the chamfer, but for rounding.
#[test]
fn what_is_covered_to_within_rounding_of_the_tolerance_is_kept() {
    let (mesh, behind) = (cube(), EDGE.map(|[x, y, z]| [x, y, z - 0.04]));
    let held = [Held { from: behind[0], to: behind[1], radius: 0.0 }];
    let options = Options { width: Width::Units(0.1), ..Options::default() };
    let stages = crate::stages::stages_of_mesh(Mesh { held: &held, ..mesh.as_mesh() }, &options);
    let (surface, view) = (stages.surface(), &stages.view);
    let edge = side(view, [EDGE[1], EDGE[0]]);
    let hard = stages.edges.hard.ids().find(|&e| stages.edges.hard[e].sides.contains(&edge));
    let sides = stages.edges.hard[hard.unwrap()].sides;
    let wedge = Wedge::new(view, surface.faces, sides).unwrap();
    let along = |by: DVec3| wedge.ends().map(|at| at - by);
    let is_kept = |beyond: f64| {
        // So wide on top that the chamfer runs so far beyond the line.
        let wide = 0.1 * (behind[0][2].mul_add(-1.0, 1.0) as f64 + beyond) / (0.1 - beyond);
        let (front, top) = (along(DVec3::Y * 0.1), along(DVec3::Z * wide));
        let is_front = surface.faces.normal[sides[0].triangle()] == DVec3::Z;
        let pulled = if is_front { [front, top] } else { [top, front] };
        stages.rests.are_kept(hard.unwrap(), &wedge, pulled)
    };
    let (tolerance, step) = (tolerance(view), view.resolution);
    assert!(is_kept(tolerance + 0.5 * step) && !is_kept(tolerance + 1.5 * step));
}

#[test]
fn of_many_slanted_borders_few_are_asked() {
    let sides = 2000_u32;
    let (points, indices) = crate::stages::zigzag_cone(sides);
    let mesh = crate::stages::split(&points, &indices);
    let stages = crate::stages::stages_of(&mesh, 1e-4);
    let contacts = contacts(&stages.view, &stages.topology, &stages.faces, &Unwatched).unwrap();
    let ends = |side: Corner| [side, side.next()].map(|end| stages.view.position_at(end));
    let along = |border: Corner| contacts.borders_along(ends(border)).flatten();
    assert!(contacts.borders().all(|border| along(border).any(|other| other == border)));
    let asked: usize = contacts.borders().map(|border| along(border).count()).sum();
    assert!(asked < 3 * sides as usize, "{asked} along {sides} borders");
    let ridges = stages.edges.hard.iter().map(|edge| ends(edge.sides[0]));
    let beside: usize = ridges.map(|ends| contacts.beside_edge(ends, 1e-4).count()).sum();
    assert!(beside < 20 * sides as usize, "{beside} beside {sides} ridges");
}

//    3-------2       a roof that is open on the left, and a flag on its border: of the two rims from 3
//   /|\      |       to 0 one is the edge's own, and the other rests on it, whichever is told first
//  6 | 0-----1
#[test]
fn of_rims_at_one_place_each_is_asked_whether_it_is_own() {
    let points = [
        [0.0, 0.0, 0.0],
        [2.0, 0.0, 0.0],
        [2.0, 0.0, -2.0],
        [0.0, 0.0, -2.0],
        [2.0, -2.0, 0.0],
        [0.0, -2.0, 0.0],
        [-1.0, 1.0, -1.0],
    ];
    let (roof, flag): ([u32; 12], [u32; 3]) = ([0, 1, 2, 0, 2, 3, 0, 5, 4, 0, 4, 1], [3, 0, 6]);
    for (indices, rests) in [
        (roof.to_vec(), false),
        ([&roof[..], &flag].concat(), true),
        ([&flag[..], &roof].concat(), true),
    ] {
        let mesh = crate::stages::split(&points, &indices);
        with_contacts(&mesh.as_mesh(), |contacts, view, topology, faces| {
            let edge = side(view, [points[0], points[1]]);
            let sides = [edge, topology.twin[edge]];
            let beside = contacts.beside(view, topology, faces, (sides, [0.1; 2]));
            // The flag's other sides touch the end alone.
            let is_long = |place: &wedge::Place| place.into.max_element() > 0.05;
            assert_eq!(beside.as_flattened().iter().any(is_long), rests, "{indices:?}");
        });
    }
}
