//! Plan: all that is known of a mesh before the limits decide how much of it is done.

use crate::edges::Edges;
use crate::ids::{IdVec, Sector};
use crate::offsets::Offset;
use crate::sectors::Sectors;
use crate::topology::Topology;
use crate::view::View;

/// The values of the stages up to the offsets.
pub struct Plan<'a> {
    pub view: View<'a>,
    pub topology: Topology,
    pub edges: Edges,
    pub sectors: Sectors,
    /// `#sectors`: the move at full width.
    pub offsets: IdVec<Sector, Offset>,
}

#[cfg(test)]
pub mod tests {
    use super::*;
    use crate::edges::edges;
    use crate::mesh::MeshBuffers;
    use crate::offsets::offsets;
    use crate::options::{Options, Width};
    use crate::sectors::sectors;
    use crate::topology::topology;
    use crate::view::view;
    use crate::weld::weld;

    /// The plan of a mesh at a width in mesh units.
    pub fn plan_of(buffers: &MeshBuffers, width: f32) -> Plan<'_> {
        let options = Options { width: Width::Units(width), ..Options::default() };
        let mesh = buffers.as_mesh();
        let view = view(&mesh, &options).unwrap();
        let topology = topology(&view, &weld(&mesh));
        let edges = edges(&view, &topology);
        let sectors = sectors(&topology, &edges);
        let offsets = offsets(&view, &topology, &sectors);
        Plan { view, topology, edges, sectors, offsets }
    }
}
