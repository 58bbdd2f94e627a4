//! Chamfers: the hard edges, which become strips, and the sectors around their ends, whose rings
//! become fills.

use crate::edges::Edges;
use crate::memory::Work;
use crate::sectors::Sectors;

/// The values of the stages that tell what is to be chamfered.
#[derive(Clone, Copy)]
pub struct Chamfers<'a> {
    pub edges: &'a Edges,
    pub sectors: &'a Sectors,
}

impl Chamfers<'_> {
    /// How much there is to do.
    pub fn work(&self) -> Work {
        Work {
            hard_edges: self.edges.hard.len(),
            seams: self.edges.hard.iter().filter(|edge| edge.seams != 0).count(),
            sectors: self.sectors.fans.len(),
        }
    }
}
