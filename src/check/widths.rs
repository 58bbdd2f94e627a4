//! How wide chamfers are, measured on the mesh: how far the sides of each old edge were pulled.

use glam::DVec3;

use super::origins::Origins;
use super::rules::MeasuredEdge;
use super::solids::Solids;
use super::surface::{HalfEdge, Surface};

/// The corners of a source mesh in the result.
pub(super) struct Ruler<'a> {
    pub before: &'a Surface<'a>,
    after: &'a Surface<'a>,
    /// `#source corners`.
    corner_after: Vec<Option<u32>>,
}

impl<'a> Ruler<'a> {
    pub fn new([before, after]: &'a [Surface<'a>; 2], origins: &Origins) -> Self {
        let corner_after = origins.corners_after(before.mesh.indices.len());
        Ruler { before, after, corner_after }
    }

    /// The hard edges, in the order of their first corners. Where more than two sides meet, as
    /// where a skin is there twice, an edge for each pair of sides with a solid between them.
    pub fn measure_all(&self, solids: &Solids) -> Vec<MeasuredEdge> {
        let mut edges = Vec::new();
        for edge in self.before.edges().filter(|edge| self.before.is_hard(edge)) {
            for [forward, backward] in solids.pairs(self.before, edge) {
                if self.before.is_soft(forward, backward) {
                    continue;
                }
                let mut sides = [forward, backward];
                sides.sort_unstable_by_key(|side| side.corners[0]);
                let is_parted = self.is_parted(edge, [forward, backward]);
                let measured = self.measure(sides[0], sides[1]);
                let measured = measured.map(|measured| MeasuredEdge { is_parted, ..measured });
                edges.extend(measured.map(|measured| (sides[0].corners[0], measured)));
            }
        }
        edges.sort_unstable_by_key(|(first, _)| *first);
        edges.into_iter().map(|(_, measured)| measured).collect()
    }

    /// Whether one of two sides has come apart from any of those across.
    fn is_parted(
        &self,
        (forward, backward): (&[HalfEdge], &[HalfEdge]),
        [one, other]: [&HalfEdge; 2],
    ) -> bool {
        if forward.len() + backward.len() <= 2 {
            return false;
        }
        let across_one = backward.iter().map(|side| [one, side]);
        let mut pairs = across_one.chain(forward.iter().map(|side| [side, other]));
        pairs.any(|[one, other]| self.measure(one, other).is_some_and(|edge| edge.is_chamfered()))
    }

    /// Measures an edge between two opposite half-edges of the source; none where one's triangle
    /// was not found.
    pub fn measure(&self, one: &HalfEdge, other: &HalfEdge) -> Option<MeasuredEdge> {
        let ends = self.line(one);
        let mut measured = MeasuredEdge {
            vertices: one.corners.map(|corner| self.before.mesh.indices[corner as usize]),
            length: ends[0].distance(ends[1]) as f32,
            distances: [[0.0; 2]; 2],
            is_open: [false; 2],
            is_parted: false,
        };
        for end in 0..2 {
            let corners = [one.corners[end], other.corners[1 - end]];
            let [a, b] = corners.map(|corner| self.corner_after[corner as usize]);
            let points = [a?, b?].map(|corner| self.after.position(corner));
            measured.distances[end] = points.map(|point| distance_from_line(ends, point) as f32);
            measured.is_open[end] = points[0] != points[1];
        }
        Some(measured)
    }

    /// How far a source corner was pulled off an edge; none where its triangle was not found.
    pub fn pulled(&self, edge: &HalfEdge, corner: u32) -> Option<f64> {
        let after = self.corner_after[corner as usize]?;
        Some(distance_from_line(self.line(edge), self.after.position(after)))
    }

    /// How far the corners of a side were pulled from where it was, at most.
    pub fn pull(&self, side: &HalfEdge) -> f64 {
        side.corners.into_iter().filter_map(|end| self.pulled(side, end)).fold(0.0, f64::max)
    }

    fn line(&self, side: &HalfEdge) -> [DVec3; 2] {
        side.corners.map(|corner| self.before.position(corner))
    }
}

pub(super) fn distance_from_line([from, to]: [DVec3; 2], point: DVec3) -> f64 {
    (point - from).cross((to - from).normalize_or_zero()).length()
}

#[cfg(test)]
mod tests {
    use crate::check::compare;
    use crate::mesh::MeshBuffers;
    use crate::options::{Options, Verify, Width};
    use crate::pipeline::chamfer;
    use crate::shapes::{Touch, two_cubes_touching};

    //       +---+      of two cubes that have an edge in common the lower one alone is chamfered
    //       |   |
    //   .---*---+
    //   |   |
    //   '---'
    #[test]
    fn at_an_edge_of_many_sides_one_may_have_parted_from_another() {
        let before = two_cubes_touching(Touch::Edge);
        let half = before.indices.len() / 2;
        let most = *before.indices[..half].iter().max().unwrap() as usize + 1;
        let lower = MeshBuffers {
            positions: before.positions[..most].to_vec(),
            normals: before.normals[..most].to_vec(),
            indices: before.indices[..half].to_vec(),
            submesh_index_counts: vec![half as u32],
            ..MeshBuffers::default()
        };
        let options = Options { width: Width::Units(0.1), ..Options::default() };
        let mut after = chamfer(&lower.as_mesh(), &options).unwrap().mesh;
        let added = after.positions.len() as u32;
        after.positions.extend(&before.positions[most..]);
        after.normals.extend(&before.normals[most..]);
        let upper = before.indices[half..].iter().map(|index| index - most as u32 + added);
        after.indices.splice(half..half, upper);
        after.submesh_index_counts = vec![after.indices.len() as u32];
        let edges = compare(&before.as_mesh(), &after.as_mesh(), Verify::Fast).edges;
        let left = edges.iter().filter(|edge| !edge.is_chamfered());
        assert_eq!((edges.len(), left.clone().count()), (24, 12));
        assert_eq!(left.filter(|edge| edge.is_parted).count(), 1, "the common one");
    }
}
