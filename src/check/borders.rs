//! Does anything gape that was closed?

use super::junctions::Borders;
use super::loops::Loops;
use super::origins::Origins;
use super::rules::{Element, Findings, Rule};
use super::surface::{HalfEdge, Surface};

/// Balance and border loops, as in the source.
pub(super) fn check_edges(
    before: &Surface,
    after: &Surface,
    origins: &Origins,
    findings: &mut Findings,
) {
    let source = findings.before;
    let element = |(a, b): (&[HalfEdge], &[HalfEdge])| {
        let clusters = a.first().or(b.first()).map_or([0; 2], |half_edge| half_edge.clusters);
        Element::Edge(clusters[0], clusters[1])
    };
    if source.border_half_edges == 0 {
        for edge in after.edges().filter(|(a, b)| a.len() != b.len()) {
            findings.note(Rule::Balance, element(edge));
        }
    }
    if before.has_clear_borders() && !keeps_loops(before, after, origins, findings) {
        findings.note(Rule::BorderLoops, Element::Mesh);
    }
}

/// Whether there are as many loops as before. Where borders lie on each other, a chamfer closes a part
/// of what was open: there `Rule::Gapes` has to do, and of the loops those count that have no part in it.
fn keeps_loops(before: &Surface, after: &Surface, origins: &Origins, findings: &Findings) -> bool {
    let mut meets = vec![false; before.mesh.indices.len()];
    for side in Borders::new(before).pairs().flatten() {
        meets[side.corners[0] as usize] = true;
    }
    if meets.iter().all(|meets| !meets) {
        return findings.before.border_loops == findings.after.border_loops;
    }
    let loops = Loops::new(before);
    let mut may_close = vec![false; before.mesh.indices.len()];
    for (border, &of) in loops.borders.iter().zip(&loops.of) {
        may_close[of as usize] |= meets[border.corners[0] as usize];
    }
    let mut stays = vec![false; before.mesh.indices.len()];
    for (border, &of) in loops.borders.iter().zip(&loops.of) {
        stays[border.corners[0] as usize] = !may_close[of as usize];
    }
    let count = loops.count_with(|border| stays[border.corners[0] as usize]);
    let source =
        |corner: u32| origins.triangles[corner as usize / 3].map(|c| c[corner as usize % 3]);
    let stayed = |border: &HalfEdge| source(border.corners[0]).is_some_and(|c| stays[c as usize]);
    Loops::new(after).count_with(stayed) == count
}

/// Notes the edges that are open though they lie where the source was closed. An edge is open where
/// it is not used equally often in both directions.
pub(super) fn check_borders(
    before: &Surface,
    after: &Surface,
    origins: &Origins,
    findings: &mut Findings,
) {
    let source = Openings::of(before);
    let mut touches_border = origins.touches(before.mesh, after.mesh, &source.vertices);
    if origins.are_told() {
        touches_border = where_any(after.clusters(), &touches_border);
    }
    for (forward, backward) in after.edges().filter(|(a, b)| a.len() != b.len()) {
        let may_be_open = |half_edge: &HalfEdge| {
            let [corner, end] = half_edge.corners;
            match origins.triangles[corner as usize / 3] {
                Some(corners) => source.corners[corners[corner as usize % 3] as usize],
                None => [corner, end].iter().all(|&c| touches_border[after.vertex(c)]),
            }
        };
        // Of an edge that several triangles share, one that was open is enough.
        if !forward.iter().chain(backward).any(may_be_open) {
            let [a, b] = forward.first().or(backward.first()).map_or([0; 2], |h| h.clusters);
            findings.note(Rule::Gapes, Element::Edge(a, b));
        }
    }
}

/// `#vertices`: whether something holds for any at the same place. A copy that continues another texture
/// stands where the vertex does that it is a copy of.
fn where_any(clusters: &[u32], holds: &[bool]) -> Vec<bool> {
    let mut at_place = vec![false; clusters.len()];
    clusters.iter().zip(holds).for_each(|(&at, holds)| at_place[at as usize] |= holds);
    clusters.iter().map(|&at| at_place[at as usize]).collect()
}

/// Where a mesh is open.
struct Openings {
    /// `#corners`: whether the half-edge from there is.
    corners: Vec<bool>,
    /// `#vertices`: whether such a one begins or ends at its position.
    vertices: Vec<bool>,
}

impl Openings {
    fn of(surface: &Surface) -> Openings {
        let mut corners = vec![true; surface.mesh.indices.len()];
        let mut clusters = vec![false; surface.mesh.positions.len()];
        for (forward, backward) in surface.edges() {
            let is_open = forward.len() != backward.len();
            for half_edge in forward.iter().chain(backward) {
                corners[half_edge.corners[0] as usize] =
                    is_open || surface.is_collapsed(half_edge.corners[0]);
                half_edge.clusters.iter().for_each(|&c| clusters[c as usize] |= is_open);
            }
        }
        let vertices = surface.clusters().iter().map(|&c| clusters[c as usize]).collect();
        Openings { corners, vertices }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    // The third vertex is a copy of the first, the fourth one of the second.
    #[test]
    fn a_copy_is_at_a_border_where_its_vertex_is() {
        let places = [0, 1, 0, 1];
        assert_eq!(where_any(&places, &[true, false, false, false]), [true, false, true, false]);
        assert_eq!(where_any(&places, &[false, false, true, false]), [true, false, true, false]);
    }
}
