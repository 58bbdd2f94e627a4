//! Measures how a folder of models is chamfered: soundness, coverage and width.
//!
//! `cargo run --release --example measure -- [--full] [--verbose] [--reach] [--compare]
//! [--unlike SEED] [--normals] [--evenness SHARE] [--segments N] [--profile P] [--only NAME]
//! [--folder DIR] PERCENT..`
//!
//! `--reach` also tells how wide the chamfers could be where neighbours leave them half of the way
//! to each other: width that is lost beyond that is lost to the triangles, not to the shape; how much
//! of what has room for the whole width gets it, and would if nothing of a face had to stay or widths
//! could jump; and how even the widths are, but for edges that taper to a point by design.
//! `--compare` also checks each result as `chamfer check` does, by what went in and what came out
//! alone. `--unlike` gives each vertex and each submesh a factor at random, some of them 0, and takes
//! all options but the width at random for each file. `--normals` counts by what angles normals differ
//! where vertices are split: what `hard_angle` tells apart.

mod chains;
mod fits;
mod ground;
#[allow(dead_code)] // Tests use more of it.
#[path = "../../tests/corpus/measure.rs"]
mod measure;
mod normals;
mod reach;

use std::path::{Path, PathBuf};

use chains::{Chains, chains};
use chamfer::check::{check, compare};
use chamfer::{
    ChamferSubmesh, Chamfered, Convexity, Mesh, Options, Verify, Width, WidthMode, chamfer,
};
use fits::Fits;
use measure::{FOLDER, Measured, Sum, Unlike, measure_with, models};
use normals::Angles;

/// What was asked for on the command line.
struct Request {
    verify: Verify,
    evenness: f32,
    is_verbose: bool,
    is_reach_asked: bool,
    is_compared: bool,
    are_normals_asked: bool,
    unlike: Option<u32>,
    only: Option<String>,
    folder: String,
    percents: Vec<f32>,
    segments: u32,
    profile: f32,
}

impl Request {
    fn new(mut arguments: impl Iterator<Item = String>) -> Request {
        let mut request = Request {
            verify: Verify::Fast,
            evenness: Options::default().evenness,
            is_verbose: false,
            is_reach_asked: false,
            is_compared: false,
            are_normals_asked: false,
            unlike: None,
            only: None,
            folder: FOLDER.to_owned(),
            percents: Vec::new(),
            segments: 1,
            profile: 0.5,
        };
        while let Some(argument) = arguments.next() {
            match argument.as_str() {
                "--full" => request.verify = Verify::Full,
                "--verbose" => request.is_verbose = true,
                "--reach" => request.is_reach_asked = true,
                "--normals" => request.are_normals_asked = true,
                "--compare" => request.is_compared = true,
                "--unlike" => request.unlike = arguments.next().and_then(|seed| seed.parse().ok()),
                "--evenness" => {
                    request.evenness = arguments.next().and_then(|e| e.parse().ok()).unwrap_or(0.0);
                }
                "--segments" => {
                    request.segments = arguments.next().and_then(|n| n.parse().ok()).unwrap_or(1);
                }
                "--profile" => {
                    request.profile = arguments.next().and_then(|n| n.parse().ok()).unwrap_or(0.5);
                }
                "--only" => request.only = arguments.next(),
                "--folder" => request.folder = arguments.next().unwrap_or(request.folder),
                percent => request.percents.extend(percent.parse::<f32>().ok()),
            }
        }
        request
    }

    fn options(&self, percent: f32) -> Options {
        Options::default()
            .with_width(Width::PercentOfExtent(percent))
            .with_verify(self.verify)
            .with_evenness(self.evenness)
            .with_segments(self.segments)
            .with_profile(self.profile)
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
        let (mut sum, mut more) = (Sum::default(), More::default());
        for path in request.paths() {
            sum.extend(&of_file(&request, &path, percent, &mut more));
        }
        println!("{percent} %: {sum}");
        if request.is_reach_asked {
            let reaches = &more.reaches;
            let mean = reaches.iter().sum::<f64>() / reaches.len().max(1) as f64;
            println!("within reach, by mesh: {:.2} %", mean * 100.0);
            print_fits(&more.fits);
            print_chains(&more.chains);
        }
        if request.are_normals_asked {
            print!("{}", more.angles);
        }
    }
}

/// Prints how much of what has room is full, and how even it is. Lengths of unlike meshes cannot be
/// added: each mesh counts by the share that it has of its own.
fn print_fits(all: &[Fits]) {
    let mean = |shares: Vec<f64>| 100.0 * shares.iter().sum::<f64>() / shares.len().max(1) as f64;
    let share = |of: &dyn Fn(&Fits) -> f64| {
        let whole = all.iter().filter(|fits| fits.whole > 0.0);
        mean(whole.map(|fits| of(fits) / fits.whole).collect())
    };
    let roomy = all.iter().filter(|fits| fits.has_room > 0.0);
    let by_mesh = mean(roomy.map(|fits| fits.full / fits.has_room).collect());
    let sum = |of: &dyn Fn(&Fits) -> usize| all.iter().map(of).sum::<usize>();
    let percent = |part: usize, whole: usize| 100.0 * part as f64 / whole.max(1) as f64;
    let (room, full) = (share(&|fits| fits.has_room), share(&|fits| fits.full));
    let (roomy, ends) = (sum(&|fits| fits.roomy), sum(&|fits| fits.ends));
    println!(
        "of all length {:.2} % full, {room:.2} % has room; of that {:.2} % full, by mesh {by_mesh:.2} %",
        share(&|fits| fits.all_full),
        100.0 * full / room,
    );
    let [breadth, evenness, both] =
        [0, 1, 2].map(|freed| 100.0 * (full + share(&|fits: &Fits| fits.held[freed])) / room);
    println!(
        "of that, with what the least breadth alone holds back {breadth:.2} %, with what evenness \
         alone does {evenness:.2} %, with what both do {both:.2} %",
    );
    println!(
        "uneven: of {roomy} edges with room {:.2} %, and {:.2} % with a verdict that says why; \
         lopsided: of {ends} ends {:.2} %",
        percent(sum(&|fits| fits.uneven), roomy),
        percent(sum(&|fits| fits.told), roomy),
        percent(sum(&|fits| fits.lopsided), ends),
    );
}

/// Prints how many straight chains of edges do not have one width.
fn print_chains(all: &[Chains]) {
    let sum = |of: fn(&Chains) -> usize| all.iter().map(of).sum::<usize>();
    let count = sum(|chains| chains.all);
    let percent = |part: usize| 100.0 * part as f64 / count.max(1) as f64;
    println!(
        "chains: of {count} straight ones {:.1} % have less than 0.9 of their widest somewhere \
         ({:.1} % without a verdict that says why; {:.1} % where an edge tapers by design), {:.1} % \
         less than half",
        percent(sum(|chains| chains.uneven)),
        percent(sum(|chains| chains.uneven - chains.told)),
        percent(sum(|chains| chains.tapering)),
        percent(sum(|chains| chains.by_half)),
    );
}

/// What is only measured where it is asked for.
#[derive(Default)]
struct More {
    reaches: Vec<f64>,
    fits: Vec<Fits>,
    chains: Vec<Chains>,
    angles: Angles,
}

/// The same where nothing of a face has to stay, where widths may jump, and where both is so.
fn freed(options: Options) -> [Options; 3] {
    let tight = options.with_least_breadth(0.0);
    let both = tight.with_evenness(0.0);
    [tight, options.with_evenness(0.0), both]
}

/// Measures a file, and prints what is wrong with it.
fn of_file(request: &Request, path: &Path, percent: f32, more: &mut More) -> Vec<Measured> {
    let inspect = |before: &Mesh, after: &Chamfered| {
        if request.is_reach_asked && after.totals.hard_edges > 0 {
            more.reaches.push(reach::reach(before, after));
            let freed = freed(request.options(percent));
            let [tight, jumping, both] = freed.map(|options| chamfer(before, &options));
            if let (Ok(tight), Ok(jumping), Ok(both)) = (tight, jumping, both) {
                more.fits.push(fits::fits(before, after, &[tight, jumping, both]));
            }
            more.chains.push(chains(before, after));
        }
        if request.are_normals_asked {
            more.angles.add(before);
        }
        if request.is_compared {
            print_compared(path, percent, before, after);
        }
    };
    let options = request.options(percent);
    let measured = match request.unlike {
        Some(seed) => {
            let mut noise = Noise::of(path, seed);
            let options = noise.options(options);
            measure_with(path, &options, |mesh| Noise(seed).unlike(mesh), inspect)
        }
        None => measure_with(path, &options, |_| Unlike::default(), inspect),
    };
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

/// As it is, stretched, mirrored, and turned and sheared.
const SCALES: [[[f32; 3]; 3]; 4] = [
    [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
    [[1.0, 0.0, 0.0], [0.0, 4.0, 0.0], [0.0, 0.0, 0.5]],
    [[-2.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 2.0]],
    [[0.6, 0.8, 0.0], [-0.8, 0.6, 0.0], [0.5, 0.0, 1.0]],
];

/// Numbers at random, the same for the same seed.
struct Noise(u32);

impl Noise {
    /// Unlike for each file, wherever it is.
    fn of(path: &Path, seed: u32) -> Noise {
        let name = path.file_name().unwrap_or_default().as_encoded_bytes();
        let begin = seed.wrapping_mul(2_654_435_761);
        let with = |hash: u32, &byte: &u8| (hash ^ u32::from(byte)).wrapping_mul(16_777_619);
        Noise(name.iter().fold(begin, with))
    }

    fn pick<T: Copy>(&mut self, choices: &[T]) -> T {
        self.0 = self.0.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        choices[(self.0 >> 16) as usize % choices.len()]
    }

    fn options(&mut self, options: Options) -> Options {
        let (least, most) = self.pick(&[(0.0, 180.0), (20.0, 180.0), (0.0, 95.0)]);
        options
            .with_angles(least, most)
            .with_convexity(self.pick(&[Convexity::Both, Convexity::Convex, Convexity::Concave]))
            .with_width_mode(self.pick(&[WidthMode::Offset, WidthMode::Chord, WidthMode::Radius]))
            .with_segments(self.pick(&[options.segments, 2, 3, 8]))
            .with_profile(self.pick(&[options.profile, 0.0, 0.3, 0.8, 1.0]))
            .with_evenness(self.pick(&[options.evenness, 0.0, 1.0]))
            .with_least_breadth(self.pick(&[options.least_breadth, 0.0, 0.6]))
            .with_chamfer_submesh(self.pick(&[ChamferSubmesh::Owner, ChamferSubmesh::Own]))
            .with_scale(self.pick(&SCALES))
            .with_hard_angle(self.pick(&[options.hard_angle, 0.1, 5.0, 20.0, 60.0]))
    }

    fn unlike(mut self, mesh: &Mesh) -> Unlike {
        let factors = [0.0, 0.2, 1.0, 1.0, 1.0, 3.0];
        let mut many = |count: usize| (0..count).map(|_| self.pick(&factors)).collect();
        Unlike {
            vertices: many(mesh.positions.len()),
            submeshes: many(mesh.submesh_index_counts.len()),
        }
    }
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
        let unlike = found.edges.iter().zip(&told).find(|(found, told)| found != told);
        if let Some((found, told)) = unlike {
            println!("the first: {found:?}\nas told: {told:?}");
        }
        println!("{found}");
    }
}
