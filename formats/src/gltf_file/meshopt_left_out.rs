//! Stands in for `meshopt_pack` in a build without it: nothing is compressed.

use anyhow::Result;

use crate::document::Encoded;

/// How a note ends that a file was compressed, but is no longer.
pub const WRITTEN_WITHOUT: &str = "and is written without";

/// Says that this build cannot.
///
/// # Errors
/// Always.
pub fn compress(_: &mut Encoded) -> Result<()> {
    Err(crate::left_out::left_out("or write geometry compressed by meshopt", "meshopt"))
}
