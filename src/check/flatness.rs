//! What is flat between hard edges stays in its plane and keeps its normal.

use std::cell::OnceCell;

use glam::DVec3;

use super::junctions::{Borders, reach};
use super::origins::Origins;
use super::rules::{Element, Findings, Rule};
use super::stored::{is_unit, normal_with_area};
use super::surface::{HalfEdge, Surface};
use crate::groups::Groups;

/// How far, relative to the extent, corners may be off a plane that counts as flat.
const FLAT_TOLERANCE: f64 = 1e-6;

/// How far (a tenth of a degree) the triangles of a fan may lean from each other if it counts as
/// flat: small fans of a curved surface are within any distance of a plane.
const FLAT_COSINE: f64 = 0.999_998_476_913_288;

/// How far, relative to the extent, a pulled corner may be off the plane it was in.
const PLANE_TOLERANCE: f64 = 1e-5;

/// Normals that differ by more than this (a twentieth of a degree) shade a surface as curved.
const CURVED_SHADING: f64 = 1e-3;

/// A triangle lower than this many times the rounding has no plane to speak of: rounding its
/// corners turns it by a degree and more.
pub(super) const LEAST_HEIGHT: f64 = 16.0;

/// How much a normal may change where all around it are the same: rounding when it is made unit
/// length again.
const NORMAL_TOLERANCE: f64 = 1e-6;

/// A corner that is nearer to a plane than this share of the rounding has not left it: what is farther
/// off may be seen as part of the face beside.
const STAYS: f64 = 0.25;

/// More lines in a row are no edge that meets several others.
const MOST_BESIDE: usize = 64;

/// The triangles that meet at one cluster between two hard edges.
#[derive(Clone, Copy, Default)]
struct Fan {
    /// A point and the unit normal of the largest triangle, and twice the area of that.
    plane: Option<(DVec3, DVec3, f64)>,
    /// How far the fan's corners are off the plane.
    off_plane: f64,
    /// Whether some triangle leans from the plane.
    leans: bool,
    /// The normal that all corners have, while they do.
    normal: Option<DVec3>,
    has_uneven_normals: bool,
    /// Whether its normals differ so much that it is meant to look curved.
    shades_curved: bool,
}

/// Corners of source triangles against the fan that they belong to in the source.
pub(super) fn check_flatness(
    before: &Surface,
    after: &Surface,
    origins: &Origins,
    findings: &mut Findings,
) {
    let fans = Fans::new(before, |a, b| before.is_soft(a, b));
    // Where light breaks at edges that are not hard, a face between those is one by itself.
    let faces = before.breaks_softly().then(|| Fans::new(before, |a, b| before.is_even(a, b)));
    let extent = before.extent();
    let tolerance = (PLANE_TOLERANCE * extent).max(before.rounding());
    let least_height = LEAST_HEIGHT * before.rounding();
    let (beside, shown) = (Beside::default(), Shown::new(origins));
    for (triangle, source) in (0u32..).zip(&origins.triangles) {
        let Some(source) = source else { continue };
        // A line or a point has no plane and shows no normal.
        if normal_with_area(before.triangle(source[0] / 3)).is_none() {
            continue;
        }
        let alone = || Fan::of_triangle(before, source[0] / 3, least_height);
        let fan_at = |corner: u32| match origins.own_corner(corner) {
            Some(own) => (*fans.at(own), corner, tolerance),
            // A corner that a cut has added on a hard edge belongs to nothing but its triangle. The
            // vertex at whose place it stands may have been a little off that.
            None => (alone(), corner, tolerance.max(reach(before))),
        };
        let corners = || (0..3).map(|side| fan_at(3 * triangle + side));
        if corners().any(|(fan, corner, tolerance)| {
            fan.off_plane <= FLAT_TOLERANCE * extent
                && !fan.leans
                && !fan.shades_curved
                && fan.distance(after.position(corner)) > tolerance
        }) {
            findings.note(Rule::FlatFace, Element::Triangle(triangle));
        }
        // What is but a line, and stays one, shows no normal.
        let shows =
            |fan: &Fan| fan.plane.is_some() || !is_low(after.triangle(triangle), least_height);
        let is_bent = |corner: u32| {
            let face = faces.as_ref().zip(origins.own_corner(corner)).map(|(f, own)| f.at(own));
            let stays = |face: &&Fan| {
                let off_plane = face.distance(after.position(corner));
                // What is but a line is shaded as what it lies beside.
                face.plane.is_some() && off_plane <= STAYS * before.rounding()
            };
            face.filter(stays).is_some_and(|face| face.bends(after.normal(corner)))
        };
        // All of it, or nothing: what is shaded as two faces is none of them.
        let goes_on = |corner: u32| {
            let normal = after.normal(corner);
            let own = origins.own_corner(corner).map(|own| before.normal(own));
            let is_own = own.is_some_and(|own| own.distance(normal) <= NORMAL_TOLERANCE);
            beside.any(before, source[0] / 3, |face| {
                is_between(before, face, normal)
                    || is_own && is_one(before, face, after.shading(corner))
                    || !is_low(before.triangle(face), least_height)
                        && shown.has(after, face, corner)
            })
        };
        let bends = |fan: &Fan, normal: DVec3| {
            let mut own = 3 * triangle..3 * triangle + 3;
            fan.bends(normal) && (fan.plane.is_some() || !own.all(goes_on))
        };
        if corners().any(|(fan, corner, _)| {
            shows(&fan) && (bends(&fan, after.normal(corner)) || is_bent(corner))
        }) {
            findings.note(Rule::FlatNormal, Element::Triangle(triangle));
        }
    }
}

/// Whether a triangle is less high than that.
pub(super) fn is_low(corners: [DVec3; 3], least_height: f64) -> bool {
    let sides = [0, 1, 2].map(|k| corners[k].distance(corners[(k + 1) % 3]));
    let area = normal_with_area(corners).map_or(0.0, |normal| normal.length());
    area < least_height * sides.into_iter().fold(0.0, f64::max)
}

/// The triangles beside those that are but lines, once they are asked for: nobody has seen the normals of
/// a line. Where it opens, it lies in a face beside it, and may be shaded as that.
#[derive(Default)]
struct Beside {
    /// Sorted: a line, and a triangle beside it.
    pairs: OnceCell<Vec<[u32; 2]>>,
}

impl Beside {
    /// Whether a triangle beside a line, or beside those in a row with it, is such.
    fn any(&self, surface: &Surface, line: u32, is_such: impl Fn(u32) -> bool) -> bool {
        let pairs = self.pairs.get_or_init(|| Beside::pairs(surface));
        let (mut row, mut next) = (vec![line], 0);
        while let Some(&line) = row.get(next).filter(|_| row.len() <= MOST_BESIDE) {
            let first = pairs.partition_point(|pair| pair[0] < line);
            for &[_, other] in pairs[first..].iter().take_while(|pair| pair[0] == line) {
                if is_such(other) {
                    return true;
                }
                let is_line = pairs.binary_search_by_key(&other, |pair| pair[0]).is_ok();
                row.extend((is_line && !row.contains(&other)).then_some(other));
            }
            next += 1;
        }
        false
    }

    fn pairs(surface: &Surface) -> Vec<[u32; 2]> {
        let least_height = LEAST_HEIGHT * surface.rounding();
        let is_line = |triangle: u32| is_low(surface.triangle(triangle), least_height);
        let mut pairs = Vec::new();
        for (forward, backward) in surface.edges() {
            let both =
                forward.iter().flat_map(|one| backward.iter().map(move |other| [one, other]));
            for pair in both.map(|both| both.map(|side| side.corners[0] / 3)) {
                let both_ways = [pair, [pair[1], pair[0]]];
                pairs.extend(both_ways.into_iter().filter(|[line, _]| is_line(*line)));
            }
        }
        pairs.sort_unstable();
        pairs
    }
}

/// The triangles that show in the result what some of the source are, once they are asked for.
struct Shown<'a> {
    origins: &'a Origins<'a>,
    /// Sorted: a triangle of the source, and one of the result.
    pairs: OnceCell<Vec<[u32; 2]>>,
}

impl<'a> Shown<'a> {
    fn new(origins: &'a Origins<'a>) -> Shown<'a> {
        Shown { origins, pairs: OnceCell::new() }
    }

    /// Whether a triangle of the source is shaded where a corner of the result stands as that corner is:
    /// what is wrong with that is found there.
    fn has(&self, after: &Surface, source: u32, corner: u32) -> bool {
        let pairs = self.pairs.get_or_init(|| {
            let shown = (0u32..).zip(&self.origins.triangles);
            let pair =
                |(triangle, source): (u32, &Option<[u32; 3]>)| Some([(*source)?[0] / 3, triangle]);
            let mut pairs: Vec<_> = shown.filter_map(pair).collect();
            pairs.sort_unstable();
            pairs
        });
        let is_alike = |other: u32| {
            after.cluster(other) == after.cluster(corner)
                && after.normal(other).distance(after.normal(corner)) <= NORMAL_TOLERANCE
        };
        let first = pairs.partition_point(|pair| pair[0] < source);
        let mut shown = pairs[first..].iter().take_while(|pair| pair[0] == source);
        shown.any(|&[_, triangle]| (3 * triangle..3 * triangle + 3).any(is_alike))
    }
}

/// Whether a normal is one with those of a triangle, as nearly as they have to be where no edge is.
fn is_one(surface: &Surface, triangle: u32, normal: DVec3) -> bool {
    (3 * triangle..3 * triangle + 3).all(|corner| surface.shares_with(corner, normal))
}

/// Whether a normal is no farther from those of a triangle than they are from each other.
fn is_between(surface: &Surface, triangle: u32, normal: DVec3) -> bool {
    let own = [0, 1, 2].map(|side| surface.normal(3 * triangle + side).normalize_or_zero());
    let spread = (0..3).map(|k| own[k].distance(own[(k + 1) % 3])).fold(0.0, f64::max);
    own.iter().all(|own| own.distance(normal.normalize()) <= spread + NORMAL_TOLERANCE)
}

/// The fans of a mesh.
struct Fans {
    /// `#corners`: the first corner of the fan that each is in.
    fan_of: Vec<u32>,
    /// `#corners`, by the first corner of each fan.
    fans: Vec<Fan>,
}

impl Fans {
    /// Those between the edges at which two half-edges do not go on.
    fn new(surface: &Surface, goes_on: impl Fn(&HalfEdge, &HalfEdge) -> bool) -> Fans {
        let borders = Borders::new(surface);
        let fan_of = first_corners(surface, &borders, goes_on);
        let across = across_junctions(surface, &borders);
        Fans { fans: measure(surface, &fan_of, &across), fan_of }
    }

    fn at(&self, corner: u32) -> &Fan {
        &self.fans[self.fan_of[corner as usize] as usize]
    }
}

/// `#corners`: the first corner of the fan that each is in. Faces that only rounding has set apart are
/// of one fan, as the result may have put them together.
fn first_corners(
    surface: &Surface,
    borders: &Borders,
    goes_on: impl Fn(&HalfEdge, &HalfEdge) -> bool,
) -> Vec<u32> {
    let mut fans = Groups::singles(surface.mesh.indices.len());
    for (forward, backward) in surface.edges() {
        for (a, b) in forward.iter().flat_map(|a| backward.iter().map(move |b| (a, b))) {
            if goes_on(a, b) {
                fans.join(a.corners[0], b.corners[1]);
                fans.join(a.corners[1], b.corners[0]);
            }
        }
    }
    for [one, other] in borders.pairs() {
        for ends in [0, 1].map(|end| [one.corners[end], other.corners[1 - end]]) {
            let [from, to] = ends.map(|corner| surface.position(corner));
            if from.distance(to) <= surface.rounding() && surface.share_normal(ends) {
                fans.join(ends[0], ends[1]);
            }
        }
    }
    fans.labels()
}

/// Corners that stand in the middle of the side of another triangle which goes on from there, at a
/// T-junction, each with that triangle: the fan leads over it, though it has no corner there.
fn across_junctions(surface: &Surface, borders: &Borders) -> Vec<[u32; 2]> {
    let mut across = Vec::new();
    for [one, other] in borders.pairs() {
        for corner in one.corners {
            let [from, to] =
                other.corners.map(|end| surface.position(end) - surface.position(corner));
            let is_between = from.dot(to) < 0.0 && from.length().min(to.length()) > reach(surface);
            if is_between && other.corners.iter().all(|&end| surface.share_normal([corner, end])) {
                across.push([corner, other.corners[0] / 3]);
            }
        }
    }
    across
}

/// `#corners`, by the first corner of each fan. `across`: more triangles that some corners' fans have.
fn measure(surface: &Surface, fan_of: &[u32], across: &[[u32; 2]]) -> Vec<Fan> {
    let mut fans = vec![Fan::default(); fan_of.len()];
    let least_height = LEAST_HEIGHT * surface.rounding();
    let own = (0u32..).zip(fan_of).map(|(corner, &fan)| (corner / 3, fan));
    let across = across.iter().map(|&[corner, triangle]| (triangle, fan_of[corner as usize]));
    let members: Vec<(u32, u32)> = own.chain(across).collect();
    for &(triangle, fan) in &members {
        fans[fan as usize].add_plane(surface.triangle(triangle), least_height);
        for side in 0..3 {
            fans[fan as usize].add_normal(surface.normal(3 * triangle + side));
        }
    }
    for (triangle, fan) in members {
        fans[fan as usize].add_lean(surface.triangle(triangle));
        for point in surface.triangle(triangle) {
            let distance = fans[fan as usize].distance(point);
            let off_plane = &mut fans[fan as usize].off_plane;
            *off_plane = off_plane.max(distance);
        }
    }
    fans
}

impl Fan {
    /// The fan that a triangle is by itself.
    fn of_triangle(surface: &Surface, triangle: u32, least_height: f64) -> Fan {
        let mut fan = Fan::default();
        fan.add_plane(surface.triangle(triangle), least_height);
        (0..3).for_each(|side| fan.add_normal(surface.normal(3 * triangle + side)));
        fan
    }

    fn add_plane(&mut self, triangle: [DVec3; 3], least_height: f64) {
        let Some(normal) = normal_with_area(triangle) else { return };
        let area = normal.length();
        if is_low(triangle, least_height) {
            return;
        }
        if self.plane.is_none_or(|(_, _, largest)| area > largest) {
            self.plane = Some((triangle[0], normal / area, area));
        }
    }

    fn add_lean(&mut self, triangle: [DVec3; 3]) {
        let normal = normal_with_area(triangle).map(DVec3::normalize);
        if let (Some((_, plane, _)), Some(normal)) = (self.plane, normal) {
            self.leans |= plane.dot(normal) < FLAT_COSINE;
        }
    }

    fn add_normal(&mut self, normal: DVec3) {
        let first = *self.normal.get_or_insert(normal);
        self.has_uneven_normals |= first != normal;
        self.shades_curved |= first.distance(normal) > CURVED_SHADING;
    }

    /// How far a point is off the plane; 0 without one.
    fn distance(&self, point: DVec3) -> f64 {
        self.plane.map_or(0.0, |(origin, normal, _)| normal.dot(point - origin).abs())
    }

    /// Whether a normal differs from the one that the whole fan had.
    fn bends(&self, normal: DVec3) -> bool {
        let kept = self.normal.filter(|&kept| !self.has_uneven_normals && is_unit(kept));
        kept.is_some_and(|kept| kept.normalize().distance(normal.normalize()) > NORMAL_TOLERANCE)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check::compare;
    use crate::mesh::{Mesh, MeshBuffers};
    use crate::options::Verify;

    fn triangles(positions: &[[f32; 3]], normals: &[[f32; 3]], indices: &[u32]) -> MeshBuffers {
        MeshBuffers {
            positions: positions.to_vec(),
            normals: normals.to_vec(),
            indices: indices.to_vec(),
            submesh_index_counts: vec![indices.len() as u32],
            ..MeshBuffers::default()
        }
    }

    //  A-----------B     the faces below have one normal, those above another one, a hair off it: at M, in
    //  A--M--------B     the middle of the long side, it is one surface, and may have either
    #[test]
    fn a_fan_goes_on_over_a_long_side_that_its_corner_stands_on() {
        let places = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [2.0, 3.0, 0.0]];
        let below = [[0.0, 0.0, 0.0], [0.0, -3.0, 0.0], [1.0, 0.0, 0.0], [4.0, 0.0, 0.0]];
        let (up, leaning) = ([0.0, 0.0, 1.0], [3e-6, 0.0, 1.0]);
        let normals = [[up; 3].to_vec(), [leaning; 4].to_vec()].concat();
        let indices = [0, 1, 2, 3, 4, 5, 5, 4, 6];
        let before = triangles(&[&places[..], &below].concat(), &normals, &indices);
        let with = |vertex: usize| {
            let mut after = before.clone();
            after.normals[vertex] = up;
            compare(&before.as_mesh(), &after.as_mesh(), Verify::Fast).count(Rule::FlatNormal)
        };
        let [middle, away] = [5, 4];
        assert_eq!((with(middle), with(away)), (0, 2));
    }

    //  .---.      under the face lies a line, whose normals lean by so much: where it opens below, what it
    //  |  /       shows there is the face, and its upper corners may keep what is one with that
    //  | /
    //  '=======
    #[test]
    fn a_line_that_opens_may_keep_normals_that_are_one_with_those_beside() {
        let face = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        let line = |low: f32| [[1.0, 0.0, 0.0], [0.0, 0.0, 0.0], [0.5, low, 0.0]];
        let up = [0.0, 0.0, 1.0];
        for (lean, bent) in [(0.02, 0), (0.05, 1)] {
            let leans = DVec3::new(lean, 0.0, 1.0).normalize().as_vec3().to_array();
            let mesh = |low: f32, lowest: [f32; 3]| {
                let normals = [up, up, up, leans, leans, lowest];
                triangles(&[face, line(low)].concat(), &normals, &[0, 1, 2, 3, 4, 5])
            };
            let (before, after) = (mesh(-1e-7, leans), mesh(-0.1, up));
            let findings = compare(&before.as_mesh(), &after.as_mesh(), Verify::Fast);
            assert_eq!(findings.count(Rule::FlatNormal), bent, "{lean}: {findings}");
        }
    }

    //  o---.      the same where the face is shaded otherwise at `o` now: that is wrong of the face alone, as
    //  |  /       long as the line goes on with it
    //  o=======
    #[test]
    fn a_line_that_opens_is_shaded_as_the_face_beside_is_now() {
        let face = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        let line = |low: f32| [[1.0, 0.0, 0.0], [0.0, 0.0, 0.0], [0.5, low, 0.0]];
        let [up, aside, turned, other] =
            [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 0.6, 0.8], [0.6, 0.0, 0.8]];
        let mesh = |low: f32, normals: [[f32; 3]; 6]| {
            triangles(&[face, line(low)].concat(), &normals, &[0, 1, 2, 3, 4, 5])
        };
        let before = mesh(-1e-7, [up, up, up, aside, aside, aside]);
        for (end, bent) in [(turned, 1), (other, 2)] {
            let after = mesh(-0.1, [turned, up, up, up, end, up]);
            let findings = compare(&before.as_mesh(), &after.as_mesh(), Verify::Fast);
            assert_eq!(findings.count(Rule::FlatNormal), bent, "{end:?}");
        }
    }

    //  .---.      under the face lies a line: it may be shaded as that face, but not as nothing there is
    //  |  /
    //  | /
    //  '=======
    #[test]
    fn a_line_goes_on_with_the_faces_beside_it() {
        let face = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        let line = [[1.0, 0.0, 0.0], [0.0, 0.0, 0.0], [0.5, -1e-7, 0.0]];
        let (up, aside) = ([0.0, 0.0, 1.0], [1.0, 0.0, 0.0]);
        let normals = [[up; 3], [aside; 3]].concat();
        let mesh = triangles(&[face, line].concat(), &normals, &[0, 1, 2, 3, 4, 5]);
        let mesh: Mesh = mesh.as_mesh();
        let (surface, beside) = (Surface::new(&mesh), Beside::default());
        let goes_on = |line: u32, normal: DVec3| {
            beside.any(&surface, line, |face| is_between(&surface, face, normal))
        };
        assert!(goes_on(1, DVec3::Z));
        assert!(!goes_on(1, DVec3::Y));
        assert!(!goes_on(0, DVec3::X), "the face is no line");
    }
}
