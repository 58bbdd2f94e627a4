//! Hard edges as lines over a picture, coloured by what became of them.

use chamfer::{Chamfered, EdgeVerdict, MeshBuffers, Outcome, TriangleKind};
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
    let ends = result.verdicts.iter().map(|verdict| (verdict, ends(source, verdict.vertices)));
    lines(ends, transform)
}

/// Along both rims of the strips that took their place, which stay visible between; where there is
/// none, where they were.
pub fn after(source: &MeshBuffers, result: &Chamfered, transform: [[f32; 4]; 4]) -> Vec<Line> {
    let mut strips = vec![Vec::new(); result.verdicts.len()];
    for (triangle, strip) in result.mesh.indices.chunks_exact(3).zip(&result.triangle_sources) {
        if strip.kind == TriangleKind::Edge {
            let point =
                |corner: usize| Vec3::from(result.mesh.positions[triangle[corner] as usize]);
            strips[strip.index as usize].push([0, 1, 2].map(point));
        }
    }
    let rimmed = result.verdicts.iter().zip(strips).flat_map(|(verdict, strip)| {
        let edge = ends(source, verdict.vertices);
        let rims = rims(edge, &strip);
        rims.into_iter().map(move |rim| (verdict, rim))
    });
    lines(rimmed, transform)
}

fn ends(source: &MeshBuffers, vertices: [u32; 2]) -> [Vec3; 2] {
    vertices.map(|vertex| Vec3::from(source.positions[vertex as usize]))
}

/// The two sides of a strip that run along its edge; the edge itself where there is no strip.
fn rims(edge: [Vec3; 2], strip: &[[Vec3; 3]]) -> Vec<[Vec3; 2]> {
    let side = |triangle: &[Vec3; 3], first: usize| [triangle[first], triangle[(first + 1) % 3]];
    let all = || strip.iter().flat_map(|triangle| [0, 1, 2].map(|first| side(triangle, first)));
    // What two triangles share is the diagonal.
    let is_shared = |[a, b]: &[Vec3; 2]| all().any(|[c, d]| [c, d] == [*b, *a]);
    let mut sides: Vec<[Vec3; 2]> = all().filter(|side| !is_shared(side)).collect();
    let along = |[a, b]: &[Vec3; 2]| (*b - *a).dot(edge[1] - edge[0]).abs();
    sides.sort_by(|a, b| along(b).total_cmp(&along(a)));
    sides.truncate(2);
    if sides.is_empty() { vec![edge] } else { sides }
}

fn lines<'a>(
    ends: impl Iterator<Item = (&'a EdgeVerdict, [Vec3; 2])>,
    transform: [[f32; 4]; 4],
) -> Vec<Line> {
    let transform = Mat4::from_cols_array_2d(&transform);
    let color = |outcome| match outcome {
        Outcome::Full => FULL,
        Outcome::Narrowed => NARROWED,
        Outcome::Skipped => SKIPPED,
    };
    let line = |(verdict, ends): (&EdgeVerdict, [Vec3; 2])| Line {
        ends: ends.map(|end| transform.transform_point3(end).to_array()),
        color: color(verdict.outcome),
    };
    ends.map(line).collect()
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
        assert_eq!((old.len(), new.len()), (12, 24));
        for (number, new) in new.iter().enumerate() {
            let old = &old[number / 2];
            assert_eq!((old.color, new.color), (FULL, FULL));
            // Along one axis: no diagonal of a strip.
            let along = (0..3).filter(|&axis| new.ends[0][axis] != new.ends[1][axis]).count();
            assert_eq!(along, 1);
            // On one of two faces, pulled by the width, and shorter by it at both ends.
            for end in 0..2 {
                let place = |line: &Line| Vec3::from(line.ends[end]).abs();
                let mut moved = (place(old) - place(new)).to_array();
                moved.sort_by(f32::total_cmp);
                let expected = [0.0, 0.1, 0.1];
                assert!(moved.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-6), "{moved:?}");
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
