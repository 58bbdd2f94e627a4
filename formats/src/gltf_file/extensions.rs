//! What extensions mean for the geometry: some make it unreadable, any may refer to parts of it.

use std::collections::BTreeSet;

use anyhow::{Result, bail, ensure};
use serde_json::Value;

use super::element::{Component, ElementType};
use super::json;

/// Required extensions that may sit on geometry without changing how it is read.
const HARMLESS_ON_GEOMETRY: [&str; 4] = [
    "KHR_materials_variants",
    "KHR_mesh_quantization",
    "EXT_mesh_features",
    "EXT_structural_metadata",
];

/// Extensions, by the start of their names, whose numbers are no indices of accessors, buffer
/// views or buffers.
const WITHOUT_DATA_REFERENCES: [&str; 6] = [
    "KHR_materials_",
    "KHR_texture_",
    "EXT_texture_",
    "KHR_lights_punctual",
    "KHR_animation_pointer",
    "KHR_node_visibility",
];

const RESTART: &str = "KHR_mesh_primitive_restart";
const QUANTIZATION: &str = "KHR_mesh_quantization";

/// Refuses files whose geometry cannot be read without an extension that is not known here.
pub fn refuse_unreadable(json: &Value) -> Result<()> {
    let required: Vec<&str> =
        json::list(json, "extensionsRequired").iter().filter_map(Value::as_str).collect();
    for extension in required {
        ensure!(
            HARMLESS_ON_GEOMETRY.contains(&extension) || !on_geometry(json, extension),
            "the geometry needs the extension {extension}, which is not known here: \
             export the model without it"
        );
    }
    Ok(())
}

/// Whether an extension sits on a primitive, or on the data that primitives are read from.
fn on_geometry(json: &Value, extension: &str) -> bool {
    let has = |owner: &Value| owner.get("extensions").is_some_and(|e| e.get(extension).is_some());
    let primitives = json::list(json, "meshes").iter().flat_map(|m| json::list(m, "primitives"));
    let data = ["accessors", "bufferViews", "buffers"];
    primitives.chain(data.iter().flat_map(|key| json::list(json, key))).any(has)
}

/// What extensions may refer to, known or not.
#[derive(Debug, Default, PartialEq)]
pub struct Mentions {
    /// Every whole number in them: each may be the index of an accessor or a buffer view.
    pub numbers: BTreeSet<usize>,
    /// Whether one speaks of a buffer itself, so that bytes may be used without a view on them.
    pub buffers: bool,
}

impl Mentions {
    /// Collects the mentions of all extensions in a file.
    pub fn of(json: &Value) -> Mentions {
        let mut mentions = Mentions::default();
        mentions.search(json);
        mentions
    }

    fn search(&mut self, value: &Value) {
        match value {
            Value::Array(items) => items.iter().for_each(|item| self.search(item)),
            Value::Object(fields) => fields.iter().for_each(|(key, field)| match key.as_str() {
                "extensions" => self.search_extensions(field),
                "extras" => {}
                _ => self.search(field),
            }),
            _ => {}
        }
    }

    fn search_extensions(&mut self, extensions: &Value) {
        let Some(extensions) = extensions.as_object() else { return };
        for (name, extension) in extensions {
            if !WITHOUT_DATA_REFERENCES.iter().any(|start| name.starts_with(start)) {
                self.collect(extension);
            }
        }
    }

    fn collect(&mut self, value: &Value) {
        match value {
            Value::Array(items) => items.iter().for_each(|item| self.collect(item)),
            Value::Object(fields) => {
                self.buffers |= fields.contains_key("buffer");
                fields.values().for_each(|field| self.collect(field));
            }
            Value::Number(_) => self.numbers.extend(json::integer(value)),
            _ => {}
        }
    }
}

/// Takes `KHR_mesh_quantization` off the lists of extensions if no primitive needs it any longer.
pub fn drop_unneeded_quantization(json: &mut Value) -> Result<()> {
    if needs_quantization(json)? {
        return Ok(());
    }
    drop_names(json, &[QUANTIZATION]);
    Ok(())
}

/// Takes `KHR_mesh_primitive_restart` off the lists where all primitives are points or whole
/// triangles, which is what chamfered ones become.
pub fn drop_unneeded_restart(json: &mut Value) {
    let primitives = json::list(json, "meshes").iter().flat_map(|m| json::list(m, "primitives"));
    let mode = |primitive: &Value| primitive.get("mode").map_or(Some(4), json::integer);
    if primitives.map(mode).all(|mode| matches!(mode, Some(0 | 4))) {
        drop_names(json, &[RESTART]);
    }
}

/// Takes extensions off the lists of those that the file uses.
pub fn drop_names(json: &mut Value, dropped: &[&str]) {
    for key in ["extensionsUsed", "extensionsRequired"] {
        let Some(names) = json.get_mut(key).and_then(Value::as_array_mut) else { continue };
        names.retain(|name| !name.as_str().is_some_and(|name| dropped.contains(&name)));
        // glTF allows no empty arrays.
        if names.is_empty() {
            json.as_object_mut().and_then(|fields| fields.shift_remove(key));
        }
    }
}

/// Whether a primitive has an attribute in a type that only `KHR_mesh_quantization` allows.
pub fn needs_quantization(json: &Value) -> Result<bool> {
    let primitives = json::list(json, "meshes").iter().flat_map(|m| json::list(m, "primitives"));
    for primitive in primitives {
        let targets = json::list(primitive, "targets").iter().map(|target| (target, true));
        let base = primitive.get("attributes").map(|attributes| (attributes, false));
        for (attributes, is_target) in targets.chain(base) {
            for (name, accessor) in json::named_indices(attributes, "attributes")? {
                let value = json::item(json, "accessors", accessor)?;
                let element = ElementType::of_accessor(value, &format!("accessors[{accessor}]"))?;
                if is_quantized(&name, element, is_target) {
                    return Ok(true);
                }
            }
        }
    }
    Ok(false)
}

fn is_quantized(name: &str, element: ElementType, is_target: bool) -> bool {
    if element.component == Component::F32 {
        return false;
    }
    let unsigned = matches!(element.component, Component::U8 | Component::U16);
    match name {
        "POSITION" | "NORMAL" | "TANGENT" => true,
        _ if name.starts_with("TEXCOORD_") => !element.normalized || !(unsigned || is_target),
        _ => false,
    }
}

/// Fails where the file is not glTF 2.
pub fn refuse_other_versions(json: &Value) -> Result<()> {
    let asset = json.get("asset");
    let version = asset.and_then(|a| a.get("version")).and_then(Value::as_str).unwrap_or("absent");
    if version.split('.').next() != Some("2") {
        bail!("asset.version is {version}: only glTF 2 can be read");
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn an_unknown_required_extension_is_refused_on_geometry_only() {
        let on = |place: &str| {
            let carrier = json!([{"extensions": {"ACME_packed": {}}}]);
            json!({"extensionsRequired": ["ACME_packed"], place: carrier})
        };
        assert!(refuse_unreadable(&on("accessors")).is_err());
        assert!(refuse_unreadable(&on("materials")).is_ok());
    }

    #[test]
    fn whole_numbers_in_extensions_are_mentions() {
        let json = json!({
            "nodes": [{"mesh": 9, "extensions": {"ACME_a": {"x": [3, 0.5], "y": {"view": 4}}}}],
            "materials": [{"extensions": {"KHR_materials_sheen": {"n": 7}}}],
        });
        let mentions = Mentions::of(&json);
        assert_eq!(mentions, Mentions { numbers: BTreeSet::from([3, 4]), buffers: false });
    }

    #[test]
    fn quantization_is_dropped_with_its_last_use() {
        let json = |component: u32| {
            json!({
                "extensionsUsed": ["KHR_mesh_quantization", "ACME_a"],
                "extensionsRequired": ["KHR_mesh_quantization"],
                "accessors": [{"componentType": component, "type": "VEC3", "count": 1}],
                "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
            })
        };
        let mut quantized = json(5122);
        drop_unneeded_quantization(&mut quantized).unwrap();
        assert_eq!(quantized, json(5122));
        let mut floats = json(5126);
        drop_unneeded_quantization(&mut floats).unwrap();
        assert_eq!(floats["extensionsUsed"], json!(["ACME_a"]));
        assert_eq!(floats.get("extensionsRequired"), None);
    }
}
