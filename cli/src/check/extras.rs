//! What the vertices of two files have beside what the core carries, brought together by name.

use std::collections::BTreeMap;

use chamfer::check::{ExtraStream, Rule};
use chamfer_formats::{Further, StreamKind, VertexStream};

/// Streams of both files, and what cannot be compared.
#[derive(Default)]
pub struct Streams {
    joined: Vec<Joined>,
    /// Each once, with the reason.
    pub not_told: BTreeMap<&'static str, &'static str>,
}

struct Joined {
    rule: Rule,
    components: usize,
    values: [Vec<f32>; 2],
}

impl Joined {
    fn extra(&self) -> ExtraStream<'_> {
        let [before, after] = &self.values;
        ExtraStream::new(self.rule, self.components, [before, after])
    }
}

const NOT_TOLD: &str = "only one of the two files tells of it";

impl Streams {
    /// `counts`: the vertices of both. What only one of them has is zero in the other; where a
    /// format does not tell, what the other has is not compared.
    pub fn new(sides: [Option<Further>; 2], counts: [usize; 2]) -> Streams {
        let mut streams = Streams::default();
        let left_out = sides.iter().flatten().flat_map(|side| &side.left_out);
        streams.not_told.extend(left_out.copied());
        let [Some(before), Some(after)] = &sides else {
            let told = sides.iter().flatten().flat_map(|side| &side.streams);
            streams.not_told.extend(told.map(|s| (rule_of(s.kind).name(), NOT_TOLD)));
            return streams;
        };
        let mut pairs: BTreeMap<(StreamKind, &str), [Option<&VertexStream>; 2]> = BTreeMap::new();
        for (side, further) in [before, after].into_iter().enumerate() {
            for stream in &further.streams {
                pairs.entry((stream.kind, &stream.name)).or_default()[side] = Some(stream);
            }
        }
        let (skin, others): (Vec<_>, Vec<_>) =
            pairs.into_iter().partition(|((kind, _), _)| *kind == StreamKind::Skin);
        let skin: Vec<_> = skin.into_iter().map(|(_, pair)| pair).collect();
        if !skin.is_empty() && !streams.not_told.contains_key("skin") {
            let values = [0, 1].map(|side| interleaved(&skin, side, counts[side]));
            streams.joined.push(Joined { rule: Rule::Skin, components: skin.len(), values });
        }
        for ((kind, _), pair) in others {
            streams.join(rule_of(kind), pair, counts);
        }
        streams
    }

    fn join(&mut self, rule: Rule, pair: [Option<&VertexStream>; 2], counts: [usize; 2]) {
        let components = pair.map(|stream| stream.map(|stream| stream.components));
        let Some(first) = components.into_iter().flatten().next() else { return };
        if components.iter().flatten().any(|other| *other != first) {
            self.not_told.insert(rule.name(), "it has another number of components");
            return;
        }
        let values = |side: usize| {
            pair[side].map_or_else(|| vec![0.0; counts[side] * first], |s| s.values.clone())
        };
        self.joined.push(Joined { rule, components: first, values: [values(0), values(1)] });
    }

    /// For the checker.
    pub fn extra(&self) -> Vec<ExtraStream<'_>> {
        self.joined.iter().map(Joined::extra).collect()
    }
}

fn rule_of(kind: StreamKind) -> Rule {
    match kind {
        StreamKind::Skin => Rule::Skin,
        StreamKind::Morph => Rule::Morph,
        StreamKind::Color => Rule::ColorChanged,
        StreamKind::Number => Rule::Attribute,
    }
}

/// `#vertices by #joints`: how much each pulls, by the names of both files.
fn interleaved(skin: &[[Option<&VertexStream>; 2]], side: usize, count: usize) -> Vec<f32> {
    let mut values = vec![0.0; count * skin.len()];
    for (joint, pair) in skin.iter().enumerate() {
        let column = pair[side].map_or(&[][..], |stream| &stream.values);
        for (row, weight) in values.chunks_mut(skin.len()).zip(column) {
            row[joint] = *weight;
        }
    }
    values
}
