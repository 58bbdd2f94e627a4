//! What became of files, in a line each, and of all of them in one.

use std::fmt;
use std::time::Duration;

use crate::console::one_line;
use crate::report::{Counts, FileReport, MeshReport, Report, mean_narrowed_width, told_mean};

/// The line of a file.
impl fmt::Display for FileReport {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let (from, to) = (one_line(&self.file), one_line(&self.output));
        let edges = Edges::of(&self.meshes);
        write!(f, "{from} -> {to}: {edges}; {:.1} ms", self.milliseconds)
    }
}

/// The lines of its meshes, for those who want to know.
pub fn meshes(file: &FileReport) -> impl Iterator<Item = String> {
    let line = |mesh: &MeshReport| {
        let edges = Edges::of(std::slice::from_ref(mesh));
        format!("  {}: {edges}; width {}", one_line(&mesh.name), mesh.width)
    };
    file.meshes.iter().map(line)
}

/// The line that ends a run.
pub fn closing(report: &Report, planned: usize, time: Duration) -> String {
    let totals = &report.totals;
    let done = match report.interrupted {
        true => format!("interrupted: {} of {planned} files done", totals.files - totals.failed),
        false => format!("{} files", totals.files),
    };
    let failed = match totals.failed {
        0 => String::new(),
        failed => format!(", {failed} failed"),
    };
    let edges = Edges { counts: &totals.counts, narrowed: totals.mean_narrowed_width };
    format!("{done}{failed}: {edges}; {:.1} s", time.as_secs_f64())
}

/// What became of edges, in words.
struct Edges<T> {
    counts: T,
    /// Mean width of the narrowed ones, as a share of that asked for.
    narrowed: f32,
}

impl Edges<Counts> {
    fn of(meshes: &[MeshReport]) -> Edges<Counts> {
        Edges { counts: Counts::sum(meshes.iter()), narrowed: mean_narrowed_width(meshes.iter()) }
    }
}

impl<T: std::borrow::Borrow<Counts>> fmt::Display for Edges<T> {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let counts = self.counts.borrow();
        let noun = if counts.hard_edges == 1 { "hard edge" } else { "hard edges" };
        write!(f, "{} {noun}", counts.hard_edges)?;
        if counts.hard_edges > 0 {
            write!(f, ": {} full", counts.full)?;
        }
        if counts.narrowed > 0 {
            write!(f, ", {} narrowed ({})", counts.narrowed, told_mean(self.narrowed))?;
        }
        if counts.skipped.total() > 0 {
            write!(f, ", {} skipped ({})", counts.skipped.total(), counts.skipped.text())?;
        }
        write!(f, "; {} -> {} triangles", counts.triangles_in, counts.triangles_out)
    }
}
