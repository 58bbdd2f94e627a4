//! Join: the results of all blocks as the result of the mesh.
//!
//! Source vertices and triangles go back to where they were; what is new follows, block by block.

use super::Blocks;
use super::triangle_counts;
use crate::ids::{Triangle, Vertex};
use crate::mesh::{MeshBuffers, Uv, UvBuffer};
use crate::report::{Chamfered, EdgeVerdict, Piece, TriangleKind, TriangleSource, VertexSources};
use crate::view::View;

/// The results of all blocks in their order (`results: #blocks`), put together.
pub fn join(view: &View, blocks: &Blocks, results: Vec<Chamfered>) -> Chamfered {
    let vertices = VertexPlaces::new(view, blocks, &results);
    let triangles = TrianglePlaces::new(view, blocks, &results);
    let mut joined = empty(view, &vertices, &triangles, &results);
    for (block, result) in results.into_iter().enumerate() {
        let own = (blocks.vertices.of(block), blocks.triangles.of(block));
        let places = (vertices.of(block, own.0, &result), triangles.of(block, own.1));
        put_vertices(&mut joined.mesh, &result.mesh, &places.0);
        put_triangles(&mut joined, &result, own, (&places.0, &places.1));
        put_verdicts(&mut joined, &result, own.0);
        joined
            .vertex_sources
            .put_part(result.vertex_sources, &places.0, |vertex| own.0[vertex as usize].0);
    }
    joined.pieces.sort_unstable_by_key(|piece| piece.triangle);
    joined
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
) -> Chamfered {
    let (mesh, count) = (&view.mesh, vertices.count);
    let present = |is_absent: bool| if is_absent { 0 } else { count };
    let uv = |uv: &Uv| UvBuffer {
        components: uv.components,
        values: vec![0.0; count * uv.components as usize],
    };
    let triangle_count = triangles.starts[triangles.starts.len() - 1] as usize;
    let nothing = TriangleSource { kind: TriangleKind::Source, index: 0 };
    let verdicts = results.iter().map(|result| result.verdicts.len()).sum();
    Chamfered {
        mesh: MeshBuffers {
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
        },
        vertex_sources: VertexSources::with_places(vertices.first_continuing, count),
        triangle_sources: vec![nothing; triangle_count],
        verdicts: Vec::with_capacity(verdicts),
        width: view.width as f32,
        ..Chamfered::default()
    }
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
