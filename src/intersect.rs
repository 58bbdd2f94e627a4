//! Which triangles of a mesh cut each other.
//!
//! Two triangles cut each other where their insides cross: not in one plane, each reaches to both
//! sides of the other and they have more than a point in common; in one plane, they overlap in
//! more than a line. So triangles that merely touch, or share a corner or an edge, do not cut,
//! however the mesh is indexed. All decisions are signs of determinants, evaluated exactly
//! (Shewchuk's predicates), in the manner of Guigue and Devillers, *Fast and Robust
//! Triangle-Triangle Overlap Test Using Orientation Predicates* (2003).

mod crowds;
mod eyes;

use glam::{DVec3, Vec3A};
use robust::{Coord, Coord3D, orient2d, orient3d};

use crate::bvh::{Aabb, Kin, Tree};
use crate::error::Error;
use crate::tolerance::NEARLY_FLAT;
#[cfg(any(test, feature = "check"))]
use crate::watch::Unwatched;
use crate::watch::{Watch, collect};

use eyes::Eyes;
use eyes::{are_apart, are_apart_but_for_corner};

pub(crate) use crowds::{Around, crowds};

pub(crate) type Triangle = [[f32; 3]; 3];

/// With more boxes that overlap for each triangle, directions and turned boxes are asked too. Of a
/// common mesh it is a dozen.
const CROWDED: usize = 15;

/// The pairs of triangles that cut each other, the smaller number first, in ascending order.
///
/// Only pairs in one part (`part_of: #triangles`) count. `source: #triangles` is what each was before
/// it was chamfered, if that is known: parts are [seen](Eyes) from where that meets.
#[cfg(feature = "check")]
pub(crate) fn self_intersections(
    triangles: &[Triangle],
    source: &[Triangle],
    part_of: &[u32],
) -> Vec<(u32, u32)> {
    let mut numbers: Vec<u32> = (0..triangles.len() as u32).collect();
    numbers.sort_by_key(|&number| part_of[number as usize]);
    let mut pairs: Vec<(u32, u32)> = numbers
        .chunk_by(|&one, &other| part_of[one as usize] == part_of[other as usize])
        .flat_map(|part| {
            let of = |all: &[Triangle]| -> Vec<Triangle> {
                part.iter().map(|&number| all[number as usize]).collect()
            };
            let (own, before) = (of(triangles), || Ok(of(source)));
            let kin = crowds(&own).unwrap_or_default();
            let all = Asked { open: |_| true, pair: |_, _| true };
            let pairs = cutting_pairs(&own, &kin, before, &all, &Unwatched).unwrap_or_default();
            pairs.into_iter().map(|(a, b)| (part[a as usize], part[b as usize]))
        })
        .collect();
    pairs.sort_unstable();
    pairs
}

/// Which pairs are asked for: at least one of them is open.
pub(crate) struct Asked<Open, Pair> {
    pub open: Open,
    pub pair: Pair,
}

/// The pairs of triangles that cut each other, of those that are asked for; the smaller number
/// first, in ascending order. `kin` is `#triangles`, or none where no crowd meets; where they
/// met before they were pulled apart they are [seen](Eyes) from, if need be.
///
/// # Errors
/// [`Error::Cancelled`] where the watch stops it.
pub(crate) fn cutting_pairs<Open: Fn(u32) -> bool, Pair: Fn(u32, u32) -> bool>(
    triangles: &[Triangle],
    kin: &[Kin],
    source: impl Fn() -> Result<Vec<Triangle>, Error>,
    asked: &Asked<Open, Pair>,
    watch: &dyn Watch,
) -> Result<Vec<(u32, u32)>, Error> {
    watch.worked(triangles.len())?;
    let boxes = collect(triangles.len(), watch, |number| bounds(&triangles[number]))?;
    let tree = Tree::watched(&boxes, kin, watch)?;
    // Giving back so much memory takes a while, too.
    drop(boxes);
    watch.worked(triangles.len())?;
    let few = triangles.len().saturating_mul(CROWDED);
    let mut pairs = match cutting_within(&tree, triangles, asked, few, watch)? {
        Some(pairs) => pairs,
        None => {
            let source = source()?;
            let count = source.len() + triangles.len();
            let either =
                |number| source.get(number).unwrap_or_else(|| &triangles[number - source.len()]);
            let eyes = Eyes::of(&collect(count, watch, |number| *either(number))?, watch)?;
            let tree = tree.with_views_watched(&eyes.views(triangles, watch)?, watch)?;
            let tree = tree.with_turned(triangles, watch)?;
            watch.worked(triangles.len())?;
            cutting_within(&tree, triangles, asked, usize::MAX, watch)?.unwrap_or_default()
        }
    };
    pairs.sort_unstable();
    Ok(pairs)
}

/// The same in no order, without looking at more than `most` pairs; none where there are more.
fn cutting_within<Open: Fn(u32) -> bool, Pair: Fn(u32, u32) -> bool>(
    tree: &Tree,
    triangles: &[Triangle],
    asked: &Asked<Open, Pair>,
    most: usize,
    watch: &dyn Watch,
) -> Result<Option<Vec<(u32, u32)>>, Error> {
    let corners = |t: u32| &triangles[t as usize];
    let (mut pairs, open) = (Vec::new(), tree.open_leaves(&asked.open, watch)?);
    let mut left = most;
    let look = |a, b| {
        left = left.checked_sub(1).ok_or(None)?;
        let (a, b) = (tree.number(a), tree.number(b));
        if (asked.pair)(a, b) && cut_each_other(corners(a), corners(b)) {
            pairs.push((a.min(b), a.max(b)));
        }
        Ok(())
    };
    // None where there are too many.
    match tree.each_pair(&open, |looks| watch.worked(looks).map_err(Some), look) {
        Err(None) => Ok(None),
        Err(Some(error)) => Err(error),
        Ok(()) => Ok(Some(pairs)),
    }
}

/// A triangle with two corners at one place cuts nothing, so it meets nothing: otherwise many at
/// one place would all be compared.
pub(crate) fn bounds(triangle: &Triangle) -> Aabb {
    let [a, b, c] = triangle;
    if a == b || b == c || c == a { Aabb::EMPTY } else { Aabb::around(triangle) }
}

/// Whether the insides of two triangles cross. Triangles without area have none.
pub(crate) fn cut_each_other(a: &Triangle, b: &Triangle) -> bool {
    match Common::of(a, b) {
        Common::None => !are_apart(a, b) && cross(a, b),
        Common::Corner([at_a, at_b]) => {
            let [a, b] = [turned(a, at_a), turned(b, at_b)];
            !are_apart_but_for_corner(&a, &b) && cross(&a, &b)
        }
        Common::Side(neighbours) => neighbours.lie_on_each_other() && overlap_in_plane(a, b),
        Common::More => cross(a, b),
    }
}

fn cross(a: &Triangle, b: &Triangle) -> bool {
    let b_sides = b.map(|point| side(a, point));
    if b_sides == [0; 3] {
        return overlap_in_plane(a, b);
    }
    if !straddle(b_sides) {
        return false;
    }
    let a_sides = a.map(|point| side(b, point));
    straddle(a_sides) && overlap_on_line(*a, a_sides, *b, b_sides)
}

/// The triangle with another corner first.
fn turned(triangle: &Triangle, first: usize) -> Triangle {
    [0, 1, 2].map(|k| triangle[(first + k) % 3])
}

/// What corners two triangles have in common.
enum Common {
    None,
    /// One: its number in each.
    Corner([usize; 2]),
    Side(Neighbours),
    /// All, or some more than once.
    More,
}

impl Common {
    fn of(a: &Triangle, b: &Triangle) -> Common {
        let [a_corners, b_corners] = [a, b].map(|triangle| triangle.map(Vec3A::from_array));
        // Bit `3 i + j` where corner i of one is corner j of the other.
        let bit = |k: usize| u32::from(a_corners[k / 3].cmpeq(b_corners[k % 3]).all()) << k;
        let same = (0..9).fold(0, |same, k| same | bit(k));
        match same.count_ones() {
            0 => Common::None,
            1 => {
                let place = same.trailing_zeros() as usize;
                Common::Corner([place / 3, place % 3])
            }
            2 => Neighbours::of(a, b, same).map_or(Common::More, Common::Side),
            _ => Common::More,
        }
    }
}

/// Two triangles with a side in common: most pairs that meet are such, and they have nothing else
/// in common unless one is folded flat onto the other.
struct Neighbours {
    side: [[f32; 3]; 2],
    /// The corners that are not on the common side.
    apexes: [[f32; 3]; 2],
}

impl Neighbours {
    /// From two bits of which corners are the same; none if one triangle has two corners there.
    fn of(a: &Triangle, b: &Triangle, same: u32) -> Option<Neighbours> {
        let (rows, columns) = ([7, 7 << 3, 7 << 6], [0b1001001, 0b1001001 << 1, 0b1001001 << 2]);
        let lone = |lines: [u32; 3]| {
            let mut lone = (0..3).filter(|&k| same & lines[k] == 0);
            lone.next().filter(|_| lone.next().is_none())
        };
        let [at_a, at_b] = [lone(rows)?, lone(columns)?];
        let side = [a[(at_a + 1) % 3], a[(at_a + 2) % 3]];
        Some(Neighbours { side, apexes: [a[at_a], b[at_b]] })
    }

    fn lie_on_each_other(&self) -> bool {
        let [from, to] = self.side.map(|point| DVec3::from(point.map(f64::from)));
        let [one, other] = self.apexes.map(|apex| {
            let apex = DVec3::from(apex.map(f64::from));
            (apex - from).cross(to - from)
        });
        // Apexes on two sides of the line cannot fold; rounding decides only where it is close.
        let may_fold = one.dot(other) > -NEARLY_FLAT * one.length() * other.length();
        may_fold && side(&[self.side[0], self.side[1], self.apexes[0]], self.apexes[1]) == 0
    }
}

/// 1 where a point is on the side of a triangle's plane that its normal points to, -1 on the
/// other, 0 in the plane.
fn side([a, b, c]: &Triangle, point: [f32; 3]) -> i8 {
    // Neighbours share corners, and the predicate is slowest where the answer is zero.
    if [a, b, c].contains(&&point) {
        return 0;
    }
    let coord = |[x, y, z]: [f32; 3]| Coord3D { x, y, z };
    // The predicate is positive below the plane.
    -sign(orient3d(coord(*a), coord(*b), coord(*c), coord(point)))
}

fn sign(value: f64) -> i8 {
    i8::from(value > 0.0) - i8::from(value < 0.0)
}

fn straddle(sides: [i8; 3]) -> bool {
    sides.contains(&1) && sides.contains(&-1)
}

/// For two triangles that straddle each other's planes: whether the pieces that they cut out of
/// the line of both planes have more than a point in common.
fn overlap_on_line(a: Triangle, a_sides: [i8; 3], b: Triangle, b_sides: [i8; 3]) -> bool {
    let ([mut a, mut b], [a_lone, b_lone]) =
        ([lone_first(a, a_sides), lone_first(b, b_sides)], [a_sides, b_sides].map(lone_side));
    // Turn each so that the other's lone corner is on the side of its normal.
    if a_lone < 0 {
        b.swap(1, 2);
    }
    if b_lone < 0 {
        a.swap(1, 2);
    }
    // Now each piece runs from one leg at the lone corner to the other: compare leg to leg.
    side(&[a[0], a[1], b[0]], b[1]) < 0 && side(&[a[0], a[2], b[0]], b[2]) > 0
}

/// The side of the corner that is alone on its side.
fn lone_side(sides: [i8; 3]) -> i8 {
    let positive = sides.iter().filter(|&&side| side > 0).count();
    if positive == 1 { 1 } else { -1 }
}

/// The triangle turned so that the corner that is alone on its side comes first.
fn lone_first(mut triangle: Triangle, sides: [i8; 3]) -> Triangle {
    let lone = lone_side(sides);
    triangle.rotate_left(sides.iter().position(|&side| side == lone).unwrap_or(0));
    triangle
}

/// For two triangles in one plane: whether they overlap in more than a line.
fn overlap_in_plane(a: &Triangle, b: &Triangle) -> bool {
    let axis = widest_axis(a);
    let [a, b] = [a, b].map(|triangle| flatten(triangle, axis));
    match (counter_clockwise(a), counter_clockwise(b)) {
        (Some(a), Some(b)) => !is_beside(&a, &b) && !is_beside(&b, &a),
        _ => false,
    }
}

/// The axis along which a triangle looks widest.
fn widest_axis(triangle: &Triangle) -> usize {
    let [a, b, c] = triangle.map(|point| DVec3::from(point.map(f64::from)));
    let normal = (b - a).cross(c - a).abs();
    normal.max_position()
}

fn flatten(triangle: &Triangle, axis: usize) -> [Coord<f32>; 3] {
    triangle.map(|point| Coord { x: point[(axis + 1) % 3], y: point[(axis + 2) % 3] })
}

/// The triangle wound counter-clockwise; none where it has no area.
fn counter_clockwise([a, b, c]: [Coord<f32>; 3]) -> Option<[Coord<f32>; 3]> {
    match sign(orient2d(a, b, c)) {
        1 => Some([a, b, c]),
        -1 => Some([a, c, b]),
        _ => None,
    }
}

/// Whether all of `other` is on or beyond one side of a counter-clockwise triangle.
fn is_beside(triangle: &[Coord<f32>; 3], other: &[Coord<f32>; 3]) -> bool {
    (0..3).any(|place| {
        let [a, b] = [triangle[place], triangle[(place + 1) % 3]];
        other.iter().all(|&point| orient2d(a, b, point) <= 0.0)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const FLOOR: Triangle = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]];

    fn cut(b: Triangle) -> bool {
        let forms = [FLOOR, [FLOOR[1], FLOOR[2], FLOOR[0]], [FLOOR[0], FLOOR[2], FLOOR[1]]];
        let answers: Vec<bool> = forms
            .iter()
            .flat_map(|a| {
                let turned = [b[2], b[1], b[0]];
                [cut_each_other(a, &b), cut_each_other(&b, a), cut_each_other(a, &turned)]
            })
            .collect();
        assert!(answers.windows(2).all(|pair| pair[0] == pair[1]), "order must not matter");
        answers[0]
    }

    #[test]
    fn a_wall_through_the_floor_cuts() {
        assert!(cut([[1.0, 1.0, -1.0], [2.0, 1.0, -1.0], [1.0, 1.0, 1.0]]));
    }

    #[test]
    fn a_wall_on_the_floor_touches() {
        assert!(!cut([[1.0, 1.0, 0.0], [2.0, 1.0, 0.0], [1.0, 1.0, 1.0]]));
    }

    #[test]
    fn a_wall_beside_the_floor_does_not_cut() {
        assert!(!cut([[5.0, 1.0, -1.0], [6.0, 1.0, -1.0], [5.0, 1.0, 1.0]]));
        assert!(!cut([[3.0, 3.0, -1.0], [4.0, 4.0, -1.0], [3.0, 3.0, 1.0]]));
    }

    #[test]
    fn a_shared_edge_does_not_cut() {
        assert!(!cut([[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 0.0, 3.0]]));
        assert!(!cut([[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, -3.0, 0.0]]));
    }

    #[test]
    fn a_fold_onto_itself_cuts() {
        assert!(cut([[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [3.0, 3.0, 0.0]]));
        assert!(cut(FLOOR));
    }

    #[test]
    fn a_shared_corner_cuts_only_beyond_it() {
        assert!(cut([[0.0, 0.0, 0.0], [2.0, 2.0, 1.0], [2.0, 2.0, -1.0]]));
        assert!(!cut([[0.0, 0.0, 0.0], [-2.0, -2.0, 1.0], [-2.0, -2.0, -1.0]]));
        assert!(!cut([[0.0, 0.0, 0.0], [2.0, -2.0, 1.0], [2.0, -2.0, -1.0]]));
    }

    #[test]
    fn crossing_only_in_a_rim_point_touches() {
        assert!(!cut([[2.0, 2.0, -1.0], [3.0, 3.0, -1.0], [2.0, 2.0, 1.0]]));
    }

    #[test]
    fn overlap_in_the_plane_cuts_and_contact_touches() {
        assert!(cut([[1.0, 1.0, 0.0], [1.5, 1.0, 0.0], [1.0, 1.5, 0.0]]));
        assert!(!cut([[4.0, 0.0, 0.0], [0.0, 4.0, 0.0], [4.0, 4.0, 0.0]]));
        assert!(!cut([[5.0, 0.0, 0.0], [9.0, 0.0, 0.0], [5.0, 4.0, 0.0]]));
    }

    #[test]
    fn without_area_nothing_cuts() {
        assert!(!cut([[1.0, 1.0, -1.0], [1.0, 1.0, 0.0], [1.0, 1.0, 1.0]]));
        assert!(!cut([[1.0, 1.0, 0.0], [1.5, 1.5, 0.0], [1.2, 1.2, 0.0]]));
    }

    /// The plain way, in double precision: clip each triangle's piece out of the common line.
    fn cuts_by_clipping(a: &Triangle, b: &Triangle) -> bool {
        let [a, b] = [a, b].map(|t| t.map(|point| DVec3::from(point.map(f64::from))));
        let normal = |t: &[DVec3; 3]| (t[1] - t[0]).cross(t[2] - t[0]);
        let along = normal(&a).cross(normal(&b));
        let piece = |t: &[DVec3; 3], plane: &[DVec3; 3]| {
            let height = t.map(|point| normal(plane).dot(point - plane[0]));
            let mut ends = [f64::INFINITY, f64::NEG_INFINITY];
            for (i, j) in [(0, 1), (1, 2), (2, 0)] {
                if height[i] * height[j] < 0.0 {
                    let share = height[i] / (height[i] - height[j]);
                    let place = along.dot(t[i].lerp(t[j], share));
                    ends = [ends[0].min(place), ends[1].max(place)];
                }
            }
            ends
        };
        let [[a_low, a_high], [b_low, b_high]] = [piece(&a, &b), piece(&b, &a)];
        a_low.max(b_low) < a_high.min(b_high)
    }

    #[test]
    fn agrees_with_clipping_on_random_triangles() {
        let mut state = 1u32;
        let mut random = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (state >> 8) as f32 / (1 << 24) as f32
        };
        let mut cutting = 0;
        for _ in 0..20_000 {
            let [a, b]: [Triangle; 2] =
                [(); 2].map(|()| [[(); 3]; 3].map(|p| p.map(|()| random())));
            let cuts = cut_each_other(&a, &b);
            assert_eq!(cuts, cuts_by_clipping(&a, &b), "{a:?} {b:?}");
            cutting += u32::from(cuts);
        }
        assert!(cutting > 1000, "{cutting}");
    }

    #[test]
    fn only_pairs_in_one_part_are_found() {
        let triangles = [FLOOR, [[1.0, 1.0, -1.0], [2.0, 1.0, -1.0], [1.0, 1.0, 1.0]]];
        assert_eq!(self_intersections(&triangles, &triangles, &[0, 0]), [(0, 1)]);
        assert!(self_intersections(&triangles, &triangles, &[0, 1]).is_empty());
    }

    /// Long narrow spikes on a ball, whose boxes overlap by the hundred: two triangles for each.
    fn spikes(count: u32) -> Vec<Triangle> {
        let spike = |number: u32| {
            let height = 1.0 - 2.0 * (f64::from(number) + 0.5) / f64::from(count);
            let (sine, cosine) = (f64::from(number) * 2.399_963).sin_cos();
            let out = DVec3::new(cosine, sine, 0.0) * (1.0 - height * height).sqrt();
            let way = out + DVec3::Z * height;
            let across = way.any_orthonormal_vector() / f64::from(count).sqrt() / 2.0;
            let at = |point: DVec3| point.as_vec3().to_array();
            [[at(way - across), at(way + across), at(way * 3.0)]; 2]
        };
        let sides =
            |[one, other]: [Triangle; 2]| [one, other.map(|point| point.map(|x| x * 0.999))];
        (0..count).flat_map(|number| sides(spike(number))).collect()
    }

    fn within(tree: &Tree, triangles: &[Triangle], most: usize) -> Option<Vec<(u32, u32)>> {
        let all = Asked { open: |_| true, pair: |_, _| true };
        cutting_within(tree, triangles, &all, most, &Unwatched).unwrap()
    }

    #[test]
    fn what_boxes_do_not_tell_apart_is_seen_apart_from_the_middle() {
        let triangles = spikes(2000);
        let boxes: Vec<Aabb> = triangles.iter().map(bounds).collect();
        let few = triangles.len() * CROWDED;
        let tree = Tree::new(&boxes, &[]);
        assert!(within(&tree, &triangles, few).is_none(), "boxes do not tell");
        let tree = tree.with_views(
            &Eyes::of(&triangles, &Unwatched).unwrap().views(&triangles, &Unwatched).unwrap(),
        );
        assert!(within(&tree, &triangles, few).is_some(), "eyes do");
    }

    #[test]
    fn what_is_looked_at_from_eyes_is_found_as_without() {
        let mut triangles = spikes(600);
        // Plates through some of the spikes.
        let plates: Vec<Triangle> = triangles.iter().step_by(40).map(plate).collect();
        triangles.extend(plates);
        let numbers = 0..triangles.len() as u32;
        let cut =
            |&(a, b): &(u32, u32)| cut_each_other(&triangles[a as usize], &triangles[b as usize]);
        let expected: Vec<(u32, u32)> = numbers
            .clone()
            .flat_map(|a| (a + 1..numbers.end).map(move |b| (a, b)))
            .filter(cut)
            .collect();
        assert!(expected.len() > 20, "{}", expected.len());
        let boxes: Vec<Aabb> = triangles.iter().map(bounds).collect();
        let eyes = Eyes::of(&triangles, &Unwatched).unwrap();
        let views = eyes.views(&triangles, &Unwatched).unwrap();
        let seen = Tree::new(&boxes, &[]).with_views(&views);
        let turned = Tree::new(&boxes, &[]).with_turned(&triangles, &Unwatched).unwrap();
        for tree in [seen, turned] {
            let mut found = within(&tree, &triangles, usize::MAX).unwrap();
            found.sort_unstable();
            assert_eq!(found, expected);
        }
    }

    /// The walls between the teeth of a star, upright and radial, two triangles each, whose boxes
    /// overlap by the hundred from wherever they are seen.
    fn teeth(count: u32) -> Vec<Triangle> {
        let wall = |number: u32| {
            let place = |step: u32, radius: f64, height: f32| {
                let turns = f64::from(step) / f64::from(2 * count) * std::f64::consts::TAU;
                [(radius * turns.cos()) as f32, (radius * turns.sin()) as f32, height]
            };
            let [inner, outer] = [(number / 2 * 2, 0.5), (number / 2 * 2 + 1, 1.0)];
            // Each tooth has one wall on either side of its tip.
            let inner = if number.is_multiple_of(2) { inner } else { (inner.0 + 2, 0.5) };
            let [a, b] = [0.0, 1.0].map(|height| place(inner.0, inner.1, height));
            let [c, d] = [1.0, 0.0].map(|height| place(outer.0, outer.1, height));
            [[a, b, c], [a, c, d]]
        };
        (0..2 * count).flat_map(wall).collect()
    }

    #[test]
    fn what_neither_boxes_nor_eyes_tell_apart_turned_boxes_do() {
        let triangles = teeth(4000);
        let boxes: Vec<Aabb> = triangles.iter().map(bounds).collect();
        let few = triangles.len() * 4 * CROWDED;
        let eyes = Eyes::of(&triangles, &Unwatched).unwrap();
        let views = eyes.views(&triangles, &Unwatched).unwrap();
        let tree = Tree::new(&boxes, &[]).with_views(&views);
        assert!(within(&tree, &triangles, few).is_none(), "eyes do not tell");
        let tree = Tree::new(&boxes, &[]).with_turned(&triangles, &Unwatched).unwrap();
        assert!(within(&tree, &triangles, few).is_some(), "turned boxes do");
    }

    /// Across the middle of a triangle.
    fn plate([a, b, tip]: &Triangle) -> Triangle {
        let [a, b, tip] = [a, b, tip].map(|point| DVec3::from(point.map(f64::from)));
        let (middle, side) = ((a + b + tip) / 3.0, b - a);
        let up = side.cross(tip - a).normalize() * side.length();
        [middle - side - up, middle + side - up, middle + up].map(|p| p.as_vec3().to_array())
    }

    /// A cone of many sides with a wall through it, and faces around one of the wall's sides.
    #[test]
    fn in_a_crowd_all_pairs_are_found() {
        let mut state = 7u32;
        let mut random = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (state >> 20) as f32 / 2048.0 - 1.0
        };
        let mut triangles: Vec<Triangle> = Vec::new();
        for step in 0..120 {
            let [[a, b, c], [d, e, f]] = [[(); 3]; 2].map(|point| point.map(|()| random()));
            let apex = [0.0, 2.0, 0.0];
            match step % 3 {
                0 => triangles.push([apex, [a, b, c], [d, e, f]]),
                1 => triangles.push([[d, e, f], [0.0; 3], apex]),
                _ => triangles.push([[a, b, c], apex, [a + 0.3, b, f]]),
            }
        }
        let mut expected = Vec::new();
        for a in 0..triangles.len() as u32 {
            let cut = |b: &u32| cut_each_other(&triangles[a as usize], &triangles[*b as usize]);
            expected.extend((a + 1..triangles.len() as u32).filter(cut).map(|b| (a, b)));
        }
        assert!(expected.len() > 100, "{}", expected.len());
        let part = vec![0; triangles.len()];
        assert_eq!(self_intersections(&triangles, &triangles, &part), expected);
    }
}
