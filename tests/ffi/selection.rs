//! Which edges are chamfered, how wide, and in which space: options and factors.

use std::mem::{self, offset_of};

use crate::calls::{array_of, mesh_of, run, slice_or_empty};
use crate::cube::{Cube, options};
use crate::library::LIBRARY;
use crate::misuse::{Told, fail_run};
use crate::types::*;

/// A fifth of a unit, where the cube's side is 2.
fn fifth() -> chamfer_options {
    chamfer_options { width: 0.2, width_unit: CHAMFER_WIDTH_MESH_UNITS, ..options() }
}

fn verdicts(mesh: &chamfer_mesh, options: &chamfer_options) -> Vec<chamfer_edge_verdict> {
    array_of(&run(mesh, options), LIBRARY.chamfer_result_verdicts)
}

/// The width of those at full width; the others are not selected.
fn widths(mesh: &chamfer_mesh, options: &chamfer_options) -> Vec<f32> {
    let is_full = |verdict: &chamfer_edge_verdict| verdict.outcome == CHAMFER_OUTCOME_FULL;
    let (full, rest): (Vec<_>, Vec<_>) = verdicts(mesh, options).into_iter().partition(is_full);
    assert_eq!(full.len() + rest.len(), 12);
    assert!(rest.iter().all(|verdict| verdict.reason == CHAMFER_REASON_NOT_SELECTED));
    full.iter().map(|verdict| verdict.widths[0]).collect()
}

fn assert_widths(found: &[f32], count: usize, width: f32) {
    assert_eq!(found.len(), count);
    assert!(found.iter().all(|found| (found - width).abs() < 1e-5), "{found:?} for {width}");
}

/// At a right angle, the offset is the chord by the root of two, the depth times it, and the radius.
#[test]
fn the_width_measures_what_is_asked_for() {
    let root = 2_f32.sqrt();
    let modes = [
        (CHAMFER_WIDTH_OFFSET, 1.0),
        (CHAMFER_WIDTH_CHORD, 1.0 / root),
        (CHAMFER_WIDTH_DEPTH, root),
        (CHAMFER_WIDTH_RADIUS, 1.0),
    ];
    for (width_mode, times) in modes {
        let found = widths(&Cube::new().view(), &chamfer_options { width_mode, ..fifth() });
        assert_widths(&found, 12, 0.2 * times);
    }
}

#[test]
fn edges_are_selected_by_angle_and_convexity() {
    let count = |options: &chamfer_options| widths(&Cube::new().view(), options).len();
    assert_eq!(count(&chamfer_options { min_angle: 89.0, max_angle: 91.0, ..options() }), 12);
    assert_eq!(count(&chamfer_options { min_angle: 91.0, ..options() }), 0);
    assert_eq!(count(&chamfer_options { max_angle: 89.0, ..options() }), 0);
    assert_eq!(count(&chamfer_options { convexity: CHAMFER_CONVEXITY_CONVEX, ..options() }), 12);
    assert_eq!(count(&chamfer_options { convexity: CHAMFER_CONVEXITY_CONCAVE, ..options() }), 0);
}

/// Normals that lean so far to the corner that those of two faces differ by 30 degrees.
#[test]
fn normals_are_one_below_the_hard_angle() {
    let mut cube = Cube::new();
    for (normal, at) in cube.normals.chunks_mut(3).zip(cube.positions.chunks(3)) {
        let leant = [0, 1, 2].map(|axis| normal[axis] + 2.0 * at[axis] / 3_f32.sqrt());
        let length = leant.iter().map(|value| value * value).sum::<f32>().sqrt();
        normal.copy_from_slice(&leant.map(|value| value / length));
    }
    let count =
        |hard_angle| verdicts(&cube.view(), &chamfer_options { hard_angle, ..options() }).len();
    assert_eq!([0.0, 1.0, 25.0, 35.0].map(count), [12, 12, 12, 0]);
}

/// Twice as long in the scene along x, where the width is half as much of the mesh.
#[test]
fn the_width_is_that_of_the_scaled_mesh() {
    let scale = [2.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];
    let result = run(&Cube::new().view(), &chamfer_options { scale, ..fifth() });
    let mesh = mesh_of(&result);
    // SAFETY: the mesh has that many positions.
    let positions = unsafe { slice_or_empty(mesh.positions, 3 * mesh.vertex_count as usize) };
    for (axis, inner) in [(0, 0.9), (1, 0.8), (2, 0.8)] {
        let places = positions.iter().skip(axis).step_by(3).map(|value| value.abs());
        let pulled: Vec<f32> = places.filter(|place| *place < 0.999).collect();
        assert_eq!(pulled.len(), 16);
        assert!(pulled.iter().all(|place| (place - inner).abs() < 1e-5), "{axis}: {pulled:?}");
    }
}

/// A scale that tells the three axes apart: stretched along where y goes, by a matrix whose other
/// order would shear.
#[test]
fn the_scale_stands_column_by_column() {
    let turned = [0.0, 3.0, 0.0, -1.0, 0.0, 0.0, 0.0, 0.0, 1.0];
    let plain = [3.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];
    let counts = [turned, plain].map(|scale| {
        let result = run(&Cube::new().view(), &chamfer_options { scale, ..fifth() });
        let mesh = mesh_of(&result);
        // SAFETY: the mesh has that many positions.
        let positions = unsafe { slice_or_empty(mesh.positions, 3 * mesh.vertex_count as usize) };
        positions.iter().step_by(3).filter(|x| (x.abs() - 1.0 + 0.2 / 3.0).abs() < 1e-5).count()
    });
    assert_eq!(counts, [16, 16]);
}

/// Positions of a cube one of whose corners leans far inwards, so that its ends have unlike room.
fn leaning(options: &chamfer_options) -> Vec<f32> {
    let mut cube = Cube::new();
    for at in cube.positions.chunks_mut(3).filter(|at| **at == [1.0; 3]) {
        at.fill(0.2);
    }
    let result = run(&cube.view(), options);
    let mesh = mesh_of(&result);
    let count = 3 * mesh.vertex_count as usize;
    // SAFETY: the mesh has that many positions, as long as its result lives.
    unsafe { slice_or_empty(mesh.positions, count) }.to_vec()
}

/// 0 stands for what a caller gets who knows nothing of the field; a tiny share for none.
#[test]
fn evenness_and_profile_do_something() {
    let with = |evenness, profile| {
        leaning(&chamfer_options { evenness, profile, segments: 2, width: 0.8, ..fifth() })
    };
    let usual = with(0.0, 0.0);
    assert_eq!(usual, with(0.5, 0.5));
    let others = [with(1e-9, 0.5), with(1.0, 0.5), with(0.5, 1e-9), with(0.5, 1.0)];
    for (number, one) in others.iter().enumerate() {
        assert_eq!(one.len(), usual.len());
        assert!(*one != usual && !others[..number].contains(one), "{number}");
    }
}

#[test]
fn each_submesh_has_a_factor() {
    let (cube, factors, none) = (Cube::new(), [0.5, 1.0], [0.0; 2]);
    let mesh = chamfer_mesh { submesh_factors: factors.as_ptr(), ..cube.view() };
    // Between the last three faces, which are above, in front and behind, there are two edges.
    let (half, whole): (Vec<f32>, _) =
        widths(&mesh, &fifth()).into_iter().partition(|&width| width < 0.15);
    assert_widths(&half, 10, 0.1);
    assert_widths(&whole, 2, 0.2);
    let mesh = chamfer_mesh { submesh_factors: none.as_ptr(), ..mesh };
    assert_eq!(widths(&mesh, &fifth()).len(), 0);
}

#[test]
fn each_vertex_has_a_factor() {
    let (cube, mut factors) = (Cube::new(), [0.5; 24]);
    let with = |factors: &[f32; 24]| {
        let mesh = chamfer_mesh { vertex_factors: factors.as_ptr(), ..cube.view() };
        widths(&mesh, &fifth())
    };
    assert_widths(&with(&factors), 12, 0.1);
    // The two faces across z: what is left are the edges along it.
    factors[16..].fill(0.0);
    assert_eq!(with(&factors).len(), 12);
    factors.fill(0.0);
    assert_eq!(with(&factors).len(), 0);
}

#[test]
fn only_listed_edges_are_chamfered() {
    let cube = Cube::new();
    // Around one face, in any direction.
    let listed = [[0, 1], [1, 3], [2, 3], [2, 0]]
        .map(|vertices| chamfer_edge_factor { vertices, factor: 2.0 });
    let mesh = chamfer_mesh { edge_factor_count: 4, edge_factors: listed.as_ptr(), ..cube.view() };
    assert_widths(&widths(&mesh, &fifth()), 4, 0.4);
    let result = run(&chamfer_mesh { edge_factor_count: 0, ..mesh }, &fifth());
    assert_eq!(mesh_of(&result).index_count, 3 * 44);
}

/// Results can go in again, and then no factor of their source concerns them.
#[test]
fn results_have_no_factors() {
    let (cube, factors) = (Cube::new(), [0.5, 0.5]);
    let mesh = chamfer_mesh { submesh_factors: factors.as_ptr(), ..cube.view() };
    let result = mesh_of(&run(&mesh, &fifth()));
    assert!(result.submesh_factors.is_null() && result.vertex_factors.is_null());
    assert!(result.edge_factors.is_null() && result.edge_factor_count == 0);
}

/// Zeros, and the structs of a caller of the header before there was a selection.
#[test]
fn nothing_given_is_the_default() {
    let cube = Cube::new();
    let zeros = chamfer_options { max_angle: 0.0, hard_angle: 0.0, scale: [0.0; 9], ..fifth() };
    let older = chamfer_options {
        struct_size: offset_of!(chamfer_options, width_mode) as u32,
        width_mode: CHAMFER_WIDTH_DEPTH,
        convexity: CHAMFER_CONVEXITY_CONCAVE,
        ..fifth()
    };
    let none = [0.0; 2];
    let older_mesh = chamfer_mesh {
        struct_size: offset_of!(chamfer_mesh, submesh_factors) as u32,
        submesh_factors: none.as_ptr(),
        ..cube.view()
    };
    for (mesh, options) in [(cube.view(), zeros), (cube.view(), older), (older_mesh, fifth())] {
        assert_widths(&widths(&mesh, &options), 12, 0.2);
    }
}

/// What a failed call says, with its status and element.
fn told(mesh: &chamfer_mesh, options: &chamfer_options) -> (i32, u32, String) {
    let Told { status, element, message } = fail_run(mesh, options);
    (status, element, message)
}

#[test]
fn wrong_options_are_named_with_their_range() {
    let with = |change: fn(&mut chamfer_options)| {
        let mut options = options();
        change(&mut options);
        let (status, element, message) = told(&Cube::new().view(), &options);
        assert_eq!((status, element), (CHAMFER_STATUS_BAD_OPTION, CHAMFER_NO_ELEMENT));
        message
    };
    let constants = "give one of the constants that chamfer.h lists";
    assert_eq!(with(|o| o.width_mode = 4), format!("options->width_mode is 4: {constants}"));
    assert_eq!(with(|o| o.convexity = 3), format!("options->convexity is 3: {constants}"));
    assert_eq!(with(|o| o.min_angle = -1.0), "min_angle is -1: give degrees from 0 to 180");
    assert_eq!(with(|o| o.max_angle = 181.0), "max_angle is 181: give degrees from 0 to 180");
    assert_eq!(with(|o| o.max_angle = f32::NAN), "max_angle is NaN: give degrees from 0 to 180");
    assert_eq!(with(|o| o.hard_angle = 91.0), "hard_angle is 91: give degrees from 0 to 90");
    let order = "min_angle 60 is larger than max_angle 30: no edge could be chamfered";
    assert_eq!(with(|o| (o.min_angle, o.max_angle) = (60.0, 30.0)), order);
    let flat = "the scale flattens the mesh or is not finite: give a matrix that can be inverted";
    assert_eq!(with(|o| o.scale[4] = 0.0), flat);
    assert_eq!(with(|o| o.scale[4] = f32::INFINITY), flat);
}

#[test]
fn wrong_factors_are_named_with_their_place() {
    let (cube, at_least) = (Cube::new(), "give a finite number of at least 0");
    let (submeshes, mut vertices) = ([1.0, -0.5], [1.0; 24]);
    vertices[17] = f32::NAN;
    let edges = [
        chamfer_edge_factor { vertices: [0, 1], factor: f32::INFINITY },
        chamfer_edge_factor { vertices: [2, 24], factor: 1.0 },
    ];
    let fail = |change: &dyn Fn(&mut chamfer_mesh)| {
        let mut mesh = cube.view();
        change(&mut mesh);
        told(&mesh, &options())
    };
    let bad = |place, text: &str| (CHAMFER_STATUS_BAD_FACTOR, place, format!("{text}: {at_least}"));
    let found = fail(&|mesh| mesh.submesh_factors = submeshes.as_ptr());
    assert_eq!(found, bad(1, "submesh factors: number 1 is -0.5"));
    let found = fail(&|mesh| mesh.vertex_factors = vertices.as_ptr());
    assert_eq!(found, bad(17, "vertex factors: number 17 is NaN"));
    let list = |mesh: &mut chamfer_mesh, edges: &[chamfer_edge_factor]| {
        mesh.edge_factor_count = edges.len() as u32;
        mesh.edge_factors = edges.as_ptr();
    };
    let found = fail(&|mesh| list(mesh, &edges[..1]));
    assert_eq!(found, bad(0, "edge factors: number 0 is inf"));
    let (status, element, message) = fail(&|mesh| list(mesh, &edges[1..]));
    assert_eq!((status, element), (CHAMFER_STATUS_EDGE_RANGE, 0));
    assert_eq!(message, "listed edge 0 is of vertex 24, but the mesh has 24 vertices");
}

/// The totals count what is not selected.
#[test]
fn totals_count_what_is_not_selected() {
    let result = run(&Cube::new().view(), &chamfer_options { min_angle: 91.0, ..options() });
    // SAFETY: zeros are a valid struct, which then states its size.
    let totals = unsafe {
        let mut totals: chamfer_totals = mem::zeroed();
        totals.struct_size = size_of_val(&totals) as u32;
        assert_eq!((LIBRARY.chamfer_result_totals)(result.0, &mut totals), CHAMFER_STATUS_OK);
        totals
    };
    assert_eq!(totals.skipped_by_reason[CHAMFER_REASON_NOT_SELECTED as usize], 12);
}
