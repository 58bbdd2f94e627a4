//! Rows: the values of one vertex in all streams, side by side, and how they are blended.

use glam::DVec3;
use smallvec::SmallVec;

use crate::math::unit;
use crate::mesh::{Mesh, MeshBuffers};
use crate::report::Blend;
use crate::resample::{blended_normal, weighted_sum};
use crate::tolerance::{LEAST_REST, ORTHOGONAL};
use crate::view::{View, wide};

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
pub enum Stream {
    /// A direction and a handedness.
    Tangent,
    Color,
    /// The number of the channel.
    Uv(usize),
}

impl Stream {
    /// The UV channels along with which it goes elsewhere: the tangent does with the first.
    fn channels(self) -> Channels {
        match self {
            Stream::Tangent => 1,
            Stream::Uv(channel) => 1 << channel,
            Stream::Color => 0,
        }
    }
}

/// A stream that the mesh has.
#[derive(Clone, Copy)]
pub struct Column {
    pub stream: Stream,
    /// The UV channels that it goes along with, as bits: see [`Stream::channels`].
    channels: Channels,
    /// Where its values stand in a row, and how many there are.
    pub start: usize,
    pub width: usize,
}

impl Column {
    /// Whether it goes along with some UV channels that go elsewhere.
    #[inline]
    pub fn is_taken(&self, channels: Channels) -> bool {
        self.channels & channels != 0
    }

    /// All values of the stream, vertex by vertex.
    #[inline]
    pub fn values<'a>(&self, vertices: &'a MeshBuffers) -> &'a [f32] {
        match self.stream {
            Stream::Tangent => vertices.tangents.as_flattened(),
            Stream::Color => vertices.colors.as_flattened(),
            Stream::Uv(channel) => &vertices.uvs[channel].values,
        }
    }

    #[inline(always)]
    pub fn push(&self, vertices: &mut MeshBuffers, row: &Row) {
        match self.stream {
            Stream::Uv(channel) if self.width == 2 => {
                vertices.uvs[channel].values.extend_from_slice(&row.at::<2>(self.start));
            }
            _ => self.push_rarer(vertices, row),
        }
    }

    #[inline(never)]
    fn push_rarer(&self, vertices: &mut MeshBuffers, row: &Row) {
        match self.stream {
            Stream::Tangent => vertices.tangents.push(row.at(self.start)),
            Stream::Color => vertices.colors.push(row.at(self.start)),
            Stream::Uv(channel) => vertices.uvs[channel].values.extend_from_slice(row.of(self)),
        }
    }

    /// Appends the value of a source vertex.
    pub fn push_source(&self, vertices: &mut MeshBuffers, (mesh, vertex): (&Mesh, u32)) {
        match self.stream {
            Stream::Tangent => vertices.tangents.push(mesh.tangents[vertex as usize]),
            Stream::Color => vertices.colors.push(mesh.colors[vertex as usize]),
            Stream::Uv(channel) => {
                let value = &mesh.uvs[channel].values[self.range(vertex)];
                vertices.uvs[channel].values.extend_from_slice(value);
            }
        }
    }

    /// Appends a blend, for a vertex with a normal.
    #[inline(always)]
    pub fn push_blended(
        &self,
        vertices: &mut MeshBuffers,
        (view, layout): (&View, &Layout),
        (place, normal): (&Blend, [f32; 3]),
    ) {
        match self.stream {
            Stream::Uv(channel) if self.width == 2 => {
                let value = blended::<2>(view.mesh.uvs[channel].values, place);
                vertices.uvs[channel].values.extend_from_slice(&value);
            }
            _ => self.push_rarer_blended(vertices, (view, layout), (place, normal)),
        }
    }

    #[inline(never)]
    fn push_rarer_blended(
        &self,
        vertices: &mut MeshBuffers,
        (view, layout): (&View, &Layout),
        (place, normal): (&Blend, [f32; 3]),
    ) {
        match self.stream {
            Stream::Tangent => vertices.tangents.push(tangent(view, place, wide(normal))),
            Stream::Color => vertices.colors.push(layout.color(view, place)),
            Stream::Uv(channel) => {
                let (from, to) = (view.mesh.uvs[channel].values, &mut vertices.uvs[channel].values);
                match self.width {
                    2 => to.extend_from_slice(&blended::<2>(from, place)),
                    3 => to.extend_from_slice(&blended::<3>(from, place)),
                    _ => to.extend_from_slice(&blended::<4>(from, place)),
                }
            }
        }
    }

    /// Appends the value of an earlier vertex.
    pub fn push_again(&self, vertices: &mut MeshBuffers, of: u32) {
        match self.stream {
            Stream::Tangent => vertices.tangents.push(vertices.tangents[of as usize]),
            Stream::Color => vertices.colors.push(vertices.colors[of as usize]),
            Stream::Uv(channel) => vertices.uvs[channel].values.extend_from_within(self.range(of)),
        }
    }

    /// Of one vertex.
    #[inline]
    pub fn range(&self, vertex: u32) -> std::ops::Range<usize> {
        let first = vertex as usize * self.width;
        first..first + self.width
    }
}

/// Positions, normals, tangents, colours, and eight UV channels of four.
pub const MOST_VALUES: usize = 3 + 3 + 4 + 4 + 8 * 4;

/// The values of one vertex in all streams. Where there is no such stream, nothing is read.
#[derive(Clone, Copy)]
pub struct Row(pub [f32; MOST_VALUES]);

impl Row {
    /// Nothing yet. Rows are filled where they lie: they are too large to be handed around.
    pub const EMPTY: Row = Row([0.0; MOST_VALUES]);

    #[inline]
    pub fn stand(&mut self, position: [f32; 3], normal: [f32; 3]) {
        self.0[POSITION..NORMAL].copy_from_slice(&position);
        self.0[NORMAL..FIRST_RARER].copy_from_slice(&normal);
    }

    #[inline]
    pub fn of(&self, column: &Column) -> &[f32] {
        &self.0[column.start..column.start + column.width]
    }

    #[inline]
    pub fn at<const WIDTH: usize>(&self, start: usize) -> [f32; WIDTH] {
        let values = &self.0[start..start + WIDTH];
        std::array::from_fn(|k| values[k])
    }

    fn of_mut(&mut self, column: &Column) -> &mut [f32] {
        &mut self.0[column.start..column.start + column.width]
    }

    #[inline]
    fn put<const WIDTH: usize>(&mut self, start: usize, values: [f32; WIDTH]) {
        self.0[start..start + WIDTH].copy_from_slice(&values);
    }

    #[inline]
    pub fn set(&mut self, column: &Column, values: &[f32]) {
        copy_few(values, self.of_mut(column));
    }
}

/// Where positions and normals stand in a row: every mesh has them.
pub const POSITION: usize = 0;
pub const NORMAL: usize = 3;

/// Where the rest begins.
const FIRST_RARER: usize = 6;

/// How the values of a mesh stand in its rows.
pub struct Layout {
    /// But for positions and normals.
    pub columns: SmallVec<[Column; 12]>,
    /// The UV channel that is the only of these, if that has two coordinates.
    pub only_texture: Option<usize>,
    /// Per colour component, the least and the greatest value that a blend may have.
    color_range: [[f32; 2]; 4],
}

impl Layout {
    pub fn new(view: &View) -> Layout {
        let columns = columns(view);
        let only_texture = match columns[..] {
            [Column { stream: Stream::Uv(channel), width: 2, .. }] => Some(channel),
            _ => None,
        };
        Layout { columns, only_texture, color_range: color_range(view.mesh.colors) }
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
    #[inline(always)]
    pub fn take(&self, view: &View, row: &mut Row, Taken { channels, place }: &Taken) {
        for column in &self.columns {
            if !column.is_taken(*channels) {
                continue;
            }
            match column.stream {
                Stream::Uv(channel) if column.width == 2 => {
                    row.put(column.start, blended::<2>(view.mesh.uvs[channel].values, place));
                }
                _ => take_rarer(view, row, column, place),
            }
        }
    }

    pub fn color(&self, view: &View, chart: &Blend) -> [f32; 4] {
        let colors = chart.vertices.map(|vertex| view.mesh.colors[vertex as usize]);
        std::array::from_fn(|k| {
            let [least, greatest] = self.color_range[k];
            blend_value(chart, colors.map(|color| color[k])).clamp(least, greatest)
        })
    }
}

/// The same for one column, most of which are two coordinates on a texture.
#[inline(never)]
fn take_rarer(view: &View, row: &mut Row, column: &Column, place: &Blend) {
    match column.stream {
        Stream::Tangent => row.set(column, &tangent(view, place, wide(row.at(NORMAL)))),
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
        Column { stream, channels: stream.channels(), start, width }
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
pub fn are_equal(one: &[f32], other: &[f32]) -> bool {
    match (one, other) {
        ([u, v], [other_u, other_v]) => u == other_u && v == other_v,
        _ => one == other,
    }
}

/// A blend of the values of a stream that has so many for each vertex.
#[inline]
pub fn blended<const WIDTH: usize>(values: &[f32], blend: &Blend) -> [f32; WIDTH] {
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
pub fn mean(values: [f32; 3], weights: [f64; 3]) -> f32 {
    let differs = |k: &usize| weights[*k] != 0.0 && values[*k] != values[0];
    if weights[0] != 0.0 && !(1..3).any(|k| differs(&k)) {
        return values[0];
    }
    let terms = [0, 1, 2].map(|k| weights[k] * f64::from(values[k]));
    (terms[0] + terms[1] + terms[2]) as f32
}

/// The mean direction, at a right angle to the normal, with the handedness of what weighs most.
pub fn mean_tangent(tangents: [[f32; 4]; 3], weights: [f64; 3], normal: DVec3) -> [f32; 4] {
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
pub fn tangent(view: &View, chart: &Blend, normal: DVec3) -> [f32; 4] {
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
    use super::*;

    // Past the end of a side from the least to the greatest number there is.
    #[test]
    fn a_blend_stays_within_single_precision() {
        let blend = Blend { vertices: [0, 1, 2], weights: [2.0, -1.0, 0.0] };
        assert_eq!(blend_value(&blend, [f32::MAX, f32::MIN, 0.0]), f32::MAX);
        assert_eq!(blend_value(&blend, [f32::MIN, f32::MAX, 0.0]), f32::MIN);
        assert_eq!(blend_value(&blend, [1.0, -1.0, 0.0]), 3.0);
    }
}
