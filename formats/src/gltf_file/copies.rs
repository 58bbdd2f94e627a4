//! Copies of meshes, for objects that are to have one of their own. They stand behind the meshes of
//! the file, so that whatever else names a mesh by its number still names the same.

use serde_json::Value;

use super::scene::Object;

/// Adds a copy of a mesh, with all that the file says of it.
pub fn add(json: &mut Value, mesh: usize) {
    if let Some(meshes) = json.get_mut("meshes").and_then(Value::as_array_mut) {
        meshes.push(meshes[mesh].clone());
    }
}

/// Gives the node of an object another mesh.
pub fn set_mesh(json: &mut Value, object: &Object, mesh: usize) {
    let node = object.node.and_then(|node| json.get_mut("nodes")?.get_mut(node));
    if let Some(node) = node {
        node["mesh"] = mesh.into();
    }
}

/// `#meshes`: the number of each in the file that is written. A copy that is no other than its
/// original is none.
///
/// `copied`: `#meshes`, those of the file, then copies: the mesh that each is like.
pub fn numbers(copied: &[usize], is_changed: &[bool]) -> Vec<usize> {
    let originals = copied.iter().enumerate().take_while(|(mesh, of)| mesh == *of).count();
    let mut next = originals;
    let number = |(mesh, &of): (usize, &usize)| {
        if mesh < originals || !(is_changed[mesh] || is_changed[of]) {
            return of;
        }
        next += 1;
        next - 1
    };
    copied.iter().enumerate().map(number).collect()
}

/// The file with its meshes under these numbers; several of one number are one.
pub fn without_needless(json: &Value, objects: &[Object], numbers: &[usize]) -> Value {
    let mut written = json.clone();
    if numbers.iter().enumerate().all(|(mesh, number)| mesh == *number) {
        return written;
    }
    if let Some(meshes) = written.get_mut("meshes").and_then(Value::as_array_mut) {
        let mut last = None;
        let mut number = numbers.iter();
        // Those that stay come in the order of their numbers.
        meshes.retain(|_| {
            let number = number.next().copied();
            let is_new = number > last;
            last = last.max(number);
            is_new
        });
    }
    for object in objects {
        set_mesh(&mut written, object, numbers[object.instance.mesh]);
    }
    written
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document::{IDENTITY, Instance};
    use serde_json::json;

    #[test]
    fn copies_that_are_their_originals_are_left_out() {
        let copied = [0, 1, 0, 1, 0];
        assert_eq!(numbers(&copied, &[true; 5]), [0, 1, 2, 3, 4]);
        assert_eq!(numbers(&copied, &[false, true, false, true, false]), [0, 1, 0, 2, 0]);
        assert_eq!(numbers(&copied, &[false, false, false, false, true]), [0, 1, 0, 1, 2]);
        let names = ["a", "b", "a", "b", "a"].map(|name| json!({"name": name}));
        let json = json!({
            "meshes": names,
            "nodes": [{"mesh": 0}, {"mesh": 2}, {"mesh": 3}, {"name": "bone"}],
        });
        let object = |node, mesh| Object {
            instance: Instance { mesh, transform: IDENTITY },
            node: Some(node),
        };
        let objects = [object(0, 0), object(1, 2), object(2, 3)];
        let written = without_needless(&json, &objects, &[0, 1, 0, 2, 0]);
        assert_eq!(written["meshes"], json!([{"name": "a"}, {"name": "b"}, {"name": "b"}]));
        let nodes = json!([{"mesh": 0}, {"mesh": 0}, {"mesh": 2}, {"name": "bone"}]);
        assert_eq!(written["nodes"], nodes);
    }
}
