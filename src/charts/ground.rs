//! Ground: the texture that a chart covers around a chamfer.
//!
//! And density: how much texture a triangle shows for its area.

use std::cell::LazyCell;
use std::ops::Deref;

use glam::DVec2;

use crate::breaks::seam_between;
use crate::ids::{Corner, Few, Id, Triangle};
use crate::math::area_vector;
use crate::mesh::Uv;
use crate::surface::Surface;
use crate::tolerance::{EXPORTED_ROUNDING, TEXTURE_MARGIN, TEXTURE_ROUNDING};
use crate::view::View;

/// A new triangle is looked at in so many places: its corners, the middles of its sides, and between
/// them.
const SAMPLES: usize = 7;

const THIRD: f64 = 1.0 / 3.0;

/// The square of a distance that is this many times another one's is more, whatever rounding does.
const SURELY_FARTHER: f64 = 1.1;

/// A chamfer may lie on so many triangles of a chart, and of those around a corner on so many from
/// it on either way: more would take long to find.
const MOST_FACES: usize = 64;

/// A triangle of the chart on the texture.
#[derive(Clone, Copy)]
pub struct Face {
    points: [DVec2; 3],
    /// From each point to the next.
    sides: [DVec2; 3],
    /// Twice its area, negative where it is mirrored.
    pub area: f64,
}

impl Face {
    #[inline(always)]
    pub fn new(points: [DVec2; 3]) -> Face {
        let [a, b, c] = points;
        Face { points, sides: [b - a, c - b, a - c], area: texture_area(points) }
    }

    /// Whether a point is on it, with no margin.
    #[inline(always)]
    pub fn holds(&self, point: DVec2) -> bool {
        let sign = 1.0_f64.copysign(self.area);
        self.area != 0.0 && (0..3).all(|side| self.turn(side, point) * sign >= 0.0)
    }

    /// Whether rounding its points can make its area vanish: models that are coloured by single texels
    /// have all of a face at one place.
    fn is_line(&self) -> bool {
        let least = size(self.points) * EXPORTED_ROUNDING;
        let longest = self.sides.map(DVec2::length_squared).into_iter().fold(0.0, f64::max);
        self.area * self.area <= longest * (least * least)
    }

    /// Its points, from that of one of its corners on.
    fn from(&self, corner: Corner) -> [DVec2; 3] {
        let first = corner.index() % 3;
        [0, 1, 2].map(|k| self.points[(first + k) % 3])
    }

    /// On which side of one of its sides a point is.
    fn turn(&self, side: usize, point: DVec2) -> f64 {
        self.sides[side].perp_dot(point - self.points[side])
    }

    /// Whether a point is on it, or as near to it.
    fn is_below(&self, point: DVec2, near: f64) -> bool {
        self.holds(point) || self.is_beside(point, near)
    }

    /// The same where its bounds are known, and most points are far away.
    fn is_below_within(&self, bounds: [DVec2; 2], point: DVec2, near: f64) -> bool {
        if self.area == 0.0 {
            return self.is_beside_within(bounds, point, near);
        }
        let sign = 1.0_f64.copysign(self.area);
        let turn = |side: usize| self.turn(side, point) * sign;
        let Some((side, turn)) =
            (0..3).map(|side| (side, turn(side))).find(|(_, turn)| *turn < 0.0)
        else {
            return true;
        };
        // What is far beyond a side's line is so from all of the triangle.
        let square = near * near * self.sides[side].length_squared();
        turn * turn <= square * SURELY_FARTHER && self.is_beside_within(bounds, point, near)
    }

    /// Whether a point is as near to one of its sides.
    fn is_beside(&self, point: DVec2, near: f64) -> bool {
        self.is_beside_within(bounds(self.points), point, near)
    }

    /// The same where its bounds are known.
    fn is_beside_within(&self, [low, high]: [DVec2; 2], point: DVec2, near: f64) -> bool {
        let outside = (low - point).max(point - high).max_element();
        outside <= near
            && (0..3).any(|k| {
                let ([from, to], way) = ([self.points[k], self.points[(k + 1) % 3]], self.sides[k]);
                let (along, square) = ((point - from).dot(way), near * near);
                match way.length_squared() {
                    _ if along <= 0.0 => point.distance_squared(from) <= square,
                    length if along >= length => point.distance_squared(to) <= square,
                    length => self.turn(k, point).powi(2) <= square * length,
                }
            })
    }
}

/// Where a triangle on the texture is looked at, and which of these places lie on no face yet.
struct Samples {
    /// The corners first.
    points: [DVec2; SAMPLES],
    is_left: [bool; SAMPLES],
    /// Those of all of them.
    bounds: [DVec2; 2],
    /// So near counts as on it.
    near: f64,
}

impl Samples {
    fn new(triangle: [DVec2; 3]) -> Samples {
        let [a, b, c] = triangle;
        let middle = |one: DVec2, other: DVec2| one * 0.5 + other * 0.5;
        let points =
            [a, b, c, middle(a, b), middle(b, c), middle(a, c), a * THIRD + b * THIRD + c * THIRD];
        let (bounds, near) = (bounds(triangle), nearness(triangle));
        Samples { points, is_left: [true; SAMPLES], bounds, near }
    }

    /// Whether the triangle lies on a face, or all places lie on this one or one that was asked before.
    fn lie_on(&mut self, points: [DVec2; 3]) -> bool {
        let within @ [low, high] = bounds(points);
        // Of most faces around a corner all are farther away than rounding can tell.
        let apart = (self.bounds[0] - high).max(low - self.bounds[1]).max_element();
        if apart > self.near + (high - low).max_element() * TEXTURE_ROUNDING {
            return false;
        }
        let face = Face::new(points);
        let is_below = |at| face.is_below_within(within, at, self.near);
        let mut is_whole = true;
        for k in 0..SAMPLES {
            // A corner is asked for as long as all of them may lie on this one.
            if self.is_left[k] || is_whole && k < 3 {
                let is_on = is_below(self.points[k]);
                self.is_left[k] &= !is_on;
                is_whole &= is_on;
            }
            if is_whole && k == 2 {
                return true;
            }
        }
        self.is_left == [false; SAMPLES]
    }
}

/// The source triangles around some corners that lie in the corners' own chart of a channel, and
/// what follows on these.
pub struct Ground<'a> {
    surface: Surface<'a>,
    channel: usize,
    /// Corners of chamfered edges.
    corners: &'a [Corner],
}

impl<'a> Ground<'a> {
    pub fn new(surface: Surface<'a>, channel: usize, corners: &'a [Corner]) -> Self {
        Ground { surface, channel, corners }
    }

    /// The triangle at the first of its corners.
    pub fn triangle(&self) -> Triangle {
        self.corners[0].triangle()
    }

    /// How that lies on the texture.
    pub fn own(&self) -> Face {
        self.face(self.triangle())
    }

    /// Whether some triangles on the texture, of which each is three places in the points, lie on it. Of
    /// some of the points it is not known whether they lie on its own triangle, which is known.
    pub fn covers(&self, own: &Face, lie: (&[[u32; 3]], &[DVec2]), unsure: &[DVec2]) -> bool {
        // Most chamfers lie on the triangle that they are cut off from, and most of their points right on it.
        unsure.iter().all(|&point| own.holds(point)) || self.covers_past(*own, lie, unsure)
    }

    /// The same where the own triangle is not enough. That is taken by value: so it is copied here alone.
    #[inline(never)]
    pub fn covers_past(
        &self,
        own: Face,
        (triangles, points): (&[[u32; 3]], &[DVec2]),
        unsure: &[DVec2],
    ) -> bool {
        let corners = |triangle: &[u32; 3]| triangle.map(|place| points[place as usize]);
        let near = LazyCell::new(|| {
            let nears = triangles.iter().map(|triangle| nearness(corners(triangle)));
            nears.fold(f64::INFINITY, f64::min)
        });
        let near = || *near;
        let at = self.corners[0];
        // Most of the others lie on it and on the one before it around the corner.
        [at.prev(), at].into_iter().any(|side| self.lie_on_two(&own, side, (unsure, &near)))
            || unsure.iter().all(|&point| own.is_below(point, near()))
            || self.corners.len() == 1 && self.lie_around(points)
            || {
                let (nearest, beside) = (self.nearest(), LazyCell::new(|| self.beside()));
                let covers = |triangle| self.covers_one((&nearest, &beside), corners(triangle));
                triangles.iter().all(covers)
            }
    }

    /// The same for one triangle, where it is known what is nearest to the first half-edge, and beside that.
    fn covers_one(
        &self,
        (nearest, beside): (&[[DVec2; 3]], &impl Deref<Target = Few<[DVec2; 3]>>),
        triangle: [DVec2; 3],
    ) -> bool {
        let mut samples = Samples::new(triangle);
        let (own, near) = (self.triangle(), samples.near);
        if nearest.iter().any(|face| samples.lie_on(*face))
            || beside.iter().any(|face| samples.lie_on(*face))
        {
            return true;
        }
        let mut lie_on = |face: Triangle| samples.lie_on(self.points(face));
        self.any_corner(|corner| corner.triangle() != own && lie_on(corner.triangle()))
            || self.below(triangle, near).into_iter().any(lie_on)
    }

    /// Whether some points lie on the own triangle and on that beyond one of its sides, or as near to them,
    /// and these two are convex together: then all between the points does so, too.
    fn lie_on_two(
        &self,
        own: &Face,
        side: Corner,
        (points, near): (&[DVec2], &impl Fn() -> f64),
    ) -> bool {
        if !self.may_run_on(side) {
            return false;
        }
        let twin = self.surface.topology.twin[side];
        let beyond = self.face(twin.triangle());
        let ([from, to, apex], [end, start, far]) = (own.from(side), beyond.from(twin));
        let sign = 1.0_f64.copysign(own.area);
        let is_convex = sign * (far - from).perp_dot(apex - from) > 0.0
            && sign * (apex - to).perp_dot(far - to) > 0.0;
        is_convex
            && [from, to] == [start, end]
            && own.area * beyond.area > 0.0
            && points.iter().all(|&at| {
                let is_beside = || [own, &beyond].iter().any(|face| face.is_beside(at, near()));
                own.holds(at) || beyond.holds(at) || is_beside()
            })
    }

    /// Whether the chart goes on all around the first corner, at least as far as some points are from it:
    /// then they lie on it, and all between them.
    fn lie_around(&self, points: &[DVec2]) -> bool {
        let at = self.corners[0];
        let [center, first, _] = self.face(at.triangle()).from(at);
        let far = points.iter().map(|point| point.distance_squared(center)).fold(0.0, f64::max);
        let (mut corner, mut spoke, mut turn) = (at, first, 0.0);
        for _ in 0..MOST_FACES {
            let face = self.face(corner.triangle());
            let [start, from, to] = face.from(corner);
            // As far as the line of the side across.
            let reaches = face.area * face.area > far * from.distance_squared(to);
            if !reaches || [start, from] != [center, spoke] || face.area * turn < 0.0 {
                return false;
            }
            let side = corner.prev();
            if !self.may_run_on(side) {
                return false;
            }
            (corner, spoke, turn) = (self.surface.topology.twin[side], to, face.area);
            if corner == at {
                return spoke == first;
            }
        }
        false
    }

    /// The own triangle and that of the chart beyond the first half-edge: what does not lie on the one lies
    /// mostly on the other, and is soon found so.
    fn nearest(&self) -> Few<[DVec2; 3]> {
        let mut nearest = Few::new();
        nearest.push(self.points(self.triangle()));
        self.add_beyond(self.corners[0], &mut nearest);
        nearest
    }

    /// Those next to these two around the corners: there lies most of what is left.
    fn beside(&self) -> Few<[DVec2; 3]> {
        let (side, is_edge) = (self.corners[0], self.corners.len() > 1);
        let twin = self.surface.topology.twin[side];
        let mut beside = Few::new();
        self.add_beyond(side.prev(), &mut beside);
        if is_edge {
            self.add_beyond(side.next(), &mut beside);
        }
        if self.runs_on(side) {
            self.add_beyond(twin.next(), &mut beside);
            if is_edge {
                self.add_beyond(twin.prev(), &mut beside);
            }
        }
        beside
    }

    /// Adds the triangle of the chart beyond a half-edge.
    fn add_beyond(&self, side: Corner, faces: &mut Few<[DVec2; 3]>) {
        if self.runs_on(side) {
            faces.push(self.points(self.surface.topology.twin[side].triangle()));
        }
    }

    /// The triangles of the chart that reach below one on the texture, as far as they follow on each
    /// other.
    fn below(&self, triangle: [DVec2; 3], near: f64) -> Vec<Triangle> {
        let [low, high] = bounds(triangle);
        self.spread(|face| {
            let [lowest, highest] = bounds(self.points(face));
            (lowest - high).max(low - highest).max_element() <= near
        })
    }

    /// The triangle of the chart, of those near by, that has the most texture.
    pub fn roomiest(&self) -> Triangle {
        let area = |face: &Triangle| texture_area(self.points(*face)).abs();
        let near_by = self.spread(|_| true);
        let roomiest = near_by.into_iter().max_by(|one, other| area(one).total_cmp(&area(other)));
        roomiest.unwrap_or(self.triangle())
    }

    /// The triangles of the chart that are such, as far as they follow on those around the corners.
    fn spread(&self, is_such: impl Fn(Triangle) -> bool) -> Vec<Triangle> {
        let mut found: Vec<Triangle> = Vec::new();
        let add = |found: &mut Vec<Triangle>, face: Triangle| {
            if is_such(face) && !found.contains(&face) {
                found.push(face);
            }
        };
        self.any_corner(|corner| {
            add(&mut found, corner.triangle());
            found.len() >= MOST_FACES
        });
        let mut visited = 0;
        while visited < found.len() && found.len() < MOST_FACES {
            for side in found[visited].corners().into_iter().filter(|&side| self.runs_on(side)) {
                add(&mut found, self.surface.topology.twin[side].triangle());
            }
            visited += 1;
        }
        found
    }

    /// Whether the corner of one of them is such.
    fn any_corner(&self, mut is_such: impl FnMut(Corner) -> bool) -> bool {
        let is_such = &mut is_such;
        self.corners.iter().any(|&at| match self.any_ahead(at, is_such) {
            Ahead::Found => true,
            Ahead::All => false,
            Ahead::Some => self.any_behind(at, is_such),
        })
    }

    /// Whether one of the corners from one on, counter-clockwise around its vertex up to the
    /// chart's end, is such.
    fn any_ahead(&self, at: Corner, is_such: &mut impl FnMut(Corner) -> bool) -> Ahead {
        let mut corner = at;
        for _ in 0..MOST_FACES {
            if is_such(corner) {
                return Ahead::Found;
            }
            let side = corner.prev();
            corner = self.surface.topology.twin[side];
            if corner == at {
                return Ahead::All;
            }
            if !self.runs_on(side) {
                break;
            }
        }
        Ahead::Some
    }

    /// As [`Ground::any_ahead`], of the corners before one, clockwise.
    fn any_behind(&self, at: Corner, is_such: &mut impl FnMut(Corner) -> bool) -> bool {
        let mut corner = at;
        for _ in 0..MOST_FACES {
            if !self.runs_on(corner) {
                break;
            }
            corner = self.surface.topology.twin[corner].next();
            if corner == at {
                break;
            }
            if is_such(corner) {
                return true;
            }
        }
        false
    }

    /// Whether the chart may go on beyond a half-edge, whose ends are still to be compared on the texture: with
    /// two coordinates there is no seam where these are the same.
    #[inline]
    fn may_run_on(&self, side: Corner) -> bool {
        let is_flat = self.surface.view.mesh.uvs[self.channel].components == 2;
        self.surface.topology.twin[side].is_some() && (is_flat || self.runs_on(side))
    }

    /// Whether the chart goes on beyond a half-edge.
    fn runs_on(&self, side: Corner) -> bool {
        let twin = self.surface.topology.twin[side];
        let meet = |one, other| !seam_between(self.surface.view, self.channel, one, other);
        twin.is_some() && meet(side, twin.next()) && meet(side.next(), twin)
    }

    fn face(&self, face: Triangle) -> Face {
        Face::new(self.points(face))
    }

    fn points(&self, face: Triangle) -> [DVec2; 3] {
        let uv = &self.surface.view.mesh.uvs[self.channel];
        face.corners().map(|corner| uv_point(uv, self.surface.view.vertex_at(corner).0))
    }
}

/// What comes of asking the corners around a vertex, one way round.
enum Ahead {
    Found,
    /// None of those all around is such.
    All,
    /// None of some, up to the chart's end.
    Some,
}

/// How near to the ground a triangle counts as on it.
fn nearness(triangle: [DVec2; 3]) -> f64 {
    longest_square(triangle).sqrt() * TEXTURE_MARGIN + size(triangle) * TEXTURE_ROUNDING
}

/// The least and the greatest coordinates.
fn bounds([a, b, c]: [DVec2; 3]) -> [DVec2; 2] {
    [a.min(b).min(c), a.max(b).max(c)]
}

/// Two components of a vertex in a UV channel: what lies on the texture.
#[inline]
pub fn uv_point(uv: &Uv, vertex: u32) -> DVec2 {
    let first = vertex as usize * uv.components as usize;
    DVec2::new(f64::from(uv.values[first]), f64::from(uv.values[first + 1]))
}

/// UV area over surface area of a source triangle, negative where it is mirrored; 0 where it has
/// none.
pub fn density(view: &View, triangle: Triangle, channel: usize) -> f64 {
    let uv = &view.mesh.uvs[channel];
    let points = triangle.corners().map(|c| uv_point(uv, view.vertex_at(c).index() as u32));
    density_of(view, triangle, &Face::new(points))
}

/// The same of a triangle that lies so on the texture.
pub fn density_of(view: &View, triangle: Triangle, face: &Face) -> f64 {
    let area = area_vector(view.triangle(triangle)).length();
    if area > 0.0 && !face.is_line() { face.area / area } else { 0.0 }
}

/// Twice the area on the texture.
#[inline]
pub fn texture_area([a, b, c]: [DVec2; 3]) -> f64 {
    (b - a).perp_dot(c - a)
}

/// The square of the length of a triangle's longest side on the texture.
pub fn longest_square([a, b, c]: [DVec2; 3]) -> f64 {
    a.distance_squared(b).max(b.distance_squared(c)).max(c.distance_squared(a))
}

/// The largest coordinate of a triangle on the texture.
pub fn size([a, b, c]: [DVec2; 3]) -> f64 {
    a.abs().max(b.abs()).max(c.abs()).max_element()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes;
    use crate::stages::{split, stages_of};

    #[test]
    fn a_point_is_as_far_from_a_triangle_as_from_its_nearest_side() {
        let triangle = [DVec2::ZERO, DVec2::X * 2.0, DVec2::Y * 2.0];
        let is_as_far = |triangle, point: [f64; 2], distance: f64| {
            let within = |near| Face::new(triangle).is_below(point.into(), near);
            within(distance * 1.01) && !within(distance * 0.99)
        };
        assert!(Face::new(triangle).is_below(DVec2::new(0.5, 0.5), 0.0));
        assert!(is_as_far(triangle, [1.0, -3.0], 3.0), "from a side");
        assert!(is_as_far(triangle, [5.0, -4.0], 5.0), "from a corner");
        assert!(is_as_far([DVec2::X * 2.0; 3], [5.0, 4.0], 5.0), "from a point");
    }

    /// The top of the cube is a square of the atlas, 0.3 by 0.45.
    #[test]
    fn the_ground_at_a_corner_of_a_seamed_cube_is_one_square_of_the_atlas() {
        let cube = shapes::cube(1.0);
        let stages = stages_of(&cube, 0.1);
        let corners = [Corner(0)];
        let ground = Ground::new(stages.surface(), 0, &corners);
        let uv = |corner: u32| {
            let vertex = cube.indices[corner as usize] as usize;
            let at = [cube.uvs[0].values[2 * vertex], cube.uvs[0].values[2 * vertex + 1]];
            DVec2::from(at.map(f64::from))
        };
        let face = [0, 1, 2].map(uv);
        let covers =
            |points: &[DVec2]| ground.covers(&ground.own(), (&[[0, 1, 2]], points), points);
        assert!(covers(&face));
        let middle = (face[0] + face[1] + face[2]) / 3.0;
        assert!(covers(&[face[0], face[1], middle]));
        let away = face[0] * 2.0 - middle;
        assert!(!covers(&[face[0], face[1], away]), "past the end of the chart");
    }

    /// A fan of so many triangles around one point of the texture, each a unit long, and whether the ground
    /// at its first corner covers a triangle of so large a radius around that point.
    fn covers_around(sides: u32, radius: f64) -> bool {
        let turn = |k: u32| (f64::from(k) / f64::from(sides) * std::f64::consts::TAU).sin_cos();
        let rim = (0..sides).map(turn).map(|(sin, cos)| [cos as f32, 0.0, -sin as f32]);
        let points: Vec<[f32; 3]> = [[0.0; 3]].into_iter().chain(rim).collect();
        let indices: Vec<u32> = (0..sides).flat_map(|k| [0, k + 1, (k + 1) % sides + 1]).collect();
        let mut fan = split(&points, &indices);
        let uvs = fan.positions.iter().flat_map(|[x, _, z]| [*x, -*z]).collect();
        fan.uvs[0] = crate::mesh::UvBuffer { components: 2, values: uvs };
        let stages = stages_of(&fan, 0.1);
        let corners = [Corner(0)];
        let ground = Ground::new(stages.surface(), 0, &corners);
        let points = [0, 1, 2].map(|k| {
            let (sin, cos) = (f64::from(k) / 3.0 * std::f64::consts::TAU).sin_cos();
            DVec2::new(cos, sin) * radius
        });
        ground.lie_around(&points)
    }

    //  .-'-.     the sides of a hexagon are 0.866 of its radius away from the middle
    //  | . |
    //  '-.-'
    #[test]
    fn all_around_a_corner_the_ground_reaches_as_far_as_the_nearest_side() {
        assert!(covers_around(6, 0.86));
        assert!(!covers_around(6, 0.87));
    }

    /// The four sides of a cube are a square each on the atlas: two triangles, and nothing beside them.
    #[test]
    fn two_triangles_of_a_square_hold_what_is_on_either() {
        let cube = shapes::cube(1.0);
        let stages = stages_of(&cube, 0.1);
        let sides = (0..6).map(Corner);
        let inner = sides
            .clone()
            .find(|&side| stages.topology.twin[side].triangle() == Triangle(1 - side.triangle().0));
        let inner = [inner.unwrap()];
        let ground = Ground::new(stages.surface(), 0, &inner);
        let (own, beyond) = (ground.own(), ground.face(stages.topology.twin[inner[0]].triangle()));
        let middle = |face: &Face| (face.points[0] + face.points[1] + face.points[2]) / 3.0;
        let points = [own.points[0], middle(&own), middle(&beyond)];
        assert!(ground.lie_on_two(&own, inner[0], (&points, &|| 0.0)));
        let outside = beyond.from(stages.topology.twin[inner[0]])[2] * 2.0 - middle(&own);
        assert!(!ground.lie_on_two(&own, inner[0], (&[points[0], points[1], outside], &|| 0.0)));
        assert!(!ground.lie_on_two(&own, inner[0].next(), (&points, &|| 0.0)), "past a seam");
    }

    /// The sides of the cylinder lie one beside the other in the atlas.
    #[test]
    fn the_ground_goes_on_over_all_of_the_chart_that_a_triangle_lies_on() {
        let cylinder = shapes::cylinder(12);
        let stages = stages_of(&cylinder, 0.1);
        let corners = [Corner(0)];
        let ground = Ground::new(stages.surface(), 0, &corners);
        let across = ground.spread(|_| true);
        let [low, high] = across
            .iter()
            .map(|&face| bounds(ground.points(face)))
            .fold([DVec2::INFINITY, DVec2::NEG_INFINITY], |[low, high], [least, most]| {
                [low.min(least), high.max(most)]
            });
        let covers = |triangle: [DVec2; 3]| {
            ground.covers(&ground.own(), (&[[0, 1, 2]], &triangle), &triangle)
        };
        assert_eq!(across.len(), 24, "two triangles for each side");
        assert!(covers([low, DVec2::new(high.x, low.y), high]));
        assert!(!covers([low, DVec2::new(high.x * 1.1, low.y), high]));
    }

    /// Seen at an angle, front and back show most, and no seam parts them from the other sides.
    #[test]
    fn the_roomiest_triangle_of_a_chart_has_the_most_texture() {
        let mut cube = shapes::plain_cube(1.0);
        let values = cube.positions.iter().flat_map(|[x, y, z]| [x + 0.3 * z, y + 0.1 * z]);
        cube.uvs[0] = crate::mesh::UvBuffer { components: 2, values: values.collect() };
        let stages = stages_of(&cube, 0.1);
        let corners = [Corner(0)];
        let ground = Ground::new(stages.surface(), 0, &corners);
        let roomiest = ground.roomiest();
        let most = texture_area(ground.points(roomiest)).abs();
        let all = stages.view.triangles().map(|face| texture_area(ground.points(face)).abs());
        assert!((most - all.fold(0.0, f64::max)).abs() < 1e-9 && most > 0.4);
    }
}
