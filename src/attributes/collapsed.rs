//! Collapsed triangles: two of their corners stand at one position, so they are but a line.
//!
//! They stay lines: their corners go with the first real triangle on that line, all of them with
//! the same one, so that nothing opens and no edge gets crowded that was not.

use std::collections::BTreeMap;

use crate::ids::{Cluster, Corner, IdVec, Triangle};
use crate::plan::Plan;

/// Moves the corners of collapsed triangles along.
pub fn close(plan: &Plan, vertex_at: &mut IdVec<Corner, u32>) {
    let topology = &plan.topology;
    let is_collapsed = |triangle: &Triangle| topology.is_collapsed(*triangle);
    let collapsed: Vec<Triangle> = plan.view.triangles().filter(is_collapsed).collect();
    if collapsed.is_empty() {
        return;
    }
    let first_on = first_half_edges(plan, &collapsed);
    for triangle in collapsed {
        let corners = triangle.corners();
        let line = line_of(plan, triangle);
        for corner in corners {
            let at = topology.cluster_at[corner];
            let own = corners.into_iter().find(|&other| topology.cluster_at[other] == at);
            let carrier = first_on.get(&line).copied().flatten().map(|half_edge| {
                let starts_here = topology.cluster_at[half_edge] == at;
                if starts_here { half_edge } else { half_edge.next() }
            });
            vertex_at[corner] = vertex_at[carrier.or(own).unwrap_or(corner)];
        }
    }
}

/// The two clusters that a collapsed triangle spans, lower first; one twice if it is a point.
fn line_of(plan: &Plan, triangle: Triangle) -> [Cluster; 2] {
    let clusters = triangle.corners().map(|corner| plan.topology.cluster_at[corner]);
    [clusters.into_iter().min(), clusters.into_iter().max()].map(|c| c.unwrap_or(Cluster::NONE))
}

/// For each line of a collapsed triangle, the first half-edge of a real triangle there.
fn first_half_edges(plan: &Plan, collapsed: &[Triangle]) -> BTreeMap<[Cluster; 2], Option<Corner>> {
    let topology = &plan.topology;
    let mut first: BTreeMap<[Cluster; 2], Option<Corner>> =
        collapsed.iter().map(|&triangle| (line_of(plan, triangle), None)).collect();
    // Most half-edges do not start where one of these lines ends.
    let mut is_end = IdVec::filled(false, plan.weld.first_vertex.len());
    first.keys().flatten().for_each(|&cluster| is_end[cluster] = true);
    let real = plan.view.triangles().filter(|&triangle| !topology.is_collapsed(triangle));
    for half_edge in real.flat_map(Triangle::corners) {
        let ends = [half_edge, half_edge.next()].map(|corner| topology.cluster_at[corner]);
        if !ends.iter().all(|&cluster| is_end[cluster]) {
            continue;
        }
        if let Some(found) = first.get_mut(&[ends[0].min(ends[1]), ends[0].max(ends[1])]) {
            found.get_or_insert(half_edge);
        }
    }
    first
}
