//! The same input gives the same bytes: on every platform, in every build, with any number of
//! threads.

#[path = "support/fingerprint.rs"]
mod fingerprint;

use chamfer::{MeshBuffers, Options, Verify, Width, chamfer, shapes};
use fingerprint::fingerprint;

/// What the demonstration models come out as at 2 % of their extent, on any machine. A change of
/// the output has its line in CHANGELOG.md, and then `CHAMFER_UPDATE_HASHES=1` writes this anew.
const KNOWN: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/support/demo_hashes.txt");

fn options(threads: u32) -> Options {
    let width = Width::PercentOfExtent(2.0);
    Options::default().with_width(width).with_threads(threads).with_verify(Verify::Full)
}

fn hash(mesh: &MeshBuffers, options: &Options) -> u64 {
    fingerprint(&chamfer(&mesh.as_mesh(), options).unwrap())
}

#[test]
fn the_demonstration_models_come_out_as_on_every_machine() {
    let line = |(name, mesh)| format!("{name} {:016x}\n", hash(&mesh, &options(1)));
    let found: String = shapes::demo_models().into_iter().map(line).collect();
    if std::env::var_os("CHAMFER_UPDATE_HASHES").is_some() {
        std::fs::write(KNOWN, &found).unwrap();
    }
    let known = std::fs::read_to_string(KNOWN).unwrap().replace('\r', "");
    assert_eq!(found, known, "CHAMFER_UPDATE_HASHES=1 accepts what was found");
}

/// Large enough that threads share the work of `full`, and too small for blocks.
fn field() -> MeshBuffers {
    shapes::cube_field(1000)
}

#[test]
fn the_number_of_threads_changes_nothing() {
    let alone = hash(&field(), &options(1));
    for threads in [0, 2, 3, 8] {
        assert_eq!(hash(&field(), &options(threads)), alone, "{threads} threads");
    }
}

/// A smooth mesh goes a shorter way, which must lead to the same place.
#[test]
fn a_smooth_mesh_comes_back_bit_for_bit() {
    let sphere = shapes::sphere(6, 8);
    let result = chamfer(&sphere.as_mesh(), &options(1)).unwrap();
    assert_eq!(result.mesh, sphere);
    assert_eq!(result.vertex_sources.len(), sphere.positions.len());
    assert_eq!(result.triangle_sources.len(), sphere.indices.len() / 3);
    assert!(result.verdicts.is_empty());
}
