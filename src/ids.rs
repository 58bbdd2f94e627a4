//! Ids that cannot be confused, and arrays that are indexed by one kind of them.

use std::marker::PhantomData;
use std::ops::{Index, IndexMut};

use smallvec::SmallVec;

/// A list that is hardly ever longer than eight, and then needs no memory of its own.
pub type Few<T> = SmallVec<[T; 8]>;

/// What every id has: it is the number of a place in an array.
pub trait Id: Copy + Eq {
    fn new(index: usize) -> Self;
    fn index(self) -> usize;
}

macro_rules! id {
    ($(#[$doc:meta])* $name:ident) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub struct $name(pub u32);

        impl $name {
            /// No such element.
            pub const NONE: $name = $name(u32::MAX);

            #[allow(dead_code)]
            pub fn is_none(self) -> bool {
                self == $name::NONE
            }

            #[allow(dead_code)]
            pub fn is_some(self) -> bool {
                self != $name::NONE
            }
        }

        impl Id for $name {
            #[inline]
            fn new(index: usize) -> Self {
                $name(index as u32)
            }

            #[inline]
            fn index(self) -> usize {
                self.0 as usize
            }
        }
    };
}

id!(
    /// A vertex of the source mesh.
    Vertex
);
id!(
    /// All source vertices at one position.
    Cluster
);
id!(
    /// A source triangle, counted through all submeshes.
    Triangle
);
id!(
    /// A corner of a source triangle, and the half-edge from it to the next corner.
    Corner
);
id!(
    /// A hard edge with two sides.
    Edge
);
id!(
    /// A fan of corners around a cluster, between two edges that are chamfered or borders.
    Sector
);
id!(
    /// Sectors around a cluster, each joined to the next by a chamfered edge.
    Ring
);

id!(
    /// A strip or a fill.
    Patch
);

impl Corner {
    /// The corner that follows in the triangle: where the half-edge ends.
    #[inline]
    pub fn next(self) -> Corner {
        let next = self.0 + 1;
        Corner(if next.is_multiple_of(3) { next - 3 } else { next })
    }

    /// The corner before: its half-edge ends here.
    #[inline]
    pub fn prev(self) -> Corner {
        Corner(if self.0.is_multiple_of(3) { self.0 + 2 } else { self.0 - 1 })
    }

    #[inline]
    pub fn triangle(self) -> Triangle {
        Triangle(self.0 / 3)
    }
}

impl Triangle {
    #[inline]
    pub fn corners(self) -> [Corner; 3] {
        let first = self.0 * 3;
        [Corner(first), Corner(first + 1), Corner(first + 2)]
    }
}

/// An array that one kind of id indexes.
#[derive(Clone, Debug, PartialEq)]
pub struct IdVec<I, T> {
    items: Vec<T>,
    id: PhantomData<I>,
}

impl<I: Id, T> IdVec<I, T> {
    pub fn from_vec(items: Vec<T>) -> Self {
        IdVec { items, id: PhantomData }
    }

    pub fn filled(value: T, count: usize) -> Self
    where
        T: Clone,
    {
        Self::from_vec(vec![value; count])
    }

    pub fn push(&mut self, item: T) -> I {
        self.items.push(item);
        I::new(self.items.len() - 1)
    }

    /// Gives back what it has grown to beyond its length.
    pub fn shrink(&mut self) {
        self.items.shrink_to_fit();
    }

    pub fn len(&self) -> usize {
        self.items.len()
    }

    pub fn ids(&self) -> impl DoubleEndedIterator<Item = I> + use<I, T> {
        (0..self.items.len()).map(I::new)
    }

    pub fn iter(&self) -> std::slice::Iter<'_, T> {
        self.items.iter()
    }

    /// The values of the ids from one number to another.
    pub fn slice(&self, range: std::ops::Range<u32>) -> &[T] {
        &self.items[range.start as usize..range.end as usize]
    }

    pub fn iter_mut(&mut self) -> std::slice::IterMut<'_, T> {
        self.items.iter_mut()
    }
}

impl<I, T> IntoIterator for IdVec<I, T> {
    type Item = T;
    type IntoIter = std::vec::IntoIter<T>;

    fn into_iter(self) -> Self::IntoIter {
        self.items.into_iter()
    }
}

impl<I: Id, T> Default for IdVec<I, T> {
    fn default() -> Self {
        Self::from_vec(Vec::new())
    }
}

impl<I: Id, T> Index<I> for IdVec<I, T> {
    type Output = T;

    #[inline]
    fn index(&self, id: I) -> &T {
        &self.items[id.index()]
    }
}

impl<I: Id, T> IndexMut<I> for IdVec<I, T> {
    #[inline]
    fn index_mut(&mut self, id: I) -> &mut T {
        &mut self.items[id.index()]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn corners_go_round_their_triangle() {
        let corner = Corner(4);
        assert_eq!(corner.next(), Corner(5));
        assert_eq!(corner.next().next(), Corner(3));
        assert_eq!(corner.prev(), Corner(3));
        assert_eq!(corner.triangle().corners(), [Corner(3), Corner(4), Corner(5)]);
    }
}
