//! Index: the vertices of the result by where they came from, and so by where they can be equal.
//!
//! Vertices of two charts become equal when both are copied to one place in a third. What is equal
//! stands at one place, so there is a list of the vertices that came from each cluster, or several
//! by where they stand now: the tip of a huge cone has as many as it has sides.

use crate::ids::{Cluster, Id, IdVec};
use crate::weld::{Weld, hash_of};

/// The end of a list.
const NONE: u32 = u32::MAX;

/// A cluster with this many vertices for each of its lists gets more lists.
const LONG: u32 = 16;

/// The output vertices of each cluster.
#[derive(Default)]
pub struct Index {
    /// `#clusters + 1`: the first list of each, and the end.
    lists_of: IdVec<Cluster, u32>,
    /// `#lists`: the vertex that each begins with.
    first: Vec<u32>,
    /// `#output vertices`: the one that follows in the list.
    next: Vec<u32>,
}

impl Index {
    /// Lists the source vertices, where they stand now.
    pub fn of_source(weld: &Weld, positions: &[[f32; 3]]) -> Index {
        let lists_of = lists_of(weld);
        let lists = lists_of.iter().last().map_or(0, |&end| end as usize);
        let mut index = Index { lists_of, first: vec![NONE; lists], next: Vec::new() };
        index.next.resize(weld.cluster_of.len(), NONE);
        // From the last to the first: each list begins with its first vertex.
        for vertex in weld.cluster_of.ids().rev() {
            let list = index.list_at(weld.cluster_of[vertex], positions[vertex.index()]);
            index.next[vertex.index()] = std::mem::replace(&mut index.first[list], vertex.0);
        }
        index
    }

    /// The list of a cluster for what stands at a position.
    pub fn list_at(&self, cluster: Cluster, position: [f32; 3]) -> usize {
        let [start, end] = [cluster, Cluster(cluster.0 + 1)].map(|cluster| self.lists_of[cluster]);
        match end - start {
            1 => start as usize,
            lists => start as usize + ((hash_of(position) >> 32) as usize & (lists as usize - 1)),
        }
    }

    /// A vertex of a list that is such.
    pub fn find(&self, list: usize, is_such: impl Fn(u32) -> bool) -> Option<u32> {
        let mut listed = self.first[list];
        while listed != NONE && !is_such(listed) {
            listed = self.next[listed as usize];
        }
        (listed != NONE).then_some(listed)
    }

    /// Leaves the next new vertex out of all lists, and tells its number.
    pub fn skip(&mut self) -> u32 {
        self.next.push(NONE);
        self.next.len() as u32 - 1
    }

    /// Puts the next new vertex at the head of a list, and tells its number.
    pub fn add(&mut self, list: usize) -> u32 {
        let vertex = self.next.len() as u32;
        self.next.push(std::mem::replace(&mut self.first[list], vertex));
        vertex
    }
}

/// `#clusters + 1`: a power of two of lists for each.
fn lists_of(weld: &Weld) -> IdVec<Cluster, u32> {
    let mut lists_of = IdVec::filled(0, weld.first_vertex.len() + 1);
    for cluster in weld.cluster_of.iter() {
        lists_of[*cluster] += 1;
    }
    let mut end = 0;
    for lists in lists_of.iter_mut() {
        let vertices = std::mem::replace(lists, end);
        end += (vertices / LONG).next_power_of_two();
    }
    lists_of
}
