//! The arguments of the command.

use std::path::PathBuf;

use chamfer::Verify;
use chamfer_formats::{Normals, ReadOptions};
use clap::{Parser, Subcommand, ValueEnum};

use crate::choices::{Choices, Reading, hard_angle, number};
use crate::length::Length;
use crate::report::Asked;

const ABOUT: &str = "\
Chamfers the hard edges of game models.

Reads .glb, .gltf, .obj, .stl, .fbx, .ply and .off files, pulls the split vertices at every hard edge apart inside \
their own faces and closes the gap with a strip that shades smoothly. All else in a file stays \
as it is.";

const OUTPUT_RULES: &str = "\
Where results go:
  one file, no -o         NAME.chamfered.EXT beside it
  one file, -o FILE       FILE, which may be the input itself
  one file, -o DIR        DIR/NAME.EXT, where DIR exists or ends in a slash
  several, or a folder    DIR/..., in the same subfolders as below the folder given

Folders that are missing are created. A result has the format of its input; an .stl goes out as
.glb, because .stl has no normals, unless -o names an .stl, and an .fbx, .ply or .off too, as there is no
writer.
With -o an .obj can go out as .glb too, and .glb and .gltf as each other.

Examples:
  chamfer chair.glb
  chamfer chair.glb -o soft/chair.glb --width 5mm --preview chair.png
  chamfer crate.glb --width 4mm --material-width Metal=1mm --min-angle 20
  chamfer models -o chamfered --width-percent 0.5 --report report.json
  chamfer bolt.stl -o bolt.glb --smoothing-angle 40
  chamfer check chair.glb chair.chamfered.glb
  chamfer demo";

/// The whole command line.
#[derive(Debug, Parser)]
#[command(
    name = "chamfer",
    version,
    about = "Chamfers the hard edges of game models",
    long_about = ABOUT,
    after_help = OUTPUT_RULES,
    args_conflicts_with_subcommands = true,
    subcommand_negates_reqs = true,
    disable_help_subcommand = true
)]
pub struct Args {
    /// A command in place of inputs.
    #[command(subcommand)]
    pub command: Option<Command>,

    /// Models, or folders to search for models [a model named "check" or "demo": ./demo]
    #[arg(value_name = "INPUT", required_unless_present = "print_options")]
    pub inputs: Vec<PathBuf>,

    /// Where results go: a file for one model, a folder for several
    #[arg(short, long, value_name = "OUTPUT|DIR")]
    pub output: Option<PathBuf>,

    /// Write what became of every mesh to this file
    #[arg(long, value_name = "FILE.json")]
    pub report: Option<PathBuf>,

    /// Say only what went wrong
    #[arg(short, long, conflicts_with = "verbose")]
    pub quiet: bool,

    /// Say what became of every mesh
    #[arg(short, long)]
    pub verbose: bool,

    /// List every hard edge in the report, and what became of it
    #[arg(long, requires = "report")]
    pub report_edges: bool,

    /// Write a page with all models to this file: sortable, with pictures, narrowed ones on top
    #[arg(long, value_name = "FILE.html")]
    pub html: Option<PathBuf>,

    /// Draw before and after to this file; several models make a contact sheet
    #[arg(long, value_name = "FILE.png")]
    pub preview: Option<PathBuf>,

    /// Draw the hard edges over the picture: green where chamfered at full width, amber where
    /// narrowed, red where left as they were
    #[arg(long, requires = "preview")]
    pub preview_verdicts: bool,

    /// Take the most segments, up to --segments (or 32), that keep each file within so many triangles;
    /// one segment at least
    #[arg(long, value_name = "N")]
    pub max_triangles: Option<u64>,

    /// Write no models: only say how many triangles and vertices would come out
    #[arg(long)]
    pub dry_run: bool,

    /// Compress the geometry of results in .glb and .gltf, without loss
    #[arg(long, value_enum)]
    pub compress: Option<Compression>,

    /// Pixels per side of each picture in the preview [default: 600 for one model, else 320]
    #[arg(long, value_name = "PIXELS", requires = "preview")]
    #[arg(value_parser = clap::value_parser!(u32).range(32..=2048))]
    pub preview_size: Option<u32>,

    /// Draw these widths beside each other: with units, or in that of the width asked for. What is
    /// written has the width of --width or --width-percent all the same
    #[arg(long, value_name = "W,W,..", requires = "preview", value_delimiter = ',')]
    #[arg(value_parser = Length::parse, num_args = 1, conflicts_with = "preview_verdicts")]
    pub preview_widths: Vec<Length>,

    /// Draw the corner at which most hard edges meet, too, five times as large
    #[arg(long, requires = "preview")]
    pub preview_close_up: bool,

    /// Take options from this file, as --print-options writes it; those of the command line win
    #[arg(long, value_name = "FILE.toml")]
    pub options: Option<PathBuf>,

    /// Print all options as such a file, and do nothing else
    #[arg(long)]
    pub print_options: bool,

    /// How to chamfer.
    #[command(flatten)]
    pub choices: Choices,
}

/// What can stand in place of inputs.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Chamfer a few built-in models: writes each before and after as .glb, and a picture
    Demo(DemoArgs),
    /// Check a chamfered model against its source: exits with 0 if it is sound, with 1 if not, with
    /// 3 if something could not be checked
    Check(CheckArgs),
}

const CHECK_RULES: &str = "\
Meshes are paired by name where names are unique, the others in their order. A result is sound if \
nothing opened, flipped, lost its area, bent or cuts through itself that did not in the source, if \
normals and tangents are unit length, and if there is no new hard edge. Hard edges that are left \
are counted; with a width, one that a chamfer of that width would not leave is a defect too.

Both models are also looked through from 26 sides, as they stand in their scenes and with faces \
from behind left out: light may show nowhere where nobody saw through before, but for what lies \
beside an outline that recedes by a chamfer. How wide that is, the width tells; without one the \
chamfers are measured.

Sound is said only where all of this was checked. Where some of it was not, a line names it and \
the last word is \"sound as far as checked\".

Exit code: 0 sound, 1 not sound, 2 a file cannot be read or the arguments make no sense, 3 sound \
as far as checked.";

/// Arguments of `chamfer check`.
#[derive(Debug, clap::Args)]
#[command(after_help = CHECK_RULES)]
pub struct CheckArgs {
    /// The model before
    pub before: PathBuf,

    /// The model after, in any format
    pub after: PathBuf,

    /// Write all that was found to this file
    #[arg(long, value_name = "FILE.json")]
    pub report: Option<PathBuf>,

    /// The width that was asked for, as it was given
    #[arg(long, value_name = "W", value_parser = Length::parse, allow_negative_numbers = true)]
    #[arg(conflicts_with = "width_percent")]
    pub width: Option<Length>,

    /// The same in percent of the largest side of the whole model
    #[arg(long, value_name = "P", value_parser = number, allow_negative_numbers = true)]
    pub width_percent: Option<f32>,

    /// The width was that of each mesh by itself
    #[arg(long)]
    pub per_mesh: bool,

    /// Normals were one that differ by less than this [default: that of --options, or else 1]
    #[arg(long, value_name = "DEG", value_parser = hard_angle, allow_negative_numbers = true)]
    pub hard_angle: Option<f32>,

    /// The file of options that the model was chamfered with: edges that it does not select stay hard,
    /// and have no width
    #[arg(long, value_name = "FILE.toml")]
    pub options: Option<PathBuf>,

    /// Draw the worst places where light shows to this file, before and after; without any, the
    /// whole model
    #[arg(long, value_name = "FILE.png")]
    pub preview: Option<PathBuf>,

    /// Do not look through the models for light
    #[arg(long)]
    pub no_see_through: bool,

    /// How thoroughly to check; "full" also looks for self-intersections
    #[arg(long, value_enum, default_value = "full")]
    pub verify: CheckDepth,

    #[command(flatten)]
    pub reading: Reading,
}

impl CheckArgs {
    /// The width that was asked for, if that is known.
    pub fn width(&self) -> Option<Length> {
        self.width.or(self.width_percent.map(Length::percent))
    }

    /// What to ask of the readers for the model after: it has the normals that were made for it.
    pub fn read_options(&self) -> ReadOptions {
        ReadOptions { normals: Normals::Keep, ..self.reading.options() }
    }

    /// The same for the model before.
    pub fn read_options_before(&self) -> ReadOptions {
        self.reading.options()
    }
}

/// Arguments of `chamfer demo`.
#[derive(Debug, clap::Args)]
pub struct DemoArgs {
    /// The folder for the models and the picture
    #[arg(short, long, value_name = "DIR", default_value = "chamfer-demo")]
    pub output: PathBuf,
}

/// How thoroughly files are compared.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum CheckDepth {
    /// All rules.
    Full,
    /// All but self-intersections.
    Fast,
}

impl From<CheckDepth> for Verify {
    fn from(depth: CheckDepth) -> Verify {
        match depth {
            CheckDepth::Full => Verify::Full,
            CheckDepth::Fast => Verify::Fast,
        }
    }
}

/// How results are compressed.
#[derive(Clone, Copy, Debug, PartialEq, ValueEnum)]
pub enum Compression {
    /// EXT_meshopt_compression, which Unity's glTFast, three.js and Babylon read.
    Meshopt,
}

impl Args {
    /// What was asked for, for the report.
    pub fn asked(&self) -> Asked {
        let compress = self.compress.map(|Compression::Meshopt| "meshopt");
        Asked { compress, ..self.choices.asked() }
    }
}

#[cfg(test)]
mod tests {
    use chamfer_formats::Weld;

    use super::*;
    use chamfer::{ChamferSubmesh, Options, Width};
    use clap::CommandFactory;

    fn parse(line: &str) -> Result<Args, clap::Error> {
        Args::try_parse_from(line.split(' '))
    }

    #[test]
    fn the_definition_is_consistent() {
        Args::command().debug_assert();
    }

    #[test]
    fn files_are_looked_at_and_all_else_is_as_the_core_has_it() {
        let wish = parse("chamfer a.glb").unwrap().choices.wish(1);
        assert_eq!(wish.core, Options::default().with_verify(Verify::Seen));
        assert_eq!(wish.width, Length::percent(0.5));
        assert_eq!(Options::default().width, Width::PercentOfExtent(0.5));
    }

    #[test]
    fn a_width_in_units_wins_over_the_default_percentage() {
        let width = |line| parse(line).unwrap().choices.length();
        assert_eq!(width("chamfer a.glb --width 0.25"), Length::parse("0.25").unwrap());
        assert_eq!(width("chamfer a.glb --width 2%"), width("chamfer a.glb --width-percent 2"));
    }

    #[test]
    fn two_widths_are_refused() {
        assert!(parse("chamfer a.glb --width 1 --width-percent 2").is_err());
    }

    #[test]
    fn negative_and_endless_widths_are_refused() {
        assert!(parse("chamfer a.glb --width -1").is_err());
        assert!(parse("chamfer a.glb --width inf").is_err());
        assert!(parse("chamfer a.glb --width-percent NaN").is_err());
    }

    #[test]
    fn welding_is_off_unless_asked_for() {
        let weld = |line| parse(line).unwrap().choices.read_options().weld;
        assert_eq!(weld("chamfer a.glb"), Weld::Equal);
        assert_eq!(weld("chamfer a.glb --weld 0.5"), Weld::Within(0.5));
        assert_eq!(weld("chamfer a.glb --weld auto"), Weld::Auto);
        assert!(parse("chamfer a.glb --weld -1").is_err());
    }

    #[test]
    fn a_breadth_is_a_percentage() {
        let options = parse("chamfer a.glb --least-breadth 50").unwrap().choices.wish(1).core;
        assert_eq!(options.least_breadth, 0.5);
        assert!(parse("chamfer a.glb --least-breadth 101").is_err());
        assert!(parse("chamfer a.glb --least-breadth NaN").is_err());
    }

    #[test]
    fn a_submesh_is_named_or_numbered() {
        let submesh = |line| parse(line).unwrap().choices.chamfer_submesh;
        assert_eq!(submesh("chamfer a.glb --chamfer-submesh own"), ChamferSubmesh::Own);
        assert_eq!(submesh("chamfer a.glb --chamfer-submesh 3"), ChamferSubmesh::Given(3));
        assert!(parse("chamfer a.glb --chamfer-submesh -3").is_err());
    }

    #[test]
    fn demo_is_a_command_and_a_path_to_demo_is_not() {
        assert!(parse("chamfer demo").unwrap().command.is_some());
        let args = parse("chamfer ./demo").unwrap();
        assert!(args.command.is_none());
        assert_eq!(args.inputs, [PathBuf::from("./demo")]);
    }

    #[test]
    fn check_takes_two_models_and_perhaps_a_width() {
        let check = |line| match parse(line).unwrap().command {
            Some(Command::Check(args)) => args,
            _ => panic!("{line}"),
        };
        assert_eq!(check("chamfer check a.glb b.glb").width(), None);
        let width = check("chamfer check a.glb b.glb --width-percent 2").width();
        assert_eq!(width, Some(Length::percent(2.0)));
        assert!(parse("chamfer check a.glb").is_err());
        assert!(parse("chamfer check a.glb b.glb --width 1 --width-percent 2").is_err());
    }

    #[test]
    fn edges_need_a_report_and_verdicts_a_picture() {
        assert!(parse("chamfer a.glb --report-edges").is_err());
        assert!(parse("chamfer a.glb --preview-verdicts").is_err());
        assert!(parse("chamfer a.glb --report r.json --report-edges").unwrap().report_edges);
    }

    #[test]
    fn a_model_behind_others_may_be_called_demo() {
        let args = parse("chamfer a.glb demo -o out").unwrap();
        assert_eq!(args.inputs.len(), 2);
    }

    #[test]
    fn inputs_are_required() {
        assert!(parse("chamfer").is_err());
        assert!(parse("chamfer -o out").is_err());
    }
}
