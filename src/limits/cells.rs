//! Cells: all triangles of the result, each with the source triangle that it stands on.
//!
//! A cell is a source triangle, the half of each strip along it, and a share of the fills at its
//! corners. So a tree over the source triangles finds the new ones too, and when sectors move only
//! a few boxes change.

use crate::bvh::{Aabb, Bounds, Kin, Tree};
use crate::corners;
use crate::ids::{Corner, Edge, Few, Ring, Sector, Triangle};
use crate::intersect::{self, Around, bounds, cut_each_other};
use crate::placement::Placement;
use crate::plan::Plan;
use crate::strips;

use super::parts::Parts;
use super::{Element, around, fill};

/// The cells of one part, and what of them has to be searched.
pub struct Cells<'a> {
    plan: &'a Plan<'a>,
    parts: &'a Parts,
    part: usize,
    /// `#places + 1`: where the items of each cell begin.
    starts: Vec<u32>,
    items: Vec<Item>,
    /// The boxes of the cells.
    bounds: Bounds,
    /// `#places`: whether something in the cell may cut something that it did not before.
    is_open: Vec<bool>,
    /// `#crowds` of the part: where they gather.
    around: Vec<Around>,
    /// Cells whose items were placed anew.
    touched: Vec<u32>,
}

/// A triangle of the result.
#[derive(Clone, Copy)]
struct Item {
    bounds: Aabb,
    corners: intersect::Triangle,
    element: Element,
    /// Whether it is new or has moved.
    is_changed: bool,
    /// Whether it took part in a cut when that was last looked for.
    is_cut: bool,
}

/// What a cell has no use for now.
const NO_CORNERS: intersect::Triangle = [[0.0; 3]; 3];

impl<'a> Cells<'a> {
    pub fn new(plan: &'a Plan<'a>, parts: &'a Parts) -> Cells<'a> {
        Cells {
            plan,
            parts,
            part: 0,
            starts: Vec::new(),
            items: Vec::new(),
            bounds: Bounds::default(),
            is_open: Vec::new(),
            around: Vec::new(),
            touched: Vec::new(),
        }
    }

    fn tree(&self) -> Tree<'a> {
        self.parts.tree(self.part)
    }

    /// Turns to a part, where its sectors stand now. All that has changed is to be searched.
    pub fn enter(&mut self, part: usize, placement: &Placement) {
        self.part = part;
        self.starts.clear();
        self.items.clear();
        for &triangle in self.tree().order {
            self.starts.push(self.items.len() as u32);
            self.add_items(Triangle(triangle));
        }
        self.starts.push(self.items.len() as u32);
        for place in 0..self.tree().order.len() {
            for item in self.items_at(place) {
                self.place_if_first(placement, Triangle(self.tree().order[place]), item);
            }
        }
        self.touched.clear();
        self.open(|item| item.is_changed);
        self.fit(placement);
    }

    /// Opens the cells that have such an item, and closes all others.
    fn open(&mut self, has: impl Fn(&Item) -> bool) {
        let cells = 0..self.tree().order.len();
        let is_open = cells.map(|cell| self.items[self.items_at(cell)].iter().any(&has));
        self.is_open = is_open.collect();
    }

    fn add_items(&mut self, triangle: Triangle) {
        let (plan, corners) = (self.plan, triangle.corners());
        let mut add = |element| {
            let (bounds, corners) = (Aabb::EMPTY, NO_CORNERS);
            self.items.push(Item { bounds, corners, element, is_changed: false, is_cut: false });
        };
        add(Element::Surface(triangle));
        for edge in corners.map(|corner| plan.edges.chamfered_at[corner]) {
            if edge.is_some() {
                add(Element::Strip(edge));
            }
        }
        for corner in corners {
            let sector = plan.sectors.sector_of[corner];
            if sector.is_some() && plan.sectors.fans[sector].first == corner {
                add(Element::Fill(plan.sectors.fans[sector].ring));
            }
        }
    }

    fn items_at(&self, place: usize) -> std::ops::Range<usize> {
        self.starts[place] as usize..self.starts[place + 1] as usize
    }

    /// Places an item of a cell, with all others of its element, but for the first of these alone.
    fn place_if_first(&mut self, placement: &Placement, triangle: Triangle, item: usize) {
        let element = self.items[item].element;
        let is_first = match element {
            Element::Surface(_) => true,
            Element::Strip(edge) => self.plan.edges.hard[edge].sides[0].triangle() == triangle,
            Element::Fill(ring) => self.holder(self.plan.sectors.ring(ring)[0]) == triangle,
        };
        if is_first {
            self.place(placement, element);
        }
    }

    /// The triangle whose cell has a sector's share of the fill.
    fn holder(&self, sector: Sector) -> Triangle {
        self.plan.sectors.fans[sector].first.triangle()
    }

    fn place(&mut self, placement: &Placement, element: Element) {
        match element {
            Element::Surface(triangle) => self.place_surface(placement, triangle),
            Element::Strip(edge) => self.place_strip(placement, edge),
            Element::Fill(ring) => self.place_fill(placement, ring),
        }
    }

    fn place_surface(&mut self, placement: &Placement, triangle: Triangle) {
        let plan = self.plan;
        let has_moved = |corner: Corner| {
            let sector = plan.sectors.sector_of[corner];
            sector.is_some() && placement.has_moved(plan, sector)
        };
        let corners = triangle.corners().map(|corner| placement.position_at(plan, corner));
        let is_changed = triangle.corners().into_iter().any(has_moved);
        self.set(triangle, Element::Surface(triangle), Some(narrow(corners)), is_changed);
    }

    fn place_strip(&mut self, placement: &Placement, edge: Edge) {
        let hard = &self.plan.edges.hard[edge];
        let quad = strips::quad(self.plan, placement, hard);
        let triangles = strips::cut(&quad).triangles();
        for (k, side) in hard.sides.into_iter().enumerate() {
            let corners = triangles.get(k).map(|corners| corners.map(|place| quad.points[place]));
            self.set(side.triangle(), Element::Strip(edge), corners.map(narrow), corners.is_some());
        }
    }

    fn place_fill(&mut self, placement: &Placement, ring: Ring) {
        let sectors = self.plan.sectors.ring(ring);
        let fill = fill(self.plan, placement, ring).unwrap_or_default();
        let mut points: Few<_> = sectors.iter().map(|&sector| placement.point[sector]).collect();
        let middles: Few<_> =
            fill.middles.iter().map(|places| corners::middle(&points, places)).collect();
        points.extend(middles);
        for (k, &sector) in sectors.iter().enumerate() {
            let corners = fill.triangles.get(k).map(|corners| corners.map(|place| points[place]));
            let is_new = corners.is_some();
            self.set(self.holder(sector), Element::Fill(ring), corners.map(narrow), is_new);
        }
    }

    /// Gives an element's item in the cell of a triangle its corners.
    fn set(
        &mut self,
        triangle: Triangle,
        element: Element,
        corners: Option<intersect::Triangle>,
        is_changed: bool,
    ) {
        let cell = self.parts.place_of(triangle);
        let items = self.items_at(cell);
        if let Some(item) = self.items[items].iter_mut().find(|item| item.element == element) {
            item.corners = corners.unwrap_or(NO_CORNERS);
            item.bounds = bounds(&item.corners);
            item.is_changed = is_changed;
            self.touched.push(cell as u32);
        }
    }

    /// Fits the tree to all cells.
    fn fit(&mut self, placement: &Placement) {
        let count = self.is_open.len();
        self.bounds.boxes.clear();
        self.bounds.boxes.resize(count, Aabb::EMPTY);
        self.bounds.kin.clear();
        self.around.clear();
        if let Some((crowds, _)) = self.parts.crowds(self.part) {
            self.bounds.kin.resize(count, Kin::NONE);
            self.around.extend(crowds.iter().map(|crowd| crowd.around(self.plan, placement)));
        }
        (0..count).for_each(|cell| self.fit_cell(cell));
        self.tree().fit(&mut self.bounds);
    }

    fn fit_cell(&mut self, cell: usize) {
        let items = &self.items[self.items_at(cell)];
        self.bounds.boxes[cell] =
            items.iter().fold(Aabb::EMPTY, |all, item| all.union(item.bounds));
        if let Some((_, of)) = self.parts.crowds(self.part)
            && let Some(around) = self.around.get(of[cell] as usize)
        {
            let items = items.iter().filter(|item| item.bounds != Aabb::EMPTY);
            let seen = items.map(|item| around.seen(&item.corners));
            self.bounds.kin[cell] = Kin::new(of[cell], seen.fold(Aabb::EMPTY, Aabb::union));
        }
    }

    /// Follows sectors that have moved since. What they touch is to be searched again.
    pub fn follow(&mut self, placement: &Placement, moved: &[Sector]) {
        self.touched.clear();
        for element in around(self.plan, moved) {
            self.place(placement, element);
        }
        let mut touched = std::mem::take(&mut self.touched);
        touched.iter().for_each(|&cell| self.is_open[cell as usize] = true);
        touched.extend(self.in_other_crowds(placement));
        touched.sort_unstable();
        touched.dedup();
        touched.iter().for_each(|&cell| self.fit_cell(cell as usize));
        self.tree().refit(&mut self.bounds, &touched);
        self.touched = touched;
    }

    /// The cells in crowds around something that has moved.
    fn in_other_crowds(&mut self, placement: &Placement) -> Vec<u32> {
        let Some((crowds, of)) = self.parts.crowds(self.part) else { return Vec::new() };
        let around = crowds.iter().map(|crowd| crowd.around(self.plan, placement));
        let before = std::mem::replace(&mut self.around, around.collect());
        let is_other = |crowd: u32| {
            let crowd = crowd as usize;
            before.get(crowd) != self.around.get(crowd)
        };
        (0..).zip(of).filter(|(_, crowd)| is_other(**crowd)).map(|(cell, _)| cell).collect()
    }

    /// All elements that take part in a cut; none where the part cut through itself already.
    pub fn new_cuts(&mut self) -> Vec<Element> {
        let mut found: Vec<[usize; 2]> = Vec::new();
        let tree = self.tree();
        let leaf_is_open = |leaf: usize| self.is_open[tree.places(leaf)].contains(&true);
        let all_are_open = tree.leaves().all(leaf_is_open);
        for leaf in tree.leaves().filter(|&leaf| leaf_is_open(leaf)) {
            let from = if all_are_open { leaf } else { 0 };
            for other in tree.leaves_near(&self.bounds, leaf, from) {
                if other >= leaf || !leaf_is_open(other) {
                    self.cuts_between(leaf, other, &mut found);
                }
                if !found.is_empty() && self.parts.was_cut(&self.plan.view, self.part) {
                    return Vec::new();
                }
            }
        }
        self.items.iter_mut().for_each(|item| item.is_cut = false);
        found.as_flattened().iter().for_each(|&item| self.items[item].is_cut = true);
        self.open(|item| item.is_cut);
        self.items.iter().filter(|item| item.is_cut).map(|item| item.element).collect()
    }

    /// Adds the items of two leaves that cut each other.
    fn cuts_between(&self, leaf: usize, other: usize, found: &mut Vec<[usize; 2]>) {
        let tree = self.tree();
        for a in tree.places(leaf) {
            let from = if other == leaf { a } else { tree.places(other).start };
            for b in from..tree.places(other).end {
                if !self.bounds.are_apart(a, b) {
                    self.cuts_of_cells(a, b, found);
                }
            }
        }
    }

    fn cuts_of_cells(&self, a: usize, b: usize, found: &mut Vec<[usize; 2]>) {
        for one in self.items_at(a) {
            let item = &self.items[one];
            if !item.bounds.overlaps(&self.bounds.boxes[b]) {
                continue;
            }
            let others = self.items_at(b);
            for other in others.start.max(if a == b { one + 1 } else { 0 })..others.end {
                let second = &self.items[other];
                if (item.is_changed | second.is_changed)
                    && item.bounds.overlaps(&second.bounds)
                    && cut_each_other(&item.corners, &second.corners)
                {
                    found.push([one, other]);
                }
            }
        }
    }
}

fn narrow(corners: [glam::DVec3; 3]) -> intersect::Triangle {
    corners.map(|point| point.as_vec3().to_array())
}
