//! All placed meshes of a document together: what the eye sees of it.

use chamfer::MeshBuffers;
use chamfer::see_through::SceneTriangle;
use glam::{Mat3, Mat4, Vec3};

use crate::document::{Document, Instance};
use crate::preview::Placed;

/// The triangles of a document's scene, with these in the place of its meshes:
/// counter-clockwise where seen from outside, also where a transform mirrors.
pub fn scene_triangles<'a>(
    document: &dyn Document,
    mesh: impl Fn(usize) -> &'a MeshBuffers,
) -> Vec<SceneTriangle> {
    let mut scene = Vec::new();
    for instance in document.instances() {
        add(&mut scene, mesh(instance.mesh), &instance);
    }
    scene
}

fn add(scene: &mut Vec<SceneTriangle>, mesh: &MeshBuffers, instance: &Instance) {
    let transform = Mat4::from_cols_array_2d(&instance.transform);
    let mirrors = transform.determinant() < 0.0;
    let place = |index: u32| {
        transform.transform_point3(Vec3::from(mesh.positions[index as usize])).to_array()
    };
    for triangle in mesh.indices.chunks_exact(3) {
        let [a, b, c] = [triangle[0], triangle[1], triangle[2]].map(place);
        scene.push(if mirrors { [a, c, b] } else { [a, b, c] });
    }
}

/// The same for a picture.
pub fn placed<'a>(
    document: &dyn Document,
    mesh: impl Fn(usize) -> &'a MeshBuffers,
) -> Vec<Placed<'a>> {
    let instances = document.instances().into_iter();
    let placed = instances.map(|Instance { mesh: number, transform }| Placed {
        mesh: mesh(number).as_mesh(),
        transform,
    });
    placed.collect()
}

/// How many times longer a length of the mesh may be in the scene.
pub fn scale(instance: &Instance) -> f32 {
    let linear = Mat3::from_mat4(Mat4::from_cols_array_2d(&instance.transform));
    [linear.x_axis, linear.y_axis, linear.z_axis].map(Vec3::length).into_iter().fold(0.0, f32::max)
}

/// The largest of lengths in the meshes of a document (none where a mesh has no such length), as
/// it is in the scene.
pub fn largest_length(
    document: &dyn Document,
    length: impl Fn(usize) -> Option<f32>,
) -> Option<f32> {
    let instances = document.instances().into_iter();
    let lengths = instances.filter_map(|instance| Some(length(instance.mesh)? * scale(&instance)));
    lengths.filter(|length| length.is_finite()).reduce(f32::max)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document::IDENTITY;

    /// A triangle in the plane z = 0 that faces +z.
    fn triangle() -> MeshBuffers {
        MeshBuffers {
            positions: vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
            indices: vec![0, 1, 2],
            ..MeshBuffers::default()
        }
    }

    fn stretched(x: f32) -> Instance {
        let mut transform = IDENTITY;
        (transform[0][0], transform[3][2]) = (x, 5.0);
        Instance { mesh: 0, transform }
    }

    #[test]
    fn a_mirrored_triangle_still_faces_outward() {
        let mut scene = Vec::new();
        add(&mut scene, &triangle(), &stretched(-2.0));
        assert_eq!(scene, [[[0.0, 0.0, 5.0], [0.0, 1.0, 5.0], [-2.0, 0.0, 5.0]]]);
    }

    #[test]
    fn the_longest_stretch_is_the_scale() {
        assert_eq!([0.5, 1.0, -2.0].map(|x| scale(&stretched(x))), [1.0, 1.0, 2.0]);
    }
}
