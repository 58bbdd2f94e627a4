//! Parts: solids and what else is joined by edges, with a tree over each that is chamfered.
//!
//! No width has a say in them: a tree is over the cells of a part, which are its source triangles,
//! its strips and its fills, wherever these come to stand.

use std::collections::HashMap;
use std::sync::OnceLock;

use crate::bvh::{Aabb, Bounds, Forest, Kin, Tree};
use crate::corners::middle;
use crate::ids::{Cluster, Corner, Edge, Few, Id, IdVec, Ring, Sector, Triangle};
use crate::intersect::{self, Around, bounds, cut_each_other};
use crate::placement::Placement;
use crate::plan::Plan;
use crate::topology::{Topology, solids};
use crate::view::View;

/// Where fewer meet, comparing each with each costs less than telling them apart.
const CROWD: usize = 32;

/// What a tree is over.
#[derive(Clone, Copy)]
pub enum Cell {
    Surface(Triangle),
    /// Both its triangles.
    Strip(Edge),
    /// All triangles of the fill.
    Fill(Ring),
    /// One triangle of the fill of a crowded ring, for each of its sectors.
    Share(Sector),
}

/// Cells are numbered by kind.
struct Counts {
    triangles: u32,
    edges: u32,
    rings: u32,
}

impl Counts {
    fn number(&self, cell: Cell) -> u32 {
        match cell {
            Cell::Surface(triangle) => triangle.0,
            Cell::Strip(edge) => self.triangles + edge.0,
            Cell::Fill(ring) => self.triangles + self.edges + ring.0,
            Cell::Share(sector) => self.triangles + self.edges + self.rings + sector.0,
        }
    }

    fn cell(&self, number: u32) -> Cell {
        let [edges, rings] = [self.triangles, self.triangles + self.edges];
        let shares = rings + self.rings;
        match number {
            _ if number < edges => Cell::Surface(Triangle(number)),
            _ if number < rings => Cell::Strip(Edge(number - edges)),
            _ if number < shares => Cell::Fill(Ring(number - rings)),
            _ => Cell::Share(Sector(number - shares)),
        }
    }
}

/// The parts with chamfered edges, by number.
pub struct Parts {
    counts: Counts,
    forest: Forest,
    /// `#cells`, by number: the place of each in the tree of its part.
    place_of: Vec<u32>,
    crowds: Option<Crowds>,
    /// `#parts`: whether it cuts through itself in the source. Only looked for once it matters.
    was_cut: Vec<OnceLock<bool>>,
}

impl Parts {
    pub fn new(plan: &Plan) -> Parts {
        let counts = Counts {
            triangles: plan.faces.normal.len() as u32,
            edges: plan.edges.hard.len() as u32,
            rings: plan.sectors.rings.len() as u32,
        };
        let count = counts.number(Cell::Share(Sector::new(plan.sectors.fans.len()))) as usize;
        let (order, ends) = by_part(plan, &counts);
        let mut boxes = vec![Aabb::EMPTY; count];
        for &number in &order {
            boxes[number as usize] = source_box(plan, counts.cell(number));
        }
        let crowds = Crowds::find(plan, &counts, &order, count);
        // Faces apart from what is new around them: then flat ones have flat boxes.
        let group = |number: usize, crowd: u32| {
            crowd.saturating_mul(2)
                + u32::from(crowd != u32::MAX && number as u32 >= counts.triangles)
        };
        let group_of: Option<Vec<u32>> = crowds.as_ref().map(|crowds| {
            crowds.of_cell.iter().enumerate().map(|(number, &crowd)| group(number, crowd)).collect()
        });
        let forest = Forest::new(order, &ends, &boxes, group_of.as_deref());
        let mut place_of = vec![u32::MAX; count];
        for part in 0..forest.len() {
            for (place, &number) in (0..).zip(forest.tree(part).order) {
                place_of[number as usize] = place;
            }
        }
        let was_cut = vec![OnceLock::new(); forest.len()];
        Parts { counts, forest, place_of, crowds, was_cut }
    }

    pub fn len(&self) -> usize {
        self.forest.len()
    }

    /// The tree over the cells of a part, by number.
    pub fn tree(&self, part: usize) -> Tree<'_> {
        self.forest.tree(part)
    }

    pub fn cell(&self, number: u32) -> Cell {
        self.counts.cell(number)
    }

    /// Where a cell stands in the tree of its part.
    pub fn place_of(&self, cell: Cell) -> usize {
        self.place_of[self.counts.number(cell) as usize] as usize
    }

    /// All crowds; none in most meshes.
    pub fn crowds(&self) -> Option<&Crowds> {
        self.crowds.as_ref()
    }

    /// Whether a part cuts through itself in the source.
    pub fn was_cut(&self, plan: &Plan, part: usize) -> bool {
        *self.was_cut[part].get_or_init(|| self.cuts_itself(plan, self.tree(part)))
    }

    fn cuts_itself(&self, plan: &Plan, tree: Tree) -> bool {
        let triangle = |place: usize| match self.cell(tree.order[place]) {
            Cell::Surface(triangle) => source(&plan.view, triangle),
            _ => [[0.0; 3]; 3],
        };
        let places = || 0..tree.order.len();
        let boxes = places().map(|place| bounds(&triangle(place))).collect();
        let kin = self.crowds.as_ref().map_or_else(Vec::new, |crowds| {
            let kin = |place| crowds.kin(plan, tree.order[place], &triangle(place));
            places().map(kin).collect()
        });
        let bounds = Bounds::new(tree, boxes, kin);
        tree.pairs(&bounds).any(|(a, b)| cut_each_other(&triangle(a), &triangle(b)))
    }
}

/// A source triangle in space.
fn source(view: &View, triangle: Triangle) -> intersect::Triangle {
    triangle.corners().map(|corner| position(view, corner))
}

fn position(view: &View, corner: Corner) -> [f32; 3] {
    view.mesh.positions[view.vertex_at(corner).index()]
}

/// What a cell is about in the source.
fn source_box(plan: &Plan, cell: Cell) -> Aabb {
    let at = |corner: Corner| position(&plan.view, corner);
    let at_sector = |sector: Sector| Aabb::around(&[at(plan.sectors.fans[sector].first)]);
    match cell {
        Cell::Surface(triangle) => bounds(&source(&plan.view, triangle)),
        Cell::Strip(edge) => {
            let side = plan.edges.hard[edge].sides[0];
            Aabb::around(&[at(side), at(side.next())])
        }
        Cell::Fill(ring) => at_sector(plan.sectors.ring(ring)[0]),
        Cell::Share(sector) => at_sector(sector),
    }
}

/// The numbers of the cells of all parts with chamfered edges, part by part, and where each part
/// ends.
fn by_part(plan: &Plan, counts: &Counts) -> (Vec<u32>, Vec<u32>) {
    let label_of = solids(&plan.topology);
    let label = |corner: Corner| label_of[corner.triangle().index()] as usize;
    let mut is_chamfered = vec![false; label_of.len()];
    for edge in plan.edges.hard.iter().filter(|edge| edge.skipped.is_none()) {
        is_chamfered[label(edge.sides[0])] = true;
    }
    // A counting sort by label: first how many, then where the next one goes.
    let mut next = vec![0_u32; label_of.len()];
    each_cell(plan, &is_chamfered, &label_of, |_, label| next[label] += 1);
    let (mut ends, mut total) = (Vec::new(), 0);
    for count in next.iter_mut().filter(|count| **count > 0) {
        let start = total;
        total += *count;
        ends.push(total);
        *count = start;
    }
    let mut order = vec![0; total as usize];
    each_cell(plan, &is_chamfered, &label_of, |cell, label| {
        order[next[label] as usize] = counts.number(cell);
        next[label] += 1;
    });
    (order, ends)
}

/// Calls `visit` for each cell of a part that is chamfered, with the label of the part.
fn each_cell(
    plan: &Plan,
    is_chamfered: &[bool],
    label_of: &[u32],
    mut visit: impl FnMut(Cell, usize),
) {
    let label = |corner: Corner| label_of[corner.triangle().index()] as usize;
    for triangle in plan.view.triangles() {
        let label = label_of[triangle.index()] as usize;
        if is_chamfered[label] {
            visit(Cell::Surface(triangle), label);
        }
    }
    for edge in plan.edges.hard.ids().filter(|&edge| plan.edges.hard[edge].skipped.is_none()) {
        visit(Cell::Strip(edge), label(plan.edges.hard[edge].sides[0]));
    }
    for ring in plan.sectors.rings.ids() {
        let sectors = plan.sectors.ring(ring);
        let label = label(plan.sectors.fans[sectors[0]].first);
        if is_crowded(sectors) {
            sectors.iter().for_each(|&sector| visit(Cell::Share(sector), label));
        } else if sectors.len() >= 3 {
            visit(Cell::Fill(ring), label);
        }
    }
}

/// Whether the fill of a ring has a cell for each of its sectors.
pub fn is_crowded(ring: &[Sector]) -> bool {
    ring.len() >= CROWD
}

/// What many triangles of a part meet at.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub enum Crowd {
    /// All half-edges on the edge of this one.
    Side(Corner),
    /// They move as one.
    Sector(Sector),
    /// They part, each in its own direction.
    Ring(Ring),
    /// Whatever meets there.
    Cluster(Cluster),
}

impl Crowd {
    /// From where its cells lie in different directions, where the sectors stand now.
    pub fn around(self, plan: &Plan, placement: &Placement) -> Around {
        match self {
            Crowd::Sector(sector) => Around::point(placement.point[sector].as_vec3().to_array()),
            Crowd::Ring(ring) => {
                // A fill has its middle vertex there.
                let sectors = plan.sectors.ring(ring);
                let points: Few<_> = sectors.iter().map(|&s| placement.point[s]).collect();
                let places: Few<usize> = (0..points.len()).collect();
                Around::point(middle(&points, &places).as_vec3().to_array())
            }
            Crowd::Side(_) | Crowd::Cluster(_) => self.in_source(plan),
        }
    }

    /// The same before anything moves.
    fn in_source(self, plan: &Plan) -> Around {
        let at = |corner: Corner| position(&plan.view, corner);
        let first = |sector: Sector| plan.sectors.fans[sector].first;
        match self {
            Crowd::Side(corner) => Around::line([at(corner), at(corner.next())]),
            Crowd::Sector(sector) => Around::point(at(first(sector))),
            Crowd::Ring(ring) => Around::point(at(first(plan.sectors.ring(ring)[0]))),
            Crowd::Cluster(cluster) => {
                let vertex = plan.weld.first_vertex[cluster];
                Around::point(plan.view.mesh.positions[vertex.index()])
            }
        }
    }
}

/// All crowds, and what belongs to them.
pub struct Crowds {
    pub crowds: Vec<Crowd>,
    /// `#cells`, by number: the number of its crowd; past all for none.
    pub of_cell: Vec<u32>,
}

impl Crowds {
    fn find(plan: &Plan, counts: &Counts, order: &[u32], count: usize) -> Option<Crowds> {
        let meeting = Meeting::count(plan);
        if meeting.at_cluster.iter().all(|&count| (count as usize) < CROWD) {
            return None;
        }
        let mut numbers = HashMap::new();
        let mut crowds = Crowds { crowds: Vec::new(), of_cell: vec![u32::MAX; count] };
        for &number in order {
            if let Some(crowd) = meeting.crowd_of(plan, counts.cell(number)) {
                let next = crowds.crowds.len() as u32;
                let own = *numbers.entry(crowd).or_insert(next);
                if own == next {
                    crowds.crowds.push(crowd);
                }
                crowds.of_cell[number as usize] = own;
            }
        }
        Some(crowds)
    }

    /// How a source triangle lies in its crowd before anything moves.
    fn kin(&self, plan: &Plan, number: u32, triangle: &intersect::Triangle) -> Kin {
        let crowd = self.of_cell[number as usize];
        self.crowds
            .get(crowd as usize)
            .map_or(Kin::NONE, |around| Kin::new(crowd, around.in_source(plan).seen(triangle)))
    }
}

/// How many corners and triangles meet where.
struct Meeting {
    /// `#clusters`: how many corners are there.
    at_cluster: IdVec<Cluster, u32>,
    /// `#sectors`: how many corners are in each.
    in_sector: IdVec<Sector, u32>,
    /// Half-edges on crowded edges, each with the one that stands for all of them; sorted.
    on_side: Vec<[Corner; 2]>,
}

impl Meeting {
    fn count(plan: &Plan) -> Meeting {
        let mut at_cluster = IdVec::filled(0, plan.weld.first_vertex.len());
        plan.topology.cluster_at.iter().for_each(|&cluster| at_cluster[cluster] += 1);
        let mut in_sector = IdVec::filled(0, plan.sectors.fans.len());
        let sectors = plan.sectors.sector_of.iter().filter(|sector| sector.is_some());
        sectors.for_each(|&sector| in_sector[sector] += 1);
        Meeting { at_cluster, in_sector, on_side: crowded_sides(&plan.topology) }
    }

    fn crowd_of(&self, plan: &Plan, cell: Cell) -> Option<Crowd> {
        match cell {
            Cell::Surface(triangle) => self.crowd_around(plan, &triangle.corners()),
            Cell::Strip(edge) => {
                let sides = plan.edges.hard[edge].sides;
                self.crowd_around(plan, &[sides[0], sides[0].next()])
                    .or_else(|| self.crowd_beside(plan, sides.into_iter()))
            }
            Cell::Fill(ring) => {
                let sectors = plan.sectors.ring(ring).iter();
                self.crowd_beside(plan, sectors.map(|&sector| plan.sectors.fans[sector].first))
            }
            Cell::Share(sector) => Some(Crowd::Ring(plan.sectors.fans[sector].ring)),
        }
    }

    /// The crowd that faces beside a chamfer belong to. One that moves as one, such as the end of
    /// a cylinder, comes first: it is flat as a rule, and then boxes alone tell nothing apart.
    fn crowd_beside(&self, plan: &Plan, corners: impl Iterator<Item = Corner>) -> Option<Crowd> {
        let faces = corners.map(|corner| corner.triangle().corners());
        let crowds = faces.filter_map(|corners| self.crowd_around(plan, &corners));
        crowds.max_by_key(|crowd| matches!(crowd, Crowd::Sector(_)))
    }

    fn crowd_around(&self, plan: &Plan, corners: &[Corner]) -> Option<Crowd> {
        for corner in corners {
            if let Ok(place) = self.on_side.binary_search_by_key(corner, |side| side[0]) {
                return Some(Crowd::Side(self.on_side[place][1]));
            }
        }
        let cluster = |corner: Corner| plan.topology.cluster_at[corner];
        let count = |corner: Corner| self.at_cluster[cluster(corner)] as usize;
        let most = corners.iter().copied().max_by_key(|&corner| count(corner))?;
        if count(most) < CROWD {
            return None;
        }
        let sector = plan.sectors.sector_of[most];
        if sector.is_none() {
            return Some(Crowd::Cluster(cluster(most)));
        }
        let ring = plan.sectors.fans[sector].ring;
        Some(if self.in_sector[sector] as usize >= CROWD {
            Crowd::Sector(sector)
        } else if is_crowded(plan.sectors.ring(ring)) {
            Crowd::Ring(ring)
        } else {
            Crowd::Cluster(cluster(most))
        })
    }
}

/// The half-edges on edges that carry a crowd of them, each with the one that stands for all;
/// sorted.
fn crowded_sides(topology: &Topology) -> Vec<[Corner; 2]> {
    let groups = topology.touching.chunk_by(|one, other| one[0] == other[0]);
    let crowded = groups.filter(|group| group.len() + 1 >= CROWD);
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
    use crate::mesh::MeshBuffers;
    use crate::plan::tests::plan_of;
    use crate::shapes;

    /// For each part, how many cells it has.
    fn sizes(mesh: &MeshBuffers) -> Vec<usize> {
        let plan = plan_of(mesh, 0.1);
        let parts = plan.parts();
        (0..parts.len()).map(|part| parts.tree(part).order.len()).collect()
    }

    #[test]
    fn a_part_is_its_faces_edges_and_corners() {
        assert_eq!(sizes(&shapes::plain_cube(1.0)), [12 + 12 + 8]);
        assert_eq!(sizes(&shapes::cube_field(3)), [32; 3]);
        assert_eq!(sizes(&shapes::sphere(4, 6)), [], "nothing is chamfered");
    }

    #[test]
    fn a_cell_has_a_number_and_a_place() {
        let cube = shapes::plain_cube(1.0);
        let plan = plan_of(&cube, 0.1);
        let parts = plan.parts();
        for (place, &number) in parts.tree(0).order.iter().enumerate() {
            assert_eq!(parts.counts.number(parts.cell(number)), number);
            assert_eq!(parts.place_of(parts.cell(number)), place);
        }
    }

    #[test]
    fn many_faces_at_one_corner_are_a_crowd() {
        let (few, many) = (shapes::pyramid(8), shapes::pyramid(40));
        assert!(plan_of(&few, 0.1).parts().crowds().is_none());
        let plan = plan_of(&many, 0.1);
        let crowds = plan.parts().crowds().unwrap();
        // The faces around the tip, and the floor, whose triangles have one corner in common.
        assert!(crowds.crowds.iter().any(|crowd| matches!(crowd, Crowd::Ring(_))));
        assert!(crowds.crowds.iter().any(|crowd| matches!(crowd, Crowd::Sector(_))));
    }
}
