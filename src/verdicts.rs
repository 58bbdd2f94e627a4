//! Verdicts: what became of each hard edge, measured on the result.

use crate::edges::HardEdge;
use crate::ids::{Edge, IdVec, Sector};
use crate::limits::Limits;
use crate::math::unit;
use crate::plan::Plan;
use crate::report::{EdgeVerdict, Outcome, Reason, Totals};
use crate::strips::{self, Cut};

/// `#hard edges`.
pub fn verdicts(plan: &Plan, limits: &Limits, cuts: &IdVec<Edge, Cut>) -> Vec<EdgeVerdict> {
    let of_edge = |edge| verdict(plan, limits, &plan.edges.hard[edge], cuts[edge]);
    plan.edges.hard.ids().map(of_edge).collect()
}

fn verdict(plan: &Plan, limits: &Limits, edge: &HardEdge, cut: Cut) -> EdgeVerdict {
    let ends = [edge.sides[0], edge.sides[0].next()];
    let left = |reason| (Outcome::Skipped, reason, [0.0; 2]);
    let (outcome, reason, widths) = match edge.skipped {
        Some(reason) => left(reason),
        None => {
            let sectors = strips::corners(edge).map(|corner| plan.sectors.sector_of[corner]);
            let reason = worst_reason(plan, limits, sectors);
            if cut == Cut::Closed {
                left(reason.unwrap_or(unopened(plan, sectors)))
            } else {
                let outcome = if reason.is_some() { Outcome::Narrowed } else { Outcome::Full };
                (outcome, reason.unwrap_or(Reason::None), widths(plan, limits, edge))
            }
        }
    };
    EdgeVerdict { vertices: ends.map(|end| plan.view.vertex_at(end).0), outcome, reason, widths }
}

/// Why an edge did not open though nothing limited it.
fn unopened(plan: &Plan, sectors: [Sector; 4]) -> Reason {
    if plan.view.width <= plan.view.resolution {
        Reason::TooFine
    } else if sectors.into_iter().any(|sector| plan.sectors.fans[sector].stays_with_rim()) {
        Reason::Contact
    } else {
        Reason::NoEnd
    }
}

/// What limited the sector that got least of its offset; none if all got everything.
fn worst_reason(plan: &Plan, limits: &Limits, sectors: [Sector; 4]) -> Option<Reason> {
    let share = |sector: &Sector| limits.placement.share[*sector];
    let limited = sectors
        .into_iter()
        .filter(|&sector| plan.offsets[sector].moves() && share(&sector) < 1.0)
        .min_by(|one, other| share(one).total_cmp(&share(other)));
    let is_capped = sectors.into_iter().any(|sector| plan.offsets[sector].is_capped);
    limited.map(|sector| limits.reason[sector]).or(is_capped.then_some(Reason::Miter))
}

/// At each end, the mean distance of the two pulled vertices from the line of the old edge.
fn widths(plan: &Plan, limits: &Limits, edge: &HardEdge) -> [f32; 2] {
    let [from, to] = [edge.sides[0], edge.sides[0].next()].map(|c| plan.view.position_at(c));
    let along = unit(to - from);
    let corners = strips::corners(edge);
    let [b1, a1, a2, b2] = corners.map(|corner| limits.placement.position_at(plan, corner));
    let distance = |point: glam::DVec3| (point - from).cross(along).length();
    [(a1, a2), (b1, b2)].map(|(one, two)| ((distance(one) + distance(two)) / 2.0) as f32)
}

pub fn totals(plan: &Plan, verdicts: &[EdgeVerdict]) -> Totals {
    let mut totals = Totals { hard_edges: verdicts.len() as u32, ..Totals::default() };
    let (mut whole, mut got) = (0.0, 0.0);
    for (verdict, edge) in verdicts.iter().zip(plan.edges.hard.iter()) {
        match verdict.outcome {
            Outcome::Full => totals.chamfered += 1,
            Outcome::Narrowed => totals.narrowed += 1,
            Outcome::Skipped => totals.skipped[verdict.reason] += 1,
        }
        let [from, to] = [edge.sides[0], edge.sides[0].next()].map(|c| plan.view.position_at(c));
        let length = from.distance(to);
        for (width, counts) in verdict.widths.into_iter().zip(counting_ends(plan, verdict, edge)) {
            if counts {
                whole += length;
                got += length * (f64::from(width) / plan.view.width).min(1.0);
            }
        }
    }
    totals.mean_width = if whole > 0.0 { (got / whole) as f32 } else { 0.0 };
    totals
}

/// The ends of an edge at which a width was asked for: not those at which its chamfer tapers to a
/// point because it ends there.
fn counting_ends(plan: &Plan, verdict: &EdgeVerdict, edge: &HardEdge) -> [bool; 2] {
    let moves = strips::corners(edge).map(|corner| {
        let sector = plan.sectors.sector_of[corner];
        sector.is_some() && plan.offsets[sector].moves()
    });
    let is_skipped = verdict.outcome == Outcome::Skipped;
    [moves[1] || moves[2], moves[0] || moves[3]].map(|moves| moves || is_skipped)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::limits::limits;
    use crate::mesh::MeshBuffers;
    use crate::options::Verify;
    use crate::plan::tests::plan_of;
    use crate::shapes;

    fn judge(mesh: &MeshBuffers, width: f32) -> (Vec<EdgeVerdict>, Totals) {
        let plan = plan_of(mesh, width);
        let limits = limits(&plan, Verify::Fast).unwrap();
        let verdicts = verdicts(&plan, &limits, &strips::strips(&plan, &limits.placement));
        let totals = totals(&plan, &verdicts);
        (verdicts, totals)
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
        assert!(verdicts.iter().all(|verdict| verdict.reason == Reason::NoRoom));
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
}
