//! What the corpus is measured by: every model at some widths, through the whole-mesh checker.

use std::fmt;
use std::path::{Path, PathBuf};

use chamfer::check::{Findings, check};
use chamfer::{
    ByReason, Chamfered, EdgeVerdict, Factors, Mesh, Options, Reason, Totals, Verify, Width,
    chamfer,
};
use chamfer_formats as formats;
use chamfer_formats::ReadOptions;

/// The models, beside the project.
pub const FOLDER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../shared/corpus");

/// All models of a folder that the command line can read, sorted; none without the folder.
pub fn models(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let mut paths: Vec<PathBuf> = entries
        .map(|entry| entry.path())
        .filter(|path| {
            let extension = path.extension().and_then(|extension| extension.to_str());
            matches!(extension, Some("glb" | "gltf" | "obj" | "stl"))
        })
        .collect();
    paths.sort();
    paths
}

/// One mesh of a file, chamfered and checked.
pub struct Measured {
    pub name: String,
    pub totals: Totals,
    /// Sum of the hard edges' lengths, as a share of the extent: the weight of the mean width.
    pub length: f64,
    /// The mean width at the ends that open, as a share of what was asked; none if no end does.
    pub open_width: Option<f64>,
    /// How many segments the chamfered edges have, summed over them.
    pub segments: u64,
    pub findings: Findings,
    pub seconds: f64,
}

fn length(before: &Mesh, verdict: &EdgeVerdict) -> f64 {
    let [a, b] = verdict.vertices.map(|vertex| before.positions[vertex as usize]);
    (0..3).map(|k| f64::from(a[k] - b[k]).powi(2)).sum::<f64>().sqrt()
}

/// Weighted by edge length.
fn open_width(before: &Mesh, after: &Chamfered) -> Option<f64> {
    let (mut whole, mut got) = (0.0, 0.0);
    for verdict in &after.verdicts {
        for width in verdict.widths.into_iter().filter(|&width| width > 0.0) {
            let length = length(before, verdict);
            whole += length;
            got += length * f64::from((width / after.width).min(1.0));
        }
    }
    (whole > 0.0).then(|| got / whole)
}

/// Chamfers and checks every mesh of a file; `inspect` sees each before and after.
///
/// # Errors
/// Where the file cannot be read or chamfered: the reason.
pub fn measure(
    path: &Path,
    percent: f32,
    verify: Verify,
    inspect: impl FnMut(&Mesh, &Chamfered),
) -> Result<Vec<Measured>, String> {
    let options =
        Options::default().with_width(Width::PercentOfExtent(percent)).with_verify(verify);
    measure_with(path, &options, |_| Unlike::default(), inspect)
}

/// Factors of the vertices and of the submeshes of a mesh; none where empty.
#[derive(Default)]
pub struct Unlike {
    pub vertices: Vec<f32>,
    pub submeshes: Vec<f32>,
}

/// As [`measure`], with factors for each mesh.
///
/// # Errors
/// As [`measure`].
pub fn measure_with(
    path: &Path,
    options: &Options,
    unlike: impl Fn(&Mesh) -> Unlike,
    mut inspect: impl FnMut(&Mesh, &Chamfered),
) -> Result<Vec<Measured>, String> {
    let verify = options.verify;
    let read = ReadOptions::default();
    let document = formats::read(path, &read).map_err(|error| format!("{error:#}"))?;
    let file = path.file_name().unwrap_or_default().to_string_lossy();
    let mut measured = |source: &chamfer_formats::SourceMesh| {
        let Unlike { vertices, submeshes } = unlike(&source.mesh.as_mesh());
        let factors = Factors { vertices: &vertices, submeshes: &submeshes, edges: &[] };
        let before = Mesh { factors, ..source.mesh.as_mesh() };
        let start = std::time::Instant::now();
        let after = chamfer(&before, options).map_err(|error| error.to_string())?;
        let seconds = start.elapsed().as_secs_f64();
        let extent = f64::from(before.extent()).max(f64::MIN_POSITIVE);
        inspect(&before, &after);
        let lengths = after.verdicts.iter().map(|verdict| length(&before, verdict));
        Ok(Measured {
            name: format!("{file}/{}", source.name),
            totals: after.totals,
            length: lengths.sum::<f64>() / extent,
            open_width: open_width(&before, &after),
            segments: after.verdicts.iter().map(|verdict| u64::from(verdict.segments)).sum(),
            findings: check(&before, &after, verify),
            seconds,
        })
    };
    document.meshes().iter().map(&mut measured).collect()
}

/// Sums over meshes.
#[derive(Default)]
pub struct Sum {
    pub meshes: u32,
    pub hard_edges: u32,
    pub chamfered: u32,
    pub narrowed: u32,
    pub skipped: ByReason,
    pub unsound: u32,
    pub seconds: f64,
    segments: u64,
    length: f64,
    width: f64,
    /// The sum of the open widths of the meshes that have any, and how many have.
    open_widths: (f64, u32),
}

impl Sum {
    pub fn extend(&mut self, meshes: &[Measured]) {
        meshes.iter().for_each(|mesh| self.add(mesh));
    }

    fn add(&mut self, mesh: &Measured) {
        self.meshes += 1;
        self.hard_edges += mesh.totals.hard_edges;
        self.chamfered += mesh.totals.chamfered;
        self.narrowed += mesh.totals.narrowed;
        for (reason, count) in mesh.totals.skipped.iter() {
            self.skipped[reason] += count;
        }
        self.unsound += u32::from(!mesh.findings.is_sound());
        self.segments += mesh.segments;
        self.seconds += mesh.seconds;
        self.length += mesh.length;
        self.width += mesh.length * f64::from(mesh.totals.mean_width);
        if let Some(open) = mesh.open_width {
            self.open_widths = (self.open_widths.0 + open, self.open_widths.1 + 1);
        }
    }

    /// The share of the hard edges that have a chamfer, by count, of those that may have one: along
    /// contacts light would show, and where two sides share no edge there is nothing to close.
    pub fn chamfered_share(&self) -> f64 {
        let cannot = [Reason::Contact, Reason::TJunction, Reason::Winding];
        let cannot: u32 = cannot.into_iter().map(|reason| self.skipped[reason]).sum();
        f64::from(self.chamfered + self.narrowed) / f64::from((self.hard_edges - cannot).max(1))
    }

    /// The mean over the meshes of the width at the ends that open.
    pub fn mean_open_width(&self) -> f64 {
        self.open_widths.0 / f64::from(self.open_widths.1.max(1))
    }

    /// The mean width as a share of what was asked, skipped edges counted, weighted by edge length
    /// over mesh extent.
    pub fn mean_width(&self) -> f64 {
        if self.length > 0.0 { self.width / self.length } else { 0.0 }
    }
}

impl fmt::Display for Sum {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(
            f,
            "{} meshes, {} unsound; {} hard edges, {:.2} % chamfered ({} full, {} narrowed), mean width {:.2} %, of open ends by mesh {:.2} %, {:.3} segments; {:.2} s; skipped:",
            self.meshes,
            self.unsound,
            self.hard_edges,
            self.chamfered_share() * 100.0,
            self.chamfered,
            self.narrowed,
            self.mean_width() * 100.0,
            self.mean_open_width() * 100.0,
            self.segments as f64 / f64::from((self.chamfered + self.narrowed).max(1)),
            self.seconds,
        )?;
        for (reason, count) in self.skipped.iter().filter(|(_, count)| *count > 0) {
            write!(f, " {} {count}", reason.name())?;
        }
        Ok(())
    }
}
