//! The pictures of a run.

use std::io::Cursor;
use std::path::Path;

use anyhow::{Context, Result};
use chamfer::{Chamfered, MeshBuffers};
use chamfer_formats::Document;
use image::{ImageFormat, RgbImage};

use crate::args::Args;
use crate::preview::{LARGE_TILE, Line, Panel, SMALL_TILE, before_after, sheet};
use crate::scene::placed;
use crate::verdict_lines::{self, Legend};
use crate::write;

/// How many models a contact sheet shows: more make a picture that viewers refuse to open.
pub const MOST_ROWS: usize = 24;

/// How the models of a run are drawn.
pub struct Studio {
    /// Pixels per side of a tile.
    tile: u32,
    verdicts: bool,
}

/// A model before and after, as a PNG: many wait for the sheet.
pub struct Portrait(Vec<u8>);

impl Studio {
    /// One model alone is drawn larger than many; none where nobody asks for pictures.
    pub fn new(args: &Args, models: usize) -> Option<Studio> {
        let tile = if models == 1 { LARGE_TILE } else { SMALL_TILE };
        args.preview.as_ref().map(|_| Studio { tile, verdicts: args.preview_verdicts })
    }

    /// Draws a model.
    ///
    /// # Errors
    /// Where the picture cannot be encoded.
    pub fn draw(
        &self,
        caption: String,
        document: &dyn Document,
        chamfered: &[Chamfered],
    ) -> Result<Portrait> {
        let mut panel = Panel {
            caption,
            before: placed(document, |mesh| &document.meshes()[mesh].mesh),
            after: placed(document, |mesh| &chamfered[mesh].mesh),
            ..Panel::default()
        };
        if self.verdicts {
            add_verdicts(&mut panel, document, chamfered);
        }
        Ok(Portrait(png(&before_after(&panel, self.tile))?))
    }
}

fn add_verdicts(panel: &mut Panel, document: &dyn Document, chamfered: &[Chamfered]) {
    for instance in document.instances() {
        let (before, after) = (&document.meshes()[instance.mesh], &chamfered[instance.mesh]);
        let of = |lines: Lines| lines(&before.mesh, after, instance.transform);
        panel.before_lines.extend(of(verdict_lines::before));
        panel.after_lines.extend(of(verdict_lines::after));
    }
    let mut legend = Legend::default();
    chamfered.iter().for_each(|result| legend.add(result));
    panel.caption = format!("{}: {}", panel.caption, legend.text());
}

type Lines = fn(&MeshBuffers, &Chamfered, [[f32; 4]; 4]) -> Vec<Line>;

/// Writes the models to a file: one alone, several as a contact sheet.
///
/// # Errors
/// Where the file cannot be written.
pub fn write_sheet(path: &Path, portraits: &[Portrait]) -> Result<()> {
    if let [Portrait(alone)] = portraits {
        return write::alone(path, alone.clone());
    }
    let rows =
        portraits.iter().map(|portrait| Ok(image::load_from_memory(&portrait.0)?.into_rgb8()));
    write_png(path, &sheet(&rows.collect::<Result<Vec<_>>>()?))
}

/// Writes a picture.
///
/// # Errors
/// Where the file cannot be written.
pub fn write_png(path: &Path, picture: &RgbImage) -> Result<()> {
    write::alone(path, png(picture)?)
}

fn png(picture: &RgbImage) -> Result<Vec<u8>> {
    let mut bytes = Cursor::new(Vec::new());
    picture.write_to(&mut bytes, ImageFormat::Png).context("cannot encode the picture")?;
    Ok(bytes.into_inner())
}
