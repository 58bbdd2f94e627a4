//! Hard edges as lines over a picture, coloured by what became of them.

use chamfer::{Chamfered, MeshBuffers, Outcome, TriangleKind};
use glam::{Mat4, Vec3};

use crate::preview::Line;

/// Chamfered at full width: green.
const FULL: [u8; 3] = [64, 200, 96];
/// Narrowed: amber.
const NARROWED: [u8; 3] = [255, 176, 32];
/// Left as they were: red.
const SKIPPED: [u8; 3] = [240, 64, 64];

/// How many hard edges of a model there are of each colour.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Legend {
    full: u32,
    narrowed: u32,
    skipped: u32,
}

impl Legend {
    /// Counts the edges of a mesh.
    pub fn add(&mut self, result: &Chamfered) {
        self.full += result.totals.chamfered;
        self.narrowed += result.totals.narrowed;
        self.skipped += result.totals.skipped.total();
    }

    /// For the title of a picture.
    pub fn text(&self) -> String {
        let Legend { full, narrowed, skipped } = self;
        format!("green {full} full, amber {narrowed} narrowed, red {skipped} skipped")
    }
}

/// The hard edges where they were.
pub fn before(source: &MeshBuffers, result: &Chamfered, transform: [[f32; 4]; 4]) -> Vec<Line> {
    let ends = result.verdicts.iter().map(|verdict| ends(source, verdict.vertices));
    lines(result, ends, transform)
}

/// Along the middle of the strips that took their place; where there is none, where they were.
pub fn after(source: &MeshBuffers, result: &Chamfered, transform: [[f32; 4]; 4]) -> Vec<Line> {
    let mut strips = vec![Vec::new(); result.verdicts.len()];
    for (triangle, strip) in result.mesh.indices.chunks_exact(3).zip(&result.triangle_sources) {
        if strip.kind == TriangleKind::Edge {
            for &vertex in triangle {
                let point = Vec3::from(result.mesh.positions[vertex as usize]);
                let points: &mut Vec<Vec3> = &mut strips[strip.index as usize];
                if !points.contains(&point) {
                    points.push(point);
                }
            }
        }
    }
    let ends = result
        .verdicts
        .iter()
        .zip(strips)
        .map(|(verdict, strip)| middle(ends(source, verdict.vertices), &strip));
    lines(result, ends, transform)
}

fn ends(source: &MeshBuffers, vertices: [u32; 2]) -> [Vec3; 2] {
    vertices.map(|vertex| Vec3::from(source.positions[vertex as usize]))
}

/// At each end of an edge the mean of the strip's points on that half of it.
fn middle(edge: [Vec3; 2], strip: &[Vec3]) -> [Vec3; 2] {
    let halfway = (edge[0] + edge[1]) / 2.0;
    let is_second = |point: &Vec3| (*point - halfway).dot(edge[1] - edge[0]) > 0.0;
    [false, true].map(|second| {
        let points = strip.iter().filter(|point| is_second(point) == second);
        let count = points.clone().count();
        if count == 0 { edge[usize::from(second)] } else { points.sum::<Vec3>() / count as f32 }
    })
}

fn lines(
    result: &Chamfered,
    ends: impl Iterator<Item = [Vec3; 2]>,
    transform: [[f32; 4]; 4],
) -> Vec<Line> {
    let transform = Mat4::from_cols_array_2d(&transform);
    let color = |outcome| match outcome {
        Outcome::Full => FULL,
        Outcome::Narrowed => NARROWED,
        Outcome::Skipped => SKIPPED,
    };
    let line = |(verdict, ends): (&chamfer::EdgeVerdict, [Vec3; 2])| Line {
        ends: ends.map(|end| transform.transform_point3(end).to_array()),
        color: color(verdict.outcome),
    };
    result.verdicts.iter().zip(ends).map(line).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use chamfer::{Options, Width, chamfer, shapes};
    use chamfer_formats::IDENTITY;

    #[test]
    fn lines_follow_the_strips() {
        let cube = shapes::plain_cube(1.0);
        let options = Options::default().with_width(Width::Units(0.1));
        let result = chamfer(&cube.as_mesh(), &options).unwrap();
        let [old, new] = [before, after].map(|lines| lines(&cube, &result, IDENTITY));
        assert_eq!((old.len(), new.len()), (12, 12));
        for (old, new) in old.iter().zip(&new) {
            assert_eq!((old.color, new.color), (FULL, FULL));
            // In the middle between two faces, and shorter by the width at both ends.
            let [from, to] =
                [0, 1].map(|end| Vec3::from(old.ends[end]).abs() - Vec3::from(new.ends[end]).abs());
            let mut expected = [0.05, 0.05, 0.1];
            for moved in [from, to] {
                let mut moved = moved.to_array();
                moved.sort_by(f32::total_cmp);
                expected.sort_by(f32::total_cmp);
                assert!(moved.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-6));
            }
        }
    }

    #[test]
    fn edges_that_are_left_are_red_and_stay() {
        let cube = shapes::plain_cube(1.0);
        let mut result = chamfer(&cube.as_mesh(), &Options::default()).unwrap();
        result.triangle_sources.clear();
        result.verdicts.iter_mut().for_each(|verdict| verdict.outcome = Outcome::Skipped);
        let [old, new] = [before, after].map(|lines| lines(&cube, &result, IDENTITY));
        assert_eq!(old, new);
        assert!(old.iter().all(|line| line.color == SKIPPED));
    }
}
