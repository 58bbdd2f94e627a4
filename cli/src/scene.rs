//! All placed meshes of a document together: what the eye sees of it.

use chamfer::see_through::SceneTriangle;
use chamfer::{Mesh, MeshBuffers};
use chamfer_formats::{Document, Instance};
use glam::{Mat3, Mat4, Vec3};

use crate::preview::Placed;

/// The triangles of a document's scene, with these in the place of its meshes:
/// counter-clockwise where seen from outside, also where a transform mirrors.
pub fn scene_triangles<'a>(
    document: &dyn Document,
    mesh: impl Fn(usize) -> &'a MeshBuffers,
) -> Vec<SceneTriangle> {
    let meshes: Vec<Mesh> =
        (0..document.meshes().len()).map(|number| mesh(number).as_mesh()).collect();
    chamfer::scene_triangles(&meshes, &document.instances())
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
    use chamfer_formats::IDENTITY;

    fn stretched(x: f32) -> Instance {
        let mut transform = IDENTITY;
        (transform[0][0], transform[3][2]) = (x, 5.0);
        Instance { mesh: 0, transform }
    }

    #[test]
    fn the_longest_stretch_is_the_scale() {
        assert_eq!([0.5, 1.0, -2.0].map(|x| scale(&stretched(x))), [1.0, 1.0, 2.0]);
    }
}
