//! Which edges are chamfered, how wide, and in which space: on random meshes and corners.

#[path = "support/prism.rs"]
mod prism;
#[allow(dead_code)] // Other tests use more of it.
#[path = "support/random.rs"]
mod random;
#[path = "support/seeded.rs"]
mod seeded;
#[path = "support/shaded.rs"]
mod shaded;

use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

use chamfer::check::{Element, Rule, assert_sound, check};
use chamfer::{
    Chamfered, Convexity, EdgeFactor, EdgeVerdict, Factors, Mesh, MeshBuffers, Options, Outcome,
    Reason, TriangleKind, Verify, Width, WidthMode, chamfer, shapes,
};
use glam::{DMat3, DVec3};
use proptest::prelude::*;

use random::{Model, clean_mesh};

use seeded::seeded;

/// Options that select some edges, and what each width measures.
fn options() -> impl Strategy<Value = Options> {
    let convexity =
        prop::sample::select(vec![Convexity::Both, Convexity::Convex, Convexity::Concave]);
    let mode = prop::sample::select(vec![
        WidthMode::Offset,
        WidthMode::Chord,
        WidthMode::Depth,
        WidthMode::Radius,
    ]);
    let percent = prop_oneof![0.01..1.0f32, 1.0..10.0f32];
    let angles = prop_oneof![Just((0.0, 180.0)), (0.0..90.0f32, 90.0..180.0f32)];
    (percent, convexity, mode, angles).prop_map(|(percent, convexity, mode, (least, most))| {
        Options::default()
            .with_width(Width::PercentOfExtent(percent))
            .with_convexity(convexity)
            .with_width_mode(mode)
            .with_angles(least, most)
    })
}

/// Random factors for each vertex and each submesh, from a few that are used again and again.
fn factors(mesh: &MeshBuffers, seed: u32) -> [Vec<f32>; 2] {
    let pick = |count: usize, salt: u32| {
        let mut state = seed ^ salt;
        (0..count)
            .map(|_| {
                state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                [0.0, 0.1, 1.0, 1.0, 2.5][(state >> 24) as usize % 5]
            })
            .collect()
    };
    [pick(mesh.positions.len(), 1), pick(mesh.submesh_index_counts.len(), 2)]
}

proptest! {
    #![proptest_config(seeded(300))]

    #[test]
    fn a_mesh_of_which_some_edges_are_chamfered_is_sound(
        Model(mesh) in clean_mesh(),
        options in options(),
        seed in any::<u32>(),
        is_full in any::<bool>(),
    ) {
        let [vertices, submeshes] = factors(&mesh, seed);
        let factors = Factors { vertices: &vertices, submeshes: &submeshes, edges: &[] };
        let verify = if is_full { Verify::Full } else { Verify::Fast };
        let mesh = Mesh { factors, ..mesh.as_mesh() };
        let result = chamfer(&mesh, &options.with_verify(verify)).unwrap();
        let findings = check(&mesh, &result, verify);
        prop_assert!(findings.is_sound(), "{findings}");
    }
}

/// All hard edges of a mesh, each with whether it is wanted.
fn listed(mesh: &MeshBuffers, wanted: impl Fn(usize, [[f32; 3]; 2]) -> bool) -> Vec<EdgeFactor> {
    let all = chamfer(&mesh.as_mesh(), &Options::default()).unwrap().verdicts;
    let place = |v: u32| mesh.positions[v as usize];
    let is_wanted = |(k, edge): &(usize, [u32; 2])| wanted(*k, edge.map(place));
    let wanted = all.iter().map(|edge| edge.vertices).enumerate().filter(is_wanted);
    wanted.map(|(_, vertices)| EdgeFactor { vertices, factor: 1.0 }).collect()
}

fn with_edges(mesh: &MeshBuffers, edges: &[EdgeFactor], width: f32) -> Chamfered {
    let factors = Factors { edges, ..Factors::default() };
    let mesh = Mesh { factors, ..mesh.as_mesh() };
    let options = Options::default().with_width(Width::Units(width)).with_verify(Verify::Full);
    let result = chamfer(&mesh, &options).unwrap();
    assert_sound("some edges", &mesh, &result);
    result
}

/// The triangles whose corners all lie at a height along an axis, and so the cap there.
fn cap(mesh: &MeshBuffers, axis: usize, height: f32) -> Vec<[usize; 3]> {
    let triangles = mesh.indices.chunks(3).map(|t| [0, 1, 2].map(|k| t[k] as usize));
    triangles.filter(|t| t.iter().all(|&v| mesh.positions[v][axis] == height)).collect()
}

fn area(mesh: &MeshBuffers, triangles: &[[usize; 3]]) -> f64 {
    let at = |v: usize| DVec3::from(mesh.positions[v].map(f64::from));
    let double = triangles.iter().map(|&[a, b, c]| (at(b) - at(a)).cross(at(c) - at(a)).length());
    double.sum::<f64>() / 2.0
}

//   .-----.        .---.     only the upright edges are chamfered: each corner of the caps is cut
//  /       \      /     \    off, and what is left stays flat and hard, and closes
// .         .    |       |
#[test]
fn chamfers_between_edges_that_stay_hard_cut_the_corners_of_the_caps_off() {
    for sides in 3..9 {
        let prism = shapes::prism(sides);
        let edges = listed(&prism, |_, [from, to]| from[2] != to[2]);
        assert_eq!(edges.len(), sides as usize);
        let result = with_edges(&prism, &edges, 0.05);
        let chamfered = || result.verdicts.iter().filter(|edge| edge.reason == Reason::None);
        assert_eq!(chamfered().count(), sides as usize, "{sides}");
        assert!(chamfered().all(|edge| edge.outcome == Outcome::Full));
        let is_asked = |width: &f32| (width - 0.05).abs() < 1e-6;
        assert!(chamfered().all(|edge| edge.widths.iter().all(is_asked)), "at both ends");
        let left = cap(&result.mesh, 2, 1.0);
        let normal = prism.normals[cap(&prism, 2, 1.0)[0][0]];
        assert!(left.iter().flatten().all(|&v| result.mesh.normals[v] == normal), "{sides}");
        let angle = std::f64::consts::PI * (1.0 - 2.0 / f64::from(sides));
        let cut = f64::from(sides) * 0.05_f64.powi(2) * angle.sin() / 2.0;
        let whole = area(&prism, &cap(&prism, 2, 1.0));
        assert!((area(&result.mesh, &left) - (whole - cut)).abs() < 1e-5, "{sides}");
    }
}

#[test]
fn rounded_chamfers_between_edges_that_stay_hard_close() {
    for sides in [3, 4, 6] {
        let prism = shapes::prism(sides);
        let upright = listed(&prism, |_, [one, other]| one[2] != other[2]);
        let factors = Factors { edges: &upright, ..Factors::default() };
        let mesh = Mesh { factors, ..prism.as_mesh() };
        for segments in [2, 5] {
            let options = Options::default().with_width(Width::Units(0.05)).with_segments(segments);
            let result = chamfer(&mesh, &options).unwrap();
            assert_sound(&format!("{sides} sides, {segments} segments"), &mesh, &result);
            assert_eq!(result.totals.chamfered, sides);
        }
    }
}

#[test]
fn the_texture_goes_on_where_a_face_is_cut() {
    let cube = shapes::cube(1.0);
    let edges = listed(&cube, |_, [from, to]| from[1] != to[1]);
    let result = with_edges(&cube, &edges, 0.1).mesh;
    let uv = |mesh: &MeshBuffers, v: usize| [0, 1].map(|k| mesh.uvs[0].values[2 * v + k]);
    for height in [-0.5, 0.5] {
        // On the whole face the texture is a linear map of the place.
        let [a, b, c] = cap(&cube, 1, height)[0];
        let source = |v: usize| DVec3::from(cube.positions[v].map(f64::from));
        let (ab, ac) = (source(b) - source(a), source(c) - source(a));
        let normal = ab.cross(ac);
        let triangles = cap(&result, 1, height);
        assert_eq!(triangles.len(), 2 + 4, "four corners are cut off");
        for &v in triangles.iter().flatten() {
            let way = DVec3::from(result.positions[v].map(f64::from)) - source(a);
            let along = [way.cross(ac), ab.cross(way)];
            let [s, t] = along.map(|part| part.dot(normal) / normal.length_squared());
            let [at_a, at_b, at_c] = [a, b, c].map(|v| uv(&cube, v).map(f64::from));
            for k in 0..2 {
                let expected = at_a[k] + s * (at_b[k] - at_a[k]) + t * (at_c[k] - at_a[k]);
                let found = f64::from(uv(&result, v)[k]);
                assert!((found - expected).abs() < 1e-6, "{found} for {expected}");
            }
            assert_eq!(result.tangents[v], cube.tangents[a]);
        }
    }
}

/// Boxes, prisms and pyramids.
fn convex() -> impl Strategy<Value = MeshBuffers> {
    let boxes = prop::array::uniform3(0.5..2.0f32).prop_map(|sizes| {
        let mut mesh = shapes::plain_cube(1.0);
        for at in &mut mesh.positions {
            *at = [0, 1, 2].map(|axis| at[axis] * sizes[axis]);
        }
        mesh
    });
    prop_oneof![boxes, (3..8u32).prop_map(shapes::prism), (3..7u32).prop_map(shapes::pyramid),]
}

proptest! {
    #![proptest_config(seeded(300))]

    // Whatever meets at its ends, and stays hard: on a convex solid each chamfer opens.
    #[test]
    fn any_edges_of_a_convex_solid_can_be_chamfered_alone(
        mesh in convex(),
        wanted in any::<u32>(),
    ) {
        let edges = listed(&mesh, |k, _| wanted >> (k % 32) & 1 == 1);
        if edges.is_empty() {
            return Ok(());
        }
        let result = with_edges(&mesh, &edges, 0.02);
        let opens = |edge: &&EdgeVerdict| edge.outcome != Outcome::Skipped;
        prop_assert_eq!(result.verdicts.iter().filter(opens).count(), edges.len());
    }
}

/// A pyramid with three faces around its tip, in random directions, and the corner of a box behind.
fn corner() -> impl Strategy<Value = [[f32; 3]; 3]> {
    let along = |axis: usize| {
        prop::array::uniform3(-0.35..0.35f32).prop_map(move |mut at| {
            at[axis] += 1.0;
            at
        })
    };
    (along(0), along(1), along(2)).prop_map(|(x, y, z)| [x, y, z])
}

/// A tetrahedron with its first corner at the origin.
fn tetrahedron([x, y, z]: [[f32; 3]; 3]) -> MeshBuffers {
    let mut mesh = MeshBuffers::default();
    let o = [0.0; 3];
    for face in [[o, y, x], [o, z, y], [o, x, z], [x, y, z]] {
        let [a, b, c] = face.map(|at| DVec3::from(at.map(f64::from)));
        let normal = (b - a).cross(c - a).normalize().as_vec3().to_array();
        mesh.indices.extend([0, 1, 2].map(|k| mesh.positions.len() as u32 + k));
        mesh.positions.extend(face);
        mesh.normals.extend([normal; 3]);
    }
    mesh.submesh_index_counts = vec![12];
    mesh
}

proptest! {
    #![proptest_config(seeded(1000))]

    // Around the origin three edges have widths of their own; on each face both pulled edges run at
    // the distances asked for, as far as no vertex would go farther than three widths.
    #[test]
    fn unlike_widths_are_kept_on_both_sides_of_each_face(
        arms in corner(),
        factors in prop::array::uniform3(0.1..10.0f32),
    ) {
        let mesh = tetrahedron(arms);
        let place = |at: [f32; 3]| mesh.positions.iter().position(|p| *p == at).unwrap() as u32;
        let edges: Vec<EdgeFactor> = arms
            .iter()
            .zip(factors)
            .map(|(&arm, factor)| EdgeFactor { vertices: [place([0.0; 3]), place(arm)], factor })
            .collect();
        let mesh = Mesh {
            factors: Factors { edges: &edges, ..Factors::default() },
            ..mesh.as_mesh()
        };
        let width = 1e-3;
        let options = Options::default().with_width(Width::Units(width)).with_least_breadth(0.0);
        let result = chamfer(&mesh, &options).unwrap();
        // A wide chamfer may swallow the corner of the face across; the limits tell.
        let is_full = |arm: [f32; 3]| {
            let ends = [[0.0; 3], arm];
            result.verdicts.iter().any(|edge| {
                let at = edge.vertices.map(|v| mesh.positions[v as usize]);
                (at == ends || at == [ends[1], ends[0]]) && edge.outcome == Outcome::Full
            })
        };
        if !arms.iter().all(|&arm| is_full(arm)) {
            return Ok(());
        }
        FULL.fetch_add(1, Relaxed);
        for (k, &at) in result.mesh.positions.iter().take(9).enumerate() {
            if mesh.positions[k] != [0.0; 3] {
                continue;
            }
            let moved = DVec3::from(at.map(f64::from));
            let face = &mesh.positions[k / 3 * 3..k / 3 * 3 + 3];
            for (&arm, factor) in arms.iter().zip(factors).filter(|(arm, _)| face.contains(arm)) {
                let along = DVec3::from(arm.map(f64::from)).normalize();
                let distance = moved.cross(along).length();
                let asked = f64::from(width) * f64::from(factor);
                prop_assert!((distance - asked).abs() < 1e-6, "{distance} for {asked}");
            }
        }
    }
}

/// So many random corners had full width at all three edges.
static FULL: AtomicU32 = AtomicU32::new(0);

#[test]
fn many_unlike_corners_get_full_width() {
    unlike_widths_are_kept_on_both_sides_of_each_face();
    assert!(FULL.load(Relaxed) > 300, "{FULL:?}");
}

/// The distance of each pulled vertex of a box from the old edges that it comes from, measured in
/// the space of a matrix.
fn distances(mesh: &MeshBuffers, result: &Chamfered, to: DMat3) -> Vec<f64> {
    let place = |at: [f32; 3]| to * DVec3::from(at.map(f64::from));
    let mut found = Vec::new();
    for verdict in result.verdicts.iter().filter(|verdict| verdict.outcome == Outcome::Full) {
        let ends = verdict.vertices.map(|v| place(mesh.positions[v as usize]));
        let along = (ends[1] - ends[0]).normalize();
        for (vertex, end) in verdict.vertices.into_iter().zip(ends) {
            // The vertex of the first side keeps its index.
            let moved = place(result.mesh.positions[vertex as usize]);
            found.push((moved - end).cross(along).length());
        }
    }
    found
}

proptest! {
    #![proptest_config(seeded(200))]

    #[test]
    fn a_scaled_box_has_chamfers_of_one_width(
        sizes in prop::array::uniform3(1.0..100.0f32),
        shear in prop::array::uniform3(-0.5..0.5f32),
        is_mirrored in any::<bool>(),
    ) {
        let cube = shapes::plain_cube(1.0);
        let [x, y, z] = sizes;
        let mirror = if is_mirrored { -1.0 } else { 1.0 };
        let scale = [
            [x * mirror, shear[0] * x, 0.0],
            [0.0, y, shear[1] * y],
            [shear[2] * z * 0.2, 0.0, z],
        ];
        let width = 0.05;
        let options = Options::default().with_width(Width::Units(width)).with_scale(scale);
        let result = chamfer(&cube.as_mesh(), &options).unwrap();
        let [x, y, z] = scale.map(|axis| DVec3::from(axis.map(f64::from)));
        let distances = distances(&cube, &result, DMat3::from_cols(x, y, z));
        prop_assert!(!distances.is_empty());
        for distance in distances {
            prop_assert!((distance - f64::from(width)).abs() < 1e-4, "{distance}");
        }
    }
}

#[test]
fn a_scaled_box_is_sound_and_what_stays_keeps_its_bits() {
    let mut cube = shapes::cube(1.0);
    // A vertex that nothing uses.
    for (values, value) in [(&mut cube.positions, [0.1; 3]), (&mut cube.normals, [0.6, 0.8, 0.0])] {
        values.push(value);
    }
    cube.tangents.push([0.0, 0.0, 1.0, 1.0]);
    cube.uvs[0].values.extend([0.0, 0.0]);
    let scale = [[9.0, 0.0, 0.0], [0.0, 3.0, 0.0], [0.0, 0.0, 0.1]];
    let options = Options::default().with_width(Width::Units(0.01)).with_scale(scale);
    let result = chamfer(&cube.as_mesh(), &options).unwrap();
    assert_sound("a scaled box", &cube.as_mesh(), &result);
    assert_eq!(result.mesh.positions[24], [0.1; 3]);
    assert_eq!(result.mesh.normals[..25], cube.normals[..], "flat faces keep their normals");
}

// Between the side of a pyramid and its base there is more than a right angle, and the chamfer of a
// tower that is made of it lies nearly in the base where the tower comes from: only where it stands
// does it face along with the sides.
#[test]
fn slanted_faces_are_sound_where_they_are_stretched() {
    let pyramid = shapes::pyramid(4);
    for height in [20.0, -20.0, 0.05] {
        let tower = [[1.0, 0.0, 0.0], [0.0, height, 0.0], [0.0, 0.0, 1.0]];
        let options = Options::default().with_width(Width::Units(0.01)).with_scale(tower);
        let mut result = chamfer(&pyramid.as_mesh(), &options).unwrap();
        assert_eq!(result.totals.chamfered + result.totals.narrowed, 8, "{height}");
        assert_sound("a tower", &pyramid.as_mesh(), &result);
        let edge =
            result.triangle_sources.iter().position(|t| t.kind == TriangleKind::Edge).unwrap();
        result.mesh.indices[3 * edge..3 * edge + 3].reverse();
        let findings = check(&pyramid.as_mesh(), &result, Verify::Fast);
        let mut flipped = findings.breaches.iter().filter(|breach| breach.rule == Rule::Flipped);
        assert!(
            flipped.any(|breach| breach.first == [Element::Triangle(edge as u32)]),
            "{findings}"
        );
    }
}

#[test]
fn each_bad_option_is_named_with_what_was_given() {
    let cube = shapes::plain_cube(1.0);
    let told = |options: Options, factors: Factors| {
        chamfer(&Mesh { factors, ..cube.as_mesh() }, &options).unwrap_err().to_string()
    };
    let (default, none) = (Options::default(), Factors::default());
    assert_eq!(
        told(default.with_angles(-1.0, 9.0), none),
        "min_angle is -1: give degrees from 0 to 180"
    );
    assert_eq!(
        told(default.with_angles(9.0, 200.0), none),
        "max_angle is 200: give degrees from 0 to 180"
    );
    assert!(told(default.with_angles(9.0, 5.0), none).contains("min_angle 9 is larger"));
    assert_eq!(
        told(default.with_hard_angle(f32::NAN), none),
        "hard_angle is NaN: give degrees from 0 to 90"
    );
    let flat = [[1.0, 0.0, 0.0], [0.0; 3], [0.0, 0.0, 1.0]];
    assert!(told(default.with_scale(flat), none).contains("flattens"));
    let submeshes = Factors { submeshes: &[-1.0], ..none };
    assert!(told(default, submeshes).contains("submesh factors: number 0 is -1"));
    let short = Factors { vertices: &[1.0], ..none };
    assert!(told(default, short).contains("vertex factors"));
    let edges = [EdgeFactor { vertices: [0, 99], factor: 1.0 }];
    assert!(
        told(default, Factors { edges: &edges, ..none }).contains("listed edge 0 is of vertex 99")
    );
}

#[test]
fn what_is_not_selected_says_so() {
    let table = shapes::table();
    let options = Options::default().with_angles(100.0, 180.0);
    let result = chamfer(&table.as_mesh(), &options).unwrap();
    assert!(result.totals.hard_edges > 0);
    assert_eq!(result.totals.skipped[Reason::NotSelected], result.totals.hard_edges);
    assert_eq!(result.mesh, table);
}

//  Q ---------- O     the top of a block from above: O-R stays hard. The triangles on its two sides
//   \  C     / /|     lie in one plane, but C beyond leans by a degree, as Q is a little higher
//    \     /B / |
//     \  /   / A|
//      S----R---P
#[test]
fn a_face_beside_an_edge_that_stays_hard_stays_flat() {
    // Normals of B and C at O: another one, nearly that of A, and that of A.
    for at_o in [[0.05, 1.0, 0.0], [0.005, 1.0, 0.0], [0.0, 1.0, 0.0]] {
        for is_last in [false, true] {
            let (mut block, kept) = block(at_o);
            let mut corners = 0..3;
            // Of corners that share a vertex, the first one is asked where it goes.
            if is_last {
                block.indices.rotate_left(3);
                corners = block.indices.len() - 3..block.indices.len();
            }
            let edges = listed(&block, |_, ends| !kept.iter().all(|end| ends.contains(end)));
            let result = with_edges(&block, &edges, 0.02);
            assert_eq!(result.totals.skipped[Reason::NotSelected], 1);
            for &v in &result.mesh.indices[corners.clone()] {
                assert_eq!(result.mesh.positions[v as usize][1], 0.0, "{at_o:?}");
                assert_eq!(result.mesh.normals[v as usize], [0.0, 1.0, 0.0], "{at_o:?}");
            }
            let o = result.mesh.indices[corners.start] as usize;
            assert_ne!(result.mesh.positions[o], kept[0]);
        }
    }
}

// B has a vertex of its own at O, while A and C share theirs: C goes along with B, as light breaks at O-R
// alone.
#[test]
fn a_vertex_of_both_sides_of_an_edge_that_stays_hard_becomes_two_with_it() {
    let (mut block, kept) = block([0.0, 1.0, 0.0]);
    let (own, up) = (block.positions.len() as u32, block.normals[0]);
    block.positions.push(kept[0]);
    block.normals.push(up);
    block.indices[3] = own;
    let edges = listed(&block, |_, ends| !kept.iter().all(|end| ends.contains(end)));
    let result = with_edges(&block, &edges, 0.1);
    let normal = |corner: usize| {
        let normal = result.mesh.normals[result.mesh.indices[corner] as usize];
        DVec3::from(normal.map(f64::from))
    };
    assert_eq!(normal(0), DVec3::Y);
    assert_eq!(normal(3), normal(6));
    let [from, to] = kept.map(|end| DVec3::from(end.map(f64::from)));
    let at = DVec3::from(result.mesh.positions[result.mesh.indices[3] as usize].map(f64::from));
    let share = from.distance(at) / from.distance(to);
    let there = DVec3::Y.lerp(DVec3::new(0.3, 1.0, 0.0).normalize(), share).normalize();
    assert!(normal(3).distance(there) < 1e-5, "{} instead of {there}", normal(3));
}

// There C leans by less than a tenth of a degree, so that nothing holds O to O-R: it goes over C, a hair
// out of the plane of A, which is shaded flat all the same.
#[test]
fn a_face_that_is_nearly_in_one_plane_with_others_keeps_its_normal() {
    let (mut block, kept) = block([0.005, 1.0, 0.0]);
    let q = |at: &&mut [f32; 3]| at[1] > 0.0;
    block.positions.iter_mut().filter(q).for_each(|at| at[1] = 0.002);
    let edges = listed(&block, |_, ends| !kept.iter().all(|end| ends.contains(end)));
    let o = block.indices[0] as usize;
    for width in [0.002, 0.02, 0.05] {
        let result = with_edges(&block, &edges, width);
        assert!(result.mesh.positions[o][1] > 0.0, "{width}");
        assert_eq!(result.mesh.normals[o], [0.0, 1.0, 0.0], "{width}");
    }
}

/// The block, whose first triangle is A, and the ends O and R.
fn block(at_o: [f32; 3]) -> (MeshBuffers, [[f32; 3]; 2]) {
    let [o, p, r] = [[1.0, 0.0, 1.0], [1.0, 0.0, -1.0], [0.0, 0.0, -1.0]];
    let [s, q] = [[-0.5, 0.0, -1.0], [-1.0, 0.04, 1.0]];
    let (up, other) = ([0.0, 1.0, 0.0], [0.3, 1.0, 0.0]);
    let mut mesh = MeshBuffers::default();
    let mut add = |points: [[f32; 3]; 3], normals: [[f32; 3]; 3]| {
        for (point, normal) in points.into_iter().zip(normals) {
            let normal = DVec3::from(normal.map(f64::from)).normalize().as_vec3().to_array();
            let vertices = mesh.positions.iter().zip(&mesh.normals);
            let known = vertices.enumerate().find(|(_, known)| *known == (&point, &normal));
            mesh.indices.push(known.map_or(mesh.positions.len(), |(vertex, _)| vertex) as u32);
            if known.is_none() {
                mesh.positions.push(point);
                mesh.normals.push(normal);
            }
        }
    };
    add([o, p, r], [up; 3]);
    add([o, r, s], [at_o, other, other]);
    add([o, s, q], [at_o, other, other]);
    let flat = |[a, b, c]: [[f32; 3]; 3]| {
        let [a, b, c] = [a, b, c].map(|at| DVec3::from(at.map(f64::from)));
        (b - a).cross(c - a).as_vec3().to_array()
    };
    let low = |[x, _, z]: [f32; 3]| [x, -1.0, z];
    for (a, b) in [(o, q), (q, s), (s, r), (r, p), (p, o)] {
        for side in [[a, b, low(b)], [a, low(b), low(a)]] {
            add(side, [flat(side); 3]);
        }
    }
    for bottom in [[o, r, p], [o, s, r], [o, q, s]] {
        add(bottom.map(low), [[0.0, -1.0, 0.0]; 3]);
    }
    mesh.submesh_index_counts = vec![mesh.indices.len() as u32];
    (mesh, [o, r])
}

/// All hard edges, each with a factor.
fn all_edges(mesh: &Mesh, factor: f32) -> Vec<EdgeFactor> {
    let all = chamfer(mesh, &Options::default()).unwrap().verdicts;
    all.iter().map(|edge| EdgeFactor { vertices: edge.vertices, factor }).collect()
}

proptest! {
    #![proptest_config(seeded(100))]

    // By vertices, by submeshes, and by a list; fine meshes and those that are refined.
    #[test]
    fn what_selects_all_is_no_selection_and_what_selects_nothing_changes_nothing(
        Model(mesh) in clean_mesh(),
        percent in 0.1..5.0f32,
    ) {
        let options = Options::default().with_width(Width::PercentOfExtent(percent));
        let plain = chamfer(&mesh.as_mesh(), &options).unwrap();
        for factor in [1.0, 0.0] {
            let vertices = vec![factor; mesh.positions.len()];
            let submeshes = vec![factor; mesh.submesh_index_counts.len()];
            let edges = all_edges(&mesh.as_mesh(), factor);
            let none = Factors::default();
            let selections = [
                Factors { vertices: &vertices, ..none },
                Factors { submeshes: &submeshes, ..none },
                Factors { edges: &edges, ..none },
            ];
            for factors in selections {
                let result = chamfer(&Mesh { factors, ..mesh.as_mesh() }, &options).unwrap();
                if factor == 1.0 {
                    prop_assert_eq!(&result.mesh, &plain.mesh);
                    prop_assert_eq!(&result.verdicts, &plain.verdicts);
                } else {
                    prop_assert_eq!(&result.mesh, &mesh);
                }
            }
        }
    }
}

//      ______
//    .'      '.      of a prism of four sides, one upright edge is a hundred times as wide as that
//   /          \     before it and that behind it, and the last is as narrow as these
#[test]
fn a_wide_chamfer_beside_narrow_ones_takes_nothing_from_them() {
    let prism = shapes::prism(4);
    let mut upright = listed(&prism, |_, [one, other]| one[2] != other[2]);
    assert_eq!(upright.len(), 4);
    upright[0].factor = 100.0;
    let factors = Factors { edges: &upright, ..Factors::default() };
    let mesh = Mesh { factors, ..prism.as_mesh() };
    for segments in [1, 4] {
        let options = Options::default()
            .with_width(Width::Units(0.003))
            .with_segments(segments)
            .with_verify(Verify::Full);
        let result = chamfer(&mesh, &options).unwrap();
        assert_sound("a hundred to one", &mesh, &result);
        for (k, listed) in upright.iter().enumerate() {
            let edge =
                result.verdicts.iter().find(|edge| edge.vertices == listed.vertices).unwrap();
            assert_eq!(edge.outcome, Outcome::Full, "{edge:?}");
            let asked = if k == 0 { 0.3 } else { 0.003 };
            assert!(edge.widths.iter().all(|width| (width - asked).abs() < 1e-6), "{edge:?}");
        }
    }
}

/// How far the source's vertices at a place went.
fn ways(mesh: &MeshBuffers, result: &Chamfered, from: [f32; 3]) -> Vec<f64> {
    let place = |at: [f32; 3]| DVec3::from(at.map(f64::from));
    let vertices = mesh.positions.iter().zip(&result.mesh.positions);
    let there = vertices.filter(|(before, _)| **before == from);
    there.map(|(&before, &after)| place(before).distance(place(after))).collect()
}

/// All hard edges, each with its factor.
fn unlike(mesh: &MeshBuffers, factor: impl Fn([[f32; 3]; 2]) -> f32) -> Vec<EdgeFactor> {
    let mut edges = listed(mesh, |_, _| true);
    for edge in &mut edges {
        edge.factor = factor(edge.vertices.map(|v| mesh.positions[v as usize]));
    }
    edges
}

#[test]
fn no_tip_between_unlike_widths_goes_farther_than_three() {
    let cone = shapes::pyramid(16);
    let tip = [0.0, 1.0, 0.0];
    let edges = unlike(&cone, |[one, other]| if one[0].min(other[0]) < -0.1 { 1.0 } else { 0.9 });
    let result = with_edges(&cone, &edges, 0.001);
    let longest = ways(&cone, &result, tip).into_iter().fold(0.0, f64::max);
    assert!(longest > 0.0025 && longest < 0.003 + 1e-6, "{longest}");
}

//        T ----------- T1      a roof that is smooth over its ridge T-T1, with a skewed front: the
//      .' '.          .  '.    edges T-L and T-R are unlike wide, and meet the ridge at angles that
//    L ---- R -------'----- R1 differ; T goes along the ridge by what fits both best
#[test]
fn a_vertex_on_a_crease_goes_as_far_as_fits_unlike_widths_best() {
    let [left, right, top] = [[-1.0, 0.0, 0.7], [1.0, 0.0, -0.2], [0.0, 0.3, 0.0]];
    let behind = |[x, y, _]: [f32; 3]| [x, y, 4.0];
    let points = [left, right, top, behind(left), behind(right), behind(top)];
    let faces =
        [[0, 2, 1], [3, 4, 5], [0, 3, 5], [0, 5, 2], [1, 2, 5], [1, 5, 4], [0, 1, 4], [0, 4, 3]];
    let roof = shaded::shaded(&points, faces.as_flattened(), 45.0);
    let edges = unlike(&roof, |ends| match ends {
        ends if !ends.contains(&top) => 1.0,
        ends if ends.contains(&left) => 0.6,
        _ => 1.4,
    });
    let result = with_edges(&roof, &edges, 0.01);
    let sine = |end: [f32; 3]| {
        let to = |at: [f32; 3]| DVec3::from([0, 1, 2].map(|k| f64::from(at[k] - top[k])));
        to(end).normalize().cross(DVec3::Z).length()
    };
    let (one, other) = (sine(left), sine(right));
    let best = (0.006 * one + 0.014 * other) / (one * one + other * other);
    let on_ridge = ways(&roof, &result, top).into_iter().any(|way| (way - best).abs() < 1e-6);
    assert!(on_ridge, "{:?}, not {best}", ways(&roof, &result, top));
}

//     \ | /       eight faces meet at the tip, and two edges across from each other are chamfered: of
//    --- * ---    the four faces on each side, the third slides along an edge that stays hard, by the
//     /  |  \      mean of both widths
#[test]
fn a_face_between_edges_that_stay_hard_slides_by_the_mean_width() {
    let pyramid = shapes::pyramid(8);
    let tip = [0.0, 1.0, 0.0];
    let mut edges = listed(&pyramid, |_, ends| {
        let foot = if ends[0] == tip { ends[1] } else { ends[0] };
        ends.contains(&tip) && foot[2].abs() < 0.1
    });
    assert_eq!(edges.len(), 2);
    (edges[0].factor, edges[1].factor) = (0.8, 1.2);
    let result = with_edges(&pyramid, &edges, 0.01);
    let ways = ways(&pyramid, &result, tip);
    let by_mean = ways.iter().filter(|way| (**way - 0.01).abs() < 1e-6);
    assert_eq!(by_mean.count(), 2, "{ways:?}");
}

/// What is asked for, not what there is room for.
#[test]
fn an_end_without_a_share_keeps_a_sixteenth_of_the_other() {
    let cube = shapes::plain_cube(1.0);
    let mask: Vec<f32> = cube.positions.iter().map(|at| at[1] + 0.5).collect();
    let factors = Factors { vertices: &mask, ..Factors::default() };
    let options = Options::default().with_width(Width::Units(0.1)).with_verify(Verify::Full);
    let mesh = Mesh { factors, ..cube.as_mesh() };
    let result = chamfer(&mesh, &options).unwrap();
    assert_sound("a mask of 0 at the bottom", &mesh, &result);
    let mut upright = 0;
    for edge in &result.verdicts {
        let heights = edge.vertices.map(|v| cube.positions[v as usize][1]);
        if heights[0] != heights[1] {
            let least = edge.widths[usize::from(heights[1] < heights[0])];
            assert!((least - 0.1 / 16.0).abs() < 1e-6, "{edge:?}");
            upright += 1;
        }
    }
    assert_eq!(upright, 4);
}

/// The normals of a rounded chamfer go back to where the mesh came from: they stand on its triangles.
#[test]
fn rounded_chamfers_are_shaded_as_they_are_where_the_mesh_came_from() {
    let cube = shapes::plain_cube(1.0);
    let stretched = [[10.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let options =
        Options::default().with_width(Width::Units(0.1)).with_segments(8).with_scale(stretched);
    let result = chamfer(&cube.as_mesh(), &options).unwrap().mesh;
    for triangle in result.indices.chunks(3) {
        let at = |k: usize| DVec3::from(result.positions[triangle[k] as usize].map(f64::from));
        let face = (at(1) - at(0)).cross(at(2) - at(0)).normalize();
        let normals =
            triangle.iter().map(|&v| DVec3::from(result.normals[v as usize].map(f64::from)));
        let shaded = normals.sum::<DVec3>().normalize();
        assert!(face.dot(shaded) > 0.75, "{face} is shaded as {shaded}");
    }
}

#[test]
fn a_scale_that_flattens_is_refused() {
    let flat = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1e-7]];
    let options = Options::default().with_scale(flat);
    assert!(chamfer(&shapes::plain_cube(1.0).as_mesh(), &options).is_err());
}

/// The widths at the first ends of all hard edges of a cube, in thousandths, sorted.
fn widths(mesh: &MeshBuffers, factors: Factors) -> Vec<i64> {
    let options = Options::default().with_width(Width::Units(0.1));
    let result = chamfer(&Mesh { factors, ..mesh.as_mesh() }, &options).unwrap();
    let width = |edge: &EdgeVerdict| (f64::from(edge.widths[0]) * 1000.0).round() as i64;
    let mut widths: Vec<i64> = result.verdicts.iter().map(width).collect();
    widths.sort_unstable();
    widths
}

#[test]
fn at_the_two_sides_of_an_edge_the_mask_counts_half_each() {
    let cube = shapes::plain_cube(1.0);
    let half: Vec<f32> =
        cube.normals.iter().map(|normal| if normal[1] == 1.0 { 1.0 } else { 0.5 }).collect();
    let found = widths(&cube, Factors { vertices: &half, ..Factors::default() });
    assert_eq!(found, [[50; 8].as_slice(), &[75; 4]].concat(), "those of the top have more");
}

#[test]
fn an_edge_between_two_submeshes_has_the_smaller_factor() {
    let mut cube = shapes::plain_cube(1.0);
    cube.submesh_index_counts = vec![6, 30];
    let found = widths(&cube, Factors { submeshes: &[0.5, 1.0], ..Factors::default() });
    assert_eq!(found, [[50; 4].as_slice(), &[100; 8]].concat());
    let found = widths(&cube, Factors { submeshes: &[1.0, 0.5], ..Factors::default() });
    assert_eq!(found, [50; 12]);
}

#[test]
fn of_an_edge_that_is_listed_twice_the_first_counts() {
    let cube = shapes::plain_cube(1.0);
    let mut edges = listed(&cube, |_, _| true);
    for edge in &mut edges {
        edge.factor = 0.5;
    }
    edges.extend(listed(&cube, |_, _| true));
    assert_eq!(widths(&cube, Factors { edges: &edges, ..Factors::default() }), [50; 12]);
}

/// Within five degrees of a folded edge a chord says nothing of the offset.
#[test]
fn no_width_is_more_than_23_times_what_was_asked() {
    let wedge = shapes::wedge(2f32.to_radians());
    let options =
        Options::default().with_width(Width::Units(1e-4)).with_width_mode(WidthMode::Chord);
    let result = chamfer(&wedge.as_mesh(), &options).unwrap();
    assert!((result.largest_width - 23e-4).abs() < 1e-8, "{}", result.largest_width);
}

/// What would be given back to it could not be told from how it is shaded.
#[test]
fn a_face_that_is_not_shaded_flat_keeps_its_corners() {
    let mut cube = shapes::plain_cube(1.0);
    for normal in cube.normals.iter_mut().filter(|normal| normal[1] == 1.0) {
        *normal = [0.1, 0.995, 0.0];
    }
    let edges = listed(&cube, |_, [from, to]| from[1] != to[1]);
    let result = with_edges(&cube, &edges, 0.1);
    for edge in edges.iter().map(|edge| edge.vertices) {
        let verdict = result.verdicts.iter().find(|verdict| verdict.vertices == edge).unwrap();
        for (v, width) in edge.into_iter().zip(verdict.widths) {
            let is_top = cube.positions[v as usize][1] > 0.0;
            assert_eq!(width == 0.0, is_top, "{verdict:?}");
        }
    }
    assert_eq!(area(&result.mesh, &cap(&result.mesh, 1, 0.5)), 1.0);
}

/// Two faces have the same texture coordinates at a corner, and other ones along the edge between them,
/// over which both slide: each follows its own.
#[test]
fn faces_that_agree_at_a_corner_alone_keep_their_own_textures() {
    let mut cube = shapes::cube(1.0);
    // From the corner (1, 1, 1), where all three have (0, 0), along the next axis and the one after.
    let place = |(at, normal): (&[f32; 3], &[f32; 3])| {
        let axis = (0..3).find(|&k| normal[k].abs() > 0.5).unwrap();
        [1, 2].map(|k| 1.0 - at[(axis + k) % 3])
    };
    cube.uvs[0].components = 2;
    cube.uvs[0].values = cube.positions.iter().zip(&cube.normals).flat_map(place).collect();
    let triangles = cube.indices.as_chunks::<3>().0.iter();
    let sides = triangles.flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
    let is_along_z = |[a, b]: [u32; 2]| {
        let [a, b] = [a, b].map(|vertex| cube.positions[vertex as usize]);
        a[..2] == b[..2]
    };
    let across = sides.filter(|&side| !is_along_z(side));
    let edges: Vec<EdgeFactor> =
        across.map(|vertices| EdgeFactor { vertices, factor: 1.0 }).collect();
    let factors = Factors { edges: &edges, ..Factors::default() };
    let mesh = Mesh { factors, ..cube.as_mesh() };
    let result = chamfer(&mesh, &Options::default().with_width(Width::Units(0.1))).unwrap();
    assert_eq!((result.totals.chamfered, result.totals.skipped[Reason::NotSelected]), (8, 4));
    assert_sound("cube", &mesh, &result);
}
