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
    /// The factors of submeshes, by submesh.
    SubmeshFactors,
    /// The factors of vertices.
    VertexFactors,
    /// The factors of listed edges, by their own number.
    EdgeFactors,
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
            Stream::SubmeshFactors => f.write_str("submesh factors"),
            Stream::VertexFactors => f.write_str("vertex factors"),
            Stream::EdgeFactors => f.write_str("edge factors"),
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
    /// The evenness is no share between 0 and 1.
    BadEvenness(f32),
    /// The number of segments is none of 1 to 32.
    BadSegments(u32),
    /// The profile is no share between 0 and 1.
    BadProfile(f32),
    /// An angle is out of its range.
    BadAngle {
        /// The option's name.
        option: &'static str,
        /// What it was given.
        degrees: f32,
        /// The largest that it may be; the least is 0.
        most: f32,
    },
    /// `min_angle` is larger than `max_angle`.
    AngleOrder {
        /// The first.
        min_angle: f32,
        /// The second.
        max_angle: f32,
    },
    /// The scale is not finite, or flattens the mesh.
    BadScale,
    /// A factor is negative, infinite or not a number.
    BadFactor {
        /// What it belongs to.
        stream: Stream,
        /// Its place among these.
        place: u32,
        /// What was given.
        factor: f32,
    },
    /// A listed edge is of a vertex that does not exist.
    EdgeRange {
        /// Its place in the list.
        edge: u32,
        /// The vertex.
        vertex: u32,
        /// How many there are.
        vertices: u32,
    },
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
            Error::BadEvenness(share) => {
                write!(f, "the evenness is {share}: give a share between 0 and 1")
            }
            Error::BadSegments(segments) => write!(
                f,
                "the number of segments is {segments}: give 1 to {}",
                crate::options::MOST_SEGMENTS
            ),
            Error::BadProfile(profile) => write!(
                f,
                "the profile is {profile}: give 0 (flat) to 1 (the old edge), 0.5 for a circle"
            ),
            Error::BadAngle { option, degrees, most } => {
                write!(f, "{option} is {degrees}: give degrees from 0 to {most}")
            }
            Error::AngleOrder { min_angle, max_angle } => write!(
                f,
                "min_angle {min_angle} is larger than max_angle {max_angle}: \
                 no edge could be chamfered"
            ),
            Error::BadScale => f.write_str(
                "the scale flattens the mesh or is not finite: give a matrix that can be inverted",
            ),
            Error::BadFactor { stream, place, factor } => write!(
                f,
                "{stream}: number {place} is {factor}: give a finite number of at least 0"
            ),
            Error::EdgeRange { edge, vertex, vertices } => write!(
                f,
                "listed edge {edge} is of vertex {vertex}, but the mesh has {vertices} vertices"
            ),
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
