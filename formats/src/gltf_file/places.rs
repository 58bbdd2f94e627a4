//! What stands where, by names that stay the same when a file is written anew.

use std::collections::BTreeMap;

use serde_json::Value;

use super::accessor::Accessors;
use super::budget::Budget;
use super::json;
use super::scene;
use crate::document::Place;

/// Where all nodes stand, and what each bone is bound by.
pub fn places(json: &Value, buffers: &[Vec<u8>]) -> Vec<Place> {
    let names = node_names(json);
    let globals = scene::globals(json).unwrap_or_default();
    let nodes = names.iter().zip(globals).map(|(name, global)| Place {
        name: format!("node {name}"),
        transform: global.to_cols_array_2d(),
    });
    let mut places: Vec<Place> = nodes.collect();
    let budget = Budget::of_file(buffers.iter().map(Vec::len).sum());
    let accessors = Accessors::new(json, buffers, &budget);
    for (number, skin) in json::list(json, "skins").iter().enumerate() {
        let accessor = skin.get("inverseBindMatrices").and_then(json::integer);
        let Some(matrices) = accessor.and_then(|accessor| accessors.read(accessor).ok()) else {
            continue;
        };
        for (joint, matrix) in joints(skin).into_iter().zip(matrices.values.as_chunks::<16>().0) {
            let column = |k: usize| [0, 1, 2, 3].map(|row| matrix[4 * k + row] as f32);
            places.push(Place {
                name: format!("bind pose {number} of {}", name_of(&names, joint)),
                transform: [0, 1, 2, 3].map(column),
            });
        }
    }
    places
}

/// What the joints of a mesh's skin are called; nothing where it has none.
pub fn joint_names(json: &Value, mesh: usize) -> Vec<String> {
    let has_mesh = |node: &&Value| node.get("mesh").and_then(json::integer) == Some(mesh);
    let nodes = json::list(json, "nodes").iter().filter(has_mesh);
    let Some(skin) = nodes.filter_map(|node| json::integer(node.get("skin")?)).next() else {
        return Vec::new();
    };
    let names = node_names(json);
    let skin = json::list(json, "skins").get(skin);
    skin.map(joints).unwrap_or_default().iter().map(|&joint| name_of(&names, joint)).collect()
}

fn joints(skin: &Value) -> Vec<usize> {
    json::list(skin, "joints").iter().filter_map(json::integer).collect()
}

fn name_of(names: &[String], node: usize) -> String {
    names.get(node).cloned().unwrap_or_default()
}

/// `#nodes`: the name of each where no other has it, otherwise its number.
fn node_names(json: &Value) -> Vec<String> {
    let nodes = json::list(json, "nodes");
    let name = |node: &Value| node.get("name").and_then(Value::as_str).map(str::to_owned);
    let mut uses: BTreeMap<String, usize> = BTreeMap::new();
    for name in nodes.iter().filter_map(name) {
        *uses.entry(name).or_default() += 1;
    }
    let own = |(number, node)| {
        let unique = name(node).filter(|name| uses[name] == 1);
        unique.unwrap_or_else(|| format!("#{number}"))
    };
    nodes.iter().enumerate().map(own).collect()
}
