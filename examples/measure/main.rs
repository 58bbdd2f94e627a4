//! Measures how a folder of models is chamfered: soundness, coverage and width.
//!
//! `cargo run --release --example measure -- [--full] [--verbose] [--reach] [--compare]
//! [--only NAME] [--folder DIR] PERCENT..`
//!
//! `--reach` also tells how wide the chamfers could be where neighbours leave them half of the way
//! to each other: width that is lost beyond that is lost to the triangles, not to the shape.
//! `--compare` also checks each result as `chamfer check` does, by what went in and what came out
//! alone.

#[path = "../../tests/corpus/measure.rs"]
mod measure;
mod reach;

use std::path::{Path, PathBuf};

use chamfer::check::{check, compare};
use chamfer::{Chamfered, Mesh, Verify};
use measure::{FOLDER, Measured, Sum, measure, models};

/// What was asked for on the command line.
struct Request {
    verify: Verify,
    is_verbose: bool,
    is_reach_asked: bool,
    is_compared: bool,
    only: Option<String>,
    folder: String,
    percents: Vec<f32>,
}

impl Request {
    fn new(mut arguments: impl Iterator<Item = String>) -> Request {
        let mut request = Request {
            verify: Verify::Fast,
            is_verbose: false,
            is_reach_asked: false,
            is_compared: false,
            only: None,
            folder: FOLDER.to_owned(),
            percents: Vec::new(),
        };
        while let Some(argument) = arguments.next() {
            match argument.as_str() {
                "--full" => request.verify = Verify::Full,
                "--verbose" => request.is_verbose = true,
                "--reach" => request.is_reach_asked = true,
                "--compare" => request.is_compared = true,
                "--only" => request.only = arguments.next(),
                "--folder" => request.folder = arguments.next().unwrap_or(request.folder),
                percent => request.percents.extend(percent.parse::<f32>().ok()),
            }
        }
        request
    }

    fn paths(&self) -> Vec<PathBuf> {
        let mut paths = models(Path::new(&self.folder));
        paths.retain(|path| {
            self.only.as_ref().is_none_or(|name| path.to_string_lossy().contains(name.as_str()))
        });
        paths
    }
}

fn main() {
    let request = Request::new(std::env::args().skip(1));
    for &percent in &request.percents {
        let (mut sum, mut reaches) = (Sum::default(), Vec::new());
        for path in request.paths() {
            sum.extend(&of_file(&request, &path, percent, &mut reaches));
        }
        println!("{percent} %: {sum}");
        if request.is_reach_asked {
            let mean = reaches.iter().sum::<f64>() / reaches.len().max(1) as f64;
            println!("within reach, by mesh: {:.2} %", mean * 100.0);
        }
    }
}

/// Measures a file, and prints what is wrong with it.
fn of_file(request: &Request, path: &Path, percent: f32, reaches: &mut Vec<f64>) -> Vec<Measured> {
    let measured = measure(path, percent, request.verify, |before, after| {
        if request.is_reach_asked && after.totals.hard_edges > 0 {
            reaches.push(reach::reach(before, after));
        }
        if request.is_compared {
            print_compared(path, percent, before, after);
        }
    });
    let meshes = measured.unwrap_or_else(|error| {
        println!("{}: {error}", path.display());
        Vec::new()
    });
    for mesh in meshes.iter().filter(|mesh| !mesh.findings.is_sound()) {
        println!("{} at {percent} %:\n{}", mesh.name, mesh.findings);
    }
    if request.is_verbose {
        let mut file = Sum::default();
        file.extend(&meshes);
        println!("{}: {file}", path.display());
    }
    meshes
}

/// Prints what seems to be otherwise where nothing tells what came from what.
fn print_compared(path: &Path, percent: f32, before: &Mesh, after: &Chamfered) {
    let found = compare(before, &after.mesh.as_mesh(), Verify::Fast);
    let told = check(before, after, Verify::Fast).edges;
    let others = found.edges.iter().zip(&told).filter(|(found, told)| found != told).count()
        + found.edges.len().abs_diff(told.len());
    if !found.is_sound() || others > 0 {
        let name = path.display();
        println!("by the two alone, {name} at {percent} %, {others} edges measured otherwise:");
        println!("{found}");
    }
}
