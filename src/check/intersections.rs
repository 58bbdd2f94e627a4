//! Solids that cut through themselves.

use super::junctions::Borders;
use super::origins::Origins;
use super::rules::{Element, Findings, Rule};
use super::solids::Solids;
use super::surface::{HalfEdge, Surface};
use crate::groups::Groups;
use crate::intersect::{Triangle, self_intersections};

/// No solid cuts through itself in what is joined by edges, and did not cut through itself in the
/// source. Where parts that are joined cut each other there, nobody can tell what is whose.
pub(super) fn check_intersections(
    [before, after]: [&Surface; 2],
    [source, result]: [&Solids; 2],
    origins: &Origins,
    findings: &mut Findings,
) {
    let [parts_before, parts_after] = [&source.of, &result.of];
    let joined = joined(before);
    let [own_before, own_after] = [before, after].map(triangles_of);
    let stood = |(number, source): (usize, &Option<[u32; 3]>)| match source {
        Some([corner, ..]) => own_before[*corner as usize / 3],
        None => own_after[number],
    };
    let sources: Vec<Triangle> = origins.triangles.iter().enumerate().map(stood).collect();
    let pairs_before = self_intersections(&own_before, &own_before, &joined);
    let pairs_after = self_intersections(&own_after, &sources, parts_after);
    findings.before.self_intersections = Some(pairs_before.len());
    findings.after.self_intersections = Some(pairs_after.len());
    let mut cut_before = vec![false; parts_before.len()];
    for &(triangle, _) in &pairs_before {
        cut_before[joined[triangle as usize] as usize] = true;
    }
    for (triangle, &part) in joined.iter().enumerate() {
        if cut_before[part as usize] {
            cut_before[parts_before[triangle] as usize] = true;
        }
    }
    for solid in source.lying_on_themselves(before) {
        cut_before[solid as usize] = true;
    }
    // The solids of the source come first, and those that are new past them.
    let mut may_cut = vec![false; parts_before.len() + parts_after.len()];
    for (triangle, source) in origins.triangles.iter().enumerate() {
        let part = |[corner, ..]: [u32; 3]| parts_before[corner as usize / 3] as usize;
        if source.is_some_and(|source| cut_before[part(source)]) {
            may_cut[parts_after[triangle] as usize] = true;
        }
    }
    for (a, b) in pairs_after {
        if !may_cut[parts_after[a as usize] as usize] {
            findings.note(Rule::SelfIntersection, Element::Triangles(a, b));
        }
    }
}

/// `#triangles`: what is joined by edges, or by borders that lie on each other, which chamfers bring
/// together.
fn joined(surface: &Surface) -> Vec<u32> {
    let (borders, mut parts) = (Borders::new(surface), surface.components());
    let mut groups = Groups::singles(parts.len());
    for [one, other] in borders.pairs() {
        let part = |side: &HalfEdge| parts[side.corners[0] as usize / 3];
        groups.join(part(one), part(other));
    }
    let labels = groups.labels();
    parts.iter_mut().for_each(|part| *part = labels[*part as usize]);
    parts
}

fn triangles_of(surface: &Surface) -> Vec<Triangle> {
    let at = |&index: &u32| surface.mesh.positions[index as usize];
    surface.mesh.indices.chunks_exact(3).map(|t| [&t[0], &t[1], &t[2]].map(at)).collect()
}
