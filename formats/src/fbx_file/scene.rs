//! The nodes of an FBX scene, and all that hangs on them, as a glTF.

use std::path::Path;

use anyhow::Result;
use serde_json::{Value, json};
use ufbx::{Node, Scene};

use crate::gltf_file::write_glb;
use crate::parts::Parts;

use super::materials::Materials;
use super::mesh::{Extras, write_mesh};
use super::nodes::node_number;
use super::skin;

/// A scene as a .glb, and what did not go along.
pub struct Converted {
    pub glb: Vec<u8>,
    pub notes: Vec<String>,
}

/// Converts a scene; pictures that it names are looked for in a folder.
///
/// # Errors
/// Where a mesh makes no sense, or the result would be larger than a .glb can be.
pub fn convert(scene: &Scene, folder: &Path) -> Result<Converted> {
    let mut parts = Parts::default();
    let mut notes = left_out(scene);
    let Materials { materials, textures, images } =
        Materials::of(scene, folder, &mut parts, &mut notes);
    let mut extras = Extras::default();
    let mut meshes = Vec::new();
    let mut mesh_of = vec![None; scene.meshes.len()];
    for (number, mesh) in scene.meshes.iter().enumerate() {
        if let Some(value) = write_mesh(mesh, &mut parts, &mut extras)? {
            mesh_of[number] = Some(meshes.len());
            meshes.push(value);
        }
    }
    notes.extend(extras.notes());
    let skins: Vec<Value> =
        scene.skin_deformers.iter().map(|skin| skin::write_skin(skin, &mut parts)).collect();
    let node = |node: &Node| write_node(node, &mesh_of, &skins);
    let mut root = json!({
        "asset": {"version": "2.0", "generator": "chamfer"},
        "scene": 0,
        "scenes": [{"nodes": children(&scene.root_node)}],
    });
    let lists = [
        ("nodes", scene.nodes.iter().skip(1).map(|other| node(other)).collect()),
        ("meshes", meshes),
        ("skins", skins.clone()),
        ("materials", materials),
        ("textures", textures),
        ("images", images),
        ("accessors", parts.accessors),
        ("bufferViews", parts.views),
    ];
    for (key, items) in lists.into_iter().filter(|(_, items): &(_, Vec<Value>)| !items.is_empty()) {
        root[key] = items.into();
    }
    if root["scenes"][0]["nodes"].as_array().is_some_and(Vec::is_empty) {
        root["scenes"] = json!([{}]);
    }
    if !parts.binary.is_empty() {
        root["buffers"] = json!([{"byteLength": parts.binary.len()}]);
    }
    Ok(Converted { glb: write_glb(&serde_json::to_vec(&root)?, &parts.binary, &[])?, notes })
}

fn children(node: &Node) -> Vec<u32> {
    node.children.iter().filter_map(|child| node_number(child)).collect()
}

fn write_node(node: &Node, mesh_of: &[Option<usize>], skins: &[Value]) -> Value {
    let transform = &node.local_transform;
    let [t, s] = [transform.translation, transform.scale];
    let r = transform.rotation;
    let mut value = json!({"name": &*node.element.name});
    let mut set = |key: &str, numbers: &[f64], usual: &[f64]| {
        if numbers != usual {
            value[key] = numbers.iter().map(|number| *number as f32).collect::<Vec<f32>>().into();
        }
    };
    set("translation", &[t.x, t.y, t.z], &[0.0; 3]);
    set("rotation", &[r.x, r.y, r.z, r.w], &[0.0, 0.0, 0.0, 1.0]);
    set("scale", &[s.x, s.y, s.z], &[1.0; 3]);
    if !node.children.is_empty() {
        value["children"] = children(node).into();
    }
    let mesh = node.mesh.as_ref();
    if let Some(number) = mesh.and_then(|mesh| mesh_of[mesh.element.typed_id as usize]) {
        value["mesh"] = number.into();
        let skin = mesh.and_then(|mesh| mesh.skin_deformers.first());
        let skin = skin.map(|skin| skin.element.typed_id as usize);
        if let Some(skin) = skin.filter(|skin| !skins[*skin]["joints"].is_null()) {
            value["skin"] = skin.into();
        }
    }
    value
}

/// What a .glb of chamfered meshes is without.
fn left_out(scene: &Scene) -> Vec<String> {
    let counts = [
        ("animations", scene.anim_stacks.len()),
        ("lights", scene.lights.len()),
        ("cameras", scene.cameras.len()),
        (
            "curves and NURBS",
            scene.line_curves.len() + scene.nurbs_curves.len() + scene.nurbs_surfaces.len(),
        ),
        ("constraints", scene.constraints.len()),
        ("geometry caches", scene.cache_deformers.len()),
    ];
    let counts = counts.into_iter().filter(|(_, count)| *count > 0);
    let found: Vec<String> = counts.map(|(what, count)| format!("{what} ({count})")).collect();
    if found.is_empty() {
        return Vec::new();
    }
    vec![format!("of an FBX these do not go along: {}", found.join(", "))]
}
