//! What is checked, and what was found.

use std::fmt;

/// How many offending elements a [`Breach`] names.
const NAMED_ELEMENTS: usize = 5;

/// Something that a chamfered mesh must keep.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[non_exhaustive]
pub enum Rule {
    /// The source itself can be walked: lengths fit, indices are in range, values finite.
    Source,
    /// The same streams as the source, each with a value per vertex; counts add up.
    Streams,
    /// Indices point at vertices.
    IndexRange,
    /// Every value is finite.
    Finite,
    /// With provenance: no source vertex is missing, every source triangle is there once or in
    /// pieces that cover it, in its submesh and in its order, and the provenance points into the
    /// source. Without: there are as
    /// many triangles as in the source, those without area aside.
    Origins,
    /// New triangles name verdicts and source vertices that exist, a verdict has strip triangles
    /// where it tells of a chamfer and none elsewhere, every hard edge has a verdict, and the
    /// totals are those of the verdicts.
    Verdicts,
    /// A verdict's widths are those of the mesh: at each end the mean distance of the two sides
    /// from the line of the old edge.
    Widths,
    /// Normals are unit length where the source's are.
    Normals,
    /// Tangents are unit length, orthogonal to the normal and of handedness +1 or -1 where the
    /// source's are.
    Tangents,
    /// Colours stay in the range of the source's.
    Colors,
    /// Where each welded edge of the source is used equally often in both directions, each of the
    /// result is.
    Balance,
    /// No edge is open where the source was closed.
    Gapes,
    /// As many border loops as in the source. Where a border of the source touches a non-manifold
    /// edge or lies on another border, loops are a matter of opinion, and [`Rule::Gapes`] alone tells.
    BorderLoops,
    /// No edge has more sides in one solid than two, or than an edge of the source had where it comes
    /// from. Solids that merely touch are judged each by itself.
    NonManifold,
    /// No source triangle turns over, and no new one faces away from its vertex normals.
    Flipped,
    /// No triangle without area that had some in the source, and no new one.
    Degenerate,
    /// What was flat between hard edges stays in its plane.
    FlatFace,
    /// Where normals were all the same between hard edges, they stay so.
    FlatNormal,
    /// No hard edge where the source has none: strips and fills shade smoothly into their sides.
    HardEdges,
    /// What is no chamfer lies on the source's surface, and chamfers near it.
    Place,
    /// The surface of the source is there, but for what chamfers take.
    Covered,
    /// Normals are those of the source at the same place.
    Shading,
    /// Tangents are those of the source at the same place, and so is their handedness.
    TangentTurned,
    /// Texture coordinates are those of the source at the same place; on chamfers, near it.
    Texture,
    /// So are colours.
    ColorChanged,
    /// So are the weights of a skin.
    Skin,
    /// So are morph targets.
    Morph,
    /// So are further values of vertices.
    Attribute,
    /// What is no chamfer has the material that the source has there.
    Materials,
    /// No solid cuts through itself that did not in the source. What is closed across edges of two
    /// sides is a solid; open parts are one where they share an edge.
    SelfIntersection,
}

impl Rule {
    /// A short name in lower case, for reports.
    pub fn name(self) -> &'static str {
        match self {
            Rule::Source => "malformed source",
            Rule::Streams => "streams",
            Rule::IndexRange => "index out of range",
            Rule::Finite => "not finite",
            Rule::Origins => "origins",
            Rule::Verdicts => "verdicts",
            Rule::Widths => "width not as told",
            Rule::Normals => "normal not unit",
            Rule::Tangents => "tangent not right",
            Rule::Colors => "colour out of range",
            Rule::Balance => "unbalanced edge",
            Rule::Gapes => "edge gapes",
            Rule::BorderLoops => "border loops",
            Rule::NonManifold => "non-manifold edge",
            Rule::Flipped => "flipped triangle",
            Rule::Degenerate => "triangle without area",
            Rule::FlatFace => "flat face bent",
            Rule::FlatNormal => "flat normal bent",
            Rule::HardEdges => "new hard edge",
            Rule::Place => "off the surface",
            Rule::Covered => "surface missing",
            Rule::Shading => "normal turned",
            Rule::TangentTurned => "tangent turned",
            Rule::Texture => "texture coordinate changed",
            Rule::ColorChanged => "colour changed",
            Rule::Skin => "skin changed",
            Rule::Morph => "morph target changed",
            Rule::Attribute => "attribute changed",
            Rule::Materials => "material changed",
            Rule::SelfIntersection => "self-intersection",
        }
    }
}

/// An element of the chamfered mesh that breaks a rule.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Element {
    /// The mesh as a whole.
    Mesh,
    /// A place in the index array.
    Index(u32),
    /// A vertex.
    Vertex(u32),
    /// A triangle.
    Triangle(u32),
    /// A welded edge, by one vertex at either end.
    Edge(u32, u32),
    /// Two triangles.
    Triangles(u32, u32),
    /// A hard edge of the source, by its vertices.
    SourceEdge(u32, u32),
    /// A triangle of the source.
    SourceTriangle(u32),
}

impl fmt::Display for Element {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Element::Mesh => f.write_str("mesh"),
            Element::Index(place) => write!(f, "index {place}"),
            Element::Vertex(vertex) => write!(f, "vertex {vertex}"),
            Element::Triangle(triangle) => write!(f, "triangle {triangle}"),
            Element::Edge(a, b) => write!(f, "edge {a}-{b}"),
            Element::Triangles(a, b) => write!(f, "triangles {a} and {b}"),
            Element::SourceTriangle(triangle) => write!(f, "source triangle {triangle}"),
            Element::SourceEdge(a, b) => write!(f, "source edge {a}-{b}"),
        }
    }
}

/// A broken rule.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Breach {
    /// The rule.
    pub rule: Rule,
    /// How many elements break it.
    pub count: usize,
    /// The first few of them.
    pub first: Vec<Element>,
}

/// What can be said of one mesh, welded by bit-equal position.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct Facts {
    /// Vertices.
    pub vertices: usize,
    /// Triangles.
    pub triangles: usize,
    /// Parts that are connected across edges.
    pub components: usize,
    /// Half-edges without an opposite; 0 where the mesh is balanced.
    pub border_half_edges: usize,
    /// Loops that these form.
    pub border_loops: usize,
    /// Edges with more than two sides, but for those along which solids touch, with two each.
    pub non_manifold_edges: usize,
    /// Edges whose normals differ at either end by more than about one degree, or by what was asked for.
    pub hard_edges: usize,
    /// Triangles without area.
    pub flat_triangles: usize,
    /// Vertices whose normal is not unit length.
    pub odd_normals: usize,
    /// Vertices whose tangent is not unit length, not at a right angle to the normal, or of
    /// another handedness than +1 or -1; 0 without tangents.
    pub odd_tangents: usize,
    /// Pairs of triangles that cut each other; none where that was not asked for.
    pub self_intersections: Option<usize>,
}

/// How the source's triangles were found in the result.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Matching {
    /// The result tells.
    #[default]
    Provenance,
    /// They stand first in each submesh, in their order.
    Order,
    /// The order was changed: by where they are.
    Geometry,
}

/// A rule that could not be checked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Unchecked {
    /// The rule.
    pub rule: Rule,
    /// What stands in the way.
    pub reason: &'static str,
}

/// What [`check`](super::check) found.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Findings {
    /// The source.
    pub before: Facts,
    /// The chamfered mesh.
    pub after: Facts,
    /// The rules that the chamfered mesh breaks, each once.
    pub breaches: Vec<Breach>,
    /// Rules that could not be checked, or only in part.
    pub unchecked: Vec<Unchecked>,
    /// How source and result were brought together.
    pub matching: Matching,
    /// Triangles of the source that were not found.
    pub lost: usize,
    /// The hard edges of the source whose two sides were found, measured. Where several pairs of
    /// sides lie on one edge, as of a skin that is there twice, each is one.
    pub edges: Vec<MeasuredEdge>,
}

impl Findings {
    /// Whether no rule is broken.
    pub fn is_sound(&self) -> bool {
        self.breaches.is_empty()
    }

    /// How much is wrong or not known, to tell two explanations of one mesh apart.
    pub(super) fn defects(&self) -> usize {
        self.lost + self.breaches.iter().map(|breach| breach.count).sum::<usize>()
    }

    /// How many elements break a rule.
    pub fn count(&self, rule: Rule) -> usize {
        self.breaches.iter().find(|breach| breach.rule == rule).map_or(0, |breach| breach.count)
    }

    /// Takes a rule out: what it found is not held against the mesh.
    pub fn leave_out(&mut self, rule: Rule, reason: &'static str) {
        self.breaches.retain(|breach| breach.rule != rule);
        self.unchecked.push(Unchecked { rule, reason });
    }

    pub(super) fn note(&mut self, rule: Rule, element: Element) {
        let known = self.breaches.iter().position(|breach| breach.rule == rule);
        let place = known.unwrap_or_else(|| {
            self.breaches.push(Breach { rule, count: 0, first: Vec::new() });
            self.breaches.len() - 1
        });
        let breach = &mut self.breaches[place];
        breach.count += 1;
        if breach.first.len() < NAMED_ELEMENTS {
            breach.first.push(element);
        }
    }
}

impl fmt::Display for Findings {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        writeln!(f, "{:<22}{:>10}{:>10}", "", "before", "after")?;
        for (name, fact) in FACT_ROWS {
            let [before, after] = [&self.before, &self.after].map(fact);
            if let (Some(before), Some(after)) = (before, after) {
                writeln!(f, "{name:<22}{before:>10}{after:>10}")?;
            }
        }
        for breach in &self.breaches {
            let named: Vec<String> = breach.first.iter().map(Element::to_string).collect();
            let more = if breach.count > named.len() { ", ..." } else { "" };
            let name = breach.rule.name();
            writeln!(f, "{name:<22}{:>20}: {}{more}", breach.count, named.join(", "))?;
        }
        for Unchecked { rule, reason } in &self.unchecked {
            writeln!(f, "not checked: {}, because {reason}", rule.name())?;
        }
        if self.is_sound() { writeln!(f, "sound") } else { Ok(()) }
    }
}

type Fact = fn(&Facts) -> Option<usize>;

const FACT_ROWS: [(&str, Fact); 11] = [
    ("vertices", |facts| Some(facts.vertices)),
    ("triangles", |facts| Some(facts.triangles)),
    ("components", |facts| Some(facts.components)),
    ("border half-edges", |facts| Some(facts.border_half_edges)),
    ("border loops", |facts| Some(facts.border_loops)),
    ("non-manifold edges", |facts| Some(facts.non_manifold_edges)),
    ("hard edges", |facts| Some(facts.hard_edges)),
    ("triangles without area", |facts| Some(facts.flat_triangles)),
    ("normals not unit", |facts| Some(facts.odd_normals)),
    ("tangents not right", |facts| Some(facts.odd_tangents)),
    ("self-intersections", |facts| facts.self_intersections),
];

/// A hard edge of the source with two sides, measured in the result. Lengths are in mesh units, or in those
/// of [`Options::scale`](crate::Options::scale) where the mesh stands so.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct MeasuredEdge {
    /// The source vertices at its ends, on the side of the first triangle that uses it.
    pub vertices: [u32; 2],
    /// Its length.
    pub length: f32,
    /// `#ends by #sides`: how far the corner of the side's triangle is from the line of the old
    /// edge.
    pub distances: [[f32; 2]; 2],
    /// `#ends`: whether the two sides are at different positions there.
    pub is_open: [bool; 2],
    /// Whether one of them has come apart from another side at an edge of more than two: which two
    /// belong together is a matter of opinion there.
    pub is_parted: bool,
}

impl MeasuredEdge {
    /// At each end, the mean distance of the two sides from the line of the old edge; 0 where the sides did not come apart.
    pub fn widths(&self) -> [f32; 2] {
        [0, 1].map(|end| {
            let [one, other] = self.distances[end];
            if self.is_open[end] { (one + other) / 2.0 } else { 0.0 }
        })
    }

    /// Whether there is a chamfer in its place.
    pub fn is_chamfered(&self) -> bool {
        self.is_open != [false; 2]
    }
}
