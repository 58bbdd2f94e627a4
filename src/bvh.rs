//! A tree of boxes over boxes (bounding-volume hierarchy), in one flat array.
//!
//! Each node halves its boxes at the median of their middles along the longest axis. The build is
//! the same on every run: equal middles are told apart by number.

/// How many boxes a leaf holds: testing so few one by one costs less than another node.
const LEAF_SIZE: usize = 4;

/// A box along the axes: its low and its high corner.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Aabb {
    low: [f32; 3],
    high: [f32; 3],
}

impl Aabb {
    const EMPTY: Aabb = Aabb { low: [f32::INFINITY; 3], high: [f32::NEG_INFINITY; 3] };

    /// The box around some points.
    pub fn around(points: &[[f32; 3]]) -> Aabb {
        points.iter().fold(Aabb::EMPTY, |sum, &point| sum.union(Aabb { low: point, high: point }))
    }

    fn union(self, other: Aabb) -> Aabb {
        Aabb {
            low: [0, 1, 2].map(|axis| self.low[axis].min(other.low[axis])),
            high: [0, 1, 2].map(|axis| self.high[axis].max(other.high[axis])),
        }
    }

    fn overlaps(&self, other: &Aabb) -> bool {
        (0..3).all(|axis| self.low[axis] <= other.high[axis] && other.low[axis] <= self.high[axis])
    }

    /// Twice the middle, halved first so that it cannot overflow.
    fn middle(&self, axis: usize) -> f32 {
        self.low[axis] / 2.0 + self.high[axis] / 2.0
    }
}

struct Node {
    bounds: Aabb,
    /// The node after this one and all below it.
    next: u32,
    /// Where its boxes stand in `order`, if it is a leaf; empty otherwise.
    first: u32,
    count: u32,
}

/// The tree over a slice of boxes.
pub(crate) struct Bvh {
    /// Depth first: the children of a node follow it.
    nodes: Vec<Node>,
    /// `#boxes`: their numbers, leaf by leaf.
    order: Vec<u32>,
}

impl Bvh {
    /// Builds the tree over `boxes`.
    pub fn new(boxes: &[Aabb]) -> Bvh {
        let mut order: Vec<u32> = (0..boxes.len() as u32).collect();
        let mut nodes = Vec::with_capacity(boxes.len());
        if !boxes.is_empty() {
            build(&mut nodes, &mut order, 0, boxes);
        }
        Bvh { nodes, order }
    }

    /// Calls `visit` with the number of each box whose leaf overlaps `bounds`.
    pub fn visit_overlapping(&self, bounds: &Aabb, mut visit: impl FnMut(u32)) {
        let mut place = 0;
        while let Some(node) = self.nodes.get(place) {
            let overlaps = node.bounds.overlaps(bounds);
            if overlaps {
                let leaf = node.first as usize..(node.first + node.count) as usize;
                self.order[leaf].iter().for_each(|&number| visit(number));
            }
            place = if overlaps { place + 1 } else { node.next as usize };
        }
    }
}

/// Appends the node over `order`, which stands at `first` in the whole, and all below it.
fn build(nodes: &mut Vec<Node>, order: &mut [u32], first: usize, boxes: &[Aabb]) {
    let bounds = order.iter().fold(Aabb::EMPTY, |sum, &number| sum.union(boxes[number as usize]));
    let place = nodes.len();
    let is_leaf = order.len() <= LEAF_SIZE;
    let count = if is_leaf { order.len() as u32 } else { 0 };
    nodes.push(Node { bounds, next: 0, first: first as u32, count });
    if !is_leaf {
        let half = order.len() / 2;
        let axis = longest_axis(&bounds);
        let middle = |number: u32| boxes[number as usize].middle(axis);
        order
            .select_nth_unstable_by(half, |&a, &b| middle(a).total_cmp(&middle(b)).then(a.cmp(&b)));
        let (low, high) = order.split_at_mut(half);
        build(nodes, low, first, boxes);
        build(nodes, high, first + half, boxes);
    }
    nodes[place].next = nodes.len() as u32;
}

fn longest_axis(bounds: &Aabb) -> usize {
    let length = |axis: usize| bounds.high[axis] - bounds.low[axis];
    (0..3).fold(0, |longest, axis| if length(axis) > length(longest) { axis } else { longest })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_the_boxes_that_overlap() {
        let boxes: Vec<Aabb> = (0..100)
            .map(|step| {
                let x = (step * 37 % 100) as f32;
                Aabb::around(&[[x, 0.0, 0.0], [x + 0.5, 1.0, 1.0]])
            })
            .collect();
        let bounds = Aabb::around(&[[9.75, 0.5, 0.5], [12.25, 0.5, 0.5]]);
        let mut found = Vec::new();
        Bvh::new(&boxes).visit_overlapping(&bounds, |number| {
            if boxes[number as usize].overlaps(&bounds) {
                found.push(number * 37 % 100);
            }
        });
        found.sort_unstable();
        assert_eq!(found, [10, 11, 12]);
    }

    #[test]
    fn an_empty_tree_finds_nothing() {
        let point = Aabb::around(&[[0.0; 3]]);
        Bvh::new(&[]).visit_overlapping(&point, |_| panic!("nothing is there"));
    }
}
