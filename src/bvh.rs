//! Trees of boxes over boxes (bounding-volume hierarchies), in flat arrays.
//!
//! Each node halves its boxes at the median of their middles along the longest axis. The build is
//! the same on every run: equal middles are told apart by number. A tree and what its boxes are
//! right now are two things, so that boxes can change without a tree being built anew.

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
    #[inline]
    pub fn around(points: &[[f32; 3]]) -> Aabb {
        points.iter().fold(Aabb::EMPTY, |sum, &point| sum.union(Aabb { low: point, high: point }))
    }

    #[inline]
    pub fn union(self, other: Aabb) -> Aabb {
        // All numbers are finite: a plain comparison is one instruction, `min` is several.
        let least = |a: f32, b: f32| if a < b { a } else { b };
        let most = |a: f32, b: f32| if a > b { a } else { b };
        Aabb {
            low: [0, 1, 2].map(|axis| least(self.low[axis], other.low[axis])),
            high: [0, 1, 2].map(|axis| most(self.high[axis], other.high[axis])),
        }
    }

    #[inline]
    pub fn overlaps(&self, other: &Aabb) -> bool {
        let along = |k: usize| (self.low[k] <= other.high[k]) & (other.low[k] <= self.high[k]);
        along(0) & along(1) & along(2)
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

    /// The number of what it has in common with others; past all others for nothing.
    pub fn crowd(&self) -> u32 {
        self.around.unwrap_or(u32::MAX)
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

#[derive(Clone, Copy)]
struct Node {
    /// The node after this one and all below it.
    next: u32,
    /// The first of its places in the order of the tree.
    first: u32,
    /// How many places it has itself: none but in a leaf.
    count: u32,
}

/// Trees over groups of boxes, one after the other.
pub(crate) struct Forest {
    nodes: Vec<Node>,
    /// `#places`: the numbers of the boxes, tree by tree and leaf by leaf.
    order: Vec<u32>,
    /// `#trees + 1`: where the nodes and the places of each begin.
    starts: Vec<[u32; 2]>,
}

impl Forest {
    /// A tree over each group. `order` has the numbers of the boxes, group by group; `ends:
    /// #groups` tells where each group ends there. Boxes of different crowds (`crowd_of: #boxes`,
    /// if there are any) are kept apart in a tree, so that its nodes have kin too.
    pub fn new(
        mut order: Vec<u32>,
        ends: &[u32],
        boxes: &[Aabb],
        crowd_of: Option<&[u32]>,
    ) -> Forest {
        let build = Build { boxes, crowd_of };
        let mut nodes = Vec::with_capacity(order.len());
        let mut starts = vec![[0; 2]];
        let mut from = 0;
        for &end in ends {
            let root = nodes.len();
            if from < end {
                build.add(&mut nodes, root, &mut order[from as usize..end as usize], 0);
            }
            starts.push([nodes.len() as u32, end]);
            from = end;
        }
        Forest { nodes, order, starts }
    }

    pub fn len(&self) -> usize {
        self.starts.len() - 1
    }

    pub fn tree(&self, number: usize) -> Tree<'_> {
        let [from, to] = [self.starts[number], self.starts[number + 1]];
        let [nodes, order] = [0, 1].map(|k| from[k] as usize..to[k] as usize);
        Tree { nodes: &self.nodes[nodes], order: &self.order[order] }
    }
}

/// One tree: its places and nodes count from 0.
#[derive(Clone, Copy)]
pub(crate) struct Tree<'a> {
    /// Depth first: the children of a node follow it.
    nodes: &'a [Node],
    /// `#places`: the number of the box at each.
    pub order: &'a [u32],
}

/// What the boxes of a tree are right now.
#[derive(Default)]
pub(crate) struct Bounds {
    /// `#places`.
    pub boxes: Vec<Aabb>,
    /// `#places`: where each lies as seen from what it has in common with others; empty where
    /// there is no crowd.
    pub kin: Vec<Kin>,
    /// `#nodes`: of all that is below.
    node_boxes: Vec<Aabb>,
    node_kin: Vec<Kin>,
}

impl Bounds {
    /// Fits a tree to the boxes at its places, and to their kin if there are crowds.
    pub fn new(tree: Tree, boxes: Vec<Aabb>, kin: Vec<Kin>) -> Bounds {
        let mut bounds = Bounds { boxes, kin, ..Bounds::default() };
        tree.fit(&mut bounds);
        bounds
    }

    /// Whether two boxes have no point in common, or are told apart by their kin.
    #[inline]
    pub fn are_apart(&self, a: usize, b: usize) -> bool {
        !self.boxes[a].overlaps(&self.boxes[b])
            || (!self.kin.is_empty() && self.kin[a].is_apart(&self.kin[b]))
    }

    #[inline]
    fn nodes_are_apart(&self, a: usize, b: usize) -> bool {
        !self.node_boxes[a].overlaps(&self.node_boxes[b])
            || (!self.node_kin.is_empty() && self.node_kin[a].is_apart(&self.node_kin[b]))
    }
}

impl Tree<'_> {
    /// Fits all nodes to the boxes and the kin at the places.
    pub fn fit(self, bounds: &mut Bounds) {
        bounds.node_boxes.clear();
        bounds.node_boxes.resize(self.nodes.len(), Aabb::EMPTY);
        bounds.node_kin.clear();
        if !bounds.kin.is_empty() {
            bounds.node_kin.resize(self.nodes.len(), Kin::NONE);
        }
        // Children follow their node, so from behind they are known first.
        for node in (0..self.nodes.len()).rev() {
            self.fit_node(bounds, node);
        }
    }

    /// As [`Tree::fit`], where only some places changed; in ascending order.
    pub fn refit(self, bounds: &mut Bounds, changed: &[u32]) {
        if !changed.is_empty() {
            self.refit_below(bounds, 0, changed);
        }
    }

    fn refit_below(self, bounds: &mut Bounds, node: usize, changed: &[u32]) {
        if self.nodes[node].count == 0 {
            let [low, high] = self.children(node);
            let (below, above) =
                changed.split_at(changed.partition_point(|&place| place < self.nodes[high].first));
            for (child, changed) in [(low, below), (high, above)] {
                if !changed.is_empty() {
                    self.refit_below(bounds, child, changed);
                }
            }
        }
        self.fit_node(bounds, node);
    }

    fn children(self, node: usize) -> [usize; 2] {
        [node + 1, self.nodes[node + 1].next as usize]
    }

    /// Fits a node to what is directly below it.
    fn fit_node(self, bounds: &mut Bounds, node: usize) {
        let Bounds { boxes, kin, node_boxes, node_kin } = bounds;
        if self.nodes[node].count > 0 {
            let own = self.places(node);
            node_boxes[node] =
                boxes[own.clone()].iter().fold(Aabb::EMPTY, |all, &each| all.union(each));
            if let Some((first, others)) = kin.get(own).and_then(<[Kin]>::split_first) {
                node_kin[node] = others.iter().fold(*first, |all, &each| all.union(each));
            }
        } else {
            let [low, high] = self.children(node);
            node_boxes[node] = node_boxes[low].union(node_boxes[high]);
            if !node_kin.is_empty() {
                node_kin[node] = node_kin[low].union(node_kin[high]);
            }
        }
    }

    /// The numbers of the leaves.
    pub fn leaves(self) -> impl Iterator<Item = usize> {
        (0..self.nodes.len()).filter(move |&node| self.nodes[node].count > 0)
    }

    /// The places of a leaf.
    pub fn places(self, leaf: usize) -> std::ops::Range<usize> {
        let Node { first, count, .. } = self.nodes[leaf];
        first as usize..(first + count) as usize
    }

    /// The leaves from a node on that may meet a leaf, in the order of the tree.
    pub fn leaves_near(
        self,
        bounds: &Bounds,
        leaf: usize,
        from: usize,
    ) -> impl Iterator<Item = usize> {
        let mut node = from;
        std::iter::from_fn(move || {
            while node < self.nodes.len() {
                let met = node;
                let is_apart = bounds.nodes_are_apart(leaf, met);
                node = if is_apart { self.nodes[met].next as usize } else { met + 1 };
                if !is_apart && self.nodes[met].count > 0 {
                    return Some(met);
                }
            }
            None
        })
    }

    /// The places whose boxes overlap one, in the order of the tree.
    pub fn overlapping(self, bounds: &Bounds, target: Aabb) -> impl Iterator<Item = usize> {
        let mut node = 0;
        std::iter::from_fn(move || {
            while node < self.nodes.len() {
                let met = node;
                let is_apart = !bounds.node_boxes[met].overlaps(&target);
                node = if is_apart { self.nodes[met].next as usize } else { met + 1 };
                if !is_apart && self.nodes[met].count > 0 {
                    return Some(self.places(met));
                }
            }
            None
        })
        .flatten()
        .filter(move |&place| bounds.boxes[place].overlaps(&target))
    }

    /// The pairs of places that are not apart, each once.
    pub fn pairs(self, bounds: &Bounds) -> impl Iterator<Item = (usize, usize)> {
        self.leaves()
            .flat_map(move |leaf| {
                // Only leaves from this one on: those before have met it already.
                self.leaves_near(bounds, leaf, leaf).flat_map(move |other| {
                    let pair = move |a| {
                        let from = if other == leaf { a + 1 } else { self.places(other).start };
                        (from..self.places(other).end).map(move |b| (a, b))
                    };
                    self.places(leaf).flat_map(pair)
                })
            })
            .filter(|&(a, b)| !bounds.are_apart(a, b))
    }
}

struct Build<'a> {
    boxes: &'a [Aabb],
    crowd_of: Option<&'a [u32]>,
}

impl Build<'_> {
    /// Appends the node over `order`, which stands at `first` in its tree, and all below it.
    fn add(&self, nodes: &mut Vec<Node>, root: usize, order: &mut [u32], first: usize) {
        let place = nodes.len();
        let between = self.between_crowds(order);
        let is_leaf = order.len() <= LEAF_SIZE && between.is_none();
        let count = if is_leaf { order.len() as u32 } else { 0 };
        nodes.push(Node { next: 0, first: first as u32, count });
        if !is_leaf {
            let half = between.unwrap_or_else(|| self.halve(order));
            let (low, high) = order.split_at_mut(half);
            self.add(nodes, root, low, first);
            self.add(nodes, root, high, first + half);
        }
        nodes[place].next = (nodes.len() - root) as u32;
    }

    /// Splits at the median along the longest axis.
    fn halve(&self, order: &mut [u32]) -> usize {
        let half = order.len() / 2;
        let bounds =
            order.iter().fold(Aabb::EMPTY, |sum, &number| sum.union(self.boxes[number as usize]));
        let axis = longest_axis(&bounds);
        let middle = |number: u32| self.boxes[number as usize].middle(axis);
        order
            .select_nth_unstable_by(half, |&a, &b| middle(a).total_cmp(&middle(b)).then(a.cmp(&b)));
        half
    }

    /// Where there are several crowds: sorts by them, and splits between two of them, nearest to
    /// the middle.
    fn between_crowds(&self, order: &mut [u32]) -> Option<usize> {
        let crowd_of = |number: u32| self.crowd_of.map(|crowd_of| crowd_of[number as usize]);
        let first = crowd_of(*order.first()?)?;
        if order.iter().all(|&number| crowd_of(number) == Some(first)) {
            return None;
        }
        order.sort_unstable_by_key(|&number| (crowd_of(number), number));
        let is_between = |k: &usize| crowd_of(order[k - 1]) != crowd_of(order[*k]);
        (1..order.len()).filter(is_between).min_by_key(|k| k.abs_diff(order.len() / 2))
    }
}

fn longest_axis(bounds: &Aabb) -> usize {
    let length = |axis: usize| bounds.high[axis] - bounds.low[axis];
    (0..3).fold(0, |longest, axis| if length(axis) > length(longest) { axis } else { longest })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pairs(boxes: &[Aabb]) -> Vec<(u32, u32)> {
        let numbers: Vec<u32> = (0..boxes.len() as u32).collect();
        let forest = Forest::new(numbers, &[boxes.len() as u32], boxes, None);
        let tree = forest.tree(0);
        let boxes = tree.order.iter().map(|&number| boxes[number as usize]).collect();
        let bounds = Bounds::new(tree, boxes, Vec::new());
        let named = |(a, b): (usize, usize)| (tree.order[a], tree.order[b]);
        let mut pairs: Vec<(u32, u32)> =
            tree.pairs(&bounds).map(named).map(|(a, b)| (a.min(b), a.max(b))).collect();
        pairs.sort_unstable();
        pairs
    }

    fn scattered(size: f32) -> Vec<Aabb> {
        let each = |step| {
            let [x, y, z] = [37, 53, 71].map(|stride| (step * stride % 97) as f32);
            Aabb::around(&[[x, y, z], [x + size, y + 1.5 * size, z + size / 2.0]])
        };
        (0..200).map(each).collect()
    }

    #[test]
    fn finds_each_overlapping_pair_once() {
        let boxes = scattered(20.0);
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

    #[test]
    fn refitted_nodes_are_those_of_a_new_fit() {
        let (small, large) = (scattered(5.0), scattered(30.0));
        let forest = Forest::new((0..200).collect(), &[80, 200], &small, None);
        let tree = forest.tree(1);
        let boxes = tree.order.iter().map(|&number| small[number as usize]).collect();
        let mut bounds = Bounds::new(tree, boxes, Vec::new());
        let changed = [3, 50, 51, 119];
        for place in changed {
            bounds.boxes[place as usize] = large[tree.order[place as usize] as usize];
        }
        tree.refit(&mut bounds, &changed);
        let refitted = bounds.node_boxes.clone();
        tree.fit(&mut bounds);
        assert_eq!(refitted, bounds.node_boxes);
    }
}
