//! Is a chamfered mesh sound? One checker for whole meshes, independent of the pipeline: it sees
//! only what went in and what came out, and prefers the obvious way to the fast one.
//!
//! Each [`Rule`] is something that the chamfered mesh must keep. What was already wrong in the
//! input is not held against the output.

mod borders;
mod carried;
mod facts;
mod flatness;
mod ground;
mod hardness;
mod intersections;
mod junctions;
mod loops;
mod matching;
mod nearest;
mod noise;
mod origins;
mod pieces;
mod rules;
mod solids;
mod stored;
mod streams;
mod surface;
mod triangles;
mod values;
mod verdicts;
mod widths;

use crate::mesh::Mesh;
use crate::options::Verify;
use crate::report::Chamfered;

use carried::check_carried;
use facts::facts;
use origins::Origins;
use solids::Solids;
use surface::Surface;
use widths::Ruler;

pub use carried::Extras;
pub use rules::{Breach, Element, Facts, Findings, Matching, MeasuredEdge, Rule, Unchecked};
pub use streams::ExtraStream;

/// Checks a chamfered mesh against its source, with its provenance and verdicts.
///
/// [`Verify::Full`] also looks for self-intersections, which takes most of the time.
pub fn check(before: &Mesh, after: &Chamfered, depth: Verify) -> Findings {
    let mut findings = Findings::default();
    let mesh = after.mesh.as_mesh();
    values::check_same_streams(before, &mesh, &mut findings);
    if !well_formed(before, &mesh, &mut findings) {
        return findings;
    }
    let own: Vec<u32> = (0..mesh.submesh_index_counts.len() as u32).collect();
    let extras = Extras::default()
        .with_materials([&own; 2])
        .with_scale(after.scale)
        .with_hard_angle(after.hard_angle);
    let surfaces = [before, &mesh].map(|mesh| looked_at(mesh, &extras));
    state_facts(&surfaces, &mut findings);
    verdicts::check_counts(before, after, &mut findings);
    if let Some(origins) = Origins::told(before, after, &mut findings) {
        check_geometry(&surfaces, &origins, &extras, depth, &mut findings);
        let ruler = Ruler::new(&surfaces, &origins);
        verdicts::check_verdicts(&ruler, after, &mut findings);
    }
    findings
}

/// Checks a mesh against its source where only the two are known, as from files.
///
/// The first triangles of each submesh are taken to be those of the source, in their order, or
/// their first pieces; the other pieces are looked for from there. Other tools may have changed
/// that: if rules are broken, each triangle is also looked for where it was, and what breaks less
/// is what counts ([`Findings::matching`]). The result may have more streams than the source, and
/// its triangles in other submeshes.
pub fn compare(before: &Mesh, after: &Mesh, depth: Verify) -> Findings {
    compare_with(before, after, &Extras::default(), depth)
}

/// As [`compare`], with what else is known of the two.
pub fn compare_with(before: &Mesh, after: &Mesh, extras: &Extras, depth: Verify) -> Findings {
    let mut findings = Findings::default();
    values::check_lost_streams(before, after, &mut findings);
    if !well_formed(before, after, &mut findings) {
        return findings;
    }
    let surfaces = [before, after].map(|mesh| looked_at(mesh, extras));
    state_facts(&surfaces, &mut findings);
    let (origins, mut findings) = likelier_origins(&surfaces, extras, findings);
    if depth != Verify::Fast {
        let [source, result] = &surfaces;
        let before = Solids::new(source);
        let after = before.carried(result, &origins);
        let solids = [&before, &after];
        intersections::check_intersections([source, result], solids, &origins, &mut findings);
    }
    findings
}

/// A mesh where it stands, with the edges that are hard there.
fn looked_at<'a>(mesh: &'a Mesh<'a>, extras: &Extras) -> Surface<'a> {
    Surface::new(mesh).standing(extras.scale).hard_from(extras.hard_angle)
}

/// By order or by geometry, with what is found that way.
fn likelier_origins(
    surfaces: &[Surface; 2],
    extras: &Extras,
    findings: Findings,
) -> (Origins<'static>, Findings) {
    let found_with = |origins: Origins<'static>, matching: Matching| {
        let mut findings = Findings { matching, ..findings.clone() };
        origins.check_lost(&mut findings);
        check_geometry(surfaces, &origins, extras, Verify::Fast, &mut findings);
        (origins, findings)
    };
    let ways = [
        (Origins::in_order as fn(&[Surface; 2]) -> Option<Origins<'static>>, Matching::Order),
        (Origins::in_turned_order, Matching::Order),
        (|surfaces| Some(Origins::by_geometry(surfaces)), Matching::Geometry),
    ];
    let mut best: Option<(Origins<'static>, Findings)> = None;
    for (way, matching) in ways {
        let Some(found) = way(surfaces).map(|origins| found_with(origins, matching)) else {
            continue;
        };
        if best.as_ref().is_none_or(|(_, best)| found.1.defects() < best.defects()) {
            best = Some(found);
        }
        if best.as_ref().is_some_and(|(_, best)| best.defects() == 0) {
            break;
        }
    }
    best.unwrap_or_else(|| found_with(Origins::by_geometry(surfaces), Matching::Geometry))
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
        findings.breaches.clear();
        findings.note(Rule::Source, Element::Mesh);
        return false;
    }
    if !values::is_well_formed(after) {
        values::check_form(after, findings);
        values::check_finite(after, findings);
        return false;
    }
    true
}

fn state_facts([before, after]: &[Surface; 2], findings: &mut Findings) {
    findings.before = facts(before);
    findings.after = facts(after);
}

fn check_geometry(
    surfaces: &[Surface; 2],
    origins: &Origins,
    extras: &Extras,
    depth: Verify,
    findings: &mut Findings,
) {
    let [source, result] = surfaces;
    let (before, after) = (source.mesh, result.mesh);
    values::check_normals(before, after, origins, findings);
    values::check_tangents(before, after, origins, findings);
    values::check_colors(before, after, findings);
    borders::check_edges(source, result, origins, findings);
    borders::check_borders(source, result, origins, findings);
    triangles::check_triangles([source, result], origins, findings);
    flatness::check_flatness(source, result, origins, findings);
    hardness::check_hard_edges(source, result, origins, findings);
    let solids = Solids::new(source);
    let ruler = Ruler::new(surfaces, origins);
    findings.edges = ruler.measure_all(&solids);
    check_carried([source, result], (origins, &ruler), extras, findings);
    let solids = [&solids, &solids.carried(result, origins)];
    findings.after.non_manifold_edges = solids[1].crowded_edges(result);
    solids::check_sides([source, result], solids, origins, findings);
    if depth != Verify::Fast {
        intersections::check_intersections([source, result], solids, origins, findings);
    }
}
