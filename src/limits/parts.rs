//! Parts: triangles that are joined by edges, with a tree over each part that is chamfered.
//!
//! No width has a say in them: the triangles of the result are searched by the source triangles
//! that they stand on (see `cells`).

use std::collections::HashMap;
use std::sync::OnceLock;

use crate::bvh::{Aabb, Bounds, Forest, Tree};
use crate::corners::middle;
use crate::groups::Groups;
use crate::ids::{Cluster, Corner, Few, Id, IdVec, Ring, Sector, Triangle};
use crate::intersect::{Around, bounds, cut_each_other};
use crate::placement::Placement;
use crate::plan::Plan;
use crate::topology::Topology;
use crate::view::View;

/// Where fewer meet, comparing each with each costs less than telling them apart.
const CROWD: usize = 32;

/// The parts with chamfered edges, by number.
pub struct Parts {
    forest: Forest,
    /// `#triangles`: the place of each in the tree of its part.
    place_of: IdVec<Triangle, u32>,
    crowds: Option<Crowds>,
    /// `#parts`: whether it cuts through itself in the source. Only looked for once it matters.
    was_cut: Vec<OnceLock<bool>>,
}

impl Parts {
    pub fn new(plan: &Plan) -> Parts {
        let (order, ends) = by_part(plan);
        let boxes: Vec<Aabb> =
            plan.view.triangles().map(|t| bounds(&source(&plan.view, t))).collect();
        let forest = Forest::new(order, &ends, &boxes);
        let mut place_of = IdVec::filled(u32::MAX, boxes.len());
        for part in 0..forest.len() {
            for (place, &triangle) in (0..).zip(forest.tree(part).order) {
                place_of[Triangle(triangle)] = place;
            }
        }
        let crowds = Crowds::find(plan, &forest);
        let was_cut = vec![OnceLock::new(); forest.len()];
        Parts { forest, place_of, crowds, was_cut }
    }

    pub fn len(&self) -> usize {
        self.forest.len()
    }

    /// The tree over the triangles of a part.
    pub fn tree(&self, part: usize) -> Tree<'_> {
        self.forest.tree(part)
    }

    /// Where a triangle stands in the tree of its part.
    pub fn place_of(&self, triangle: Triangle) -> usize {
        self.place_of[triangle] as usize
    }

    /// The crowds of a part, and to which of them the triangle at each place belongs, by number;
    /// none where there is no crowd.
    pub fn crowds(&self, part: usize) -> Option<(&[Crowd], &[u32])> {
        let crowds = self.crowds.as_ref()?;
        let (own, of) = &crowds.by_part[part];
        (!own.is_empty()).then_some((own, of))
    }

    /// Whether a part cuts through itself in the source.
    pub fn was_cut(&self, view: &View, part: usize) -> bool {
        *self.was_cut[part].get_or_init(|| cuts_itself(view, self.tree(part)))
    }
}

/// The source triangle in space.
pub fn source(view: &View, triangle: Triangle) -> [[f32; 3]; 3] {
    triangle.corners().map(|corner| view.mesh.positions[view.vertex_at(corner).index()])
}

fn cuts_itself(view: &View, tree: Tree) -> bool {
    let triangle = |place: usize| source(view, Triangle(tree.order[place]));
    let boxes = (0..tree.order.len()).map(|place| bounds(&triangle(place))).collect();
    let bounds = Bounds::new(tree, boxes, Vec::new());
    tree.pairs(&bounds).any(|(a, b)| cut_each_other(&triangle(a), &triangle(b)))
}

/// The triangles of all parts with chamfered edges, part by part, and where each part ends.
fn by_part(plan: &Plan) -> (Vec<u32>, Vec<u32>) {
    let label_of = labels(plan);
    let label = |triangle: Triangle| label_of[triangle.index()] as usize;
    let mut is_chamfered = vec![false; label_of.len()];
    for edge in plan.edges.hard.iter().filter(|edge| edge.skipped.is_none()) {
        is_chamfered[label(edge.sides[0].triangle())] = true;
    }
    // A counting sort by label: first how many, then where the next one goes.
    let mut next = vec![0_u32; label_of.len()];
    let meant = || plan.view.triangles().filter(|&triangle| is_chamfered[label(triangle)]);
    meant().for_each(|triangle| next[label(triangle)] += 1);
    let (mut ends, mut total) = (Vec::new(), 0);
    for count in next.iter_mut().filter(|count| **count > 0) {
        let start = total;
        total += *count;
        ends.push(total);
        *count = start;
    }
    let mut order = vec![0; total as usize];
    for triangle in meant() {
        let place = &mut next[label(triangle)];
        order[*place as usize] = triangle.0;
        *place += 1;
    }
    (order, ends)
}

/// `#triangles`: the first triangle of the part of each, touching ones included.
fn labels(plan: &Plan) -> Vec<u32> {
    let mut groups = Groups::singles(plan.view.corner_count() / 3);
    let mut join = |one: Corner, other: Corner| groups.join(one.triangle().0, other.triangle().0);
    for corner in plan.topology.twin.ids() {
        let twin = plan.topology.twin[corner];
        if twin.is_some() && corner < twin {
            join(corner, twin);
        }
    }
    plan.topology.touching.iter().for_each(|&[one, other]| join(one, other));
    groups.labels()
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
    /// From where its triangles lie in different directions, where the sectors stand now.
    pub fn around(self, plan: &Plan, placement: &Placement) -> Around {
        let at = |corner: Corner| plan.view.mesh.positions[plan.view.vertex_at(corner).index()];
        match self {
            Crowd::Side(corner) => Around::line([at(corner), at(corner.next())]),
            Crowd::Sector(sector) => Around::point(placement.point[sector].as_vec3().to_array()),
            Crowd::Ring(ring) => {
                // A fill has its middle vertex there.
                let sectors = plan.sectors.ring(ring);
                let points: Few<_> = sectors.iter().map(|&s| placement.point[s]).collect();
                let places: Few<usize> = (0..points.len()).collect();
                Around::point(middle(&points, &places).as_vec3().to_array())
            }
            Crowd::Cluster(cluster) => {
                let first = plan.weld.first_vertex[cluster];
                Around::point(plan.view.mesh.positions[first.index()])
            }
        }
    }
}

struct Crowds {
    /// `#parts`: its crowds, and by place to which each triangle belongs, past their end if to
    /// none.
    by_part: Vec<(Vec<Crowd>, Vec<u32>)>,
}

impl Crowds {
    /// None where there are no crowds, as in most meshes.
    fn find(plan: &Plan, forest: &Forest) -> Option<Crowds> {
        let meeting = Meeting::count(plan);
        if meeting.at_cluster.iter().all(|&count| (count as usize) < CROWD) {
            return None;
        }
        let of_part = |part: usize| {
            let (mut crowds, mut numbers) = (Vec::new(), HashMap::new());
            let number = |&triangle: &u32| {
                let Some(crowd) = meeting.crowd_of(plan, Triangle(triangle)) else {
                    return u32::MAX;
                };
                *numbers.entry(crowd).or_insert_with(|| {
                    crowds.push(crowd);
                    crowds.len() as u32 - 1
                })
            };
            let of = forest.tree(part).order.iter().map(number).collect();
            (crowds, of)
        };
        Some(Crowds { by_part: (0..forest.len()).map(of_part).collect() })
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

    fn crowd_of(&self, plan: &Plan, triangle: Triangle) -> Option<Crowd> {
        let corners = triangle.corners();
        for corner in corners {
            if let Ok(place) = self.on_side.binary_search_by_key(&corner, |side| side[0]) {
                return Some(Crowd::Side(self.on_side[place][1]));
            }
        }
        let cluster = |corner: Corner| plan.topology.cluster_at[corner];
        let count = |corner: Corner| self.at_cluster[cluster(corner)] as usize;
        let most = corners.into_iter().max_by_key(|&corner| count(corner))?;
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
        } else if plan.sectors.ring(ring).len() >= CROWD {
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
