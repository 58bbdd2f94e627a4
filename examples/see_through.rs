//! Looks through a folder of models: after which does light show where none did before?
//!
//! `cargo run --release --example see_through -- [--fast] [--held] [--verbose] [--only NAME] [--folder DIR]
//! [--views N] [--resolution N] [--turned] [--judge RESOLUTION] [--close-ups DIR] [PERCENT..]`

#[path = "../tests/corpus/measure.rs"]
#[allow(dead_code)]
mod measure;

use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;

use chamfer::see_through::{Eyes, Leak, SceneTriangle, leaks};
use chamfer::{Mesh, Options, Placed, Reason, Totals, Verify, Width, chamfer, chamfer_scene};
use chamfer_cli::close_up::close_up;
use chamfer_cli::pictures::write_png;
use chamfer_cli::preview::{Panel, SMALL_TILE, contact_sheet};
use chamfer_cli::scene::{largest_length, placed, scene_triangles};
use chamfer_formats as formats;
use chamfer_formats::ReadOptions;
use glam::{Quat, Vec3};

struct Request {
    verify: Verify,
    is_verbose: bool,
    is_held: bool,
    /// Whether the result is judged from other directions than those that held it.
    is_turned: bool,
    /// Who judges the result.
    judge: Eyes,
    only: Option<String>,
    folder: String,
    eyes: Eyes,
    close_ups: Option<PathBuf>,
    percents: Vec<f32>,
}

impl Request {
    fn new(mut arguments: impl Iterator<Item = String>) -> Request {
        let mut request = Request {
            verify: Verify::Full,
            is_verbose: false,
            is_held: false,
            is_turned: false,
            judge: Eyes::default().with_threads(0),
            only: None,
            folder: measure::FOLDER.to_owned(),
            eyes: Eyes::default().with_threads(0),
            close_ups: None,
            percents: Vec::new(),
        };
        while let Some(argument) = arguments.next() {
            let mut number = || arguments.next().and_then(|text| text.parse().ok());
            match argument.as_str() {
                "--fast" => request.verify = Verify::Fast,
                "--held" => request.is_held = true,
                "--turned" => request.is_turned = true,
                "--judge" => {
                    request.judge.resolution = number().unwrap_or(request.judge.resolution);
                }
                "--verbose" => request.is_verbose = true,
                "--views" => request.eyes.views = number().unwrap_or(request.eyes.views),
                "--resolution" => {
                    request.eyes.resolution = number().unwrap_or(request.eyes.resolution);
                }
                "--close-ups" => request.close_ups = arguments.next().map(PathBuf::from),
                "--only" => request.only = arguments.next(),
                "--folder" => request.folder = arguments.next().unwrap_or(request.folder),
                percent => request.percents.extend(percent.parse::<f32>().ok()),
            }
        }
        request
    }

    fn paths(&self) -> Vec<PathBuf> {
        let mut paths = measure::models(Path::new(&self.folder));
        paths.retain(|path| {
            self.only.as_ref().is_none_or(|name| path.to_string_lossy().contains(name.as_str()))
        });
        paths
    }
}

fn main() {
    let request = Request::new(std::env::args().skip(1));
    let paths = request.paths();
    for &percent in &request.percents {
        let (next, leaking) = (AtomicUsize::new(0), AtomicUsize::new(0));
        std::thread::scope(|scope| {
            for _ in 0..2 {
                scope.spawn(|| {
                    while let Some(path) = paths.get(next.fetch_add(1, Ordering::Relaxed)) {
                        let leaks = look(&request, path, percent);
                        leaking.fetch_add(usize::from(leaks > 0), Ordering::Relaxed);
                    }
                });
            }
        });
        println!("{percent} %: light shows in {leaking:?} of {} models", paths.len());
    }
}

/// How many samples leak in a file. Prints where.
fn look(request: &Request, path: &Path, percent: f32) -> usize {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let read = ReadOptions::default();
    let document = match formats::read(path, &read) {
        Ok(document) => document,
        Err(error) => {
            println!("{name}: {error:#}");
            return 0;
        }
    };
    let options =
        Options::default().with_width(Width::PercentOfExtent(percent)).with_verify(request.verify);
    let meshes: Vec<Mesh> = document.meshes().iter().map(|mesh| mesh.mesh.as_mesh()).collect();
    let objects: Vec<Placed> = document
        .instances()
        .iter()
        .map(|instance| Placed { mesh: instance.mesh, transform: instance.transform })
        .collect();
    let mut run = |_: usize, mesh: &Mesh| chamfer(mesh, &options);
    let eyes = request.is_held.then_some(request.eyes);
    let scene = chamfer_scene(&meshes, &objects, eyes, &mut run).expect("what was read is sound");
    let (chamfered, rounds) = (scene.meshes, scene.rounds);
    let counts = chamfered.iter().fold([0; 3], |[hard, contact, skipped], mesh| {
        let Totals { hard_edges, skipped: left, .. } = mesh.totals;
        let held = left[Reason::Contact];
        [hard + hard_edges, contact + held, skipped + left.total()]
    });
    let before = scene_triangles(&*document, |mesh| &document.meshes()[mesh].mesh);
    let after = scene_triangles(&*document, |mesh| &chamfered[mesh].mesh);
    let width = largest_length(&*document, |mesh| Some(chamfered[mesh].width)).unwrap_or(0.0);
    let start = Instant::now();
    let found = if request.is_turned {
        let turn = |scene: Vec<SceneTriangle>| -> Vec<SceneTriangle> {
            let turn = Quat::from_axis_angle(Vec3::new(0.36, 0.48, 0.8), 0.4);
            scene.into_iter().map(|t| t.map(|p| (turn * Vec3::from(p)).to_array())).collect()
        };
        leaks(&turn(before), &turn(after.clone()), width, request.judge)
    } else {
        leaks(&before, &after, width, request.judge)
    };
    let seconds = start.elapsed().as_secs_f64();
    let count = |leaks: &mut dyn Iterator<Item = &Leak>| -> usize {
        leaks.map(|leak| leak.places.len()).sum()
    };
    let samples = count(&mut found.iter());
    let past = count(&mut found.iter().filter(|leak| leak.is_past_outlines));
    if rounds > 0 || samples > 0 || request.is_verbose {
        println!(
            "{name} at {percent} %: {samples} samples in {} leaks, {past} past outlines; {rounds} rounds; hard, contact, \
             skipped: {counts:?}; {} triangles, {:.0} ms",
            found.len(),
            after.len(),
            seconds * 1e3
        );
        let mut worst: Vec<&Leak> = found.iter().collect();
        worst.sort_by_key(|leak| std::cmp::Reverse(leak.places.len()));
        if let Some(folder) = &request.close_ups {
            let scenes = || {
                let before = placed(&*document, |mesh| &document.meshes()[mesh].mesh);
                [before, placed(&*document, |mesh| &chamfered[mesh].mesh)]
            };
            let shown = worst.iter().take(CLOSE_UPS);
            let panels: Vec<Panel> =
                shown.map(|leak| close_up(name.to_string(), scenes(), leak, width)).collect();
            std::fs::create_dir_all(folder).expect("the folder can be made");
            let file = folder.join(format!("{name}.{percent}.png"));
            write_png(&file, &contact_sheet(&panels, SMALL_TILE))
                .expect("the picture can be written");
        }
        for leak in worst.into_iter().take(if request.is_verbose { 12 } else { 0 }) {
            println!(
                "    {} samples{} at {:?} seen from {:?}, {:.2} widths deep",
                leak.places.len(),
                if leak.is_past_outlines { " past outlines" } else { "" },
                leak.middle(),
                leak.toward_eye,
                leak.depth / width
            );
        }
    }
    samples
}

/// How many of a file's leaks are drawn.
const CLOSE_UPS: usize = 4;
