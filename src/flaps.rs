//! Flaps: what is given back to a face whose corner a chamfer that ends there has cut off.
//!
//! ```text
//!    u ---------- p2 - v       an edge u-v stays hard, and parts two faces at v: the one below
//!      `--..__    /            has gone to p1, along its other edge, the one above to p2. The flap
//!             `- p1            u, p2, p1 lies in the plane of the one below, and continues it
//! ```

use glam::DVec3;

use crate::chamfers::Chamfers;
use crate::edges::Parted;
use crate::ids::Corner;
use crate::math::{area_vector, unit};
use crate::placement::Placement;
use crate::report::Blend;
use crate::surface::Surface;
use crate::topology::Topology;
use crate::validity::faces_out;
use crate::view::View;

/// A flap leans by at most a degree from the face that it continues: rounding tilts a very small one
/// by more, and then it would show.
const LEAST_LEVEL_COSINE: f64 = 0.999_85;

/// A triangle in the plane of a source triangle, at an end of an edge that stays hard.
pub struct Flap {
    /// Of the face across the edge, and at both ends of the face that is continued.
    pub joints: [Corner; 3],
    /// Where the first joint lies on the face that is continued.
    pub place: Blend,
}

/// The joints at an end of an edge that parts sectors: counter-clockwise seen from outside.
pub fn joints(topology: &Topology, parted: &Parted) -> [Corner; 3] {
    let twin = topology.twin[parted.corner];
    [parted.corner, twin.next(), twin]
}

/// All that open, in the order of their edges' ends.
pub fn flaps(surface: Surface, chamfers: Chamfers, placement: &Placement) -> Vec<Flap> {
    let flap = |parted: &Parted| {
        let joints = joints(surface.topology, parted);
        let points = joints.map(|joint| placement.position_at(joint));
        let place = || Flap { joints, place: place(surface.view, joints, points[0]) };
        is_open(points).then(place)
    };
    chamfers.edges.parted.iter().filter_map(flap).collect()
}

/// Whether the faces on both sides stand at different places.
pub fn is_open([across, own, _]: [DVec3; 3]) -> bool {
    across != own
}

/// Whether a flap is closed, or a triangle in the plane of its face.
pub fn is_valid(surface: Surface, joints: [Corner; 3], points: [DVec3; 3]) -> bool {
    let normal = surface.faces.normal[joints[2].triangle()];
    let is_level = unit(area_vector(points)).dot(normal) > LEAST_LEVEL_COSINE;
    !is_open(points) || is_level && faces_out(points, [normal; 3], surface.view.resolution)
}

/// A place on the edge, in terms of the vertices of the face that is continued.
fn place(view: &View, [_, end, start]: [Corner; 3], at: DVec3) -> Blend {
    let [from, to] = [start, end].map(|corner| view.position_at(corner));
    let share = ((at - from).dot(unit(to - from)) / from.distance(to)).clamp(0.0, 1.0);
    let [start, end] = [start, end].map(|corner| view.vertex_at(corner).0);
    Blend::new([start, end, start], [1.0 - share, share, 0.0])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes;
    use crate::stages::stages_of;

    // c
    // | '.        half a face of a cube, as if it were a flap of its own
    // a---b
    #[test]
    fn a_flap_is_a_triangle_in_the_plane_of_its_face() {
        let cube = shapes::plain_cube(1.0);
        let stages = stages_of(&cube, 0.1);
        let joints = [Corner(0), Corner(1), Corner(2)];
        let [a, b, c] = stages.view.triangle(Corner(0).triangle());
        let up = stages.faces.normal[Corner(0).triangle()];
        let is_valid = |points| is_valid(stages.surface(), joints, points);
        assert!(is_valid([a, b, c]));
        assert!(is_valid([a, b, c + up * 0.01]), "it leans by half a degree");
        assert!(!is_valid([a, b, c + up * 0.05]), "it leans by three");
        assert!(!is_valid([a, c, b]), "it is turned over");
        let height = c - a;
        assert!(!is_valid([a, b, a + height * 1e-8]), "single precision takes it for a line");
        assert!(is_valid([a, a, c]), "it is closed");
    }
}
