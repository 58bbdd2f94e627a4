//! Writes new accessors in the places of those that nothing refers to any longer, so that all
//! other references into the file stay as they are.

use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::ops::Range;

use anyhow::{Result, bail};
use serde_json::{Value, json};

use super::element::{Component, ElementType, Shape, Stream};
use super::json;
use super::references::Freed;

/// What a new accessor is in the place of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Role {
    /// The accessor of this number.
    Successor(usize),
    /// Normals of the positions in the accessor of this number, which had none.
    NormalsOf(usize),
    /// Indices of the positions in the accessor of this number, which had none.
    IndicesOf(usize),
}

/// How an accessor is used and written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Usage {
    Vertices,
    /// Vertex positions, or their displacements: with bounds.
    Positions,
    Indices,
}

impl Usage {
    /// What a buffer view says that it is for.
    pub fn target(self) -> u32 {
        match self {
            Usage::Indices => 34963,
            Usage::Vertices | Usage::Positions => 34962,
        }
    }
}

/// The new accessors, buffer views and bytes of a file.
pub struct AccessorWriter {
    accessors: Vec<Value>,
    views: Vec<Value>,
    free_accessors: BTreeSet<usize>,
    free_views: BTreeSet<usize>,
    bytes: Vec<u8>,
    /// By role: primitives that shared an accessor share its successor if it is the same.
    written: HashMap<Role, Vec<Written>>,
    new_views: BTreeMap<usize, usize>,
}

struct Written {
    accessor: usize,
    element: ElementType,
    count: usize,
    bytes: Range<usize>,
}

/// What an [`AccessorWriter`] made.
pub struct NewData {
    pub accessors: Vec<Value>,
    pub views: Vec<Value>,
    /// The content of the new views.
    pub bytes: Vec<u8>,
    /// Where each new view starts in `bytes`.
    pub new_views: BTreeMap<usize, usize>,
}

impl AccessorWriter {
    pub fn new(json: &Value, freed: Freed) -> AccessorWriter {
        AccessorWriter {
            accessors: json::list(json, "accessors").to_vec(),
            views: json::list(json, "bufferViews").to_vec(),
            free_accessors: freed.accessors,
            free_views: freed.views,
            bytes: Vec::new(),
            written: HashMap::new(),
            new_views: BTreeMap::new(),
        }
    }

    /// Writes triangle indices, as small as fits.
    pub fn write_indices(&mut self, role: Role, indices: &[u32]) -> Result<usize> {
        // The greatest index of a type is reserved for restarting strips.
        let fits = indices.iter().all(|index| *index < u32::from(u16::MAX));
        let component = if fits { Component::U16 } else { Component::U32 };
        let element = ElementType { component, shape: Shape::SCALAR, normalized: false };
        let values = indices.iter().map(|index| f64::from(*index)).collect();
        self.write(role, Usage::Indices, &Stream { element, values })
    }

    /// Writes all elements of a stream.
    pub fn write(&mut self, role: Role, usage: Usage, stream: &Stream) -> Result<usize> {
        let stride = stride(usage, stream.element);
        let mut bytes = Vec::with_capacity(stream.count() * stride);
        for (index, element) in stream.elements().enumerate() {
            stream.element.encode(element, &mut bytes);
            bytes.resize((index + 1) * stride, 0);
        }
        if let Some(same) = self.same(role, stream, &bytes) {
            return Ok(same);
        }
        let range = self.append(&bytes);
        let mut accessor = description(usage, stream)?;
        let packed = stride == stream.element.size();
        let view = self.push_view(&range, (!packed).then_some(stride), Some(usage));
        accessor["bufferView"] = view.into();
        Ok(self.finish_accessor(role, stream, range, accessor))
    }

    /// Writes only the elements that are not zero, where that is shorter.
    pub fn write_sparse(&mut self, role: Role, usage: Usage, stream: &Stream) -> Result<usize> {
        let places: Vec<usize> = (0..stream.count())
            .filter(|place| stream.at(*place).iter().any(|number| *number != 0.0))
            .collect();
        let index =
            ElementType { component: Component::U32, shape: Shape::SCALAR, normalized: false };
        let sparse_size = places.len() * (index.size() + stream.element.size());
        if sparse_size >= stream.count() * stream.element.size() {
            return self.write(role, usage, stream);
        }
        let (mut indices, mut values) = (Vec::new(), Vec::new());
        for place in &places {
            index.encode(&[*place as f64], &mut indices);
            stream.element.encode(stream.at(*place), &mut values);
        }
        let both = [&*indices, &*values].concat();
        if let Some(same) = self.same(role, stream, &both) {
            return Ok(same);
        }
        let range = self.append(&both);
        let mut accessor = description(usage, stream)?;
        if !places.is_empty() {
            let middle = range.start + indices.len();
            let indices = self.push_view(&(range.start..middle), None, None);
            let values = self.push_view(&(middle..range.end), None, None);
            accessor["sparse"] = json!({
                "count": places.len(),
                "indices": {"bufferView": indices, "componentType": index.component.code()},
                "values": {"bufferView": values},
            });
        }
        Ok(self.finish_accessor(role, stream, range, accessor))
    }

    /// Everything that was written. Views that stay free keep their bytes.
    pub fn finish(self) -> NewData {
        let AccessorWriter { accessors, views, bytes, new_views, .. } = self;
        NewData { accessors, views, bytes, new_views }
    }

    fn same(&self, role: Role, stream: &Stream, bytes: &[u8]) -> Option<usize> {
        let same = |written: &&Written| {
            written.element == stream.element
                && written.count == stream.count()
                && self.bytes[written.bytes.clone()] == *bytes
        };
        self.written.get(&role)?.iter().find(same).map(|written| written.accessor)
    }

    fn append(&mut self, bytes: &[u8]) -> Range<usize> {
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        let start = self.bytes.len();
        self.bytes.extend_from_slice(bytes);
        start..self.bytes.len()
    }

    fn push_view(
        &mut self,
        range: &Range<usize>,
        stride: Option<usize>,
        usage: Option<Usage>,
    ) -> usize {
        // `fold` adds to the offset where the new bytes start.
        let mut view = json!({"buffer": 0, "byteOffset": 0, "byteLength": range.len()});
        if let Some(stride) = stride {
            view["byteStride"] = stride.into();
        }
        if let Some(usage) = usage {
            view["target"] = usage.target().into();
        }
        let index = match self.free_views.pop_first() {
            Some(free) => {
                self.views[free] = view;
                free
            }
            None => {
                self.views.push(view);
                self.views.len() - 1
            }
        };
        self.new_views.insert(index, range.start);
        index
    }

    fn finish_accessor(
        &mut self,
        role: Role,
        stream: &Stream,
        bytes: Range<usize>,
        accessor: Value,
    ) -> usize {
        let index = self.place(role, accessor);
        let written =
            Written { accessor: index, element: stream.element, count: stream.count(), bytes };
        self.written.entry(role).or_default().push(written);
        index
    }

    /// A successor keeps the name and all else that was said of the accessor before it.
    fn place(&mut self, role: Role, accessor: Value) -> usize {
        let Role::Successor(old) = role else {
            self.accessors.push(accessor);
            return self.accessors.len() - 1;
        };
        let successor = merge(&self.accessors[old], accessor);
        if self.free_accessors.remove(&old) {
            self.accessors[old] = successor;
            return old;
        }
        self.accessors.push(successor);
        self.accessors.len() - 1
    }
}

/// Keeps the order of the fields that stay, so that files compare well.
pub fn merge(old: &Value, new: Value) -> Value {
    const REPLACED: [&str; 9] = [
        "bufferView",
        "byteOffset",
        "componentType",
        "normalized",
        "count",
        "type",
        "max",
        "min",
        "sparse",
    ];
    let mut merged = old.clone();
    let (Some(fields), Value::Object(mut new)) = (merged.as_object_mut(), new) else {
        return merged;
    };
    fields.retain(|key, value| match new.shift_remove(key) {
        Some(replacement) => {
            *value = replacement;
            true
        }
        None => !REPLACED.contains(&key.as_str()),
    });
    fields.extend(new);
    merged
}

/// Vertex attributes start at multiples of four bytes.
fn stride(usage: Usage, element: ElementType) -> usize {
    match usage {
        Usage::Indices => element.size(),
        Usage::Vertices | Usage::Positions => element.size().next_multiple_of(4),
    }
}

/// What an accessor says of a stream.
///
/// # Errors
/// Where there is nothing in it.
pub fn description(usage: Usage, stream: &Stream) -> Result<Value> {
    if stream.values.is_empty() {
        bail!("a primitive would be left without vertices or triangles, which glTF cannot say");
    }
    let ElementType { component, shape, normalized } = stream.element;
    let mut accessor = json!({
        "componentType": component.code(),
        "count": stream.count(),
        "type": shape.name(),
    });
    if normalized {
        accessor["normalized"] = true.into();
    }
    if usage == Usage::Positions {
        accessor["max"] = bound(stream, f64::max);
        accessor["min"] = bound(stream, f64::min);
    }
    Ok(accessor)
}

/// A bound as the type holds it: bounds of integers count in integers, normalized or not.
fn bound(stream: &Stream, choose: fn(f64, f64) -> f64) -> Value {
    let ElementType { component, shape, normalized } = stream.element;
    let one = if normalized { component.one() } else { 1.0 };
    let bound = (0..shape.components()).map(|index| {
        let numbers = stream.elements().map(|element| element[index]);
        let number = numbers.reduce(choose).unwrap_or_default();
        match component.is_integer() {
            true => Value::from((number * one).round() as i64),
            // Zero has one sign, or the bounds would depend on the order of the vertices.
            false => Value::from(number + 0.0),
        }
    });
    bound.collect::<Vec<_>>().into()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn floats(values: &[f64]) -> Stream {
        Stream { element: ElementType::floats(Shape::VEC3), values: values.to_vec() }
    }

    fn empty() -> AccessorWriter {
        AccessorWriter::new(&json!({}), Freed::default())
    }

    #[test]
    fn a_freed_accessor_hands_on_its_number_name_and_extras() {
        let json = json!({
            "accessors": [{"name": "p", "bufferView": 0, "byteOffset": 4, "count": 9, "extras": 1}],
            "bufferViews": [{"buffer": 0, "byteLength": 3}],
        });
        let freed = Freed { accessors: BTreeSet::from([0]), views: BTreeSet::from([0]) };
        let mut writer = AccessorWriter::new(&json, freed);
        let stream = floats(&[1.0, 2.0, 3.0]);
        assert_eq!(writer.write(Role::Successor(0), Usage::Positions, &stream).unwrap(), 0);
        assert_eq!(
            writer.finish().accessors[0],
            json!({
                "name": "p", "bufferView": 0, "count": 1, "extras": 1,
                "componentType": 5126, "type": "VEC3",
                "max": [1.0, 2.0, 3.0], "min": [1.0, 2.0, 3.0],
            })
        );
    }

    #[test]
    fn equal_content_of_one_role_is_written_once() {
        let mut writer = empty();
        let mut write = |position, x| {
            let stream = floats(&[x, 0.0, 0.0]);
            writer.write(Role::NormalsOf(position), Usage::Vertices, &stream).unwrap()
        };
        assert_eq!([write(7, 1.0), write(7, 1.0), write(7, 2.0), write(8, 1.0)], [0, 0, 1, 2]);
    }

    #[test]
    fn narrow_elements_are_padded_to_four_bytes() {
        let element =
            ElementType { component: Component::U8, shape: Shape::VEC3, normalized: true };
        let stream = Stream { element, values: vec![1.0; 6] };
        let mut writer = empty();
        writer.write(Role::NormalsOf(0), Usage::Vertices, &stream).unwrap();
        let data = writer.finish();
        assert_eq!(data.views[0]["byteStride"], 4);
        assert_eq!(data.bytes, [255, 255, 255, 0, 255, 255, 255, 0]);
    }

    #[test]
    fn indices_are_as_small_as_fits() {
        let mut writer = empty();
        let small = writer.write_indices(Role::IndicesOf(0), &[0, 1, 65534]).unwrap();
        let large = writer.write_indices(Role::IndicesOf(1), &[0, 1, 65535]).unwrap();
        let accessors = writer.finish().accessors;
        assert_eq!(accessors[small]["componentType"], 5123);
        assert_eq!(accessors[large]["componentType"], 5125);
    }

    #[test]
    fn few_displacements_are_written_sparse() {
        let mut values = vec![0.0; 30];
        values[3..6].copy_from_slice(&[1.0, 2.0, 3.0]);
        let mut writer = empty();
        writer.write_sparse(Role::NormalsOf(0), Usage::Positions, &floats(&values)).unwrap();
        writer.write_sparse(Role::NormalsOf(1), Usage::Positions, &floats(&[0.0; 30])).unwrap();
        let data = writer.finish();
        assert_eq!(data.accessors[0]["sparse"]["count"], 1);
        assert_eq!(data.accessors[0].get("bufferView"), None);
        assert_eq!(data.accessors[1].get("sparse"), None);
        assert_eq!(data.views.len(), 2);
    }
}
