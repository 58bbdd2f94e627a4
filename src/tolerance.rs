//! Tolerances: when two things count as one, or one as nothing, each with its reason.
//!
//! Lengths are in terms of the mesh: of its resolution, its extent, or the width. How often something
//! is tried, and how far, stands with the stage that tries.

/// Normals that differ by less than a degree are one normal: importers quantize them.
pub const HARD_COSINE: f64 = 0.999_847_695_156_391_2;

/// The same for any other angle: two normals that both differ from a third one by less than this
/// share of it differ by less than it.
pub const ALIKE_SHARE: f64 = 0.4;

/// Two normals that both differ from a third one by less than 0.4 degrees differ by less than one.
pub const ALIKE_COSINE: f64 = 0.999_975_630_705_4;

/// Normals of a round surface that differ by more than this are no noise, whatever else they do: twice
/// the sine of half of five degrees. Noise of one degree makes four of them.
pub const NOISE: f64 = 0.087_238_774_730_672_5;

/// Two differences of normals are one where they are off each other by no more than this share: noise
/// hits another difference so nearly once in a hundred times.
pub const NOISE_SHARE: f64 = 0.25;

/// Of a round surface each face is a chord, from whose normal that of the surface turns by less than
/// 45 degrees (twice the sine of half of them): a square has no more. What has no normal is farther off.
pub const CHORD_TURN: f64 = 0.765_366_864_730_179_6;

/// Two faces back to back: their normals are opposite to within a tenth of a degree. Between them
/// there is nothing to cut off.
pub const BACK_TO_BACK_COSINE: f64 = -0.999_998_476_913_288;

/// UV values that differ by less than this share of their size are one: exporters round.
pub const EQUAL_UV: f32 = 1e-6;

/// Faces that meet at more than five degrees would visibly bend if a vertex left their common
/// edge for one of them. A round surface of 72 facets or more is smooth enough to be cut across.
pub const CREASE_COSINE: f64 = 0.996_194_698_091_745_5;

/// Below a tenth of a degree a hard edge does not bend the surface by more than rounding does.
pub const FLAT_COSINE: f64 = 0.999_998_476_913_288;

/// Triangles that lean by less than half a degree from each other may lie in one plane: the corners
/// of a small one are rounded.
pub const LEVEL_COSINE: f64 = 0.999_961_923_064_171;

/// They do so if the corners of one are off the plane of the other by no more than this many times
/// the resolution: four millionths of the largest coordinate, which is what exporters round to.
pub const LEVEL_HEIGHT: f64 = 8.0;

/// Parts that were modelled to touch are off each other by what exporters round to: within this
/// share of the mesh's extent (a hundredth of a millimetre on a metre) they touch.
pub const TOUCHING: f64 = 1e-5;

/// As many times the resolution, if that is more: both parts are rounded.
pub const TOUCHING_STEPS: f64 = 2.0;

/// Faces that meet at less than half a degree lose nothing that one could see.
pub const FLAT_SINE: f64 = 0.01;

/// Faces whose directions about the edge differ by less than this (a hundredth of a degree) lie on
/// each other: there is no gap between them.
pub const SAME_DIRECTION: f64 = 1.0 - 1e-8;

/// Faces on two sides of an edge that bend there by less than five degrees are one surface that
/// runs on: what is less is no crease to the offsets either.
pub const RUNS_ON_COSINE: f64 = -0.996_194_698_091_745_5;

/// A triangle lower than this many times the resolution is a line: rounding its corners would
/// turn its normal by more than a degree.
pub const LINE_HEIGHT: f64 = 16.0;

/// A source triangle keeps at least this share of its area: less is a needle that shades badly.
pub const LEAST_AREA_SHARE: f64 = 0.01;

/// A source triangle may lean by at most 72 degrees from its old plane, so that it cannot flip.
pub const LEAST_UPRIGHT_COSINE: f64 = 0.3;

/// A new triangle faces its vertex normals by at least this cosine (87 degrees): the chamfer of a
/// knife's edge is that steep, and anything beyond would face inwards.
pub const LEAST_FACING_COSINE: f64 = 0.05;

/// Twice an area that is less than this share of the longest side squared is none: it is what
/// rounding leaves in double precision.
pub const LEAST_AREA: f64 = 1e-10;

/// Twice the area of a triangle is more than this share of its longest side squared, or single
/// precision cannot tell its normal.
pub const LEAST_SLENDERNESS: f64 = 1e-7;

/// Positions are single precision: two points closer than this many steps of the largest
/// coordinate cannot be told apart reliably.
pub const RESOLUTION_STEPS: f64 = 4.0;

/// Two points that were meant to be one are off each other by this share of the resolution at most: both
/// are rounded by half a step along each axis.
pub const LEAST_ROUNDING: f64 = 0.5;

/// Weights below this are rounding: a vertex that slides along an edge is on that edge.
pub const LEAST_WEIGHT: f64 = 1e-9;

/// Two diagonals fold alike if their cosines differ by less than rounding can explain.
pub const EQUAL_FOLD: f64 = 1e-6;

/// Blends whose distances differ by less than this share are equally near: then the first counts,
/// whatever the last bits say.
pub const EQUALLY_NEAR: f64 = 0.999;

/// Far more than double precision loses in a cross product.
pub const NEARLY_FLAT: f64 = 1e-9;

/// A chamfer that lies past the end of its chart by less than this share of its own length shows
/// nothing else: that is less than a texel.
pub const TEXTURE_MARGIN: f64 = 1e-4;

/// Rounding of UVs to single precision, as a share of their size.
pub const TEXTURE_ROUNDING: f64 = 1e-7;

/// Single precision, and a little for the arithmetic of exporters.
pub const EXPORTED_ROUNDING: f64 = 1e-6;

/// What is left of a direction across a normal is rounding if it is shorter than this share of it.
pub const LEAST_REST: f64 = 1e-3;

/// A stored tangent that is orthogonal up to the rounding of its components needs no repair.
pub const ORTHOGONAL: f64 = 1e-6;

/// A rim that runs along a side within a tenth of a degree does not lead away from it.
pub const LEAST_LEAN: f64 = 0.002;

/// Rounding of the angle between faces, as a cosine: a right angle counts as 90 degrees.
pub const ANGLE_ROUNDING: f64 = 1e-6;

/// A vertex slides along a border or crease that is at least this far (as a sine, 5.7 degrees)
/// from the direction of the chamfered edge; nearer, sliding hardly opens the edge.
pub const LEAST_SLIDE_SINE: f64 = 0.1;

/// A curve that turns by less than this, in radians, is straight: it bends by less than a
/// thousandth of its length.
pub const LEAST_TURN: f64 = 1e-3;

/// Between directions whose sine is less than this, the share of the turn is that of the way.
pub const LEAST_SLERP_SINE: f64 = 1e-6;

/// How much larger a turned box is than what it holds, in terms of where it lies: a thousand times
/// what rounding takes in double precision, so that what touches is never told apart.
pub const TURNED_BOX_SLACK: f64 = 1e-12;

/// A place past a side of a triangle by no more than this share of its height is as good as within: so
/// little farther on its normals turn by less than anybody sees.
pub const HARDLY_PAST: f64 = 1e-3;
