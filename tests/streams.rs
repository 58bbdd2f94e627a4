//! Every stream of chamfered meshes, judged from what went in and what came out.
//!
//! `cargo test --release --test streams -- --nocapture` prints what was counted for each rule.

#[path = "streams/charts.rs"]
mod charts;
#[path = "streams/footprint.rs"]
mod footprint;
#[path = "streams/rebuild.rs"]
mod rebuild;
#[path = "streams/surviving.rs"]
mod surviving;
#[path = "streams/tally.rs"]
mod tally;

use std::path::Path;

use chamfer::{
    Chamfered, Mesh, MeshBuffers, Options, TriangleKind, UvBuffer, Verify, Width, chamfer, shapes,
};
use chamfer_formats as formats;
use chamfer_formats::ReadOptions;
use tally::Tally;

const FOLDER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../shared/corpus");

fn check(name: &str, before: &Mesh, after: &Chamfered, tally: &mut Tally) {
    footprint::check(name, before, after, tally);
    rebuild::check(name, before, after, tally);
    surviving::check(name, before, after, tally);
}

fn check_affine(name: &str, before: &Mesh, percent: f32, tally: &mut Tally) {
    let mesh = surviving::affine(before);
    let size = mesh.positions.as_flattened().iter().fold(1e-30_f32, |m, x| m.max(x.abs()));
    surviving::check_affine(name, &chamfered(&mesh.as_mesh(), percent), size, tally);
}

fn chamfered(mesh: &Mesh, percent: f32) -> Chamfered {
    let width = Width::PercentOfExtent(percent);
    chamfer(mesh, &Options::default().with_width(width).with_verify(Verify::Fast)).unwrap()
}

fn built() -> Vec<(&'static str, MeshBuffers)> {
    let mut models = shapes::demo_models();
    models.push(("aligned_strip", shapes::aligned_strip()));
    models.push(("two_channels", two_channels()));
    models
}

/// A cube whose second channel goes on around its sides, up to one seam, where the first has a seam
/// on each edge.
fn two_channels() -> MeshBuffers {
    let mut cube = shapes::cube(1.0);
    let wrapped = |([x, y, z], normal): (&[f32; 3], &[f32; 3])| match normal {
        [0.0, 0.0, 1.0] => [x + 0.5, *y],
        [1.0, 0.0, 0.0] => [1.5 - z, *y],
        [0.0, 0.0, -1.0] => [2.5 - x, *y],
        [-1.0, 0.0, 0.0] => [3.5 + z, *y],
        [0.0, 1.0, 0.0] => [x + 0.5, 2.0 - z],
        _ => [x + 0.5, 4.0 + z],
    };
    let values = cube.positions.iter().zip(&cube.normals).flat_map(wrapped).collect();
    cube.uvs[1] = UvBuffer { components: 2, values };
    cube
}

fn of_shapes(percent: f32) -> Tally {
    let mut tally = Tally::default();
    for (name, mesh) in built() {
        let mesh = mesh.as_mesh();
        check(name, &mesh, &chamfered(&mesh, percent), &mut tally);
        check_affine(name, &mesh, percent, &mut tally);
    }
    tally
}

fn of_corpus(percent: f32) -> Option<Tally> {
    let mut paths: Vec<_> =
        std::fs::read_dir(Path::new(FOLDER)).ok()?.flatten().map(|entry| entry.path()).collect();
    paths.sort();
    let mut tally = Tally::default();
    for path in paths {
        let Ok(document) = formats::read(&path, &ReadOptions::default()) else {
            continue;
        };
        for source in document.meshes() {
            let file = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
            let mesh = source.mesh.as_mesh();
            let name = format!("{file}/{}", source.name);
            check(&name, &mesh, &chamfered(&mesh, percent), &mut tally);
            check_affine(&name, &mesh, percent, &mut tally);
        }
    }
    Some(tally)
}

/// What nothing may break.
const KEPT: [&str; 11] = [
    "1 footprint",
    "1 mirrored",
    "2 uv",
    "2 colour",
    "2 normal",
    "3 swims",
    "4 tangent",
    "4 handedness",
    "4 tangent rebuilt",
    "5 colour range",
    "6 duplicates",
];

/// What real models may break, at most, as a share of what was looked at: chamfers that are larger
/// than any face of their chart around them, and vertices that go hundreds of times as far as the
/// triangles around them are high, where weights in single precision tell the place no better.
const BOUNDS: [(&str, f64); 7] = [
    ("1 area", 2e-5),
    ("1 thin strip", 5e-4),
    ("1 dense strip", 4e-5),
    ("1 thin fill", 0.002),
    ("1 dense fill", 0.0012),
    ("2 position", 3e-6),
    ("3 affine", 4e-6),
];

fn assert_kept(tally: &Tally) {
    for rule in KEPT {
        assert_eq!(tally.broken(rule), 0, "{rule}:\n{tally}");
    }
}

#[test]
fn built_shapes_keep_every_rule() {
    for percent in [0.2, 0.5, 2.0] {
        let tally = of_shapes(percent);
        println!("shapes at {percent} %:\n{tally}");
        assert_kept(&tally);
        for (rule, _) in BOUNDS {
            assert_eq!(tally.broken(rule), 0, "{rule}:\n{tally}");
        }
    }
}

#[test]
fn real_models_keep_their_streams() {
    for percent in [0.2, 0.5, 2.0] {
        let Some(tally) = of_corpus(percent) else { continue };
        println!("models at {percent} %:\n{tally}");
        assert_kept(&tally);
        for (rule, most) in BOUNDS {
            assert!(tally.share(rule) <= most, "{rule} beyond {most}:\n{tally}");
        }
    }
}

/// Where only the first channel has a seam, copies take nothing else from the owner.
#[test]
fn each_channel_has_the_seams_that_it_had() {
    let cube = two_channels();
    let result = chamfered(&cube.as_mesh(), 5.0);
    let [mut first_alone, mut both] = [0, 0];
    for (triangle, source) in result.triangle_sources.iter().enumerate() {
        if source.kind != TriangleKind::Edge {
            continue;
        }
        let ends = result.verdicts[source.index as usize].vertices;
        let [from, to] = ends.map(|vertex| cube.positions[vertex as usize]);
        if from[1] == to[1] {
            continue;
        }
        let copies = result.mesh.indices[3 * triangle..3 * triangle + 3].iter();
        for &copy in copies.filter(|&&vertex| vertex as usize >= cube.positions.len()) {
            let channels = result.vertex_sources.get(copy as usize).owner_channels;
            first_alone += usize::from(channels == 1);
            both += usize::from(channels == 3);
        }
    }
    assert!(both > 0);
    assert_eq!(first_alone, 3 * both, "of four upright edges, one has a seam in both channels");
}
