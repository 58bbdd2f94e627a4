//! The vertex streams of the result: columns that grow by rows.
//!
//! A row has the values of one vertex in all streams. It is built from source values, looked up
//! among the rows that stand at its place, and appended only if it is new: so no two appended
//! vertices are equal in all streams.

use glam::{DVec2, DVec3};
use smallvec::SmallVec;

use super::Index;
use crate::error::Error;
use crate::ids::{Cluster, Id, Vertex};
use crate::math::unit;
use crate::mesh::{MeshBuffers, UV_CHANNELS, Uv, UvBuffer};
use crate::report::{Blend, VertexSource, VertexSources};
use crate::resample::{blended_normal, weighted_sum};
use crate::rounding::joined;
use crate::threads::Threads;
use crate::tolerance::{LEAST_REST, ORTHOGONAL};
use crate::view::{View, wide};
use crate::watch::Watch;
use crate::weld::Weld;

/// UV channels as bits.
pub type Channels = u8;

/// A place in a chart that a chamfer continues.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Taken {
    /// The UV channels that go there.
    pub channels: Channels,
    pub place: Blend,
}

/// What a stream holds that not every mesh has, and so how it is blended.
#[derive(Clone, Copy, PartialEq)]
enum Stream {
    /// A direction and a handedness.
    Tangent,
    Color,
    /// The number of the channel.
    Uv(usize),
}

impl Stream {
    /// Whether it goes along with some UV channels that go elsewhere: the tangent does with the first.
    fn is_taken(self, channels: Channels) -> bool {
        match self {
            Stream::Tangent => channels & 1 == 1,
            Stream::Uv(channel) => channels >> channel & 1 == 1,
            Stream::Color => false,
        }
    }
}

/// A stream that the mesh has.
#[derive(Clone, Copy)]
struct Column {
    stream: Stream,
    /// Where its values stand in a row, and how many there are.
    start: usize,
    width: usize,
}

impl Column {
    /// All values of the stream, vertex by vertex.
    fn values<'a>(&self, vertices: &'a MeshBuffers) -> &'a [f32] {
        match self.stream {
            Stream::Tangent => vertices.tangents.as_flattened(),
            Stream::Color => vertices.colors.as_flattened(),
            Stream::Uv(channel) => &vertices.uvs[channel].values,
        }
    }

    fn push(&self, vertices: &mut MeshBuffers, row: &Row) {
        match self.stream {
            Stream::Tangent => vertices.tangents.push(row.at(self.start)),
            Stream::Color => vertices.colors.push(row.at(self.start)),
            Stream::Uv(channel) => {
                let values = &mut vertices.uvs[channel].values;
                match self.width {
                    2 => values.extend_from_slice(&row.at::<2>(self.start)),
                    _ => values.extend_from_slice(row.of(self)),
                }
            }
        }
    }

    /// Appends the value of an earlier vertex.
    fn push_again(&self, vertices: &mut MeshBuffers, of: u32) {
        match self.stream {
            Stream::Tangent => vertices.tangents.push(vertices.tangents[of as usize]),
            Stream::Color => vertices.colors.push(vertices.colors[of as usize]),
            Stream::Uv(channel) => vertices.uvs[channel].values.extend_from_within(self.range(of)),
        }
    }

    /// Of one vertex.
    fn range(&self, vertex: u32) -> std::ops::Range<usize> {
        let first = vertex as usize * self.width;
        first..first + self.width
    }
}

/// Positions, normals, tangents, colours, and eight UV channels of four.
const MOST_VALUES: usize = 3 + 3 + 4 + 4 + 8 * 4;

/// The values of one vertex in all streams. Where there is no such stream, nothing is read.
#[derive(Clone, Copy)]
pub struct Row([f32; MOST_VALUES]);

impl Row {
    /// Nothing yet. Rows are filled where they lie: they are too large to be handed around.
    pub const EMPTY: Row = Row([0.0; MOST_VALUES]);

    #[inline]
    fn stand(&mut self, position: [f32; 3], normal: [f32; 3]) {
        self.0[POSITION..NORMAL].copy_from_slice(&position);
        self.0[NORMAL..FIRST_RARER].copy_from_slice(&normal);
    }

    fn of(&self, column: &Column) -> &[f32] {
        &self.0[column.start..column.start + column.width]
    }

    fn at<const WIDTH: usize>(&self, start: usize) -> [f32; WIDTH] {
        std::array::from_fn(|k| self.0[start + k])
    }

    fn of_mut(&mut self, column: &Column) -> &mut [f32] {
        &mut self.0[column.start..column.start + column.width]
    }

    #[inline]
    fn set(&mut self, column: &Column, values: &[f32]) {
        copy_few(values, self.of_mut(column));
    }
}

/// Where positions and normals stand in a row: every mesh has them.
const POSITION: usize = 0;
const NORMAL: usize = 3;

/// Where the rest begins.
const FIRST_RARER: usize = 6;

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

/// How the values of a mesh stand in its rows.
pub struct Layout {
    /// But for positions and normals.
    columns: SmallVec<[Column; 12]>,
    /// Per colour component, the least and the greatest value that a blend may have.
    color_range: [[f32; 2]; 4],
}

impl Layout {
    pub fn new(view: &View) -> Layout {
        Layout { columns: columns(view), color_range: color_range(view.mesh.colors) }
    }

    /// Whether two rows are equal in every stream.
    pub fn are_equal(&self, one: &Row, other: &Row) -> bool {
        one.0[..FIRST_RARER] == other.0[..FIRST_RARER]
            && self.columns.iter().all(|column| one.of(column) == other.of(column))
    }

    /// Makes a row at a position, with a normal, and all else blended in a chart.
    pub fn blend(
        &self,
        view: &View,
        (position, normal): (DVec3, DVec3),
        chart: &Blend,
        row: &mut Row,
    ) {
        row.stand(position.as_vec3().to_array(), normal.as_vec3().to_array());
        if let Some(column) = self.columns.iter().find(|column| column.stream == Stream::Color) {
            row.set(column, &self.color(view, chart));
        }
        self.take(view, row, &Taken { channels: Channels::MAX, place: *chart });
    }

    /// Takes UV channels from another place, and the tangent along with the first of them.
    fn take(&self, view: &View, row: &mut Row, Taken { channels, place }: &Taken) {
        for column in self.columns.iter().filter(|column| column.stream.is_taken(*channels)) {
            match column.stream {
                Stream::Tangent => {
                    row.set(column, &tangent(view, place, wide(row.at(NORMAL))));
                }
                Stream::Uv(channel) => {
                    let values = view.mesh.uvs[channel].values;
                    match column.width {
                        2 => row.set(column, &blended::<2>(values, place)),
                        3 => row.set(column, &blended::<3>(values, place)),
                        _ => row.set(column, &blended::<4>(values, place)),
                    }
                }
                Stream::Color => {}
            }
        }
    }

    fn color(&self, view: &View, chart: &Blend) -> [f32; 4] {
        let colors = chart.vertices.map(|vertex| view.mesh.colors[vertex as usize]);
        std::array::from_fn(|k| {
            let [least, greatest] = self.color_range[k];
            blend_value(chart, colors.map(|color| color[k])).clamp(least, greatest)
        })
    }
}

/// The streams of a mesh, side by side, but for positions and normals.
fn columns(view: &View) -> SmallVec<[Column; 12]> {
    let mesh = &view.mesh;
    let fours = [(Stream::Tangent, mesh.tangents), (Stream::Color, mesh.colors)];
    let fours = fours.into_iter().filter(|(_, values)| !values.is_empty());
    let uvs = mesh.uvs.iter().enumerate().filter(|(_, uv)| uv.components > 0);
    let uvs = uvs.map(|(channel, uv)| (Stream::Uv(channel), uv.components as usize));
    let all = fours.map(|(stream, _)| (stream, 4)).chain(uvs);
    let mut end = FIRST_RARER;
    all.map(|(stream, width)| {
        let start = end;
        end += width;
        Column { stream, start, width }
    })
    .collect()
}

/// Copies one value of a stream. Nearly all have two or four numbers, which need no call.
#[inline]
fn copy_few(from: &[f32], to: &mut [f32]) {
    match (from, to) {
        (&[u, v], [to_u, to_v]) => (*to_u, *to_v) = (u, v),
        (&[x, y, z, w], [to_x, to_y, to_z, to_w]) => {
            (*to_x, *to_y, *to_z, *to_w) = (x, y, z, w);
        }
        (from, to) => to.copy_from_slice(from),
    }
}

/// Whether two values of a stream are equal. Most have two numbers, which need no loop.
#[inline]
fn are_equal(one: &[f32], other: &[f32]) -> bool {
    match (one, other) {
        ([u, v], [other_u, other_v]) => u == other_u && v == other_v,
        _ => one == other,
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

/// A blend of the values of a stream that has so many for each vertex.
fn blended<const WIDTH: usize>(values: &[f32], blend: &Blend) -> [f32; WIDTH] {
    let values = values.as_chunks().0;
    let [a, b, c]: [[f32; WIDTH]; 3] = blend.vertices.map(|vertex| values[vertex as usize]);
    std::array::from_fn(|k| blend_value(blend, [a[k], b[k], c[k]]))
}

/// Equal values stay equal to the bit, whatever the weights.
#[inline]
fn blend_value(blend: &Blend, values: [f32; 3]) -> f32 {
    if values[0] == values[1] && values[0] == values[2] {
        return values[0];
    }
    let terms = [0, 1, 2].map(|k| f64::from(blend.weights[k]) * f64::from(values[k]));
    // Past a triangle with values of all sizes a blend may leave single precision.
    let blended = terms[0] + terms[1] + terms[2];
    blended.clamp(f32::MIN.into(), f32::MAX.into()) as f32
}

/// Equal values stay equal to the bit, whatever the weights. What has no weight has no say.
fn mean(values: [f32; 3], weights: [f64; 3]) -> f32 {
    let differs = |k: &usize| weights[*k] != 0.0 && values[*k] != values[0];
    if weights[0] != 0.0 && !(1..3).any(|k| differs(&k)) {
        return values[0];
    }
    let terms = [0, 1, 2].map(|k| weights[k] * f64::from(values[k]));
    (terms[0] + terms[1] + terms[2]) as f32
}

/// The mean direction, at a right angle to the normal, with the handedness of what weighs most.
fn mean_tangent(tangents: [[f32; 4]; 3], weights: [f64; 3], normal: DVec3) -> [f32; 4] {
    let directions = tangents.map(|[x, y, z, _]| wide([x, y, z]));
    let mixed =
        directions[0] * weights[0] + directions[1] * weights[1] + directions[2] * weights[2];
    let mut most = 0;
    for k in 1..3 {
        if weights[k] > weights[most] {
            most = k;
        }
    }
    let [x, y, z] = across(normal, [mixed, directions[most]]).as_vec3().to_array();
    [x, y, z, tangents[most][3]]
}

/// The first of some directions that has a part at a right angle to the normal: that part, unit.
#[inline]
fn across(normal: DVec3, directions: [DVec3; 2]) -> DVec3 {
    let across = |direction: DVec3| {
        let rest = direction - normal * direction.dot(normal);
        if rest.length() > LEAST_REST * direction.length() { unit(rest) } else { DVec3::ZERO }
    };
    directions
        .into_iter()
        .chain([normal.any_orthonormal_vector()])
        .map(across)
        .find(|direction| *direction != DVec3::ZERO)
        .unwrap_or(DVec3::X)
}

/// A blend may reach past its triangle: it stays within what the source holds.
fn color_range(colors: &[[f32; 4]]) -> [[f32; 2]; 4] {
    let mut range = [[f32::INFINITY, f32::NEG_INFINITY]; 4];
    for color in colors {
        for (bounds, &value) in range.iter_mut().zip(color) {
            *bounds = [bounds[0].min(value), bounds[1].max(value)];
        }
    }
    range
}

/// Unit, orthogonal to the normal, with the handedness of the chart. Where the chart goes on over
/// an edge, its tangent is turned along from its own normal.
// By itself, so that meshes without tangents prepare nothing for them.
#[inline(never)]
fn tangent(view: &View, chart: &Blend, normal: DVec3) -> [f32; 4] {
    let tangents = view.mesh.tangents;
    let own = tangents[chart.vertices[0] as usize];
    let is_constant = chart.vertices.iter().all(|&vertex| tangents[vertex as usize] == own);
    let is_orthogonal = wide([own[0], own[1], own[2]]).dot(normal).abs() < ORTHOGONAL;
    if is_constant && is_orthogonal {
        return own;
    }
    let directions = chart.vertices.map(|vertex| {
        let [x, y, z, _] = tangents[vertex as usize];
        wide([x, y, z])
    });
    let mixed = turned(weighted_sum(chart, directions), blended_normal(view, chart), normal);
    let [x, y, z] = across(normal, [mixed, directions[0]]).as_vec3().to_array();
    [x, y, z, own[3]]
}

/// A direction turned by the shortest turn that takes one unit vector to another.
fn turned(direction: DVec3, from: DVec3, to: DVec3) -> DVec3 {
    let cosine = from.dot(to);
    if cosine < LEAST_REST - 1.0 {
        return direction;
    }
    let middle = from + to;
    direction - middle * (middle.dot(direction) / (1.0 + cosine)) + to * (2.0 * from.dot(direction))
}

#[cfg(test)]
mod tests {
    use super::super::{blends, fill};
    use super::*;
    use crate::ids::Sector;
    use crate::shapes;
    use crate::stages::stages_of;

    // Past the end of a side from the least to the greatest number there is.
    #[test]
    fn a_blend_stays_within_single_precision() {
        let blend = Blend { vertices: [0, 1, 2], weights: [2.0, -1.0, 0.0] };
        assert_eq!(blend_value(&blend, [f32::MAX, f32::MIN, 0.0]), f32::MAX);
        assert_eq!(blend_value(&blend, [f32::MIN, f32::MAX, 0.0]), f32::MIN);
        assert_eq!(blend_value(&blend, [1.0, -1.0, 0.0]), 3.0);
    }

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
