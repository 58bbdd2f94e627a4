//! Buffer files beside .gltf files: whose they are, and what they are called.

use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use serde_json::Value;

use super::json;
use super::resources;
use super::uri::{self, Target};
use crate::paths::identity;

/// Why a file may not be replaced together with the .gltf at `model`: it is a buffer of another
/// one, or not of this one. None where it is a buffer of this one alone.
pub fn why_kept(buffer: &Path, model: &Path) -> Option<String> {
    if !refers(model, buffer) {
        return Some(format!("is no buffer of {}", model.display()));
    }
    let (own, place) = (identity(model), resources::folder(model));
    // A model above may name what is in a folder below it.
    let mut folders = vec![resources::folder(buffer), place];
    folders.dedup();
    let mut models = folders.iter().flat_map(|folder| models_in(folder));
    let other = models.find(|other| identity(other) != own && refers(other, buffer))?;
    Some(format!("is a buffer of {} too", other.display()))
}

fn models_in(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    let mut models: Vec<PathBuf> = entries.map(|entry| entry.path()).collect();
    models.retain(|path| path.extension().is_some_and(|end| end.eq_ignore_ascii_case("gltf")));
    models.sort();
    models
}

/// Whether a .gltf names a file as a buffer.
fn refers(model: &Path, buffer: &Path) -> bool {
    let Some(json) = fs::read(model).ok().and_then(|bytes| parse(&bytes).ok()) else {
        return false;
    };
    let folder = resources::folder(model);
    let wanted = identity(buffer);
    let mut buffers = json::list(&json, "buffers").iter();
    buffers.any(|item| place(item, &folder).is_some_and(|place| identity(&place) == wanted))
}

fn parse(bytes: &[u8]) -> Result<Value> {
    let text = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes);
    serde_json::from_slice(text).context("the JSON cannot be read")
}

/// Where the file of a buffer lies.
fn place(buffer: &Value, folder: &Path) -> Option<PathBuf> {
    let uri = buffer.get("uri")?.as_str()?;
    match uri::target(uri).ok()? {
        Target::Inside(path) => Some(folder.join(path)),
        _ => None,
    }
}

/// The .gltf that goes to `model` with other files for some of its buffers, in their folders.
///
/// # Errors
/// Where it is no JSON, or a name is not UTF-8.
pub fn renamed(gltf: &[u8], model: &Path, names: &[(&Path, PathBuf)]) -> Result<Vec<u8>> {
    let mut json = parse(gltf)?;
    let folder = resources::folder(model);
    for item in json.get_mut("buffers").and_then(Value::as_array_mut).into_iter().flatten() {
        let Some(old) = place(item, &folder) else { continue };
        let Some((_, new)) = names.iter().find(|(from, _)| identity(from) == identity(&old)) else {
            continue;
        };
        let name = new.file_name().and_then(|name| name.to_str());
        let name = uri::write_name(name.context("a buffer's name is not UTF-8")?);
        let uri = item["uri"].as_str().unwrap_or_default();
        let above = uri.rfind(['/', '\\']).map_or("", |at| &uri[..=at]);
        item["uri"] = format!("{above}{name}").into();
    }
    Ok(serde_json::to_vec_pretty(&json)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn folder() -> tempfile::TempDir {
        let folder = tempfile::tempdir().unwrap();
        let write = |name: &str, uri: &str| {
            let json = serde_json::json!({"buffers": [{"uri": uri}, {"uri": "data:,x"}]});
            fs::write(folder.path().join(name), json.to_string()).unwrap();
        };
        fs::create_dir(folder.path().join("b")).unwrap();
        write("a.gltf", "b/own%20one.bin");
        write("b/c.gltf", "shared.bin");
        write("d.GLTF", "b/shared.bin");
        fs::write(folder.path().join("b/broken.gltf"), "{").unwrap();
        folder
    }

    #[test]
    fn a_buffer_is_replaced_only_by_the_one_that_has_it() {
        let folder = folder();
        let why = |buffer: &str, model: &str| {
            why_kept(&folder.path().join(buffer), &folder.path().join(model))
        };
        assert_eq!(why("b/own one.bin", "a.gltf"), None);
        assert!(why("b/own one.bin", "new.gltf").unwrap().starts_with("is no buffer of "));
        assert!(why("b/shared.bin", "d.GLTF").unwrap().ends_with("c.gltf too"));
    }

    #[test]
    fn buffers_get_other_names_in_their_folders() {
        let folder = folder();
        let model = folder.path().join("a.gltf");
        let from = folder.path().join("b/own one.bin");
        let names = [(&*from, folder.path().join("b/own one.new.bin"))];
        let json = parse(&renamed(&fs::read(&model).unwrap(), &model, &names).unwrap()).unwrap();
        assert_eq!(json["buffers"][0]["uri"], "b/own%20one.new.bin");
        assert_eq!(json["buffers"][1]["uri"], "data:,x");
    }
}
