//! Parts that touch: boxes that share corners, edges, faces or flush sides, some of them open, some
//! there twice, some turned.
//!
//! The same cases on every run. For more: `PROPTEST_CASES=4000 cargo test --release --test
//! assemblies`.

#[path = "support/boxes.rs"]
mod boxes;

use chamfer::check::check;
use chamfer::{Options, Verify, Width, chamfer};
use glam::{DMat3, DVec3};
use proptest::collection::vec;
use proptest::prelude::*;
use proptest::test_runner::{Config, RngSeed};

use boxes::{Block, Skin, assembly};

/// As many as a debug build checks in a few seconds.
const CASES: u32 = 300;

fn config() -> Config {
    let asked = Config::default();
    Config {
        cases: if std::env::var_os("PROPTEST_CASES").is_some() { asked.cases } else { CASES },
        rng_seed: match asked.rng_seed {
            RngSeed::Random => RngSeed::Fixed(1),
            fixed => fixed,
        },
        failure_persistence: None,
        ..asked
    }
}

/// Places on a coarse grid, so that boxes have corners, edges and sides in common.
fn block() -> impl Strategy<Value = Block> {
    let without =
        prop_oneof![4 => Just(0u8), 1 => (0..6u32).prop_map(|face| 1 << face), 1 => 0..63u8];
    let skin = prop_oneof![
        5 => Just(Skin::Once),
        1 => Just(Skin::Copied),
        1 => Just(Skin::TwoSided)
    ];
    let place = ([0..4i32, 0..4i32, 0..4i32], [1..4i32, 1..4i32, 1..4i32]);
    (place, without, skin, 0..4096u16).prop_map(|((low, size), without, skin, diagonals)| {
        let at = |k: usize| f64::from(low[k]);
        let end = |k: usize| f64::from(low[k] + size[k]);
        Block { low: [0, 1, 2].map(at), high: [0, 1, 2].map(end), without, skin, diagonals }
    })
}

fn turn() -> impl Strategy<Value = DMat3> {
    let turned =
        (0.0..3.0f64).prop_map(|angle| DMat3::from_axis_angle(DVec3::new(0.6, 0.0, 0.8), angle));
    prop_oneof![2 => Just(DMat3::IDENTITY), 1 => turned]
}

fn percent() -> impl Strategy<Value = f32> {
    prop_oneof![Just(1.0f32), 0.1..4.0f32, 4.0..20.0f32]
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn assemblies_of_boxes_are_sound(
        blocks in vec(block(), 1..6),
        turn in turn(),
        is_merged in any::<bool>(),
        percent in percent(),
    ) {
        let mesh = assembly(&blocks, turn, is_merged);
        for verify in [Verify::Fast, Verify::Full] {
            let width = Width::PercentOfExtent(percent);
            let options = Options { width, verify, ..Options::default() };
            let result = chamfer(&mesh.as_mesh(), &options).unwrap();
            let findings = check(&mesh.as_mesh(), &result, verify);
            prop_assert!(findings.is_sound(), "{verify:?}: {findings}");
        }
    }
}

#[test]
#[ignore]
fn scan() {
    use proptest::strategy::ValueTree;
    use proptest::test_runner::TestRunner;
    let n: usize = std::env::var("SCAN").ok().and_then(|n| n.parse().ok()).unwrap_or(1000);
    let mut runner = TestRunner::new(config());
    let strategy = (vec(block(), 1..6), turn(), any::<bool>(), percent());
    let mut bad = 0;
    let mut tally = std::collections::BTreeMap::new();
    for _ in 0..n {
        let (blocks, turn, is_merged, percent) = strategy.new_tree(&mut runner).unwrap().current();
        let mesh = assembly(&blocks, turn, is_merged);
        let mut is_bad = false;
        for verify in [Verify::Fast, Verify::Full] {
            let width = Width::PercentOfExtent(percent);
            let options = Options { width, verify, ..Options::default() };
            let result = chamfer(&mesh.as_mesh(), &options).unwrap();
            let findings = check(&mesh.as_mesh(), &result, verify);
            if !findings.is_sound() {
                is_bad = true;
                let rules: Vec<_> = findings.breaches.iter().map(|b| b.rule.name()).collect();
                if true {
                    eprintln!(
                        "{verify:?} {rules:?} merged {is_merged} {percent} {blocks:?} {}\n{findings}",
                        turn == DMat3::IDENTITY
                    );
                }
                *tally.entry(format!("{verify:?} {rules:?}")).or_insert(0) += 1;
            }
        }
        bad += usize::from(is_bad);
    }
    eprintln!("{bad} of {n}: {tally:#?}");
}

#[test]
#[ignore]
fn one() {
    let b = |low, high, w, skin, d| Block {
        without: w,
        diagonals: d,
        ..Block::new(low, high).with(skin)
    };
    let cases = [
        (
            false,
            18.061472f32,
            vec![
                b([1.0, 3.0, 0.0], [4.0, 4.0, 1.0], 1, Skin::Once, 2002),
                b([1.0, 1.0, 0.0], [4.0, 3.0, 2.0], 0, Skin::Once, 3655),
                b([2.0, 1.0, 0.0], [4.0, 3.0, 3.0], 4, Skin::Once, 2937),
                b([3.0, 2.0, 2.0], [5.0, 3.0, 3.0], 0, Skin::Copied, 1449),
            ],
        ),
        (
            true,
            7.58,
            vec![
                b([3.0, 2.0, 1.0], [6.0, 5.0, 3.0], 0, Skin::TwoSided, 1575),
                b([3.0, 0.0, 2.0], [4.0, 2.0, 4.0], 1, Skin::TwoSided, 1942),
                b([2.0, 0.0, 0.0], [3.0, 2.0, 3.0], 0, Skin::Copied, 2406),
                b([3.0, 2.0, 3.0], [4.0, 3.0, 6.0], 0, Skin::Copied, 2520),
            ],
        ),
        (
            true,
            1.0,
            vec![
                b([1.0, 2.0, 2.0], [3.0, 3.0, 4.0], 60, Skin::Once, 1971),
                b([2.0, 3.0, 1.0], [5.0, 4.0, 2.0], 0, Skin::Once, 3933),
                b([3.0, 2.0, 0.0], [6.0, 3.0, 2.0], 8, Skin::Once, 3143),
                b([3.0, 0.0, 0.0], [4.0, 2.0, 2.0], 1, Skin::Once, 3884),
                b([1.0, 2.0, 1.0], [4.0, 4.0, 4.0], 0, Skin::Once, 496),
            ],
        ),
        (
            false,
            1.0,
            vec![
                b([1.0, 2.0, 3.0], [3.0, 3.0, 6.0], 32, Skin::Once, 1377),
                b([3.0, 3.0, 2.0], [5.0, 6.0, 5.0], 0, Skin::Once, 4060),
                b([2.0, 3.0, 1.0], [4.0, 5.0, 3.0], 11, Skin::Copied, 1478),
                b([1.0, 3.0, 2.0], [2.0, 5.0, 3.0], 0, Skin::Once, 612),
                b([1.0, 3.0, 1.0], [2.0, 6.0, 3.0], 0, Skin::Once, 734),
            ],
        ),
    ];
    for (merged, percent, blocks) in cases {
        for angle in [0.0, 0.2, 0.3, 0.5, 0.7, 1.0, 1.2, 1.5, 2.0, 2.5] {
            let turn = DMat3::from_axis_angle(DVec3::new(0.6, 0.0, 0.8), angle);
            let mesh = assembly(&blocks, turn, merged);
            let options = Options { width: Width::PercentOfExtent(percent), ..Options::default() };
            let result = chamfer(&mesh.as_mesh(), &options).unwrap();
            let findings = check(&mesh.as_mesh(), &result, Verify::Full);
            if findings.is_sound() {
                continue;
            }
            eprintln!("====== {blocks:?}");
            for breach in &findings.breaches {
                eprintln!("{breach:?}");
            }
            let back = turn.transpose();
            let show = |t: usize| {
                let tri = &result.mesh.indices[3 * t..3 * t + 3];
                eprintln!(
                    "   {t} {tri:?} {:?} {:.3?}",
                    result.triangle_sources[t],
                    tri.iter()
                        .map(|&v| (back
                            * DVec3::from(result.mesh.positions[v as usize].map(f64::from)))
                        .to_array())
                        .collect::<Vec<_>>()
                );
            };
            for breach in &findings.breaches {
                for e in &breach.first {
                    match e {
                        chamfer::check::Element::Edge(a, b) => {
                            eprintln!("edge {a} {b}");
                            for (t, tri) in result.mesh.indices.chunks(3).enumerate() {
                                let pos = |v: u32| result.mesh.positions[v as usize];
                                let has = |w: u32| tri.iter().any(|&x| pos(x) == pos(w));
                                if has(*a) && has(*b) {
                                    show(t)
                                }
                            }
                        }
                        chamfer::check::Element::Triangles(a, b) => {
                            eprintln!("cut");
                            show(*a as usize);
                            show(*b as usize)
                        }
                        _ => {}
                    }
                }
            }
            for (k, v) in result.verdicts.iter().enumerate() {
                if v.reason != chamfer::Reason::None {
                    let p = v.vertices.map(|v| {
                        (back * DVec3::from(mesh.positions[v as usize].map(f64::from))).to_array()
                    });
                    eprintln!("{k} {v:?} {:.2?}", p);
                }
            }
            break;
        }
    }
}
