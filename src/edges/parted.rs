//! Where edges that stay hard part sectors, so that a chamfer that ends among them can be closed.
//!
//! ```text
//!        \   A   |   B   /
//!         k1     e     k2       e is chamfered and ends here, k1 and k2 stay hard. A slides along
//!           \    |    /         k1, and the face C across goes along with it. B slides along k2,
//!             \  |  /           which parts C from B: what opens between them is cut off from C
//!               `v'    C        along the chord, and a flap in C's plane gives the rest back.
//! ```

use super::HardEdge;
use crate::breaks::is_hard;
use crate::faces::Faces;
use crate::ids::{Corner, Edge, IdVec};
use crate::math::{Turn, unit};
use crate::report::Reason;
use crate::tolerance::{CREASE_COSINE, FLAT_COSINE, LEAST_SLIDE_SINE};
use crate::topology::Topology;
use crate::view::View;

/// Normals that lean by less than a degree from those of their triangles shade these as flat.
const FLAT_SHADING: f64 = 0.999_85;

/// One end of an edge that stays hard and parts the sectors on its two sides there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parted {
    /// Its half-edge from that end: the sector that starts there slides along it. Its twin belongs
    /// to the face that is cut.
    pub corner: Corner,
    /// The width of the chamfers beside, in mesh units.
    pub width: f64,
}

/// Around each end of a chamfered edge, from it to the next one: where faces bend at two and more
/// edges between that are not selected, all of these but the first; sorted by corners.
pub fn parted(
    view: &View,
    topology: &Topology,
    faces: &Faces,
    hard: &IdVec<Edge, HardEdge>,
    chamfered_at: &IdVec<Corner, Edge>,
) -> Vec<Parted> {
    let unselected = hard.iter().filter(|edge| edge.skipped == Some(Reason::NotSelected));
    let mut kept: Vec<Corner> = unselected.flat_map(|edge| edge.sides).collect();
    if kept.is_empty() {
        return Vec::new();
    }
    kept.sort_unstable();
    let around = Around { view, topology, faces, kept };
    let mut parted = Vec::new();
    for first in chamfered_at.ids().filter(|&corner| chamfered_at[corner].is_some()) {
        let Some(fan) = around.fan(first, chamfered_at) else { continue };
        let Some(bends) = around.bends(&fan) else { continue };
        if around.can_part(&fan, &bends) {
            let last = fan[fan.len() - 1].prev();
            let widths = [
                hard[chamfered_at[first]].width_at_start(first),
                hard[chamfered_at[last]].width_at_end(last),
            ];
            let width = (widths[0] + widths[1]) / 2.0;
            parted.extend(bends.iter().skip(1).map(|&at| Parted { corner: fan[at], width }));
        }
    }
    parted.sort_unstable_by_key(|parted| parted.corner);
    parted
}

struct Around<'a> {
    view: &'a View<'a>,
    topology: &'a Topology,
    faces: &'a Faces,
    /// Both sides of all edges that are not selected, sorted.
    kept: Vec<Corner>,
}

impl Around<'_> {
    /// The corners from one chamfered edge to the next; none where a border comes first.
    fn fan(&self, first: Corner, chamfered_at: &IdVec<Corner, Edge>) -> Option<Vec<Corner>> {
        let mut fan = vec![first];
        let mut last = first;
        while chamfered_at[last.prev()].is_none() {
            last = self.topology.twin[last.prev()];
            if last.is_none() {
                return None;
            }
            fan.push(last);
        }
        Some(fan)
    }

    /// The places in a fan at whose first edges it bends; none where it bends anywhere but at edges
    /// that are not selected.
    fn bends(&self, fan: &[Corner]) -> Option<Vec<usize>> {
        let mut bends = Vec::new();
        for place in 1..fan.len() {
            let [before, behind] =
                [place - 1, place].map(|place| self.faces.normal[fan[place].triangle()]);
            let cosine = before.dot(behind);
            let is_bend =
                is_hard(self.view, fan[place], fan[place - 1].prev()) && cosine < FLAT_COSINE;
            if is_bend && self.kept.binary_search(&fan[place]).is_ok() {
                bends.push(place);
            } else if is_bend || cosine < CREASE_COSINE {
                return None;
            }
        }
        Some(bends)
    }

    /// Whether the first and the last face can slide, and those between are flat and convex.
    fn can_part(&self, fan: &[Corner], bends: &[usize]) -> bool {
        let mut starts = bends.to_vec();
        starts.push(fan.len());
        let mut from = 0;
        let is_last = |end: usize| end == fan.len();
        starts.into_iter().all(|end| {
            let (face, is_across) = (&fan[from..end], from > 0 && !is_last(end));
            from = end;
            // Past half a turn the sine is negative.
            self.turn(face).sin() >= LEAST_SLIDE_SINE && (!is_across || self.is_level(face))
        })
    }

    fn turn(&self, face: &[Corner]) -> Turn {
        face.iter().fold(Turn::ZERO, |turn, &corner| {
            let [at, next, prev] =
                [corner, corner.next(), corner.prev()].map(|c| self.view.position_at(c));
            turn.plus(Turn::between(next - at, prev - at))
        })
    }

    /// Whether a face is flat, and shaded so: what is given back to it is.
    fn is_level(&self, face: &[Corner]) -> bool {
        let normal = self.faces.normal[face[0].triangle()];
        let is_shaded_flat =
            |corner: Corner| unit(self.view.normal_at(corner)).dot(normal) > FLAT_SHADING;
        face.iter().map(|corner| corner.triangle()).all(|triangle| {
            self.faces.normal[triangle].dot(normal) > FLAT_COSINE
                && triangle.corners().into_iter().all(is_shaded_flat)
        })
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use crate::math::{area_vector, unit};
    use crate::mesh::{EdgeFactor, Factors, Held, Mesh, MeshBuffers};
    use crate::options::{Options, Width};
    use crate::stages::stages_of_mesh;

    /// Where the edges of the faces end.
    const E: [f32; 3] = [1.0, 0.0, 0.0];
    const K1: [f32; 3] = [0.0, 0.0, 1.0];
    const K2: [f32; 3] = [0.0, 1.0, 0.0];

    /// Faces around the origin, each over some points; each shaded flat.
    fn around(faces: &[&[[f32; 3]]]) -> MeshBuffers {
        let mut mesh = MeshBuffers::default();
        for face in faces {
            let first = mesh.positions.len() as u32;
            let points: Vec<DVec3> = face.iter().map(|at| DVec3::from(at.map(f64::from))).collect();
            let areas = points.windows(2).map(|ends| area_vector([DVec3::ZERO, ends[0], ends[1]]));
            let normal = unit(areas.sum()).as_vec3().to_array();
            mesh.positions.push([0.0; 3]);
            mesh.positions.extend(*face);
            mesh.normals.extend(vec![normal; face.len() + 1]);
            for place in 1..face.len() as u32 {
                mesh.indices.extend([first, first + place, first + place + 1]);
            }
        }
        mesh.submesh_index_counts = vec![mesh.indices.len() as u32];
        mesh
    }

    /// How many edges part sectors where that from the origin to E is chamfered, and those to some
    /// others are too but for a rim that rests on them.
    fn count(mesh: &MeshBuffers, held: &[[f32; 3]]) -> usize {
        let end = |at: [f32; 3]| mesh.positions.iter().position(|point| *point == at).unwrap();
        let edge = |at: &[f32; 3]| EdgeFactor { vertices: [0, end(*at) as u32], factor: 1.0 };
        let edges: Vec<EdgeFactor> = [E].iter().chain(held).map(edge).collect();
        let rim = |&to: &[f32; 3]| Held { from: [0.0; 3], to, radius: 0.0 };
        let held: Vec<Held> = held.iter().map(rim).collect();
        let factors = Factors { edges: &edges, ..Factors::default() };
        let mesh = Mesh { factors, held: &held, ..mesh.as_mesh() };
        let options = Options::default().with_width(Width::Units(0.1));
        stages_of_mesh(mesh, &options).edges.parted.len()
    }

    //  \  A  |  B  /
    //   k1   e   k2       the corner of a box: all but the first of those that stay hard part
    //     \  |  /
    //      \ | /   C
    #[test]
    fn all_edges_but_the_first_part() {
        assert_eq!(count(&around(&[&[E, K1], &[K1, K2], &[K2, E]]), &[]), 1);
        let between = [-0.5, 0.7, 0.7];
        assert_eq!(count(&around(&[&[E, K1], &[K1, between], &[between, K2], &[K2, E]]), &[]), 2);
    }

    // The first face is so slim that its vertex would go far along its edge, or just wide enough.
    #[test]
    fn nothing_parts_beside_a_face_that_cannot_slide() {
        let between = [0.0, -0.5, 1.0];
        for (aside, expected) in [(0.05, 0), (0.15, 2)] {
            let k1 = [1.0, 0.0, aside];
            let faces: [&[[f32; 3]]; 4] = [&[E, k1], &[k1, between], &[between, K2], &[K2, E]];
            assert_eq!(count(&around(&faces), &[]), expected, "{aside}");
        }
    }

    //  .-----.
    //  |     |         C is all of a wall but the corner from which e comes towards us
    //  |  C  e---k2
    //  |     |
    //  '-----k1
    #[test]
    fn nothing_parts_across_a_concave_face() {
        let wall = [K2, [0.0, 0.0, -1.0], [0.0, -1.0, 0.0], K1];
        assert_eq!(count(&around(&[&[E, K2], &wall, &[K1, E]]), &[]), 0);
    }

    // The first face has two halves in one plane, which are shaded differently.
    #[test]
    fn an_edge_between_faces_in_one_plane_parts_nothing() {
        let half = [1.0, 0.0, 1.0];
        let mut mesh = around(&[&[E, half], &[half, K1], &[K1, K2], &[K2, E]]);
        mesh.normals[..3].fill([0.1, -0.995, 0.0]);
        assert_eq!(count(&mesh, &[]), 1);
    }

    // The first face bends: by 17 degrees where it is shaded smoothly, or by three at an edge that is
    // held, and so is not merely not selected.
    #[test]
    fn nothing_parts_beside_a_face_that_bends() {
        let bend = [1.0, -0.3, 1.0];
        assert_eq!(count(&around(&[&[E, bend, K1], &[K1, K2], &[K2, E]]), &[]), 0);
        let bend = [1.0, -0.03, 1.0];
        let mesh = around(&[&[E, bend], &[bend, K1], &[K1, K2], &[K2, E]]);
        assert_eq!(count(&mesh, &[bend]), 0);
        assert_eq!(count(&mesh, &[]), 2, "where it is not selected it parts as others do");
    }
}
