//! The vertex streams of the result: columns that grow by rows.
//!
//! A row is built from source values, looked up among the rows that stand at its place, and appended only
//! if it is new: so no two appended vertices are equal in all streams.

use glam::{DVec2, DVec3};

use super::rows::{
    Channels, Column, Layout, NORMAL, POSITION, Row, Stream, Taken, are_equal, blended, mean,
    mean_tangent,
};
use super::{Blends, Index};
use crate::ids::{Cluster, Id, Vertex};
use crate::mesh::{Mesh, MeshBuffers, Uv, UvBuffer};
use crate::report::{Blend, VertexSource, VertexSources};
use crate::resample::{is_same, stored_normal};
use crate::rounding::joined;
use crate::view::{View, wide};
use crate::weld::Weld;

/// Vertex streams that grow, with the provenance of each vertex.
pub struct Streams {
    /// The streams; the indices of the buffers stay empty.
    pub vertices: MeshBuffers,
    /// `#vertices`.
    pub sources: VertexSources,
    pub layout: Layout,
    index: Index,
    /// What a copy takes: kept, as making it takes longer than filling it.
    row: Row,
}

impl Streams {
    /// Those of the source vertices.
    pub fn new(Columns { vertices, sources }: Columns, layout: Layout) -> Streams {
        Streams { vertices, sources, layout, index: Index::default(), row: Row::EMPTY }
    }

    /// A vertex's value in a UV channel.
    #[inline]
    pub fn uv(&self, vertex: u32, channel: usize) -> DVec2 {
        let uv = &self.vertices.uvs[channel];
        let first = vertex as usize * uv.components as usize;
        DVec2::new(f64::from(uv.values[first]), f64::from(uv.values[first + 1]))
    }

    /// From here on, what is appended is looked up first: about so many. No vertex moves any more.
    pub fn look_up(&mut self, weld: &Weld, room: usize) {
        self.index = Index::of_source(weld, &self.vertices.positions, room);
    }

    /// A vertex of a cluster that has moved away from others of its source vertex.
    pub fn add_moved(&mut self, cluster: Cluster, row: &Row, (surface, chart): Blends) -> u32 {
        self.add(self.list_of(cluster, row), row, |sources| sources.push_moved(surface, chart))
    }

    /// What was appended as a vertex of a cluster like another one, but for what it takes from another chart.
    #[inline(never)]
    pub fn find_copy(&self, cluster: Cluster, of: u32, taken: &Taken) -> Option<u32> {
        let list = self.index.list_at(cluster, self.vertices.positions[of as usize]);
        let copies = self.sources.copies(of as usize, taken.place, taken.channels);
        self.index.find_since(self.sources.first_continuing(), list, copies)
    }

    /// A vertex of a cluster like another one, but for what it takes from another chart.
    #[inline]
    pub fn add_copy(&mut self, view: &View, cluster: Cluster, of: u32, taken: &Taken) -> u32 {
        match self.layout.only_texture {
            Some(channel) if taken.channels == 1 << channel => {
                let values = view.mesh.uvs[channel].values;
                self.add_copy_on_texture((channel, values), cluster, of, taken)
            }
            _ => self.add_copy_of_all(view, cluster, of, taken),
        }
    }

    /// The same whatever streams the mesh has.
    #[inline(never)]
    fn add_copy_of_all(&mut self, view: &View, cluster: Cluster, of: u32, taken: &Taken) -> u32 {
        let own = of as usize;
        let (position, normal) = (self.vertices.positions[own], self.vertices.normals[own]);
        let list = self.index.list_at(cluster, position);
        self.row.stand(position, normal);
        self.layout.take(view, &mut self.row, taken);
        if let Some(equal) = self.find_at(list, position, |at| self.is_copy(at, of, taken.channels))
        {
            return equal;
        }
        self.vertices.positions.push(position);
        self.vertices.normals.push(normal);
        for column in &self.layout.columns {
            match column.is_taken(taken.channels) {
                true => column.push(&mut self.vertices, &self.row),
                false => column.push_again(&mut self.vertices, of),
            }
        }
        self.sources.push_copy(own, taken.place, taken.channels);
        self.index.add(list)
    }

    /// The same where a mesh has nothing but one texture, as most do, which is taken.
    #[inline(never)]
    fn add_copy_on_texture(
        &mut self,
        (channel, values): (usize, &[f32]),
        cluster: Cluster,
        of: u32,
        taken: &Taken,
    ) -> u32 {
        let [u, v] = blended::<2>(values, &taken.place);
        let vertices = &self.vertices;
        let (position, normal) = (vertices.positions[of as usize], vertices.normals[of as usize]);
        let (positions, normals) = (&vertices.positions[..], &vertices.normals[..]);
        let uvs = vertices.uvs[channel].values.as_chunks().0;
        let list = self.index.list_at(cluster, position);
        // Nearly all lie elsewhere on the texture: that is what tells most soon.
        let is_equal = |at: u32| {
            let [other_u, other_v] = uvs[at as usize];
            u == other_u
                && v == other_v
                && is_same(position, positions[at as usize])
                && is_same(normal, normals[at as usize])
        };
        if let Some(equal) = self.index.find(list, is_equal) {
            return equal;
        }
        self.vertices.positions.push(position);
        self.vertices.normals.push(normal);
        self.vertices.uvs[channel].values.extend_from_slice(&[u, v]);
        self.sources.push_copy(of as usize, taken.place, taken.channels);
        self.index.add(list)
    }

    /// Whether a vertex is equal to another one but for some channels, and in these to the row.
    fn is_copy(&self, vertex: u32, of: u32, channels: Channels) -> bool {
        let normals = &self.vertices.normals;
        let is_equal = |column: &Column| {
            let values = column.values(&self.vertices);
            let wanted = match column.is_taken(channels) {
                true => self.row.of(column),
                false => &values[column.range(of)],
            };
            are_equal(&values[column.range(vertex)], wanted)
        };
        is_same(normals[of as usize], normals[vertex as usize])
            && self.layout.columns.iter().all(is_equal)
    }

    /// A vertex of a cluster with a normal of its own, at a place near a blend, with what it takes
    /// from another chart.
    pub fn add_between(
        &mut self,
        view: &View,
        cluster: Cluster,
        (position, normal): (DVec3, DVec3),
        (near, taken): (Blend, Option<&Taken>),
    ) -> u32 {
        let mut row = Row::EMPTY;
        self.layout.blend(view, (position, normal), &near, &mut row);
        let mut source = VertexSource::new(near, near);
        if let Some(taken) = taken {
            self.layout.take(view, &mut row, taken);
            (source.owner, source.owner_channels) = (taken.place, u32::from(taken.channels));
        }
        self.add(self.list_of(cluster, &row), &row, |sources| sources.push(source))
    }

    /// A vertex of a cluster on a rounded patch, with a place and a normal of its own, near a blend. All
    /// else is the mean of three vertices of the result, by weight. If it is shared with another
    /// patch, it is looked up.
    pub fn add_rounded(
        &mut self,
        cluster: Cluster,
        (position, normal): (DVec3, DVec3),
        (near, parents, weights, is_shared): (Blend, [u32; 3], [f64; 3], bool),
    ) -> u32 {
        let mut rows = [Row::EMPTY; 3];
        for (row, parent) in rows.iter_mut().zip(parents) {
            self.read(parent, row);
        }
        let mut row = Row::EMPTY;
        row.stand(position.as_vec3().to_array(), normal.as_vec3().to_array());
        for column in &self.layout.columns {
            for k in column.start..column.start + column.width {
                row.0[k] = mean(rows.each_ref().map(|row| row.0[k]), weights);
            }
        }
        if let Some(column) =
            self.layout.columns.iter().find(|column| column.stream == Stream::Tangent)
        {
            let tangents = rows.map(|row| row.at(column.start));
            row.set(column, &mean_tangent(tangents, weights, wide(row.at(NORMAL))));
        }
        let list = self.list_of(cluster, &row);
        let known = is_shared.then(|| self.find(list, &row));
        known.flatten().unwrap_or_else(|| {
            let source = self.source_between(near, parents, weights);
            self.push(&row);
            self.sources.push(source);
            if is_shared { self.index.add(list) } else { self.index.skip() }
        })
    }

    /// Where a vertex comes from that lies between three others.
    fn source_between(&self, near: Blend, parents: [u32; 3], weights: [f64; 3]) -> VertexSource {
        let sources = parents.map(|parent| self.sources.get(parent as usize));
        let between = |of: fn(&VertexSource) -> Blend| {
            let blends = sources.iter().map(of).zip(weights);
            joined(|vertex| vertex, blends.filter(|(_, weight)| *weight != 0.0))
        };
        let channels = sources.iter().fold(0, |all, source| all | source.owner_channels);
        let chart = between(|source| source.chart);
        let owner = if channels & !VertexSource::BETWEEN == 0 {
            chart
        } else {
            // What takes nothing from there has its own chart in these channels.
            between(|source| source.owner)
        };
        let owner_channels = channels | VertexSource::BETWEEN;
        VertexSource { surface: near, chart, owner, owner_channels }
    }

    /// The list in which a vertex of a cluster stands that has a row.
    fn list_of(&self, cluster: Cluster, row: &Row) -> usize {
        self.index.list_at(cluster, row.at(POSITION))
    }

    /// The vertex of a list that has a row: appended, if there is none.
    fn add(&mut self, list: usize, row: &Row, add_source: impl FnOnce(&mut VertexSources)) -> u32 {
        self.find(list, row).unwrap_or_else(|| {
            self.push(row);
            add_source(&mut self.sources);
            self.index.add(list)
        })
    }

    fn push(&mut self, row: &Row) {
        self.vertices.positions.push(row.at(POSITION));
        self.vertices.normals.push(row.at(NORMAL));
        self.layout.columns.iter().for_each(|column| column.push(&mut self.vertices, row));
    }

    /// The vertex of a list that has a row.
    fn find(&self, list: usize, row: &Row) -> Option<u32> {
        self.find_at(list, row.at(POSITION), |vertex| self.has(vertex, row))
    }

    /// A vertex of a list that stands at a position and is such. Most that came from one cluster stand
    /// elsewhere.
    #[inline]
    fn find_at(
        &self,
        list: usize,
        position: [f32; 3],
        is_such: impl Fn(u32) -> bool,
    ) -> Option<u32> {
        let positions = &self.vertices.positions[..];
        let stands_there = |vertex: u32| is_same(positions[vertex as usize], position);
        self.index.find(list, |listed| stands_there(listed) && is_such(listed))
    }

    /// Whether a vertex that stands at a row's position has the row.
    fn has(&self, vertex: u32, row: &Row) -> bool {
        let own = |column: &Column| &column.values(&self.vertices)[column.range(vertex)];
        self.vertices.normals[vertex as usize] == row.at(NORMAL)
            && self.layout.columns.iter().all(|column| own(column) == row.of(column))
    }

    /// Reads the row of a vertex.
    fn read(&self, vertex: u32, row: &mut Row) {
        let MeshBuffers { positions, normals, .. } = &self.vertices;
        row.stand(positions[vertex as usize], normals[vertex as usize]);
        for column in &self.layout.columns {
            row.set(column, &column.values(&self.vertices)[column.range(vertex)]);
        }
    }
}

/// Source vertices, as they were or moved, with where they come from.
#[derive(Default)]
pub struct Columns {
    vertices: MeshBuffers,
    sources: VertexSources,
}

impl Columns {
    /// None yet, with room for all of a mesh, of which some will move, and for copies of some.
    pub fn with_room(mesh: &Mesh, moved: usize, copies: usize) -> Columns {
        let sources = VertexSources::with_room(mesh.positions.len(), moved, copies);
        Columns { vertices: with_room(mesh, copies), sources }
    }

    /// Appends a vertex as it was.
    pub fn push_kept(&mut self, (view, layout): (&View, &Layout), vertex: Vertex) {
        let (mesh, place) = (&view.mesh, vertex.index());
        self.vertices.positions.push(mesh.positions[place]);
        self.vertices.normals.push(mesh.normals[place]);
        for column in &layout.columns {
            column.push_source(&mut self.vertices, (mesh, vertex.0));
        }
        self.sources.push_kept(vertex.0);
    }

    /// Appends a vertex that has moved, all of whose values are those of one blend, just as in a [`Row`].
    #[inline(always)]
    pub fn push_moved(&mut self, source: (&View, &Layout), position: [f32; 3], blend: Blend) {
        self.push_blended(source, position, [&blend; 2]);
        self.sources.push_moved(blend, None);
    }

    /// The same where its chart may be something else than its surface.
    #[inline(never)]
    pub fn push_moved_apart(
        &mut self,
        source: (&View, &Layout),
        position: [f32; 3],
        (surface, chart): Blends,
    ) {
        self.push_blended(source, position, [&surface, chart.as_ref().unwrap_or(&surface)]);
        self.sources.push_moved(surface, chart);
    }

    #[inline(always)]
    fn push_blended(
        &mut self,
        (view, layout): (&View, &Layout),
        position: [f32; 3],
        [surface, chart]: [&Blend; 2],
    ) {
        let normal = stored_normal(view, surface);
        self.vertices.positions.push(position);
        self.vertices.normals.push(normal);
        for column in &layout.columns {
            column.push_blended(&mut self.vertices, (view, layout), (chart, normal));
        }
    }

    /// Appends others, and takes them away from there.
    pub fn append(&mut self, others: &mut Columns) {
        let Columns { vertices: all, sources } = self;
        let some = &mut others.vertices;
        all.positions.append(&mut some.positions);
        all.normals.append(&mut some.normals);
        all.tangents.append(&mut some.tangents);
        all.colors.append(&mut some.colors);
        for (all, some) in all.uvs.iter_mut().zip(&mut some.uvs) {
            all.values.append(&mut some.values);
        }
        sources.append(&mut others.sources);
    }
}

/// The streams that a mesh has, empty, with room for its vertices and some more.
fn with_room(mesh: &Mesh, room: usize) -> MeshBuffers {
    let room_for = |values: usize| if values == 0 { 0 } else { mesh.positions.len() + room };
    MeshBuffers {
        positions: Vec::with_capacity(room_for(mesh.positions.len())),
        normals: Vec::with_capacity(room_for(mesh.normals.len())),
        tangents: Vec::with_capacity(room_for(mesh.tangents.len())),
        colors: Vec::with_capacity(room_for(mesh.colors.len())),
        uvs: mesh.uvs.map(|Uv { components, values }| UvBuffer {
            components,
            values: Vec::with_capacity(components as usize * room_for(values.len())),
        }),
        ..MeshBuffers::default()
    }
}

#[cfg(test)]
mod tests {
    use super::super::{blends, fill};
    use super::*;
    use crate::ids::Sector;
    use crate::shapes;
    use crate::stages::stages_of;

    // What moves within its own index is blended right into the streams, and what is parted as a row.
    #[test]
    fn streams_hold_what_rows_would() {
        for (name, mesh) in shapes::demo_models() {
            let stages = stages_of(&mesh, 0.01);
            let placement = stages.placement();
            let attributes = stages.attributes(&placement);
            let moved = |sector: &Sector| placement.has_moved(*sector);
            for sector in stages.sectors.fans.ids().filter(moved) {
                let corner = stages.sectors.fans[sector].first;
                let blends = blends(&stages.view, &placement, sector, corner);
                let mut row = Row::EMPTY;
                let layout = &attributes.streams.layout;
                fill(stages.space(), &placement, layout, (sector, blends), &mut row);
                let vertex = attributes.vertex_at[corner];
                assert!(attributes.streams.has_at(vertex, &row), "{name}, vertex {vertex}");
            }
        }
    }

    impl Streams {
        fn has_at(&self, vertex: u32, row: &Row) -> bool {
            self.vertices.positions[vertex as usize] == row.at(POSITION) && self.has(vertex, row)
        }
    }
}
