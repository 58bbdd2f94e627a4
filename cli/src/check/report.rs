//! What was found in each mesh, and in all.

use std::path::Path;

use anyhow::Result;
use chamfer::check::{Facts, Findings, Matching, MeasuredEdge, Rule};
use serde::Serialize;

/// The whole report.
#[derive(Debug, Serialize)]
pub struct CheckReport {
    /// The file before, as given.
    pub before: String,
    /// The file after.
    pub after: String,
    /// Whether no mesh is missing and all are sound.
    pub sound: bool,
    /// In the order of the file before.
    pub meshes: Vec<MeshCheck>,
    /// Meshes that the file after does not have.
    pub missing: Vec<String>,
    /// Meshes that only the file after has. There is nothing to check them against.
    pub added: Vec<String>,
    /// Sums over the meshes.
    pub totals: Counts,
}

/// What was found in one mesh.
#[derive(Debug, Serialize)]
pub struct MeshCheck {
    /// As the file before calls it.
    pub name: String,
    /// Whether nothing is wrong.
    pub sound: bool,
    /// What was counted and measured.
    #[serde(flatten)]
    pub counts: Counts,
    /// How the source's triangles were found: by "order" or by "geometry".
    pub matched_by: &'static str,
    /// How many of them were not.
    pub not_found: usize,
    /// What is wrong.
    pub defects: Vec<Defect>,
    /// What could not be checked, or only in part.
    pub unchecked: Vec<Unchecked>,
}

/// What can be counted and measured in a mesh or in all.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Counts {
    /// Of the source.
    pub before: Sides,
    /// Of the result.
    pub after: Sides,
    /// Triangles that turned over, or face away from their normals.
    pub flipped: usize,
    /// Hard edges that a chamfer of the width asked for would not have left.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub left_without_need: Option<usize>,
    /// The chamfers found.
    pub chamfers: Widths,
}

/// What can be counted in one file.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Sides {
    /// Vertices.
    pub vertices: usize,
    /// Triangles.
    pub triangles: usize,
    /// Whether every edge is used equally often in both directions.
    pub closed: bool,
    /// Loops of border edges.
    pub border_loops: usize,
    /// Edges of more than two triangles.
    pub non_manifold_edges: usize,
    /// Triangles without area.
    pub without_area: usize,
    /// Pairs of triangles that cut each other, where that was asked for.
    pub self_intersections: Option<usize>,
    /// Normals that are not unit length.
    pub odd_normals: usize,
    /// Tangents that are not unit length or not at a right angle to the normal.
    pub odd_tangents: usize,
    /// Hard edges.
    pub hard_edges: usize,
}

/// Widths measured in the result, in mesh units.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Widths {
    /// How many hard edges have a chamfer.
    pub count: usize,
    /// The least width at an end that is open.
    pub min: Option<f32>,
    /// The mean over both ends of all, weighted by edge length.
    pub mean: Option<f32>,
    /// The greatest width.
    pub max: Option<f32>,
    /// The width that was asked for, if known and the same for all.
    pub asked: Option<f32>,
    /// Length of the chamfered edges: the weight of the mean in sums.
    #[serde(skip)]
    length: f64,
}

/// A broken rule.
#[derive(Debug, PartialEq, Serialize)]
pub struct Defect {
    /// Its name, in lower case.
    pub rule: String,
    /// How many elements break it.
    pub count: usize,
    /// The first few of them.
    pub first: Vec<String>,
}

/// A rule that could not be checked.
#[derive(Debug, PartialEq, Serialize)]
pub struct Unchecked {
    /// Its name.
    pub rule: String,
    /// Why not.
    pub reason: String,
}

impl CheckReport {
    /// Adds up the meshes.
    pub fn new(
        [before, after]: [&Path; 2],
        meshes: Vec<MeshCheck>,
        missing: Vec<String>,
        added: Vec<String>,
    ) -> CheckReport {
        let totals = meshes.iter().map(|mesh| mesh.counts.clone()).reduce(Counts::plus);
        CheckReport {
            before: before.display().to_string(),
            after: after.display().to_string(),
            sound: missing.is_empty() && meshes.iter().all(|mesh| mesh.sound),
            totals: totals.unwrap_or_default(),
            meshes,
            missing,
            added,
        }
    }

    /// The report as JSON text.
    ///
    /// # Errors
    /// Where memory runs out.
    pub fn to_json(&self) -> Result<Vec<u8>> {
        let mut text = serde_json::to_vec_pretty(self)?;
        text.push(b'\n');
        Ok(text)
    }
}

impl MeshCheck {
    /// What the checker says of a mesh.
    pub fn new(name: &str, findings: &Findings) -> MeshCheck {
        let defects = findings.breaches.iter().map(|breach| Defect {
            rule: breach.rule.name().into(),
            count: breach.count,
            first: breach.first.iter().map(ToString::to_string).collect(),
        });
        let unchecked = findings.unchecked.iter().map(|unchecked| Unchecked {
            rule: unchecked.rule.name().into(),
            reason: unchecked.reason.into(),
        });
        MeshCheck {
            name: name.into(),
            sound: findings.is_sound(),
            counts: Counts::new(findings),
            matched_by: match findings.matching {
                Matching::Geometry => "geometry",
                Matching::Order | Matching::Provenance => "order",
            },
            not_found: findings.lost,
            defects: defects.collect(),
            unchecked: unchecked.collect(),
        }
    }

    /// Adds what is known where the width asked for is.
    pub fn expect(&mut self, width: f32, left_without_need: &[[u32; 2]]) {
        self.counts.chamfers.asked = Some(width);
        self.counts.left_without_need = Some(left_without_need.len());
        if !left_without_need.is_empty() {
            self.sound = false;
            let named = left_without_need.iter().take(NAMED_EDGES);
            self.defects.push(Defect {
                rule: "hard edge left".into(),
                count: left_without_need.len(),
                first: named.map(|[a, b]| format!("source edge {a}-{b}")).collect(),
            });
        }
    }
}

/// How many edges a [`Defect`] names.
const NAMED_EDGES: usize = 5;

impl Counts {
    fn new(findings: &Findings) -> Counts {
        Counts {
            before: Sides::new(&findings.before),
            after: Sides::new(&findings.after),
            flipped: findings.count(Rule::Flipped),
            left_without_need: None,
            chamfers: Widths::new(&findings.edges),
        }
    }

    fn plus(self, other: Counts) -> Counts {
        Counts {
            before: self.before.plus(other.before),
            after: self.after.plus(other.after),
            flipped: self.flipped + other.flipped,
            left_without_need: sum(self.left_without_need, other.left_without_need),
            chamfers: self.chamfers.plus(other.chamfers),
        }
    }
}

impl Sides {
    fn new(facts: &Facts) -> Sides {
        Sides {
            vertices: facts.vertices,
            triangles: facts.triangles,
            closed: facts.border_half_edges == 0,
            border_loops: facts.border_loops,
            non_manifold_edges: facts.non_manifold_edges,
            without_area: facts.flat_triangles,
            self_intersections: facts.self_intersections,
            odd_normals: facts.odd_normals,
            odd_tangents: facts.odd_tangents,
            hard_edges: facts.hard_edges,
        }
    }

    fn plus(self, other: Sides) -> Sides {
        Sides {
            vertices: self.vertices + other.vertices,
            triangles: self.triangles + other.triangles,
            closed: self.closed && other.closed,
            border_loops: self.border_loops + other.border_loops,
            non_manifold_edges: self.non_manifold_edges + other.non_manifold_edges,
            without_area: self.without_area + other.without_area,
            self_intersections: sum(self.self_intersections, other.self_intersections),
            odd_normals: self.odd_normals + other.odd_normals,
            odd_tangents: self.odd_tangents + other.odd_tangents,
            hard_edges: self.hard_edges + other.hard_edges,
        }
    }
}

impl Widths {
    fn new(edges: &[MeasuredEdge]) -> Widths {
        let chamfered = edges.iter().filter(|edge| edge.is_chamfered());
        chamfered.map(Widths::of_edge).fold(Widths::default(), Widths::plus)
    }

    fn of_edge(edge: &MeasuredEdge) -> Widths {
        let open = edge.widths().into_iter().zip(edge.is_open).filter(|(_, is_open)| *is_open);
        let open = || open.clone().map(|(width, _)| width);
        Widths {
            count: 1,
            min: open().reduce(f32::min),
            mean: Some(edge.widths().iter().sum::<f32>() / 2.0),
            max: open().reduce(f32::max),
            asked: None,
            length: f64::from(edge.length),
        }
    }

    fn plus(self, other: Widths) -> Widths {
        let weight = |widths: &Widths| f64::from(widths.mean.unwrap_or(0.0)) * widths.length;
        let length = self.length + other.length;
        let mean = (weight(&self) + weight(&other)) / length;
        Widths {
            count: self.count + other.count,
            min: either(f32::min, self.min, other.min),
            mean: (length > 0.0).then_some(mean as f32),
            max: either(f32::max, self.max, other.max),
            asked: self.asked.filter(|_| self.asked == other.asked),
            length,
        }
    }
}

fn sum(one: Option<usize>, other: Option<usize>) -> Option<usize> {
    Some(one? + other?)
}

fn either(better: fn(f32, f32) -> f32, one: Option<f32>, other: Option<f32>) -> Option<f32> {
    one.into_iter().chain(other).reduce(better)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn edge(length: f32, widths: [f32; 2]) -> MeasuredEdge {
        MeasuredEdge {
            vertices: [0, 1],
            length,
            distances: widths.map(|width| [width; 2]),
            is_open: widths.map(|width| width > 0.0),
        }
    }

    #[test]
    fn widths_are_weighted_by_edge_length() {
        let edges = [edge(3.0, [0.2, 0.2]), edge(1.0, [0.4, 0.0]), edge(9.0, [0.0, 0.0])];
        let widths = Widths::new(&edges);
        assert_eq!((widths.count, widths.min, widths.max), (2, Some(0.2), Some(0.4)));
        assert!((widths.mean.unwrap() - 0.2).abs() < 1e-6);
        assert_eq!(Widths::new(&[]), Widths::default());
    }

    #[test]
    fn self_intersections_that_nobody_asked_for_have_no_sum() {
        let known = Sides { self_intersections: Some(2), ..Sides::default() };
        assert_eq!(known.clone().plus(known.clone()).self_intersections, Some(4));
        assert_eq!(known.plus(Sides::default()).self_intersections, None);
    }
}
