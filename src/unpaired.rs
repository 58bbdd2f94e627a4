//! Unpaired: hard edges whose sides have no twin, so that no chamfer can close between them.
//!
//! There are two kinds. Two faces run the same way along their edge, as one of them is inside out;
//! or the edge of one face has a vertex of the other side in its middle (a *T-junction*). Both look
//! like any hard edge, so each has a verdict that says why it stays.

use crate::contacts::{ASKED, Contacts};
use crate::error::Error;
use crate::ids::Corner;
use crate::line::Line;
use crate::report::{Chamfered, EdgeVerdict, Outcome, Reason};
use crate::shape::Shape;
use crate::topology::Topology;
use crate::view::View;
use crate::watch::Watch;

/// A half-edge whose other side is no twin, and why.
pub type Unpaired = (Corner, Reason);

/// All such edges, those of faces that run the same way first.
///
/// # Errors
/// [`Error::Cancelled`] where the watch stops it.
pub fn unpaired(view: &View, shape: &Shape, watch: &dyn Watch) -> Result<Vec<Unpaired>, Error> {
    let Shape { topology, contacts, .. } = shape;
    let turned = turned(view, topology).into_iter().map(|side| (side, Reason::Winding));
    let junctions = junctions(view, topology, contacts, watch)?.into_iter();
    Ok(turned.chain(junctions.map(|side| (side, Reason::TJunction))).collect())
}

/// A result with the verdicts of these edges, too.
pub fn with_verdicts(view: &View, mut chamfered: Chamfered, further: &[Unpaired]) -> Chamfered {
    chamfered.totals.hard_edges += further.len() as u32;
    for &(side, reason) in further {
        chamfered.totals.skipped[reason] += 1;
        chamfered.verdicts.push(left(view, side, reason));
    }
    chamfered
}

fn left(view: &View, side: Corner, reason: Reason) -> EdgeVerdict {
    let vertices = [side, side.next()].map(|end| view.vertex_at(end).0);
    EdgeVerdict { vertices, outcome: Outcome::Skipped, reason, widths: [0.0; 2], segments: 0 }
}

/// Of each two half-edges that run the same way along a hard edge and have no twin, the first.
fn turned(view: &View, topology: &Topology) -> Vec<Corner> {
    let is_turned = |&[one, other]: &[Corner; 2]| {
        let is_open = |side| topology.twin[side].is_none() && !topology.is_hidden(side);
        topology.cluster_at[one] == topology.cluster_at[other]
            && is_open(one)
            && is_open(other)
            && [(one, other), (one.next(), other.next())].into_iter().any(|(one, other)| {
                view.normals_differ([view.normal_at(one), view.normal_at(other)])
            })
    };
    let pairs = topology.touching.iter().copied().filter(is_turned);
    let mut turned: Vec<Corner> = pairs.map(|[one, _]| one).collect();
    turned.sort_unstable();
    turned.dedup();
    turned
}

/// The open borders on which shorter ones lie, of other faces that meet theirs at a hard edge.
fn junctions(
    view: &View,
    topology: &Topology,
    contacts: &Contacts,
    watch: &dyn Watch,
) -> Result<Vec<Corner>, Error> {
    let mut junctions = Vec::new();
    for border in contacts.borders().filter(|&border| topology.twin[border].is_none()) {
        let line = Line::new(view, border);
        let ends = [border, border.next()].map(|corner| view.position_at(corner));
        let mut asked = ASKED;
        let is_one = contacts.borders_along(ends).any(|place| {
            asked += 1;
            // At one place all are the same line, and only one's number and normals differ.
            let mut place = place.filter(|&other| topology.twin[other].is_none()).peekable();
            let first = place.peek().copied();
            first.is_some_and(|first| is_along(view, topology, &line, first))
                && place.any(|other| meets_shorter(view, topology, &line, other))
        });
        junctions.extend(is_one.then_some(border));
        watch.worked(asked)?;
    }
    junctions.sort_unstable();
    Ok(junctions)
}

/// Whether another border runs back beside a line, and is no longer.
fn is_along(view: &View, topology: &Topology, line: &Line, other: Corner) -> bool {
    let shorter = Line::new(view, other);
    shorter.length <= line.length && runs_back(topology, line, &shorter)
}

/// Whether such a border lies on the line, and meets it at a hard edge. Of two that are as long, one
/// stands for both.
fn meets_shorter(view: &View, topology: &Topology, line: &Line, other: Corner) -> bool {
    let shorter = Line::new(view, other);
    (shorter.length, other) < (line.length, line.border) && meets(view, topology, line, &shorter)
}

fn runs_back(topology: &Topology, line: &Line, other: &Line) -> bool {
    other.along.dot(line.along) < 0.0 && !is_same_edge(topology, line.border, other.border)
}

/// Whether another border runs back along a part of a line, and light breaks between them.
pub fn meets(view: &View, topology: &Topology, line: &Line, other: &Line) -> bool {
    let shared = || line.shared(other.ends(), view.reach());
    runs_back(topology, line, other)
        && shared().is_some_and(|[start, end]| {
            let middle = line.from + line.along * ((start + end) / 2.0);
            view.normals_differ([line.normal(view, middle), other.normal(view, middle)])
        })
}

fn is_same_edge(topology: &Topology, one: Corner, other: Corner) -> bool {
    let clusters = |side: Corner| [side, side.next()].map(|corner| topology.cluster_at[corner]);
    let [from, to] = clusters(other);
    clusters(one) == [to, from]
}
