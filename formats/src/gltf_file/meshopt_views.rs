//! Buffer views compressed by meshoptimizer, as `EXT_meshopt_compression` (2021) and its successor
//! `KHR_meshopt_compression` have them.

use serde_json::Value;

#[cfg(feature = "meshopt")]
pub use super::meshopt_codec::decode;

/// Both names of the extension; their contents are read alike.
pub const NAMES: [&str; 2] = ["EXT_meshopt_compression", "KHR_meshopt_compression"];

/// The extension on a buffer view.
pub fn on(view: &Value) -> Option<&Value> {
    NAMES.iter().find_map(|name| view.get("extensions")?.get(name))
}

/// Whether a buffer only stands in for what the views on it unpack to.
pub fn is_fallback(buffer: &Value) -> bool {
    on(buffer).and_then(|e| e.get("fallback")).and_then(Value::as_bool).unwrap_or(false)
}

/// Without the codec, what needs it cannot be read.
#[cfg(not(feature = "meshopt"))]
pub fn decode(_: &Value, _: &[u8], _: &str) -> anyhow::Result<Vec<u8>> {
    Err(crate::left_out::left_out("glTF that is compressed by meshopt", "meshopt"))
}
