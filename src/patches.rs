//! Patches: what closes the surface where sectors have been pulled apart, strips and fills alike.
//!
//! A patch has joints on its boundary, each a corner of the source that stands where its sector
//! does; points of its own inside; and triangles over both.

use glam::DVec3;

use crate::chamfers::Chamfers;
use crate::error::Error;
use crate::fills::{is_open, middle, ring_fill};
use crate::ids::{Corner, Edge, Few, Id, Patch, Ring, Sector, Vertex};
use crate::math::unit;
use crate::placement::Placement;
use crate::report::Blend;
use crate::sectors::Sectors;
use crate::strips::{self, cut};
use crate::threads::Threads;
use crate::tolerance::EQUALLY_NEAR;
use crate::view::View;
use crate::watch::Watch;

/// All strips in the order of their edges, then all fills in the order of their rings. What does
/// not open has no triangles.
#[derive(Default)]
pub struct Patches {
    /// `1 + #patches`: where the parts of each end, after where the first ones begin; without that in
    /// those that are appended to others.
    ends: Vec<[u32; 3]>,
    joints: Vec<Corner>,
    middles: Vec<Middle>,
    triangles: Vec<[u32; 3]>,
    strips: usize,
}

/// A vertex inside of a patch: the mean of some of its joints.
pub struct Middle {
    pub position: DVec3,
    pub normal: DVec3,
    /// Where on the source it is nearest to: see [`nearest`].
    pub near: Blend,
}

/// One patch.
#[derive(Clone, Copy)]
pub struct Parts<'a> {
    /// Counter-clockwise seen from outside; those of a strip are named b1, a1, a2, b2.
    pub joints: &'a [Corner],
    pub middles: &'a [Middle],
    /// Places in the joints, and past them in the middles.
    pub triangles: &'a [[u32; 3]],
}

/// Where the sectors stand now.
///
/// # Errors
/// [`Error::Cancelled`] where the watch stops it.
pub fn patches(
    view: &View,
    chamfers: Chamfers,
    placement: &Placement,
    (threads, watch): (&Threads, &dyn Watch),
) -> Result<Patches, Error> {
    let Chamfers { edges, sectors } = chamfers;
    let mut patches = Patches::with_room(edges.hard.len(), sectors);
    let add_strip = |edge: Edge, strips: &mut Patches| {
        let edge = &edges.hard[edge];
        if edge.skipped.is_none() {
            let corners = strips::corners(edge);
            let triangles = cut(corners.map(|corner| placement.position_at(corner))).triangles();
            if !triangles.is_empty() {
                strips.joints.extend_from_slice(&corners);
                strips.triangles.extend(triangles.iter().map(as_places));
            }
        }
        strips.end();
    };
    threads.gather((edges.hard.len(), watch), &mut patches, add_strip, Patches::append)?;
    let add_fill = |ring: Ring, fills: &mut Patches| {
        fills.add_fill(view, placement, sectors.ring(ring), |s| sectors.fans[s].first);
        fills.end();
    };
    threads.gather((sectors.rings.len(), watch), &mut patches, add_fill, Patches::append)?;
    Ok(patches)
}

impl Patches {
    /// None yet, and room for so many strips and all fills.
    fn with_room(strips: usize, sectors: &Sectors) -> Patches {
        let (rings, members) = (sectors.rings.len(), sectors.members.len());
        let mut ends = Vec::with_capacity(1 + strips + rings);
        ends.push([0; 3]);
        Patches {
            ends,
            joints: Vec::with_capacity(4 * strips + members),
            middles: Vec::new(),
            triangles: Vec::with_capacity(2 * strips + members),
            strips,
        }
    }

    pub fn len(&self) -> usize {
        self.ends.len() - 1
    }

    pub fn triangle_count(&self) -> usize {
        self.triangles.len()
    }

    /// The triangles of a patch, as in its parts.
    #[inline]
    pub fn triangles(&self, patch: Patch) -> &[[u32; 3]] {
        let [[.., from], [.., to]] = [0, 1].map(|k| self.ends[patch.index() + k]);
        &self.triangles[from as usize..to as usize]
    }

    /// What becomes of an edge.
    pub fn strip(&self, edge: Edge) -> Parts<'_> {
        self.parts(Patch(edge.0))
    }

    /// What becomes of a ring.
    pub fn fill(&self, ring: Ring) -> Parts<'_> {
        self.parts(self.fill_of(ring))
    }

    /// The patch that fills a ring.
    pub fn fill_of(&self, ring: Ring) -> Patch {
        Patch::new(self.strips + ring.index())
    }

    /// The edge that a patch is the strip of, or the ring that it fills.
    pub fn edge_or_ring(&self, patch: Patch) -> Result<Edge, Ring> {
        match patch.index().checked_sub(self.strips) {
            None => Ok(Edge(patch.0)),
            Some(ring) => Err(Ring::new(ring)),
        }
    }

    #[inline(always)]
    pub fn parts(&self, patch: Patch) -> Parts<'_> {
        let place = patch.index();
        let [from, to] = [self.ends[place], self.ends[place + 1]];
        let range = |k: usize| from[k] as usize..to[k] as usize;
        Parts {
            joints: &self.joints[range(0)],
            middles: &self.middles[range(1)],
            triangles: &self.triangles[range(2)],
        }
    }

    fn add_fill(
        &mut self,
        view: &View,
        placement: &Placement,
        sectors: &[Sector],
        first: impl Fn(Sector) -> Corner,
    ) {
        // Limits end with fills that are valid, or with rings that did not move.
        if let [a, b, c] = *sectors {
            let points = [placement.point[a], placement.point[b], placement.point[c]];
            if is_open(points) {
                self.joints.extend_from_slice(&[first(a), first(b), first(c)]);
                self.triangles.push([0, 1, 2]);
            }
            return;
        }
        let Some(fill) = ring_fill(placement, sectors, view.resolution) else { return };
        if fill.triangles.is_empty() {
            return;
        }
        let corners: Few<Corner> = sectors.iter().map(|&sector| first(sector)).collect();
        let points: Few<DVec3> = sectors.iter().map(|&sector| placement.point[sector]).collect();
        self.middles.extend(fill.middles.iter().map(|places| {
            let normals = places.iter().map(|&place| placement.normals[sectors[place]][0]);
            let position = middle(&points, places);
            Middle {
                position,
                normal: unit(normals.sum()),
                near: nearest(view, &corners, position),
            }
        }));
        self.joints.extend(corners);
        self.triangles.extend(fill.triangles.iter().map(as_places));
    }

    /// Ends a patch.
    fn end(&mut self) {
        let counts = [self.joints.len(), self.middles.len(), self.triangles.len()];
        self.ends.push(counts.map(|count| count as u32));
    }

    fn append(&mut self, others: &mut Patches) {
        let [joints, middles, triangles] = self.ends.last().copied().unwrap_or_default();
        let ends = others.ends.drain(..);
        self.ends.extend(ends.map(|[j, m, t]| [joints + j, middles + m, triangles + t]));
        self.joints.append(&mut others.joints);
        self.middles.append(&mut others.middles);
        self.triangles.append(&mut others.triangles);
    }
}

fn as_places(triangle: &[usize; 3]) -> [u32; 3] {
    triangle.map(|place| place as u32)
}

/// So many neighbours are tried in pairs: of more, as around the tip of a huge cone, every so manyth.
const MOST_TRIED: usize = 64;

/// The blend of a ring's cluster and two of its neighbours, none of negative weight, that comes
/// nearest to a point: a middle lies on no face of the source, and is the mean of more than three
/// source vertices.
pub fn nearest(view: &View, corners: &[Corner], point: DVec3) -> Blend {
    let corner = view.vertex_at(corners[0]);
    let at = view.position(corner);
    let step = corners.len().div_ceil(MOST_TRIED);
    let neighbours: Few<Vertex> =
        corners.iter().step_by(step).map(|first| view.vertex_at(first.next())).collect();
    let mut best = (at.distance(point), Blend::one(corner.0));
    for (k, &one) in neighbours.iter().enumerate() {
        for &other in &neighbours[k + 1..] {
            let arms = [one, other].map(|vertex| view.position(vertex) - at);
            let Some([a, b]) = weights(arms, point - at) else { continue };
            let distance = (at + arms[0] * a + arms[1] * b).distance(point);
            if distance < best.0 * EQUALLY_NEAR {
                let blend = Blend::new([corner.0, one.0, other.0], [1.0 - a - b, a, b]);
                best = (distance, blend);
            }
        }
    }
    best.1
}

/// How much of two arms comes nearest to a way; none if that takes negative weights.
fn weights([one, other]: [DVec3; 2], way: DVec3) -> Option<[f64; 2]> {
    let mixed = one.dot(other);
    let determinant = one.length_squared() * other.length_squared() - mixed * mixed;
    let a = (one.dot(way) * other.length_squared() - other.dot(way) * mixed) / determinant;
    let b = (other.dot(way) * one.length_squared() - one.dot(way) * mixed) / determinant;
    (a >= 0.0 && b >= 0.0 && a + b <= 1.0).then_some([a, b])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes;
    use crate::stages::stages_of;

    #[test]
    fn what_lies_between_two_arms_is_met_exactly() {
        let arms = [DVec3::X * 2.0, DVec3::new(1.0, 1.0, 0.0)];
        let [a, b] = weights(arms, DVec3::new(0.75, 0.25, 0.0)).unwrap();
        assert!((a - 0.25).abs() < 1e-12 && (b - 0.25).abs() < 1e-12);
        assert_eq!(weights(arms, DVec3::NEG_X), None);
        assert_eq!(weights([DVec3::X, DVec3::X], DVec3::X), None, "they span nothing");
    }

    /// For each patch, how many joints, middles and triangles it has.
    fn counts(width: f32) -> Vec<[usize; 3]> {
        let pyramid = shapes::pyramid(5);
        let stages = stages_of(&pyramid, width);
        let placement = stages.placement();
        let patches = stages.patches(&placement);
        let ids = (0..patches.len()).map(Patch::new);
        let parts = ids.map(|patch| patches.parts(patch));
        parts.map(|p| [p.joints.len(), p.middles.len(), p.triangles.len()]).collect()
    }

    #[test]
    fn strips_stand_before_fills_each_with_its_own_parts() {
        let mut counts = counts(0.05);
        assert_eq!(counts.drain(..10).collect::<Vec<_>>(), [[4, 0, 2]; 10], "an edge is a strip");
        counts.sort_unstable();
        // Around the five corners of the base, and the tip with a vertex in its middle.
        assert_eq!(counts, [[[3, 0, 1]; 5].to_vec(), vec![[5, 1, 5]]].concat());
    }

    #[test]
    fn what_does_not_open_has_no_triangles() {
        assert_eq!(counts(0.0), [[0; 3]; 16]);
    }
}
