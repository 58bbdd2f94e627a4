//! Topology: half-edges and their twins over welded positions.
//!
//! Two opposite half-edges over the same two clusters are twins. Welding by position also joins
//! parts that merely touch, so an edge can carry four or more half-edges; only there do stored
//! vertices, normals and positions have a say in who belongs to whom.

mod crowded;
mod solids;

pub use crowded::Hidden;
pub use solids::solids;

use crate::error::Error;
use crate::groups::Groups;
use crate::ids::{Cluster, Corner, Id, IdVec, Triangle};
use crate::view::View;
use crate::watch::{Watch, each};
use crate::weld::Weld;
use crowded::{Crowd, Part};

/// Half-edges over clusters.
pub struct Topology {
    /// How many clusters there are.
    pub clusters: usize,
    /// `#corners`: the cluster of each corner's vertex.
    pub cluster_at: IdVec<Corner, Cluster>,
    /// `#corners`: the opposite half-edge, or none at a border and in collapsed triangles.
    pub twin: IdVec<Corner, Corner>,
    /// Half-edges without twin, sorted, that lie behind visible faces on their edge.
    pub hidden: Vec<Hidden>,
    /// Half-edges, sorted, along which solids touch with air on both sides.
    pub contacts: Vec<Corner>,
    /// Half-edges that lie on one edge though they are no twins: parts touch there.
    pub touching: Vec<[Corner; 2]>,
    /// Whether any triangle is [collapsed](Topology::is_collapsed).
    pub has_collapsed: bool,
}

impl Topology {
    /// Whether two corners of the triangle stand at one position. Such a triangle has no edges.
    #[inline]
    pub fn is_collapsed(&self, triangle: Triangle) -> bool {
        is_collapsed(&self.cluster_at, triangle)
    }

    /// Whether solids touch along a half-edge, with air on both sides.
    #[inline]
    pub fn is_contact(&self, half_edge: Corner) -> bool {
        self.contacts.binary_search(&half_edge).is_ok()
    }

    /// Whether a half-edge is a border behind visible faces.
    #[inline]
    pub fn is_hidden(&self, half_edge: Corner) -> bool {
        self.hidden.binary_search_by_key(&half_edge, |hidden| hidden.half_edge).is_ok()
    }

    /// The same with other half-edges in the place of those that lie together with more than one
    /// other; clusters and twins stay.
    pub fn renamed(&self, name: &impl Fn(Corner) -> Corner) -> Topology {
        let mut all = Topology {
            clusters: self.clusters,
            cluster_at: self.cluster_at.clone(),
            twin: self.twin.clone(),
            hidden: self.hidden.clone(),
            contacts: self.contacts.iter().map(|&side| name(side)).collect(),
            touching: self.touching.iter().map(|pair| pair.map(name)).collect(),
            has_collapsed: self.has_collapsed,
        };
        for hidden in &mut all.hidden {
            hidden.half_edge = name(hidden.half_edge);
            hidden.behind = name(hidden.behind);
        }
        all.sort();
        all
    }

    fn sort(&mut self) {
        self.hidden.sort_unstable();
        self.contacts.sort_unstable();
    }

    fn marry(&mut self, [one, other]: [Corner; 2]) {
        self.twin[one] = other;
        self.twin[other] = one;
    }
}

/// # Errors
/// [`Error::Cancelled`] where the watch stops it.
pub fn topology(view: &View, weld: &Weld, watch: &dyn Watch) -> Result<Topology, Error> {
    let corners = (0..view.corner_count()).map(Corner::new);
    let cluster_at = IdVec::from_vec(
        corners.map(|corner| weld.cluster_of[view.vertex_at(corner)]).collect::<Vec<_>>(),
    );
    let mut joined = Topology {
        clusters: weld.first_vertex.len(),
        cluster_at,
        twin: IdVec::filled(Corner::NONE, view.corner_count()),
        hidden: Vec::new(),
        contacts: Vec::new(),
        touching: Vec::new(),
        has_collapsed: false,
    };
    join_all(view, &mut joined, watch)?;
    joined.sort();
    Ok(joined)
}

fn is_collapsed(cluster_at: &IdVec<Corner, Cluster>, triangle: Triangle) -> bool {
    let [a, b, c] = triangle.corners().map(|corner| cluster_at[corner]);
    a == b || b == c || c == a
}

/// A half-edge in the bucket of its lower cluster: in the order of the clusters at their other ends, and
/// then of their own numbers. One number is compared faster than two.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Spoke(u64);

impl Spoke {
    fn new(far: Cluster, half_edge: Corner) -> Spoke {
        Spoke(u64::from(far.0) << 32 | u64::from(half_edge.0))
    }

    /// The cluster at the other end.
    fn far(self) -> Cluster {
        Cluster((self.0 >> 32) as u32)
    }

    fn half_edge(self) -> Corner {
        Corner(self.0 as u32)
    }
}

fn join_all(view: &View, joined: &mut Topology, watch: &dyn Watch) -> Result<(), Error> {
    let (ends, mut spokes) = buckets(view, joined, watch)?;
    joined.has_collapsed = spokes.len() < view.corner_count();
    let (mut crowds, mut start) = (Vec::new(), 0);
    each(joined.clusters, watch, |near: Cluster| {
        let end = ends[near.index()] as usize;
        spokes[start..end].sort_unstable();
        let mut bucket = &spokes[start..end];
        while let Some(&first) = bucket.first() {
            let is_same = |spoke: &&Spoke| spoke.far() == first.far();
            let count = bucket.iter().take_while(is_same).count();
            match count {
                1 => {}
                2 => join_two([first.half_edge(), bucket[1].half_edge()], joined),
                _ => crowds.push(start..start + count),
            }
            start += count;
            bucket = &bucket[count..];
        }
    })?;
    if !crowds.is_empty() {
        let mut parts = Parts::new(joined);
        // What is left over depends on which faces are of one part: those edges come last.
        let (even, uneven): (Vec<_>, Vec<_>) =
            crowds.into_iter().partition(|crowd| is_even(&spokes[crowd.clone()], joined));
        let all = even.into_iter().chain(uneven);
        for crowd in all {
            watch.worked(crowd.len())?;
            join_crowd(view, &spokes[crowd], &mut parts, joined);
        }
    }
    Ok(())
}

/// What is connected, across edges of two sides and of those crowds that are paired.
struct Parts {
    groups: Groups,
    /// `#triangles`: of each, how many sides and how many triangles were connected with it before any
    /// crowd was paired.
    held: Vec<[u32; 2]>,
}

impl Parts {
    fn new(joined: &Topology) -> Parts {
        let mut groups = Groups::singles(joined.twin.len() / 3);
        for corner in joined.twin.ids().filter(|&corner| joined.twin[corner].is_some()) {
            groups.join(corner.triangle().0, joined.twin[corner].triangle().0);
        }
        let first = groups.clone().labels();
        let mut counts = vec![0; first.len()];
        first.iter().for_each(|&first| counts[first as usize] += 1);
        let sides = |triangle: Triangle| {
            triangle.corners().iter().filter(|&&side| joined.twin[side].is_some()).count() as u32
        };
        let held =
            |(triangle, &first): (_, &u32)| [sides(Triangle(triangle)), counts[first as usize]];
        let held = (0..).zip(&first).map(held).collect();
        Parts { groups, held }
    }

    fn of(&mut self, half_edge: Corner) -> Part {
        let triangle = half_edge.triangle();
        let [sides, size] = self.held[triangle.index()];
        Part { number: self.groups.first_of(triangle.0), sides, size }
    }
}

/// All half-edges, sorted by the lower of their two clusters (counting sort), and where those of each end.
fn buckets(
    view: &View,
    joined: &Topology,
    watch: &dyn Watch,
) -> Result<(Vec<u32>, Vec<Spoke>), Error> {
    let cluster_at = &joined.cluster_at;
    let triangles = view.corner_count() / 3;
    let sides = |triangle: Triangle| {
        let [a, b, c] = triangle.corners().map(|corner| cluster_at[corner]);
        let is_whole = a != b && b != c && c != a;
        is_whole.then(|| [(a, b), (b, c), (c, a)].map(|(from, to)| [from.min(to), from.max(to)]))
    };
    let mut ends = vec![0_u32; joined.clusters];
    each(triangles, watch, |triangle| {
        let Some(sides) = sides(triangle) else { return };
        for [near, _] in sides {
            ends[near.index()] += 1;
        }
    })?;
    let mut total = 0;
    for end in &mut ends {
        total += std::mem::replace(end, total);
    }
    // Filled from where each bucket begins: afterwards that is where it ends.
    let mut spokes = vec![Spoke(0); total as usize];
    each(triangles, watch, |triangle| {
        let Some(sides) = sides(triangle) else { return };
        for (half_edge, [near, far]) in triangle.corners().into_iter().zip(sides) {
            let end = &mut ends[near.index()];
            spokes[*end as usize] = Spoke::new(far, half_edge);
            *end += 1;
        }
    })?;
    Ok((ends, spokes))
}

/// Whether as many half-edges of an edge run forth as run back.
fn is_even(edge: &[Spoke], joined: &Topology) -> bool {
    let forth = |spoke: &&Spoke| joined.cluster_at[spoke.half_edge()] < spoke.far();
    2 * edge.iter().filter(forth).count() == edge.len()
}

/// Pairs the half-edges of an edge of two sides, if they run opposite ways.
fn join_two([one, other]: [Corner; 2], joined: &mut Topology) {
    if joined.cluster_at[one] != joined.cluster_at[other] {
        joined.marry([one, other]);
    } else {
        joined.touching.push([one, other]);
    }
}

/// Pairs the half-edges of an edge of more sides. Parts grow with each pair, so that of solids that
/// are there twice each keeps its own faces all around.
fn join_crowd(view: &View, edge: &[Spoke], parts: &mut Parts, joined: &mut Topology) {
    let first = edge[0].half_edge();
    joined.touching.extend(edge[1..].iter().map(|spoke| [first, spoke.half_edge()]));
    let near = joined.cluster_at[first].min(edge[0].far());
    let (forth, back): (Vec<_>, Vec<_>) = edge
        .iter()
        .map(|spoke| spoke.half_edge())
        .partition(|&half_edge| joined.cluster_at[half_edge] == near);
    let mut part = |half_edge: Corner| parts.of(half_edge);
    let Crowd { pairs, hidden, is_contact } = crowded::crowd(view, &forth, &back, &mut part);
    joined.hidden.extend(hidden);
    if is_contact {
        joined.contacts.extend(pairs.as_flattened());
    }
    for pair in pairs {
        parts.groups.join(pair[0].triangle().0, pair[1].triangle().0);
        joined.marry(pair);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Mesh;
    use crate::options::Options;
    use crate::view::view;
    use crate::watch::Unwatched;
    use crate::weld::weld;

    fn twins_of(positions: &[[f32; 3]], normals: &[[f32; 3]], indices: &[u32]) -> Vec<Option<u32>> {
        let mesh = Mesh {
            positions,
            normals,
            indices,
            submesh_index_counts: &[indices.len() as u32],
            ..Mesh::default()
        };
        let view = view(&mesh, &Options::default()).unwrap();
        let topology = topology(&view, &weld(&mesh, &Unwatched).unwrap(), &Unwatched).unwrap();
        topology.twin.iter().map(|twin| twin.is_some().then_some(twin.0)).collect()
    }

    const SQUARE: [[f32; 3]; 4] =
        [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
    const UP: [[f32; 3]; 6] = [[0.0, 0.0, 1.0]; 6];

    // 3---2
    // | / |
    // 0---1
    #[test]
    fn the_diagonal_of_a_square_has_twins_and_the_rest_is_border() {
        let twins = twins_of(&SQUARE, &UP[..4], &[0, 1, 2, 0, 2, 3]);
        assert_eq!(twins, [None, None, Some(3), Some(2), None, None]);
    }

    #[test]
    fn a_winding_flip_leaves_both_half_edges_without_twin() {
        let twins = twins_of(&SQUARE, &UP[..4], &[0, 1, 2, 2, 0, 3]);
        assert!(twins.iter().all(Option::is_none));
    }

    #[test]
    fn a_collapsed_triangle_has_no_edges() {
        let twins = twins_of(&SQUARE, &UP[..4], &[0, 1, 2, 0, 2, 2, 0, 2, 3]);
        assert_eq!(twins[2], Some(6));
        assert_eq!(twins[3..6], [None, None, None]);
    }

    // Two wedges that touch along the edge 0-1, seen along it: each is solid between its faces.
    //
    //  A \ # / B
    //     \ /
    //      0
    //     / \
    //  D / # \ C
    #[test]
    fn touching_parts_are_paired_on_their_solid_sides() {
        let positions = [
            [0.0, 0.0, 0.0],
            [0.0, 0.0, 1.0],
            [-1.0, 1.0, 0.0],
            [1.0, 1.0, 0.0],
            [1.0, -1.0, 0.0],
            [-1.0, -1.0, 0.0],
        ];
        // Normals that differ at every face, and vertices shared by all faces: position decides.
        let (a, b, c, d) = ([0, 1, 2], [1, 0, 3], [0, 1, 4], [1, 0, 5]);
        let indices: Vec<u32> = [a, b, c, d].concat();
        let mesh_twins = twins_of(&positions, &UP, &indices);
        assert_eq!(mesh_twins[0], Some(3), "A with B, over the upper wedge");
        assert_eq!(mesh_twins[6], Some(9), "C with D, over the lower wedge");
    }
}
