//! How to chamfer: what can be asked for on the command line, and in a file of options.

use anyhow::{Result, ensure};
use chamfer::{ChamferSubmesh, Convexity, MOST_SEGMENTS, Options, Verify, WidthMode};
use chamfer_formats::{Normals, ReadOptions, Weld};
use clap::{Args, ValueEnum};

use crate::fit::Wish;
use crate::length::Length;
use crate::report::Asked;

/// More than any machine has, and few enough to start.
const MOST_THREADS: i64 = 1024;

/// How models are read.
#[derive(Clone, Debug, Args)]
pub struct Reading {
    /// Which normals count: those of the file, or others, made by --smoothing-angle
    #[arg(long, value_enum, default_value = "keep")]
    pub normals: NormalsArg,

    /// For models without normals: faces that meet at up to this angle shade as one surface
    #[arg(long, value_name = "DEG", value_parser = angle, allow_negative_numbers = true)]
    #[arg(default_value = "30")]
    pub smoothing_angle: f32,

    /// Join vertices that are at most so far from each other, in mesh units; "auto": those that only
    /// rounding may have set apart [default: those at the same place]
    #[arg(long, value_name = "DISTANCE|auto", value_parser = weld, allow_negative_numbers = true)]
    pub weld: Option<Weld>,
}

impl Reading {
    /// What to ask of the readers.
    pub fn options(&self) -> ReadOptions {
        ReadOptions {
            smoothing_angle: self.smoothing_angle,
            weld: self.weld.unwrap_or_default(),
            normals: self.normals.into(),
        }
    }
}

/// The options that results depend on, and the number of threads.
#[derive(Clone, Debug, Args)]
pub struct Choices {
    /// Distance between an old edge and the pulled one, in units of the scene (glTF: metres), or with a
    /// unit: 5mm, 2cm, 0.2in, 2%
    #[arg(long, value_name = "W", value_parser = Length::parse, allow_negative_numbers = true)]
    #[arg(conflicts_with = "width_percent")]
    pub width: Option<Length>,

    /// The same in percent of the largest side of the whole model, as it stands in its scene
    #[arg(long, value_name = "P", value_parser = number, allow_negative_numbers = true)]
    #[arg(default_value = "0.5")]
    pub width_percent: f32,

    /// Widths are in the units of each mesh, and in percent of its own largest side, wherever it stands
    #[arg(long)]
    pub per_mesh: bool,

    /// What the width measures
    #[arg(long, value_enum, default_value = "offset")]
    pub width_mode: WidthModeArg,

    /// Another width where this material is; 0 leaves its edges as they are. Can be given several times
    #[arg(long, value_name = "NAME=W", value_parser = material_width)]
    pub material_width: Vec<(String, Length)>,

    /// Multiply widths by this channel of the vertex colours: black leaves edges as they are
    #[arg(long, value_enum)]
    pub mask: Option<Channel>,

    /// Chamfer edges whose faces meet at this angle at least: 0 for a flat surface, 180 for one folded
    /// back on itself
    #[arg(long, value_name = "DEG", value_parser = angle, allow_negative_numbers = true)]
    #[arg(default_value = "0")]
    pub min_angle: f32,

    /// The same at most
    #[arg(long, value_name = "DEG", value_parser = angle, allow_negative_numbers = true)]
    #[arg(default_value = "180")]
    pub max_angle: f32,

    /// Which way the faces of chamfered edges meet
    #[arg(long, value_enum, default_value = "both")]
    pub convexity: ConvexityArg,

    /// Normals that differ by less than this are one
    #[arg(long, value_name = "DEG", value_parser = hard_angle, allow_negative_numbers = true)]
    #[arg(default_value = "1")]
    pub hard_angle: f32,

    /// How many segments a chamfer has across: 1 is flat, more are round [default: 1]
    #[arg(long, value_name = "N")]
    #[arg(value_parser = clap::value_parser!(u32).range(1..=i64::from(MOST_SEGMENTS)))]
    pub segments: Option<u32>,

    /// How a chamfer of several segments is bent: 0 flat, 0.5 a circle, 1 the old edge
    #[arg(long, value_name = "P", value_parser = share, allow_negative_numbers = true)]
    #[arg(default_value = "0.5")]
    pub profile: f32,

    /// How much of the breadth of each face has to stay between its chamfers, in percent; narrow
    /// faces get narrower chamfers for it
    #[arg(long, value_name = "P", value_parser = percent, allow_negative_numbers = true)]
    #[arg(default_value = "20")]
    pub least_breadth: f32,

    /// How far the widths of a chamfer are held to each other, in percent: at 0 each end has all that
    /// there is room for, at 100 an edge has one width, on both sides
    #[arg(long, value_name = "P", value_parser = percent, allow_negative_numbers = true)]
    #[arg(default_value = "50")]
    pub evenness: f32,

    /// How thoroughly results are checked
    #[arg(long, value_enum, default_value = "seen")]
    pub verify: VerifyArg,

    /// Submesh (material) of the new triangles: that of the face each chamfer continues, a new
    /// one, or the one of this number
    #[arg(long, value_name = "owner|own|N", value_parser = submesh, default_value = "owner")]
    pub chamfer_submesh: ChamferSubmesh,

    #[command(flatten)]
    pub reading: Reading,

    /// How many threads work [default: one a core]; results do not depend on it
    #[arg(long, value_name = "N", default_value = "0", hide_default_value = true)]
    #[arg(value_parser = clap::value_parser!(u32).range(..=MOST_THREADS))]
    pub threads: u32,
}

/// An enum of the core as an argument.
macro_rules! choice {
    ($(#[$meta:meta])* $name:ident => $target:ident { $($(#[$doc:meta])* $variant:ident),+ $(,)? }) => {
        $(#[$meta])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
        pub enum $name { $($(#[$doc])* $variant),+ }

        impl From<$name> for $target {
            fn from(given: $name) -> $target {
                match given { $($name::$variant => $target::$variant),+ }
            }
        }
    };
}

choice! {
    /// [`Verify`] as an argument.
    VerifyArg => Verify {
        /// As "full", and no light shows through the model where none did before.
        Seen,
        /// Nothing opens, flips, degenerates or newly cuts through itself.
        Full,
        /// Nothing opens, flips or degenerates.
        Fast,
    }
}

choice! {
    /// [`WidthMode`] as an argument.
    WidthModeArg => WidthMode {
        /// From the old edge to the pulled one, within the face.
        Offset,
        /// Across the chamfer, from one pulled edge to the other.
        Chord,
        /// From the old edge straight down to the chamfer.
        Depth,
        /// Of the circle that touches both faces at the pulled edges.
        Radius,
    }
}

choice! {
    /// [`Convexity`] as an argument.
    ConvexityArg => Convexity {
        /// Either.
        Both,
        /// As those of a cube.
        Convex,
        /// As a wall and the floor of a room.
        Concave,
    }
}

choice! {
    /// [`Normals`] as an argument.
    NormalsArg => Normals {
        /// Those of the file; where it has none, made.
        Keep,
        /// Made for all models.
        Angle,
    }
}

/// A channel of the vertex colours.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Channel {
    /// Red.
    R,
    /// Green.
    G,
    /// Blue.
    B,
    /// Opacity.
    A,
}

impl Choices {
    /// Fails where options contradict each other.
    ///
    /// # Errors
    /// Names them.
    pub fn check(&self) -> Result<()> {
        let Choices { min_angle, max_angle, .. } = self;
        ensure!(
            min_angle <= max_angle,
            "--min-angle {min_angle} is larger than --max-angle {max_angle}: no edge could be chamfered"
        );
        Ok(())
    }

    /// The width asked for.
    pub fn length(&self) -> Length {
        self.width.unwrap_or(Length::percent(self.width_percent))
    }

    /// What to ask of the core, with this many threads for one mesh.
    pub fn wish(&self, threads: u32) -> Wish {
        Wish {
            core: Options::default()
                .with_width_mode(self.width_mode.into())
                .with_angles(self.min_angle, self.max_angle)
                .with_convexity(self.convexity.into())
                .with_hard_angle(self.hard_angle)
                .with_segments(self.segments.unwrap_or(1))
                .with_profile(self.profile)
                .with_least_breadth(self.least_breadth / 100.0)
                .with_evenness(self.evenness / 100.0)
                .with_verify(self.verify.into())
                .with_chamfer_submesh(self.chamfer_submesh)
                .with_threads(threads),
            width: self.length(),
            per_mesh: self.per_mesh,
            material_widths: self.material_width.clone(),
            mask: self.mask.map(|channel| channel as usize),
        }
    }

    /// What to ask of the readers.
    pub fn read_options(&self) -> ReadOptions {
        self.reading.options()
    }

    /// The same for the report.
    pub fn asked(&self) -> Asked {
        let width = self.length();
        let own = if self.per_mesh { "mesh" } else { "scene" };
        let lengths = self.material_width.iter();
        Asked {
            width: width.value,
            width_unit: width.unit_name(own),
            per_mesh: self.per_mesh,
            width_mode: name(self.width_mode),
            material_width: lengths.map(|(name, width)| (name.clone(), told(*width))).collect(),
            mask: self.mask.map(name),
            min_angle: self.min_angle,
            max_angle: self.max_angle,
            convexity: name(self.convexity),
            hard_angle: self.hard_angle,
            segments: self.segments.unwrap_or(1),
            profile: self.profile,
            least_breadth: self.least_breadth,
            evenness: self.evenness,
            verify: name(self.verify),
            chamfer_submesh: submesh_name(self.chamfer_submesh),
            normals: name(self.reading.normals),
            smoothing_angle: self.reading.smoothing_angle,
            weld: self.reading.weld.map(|weld| match weld {
                Weld::Equal => "0".into(),
                Weld::Within(distance) => distance.to_string(),
                Weld::Auto => "auto".into(),
            }),
            compress: None,
        }
    }
}

/// A width as it is given.
fn told(width: Length) -> String {
    width.to_string().replace(' ', "")
}

/// A choice as the command line calls it.
fn name(choice: impl ValueEnum) -> String {
    choice.to_possible_value().map(|value| value.get_name().to_owned()).unwrap_or_default()
}

fn submesh_name(submesh: ChamferSubmesh) -> String {
    match submesh {
        ChamferSubmesh::Owner => "owner".into(),
        ChamferSubmesh::Own => "own".into(),
        ChamferSubmesh::Given(number) => number.to_string(),
        _ => "other".into(),
    }
}

/// A number that is not negative.
///
/// # Errors
/// Says so.
pub fn number(text: &str) -> Result<f32, String> {
    match text.parse::<f32>() {
        Ok(number) if number.is_finite() && number >= 0.0 => Ok(number),
        _ => Err("give a number of at least 0".into()),
    }
}

/// Which vertices become one.
///
/// # Errors
/// Says what can be given.
pub fn weld(text: &str) -> Result<Weld, String> {
    match text {
        "auto" => Ok(Weld::Auto),
        distance => number(distance).map(Weld::Within).map_err(|error| format!("{error}, or auto")),
    }
}

/// An angle between faces.
///
/// # Errors
/// Says what can be given.
pub fn angle(text: &str) -> Result<f32, String> {
    match text.parse::<f32>() {
        Ok(angle) if (0.0..=180.0).contains(&angle) => Ok(angle),
        _ => Err("give degrees from 0 to 180".into()),
    }
}

/// An angle from which on normals differ.
///
/// # Errors
/// Says what can be given.
pub fn hard_angle(text: &str) -> Result<f32, String> {
    match text.parse::<f32>() {
        Ok(angle) if 0.0 < angle && angle <= 90.0 => Ok(angle),
        _ => Err("give degrees above 0, up to 90".into()),
    }
}

fn share(text: &str) -> Result<f32, String> {
    match text.parse::<f32>() {
        Ok(share) if (0.0..=1.0).contains(&share) => Ok(share),
        _ => Err("give a number from 0 to 1".into()),
    }
}

fn percent(text: &str) -> Result<f32, String> {
    match text.parse::<f32>() {
        Ok(percent) if (0.0..=100.0).contains(&percent) => Ok(percent),
        _ => Err("give percent from 0 to 100".into()),
    }
}

/// Names may have equals signs.
fn material_width(text: &str) -> Result<(String, Length), String> {
    match text.rsplit_once('=') {
        Some((name, width)) if !name.is_empty() => Ok((name.into(), Length::parse(width)?)),
        _ => Err("give the name of a material and a width: Metal=1mm".into()),
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
