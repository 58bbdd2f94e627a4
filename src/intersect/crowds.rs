//! Triangles that crowd around one corner or one side.
//!
//! The boxes of all triangles at one corner overlap there, so boxes alone would compare each with
//! each. But two triangles are convex: where they have more in common than a corner, they have a
//! way from that corner in common. So they can only cut where the arcs overlap that they draw on a
//! small sphere around it; and around a common side, where their other corners lie the same way.
//! Boxes around these arcs tell nearly all of a crowd apart.

use std::collections::HashMap;
use std::hash::{BuildHasher, BuildHasherDefault, DefaultHasher};

use glam::DVec3;

use crate::bvh::{Aabb, Kin};

use super::Triangle;

/// Where fewer meet, comparing each with each costs less than knowing them.
const CROWD: u8 = 32;

/// Far more than rounding makes of a unit vector, far less than what tells neighbours apart.
const SLACK: f64 = 1e-6;

/// A way across a side that is this much shorter than what it is left from is mostly rounding.
const LEAST_ACROSS: f64 = 1e-6;

/// A position by its bits, -0 as 0.
type Place = [u32; 3];

/// `#triangles`: the corner or side that each crowds around with others, and where it lies as seen
/// from there. None where there is no crowd, as in nearly all meshes.
pub fn crowds(count: usize, corners: impl Fn(u32) -> Triangle) -> Option<Vec<Kin>> {
    let at_place = Crowded::new(3 * count, (0..count as u32).flat_map(|t| corners(t).map(place)));
    let is_crowded = |triangle: Triangle| triangle.map(|point| at_place.has(&place(point)));
    if !(0..count as u32).any(|triangle| is_crowded(corners(triangle)).contains(&true)) {
        return None;
    }
    let sides = (0..count as u32).flat_map(|triangle| {
        let triangle = corners(triangle);
        let crowded = is_crowded(triangle);
        (0..3).filter(move |&k| crowded[k] && crowded[(k + 1) % 3]).map(move |k| side(triangle, k))
    });
    let at_side = Crowded::new(3 * count, sides);
    let mut names = Names::default();
    let kin = (0..count as u32).map(|triangle| {
        let triangle = corners(triangle);
        let crowded_side = (0..3).find(|&k| at_side.has(&side(triangle, k)));
        match (crowded_side, at_place.most_crowded(triangle)) {
            (Some(k), _) => Kin::new(names.of(side(triangle, k)), seen_from_side(triangle, k)),
            (None, Some(k)) => {
                let place = place(triangle[k]);
                Kin::new(names.of([place, place]), seen_from_corner(triangle, k))
            }
            (None, None) => Kin::NONE,
        }
    });
    Some(kin.collect())
}

fn place(point: [f32; 3]) -> Place {
    point.map(|along| (along + 0.0).to_bits())
}

/// The side from a corner to the next, whichever way it is used.
fn side(triangle: Triangle, k: usize) -> [Place; 2] {
    let ends = [place(triangle[k]), place(triangle[(k + 1) % 3])];
    if ends[0] <= ends[1] { ends } else { [ends[1], ends[0]] }
}

/// How often each of some keys comes, by hash: a key may be taken for more crowded than it is, which
/// costs time but no pair.
struct Crowded {
    counts: Vec<u8>,
}

impl Crowded {
    fn new<K: std::hash::Hash>(most: usize, keys: impl Iterator<Item = K>) -> Crowded {
        let mut crowded = Crowded { counts: vec![0; most.next_power_of_two()] };
        for key in keys {
            let slot = crowded.slot(&key);
            crowded.counts[slot] = crowded.counts[slot].saturating_add(1);
        }
        crowded
    }

    fn slot<K: std::hash::Hash>(&self, key: &K) -> usize {
        let hash = BuildHasherDefault::<DefaultHasher>::default().hash_one(key);
        hash as usize & (self.counts.len() - 1)
    }

    fn has<K: std::hash::Hash>(&self, key: &K) -> bool {
        self.counts[self.slot(key)] >= CROWD
    }

    /// The corner of a triangle with the largest crowd; none without any.
    fn most_crowded(&self, triangle: Triangle) -> Option<usize> {
        let counts = triangle.map(|point| self.counts[self.slot(&place(point))]);
        let most = (0..3).fold(0, |best, k| if counts[k] > counts[best] { k } else { best });
        (counts[most] >= CROWD).then_some(most)
    }
}

/// Numbers for what crowds gather around, each its own: two triangles of one number have it in
/// common for certain.
#[derive(Default)]
struct Names(HashMap<[Place; 2], u32>);

impl Names {
    fn of(&mut self, what: [Place; 2]) -> u32 {
        let next = self.0.len() as u32;
        *self.0.entry(what).or_insert(next)
    }
}

/// A box around the arc that a triangle draws on the unit sphere around one of its corners.
fn seen_from_corner(triangle: Triangle, k: usize) -> Aabb {
    let [at, one, other] = wide(triangle, k);
    let ways = [one - at, other - at].map(DVec3::normalize_or_zero);
    // An arc reaches past its chord by so much.
    let half_cosine = ((1.0 + ways[0].dot(ways[1])) / 2.0).max(0.0).sqrt();
    around(&ways, 1.0 - half_cosine + SLACK)
}

/// A box around the way from one of a triangle's sides, square to it, to the third corner.
fn seen_from_side(triangle: Triangle, k: usize) -> Aabb {
    let [at, to, apex] = wide(triangle, k);
    let (along, way) = ((to - at).normalize_or_zero(), apex - at);
    let across = way - along * way.dot(along);
    if across.length() <= LEAST_ACROSS * way.length() {
        return around(&[DVec3::ZERO], 1.0 + SLACK);
    }
    around(&[across.normalize()], SLACK)
}

/// The corners from one on, in double precision.
fn wide(triangle: Triangle, k: usize) -> [DVec3; 3] {
    [0, 1, 2].map(|step| DVec3::from(triangle[(k + step) % 3].map(f64::from)))
}

fn around(points: &[DVec3], slack: f64) -> Aabb {
    let corners = points.iter().flat_map(|&point| [point - slack, point + slack]);
    Aabb::around(&corners.map(|corner| corner.as_vec3().to_array()).collect::<Vec<_>>())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Faces around the y axis, the first and the last side by side.
    fn fan(count: u32) -> Vec<Triangle> {
        let rim = |step: u32| {
            let turns = f64::from(step) / f64::from(count) * std::f64::consts::TAU;
            [turns.cos() as f32, 0.0, turns.sin() as f32]
        };
        (0..count).map(|step| [[0.0, 1.0, 0.0], rim(step), rim((step + 1) % count)]).collect()
    }

    fn kin_of(triangles: &[Triangle]) -> Option<Vec<Kin>> {
        crowds(triangles.len(), |triangle| triangles[triangle as usize])
    }

    fn met(kin: &[Kin], one: usize) -> usize {
        kin.iter().filter(|other| !kin[one].is_apart(other)).count()
    }

    #[test]
    fn few_triangles_are_no_crowd() {
        assert!(kin_of(&fan(8)).is_none());
        assert!(kin_of(&[]).is_none());
    }

    #[test]
    fn in_a_crowd_around_a_corner_each_meets_its_neighbours() {
        let kin = kin_of(&fan(400)).unwrap();
        for one in 0..kin.len() {
            assert!((3..20).contains(&met(&kin, one)), "{one} meets {}", met(&kin, one));
        }
    }

    #[test]
    fn in_a_crowd_around_a_side_each_meets_those_in_its_plane() {
        let page = |turns: f64| {
            let (sin, cos) = (turns * std::f64::consts::TAU).sin_cos();
            [[0.0; 3], [0.0, 2.0, 0.0], [cos as f32, 1.0, sin as f32]]
        };
        let mut pages: Vec<Triangle> = (0..100).map(|step| page(f64::from(step) / 100.0)).collect();
        pages.push([[0.0, 2.0, 0.0], [0.0; 3], pages[30][2].map(|along| along * 2.0 - 0.0)]);
        let kin = kin_of(&pages).unwrap();
        assert_eq!(met(&kin, 0), 1);
        assert_eq!(met(&kin, 30), 2, "another page lies on it");
    }
}
