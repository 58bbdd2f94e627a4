//! The arguments of the command.

use std::path::PathBuf;

use chamfer::{ChamferSubmesh, Options, Verify, Width};
use chamfer_formats::{ReadOptions, Weld};
use clap::{Parser, Subcommand, ValueEnum};

use crate::report::Asked;

const ABOUT: &str = "\
Chamfers the hard edges of game models.

Reads .glb, .gltf, .obj, .stl, .fbx and .ply files, pulls the split vertices at every hard edge apart inside \
their own faces and closes the gap with a strip that shades smoothly. All else in a file stays \
as it is.";

const OUTPUT_RULES: &str = "\
Where results go:
  one file, no -o         NAME.chamfered.EXT beside it
  one file, -o FILE       FILE, which may be the input itself
  one file, -o DIR        DIR/NAME.EXT, where DIR exists or ends in a slash
  several, or a folder    DIR/..., in the same subfolders as below the folder given

Folders that are missing are created. A result has the format of its input; an .stl goes out as
.glb, because .stl has no normals, unless -o names an .stl, and an .fbx or .ply too, as there is no
writer.
With -o an .obj can go out as .glb too, and .glb and .gltf as each other.

Examples:
  chamfer chair.glb
  chamfer chair.glb -o soft/chair.glb --width 0.005 --preview chair.png
  chamfer models -o chamfered --width-percent 0.5 --report report.json
  chamfer bolt.stl -o bolt.glb --smoothing-angle 40
  chamfer check chair.glb chair.chamfered.glb
  chamfer demo";

/// More than any machine has, and few enough to start.
const MOST_THREADS: i64 = 1024;

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
    #[arg(value_name = "INPUT", required = true)]
    pub inputs: Vec<PathBuf>,

    /// Where results go: a file for one model, a folder for several
    #[arg(short, long, value_name = "OUTPUT|DIR")]
    pub output: Option<PathBuf>,

    /// Distance between an old edge and the pulled one, in mesh units
    #[arg(long, value_name = "W", value_parser = width, allow_negative_numbers = true)]
    #[arg(conflicts_with = "width_percent")]
    pub width: Option<f32>,

    /// The same in percent of each mesh's largest side
    #[arg(long, value_name = "P", value_parser = width, allow_negative_numbers = true)]
    #[arg(default_value = "1")]
    pub width_percent: f32,

    /// How much of the breadth of each face has to stay between its chamfers, in percent; narrow
    /// faces get narrower chamfers for it
    #[arg(long, value_name = "P", value_parser = percent, allow_negative_numbers = true)]
    #[arg(default_value = "20")]
    pub least_breadth: f32,

    /// How thoroughly results are checked
    #[arg(long, value_enum, default_value = "seen")]
    pub verify: VerifyArg,

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

    /// Compress the geometry of results in .glb and .gltf, without loss
    #[arg(long, value_enum)]
    pub compress: Option<Compression>,

    /// Pixels per side of each picture in the preview [default: 600 for one model, else 320]
    #[arg(long, value_name = "PIXELS", requires = "preview")]
    #[arg(value_parser = clap::value_parser!(u32).range(32..=2048))]
    pub preview_size: Option<u32>,

    /// Draw these widths beside each other: in percent, or in mesh units with --width. What is
    /// written has the width of --width or --width-percent all the same
    #[arg(long, value_name = "W,W,..", requires = "preview", value_delimiter = ',')]
    #[arg(value_parser = width, num_args = 1, conflicts_with = "preview_verdicts")]
    pub preview_widths: Vec<f32>,

    /// Draw the corner at which most hard edges meet, too, five times as large
    #[arg(long, requires = "preview")]
    pub preview_close_up: bool,

    /// How many threads work [default: one a core]; results do not depend on it
    #[arg(long, value_name = "N", default_value = "0", hide_default_value = true)]
    #[arg(value_parser = clap::value_parser!(u32).range(..=MOST_THREADS))]
    pub threads: u32,

    /// For models without normals: faces that meet at up to this angle shade as one surface
    #[arg(long, value_name = "DEG", value_parser = angle, allow_negative_numbers = true)]
    #[arg(default_value = "30")]
    pub smoothing_angle: f32,

    /// Join vertices that are at most so far from each other, in mesh units; "auto": those that only
    /// rounding may have set apart [default: those at the same place]
    #[arg(long, value_name = "DISTANCE|auto", value_parser = weld, allow_negative_numbers = true)]
    pub weld: Option<Weld>,

    /// Submesh (material) of the new triangles: that of the face each chamfer continues, a new
    /// one, or the one of this number
    #[arg(long, value_name = "owner|own|N", value_parser = submesh, default_value = "owner")]
    pub chamfer_submesh: ChamferSubmesh,
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

    /// The width that was asked for, in mesh units
    #[arg(long, value_name = "W", value_parser = width, allow_negative_numbers = true)]
    #[arg(conflicts_with = "width_percent")]
    pub width: Option<f32>,

    /// The same in percent of each mesh's largest side
    #[arg(long, value_name = "P", value_parser = width, allow_negative_numbers = true)]
    pub width_percent: Option<f32>,

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

    /// For models without normals: faces that meet at up to this angle shade as one surface
    #[arg(long, value_name = "DEG", value_parser = angle, allow_negative_numbers = true)]
    #[arg(default_value = "30")]
    pub smoothing_angle: f32,

    /// Join vertices that are at most so far from each other, in mesh units; "auto": those that only
    /// rounding may have set apart [default: those at the same place]
    #[arg(long, value_name = "DISTANCE|auto", value_parser = weld, allow_negative_numbers = true)]
    pub weld: Option<Weld>,
}

impl CheckArgs {
    /// The width that was asked for, if that is known.
    pub fn width(&self) -> Option<Width> {
        self.width.map(Width::Units).or(self.width_percent.map(Width::PercentOfExtent))
    }

    /// What to ask of the readers.
    pub fn read_options(&self) -> ReadOptions {
        ReadOptions { smoothing_angle: self.smoothing_angle, weld: self.weld.unwrap_or_default() }
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

/// [`Verify`] as an argument.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum VerifyArg {
    /// As "full", and no light shows through the model where none did before.
    Seen,
    /// Nothing opens, flips, degenerates or newly cuts through itself.
    Full,
    /// Nothing opens, flips or degenerates.
    Fast,
}

impl From<VerifyArg> for Verify {
    fn from(verify: VerifyArg) -> Verify {
        match verify {
            VerifyArg::Seen => Verify::Seen,
            VerifyArg::Full => Verify::Full,
            VerifyArg::Fast => Verify::Fast,
        }
    }
}

impl Args {
    /// What to ask of the core, with this many threads for one mesh.
    pub fn options(&self, threads: u32) -> Options {
        Options::default()
            .with_width(self.width.map_or(Width::PercentOfExtent(self.width_percent), Width::Units))
            .with_least_breadth(self.least_breadth / 100.0)
            .with_verify(self.verify.into())
            .with_chamfer_submesh(self.chamfer_submesh)
            .with_threads(threads)
    }

    /// The same and more, for the report.
    pub fn asked(&self) -> Asked {
        let (width, width_unit) = match self.width {
            Some(width) => (width, "mesh"),
            None => (self.width_percent, "percent"),
        };
        Asked {
            width,
            width_unit,
            least_breadth: self.least_breadth,
            verify: match self.verify {
                VerifyArg::Seen => "seen",
                VerifyArg::Full => "full",
                VerifyArg::Fast => "fast",
            },
            chamfer_submesh: match self.chamfer_submesh {
                ChamferSubmesh::Owner => "owner".into(),
                ChamferSubmesh::Own => "own".into(),
                ChamferSubmesh::Given(number) => number.to_string(),
                _ => "other".into(),
            },
            smoothing_angle: self.smoothing_angle,
            weld: self.weld.map(|weld| match weld {
                Weld::Equal => "0".into(),
                Weld::Within(distance) => distance.to_string(),
                Weld::Auto => "auto".into(),
            }),
            compress: self.compress.map(|Compression::Meshopt| "meshopt"),
        }
    }

    /// What to ask of the readers.
    pub fn read_options(&self) -> ReadOptions {
        ReadOptions { smoothing_angle: self.smoothing_angle, weld: self.weld.unwrap_or_default() }
    }
}

fn width(text: &str) -> Result<f32, String> {
    match text.parse::<f32>() {
        Ok(width) if width.is_finite() && width >= 0.0 => Ok(width),
        _ => Err("give a number of at least 0".into()),
    }
}

fn weld(text: &str) -> Result<Weld, String> {
    match text {
        "auto" => Ok(Weld::Auto),
        distance => width(distance).map(Weld::Within).map_err(|error| format!("{error}, or auto")),
    }
}

fn percent(text: &str) -> Result<f32, String> {
    match text.parse::<f32>() {
        Ok(percent) if (0.0..=100.0).contains(&percent) => Ok(percent),
        _ => Err("give percent from 0 to 100".into()),
    }
}

fn angle(text: &str) -> Result<f32, String> {
    match text.parse::<f32>() {
        Ok(angle) if (0.0..=180.0).contains(&angle) => Ok(angle),
        _ => Err("give degrees from 0 to 180".into()),
    }
}

fn submesh(text: &str) -> Result<ChamferSubmesh, String> {
    match text {
        "owner" => Ok(ChamferSubmesh::Owner),
        "own" => Ok(ChamferSubmesh::Own),
        number => number
            .parse()
            .map(ChamferSubmesh::Given)
            .map_err(|_| "give owner, own or the number of a submesh".into()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
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
        let options = parse("chamfer a.glb").unwrap().options(1);
        assert_eq!(options, Options::default().with_verify(Verify::Seen));
    }

    #[test]
    fn a_width_in_units_wins_over_the_default_percentage() {
        let options = parse("chamfer a.glb --width 0.25").unwrap().options(1);
        assert_eq!(options.width, Width::Units(0.25));
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
        let weld = |line| parse(line).unwrap().read_options().weld;
        assert_eq!(weld("chamfer a.glb"), Weld::Equal);
        assert_eq!(weld("chamfer a.glb --weld 0.5"), Weld::Within(0.5));
        assert_eq!(weld("chamfer a.glb --weld auto"), Weld::Auto);
        assert!(parse("chamfer a.glb --weld -1").is_err());
    }

    #[test]
    fn a_breadth_is_a_percentage() {
        let options = parse("chamfer a.glb --least-breadth 50").unwrap().options(1);
        assert_eq!(options.least_breadth, 0.5);
        assert!(parse("chamfer a.glb --least-breadth 101").is_err());
        assert!(parse("chamfer a.glb --least-breadth NaN").is_err());
    }

    #[test]
    fn a_submesh_is_named_or_numbered() {
        let submesh = |line| parse(line).unwrap().chamfer_submesh;
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
        assert_eq!(width, Some(Width::PercentOfExtent(2.0)));
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
