//! Faces: the normal of each triangle's plane.
//!
//! A triangle that is hardly more than a line has none of its own: exporters leave such triangles
//! where an edge meets the middle of another. It lies in the plane of a neighbour, across its
//! longest soft side, and borrows the normal from there.

use glam::DVec3;

use crate::breaks::is_hard;
use crate::error::Error;
use crate::ids::{Corner, IdVec, Triangle};
use crate::line::Line;
use crate::math::{area_vector, unit};
use crate::threads::Threads;
use crate::tolerance::LINE_HEIGHT;
use crate::topology::Topology;
use crate::view::{View, resolution_of};
use crate::watch::Watch;

/// Lines lie next to lines where an edge meets several others; more than so many in a row are
/// broken geometry.
const MOST_LINES: usize = 4;

pub struct Faces {
    /// `#triangles`: unit, or zero where nothing is known.
    pub normal: IdVec<Triangle, DVec3>,
    /// `#triangles`: for a line, the half-edge of the triangle whose normal it has.
    pub lender: IdVec<Triangle, Corner>,
}

impl Faces {
    /// Whether the triangle is hardly more than a line.
    pub fn is_line(&self, triangle: Triangle) -> bool {
        self.lender[triangle].is_some()
    }

    /// Lays triangles into planes that are known.
    pub fn lay(&mut self, planes: &[(Triangle, DVec3)]) {
        for &(triangle, normal) in planes {
            self.normal[triangle] = normal;
        }
    }
}

/// # Errors
/// [`Error::Cancelled`] where the watch stops it.
pub fn faces(
    view: &View,
    topology: &Topology,
    (threads, watch): (&Threads, &dyn Watch),
) -> Result<Faces, Error> {
    let triangles = view.corner_count() / 3;
    let mut faces = Faces {
        normal: threads.map(triangles, watch, |triangle| own_normal(view, triangle))?,
        lender: IdVec::filled(Corner::NONE, triangles),
    };
    let is_unknown = |&triangle: &Triangle| faces.normal[triangle] == DVec3::ZERO;
    let mut lines: Vec<Triangle> = view.triangles().filter(is_unknown).collect();
    for _ in 0..MOST_LINES {
        let found: Vec<(Triangle, Corner)> = lines
            .iter()
            .filter_map(|&line| Some((line, lender(view, topology, &faces, line)?)))
            .collect();
        for &(line, lender) in &found {
            faces.lender[line] = lender;
            faces.normal[line] = faces.normal[lender.triangle()];
        }
        lines.retain(|&line| faces.normal[line] == DVec3::ZERO);
        watch.worked(found.len())?;
    }
    Ok(faces)
}

/// Zero for a line.
pub fn own_normal(view: &View, triangle: Triangle) -> DVec3 {
    let (area, longest) = measures(view, triangle);
    let is_line = area.length() <= longest * view.resolution * LINE_HEIGHT;
    if is_line { DVec3::ZERO } else { unit(area) }
}

/// Whether a line would be none if its mesh stood at the origin: out here its coordinates are too
/// coarse to tell.
pub fn is_blurred(view: &View, line: Triangle) -> bool {
    let (area, longest) = measures(view, line);
    area.length() > longest * resolution_of(view.extent) * LINE_HEIGHT
}

/// The side of a line between whose ends its third corner stands.
pub fn long_side(view: &View, line: Triangle) -> Option<Corner> {
    let holds =
        |side: &Corner| Line::new(view, *side).holds(view.position_at(side.prev()), view.reach());
    line.corners().into_iter().find(holds)
}

/// A triangle's area vector, and its longest side.
fn measures(view: &View, triangle: Triangle) -> (DVec3, f64) {
    let points = view.triangle(triangle);
    let [a, b, c] = points;
    let longer = |one: f64, other: f64| if one > other { one } else { other };
    let longest =
        longer(a.distance_squared(b), longer(b.distance_squared(c), c.distance_squared(a)));
    (area_vector(points), longest.sqrt())
}

/// The half-edge behind a line's longest soft side that has a face with a normal.
fn lender(view: &View, topology: &Topology, faces: &Faces, line: Triangle) -> Option<Corner> {
    let length = |side: Corner| view.position_at(side).distance(view.position_at(side.next()));
    let can_lend = |side: &Corner| {
        let twin = topology.twin[*side];
        twin.is_some()
            && faces.normal[twin.triangle()] != DVec3::ZERO
            && !is_hard(view, *side, twin)
    };
    let sides = line.corners().into_iter().filter(can_lend);
    let longest = sides.max_by(|&one, &other| length(one).total_cmp(&length(other)))?;
    let twin = topology.twin[longest];
    let lender = faces.lender[twin.triangle()];
    Some(if lender.is_some() { lender } else { twin })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Mesh;
    use crate::options::Options;
    use crate::topology::topology;
    use crate::view::view;
    use crate::watch::Unwatched;
    use crate::weld::weld;

    // 3-------2
    // |     / |     0, 1 and 4 are a line: it closes the gap between the
    // |   /   |     edge 0-1 above and the two edges below
    // 0---4---1
    #[test]
    fn a_line_has_the_normal_of_the_face_behind_its_longest_side() {
        let positions =
            [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, 1.0, 0.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]];
        let mesh = Mesh {
            positions: &positions,
            normals: &[[0.0, 0.0, 1.0]; 5],
            indices: &[0, 1, 2, 0, 2, 3, 0, 4, 1],
            submesh_index_counts: &[9],
            ..Mesh::default()
        };
        let view = view(&mesh, &Options::default()).unwrap();
        let faces = faces(
            &view,
            &topology(&view, &weld(&mesh, &Unwatched).unwrap(), &Unwatched).unwrap(),
            (&Threads::default(), &Unwatched),
        )
        .unwrap();
        assert_eq!(faces.normal[Triangle(2)], DVec3::Z);
        assert_eq!(faces.lender[Triangle(2)], Corner(0));
        assert!(!faces.is_line(Triangle(0)));
    }
}
