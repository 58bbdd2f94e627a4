//! Ways: how a patch can be laid on the texture of a face beside it, its owner.
//!
//! Strips and fills try those of their lists in turn, and take the first that fits, or else the one
//! that fits best. Of 65,000 chamfers of real models, 97 in 100 lie as they are or take the first.
//! Each of the others is the only one for some; a way that is not for ten of them is not worth its
//! lines.

/// A way to lay a patch onto its owner.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Way {
    /// On the band that a pulled edge has left free: the far side lands on the old edge.
    Band(Spread),
    /// Along the old edge, within the owner's triangle, as deep as the strip is wide.
    Inside,
    /// The same, past that triangle where it is too small.
    Abreast,
    /// Between the pulled corner and the old one.
    Kite(Wings),
    /// Flat, within the owner's triangle.
    Flat,
    /// Flat, within the triangle of the owner's chart that has the most room near by.
    Roomiest,
}

/// Where along the old edge the far corners of a strip land.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Spread {
    /// Below themselves, so that the texture is not sheared.
    Far,
    /// Below the pulled corners of the owner's side.
    Near,
    /// At its very ends.
    Whole,
    /// Below themselves, and only as deep as the strip is wide: between faces that meet like a knife
    /// the band is wider.
    Narrow,
}

/// Where the feet of a fill stand on its owner's two edges.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Wings {
    /// Below the pulled vertices beyond the edges, as those of the strips there.
    Far,
    /// So many times as far from the corner as below the owner's own pulled vertex.
    Near(f64),
}

/// The bands of a strip's one side, best first; then those of the other.
pub const BANDS: [Way; 4] = [
    Way::Band(Spread::Far),
    Way::Band(Spread::Near),
    Way::Band(Spread::Whole),
    Way::Band(Spread::Narrow),
];

/// What is left for a strip where no band fits: each on one side, and then on the other.
pub const BESIDE_BANDS: [Way; 4] = [Way::Inside, Way::Abreast, Way::Flat, Way::Roomiest];

/// The ways of a fill: each for every sector that could own it.
pub const FILL_WAYS: [Way; 4] =
    [Way::Kite(Wings::Far), Way::Kite(Wings::Near(1.0)), Way::Kite(Wings::Near(2.0)), Way::Flat];
