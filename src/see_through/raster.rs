//! How far the eye sees at each sample of a view.
//!
//! From where a scene is looked at: parallel projections from directions all around.

use std::ops::Range;

use glam::{DVec2, DVec3};

use super::{SceneTriangle, wide};

/// Triangles that face the eye, their corners as [`View::project`] gives them.
#[derive(Default)]
pub struct Faces(Vec<[DVec3; 3]>);

impl Faces {
    /// Leaves out what is seen from behind or edge-on, falls between rows of samples, or is not
    /// finite.
    pub fn project(&mut self, view: &View, triangles: &[SceneTriangle]) {
        self.0.clear();
        for triangle in triangles {
            let corners = triangle.map(|corner| view.project(wide(corner)));
            let area = area(&corners);
            // Not above zero also where a corner is not finite.
            if area > 0.0 && area.is_finite() && !rows(&corners, &(0..view.size)).is_empty() {
                self.0.push(corners);
            }
        }
    }

    /// What they all cover.
    pub fn bounds(&self, size: usize) -> Rect {
        let points = self.0.as_flattened().iter().map(|corner| corner.truncate());
        let start = (DVec2::INFINITY, DVec2::NEG_INFINITY);
        let (low, high) = points.fold(start, |(low, high), p| (low.min(p), high.max(p)));
        let all = 0..size;
        let range = |low: f64, high: f64| first_after(low, &all)..first_after(high, &all);
        Rect { columns: range(low.x, high.x), rows: range(low.y, high.y) }
    }
}

/// Twice the area on the picture; positive where seen from the front.
fn area([a, b, c]: &[DVec3; 3]) -> f64 {
    (b - a).truncate().perp_dot((c - a).truncate())
}

/// The lowest corner first.
fn by_height(&[a, b, c]: &[DVec3; 3]) -> [DVec3; 3] {
    let [a, b] = if b.y < a.y { [b, a] } else { [a, b] };
    let [b, c] = if c.y < b.y { [c, b] } else { [b, c] };
    let [a, b] = if b.y < a.y { [b, a] } else { [a, b] };
    [a, b, c]
}

/// The rows whose middles lie between the lowest and the highest corner.
fn rows([a, b, c]: &[DVec3; 3], within: &Range<usize>) -> Range<usize> {
    let (low, high) = (a.y.min(b.y).min(c.y), a.y.max(b.y).max(c.y));
    first_after(low, within)..first_after(high, within)
}

/// The first of a range of samples whose middle lies after a coordinate; its end if none does.
/// What ends at a coordinate and what begins there share no sample and leave none out.
fn first_after(coordinate: f64, range: &Range<usize>) -> usize {
    let [first, last] = [range.start, range.end].map(|sample| f64::from(sample as u32));
    let within = if coordinate > first { coordinate } else { first };
    let within = if within < last { within } else { last };
    (within + ROUNDER).to_bits() as u32 as usize
}

/// Added to a number, this leaves the nearest whole number in the lowest bits. Drawing rounds more
/// often than anything else, and this takes a third of the time of a cast.
const ROUNDER: f64 = (3_u64 << 51) as f64;

/// A part of a view.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Rect {
    pub columns: Range<usize>,
    pub rows: Range<usize>,
}

impl Rect {
    pub fn is_empty(&self) -> bool {
        self.columns.is_empty() || self.rows.is_empty()
    }

    /// With so many samples more to each side, as far as the view goes.
    pub fn widened(&self, by: usize, size: usize) -> Rect {
        let widened = |range: &Range<usize>| {
            range.start.saturating_sub(by)..range.end.saturating_add(by).min(size)
        };
        Rect { columns: widened(&self.columns), rows: widened(&self.rows) }
    }

    /// The least one that holds both.
    pub fn around(&self, other: &Rect) -> Rect {
        let around = |one: &Range<usize>, other: &Range<usize>| match one.is_empty() {
            true => other.clone(),
            false if other.is_empty() => one.clone(),
            false => one.start.min(other.start)..one.end.max(other.end),
        };
        Rect {
            columns: around(&self.columns, &other.columns),
            rows: around(&self.rows, &other.rows),
        }
    }

    /// What is in both.
    pub fn shared(&self, other: &Rect) -> Rect {
        let shared = |one: &Range<usize>, other: &Range<usize>| {
            let start = one.start.max(other.start);
            start..one.end.min(other.end).max(start)
        };
        Rect {
            columns: shared(&self.columns, &other.columns),
            rows: shared(&self.rows, &other.rows),
        }
    }
}

/// A depth for each sample of a part of a view.
#[derive(Default)]
pub struct Depths {
    pub rect: Rect,
    /// `#rows by #columns`: how far behind the scene's middle the nearest front face lies;
    /// infinite where there is none.
    values: Vec<f32>,
    /// `#columns`: 0, 1, 2 and so on.
    steps: Vec<f32>,
}

impl Depths {
    /// Begins a new picture, in the memory of the last.
    pub fn clear(&mut self, rect: Rect) {
        self.begin(rect);
        self.values.resize(self.rect.columns.len() * self.rect.rows.len(), f32::INFINITY);
    }

    /// The same, with what a larger picture shows.
    pub fn copy(&mut self, from: &Depths, rect: Rect) {
        self.begin(rect);
        for row in self.rect.rows.clone() {
            self.values.extend_from_slice(from.row(row, self.rect.columns.clone()));
        }
    }

    fn begin(&mut self, rect: Rect) {
        self.values.clear();
        self.steps.clear();
        self.steps.extend((0..rect.columns.len()).map(|step| step as f32));
        self.rect = rect;
    }

    pub fn at(&self, column: usize, row: usize) -> f32 {
        self.row(row, column..column + 1)[0]
    }

    /// A part of a row.
    pub fn row(&self, row: usize, columns: Range<usize>) -> &[f32] {
        &self.values[self.place(columns.start, row)..][..columns.len()]
    }

    fn place(&self, column: usize, row: usize) -> usize {
        (row - self.rect.rows.start) * self.rect.columns.len() + column - self.rect.columns.start
    }

    pub fn draw(&mut self, faces: &Faces) {
        faces.0.iter().for_each(|corners| self.draw_face(corners));
    }

    fn draw_face(&mut self, corners: &[DVec3; 3]) {
        let plane = Plane::through(corners);
        let by_height = by_height(corners);
        let [low, middle, high] = by_height;
        let long = Side::new(low, high);
        let is_left = area(&by_height) < 0.0;
        for (from, to) in [(low, middle), (middle, high)] {
            let short = Side::new(from, to);
            let sides = if is_left { [short, long] } else { [long, short] };
            self.draw_between(sides, rows(&[from, from, to], &self.rect.rows), &plane);
        }
    }

    fn draw_between(&mut self, [left, right]: [Side; 2], rows: Range<usize>, plane: &Plane) {
        let Rect { columns, rows: all } = &self.rect;
        let lines = self.values.chunks_exact_mut(columns.len()).skip(rows.start - all.start);
        for (row, line) in rows.zip(lines) {
            let y = middle(row);
            let [start, end] = [left, right].map(|side| first_after(side.at(y), columns));
            if start < end {
                let depth = plane.at(middle(start), y) as f32;
                let line = &mut line[start - columns.start..end - columns.start];
                draw_depths(line, &self.steps, depth, plane.along_x as f32);
            }
        }
    }
}

fn middle(sample: usize) -> f64 {
    f64::from(sample as u32) + 0.5
}

/// Where a triangle is nearer than what was seen; its depth at the first sample and from each to
/// the next.
fn draw_depths(line: &mut [f32], steps: &[f32], first: f32, slope: f32) {
    for (value, step) in line.iter_mut().zip(steps) {
        let depth = step * slope + first;
        *value = if depth < *value { depth } else { *value };
    }
}

/// A side of a triangle: where it is in each row.
#[derive(Clone, Copy)]
struct Side {
    start: DVec2,
    /// Columns for each row.
    slope: f64,
}

impl Side {
    /// From the lower to the higher end. So it is the same, bit for bit, for both triangles of an
    /// edge, and no sample falls between them.
    fn new(low: DVec3, high: DVec3) -> Side {
        Side { start: low.truncate(), slope: (high.x - low.x) / (high.y - low.y) }
    }

    fn at(&self, y: f64) -> f64 {
        self.start.x + (y - self.start.y) * self.slope
    }
}

/// The depth of a triangle as a function of the place on the picture.
struct Plane {
    start: DVec3,
    along_x: f64,
    along_y: f64,
}

impl Plane {
    fn through(corners: &[DVec3; 3]) -> Plane {
        let [a, b, c] = *corners;
        let ([b, c], area) = ([b - a, c - a], area(corners));
        Plane {
            start: a,
            along_x: (b.z * c.y - c.z * b.y) / area,
            along_y: (c.z * b.x - b.z * c.x) / area,
        }
    }

    fn at(&self, x: f64, y: f64) -> f64 {
        self.start.z + (x - self.start.x) * self.along_x + (y - self.start.y) * self.along_y
    }
}

/// From the scene to the eye, not yet unit length: the sides, edges and corners of a cube, so that
/// neighbours are some 45 degrees apart. The sides come first.
pub const DIRECTIONS: [[f64; 3]; 26] = [
    [1.0, 0.0, 0.0],
    [-1.0, 0.0, 0.0],
    [0.0, 1.0, 0.0],
    [0.0, -1.0, 0.0],
    [0.0, 0.0, 1.0],
    [0.0, 0.0, -1.0],
    [1.0, 1.0, 1.0],
    [-1.0, 1.0, 1.0],
    [1.0, -1.0, 1.0],
    [-1.0, -1.0, 1.0],
    [1.0, 1.0, -1.0],
    [-1.0, 1.0, -1.0],
    [1.0, -1.0, -1.0],
    [-1.0, -1.0, -1.0],
    [1.0, 1.0, 0.0],
    [-1.0, 1.0, 0.0],
    [1.0, -1.0, 0.0],
    [-1.0, -1.0, 0.0],
    [1.0, 0.0, 1.0],
    [-1.0, 0.0, 1.0],
    [1.0, 0.0, -1.0],
    [-1.0, 0.0, -1.0],
    [0.0, 1.0, 1.0],
    [0.0, -1.0, 1.0],
    [0.0, 1.0, -1.0],
    [0.0, -1.0, -1.0],
];

/// Models stand along the axes: seen exactly along one, half of their faces would be lines. So all
/// directions are turned by this much, towards no axis.
const ASKEW: [f64; 3] = [0.13, 0.29, -0.21];

/// Free around the scene, so that an outline has its outside.
const MARGIN: f64 = 1.02;

/// The sphere around a scene.
pub struct Frame {
    middle: DVec3,
    radius: f64,
}

impl Frame {
    /// None where nothing has an extent.
    pub fn around(triangles: &[SceneTriangle]) -> Option<Frame> {
        let points = || triangles.as_flattened().iter().map(|&p| wide(p)).filter(|p| p.is_finite());
        let start = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        let (low, high) = points().fold(start, |(low, high), p| (low.min(p), high.max(p)));
        let middle = (low + high) / 2.0;
        let radius = points().map(|point| point.distance_squared(middle)).fold(0.0, f64::max);
        let radius = radius.sqrt();
        (radius > 0.0 && radius.is_finite()).then_some(Frame { middle, radius })
    }

    pub fn views(&self, count: usize, size: usize) -> impl Iterator<Item = View> {
        DIRECTIONS.iter().take(count).map(move |&direction| {
            let direction = DVec3::from(direction).normalize();
            let toward_eye = (direction + direction.cross(DVec3::from(ASKEW))).normalize();
            let right = toward_eye.any_orthonormal_vector();
            let sample_size = 2.0 * self.radius * MARGIN / size as f64;
            View {
                middle: self.middle,
                toward_eye,
                samples_right: right / sample_size,
                samples_up: toward_eye.cross(right) / sample_size,
                size,
                sample_size,
            }
        })
    }
}

/// A square picture seen along a direction.
pub struct View {
    middle: DVec3,
    pub toward_eye: DVec3,
    /// To the right on the picture and up; their length is one over that of a sample.
    samples_right: DVec3,
    samples_up: DVec3,
    /// Samples per side.
    pub size: usize,
    /// In scene units.
    pub sample_size: f64,
}

impl View {
    /// Samples from the left, samples from the bottom, and how far behind the middle, in scene
    /// units.
    pub fn project(&self, point: DVec3) -> DVec3 {
        let (from, half) = (point - self.middle, self.size as f64 / 2.0);
        DVec3::new(
            from.dot(self.samples_right) + half,
            from.dot(self.samples_up) + half,
            -from.dot(self.toward_eye),
        )
    }

    /// What is seen at a sample, at a depth.
    pub fn place(&self, column: usize, row: usize, depth: f64) -> DVec3 {
        let half = self.size as f64 / 2.0;
        let along = |place: usize| (place as f64 + 0.5 - half) * self.sample_size.powi(2);
        self.middle + self.samples_right * along(column) + self.samples_up * along(row)
            - self.toward_eye * depth
    }
}
