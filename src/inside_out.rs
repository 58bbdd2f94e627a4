//! Inside out: a mesh all of whose normals point against its winding is chamfered as if they pointed
//! along with it, and keeps its own.
//!
//! Which of the two is meant nobody can tell: a mirrored export turns the winding, a wrong bake the
//! normals. Where all agree that does not matter, as faces, edges and corners are the same.

use crate::math::area_vector;
use crate::report::Chamfered;
use crate::validity::has_any_area;
use crate::view::View;

/// Whether the normals of all triangles that have an area point against it. What rounding alone leaves
/// of one has no say: it points anywhere.
pub fn is_inside_out(view: &View) -> bool {
    let mut any = false;
    // Of nearly all meshes the first triangle tells.
    view.triangles().all(|triangle| {
        let points = view.triangle(triangle);
        if !has_any_area(points) {
            return true;
        }
        let area = area_vector(points);
        let normals = triangle.corners().map(|corner| view.normal_at(corner));
        let along = area.dot(normals.into_iter().sum());
        any |= along < 0.0;
        along <= 0.0
    }) && any
}

/// `#vertices by 3`: the normals as they would be with the winding.
pub fn turned_normals(view: &View) -> Vec<[f32; 3]> {
    view.mesh.normals.iter().map(|normal| turned(*normal)).collect()
}

/// A result with its normals on the side of the source's.
pub fn turned_back(mut chamfered: Chamfered) -> Chamfered {
    chamfered.mesh.normals.iter_mut().for_each(|normal| *normal = turned(*normal));
    chamfered
}

fn turned(normal: [f32; 3]) -> [f32; 3] {
    normal.map(|along| -along)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{Mesh, MeshBuffers};
    use crate::options::{Options, Width};
    use crate::pipeline::chamfer;
    use crate::shapes;

    fn is_turned(mesh: &Mesh) -> bool {
        is_inside_out(&crate::view::view(mesh, &Options::default()).unwrap())
    }

    fn inside_out(mut mesh: MeshBuffers) -> MeshBuffers {
        mesh.normals.iter_mut().for_each(|normal| *normal = turned(*normal));
        mesh
    }

    #[test]
    fn one_face_that_agrees_is_enough() {
        let mut cube = inside_out(shapes::cube(1.0));
        assert!(is_turned(&cube.as_mesh()) && !is_turned(&shapes::cube(1.0).as_mesh()));
        cube.indices.swap(33, 34);
        assert!(!is_turned(&cube.as_mesh()));
        let nothing = Mesh { indices: &[], submesh_index_counts: &[0], ..cube.as_mesh() };
        assert!(!is_turned(&nothing));
    }

    /// Beside the cube a triangle of which two corners nearly meet in its middle: what is left of its
    /// area points along with its normals, but is none.
    #[test]
    fn a_triangle_without_area_has_no_say() {
        let mut cube = inside_out(shapes::cube(1.0));
        let first = cube.positions.len() as u32;
        cube.positions.extend([[0.0, 1e-41, 0.0], [0.5, -0.5, -0.5], [0.0, 0.0, 1e-41]]);
        cube.normals.extend([[-1.0, 0.0, 0.0]; 3]);
        cube.indices.extend([first, first + 1, first + 2]);
        cube.submesh_index_counts[0] += 3;
        let (tangents, uvs) = (cube.tangents.first().copied(), [0.0; 2]);
        cube.tangents.extend(tangents.iter().cycle().take(3));
        cube.uvs.iter_mut().filter(|uv| uv.components > 0).for_each(|uv| {
            uv.values.extend(uvs.repeat(3));
        });
        assert!(is_turned(&cube.as_mesh()));
    }

    /// A cube and a cylinder, whose normals are also blended, and a tangent frame along with them.
    #[test]
    fn it_comes_out_as_the_same_mesh_the_right_way_round() {
        for mesh in [shapes::cube(1.0), shapes::cylinder(6)] {
            let options = Options::default().with_width(Width::Units(0.1));
            let right = chamfer(&mesh.as_mesh(), &options).unwrap();
            let turned = chamfer(&inside_out(mesh).as_mesh(), &options).unwrap();
            assert!(turned.totals.chamfered > 0);
            assert_eq!(turned.totals, right.totals);
            assert_eq!(turned_back(turned).mesh.normals, right.mesh.normals);
        }
    }
}
