//! Reach: how wide the chamfers could be if all that limited them were their neighbours.
//!
//! From points on a hard edge, walk straight across the face, over every soft edge, to the next hard
//! edge or border. Half of that way is the edge's own; the other half belongs to whatever lies there.
//! Only the edges that have a chamfer are measured, as no others can.

use chamfer::{Chamfered, Mesh, Outcome};
use glam::DVec3;

use super::ground::{Ground, next};

/// Where on an edge the walks begin.
const STARTS: [f64; 3] = [0.15, 0.5, 0.85];

/// Walks end after so many triangles: enough to cross any strip of the widths that are asked for.
const MOST_STEPS: usize = 200;

/// The mean, over the chamfered edges by their length, of the share of the width that is within
/// reach on both sides; 1 without any.
pub fn reach(mesh: &Mesh, after: &Chamfered) -> f64 {
    let ground = Ground::new(mesh);
    let width = f64::from(after.width);
    let (mut whole, mut within) = (0.0, 0.0);
    for verdict in after.verdicts.iter().filter(|v| v.outcome != Outcome::Skipped) {
        let [from, to] = verdict.vertices.map(|vertex| ground.place[vertex as usize]);
        let sides = [ground.half_edges.get(&[from, to]), ground.half_edges.get(&[to, from])];
        let shares: Vec<f64> = sides
            .into_iter()
            .flatten()
            .flat_map(|side| STARTS.map(|start| ground.way(side[0], start, width) / width))
            .map(|share| share.min(1.0))
            .collect();
        let length = ground.points[from].distance(ground.points[to]);
        whole += length;
        within += length * shares.iter().sum::<f64>() / shares.len().max(1) as f64;
    }
    if whole > 0.0 { within / whole } else { 1.0 }
}

/// Walks on a mesh.
impl Ground<'_> {
    /// How far it is from a half-edge to the half of the way to the next edge that ends the surface.
    fn way(&self, half_edge: usize, start: f64, width: f64) -> f64 {
        let mut side = half_edge;
        let mut at = self.point(side).lerp(self.point(next(side)), start);
        let mut course = self.inward(side);
        let mut walked = 0.0;
        for _ in 0..MOST_STEPS {
            let Some((distance, exit)) = self.exit(side, at, course) else { break };
            (at, walked) = (at + course * distance, walked + distance);
            if walked > 2.0 * width {
                break;
            }
            let Some(entry) = self.across(exit) else { return walked / 2.0 };
            let normal = self.face_normal(entry);
            course = (course - normal * course.dot(normal)).normalize_or_zero();
            side = entry;
            if course.dot(self.inward(side)) <= 0.0 {
                break;
            }
        }
        walked
    }

    /// Away from a half-edge, in the plane of its face.
    fn inward(&self, corner: usize) -> DVec3 {
        let along = (self.point(next(corner)) - self.point(corner)).normalize_or_zero();
        self.face_normal(corner).cross(along)
    }

    /// Where a course leaves the triangle that it came into over a side, and how far that is.
    fn exit(&self, entry: usize, at: DVec3, course: DVec3) -> Option<(f64, usize)> {
        let sides = [next(entry), next(next(entry))].into_iter().filter_map(|side| {
            let outward = -self.inward(side);
            let speed = course.dot(outward);
            let ahead = (self.point(side) - at).dot(outward).max(0.0) / speed;
            (speed > 1e-12).then_some((ahead, side))
        });
        sides.min_by(|one, other| one.0.total_cmp(&other.0))
    }
}
