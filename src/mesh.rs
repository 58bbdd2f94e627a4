//! The mesh as callers hold it: flat arrays in the layout of Unity's `Mesh`.
//!
//! The same layout goes in ([`Mesh`], borrowed) and comes out ([`MeshBuffers`], owned), so that
//! what one call returns can be given to the next.

/// How many UV channels a mesh has room for.
pub const UV_CHANNELS: usize = 8;

/// A borrowed triangle mesh. An empty slice is an absent stream; every value is finite.
///
/// Triangles are wound so that `cross(b - a, c - a)` points outward, whatever the handedness of
/// the axes. A mesh without submeshes has no triangles.
#[derive(Clone, Copy, Debug, Default)]
pub struct Mesh<'a> {
    /// `#vertices by 3`, in mesh units.
    pub positions: &'a [[f32; 3]],
    /// `#vertices by 3`, unit length. Required: hard edges are found by them.
    pub normals: &'a [[f32; 3]],
    /// `#vertices by 4` or empty: a unit vector and the handedness, +1 or -1.
    pub tangents: &'a [[f32; 4]],
    /// `#vertices by 4` or empty: red, green, blue, alpha.
    pub colors: &'a [[f32; 4]],
    /// Up to eight channels, each `#vertices by components` or absent.
    pub uvs: [Uv<'a>; UV_CHANNELS],
    /// `#triangles by 3`, flattened: the triangles of all submeshes, one submesh after the other.
    pub indices: &'a [u32],
    /// `#submeshes`: how many of the indices belong to each.
    pub submesh_index_counts: &'a [u32],
    /// Where something outside of the mesh rests on it, such as another object of the scene.
    pub held: &'a [Held],
    /// How wide the chamfers of some edges are, in terms of the width asked for.
    pub factors: Factors<'a>,
}

/// How wide the chamfers of some edges are: how many times the width asked for. All that concern
/// one end of an edge multiply. An edge with factor 0 stays as it is.
#[derive(Clone, Copy, Debug, Default)]
pub struct Factors<'a> {
    /// `#submeshes` or empty. An edge between two submeshes has the smaller of their factors.
    pub submeshes: &'a [f32],
    /// `#vertices` or empty: a mask. An end of an edge has the mean over its two sides, and at least
    /// a sixteenth of the other end: a chamfer that tapered to a point could not be closed.
    pub vertices: &'a [f32],
    /// If not empty, the only edges that are chamfered.
    pub edges: &'a [EdgeFactor],
}

/// How wide the chamfer of one edge is.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C)]
pub struct EdgeFactor {
    /// Vertices at its ends, on either side of the edge and in either order.
    pub vertices: [u32; 2],
    /// How many times the width asked for.
    pub factor: f32,
}

/// A place where the surface of a mesh is not to be cut away: all that is within a radius of a
/// segment.
///
/// With radius 0 it is a line that rests on the surface, such as the open rim of another object:
/// chamfers are narrowed to leave what it lies on. With a larger one, hard edges that come nearer
/// stay as they are.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C)]
pub struct Held {
    /// Where the segment begins, in mesh units.
    pub from: [f32; 3],
    /// Where it ends; the same for a point.
    pub to: [f32; 3],
    /// In mesh units; below what counts as touching, a line rests there.
    pub radius: f32,
}

/// One UV channel of a [`Mesh`].
#[derive(Clone, Copy, Debug, Default)]
pub struct Uv<'a> {
    /// Floats per vertex: 2 to 4, or 0 where the channel is absent.
    pub components: u32,
    /// `#vertices by components`, flattened.
    pub values: &'a [f32],
}

/// An owned triangle mesh, stream by stream as in [`Mesh`]. An empty vector is an absent stream.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MeshBuffers {
    /// `#vertices by 3`, in mesh units.
    pub positions: Vec<[f32; 3]>,
    /// `#vertices by 3`, unit length.
    pub normals: Vec<[f32; 3]>,
    /// `#vertices by 4` or empty: a unit vector and the handedness, +1 or -1.
    pub tangents: Vec<[f32; 4]>,
    /// `#vertices by 4` or empty: red, green, blue, alpha.
    pub colors: Vec<[f32; 4]>,
    /// Each `#vertices by components` or absent.
    pub uvs: [UvBuffer; UV_CHANNELS],
    /// `#triangles by 3`, flattened, one submesh after the other.
    pub indices: Vec<u32>,
    /// `#submeshes`: how many of the indices belong to each.
    pub submesh_index_counts: Vec<u32>,
}

/// One UV channel of a [`MeshBuffers`].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct UvBuffer {
    /// Floats per vertex: 2 to 4, or 0 where the channel is absent.
    pub components: u32,
    /// `#vertices by components`, flattened.
    pub values: Vec<f32>,
}

impl MeshBuffers {
    /// The same mesh, borrowed.
    pub fn as_mesh(&self) -> Mesh<'_> {
        Mesh {
            positions: &self.positions,
            normals: &self.normals,
            tangents: &self.tangents,
            colors: &self.colors,
            uvs: self.uvs.each_ref().map(|uv| Uv { components: uv.components, values: &uv.values }),
            indices: &self.indices,
            submesh_index_counts: &self.submesh_index_counts,
            held: &[],
            factors: Factors::default(),
        }
    }
}

impl Mesh<'_> {
    /// A copy that owns its streams.
    pub fn to_buffers(&self) -> MeshBuffers {
        MeshBuffers {
            positions: self.positions.to_vec(),
            normals: self.normals.to_vec(),
            tangents: self.tangents.to_vec(),
            colors: self.colors.to_vec(),
            uvs: self
                .uvs
                .map(|uv| UvBuffer { components: uv.components, values: uv.values.to_vec() }),
            indices: self.indices.to_vec(),
            submesh_index_counts: self.submesh_index_counts.to_vec(),
        }
    }

    /// The largest side of the box around the vertices, in mesh units; 0 without vertices.
    pub fn extent(&self) -> f32 {
        let mut low = [f32::INFINITY; 3];
        let mut high = [f32::NEG_INFINITY; 3];
        for position in self.positions {
            for axis in 0..3 {
                low[axis] = low[axis].min(position[axis]);
                high[axis] = high[axis].max(position[axis]);
            }
        }
        (0..3).map(|axis| high[axis] - low[axis]).fold(0.0, f32::max)
    }
}
