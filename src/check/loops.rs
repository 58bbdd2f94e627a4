//! Loops of open borders.

use super::surface::{HalfEdge, Surface};
use crate::groups::Groups;

/// The loops of a mesh. Border half-edges follow each other where a fan of triangles leads from one to
/// the next, so that loops which only touch count apart.
pub(super) struct Loops<'a> {
    pub borders: Vec<&'a HalfEdge>,
    /// `#borders`: the loop of each, by one of its corners.
    pub of: Vec<u32>,
}

impl<'a> Loops<'a> {
    pub fn new(surface: &'a Surface<'a>) -> Loops<'a> {
        let mut loops = Groups::singles(surface.mesh.indices.len());
        let mut borders: Vec<&HalfEdge> = Vec::new();
        for edge in surface.edges() {
            match edge {
                ([a], [b]) => {
                    loops.join(a.corners[0], b.corners[1]);
                    loops.join(a.corners[1], b.corners[0]);
                }
                (side, []) | ([], side) => borders.extend(side),
                _ => {}
            }
        }
        for border in &borders {
            loops.join(border.corners[0], border.corners[1]);
        }
        let of = borders.iter().map(|border| loops.first_of(border.corners[0])).collect();
        Loops { borders, of }
    }

    pub fn count(self) -> usize {
        distinct(self.of)
    }

    /// How many loops have a border of a kind.
    pub fn count_with(&self, is_of_kind: impl Fn(&HalfEdge) -> bool) -> usize {
        let all = self.borders.iter().zip(&self.of);
        distinct(all.filter(|(border, _)| is_of_kind(border)).map(|(_, &of)| of).collect())
    }
}

fn distinct(mut all: Vec<u32>) -> usize {
    all.sort_unstable();
    all.dedup();
    all.len()
}
