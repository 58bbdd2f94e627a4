//! A compressed file while its parts are unpacked.

use std::collections::{BTreeMap, BTreeSet};

use anyhow::{Context, Result};
use serde_json::{Value, json};

use super::accessor_writer::{NewData, Usage};
use super::json;

/// The old file, and what takes the place of its compressed parts.
pub struct Unpacked {
    /// As it was, but that views name the bytes that were unpacked: those go.
    pub json: Value,
    /// `#buffers`.
    pub buffers: Vec<Vec<u8>>,
    pub new: NewData,
    /// Bytes that may still be unpacked.
    pub left: usize,
    /// Numbers of views that were unpacked and that nothing uses any longer.
    free: BTreeSet<usize>,
}

impl Unpacked {
    /// A file of which nothing is unpacked yet, and how many bytes may be.
    pub fn new(json: Value, buffers: Vec<Vec<u8>>, left: usize) -> Unpacked {
        let new = NewData {
            accessors: json::list(&json, "accessors").to_vec(),
            views: json::list(&json, "bufferViews").to_vec(),
            bytes: Vec::new(),
            new_views: BTreeMap::new(),
        };
        Unpacked { json, buffers, new, left, free: BTreeSet::new() }
    }

    /// Takes bytes off those that may be unpacked.
    ///
    /// # Errors
    /// Where that are too many.
    pub fn spend(&mut self, bytes: usize) -> Result<()> {
        self.left = self.left.checked_sub(bytes).context(
            "the geometry unpacks to far more bytes than the file has: refused as an attack on the \
             memory",
        )?;
        Ok(())
    }

    /// The bytes that a view, or an extension that is like one, names.
    ///
    /// # Errors
    /// Where they are not there.
    pub fn slice(&self, view: &Value, path: &str) -> Result<&[u8]> {
        let buffer = json::required(view, "buffer", path)?;
        let offset = json::optional(view, "byteOffset", path)?.unwrap_or(0);
        let length = json::required(view, "byteLength", path)?;
        let range = |bytes: &'_ Vec<u8>| {
            Some(offset..offset.checked_add(length)?).filter(|range| range.end <= bytes.len())
        };
        let bytes = self.buffers.get(buffer);
        bytes
            .and_then(|bytes| Some(&bytes[range(bytes)?]))
            .with_context(|| format!("{path} reaches past the end of buffers[{buffer}]"))
    }

    /// Puts a view on new bytes in the place of one; the rest of it stays.
    pub fn put_view(&mut self, index: usize, mut view: Value, bytes: Vec<u8>) {
        let start = self.new.bytes.len().next_multiple_of(4);
        self.new.bytes.resize(start, 0);
        self.new.new_views.insert(index, start);
        // Folding adds to the offset where the new bytes start.
        view["buffer"] = 0.into();
        view["byteOffset"] = 0.into();
        view["byteLength"] = bytes.len().into();
        self.new.views[index] = view;
        self.new.bytes.extend(bytes);
    }

    /// Adds a view on new bytes.
    pub fn push_view(&mut self, bytes: Vec<u8>, stride: Option<usize>, usage: Usage) -> usize {
        let index = self.free.pop_first().unwrap_or(self.new.views.len());
        if index == self.new.views.len() {
            self.new.views.push(Value::Null);
        }
        let mut view = json!({"target": usage.target()});
        if let Some(stride) = stride {
            view["byteStride"] = stride.into();
        }
        self.put_view(index, view, bytes);
        index
    }

    /// Lets a new view have the number of one that was unpacked, whose bytes go.
    pub fn free_view(&mut self, index: usize) {
        self.free.insert(index);
        self.new.new_views.insert(index, 0);
    }

    /// Empties the buffers in which only compressed bytes were, or only their stand-in.
    pub fn empty_unused_buffers(&mut self) {
        let views = json::list(&self.json, "bufferViews");
        let buffer = |view: &Value| view.get("buffer").and_then(json::integer);
        let used: BTreeSet<usize> = views.iter().filter_map(buffer).collect();
        for (number, bytes) in self.buffers.iter_mut().enumerate() {
            if !used.contains(&number) {
                bytes.clear();
            }
        }
    }
}
