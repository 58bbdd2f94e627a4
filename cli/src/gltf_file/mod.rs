//! STUB, to be replaced by the glTF reader when that is merged.

use std::path::Path;

use anyhow::{Result, bail};
use chamfer::Chamfered;

use crate::document::{Document, Instance, OutputFile, ReadOptions, SourceMesh};

/// STUB.
pub struct GltfDocument;

impl GltfDocument {
    /// STUB.
    ///
    /// # Errors
    /// Always.
    pub fn read(_path: &Path, _options: &ReadOptions) -> Result<GltfDocument> {
        bail!("glTF is not read yet")
    }
}

impl Document for GltfDocument {
    fn meshes(&self) -> &[SourceMesh] {
        &[]
    }

    fn instances(&self) -> Vec<Instance> {
        Vec::new()
    }

    fn encode(&self, _output: &Path, _chamfered: &[Chamfered]) -> Result<Vec<OutputFile>> {
        Ok(Vec::new())
    }
}
