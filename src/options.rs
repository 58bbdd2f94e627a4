//! What a caller can ask for.

/// How to chamfer a mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
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

/// A chamfer width: the shortest distance between an old edge and the pulled one (the thesis'
/// chamfer scale is twenty times that).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Width {
    /// In mesh units.
    Units(f32),
    /// In percent of the largest side of the mesh's box: 1.0 is a hundredth of it.
    PercentOfExtent(f32),
}

/// How thoroughly the result is checked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
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
pub enum ChamferSubmesh {
    /// That of the face whose texture chart the chamfer continues.
    Owner,
    /// A new one behind all others.
    Own,
    /// The one with this number.
    Given(u32),
}
