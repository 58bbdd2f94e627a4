//! Room: the share of the offsets at which a source triangle would have lost its area.

use glam::DVec3;

use crate::ids::{IdVec, Sector, Triangle};
use crate::math::area_vector;
use crate::plan::Plan;

/// A triangle may give away all but this share of its area before anything else is looked at.
/// Somewhat more than what validity asks for, so that rounding does not undo it.
const LEAST_SHARE: f64 = 0.02;

/// `#sectors`: the largest share, up to 1, that leaves room in all triangles of the sector when
/// all sectors take the same.
pub fn room(plan: &Plan) -> IdVec<Sector, f64> {
    let mut shares = IdVec::filled(1.0_f64, plan.offsets.len());
    for triangle in plan.view.triangles() {
        let sectors = triangle.corners().map(|corner| plan.sectors.sector_of[corner]);
        if sectors.iter().all(|sector| sector.is_none()) {
            continue;
        }
        let most = most_share(plan, triangle, sectors);
        for sector in sectors.into_iter().filter(|sector| sector.is_some()) {
            shares[sector] = shares[sector].min(most);
        }
    }
    shares
}

/// The area along the old normal is a quadratic function of the share: its first root.
fn most_share(plan: &Plan, triangle: Triangle, sectors: [Sector; 3]) -> f64 {
    let [a, b, c] = plan.view.triangle(triangle);
    let move_of = |sector: Sector| {
        if sector.is_none() { DVec3::ZERO } else { plan.offsets[sector].vector }
    };
    let [move_a, move_b, move_c] = sectors.map(move_of);
    let normal = area_vector([a, b, c]);
    let (ab, ac) = (b - a, c - a);
    let (grow_ab, grow_ac) = (move_b - move_a, move_c - move_a);
    let whole = normal.length_squared();
    let linear = normal.dot(ab.cross(grow_ac) + grow_ab.cross(ac));
    let square = normal.dot(grow_ab.cross(grow_ac));
    first_root(square, linear, whole * (1.0 - LEAST_SHARE)).unwrap_or(1.0).min(1.0)
}

/// The smallest positive root of `square t^2 + linear t + constant`, for a positive constant.
fn first_root(square: f64, linear: f64, constant: f64) -> Option<f64> {
    let discriminant = linear * linear - 4.0 * square * constant;
    if discriminant < 0.0 {
        return None;
    }
    // The form that does not cancel; with a positive constant it is the root that comes first.
    let denominator = -linear + discriminant.sqrt();
    (denominator > 0.0).then(|| 2.0 * constant / denominator)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_root_is_the_smallest_positive_one() {
        assert_eq!(first_root(1.0, -3.0, 2.0), Some(1.0));
        assert_eq!(first_root(0.0, -2.0, 1.0), Some(0.5));
        assert_eq!(first_root(-1.0, 0.0, 4.0), Some(2.0));
        assert_eq!(first_root(1.0, 1.0, 1.0), None);
        assert_eq!(first_root(1.0, 3.0, 2.0), None, "both roots are negative");
    }
}
