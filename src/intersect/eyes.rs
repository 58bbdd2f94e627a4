//! Eyes: where all of a part is looked at from, if boxes alone tell too little apart.
//!
//! Spikes, cones and gears are made of long narrow triangles whose boxes overlap by the hundred. But
//! they stand around something, and seen from there they lie in different directions: from the middle
//! of the part, from a corner or an edge where many of them meet, or from the axis through two of
//! these. What has a point in common has a direction in common, whatever it is seen from. So which
//! eyes are taken decides nothing but time.
//!
//! A quick look at two triangles, in double precision: most pairs whose boxes overlap are apart by
//! far more than rounding, and need no exact predicate.

use std::hash::Hash;

use glam::DVec3;
use smallvec::SmallVec;

use super::Triangle;
use super::crowds::{Around, CROWD, Counts, place, side};
use crate::bvh::Aabb;
use crate::error::Error;
use crate::watch::{Watch, sort, stretches};

/// The tip of a cone, the middle of its floor, and the middle of the fill that its tip becomes.
const MOST: usize = 3;

/// What a part is seen from.
pub struct Eyes(SmallVec<[Around; 8]>);

impl Eyes {
    /// Around what the triangles of a part meet at, before or after they are pulled apart.
    ///
    /// # Errors
    /// [`Error::Cancelled`] where the watch stops it.
    pub fn of(triangles: &[Triangle], watch: &dyn Watch) -> Result<Eyes, Error> {
        let middle = mean(triangles, watch)?;
        let mut eyes = Eyes(SmallVec::new());
        eyes.0.push(Around::point(middle));
        let crowded = crowded_places(triangles, watch)?;
        for (number, &at) in crowded.iter().enumerate() {
            eyes.0.push(Around::point(at));
            eyes.0.extend(axis([at, if number == 0 { middle } else { crowded[0] }]));
        }
        eyes.0.extend(crowded_side(triangles, watch)?.and_then(axis));
        Ok(eyes)
    }

    /// For each eye, a box around the directions of each triangle.
    ///
    /// # Errors
    /// [`Error::Cancelled`] where the watch stops it.
    pub fn views(
        &self,
        triangles: &[Triangle],
        watch: &dyn Watch,
    ) -> Result<Vec<Vec<Aabb>>, Error> {
        let seen = |eye: &Around, triangle| watch.worked(1).map(|()| eye.seen(triangle));
        let view = |eye| triangles.iter().map(|triangle| seen(eye, triangle)).collect();
        self.0.iter().map(view).collect()
    }
}

fn axis(ends: [[f32; 3]; 2]) -> Option<Around> {
    (ends[0] != ends[1]).then(|| Around::line(ends))
}

fn mean(triangles: &[Triangle], watch: &dyn Watch) -> Result<[f32; 3], Error> {
    let (points, mut sum) = (triangles.as_flattened(), DVec3::ZERO);
    for stretch in stretches(points.len(), watch) {
        points[stretch?].iter().for_each(|&point| sum += wide(point));
    }
    Ok((sum / points.len().max(1) as f64).as_vec3().to_array())
}

/// The positions at which the most corners are, if they are many.
fn crowded_places(
    triangles: &[Triangle],
    watch: &dyn Watch,
) -> Result<SmallVec<[[f32; 3]; MOST]>, Error> {
    let places = triangles.as_flattened().iter().map(|&point| place(point));
    let most = most_common(&mut crowded(places, watch)?, watch)?;
    Ok(most.iter().map(|place| place.map(f32::from_bits)).collect())
}

/// The ends of the edge on which the most sides lie, if they are many.
fn crowded_side(triangles: &[Triangle], watch: &dyn Watch) -> Result<Option<[[f32; 3]; 2]>, Error> {
    let sides = |triangle| (0..3).map(move |k| side(triangle, k));
    let most = most_common(&mut crowded(triangles.iter().flat_map(sides), watch)?, watch)?;
    Ok(most.first().map(|ends| ends.map(|place| place.map(f32::from_bits))))
}

/// All that may come as often as in a crowd: sorting these takes a fraction of what sorting all does.
fn crowded<T: Hash>(
    all: impl Iterator<Item = T> + Clone,
    watch: &dyn Watch,
) -> Result<Vec<T>, Error> {
    let mut asked = Ok(());
    let counted = all.clone().map_while(|each| {
        asked = watch.worked(1);
        asked.is_ok().then_some(each)
    });
    let counts = Counts::new(all.clone().count(), counted);
    asked?;
    let many = all.map(|each| watch.worked(1).map(|()| counts.are_many(&each).then_some(each)));
    many.filter_map(Result::transpose).collect()
}

/// Those that come most often, if that is as often as in a crowd; of equals the least.
fn most_common<T: Ord + Copy>(
    all: &mut [T],
    watch: &dyn Watch,
) -> Result<SmallVec<[T; MOST]>, Error> {
    sort(all, watch)?;
    let groups = all.chunk_by(|one, other| one == other);
    let mut most: SmallVec<[&[T]; MOST + 1]> = SmallVec::new();
    for group in groups.filter(|group| group.len() >= usize::from(CROWD)) {
        let at = most.partition_point(|other| other.len() >= group.len());
        most.insert(at, group);
        most.truncate(MOST);
    }
    Ok(most.iter().map(|group| group[0]).collect())
}

/// Far more than what is lost in the products below, relative to their largest terms.
const ROUNDING: f64 = 1e-13;

/// Whether a plane for certain keeps two triangles apart that have no corner in common.
pub fn are_apart(a: &Triangle, b: &Triangle) -> bool {
    let [a, b] = [a, b].map(|triangle| triangle.map(wide));
    Face::new(a).keeps_off(&b) || Face::new(b).keeps_off(&a)
}

/// The same for two triangles that have a corner in common, which comes first in both: the plane
/// leads through it, and all else is on its two sides.
pub fn are_apart_but_for_corner(a: &Triangle, b: &Triangle) -> bool {
    let [a, b] = [a, b].map(|triangle| triangle.map(wide));
    Face::new(a).keeps_off_beside_corner([b[1], b[2]])
        || Face::new(b).keeps_off_beside_corner([a[1], a[2]])
}

fn wide(point: [f32; 3]) -> DVec3 {
    DVec3::from(point.map(f64::from))
}

/// A triangle with the plane it lies in.
struct Face {
    corners: [DVec3; 3],
    normal: DVec3,
    /// How large the products that make up the normal can be.
    size: f64,
}

impl Face {
    fn new(corners: [DVec3; 3]) -> Face {
        let [one, other] = [corners[1] - corners[0], corners[2] - corners[0]];
        let size = largest(one) * largest(other);
        Face { corners, normal: one.cross(other), size }
    }

    /// Whether all points are on one side of the triangle's plane, or beyond one of its sides.
    fn keeps_off(&self, points: &[DVec3; 3]) -> bool {
        let side = |point: DVec3| self.above(point - self.corners[0]);
        let sides = points.map(side);
        if sides == [1; 3] || sides == [-1; 3] {
            return true;
        }
        (0..3).any(|k| {
            let from = self.corners[k];
            let along = self.corners[(k + 1) % 3] - from;
            points.iter().all(|&point| self.is_beyond(along, point - from))
        })
    }

    /// As [`Face::keeps_off`], for a triangle with the same first corner as this one.
    fn keeps_off_beside_corner(&self, others: [DVec3; 2]) -> bool {
        let ways = others.map(|point| point - self.corners[0]);
        let sides = ways.map(|way| self.above(way));
        let along = [self.corners[1] - self.corners[0], self.corners[0] - self.corners[2]];
        sides == [1; 2]
            || sides == [-1; 2]
            || along.into_iter().any(|along| ways.iter().all(|&way| self.is_beyond(along, way)))
    }

    /// 1 if a way from the plane leads up for certain, -1 if down.
    fn above(&self, way: DVec3) -> i8 {
        let height = self.normal.dot(way);
        let rounding = ROUNDING * self.size * largest(way);
        i8::from(height > rounding) - i8::from(height < -rounding)
    }

    /// Whether a way from a side of the triangle for certain leads away from the triangle.
    fn is_beyond(&self, along: DVec3, way: DVec3) -> bool {
        let inside = self.normal.cross(along).dot(way);
        inside < -ROUNDING * self.size * largest(along) * largest(way)
    }
}

fn largest(vector: DVec3) -> f64 {
    vector.abs().max_element()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::intersect::cut_each_other;
    use crate::watch::Unwatched;

    /// A cone over a star of so many points.
    fn cone(points: u32) -> Vec<Triangle> {
        let rim = |step: u32| {
            let turns = f64::from(step) / f64::from(2 * points) * std::f64::consts::TAU;
            let radius = if step.is_multiple_of(2) { 1.0 } else { 0.4 };
            [(radius * turns.cos()) as f32, 0.0, (radius * turns.sin()) as f32]
        };
        (0..2 * points).map(|step| [[0.0, 1.0, 0.0], rim(step), rim(step + 1)]).collect()
    }

    /// The most steps at a time.
    struct Longest(std::cell::Cell<usize>);

    impl Watch for Longest {
        fn worked(&self, steps: usize) -> Result<(), Error> {
            self.0.set(self.0.get().max(steps));
            Ok(())
        }
    }

    #[test]
    fn where_triangles_crowd_is_told_step_by_step() {
        let apart = |k: u32| [[k as f32, 0.0, 0.0], [k as f32, 1.0, 0.0], [k as f32, 0.0, 1.0]];
        let triangles: Vec<Triangle> = (0..20_000).map(apart).collect();
        let longest = Longest(0.into());
        assert!(Eyes::of(&triangles, &longest).is_ok());
        assert!((1..1000).contains(&longest.0.get()), "{} at a time", longest.0.get());
    }

    fn eyes(triangles: &[Triangle]) -> SmallVec<[Around; 8]> {
        Eyes::of(triangles, &Unwatched).unwrap().0
    }

    #[test]
    fn a_cone_is_seen_from_its_middle_its_tip_and_its_axis() {
        let middle = [0.0, 1.0 / 3.0, 0.0];
        let eyes = eyes(&cone(40));
        assert_eq!(eyes.len(), 3);
        let near =
            |one: [f32; 3], other: [f32; 3]| (0..3).all(|k| (one[k] - other[k]).abs() < 1e-6);
        assert!(near(eyes[0].points()[0], middle));
        assert_eq!(eyes[1], Around::point([0.0, 1.0, 0.0]));
        assert!(near(eyes[2].points()[1], middle) && eyes[2].points()[0] == [0.0, 1.0, 0.0]);
    }

    #[test]
    fn without_a_crowd_there_is_the_middle() {
        assert_eq!(eyes(&cone(4)).len(), 1);
        assert_eq!(eyes(&[]).len(), 1);
    }

    #[test]
    fn what_is_crowded_is_kept_and_hardly_anything_else() {
        let all: Vec<u32> = (0..1000).chain([7; 31]).chain([2000; 31]).collect();
        let kept = crowded(all.iter().copied(), &Unwatched).unwrap();
        assert_eq!(kept.iter().filter(|&&each| each == 7).count(), 32);
        assert!(kept.len() < 100, "{}", kept.len());
    }

    #[test]
    fn the_most_crowded_are_found_in_order() {
        let mut all: Vec<u32> =
            [[3; 40].as_slice(), &[1; 50], &[2; 60], &[5; 32], &[4; 31]].concat();
        assert_eq!(most_common(&mut all, &Unwatched).unwrap().as_slice(), [2, 1, 3]);
    }

    const FLOOR: Triangle = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]];

    #[test]
    fn above_and_beside_are_apart() {
        let raised = FLOOR.map(|[x, y, z]| [x, y, z + 0.01]);
        let beside = FLOOR.map(|[x, y, z]| [x + 4.01, y, z]);
        assert!(are_apart(&FLOOR, &raised));
        assert!(are_apart(&FLOOR, &beside));
        assert!(!are_apart(&FLOOR, &FLOOR.map(|[x, y, z]| [x + 4.0, y, z])), "they touch");
    }

    #[test]
    fn around_a_corner_what_lies_in_other_directions_is_apart() {
        let beside = [FLOOR[0], [-1.0, 3.0, 0.0], [-3.0, 1.0, 0.0]];
        assert!(are_apart_but_for_corner(&FLOOR, &beside));
        let through = [FLOOR[0], [2.0, 2.0, 1.0], [2.0, 2.0, -1.0]];
        assert!(!are_apart_but_for_corner(&FLOOR, &through));
        assert!(cut_each_other(&FLOOR, &through));
    }

    /// So many triangles on the side from one point to another.
    fn book(pages: u32, [from, to]: [[f32; 3]; 2]) -> Vec<Triangle> {
        let outer = |page: u32| {
            let (sin, cos) = (f64::from(page) / f64::from(pages) * std::f64::consts::TAU).sin_cos();
            [from[0] + cos as f32, from[1] + 0.5, from[2] + sin as f32]
        };
        (0..pages).map(|page| [from, to, outer(page)]).collect()
    }

    // Three tips with more at each than the spine of the book has.
    #[test]
    fn many_on_one_side_are_seen_from_it() {
        let spine = [[9.0, 0.0, 0.0], [9.0, 2.0, 0.0]];
        let tips = (0..3).flat_map(|tip| {
            cone(40)
                .into_iter()
                .map(move |triangle| triangle.map(|[x, y, z]| [x, y + 3.0 * tip as f32, z]))
        });
        let all: Vec<Triangle> = tips.chain(book(40, spine)).collect();
        assert!(eyes(&all).contains(&Around::line(spine)));
    }

    //   .'.   50
    //  -----      the second tip is seen along the way from the first, the first from the middle
    //    '    40
    #[test]
    fn two_tips_have_an_axis() {
        let down = cone(20).into_iter().map(|triangle| triangle.map(|[x, y, z]| [x + 1.0, -y, z]));
        let all: Vec<Triangle> = cone(25).into_iter().chain(down).collect();
        let eyes = eyes(&all);
        assert_eq!(eyes.len(), 5);
        assert_eq!(eyes[2].points()[0], [0.0, 1.0, 0.0]);
        assert_eq!(eyes[4], Around::line([[1.0, -1.0, 0.0], [0.0, 1.0, 0.0]]));
    }

    #[test]
    fn looking_is_told_triangle_by_triangle() {
        struct Count(std::cell::Cell<usize>);
        impl Watch for Count {
            fn worked(&self, steps: usize) -> Result<(), Error> {
                self.0.set(self.0.get() + steps);
                Ok(())
            }
        }
        let (cone, count) = (cone(40), Count(std::cell::Cell::new(0)));
        let eyes = Eyes::of(&cone, &Unwatched).unwrap();
        eyes.views(&cone, &count).unwrap();
        assert_eq!(count.0.get(), 3 * 80);
    }

    //     ____
    //    |___/    a triangle upright below the floor, whose own sides keep nothing off
    //     / \
    #[test]
    fn one_plane_is_enough_above_or_below() {
        for up in [1.0, -1.0] {
            let upright = [[1.0, 1.0, 0.1], [4.0, 4.0, 3.0], [-2.0, -2.0, 3.0]];
            let upright = upright.map(|[x, y, z]| [x, y, z * up]);
            assert!(are_apart(&FLOOR, &upright) && are_apart(&upright, &FLOOR), "{up}");
        }
    }

    #[test]
    fn rounding_tells_nothing_apart() {
        let mut seed = 1_u32;
        let mut next = || {
            seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            // Few enough digits that the middle of two is exact.
            (seed >> 12) as f32 / 4096.0 - 128.0
        };
        for _ in 0..300 {
            let floor = [0; 3].map(|_| [0; 3].map(|_| next()));
            let middle = [0, 1, 2].map(|axis| (floor[0][axis] + floor[1][axis]) / 2.0);
            let touching = [middle, [0; 3].map(|_| next()), [0; 3].map(|_| next())];
            assert!(!are_apart(&floor, &touching), "{floor:?} {touching:?}");
        }
    }
}
