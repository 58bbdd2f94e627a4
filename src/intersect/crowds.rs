//! Triangles that crowd around one corner or one side.
//!
//! The boxes of all triangles at one corner overlap there, so boxes alone would compare each with
//! each. But two triangles are convex: where they have more in common than a corner, they have a
//! way from that corner in common. So they can only cut where the arcs overlap that they draw on a
//! small sphere around it; and around a common side, where their other corners lie the same way.
//! Boxes around these arcs tell nearly all of a crowd apart. The same holds around any other point
//! or line, such as where a corner was before it was pulled apart.

use std::collections::HashMap;
use std::hash::{BuildHasher, BuildHasherDefault, DefaultHasher};

use glam::DVec3;
use smallvec::SmallVec;

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
            (Some(k), _) => {
                let around = Around::line([triangle[k], triangle[(k + 1) % 3]]);
                Kin::new(names.of(side(triangle, k)), around.seen(&triangle))
            }
            (None, Some(k)) => {
                let place = place(triangle[k]);
                Kin::new(names.of([place, place]), Around::point(triangle[k]).seen(&triangle))
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

/// What a crowd gathers around: a point, or the line through two.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Around {
    points: [[f32; 3]; 2],
    /// Along the line; zero for a point.
    along: DVec3,
}

impl Around {
    pub fn point(at: [f32; 3]) -> Around {
        Around { points: [at; 2], along: DVec3::ZERO }
    }

    pub fn line(points: [[f32; 3]; 2]) -> Around {
        let [from, to] = points.map(wide);
        Around { points, along: (to - from).normalize_or_zero() }
    }

    /// A box around all directions in which a triangle is seen from there.
    pub fn seen(&self, triangle: &Triangle) -> Aabb {
        let own = |point: &&[f32; 3]| !self.points.contains(point);
        let ways: Option<SmallVec<[DVec3; 3]>> =
            triangle.iter().filter(own).map(|&point| self.way_to(point)).collect();
        let ways = ways.unwrap_or_default();
        if ways.is_empty() {
            return around(&[DVec3::ZERO], 1.0 + SLACK);
        }
        // The directions between some reach past their hull by what the hull comes nearer to the
        // center: of two, half of the way between them; of three, a third.
        let pairs = (1..ways.len()).flat_map(|k| ways[..k].iter().map(move |way| (way, k)));
        let least = pairs.map(|(way, k)| way.dot(ways[k])).fold(1.0, f64::min);
        let square = 1.0 - (1.0 - least) * (ways.len() - 1) as f64 / ways.len() as f64;
        around(&ways, 1.0 - square.max(0.0).sqrt() + SLACK)
    }

    /// Of unit length; none where it is mostly rounding.
    fn way_to(&self, point: [f32; 3]) -> Option<DVec3> {
        let way = wide(point) - wide(self.points[0]);
        let across = way - self.along * way.dot(self.along);
        (across.length() > LEAST_ACROSS * way.length()).then(|| across.normalize())
    }
}

fn wide(point: [f32; 3]) -> DVec3 {
    DVec3::from(point.map(f64::from))
}

fn around(points: &[DVec3], slack: f64) -> Aabb {
    let corners = points.iter().flat_map(|&point| [point - slack, point + slack]);
    let corners: SmallVec<[[f32; 3]; 6]> =
        corners.map(|corner| corner.as_vec3().to_array()).collect();
    Aabb::around(&corners)
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

    /// Directions that end at the same place, mixed in all ways, stay within the box.
    #[test]
    fn all_that_is_seen_of_a_triangle_is_in_the_box() {
        let triangle = [[1.0, 0.2, -0.3], [-0.2, 1.5, 0.1], [0.4, -0.3, 2.0]];
        for around in [Around::point([0.0; 3]), Around::line([[0.0; 3], [0.0, 0.1, 3.0]])] {
            let seen = around.seen(&triangle);
            for step in 0..=100 {
                let [a, b] = [step % 11, step / 11].map(|share| f64::from(share) / 20.0);
                let [p, q, r] = triangle.map(wide);
                let way = p + (q - p) * a + (r - p) * b;
                let across = (way - around.along * way.dot(around.along)).normalize();
                let at = Aabb::around(&[across.as_vec3().to_array()]);
                assert!(seen.overlaps(&at), "{across} from {around:?}");
            }
        }
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
