//! Where another angle makes an edge hard: what differs by less is no edge, and the checker goes by the
//! same angle.

#[path = "support/quads.rs"]
mod quads;

use chamfer::check::{Extras, Findings, Rule, assert_sound, check, compare_with};
use chamfer::{Chamfered, MeshBuffers, Options, TriangleKind, Verify, Width, chamfer, shapes};

use quads::quads;

/// Of a prism with eight sides, which turn by 45 degrees, only the edges of its lids.
const LIDS_ALONE: f32 = 60.0;

fn prism() -> (MeshBuffers, Chamfered) {
    let prism = shapes::prism(8);
    let options =
        Options::default().with_width(Width::PercentOfExtent(3.0)).with_hard_angle(LIDS_ALONE);
    let result = chamfer(&prism.as_mesh(), &options).unwrap();
    (prism, result)
}

fn found(findings: &Findings, rule: Rule) -> bool {
    findings.breaches.iter().any(|breach| breach.rule == rule)
}

/// As the command checks two files: by what went in and what came out.
fn compared(before: &MeshBuffers, after: &MeshBuffers, hard_angle: Option<f32>) -> Findings {
    let extras = Extras::default().with_hard_angle(hard_angle);
    compare_with(&before.as_mesh(), &after.as_mesh(), &extras, Verify::Fast)
}

/// A tube whose sides turn by 60 degrees: where edges are hard from a little less on, they are chamfered,
/// and no checker can tell whether they had to be.
#[test]
fn edges_at_the_very_angle_may_be_chamfered() {
    let at = |k: u32, z: f32| {
        let (sin, cos) = (f64::from(k % 6) * std::f64::consts::FRAC_PI_3).sin_cos();
        [cos as f32, sin as f32, z]
    };
    let places = (0..6).flat_map(|k| [0.0, 1.0].map(|z| (k, z)));
    let quad = |(k, z)| [at(k, z), at(k + 1, z), at(k + 1, z + 1.0), at(k, z + 1.0)];
    let tube = quads(places.map(quad));
    let options =
        Options::default().with_width(Width::Units(0.1)).with_hard_angle(59.9).with_segments(2);
    let result = chamfer(&tube.as_mesh(), &options).unwrap();
    assert_eq!(result.totals.chamfered, 12);
    assert_sound("a tube", &tube.as_mesh(), &result);
}

/// A roof that is shaded as a round one, but for a tenth of a degree along its ridge.
#[test]
fn where_little_makes_an_edge_hard_little_moves_faces() {
    let ridge = [[0.0, 1.0, 0.0], [0.0, 1.0, 2.0]];
    let (mut positions, mut normals) = (vec![], vec![]);
    for side in [-1.0_f32, 1.0] {
        let [a, b] = if side > 0.0 { [ridge[1], ridge[0]] } else { ridge };
        positions.extend([a, b, [side, 0.0, b[2]], [side, 0.0, a[2]]]);
        let at_ridge = [side * 0.001_05, 1.0, 0.0];
        normals.extend([at_ridge, at_ridge, [side, 0.0, 0.0], [side, 0.0, 0.0]]);
    }
    let indices = vec![0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7];
    let roof = MeshBuffers {
        positions,
        normals,
        submesh_index_counts: vec![indices.len() as u32],
        indices,
        ..MeshBuffers::default()
    };
    let options = Options::default().with_width(Width::Units(1.0)).with_hard_angle(0.1);
    let result = chamfer(&roof.as_mesh(), &options).unwrap();
    assert!(result.verdicts[0].widths[0] > 0.6, "{:?}", result.verdicts);
    assert_sound("a roof", &roof.as_mesh(), &result);
}

#[test]
fn what_differs_by_less_is_no_edge_and_sound_where_the_angle_is_told() {
    let (prism, result) = prism();
    assert_eq!(result.totals.hard_edges, 16);
    assert_eq!(result.hard_angle, Some(LIDS_ALONE));
    let findings = check(&prism.as_mesh(), &result, Verify::Full);
    assert!(findings.is_sound(), "{findings}");
    let findings = compared(&prism, &result.mesh, Some(LIDS_ALONE));
    assert!(findings.is_sound(), "{findings}");
}

/// The sides are flat and shaded so, though their edges are not hard: where these are shortened at the
/// lids, each side has its own normal on its end still.
#[test]
fn faces_between_edges_that_are_not_hard_keep_their_normals() {
    let (prism, result) = prism();
    let mut count = 0;
    for (triangle, source) in result.triangle_sources.iter().enumerate() {
        if source.kind == TriangleKind::Source {
            let normals = |mesh: &MeshBuffers, triangle: usize| {
                let corners = &mesh.indices[3 * triangle..3 * triangle + 3];
                corners.iter().map(|&corner| mesh.normals[corner as usize]).collect::<Vec<_>>()
            };
            assert_eq!(normals(&result.mesh, triangle), normals(&prism, source.index as usize));
            count += 1;
        }
    }
    assert_eq!(count, prism.indices.len() / 3);
}

/// By the usual angle the sides' edges have no verdict.
#[test]
fn where_the_angle_is_not_told_edges_are_missing() {
    let (prism, mut result) = prism();
    result.hard_angle = None;
    assert!(!check(&prism.as_mesh(), &result, Verify::Fast).is_sound());
}

/// A triangle of a strip with vertices of its own, shaded like the far side of the prism: by more than
/// any angle that is told.
#[test]
fn an_edge_that_is_new_is_found_by_a_larger_angle_too() {
    let (prism, result) = prism();
    let mut after = result.mesh;
    let first = after.indices.len() - 3;
    for corner in first..first + 3 {
        let vertex = after.indices[corner] as usize;
        after.indices[corner] = after.positions.len() as u32;
        after.positions.push(after.positions[vertex]);
        after.normals.push(after.normals[vertex].map(|along| -along));
        let tangent = after.tangents.get(vertex).copied();
        after.tangents.extend(tangent);
        for uv in after.uvs.iter_mut().filter(|uv| uv.components > 0) {
            let own = vertex * uv.components as usize;
            uv.values.extend_from_within(own..own + uv.components as usize);
        }
    }
    let findings = compared(&prism, &after, Some(LIDS_ALONE));
    assert!(found(&findings, Rule::HardEdges), "{findings}");
}

/// Normals that differ by half a degree are an edge to those who ask for a tenth.
#[test]
fn a_smaller_angle_finds_more_edges() {
    let mut cube = shapes::plain_cube(1.0);
    // Two triangles of a face, each with vertices of its own, one of them turned.
    let [a, b, c] = [0, 1, 2].map(|corner| cube.indices[corner] as usize);
    let first = cube.positions.len() as u32;
    for vertex in [a, b, c] {
        let normal = cube.normals[vertex];
        cube.positions.push(cube.positions[vertex]);
        let axis = normal.iter().position(|along| along.abs() > 0.5).unwrap();
        let mut turned = normal;
        turned[(axis + 1) % 3] = 0.5_f32.to_radians();
        cube.normals.push(turned);
    }
    for corner in 0..3 {
        cube.indices[corner] = first + corner as u32;
    }
    let facts = |angle| compared(&cube, &cube, angle).before.hard_edges;
    assert_eq!(facts(None), 12);
    assert_eq!(facts(Some(0.1)), 13);
}
