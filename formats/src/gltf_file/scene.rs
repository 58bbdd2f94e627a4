//! Where the meshes stand: the nodes of the scene with their global transforms.

use anyhow::{Result, bail, ensure};
use glam::{Mat4, Quat, Vec3};
use serde_json::Value;

use super::json;
use crate::document::Instance;

/// A placed mesh, and the node that places it, if there is one.
pub struct Object {
    pub instance: Instance,
    pub node: Option<usize>,
}

/// The placed meshes of the default scene, or of all root nodes where the file has no scene; each
/// mesh once at the origin where nothing is placed. A sentence for `notes` where a rule was broken
/// that does not matter.
///
/// # Errors
/// Where the nodes are no forest, or a transform is not finite.
pub fn objects(
    json: &Value,
    inverse_bind: &dyn Fn(usize) -> Option<Mat4>,
    notes: &mut Vec<String>,
) -> Result<Vec<Object>> {
    let parents = parents(json)?;
    refuse_cycles(&parents)?;
    let mut open: Vec<(usize, Mat4)> = roots(json, &parents, notes)?
        .into_iter()
        .rev()
        .map(|root| (root, Mat4::IDENTITY))
        .collect();
    let mut objects = Vec::new();
    while let Some((node, above)) = open.pop() {
        let path = format!("nodes[{node}]");
        let value = json::item(json, "nodes", node)?;
        let global = above * local(value, &path)?;
        ensure!(global.is_finite(), "{path} stands at infinity: repair its transform");
        if let Some(mesh) = json::optional(value, "mesh", &path)? {
            json::item(json, "meshes", mesh)?;
            let bound = match json::optional(value, "skin", &path)? {
                Some(skin) => Some(bound(json, skin, &parents, inverse_bind)?),
                None => None,
            };
            let transform = bound.unwrap_or(global).to_cols_array_2d();
            objects.push(Object { instance: Instance { mesh, transform }, node: Some(node) });
        }
        open.extend(children(value, &path)?.into_iter().rev().map(|child| (child, global)));
    }
    if objects.is_empty() {
        objects = unplaced(json);
    }
    Ok(objects)
}

/// `#nodes`: where each stands, whatever scene it is in.
///
/// # Errors
/// As [`objects`].
pub fn globals(json: &Value) -> Result<Vec<Mat4>> {
    let parents = parents(json)?;
    refuse_cycles(&parents)?;
    let roots = (0..parents.len()).filter(|&node| parents[node].is_none());
    let mut open: Vec<(usize, Mat4)> = roots.map(|root| (root, Mat4::IDENTITY)).collect();
    let mut globals = vec![Mat4::IDENTITY; parents.len()];
    while let Some((node, above)) = open.pop() {
        let path = format!("nodes[{node}]");
        let value = json::item(json, "nodes", node)?;
        let global = above * local(value, &path)?;
        globals[node] = global;
        open.extend(children(value, &path)?.into_iter().map(|child| (child, global)));
    }
    Ok(globals)
}

fn unplaced(json: &Value) -> Vec<Object> {
    let transform = Mat4::IDENTITY.to_cols_array_2d();
    let object = |mesh| Object { instance: Instance { mesh, transform }, node: None };
    (0..json::list(json, "meshes").len()).map(object).collect()
}

/// Where the bind pose of a skin stands: with its first joint, as the node of a skinned mesh counts
/// for nothing. At the origin where that cannot be told, or lies flat.
fn bound(
    json: &Value,
    skin: usize,
    parents: &[Option<usize>],
    inverse_bind: &dyn Fn(usize) -> Option<Mat4>,
) -> Result<Mat4> {
    let path = format!("skins[{skin}]");
    let skin = json::item(json, "skins", skin)?;
    let Some(&first) = indices(skin, "joints", &path)?.first() else { return Ok(Mat4::IDENTITY) };
    let mut joint = Some(first);
    let mut global = Mat4::IDENTITY;
    while let Some(node) = joint {
        let path = format!("nodes[{node}]");
        global = local(json::item(json, "nodes", node)?, &path)? * global;
        joint = parents[node];
    }
    let inverse = match json::optional(skin, "inverseBindMatrices", &path)? {
        Some(accessor) => inverse_bind(accessor).unwrap_or(global.inverse()),
        None => Mat4::IDENTITY,
    };
    let bound = global * inverse;
    let is_sound = bound.is_finite() && bound.determinant() != 0.0;
    Ok(if is_sound { bound } else { Mat4::IDENTITY })
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
        let objects = objects(json, &|_| None, &mut notes).unwrap();
        assert_eq!(notes, [""; 0]);
        objects.into_iter().map(|object| object.instance).collect()
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
            let objects = objects(&json(listed), &|_| None, &mut notes).unwrap();
            let places = objects.iter().map(|object| object.instance.transform[3]);
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
            assert!(objects(&json, &|_| None, &mut Vec::new()).is_err(), "{json}");
        }
    }

    #[test]
    fn an_infinite_transform_is_refused() {
        let json = json!({"nodes": [{"translation": [1e39, 0, 0]}]});
        assert!(objects(&json, &|_| None, &mut Vec::new()).is_err());
    }

    // The node is ten times as large, its bones a hundredth.
    #[test]
    fn a_skinned_mesh_stands_with_its_bones() {
        let json = |skin: Value| {
            json!({
                "meshes": [{}],
                "nodes": [
                    {"mesh": 0, "skin": 0, "scale": [10, 10, 10]},
                    {"scale": [0.01, 0.01, 0.01], "children": [2]},
                    {"translation": [0, 500, 0]},
                ],
                "skins": [skin],
            })
        };
        let inverse = |_| Some(Mat4::from_translation(Vec3::new(0.0, -500.0, 0.0)));
        let found = |skin: Value, inverse: &dyn Fn(usize) -> Option<Mat4>| {
            let objects = objects(&json(skin), inverse, &mut Vec::new()).unwrap();
            Mat4::from_cols_array_2d(&objects[0].instance.transform)
        };
        let bound = found(json!({"joints": [2], "inverseBindMatrices": 7}), &inverse);
        assert!(bound.abs_diff_eq(Mat4::from_scale(Vec3::splat(0.01)), 1e-6), "{bound}");
        assert_eq!(found(json!({"joints": []}), &inverse), Mat4::IDENTITY);
        let unread = found(json!({"joints": [2], "inverseBindMatrices": 7}), &|_| None);
        assert!(unread.abs_diff_eq(Mat4::IDENTITY, 1e-6), "{unread}");
    }
}
