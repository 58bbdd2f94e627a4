//! What a caller can ask for.

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
    /// The distance between an old edge and the pulled one. The default is 1 % of the extent.
    pub width: Width,
    /// How much of the breadth of each face has to stay between its chamfers, as a share (0 to 1):
    /// where they meet, posts would become pencils. The default is a fifth.
    pub least_breadth: f32,
    /// How thoroughly the result is checked.
    pub verify: Verify,
    /// Which submesh the new triangles go to.
    pub chamfer_submesh: ChamferSubmesh,
    /// How many threads may work; 0 for as many as there are cores. The result is the same.
    pub threads: u32,
}

impl Default for Options {
    fn default() -> Self {
        Options {
            width: Width::PercentOfExtent(1.0),
            least_breadth: 0.2,
            verify: Verify::Full,
            chamfer_submesh: ChamferSubmesh::Owner,
            threads: 1,
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
        let set = [
            (default.with_width(width), Options { width, ..default }),
            (default.with_least_breadth(0.5), Options { least_breadth: 0.5, ..default }),
            (default.with_verify(Verify::Fast), Options { verify: Verify::Fast, ..default }),
            (default.with_chamfer_submesh(chamfer_submesh), Options { chamfer_submesh, ..default }),
            (default.with_threads(7), Options { threads: 7, ..default }),
        ];
        for (options, expected) in set {
            assert_eq!(options, expected);
        }
    }
}
