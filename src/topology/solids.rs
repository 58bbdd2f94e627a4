//! Which solid each triangle is part of.
//!
//! Parts are connected by twins. One that is closed is a solid by itself, whatever it touches. Open
//! ones that touch belong together, as far as anybody can tell.

use super::Topology;
use crate::error::Error;
use crate::groups::Groups;
use crate::ids::{Corner, Id};
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
