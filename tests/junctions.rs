//! T-junctions: boxes whose faces are cut into cells that do not match those of the faces beside, some
//! faces missing, some there twice, some off by a few units in the last place.
//!
//! The same cases on every run. For more: `PROPTEST_CASES=2000 cargo test --release --test
//! junctions`.

#[path = "support/grids.rs"]
mod grids;
#[path = "support/seeded.rs"]
mod seeded;

use std::ops::RangeInclusive;

use chamfer::check::{Rule, assert_sound, check};
use chamfer::{
    Convexity, EdgeFactor, EdgeVerdict, Factors, Held, Mesh, MeshBuffers, Options, Reason, Verify,
    Width, chamfer,
};
use glam::{DMat3, DVec3};
use proptest::collection::vec;
use proptest::prelude::*;

use grids::{Cells, Grid, Layout, grids};
use seeded::seeded;

/// As many as are checked in two seconds.
const CASES: u32 = 60;

/// Segments, and how much is verified.
const WAYS: [(u32, Verify); 4] =
    [(1, Verify::Fast), (1, Verify::Full), (2, Verify::Fast), (2, Verify::Full)];

/// Mostly few cuts, sometimes all.
fn bits() -> impl Strategy<Value = u8> {
    let one = || (1..8u32).prop_map(|step| 1u8 << step);
    let two = (one(), one()).prop_map(|(one, other)| one | other);
    prop_oneof![3 => Just(0u8), 3 => one(), 3 => two, 1 => Just(0b0001_0100u8), 1 => any::<u8>()]
}

fn cells(copies: RangeInclusive<u8>) -> impl Strategy<Value = Cells> {
    let copies = prop_oneof![12 => Just(1u8), 2 => copies];
    (bits(), vec(bits(), 1..3), any::<u16>(), copies)
        .prop_map(|(across, along, diagonals, copies)| Cells { across, along, diagonals, copies })
}

/// Boxes and plates, whose faces are there so often.
fn grid(copies: RangeInclusive<u8>) -> impl Strategy<Value = Grid> {
    let size = || prop_oneof![3 => (1..4i32).prop_map(f64::from), 1 => Just(0.1)];
    let place = ([0..3i32, 0..3i32, 0..3i32], [size(), size(), size()]);
    (place, vec(cells(copies), 6)).prop_map(|((low, size), faces)| {
        let low = low.map(f64::from);
        Grid { low, high: [0, 1, 2].map(|k| low[k] + size[k]), faces }
    })
}

/// Side by side with room between them.
fn apart(mut boxes: Vec<Grid>) -> Vec<Grid> {
    for (number, grid) in (0u8..).zip(&mut boxes) {
        let by = 8.0 * f64::from(number);
        (grid.low[0], grid.high[0]) = (grid.low[0] + by, grid.high[0] + by);
    }
    boxes
}

fn layout() -> impl Strategy<Value = Layout> {
    let angle = prop_oneof![2 => Just(0.0), 1 => 0.0..3.0f64];
    let lean = prop_oneof![3 => Just(0.0), 1 => -1.0..1.0f64];
    let scale =
        prop_oneof![2 => Just(1.0), 1 => (-6.0..6.0f64).prop_map(|power| 10f64.powf(power))];
    let off = prop_oneof![3 => Just(0.0), 1 => -20.0..20.0f64];
    let steps = prop_oneof![2 => Just(0u8), 3 => 1..4u8];
    let is_overlaid = prop_oneof![2 => Just(false), 1 => Just(true)];
    (angle, lean, scale, off, steps, any::<u32>(), any::<bool>(), is_overlaid).prop_map(
        |(angle, lean, scale, off, most_steps, seed, is_merged, is_overlaid)| {
            let turn = DMat3::from_axis_angle(DVec3::new(0.6, 0.0, 0.8), angle);
            let lean = DMat3::from_cols(DVec3::X, DVec3::new(lean, 1.0, 0.0), DVec3::Z);
            let offset = DVec3::new(off, -off / 3.0, 0.0) * scale;
            Layout { turn: turn * lean * scale, offset, most_steps, seed, is_merged, is_overlaid }
        },
    )
}

/// What else is asked.
#[derive(Clone, Debug)]
enum Asked {
    All,
    /// Edges of faces that meet at these angles.
    Angles(f32, f32),
    Convexity(Convexity),
    Submeshes(Vec<f32>),
    /// A mask of the vertices, that many times over.
    Mask(Vec<f32>),
    /// The sides of every so many triangles.
    Edges(usize, f32),
    /// From one vertex to another, and a radius in terms of the extent.
    Held(usize, usize, f32),
    /// In a space with other units along each axis.
    Scale([f32; 3]),
}

fn asked() -> impl Strategy<Value = Asked> {
    let factor = || prop_oneof![Just(0.0f32), Just(1.0), 0.0..3.0f32];
    let radius = prop_oneof![Just(0.0f32), 0.0..0.2f32];
    prop_oneof![
        4 => Just(Asked::All),
        1 => (0.0..100.0f32, 0.0..80.0f32).prop_map(|(low, more)| Asked::Angles(low, low + more)),
        1 => Just(Asked::Convexity(Convexity::Convex)),
        1 => Just(Asked::Convexity(Convexity::Concave)),
        1 => vec(factor(), 1..4).prop_map(Asked::Submeshes),
        1 => vec(factor(), 1..9).prop_map(Asked::Mask),
        1 => (1..5usize, factor()).prop_map(|(every, factor)| Asked::Edges(every, factor)),
        2 => (any::<usize>(), any::<usize>(), radius).prop_map(|(a, b, r)| Asked::Held(a, b, r)),
        // Where rounding moves nothing, and where it does.
        1 => [-3..4i32, -3..4, -3..4].prop_map(|to| Asked::Scale(to.map(|k| 2f32.powi(k)))),
        1 => [-3.0..3.0f32, -3.0..3.0f32, -3.0..3.0f32].prop_map(|to| Asked::Scale(to.map(f32::exp2))),
    ]
}

/// What the mesh is chamfered with, as long as a mesh borrows it.
#[derive(Default)]
struct Extras {
    held: Vec<Held>,
    submeshes: Vec<f32>,
    vertices: Vec<f32>,
    edges: Vec<EdgeFactor>,
}

impl Extras {
    fn new(mesh: &MeshBuffers, asked: &Asked) -> Extras {
        let mut extras = Extras::default();
        match asked {
            Asked::Submeshes(all) => {
                let count = mesh.submesh_index_counts.len();
                extras.submeshes = all.iter().copied().cycle().take(count).collect();
            }
            Asked::Mask(all) => {
                extras.vertices = all.iter().copied().cycle().take(mesh.positions.len()).collect();
            }
            Asked::Edges(every, factor) => {
                let sides = mesh.indices.chunks_exact(3).step_by(*every);
                let sides = sides.flat_map(|t| [[t[0], t[1]], [t[1], t[2]], [t[2], t[0]]]);
                extras.edges =
                    sides.map(|vertices| EdgeFactor { vertices, factor: *factor }).collect();
            }
            &Asked::Held(from, to, radius) if !mesh.positions.is_empty() => {
                let at = |vertex: usize| mesh.positions[vertex % mesh.positions.len()];
                let [from, to] = [from, to].map(at);
                let largest = [from, to].as_flattened().iter().fold(0.0f32, |a, b| a.max(b.abs()));
                extras.held.push(Held { from, to, radius: radius * largest });
            }
            _ => {}
        }
        extras
    }

    fn on<'a>(&'a self, mesh: &'a MeshBuffers) -> Mesh<'a> {
        let Extras { submeshes, vertices, edges, held } = self;
        Mesh { factors: Factors { submeshes, vertices, edges }, held, ..mesh.as_mesh() }
    }
}

fn options(asked: &Asked, percent: f32) -> Options {
    let options = Options::default().with_width(Width::PercentOfExtent(percent));
    match *asked {
        Asked::Angles(low, high) => options.with_angles(low, high),
        Asked::Convexity(convexity) => options.with_convexity(convexity),
        Asked::Scale([x, y, z]) => {
            options.with_scale([[x, 0.0, 0.0], [0.0, y, 0.0], [0.0, 0.0, z]])
        }
        _ => options,
    }
}

fn percent() -> impl Strategy<Value = f32> {
    prop_oneof![Just(1.0f32), 0.1..4.0f32, 4.0..20.0f32]
}

proptest! {
    #![proptest_config(seeded(CASES))]

    #[test]
    fn boxes_of_cells_that_do_not_match_are_sound(
        boxes in vec(grid(0..=2), 1..4),
        touch in any::<bool>(),
        layout in layout(),
        asked in asked(),
        percent in percent(),
    ) {
        let boxes = if touch { boxes } else { apart(boxes) };
        let mesh = grids(&boxes, &layout);
        let extras = Extras::new(&mesh, &asked);
        let mesh = extras.on(&mesh);
        for (segments, verify) in WAYS {
            let options = options(&asked, percent).with_segments(segments).with_verify(verify);
            let result = chamfer(&mesh, &options).unwrap();
            let findings = check(&mesh, &result, verify);
            prop_assert!(findings.is_sound(), "{segments} segments, {verify:?}: {findings}");
        }
    }

    /// All that stands on a side of a closed box does so once: nothing keeps it from being brought
    /// together. Only where rounding has moved what stands there off the plane of a turned box, its pieces
    /// may cut a face beside, and one edge is left.
    #[test]
    fn of_one_box_no_junction_is_left(
        grid in grid(1..=1),
        layout in layout(),
        percent in 0.1..1.0f32,
    ) {
        let mesh = grids(&[grid], &Layout { most_steps: 0, ..layout });
        let options = Options::default().with_width(Width::PercentOfExtent(percent));
        let result = chamfer(&mesh.as_mesh(), &options).unwrap();
        assert_sound("box", &mesh.as_mesh(), &result);
        let is_left = |verdict: &&EdgeVerdict| verdict.reason == Reason::TJunction;
        let left: Vec<_> = result.verdicts.iter().filter(is_left).collect();
        let is_upright = layout.turn.to_cols_array().iter().filter(|&&along| along != 0.0).count() == 3;
        prop_assert!(left.len() <= usize::from(!is_upright), "{left:?}");
        for verdict in left {
            prop_assert!(is_met_off_plane(&mesh, verdict.vertices), "{verdict:?}");
        }
    }
}

/// Whether a vertex stands on a side of a triangle, but for rounding, and not in its plane.
fn is_met_off_plane(mesh: &MeshBuffers, [from, to]: [u32; 2]) -> bool {
    let at = |vertex: u32| DVec3::from(mesh.positions[vertex as usize].map(f64::from));
    let side = at(to) - at(from);
    let stands_on = |way: DVec3| {
        let share = way.dot(side) / side.length_squared();
        (way - side * share).length() < NEARLY * side.length()
            && (NEARLY..1.0 - NEARLY).contains(&share)
    };
    let has = |t: &[u32], vertex: u32| t.contains(&vertex);
    let mut own = mesh.indices.chunks_exact(3).filter(|t| has(t, from) && has(t, to));
    let Some(apex) = own.next().and_then(|t| t.iter().find(|&&v| v != from && v != to)) else {
        return false;
    };
    let normal = side.cross(at(*apex) - at(from));
    let mut ways = (0..mesh.positions.len() as u32).map(|vertex| at(vertex) - at(from));
    ways.any(|way| stands_on(way) && normal.dot(way) != 0.0)
}

/// What is off by less than this share of a side stands on it.
const NEARLY: f64 = 1e-5;

fn face(across: u8, along: &[u8]) -> Cells {
    Cells { across, along: along.to_vec(), diagonals: 0, copies: 1 }
}

fn whole() -> Cells {
    face(0, &[0])
}

/// Sound where heights are so many times as large; that many hard edges, and so many of them chamfered.
fn assert_chamfered(
    boxes: &[Grid],
    height: f32,
    (percent, segments): (f32, u32),
    expected: [u32; 2],
) {
    let layout = Layout::exact(DMat3::IDENTITY, DVec3::ZERO);
    let mesh = grids(boxes, &layout);
    let width = Width::PercentOfExtent(percent);
    let scale = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, height]];
    let options = Options::default().with_width(width).with_segments(segments).with_scale(scale);
    let result = chamfer(&mesh.as_mesh(), &options).unwrap();
    assert_sound("boxes that touch", &mesh.as_mesh(), &result);
    let totals = result.totals;
    assert_eq!([totals.hard_edges, totals.chamfered + totals.narrowed], expected);
}

//   .-------.
//   |       |          the lower one is as deep, and what is between them is in cells: at `o` the
//   |       |.----.    chamfers of both boxes end on one short edge, as do those of the cells there
//   '-------o'----'
#[test]
fn chamfers_of_cells_of_two_boxes_meet_at_a_corner() {
    let wall = face(0b1_0100, &[0b1000_0000]);
    let high = vec![whole(), wall, whole(), whole(), whole(), whole()];
    let floor = face(0b1_0100, &[0, 0b10]);
    let low = vec![face(0, &[0b1000]), whole(), whole(), whole(), floor, face(0b10, &[0b10])];
    let boxes = [
        Grid { low: [1.0, 1.0, 0.0], high: [2.0, 2.0, 1.0], faces: high },
        Grid { low: [2.0, 1.0, 0.0], high: [3.0, 2.0, 0.1], faces: low },
    ];
    for segments in [1, 2, 5] {
        assert_chamfered(&boxes, 0.5, (0.1, segments), [26, 22]);
    }
}

//       .-------.
//       |       |      plates, one on the other: along the ground between them the edges of one lie on
//   .---o-------o      those of the other, and chamfers of both end on one short edge at each `o`
//   |           |
//   '-----------'
#[test]
fn chamfers_of_a_plate_on_a_plate_meet_at_its_corners() {
    let ground = face(0b10, &[0b100, 0]);
    let high = vec![whole(), whole(), whole(), whole(), ground, whole()];
    let roof = face(0b1_0000, &[0b1000, 0]);
    let low = vec![whole(), whole(), whole(), face(0b10, &[0]), whole(), roof];
    let boxes = [
        Grid { low: [1.0, 2.0, 2.0], high: [1.1, 3.0, 3.0], faces: high },
        Grid { low: [1.0, 1.0, 1.0], high: [1.1, 3.0, 2.0], faces: low },
    ];
    assert_chamfered(&boxes, 1.0, (0.3, 1), [27, 22]);
}

/// Far from the origin for its size: a vertex that stands on a side is off its plane by more than flat
/// faces may be.
#[test]
fn what_stands_on_a_side_may_be_off_its_plane_by_rounding() {
    let cut = face(0, &[0b1000_0000]);
    let faces = vec![cut, whole(), whole(), whole(), whole(), whole()];
    let grid = Grid { low: [0.0, 2.0, 2.0], high: [0.1, 2.1, 2.1], faces };
    let turn = DMat3::from_diagonal(DVec3::splat(35_266.472_636_604_07));
    let exact = Layout::exact(turn, DVec3::ZERO);
    let layout = Layout { most_steps: 3, seed: 3_153_447_839, ..exact };
    let mesh = grids(&[grid], &layout);
    let options = Options::default().with_width(Width::PercentOfExtent(1.0));
    let mut result = chamfer(&mesh.as_mesh(), &options).unwrap();
    assert_sound("box", &mesh.as_mesh(), &result);
    // A place that only pieces have, and to which none of their triangles reached.
    let is_own = |weights: [f32; 3]| weights.contains(&1.0);
    let corners = result.pieces.iter().flat_map(|piece| {
        (0..3).filter(|&k| !is_own(piece.corners[k])).map(|k| 3 * piece.triangle as usize + k)
    });
    let added: Vec<u32> = corners.map(|corner| result.mesh.indices[corner]).collect();
    let uses = |v: u32| result.mesh.indices.iter().filter(|&&used| used == v).count();
    let only = added.iter().find(|&&v| uses(v) == added.iter().filter(|&&a| a == v).count());
    let moved = &mut result.mesh.positions[*only.unwrap() as usize];
    *moved = moved.map(|along| along + 1.0);
    let findings = check(&mesh.as_mesh(), &result, Verify::Fast);
    assert!(findings.count(Rule::FlatFace) > 0);
}

//   .---------------.     a thin bar seen from above: its end is in three rows, so the long side there
//   |              .o     gets their vertices `o`, a step of single precision too low; the pieces would
//   |           .-' o     cut the front below, which the whole triangle does not
//   '---------------'
#[test]
fn a_piece_cuts_no_face_beside() {
    let turned = |cells: Cells, diagonals| Cells { diagonals, ..cells };
    let end = turned(face(0b1000_0010, &[0]), 0b1_1001_0011_0111);
    let top = turned(face(0b1_0100, &[0]), 0b1010_0110_0100_0100);
    let none = Cells { copies: 0, ..whole() };
    let faces = vec![whole(), end, none, top, whole(), whole()];
    let grid = Grid { low: [2.0, 0.0, 0.0], high: [4.0, 0.1, 0.1], faces };
    let turn = DMat3::from_diagonal(DVec3::splat(0.002_373_857_498_374_955_5));
    let exact = Layout::exact(turn, DVec3::ZERO);
    let layout = Layout { most_steps: 2, seed: 2_697_759_575, ..exact };
    let cube = vec![whole(); 6];
    let cube = Grid { low: [2.0; 3], high: [3.0; 3], faces: cube };
    let mesh = grids(&[grid, cube], &layout);
    let (from, to) =
        ([0.004_747_715, -3e-45, 0.0], [0.007_121_572_3, 0.000_237_385_76, 0.000_237_385_79]);
    let held = [Held { from, to, radius: 0.001_203_038_7 }];
    let mesh = Mesh { held: &held, ..mesh.as_mesh() };
    let options = Options::default().with_width(Width::PercentOfExtent(1.0));
    let result = chamfer(&mesh, &options.with_verify(Verify::Full)).unwrap();
    assert_sound("bar", &mesh, &result);
    assert_eq!(result.totals.narrowed, 2);
}

//      .------------.
//    .'|          .'|    the middle of the lower edge stands a little above the side of the roof there:
//   +--'---------.. |    small pieces of the roof lean by so much that what is pulled over them would go
//   |            |M .    much farther off
//   '------------'
#[test]
fn pieces_keep_to_the_plane_of_their_triangle() {
    let mut faces = vec![whole(); 6];
    faces[3] = Cells { diagonals: 0b100, ..face(0b10, &[0b10]) };
    faces[4] = face(0, &[0b1000_0000]);
    let grid = Grid { low: [0.0; 3], high: [1.0; 3], faces };
    for (out, above) in [(0.0, 6e-6), (32.0, 6e-5)] {
        let layout = Layout::exact(DMat3::IDENTITY, DVec3::new(out, 0.0, 0.0));
        let mut mesh = grids(std::slice::from_ref(&grid), &layout);
        let place = [0.875 + out as f32, 1.0, 0.0];
        let standing = mesh.positions.iter_mut().filter(|at| **at == place);
        standing.for_each(|at| at[1] += above);
        let options = Options::default().with_width(Width::Units(0.05));
        let mut result = chamfer(&mesh.as_mesh(), &options).unwrap();
        assert_sound("box", &mesh.as_mesh(), &result);
        assert_eq!(result.totals.skipped[Reason::TJunction], 0, "{out}");
        // As far off as it would be over a small piece.
        let pulled = result.pieces.iter().flat_map(|piece| {
            let own = 3 * piece.triangle as usize;
            (0..3).filter(|&k| !piece.corners[k].contains(&1.0)).map(move |k| own + k)
        });
        let pulled: Vec<u32> = pulled.map(|corner| result.mesh.indices[corner]).collect();
        for vertex in pulled {
            result.mesh.positions[vertex as usize][1] -= 5.0 * above;
        }
        let findings = check(&mesh.as_mesh(), &result, Verify::Fast);
        assert!(findings.count(Rule::Place) > 0, "{out}: {findings}");
    }
}

//    .-----------.     a thin box that is open on its right, of whose front the lowest cells are so small
//   /           /|     that larger ones tell where the lower edge's chamfer ends: beside the opening, too
//  +-+---------+-+
//  +-+---------+-/
//  '-'---------'-'
#[test]
fn a_chamfer_that_farther_cells_tell_may_end_at_an_opening() {
    let open = Cells { copies: 0, ..whole() };
    let front = face(134, &[0, 58]);
    let faces = vec![whole(), open, whole(), front, whole(), whole()];
    let thin = Grid { low: [0.0; 3], high: [1.0, 1.0, 0.1], faces };
    let mesh = grids(&[thin], &Layout::exact(DMat3::IDENTITY, DVec3::ZERO));
    let options = Options::default().with_width(Width::Units(0.36));
    assert_sound("a thin box", &mesh.as_mesh(), &chamfer(&mesh.as_mesh(), &options).unwrap());
}
