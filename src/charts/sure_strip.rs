//! Strips that lie well on the texture by the first way, of meshes with a single UV channel, which is
//! told sooner here. That is nearly all of them; of others, and where it is not sure, nothing is said.

use glam::DVec2;

use super::feet::{on_edge, share_of};
use super::fit::Measure;
use super::ground::{Face, Ground};
use super::strip_map::{Band, places};
use super::{BANDS, Given};
use crate::attributes::Attributes;
use crate::edges::HardEdge;
use crate::ids::{Corner, Id, Triangle};
use crate::report::Blend;
use crate::strips;
use crate::view::{View, wide};

/// What is read of a mesh with one UV channel of two components.
pub struct OneChannel<'a> {
    pub channel: usize,
    /// The vertices of each triangle.
    triangles: &'a [[u32; 3]],
    positions: &'a [[f32; 3]],
    /// Where the vertices of the source lie on the texture.
    source: &'a [[f32; 2]],
    /// Where those of the output do.
    pub output: &'a [[f32; 2]],
}

impl<'a> OneChannel<'a> {
    pub fn new(view: &View<'a>, attributes: &'a Attributes, channels: &[usize]) -> Option<Self> {
        let &[channel] = channels else { return None };
        let uv = view.mesh.uvs[channel];
        (uv.components == 2).then(|| OneChannel {
            channel,
            triangles: view.mesh.indices.as_chunks().0,
            positions: view.mesh.positions,
            source: uv.values.as_chunks().0,
            output: attributes.streams.vertices.uvs[channel].values.as_chunks().0,
        })
    }

    #[inline(always)]
    pub fn place_of(&self, blend: &Blend) -> DVec2 {
        let of = |k: usize| {
            wide_uv(self.source[blend.vertices[k] as usize]) * f64::from(blend.weights[k])
        };
        // Most blends lie on an edge.
        let on_edge = of(0) + of(1);
        if blend.weights[2] == 0.0 { on_edge } else { on_edge + of(2) }
    }

    /// How a source triangle lies on the texture, and what others are measured by there.
    #[inline(always)]
    pub fn face(&self, triangle: Triangle) -> (Face, Measure) {
        let [a, b, c] = self.triangles[triangle.index()];
        let uv = |vertex: u32| wide_uv(self.source[vertex as usize]);
        let face = Face::new([uv(a), uv(b), uv(c)]);
        let point = |vertex: u32| wide(self.positions[vertex as usize]);
        let points = [point(a), point(b), point(c)];
        (face, Measure::new(points, &face))
    }
}

#[inline(always)]
pub fn wide_uv([u, v]: [f32; 2]) -> DVec2 {
    DVec2::new(f64::from(u), f64::from(v))
}

/// The first of [`BANDS`], of those of a side, if the strip of an edge with a seam surely fits there.
#[inline(always)]
pub fn sure_band(
    given: &Given,
    (edge, triangles): (&HardEdge, &[[u32; 3]]),
    owner: usize,
) -> Option<Band> {
    let halves = triangles.try_into().ok()?;
    match owner {
        0 => given.one_channel.as_ref()?.band::<0>(given, edge, halves),
        _ => given.one_channel.as_ref()?.band::<1>(given, edge, halves),
    }
}

impl OneChannel<'_> {
    /// That of one of the sides, which is known where this is compiled.
    #[inline]
    fn band<const OWNER: usize>(
        &self,
        given: &Given,
        edge: &HardEdge,
        halves: &[[u32; 3]; 2],
    ) -> Option<Band> {
        let (view, half_edge) = (given.surface.view, edge.sides[OWNER]);
        let corners @ [b1, a1, a2, b2] = strips::corners(edge);
        let at = |corner: Corner| given.placement.position_at(corner);
        let points = [at(b1), at(a1), at(a2), at(b2)];
        let ends = [view.position_at(half_edge), view.position_at(half_edge.next())];
        let [[start, over_start], [stop, over_stop]] = places(OWNER);
        let foot = |far: usize| on_edge(view, half_edge, share_of(ends, points[far]));
        let far = [foot(over_start), foot(over_stop)];
        let own = |place: usize| {
            wide_uv(self.output[given.attributes.vertex_at[corners[place]] as usize])
        };
        let near = [own(start), own(stop)];
        let mut uvs = [DVec2::ZERO; 4];
        [uvs[start], uvs[stop]] = near;
        [uvs[over_start], uvs[over_stop]] = [self.place_of(&far[0]), self.place_of(&far[1])];
        let (face, measure) = self.face(half_edge.triangle());
        // Whichever the diagonal: see `strips::Cut`.
        let [k, l] = [halves[0][2] as usize, halves[1][0] as usize];
        let is_alike = measure
            .is_surely_alike([points[0], points[1], points[k]], [uvs[0], uvs[1], uvs[k]])
            && measure.is_surely_alike([points[l], points[2], points[3]], [uvs[l], uvs[2], uvs[3]]);
        // The far corners lie on a side of the owner's triangle.
        let is_covered = || {
            face.holds(near[0]) && face.holds(near[1]) || {
                let ends = [half_edge, half_edge.next()];
                let ground = Ground::new(given.surface, self.channel, &ends);
                ground.covers_past(face, (halves, &uvs), &near)
            }
        };
        (is_alike && is_covered()).then_some(Band { spread: BANDS[0], far: far.map(Some) })
    }
}
