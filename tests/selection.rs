//! Which edges are chamfered, how wide, and in which space: on random meshes and corners.

#[path = "support/prism.rs"]
mod prism;
#[allow(dead_code)] // Other tests use more of it.
#[path = "support/random.rs"]
mod random;
#[path = "support/shaded.rs"]
mod shaded;

use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

use chamfer::check::{assert_sound, check};
use chamfer::{
    Chamfered, Convexity, EdgeFactor, EdgeVerdict, Factors, Mesh, MeshBuffers, Options, Outcome,
    Reason, Verify, Width, WidthMode, chamfer, shapes,
};
use glam::{DMat3, DVec3};
use proptest::prelude::*;
use proptest::test_runner::{Config, RngSeed};

use random::{Model, clean_mesh};

fn config(cases: u32) -> Config {
    let asked = Config::default();
    let is_given = std::env::var_os("PROPTEST_CASES").is_some();
    let rng_seed = match asked.rng_seed {
        RngSeed::Random => RngSeed::Fixed(1),
        fixed => fixed,
    };
    let cases = if is_given { asked.cases } else { cases };
    Config { cases, rng_seed, failure_persistence: None, ..asked }
}

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
    #![proptest_config(config(300))]

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
    #![proptest_config(config(300))]

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
    #![proptest_config(config(1000))]

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
    #![proptest_config(config(200))]

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
        let (block, kept) = block(at_o);
        let edges = listed(&block, |_, ends| !kept.iter().all(|end| ends.contains(end)));
        let result = with_edges(&block, &edges, 0.02);
        assert_eq!(result.totals.skipped[Reason::NotSelected], 1);
        for k in 0..3 {
            let v = result.mesh.indices[k] as usize;
            assert_eq!(result.mesh.positions[v][1], 0.0, "{at_o:?}");
            assert_eq!(result.mesh.normals[v], [0.0, 1.0, 0.0], "{at_o:?}");
        }
        assert_ne!(result.mesh.positions[result.mesh.indices[0] as usize], kept[0]);
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
