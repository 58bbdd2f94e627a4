//! What is known of a finer mesh, from what is known of its source: only the pieces are new.
//!
//! How a triangle that gets vertices on its sides is cut into pieces.

use super::Refined;
use super::WHOLE;
use crate::contacts::Contacts;
use crate::edges::{Edges, HardEdge, parted, seam_channels};
use crate::error::Error;
use crate::faces::{Faces, own_normal};
use crate::ids::Few;
use crate::ids::{Cluster, Corner, Edge, Id, IdVec, Triangle};
use crate::report::Reason;
use crate::sectors::sectors;
use crate::shape::Shape;
use crate::topology::Topology;
use crate::view::View;
use crate::watch::Watch;
use crate::weld::Weld;

/// The same as the stages would find on the finer mesh, but for the numbers of clusters and edges.
/// None where two triangles share so much that it cannot be told which pieces belong together.
///
/// # Errors
/// [`Error::Cancelled`] where the watch stops it.
pub fn shape(
    fine: &View,
    refined: &Refined,
    coarse: &Shape,
    watch: &dyn Watch,
) -> Result<Option<Shape>, Error> {
    let weld = weld(refined, &coarse.weld);
    let Some(topology) = topology(fine, refined, &coarse.topology, &weld) else {
        return Ok(None);
    };
    let faces = faces(fine, refined, &coarse.faces);
    let contacts = coarse.contacts.renamed(|border| refined.whole_side(border));
    let edges = edges(fine, refined, (&topology, &faces, &contacts), &coarse.edges);
    let sectors = sectors(fine, &topology, &edges, &contacts, watch)?;
    Ok(Some(Shape { weld, topology, faces, contacts, edges, sectors }))
}

/// Each new site is a cluster.
fn weld(refined: &Refined, coarse: &Weld) -> Weld {
    let mut weld =
        Weld { cluster_of: coarse.cluster_of.clone(), first_vertex: coarse.first_vertex.clone() };
    for added in &refined.added {
        let vertex = weld.cluster_of.push(Cluster::NONE);
        let cluster = Cluster(coarse.first_vertex.len() as u32 + added.site);
        weld.cluster_of[vertex] = cluster;
        if cluster.index() == weld.first_vertex.len() {
            weld.first_vertex.push(vertex);
        }
    }
    weld
}

fn topology(fine: &View, refined: &Refined, coarse: &Topology, weld: &Weld) -> Option<Topology> {
    let renamed = |half_edge: Corner| refined.whole_side(half_edge);
    let mut all = Topology { clusters: weld.first_vertex.len(), ..coarse.renamed(&renamed) };
    let cluster = |corner: Corner| weld.cluster_of[fine.vertex_at(corner)];
    for _ in all.cluster_at.len()..fine.corner_count() {
        all.cluster_at.push(Cluster::NONE);
        all.twin.push(Corner::NONE);
    }
    let corners = || refined.pieces.iter().flat_map(|piece| piece.triangle.corners());
    corners().for_each(|corner| all.cluster_at[corner] = cluster(corner));
    all.has_collapsed |= refined.pieces.iter().any(|piece| all.is_collapsed(piece.triangle));
    let mut new: Vec<([Cluster; 2], Corner)> = Vec::new();
    for corner in corners() {
        match refined.whole_of(corner) {
            Some(source) => {
                let twin = coarse.twin[source];
                let twin = if twin.is_some() { renamed(twin) } else { twin };
                all.twin[corner] = twin;
                if twin.is_some() {
                    all.twin[twin] = corner;
                }
            }
            None => {
                let ends = [corner, corner.next()].map(|corner| all.cluster_at[corner]);
                new.push(([ends[0].min(ends[1]), ends[0].max(ends[1])], corner));
            }
        }
    }
    // All others have a new vertex at an end, and so lie on nothing but their twins.
    new.sort_unstable();
    for pair in new.chunk_by(|one, other| one.0 == other.0) {
        let &[(_, one), (_, other)] = pair else { return None };
        (all.twin[one], all.twin[other]) = (other, one);
    }
    Some(all)
}

fn faces(fine: &View, refined: &Refined, coarse: &Faces) -> Faces {
    let mut faces = Faces { normal: coarse.normal.clone(), lender: coarse.lender.clone() };
    for piece in &refined.pieces {
        let normal = own_normal(fine, piece.triangle);
        if piece.triangle.index() < faces.normal.len() {
            faces.normal[piece.triangle] = normal;
        } else {
            faces.normal.push(normal);
            faces.lender.push(Corner::NONE);
        }
    }
    let lenders = faces.lender.iter_mut().filter(|lender| lender.is_some());
    lenders.for_each(|lender| *lender = refined.whole_side(*lender));
    faces
}

/// The parts of an edge stand where it stood.
fn edges(
    fine: &View,
    refined: &Refined,
    (topology, faces, contacts): (&Topology, &Faces, &Contacts),
    coarse: &Edges,
) -> Edges {
    let mut edges = Edges {
        hard: IdVec::default(),
        chamfered_at: IdVec::filled(Edge::NONE, fine.corner_count()),
        // Lines are never cut.
        spanned: coarse.spanned.clone(),
        parted: Vec::new(),
    };
    for edge in coarse.hard.iter() {
        for side in refined.parts_of_side(edge.sides[0]) {
            let sides = [side, topology.twin[side]];
            let is_whole = refined.whole_of(side) == Some(edge.sides[0]);
            let frees = edge.skipped == Some(Reason::Contact)
                && !is_whole
                && !contacts.holds(fine, topology, faces, side);
            let skipped = if frees { None } else { edge.skipped };
            let seams = if is_whole { edge.seams } else { seam_channels(fine, sides[0], sides[1]) };
            let edge = edges.hard.push(HardEdge { sides, skipped, seams, widths: edge.widths });
            if skipped.is_none() {
                sides.iter().for_each(|&side| edges.chamfered_at[side] = edge);
            }
        }
    }
    edges.parted = parted(fine, topology, faces, &edges.hard, &edges.chamfered_at);
    edges
}

impl Refined {
    /// The half-edge of the source that one of the finer mesh is, from end to end.
    fn whole_of(&self, side: Corner) -> Option<Corner> {
        let Some(piece) = self.piece(side.triangle()) else { return Some(side) };
        let place = side.0 as usize % 3;
        let is_own = piece.is_own_corner(place) && piece.is_own_corner((place + 1) % 3);
        is_own.then(|| piece.source.corners()[place])
    }

    /// What a half-edge of the source that got no vertices is now.
    fn whole_side(&self, side: Corner) -> Corner {
        self.parts_of_side(side).next().unwrap_or(side)
    }

    /// The parts of a half-edge of the source, in its direction.
    pub(super) fn parts_of_side(&self, side: Corner) -> impl Iterator<Item = Corner> + '_ {
        let is_cut = self.is_cut(side.triangle());
        let first = if is_cut { self.sides.partition_point(|part| part.source < side) } else { 0 };
        let parts = if is_cut { &self.sides[first..] } else { &[] };
        let parts = parts.iter().take_while(move |part| part.source == side);
        parts.map(|part| part.fine).chain((!is_cut).then_some(side))
    }

    /// Whether a triangle of the source is in pieces.
    fn is_cut(&self, triangle: Triangle) -> bool {
        self.is_cut[triangle.index()]
    }
}

/// A vertex on a side of a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    pub vertex: u32,
    /// How far along the side.
    pub share: f64,
}

/// A corner of a piece, with its place in the whole triangle as weights of the corners of that.
pub type CutCorner = (u32, [f64; 3]);

/// A triangle cut at the vertices on its sides, around one inside if there is such: itself without
/// any. No side keeps a vertex in its middle.
pub fn pieces(
    corners: [u32; 3],
    points: &[Few<Point>; 3],
    middle: Option<CutCorner>,
) -> Vec<[CutCorner; 3]> {
    let whole = [0, 1, 2].map(|k| (corners[k], WHOLE[k]));
    let points = [0, 1, 2].map(|side| on_side(&points[side], side));
    let mut pieces = Vec::new();
    match middle {
        None => cut(whole, points.each_ref().map(|points| &points[..]), &mut pieces),
        Some(middle) => cut_around(whole, &points, middle, &mut pieces),
    }
    let shared = |one: &[CutCorner; 3], other: &[CutCorner; 3]| {
        one.iter().filter(|(vertex, _)| other.iter().any(|(own, _)| own == vertex)).count()
    };
    side_by_side(&mut pieces, |one, other| shared(one, other) == 2);
    pieces
}

/// The first one, and then such as lie beside an earlier one.
pub(super) fn side_by_side<T>(pieces: &mut [T], are_beside: impl Fn(&T, &T) -> bool) {
    for done in 1..pieces.len() {
        let (before, rest) = pieces.split_at(done);
        // Nearly always it is the last one.
        let is_beside = |piece: &T| before.iter().rev().any(|one| are_beside(one, piece));
        let next = rest.iter().position(is_beside).unwrap_or(0);
        pieces[done..=done + next].rotate_right(1);
    }
}

/// Joins all vertices on the sides to one inside.
/// ```text
///            c
///          / | \
///        /  .s.  \
///      / .'  | `. \
///     a------m-----b
/// ```
fn cut_around(
    corners: [CutCorner; 3],
    points: &[Few<CutCorner>; 3],
    middle: CutCorner,
    pieces: &mut Vec<[CutCorner; 3]>,
) {
    for side in 0..3 {
        let [onward, back] = [(side + 1) % 3, (side + 2) % 3];
        let mut from = corners[side];
        for &to in points[side].iter().chain([&corners[onward]]) {
            let mut piece = [middle; 3];
            (piece[side], piece[onward], piece[back]) = (from, to, middle);
            pieces.push(piece);
            from = to;
        }
    }
}

/// The vertices on a side as corners of pieces.
fn on_side(points: &[Point], side: usize) -> Few<CutCorner> {
    let weights = |share: f64| {
        let mut weights = [0.0; 3];
        (weights[side], weights[(side + 1) % 3]) = (1.0 - share, share);
        weights
    };
    points.iter().map(|point| (point.vertex, weights(point.share))).collect()
}

/// Joins a vertex on a side to the corner across, and gives the others to the two halves.
/// ```text
///          c
///         /|\
///        / | \        the first half has a and c in their old places,
///       /  |  \       the second one b and c
///      a---m---b
/// ```
fn cut(corners: [CutCorner; 3], points: [&[CutCorner]; 3], pieces: &mut Vec<[CutCorner; 3]>) {
    // Thousands of vertices may stand on one side: no call for each.
    let mut waiting = vec![(corners, points)];
    while let Some((corners, points)) = waiting.pop() {
        let Some(side) = (0..3).find(|&side| !points[side].is_empty()) else {
            pieces.push(corners);
            continue;
        };
        let [onward, back] = [(side + 1) % 3, (side + 2) % 3];
        let middle = points[side][0];
        let mut halves = [corners; 2];
        halves[0][onward] = middle;
        halves[1][side] = middle;
        let mut of_halves: [[&[CutCorner]; 3]; 2] = Default::default();
        of_halves[0][back] = points[back];
        of_halves[1][side] = &points[side][1..];
        of_halves[1][onward] = points[onward];
        waiting.extend([(halves[1], of_halves[1]), (halves[0], of_halves[0])]);
    }
}
