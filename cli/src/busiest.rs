//! Where a close-up says most: the corner at which most hard edges meet, of those that are seen.

use std::collections::BTreeMap;

use chamfer::Chamfered;
use chamfer_formats::Document;
use glam::{Mat4, Vec3};

use crate::preview::{TOWARD_EYE, Zoom};
use crate::scene::scene_triangles;

/// How many times larger than the whole model a close-up is.
const FACTOR: f32 = 5.0;

/// So many corners are tried until one is seen.
const CANDIDATES: usize = 24;

/// A ray leaves its corner by this share of the scene's size, or the corner's own faces hide it.
const LIFT: f32 = 1e-3;

/// A close-up of the busiest corner; none without hard edges.
pub fn busiest_corner(document: &dyn Document, chamfered: &[Chamfered]) -> Option<Zoom> {
    let mut corners: Vec<(usize, Vec3)> = counted(document, chamfered);
    let eye = TOWARD_EYE.as_vec3().normalize();
    // Most edges first, then the nearest to the eye.
    corners.sort_by(|(a, at), (b, other)| b.cmp(a).then(other.dot(eye).total_cmp(&at.dot(eye))));
    let triangles = scene_triangles(document, |mesh| &document.meshes()[mesh].mesh);
    let size = corners.iter().map(|(_, at)| at.distance(corners[0].1)).fold(0.0, f32::max);
    let is_seen = |at: Vec3| {
        let from = at + eye * size * LIFT;
        !triangles.iter().any(|triangle| hits(triangle.map(Vec3::from), from, eye))
    };
    let candidates = || corners.iter().take(CANDIDATES).map(|(_, at)| *at);
    let focus = candidates().find(|at| is_seen(*at)).or_else(|| candidates().next())?;
    Some(Zoom { factor: FACTOR, focus: Some(focus.to_array()) })
}

/// How many hard edges end at each place of the scene.
fn counted(document: &dyn Document, chamfered: &[Chamfered]) -> Vec<(usize, Vec3)> {
    let mut counts: BTreeMap<[u32; 3], usize> = BTreeMap::new();
    for instance in document.instances() {
        let transform = Mat4::from_cols_array_2d(&instance.transform);
        let positions = &document.meshes()[instance.mesh].mesh.positions;
        for vertex in chamfered[instance.mesh].verdicts.iter().flat_map(|v| v.vertices) {
            let at = transform.transform_point3(Vec3::from(positions[vertex as usize]));
            if at.is_finite() {
                *counts.entry((at + Vec3::ZERO).to_array().map(f32::to_bits)).or_default() += 1;
            }
        }
    }
    let place = |at: [u32; 3]| Vec3::from(at.map(f32::from_bits));
    counts.into_iter().map(|(at, count)| (count, place(at))).collect()
}

/// Whether a ray meets a triangle (Möller and Trumbore, 1997).
fn hits([a, b, c]: [Vec3; 3], from: Vec3, toward: Vec3) -> bool {
    let (side, other) = (b - a, c - a);
    let across = toward.cross(other);
    let determinant = side.dot(across);
    if determinant == 0.0 {
        return false;
    }
    let offset = (from - a) / determinant;
    let u = offset.dot(across);
    let around = offset.cross(side);
    let (v, distance) = (toward.dot(around), other.dot(around));
    u >= 0.0 && v >= 0.0 && u + v <= 1.0 && distance > 0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    fn focus(obj: &str) -> [f32; 3] {
        let path = std::path::Path::new("a.obj");
        let options = chamfer_formats::ReadOptions::default();
        let document = chamfer_formats::decode(path, obj.into(), &options).unwrap();
        let mesh = document.meshes()[0].mesh.as_mesh();
        let result = chamfer::chamfer(&mesh, &chamfer::Options::default()).unwrap();
        busiest_corner(&*document, &[result]).unwrap().focus.unwrap()
    }

    /// Four edges meet at the tip, three at the corners of the base; but a roof can hide the tip.
    const PYRAMID: &str = "v -1 0 -1\nv 1 0 -1\nv 1 0 1\nv -1 0 1\nv 0 2 0\n\
        f 1 2 3 4\nf 5 2 1\nf 5 3 2\nf 5 4 3\nf 5 1 4\n";
    const ROOF: &str = "v -3 2.5 -3\nv -3 2.5 3\nv 3 2.5 3\nv 3 2.5 -3\nf 6 7 8 9\n";

    #[test]
    fn most_edges_count_unless_they_are_hidden() {
        assert_eq!(focus(PYRAMID), [0.0, 2.0, 0.0]);
        assert_eq!(focus(&format!("{PYRAMID}{ROOF}"))[1], 0.0);
    }

    #[test]
    fn a_ray_meets_what_is_before_it() {
        let wall =
            [Vec3::new(-1.0, -1.0, 1.0), Vec3::new(3.0, -1.0, 1.0), Vec3::new(-1.0, 3.0, 1.0)];
        assert!(hits(wall, Vec3::ZERO, Vec3::Z));
        assert!(!hits(wall, Vec3::ZERO, -Vec3::Z));
        assert!(!hits(wall, Vec3::new(5.0, 0.0, 0.0), Vec3::Z));
    }
}
