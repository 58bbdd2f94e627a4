//! Sectors: the corners around a cluster that move as one.
//!
//! A sector is a fan of corners from one chamfered edge or border to the next, walked through
//! every other edge; one vertex whose corners lie in two sectors is split later (thesis 6.2,
//! corner-connected vertices). Sectors that are joined by chamfered edges form a ring.

use crate::breaks::{is_broken, is_hard};
use crate::contacts::Contacts;
use crate::edges::Edges;
use crate::error::Error;
use crate::ids::{Cluster, Corner, Edge, Id, IdVec, Ring, Sector};
use crate::topology::{Hidden, Topology};
use crate::view::View;
use crate::watch::{Watch, each};

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
    /// Whether several borders run through the cluster, of parts that only touch here, or a border
    /// at all where something outside of the mesh rests on it.
    pub borders_meet: bool,
    /// Whether light breaks at an edge inside of it: at a hard edge that stays hard, or at one that is not
    /// hard by the angle asked for.
    pub is_broken: bool,
    pub ring: Ring,
}

impl Fan {
    pub fn ends_at_border(&self) -> bool {
        self.next.is_none()
    }

    /// Whether it lies between the same edges as another one, and these are such as they were.
    pub fn moves_as(&self, other: &Fan) -> bool {
        let kind = |fan: &Fan| (fan.starts_at_border, fan.ends_at_border(), fan.borders_meet);
        [self.first, self.last] == [other.first, other.last] && kind(self) == kind(other)
    }

    /// Whether it could slide along its border, but another rim that it lies on would gape.
    pub fn stays_with_rim(&self) -> bool {
        self.borders_meet && self.starts_at_border != self.ends_at_border()
    }
}

pub struct Sectors {
    /// `#corners`: none where no chamfered edge reaches the cluster.
    pub sector_of: IdVec<Corner, Sector>,
    /// `#sectors`.
    pub fans: IdVec<Sector, Fan>,
    /// `#rings`: a range of `members` each, and whether it closes.
    pub rings: IdVec<Ring, RingRange>,
    /// The sectors of hidden faces between two borders, sorted: these have no chamfer of their own.
    pub followers: Vec<Follower>,
    /// The corners of lines on chamfered edges whose sectors have no chamfer of their own, those first
    /// that others depend on.
    pub spanned: Vec<Corner>,
    /// The sectors of all rings, counter-clockwise; an open ring begins and ends at borders.
    pub members: Vec<Sector>,
}

/// A sector at the border of a hidden face.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Follower {
    pub sector: Sector,
    /// The sector in front of it.
    pub leader: Sector,
    /// The half-edge of the border.
    pub border: Corner,
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

/// # Errors
/// [`Error::Cancelled`] where the watch stops it.
pub fn sectors(
    view: &View,
    topology: &Topology,
    edges: &Edges,
    contacts: &Contacts,
    watch: &dyn Watch,
) -> Result<Sectors, Error> {
    let mut sectors = Sectors {
        sector_of: IdVec::filled(Sector::NONE, topology.twin.len()),
        // Where an edge ends among others, its sides have theirs in common with these.
        fans: IdVec::from_vec(Vec::with_capacity(2 * edges.hard.len())),
        rings: IdVec::default(),
        followers: Vec::new(),
        spanned: Vec::new(),
        members: Vec::new(),
    };
    each(edges.hard.len(), watch, |edge: Edge| {
        let edge = &edges.hard[edge];
        if edge.skipped.is_none() {
            let [one, two] = edge.sides;
            for corner in [one, one.next(), two, two.next()] {
                add_fan(topology, edges, &mut sectors, corner);
            }
        }
    })?;
    for parted in &edges.parted {
        add_fan(topology, edges, &mut sectors, parted.corner);
    }
    for hidden in &topology.hidden {
        add_follower(topology, edges, &mut sectors, hidden);
    }
    sectors.followers.sort_unstable();
    for &corner in &edges.spanned {
        add_whole(view, topology, &mut sectors, corner);
    }
    sectors.fans.shrink();
    mark_kept(edges, &mut sectors);
    if view.has_soft_breaks() {
        mark_soft_breaks(view, topology, edges, &mut sectors, watch)?;
    }
    join_rings(topology, &mut sectors, watch)?;
    mark_meeting_borders(view, topology, contacts, &mut sectors, watch)?;
    Ok(sectors)
}

/// Adds the fans at both ends of a hidden face's border, where the face in front of it may move.
fn add_follower(topology: &Topology, edges: &Edges, sectors: &mut Sectors, hidden: &Hidden) {
    let Hidden { half_edge, behind } = *hidden;
    let mut leaders = [behind, behind.next()];
    if topology.cluster_at[half_edge] != topology.cluster_at[behind] {
        leaders.reverse();
    }
    for (corner, leader) in [half_edge, half_edge.next()].into_iter().zip(leaders) {
        let leader = sectors.sector_of[leader];
        if leader.is_none() {
            continue;
        }
        add_fan(topology, edges, sectors, corner);
        let sector = sectors.sector_of[corner];
        let Fan { first, last, .. } = sectors.fans[sector];
        if [first, last.prev()].iter().all(|&side| topology.twin[side].is_none()) {
            sectors.followers.push(Follower { sector, leader, border: half_edge });
        }
    }
}

/// Adds the fan that the corner lies in, if it is not there yet.
#[inline(always)]
fn add_fan(topology: &Topology, edges: &Edges, sectors: &mut Sectors, corner: Corner) {
    if sectors.sector_of[corner].is_some() {
        return;
    }
    let mut first = corner;
    while !edges.parts_at_start(first) && topology.twin[first].is_some() {
        first = topology.twin[first].next();
    }
    let sector = Sector::new(sectors.fans.len());
    let mut last = first;
    sectors.sector_of[last] = sector;
    while !edges.parts_at_end(topology, last.prev()) && topology.twin[last.prev()].is_some() {
        last = topology.twin[last.prev()];
        sectors.sector_of[last] = sector;
    }
    let starts_at_border = topology.twin[first].is_none();
    sectors.fans.push(Fan {
        first,
        last,
        next: Sector::NONE,
        starts_at_border,
        borders_meet: false,
        is_broken: false,
        ring: Ring::NONE,
    });
}

/// Where more triangles meet at a vertex, walking around it for each that is a line would take
/// quadratic time.
const MOST_AROUND: usize = 64;

/// Adds the corners all around a vertex as one sector, where no border and no hard edge reaches it.
fn add_whole(view: &View, topology: &Topology, sectors: &mut Sectors, corner: Corner) {
    let mut corners = vec![corner];
    loop {
        let last = corners[corners.len() - 1];
        let twin = topology.twin[last.prev()];
        if corners.len() > MOST_AROUND
            || sectors.sector_of[last].is_some()
            || twin.is_none()
            || is_hard(view, twin, last.prev())
        {
            return;
        }
        if twin == corner {
            break;
        }
        corners.push(twin);
    }
    let sector = Sector::new(sectors.fans.len());
    corners.iter().for_each(|&corner| sectors.sector_of[corner] = sector);
    sectors.spanned.push(corner);
    sectors.fans.push(Fan {
        first: corner,
        last: corners[corners.len() - 1],
        next: Sector::NONE,
        starts_at_border: false,
        borders_meet: false,
        is_broken: false,
        ring: Ring::NONE,
    });
}

fn mark_kept(edges: &Edges, sectors: &mut Sectors) {
    let kept = edges.hard.iter().filter(|edge| edge.skipped.is_some());
    for sector in kept.flat_map(|edge| edge.sides).map(|side| sectors.sector_of[side]) {
        if sector.is_some() {
            sectors.fans[sector].is_broken = true;
        }
    }
}

/// The same where light breaks at an edge that is not hard by the angle asked for.
fn mark_soft_breaks(
    view: &View,
    topology: &Topology,
    edges: &Edges,
    sectors: &mut Sectors,
    watch: &dyn Watch,
) -> Result<(), Error> {
    each(topology.twin.len(), watch, |side: Corner| {
        let (sector, twin) = (sectors.sector_of[side], topology.twin[side]);
        let is_inside = sector.is_some() && twin.is_some() && !edges.parts_at_start(side);
        if is_inside && is_broken(view, side, twin) {
            sectors.fans[sector].is_broken = true;
        }
    })
}

fn join_rings(topology: &Topology, sectors: &mut Sectors, watch: &dyn Watch) -> Result<(), Error> {
    let count = sectors.fans.len();
    sectors.members.reserve_exact(count);
    let mut has_borders = false;
    each(count, watch, |sector: Sector| {
        let fan = &mut sectors.fans[sector];
        has_borders |= fan.starts_at_border;
        let across = topology.twin[fan.last.prev()];
        if across.is_some() {
            fan.next = sectors.sector_of[across];
        }
    })?;
    // Open rings first, from their borders; whatever is left then is closed.
    for starts_at_border in [true, false] {
        if starts_at_border && !has_borders {
            continue;
        }
        each(count, watch, |sector: Sector| {
            let fan = &sectors.fans[sector];
            if fan.ring.is_none() && (fan.starts_at_border || !starts_at_border) {
                add_ring(sectors, sector);
            }
        })?;
    }
    Ok(())
}

fn mark_meeting_borders(
    view: &View,
    topology: &Topology,
    contacts: &Contacts,
    sectors: &mut Sectors,
    watch: &dyn Watch,
) -> Result<(), Error> {
    let is_at_border = |fan: &Fan| fan.starts_at_border || fan.ends_at_border();
    if !sectors.fans.iter().any(is_at_border) {
        return Ok(());
    }
    let meeting = meeting_borders(topology);
    each(sectors.fans.len(), watch, |sector: Sector| {
        let fan = sectors.fans[sector];
        let cluster = topology.cluster_at[fan.first];
        let meets = meeting.binary_search(&cluster).is_ok()
            || is_at_border(&fan) && contacts.touch_corner(view, topology, fan.first);
        sectors.fans[sector].borders_meet = meets;
    })
}

/// The clusters, sorted, that several borders run through, but for those of hidden faces: nobody
/// sees these gape.
fn meeting_borders(topology: &Topology) -> Vec<Cluster> {
    let is_border = |corner: &Corner| {
        topology.twin[*corner].is_none()
            && !topology.is_collapsed(corner.triangle())
            && !topology.is_hidden(*corner)
    };
    let borders: Vec<Corner> = topology.twin.ids().filter(is_border).collect();
    // Where one is that of a hidden face, a border that leads to a cluster need not lead away again.
    let mut meeting = met_twice(borders.iter().map(|&border| topology.cluster_at[border]));
    meeting.extend(met_twice(borders.iter().map(|border| topology.cluster_at[border.next()])));
    meeting.sort_unstable();
    meeting
}

/// The clusters that come more than once.
fn met_twice(clusters: impl Iterator<Item = Cluster>) -> Vec<Cluster> {
    let mut sorted: Vec<Cluster> = clusters.collect();
    sorted.sort_unstable();
    sorted.windows(2).filter(|pair| pair[0] == pair[1]).map(|pair| pair[0]).collect()
}

fn add_ring(sectors: &mut Sectors, first: Sector) {
    let ring = Ring::new(sectors.rings.len());
    let start = sectors.members.len() as u32;
    let mut sector = first;
    while sector.is_some() {
        let fan = &mut sectors.fans[sector];
        if fan.ring.is_some() {
            break;
        }
        fan.ring = ring;
        sectors.members.push(sector);
        sector = fan.next;
    }
    let closed = sector.is_some();
    sectors.rings.push(RingRange { start, end: sectors.members.len() as u32, closed });
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes;
    use crate::stages::stages_of;

    /// For each ring, how many sectors it has and whether it closes; sorted.
    fn rings(sectors: &Sectors) -> Vec<(usize, bool)> {
        let ring = |ring| (sectors.ring(ring).len(), sectors.rings[ring].closed);
        let mut rings: Vec<_> = sectors.rings.ids().map(ring).collect();
        rings.sort_unstable();
        rings
    }

    #[test]
    fn around_each_corner_of_a_cube_three_sectors_close_a_ring() {
        let cube = shapes::plain_cube(1.0);
        let stages = stages_of(&cube, 0.1);
        assert_eq!(rings(&stages.sectors), [(3, true); 8]);
        assert!(stages.sectors.sector_of.iter().all(|sector| sector.is_some()));
    }

    #[test]
    fn at_a_border_a_ring_stays_open() {
        let open = shapes::open_box();
        let sectors = stages_of(&open, 0.1).sectors;
        let expected = [[(2, false); 4], [(3, true); 4]].concat();
        assert_eq!(rings(&sectors), expected);
        for ring in sectors.rings.ids().filter(|&ring| !sectors.rings[ring].closed) {
            let [first, last] = [0, 1].map(|place| sectors.fans[sectors.ring(ring)[place]]);
            assert!(first.starts_at_border && last.ends_at_border());
        }
    }

    #[test]
    fn a_sector_is_a_fan_over_soft_edges() {
        let cylinder = shapes::cylinder(8);
        let stages = stages_of(&cylinder, 0.1);
        // A vertex of the side has one or two corners in each of the two quads beside it.
        for sector in stages.sectors.fans.ids() {
            let corners: Vec<_> = stages.sectors.corners(&stages.topology, sector).collect();
            let [first, last] = [corners[0], corners[corners.len() - 1]];
            assert!(stages.edges.chamfered_at[first].is_some());
            assert!(stages.edges.chamfered_at[last.prev()].is_some());
            assert!(corners.iter().all(|&corner| stages.sectors.sector_of[corner] == sector));
        }
    }

    #[test]
    fn the_corners_of_one_vertex_may_lie_in_two_sectors() {
        let cubes = shapes::extruding_cubes();
        let stages = stages_of(&cubes, 0.1);
        let vertex = cubes.positions.iter().position(|&at| at == [1.0; 3]).unwrap();
        let at_vertex = |corner: &Corner| stages.view.vertex_at(*corner).index() == vertex;
        let corners = stages.sectors.sector_of.ids().filter(at_vertex);
        let mut sectors: Vec<_> = corners.map(|corner| stages.sectors.sector_of[corner]).collect();
        sectors.dedup();
        assert_eq!(sectors.len(), 2);
    }

    #[test]
    fn without_hard_edges_there_are_no_sectors() {
        let sphere = shapes::sphere(4, 6);
        assert_eq!(stages_of(&sphere, 0.1).sectors.fans.len(), 0);
    }
}
