//! The vertex streams of the result: columns that grow by rows.
//!
//! A row is built from source values, looked up among the rows that stand at its place, and appended only
//! if it is new: so no two appended vertices are equal in all streams.

use glam::{DVec2, DVec3};

use super::Index;
use super::rows::{
    Column, Layout, NORMAL, POSITION, Row, Stream, Taken, are_equal, blended, mean, mean_tangent,
    tangent,
};
use crate::error::Error;
use crate::ids::{Cluster, Id, Vertex};
use crate::mesh::{MeshBuffers, UV_CHANNELS, Uv, UvBuffer};
use crate::report::{Blend, VertexSource, VertexSources};
use crate::resample::blended_normal;
use crate::rounding::joined;
use crate::threads::Threads;
use crate::view::{View, wide};
use crate::watch::Watch;
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
    /// The streams of the source, with room for some more vertices. `moved` tells where each of them that
    /// has moved stands, whose values are blended as its source tells: just as in a [`Row`], but stream by
    /// stream.
    pub fn new(
        (view, layout): (&View, Layout),
        sources: VertexSources,
        moved: impl Fn(Vertex) -> Option<[f32; 3]> + Sync + Send,
        room: usize,
        work: (&Threads, &dyn Watch),
    ) -> Result<Streams, Error> {
        let mesh = &view.mesh;
        let chart = |vertex: Vertex| sources.chart_of(vertex.index());
        let normal = |vertex: Vertex| {
            let surface = sources.surface_of(vertex.index())?;
            Some(blended_normal(view, surface).as_vec3().to_array())
        };
        let normals = changed(mesh.normals, room, work, normal)?;
        let tangent =
            |vertex: Vertex| Some(tangent(view, chart(vertex)?, wide(normals[vertex.index()])));
        let color = |vertex: Vertex| Some(layout.color(view, chart(vertex)?));
        let vertices = MeshBuffers {
            positions: changed(mesh.positions, room, work, moved)?,
            tangents: changed(mesh.tangents, room, work, tangent)?,
            colors: changed(mesh.colors, room, work, color)?,
            uvs: blended_uvs(&mesh.uvs, room, work, chart)?,
            normals,
            ..MeshBuffers::default()
        };
        Ok(Streams { vertices, sources, layout, index: Index::default(), row: Row::EMPTY })
    }

    /// A vertex's value in a UV channel.
    #[inline]
    pub fn uv(&self, vertex: u32, channel: usize) -> DVec2 {
        let uv = &self.vertices.uvs[channel];
        let first = vertex as usize * uv.components as usize;
        DVec2::new(f64::from(uv.values[first]), f64::from(uv.values[first + 1]))
    }

    /// From here on, what is appended is looked up first. No vertex moves any more.
    pub fn look_up(&mut self, weld: &Weld) {
        self.index = Index::of_source(weld, &self.vertices.positions);
    }

    /// A vertex of a cluster that has moved away from others of its source vertex.
    pub fn add_moved(&mut self, cluster: Cluster, row: &Row, [surface, chart]: [Blend; 2]) -> u32 {
        self.add(self.list_of(cluster, row), row, |sources| sources.push_moved(surface, chart))
    }

    /// A vertex of a cluster like another one, but for what it takes from another chart, where a patch before
    /// may have taken just that.
    pub fn find_or_add_copy(
        &mut self,
        view: &View,
        cluster: Cluster,
        of: u32,
        taken: &Taken,
    ) -> u32 {
        let list = self.index.list_at(cluster, self.vertices.positions[of as usize]);
        let copies = self.sources.copies(of as usize, taken.place, taken.channels);
        let copy = self.index.find_since(self.sources.first_continuing(), list, copies);
        copy.unwrap_or_else(|| self.add_copy(view, cluster, of, taken))
    }

    /// The same, where that is not likely.
    pub fn add_copy(&mut self, view: &View, cluster: Cluster, of: u32, taken: &Taken) -> u32 {
        let own = of as usize;
        let (position, normal) = (self.vertices.positions[own], self.vertices.normals[own]);
        let list = self.index.list_at(cluster, position);
        let row = &mut self.row;
        row.stand(position, normal);
        self.layout.take(view, row, taken);
        // All but what it takes is read where the other has it.
        let value = |column: &Column| match column.stream.is_taken(taken.channels) {
            true => row.of(column),
            false => &column.values(&self.vertices)[column.range(of)],
        };
        let is_equal = |listed: u32| {
            let is_equal = |column: &Column| {
                are_equal(&column.values(&self.vertices)[column.range(listed)], value(column))
            };
            position == self.vertices.positions[listed as usize]
                && normal == self.vertices.normals[listed as usize]
                && self.layout.columns.iter().all(is_equal)
        };
        if let Some(equal) = self.index.find(list, is_equal) {
            return equal;
        }
        self.vertices.positions.push(position);
        self.vertices.normals.push(normal);
        for column in &self.layout.columns {
            match column.stream.is_taken(taken.channels) {
                true => column.push(&mut self.vertices, &self.row),
                false => column.push_again(&mut self.vertices, of),
            }
        }
        self.sources.push_copy(own, taken.place, taken.channels);
        self.index.add(list)
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
        let [x, y, z] = row.at(POSITION);
        // Most that came from one cluster stand elsewhere.
        let stands_there = |vertex: u32| {
            let [at_x, at_y, at_z] = self.vertices.positions[vertex as usize];
            at_x == x && at_y == y && at_z == z
        };
        self.index.find(list, |listed| stands_there(listed) && self.has(listed, row))
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

/// A copy of a stream with room for some more, in which some values are others; an absent stream stays
/// absent.
fn changed<T: Copy + Send + Sync>(
    values: &[T],
    room: usize,
    (threads, watch): (&Threads, &dyn Watch),
    other: impl Fn(Vertex) -> Option<T> + Sync + Send,
) -> Result<Vec<T>, Error> {
    let room = if values.is_empty() { 0 } else { room };
    let mut all = Vec::with_capacity(values.len() + room);
    let value = |vertex: Vertex| other(vertex).unwrap_or(values[vertex.index()]);
    threads.extend(&mut all, values.len(), watch, value)?;
    Ok(all)
}

/// All UV channels, blended where a vertex has a chart to be blended in.
fn blended_uvs<'a>(
    uvs: &[Uv; UV_CHANNELS],
    room: usize,
    work: (&Threads, &dyn Watch),
    chart: impl Fn(Vertex) -> Option<&'a Blend> + Sync + Send,
) -> Result<[UvBuffer; UV_CHANNELS], Error> {
    let mut all: [UvBuffer; UV_CHANNELS] = Default::default();
    for (all, uv) in all.iter_mut().zip(uvs) {
        let values = match uv.components {
            2 => blended_uv::<2>(uv.values, room, work, &chart)?,
            3 => blended_uv::<3>(uv.values, room, work, &chart)?,
            _ => blended_uv::<4>(uv.values, room, work, &chart)?,
        };
        *all = UvBuffer { components: uv.components, values };
    }
    Ok(all)
}

fn blended_uv<'a, const WIDTH: usize>(
    values: &[f32],
    room: usize,
    work: (&Threads, &dyn Watch),
    chart: impl Fn(Vertex) -> Option<&'a Blend> + Sync + Send,
) -> Result<Vec<f32>, Error> {
    let blended = |vertex: Vertex| Some(blended::<WIDTH>(values, chart(vertex)?));
    Ok(changed(values.as_chunks().0, room, work, blended)?.into_flattened())
}

#[cfg(test)]
mod tests {
    use super::super::{blends, fill};
    use super::*;
    use crate::ids::Sector;
    use crate::shapes;
    use crate::stages::stages_of;

    // What moves within its own index is made stream by stream, and what is parted as a row.
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
