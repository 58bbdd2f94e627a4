//! Where the meshes stand: the nodes of the scene with their global transforms.

use anyhow::{Result, bail, ensure};
use glam::{Mat4, Quat, Vec3};
use serde_json::Value;

use super::json;
use crate::document::Instance;

/// The placed meshes of the default scene, or of all root nodes where the file has no scene; each
/// mesh once at the origin where nothing is placed. A sentence for `notes` where a rule was broken
/// that does not matter.
///
/// # Errors
/// Where the nodes are no forest, or a transform is not finite.
pub fn instances(json: &Value, notes: &mut Vec<String>) -> Result<Vec<Instance>> {
    let parents = parents(json)?;
    refuse_cycles(&parents)?;
    let mut open: Vec<(usize, Mat4)> = roots(json, &parents, notes)?
        .into_iter()
        .rev()
        .map(|root| (root, Mat4::IDENTITY))
        .collect();
    let mut instances = Vec::new();
    while let Some((node, above)) = open.pop() {
        let path = format!("nodes[{node}]");
        let value = json::item(json, "nodes", node)?;
        let global = above * local(value, &path)?;
        ensure!(global.is_finite(), "{path} stands at infinity: repair its transform");
        if let Some(mesh) = json::optional(value, "mesh", &path)? {
            json::item(json, "meshes", mesh)?;
            instances.push(Instance { mesh, transform: global.to_cols_array_2d() });
        }
        open.extend(children(value, &path)?.into_iter().rev().map(|child| (child, global)));
    }
    if instances.is_empty() {
        instances = unplaced(json);
    }
    Ok(instances)
}

fn unplaced(json: &Value) -> Vec<Instance> {
    let transform = Mat4::IDENTITY.to_cols_array_2d();
    (0..json::list(json, "meshes").len()).map(|mesh| Instance { mesh, transform }).collect()
}

fn children(node: &Value, path: &str) -> Result<Vec<usize>> {
    indices(node, "children", path)
}

fn indices(owner: &Value, key: &str, path: &str) -> Result<Vec<usize>> {
    let index = |value| match json::integer(value) {
        Some(index) => Ok(index),
        None => bail!("{path}.{key} holds {value}, not an index"),
    };
    json::list(owner, key).iter().map(index).collect()
}

/// `#nodes`: the parent of each.
fn parents(json: &Value) -> Result<Vec<Option<usize>>> {
    let nodes = json::list(json, "nodes");
    let mut parents = vec![None; nodes.len()];
    for (parent, node) in nodes.iter().enumerate() {
        for child in children(node, &format!("nodes[{parent}]"))? {
            json::item(json, "nodes", child)?;
            if let Some(other) = parents[child].replace(parent) {
                bail!("nodes[{child}] is a child of both nodes[{other}] and nodes[{parent}]");
            }
        }
    }
    Ok(parents)
}

/// With one parent each, nodes form a forest unless a way up never ends.
fn refuse_cycles(parents: &[Option<usize>]) -> Result<()> {
    const UNSEEN: usize = usize::MAX;
    let mut seen_from = vec![UNSEEN; parents.len()];
    for start in 0..parents.len() {
        let mut node = Some(start);
        while let Some(current) = node.filter(|node| seen_from[*node] == UNSEEN) {
            seen_from[current] = start;
            node = parents[current];
        }
        if let Some(repeated) = node.filter(|node| *node != UNSEEN && seen_from[*node] == start) {
            bail!("nodes[{repeated}] is its own ancestor: repair the node tree");
        }
    }
    Ok(())
}

fn roots(json: &Value, parents: &[Option<usize>], notes: &mut Vec<String>) -> Result<Vec<usize>> {
    let scenes = json::list(json, "scenes");
    let scene = json::optional(json, "scene", "the file")?;
    if scenes.is_empty() && scene.is_none() {
        return Ok((0..parents.len()).filter(|node| parents[*node].is_none()).collect());
    }
    let scene = scene.unwrap_or(0);
    let mut roots = indices(json::item(json, "scenes", scene)?, "nodes", "the scene")?;
    let listed = roots.len();
    roots.sort_unstable();
    roots.dedup();
    if listed > roots.len() {
        notes.push(format!("scenes[{scene}] lists a node twice: it was taken once"));
    }
    if let Some(child) = roots.iter().find(|root| parents.get(**root).is_some_and(Option::is_some))
    {
        notes.push(format!(
            "scenes[{scene}] lists nodes[{child}], which is a child of another node: it was taken \
             as a root, unless that node is in the scene too"
        ));
    }
    let listed = roots.clone();
    roots.retain(|root| !has_ancestor_in(&listed, *root, parents));
    Ok(roots)
}

/// Whether a node is reached from one of these, which are sorted. Nodes are a forest.
fn has_ancestor_in(listed: &[usize], node: usize, parents: &[Option<usize>]) -> bool {
    let parent = |node: usize| parents.get(node).copied().flatten();
    let mut above = parent(node);
    while let Some(node) = above {
        if listed.binary_search(&node).is_ok() {
            return true;
        }
        above = parent(node);
    }
    false
}

fn local(node: &Value, path: &str) -> Result<Mat4> {
    if let Some(matrix) = json::floats::<16>(node, "matrix", path)? {
        return Ok(Mat4::from_cols_array(&matrix));
    }
    let translation = json::floats(node, "translation", path)?.unwrap_or([0.0; 3]);
    let rotation = json::floats(node, "rotation", path)?.unwrap_or([0.0, 0.0, 0.0, 1.0]);
    let scale = json::floats(node, "scale", path)?.unwrap_or([1.0; 3]);
    Ok(Mat4::from_scale_rotation_translation(
        Vec3::from(scale),
        Quat::from_array(rotation),
        Vec3::from(translation),
    ))
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    /// Where meshes stand in a file in which all rules are kept.
    fn placed(json: &Value) -> Vec<Instance> {
        let mut notes = Vec::new();
        let instances = instances(json, &mut notes).unwrap();
        assert_eq!(notes, [""; 0]);
        instances
    }

    //  0 - 1 - 2, of which a scene lists some
    #[test]
    fn a_child_in_the_scene_stands_there_once() {
        let json = |listed: Value| {
            json!({
                "meshes": [{}],
                "nodes": [
                    {"children": [1], "translation": [1, 0, 0]},
                    {"children": [2], "translation": [0, 1, 0]},
                    {"mesh": 0, "translation": [0, 0, 1]},
                ],
                "scenes": [{"nodes": listed}],
            })
        };
        let places = |listed: Value| {
            let mut notes = Vec::new();
            let instances = instances(&json(listed), &mut notes).unwrap();
            let places = instances.iter().map(|instance| instance.transform[3]);
            (places.collect::<Vec<_>>(), notes.join(" "))
        };
        let (found, note) = places(json!([1]));
        assert_eq!(found, [[0.0, 1.0, 1.0, 1.0]]);
        assert!(note.starts_with("scenes[0] lists nodes[1], which is a child"), "{note}");
        for listed in [json!([0, 2]), json!([0, 1, 2]), json!([0, 0])] {
            let (found, note) = places(listed);
            assert_eq!(found, [[1.0, 1.0, 1.0, 1.0]]);
            assert!(!note.is_empty());
        }
    }

    #[test]
    fn transforms_accumulate_down_the_tree() {
        let json = json!({
            "meshes": [{}],
            "nodes": [
                {"children": [1], "scale": [2, 2, 2]},
                {"mesh": 0, "matrix": [1,0,0,0, 0,1,0,0, 0,0,1,0, 3,4,5,1]},
            ],
            "scenes": [{"nodes": [0]}],
        });
        let instances = placed(&json);
        assert_eq!(instances.len(), 1);
        assert_eq!(instances[0].transform[3], [6.0, 8.0, 10.0, 1.0]);
    }

    #[test]
    fn only_the_default_scene_is_shown() {
        let json = json!({
            "meshes": [{}, {}],
            "nodes": [{"mesh": 0}, {"mesh": 1}],
            "scenes": [{"nodes": [0]}, {"nodes": [1]}],
            "scene": 1,
        });
        let meshes: Vec<usize> = placed(&json).iter().map(|i| i.mesh).collect();
        assert_eq!(meshes, [1]);
    }

    #[test]
    fn meshes_without_a_node_stand_at_the_origin() {
        let instances = placed(&json!({"meshes": [{}, {}]}));
        assert_eq!(instances.len(), 2);
        assert_eq!(instances[1].transform, Mat4::IDENTITY.to_cols_array_2d());
    }

    #[test]
    fn nodes_that_are_no_forest_are_refused() {
        let cycle = json!({"nodes": [{"children": [1]}, {"children": [0]}, {}]});
        let itself = json!({"nodes": [{}, {"children": [1]}]});
        let shared = json!({"nodes": [{"children": [2]}, {"children": [2]}, {}]});
        let missing = json!({"nodes": [{"children": [7]}]});
        for json in [cycle, itself, shared, missing] {
            assert!(instances(&json, &mut Vec::new()).is_err(), "{json}");
        }
    }

    #[test]
    fn an_infinite_transform_is_refused() {
        assert!(
            instances(&json!({"nodes": [{"translation": [1e39, 0, 0]}]}), &mut Vec::new()).is_err()
        );
    }
}
