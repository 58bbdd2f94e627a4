//! Solids cut from boxes, cylinders and spheres at random: what modellers make with booleans, with
//! slivers, thin walls and tiny features wherever two surfaces happen to meet.
//!
//! The same solids on every run. For others: `SOLIDS_SEED=2 SOLIDS=500 cargo test --release --test
//! solids -- --nocapture`.

#[path = "support/shaded.rs"]
mod shaded;

use boolmesh::prelude::{Manifold, OpType, compute_boolean};
use chamfer::check::{assert_sound, check};
use chamfer::{MeshBuffers, Options, Verify, Width, chamfer, shapes};
use glam::{DQuat, DVec3};
use proptest::collection::vec;
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::{Config, RngSeed, TestRunner};

use shaded::{FLAT, shaded};

/// Faces of round parts meet at less than this, in degrees, and shade as one.
const ROUND: f32 = 40.0;

/// A closed body: points and triangles.
type Body = (Vec<DVec3>, Vec<usize>);

fn welded(mesh: &MeshBuffers) -> Body {
    let mut points: Vec<[f32; 3]> = Vec::new();
    let mut place = |at: [f32; 3]| {
        points.iter().position(|known| *known == at).unwrap_or_else(|| {
            points.push(at);
            points.len() - 1
        })
    };
    let corners = mesh.indices.iter().map(|&vertex| place(mesh.positions[vertex as usize]));
    let triangles: Vec<usize> = corners.collect();
    let has_area = |t: &&[usize]| t[0] != t[1] && t[1] != t[2] && t[2] != t[0];
    let triangles = triangles.chunks(3).filter(has_area).flatten().copied().collect();
    (points.into_iter().map(|at| DVec3::from(at.map(f64::from))).collect(), triangles)
}

fn primitive() -> impl Strategy<Value = Body> {
    prop_oneof![
        Just(()).prop_map(|()| shapes::plain_cube(1.0)),
        (5..40u32).prop_map(shapes::cylinder),
        (4..16u32, 8..32u32).prop_map(|(rings, segments)| shapes::sphere(rings, segments)),
    ]
    .prop_map(|mesh| welded(&mesh))
}

/// A primitive of some size, mostly turned, near the origin.
fn part() -> impl Strategy<Value = Body> {
    let turn = ((-1.0..1.0, -1.0..1.0, 0.1..1.0), 0.0..6.0f64, any::<u8>());
    let triple = |range: std::ops::Range<f64>| (range.clone(), range.clone(), range);
    (primitive(), triple(0.3..1.2), turn, triple(-0.5..0.5)).prop_map(
        |((points, triangles), size, (axis, angle, straight), at)| {
            let (size, at) = (DVec3::from(size), DVec3::from(at));
            let angle = if straight < 100 { 0.0 } else { angle };
            let turn = DQuat::from_axis_angle(DVec3::from(axis).normalize(), angle);
            (points.into_iter().map(|point| turn * (point * size) + at).collect(), triangles)
        },
    )
}

fn manifold((points, triangles): &Body) -> Result<Manifold<f64>, String> {
    let coordinates: Vec<f64> = points.iter().flat_map(|point| point.to_array()).collect();
    Manifold::new(&coordinates, triangles)
}

/// Parts joined, cut off and kept in common; what the boolean library cannot do is left out.
fn solid(first: &Body, others: &[(Body, u8)], smooth_up_to: f32) -> Result<MeshBuffers, String> {
    let mut solid = manifold(first)?;
    for (other, operation) in others {
        let operation = match operation {
            0..100 => OpType::Add,
            100..225 => OpType::Subtract,
            _ => OpType::Intersect,
        };
        let next = compute_boolean(&solid, &manifold(other)?, operation)?;
        if !next.hs.is_empty() {
            solid = next;
        }
    }
    let points: Vec<[f32; 3]> =
        solid.ps.iter().map(|at| [at.x, at.y, at.z].map(|part| part as f32)).collect();
    let indices: Vec<u32> = solid.hs.iter().map(|half| half.tail as u32).collect();
    Ok(shaded(&points, &indices, smooth_up_to))
}

fn number(variable: &str, default: u64) -> u64 {
    std::env::var(variable).ok().and_then(|text| text.parse().ok()).unwrap_or(default)
}

fn solids() -> Vec<MeshBuffers> {
    let rng_seed = RngSeed::Fixed(number("SOLIDS_SEED", 1));
    let mut runner = TestRunner::new(Config { rng_seed, ..Config::default() });
    let plan = (part(), vec((part(), any::<u8>()), 1..7));
    let planned = (0..number("SOLIDS", 60)).map(|number| {
        let (first, others) = plan.new_tree(&mut runner).unwrap().current();
        solid(&first, &others, if number % 4 == 0 { FLAT } else { ROUND })
    });
    planned.filter_map(Result::ok).collect()
}

/// Chamfers all; returns the share of the hard edges that have a chamfer.
fn coverage(solids: &[MeshBuffers], percent: f32) -> f64 {
    let (mut hard, mut chamfered) = (0, 0);
    for (number, mesh) in solids.iter().enumerate() {
        let options = Options::default()
            .with_width(Width::PercentOfExtent(percent))
            .with_verify(Verify::Full);
        let result = chamfer(&mesh.as_mesh(), &options).unwrap();
        assert_sound(&format!("solid {number} at {percent} %"), &mesh.as_mesh(), &result);
        hard += result.totals.hard_edges;
        chamfered += result.totals.chamfered + result.totals.narrowed;
    }
    f64::from(chamfered) / f64::from(hard)
}

#[test]
fn random_solids_are_sound_and_nearly_all_of_their_edges_chamfered() {
    let solids = solids();
    assert!(solids.len() as u64 > number("SOLIDS", 60) / 2, "{} solids", solids.len());
    for (percent, least) in [(0.2, 0.995), (0.5, 0.993), (2.0, 0.985), (10.0, 0.97)] {
        let coverage = coverage(&solids, percent);
        println!(
            "{} solids at {percent} %: {:.2} % of the hard edges",
            solids.len(),
            100.0 * coverage
        );
        assert!(coverage >= least, "{coverage} at {percent} %");
    }
}

/// Fewer than above: each is chamfered twelve times.
#[test]
fn random_solids_are_sound_with_rounded_chamfers() {
    let solids = solids();
    for (number, mesh) in solids.iter().enumerate().step_by(number("SOLIDS_STEP", 4) as usize) {
        for (percent, segments) in [(0.5, 2), (2.0, 2), (5.0, 2), (0.5, 4), (2.0, 4), (5.0, 4)] {
            for verify in [Verify::Fast, Verify::Full] {
                let options = Options::default()
                    .with_width(Width::PercentOfExtent(percent))
                    .with_segments(segments)
                    .with_verify(verify);
                let result = chamfer(&mesh.as_mesh(), &options).unwrap();
                let name = format!("solid {number} at {percent} % and {segments}");
                let findings = check(&mesh.as_mesh(), &result, verify);
                assert!(findings.is_sound(), "{name}, {verify:?}: {findings}");
            }
        }
    }
}
