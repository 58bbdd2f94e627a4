//! Triangles that crowd around one corner or one side.
//!
//! The boxes of all triangles at one corner overlap there, so boxes alone would compare each with
//! each. But two triangles are convex: where they have more in common than a corner, they have a
//! way from that corner in common. So they can only cut where the arcs overlap that they draw on a
//! small sphere around it; and around a common side, where their other corners lie the same way.
//! Boxes around these arcs tell nearly all of a crowd apart. The same holds around any other point
//! or line, such as where a corner was before it was pulled apart.

use std::collections::HashMap;
use std::hash::{BuildHasher, BuildHasherDefault, Hash, Hasher};

use glam::DVec3;
use smallvec::SmallVec;

use crate::bvh::{Aabb, Kin};

use super::Triangle;

/// Where fewer meet, comparing each with each costs less than knowing them.
pub(super) const CROWD: u8 = 32;

/// Far more than rounding makes of a unit vector, far less than what tells neighbours apart.
const SLACK: f64 = 1e-6;

/// A way across a side that is this much shorter than what it is left from has a direction that rounding
/// in double precision turns by less than the slack.
const LEAST_ACROSS: f64 = 1e-9;

/// A position by its bits, -0 as 0.
pub(super) type Place = [u32; 3];

/// A side by its ends, or a place twice.
pub(super) type Name = [Place; 2];

/// `#triangles`: the corner or side that each crowds around with others, and where it lies as seen
/// from there. None where there is no crowd, as in nearly all meshes.
pub(crate) fn crowds(triangles: &[Triangle]) -> Option<Vec<Kin>> {
    let meeting = Meeting::of(triangles)?;
    let mut names = Names::default();
    let kin = |triangle: &Triangle| match meeting.around(triangle) {
        Some((name, around)) => Kin::new(names.of(name), around.seen(triangle)),
        None => Kin::NONE,
    };
    Some(triangles.iter().map(kin).collect())
}

/// Where many of some triangles meet.
struct Meeting {
    at_place: Counts,
    at_side: Counts,
}

impl Meeting {
    /// None where no crowd does.
    fn of(triangles: &[Triangle]) -> Option<Meeting> {
        let most = 3 * triangles.len();
        let at_place = Counts::new(most, triangles.as_flattened().iter().map(|&p| place(p)));
        let is_crowded =
            |triangle: &Triangle| triangle.map(|point| at_place.are_many(&place(point)));
        if !triangles.iter().any(|triangle| is_crowded(triangle).contains(&true)) {
            return None;
        }
        let sides = triangles.iter().flat_map(|triangle| {
            let crowded = is_crowded(triangle);
            let both = move |&k: &usize| crowded[k] && crowded[(k + 1) % 3];
            (0..3).filter(both).map(|k| side(triangle, k))
        });
        let at_side = Counts::new(most, sides);
        Some(Meeting { at_place, at_side })
    }

    /// What a triangle crowds around, by name: a side before a corner.
    fn around(&self, triangle: &Triangle) -> Option<(Name, Around)> {
        if let Some(k) = (0..3).find(|&k| self.at_side.are_many(&side(triangle, k))) {
            let ends = [triangle[k], triangle[(k + 1) % 3]];
            return Some((side(triangle, k), Around::line(ends)));
        }
        let at = triangle[self.at_place.most(triangle.map(place))?];
        Some(([place(at); 2], Around::point(at)))
    }
}

pub(super) fn place(point: [f32; 3]) -> Place {
    point.map(|along| (along + 0.0).to_bits())
}

/// The side from a corner to the next, whichever way it is used.
pub(super) fn side(triangle: &Triangle, k: usize) -> Name {
    let ends = [place(triangle[k]), place(triangle[(k + 1) % 3])];
    if ends[0] <= ends[1] { ends } else { [ends[1], ends[0]] }
}

/// How often each of some keys comes, by hash: a key may be taken for more crowded than it is, which
/// costs time but no pair.
pub(super) struct Counts(Vec<u8>);

impl Counts {
    pub fn new<K: Hash>(most: usize, keys: impl Iterator<Item = K>) -> Counts {
        let mut counts = Counts(vec![0; most.next_power_of_two()]);
        for key in keys {
            let slot = counts.slot(&key);
            counts.0[slot] = counts.0[slot].saturating_add(1);
        }
        counts
    }

    fn slot<K: Hash>(&self, key: &K) -> usize {
        let hash = BuildHasherDefault::<Mixer>::default().hash_one(key);
        (hash >> 32) as usize & (self.0.len() - 1)
    }

    pub fn are_many<K: Hash>(&self, key: &K) -> bool {
        self.0[self.slot(key)] >= CROWD
    }

    /// Which of a triangle's corners has the largest crowd; none without any.
    fn most(&self, corners: [Place; 3]) -> Option<usize> {
        let counts = corners.map(|corner| self.0[self.slot(&corner)]);
        let most = (0..3).fold(0, |best, k| if counts[k] > counts[best] { k } else { best });
        (counts[most] >= CROWD).then_some(most)
    }
}

/// Multiplies and turns: keys are positions of a mesh, which nobody chooses to collide.
#[derive(Default)]
struct Mixer(u64);

impl Hasher for Mixer {
    fn write(&mut self, bytes: &[u8]) {
        bytes.iter().for_each(|&byte| self.write_u32(byte.into()));
    }

    fn write_u32(&mut self, word: u32) {
        self.0 = (self.0.rotate_left(23) ^ u64::from(word)).wrapping_mul(GOLDEN);
    }

    fn finish(&self) -> u64 {
        self.0 ^ self.0 >> 29
    }
}

/// Two to the 64 over the golden ratio, odd.
const GOLDEN: u64 = 0x9E37_79B9_7F4A_7C15;

/// Numbers for what crowds gather around, each its own: two triangles of one number have it in
/// common for certain.
#[derive(Default)]
struct Names(HashMap<Name, u64, BuildHasherDefault<Mixer>>);

impl Names {
    fn of(&mut self, what: Name) -> u64 {
        let next = self.0.len() as u64;
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

    #[cfg(test)]
    pub fn points(&self) -> [[f32; 3]; 2] {
        self.points
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
        crowds(triangles)
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
