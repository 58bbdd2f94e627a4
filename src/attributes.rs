//! Attributes: every stream, re-sampled at the vertices that moved.
//!
//! A vertex whose corners lie in several sectors that part becomes several (thesis 6.2); the first
//! keeps the index, the others are appended. A flat face keeps its normal to the bit, a curved one
//! the shading that it had at that place.

mod streams;

use crate::ids::{Corner, IdVec, Sector, Vertex};
use crate::placement::Placement;
use crate::plan::Plan;
use crate::report::{Blend, VertexSource};
use crate::resample::{chart_foot, surface_foot};

pub use streams::Streams;

/// The vertices of the result, as far as source triangles use them.
pub struct Attributes {
    /// The vertex streams; source vertices first.
    pub streams: Streams,
    /// `#corners`: the output vertex of each source corner.
    pub vertex_at: IdVec<Corner, u32>,
}

pub fn attributes(plan: &Plan, placement: &Placement) -> Attributes {
    let vertex_at = plan.view.mesh.indices.to_vec();
    let mut attributes =
        Attributes { streams: Streams::of_source(plan), vertex_at: IdVec::from_vec(vertex_at) };
    let mut taken = staying(plan, placement);
    for sector in plan.sectors.fans.ids().filter(|&sector| placement.has_moved(plan, sector)) {
        move_sector(plan, placement, sector, &mut taken, &mut attributes);
    }
    attributes
}

/// `#vertices`: whether some corner stays where it was, and so needs the source vertex.
fn staying(plan: &Plan, placement: &Placement) -> IdVec<Vertex, bool> {
    let mut taken = IdVec::filled(false, plan.view.mesh.positions.len());
    for corner in plan.sectors.sector_of.ids() {
        let sector = plan.sectors.sector_of[corner];
        // Corners of collapsed triangles follow whatever else uses their vertex.
        let stays = sector.is_none() || !placement.has_moved(plan, sector);
        if stays && !plan.topology.is_collapsed(corner.triangle()) {
            taken[plan.view.vertex_at(corner)] = true;
        }
    }
    taken
}

/// Gives each vertex of a sector its new place: in its own index if that is free, or appended.
fn move_sector(
    plan: &Plan,
    placement: &Placement,
    sector: Sector,
    taken: &mut IdVec<Vertex, bool>,
    attributes: &mut Attributes,
) {
    let mut seen: Vec<(Vertex, u32)> = Vec::new();
    for corner in plan.sectors.corners(&plan.topology, sector) {
        let vertex = plan.view.vertex_at(corner);
        let known = seen.iter().find(|(other, _)| *other == vertex).map(|(_, output)| *output);
        let output = known.unwrap_or_else(|| {
            let output = if taken[vertex] { attributes.streams.append(vertex) } else { vertex.0 };
            taken[vertex] = true;
            resample(plan, placement, sector, corner, output, &mut attributes.streams);
            seen.push((vertex, output));
            output
        });
        attributes.vertex_at[corner] = output;
    }
}

fn resample(
    plan: &Plan,
    placement: &Placement,
    sector: Sector,
    corner: Corner,
    output: u32,
    streams: &mut Streams,
) {
    let source = vertex_source(plan, sector, corner, placement.share[sector]);
    streams.resample(plan, output, placement.point[sector], source);
}

/// Where a corner's vertex comes from when its sector takes a share of the offset.
fn vertex_source(plan: &Plan, sector: Sector, corner: Corner, share: f64) -> VertexSource {
    let own = plan.view.vertex_at(corner).0;
    let chart = chart_foot(plan, sector, corner);
    // Where the way begins at the vertex itself, that is the one to begin with.
    let from_own = |blend: Blend| match chart.start {
        [0.0, 0.0] => Blend { vertices: [own, blend.vertices[1], blend.vertices[2]], ..blend },
        _ => blend,
    };

    VertexSource {
        surface: surface_foot(plan, sector, corner).blend(plan, share),
        chart: from_own(chart.blend(plan, share)),
    }
}
