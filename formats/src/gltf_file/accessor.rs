//! Reads accessors. Every range is checked against the bytes that are there before anything is
//! allocated.

use std::cell::RefCell;
use std::collections::{BTreeMap, HashMap};
use std::sync::Arc;

use anyhow::{Context, Result, ensure};
use serde_json::Value;

use super::budget::Budget;
use super::element::{Component, ElementType, Shape, Stream};
use super::json;

/// Reads the accessors of one file; each is decoded once.
pub struct Accessors<'a> {
    json: &'a Value,
    buffers: &'a [Vec<u8>],
    budget: &'a Budget,
    decoded: RefCell<HashMap<usize, Arc<Stream>>>,
    /// By accessor: the elements with a number that is none, for which zeros were read.
    not_finite: RefCell<BTreeMap<usize, Vec<usize>>>,
}

/// The bytes of a buffer view.
struct View<'a> {
    bytes: &'a [u8],
    stride: Option<usize>,
}

impl<'a> Accessors<'a> {
    pub fn new(json: &'a Value, buffers: &'a [Vec<u8>], budget: &'a Budget) -> Accessors<'a> {
        Accessors {
            json,
            buffers,
            budget,
            decoded: RefCell::default(),
            not_finite: RefCell::default(),
        }
    }

    /// How many elements an accessor states to have, unchecked.
    pub fn count(&self, index: usize) -> Result<usize> {
        json::required(json::item(self.json, "accessors", index)?, "count", &path(index))
    }

    /// Whether an accessor replaces some of its elements by a sparse list.
    pub fn is_sparse(&self, index: usize) -> bool {
        json::list(self.json, "accessors").get(index).is_some_and(|a| a.get("sparse").is_some())
    }

    /// The elements of an accessor, which was read, that are not finite.
    pub fn not_finite(&self, index: usize) -> Vec<usize> {
        self.not_finite.borrow().get(&index).cloned().unwrap_or_default()
    }

    /// A sentence for each accessor that was read and is not finite throughout.
    pub fn notes(&self) -> Vec<String> {
        let note = |(index, bad): (&usize, &Vec<usize>)| {
            let (path, first, count) = (path(*index), bad[0], bad.len());
            format!(
                "{path} has an infinite value or a NaN in {count} of its elements, first in \
                 element {first}: 0 was read in its place"
            )
        };
        self.not_finite.borrow().iter().map(note).collect()
    }

    /// The values of an accessor, all finite: zero in the place of those that are not.
    pub fn read(&self, index: usize) -> Result<Arc<Stream>> {
        if let Some(stream) = self.decoded.borrow().get(&index) {
            return Ok(stream.clone());
        }
        let accessor = json::item(self.json, "accessors", index)?;
        let path = path(index);
        let mut stream = self.decode(accessor, &path)?;
        let bad = |element: &[f64]| element.iter().any(|number| !number.is_finite());
        let bad: Vec<usize> = (0..stream.count()).filter(|&at| bad(stream.at(at))).collect();
        if !bad.is_empty() {
            stream.values.iter_mut().filter(|n| !n.is_finite()).for_each(|n| *n = 0.0);
            self.not_finite.borrow_mut().insert(index, bad);
        }
        let stream = Arc::new(stream);
        self.decoded.borrow_mut().insert(index, stream.clone());
        Ok(stream)
    }

    /// The values of an index accessor, and the one that restarts a strip.
    pub fn read_indices(&self, index: usize) -> Result<(Vec<u32>, u32)> {
        let stream = self.read(index)?;
        let ElementType { component, shape, normalized } = stream.element;
        let unsigned = matches!(component, Component::U8 | Component::U16 | Component::U32);
        ensure!(
            unsigned && shape == Shape::SCALAR && !normalized,
            "{} is used for indices, but is not made of plain unsigned integers",
            path(index)
        );
        let indices = stream.values.iter().map(|value| *value as u32).collect();
        Ok((indices, component.one() as u32))
    }

    fn decode(&self, accessor: &Value, path: &str) -> Result<Stream> {
        let element = ElementType::of_accessor(accessor, path)?;
        let count = json::required(accessor, "count", path)?;
        let mut values = match json::optional(accessor, "bufferView", path)? {
            Some(_) => self.elements(accessor, path, element, count)?,
            None => self.zeros(element, count)?,
        };
        if let Some(sparse) = accessor.get("sparse") {
            self.replace_some(sparse, &format!("{path}.sparse"), element, &mut values)?;
        }
        Ok(Stream { element, values })
    }

    fn replace_some(
        &self,
        sparse: &Value,
        path: &str,
        element: ElementType,
        values: &mut [f64],
    ) -> Result<()> {
        let count = json::required(sparse, "count", path)?;
        let part = |key: &str| {
            let owner = sparse.get(key).with_context(|| format!("{path}.{key} is missing"))?;
            Ok::<_, anyhow::Error>((owner, format!("{path}.{key}")))
        };
        let (indices, indices_path) = part("indices")?;
        let (replacements, values_path) = part("values")?;
        let code = json::required(indices, "componentType", &indices_path)?;
        let component = Component::of_code(code)
            .with_context(|| format!("{indices_path}.componentType is {code}"))?;
        let index = ElementType { component, shape: Shape::SCALAR, normalized: false };
        let places = self.elements(indices, &indices_path, index, count)?;
        let numbers = self.elements(replacements, &values_path, element, count)?;
        let width = element.shape.components();
        for (place, replacement) in places.iter().zip(numbers.chunks_exact(width)) {
            let target =
                values.chunks_exact_mut(width).nth(*place as usize).with_context(|| {
                    format!(
                        "{indices_path} names element {place}, which the accessor does not have"
                    )
                })?;
            target.copy_from_slice(replacement);
        }
        Ok(())
    }

    /// The elements that `owner` (an accessor or a part of a sparse one) has in its buffer view.
    fn elements(
        &self,
        owner: &Value,
        path: &str,
        element: ElementType,
        count: usize,
    ) -> Result<Vec<f64>> {
        let view_index = json::required(owner, "bufferView", path)?;
        let offset = json::optional(owner, "byteOffset", path)?.unwrap_or(0);
        let view = self.view(view_index)?;
        let stride = view.stride.unwrap_or(element.size());
        ensure!(
            stride >= element.size(),
            "bufferViews[{view_index}].byteStride is {stride}, less than an element of {path}"
        );
        let length = count.checked_sub(1).map_or(Some(0), |gaps| {
            gaps.checked_mul(stride)?.checked_add(element.size())?.checked_add(offset)
        });
        ensure!(
            length.is_some_and(|length| length <= view.bytes.len()),
            "{path} of {count} elements reaches past the end of bufferViews[{view_index}], \
             which has {} bytes",
            view.bytes.len()
        );
        let numbers = count * element.shape.components();
        self.budget.spend(numbers)?;
        let mut values = Vec::with_capacity(numbers);
        for index in 0..count {
            element.decode(&view.bytes[offset + index * stride..], &mut values);
        }
        Ok(values)
    }

    fn zeros(&self, element: ElementType, count: usize) -> Result<Vec<f64>> {
        let numbers = count.saturating_mul(element.shape.components());
        self.budget.spend(numbers)?;
        Ok(vec![0.0; numbers])
    }

    fn view(&self, index: usize) -> Result<View<'a>> {
        let view = json::item(self.json, "bufferViews", index)?;
        let path = format!("bufferViews[{index}]");
        let buffer = json::required(view, "buffer", &path)?;
        let offset = json::optional(view, "byteOffset", &path)?.unwrap_or(0);
        let length = json::required(view, "byteLength", &path)?;
        // Some exporters write 0 for elements that stand close together.
        let stride = json::optional(view, "byteStride", &path)?.filter(|stride| *stride > 0);
        let bytes = self.buffers.get(buffer).with_context(|| {
            format!("{path} lies in buffers[{buffer}], which the file does not have")
        })?;
        let bytes = offset
            .checked_add(length)
            .and_then(|end| bytes.get(offset..end))
            .with_context(|| format!("{path} reaches past the end of buffers[{buffer}]"))?;
        Ok(View { bytes, stride })
    }
}

fn path(index: usize) -> String {
    format!("accessors[{index}]")
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    fn read(json: Value, bytes: &[u8]) -> Result<Vec<f64>> {
        let buffers = [bytes.to_vec()];
        let budget = Budget::of_file(bytes.len());
        Ok(Accessors::new(&json, &buffers, &budget).read(0)?.values.clone())
    }

    fn message(json: Value, bytes: &[u8]) -> String {
        format!("{:#}", read(json, bytes).unwrap_err())
    }

    #[test]
    fn interleaved_elements_are_picked_by_stride() {
        let json = json!({
            "accessors": [{"bufferView": 0, "byteOffset": 1, "componentType": 5121, "count": 2, "type": "VEC2"}],
            "bufferViews": [{"buffer": 0, "byteLength": 8, "byteOffset": 1, "byteStride": 4}],
        });
        let bytes = [9, 9, 1, 2, 9, 9, 3, 4, 9];
        assert_eq!(read(json, &bytes).unwrap(), [1.0, 2.0, 3.0, 4.0]);
    }

    fn sparse(place: u8) -> (Value, [u8; 8]) {
        let json = json!({
            "accessors": [{"componentType": 5123, "count": 3, "type": "SCALAR", "sparse": {
                "count": 2,
                "indices": {"bufferView": 0, "componentType": 5121},
                "values": {"bufferView": 0, "byteOffset": 4}
            }}],
            "bufferViews": [{"buffer": 0, "byteLength": 8}],
        });
        (json, [0, place, 0, 0, 7, 0, 8, 1])
    }

    #[test]
    fn sparse_elements_replace_zeros() {
        let (json, bytes) = sparse(2);
        assert_eq!(read(json, &bytes).unwrap(), [7.0, 0.0, 264.0]);
    }

    #[test]
    fn sparse_indices_are_checked() {
        let (json, bytes) = sparse(3);
        assert!(message(json, &bytes).contains("names element 3"));
    }

    #[test]
    fn elements_past_the_end_are_refused_before_any_allocation() {
        for count in [3u64, 1 << 40, u64::MAX] {
            let json = json!({
                "accessors": [{"bufferView": 0, "componentType": 5126, "count": count, "type": "SCALAR"}],
                "bufferViews": [{"buffer": 0, "byteLength": 8}],
            });
            assert!(message(json, &[0; 8]).contains("past the end"), "{count}");
        }
        let zeros =
            json!({"accessors": [{"componentType": 5126, "count": 1u64 << 40, "type": "MAT4"}]});
        assert!(message(zeros, &[]).contains("refused"));
    }

    #[test]
    fn a_view_past_its_buffer_is_refused() {
        let json = json!({
            "accessors": [{"bufferView": 0, "componentType": 5121, "count": 1, "type": "SCALAR"}],
            "bufferViews": [{"buffer": 0, "byteOffset": u64::MAX, "byteLength": 2}],
        });
        assert!(message(json, &[0; 8]).contains("past the end"));
    }

    #[test]
    fn zero_is_read_in_the_place_of_a_nan() {
        let json = json!({
            "accessors": [{"bufferView": 0, "componentType": 5126, "count": 2, "type": "SCALAR"}],
            "bufferViews": [{"buffer": 0, "byteLength": 8}],
        });
        let bytes: Vec<u8> = [1.0f32, f32::NAN].iter().flat_map(|f| f.to_le_bytes()).collect();
        let (buffers, budget) = ([bytes], Budget::of_file(8));
        let accessors = Accessors::new(&json, &buffers, &budget);
        assert_eq!(accessors.read(0).unwrap().values, [1.0, 0.0]);
        assert_eq!(accessors.not_finite(0), [1]);
        assert!(accessors.notes()[0].contains("first in element 1"));
    }
}
