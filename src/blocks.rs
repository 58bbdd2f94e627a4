//! Blocks: a large mesh of many parts, some whole parts at a time.
//!
//! What the stages make of a block stays in the caches from one to the next, and blocks are shared out
//! among threads. Parts that come near each other stay together, so all that one may do to another
//! is seen. Which parts make a block depends on the mesh alone, so the result is the same for any
//! number of threads.
//!
//! Their results are put together by [`crate::joined`].

use crate::bvh::{Aabb, Tree};
use crate::edges::may_be_hard;
use crate::error::Error;
use crate::groups::Groups;
use crate::ids::{Cluster, Id, IdVec, Triangle, Vertex};
use crate::memory;
use crate::mesh::{MeshBuffers, Uv, UvBuffer};
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

    /// In ascending order.
    pub fn triangles_of(&self, block: usize) -> &[Triangle] {
        self.triangles.of(block)
    }

    /// In ascending order.
    pub fn vertices_of(&self, block: usize) -> &[Vertex] {
        self.vertices.of(block)
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
    let mut left = MOST_PAIRS * boxes.len();
    let pair = |one, other| {
        left = left.checked_sub(1).ok_or(None)?;
        near.join(tree.number(one), tree.number(other));
        Ok(())
    };
    // None where there are too many pairs.
    match tree.each_pair(&all, |looks| watch.worked(looks).map_err(Some), pair) {
        Err(None) => return Ok(None),
        Err(Some(error)) => return Err(error),
        Ok(()) => {}
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
