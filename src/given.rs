//! Given: what room and limits are found from.

use crate::chamfers::Chamfers;
use crate::error::Error;
use crate::ids::{Cluster, IdVec, Sector, Triangle};
use crate::offsets::Offset;
use crate::placement::Placement;
use crate::ranks::Ranks;
use crate::rests::Rests;
use crate::sectors::Sectors;
use crate::surface::Surface;
use crate::threads::Threads;
use crate::topology::Topology;
use crate::vanishing::Vanishing;
use crate::watch::{Watch, each};

/// The arguments of the stages that tell how far sectors may go.
#[derive(Clone, Copy)]
pub struct Given<'a> {
    pub surface: Surface<'a>,
    pub chamfers: Chamfers<'a>,
    /// `#sectors`: the move at full width.
    pub offsets: &'a IdVec<Sector, Offset>,
    /// Which of them are others than those that keep every pulled edge as far as asked.
    pub vanishing: &'a Vanishing,
    /// What is not to come together.
    pub apart: Option<&'a Ranks>,
    /// What must not lose what it rests on.
    pub rests: &'a Rests,
    /// `#clusters`: see [`deep`].
    pub deep: &'a IdVec<Cluster, bool>,
    /// `#triangles`: see [`crate::room::plenty`]; of some that have it may not be known.
    pub plenty: &'a IdVec<Triangle, bool>,
    pub threads: &'a Threads,
}

impl<'a> Given<'a> {
    /// The sectors at some shares of their offsets; `share: #sectors`.
    ///
    /// # Errors
    /// [`Error::Cancelled`] where the watch stops it.
    pub fn placement(
        &self,
        share: IdVec<Sector, f64>,
        watch: &dyn Watch,
    ) -> Result<Placement<'a>, Error> {
        let (sectors, work) = (self.chamfers.sectors, (self.threads, watch));
        Placement::new(self.surface, sectors, (self.offsets, self.apart), share, work)
    }
}

/// `#clusters`: whether a face goes on for at least a row of triangles behind a vertex inside of
/// it. No chamfer reaches these, so the first row may be given away.
///
/// # Errors
/// [`Error::Cancelled`] where the watch stops it.
pub fn deep(
    topology: &Topology,
    sectors: &Sectors,
    watch: &dyn Watch,
) -> Result<IdVec<Cluster, bool>, Error> {
    let mut deep = IdVec::filled(false, topology.clusters);
    each(topology.twin.len() / 3, watch, |triangle: Triangle| {
        let corners = triangle.corners();
        if corners.iter().all(|&corner| sectors.sector_of[corner].is_none()) {
            corners.iter().for_each(|&corner| deep[topology.cluster_at[corner]] = true);
        }
    })?;
    Ok(deep)
}

#[cfg(test)]
pub mod tests {
    use super::*;
    use crate::stages::Stages;

    /// What the limits of some stages are found from.
    pub fn given_of<'a>(stages: &'a Stages) -> Given<'a> {
        let Stages { offsets, vanishing, rests, deep, plenty, threads, .. } = stages;
        let (surface, chamfers) = (stages.surface(), stages.chamfers());
        Given { surface, chamfers, offsets, vanishing, apart: None, rests, deep, plenty, threads }
    }
}
