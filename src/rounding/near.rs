//! Near: what a point on a rounded patch comes from.
//!
//! It lies on no face of the source. What has to follow there, such as skin weights, is blended from
//! what its corners come from, and from the old corner as far as it is bent towards that. Three
//! source vertices are all that provenance has: the old corner and the two that weigh most, with the
//! rest on the old corner.

use glam::DVec3;

use super::Given;
use crate::ids::{Corner, Few, Sector, Vertex};
use crate::report::Blend;

/// The blend for a point of a ring that takes so much of each of some corners.
pub fn near(
    given: &Given,
    sector: Sector,
    corners: &[Corner],
    shares: &[f64],
    point: DVec3,
) -> Blend {
    let base = given.chamfers.sectors.fans[sector].first;
    let (view, placement) = (given.view, given.placement);
    let terms = || corners.iter().zip(shares);
    let flat: DVec3 = terms().map(|(&c, &share)| placement.position_at(c) * share).sum();
    let rise = view.position_at(base) - flat;
    let bent = (point - flat).dot(rise) / rise.length_squared();
    let bent = if bent.is_finite() { bent.clamp(0.0, 1.0) } else { 0.0 };
    let blends = terms().map(|(&c, &share)| (surface_of(given, c), share * (1.0 - bent)));
    let corner = Blend::one(view.vertex_at(base).0);
    joined(|vertex| view.position(Vertex(vertex)), [(corner, bent)].into_iter().chain(blends))
}

/// Where a corner's vertex comes from on the surface.
fn surface_of(given: &Given, corner: Corner) -> Blend {
    let sector = given.chamfers.sectors.sector_of[corner];
    if given.placement.has_moved(sector) {
        let foot = given.placement.surface_foot(sector, corner);
        foot.blend(given.view, given.placement.share[sector])
    } else {
        Blend::one(given.view.vertex_at(corner).0)
    }
}

/// A weighted mean of blends: of more than three vertices the first one and the two of most weight,
/// and the rest on the first. Vertices at one place count as one.
pub fn joined<P: PartialEq>(
    position: impl Fn(u32) -> P,
    blends: impl Iterator<Item = (Blend, f64)>,
) -> Blend {
    let mut terms: Few<(u32, f64)> = Few::new();
    for (blend, share) in blends {
        for (vertex, weight) in blend.vertices.into_iter().zip(blend.weights) {
            let weight = f64::from(weight) * share;
            let is_one = |other: u32| other == vertex || position(other) == position(vertex);
            match terms.iter().position(|&(other, _)| is_one(other)) {
                Some(known) => terms[known].1 += weight,
                None if weight != 0.0 || terms.is_empty() => terms.push((vertex, weight)),
                None => {}
            }
        }
    }
    if terms.len() > 3 {
        terms[1..].sort_by(|one, other| other.1.abs().total_cmp(&one.1.abs()));
        let rest: f64 = terms.drain(3..).map(|(_, weight)| weight).sum();
        terms[0].1 += rest;
    }
    let first = terms[0].0;
    let term = |k: usize| terms.get(k).copied().unwrap_or((first, 0.0));
    let [one, two, three] = [0, 1, 2].map(term);
    Blend::new([one.0, two.0, three.0], [one.1, two.1, three.1])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_two_that_weigh_most_stay_and_the_rest_goes_to_the_first() {
        let even = Blend { vertices: [1, 2, 3], weights: [0.5, 0.25, 0.25] };
        let other = Blend { vertices: [4, 2, 1], weights: [1.0, 0.0, 0.0] };
        let blend = joined(
            |vertex| vertex,
            [(Blend::one(0), 0.25), (even, 0.25), (other, 0.5)].into_iter(),
        );
        assert_eq!(blend.vertices, [0, 4, 1]);
        assert_eq!(blend.weights, [0.375, 0.5, 0.125]);
    }

    #[test]
    fn vertices_at_one_place_are_one() {
        let pair = Blend { vertices: [1, 2, 3], weights: [0.5, 0.25, 0.25] };
        let blend = joined(|vertex| vertex / 2, [(Blend::one(0), 0.5), (pair, 0.5)].into_iter());
        assert_eq!((blend.vertices, blend.weights), ([0, 2, 0], [0.75, 0.25, 0.0]));
    }
}
