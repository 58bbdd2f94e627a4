//! What holds for every call, whatever its arguments.

#[path = "../../tests/support/crowded.rs"]
mod crowded;

use chamfer::check::{Findings, Rule, check};
use chamfer::{Chamfered, MeshBuffers, Options, Width, chamfer};
pub use crowded::has_crowded_edges;

/// Chamfers a mesh and checks all that the library promises of the result; an error is a right
/// answer to a mesh that breaks a rule.
///
/// # Panics
/// Where a promise is broken.
pub fn chamfer_and_check(mesh: &MeshBuffers, options: &Options) -> Option<Chamfered> {
    let result = match chamfer(&mesh.as_mesh(), options) {
        Ok(result) => result,
        Err(error) => {
            assert!(!error.to_string().is_empty());
            return None;
        }
    };
    let findings = check(&mesh.as_mesh(), &result, options.verify);
    // As literals, to make a test of it.
    assert!(is_sound(mesh, &findings), "{findings}\n{mesh:?}");
    check_same_bytes(&result, &chamfer(&mesh.as_mesh(), options).expect("it went well before"));
    check_width_zero(mesh, options);
    Some(result)
}

/// An edge of many sides may come apart into two of fewer, which counts as one edge more with too
/// many sides. And where triangles fold onto each other, nobody can tell by the place alone which
/// value belongs there: that is judged on meshes that make sense, in the tests.
fn is_sound(mesh: &MeshBuffers, findings: &Findings) -> bool {
    let may_be = |rule: Rule| match rule {
        Rule::NonManifold => has_crowded_edges(mesh),
        Rule::Place | Rule::Covered | Rule::Shading => true,
        Rule::TangentTurned | Rule::Texture | Rule::ColorChanged => true,
        _ => false,
    };
    findings.breaches.iter().all(|breach| may_be(breach.rule))
}

fn check_same_bytes(one: &Chamfered, other: &Chamfered) {
    assert_eq!(bits(&one.mesh), bits(&other.mesh));
    // Their numbers print as they are, and none is NaN.
    assert_eq!(one.vertex_sources, other.vertex_sources);
    assert_eq!(one.triangle_sources, other.triangle_sources);
    assert_eq!(one.verdicts, other.verdicts);
}

fn check_width_zero(mesh: &MeshBuffers, options: &Options) {
    let unmoved = options.with_width(Width::Units(0.0));
    let result = chamfer(&mesh.as_mesh(), &unmoved).expect("only the width is another");
    let mut expected = mesh.clone();
    expected.submesh_index_counts = result.mesh.submesh_index_counts.clone();
    let added = &result.mesh.submesh_index_counts[mesh.submesh_index_counts.len()..];
    assert!(added.iter().all(|&count| count == 0));
    assert_eq!(bits(&result.mesh), bits(&expected));
}

/// All of a mesh as whole numbers: -0 is not 0 here.
fn bits(mesh: &MeshBuffers) -> Vec<u32> {
    let mut bits: Vec<u32> = Vec::new();
    let mut add = |values: &[f32]| {
        bits.push(values.len() as u32);
        bits.extend(values.iter().map(|value| value.to_bits()));
    };
    add(mesh.positions.as_flattened());
    add(mesh.normals.as_flattened());
    add(mesh.tangents.as_flattened());
    add(mesh.colors.as_flattened());
    mesh.uvs.iter().for_each(|uv| add(&uv.values));
    bits.extend(mesh.uvs.iter().map(|uv| uv.components));
    bits.extend(&mesh.indices);
    bits.extend(&mesh.submesh_index_counts);
    bits
}
