//! Skin weights through the provenance: the influences of the source vertices are merged, the
//! strongest stay, and their weights add up to 1 in the type that they are written in.

use std::collections::BTreeMap;

use super::element::{Component, ElementType, Shape, Stream};
use super::follow::{Follower, parts, single};
use super::geometry::{Block, SourceStreams};

/// Influences per `JOINTS_n` and `WEIGHTS_n`.
const SET_SIZE: usize = 4;

/// A joint and how much it pulls.
type Influence = (u32, f64);

/// The skin of some vertices: one pair of streams per set.
#[derive(Debug, PartialEq)]
pub struct Skin {
    pub joints: Vec<Stream>,
    pub weights: Vec<Stream>,
}

/// The skin of some output vertices, in the types and with as many sets as the block has.
pub fn blend(follower: &Follower, block: &Block, vertices: &[u32]) -> Skin {
    let sets = block.skin_sets();
    let streams = Influences::new(follower);
    let weight_type = weight_type(block, sets);
    let mut influences = Vec::with_capacity(vertices.len() * sets * SET_SIZE);
    for vertex in vertices {
        let surface = &follower.sources.get(*vertex as usize).surface;
        let own = single(surface).and_then(|source| streams.as_stored(source, sets));
        influences.extend(own.unwrap_or_else(|| {
            let merged = merge(parts(surface).map(|(v, weight)| (streams.of(v), weight)));
            strongest(merged, sets * SET_SIZE, weight_type.component)
        }));
    }
    spread(&influences, block, sets, weight_type)
}

/// The influences of the source vertices.
struct Influences<'a> {
    follower: &'a Follower<'a>,
    /// By set: the joints and the weights.
    streams: Vec<[SourceStreams<'a>; 2]>,
}

impl<'a> Influences<'a> {
    fn new(follower: &'a Follower<'a>) -> Influences<'a> {
        let most = follower.skin_sets.iter().copied().max().unwrap_or(0);
        let streams = |set| {
            ["JOINTS", "WEIGHTS"]
                .map(|kind| follower.geometry.streams(None, &format!("{kind}_{set}")))
        };
        Influences { follower, streams: (0..most).map(streams).collect() }
    }

    /// Those of a vertex in their places, if they fill as many sets.
    fn as_stored(&self, vertex: usize, sets: usize) -> Option<Vec<Influence>> {
        let influences = self.of(vertex);
        (influences.len() == sets * SET_SIZE).then_some(influences)
    }

    fn of(&self, vertex: usize) -> Vec<Influence> {
        let block = self.follower.geometry.origins[vertex].block as usize;
        let mut influences = Vec::new();
        for [joints, weights] in &self.streams[..self.follower.skin_sets[block]] {
            let (Some(joints), Some(weights)) = (joints.at(vertex), weights.at(vertex)) else {
                continue;
            };
            influences
                .extend(joints.iter().zip(weights).map(|(joint, weight)| (*joint as u32, *weight)));
        }
        influences
    }
}

fn merge(sources: impl Iterator<Item = (Vec<Influence>, f64)>) -> BTreeMap<u32, f64> {
    let mut merged = BTreeMap::new();
    for (influences, share) in sources {
        for (joint, weight) in influences {
            *merged.entry(joint).or_insert(0.0) += share * weight;
        }
    }
    merged
}

/// The strongest influences, `capacity` in number with padding, of sum 1.
fn strongest(merged: BTreeMap<u32, f64>, capacity: usize, component: Component) -> Vec<Influence> {
    let mut influences: Vec<Influence> = merged.into_iter().filter(|(_, w)| *w > 0.0).collect();
    influences.sort_by(|(_, a), (_, b)| b.total_cmp(a));
    influences.truncate(capacity);
    if influences.is_empty() {
        influences.push((0, 1.0));
    }
    normalize(&mut influences, component);
    influences.retain(|(_, weight)| *weight > 0.0);
    // An unused place names joint 0 with weight 0.
    influences.resize(capacity, (0, 0.0));
    influences
}

/// Makes the weights add up to 1, exactly so where they are integers: what rounding down leaves
/// over goes to the weights that lost most.
fn normalize(influences: &mut [Influence], component: Component) {
    let sum: f64 = influences.iter().map(|(_, weight)| weight).sum();
    influences.iter_mut().for_each(|(_, weight)| *weight /= sum);
    if !component.is_integer() {
        return;
    }
    let one = component.one();
    let lost = |weight: f64| weight * one - (weight * one).floor();
    let mut by_loss: Vec<usize> = (0..influences.len()).collect();
    by_loss.sort_by(|a, b| lost(influences[*b].1).total_cmp(&lost(influences[*a].1)));
    let floors: f64 = influences.iter().map(|(_, weight)| (weight * one).floor()).sum();
    let left_over = (one - floors).max(0.0) as usize;
    influences.iter_mut().for_each(|(_, weight)| *weight = (*weight * one).floor() / one);
    for index in by_loss.into_iter().cycle().take(left_over) {
        influences[index].1 += 1.0 / one;
    }
}

/// One type for all sets: their sum is over all of them.
fn weight_type(block: &Block, sets: usize) -> ElementType {
    let mut types = (0..sets).filter_map(|set| {
        block.attribute(&format!("WEIGHTS_{set}")).map(|attribute| attribute.stream.element)
    });
    let floats = ElementType::floats(Shape::VEC4);
    let first = types.next().unwrap_or(floats);
    let unsigned = matches!(first.component, Component::U8 | Component::U16) && first.normalized;
    if unsigned && types.all(|other| other == first) { first } else { floats }
}

fn spread(influences: &[Influence], block: &Block, sets: usize, weights: ElementType) -> Skin {
    let set = |set: usize, number: fn(&Influence) -> f64| -> Vec<f64> {
        let rows = influences.chunks_exact(sets * SET_SIZE);
        rows.flat_map(|row| row[set * SET_SIZE..][..SET_SIZE].iter().map(number)).collect()
    };
    let stream = |element, values| Stream { element, values };
    Skin {
        joints: (0..sets)
            .map(|index| {
                let joints = set(index, |(joint, _)| f64::from(*joint));
                stream(joint_type(block, index, &joints), joints)
            })
            .collect(),
        weights: (0..sets).map(|i| stream(weights, set(i, |(_, weight)| *weight))).collect(),
    }
}

/// Bytes only where they were bytes and still fit: a joint may come from another set.
fn joint_type(block: &Block, set: usize, joints: &[f64]) -> ElementType {
    let attribute = block.attribute(&format!("JOINTS_{set}"));
    let bytes = attribute.is_some_and(|a| a.stream.element.component == Component::U8);
    let fit = joints.iter().all(|joint| *joint <= Component::U8.one());
    let component = if bytes && fit { Component::U8 } else { Component::U16 };
    ElementType { component, shape: Shape::VEC4, normalized: false }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn merged(pairs: &[Influence]) -> BTreeMap<u32, f64> {
        pairs.iter().copied().collect()
    }

    #[test]
    fn influences_of_the_same_joint_add_up() {
        let a = vec![(3, 1.0), (0, 0.0)];
        let b = vec![(3, 0.5), (5, 0.5)];
        let merged = merge([(a, 0.5), (b, 0.5)].into_iter());
        assert_eq!(merged[&3], 0.75);
        assert_eq!(merged[&5], 0.25);
    }

    #[test]
    fn the_strongest_stay_with_sum_one() {
        let five = merged(&[(0, 0.1), (1, 0.3), (2, 0.2), (3, 0.25), (4, 0.15)]);
        let kept = strongest(five, 4, Component::F32);
        assert_eq!(kept.iter().map(|(joint, _)| *joint).collect::<Vec<_>>(), [1, 3, 2, 4]);
        assert!((kept.iter().map(|(_, weight)| weight).sum::<f64>() - 1.0).abs() < 1e-12);
    }

    #[test]
    fn unused_places_name_joint_zero() {
        let kept = strongest(merged(&[(7, 1.0), (9, -0.5), (8, 0.0)]), 4, Component::F32);
        assert_eq!(kept, [(7, 1.0), (0, 0.0), (0, 0.0), (0, 0.0)]);
    }

    #[test]
    fn integer_weights_add_up_exactly() {
        for component in [Component::U8, Component::U16] {
            let thirds = merged(&[(1, 1.0), (2, 1.0), (3, 1.0), (4, 1e-9)]);
            let kept = strongest(thirds, 4, component);
            let sum: f64 = kept.iter().map(|(_, weight)| (weight * component.one()).round()).sum();
            assert_eq!(sum, component.one());
            assert_eq!(kept[3], (0, 0.0), "what rounds to nothing is no influence");
        }
    }
}
