//! What vertices have beside what the core carries: skins, morph targets, further colours and
//! numbers.

use std::collections::{BTreeMap, BTreeSet};

use super::geometry::MeshGeometry;
use super::names::is_carried_by_core;
use crate::document::{Further, StreamKind, VertexStream};

/// A skin is told as a weight of each joint for each vertex: at most so many, or half a gigabyte.
const MOST_WEIGHTS: usize = 1 << 27;

/// Of all vertices of a mesh; `joint_names: #joints` of its skin.
pub fn further(geometry: &MeshGeometry, count: usize, joint_names: &[String]) -> Further {
    let mut further = Further::default();
    add_skin(geometry, count, joint_names, &mut further);
    for (target, name) in target_names(geometry) {
        if name == "TANGENT" {
            let reason = "they go with the texture, and turn along with the vertex's own";
            further.left_out.push(("tangents of morph targets", reason));
            continue;
        }
        further.streams.push(VertexStream {
            kind: StreamKind::Morph,
            name: format!("{target} {name}"),
            components: 3,
            values: values(geometry, count, Some(target), &name, 3),
        });
    }
    add_others(geometry, count, &mut further);
    further
}

/// One stream for each joint that pulls anything.
fn add_skin(geometry: &MeshGeometry, count: usize, names: &[String], further: &mut Further) {
    let sets = geometry.blocks.iter().map(|block| block.skin_sets()).max().unwrap_or(0);
    let mut columns: BTreeMap<u32, Vec<f32>> = BTreeMap::new();
    for set in 0..sets {
        let [joints, weights] =
            ["JOINTS", "WEIGHTS"].map(|kind| geometry.streams(None, &format!("{kind}_{set}")));
        for vertex in 0..count {
            let pair = joints.at(vertex).zip(weights.at(vertex));
            for (joint, weight) in pair.into_iter().flat_map(|(j, w)| j.iter().zip(w)) {
                if *weight == 0.0 {
                    continue;
                }
                if (columns.len() + 1).saturating_mul(count) > MOST_WEIGHTS {
                    further.left_out.push(("skin", "it has too many joints"));
                    return;
                }
                let column = columns.entry(*joint as u32).or_insert_with(|| vec![0.0; count]);
                column[vertex] += *weight as f32;
            }
        }
    }
    let name = |joint: u32| names.get(joint as usize).cloned().unwrap_or(format!("joint {joint}"));
    further.streams.extend(columns.into_iter().map(|(joint, values)| VertexStream {
        kind: StreamKind::Skin,
        name: name(joint),
        components: 1,
        values,
    }));
}

fn target_names(geometry: &MeshGeometry) -> BTreeSet<(usize, String)> {
    let targets = geometry.blocks.iter().flat_map(|block| block.targets.iter().enumerate());
    let names = |(number, target): (usize, &Vec<super::geometry::Attribute>)| {
        target.iter().map(|attribute| (number, attribute.name.clone())).collect::<Vec<_>>()
    };
    let is_known =
        |(_, name): &(usize, String)| matches!(name.as_str(), "POSITION" | "NORMAL" | "TANGENT");
    targets.flat_map(names).filter(is_known).collect()
}

fn add_others(geometry: &MeshGeometry, count: usize, further: &mut Further) {
    let all = geometry.blocks.iter().flat_map(|block| &block.attributes);
    let others: BTreeMap<&str, _> = all
        .map(|attribute| (attribute.name.as_str(), attribute.stream.element))
        .filter(|(name, _)| !is_carried_by_core(name) && !name.starts_with("JOINTS_"))
        .filter(|(name, _)| !name.starts_with("WEIGHTS_"))
        .collect();
    for (name, element) in others {
        let kind = match name.starts_with("COLOR_") {
            true => StreamKind::Color,
            false => StreamKind::Number,
        };
        if kind == StreamKind::Number && element.component.is_integer() {
            let reason = "they may be names, which nothing blends";
            further.left_out.push(("whole numbers of vertices", reason));
            continue;
        }
        let components = element.shape.components();
        let values = values(geometry, count, None, name, components);
        further.streams.push(VertexStream { kind, name: name.to_owned(), components, values });
    }
}

/// `#vertices by components`; zeros where a vertex has none.
fn values(
    geometry: &MeshGeometry,
    count: usize,
    target: Option<usize>,
    name: &str,
    components: usize,
) -> Vec<f32> {
    let streams = geometry.streams(target, name);
    let mut values = vec![0.0; count * components];
    for (vertex, row) in values.chunks_mut(components.max(1)).enumerate() {
        for (value, stored) in row.iter_mut().zip(streams.at(vertex).unwrap_or_default()) {
            *value = *stored as f32;
        }
    }
    values
}
