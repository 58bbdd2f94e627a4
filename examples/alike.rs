//! Does the same shape get the same chamfers, however it is told?
//!
//! `cargo run --release --example alike -- [--full] [--verbose] [--edges] [--seed N] [--only NAME]
//! [--folder DIR] [PERCENT..]`
//!
//! Every mesh of a folder is told in other ways (triangles shuffled, vertices renumbered, corners
//! turned, mirrored, axes cycled, moved), and what comes out is compared with what came out before:
//! totals and mean width. `--verbose` names the meshes that differ, `--edges` their edges.

#[path = "../tests/corpus/measure.rs"]
#[allow(dead_code)]
mod measure;
#[path = "../tests/support/retold.rs"]
mod retold;

use std::collections::BTreeMap;
use std::path::Path;

use chamfer::{Chamfered, EdgeVerdict, MeshBuffers, Options, Verify, Width, chamfer};
use chamfer_formats as formats;
use chamfer_formats::ReadOptions;
use retold::Retold;

struct Request {
    verify: Verify,
    is_verbose: bool,
    are_edges_asked: bool,
    seed: u32,
    only: String,
    folder: String,
    percents: Vec<f32>,
}

impl Request {
    fn new(mut arguments: impl Iterator<Item = String>) -> Request {
        let mut request = Request {
            verify: Verify::Fast,
            is_verbose: false,
            are_edges_asked: false,
            seed: 1,
            only: String::new(),
            folder: measure::FOLDER.to_owned(),
            percents: Vec::new(),
        };
        while let Some(argument) = arguments.next() {
            let mut text = || arguments.next().unwrap_or_default();
            match argument.as_str() {
                "--full" => request.verify = Verify::Full,
                "--verbose" => request.is_verbose = true,
                "--edges" => request.are_edges_asked = true,
                "--seed" => request.seed = text().parse().unwrap_or(1),
                "--only" => request.only = text(),
                "--folder" => request.folder = text(),
                percent => request.percents.extend(percent.parse::<f32>().ok()),
            }
        }
        if request.percents.is_empty() {
            request.percents.push(1.0);
        }
        request
    }
}

fn main() {
    let request = Request::new(std::env::args().skip(1));
    for &percent in &request.percents {
        let mut sums: Vec<Sum> = retold::all(request.seed).map(Sum::new).into();
        for path in measure::models(Path::new(&request.folder)) {
            if path.to_string_lossy().contains(&request.only) {
                of_file(&request, &path, percent, &mut sums);
            }
        }
        sums.iter().for_each(|sum| sum.print(percent));
    }
}

fn of_file(request: &Request, path: &Path, percent: f32, sums: &mut [Sum]) {
    let document = match formats::read(path, &ReadOptions::default()) {
        Ok(document) => document,
        Err(error) => return println!("{}: {error:#}", path.display()),
    };
    let options =
        Options::default().with_width(Width::PercentOfExtent(percent)).with_verify(request.verify);
    let file = path.file_stem().unwrap_or_default().to_string_lossy();
    for source in document.meshes() {
        let run = |mesh: &MeshBuffers| chamfer(&mesh.as_mesh(), &options);
        for sum in &mut *sums {
            let base = sum.way.base(&source.mesh);
            let Ok(first) = run(&base) else { continue };
            let mesh = sum.way.apply(&source.mesh);
            let Ok(other) = run(&mesh) else { continue };
            let name = format!("{file}/{}", source.name);
            let is_alike = sum.add(&name, &first, &other);
            if request.is_verbose && !is_alike {
                println!("{:?} {name}: {} or {}", sum.way, told(&first), told(&other));
            }
            if request.are_edges_asked && !is_alike {
                print_edges((&base, &first), (&mesh, &other), sum.way);
            }
        }
    }
}

fn told(chamfered: &Chamfered) -> String {
    let totals = &chamfered.totals;
    let skipped = totals.skipped.iter().filter(|(_, count)| *count > 0);
    let skipped: Vec<String> =
        skipped.map(|(reason, count)| format!("{} {count}", reason.name())).collect();
    let (full, narrowed) = (totals.chamfered, totals.narrowed);
    format!("{full} full {narrowed} narrowed {skipped:?} {:.4}", totals.mean_width)
}

/// What became of the meshes of a folder when they were told in one other way.
struct Sum {
    way: Retold,
    meshes: u32,
    same_totals: u32,
    /// Those with other totals whose mean width is the same within a twentieth.
    near: u32,
    other_count: u32,
    /// By how much the mean width differs most, as a share of the larger, and where.
    worst: (f32, String),
}

impl Sum {
    fn new(way: Retold) -> Sum {
        Sum { way, meshes: 0, same_totals: 0, near: 0, other_count: 0, worst: Default::default() }
    }

    /// Whether the totals are the same.
    fn add(&mut self, name: &str, first: &Chamfered, other: &Chamfered) -> bool {
        let counts = |c: &Chamfered| {
            let skipped: Vec<u32> = c.totals.skipped.iter().map(|(_, count)| count).collect();
            (c.totals.chamfered, c.totals.narrowed, skipped)
        };
        let [one, two] = [first, other].map(|c| c.totals.mean_width);
        let off = (one - two).abs() / one.max(two).max(f32::MIN_POSITIVE);
        let is_alike = counts(first) == counts(other);
        self.meshes += 1;
        self.same_totals += u32::from(is_alike);
        self.near += u32::from(!is_alike && off <= 0.05);
        self.other_count += u32::from(first.totals.hard_edges != other.totals.hard_edges);
        if off > self.worst.0 {
            self.worst = (off, name.to_owned());
        }
        is_alike
    }

    fn print(&self, percent: f32) {
        let share = 100.0 * f64::from(self.same_totals) / f64::from(self.meshes.max(1));
        println!(
            "{percent} % {:?}: {} of {} meshes with the same totals ({share:.1} %), {} more within \
             5 % of the mean width, {} with another number of hard edges; worst {:.1} % in {}",
            self.way,
            self.same_totals,
            self.meshes,
            self.near,
            self.other_count,
            100.0 * self.worst.0,
            self.worst.1,
        );
    }
}

/// Prints the edges that became something else: matched by place, which tells none apart where
/// several lie on each other.
fn print_edges(
    (before, first): (&MeshBuffers, &Chamfered),
    (retold, other): (&MeshBuffers, &Chamfered),
    way: Retold,
) {
    let one = by_place(before, first, |point| point);
    let back = |point: [f32; 3]| match way {
        Retold::Mirrored => [-point[0], point[1], point[2]],
        Retold::Cycled => [point[2], point[0], point[1]],
        _ => point,
    };
    // What is moved keeps its numbers, and coming back might round.
    let retold = if way == Retold::Moved { before } else { retold };
    let two = by_place(retold, other, back);
    for (place, verdicts) in &one {
        let others = two.get(place).map_or(&[][..], |others| others);
        let kinds = |verdicts: &[EdgeVerdict]| -> Vec<_> {
            verdicts.iter().map(|v| (v.outcome, v.reason)).collect()
        };
        let widths = |verdicts: &[EdgeVerdict]| -> Vec<_> {
            let mut all: Vec<_> = verdicts.iter().flat_map(|v| v.widths).collect();
            all.sort_by(f32::total_cmp);
            all
        };
        let close = |a: f32, b: f32| (a - b).abs() <= 0.01 * a.max(b);
        let (a, b) = (widths(verdicts), widths(others));
        let alike = a.len() == b.len() && a.iter().zip(&b).all(|(a, b)| close(*a, *b));
        if kinds(verdicts) != kinds(others) || !alike {
            let points = place.map(|end| end.map(f32::from_bits));
            println!("  {points:?}: {:?} {a:?} or {:?} {b:?}", kinds(verdicts), kinds(others));
        }
    }
}

/// The verdicts of the edges between two places.
type ByPlace = BTreeMap<[[u32; 3]; 2], Vec<EdgeVerdict>>;

fn by_place(
    mesh: &MeshBuffers,
    chamfered: &Chamfered,
    back: impl Fn([f32; 3]) -> [f32; 3],
) -> ByPlace {
    let mut places = ByPlace::new();
    for &verdict in &chamfered.verdicts {
        let at = |v: u32| back(mesh.positions[v as usize]).map(|x| (x + 0.0).to_bits());
        let mut ends = verdict.vertices.map(at);
        ends.sort_unstable();
        places.entry(ends).or_default().push(verdict);
    }
    places
}
