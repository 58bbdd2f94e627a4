//! What became of each file and mesh, for the terminal and as JSON.

use std::fmt;
use std::path::Path;
use std::time::Duration;

use anyhow::Result;
use chamfer::{ByReason, Chamfered, EdgeVerdict, MeshBuffers, Reason};
use serde::{Serialize, Serializer};

use crate::console::one_line;

/// The whole report.
#[derive(Debug, Serialize)]
pub struct Report {
    /// In the order of the inputs.
    pub files: Vec<FileReport>,
    /// What could not be searched for models.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub notes: Vec<String>,
    /// Sums over all files.
    pub totals: ReportTotals,
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
    /// The width asked for, in mesh units.
    pub width: f32,
    /// Time in the core and for looking at the scene: its share of what the file took.
    pub milliseconds: f64,
    /// Its hard edges with two sides, where they were asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub edges: Option<Vec<EdgeReport>>,
    /// Length of all hard edges together: the weight of `mean_width` in sums.
    #[serde(skip)]
    pub hard_length: f64,
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
    /// At each end, the distance from the old edge to the pulled ones, in mesh units.
    pub widths: [f32; 2],
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
    pub chamfered: u64,
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
    /// Mean width as a share (0 to 1) of the width asked for, weighted by edge length.
    pub mean_width: f32,
    /// Time from reading to writing, of all files together.
    pub milliseconds: f64,
}

impl Report {
    /// Adds up the files.
    pub fn new(files: Vec<FileReport>, notes: Vec<String>) -> Report {
        let meshes = || files.iter().flat_map(|file| &file.meshes);
        let totals = ReportTotals {
            files: files.len() as u64,
            failed: files.iter().filter(|file| file.error.is_some()).count() as u64,
            meshes: meshes().count() as u64,
            counts: Counts::sum(meshes()),
            mean_width: mean_width(meshes()),
            milliseconds: round(files.iter().fold(0.0, |sum, file| sum + file.milliseconds)),
        };
        Report { files, notes, totals }
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

/// The line for the terminal.
impl fmt::Display for FileReport {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let counts = Counts::sum(self.meshes.iter());
        write!(
            f,
            "{} -> {}: {} hard edges: {} chamfered, {} narrowed, {} skipped; \
             {} -> {} triangles; {:.1} ms",
            one_line(&self.file),
            one_line(&self.output),
            counts.hard_edges,
            counts.chamfered,
            counts.narrowed,
            counts.skipped.total(),
            counts.triangles_in,
            counts.triangles_out,
            self.milliseconds,
        )
    }
}

impl MeshReport {
    /// What the core says of a mesh, and what can be measured on it.
    pub fn new(name: &str, source: &MeshBuffers, result: &Chamfered, time: Duration) -> MeshReport {
        let totals = &result.totals;
        MeshReport {
            name: name.into(),
            counts: Counts {
                triangles_in: source.indices.len() as u64 / 3,
                triangles_out: result.mesh.indices.len() as u64 / 3,
                vertices_in: source.positions.len() as u64,
                vertices_out: result.mesh.positions.len() as u64,
                hard_edges: totals.hard_edges.into(),
                chamfered: totals.chamfered.into(),
                narrowed: totals.narrowed.into(),
                skipped: Skipped::new(&totals.skipped),
            },
            mean_width: totals.mean_width,
            width: result.width,
            milliseconds: milliseconds(time),
            edges: None,
            hard_length: hard_length(source, result),
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
        };
        MeshReport { edges: Some(result.verdicts.iter().map(edge).collect()), ..self }
    }
}

impl Counts {
    fn sum<'a>(meshes: impl Iterator<Item = &'a MeshReport>) -> Counts {
        meshes.fold(Counts::default(), |mut sum, MeshReport { counts, .. }| {
            sum.triangles_in += counts.triangles_in;
            sum.triangles_out += counts.triangles_out;
            sum.vertices_in += counts.vertices_in;
            sum.vertices_out += counts.vertices_out;
            sum.hard_edges += counts.hard_edges;
            sum.chamfered += counts.chamfered;
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

fn mean_width<'a>(meshes: impl Iterator<Item = &'a MeshReport>) -> f32 {
    let (sum, length) = meshes.fold((0.0, 0.0), |(sum, length), mesh| {
        (sum + f64::from(mesh.mean_width) * mesh.hard_length, length + mesh.hard_length)
    });
    if length > 0.0 { (sum / length) as f32 } else { 0.0 }
}

fn hard_length(source: &MeshBuffers, result: &Chamfered) -> f64 {
    let length = |ends: [u32; 2]| {
        let [a, b] = ends.map(|vertex| position(source, vertex));
        (0..3).map(|axis| f64::from(b[axis] - a[axis]).powi(2)).sum::<f64>().sqrt()
    };
    result.verdicts.iter().map(|verdict| length(verdict.vertices)).sum()
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
        let mut counts = Counts { hard_edges: 4, chamfered: 4 - skipped, ..Counts::default() };
        counts.skipped.0[Reason::NoRoom as usize] = skipped;
        MeshReport {
            name: "box".into(),
            counts,
            mean_width,
            width: 0.5,
            milliseconds: 1.5,
            edges: None,
            hard_length,
        }
    }

    fn file(meshes: Vec<MeshReport>) -> FileReport {
        let time = Duration::from_micros(2500);
        FileReport { meshes, ..FileReport::new(Path::new("a.obj"), Path::new("b.obj"), time) }
    }

    #[test]
    fn totals_weigh_the_width_by_edge_length() {
        let report =
            Report::new(vec![file(vec![mesh(1.0, 3.0, 0)]), file(vec![mesh(0.5, 1.0, 1)])], vec![]);
        assert_eq!(report.totals.mean_width, 0.875);
        assert_eq!(report.totals.counts.hard_edges, 8);
        assert_eq!(report.totals.milliseconds, 5.0, "with reading and writing");
    }

    #[test]
    fn json_names_the_reasons_and_keeps_its_order() {
        let text = String::from_utf8(
            Report::new(vec![file(vec![mesh(0.5, 1.0, 2)])], vec![]).to_json().unwrap(),
        );
        let text = text.unwrap();
        assert!(text.contains("\"no_room\": 2"), "{text}");
        assert!(!text.contains("folds") && !text.contains("error"), "{text}");
        let place = |key: &str| text.find(key).unwrap();
        assert!(place("\"file\"") < place("\"output\""));
        assert!(place("\"hard_edges\"") < place("\"chamfered\""));
        assert!(place("\"files\"") < place("\"totals\""));
    }

    #[test]
    fn no_time_is_never_less_than_none() {
        let empty = FileReport::new(Path::new("a.obj"), Path::new("b.obj"), Duration::ZERO);
        assert!(empty.to_string().ends_with("; 0.0 ms"), "{empty}");
        assert!(Report::new(vec![], vec![]).totals.milliseconds.is_sign_positive());
    }

    #[test]
    fn a_failed_file_is_counted_and_says_why() {
        let mut failed = file(Vec::new());
        failed.error = Some("broken".into());
        let report = Report::new(vec![failed], vec![]);
        assert_eq!(report.totals.failed, 1);
        assert!(String::from_utf8(report.to_json().unwrap()).unwrap().contains("\"broken\""));
    }
}
