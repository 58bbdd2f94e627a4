//! Copies: appended vertices, of which none equals another vertex in every stream.
//!
//! Vertices of two charts become equal when both are copied to one place in a third. What is equal
//! stands at one place, so there is a list of the vertices that came from each cluster, or several
//! by where they stand now: the tip of a huge cone has as many as it has sides.

use crate::attributes::{Attributes, Streams};
use crate::ids::{Cluster, IdVec, Vertex};
use crate::plan::Plan;
use crate::seams::Taken;
use crate::weld::hash_of;

/// The end of a list.
const NONE: u32 = u32::MAX;

/// A cluster with this many vertices for each of its lists gets more lists.
const LONG: u32 = 16;

/// The output vertices of each cluster.
pub struct Copies {
    /// `#clusters + 1`: the first list of each, and the end.
    lists_of: IdVec<Cluster, u32>,
    /// `#lists`: the vertex that each begins with.
    first: Vec<u32>,
    /// `#output vertices`: the one that follows in the list.
    next: Vec<u32>,
}

impl Copies {
    /// Lists all vertices that there are, and joins the appended ones that equal another one.
    pub fn new(plan: &Plan, attributes: &mut Attributes) -> Copies {
        let lists_of = lists_of(plan);
        let room = attributes.streams.vertices.positions.capacity();
        let sources = plan.weld.cluster_of.len();
        let lists = lists_of.iter().last().map_or(0, |&end| end as usize);
        let (first, next) = (vec![NONE; lists], Vec::with_capacity(room));
        let mut copies = Copies { lists_of, first, next };
        copies.next.resize(sources, NONE);
        // From the last to the first: each list begins with its first vertex.
        for vertex in (0..sources as u32).rev() {
            let cluster = plan.weld.cluster_of[Vertex(vertex)];
            let list = copies.list_at(&attributes.streams, cluster, vertex);
            copies.next[vertex as usize] = copies.enter(vertex, list);
        }
        copies.join_appended(plan, attributes);
        copies
    }

    /// The list of a cluster for what stands where a vertex does.
    fn list_at(&self, streams: &Streams, cluster: Cluster, vertex: u32) -> usize {
        let [start, end] = [cluster, Cluster(cluster.0 + 1)].map(|cluster| self.lists_of[cluster]);
        match end - start {
            1 => start as usize,
            lists => {
                let position = streams.vertices.positions[vertex as usize];
                start as usize + ((hash_of(position) >> 32) as usize & (lists as usize - 1))
            }
        }
    }

    /// Puts a vertex at the head of a list, and tells what follows.
    fn enter(&mut self, vertex: u32, list: usize) -> u32 {
        std::mem::replace(&mut self.first[list], vertex)
    }

    fn join_appended(&mut self, plan: &Plan, attributes: &mut Attributes) {
        let (sources, count) = (self.next.len(), attributes.streams.count());
        let mut cluster_of = vec![Cluster::NONE; count as usize - sources];
        for corner in plan.topology.cluster_at.ids() {
            let vertex = attributes.vertex_at[corner] as usize;
            if vertex >= sources {
                cluster_of[vertex - sources] = plan.topology.cluster_at[corner];
            }
        }
        let mut becomes: Vec<u32> = Vec::with_capacity(cluster_of.len());
        let mut kept = sources as u32;
        for (vertex, cluster) in (sources as u32..count).zip(cluster_of) {
            let list = self.list_at(&attributes.streams, cluster, vertex);
            let known = self.equal(&attributes.streams, list, vertex);
            becomes.push(known.unwrap_or(kept));
            if known.is_none() {
                attributes.streams.relocate(vertex, kept);
                self.add(list);
                kept += 1;
            }
        }
        attributes.streams.truncate(kept);
        for vertex in attributes.vertex_at.iter_mut().filter(|vertex| **vertex as usize >= sources)
        {
            *vertex = becomes[*vertex as usize - sources];
        }
    }

    /// A vertex of a list that equals another one in every stream.
    fn equal(&self, streams: &Streams, list: usize, vertex: u32) -> Option<u32> {
        self.find(list, |listed| streams.are_equal(listed, vertex))
    }

    /// A vertex of a list that is such.
    fn find(&self, list: usize, is_such: impl Fn(u32) -> bool) -> Option<u32> {
        let mut listed = self.first[list];
        while listed != NONE && !is_such(listed) {
            listed = self.next[listed as usize];
        }
        (listed != NONE).then_some(listed)
    }

    /// Puts the next new vertex at the head of a list.
    fn add(&mut self, list: usize) {
        let vertex = self.next.len() as u32;
        let following = self.enter(vertex, list);
        self.next.push(following);
    }

    /// A vertex of a cluster with what it takes from a place in another chart.
    pub fn get(
        &mut self,
        plan: &Plan,
        streams: &mut Streams,
        cluster: Cluster,
        vertex: u32,
        taken: &Taken,
    ) -> u32 {
        let list = self.list_at(streams, cluster, vertex);
        let known = self.find(list, |listed| streams.is_copy(plan, listed, vertex, taken));
        known.unwrap_or_else(|| {
            self.add(list);
            streams.append_copy(plan, vertex, taken)
        })
    }

    /// Takes back the vertex that was appended last if it equals another one of the cluster; gives
    /// the one that stays.
    pub fn settle(&mut self, streams: &mut Streams, cluster: Cluster) -> u32 {
        let last = streams.count() - 1;
        let list = self.list_at(streams, cluster, last);
        match self.equal(streams, list, last) {
            Some(other) => {
                streams.pop();
                other
            }
            None => {
                self.add(list);
                last
            }
        }
    }
}

/// `#clusters + 1`: a power of two of lists for each.
fn lists_of(plan: &Plan) -> IdVec<Cluster, u32> {
    let mut lists_of = IdVec::filled(0, plan.weld.first_vertex.len() + 1);
    for cluster in plan.weld.cluster_of.iter() {
        lists_of[*cluster] += 1;
    }
    let mut end = 0;
    for lists in lists_of.iter_mut() {
        let vertices = std::mem::replace(lists, end);
        end += (vertices / LONG).next_power_of_two();
    }
    lists_of
}
