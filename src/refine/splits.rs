//! Which edges get vertices, and where.

use glam::DVec3;

use super::{LEAST_DEPTH, Piece, Refined, Split};
use crate::error::Error;
use crate::ids::{Corner, Edge, Few, IdVec, Sector, Triangle};
use crate::math::area_vector;
use crate::mesh::Mesh;
use crate::offsets::Offset;
use crate::report::Reason;
use crate::shape::Shape;
use crate::strips;
use crate::view::{View, wide};
use crate::watch::{Watch, each};

/// A chamfer gets from nothing to full width within so many widths: shorter looks like a notch.
const TAPER: f64 = 2.0;

/// From an end that cannot move, a chamfer has so many widths to grow: as much as the vertex there
/// may go at most.
const FROM_BAD_END: f64 = 3.0;

/// A strip that is no longer than so many widths is left alone: at a bad end a third of it is near
/// that anyhow, and one that opens and closes again within so little looks like a wave.
const LEAST_LENGTH: f64 = 10.0;

/// No vertex is nearer than so many widths to an end: the end itself goes one width along the edge,
/// and as much has to be left.
const LEAST_GAP: f64 = 2.0;

/// An edge on which more stretches rest apart from each other is left alone: what it would gain are
/// crumbs, and what a call takes stays bounded.
const MOST_VERTICES: usize = 8;

/// Normals along an edge that differ by more (a degree) are not blended twice without a trace:
/// what is told of a vertex would not rebuild them.
const EVEN_NORMALS: f64 = 0.02;

/// The same for tangents, which nobody needs that exactly: eleven degrees.
const EVEN_TANGENTS: f64 = 0.2;

/// A piece is at least so many times the resolution high: rounding a vertex hardly tilts it.
const LEAST_HEIGHT: f64 = 32.0;

/// It pays if at least this share of all that hard edges could be wide is at stake. In larger meshes
/// nobody sees less, and they take longest.
const LEAST_STAKE: f64 = 0.005;

/// The vertices that edges need.
///
/// # Errors
/// [`Error::Cancelled`] where the watch stops it.
pub fn splits(
    view: &View,
    shape: &Shape,
    offsets: &IdVec<Sector, Offset>,
    watch: &dyn Watch,
) -> Result<Vec<Split>, Error> {
    let (mut splits, mut stake) = (Vec::new(), 0.0);
    let all_move = offsets.iter().all(Offset::moves);
    each(shape.edges.hard.len(), watch, |edge| {
        if !may_need_vertices(shape, (offsets, all_move), edge) {
            return;
        }
        let edge = EdgeOf { view, shape, offsets, edge, length: length(view, shape, edge) };
        let found = edge.places();
        if !found.at.is_empty() && found.at.len() <= MOST_VERTICES && edge.is_plain() {
            stake += found.stake;
            let at = found.at.into_iter().map(|place| place / edge.length).collect();
            splits.push(Split { sides: edge.sides(), at });
        }
    })?;
    if splits.is_empty() {
        return Ok(splits);
    }
    let mut all = 0.0;
    each(shape.edges.hard.len(), watch, |edge| all += length(view, shape, edge))?;
    if stake < LEAST_STAKE * all {
        return Ok(Vec::new());
    }
    // Other half-edges that lie there would need the vertices too.
    let mut crowded = shape.topology.touching.as_flattened().to_vec();
    crowded.sort_unstable();
    let is_alone = |side: &Corner| crowded.binary_search(side).is_err();
    splits.retain(|split| split.sides.iter().all(is_alone));
    Ok(splits)
}

/// Whether something may rest on an edge, or one of its offsets is none: nearly all edges need no look at
/// more than that.
fn may_need_vertices(
    shape: &Shape,
    (offsets, all_move): (&IdVec<Sector, Offset>, bool),
    edge: Edge,
) -> bool {
    let hard = &shape.edges.hard[edge];
    let stays = |corner: Corner| !offsets[shape.sectors.sector_of[corner]].moves();
    match hard.skipped {
        Some(reason) => reason == Reason::Contact,
        None => !all_move && strips::corners(hard).into_iter().any(stays),
    }
}

fn length(view: &View, shape: &Shape, edge: Edge) -> f64 {
    let side = shape.edges.hard[edge].sides[0];
    view.position_at(side).distance(view.position_at(side.next()))
}

/// A hard edge with all that is known around it.
struct EdgeOf<'a> {
    view: &'a View<'a>,
    shape: &'a Shape,
    offsets: &'a IdVec<Sector, Offset>,
    edge: Edge,
    length: f64,
}

/// Where an edge is to get vertices, as lengths from its start, and the length of full width that
/// it may gain.
#[derive(Default)]
struct Found {
    at: Few<f64>,
    stake: f64,
}

impl EdgeOf<'_> {
    fn sides(&self) -> [Corner; 2] {
        self.shape.edges.hard[self.edge].sides
    }

    fn places(&self) -> Found {
        match self.shape.edges.hard[self.edge].skipped {
            Some(Reason::Contact) => self.beside_held(),
            Some(_) => Found::default(),
            None => self.near_bad_ends(),
        }
    }

    /// Around the stretches on which something rests.
    /// ```text
    ///   a------+--+=====+--+-------------b      = is held; it tapers from + to +
    /// ```
    fn beside_held(&self) -> Found {
        let (width, side) = (self.view.width, self.sides()[0]);
        let Shape { topology, faces, contacts, .. } = self.shape;
        let room = LEAST_LENGTH * width;
        if self.length <= room || topology.is_contact(side) {
            return Found::default();
        }
        let mut held = contacts.stretches(self.view, topology, faces, side);
        held.sort_unstable_by(|one, other| one[0].total_cmp(&other[0]));
        let mut joined: Few<[f64; 2]> = Few::new();
        for [from, to] in held {
            match joined.last_mut() {
                // Between two of them there has to be room to open and to close.
                Some(last) if from < last[1] + room => last[1] = last[1].max(to),
                _ => joined.push([from, to]),
            }
        }
        let mut found = Found { stake: self.length, ..Found::default() };
        for [from, to] in joined {
            let gap = LEAST_GAP * width;
            let (from, to) = (from.min(self.length - gap), to.max(gap));
            if from > room {
                found.at.extend([from - TAPER * width, from]);
            }
            if self.length - to > room {
                found.at.extend([to, to + TAPER * width]);
            }
            found.stake -= (to.min(self.length) - from.max(0.0)).max(0.0);
        }
        found
    }

    /// Near the ends at which a side of the strip cannot move.
    fn near_bad_ends(&self) -> Found {
        let (near, mut found) = (FROM_BAD_END * self.view.width, Found::default());
        if self.length <= LEAST_LENGTH * self.view.width {
            return found;
        }
        let stays = |corner: Corner| {
            let sector = self.shape.sectors.sector_of[corner];
            f64::from(u8::from(!self.offsets[sector].moves()))
        };
        let [b1, a1, a2, b2] = strips::corners(&self.shape.edges.hard[self.edge]).map(stays);
        if a1 + a2 > 0.0 {
            found.at.push(near);
        }
        if b1 + b2 > 0.0 {
            found.at.push(self.length - near);
        }
        if !found.at.is_empty() && !self.sides().iter().all(|&side| self.is_deep(side)) {
            return Found::default();
        }
        found.stake = (a1 + a2 + b1 + b2) / 4.0 * (self.length - near);
        found
    }

    /// Whether the triangle at a side has room for a chamfer of full width.
    fn is_deep(&self, side: Corner) -> bool {
        let area = area_vector(self.view.triangle(side.triangle())).length();
        area > LEAST_DEPTH * self.view.width * self.length
    }

    /// Whether the streams along an edge are such that a vertex on it can be told as a blend, and
    /// both its faces are real ones.
    fn is_plain(&self) -> bool {
        let (mesh, faces, sides) = (&self.view.mesh, &self.shape.faces, self.sides());
        let ends = sides.map(|side| [side, side.next()].map(|c| self.view.vertex_at(c).0 as usize));
        let is_face = |side: &Corner| {
            faces.normal[side.triangle()] != DVec3::ZERO && !faces.is_line(side.triangle())
        };
        // One that is smooth at an end may be so in the middle.
        let differ = |one: usize, other: usize| {
            !near(&mesh.normals[one], &mesh.normals[other], EVEN_NORMALS)
        };
        ends.iter().all(|&ends| is_even(mesh, ends))
            && sides.iter().all(is_face)
            && differ(ends[0][0], ends[1][1])
            && differ(ends[0][1], ends[1][0])
    }
}

/// Whether two vertices have nearly the same normals and tangents.
pub fn is_even(mesh: &Mesh, [one, other]: [usize; 2]) -> bool {
    near(&mesh.normals[one], &mesh.normals[other], EVEN_NORMALS)
        && (mesh.tangents.is_empty()
            || near(&mesh.tangents[one], &mesh.tangents[other], EVEN_TANGENTS))
}

fn near(one: &[f32], other: &[f32], far: f64) -> bool {
    let squares = one.iter().zip(other).map(|(a, b)| f64::from(a - b).powi(2));
    squares.sum::<f64>() < far * far
}

/// The triangles, sorted, that are better left whole.
pub fn bad_triangles(view: &View, shape: &Shape, refined: &Refined) -> Vec<Triangle> {
    let mut bad = meeting(view, refined);
    bad.extend(tilted(view, shape, refined));
    bad.sort_unstable();
    bad.dedup();
    bad
}

/// The triangles of which a new vertex would meet another one, new or old: what is welded is joined.
fn meeting(view: &View, refined: &Refined) -> Vec<Triangle> {
    let key = |position: &[f32; 3]| position.map(|along| (along + 0.0).to_bits());
    let source = view.mesh.positions;
    let new = refined.mesh.positions[source.len()..].iter().zip(&refined.added);
    let mut new: Vec<_> = new.map(|(at, added)| (key(at), added.site, added.triangle)).collect();
    new.sort_unstable();
    let mut bad = Vec::new();
    for pair in new.windows(2) {
        if pair[0].0 == pair[1].0 && pair[0].1 != pair[1].1 {
            bad.extend([pair[0].2, pair[1].2]);
        }
    }
    // Nearly all are told apart by a few bits.
    let bits =
        |key: &[u32; 3]| key.iter().fold(0, |mixed, &along| mixed ^ along >> 9 ^ along) as u8;
    let mut is_used = [false; 1 << u8::BITS];
    new.iter().for_each(|(key, ..)| is_used[bits(key) as usize] = true);
    for key in source.iter().map(key).filter(|key| is_used[bits(key) as usize]) {
        let first = new.partition_point(|(new, ..)| *new < key);
        let met = new[first..].iter().take_while(|(new, ..)| *new == key);
        bad.extend(met.map(|&(.., triangle)| triangle));
    }
    bad
}

/// The triangles of which a piece would turn over, or nearly, when it is rounded.
fn tilted(view: &View, shape: &Shape, refined: &Refined) -> Vec<Triangle> {
    let is_bad = |piece: &&Piece| {
        let points = piece.triangle.corners().map(|corner| {
            wide(refined.mesh.positions[refined.mesh.indices[corner.0 as usize] as usize])
        });
        is_tilted(view, points, shape.faces.normal[piece.source])
    };
    refined.pieces.iter().filter(is_bad).map(|piece| piece.source).collect()
}

/// Whether rounding its corners would turn a triangle over, or nearly.
pub(super) fn is_tilted(view: &View, points: [DVec3; 3], normal: DVec3) -> bool {
    let longest = (0..3).map(|k| points[k].distance(points[(k + 1) % 3])).fold(0.0, f64::max);
    let height = area_vector(points).dot(normal) / longest;
    height.is_nan() || height < LEAST_HEIGHT * view.resolution
}
