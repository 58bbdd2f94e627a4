//! Attributes: every stream, re-sampled at the vertices that moved.
//!
//! A vertex whose corners lie in several sectors that part becomes several (thesis 6.2); the first
//! keeps the index, the others are appended. A flat face keeps its normal to the bit, a curved one
//! the shading that it had at that place.

pub mod middles;
mod streams;

use crate::ids::{Corner, Few, IdVec, Sector, Vertex};
use crate::placement::Placement;
use crate::plan::Plan;
use crate::report::Blend;
use crate::resample::{chart_foot, same_chart, surface_foot};

pub use streams::{Channels, Streams};

/// The vertices of the result, as far as source triangles use them.
pub struct Attributes {
    /// The vertex streams; source vertices first.
    pub streams: Streams,
    /// `#corners`: the output vertex of each source corner.
    pub vertex_at: IdVec<Corner, u32>,
}

pub fn attributes(plan: &Plan, placement: &Placement) -> Attributes {
    let vertex_at = plan.view.mesh.indices.to_vec();
    // At a seam both far vertices of a strip are copied.
    let copies = 2 * plan.edges.hard.iter().filter(|edge| edge.seams != 0).count();
    let mut attributes = Attributes {
        streams: Streams::of_source(&plan.view, plan.sectors.fans.len(), copies),
        vertex_at: IdVec::from_vec(vertex_at),
    };
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
    let mut seen: Few<(Vertex, u32)> = Few::new();
    for corner in plan.sectors.corners(&plan.topology, sector) {
        let vertex = plan.view.vertex_at(corner);
        let known = seen.iter().find(|(other, _)| *other == vertex).map(|(_, output)| *output);
        let output = known.unwrap_or_else(|| {
            let streams = &mut attributes.streams;
            let output = if taken[vertex] { streams.append(vertex) } else { vertex.0 };
            resample(plan, placement, sector, corner, output, streams);
            match twin_of(plan, streams, &seen, vertex, output) {
                Some(twin) => {
                    streams.give_back(plan, output);
                    twin
                }
                None => {
                    taken[vertex] = true;
                    output
                }
            }
        });
        if known.is_none() {
            seen.push((vertex, output));
        }
        attributes.vertex_at[corner] = output;
    }
}

/// The vertex of a sector that another one of it has become equal to, though they differed before:
/// their normals were less than a degree apart.
fn twin_of(
    plan: &Plan,
    streams: &Streams,
    seen: &[(Vertex, u32)],
    vertex: Vertex,
    output: u32,
) -> Option<u32> {
    let is_twin = |&&(other, known): &&(Vertex, u32)| {
        streams.are_equal(known, output)
            && !(plan.view.normal(other) == plan.view.normal(vertex)
                && same_chart(plan, other, vertex))
    };
    seen.iter().find(is_twin).map(|&(_, known)| known)
}

fn resample(
    plan: &Plan,
    placement: &Placement,
    sector: Sector,
    corner: Corner,
    output: u32,
    streams: &mut Streams,
) {
    let blends = blends(plan, sector, corner, placement.share[sector]);
    streams.resample(plan, output, placement.point[sector], blends);
}

/// Where a corner's vertex comes from when its sector takes a share of the offset: on the surface,
/// and in its chart.
fn blends(plan: &Plan, sector: Sector, corner: Corner, share: f64) -> [Blend; 2] {
    let own = plan.view.vertex_at(corner).0;
    let chart = chart_foot(plan, sector, corner);
    // Where the way begins at the vertex itself, that is the one to begin with.
    let from_own = |blend: Blend| match chart.start {
        [0.0, 0.0] => Blend { vertices: [own, blend.vertices[1], blend.vertices[2]], ..blend },
        _ => blend,
    };

    let surface = surface_foot(plan, sector, corner).blend(plan, share);
    [surface, from_own(chart.blend(plan, share))]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::limits::limits;
    use crate::mesh::MeshBuffers;
    use crate::options::Verify;
    use crate::plan::tests::plan_of;
    use crate::shapes;

    fn attributes_of(mesh: &MeshBuffers, width: f32) -> Attributes {
        let plan = plan_of(mesh, width);
        attributes(&plan, &limits(&plan, Verify::Fast).placement)
    }

    #[test]
    fn a_vertex_of_one_sector_keeps_its_index() {
        let cube = shapes::cube(1.0);
        let result = attributes_of(&cube, 0.1);
        assert_eq!(result.streams.count(), 24);
        assert!(result.vertex_at.iter().eq(&cube.indices));
    }

    #[test]
    fn a_vertex_of_two_sectors_becomes_two() {
        let cubes = shapes::extruding_cubes();
        let result = attributes_of(&cubes, 0.1);
        let sources = result.streams.count() as usize;
        assert_eq!(sources, cubes.positions.len() + 3, "three vertices are corner-connected");
    }

    #[test]
    fn each_stream_is_read_at_the_new_place() {
        let cube = shapes::cube(1.0);
        let moved = attributes_of(&cube, 0.1).streams.vertices;
        for (old, new) in cube.uvs[0].values.iter().zip(&moved.uvs[0].values) {
            // A tenth of a side is as much of its square in the atlas: 0.3 wide, 0.45 high.
            let step = (old - new).abs();
            assert!((step - 0.03).abs() < 1e-6 || (step - 0.045).abs() < 1e-6, "{step}");
        }
        assert_eq!(moved.tangents, cube.tangents);
    }

    #[test]
    fn colours_stay_between_those_around() {
        let table = shapes::table();
        let moved = attributes_of(&table, 0.01).streams.vertices;
        for (color, [_, y, _]) in moved.colors.iter().zip(&moved.positions) {
            assert!((color[0] - (0.3 + 0.6 * y)).abs() < 1e-5, "{color:?} at {y}");
        }
    }
}
