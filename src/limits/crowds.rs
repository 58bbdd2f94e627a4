//! Crowds: what meets by the dozen at one vertex or edge of the source.
//!
//! Boxes around all of them overlap there, so boxes alone would have each compared with each. As
//! seen from there they lie in different directions, and still do when they have been pulled apart;
//! and what lies beside a crowd is told from it the same way.

use crate::error::Error;
use crate::ids::{Cluster, Corner, Id, IdVec, Sector, Vertex};
use crate::intersect::Around;
use crate::placement::Placement;
use crate::topology::Topology;
use crate::watch::{Watch, each};

use super::elements::{Element, flap_joints};
use crate::given::Given;

/// Where fewer meet, comparing each with each costs less than telling them apart.
const CROWD: u32 = 32;

/// What a crowd meets at.
#[derive(Clone, Copy, Debug)]
pub enum Crowd {
    /// Half-edges, all on the edge of this one.
    Side(Corner),
    /// Corners that move as one.
    Sector(Sector),
    /// Corners that part; one of them.
    Cluster(Cluster, Corner),
}

impl Crowd {
    /// Crowds with different names have nothing in common.
    pub fn name(self) -> u64 {
        let (kind, number) = match self {
            Crowd::Side(corner) => (0, corner.0),
            Crowd::Sector(sector) => (1, sector.0),
            Crowd::Cluster(cluster, _) => (2, cluster.0),
        };
        kind << 32 | u64::from(number)
    }

    /// From where its members lie in different directions, where the sectors stand now.
    pub fn around(self, given: &Given, placement: &Placement) -> Around {
        let source = |vertex: Vertex| given.surface.view.stored_positions()[vertex.index()];
        let at = |corner: Corner| source(given.surface.view.vertex_at(corner));
        match self {
            Crowd::Side(corner) => Around::line([at(corner), at(corner.next())]),
            Crowd::Sector(sector) => Around::point(placement.stored(sector).as_vec3().to_array()),
            Crowd::Cluster(_, corner) => Around::point(at(corner)),
        }
    }
}

/// Where crowds meet in a mesh.
pub struct Crowds {
    /// `#clusters`: how many corners are there.
    at_cluster: IdVec<Cluster, u32>,
    /// `#sectors`: how many corners are in each.
    in_sector: IdVec<Sector, u32>,
    /// Half-edges on crowded edges, each with the one that stands for all of them; sorted.
    on_side: Vec<[Corner; 2]>,
}

/// None in most meshes.
///
/// # Errors
/// [`Error::Cancelled`] where the watch stops it.
pub fn crowds(given: &Given, watch: &dyn Watch) -> Result<Option<Crowds>, Error> {
    let (topology, sectors) = (given.surface.topology, given.chamfers.sectors);
    let mut at_cluster = IdVec::filled(0, topology.clusters);
    each(topology.cluster_at.len(), watch, |corner: Corner| {
        at_cluster[topology.cluster_at[corner]] += 1;
    })?;
    if at_cluster.iter().all(|&count| count < CROWD) {
        return Ok(None);
    }
    let mut in_sector = IdVec::filled(0, sectors.fans.len());
    each(sectors.sector_of.len(), watch, |corner: Corner| {
        let sector = sectors.sector_of[corner];
        if sector.is_some() {
            in_sector[sector] += 1;
        }
    })?;
    Ok(Some(Crowds { at_cluster, in_sector, on_side: crowded_sides(topology) }))
}

impl Crowds {
    /// The crowd that an element belongs to, or else one that it lies beside.
    pub fn of(&self, given: &Given, element: Element) -> Option<Crowd> {
        match element {
            Element::Surface(triangle) => self.among(given, &triangle.corners()),
            Element::Strip(edge) => {
                let sides = given.chamfers.edges.hard[edge].sides;
                self.among(given, &[sides[0], sides[0].next()])
                    .or_else(|| self.beside(given, sides.into_iter()))
            }
            Element::Fill(ring) => {
                let sectors = given.chamfers.sectors.ring(ring).iter();
                self.beside(given, sectors.map(|&sector| given.chamfers.sectors.fans[sector].first))
            }
            Element::Flap(place) => self.beside(given, flap_joints(given, place).into_iter()),
        }
    }

    /// The crowd of the faces of some corners. One that moves as one, such as the end of a cylinder,
    /// comes first: it is flat as a rule, and then boxes alone tell nothing apart.
    fn beside(&self, given: &Given, corners: impl Iterator<Item = Corner>) -> Option<Crowd> {
        let faces = corners.map(|corner| corner.triangle().corners());
        let crowds = faces.filter_map(|corners| self.among(given, &corners));
        crowds.max_by_key(|crowd| matches!(crowd, Crowd::Sector(_)))
    }

    /// The largest crowd that one of some corners is in; a crowded edge before all others.
    fn among(&self, given: &Given, corners: &[Corner]) -> Option<Crowd> {
        let side = |corner: &Corner| self.on_side.binary_search_by_key(corner, |side| side[0]).ok();
        if let Some(place) = corners.iter().find_map(side) {
            return Some(Crowd::Side(self.on_side[place][1]));
        }
        let count = |corner: Corner| self.at_cluster[given.surface.topology.cluster_at[corner]];
        let most = corners.iter().copied().max_by_key(|&corner| count(corner))?;
        let sector = given.chamfers.sectors.sector_of[most];
        match () {
            () if count(most) < CROWD => None,
            () if sector.is_some() && self.in_sector[sector] >= CROWD => {
                Some(Crowd::Sector(sector))
            }
            () => Some(Crowd::Cluster(given.surface.topology.cluster_at[most], most)),
        }
    }
}

/// The half-edges on edges that carry a crowd of them, each with the one that stands for all;
/// sorted.
fn crowded_sides(topology: &Topology) -> Vec<[Corner; 2]> {
    let groups = topology.touching.chunk_by(|one, other| one[0] == other[0]);
    let crowded = groups.filter(|group| group.len() as u32 + 1 >= CROWD);
    let mut sides: Vec<[Corner; 2]> = crowded
        .flat_map(|group| {
            let first = group[0][0];
            std::iter::once([first; 2]).chain(group.iter().map(move |pair| [pair[1], first]))
        })
        .collect();
    sides.sort_unstable();
    sides
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::given::tests::given_of;
    use crate::shapes;
    use crate::stages::stages_of;
    use crate::watch::Unwatched;

    #[test]
    fn many_faces_at_one_corner_are_a_crowd() {
        let (few, many) = (shapes::pyramid(8), shapes::pyramid(40));
        assert!(crowds(&given_of(&stages_of(&few, 0.1)), &Unwatched).unwrap().is_none());
        let stages = stages_of(&many, 0.1);
        let given = given_of(&stages);
        let crowds = crowds(&given, &Unwatched).unwrap().unwrap();
        let of = |triangle| crowds.of(&given, Element::Surface(triangle)).unwrap();
        let found: Vec<Crowd> = stages.view.triangles().map(of).collect();
        let same = |crowd: &Crowd, other: usize| crowd.name() == found[other].name();
        // The faces around the tip, and the floor, whose triangles have one corner in common.
        assert!(found[..40].iter().all(|crowd| same(crowd, 0)));
        assert!(matches!(found[0], Crowd::Cluster(..)));
        assert!(found[40..].iter().all(|crowd| same(crowd, 40)));
        assert!(matches!(found[40], Crowd::Sector(_)));
    }
}
