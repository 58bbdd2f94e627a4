//! Chamfers: the hard edges, which become strips, and the sectors around their ends, whose rings
//! become fills.

use crate::edges::Edges;
use crate::sectors::Sectors;

/// The values of the stages that tell what is to be chamfered.
#[derive(Clone, Copy)]
pub struct Chamfers<'a> {
    pub edges: &'a Edges,
    pub sectors: &'a Sectors,
}
