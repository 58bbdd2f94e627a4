//! A caller is told again and again that a long call goes on, and ends it whenever it likes.

#[allow(dead_code)] // Each test uses some of them.
#[path = "support/shaded.rs"]
mod shaded;
#[allow(dead_code)]
#[path = "support/worst.rs"]
mod worst;

use std::ops::ControlFlow;

use chamfer::{Chamfered, Error, MeshBuffers, Options, Verify, chamfer_with_progress, shapes};

/// All sides in one part, and so within one long stage of `full`.
const SIDES: u32 = 6_000;

/// What is told of a pyramid of many sides, if the caller breaks when it is told so often.
fn told(verify: Verify, threads: u32, last: usize) -> (Result<Chamfered, Error>, Vec<f32>) {
    told_of(&shapes::pyramid(SIDES), verify, threads, last)
}

fn told_of(
    mesh: &MeshBuffers,
    verify: Verify,
    threads: u32,
    last: usize,
) -> (Result<Chamfered, Error>, Vec<f32>) {
    let mut shares = Vec::new();
    let options = Options::default().with_verify(verify).with_threads(threads);
    let result = chamfer_with_progress(&mesh.as_mesh(), &options, &mut |share| {
        shares.push(share);
        if shares.len() < last { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    });
    (result, shares)
}

#[test]
fn within_the_search_for_cuts_the_share_is_told_again_and_again() {
    let (_, mut stages) = told(Verify::Fast, 1, usize::MAX);
    let (result, shares) = told(Verify::Full, 1, usize::MAX);
    assert!(result.is_ok() && shares.is_sorted() && shares.last() == Some(&1.0), "{shares:?}");
    let again = shares.len() - stages.len();
    assert!(again > 20, "{again}");
    let mut each = shares;
    [&mut each, &mut stages].into_iter().for_each(|shares| shares.dedup());
    assert_eq!(each, stages, "each stage is told once, whatever is told within it");
}

/// A cone without floor: its rim is open, and of so many sides every second edge is hard.
const OPEN_SIDES: u32 = 40_000;

#[test]
fn it_is_told_within_each_stage_that_may_take_long() {
    let cone = worst::fan(OPEN_SIDES, true);
    let all = |last| told_of(&cone, Verify::Fast, 1, last);
    let (_, shares) = all(usize::MAX);
    for within in [0.14, 0.15, 0.2, 0.25] {
        // The end of the stage before is told first.
        let first = shares.iter().position(|&share| share == within).unwrap();
        assert_eq!(shares[first + 1], within, "{shares:?}");
        assert!(matches!(all(first + 2).0, Err(Error::Cancelled)));
    }
}

#[test]
fn whoever_breaks_is_told_no_more() {
    let (_, shares) = told(Verify::Full, 1, usize::MAX);
    for last in 1..=shares.len() {
        let (result, told) = told(Verify::Full, 1, last);
        assert!(matches!(result, Err(Error::Cancelled)), "{last}");
        assert_eq!(told, shares[..last]);
    }
}

#[test]
fn with_several_threads_it_ends_too() {
    for last in 1..12 {
        let (result, told) = told(Verify::Full, 2, last);
        assert!(matches!(result, Err(Error::Cancelled)), "{last}");
        assert_eq!(told.len(), last);
    }
}

//  +---+
//  |   |        cubes that touch along an edge: light shows between their chamfers, so all is done again
//  +---+---+
//      |   |
//      +---+
#[test]
fn where_all_is_done_again_what_is_told_does_not_fall() {
    let cube = shapes::plain_cube(2.0);
    let mut both = MeshBuffers::default();
    for [x, y, z] in [[-1.0, 1.0, 0.0], [1.0, -1.0, 1.0]] {
        let first = both.positions.len() as u32;
        both.positions.extend(cube.positions.iter().map(|at| [at[0] + x, at[1] + y, at[2] + z]));
        both.normals.extend(&cube.normals);
        both.indices.extend(cube.indices.iter().map(|index| first + index));
    }
    both.submesh_index_counts = vec![both.indices.len() as u32];
    let (_, full) = told_of(&both, Verify::Full, 1, usize::MAX);
    let (result, shares) = told_of(&both, Verify::Seen, 1, usize::MAX);
    assert!(result.is_ok() && shares.is_sorted(), "{shares:?}");
    // What is held is looked for as well, the second time.
    assert_eq!(shares.len() / full.len(), 2, "once more: {} and {}", full.len(), shares.len());
}
