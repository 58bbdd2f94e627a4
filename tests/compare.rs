//! What the checker says of the pipeline's own results, as they are and after other tools had
//! their way with them.

#[path = "support/quads.rs"]
mod quads;

use chamfer::check::{Findings, Matching, MeasuredEdge, Rule, check, compare};
use chamfer::shapes;
use chamfer::{
    Chamfered, Held, Mesh, MeshBuffers, Options, Outcome, Piece, Reason, TriangleKind,
    TriangleSource, Verify, Width, chamfer,
};

use quads::quads;

const WIDTH: f32 = 0.05;

fn chamfered(before: &MeshBuffers) -> Chamfered {
    let options = Options::default().with_width(Width::Units(WIDTH));
    chamfer(&before.as_mesh(), &options).unwrap()
}

fn shapes() -> Vec<(&'static str, MeshBuffers)> {
    let mut all = shapes::demo_models();
    all.extend([
        ("plain_cube", shapes::plain_cube(1.0)),
        ("saddle", shapes::saddle()),
        ("open_box", shapes::open_box()),
        ("wedge_end", shapes::wedge_end()),
        ("pyramid", shapes::pyramid(5)),
        ("cube_field", shapes::cube_field(20)),
    ]);
    all
}

//    .---.---.---.---.     a sheet that folds by two degrees: the rows of a rounded chamfer nearly lie in
//   /   /   | \   \   \    its faces, and are no pieces of them
#[test]
fn rows_between_faces_that_hardly_bend_are_no_pieces() {
    let at = |x: f32, z: f32| [x, -0.018 * x.abs(), z];
    let places = [-2.0, -1.0, 0.0, 1.0].into_iter().flat_map(|x| [0.0, 1.0, 2.0].map(|z| (x, z)));
    let quad = |(x, z)| [at(x, z), at(x, z + 1.0), at(x + 1.0, z + 1.0), at(x + 1.0, z)];
    let sheet = quads(places.map(quad));
    let options = Options::default().with_width(Width::Units(0.02)).with_segments(4);
    let result = chamfer(&sheet.as_mesh(), &options).unwrap();
    assert_eq!(result.totals.chamfered, 3);
    let told = check(&sheet.as_mesh(), &result, Verify::Fast).edges;
    let found = compare(&sheet.as_mesh(), &result.mesh.as_mesh(), Verify::Fast);
    assert_eq!((found.matching, &found.edges), (Matching::Order, &told));
}

/// A permutation of the numbers below `count`.
fn shuffled(count: usize) -> Vec<usize> {
    let mut numbers: Vec<usize> = (0..count).collect();
    let mut state = 7_u32;
    for place in (1..count).rev() {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        numbers.swap(place, (state >> 8) as usize % (place + 1));
    }
    numbers
}

/// One submesh, its triangles, their first corners and the vertices in another order.
fn reordered(mesh: &MeshBuffers) -> MeshBuffers {
    let vertices = shuffled(mesh.positions.len());
    let mut place_of = vec![0; vertices.len()];
    vertices.iter().enumerate().for_each(|(place, &vertex)| place_of[vertex] = place as u32);
    let triangles = shuffled(mesh.indices.len() / 3);
    let turned = |&t: &usize| [0, 1, 2].map(|side| mesh.indices[3 * t + (side + t) % 3]);
    MeshBuffers {
        positions: vertices.iter().map(|&vertex| mesh.positions[vertex]).collect(),
        normals: vertices.iter().map(|&vertex| mesh.normals[vertex]).collect(),
        indices: triangles
            .iter()
            .flat_map(turned)
            .map(|vertex| place_of[vertex as usize])
            .collect(),
        submesh_index_counts: vec![mesh.indices.len() as u32],
        ..MeshBuffers::default()
    }
}

/// Without the streams that [`reordered`] drops.
fn bare(mesh: &MeshBuffers) -> MeshBuffers {
    MeshBuffers {
        tangents: Vec::new(),
        colors: Vec::new(),
        uvs: Default::default(),
        ..mesh.clone()
    }
}

fn compared(before: &MeshBuffers, after: &MeshBuffers) -> Findings {
    compare(&before.as_mesh(), &after.as_mesh(), Verify::Full)
}

/// What is found once `plant` has changed the pipeline's result.
fn broken(before: &MeshBuffers, plant: impl FnOnce(&mut Chamfered)) -> Vec<Rule> {
    let mut after = chamfered(before);
    plant(&mut after);
    let found = check(&before.as_mesh(), &after, Verify::Full);
    found.breaches.iter().map(|breach| breach.rule).collect()
}

#[test]
fn results_are_sound_with_and_without_provenance() {
    for (name, before) in shapes() {
        let after = chamfered(&before);
        let [told, inferred] =
            [check(&before.as_mesh(), &after, Verify::Full), compared(&before, &after.mesh)];
        assert!(told.is_sound() && inferred.is_sound(), "{name}: {told}{inferred}");
        assert_eq!(inferred.matching, Matching::Order, "{name}");
        assert_eq!(told.edges, inferred.edges, "{name}");
    }
}

#[test]
fn another_order_changes_nothing() {
    for (name, before) in shapes() {
        let before = bare(&before);
        let after = chamfered(&before).mesh;
        let [plain, other] = [compared(&before, &after), compared(&before, &reordered(&after))];
        assert!(other.is_sound(), "{name}: {other}");
        assert_eq!(other.matching, Matching::Geometry, "{name}");
        let found = |edge: &MeasuredEdge| plain.edges.contains(edge);
        assert!(other.edges.iter().all(found), "{name}");
        assert!(other.edges.len() * 2 > plain.edges.len(), "{name}: {}", other.edges.len());
    }
}

#[test]
fn defects_are_found_in_another_order_too() {
    let before = bare(&shapes::plain_cube(1.0));
    let after = chamfered(&before).mesh;
    let mut flipped = after.clone();
    flipped.indices.swap(3, 4);
    let found = compared(&before, &reordered(&flipped));
    assert_eq!((found.count(Rule::Flipped), found.count(Rule::Balance)), (1, 3), "{found}");
    let mut holed = after.clone();
    holed.indices.drain(3..6);
    holed.submesh_index_counts[0] -= 3;
    let found = compared(&before, &reordered(&holed));
    assert_eq!((found.count(Rule::Balance), found.lost), (3, 1), "{found}");
}

#[test]
fn two_triangles_that_change_places() {
    let before = bare(&shapes::cylinder(12));
    let mut after = chamfered(&before).mesh;
    (0..3).for_each(|side| after.indices.swap(side, 30 + side));
    let found = compared(&before, &after);
    assert!(found.is_sound(), "{found}");
}

#[test]
fn a_cube_measures_what_was_asked() {
    let before = shapes::plain_cube(1.0);
    let edges = compared(&before, &chamfered(&before).mesh).edges;
    assert_eq!(edges.len(), 12);
    for edge in edges {
        assert!(edge.is_chamfered() && (edge.length - 1.0).abs() < 1e-6);
        assert!(edge.distances.as_flattened().iter().all(|width| (width - WIDTH).abs() < 1e-6));
    }
}

#[test]
fn an_edge_that_is_left_measures_nothing() {
    let before = shapes::plain_cube(1.0);
    let edges = compared(&before, &before).edges;
    assert!(edges.iter().all(|edge| !edge.is_chamfered() && edge.widths() == [0.0; 2]));
}

#[test]
fn a_verdict_of_another_width() {
    let before = shapes::plain_cube(1.0);
    assert_eq!(broken(&before, |after| after.verdicts[4].widths[1] *= 1.01), [Rule::Widths]);
}

#[test]
fn a_verdict_that_an_edge_was_skipped_which_was_not() {
    let rules = broken(&shapes::plain_cube(1.0), |after| {
        after.verdicts[4].outcome = Outcome::Skipped;
        after.totals.chamfered -= 1;
        after.totals.skipped[Reason::NoRoom] += 1;
    });
    assert_eq!(rules, [Rule::Verdicts, Rule::Widths]);
}

#[test]
fn a_hard_edge_without_a_verdict() {
    let before = shapes::plain_cube(1.0);
    let rules = broken(&before, |after| {
        let last = after.verdicts.len() as u32 - 1;
        after.verdicts.pop();
        after.totals.hard_edges -= 1;
        after.totals.chamfered -= 1;
        for source in after.triangle_sources.iter_mut() {
            if source.kind == TriangleKind::Edge && source.index == last {
                source.kind = TriangleKind::Corner;
            }
        }
    });
    assert_eq!(rules, [Rule::Verdicts]);
}

#[test]
fn a_strip_with_a_normal_of_its_own() {
    let before = shapes::plain_cube(1.0);
    let rules = broken(&before, |after| {
        let strip = after.triangle_sources.iter().position(|s| s.kind == TriangleKind::Edge);
        let corners = 3 * strip.unwrap()..3 * strip.unwrap() + 3;
        let normals =
            after.mesh.indices[corners.clone()].iter().map(|&v| after.mesh.normals[v as usize]);
        let sum = normals.fold([0.0; 3], |sum: [f32; 3], n| [0, 1, 2].map(|k| sum[k] + n[k]));
        let length = sum.iter().map(|along| along * along).sum::<f32>().sqrt();
        for corner in corners {
            let vertex = after.mesh.indices[corner] as usize;
            after.mesh.indices[corner] = after.mesh.positions.len() as u32;
            after.mesh.positions.push(after.mesh.positions[vertex]);
            after.mesh.normals.push(sum.map(|along| along / length));
            let copy = after.vertex_sources.get(vertex);
            after.vertex_sources = after.vertex_sources.iter().chain([copy]).collect();
        }
    });
    assert_eq!(rules, [Rule::HardEdges]);
}

/// An open box on one of whose lower edges something rests in the middle: the triangles beside it
/// come in pieces.
///
/// ```text
///       a-----m--+===+--n-----b      chamfers from a to m and from n to b
/// ```
fn cut_box() -> (MeshBuffers, Chamfered) {
    let before = shapes::open_box();
    let rests = Held { from: [-0.1, 0.0, -1.0], to: [0.1, 0.0, -1.0], radius: 0.0 };
    let mesh = Mesh { held: &[rests], ..before.as_mesh() };
    let after = chamfer(&mesh, &Options::default().with_width(Width::Units(WIDTH))).unwrap();
    assert!(after.pieces.len() > 8, "{:?}", after.pieces);
    (before, after)
}

/// A vertex of pieces alone, inside a triangle that was cut, and the corners at it.
fn inside_a_cut_triangle(after: &Chamfered) -> (usize, Vec<usize>) {
    let corners_of = |piece: &Piece| 3 * piece.triangle as usize..3 * piece.triangle as usize + 3;
    let is_inside = |piece: &Piece, k: usize| piece.corners[k].iter().all(|weight| *weight > 0.0);
    let inner = after.pieces.iter().flat_map(|piece| {
        corners_of(piece).enumerate().filter(|&(k, _)| is_inside(piece, k)).map(|(_, c)| c)
    });
    let all: Vec<usize> = inner.collect();
    let vertex = after.mesh.indices[all[0]];
    let here = all.into_iter().filter(|&corner| after.mesh.indices[corner] == vertex).collect();
    (vertex as usize, here)
}

#[test]
fn pieces_of_cut_triangles_are_found_where_nothing_tells_of_them() {
    let (before, after) = cut_box();
    let [told, found] =
        [check(&before.as_mesh(), &after, Verify::Full), compared(&before, &after.mesh)];
    assert!(told.is_sound() && found.is_sound(), "{told}{found}");
    assert_eq!((found.matching, &found.edges), (Matching::Order, &told.edges));
}

#[test]
fn a_bent_piece_is_found() {
    let (before, mut after) = cut_box();
    let (vertex, _) = inside_a_cut_triangle(&after);
    let normal = after.mesh.normals[vertex];
    (0..3).for_each(|k| after.mesh.positions[vertex][k] += 0.01 * normal[k]);
    let found = compared(&before, &after.mesh);
    assert!(found.count(Rule::FlatFace) > 0, "{found}");
}

#[test]
fn pieces_that_gape_are_found() {
    let (before, mut after) = cut_box();
    let (vertex, corners) = inside_a_cut_triangle(&after);
    let mesh = &mut after.mesh;
    let [a, b] = [1, 2].map(|k| mesh.indices[corners[0] / 3 * 3 + (corners[0] + k) % 3] as usize);
    // Nearer to the other side of its piece, within the plane.
    let middle = [0, 1, 2].map(|k| (mesh.positions[a][k] + mesh.positions[b][k]) / 2.0);
    let nearer = [0, 1, 2].map(|k| 0.9 * mesh.positions[vertex][k] + 0.1 * middle[k]);
    mesh.indices[corners[0]] = mesh.positions.len() as u32;
    mesh.positions.push(nearer);
    mesh.normals.push(mesh.normals[vertex]);
    mesh.uvs[0].values.extend([0.0; 2]);
    mesh.tangents.extend(mesh.tangents.get(vertex).copied());
    let found = compared(&before, mesh);
    assert!(found.count(Rule::Gapes) >= 3, "{found}");
}

#[test]
fn a_strip_that_is_missing_beside_pieces_is_found() {
    let (before, mut after) = cut_box();
    let held = after.verdicts.iter().position(|v| v.reason == Reason::Contact).unwrap() as u32;
    let is_of_held = |s: &TriangleSource| s.kind == TriangleKind::Edge && s.index == held;
    let strip = after.triangle_sources.iter().position(is_of_held).unwrap();
    after.mesh.indices.drain(3 * strip..3 * strip + 3);
    after.mesh.submesh_index_counts[0] -= 3;
    let found = compared(&before, &after.mesh);
    assert!(found.count(Rule::Gapes) > 0, "{found}");
}
