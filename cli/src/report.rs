//! What became of each file and mesh, for the terminal and as JSON.

use std::collections::BTreeMap;
use std::path::Path;
use std::time::Duration;

use anyhow::Result;
use chamfer::{ByReason, Chamfered, EdgeVerdict, MeshBuffers, Outcome, Reason};
use serde::{Serialize, Serializer};

/// The whole report, as `docs/report.schema.json` describes it.
#[derive(Debug, Serialize)]
pub struct Report {
    /// The version of this program.
    pub chamfer: &'static str,
    /// What was asked for.
    pub options: Asked,
    /// Whether somebody ended the run before all files were done: those that are not are left out.
    pub interrupted: bool,
    /// In the order of the inputs.
    pub files: Vec<FileReport>,
    /// What could not be searched for models.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub notes: Vec<String>,
    /// Sums over all files.
    pub totals: ReportTotals,
}

/// The options of a run that the results depend on.
#[derive(Clone, Debug, Serialize)]
pub struct Asked {
    /// The width, in the unit of `width_unit`.
    pub width: f32,
    /// "scene" for the units of the scene, "mesh" for those of each mesh, "percent" of the largest side
    /// of the model or of each mesh, or a measure.
    pub width_unit: &'static str,
    /// Whether widths are those of each mesh by itself.
    pub per_mesh: bool,
    /// "offset", "chord", "depth" or "radius".
    pub width_mode: String,
    /// Widths at materials.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub material_width: BTreeMap<String, String>,
    /// "r", "g", "b" or "a", or absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mask: Option<String>,
    /// In degrees.
    pub min_angle: f32,
    /// In degrees.
    pub max_angle: f32,
    /// "both", "convex" or "concave".
    pub convexity: String,
    /// In degrees.
    pub hard_angle: f32,
    /// How many segments a chamfer has across.
    pub segments: u32,
    /// How these are bent.
    pub profile: f32,
    /// What stays of the breadth of each face, in percent.
    pub least_breadth: f32,
    /// How far the widths of a chamfer are held to each other, in percent.
    pub evenness: f32,
    /// "seen", "full" or "fast".
    pub verify: String,
    /// "owner", "own" or a number.
    pub chamfer_submesh: String,
    /// "keep" or "angle".
    pub normals: String,
    /// In degrees.
    pub smoothing_angle: f32,
    /// A distance in mesh units, or "auto"; absent where only equal positions are one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub weld: Option<String>,
    /// "meshopt", or absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub compress: Option<&'static str>,
}

/// What became of one file.
#[derive(Debug, Serialize)]
pub struct FileReport {
    /// The input, as given or found.
    pub file: String,
    /// Where its result goes.
    pub output: String,
    /// Why there is no result.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub error: Option<String>,
    /// What else there is to know.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub notes: Vec<String>,
    /// Time from reading to writing.
    pub milliseconds: f64,
    /// Its meshes; none where it failed.
    pub meshes: Vec<MeshReport>,
}

/// What became of one mesh.
#[derive(Debug, Serialize)]
pub struct MeshReport {
    /// As the file calls it.
    pub name: String,
    /// Sizes and verdicts.
    #[serde(flatten)]
    pub counts: Counts,
    /// Mean width as a share (0 to 1) of the width asked for, weighted by edge length.
    pub mean_width: f32,
    /// The width asked for, in mesh units; where the mesh stands stretched, on the mean of its axes.
    pub width: f32,
    /// Time in the core and for looking at the scene: its share of what the file took.
    pub milliseconds: f64,
    /// Its hard edges with two sides, where they were asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub edges: Option<Vec<EdgeReport>>,
    /// The weights of `mean_width` in sums.
    #[serde(skip)]
    pub lengths: Lengths,
    /// How many chamfers there are of each tenth of the width asked for.
    #[serde(skip)]
    pub widths: [u64; BINS],
}

/// Classes of widths.
pub const BINS: usize = 10;

/// Lengths of edges, in the largest sides of their model: millimetres count no more than metres.
#[derive(Clone, Copy, Debug, Default)]
pub struct Lengths {
    /// Of all hard edges together.
    pub hard: f64,
    /// Of the narrowed ones whose width is told.
    pub narrowed: f64,
    /// The same times the share of the width that each got.
    pub narrowed_widths: f64,
}

/// What became of one hard edge.
#[derive(Debug, PartialEq, Serialize)]
pub struct EdgeReport {
    /// The source vertices at its ends.
    pub vertices: [u32; 2],
    /// Their positions, in mesh units.
    pub positions: [[f32; 3]; 2],
    /// "full", "narrowed" or "skipped".
    pub outcome: &'static str,
    /// Why it is not at full width, or "none".
    pub reason: &'static str,
    /// At each end, the distance from the old edge to the pulled ones, in mesh units; where the mesh
    /// stands stretched, on the mean of its axes.
    pub widths: [f32; 2],
    /// How many segments it has across; 0 where it is skipped.
    pub segments: u32,
}

/// What can be counted in a mesh, a file or a whole run.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Counts {
    /// Triangles of the source.
    pub triangles_in: u64,
    /// Triangles of the result.
    pub triangles_out: u64,
    /// Vertices of the source.
    pub vertices_in: u64,
    /// Vertices of the result.
    pub vertices_out: u64,
    /// Hard edges with two sides.
    pub hard_edges: u64,
    /// Those at full width.
    pub full: u64,
    /// Those chamfered, but narrower somewhere.
    pub narrowed: u64,
    /// Those left as they were.
    pub skipped: Skipped,
}

/// Hard edges left as they were, by reason. In JSON an object with the names of the reasons.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Skipped(pub [u64; Reason::ALL.len()]);

/// Sums over the files of a report.
#[derive(Debug, Serialize)]
pub struct ReportTotals {
    /// Files tried.
    pub files: u64,
    /// Those without a result.
    pub failed: u64,
    /// Meshes in the others.
    pub meshes: u64,
    /// Sizes and verdicts.
    #[serde(flatten)]
    pub counts: Counts,
    /// Mean width as a share (0 to 1) of the width asked for, weighted by edge length, which is
    /// measured in the largest side of each model.
    pub mean_width: f32,
    /// The same of the narrowed edges alone, but for those that come to a point at both ends.
    pub mean_narrowed_width: f32,
    /// Time from reading to writing, of all files together.
    pub milliseconds: f64,
}

impl Report {
    /// Adds up the files.
    pub fn new(options: Asked, files: Vec<FileReport>, notes: Vec<String>) -> Report {
        let meshes = || files.iter().flat_map(|file| &file.meshes);
        let totals = ReportTotals {
            files: files.len() as u64,
            failed: files.iter().filter(|file| file.error.is_some()).count() as u64,
            meshes: meshes().count() as u64,
            counts: Counts::sum(meshes()),
            mean_width: mean_width(meshes()),
            mean_narrowed_width: mean_narrowed_width(meshes()),
            milliseconds: round(files.iter().fold(0.0, |sum, file| sum + file.milliseconds)),
        };
        let chamfer = env!("CARGO_PKG_VERSION");
        Report { chamfer, options, interrupted: false, files, notes, totals }
    }

    /// The report as JSON text.
    ///
    /// # Errors
    /// Where memory runs out.
    pub fn to_json(&self) -> Result<Vec<u8>> {
        let mut text = serde_json::to_vec_pretty(self)?;
        text.push(b'\n');
        Ok(text)
    }
}

impl FileReport {
    /// A file of which nothing is known yet.
    pub fn new(input: &Path, output: &Path, time: Duration) -> FileReport {
        FileReport {
            file: input.display().to_string(),
            output: output.display().to_string(),
            error: None,
            notes: Vec::new(),
            milliseconds: milliseconds(time),
            meshes: Vec::new(),
        }
    }
}

impl MeshReport {
    /// What the core says of a mesh, and what can be measured on it. `extent` is the largest side
    /// of its model.
    pub fn new(
        name: &str,
        source: &MeshBuffers,
        result: &Chamfered,
        time: Duration,
        extent: f64,
    ) -> MeshReport {
        let totals = &result.totals;
        MeshReport {
            name: name.into(),
            counts: Counts {
                triangles_in: source.indices.len() as u64 / 3,
                triangles_out: result.mesh.indices.len() as u64 / 3,
                vertices_in: source.positions.len() as u64,
                vertices_out: result.mesh.positions.len() as u64,
                hard_edges: totals.hard_edges.into(),
                full: totals.chamfered.into(),
                narrowed: totals.narrowed.into(),
                skipped: Skipped::new(&totals.skipped),
            },
            mean_width: totals.mean_width,
            width: result.width,
            milliseconds: milliseconds(time),
            edges: None,
            lengths: Lengths::new(source, result, extent),
            widths: widths(result),
        }
    }

    /// The same with all hard edges.
    pub fn with_edges(self, source: &MeshBuffers, result: &Chamfered) -> MeshReport {
        let edge = |verdict: &EdgeVerdict| EdgeReport {
            vertices: verdict.vertices,
            positions: verdict.vertices.map(|vertex| position(source, vertex)),
            outcome: verdict.outcome.name(),
            reason: verdict.reason.name(),
            widths: verdict.widths,
            segments: verdict.segments,
        };
        MeshReport { edges: Some(result.verdicts.iter().map(edge).collect()), ..self }
    }
}

impl Counts {
    /// Adds up meshes.
    pub fn sum<'a>(meshes: impl Iterator<Item = &'a MeshReport>) -> Counts {
        meshes.fold(Counts::default(), |mut sum, MeshReport { counts, .. }| {
            sum.triangles_in += counts.triangles_in;
            sum.triangles_out += counts.triangles_out;
            sum.vertices_in += counts.vertices_in;
            sum.vertices_out += counts.vertices_out;
            sum.hard_edges += counts.hard_edges;
            sum.full += counts.full;
            sum.narrowed += counts.narrowed;
            for (total, count) in sum.skipped.0.iter_mut().zip(counts.skipped.0) {
                *total += count;
            }
            sum
        })
    }
}

impl Skipped {
    fn new(skipped: &ByReason) -> Skipped {
        let mut counts = Skipped::default();
        for (place, (_, count)) in counts.0.iter_mut().zip(skipped.iter()) {
            *place = count.into();
        }
        counts
    }

    /// The reasons there are, with their numbers.
    pub fn text(&self) -> String {
        let reasons = Reason::ALL.iter().zip(self.0).filter(|(_, count)| *count > 0);
        let texts: Vec<String> =
            reasons.map(|(reason, count)| format!("{} {count}", reason.name())).collect();
        texts.join(", ")
    }

    /// Edges of all reasons.
    pub fn total(&self) -> u64 {
        self.0.iter().sum()
    }
}

impl Serialize for Skipped {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let reasons = Reason::ALL.iter().zip(self.0).filter(|(_, count)| *count > 0);
        serializer.collect_map(reasons.map(|(reason, count)| (reason.name(), count)))
    }
}

/// Mean width of meshes as a share of the width asked for, weighted by the lengths of edges.
pub fn mean_width<'a>(meshes: impl Iterator<Item = &'a MeshReport>) -> f32 {
    mean(meshes.map(|mesh| (f64::from(mesh.mean_width) * mesh.lengths.hard, mesh.lengths.hard)))
}

/// The same of the narrowed edges alone; 0 where all of them come to a point at both ends.
pub fn mean_narrowed_width<'a>(meshes: impl Iterator<Item = &'a MeshReport>) -> f32 {
    mean(meshes.map(|mesh| (mesh.lengths.narrowed_widths, mesh.lengths.narrowed)))
}

fn mean(weighted: impl Iterator<Item = (f64, f64)>) -> f32 {
    let (sum, weight) = weighted.fold((0.0, 0.0), |sum, one| (sum.0 + one.0, sum.1 + one.1));
    if weight > 0.0 { (sum / weight) as f32 } else { 0.0 }
}

fn widths(result: &Chamfered) -> [u64; BINS] {
    let mut bins = [0; BINS];
    for verdict in result.verdicts.iter().filter(|verdict| verdict.outcome != Outcome::Skipped) {
        let share = verdict.widths.iter().sum::<f32>() / 2.0 / result.width;
        // A full one is in the last tenth, whatever rounding makes of it.
        let last = verdict.outcome == Outcome::Full;
        let bin = if last { BINS - 1 } else { (share * BINS as f32) as usize };
        bins[bin.min(BINS - 1)] += 1;
    }
    bins
}

/// Of narrowed edges, what a reader is told of their width.
pub fn told_mean(mean: f32) -> String {
    if mean > 0.0 { format!("mean {mean:.2}") } else { "to a point at both ends".to_owned() }
}

/// The widths of all chamfers of meshes.
pub fn histogram<'a>(meshes: impl Iterator<Item = &'a MeshReport>) -> [u64; BINS] {
    meshes.fold([0; BINS], |sum, mesh| std::array::from_fn(|bin| sum[bin] + mesh.widths[bin]))
}

impl Lengths {
    fn new(source: &MeshBuffers, result: &Chamfered, extent: f64) -> Lengths {
        let mut lengths = Lengths::default();
        for verdict in &result.verdicts {
            let [a, b] = verdict.vertices.map(|vertex| position(source, vertex));
            let square = (0..3).map(|axis| f64::from(b[axis] - a[axis]).powi(2)).sum::<f64>();
            let length = if extent > 0.0 { square.sqrt() / extent } else { 0.0 };
            lengths.hard += length;
            // One that comes to a point at both ends has a width between them that is not told.
            let is_told = verdict.widths != [0.0; 2];
            if verdict.outcome == Outcome::Narrowed && result.width > 0.0 && is_told {
                let share = verdict.widths.iter().sum::<f32>() / 2.0 / result.width;
                lengths.narrowed += length;
                lengths.narrowed_widths += length * f64::from(share.min(1.0));
            }
        }
        lengths
    }
}

fn position(source: &MeshBuffers, vertex: u32) -> [f32; 3] {
    source.positions.get(vertex as usize).copied().unwrap_or_default()
}

fn milliseconds(time: Duration) -> f64 {
    round(time.as_secs_f64() * 1000.0)
}

/// To whole microseconds: more digits of a time say nothing.
fn round(milliseconds: f64) -> f64 {
    (milliseconds * 1000.0).round() / 1000.0
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mesh(mean_width: f32, hard_length: f64, skipped: u64) -> MeshReport {
        let mut counts = Counts { hard_edges: 4, full: 4 - skipped, ..Counts::default() };
        counts.skipped.0[Reason::NoRoom as usize] = skipped;
        MeshReport {
            name: "box".into(),
            counts,
            mean_width,
            width: 0.5,
            milliseconds: 1.5,
            edges: None,
            lengths: Lengths { hard: hard_length, ..Lengths::default() },
            widths: [0; BINS],
        }
    }

    fn asked() -> Asked {
        use clap::Parser;
        crate::args::Args::parse_from(["chamfer", "a.glb"]).asked()
    }

    fn report(files: Vec<FileReport>) -> Report {
        Report::new(asked(), files, vec![])
    }

    fn file(meshes: Vec<MeshReport>) -> FileReport {
        let time = Duration::from_micros(2500);
        FileReport { meshes, ..FileReport::new(Path::new("a.obj"), Path::new("b.obj"), time) }
    }

    #[test]
    fn totals_weigh_the_width_by_edge_length() {
        let report = report(vec![file(vec![mesh(1.0, 3.0, 0)]), file(vec![mesh(0.5, 1.0, 1)])]);
        assert_eq!(report.totals.mean_width, 0.875);
        assert_eq!(report.totals.counts.hard_edges, 8);
        assert_eq!(report.totals.milliseconds, 5.0, "with reading and writing");
    }

    /// A box of a thousand millimetres counts as one of one metre.
    #[test]
    fn lengths_are_measured_in_the_model() {
        let lengths = |size: f32| {
            let cube = chamfer::shapes::plain_cube(size);
            let options = chamfer::Options::default();
            let result = chamfer::chamfer(&cube.as_mesh(), &options).unwrap();
            Lengths::new(&cube, &result, f64::from(size))
        };
        let (metre, millimetres) = (lengths(1.0), lengths(1000.0));
        assert!((metre.hard - millimetres.hard).abs() < 1e-6, "{metre:?} {millimetres:?}");
    }

    //   .-----------.
    //   |\.-------./|      a box whose two ends are wound against their normals: the edges between the
    //   |/'-------'\|      ends have chamfers that come to a point at each
    //   '-----------'
    #[test]
    fn of_chamfers_that_come_to_a_point_at_both_ends_no_mean_is_told() {
        let mut long = chamfer::shapes::plain_cube(1.0);
        long.positions.iter_mut().for_each(|at| at[0] *= 2.0);
        for triangle in long.indices.chunks_exact_mut(3) {
            if long.normals[triangle[0] as usize][0] != 0.0 {
                triangle.swap(0, 2);
            }
        }
        let result = chamfer::chamfer(&long.as_mesh(), &chamfer::Options::default()).unwrap();
        assert_eq!(result.totals.narrowed, 4);
        let lengths = Lengths::new(&long, &result, 2.0);
        assert_eq!(lengths.narrowed, 0.0);
        let ends = mean_narrowed_width([MeshReport { lengths, ..mesh(0.5, 1.0, 0) }].iter());
        assert_eq!((ends, told_mean(ends).as_str()), (0.0, "to a point at both ends"));
        assert_eq!(told_mean(0.251), "mean 0.25");
    }

    #[test]
    fn json_names_the_reasons_and_keeps_its_order() {
        let text =
            String::from_utf8(report(vec![file(vec![mesh(0.5, 1.0, 2)])]).to_json().unwrap());
        let text = text.unwrap();
        assert!(text.contains("\"no_room\": 2"), "{text}");
        assert!(!text.contains("folds") && !text.contains("error"), "{text}");
        let place = |key: &str| text.find(key).unwrap();
        assert!(place("\"file\"") < place("\"output\""));
        assert!(place("\"hard_edges\"") < place("\"full\""));
        assert!(place("\"files\"") < place("\"totals\""));
    }

    #[test]
    fn no_time_is_never_less_than_none() {
        let empty = FileReport::new(Path::new("a.obj"), Path::new("b.obj"), Duration::ZERO);
        assert!(empty.to_string().ends_with("; 0.0 ms"), "{empty}");
        assert!(report(vec![]).totals.milliseconds.is_sign_positive());
    }

    #[test]
    fn a_failed_file_is_counted_and_says_why() {
        let mut failed = file(Vec::new());
        failed.error = Some("broken".into());
        let report = report(vec![failed]);
        assert_eq!(report.totals.failed, 1);
        assert!(String::from_utf8(report.to_json().unwrap()).unwrap().contains("\"broken\""));
    }
}
