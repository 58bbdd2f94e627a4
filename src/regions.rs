//! Regions: the shape of a mesh over other triangles of its flat faces.
//!
//! Where diagonals stood in the way of a chamfer, [`room`](crate::room) has turned them. All that
//! the earlier stages found is the same there, but for the places where half-edges stand.

use crate::edges::Edges;
use crate::faces::{Faces, own_normal};
use crate::ids::{Corner, Edge, IdVec};
use crate::room::Triangulation;
use crate::sectors::Sectors;
use crate::shape::Shape;
use crate::topology::Topology;
use crate::view::View;

/// `#corners`: the vertex of each.
pub fn indices(view: &View, triangulation: &Triangulation) -> Vec<u32> {
    let places = triangulation.triangles().flat_map(|triangle| triangle.corners());
    places.map(|place| view.vertex_at(triangulation.corner_at(place)).0).collect()
}

/// The same shape over other triangles; `view` has these.
pub fn regions(view: &View, triangulation: &Triangulation, shape: Shape) -> Shape {
    let Shape { weld, topology, faces, contacts, edges, sectors } = shape;
    let place = |side: Corner| triangulation.place_of(side);
    Shape {
        weld,
        topology: over(triangulation, topology),
        faces: faces_of(view, triangulation, faces),
        contacts: contacts.renamed(place),
        edges: edges_of(triangulation, edges),
        sectors: sectors_of(triangulation, sectors),
    }
}

fn over(triangulation: &Triangulation, topology: Topology) -> Topology {
    let renamed = topology.renamed(&|side| triangulation.place_of(side));
    Topology {
        cluster_at: triangulation.moved(&topology.cluster_at),
        twin: triangulation.twins().clone(),
        ..renamed
    }
}

fn faces_of(view: &View, triangulation: &Triangulation, mut faces: Faces) -> Faces {
    for triangle in triangulation.triangles().filter(|&triangle| triangulation.is_new(triangle)) {
        faces.normal[triangle] = own_normal(view, triangle);
    }
    let lenders = faces.lender.iter_mut().filter(|lender| lender.is_some());
    lenders.for_each(|lender| *lender = triangulation.place_of(*lender));
    faces
}

fn edges_of(triangulation: &Triangulation, mut edges: Edges) -> Edges {
    let mut chamfered_at = IdVec::filled(Edge::NONE, edges.chamfered_at.len());
    for side in edges.chamfered_at.ids().filter(|&side| edges.chamfered_at[side].is_some()) {
        chamfered_at[triangulation.place_of(side)] = edges.chamfered_at[side];
    }
    edges.chamfered_at = chamfered_at;
    for edge in edges.hard.iter_mut() {
        edge.sides = edge.sides.map(|side| triangulation.place_of(side));
    }
    edges
}

fn sectors_of(triangulation: &Triangulation, mut sectors: Sectors) -> Sectors {
    let place = |side: Corner| triangulation.place_of(side);
    for fan in sectors.fans.iter_mut() {
        (fan.first, fan.last) = (place(fan.first), place(fan.last.prev()).next());
    }
    sectors.followers.iter_mut().for_each(|follower| follower.border = place(follower.border));
    sectors.sector_of = triangulation.moved(&sectors.sector_of);
    sectors
}
