//! Model files in and out: readers and writers, each of which keeps what chamfering does not change.
//!
//! A file is read into a [`Document`]: meshes in the layout of the core, and all the rest as it
//! stood. Chamfered meshes go back into it with [`encode`]. Which formats there are, how files of
//! each are named and what they can become stands in one table, [`FORMATS`].
//!
//! # Features
//! `fbx`, `draco` and `meshopt`, all on by default: the readers of FBX, and of glTF that is compressed by
//! these two. Without one, a file that needs it is refused with what to do.

mod document;
#[cfg(feature = "fbx")]
pub mod fbx_file;
mod foreign;
pub mod glb;
pub mod gltf_file;
#[cfg(not(all(feature = "draco", feature = "fbx", feature = "meshopt")))]
mod left_out;
pub mod obj_file;
pub mod off_file;
mod parts;
pub mod paths;
pub mod pictures;
pub mod ply_file;
mod polygon;
mod registry;
pub mod stl_file;
pub mod weld;

pub use document::{
    Document, Encoded, Format, Further, IDENTITY, Instance, Look, Looks, Normals, NormalsRead,
    OutputFile, Place, ReadOptions, SourceMesh, StreamKind, VertexStream, Weld,
};
pub use gltf_file::compress;
pub use registry::{FORMATS, Row, decode, encode, endings, read, row_of};
