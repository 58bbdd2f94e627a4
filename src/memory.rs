//! Memory: whether a call can have what it may need, asked before it is needed.
//!
//! The stages allocate as they go, and an allocation that fails within them would end the host's
//! process. So what some stages can need at most is told from what is known by then, asked for in
//! one piece, and given back; where it is not to be had, the call ends with an error instead.
//! Nothing is known at first but the counts of the mesh; how much chamfers take is asked once the
//! hard edges are counted: most meshes have few, and smooth ones none.

use crate::error::Error;
use crate::mesh::Mesh;
use crate::see_through::Eyes;

/// For each source vertex: the weld.
const BYTES_PER_WELDED: u64 = 24;

/// For each source vertex that is measured in another space: its position and its normal there.
const BYTES_PER_MEASURED: u64 = 24;

/// For each source vertex of a mesh inside out: its normal the other way round.
const BYTES_PER_TURNED: u64 = 12;

/// For each corner: topology, faces, edges, and its sector.
const BYTES_PER_CORNER: u64 = 48;

/// For each open border and held line: itself, its box, and its place in their tree.
const BYTES_PER_RIM: u64 = 320;

/// For each hard edge: its sectors, two at each end at most.
const BYTES_PER_HARD_EDGE: u64 = 320;

/// For each source vertex in the result, beside its streams: whether it is taken, its provenance, and
/// what follows in its list.
const BYTES_PER_VERTEX: u64 = 40;

/// For each corner: its triangle's event and element, and the result's indices and provenance.
const BYTES_PER_USE: u64 = 36;

/// For each sector: its offset, its place, its share, and the provenance of its vertex.
const BYTES_PER_SECTOR: u64 = 256;

/// For each hard edge: the new triangles, and how they lie on the texture.
const BYTES_PER_STRIP: u64 = 240;

/// For each point of a rounded patch: itself, and its copy on another chart.
const BYTES_PER_ROUNDED_POINT: u64 = 320;

/// For each triangle of a rounded patch: itself, and its corners and provenance in the result.
const BYTES_PER_ROUNDED_TRIANGLE: u64 = 96;

/// A stream that grows stands there twice for a moment, the larger one twice as large.
const GROWTH: u64 = 3;

/// For each corner of a mesh that stays as it is: its index, and its triangle's provenance.
const BYTES_PER_COPIED_CORNER: u64 = 12;

/// For each triangle in which collisions are looked for: itself, its box, its place in the tree, and
/// where it lies as seen from its crowd and from up to eight eyes; and the turned box of a node.
const BYTES_PER_LAID: u64 = 1024;

/// For each corner where the result is looked at: both scenes, what is new in them, and how they lie
/// on the picture that each thread draws.
const BYTES_PER_CORNER_SEEN: u64 = 1408;

/// The same for each corner of each object of a scene, whose meshes have asked for their own.
const BYTES_PER_CORNER_IN_SCENE: u64 = 1024;

/// Depths of a few pictures of the default size for each thread.
const BYTES_OF_PICTURES: u64 = (16 << 20) * Eyes::MOST_THREADS as u64;

/// For each submesh, its count in the source, in the making and in the result.
const BYTES_PER_SUBMESH: u64 = 64;

/// For each corner of a mesh that gets vertices: its index in the finer mesh and in the result, twice
/// while they are put in order.
const BYTES_PER_REFINED_CORNER: u64 = 48;

/// For each piece of a triangle: itself, its sides, and its new vertices.
const BYTES_PER_PIECE: u64 = 320;

/// For each source vertex and each corner of a mesh in blocks: its part, its block and its place there.
const BYTES_PER_SHARED: u64 = 24;

/// The C library of Linux keeps what is given back for what is asked next, up to twice the largest piece
/// so far, if that was no larger than this and some bytes of its own. Beyond, each array is taken from
/// the system and given back to it, and touching new pages takes longer than all arithmetic here.
const LARGEST_KEPT: usize = (32 << 20) - (1 << 16);

/// What even an empty mesh may take, error messages included.
const BYTES_PER_CALL: u64 = 1 << 20;

/// The view and the weld.
pub fn of_weld(mesh: &Mesh) -> u64 {
    mesh.positions.len() as u64 * BYTES_PER_WELDED
}

/// A mesh in the space in which it is measured.
pub fn of_measured(mesh: &Mesh) -> u64 {
    mesh.positions.len() as u64 * BYTES_PER_MEASURED + size_of_val(mesh.held) as u64
}

/// The normals of a mesh inside out, the other way round.
pub fn of_turned(mesh: &Mesh) -> u64 {
    mesh.positions.len() as u64 * BYTES_PER_TURNED
}

/// All indices once more.
pub fn of_indices(mesh: &Mesh) -> u64 {
    size_of_val(mesh.indices) as u64
}

/// The stages from there up to the edges, but for rims.
pub fn up_to_edges(mesh: &Mesh) -> u64 {
    // Listed edges are sorted, which may take as much again.
    mesh.indices.len() as u64 * BYTES_PER_CORNER + 2 * size_of_val(mesh.factors.edges) as u64
}

/// Open borders and held lines.
pub fn of_rims(rims: usize) -> u64 {
    rims as u64 * BYTES_PER_RIM
}

/// The sectors of so many hard edges.
pub fn of_sectors(hard_edges: usize) -> u64 {
    hard_edges as u64 * BYTES_PER_HARD_EDGE
}

/// What chamfers are made of.
#[derive(Clone, Copy)]
pub struct Work {
    pub hard_edges: usize,
    /// Of these, so many where some UV channel has a seam.
    pub seams: usize,
    pub sectors: usize,
}

/// All stages after the sectors, but for collisions.
pub fn of_chamfers(mesh: &Mesh, work: Work) -> u64 {
    let [hard_edges, seams, sectors] =
        [work.hard_edges, work.seams, work.sectors].map(|count| count as u64);
    let vertices = mesh.positions.len() as u64;
    // At a seam both far vertices of a strip are copied; sectors part, and their fills are copied.
    let most_vertices = vertices + 2 * seams + sectors;
    most_vertices * GROWTH * bytes_per_vertex(mesh)
        + vertices * BYTES_PER_VERTEX
        + mesh.indices.len() as u64 * BYTES_PER_USE
        + sectors * BYTES_PER_SECTOR
        + hard_edges * BYTES_PER_STRIP
        + mesh.submesh_index_counts.len() as u64 * BYTES_PER_SUBMESH
}

/// So many points and triangles of rounded patches, and all vertices that there are by then.
pub fn of_rounding(mesh: &Mesh, points: u64, triangles: u64) -> u64 {
    let vertices = 2 * points;
    vertices * (GROWTH * bytes_per_vertex(mesh) + BYTES_PER_VERTEX)
        + points * BYTES_PER_ROUNDED_POINT
        + triangles * BYTES_PER_ROUNDED_TRIANGLE
}

/// A mesh that gets so many vertices on so many of its edges, and its shape anew.
pub fn of_refined(mesh: &Mesh, work: Work, rims: usize, [edges, vertices]: [usize; 2]) -> u64 {
    // Both sides of an edge get vertices, and both triangles one inside.
    let (vertices, cut) = (2 * vertices as u64, 2 * edges as u64);
    let pieces = vertices + 3 * cut;
    let most_corners = mesh.indices.len() as u64 + 3 * pieces;
    let most_vertices = mesh.positions.len() as u64 + vertices + cut;
    most_vertices * (GROWTH * bytes_per_vertex(mesh) + BYTES_PER_WELDED)
        + most_corners * (BYTES_PER_CORNER + BYTES_PER_REFINED_CORNER)
        + pieces * BYTES_PER_PIECE
        + of_rims(rims)
        + (work.hard_edges as u64 + vertices) * BYTES_PER_HARD_EDGE
}

/// A mesh as it is.
pub fn of_copy(mesh: &Mesh) -> u64 {
    mesh.positions.len() as u64 * bytes_per_vertex(mesh)
        + mesh.indices.len() as u64 * BYTES_PER_COPIED_CORNER
        + mesh.submesh_index_counts.len() as u64 * BYTES_PER_SUBMESH
}

/// The parts of a mesh, and the blocks that they fall into.
pub fn of_blocks(mesh: &Mesh) -> u64 {
    (mesh.positions.len() + mesh.indices.len()) as u64 * BYTES_PER_SHARED
}

/// The results of all blocks of a mesh as one, of so many vertices and triangles.
pub fn of_joined(mesh: &Mesh, vertices: usize, triangles: usize) -> u64 {
    vertices as u64 * (bytes_per_vertex(mesh) + BYTES_PER_VERTEX)
        + 3 * triangles as u64 * BYTES_PER_COPIED_CORNER
}

/// New normals for a mesh, its vertices split at each corner at most.
pub fn of_normals(mesh: &Mesh) -> u64 {
    let corners = mesh.indices.len() as u64;
    of_weld(mesh)
        + up_to_edges(mesh)
        + of_copy(mesh)
        + corners * (GROWTH * bytes_per_vertex(mesh) + BYTES_PER_SECTOR)
}

/// So many triangles of parts that are searched at a time.
pub fn of_collisions(triangles: usize) -> u64 {
    triangles as u64 * BYTES_PER_LAID
}

/// Looking at the result of a mesh by itself.
pub fn of_looking(mesh: &Mesh) -> u64 {
    BYTES_OF_PICTURES + mesh.indices.len() as u64 * BYTES_PER_CORNER_SEEN
}

/// Looking at a scene of so many corners.
pub fn of_scene(corners: u64) -> u64 {
    corners.saturating_mul(BYTES_PER_CORNER_IN_SCENE)
}

/// Of the streams that the mesh has.
fn bytes_per_vertex(mesh: &Mesh) -> u64 {
    let fours = u64::from(!mesh.tangents.is_empty()) + u64::from(!mesh.colors.is_empty());
    let uvs: u64 = mesh.uvs.iter().map(|uv| u64::from(uv.components)).sum();
    4 * (3 + 3 + 4 * fours + uvs)
}

/// Asks for memory, and gives it back.
///
/// # Errors
/// [`Error::OutOfMemory`] where it is not to be had.
pub fn ask(bytes: u64) -> Result<(), Error> {
    let bytes =
        usize::try_from(bytes.saturating_add(BYTES_PER_CALL)).map_err(|_| Error::OutOfMemory)?;
    let have = |bytes| Vec::<u8>::new().try_reserve_exact(bytes).map_err(|_| Error::OutOfMemory);
    have(bytes)?;
    have(bytes.min(LARGEST_KEPT))
}

/// Room for so many more values in a list that had so many before any of a kind were put there; where
/// there is too little, for so many times as many of that kind as there will be then.
///
/// # Errors
/// [`Error::OutOfMemory`] where it is not to be had.
pub fn make_room<T>(
    values: &mut Vec<T>,
    more: usize,
    (kept, times): (usize, f64),
) -> Result<(), Error> {
    let wanted = values.len() + more;
    if wanted <= values.capacity() {
        return Ok(());
    }
    let expected = kept + ((wanted - kept) as f64 * times) as usize;
    values.try_reserve_exact(expected.max(wanted) - values.len()).map_err(|_| Error::OutOfMemory)
}
