//! Texture charts of a source mesh and the ground they cover, found the obvious way.

use std::collections::HashMap;

use chamfer::{Mesh, Uv};

/// UV values that differ by less than this share of their size are one.
const EQUAL_UV: f32 = 1e-6;

/// How far arithmetic takes a mean of UV values past them, as a share of their size.
const ROUNDING: f64 = 1e-7;

/// Cells along each side of a footprint's grid.
const CELLS: usize = 24;

/// How far around itself a triangle is looked for, as a share of its chart's size: more than any
/// tolerance that is asked for.
const REACH: f64 = 1e-3;

/// What positions are one point: their bits, with one zero.
pub type Key = [u32; 3];

pub fn key(position: [f32; 3]) -> Key {
    position.map(|along| (along + 0.0).to_bits())
}

pub type Point = [f64; 2];

/// The charts of one UV channel.
pub struct Charts<'a> {
    mesh: Mesh<'a>,
    uv: Uv<'a>,
    /// `#triangles`.
    chart_of: Vec<usize>,
    /// `#charts` by their first triangle.
    footprints: HashMap<usize, Footprint>,
    /// The triangles on each edge, lower key first.
    on_edge: HashMap<[Key; 2], Vec<usize>>,
    /// The triangles at each point.
    at_point: HashMap<Key, Vec<usize>>,
    /// Of the points that only rounding has set apart, the one that stands for each.
    meant: HashMap<Key, Key>,
}

impl<'a> Charts<'a> {
    pub fn new(mesh: Mesh<'a>, channel: usize) -> Charts<'a> {
        let uv = mesh.uvs[channel];
        let triangles = mesh.indices.len() / 3;
        let mut charts = Charts {
            mesh,
            uv,
            chart_of: (0..triangles).collect(),
            footprints: HashMap::new(),
            on_edge: HashMap::new(),
            at_point: HashMap::new(),
            meant: set_apart_by_rounding(mesh.positions),
        };
        charts.index();
        charts.join();
        for triangle in 0..triangles {
            let chart = charts.chart_of(triangle);
            let points = charts.uvs(triangle);
            charts.footprints.entry(chart).or_default().triangles.push(points);
        }
        charts.footprints.values_mut().for_each(Footprint::prepare);
        charts
    }

    fn key(&self, position: [f32; 3]) -> Key {
        let own = key(position);
        self.meant.get(&own).copied().unwrap_or(own)
    }

    fn corners(&self, triangle: usize) -> [usize; 3] {
        [0, 1, 2].map(|k| self.mesh.indices[3 * triangle + k] as usize)
    }

    fn index(&mut self) {
        for triangle in 0..self.chart_of.len() {
            let keys = self.corners(triangle).map(|v| self.key(self.mesh.positions[v]));
            for k in 0..3 {
                self.at_point.entry(keys[k]).or_default().push(triangle);
                let ends = [keys[k].min(keys[(k + 1) % 3]), keys[k].max(keys[(k + 1) % 3])];
                self.on_edge.entry(ends).or_default().push(triangle);
            }
        }
    }

    /// Joins triangles that have an edge in common with the same UVs at both its ends.
    fn join(&mut self) {
        let on_edge = std::mem::take(&mut self.on_edge);
        for (ends, triangles) in &on_edge {
            for (place, &one) in triangles.iter().enumerate() {
                for &other in &triangles[place + 1..] {
                    if ends.iter().all(|&end| self.agree(one, other, end)) {
                        let (a, b) = (self.chart_of(one), self.chart_of(other));
                        self.chart_of[a.max(b)] = a.min(b);
                    }
                }
            }
        }
        self.on_edge = on_edge;
    }

    fn agree(&self, one: usize, other: usize, at: Key) -> bool {
        let value = |triangle: usize| {
            let corners = self.corners(triangle);
            let vertex = corners.into_iter().find(|&v| self.key(self.mesh.positions[v]) == at)?;
            let components = self.uv.components as usize;
            Some(&self.uv.values[vertex * components..][..components])
        };
        let (Some(a), Some(b)) = (value(one), value(other)) else { return false };
        a.iter().zip(b).all(|(a, b)| (a - b).abs() <= EQUAL_UV * a.abs().max(1.0))
    }

    pub fn chart_of(&self, mut triangle: usize) -> usize {
        while self.chart_of[triangle] != triangle {
            triangle = self.chart_of[triangle];
        }
        triangle
    }

    pub fn footprint(&self, triangle: usize) -> &Footprint {
        &self.footprints[&self.chart_of(triangle)]
    }

    pub fn uvs(&self, triangle: usize) -> [Point; 3] {
        self.corners(triangle).map(|vertex| uv_at(self.uv, vertex))
    }

    /// UV area over surface area of a source triangle, signed; none where it has no area.
    pub fn density(&self, triangle: usize) -> Option<f64> {
        let area = area(self.corners(triangle).map(|v| self.mesh.positions[v]));
        (area > 0.0).then(|| signed(self.uvs(triangle)) / area)
    }

    /// Whether a source triangle has more area on the texture than rounding its UVs explains.
    pub fn has_area(&self, triangle: usize) -> bool {
        let points = self.uvs(triangle);
        let size = points.iter().flatten().fold(0.0, |size: f64, along| size.max(along.abs()));
        let length = |a: Point, b: Point| (a[0] - b[0]).hypot(a[1] - b[1]);
        let longest = (0..3).map(|k| length(points[k], points[(k + 1) % 3])).fold(0.0, f64::max);
        2.0 * signed(points).abs() > 1e-6 * longest * size
    }

    pub fn on_edge(&self, one: [f32; 3], other: [f32; 3]) -> &[usize] {
        let (a, b) = (self.key(one), self.key(other));
        self.on_edge.get(&[a.min(b), a.max(b)]).map_or(&[], Vec::as_slice)
    }

    /// The triangles with a side that lies along a segment, or a part of it: those of both sides of an
    /// edge that is one on one side and several on the other.
    pub fn along(&self, one: [f32; 3], other: [f32; 3]) -> Vec<usize> {
        let lies_along = |&triangle: &usize| {
            let at = self.corners(triangle).map(|v| wide(self.mesh.positions[v]));
            (0..3).any(|k| overlaps([at[k], at[(k + 1) % 3]], [one, other].map(wide)))
        };
        (0..self.chart_of.len()).filter(lies_along).collect()
    }

    pub fn at_point(&self, point: [f32; 3]) -> &[usize] {
        self.at_point.get(&self.key(point)).map_or(&[], Vec::as_slice)
    }
}

pub fn uv_at(uv: Uv, vertex: usize) -> Point {
    let first = vertex * uv.components as usize;
    [f64::from(uv.values[first]), f64::from(uv.values[first + 1])]
}

/// Positions that are nearer to each other than single precision tells at the largest of them, each
/// with the first of its place: faces that were modelled to meet there do.
fn set_apart_by_rounding(positions: &[[f32; 3]]) -> HashMap<Key, Key> {
    let largest =
        positions.as_flattened().iter().fold(0.0_f32, |most, along| most.max(along.abs()));
    let near = f64::from(largest) * 2.0 * f64::from(f32::EPSILON);
    let cell = |at: [f32; 3]| at.map(|along| (f64::from(along) / (4.0 * near)).round() as i64);
    let mut cells: HashMap<[i64; 3], Vec<[f32; 3]>> = HashMap::new();
    let mut meant = HashMap::new();
    for &at in positions {
        let around = (0..27).map(|k| [k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1]);
        let own = cell(at);
        let around = around.map(|by| [0, 1, 2].map(|k| own[k] + by[k]));
        let mut known = around.filter_map(|cell| cells.get(&cell)).flatten();
        match known.find(|other| wide(**other).distance(wide(at)) <= near) {
            Some(&first) if key(first) != key(at) => {
                meant.insert(key(at), key(first));
            }
            Some(_) => {}
            None => cells.entry(own).or_default().push(at),
        }
    }
    meant
}

fn wide(point: [f32; 3]) -> glam::DVec3 {
    glam::DVec3::from(point.map(f64::from))
}

/// What is nearer to a segment, as a share of its length, lies on it.
const ON_SEGMENT: f64 = 1e-4;

/// Whether a side lies on a segment, or beyond its ends in line with it, and shares more than a point.
fn overlaps(side: [glam::DVec3; 2], [from, to]: [glam::DVec3; 2]) -> bool {
    let (along, near) = ((to - from).normalize_or_zero(), ON_SEGMENT * from.distance(to));
    let [one, other] = side.map(|end| (end - from).dot(along));
    let shared = one.max(other).min(from.distance(to)) - one.min(other).max(0.0);
    shared > near && side.iter().all(|end| (*end - from).cross(along).length() <= near)
}

/// Area of a triangle in space.
pub fn area(points: [[f32; 3]; 3]) -> f64 {
    let [a, b, c] = points.map(|p| glam::DVec3::from(p.map(f64::from)));
    (b - a).cross(c - a).length() / 2.0
}

/// Area of a triangle in the texture, negative where it is mirrored.
pub fn signed([a, b, c]: [Point; 3]) -> f64 {
    ((b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])) / 2.0
}

/// The ground that a chart covers.
#[derive(Default)]
pub struct Footprint {
    triangles: Vec<[Point; 3]>,
    low: Point,
    high: Point,
    /// The triangles that reach into each cell of a grid over the box.
    cells: Vec<Vec<u32>>,
}

impl Footprint {
    pub fn size(&self) -> f64 {
        let [w, h] = [0, 1].map(|k| self.high[k] - self.low[k]);
        w.hypot(h)
    }

    fn prepare(&mut self) {
        let points = || self.triangles.iter().flatten();
        self.low = [0, 1].map(|k| points().map(|p| p[k]).fold(f64::INFINITY, f64::min));
        self.high = [0, 1].map(|k| points().map(|p| p[k]).fold(f64::NEG_INFINITY, f64::max));
        let mut cells = vec![Vec::new(); CELLS * CELLS];
        for (place, triangle) in self.triangles.iter().enumerate() {
            let low = [0, 1].map(|k| triangle.iter().map(|p| p[k]).fold(f64::INFINITY, f64::min));
            let high =
                [0, 1].map(|k| triangle.iter().map(|p| p[k]).fold(f64::NEG_INFINITY, f64::max));
            let ([x0, y0], [x1, y1]) = (self.cell(low, -REACH), self.cell(high, REACH));
            for y in y0..=y1 {
                (x0..=x1).for_each(|x| cells[y * CELLS + x].push(place as u32));
            }
        }
        self.cells = cells;
    }

    fn cell(&self, point: Point, shift: f64) -> [usize; 2] {
        [0, 1].map(|k| {
            let shifted = point[k] + shift * self.size();
            let share = (shifted - self.low[k]) / (self.high[k] - self.low[k]).max(1e-30);
            (share * CELLS as f64).clamp(0.0, CELLS as f64 - 1.0) as usize
        })
    }

    /// Whether a point lies on the chart, or no farther off than a share of its size.
    pub fn covers(&self, point: Point, tolerance: f64) -> bool {
        // A chart of one texel has no size, but rounding has.
        let rounding = point[0].abs().max(point[1].abs()) * ROUNDING;
        let near = tolerance * self.size() + rounding;
        let [x, y] = self.cell(point, 0.0);
        self.cells[y * CELLS + x]
            .iter()
            .any(|&place| distance(point, self.triangles[place as usize]) <= near)
    }

    /// How far a point is from the chart, as a share of its size.
    pub fn distance(&self, point: Point) -> f64 {
        let nearest = self.triangles.iter().map(|&t| distance(point, t)).fold(f64::MAX, f64::min);
        nearest / self.size().max(1e-30)
    }
}

fn distance(point: Point, triangle: [Point; 3]) -> f64 {
    let [a, b, c] = triangle;
    let turns = [signed([a, b, point]), signed([b, c, point]), signed([c, a, point])];
    let has_area = signed(triangle) != 0.0;
    if has_area && (turns.iter().all(|t| *t >= 0.0) || turns.iter().all(|t| *t <= 0.0)) {
        return 0.0;
    }
    [[a, b], [b, c], [c, a]].into_iter().map(|side| to_side(point, side)).fold(f64::MAX, f64::min)
}

fn to_side(p: Point, [a, b]: [Point; 2]) -> f64 {
    let (along, to) = ([b[0] - a[0], b[1] - a[1]], [p[0] - a[0], p[1] - a[1]]);
    let length = along[0] * along[0] + along[1] * along[1];
    let share = ((to[0] * along[0] + to[1] * along[1]) / length.max(1e-300)).clamp(0.0, 1.0);
    (to[0] - along[0] * share).hypot(to[1] - along[1] * share)
}
