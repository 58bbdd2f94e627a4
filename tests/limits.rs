//! Width is lost only where there is no room, and dirt in one place harms no other.

use chamfer::check::assert_sound;
use chamfer::{
    Chamfered, EdgeVerdict, MeshBuffers, Options, Outcome, Reason, Width, chamfer, shapes,
};

const UP: [f32; 3] = [0.0, 1.0, 0.0];

fn chamfered(name: &str, mesh: &MeshBuffers, width: f32) -> Chamfered {
    asked(name, mesh, &Options::default().with_width(Width::Units(width)))
}

/// Each end with all that it has room for itself.
fn uneven(name: &str, mesh: &MeshBuffers, width: f32) -> Chamfered {
    asked(name, mesh, &Options::default().with_width(Width::Units(width)).with_evenness(0.0))
}

fn asked(name: &str, mesh: &MeshBuffers, options: &Options) -> Chamfered {
    let result = chamfer(&mesh.as_mesh(), options).unwrap();
    assert_sound(name, &mesh.as_mesh(), &result);
    result
}

/// A mesh of positions, normals and triangles without any other stream.
fn plain(positions: Vec<[f32; 3]>, normals: Vec<[f32; 3]>, indices: Vec<u32>) -> MeshBuffers {
    let submesh_index_counts = vec![indices.len() as u32];
    MeshBuffers { positions, normals, indices, submesh_index_counts, ..MeshBuffers::default() }
}

/// A cube, moved, beside something else; neither has more than positions and normals.
fn beside_cube(other: MeshBuffers, size: f32, offset: f32) -> MeshBuffers {
    let cube = shapes::plain_cube(size);
    let first = other.positions.len() as u32;
    let moved = cube.positions.iter().map(|&[x, y, z]| [x + offset, y, z]);
    plain(
        other.positions.iter().copied().chain(moved).collect(),
        other.normals.iter().chain(&cube.normals).copied().collect(),
        other
            .indices
            .iter()
            .copied()
            .chain(cube.indices.iter().map(|index| index + first))
            .collect(),
    )
}

/// The verdicts of edges of which both ends satisfy a condition.
fn edges_where<'a>(
    mesh: &'a MeshBuffers,
    result: &'a Chamfered,
    condition: impl Fn([f32; 3]) -> bool + 'a,
) -> impl Iterator<Item = &'a EdgeVerdict> {
    result.verdicts.iter().filter(move |verdict| {
        verdict.vertices.iter().all(|&vertex| condition(mesh.positions[vertex as usize]))
    })
}

#[test]
fn a_tiny_cube_far_away_narrows_nothing_but_itself() {
    let mesh = beside_cube(shapes::plain_cube(0.02), 1.0, 10.0);
    let result = chamfered("a 2 cm cube 10 m away", &mesh, 0.1);
    let large: Vec<_> = edges_where(&mesh, &result, |point| point[0] > 5.0).collect();
    assert_eq!(large.len(), 12);
    assert!(large.iter().all(|verdict| verdict.outcome == Outcome::Full));
    let tiny: Vec<_> = edges_where(&mesh, &result, |point| point[0] < 5.0).collect();
    assert!(tiny.iter().all(|verdict| verdict.outcome == Outcome::Narrowed));
    // Half the cube would be all of it; its faces keep a fifth of their breadth.
    assert!(tiny.iter().all(|verdict| (0.0078..0.008).contains(&verdict.widths[0])));
}

/// Two slopes that meet in a ridge along x, cut into unit pieces; one slope has a vertex close to
/// the ridge, in the middle of the third piece.
///
/// ```text
/// *---*---*---*---*---*   far side
/// |   |   | / | \ |   |
/// *---*---*--.--*-*---*   the ridge, and the vertex just above it
/// ```
fn ridge_with_close_vertex(distance: f32) -> MeshBuffers {
    let (mut positions, mut normals, mut indices) = (Vec::new(), Vec::new(), Vec::new());
    let slope = 0.5_f32.sqrt();
    for side in [1.0_f32, -1.0] {
        let first = positions.len() as u32;
        for x in 0..6 {
            positions.extend([[x as f32, 0.0, 0.0], [x as f32, -slope, side * slope]]);
        }
        for piece in (0..5).map(|piece| first + 2 * piece) {
            let (near, far) = ([piece, piece + 2], [piece + 1, piece + 3]);
            if side > 0.0 && piece == 4 {
                let close = first + 12;
                for [a, b] in
                    [[near[0], far[0]], [far[0], far[1]], [far[1], near[1]], [near[1], near[0]]]
                {
                    indices.extend([a, b, close]);
                }
            } else if side > 0.0 {
                indices.extend([near[0], far[0], far[1], near[0], far[1], near[1]]);
            } else {
                indices.extend([near[0], far[1], far[0], near[0], near[1], far[1]]);
            }
        }
        if side > 0.0 {
            positions.push([2.5, -slope * distance, slope * distance]);
        }
        normals.resize(positions.len(), [0.0, slope, side * slope]);
    }
    plain(positions, normals, indices)
}

#[test]
fn a_vertex_close_to_an_edge_narrows_that_edge_alone() {
    let mesh = ridge_with_close_vertex(0.001);
    let result = uneven("a vertex 1 mm from an edge", &mesh, 0.1);
    assert_eq!(result.totals.hard_edges, 5);
    let full_ends = result.verdicts.iter().flat_map(|verdict| {
        let positions = verdict.vertices.map(|vertex| mesh.positions[vertex as usize][0]);
        positions.into_iter().zip(verdict.widths)
    });
    for (x, width) in full_ends {
        let is_tight = (2.0..=3.0).contains(&x);
        assert_eq!(width > 0.0999, !is_tight, "{width} at x = {x}");
        assert!(width >= 0.049, "the other slope keeps its width at x = {x}");
    }
}

#[test]
fn a_thin_plate_is_narrow_only_on_its_rim() {
    let plate = shapes::plate();
    let thickness = {
        let heights = || plate.positions.iter().map(|point| point[1]);
        heights().fold(f32::MIN, f32::max) - heights().fold(f32::MAX, f32::min)
    };
    let width = thickness * 2.0;
    let result = uneven("a plate thinner than its chamfers", &plate, width);
    for verdict in &result.verdicts {
        let [a, b] = verdict.vertices.map(|vertex| plate.positions[vertex as usize]);
        let mean = (verdict.widths[0] + verdict.widths[1]) / 2.0;
        if a[1] == b[1] {
            // Full on the large face; of the rim, a fifth of the thickness stays between two.
            assert!(mean > (width + 0.39 * thickness) / 2.0, "{mean} of {width}");
        } else {
            assert_eq!(verdict.outcome, Outcome::Full, "it has room, whatever is beside it");
        }
    }
}

/// Chamfers some dirt beside a cube: the cube's twelve edges have to come out whole.
fn harms_no_cube(name: &str, dirt: MeshBuffers) {
    let mesh = beside_cube(dirt, 1.0, 10.0);
    let result = chamfered(name, &mesh, 0.05);
    let cube: Vec<_> = edges_where(&mesh, &result, |point| point[0] > 5.0).collect();
    assert_eq!(cube.len(), 12, "{name}");
    assert!(cube.iter().all(|verdict| verdict.outcome == Outcome::Full), "{name}");
}

const SQUARE: [[f32; 3]; 4] = [[0.0, 0.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [1.0, 0.0, 0.0]];

#[test]
fn dirt_harms_nothing_else() {
    let square = SQUARE.to_vec();
    let flat = |indices: &[u32]| plain(square.clone(), vec![UP; 4], indices.to_vec());
    harms_no_cube("duplicate triangles", flat(&[0, 1, 2, 0, 1, 2, 0, 2, 3]));
    harms_no_cube("a winding flip", flat(&[0, 1, 2, 0, 3, 2]));
    harms_no_cube("isolated vertices", flat(&[]));
    harms_no_cube("a collapsed triangle", flat(&[0, 1, 2, 0, 2, 2, 0, 2, 3]));
    harms_no_cube("a point for a triangle", flat(&[1, 1, 1]));
}

#[test]
fn a_sheet_of_two_sides_has_no_width() {
    let positions = [SQUARE, SQUARE].concat();
    let normals = [[UP; 4], [[0.0, -1.0, 0.0]; 4]].concat();
    let sheet = plain(positions, normals, vec![0, 1, 2, 0, 2, 3, 4, 6, 5, 4, 7, 6]);
    let result = chamfered("a sheet of two sides", &sheet, 0.05);
    assert_eq!(result.totals.skipped[Reason::ZeroThickness], 4);
    harms_no_cube("a sheet of two sides, with a cube", sheet);
}

/// A box whose front top edge ends a face above and two faces below: a T-junction at `2`, closed
/// by a triangle without area or left open.
///
/// ```text
///   0-----------1     top, from 0 to 1 without a stop
///   0-----2-----1     front, in two halves
///   |     |     |
///   3-----4-----5
/// ```
fn t_junction(is_closed: bool) -> MeshBuffers {
    let (a, b, m) = ([0.0, 1.0, 1.0], [2.0, 1.0, 1.0], [1.0, 1.0, 1.0]);
    let front = [0.0, 0.0, 1.0];
    let positions = vec![
        a,
        b,
        [2.0, 1.0, 0.0],
        [0.0, 1.0, 0.0],
        a,
        b,
        m,
        [0.0, 0.0, 1.0],
        [1.0, 0.0, 1.0],
        [2.0, 0.0, 1.0],
        m,
    ];
    let mut normals = vec![UP; 4];
    normals.extend([front; 6]);
    normals.push(UP);
    let mut indices = vec![0, 1, 2, 0, 2, 3, 4, 7, 8, 4, 8, 6, 6, 8, 9, 6, 9, 5];
    if is_closed {
        indices.extend([0, 10, 1]);
    }
    plain(positions, normals, indices)
}

#[test]
fn a_t_junction_closed_by_a_line_is_chamfered_through() {
    let result = chamfered("a closed T-junction", &t_junction(true), 0.1);
    assert_eq!((result.totals.hard_edges, result.totals.chamfered), (2, 2));
}

#[test]
fn an_open_t_junction_is_chamfered_through() {
    let result = chamfered("an open T-junction", &t_junction(false), 0.1);
    assert_eq!((result.totals.hard_edges, result.totals.chamfered), (1, 1));
    harms_no_cube("an open T-junction, with a cube", t_junction(false));
}

/// A box under a lid of finer pieces: they share the four corners, and no edge.
///
/// ```text
/// *-----*-----*     the lid from above; each of its sides has a vertex
/// | \   |   / |     in the middle, which those of the box do not have:
/// *-----*-----*     it stands so far from the center
/// | /   |   \ |
/// *-----*-----*
/// ```
fn box_under_finer_lid(far: f32) -> MeshBuffers {
    let open = shapes::open_box();
    let (mut positions, mut normals) = (open.positions, open.normals);
    let center = positions.len() as u32;
    positions.push([0.0, 1.0, 0.0]);
    for [x, z] in [[1, 1], [1, 0], [1, -1], [0, -1], [-1, -1], [-1, 0], [-1, 1], [0, 1]] {
        let far = if x * z == 0 { far } else { 1.0 };
        positions.push([x as f32 * far, 1.0, z as f32 * far]);
    }
    normals.resize(positions.len(), UP);
    let rim = |k: u32| center + 1 + k % 8;
    let lid = (0..8).flat_map(|k| [center, rim(k), rim(k + 1)]);
    let indices = open.indices.iter().copied().chain(lid).collect();
    plain(positions, normals, indices)
}

#[test]
fn a_lid_of_finer_pieces_closes_its_box() {
    let result = chamfered("a box under a finer lid", &box_under_finer_lid(1.0), 0.1);
    assert_eq!((result.totals.hard_edges, result.totals.chamfered), (12, 12));
}

/// There is a gap along each side, which the box's corners alone do not have.
#[test]
fn where_borders_of_two_parts_meet_nothing_gapes() {
    let mesh = box_under_finer_lid(0.9);
    let result = chamfered("a box under a lid that is too small", &mesh, 0.1);
    let upright: Vec<_> = result
        .verdicts
        .iter()
        .filter(|v| v.vertices.map(|v| mesh.positions[v as usize][1]) != [0.0; 2])
        .collect();
    assert_eq!(upright.len(), 4);
    for verdict in upright {
        let heights = verdict.vertices.map(|vertex| mesh.positions[vertex as usize][1]);
        for (height, width) in heights.into_iter().zip(verdict.widths) {
            assert_eq!(width > 0.0999, height == 0.0, "{width} at {height}");
            assert!(height == 0.0 || width == 0.0, "the chamfer ends at the lid");
        }
    }
}

/// What becomes of a mesh that stands so many times its extent from the origin.
fn far_out(name: &str, mesh: &MeshBuffers, extents: f32) -> Chamfered {
    let (mut far, extent) = (mesh.clone(), mesh.as_mesh().extent());
    far.positions.iter_mut().for_each(|at| at[0] += extents * extent);
    asked(name, &far, &Options::default().with_width(Width::PercentOfExtent(0.5)))
}

#[test]
fn far_from_the_origin_nothing_is_lost_that_can_be_told() {
    for (name, mesh) in [("table", shapes::table()), ("bolt", shapes::bolt())] {
        for extents in [8.0, 64.0, 512.0, 4096.0] {
            let totals = far_out(name, &mesh, extents).totals;
            assert_eq!(totals.chamfered, totals.hard_edges, "{name}, {extents} extents out");
        }
    }
}

// So far out a step of the coordinates is a thousandth of the extent to a 256th: first the thin faces
// cannot be told from lines, then the width cannot be told from nothing.
#[test]
fn what_is_lost_far_from_the_origin_is_too_fine() {
    let models = [("bolt", shapes::bolt()), ("cylinder", shapes::cylinder(48))];
    for (name, mesh) in models.into_iter().chain([("cube", shapes::plain_cube(1.0))]) {
        for extents in [8192.0, 16384.0, 32768.0] {
            let result = far_out(name, &mesh, extents);
            let lost = result.verdicts.iter().filter(|verdict| verdict.outcome != Outcome::Full);
            let reasons: Vec<Reason> = lost.map(|verdict| verdict.reason).collect();
            assert!(reasons.iter().all(|&reason| reason == Reason::TooFine), "{name}: {reasons:?}");
            assert!(extents < 32768.0 || !reasons.is_empty(), "{name}");
        }
    }
}
