//! What holds for every mesh, tried on random ones.
//!
//! The same cases on every run, so that a failure is a change's and not the day's. To look for
//! more: `PROPTEST_RNG_SEED=2 PROPTEST_CASES=20000 cargo test --release --test properties`.

#[path = "support/crowded.rs"]
mod crowded;
#[path = "support/prism.rs"]
mod prism;
#[path = "support/random.rs"]
mod random;
#[path = "support/seeded.rs"]
mod seeded;
#[path = "support/shaded.rs"]
mod shaded;

use chamfer::check::{Findings, Rule, check};
use chamfer::{
    ChamferSubmesh, Chamfered, Convexity, MeshBuffers, Options, Verify, Width, WidthMode, chamfer,
};
use proptest::prelude::*;
use proptest::sample;

use crowded::has_crowded_edges;
use random::{Model, clean_mesh, soup};

use seeded::seeded;

/// From hair-fine to a fifth of the extent, which is wider than most features.
fn percent() -> impl Strategy<Value = f32> {
    prop_oneof![0.01..1.0f32, 1.0..20.0f32]
}

fn chamfered(mesh: &MeshBuffers, percent: f32, verify: Verify) -> Chamfered {
    let options =
        Options::default().with_width(Width::PercentOfExtent(percent)).with_verify(verify);
    chamfer(&mesh.as_mesh(), &options).unwrap()
}

fn rounded(
    mesh: &MeshBuffers,
    percent: f32,
    (segments, profile): (u32, f32),
    verify: Verify,
) -> Chamfered {
    let options = Options::default()
        .with_width(Width::PercentOfExtent(percent))
        .with_segments(segments)
        .with_profile(profile)
        .with_verify(verify);
    chamfer(&mesh.as_mesh(), &options).unwrap()
}

/// Stretched, mirrored, turned and sheared; the volume stays more than a hundredth of that of a cube
/// over the longest axis, which single precision can tell from nothing.
fn scale() -> impl Strategy<Value = [[f32; 3]; 3]> {
    let axis = prop_oneof![0.2..5.0f32, -5.0..-0.2f32];
    let along = [axis.clone(), axis.clone(), axis];
    let shear = prop_oneof![Just(0.0f32), -0.5..0.5f32];
    (along, shear)
        .prop_map(|([x, y, z], shear)| [[x, shear * y, 0.0], [0.0, y, 0.0], [0.0, 0.0, z]])
}

fn options(scale: [[f32; 3]; 3]) -> impl Strategy<Value = Options> {
    let widths = (percent(), prop_oneof![Just(0.5f32), 0.0..=1.0f32], 0.0..0.9f32);
    let modes = vec![WidthMode::Offset, WidthMode::Chord, WidthMode::Depth, WidthMode::Radius];
    let ways = vec![Convexity::Both, Convexity::Convex, Convexity::Concave];
    let submeshes = vec![ChamferSubmesh::Owner, ChamferSubmesh::Own, ChamferSubmesh::Given(0)];
    let kinds = (sample::select(modes), sample::select(ways), sample::select(submeshes));
    let kinds = kinds.boxed();
    (widths, kinds, (1..4u32, 0.0..1.0f32), 0.0..90.0f32).prop_map(
        move |((percent, evenness, breadth), (mode, way, submesh), (segments, profile), least)| {
            Options::default()
                .with_width(Width::PercentOfExtent(percent))
                .with_evenness(evenness)
                .with_least_breadth(breadth)
                .with_width_mode(mode)
                .with_convexity(way)
                .with_chamfer_submesh(submesh)
                .with_segments(segments)
                .with_profile(profile)
                .with_angles(least / 3.0, 180.0 - least)
                .with_scale(scale)
        },
    )
}

fn findings(mesh: &MeshBuffers, percent: f32, verify: Verify) -> Findings {
    check(&mesh.as_mesh(), &chamfered(mesh, percent, verify), verify)
}

/// As [`Findings::is_sound`], but an edge of many sides may come apart into two of fewer, which
/// counts as one edge more with too many sides.
fn is_sound_for_soup(mesh: &MeshBuffers, findings: &Findings) -> bool {
    let may_be = |rule: Rule| rule == Rule::NonManifold && has_crowded_edges(mesh);
    findings.breaches.iter().all(|breach| may_be(breach.rule))
}

fn any_mesh() -> impl Strategy<Value = Model> {
    prop_oneof![4 => clean_mesh(), 1 => soup()]
}

proptest! {
    #![proptest_config(seeded(400))]

    #[test]
    fn a_chamfered_mesh_is_sound(Model(mesh) in clean_mesh(), percent in percent()) {
        let findings = findings(&mesh, percent, Verify::Full);
        prop_assert!(findings.is_sound(), "{findings}");
    }

    #[test]
    fn a_chamfered_soup_is_sound(Model(mesh) in soup(), percent in percent()) {
        for segments in [1, 2, 4] {
            let result = rounded(&mesh, percent, (segments, 0.5), Verify::Fast);
            let findings = check(&mesh.as_mesh(), &result, Verify::Fast);
            prop_assert!(is_sound_for_soup(&mesh, &findings), "{segments} segments: {findings}");
        }
    }

    #[test]
    fn a_rounded_mesh_is_sound(
        Model(mesh) in clean_mesh(),
        percent in percent(),
        (segments, profile) in (2..7u32, prop_oneof![3 => Just(0.5f32), 1 => 0.0..1.0f32]),
    ) {
        for verify in [Verify::Fast, Verify::Full] {
            let result = rounded(&mesh, percent, (segments, profile), verify);
            let findings = check(&mesh.as_mesh(), &result, verify);
            prop_assert!(findings.is_sound(), "{verify:?}: {findings}");
        }
    }
}

proptest! {
    #![proptest_config(seeded(400))]

    #[test]
    fn whatever_is_asked_for_a_mesh_that_stands_stretched_it_is_sound(
        Model(mesh) in clean_mesh(),
        options in scale().prop_flat_map(options),
    ) {
        let result = chamfer(&mesh.as_mesh(), &options).unwrap();
        let findings = check(&mesh.as_mesh(), &result, Verify::Full);
        prop_assert!(findings.is_sound(), "{options:?}: {findings}");
    }
}

proptest! {
    #![proptest_config(seeded(150))]

    #[test]
    fn twice_the_same_gives_the_same_bytes(Model(mesh) in any_mesh(), percent in percent()) {
        let [one, other] = [0, 1].map(|_| chamfered(&mesh, percent, Verify::Full));
        prop_assert!(one.mesh == other.mesh);
        prop_assert_eq!(one.vertex_sources, other.vertex_sources);
        prop_assert_eq!(one.triangle_sources, other.triangle_sources);
        prop_assert_eq!(one.verdicts, other.verdicts);
    }

    #[test]
    fn width_zero_changes_nothing(Model(mesh) in clean_mesh()) {
        prop_assert!(chamfered(&mesh, 0.0, Verify::Full).mesh == mesh);
    }

    #[test]
    fn what_comes_out_can_go_in_again(Model(mesh) in any_mesh(), percent in percent()) {
        let once = chamfered(&mesh, percent, Verify::Fast).mesh;
        let findings = findings(&once, percent, Verify::Fast);
        prop_assert!(is_sound_for_soup(&once, &findings), "{findings}");
    }

    #[test]
    fn a_mesh_scaled_by_a_power_of_two_is_chamfered_alike(
        Model(mesh) in any_mesh(),
        percent in percent(),
        power in -20..20i32,
    ) {
        let scale = 2.0_f32.powi(power);
        let scaled = |mesh: &MeshBuffers| {
            let positions = mesh.positions.iter().map(|p| p.map(|along| along * scale)).collect();
            MeshBuffers { positions, ..mesh.clone() }
        };
        let expected = scaled(&chamfered(&mesh, percent, Verify::Fast).mesh);
        prop_assert!(chamfered(&scaled(&mesh), percent, Verify::Fast).mesh == expected);
    }

    #[test]
    fn the_order_of_triangles_does_not_matter(
        (Model(mesh), order) in clean_mesh().prop_flat_map(|model| {
            let order: Vec<usize> = (0..model.0.indices.len() / 3).collect();
            (Just(model), Just(order).prop_shuffle())
        }),
        percent in percent(),
    ) {
        let corners = order.iter().flat_map(|&triangle| 3 * triangle..3 * triangle + 3);
        let indices = corners.map(|corner| mesh.indices[corner]).collect();
        let shuffled = MeshBuffers { indices, ..mesh.clone() };
        let findings = findings(&shuffled, percent, Verify::Fast);
        prop_assert!(findings.is_sound(), "{findings}");
    }
}
