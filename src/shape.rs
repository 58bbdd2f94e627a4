//! Shape: what is known of a mesh before anybody asks where its vertices go.

use crate::chamfers::Chamfers;
use crate::contacts::Contacts;
use crate::edges::Edges;
use crate::faces::Faces;
use crate::sectors::Sectors;
use crate::surface::Surface;
use crate::topology::Topology;
use crate::view::View;
use crate::weld::Weld;

/// The values of the stages from the weld to the sectors.
pub struct Shape {
    pub weld: Weld,
    pub topology: Topology,
    pub faces: Faces,
    pub contacts: Contacts,
    pub edges: Edges,
    pub sectors: Sectors,
}

impl Shape {
    pub fn surface<'a>(&'a self, view: &'a View<'a>) -> Surface<'a> {
        Surface { view, topology: &self.topology, faces: &self.faces }
    }

    pub fn chamfers(&self) -> Chamfers<'_> {
        Chamfers { edges: &self.edges, sectors: &self.sectors }
    }
}
