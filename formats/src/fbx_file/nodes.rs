//! The numbers of nodes.

use ufbx::Node;

/// The number that a node has in the glTF: the root of the scene, which is the first, has none.
pub fn node_number(node: &Node) -> Option<u32> {
    node.element.typed_id.checked_sub(1)
}
