//! Compresses written glTF files with meshoptimizer's codecs, as `EXT_meshopt_compression` has them:
//! without filters, and so without loss. Each view is unpacked again, and stays plain if anything
//! is otherwise then, or if it got no smaller.

use std::collections::BTreeSet;

use anyhow::{Context, Result, bail, ensure};
use serde_json::{Value, json};

use super::container::{self, Container};
use super::element::ElementType;
use super::extensions::Mentions;
use super::json;
use super::meshopt_views;
use super::uri;
use crate::document::{Encoded, Format};

const NAME: &str = meshopt_views::NAMES[0];
const ALIGNMENT: usize = 4;
/// The codec's version in this extension; later ones have another.
const VERSION: i32 = 0;
/// How hard the encoder tries; it does not matter for that version.
const LEVEL: i32 = 2;

/// What the elements of a view are.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Content {
    /// Of so many bytes each.
    Elements(usize),
    /// Likewise, two or four.
    Indices(usize),
    /// Of several kinds, or of none that the codec has.
    Other,
}

/// Compresses the geometry of an encoded .glb or .gltf, and says by how much.
///
/// # Errors
/// Where it is another format, or has several buffers.
pub fn compress(encoded: &mut Encoded) -> Result<()> {
    let main = encoded.files.first().context("there is no file")?;
    let is_gltf = crate::row_of(&main.path)
        .is_some_and(|row| matches!(row.format, Format::Glb | Format::Gltf));
    ensure!(is_gltf, "only .glb and .gltf can be compressed: end the output in one of them");
    let Container { format, json, binary, further_chunks } = container::parse(&main.bytes)?;
    let mut json: Value = serde_json::from_slice(json)?;
    let Some((place, bytes)) = only_buffer(&json, binary, encoded)? else { return Ok(()) };
    let Some(packed) = pack(&mut json, &bytes)? else { return Ok(()) };
    let (old, new) = (bytes.len().div_ceil(1024), packed.len().div_ceil(1024));
    let text = serde_json::to_vec(&json)?;
    let rewritten = match (format, place) {
        (Format::Glb, _) => container::write_glb(&text, &packed, further_chunks)?,
        (_, Some(companion)) => {
            encoded.files[companion].bytes = packed;
            serde_json::to_vec_pretty(&json)?
        }
        (_, None) => {
            json["buffers"][0]["uri"] = uri::write_data(&packed).into();
            serde_json::to_vec_pretty(&json)?
        }
    };
    encoded.files[0].bytes = rewritten;
    encoded.notes.retain(|note| !note.ends_with(WRITTEN_WITHOUT));
    encoded.notes.push(format!("written with {NAME}: {new} kB of {old}"));
    Ok(())
}

/// How a note ends that a file was compressed, but is no longer.
pub const WRITTEN_WITHOUT: &str = "and is written without";

/// The content of the one buffer, and which of the encoded files it is; none if there is none.
fn only_buffer(
    json: &Value,
    binary: Option<&[u8]>,
    encoded: &Encoded,
) -> Result<Option<(Option<usize>, Vec<u8>)>> {
    let buffer = match json::list(json, "buffers") {
        [] => return Ok(None),
        [buffer] => buffer,
        _ => {
            bail!("a .gltf of several buffers without chamfers cannot be compressed: write a .glb")
        }
    };
    let length = json::required(buffer, "byteLength", "buffers[0]")?;
    let (place, mut bytes) = match (buffer.get("uri").and_then(Value::as_str), binary) {
        (None, Some(binary)) => (None, binary.to_vec()),
        (Some(uri), _) => match uri::target(uri)? {
            uri::Target::Data(bytes) => (None, bytes),
            uri::Target::Inside(path) => {
                let is_it = |file: &crate::OutputFile| file.path.ends_with(&path);
                let place = encoded.files.iter().skip(1).position(is_it).map(|place| place + 1);
                let place = place.context("the buffer stays where it is: nothing to compress")?;
                (Some(place), encoded.files[place].bytes.clone())
            }
            _ => bail!("the buffer lies elsewhere: nothing to compress"),
        },
        _ => bail!("the buffer has no content"),
    };
    ensure!(bytes.len() >= length, "the buffer is cut off");
    bytes.truncate(length);
    Ok(Some((place, bytes)))
}

/// Puts views into a new buffer, compressed where that can be; `None` where none can.
fn pack(json: &mut Value, bytes: &[u8]) -> Result<Option<Vec<u8>>> {
    let mentions = Mentions::of(json);
    ensure!(!mentions.buffers, "an extension refers to bytes of the buffer itself");
    let contents = contents(json, &mentions.numbers)?;
    let (mut packed, mut fallback) = (Vec::new(), 0usize);
    let mut views = json::list(json, "bufferViews").to_vec();
    for (index, (view, content)) in views.iter_mut().zip(contents).enumerate() {
        let path = format!("bufferViews[{index}]");
        let offset = json::optional(view, "byteOffset", &path)?.unwrap_or(0);
        let length = json::required(view, "byteLength", &path)?;
        let raw = offset.checked_add(length).and_then(|end| bytes.get(offset..end));
        let raw = raw.with_context(|| format!("{path} reaches past the end of its buffer"))?;
        packed.resize(packed.len().next_multiple_of(ALIGNMENT), 0);
        let start = packed.len();
        match encode(content, raw, &path) {
            Some((mut extension, encoded)) => {
                extension["buffer"] = 0.into();
                extension["byteOffset"] = start.into();
                extension["byteLength"] = encoded.len().into();
                packed.extend(encoded);
                view["extensions"][NAME] = extension;
                view["buffer"] = 1.into();
                view["byteOffset"] = fallback.into();
                fallback = (fallback + length).next_multiple_of(ALIGNMENT);
            }
            None => {
                packed.extend(raw);
                view["byteOffset"] = start.into();
            }
        }
    }
    if fallback == 0 {
        return Ok(None);
    }
    json["bufferViews"] = views.into();
    json["buffers"][0]["byteLength"] = packed.len().into();
    let stands_in = json!({"byteLength": fallback, "extensions": {NAME: {"fallback": true}}});
    if let Some(buffers) = json["buffers"].as_array_mut() {
        buffers.push(stands_in);
    }
    for key in ["extensionsUsed", "extensionsRequired"] {
        let mut names = json::list(json, key).to_vec();
        names.push(NAME.into());
        json[key] = names.into();
    }
    Ok(Some(packed))
}

/// `#views`: what is in each, as those say who use it.
fn contents(json: &Value, mentioned: &BTreeSet<usize>) -> Result<Vec<Content>> {
    let views = json::list(json, "bufferViews");
    let mut contents: Vec<Option<Content>> = vec![None; views.len()];
    let mut is = |view: Option<usize>, content: Content| {
        let Some(place) = view.and_then(|view| contents.get_mut(view)) else { return };
        *place = Some(match place {
            Some(other) if *other != content => Content::Other,
            _ => content,
        });
    };
    let indices = index_accessors(json);
    for (index, accessor) in json::list(json, "accessors").iter().enumerate() {
        let path = format!("accessors[{index}]");
        let view = json::optional(accessor, "bufferView", &path)?;
        let size = ElementType::of_accessor(accessor, &path)?.size();
        let stride = view.and_then(|view| views.get(view)).and_then(|view| view.get("byteStride"));
        is(
            view,
            match (indices.contains(&index), stride.and_then(json::integer)) {
                (true, None) => Content::Indices(size),
                (true, Some(_)) => Content::Other,
                (false, stride) => Content::Elements(stride.unwrap_or(size)),
            },
        );
        for part in ["indices", "values"] {
            let part = accessor.get("sparse").and_then(|sparse| sparse.get(part));
            is(part.and_then(|p| json::integer(p.get("bufferView")?)), Content::Other);
        }
    }
    for image in json::list(json, "images") {
        is(image.get("bufferView").and_then(json::integer), Content::Other);
    }
    for (index, view) in views.iter().enumerate() {
        if mentioned.contains(&index) || view.get("extensions").is_some() {
            is(Some(index), Content::Other);
        }
    }
    Ok(contents.into_iter().map(|content| content.unwrap_or(Content::Other)).collect())
}

fn index_accessors(json: &Value) -> BTreeSet<usize> {
    let primitives = json::list(json, "meshes").iter().flat_map(|m| json::list(m, "primitives"));
    primitives.filter_map(|primitive| json::integer(primitive.get("indices")?)).collect()
}

/// The extension and the compressed bytes, if they unpack to what is to be compressed.
fn encode(content: Content, raw: &[u8], path: &str) -> Option<(Value, Vec<u8>)> {
    let (mode, stride, encoded) = match content {
        Content::Elements(stride) => ("ATTRIBUTES", stride, elements(raw, stride)?),
        Content::Indices(size) => {
            let numbers: Vec<u32> = match size {
                2 => raw
                    .as_chunks()
                    .0
                    .iter()
                    .map(|bytes| u16::from_le_bytes(*bytes).into())
                    .collect(),
                4 => raw.as_chunks().0.iter().map(|bytes| u32::from_le_bytes(*bytes)).collect(),
                _ => return None,
            };
            let most = numbers.iter().max().map_or(0, |most| *most as usize + 1);
            ("INDICES", size, meshopt::encode_index_sequence(&numbers, most).ok()?)
        }
        Content::Other => return None,
    };
    let count = raw.len() / stride;
    let extension = json!({"byteStride": stride, "count": count, "mode": mode});
    let unpacked = meshopt_views::decode(&extension, &encoded, path).ok()?;
    (unpacked == raw && encoded.len() < raw.len()).then_some((extension, encoded))
}

/// The codec knows the size of an element from its type.
macro_rules! by_stride {
    ($raw:ident, $stride:ident: $($size:literal)*) => {
        match $stride {
            $($size => {
                let (elements, rest) = $raw.as_chunks::<$size>();
                let encoded = meshopt::encode_vertex_buffer_level(elements, LEVEL, Some(VERSION));
                encoded.ok().filter(|_| rest.is_empty())
            })*
            _ => None,
        }
    };
}

fn elements(raw: &[u8], stride: usize) -> Option<Vec<u8>> {
    by_stride!(raw, stride:
        4 8 12 16 20 24 28 32 36 40 44 48 52 56 60 64 68 72 76 80 84 88 92 96 100 104 108 112 116
        120 124 128)
}
