//! The pictures of a run.

use std::io::Cursor;
use std::path::Path;

use anyhow::{Context, Error, Result};
use chamfer::{Chamfered, MeshBuffers};
use chamfer_formats::Document;
use image::{ImageFormat, RgbImage};

use crate::args::Args;
use crate::html::Pictures;
use crate::preview::{LARGE_TILE, Line, Panel, SMALL_TILE, before_after, sheet, tiles};
use crate::scene::placed;
use crate::verdict_lines::{self, Legend};
use crate::write;

/// How many models a contact sheet shows: more make a picture that viewers refuse to open.
pub const MOST_ROWS: usize = 24;

/// How the models of a run are drawn.
pub struct Studio {
    /// Pixels per side of a tile of the sheet, if there is one.
    tile: Option<u32>,
    verdicts: bool,
    /// Whether there is a page.
    page: bool,
}

/// Pixels per side of a picture on a page: twice what is shown, for fine screens.
const PAGE_TILE: u32 = 400;

/// A model before and after, as a PNG: many wait for the sheet.
pub struct Portrait(Vec<u8>);

/// What was drawn of a model.
#[derive(Default)]
pub struct Drawn {
    /// For the sheet.
    pub portrait: Option<Portrait>,
    /// For the page.
    pub page: Pictures,
}

impl Studio {
    /// One model alone is drawn larger than many; none where nobody asks for pictures.
    pub fn new(args: &Args, models: usize) -> Option<Studio> {
        let tile = if models == 1 { LARGE_TILE } else { SMALL_TILE };
        let tile = args.preview.as_ref().map(|_| tile);
        let page = args.html.is_some();
        let is_used = tile.is_some() || page;
        is_used.then_some(Studio { tile, verdicts: args.preview_verdicts, page })
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
    ) -> Result<Drawn> {
        let mut panel = Panel {
            caption,
            before: placed(document, |mesh| &document.meshes()[mesh].mesh),
            after: placed(document, |mesh| &chamfered[mesh].mesh),
            ..Panel::default()
        };
        let page = self.page.then(|| tiles(&panel, PAGE_TILE));
        let page = page.map(|[before, after]| Ok::<_, Error>([png(&before)?, png(&after)?]));
        if self.verdicts {
            add_verdicts(&mut panel, document, chamfered);
        }
        let portrait = self.tile.map(|tile| png(&before_after(&panel, tile)).map(Portrait));
        Ok(Drawn { portrait: portrait.transpose()?, page: page.transpose()? })
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
