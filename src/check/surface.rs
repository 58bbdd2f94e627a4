//! A mesh welded by position: its edges, borders and connected parts.

use super::noise::Step;
use super::stored::{axes, farthest, height, normal_with_area, normals_to, vector};
use crate::groups::Groups;
use crate::mesh::Mesh;
use glam::{DMat3, DVec3};

/// The angle in degrees by which normals may differ across an edge that is not hard, where nothing
/// else is told: what quantized ones differ by.
const HARD_ANGLE: f32 = 1.0;

/// So much more keeps this limit clear of any other near it: half a degree for the usual angle, and for
/// any larger one.
const CLEAR_SHARE: f64 = 0.5;
const MOST_CLEAR: f64 = 0.5;

/// Normals as far off each other as this share of the angle may be that far in single precision.
const BARE_SHARE: f64 = 0.999;

/// How far a position may be off by rounding alone, relative to the largest coordinate: a few of
/// the smallest steps of single precision.
const ROUNDING: f64 = 4.0 * f32::EPSILON as f64;

/// How far a unit normal may be off by rounding alone.
const NORMAL_ROUNDING: f64 = 4.0 * f32::EPSILON as f64;

/// The same for coordinates below the normal range, whose steps are all of one size.
const LEAST_ROUNDING: f64 = 4.0 * f32::from_bits(1) as f64;

/// One side of a triangle.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct HalfEdge {
    /// The clusters at its ends, the smaller first.
    pub clusters: [u32; 2],
    /// Whether it runs from the greater to the smaller.
    pub reversed: bool,
    /// The corners (three times the triangle, plus 0 to 2) that it starts and ends at.
    pub corners: [u32; 2],
}

/// How a mesh that is looked at stretched stands.
#[derive(Clone, Copy)]
struct Standing {
    to: DMat3,
    normals_to: DMat3,
}

/// A mesh, welded. Places are those where it stands: a plane, a width and a side that a triangle faces
/// to are what they are there.
pub(super) struct Surface<'a> {
    /// The mesh; each corner in range.
    pub mesh: &'a Mesh<'a>,
    /// `#vertices`: the first vertex at the same position.
    cluster_of: Vec<u32>,
    /// Sorted, so that those of one edge stand together.
    half_edges: Vec<HalfEdge>,
    /// How far a position may be off by rounding alone, in mesh units.
    rounding: f64,
    /// To where the mesh stands, and how normals go along; none where it stands as it is.
    stands: Option<Standing>,
    /// The cosine of the angle by which normals may differ across an edge that is not hard.
    soft_cosine: f64,
    /// Of that from which on somebody may take it for hard.
    bare_cosine: f64,
    /// Of that by which they may where light does not break: that angle or the usual one, if that is less.
    even_cosine: f64,
    /// Sorted: the clusters of a round surface around which normals may differ by chance.
    round: Vec<u32>,
}

impl<'a> Surface<'a> {
    pub fn new(mesh: &'a Mesh<'a>) -> Surface<'a> {
        let cluster_of = weld(mesh.positions);
        let mut half_edges = Vec::with_capacity(mesh.indices.len());
        for corner in 0..mesh.indices.len() as u32 {
            let next = if corner % 3 == 2 { corner - 2 } else { corner + 1 };
            let [a, b] =
                [corner, next].map(|corner| cluster_of[mesh.indices[corner as usize] as usize]);
            // A triangle with two corners in one place is a line: that side is no edge.
            if a != b {
                let clusters = [a.min(b), a.max(b)];
                half_edges.push(HalfEdge { clusters, reversed: a > b, corners: [corner, next] });
            }
        }
        half_edges.sort_unstable();
        let (rounding, round) = (rounding(mesh), Vec::new());
        let [soft_cosine, even_cosine] = [soft_cosine(HARD_ANGLE); 2];
        let (bare_cosine, stands) = (bare_cosine(HARD_ANGLE), None);
        Surface {
            mesh,
            cluster_of,
            half_edges,
            rounding,
            stands,
            soft_cosine,
            bare_cosine,
            even_cosine,
            round,
        }
        .with_noise()
    }

    /// The same of a mesh that stands scaled so, column by column. Normals that are one there need not
    /// be so where the mesh comes from, nor need those that face along with a triangle.
    pub fn standing(self, scale: Option<[[f32; 3]; 3]>) -> Surface<'a> {
        let Some(to) = scale.map(axes) else { return self };
        let stands = Some(Standing { to, normals_to: normals_to(to) });
        let rounding = self.rounding * farthest(to);
        Surface { stands, rounding, ..self }.with_noise()
    }

    /// The same where normals are one that differ by less than so many degrees.
    pub fn hard_from(self, degrees: Option<f32>) -> Surface<'a> {
        let Some(degrees) = degrees else { return self };
        let (soft_cosine, bare_cosine) = (soft_cosine(degrees), bare_cosine(degrees));
        let even_cosine = soft_cosine.max(self.even_cosine);
        Surface { soft_cosine, bare_cosine, even_cosine, ..self }.with_noise()
    }

    fn with_noise(self) -> Surface<'a> {
        Surface { round: self.round_clusters(), ..self }
    }

    /// The half-edges of each welded edge: first those in one direction, then the others.
    pub fn edges(&self) -> impl Iterator<Item = (&[HalfEdge], &[HalfEdge])> {
        self.half_edges
            .chunk_by(|a, b| a.clusters == b.clusters)
            .map(|edge| edge.split_at(edge.partition_point(|half_edge| !half_edge.reversed)))
    }

    pub fn triangle_count(&self) -> u32 {
        self.mesh.indices.len() as u32 / 3
    }

    /// The position of a corner.
    pub fn position(&self, corner: u32) -> DVec3 {
        self.place(&self.mesh.positions[self.mesh.indices[corner as usize] as usize])
    }

    fn place(&self, stored: &[f32; 3]) -> DVec3 {
        let stored = vector(stored);
        self.stands.map_or(stored, |stands| stands.to * stored)
    }

    /// The largest side of the box around it.
    pub fn extent(&self) -> f64 {
        if self.stands.is_none() {
            return f64::from(self.mesh.extent());
        }
        let mut places = self.mesh.positions.iter().map(|stored| self.place(stored));
        let first = places.next().unwrap_or_default();
        let around = |[low, high]: [DVec3; 2], at: DVec3| [low.min(at), high.max(at)];
        let [low, high] = places.fold([first; 2], around);
        (high - low).max_element()
    }

    /// The normal of a corner.
    pub fn normal(&self, corner: u32) -> DVec3 {
        vector(&self.mesh.normals[self.mesh.indices[corner as usize] as usize])
    }

    /// The normal of a corner as it is seen: as it comes, or of length 1 where it is stretched.
    pub fn shading(&self, corner: u32) -> DVec3 {
        let stored = self.normal(corner);
        self.stands.map_or(stored, |stands| (stands.normals_to * stored).normalize_or_zero())
    }

    /// Where a triangle faces, as long as its area; none without area.
    pub fn facing(&self, triangle: u32) -> Option<DVec3> {
        normal_with_area(self.triangle(triangle))
    }

    /// The corners of a triangle, as positions.
    pub fn triangle(&self, triangle: u32) -> [DVec3; 3] {
        [0, 1, 2].map(|side| self.position(3 * triangle + side))
    }

    /// Whether two corners of a corner's triangle are at one position.
    pub fn is_collapsed(&self, corner: u32) -> bool {
        let first = corner - corner % 3;
        let [a, b, c] = [0, 1, 2].map(|side| self.cluster(first + side));
        a == b || b == c || c == a
    }

    /// How far a position may be off by rounding alone, in mesh units.
    pub fn rounding(&self) -> f64 {
        self.rounding
    }

    /// The cluster of a corner: the first vertex at its position.
    pub fn cluster(&self, corner: u32) -> u32 {
        self.cluster_of[self.mesh.indices[corner as usize] as usize]
    }

    /// The vertex of a corner.
    pub fn vertex(&self, corner: u32) -> usize {
        self.mesh.indices[corner as usize] as usize
    }

    /// `#vertices`: the first vertex at the same position.
    pub fn clusters(&self) -> &[u32] {
        &self.cluster_of
    }

    /// Whether two opposite half-edges have the same normals at both ends, but for noise.
    pub fn is_soft(&self, a: &HalfEdge, b: &HalfEdge) -> bool {
        [0, 1].iter().all(|&end| {
            self.share_normal([a.corners[end], b.corners[1 - end]])
                || self.round.binary_search(&self.cluster(a.corners[end])).is_ok()
                    && self.step(a, b, end).is_noise()
        })
    }

    /// Whether light breaks at some edges that are not hard.
    pub fn breaks_softly(&self) -> bool {
        self.soft_cosine < self.even_cosine
    }

    /// Whether light goes on from a half-edge to an opposite one.
    pub fn is_even(&self, a: &HalfEdge, b: &HalfEdge) -> bool {
        let is_even =
            |end: usize| self.share(self.even_cosine, [a.corners[end], b.corners[1 - end]]);
        is_even(0) && is_even(1)
    }

    /// Sorted: the clusters where some normals differ across an edge but by less than they are off
    /// their triangles, and none otherwise.
    fn round_clusters(&self) -> Vec<u32> {
        if self.mesh.normals.is_empty() {
            return Vec::new();
        }
        self.clusters_all(Step::is_round)
    }

    /// Sorted: the same for all that rounding leaves to be told.
    pub fn nearly_round(&self) -> Vec<u32> {
        self.clusters_all(Step::may_be_round)
    }

    /// Whether chance may have set the normals of two opposite half-edges apart, for all that rounding
    /// leaves to be told. `nearly_round`: as that tells.
    pub fn may_be_noise(&self, [a, b]: [&HalfEdge; 2], nearly_round: &[u32]) -> bool {
        [0, 1].iter().all(|&end| {
            self.share_normal([a.corners[end], b.corners[1 - end]])
                || nearly_round.binary_search(&self.cluster(a.corners[end])).is_ok()
                    && self.step(a, b, end).may_be_noise()
        })
    }

    /// Sorted: the clusters where some normals differ across an edge, and all that do differ so.
    fn clusters_all(&self, holds: fn(&Step) -> bool) -> Vec<u32> {
        let mut found = self.clusters_where(holds);
        if !found.is_empty() {
            let others = self.clusters_where(|step| !holds(step));
            found.retain(|cluster| others.binary_search(cluster).is_err());
        }
        found
    }

    /// Sorted: where a normal differs so from all of those across an edge.
    fn clusters_where(&self, holds: impl Fn(&Step) -> bool) -> Vec<u32> {
        let differs = |one: &HalfEdge, other: &HalfEdge, end: usize| {
            !self.share_normal([one.corners[end], other.corners[1 - end]])
                && holds(&self.step(one, other, end))
        };
        let mut found = Vec::new();
        for (forward, backward) in self.edges() {
            for (ones, others) in [(forward, backward), (backward, forward)] {
                for (one, end) in ones.iter().flat_map(|one| [(one, 0), (one, 1)]) {
                    if !others.is_empty() && others.iter().all(|other| differs(one, other, end)) {
                        found.push(self.cluster(one.corners[end]));
                    }
                }
            }
        }
        found.sort_unstable();
        found.dedup();
        found
    }

    fn step(&self, one: &HalfEdge, other: &HalfEdge, end: usize) -> Step {
        let [near, far] = [end, 1 - end].map(|end| [one.corners[end], other.corners[1 - end]]);
        let normals = |corners: [u32; 2]| corners.map(|at| self.shading(at).normalize_or_zero());
        let [a, b] = normals(far);
        let facing = |corner: u32| Some(self.facing(corner / 3)?.normalize());
        let facings = facing(near[0]).zip(facing(near[1])).map(|(one, other)| [one, other]);
        let turns = near.map(|corner| self.rounding / height(self.triangle(corner / 3)));
        let slack = turns[0].max(turns[1]) + NORMAL_ROUNDING;
        Step { normals: normals(near), facings, beyond: a - b, slack }
    }

    /// Whether the normals of two corners are one, as nearly as importers store them or the caller has said.
    pub fn share_normal(&self, corners: [u32; 2]) -> bool {
        self.share(self.soft_cosine, corners)
    }

    /// The same of a corner's normal and any other.
    pub fn shares_with(&self, corner: u32, normal: DVec3) -> bool {
        is_within(self.soft_cosine, self.shading(corner), normal)
    }

    fn share(&self, cosine: f64, corners: [u32; 2]) -> bool {
        let [a, b] = corners.map(|corner| self.shading(corner));
        is_within(cosine, a, b)
    }

    /// `#triangles`: the first triangle of the part that each is connected to across edges.
    pub fn components(&self) -> Vec<u32> {
        let mut parts = Groups::singles(self.mesh.indices.len() / 3);
        for edge in self.half_edges.chunk_by(|a, b| a.clusters == b.clusters) {
            for pair in edge.windows(2) {
                parts.join(pair[0].corners[0] / 3, pair[1].corners[0] / 3);
            }
        }
        parts.labels()
    }

    /// Whether an edge with two sides has a half-edge whose normals no opposite one shares.
    pub fn is_hard(&self, (forward, backward): &(&[HalfEdge], &[HalfEdge])) -> bool {
        let has_soft_partner = |a: &HalfEdge| backward.iter().any(|b| self.is_soft(a, b));
        !backward.is_empty() && !forward.iter().all(has_soft_partner)
    }

    /// Whether somebody may take an edge for hard: not all normals across are within the angle itself, be
    /// they so near to it that none has to.
    pub fn may_be_hard(&self, (forward, backward): &(&[HalfEdge], &[HalfEdge])) -> bool {
        let is_bare = |a: &HalfEdge, b: &HalfEdge| {
            let ends = [0, 1].map(|end| [a.corners[end], b.corners[1 - end]]);
            ends.into_iter().any(|corners| !self.share(self.bare_cosine, corners))
        };
        forward.iter().any(|a| backward.iter().any(|b| is_bare(a, b)))
    }

    /// How many sides there are on edges past the second of each.
    pub fn sides_past_two(&self) -> usize {
        self.edges().map(|(a, b)| (a.len() + b.len()).saturating_sub(2)).sum()
    }

    /// Whether no border touches a non-manifold edge.
    pub fn has_clear_borders(&self) -> bool {
        let mut on_border = vec![false; self.cluster_of.len()];
        for (a, b) in self.edges().filter(|(a, b)| a.len() != b.len()) {
            for cluster in a.iter().chain(b).flat_map(|half_edge| half_edge.clusters) {
                on_border[cluster as usize] = true;
            }
        }
        let touches =
            |half_edge: &HalfEdge| half_edge.clusters.iter().any(|&c| on_border[c as usize]);
        !self.edges().filter(is_non_manifold).any(|(a, b)| a.iter().chain(b).any(touches))
    }
}

fn is_within(cosine: f64, a: DVec3, b: DVec3) -> bool {
    a.dot(b) >= cosine * a.length() * b.length()
}

fn bare_cosine(hard_angle: f32) -> f64 {
    libm::cos((f64::from(hard_angle) * BARE_SHARE).to_radians())
}

fn soft_cosine(hard_angle: f32) -> f64 {
    let degrees = f64::from(hard_angle);
    libm::cos((degrees + (CLEAR_SHARE * degrees).min(MOST_CLEAR)).to_radians())
}

fn is_non_manifold((a, b): &(&[HalfEdge], &[HalfEdge])) -> bool {
    a.len() + b.len() > 2
}

fn rounding(mesh: &Mesh) -> f64 {
    let largest = mesh.positions.as_flattened().iter().map(|along| along.abs());
    (ROUNDING * f64::from(largest.fold(0.0, f32::max))).max(LEAST_ROUNDING)
}

/// `#vertices`: the first vertex at the same position, bit for bit (-0 = +0).
fn weld(positions: &[[f32; 3]]) -> Vec<u32> {
    // Adding zero makes one zero of the two.
    let key = |vertex: u32| positions[vertex as usize].map(|along| (along + 0.0).to_bits());
    let mut order: Vec<u32> = (0..positions.len() as u32).collect();
    order.sort_unstable_by_key(|&vertex| (key(vertex), vertex));
    let mut cluster_of = vec![0; positions.len()];
    for cluster in order.chunk_by(|&a, &b| key(a) == key(b)) {
        for &vertex in cluster {
            cluster_of[vertex as usize] = cluster[0];
        }
    }
    cluster_of
}
