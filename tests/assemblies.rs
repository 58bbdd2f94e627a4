//! Parts that touch: boxes that share corners, edges, faces or flush sides, some of them open, some
//! there twice, some turned.
//!
//! The same cases on every run. For more: `PROPTEST_CASES=4000 cargo test --release --test
//! assemblies`.

#[path = "support/boxes.rs"]
mod boxes;
#[path = "support/seeded.rs"]
mod seeded;

use chamfer::check::{Element, Rule, assert_sound, check, compare};
use chamfer::{Chamfered, MeshBuffers, Options, Reason, Verify, Width, chamfer};
use glam::{DMat3, DVec3};
use proptest::collection::vec;
use proptest::prelude::*;

use boxes::{Block, Skin, assembly};
use seeded::seeded;

/// As many as a debug build checks in a few seconds.
const CASES: u32 = 300;

/// Segments, and how much is verified.
const WAYS: [(u32, Verify); 6] = [
    (1, Verify::Fast),
    (1, Verify::Full),
    (2, Verify::Fast),
    (2, Verify::Full),
    (4, Verify::Fast),
    (4, Verify::Full),
];

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
    #![proptest_config(seeded(CASES))]

    #[test]
    fn assemblies_of_boxes_are_sound(
        blocks in vec(block(), 1..6),
        turn in turn(),
        is_merged in any::<bool>(),
        percent in percent(),
    ) {
        let mesh = assembly(&blocks, turn, is_merged);
        let options = Options::default().with_width(Width::PercentOfExtent(percent));
        for (segments, verify) in WAYS {
            let options = options.with_segments(segments).with_verify(verify);
            let result = chamfer(&mesh.as_mesh(), &options).unwrap();
            let findings = check(&mesh.as_mesh(), &result, verify);
            prop_assert!(findings.is_sound(), "{segments} segments, {verify:?}: {findings}");
        }
    }
}

fn chamfered(name: &str, mesh: &MeshBuffers, width: f32) -> Chamfered {
    let options = Options::default().with_width(Width::Units(width));
    let result = chamfer(&mesh.as_mesh(), &options).unwrap();
    assert_sound(name, &mesh.as_mesh(), &result);
    result
}

/// A top and four legs that reach through it, flush with its sides and its upper face: five solids.
#[test]
fn a_table_with_flush_legs_is_five_solids() {
    let mut blocks = vec![Block::new([0.0, 0.9, 0.0], [2.0, 1.0, 1.0])];
    for (x, z) in [(0.0, 0.0), (1.9, 0.0), (0.0, 0.9), (1.9, 0.9)] {
        blocks.push(Block::new([x, 0.0, z], [x + 0.1, 1.0, z + 0.1]));
    }
    let table = assembly(&blocks, DMat3::IDENTITY, false);
    let result = chamfered("table", &table, 0.02);
    assert!(result.totals.chamfered + result.totals.narrowed >= 58);
}

/// A wall and a skirting board with a lower edge in common: both keep their own faces there.
#[test]
fn a_board_on_a_wall_is_chamfered_with_it() {
    let wall = Block::new([0.0, 0.0, 0.0], [4.0, 3.0, 0.2]);
    let board = Block::new([0.0, 0.0, 0.0], [4.0, 0.2, 0.3]);
    let mesh = assembly(&[wall, board], DMat3::IDENTITY, false);
    let result = chamfered("wall", &mesh, 0.04);
    assert_eq!(result.totals.chamfered, 24);
}

#[test]
fn a_box_that_is_there_twice_is_chamfered_twice() {
    for (skin, diagonals) in
        [(Skin::Copied, 0), (Skin::Copied, 0o77), (Skin::TwoSided, 0), (Skin::TwoSided, 0o52)]
    {
        let block = Block { diagonals, ..Block::new([0.0; 3], [1.0; 3]).with(skin) };
        let mesh = assembly(&[block], DMat3::IDENTITY, false);
        let result = chamfered("box", &mesh, 0.02);
        assert_eq!(result.totals.chamfered, 24, "{skin:?}");
        let [first, second] = [0, 24].map(|start| {
            let mut points = result.mesh.positions[start..start + 24].to_vec();
            points.sort_by(|a, b| a.partial_cmp(b).unwrap());
            points
        });
        assert_eq!(first, second, "both skins follow");
        let edges = compare(&mesh.as_mesh(), &result.mesh.as_mesh(), Verify::Fast).edges;
        assert_eq!(edges.len(), 24);
        let is_measured = |width: f32| (width - 0.02).abs() < 1e-6;
        assert!(edges.iter().all(|edge| edge.widths().into_iter().all(is_measured)), "{edges:?}");
    }
}

/// Copies that are open are two open boxes, however the faces of each are cut.
#[test]
fn an_open_box_that_is_there_twice_is_chamfered_twice() {
    for diagonals in [0, 0o77, 0o7700] {
        let open = Block { diagonals, without: 0b1000, ..Block::new([0.0; 3], [1.0; 3]) };
        let mesh = assembly(&[open.with(Skin::Copied)], DMat3::IDENTITY, false);
        let result = chamfered("box", &mesh, 0.02);
        assert_eq!((result.totals.chamfered, result.totals.hard_edges), (16, 16), "{diagonals}");
        let [first, second] = [0, 20].map(|start| {
            let mut points = result.mesh.positions[start..start + 20].to_vec();
            points.sort_by(|a, b| a.partial_cmp(b).unwrap());
            points
        });
        assert_eq!(first, second, "both copies follow");
    }
}

/// A folded sheet of two sides, as a card is: both sides of its fold are chamfered alike, so that they
/// still lie on each other, and its rims have nothing to cut off.
#[test]
fn a_folded_card_of_two_sides_is_chamfered_along_its_fold() {
    let block = Block { without: 0b11_1010, ..Block::new([0.0; 3], [1.0; 3]).with(Skin::TwoSided) };
    for segments in [1, 3] {
        let card = assembly(&[block], DMat3::IDENTITY, false);
        let options = Options::default().with_width(Width::Units(0.02)).with_segments(segments);
        let result = chamfer(&card.as_mesh(), &options.with_verify(Verify::Full)).unwrap();
        assert_sound("card", &card.as_mesh(), &result);
        let chamfered = result.totals.chamfered;
        assert!(chamfered > 0 && chamfered.is_multiple_of(2), "each fold on both its sides");
        let others = chamfered + result.totals.skipped[Reason::ZeroThickness];
        assert_eq!(others, result.totals.hard_edges);
        let mut vertices = result.mesh.indices[card.indices.len()..].to_vec();
        vertices.sort_unstable();
        vertices.dedup();
        let place = |vertex: &u32| result.mesh.positions[*vertex as usize].map(f32::to_bits);
        let mut places: Vec<[u32; 3]> = vertices.iter().map(place).collect();
        places.sort_unstable();
        assert!(places.chunk_by(|a, b| a == b).all(|same| same.len() > 1), "front and back");
    }
}

/// A box that is there twice stands over the edge of an open one. Only one of its copies could follow
/// the top of the open box there, so both stay closed, and the edge says why it stays. The second
/// doubled box is chamfered whole.
#[test]
fn copies_of_a_box_are_not_torn_by_what_touches_one_of_them() {
    let doubled = |low: [f64; 3], high: [f64; 3]| Block::new(low, high).with(Skin::Copied);
    let above = doubled([0.0, 3.0, 0.0], [3.0, 4.0, 3.0]);
    let open = Block { without: 0b01, ..Block::new([3.0, 2.0, 0.0], [4.0, 3.0, 3.0]) };
    let apart = doubled([1.0, 0.0, 0.0], [2.0, 1.0, 1.0]);
    for is_merged in [false, true] {
        let mesh = assembly(&[above, open, apart], DMat3::IDENTITY, is_merged);
        let result = chamfered("boxes", &mesh, 0.04);
        assert_eq!(result.totals.skipped[Reason::Contact], 2, "both copies of one edge");
    }
}

/// Between the rows of a rounded chamfer, too, no more sides meet than there were skins: one that is
/// there twice has four on each edge, and one triangle more is found.
#[test]
fn one_more_triangle_between_rows_is_found() {
    for skin in [Skin::Once, Skin::Copied] {
        let mesh = assembly(&[Block::new([0.0; 3], [1.0; 3]).with(skin)], DMat3::IDENTITY, false);
        let options = Options::default().with_width(Width::Units(0.02)).with_segments(3);
        let mut result = chamfer(&mesh.as_mesh(), &options).unwrap();
        assert_sound("box", &mesh.as_mesh(), &result);
        let triangles = result.mesh.indices.as_chunks::<3>().0;
        let mut sides = triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
        let is_new = |vertex: u32| vertex as usize >= mesh.positions.len();
        let [a, b] = sides.find(|side| side.iter().all(|&vertex| is_new(vertex))).unwrap();
        result.mesh.indices.extend([a, b, 0]);
        result.mesh.submesh_index_counts[0] += 3;
        result.triangle_sources.extend(result.triangle_sources.last().copied());
        let edge = Element::Edge(a.min(b), a.max(b));
        for found in [
            check(&mesh.as_mesh(), &result, Verify::Fast),
            compare(&mesh.as_mesh(), &result.mesh.as_mesh(), Verify::Fast),
        ] {
            let crowded = found.breaches.iter().find(|breach| breach.rule == Rule::NonManifold);
            assert!(crowded.unwrap().first.contains(&edge), "{skin:?}: {found}");
        }
    }
}

/// Three boxes touch at a corner, and their chamfers, each of the full width, touch along an edge
/// there: one by the floor of a box over an open wall, one by the corner of the third. Each has
/// vertices of its own on it, and is as closed as before.
#[test]
fn chamfers_may_touch_along_an_edge() {
    let open = Block { without: 0b1000, ..Block::new([2.0, 2.0, 1.0], [4.0, 3.0, 3.0]) };
    let behind = Block::new([1.0, 0.0, 3.0], [4.0, 3.0, 4.0]);
    let above = Block::new([2.0, 3.0, 3.0], [4.0, 4.0, 4.0]);
    let mesh = assembly(&[behind, open, above], DMat3::IDENTITY, false);
    let result = chamfered("boxes", &mesh, 0.04);
    assert_eq!(result.totals.chamfered, result.totals.hard_edges);
}

/// An open wall stands on an edge of a box that is there twice. What is left over there is known once
/// the other edges have told which faces are of one copy.
#[test]
fn a_wall_on_a_doubled_box_tears_none_of_its_copies() {
    let wall = Block { without: 0b100, ..Block::new([1.0, 3.0, 3.0], [2.0, 4.0, 4.0]) };
    let below = Block::new([1.0, 1.0, 2.0], [2.0, 3.0, 3.0]).with(Skin::Copied);
    let beside = Block::new([0.0, 0.0, 2.0], [1.0, 3.0, 3.0]).with(Skin::Copied);
    let apart = Block::new([3.0, 0.0, 0.0], [4.0, 1.0, 1.0]).with(Skin::Copied);
    let blocks = [wall, Block { without: 0b10, ..beside }, below, apart];
    chamfered("boxes", &assembly(&blocks, DMat3::IDENTITY, false), 0.04);
}

/// An open box and a closed one continue each other, both there twice and with vertices in common:
/// each chamfer is of the box whose sides it lies beside. A third box stands apart.
#[test]
fn chamfers_of_copies_that_continue_each_other_are_told_apart() {
    let open = Block { without: 0b1_0000, ..Block::new([2.0, 1.0, 3.0], [3.0, 3.0, 4.0]) };
    let closed = Block::new([2.0, 1.0, 1.0], [3.0, 3.0, 3.0]);
    let turn = DMat3::from_axis_angle(DVec3::new(0.6, 0.0, 0.8), 1.5722056);
    let [open, closed] = [open, closed].map(|block| block.with(Skin::Copied));
    let apart = Block::new([0.0, 2.0, 0.0], [1.0, 3.0, 1.0]);
    let mesh = assembly(&[open, apart, closed], turn, true);
    chamfered("boxes", &mesh, 0.04);
}
