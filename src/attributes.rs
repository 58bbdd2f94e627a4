//! Attributes: every stream, re-sampled at the vertices that moved.
//!
//! A vertex whose corners lie in several sectors that part becomes several (thesis 6.2); the first
//! keeps the index, the others are appended. A flat face keeps its normal to the bit, a curved one
//! the shading that it had at that place.

mod collapsed;
mod index;
pub mod middles;
mod streams;

use crate::breaks::same_chart;
use crate::ids::{Corner, Few, IdVec, Sector, Vertex};
use crate::placement::Placement;
use crate::plan::Plan;
use crate::report::Blend;
use crate::resample::{blended_normal, chart_foot, surface_foot};

use streams::Row;
pub use streams::{Streams, Taken};

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
    let (mut taken, mut parted) = (staying(plan, placement), Vec::new());
    let moved = || plan.sectors.fans.ids().filter(|&sector| placement.has_moved(plan, sector));
    for sector in moved() {
        move_sector(plan, placement, sector, (&mut taken, &mut parted), &mut attributes);
    }
    attributes.streams.look_up(plan);
    add_parted(plan, placement, &parted, &mut attributes);
    if moved().next().is_some() {
        collapsed::close(plan, &mut attributes.vertex_at);
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

/// A corner whose vertex another sector has taken, and its own sector.
type Parted = (Sector, Corner);

/// Gives each vertex of a sector its new place: in its own index if that is free; else it is noted,
/// and past the source vertices its number among those noted stands for it.
fn move_sector(
    plan: &Plan,
    placement: &Placement,
    sector: Sector,
    (taken, parted): (&mut IdVec<Vertex, bool>, &mut Vec<Parted>),
    attributes: &mut Attributes,
) {
    let sources = plan.view.mesh.positions.len() as u32;
    let mut seen: Few<Seen> = Few::new();
    for corner in plan.sectors.corners(&plan.topology, sector) {
        let vertex = plan.view.vertex_at(corner);
        let known = seen.iter().find(|seen| seen.vertex == vertex).map(|seen| seen.output);
        attributes.vertex_at[corner] = known.unwrap_or_else(|| {
            let streams = &mut attributes.streams;
            let blends = blends(plan, sector, corner, placement.share[sector]);
            let row = row(plan, placement, streams, sector, blends);
            let output = twin_of(plan, streams, &seen, vertex, &row).unwrap_or_else(|| {
                if taken[vertex] {
                    parted.push((sector, corner));
                    return sources + parted.len() as u32 - 1;
                }
                taken[vertex] = true;
                streams.set(vertex, &row, blends);
                vertex.0
            });
            seen.push(Seen { vertex, output, row });
            output
        });
    }
}

/// A source vertex of a sector, where it moves, and what stands for it there.
struct Seen {
    vertex: Vertex,
    output: u32,
    row: Row,
}

/// The vertex of a sector that another one of it has become equal to, though they differed before:
/// their normals were less than a degree apart.
fn twin_of(
    plan: &Plan,
    streams: &Streams,
    seen: &[Seen],
    vertex: Vertex,
    row: &Row,
) -> Option<u32> {
    let is_twin = |seen: &&Seen| {
        streams.are_equal(&seen.row, row)
            && !(plan.view.normal(seen.vertex) == plan.view.normal(vertex)
                && same_chart(&plan.view, seen.vertex, vertex))
    };
    seen.iter().find(is_twin).map(|seen| seen.output)
}

/// Appends the vertices that were noted, and puts them in the place of their numbers.
fn add_parted(plan: &Plan, placement: &Placement, parted: &[Parted], attributes: &mut Attributes) {
    let streams = &mut attributes.streams;
    let add = |&(sector, corner): &Parted| {
        let blends = blends(plan, sector, corner, placement.share[sector]);
        let row = row(plan, placement, streams, sector, blends);
        streams.add_moved(plan.topology.cluster_at[corner], &row, blends)
    };
    let added: Vec<u32> = parted.iter().map(add).collect();
    let sources = plan.view.mesh.positions.len() as u32;
    for vertex in attributes.vertex_at.iter_mut().filter(|vertex| **vertex >= sources) {
        *vertex = added[(*vertex - sources) as usize];
    }
}

/// The values of a corner's vertex where its sector stands: the normal of the surface there, and all
/// else of its chart.
fn row(
    plan: &Plan,
    placement: &Placement,
    streams: &Streams,
    sector: Sector,
    [surface, chart]: [Blend; 2],
) -> Row {
    let normal = blended_normal(plan, &surface);
    streams.blended(plan, (placement.point[sector], normal), &chart)
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

    let surface = surface_foot(plan, sector, corner).blend(&plan.view, share);
    [surface, from_own(chart.blend(&plan.view, share))]
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
        attributes(&plan, &limits(&plan, Verify::Fast).unwrap().placement)
    }

    #[test]
    fn a_vertex_of_one_sector_keeps_its_index() {
        let cube = shapes::cube(1.0);
        let result = attributes_of(&cube, 0.1);
        assert_eq!(result.streams.vertices.positions.len(), 24);
        assert!(result.vertex_at.iter().eq(&cube.indices));
    }

    #[test]
    fn a_vertex_of_two_sectors_becomes_two() {
        let cubes = shapes::extruding_cubes();
        let result = attributes_of(&cubes, 0.1);
        let sources = result.streams.vertices.positions.len();
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
