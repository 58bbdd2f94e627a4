//! The triangle primitives of a glTF mesh as one mesh of the core.
//!
//! Primitives with the same attribute accessors share their vertices: they form a *block*. The
//! vertices of the blocks stand one block after the other; copies that smoothing makes follow.

use std::cell::Cell;
use std::collections::hash_map::Entry;
use std::collections::{HashMap, HashSet};
use std::sync::Arc;

use anyhow::{Context, Result, bail, ensure};
use glam::Mat4;
use serde_json::Value;

use super::accessor::Accessors;
use super::budget::Budget;
use super::element::{ElementType, Shape, Stream};
use super::json;
use super::names::is_carried_by_core;
use super::triangles::Mode;
use crate::document::Weld;
use crate::weld;

/// How a core mesh lies in the primitives of a glTF mesh.
#[derive(Clone, Default)]
pub struct MeshGeometry {
    /// Sets of primitives that share their vertices.
    pub blocks: Vec<Block>,
    /// `#submeshes`: the primitive of each.
    pub submeshes: Vec<Submesh>,
    /// `#vertices` of the source mesh: where each came from.
    pub origins: Vec<Origin>,
    /// `#triangles by 3` of the source mesh before smoothing, flattened.
    indices: Vec<u32>,
}

/// Primitives with the same attributes and morph targets.
#[derive(Clone)]
pub struct Block {
    /// In the order of the file.
    pub attributes: Vec<Attribute>,
    /// For each morph target its attributes.
    pub targets: Vec<Vec<Attribute>>,
    /// Whether the normals are not from the file, which has none or none with a direction.
    pub smoothed: bool,
}

/// A named accessor of a primitive.
#[derive(Clone)]
pub struct Attribute {
    pub name: String,
    pub accessor: usize,
    pub sparse: bool,
    pub stream: Arc<Stream>,
}

/// A primitive that is a submesh of the core mesh.
#[derive(Clone)]
pub struct Submesh {
    /// Its number in the mesh.
    pub primitive: usize,
    /// Its vertices.
    pub block: usize,
    /// The accessor of its indices, if it had one.
    pub indices: Option<usize>,
    index_count: usize,
}

/// Where a source vertex came from.
#[derive(Clone, Copy)]
pub struct Origin {
    pub block: u32,
    /// Element of the block's accessors.
    pub element: u32,
}

impl Block {
    /// The attribute of that name.
    pub fn attribute(&self, name: &str) -> Option<&Attribute> {
        self.find(None, name)
    }

    /// How many whole sets of influences of joints it has.
    pub fn skin_sets(&self) -> usize {
        let has = |kind: &str, set: usize| self.attribute(&format!("{kind}_{set}")).is_some();
        (0..).take_while(|set| has("JOINTS", *set) && has("WEIGHTS", *set)).count()
    }

    fn find(&self, target: Option<usize>, name: &str) -> Option<&Attribute> {
        let attributes = match target {
            Some(target) => self.targets.get(target)?,
            None => &self.attributes,
        };
        attributes.iter().find(|attribute| attribute.name == name)
    }

    fn vertex_count(&self) -> usize {
        self.attribute("POSITION").map_or(0, |positions| positions.stream.count())
    }
}

impl MeshGeometry {
    /// `#triangles by 3` of the source mesh before smoothing, flattened.
    pub fn indices(&self) -> &[u32] {
        &self.indices
    }

    /// `#submeshes`: how many of the indices belong to each.
    pub fn submesh_index_counts(&self) -> Vec<u32> {
        self.submeshes.iter().map(|submesh| submesh.index_count as u32).collect()
    }

    /// Forgets the normals of the file: others will be made.
    pub fn drop_normals(&mut self) {
        self.blocks.iter_mut().for_each(|block| block.smoothed = true);
    }

    /// Moves vertices onto those that they are to be one with; how many.
    pub fn weld(&mut self, weld: Weld) -> usize {
        if weld == Weld::Equal {
            return 0;
        }
        let stored = self.streams(None, "POSITION");
        let place = |vertex: usize| {
            stored.at(vertex).map_or([0.0; 3], |at| [at[0], at[1], at[2]].map(|at| at as f32))
        };
        let mut positions: Vec<[f32; 3]> = (0..self.origins.len()).map(place).collect();
        let moved = weld::weld(&mut positions, weld);
        for (origin, position) in self.origins.iter().zip(&positions) {
            let attributes = &mut self.blocks[origin.block as usize].attributes;
            let Some(attribute) = attributes.iter_mut().find(|a| a.name == "POSITION") else {
                continue;
            };
            let place = 3 * origin.element as usize..3 * origin.element as usize + 3;
            let old = &attribute.stream.values[place.clone()];
            // Others keep the digits that the file has.
            if old.iter().zip(position).any(|(old, new)| *old as f32 != *new) {
                let values = &mut Arc::make_mut(&mut attribute.stream).values;
                values[place].copy_from_slice(&position.map(f64::from));
            }
        }
        moved
    }

    /// Lets go of the values that the core mesh holds now.
    pub fn forget_core_streams(&mut self) {
        let attributes = self.blocks.iter_mut().flat_map(|block| &mut block.attributes);
        for attribute in attributes.filter(|attribute| is_carried_by_core(&attribute.name)) {
            let element = attribute.stream.element;
            attribute.stream = Arc::new(Stream { element, values: Vec::new() });
        }
    }

    /// The streams of that name of all blocks, of a morph target or of the mesh itself.
    pub fn streams(&self, target: Option<usize>, name: &str) -> SourceStreams<'_> {
        SourceStreams { geometry: self, target, name: name.to_owned(), last: Cell::new(None) }
    }

    /// `#blocks`: the submeshes of each.
    fn submeshes_of_blocks(&self) -> Vec<Vec<usize>> {
        let mut submeshes = vec![Vec::new(); self.blocks.len()];
        for (number, submesh) in self.submeshes.iter().enumerate() {
            submeshes[submesh.block].push(number);
        }
        submeshes
    }
}

/// An attribute by source vertex. Blocks are looked up as they are asked for: a file can have as
/// many as it has primitives, and each asks for few.
pub struct SourceStreams<'a> {
    geometry: &'a MeshGeometry,
    target: Option<usize>,
    name: String,
    /// The block asked for last, and its stream: the next vertex is mostly of the same.
    last: Cell<Option<(u32, Option<&'a Stream>)>>,
}

impl<'a> SourceStreams<'a> {
    /// The value at a source vertex, if the vertex has one.
    pub fn at(&self, vertex: usize) -> Option<&'a [f64]> {
        let Origin { block, element } = self.geometry.origins[vertex];
        let stream = match self.last.get() {
            Some((last, stream)) if last == block => stream,
            _ => {
                let stream = self.of_block(&self.geometry.blocks[block as usize]);
                self.last.set(Some((block, stream)));
                stream
            }
        };
        stream.map(|stream| stream.at(element as usize))
    }

    /// Whether any vertex has a value.
    pub fn exist(&self) -> bool {
        self.geometry.blocks.iter().any(|block| self.of_block(block).is_some())
    }

    fn of_block(&self, block: &'a Block) -> Option<&'a Stream> {
        block.find(self.target, &self.name).map(|attribute| &*attribute.stream)
    }
}

/// Reads the meshes of a file.
pub struct GeometryReader<'a> {
    json: &'a Value,
    accessors: Accessors<'a>,
    /// Position accessors of more than one mesh: each mesh takes only the elements it uses, or
    /// a vertex buffer that a whole scene shares would be copied into every mesh.
    shared: HashSet<usize>,
    budget: &'a Budget,
}

/// A primitive as the file states it.
#[derive(Debug)]
struct PrimitivePlan {
    primitive: usize,
    path: String,
    mode: Mode,
    indices: Option<usize>,
    positions: usize,
    attributes: Vec<(String, usize)>,
    targets: Vec<Vec<(String, usize)>>,
}

/// The attributes, then those of each morph target, sorted and with a `None` behind each set.
type SharingKey = Vec<Option<(String, usize)>>;

impl<'a> GeometryReader<'a> {
    pub fn new(json: &'a Value, buffers: &'a [Vec<u8>], budget: &'a Budget) -> GeometryReader<'a> {
        let accessors = Accessors::new(json, buffers, budget);
        GeometryReader { json, accessors, shared: shared_positions(json), budget }
    }

    /// The first matrix of an accessor, if it has one that can be read.
    pub fn first_matrix(&self, accessor: usize) -> Option<Mat4> {
        let stream = self.accessors.read(accessor).ok()?;
        let numbers: [f64; 16] = stream.values.get(..16)?.try_into().ok()?;
        (stream.element.shape == Shape::MAT4)
            .then(|| Mat4::from_cols_array(&numbers.map(|number| number as f32)))
    }

    /// What was read otherwise than it stands in the file.
    pub fn notes(&self) -> Vec<String> {
        self.accessors.notes()
    }

    /// Reads the triangles of one mesh.
    pub fn read(&self, mesh: usize) -> Result<MeshGeometry> {
        let mut geometry = MeshGeometry::default();
        let mut block_of: HashMap<SharingKey, usize> = HashMap::new();
        let mut corners: Vec<Vec<u32>> = Vec::new();
        for plan in plans(json::item(self.json, "meshes", mesh)?, mesh)? {
            let triangles = self.triangles(&plan)?;
            // A primitive without a triangle has nothing to chamfer and stays as it is.
            if triangles.is_empty() {
                continue;
            }
            let block = match block_of.entry(sharing_key(&plan)) {
                Entry::Occupied(known) => *known.get(),
                Entry::Vacant(unknown) => {
                    geometry.blocks.push(self.block(&plan)?);
                    *unknown.insert(geometry.blocks.len() - 1)
                }
            };
            let PrimitivePlan { primitive, indices, .. } = plan;
            let index_count = triangles.len();
            geometry.submeshes.push(Submesh { primitive, block, indices, index_count });
            corners.push(triangles);
        }
        let submeshes = geometry.submeshes_of_blocks();
        for (block, submeshes) in geometry.blocks.iter_mut().zip(submeshes) {
            let mut elements = submeshes.iter().flat_map(|submesh| &corners[*submesh]);
            let stored = block.attribute("NORMAL").map(|normals| normals.stream.clone());
            let is_zero =
                |normals: &Stream, element: &u32| has_no_direction(normals.at(*element as usize));
            block.smoothed |= stored.is_some_and(|n| elements.all(|element| is_zero(&n, element)));
        }
        self.place_vertices(&mut geometry, corners)?;
        Ok(geometry)
    }

    fn block(&self, plan: &PrimitivePlan) -> Result<Block> {
        let count = self.accessors.count(plan.positions)?;
        let attributes = self.attributes(&plan.attributes, count, &plan.path)?;
        let targets = plan
            .targets
            .iter()
            .map(|target| self.attributes(target, count, &plan.path))
            .collect::<Result<_>>()?;
        let smoothed = !attributes.iter().any(|attribute| attribute.name == "NORMAL");
        Ok(Block { attributes, targets, smoothed })
    }

    fn attributes(
        &self,
        named: &[(String, usize)],
        count: usize,
        path: &str,
    ) -> Result<Vec<Attribute>> {
        let attribute = |(name, accessor): &(String, usize)| {
            let found = self.accessors.count(*accessor)?;
            ensure!(
                found == count,
                "{path} has {found} elements of {name}, but {count} of POSITION: \
                 all attributes must have as many"
            );
            let stream = self.accessors.read(*accessor)?;
            check_shape(name, stream.element, path)?;
            let sparse = self.accessors.is_sparse(*accessor);
            Ok(Attribute { name: name.clone(), accessor: *accessor, sparse, stream })
        };
        named.iter().map(attribute).collect()
    }

    /// The triangles of a primitive, as elements of its accessors.
    fn triangles(&self, plan: &PrimitivePlan) -> Result<Vec<u32>> {
        let vertices = u32::try_from(self.accessors.read(plan.positions)?.count())?;
        let count = match plan.indices {
            Some(indices) => self.accessors.count(indices)?,
            None => vertices as usize,
        };
        self.budget.spend(count)?;
        let (indices, restart) = match plan.indices {
            Some(indices) => self.accessors.read_indices(indices)?,
            None => ((0..vertices).collect(), u32::MAX),
        };
        let is_wrong = |index: &u32| *index >= vertices && *index != restart;
        if let Some(place) = indices.iter().position(is_wrong) {
            let index = indices[place];
            bail!("index {place} of {} is {index}, but it has {vertices} vertices", plan.path);
        }
        // A vertex of that number is none that restarts.
        let triangles = plan.mode.to_list(indices, restart.max(vertices));
        self.check_positions(plan, &triangles)?;
        Ok(triangles)
    }

    /// Geometry needs its places, all else can do without a value here and there.
    fn check_positions(&self, plan: &PrimitivePlan, triangles: &[u32]) -> Result<()> {
        let bad = self.accessors.not_finite(plan.positions);
        let is_bad = |element: &&u32| bad.binary_search(&(**element as usize)).is_ok();
        if let Some(element) = triangles.iter().find(is_bad) {
            bail!(
                "{} stands at an infinite place or a NaN with its vertex {element}: repair the \
                 model",
                plan.path
            );
        }
        Ok(())
    }

    /// Gives each block's elements their places among the vertices of the core mesh.
    fn place_vertices(&self, geometry: &mut MeshGeometry, corners: Vec<Vec<u32>>) -> Result<()> {
        let mut places = Vec::new();
        let submeshes = geometry.submeshes_of_blocks();
        for (number, block) in geometry.blocks.iter().enumerate() {
            let used = submeshes[number].iter().map(|submesh| &corners[*submesh]);
            let placed = Places { first: geometry.origins.len(), used: self.used(block, used) };
            let count = placed.used.as_ref().map_or(block.vertex_count(), Vec::len);
            self.budget.spend(count)?;
            let block = number as u32;
            let element = |place: usize| placed.used.as_ref().map_or(place as u32, |u| u[place]);
            geometry.origins.extend((0..count).map(|p| Origin { block, element: element(p) }));
            places.push(placed);
        }
        u32::try_from(geometry.origins.len()).context("a mesh does not fit 32-bit indices")?;
        for (submesh, corners) in geometry.submeshes.iter().zip(corners) {
            let places = &places[submesh.block];
            geometry.indices.extend(corners.into_iter().map(|element| places.of(element)));
        }
        Ok(())
    }

    /// The elements of a block that its triangles use, if only those are to be taken.
    fn used<'b>(
        &self,
        block: &Block,
        corners: impl Iterator<Item = &'b Vec<u32>>,
    ) -> Option<Vec<u32>> {
        let position = block.attribute("POSITION").map(|attribute| attribute.accessor);
        if !position.is_some_and(|accessor| self.shared.contains(&accessor)) {
            return None;
        }
        let mut elements: Vec<u32> = corners.flatten().copied().collect();
        elements.sort_unstable();
        elements.dedup();
        Some(elements)
    }
}

/// Where the elements of a block stand among the vertices of the core mesh.
struct Places {
    first: usize,
    /// The elements taken, in order; all where absent.
    used: Option<Vec<u32>>,
}

impl Places {
    fn of(&self, element: u32) -> u32 {
        let place = match &self.used {
            Some(used) => used.partition_point(|other| *other < element),
            None => element as usize,
        };
        (self.first + place) as u32
    }
}

fn plans(mesh: &Value, index: usize) -> Result<Vec<PrimitivePlan>> {
    let mut plans = Vec::new();
    for (primitive, value) in json::list(mesh, "primitives").iter().enumerate() {
        let path = format!("meshes[{index}].primitives[{primitive}]");
        plans.extend(plan(value, primitive, path)?);
    }
    Ok(plans)
}

/// `None` for what has no triangles, and for what an extension alone gives positions to.
fn plan(value: &Value, primitive: usize, path: String) -> Result<Option<PrimitivePlan>> {
    let mode = Mode::of_code(json::optional(value, "mode", &path)?.unwrap_or(4));
    let Some(mode) = mode else { return Ok(None) };
    let Some(attributes) = value.get("attributes") else { return Ok(None) };
    let attributes = json::named_indices(attributes, &format!("{path}.attributes"))?;
    let positions = attributes.iter().find(|(name, _)| name == "POSITION");
    let Some(positions) = positions.map(|(_, accessor)| *accessor) else { return Ok(None) };
    let targets = json::list(value, "targets")
        .iter()
        .map(|target| json::named_indices(target, &format!("{path}.targets")))
        .collect::<Result<_>>()?;
    let indices = json::optional(value, "indices", &path)?;
    Ok(Some(PrimitivePlan { primitive, path, mode, indices, positions, attributes, targets }))
}

/// Whether a normal is none.
pub fn has_no_direction(normal: &[f64]) -> bool {
    normal.iter().all(|number| *number == 0.0)
}

/// Equal for primitives that can share their vertices, however their attributes are ordered.
fn sharing_key(plan: &PrimitivePlan) -> SharingKey {
    let mut key = Vec::new();
    for set in std::iter::once(&plan.attributes).chain(&plan.targets) {
        let mut set = set.clone();
        set.sort_unstable();
        key.extend(set.into_iter().map(Some));
        key.push(None);
    }
    key
}

fn check_shape(name: &str, element: ElementType, path: &str) -> Result<()> {
    let allowed: &[Shape] = match name {
        "POSITION" | "NORMAL" => &[Shape::VEC3],
        // A morph target's tangents have no handedness.
        "TANGENT" => &[Shape::VEC3, Shape::VEC4],
        _ if name.starts_with("TEXCOORD_") => &[Shape::VEC2],
        _ if name.starts_with("COLOR_") => &[Shape::VEC3, Shape::VEC4],
        _ if name.starts_with("JOINTS_") | name.starts_with("WEIGHTS_") => &[Shape::VEC4],
        _ => return Ok(()),
    };
    ensure!(
        allowed.contains(&element.shape),
        "{name} of {path} is of type {}, which glTF does not allow there",
        element.shape.name()
    );
    Ok(())
}

/// The position accessors that more than one mesh uses.
fn shared_positions(json: &Value) -> HashSet<usize> {
    let mut first_user: HashMap<usize, usize> = HashMap::new();
    let mut shared = HashSet::new();
    for (mesh, value) in json::list(json, "meshes").iter().enumerate() {
        for primitive in json::list(value, "primitives") {
            let position = primitive.get("attributes").and_then(|a| a.get("POSITION"));
            let Some(accessor) = position.and_then(json::integer) else { continue };
            if *first_user.entry(accessor).or_insert(mesh) != mesh {
                shared.insert(accessor);
            }
        }
    }
    shared
}
