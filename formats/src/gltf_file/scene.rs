//! Where the meshes stand: the nodes of the scene with their global transforms.

use anyhow::{Result, bail, ensure};
use glam::{Mat4, Quat, Vec3};
use serde_json::Value;

use super::json;
use crate::document::Instance;

/// The placed meshes of the default scene, or of all root nodes where the file has no scene; each
/// mesh once at the origin where nothing is placed.
///
/// # Errors
/// Where the nodes are no forest, or a transform is not finite.
pub fn instances(json: &Value) -> Result<Vec<Instance>> {
    let parents = parents(json)?;
    refuse_cycles(&parents)?;
    let mut open: Vec<(usize, Mat4)> =
        roots(json, &parents)?.into_iter().rev().map(|root| (root, Mat4::IDENTITY)).collect();
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

fn roots(json: &Value, parents: &[Option<usize>]) -> Result<Vec<usize>> {
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
    ensure!(listed == roots.len(), "scenes[{scene}] lists a node twice");
    if let Some(child) = roots.iter().find(|root| parents.get(**root).is_some_and(Option::is_some))
    {
        bail!("scenes[{scene}] lists nodes[{child}], which is a child of another node");
    }
    Ok(roots)
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
        let instances = instances(&json).unwrap();
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
        let meshes: Vec<usize> = instances(&json).unwrap().iter().map(|i| i.mesh).collect();
        assert_eq!(meshes, [1]);
    }

    #[test]
    fn meshes_without_a_node_stand_at_the_origin() {
        let instances = instances(&json!({"meshes": [{}, {}]})).unwrap();
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
            assert!(instances(&json).is_err(), "{json}");
        }
    }

    #[test]
    fn an_infinite_transform_is_refused() {
        assert!(instances(&json!({"nodes": [{"translation": [1e39, 0, 0]}]})).is_err());
    }
}
