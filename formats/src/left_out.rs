//! What this build cannot read, as it was made without all its features.

use anyhow::{Error, anyhow};

/// The error of a file that needs a reader that was left out.
pub fn left_out(what: &str, feature: &str) -> Error {
    anyhow!(
        "this build cannot read {what}: build it with the feature {feature}, which is on by default"
    )
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use crate::{ReadOptions, decode};

    #[cfg(not(feature = "fbx"))]
    #[test]
    fn a_file_that_needs_a_reader_says_which() {
        let told = decode(Path::new("a.fbx"), vec![b' '; 40], &ReadOptions::default());
        let told = format!("{:#}", told.err().unwrap());
        assert!(told.contains("cannot read FBX: build it with the feature fbx"), "{told}");
    }
}
