//! What came in is still there: the surface of the source and its values, by place.
//!
//! A triangle that is not a chamfer lies on the source's surface, and has at each corner the values
//! that the source has there, be it cut into triangles otherwise. What is new keeps near, and faces
//! the same way; its numbers may go on from far across a seam. And the whole surface of the source is there, but for what chamfers take.

use std::iter::empty;

use glam::DVec3;

use super::ground::{Foot, Ground, at};
use super::junctions::{Borders, reach};
use super::origins::Origins;
use super::rules::{Element, Findings, Rule};
use super::stored::{height, normal_with_area};
use super::streams::{ExtraStream, Slack, Stream};
use super::surface::{HalfEdge, Surface};
use super::widths::{Ruler, distance_from_line};

/// The cosine of the angle (a quarter of a degree) by which a triangle may lean that lies flat on
/// another one: a chamfer leans by half of what the faces beside it do.
const FLAT_COSINE: f64 = 0.999_99;

/// Unit normals that differ by less than this (half a degree) are certainly not those of an edge to
/// be chamfered, unless a smaller angle makes edges hard.
const SMOOTH: f64 = 0.009;

/// Where a surface is curved, a triangle whose corners moved may be off it by this share of how far
/// they moved. No vertex goes farther than three widths.
const REACH: f64 = 3.0;

/// What is known of two meshes besides their streams.
#[derive(Clone, Copy, Debug, Default)]
#[non_exhaustive]
pub struct Extras<'a> {
    /// The number of each submesh's material (`#submeshes`), of the source and of the result: the
    /// same number is the same material. None where nobody knows.
    pub materials: Option<[&'a [u32]; 2]>,
    /// Further values of the vertices.
    pub streams: &'a [ExtraStream<'a>],
    /// How the mesh stands where it is looked at, as in [`Options::scale`](crate::Options::scale):
    /// there edges are hard or not, and new triangles have to face along with their normals. None where
    /// it stands as it is.
    pub scale: Option<[[f32; 3]; 3]>,
    /// Normals are one that differ by less than this, in degrees, as in
    /// [`Options::hard_angle`](crate::Options::hard_angle). None where that is the default.
    pub hard_angle: Option<f32>,
}

impl<'a> Extras<'a> {
    /// The same with materials.
    pub fn with_materials(self, materials: [&'a [u32]; 2]) -> Extras<'a> {
        Extras { materials: Some(materials), ..self }
    }

    /// The same for a mesh that stands scaled.
    pub fn with_scale(self, scale: Option<[[f32; 3]; 3]>) -> Extras<'a> {
        Extras { scale, ..self }
    }

    /// The same where another angle makes an edge hard.
    pub fn with_hard_angle(self, hard_angle: Option<f32>) -> Extras<'a> {
        Extras { hard_angle, ..self }
    }

    /// The same with further values of the vertices.
    pub fn with_streams(self, streams: &'a [ExtraStream<'a>]) -> Extras<'a> {
        Extras { streams, ..self }
    }
}

/// Notes whatever is elsewhere, otherwise, or gone.
pub(super) fn check_carried(
    [before, after]: [&Surface; 2],
    (origins, ruler): (&Origins, &Ruler),
    extras: &Extras,
    findings: &mut Findings,
) {
    if before.triangle_count() == 0 || after.triangle_count() == 0 {
        return;
    }
    let corners = 0..before.mesh.indices.len() as u32;
    let mut corners_at: Vec<_> = corners.map(|c| (before.cluster(c), c)).collect();
    corners_at.sort_unstable();
    let mut pieces: Vec<_> = (0u32..).zip(&origins.triangles).filter_map(piece).collect();
    pieces.sort_unstable();
    let source = Ground::new(before);
    let carried = Carried {
        corners_at,
        pieces,
        is_any_lost: findings.lost > 0,
        after,
        origins,
        streams: Stream::all([before.mesh, after.mesh], extras.streams),
        tolerance: source.tolerance,
        reach: REACH * largest_pull([before, after], origins, ruler),
        source,
    };
    let is_kept = carried.kept();
    carried.check_vertices(&is_kept, findings);
    carried.check_middles(&is_kept, extras, findings);
    carried.check_covered(findings);
}

/// The triangle of the source that one of the result is a piece of, and that one.
fn piece((triangle, origin): (u32, &Option<[u32; 3]>)) -> Option<(u32, u32)> {
    origin.map(|[first, ..]| (first / 3, triangle))
}

/// How far anything was pulled from its edge at most: a side of one, or what a cut has added there, as
/// an edge may be open there alone.
fn largest_pull(surfaces: [&Surface; 2], origins: &Origins, ruler: &Ruler) -> f64 {
    pull_of_sides(surfaces[0], ruler).max(pull_of_cuts(surfaces, origins))
}

/// Of each side, whichever other one it is chamfered with: at an edge of many, who can tell? And of those
/// that lie on each other though they share no edge.
fn pull_of_sides(before: &Surface, ruler: &Ruler) -> f64 {
    let may_open = |edge: &(&[HalfEdge], &[HalfEdge])| {
        edge.0.len() + edge.1.len() > 2 || before.is_hard(edge) || before.may_be_hard(edge)
    };
    let sides = before.edges().filter(may_open).flat_map(|(a, b)| a.iter().chain(b));
    let borders = Borders::new(before);
    sides.chain(borders.pairs().flatten()).map(|side| ruler.pull(side)).fold(0.0, f64::max)
}

fn pull_of_cuts([before, after]: [&Surface; 2], origins: &Origins) -> f64 {
    let corners = || 0..after.mesh.indices.len() as u32;
    let source = |corner: u32| origins.triangles[corner as usize / 3];
    let mut is_at_chamfer = vec![false; after.mesh.positions.len()];
    for corner in corners().filter(|&corner| source(corner).is_none()) {
        is_at_chamfer[after.cluster(corner) as usize] = true;
    }
    let is_added = |corner: &u32| {
        is_at_chamfer[after.cluster(*corner) as usize] && origins.own_corner(*corner).is_none()
    };
    let pull = |corner: u32| {
        let [first, ..] = source(corner)?;
        Some(distance_from_sides(before.triangle(first / 3), after.position(corner)))
    };
    corners().filter(is_added).filter_map(pull).fold(0.0, f64::max)
}

/// How far a point is from the nearest line along a side of a triangle.
fn distance_from_sides(corners: [DVec3; 3], point: DVec3) -> f64 {
    let distance = |k: usize| distance_from_line([corners[k], corners[(k + 1) % 3]], point);
    distance(0).min(distance(1)).min(distance(2))
}

struct Carried<'a> {
    source: Ground<'a>,
    after: &'a Surface<'a>,
    origins: &'a Origins<'a>,
    streams: Vec<Stream<'a>>,
    /// Sorted: the cluster of each corner of the source, and the corner.
    corners_at: Vec<(u32, u32)>,
    /// Sorted: the triangle of the source of each of the result that has one, and that one.
    pieces: Vec<(u32, u32)>,
    /// Whether some triangles of the source are not found, and may be among the others.
    is_any_lost: bool,
    /// How far off the surface counts as on it.
    tolerance: f64,
    /// How far what is new may be from the source.
    reach: f64,
}

/// What is broken at a vertex.
enum Judgement {
    /// There is no surface of the source.
    Elsewhere,
    /// None of the places there has the value of these streams.
    Otherwise(Vec<Rule>),
}

impl Carried<'_> {
    /// `#triangles`: whether each is one of the source, whole or in part, or lies flat on some.
    fn kept(&self) -> Vec<bool> {
        let origins = self.origins.triangles.iter().enumerate();
        let is_kept = |(t, origin): (usize, &Option<_>)| {
            origin.is_some() || self.is_any_lost && self.lies_flat(t as u32)
        };
        origins.map(is_kept).collect()
    }

    fn lies_flat(&self, triangle: u32) -> bool {
        let corners = self.after.triangle(triangle);
        let Some(normal) = normal_with_area(corners) else { return false };
        let is_flat = |foot: &Foot| {
            let was = normal_with_area(self.source.surface.triangle(foot.triangle));
            was.is_some_and(|was| was.normalize().dot(normal.normalize()).abs() > FLAT_COSINE)
        };
        let middle = at(corners, [1.0 / 3.0; 3]);
        let mut below = self.source.near(middle, self.tolerance).filter(is_flat);
        let holds = |foot: Foot| {
            let on_plane = |c: &DVec3| self.source.on_plane(foot.triangle, *c, self.tolerance);
            corners.iter().all(|corner| on_plane(corner).is_some())
        };
        below.any(holds)
    }

    /// Each vertex once: of those that are kept first, as these are judged more strictly.
    fn check_vertices(&self, is_kept: &[bool], findings: &mut Findings) {
        let mut is_judged = vec![false; self.after.mesh.positions.len()];
        for kept in [true, false] {
            for triangle in (0u32..).zip(is_kept).filter(|(_, k)| **k == kept).map(|(t, _)| t) {
                for corner in 3 * triangle..3 * triangle + 3 {
                    let vertex = self.after.vertex(corner);
                    if std::mem::replace(&mut is_judged[vertex], true) {
                        continue;
                    }
                    let judged =
                        if kept { self.judge_kept(corner) } else { self.judge_new(corner) };
                    note(judged, vertex as u32, findings);
                }
            }
        }
    }

    fn judge_kept(&self, corner: u32) -> Result<(), Judgement> {
        let point = self.after.position(corner);
        let facing = normal_with_area(self.after.triangle(corner / 3));
        let own = self.origins.triangles[corner as usize / 3];
        // The vertex at whose place a cut has added one may have been a little off the triangle.
        let tolerance = match self.origins.own_corner(corner) {
            None if own.is_some() => self.tolerance.max(reach(self.source.surface)),
            _ => self.tolerance,
        };
        // One after the other as they are asked for: very many may meet at a corner.
        let around = || own.into_iter().flatten().flat_map(|corner| self.around(corner));
        let on_plane = |triangle, reach| self.source.on_plane(triangle, point, reach);
        let first = own.into_iter().map(|[first, ..]| first / 3);
        let exact = first.chain(around());
        let exact = exact.filter_map(|triangle| on_plane(triangle, tolerance));
        let near = self.source.near_along(facing, point, tolerance);
        // Where the texture breaks on the way, the values go on beyond the side that is the corner's.
        let beyond = around().filter_map(|triangle| on_plane(triangle, self.reach));
        self.judge(corner, exact.chain(near), beyond, |foot| {
            Slack::Exact(self.share(foot, tolerance))
        })
    }

    /// The triangles around a corner of the source, which slides over them.
    fn around(&self, corner: u32) -> impl Iterator<Item = u32> {
        let cluster = self.source.surface.cluster(corner);
        those_of(&self.corners_at, cluster).map(|corner| corner / 3)
    }

    fn judge_new(&self, corner: u32) -> Result<(), Judgement> {
        let near = self.source.near(self.after.position(corner), self.reach + self.tolerance);
        self.judge(corner, near, empty(), |_| Slack::Near)
    }

    /// Whether a triangle is so low that it faces wherever rounding turns it.
    fn is_line(&self, corners: [DVec3; 3]) -> bool {
        height(corners) <= 2.0 * self.tolerance
    }

    /// How much of a triangle's spread a value may be off where a place may be off by a distance.
    fn share(&self, foot: &Foot, distance: f64) -> f64 {
        let height = height(self.source.surface.triangle(foot.triangle));
        if height > 0.0 { distance / height } else { 1.0 }
    }

    /// Whether there is a place at all, and each stream has its value at some of them, or of others
    /// that values, but not normals, may come from.
    fn judge(
        &self,
        corner: u32,
        places: impl Iterator<Item = Foot>,
        beyond: impl Iterator<Item = Foot>,
        slack: impl Fn(&Foot) -> Slack,
    ) -> Result<(), Judgement> {
        let vertex = self.after.vertex(corner);
        let mut open: Vec<&Stream> = self.streams.iter().collect();
        let mut places = places.peekable();
        if places.peek().is_none() {
            return Err(Judgement::Elsewhere);
        }
        let places = places.map(|foot| (foot, true));
        for (foot, is_there) in places.chain(beyond.map(|foot| (foot, false))) {
            let slack = slack(&foot);
            open.retain(|stream| {
                let may_be = is_there || stream.rule != Rule::Shading;
                !(may_be && stream.is_at(vertex, self.source.surface, foot, slack))
            });
            if open.is_empty() {
                return Ok(());
            }
        }
        Err(Judgement::Otherwise(open.iter().map(|stream| stream.rule).collect()))
    }

    /// In the middle, a triangle has the values of one chart and the material of the source.
    fn check_middles(&self, is_kept: &[bool], extras: &Extras, findings: &mut Findings) {
        let materials = extras
            .materials
            .map(|of| [materials(self.source.surface, of[0]), materials(self.after, of[1])]);
        for triangle in (0u32..).zip(is_kept).filter(|(_, k)| **k).map(|(t, _)| t) {
            let corners = self.after.triangle(triangle);
            let middle = at(corners, [1.0 / 3.0; 3]);
            let own = self.origins.triangles[triangle as usize].map(|[first, ..]| first / 3);
            let own_foot = own.map(|triangle| Foot { triangle, weights: [1.0 / 3.0; 3] });
            let feet = || own_foot.into_iter().chain(self.source.near(middle, self.tolerance));
            let is_same = |[before, after]: &[Vec<u32>; 2]| {
                let now = after[triangle as usize];
                feet().any(|foot| before[foot.triangle as usize] == now)
            };
            if materials.as_ref().is_some_and(|materials| !is_same(materials)) {
                findings.note(Rule::Materials, Element::Triangle(triangle));
            }
        }
    }

    /// Each triangle of the source has something at its middle; what its corners may have bent, near it.
    fn check_covered(&self, findings: &mut Findings) {
        let result = Ground::new(self.after);
        let may_move = may_move(self.source.surface);
        for triangle in 0..self.source.surface.triangle_count() {
            let corners = self.source.surface.triangle(triangle);
            let Some(normal) = normal_with_area(corners) else { continue };
            if self.is_line(corners) {
                continue;
            }
            let middle = at(corners, [1.0 / 3.0; 3]);
            let faces = |foot: &Foot| {
                let now = normal_with_area(self.after.triangle(foot.triangle));
                now.is_some_and(|now| now.dot(normal) > 0.0)
            };
            let moves = (3 * triangle..3 * triangle + 3)
                .any(|corner| may_move[self.source.surface.cluster(corner) as usize]);
            // Where edges are crowded, nobody can tell how far the faces beside them are pulled.
            let may_be_anywhere = moves && findings.before.non_manifold_edges > 0;
            let reach = if moves { self.reach + self.tolerance } else { self.tolerance };
            // Its own pieces first: the boxes of slanted ones overlap by the thousand.
            let mut own = those_of(&self.pieces, triangle)
                .filter_map(|piece| result.within(piece, middle, reach));
            let is_there = |reach: f64| result.near(middle, reach).any(|foot| faces(&foot));
            let mut is_covered =
                || own.any(|foot| faces(&foot)) || is_there(self.tolerance) || is_there(reach);
            if !may_be_anywhere && !is_covered() {
                findings.note(Rule::Covered, Element::SourceTriangle(triangle));
            }
        }
    }
}

/// What is paired with a key in sorted pairs.
fn those_of(pairs: &[(u32, u32)], key: u32) -> impl Iterator<Item = u32> {
    let first = pairs.partition_point(|&(other, _)| other < key);
    pairs[first..].iter().take_while(move |(other, _)| *other == key).map(|&(_, value)| value)
}

fn note(judged: Result<(), Judgement>, vertex: u32, findings: &mut Findings) {
    match judged {
        Ok(()) => {}
        Err(Judgement::Elsewhere) => findings.note(Rule::Place, Element::Vertex(vertex)),
        Err(Judgement::Otherwise(rules)) => {
            rules.into_iter().for_each(|rule| findings.note(rule, Element::Vertex(vertex)));
        }
    }
}

/// `#triangles`: the material of each.
fn materials(surface: &Surface, of_submesh: &[u32]) -> Vec<u32> {
    let counts = surface.mesh.submesh_index_counts.iter().zip(of_submesh);
    let mut materials: Vec<u32> = counts
        .flat_map(|(&count, &material)| std::iter::repeat_n(material, count as usize / 3))
        .collect();
    materials.resize(surface.mesh.indices.len() / 3, u32::MAX);
    materials
}

/// `#clusters`: whether a vertex there may move: hard edges and borders end there, or a line does,
/// which closes the gap to one that does.
fn may_move(surface: &Surface) -> Vec<bool> {
    let mut may_move = vec![false; surface.mesh.positions.len()];
    for edge in surface.edges() {
        let is_smooth = match edge {
            ([one], [other]) => (0..2).all(|end| {
                let [a, b] = [one.corners[end], other.corners[1 - end]].map(|c| surface.shading(c));
                a.distance(b) < SMOOTH && !surface.may_be_hard(&edge)
            }),
            _ => false,
        };
        if !is_smooth {
            for half_edge in edge.0.iter().chain(edge.1) {
                half_edge.clusters.iter().for_each(|&c| may_move[c as usize] = true);
            }
        }
    }
    may_move
}
