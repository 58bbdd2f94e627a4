//! What comes out: what stays as it was, and where new triangles go.

use chamfer::check::{Facts, check};
use chamfer::{
    ChamferSubmesh, Error, MeshBuffers, Options, TriangleKind, Verify, Width, chamfer, shapes,
};

use crate::{chamfered, chamfered_as, triangles};

#[test]
fn width_zero_gives_the_input_bit_for_bit() {
    for (name, mesh) in shapes::demo_models() {
        let result = chamfered(&mesh, 0.0);
        assert_eq!(result.mesh, mesh, "{name}");
        assert_eq!(bits(&result.mesh), bits(&mesh), "{name}: not even a zero changes its sign");
    }
}

fn bits(mesh: &MeshBuffers) -> Vec<[u32; 3]> {
    mesh.positions.iter().chain(&mesh.normals).map(|v| v.map(f32::to_bits)).collect()
}

#[test]
fn a_mesh_without_hard_edges_is_given_back() {
    let sphere = shapes::sphere(8, 12);
    let result = chamfered(&sphere, 0.1);
    assert_eq!(result.mesh, sphere);
    assert_eq!(result.totals.hard_edges, 0);
}

#[test]
fn vertices_keep_their_indices_and_triangles_their_order() {
    let bolt = shapes::bolt();
    let result = chamfered(&bolt, 0.02);
    let sources = triangles(&result, TriangleKind::Source).concat();
    assert_eq!(sources.len(), bolt.indices.len());
    for (corner, vertex) in sources.into_iter().enumerate() {
        let source = bolt.indices[corner] as usize;
        let owner = result.vertex_sources.get(vertex).chart.vertices[0] as usize;
        // Vertices of one sector that came out equal are one.
        assert_eq!(bolt.positions[owner], bolt.positions[source], "corner {corner}");
        assert!(vertex == owner || vertex >= bolt.positions.len(), "corner {corner}");
    }
}

#[test]
fn chamfers_go_to_the_submesh_of_their_owner() {
    let bolt = shapes::bolt();
    let result = chamfered(&bolt, 0.02);
    let [head, shank] = [0, 1].map(|k| result.mesh.submesh_index_counts[k]);
    assert!(head > bolt.submesh_index_counts[0] && shank > bolt.submesh_index_counts[1]);
    assert_eq!((head + shank) as usize, result.mesh.indices.len());
}

#[test]
fn chamfers_go_to_a_submesh_of_their_own() {
    let bolt = shapes::bolt();
    let counts = submesh_counts(&bolt, ChamferSubmesh::Own);
    assert_eq!(counts[..2], bolt.submesh_index_counts);
    assert_eq!(counts.len(), 3);
    assert!(counts[2] > 0);
}

#[test]
fn chamfers_go_to_the_given_submesh() {
    let bolt = shapes::bolt();
    let counts = submesh_counts(&bolt, ChamferSubmesh::Given(1));
    assert_eq!(counts[0], bolt.submesh_index_counts[0]);
    assert!(counts[1] > bolt.submesh_index_counts[1]);
}

fn submesh_counts(mesh: &MeshBuffers, chamfer_submesh: ChamferSubmesh) -> Vec<u32> {
    let options =
        Options::default().with_width(Width::Units(0.02)).with_chamfer_submesh(chamfer_submesh);
    chamfered_as(mesh, &options).mesh.submesh_index_counts
}

#[test]
fn a_submesh_that_is_not_there_is_an_error() {
    let options = Options::default().with_chamfer_submesh(ChamferSubmesh::Given(2));
    let error = chamfer(&shapes::bolt().as_mesh(), &options).unwrap_err();
    assert_eq!(error, Error::SubmeshRange { submesh: 2, submeshes: 2 });
}

/// The rim of an open box is a border of four edges; at its corners the strips of the upright
/// edges end, and add one each.
#[test]
fn the_border_of_an_open_box_gains_only_strip_ends() {
    let open = shapes::open_box();
    let result = chamfered(&open, 0.1);
    let findings = check(&open.as_mesh(), &result, Verify::Fast);
    let border = |facts: &Facts| (facts.border_half_edges, facts.border_loops);
    assert_eq!((border(&findings.before), border(&findings.after)), ((4, 1), (8, 1)));
}

#[test]
fn the_border_of_an_open_box_stays_at_its_height() {
    let open = shapes::open_box();
    let result = chamfered(&open, 0.1);
    for (old, new) in open.positions.iter().zip(&result.mesh.positions) {
        assert_eq!(old[1] == 1.0, new[1] == 1.0, "{old:?} went to {new:?}");
    }
}

/// All of it, at once: a hundred times the thickness of the plate is asked for.
#[test]
fn a_feature_narrower_than_the_chamfer_is_narrowed_not_broken() {
    let plate = shapes::plate();
    let result = chamfered(&plate, 0.5);
    assert_eq!(result.totals.hard_edges, 12);
    assert_eq!(result.totals.chamfered, 0);
    assert!(result.totals.narrowed > 0);
}
