//! Rounded fills: a grid over each triangle of the fill with one segment.
//!
//! The sides of a grid are the curves of the ring's ends, or arcs between two points of the fill.
//! A point inside lies on three arcs, each from a corner of the triangle to the side across (the
//! side-vertex method: G. M. Nielson, *The Side-Vertex Method for Interpolation in Triangles*, 1979):
//! on a sphere these are great circles, which meet there.

use std::collections::BTreeMap;

use glam::DVec3;

use super::Given;
use super::arc::{Arc, Place, sharpness};
use super::ends::{End, Rows, ends_of};
use super::lay::{Added, Lay, Parents, joint};
use crate::fills::names;
use crate::ids::{Few, Ring, Sector};
use crate::math::unit;
use crate::patches::Parts;

/// Two places of a fill.
type Pair = [u32; 2];

/// A fill in the making.
struct FillLay<'a> {
    given: &'a Given<'a>,
    rows: &'a Rows,
    fill: Parts<'a>,
    /// The first of the ring.
    sector: Sector,
    /// `#joints`: the first place of the ring at the same position.
    names: Few<usize>,
    /// By the names of both places: the ends of the ring.
    ends: BTreeMap<Pair, End>,
    /// How many triangles have a side, be it in this direction or the other.
    uses: BTreeMap<Pair, u32>,
    /// The points between two inner places, from the lower one.
    inner: BTreeMap<Pair, Vec<u32>>,
    /// How many segments each grid has.
    count: usize,
}

/// The ends of a ring that no triangle of its fill has for a side, or that several would: their
/// strips close the ring among each other, as long as they are straight.
pub fn loose_ends(given: &Given, ring: Ring, fill: Parts) -> Few<End> {
    let names = names_of(given, ring);
    let sides = || fill.triangles.iter().flat_map(|&t| sides_of(t));
    let joints = names.len() as u32;
    let mut named: Vec<Pair> = sides()
        .filter(|side| side.iter().all(|&place| place < joints))
        .map(|side| side.map(|place| names[place as usize] as u32))
        .collect();
    named.sort_unstable();
    let open = || ends_of(given, ring).filter(|(_, end)| given.is_open(*end));
    let name = |place: usize| pair_at(&names, place);
    let mut all: Vec<Pair> = open().map(|(place, _)| name(place)).collect();
    all.sort_unstable();
    let once = |list: &[Pair], pair: &Pair| {
        let first = list.partition_point(|other| other < pair);
        list.get(first) == Some(pair) && list.get(first + 1) != Some(pair)
    };
    let is_loose = |place: usize| !once(&named, &name(place)) || !once(&all, &name(place));
    open().filter(|&(place, _)| is_loose(place)).map(|(_, end)| end).collect()
}

/// Lays a fill; false where none of its ends has more than one segment.
pub fn lay_fill(given: &Given, rows: &Rows, (ring, fill): (Ring, Parts), lay: &mut Lay) -> bool {
    let open = || ends_of(given, ring).filter(|(_, end)| given.is_open(*end));
    let count = open().map(|(_, end)| given.rows_at(rows, end)).max().unwrap_or(1);
    if count < 2 {
        return false;
    }
    lay.begin(given, fill, |_| Place { point: DVec3::ZERO, normal: DVec3::ZERO });
    let members = given.chamfers.sectors.ring(ring);
    for (place, &sector) in lay.places.iter_mut().zip(members) {
        *place = joint(given, sector);
    }
    let names = names_of(given, ring);
    let ends = open().map(|(place, end)| (pair_at(&names, place), end)).collect();
    let mut uses = BTreeMap::new();
    for side in fill.triangles.iter().flat_map(|&t| sides_of(t)) {
        *uses.entry(sorted(side)).or_insert(0) += 1;
    }
    let inner = BTreeMap::new();
    let mut making =
        FillLay { given, rows, fill, sector: members[0], names, ends, uses, inner, count };
    let base = given.placement.base(members[0]);
    making.lift_middles(lay, base);
    for &triangle in fill.triangles {
        making.lay_triangle(triangle, lay);
    }
    true
}

fn names_of(given: &Given, ring: Ring) -> Few<usize> {
    let members = given.chamfers.sectors.ring(ring).iter();
    let points: Few<DVec3> = members.map(|&sector| given.placement.point[sector]).collect();
    names(&points)
}

/// The names of a place of a ring and of the next one.
fn pair_at(names: &[usize], place: usize) -> Pair {
    [names[place] as u32, names[(place + 1) % names.len()] as u32]
}

fn sides_of([a, b, c]: [u32; 3]) -> [Pair; 3] {
    [[a, b], [b, c], [c, a]]
}

fn sorted([one, other]: Pair) -> Pair {
    [one.min(other), one.max(other)]
}

/// One side of a grid.
struct Side {
    arc: Arc,
    /// From its first corner to its second.
    line: Vec<u32>,
}

impl FillLay<'_> {
    /// Raises the points in the middle onto the round surface: each as high as arcs from there to
    /// the points around, which are circles there, have it in the mean, and no higher than the old
    /// corner.
    fn lift_middles(&self, lay: &mut Lay, base: DVec3) {
        let joints = self.fill.joints.len() as u32;
        for middle in joints..joints + self.fill.middles.len() as u32 {
            let Place { point, normal } = lay.places[middle as usize];
            let around = self.fill.triangles.iter().filter(|t| t.contains(&middle));
            let rises = around.map(|triangle| {
                let first = lay.places[triangle[0] as usize];
                let leaning = first.normal + normal;
                (first.point - point).dot(leaning) / normal.dot(leaning)
            });
            let rises: Few<f64> = rises.filter(|rise| rise.is_finite()).collect();
            let most = (base - point).dot(normal);
            let rise = rises.iter().sum::<f64>() / rises.len().max(1) as f64;
            let rise = if most > 0.0 { rise.clamp(0.0, most) } else { rise.clamp(most, 0.0) };
            let round = point + normal * rise;
            let lifted = match self.given.profile {
                flat if flat <= 0.5 => point.lerp(round, 2.0 * flat),
                sharp => round.lerp(base, sharpness(sharp)),
            };
            lay.places[middle as usize] =
                self.given.stored(self.sector, Place { point: lifted, normal });
        }
    }

    fn lay_triangle(&mut self, triangle: [u32; 3], lay: &mut Lay) {
        let sides = sides_of(triangle).map(|side| self.side(side, lay));
        let arcs = sides.each_ref().map(|side| side.arc);
        let count = self.count;
        let mut grid = vec![0; (count + 1) * (count + 2) / 2];
        for (to_q, to_r) in grid_points(count) {
            let weights = [count - to_q - to_r, to_q, to_r];
            grid[place_in_grid(count, to_q, to_r)] = match weights {
                [_, along, 0] => on_side(&sides[0], along, count),
                [0, _, along] => on_side(&sides[1], along, count),
                [along, 0, _] => on_side(&sides[2], along, count),
                _ => {
                    let weights = weights.map(|weight| weight as f64 / count as f64);
                    let corners = triangle.map(|place| lay.places[place as usize]);
                    let place =
                        self.given.stored(self.sector, self.inside(&arcs, corners, weights));
                    let parents = Parents { places: triangle, weights };
                    lay.push(place, Added { parents, sector: self.sector, end: None })
                }
            };
        }
        add_grid(&grid, count, &mut lay.triangles);
    }

    fn side(&mut self, side: Pair, lay: &mut Lay) -> Side {
        let joints = self.fill.joints.len() as u32;
        let corners = side.map(|place| lay.places[place as usize]);
        if side.iter().all(|&place| place < joints) {
            let named = side.map(|place| self.names[place as usize] as u32);
            if let Some(&end) = self.ends.get(&named) {
                let rows = self.given.rows_at(self.rows, end);
                let line = lay.push_end(self.given, self.rows, end, side);
                return Side { arc: self.given.arc(end, rows), line };
            }
        }
        if self.uses[&sorted(side)] < 2 {
            let [from, to] = corners;
            return Side { arc: Arc::straight(from, to), line: side.to_vec() };
        }
        self.inner_side(side, lay)
    }

    /// A side between two triangles of the fill: the first of them makes its points.
    fn inner_side(&mut self, side: Pair, lay: &mut Lay) -> Side {
        let pair = sorted(side);
        let [from, to] = pair.map(|place| lay.places[place as usize]);
        let arc = Arc::between(from, to, self.given.profile);
        let count = self.count;
        let points = self.inner.entry(pair).or_insert_with(|| {
            let step = |step: usize| {
                let share = step as f64 / count as f64;
                let parents = Parents {
                    places: [pair[0], pair[1], pair[0]],
                    weights: [1.0 - share, share, 0.0],
                };
                let added = Added { parents, sector: self.sector, end: None };
                lay.push(self.given.stored(self.sector, arc.at(share)), added)
            };
            (1..count).map(step).collect()
        });
        let mut line = vec![pair[0]];
        line.extend(points.iter());
        line.push(pair[1]);
        if side == pair {
            return Side { arc, line };
        }
        line.reverse();
        Side { arc: arc.reversed(), line }
    }

    /// A point inside: the mean of those on the arcs from each corner to the side across, where
    /// that of a side counts alone at this side.
    fn inside(&self, sides: &[Arc; 3], corners: [Place; 3], weights: [f64; 3]) -> Place {
        let (mut point, mut normal, mut sum) = (DVec3::ZERO, DVec3::ZERO, 0.0);
        for corner in 0..3 {
            let [own, next, last] = [0, 1, 2].map(|k| weights[(corner + k) % 3]);
            let across = sides[(corner + 1) % 3].at(last / (next + last));
            let arc = Arc::between(corners[corner], across, self.given.profile);
            let (at, counts) = (arc.at(1.0 - own), next * last);
            point += at.point * counts;
            normal += at.normal * counts;
            sum += counts;
        }
        Place { point: point / sum, normal: unit(normal) }
    }
}

/// All points of a grid, by how far they are towards its second and its third corner.
fn grid_points(count: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..=count).flat_map(move |to_r| (0..=count - to_r).map(move |to_q| (to_q, to_r)))
}

fn place_in_grid(count: usize, to_q: usize, to_r: usize) -> usize {
    to_r * (count + 1) - to_r * to_r.saturating_sub(1) / 2 + to_q
}

/// The point of a side that is nearest to a step of the grid: a side may have fewer.
fn on_side(side: &Side, step: usize, count: usize) -> u32 {
    let rows = side.line.len() - 1;
    side.line[(2 * step * rows + count) / (2 * count)]
}

/// The triangles of a grid, but for those that a side with fewer points has closed.
fn add_grid(grid: &[u32], count: usize, triangles: &mut Vec<[u32; 3]>) {
    let at = |to_q: usize, to_r: usize| grid[place_in_grid(count, to_q, to_r)];
    let mut add = |triangle: [u32; 3]| {
        let [a, b, c] = triangle;
        if a != b && b != c && c != a {
            triangles.push(triangle);
        }
    };
    for to_r in 0..count {
        for to_q in 0..count - to_r {
            let (ahead, beside) = (at(to_q + 1, to_r), at(to_q, to_r + 1));
            add([at(to_q, to_r), ahead, beside]);
            if to_q + to_r + 2 <= count {
                add([ahead, at(to_q + 1, to_r + 1), beside]);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    // r        a grid of two segments: 0 1 2 along p-q, then 3 4, then 5 at r
    // 3 4
    // p 1 q
    #[test]
    fn a_grid_has_the_square_of_its_segments_in_triangles() {
        let mut triangles = Vec::new();
        add_grid(&[0, 1, 2, 3, 4, 5], 2, &mut triangles);
        assert_eq!(triangles, [[0, 1, 3], [1, 4, 3], [1, 2, 4], [3, 4, 5]]);
        for count in 2..6 {
            let places: Vec<u32> = (0..(count + 1) * (count + 2) / 2).map(|k| k as u32).collect();
            let mut triangles = Vec::new();
            add_grid(&places, count, &mut triangles);
            assert_eq!(triangles.len(), count * count);
            let order = grid_points(count).map(|(q, r)| place_in_grid(count, q, r) as u32);
            assert!(order.eq(places), "each has a place of its own");
        }
    }

    #[test]
    fn a_side_with_fewer_points_closes_triangles() {
        let mut triangles = Vec::new();
        add_grid(&[0, 2, 2, 3, 4, 5], 2, &mut triangles);
        assert_eq!(triangles, [[0, 2, 3], [2, 4, 3], [3, 4, 5]]);
    }
    // 0 - - 1 - - 2    the side, and below it the steps of the grid
    // 0  1  2  3  4
    #[test]
    fn a_step_takes_the_nearest_point_of_a_side_with_fewer() {
        let place = Place { point: DVec3::ZERO, normal: DVec3::ZERO };
        let side = |line| Side { arc: Arc::straight(place, place), line };
        let taken = |side: &Side, count: usize| -> Vec<u32> {
            (0..=count).map(|step| on_side(side, step, count)).collect()
        };
        assert_eq!(taken(&side(vec![0, 1, 2]), 4), [0, 1, 1, 2, 2]);
        assert_eq!(taken(&side(vec![0, 1]), 4), [0, 0, 1, 1, 1]);
        assert_eq!(taken(&side(vec![0, 1, 2, 3, 4]), 4), [0, 1, 2, 3, 4]);
    }
}
