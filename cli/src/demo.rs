//! `chamfer demo`: built-in models before and after, without any file to begin with.

use std::path::Path;
use std::process::ExitCode;

use anyhow::{Context, Result};
use chamfer::{Chamfered, MeshBuffers, Options, Width, chamfer, shapes};
use chamfer_formats::{IDENTITY, OutputFile, glb};

use crate::args::DemoArgs;
use crate::console::{say, warn};
use crate::pictures::write_png;
use crate::preview::{Panel, Placed, SMALL_TILE, contact_sheet};
use crate::write;

/// In percent of the extent: four times the default, so that chamfers show in a small picture.
const WIDTH_PERCENT: f32 = 2.0;

/// How many segments the chamfers of the second picture have, from left to right.
const SEGMENTS: [u32; 3] = [1, 2, 4];
/// Wide enough to tell these apart in a small picture.
const ROUND_PERCENT: f32 = 5.0;
/// Pixels per side of a tile of the second picture.
const ROUND_TILE: u32 = 240;

struct Model {
    name: &'static str,
    before: MeshBuffers,
    after: Chamfered,
    /// At each of [`SEGMENTS`].
    rounded: [Chamfered; 3],
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
    write_png(&folder.join("demo.png"), &contact_sheet(&panels, SMALL_TILE))?;
    let panels: Vec<Panel> = models.iter().map(Model::rounded_panel).collect();
    write_png(&folder.join("segments.png"), &contact_sheet(&panels, ROUND_TILE))?;
    say(format_args!(
        "written to {}, with a picture of all in demo.png, and rounded in segments.png",
        folder.display()
    ));
    Ok(())
}

fn chamfered((name, before): (&'static str, MeshBuffers)) -> Result<Model> {
    let run = |percent: f32, segments: u32| {
        let width = Width::PercentOfExtent(percent);
        let options = Options::default().with_width(width).with_segments(segments);
        chamfer(&before.as_mesh(), &options).with_context(|| name)
    };
    let after = run(WIDTH_PERCENT, 1)?;
    let [one, two, four] = SEGMENTS.map(|segments| run(ROUND_PERCENT, segments));
    Ok(Model { name, after, rounded: [one?, two?, four?], before })
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
        Panel {
            caption: self.name.into(),
            before: alone(&self.before),
            after: alone(&self.after.mesh),
            ..Panel::default()
        }
    }

    fn rounded_panel(&self) -> Panel<'_> {
        let [one, two, four] = &self.rounded;
        let [first, second, third] = SEGMENTS.map(|segments| match segments {
            1 => "1 segment".to_owned(),
            _ => format!("{segments} segments"),
        });
        Panel {
            caption: self.name.into(),
            before: alone(&one.mesh),
            before_name: Some(first),
            after: alone(&two.mesh),
            after_name: Some(second),
            further: vec![(third, alone(&four.mesh))],
            ..Panel::default()
        }
    }
}

fn alone(mesh: &MeshBuffers) -> Vec<Placed<'_>> {
    vec![Placed { mesh: mesh.as_mesh(), transform: IDENTITY }]
}
