//! The real models beside the project, through the whole-mesh checker.

#[path = "corpus/measure.rs"]
mod measure;
#[path = "support/own_models.rs"]
mod own_models;

use std::path::{Path, PathBuf};

use chamfer::check::compare;
use chamfer::{EdgeFactor, Factors, Mesh, Options, Verify, Width, chamfer};
use chamfer_formats::{ReadOptions, read};
use measure::{FOLDER, Measured, Sum, Unlike, measure, measure_with, models};

/// Models, as the folder's own list has it.
const MODELS: usize = 120;

/// The real models, or our own where they are missing; each test has a folder for these.
fn paths(test: &str) -> Vec<PathBuf> {
    let real = Path::new(FOLDER);
    if own_models::are_needed(real) {
        let folder = format!("{}/own_models_{test}", env!("CARGO_TARGET_TMPDIR"));
        return own_models::stand_in(Path::new(&folder), FOLDER);
    }
    let paths = models(real);
    assert_eq!(paths.len(), MODELS, "models in {FOLDER}");
    paths
}

/// Chamfers all models by a width in percent of the extent.
fn measured(percent: f32) -> Vec<Measured> {
    let meshes = |path: &PathBuf| {
        measure(path, percent, Verify::Full, |_, _| ())
            .unwrap_or_else(|error| panic!("{}: {error}", path.display()))
    };
    paths(&percent.to_string()).iter().flat_map(meshes).collect()
}

/// Passes if every model is sound.
fn assert_all_sound(meshes: &[Measured], percent: f32) {
    let unsound: Vec<String> = meshes
        .iter()
        .filter(|mesh| !mesh.findings.is_sound())
        .map(|mesh| format!("{}:\n{}", mesh.name, mesh.findings))
        .collect();
    assert!(
        unsound.is_empty(),
        "{} of {} meshes are not sound at {percent} %:\n{}",
        unsound.len(),
        meshes.len(),
        unsound.join("\n")
    );
}

#[test]
fn at_a_fifth_of_a_percent_all_are_sound_and_nearly_all_edges_chamfered() {
    let meshes = measured(0.2);
    assert_all_sound(&meshes, 0.2);
    let mut sum = Sum::default();
    sum.extend(&meshes);
    assert!(sum.chamfered_share() >= 0.995, "{sum}");
}

#[test]
fn at_half_a_percent_all_are_sound() {
    let meshes = measured(0.5);
    assert_all_sound(&meshes, 0.5);
}

#[test]
fn at_two_percent_all_are_sound() {
    let meshes = measured(2.0);
    assert_all_sound(&meshes, 2.0);
}

/// What `chamfer check` sees of two files, where nothing tells what came from what.
#[test]
fn all_are_sound_by_what_went_in_and_what_came_out_alone() {
    for path in paths("alone") {
        for (percent, segments, verify) in
            [(0.5, 1, Verify::Full), (2.0, 1, Verify::Full), (2.0, 2, Verify::Fast)]
        {
            let options = Options::default()
                .with_width(Width::PercentOfExtent(percent))
                .with_segments(segments)
                .with_verify(verify);
            let plain = |_: &Mesh| Unlike::default();
            let measured = measure_with(&path, &options, plain, |before, after| {
                let found = compare(before, &after.mesh.as_mesh(), verify);
                let asked = format!("{} at {percent} %, {segments}", path.display());
                assert!(found.is_sound(), "{asked}:\n{found}");
            });
            assert!(measured.is_ok(), "{}", path.display());
        }
    }
}

/// A factor for each vertex, for each submesh, and for each hard edge.
#[test]
fn what_selects_all_is_no_selection_and_what_selects_nothing_changes_nothing() {
    let options = Options::default();
    for path in paths("selected") {
        for source in read(&path, &ReadOptions::default()).unwrap().meshes() {
            let mesh = source.mesh.as_mesh();
            let plain = chamfer(&mesh, &options).unwrap();
            for factor in [1.0, 0.0] {
                let vertices = vec![factor; mesh.positions.len()];
                let submeshes = vec![factor; mesh.submesh_index_counts.len()];
                let listed = plain.verdicts.iter().map(|edge| edge.vertices);
                let edges: Vec<EdgeFactor> =
                    listed.map(|vertices| EdgeFactor { vertices, factor }).collect();
                let none = Factors::default();
                let selections = [
                    Factors { vertices: &vertices, ..none },
                    Factors { submeshes: &submeshes, ..none },
                    Factors { edges: &edges, ..none },
                ];
                let expected = if factor == 1.0 { &plain.mesh } else { &source.mesh };
                for (which, factors) in selections.into_iter().enumerate() {
                    let result = chamfer(&Mesh { factors, ..mesh }, &options).unwrap();
                    let name = format!("{} {}", path.display(), source.name);
                    assert!(result.mesh == *expected, "{name}: factors {which} of {factor}");
                }
            }
        }
    }
}
