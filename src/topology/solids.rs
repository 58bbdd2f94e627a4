//! Which solid each triangle is part of.
//!
//! Parts are connected by twins. One that is closed is a solid by itself, whatever it touches. Open
//! ones that touch belong together, as far as anybody can tell.

use glam::DVec3;

use super::Topology;
use crate::groups::Groups;
use crate::ids::{Corner, Id, Triangle};
use crate::math::{area_vector, unit};
use crate::tolerance::BACK_TO_BACK_COSINE;
use crate::view::View;

/// `#triangles`: the smallest number in the solid of each.
pub fn solids(topology: &Topology) -> Vec<u32> {
    let mut parts = parts(topology);
    if topology.touching.is_empty() {
        return parts.labels();
    }
    let part_of = parts.clone().labels();
    let mut is_open = vec![false; part_of.len()];
    for border in topology.twin.ids().filter(|&corner| is_border(topology, corner)) {
        is_open[part_of[border.triangle().index()] as usize] = true;
    }
    // Of all that lie on one edge, the open ones are joined to the first of these.
    let is_open = |corner: Corner| is_open[part_of[corner.triangle().index()] as usize];
    for edge in topology.touching.chunk_by(|one, other| one[0] == other[0]) {
        let all = std::iter::once(edge[0][0]).chain(edge.iter().map(|pair| pair[1]));
        let mut open = all.filter(|&corner| is_open(corner));
        if let Some(first) = open.next() {
            open.for_each(|corner| parts.join(first.triangle().0, corner.triangle().0));
        }
    }
    parts.labels()
}

/// Takes the edges of closed skins out of the doubled ones: where a closed skin lies on another, each
/// of them is a solid by itself, and both are chamfered alike. What is left belongs to sheets, such
/// as cards, that end somewhere: at a border, or where their two sides meet back to back.
pub fn keep_sheets(view: &View, topology: &mut Topology) {
    if topology.doubled.is_empty() {
        return;
    }
    let part_of = parts(topology).labels();
    let mut ends = vec![false; part_of.len()];
    for corner in topology.twin.ids() {
        if is_border(topology, corner) || is_rim(view, topology, corner) {
            ends[part_of[corner.triangle().index()] as usize] = true;
        }
    }
    topology.doubled.retain(|side| ends[part_of[side.triangle().index()] as usize]);
}

fn parts(topology: &Topology) -> Groups {
    let mut parts = Groups::singles(topology.twin.len() / 3);
    for corner in topology.twin.ids() {
        let twin = topology.twin[corner];
        if twin.is_some() && corner < twin {
            parts.join(corner.triangle().0, twin.triangle().0);
        }
    }
    parts
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
