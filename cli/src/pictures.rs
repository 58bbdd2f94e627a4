//! The pictures of a run.

use std::io::Cursor;
use std::path::{Path, PathBuf};

use anyhow::{Context, Error, Result};
use chamfer::{Chamfered, MeshBuffers};
use chamfer_formats::Document;
use image::{ImageFormat, RgbImage};

use crate::args::Args;
use crate::busiest::busiest_corner;
use crate::chamfering::chamfer_document;
use crate::coats::Decoded;
use crate::fit::Wish;
use crate::html::Pictures;
use crate::length::{Length, Unit};
use crate::preview::{
    LARGE_TILE, Line, Panel, SMALL_TILE, Surface, before_after, sheet, stacked, tiles,
};
use crate::scene::placed;
use crate::verdict_lines::{self, Legend};
use crate::write;

/// How many models a page of a contact sheet shows: more make a picture that viewers refuse to open.
const MOST_ROWS: usize = 24;

/// How the models of a run are drawn.
pub struct Studio {
    /// Pixels per side of a tile of the sheet, if there is one.
    tile: Option<u32>,
    verdicts: bool,
    close_up: bool,
    /// What is asked for with each of several widths, and what these are called.
    widths: Vec<(String, Wish)>,
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
        let tile = args.preview.as_ref().map(|_| args.preview_size.unwrap_or(tile));
        let page = args.html.is_some();
        let wish = args.choices.wish(1);
        let with = |width: &Length| {
            let unit = if width.unit == Unit::File { wish.width.unit } else { width.unit };
            let width = Length { unit, ..*width };
            (width.to_string(), Wish { width, ..wish.clone() })
        };
        let is_used = tile.is_some() || page;
        is_used.then(|| Studio {
            tile,
            verdicts: args.preview_verdicts,
            close_up: args.preview_close_up,
            widths: args.preview_widths.iter().map(with).collect(),
            page,
        })
    }

    /// Draws a model.
    ///
    /// # Errors
    /// Where the picture cannot be encoded, or one of several widths cannot be made.
    pub fn draw(
        &self,
        caption: String,
        document: &dyn Document,
        chamfered: &[Chamfered],
    ) -> Result<Drawn> {
        let decoded = Decoded::new(document);
        let wardrobe = decoded.wardrobe(document);
        let panel = Panel {
            caption,
            before: placed(document, |mesh| &document.meshes()[mesh].mesh),
            after: placed(document, |mesh| &chamfered[mesh].mesh),
            surface: Surface::Own(&wardrobe),
            ..Panel::default()
        };
        let page = self.page.then(|| tiles(&panel, PAGE_TILE));
        let page = page.map(|[before, after]| Ok::<_, Error>([png(&before)?, png(&after)?]));
        let portrait = self.tile.map(|tile| self.portrait(tile, panel, document, chamfered));
        Ok(Drawn { portrait: portrait.transpose()?, page: page.transpose()? })
    }

    fn portrait(
        &self,
        tile: u32,
        panel: Panel,
        document: &dyn Document,
        chamfered: &[Chamfered],
    ) -> Result<Portrait> {
        let run = |wish: &Wish| chamfer_document(document, wish, &|_| ());
        let several = self.widths.iter().map(|(_, wish)| Ok(run(wish)?.meshes));
        let several: Vec<Vec<Chamfered>> = several.collect::<Result<_>>()?;
        let several = self.widths.iter().zip(&several);
        let mut named = several
            .map(|((name, _), meshes)| (name.clone(), placed(document, |m| &meshes[m].mesh)));
        // The panel lives no longer than the meshes just made.
        let mut panel: Panel = panel;
        if let Some((name, first)) = named.next() {
            (panel.after_name, panel.after) = (Some(name), first);
        }
        panel.further = named.collect();
        if self.verdicts {
            add_verdicts(&mut panel, document, chamfered);
        }
        let mut rows = vec![before_after(&panel, tile)];
        if let Some(zoom) = self.close_up.then(|| busiest_corner(document, chamfered)).flatten() {
            panel.zoom = Some(zoom);
            panel.caption = "the busiest corner".into();
            rows.push(before_after(&panel, tile));
        }
        png(&stacked(&rows)).map(Portrait)
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

/// Writes the models to a file: one alone, several as a contact sheet, and where there are many as
/// pages of it: `sheet.png`, `sheet-2.png` and so on.
///
/// # Errors
/// Where a file cannot be written.
pub fn write_sheets(path: &Path, portraits: &[Portrait]) -> Result<()> {
    if let [Portrait(alone)] = portraits {
        return write::alone(path, alone.clone());
    }
    for (number, page) in portraits.chunks(MOST_ROWS).enumerate() {
        let rows = page.iter().map(|row| Ok(image::load_from_memory(&row.0)?.into_rgb8()));
        write_png(&page_path(path, number), &sheet(&rows.collect::<Result<Vec<_>>>()?))?;
    }
    Ok(())
}

fn page_path(path: &Path, number: usize) -> PathBuf {
    if number == 0 {
        return path.to_path_buf();
    }
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    let end = path.extension().unwrap_or_default().to_string_lossy();
    path.with_file_name(format!("{stem}-{}.{end}", number + 1))
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
