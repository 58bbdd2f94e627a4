//! Verdicts: what became of each hard edge, measured on the result.

use glam::DVec3;

use crate::chamfers::Chamfers;
use crate::edges::HardEdge;
use crate::error::Error;
use crate::ids::{Corner, Edge, Id, Patch, Sector};
use crate::limits::Limits;
use crate::math::{area_vector, unit};
use crate::patches::Patches;
use crate::report::{EdgeVerdict, Outcome, Reason, Totals};
use crate::rounding::Rounding;
use crate::sectors::Sectors;
use crate::strips;
use crate::threads::Threads;
use crate::view::{View, wide};
use crate::watch::Watch;

/// `#hard edges`, and their sum.
///
/// # Errors
/// [`Error::Cancelled`] where the watch stops it.
pub fn verdicts(
    view: &View,
    chamfers: Chamfers,
    limits: &Limits,
    (patches, rounding): (&Patches, Option<&Rounding>),
    (threads, watch): (&Threads, &dyn Watch),
) -> Result<(Vec<EdgeVerdict>, Totals), Error> {
    let Chamfers { edges, sectors } = chamfers;
    let told = &mut Told { verdicts: Vec::with_capacity(edges.hard.len()), sum: Sum::default() };
    let note = |_: &Told, edge: Edge, notes: &mut Notes| {
        let is_open = !patches.triangles(Patch(edge.0)).is_empty();
        let segments = if is_open { segments(rounding, edge) } else { 0 };
        let edge = &edges.hard[edge];
        let at = strips::corners(edge).map(|corner| sectors.sector_of[corner]);
        let vertices = [edge.sides[0], edge.sides[0].next()].map(|end| view.vertex_at(end));
        let line = vertices.map(|vertex| view.position(vertex));
        let (outcome, reason, widths) = outcome(view, (sectors, at), limits, (edge, line, is_open));
        let counting = counting_ends(limits, at, (outcome, reason));
        notes.counted.push(counted(edge, line, widths, counting));
        let vertices = vertices.map(|vertex| vertex.0);
        notes.verdicts.push(EdgeVerdict { vertices, outcome, reason, widths, segments });
    };
    threads.blocks_then((edges.hard.len(), watch), told, note, |told, notes| {
        let verdicts = notes.verdicts.iter().zip(&notes.counted);
        verdicts.for_each(|(verdict, counted)| told.sum.add(verdict, counted));
        told.verdicts.append(&mut notes.verdicts);
        notes.counted.clear();
    })?;
    Ok((std::mem::take(&mut told.verdicts), told.sum.totals()))
}

/// The verdicts on some edges, and their sum.
struct Told {
    verdicts: Vec<EdgeVerdict>,
    sum: Sum,
}

/// The same of some edges, of each of which it is told what it counts for.
#[derive(Default)]
struct Notes {
    verdicts: Vec<EdgeVerdict>,
    counted: Vec<Counted>,
}

/// What became of an edge from one place to another, why, and how wide it is at its ends. The sectors at it
/// stand in the order of [`strips::corners`].
fn outcome(
    view: &View,
    (sectors, at): (&Sectors, [Sector; 4]),
    limits: &Limits,
    (edge, line, is_open): (&HardEdge, [DVec3; 2], bool),
) -> (Outcome, Reason, [f32; 2]) {
    if let Some(reason) = edge.skipped {
        return (Outcome::Skipped, reason, [0.0; 2]);
    }
    let reason = worst_reason(limits, at);
    if !is_open {
        let reason = unopened(view, (sectors, at), (edge, reason));
        return (Outcome::Skipped, reason, [0.0; 2]);
    }
    let outcome = if reason.is_some() { Outcome::Narrowed } else { Outcome::Full };
    (outcome, reason.unwrap_or(Reason::None), widths(view, limits, (edge, at), line))
}

/// The least that an end has: one that does not open has no fewer than the other.
fn segments(rounding: Option<&Rounding>, edge: Edge) -> u32 {
    let [one, other] = rounding.map_or([1; 2], |rounding| rounding.rows(edge));
    one.min(other).into()
}

/// Whether a face beside an edge is wound against its own normals: no chamfer can face along with
/// those then.
fn faces_away(view: &View, edge: &HardEdge) -> bool {
    edge.sides.iter().any(|side| {
        let triangle = side.triangle();
        let normals = triangle.corners().map(|corner| view.normal_at(corner));
        area_vector(view.triangle(triangle)).dot(normals.into_iter().sum()) < 0.0
    })
}

/// Why an edge did not open, where something may have limited it.
fn unopened(
    view: &View,
    (sectors, at): (&Sectors, [Sector; 4]),
    (edge, limited): (&HardEdge, Option<Reason>),
) -> Reason {
    let stays_with_rim = || at.into_iter().any(|sector| sectors.fans[sector].stays_with_rim());
    match limited {
        _ if edge.widest() <= view.resolution => Reason::TooFine,
        Some(Reason::Folds) if faces_away(view, edge) => Reason::Winding,
        Some(reason) => reason,
        None if stays_with_rim() => Reason::Contact,
        None => Reason::NoEnd,
    }
}

/// What limited the edge's side that got least; none if all got everything.
fn worst_reason(limits: &Limits, at: [Sector; 4]) -> Option<Reason> {
    // A side is the first edge of the sector where it starts, and the last one where it ends.
    let fronts = [1, 0, 1, 0];
    let (mut least, mut least_at, mut is_capped) = (1.0, Sector::NONE, false);
    for (sector, front) in at.into_iter().zip(fronts) {
        let offset = limits.placement.offset(sector);
        let share = limits.placement.share[sector] * offset.fronts[front];
        if share < least && offset.moves() {
            (least, least_at) = (share, sector);
        }
        is_capped |= offset.is_capped;
    }
    if least_at.is_none() {
        return is_capped.then_some(Reason::Miter);
    }
    match limits.reason[least_at] {
        Reason::None => Some(Reason::NoRoom),
        reason => Some(reason),
    }
}

/// At each end, the mean distance of the two pulled vertices from the line of the old edge.
fn widths(
    view: &View,
    limits: &Limits,
    (edge, at): (&HardEdge, [Sector; 4]),
    line: [DVec3; 2],
) -> [f32; 2] {
    if let Some(stored) = &view.stored {
        // Rounded where it is measured, a short edge would be turned, and what is far off it with it.
        let standing = |at: [f32; 3]| stored.to * wide(at);
        let source = |at: Corner| standing(stored.positions[view.vertex_at(at).index()]);
        let line = [edge.sides[0], edge.sides[0].next()].map(source);
        let points = strips::corners(edge).map(|at| standing(limits.placement.stored_at(at)));
        return means(line, points);
    }
    means(line, at.map(|sector| limits.placement.point[sector]))
}

/// At each end of a strip, the mean distance of its two corners from a line.
#[inline]
fn means([from, to]: [DVec3; 2], [b1, a1, a2, b2]: [DVec3; 4]) -> [f32; 2] {
    let along = unit(to - from);
    let distance = |point: DVec3| (point - from).cross(along).length();
    [(a1, a2), (b1, b2)].map(|(one, two)| ((distance(one) + distance(two)) / 2.0) as f32)
}

/// The ends of an edge at which a width was asked for: not those at which its chamfer tapers to a
/// point because it ends there.
fn counting_ends(
    limits: &Limits,
    at: [Sector; 4],
    (outcome, reason): (Outcome, Reason),
) -> [bool; 2] {
    if reason == Reason::NotSelected {
        return [false; 2];
    }
    if outcome == Outcome::Skipped {
        return [true; 2];
    }
    let moves = |k: usize| limits.placement.offset(at[k]).moves();
    [moves(1) || moves(2), moves(0) || moves(3)]
}

/// What an edge counts for.
struct Counted {
    length: f64,
    /// At each end, the share that it got of the width asked for, and whether one was.
    got: [f64; 2],
    counting: [bool; 2],
}

fn counted(
    edge: &HardEdge,
    [from, to]: [DVec3; 2],
    widths: [f32; 2],
    counting: [bool; 2],
) -> Counted {
    let share = |end: usize| f64::from(widths[end]) / edge.widths[end];
    let got = [0, 1].map(|end| if share(end) < 1.0 { share(end) } else { 1.0 });
    Counted { length: from.distance(to), got, counting }
}

/// What is told of all edges, in the making.
#[derive(Clone, Copy, Default)]
struct Sum {
    totals: Totals,
    /// The lengths of edges by the widths that their ends got, in terms of those asked for.
    got: f64,
}

impl Sum {
    #[inline]
    fn add(&mut self, verdict: &EdgeVerdict, Counted { length, got, counting }: &Counted) {
        let totals = &mut self.totals;
        totals.hard_edges += 1;
        match verdict.outcome {
            Outcome::Full => totals.chamfered += 1,
            Outcome::Narrowed => totals.narrowed += 1,
            Outcome::Skipped => totals.skipped[verdict.reason] += 1,
        }
        for (share, _) in got.iter().zip(counting).filter(|(_, counts)| **counts) {
            totals.counted += length;
            self.got += length * share;
        }
    }

    fn totals(self) -> Totals {
        let (whole, got) = (self.totals.counted, self.got);
        Totals { mean_width: if whole > 0.0 { (got / whole) as f32 } else { 0.0 }, ..self.totals }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::MeshBuffers;
    use crate::options::Verify;
    use crate::shapes;
    use crate::stages::stages_of;
    use crate::view::Stored;
    use crate::watch::Unwatched;
    use glam::DMat3;

    fn judge(mesh: &MeshBuffers, width: f32) -> (Vec<EdgeVerdict>, Totals) {
        let stages = stages_of(mesh, width);
        let limits = stages.limits(Verify::Fast);
        let patches = stages.patches(&limits.placement);
        let work: (&Threads, &dyn Watch) = (&stages.threads, &Unwatched);
        verdicts(&stages.view, stages.chamfers(), &limits, (&patches, None), work).unwrap()
    }

    #[test]
    fn a_cube_gets_full_width_everywhere() {
        let (verdicts, totals) = judge(&shapes::plain_cube(1.0), 0.1);
        for verdict in &verdicts {
            assert_eq!((verdict.outcome, verdict.reason), (Outcome::Full, Reason::None));
            assert!(verdict.widths.iter().all(|width| (width - 0.1).abs() < 1e-6));
        }
        assert_eq!((totals.hard_edges, totals.chamfered), (12, 12));
        assert!((totals.mean_width - 1.0).abs() < 1e-6);
    }

    #[test]
    fn without_room_an_edge_is_narrowed() {
        let (verdicts, totals) = judge(&shapes::plate(), 0.5);
        let is_told = |verdict: &EdgeVerdict| {
            // The upright edges have room, and so much that the corners would fold.
            matches!(verdict.reason, Reason::NoRoom | Reason::Folds)
        };
        assert!(verdicts.iter().all(is_told), "{verdicts:?}");
        assert_eq!((totals.chamfered, totals.narrowed), (0, 12));
        assert!(totals.mean_width < 0.9);
    }

    #[test]
    fn a_width_below_the_precision_of_the_positions_is_too_fine() {
        let (verdicts, totals) = judge(&shapes::plain_cube(1.0), 1e-9);
        assert!(verdicts.iter().all(|verdict| verdict.reason == Reason::TooFine));
        assert_eq!(totals.skipped[Reason::TooFine], 12);
        assert_eq!(totals.mean_width, 0.0);
    }

    #[test]
    fn where_a_chamfer_ends_in_a_point_no_width_is_missing() {
        let (verdicts, totals) = judge(&shapes::wedge_end(), 0.01);
        assert!(verdicts.iter().any(|verdict| verdict.widths.contains(&0.0)));
        // The ridge's edge is long enough that half of it would show.
        assert!(totals.mean_width > 0.998, "{}", totals.mean_width);
    }

    #[test]
    fn no_hard_edges_no_verdicts() {
        assert_eq!(judge(&shapes::sphere(4, 6), 0.1), (vec![], Totals::default()));
    }

    /// What a mesh is measured as is rounded, and so its short edges are turned: here by far more than that.
    #[test]
    fn widths_are_those_of_the_mesh_as_it_is_stored() {
        let cube = shapes::plain_cube(1.0);
        let mut stored = cube.positions.clone();
        stored.iter_mut().for_each(|at| at[0] += 0.05 * at[1]);
        let mut stages = stages_of(&cube, 0.1);
        stages.view.stored = Some(Stored {
            positions: &stored,
            normals: &cube.normals,
            to: DMat3::IDENTITY,
            back: DMat3::IDENTITY,
            normal_to: DMat3::IDENTITY,
        });
        let limits = stages.limits(Verify::Fast);
        let edges = &stages.chamfers().edges.hard;
        for edge in edges.iter() {
            let at = strips::corners(edge).map(|corner| stages.sectors.sector_of[corner]);
            let side = edge.sides[0];
            let line = [side, side.next()].map(|c| stages.view.position_at(c));
            let told = widths(&stages.view, &limits, (edge, at), line);
            let [from, to] =
                [side, side.next()].map(|c| wide(stored[stages.view.vertex_at(c).index()]));
            let pulled = [edge.sides[0], edge.sides[1].next()].map(|corner| {
                (wide(limits.placement.stored_at(corner)) - from).cross(unit(to - from)).length()
            });
            let expected = (pulled[0] + pulled[1]) / 2.0;
            assert!((f64::from(told[0]) - expected).abs() < 1e-6, "{told:?} instead of {expected}");
        }
    }
}
