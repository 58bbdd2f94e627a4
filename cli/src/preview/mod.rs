//! STUB, to be replaced by the renderer when that is merged.

use image::RgbImage;

/// A mesh and where it stands in the picture's scene.
pub struct Placed<'a> {
    /// The mesh.
    pub mesh: chamfer::Mesh<'a>,
    /// Column-major, from mesh to scene.
    pub transform: [[f32; 4]; 4],
}

/// One model before and after.
#[derive(Default)]
pub struct Panel<'a> {
    /// What to write under it.
    pub caption: String,
    /// The model as it was.
    pub before: Vec<Placed<'a>>,
    /// The model chamfered.
    pub after: Vec<Placed<'a>>,
    /// STUB for the fields to come.
    pub zoom: Option<f32>,
}

/// STUB.
pub fn before_after(_panel: &Panel) -> RgbImage {
    RgbImage::new(2, 1)
}

/// STUB.
pub fn contact_sheet(panels: &[Panel]) -> RgbImage {
    RgbImage::new(2, panels.len().max(1) as u32)
}
