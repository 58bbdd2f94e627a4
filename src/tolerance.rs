//! Tolerances that several stages share, each with its reason.

/// Normals that differ by less than a degree are one normal: importers quantize them.
pub const HARD_COSINE: f64 = 0.999_847_695_156_391_2;

/// The same for any other angle: two normals that both differ from a third one by less than this
/// share of it differ by less than it.
pub const ALIKE_SHARE: f64 = 0.4;

/// Two normals that both differ from a third one by less than 0.4 degrees differ by less than one.
pub const ALIKE_COSINE: f64 = 0.999_975_630_705_4;

/// Two faces back to back: their normals are opposite to within a tenth of a degree. Between them
/// there is nothing to cut off.
pub const BACK_TO_BACK_COSINE: f64 = -0.999_998_476_913_288;

/// UV values that differ by less than this share of their size are one: exporters round.
pub const EQUAL_UV: f32 = 1e-6;
