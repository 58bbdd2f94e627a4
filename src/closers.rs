//! Closers: lines that are shaded like no face beside them.
//!
//! ```text
//!   A-----------B      A, B and M are a line: it closes the gap between the edge A-B above and the two
//!   A-----M-----B      edges below. Nobody sees its normals, and so exporters give it any
//!   |     |     |
//! ```
//! A line takes the vertices that the faces along its short sides have there, and is one of them from
//! then on: A-B is the hard edge, and has a chamfer as any other.

use std::collections::BTreeMap;

use glam::DVec3;

use crate::error::Error;
use crate::faces::{is_blurred, long_side};
use crate::ids::{Cluster, Corner, Triangle, Vertex};
use crate::mesh::{Mesh, MeshBuffers};
use crate::report::{Chamfered, TriangleKind};
use crate::shape::Shape;
use crate::view::View;
use crate::watch::{Watch, each};

/// Of lines in a row each takes what the one before has taken. More than so many are broken geometry.
const MOST_IN_A_ROW: usize = 16;

/// Lines, and the vertices that each takes.
#[derive(Debug, Default)]
pub struct Closers {
    taken: Vec<(Triangle, [u32; 3])>,
}

impl Closers {
    pub fn is_empty(&self) -> bool {
        self.taken.is_empty()
    }

    /// `#corners`: the vertices of the mesh with those that the lines take.
    pub fn indices(&self, view: &View) -> Vec<u32> {
        let mut indices = view.mesh.indices.to_vec();
        for &(line, vertices) in &self.taken {
            let first = line.corners()[0].0 as usize;
            indices[first..first + 3].copy_from_slice(&vertices);
        }
        indices
    }

    /// A result in terms of the mesh as it came: verdicts name its vertices, and a line beside which
    /// nothing has moved has its own again.
    pub fn restored(&self, source: &Mesh, mut chamfered: Chamfered) -> Chamfered {
        let own = |line: Triangle| line.corners().map(|corner| source.indices[corner.0 as usize]);
        let sides = self.taken.iter().flat_map(|&(line, vertices)| {
            [0, 1, 2].map(|k| [vertices, own(line)].map(|all| [all[k], all[(k + 1) % 3]]))
        });
        let known: BTreeMap<[u32; 2], [u32; 2]> = sides.map(|[taken, own]| (taken, own)).collect();
        for verdict in &mut chamfered.verdicts {
            verdict.vertices = known.get(&verdict.vertices).copied().unwrap_or(verdict.vertices);
        }
        let MeshBuffers { positions, indices, .. } = &mut chamfered.mesh;
        let at =
            |vertex: u32| positions.get(vertex as usize).map(|at| at.map(|x| (x + 0.0).to_bits()));
        for (now, told) in indices.chunks_exact_mut(3).zip(&chamfered.triangle_sources) {
            let line = Triangle(told.index);
            let is_line = told.kind == TriangleKind::Source && self.place(line).is_some();
            let is_as_before = |own: &[u32; 3]| now.iter().zip(own).all(|(&a, &b)| at(a) == at(b));
            if let Some(own) = is_line.then(|| own(line)).filter(is_as_before) {
                now.copy_from_slice(&own);
            }
        }
        chamfered
    }
}

/// For a mesh with such lines: mostly none. None either at a width at which nothing opens.
///
/// # Errors
/// [`Error::Cancelled`] where the watch stops it.
pub fn closers(view: &View, shape: &Shape, watch: &dyn Watch) -> Result<Closers, Error> {
    let mut closers = Closers::default();
    if view.width <= view.resolution {
        return Ok(closers);
    }
    let mut lines: Vec<Triangle> = Vec::new();
    each(shape.faces.normal.len(), watch, |triangle| {
        let is_unknown = shape.faces.normal[triangle] == DVec3::ZERO;
        lines.extend(is_unknown.then_some(triangle));
    })?;
    let (unclear, mut left) = unclear(view, shape, lines);
    for _ in 0..MOST_IN_A_ROW {
        let found: Vec<_> = left
            .iter()
            .filter_map(|&line| Some((line, taken(view, shape, &closers, line)?)))
            .collect();
        if found.is_empty() {
            break;
        }
        left.retain(|line| found.binary_search_by_key(line, |found| found.0).is_err());
        closers.taken.extend(found);
        closers.taken.sort_unstable();
    }
    left.extend(unclear);
    closers.leave_beside(left, shape);
    Ok(closers)
}

/// The lines that may not be what they seem, and those that are left: where several lie on each other,
/// which of them is the twin is nobody's choice, and far out a low triangle looks like a line.
fn unclear(view: &View, shape: &Shape, lines: Vec<Triangle>) -> (Vec<Triangle>, Vec<Triangle>) {
    let ends = |side: Corner| {
        let [from, to] = [side, side.next()].map(|corner| shape.topology.cluster_at[corner]);
        [from.min(to), from.max(to)]
    };
    let sides = lines.iter().flat_map(|line| line.corners());
    let mut lie_on: BTreeMap<[Cluster; 2], usize> = sides.map(|side| (ends(side), 0)).collect();
    if !lie_on.is_empty() {
        for side in (0..view.corner_count() as u32).map(Corner) {
            lie_on.entry(ends(side)).and_modify(|count| *count += 1);
        }
    }
    let is_crowded = |line: &Triangle| line.corners().iter().any(|&side| lie_on[&ends(side)] > 2);
    lines.into_iter().partition(|line| is_crowded(line) || is_blurred(view, *line))
}

/// The vertices that a line finds along its short sides; none where these have no faces, or are shaded
/// apart where they meet.
fn taken(view: &View, shape: &Shape, closers: &Closers, line: Triangle) -> Option<[u32; 3]> {
    let long = long_side(view, line)?;
    let [there, back] = [long.next(), long.prev()].map(|side| shape.topology.twin[side]);
    if !knows(shape, closers, there) || !knows(shape, closers, back) {
        return None;
    }
    let vertex = |corner: Corner| closers.vertex(view, corner);
    let [from, to, middle] = [vertex(back), vertex(there.next()), vertex(there)];
    let normals = [middle, vertex(back.next())].map(|v| view.normal(Vertex(v)));
    if view.normals_differ(normals) {
        return None;
    }
    let mut vertices = [from, to, middle];
    vertices.rotate_right(long.0 as usize % 3);
    Some(vertices)
}

/// Whether there is a face behind a side of a line, or a line that has found one.
fn knows(shape: &Shape, closers: &Closers, twin: Corner) -> bool {
    twin.is_some()
        && (shape.faces.normal[twin.triangle()] != DVec3::ZERO
            || closers.place(twin.triangle()).is_some())
}

impl Closers {
    /// A row of lines is taken whole or not at all: light would break between its lines.
    fn leave_beside(&mut self, mut left: Vec<Triangle>, shape: &Shape) {
        while let Some(line) = left.pop() {
            for twin in line.corners().map(|side| shape.topology.twin[side]) {
                let place = twin.is_some().then(|| self.place(twin.triangle())).flatten();
                left.extend(place.map(|place| self.taken.remove(place).0));
            }
        }
    }

    fn place(&self, line: Triangle) -> Option<usize> {
        self.taken.binary_search_by_key(&line, |taken| taken.0).ok()
    }

    /// The vertex of a corner, or the one that it takes.
    fn vertex(&self, view: &View, corner: Corner) -> u32 {
        let taken = self.place(corner.triangle());
        taken.map_or(view.vertex_at(corner).0, |place| self.taken[place].1[corner.0 as usize % 3])
    }
}
