//! A caller is told again and again that a long call goes on, and ends it whenever it likes.

use std::ops::ControlFlow;

use chamfer::{Chamfered, Error, Options, Verify, chamfer_with_progress, shapes};

/// All sides in one part, and so within one long stage of `full`.
const SIDES: u32 = 4_000;

/// What is told of a pyramid of many sides, if the caller breaks when it is told so often.
fn told(verify: Verify, threads: u32, last: usize) -> (Result<Chamfered, Error>, Vec<f32>) {
    let (mesh, mut shares) = (shapes::pyramid(SIDES), Vec::new());
    let options = Options::default().with_verify(verify).with_threads(threads);
    let result = chamfer_with_progress(&mesh.as_mesh(), &options, &mut |share| {
        shares.push(share);
        if shares.len() < last { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    });
    (result, shares)
}

#[test]
fn within_the_search_for_cuts_the_share_is_told_again_and_again() {
    let (_, stages) = told(Verify::Fast, 1, usize::MAX);
    let (result, shares) = told(Verify::Full, 1, usize::MAX);
    assert!(result.is_ok() && shares.is_sorted() && shares.last() == Some(&1.0), "{shares:?}");
    assert!(stages.is_sorted_by(|one, other| one < other), "each stage once: {stages:?}");
    let again = shares.windows(2).filter(|pair| pair[0] == pair[1]).count();
    assert_eq!(shares.len() - again, stages.len());
    assert!(again > 20, "{again}");
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
