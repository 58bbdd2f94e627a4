//! The cases of the thesis (D. Algma, "Edge Chamfering Algorithm", Tartu 2018, chapter 6), each
//! as a small model. All of them also go through the whole-mesh checker.

mod corners;
#[path = "../support/prism.rs"]
mod prism;
mod pulling;
mod result;
mod seams;
#[path = "../support/shaded.rs"]
mod shaded;
mod textures;
mod touching;

use chamfer::check::assert_sound;
use chamfer::{Chamfered, MeshBuffers, Options, TriangleKind, Width, chamfer};
use glam::DVec3;

/// Chamfers by a width in mesh units, and checks the result in full depth.
fn chamfered(mesh: &MeshBuffers, width: f32) -> Chamfered {
    chamfered_as(mesh, &Options::default().with_width(Width::Units(width)))
}

fn chamfered_as(mesh: &MeshBuffers, options: &Options) -> Chamfered {
    let result = chamfer(&mesh.as_mesh(), options).unwrap();
    assert_sound("the chamfered model", &mesh.as_mesh(), &result);
    result
}

/// How many triangles of a kind there are.
fn count(result: &Chamfered, kind: TriangleKind) -> usize {
    result.triangle_sources.iter().filter(|source| source.kind == kind).count()
}

/// The triangles of a kind, each as three vertices.
fn triangles(result: &Chamfered, kind: TriangleKind) -> Vec<[usize; 3]> {
    let corners = result.mesh.indices.chunks_exact(3).map(|t| [0, 1, 2].map(|k| t[k] as usize));
    let of_kind = corners.zip(&result.triangle_sources).filter(|(_, source)| source.kind == kind);
    of_kind.map(|(triangle, _)| triangle).collect()
}

/// Where the vertices went that stood at a point and had a normal. Each place once, sorted.
fn pulled(
    mesh: &MeshBuffers,
    result: &Chamfered,
    from: [f32; 3],
    normal: [f32; 3],
) -> Vec<[f32; 3]> {
    let is_meant = |v: usize| mesh.positions[v] == from && mesh.normals[v] == normal;
    let sources = triangles(result, TriangleKind::Source).concat();
    let mut places: Vec<[f32; 3]> = (0..)
        .zip(sources)
        .filter(|&(corner, _): &(usize, usize)| is_meant(mesh.indices[corner] as usize))
        .map(|(_, vertex)| result.mesh.positions[vertex])
        .collect();
    places.sort_by(|a, b| a.partial_cmp(b).unwrap());
    places.dedup();
    places
}

fn vector(values: [f32; 3]) -> DVec3 {
    DVec3::from(values.map(f64::from))
}

/// Equal to within 1e-5 of the extent.
#[track_caller]
fn assert_at(mesh: &MeshBuffers, found: [f32; 3], expected: [f32; 3]) {
    let distance = vector(found).distance(vector(expected));
    let tolerance = 1e-5 * f64::from(mesh.as_mesh().extent());
    assert!(distance <= tolerance, "{found:?} is not at {expected:?}");
}
