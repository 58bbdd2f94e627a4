//! A tree of boxes over boxes (a bounding-volume hierarchy), in flat arrays.
//!
//! The boxes are sorted along a curve through their middles that stays near to where it is (G.
//! Morton, 1966), and each node halves its stretch of the curve. That takes a fraction of the time
//! of looking for the best halves, and finds nearly as few boxes. Equal places on the curve are told
//! apart by number, so the tree is the same on every run.

mod boxes;
mod curve;
mod turned;

use glam::DVec3;
use smallvec::SmallVec;

use crate::error::Error;
use crate::watch::{Unwatched, Watch, collect, stretches};

pub(crate) use boxes::{Aabb, Rod};
use curve::in_order;
use turned::TurnedBox;

/// How many boxes a leaf holds: testing so few one by one costs less than another node.
const LEAF_SIZE: usize = 4;

/// So many nodes and places are looked at before that is told.
const MOST_LOOKS: usize = 1024;

/// Where something lies as seen from what it has in common with others (see `intersect::crowds`).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Kin {
    /// What that is: only things with the same can be told apart.
    around: Option<u64>,
    bounds: Aabb,
}

impl Kin {
    /// Nothing in common with anything.
    pub const NONE: Kin = Kin { around: None, bounds: Aabb::EMPTY };

    pub fn new(around: u64, bounds: Aabb) -> Kin {
        Kin { around: Some(around), bounds }
    }

    /// The number of what it has in common with others; past all others for nothing.
    pub fn crowd(&self) -> u64 {
        self.around.unwrap_or(u64::MAX)
    }

    /// Around the directions in which it lies.
    pub fn bounds(&self) -> &Aabb {
        &self.bounds
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
    /// The first of its places in the order of the tree.
    first: u32,
    /// How many places it has itself: none but in a leaf.
    count: u32,
}

/// What is looked for in a tree.
pub(crate) struct Target<const EYES: usize, IsOut: Fn(&Kin) -> bool> {
    /// Around it.
    pub bounds: Aabb,
    /// Around it as each eye sees it; none where eyes have no say.
    pub views: [Aabb; EYES],
    /// All of it is within that.
    pub rod: Option<Rod>,
    /// Tells the kin that it is not.
    pub is_out: IsOut,
}

/// A tree over some boxes. *Places* count along its order.
#[derive(Default)]
pub(crate) struct Tree {
    /// Depth first: the children of a node follow it.
    nodes: Vec<Node>,
    /// `#nodes`: what all below have in common with others; empty where there is no crowd.
    node_kin: Vec<Kin>,
    /// `#places`: the number of the box at each.
    order: Vec<u32>,
    /// `#places`.
    boxes: Vec<Aabb>,
    /// `#places`, or none.
    kin: Vec<Kin>,
    /// For each eye.
    views: Vec<View>,
    /// `#nodes`, or none.
    turned: Vec<TurnedBox>,
}

/// Boxes around the directions in which all is seen from some eye.
struct View {
    /// `#nodes`.
    nodes: Vec<Aabb>,
    /// `#places`.
    places: Vec<Aabb>,
}

impl Tree {
    /// Over `#boxes`. Boxes of different crowds (`kin: #boxes`, or none) are kept apart, so that
    /// nodes have kin too.
    pub fn new(boxes: &[Aabb], kin: &[Kin]) -> Tree {
        Tree::watched(boxes, kin, &Unwatched).unwrap_or_default()
    }

    /// The same, where that may be stopped.
    ///
    /// # Errors
    /// [`Error::Cancelled`] where the watch stops it.
    pub fn watched(boxes: &[Aabb], kin: &[Kin], watch: &dyn Watch) -> Result<Tree, Error> {
        let order = in_order(boxes, kin, watch)?;
        watch.worked(order.len())?;
        let number = |place: usize| order[place] as usize;
        let of_kin = if kin.is_empty() { 0 } else { order.len() };
        let mut tree = Tree {
            nodes: Vec::with_capacity(boxes.len()),
            boxes: collect(order.len(), watch, |place| boxes[number(place)])?,
            kin: collect(of_kin, watch, |place| kin[number(place)])?,
            node_kin: Vec::new(),
            views: Vec::new(),
            turned: Vec::new(),
            order,
        };
        if !boxes.is_empty() {
            tree.add(0, boxes.len(), watch)?;
        }
        Ok(tree)
    }

    /// The same, where what is seen apart from an eye is apart too (`views: #eyes by #boxes`).
    pub fn with_views(self, views: &[Vec<Aabb>]) -> Tree {
        self.with_views_watched(views, &Unwatched).unwrap_or_default()
    }

    /// The same, where that may be stopped.
    ///
    /// # Errors
    /// [`Error::Cancelled`] where the watch stops it.
    pub fn with_views_watched(
        mut self,
        views: &[Vec<Aabb>],
        watch: &dyn Watch,
    ) -> Result<Tree, Error> {
        let views: Result<_, Error> = views.iter().map(|boxes| self.view(boxes, watch)).collect();
        self.views = views?;
        Ok(self)
    }

    /// The same, where nodes have boxes along axes of their own, too (`triangles: #boxes`).
    ///
    /// # Errors
    /// [`Error::Cancelled`] where the watch stops it.
    pub fn with_turned(
        mut self,
        triangles: &[[[f32; 3]; 3]],
        watch: &dyn Watch,
    ) -> Result<Tree, Error> {
        let around = |node: usize| {
            let wide = |point: [f32; 3]| DVec3::from(point.map(f64::from));
            let own = self.places(node).map(|place| triangles[self.order[place] as usize]);
            let own: SmallVec<[[DVec3; 3]; LEAF_SIZE]> = own.map(|all| all.map(wide)).collect();
            TurnedBox::around(&own)
        };
        let count = self.nodes.len();
        let mut turned = collect(count, watch, |node| match self.nodes[node].count {
            0 => TurnedBox::NONE,
            _ => around(node),
        })?;
        for stretch in stretches(count, watch) {
            // Those below a node come after it.
            for node in stretch?.map(|back| count - 1 - back) {
                if self.nodes[node].count == 0 {
                    let next = self.nodes[node + 1].next as usize;
                    turned[node] = TurnedBox::around_both(&turned[node + 1], &turned[next]);
                }
            }
        }
        self.turned = turned;
        Ok(self)
    }

    fn view(&self, boxes: &[Aabb], watch: &dyn Watch) -> Result<View, Error> {
        let places = collect(self.order.len(), watch, |place| boxes[self.order[place] as usize])?;
        let count = self.nodes.len();
        let mut nodes = vec![Aabb::EMPTY; count];
        for stretch in stretches(count, watch) {
            // Those below a node come after it.
            for node in stretch?.map(|back| count - 1 - back) {
                nodes[node] = match self.nodes[node].count {
                    0 => nodes[node + 1].union(nodes[self.nodes[node + 1].next as usize]),
                    _ => self.places(node).fold(Aabb::EMPTY, |all, place| all.union(places[place])),
                };
            }
        }
        Ok(View { nodes, places })
    }

    /// The number of the box at a place.
    pub fn number(&self, place: usize) -> u32 {
        self.order[place]
    }

    /// Appends the node over some places, and all below it.
    fn add(&mut self, first: usize, count: usize, watch: &dyn Watch) -> Result<(), Error> {
        let node = self.nodes.len();
        let (at, own) = (first as u32, first..first + count);
        let split = self.split(own.clone());
        let count = if split.is_none() { count as u32 } else { 0 };
        self.nodes.push(Node { bounds: Aabb::EMPTY, next: 0, first: at, count });
        if !self.kin.is_empty() {
            self.node_kin.push(Kin::NONE);
        }
        let all = |boxes: &[Aabb]| boxes.iter().fold(Aabb::EMPTY, |all, &each| all.union(each));
        let (bounds, kin) = match split {
            None => {
                watch.worked(own.len())?;
                let kin = self
                    .kin
                    .get(own.clone())
                    .and_then(|kin| kin.iter().copied().reduce(Kin::union));
                (all(&self.boxes[own]), kin)
            }
            Some(middle) => {
                let low = self.nodes.len();
                self.add(own.start, middle - own.start, watch)?;
                let high = self.nodes.len();
                self.add(middle, own.end - middle, watch)?;
                let kin = self.node_kin.get(low).map(|&kin| kin.union(self.node_kin[high]));
                (self.nodes[low].bounds.union(self.nodes[high].bounds), kin)
            }
        };
        self.nodes[node].bounds = bounds;
        self.nodes[node].next = self.nodes.len() as u32;
        if let Some(kin) = kin {
            self.node_kin[node] = kin;
        }
        Ok(())
    }

    /// Where some places are parted; none where they are a leaf. Several crowds are parted between
    /// two of them, as near to the middle as can be.
    fn split(&self, own: std::ops::Range<usize>) -> Option<usize> {
        let middle = own.start + own.len() / 2;
        let crowd = |place: usize| self.kin.get(place).map(Kin::crowd);
        if crowd(own.start) != crowd(own.end - 1) {
            let kin = &self.kin[own.clone()];
            let edge = |is_before: &dyn Fn(u64) -> bool| {
                own.start + kin.partition_point(|kin| is_before(kin.crowd()))
            };
            let here = self.kin[middle].crowd();
            let edges = [edge(&|crowd| crowd < here), edge(&|crowd| crowd <= here)];
            let inside = edges.into_iter().filter(|edge| *edge > own.start && *edge < own.end);
            return inside.min_by_key(|edge| edge.abs_diff(middle));
        }
        (own.len() > LEAF_SIZE).then_some(middle)
    }

    /// The numbers of the leaves.
    fn leaves(&self) -> impl Iterator<Item = usize> {
        (0..self.nodes.len()).filter(move |&node| self.nodes[node].count > 0)
    }

    /// The places of a leaf.
    fn places(&self, leaf: usize) -> std::ops::Range<usize> {
        let Node { first, count, .. } = self.nodes[leaf];
        first as usize..(first + count) as usize
    }

    /// The leaves from a node on that are not apart from something, in the order of the tree.
    fn leaves_near(
        &self,
        from: usize,
        is_apart: impl Fn(usize) -> bool,
    ) -> impl Iterator<Item = usize> {
        let mut node = from;
        std::iter::from_fn(move || {
            while node < self.nodes.len() {
                let met = node;
                let is_apart = is_apart(met);
                node = if is_apart { self.nodes[met].next as usize } else { met + 1 };
                if !is_apart && self.nodes[met].count > 0 {
                    return Some(met);
                }
            }
            None
        })
    }

    /// The numbers of the boxes that overlap one, in the order of the tree.
    pub fn overlapping(&self, target: Aabb) -> impl Iterator<Item = u32> {
        self.near(Target { bounds: target, views: [], rod: None, is_out: |_| false })
    }

    /// The numbers of the boxes that are not apart from what is looked for, in the order of the tree.
    pub fn near<const EYES: usize>(
        &self,
        target: Target<EYES, impl Fn(&Kin) -> bool>,
    ) -> impl Iterator<Item = u32> {
        let Target { bounds, views, rod, is_out } = target;
        let is_near = move |place: usize| {
            let mut seen = self.views.iter().zip(&views);
            self.boxes[place].overlaps(&bounds)
                && seen.all(|(view, target)| view.places[place].overlaps(target))
        };
        let is_apart = move |node: usize| {
            let own = &self.nodes[node].bounds;
            let mut seen = self.views.iter().zip(&views);
            !own.overlaps(&bounds)
                || seen.any(|(view, target)| !view.nodes[node].overlaps(target))
                || match self.node_kin.get(node) {
                    // Directions tell more than the box.
                    Some(kin) if kin.around.is_some() => is_out(kin),
                    _ => rod.is_some_and(|rod| rod.misses(own)),
                }
        };
        self.leaves_near(0, is_apart)
            .flat_map(|leaf| self.places(leaf))
            .filter(move |&place| is_near(place))
            .map(|place| self.order[place])
    }

    /// `#nodes`: in which leaves something is open, as is told of each number.
    ///
    /// # Errors
    /// [`Error::Cancelled`] where the watch stops it.
    pub fn open_leaves(
        &self,
        is_open: impl Fn(u32) -> bool,
        watch: &dyn Watch,
    ) -> Result<Vec<bool>, Error> {
        let holds_open = |node: usize| self.places(node).any(|place| is_open(self.order[place]));
        collect(self.nodes.len(), watch, holds_open)
    }

    /// Calls `pair` for each two places that are not apart, once: those in open leaves (`open: #nodes`)
    /// with all others; and `step` again and again, with how many nodes and places it has looked at.
    ///
    /// # Errors
    /// What either gives, and no more is called.
    pub fn each_pair<E>(
        &self,
        open: &[bool],
        mut step: impl FnMut(usize) -> Result<(), E>,
        mut pair: impl FnMut(usize, usize) -> Result<(), E>,
    ) -> Result<(), E> {
        // Where all are open, those before a leaf have met it already.
        let are_all = self.leaves().all(|leaf| open[leaf]);
        let tells_more = self.tells_more();
        for leaf in self.leaves().filter(|&leaf| open[leaf]) {
            let bounds = self.nodes[leaf].bounds;
            let (mut node, mut looks) = (if are_all { leaf } else { 0 }, 0);
            while let Some(Node { bounds: near, next, count, .. }) = self.nodes.get(node) {
                looks += 1;
                if looks >= MOST_LOOKS {
                    step(std::mem::take(&mut looks))?;
                }
                if !near.overlaps(&bounds) || (tells_more && self.nodes_are_told_apart(leaf, node))
                {
                    node = *next as usize;
                    continue;
                }
                if *count > 0 && (node >= leaf || !open[node]) {
                    looks += self.pairs_between([leaf, node], tells_more, &mut pair)?;
                }
                node += 1;
            }
            step(looks)?;
        }
        Ok(())
    }

    /// The same for the places of two leaves, which may be one; tells how many were looked at.
    #[inline]
    fn pairs_between<E>(
        &self,
        [leaf, other]: [usize; 2],
        tells_more: bool,
        pair: &mut impl FnMut(usize, usize) -> Result<(), E>,
    ) -> Result<usize, E> {
        let (near, others) = (self.nodes[other].bounds, self.places(other));
        let mut looks = 0;
        for a in self.places(leaf) {
            let own = self.boxes[a];
            if !own.overlaps(&near) {
                continue;
            }
            let from = if other == leaf { a + 1 } else { others.start };
            for (bounds, b) in self.boxes[from..others.end].iter().zip(from..) {
                looks += 1;
                if bounds.overlaps(&own) && !(tells_more && self.are_told_apart(a, b)) {
                    pair(a, b)?;
                }
            }
        }
        Ok(looks)
    }

    /// Whether more than boxes along the axes tells what is apart: of most meshes nothing does.
    fn tells_more(&self) -> bool {
        !(self.kin.is_empty() && self.views.is_empty() && self.turned.is_empty())
    }

    /// Whether two places whose boxes overlap are told apart by their kin or an eye.
    fn are_told_apart(&self, a: usize, b: usize) -> bool {
        (!self.kin.is_empty() && self.kin[a].is_apart(&self.kin[b]))
            || self.views.iter().any(|view| !view.places[a].overlaps(&view.places[b]))
    }

    /// The same for nodes, and by their turned boxes.
    fn nodes_are_told_apart(&self, a: usize, b: usize) -> bool {
        (!self.node_kin.is_empty() && self.node_kin[a].is_apart(&self.node_kin[b]))
            || self.views.iter().any(|view| !view.nodes[a].overlaps(&view.nodes[b]))
            || (!self.turned.is_empty() && (self.keeps_off(a, b) || self.keeps_off(b, a)))
    }

    /// Whether the turned box of a node does, whichever box is around the other.
    fn keeps_off(&self, node: usize, other: usize) -> bool {
        self.turned[node].keeps_off(&self.turned[other], &self.nodes[other].bounds)
    }
}

#[cfg(test)]
mod tests {
    use std::cell::Cell;

    use super::*;
    use crate::watch::tests::Count;

    fn pairs(boxes: &[Aabb]) -> Vec<(u32, u32)> {
        all_pairs(&Tree::new(boxes, &[]))
    }

    /// The numbers of all pairs of a tree, the lower one first, sorted.
    fn all_pairs(tree: &Tree) -> Vec<(u32, u32)> {
        open_pairs(tree, |_| true)
    }

    /// The same of those in leaves in which something is open.
    fn open_pairs(tree: &Tree, is_open: impl Fn(u32) -> bool) -> Vec<(u32, u32)> {
        let open = tree.open_leaves(is_open, &Unwatched).unwrap();
        let mut found = Vec::new();
        let pair = |a, b| {
            let (a, b) = (tree.number(a), tree.number(b));
            found.push((a.min(b), a.max(b)));
            Ok::<(), Error>(())
        };
        tree.each_pair(&open, |_| Ok(()), pair).unwrap();
        found.sort_unstable();
        found
    }

    fn scattered(size: f32) -> Vec<Aabb> {
        let each = |step| {
            let [x, y, z] = [37, 53, 71].map(|stride| (step * stride % 97) as f32);
            Aabb::around(&[[x, y, z], [x + size, y + 1.5 * size, z + size / 2.0]])
        };
        (0..200).map(each).collect()
    }

    fn overlapping(boxes: &[Aabb]) -> Vec<(u32, u32)> {
        (0..boxes.len() as u32)
            .flat_map(|a| (a + 1..boxes.len() as u32).map(move |b| (a, b)))
            .filter(|&(a, b)| boxes[a as usize].overlaps(&boxes[b as usize]))
            .collect()
    }

    #[test]
    fn finds_each_overlapping_pair_once() {
        let boxes = scattered(20.0);
        let expected = overlapping(&boxes);
        assert!(expected.len() > 100);
        assert_eq!(pairs(&boxes), expected);
        let target = Aabb::around(&[[30.0; 3], [50.0; 3]]);
        let mut found: Vec<u32> = Tree::new(&boxes, &[]).overlapping(target).collect();
        found.sort_unstable();
        let own = (0..200).filter(|&number| boxes[number as usize].overlaps(&target));
        assert!(found.iter().copied().eq(own) && found.len() > 10);
    }

    #[test]
    fn boxes_that_touch_overlap() {
        let [a, b, c] =
            [0.0, 1.0, 2.5].map(|x| Aabb::around(&[[x, 0.0, 0.0], [x + 1.0, 1.0, 1.0]]));
        assert_eq!(pairs(&[a, b, c]), [(0, 1)]);
    }

    #[test]
    fn building_a_large_tree_can_be_stopped_at_any_time() {
        let boxes = scattered(20.0).repeat(400);
        let told = |last: usize| {
            let count = Count { told: Cell::new(0), last };
            let tree = Tree::watched(&boxes, &[], &count);
            (tree.is_ok(), count.told.get())
        };
        let (is_done, all) = told(usize::MAX);
        // Sorted in eight parts, and told at each leaf.
        assert!(is_done && all > 15 + boxes.len() / LEAF_SIZE, "{all}");
        for last in [1, 5, 15, 16, all / 2, all] {
            assert_eq!(told(last), (false, last));
        }
    }

    #[test]
    fn equal_boxes_and_no_boxes() {
        let point = Aabb::around(&[[0.0; 3]]);
        assert_eq!(pairs(&[point; 30]).len(), 30 * 29 / 2);
        assert_eq!(pairs(&[]), []);
        assert_eq!(pairs(&[Aabb::EMPTY, point, Aabb::EMPTY, point]), [(1, 3)]);
    }

    #[test]
    fn boxes_as_large_as_numbers_go_are_found() {
        let most = f32::MAX;
        let boxes =
            [[[-most; 3], [most; 3]], [[0.0; 3]; 2]].map(|ends| Aabb::around(&ends)).repeat(4);
        assert_eq!(pairs(&boxes).len(), 8 * 7 / 2);
    }

    #[test]
    fn crowds_stand_side_by_side_and_what_is_seen_apart_is_no_pair() {
        let boxes = scattered(60.0);
        // Three crowds and some without; all of a crowd but neighbours lie in different directions.
        let kin: Vec<Kin> = (0..200)
            .map(|number| match number % 4 {
                3 => Kin::NONE,
                crowd => Kin::new(crowd, Aabb::around(&[[number as f32; 3]])),
            })
            .collect();
        let tree = Tree::new(&boxes, &kin);
        let found = all_pairs(&tree);
        let mut expected = overlapping(&boxes);
        expected.retain(|&(a, b)| !kin[a as usize].is_apart(&kin[b as usize]));
        assert_eq!(found, expected);
        assert!(expected.len() > 1000 && expected.len() < overlapping(&boxes).len());
    }

    /// Places near to each other as pairs, but from one box.
    fn found(tree: &Tree, rod: Option<Rod>, seen: Aabb) -> Vec<u32> {
        let target = Target { bounds: Aabb::ALL, views: [seen], rod, is_out: |_: &Kin| false };
        let mut found: Vec<u32> = tree.near(target).collect();
        found.sort_unstable();
        found
    }

    #[test]
    fn what_an_eye_sees_elsewhere_is_not_found() {
        let boxes = scattered(20.0);
        let seen: Vec<Aabb> = (0..200).map(|n| Aabb::around(&[[n as f32; 3]])).collect();
        let tree = Tree::new(&boxes, &[]).with_views(&[seen]);
        let expected: Vec<u32> = (70..=73).collect();
        assert_eq!(found(&tree, None, Aabb::around(&[[70.0; 3], [73.0; 3]])), expected);
    }

    #[test]
    fn around_a_line_are_all_that_come_near_to_it_and_few_more() {
        let boxes = scattered(2.0);
        let (from, along) = (DVec3::new(5.0, 90.0, 20.0), DVec3::new(0.6, -0.64, 0.48));
        let tree = Tree::new(&boxes, &[]);
        let rod = |far| found(&tree, Some(Rod::new(from, along, far)), Aabb::ALL);
        // The corners of a box are within the half of its diagonal, of 2.7, of its middle.
        let nearer = |far: f64| {
            let is_near = |each: &Aabb| {
                let (middle, _) = each.middle_and_half();
                (middle - from).cross(along).length() < far
            };
            (0..200).filter(|&n| is_near(&boxes[n as usize])).collect::<Vec<u32>>()
        };
        assert!(nearer(10.0).len() > 5 && nearer(10.0).iter().all(|n| rod(10.0).contains(n)));
        assert!(rod(10.0).len() < 100, "{} of 200", rod(10.0).len());
    }

    #[test]
    fn what_is_seen_apart_from_one_eye_is_no_pair() {
        let boxes = scattered(60.0);
        // From the one eye each sees its next two, from the other its next.
        let row =
            |far: f32| (0..200).map(move |n| Aabb::around(&[[n as f32; 3], [n as f32 + far; 3]]));
        let views = [row(2.0).collect(), row(1.0).collect::<Vec<_>>()];
        let tree = Tree::new(&boxes, &[]).with_views(&views);
        let found = all_pairs(&tree);
        let mut expected = overlapping(&boxes);
        expected.retain(|(a, b)| b - a == 1);
        assert_eq!(found, expected);
        assert!(expected.len() > 10);
    }

    #[test]
    fn open_leaves_meet_all_others_once() {
        let boxes = scattered(20.0);
        let tree = Tree::new(&boxes, &[]);
        let is_open = |number: u32| number % 23 == 5;
        let mut found = open_pairs(&tree, is_open);
        found.retain(|&(a, b)| is_open(a) || is_open(b));
        let mut expected = overlapping(&boxes);
        expected.retain(|&(a, b)| is_open(a) || is_open(b));
        assert_eq!(found, expected);
        assert!(expected.len() > 10);
    }
}
