//! The pictures of a run.

use std::io::Cursor;
use std::path::Path;

use anyhow::{Context, Result};
use chamfer::{Chamfered, MeshBuffers};
use chamfer_formats::Document;
use image::{ImageFormat, RgbImage};

use crate::preview::{Line, Panel, Placed, before_after, contact_sheet};
use crate::verdict_lines::{self, Legend};
use crate::write;

/// How many models a contact sheet shows: more make a picture that viewers refuse to open, and
/// all of these are held in memory until it is drawn.
pub const MOST_ROWS: usize = 24;

/// A model kept for the picture.
pub struct Portrait {
    /// What to write under it.
    pub caption: String,
    /// As it was read.
    pub document: Box<dyn Document + Send>,
    /// `#meshes`.
    pub chamfered: Vec<Chamfered>,
}

impl Portrait {
    fn panel(&self, verdicts: bool) -> Panel<'_> {
        let mut panel = Panel { caption: self.caption.clone(), ..Panel::default() };
        for instance in self.document.instances() {
            let transform = instance.transform;
            let before = self.document.meshes().get(instance.mesh);
            let after = self.chamfered.get(instance.mesh);
            if let (Some(before), Some(after)) = (before, after) {
                panel.before.push(Placed { mesh: before.mesh.as_mesh(), transform });
                panel.after.push(Placed { mesh: after.mesh.as_mesh(), transform });
            }
        }
        if verdicts {
            self.add_verdicts(&mut panel);
        }
        panel
    }

    fn add_verdicts(&self, panel: &mut Panel) {
        for instance in self.document.instances() {
            let before = self.document.meshes().get(instance.mesh);
            if let (Some(before), Some(after)) = (before, self.chamfered.get(instance.mesh)) {
                let of = |lines: Lines| lines(&before.mesh, after, instance.transform);
                panel.before_lines.extend(of(verdict_lines::before));
                panel.after_lines.extend(of(verdict_lines::after));
            }
        }
        let mut legend = Legend::default();
        self.chamfered.iter().for_each(|result| legend.add(result));
        panel.caption = format!("{}: {}", self.caption, legend.text());
    }
}

type Lines = fn(&MeshBuffers, &Chamfered, [[f32; 4]; 4]) -> Vec<Line>;

/// Draws the models to a file: one alone, several as a contact sheet. With `verdicts`, the hard
/// edges are drawn over them.
///
/// # Errors
/// Where the file cannot be written.
pub fn draw(path: &Path, portraits: &[Portrait], verdicts: bool) -> Result<()> {
    let panels: Vec<Panel> = portraits.iter().map(|model| model.panel(verdicts)).collect();
    let picture = match &panels[..] {
        [panel] => before_after(panel),
        panels => contact_sheet(panels),
    };
    write_png(path, &picture)
}

/// Writes a picture.
///
/// # Errors
/// Where the file cannot be written.
pub fn write_png(path: &Path, picture: &RgbImage) -> Result<()> {
    let mut bytes = Cursor::new(Vec::new());
    picture.write_to(&mut bytes, ImageFormat::Png).context("cannot encode the picture")?;
    write::alone(path, bytes.into_inner())
}
