//! Files whose geometry is compressed, as the same files without compression: what comes after
//! reads, chamfers and writes them as any other.

use std::collections::{BTreeSet, HashMap, HashSet};

use anyhow::{Context, Result};
use serde_json::{Value, json};

use super::accessor_writer::{Usage, description, merge};
use super::draco_mesh::{self, DracoMesh};
use super::element::{Component, ElementType, Shape, Stream};
use super::extensions::{Mentions, drop_names};
use super::fold::fold;
use super::json;
use super::meshopt_views;
use super::unpacked::Unpacked;

/// What any file may unpack to, in bytes, and for each of its own bytes if that is more.
const FREE_BYTES: usize = 1 << 26;
const BYTES_PER_BYTE: usize = 256;

/// A file without compression.
pub struct Plain {
    pub json: Value,
    /// `#buffers`.
    pub buffers: Vec<Vec<u8>>,
    /// The extensions that it is without now; none if it is as it was.
    pub dropped: Vec<&'static str>,
}

/// Unpacks what is compressed.
///
/// # Errors
/// Where that cannot be unpacked: the buffer view or primitive is named.
pub fn plain(json: Value, buffers: Vec<Vec<u8>>) -> Result<Plain> {
    let dropped = used(&json);
    if dropped.is_empty() {
        return Ok(Plain { json, buffers, dropped });
    }
    let most = buffers.iter().map(Vec::len).sum::<usize>().saturating_mul(BYTES_PER_BYTE);
    let mut file = Unpacked::new(json, buffers, FREE_BYTES.max(most));
    unpack_views(&mut file)?;
    Primitives {
        file: &mut file,
        meshes: HashMap::new(),
        filled: HashMap::new(),
        taken: HashSet::new(),
    }
    .unpack()?;
    strip(&mut file.json, &dropped);
    strip_all(&mut file.new.views, &dropped);
    drop_names(&mut file.json, &dropped);
    let may_drop_bytes = !Mentions::of(&file.json).buffers;
    if may_drop_bytes {
        file.empty_unused_buffers();
    }
    let Unpacked { mut json, buffers, new, .. } = file;
    let bytes = fold(&mut json, &buffers, new, may_drop_bytes)?;
    Ok(Plain { json, buffers: if bytes.is_empty() { Vec::new() } else { vec![bytes] }, dropped })
}

/// The names of the compressions that a file uses.
fn used(json: &Value) -> Vec<&'static str> {
    let has = |owner: &Value, name| owner.get("extensions").is_some_and(|e| e.get(name).is_some());
    let primitives = json::list(json, "meshes").iter().flat_map(|m| json::list(m, "primitives"));
    let views = json::list(json, "bufferViews").iter().chain(json::list(json, "buffers"));
    let carriers: Vec<&Value> = primitives.chain(views).collect();
    let listed: BTreeSet<&str> = ["extensionsUsed", "extensionsRequired"]
        .iter()
        .flat_map(|key| json::list(json, key))
        .filter_map(Value::as_str)
        .collect();
    let names = meshopt_views::NAMES.into_iter().chain([draco_mesh::NAME]);
    names
        .filter(|name| listed.contains(name) || carriers.iter().any(|owner| has(owner, *name)))
        .collect()
}

/// Unpacks the compressed views; one whose fallback is there is read from that.
fn unpack_views(file: &mut Unpacked) -> Result<()> {
    for index in 0..file.new.views.len() {
        let view = file.new.views[index].clone();
        let path = format!("bufferViews[{index}]");
        let Some(extension) = meshopt_views::on(&view) else { continue };
        if file.slice(&view, &path).is_ok() {
            continue;
        }
        let bytes = meshopt_views::decode(extension, file.slice(extension, &path)?, &path)?;
        file.spend(bytes.len())?;
        // The view stands for its compressed bytes, which are to go, in what is folded.
        for key in ["buffer", "byteOffset", "byteLength"] {
            let value = extension.get(key).cloned().unwrap_or(0.into());
            file.json["bufferViews"][index][key] = value;
        }
        file.put_view(index, view, bytes);
    }
    Ok(())
}

/// Unpacks the compressed primitives.
struct Primitives<'a> {
    file: &'a mut Unpacked,
    /// By buffer view.
    meshes: HashMap<usize, DracoMesh>,
    /// By the accessor that a primitive names and what it is to be filled from: the one that is.
    filled: HashMap<(usize, Source), usize>,
    /// Accessors that are filled in their own places.
    taken: HashSet<usize>,
}

/// A buffer view and an attribute in it; of none for indices.
type Source = (usize, Option<usize>);

impl Primitives<'_> {
    fn unpack(mut self) -> Result<()> {
        for mesh in 0..json::list(&self.file.json, "meshes").len() {
            for number in 0..json::list(&self.file.json["meshes"][mesh], "primitives").len() {
                let mut primitive = self.file.json["meshes"][mesh]["primitives"][number].take();
                let extension = primitive.get("extensions").and_then(|e| e.get(draco_mesh::NAME));
                if let Some(extension) = extension.cloned() {
                    let path = format!("meshes[{mesh}].primitives[{number}]");
                    self.primitive(&mut primitive, &extension)
                        .with_context(|| format!("the Draco data of {path} cannot be read"))?;
                }
                self.file.json["meshes"][mesh]["primitives"][number] = primitive;
            }
        }
        Ok(())
    }

    /// Fills the accessors that a primitive refers to.
    fn primitive(&mut self, primitive: &mut Value, extension: &Value) -> Result<()> {
        let view = json::required(extension, "bufferView", draco_mesh::NAME)?;
        self.load(view)?;
        let none = json!({});
        let numbers = extension.get("attributes").unwrap_or(&none);
        for (name, number) in json::named_indices(numbers, draco_mesh::NAME)? {
            let named = primitive.get("attributes").and_then(|a| json::integer(a.get(&name)?));
            let accessor = named.with_context(|| format!("{name} has no accessor"))?;
            let filled = self.attribute(accessor, view, number, &name);
            primitive["attributes"][&name] = filled.with_context(|| name.clone())?.into();
        }
        let indices = json::optional(primitive, "indices", "the primitive")?;
        primitive["indices"] = self.indices(indices, view)?.into();
        if let Some(mode) = primitive.get_mut("mode") {
            *mode = 4.into();
        }
        Ok(())
    }

    fn load(&mut self, view: usize) -> Result<()> {
        if self.meshes.contains_key(&view) {
            return Ok(());
        }
        let path = format!("bufferViews[{view}]");
        let bytes = self.file.slice(json::item(&self.file.json, "bufferViews", view)?, &path)?;
        let mesh = DracoMesh::decode(bytes, self.file.left).context(path)?;
        self.file.free_view(view);
        self.meshes.insert(view, mesh);
        Ok(())
    }

    fn attribute(
        &mut self,
        accessor: usize,
        view: usize,
        number: usize,
        name: &str,
    ) -> Result<usize> {
        let (place, is_new) = self.place(Some(accessor), (view, Some(number)))?;
        if is_new {
            let value = &self.file.new.accessors[place];
            let element = ElementType::of_accessor(value, &format!("accessors[{place}]"))?;
            let stream =
                self.meshes[&view].attribute(number as u32, element.component, element.shape)?;
            let usage = if name == "POSITION" { Usage::Positions } else { Usage::Vertices };
            self.fill(place, &stream, usage)?;
        }
        Ok(place)
    }

    fn indices(&mut self, accessor: Option<usize>, view: usize) -> Result<usize> {
        let (place, is_new) = self.place(accessor, (view, None))?;
        if is_new {
            let indices = self.meshes[&view].indices()?;
            let fits = indices.iter().all(|index| *index < u32::from(u16::MAX));
            let component = if fits { Component::U16 } else { Component::U32 };
            let element = ElementType { component, shape: Shape::SCALAR, normalized: false };
            let values = indices.iter().map(|index| f64::from(*index)).collect();
            self.fill(place, &Stream { element, values }, Usage::Indices)?;
        }
        Ok(place)
    }

    /// The accessor to fill, and whether that is still to be done: the one named, or a copy where
    /// another primitive fills it otherwise.
    fn place(&mut self, accessor: Option<usize>, source: Source) -> Result<(usize, bool)> {
        let accessors = &mut self.file.new.accessors;
        let Some(named) = accessor else {
            accessors.push(json!({}));
            return Ok((accessors.len() - 1, true));
        };
        if let Some(filled) = self.filled.get(&(named, source)) {
            return Ok((*filled, false));
        }
        let original = json::item(&self.file.json, "accessors", named)?;
        let mut place = named;
        if !self.taken.insert(named) {
            accessors.push(original.clone());
            place = accessors.len() - 1;
        }
        self.filled.insert((named, source), place);
        Ok((place, true))
    }

    /// Gives an accessor its elements, whose numbers are as they are stored.
    fn fill(&mut self, accessor: usize, stream: &Stream, usage: Usage) -> Result<()> {
        let size = stream.element.size();
        let stride = if usage == Usage::Indices { size } else { size.next_multiple_of(4) };
        let mut bytes = Vec::new();
        self.file.spend(stream.count().saturating_mul(stride))?;
        for (index, element) in stream.elements().enumerate() {
            stream.element.encode(element, &mut bytes);
            bytes.resize((index + 1) * stride, 0);
        }
        let mut new = description(usage, stream)?;
        let old = &self.file.new.accessors[accessor];
        if let Some(normalized) = old.get("normalized") {
            new["normalized"] = normalized.clone();
        }
        let mut merged = merge(old, new);
        let stride = (stride != size).then_some(stride);
        merged["bufferView"] = self.file.push_view(bytes, stride, usage).into();
        self.file.new.accessors[accessor] = merged;
        Ok(())
    }
}

/// Takes the extensions off all that can carry them.
fn strip(json: &mut Value, names: &[&'static str]) {
    for key in ["bufferViews", "buffers"] {
        if let Some(items) = json.get_mut(key).and_then(Value::as_array_mut) {
            strip_all(items, names);
        }
    }
    let meshes = json.get_mut("meshes").and_then(Value::as_array_mut);
    for mesh in meshes.into_iter().flatten() {
        if let Some(primitives) = mesh.get_mut("primitives").and_then(Value::as_array_mut) {
            strip_all(primitives, names);
        }
    }
}

fn strip_all(items: &mut [Value], names: &[&'static str]) {
    for item in items {
        let Some(fields) = item.as_object_mut() else { continue };
        let Some(extensions) = fields.get_mut("extensions").and_then(Value::as_object_mut) else {
            continue;
        };
        extensions.retain(|name, _| !names.contains(&name.as_str()));
        if extensions.is_empty() {
            fields.shift_remove("extensions");
        }
    }
}
