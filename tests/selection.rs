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
    Chamfered, Convexity, EdgeFactor, Factors, Mesh, MeshBuffers, Options, Outcome, Reason, Verify,
    Width, WidthMode, chamfer, shapes,
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
