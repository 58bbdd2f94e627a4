//! Charts: where each patch lies on the texture (thesis 6.4).
//!
//! Where a UV channel differs across a hard edge, the chamfer belongs to one side's chart, its
//! owner. The owner's chart has a free band between the pulled edge and the old one, and the
//! strip is mapped onto exactly that: its far side lands on the old edge. The owner also gives the
//! strip its submesh.
//!
//! Ways: how a patch can be laid on the texture of a face beside it, its owner.
//!
//! Strips and fills try those of their lists in turn, and take the first that fits, or else the one
//! that fits best. Of 65,000 chamfers of real models, 97 in 100 lie as they are or take the first.
//! Each of the others is the only one for some; a way that is not for ten of them is not worth its
//! lines.

mod feet;
mod fill_map;
mod fit;
mod ground;
mod owners;
mod strip_map;
mod sure_fill;
mod sure_strip;

use glam::DVec2;

use crate::attributes::{Attributes, Taken};
use crate::chamfers::Chamfers;
use crate::error::Error;
use crate::ids::{Corner, Few, Id, Patch, Triangle};
use crate::mesh::UV_CHANNELS;
use crate::patches::Patches;
use crate::placement::Placement;
use crate::report::Blend;
use crate::surface::Surface;
use crate::threads::Threads;
use crate::view::View;
use crate::watch::Watch;

use fill_map::lay_fill;
use ground::uv_point;
use owners::owners;
use strip_map::lay_strip;
use sure_fill::lay_sure_fill;
use sure_strip::OneChannel;

/// The charts that all patches lie in.
#[derive(Default)]
pub struct Charts {
    /// `#patches`: none of those without triangles is ever asked for.
    laid: Vec<Laid>,
    /// Patch by patch.
    taken: Vec<TakenAt>,
}

/// What a point of a patch takes from another chart than its own, and the point's place in the
/// joints, or past them in the middles.
pub type TakenAt = (u32, Taken);

struct Laid {
    face: Triangle,
    begin: u32,
    /// Where its points end.
    end: u32,
}

/// The chart of one patch.
#[derive(Clone, Copy)]
pub struct Chart<'a> {
    /// The face that the patch continues, and whose submesh it joins.
    pub face: Triangle,
    /// The joint whose vertex is made first: the others follow in turn.
    pub begin: usize,
    /// In the order of the points.
    taken: &'a [TakenAt],
}

impl Chart<'_> {
    /// What a point takes from another chart.
    pub fn taken_at(&self, point: usize) -> Option<&Taken> {
        self.taken.iter().find(|(at, _)| *at as usize == point).map(|(_, taken)| taken)
    }

    /// What points take from another chart, in turn: from the one that begins on, and then up to it.
    pub fn in_turn(&self) -> [&[TakenAt]; 2] {
        let first = self.taken.iter().position(|(at, _)| *at as usize >= self.begin);
        let (before, after) = self.taken.split_at(first.unwrap_or(self.taken.len()));
        [after, before]
    }
}

/// Lays each patch into the chart of its owner, where its own is another, or folds or ends under
/// the chamfer.
///
/// # Errors
/// [`Error::Cancelled`] where the watch stops it.
pub fn charts(
    surface: Surface,
    chamfers: Chamfers,
    placement: &Placement,
    patches: &Patches,
    attributes: &Attributes,
    (threads, watch): (&Threads, &dyn Watch),
) -> Result<Charts, Error> {
    let channels: Few<usize> = channels_of(surface.view).collect();
    let one_channel = OneChannel::new(surface.view, attributes, &channels);
    let given =
        Given { surface, chamfers, placement, attributes, channels: &channels, one_channel };
    let owners = owners(&given, patches, (threads, watch))?;
    let lay = |patch: Patch, charts: &mut Charts| {
        let triangles = patches.triangles(patch);
        let (mut face, mut begin) = (Triangle::NONE, 0);
        if !triangles.is_empty() {
            (face, begin) = match patches.edge_or_ring(patch) {
                Ok(edge) => {
                    let owner = (owners.of(edge), owners.band[edge].as_ref());
                    (lay_strip(&given, (edge, triangles), owner, &mut charts.taken), 0)
                }
                Err(ring) => {
                    let taken = &mut charts.taken;
                    lay_sure_fill(&given, &owners, ring, taken).unwrap_or_else(|| {
                        lay_fill(&given, &owners, (ring, patches.parts(patch)), taken)
                    })
                }
            };
        }
        charts.laid.push(Laid { face, begin: begin as u32, end: charts.taken.len() as u32 });
    };
    let seamed = chamfers.edges.hard.iter().filter(|edge| edge.seams != 0).count();
    let mut charts = Charts {
        laid: Vec::with_capacity(patches.len()),
        // At a seam both far vertices of a strip, and of fills about as many.
        taken: Vec::with_capacity(4 * seamed),
    };
    threads.gather((patches.len(), watch), &mut charts, lay, Charts::append)?;
    Ok(charts)
}

/// What patches are laid by: the arguments of [`charts`], for the files of this stage alone.
struct Given<'a> {
    surface: Surface<'a>,
    chamfers: Chamfers<'a>,
    placement: &'a Placement<'a>,
    attributes: &'a Attributes,
    /// The UV channels that the mesh has.
    channels: &'a [usize],
    /// Where it has but one.
    one_channel: Option<OneChannel<'a>>,
}

impl Given<'_> {
    /// Where the output vertex of a corner lies on the texture.
    fn own_uv(&self, corner: Corner, channel: usize) -> DVec2 {
        self.attributes.streams.uv(self.attributes.vertex_at[corner], channel)
    }
}

impl Charts {
    pub fn of(&self, patch: Patch) -> Chart<'_> {
        let place = patch.index();
        let start = place.checked_sub(1).map_or(0, |before| self.laid[before].end);
        let Laid { face, begin, end } = self.laid[place];
        let taken = &self.taken[start as usize..end as usize];
        Chart { face, begin: begin as usize, taken }
    }

    fn append(&mut self, others: &mut Charts) {
        let start = self.taken.len() as u32;
        let laid = others.laid.drain(..);
        self.laid.extend(laid.map(|laid| Laid { end: start + laid.end, ..laid }));
        self.taken.append(&mut others.taken);
    }
}

/// The UV channels that a mesh has.
fn channels_of(view: &View) -> impl Iterator<Item = usize> + use<> {
    let present = view.mesh.uvs.map(|uv| uv.components > 0);
    (0..UV_CHANNELS).filter(move |&channel| present[channel])
}

/// Where a blend lies in a UV channel.
fn place_of(view: &View, channel: usize, blend: &Blend) -> DVec2 {
    let uv = &view.mesh.uvs[channel];
    let terms = blend.vertices.iter().zip(blend.weights);
    terms.map(|(&vertex, weight)| uv_point(uv, vertex) * f64::from(weight)).sum()
}

/// A way to lay a patch onto its owner.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Way {
    /// On the band that a pulled edge has left free: the far side lands on the old edge.
    Band(Spread),
    /// Along the old edge, within the owner's triangle, as deep as the strip is wide.
    Inside,
    /// The same, past that triangle where it is too small.
    Abreast,
    /// Between the pulled corner and the old one.
    Kite(Wings),
    /// Flat, within the owner's triangle.
    Flat,
    /// Flat, within the triangle of the owner's chart that has the most room near by.
    Roomiest,
}

/// Where along the old edge the far corners of a strip land.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Spread {
    /// Below themselves, so that the texture is not sheared.
    Far,
    /// Below the pulled corners of the owner's side.
    Near,
    /// At its very ends.
    Whole,
    /// Below themselves, and only as deep as the strip is wide: between faces that meet like a knife
    /// the band is wider.
    Narrow,
}

/// Where the feet of a fill stand on its owner's two edges.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Wings {
    /// Below the pulled vertices beyond the edges, as those of the strips there.
    Far,
    /// So many times as far from the corner as below the owner's own pulled vertex.
    Near(f64),
}

/// The bands of a strip's one side, best first; then those of the other.
pub const BANDS: [Spread; 4] = [Spread::Far, Spread::Near, Spread::Whole, Spread::Narrow];

/// What is left for a strip where no band fits: each on one side, and then on the other.
pub const BESIDE_BANDS: [Way; 4] = [Way::Inside, Way::Abreast, Way::Flat, Way::Roomiest];

/// The ways of a fill: each for every sector that could own it.
pub const FILL_WAYS: [Way; 4] =
    [Way::Kite(Wings::Far), Way::Kite(Wings::Near(1.0)), Way::Kite(Wings::Near(2.0)), Way::Flat];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes;
    use crate::stages::stages_of;

    #[test]
    fn a_chain_of_edges_between_two_regions_has_one_owner() {
        let cylinder = shapes::cylinder(12);
        let stages = stages_of(&cylinder, 0.05);
        let placement = stages.placement();
        let charts = stages.charts(&placement);
        for strip in stages.edges.hard.ids().map(|edge| Patch(edge.0)) {
            assert!(charts.of(strip).face < Triangle(24), "the side of the cylinder comes first");
        }
    }

    // On a seam the two far corners of a strip come from its owner's chart, and no others.
    #[test]
    fn a_strip_on_a_seam_takes_two_places_from_its_owner() {
        let cube = shapes::cube(1.0);
        let stages = stages_of(&cube, 0.1);
        let placement = stages.placement();
        let charts = stages.charts(&placement);
        for strip in stages.edges.hard.ids().map(|edge| Patch(edge.0)) {
            let taken: Vec<usize> =
                (0..4).filter(|&point| charts.of(strip).taken_at(point).is_some()).collect();
            assert!(taken == [0, 1] || taken == [2, 3], "{taken:?}");
        }
    }
}
