//! Blocks: a large mesh of many parts, some whole parts at a time.
//!
//! What the stages make of a block stays in the caches from one to the next, and blocks are shared out
//! among threads. Parts that come near each other stay together, so all that one may do to another
//! is seen. Which parts make a block depends on the mesh alone, so the result is the same for any
//! number of threads.
//!
//! Afterwards the results of all blocks are joined to the result of the mesh.
//!
//! Source vertices and triangles go back to where they were; what is new follows, block by block.

use crate::bvh::{Aabb, Tree};
use crate::edges::may_be_hard;
use crate::error::Error;
use crate::groups::Groups;
use crate::ids::{Cluster, Id, IdVec, Triangle, Vertex};
use crate::memory;
use crate::mesh::{MeshBuffers, Uv, UvBuffer};
use crate::report::{Chamfered, EdgeVerdict, Piece, TriangleKind, TriangleSource, VertexSources};
use crate::threads::Threads;
use crate::view::View;
use crate::watch::{Watch, each};
use crate::weld::Weld;

/// Meshes of fewer triangles are done at once: threads within the stages do for these.
const LEAST_TRIANGLES: usize = 32_768;

/// A block has at least so many triangles: what a stage makes of them, some hundred bytes each, fits
/// into the second cache.
const BLOCK_TRIANGLES: u32 = 2048;

/// Where one block has more than this share of all triangles, threads do better within the stages.
const LARGEST_SHARE: f64 = 0.25;

/// Parts that come nearer than so many of the largest widths stay together: what rests on another
/// touches it, and what it keeps from being cut away reaches no farther than a width.
const NEAR_WIDTHS: f64 = 4.0;

/// With more pairs of near parts than this for each part, looking for them would take longer than
/// blocks save.
const MOST_PAIRS: usize = 32;

/// So many results are put together at a time, and their memory is given back.
const JOINED_AT_ONCE: usize = 16;

/// Which elements of a mesh each block has: none twice, and all of them.
pub struct Blocks {
    /// Of each block in ascending order.
    triangles: Shares<Triangle>,
    /// Of each block in ascending order.
    vertices: Shares<Vertex>,
    /// `#vertices`: the number of each in its block.
    place: IdVec<Vertex, u32>,
}

impl Blocks {
    /// How many there are.
    pub fn len(&self) -> usize {
        self.triangles.len()
    }
}

/// Some elements of one kind, block by block.
struct Shares<I> {
    /// `#blocks + 1`: where those of each begin, and the end.
    starts: Vec<u32>,
    all: Vec<I>,
}

impl<I: Id> Shares<I> {
    /// Of so many elements and blocks, by the block of each.
    fn new(count: usize, blocks: usize, block_of: impl Fn(I) -> u32) -> Shares<I> {
        let mut starts = vec![0; blocks + 2];
        let ids = || (0..count).map(I::new);
        ids().for_each(|id| starts[block_of(id) as usize + 2] += 1);
        for block in 2..starts.len() {
            starts[block] += starts[block - 1];
        }
        let mut all = vec![I::new(0); count];
        for id in ids() {
            let end = &mut starts[block_of(id) as usize + 1];
            all[*end as usize] = id;
            *end += 1;
        }
        starts.pop();
        Shares { starts, all }
    }

    fn of(&self, block: usize) -> &[I] {
        &self.all[self.starts[block] as usize..self.starts[block + 1] as usize]
    }

    fn len(&self) -> usize {
        self.starts.len() - 1
    }
}

/// The blocks of a mesh that is large enough and falls into many parts; none else.
///
/// # Errors
/// [`Error::OutOfMemory`] where what that needs is not to be had, and [`Error::Cancelled`] where the
/// watch stops it.
pub fn blocks(view: &View, weld: &Weld, watch: &dyn Watch) -> Result<Option<Blocks>, Error> {
    let (mesh, triangles) = (&view.mesh, view.corner_count() / 3);
    let is_plain = mesh.held.is_empty() && mesh.factors.vertices.is_empty();
    if triangles < LEAST_TRIANGLES || !is_plain || !mesh.factors.edges.is_empty() {
        return Ok(None);
    }
    memory::ask(memory::of_blocks(mesh))?;
    if may_be_hard(view, weld) { parted(view, weld, watch) } else { Ok(None) }
}

/// The same, whatever the size of the mesh.
fn parted(view: &View, weld: &Weld, watch: &dyn Watch) -> Result<Option<Blocks>, Error> {
    let triangles = view.corner_count() / 3;
    let parts = parts(view, weld, watch)?;
    let Some(part_of) = together(view, weld, parts, watch)? else { return Ok(None) };
    let mut sizes = IdVec::<Cluster, u32>::filled(0, part_of.len());
    view.triangles().for_each(|triangle| sizes[part_of[cluster_of(view, weld, triangle)]] += 1);
    // A part has the number of its first cluster, so those that follow each other are near.
    let (mut block_at, mut count, mut own) = (IdVec::filled(0, part_of.len()), 0, 0);
    for part in part_of.ids().filter(|&part| part_of[part] == part) {
        if own >= BLOCK_TRIANGLES {
            (count, own) = (count + 1, 0);
        }
        block_at[part] = count;
        own += sizes[part];
        if f64::from(own) > LARGEST_SHARE * triangles as f64 {
            return Ok(None);
        }
    }
    watch.worked(triangles)?;
    Ok(Some(shared_out(view, weld, count as usize + 1, |cluster| block_at[part_of[cluster]])))
}

/// That of the first corner of a triangle: the others are of the same part.
fn cluster_of(view: &View, weld: &Weld, triangle: Triangle) -> Cluster {
    weld.cluster_of[view.vertex_at(triangle.corners()[0])]
}

/// The triangles and vertices of so many blocks, by the block of each cluster.
fn shared_out(
    view: &View,
    weld: &Weld,
    blocks: usize,
    block_of: impl Fn(Cluster) -> u32,
) -> Blocks {
    let vertices = Shares::new(weld.cluster_of.len(), blocks, |v| block_of(weld.cluster_of[v]));
    let mut place = IdVec::filled(0, weld.cluster_of.len());
    for block in 0..blocks {
        vertices.of(block).iter().zip(0..).for_each(|(&vertex, own)| place[vertex] = own);
    }
    let count = view.corner_count() / 3;
    let triangles = Shares::new(count, blocks, |t| block_of(cluster_of(view, weld, t)));
    Blocks { triangles, vertices, place }
}

/// `#clusters`: the first cluster of the part that each belongs to. Triangles that have a position
/// in common are of one part.
fn parts(view: &View, weld: &Weld, watch: &dyn Watch) -> Result<Groups, Error> {
    let mut parts = Groups::singles(weld.first_vertex.len());
    each(view.corner_count() / 3, watch, |triangle: Triangle| {
        let [a, b, c] = triangle.corners().map(|corner| weld.cluster_of[view.vertex_at(corner)].0);
        parts.join(a, b);
        parts.join(a, c);
    })?;
    Ok(parts)
}

/// The same, where parts that come near each other are one; none if too many do.
fn together(
    view: &View,
    weld: &Weld,
    parts: Groups,
    watch: &dyn Watch,
) -> Result<Option<IdVec<Cluster, Cluster>>, Error> {
    let part_of = parts.labels();
    let mut number_of = vec![0; part_of.len()];
    let (mut first, mut boxes): (Vec<u32>, Vec<Aabb>) = Default::default();
    for (cluster, &part) in part_of.iter().enumerate() {
        if part as usize == cluster {
            number_of[cluster] = first.len();
            first.push(part);
            boxes.push(Aabb::EMPTY);
        }
        let at = view.mesh.positions[weld.first_vertex[Cluster::new(cluster)].index()];
        let own = &mut boxes[number_of[part as usize]];
        *own = own.union(Aabb::around(&[at]));
    }
    let widest = view.mesh.factors.submeshes.iter().fold(1.0_f32, |most, &factor| most.max(factor));
    let reach = NEAR_WIDTHS * view.width * f64::from(widest);
    let boxes: Vec<Aabb> = boxes.iter().map(|own| own.grown(reach as f32)).collect();
    let tree = Tree::watched(&boxes, &[], watch)?;
    let mut near = Groups::singles(boxes.len());
    let all = tree.open_leaves(|_| true, watch)?;
    for (count, (one, other)) in tree.pairs(&all).enumerate() {
        if count > MOST_PAIRS * boxes.len() {
            return Ok(None);
        }
        watch.worked(1)?;
        near.join(tree.number(one), tree.number(other));
    }
    let near = near.labels();
    let together = |&part: &u32| Cluster(first[near[number_of[part as usize]] as usize]);
    Ok(Some(IdVec::from_vec(part_of.iter().map(together).collect())))
}

/// A block of a mesh, with all submeshes that the mesh has.
pub fn cut(view: &View, blocks: &Blocks, block: usize) -> MeshBuffers {
    let (mesh, vertices) = (&view.mesh, blocks.vertices.of(block));
    let uv = |uv: &Uv| UvBuffer {
        components: uv.components,
        values: values_of(uv.values, uv.components as usize, vertices),
    };
    let triangles = blocks.triangles.of(block);
    let corners = triangles.iter().flat_map(|triangle| triangle.corners());
    let counts = triangle_counts(view, blocks, block).into_iter();
    MeshBuffers {
        positions: of(mesh.positions, vertices),
        normals: of(mesh.normals, vertices),
        tangents: of(mesh.tangents, vertices),
        colors: of(mesh.colors, vertices),
        uvs: mesh.uvs.each_ref().map(uv),
        indices: corners.map(|corner| blocks.place[view.vertex_at(corner)]).collect(),
        submesh_index_counts: counts.map(|count| 3 * count).collect(),
    }
}

/// `#submeshes`: how many triangles of a block belong to each.
pub fn triangle_counts(view: &View, blocks: &Blocks, block: usize) -> Vec<u32> {
    let (mut triangles, mut end) = (blocks.triangles.of(block), 0);
    let count = |indices: &u32| {
        end += indices / 3;
        let (own, rest) = triangles.split_at(triangles.partition_point(|t| t.0 < end));
        triangles = rest;
        own.len() as u32
    };
    view.mesh.submesh_index_counts.iter().map(count).collect()
}

/// The values of some vertices; an absent stream stays absent.
fn of<T: Copy>(values: &[T], vertices: &[Vertex]) -> Vec<T> {
    let present = if values.is_empty() { &[] } else { vertices };
    present.iter().map(|vertex| values[vertex.index()]).collect()
}

fn values_of(values: &[f32], components: usize, vertices: &[Vertex]) -> Vec<f32> {
    let present = if components == 0 { &[] } else { vertices };
    let range = |vertex: &Vertex| vertex.index() * components..(vertex.index() + 1) * components;
    let mut own = Vec::with_capacity(present.len() * components);
    present.iter().for_each(|vertex| own.extend_from_slice(&values[range(vertex)]));
    own
}

/// The results of all blocks in their order (`results: #blocks`), put together.
///
/// # Errors
/// [`Error::Cancelled`] where the watch stops it.
pub fn join(
    view: &View,
    blocks: &Blocks,
    results: Vec<Chamfered>,
    (threads, watch): (&Threads, &dyn Watch),
) -> Result<Chamfered, Error> {
    let vertices = VertexPlaces::new(view, blocks, &results);
    watch.worked(vertices.count)?;
    let triangles = TrianglePlaces::new(view, blocks, &results);
    watch.worked(vertices.count)?;
    let mut joined = empty(view, &vertices, &triangles, &results, watch)?;
    watch.worked(vertices.count)?;
    let mut streams = std::mem::take(&mut joined.mesh);
    joined.mesh.indices = std::mem::take(&mut streams.indices);
    let mut left = results.into_iter().enumerate();
    loop {
        let some: Vec<_> = left.by_ref().take(JOINED_AT_ONCE).collect();
        if some.is_empty() {
            break;
        }
        watch.worked(some.iter().map(|(_, result)| result.triangle_sources.len()).sum())?;
        put_some((&mut joined, &mut streams), blocks, (&vertices, &triangles), some, threads);
    }
    joined.mesh = MeshBuffers { indices: std::mem::take(&mut joined.mesh.indices), ..streams };
    joined.pieces.sort_unstable_by_key(|piece| piece.triangle);
    Ok(joined)
}

/// The results of some blocks: the streams of their vertices, and beside these all else.
fn put_some(
    (joined, streams): (&mut Chamfered, &mut MeshBuffers),
    blocks: &Blocks,
    (vertices, triangles): (&VertexPlaces, &TrianglePlaces),
    mut some: Vec<(usize, Chamfered)>,
    threads: &Threads,
) {
    let places = |(block, result): &(usize, Chamfered)| {
        vertices.of(*block, blocks.vertices.of(*block), result)
    };
    let places: Vec<Vec<u32>> = some.iter().map(places).collect();
    let sources = some.iter_mut().map(|(_, result)| std::mem::take(&mut result.vertex_sources));
    let sources: Vec<VertexSources> = sources.collect();
    let some = || some.iter().zip(&places);
    threads.both(
        || some().for_each(|((_, own), places)| put_vertices(streams, &own.mesh, places)),
        || {
            for (((block, result), places), sources) in some().zip(sources) {
                let own = (blocks.vertices.of(*block), blocks.triangles.of(*block));
                put_triangles(joined, result, own, (places, &triangles.of(*block, own.1)));
                put_verdicts(joined, result, own.0);
                joined.vertex_sources.put_part(sources, places, |v| own.0[v as usize].0);
            }
        },
    );
}

/// The triangles of a block's result, before its verdicts.
fn put_triangles(
    joined: &mut Chamfered,
    result: &Chamfered,
    (vertices, triangles): (&[Vertex], &[Triangle]),
    (vertex_at, place_of): (&[u32], &[u32]),
) {
    let first_edge = joined.verdicts.len() as u32;
    for (number, at) in place_of.iter().map(|&at| at as usize).enumerate() {
        let TriangleSource { kind, index } = result.triangle_sources[number];
        let index = match kind {
            TriangleKind::Source => triangles[index as usize].0,
            TriangleKind::Edge => first_edge + index,
            TriangleKind::Corner => vertices[index as usize].0,
        };
        joined.triangle_sources[at] = TriangleSource { kind, index };
        for k in 0..3 {
            joined.mesh.indices[3 * at + k] =
                vertex_at[result.mesh.indices[3 * number + k] as usize];
        }
    }
    let place = |piece: &Piece| Piece { triangle: place_of[piece.triangle as usize], ..*piece };
    joined.pieces.extend(result.pieces.iter().map(place));
}

fn put_verdicts(joined: &mut Chamfered, result: &Chamfered, vertices: &[Vertex]) {
    let at = |vertex: u32| vertices[vertex as usize].0;
    let verdict =
        |verdict: &EdgeVerdict| EdgeVerdict { vertices: verdict.vertices.map(at), ..*verdict };
    joined.verdicts.extend(result.verdicts.iter().map(verdict));
    joined.totals.add(&result.totals);
    joined.largest_width = joined.largest_width.max(result.largest_width);
}

/// A result with room for all, and nothing in it.
fn empty(
    view: &View,
    vertices: &VertexPlaces,
    triangles: &TrianglePlaces,
    results: &[Chamfered],
    watch: &dyn Watch,
) -> Result<Chamfered, Error> {
    let (mesh, count) = (&view.mesh, vertices.count);
    let present = |is_absent: bool| if is_absent { 0 } else { count };
    let uv = |uv: &Uv| UvBuffer {
        components: uv.components,
        values: vec![0.0; count * uv.components as usize],
    };
    let triangle_count = triangles.starts[triangles.starts.len() - 1] as usize;
    let nothing = TriangleSource { kind: TriangleKind::Source, index: 0 };
    let verdicts = results.iter().map(|result| result.verdicts.len()).sum();
    let mesh = MeshBuffers {
        positions: vec![[0.0; 3]; count],
        normals: vec![[0.0; 3]; count],
        tangents: vec![[0.0; 4]; present(mesh.tangents.is_empty())],
        colors: vec![[0.0; 4]; present(mesh.colors.is_empty())],
        uvs: mesh.uvs.each_ref().map(uv),
        indices: vec![0; 3 * triangle_count],
        submesh_index_counts: triangles
            .starts
            .windows(2)
            .map(|bounds| 3 * (bounds[1] - bounds[0]))
            .collect(),
    };
    watch.worked(count)?;
    let vertex_sources = VertexSources::with_places(vertices.first_continuing, count);
    watch.worked(count)?;
    Ok(Chamfered {
        mesh,
        vertex_sources,
        triangle_sources: vec![nothing; triangle_count],
        verdicts: Vec::with_capacity(verdicts),
        width: view.width as f32,
        hard_angle: view.hard_angle,
        ..Chamfered::default()
    })
}

fn put_vertices(joined: &mut MeshBuffers, own: &MeshBuffers, places: &[u32]) {
    put(&mut joined.positions, &own.positions, places);
    put(&mut joined.normals, &own.normals, places);
    put(&mut joined.tangents, &own.tangents, places);
    put(&mut joined.colors, &own.colors, places);
    for (joined, own) in joined.uvs.iter_mut().zip(&own.uvs) {
        let width = joined.components as usize;
        if width > 0 {
            for (value, &place) in own.values.chunks_exact(width).zip(places) {
                let first = place as usize * width;
                joined.values[first..first + width].copy_from_slice(value);
            }
        }
    }
}

fn put<T: Copy>(joined: &mut [T], own: &[T], places: &[u32]) {
    own.iter().zip(places).for_each(|(&value, &place)| joined[place as usize] = value);
}

/// Where the vertices of all blocks go: those of the source, then what has moved away from them, and
/// then what continues other charts.
struct VertexPlaces {
    /// `#blocks`: where what is new of each begins, of either kind.
    new: Vec<[usize; 2]>,
    first_continuing: usize,
    count: usize,
}

impl VertexPlaces {
    fn new(view: &View, blocks: &Blocks, results: &[Chamfered]) -> VertexPlaces {
        let count_of = |result: &Chamfered| result.mesh.positions.len();
        let count = results.iter().map(count_of).sum();
        let moved = |(block, result): (usize, &Chamfered)| {
            result.vertex_sources.first_continuing() - blocks.vertices.of(block).len()
        };
        let sources = view.mesh.positions.len();
        let first_continuing = sources + results.iter().enumerate().map(moved).sum::<usize>();
        let mut next = [sources, first_continuing];
        let mut new = Vec::with_capacity(results.len());
        for (block, result) in results.iter().enumerate() {
            new.push(next);
            next[0] += moved((block, result));
            next[1] += count_of(result) - result.vertex_sources.first_continuing();
        }
        VertexPlaces { new, first_continuing, count }
    }

    /// Where each vertex of a block's result goes; `own: #source vertices` of the block.
    fn of(&self, block: usize, own: &[Vertex], result: &Chamfered) -> Vec<u32> {
        let [moved, continuing] = self.new[block];
        let first_continuing = result.vertex_sources.first_continuing();
        let moved = (moved..).take(first_continuing - own.len());
        let continuing = (continuing..).take(result.mesh.positions.len() - first_continuing);
        let new = moved.chain(continuing).map(|place| place as u32);
        own.iter().map(|vertex| vertex.0).chain(new).collect()
    }
}

/// Where the triangles of all blocks go: in each submesh those of the source, then what is new.
struct TrianglePlaces {
    /// `#submeshes + 1`: where the triangles of each begin, and the end.
    starts: Vec<u32>,
    /// `#blocks by #submeshes`.
    of_blocks: Vec<Vec<Stretch>>,
}

/// The triangles of a block in one submesh of its result.
#[derive(Clone, Copy)]
struct Stretch {
    /// So many of the source come first.
    old: u32,
    /// The first source triangle of the submesh goes so much farther back.
    shift: u32,
    /// Where what is new begins, and how much of it there is.
    new: u32,
    count: u32,
}

impl TrianglePlaces {
    fn new(view: &View, blocks: &Blocks, results: &[Chamfered]) -> TrianglePlaces {
        let submeshes = results.first().map_or(0, |first| first.mesh.submesh_index_counts.len());
        let old: Vec<Vec<u32>> =
            (0..results.len()).map(|block| triangle_counts(view, blocks, block)).collect();
        let (mut starts, mut source, mut of_blocks) = (vec![0], 0, vec![vec![]; results.len()]);
        for submesh in 0..submeshes {
            let own = view.mesh.submesh_index_counts.get(submesh).map_or(0, |count| count / 3);
            let (shift, mut new) = (starts[submesh] - source, starts[submesh] + own);
            for (block, result) in results.iter().enumerate() {
                let old = old[block].get(submesh).copied().unwrap_or(0);
                let count = result.mesh.submesh_index_counts[submesh] / 3 - old;
                of_blocks[block].push(Stretch { old, shift, new, count });
                new += count;
            }
            starts.push(new);
            source += own;
        }
        TrianglePlaces { starts, of_blocks }
    }

    /// Where each triangle of a block's result goes; `own: #source triangles` of the block.
    fn of(&self, block: usize, mut own: &[Triangle]) -> Vec<u32> {
        let mut places = Vec::new();
        for stretch in &self.of_blocks[block] {
            let (old, rest) = own.split_at(stretch.old as usize);
            places.extend(old.iter().map(|triangle| stretch.shift + triangle.0));
            places.extend(stretch.new..stretch.new + stretch.count);
            own = rest;
        }
        places
    }
}
