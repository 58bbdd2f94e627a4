//! The geometry of an FBX mesh: polygons whose corners name positions, normals and so on each by a
//! number of its own, as vertices of which each is all of these.

use std::collections::HashMap;

use anyhow::{Context, Result, ensure};
use chamfer::UV_CHANNELS;
use serde_json::{Value, json};
use ufbx::{Mesh, SkinDeformer, VertexVec2, VertexVec4};

use crate::parts::Parts;
use crate::polygon::triangulate;

use super::skin;

/// What some meshes have that does not go along.
#[derive(Default)]
pub struct Extras {
    uv_sets: usize,
    color_sets: usize,
    skins: usize,
    in_betweens: usize,
    weights: usize,
    holes: usize,
}

impl Extras {
    /// A sentence each.
    pub fn notes(&self) -> Vec<String> {
        let notes = [
            (self.uv_sets, "UV sets past the eighth of a mesh were left out"),
            (self.color_sets, "colour sets past the first of a mesh were left out"),
            (self.skins, "skins past the first of a mesh were left out"),
            (self.in_betweens, "shapes in between of a blend shape were left out"),
            (self.weights, "vertices with more than eight weights keep the strongest eight"),
            (self.holes, "faces that are holes were left out"),
        ];
        let found = notes.into_iter().filter(|(count, _)| *count > 0);
        found.map(|(count, what)| format!("{count} {what}")).collect()
    }
}

/// What tells vertices apart: the number of the position, and the bits of all else.
type Key = (u32, Vec<u32>);

/// The streams of a mesh by vertex.
#[derive(Default)]
struct Vertices {
    known: HashMap<Key, u32>,
    /// The number of the position in the file.
    source: Vec<u32>,
    positions: Vec<[f32; 3]>,
    normals: Vec<f32>,
    uvs: Vec<Vec<f32>>,
    colors: Vec<f32>,
}

/// A mesh as glTF has it; none where it has no face.
///
/// # Errors
/// Where it has more vertices than 32-bit indices allow.
pub fn write_mesh(mesh: &Mesh, parts: &mut Parts, extras: &mut Extras) -> Result<Option<Value>> {
    let mut vertices =
        Vertices { uvs: vec![Vec::new(); uv_sets(mesh).len()], ..Vertices::default() };
    let mut by_material: Vec<(Option<u32>, Vec<u32>)> = Vec::new();
    for (number, face) in mesh.faces.iter().enumerate() {
        if mesh.face_hole.get(number).copied().unwrap_or(false) {
            extras.holes += 1;
            continue;
        }
        let corners: Vec<usize> =
            (face.index_begin..face.index_begin + face.num_indices).map(|at| at as usize).collect();
        let group = group(&mut by_material, material(mesh, number));
        for triangle in triangulate(&places(mesh, &corners)?) {
            group.extend(triangle.map(|place| vertices.corner(mesh, corners[place])));
        }
    }
    by_material.retain(|(_, indices)| !indices.is_empty());
    if by_material.is_empty() {
        return Ok(None);
    }
    u32::try_from(vertices.positions.len()).context("a mesh does not fit 32-bit indices")?;
    count_extras(mesh, extras);
    let attributes = attributes(mesh, &vertices, parts, extras);
    let (targets, names, weights) = targets(mesh, &vertices, parts);
    let primitive = |(material, indices): &(Option<u32>, Vec<u32>)| {
        let indices = parts.indices(indices);
        let mut primitive = json!({"attributes": attributes, "indices": indices});
        if let Some(material) = material {
            primitive["material"] = (*material).into();
        }
        if !targets.is_empty() {
            primitive["targets"] = targets.clone().into();
        }
        primitive
    };
    let primitives: Vec<Value> = by_material.iter().map(primitive).collect();
    let mut value = json!({"name": name(mesh), "primitives": primitives});
    if !weights.is_empty() {
        value["weights"] = weights.into();
        value["extras"] = json!({"targetNames": names});
    }
    Ok(Some(value))
}

/// Meshes have rarely a name of their own; their nodes do.
fn name(mesh: &Mesh) -> String {
    let own = &mesh.element.name;
    let node = mesh.element.instances.first().map(|node| node.element.name.to_string());
    if own.is_empty() { node.unwrap_or_default() } else { own.to_string() }
}

fn material(mesh: &Mesh, face: usize) -> Option<u32> {
    let number = mesh.face_material.get(face).copied().unwrap_or(0) as usize;
    mesh.materials.get(number).map(|material| material.element.typed_id)
}

/// The triangles of a material, in the order of first use.
fn group(groups: &mut Vec<(Option<u32>, Vec<u32>)>, material: Option<u32>) -> &mut Vec<u32> {
    let known = groups.iter().position(|(other, _)| *other == material);
    let number = known.unwrap_or_else(|| {
        groups.push((material, Vec::new()));
        groups.len() - 1
    });
    &mut groups[number].1
}

fn places(mesh: &Mesh, corners: &[usize]) -> Result<Vec<[f32; 3]>> {
    let place = |&corner: &usize| {
        let place = position(mesh, corner);
        let name = &mesh.element.name;
        ensure!(
            place.iter().all(|number| number.is_finite()),
            "mesh {:?} has a corner at an infinite place or a NaN: repair the model",
            name.to_string()
        );
        Ok(place)
    };
    corners.iter().map(place).collect()
}

fn position(mesh: &Mesh, corner: usize) -> [f32; 3] {
    let at = mesh.vertex_position.values[mesh.vertex_position.indices[corner] as usize];
    [at.x as f32, at.y as f32, at.z as f32]
}

fn uv_sets(mesh: &Mesh) -> Vec<&VertexVec2> {
    let sets = mesh.uv_sets.iter().take(UV_CHANNELS).map(|set| &set.vertex_uv);
    sets.filter(|set| set.exists).collect()
}

/// FBX counts the second coordinate from below, glTF from above.
fn uv(set: &VertexVec2, corner: usize) -> [f32; 2] {
    let uv = set.values[set.indices[corner] as usize];
    [uv.x as f32, (1.0 - uv.y) as f32]
}

fn color(set: &VertexVec4, corner: usize) -> [f32; 4] {
    let color = set.values[set.indices[corner] as usize];
    [color.x, color.y, color.z, color.w].map(|share| share.clamp(0.0, 1.0) as f32)
}

impl Vertices {
    /// The vertex of a corner; a new one where none is known that is alike.
    fn corner(&mut self, mesh: &Mesh, corner: usize) -> u32 {
        let normal = mesh.vertex_normal.exists.then(|| {
            let normal = mesh.vertex_normal.values[mesh.vertex_normal.indices[corner] as usize];
            [normal.x as f32, normal.y as f32, normal.z as f32]
        });
        let uvs: Vec<[f32; 2]> = uv_sets(mesh).into_iter().map(|set| uv(set, corner)).collect();
        let color = mesh.vertex_color.exists.then(|| color(&mesh.vertex_color, corner));
        let values =
            normal.iter().flatten().chain(uvs.as_flattened()).chain(color.iter().flatten());
        let source = mesh.vertex_indices[corner];
        let key = (source, values.map(|value| value.to_bits()).collect());
        let next = self.positions.len() as u32;
        let vertex = *self.known.entry(key).or_insert(next);
        if vertex == next {
            self.source.push(source);
            self.positions.push(position(mesh, corner));
            self.normals.extend(normal.into_iter().flatten());
            self.colors.extend(color.into_iter().flatten());
            self.uvs.iter_mut().zip(uvs).for_each(|(stream, uv)| stream.extend(uv));
        }
        vertex
    }
}

fn count_extras(mesh: &Mesh, extras: &mut Extras) {
    extras.uv_sets += mesh.uv_sets.len().saturating_sub(UV_CHANNELS);
    extras.color_sets += mesh.color_sets.len().saturating_sub(1);
    extras.skins += mesh.skin_deformers.len().saturating_sub(1);
    let channels = mesh.blend_deformers.iter().flat_map(|deformer| deformer.channels.iter());
    let between = channels.map(|channel| channel.keyframes.len().saturating_sub(1));
    extras.in_betweens += between.sum::<usize>();
}

fn attributes(mesh: &Mesh, vertices: &Vertices, parts: &mut Parts, extras: &mut Extras) -> Value {
    let mut attributes = json!({"POSITION": parts.positions(&vertices.positions)});
    if !vertices.normals.is_empty() {
        attributes["NORMAL"] = parts.floats("VEC3", &vertices.normals).into();
    }
    for (number, uv) in vertices.uvs.iter().enumerate() {
        attributes[format!("TEXCOORD_{number}")] = parts.floats("VEC2", uv).into();
    }
    if !vertices.colors.is_empty() {
        attributes["COLOR_0"] = parts.floats("VEC4", &vertices.colors).into();
    }
    let skin: Option<&SkinDeformer> = mesh.skin_deformers.first().map(|skin| &**skin);
    if let Some(skin) = skin.filter(|skin| !skin.clusters.is_empty()) {
        for (set, (joints, weights)) in
            skin::influences(skin, &vertices.source, &mut extras.weights).into_iter().enumerate()
        {
            attributes[format!("JOINTS_{set}")] = parts.joints(&joints).into();
            let weights = parts.floats("VEC4", weights.as_flattened());
            attributes[format!("WEIGHTS_{set}")] = weights.into();
        }
    }
    attributes
}

/// Blend shapes as morph targets: these, their names, and how much each counts.
fn targets(
    mesh: &Mesh,
    vertices: &Vertices,
    parts: &mut Parts,
) -> (Vec<Value>, Vec<String>, Vec<f32>) {
    let (mut targets, mut names, mut weights) = (Vec::new(), Vec::new(), Vec::new());
    let channels = mesh.blend_deformers.iter().flat_map(|deformer| deformer.channels.iter());
    for channel in channels {
        let Some(shape) = &channel.target_shape else { continue };
        let mut offset_of: HashMap<u32, usize> = HashMap::new();
        offset_of
            .extend(shape.offset_vertices.iter().enumerate().map(|(at, vertex)| (*vertex, at)));
        let stream = |offsets: &[ufbx::Vec3]| -> Vec<[f32; 3]> {
            let offset = |source: &u32| {
                let offset = offset_of.get(source).and_then(|at| offsets.get(*at));
                offset.map_or([0.0; 3], |o| [o.x as f32, o.y as f32, o.z as f32])
            };
            vertices.source.iter().map(offset).collect()
        };
        let mut target = json!({"POSITION": parts.positions(&stream(&shape.position_offsets))});
        if !shape.normal_offsets.is_empty() && !vertices.normals.is_empty() {
            let normals = stream(&shape.normal_offsets);
            target["NORMAL"] = parts.floats("VEC3", normals.as_flattened()).into();
        }
        targets.push(target);
        names.push(channel.element.name.to_string());
        weights.push(channel.weight as f32);
    }
    (targets, names, weights)
}
