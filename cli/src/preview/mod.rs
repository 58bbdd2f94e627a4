//! Pictures of a model before and after, drawn in software: no window, no graphics card.
//!
//! `scene` gathers the placed meshes, `camera` frames them, `raster` and `lines` find what
//! each sample sees, `shade` lights it, `tile` averages the samples, `layout` puts the tiles
//! side by side. Both tiles of a panel are seen by the same camera. The same panel gives the same
//! bytes; what cannot be drawn (no triangles, no extent, values that are not finite) is left out.

mod camera;
mod caption;
mod color;
mod layout;
mod lines;
mod raster;
mod scene;
mod shade;
mod tile;

use image::RgbImage;

pub use camera::TOWARD_EYE;
pub use layout::{LARGE_TILE, SMALL_TILE, before_after, contact_sheet, sheet, stacked, tiles};

/// A mesh and where it stands in the scene, whose up is +y.
pub struct Placed<'a> {
    /// The mesh. Without normals it is drawn flat.
    pub mesh: chamfer::Mesh<'a>,
    /// Column-major, from mesh to scene. It may mirror.
    pub transform: [[f32; 4]; 4],
}

/// One model, before and after.
#[derive(Default)]
pub struct Panel<'a> {
    /// What the model is called.
    pub caption: String,
    /// The left tile.
    pub before: Vec<Placed<'a>>,
    /// The right tile.
    pub after: Vec<Placed<'a>>,
    /// Drawn over the left tile; they do not count for the framing.
    pub before_lines: Vec<Line>,
    /// Drawn over the right tile, likewise.
    pub after_lines: Vec<Line>,
    /// What the left tile is called: "before", if nothing else.
    pub before_name: Option<String>,
    /// Further tiles on the right, and what each is called.
    pub further: Vec<(String, Vec<Placed<'a>>)>,
    /// What the right tile is called: "after", if nothing else.
    pub after_name: Option<String>,
    /// What the model seems to be made of.
    pub surface: Surface<'a>,
    /// A close-up instead of the whole model.
    pub zoom: Option<Zoom>,
    /// Seen from here instead, with faces from behind left out, as an engine does: from the model
    /// to the eye.
    pub toward_eye: Option<[f32; 3]>,
}

/// What a model seems to be made of.
#[derive(Clone, Copy, Default)]
pub enum Surface<'a> {
    /// Neutral matte clay.
    #[default]
    Clay,
    /// Clay multiplied by the vertex colors, which are linear.
    VertexColors,
    /// A checker of UV channel 0, for seeing where textures stretch. Clay where it is absent.
    Checker,
    /// This image by UV channel 0, repeated; v = 0 is its first row. Clay where it is absent.
    Texture(&'a RgbImage),
    /// What its own materials say, times the vertex colors.
    Own(&'a Wardrobe<'a>),
}

/// By place in [`Panel::before`] and submesh; clay where there is none. A submesh past the last is
/// like the last.
pub type Wardrobe<'a> = Vec<Vec<Coat<'a>>>;

/// What a material looks like.
#[derive(Clone, Copy, Debug)]
pub struct Coat<'a> {
    /// Red, green and blue, linear.
    pub color: [f32; 3],
    /// By UV channel 0, repeated.
    pub image: Option<&'a RgbImage>,
    /// Whether v = 0 is the last row of the image.
    pub flips: bool,
}

/// A colored segment in the scene. What is in front of it hides it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    /// Where it starts and ends, in scene units.
    pub ends: [[f32; 3]; 2],
    /// Red, green and blue as in an image file.
    pub color: [u8; 3],
}

/// A close-up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Zoom {
    /// How many times larger than the whole model; ignored unless finite and above 0.
    pub factor: f32,
    /// What to center, in scene units; otherwise the vertex of the left tile nearest to the eye.
    pub focus: Option<[f32; 3]>,
}
