//! What was found in each mesh, and in all.

use std::path::Path;

use anyhow::Result;
use chamfer::check::{Facts, Findings, Matching, MeasuredEdge, Rule};
use chamfer::see_through::Leak;
use serde::Serialize;

/// The whole report.
#[derive(Debug, Serialize)]
pub struct CheckReport {
    /// The file before, as given.
    pub before: String,
    /// The file after.
    pub after: String,
    /// Whether all was checked and nothing is wrong.
    pub sound: bool,
    /// The last word.
    pub verdict: Verdict,
    /// In the order of the file before.
    pub meshes: Vec<MeshCheck>,
    /// Meshes that the file after does not have.
    pub missing: Vec<String>,
    /// Meshes that only the file after has. There is nothing to check them against.
    pub added: Vec<String>,
    /// What stands elsewhere in the scene than before, other than meshes: nodes, bones, bind poses.
    pub moved: Vec<String>,
    /// Where light shows.
    pub see_through: SeeThrough,
    /// Sums over the meshes.
    pub totals: Counts,
}

/// What is said of a file in the end.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum Verdict {
    /// All was checked, nothing is wrong.
    #[serde(rename = "sound")]
    Sound,
    /// Nothing is wrong, but something was not checked.
    #[serde(rename = "sound as far as checked")]
    SoundAsFarAsChecked,
    /// Something is wrong.
    #[serde(rename = "not sound")]
    NotSound,
}

impl Verdict {
    /// What the command ends with; 2 is that of files that cannot be read.
    pub fn exit_code(self) -> u8 {
        match self {
            Verdict::Sound => 0,
            Verdict::NotSound => 1,
            Verdict::SoundAsFarAsChecked => 3,
        }
    }

    /// For the terminal, as in the report.
    pub fn name(self) -> &'static str {
        match self {
            Verdict::Sound => "sound",
            Verdict::SoundAsFarAsChecked => "sound as far as checked",
            Verdict::NotSound => "not sound",
        }
    }
}

/// What was found by looking through the whole scene.
#[derive(Debug, Default, Serialize)]
pub struct SeeThrough {
    /// Why nobody looked, if so.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub not_checked: Option<&'static str>,
    /// The largest width of the chamfers, in scene units: the one asked for where that is known,
    /// measured otherwise.
    pub width: Option<f32>,
    /// Where light shows, the worst first.
    pub places: Vec<Place>,
}

impl SeeThrough {
    /// That nobody looked, and why.
    pub fn not_checked(reason: &'static str) -> SeeThrough {
        SeeThrough { not_checked: Some(reason), ..SeeThrough::default() }
    }
}

/// A place where light shows.
#[derive(Debug, Serialize)]
pub struct Place {
    /// In scene units, on the old surface.
    pub at: [f32; 3],
    /// The unit vector from there to the eye that sees the worst of it.
    pub toward_eye: [f32; 3],
    /// How many samples that eye has of it.
    pub samples: usize,
    /// From how many directions it is seen.
    pub views: usize,
    /// How much farther that eye sees than before, at most, in scene units; nothing where there
    /// is nothing behind.
    pub deeper: Option<f32>,
    /// The eyes of those.
    #[serde(skip)]
    eyes: Vec<[f32; 3]>,
    /// The worst one.
    #[serde(skip)]
    pub leak: Leak,
}

impl Place {
    /// As one view sees it.
    pub fn new(leak: Leak) -> Place {
        Place {
            at: leak.middle(),
            toward_eye: leak.toward_eye,
            samples: leak.places.len(),
            views: 1,
            eyes: vec![leak.toward_eye],
            deeper: Some(leak.depth).filter(|depth| depth.is_finite()),
            leak,
        }
    }

    /// Adds what another view sees of it, which is not worse.
    pub fn add(&mut self, leak: &Leak) {
        if !self.eyes.contains(&leak.toward_eye) {
            self.eyes.push(leak.toward_eye);
            self.views += 1;
        }
    }
}

/// What was found in one mesh.
#[derive(Debug, Serialize)]
pub struct MeshCheck {
    /// As the file before calls it.
    pub name: String,
    /// Whether all of it was checked and nothing is wrong.
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
    /// What was not checked, or only in part.
    pub unchecked: Vec<Unchecked>,
    /// The width asked for, otherwise what most chamfers stay within, in mesh units.
    #[serde(skip)]
    pub width: Option<f32>,
    /// How many vertices of the source only rounding may have set apart from others, where something
    /// is wrong: chamfering may have joined them.
    #[serde(skip)]
    pub nearly_touching: usize,
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
        missing: Vec<String>,
        added: Vec<String>,
        see_through: SeeThrough,
        (meshes, moved): (Vec<MeshCheck>, Vec<String>),
    ) -> CheckReport {
        let totals = meshes.iter().map(|mesh| mesh.counts.clone()).reduce(Counts::plus);
        let is_wrong = !missing.is_empty()
            || !moved.is_empty()
            || !see_through.places.is_empty()
            || meshes.iter().any(|mesh| !mesh.defects.is_empty());
        let is_whole = added.is_empty()
            && see_through.not_checked.is_none()
            && meshes.iter().all(|mesh| mesh.unchecked.is_empty());
        let verdict = match (is_wrong, is_whole) {
            (true, _) => Verdict::NotSound,
            (false, false) => Verdict::SoundAsFarAsChecked,
            (false, true) => Verdict::Sound,
        };
        CheckReport {
            before: before.display().to_string(),
            after: after.display().to_string(),
            sound: verdict == Verdict::Sound,
            verdict,
            totals: totals.unwrap_or_default(),
            meshes,
            missing,
            added,
            moved,
            see_through,
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
            sound: findings.is_sound() && findings.unchecked.is_empty(),
            counts: Counts::new(findings),
            matched_by: match findings.matching {
                Matching::Geometry => "geometry",
                _ => "order",
            },
            not_found: findings.lost,
            defects: defects.collect(),
            unchecked: unchecked.collect(),
            width: usual_width(&findings.edges),
            nearly_touching: 0,
        }
    }

    /// Adds something that was not checked.
    pub fn leave_out(&mut self, what: &str, reason: &str) {
        self.sound = false;
        self.unchecked.push(Unchecked { rule: what.into(), reason: reason.into() });
    }

    /// Adds the objects of the scene that stand otherwise.
    pub fn expect_places(&mut self, placed_otherwise: &[usize]) {
        if !placed_otherwise.is_empty() {
            self.sound = false;
            let named = placed_otherwise.iter().take(NAMED_EDGES);
            self.defects.push(Defect {
                rule: "object placed otherwise".into(),
                count: placed_otherwise.len(),
                first: named.map(|number| format!("object {number}")).collect(),
            });
        }
    }

    /// Adds what is known where the width asked for is.
    pub fn expect(&mut self, width: f32, left_without_need: &[[u32; 2]]) {
        self.counts.chamfers.asked = Some(width);
        self.width = Some(width);
        self.counts.left_without_need = Some(left_without_need.len());
        self.expect_none("hard edge left", left_without_need);
    }

    /// Adds the chamfers that are wider than asked.
    pub fn expect_widths(&mut self, too_wide: &[[u32; 2]]) {
        self.expect_none("chamfer wider than asked", too_wide);
    }

    /// Adds the chamfers of edges that were to stay hard.
    pub fn expect_hard(&mut self, chamfered: &[[u32; 2]]) {
        self.expect_none("chamfered although not selected", chamfered);
    }

    /// Adds edges of which there should be none.
    fn expect_none(&mut self, rule: &str, edges: &[[u32; 2]]) {
        if !edges.is_empty() {
            self.sound = false;
            let named = edges.iter().take(NAMED_EDGES);
            self.defects.push(Defect {
                rule: rule.into(),
                count: edges.len(),
                first: named.map(|[a, b]| format!("source edge {a}-{b}")).collect(),
            });
        }
    }
}

/// Of the length of all chamfers, so much is no wider than the usual width. Not all of it: one
/// vertex out of place is no wide chamfer.
const USUAL_SHARE: f64 = 0.9;

/// What most chamfers stay within, by their length; none without any.
fn usual_width(edges: &[MeasuredEdge]) -> Option<f32> {
    let ends = edges.iter().flat_map(|edge| {
        let open = edge.widths().into_iter().zip(edge.is_open).filter(|(_, is_open)| *is_open);
        open.map(|(width, _)| (width, f64::from(edge.length)))
    });
    let mut ends: Vec<(f32, f64)> = ends.collect();
    ends.sort_unstable_by(|one, other| one.0.total_cmp(&other.0).then(one.1.total_cmp(&other.1)));
    let mut left = ends.iter().map(|(_, length)| length).sum::<f64>() * USUAL_SHARE;
    let reaches = |(_, length): &&(f32, f64)| {
        left -= length;
        left <= 0.0
    };
    ends.iter().find(reaches).or(ends.last()).map(|(width, _)| *width)
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
        let mut edge = MeasuredEdge::default();
        edge.length = length;
        edge.distances = widths.map(|width| [width; 2]);
        edge.is_open = widths.map(|width| width > 0.0);
        edge
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
    fn a_vertex_out_of_place_is_no_wide_chamfer() {
        let edges = [edge(30.0, [0.2, 0.1]), edge(1.0, [9.0, 9.0])];
        assert_eq!(usual_width(&edges), Some(0.2));
        assert_eq!(usual_width(&edges[1..]), Some(9.0));
        assert_eq!(usual_width(&[edge(1.0, [0.0, 0.0])]), None);
    }

    #[test]
    fn self_intersections_that_nobody_asked_for_have_no_sum() {
        let known = Sides { self_intersections: Some(2), ..Sides::default() };
        assert_eq!(known.clone().plus(known.clone()).self_intersections, Some(4));
        assert_eq!(known.plus(Sides::default()).self_intersections, None);
    }
}
