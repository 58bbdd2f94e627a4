//! Chains: edges that run straight on into each other, which the eye takes for one.

use std::collections::BTreeMap;

use chamfer::{Chamfered, Mesh, Outcome, Reason};
use glam::DVec3;

use super::ground::Ground;

/// Edges that turn by less than five degrees run straight on.
const STRAIGHT_COSINE: f64 = 0.9962;

/// Chains of two edges and more, and how many of them are how uneven.
#[derive(Clone, Copy, Default)]
pub struct Chains {
    pub all: usize,
    /// The narrowest edge has less than nine tenths of the width of the widest.
    pub uneven: usize,
    /// Of these, with a verdict that says why: something rests there, or it would fold.
    pub told: usize,
    /// Of the uneven ones, those that are even but for edges that taper to a point by design.
    pub tapering: usize,
    /// Less than half.
    pub by_half: usize,
}

pub fn chains(mesh: &Mesh, after: &Chamfered) -> Chains {
    let ground = Ground::new(mesh);
    let mut edges: Vec<Edge> = after
        .verdicts
        .iter()
        .filter(|verdict| verdict.outcome != Outcome::Skipped)
        .map(|verdict| Edge {
            ends: verdict.vertices.map(|vertex| ground.place[vertex as usize]),
            widths: verdict.widths.map(f64::from),
            width: f64::from(verdict.widths[0] + verdict.widths[1]) / 2.0,
            tapers: false,
            is_told: !matches!(verdict.reason, Reason::None | Reason::NoRoom),
        })
        .collect();
    let mut chain_of: Vec<usize> = (0..edges.len()).collect();
    let around = around(&edges);
    for edge in &mut edges {
        edge.tapers = (0..2).any(|end| {
            edge.widths[end] < 0.01 * edge.widths[1 - end] && around[&edge.ends[end]].len() == 1
        });
    }
    for (&place, around) in &around {
        for &[one, other] in straight(&ground.points, &edges, place, around).iter() {
            let [one, other] = [one, other].map(|edge| first_of(&chain_of, edge));
            chain_of[one.max(other)] = one.min(other);
        }
    }
    let mut chains: BTreeMap<usize, Vec<&Edge>> = BTreeMap::new();
    for (number, edge) in edges.iter().enumerate() {
        chains.entry(first_of(&chain_of, number)).or_default().push(edge);
    }
    let mut counts = Chains::default();
    for chain in chains.values().filter(|chain| chain.len() > 1) {
        let (share, rest) = (evenness(chain, |_| true), evenness(chain, |edge| !edge.tapers));
        counts.all += 1;
        counts.uneven += usize::from(share < 0.9);
        counts.told += usize::from(share < 0.9 && chain.iter().any(|edge| edge.is_told));
        counts.tapering += usize::from(share < 0.9 && rest >= 0.9);
        counts.by_half += usize::from(share < 0.5);
    }
    counts
}

/// The share of the widest of some edges that the narrowest has; 1 without any.
fn evenness(chain: &[&Edge], is_asked: impl Fn(&Edge) -> bool) -> f64 {
    let widths = || chain.iter().filter(|edge| is_asked(edge)).map(|edge| edge.width);
    let (least, most) = (widths().fold(f64::INFINITY, f64::min), widths().fold(0.0, f64::max));
    if most > 0.0 { least / most } else { 1.0 }
}

struct Edge {
    ends: [usize; 2],
    widths: [f64; 2],
    width: f64,
    tapers: bool,
    is_told: bool,
}

/// The edges at each place.
fn around(edges: &[Edge]) -> BTreeMap<usize, Vec<usize>> {
    let mut around: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for (number, edge) in edges.iter().enumerate() {
        edge.ends.iter().for_each(|&end| around.entry(end).or_default().push(number));
    }
    around
}

/// The pairs of edges at a place each of which runs straight on into the other and no other one.
fn straight(points: &[DVec3], edges: &[Edge], place: usize, around: &[usize]) -> Vec<[usize; 2]> {
    let way = |edge: usize| {
        let [from, to] = edges[edge].ends;
        let far = if from == place { to } else { from };
        (points[far] - points[place]).normalize_or_zero()
    };
    let run_on = |&[one, other]: &[usize; 2]| way(one).dot(way(other)) < -STRAIGHT_COSINE;
    let pairs = around.iter().flat_map(|&one| around.iter().map(move |&other| [one, other]));
    let pairs: Vec<[usize; 2]> = pairs.filter(|[one, other]| one < other).filter(run_on).collect();
    let times = |edge: usize| pairs.iter().filter(|pair| pair.contains(&edge)).count();
    pairs.iter().copied().filter(|pair| pair.iter().all(|&edge| times(edge) == 1)).collect()
}

fn first_of(chain_of: &[usize], mut edge: usize) -> usize {
    while chain_of[edge] != edge {
        edge = chain_of[edge];
    }
    edge
}
