//! Is a chamfered mesh sound? One checker for whole meshes, independent of the pipeline: it sees
//! only what went in and what came out, and prefers the obvious way to the fast one.
//!
//! Each [`Rule`] is something that the chamfered mesh must keep. What was already wrong in the
//! input is not held against the output.

mod flatness;
mod intersections;
mod origins;
mod rules;
mod surface;
mod triangles;
mod values;

use crate::mesh::Mesh;
use crate::options::Verify;
use crate::report::Chamfered;

use origins::Origins;
use surface::Surface;

pub use rules::{Breach, Element, Facts, Findings, Rule};

/// Checks a chamfered mesh against its source, with its provenance.
///
/// [`Verify::Full`] also looks for self-intersections, which takes most of the time.
pub fn check(before: &Mesh, after: &Chamfered, depth: Verify) -> Findings {
    let mut findings = Findings::default();
    let mesh = after.mesh.as_mesh();
    if well_formed(before, &mesh, &mut findings) {
        match Origins::told(before, after, &mut findings) {
            Some(origins) => compare_with(before, &mesh, &origins, depth, &mut findings),
            None => state_facts(before, &mesh, &mut findings),
        }
    }
    findings
}

/// Checks a mesh against its source where only the two are known, as from files: the first
/// triangles of each submesh are taken to be those of the source, in their order.
pub fn compare(before: &Mesh, after: &Mesh, depth: Verify) -> Findings {
    let mut findings = Findings::default();
    if well_formed(before, after, &mut findings) {
        match Origins::inferred(before, after, &mut findings) {
            Some(origins) => compare_with(before, after, &origins, depth, &mut findings),
            None => state_facts(before, after, &mut findings),
        }
    }
    findings
}

/// Passes if [`check`] in full depth finds nothing.
///
/// # Panics
/// With the name and the findings, if it does.
pub fn assert_sound(name: &str, before: &Mesh, after: &Chamfered) {
    let findings = check(before, after, Verify::Full);
    assert!(findings.is_sound(), "{name} is not sound:\n{findings}");
}

/// Whether both meshes can be walked at all: nothing else is checked otherwise.
fn well_formed(before: &Mesh, after: &Mesh, findings: &mut Findings) -> bool {
    if !values::is_well_formed(before) {
        findings.note(Rule::Source, Element::Mesh);
        return false;
    }
    values::check_form(before, after, findings);
    values::check_finite(after, findings);
    findings.is_sound()
}

fn state_facts(before: &Mesh, after: &Mesh, findings: &mut Findings) {
    findings.before = Surface::new(before).facts();
    findings.after = Surface::new(after).facts();
}

fn compare_with(
    before: &Mesh,
    after: &Mesh,
    origins: &Origins,
    depth: Verify,
    findings: &mut Findings,
) {
    let [source, result] = [before, after].map(Surface::new);
    findings.before = source.facts();
    findings.after = result.facts();
    values::check_normals(before, after, origins, findings);
    values::check_tangents(before, after, origins, findings);
    values::check_colors(before, after, findings);
    surface::check_edges(&source, &result, findings);
    triangles::check_triangles(&source, &result, origins, findings);
    flatness::check_flatness(&source, &result, origins, findings);
    if depth == Verify::Full {
        intersections::check_intersections(&source, &result, origins, findings);
    }
}
