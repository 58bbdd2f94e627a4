//! The same shape gets the same chamfers, however it is told.

#[path = "corpus/measure.rs"]
#[allow(dead_code)]
mod measure;
#[path = "support/retold.rs"]
mod retold;

use std::path::Path;

use chamfer::{MeshBuffers, Options, Reason, Totals, Verify, Width, chamfer, shapes};
use chamfer_formats::ReadOptions;
use retold::Retold;

fn totals(mesh: &MeshBuffers, percent: f32) -> Totals {
    let width = Width::PercentOfExtent(percent);
    let options = Options::default().with_width(width).with_verify(Verify::Fast);
    chamfer(&mesh.as_mesh(), &options).unwrap().totals
}

fn have_same_counts(one: &Totals, other: &Totals) -> bool {
    [one.chamfered, one.narrowed] == [other.chamfered, other.narrowed]
        && one.skipped == other.skipped
}

/// By how much two mean widths differ, as a share of the larger.
fn off(one: &Totals, other: &Totals) -> f32 {
    let [one, other] = [one, other].map(|totals| totals.mean_width);
    (one - other).abs() / one.max(other).max(f32::MIN_POSITIVE)
}

/// Totals before and after a mesh is told in another way.
fn told_twice(way: Retold, mesh: &MeshBuffers, percent: f32) -> [Totals; 2] {
    [way.base(mesh), way.apply(mesh)].map(|mesh| totals(&mesh, percent))
}

// Where there is no room for all, somebody is asked first: that is not to be whoever has the
// smallest number.
#[test]
fn our_own_models_get_the_same_in_every_way() {
    let mut models = shapes::demo_models();
    models.extend([
        ("l", shapes::l_shape()),
        ("plate", shapes::plate()),
        ("pyramid", shapes::pyramid(7)),
        ("saddle", shapes::saddle()),
        ("wedge end", shapes::wedge_end()),
    ]);
    for (name, mesh) in models {
        for percent in [1.0, 4.0, 16.0] {
            for way in (1..4).flat_map(retold::all) {
                let [one, other] = told_twice(way, &mesh, percent);
                let are_alike = have_same_counts(&one, &other) && off(&one, &other) < 0.02;
                assert!(are_alike, "{name} at {percent} %, {way:?}:\n{one:?}\n{other:?}");
            }
        }
    }
}

fn is_too_fine(totals: &Totals) -> bool {
    totals.skipped[Reason::TooFine] > 0
}

/// Of the real models, so many have the very same totals in each way.
fn least_alike(way: Retold) -> f64 {
    match way {
        // No number that is computed changes.
        Retold::Renumbered(_) | Retold::Turned(_) => 1.0,
        _ => 0.95,
    }
}

/// By so much the mean width of the others is off at most.
const MOST_OFF: f32 = 0.02;

#[test]
fn nearly_all_real_models_get_the_same_in_every_way() {
    let paths = measure::models(Path::new(measure::FOLDER));
    let read = |path: &_| chamfer_formats::read(path, &ReadOptions::default()).unwrap();
    for way in retold::all(1) {
        let (mut meshes, mut alike) = (0, 0);
        for path in &paths {
            let file = path.file_stem().unwrap().to_string_lossy();
            for source in read(path).meshes() {
                let [one, other] = told_twice(way, &source.mesh, 1.0);
                let is_alike = have_same_counts(&one, &other);
                (meshes, alike) = (meshes + 1, alike + usize::from(is_alike));
                let place = format!("{way:?}, {file}/{}", source.name);
                assert!(off(&one, &other) <= MOST_OFF, "{place}");
                // Farther out, a line may be too low to be told from a triangle.
                let is_blurred = way == Retold::Moved && is_too_fine(&other) && !is_too_fine(&one);
                assert!(one.hard_edges == other.hard_edges || is_blurred, "{place}");
            }
        }
        let share = alike as f64 / f64::from(meshes.max(1));
        assert!(share >= least_alike(way) || meshes == 0, "{way:?}: {alike} of {meshes}");
    }
}
