//! Hard edges whose two sides share no edge, and faces that are inside out: none is silently missing,
//! and those that lie on each other are chamfered.

use chamfer::check::{Rule, check, compare};
use chamfer::{
    Chamfered, EdgeFactor, Factors, Held, Mesh, MeshBuffers, Options, Outcome, Piece, Reason,
    UvBuffer, Verify, Width, chamfer, shapes,
};

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

/// How many pieces of source triangles lie beside no earlier one of theirs.
fn apart(result: &Chamfered) -> usize {
    let source = |piece: &Piece| result.triangle_sources[piece.triangle as usize].index;
    let shared = |one: &Piece, other: &Piece| {
        one.corners.iter().filter(|corner| other.corners.contains(corner)).count()
    };
    let is_apart = |(place, piece): &(usize, &Piece)| {
        let mut earlier = result.pieces[..*place].iter().filter(|one| source(one) == source(piece));
        let is_first = earlier.clone().next().is_none();
        !is_first && !earlier.any(|one| shared(one, piece) == 2)
    };
    result.pieces.iter().enumerate().filter(is_apart).count()
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

/// The ends of all hard edges along the roof's edge, left one first, with what became of each.
fn told(mesh: &MeshBuffers, result: &Chamfered) -> Vec<([f32; 2], Outcome, [f32; 2])> {
    let mut told: Vec<_> = (result.verdicts.iter())
        .map(|verdict| {
            let [from, to] = verdict.vertices.map(|vertex| mesh.positions[vertex as usize][0]);
            let [one, other] = verdict.widths;
            let is_onward = from < to;
            let ends = if is_onward { [from, to] } else { [to, from] };
            (ends, verdict.outcome, if is_onward { [one, other] } else { [other, one] })
        })
        .collect();
    told.sort_by(|(one, ..), (other, ..)| one.partial_cmp(other).unwrap());
    told
}

const FULL: (Outcome, [f32; 2]) = (Outcome::Full, [0.05; 2]);

#[test]
fn an_edge_that_is_one_above_and_several_below_is_chamfered_as_one() {
    for columns in [&[0.0, 1.0, 4.0][..], &[0.0, 1.0, 2.0, 3.0, 4.0]] {
        let mesh = roof_on_wall(columns, &[[0.0, 4.0]], FRONT);
        let result = chamfered(&mesh);
        assert_eq!(told(&mesh, &result), [([0.0, 4.0], FULL.0, FULL.1)], "{columns:?}");
        // The roof's edge went back all along, and the wall's down.
        let moved = |from: Point, by: Point| [0, 1, 2].map(|k| from[k] + by[k]);
        for x in columns.iter().map(|&x| [x, 0.0, 0.0]) {
            let at = |by: Point| result.mesh.positions.contains(&moved(x, by));
            assert!(at([0.0, 0.0, -0.05]) && at([0.0, -0.05, 0.0]), "{x:?}");
        }
        assert_eq!(result.pieces.len(), columns.len() - 1);
        let alone = compare(&mesh.as_mesh(), &result.mesh.as_mesh(), Verify::Full);
        assert!(alone.is_sound() && alone.unchecked.is_empty(), "{alone}");
    }
}

//  A-------.---B       of edges that overlap, each longer one
//  .---.-------.
#[test]
fn a_triangle_that_is_but_a_line_is_no_side_of_an_edge() {
    let mut mesh = roof_on_wall(&[0.0, 1.0, 2.0, 3.0], &[[0.0, 3.0]], FRONT);
    let alone = told(&mesh, &chamfered(&mesh));
    for [from, to] in [[[0.0; 3], [3.0, 0.0, 0.0]], [[3.0, 0.0, 0.0], [0.0; 3]]] {
        let first = mesh.positions.len() as u32;
        mesh.positions.extend([from, to]);
        mesh.normals.extend([UP; 2]);
        mesh.indices.extend([first, first, first + 1]);
        mesh.submesh_index_counts[0] += 3;
        assert_eq!(told(&mesh, &chamfered(&mesh)), alone);
    }
}

#[test]
fn edges_that_overlap_are_chamfered() {
    let mesh = roof_on_wall(&[0.0, 1.0, 4.0], &[[0.0, 3.0], [3.0, 4.0]], FRONT);
    let result = chamfered(&mesh);
    let all = [([0.0, 3.0], FULL.0, FULL.1), ([1.0, 4.0], FULL.0, FULL.1)];
    assert_eq!(told(&mesh, &result), all);
}

//  A-------.-------B   the wall's end at B is too low to be put together with the roof's: of its edge
//  .---.-----------.   a part is told with the roof's first one, and the rest has no second side
#[test]
fn what_is_told_with_another_edge_is_not_told_twice() {
    let mut mesh = roof_on_wall(&[0.0, 1.0, 4.0], &[[0.0, 2.0], [2.0, 4.0]], FRONT);
    mesh.positions[8..]
        .iter_mut()
        .filter(|at| **at == [4.0, 0.0, 0.0])
        .for_each(|at| at[1] = -1e-5);
    let result = chamfered(&mesh);
    assert_eq!(result.totals.chamfered + result.totals.narrowed, 1);
    assert_eq!(left(&mesh, &result, Reason::TJunction), [[[1.0, 0.0, 0.0], [4.0, -1e-5, 0.0]]]);
}

//  A---------------B   a roof over a wall of two columns, and half as long a roof over a wall in the same
//  A-------.           place: these have both their sides, and more than two would lie there
#[test]
fn beside_an_edge_with_both_sides_nothing_is_brought_together() {
    let one = roof_on_wall(&[0.0, 2.0], &[[0.0, 2.0]], FRONT);
    let mut mesh = roof_on_wall(&[0.0, 1.0, 4.0], &[[0.0, 4.0]], FRONT);
    let first = mesh.positions.len() as u32;
    mesh.positions.extend(&one.positions);
    mesh.normals.extend(&one.normals);
    mesh.indices.extend(one.indices.iter().map(|index| index + first));
    mesh.submesh_index_counts = vec![mesh.indices.len() as u32];
    let result = chamfered(&mesh);
    assert_eq!(left(&mesh, &result, Reason::TJunction), [[[0.0; 3], [4.0, 0.0, 0.0]]]);
}

/// The wall is shorter than the roof: what it leaves open stays a border.
#[test]
fn an_edge_with_a_second_side_on_a_part_of_it_is_chamfered_there() {
    let mesh = roof_on_wall(&[0.0, 1.0, 3.0], &[[0.0, 4.0]], FRONT);
    let result = chamfered(&mesh);
    let [(ends, outcome, [at_start, at_end])] = told(&mesh, &result)[..] else { panic!() };
    assert_eq!((ends, outcome, at_end), ([0.0, 4.0], Outcome::Narrowed, 0.0));
    assert!((at_start - 0.05).abs() < 1e-6);
}

/// Ends that only rounding has set apart are put together: one end of the wall is a billionth too low.
#[test]
fn sides_that_nearly_meet_are_chamfered() {
    for columns in [&[0.0, 4.0][..], &[0.0, 1.0, 4.0]] {
        let mut mesh = roof_on_wall(columns, &[[0.0, 4.0]], FRONT);
        mesh.positions[4..].iter_mut().for_each(|place| {
            place[1] -= if *place == [4.0, 0.0, 0.0] { 1e-9 } else { 0.0 };
        });
        let result = chamfered(&mesh);
        assert_eq!(result.totals.chamfered, result.totals.hard_edges, "{columns:?}");
        assert_eq!(result.totals.chamfered, 1);
    }
}

/// A speck between the two ends, no larger than what rounding has set them apart by, would lose its
/// area: so they stay apart.
#[test]
fn sides_that_nearly_meet_stay_apart_for_a_triangle_between_them() {
    let mut mesh = roof_on_wall(&[0.0, 4.0], &[[0.0, 4.0]], FRONT);
    mesh.positions[4..].iter_mut().for_each(|place| {
        place[1] -= if *place == [4.0, 0.0, 0.0] { 1e-9 } else { 0.0 };
    });
    let first = mesh.positions.len() as u32;
    mesh.positions.extend([[4.0, 0.0, 0.0], [4.0, -1e-9, 0.0], [4.0, 0.0, -1e-9]]);
    mesh.normals.extend([[1.0, 0.0, 0.0]; 3]);
    mesh.indices.extend([0, 1, 2].map(|corner| first + corner));
    mesh.submesh_index_counts = vec![mesh.indices.len() as u32];
    let result = chamfered(&mesh);
    assert_eq!(result.mesh.positions, mesh.positions);
}

/// Two walls back to back, of which one is longer: there is nothing to cut off between them.
#[test]
fn walls_back_to_back_stay_and_say_so() {
    let wall = |to: f32, normal: Point| {
        let corners = [[0.0, 0.0, 0.0], [to, 0.0, 0.0], [to, 1.0, 0.0], [0.0, 1.0, 0.0]];
        (
            if normal[2] > 0.0 {
                corners
            } else {
                [corners[0], corners[3], corners[2], corners[1]]
            },
            normal,
        )
    };
    let mesh = quads(&[wall(4.0, FRONT), wall(3.0, [0.0, 0.0, -1.0])]);
    let result = chamfered(&mesh);
    assert!(!left(&mesh, &result, Reason::TJunction).is_empty());
    assert_eq!(result.mesh.positions, mesh.positions);
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

/// A wall that is there twice: nobody can tell which of the two belongs to the roof.
#[test]
fn where_more_than_two_sides_lie_nothing_is_brought_together() {
    let mut mesh = roof_on_wall(&[0.0, 1.0, 4.0], &[[0.0, 4.0]], FRONT);
    let wall: Vec<u32> = mesh.indices[6..].to_vec();
    mesh.indices.extend(wall);
    mesh.submesh_index_counts = vec![mesh.indices.len() as u32];
    let result = chamfered(&mesh);
    assert_eq!(left(&mesh, &result, Reason::TJunction), [[[0.0; 3], [4.0, 0.0, 0.0]]]);
    assert_eq!(result.mesh.positions, mesh.positions);
}

//    .----------.
//   /          /|     a box whose right side has two faces, which share no edge with
//  .----------M |     the three faces that are one: all of its twelve edges are hard,
//  |          |\|     of two the sides are unlike
//  |          | M
//  .----------./
fn box_of_uneven_faces() -> MeshBuffers {
    let [low, high] = [[0.0; 3], [2.0, 1.0, 1.0]];
    let at = |x: u8, y: f32, z: u8| [[low, high][x as usize][0], y, f32::from(z)];
    quads(&[
        ([at(0, 0.0, 1), at(1, 0.0, 1), at(1, 1.0, 1), at(0, 1.0, 1)], FRONT),
        ([at(1, 0.0, 0), at(0, 0.0, 0), at(0, 1.0, 0), at(1, 1.0, 0)], [0.0, 0.0, -1.0]),
        ([at(0, 0.0, 0), at(0, 0.0, 1), at(0, 1.0, 1), at(0, 1.0, 0)], [-1.0, 0.0, 0.0]),
        ([at(0, 1.0, 1), at(1, 1.0, 1), at(1, 1.0, 0), at(0, 1.0, 0)], UP),
        ([at(0, 0.0, 0), at(1, 0.0, 0), at(1, 0.0, 1), at(0, 0.0, 1)], [0.0, -1.0, 0.0]),
        ([at(1, 0.0, 1), at(1, 0.0, 0), at(1, 0.5, 0), at(1, 0.5, 1)], [1.0, 0.0, 0.0]),
        ([at(1, 0.5, 1), at(1, 0.5, 0), at(1, 1.0, 0), at(1, 1.0, 1)], [1.0, 0.0, 0.0]),
    ])
}

/// What was open along both is closed, too.
/// Where nothing opens, nothing is brought together: not a vertex is added.
#[test]
fn without_a_width_the_mesh_stays_as_it_is() {
    let mesh = box_of_uneven_faces();
    for width in [0.0, 1e-9] {
        let options = Options::default().with_width(Width::Units(width));
        let result = chamfer(&mesh.as_mesh(), &options).unwrap();
        assert_eq!(result.mesh.positions, mesh.positions, "{width}");
        assert_eq!(result.mesh.indices, mesh.indices, "{width}");
    }
}

#[test]
fn a_box_of_uneven_faces_is_chamfered_as_a_box() {
    let mesh = box_of_uneven_faces();
    let result = chamfered(&mesh);
    assert_eq!((result.totals.hard_edges, result.totals.chamfered), (12, 12));
    let alone = compare(&mesh.as_mesh(), &result.mesh.as_mesh(), Verify::Full);
    assert!(alone.is_sound(), "{alone}");
    assert_eq!((alone.before.border_half_edges, alone.after.border_half_edges), (6, 0));
    assert_eq!(alone.after.hard_edges, 0);
    let on_long = result.mesh.positions.iter().filter(|place| place[1] == 0.5).count();
    assert_eq!(on_long, 6, "of front, back, and each of two faces at both ends");
}

/// The checker measures both sides of such an edge.
#[test]
fn a_width_that_is_told_wrong_is_found() {
    let mesh = roof_on_wall(&[0.0, 1.0, 4.0], &[[0.0, 4.0]], FRONT);
    for end in [0, 1] {
        for wrong in [0.99, 1.01] {
            let mut result = chamfered(&mesh);
            result.verdicts[0].widths[end] *= wrong;
            let findings = check(&mesh.as_mesh(), &result, Verify::Fast);
            assert_eq!(findings.count(Rule::Widths), 1, "{wrong} times at {end}");
        }
    }
}

/// The part of the wall at the left end is short, and its other end a hair off the roof's edge: what is
/// pulled far along is measured on that part as well as on the whole edge.
#[test]
fn beside_a_short_part_a_width_is_told_of_the_part_or_of_the_whole_edge() {
    let (short, above, along) = (0.02, 1e-5, 0.5);
    let mut mesh = roof_on_wall(&[0.0, short, 4.0], &[[0.0, 4.0]], FRONT);
    let standing = mesh.positions.iter_mut().filter(|at| **at == [short, 0.0, 0.0]);
    standing.for_each(|at| at[1] += above);
    let mut result = chamfered(&mesh);
    let at_end = result.mesh.positions.iter_mut().filter(|at| at[0] == 0.0);
    at_end.for_each(|at| at[0] += along);
    let [from, _] = result.verdicts[0].vertices.map(|vertex| mesh.positions[vertex as usize][0]);
    let end = usize::from(from != 0.0);
    let told = result.verdicts[0].widths[end];
    // The wall went down from a line that rises.
    let of_part = told + along * above / short / 2.0;
    for (width, wrong) in [(told, 0), (of_part, 0), (2.0 * of_part - told, 1), (0.99 * told, 1)] {
        result.verdicts[0].widths[end] = width;
        let findings = check(&mesh.as_mesh(), &result, Verify::Fast);
        assert_eq!(findings.count(Rule::Widths), wrong, "{width}");
    }
}

/// So many that the mesh is done block by block.
#[test]
fn a_field_of_such_boxes_is_chamfered_as_one_is() {
    let (one, count) = (box_of_uneven_faces(), 2400_u32);
    let mut field = MeshBuffers::default();
    for k in 0..count {
        let by = [(k % 50) as f32 * 4.0, 0.0, (k / 50) as f32 * 4.0];
        let moved = |place: &Point| [0, 1, 2].map(|axis| place[axis] + by[axis]);
        let first = field.positions.len() as u32;
        field.positions.extend(one.positions.iter().map(moved));
        field.normals.extend(&one.normals);
        field.indices.extend(one.indices.iter().map(|index| index + first));
    }
    field.submesh_index_counts = vec![field.indices.len() as u32];
    let options = Options::default().with_width(Width::Units(0.05)).with_verify(Verify::Fast);
    let result = chamfer(&field.as_mesh(), &options).unwrap();
    let findings = check(&field.as_mesh(), &result, Verify::Fast);
    assert!(findings.is_sound(), "{findings}");
    assert_eq!((result.totals.hard_edges, result.totals.chamfered), (12 * count, 12 * count));
    assert_eq!(findings.after.border_half_edges, 0);
}

/// A new vertex shows what the edge showed there.
#[test]
fn textures_and_colours_run_on_along_an_edge_that_gets_vertices() {
    let mut mesh = roof_on_wall(&[0.0, 1.0, 2.5, 4.0], &[[0.0, 4.0]], FRONT);
    let values = mesh.positions.iter().flat_map(|&[x, y, z]| [x / 4.0, (y + z) / 4.0]).collect();
    mesh.uvs[0] = UvBuffer { components: 2, values };
    mesh.colors = mesh.positions.iter().map(|&[x, _, z]| [x / 4.0, -z / 4.0, 0.5, 1.0]).collect();
    let result = chamfered(&mesh);
    assert_eq!(result.totals.chamfered, 1);
    let roof = |vertex: &usize| result.mesh.normals[*vertex] == UP;
    let all: Vec<usize> = (0..result.mesh.positions.len()).filter(roof).collect();
    assert_eq!(all.len(), 6, "the corners of the roof, and two between");
    for vertex in all {
        let [x, _, z] = result.mesh.positions[vertex];
        let [u, v] = [0, 1].map(|k| result.mesh.uvs[0].values[2 * vertex + k]);
        let [red, green, ..] = result.mesh.colors[vertex];
        let off = [u - x / 4.0, v - z / 4.0, red - x / 4.0, green + z / 4.0];
        assert!(off.iter().all(|off| off.abs() < 1e-6), "{off:?} at {x}, {z}");
        let source = result.vertex_sources.get(vertex).surface;
        assert!(source.vertices.iter().all(|&v| v < 4), "the roof's own: {source:?}");
    }
}

/// The width of the one chamfer of a roof, and of its mesh told as it is.
fn widths_of(mesh: &MeshBuffers, factors: Factors) -> [f32; 2] {
    let options = Options::default().with_width(Width::Units(0.05)).with_verify(Verify::Full);
    let mesh = Mesh { factors, ..mesh.as_mesh() };
    let result = chamfer(&mesh, &options).unwrap();
    let findings = check(&mesh, &result, Verify::Full);
    assert!(findings.is_sound(), "{findings}");
    let [verdict] = result.verdicts[..] else { panic!("{:?}", result.verdicts) };
    if verdict.outcome == Outcome::Skipped {
        assert_eq!(result.mesh.positions, mesh.positions);
    }
    verdict.widths
}

/// By its submesh, by the mask of its vertices, or by name.
#[test]
fn factors_of_an_edge_go_for_all_that_lies_on_it() {
    let mut mesh = roof_on_wall(&[0.0, 1.0, 4.0], &[[0.0, 4.0]], FRONT);
    let is_near = |widths: [f32; 2], expected: [f32; 2]| {
        let off = [0, 1].map(|end| (widths[end] - expected[end]).abs());
        assert!(off.iter().all(|off| *off < 1e-6), "{widths:?} is not {expected:?}");
    };
    let named = |vertices: [u32; 2], factor| [EdgeFactor { vertices, factor }];
    let edges = named([1, 0], 0.5);
    is_near(widths_of(&mesh, Factors { edges: &edges, ..Factors::default() }), [0.025; 2]);
    let edges = named([1, 2], 1.0);
    is_near(widths_of(&mesh, Factors { edges: &edges, ..Factors::default() }), [0.0; 2]);
    let vertices: Vec<f32> = mesh.positions.iter().map(|[x, ..]| 1.0 - x / 8.0).collect();
    let tapered = widths_of(&mesh, Factors { vertices: &vertices, ..Factors::default() });
    is_near(tapered, [0.05, 0.025]);
    mesh.submesh_index_counts = vec![6, 12];
    let factors = Factors { submeshes: &[1.0, 0.5], ..Factors::default() };
    is_near(widths_of(&mesh, factors), [0.025; 2]);
}

/// The mesh is measured ten times as long: the chamfer is as wide there as anywhere.
#[test]
fn a_stretched_edge_is_brought_together_as_well() {
    let mesh = roof_on_wall(&[0.0, 1.0, 4.0], &[[0.0, 4.0]], FRONT);
    let options = Options::default().with_width(Width::Units(0.05)).with_scale([
        [10.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [0.0, 0.0, 2.0],
    ]);
    let result = chamfer(&mesh.as_mesh(), &options).unwrap();
    let findings = check(&mesh.as_mesh(), &result, Verify::Full);
    assert!(findings.is_sound(), "{findings}");
    assert_eq!((result.totals.hard_edges, result.totals.chamfered), (1, 1));
    assert!(result.mesh.positions.contains(&[1.0, 0.0, -0.025]));
}

/// Something rests on the middle of a long edge: its chamfer ends beside that.
#[test]
fn what_rests_on_a_part_of_a_long_edge_stays_covered() {
    let mesh = roof_on_wall(&[0.0, 1.0, 4.0], &[[0.0, 4.0]], FRONT);
    let held = [Held { from: [2.0, -0.5, 0.0], to: [2.5, -0.5, 0.0], radius: 0.52 }];
    let held_mesh = Mesh { held: &held, ..mesh.as_mesh() };
    let options = Options::default().with_width(Width::Units(0.05)).with_verify(Verify::Full);
    let result = chamfer(&held_mesh, &options).unwrap();
    let findings = check(&held_mesh, &result, Verify::Full);
    assert!(findings.is_sound(), "{findings}");
    let [verdict] = result.verdicts[..] else { panic!("{:?}", result.verdicts) };
    assert_eq!((verdict.outcome, verdict.reason), (Outcome::Narrowed, Reason::Contact));
}

/// The same on parts of a side that has been brought together with others: pieces of a piece.
#[test]
fn all_pieces_of_a_triangle_lie_beside_an_earlier_one() {
    let mut most = 0;
    for place in 0..32 {
        let (width, at) = (Width::Units(0.02), 0.125 * place as f32);
        let mesh = roof_on_wall(&[0.0, 1.0, 2.5, 4.0], &[[0.0, 4.0]], FRONT);
        let held = [Held { from: [at, -0.5, 0.0], to: [at + 0.1, -0.5, 0.0], radius: 0.51 }];
        let mesh = Mesh { held: &held, ..mesh.as_mesh() };
        let result = chamfer(&mesh, &Options::default().with_width(width)).unwrap();
        assert_eq!(apart(&result), 0, "{at}");
        most = most.max(result.pieces.len());
    }
    assert!(most > 7, "{most}");
}

//  .-----------.      of a wide round chamfer: M goes back as far as to the diagonal of the roof, so
//  |      .-'  |      that it is on a side of its triangle again
//  A--M--------B
#[test]
fn a_vertex_that_slides_onto_another_side_was_pulled_all_the_same() {
    let mesh = roof_on_wall(&[0.0, 1.0, 4.0], &[[0.0, 4.0]], FRONT);
    let options = Options::default().with_width(Width::Units(0.5)).with_segments(2);
    let mut result = chamfer(&mesh.as_mesh(), &options).unwrap();
    let places = |result: &Chamfered| {
        let findings = check(&mesh.as_mesh(), result, Verify::Full);
        let alone = compare(&mesh.as_mesh(), &result.mesh.as_mesh(), Verify::Full);
        [findings, alone].map(|findings| findings.count(Rule::Place))
    };
    assert_eq!(places(&result), [0, 0]);
    let is_rounded = |at: &Point| at[0] == 1.0 && at[1] < 0.0 && at[2] < 0.0 && at[1] > -0.5;
    let middle = result.mesh.positions.iter().position(is_rounded).unwrap();
    result.mesh.positions[middle] = [1.0, 1.0, 1.2];
    assert_eq!(places(&result), [1, 1], "three widths away");
}

//  .--------.      a roof whose back leads down to the front, to where its edge will be cut off and
//  |'.      |      through the wall; `reach` is how far it comes out there
//  A--'.M---B
fn roof_with_a_fin(reach: f32) -> MeshBuffers {
    let mut mesh = roof_on_wall(&[0.0, 1.0, 4.0], &[[0.0, 4.0]], FRONT);
    let first = mesh.positions.len() as u32;
    let fin = [[0.5, 0.0, -2.0], [3.5, 0.0, -2.0], [3.5, -0.045, reach], [0.5, -0.045, reach]];
    mesh.positions.extend(fin);
    mesh.normals.extend([[0.0, -1.0, 0.0]; 4]);
    // It shares the corners of the roof's back.
    for (own, roof) in [(0, 3), (1, 2)] {
        mesh.positions[(first + own) as usize] = mesh.positions[roof];
    }
    mesh.indices.extend([0, 1, 2, 0, 2, 3].map(|corner| first + corner));
    mesh.submesh_index_counts = vec![mesh.indices.len() as u32];
    mesh
}

/// What lies on each other becomes one solid: what cut each other before may do so then, and nothing
/// else.
#[test]
fn of_parts_that_are_brought_together_only_those_may_cut_that_did() {
    let options = Options::default().with_width(Width::Units(0.05));
    let cuts = |mesh: &MeshBuffers, result: &Chamfered| {
        let findings = check(&mesh.as_mesh(), result, Verify::Full);
        let count = findings.after.self_intersections.unwrap();
        (count > 0, findings.count(Rule::SelfIntersection) > 0)
    };
    let through = roof_with_a_fin(1.0);
    let result = chamfer(&through.as_mesh(), &options).unwrap();
    assert!(result.totals.chamfered + result.totals.narrowed > 0, "{:?}", result.totals);
    assert_eq!(cuts(&through, &result), (true, false), "they cut each other before");

    let behind = roof_with_a_fin(-0.5);
    let mut result = chamfer(&behind.as_mesh(), &options).unwrap();
    assert_eq!(cuts(&behind, &result), (false, false));
    let ends = result.mesh.positions.iter_mut().filter(|at| at[1] == -0.045);
    ends.for_each(|at| at[2] = 1.0);
    assert_eq!(cuts(&behind, &result), (true, true));
}

//  A-------.---B       of edges that overlap, the end at x = 1 of the wall's stands in the middle of the
//  .---.-------.       roof's, and what that is there nobody tells
#[test]
fn a_width_in_the_middle_of_another_edge_is_at_least_half_of_what_is_seen() {
    let mesh = roof_on_wall(&[0.0, 1.0, 4.0], &[[0.0, 3.0], [3.0, 4.0]], FRONT);
    let result = chamfered(&mesh);
    let wide = |times: [f32; 2], edge: usize| {
        let mut result = result.clone();
        let widths = &mut result.verdicts[edge].widths;
        *widths = [widths[0] * times[0], widths[1] * times[1]];
        check(&mesh.as_mesh(), &result, Verify::Fast).count(Rule::Widths)
    };
    let x = |vertex: u32| mesh.positions[vertex as usize][0];
    let lower = result.verdicts.iter().position(|v| v.vertices.map(x).contains(&1.0)).unwrap();
    let within = result.verdicts[lower].vertices.map(x).iter().position(|&x| x == 1.0).unwrap();
    let times = |at_end: f32| if within == 0 { [at_end, 1.0] } else { [1.0, at_end] };
    let found = [1.0, 0.6, 2.0, 0.4].map(|by| wide(times(by), lower));
    assert_eq!(found, [0, 0, 0, 1]);
    let elsewhere = |by: f32| if within == 0 { [1.0, by] } else { [by, 1.0] };
    assert_eq!(wide(elsewhere(0.9), lower), 1, "where both end");
}

/// What a verdict may leave open of an edge that shares no side: that its sides went along with others.
#[test]
fn an_edge_that_is_left_has_no_widths() {
    let mut mesh = roof_on_wall(&[0.0, 1.0, 4.0], &[[0.0, 4.0]], FRONT);
    let wall: Vec<u32> = mesh.indices[6..].to_vec();
    mesh.indices.extend(wall);
    mesh.submesh_index_counts = vec![mesh.indices.len() as u32];
    let mut result = chamfered(&mesh);
    assert_eq!(result.verdicts[0].reason, Reason::TJunction);
    result.verdicts[0].widths = [0.0, 0.05];
    assert_eq!(check(&mesh.as_mesh(), &result, Verify::Fast).count(Rule::Widths), 1);
}

/// A chamfer closes what is open along edges that lie on each other, and no other hole.
#[test]
fn a_hole_that_is_closed_beside_such_a_box_is_found() {
    let mut mesh = box_of_uneven_faces();
    let (first, open) = (mesh.positions.len() as u32, shapes::open_box());
    mesh.positions.extend(open.positions.iter().map(|&[x, y, z]| [x + 8.0, y, z]));
    mesh.normals.extend(&open.normals);
    mesh.indices.extend(open.indices.iter().map(|index| first + index));
    mesh.submesh_index_counts = vec![mesh.indices.len() as u32];
    let mut result = chamfered(&mesh);
    let found = |result: &Chamfered| {
        let alone = compare(&mesh.as_mesh(), &result.mesh.as_mesh(), Verify::Fast);
        [check(&mesh.as_mesh(), result, Verify::Fast), alone]
            .map(|findings| findings.count(Rule::BorderLoops))
    };
    assert_eq!(found(&result), [0, 0]);
    // As a fan over what the chamfers have left of its corners.
    let at = |vertex: u32| result.mesh.positions[vertex as usize];
    let is_rim = |vertex: &u32| at(*vertex)[0] > 6.0 && at(*vertex)[1] == 1.0;
    let mut rim: Vec<u32> = (0..result.mesh.positions.len() as u32).filter(is_rim).collect();
    let turn = |vertex: u32| (at(vertex)[0] - 8.0).atan2(at(vertex)[2]);
    rim.sort_by(|&one, &other| turn(one).total_cmp(&turn(other)));
    rim.dedup_by_key(|vertex| at(*vertex));
    let lid: Vec<u32> = rim.windows(2).skip(1).flat_map(|w| [rim[0], w[0], w[1]]).collect();
    result.mesh.indices.extend(&lid);
    *result.mesh.submesh_index_counts.last_mut().unwrap() += lid.len() as u32;
    let source = chamfer::TriangleSource { kind: chamfer::TriangleKind::Corner, index: 0 };
    result.triangle_sources.extend(vec![source; lid.len() / 3]);
    assert_eq!(found(&result), [1, 1]);
}
