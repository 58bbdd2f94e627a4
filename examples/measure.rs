//! Measures how a folder of models is chamfered: soundness, coverage and width.
//!
//! `cargo run --release --example measure -- [--full] [--verbose] [--only NAME] [--folder DIR] PERCENT..`

#[path = "../tests/corpus/measure.rs"]
mod measure;

use std::path::Path;

use chamfer::Verify;
use measure::{FOLDER, Sum, measure, models};

fn main() {
    let mut arguments = std::env::args().skip(1);
    let (mut verify, mut verbose, mut only, mut percents) = (Verify::Fast, false, None, Vec::new());
    let mut folder = FOLDER.to_owned();
    while let Some(argument) = arguments.next() {
        match argument.as_str() {
            "--full" => verify = Verify::Full,
            "--verbose" => verbose = true,
            "--only" => only = arguments.next(),
            "--folder" => folder = arguments.next().unwrap_or(folder),
            percent => percents.extend(percent.parse::<f32>().ok()),
        }
    }
    for percent in percents {
        let mut sum = Sum::default();
        for path in models(Path::new(&folder)) {
            if only.as_ref().is_some_and(|name| !path.to_string_lossy().contains(name.as_str())) {
                continue;
            }
            let meshes = match measure(&path, percent, verify) {
                Ok(meshes) => meshes,
                Err(error) => {
                    println!("{}: {error}", path.display());
                    continue;
                }
            };
            let mut file = Sum::default();
            for mesh in &meshes {
                file.add(mesh);
                sum.add(mesh);
                if !mesh.findings.is_sound() {
                    println!("{} at {percent} %:\n{}", mesh.name, mesh.findings);
                }
            }
            if verbose {
                println!("{}: {file}", path.display());
            }
        }
        println!("{percent} %: {sum}");
    }
}
