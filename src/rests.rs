//! Rests: what rests beside each hard edge, and so limits how much is cut off there.

use glam::DVec3;

use crate::contacts::{ASKED, Contacts, Cut, Stretch, Wedge};
use crate::edges::Edges;
use crate::error::Error;
use crate::faces::Faces;
use crate::ids::{Edge, IdVec};
use crate::topology::Topology;
use crate::view::View;
use crate::watch::Watch;

/// For each hard edge, the stretches of border in the wedge that it loses at full width.
#[derive(Default)]
pub struct Rests {
    /// `#rests`, edge by edge: each with the wedge that it lies in.
    stretches: Vec<Stretch>,
    /// `#hard edges`: where its stretches end; empty where nothing rests on anything.
    ends: IdVec<Edge, u32>,
    /// Within this distance, in mesh units, something is covered.
    tolerance: f64,
}

/// What rests in the wedges that chamfers of full width cut off.
///
/// # Errors
/// [`Error::Cancelled`] where the watch stops it.
pub fn rests(
    view: &View,
    topology: &Topology,
    faces: &Faces,
    edges: &Edges,
    contacts: &Contacts,
    watch: &dyn Watch,
) -> Result<Rests, Error> {
    let mut rests = Rests { tolerance: contacts.tolerance(), ..Rests::default() };
    if contacts.is_empty() {
        return Ok(rests);
    }
    for edge in edges.hard.iter() {
        if edge.skipped.is_none() {
            rests.stretches.extend(contacts.beside(
                view,
                topology,
                faces,
                (edge.sides, edge.widest()),
            ));
        }
        rests.ends.push(rests.stretches.len() as u32);
        watch.worked(ASKED)?;
    }
    Ok(rests)
}

impl Rests {
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
