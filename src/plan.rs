//! Plan: all that is known of a mesh before the limits decide how much of it is done.

use std::sync::Arc;

use crate::contacts::Contacts;
use crate::edges::Edges;
use crate::faces::Faces;
use crate::ids::{Cluster, IdVec, Sector};
use crate::memory::Work;
use crate::offsets::Offset;
use crate::rests::{Rests, rests};
use crate::sectors::{Sectors, deep};
use crate::topology::Topology;
use crate::view::View;
use crate::weld::Weld;

/// The values of the stages that no width has a say in.
#[derive(Clone)]
pub struct Shape {
    pub weld: Arc<Weld>,
    pub topology: Arc<Topology>,
    pub faces: Arc<Faces>,
    pub contacts: Arc<Contacts>,
    pub edges: Arc<Edges>,
    pub sectors: Arc<Sectors>,
}

impl Shape {
    /// How much there is to do.
    pub fn work(&self) -> Work {
        Work {
            hard_edges: self.edges.hard.len(),
            seams: self.edges.hard.iter().filter(|edge| edge.seams != 0).count(),
            sectors: self.sectors.fans.len(),
        }
    }
}

/// The values of the stages up to the offsets.
pub struct Plan<'a> {
    pub view: View<'a>,
    pub weld: Arc<Weld>,
    pub topology: Arc<Topology>,
    pub faces: Arc<Faces>,
    pub edges: Arc<Edges>,
    pub sectors: Arc<Sectors>,
    /// `#sectors`: the move at full width.
    pub offsets: IdVec<Sector, Offset>,
    /// What must not lose what it rests on.
    pub rests: Rests,
    /// `#clusters`: whether a face goes on behind a vertex inside of it.
    pub deep: IdVec<Cluster, bool>,
}

impl<'a> Plan<'a> {
    /// What is known of a mesh, with the moves at one width.
    pub fn new(view: View<'a>, shape: &Shape, offsets: IdVec<Sector, Offset>) -> Plan<'a> {
        let Shape { weld, topology, faces, contacts, edges, sectors } = shape.clone();
        let rests = rests(&view, &topology, &faces, &edges, &contacts);
        let deep = deep(&topology, &sectors, weld.first_vertex.len());
        Plan { view, weld, topology, faces, edges, sectors, offsets, rests, deep }
    }
}

#[cfg(test)]
pub mod tests {
    use super::*;
    use crate::mesh::MeshBuffers;
    use crate::options::{Options, Width};
    use crate::pipeline::{plan, shape};
    use crate::view::view;
    use crate::weld::weld;

    /// The plan of a sound mesh for a width in mesh units.
    pub fn plan_of(mesh: &MeshBuffers, width: f32) -> Plan<'_> {
        plan_with(mesh, &Options { width: Width::Units(width), ..Options::default() })
    }

    /// The plan of a sound mesh.
    pub fn plan_with<'a>(mesh: &'a MeshBuffers, options: &Options) -> Plan<'a> {
        let view = view(&mesh.as_mesh(), options).unwrap();
        let weld = weld(&view.mesh);
        let shape = shape(&view, weld, &mut |_| Ok(())).unwrap();
        plan(view, &shape)
    }
}
