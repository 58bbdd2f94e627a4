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
    /// Overlaps nothing.
    pub const EMPTY: Aabb = Aabb { low: [f32::INFINITY; 3], high: [f32::NEG_INFINITY; 3] };

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

    /// Halved first, so that it cannot overflow.
    fn middle(&self, axis: usize) -> f32 {
        self.low[axis] / 2.0 + self.high[axis] / 2.0
    }
}

/// Where something lies as seen from what it has in common with others (see `intersect::crowds`).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Kin {
    /// What that is: only things with the same can be told apart.
    around: Option<u32>,
    bounds: Aabb,
}

impl Kin {
    /// Nothing in common with anything.
    pub const NONE: Kin = Kin { around: None, bounds: Aabb::EMPTY };

    pub fn new(around: u32, bounds: Aabb) -> Kin {
        Kin { around: Some(around), bounds }
    }

    /// Whether the two have nothing to do with each other, though their boxes overlap.
    pub fn is_apart(&self, other: &Kin) -> bool {
        self.around.is_some() && self.around == other.around && !self.bounds.overlaps(&other.bounds)
    }

    fn union(self, other: Kin) -> Kin {
        match self.around == other.around {
            true => Kin { around: self.around, bounds: self.bounds.union(other.bounds) },
            false => Kin::NONE,
        }
    }
}

struct Node {
    bounds: Aabb,
    /// The node after this one and all below it.
    next: u32,
    /// The first of its boxes in the order of the tree.
    first: u32,
    /// How many boxes it has itself: none but in a leaf.
    count: u32,
}

/// The tree over a slice of boxes.
pub(crate) struct Bvh {
    /// Depth first: the children of a node follow it.
    nodes: Vec<Node>,
    /// `#boxes`: their numbers, leaf by leaf.
    order: Vec<u32>,
    /// `#boxes`: the boxes themselves, in the same order.
    boxes: Vec<Aabb>,
    /// Their kin, and that of the nodes; none where there is no crowd.
    crowds: Option<Crowds>,
}

struct Crowds {
    /// `#boxes`, in the order of the tree.
    of_box: Vec<Kin>,
    /// `#nodes`: of all that is below.
    of_node: Vec<Kin>,
}

impl Bvh {
    /// Builds the tree over `boxes`, with the kin of each (`#boxes`) if there are crowds.
    pub fn new(boxes: &[Aabb], kin: Option<&[Kin]>) -> Bvh {
        let mut order: Vec<u32> = (0..boxes.len() as u32).collect();
        let mut nodes = Vec::with_capacity(boxes.len());
        if !boxes.is_empty() {
            build(&mut nodes, &mut order, 0, boxes);
        }
        let boxes = order.iter().map(|&number| boxes[number as usize]).collect();
        let crowds = kin.map(|kin| Crowds::new(&nodes, &order, kin));
        Bvh { nodes, order, boxes, crowds }
    }

    /// Calls `visit` once for each two boxes that have at least a point in common and are not told
    /// apart by their kin. Where `skip` holds for all boxes of a leaf by the time that it is its
    /// turn, pairs with what comes behind are left out.
    pub fn visit_overlapping_pairs(
        &self,
        skip: impl Fn(u32) -> bool,
        mut visit: impl FnMut(u32, u32),
    ) {
        for (place, leaf) in self.nodes.iter().enumerate().filter(|(_, node)| node.count > 0) {
            if leaf.places().all(|place| skip(self.order[place])) {
                continue;
            }
            let mut visit_places = |a: usize, b: usize| {
                let of_box = |crowds: &Crowds| crowds.of_box[a].is_apart(&crowds.of_box[b]);
                if self.boxes[a].overlaps(&self.boxes[b])
                    && !self.crowds.as_ref().is_some_and(of_box)
                {
                    visit(self.order[a], self.order[b]);
                }
            };
            for a in leaf.places() {
                (a + 1..leaf.places().end).for_each(|b| visit_places(a, b));
            }
            // Only leaves behind this one: those before have met it already.
            self.visit_leaves_behind(place, |other| {
                for a in leaf.places() {
                    other.places().for_each(|b| visit_places(a, b));
                }
            });
        }
    }

    /// Calls `visit` for each leaf behind `leaf`, in the order of the tree, that overlaps it.
    fn visit_leaves_behind(&self, leaf: usize, mut visit: impl FnMut(&Node)) {
        let bounds = &self.nodes[leaf].bounds;
        let mut place = self.nodes[leaf].next as usize;
        while let Some(node) = self.nodes.get(place) {
            let of_node = |crowds: &Crowds| crowds.of_node[leaf].is_apart(&crowds.of_node[place]);
            let overlaps =
                node.bounds.overlaps(bounds) && !self.crowds.as_ref().is_some_and(of_node);
            if overlaps && node.count > 0 {
                visit(node);
            }
            place = if overlaps { place + 1 } else { node.next as usize };
        }
    }
}

impl Crowds {
    fn new(nodes: &[Node], order: &[u32], kin: &[Kin]) -> Crowds {
        let of_box: Vec<Kin> = order.iter().map(|&number| kin[number as usize]).collect();
        let mut of_node = vec![Kin::NONE; nodes.len()];
        // Children follow their node, so from behind they are known first.
        for (place, node) in nodes.iter().enumerate().rev() {
            of_node[place] = if node.count > 0 {
                let own = &of_box[node.places()];
                own[1..].iter().fold(own[0], |all, &kin| all.union(kin))
            } else {
                let first = place + 1;
                of_node[first].union(of_node[nodes[first].next as usize])
            };
        }
        Crowds { of_box, of_node }
    }
}

impl Node {
    /// Where its boxes stand in the order of the tree.
    fn places(&self) -> std::ops::Range<usize> {
        self.first as usize..(self.first + self.count) as usize
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

    fn pairs(boxes: &[Aabb]) -> Vec<(u32, u32)> {
        let mut pairs = Vec::new();
        Bvh::new(boxes, None)
            .visit_overlapping_pairs(|_| false, |a, b| pairs.push((a.min(b), a.max(b))));
        pairs.sort_unstable();
        pairs
    }

    #[test]
    fn finds_each_overlapping_pair_once() {
        let boxes: Vec<Aabb> = (0..200)
            .map(|step| {
                let [x, y, z] = [37, 53, 71].map(|stride| (step * stride % 97) as f32);
                Aabb::around(&[[x, y, z], [x + 20.0, y + 30.0, z + 10.0]])
            })
            .collect();
        let expected: Vec<(u32, u32)> = (0..200u32)
            .flat_map(|a| (a + 1..200).map(move |b| (a, b)))
            .filter(|&(a, b)| boxes[a as usize].overlaps(&boxes[b as usize]))
            .collect();
        assert!(expected.len() > 100);
        assert_eq!(pairs(&boxes), expected);
    }

    #[test]
    fn boxes_that_touch_overlap() {
        let [a, b, c] =
            [0.0, 1.0, 2.5].map(|x| Aabb::around(&[[x, 0.0, 0.0], [x + 1.0, 1.0, 1.0]]));
        assert_eq!(pairs(&[a, b, c]), [(0, 1)]);
    }

    #[test]
    fn equal_boxes_and_no_boxes() {
        let point = Aabb::around(&[[0.0; 3]]);
        assert_eq!(pairs(&[point; 30]).len(), 30 * 29 / 2);
        assert_eq!(pairs(&[]), []);
    }
}
