//! The values of vertices, and whether one is that of a place on the source.

use glam::{DQuat, DVec3};

use super::ground::Foot;
use super::rules::Rule;
use super::stored::vector;
use super::surface::Surface;
use super::values::{has_right_normal, has_right_tangent};
use crate::mesh::Mesh;

/// How far (two degrees) a unit vector may turn: importers store them in eight bits, and a blend of
/// some is made unit length.
const SAME_DIRECTION: f64 = 0.035;

/// A blend of unit vectors that is shorter than this is what is left of ones that cancel out, and
/// points anywhere.
const LEAST_DIRECTION: f64 = 0.1;

/// How far a value may be off, relative to the largest of its stream: what formats of twelve bits
/// and more leave behind.
const VALUE_TOLERANCE: f64 = 1e-4;

/// The same for colours, which are stored in eight bits.
const COLOR_TOLERANCE: f64 = 3e-3;

/// The same for weights of a skin, of which only the strongest may stay, in eight bits.
const SKIN_TOLERANCE: f64 = 3e-2;

/// A stream of the source and what it became.
pub(super) struct Stream<'a> {
    /// What is broken where a value is another one.
    pub rule: Rule,
    kind: Kind,
    components: usize,
    /// `#vertices by components`, of the source and of the result.
    values: [&'a [f32]; 2],
    /// How far a value may be off.
    tolerance: f64,
    /// `#components`: between which values past the sides of a triangle are kept: colours within
    /// those of the source, all others within single precision.
    ranges: Vec<[f64; 2]>,
    /// `#vertices`, of the source and of the result: what a tangent is at a right angle to.
    normals: [&'a [[f32; 3]]; 2],
}

/// The cosine past which normals are of different faces, of which one's tangents tell nothing of the
/// other's: sixty degrees, the largest `hard_angle` that makes sense, and some rounding.
const ONE_SURFACE: f64 = 0.49;

#[derive(Clone, Copy, PartialEq)]
enum Kind {
    /// Three components; the length does not matter.
    Direction,
    /// A direction, and its handedness.
    Tangent,
    /// Numbers that are blended.
    Number,
}

/// How far a value may be off, as a share of how much it differs over a triangle of the source.
#[derive(Clone, Copy)]
pub(super) enum Slack {
    /// That of a place which is known.
    Exact(f64),
    /// That of what is new, and only near: its normals bend from one side to the other, and its
    /// texture may go on from across a seam.
    Near,
}

/// A further value of every vertex, such as the weights of a skin.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct ExtraStream<'a> {
    /// What is broken where a value is another one.
    pub rule: Rule,
    /// Floats per vertex.
    pub components: usize,
    /// `#vertices by components`, of the source and of the result.
    pub values: [&'a [f32]; 2],
}

impl<'a> ExtraStream<'a> {
    /// Values of the source and of the result (`#vertices by components`), and the rule that they
    /// follow.
    pub fn new(rule: Rule, components: usize, values: [&'a [f32]; 2]) -> ExtraStream<'a> {
        ExtraStream { rule, components, values }
    }
}

impl<'a> Stream<'a> {
    /// All streams that both meshes have. What one of them has alone is judged elsewhere.
    pub fn all<'b: 'a>(
        [before, after]: [&'a Mesh<'a>; 2],
        extras: &[ExtraStream<'b>],
    ) -> Vec<Stream<'a>> {
        let [normals, tangents, colors] = [
            [before.normals.as_flattened(), after.normals.as_flattened()],
            [before.tangents.as_flattened(), after.tangents.as_flattened()],
            [before.colors.as_flattened(), after.colors.as_flattened()],
        ];
        let new = |rule, kind, components, values| Stream {
            normals: [before.normals, after.normals],
            ..Stream::new(rule, kind, components, values)
        };
        let mut streams = vec![
            new(Rule::Shading, Kind::Direction, 3, normals),
            new(Rule::TangentTurned, Kind::Tangent, 4, tangents),
            new(Rule::ColorChanged, Kind::Number, 4, colors),
        ];
        for (before, after) in before.uvs.iter().zip(&after.uvs) {
            if before.components == after.components {
                let values = [before.values, after.values];
                let components = before.components as usize;
                streams.push(new(Rule::Texture, Kind::Number, components, values));
            }
        }
        let extra = |e: &ExtraStream<'b>| new(e.rule, Kind::Number, e.components, e.values);
        streams.extend(extras.iter().map(extra));
        let vertices = [before.positions.len(), after.positions.len()];
        streams.retain(|stream| {
            let counts = stream.values.map(|values| values.len() / stream.components.max(1));
            stream.components > 0 && counts == vertices && counts[0] > 0
        });
        streams
    }

    fn new(rule: Rule, kind: Kind, components: usize, values: [&'a [f32]; 2]) -> Stream<'a> {
        let largest = values[0].iter().fold(0.0, |most: f32, value| most.max(value.abs()));
        let share = match rule {
            Rule::ColorChanged => COLOR_TOLERANCE,
            Rule::Skin => SKIN_TOLERANCE,
            _ => VALUE_TOLERANCE,
        };
        Stream {
            rule,
            kind,
            components,
            values,
            tolerance: share * f64::from(largest),
            ranges: (0..components).map(|k| range(rule, values[0], components, k)).collect(),
            normals: [&[]; 2],
        }
    }

    /// Whether the value of a vertex of the result is that of a place on a triangle of the source.
    pub fn is_at(&self, vertex: usize, source: &Surface, foot: Foot, slack: Slack) -> bool {
        let corners = [0, 1, 2].map(|k| source.vertex(3 * foot.triangle + k));
        match self.kind {
            Kind::Number => self.is_number(vertex, corners, foot.weights, slack),
            // What points nowhere in the source may point anywhere.
            Kind::Direction => {
                !corners.iter().all(|&corner| has_right_normal(source.mesh, corner))
                    || self.is_direction(vertex, corners, foot.weights, slack)
            }
            Kind::Tangent => {
                !corners.iter().all(|&corner| has_right_tangent(source.mesh, corner))
                    || matches!(slack, Slack::Near)
                    || self.has_handedness(vertex, corners)
                        && self.is_direction(vertex, corners, foot.weights, slack)
            }
        }
    }

    fn is_number(
        &self,
        vertex: usize,
        corners: [usize; 3],
        weights: [f64; 3],
        slack: Slack,
    ) -> bool {
        // What is new goes on from across a seam, past the end of a chart, where no triangle tells.
        let Slack::Exact(share) = slack else { return true };
        (0..self.components).all(|component| {
            let [least, most] = self.ranges[component];
            let was = self.mean(corners, weights, component).clamp(least, most);
            let slack = self.tolerance + share * self.spread(corners, component);
            (self.value(1, vertex, component) - was).abs() <= slack
        })
    }

    fn is_direction(
        &self,
        vertex: usize,
        corners: [usize; 3],
        weights: [f64; 3],
        slack: Slack,
    ) -> bool {
        let now = DVec3::from([0, 1, 2].map(|component| self.value(1, vertex, component)));
        let was = DVec3::from([0, 1, 2].map(|component| self.mean(corners, weights, component)));
        let Some(now) = now.try_normalize() else { return false };
        if was.length() < LEAST_DIRECTION {
            return true;
        }
        if self.kind != Kind::Tangent {
            return self.is_near(now, was, (corners, weights), slack);
        }
        // Either way there may be taken for the one beside a normal that is not the one of the place.
        [was, self.turned_along(was, vertex, (corners, weights))].into_iter().any(|was| {
            let beside = was.reject_from(vector(&self.normals[1][vertex]).normalize_or(was));
            self.is_near(now, beside, (corners, weights), slack)
        })
    }

    fn is_near(
        &self,
        now: DVec3,
        was: DVec3,
        (corners, weights): ([usize; 3], [f64; 3]),
        slack: Slack,
    ) -> bool {
        let Some(was) = was.try_normalize() else { return false };
        let Slack::Exact(share) = slack else { return now.dot(was) > 0.0 };
        let spread = DVec3::from([0, 1, 2].map(|component| self.spread(corners, component)));
        // Past the sides of its triangle, a blend of unlike tangents enlarges what turning them
        // beside the normal took.
        let enlarged = match self.kind != Kind::Tangent || spread.length() < SAME_DIRECTION {
            true => 1.0,
            false => weights.iter().map(|weight| weight.abs()).sum::<f64>().powi(2),
        };
        now.distance(was) <= enlarged * SAME_DIRECTION + share * spread.length()
    }

    /// A tangent turned as the normal of its place is to become that of the vertex.
    fn turned_along(
        &self,
        tangent: DVec3,
        vertex: usize,
        (corners, weights): ([usize; 3], [f64; 3]),
    ) -> DVec3 {
        let blended: DVec3 =
            (0..3).map(|k| weights[k] * vector(&self.normals[0][corners[k]])).sum();
        let ends = blended.try_normalize().zip(vector(&self.normals[1][vertex]).try_normalize());
        let ends = ends.filter(|(from, to)| from.dot(*to) > ONE_SURFACE);
        ends.map_or(tangent, |(from, to)| DQuat::from_rotation_arc(from, to) * tangent)
    }

    /// Handedness is that of one of the corners.
    fn has_handedness(&self, vertex: usize, corners: [usize; 3]) -> bool {
        let sign = |side: usize, vertex: usize| self.value(side, vertex, 3).signum();
        corners.iter().any(|&corner| sign(0, corner) == sign(1, vertex))
    }

    fn value(&self, side: usize, vertex: usize, component: usize) -> f64 {
        f64::from(self.values[side][vertex * self.components + component])
    }

    fn mean(&self, corners: [usize; 3], weights: [f64; 3], component: usize) -> f64 {
        (0..3).map(|k| weights[k] * self.value(0, corners[k], component)).sum()
    }

    fn spread(&self, corners: [usize; 3], component: usize) -> f64 {
        let [a, b, c] = corners.map(|vertex| self.value(0, vertex, component));
        a.max(b).max(c) - a.min(b).min(c)
    }
}

/// Between which a component of a stream is kept.
fn range(rule: Rule, values: &[f32], components: usize, component: usize) -> [f64; 2] {
    let all = [f32::MIN, f32::MAX].map(f64::from);
    if rule != Rule::ColorChanged {
        return all;
    }
    let values = values.iter().skip(component).step_by(components).copied().map(f64::from);
    let [least, most] = values.fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], value| {
        [least.min(value), most.max(value)]
    });
    if least <= most { [least, most] } else { all }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// As a mesh, with one normal and one tangent all over.
    fn with_triangle<T>(normal: [f32; 3], tangent: [f32; 4], f: impl Fn(&Mesh) -> T) -> T {
        f(&Mesh {
            positions: &[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
            normals: &[normal; 3],
            tangents: &[tangent; 3],
            indices: &[0, 1, 2],
            submesh_index_counts: &[3],
            ..Mesh::default()
        })
    }

    /// Beside a normal that is not the one of the place a tangent is turned along, or laid down; it is no
    /// other one.
    #[test]
    fn a_tangent_beside_another_normal() {
        let is_at = |tangent: [f32; 4]| {
            with_triangle([0.0, 0.0, 1.0], [0.6, 0.8, 0.0, 1.0], |before| {
                with_triangle([0.8, 0.0, 0.6], tangent, |after| {
                    let streams = Stream::all([before, after], &[]);
                    let stream = streams.iter().find(|s| s.rule == Rule::TangentTurned).unwrap();
                    let foot = Foot { triangle: 0, weights: [1.0, 0.0, 0.0] };
                    stream.is_at(0, &Surface::new(before), foot, Slack::Exact(0.0))
                })
            })
        };
        assert!(is_at([0.36, 0.8, -0.48, 1.0]), "turned along");
        assert!(is_at([0.2459, 0.9108, -0.3279, 1.0]), "laid down");
        assert!(!is_at([0.48, 0.6, -0.64, 1.0]));
        assert!(!is_at([0.36, 0.8, -0.48, -1.0]), "of the other hand");
    }
}
