//! The result of a mesh whose long sides got the vertices that stand on them, told in terms of the
//! source: all that lies on one long side is one edge.

use std::collections::BTreeMap;

use super::retold::{Elements, retold};
use super::{Refined, Stitched};
use crate::ids::Corner;
use crate::mesh::Mesh;
use crate::report::{Chamfered, EdgeVerdict, Outcome, Reason};

/// The result of the finer mesh as one of the source. `sides: #verdicts by 2`, the half-edges that
/// each is about.
pub fn stitched(
    source: &Mesh,
    finer: &Stitched,
    sides: &[[Corner; 2]],
    fine: Chamfered,
) -> Chamfered {
    let (edges, edge_of) = edges(&finer.refined, sides);
    let verdict = |(number, edge): (u32, &Edge)| match edge {
        Edge::Whole(verdict) => fine.verdicts[*verdict],
        Edge::Long(side, parts) => {
            let is_own = |part: &Part| edge_of[part.verdict] == number;
            merged(source, (*side, parts), &fine.verdicts, &is_own)
        }
    };
    let verdicts = (0u32..).zip(&edges).map(verdict).collect();
    let elements =
        Elements { source, refined: &finer.refined, edge_of, stands_at: &finer.stands_at };
    retold(&elements, fine, verdicts)
}

/// An edge of the source.
enum Edge {
    /// It is as it was, and has this verdict.
    Whole(usize),
    /// A long side, with all that is known of its parts.
    Long(Corner, Vec<Option<Part>>),
}

/// A part of a long side.
#[derive(Clone, Copy)]
struct Part {
    verdict: usize,
    /// Whether that tells of it from the start of the long side on.
    is_onward: bool,
}

/// The edges of the source, in the order of their first parts, and the one of each verdict. Where two
/// long sides overlap, that of the first half-edge has what they share.
fn edges(refined: &Refined, sides: &[[Corner; 2]]) -> (Vec<Edge>, Vec<u32>) {
    let (mut edges, mut edge_of) = (Vec::new(), Vec::with_capacity(sides.len()));
    let mut known: BTreeMap<Corner, u32> = BTreeMap::new();
    for (verdict, sides) in sides.iter().enumerate() {
        let long = sides.iter().find_map(|&side| refined.long_side(side));
        let next = edges.len() as u32;
        let edge = long.map_or(next, |long| *known.entry(long).or_insert(next));
        if edge == next {
            let parts = |long| refined.parts_of_side(long).map(|_| None).collect();
            edges.push(long.map_or(Edge::Whole(verdict), |long| Edge::Long(long, parts(long))));
        }
        edge_of.push(edge);
    }
    for (verdict, &[one, other]) in sides.iter().enumerate() {
        for (part, is_onward) in [(one, true), (other, false)] {
            let edge = refined.long_side(part).and_then(|long| known.get(&long));
            if let Some(Edge::Long(long, parts)) = edge.map(|&edge| &mut edges[edge as usize]) {
                let place = refined.parts_of_side(*long).position(|fine| fine == part);
                let part = place.and_then(|place| parts.get_mut(place));
                part.map(|part| part.get_or_insert(Part { verdict, is_onward }));
            }
        }
    }
    (edges, edge_of)
}

/// One verdict for all parts of a long side. It is skipped where its own are, whatever became of those
/// that another long side has.
fn merged(
    source: &Mesh,
    (side, parts): (Corner, &[Option<Part>]),
    fine: &[EdgeVerdict],
    is_own: &dyn Fn(&Part) -> bool,
) -> EdgeVerdict {
    let told = |part: &Part| fine[part.verdict];
    let own = parts.iter().flatten().filter(|part| is_own(part));
    let is_skipped = own.clone().all(|part| told(part).outcome == Outcome::Skipped);
    let found = || parts.iter().flatten().filter(|part| !is_skipped || is_own(part)).map(told);
    let is_paired = parts.iter().all(Option::is_some);
    let is_full = is_paired && found().all(|verdict| verdict.outcome == Outcome::Full);
    let outcome = match (is_skipped, is_full) {
        (true, _) => Outcome::Skipped,
        (_, true) => Outcome::Full,
        _ => Outcome::Narrowed,
    };
    let limited = found().filter(|verdict| verdict.reason != Reason::None);
    let wide = |verdict: &EdgeVerdict| verdict.widths[0] + verdict.widths[1];
    let worst = limited.min_by(|one, other| wide(one).total_cmp(&wide(other)));
    let unpaired = if is_paired { Reason::None } else { Reason::TJunction };
    let width = |part: Option<&Option<Part>>, end: usize| {
        let part = part.copied().flatten();
        part.map_or(0.0, |part| {
            fine[part.verdict].widths[if part.is_onward { end } else { 1 - end }]
        })
    };
    let segments = found().map(|verdict| verdict.segments).filter(|&segments| segments > 0);
    EdgeVerdict {
        vertices: [side, side.next()].map(|corner| source.indices[corner.0 as usize]),
        outcome,
        reason: worst.map_or(unpaired, |verdict| verdict.reason),
        widths: if outcome == Outcome::Skipped {
            [0.0; 2]
        } else {
            [width(parts.first(), 0), width(parts.last(), 1)]
        },
        segments: segments.min().unwrap_or(0),
    }
}

impl Refined {
    /// The long side of the source that a half-edge of the finer mesh is a part of; none where it is
    /// whole.
    pub(super) fn long_side(&self, fine: Corner) -> Option<Corner> {
        let piece = self.piece(fine.triangle())?;
        let place = fine.0 as usize % 3;
        let is_whole = piece.is_own_corner(place) && piece.is_own_corner((place + 1) % 3);
        if is_whole { None } else { piece.source_side(place) }
    }
}
