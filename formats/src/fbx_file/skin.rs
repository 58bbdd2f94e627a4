//! Skins: which bones pull which vertices, and where the bones were when they were bound.

use serde_json::{Value, json};
use ufbx::{SkinCluster, SkinDeformer};

use crate::parts::Parts;

use super::nodes::node_number;

/// Influences of a set, and sets at most: engines read no more.
const SET_SIZE: usize = 4;
const MOST_SETS: usize = 2;

/// Joints and weights, each `#vertices by 4`.
type Set = (Vec<[u16; 4]>, Vec<[f32; 4]>);

/// The clusters that have a bone, in their order.
fn bound(skin: &SkinDeformer) -> impl Iterator<Item = (usize, u32, &SkinCluster)> {
    let bone =
        |cluster: &SkinCluster| cluster.bone_node.as_ref().and_then(|node| node_number(node));
    let clusters = skin.clusters.iter().enumerate();
    clusters.filter_map(move |(number, cluster)| Some((number, bone(cluster)?, &**cluster)))
}

/// The skin as glTF has it; without joints where it has no bone.
pub fn write_skin(skin: &SkinDeformer, parts: &mut Parts) -> Value {
    let joints: Vec<u32> = bound(skin).map(|(_, bone, _)| bone).collect();
    if joints.is_empty() {
        return json!({});
    }
    let matrices: Vec<[f32; 16]> = bound(skin)
        .map(|(_, _, cluster)| {
            let m = &cluster.geometry_to_bone;
            [
                m.m00, m.m10, m.m20, 0.0, m.m01, m.m11, m.m21, 0.0, m.m02, m.m12, m.m22, 0.0,
                m.m03, m.m13, m.m23, 1.0,
            ]
            .map(|number| number as f32)
        })
        .collect();
    json!({"joints": joints, "inverseBindMatrices": parts.matrices(&matrices)})
}

/// The influences of each vertex, in as many sets as it takes; `cut` counts vertices that have
/// more than there is room for. Vertices are told by the numbers of their positions.
pub fn influences(skin: &SkinDeformer, vertices: &[u32], cut: &mut usize) -> Vec<Set> {
    let mut joint_of = vec![None; skin.clusters.len()];
    for (joint, (cluster, _, _)) in bound(skin).enumerate() {
        joint_of[cluster] = u16::try_from(joint).ok();
    }
    let most = MOST_SETS * SET_SIZE;
    let all: Vec<Vec<(u16, f32)>> = vertices
        .iter()
        .map(|&vertex| {
            let mut found = of_vertex(skin, vertex, &joint_of);
            *cut += usize::from(found.len() > most);
            found.truncate(most);
            let sum: f32 = found.iter().map(|(_, weight)| weight).sum();
            found.iter_mut().for_each(|(_, weight)| *weight /= sum);
            // A vertex that nothing pulls goes along with the first bone.
            if found.is_empty() { vec![(0, 1.0)] } else { found }
        })
        .collect();
    let sets = all.iter().map(Vec::len).max().unwrap_or(0).div_ceil(SET_SIZE);
    (0..sets)
        .map(|set| {
            let at = |found: &[(u16, f32)], place: usize| {
                found.get(set * SET_SIZE + place).copied().unwrap_or((0, 0.0))
            };
            let places = [0, 1, 2, 3];
            let joints = all.iter().map(|found| places.map(|place| at(found, place).0));
            let weights = all.iter().map(|found| places.map(|place| at(found, place).1));
            (joints.collect(), weights.collect())
        })
        .collect()
}

/// The influences of a vertex, the strongest first.
fn of_vertex(skin: &SkinDeformer, vertex: u32, joint_of: &[Option<u16>]) -> Vec<(u16, f32)> {
    let Some(own) = skin.vertices.get(vertex as usize) else { return Vec::new() };
    let range = own.weight_begin as usize..(own.weight_begin + own.num_weights) as usize;
    let weights = skin.weights.get(range).unwrap_or_default().iter();
    let influence = |weight: &ufbx::SkinWeight| {
        let joint = joint_of.get(weight.cluster_index as usize).copied().flatten()?;
        Some((joint, weight.weight as f32)).filter(|(_, weight)| *weight > 0.0)
    };
    let mut found: Vec<(u16, f32)> = weights.filter_map(influence).collect();
    found.sort_by(|(a, heavy), (b, light)| light.total_cmp(heavy).then(a.cmp(b)));
    found
}
