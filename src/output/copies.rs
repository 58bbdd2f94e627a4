//! Copies: appended vertices, of which none equals another vertex in every stream.
//!
//! Vertices of two charts become equal when both are copied to one place in a third. What is equal
//! stands at one place, so each cluster has a list of the vertices that came from it.

use crate::attributes::{Attributes, Streams};
use crate::ids::{Cluster, IdVec, Vertex};
use crate::plan::Plan;
use crate::seams::Taken;

/// The end of a list.
const NONE: u32 = u32::MAX;

/// The output vertices of each cluster.
pub struct Copies {
    /// `#clusters`: the one that a list begins with.
    first: IdVec<Cluster, u32>,
    /// `#output vertices`: the one that follows in the list.
    next: Vec<u32>,
}

impl Copies {
    /// Lists all vertices that there are, and joins the appended ones that equal another one.
    pub fn new(plan: &Plan, attributes: &mut Attributes) -> Copies {
        let room = attributes.streams.vertices.positions.capacity();
        let sources = plan.weld.cluster_of.len();
        let mut copies = Copies {
            first: IdVec::filled(NONE, plan.weld.first_vertex.len()),
            next: Vec::with_capacity(room),
        };
        copies.next.resize(sources, NONE);
        // From the last to the first: each list begins with its first vertex.
        for vertex in (0..sources as u32).rev() {
            let cluster = plan.weld.cluster_of[Vertex(vertex)];
            copies.next[vertex as usize] = copies.enter(vertex, cluster);
        }
        copies.join_appended(plan, attributes);
        copies
    }

    /// Puts a vertex at the head of a cluster's list, and tells what follows.
    fn enter(&mut self, vertex: u32, cluster: Cluster) -> u32 {
        std::mem::replace(&mut self.first[cluster], vertex)
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
            let known = self.equal(&attributes.streams, cluster, vertex);
            becomes.push(known.unwrap_or(kept));
            if known.is_none() {
                attributes.streams.relocate(vertex, kept);
                self.list(cluster);
                kept += 1;
            }
        }
        attributes.streams.truncate(kept);
        for vertex in attributes.vertex_at.iter_mut().filter(|vertex| **vertex as usize >= sources)
        {
            *vertex = becomes[*vertex as usize - sources];
        }
    }

    /// A listed vertex of the cluster that equals another one in every stream.
    fn equal(&self, streams: &Streams, cluster: Cluster, vertex: u32) -> Option<u32> {
        self.find(cluster, |listed| streams.are_equal(listed, vertex))
    }

    /// A listed vertex of the cluster that is such.
    fn find(&self, cluster: Cluster, is_such: impl Fn(u32) -> bool) -> Option<u32> {
        let mut listed = self.first[cluster];
        while listed != NONE && !is_such(listed) {
            listed = self.next[listed as usize];
        }
        (listed != NONE).then_some(listed)
    }

    /// Lists the vertex behind all that are listed so far.
    fn list(&mut self, cluster: Cluster) {
        let vertex = self.next.len() as u32;
        let following = self.enter(vertex, cluster);
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
        let known = self.find(cluster, |listed| streams.is_copy(plan, listed, vertex, taken));
        known.unwrap_or_else(|| {
            self.list(cluster);
            streams.append_copy(plan, vertex, taken)
        })
    }

    /// Takes back the vertex that was appended last if it equals another one of the cluster; gives
    /// the one that stays.
    pub fn settle(&mut self, streams: &mut Streams, cluster: Cluster) -> u32 {
        let last = streams.count() - 1;
        match self.equal(streams, cluster, last) {
            Some(other) => {
                streams.pop();
                other
            }
            None => {
                self.list(cluster);
                last
            }
        }
    }
}
