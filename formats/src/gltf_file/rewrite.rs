//! Gives the primitives of a chamfered mesh their new accessors.

use anyhow::{Context, Result, ensure};
use chamfer::{Chamfered, MeshBuffers, TriangleSource};
use serde_json::{Map, Value};

use super::accessor_writer::{AccessorWriter, Role, Usage};
use super::element::{ElementType, Shape, Stream};
use super::follow::Follower;
use super::geometry::{Attribute, Block, MeshGeometry, Submesh};
use super::labels::{Chosen, Labels};
use super::names::{is_carried_by_core, uv_channel};
use super::skin;

/// Accessor numbers by attribute name.
type Accessors = Vec<(String, usize)>;

/// The place of a vertex that is not in a block.
const ABSENT: u32 = u32::MAX;

/// A submesh of the chamfered mesh.
struct Part<'a> {
    /// The source submesh that it is, or whose primitive it is a further one like.
    submesh: &'a Submesh,
    is_further: bool,
    /// `#triangles by 3`, flattened.
    corners: &'a [u32],
    /// `#triangles`
    triangles: &'a [TriangleSource],
}

/// One chamfered mesh on its way into the file.
pub struct Rewrite<'a> {
    geometry: &'a MeshGeometry,
    chamfered: &'a Chamfered,
    follower: Follower<'a>,
    parts: Vec<Part<'a>>,
    /// `#blocks`: the parts of each.
    parts_of: Vec<Vec<usize>>,
    /// `#blocks`: the source vertices of each.
    own_vertices: Vec<Vec<u32>>,
}

impl<'a> Rewrite<'a> {
    /// Pairs a mesh with its chamfered form.
    ///
    /// # Errors
    /// Where the one is not made of the other.
    pub fn new(geometry: &'a MeshGeometry, chamfered: &'a Chamfered) -> Result<Rewrite<'a>> {
        let MeshBuffers { positions, normals, indices, submesh_index_counts, .. } = &chamfered.mesh;
        let total: usize = submesh_index_counts.iter().map(|count| *count as usize).sum();
        let fits = normals.len() == positions.len()
            && chamfered.vertex_sources.len() == positions.len()
            && positions.len() >= geometry.origins.len()
            && submesh_index_counts.len() >= geometry.submeshes.len()
            && total == indices.len()
            && chamfered.triangle_sources.len() * 3 == total
            && submesh_index_counts.iter().all(|count| count.is_multiple_of(3))
            && indices.iter().all(|index| (*index as usize) < positions.len());
        ensure!(fits, "the chamfered mesh does not match the primitives of the file");
        let parts = parts(geometry, chamfered)?;
        let mut parts_of = vec![Vec::new(); geometry.blocks.len()];
        for (number, part) in parts.iter().enumerate() {
            parts_of[part.submesh.block].push(number);
        }
        let mut own_vertices = vec![Vec::new(); geometry.blocks.len()];
        for (vertex, origin) in geometry.origins.iter().enumerate() {
            own_vertices[origin.block as usize].push(vertex as u32);
        }
        let follower = Follower::new(geometry, &chamfered.vertex_sources);
        Ok(Rewrite { geometry, chamfered, follower, parts, parts_of, own_vertices })
    }

    /// Replaces what the JSON of the mesh says of its triangles.
    ///
    /// # Errors
    /// Where a primitive would be left empty.
    pub fn write(&self, mesh: &mut Value, writer: &mut AccessorWriter) -> Result<()> {
        let mut place_of = vec![ABSENT; self.chamfered.mesh.positions.len()];
        for (number, block) in self.geometry.blocks.iter().enumerate() {
            let mut vertices = self.block_vertices(number, &mut place_of);
            let place = |index: &u32| place_of[*index as usize];
            let places = self.parts_of(number).map(|part| part.corners.iter().map(place).collect());
            let mut places: Vec<Vec<u32>> = places.collect();
            // Only what was set, or many blocks would take quadratic time.
            vertices.iter().for_each(|vertex| place_of[*vertex as usize] = ABSENT);
            let labels = self.labels(number, &mut vertices, &mut places);
            let attributes = self.attributes(block, &vertices, labels.as_ref(), writer)?;
            let targets = self.targets(block, &vertices, writer)?;
            for (part, places) in self.parts_of(number).zip(&places) {
                let indices = writer.write_indices(part.role(block), places)?;
                let primitive = part.primitive(mesh).context("a primitive is gone")?;
                replace(primitive, &attributes, &targets, indices);
            }
        }
        Ok(())
    }

    /// The labels of a block's vertices, of which some are added for them.
    fn labels(
        &self,
        number: usize,
        vertices: &mut Vec<u32>,
        places: &mut [Vec<u32>],
    ) -> Option<Labels<'_>> {
        let mut labels = Labels::new(&self.follower, &self.geometry.blocks[number], vertices)?;
        let mut chosen = Chosen::default();
        for (part, places) in self.parts_of(number).zip(places) {
            labels.keep_apart(part.triangles, places, &mut chosen, vertices);
        }
        Some(labels)
    }

    fn parts_of(&self, block: usize) -> impl Iterator<Item = &Part<'a>> {
        self.parts_of[block].iter().map(|part| &self.parts[*part])
    }

    /// The source vertices of a block in their order, then all others that its triangles use; each
    /// is told its place.
    fn block_vertices(&self, block: usize, place_of: &mut [u32]) -> Vec<u32> {
        let mut vertices = self.own_vertices[block].clone();
        let set = |place_of: &mut [u32], from: usize, vertices: &[u32]| {
            for (place, vertex) in vertices.iter().enumerate() {
                place_of[*vertex as usize] = (from + place) as u32;
            }
        };
        set(place_of, 0, &vertices);
        let corners = self.parts_of(block).flat_map(|part| part.corners.iter().copied());
        let absent = corners.filter(|vertex| place_of[*vertex as usize] == ABSENT);
        let mut further: Vec<u32> = absent.collect();
        further.sort_unstable();
        further.dedup();
        set(place_of, vertices.len(), &further);
        vertices.extend(further);
        vertices
    }

    fn attributes(
        &self,
        block: &Block,
        vertices: &[u32],
        labels: Option<&Labels>,
        writer: &mut AccessorWriter,
    ) -> Result<Accessors> {
        let mut accessors = self.skin(block, vertices, writer)?;
        for attribute in &block.attributes {
            let dropped = block.smoothed && attribute.name == "TANGENT";
            if dropped || accessors.iter().any(|(name, _)| *name == attribute.name) {
                continue;
            }
            let label = labels.and_then(|labels| labels.stream(&attribute.name));
            let stream = match (label, is_carried_by_core(&attribute.name)) {
                (Some(label), _) => label,
                (None, true) => {
                    self.core_stream(&attribute.name, attribute.stream.element, vertices)?
                }
                (None, false) => self.follow(None, attribute, vertices),
            };
            let accessor =
                writer.write(Role::Successor(attribute.accessor), usage(attribute), &stream)?;
            accessors.push((attribute.name.clone(), accessor));
        }
        if block.smoothed && block.attribute("NORMAL").is_none() {
            let stream = self.core_stream("NORMAL", ElementType::floats(Shape::VEC3), vertices)?;
            let role = Role::NormalsOf(position(block));
            accessors.push(("NORMAL".to_owned(), writer.write(role, Usage::Vertices, &stream)?));
        }
        Ok(accessors)
    }

    fn skin(
        &self,
        block: &Block,
        vertices: &[u32],
        writer: &mut AccessorWriter,
    ) -> Result<Accessors> {
        let skin = skin::blend(&self.follower, block, vertices);
        let mut accessors = Vec::new();
        for (kind, streams) in [("JOINTS", &skin.joints), ("WEIGHTS", &skin.weights)] {
            for (set, stream) in streams.iter().enumerate() {
                let name = format!("{kind}_{set}");
                let Some(attribute) = block.attribute(&name) else { continue };
                let role = Role::Successor(attribute.accessor);
                accessors.push((name, writer.write(role, Usage::Vertices, stream)?));
            }
        }
        Ok(accessors)
    }

    fn targets(
        &self,
        block: &Block,
        vertices: &[u32],
        writer: &mut AccessorWriter,
    ) -> Result<Vec<Accessors>> {
        let mut targets = Vec::new();
        for (number, target) in block.targets.iter().enumerate() {
            let mut accessors = Vec::new();
            for attribute in target {
                let stream = self.follow(Some(number), attribute, vertices);
                let role = Role::Successor(attribute.accessor);
                let accessor = match attribute.sparse {
                    true => writer.write_sparse(role, usage(attribute), &stream)?,
                    false => writer.write(role, usage(attribute), &stream)?,
                };
                accessors.push((attribute.name.clone(), accessor));
            }
            targets.push(accessors);
        }
        Ok(targets)
    }

    fn follow(&self, target: Option<usize>, attribute: &Attribute, vertices: &[u32]) -> Stream {
        self.follower.follow(target, &attribute.name, attribute.stream.element, vertices)
    }

    /// A stream that the core chamfered. Colours are rounded to their old type; what is geometry
    /// turns into floats where the old type would move it.
    fn core_stream(&self, name: &str, element: ElementType, vertices: &[u32]) -> Result<Stream> {
        let mesh = &self.chamfered.mesh;
        let stream = |flat: &[f32], width: usize| {
            let rows = vertices.iter().map(|vertex| flat.get(*vertex as usize * width..));
            let numbers = rows
                .flat_map(|row| row.unwrap_or_default().iter().take(element.shape.components()));
            Stream { element, values: numbers.map(|number| f64::from(*number)).collect() }
        };
        let stream = match name {
            "POSITION" => stream(mesh.positions.as_flattened(), 3).exact_or_floats(),
            "NORMAL" => stream(mesh.normals.as_flattened(), 3).exact_or_floats(),
            "TANGENT" => stream(mesh.tangents.as_flattened(), 4).exact_or_floats(),
            "COLOR_0" => stream(mesh.colors.as_flattened(), 4),
            _ => {
                let uv = &mesh.uvs[uv_channel(name).context("no stream of the core")?];
                stream(&uv.values, 2).exact_or_floats()
            }
        };
        ensure!(stream.count() == vertices.len(), "the chamfered mesh has lost its {name}");
        Ok(stream)
    }
}

/// The submeshes of a chamfered mesh.
fn parts<'a>(geometry: &'a MeshGeometry, chamfered: &'a Chamfered) -> Result<Vec<Part<'a>>> {
    let mut rest = (&chamfered.mesh.indices[..], &chamfered.triangle_sources[..]);
    let mut parts = Vec::new();
    for (number, count) in chamfered.mesh.submesh_index_counts.iter().enumerate() {
        let (corners, corners_after) = rest.0.split_at(*count as usize);
        let (triangles, triangles_after) = rest.1.split_at(*count as usize / 3);
        rest = (corners_after, triangles_after);
        let is_further = number >= geometry.submeshes.len();
        let submesh = geometry.submeshes.get(number).or(geometry.submeshes.last());
        let submesh = submesh.context("the mesh had no triangles, but now it has")?;
        // A primitive without triangles is more than glTF can say, and nothing to see.
        if !(is_further && corners.is_empty()) {
            parts.push(Part { submesh, is_further, corners, triangles });
        }
    }
    Ok(parts)
}

impl Part<'_> {
    fn role(&self, block: &Block) -> Role {
        let indices = self.submesh.indices.filter(|_| !self.is_further);
        indices.map_or(Role::IndicesOf(position(block)), Role::Successor)
    }

    /// The primitive's JSON; a further one is added as a copy of the one that it is like.
    fn primitive<'m>(&self, mesh: &'m mut Value) -> Option<&'m mut Map<String, Value>> {
        let primitives = mesh.get_mut("primitives")?.as_array_mut()?;
        let mut index = self.submesh.primitive;
        if self.is_further {
            primitives.push(primitives.get(index)?.clone());
            index = primitives.len() - 1;
        }
        primitives.get_mut(index)?.as_object_mut()
    }
}

fn usage(attribute: &Attribute) -> Usage {
    if attribute.name == "POSITION" { Usage::Positions } else { Usage::Vertices }
}

/// Every block has positions: primitives without are no submeshes.
fn position(block: &Block) -> usize {
    block.attribute("POSITION").map_or(0, |attribute| attribute.accessor)
}

/// Sets only what changes; the material, extensions and all else of the primitive stay.
fn replace(
    primitive: &mut Map<String, Value>,
    attributes: &Accessors,
    targets: &[Accessors],
    indices: usize,
) {
    if let Some(old) = primitive.get_mut("attributes").and_then(Value::as_object_mut) {
        old.retain(|name, _| attributes.iter().any(|(known, _)| known == name));
        old.extend(attributes.iter().map(|(name, accessor)| (name.clone(), (*accessor).into())));
    }
    let old_targets = primitive.get_mut("targets").and_then(Value::as_array_mut);
    for (old, target) in old_targets.into_iter().flatten().zip(targets) {
        if let Some(old) = old.as_object_mut() {
            old.extend(target.iter().map(|(name, accessor)| (name.clone(), (*accessor).into())));
        }
    }
    primitive.insert("indices".to_owned(), indices.into());
    if let Some(mode) = primitive.get_mut("mode") {
        *mode = 4.into();
    }
}
