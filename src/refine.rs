//! Refine: more vertices on long edges of which only a part can have a chamfer, and on sides on which
//! those of others stand.
//!
//! A chamfer runs straight from one end of its edge to the other, so one end that cannot move
//! narrows all of it, and something that rests on its middle holds all of it. A vertex more, near
//! to what is in the way, keeps the rest at full width:
//! ```text
//!   a                    b      a    m               b
//!    \                   |       \   |               |
//!      `-._              |        `--+---------------|      the pulled side of an edge, whose
//!   -------`-------------|      -----+---------------|      left end cannot move
//! ```
//! This is a step from mesh to mesh. The pipeline then goes on with the finer mesh as with any
//! other, and [`restored`] tells the result in terms of the source.

mod cutting;
mod restored;
mod retold;
mod shape;
mod splits;
mod stitch;
mod stitched;
mod stitches;

use std::collections::BTreeMap;

use glam::DVec3;

use crate::error::Error;
use crate::ids::{Corner, Few, IdVec, Sector, Triangle};
use crate::math::unit;
use crate::memory;
use crate::mesh::{Mesh, MeshBuffers};
use crate::offsets::Offset;
use crate::report::Blend;
use crate::shape::Shape;
use crate::view::{View, wide};
use crate::watch::Watch;

pub use restored::{Origins, restored};
pub use shape::shape;
use shape::{CutCorner, Point, pieces};
pub use stitch::{Stitched, stitch};
pub use stitched::stitched;
pub use stitches::{Left, stitches};

/// Where a hard edge gets vertices.
#[derive(Clone, Debug, PartialEq)]
struct Split {
    /// Its two half-edges.
    sides: [Corner; 2],
    /// Shares of its length from the start of the first half-edge, increasing, within 0 and 1.
    at: Few<f64>,
}

/// A mesh with more vertices, and what became of the triangles that got some.
#[derive(Clone, Debug, Default)]
pub struct Refined {
    /// Source vertices and source triangles keep their numbers; the first piece of a triangle has
    /// the number of that. The other pieces stand behind them all, in submeshes of their own.
    mesh: MeshBuffers,
    /// `#submeshes of their own`: the submesh that each belongs to.
    belong_to: Vec<u32>,
    /// `#new vertices`: what each of the vertices behind those of the source is a blend of.
    added: Vec<Added>,
    /// The triangles that are parts of source triangles, in their order.
    pieces: Vec<Piece>,
    /// What the sides of cut triangles are now, in their order.
    sides: Vec<SidePart>,
    /// `#source triangles`: whether each is in pieces.
    is_cut: Vec<bool>,
}

/// A half-edge of the finer mesh that lies on a side of a cut triangle.
#[derive(Clone, Copy, Debug)]
struct SidePart {
    source: Corner,
    /// Where it begins, as a share of that side's length.
    from: f64,
    fine: Corner,
}

/// A new vertex.
#[derive(Clone, Copy, Debug)]
struct Added {
    blend: Blend,
    /// The source triangle that it was made for.
    triangle: Triangle,
    /// Those of one number stand at one place, and no others.
    site: u32,
}

/// A triangle of the finer mesh. Each of its sides that lies on a side of the source triangle has
/// the place of that side, and each corner that is one of the source triangle has its place.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Piece {
    /// Its number in the finer mesh.
    triangle: Triangle,
    /// The source triangle that it is a part of.
    source: Triangle,
    /// Where its corners lie in that, as weights of its corners.
    corners: [[f64; 3]; 3],
}

/// A triangle as it is.
const WHOLE: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

impl Piece {
    /// Whether a corner is the one of the source triangle.
    fn is_own_corner(&self, place: usize) -> bool {
        self.corners[place] == WHOLE[place]
    }

    /// The half-edge of the source that a side lies on; none if the side is a cut.
    fn source_side(&self, place: usize) -> Option<Corner> {
        let across = (place + 2) % 3;
        let lies_on = |corner: usize| self.corners[corner][across] == 0.0;
        (lies_on(place) && lies_on((place + 1) % 3)).then(|| self.source.corners()[place])
    }
}

/// For each triangle that gets vertices, those on its sides, in the direction of each.
type PointsOf = BTreeMap<Triangle, [Few<Point>; 3]>;

/// A vertex inside a cut triangle lies at this share of how deep the triangle is there.
const MIDDLE_DEPTH: f64 = 0.5;

/// How deep, in widths, a vertex inside a triangle has to lie: so deep that the least breadth of
/// what is between it and the edge hardly narrows a chamfer.
const LEAST_DEPTH: f64 = 1.3;

/// Where so many edges are like that, the mesh is not worth what they would cost: the finer one has
/// no more corners than it, but for this share,
const MOST_GROWTH: f64 = 0.25;

/// and for these of small ones, where a few edges are much.
const FEW_CORNERS: f64 = 1024.0;

/// The mesh with vertices where only a part of an edge can have a chamfer; mostly none.
///
/// # Errors
/// [`Error::OutOfMemory`] where what the finer mesh needs is not to be had.
pub fn refine(
    view: &View,
    shape: &Shape,
    offsets: &IdVec<Sector, Offset>,
    watch: &dyn Watch,
) -> Result<Option<Refined>, Error> {
    let mut splits = splits::splits(view, shape, offsets, watch)?;
    if splits.is_empty() {
        return Ok(None);
    }
    let counts = [splits.len(), splits.iter().map(|split| split.at.len()).sum()];
    memory::ask(memory::of_refined(
        &view.mesh,
        shape.chamfers().work(),
        shape.contacts.len(),
        counts,
    ))?;
    while !splits.is_empty() {
        let refined = refined(&view.mesh, &splits, LEAST_DEPTH * view.width);
        let bad = splits::bad_triangles(view, shape, &refined);
        if bad.is_empty() {
            let [before, after] =
                [view.mesh.indices, &refined.mesh.indices].map(|all| all.len() as f64);
            let is_small = after <= before * (1.0 + MOST_GROWTH) + FEW_CORNERS;
            return Ok(is_small.then_some(refined));
        }
        let is_good = |side: &Corner| bad.binary_search(&side.triangle()).is_err();
        splits.retain(|split| split.sides.iter().all(is_good));
    }
    Ok(None)
}

/// A mesh with more vertices on its hard edges. Each edge is named once. Chamfers will go so deep
/// (in mesh units) into the triangles beside.
fn refined(mesh: &Mesh, splits: &[Split], deep: f64) -> Refined {
    let mut refined = Refined::whole(mesh);
    let points = add_points(mesh, splits, &mut refined);
    cut_all(mesh, &points, deep, &mut refined);
    refined
}

/// Cuts the triangles that have got points.
fn cut_all(mesh: &Mesh, points: &PointsOf, deep: f64, refined: &mut Refined) {
    let mut rest: Vec<(Triangle, [CutCorner; 3])> = Vec::new();
    for (&triangle, points) in points {
        let corners = triangle.corners().map(|corner| mesh.indices[corner.0 as usize]);
        let middle = middle(mesh, triangle, points, deep).map(|weights| {
            let site = refined.next_site();
            (refined.add_vertex(mesh, (corners, weights), triangle, site), weights)
        });
        refined.is_cut[triangle.0 as usize] = true;
        let mut cut = pieces(corners, points, middle).into_iter();
        if let Some(first) = cut.next() {
            let place = triangle.0 as usize * 3;
            refined.mesh.indices[place..place + 3].copy_from_slice(&first.map(|(v, _)| v));
            refined.add_piece(triangle, triangle, first);
        }
        rest.extend(cut.map(|piece| (triangle, piece)));
    }
    refined.append(mesh, &rest);
    refined.sides.sort_unstable_by(|one, other| {
        one.source.cmp(&other.source).then(one.from.total_cmp(&other.from))
    });
}

impl Refined {
    /// A mesh that got no vertices yet.
    fn whole(mesh: &Mesh) -> Refined {
        let is_cut = vec![false; mesh.indices.len() / 3];
        Refined { mesh: mesh.to_buffers(), is_cut, ..Refined::default() }
    }

    /// The finer mesh, on which the same rests.
    pub fn as_mesh<'a>(&'a self, source: &Mesh<'a>) -> Mesh<'a> {
        Mesh { held: source.held, ..self.mesh.as_mesh() }
    }

    /// `#triangles`: whether each is a piece.
    pub fn is_new(&self) -> Vec<bool> {
        let mut is_new = self.is_cut.clone();
        is_new.resize(self.mesh.indices.len() / 3, true);
        is_new
    }

    /// Appends all pieces but the first of each triangle, submesh by submesh.
    fn append(&mut self, mesh: &Mesh, rest: &[(Triangle, [CutCorner; 3])]) {
        let (mut rest, mut end) = (rest.iter().peekable(), 0);
        for (submesh, &count) in (0u32..).zip(mesh.submesh_index_counts) {
            let first = self.mesh.indices.len();
            end += count / 3;
            while let Some(&(source, piece)) = rest.next_if(|(source, _)| source.0 < end) {
                let triangle = Triangle(self.mesh.indices.len() as u32 / 3);
                self.mesh.indices.extend(piece.map(|(vertex, _)| vertex));
                self.add_piece(triangle, source, piece);
            }
            if self.mesh.indices.len() > first {
                let count = self.mesh.indices.len() - first;
                self.mesh.submesh_index_counts.push(count as u32);
                self.belong_to.push(submesh);
            }
        }
    }

    fn add_piece(&mut self, triangle: Triangle, source: Triangle, piece: [CutCorner; 3]) {
        let piece = Piece { triangle, source, corners: piece.map(|(_, weights)| weights) };
        for (place, fine) in triangle.corners().into_iter().enumerate() {
            if let Some(source) = piece.source_side(place) {
                let from = piece.corners[place][(place + 1) % 3];
                self.sides.push(SidePart { source, from, fine });
            }
        }
        self.pieces.push(piece);
    }

    /// The piece that a triangle of the finer mesh is, if it is one.
    fn piece(&self, triangle: Triangle) -> Option<&Piece> {
        if self.is_cut.get(triangle.0 as usize) == Some(&false) {
            return None;
        }
        let place = self.pieces.binary_search_by_key(&triangle, |piece| piece.triangle).ok()?;
        Some(&self.pieces[place])
    }

    fn next_site(&self) -> u32 {
        self.added.last().map_or(0, |added| added.site + 1)
    }
}

/// Appends the vertices of both sides of each edge.
fn add_points(mesh: &Mesh, splits: &[Split], refined: &mut Refined) -> PointsOf {
    let mut points = PointsOf::new();
    for split in splits {
        let ends = [split.sides[0], split.sides[0].next()].map(|corner| position(mesh, corner));
        let (count, first) = (split.at.len(), refined.mesh.positions.len() as u32);
        for &share in &split.at {
            // One position for both sides, rounded once.
            let at = ends[0].lerp(ends[1], share).as_vec3().to_array();
            let site = refined.next_site();
            for (side, share) in split.sides.into_iter().zip([share, 1.0 - share]) {
                let [from, to] = [side, side.next()].map(|c| mesh.indices[c.0 as usize]);
                let blend = ([from, to, from], [1.0 - share, share, 0.0]);
                let vertex = refined.add_vertex(mesh, blend, side.triangle(), site);
                refined.mesh.positions[vertex as usize] = at;
            }
        }
        let point =
            |k: usize, side: u32, share| Point { vertex: first + 2 * k as u32 + side, share };
        let forth = (0..count).map(|k| point(k, 0, split.at[k]));
        let back = (0..count).rev().map(|k| point(k, 1, 1.0 - split.at[k]));
        let of_side = |side: Corner| (side.triangle(), side.0 as usize % 3);
        let (triangle, place) = of_side(split.sides[0]);
        points.entry(triangle).or_default()[place] = forth.collect();
        let (triangle, place) = of_side(split.sides[1]);
        points.entry(triangle).or_default()[place] = back.collect();
    }
    points
}

fn position(mesh: &Mesh, corner: Corner) -> DVec3 {
    wide(mesh.positions[mesh.indices[corner.0 as usize] as usize])
}

/// Where a cut triangle gets a vertex inside, as weights of its corners: below the middle of the
/// first side with new vertices. Joined to it, pieces are less narrow than they are towards a
/// corner across that is far off, and that corner can move. None where the triangle is hardly
/// deeper than the chamfer, or where its streams are not so even that what is blended twice would
/// be told right.
fn middle(
    mesh: &Mesh,
    triangle: Triangle,
    points: &[Few<Point>; 3],
    deep: f64,
) -> Option<[f64; 3]> {
    let corners = triangle.corners();
    let vertices = corners.map(|corner| mesh.indices[corner.0 as usize] as usize);
    let [a, b, c] = vertices;
    if !splits::is_even(mesh, [a, b]) || !splits::is_even(mesh, [b, c]) {
        return None;
    }
    let side = points.iter().position(|points| !points.is_empty())?;
    let [first, last] = [points[side].first()?, points[side].last()?];
    let [from, to, across] = [0, 1, 2].map(|k| position(mesh, corners[(side + k) % 3]));
    let along = to - from;
    let foot = (across - from).dot(along) / along.length_squared();
    let depth = (across - from - along * foot).length();
    // Below this share of the side, the triangle is as deep as one of its other two sides.
    let at = (first.share + last.share) / 2.0;
    let most = f64::min(
        if foot > 0.0 { at / foot } else { f64::INFINITY },
        if foot < 1.0 { (1.0 - at) / (1.0 - foot) } else { f64::INFINITY },
    );
    let down = most.min(1.0) * MIDDLE_DEPTH;
    if down * depth < deep {
        return None;
    }
    let mut weights = [0.0; 3];
    weights[(side + 2) % 3] = down;
    weights[(side + 1) % 3] = at - down * foot;
    weights[side] = 1.0 - down - weights[(side + 1) % 3];
    weights.iter().all(|weight| *weight > 0.0).then_some(weights)
}

impl Refined {
    /// Appends a vertex with its streams blended from three.
    fn add_vertex(
        &mut self,
        mesh: &Mesh,
        (from, weights): ([u32; 3], [f64; 3]),
        triangle: Triangle,
        site: u32,
    ) -> u32 {
        let places = from.map(|vertex| vertex as usize);
        let vertices = &mut self.mesh;
        let blended = |directions: [DVec3; 3]| {
            directions[0] * weights[0] + directions[1] * weights[1] + directions[2] * weights[2]
        };
        let positions = places.map(|vertex| wide(mesh.positions[vertex]));
        vertices.positions.push(blended(positions).as_vec3().to_array());
        let normals = places.map(|vertex| mesh.normals[vertex]);
        let normal = direction(normals, &blended).unwrap_or(normals[0]);
        vertices.normals.push(normal);
        if !mesh.tangents.is_empty() {
            let tangents = places.map(|vertex| mesh.tangents[vertex]);
            vertices.tangents.push(tangent(tangents, &blended, wide(normal)));
        }
        let value = |values: [f32; 3]| {
            let terms = [0, 1, 2].map(|k| f64::from(values[k]) * weights[k]);
            // Equal values stay equal to the bit.
            let is_one = values.iter().all(|value| *value == values[0]);
            if is_one { values[0] } else { (terms[0] + terms[1] + terms[2]) as f32 }
        };
        if !mesh.colors.is_empty() {
            let colors = places.map(|vertex| mesh.colors[vertex]);
            vertices.colors.push(std::array::from_fn(|k| value(colors.map(|color| color[k]))));
        }
        for (uv, source) in vertices.uvs.iter_mut().zip(&mesh.uvs) {
            let width = uv.components as usize;
            let at = |k: usize| value(places.map(|vertex| source.values[vertex * width + k]));
            uv.values.extend((0..width).map(at));
        }
        self.added.push(Added { blend: Blend::new(from, weights), triangle, site });
        self.mesh.positions.len() as u32 - 1
    }
}

/// A blend of directions, of unit length; none where they are one, or cancel out.
fn direction(directions: [[f32; 3]; 3], blended: &dyn Fn([DVec3; 3]) -> DVec3) -> Option<[f32; 3]> {
    let mixed = unit(blended(directions.map(wide)));
    let is_one = directions.iter().all(|direction| *direction == directions[0]);
    (!is_one && mixed != DVec3::ZERO).then(|| mixed.as_vec3().to_array())
}

/// Unit and orthogonal to the normal, with the handedness of the first.
fn tangent(
    tangents: [[f32; 4]; 3],
    blended: &dyn Fn([DVec3; 3]) -> DVec3,
    normal: DVec3,
) -> [f32; 4] {
    let mixed = blended(tangents.map(|[x, y, z, _]| wide([x, y, z])));
    let direction = unit(mixed - normal * mixed.dot(normal));
    let is_one = tangents.iter().all(|tangent| *tangent == tangents[0]);
    if is_one || direction == DVec3::ZERO {
        return tangents[0];
    }
    let [x, y, z] = direction.as_vec3().to_array();
    [x, y, z, tangents[0][3]]
}

#[cfg(test)]
mod tests;
