//! What chamfering the file anew would give, to compare what came out with.

use anyhow::Result;
use chamfer::{Chamfered, MOST_SEGMENTS, MeshBuffers, Verify};
use chamfer_formats::Document;

use crate::args::CheckArgs;
use crate::chamfering::chamfer_document;
use crate::choices::Choices;
use crate::fit::Wish;

/// `#meshes`: what chamfering the file would give, where the width asked for is known.
pub fn expected(
    before: &dyn Document,
    after: &dyn Document,
    args: &CheckArgs,
    choices: Option<&Choices>,
) -> Result<Vec<Chamfered>> {
    let width = args.width().or(choices.map(Choices::length));
    let Some(width) = width else { return Ok(Vec::new()) };
    let wish = choices.map_or_else(Wish::default, |choices| choices.wish(1));
    let verify = if args.no_see_through { args.verify.into() } else { Verify::Seen };
    let per_mesh = args.per_mesh || wish.per_mesh;
    let wish = Wish { core: wish.core.with_verify(verify), width, per_mesh, ..wish };
    let made = |segments: u32| {
        let wish = Wish { core: wish.core.with_segments(segments), ..wish.clone() };
        Ok(chamfer_document(before, &wish, &|_| ())?.meshes)
    };
    match choices {
        Some(_) => made(wish.core.segments),
        None => nearest(triangles(after.meshes().iter().map(|mesh| &mesh.mesh)), made),
    }
}

/// What comes nearest to so many triangles, of what is made with one segment, with two, and so on: how
/// many there are has a say in where light would show, and so in which edges stay.
fn nearest(wanted: usize, made: impl Fn(u32) -> Result<Vec<Chamfered>>) -> Result<Vec<Chamfered>> {
    let off =
        |meshes: &[Chamfered]| triangles(meshes.iter().map(|result| &result.mesh)).abs_diff(wanted);
    let mut best = made(1)?;
    for segments in 2..=MOST_SEGMENTS {
        if triangles(best.iter().map(|result| &result.mesh)) >= wanted {
            break;
        }
        let next = made(segments)?;
        if off(&next) >= off(&best) {
            break;
        }
        best = next;
    }
    Ok(best)
}

fn triangles<'a>(meshes: impl Iterator<Item = &'a MeshBuffers>) -> usize {
    meshes.map(|mesh| mesh.indices.len() / 3).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use chamfer::{Options, Width, chamfer, shapes};

    fn made(segments: u32) -> Result<Vec<Chamfered>> {
        let options = Options::default().with_width(Width::Units(0.1)).with_segments(segments);
        Ok(vec![chamfer(&shapes::prism(6).as_mesh(), &options)?])
    }

    fn segments(meshes: &[Chamfered]) -> u32 {
        meshes[0].verdicts[0].segments
    }

    #[test]
    fn what_has_as_many_triangles_has_as_many_segments() {
        for wanted in 1..=4 {
            let result = made(wanted).unwrap();
            let count = triangles(result.iter().map(|made| &made.mesh));
            assert_eq!(segments(&result), wanted);
            assert_eq!(segments(&nearest(count, made).unwrap()), wanted);
            assert_eq!(
                segments(&nearest(count + 1, made).unwrap()),
                wanted,
                "a tool has added one"
            );
        }
    }

    #[test]
    fn what_has_no_chamfers_is_taken_to_want_flat_ones() {
        let count = shapes::prism(6).indices.len() / 3;
        assert_eq!(segments(&nearest(count, made).unwrap()), 1);
    }
}
