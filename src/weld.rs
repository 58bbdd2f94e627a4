//! Weld: which vertices stand at one position.
//!
//! Positions are equal when their bits are, with -0 taken as +0. There is no tolerance: a vertex
//! that is merely close is another vertex, and guessing otherwise would close gaps on purpose.

use crate::error::Error;
use crate::ids::{Cluster, Id, IdVec, Vertex};
use crate::mesh::Mesh;
use crate::watch::{Watch, each};

/// Clusters in the order in which their first vertices stand.
pub struct Weld {
    /// `#vertices`.
    pub cluster_of: IdVec<Vertex, Cluster>,
    /// `#clusters`: the first vertex of each.
    pub first_vertex: IdVec<Cluster, Vertex>,
}

/// # Errors
/// [`Error::Cancelled`] where the watch stops it.
pub fn weld(mesh: &Mesh, watch: &dyn Watch) -> Result<Weld, Error> {
    let positions = mesh.positions;
    let mut table = vec![Cluster::NONE; (positions.len() * 2).next_power_of_two()];
    let mut cluster_of = Vec::with_capacity(positions.len());
    let mut first_vertex: IdVec<Cluster, Vertex> = IdVec::default();
    each(positions.len(), watch, |vertex: Vertex| {
        let position = positions[vertex.index()];
        let slot = slot_of(
            &table,
            |cluster| key(positions[first_vertex[cluster].index()]) == key(position),
            hash_of(position),
        );
        if table[slot].is_none() {
            table[slot] = first_vertex.push(vertex);
        }
        cluster_of.push(table[slot]);
    })?;
    Ok(Weld { cluster_of: IdVec::from_vec(cluster_of), first_vertex })
}

/// The slot that holds the wanted cluster, or the empty one where it belongs.
#[inline]
fn slot_of(table: &[Cluster], is_wanted: impl Fn(Cluster) -> bool, hash: u64) -> usize {
    let mask = table.len() - 1;
    let mut slot = (hash >> 32) as usize & mask;
    while table[slot].is_some() && !is_wanted(table[slot]) {
        slot = (slot + 1) & mask;
    }
    slot
}

/// Well mixed in its high half, and the same for positions that weld.
#[inline]
pub fn hash_of(position: [f32; 3]) -> u64 {
    hash(key(position))
}

/// Adding zero turns -0 into +0.
#[inline]
fn key(position: [f32; 3]) -> [u32; 3] {
    position.map(|coordinate| (coordinate + 0.0).to_bits())
}

/// Coordinates of models repeat and lie on grids: every bit has to reach the high half.
#[inline]
fn hash([x, y, z]: [u32; 3]) -> u64 {
    let xy = (u64::from(x) << 32 | u64::from(y)).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    let mixed = (xy ^ (xy >> 29) ^ u64::from(z)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    mixed ^ (mixed >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::watch::Unwatched;

    fn clusters(positions: &[[f32; 3]]) -> Vec<u32> {
        let mesh = Mesh { positions, ..Mesh::default() };
        weld(&mesh, &Unwatched).unwrap().cluster_of.iter().map(|cluster| cluster.0).collect()
    }

    #[test]
    fn equal_positions_share_a_cluster_in_order_of_appearance() {
        let (a, b, c) = ([0.0, 1.0, 2.0], [2.0, 1.0, 0.0], [0.0, 1.0, 2.5]);
        assert_eq!(clusters(&[a, b, a, c, b]), [0, 1, 0, 2, 1]);
    }

    #[test]
    fn minus_zero_is_zero_and_close_is_not_equal() {
        let next = f32::from_bits(1.0_f32.to_bits() + 1);
        assert_eq!(clusters(&[[0.0; 3], [-0.0; 3], [1.0; 3], [1.0, 1.0, next]]), [0, 0, 1, 2]);
    }

    #[test]
    fn nothing_welds_to_nothing() {
        assert_eq!(clusters(&[]), []);
    }
}
