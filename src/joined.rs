//! Joined: the results of blocks, put together as they are made, so that the memory of one serves the
//! next.
//!
//! Source vertices and triangles go back to where they were; what is new follows, block by block: in
//! each submesh the new triangles, and of the vertices those that have moved away before those that
//! continue other charts. How many move is known at the end only. Mostly none do, so what continues is
//! numbered as if none did, and what has moved from the last number that there is downward; in the end
//! all get the numbers that they keep.

use std::ops::Range;

use crate::blocks::{Blocks, triangle_counts};
use crate::error::Error;
use crate::ids::{Id, Triangle, Vertex};
use crate::memory;
use crate::mesh::{MeshBuffers, Uv, UvBuffer};
use crate::report::{Chamfered, EdgeVerdict, Piece, TriangleKind, TriangleSource, VertexSources};
use crate::view::View;
use crate::watch::{STEPS, Watch};

/// So much more than the blocks so far lead to expect, in parts of that: they differ, and room that is
/// made again and again would be copied each time.
const SPARE: f64 = 1.0 / 32.0;

/// The number of the first vertex that has moved, before all are known: the last one that there is.
const FIRST_MOVED: u32 = u32::MAX;

/// What the results are put together to.
pub struct Joined<'a> {
    view: &'a View<'a>,
    blocks: &'a Blocks,
    blocks_done: usize,
    /// Of the source.
    triangles_done: usize,
    /// The vertices of the source, and then those that continue other charts.
    streams: MeshBuffers,
    /// The vertices that have moved away.
    moved: MeshBuffers,
    vertex_sources: VertexSources,
    submeshes: Vec<Submesh>,
    /// Verdicts, their sums, and what holds for the mesh.
    told: Chamfered,
}

/// The triangles of a submesh: those of the source, and then what is new.
struct Submesh {
    /// The first triangle of the source.
    start: u32,
    /// So many are of the source.
    kept: usize,
    indices: Vec<u32>,
    sources: Vec<TriangleSource>,
    pieces: Vec<Piece>,
}

impl<'a> Joined<'a> {
    /// Nothing yet, with room for what there is of the source.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`] where that is not to be had.
    pub fn new(view: &'a View<'a>, blocks: &'a Blocks) -> Result<Joined<'a>, Error> {
        let (vertices, corners) = (view.mesh.positions.len(), view.corner_count());
        memory::ask(memory::of_joined(&view.mesh, vertices, corners / 3))?;
        let mut vertex_sources = VertexSources::with_room(vertices, 0, 0);
        (0..vertices as u32).for_each(|vertex| vertex_sources.push_kept(vertex));
        Ok(Joined {
            view,
            blocks,
            blocks_done: 0,
            triangles_done: 0,
            streams: zeros(view, vertices),
            moved: zeros(view, 0),
            vertex_sources,
            submeshes: Vec::new(),
            told: Chamfered {
                width: view.width as f32,
                hard_angle: view.hard_angle,
                ..Chamfered::default()
            },
        })
    }

    /// Puts the results of the next blocks behind those before.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`] where there is no room for them.
    pub fn add(&mut self, results: Vec<Chamfered>) -> Result<(), Error> {
        let Some(first) = results.first() else { return Ok(()) };
        if self.submeshes.is_empty() {
            self.submeshes = submeshes(self.view, first.mesh.submesh_index_counts.len());
        }
        let next = self.blocks_done..self.blocks_done + results.len();
        let triangles = |block| self.blocks.triangles_of(block).len();
        self.triangles_done += next.clone().map(triangles).sum::<usize>();
        self.blocks_done = next.end;
        self.make_room(next.clone(), &results)?;
        next.zip(results).try_for_each(|(block, result)| self.put(block, result))
    }

    /// Room for some more results; where there is too little, for all that are still to come as well, if
    /// these are as large as those before.
    fn make_room(&mut self, blocks: Range<usize>, results: &[Chamfered]) -> Result<(), Error> {
        let all = self.view.corner_count() / 3;
        let times = all as f64 / self.triangles_done as f64 * (1.0 + SPARE);
        let ([mut moved, mut continuing], mut new) = ([0; 2], vec![0; self.submeshes.len()]);
        for (block, result) in blocks.zip(results) {
            let first_continuing = result.vertex_sources.first_continuing();
            moved += first_continuing - self.blocks.vertices_of(block).len();
            continuing += result.mesh.positions.len() - first_continuing;
            let kept = triangle_counts(self.view, self.blocks, block);
            for (submesh, count) in result.mesh.submesh_index_counts.iter().enumerate() {
                new[submesh] += count / 3 - kept.get(submesh).copied().unwrap_or(0);
            }
        }
        let (kept, streams) = (self.view.mesh.positions.len(), &results[0].mesh);
        each_stream(&mut self.streams, streams, &Room { kept, more: continuing, times })?;
        each_stream(&mut self.moved, streams, &Room { kept: 0, more: moved, times })?;
        for (submesh, new) in self.submeshes.iter_mut().zip(new) {
            let (kept, new) = (submesh.kept, new as usize);
            memory::make_room(&mut submesh.indices, 3 * new, (3 * kept, times))?;
            memory::make_room(&mut submesh.sources, new, (kept, times))?;
        }
        let verdicts = results.iter().map(|result| result.verdicts.len()).sum();
        memory::make_room(&mut self.told.verdicts, verdicts, (0, times))?;
        let sources = results.iter().map(|result| &result.vertex_sources);
        self.vertex_sources.make_room(sources, moved, (kept, times))
    }

    /// Puts the result of a block behind those before.
    fn put(&mut self, block: usize, result: Chamfered) -> Result<(), Error> {
        let own = self.blocks.vertices_of(block);
        let numbers = self.numbers(own, &result);
        let (count, first_continuing) = (numbers.len(), result.vertex_sources.first_continuing());
        let moved = own.len()..first_continuing;
        each_stream(&mut self.streams, &result.mesh, &Back { to: own })?;
        each_stream(&mut self.streams, &result.mesh, &Append { from: first_continuing..count })?;
        each_stream(&mut self.moved, &result.mesh, &Append { from: moved })?;
        self.put_triangles(block, &result, (own, &numbers));
        self.put_told(&result, own);
        self.vertex_sources
            .append_part(result.vertex_sources, own.len(), |vertex| own[vertex as usize].0);
        Ok(())
    }

    /// `#vertices` of a block's result: the number of each until all are known.
    fn numbers(&self, own: &[Vertex], result: &Chamfered) -> Vec<u32> {
        let first_continuing = result.vertex_sources.first_continuing();
        let moved = FIRST_MOVED - self.moved.positions.len() as u32;
        let moved = (0..(first_continuing - own.len()) as u32).map(|k| moved - k);
        let continuing = self.streams.positions.len() as u32..;
        let continuing = continuing.take(result.mesh.positions.len() - first_continuing);
        own.iter().map(|vertex| vertex.0).chain(moved).chain(continuing).collect()
    }

    /// The triangles of a block's result, before its verdicts.
    fn put_triangles(
        &mut self,
        block: usize,
        result: &Chamfered,
        (vertices, numbers): (&[Vertex], &[u32]),
    ) {
        let first_edge = self.told.verdicts.len() as u32;
        let triangles = self.blocks.triangles_of(block);
        let source = |TriangleSource { kind, index }: TriangleSource| TriangleSource {
            kind,
            index: match kind {
                TriangleKind::Source => triangles[index as usize].0,
                TriangleKind::Edge => first_edge + index,
                TriangleKind::Corner => vertices[index as usize].0,
            },
        };
        let (mut own, mut pieces) = (triangles, &result.pieces[..]);
        let (kept, mut first) = (triangle_counts(self.view, self.blocks, block), 0);
        for (number, submesh) in self.submeshes.iter_mut().enumerate() {
            let end = first + result.mesh.submesh_index_counts[number] as usize / 3;
            let (kept, rest) = own.split_at(kept.get(number).map_or(0, |&count| count as usize));
            let within = pieces.partition_point(|piece| (piece.triangle as usize) < end);
            let (these, later) = pieces.split_at(within);
            submesh.put_corners(kept, &result.mesh.indices[3 * first..3 * end], numbers);
            submesh.put_pieces(kept, these, first as u32);
            submesh.put_sources(kept, &result.triangle_sources[first..end], source);
            (own, pieces, first) = (rest, later, end);
        }
    }

    fn put_told(&mut self, result: &Chamfered, vertices: &[Vertex]) {
        let at = |vertex: u32| vertices[vertex as usize].0;
        let verdict =
            |verdict: &EdgeVerdict| EdgeVerdict { vertices: verdict.vertices.map(at), ..*verdict };
        self.told.verdicts.extend(result.verdicts.iter().map(verdict));
        self.told.totals.add(&result.totals);
        self.told.largest_width = self.told.largest_width.max(result.largest_width);
    }

    /// The result for the mesh, when all blocks are in it.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`] where there is no room for it, and [`Error::Cancelled`] where the watch
    /// stops it.
    pub fn finish(mut self, watch: &dyn Watch) -> Result<Chamfered, Error> {
        let (kept, moved) = (self.view.mesh.positions.len(), self.moved.positions.len());
        if moved > 0 {
            memory::ask(memory::of_joined(
                &self.view.mesh,
                self.streams.positions.len() + moved,
                0,
            ))?;
            each_stream(&mut self.streams, &self.moved, &Insert { at: kept })?;
            self.submeshes.iter_mut().try_for_each(|submesh| submesh.number(kept, moved, watch))?;
        }
        let mut mesh = std::mem::take(&mut self.streams);
        mesh.submesh_index_counts =
            self.submeshes.iter().map(|submesh| submesh.indices.len() as u32).collect();
        let triangles = self.submeshes.iter().map(|submesh| submesh.sources.len()).sum();
        memory::ask(memory::of_joined(&self.view.mesh, 0, triangles))?;
        let all = joined_submeshes(self.submeshes, watch)?;
        mesh.indices = all.indices;
        Ok(Chamfered {
            mesh,
            vertex_sources: self.vertex_sources,
            triangle_sources: all.sources,
            pieces: all.pieces,
            ..self.told
        })
    }
}

/// The first submeshes of a result, with room for the triangles of the source.
fn submeshes(view: &View, count: usize) -> Vec<Submesh> {
    let nothing = TriangleSource { kind: TriangleKind::Source, index: 0 };
    let counts = view.mesh.submesh_index_counts.iter().chain(std::iter::repeat(&0));
    let mut end = 0;
    let submesh = |&count: &u32| {
        let (start, kept) = (end, count as usize / 3);
        end += count / 3;
        let (indices, sources) = (vec![0; count as usize], vec![nothing; kept]);
        Submesh { start, kept, indices, sources, pieces: Vec::new() }
    };
    counts.take(count).map(submesh).collect()
}

impl Submesh {
    /// Puts the corners of a block's triangles: of those of the source where they were, and of what is new
    /// behind all else, as all that follows does.
    fn put_corners(&mut self, kept: &[Triangle], corners: &[u32], numbers: &[u32]) {
        let number = |&vertex: &u32| numbers[vertex as usize];
        let (old, new) = corners.split_at(3 * kept.len());
        for (triangle, corners) in kept.iter().zip(old.as_chunks::<3>().0) {
            let first = 3 * (triangle.0 - self.start) as usize;
            self.indices[first..first + 3].copy_from_slice(&corners.each_ref().map(number));
        }
        self.indices.extend(new.iter().map(number));
    }

    /// Pieces are told by the numbers of the block, of which `first` is the first one here.
    fn put_pieces(&mut self, kept: &[Triangle], pieces: &[Piece], first: u32) {
        let new = self.sources.len() as u32;
        let at = |within: u32| match kept.get(within as usize) {
            Some(triangle) => triangle.0 - self.start,
            None => new + within - kept.len() as u32,
        };
        let piece = |piece: &Piece| Piece { triangle: at(piece.triangle - first), ..*piece };
        self.pieces.extend(pieces.iter().map(piece));
    }

    fn put_sources(
        &mut self,
        kept: &[Triangle],
        sources: &[TriangleSource],
        told: impl Fn(TriangleSource) -> TriangleSource,
    ) {
        let (old, new) = sources.split_at(kept.len());
        for (triangle, &source) in kept.iter().zip(old) {
            self.sources[(triangle.0 - self.start) as usize] = told(source);
        }
        self.sources.extend(new.iter().map(|&source| told(source)));
    }

    /// Gives the numbers that they keep to the vertices of what is new, where so many have moved.
    fn number(&mut self, kept: usize, moved: usize, watch: &dyn Watch) -> Result<(), Error> {
        let (kept, moved) = (kept as u32, moved as u32);
        let last_moved = FIRST_MOVED - (moved - 1);
        for some in self.indices.chunks_mut(STEPS) {
            for vertex in some.iter_mut().filter(|vertex| **vertex >= kept) {
                *vertex = if *vertex >= last_moved {
                    kept + (FIRST_MOVED - *vertex)
                } else {
                    *vertex + moved
                };
            }
            watch.worked(some.len())?;
        }
        Ok(())
    }
}

/// All submeshes as one, in their order; of one alone nothing is copied.
fn joined_submeshes(submeshes: Vec<Submesh>, watch: &dyn Watch) -> Result<Submesh, Error> {
    let count = |of: fn(&Submesh) -> usize| submeshes.iter().skip(1).map(of).sum();
    let [corners, triangles] = [count(|one| one.indices.len()), count(|one| one.sources.len())];
    let mut left = submeshes.into_iter();
    let mut all = left.next().expect("a mesh with triangles has submeshes");
    all.indices.reserve_exact(corners);
    all.sources.reserve_exact(triangles);
    for submesh in left {
        let start = all.sources.len() as u32;
        let piece = |piece: Piece| Piece { triangle: start + piece.triangle, ..piece };
        all.pieces.extend(submesh.pieces.into_iter().map(piece));
        all.indices.extend(submesh.indices);
        all.sources.extend(submesh.sources);
        watch.worked(all.sources.len() - start as usize)?;
    }
    all.pieces.sort_unstable_by_key(|piece| piece.triangle);
    Ok(all)
}

/// So many vertices with the streams of the mesh, all zero.
fn zeros(view: &View, count: usize) -> MeshBuffers {
    let mesh = &view.mesh;
    let present = |is_absent: bool| if is_absent { 0 } else { count };
    let uv = |uv: &Uv| UvBuffer {
        components: uv.components,
        values: vec![0.0; count * uv.components as usize],
    };
    MeshBuffers {
        positions: vec![[0.0; 3]; count],
        normals: vec![[0.0; 3]; count],
        tangents: vec![[0.0; 4]; present(mesh.tangents.is_empty())],
        colors: vec![[0.0; 4]; present(mesh.colors.is_empty())],
        uvs: mesh.uvs.each_ref().map(uv),
        ..MeshBuffers::default()
    }
}

/// Something that is done with each stream, of so many values for each vertex.
trait Put {
    fn put<T: Copy>(&self, all: &mut Vec<T>, own: &[T], width: usize) -> Result<(), Error>;
}

/// Does it with all streams that `all` has, and those of a part.
fn each_stream(all: &mut MeshBuffers, own: &MeshBuffers, put: &impl Put) -> Result<(), Error> {
    put.put(&mut all.positions, &own.positions, 1)?;
    put.put(&mut all.normals, &own.normals, 1)?;
    put.put(&mut all.tangents, &own.tangents, 1)?;
    put.put(&mut all.colors, &own.colors, 1)?;
    for (all, own) in all.uvs.iter_mut().zip(&own.uvs) {
        put.put(&mut all.values, &own.values, all.components as usize)?;
    }
    Ok(())
}

/// Vertices of the source, to where they were.
struct Back<'a> {
    to: &'a [Vertex],
}

impl Put for Back<'_> {
    fn put<T: Copy>(&self, all: &mut Vec<T>, own: &[T], width: usize) -> Result<(), Error> {
        for (value, vertex) in own.chunks_exact(width.max(1)).zip(self.to) {
            all[vertex.index() * width..][..width].copy_from_slice(value);
        }
        Ok(())
    }
}

/// Some vertices, to the end.
struct Append {
    from: Range<usize>,
}

impl Put for Append {
    fn put<T: Copy>(&self, all: &mut Vec<T>, own: &[T], width: usize) -> Result<(), Error> {
        if !own.is_empty() {
            all.extend_from_slice(&own[self.from.start * width..self.from.end * width]);
        }
        Ok(())
    }
}

/// All vertices, before others.
struct Insert {
    at: usize,
}

impl Put for Insert {
    fn put<T: Copy>(&self, all: &mut Vec<T>, own: &[T], width: usize) -> Result<(), Error> {
        let at = if own.is_empty() { 0 } else { self.at * width };
        all.splice(at..at, own.iter().copied());
        Ok(())
    }
}

/// No values, but room for so many vertices after so many that were there before all blocks; where
/// there is too little, for so many times as many as there are after these.
struct Room {
    kept: usize,
    more: usize,
    times: f64,
}

impl Put for Room {
    fn put<T: Copy>(&self, all: &mut Vec<T>, own: &[T], width: usize) -> Result<(), Error> {
        let more = if own.is_empty() { 0 } else { self.more * width };
        memory::make_room(all, more, (self.kept * width, self.times))
    }
}
