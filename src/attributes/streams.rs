//! The vertex streams of the result, and how a blend of source vertices is evaluated in each.

use glam::{DVec2, DVec3};

use crate::ids::{Id, Vertex};
use crate::math::unit;
use crate::mesh::{MeshBuffers, Uv, UvBuffer};
use crate::plan::Plan;
use crate::report::{Blend, VertexSource, VertexSources};
use crate::resample::{blended_normal, weighted_sum};
use crate::seams::Taken;
use crate::view::{View, wide};

/// UV channels as bits.
pub type Channels = u8;

/// Vertex streams that grow, with the provenance of each vertex.
pub struct Streams {
    /// The streams; the indices of the buffers stay empty.
    pub vertices: MeshBuffers,
    /// `#vertices`.
    pub sources: VertexSources,
    /// The channels from here on are absent.
    uv_end: usize,
    /// Per colour component, the least and the greatest value that a blend may have.
    color_range: [[f32; 2]; 4],
}

impl Streams {
    /// The streams of the source as they are. So many of its vertices will move, about; and there
    /// is room for some more.
    pub fn of_source(view: &View, moved: usize, room: usize) -> Streams {
        let mesh = &view.mesh;
        let uv = |uv: &Uv| UvBuffer {
            components: uv.components,
            values: copied(uv.values, room * uv.components as usize),
        };
        Streams {
            vertices: MeshBuffers {
                positions: copied(mesh.positions, room),
                normals: copied(mesh.normals, room),
                tangents: copied(mesh.tangents, room),
                colors: copied(mesh.colors, room),
                uvs: mesh.uvs.each_ref().map(uv),
                ..MeshBuffers::default()
            },
            sources: VertexSources::with_room(mesh.positions.len(), moved, room),
            uv_end: mesh.uvs.iter().rposition(|uv| uv.components > 0).map_or(0, |last| last + 1),
            color_range: color_range(mesh.colors),
        }
    }

    pub fn count(&self) -> u32 {
        self.vertices.positions.len() as u32
    }

    /// Appends a vertex like an earlier one, to be set to another place.
    pub fn append(&mut self, vertex: Vertex) -> u32 {
        self.append_values(vertex.index());
        self.sources.push_like(vertex.index());
        self.count() - 1
    }

    /// Appends a copy of a vertex with what it takes from another chart.
    pub fn append_copy(&mut self, plan: &Plan, vertex: u32, taken: &Taken) -> u32 {
        let from = vertex as usize;
        if !self.vertices.tangents.is_empty() {
            let tangent = self.tangent_of_copy(plan, from, taken);
            self.vertices.tangents.push(tangent);
        }
        for channel in 0..self.uv_end {
            for k in 0..self.vertices.uvs[channel].components as usize {
                let value = self.uv_of_copy(plan, from, taken, channel, k);
                self.vertices.uvs[channel].values.push(value);
            }
        }
        self.append_shape(from);
        self.sources.push_copy(from, taken.place, taken.channels);
        self.count() - 1
    }

    /// Whether a vertex equals, in every stream, a copy of another one with what that takes from
    /// another chart.
    pub fn is_copy(&self, plan: &Plan, one: u32, vertex: u32, taken: &Taken) -> bool {
        let (a, b) = (one as usize, vertex as usize);
        let v = &self.vertices;
        let is_uv = |channel: usize| {
            let components = v.uvs[channel].components as usize;
            (0..components).all(|k| {
                let value = self.uv_of_copy(plan, b, taken, channel, k);
                v.uvs[channel].values[a * components + k] == value
            })
        };
        v.positions[a] == v.positions[b]
            && v.normals[a] == v.normals[b]
            && (v.colors.is_empty() || v.colors[a] == v.colors[b])
            && (0..self.uv_end).all(is_uv)
            && (v.tangents.is_empty() || v.tangents[a] == self.tangent_of_copy(plan, b, taken))
    }

    fn tangent_of_copy(&self, plan: &Plan, vertex: usize, taken: &Taken) -> [f32; 4] {
        match taken.channels & 1 {
            0 => self.vertices.tangents[vertex],
            _ => tangent(plan, &taken.place, wide(self.vertices.normals[vertex])),
        }
    }

    fn uv_of_copy(
        &self,
        plan: &Plan,
        vertex: usize,
        taken: &Taken,
        channel: usize,
        component: usize,
    ) -> f32 {
        let uv = &self.vertices.uvs[channel];
        match taken.channels >> channel & 1 {
            0 => uv.values[vertex * uv.components as usize + component],
            _ => blended_uv(plan, &taken.place, channel, component),
        }
    }

    /// Appends a vertex with a normal of its own at a place near a blend, with what it takes from
    /// another chart.
    pub fn append_between(
        &mut self,
        plan: &Plan,
        (position, normal): (DVec3, DVec3),
        near: Blend,
        taken: Option<&Taken>,
    ) -> u32 {
        let vertex = self.count();
        self.append_values(near.vertices[0] as usize);
        self.set_values(plan, vertex as usize, (position, normal), &near);
        let mut source = VertexSource::new(near, near);
        if let Some(Taken { place, channels }) = taken {
            self.set_texture(plan, vertex as usize, place, *channels);
            (source.owner, source.owner_channels) = (*place, u32::from(*channels));
        }
        self.sources.push(source);
        vertex
    }

    /// The streams that a copy has from its vertex, whatever it takes from another chart.
    fn append_shape(&mut self, from: usize) {
        let vertices = &mut self.vertices;
        vertices.positions.push(vertices.positions[from]);
        vertices.normals.push(vertices.normals[from]);
        if !vertices.colors.is_empty() {
            vertices.colors.push(vertices.colors[from]);
        }
    }

    fn append_values(&mut self, from: usize) {
        self.append_shape(from);
        let vertices = &mut self.vertices;
        if !vertices.tangents.is_empty() {
            vertices.tangents.push(vertices.tangents[from]);
        }
        for uv in &mut vertices.uvs[..self.uv_end] {
            let components = uv.components as usize;
            uv.values.extend_from_within(from * components..(from + 1) * components);
        }
    }

    /// Takes back the vertex that was appended last.
    pub fn pop(&mut self) {
        self.truncate(self.count() - 1);
    }

    /// Undoes what was done to a vertex that nothing uses yet: the last one, or one of the source.
    pub fn give_back(&mut self, plan: &Plan, vertex: u32) {
        if vertex as usize >= plan.view.mesh.positions.len() {
            self.pop();
            return;
        }
        let (place, source) = (vertex as usize, &plan.view.mesh);
        self.vertices.positions[place] = source.positions[place];
        self.vertices.normals[place] = source.normals[place];
        if !source.tangents.is_empty() {
            self.vertices.tangents[place] = source.tangents[place];
        }
        if !source.colors.is_empty() {
            self.vertices.colors[place] = source.colors[place];
        }
        for (uv, source) in self.vertices.uvs.iter_mut().zip(&source.uvs) {
            let values = place * uv.components as usize..(place + 1) * uv.components as usize;
            uv.values[values.clone()].copy_from_slice(&source.values[values]);
        }
        self.sources.reset(place);
    }

    /// Takes back all vertices from a number on.
    pub fn truncate(&mut self, count: u32) {
        let count = count as usize;
        let vertices = &mut self.vertices;
        vertices.positions.truncate(count);
        vertices.normals.truncate(count);
        vertices.tangents.truncate(count);
        vertices.colors.truncate(count);
        for uv in &mut vertices.uvs[..self.uv_end] {
            uv.values.truncate(count * uv.components as usize);
        }
        self.sources.truncate(count);
    }

    /// Writes a vertex over an earlier one.
    pub fn relocate(&mut self, vertex: u32, earlier: u32) {
        let (from, to) = (vertex as usize, earlier as usize);
        let vertices = &mut self.vertices;
        vertices.positions[to] = vertices.positions[from];
        vertices.normals[to] = vertices.normals[from];
        if !vertices.tangents.is_empty() {
            vertices.tangents[to] = vertices.tangents[from];
        }
        if !vertices.colors.is_empty() {
            vertices.colors[to] = vertices.colors[from];
        }
        for uv in &mut vertices.uvs[..self.uv_end] {
            let components = uv.components as usize;
            uv.values.copy_within(from * components..(from + 1) * components, to * components);
        }
        self.sources.relocate(from, to);
    }

    /// Whether two output vertices are equal in every stream.
    pub fn are_equal(&self, one: u32, other: u32) -> bool {
        let (a, b) = (one as usize, other as usize);
        let v = &self.vertices;
        v.positions[a] == v.positions[b]
            && v.normals[a] == v.normals[b]
            && (v.tangents.is_empty() || v.tangents[a] == v.tangents[b])
            && (v.colors.is_empty() || v.colors[a] == v.colors[b])
            && v.uvs[..self.uv_end].iter().all(|uv| {
                let components = uv.components as usize;
                (0..components)
                    .all(|k| uv.values[a * components + k] == uv.values[b * components + k])
            })
    }

    /// Sets a vertex to a place on the source surface.
    pub fn resample(
        &mut self,
        plan: &Plan,
        vertex: u32,
        position: DVec3,
        [surface, chart]: [Blend; 2],
    ) {
        let normal = blended_normal(plan, &surface);
        self.set_values(plan, vertex as usize, (position, normal), &chart);
        self.sources.set(vertex as usize, surface, chart);
    }

    fn set_values(
        &mut self,
        plan: &Plan,
        place: usize,
        (position, normal): (DVec3, DVec3),
        chart: &Blend,
    ) {
        self.vertices.positions[place] = position.as_vec3().to_array();
        self.vertices.normals[place] = normal.as_vec3().to_array();
        if !plan.view.mesh.colors.is_empty() {
            self.vertices.colors[place] = self.color(plan, chart);
        }
        self.set_texture(plan, place, chart, Channels::MAX);
    }

    /// Sets UV channels, and the tangent along with the first of them.
    fn set_texture(&mut self, plan: &Plan, place: usize, chart: &Blend, channels: Channels) {
        if !plan.view.mesh.tangents.is_empty() && channels & 1 == 1 {
            let normal = wide(self.vertices.normals[place]);
            self.vertices.tangents[place] = tangent(plan, chart, normal);
        }
        for channel in (0..self.uv_end).filter(|channel| channels & (1 << channel) != 0) {
            self.set_uv(plan, place, chart, channel);
        }
    }

    /// A vertex's value in a UV channel.
    pub fn uv(&self, vertex: u32, channel: usize) -> DVec2 {
        let uv = &self.vertices.uvs[channel];
        let first = vertex as usize * uv.components as usize;
        DVec2::new(f64::from(uv.values[first]), f64::from(uv.values[first + 1]))
    }

    fn set_uv(&mut self, plan: &Plan, place: usize, chart: &Blend, channel: usize) {
        let uv = &mut self.vertices.uvs[channel];
        let components = uv.components as usize;
        for k in 0..components {
            uv.values[place * components + k] = blended_uv(plan, chart, channel, k);
        }
    }

    fn color(&self, plan: &Plan, chart: &Blend) -> [f32; 4] {
        let colors = chart.vertices.map(|vertex| plan.view.mesh.colors[vertex as usize]);
        std::array::from_fn(|k| {
            let [least, greatest] = self.color_range[k];
            blend_value(chart, colors.map(|color| color[k])).clamp(least, greatest)
        })
    }
}

/// A copy with room for some more; an absent stream stays absent.
fn copied<T: Copy>(values: &[T], room: usize) -> Vec<T> {
    let room = if values.is_empty() { 0 } else { room };
    let mut copy = Vec::with_capacity(values.len() + room);
    copy.extend_from_slice(values);
    copy
}

/// One component of a UV channel at a place.
fn blended_uv(plan: &Plan, chart: &Blend, channel: usize, component: usize) -> f32 {
    let uv = &plan.view.mesh.uvs[channel];
    let at = |vertex: u32| uv.values[vertex as usize * uv.components as usize + component];
    blend_value(chart, chart.vertices.map(at))
}

/// Equal values stay equal to the bit, whatever the weights.
fn blend_value(blend: &Blend, values: [f32; 3]) -> f32 {
    if values[0] == values[1] && values[0] == values[2] {
        return values[0];
    }
    let terms = [0, 1, 2].map(|k| f64::from(blend.weights[k]) * f64::from(values[k]));
    (terms[0] + terms[1] + terms[2]) as f32
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
fn tangent(plan: &Plan, chart: &Blend, normal: DVec3) -> [f32; 4] {
    let tangents = plan.view.mesh.tangents;
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
    let mixed = turned(weighted_sum(chart, directions), blended_normal(plan, chart), normal);
    let across = |direction: DVec3| {
        let rest = direction - normal * direction.dot(normal);
        if rest.length() > LEAST_REST * direction.length() { unit(rest) } else { DVec3::ZERO }
    };
    let direction = [mixed, directions[0], normal.any_orthonormal_vector()]
        .into_iter()
        .map(across)
        .find(|direction| *direction != DVec3::ZERO)
        .unwrap_or(DVec3::X);
    let [x, y, z] = direction.as_vec3().to_array();
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

/// What is left of a direction across a normal is rounding if it is shorter than this share of it.
const LEAST_REST: f64 = 1e-3;

/// A stored tangent that is orthogonal up to the rounding of its components needs no repair.
const ORTHOGONAL: f64 = 1e-6;
