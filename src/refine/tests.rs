use super::*;
use crate::check::{Rule, assert_sound, check, compare};
use crate::ids::Ring;
use crate::mesh::Held;
use crate::offsets::offsets;
use crate::options::{ChamferSubmesh, Options, Verify, Width};
use crate::report::{Chamfered, EdgeVerdict, Outcome, Reason, TriangleKind};
use crate::shapes;
use crate::threads::Threads;
use crate::view::view;
use crate::watch::Unwatched;
use crate::weld::weld;

/// The triangle 0, 1, 2 cut at vertices with these shares of its sides, numbered from 3 on.
fn cut_at(shares: [&[f64]; 3]) -> Vec<[u32; 3]> {
    let mut vertex = 2;
    let points = shares.map(|side| {
        let point = |&share: &f64| {
            vertex += 1;
            Point { vertex, share }
        };
        side.iter().map(point).collect()
    });
    let pieces = pieces([0, 1, 2], &points, None);
    assert_covers(&pieces);
    pieces.into_iter().map(|piece| piece.map(|(vertex, _)| vertex)).collect()
}

/// All pieces are turned as their triangle, and together as large.
fn assert_covers(pieces: &[[CutCorner; 3]]) {
    let area = |piece: &[CutCorner; 3]| {
        let [a, b, c] = piece.map(|(_, weights)| DVec3::from(weights));
        a.dot(b.cross(c))
    };
    assert!(pieces.iter().all(|piece| area(piece) > 0.0), "{pieces:?}");
    assert!((pieces.iter().map(area).sum::<f64>() - 1.0).abs() < 1e-12, "{pieces:?}");
}

/// ```text
///          2
///        / | \
///       /  |  \
///      0---3---1
/// ```
#[test]
fn a_vertex_on_one_side_halves_the_triangle() {
    assert_eq!(cut_at([&[0.5], &[], &[]]), [[0, 3, 2], [3, 1, 2]]);
    assert_eq!(cut_at([&[], &[0.5], &[]]), [[0, 1, 3], [0, 3, 2]]);
    assert_eq!(cut_at([&[], &[], &[0.5]]), [[3, 1, 2], [0, 1, 3]]);
}

/// ```text
///          2
///        / |`\
///       /  |  4        the second half is cut from 4, which lies on it
///      /   | / \
///     0----3----1
/// ```
#[test]
fn vertices_on_two_sides_leave_none_in_the_middle_of_a_side() {
    assert_eq!(cut_at([&[0.5], &[0.5], &[]]), [[0, 3, 2], [3, 4, 2], [3, 1, 4]]);
}

#[test]
fn vertices_on_all_sides_and_several_on_one() {
    assert_eq!(cut_at([&[0.5], &[0.5], &[0.5]]).len(), 4);
    assert_eq!(cut_at([&[0.2, 0.4, 0.9], &[0.1, 0.3], &[0.5, 0.6]]).len(), 8);
}

/// Where a wall of very many columns stands below a roof: a thread of few bytes of stack does it.
#[test]
fn so_many_on_one_side_that_no_call_can_be_made_for_each() {
    let shares: Vec<f64> = (1..20_000).map(|step| f64::from(step) / 20_000.0).collect();
    let cut = move || assert_eq!(cut_at([&shares, &[], &[]]).len(), 20_000);
    std::thread::Builder::new().stack_size(1 << 18).spawn(cut).unwrap().join().unwrap();
}

#[test]
fn a_triangle_without_any_stays() {
    let whole = [0, 1, 2].map(|k| (k, WHOLE[k as usize]));
    assert_eq!(pieces([0, 1, 2], &Default::default(), None), [whole]);
}

/// A box of 10 by 1 by 1.
fn bar() -> MeshBuffers {
    let mut bar = shapes::cube(1.0);
    bar.positions.iter_mut().for_each(|[x, _, _]| *x *= 10.0);
    bar
}

/// The edge of the bar that lies along its front at the top.
const FRONT: [f32; 2] = [0.5, 0.5];

/// The bar chamfered by 0.1 where something rests on its front edge from one place to another.
fn held(from: f32, to: f32) -> (MeshBuffers, Chamfered) {
    let bar = bar();
    let at = |x: f32| [x, FRONT[0], FRONT[1]];
    let held = [Held { from: at(from), to: at(to), radius: 0.0 }];
    let mesh = Mesh { held: &held, ..bar.as_mesh() };
    let options = Options { width: Width::Units(0.1), ..Options::default() };
    let result = crate::chamfer(&mesh, &options).unwrap();
    assert_sound("bar", &bar.as_mesh(), &result);
    let found = compare(&bar.as_mesh(), &result.mesh.as_mesh(), Verify::Full);
    assert!(found.is_sound() && found.unchecked.is_empty(), "{found}");
    (bar, result)
}

/// The verdict of the front edge, its widths from left to right.
fn of_front(bar: &MeshBuffers, result: &Chamfered) -> EdgeVerdict {
    let at = |vertex: u32| bar.positions[vertex as usize];
    let lies = |v: &&EdgeVerdict| v.vertices.iter().all(|&v| at(v)[1..] == FRONT);
    let mut verdict = *result.verdicts.iter().find(lies).unwrap();
    if at(verdict.vertices[0])[0] > at(verdict.vertices[1])[0] {
        verdict.widths.reverse();
    }
    verdict
}

/// How long the strips of the front edge are, together.
fn chamfered_length(bar: &MeshBuffers, result: &Chamfered) -> f32 {
    let number = result.verdicts.iter().position(|v| v.vertices == of_front(bar, result).vertices);
    let is_strip = |source: &crate::report::TriangleSource| {
        source.kind == TriangleKind::Edge && Some(source.index as usize) == number
    };
    let triangles = result.mesh.indices.chunks_exact(3).zip(&result.triangle_sources);
    // Each strip of two triangles has a side of both; one that ends in a point has one triangle.
    let length = |(triangle, _): (&[u32], _)| {
        let along = triangle.iter().map(|&v| result.mesh.positions[v as usize][0]);
        along.clone().fold(f32::MIN, f32::max) - along.fold(f32::MAX, f32::min)
    };
    let mut spans: Vec<f32> =
        triangles.filter(|(_, source)| is_strip(source)).map(length).collect();
    spans.sort_by(f32::total_cmp);
    spans.dedup_by(|one, other| (*one - *other).abs() < 0.05);
    spans.into_iter().sum()
}

/// ```text
///   -----------.         .------------    the pulled side
///   -------------=======--------------    = is held
/// ```
#[test]
fn an_edge_held_in_its_middle_keeps_chamfers_at_both_ends() {
    let (bar, result) = held(-0.5, 1.5);
    let verdict = of_front(&bar, &result);
    assert_eq!((verdict.outcome, verdict.reason), (Outcome::Narrowed, Reason::Contact));
    assert!(verdict.widths.iter().all(|width| (width - 0.1).abs() < 1e-6), "{verdict:?}");
    assert!(!result.pieces.is_empty());
    assert!(chamfered_length(&bar, &result) > 7.4);
    // All others are as wide as asked for.
    assert_eq!((result.totals.chamfered, result.totals.narrowed), (11, 1));
}

/// ```text
///          .--------------------------
///   ======----------------------------
/// ```
#[test]
fn an_edge_held_at_an_end_keeps_its_chamfer_from_there_on() {
    let (bar, result) = held(-5.0, -4.0);
    let verdict = of_front(&bar, &result);
    assert_eq!((verdict.outcome, verdict.reason), (Outcome::Narrowed, Reason::Contact));
    assert!((verdict.widths[1] - 0.1).abs() < 1e-6, "{verdict:?}");
    assert!(chamfered_length(&bar, &result) > 8.5);
}

#[test]
fn an_edge_held_all_along_stays_whole() {
    let (bar, result) = held(-5.0, 5.0);
    assert_eq!(of_front(&bar, &result).outcome, Outcome::Skipped);
    assert!(result.pieces.is_empty());
}

#[test]
fn what_is_told_of_a_piece_is_checked() {
    let (bar, result) = held(-0.5, 1.5);
    let broken = |plant: &dyn Fn(&mut Chamfered)| {
        let mut planted = result.clone();
        plant(&mut planted);
        let findings = check(&bar.as_mesh(), &planted, Verify::Fast);
        findings.breaches.iter().map(|breach| breach.rule).collect::<Vec<_>>()
    };
    let first = result.pieces[0].triangle as usize;
    assert_eq!(broken(&|_| ()), []);
    assert_eq!(broken(&|planted| planted.pieces.truncate(1)), [Rule::Origins]);
    assert_eq!(broken(&|planted| planted.pieces[0].corners.swap(0, 1)), [Rule::Origins]);
    assert_eq!(broken(&|planted| planted.pieces[0].triangle += 4), [Rule::Origins]);
    assert!(
        broken(&|planted| planted.mesh.indices.swap(3 * first, 3 * first + 1))
            .contains(&Rule::Flipped)
    );
    let widths = broken(&|planted| {
        planted.verdicts.iter_mut().for_each(|verdict| verdict.widths = [0.09; 2]);
    });
    assert_eq!(widths, [Rule::Widths]);
}

/// The blends of new vertices rebuild them from the source alone.
#[test]
fn provenance_tells_of_source_vertices() {
    let (bar, result) = held(-0.5, 1.5);
    for (vertex, source) in result.vertex_sources.iter().enumerate() {
        let Blend { vertices, weights } = source.surface;
        let terms = vertices.into_iter().zip(weights);
        let rebuilt: DVec3 =
            terms.map(|(v, weight)| wide(bar.positions[v as usize]) * f64::from(weight)).sum();
        let stored = wide(result.mesh.positions[vertex]);
        assert!(rebuilt.distance(stored) < 1e-5, "{vertex}: {rebuilt} is not {stored}");
    }
}

#[test]
fn without_need_nothing_is_cut() {
    let mut models = shapes::demo_models();
    models.extend([("l_shape", shapes::l_shape()), ("saddle", shapes::saddle())]);
    for (name, mesh) in models {
        let options = Options { width: Width::PercentOfExtent(0.5), ..Options::default() };
        let result = crate::chamfer(&mesh.as_mesh(), &options).unwrap();
        assert!(result.pieces.is_empty(), "{name}");
    }
}

fn shape_of(view: &View) -> Shape {
    let options = Options::default();
    crate::pipeline::shape(
        view,
        weld(&view.mesh, &Unwatched).unwrap(),
        &[],
        &options,
        (&Threads::default(), &mut |_| Ok(())),
    )
    .unwrap()
}

/// What is known of the bar before the limits, for a chamfer of 0.1.
fn with_offsets(bar: &MeshBuffers, check: impl FnOnce(&View, &Shape, IdVec<Sector, Offset>)) {
    let options = Options { width: Width::Units(0.1), ..Options::default() };
    let view = view(&bar.as_mesh(), &options).unwrap();
    let shape = shape_of(&view);
    let offsets =
        offsets(shape.surface(&view), shape.chamfers(), None, (&Threads::default(), &Unwatched))
            .unwrap();
    check(&view, &shape, offsets);
}

/// A corner that cannot move narrows the long one of its strips, which gets a vertex three widths
/// away; the short ones are near it all along.
/// ```text
///   b----+---------------        b cannot move
///   |
/// ```
#[test]
fn near_a_corner_that_stays_a_long_edge_gets_a_vertex() {
    with_offsets(&bar(), |view, shape, mut offsets| {
        assert_eq!(splits::splits(view, shape, &offsets, &Unwatched).unwrap(), []);
        let ring = shape.sectors.ring(Ring(0)).to_vec();
        ring.iter().for_each(|&sector| offsets[sector].vector = DVec3::ZERO);
        let corner = view.position_at(shape.sectors.fans[ring[0]].first);
        let [split] = &splits::splits(view, shape, &offsets, &Unwatched).unwrap()[..] else {
            panic!("one edge is long")
        };
        let [from, to] = [split.sides[0], split.sides[0].next()].map(|c| view.position_at(c));
        let at = from.lerp(to, split.at[0]);
        assert!((at.distance(corner) - 0.3).abs() < 1e-6 && split.at.len() == 1, "{split:?}");
        let refined = refine(view, shape, &offsets, &Unwatched).unwrap().unwrap();
        assert_eq!(refined.mesh.indices.len(), 3 * (12 + 2 * 3));
    });
}

/// What is told of the finer mesh is what the stages find on it.
#[test]
fn the_shape_of_a_finer_mesh_is_what_the_stages_find() {
    let mut models = shapes::demo_models();
    models.extend([("bar", bar()), ("open box", shapes::open_box())]);
    models.push(("cubes", shapes::extruding_cubes()));
    for (name, mesh) in models {
        with_offsets(&mesh, |view, coarse, _| {
            let hard = coarse.edges.hard.iter();
            let at = |k: usize| Few::from_slice([&[0.3][..], &[0.4, 0.7]][k % 2]);
            let splits = hard.map(|edge| edge.sides).enumerate().step_by(3);
            let splits: Vec<Split> = splits.map(|(k, sides)| Split { sides, at: at(k) }).collect();
            let refined = refined(&view.mesh, &splits, 0.0);
            let mesh = refined.as_mesh(&view.mesh);
            let options = Options { width: Width::Units(0.1), ..Options::default() };
            let fine = self::view(&mesh, &options).unwrap();
            let told = shape(&fine, &refined, coarse, &Unwatched).unwrap().unwrap();
            let found = shape_of(&fine);
            assert_eq!(told.topology.twin, found.topology.twin, "{name}");
            let same =
                |c: Corner| told.topology.cluster_at[c] == told.topology.cluster_at[c.next()];
            assert!(!told.topology.twin.ids().any(same), "{name}");
            assert_eq!(told.faces.normal, found.faces.normal, "{name}");
            assert_eq!(told.faces.lender, found.faces.lender, "{name}");
            let edges = |shape: &Shape| {
                let mut all: Vec<_> = shape.edges.hard.iter().copied().collect();
                all.iter_mut().for_each(|edge| edge.sides.sort_unstable());
                all.sort_unstable_by_key(|edge| edge.sides);
                all
            };
            assert_eq!(edges(&told), edges(&found), "{name}");
            let fans = |shape: &Shape| {
                let mut all: Vec<_> =
                    shape.sectors.fans.iter().map(|fan| (fan.first, fan.last)).collect();
                all.sort_unstable();
                all
            };
            assert_eq!(fans(&told), fans(&found), "{name}");
        });
    }
}

/// Each submesh keeps its triangles, then their pieces, and the submesh of the chamfers is the last.
#[test]
fn pieces_stay_in_their_submesh() {
    let mut bar = bar();
    bar.submesh_index_counts = vec![18, 18];
    let held =
        [Held { from: [-0.5, FRONT[0], FRONT[1]], to: [1.5, FRONT[0], FRONT[1]], radius: 0.0 }];
    let mesh = Mesh { held: &held, ..bar.as_mesh() };
    for chamfer_submesh in [ChamferSubmesh::Owner, ChamferSubmesh::Own, ChamferSubmesh::Given(0)] {
        let options = Options { width: Width::Units(0.1), chamfer_submesh, ..Options::default() };
        let result = crate::chamfer(&mesh, &options).unwrap();
        assert!(!result.pieces.is_empty());
        assert_sound("bar", &bar.as_mesh(), &result);
        let submeshes = if chamfer_submesh == ChamferSubmesh::Own { 3 } else { 2 };
        assert_eq!(result.mesh.submesh_index_counts.len(), submeshes);
        let of_second = result.triangle_sources[result.mesh.submesh_index_counts[0] as usize / 3..]
            .iter()
            .filter(|source| source.kind == TriangleKind::Source);
        assert!(of_second.map(|source| source.index).all(|index| index >= 6));
    }
}

/// The finer mesh is the source with more vertices: as closed, and nothing of it has moved.
#[test]
fn a_refined_mesh_is_the_source_to_the_eye() {
    let bar = bar();
    with_offsets(&bar, |view, shape, _| {
        let length = |side: Corner| view.position_at(side).distance(view.position_at(side.next()));
        let edge = shape.edges.hard.iter().find(|edge| length(edge.sides[0]) > 5.0).unwrap();
        let split = Split { sides: edge.sides, at: Few::from_slice(&[0.25, 0.5]) };
        for (deep, triangles) in [(0.2, 12 + 8), (9.0, 12 + 4)] {
            let refined = refined(&bar.as_mesh(), std::slice::from_ref(&split), deep);
            assert_eq!(refined.mesh.indices.len(), 3 * triangles);
            let mesh = refined.as_mesh(&view.mesh);
            let found = compare(&bar.as_mesh(), &mesh, Verify::Full);
            assert_eq!((found.after.border_half_edges, found.after.hard_edges), (0, 14));
            let sources = refined.pieces.iter().filter(|piece| piece.triangle.0 < 12);
            assert!(
                sources.clone().count() == 2 && sources.clone().all(|p| p.triangle == p.source)
            );
        }
    });
}

/// Around a vertex inside, nothing has to reach the corner across.
/// ```text
///            2
///          / | \
///        /  .4.  \
///      / .'  | `. \
///     0------3-----1
/// ```
#[test]
fn a_triangle_is_cut_around_a_vertex_inside() {
    let points = [Few::from_slice(&[Point { vertex: 3, share: 0.5 }]), Few::new(), Few::new()];
    let pieces = pieces([0, 1, 2], &points, Some((4, [0.3, 0.3, 0.4])));
    assert_covers(&pieces);
    let vertices: Vec<_> = pieces.iter().map(|piece| piece.map(|(vertex, _)| vertex)).collect();
    assert_eq!(vertices, [[0, 3, 4], [3, 1, 4], [4, 1, 2], [0, 4, 2]]);
}

/// A hard edge between two pieces of one triangle is none of the source's.
#[test]
fn a_cut_that_shades_hard_is_found() {
    let (bar, mut result) = held(-0.5, 1.5);
    let first = result.pieces[0].triangle as usize;
    let vertex = result.mesh.indices[3 * first + 2] as usize;
    let uses = |(_, v): &(usize, &u32)| **v as usize == vertex;
    let corner = result.mesh.indices.iter().enumerate().rfind(uses).unwrap().0;
    // The last triangle there gets a vertex of its own, with another normal.
    let mut tilted = wide(result.mesh.normals[vertex]);
    tilted += tilted.any_orthonormal_vector() * 0.5;
    result.mesh.positions.push(result.mesh.positions[vertex]);
    result.mesh.normals.push(unit(tilted).as_vec3().to_array());
    result.mesh.uvs[0].values.extend([0.0; 2]);
    result.mesh.tangents.extend(result.mesh.tangents.get(vertex).copied());
    result.mesh.indices[corner] = result.mesh.positions.len() as u32 - 1;
    let source = result.vertex_sources.get(vertex);
    result.vertex_sources = result.vertex_sources.iter().chain([source]).collect();
    let findings = check(&bar.as_mesh(), &result, Verify::Fast);
    assert!(findings.count(Rule::HardEdges) > 0, "{findings}");
}
