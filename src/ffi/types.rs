//! The vocabulary of the C header: constants and structs, free of the rest of the crate.
//!
//! Names are those of the header, so that both sides search for the same word. Structs hold
//! fixed-width numbers and pointers only. A struct that callers fill starts with its own size and
//! grows at its end; the others are array elements and never change within one ABI version.

#![allow(non_camel_case_types)]

use core::ffi::{c_char, c_void};

/// The version of this interface that the header describes. A program checks that
/// `chamfer_abi_version` gives the same before it calls anything else.
pub const CHAMFER_ABI_VERSION: u32 = 1;

/// The call did what was asked.
pub const CHAMFER_STATUS_OK: i32 = 0;
/// The progress callback asked to stop.
pub const CHAMFER_STATUS_CANCELLED: i32 = 1;

/// A pointer that is needed is NULL.
pub const CHAMFER_STATUS_NULL_POINTER: i32 = 100;
/// A pointer is not aligned for what it points to.
pub const CHAMFER_STATUS_MISALIGNED: i32 = 101;
/// A `struct_size` is no size that this library knows, or fields that it does not know are set.
pub const CHAMFER_STATUS_STRUCT_SIZE: i32 = 102;
/// A count asks for an array that does not fit the address space.
pub const CHAMFER_STATUS_COUNT_OVERFLOW: i32 = 103;
/// The width is negative, infinite or not a number.
pub const CHAMFER_STATUS_BAD_WIDTH: i32 = 104;
/// An option holds none of its constants, or is out of its range.
pub const CHAMFER_STATUS_BAD_OPTION: i32 = 105;
/// The submesh that chamfers are to go to does not exist. Element: that submesh.
pub const CHAMFER_STATUS_SUBMESH_RANGE: i32 = 106;
/// The angle is not between 0 and 180 degrees.
pub const CHAMFER_STATUS_BAD_ANGLE: i32 = 107;
/// The place for the result or for the error lies in the mesh. Neither is written.
pub const CHAMFER_STATUS_OVERLAP: i32 = 108;
/// An object of a scene is of a mesh that does not exist. Element: the object.
pub const CHAMFER_STATUS_OBJECT_MESH: i32 = 109;
/// The transform of an object is infinite or not a number. Element: the object.
pub const CHAMFER_STATUS_BAD_TRANSFORM: i32 = 110;

/// The mesh has no normals.
pub const CHAMFER_STATUS_MISSING_NORMALS: i32 = 200;
/// A stream has another length than the positions.
pub const CHAMFER_STATUS_STREAM_LENGTH: i32 = 201;
/// A UV channel is neither absent nor 2 to 4 wide. Element: the channel.
pub const CHAMFER_STATUS_UV_COMPONENTS: i32 = 202;
/// A value is infinite or not a number. Element: the vertex.
pub const CHAMFER_STATUS_NOT_FINITE: i32 = 203;
/// The submesh index counts do not add up to the index count.
pub const CHAMFER_STATUS_INDEX_TOTAL: i32 = 204;
/// A submesh's index count is not a multiple of three. Element: the submesh.
pub const CHAMFER_STATUS_INDEX_COUNT: i32 = 205;
/// An index points past the last vertex. Element: its place among the indices.
pub const CHAMFER_STATUS_INDEX_RANGE: i32 = 206;
/// A factor is negative, infinite or not a number. Element: its place.
pub const CHAMFER_STATUS_BAD_FACTOR: i32 = 207;
/// A listed edge is of a vertex that does not exist. Element: its place in the list.
pub const CHAMFER_STATUS_EDGE_RANGE: i32 = 208;

/// The result would not fit 32-bit indices.
pub const CHAMFER_STATUS_TOO_LARGE: i32 = 300;
/// Memory for the result could not be had.
pub const CHAMFER_STATUS_OUT_OF_MEMORY: i32 = 301;

/// A fault of this library, caught at its border: please report it.
pub const CHAMFER_STATUS_INTERNAL: i32 = 900;

/// The `element` of an error that concerns no single element.
pub const CHAMFER_NO_ELEMENT: u32 = u32::MAX;

/// How many bytes an error message has room for, the final NUL included.
pub const CHAMFER_MESSAGE_SIZE: usize = 256;

/// How many UV channels a mesh has room for.
pub const CHAMFER_UV_CHANNELS: usize = 8;

/// `width_unit`: the width is in mesh units.
pub const CHAMFER_WIDTH_MESH_UNITS: u32 = 0;
/// `width_unit`: the width is in percent of the largest side of the mesh's box.
pub const CHAMFER_WIDTH_PERCENT: u32 = 1;

/// `width_mode`: from the old edge to the pulled one, within the face.
pub const CHAMFER_WIDTH_OFFSET: u32 = 0;
/// `width_mode`: across the chamfer, from one pulled edge to the other.
pub const CHAMFER_WIDTH_CHORD: u32 = 1;
/// `width_mode`: from the old edge straight down to the chamfer.
pub const CHAMFER_WIDTH_DEPTH: u32 = 2;
/// `width_mode`: of the circle that touches both faces at the pulled edges.
pub const CHAMFER_WIDTH_RADIUS: u32 = 3;

/// `convexity`: edges of both kinds are chamfered.
pub const CHAMFER_CONVEXITY_BOTH: u32 = 0;
/// `convexity`: only those whose faces meet as those of a cube.
pub const CHAMFER_CONVEXITY_CONVEX: u32 = 1;
/// `convexity`: only those whose faces meet as a wall and the floor of a room.
pub const CHAMFER_CONVEXITY_CONCAVE: u32 = 2;

/// `verify`: nothing opens, flips or degenerates.
pub const CHAMFER_VERIFY_FAST: u32 = 0;
/// `verify`: also, no part of the mesh cuts through itself where it did not before.
pub const CHAMFER_VERIFY_FULL: u32 = 1;
/// `verify`: also, no light shows through the mesh where none did before, seen from many sides.
pub const CHAMFER_VERIFY_SEEN: u32 = 2;

/// `submesh_mode`: new triangles go to the submesh of the face whose texture chart they continue.
pub const CHAMFER_SUBMESH_OWNER: u32 = 0;
/// `submesh_mode`: new triangles go to a new submesh behind all others.
pub const CHAMFER_SUBMESH_OWN: u32 = 1;
/// `submesh_mode`: new triangles go to the submesh that the field `submesh` names.
pub const CHAMFER_SUBMESH_GIVEN: u32 = 2;

/// `outcome`: chamfered at the width asked for.
pub const CHAMFER_OUTCOME_FULL: u32 = 0;
/// `outcome`: chamfered, but narrower somewhere.
pub const CHAMFER_OUTCOME_NARROWED: u32 = 1;
/// `outcome`: left as it was.
pub const CHAMFER_OUTCOME_SKIPPED: u32 = 2;

/// `reason`: the edge has full width.
pub const CHAMFER_REASON_NONE: u32 = 0;
/// `reason`: a face beside the edge has no room, it would fold or lose its area.
pub const CHAMFER_REASON_NO_ROOM: u32 = 1;
/// `reason`: the strip, or the fill at an end, would fold.
pub const CHAMFER_REASON_FOLDS: u32 = 2;
/// `reason`: an end lies in a corner so sharp that the full distance would shoot out as a spike.
pub const CHAMFER_REASON_MITER: u32 = 3;
/// `reason`: the chamfer would cut through the mesh.
pub const CHAMFER_REASON_INTERSECTS: u32 = 4;
/// `reason`: nothing can be pulled at either end, both lie inside smooth areas or on borders.
pub const CHAMFER_REASON_NO_END: u32 = 5;
/// `reason`: the faces beside the edge lie back to back.
pub const CHAMFER_REASON_ZERO_THICKNESS: u32 = 6;
/// `reason`: a triangle beside the edge has no area.
pub const CHAMFER_REASON_NO_AREA: u32 = 7;
/// `reason`: the width, or a face beside it, is too small for the precision of the positions here.
pub const CHAMFER_REASON_TOO_FINE: u32 = 8;
/// `reason`: something rests on the edge, or right beside it; light would show behind a chamfer.
pub const CHAMFER_REASON_CONTACT: u32 = 9;
/// `reason`: the edge is not among those that were asked for, by angle, convexity, factor or list.
pub const CHAMFER_REASON_NOT_SELECTED: u32 = 10;
/// `reason`: a vertex of one side lies in the middle of the other; the surface is open along it,
/// or closed by triangles without area.
pub const CHAMFER_REASON_T_JUNCTION: u32 = 11;
/// `reason`: a face beside the edge is wound against the other one, or against its own normals.
pub const CHAMFER_REASON_WINDING: u32 = 12;

/// How many reasons `skipped_by_reason` has room for: more than there are, so that reasons can be
/// added.
pub const CHAMFER_REASON_SLOTS: usize = 16;

/// `kind`: the triangle is the source triangle of that index.
pub const CHAMFER_TRIANGLE_SOURCE: u32 = 0;
/// `kind`: the triangle chamfers the hard edge whose verdict has that index.
pub const CHAMFER_TRIANGLE_EDGE: u32 = 1;
/// `kind`: the triangle fills the corner at the source vertex of that index.
pub const CHAMFER_TRIANGLE_CORNER: u32 = 2;

/// `owner_channels`: the bit of a vertex on a rounded chamfer that lies on no face of the source.
pub const CHAMFER_VERTEX_BETWEEN: u32 = 0x8000_0000;

/// One UV channel of a mesh.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct chamfer_uv {
    /// Floats per vertex: 2 to 4, or 0 where the channel is absent.
    pub components: u32,
    /// `#vertices by components`; ignored where the channel is absent.
    pub values: *const f32,
}

/// A triangle mesh, vertex streams first, as the engines hold it. An absent stream is NULL. The
/// library reads the arrays during the call only, and never writes them.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct chamfer_mesh {
    /// `sizeof(chamfer_mesh)`.
    pub struct_size: u32,
    /// How many vertices each stream has.
    pub vertex_count: u32,
    /// `#vertices by 3`, in mesh units.
    pub positions: *const f32,
    /// `#vertices by 3`, unit length. Hard edges are found by them.
    pub normals: *const f32,
    /// `#vertices by 4` or NULL: a unit vector and the handedness, +1 or -1.
    pub tangents: *const f32,
    /// `#vertices by 4` or NULL: red, green, blue, alpha.
    pub colors: *const f32,
    /// The UV channels.
    pub uvs: [chamfer_uv; CHAMFER_UV_CHANNELS],
    /// How many submeshes the triangles are divided into.
    pub submesh_count: u32,
    /// How many indices there are in all submeshes together.
    pub index_count: u32,
    /// `#submeshes`: how many of the indices belong to each, a multiple of three.
    pub submesh_index_counts: *const u32,
    /// `#triangles by 3`: the triangles of all submeshes, one submesh after the other.
    pub indices: *const u32,
    /// How many places are held.
    pub held_count: u32,
    /// `#held`, or NULL: where something outside of the mesh rests on it. Results hold none.
    pub held: *const chamfer_held,
    /// `#submeshes` or NULL: how many times the width the chamfers of each get; 0 leaves its edges
    /// as they are. An edge between two submeshes has the smaller of their factors. Results have no
    /// factors.
    pub submesh_factors: *const f32,
    /// `#vertices` or NULL: a mask. An end of an edge has the mean over its two sides, and at least a
    /// sixteenth of the other end.
    pub vertex_factors: *const f32,
    /// How many edges are listed.
    pub edge_factor_count: u32,
    /// `#listed`, or NULL. Where some are, only these are chamfered. All factors that concern one
    /// end of an edge multiply.
    pub edge_factors: *const chamfer_edge_factor,
}

/// How wide the chamfer of one edge is.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct chamfer_edge_factor {
    /// Vertices at its ends, on either side of the edge and in either order.
    pub vertices: [u32; 2],
    /// How many times the width asked for; 0 leaves the edge as it is.
    pub factor: f32,
}

/// A place where the surface of a mesh is not to be cut away: all within a radius of a segment.
///
/// With radius 0 it is a line that rests on the surface, such as the open rim of another object of
/// the scene: chamfers are narrowed to leave what it lies on. With a larger one, hard edges stay
/// as they are where they come nearer.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct chamfer_held {
    /// Where the segment begins, in mesh units.
    pub from: [f32; 3],
    /// Where it ends; the same for a point.
    pub to: [f32; 3],
    /// In mesh units.
    pub radius: f32,
}

/// A mesh that stands somewhere in a scene. One mesh may stand there several times.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct chamfer_object {
    /// Its number among the meshes of the scene.
    pub mesh: u32,
    /// From mesh to scene, column by column; the last row is taken for 0, 0, 0, 1. It may mirror.
    /// An object that it flattens is not there for the others.
    pub transform: [f32; 16],
}

/// How to chamfer a mesh. `chamfer_options_init` fills in the defaults. One in which all but the size is
/// zero stands for them too; where anything else is set, all fields count as they are.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct chamfer_options {
    /// `sizeof(chamfer_options)`.
    pub struct_size: u32,
    /// The distance between an old edge and the pulled one, in `width_unit`. Default: half a percent.
    pub width: f32,
    /// One of `CHAMFER_WIDTH_MESH_UNITS`, `CHAMFER_WIDTH_PERCENT` (default).
    pub width_unit: u32,
    /// One of `CHAMFER_VERIFY_FAST`, `CHAMFER_VERIFY_FULL` (default), `CHAMFER_VERIFY_SEEN`.
    pub verify: u32,
    /// One of `CHAMFER_SUBMESH_OWNER` (default), `CHAMFER_SUBMESH_OWN`, `CHAMFER_SUBMESH_GIVEN`.
    pub submesh_mode: u32,
    /// With `CHAMFER_SUBMESH_GIVEN`, the submesh that new triangles go to; else ignored.
    pub submesh: u32,
    /// How many threads may work; 0 for as many as there are cores. Default: 1. The result is the
    /// same.
    pub threads: u32,
    /// How much of the breadth of each face has to stay between its chamfers, as a share up to 1.
    /// 0 for the default, a fifth; a tiny share for nothing.
    pub least_breadth: f32,
    /// One of `CHAMFER_WIDTH_OFFSET` (default), `_CHORD`, `_DEPTH`, `_RADIUS`.
    pub width_mode: u32,
    /// Edges are chamfered whose faces meet at this angle at least, in degrees: 0 (default) for a
    /// flat surface, 180 for one folded back on itself.
    pub min_angle: f32,
    /// The same at most. 0 for the default, 180.
    pub max_angle: f32,
    /// One of `CHAMFER_CONVEXITY_BOTH` (default), `_CONVEX`, `_CONCAVE`.
    pub convexity: u32,
    /// Normals are one that differ by less than this, in degrees up to 90. 0 for the default, 1.
    pub hard_angle: f32,
    /// Where the three axes of the mesh go in the space in which widths, angles and planes are
    /// measured, such as that of the scene. It may mirror and shear, but not flatten. All 0 for the
    /// default, the mesh as it is.
    pub scale: [f32; 9],
    /// How far the widths of a chamfer are held to each other: up to 1, one width for each edge. 0
    /// for the default, a half; a tiny share for not at all.
    pub evenness: f32,
    /// How many segments a chamfer has across: 1 (flat) to 32. 0 for the default, 1.
    pub segments: u32,
    /// How a chamfer of several segments is bent: towards 0 flat, 0.5 a circle, 1 the old edge. 0 for
    /// the default, 0.5; a tiny share for a flat one.
    pub profile: f32,
}

/// What went wrong, in detail. Callers set `struct_size`; a call fills in the rest, also when it
/// succeeds.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct chamfer_error {
    /// `sizeof(chamfer_error)`.
    pub struct_size: u32,
    /// The status that the call returned.
    pub status: i32,
    /// The element at fault; the status says what it counts. `CHAMFER_NO_ELEMENT` if none.
    pub element: u32,
    /// One English sentence in UTF-8, ended by NUL: the element, the rule, what to do. Empty on
    /// success.
    pub message: [c_char; CHAMFER_MESSAGE_SIZE],
    /// The mesh at fault, where there are several. `CHAMFER_NO_ELEMENT` if none.
    pub mesh: u32,
}

/// Sums over the verdicts of a result.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct chamfer_totals {
    /// `sizeof(chamfer_totals)`.
    pub struct_size: u32,
    /// Hard edges, with those whose two sides share no edge.
    pub hard_edges: u32,
    /// Those at full width.
    pub chamfered: u32,
    /// Those chamfered, but narrower somewhere.
    pub narrowed: u32,
    /// Those left as they were.
    pub skipped: u32,
    /// The width asked for, in mesh units.
    pub width: f32,
    /// Mean width of the hard edges, as a share (0 to 1) of the width asked for, weighted by edge
    /// length; 0 without hard edges. Skipped edges have none; ends at which both sides stay put
    /// at any width do not count: where the edge runs out in a smooth area, at a T-junction, or
    /// where several creases hold the vertex.
    pub mean_width: f32,
    /// The skipped edges by reason; places past the last reason are 0.
    pub skipped_by_reason: [u32; CHAMFER_REASON_SLOTS],
}

/// What became of one hard edge.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct chamfer_edge_verdict {
    /// The source vertices at its ends, on the side of the first triangle that uses it.
    pub vertices: [u32; 2],
    /// One of `CHAMFER_OUTCOME_*`.
    pub outcome: u32,
    /// Why it is not at full width: one of `CHAMFER_REASON_*`.
    pub reason: u32,
    /// At each end, the mean of the distances from the old edge to its two pulled sides, in mesh
    /// units.
    pub widths: [f32; 2],
    /// How many segments it has across, at the end that has fewer; 0 where it is skipped.
    pub segments: u32,
}

/// A weighted mean of up to three source vertices.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct chamfer_blend {
    /// Source vertex indices.
    pub vertices: [u32; 3],
    /// Their weights, of sum 1; 0 in unused places, negative where a vertex moved past a triangle.
    pub weights: [f32; 3],
}

/// What an output vertex was re-sampled from. With it, callers carry streams of their own.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct chamfer_vertex_source {
    /// For what belongs to the surface: position, normal, skin weights, morph targets.
    pub surface: chamfer_blend,
    /// For what belongs to the vertex's own texture chart: colour, and the UV channels and tangent
    /// that `owner_channels` does not name.
    pub chart: chamfer_blend,
    /// A place in the chart that the chamfer continues over a seam; the same as `chart` where
    /// `owner_channels` is 0.
    pub owner: chamfer_blend,
    /// The UV channels that follow `owner`: channel `k` where bit `k` is set. The tangent goes with
    /// channel 0. With `CHAMFER_VERTEX_BETWEEN` the vertex is on a rounded chamfer and on no face:
    /// its blends do not rebuild its position and normal.
    pub owner_channels: u32,
}

/// What an output triangle came from.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct chamfer_triangle_source {
    /// What `index` counts: one of `CHAMFER_TRIANGLE_*`.
    pub kind: u32,
    /// A source triangle, a verdict, or a source vertex.
    pub index: u32,
}

/// Called on the calling thread with the share done (0 to 1). A result other than 0 cancels. It
/// must return to its caller: no exception, no `longjmp`.
pub type chamfer_progress = Option<unsafe extern "C" fn(user: *mut c_void, done: f32) -> i32>;
