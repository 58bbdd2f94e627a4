//! Where edges that stay hard part sectors, so that a chamfer that ends among them can be closed.
//!
//! ```text
//!        \   A   |   B   /
//!         k1     e     k2       e is chamfered and ends here, k1 and k2 stay hard. A slides along
//!           \    |    /         k1, and the face C across goes along with it. B slides along k2,
//!             \  |  /           which parts C from B: what opens between them is cut off from C
//!               `v'    C        along the chord, and a flap in C's plane gives the rest back.
//! ```

use super::HardEdge;
use crate::breaks::is_hard;
use crate::faces::Faces;
use crate::ids::{Corner, Edge, IdVec};
use crate::math::{Turn, unit};
use crate::report::Reason;
use crate::tolerance::{CREASE_COSINE, FLAT_COSINE, LEAST_SLIDE_SINE};
use crate::topology::Topology;
use crate::view::View;

/// Normals that lean by less than a degree from those of their triangles shade these as flat.
const FLAT_SHADING: f64 = 0.999_85;

/// One end of an edge that stays hard and parts the sectors on its two sides there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parted {
    /// Its half-edge from that end: the sector that starts there slides along it. Its twin belongs
    /// to the face that is cut.
    pub corner: Corner,
    /// The width of the chamfers beside, in mesh units.
    pub width: f64,
}

/// Around each end of a chamfered edge, from it to the next one: where faces bend at two and more
/// edges between that are not selected, all of these but the first; sorted by corners.
pub fn parted(
    view: &View,
    topology: &Topology,
    faces: &Faces,
    hard: &IdVec<Edge, HardEdge>,
    chamfered_at: &IdVec<Corner, Edge>,
) -> Vec<Parted> {
    let unselected = hard.iter().filter(|edge| edge.skipped == Some(Reason::NotSelected));
    let mut kept: Vec<Corner> = unselected.flat_map(|edge| edge.sides).collect();
    if kept.is_empty() {
        return Vec::new();
    }
    kept.sort_unstable();
    let around = Around { view, topology, faces, kept };
    let mut parted = Vec::new();
    for first in chamfered_at.ids().filter(|&corner| chamfered_at[corner].is_some()) {
        let Some(fan) = around.fan(first, chamfered_at) else { continue };
        let Some(bends) = around.bends(&fan).filter(|bends| bends.len() > 1) else { continue };
        if around.can_part(&fan, &bends) {
            let last = fan[fan.len() - 1].prev();
            let widths = [
                hard[chamfered_at[first]].width_at_start(first),
                hard[chamfered_at[last]].width_at_end(last),
            ];
            let width = (widths[0] + widths[1]) / 2.0;
            parted.extend(bends[1..].iter().map(|&at| Parted { corner: fan[at], width }));
        }
    }
    parted.sort_unstable_by_key(|parted| parted.corner);
    parted
}

struct Around<'a> {
    view: &'a View<'a>,
    topology: &'a Topology,
    faces: &'a Faces,
    /// Both sides of all edges that are not selected, sorted.
    kept: Vec<Corner>,
}

impl Around<'_> {
    /// The corners from one chamfered edge to the next; none where a border comes first.
    fn fan(&self, first: Corner, chamfered_at: &IdVec<Corner, Edge>) -> Option<Vec<Corner>> {
        let mut fan = vec![first];
        let mut last = first;
        while chamfered_at[last.prev()].is_none() {
            last = self.topology.twin[last.prev()];
            if last.is_none() {
                return None;
            }
            fan.push(last);
        }
        Some(fan)
    }

    /// The places in a fan at whose first edges it bends; none where it bends anywhere but at edges
    /// that are not selected.
    fn bends(&self, fan: &[Corner]) -> Option<Vec<usize>> {
        let mut bends = Vec::new();
        for place in 1..fan.len() {
            let [before, behind] =
                [place - 1, place].map(|place| self.faces.normal[fan[place].triangle()]);
            let cosine = before.dot(behind);
            let is_bend =
                is_hard(self.view, fan[place], fan[place - 1].prev()) && cosine < FLAT_COSINE;
            if is_bend && self.kept.binary_search(&fan[place]).is_ok() {
                bends.push(place);
            } else if is_bend || cosine < CREASE_COSINE {
                return None;
            }
        }
        Some(bends)
    }

    /// Whether the first and the last face can slide, and those between are flat and convex.
    fn can_part(&self, fan: &[Corner], bends: &[usize]) -> bool {
        let mut starts = bends.to_vec();
        starts.push(fan.len());
        let mut from = 0;
        let is_last = |end: usize| end == fan.len();
        starts.into_iter().all(|end| {
            let (face, is_across) = (&fan[from..end], from > 0 && !is_last(end));
            from = end;
            let turn = self.turn(face);
            turn.is_convex()
                && turn.sin() >= LEAST_SLIDE_SINE
                && (!is_across || self.is_level(face))
        })
    }

    fn turn(&self, face: &[Corner]) -> Turn {
        face.iter().fold(Turn::ZERO, |turn, &corner| {
            let [at, next, prev] =
                [corner, corner.next(), corner.prev()].map(|c| self.view.position_at(c));
            turn.plus(Turn::between(next - at, prev - at))
        })
    }

    /// Whether a face is flat, and shaded so: what is given back to it is.
    fn is_level(&self, face: &[Corner]) -> bool {
        let normal = self.faces.normal[face[0].triangle()];
        let is_shaded_flat =
            |corner: Corner| unit(self.view.normal_at(corner)).dot(normal) > FLAT_SHADING;
        face.iter().map(|corner| corner.triangle()).all(|triangle| {
            self.faces.normal[triangle].dot(normal) > FLAT_COSINE
                && triangle.corners().into_iter().all(is_shaded_flat)
        })
    }
}
