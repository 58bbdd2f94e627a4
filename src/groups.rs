//! Which elements belong together (union-find).

use crate::error::Error;
use crate::watch::{Watch, collect};

/// A partition of the numbers from 0.
#[derive(Clone)]
pub struct Groups {
    parent: Vec<u32>,
}

impl Groups {
    /// Each number alone.
    pub fn singles(count: usize) -> Groups {
        Groups { parent: (0..count as u32).collect() }
    }

    /// The smallest number of the group that `element` is in.
    pub fn first_of(&mut self, mut element: u32) -> u32 {
        while self.parent[element as usize] != element {
            let above = self.parent[element as usize];
            self.parent[element as usize] = self.parent[above as usize];
            element = above;
        }
        element
    }

    /// Makes one group of the two.
    pub fn join(&mut self, a: u32, b: u32) {
        let [a, b] = [self.first_of(a), self.first_of(b)];
        self.parent[a.max(b) as usize] = a.min(b);
    }

    /// As [`Groups::labels`], telling a watch again and again.
    ///
    /// # Errors
    /// What `watch` gives.
    pub fn labels_watched(mut self, watch: &dyn Watch) -> Result<Vec<u32>, Error> {
        collect(self.parent.len(), watch, |element| self.first_of(element as u32))
    }

    /// `#elements`: the smallest number of the group of each.
    pub fn labels(mut self) -> Vec<u32> {
        (0..self.parent.len() as u32).map(|element| self.first_of(element)).collect()
    }
}
