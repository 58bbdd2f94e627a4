//! Who refers to accessors and buffer views: what only the replaced primitives use can go.

use std::collections::BTreeSet;

use anyhow::Result;
use serde_json::Value;

use super::extensions::Mentions;
use super::json;

/// A primitive that gets new accessors.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Replaced {
    pub mesh: usize,
    pub primitive: usize,
    /// Whether its tangents are dropped rather than replaced.
    pub drops_tangents: bool,
}

/// What nothing will refer to once the primitives are replaced.
#[derive(Debug, Default, PartialEq)]
pub struct Freed {
    pub accessors: BTreeSet<usize>,
    pub views: BTreeSet<usize>,
}

/// Finds what only the replaced primitives use.
///
/// # Errors
/// Where a reference is no index.
pub fn freed(json: &Value, replaced: &BTreeSet<Replaced>, mentions: &Mentions) -> Result<Freed> {
    let mut old = BTreeSet::new();
    let mut kept = mentions.numbers.clone();
    for (mesh, value) in json::list(json, "meshes").iter().enumerate() {
        for (primitive, value) in json::list(value, "primitives").iter().enumerate() {
            let place = |drops_tangents| Replaced { mesh, primitive, drops_tangents };
            let drops_tangents = replaced.contains(&place(true));
            let is_replaced = drops_tangents || replaced.contains(&place(false));
            for (name, accessor) in primitive_references(value)? {
                // A dropped accessor has no successor that could take its number.
                let freed = is_replaced && !(drops_tangents && name == "TANGENT");
                if freed {
                    old.insert(accessor)
                } else {
                    kept.insert(accessor)
                };
            }
        }
    }
    kept.extend(other_references(json));
    let accessors: BTreeSet<usize> = old.difference(&kept).copied().collect();
    let views = freed_views(json, &accessors, mentions)?;
    Ok(Freed { accessors, views })
}

fn primitive_references(primitive: &Value) -> Result<Vec<(String, usize)>> {
    let mut references = Vec::new();
    for set in primitive.get("attributes").into_iter().chain(json::list(primitive, "targets")) {
        references.extend(json::named_indices(set, "attributes")?);
    }
    let indices = json::optional(primitive, "indices", "a primitive")?;
    references.extend(indices.map(|accessor| ("indices".to_owned(), accessor)));
    Ok(references)
}

/// The accessors of animations and skins.
fn other_references(json: &Value) -> impl Iterator<Item = usize> {
    let samplers = json::list(json, "animations").iter().flat_map(|a| json::list(a, "samplers"));
    let of_samplers = samplers.flat_map(|sampler| [sampler.get("input"), sampler.get("output")]);
    let of_skins = json::list(json, "skins").iter().map(|skin| skin.get("inverseBindMatrices"));
    of_samplers.chain(of_skins).flatten().filter_map(json::integer)
}

fn freed_views(
    json: &Value,
    accessors: &BTreeSet<usize>,
    mentions: &Mentions,
) -> Result<BTreeSet<usize>> {
    let mut old = BTreeSet::new();
    let mut kept = mentions.numbers.clone();
    for (index, accessor) in json::list(json, "accessors").iter().enumerate() {
        let views = if accessors.contains(&index) { &mut old } else { &mut kept };
        views.extend(view_references(accessor)?);
    }
    for image in json::list(json, "images") {
        kept.extend(json::optional(image, "bufferView", "an image")?);
    }
    Ok(old.difference(&kept).copied().collect())
}

fn view_references(accessor: &Value) -> Result<Vec<usize>> {
    let mut references = Vec::new();
    references.extend(json::optional(accessor, "bufferView", "an accessor")?);
    let sparse = accessor.get("sparse");
    for part in ["indices", "values"] {
        let Some(part) = sparse.and_then(|sparse| sparse.get(part)) else { continue };
        references.extend(json::optional(part, "bufferView", "a sparse accessor")?);
    }
    Ok(references)
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn what_others_use_is_kept() {
        let json = json!({
            "accessors": [
                {"bufferView": 0}, {"bufferView": 1}, {"bufferView": 2},
                {"sparse": {"indices": {"bufferView": 3}, "values": {"bufferView": 4}}},
                {"bufferView": 5}, {"bufferView": 2},
            ],
            "meshes": [
                {"primitives": [
                    {"attributes": {"POSITION": 0, "NORMAL": 1}, "targets": [{"POSITION": 3}], "indices": 2},
                    {"attributes": {"POSITION": 1}},
                ]},
            ],
            "animations": [{"samplers": [{"input": 4, "output": 5}]}],
            "images": [{"bufferView": 4}],
        });
        let first = Replaced { mesh: 0, primitive: 0, drops_tangents: false };
        let freed = freed(&json, &BTreeSet::from([first]), &Mentions::default()).unwrap();
        assert_eq!(freed.accessors, BTreeSet::from([0, 2, 3]));
        assert_eq!(freed.views, BTreeSet::from([0, 3]));
    }

    #[test]
    fn what_an_extension_may_mean_is_kept() {
        let json = json!({
            "accessors": [{"bufferView": 0}, {"bufferView": 1}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        });
        let replaced = Replaced { mesh: 0, primitive: 0, drops_tangents: false };
        let mentions = Mentions { numbers: BTreeSet::from([1]), buffers: false };
        let freed = freed(&json, &BTreeSet::from([replaced]), &mentions).unwrap();
        assert_eq!(freed.accessors, BTreeSet::from([0]));
        assert_eq!(freed.views, BTreeSet::from([0]));
    }
}
