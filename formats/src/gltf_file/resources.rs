//! Files that a model refers to, when the model goes to another folder.
//!
//! Images that are files stay files and keep their URIs, but for those of a .gltf that becomes a
//! .glb: they are copied to the same place beside
//! the output, unless the output stays in the model's folder. A file that is there already with
//! another content is never overwritten.

use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail};
use serde_json::{Value, json};

use super::json;
use super::uri::{self, Target};
use crate::document::OutputFile;
use crate::paths::read_beside;
use crate::pictures::picture_kind;

/// The folder that a file lies in.
pub fn folder(file: &Path) -> PathBuf {
    match file.parent() {
        Some(parent) if parent != Path::new("") => parent.to_owned(),
        _ => PathBuf::from("."),
    }
}

/// Copies of the files that the items of a list (`images`, `buffers`) name, for another folder.
///
/// # Errors
/// Where a file lies above the model's folder, or its place is taken.
pub fn copies(json: &Value, key: &str, from: &Path, to: &Path) -> Result<Vec<OutputFile>> {
    let mut copies: Vec<OutputFile> = Vec::new();
    if is_same_folder(from, to) {
        return Ok(copies);
    }
    for (index, item) in json::list(json, key).iter().enumerate() {
        let Some(uri) = item.get("uri").and_then(Value::as_str) else { continue };
        if uri.starts_with("data:") {
            continue;
        }
        let path = match uri::target(uri)? {
            Target::Inside(path) => path,
            Target::Data(_) | Target::Elsewhere => continue,
            Target::Above => bail!(
                "{key}[{index}] lies above the model's folder ({uri:?}) and would not be found \
                 from another one: write the output beside the model"
            ),
        };
        let (source, place) = (from.join(&path), to.join(&path));
        // The model shows a missing file's absence just as well from its new folder.
        if !source.exists() || copies.iter().any(|copy| copy.path == place) {
            continue;
        }
        let bytes = read_beside(from, &path).with_context(|| source.display().to_string())?;
        copies.push(OutputFile { bytes, path: place });
    }
    Ok(copies)
}

/// Puts images that are files into the buffer: a .glb is one file. What is missing, or no picture
/// that every reader knows, stays outside.
///
/// # Errors
/// Where a file is there but cannot be read.
pub fn embed_images(json: &mut Value, buffer: &mut Vec<u8>, folder: &Path) -> Result<()> {
    for index in 0..json::list(json, "images").len() {
        let uri = json["images"][index].get("uri").and_then(Value::as_str).map(str::to_owned);
        let Some(uri) = uri.filter(|uri| !uri.starts_with("data:")) else { continue };
        let Target::Inside(path) = uri::target(&uri)? else { continue };
        if !folder.join(&path).exists() {
            continue;
        }
        let bytes =
            read_beside(folder, &path).with_context(|| folder.join(&path).display().to_string())?;
        let Some(kind) = picture_kind(&bytes) else { continue };
        buffer.resize(buffer.len().next_multiple_of(4), 0);
        let view = json!({"buffer": 0, "byteOffset": buffer.len(), "byteLength": bytes.len()});
        buffer.extend(bytes);
        let number = push(json, "bufferViews", view);
        if let Some(image) = json["images"][index].as_object_mut() {
            image.shift_remove("uri");
            image.insert("bufferView".into(), number.into());
            image.insert("mimeType".into(), kind.into());
        }
    }
    if !buffer.is_empty() {
        let length = buffer.len().into();
        match json.get_mut("buffers").and_then(|buffers| buffers.get_mut(0)) {
            Some(first) => first["byteLength"] = length,
            None => json["buffers"] = json!([{"byteLength": length}]),
        }
    }
    Ok(())
}

fn push(json: &mut Value, key: &str, item: Value) -> usize {
    if json.get(key).is_none() {
        json[key] = json!([]);
    }
    json[key].as_array_mut().map_or(0, |items| {
        items.push(item);
        items.len() - 1
    })
}

/// Leaves out the copies that are there already.
///
/// # Errors
/// Where one would overwrite a file of other content.
pub fn without_existing(copies: Vec<OutputFile>) -> Result<Vec<OutputFile>> {
    let mut missing = Vec::new();
    for copy in copies {
        match fs::read(&copy.path) {
            Ok(bytes) if bytes == copy.bytes => {}
            Ok(_) => bail!(
                "{} is there already with another content: choose another folder for the output",
                copy.path.display()
            ),
            Err(_) => missing.push(copy),
        }
    }
    Ok(missing)
}

fn is_same_folder(a: &Path, b: &Path) -> bool {
    match (a.canonicalize(), b.canonicalize()) {
        (Ok(a), Ok(b)) => a == b,
        _ => a == b,
    }
}
