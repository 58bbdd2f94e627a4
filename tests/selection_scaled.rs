//! What is measured where a scale leads: what is hard, what is held, and the widest chamfer.

#[path = "support/grids.rs"]
mod grids;
#[allow(dead_code)] // Other tests use more of it.
#[path = "support/shaded.rs"]
mod shaded;

use chamfer::check::{Rule, assert_sound, check};
use chamfer::{Held, Mesh, Options, Reason, Verify, Width, chamfer, shapes};
use glam::{DMat3, DVec3};

use grids::{Cells, Grid, Layout, grids};

/// A stretch along the three axes.
fn along_axes([x, y, z]: [f32; 3]) -> [[f32; 3]; 3] {
    [[x, 0.0, 0.0], [0.0, y, 0.0], [0.0, 0.0, z]]
}

//      _ _.--.._ _        a roof of half a degree, and as it stands twenty times as high
#[test]
fn an_edge_is_hard_where_it_turns_enough_as_it_is_measured() {
    let height = 0.25_f32.to_radians().tan();
    let points = [-1.0, 1.0].map(|z| [[-1.0, 0.0, z], [0.0, height, z], [1.0, 0.0, z]]).concat();
    let faces = [0, 3, 4, 0, 4, 1, 1, 4, 5, 1, 5, 2];
    let roof = shaded::shaded(&points, &faces, 0.1);
    for (height, expected) in [(1.0, 0), (20.0, 1)] {
        let options = Options::default().with_scale(along_axes([1.0, height, 1.0]));
        let result = chamfer(&roof.as_mesh(), &options).unwrap();
        assert_sound("a roof", &roof.as_mesh(), &result);
        assert_eq!(result.totals.hard_edges, expected, "{height}");
    }
    // A result without a verdict is not one of the roof as it stands there.
    let mut untold = chamfer(&roof.as_mesh(), &Options::default()).unwrap();
    untold.scale = Some(along_axes([1.0, 20.0, 1.0]));
    let findings = check(&roof.as_mesh(), &untold, Verify::Fast);
    assert_eq!(findings.count(Rule::Verdicts), 1, "{findings}");
}

//       .--------.
//     .'       .'      it leans by half a right angle, and where it is measured so much more that its
//   .'       .'        ends nearly continue its floor and its roof: they are one face there
//  '--------'
#[test]
fn an_edge_is_soft_where_it_hardly_turns_as_it_is_measured() {
    let whole = Cells { across: 0, along: vec![0], diagonals: 0, copies: 1 };
    let grid = Grid { low: [0.0; 3], high: [1.0; 3], faces: vec![whole; 6] };
    let layout = Layout::exact(
        DMat3::from_cols(DVec3::X, DVec3::new(0.978_277_138_646_977_6, 1.0, 0.0), DVec3::Z),
        DVec3::ZERO,
    );
    let leaning = grids(&[grid], &layout);
    for (scale, expected) in [([1.0; 3], 12), ([8.0, 0.125, 1.0], 10)] {
        let options = Options::default()
            .with_width(Width::PercentOfExtent(1.0))
            .with_scale(along_axes(scale));
        let result = chamfer(&leaning.as_mesh(), &options).unwrap();
        assert_sound("a box", &leaning.as_mesh(), &result);
        assert_eq!(result.totals.hard_edges, expected, "{scale:?}");
    }
    // So they are where rounding has set their vertices apart from those of the floor.
    let faces = vec![Cells { across: 0, along: vec![0], diagonals: 0, copies: 1 }; 6];
    let [one, other] = [0.0, 8.0].map(|x| Grid {
        low: [x, 0.0, 0.0],
        high: [x + 1.0, 1.0, 1.0],
        faces: faces.clone(),
    });
    let leaning = grids(&[one, other], &Layout { most_steps: 1, ..layout });
    let scale = along_axes([8.0, 0.125, 1.0]);
    let options = Options::default().with_width(Width::PercentOfExtent(1.0)).with_scale(scale);
    let result = chamfer(&leaning.as_mesh(), &options).unwrap();
    assert_sound("boxes", &leaning.as_mesh(), &result);
}

//    .-----------.
//   /      o    /|     a ball behind the middle of an edge: it holds that where it reaches it
//  +-----------+ |
#[test]
fn what_a_ball_holds_grows_with_the_longest_axis() {
    let cube = shapes::plain_cube(1.0);
    let at = [0.0, 0.5, 0.3];
    for (longest, expected) in [(1.0, 0), (1.5, 0), (2.5, 1)] {
        let held = [Held { from: at, to: at, radius: 0.1 }];
        let mesh = Mesh { held: &held, ..cube.as_mesh() };
        let options = Options::default()
            .with_width(Width::Units(0.01))
            .with_scale(along_axes([longest, 1.0, 1.0]));
        let result = chamfer(&mesh, &options).unwrap();
        assert_eq!(result.totals.skipped[Reason::Contact], expected, "{longest}");
    }
}

// Along the axis that gets longest, as the scene is four times as large as the mesh there.
#[test]
fn the_largest_width_is_told_in_units_of_the_mesh() {
    let cube = shapes::plain_cube(1.0);
    let options =
        Options::default().with_width(Width::Units(0.1)).with_scale(along_axes([4.0, 2.0, 1.0]));
    let result = chamfer(&cube.as_mesh(), &options).unwrap();
    assert!((result.largest_width - 0.025).abs() < 1e-7, "{}", result.largest_width);
}

/// A face whose rows begin there; the cells of the first row, and of the others.
fn face(across: u8, along: [u8; 2]) -> Cells {
    Cells { across, along: along.to_vec(), diagonals: 0, copies: 1 }
}

//   z
//   +-----------------+
//   |                 |       one face of a box. No half of a z is exact as it is measured, so a
//   +-----------------+       corner that is pulled along the middle line could come out past it,
//   |                 |       and so in two cells
//   +--+--------------+
//   |  |              |
//   +--+--------------+ y
#[test]
fn cells_of_one_face_still_end_on_one_line() {
    let faces =
        [face(0, [0; 2]), face(0b0100_0100, [0b10, 0]), face(0, [0; 2]), face(0, [0b100; 2])];
    let faces = faces.into_iter().chain([face(0, [0; 2]), face(0, [0; 2])]).collect();
    let layout = Layout::exact(DMat3::IDENTITY, DVec3::ZERO);
    let mesh = grids(&[Grid { low: [0.0; 3], high: [1.0, 1.0, 3.0], faces }], &layout);
    let options = Options::default()
        .with_width(Width::PercentOfExtent(1.0))
        .with_scale(along_axes([1.0, 1.0, 1.567_422_6]))
        .with_verify(Verify::Full);
    let result = chamfer(&mesh.as_mesh(), &options).unwrap();
    assert_sound("a box of cells", &mesh.as_mesh(), &result);

    assert_eq!((result.totals.hard_edges, result.totals.chamfered), (13, 13));
}
