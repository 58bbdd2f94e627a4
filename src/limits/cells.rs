//! Cells: all triangles of the result, in the trees of their parts.
//!
//! When sectors move, only the boxes of what they touch change, and only that is searched again.

use crate::bvh::{Aabb, Bounds, Kin, Tree};
use crate::corners;
use crate::ids::{Corner, Few, Sector};
use crate::intersect::{self, Around, bounds, cut_each_other};
use crate::placement::Placement;
use crate::plan::Plan;
use crate::strips;

use super::parts::{Cell, Parts, is_crowded};
use super::{Element, around, fill};

/// The cells of one part, and which of them have to be searched.
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
    gatherings: Gatherings,
    /// Cells whose items were placed anew.
    touched: Vec<u32>,
}

/// A triangle of the result.
#[derive(Clone, Copy)]
struct Item {
    bounds: Aabb,
    corners: intersect::Triangle,
    /// Whether it is new or has moved.
    is_changed: bool,
    /// Whether it took part in a cut when that was last looked for.
    is_cut: bool,
}

impl Item {
    /// What a cell has no use for now.
    const NONE: Item =
        Item { bounds: Aabb::EMPTY, corners: [[0.0; 3]; 3], is_changed: false, is_cut: false };

    fn new(corners: [glam::DVec3; 3], is_changed: bool) -> Item {
        let corners = corners.map(|point| point.as_vec3().to_array());
        Item { bounds: bounds(&corners), corners, is_changed, is_cut: false }
    }
}

/// Where the crowds of a part gather.
#[derive(Default)]
struct Gatherings {
    /// The numbers of the crowds.
    crowds: Vec<u32>,
    /// `#crowds`: from where their cells lie in different directions.
    around: Vec<Around>,
    /// `#places`: the place of the cell's crowd among these; past all for none. Empty where there
    /// is no crowd.
    of_place: Vec<u32>,
}

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
            gatherings: Gatherings::default(),
            touched: Vec::new(),
        }
    }

    fn tree(&self) -> Tree<'a> {
        self.parts.tree(self.part)
    }

    /// Turns to a part, where its sectors stand now. All that has changed is to be searched.
    pub fn enter(&mut self, part: usize, placement: &Placement) {
        self.part = part;
        let cells = || self.tree().order.iter().map(|&number| self.parts.cell(number));
        let mut end = 0;
        let ends = cells().map(|cell| {
            end += most_items(self.plan, cell);
            end
        });
        let starts = std::iter::once(0).chain(ends).collect();
        self.starts = starts;
        self.items.clear();
        self.items.resize(end as usize, Item::NONE);
        for &number in self.tree().order {
            match self.parts.cell(number) {
                Cell::Surface(triangle) => self.place(placement, Element::Surface(triangle)),
                Cell::Strip(edge) => self.place(placement, Element::Strip(edge)),
                Cell::Fill(ring) => self.place(placement, Element::Fill(ring)),
                Cell::Share(sector) => {
                    let ring = self.plan.sectors.fans[sector].ring;
                    if self.plan.sectors.ring(ring)[0] == sector {
                        self.place(placement, Element::Fill(ring));
                    }
                }
            }
        }
        self.touched.clear();
        self.open(|item| item.is_changed);
        self.gather(placement);
        self.fit();
    }

    /// Opens the cells that have such an item, and closes all others.
    fn open(&mut self, has: impl Fn(&Item) -> bool) {
        let cells = 0..self.tree().order.len();
        let is_open = cells.map(|cell| self.items[self.items_at(cell)].iter().any(&has));
        self.is_open = is_open.collect();
    }

    fn items_at(&self, place: usize) -> std::ops::Range<usize> {
        self.starts[place] as usize..self.starts[place + 1] as usize
    }

    /// Places the triangles of an element where the sectors stand now.
    fn place(&mut self, placement: &Placement, element: Element) {
        let plan = self.plan;
        match element {
            Element::Surface(triangle) => {
                let has_moved = |corner: Corner| {
                    let sector = plan.sectors.sector_of[corner];
                    sector.is_some() && placement.has_moved(plan, sector)
                };
                let corners = triangle.corners();
                let points = corners.map(|corner| placement.position_at(plan, corner));
                let item = Item::new(points, corners.into_iter().any(has_moved));
                self.set(Cell::Surface(triangle), std::iter::once(item));
            }
            Element::Strip(edge) => {
                let quad = strips::quad(plan, placement, &plan.edges.hard[edge]);
                let triangles = strips::cut(&quad).triangles().iter();
                let points = triangles.map(|corners| corners.map(|place| quad.points[place]));
                self.set(Cell::Strip(edge), points.map(|points| Item::new(points, true)));
            }
            Element::Fill(ring) => {
                let sectors = plan.sectors.ring(ring);
                let items = fill_items(plan, placement, ring).into_iter();
                if is_crowded(sectors) {
                    let mut items = items;
                    for &sector in sectors {
                        self.set(Cell::Share(sector), items.next().into_iter());
                    }
                } else if sectors.len() >= 3 {
                    self.set(Cell::Fill(ring), items);
                }
            }
        }
    }

    /// Gives a cell its items.
    fn set(&mut self, cell: Cell, mut items: impl Iterator<Item = Item>) {
        let place = self.parts.place_of(cell);
        let own = self.items_at(place);
        self.items[own].iter_mut().for_each(|item| *item = items.next().unwrap_or(Item::NONE));
        self.touched.push(place as u32);
    }

    /// Finds the crowds of the part, which stand side by side in its tree, and where they gather.
    fn gather(&mut self, placement: &Placement) {
        self.gatherings = Gatherings::default();
        let Some(all) = self.parts.crowds() else { return };
        let Gatherings { crowds, of_place, .. } = &mut self.gatherings;
        for &number in self.parts.tree(self.part).order {
            let crowd = all.of_cell[number as usize];
            if crowd != u32::MAX && crowds.last() != Some(&crowd) {
                crowds.push(crowd);
            }
            of_place.push(if crowd == u32::MAX { crowd } else { crowds.len() as u32 - 1 });
        }
        if crowds.is_empty() {
            of_place.clear();
        }
        self.gatherings.around = self.around_now(placement);
    }

    fn around_now(&self, placement: &Placement) -> Vec<Around> {
        let Some(all) = self.parts.crowds() else { return Vec::new() };
        let around = |&crowd: &u32| all.crowds[crowd as usize].around(self.plan, placement);
        self.gatherings.crowds.iter().map(around).collect()
    }

    /// Fits the tree to all cells.
    fn fit(&mut self) {
        let count = self.is_open.len();
        self.bounds.boxes.clear();
        self.bounds.boxes.resize(count, Aabb::EMPTY);
        self.bounds.kin.clear();
        self.bounds.kin.resize(self.gatherings.of_place.len(), Kin::NONE);
        (0..count).for_each(|cell| self.fit_cell(cell));
        self.tree().fit(&mut self.bounds);
    }

    fn fit_cell(&mut self, cell: usize) {
        let items = &self.items[self.items_at(cell)];
        self.bounds.boxes[cell] =
            items.iter().fold(Aabb::EMPTY, |all, item| all.union(item.bounds));
        let Some(&crowd) = self.gatherings.of_place.get(cell) else { return };
        if let Some(around) = self.gatherings.around.get(crowd as usize) {
            let items = items.iter().filter(|item| item.bounds != Aabb::EMPTY);
            let seen = items.map(|item| around.seen(&item.corners));
            self.bounds.kin[cell] = Kin::new(crowd, seen.fold(Aabb::EMPTY, Aabb::union));
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
        touched.extend(self.in_moved_crowds(placement));
        touched.sort_unstable();
        touched.dedup();
        touched.iter().for_each(|&cell| self.fit_cell(cell as usize));
        self.tree().refit(&mut self.bounds, &touched);
        self.touched = touched;
    }

    /// The cells of crowds around something that has moved.
    fn in_moved_crowds(&mut self, placement: &Placement) -> Vec<u32> {
        let around = self.around_now(placement);
        let before = std::mem::replace(&mut self.gatherings.around, around);
        let has_moved = |crowd: u32| {
            let [before, now] = [&before, &self.gatherings.around].map(|v| v.get(crowd as usize));
            before != now
        };
        let of_place = (0..).zip(&self.gatherings.of_place);
        of_place.filter(|(_, crowd)| has_moved(**crowd)).map(|(place, _)| place).collect()
    }

    /// All elements that take part in a cut; none where the part cut through itself already.
    pub fn new_cuts(&mut self) -> Vec<Element> {
        let Some(found) = self.cuts() else { return Vec::new() };
        self.items.iter_mut().for_each(|item| item.is_cut = false);
        found.as_flattened().iter().for_each(|&item| self.items[item as usize].is_cut = true);
        self.open(|item| item.is_cut);
        let open = (0..self.is_open.len()).filter(|&place| self.is_open[place]);
        open.map(|place| self.element(place)).collect()
    }

    fn element(&self, place: usize) -> Element {
        match self.parts.cell(self.tree().order[place]) {
            Cell::Surface(triangle) => Element::Surface(triangle),
            Cell::Strip(edge) => Element::Strip(edge),
            Cell::Fill(ring) => Element::Fill(ring),
            Cell::Share(sector) => Element::Fill(self.plan.sectors.fans[sector].ring),
        }
    }

    /// The pairs of items that cut each other, by open cells; none where the part cut through
    /// itself already.
    fn cuts(&self) -> Option<Vec<[u32; 2]>> {
        let mut found = Vec::new();
        let tree = self.tree();
        let is_open = |leaf: usize| self.is_open[tree.places(leaf)].contains(&true);
        let all_are_open = tree.leaves().all(is_open);
        for leaf in tree.leaves().filter(|&leaf| is_open(leaf)) {
            let from = if all_are_open { leaf } else { 0 };
            for other in tree.leaves_near(&self.bounds, leaf, from) {
                if other >= leaf || !is_open(other) {
                    self.add_cuts_between(leaf, other, &mut found);
                }
            }
            if !found.is_empty() && self.parts.was_cut(self.plan, self.part) {
                return None;
            }
        }
        Some(found)
    }

    /// Adds the items of two leaves that cut each other.
    fn add_cuts_between(&self, leaf: usize, other: usize, found: &mut Vec<[u32; 2]>) {
        let tree = self.tree();
        for a in tree.places(leaf) {
            let from = if other == leaf { a } else { tree.places(other).start };
            for b in from..tree.places(other).end {
                if !self.bounds.are_apart(a, b) {
                    self.add_cuts_of_cells(a, b, found);
                }
            }
        }
    }

    fn add_cuts_of_cells(&self, a: usize, b: usize, found: &mut Vec<[u32; 2]>) {
        for one in self.items_at(a) {
            let item = &self.items[one];
            let others = self.items_at(b);
            for other in others.start.max(if a == b { one + 1 } else { 0 })..others.end {
                let second = &self.items[other];
                if (item.is_changed | second.is_changed)
                    && item.bounds.overlaps(&second.bounds)
                    && cut_each_other(&item.corners, &second.corners)
                {
                    found.push([one as u32, other as u32]);
                }
            }
        }
    }
}

/// How many triangles a cell can have.
fn most_items(plan: &Plan, cell: Cell) -> u32 {
    match cell {
        Cell::Surface(_) | Cell::Share(_) => 1,
        Cell::Strip(_) => 2,
        Cell::Fill(ring) => plan.sectors.ring(ring).len() as u32,
    }
}

fn fill_items(plan: &Plan, placement: &Placement, ring: crate::ids::Ring) -> Few<Item> {
    let sectors = plan.sectors.ring(ring);
    let fill = fill(plan, placement, ring).unwrap_or_default();
    let mut points: Few<_> = sectors.iter().map(|&sector| placement.point[sector]).collect();
    let middles: Few<_> =
        fill.middles.iter().map(|places| corners::middle(&points, places)).collect();
    points.extend(middles);
    let item = |corners: &[usize; 3]| Item::new(corners.map(|place| points[place]), true);
    fill.triangles.iter().map(item).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ids::{Id, IdVec};
    use crate::mesh::MeshBuffers;
    use crate::plan::tests::plan_of;
    use crate::shapes;

    /// What cuts, by comparing each with each.
    fn each_with_each(cells: &Cells) -> Vec<[u32; 2]> {
        let pairs = (0..cells.items.len()).flat_map(|a| (0..a).map(move |b| [b, a]));
        let cut = |&[a, b]: &[usize; 2]| {
            let [one, other] = [a, b].map(|item| &cells.items[item]);
            (one.is_changed || other.is_changed) && cut_each_other(&one.corners, &other.corners)
        };
        pairs.filter(cut).map(|pair| pair.map(|item| item as u32)).collect()
    }

    fn found(cells: &Cells) -> Vec<[u32; 2]> {
        let mut found = cells.cuts().expect("the source does not cut itself");
        found.iter_mut().for_each(|pair| pair.sort_unstable());
        found.sort_unstable_by_key(|&[a, b]| [b, a]);
        found
    }

    /// Places every sector at its full width, whether there is room or not, and then brings some
    /// back; tells how many pairs cut before and after.
    fn follow(mesh: &MeshBuffers, width: f32) -> [usize; 2] {
        let plan = plan_of(mesh, width);
        let sectors = plan.sectors.fans.len();
        let mut placement = Placement::at(&plan, &IdVec::filled(1.0, sectors));
        let mut cells = Cells::new(&plan, plan.parts());
        assert_eq!(plan.parts().len(), 1);
        cells.enter(0, &placement);
        let before = found(&cells);
        assert_eq!(before, each_with_each(&cells));
        cells.new_cuts();
        let back: Vec<Sector> = (0..sectors).step_by(3).map(Sector::new).collect();
        back.iter().for_each(|&sector| placement.set(&plan, sector, 0.25));
        cells.follow(&placement, &back);
        let after = found(&cells);
        assert_eq!(after, each_with_each(&cells));
        [before.len(), after.len()]
    }

    #[test]
    fn all_cuts_are_found_and_followed() {
        for (mesh, width) in [(shapes::plate(), 0.6), (shapes::l_shape(), 0.7)] {
            let [before, after] = follow(&mesh, width);
            assert!(before > 0 && after > 0 && before != after, "{before} and {after}");
        }
    }

    #[test]
    fn all_cuts_in_crowds_are_found_and_followed() {
        let [before, after] = follow(&shapes::pyramid(60), 0.3);
        assert!(before > 0 && after > 0 && before != after, "{before} and {after}");
    }

    #[test]
    fn where_there_is_room_nothing_cuts() {
        assert_eq!(follow(&shapes::plain_cube(1.0), 0.1), [0; 2]);
    }
}
