//! What a call returns: the mesh, where each element came from, and what became of each edge.
//!
//! Why edges are not as wide as asked for: the one list of reasons. `tests/header.rs` holds that of
//! the C header to it, and `tests/package.rs` that of C#.

mod vertex_sources;

use std::ffi::CStr;
use std::ops::{Index, IndexMut};

use crate::mesh::MeshBuffers;

pub use vertex_sources::VertexSources;

/// A chamfered mesh with its provenance and verdicts.
#[derive(Clone, Debug, Default)]
#[non_exhaustive]
pub struct Chamfered {
    /// The mesh. Source vertices keep their indices and source triangles their order; what is new
    /// stands behind them, per submesh. Where a hard edge got vertices, the triangles beside it are
    /// in pieces: the first stands in the place of the source triangle, the others right behind all
    /// source triangles of the submesh, in the order of these. Vertices that come out equal in every stream are joined:
    /// a corner of a source triangle may then use the index of its equal, and its own vertex is
    /// left unused.
    pub mesh: MeshBuffers,
    /// `#vertices`: what each vertex was re-sampled from.
    pub vertex_sources: VertexSources,
    /// `#triangles`: what each triangle came from.
    pub triangle_sources: Vec<TriangleSource>,
    /// The triangles that are pieces of source triangles, in their order; mostly none.
    pub pieces: Vec<Piece>,
    /// `#hard edges`: what became of each. Those whose two sides share no edge, so that nothing can
    /// become of them, stand last ([`Reason::TJunction`], [`Reason::Winding`]).
    pub verdicts: Vec<EdgeVerdict>,
    /// The width asked for, in mesh units, or in those of [`Options::scale`](crate::Options::scale).
    pub width: f32,
    /// [`Options::scale`](crate::Options::scale), where it was given: widths are those of that space.
    pub scale: Option<[[f32; 3]; 3]>,
    /// [`Options::hard_angle`](crate::Options::hard_angle), where it was another than the default: what
    /// differs by less was no edge.
    pub hard_angle: Option<f32>,
    /// The largest width asked for of any edge, with all factors, in mesh units: no vertex goes
    /// farther than three of these. Under a scale that stretches axes unlike, along the longest one.
    pub largest_width: f32,
    /// Sums over the verdicts.
    pub totals: Totals,
}

/// A weighted mean of up to three source vertices. Unused places have weight 0.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct Blend {
    /// Source vertex indices.
    pub vertices: [u32; 3],
    /// Their weights, of sum 1. A weight may be negative where the vertex moved past a triangle.
    pub weights: [f32; 3],
}

impl Blend {
    /// Three source vertices with their weights, in single precision. No weight is a negative zero,
    /// which machines do not agree on.
    pub fn new(vertices: [u32; 3], weights: [f64; 3]) -> Blend {
        Blend { vertices, weights: weights.map(|weight| weight as f32 + 0.0) }
    }

    /// One source vertex, unblended.
    pub fn one(vertex: u32) -> Blend {
        Blend { vertices: [vertex; 3], weights: [1.0, 0.0, 0.0] }
    }
}

/// Where an output vertex came from: what each of its streams is a blend of.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct VertexSource {
    /// For what belongs to the surface: position, normal, skin weights, morph targets. The vertex
    /// in the middle of a fill of five or more points lies on no triangle of the source: its
    /// surface is what comes nearest, and does not rebuild its position and normal.
    pub surface: Blend,
    /// For what belongs to the vertex's own texture chart: colour, and the UV channels and tangent
    /// that `owner_channels` does not name.
    pub chart: Blend,
    /// A place in the chart that the chamfer continues over a seam. The same as `chart` where
    /// `owner_channels` is 0.
    pub owner: Blend,
    /// The UV channels that follow `owner`, as bits: channel `k` where bit `k` is set. The tangent
    /// goes with channel 0. Bit 31 says that the vertex lies on no face: see
    /// [`VertexSource::is_between`].
    pub owner_channels: u32,
}

impl VertexSource {
    /// The bit of `owner_channels` that [`VertexSource::is_between`] tells of.
    pub const BETWEEN: u32 = 1 << 31;

    /// Whether the vertex is on a rounded chamfer, and lies on no face: three source vertices do not
    /// rebuild its position and normal, which whoever does that takes from the result. Blends are
    /// right for what has to follow about there, such as skin weights and morph targets.
    pub fn is_between(&self) -> bool {
        self.owner_channels & VertexSource::BETWEEN != 0
    }

    /// A vertex whose streams are all of its own chart.
    pub fn new(surface: Blend, chart: Blend) -> VertexSource {
        VertexSource { surface, chart, owner: chart, owner_channels: 0 }
    }

    /// What a UV channel is a blend of. Channels past those of the core go with channel 0, as the
    /// tangent does.
    pub fn uv(&self, channel: usize) -> &Blend {
        let known = if channel < crate::mesh::UV_CHANNELS { channel } else { 0 };
        if self.owner_channels >> known & 1 == 1 { &self.owner } else { &self.chart }
    }

    /// What the tangent is a blend of.
    pub fn tangent(&self) -> &Blend {
        self.uv(0)
    }
}

/// What an output triangle came from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(C)]
pub struct TriangleSource {
    /// What the index counts.
    pub kind: TriangleKind,
    /// A source triangle, a verdict, or a source vertex: see [`TriangleKind`].
    pub index: u32,
}

/// What [`TriangleSource::index`] counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u32)]
pub enum TriangleKind {
    /// The triangle is the source triangle of that index, or one of several pieces of it.
    Source = 0,
    /// The triangle chamfers the hard edge whose verdict has that index.
    Edge = 1,
    /// The triangle fills the corner at the source vertex of that index.
    Corner = 2,
}

/// A triangle of the result that is a piece of a source triangle: a hard edge beside it got
/// vertices, because only a part of it has room for its chamfer, or because those of its other side
/// stand there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Piece {
    /// The triangle of the result.
    pub triangle: u32,
    /// Where its corners lay in the source triangle before anything moved, as weights of its
    /// corners. The pieces of a triangle cover it. A corner that is one of the source triangle's
    /// has the place that it had there, and so has a side that lies on one.
    pub corners: [[f32; 3]; 3],
}

/// What became of one hard edge.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct EdgeVerdict {
    /// The source vertices at its ends, on the side of the first triangle that uses it.
    pub vertices: [u32; 2],
    /// What became of it.
    pub outcome: Outcome,
    /// Why it is not at full width.
    pub reason: Reason,
    /// At each end, the mean of the distances from the old edge to its two pulled sides, in mesh
    /// units. In between, a chamfer may be wider where the edge got vertices.
    pub widths: [f32; 2],
    /// How many segments it has across: of its ends that opened, that of the one with fewer; 0 where
    /// it is skipped. Where more segments fold or cut, there are fewer than asked for.
    pub segments: u32,
}

/// What became of a hard edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u32)]
pub enum Outcome {
    /// Chamfered at the width asked for (an end inside a smooth area tapers to a point).
    Full = 0,
    /// Chamfered, but narrower somewhere, or not along all of its length.
    Narrowed = 1,
    /// Left as it was.
    Skipped = 2,
}

impl Outcome {
    /// A short name in lower case, for reports.
    pub fn name(self) -> &'static str {
        match self {
            Outcome::Full => "full",
            Outcome::Narrowed => "narrowed",
            Outcome::Skipped => "skipped",
        }
    }
}

/// Sums over the verdicts of a mesh.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Totals {
    /// Hard edges, with those whose two sides share no edge.
    pub hard_edges: u32,
    /// Those at full width.
    pub chamfered: u32,
    /// Those chamfered, but narrower somewhere.
    pub narrowed: u32,
    /// Those left as they were, by reason.
    pub skipped: ByReason,
    /// Mean width of the hard edges, as a share (0 to 1) of the width asked for, weighted by edge
    /// length; 0 without hard edges. Skipped edges have none; ends at which both sides stay put
    /// at any width do not count: where the edge runs out in a smooth area, at a T-junction, or
    /// where several creases hold the vertex.
    pub mean_width: f32,
    /// The length of all ends that count in the mean.
    pub(crate) counted: f64,
}

impl Totals {
    /// Those of another part of the mesh.
    pub(crate) fn add(&mut self, other: &Totals) {
        self.hard_edges += other.hard_edges;
        self.chamfered += other.chamfered;
        self.narrowed += other.narrowed;
        Reason::ALL.iter().for_each(|&reason| self.skipped[reason] += other.skipped[reason]);
        let counted = self.counted + other.counted;
        if counted > 0.0 {
            let got = [&*self, other].map(|part| f64::from(part.mean_width) * part.counted);
            self.mean_width = ((got[0] + got[1]) / counted) as f32;
        }
        self.counted = counted;
    }
}

macro_rules! reasons {
    ($($(#[$doc:meta])* $reason:ident = $number:literal, $name:literal;)*) => {
        /// Why a hard edge is narrower than asked for, or not chamfered.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
        #[non_exhaustive]
        #[repr(u32)]
        pub enum Reason {
            $($(#[$doc])* $reason = $number,)*
        }

        impl Reason {
            /// Every reason, in the order of their numbers.
            pub const ALL: &[Reason] = &[$(Reason::$reason),*];

            /// A short name in lower case with underscores, for C.
            pub(crate) fn c_name(self) -> &'static CStr {
                match self {
                    $(Reason::$reason => $name,)*
                }
            }
        }
    };
}

reasons! {
    /// It has full width.
    None = 0, c"none";
    /// A face beside it has no room: it would fold or lose its area.
    NoRoom = 1, c"no_room";
    /// The strip, or the fill at an end, would fold.
    Folds = 2, c"folds";
    /// An end lies in a corner so sharp that the full distance would shoot out as a spike.
    Miter = 3, c"miter";
    /// The chamfer would cut through the mesh.
    Intersects = 4, c"intersects";
    /// Nothing can be pulled at either end: both lie inside smooth areas or on borders.
    NoEnd = 5, c"no_end";
    /// The faces beside it lie back to back.
    ZeroThickness = 6, c"zero_thickness";
    /// A triangle beside it has no area.
    NoArea = 7, c"no_area";
    /// The width, or a face beside it, is too small for the precision of the positions here.
    TooFine = 8, c"too_fine";
    /// Something rests on the edge, or on a face right beside it: light would show behind a chamfer.
    Contact = 9, c"contact";
    /// It is not among the edges that were asked for, by angle, convexity, factor or list.
    NotSelected = 10, c"not_selected";
    /// A vertex of one side lies in the middle of the other: the surface is open along it, or closed by
    /// triangles without area.
    TJunction = 11, c"t_junction";
    /// A face beside it is wound against the other one, or against its own normals.
    Winding = 12, c"winding";
}

impl Reason {
    /// A short name in lower case with underscores, for reports.
    pub fn name(self) -> &'static str {
        self.c_name().to_str().unwrap_or_default()
    }
}

/// A count for each [`Reason`]: `counts[Reason::NoRoom]`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ByReason([u32; Reason::ALL.len()]);

impl ByReason {
    /// Each reason with its count, in the order of their numbers.
    pub fn iter(&self) -> impl Iterator<Item = (Reason, u32)> {
        Reason::ALL.iter().copied().zip(self.0)
    }

    /// Of all reasons together.
    pub fn total(&self) -> u32 {
        self.0.iter().sum()
    }
}

impl Index<Reason> for ByReason {
    type Output = u32;

    fn index(&self, reason: Reason) -> &u32 {
        &self.0[reason as usize]
    }
}

impl IndexMut<Reason> for ByReason {
    fn index_mut(&mut self, reason: Reason) -> &mut u32 {
        &mut self.0[reason as usize]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_count_up_and_names_differ() {
        for (number, reason) in Reason::ALL.iter().enumerate() {
            assert_eq!(*reason as usize, number);
            let same = Reason::ALL.iter().filter(|other| other.name() == reason.name());
            assert_eq!(same.count(), 1, "{reason:?}");
        }
    }

    #[test]
    fn counts_are_kept_by_reason() {
        let mut counts = ByReason::default();
        counts[Reason::NoRoom] += 2;
        counts[Reason::Contact] += 1;
        assert_eq!(counts.total(), 3);
        let named: Vec<_> = counts.iter().filter(|(_, count)| *count > 0).collect();
        assert_eq!(named, [(Reason::NoRoom, 2), (Reason::Contact, 1)]);
    }
}
