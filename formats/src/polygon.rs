//! Cuts a polygon into triangles by clipping ears (Meisters 1975).
//!
//! No crate: those that there are leave out corners on straight sides, which opens a closed mesh
//! where another polygon uses them.

use robust::{Coord, orient2d};
use rstar::primitives::GeomWithData;
use rstar::{AABB, Envelope, RTree, SelectionFunction};

/// The triangles of a polygon, as places in it: always two fewer than corners, and every corner
/// in one of them. A polygon that crosses itself is cut as well as it can be.
pub fn triangulate(polygon: &[[f32; 3]]) -> Vec<[usize; 3]> {
    let cuts = polygon.len().saturating_sub(2);
    let mut triangles = Vec::with_capacity(cuts);
    let mut ring = Ring::new(flatten(polygon));
    // Starting at 1 cuts a convex quad as a fan around its first corner, as most programs do.
    let mut tip = 1;
    for left in (1..=cuts).rev() {
        // The last three are a triangle whatever they look like, and told from the first of them.
        tip = if left == 1 { ring.second() } else { ring.next_ear(tip) };
        triangles.push(ring.around(tip));
        ring.cut(tip);
        // Past the corner that has just lost area: cutting on at it would make slivers.
        tip = ring.after[ring.after[tip]];
    }
    triangles
}

/// The polygon seen along its normal (Newell's), the normal pointing to the viewer: the two
/// coordinates that span the most area, exactly as they are.
fn flatten(polygon: &[[f32; 3]]) -> Vec<Coord<f64>> {
    let mut area = [0.0f64; 3];
    for (place, a) in polygon.iter().enumerate() {
        let b = polygon[(place + 1) % polygon.len()];
        for (axis, sum) in area.iter_mut().enumerate() {
            let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
            *sum += (f64::from(a[u]) - f64::from(b[u])) * (f64::from(a[v]) + f64::from(b[v]));
        }
    }
    let largest =
        (0..3).fold(0, |best, axis| if area[axis].abs() > area[best].abs() { axis } else { best });
    let (mut u, mut v) = ((largest + 1) % 3, (largest + 2) % 3);
    if area[largest] < 0.0 {
        std::mem::swap(&mut u, &mut v);
    }
    polygon.iter().map(|point| Coord { x: point[u].into(), y: point[v].into() }).collect()
}

/// The corners that are left of a polygon.
struct Ring {
    points: Vec<Coord<f64>>,
    /// `#corners`: the one on either side, of those that are left.
    before: Vec<usize>,
    after: Vec<usize>,
    /// `#corners`: whether it is left and does not turn left. Only such a one can lie in an ear.
    is_suspect: Vec<bool>,
    /// The suspects, so that those in an ear are found soon.
    suspects: RTree<Suspect>,
    /// `#corners`: a suspect that was found in its ear, if any was since its neighbours are what they
    /// are: as long as that is left nobody has to look again.
    found_in: Vec<Option<usize>>,
    /// The lowest corner that is left.
    first: usize,
}

/// A corner where it stands.
type Suspect = GeomWithData<[f64; 2], usize>;

impl Ring {
    fn new(points: Vec<Coord<f64>>) -> Ring {
        let count = points.len();
        let mut ring = Ring {
            points,
            before: (0..count).map(|corner| (corner + count - 1) % count).collect(),
            after: (0..count).map(|corner| (corner + 1) % count).collect(),
            is_suspect: Vec::new(),
            suspects: RTree::new(),
            found_in: vec![None; count],
            first: 0,
        };
        ring.is_suspect = (0..count).map(|corner| ring.turn(corner) <= 0.0).collect();
        let suspects = (0..count).filter(|&corner| ring.is_suspect[corner]);
        ring.suspects = RTree::bulk_load(suspects.map(|corner| ring.suspect(corner)).collect());
        ring
    }

    fn suspect(&self, corner: usize) -> Suspect {
        let Coord { x, y } = self.points[corner];
        Suspect::new([x, y], corner)
    }

    /// A corner between its neighbours.
    fn around(&self, corner: usize) -> [usize; 3] {
        [self.before[corner], corner, self.after[corner]]
    }

    /// The one that follows on the lowest that is left.
    fn second(&self) -> usize {
        self.after[self.first]
    }

    /// Positive where the path turns left at a corner.
    fn turn(&self, corner: usize) -> f64 {
        turn(&self.points, self.around(corner))
    }

    /// Takes a corner out.
    fn cut(&mut self, corner: usize) {
        let [before, _, after] = self.around(corner);
        (self.after[before], self.before[after]) = (after, before);
        if corner == self.first {
            self.first = after;
        }
        self.suspect_if(false, corner);
        for neighbour in [before, after] {
            self.suspect_if(self.turn(neighbour) <= 0.0, neighbour);
            self.found_in[neighbour] = None;
        }
    }

    fn suspect_if(&mut self, is_suspect: bool, corner: usize) {
        let was_suspect = std::mem::replace(&mut self.is_suspect[corner], is_suspect);
        match (was_suspect, is_suspect) {
            (true, false) => drop(self.suspects.remove(&self.suspect(corner))),
            (false, true) => self.suspects.insert(self.suspect(corner)),
            _ => (),
        }
    }

    /// The first ear at or after a corner. Where there is none the polygon crosses itself or what
    /// is left of it is a line: then the first corner that is not reflex goes, or any.
    fn next_ear(&mut self, start: usize) -> usize {
        let mut corner = start;
        loop {
            if self.is_ear(corner) {
                return corner;
            }
            corner = self.after[corner];
            if corner == start {
                return self.first_not_reflex(start).unwrap_or(start);
            }
        }
    }

    fn first_not_reflex(&self, start: usize) -> Option<usize> {
        let others = std::iter::successors(Some(self.after[start]), |&last| Some(self.after[last]));
        let mut corners =
            std::iter::once(start).chain(others.take_while(|&corner| corner != start));
        corners.find(|&corner| self.turn(corner) >= 0.0)
    }

    fn is_ear(&mut self, corner: usize) -> bool {
        if self.is_suspect[corner] || self.found_in[corner].is_some_and(|at| self.is_suspect[at]) {
            return false;
        }
        self.found_in[corner] = self.any_inside(self.around(corner));
        self.found_in[corner].is_none()
    }

    fn any_inside(&self, ear: [usize; 3]) -> Option<usize> {
        let corners = ear.map(|corner| self.points[corner]);
        let near = self.suspects.locate_with_selection_function(Ear { corners });
        near.map(|suspect| suspect.data).find(|&at| is_inside(&self.points, ear, at))
    }
}

/// What of a tree of suspects may be in an ear.
struct Ear {
    /// Turning left.
    corners: [Coord<f64>; 3],
}

impl Ear {
    /// Whether the corner of a box that is farthest to the left of a side is not left of it.
    fn is_beyond(&self, side: usize, bounds: &AABB<[f64; 2]>) -> bool {
        let [from, to] = [self.corners[side], self.corners[(side + 1) % 3]];
        let ([low_x, low_y], [high_x, high_y]) = (bounds.lower(), bounds.upper());
        let x = if to.y > from.y { low_x } else { high_x };
        let y = if to.x > from.x { high_y } else { low_y };
        orient2d(from, to, Coord { x, y }) < 0.0
    }
}

impl SelectionFunction<Suspect> for Ear {
    fn should_unpack_parent(&self, bounds: &AABB<[f64; 2]>) -> bool {
        let corners = self.corners.map(|Coord { x, y }| [x, y]);
        bounds.intersects(&AABB::from_points(&corners))
            && !(0..3).any(|side| self.is_beyond(side, bounds))
    }
}

/// Positive where the path turns left.
fn turn(points: &[Coord<f64>], [a, b, c]: [usize; 3]) -> f64 {
    orient2d(points[a], points[b], points[c])
}

/// Whether a corner lies in a triangle or on its side, without being one of its corners.
fn is_inside(points: &[Coord<f64>], [a, b, c]: [usize; 3], corner: usize) -> bool {
    let same = |other: usize| points[corner] == points[other];
    if same(a) || same(b) || same(c) {
        return false;
    }
    [[a, b], [b, c], [c, a]].iter().all(|&[from, to]| turn(points, [from, to, corner]) >= 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn flat(points: &[[f32; 2]]) -> Vec<[f32; 3]> {
        points.iter().map(|&[x, y]| [x, y, 0.0]).collect()
    }

    fn area(polygon: &[[f32; 3]], [a, b, c]: [usize; 3]) -> f32 {
        let (a, b, c) = (polygon[a], polygon[b], polygon[c]);
        ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2.0
    }

    #[test]
    fn a_square_is_a_fan_around_its_first_corner() {
        let square = flat(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]);
        assert_eq!(triangulate(&square), [[0, 1, 2], [0, 2, 3]]);
    }

    //  3---------2
    //   \   0   /      an arrowhead: the fan around its first side would leave it
    //    \ / \ /
    //     1   ...
    #[test]
    fn a_concave_polygon_keeps_its_area() {
        let arrow = flat(&[[0.0, 0.0], [2.0, -2.0], [0.0, 3.0], [-2.0, -2.0]]);
        let triangles = triangulate(&arrow);
        assert!(triangles.iter().all(|&triangle| area(&arrow, triangle) > 0.0));
        assert_eq!(triangles.iter().map(|&t| area(&arrow, t)).sum::<f32>(), 6.0);
    }

    #[test]
    fn the_winding_is_kept_from_every_side() {
        let l_shape =
            flat(&[[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]]);
        for turned in [[0, 1, 2], [1, 2, 0], [2, 0, 1], [1, 0, 2], [0, 2, 1], [2, 1, 0]] {
            let polygon: Vec<_> = l_shape.iter().map(|p| turned.map(|axis| p[axis])).collect();
            let triangles = triangulate(&polygon);
            assert_eq!(triangles.len(), 4);
            let areas: Vec<f32> = triangles.iter().map(|&t| area(&l_shape, t)).collect();
            assert!(areas.iter().all(|&area| area >= 0.0), "{areas:?}");
            assert_eq!(areas.iter().sum::<f32>(), 3.0);
        }
    }

    #[test]
    fn corners_on_straight_sides_are_used() {
        let square = flat(&[[0.0, 0.0], [0.5, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]);
        let triangles = triangulate(&square);
        assert_eq!(triangles.len(), 3);
        assert!(triangles.iter().all(|&triangle| area(&square, triangle) > 0.0));
    }

    /// Twenty thousand corners would take seconds if each cut looked at all of them.
    #[test]
    fn a_huge_polygon_is_cut_in_time() {
        let circle = |at: usize, radius: f32| {
            let angle = std::f32::consts::TAU * at as f32 / 20_000.0;
            [radius * angle.cos(), radius * angle.sin()]
        };
        let round: Vec<_> = (0..20_000).map(|at| circle(at, 1.0)).collect();
        let gear: Vec<_> = (0..20_000).map(|at| circle(at, 1.0 + (at % 2) as f32)).collect();
        for polygon in [round, gear] {
            let polygon = flat(&polygon);
            let triangles = triangulate(&polygon);
            assert_eq!(triangles.len(), 19_998);
            assert!(triangles.iter().all(|&triangle| area(&polygon, triangle) >= -1e-6));
        }
    }

    //   |\  |\  |\     of the ears of a comb most reach over many teeth, and of a saw that winds
    //  _| \_| \_| \_   around there is one at a time
    #[test]
    fn what_is_in_an_ear_is_found_soon() {
        let mut comb = vec![[0.0, 0.0], [10_000.0, 0.0]];
        for tooth in (0..10_000).rev() {
            comb.extend([[tooth as f32 + 0.5, 0.05], [tooth as f32, 1.0]]);
        }
        let winding = |turns: f32, out: f32| {
            let angle = turns * std::f32::consts::TAU;
            let radius = 1.0 + turns + out;
            [radius * angle.cos(), radius * angle.sin()]
        };
        let steps = 0..8_000;
        let outer = steps.clone().map(|step| winding(step as f32 / 400.0, 0.4));
        let inner = steps.rev().map(|step| winding(step as f32 / 400.0, 0.0));
        let spiral: Vec<_> = outer.chain(inner).collect();
        for polygon in [comb, spiral] {
            let polygon = flat(&polygon);
            let triangles = triangulate(&polygon);
            assert_eq!(triangles.len(), polygon.len() - 2);
            assert!(triangles.iter().all(|&triangle| area(&polygon, triangle) >= -1e-6));
        }
    }

    #[test]
    fn points_on_a_line_or_one_point_still_end() {
        assert_eq!(triangulate(&flat(&[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [3.0, 0.0]])).len(), 2);
        assert_eq!(triangulate(&[[1.0; 3]; 5]).len(), 3);
        let bow_tie = flat(&[[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]]);
        assert_eq!(triangulate(&bow_tie).len(), 2);
    }
}
