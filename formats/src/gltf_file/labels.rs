//! Labels: attributes whose numbers name something (`_FEATURE_ID_0`, integers of one's own), so that
//! there is nothing between two of them.
//!
//! A triangle of the source keeps those of its corners, and all triangles of one chamfer or one
//! corner have the same. Where a vertex would need two, it is there twice.

use std::collections::HashMap;
use std::collections::hash_map::Entry;

use chamfer::{TriangleKind, TriangleSource};

use super::element::Stream;
use super::follow::{Follower, is_label, nearest};
use super::geometry::{Attribute, Block, SourceStreams};

/// What a vertex is labelled with, by number.
type Class = u32;

/// The labels of the vertices of a block.
pub struct Labels<'a> {
    follower: &'a Follower<'a>,
    attributes: Vec<&'a Attribute>,
    streams: Vec<SourceStreams<'a>>,
    /// `#classes by #attributes`: the numbers of each.
    rows: Vec<Vec<Vec<f64>>>,
    known: HashMap<Vec<u64>, Class>,
    /// `#vertices of the block`.
    class_of: Vec<Class>,
}

impl<'a> Labels<'a> {
    /// Those of some output vertices; none where the block has no labels.
    pub fn new(
        follower: &'a Follower<'a>,
        block: &'a Block,
        vertices: &[u32],
    ) -> Option<Labels<'a>> {
        let is_own = |attribute: &&Attribute| {
            attribute.name.starts_with('_') && is_label(&attribute.name, attribute.stream.element)
        };
        let attributes: Vec<&Attribute> = block.attributes.iter().filter(is_own).collect();
        if attributes.is_empty() {
            return None;
        }
        let streams = attributes.iter().map(|a| follower.geometry.streams(None, &a.name)).collect();
        let mut labels = Labels {
            follower,
            attributes,
            streams,
            rows: Vec::new(),
            known: HashMap::new(),
            class_of: Vec::new(),
        };
        for vertex in vertices {
            let class = labels.of_output(*vertex);
            labels.class_of.push(class);
        }
        Some(labels)
    }

    fn of_output(&mut self, vertex: u32) -> Class {
        let source = self.follower.sources.get(vertex as usize);
        let row = self.streams.iter().map(|stream| nearest(stream, &source.surface)).collect();
        self.class(row)
    }

    fn of_source(&mut self, vertex: u32) -> Class {
        let value =
            |stream: &SourceStreams| stream.at(vertex as usize).unwrap_or_default().to_vec();
        let row = self.streams.iter().map(value).collect();
        self.class(row)
    }

    fn class(&mut self, mut row: Vec<Vec<f64>>) -> Class {
        for (numbers, attribute) in row.iter_mut().zip(&self.attributes) {
            numbers.resize(attribute.stream.element.shape.components(), 0.0);
        }
        match self.known.entry(row.iter().flatten().map(|number| number.to_bits()).collect()) {
            Entry::Occupied(known) => *known.get(),
            Entry::Vacant(unknown) => {
                self.rows.push(row);
                *unknown.insert(self.rows.len() as Class - 1)
            }
        }
    }

    /// Gives each triangle its labels: adds vertices where some would need others, and changes
    /// the places of corners to theirs.
    ///
    /// `places`: `#triangles by 3`, flattened.
    pub fn keep_apart(
        &mut self,
        triangles: &[TriangleSource],
        places: &mut [u32],
        chosen: &mut Chosen,
        vertices: &mut Vec<u32>,
    ) {
        for (source, corners) in triangles.iter().zip(places.as_chunks_mut::<3>().0) {
            let wanted = self.wanted(*source, *corners, chosen);
            for (place, class) in corners.iter_mut().zip(wanted) {
                if self.class_of[*place as usize] == class {
                    continue;
                }
                let vertex = vertices[*place as usize];
                *place = *chosen.copies.entry((vertex, class)).or_insert_with(|| {
                    vertices.push(vertex);
                    self.class_of.push(class);
                    vertices.len() as u32 - 1
                });
            }
        }
    }

    fn wanted(
        &mut self,
        source: TriangleSource,
        places: [u32; 3],
        chosen: &mut Chosen,
    ) -> [Class; 3] {
        let TriangleSource { kind, index } = source;
        if kind == TriangleKind::Source {
            let first = 3 * index as usize;
            let old = self.follower.geometry.indices().get(first..first + 3);
            let Some(&[a, b, c]) = old else {
                return places.map(|place| self.class_of[place as usize]);
            };
            return [a, b, c].map(|vertex| self.of_source(vertex));
        }
        let [a, b, c] = places.map(|place| self.class_of[place as usize]);
        // What two corners have, or else the first.
        let most = if b == c { b } else { a };
        [*chosen.classes.entry((kind as u32, index)).or_insert(most); 3]
    }

    /// The values of a label attribute; `None` for others.
    pub fn stream(&self, name: &str) -> Option<Stream> {
        let number = self.attributes.iter().position(|attribute| attribute.name == name)?;
        let element = self.attributes[number].stream.element;
        let rows = self.class_of.iter().map(|class| &self.rows[*class as usize][number]);
        Some(Stream { element, values: rows.flatten().copied().collect() })
    }
}

/// What was decided for the triangles of a block so far.
#[derive(Default)]
pub struct Chosen {
    /// By chamfer or corner.
    classes: HashMap<(u32, u32), Class>,
    /// By vertex and what it is labelled with: the place of its copy.
    copies: HashMap<(u32, Class), u32>,
}
