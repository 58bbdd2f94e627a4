//! Attributes that the core does not carry follow its provenance: each output vertex blends those
//! of up to three source vertices.

use std::collections::BTreeMap;

use chamfer::{Blend, VertexSource, VertexSources};

use super::element::{ElementType, Stream};
use super::geometry::{Block, MeshGeometry, SourceStreams};
use super::names::is_carried_by_core;

/// The least and the most of each component.
type Range = Vec<[f64; 2]>;

/// Blends the attributes of one mesh.
pub struct Follower<'a> {
    pub geometry: &'a MeshGeometry,
    /// `#output vertices`.
    pub sources: &'a VertexSources,
    /// `#blocks`: how many whole sets of influences each has.
    pub skin_sets: Vec<usize>,
    /// By name: a blend of colours that reads past its triangle must not leave them.
    color_ranges: BTreeMap<&'a str, Range>,
}

impl<'a> Follower<'a> {
    /// Looks once at what all blocks have.
    pub fn new(geometry: &'a MeshGeometry, sources: &'a VertexSources) -> Follower<'a> {
        let skin_sets = geometry.blocks.iter().map(Block::skin_sets).collect();
        Follower { geometry, sources, skin_sets, color_ranges: color_ranges(geometry) }
    }

    /// An attribute of some output vertices, of a morph target or of the mesh itself, as near to
    /// the given type as its values allow.
    pub fn follow(
        &self,
        target: Option<usize>,
        name: &str,
        element: ElementType,
        vertices: &[u32],
    ) -> Stream {
        let streams = self.geometry.streams(target, name);
        let is_color = name.starts_with("COLOR_") && target.is_none();
        let range = self.color_ranges.get(name).filter(|_| is_color).into_iter().flatten();
        let mut values = Vec::with_capacity(vertices.len() * element.shape.components());
        for vertex in vertices {
            let source = self.sources.get(*vertex as usize);
            let blend = blend_of(&source, name);
            let mut value = match is_label(name, element) {
                true => nearest(&streams, blend),
                false => mean(&streams, blend),
            };
            for (number, &[least, most]) in value.iter_mut().zip(range.clone()) {
                *number = number.max(least).min(most);
            }
            values.extend((0..element.shape.components()).map(|component| {
                value.get(component).copied().unwrap_or(neutral(name, target, component))
            }));
        }
        let stream = Stream { element, values };
        if may_be_rounded(name) { stream } else { stream.exact_or_floats() }
    }
}

/// The ranges of all colours that the core does not carry.
fn color_ranges(geometry: &MeshGeometry) -> BTreeMap<&str, Range> {
    let mut ranges: BTreeMap<&str, Range> = BTreeMap::new();
    for origin in &geometry.origins {
        let attributes = geometry.blocks[origin.block as usize].attributes.iter();
        let colors = attributes.filter(|attribute| attribute.name.starts_with("COLOR_"));
        for color in colors.filter(|color| !is_carried_by_core(&color.name)) {
            let range = ranges.entry(&color.name).or_default();
            extend(range, color.stream.at(origin.element as usize));
        }
    }
    ranges
}

fn extend(range: &mut Range, value: &[f64]) {
    range.resize(range.len().max(value.len()), [f64::INFINITY, f64::NEG_INFINITY]);
    for ([least, most], number) in range.iter_mut().zip(value) {
        (*least, *most) = (number.min(*least), number.max(*most));
    }
}

/// What an attribute is a blend of: of the surface, of the vertex's own chart, or of the chart that
/// the chamfer continues.
fn blend_of<'a>(source: &'a VertexSource, name: &str) -> &'a Blend {
    if let Some(number) = name.strip_prefix("TEXCOORD_") {
        return source.uv(number.parse().unwrap_or(0));
    }
    match name {
        "TANGENT" => source.tangent(),
        _ if name.starts_with("COLOR_") => &source.chart,
        _ => &source.surface,
    }
}

/// Plain integers that nothing says are quantities: numbers of joints, features, materials.
/// Those of features may be written as floats.
pub fn is_label(name: &str, element: ElementType) -> bool {
    let named = name.starts_with('_') || name.starts_with("JOINTS_");
    let is_integer = element.component.is_integer() && !element.normalized;
    named && is_integer || name.starts_with("_FEATURE_ID_")
}

/// A geometric stream would step where its type is coarser than the chamfer.
fn may_be_rounded(name: &str) -> bool {
    !matches!(name, "POSITION" | "NORMAL" | "TANGENT") && !name.starts_with("TEXCOORD_")
}

fn neutral(name: &str, target: Option<usize>, component: usize) -> f64 {
    let opaque = name.starts_with("COLOR_") && component == 3 && target.is_none();
    if opaque { 1.0 } else { 0.0 }
}

/// The source vertices of a blend that count.
pub fn parts(blend: &Blend) -> impl Iterator<Item = (usize, f64)> {
    let parts = blend.vertices.into_iter().zip(blend.weights);
    parts.filter(|(_, weight)| *weight != 0.0).map(|(v, weight)| (v as usize, f64::from(weight)))
}

/// The one source vertex of a blend that is none.
pub fn single(blend: &Blend) -> Option<usize> {
    let mut parts = parts(blend);
    let (vertex, _) = parts.next()?;
    parts.all(|(other, _)| other == vertex).then_some(vertex)
}

/// The value of the heaviest source vertex of a blend that has one.
pub fn nearest(streams: &SourceStreams, blend: &Blend) -> Vec<f64> {
    let mut best: Option<(f64, &[f64])> = None;
    for (vertex, weight) in parts(blend) {
        let Some(value) = streams.at(vertex) else { continue };
        if best.is_none_or(|(heaviest, _)| weight > heaviest) {
            best = Some((weight, value));
        }
    }
    best.map(|(_, value)| value.to_vec()).unwrap_or_default()
}

/// The weighted mean over those source vertices that have the attribute; empty if none has.
fn mean(streams: &SourceStreams, blend: &Blend) -> Vec<f64> {
    if let Some(vertex) = single(blend) {
        return streams.at(vertex).unwrap_or_default().to_vec();
    }
    let mut sum = Vec::new();
    let mut total = 0.0;
    for (vertex, weight) in parts(blend) {
        let Some(value) = streams.at(vertex) else { continue };
        sum.resize(sum.len().max(value.len()), 0.0);
        sum.iter_mut().zip(value).for_each(|(sum, number)| *sum += weight * number);
        total += weight;
    }
    if total != 0.0 {
        sum.iter_mut().for_each(|number| *number /= total);
    }
    sum
}
