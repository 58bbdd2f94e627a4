//! Source triangles that were cut, because a hard edge beside them got vertices.

use std::cell::OnceCell;
use std::collections::{BTreeMap, BTreeSet};

use glam::DVec3;

use super::ground::Ground;
use super::stored::normal_with_area;
use super::surface::Surface;

use crate::report::Piece;

/// How far the areas of all pieces may be off that of their triangle, as a share of it: their
/// weights are stored in single precision.
const AREA_TOLERANCE: f64 = 1e-4;

/// How much farther than from each other the normals of a piece may be from those of its triangle:
/// a corner that slides over its fan takes the normal from there. Across a hard edge it is more.
const SAME_SHADING: f64 = 0.012;

/// By triangles, those that are pieces of source triangles.
pub(super) type Cuts = BTreeMap<u32, Cut>;

/// What is known of a triangle that is a piece of another one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Cut {
    /// Which of its corners are those of the source triangle.
    pub is_own: [bool; 3],
}

impl Cut {
    pub fn told(piece: &Piece) -> Cut {
        let is_own = |k: usize| piece.corners[k] == own_weights(k);
        Cut { is_own: [0, 1, 2].map(is_own) }
    }
}

fn own_weights(place: usize) -> [f32; 3] {
    std::array::from_fn(|k| f32::from(u8::from(k == place)))
}

/// Whether a source triangle is there once, or in pieces that are told and cover it: none is
/// turned, together they are as large, and each corner of the triangle is one of some piece.
/// `origins: #triangles`, the source triangle of each.
pub(super) fn is_covered(sources: usize, origins: &[Option<u32>], pieces: &[Piece]) -> bool {
    let mut whole = vec![0_u32; sources];
    for &origin in origins.iter().flatten() {
        whole[origin as usize] += 1;
    }
    let mut cut: BTreeMap<u32, (f64, [bool; 3])> = BTreeMap::new();
    let mut named = BTreeSet::new();
    for piece in pieces {
        let Some(&Some(source)) = origins.get(piece.triangle as usize) else { return false };
        let area = share_of_area(piece);
        let is_inside = piece.corners.as_flattened().iter().all(|weight| *weight >= 0.0);
        if area <= 0.0 || !is_inside || !named.insert(piece.triangle) {
            return false;
        }
        whole[source as usize] -= 1;
        let (sum, has) = cut.entry(source).or_default();
        *sum += area;
        let is_own = Cut::told(piece).is_own;
        *has = [0, 1, 2].map(|k| has[k] || is_own[k]);
    }
    let is_once = |(source, count): (u32, &u32)| match cut.get(&source) {
        None => *count == 1,
        Some((sum, has)) => *count == 0 && (sum - 1.0).abs() < AREA_TOLERANCE && *has == [true; 3],
    };
    (0u32..).zip(&whole).all(is_once)
}

/// How much of the source triangle a piece is.
fn share_of_area(piece: &Piece) -> f64 {
    let [a, b, c] = piece.corners.map(|weights| DVec3::from(weights.map(f64::from)));
    a.dot(b.cross(c))
}

/// Where nothing is told, finds the pieces of each source triangle: the first one stands in its
/// place, the others right behind all source triangles of the submesh, in the order of these, each
/// beside an earlier one. Sets what they come from.
pub(super) fn pieces_in_order(surfaces: [&Surface; 2], triangles: &mut [Option<[u32; 3]>]) -> Cuts {
    let [before, after] = surfaces;
    let beside = beside(after, triangles);
    let mut patches = Patches { surfaces, ground: OnceCell::new(), of: BTreeMap::new() };
    let (mut first, mut start) = (0, 0);
    for (submesh, &indices) in after.mesh.submesh_index_counts.iter().enumerate() {
        let sources = before.mesh.submesh_index_counts.get(submesh).map_or(0, |count| count / 3);
        let mut least = first;
        for piece in start + sources..start + indices / 3 {
            let neighbours = beside.get(&piece).into_iter().flatten();
            let may_be = neighbours.filter_map(|&other| Some(triangles[other as usize]?[0] / 3));
            let may_be = may_be.filter(|&source| source >= least);
            let first_piece = |source: u32| start + source - first;
            let Some(source) = patches.likeliest(piece, may_be, first_piece) else { break };
            patches.add(piece, source, first_piece);
            triangles[piece as usize] = Some([0, 1, 2].map(|side| 3 * source + side));
            least = source;
        }
        (first, start) = (first + sources, start + indices / 3);
    }
    for stray in patches.trim(triangles) {
        triangles[stray as usize] = None;
    }
    patches.cuts()
}

/// Source triangles in pieces, as far as they are found.
struct Patches<'a> {
    surfaces: [&'a Surface<'a>; 2],
    /// That of the source, once it is asked for.
    ground: OnceCell<Ground<'a>>,
    /// By source triangle, its pieces.
    of: BTreeMap<u32, Vec<u32>>,
}

impl Patches<'_> {
    /// Which of several source triangles a piece is of; none if of none.
    fn likeliest(
        &self,
        piece: u32,
        sources: impl Iterator<Item = u32>,
        first_piece: impl Fn(u32) -> u32,
    ) -> Option<u32> {
        let grown = |source: u32| {
            let alone = [first_piece(source)];
            let patch = self.of.get(&source).map_or(&alone[..], |patch| patch);
            let with = [patch, &[piece]].concat();
            let [now, then] = [patch, &with].map(|patch| misfit(self.surfaces, source, patch));
            (then - now, source)
        };
        let may_be = |&source: &u32| {
            is_shaded_as(self.surfaces, source, piece) && self.lies_on(source, piece)
        };
        let grown = sources.filter(may_be).map(grown);
        grown.min_by(|one, other| one.0.total_cmp(&other.0)).map(|(_, source)| source)
    }

    /// Whether a piece lies on its triangle or on the surface around: rows of a rounded chamfer beside
    /// a face that is shaded as a curved one are shaded like it, but do not.
    fn lies_on(&self, source: u32, piece: u32) -> bool {
        let [before, after] = self.surfaces;
        let ground = self.ground.get_or_init(|| Ground::new(before));
        let facing = normal_with_area(after.triangle(piece));
        let is_on = |point| {
            ground.on_plane(source, point, ground.tolerance).is_some()
                || ground.near_along(facing, point, ground.tolerance).next().is_some()
        };
        after.triangle(piece).into_iter().all(is_on)
    }

    fn add(&mut self, piece: u32, source: u32, first_piece: impl Fn(u32) -> u32) {
        self.of.entry(source).or_insert_with(|| vec![first_piece(source)]).push(piece);
    }

    /// Takes back all pieces of triangles that are whole. The rows of a rounded chamfer between faces that
    /// hardly bend lie on the surface, too, and are shaded like it.
    fn trim(&mut self, triangles: &[Option<[u32; 3]>]) -> Vec<u32> {
        let whole = Whole::new(self.surfaces, triangles, &self.of);
        let mut strays = Vec::new();
        self.of.retain(|&source, patch| {
            let is_whole = whole.is_whole(source, patch[0]);
            strays.extend(patch[1..].iter().filter(|_| is_whole));
            !is_whole
        });
        strays
    }

    fn cuts(&self) -> Cuts {
        let mut cuts = Cuts::new();
        for patch in self.of.values() {
            let own = OwnPlaces::new(self.surfaces[1], patch);
            cuts.extend(patch.iter().map(|&piece| (piece, own.cut(piece))));
        }
        cuts
    }
}

/// Where the corners of source triangles without pieces are.
struct Whole<'a> {
    surfaces: [&'a Surface<'a>; 2],
    /// The clusters of each corner in the source and in the result.
    places: BTreeSet<[u32; 2]>,
}

impl<'a> Whole<'a> {
    fn new(
        surfaces: [&'a Surface<'a>; 2],
        triangles: &[Option<[u32; 3]>],
        patches: &BTreeMap<u32, Vec<u32>>,
    ) -> Whole<'a> {
        let mut places = BTreeSet::new();
        for (triangle, corners) in (0u32..).zip(triangles).filter(|_| !patches.is_empty()) {
            let corners = corners.filter(|[first, ..]| !patches.contains_key(&(first / 3)));
            for (side, source) in (0..3).zip(corners.into_iter().flatten()) {
                places.insert(Whole::place(surfaces, source, 3 * triangle + side));
            }
        }
        Whole { surfaces, places }
    }

    fn place([before, after]: [&Surface; 2], source: u32, corner: u32) -> [u32; 2] {
        [before.cluster(source), after.cluster(corner)]
    }

    /// Whether all corners of a source triangle's first piece are where those of others went that are not
    /// cut: what a cut has added is where no corner goes.
    fn is_whole(&self, source: u32, first_piece: u32) -> bool {
        let place = |side| Whole::place(self.surfaces, 3 * source + side, 3 * first_piece + side);
        (0..3).all(|side| self.places.contains(&place(side)))
    }
}

/// By new triangle, those that it continues smoothly.
fn beside(after: &Surface, triangles: &[Option<[u32; 3]>]) -> BTreeMap<u32, Vec<u32>> {
    let mut beside: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
    for (forward, backward) in after.edges() {
        let is_alone = forward.len() == 1 && backward.len() == 1;
        for (one, other) in forward.iter().flat_map(|one| backward.iter().map(move |b| (one, b))) {
            let are_same =
                |end: usize| after.vertex(one.corners[end]) == after.vertex(other.corners[1 - end]);
            if (are_same(0) && are_same(1)) || (is_alone && after.is_soft(one, other)) {
                let pair = [one, other].map(|half_edge| half_edge.corners[0] / 3);
                for [one, other] in [pair, [pair[1], pair[0]]] {
                    if triangles[one as usize].is_none() {
                        beside.entry(one).or_default().push(other);
                    }
                }
            }
        }
    }
    beside
}

/// Whether all normals of a piece may be blends of those of a source triangle, and it faces the
/// same way.
fn is_shaded_as([before, after]: [&Surface; 2], source: u32, piece: u32) -> bool {
    let old = [0, 1, 2].map(|side| before.shading(3 * source + side).normalize_or_zero());
    let spread = (0..3).map(|k| old[k].distance(old[(k + 1) % 3])).fold(0.0, f64::max);
    let is_near = |side: u32| {
        let new = after.shading(3 * piece + side).normalize_or_zero();
        old.iter().all(|old| old.distance(new) <= spread + SAME_SHADING)
    };
    let normals = [before.triangle(source), after.triangle(piece)].map(normal_with_area);
    let [Some(was), Some(is)] = normals else { return false };
    was.dot(is) > 0.0 && (0..3).all(is_near)
}

/// By how much the corners of a source triangle would be off their old places if these were its
/// pieces. Its own ones bring them nearer in the end; one of another triangle takes them away.
fn misfit([before, after]: [&Surface; 2], source: u32, patch: &[u32]) -> f64 {
    let own = OwnPlaces::new(after, patch);
    let corners = before.triangle(source);
    let longest = (0..3).map(|k| corners[k].distance(corners[(k + 1) % 3])).fold(0.0, f64::max);
    let off = |side: usize| match own.at(side) {
        Some(corner) => after.position(corner).distance(corners[side]),
        None => longest,
    };
    off(0) + off(1) + off(2)
}

/// Which corners of pieces are those of their triangle: such a one has the same place in all pieces
/// that it is in, while what a cut has added stands on both sides of it.
struct OwnPlaces<'a> {
    after: &'a Surface<'a>,
    /// By cluster, the places that it has, and a corner there.
    places: BTreeMap<u32, ([bool; 3], u32)>,
}

impl OwnPlaces<'_> {
    fn new<'a>(after: &'a Surface, patch: &[u32]) -> OwnPlaces<'a> {
        let mut places = BTreeMap::new();
        for corner in patch.iter().flat_map(|&piece| 3 * piece..3 * piece + 3) {
            let (has, _) = places.entry(after.cluster(corner)).or_insert(([false; 3], corner));
            has[corner as usize % 3] = true;
        }
        OwnPlaces { after, places }
    }

    /// The corner that has one place only, if there is one such.
    fn at(&self, side: usize) -> Option<u32> {
        let only = std::array::from_fn(|k| k == side);
        let mut own = self.places.values().filter(|(has, _)| *has == only);
        own.next().filter(|_| own.next().is_none()).map(|&(_, corner)| corner)
    }

    fn cut(&self, piece: u32) -> Cut {
        let is_own = |side: u32| {
            let (has, _) = self.places[&self.after.cluster(3 * piece + side)];
            has.iter().filter(|is_used| **is_used).count() == 1
        };
        Cut { is_own: [0, 1, 2].map(is_own) }
    }
}
