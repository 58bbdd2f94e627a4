//! Contacts: what rests on the surface, and so must not lose what it rests on.
//!
//! A chamfer cuts a wedge off along its edge. Behind it the solid stays closed, but game models are
//! put together from open parts that hide each other's holes: where the open border of one part
//! lies on another, the wedge may be all that hid what is behind. So a stretch of border that lies
//! in the wedge of an edge keeps that wedge from being cut off.

mod crowds;
mod wedge;

use std::sync::Arc;

use glam::DVec3;

use crate::bvh::{Aabb, Kin, Rod, Target, Tree};
use crate::error::Error;
use crate::faces::{Faces, faces};
use crate::ids::{Corner, Few, Triangle};
use crate::lines::Lines;
use crate::math::unit;
use crate::memory;
use crate::mesh::Mesh;
use crate::options::{Options, Width};
use crate::threads::Threads;
use crate::tolerance::{BACK_TO_BACK_COSINE, TOUCHING, TOUCHING_STEPS};
use crate::topology::{Topology, topology};
use crate::view::{View, view, wide};
use crate::watch::{Times, Unwatched, Watch, collect, each, sort};
use crate::weld::weld;

use crowds::{Crowds, Search, crowds};
pub use wedge::{Cut, Stretch, Wedge};

/// Of fewer places to look at, boxes tell fast enough which are near.
const MANY: usize = 1024;

/// What lies within so many tolerances of an edge, across it, rests on it.
const HOLD_REACH: f64 = 2.0;

/// What rests on an edge is within so many tolerances of it, its own included.
const HELD: f64 = HOLD_REACH + 1.0;

/// What rests on an edge within so many tolerances of an end alone rests on that end.
const HOLD_SLACK: f64 = 4.0;

/// So many steps it takes to ask what rests on an edge, as a watch counts them.
pub const ASKED: usize = 8;

/// So many edges that follow one another are asked about at once: they lie side by side mostly, and most
/// of what is large has nothing near it.
const TOGETHER: usize = 64;

/// A line that may rest on the mesh.
#[derive(Clone)]
struct Rim {
    ends: [DVec3; 2],
    /// So far around it nothing is cut away; 0 where it only rests.
    radius: f64,
    /// The half-edge that it is, without twin or at the rim of a sheet of two sides; none if it lies
    /// outside of the mesh.
    border: Corner,
}

impl Rim {
    /// Whether it is where a sheet of two sides ends.
    fn is_of_sheet(&self, topology: &Topology) -> bool {
        self.border.is_some() && topology.twin[self.border].is_some()
    }
}

/// All that may rest on a mesh, in a tree: its own open borders, and what the caller told.
pub struct Contacts {
    /// `#rims`, those that are alike next to each other, at one place: thousands of faces may meet at
    /// one edge, and each of them asks what rests on it.
    rims: Vec<Rim>,
    /// Where the rims of each place in the tree begin, and where the last end.
    starts: Arc<[u32]>,
    tree: Arc<Tree>,
    crowds: Crowds,
    lines: Lines,
    /// Whether lines have a say in what is found, beside boxes.
    is_many: bool,
    /// Within this distance, in mesh units, something touches.
    tolerance: f64,
}

/// Gathers what may rest on a mesh.
///
/// # Errors
/// [`Error::OutOfMemory`] where what that needs is not to be had, and [`Error::Cancelled`] where the
/// watch stops it.
pub fn contacts(
    view: &View,
    topology: &Topology,
    faces: &Faces,
    watch: &dyn Watch,
) -> Result<Contacts, Error> {
    let borders = borders(topology, faces, watch)?;
    memory::ask(memory::of_rims(borders.len() + view.mesh.held.len()))?;
    let of_border = |border: Corner| Rim {
        ends: [border, border.next()].map(|corner| view.position_at(corner)),
        radius: 0.0,
        border,
    };
    let outside = view.mesh.held.iter().map(|held| Rim {
        ends: [held.from, held.to].map(wide),
        radius: f64::from(held.radius),
        border: Corner::NONE,
    });
    let mut rims = collect(borders.len(), watch, |place| of_border(borders[place]))?;
    rims.extend(outside);
    watch.worked(view.mesh.held.len())?;
    let (rims, starts) = side_by_side(topology, rims, watch)?;
    watch.worked(rims.len() * ASKED)?;
    let tolerance = if rims.is_empty() { 0.0 } else { tolerance(view) };
    let places = || starts[..starts.len() - 1].iter().map(|&start| &rims[start as usize]);
    let rim_at = |place: usize| &rims[starts[place] as usize];
    let boxes = collect(starts.len() - 1, watch, |place| {
        let rim = rim_at(place);
        around(rim.ends, rim.radius.max(tolerance))
    })?;
    let crowds = crowds(topology, places());
    let reach = view.reach();
    let kin = |rim: &Rim| crowds.kin(rim, rim.is_of_sheet(topology), reach);
    let of_kin = if crowds.is_empty() { 0 } else { boxes.len() };
    let kin: Vec<Kin> = collect(of_kin, watch, |place| kin(rim_at(place)))?;
    watch.worked(rims.len() * ASKED)?;
    let lines = Lines::new(places().map(|rim| rim.ends), reach);
    // Nobody asks for what runs along something outside of the mesh.
    let line = |rim: &Rim| if rim.border.is_some() { lines.around(rim.ends) } else { Aabb::EMPTY };
    let mut tree = Tree::watched(&boxes, &kin, watch)?;
    let is_many = boxes.len() >= MANY;
    if is_many {
        let lines = collect(boxes.len(), watch, |place| line(rim_at(place)))?;
        tree = tree.with_views_watched(&[lines], watch)?;
    }
    let starts = starts.into();
    Ok(Contacts { rims, starts, tree: tree.into(), crowds, lines, is_many, tolerance })
}

/// Rims of the same ends, radius and kind next to each other, and where each such place begins, and
/// where the last ends. Places stand in the order of the first rim of each.
fn side_by_side(
    topology: &Topology,
    rims: Vec<Rim>,
    watch: &dyn Watch,
) -> Result<(Vec<Rim>, Vec<u32>), Error> {
    let key = |rim: &Rim| {
        let ends = rim.ends.map(|end| end.to_array().map(f64::to_bits));
        (ends, rim.radius.to_bits(), rim.border.is_some(), rim.is_of_sheet(topology))
    };
    let mut sorted: Vec<_> = rims.iter().map(key).zip(0u32..).collect();
    watch.worked(rims.len())?;
    sort(&mut sorted, watch)?;
    // Of each place the first rim, and where its rims begin and end.
    let mut end = 0;
    let place = |place: &[(_, u32)]| {
        let start = end;
        end += place.len() as u32;
        [place[0].1, start, end]
    };
    let mut places: Vec<[u32; 3]> =
        sorted.chunk_by(|(one, _), (other, _)| one == other).map(place).collect();
    let order: Vec<u32> = sorted.into_iter().map(|(_, rim)| rim).collect();
    watch.worked(rims.len())?;
    sort(&mut places, watch)?;
    let mut starts = vec![0];
    starts.extend(places.iter().scan(0, |sum, &[_, start, end]| {
        *sum += end - start;
        Some(*sum)
    }));
    let of_place = |&[_, start, end]: &[u32; 3]| &order[start as usize..end as usize];
    let rims = places.iter().flat_map(of_place).map(|&rim| rims[rim as usize].clone()).collect();
    Ok((rims, starts))
}

/// The open borders of a mesh, in mesh units; none of a mesh that breaks a rule.
pub fn border_lines(mesh: &Mesh) -> Vec<[DVec3; 2]> {
    let none = Options { width: Width::Units(0.0), threads: 1, ..Options::default() };
    let Ok(view) = view(mesh, &none) else { return Vec::new() };
    let all = weld(&view.mesh, &Unwatched).and_then(|weld| {
        let topology = topology(&view, &weld, &Unwatched)?;
        let faces = faces(&view, &topology, (&Threads::default(), &Unwatched))?;
        borders(&topology, &faces, &Unwatched)
    });
    let line = |border: Corner| [border, border.next()].map(|corner| view.position_at(corner));
    all.unwrap_or_default().into_iter().map(line).collect()
}

/// The half-edges at which a mesh is open: first those without twin, then where sheets end.
fn borders(topology: &Topology, faces: &Faces, watch: &dyn Watch) -> Result<Vec<Corner>, Error> {
    let beside = beside_hidden(topology);
    let (mut borders, mut rims) = (Vec::new(), Vec::new());
    each(faces.normal.len(), &Times(3, watch), |triangle: Triangle| {
        let normal = faces.normal[triangle];
        for corner in triangle.corners() {
            let twin = topology.twin[corner];
            // Where two faces lie back to back, a sheet of two sides ends, as open as any border.
            let is_rim = || normal.dot(faces.normal[twin.triangle()]) < BACK_TO_BACK_COSINE;
            if twin.is_none() {
                if is_open(topology, &beside, corner) {
                    borders.push(corner);
                }
            } else if corner < twin && is_rim() {
                rims.push(corner);
            }
        }
    })?;
    borders.append(&mut rims);
    Ok(borders)
}

/// Whether a half-edge without twin is open, but for those of hidden faces: these follow what they lie
/// behind, and so do those beside them.
fn is_open(topology: &Topology, beside: &[Corner], corner: Corner) -> bool {
    !topology.is_collapsed(corner.triangle())
        && !topology.is_hidden(corner)
        && beside.binary_search(&corner).is_err()
}

/// The borders, sorted, that run on from those of hidden faces, along the same wall: they go back
/// with it.
fn beside_hidden(topology: &Topology) -> Vec<Corner> {
    let mut beside = Vec::new();
    for hidden in &topology.hidden {
        let (mut onward, mut before) = (hidden.half_edge.next(), hidden.half_edge.prev());
        while topology.twin[onward].is_some() {
            onward = topology.twin[onward].next();
        }
        while topology.twin[before].is_some() {
            before = topology.twin[before].prev();
        }
        beside.extend([onward, before]);
    }
    beside.sort_unstable();
    beside
}

fn tolerance(view: &View) -> f64 {
    // Of the largest meshes single precision cannot tell the extent.
    let extent = view.extent;
    (extent * TOUCHING).max(view.resolution * TOUCHING_STEPS)
}

/// The box around some points, and so far beyond.
fn around(points: [DVec3; 2], reach: f64) -> Aabb {
    let [low, high] = [points[0].min(points[1]) - reach, points[0].max(points[1]) + reach];
    Aabb::around(&[low, high].map(|point| point.as_vec3().to_array()))
}

/// For each so many edges that follow one another, whether something may rest near one of them.
pub struct Near(Vec<bool>);

impl Near {
    /// Whether something may rest near the edge of this number.
    pub fn may_hold(&self, edge: usize) -> bool {
        self.0.get(edge / TOGETHER).is_some_and(|&is_near| is_near)
    }
}

impl Contacts {
    /// The same with other names for the half-edges of the mesh, where these have not moved.
    pub fn renamed(&self, name: impl Fn(Corner) -> Corner) -> Contacts {
        let mut rims = self.rims.clone();
        let borders = rims.iter_mut().map(|rim| &mut rim.border).filter(|border| border.is_some());
        borders.for_each(|border| *border = name(*border));
        let (starts, tree) = (self.starts.clone(), self.tree.clone());
        Contacts { rims, starts, tree, crowds: self.crowds.clone(), ..*self }
    }

    /// How many lines may rest on the mesh.
    pub fn len(&self) -> usize {
        self.rims.len()
    }

    pub fn is_empty(&self) -> bool {
        self.rims.is_empty()
    }

    /// Within this distance, in mesh units, something touches.
    pub fn tolerance(&self) -> f64 {
        self.tolerance
    }

    /// Near which edges something may rest, as far as so many of them together tell: within a distance of
    /// each, by [`Contacts::beside`] a width, by [`Contacts::holds`] none.
    ///
    /// # Errors
    /// [`Error::Cancelled`] where the watch stops it.
    pub fn near<Edge>(
        &self,
        edges: &[Edge],
        ends_and_width: impl Fn(&Edge) -> ([DVec3; 2], f64),
        watch: &dyn Watch,
    ) -> Result<Near, Error> {
        let around = |edge: &Edge| {
            let (ends, width) = ends_and_width(edge);
            around(ends, width + self.tolerance * HELD)
        };
        let is_near = |some: &[Edge]| {
            let bounds = some.iter().map(around).fold(Aabb::EMPTY, Aabb::union);
            self.tree.overlapping(bounds).next().is_some()
        };
        if self.rims.is_empty() {
            return Ok(Near(Vec::new()));
        }
        let told = |some: &[Edge]| watch.worked(some.len()).map(|()| is_near(some));
        Ok(Near(edges.chunks(TOGETHER).map(told).collect::<Result<_, _>>()?))
    }

    /// The stretches that lie in the wedge that an edge loses where each of its sides is pulled by so
    /// much. Where one goes no farther than what touches, none is uncovered.
    pub fn beside(
        &self,
        view: &View,
        topology: &Topology,
        faces: &Faces,
        (sides, widths): ([Corner; 2], [f64; 2]),
    ) -> Few<Stretch> {
        let ends = [sides[0], sides[0].next()].map(|corner| view.position_at(corner));
        let [least, most] = [widths[0].min(widths[1]), widths[0].max(widths[1])];
        if least <= self.tolerance || self.beside_edge(ends, most + self.tolerance).next().is_none()
        {
            return Few::new();
        }
        let wedge = Wedge::new(view, faces, sides);
        let stretches = wedge.map(|wedge| self.in_wedge(topology, sides[0], &wedge, widths));
        stretches.unwrap_or_default()
    }

    /// Whether something rests on an edge, elsewhere than at its ends alone.
    pub fn holds(&self, view: &View, topology: &Topology, faces: &Faces, side: Corner) -> bool {
        let ends = [side, side.next()].map(|corner| view.position_at(corner));
        if self.beside_edge(ends, self.tolerance * HELD).next().is_none() {
            return false;
        }
        let is_ball = |rim: &Rim| {
            rim.radius > self.tolerance && distance_between(rim.ends, ends) < rim.radius
        };
        if self.beside_edge(ends, 0.0).any(|rims| is_ball(&rims[0])) {
            return true;
        }
        let Some(wedge) = Wedge::new(view, faces, [side, topology.twin[side]]) else {
            return false;
        };
        let reach = self.tolerance * HOLD_REACH;
        let stretches = self.in_wedge(topology, side, &wedge, [reach; 2]);
        stretches.iter().any(|stretch| wedge.is_inside_ends(stretch, self.tolerance * HOLD_SLACK))
    }

    /// Whether something other than the borders of a corner's own position runs through it.
    pub fn touch_corner(&self, view: &View, topology: &Topology, corner: Corner) -> bool {
        let (at, cluster) = ([view.position_at(corner); 2], topology.cluster_at[corner]);
        self.places(Search::Through(at[0])).any(|rims| {
            let rim = &rims[0];
            let is_own = rim.border.is_some()
                && [rim.border, rim.border.next()]
                    .iter()
                    .any(|&c| topology.cluster_at[c] == cluster);
            !is_own && distance_between(rim.ends, at) < rim.radius.max(self.tolerance)
        })
    }

    /// The half-edges of the mesh that are rims.
    pub fn borders(&self) -> impl Iterator<Item = Corner> {
        self.rims.iter().map(|rim| rim.border).filter(|border| border.is_some())
    }

    /// Those of them that may run along a border, all at one place together.
    pub fn borders_along<'a>(
        &'a self,
        border: [DVec3; 2],
    ) -> impl Iterator<Item = impl Iterator<Item = Corner> + 'a> {
        let borders = |rims: &'a [Rim]| rims.iter().map(|rim| rim.border);
        let all = self.places(Search::Along(border)).map(borders);
        all.map(|borders| borders.filter(|border| border.is_some()))
    }

    /// What may come within a distance of an edge, but for the sheets that are its own.
    fn beside_edge(&self, ends: [DVec3; 2], reach: f64) -> impl Iterator<Item = &[Rim]> {
        self.places(Search::Beside(ends, reach))
    }

    /// What may be looked for. All rims at one place come together: what does not depend on the fan
    /// that a rim ends is to be asked of the first alone.
    fn places(&self, search: Search) -> impl Iterator<Item = &[Rim]> {
        let ([from, to], reach) = search.segment();
        let is_line = matches!(search, Search::Along(_));
        let is_long = self.is_many && from != to;
        let rod = is_long.then(|| Rod::new(from, unit(to - from), reach + self.tolerance));
        let line = if is_line && self.is_many { self.lines.around([from, to]) } else { Aabb::ALL };
        let found = self.tree.near(Target {
            bounds: around([from, to], reach),
            views: [line],
            rod,
            is_out: self.crowds.apart(search, self.tolerance),
        });
        found.map(|place| {
            let [from, to] = [0, 1].map(|k| self.starts[place as usize + k] as usize);
            &self.rims[from..to]
        })
    }

    /// The stretches of border that lie in the wedge that is cut off along an edge where its sides are
    /// pulled by `widths`.
    fn in_wedge(
        &self,
        topology: &Topology,
        side: Corner,
        wedge: &Wedge,
        widths: [f64; 2],
    ) -> Few<Stretch> {
        let is_own = |rim: &Rim| rim.border.is_some() && is_own_border(topology, side, rim.border);
        let reach = widths[0].max(widths[1]) + self.tolerance;
        let across = wedge.corners(widths, self.tolerance);
        self.places(Search::Within(wedge.ends(), reach, across))
            .filter_map(|rims| {
                let stretch = wedge.clip(rims[0].ends, widths, self.tolerance)?;
                // Sheets at one place are all its own or none. Of the others a few are at most, so
                // one that is not is soon met.
                let asked = if rims[0].is_of_sheet(topology) { &rims[..1] } else { rims };
                (!asked.iter().all(is_own)).then_some(stretch)
            })
            .collect()
    }
}

/// The distance between two segments.
fn distance_between(one: [DVec3; 2], other: [DVec3; 2]) -> f64 {
    let (along_one, along_other) = (one[1] - one[0], other[1] - other[0]);
    let between = one[0] - other[0];
    let (a, b, c) =
        (along_one.length_squared(), along_one.dot(along_other), along_other.length_squared());
    let (d, e) = (along_one.dot(between), along_other.dot(between));
    let share =
        |above: f64, below: f64| if below > 0.0 { (above / below).clamp(0.0, 1.0) } else { 0.0 };
    // Where both lines come nearest, kept within one segment, and from there to the other.
    let on_one = share(b * e - c * d, a * c - b * b);
    let on_other = share(b * on_one + e, c);
    let on_one = share(b * on_other - d, a);
    (between + along_one * on_one - along_other * on_other).length()
}

/// Whether a border belongs to one of the fans around the ends of an edge: it is where that fan
/// ends, and moves with it.
fn is_own_border(topology: &Topology, side: Corner, border: Corner) -> bool {
    let is_sheet = topology.twin[border].is_some();
    let ends = [side, side.next()].map(|corner| topology.cluster_at[corner]);
    let border_ends = [border, border.next()].map(|corner| topology.cluster_at[corner]);
    let meets = |end: usize| border_ends.contains(&ends[end]);
    let is_own = |from: Corner| is_sheet || is_around(topology, from, border);
    (meets(0) && is_own(side)) || (meets(1) && is_own(topology.twin[side]))
}

/// Whether a border is met when one turns around the start of a half-edge, either way.
fn is_around(topology: &Topology, half_edge: Corner, border: Corner) -> bool {
    let mut onward = half_edge;
    // Out of the fan's last corner, its border runs into the cluster.
    let arrives = loop {
        let before = onward.prev();
        if topology.twin[before].is_none() {
            break before;
        }
        onward = topology.twin[before];
        if onward == half_edge {
            return false;
        }
    };
    let mut leaves = half_edge;
    while topology.twin[leaves].is_some() {
        leaves = topology.twin[leaves].next();
    }
    border == arrives || border == leaves
}

#[cfg(test)]
mod tests;
