//! Sure: chamfers that lie well on the texture by the first way, which is told sooner here.
//!
//! That is nearly all of them: strips that open at both ends and fills of three points, of meshes
//! with a single UV channel. Of others, and where it is not sure, nothing is said.

use glam::DVec2;

use super::feet::{feet_of_wings, on_edge, share_of};
use super::fill_map::{allowed_seams, first_owner, has_more_seams};
use super::fit::Measure;
use super::ground::{Face, Ground};
use super::owners::Owners;
use super::strip_map::{Band, places};
use super::{BANDS, Given, TakenAt, Wings};
use crate::attributes::{Attributes, Taken};
use crate::edges::HardEdge;
use crate::ids::{Corner, Id, Ring, Triangle};
use crate::report::Blend;
use crate::strips;
use crate::view::{View, wide};

/// What is read of a mesh with one UV channel of two components.
pub struct OneChannel<'a> {
    channel: usize,
    /// The vertices of each triangle.
    triangles: &'a [[u32; 3]],
    positions: &'a [[f32; 3]],
    /// Where the vertices of the source lie on the texture.
    source: &'a [[f32; 2]],
    /// Where those of the output do.
    output: &'a [[f32; 2]],
}

impl<'a> OneChannel<'a> {
    pub fn new(view: &View<'a>, attributes: &'a Attributes, channels: &[usize]) -> Option<Self> {
        let &[channel] = channels else { return None };
        let uv = view.mesh.uvs[channel];
        (uv.components == 2).then(|| OneChannel {
            channel,
            triangles: view.mesh.indices.as_chunks().0,
            positions: view.mesh.positions,
            source: uv.values.as_chunks().0,
            output: attributes.streams.vertices.uvs[channel].values.as_chunks().0,
        })
    }

    #[inline(always)]
    fn place_of(&self, blend: &Blend) -> DVec2 {
        let of = |k: usize| {
            wide_uv(self.source[blend.vertices[k] as usize]) * f64::from(blend.weights[k])
        };
        // Most blends lie on an edge.
        let on_edge = of(0) + of(1);
        if blend.weights[2] == 0.0 { on_edge } else { on_edge + of(2) }
    }

    /// How a source triangle lies on the texture, and what others are measured by there.
    #[inline(always)]
    fn face(&self, triangle: Triangle) -> (Face, Measure) {
        let [a, b, c] = self.triangles[triangle.index()];
        let uv = |vertex: u32| wide_uv(self.source[vertex as usize]);
        let face = Face::new([uv(a), uv(b), uv(c)]);
        let point = |vertex: u32| wide(self.positions[vertex as usize]);
        let points = [point(a), point(b), point(c)];
        (face, Measure::new(points, &face))
    }
}

#[inline(always)]
fn wide_uv([u, v]: [f32; 2]) -> DVec2 {
    DVec2::new(f64::from(u), f64::from(v))
}

/// The first of [`BANDS`], of those of a side, if the strip of an edge with a seam surely fits there.
#[inline(always)]
pub fn sure_band(
    given: &Given,
    (edge, triangles): (&HardEdge, &[[u32; 3]]),
    owner: usize,
) -> Option<Band> {
    let halves = triangles.try_into().ok()?;
    match owner {
        0 => given.one_channel.as_ref()?.band::<0>(given, edge, halves),
        _ => given.one_channel.as_ref()?.band::<1>(given, edge, halves),
    }
}

impl OneChannel<'_> {
    /// That of one of the sides, which is known where this is compiled.
    #[inline]
    fn band<const OWNER: usize>(
        &self,
        given: &Given,
        edge: &HardEdge,
        halves: &[[u32; 3]; 2],
    ) -> Option<Band> {
        let (view, half_edge) = (given.surface.view, edge.sides[OWNER]);
        let corners @ [b1, a1, a2, b2] = strips::corners(edge);
        let at = |corner: Corner| given.placement.position_at(corner);
        let points = [at(b1), at(a1), at(a2), at(b2)];
        let ends = [view.position_at(half_edge), view.position_at(half_edge.next())];
        let [[start, over_start], [stop, over_stop]] = places(OWNER);
        let foot = |far: usize| on_edge(view, half_edge, share_of(ends, points[far]));
        let far = [foot(over_start), foot(over_stop)];
        let own = |place: usize| {
            wide_uv(self.output[given.attributes.vertex_at[corners[place]] as usize])
        };
        let near = [own(start), own(stop)];
        let mut uvs = [DVec2::ZERO; 4];
        [uvs[start], uvs[stop]] = near;
        [uvs[over_start], uvs[over_stop]] = [self.place_of(&far[0]), self.place_of(&far[1])];
        let (face, measure) = self.face(half_edge.triangle());
        // Whichever the diagonal: see `strips::Cut`.
        let [k, l] = [halves[0][2] as usize, halves[1][0] as usize];
        let is_alike = measure
            .is_surely_alike([points[0], points[1], points[k]], [uvs[0], uvs[1], uvs[k]])
            && measure.is_surely_alike([points[l], points[2], points[3]], [uvs[l], uvs[2], uvs[3]]);
        // The far corners lie on a side of the owner's triangle.
        let is_covered = || {
            face.holds(near[0]) && face.holds(near[1]) || {
                let ends = [half_edge, half_edge.next()];
                let ground = Ground::new(given.surface, self.channel, &ends);
                ground.covers_past(face, (halves, &uvs), &near)
            }
        };
        (is_alike && is_covered()).then_some(Band { spread: BANDS[0], far: far.map(Some) })
    }
}

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
