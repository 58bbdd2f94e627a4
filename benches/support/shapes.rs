//! The worst shapes, and how large.

use chamfer::{MeshBuffers, shapes};

use crate::worst;

/// A shape of that size.
pub type Make = fn(u32) -> MeshBuffers;

/// The larger of the two sizes, in what the shape counts.
pub const SHAPES: &[(&str, u32, Make)] = &[
    ("flat fan", 100_000, |size| worst::fan(size, true)),
    ("smooth fan", 100_000, |size| worst::fan(size, false)),
    ("pyramid", 100_000, shapes::pyramid),
    ("book", 10_000, worst::book),
    ("point", 100_000, worst::point),
    ("stack", 10_000, worst::stack),
    ("moebius strip", 25_000, worst::moebius_strip),
    ("klein bottle", 3_000, worst::klein_bottle),
    // A million borders, each of which may rest on something.
    ("posts", 125_000, worst::posts),
    ("spikes", 12_000, worst::spikes),
    ("star cone", 18_000, worst::star_cone),
    ("gear cone", 9_000, worst::gear_cone),
    ("star wheel", 9_000, worst::star_wheel),
    ("comb", 9_000, worst::comb),
    ("wedges", 4_000, worst::wedges),
    ("turned quads", 25_000, worst::turned_quads),
    // So many quads each way.
    ("hills", 300, |size| worst::terrain(size, false)),
    ("hills with a texture", 300, |size| worst::terrain(size, true)),
    // So many holes each way.
    ("sieve", 316, worst::sieve),
    ("disc", 100_000, shapes::prism),
    ("bar", 12_500, worst::bar),
    ("slivers", 8_000, worst::slivers),
    ("huge cubes", 8_000, |size| worst::placed(shapes::cube_field(size), 1e30, 0.0)),
    ("tiny cubes", 8_000, |size| worst::placed(shapes::cube_field(size), 1e-30, 0.0)),
    ("denormal cubes", 8_000, |size| worst::placed(shapes::cube_field(size), 1e-42, 0.0)),
    ("far cubes", 8_000, |size| worst::placed(shapes::cube_field(size), 1.0, 1e6)),
];
