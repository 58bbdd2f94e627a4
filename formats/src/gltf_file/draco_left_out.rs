//! Stands in for `draco_mesh` in a build without it: nothing is unpacked.

use anyhow::{Result, bail};

use super::element::{Component, Shape, Stream};

/// The name of the extension.
pub const NAME: &str = "KHR_draco_mesh_compression";

/// A mesh that was unpacked: there is none.
pub struct DracoMesh;

impl DracoMesh {
    pub fn decode(_: &[u8], _: usize) -> Result<DracoMesh> {
        Err(crate::left_out::left_out("glTF that is compressed by Draco", "draco"))
    }

    pub fn indices(&self) -> Result<Vec<u32>> {
        bail!("nothing was unpacked")
    }

    pub fn attribute(&self, _: u32, _: Component, _: Shape) -> Result<Stream> {
        bail!("nothing was unpacked")
    }
}
