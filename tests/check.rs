//! The checker finds each kind of defect: every test plants one and names the rules it breaks.

use chamfer::check::{Element, Facts, Findings, Rule, assert_sound, check, compare};
use chamfer::shapes::{self, Touch};
use chamfer::{
    Blend, Chamfered, MeshBuffers, Reason, Totals, TriangleKind, TriangleSource, Verify,
    VertexSource,
};

/// A mesh as if chamfered without any change.
fn unchanged(mesh: &MeshBuffers) -> Chamfered {
    let vertices = mesh.positions.len() as u32;
    let triangles = mesh.indices.len() as u32 / 3;
    let vertex = |v| VertexSource::new(Blend::one(v), Blend::one(v));
    let triangle = |index| TriangleSource { kind: TriangleKind::Source, index };
    let mut result = Chamfered::default();
    result.mesh = mesh.clone();
    result.vertex_sources = (0..vertices).map(vertex).collect();
    result.triangle_sources = (0..triangles).map(triangle).collect();
    result
}

/// Appends a new triangle to the last submesh.
fn add_triangle(after: &mut Chamfered, vertices: [u32; 3]) {
    after.mesh.indices.extend(vertices);
    *after.mesh.submesh_index_counts.last_mut().unwrap() += 3;
    after.triangle_sources.push(TriangleSource { kind: TriangleKind::Corner, index: 0 });
}

/// Moves all vertices at one position.
fn move_cluster(mesh: &mut MeshBuffers, from: [f32; 3], to: [f32; 3]) {
    let mut moved = 0;
    for position in mesh.positions.iter_mut().filter(|position| **position == from) {
        *position = to;
        moved += 1;
    }
    assert!(moved > 0, "no vertex at {from:?}");
}

/// What is found once `plant` has changed an unchanged copy.
fn findings(before: &MeshBuffers, plant: impl FnOnce(&mut Chamfered)) -> Findings {
    let mut after = unchanged(before);
    plant(&mut after);
    check(&before.as_mesh(), &after, Verify::Full)
}

fn broken(before: &MeshBuffers, plant: impl FnOnce(&mut Chamfered)) -> Vec<Rule> {
    findings(before, plant).breaches.iter().map(|breach| breach.rule).collect()
}

fn facts(mesh: &MeshBuffers) -> Facts {
    check(&mesh.as_mesh(), &unchanged(mesh), Verify::Fast).after
}

#[test]
fn unchanged_shapes_are_sound() {
    let mut all = shapes::demo_models();
    all.extend([
        ("plain_cube", shapes::plain_cube(1.0)),
        ("saddle", shapes::saddle()),
        ("aligned_strip", shapes::aligned_strip()),
        ("open_box", shapes::open_box()),
        ("wedge_end", shapes::wedge_end()),
        ("pyramid", shapes::pyramid(5)),
        ("sphere", shapes::sphere(12, 16)),
        ("cube_field", shapes::cube_field(20)),
        ("touching", shapes::two_cubes_touching(Touch::HalfEdge)),
    ]);
    for (name, mesh) in all {
        assert_sound(name, &mesh.as_mesh(), &unchanged(&mesh));
    }
}

/// The cube of size 1 as it should come out: faces pulled in by 0.1, strips, corner triangles.
fn chamfered_cube(before: &MeshBuffers) -> Chamfered {
    let mut after = unchanged(before);
    for (position, normal) in after.mesh.positions.iter_mut().zip(&before.normals) {
        for axis in 0..3 {
            position[axis] *= if normal[axis] == 0.0 { 0.8 } else { 1.0 };
        }
    }
    let at = |vertex: u32| before.positions[vertex as usize];
    let sides: Vec<[u32; 2]> = before
        .indices
        .chunks_exact(3)
        .flat_map(|t| [[t[0], t[1]], [t[1], t[2]], [t[2], t[0]]])
        .collect();
    for (place, &[a, b]) in sides.iter().enumerate() {
        let twin = sides.iter().position(|&[c, d]| at(a) == at(d) && at(b) == at(c)).unwrap();
        let [c, d] = sides[twin];
        if place < twin && a != d {
            add_triangle(&mut after, [b, a, d]);
            add_triangle(&mut after, [b, d, c]);
        }
    }
    for a in (0..24).filter(|&a| before.normals[a as usize][0] != 0.0) {
        let others: Vec<u32> = (0..24).filter(|&b| b != a && at(a) == at(b)).collect();
        let right_handed = at(a).iter().product::<f32>() > 0.0;
        let y_first = before.normals[others[0] as usize][1] != 0.0;
        let [b, c] = if right_handed == y_first { [0, 1] } else { [1, 0] };
        add_triangle(&mut after, [a, others[b], others[c]]);
    }
    after
}

#[test]
fn a_chamfered_cube_is_sound() {
    let before = shapes::plain_cube(1.0);
    let after = chamfered_cube(&before);
    assert_eq!(after.mesh.indices.len(), 3 * 44);
    assert_sound("chamfered cube", &before.as_mesh(), &after);
    let found = compare(&before.as_mesh(), &after.mesh.as_mesh(), Verify::Full);
    assert!(found.is_sound(), "{found}");
    assert_eq!(found.after.hard_edges, 0);
}

#[test]
fn a_missing_and_a_flipped_corner_triangle() {
    let before = shapes::plain_cube(1.0);
    let mut after = chamfered_cube(&before);
    after.mesh.indices.swap(3 * 43, 3 * 43 + 1);
    let found = check(&before.as_mesh(), &after, Verify::Full);
    assert_eq!((found.count(Rule::Flipped), found.count(Rule::Balance)), (1, 3));
    after.mesh.indices.truncate(3 * 43);
    after.mesh.submesh_index_counts[0] -= 3;
    after.triangle_sources.pop();
    let found = check(&before.as_mesh(), &after, Verify::Full);
    assert_eq!((found.count(Rule::Balance), found.after.border_loops), (3, 1));
}

#[test]
fn an_empty_mesh_is_sound() {
    assert_sound("empty", &MeshBuffers::default().as_mesh(), &Chamfered::default());
}

#[test]
fn facts_of_a_cube() {
    let mut expected = Facts::default();
    (expected.vertices, expected.triangles) = (24, 12);
    (expected.components, expected.hard_edges) = (1, 12);
    assert_eq!(facts(&shapes::cube(1.0)), expected);
}

#[test]
fn facts_of_other_shapes() {
    let open = facts(&shapes::open_box());
    assert_eq!((open.border_half_edges, open.border_loops, open.hard_edges), (4, 1, 8));
    let touching = facts(&shapes::two_cubes_touching(Touch::Edge));
    assert_eq!((touching.non_manifold_edges, touching.components), (0, 1));
    let twice = facts(&twice(&shapes::plain_cube(1.0), false));
    assert_eq!(twice.non_manifold_edges, 18, "its diagonals too");
    let separate = facts(&shapes::two_cubes_touching(Touch::Vertex));
    assert_eq!((separate.non_manifold_edges, separate.components), (0, 2));
    assert_eq!(facts(&shapes::sphere(8, 12)).hard_edges, 0);
    assert_eq!(facts(&shapes::cylinder(12)).hard_edges, 24);
    assert_eq!(facts(&shapes::cube_field(5)).components, 5);
}

#[test]
fn borders_that_touch_in_one_vertex_are_two_loops() {
    let bow_tie = MeshBuffers {
        positions: vec![
            [0.0, 0.0, 0.0],
            [-1.0, 1.0, 0.0],
            [-1.0, -1.0, 0.0],
            [1.0, -1.0, 0.0],
            [1.0, 1.0, 0.0],
        ],
        normals: vec![[0.0, 0.0, 1.0]; 5],
        indices: vec![0, 1, 2, 0, 3, 4],
        submesh_index_counts: vec![6],
        ..MeshBuffers::default()
    };
    let facts = facts(&bow_tie);
    assert_eq!((facts.border_half_edges, facts.border_loops), (6, 2));
}

#[test]
fn both_zeros_are_one_position() {
    let mut mesh = shapes::l_shape();
    let zeros = mesh.positions.as_flattened_mut().iter_mut().filter(|along| **along == 0.0);
    zeros.step_by(2).for_each(|zero| *zero = -0.0);
    assert_eq!(facts(&mesh).border_half_edges, 0);
}

#[test]
fn a_flipped_triangle() {
    let found = findings(&shapes::cube(1.0), |after| after.mesh.indices.swap(3, 4));
    assert_eq!(found.count(Rule::Flipped), 1);
    assert_eq!(found.count(Rule::Balance), 3);
    let flipped = found.breaches.iter().find(|breach| breach.rule == Rule::Flipped).unwrap();
    assert_eq!(flipped.first, [Element::Triangle(1)]);
}

#[test]
fn a_new_triangle_that_faces_away_from_its_normals() {
    let rules = broken(&shapes::open_box(), |after| add_triangle(after, [0, 2, 1]));
    assert!(rules.contains(&Rule::Flipped), "{rules:?}");
}

#[test]
fn a_triangle_that_was_flipped_before_is_not_held_against_it() {
    let mut before = shapes::cube(1.0);
    before.indices.swap(3, 4);
    assert_eq!(broken(&before, |_| ()), []);
}

#[test]
fn a_vertex_pulled_without_a_strip() {
    // One of the cube's vertices moves inside its face: the edges beside it open.
    let rules = broken(&shapes::plain_cube(1.0), |after| {
        let [x, y, z] = after.mesh.positions[0];
        after.mesh.positions[0] = [x, y * 0.9, z * 0.9];
    });
    assert_eq!(rules, [Rule::Balance, Rule::BorderLoops, Rule::Gapes]);
}

#[test]
fn a_closed_lid() {
    let before = shapes::open_box();
    let rim = |after: &Chamfered, x: f32, z: f32| {
        after.mesh.positions.iter().position(|&p| p == [x, 1.0, z]).unwrap() as u32
    };
    let rules = broken(&before, |after| {
        let corners = [(-1.0, -1.0), (-1.0, 1.0), (1.0, 1.0), (1.0, -1.0)];
        let [a, b, c, d] = corners.map(|(x, z)| rim(after, x, z));
        add_triangle(after, [a, b, c]);
        add_triangle(after, [a, c, d]);
    });
    assert!(rules.contains(&Rule::BorderLoops), "{rules:?}");
}

#[test]
fn a_third_face_at_an_edge() {
    let found = findings(&shapes::plain_cube(1.0), add_card);
    assert_eq!(found.count(Rule::NonManifold), 1);
    assert_eq!(found.count(Rule::Balance), 0);
}

/// A card on one edge of a cube.
fn add_card(after: &mut Chamfered) {
    let [a, b] = [after.mesh.indices[0], after.mesh.indices[1]];
    after.mesh.positions.push([2.0, 2.0, 2.0]);
    after.mesh.normals.push([1.0, 0.0, 0.0]);
    let copy = after.vertex_sources.get(0);
    after.vertex_sources = after.vertex_sources.iter().chain([copy]).collect();
    let tip = after.mesh.positions.len() as u32 - 1;
    add_triangle(after, [a, b, tip]);
    add_triangle(after, [b, a, tip]);
}

/// A mesh whose skin is there twice: copied, or with a second one inside, back to back.
fn twice(mesh: &MeshBuffers, inward: bool) -> MeshBuffers {
    let mut both = mesh.clone();
    let vertices = mesh.positions.len() as u32;
    both.positions.extend_from_within(..);
    let sign = if inward { -1.0 } else { 1.0 };
    both.normals.extend(mesh.normals.iter().map(|normal| normal.map(|along| sign * along)));
    for triangle in mesh.indices.chunks_exact(3) {
        let [a, b, c] = [0, 1, 2].map(|k| vertices + triangle[k]);
        both.indices.extend(if inward { [a, c, b] } else { [a, b, c] });
    }
    both.submesh_index_counts = vec![both.indices.len() as u32];
    both
}

/// Edges of solids that touch have two sides in each, and those of a skin that is there twice have
/// four, before and after. More are too many there too.
#[test]
fn too_many_sides_where_there_were_four() {
    let solids = [
        shapes::two_cubes_touching(Touch::Edge),
        twice(&shapes::plain_cube(1.0), false),
        twice(&shapes::plain_cube(1.0), true),
    ];
    for solid in solids {
        let found = findings(&solid, |_| ());
        assert!(found.is_sound(), "{found}");
        let found = findings(&solid, add_card);
        assert_eq!(found.count(Rule::NonManifold), 1, "{found}");
    }
}

/// One of two cubes that touch along an edge cuts through itself; the other one does not count.
#[test]
fn a_solid_that_touches_another_and_cuts_itself() {
    let before = shapes::two_cubes_touching(Touch::Edge);
    let found = findings(&before, |after| {
        move_cluster(&mut after.mesh, [0.0; 3], [0.5, 2.0, 0.5]);
    });
    assert!(found.count(Rule::SelfIntersection) > 0, "{found}");
    // Cubes that cut each other do not.
    let found = findings(&before, |after| {
        for position in &mut after.mesh.positions[24..] {
            *position = position.map(|along| along - 0.5);
        }
    });
    assert_eq!(found.count(Rule::SelfIntersection), 0, "{found}");
}

#[test]
fn a_removed_triangle() {
    let rules = broken(&shapes::cube(1.0), |after| {
        after.mesh.indices.truncate(33);
        after.mesh.submesh_index_counts[0] = 33;
        after.triangle_sources.pop();
    });
    assert_eq!(rules, [Rule::Origins]);
}

#[test]
fn triangles_out_of_order() {
    let rules = broken(&shapes::cube(1.0), |after| after.triangle_sources.swap(0, 1));
    assert_eq!(rules, [Rule::Origins]);
}

#[test]
fn a_triangle_in_another_submesh() {
    let rules = broken(&shapes::bolt(), |after| {
        after.mesh.submesh_index_counts[0] -= 3;
        after.mesh.submesh_index_counts[1] += 3;
    });
    assert_eq!(rules, [Rule::Origins]);
}

/// What is broken once one vertex of a cube comes from elsewhere.
fn broken_source(change: impl FnOnce(&mut VertexSource)) -> Vec<Rule> {
    broken(&shapes::cube(1.0), |after| {
        let mut sources: Vec<VertexSource> = after.vertex_sources.iter().collect();
        change(&mut sources[3]);
        after.vertex_sources = sources.into_iter().collect();
    })
}

#[test]
fn provenance_that_points_nowhere() {
    for blend in [
        Blend { vertices: [99; 3], weights: [1.0, 0.0, 0.0] },
        Blend { vertices: [0; 3], weights: [0.5, 0.0, 0.0] },
    ] {
        assert_eq!(broken_source(|source| source.chart = blend), [Rule::Origins]);
    }
    assert_eq!(broken_source(|source| source.owner = Blend::one(7)), [Rule::Origins]);
    let lost = |after: &mut Chamfered| {
        after.vertex_sources = after.vertex_sources.iter().take(20).collect();
    };
    assert_eq!(broken(&shapes::cube(1.0), lost), [Rule::Origins]);
}

#[test]
fn a_new_triangle_of_an_edge_that_does_not_exist() {
    let before = shapes::plain_cube(1.0);
    let mut after = chamfered_cube(&before);
    after.triangle_sources[12].kind = TriangleKind::Edge;
    let found = check(&before.as_mesh(), &after, Verify::Full);
    assert_eq!(found.breaches[0].first, [Element::Triangle(12)]);
    assert_eq!(found.breaches[0].rule, Rule::Verdicts);
}

#[test]
fn totals_that_are_not_those_of_the_verdicts() {
    type Plant = fn(&mut Totals);
    let plants: [Plant; 4] = [
        |totals| totals.hard_edges = 1,
        |totals| totals.chamfered = 1,
        |totals| totals.narrowed = 1,
        |totals| totals.skipped[Reason::Miter] = 1,
    ];
    for plant in plants {
        let rules = broken(&shapes::cube(1.0), |after| plant(&mut after.totals));
        assert_eq!(rules, [Rule::Verdicts]);
    }
}

#[test]
fn collapsed_and_new_degenerate_triangles() {
    let found = findings(&shapes::plain_cube(1.0), |after| {
        move_cluster(&mut after.mesh, [0.5; 3], [0.5, 0.5, -0.5]);
    });
    assert!(found.count(Rule::Degenerate) >= 2, "{found}");
    let rules = broken(&shapes::plain_cube(1.0), |after| add_triangle(after, [0, 1, 1]));
    assert!(rules.contains(&Rule::Degenerate), "{rules:?}");
}

#[test]
fn a_triangle_that_had_no_area_before_is_not_held_against_it() {
    let mut before = shapes::plain_cube(1.0);
    before.indices.extend([0, 1, 1]);
    before.submesh_index_counts[0] += 3;
    assert_eq!(broken(&before, |_| ()), []);
}

#[test]
fn values_that_are_no_numbers() {
    let before = shapes::table();
    type Plant = fn(&mut MeshBuffers);
    let plants: [Plant; 5] = [
        |mesh| mesh.positions[3][1] = f32::NAN,
        |mesh| mesh.normals[3][0] = f32::NAN,
        |mesh| mesh.tangents[3][2] = f32::INFINITY,
        |mesh| mesh.colors[3][3] = f32::NEG_INFINITY,
        |mesh| mesh.uvs[0].values[7] = f32::NAN,
    ];
    for plant in plants {
        let found = findings(&before, |after| plant(&mut after.mesh));
        assert_eq!(found.breaches.len(), 1);
        assert_eq!(found.breaches[0].rule, Rule::Finite);
        assert_eq!(found.breaches[0].first, [Element::Vertex(3)]);
    }
}

#[test]
fn a_normal_that_is_not_unit() {
    let rules = broken(&shapes::sphere(6, 8), |after| after.mesh.normals[9] = [0.0, 0.5, 0.0]);
    assert!(rules.contains(&Rule::Normals), "{rules:?}");
}

#[test]
fn a_normal_that_was_not_unit_before_is_not_held_against_it() {
    let mut before = shapes::sphere(6, 8);
    before.normals[9] = [0.0, 0.0, 0.0];
    assert_eq!(broken(&before, |_| ()), []);
}

#[test]
fn tangents_that_are_not_right() {
    let before = shapes::cube(1.0);
    let normal = before.normals[5];
    for tangent in [
        [0.0, 0.0, 0.0, 1.0],
        [normal[0], normal[1], normal[2], 1.0],
        [before.tangents[5][0], before.tangents[5][1], before.tangents[5][2], 0.5],
    ] {
        let rules = broken(&before, |after| after.mesh.tangents[5] = tangent);
        assert!(rules.contains(&Rule::Tangents), "{tangent:?}: {rules:?}");
    }
}

#[test]
fn a_colour_brighter_than_any_before() {
    let rules = broken(&shapes::table(), |after| after.mesh.colors[0][1] = 0.9);
    assert_eq!(rules, [Rule::Colors, Rule::ColorChanged]);
}

#[test]
fn an_index_past_the_last_vertex() {
    let rules = broken(&shapes::cube(1.0), |after| after.mesh.indices[7] = 24);
    assert_eq!(rules, [Rule::IndexRange]);
}

#[test]
fn streams_that_are_lost_or_short() {
    type Plant = fn(&mut MeshBuffers);
    let plants: [Plant; 5] = [
        |mesh| mesh.tangents.clear(),
        |mesh| mesh.colors.truncate(3),
        |mesh| mesh.uvs[0].values.truncate(3),
        |mesh| mesh.uvs[0] = Default::default(),
        |mesh| mesh.submesh_index_counts[0] += 3,
    ];
    for plant in plants {
        let rules = broken(&shapes::table(), |after| plant(&mut after.mesh));
        assert_eq!(rules, [Rule::Streams]);
    }
}

#[test]
fn a_malformed_source() {
    let mut before = shapes::cube(1.0);
    before.indices[0] = 99;
    assert_eq!(broken(&before, |_| ()), [Rule::Source]);
}

#[test]
fn a_flat_face_that_bends() {
    let rules = broken(&shapes::plain_cube(1.0), |after| {
        move_cluster(&mut after.mesh, [0.5; 3], [0.5, 0.5, 0.499]);
    });
    assert_eq!(rules, [Rule::FlatFace, Rule::Shading]);
}

#[test]
fn a_corner_that_slides_in_its_plane_does_not_bend() {
    // The ends of an L slide along its planes: it gets thinner, but stays an L.
    let before = shapes::l_shape();
    let found = findings(&before, |after| {
        for position in after.mesh.positions.iter_mut().filter(|position| position[0] == 2.0) {
            position[0] = 1.75;
        }
    });
    assert_eq!(found.count(Rule::FlatFace), 2, "only the end itself leaves its plane");
}

#[test]
fn a_flat_normal_that_bends() {
    let tilted = [0.000_1f32.cos(), 0.000_1f32.sin(), 0.0];
    let rules = broken(&shapes::plain_cube(1.0), |after| {
        assert_eq!(after.mesh.normals[0], [1.0, 0.0, 0.0]);
        after.mesh.normals[0] = tilted;
    });
    assert_eq!(rules, [Rule::FlatNormal]);
}

/// A table whose one leg is bent so that its foot stands in another leg's.
//  .-----------.      a square, and below its edge a triangle that is as high as is given, with normals
//  |           |      of its own
//  A-----------B
//      `-M-'
#[test]
fn a_line_shows_no_normal_and_what_is_higher_does() {
    let found = |heights: [f32; 2]| {
        let line = |height: f32| [[0.0, 0.0, 0.0], [1.0, -height, 0.0], [2.0, 0.0, 0.0]];
        let square = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, 2.0, 0.0], [0.0, 2.0, 0.0]];
        let mut mesh = MeshBuffers {
            positions: [&square[..], &line(heights[0])].concat(),
            normals: [vec![[0.0, 0.0, 1.0]; 4], vec![[0.0, 0.6, 0.8]; 3]].concat(),
            indices: vec![0, 1, 2, 0, 2, 3, 4, 5, 6],
            ..MeshBuffers::default()
        };
        mesh.submesh_index_counts = vec![9];
        let rules = broken(&mesh, |after| {
            after.mesh.positions[5] = line(heights[1])[1];
            after.mesh.normals[4] = [0.0, 0.0, 1.0];
        });
        rules.contains(&Rule::FlatNormal)
    };
    // Sixteen roundings are 1.5e-5 here.
    assert!(!found([1e-5, 1e-5]), "nobody sees it");
    assert!(found([1e-5, 1e-4]), "it has opened");
    assert!(found([1e-4, 1e-5]) && found([1e-4, 1e-4]));
}

fn bend_leg(mesh: &mut MeshBuffers) {
    let is_foot = |p: &[f32; 3]| p[1] == 0.0 && p[0] > 0.0 && p[2] > 0.0;
    for position in mesh.positions.iter_mut().filter(|position| is_foot(position)) {
        position[0] -= 1.65;
        position[2] -= 0.03;
    }
}

#[test]
fn a_leg_that_cuts_another() {
    let found = findings(&shapes::table(), |after| bend_leg(&mut after.mesh));
    assert!(found.count(Rule::SelfIntersection) > 0, "{found}");
    assert_eq!(found.before.self_intersections, Some(0));
    assert_eq!(found.count(Rule::Balance) + found.count(Rule::Flipped), 0, "{found}");
}

#[test]
fn self_intersections_are_left_out_in_fast_depth() {
    let before = shapes::table();
    let mut after = unchanged(&before);
    bend_leg(&mut after.mesh);
    let found = check(&before.as_mesh(), &after, Verify::Fast);
    assert_eq!(found.count(Rule::SelfIntersection), 0);
    assert_eq!(found.after.self_intersections, None);
}

#[test]
fn a_part_that_cut_itself_before_is_not_held_against_it() {
    let mut before = shapes::table();
    bend_leg(&mut before);
    let found = findings(&before, |_| ());
    assert!(found.is_sound(), "{found}");
    assert!(found.before.self_intersections.unwrap() > 0);
}

#[test]
fn separate_parts_may_cut_each_other() {
    let before = shapes::two_cubes_touching(Touch::Vertex);
    let found = findings(&before, |after| {
        for position in &mut after.mesh.positions[24..] {
            *position = position.map(|along| along - 0.5);
        }
    });
    assert_eq!(found.count(Rule::SelfIntersection), 0);
}

#[test]
fn a_comparison_without_provenance_finds_the_same() {
    let before = shapes::bolt();
    let mut after = before.clone();
    assert!(compare(&before.as_mesh(), &after.as_mesh(), Verify::Full).is_sound());
    after.indices.swap(0, 1);
    let found = compare(&before.as_mesh(), &after.as_mesh(), Verify::Full);
    assert_eq!((found.count(Rule::Flipped), found.count(Rule::Balance)), (1, 3));
    after.indices.truncate(9);
    after.submesh_index_counts = vec![9, 0];
    let found = compare(&before.as_mesh(), &after.as_mesh(), Verify::Full);
    assert_eq!(found.count(Rule::Origins), 1);
}

#[test]
fn findings_print_as_a_table() {
    let text = findings(&shapes::cube(1.0), |after| after.mesh.indices.swap(3, 4)).to_string();
    assert!(text.contains("flipped triangle                         1: triangle 1"), "{text}");
    assert!(text.contains("hard edges                    12"), "{text}");
    assert!(!text.contains("sound"), "{text}");
}

#[test]
#[should_panic(expected = "the cube is not sound")]
fn assert_sound_panics_with_the_name() {
    let before = shapes::cube(1.0);
    let mut after = unchanged(&before);
    after.mesh.indices.swap(3, 4);
    assert_sound("the cube", &before.as_mesh(), &after);
}
