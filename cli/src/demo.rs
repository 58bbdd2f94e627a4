//! `chamfer demo`: built-in models before and after, without any file to begin with.

use std::path::Path;
use std::process::ExitCode;

use anyhow::{Context, Result};
use chamfer::{Chamfered, MeshBuffers, Options, chamfer, shapes};
use chamfer_formats::{IDENTITY, OutputFile, glb};

use crate::args::DemoArgs;
use crate::console::{say, warn};
use crate::pictures::write_png;
use crate::preview::{Panel, Placed, contact_sheet};
use crate::write;

/// In percent of the extent: four times the default, so that chamfers show in a small picture.
const WIDTH_PERCENT: f32 = 2.0;

struct Model {
    name: &'static str,
    before: MeshBuffers,
    after: Chamfered,
}

/// Writes the models and a picture of all, and prints a table.
pub fn run(args: &DemoArgs) -> ExitCode {
    match write_all(&args.output) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            warn(format_args!("error: {error:#}"));
            ExitCode::FAILURE
        }
    }
}

fn write_all(folder: &Path) -> Result<()> {
    let models =
        shapes::demo_models().into_iter().map(chamfered).collect::<Result<Vec<Model>>>()?;
    say(format_args!(
        "{:<18} {:>14} {:>14} {:>10} {:>9}",
        "model", "vertices", "triangles", "hard edges", "chamfered"
    ));
    for model in &models {
        write_model(folder, model)?;
        say(model.row());
    }
    let panels: Vec<Panel> = models.iter().map(Model::panel).collect();
    write_png(&folder.join("demo.png"), &contact_sheet(&panels))?;
    say(format_args!("written to {}, with a picture of all in demo.png", folder.display()));
    Ok(())
}

fn chamfered((name, before): (&'static str, MeshBuffers)) -> Result<Model> {
    let width = chamfer::Width::PercentOfExtent(WIDTH_PERCENT);
    let after = chamfer(&before.as_mesh(), &Options::default().with_width(width));
    Ok(Model { name, before, after: after.with_context(|| name)? })
}

fn write_model(folder: &Path, model: &Model) -> Result<()> {
    let file = |when: &str, mesh: &MeshBuffers| -> Result<OutputFile> {
        let path = folder.join(format!("{}.{when}.glb", model.name));
        Ok(OutputFile { path, bytes: glb::encode(model.name, mesh, &[], &[])? })
    };
    write::together(&[file("before", &model.before)?, file("after", &model.after.mesh)?])
}

impl Model {
    fn row(&self) -> String {
        let (before, after) = (&self.before, &self.after.mesh);
        let change = |before: usize, after: usize| format!("{before} -> {after}");
        let totals = &self.after.totals;
        format!(
            "{:<18} {:>14} {:>14} {:>10} {:>9}",
            self.name,
            change(before.positions.len(), after.positions.len()),
            change(before.indices.len() / 3, after.indices.len() / 3),
            totals.hard_edges,
            totals.chamfered + totals.narrowed,
        )
    }

    fn panel(&self) -> Panel<'_> {
        let placed = |mesh| vec![Placed { mesh, transform: IDENTITY }];
        Panel {
            caption: self.name.into(),
            before: placed(self.before.as_mesh()),
            after: placed(self.after.mesh.as_mesh()),
            ..Panel::default()
        }
    }
}
