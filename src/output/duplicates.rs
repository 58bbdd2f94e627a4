//! Duplicates: appended vertices that came out equal in every stream are one.
//!
//! Vertices of two charts become equal when both are copied to one place in a third. Source
//! vertices keep their indices, equal or not.

use std::collections::HashMap;
use std::collections::hash_map::Entry;

use crate::attributes::Streams;

/// Joins each appended vertex with the first vertex that equals it.
pub fn join(streams: &mut Streams, sources: usize, indices: &mut [u32]) {
    let count = streams.count();
    // Vertices by the hash of their positions; those that share one are compared.
    let mut at: HashMap<[u32; 3], Vec<u32>> = HashMap::new();
    let place = |streams: &Streams, vertex: u32| {
        streams.vertices.positions[vertex as usize].map(|along| (along + 0.0).to_bits())
    };
    for vertex in sources as u32..count {
        at.entry(place(streams, vertex)).or_default();
    }
    for vertex in 0..sources as u32 {
        if let Entry::Occupied(mut known) = at.entry(place(streams, vertex)) {
            known.get_mut().push(vertex);
        }
    }
    let mut becomes: Vec<u32> = Vec::with_capacity(count as usize - sources);
    let mut kept = sources as u32;
    for vertex in sources as u32..count {
        let known = at.entry(place(streams, vertex)).or_default();
        match known.iter().find(|&&other| streams.are_equal(other, vertex)) {
            Some(&other) => becomes.push(other),
            None => {
                streams.relocate(vertex, kept);
                known.push(kept);
                becomes.push(kept);
                kept += 1;
            }
        }
    }
    streams.truncate(kept);
    for index in indices.iter_mut().filter(|index| **index as usize >= sources) {
        *index = becomes[*index as usize - sources];
    }
}
