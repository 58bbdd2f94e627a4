//! Files that a model refers to, when the model goes to another folder.
//!
//! Images that are files stay files and keep their URIs: they are copied to the same place beside
//! the output, unless the output stays in the model's folder. A file that is there already with
//! another content is never overwritten.

use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail};
use serde_json::Value;

use super::json;
use super::uri::{self, Target};
use crate::document::OutputFile;
use crate::paths::read_beside;

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
