//! Rests: what rests beside each hard edge, and so limits how much is cut off there.

use glam::DVec3;

use crate::chamfers::Chamfers;
use crate::contacts::{ASKED, Contacts, Cut, Stretch, Wedge};
use crate::edges::HardEdge;
use crate::error::Error;
use crate::ids::{Corner, Edge, Id, IdVec, Sector};
use crate::math::unit;
use crate::offsets::Offset;
use crate::strips;
use crate::surface::Surface;
use crate::threads::Threads;
use crate::watch::{Times, Watch};

/// For each hard edge, the stretches of border in the wedge that it loses where its
/// chamfer is as wide as there is room for.
#[derive(Default)]
pub struct Rests {
    /// `#rests`, edge by edge: each with the wedge that it lies in.
    stretches: Vec<Stretch>,
    /// `#hard edges`: where its stretches end; empty where nothing rests on anything.
    ends: IdVec<Edge, u32>,
    /// Within this distance, in mesh units, something is covered.
    tolerance: f64,
}

/// What rests in the wedges that chamfers cut off that are as wide as there is room for. At full width
/// it would be far more where many edges meet, each of which has hardly any room.
///
/// # Errors
/// [`Error::Cancelled`] where the watch stops it.
pub fn rests(
    surface: Surface,
    chamfers: Chamfers,
    contacts: &Contacts,
    most: Most,
    (threads, watch): (&Threads, &dyn Watch),
) -> Result<Rests, Error> {
    // What is found was cut off at the tolerance, so many a place is just as far beside the chamfer:
    // there rounding is not to decide.
    let tolerance = contacts.tolerance() + surface.view.resolution;
    let mut rests = Rests { tolerance, ..Rests::default() };
    if contacts.is_empty() {
        return Ok(rests);
    }
    let Surface { view, topology, faces } = surface;
    let hard = &chamfers.edges.hard;
    let ends = |edge: &HardEdge| {
        [edge.sides[0], edge.sides[0].next()].map(|corner| view.position_at(corner))
    };
    let near = contacts.near(hard.iter().as_slice(), |edge| (ends(edge), edge.widest()), watch)?;
    let note = |_: &Rests, id: Edge, notes: &mut Rests| {
        let edge = &hard[id];
        if edge.skipped.is_none() && near.may_hold(id.index()) {
            let widths = most.widths(surface, chamfers, edge);
            notes.stretches.extend(contacts.beside(view, topology, faces, (edge.sides, widths)));
        }
        notes.ends.push(notes.stretches.len() as u32);
    };
    threads.blocks_then((hard.len(), &Times(ASKED, watch)), &mut rests, note, Rests::take)?;
    Ok(rests)
}

/// How far sectors may go.
#[derive(Clone, Copy)]
pub struct Most<'a> {
    /// `#sectors`.
    pub offsets: &'a IdVec<Sector, Offset>,
    /// `#sectors`: of these.
    pub shares: &'a IdVec<Sector, f64>,
}

impl Most<'_> {
    /// The farthest that each side of an edge is pulled from it at either end.
    fn widths(self, surface: Surface, chamfers: Chamfers, edge: &HardEdge) -> [f64; 2] {
        let [from, to] = [edge.sides[0], edge.sides[0].next()].map(|c| surface.view.position_at(c));
        let along = unit(to - from);
        let pulled = |corner: Corner| {
            let sector = chamfers.sectors.sector_of[corner];
            let is_pulled = sector.is_some();
            let way = || self.offsets[sector].vector * self.shares[sector];
            if is_pulled { way().cross(along).length() } else { 0.0 }
        };
        let [b1, a1, a2, b2] = strips::corners(edge).map(pulled);
        [a1.max(b1), a2.max(b2)].map(|width| width.min(edge.widest()))
    }
}

impl Rests {
    /// Takes those of the edges that follow.
    fn take(&mut self, next: &mut Rests) {
        let before = self.stretches.len() as u32;
        self.stretches.append(&mut next.stretches);
        for end in std::mem::take(&mut next.ends) {
            self.ends.push(before + end);
        }
    }

    /// Whether all that rests beside an edge is still covered where its sides are pulled to these
    /// ends: `[side][end]`, both sides in the direction of the first.
    pub fn are_kept(&self, edge: Edge, wedge: &Wedge, pulled: [[DVec3; 2]; 2]) -> bool {
        let cut = Cut::new(wedge, pulled);
        !self.of(edge).as_flattened().iter().any(|place| cut.uncovers(place, self.tolerance))
    }

    /// What rests beside an edge.
    #[inline]
    pub fn of(&self, edge: Edge) -> &[Stretch] {
        if self.ends.len() == 0 {
            return &[];
        }
        let start = if edge.0 == 0 { 0 } else { self.ends[Edge(edge.0 - 1)] };
        &self.stretches[start as usize..self.ends[edge] as usize]
    }
}
