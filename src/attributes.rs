//! Attributes: every stream, re-sampled at the vertices that moved.
//!
//! A vertex whose corners lie in several sectors that part becomes several (thesis 6.2); the first
//! keeps the index, the others are appended. A flat face keeps its normal to the bit, a curved one
//! the shading that it had at that place.
//!
//! Collapsed triangles: two of their corners stand at one position, so they are but a line.
//!
//! They stay lines: their corners go with the first real triangle on that line, all of them with
//! the same one, so that nothing opens and no edge gets crowded that was not.
//!
//! Index: the vertices of the result by where they came from, and so by where they can be equal.
//!
//! Vertices of two charts become equal when both are copied to one place in a third. What is equal
//! stands at one place, so there is a list of the vertices that came from each cluster, or several
//! by where they stand now: the tip of a huge cone has as many as it has sides.

mod rows;
mod streams;

use std::collections::BTreeMap;

use crate::breaks::same_chart;
use crate::chamfers::Chamfers;
use crate::error::Error;
use crate::ids::{Cluster, Corner, Id, IdVec, Sector, Triangle, Vertex};
use crate::placement::Placement;
use crate::report::Blend;
use crate::resample::{blended_normal, parts};
use crate::scale::Space;
use crate::sectors::Sectors;
use crate::surface::Surface;
use crate::threads::Threads;
use crate::topology::Topology;
use crate::view::View;
use crate::watch::{Watch, each};
use crate::weld::{Weld, hash_of};

pub use rows::Taken;
use rows::{Layout, Row};
use streams::Columns;
pub use streams::Streams;

/// The vertices of the result, as far as source triangles use them.
pub struct Attributes {
    /// The vertex streams; source vertices first.
    pub streams: Streams,
    /// `#corners`: the output vertex of each source corner.
    pub vertex_at: IdVec<Corner, u32>,
}

/// # Errors
/// [`Error::Cancelled`] where the watch stops it.
pub fn attributes(
    space: Space,
    surface: Surface,
    weld: &Weld,
    chamfers: Chamfers,
    placement: &Placement,
    (threads, watch): (&Threads, &dyn Watch),
) -> Result<Attributes, Error> {
    let vertex_at = surface.view.mesh.indices.to_vec();
    watch.worked(vertex_at.len())?;
    let sectors = chamfers.sectors;
    let count = sectors.fans.len();
    let has_moved = threads.map(
        count,
        watch,
        #[inline(always)]
        |sector| placement.has_moved(sector),
    )?;
    let vertices = surface.view.mesh.positions.len();
    // At a seam both far vertices of a strip are copied.
    let copies = 2 * chamfers.edges.hard.iter().filter(|edge| edge.seams != 0).count();
    let mut moving = Moving {
        taken: staying(surface, sectors, &has_moved, watch)?,
        movers: IdVec::filled(Corner::NONE, vertices),
        parted: Vec::new(),
        vertex_at: IdVec::from_vec(vertex_at),
    };
    watch.worked(vertices)?;
    let layout = Layout::new(space.source);
    let take = |moving: &mut Moving, notes: &mut Notes| moving.take(surface, sectors, notes);
    threads.blocks_then(
        (count, watch),
        &mut moving,
        #[inline(always)]
        |_: &Moving, sector: Sector, notes: &mut Notes| {
            if has_moved[sector] {
                notes.add((space, surface), (sectors, sector), placement, &layout);
            }
        },
        take,
    )?;
    let Moving { movers, parted, mut vertex_at, .. } = moving;
    let mut all = Columns::with_room(&space.source.mesh, count, copies);
    threads.gather(
        (vertices, watch),
        &mut all,
        #[inline(always)]
        |vertex: Vertex, columns: &mut Columns| {
            let (source, mover) = ((space.source, &layout), movers[vertex]);
            match mover.is_none() {
                true => columns.push_kept(source, vertex),
                false => add_moved(source, (surface.view, sectors), (placement, mover), columns),
            }
        },
        Columns::append,
    )?;
    let mut streams = Streams::new(all, layout);
    streams.look_up(weld, copies);
    add_parted((space, surface), placement, &parted, (&mut streams, &mut vertex_at), watch)?;
    if surface.topology.has_collapsed && has_moved.iter().any(|&has_moved| has_moved) {
        close_collapsed(surface.view, surface.topology, &mut vertex_at);
    }
    Ok(Attributes { streams, vertex_at })
}

/// `#vertices`: whether some corner stays where it was, and so needs the source vertex.
fn staying(
    surface: Surface,
    sectors: &Sectors,
    has_moved: &IdVec<Sector, bool>,
    watch: &dyn Watch,
) -> Result<IdVec<Vertex, bool>, Error> {
    let mut taken = IdVec::filled(false, surface.view.mesh.positions.len());
    each(sectors.sector_of.len(), watch, |corner: Corner| {
        let sector = sectors.sector_of[corner];
        // Corners of collapsed triangles follow whatever else uses their vertex.
        let stays = sector.is_none() || !has_moved[sector];
        if stays && !surface.topology.is_collapsed(corner.triangle()) {
            taken[surface.view.vertex_at(corner)] = true;
        }
    })?;
    Ok(taken)
}

/// A corner whose vertex another sector has taken, and its own sector.
type Parted = (Sector, Corner);

/// What is known while sectors move.
struct Moving {
    /// `#vertices`: whether some sector has a source vertex already.
    taken: IdVec<Vertex, bool>,
    /// `#vertices`: a corner of the sector that moves a source vertex; none where it stays.
    movers: IdVec<Vertex, Corner>,
    parted: Vec<Parted>,
    /// As in the [`Attributes`].
    vertex_at: IdVec<Corner, u32>,
}

impl Moving {
    /// Gives each vertex that moves its new place: in its own index if that is free; else it is parted, and
    /// past the source vertices its number among those parted stands for it.
    fn take(&mut self, surface: Surface, sectors: &Sectors, notes: &mut Notes) {
        for place in 0..notes.moved.len() {
            let own = &notes.moved[place];
            if own.twin == NONE && !self.taken[own.vertex] {
                self.taken[own.vertex] = true;
                self.movers[own.vertex] = own.corner;
                continue;
            }
            let twin = notes.moved.get(own.twin as usize);
            let output = twin.map_or_else(|| self.part(own), |twin| twin.output);
            if own.is_alone {
                let corners = sectors.corners(surface.topology, own.sector);
                corners.for_each(|corner| self.vertex_at[corner] = output);
            }
            notes.moved[place].output = output;
        }
        for &(corner, moved) in &notes.corners {
            self.vertex_at[corner] = notes.moved[moved as usize].output;
        }
        notes.moved.clear();
        notes.corners.clear();
    }

    /// Parts a vertex, and tells what stands for it.
    fn part(&mut self, own: &Moved) -> u32 {
        self.parted.push((own.sector, own.corner));
        (self.taken.len() + self.parted.len() - 1) as u32
    }
}

/// Where the vertices of some sectors go.
#[derive(Default)]
struct Notes {
    moved: Vec<Moved>,
    /// The corners of the sectors with several vertices, each with the place of its own among those.
    corners: Vec<(Corner, u32)>,
    /// For each vertex of the last of these sectors, its values where it moves.
    rows: Vec<Row>,
}

/// A source vertex of a sector.
struct Moved {
    sector: Sector,
    /// The first of the sector that has the vertex.
    corner: Corner,
    vertex: Vertex,
    /// Which of the [`parts`] of the sector it is of.
    part: u32,
    /// Whether all corners of the sector have it, in one part.
    is_alone: bool,
    /// The place of one that it has become equal to, or none.
    twin: u32,
    /// What stands for it in the result, once that is known.
    output: u32,
}

impl Notes {
    fn add(
        &mut self,
        (space, surface): (Space, Surface),
        (sectors, sector): (&Sectors, Sector),
        placement: &Placement,
        layout: &Layout,
    ) {
        let moved = |corner: Corner, part: u32, is_alone: bool| {
            let vertex = surface.view.vertex_at(corner);
            Moved { sector, corner, vertex, part, is_alone, twin: NONE, output: vertex.0 }
        };
        if placement.offset(sector).is_plain {
            return self.moved.push(moved(sectors.fans[sector].first, 0, true));
        }
        let first = self.moved.len();
        for (corner, part) in parts(surface, sectors, sector) {
            let vertex = surface.view.vertex_at(corner);
            let is_own = |moved: &Moved| moved.vertex == vertex && moved.part == part;
            let known = self.moved[first..].iter().position(is_own);
            let place = known.map_or(self.moved.len(), |known| first + known);
            self.corners.push((corner, place as u32));
            if known.is_none() {
                self.moved.push(moved(corner, part, false));
            }
        }
        if self.moved.len() - first > 1 {
            self.find_twins((space, surface), placement, layout, first);
        }
    }

    /// Tells which vertices of a sector, noted from the first place on, have become equal.
    fn find_twins(
        &mut self,
        (space, surface): (Space, Surface),
        placement: &Placement,
        layout: &Layout,
        first: usize,
    ) {
        let moved = &self.moved[first..];
        self.rows.clear();
        self.rows.resize(moved.len(), Row::EMPTY);
        for (row, moved) in self.rows.iter_mut().zip(moved) {
            let blends = blends(surface.view, placement, moved.sector, moved.corner);
            fill(space, placement, layout, (moved.sector, blends), row);
        }
        for own in 1..moved.len() {
            let twin = self.twin_of(space.source, layout, (first, own));
            self.moved[first + own].twin = twin.map_or(NONE, |twin| (first + twin) as u32);
        }
    }

    /// Which of the vertices of a sector before one that has become equal to, though they differed before:
    /// their normals were less than a degree apart. Or which is that very vertex, in another part.
    fn twin_of(&self, view: &View, layout: &Layout, (first, own): (usize, usize)) -> Option<usize> {
        let vertex = |place: usize| self.moved[first + place].vertex;
        let own_vertex = vertex(own);
        let is_twin = |place: &usize| {
            let other = vertex(*place);
            layout.are_equal(&self.rows[*place], &self.rows[own])
                && (other == own_vertex
                    || view.normal(other) != view.normal(own_vertex)
                    || !same_chart(view, other, own_vertex))
        };
        (0..own).find(is_twin)
    }
}

/// Adds a source vertex where a corner moves it.
#[inline(always)]
fn add_moved(
    source: (&View, &Layout),
    (view, sectors): (&View, &Sectors),
    (placement, mover): (&Placement, Corner),
    columns: &mut Columns,
) {
    let sector = sectors.sector_of[mover];
    let position = placement.stored(sector).as_vec3().to_array();
    match is_one(view, placement, sector, mover) {
        true => columns.push_moved(source, position, blend(view, placement, sector)),
        false => {
            let blends = blends(view, placement, sector, mover);
            columns.push_moved_apart(source, position, blends);
        }
    }
}

/// Appends the vertices that were parted, and puts them in the place of their numbers.
fn add_parted(
    (space, surface): (Space, Surface),
    placement: &Placement,
    parted: &[Parted],
    (streams, vertex_at): (&mut Streams, &mut IdVec<Corner, u32>),
    watch: &dyn Watch,
) -> Result<(), Error> {
    if parted.is_empty() {
        return Ok(());
    }
    let mut added = Vec::with_capacity(parted.len());
    let mut row = Row::EMPTY;
    for &(sector, corner) in parted {
        let blends = blends(surface.view, placement, sector, corner);
        fill(space, placement, &streams.layout, (sector, blends), &mut row);
        added.push(streams.add_moved(surface.topology.cluster_at[corner], &row, blends));
        watch.worked(1)?;
    }
    let sources = surface.view.mesh.positions.len() as u32;
    for vertex in vertex_at.iter_mut().filter(|vertex| **vertex >= sources) {
        *vertex = added[(*vertex - sources) as usize];
    }
    Ok(())
}

/// Fills a row with the values of a corner's vertex where its sector stands: the normal of the surface
/// there, and all else of its chart.
fn fill(
    space: Space,
    placement: &Placement,
    layout: &Layout,
    (sector, (surface, chart)): (Sector, Blends),
    row: &mut Row,
) {
    let normal = blended_normal(space.source, &surface);
    let place = (placement.stored(sector), normal);
    layout.blend(space.source, place, &chart.unwrap_or(surface), row);
}

/// Where a vertex comes from on the surface, and in its chart, if that is something else.
type Blends = (Blend, Option<Blend>);

/// Whether all that a corner's vertex is comes from one blend: that of its sector.
#[inline]
fn is_one(view: &View, placement: &Placement, sector: Sector, corner: Corner) -> bool {
    let offset = placement.offset(sector);
    let [own, first] = [corner, offset.foot.corner].map(|at| view.vertex_at(at));
    offset.is_plain && (own == first || offset.foot.start != [0.0, 0.0])
}

/// That blend.
#[inline]
fn blend(view: &View, placement: &Placement, sector: Sector) -> Blend {
    placement.offset(sector).foot.blend(view, placement.share[sector])
}

/// Where a corner's vertex comes from when its sector takes a share of the offset.
fn blends(view: &View, placement: &Placement, sector: Sector, corner: Corner) -> Blends {
    let (share, offset) = (placement.share[sector], placement.offset(sector));
    let feet = if offset.is_plain {
        [offset.foot; 2]
    } else {
        [placement.surface_foot(sector, corner), placement.chart_foot(sector, corner)]
    };
    let [surface, mut chart] = feet.map(|foot| foot.blend(view, share));
    // Where the way begins at the vertex itself, that is the one to begin with.
    if feet[1].start == [0.0, 0.0] {
        chart.vertices[0] = view.vertex_at(corner).0;
    }
    (surface, (chart != surface).then_some(chart))
}

/// Moves the corners of collapsed triangles along.
fn close_collapsed(view: &View, topology: &Topology, vertex_at: &mut IdVec<Corner, u32>) {
    let is_collapsed = |triangle: &Triangle| topology.is_collapsed(*triangle);
    let collapsed: Vec<Triangle> = view.triangles().filter(is_collapsed).collect();
    if collapsed.is_empty() {
        return;
    }
    let first_on = first_half_edges(view, topology, &collapsed);
    for triangle in collapsed {
        let corners = triangle.corners();
        let line = line_of(topology, triangle);
        for corner in corners {
            let at = topology.cluster_at[corner];
            let own = corners.into_iter().find(|&other| topology.cluster_at[other] == at);
            let carrier = first_on.get(&line).copied().flatten().map(|half_edge| {
                let starts_here = topology.cluster_at[half_edge] == at;
                if starts_here { half_edge } else { half_edge.next() }
            });
            vertex_at[corner] = vertex_at[carrier.or(own).unwrap_or(corner)];
        }
    }
}

/// The two clusters that a collapsed triangle spans, lower first; one twice if it is a point.
fn line_of(topology: &Topology, triangle: Triangle) -> [Cluster; 2] {
    let clusters = triangle.corners().map(|corner| topology.cluster_at[corner]);
    [clusters.into_iter().min(), clusters.into_iter().max()].map(|c| c.unwrap_or(Cluster::NONE))
}

/// For each line of a collapsed triangle, the first half-edge of a real triangle there.
fn first_half_edges(
    view: &View,
    topology: &Topology,
    collapsed: &[Triangle],
) -> BTreeMap<[Cluster; 2], Option<Corner>> {
    let mut first: BTreeMap<[Cluster; 2], Option<Corner>> =
        collapsed.iter().map(|&triangle| (line_of(topology, triangle), None)).collect();
    // Most half-edges do not start where one of these lines ends.
    let mut is_end = IdVec::filled(false, topology.clusters);
    first.keys().flatten().for_each(|&cluster| is_end[cluster] = true);
    let real = view.triangles().filter(|&triangle| !topology.is_collapsed(triangle));
    for half_edge in real.flat_map(Triangle::corners) {
        let ends = [half_edge, half_edge.next()].map(|corner| topology.cluster_at[corner]);
        if !ends.iter().all(|&cluster| is_end[cluster]) {
            continue;
        }
        if let Some(found) = first.get_mut(&[ends[0].min(ends[1]), ends[0].max(ends[1])]) {
            found.get_or_insert(half_edge);
        }
    }
    first
}

/// The end of a list.
const NONE: u32 = u32::MAX;

/// A cluster with this many vertices for each of its lists gets more lists.
const LONG: u32 = 16;

/// The output vertices of each cluster.
#[derive(Default)]
pub struct Index {
    /// `#clusters + 1`: the first list of each, and the end. Nothing where each has one.
    lists_of: IdVec<Cluster, u32>,
    /// `#lists`: the vertex that each begins with.
    first: Vec<u32>,
    /// `#output vertices`: the one that follows in the list.
    next: Vec<u32>,
}

impl Index {
    /// Lists the source vertices, where they stand now, with room for some more.
    pub fn of_source(weld: &Weld, positions: &[[f32; 3]], room: usize) -> Index {
        let lists_of = lists_of(weld);
        let lists = lists_of.iter().last().map_or(weld.first_vertex.len(), |&end| end as usize);
        let mut next = Vec::with_capacity(weld.cluster_of.len() + room);
        next.resize(weld.cluster_of.len(), NONE);
        let mut index = Index { lists_of, first: vec![NONE; lists], next };
        // From the last to the first: each list begins with its first vertex.
        for vertex in weld.cluster_of.ids().rev() {
            let list = index.list_at(weld.cluster_of[vertex], positions[vertex.index()]);
            index.next[vertex.index()] = std::mem::replace(&mut index.first[list], vertex.0);
        }
        index
    }

    /// The list of a cluster for what stands at a position.
    #[inline]
    pub fn list_at(&self, cluster: Cluster, position: [f32; 3]) -> usize {
        if self.lists_of.len() == 0 {
            return cluster.index();
        }
        let [start, end] = [cluster, Cluster(cluster.0 + 1)].map(|cluster| self.lists_of[cluster]);
        match end - start {
            1 => start as usize,
            lists => start as usize + ((hash_of(position) >> 32) as usize & (lists as usize - 1)),
        }
    }

    /// A vertex of a list that is such.
    #[inline]
    pub fn find(&self, list: usize, is_such: impl Fn(u32) -> bool) -> Option<u32> {
        let mut listed = self.first[list];
        while listed != NONE && !is_such(listed) {
            listed = self.next[listed as usize];
        }
        (listed != NONE).then_some(listed)
    }

    /// The same, of those that were added since there were so many vertices: they come first.
    #[inline]
    pub fn find_since(
        &self,
        first: usize,
        list: usize,
        is_such: impl Fn(u32) -> bool,
    ) -> Option<u32> {
        let is_over = |listed: u32| (listed as usize) < first;
        self.find(list, |listed| is_over(listed) || is_such(listed)).filter(|&at| !is_over(at))
    }

    /// Leaves the next new vertex out of all lists, and tells its number.
    pub fn skip(&mut self) -> u32 {
        self.next.push(NONE);
        self.next.len() as u32 - 1
    }

    /// Puts the next new vertex at the head of a list, and tells its number.
    #[inline]
    pub fn add(&mut self, list: usize) -> u32 {
        let vertex = self.next.len() as u32;
        self.next.push(std::mem::replace(&mut self.first[list], vertex));
        vertex
    }
}

/// `#clusters + 1`: a power of two of lists for each. Nothing where none has so many vertices that it needs
/// more than one.
fn lists_of(weld: &Weld) -> IdVec<Cluster, u32> {
    let mut lists_of = IdVec::filled(0, weld.first_vertex.len() + 1);
    for cluster in weld.cluster_of.iter() {
        lists_of[*cluster] += 1;
    }
    if lists_of.iter().all(|&vertices| vertices < 2 * LONG) {
        return IdVec::default();
    }
    let mut end = 0;
    for lists in lists_of.iter_mut() {
        let vertices = std::mem::replace(lists, end);
        end += (vertices / LONG).next_power_of_two();
    }
    lists_of
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::MeshBuffers;
    use crate::shapes;
    use crate::stages::stages_of;

    fn attributes_of(mesh: &MeshBuffers, width: f32) -> Attributes {
        let stages = stages_of(mesh, width);
        stages.attributes(&stages.placement())
    }

    #[test]
    fn a_vertex_of_one_sector_keeps_its_index() {
        let cube = shapes::cube(1.0);
        let result = attributes_of(&cube, 0.1);
        assert_eq!(result.streams.vertices.positions.len(), 24);
        assert!(result.vertex_at.iter().eq(&cube.indices));
    }

    #[test]
    fn a_vertex_of_two_sectors_becomes_two() {
        let cubes = shapes::extruding_cubes();
        let result = attributes_of(&cubes, 0.1);
        let sources = result.streams.vertices.positions.len();
        assert_eq!(sources, cubes.positions.len() + 3, "three vertices are corner-connected");
    }

    #[test]
    fn each_stream_is_read_at_the_new_place() {
        let cube = shapes::cube(1.0);
        let moved = attributes_of(&cube, 0.1).streams.vertices;
        for (old, new) in cube.uvs[0].values.iter().zip(&moved.uvs[0].values) {
            // A tenth of a side is as much of its square in the atlas: 0.3 wide, 0.45 high.
            let step = (old - new).abs();
            assert!((step - 0.03).abs() < 1e-6 || (step - 0.045).abs() < 1e-6, "{step}");
        }
        assert_eq!(moved.tangents, cube.tangents);
    }

    #[test]
    fn colours_stay_between_those_around() {
        let table = shapes::table();
        let moved = attributes_of(&table, 0.01).streams.vertices;
        for (color, [_, y, _]) in moved.colors.iter().zip(&moved.positions) {
            assert!((color[0] - (0.3 + 0.6 * y)).abs() < 1e-5, "{color:?} at {y}");
        }
    }
}
