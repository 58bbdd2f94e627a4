//! Verdicts against the mesh that they are about.

use std::cell::OnceCell;

use glam::DVec3;

use super::junctions::{Borders, reach};
use super::rules::{Element, Findings, MeasuredEdge, Rule};
use super::stored::normal_with_area;
use super::surface::{HalfEdge, Surface};
use super::widths::Ruler;
use crate::mesh::Mesh;
use crate::report::{Chamfered, EdgeVerdict, Outcome, Reason, TriangleKind};

/// How far a verdict's width may be off the measured one, as a share of the width asked for:
/// rounding in a few places, far below what could be seen.
const WIDTH_TOLERANCE: f64 = 1e-4;

/// More lines in a row than so many are no edge that meets several.
const MOST_LINES: usize = 64;

/// Each new triangle names a verdict or source vertex that exists, and the totals are those of the
/// verdicts.
pub(super) fn check_counts(before: &Mesh, after: &Chamfered, findings: &mut Findings) {
    for (triangle, source) in (0u32..).zip(&after.triangle_sources) {
        let count = match source.kind {
            TriangleKind::Source => before.indices.len() / 3,
            TriangleKind::Edge => after.verdicts.len(),
            TriangleKind::Corner => before.positions.len(),
        };
        if source.index as usize >= count {
            findings.note(Rule::Verdicts, Element::Triangle(triangle));
        }
    }
    let with = |outcome: Outcome| {
        after.verdicts.iter().filter(|verdict| verdict.outcome == outcome).count() as u32
    };
    let totals = &after.totals;
    let add_up = totals.hard_edges as usize == after.verdicts.len()
        && totals.chamfered == with(Outcome::Full)
        && totals.narrowed == with(Outcome::Narrowed)
        && totals.skipped.total() == with(Outcome::Skipped);
    if !add_up {
        findings.note(Rule::Verdicts, Element::Mesh);
    }
}

/// Verdicts against strips and measured widths.
pub(super) fn check_verdicts(ruler: &Ruler, after: &Chamfered, findings: &mut Findings) {
    let mut strips = vec![0_u32; after.verdicts.len()];
    for source in after.triangle_sources.iter().filter(|s| s.kind == TriangleKind::Edge) {
        if let Some(strips) = strips.get_mut(source.index as usize) {
            *strips += 1;
        }
    }
    let sides = Sides::new(ruler.before);
    let tolerance = ruler.before.rounding() + WIDTH_TOLERANCE * f64::from(after.width);
    for (verdict, strips) in after.verdicts.iter().zip(strips) {
        let element = Element::SourceEdge(verdict.vertices[0], verdict.vertices[1]);
        if (verdict.outcome == Outcome::Skipped) != (strips == 0) {
            findings.note(Rule::Verdicts, element);
        }
        if !sides.agree(verdict, ruler, tolerance) {
            findings.note(Rule::Widths, element);
        }
    }
    if after.width > 0.0 {
        sides.check_complete(&after.verdicts, findings);
    }
}

/// The sides of the source's edges, by their vertices.
struct Sides<'a> {
    surface: &'a Surface<'a>,
    edges: Vec<(&'a [HalfEdge], &'a [HalfEdge])>,
    /// Sorted: the vertices of each half-edge, and its edge.
    edge_of: Vec<([u32; 2], u32)>,
    /// Once they are asked for.
    borders: OnceCell<Borders<'a>>,
    nearly_round: OnceCell<Vec<u32>>,
}

impl<'a> Sides<'a> {
    fn new(surface: &'a Surface<'a>) -> Sides<'a> {
        let edges: Vec<_> = surface.edges().collect();
        let mut edge_of = Vec::with_capacity(surface.mesh.indices.len());
        for (edge, (forward, backward)) in (0u32..).zip(&edges) {
            for half_edge in forward.iter().chain(*backward) {
                edge_of.push((vertices(surface, half_edge), edge));
            }
        }
        edge_of.sort_unstable();
        edge_of.dedup();
        Sides { surface, edges, edge_of, borders: OnceCell::new(), nearly_round: OnceCell::new() }
    }

    /// Whether a verdict's widths are those of its edge. Where more than two triangles meet, those
    /// of any two that may be its sides.
    fn agree(&self, verdict: &EdgeVerdict, ruler: &Ruler, tolerance: f64) -> bool {
        let place = self.edge_of.partition_point(|(vertices, _)| *vertices < verdict.vertices);
        let Some(&(_, edge)) = self.edge_of.get(place).filter(|(v, _)| *v == verdict.vertices)
        else {
            return false;
        };
        let (forward, backward) = self.edges[edge as usize];
        // What is but a line is no second side.
        let is_whole = |side: &&HalfEdge| !self.surface.is_collapsed(side.corners[0]);
        let is_open = |sides: &[HalfEdge]| !sides.iter().any(|side| is_whole(&side));
        if is_open(forward) || is_open(backward) {
            let sides = || forward.iter().chain(backward).filter(is_whole);
            // Nothing to measure between: its sides run the same way, or are of other lengths.
            return verdict.outcome == Outcome::Skipped && verdict.widths == [0.0; 2]
                || sides().any(|side| self.agrees_in_parts(verdict, side, ruler, tolerance));
        }
        let is_alone = forward.len() + backward.len() == 2;
        let pairs = forward.iter().flat_map(|one| backward.iter().map(move |other| [one, other]));
        let both_ways = pairs.flat_map(|[one, other]| [[one, other], [other, one]]);
        both_ways
            .filter(|[one, _]| vertices(self.surface, one) == verdict.vertices)
            .filter_map(|[one, other]| ruler.measure(one, other))
            .any(|measured| agrees(verdict, &measured, is_alone, tolerance))
    }

    /// Whether a verdict's widths are those of an edge of which several others are the second side:
    /// at each end, those of itself and of one that ends there. In the middle of another one, whose
    /// place is not told, what is told is at least what was measured on the first.
    fn agrees_in_parts(
        &self,
        verdict: &EdgeVerdict,
        side: &HalfEdge,
        ruler: &Ruler,
        tolerance: f64,
    ) -> bool {
        let borders = self.borders.get_or_init(|| Borders::new(self.surface));
        let reach = reach(self.surface);
        let tolerance = tolerance + reach;
        let at = |corner: u32| self.surface.position(corner);
        let agrees = |end: usize| {
            let (told, corner) = (f64::from(verdict.widths[end]), side.corners[end]);
            let Some(own) = ruler.pulled(side, corner) else { return false };
            let others = || borders.along(side).map(|other| other.corners.map(at));
            let runs_past = |[from, to]: [DVec3; 2]| {
                let [from, to] = [from, to].map(|end| end - at(corner));
                from.dot(to) < 0.0 && from.length().min(to.length()) > reach
            };
            let ends_here = |o: &&HalfEdge| at(o.corners[1 - end]).distance(at(corner)) <= reach;
            let mut ends = borders.along(side).filter(ends_here).peekable();
            if ends.peek().is_none() || others().any(runs_past) {
                return told == 0.0 || 2.0 * told >= own - tolerance;
            }
            // Where the part there stays, one side of it may go along with what is beside.
            let is_told = |[own, other]: [f64; 2]| {
                let is_left = told == 0.0 && own.min(other) <= tolerance;
                is_left || (told - (own + other) / 2.0).abs() <= tolerance
            };
            // What is a hair off the long one runs at an angle to it where it is short.
            ends.any(|other| {
                let corners = [corner, other.corners[1 - end]];
                let pulls = |line| {
                    let [own, other] = corners.map(|corner| ruler.pulled(line, corner));
                    Some([own?, other?])
                };
                [side, other].into_iter().filter_map(pulls).any(is_told)
            })
        };
        verdict.outcome != Outcome::Skipped
            && vertices(self.surface, side) == verdict.vertices
            && agrees(0)
            && agrees(1)
    }

    /// Every hard edge between exactly two triangles has a verdict.
    fn check_complete(&self, verdicts: &[EdgeVerdict], findings: &mut Findings) {
        let mut told: Vec<[u32; 2]> = verdicts.iter().map(|verdict| verdict.vertices).collect();
        told.sort_unstable();
        for edge in self.edges.iter().filter(|edge| self.surface.is_hard(edge)) {
            let ([forward], [backward]) = edge else { continue };
            let is_whole = |half_edge: &HalfEdge| !self.surface.is_collapsed(half_edge.corners[0]);
            let sides = [forward, backward].map(|side| vertices(self.surface, side));
            if is_whole(forward)
                && is_whole(backward)
                && sides.iter().all(|side| told.binary_search(side).is_err())
                && !self.lies_in_face([forward, backward], &told)
                && !self.may_be_noise([forward, backward])
            {
                findings.note(Rule::Verdicts, Element::SourceEdge(sides[0][0], sides[0][1]));
            }
        }
    }

    /// Whether it is for rounding to tell that an edge is more than noise.
    fn may_be_noise(&self, edge: [&HalfEdge; 2]) -> bool {
        let nearly_round = self.nearly_round.get_or_init(|| self.surface.nearly_round());
        self.surface.may_be_noise(edge, nearly_round)
    }

    /// Whether an edge without a verdict is a side of a line that is no more than a part of the faces
    /// around, as it shows no normals: one of its sides, or of those of the lines in a row with it, has
    /// a verdict, or no light breaks between the faces behind all of them.
    fn lies_in_face(&self, edge: [&HalfEdge; 2], told: &[[u32; 2]]) -> bool {
        let is_line = |triangle: u32| is_line(self.surface, triangle);
        let mut lines: Vec<u32> = edge.map(|side| side.corners[0] / 3).to_vec();
        lines.retain(|&triangle| is_line(triangle));
        let (mut next, mut faces) = (0, Vec::new());
        while next < lines.len() && lines.len() <= MOST_LINES {
            for corner in 3 * lines[next]..3 * lines[next] + 3 {
                let Some([own, other]) = self.pair_at(corner) else { return false };
                if [own, other]
                    .iter()
                    .any(|side| told.binary_search(&vertices(self.surface, side)).is_ok())
                {
                    return true;
                }
                let behind = other.corners[0] / 3;
                if !is_line(behind) {
                    faces.extend(other.corners);
                } else if !lines.contains(&behind) {
                    lines.push(behind);
                }
            }
            next += 1;
        }
        let differ = |one: u32, other: u32| {
            self.surface.cluster(one) == self.surface.cluster(other)
                && !self.surface.share_normal([one, other])
        };
        let is_whole = next == lines.len() && next > 0;
        is_whole && faces.iter().all(|&one| faces.iter().all(|&other| !differ(one, other)))
    }

    /// The two sides of the edge at a corner; none where there are more or fewer.
    fn pair_at(&self, corner: u32) -> Option<[&HalfEdge; 2]> {
        let next = corner - corner % 3 + (corner + 1) % 3;
        let ends = [corner, next].map(|corner| self.surface.vertex(corner) as u32);
        let place = self.edge_of.partition_point(|(vertices, _)| *vertices < ends);
        let (_, edge) = *self.edge_of.get(place).filter(|(vertices, _)| *vertices == ends)?;
        let ([forward], [backward]) = self.edges[edge as usize] else { return None };
        let is_forward = forward.corners[0] == corner;
        Some(if is_forward { [forward, backward] } else { [backward, forward] })
    }
}

/// Whether a triangle is so low that its vertices stand on one line.
fn is_line(surface: &Surface, triangle: u32) -> bool {
    let corners = surface.triangle(triangle);
    let longest = (0..3).map(|k| corners[k].distance(corners[(k + 1) % 3])).fold(0.0, f64::max);
    normal_with_area(corners).map_or(0.0, |area| area.length()) <= longest * reach(surface)
}

fn vertices(surface: &Surface, half_edge: &HalfEdge) -> [u32; 2] {
    half_edge.corners.map(|corner| surface.mesh.indices[corner as usize])
}

/// `is_alone`: no third side lies on the edge.
fn agrees(verdict: &EdgeVerdict, measured: &MeasuredEdge, is_alone: bool, tolerance: f64) -> bool {
    if verdict.outcome == Outcome::Skipped {
        // Where a chamfer ends beside it, an edge that stays hard goes on beside what is cut off.
        let stays = |end: usize| {
            let [one, other] = measured.distances[end];
            !measured.is_open[end] || f64::from(one.min(other)) <= tolerance
        };
        let is_left = match verdict.reason {
            Reason::NotSelected => stays(0) && stays(1),
            // Its sides share no edge, and so each goes along with whatever else is there.
            Reason::TJunction => !is_alone || !measured.is_chamfered(),
            Reason::Winding => true,
            _ => !measured.is_chamfered(),
        };
        return verdict.widths == [0.0; 2] && is_left;
    }
    verdict.widths.iter().zip(measured.distances).all(|(&told, [one, other])| {
        (f64::from(told) - (f64::from(one) + f64::from(other)) / 2.0).abs() <= tolerance
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    //      .          the normals of the two sides differ at `A` by as much as one of them is off its
    //    .' '.        flat face: whether that is noise of a round one, is for rounding to tell
    //   A-----.
    //    '. .'
    #[test]
    fn what_rounding_alone_tells_from_noise_needs_no_verdict() {
        let positions = [
            [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.5, 1.0, 0.0]],
            [[1.0, 0.0, 0.0], [0.0, 0.0, 0.0], [0.5, -1.0, -0.4]],
        ];
        for (short_by, missing) in [(-1e-3, 0), (5e-7, 0), (1e-3, 1)] {
            let up = [0.0, 0.0, 1.0];
            let mesh = Mesh {
                positions: positions.as_flattened(),
                normals: &[[0.0, 0.05, 1.0], up, up, up, [0.0, -short_by, 1.0], up],
                indices: &[0, 1, 2, 3, 4, 5],
                submesh_index_counts: &[6],
                ..Mesh::default()
            };
            let surface = Surface::new(&mesh);
            let mut findings = Findings::default();
            Sides::new(&surface).check_complete(&[], &mut findings);
            assert_eq!(findings.count(Rule::Verdicts), missing, "{short_by}");
        }
    }
}
