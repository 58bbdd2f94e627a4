//! Which solid each triangle is part of.
//!
//! Parts are connected by twins. One that is closed is a solid by itself, whatever it touches. Open
//! ones that touch belong together, as far as anybody can tell.

use glam::DVec3;

use super::Topology;
use crate::error::Error;
use crate::groups::Groups;
use crate::ids::{Corner, Id, Triangle};
use crate::math::{area_vector, unit};
use crate::tolerance::BACK_TO_BACK_COSINE;
use crate::view::View;
use crate::watch::{Watch, each};

/// `#triangles`: the smallest number in the solid of each.
///
/// # Errors
/// [`Error::Cancelled`] where the watch stops it.
pub fn solids(topology: &Topology, watch: &dyn Watch) -> Result<Vec<u32>, Error> {
    let mut parts = parts(topology, watch)?;
    if topology.touching.is_empty() {
        return parts.labels_watched(watch);
    }
    let part_of = parts.clone().labels_watched(watch)?;
    let mut is_open = vec![false; part_of.len()];
    each(topology.twin.len(), watch, |corner: Corner| {
        if is_border(topology, corner) {
            is_open[part_of[corner.triangle().index()] as usize] = true;
        }
    })?;
    // Of all that lie on one edge, the open ones are joined to the first of these.
    let is_open = |corner: Corner| is_open[part_of[corner.triangle().index()] as usize];
    for edge in topology.touching.chunk_by(|one, other| one[0] == other[0]) {
        watch.worked(edge.len())?;
        let all = std::iter::once(edge[0][0]).chain(edge.iter().map(|pair| pair[1]));
        let mut open = all.filter(|&corner| is_open(corner));
        if let Some(first) = open.next() {
            open.for_each(|corner| parts.join(first.triangle().0, corner.triangle().0));
        }
    }
    parts.labels_watched(watch)
}

/// Takes the edges of closed skins out of the doubled ones: where a closed skin lies on another, each
/// of them is a solid by itself, and both are chamfered alike. What is left belongs to sheets, such
/// as cards, that end somewhere: at a border, or where their two sides meet back to back.
///
/// # Errors
/// [`Error::Cancelled`] where the watch stops it.
pub fn keep_sheets(view: &View, topology: &mut Topology, watch: &dyn Watch) -> Result<(), Error> {
    if topology.doubled.is_empty() {
        return Ok(());
    }
    let part_of = parts(topology, watch)?.labels_watched(watch)?;
    let mut ends = vec![false; part_of.len()];
    each(topology.twin.len(), watch, |corner: Corner| {
        if is_border(topology, corner) || is_rim(view, topology, corner) {
            ends[part_of[corner.triangle().index()] as usize] = true;
        }
    })?;
    topology.doubled.retain(|side| ends[part_of[side.triangle().index()] as usize]);
    Ok(())
}

fn parts(topology: &Topology, watch: &dyn Watch) -> Result<Groups, Error> {
    let mut parts = Groups::singles(topology.twin.len() / 3);
    each(topology.twin.len(), watch, |corner: Corner| {
        let twin = topology.twin[corner];
        if twin.is_some() && corner < twin {
            parts.join(corner.triangle().0, twin.triangle().0);
        }
    })?;
    Ok(parts)
}

fn is_border(topology: &Topology, corner: Corner) -> bool {
    topology.twin[corner].is_none() && !topology.is_collapsed(corner.triangle())
}

/// Whether the two faces of an edge lie back to back.
fn is_rim(view: &View, topology: &Topology, corner: Corner) -> bool {
    let twin = topology.twin[corner];
    let normal = |triangle: Triangle| -> DVec3 { unit(area_vector(view.triangle(triangle))) };
    twin.is_some()
        && corner < twin
        && normal(corner.triangle()).dot(normal(twin.triangle())) < BACK_TO_BACK_COSINE
}
