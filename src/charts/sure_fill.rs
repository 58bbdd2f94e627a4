//! Fills of three points that lie well on the texture by the first way, of meshes with a single UV
//! channel, as [`super::sure_strip`] tells of strips.

use super::feet::feet_of_wings;
use super::fill_map::{allowed_seams, first_owner, has_more_seams};
use super::ground::Ground;
use super::owners::Owners;
use super::sure_strip::wide_uv;
use super::{Given, TakenAt, Wings};
use crate::attributes::Taken;
use crate::ids::{Ring, Triangle};

/// Lays a fill of three points by the first way for the first owner in rank, if its own vertices are
/// in several charts and it surely fits there; gives the owner's face, and the joint whose vertex is
/// made first.
#[inline(always)]
pub fn lay_sure_fill(
    given: &Given,
    owners: &Owners,
    ring: Ring,
    taken: &mut Vec<TakenAt>,
) -> Option<(Triangle, usize)> {
    let one = given.one_channel.as_ref()?;
    let &[a, b, c] = given.chamfers.sectors.ring(ring) else { return None };
    let sectors = &[a, b, c];
    let allowed = allowed_seams(given, sectors, 0);
    if !has_more_seams(given, sectors, (one.channel, allowed)) {
        return None;
    }
    let (owner, spokes) = first_owner(given, owners, sectors);
    let feet = feet_of_wings(given, (sectors[owner], Wings::Far), owners.feet_below(&spokes));
    let places = [(owner + 1) % 3, (owner + 2) % 3];
    let at = spokes[0].half_edge;
    let mut uvs = [wide_uv(one.output[given.attributes.vertex_at[at] as usize]); 3];
    [uvs[places[0]], uvs[places[1]]] = [one.place_of(&feet[0]), one.place_of(&feet[1])];
    let point = &given.placement.point;
    let points = [point[a], point[b], point[c]];
    let (face, measure) = one.face(at.triangle());
    let is_covered = || {
        face.holds(uvs[0]) && face.holds(uvs[1]) && face.holds(uvs[2])
            || Ground::new(given.surface, one.channel, &[at]).covers_past(
                face,
                (&[[0, 1, 2]], &uvs),
                &uvs,
            )
    };
    if !measure.is_surely_alike(points, uvs) || !is_covered() {
        return None;
    }
    let in_turn = if places[0] < places[1] { [0, 1] } else { [1, 0] };
    for k in in_turn {
        let (point, place) = (places[k] as u32, feet[k]);
        taken.push((point, Taken { channels: 1 << one.channel, place }));
    }
    Some((at.triangle(), owner))
}

#[cfg(test)]
mod tests {
    use super::super::channels_of;
    use super::super::fill_map::lay_fill;
    use super::super::owners::owners;
    use super::super::strip_map::StripMap;
    use super::super::sure_strip::{OneChannel, sure_band};
    use super::*;
    use crate::ids::{Few, Patch};
    use crate::patches::Patches;
    use crate::shapes;
    use crate::stages::stages_of;
    use crate::watch::{Unwatched, Watch};

    /// What is told of each model's patches here.
    fn of_models(mut told: impl FnMut(&Given, &Owners, &Patches)) {
        let cube = ("cube", shapes::cube(1.0));
        for (_, mesh) in shapes::demo_models().into_iter().chain([cube]) {
            let stages = stages_of(&mesh, 0.01);
            let placement = stages.placement();
            let (patches, attributes) = (stages.patches(&placement), stages.attributes(&placement));
            let channels: Few<usize> = channels_of(&stages.view).collect();
            let given = Given {
                surface: stages.surface(),
                chamfers: stages.chamfers(),
                placement: &placement,
                attributes: &attributes,
                channels: &channels,
                one_channel: OneChannel::new(&stages.view, &attributes, &channels),
            };
            let work = (&stages.threads, &Unwatched as &dyn Watch);
            let owners = owners(&given, &patches, work).unwrap();
            told(&given, &owners, &patches);
        }
    }

    #[test]
    fn a_fill_that_surely_fits_is_laid_as_any_other() {
        let mut laid = 0;
        of_models(|given, owners, patches| {
            for ring in given.chamfers.sectors.rings.ids() {
                let fill = patches.fill(ring);
                let (mut quickly, mut taken) = (Vec::new(), Vec::new());
                let is_open = !fill.triangles.is_empty();
                let sure =
                    if is_open { lay_sure_fill(given, owners, ring, &mut quickly) } else { None };
                if let Some(place) = sure {
                    assert_eq!(place, lay_fill(given, owners, (ring, fill), &mut taken));
                    assert_eq!(quickly, taken);
                    laid += 1;
                }
            }
        });
        assert!(laid > 8, "those of the cube and more, but {laid}");
    }

    #[test]
    fn a_strip_that_surely_fits_has_the_band_that_it_has_anyway() {
        let mut found = 0;
        of_models(|given, _, patches| {
            for (edge, hard) in
                given.chamfers.edges.hard.ids().zip(given.chamfers.edges.hard.iter())
            {
                let triangles = patches.triangles(Patch(edge.0));
                for owner in (0..2).filter(|_| hard.seams != 0) {
                    let Some(sure) = sure_band(given, (hard, triangles), owner) else { continue };
                    let band = StripMap::new(given, hard, triangles).band(owner).unwrap();
                    assert!(sure.spread == band.spread && sure.far == band.far);
                    found += 1;
                }
            }
        });
        assert!(found > 24, "those of the cube on either side and more, but {found}");
    }
}
