//! Memory: whether a call can have what it may need, asked before anything is done.
//!
//! The stages allocate as they go, and an allocation that fails within them would end the host's
//! process. So the most that they can need is told from the counts, asked for in one piece, and
//! given back. Where it is not to be had, the call ends with an error instead.

use crate::error::Error;
use crate::mesh::Mesh;
use crate::options::Verify;
use crate::see_through::Eyes;

/// For each source vertex, the weld and the copies of its ids.
const BYTES_PER_VERTEX: u64 = 512;

/// For each corner, topology, sectors, offsets and the new triangles with their sources, where all
/// edges are hard. `tests/memory.rs` measures it.
const BYTES_PER_CORNER: u64 = 1024;

/// For each corner where collisions are looked for: the boxes, their tree and the loose triangles.
const BYTES_PER_CORNER_IN_FULL: u64 = 512;

/// For each corner where the result is looked at: both scenes, what is new in them, and how they lie
/// on the picture that each thread draws.
const BYTES_PER_CORNER_SEEN: u64 = 1408;

/// Vertices that come of a corner at most, and of a source vertex itself, while the streams grow:
/// an array that grows stands there twice for a moment.
const COPIES_PER_CORNER: u64 = 4;

/// For each submesh, its count in the source, in the making and in the result.
const BYTES_PER_SUBMESH: u64 = 64;

/// Depths of a few pictures of the default size for each thread.
const BYTES_OF_PICTURES: u64 = (16 << 20) * Eyes::MOST_THREADS as u64;

/// What even an empty mesh may take, error messages included.
const BYTES_PER_CALL: u64 = 1 << 20;

/// The most bytes that chamfering a mesh allocates at one time, its result included.
///
/// An upper bound from the counts alone: most meshes take a fraction of it, because few of their
/// edges are hard.
pub fn most_memory(mesh: &Mesh, verify: Verify) -> u64 {
    let (vertices, corners) = (mesh.positions.len() as u64, mesh.indices.len() as u64);
    let per_corner = match verify {
        Verify::Fast => BYTES_PER_CORNER,
        Verify::Full => BYTES_PER_CORNER + BYTES_PER_CORNER_IN_FULL,
        Verify::Seen => BYTES_PER_CORNER + BYTES_PER_CORNER_IN_FULL + BYTES_PER_CORNER_SEEN,
    };
    let pictures = if verify == Verify::Seen { BYTES_OF_PICTURES } else { 0 };
    BYTES_PER_CALL
        + pictures
        + vertices * BYTES_PER_VERTEX
        + corners * per_corner
        + mesh.submesh_index_counts.len() as u64 * BYTES_PER_SUBMESH
        + (vertices + corners) * COPIES_PER_CORNER * bytes_per_vertex(mesh)
}

/// Of the streams that the mesh has.
fn bytes_per_vertex(mesh: &Mesh) -> u64 {
    let fours = u64::from(!mesh.tangents.is_empty()) + u64::from(!mesh.colors.is_empty());
    let uvs: u64 = mesh.uvs.iter().map(|uv| u64::from(uv.components)).sum();
    4 * (3 + 3 + 4 * fours + uvs)
}

/// Asks for the memory, and gives it back.
pub fn check(mesh: &Mesh, verify: Verify) -> Result<(), Error> {
    let bytes = usize::try_from(most_memory(mesh, verify)).map_err(|_| Error::OutOfMemory)?;
    Vec::<u8>::new().try_reserve_exact(bytes).map_err(|_| Error::OutOfMemory)
}
