//! Lay: one rounded patch, its points and its triangles.

use glam::DVec3;

use super::Given;
use super::arc::Place;
use super::ends::{End, EndPoint, Rows};
use crate::ids::{Corner, Sector};
use crate::math::unit;
use crate::patches::{Middle, Parts};
use crate::strips::cut;
use crate::validity::faces_out;

/// Where a point of a rounded patch comes from: up to three points of the patch with one segment,
/// and how much of each.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parents {
    pub places: [u32; 3],
    pub weights: [f64; 3],
}

/// A point that a rounded patch has more than that with one segment.
#[derive(Clone, Copy)]
pub struct Added {
    pub parents: Parents,
    /// What tells it apart.
    pub sector: Sector,
    /// The end on whose curve it lies.
    pub end: Option<(End, EndPoint)>,
}

/// A rounded patch: first the points of the patch with one segment, then those that are added.
#[derive(Default)]
pub struct Lay {
    pub places: Vec<Place>,
    /// The normals of the first places as they come out: curves need unit ones, but those of the source
    /// may be longer or shorter.
    pub stored: Vec<DVec3>,
    pub added: Vec<Added>,
    pub triangles: Vec<[u32; 3]>,
}

impl Lay {
    pub fn clear(&mut self) {
        self.places.clear();
        self.stored.clear();
        self.added.clear();
        self.triangles.clear();
    }

    pub fn push(&mut self, place: Place, added: Added) -> u32 {
        self.places.push(place);
        self.added.push(added);
        self.places.len() as u32 - 1
    }

    /// The points of an end's curve, with the places of its two corners before and behind them.
    pub fn push_end(
        &mut self,
        given: &Given,
        rows: &Rows,
        end: End,
        [from, to]: [u32; 2],
    ) -> Vec<u32> {
        let (mut line, sector) = (vec![from], given.sector(end));
        for point in given.points(rows, end) {
            let [one, other] = point.shares;
            let parents = Parents { places: [from, to, from], weights: [one, other, 0.0] };
            line.push(self.push(point.place, Added { parents, sector, end: Some((end, point)) }));
        }
        line.push(to);
        line
    }

    /// Where a place is stored that is no joint; joints come first, then the middles of the patch.
    pub fn stored_at(&self, given: &Given, parts: Parts, place: usize) -> DVec3 {
        let point = self.places[place].point;
        match place.checked_sub(parts.joints.len() + parts.middles.len()) {
            Some(added) => given.placement.stored_by(self.added[added].sector, point),
            None => given.view.stored(point),
        }
    }

    /// Whether all triangles have area and face out.
    pub fn is_valid(&self, resolution: f64) -> bool {
        self.triangles.iter().all(|triangle| {
            let points = triangle.map(|place| self.places[place as usize].point);
            faces_out(points, triangle.map(|place| self.normal(place)), resolution)
        })
    }

    /// The normal of a place as it comes out.
    fn normal(&self, place: u32) -> DVec3 {
        let place = place as usize;
        self.stored.get(place).copied().unwrap_or(self.places[place].normal)
    }

    /// The points of the patch with one segment.
    pub fn begin(&mut self, given: &Given, parts: Parts, at: impl Fn(Corner) -> Place) {
        self.clear();
        self.stored.extend(parts.joints.iter().map(|&joint| given.placement.normal_at(joint)));
        self.places.extend(parts.joints.iter().map(|&joint| at(joint)));
        let middle = |middle: &Middle| Place { point: middle.position, normal: middle.normal };
        self.places.extend(parts.middles.iter().map(middle));
    }
}

/// Lays a strip between the curves at its ends; false where it has no more than one segment.
pub fn lay_strip(given: &Given, rows: &Rows, strip: Parts, ends: [End; 2], lay: &mut Lay) -> bool {
    let counts = ends.map(|end| if given.is_open(end) { given.rows_at(rows, end) } else { 0 });
    if counts[0].max(counts[1]) < 2 {
        return false;
    }
    lay.begin(given, strip, |corner| Place {
        point: given.placement.position_at(corner),
        normal: unit(given.placement.normal_at(corner)),
    });
    // Of an end that does not open, the one corner that the strip of one segment uses.
    let line = |lay: &mut Lay, k: usize, [from, to]: [u32; 2]| match counts[k] {
        0 => vec![[1, 0][k]],
        _ => lay.push_end(given, rows, ends[k], [from, to]),
    };
    let mut start = line(lay, 0, [2, 1]);
    start.reverse();
    let stop = line(lay, 1, [0, 3]);
    zip(lay, &start, &stop);
    true
}

/// Triangles between two lines that run from the first side to the second.
fn zip(lay: &mut Lay, start: &[u32], stop: &[u32]) {
    let counts = [start.len() - 1, stop.len() - 1];
    let (mut a, mut b) = (0, 0);
    while a < counts[0] || b < counts[1] {
        let (next_a, next_b) = ((a + 1) * counts[1], (b + 1) * counts[0]);
        let goes_on = [a < counts[0], b < counts[1]];
        if goes_on == [true; 2] && next_a == next_b {
            let corners = [stop[b], start[a], start[a + 1], stop[b + 1]];
            let points = corners.map(|place| lay.places[place as usize].point);
            let triangles = cut(points).triangles().iter();
            lay.triangles.extend(triangles.map(|triangle| triangle.map(|k| corners[k])));
            (a, b) = (a + 1, b + 1);
        } else if goes_on[0] && (!goes_on[1] || next_a < next_b) {
            lay.triangles.push([stop[b], start[a], start[a + 1]]);
            a += 1;
        } else {
            lay.triangles.push([stop[b], start[a], stop[b + 1]]);
            b += 1;
        }
    }
}

/// Where the joint of a fill stands.
pub fn joint(given: &Given, sector: Sector) -> Place {
    Place { point: given.placement.point[sector], normal: unit(given.placement.normals[sector][0]) }
}

#[cfg(test)]
mod tests {
    use super::*;

    // 2
    // | .       faces up, as two of its normals do; the third leans down, and is as long as comes out
    // 0---1
    #[test]
    fn a_triangle_faces_along_the_normals_that_come_out() {
        let down = DVec3::new(0.6, 0.0, -0.8);
        let corners = [(DVec3::ZERO, down), (DVec3::X, DVec3::Z), (DVec3::Y, DVec3::Z)];
        let places = corners.map(|(point, normal)| Place { point, normal }).to_vec();
        let of = |length: f64| {
            let (places, stored) = (places.clone(), vec![down * length]);
            Lay { places, stored, triangles: vec![[0, 1, 2]], ..Lay::default() }
        };
        assert!(of(1.0).is_valid(1e-6));
        assert!(!of(3.0).is_valid(1e-6));
    }

    // start 0 - 1 - 2 - 3 - 4     two rows on the left for each one on the right
    //       |  / \ /|  / \ /|
    // stop  5 - - - 6 - - - 7
    #[test]
    fn unlike_ends_are_joined_evenly() {
        let normal = DVec3::Z;
        let line = |count: u32, y: f64| {
            (0..count).map(move |k| DVec3::new(f64::from(k) / f64::from(count - 1), y, 0.0))
        };
        let points = line(5, 1.0).chain(line(3, 0.0));
        let places = points.map(|point| Place { point, normal }).collect();
        let mut lay = Lay { places, ..Lay::default() };
        zip(&mut lay, &[0, 1, 2, 3, 4], &[5, 6, 7]);
        assert_eq!(lay.triangles.len(), 6);
        let x = |place: u32| lay.places[place as usize].point.x;
        let sides = lay.triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
        // From one end to the other nothing leans by more than a row.
        for [one, other] in sides.filter(|side| (side[0] < 5) != (side[1] < 5)) {
            assert!((x(one) - x(other)).abs() <= 0.25, "{:?}", lay.triangles);
        }
    }
}
