//! Slivers that exporters leave: triangles that are hardly more than a line, or nothing else. Each
//! mesh is the smallest one of its kind.

use chamfer::check::{Rule, check};
use chamfer::{Chamfered, MeshBuffers, Options, Reason, TriangleKind, Verify, Width, chamfer};

const UP: [f32; 3] = [0.0, 1.0, 0.0];

/// A mesh of triangles with vertices of their own, each a position and a normal.
fn triangles(triangles: &[[([f32; 3], [f32; 3]); 3]]) -> MeshBuffers {
    let corners = triangles.as_flattened();
    MeshBuffers {
        positions: corners.iter().map(|corner| corner.0).collect(),
        normals: corners.iter().map(|corner| corner.1).collect(),
        indices: (0..corners.len() as u32).collect(),
        submesh_index_counts: vec![corners.len() as u32],
        ..MeshBuffers::default()
    }
}

/// A triangle with one normal.
fn flat(points: [[f32; 3]; 3], normal: [f32; 3]) -> [([f32; 3], [f32; 3]); 3] {
    points.map(|point| (point, normal))
}

/// Chamfered soundly at both depths.
#[track_caller]
fn chamfered(mesh: &MeshBuffers, width: Width) -> Chamfered {
    let [_, full] = [Verify::Fast, Verify::Full].map(|verify| {
        let options = Options::default().with_width(width).with_verify(verify);
        let result = chamfer(&mesh.as_mesh(), &options).unwrap();
        let findings = check(&mesh.as_mesh(), &result, verify);
        assert!(findings.is_sound(), "{verify:?}: {findings}");
        result
    });
    full
}

//        N
//      / | \         a nearly flat sheet: across O-E normals differ by 1.7 degrees, and both by
//     W--O==E        half of that from those of the other triangles at O. The chamfer tapers to a
//      \ | /         point there.
//        S
#[test]
fn where_a_chamfer_tapers_both_normals_are_left_whatever_others_are_there() {
    let lean = |degrees: f32| {
        let (sin, cos) = degrees.to_radians().sin_cos();
        [0.0, cos, sin]
    };
    let [o, e, n, w, s] =
        [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [-1.0, 0.0, 0.0], [0.0, 0.0, 1.0]];
    let sheet = triangles(&[
        flat([o, n, w], UP),
        flat([o, w, s], UP),
        [(o, lean(-0.85)), (e, lean(-0.85)), (n, UP)],
        [(o, lean(0.85)), (s, UP), (e, lean(0.85))],
    ]);
    let result = chamfered(&sheet, Width::Units(0.1));
    assert_eq!(result.totals.chamfered, 1);
}

//  . .            a floor seen from above, with walls below a-b and b-c. At b the floor is flat; its
//  .   c --. d    other part, behind the line far-b-c, is shaded round. b is pulled over there, and
//  a . b  .       the flat part keeps its normal.
//   .  | .
//     far
#[test]
fn what_is_flat_keeps_its_normal_where_a_line_leads_away_from_it() {
    let [a, b, c] = [[-0.5, 0.0, 0.2], [0.0; 3], [0.0, 0.0, -0.2]];
    let (far, d) = ([0.0, 0.0, 30.0], [0.3, 0.0, 30.0]);
    let low = |[x, y, z]: [f32; 3]| [x, y - 1.0, z];
    let walls =
        [([a, b, low(a)], [-0.371_390_7, 0.0, -0.928_476_7]), ([b, c, low(b)], [-1.0, 0.0, 0.0])];
    let round = [(c, UP), (far, UP), (d, [-0.12, 0.992_774, 0.0])];
    let mut faces = vec![flat([b, a, far], UP), flat([c, b, far], UP), round];
    faces.extend(walls.map(|(points, normal)| flat(points, normal)));
    let result = chamfered(&triangles(&faces), Width::Units(0.1));
    assert_eq!(result.totals.narrowed + result.totals.chamfered, 2);
}

//  A-B ---------------- C     the upper border of a wall, with a line along it: C is a rounding
//  |                    |     nearer than A and B. Where A is pulled onto B, nothing is left of it.
//  |                    |
//  F ------------------ G
#[test]
fn a_line_keeps_the_area_that_it_has() {
    let nearer = -1.0 + 2.0 * f32::EPSILON;
    let [a, b, c] = [[-0.75, 0.5, -1.0], [-0.74, 0.5, -1.0], [0.0, 0.5, nearer]];
    let (f, g) = ([-0.75, 0.25, -1.0], [0.0, 0.25, nearer]);
    let behind = [-0.75, 0.5, -1.25];
    let (front, side) = ([0.0, 0.0, 1.0], [-1.0, 0.0, 0.0]);
    let wall = triangles(&[
        flat([f, a, behind], side),
        flat([a, f, g], front),
        flat([a, g, c], front),
        flat([b, a, c], front),
    ]);
    chamfered(&wall, Width::Units(0.02));
}

//  t---f       a narrow wall, and the seam b-f across it. The corner b goes towards r, past its own
//  | . |       triangle t-b-f, whose places are so large that single precision cannot hold what they
//  b---r       lead to.
#[test]
fn texture_places_of_any_size_stay_finite() {
    let [b, r] = [[0.0; 3], [0.01, 0.0, 0.0]];
    let [t, f] = [[0.0, 1.0, 0.0], [0.01, 1.0, 0.0]];
    let front = [0.0, 0.0, 1.0];
    let mut wall = triangles(&[
        flat([f, t, b], front),
        flat([f, b, r], front),
        flat([b, t, [0.0, 0.0, -1.0]], [-1.0, 0.0, 0.0]),
    ]);
    wall.uvs[0].components = 2;
    wall.uvs[0].values = vec![0.0; 2 * wall.positions.len()];
    wall.uvs[0].values[..6].copy_from_slice(&[3e38, -3e38, 0.0, 0.0, 2.5e38, -2.5e38]);
    let result = chamfered(&wall, Width::Units(0.1));
    assert!(result.mesh.uvs[0].values.iter().all(|value| value.is_finite()));
}

//  A---------B     the front of a box of 2 by 1 by 1, cut into so many parts, and seen from the
//  |    M    |     front: its top has one edge from A to B, and lines like A-M-B close the gap. They
//  |    |    |     have the normal that is given.
//  '----'----'
fn box_with_cut_front(parts: usize, normal: [f32; 3]) -> MeshBuffers {
    let at = |part: usize, y: f32| [2.0 * part as f32 / parts as f32, y, 1.0];
    let quad = |points: [[f32; 3]; 4], normal| {
        let [a, b, c, d] = points;
        [flat([a, b, c], normal), flat([a, c, d], normal)]
    };
    let [low, high] = [[0.0; 3], [2.0, 1.0, 0.0]];
    let (a, b) = (at(0, 1.0), at(parts, 1.0));
    let (left, right) = ([0.0, 1.0, 0.0], [2.0, 0.0, 0.0]);
    let mut faces = Vec::new();
    faces.extend(quad([low, at(0, 0.0), a, left], [-1.0, 0.0, 0.0]));
    faces.extend(quad([right, high, b, at(parts, 0.0)], [1.0, 0.0, 0.0]));
    faces.extend(quad([left, a, b, high], UP));
    faces.extend(quad([low, left, high, right], [0.0, 0.0, -1.0]));
    faces.push(flat([low, right, at(parts, 0.0)], [0.0, -1.0, 0.0]));
    for part in 0..parts {
        let [here, next] = [part, part + 1];
        let front = [at(here, 0.0), at(next, 0.0), at(next, 1.0), at(here, 1.0)];
        faces.extend(quad(front, [0.0, 0.0, 1.0]));
        faces.push(flat([low, at(next, 0.0), at(here, 0.0)], [0.0, -1.0, 0.0]));
        if part > 0 {
            faces.push(flat([a, at(here, 1.0), at(next, 1.0)], normal));
        }
    }
    triangles(&faces)
}

/// On a side of the line a sheet of two sides stands: which of them is behind the line is nobody's choice,
/// so it stays, whichever comes first.
#[test]
fn a_line_on_which_others_lie_stays_whatever_their_order() {
    let [a, m, tip] = [[0.0, 1.0, 1.0], [1.0, 1.0, 1.0], [0.5, 1.5, 1.5]];
    let slant = std::f32::consts::FRAC_1_SQRT_2;
    let mut mesh = box_with_cut_front(2, [1.0, 0.0, 0.0]);
    let sheet = triangles(&[
        flat([a, m, tip], [0.0, -slant, slant]),
        flat([m, a, tip], [0.0, slant, -slant]),
    ]);
    let first = mesh.positions.len() as u32;
    mesh.positions.extend(sheet.positions);
    mesh.normals.extend(sheet.normals);
    mesh.indices.extend(sheet.indices.iter().map(|index| index + first));
    mesh.submesh_index_counts[0] += 6;
    for _ in 0..mesh.indices.len() / 3 {
        mesh.indices.rotate_left(3);
        let totals = chamfered(&mesh, Width::Units(0.05)).totals;
        assert_eq!([totals.hard_edges, totals.chamfered], [18, 12]);
        assert_eq!([Reason::ZeroThickness, Reason::TJunction].map(|r| totals.skipped[r]), [3, 3]);
    }
}

/// Whichever face the lines belong to, all edges get the full width. Below, each part has an edge of
/// its own; above, too, where the lines are part of the top.
#[test]
fn a_line_between_an_edge_and_two_goes_along_with_their_chamfer() {
    for parts in 1..5 {
        for (normal, above) in [([0.0, 0.0, 1.0], 1), (UP, parts)] {
            let result = chamfered(&box_with_cut_front(parts, normal), Width::Units(0.05));
            assert_eq!(result.totals.chamfered as usize, 10 + parts + above, "{parts} {normal:?}");
            assert_eq!(result.totals.hard_edges, result.totals.chamfered);
        }
    }
}

/// A line whose normal is that of no face beside it is taken for a part of those along its short sides.
#[test]
fn a_line_that_is_shaded_like_no_face_goes_along_with_their_chamfer() {
    for parts in 2..5 {
        let mut mesh = box_with_cut_front(parts, [1.0, 0.0, 0.0]);
        for _ in 0..2 {
            let result = chamfered(&mesh, Width::Units(0.05));
            assert_eq!(result.totals.chamfered as usize, 10 + parts + 1, "{parts}");
            assert_eq!(result.totals.hard_edges, result.totals.chamfered);
            // Lines before the faces: their sides are then those that verdicts tell.
            mesh.indices.reverse();
            mesh.indices.chunks_exact_mut(3).for_each(<[u32]>::reverse);
        }
    }
}

/// A line that goes along with the edge beside it needs no verdict, but the edge does.
#[test]
fn the_edge_beside_a_line_has_a_verdict() {
    for parts in 2..5 {
        let mesh = box_with_cut_front(parts, [1.0, 0.0, 0.0]);
        let mut result = chamfered(&mesh, Width::Units(0.05));
        let is_top = |vertex: u32| mesh.positions[vertex as usize][1..] == [1.0, 1.0];
        let is_long = |[a, b]: [u32; 2]| {
            let [a, b] = [a, b].map(|vertex| mesh.positions[vertex as usize][0]);
            (a - b).abs() == 2.0
        };
        let top = result.verdicts.iter().position(|verdict| {
            verdict.vertices.into_iter().all(is_top) && is_long(verdict.vertices)
        });
        result.verdicts.remove(top.unwrap());
        result.totals.hard_edges -= 1;
        result.totals.chamfered -= 1;
        for source in result.triangle_sources.iter_mut() {
            if source.kind == TriangleKind::Edge && source.index as usize >= top.unwrap() {
                source.index = source.index.saturating_sub(1);
            }
        }
        let findings = check(&mesh.as_mesh(), &result, Verify::Fast);
        // The edge itself, and the lines' short sides.
        let sides = parts + 1;
        assert_eq!(findings.count(Rule::Verdicts), sides, "{parts}: {findings}");
    }
}

//  .-----------.     a box seen from above, on whose top a line A-M-B closes the gap between the face
//  |           |     behind and the two in front. It is shaded like none of them. The right one may
//  A-----M-----B     slope: it ends so much lower, and there is a wall along M-F
//  |     |     |
//  '-----F-----'
fn box_with_closed_gap(slope: f32) -> MeshBuffers {
    let low = 1.0 - slope;
    let [a, m, b] = [0.0, 1.0, 2.0].map(|x| [x, 1.0, 0.5]);
    let polygons: [&[[f32; 3]]; 12] = [
        &[[0.0, 1.0, 0.0], a, b, [2.0, 1.0, 0.0]],
        &[a, [0.0, 1.0, 1.0], [1.0, 1.0, 1.0], m],
        &[m, [1.0, low, 1.0], [2.0, low, 1.0], b],
        &[m, [1.0, 1.0, 1.0], [1.0, low, 1.0]],
        &[[0.0; 3], [0.0, 0.0, 0.5], a, [0.0, 1.0, 0.0]],
        &[[0.0, 0.0, 0.5], [0.0, 0.0, 1.0], [0.0, 1.0, 1.0], a],
        &[[2.0, 0.0, 0.0], [2.0, 1.0, 0.0], b, [2.0, 0.0, 0.5]],
        &[[2.0, 0.0, 0.5], b, [2.0, low, 1.0], [2.0, 0.0, 1.0]],
        &[[0.0; 3], [0.0, 1.0, 0.0], [2.0, 1.0, 0.0], [2.0, 0.0, 0.0]],
        &[[0.0; 3], [2.0, 0.0, 0.0], [2.0, 0.0, 0.5], [0.0, 0.0, 0.5]],
        &[[0.0, 0.0, 0.5], [2.0, 0.0, 0.5], [2.0, 0.0, 1.0], [1.0, 0.0, 1.0], [0.0, 0.0, 1.0]],
        &[[0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [1.0, low, 1.0], [1.0, 1.0, 1.0], [0.0, 1.0, 1.0]],
    ];
    let front = [[1.0, 0.0, 1.0], [2.0, 0.0, 1.0], [2.0, low, 1.0], [1.0, low, 1.0]];
    let mut faces = vec![flat([a, m, b], [1.0, 0.0, 0.0])];
    for points in polygons.into_iter().chain([&front[..]]) {
        for pair in points[1..].windows(2) {
            let triangle = [points[0], pair[0], pair[1]];
            let [p, q, r] = triangle.map(glam::Vec3::from);
            let normal = (q - p).cross(r - p);
            if normal != glam::Vec3::ZERO {
                faces.push(flat(triangle, normal.normalize().to_array()));
            }
        }
    }
    triangles(&faces)
}

#[test]
fn a_line_within_a_flat_face_is_no_edge() {
    let mesh = box_with_closed_gap(0.0);
    let result = chamfered(&mesh, Width::Units(0.05));
    assert_eq!((result.totals.hard_edges, result.totals.chamfered), (18, 18));
}

#[test]
fn a_line_beside_which_nothing_moves_stays_as_it_was() {
    let mesh = box_with_closed_gap(0.0);
    let options = Options::default().with_width(Width::Units(0.05)).with_angles(100.0, 180.0);
    let result = chamfer(&mesh.as_mesh(), &options).unwrap();
    assert_eq!(result.mesh, mesh);
}

/// The edge A-M in two, and two lines in a row for the one: that of A-M could go along.
fn cut_left_half(mesh: &mut MeshBuffers) {
    let [a, m, half] = [0.0, 1.0, 0.5].map(|x| [x, 1.0, 0.5]);
    let at = |vertex: u32| mesh.positions[vertex as usize];
    let mut faces = Vec::new();
    for triangle in mesh.indices.chunks_exact(3) {
        let normal = mesh.normals[triangle[0] as usize];
        let points = [0, 1, 2].map(|k| at(triangle[k]));
        let side = (0..3).find(|&k| points[k] == m && points[(k + 1) % 3] == a);
        match side.map(|k| points[(k + 2) % 3]) {
            Some(far) => faces.extend([flat([m, half, far], normal), flat([half, a, far], normal)]),
            None => faces.push(flat(points, normal)),
        }
    }
    faces.push(flat([a, half, m], [1.0, 0.0, 0.0]));
    *mesh = triangles(&faces);
}

/// Where the faces along its short sides bend at the vertex between, it can go along with neither.
#[test]
fn a_line_beside_faces_that_bend_says_t_junction() {
    for (is_cut, skipped) in [(false, 3), (true, 4)] {
        let mut mesh = box_with_closed_gap(0.25);
        if is_cut {
            cut_left_half(&mut mesh);
        }
        let result = chamfered(&mesh, Width::Units(0.05));
        assert_eq!(result.totals.skipped[Reason::TJunction], result.totals.skipped.total());
        assert_eq!(result.totals.skipped.total(), skipped);
    }
}

//      c
//     /|\        a card of no thickness, a-b-c on both sides, stands on the edge a-b of two open faces
//    / | \       that meet there, and so four sides share it
//   a--+--b
//   |  d  |
#[test]
fn a_card_on_the_edge_of_open_faces_makes_no_edge_more_crowded() {
    let [a, b, c] = [[0.0; 3], [3.0, 0.0, 0.0], [1.0, 2.0, 1.0]];
    let (d, e) = ([1.0, -2.0, 0.0], [2.0, 0.0, -3.0]);
    let normal = |[p, q, r]: [[f32; 3]; 3]| {
        let [p, q, r] = [p, q, r].map(glam::Vec3::from);
        (q - p).cross(r - p).normalize().to_array()
    };
    for faces in [&[[a, d, b], [a, b, e]][..], &[[a, d, b]], &[[a, b, e]]] {
        let all = [[a, b, c], [b, a, c]].into_iter().chain(faces.iter().copied());
        let all: Vec<_> = all.map(|points| flat(points, normal(points))).collect();
        for percent in [0.0001, 1.0, 5.0] {
            chamfered(&triangles(&all), Width::PercentOfExtent(percent));
        }
    }
}

//     b-------------c
//    /     A       /|      The line p-q-r lies along an edge of a box. Rounding has turned its normal off
//   p============q | d     those of A and B by more than a degree, so it has no soft side; but it is a part
//   |      B     r |/      of one of them, wherever p goes.
//   o------------s-
#[test]
fn a_line_that_rounding_has_turned_goes_along_with_the_face_that_it_is_shaded_like() {
    for degrees in [0.0, 1.1, 1.3, 88.7, 88.9, 90.0] {
        let [o, p, b, a] = [[0.0, 0.0, 1.0], [0.0, 1.0, 1.0], [0.0, 1.0, 0.0], [0.0; 3]];
        let [s, q, c, d] = [o, p, b, a].map(|[_, y, z]| [2.0, y, z]);
        let r = [2.0, 1.0 - 2e-7, 1.0];
        let (sin, cos) = f32::to_radians(degrees).sin_cos();
        let (front, left, right) = ([0.0, 0.0, 1.0], [-1.0, 0.0, 0.0], [1.0, 0.0, 0.0]);
        let (down, back) = ([0.0, -1.0, 0.0], [0.0, 0.0, -1.0]);
        let mesh = triangles(&[
            flat([p, q, c], UP),
            flat([p, c, b], UP),
            flat([p, r, q], [0.0, cos, sin]),
            flat([o, s, r], front),
            flat([o, r, p], front),
            flat([a, o, p], left),
            flat([a, p, b], left),
            flat([d, c, q], right),
            flat([d, q, r], right),
            flat([d, r, s], right),
            flat([a, d, s], down),
            flat([a, s, o], down),
            flat([a, b, c], back),
            flat([a, c, d], back),
        ]);
        chamfered(&mesh, Width::Units(0.1));
    }
}
