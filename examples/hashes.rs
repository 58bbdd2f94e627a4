//! Prints a hash of every result on a folder of models, to compare platforms, builds and threads.
//!
//! `cargo run --release --example hashes -- [--threads N] [--folder DIR] [--fast] PERCENT..`

#[path = "../tests/support/fingerprint.rs"]
mod fingerprint;
#[allow(dead_code)]
#[path = "../tests/corpus/measure.rs"]
mod measure;

use std::path::Path;

use chamfer::{Options, Verify, Width, chamfer, shapes};
use chamfer_formats as formats;
use chamfer_formats::ReadOptions;
use fingerprint::fingerprint;

fn main() {
    let mut arguments = std::env::args().skip(1);
    let (mut options, mut percents) = (Options::default(), Vec::new());
    let mut folder = measure::FOLDER.to_owned();
    while let Some(argument) = arguments.next() {
        match argument.as_str() {
            "--fast" => options.verify = Verify::Fast,
            "--folder" => folder = arguments.next().unwrap_or(folder),
            "--threads" => {
                options.threads = arguments.next().and_then(|n| n.parse().ok()).unwrap_or(0);
            }
            percent => percents.extend(percent.parse::<f32>().ok()),
        }
    }
    for (percent, path) in percents.iter().flat_map(|&percent| {
        measure::models(Path::new(&folder)).into_iter().map(move |path| (percent, path))
    }) {
        let options = options.with_width(Width::PercentOfExtent(percent));
        let file = path.file_name().unwrap_or_default().to_string_lossy();
        match formats::read(&path, &ReadOptions::default()) {
            Err(error) => println!("{percent} % {file}: {error:#}"),
            Ok(document) => {
                for (place, source) in document.meshes().iter().enumerate() {
                    let hash = chamfer(&source.mesh.as_mesh(), &options);
                    let hash = hash.map(|result| format!("{:016x}", fingerprint(&result)));
                    println!(
                        "{percent} % {file} {place}: {}",
                        hash.unwrap_or_else(|e| e.to_string())
                    );
                }
            }
        }
    }
    for (name, mesh) in shapes::demo_models() {
        if let Ok(result) = chamfer(&mesh.as_mesh(), &options) {
            println!("demo {name}: {:016x}", fingerprint(&result));
        }
    }
}
