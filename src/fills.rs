//! Fills: what closes the hole where three or more chamfered edges met (thesis 6.6).
//!
//! The strips that end around a cluster leave a loop of their ends, one point for each sector.
//! Three points are a triangle, four are two; five or more get a new vertex in the middle
//! (thesis). Where that folds, the loop is triangulated for the least fold instead (after
//! P. Liepa, "Filling Holes in Meshes", 2003).

use std::cmp::Ordering;

use glam::DVec3;
use smallvec::{SmallVec, smallvec};

use crate::ids::{Few, Sector};
use crate::math::unit;
use crate::placement::Placement;
use crate::validity::{faces_out, facing};

/// From so many points on, a loop gets a vertex in its middle.
pub const MIDDLE_FROM: usize = 5;

/// The triangulation takes cubic time; a longer loop must do with a vertex in its middle.
const LONGEST_TRIANGULATED: usize = 24;

/// So few points are compared with each other faster than sorted.
const FEW_POINTS: usize = 8;

/// The triangles that close the hole at one ring.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Fill {
    /// Places in the ring; a place past the ring's length is one of the middles.
    pub triangles: Few<[usize; 3]>,
    /// New vertices: each is the mean of the points at these places of the ring.
    pub middles: Vec<Few<usize>>,
}

/// Fills the hole between the points of a ring, or says that every way of doing so folds.
pub fn fill(points: &[DVec3], normals: &[DVec3], resolution: f64) -> Option<Fill> {
    let mut fill = Fill::default();
    if points.len() < 3 || points.len() == 3 && !are_distinct(points) {
        return Some(fill);
    }
    if let (&[a, b, c], &[at_a, at_b, at_c]) = (points, normals) {
        facing([a, b, c], [at_a, at_b, at_c], resolution)?;
        fill.triangles.push([0, 1, 2]);
        return Some(fill);
    }
    for hole in holes(points) {
        let lay = Loop { places: hole, points, normals, resolution };
        if lay.places.len() < MIDDLE_FROM {
            fill.triangles.extend(lay.triangulated()?);
        } else if lay.has_valid_middle() {
            let middle = points.len() + fill.middles.len();
            fill.triangles.extend(lay.sides().map(|[from, to]| [from, to, middle]));
            fill.middles.push(lay.places);
        } else {
            fill.triangles.extend(lay.triangulated()?);
        }
    }
    Some(fill)
}

/// The fill of a ring where its sectors stand now; none if every way to fill it folds.
pub fn ring_fill(placement: &Placement, sectors: &[Sector], resolution: f64) -> Option<Fill> {
    if sectors.len() < 3 {
        return Some(Fill::default());
    }
    let points: Few<_> = sectors.iter().map(|&sector| placement.point[sector]).collect();
    let normals: Few<_> = sectors.iter().map(|&sector| placement.normals[sector][0]).collect();
    fill(&points, &normals, resolution)
}

/// As [`fill`], for most holes by far, and without the triangles.
pub fn can_fill(points: [DVec3; 3], normals: [DVec3; 3], resolution: f64) -> bool {
    // Where two stand at one point there is no hole.
    !is_open(points) || faces_out(points, normals, resolution)
}

/// Whether three points have a hole between them.
pub fn is_open([a, b, c]: [DVec3; 3]) -> bool {
    a != b && a != c && b != c
}

/// The mean of some points of a ring: where its middle vertex stands.
pub fn middle(points: &[DVec3], places: &[usize]) -> DVec3 {
    places.iter().map(|&place| points[place]).sum::<DVec3>() / places.len() as f64
}

/// The loops of distinct points in a ring. Sectors that do not move stand at one point: there the
/// ring touches itself, and each part of it is a hole of its own.
fn holes(points: &[DVec3]) -> SmallVec<[Few<usize>; 1]> {
    if are_distinct(points) {
        return smallvec![(0..points.len()).collect()];
    }
    let names = names(points);
    // By name: where the path stands there.
    let mut stands: Few<Option<usize>> = smallvec![None; points.len()];
    let mut holes = SmallVec::new();
    let mut path: Few<usize> = Few::new();
    for place in 0..points.len() {
        if let Some(met) = stands[names[place]] {
            let hole: Few<usize> = path.drain(met..).collect();
            hole.iter().for_each(|&left| stands[names[left]] = None);
            if hole.len() >= 3 {
                holes.push(hole);
            }
        }
        stands[names[place]] = Some(path.len());
        path.push(place);
    }
    if path.len() >= 3 {
        holes.push(path);
    }
    holes
}

/// `#points`: a place that stands for all at that position.
pub fn names(points: &[DVec3]) -> Few<usize> {
    if points.len() <= FEW_POINTS {
        let first = |place: usize| points.iter().position(|point| *point == points[place]);
        return (0..points.len()).map(|place| first(place).unwrap_or(place)).collect();
    }
    let mut sorted: Vec<usize> = (0..points.len()).collect();
    sorted.sort_unstable_by_key(|&place| (bits(points[place]), place));
    let mut names: Few<usize> = (0..points.len()).collect();
    for pair in sorted.windows(2) {
        if points[pair[0]] == points[pair[1]] {
            names[pair[1]] = names[pair[0]];
        }
    }
    names
}

/// The same for -0 and 0.
fn bits(point: DVec3) -> [u64; 3] {
    point.to_array().map(|along| (along + 0.0).to_bits())
}

fn are_distinct(points: &[DVec3]) -> bool {
    if points.len() <= FEW_POINTS {
        let mut pairs = (1..points.len()).flat_map(|k| points[..k].iter().map(move |p| (p, k)));
        return pairs.all(|(point, k)| *point != points[k]);
    }
    let mut sorted: Vec<[u64; 3]> = points.iter().copied().map(bits).collect();
    sorted.sort_unstable();
    sorted.windows(2).all(|pair| pair[0] != pair[1])
}

/// One hole: places in a ring of points, counter-clockwise seen from outside.
struct Loop<'a> {
    places: Few<usize>,
    points: &'a [DVec3],
    normals: &'a [DVec3],
    resolution: f64,
}

/// How badly a set of triangles folds: the worst triangle first, then all of them.
#[derive(Clone, Copy, PartialEq, PartialOrd)]
struct Fold {
    worst: f64,
    sum: f64,
}

impl Loop<'_> {
    fn sides(&self) -> impl Iterator<Item = [usize; 2]> + '_ {
        let count = self.places.len();
        (0..count).map(move |k| [self.places[k], self.places[(k + 1) % count]])
    }

    fn has_valid_middle(&self) -> bool {
        let middle = middle(self.points, &self.places);
        let normal = unit(self.places.iter().map(|&place| self.normals[place]).sum());
        // Where all sides face each other, a vertex between them faces nowhere.
        normal != DVec3::ZERO
            && self.sides().all(|[from, to]| {
                let points = [self.points[from], self.points[to], middle];
                let normals = [self.normals[from], self.normals[to], normal];
                faces_out(points, normals, self.resolution)
            })
    }

    /// How far the triangle over three places in the loop turns away from its normals.
    fn fold(&self, corners: [usize; 3]) -> Option<f64> {
        let places = corners.map(|corner| self.places[corner]);
        let points = places.map(|place| self.points[place]);
        let normals = places.map(|place| self.normals[place]);
        facing(points, normals, self.resolution).map(|cosine| 1.0 - cosine)
    }

    /// The triangulation that folds least; none if every one has a triangle that may not be.
    fn triangulated(&self) -> Option<Few<[usize; 3]>> {
        let count = self.places.len();
        if count == 3 {
            let places = [0, 1, 2].map(|corner| self.places[corner]);
            let points = places.map(|place| self.points[place]);
            let normals = places.map(|place| self.normals[place]);
            return faces_out(points, normals, self.resolution).then(|| smallvec![places]);
        }
        if count > LONGEST_TRIANGULATED {
            return None;
        }
        let flat = Some((Fold { worst: 0.0, sum: 0.0 }, 0));
        let mut best: SmallVec<[_; 16]> = smallvec![flat; count * count];
        for length in 2..count {
            for from in 0..count - length {
                best[from * count + from + length] = self.best_apex(&best, from, from + length);
            }
        }
        best[count - 1]?;
        let mut triangles = Few::new();
        self.collect(&best, 0, count - 1, &mut triangles);
        Some(triangles)
    }

    /// The best triangle on the side from-to of the part of the loop between them.
    fn best_apex(
        &self,
        best: &[Option<(Fold, usize)>],
        from: usize,
        to: usize,
    ) -> Option<(Fold, usize)> {
        let count = self.places.len();
        let candidate = |apex: usize| {
            let own = self.fold([from, apex, to])?;
            let (left, right) = (best[from * count + apex]?.0, best[apex * count + to]?.0);
            let worst = own.max(left.worst).max(right.worst);
            Some((Fold { worst, sum: own + left.sum + right.sum }, apex))
        };
        let order = |one: &(Fold, usize), other: &(Fold, usize)| {
            one.0.partial_cmp(&other.0).unwrap_or(Ordering::Equal)
        };
        (from + 1..to).filter_map(candidate).min_by(order)
    }

    fn collect(
        &self,
        best: &[Option<(Fold, usize)>],
        from: usize,
        to: usize,
        triangles: &mut Few<[usize; 3]>,
    ) {
        if to - from < 2 {
            return;
        }
        if let Some((_, apex)) = best[from * self.places.len() + to] {
            triangles.push([from, apex, to].map(|corner| self.places[corner]));
            self.collect(best, from, apex, triangles);
            self.collect(best, apex, to, triangles);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const HEIGHT: f64 = 1e-6;

    /// Points of a polygon in the plane z = 0, all normals up.
    fn flat(points: &[[f64; 2]]) -> Option<Fill> {
        let points: Vec<DVec3> = points.iter().map(|p| DVec3::new(p[0], p[1], 0.0)).collect();
        fill(&points, &vec![DVec3::Z; points.len()], HEIGHT)
    }

    #[test]
    fn two_points_need_nothing_and_three_a_triangle() {
        assert_eq!(flat(&[[0.0, 0.0], [1.0, 0.0]]), Some(Fill::default()));
        let triangle = flat(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]).unwrap();
        assert_eq!(triangle.triangles[..], [[0, 1, 2]]);
        assert_eq!(flat(&[[0.0, 0.0], [0.0, 1.0], [1.0, 0.0]]), None, "it would face inwards");
    }

    // 3---2
    //  \   \
    //   \ 1 |      a dent at 1: only the diagonal from it works
    //    \ /
    //     0
    #[test]
    fn a_dented_quad_is_cut_at_its_dent() {
        let dented = flat(&[[0.0, 0.0], [3.0, 3.0], [0.0, 1.0], [-3.0, 3.0]]).unwrap();
        assert_eq!(dented.triangles.len(), 2);
        assert!(dented.triangles.iter().all(|triangle| triangle.contains(&2)));
    }

    #[test]
    fn five_points_get_a_middle() {
        let pentagon = [[1.0, 0.0], [0.3, 0.95], [-0.8, 0.6], [-0.8, -0.6], [0.3, -0.95]];
        let filled = flat(&pentagon).unwrap();
        assert_eq!(filled.triangles.len(), 5);
        assert_eq!(filled.middles[0][..], [0, 1, 2, 3, 4]);
    }

    #[test]
    fn a_loop_whose_middle_folds_is_triangulated() {
        // An L: its mean lies outside of it.
        let l = [[0.0, 0.0], [9.0, 0.0], [9.0, 1.0], [1.0, 1.0], [1.0, 9.0], [0.0, 9.0]];
        let filled = flat(&l).unwrap();
        assert!(filled.middles.is_empty());
        assert_eq!(filled.triangles.len(), 4);
    }

    /// On a steep saddle all sides face outwards, each another way, and a vertex in the middle would
    /// face nowhere.
    #[test]
    fn normals_that_cancel_out_give_no_middle() {
        let steep = |[x, y]: [f64; 2]| DVec3::new(x, y, x * x - y * y);
        let octagon = [[1.0, 0.0], [0.7, 0.7], [0.0, 1.0], [-0.7, 0.7]];
        let outwards = [[-1.0, 0.0], [-0.7, 0.7], [0.0, 1.0], [0.7, 0.7]];
        let half = |sign: f64| octagon.map(|point| steep(point.map(|along| sign * along)));
        let normals = |sign: f64| outwards.map(|[x, y]| DVec3::new(sign * x, sign * y, 0.0));
        let filled = fill(
            &[half(1.0), half(-1.0)].concat(),
            &[normals(1.0), normals(-1.0)].concat(),
            HEIGHT,
        );
        assert!(filled.is_none_or(|fill| fill.middles.is_empty()));
    }

    #[test]
    fn a_long_ring_that_is_pinched_has_as_many_holes() {
        // Ten triangles around one point.
        let points = |k: usize| {
            let (sin, cos) = (f64::from(k as u32 / 3) * 0.6).sin_cos();
            match k % 3 {
                0 => [0.0; 2],
                1 => [cos, sin],
                _ => [cos - 0.3 * sin, sin + 0.3 * cos],
            }
        };
        let fan = flat(&(0..30).map(points).collect::<Vec<_>>()).unwrap();
        let mut triangles = fan.triangles.to_vec();
        triangles.iter_mut().for_each(|triangle| triangle.sort_unstable());
        assert_eq!(triangles, (0..10).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]).collect::<Vec<_>>());
    }

    #[test]
    fn sectors_that_stay_pinch_the_ring() {
        // 1 and 3 stand at one point: two slivers of two points each, and nothing to fill.
        let pinched = flat(&[[1.0, 0.0], [0.0, 0.0], [-1.0, 0.0], [0.0, 0.0]]);
        assert_eq!(pinched, Some(Fill::default()));
        let both =
            flat(&[[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 0.0], [-2.0, 0.0], [-2.0, -1.0]]);
        assert_eq!(both.unwrap().triangles.len(), 2);
    }
}
