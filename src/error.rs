//! What can be wrong with a call. Each error names the element, the rule, and what to do.

use std::fmt;

/// A vertex stream of a mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Stream {
    /// Vertex positions.
    Positions,
    /// Vertex normals.
    Normals,
    /// Vertex tangents.
    Tangents,
    /// Vertex colours.
    Colors,
    /// The UV channel of this number.
    Uv(u32),
    /// The held places: not by vertex, but by their own number.
    Held,
}

impl fmt::Display for Stream {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Stream::Positions => f.write_str("positions"),
            Stream::Normals => f.write_str("normals"),
            Stream::Tangents => f.write_str("tangents"),
            Stream::Colors => f.write_str("colors"),
            Stream::Uv(channel) => write!(f, "uv channel {channel}"),
            Stream::Held => f.write_str("held places"),
        }
    }
}

/// Why a mesh was not chamfered.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Error {
    /// The mesh has vertices but no normals.
    MissingNormals,
    /// A stream has another length than the positions.
    StreamLength {
        /// The stream at fault.
        stream: Stream,
        /// Floats that `#vertices by components` needs.
        expected: u64,
        /// Floats that it has.
        found: u64,
    },
    /// A UV channel is neither absent nor 2 to 4 wide.
    UvComponents {
        /// The channel at fault.
        channel: u32,
        /// Its width.
        components: u32,
    },
    /// A value is infinite or not a number.
    NotFinite {
        /// The stream at fault.
        stream: Stream,
        /// The vertex that holds the value.
        vertex: u32,
    },
    /// The submesh index counts do not add up to the number of indices.
    IndexTotal {
        /// Sum of the counts.
        expected: u64,
        /// Number of indices.
        found: u64,
    },
    /// A submesh's index count is not a multiple of three.
    IndexCount {
        /// The submesh at fault.
        submesh: u32,
        /// Its index count.
        count: u32,
    },
    /// An index points past the last vertex.
    IndexRange {
        /// Place in the index array.
        place: u32,
        /// The index found there.
        index: u32,
        /// Number of vertices.
        vertices: u32,
    },
    /// The width is negative, infinite or not a number.
    BadWidth(f32),
    /// The breadth that has to stay is no share between 0 and 1.
    BadBreadth(f32),
    /// `ChamferSubmesh::Given` names a submesh that the mesh does not have.
    SubmeshRange {
        /// The submesh asked for.
        submesh: u32,
        /// Number of submeshes.
        submeshes: u32,
    },
    /// The mesh, or what it would become, does not fit 32-bit indices.
    TooLarge,
    /// Memory for the result could not be had.
    OutOfMemory,
    /// The progress callback asked to stop.
    Cancelled,
}

impl std::error::Error for Error {}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Error::MissingNormals => f.write_str(
                "the mesh has no normals, and hard edges are found by them: compute normals first",
            ),
            Error::StreamLength { stream, expected, found } => write!(
                f,
                "{stream} hold {found} floats where the vertex count asks for {expected}: \
                 give every vertex a value, or leave the stream out"
            ),
            Error::UvComponents { channel, components } => write!(
                f,
                "uv channel {channel} is {components} wide: give it 2, 3 or 4 components, or 0 if absent"
            ),
            Error::NotFinite { stream, vertex } => write!(
                f,
                "{stream} of vertex {vertex} are infinite or not a number: repair the model"
            ),
            Error::IndexTotal { expected, found } => write!(
                f,
                "the submesh index counts add up to {expected}, but there are {found} indices"
            ),
            Error::IndexCount { submesh, count } => write!(
                f,
                "submesh {submesh} has {count} indices, not a multiple of three: give triangles"
            ),
            Error::IndexRange { place, index, vertices } => {
                write!(f, "index {place} is {index}, but the mesh has {vertices} vertices")
            }
            Error::BadWidth(width) => {
                write!(f, "the width is {width}: give a finite number of at least 0")
            }
            Error::BadBreadth(share) => {
                write!(f, "the least breadth is {share}: give a share between 0 and 1")
            }
            Error::SubmeshRange { submesh, submeshes } => {
                write!(f, "chamfers are to go to submesh {submesh}, but the mesh has {submeshes}")
            }
            Error::TooLarge => {
                f.write_str("the chamfered mesh would not fit 32-bit indices: split the model")
            }
            Error::OutOfMemory => f.write_str("not enough memory for the chamfered mesh"),
            Error::Cancelled => f.write_str("cancelled by the progress callback"),
        }
    }
}
