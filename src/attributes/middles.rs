//! Middles: the new vertex inside a fill of five or more points.
//!
//! It lies on no face of the source, and is the mean of more than three source vertices. Its
//! provenance is the blend of the old corner and two of the corner's neighbours that comes nearest.

use glam::DVec3;

use super::{Streams, Taken};
use crate::fills;
use crate::ids::{Few, Sector, Vertex};
use crate::math::unit;
use crate::placement::{Placement, base};
use crate::plan::Plan;
use crate::report::Blend;

/// Blends whose distances differ by less than this share are equally near: then the first counts,
/// whatever the last bits say.
const EQUALLY_NEAR: f64 = 0.999;

/// So many neighbours are tried in pairs: of more, as around the tip of a huge cone, every so manyth.
const MOST_TRIED: usize = 64;

/// The vertex at the mean of some of a ring's points.
pub fn add(
    plan: &Plan,
    placement: &Placement,
    streams: &mut Streams,
    sectors: &[Sector],
    places: &[usize],
    taken: Option<&Taken>,
) -> u32 {
    let points: Few<DVec3> = sectors.iter().map(|&s| placement.point[s]).collect();
    let normal = unit(places.iter().map(|&place| placement.normals[sectors[place]][0]).sum());
    let position = fills::middle(&points, places);
    let cluster = plan.topology.cluster_at[plan.sectors.fans[sectors[0]].first];
    let near = nearest(plan, sectors, position);
    streams.add_between(plan, cluster, (position, normal), (near, taken))
}

/// The blend of a ring's corner and two of its neighbours, none of negative weight, that comes
/// nearest to a point.
pub fn nearest(plan: &Plan, sectors: &[Sector], point: DVec3) -> Blend {
    let firsts = || sectors.iter().map(|&sector| plan.sectors.fans[sector].first);
    let corner = plan.view.vertex_at(plan.sectors.fans[sectors[0]].first);
    let at = base(plan, sectors[0]);
    let step = sectors.len().div_ceil(MOST_TRIED);
    let neighbours: Few<Vertex> =
        firsts().step_by(step).map(|first| plan.view.vertex_at(first.next())).collect();
    let mut best = (at.distance(point), Blend::one(corner.0));
    for (k, &one) in neighbours.iter().enumerate() {
        for &other in &neighbours[k + 1..] {
            let arms = [one, other].map(|vertex| plan.view.position(vertex) - at);
            let Some([a, b]) = weights(arms, point - at) else { continue };
            let distance = (at + arms[0] * a + arms[1] * b).distance(point);
            if distance < best.0 * EQUALLY_NEAR {
                let blend = Blend::new([corner.0, one.0, other.0], [1.0 - a - b, a, b]);
                best = (distance, blend);
            }
        }
    }
    best.1
}

/// How much of two arms comes nearest to a way; none if that takes negative weights.
fn weights([one, other]: [DVec3; 2], way: DVec3) -> Option<[f64; 2]> {
    let mixed = one.dot(other);
    let determinant = one.length_squared() * other.length_squared() - mixed * mixed;
    let a = (one.dot(way) * other.length_squared() - other.dot(way) * mixed) / determinant;
    let b = (other.dot(way) * one.length_squared() - one.dot(way) * mixed) / determinant;
    (a >= 0.0 && b >= 0.0 && a + b <= 1.0).then_some([a, b])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_lies_between_two_arms_is_met_exactly() {
        let arms = [DVec3::X * 2.0, DVec3::new(1.0, 1.0, 0.0)];
        let [a, b] = weights(arms, DVec3::new(0.75, 0.25, 0.0)).unwrap();
        assert!((a - 0.25).abs() < 1e-12 && (b - 0.25).abs() < 1e-12);
        assert_eq!(weights(arms, DVec3::NEG_X), None);
        assert_eq!(weights([DVec3::X, DVec3::X], DVec3::X), None, "they span nothing");
    }
}
