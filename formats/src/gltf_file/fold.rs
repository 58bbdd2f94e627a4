//! Folds all buffers of a file into one, without the bytes of replaced views, with new ones behind.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

use anyhow::{Context, Result};
use serde_json::{Value, json};

use super::accessor_writer::NewData;
use super::json;

/// Pieces keep their alignment to this, the largest size of an accessor's components.
const ALIGNMENT: usize = 4;

/// Part of an old buffer, and where it starts in the new one.
struct Piece {
    buffer: usize,
    range: Range<usize>,
    start: usize,
}

/// Puts the new accessors and views into the file and gives the content of its one buffer.
///
/// # Errors
/// Where a view of the file lies in no buffer.
pub fn fold(
    json: &mut Value,
    buffers: &[Vec<u8>],
    new: NewData,
    may_drop_bytes: bool,
) -> Result<Vec<u8>> {
    let replaced: BTreeSet<usize> = new.new_views.keys().copied().collect();
    let old_views = json::list(json, "bufferViews");
    let dropped = if may_drop_bytes { dropped_ranges(old_views, &replaced)? } else { Vec::new() };
    let (mut bytes, pieces) = gather(buffers, &dropped);
    let mut views = new.views;
    for (index, view) in views.iter_mut().enumerate() {
        if !replaced.contains(&index) {
            move_view(view, &pieces, &format!("bufferViews[{index}]"))?;
        }
    }
    let mut last = 0;
    if !new.bytes.is_empty() {
        bytes.resize(bytes.len().next_multiple_of(ALIGNMENT), 0);
        last = bytes.len();
        bytes.extend(new.bytes);
    }
    for (index, start) in new.new_views {
        views[index]["byteOffset"] = (last + start).into();
    }
    set_list(json, "accessors", new.accessors);
    set_list(json, "bufferViews", views);
    set_buffer(json, bytes.len());
    Ok(bytes)
}

/// What only replaced views cover, by buffer: sorted and disjoint.
fn dropped_ranges(
    views: &[Value],
    replaced: &BTreeSet<usize>,
) -> Result<Vec<(usize, Range<usize>)>> {
    let mut edges: BTreeMap<(usize, usize), [i64; 2]> = BTreeMap::new();
    for (index, view) in views.iter().enumerate() {
        let (buffer, range) = view_range(view, &format!("bufferViews[{index}]"))?;
        let kind = usize::from(replaced.contains(&index));
        edges.entry((buffer, range.start)).or_default()[kind] += 1;
        edges.entry((buffer, range.end)).or_default()[kind] -= 1;
    }
    let mut dropped: Vec<(usize, Range<usize>)> = Vec::new();
    let mut open = [0, 0];
    let mut start = None;
    for ((buffer, offset), [kept, replaced]) in edges {
        open = [open[0] + kept, open[1] + replaced];
        let drops = open[0] == 0 && open[1] > 0;
        match (start, drops) {
            (None, true) => start = Some(offset),
            (Some(from), false) => {
                dropped.push((buffer, from..offset));
                start = None;
            }
            _ => {}
        }
    }
    Ok(dropped)
}

fn view_range(view: &Value, path: &str) -> Result<(usize, Range<usize>)> {
    let buffer = json::required(view, "buffer", path)?;
    let offset = json::optional(view, "byteOffset", path)?.unwrap_or(0);
    let length = json::required(view, "byteLength", path)?;
    let end = offset.checked_add(length).with_context(|| format!("{path} is too long"))?;
    Ok((buffer, offset..end))
}

/// All that is not dropped, one buffer after the other.
fn gather(buffers: &[Vec<u8>], dropped: &[(usize, Range<usize>)]) -> (Vec<u8>, Vec<Piece>) {
    let mut bytes = Vec::new();
    let mut pieces = Vec::new();
    for (buffer, content) in buffers.iter().enumerate() {
        let mut from = 0;
        let before = dropped.partition_point(|(of, _)| *of < buffer);
        let gaps = dropped[before..].iter().take_while(|(of, _)| *of == buffer);
        let gaps = gaps.map(|(_, range)| range.clone());
        for gap in gaps.chain(std::iter::once(content.len()..content.len())) {
            let range = from..gap.start.min(content.len());
            from = gap.end;
            if range.is_empty() {
                continue;
            }
            let padding = (range.start + ALIGNMENT - bytes.len() % ALIGNMENT) % ALIGNMENT;
            bytes.resize(bytes.len() + padding, 0);
            pieces.push(Piece { buffer, range: range.clone(), start: bytes.len() });
            bytes.extend_from_slice(&content[range]);
        }
    }
    (bytes, pieces)
}

fn move_view(view: &mut Value, pieces: &[Piece], path: &str) -> Result<()> {
    let (buffer, range) = view_range(view, path)?;
    let next = pieces.partition_point(|p| (p.buffer, p.range.start) <= (buffer, range.start));
    let piece = next.checked_sub(1).map(|index| &pieces[index]);
    let piece = piece.filter(|piece| piece.buffer == buffer && range.end <= piece.range.end);
    let piece = piece.with_context(|| format!("{path} reaches past the end of its buffer"))?;
    let offset = piece.start + range.start - piece.range.start;
    view["buffer"] = 0.into();
    if offset != 0 || view.get("byteOffset").is_some() {
        view["byteOffset"] = offset.into();
    }
    Ok(())
}

fn set_list(json: &mut Value, key: &str, items: Vec<Value>) {
    if !items.is_empty() || json.get(key).is_some() {
        json[key] = items.into();
    }
}

/// Leaves one buffer, with the name and extras of the first.
fn set_buffer(json: &mut Value, length: usize) {
    if length == 0 {
        return;
    }
    let mut buffer = json::list(json, "buffers").first().cloned().unwrap_or_else(|| json!({}));
    if let Some(fields) = buffer.as_object_mut() {
        fields.shift_remove("uri");
    }
    buffer["byteLength"] = length.into();
    json["buffers"] = vec![buffer].into();
}

#[cfg(test)]
mod tests {
    use super::*;

    fn view(buffer: usize, offset: usize, length: usize) -> Value {
        json!({"buffer": buffer, "byteOffset": offset, "byteLength": length})
    }

    fn folded(views: Vec<Value>, buffers: &[Vec<u8>], replaced: &[usize]) -> (Value, Vec<u8>) {
        let mut json = json!({"bufferViews": views, "buffers": [{"name": "b", "uri": "x.bin"}]});
        let mut views = json["bufferViews"].as_array().unwrap().clone();
        let mut new_views = BTreeMap::new();
        for index in replaced {
            views[*index] = view(0, 0, 4);
            new_views.insert(*index, 0);
        }
        let bytes = if replaced.is_empty() { vec![] } else { vec![9; 4] };
        let new = NewData { accessors: vec![], views, bytes, new_views };
        let bytes = fold(&mut json, buffers, new, true).unwrap();
        (json, bytes)
    }

    #[test]
    fn buffers_follow_one_another_aligned() {
        let views = vec![view(0, 0, 3), view(1, 1, 2)];
        let (json, bytes) = folded(views, &[vec![1, 2, 3], vec![4, 5, 6]], &[]);
        assert_eq!(bytes, [1, 2, 3, 0, 4, 5, 6]);
        assert_eq!(json["bufferViews"][1], view(0, 5, 2));
        assert_eq!(json["buffers"], json!([{"name": "b", "byteLength": 7}]));
    }

    #[test]
    fn only_bytes_of_no_other_view_are_dropped() {
        //  0 1 2 3 4 5 6 7 8 9 ..
        //  [replaced     ]
        //              [kept ]
        let buffer: Vec<u8> = (0..12).collect();
        let (json, bytes) = folded(vec![view(0, 0, 8), view(0, 6, 4)], &[buffer], &[0]);
        assert_eq!(bytes, [0, 0, 6, 7, 8, 9, 10, 11, 9, 9, 9, 9]);
        assert_eq!(json["bufferViews"][1], view(0, 2, 4));
        assert_eq!(json["bufferViews"][0], view(0, 8, 4));
    }

    #[test]
    fn touching_views_are_dropped_as_one() {
        let buffer: Vec<u8> = (0..12).collect();
        let views = vec![view(0, 0, 4), view(0, 4, 4), view(0, 8, 4)];
        let (json, bytes) = folded(views, &[buffer], &[0, 1]);
        assert_eq!(bytes, [8, 9, 10, 11, 9, 9, 9, 9]);
        assert_eq!(json["bufferViews"][2], view(0, 0, 4));
    }
}
