//! Pieces that cut a face beside them, which the whole triangle did not: the vertex that one got may be
//! a step of single precision off its plane.

use std::collections::BTreeMap;

use super::Stitched;
use super::stitches::Left;
use crate::ids::{Cluster, Corner, Few, Id, Triangle};
use crate::intersect::cut_each_other;
use crate::shape::Shape;
use crate::view::View;

/// Where more triangles meet at one place, looking at all pairs of them would take quadratic time.
const MOST_AROUND: usize = 64;

impl Stitched {
    /// The long sides of pieces that newly cut what they share a place with.
    pub(super) fn add_cutting(&self, view: &View, shape: &Shape, bad: &mut Left) {
        let stored =
            |cluster: Cluster| view.stored_positions()[shape.weld.first_vertex[cluster].index()];
        let now = |triangle: Triangle| {
            triangle.corners().map(|corner| stored(self.cluster(shape, corner)))
        };
        let was = |triangle: Triangle| {
            triangle.corners().map(|corner| stored(shape.topology.cluster_at[corner]))
        };
        let source = |triangle| self.refined.piece(triangle).map_or(triangle, |piece| piece.source);
        let around = self.around_pieces(shape);
        for piece in &self.refined.pieces {
            let cuts = |&other: &Triangle| {
                let other_source = source(other);
                other_source != piece.source
                    && cut_each_other(&now(piece.triangle), &now(other))
                    && !cut_each_other(&was(piece.source), &was(other_source))
            };
            let clusters = piece.triangle.corners().map(|corner| self.cluster(shape, corner));
            let near = clusters.iter().filter_map(|cluster| around.get(cluster));
            if near.filter(|near| near.len() <= MOST_AROUND).flatten().any(cuts) {
                bad.sides.extend(self.long_sides_of(piece.source));
            }
        }
    }

    /// The triangles at each place of a piece.
    fn around_pieces(&self, shape: &Shape) -> BTreeMap<Cluster, Few<Triangle>> {
        let corners = self.refined.pieces.iter().flat_map(|piece| piece.triangle.corners());
        let mut around: BTreeMap<Cluster, Few<Triangle>> =
            corners.map(|corner| (self.cluster(shape, corner), Few::new())).collect();
        for corner in (0..self.refined.mesh.indices.len() as u32).map(Corner) {
            if let Some(near) = around.get_mut(&self.cluster(shape, corner)) {
                near.push(corner.triangle());
            }
        }
        around
    }
}
