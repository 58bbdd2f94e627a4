//! All placed meshes of one tile as one list of triangles in scene space.

use glam::{DMat3, DMat4, DVec3, Vec2, Vec3};

use super::Placed;

/// A vertex in scene space.
pub(super) struct Vertex {
    pub position: DVec3,
    /// Unit length, or zero where the mesh has none.
    pub normal: Vec3,
    pub uv: Option<Vec2>,
    pub color: Vec3,
}

/// The triangles that a tile draws.
#[derive(Default)]
pub(super) struct Scene {
    pub vertices: Vec<Vertex>,
    /// Counter-clockwise where seen from outside, also where a transform mirrors.
    pub triangles: Vec<[u32; 3]>,
    /// `#triangles`: the place of its mesh among those placed, and its submesh.
    pub origins: Vec<[u32; 2]>,
}

impl Scene {
    /// Leaves out what cannot be drawn: meshes whose transform and triangles whose corners are
    /// not finite, and triangles that refer to no vertex.
    pub fn gather(placed: &[Placed]) -> Scene {
        let mut scene = Scene::default();
        for (number, item) in (0..).zip(placed) {
            let transform = DMat4::from_cols_array_2d(&item.transform.map(|c| c.map(f64::from)));
            if transform.is_finite() {
                scene.append(number, &item.mesh, &transform);
            }
        }
        scene
    }

    /// The positions of all triangle corners.
    pub fn corners(&self) -> impl Iterator<Item = DVec3> + Clone + '_ {
        self.triangles.iter().flatten().map(|&v| self.vertices[v as usize].position)
    }

    fn append(&mut self, number: u32, mesh: &chamfer::Mesh, transform: &DMat4) {
        let base = self.vertices.len() as u32;
        let normals = NormalTransform::new(&DMat3::from_mat4(*transform));
        self.vertices.extend((0..mesh.positions.len()).map(|v| Vertex {
            position: transform.transform_point3(Vec3::from(mesh.positions[v]).as_dvec3()),
            normal: mesh.normals.get(v).map_or(Vec3::ZERO, |&n| normals.apply(n)),
            uv: uv(mesh, v),
            color: color(mesh, v),
        }));
        let counts = (0..).zip(mesh.submesh_index_counts);
        let mut submeshes =
            counts.flat_map(|(submesh, count)| std::iter::repeat_n(submesh, *count as usize / 3));
        for triangle in mesh.indices.chunks_exact(3) {
            let submesh = submeshes.next().unwrap_or(0);
            let [a, b, c] = [triangle[0], triangle[1], triangle[2]];
            if [a, b, c].iter().all(|&v| self.is_drawable(base, v)) {
                let wound = if normals.mirrors() { [a, c, b] } else { [a, b, c] };
                self.triangles.push(wound.map(|v| base + v));
                self.origins.push([number, submesh]);
            }
        }
    }

    fn is_drawable(&self, base: u32, vertex: u32) -> bool {
        let vertex = self.vertices.get(base as usize + vertex as usize);
        vertex.is_some_and(|v| v.position.is_finite())
    }
}

fn uv(mesh: &chamfer::Mesh, vertex: usize) -> Option<Vec2> {
    let channel = &mesh.uvs[0];
    let start = vertex * channel.components as usize;
    let values = channel.values.get(start..start + channel.components.min(2) as usize)?;
    values.first_chunk().map(|&uv| Vec2::from_array(uv)).filter(|uv| uv.is_finite())
}

fn color(mesh: &chamfer::Mesh, vertex: usize) -> Vec3 {
    mesh.colors.get(vertex).map_or(Vec3::ONE, |&[r, g, b, _]| {
        let color = Vec3::new(r, g, b);
        if color.is_finite() { color.clamp(Vec3::ZERO, Vec3::ONE) } else { Vec3::ONE }
    })
}

/// The inverse transpose up to a positive factor, which exists for flattening transforms too.
struct NormalTransform {
    cofactors: DMat3,
    determinant: f64,
}

impl NormalTransform {
    fn new(linear: &DMat3) -> Self {
        let determinant = linear.determinant();
        let [x, y, z] = [linear.x_axis, linear.y_axis, linear.z_axis];
        let sign = if determinant < 0.0 { -1.0 } else { 1.0 };
        let cofactors = DMat3::from_cols(y.cross(z), z.cross(x), x.cross(y)) * sign;
        NormalTransform { cofactors, determinant }
    }

    fn mirrors(&self) -> bool {
        self.determinant < 0.0
    }

    fn apply(&self, normal: [f32; 3]) -> Vec3 {
        (self.cofactors * Vec3::from(normal).as_dvec3()).normalize_or_zero().as_vec3()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const IDENTITY: [[f32; 4]; 4] =
        [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]];

    const MESH: chamfer::Mesh = chamfer::Mesh {
        positions: &[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [f32::NAN, 0.0, 0.0]],
        normals: &[[0.0, 0.6, 0.8]; 4],
        indices: &[0, 1, 2, 0, 1, 3, 0, 1, 4],
        tangents: &[],
        colors: &[],
        uvs: [chamfer::Uv { components: 0, values: &[] }; chamfer::UV_CHANNELS],
        submesh_index_counts: &[9],
        held: &[],
        factors: chamfer::Factors { submeshes: &[], vertices: &[], edges: &[] },
    };

    fn scene(transform: [[f32; 4]; 4]) -> Scene {
        Scene::gather(&[Placed { mesh: MESH, transform }])
    }

    #[test]
    fn triangles_without_finite_corners_are_left_out() {
        assert_eq!(scene(IDENTITY).triangles, [[0, 1, 2]]);
    }

    #[test]
    fn a_transform_that_is_not_finite_leaves_its_mesh_out() {
        let mut transform = IDENTITY;
        transform[3][1] = f32::INFINITY;
        assert!(scene(transform).triangles.is_empty());
    }

    #[test]
    fn a_second_mesh_refers_to_its_own_vertices() {
        let placed = || Placed { mesh: MESH, transform: IDENTITY };
        assert_eq!(Scene::gather(&[placed(), placed()]).triangles, [[0, 1, 2], [4, 5, 6]]);
    }

    #[test]
    fn a_mirroring_transform_keeps_normals_outward_and_reverses_the_winding() {
        let mut transform = IDENTITY;
        transform[0][0] = -1.0;
        let scene = scene(transform);
        assert_eq!(scene.triangles, [[0, 2, 1]]);
        assert_eq!(scene.vertices[0].normal, Vec3::new(0.0, 0.6, 0.8));
    }

    #[test]
    fn normals_stay_perpendicular_where_a_transform_stretches() {
        let mut transform = IDENTITY;
        transform[1][1] = 2.0;
        let normal = scene(transform).vertices[0].normal;
        assert!((normal - Vec3::new(0.0, 0.3, 0.8).normalize()).length() < 1e-6);
    }
}
