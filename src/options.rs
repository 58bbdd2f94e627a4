//! What a caller can ask for.

/// The most segments that a chamfer can have across: a point in the middle of a fill with more would
/// not be seen on any screen.
pub const MOST_SEGMENTS: u32 = 32;

/// How to chamfer a mesh: the defaults, with what a caller wants otherwise.
///
/// ```
/// use chamfer::{Options, Verify, Width};
///
/// let options = Options::default().with_width(Width::Units(0.1)).with_verify(Verify::Fast);
/// assert_eq!(options.least_breadth, 0.2);
/// ```
///
/// Options may be added, so that callers cannot write them down as a literal:
///
/// ```compile_fail,E0639
/// let options = chamfer::Options { threads: 2, ..chamfer::Options::default() };
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Options {
    /// The distance between an old edge and the pulled one. The default is 0.5 % of the extent.
    pub width: Width,
    /// How much of the breadth of each face has to stay between its chamfers, as a share (0 to 1):
    /// where they meet, posts would become pencils. The default is a fifth.
    pub least_breadth: f32,
    /// How far the widths of a chamfer are held to each other, 0 (not at all) to 1 (one width for
    /// each edge): see [`with_evenness`](Options::with_evenness). The default is a half.
    pub evenness: f32,
    /// How thoroughly the result is checked.
    pub verify: Verify,
    /// Which submesh the new triangles go to.
    pub chamfer_submesh: ChamferSubmesh,
    /// How many threads may work; 0 for as many as there are cores. The result is the same.
    pub threads: u32,
    /// What the width measures.
    pub width_mode: WidthMode,
    /// Edges are chamfered whose faces meet at this angle at least, in degrees: 0 for a flat
    /// surface, 180 for one folded back on itself. The default is 0.
    pub min_angle: f32,
    /// The same at most. The default is 180.
    pub max_angle: f32,
    /// Which way the faces of chamfered edges meet.
    pub convexity: Convexity,
    /// Normals are one that differ by less than this, in degrees (above 0, up to 90). The default is
    /// 1: importers quantize them.
    pub hard_angle: f32,
    /// Where the three axes of the mesh go in the space in which widths, angles and planes are
    /// measured, such as that of the scene: a box that is stretched to a wall gets chamfers of one
    /// width there. It may mirror and shear, but not flatten. The default is the mesh as it is.
    pub scale: [[f32; 3]; 3],
    /// How many segments a chamfer has across (1 to 32). The default is 1, a flat one; more are
    /// rounded. Where so many would fold or cut, there are fewer.
    pub segments: u32,
    /// How a chamfer of several segments is bent: 0 is flat, 0.5 a circle, 1 the old edge. The
    /// default is 0.5.
    pub profile: f32,
}

impl Default for Options {
    fn default() -> Self {
        Options {
            width: Width::PercentOfExtent(0.5),
            least_breadth: 0.2,
            evenness: 0.5,
            verify: Verify::Full,
            chamfer_submesh: ChamferSubmesh::Owner,
            threads: 1,
            width_mode: WidthMode::Offset,
            min_angle: 0.0,
            max_angle: 180.0,
            convexity: Convexity::Both,
            hard_angle: 1.0,
            scale: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
            segments: 1,
            profile: 0.5,
        }
    }
}

impl Options {
    /// The same with another [`width`](Options::width).
    #[must_use]
    pub const fn with_width(self, width: Width) -> Options {
        Options { width, ..self }
    }

    /// The same with another [`least_breadth`](Options::least_breadth).
    #[must_use]
    pub const fn with_least_breadth(self, least_breadth: f32) -> Options {
        Options { least_breadth, ..self }
    }

    /// The same with another [`evenness`](Options::evenness). Where something is in the way of an
    /// end, the edge narrows by and by: at a half from the whole width to nothing within a hundred
    /// widths at most, and no side of an end is more than twice as wide as the other. At 1 all of an
    /// edge has one width, at 0 each end has all that there is room for.
    #[must_use]
    pub const fn with_evenness(self, evenness: f32) -> Options {
        Options { evenness, ..self }
    }

    /// The same with another [`verify`](Options::verify).
    #[must_use]
    pub const fn with_verify(self, verify: Verify) -> Options {
        Options { verify, ..self }
    }

    /// The same with another [`chamfer_submesh`](Options::chamfer_submesh).
    #[must_use]
    pub const fn with_chamfer_submesh(self, chamfer_submesh: ChamferSubmesh) -> Options {
        Options { chamfer_submesh, ..self }
    }

    /// The same with another number of [`threads`](Options::threads).
    #[must_use]
    pub const fn with_threads(self, threads: u32) -> Options {
        Options { threads, ..self }
    }

    /// The same with another [`width_mode`](Options::width_mode).
    #[must_use]
    pub const fn with_width_mode(self, width_mode: WidthMode) -> Options {
        Options { width_mode, ..self }
    }

    /// The same with another range of angles: [`min_angle`](Options::min_angle) and
    /// [`max_angle`](Options::max_angle).
    #[must_use]
    pub const fn with_angles(self, min_angle: f32, max_angle: f32) -> Options {
        Options { min_angle, max_angle, ..self }
    }

    /// The same with another [`convexity`](Options::convexity).
    #[must_use]
    pub const fn with_convexity(self, convexity: Convexity) -> Options {
        Options { convexity, ..self }
    }

    /// The same with another [`hard_angle`](Options::hard_angle).
    #[must_use]
    pub const fn with_hard_angle(self, hard_angle: f32) -> Options {
        Options { hard_angle, ..self }
    }

    /// The same with another [`scale`](Options::scale).
    #[must_use]
    pub const fn with_scale(self, scale: [[f32; 3]; 3]) -> Options {
        Options { scale, ..self }
    }

    /// The same with another number of [`segments`](Options::segments).
    #[must_use]
    pub const fn with_segments(self, segments: u32) -> Options {
        Options { segments, ..self }
    }

    /// The same with another [`profile`](Options::profile).
    #[must_use]
    pub const fn with_profile(self, profile: f32) -> Options {
        Options { profile, ..self }
    }
}

/// A chamfer width: the shortest distance between an old edge and the pulled one (the thesis'
/// chamfer scale is twenty times that).
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Width {
    /// In mesh units.
    Units(f32),
    /// In percent of the largest side of the mesh's box: 1.0 is a hundredth of it.
    PercentOfExtent(f32),
}

/// What the width of a chamfer measures, across an edge whose faces open by the angle `a`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum WidthMode {
    /// From the old edge to the pulled one, within the face: the same at each edge.
    Offset,
    /// Across the chamfer, from one pulled edge to the other: `2 sin(a / 2)` times the offset.
    Chord,
    /// From the old edge straight down to the chamfer: `cos(a / 2)` times the offset.
    Depth,
    /// Of the circle that touches both faces at the pulled edges: `tan(a / 2)` times the offset.
    Radius,
}

/// Which way the faces of an edge meet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Convexity {
    /// Either.
    Both,
    /// As those of a cube.
    Convex,
    /// As a wall and the floor of a room.
    Concave,
}

/// How thoroughly the result is checked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Verify {
    /// Nothing opens, flips or degenerates.
    Fast,
    /// As `Fast`, and no part of the mesh cuts through itself where it did not before.
    Full,
    /// As `Full`, and no light shows through it where none did before: it is looked at from many
    /// sides, and the edges around a place that leaks are left hard (see [`crate::see_through`]).
    Seen,
}

/// Which submesh the new triangles go to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum ChamferSubmesh {
    /// That of the face whose texture chart the chamfer continues.
    Owner,
    /// A new one behind all others.
    Own,
    /// The one with this number.
    Given(u32),
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_setter_sets_its_option_and_no_other() {
        let default = Options::default();
        let (width, chamfer_submesh) = (Width::Units(2.0), ChamferSubmesh::Given(3));
        let (chord, convexity) = (WidthMode::Chord, Convexity::Concave);
        let scale = [[2.0, 0.0, 0.0], [0.0, 3.0, 0.0], [0.0, 0.0, 1.0]];
        let set = [
            (default.with_width(width), Options { width, ..default }),
            (default.with_least_breadth(0.5), Options { least_breadth: 0.5, ..default }),
            (default.with_evenness(0.7), Options { evenness: 0.7, ..default }),
            (default.with_verify(Verify::Fast), Options { verify: Verify::Fast, ..default }),
            (default.with_chamfer_submesh(chamfer_submesh), Options { chamfer_submesh, ..default }),
            (default.with_threads(7), Options { threads: 7, ..default }),
            (default.with_width_mode(chord), Options { width_mode: chord, ..default }),
            (
                default.with_angles(5.0, 90.0),
                Options { min_angle: 5.0, max_angle: 90.0, ..default },
            ),
            (default.with_convexity(convexity), Options { convexity, ..default }),
            (default.with_hard_angle(2.0), Options { hard_angle: 2.0, ..default }),
            (default.with_scale(scale), Options { scale, ..default }),
            (default.with_segments(4), Options { segments: 4, ..default }),
            (default.with_profile(0.25), Options { profile: 0.25, ..default }),
        ];
        for (options, expected) in set {
            assert_eq!(options, expected);
        }
    }
}
