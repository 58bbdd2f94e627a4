//! Sectors: the corners around a cluster that move as one.
//!
//! A sector is a fan of corners from one chamfered edge or border to the next, walked through
//! every other edge; one vertex whose corners lie in two sectors is split later (thesis 6.2,
//! corner-connected vertices). Sectors that are joined by chamfered edges form a ring.

use crate::edges::Edges;
use crate::ids::{Corner, Id, IdVec, Ring, Sector};
use crate::topology::Topology;

/// An ordered fan of corners, counter-clockwise seen from outside.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fan {
    /// Its half-edge is the fan's first edge.
    pub first: Corner,
    /// The half-edge before it, into the cluster, is the fan's last edge.
    pub last: Corner,
    /// The sector behind the last edge, or none at a border.
    pub next: Sector,
    /// Whether the first edge is a border.
    pub starts_at_border: bool,
    pub ring: Ring,
}

impl Fan {
    pub fn ends_at_border(&self) -> bool {
        self.next.is_none()
    }
}

pub struct Sectors {
    /// `#corners`: none where no chamfered edge reaches the cluster.
    pub sector_of: IdVec<Corner, Sector>,
    /// `#sectors`.
    pub fans: IdVec<Sector, Fan>,
    /// `#rings`: a range of `members` each, and whether it closes.
    pub rings: IdVec<Ring, RingRange>,
    /// The sectors of all rings, counter-clockwise; an open ring begins and ends at borders.
    pub members: Vec<Sector>,
}

/// Where a ring's sectors stand.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RingRange {
    start: u32,
    end: u32,
    /// Whether the last sector is joined to the first.
    pub closed: bool,
}

impl Sectors {
    /// The sectors of a ring, counter-clockwise.
    pub fn ring(&self, ring: Ring) -> &[Sector] {
        let range = self.rings[ring];
        &self.members[range.start as usize..range.end as usize]
    }

    /// The corners of a sector, counter-clockwise.
    pub fn corners<'a>(
        &'a self,
        topology: &'a Topology,
        sector: Sector,
    ) -> impl Iterator<Item = Corner> + 'a {
        let fan = self.fans[sector];
        let mut following = Some(fan.first);
        std::iter::from_fn(move || {
            let corner = following?;
            following = (corner != fan.last).then(|| topology.twin[corner.prev()]);
            Some(corner)
        })
    }
}

pub fn sectors(topology: &Topology, edges: &Edges) -> Sectors {
    let mut sectors = Sectors {
        sector_of: IdVec::filled(Sector::NONE, topology.twin.len()),
        fans: IdVec::default(),
        rings: IdVec::default(),
        members: Vec::new(),
    };
    for edge in edges.hard.iter().filter(|edge| edge.skipped.is_none()) {
        for side in edge.sides {
            add_fan(topology, edges, &mut sectors, side);
            add_fan(topology, edges, &mut sectors, side.next());
        }
    }
    join_rings(topology, &mut sectors);
    sectors
}

/// Adds the fan that the corner lies in, if it is not there yet.
fn add_fan(topology: &Topology, edges: &Edges, sectors: &mut Sectors, corner: Corner) {
    if sectors.sector_of[corner].is_some() {
        return;
    }
    let mut first = corner;
    while edges.chamfered_at[first].is_none() && topology.twin[first].is_some() {
        first = topology.twin[first].next();
    }
    let sector = Sector::new(sectors.fans.len());
    let mut last = first;
    sectors.sector_of[last] = sector;
    while edges.chamfered_at[last.prev()].is_none() && topology.twin[last.prev()].is_some() {
        last = topology.twin[last.prev()];
        sectors.sector_of[last] = sector;
    }
    let starts_at_border = topology.twin[first].is_none();
    sectors.fans.push(Fan { first, last, next: Sector::NONE, starts_at_border, ring: Ring::NONE });
}

fn join_rings(topology: &Topology, sectors: &mut Sectors) {
    for sector in sectors.fans.ids() {
        let across = topology.twin[sectors.fans[sector].last.prev()];
        if across.is_some() {
            sectors.fans[sector].next = sectors.sector_of[across];
        }
    }
    // Open rings first, from their borders; whatever is left then is closed.
    for starts_at_border in [true, false] {
        for sector in sectors.fans.ids() {
            let fan = sectors.fans[sector];
            if fan.ring.is_none() && (fan.starts_at_border || !starts_at_border) {
                add_ring(sectors, sector);
            }
        }
    }
}

fn add_ring(sectors: &mut Sectors, first: Sector) {
    let ring = Ring::new(sectors.rings.len());
    let start = sectors.members.len() as u32;
    let mut sector = first;
    while sector.is_some() && sectors.fans[sector].ring.is_none() {
        sectors.fans[sector].ring = ring;
        sectors.members.push(sector);
        sector = sectors.fans[sector].next;
    }
    let closed = sector.is_some();
    sectors.rings.push(RingRange { start, end: sectors.members.len() as u32, closed });
}
