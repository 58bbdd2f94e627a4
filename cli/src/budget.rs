//! Budget: as many segments as a number of triangles allows.

use anyhow::Result;
use chamfer::{Chamfered, ChamferedScene, Verify};
use chamfer_formats::Document;

use crate::chamfering::chamfer_document;
use crate::fit::Wish;

/// Chamfers the meshes of a file with the most segments, up to those wished for, that keep its
/// triangles within a number, and with one at least; tells what came of it.
///
/// # Errors
/// Whatever is wrong with a mesh or the options.
pub fn within(
    document: &dyn Document,
    wish: &Wish,
    most: u64,
    progress: &dyn Fn(f32),
) -> Result<(ChamferedScene, String)> {
    let with = |segments: u32, verify: Verify| Wish {
        core: wish.core.with_segments(segments).with_verify(verify),
        ..wish.clone()
    };
    let mut segments = most_that(wish.core.segments, |segments| {
        let quick = chamfer_document(document, &with(segments, Verify::Fast), &|_| {})?;
        Ok(count(document, &quick.meshes).triangles <= most)
    })?;
    loop {
        let scene = chamfer_document(document, &with(segments, wish.core.verify), progress)?;
        let Count { triangles, .. } = count(document, &scene.meshes);
        if triangles <= most {
            let noun = if segments == 1 { "segment" } else { "segments" };
            let told = format!("{segments} {noun}, {triangles} triangles: within {most}");
            return Ok((scene, told));
        }
        if segments == 1 {
            let told =
                format!("with one segment there are {triangles} triangles, more than {most}");
            return Ok((scene, told));
        }
        // What a thorough look leaves hard can have more triangles than what a quick one has.
        segments -= 1;
    }
}

/// The largest number from 1 to some most for which something holds, if it holds for all below; 1
/// where it holds for none.
fn most_that(most: u32, mut holds: impl FnMut(u32) -> Result<bool>) -> Result<u32> {
    let (mut least, mut most) = (1, most);
    while least < most {
        let middle = (least + most).div_ceil(2);
        if holds(middle)? {
            least = middle;
        } else {
            most = middle - 1;
        }
    }
    Ok(least)
}

/// What a file holds.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Count {
    /// Of all meshes that are written.
    pub triangles: u64,
    /// The same.
    pub vertices: u64,
}

/// How much would be written.
pub fn count(document: &dyn Document, chamfered: &[Chamfered]) -> Count {
    let written = chamfered.iter().zip(document.are_written(chamfered)).filter(|(_, is)| *is);
    written.fold(Count::default(), |sum, (result, _)| Count {
        triangles: sum.triangles + result.mesh.indices.len() as u64 / 3,
        vertices: sum.vertices + result.mesh.positions.len() as u64,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_most_that_fits_is_found_and_one_at_least() {
        for most in 1..=32 {
            for limit in 0..=33 {
                let found = most_that(most, |segments| Ok(segments <= limit)).unwrap();
                assert_eq!(found, most.min(limit).max(1));
            }
        }
    }
}
