//! Triangulation: the source triangles, some of whose diagonals have been turned.
//!
//! Everything keeps its number: a triangle takes the place of another one, and a half-edge that is
//! no diagonal is what it was, though it may stand in another place. A place is a corner of the
//! triangles as they are now.

use crate::ids::{Corner, Id, IdVec, Triangle};
use crate::topology::Topology;

/// Triangles over the vertices of a mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct Triangulation {
    /// `#places`: the corner of the source whose vertex stands there.
    corner_at: IdVec<Corner, Corner>,
    /// `#places`: the half-edge of the source that starts there; none where it is a new diagonal.
    side_at: IdVec<Corner, Corner>,
    /// `#places`: where the other half-edge starts; none at a border.
    twin: IdVec<Corner, Corner>,
    /// `#half-edges` of the source: the place where each starts; of turned diagonals, nothing.
    place_of: IdVec<Corner, Corner>,
}

impl Triangulation {
    /// The triangles as they are in the source.
    pub fn of_source(topology: &Topology) -> Triangulation {
        let same = IdVec::from_vec(topology.twin.ids().collect());
        Triangulation {
            corner_at: same.clone(),
            side_at: same.clone(),
            twin: topology.twin.clone(),
            place_of: same,
        }
    }

    /// The corner of the source whose vertex stands at a place.
    pub fn corner_at(&self, place: Corner) -> Corner {
        self.corner_at[place]
    }

    /// The half-edge of the source that starts at a place; none where it is a new diagonal.
    pub fn side_at(&self, place: Corner) -> Corner {
        self.side_at[place]
    }

    /// The other half-edge of an edge; none at a border.
    pub fn twin(&self, place: Corner) -> Corner {
        self.twin[place]
    }

    /// Where a half-edge of the source starts that was not turned.
    pub fn place_of(&self, side: Corner) -> Corner {
        self.place_of[side]
    }

    /// `#places`: where the other half-edge of each starts.
    pub fn twins(&self) -> &IdVec<Corner, Corner> {
        &self.twin
    }

    /// The corners of the source at a triangle's places.
    pub fn corners(&self, triangle: Triangle) -> [Corner; 3] {
        triangle.corners().map(|place| self.corner_at[place])
    }

    /// Whether a triangle is not what it was.
    pub fn is_new(&self, triangle: Triangle) -> bool {
        self.corners(triangle) != triangle.corners()
    }

    /// Turns a diagonal: its two triangles become the other two of their quad.
    /// ```text
    ///    v---a        v---a
    ///    | \ |        | / |
    ///    b---w  from  b---w, where the diagonal runs from a to b on the side of v, to this
    /// ```
    pub fn turn(&mut self, diagonal: Corner) {
        let other = self.twin[diagonal];
        let [bv, va] = [diagonal.next(), diagonal.prev()];
        let [aw, wb] = [other.next(), other.prev()];
        let outer = [va, aw, wb, bv].map(|place| {
            (self.corner_at[place], self.side_at[place], self.twin[place])
        });
        let ends = [self.corner_at[wb], self.corner_at[va]];
        for (place, corner) in [(diagonal, ends[0]), (other, ends[1])] {
            let before = self.side_at[place];
            if before.is_some() {
                self.place_of[before] = Corner::NONE;
            }
            (self.corner_at[place], self.side_at[place]) = (corner, Corner::NONE);
        }
        let places = [diagonal.next(), diagonal.prev(), other.next(), other.prev()];
        for (place, (corner, side, twin)) in places.into_iter().zip(outer) {
            (self.corner_at[place], self.side_at[place], self.twin[place]) = (corner, side, twin);
            if side.is_some() {
                self.place_of[side] = place;
            }
            if twin.is_some() {
                self.twin[twin] = place;
            }
        }
    }

    /// The places around a vertex, from the one where a side of the source starts to the one before
    /// which another ends.
    pub fn fan(&self, first: Corner, last: Corner) -> impl Iterator<Item = Corner> + '_ {
        let mut following = Some(self.place_of[first]);
        std::iter::from_fn(move || {
            let place = following?;
            let is_last = self.side_at[place.prev()] == last;
            following = (!is_last).then(|| self.twin[place.prev()]);
            Some(place)
        })
    }

    /// `#places`: something that each corner of the source has, where it stands now.
    pub fn moved<T: Clone>(&self, of_corner: &IdVec<Corner, T>) -> IdVec<Corner, T> {
        IdVec::from_vec(self.corner_at.iter().map(|&corner| of_corner[corner].clone()).collect())
    }

    /// How many places there are.
    pub fn len(&self) -> usize {
        self.corner_at.len()
    }

    /// All triangles.
    pub fn triangles(&self) -> impl Iterator<Item = Triangle> {
        (0..self.len() / 3).map(Triangle::new)
    }
}
