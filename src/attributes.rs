//! Attributes: every stream, re-sampled at the vertices that moved.
//!
//! A vertex whose corners lie in several sectors that part becomes several (thesis 6.2); the first
//! keeps the index, the others are appended. A flat face keeps its normal to the bit, a curved one
//! the shading that it had at that place.

mod collapsed;
mod index;
mod streams;

use crate::breaks::same_chart;
use crate::chamfers::Chamfers;
use crate::ids::{Corner, Few, IdVec, Sector, Vertex};
use crate::placement::Placement;
use crate::report::Blend;
use crate::resample::blended_normal;
use crate::scale::Space;
use crate::sectors::Sectors;
use crate::surface::Surface;
use crate::view::View;
use crate::weld::Weld;

use streams::Row;
pub use streams::{Streams, Taken};

/// The vertices of the result, as far as source triangles use them.
pub struct Attributes {
    /// The vertex streams; source vertices first.
    pub streams: Streams,
    /// `#corners`: the output vertex of each source corner.
    pub vertex_at: IdVec<Corner, u32>,
}

pub fn attributes(
    space: Space,
    surface: Surface,
    weld: &Weld,
    chamfers: Chamfers,
    placement: &Placement,
) -> Attributes {
    let vertex_at = surface.view.mesh.indices.to_vec();
    // At a seam both far vertices of a strip are copied.
    let copies = 2 * chamfers.edges.hard.iter().filter(|edge| edge.seams != 0).count();
    let mut attributes = Attributes {
        streams: Streams::of_source(space.source, chamfers.sectors.fans.len(), copies),
        vertex_at: IdVec::from_vec(vertex_at),
    };
    let (mut taken, mut parted) = (staying(surface, chamfers.sectors, placement), Vec::new());
    let moved = || chamfers.sectors.fans.ids().filter(|&sector| placement.has_moved(sector));
    for sector in moved() {
        move_sector(
            (space, surface),
            chamfers.sectors,
            placement,
            sector,
            (&mut taken, &mut parted),
            &mut attributes,
        );
    }
    attributes.streams.look_up(weld);
    add_parted((space, surface), placement, &parted, &mut attributes);
    if moved().next().is_some() {
        collapsed::close(surface.view, surface.topology, &mut attributes.vertex_at);
    }
    attributes
}

/// `#vertices`: whether some corner stays where it was, and so needs the source vertex.
fn staying(surface: Surface, sectors: &Sectors, placement: &Placement) -> IdVec<Vertex, bool> {
    let mut taken = IdVec::filled(false, surface.view.mesh.positions.len());
    for corner in sectors.sector_of.ids() {
        let sector = sectors.sector_of[corner];
        // Corners of collapsed triangles follow whatever else uses their vertex.
        let stays = sector.is_none() || !placement.has_moved(sector);
        if stays && !surface.topology.is_collapsed(corner.triangle()) {
            taken[surface.view.vertex_at(corner)] = true;
        }
    }
    taken
}

/// A corner whose vertex another sector has taken, and its own sector.
type Parted = (Sector, Corner);

/// Gives each vertex of a sector its new place: in its own index if that is free; else it is noted,
/// and past the source vertices its number among those noted stands for it.
fn move_sector(
    (space, surface): (Space, Surface),
    sectors: &Sectors,
    placement: &Placement,
    sector: Sector,
    (taken, parted): (&mut IdVec<Vertex, bool>, &mut Vec<Parted>),
    attributes: &mut Attributes,
) {
    let sources = surface.view.mesh.positions.len() as u32;
    let mut seen: Few<Seen> = Few::new();
    for corner in sectors.corners(surface.topology, sector) {
        let vertex = surface.view.vertex_at(corner);
        let known = seen.iter().find(|seen| seen.vertex == vertex).map(|seen| seen.output);
        attributes.vertex_at[corner] = known.unwrap_or_else(|| {
            let streams = &mut attributes.streams;
            let blends = blends(surface.view, placement, sector, corner);
            let row = row(space, placement, streams, sector, blends);
            let output = twin_of(space.source, streams, &seen, vertex, &row).unwrap_or_else(|| {
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
    view: &View,
    streams: &Streams,
    seen: &[Seen],
    vertex: Vertex,
    row: &Row,
) -> Option<u32> {
    let is_twin = |seen: &&Seen| {
        streams.are_equal(&seen.row, row)
            && !(view.normal(seen.vertex) == view.normal(vertex)
                && same_chart(view, seen.vertex, vertex))
    };
    seen.iter().find(is_twin).map(|seen| seen.output)
}

/// Appends the vertices that were noted, and puts them in the place of their numbers.
fn add_parted(
    (space, surface): (Space, Surface),
    placement: &Placement,
    parted: &[Parted],
    attributes: &mut Attributes,
) {
    let streams = &mut attributes.streams;
    let add = |&(sector, corner): &Parted| {
        let blends = blends(surface.view, placement, sector, corner);
        let row = row(space, placement, streams, sector, blends);
        streams.add_moved(surface.topology.cluster_at[corner], &row, blends)
    };
    let added: Vec<u32> = parted.iter().map(add).collect();
    let sources = surface.view.mesh.positions.len() as u32;
    for vertex in attributes.vertex_at.iter_mut().filter(|vertex| **vertex >= sources) {
        *vertex = added[(*vertex - sources) as usize];
    }
}

/// The values of a corner's vertex where its sector stands: the normal of the surface there, and all
/// else of its chart.
fn row(
    space: Space,
    placement: &Placement,
    streams: &Streams,
    sector: Sector,
    [surface, chart]: [Blend; 2],
) -> Row {
    let normal = blended_normal(space.source, &surface);
    streams.blended(space.source, (space.back(placement.point[sector]), normal), &chart)
}

/// Where a corner's vertex comes from when its sector takes a share of the offset: on the surface,
/// and in its chart.
fn blends(view: &View, placement: &Placement, sector: Sector, corner: Corner) -> [Blend; 2] {
    let share = placement.share[sector];
    let own = view.vertex_at(corner).0;
    let chart = placement.chart_foot(sector, corner);
    // Where the way begins at the vertex itself, that is the one to begin with.
    let from_own = |blend: Blend| match chart.start {
        [0.0, 0.0] => Blend { vertices: [own, blend.vertices[1], blend.vertices[2]], ..blend },
        _ => blend,
    };

    let surface = placement.surface_foot(sector, corner).blend(view, share);
    [surface, from_own(chart.blend(view, share))]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::MeshBuffers;
    use crate::shapes;
    use crate::stages::stages_of;

    fn attributes_of(mesh: &MeshBuffers, width: f32) -> Attributes {
        let stages = stages_of(mesh, width);
        stages.attributes(&stages.placement())
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
