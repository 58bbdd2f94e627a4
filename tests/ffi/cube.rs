//! The input of these tests.

use std::ptr;

use crate::types::*;

/// A cube of side 2 around the origin, four vertices and two triangles a face.
#[derive(Clone, Debug, PartialEq)]
pub struct Cube {
    pub positions: Vec<f32>,
    pub normals: Vec<f32>,
    pub indices: Vec<u32>,
    pub submesh_index_counts: Vec<u32>,
}

impl Cube {
    pub fn new() -> Cube {
        let mut positions = vec![0.0; 72];
        let mut normals = vec![0.0; 72];
        for vertex in 0..24 {
            let sign = |bit: usize| if vertex & bit == 0 { -1.0 } else { 1.0 };
            let axis = vertex / 8;
            let place = |shift: usize| 3 * vertex + (axis + shift) % 3;
            normals[place(0)] = sign(4);
            positions[place(0)] = sign(4);
            positions[place(1)] = sign(4) * sign(1);
            positions[place(2)] = sign(2);
        }
        let faces = (0..6).flat_map(|face| [0, 1, 2, 2, 1, 3].map(|corner| 4 * face + corner));
        let indices = faces.collect();
        Cube { positions, normals, indices, submesh_index_counts: vec![18, 18] }
    }

    pub fn view(&self) -> chamfer_mesh {
        chamfer_mesh {
            vertex_count: self.positions.len() as u32 / 3,
            positions: self.positions.as_ptr(),
            normals: self.normals.as_ptr(),
            submesh_count: self.submesh_index_counts.len() as u32,
            index_count: self.indices.len() as u32,
            submesh_index_counts: self.submesh_index_counts.as_ptr(),
            indices: self.indices.as_ptr(),
            ..Cube::empty_view()
        }
    }

    /// A mesh without anything.
    pub fn empty_view() -> chamfer_mesh {
        chamfer_mesh {
            struct_size: size_of::<chamfer_mesh>() as u32,
            vertex_count: 0,
            positions: ptr::null(),
            normals: ptr::null(),
            tangents: ptr::null(),
            colors: ptr::null(),
            uvs: [chamfer_uv { components: 0, values: ptr::null() }; CHAMFER_UV_CHANNELS],
            submesh_count: 0,
            index_count: 0,
            submesh_index_counts: ptr::null(),
            indices: ptr::null(),
            held_count: 0,
            held: ptr::null(),
            submesh_factors: ptr::null(),
            vertex_factors: ptr::null(),
            edge_factor_count: 0,
            edge_factors: ptr::null(),
        }
    }
}

/// The defaults, as the library fills them in.
pub fn options() -> chamfer_options {
    let mut options = chamfer_options {
        struct_size: size_of::<chamfer_options>() as u32,
        width: f32::NAN,
        width_unit: 99,
        verify: 99,
        submesh_mode: 99,
        submesh: 99,
        threads: 99,
        least_breadth: 99.0,
        width_mode: 99,
        min_angle: 99.0,
        max_angle: 99.0,
        convexity: 99,
        hard_angle: 99.0,
        segments: 99,
        profile: 99.0,
        scale: [99.0; 9],
        evenness: 99.0,
    };
    // SAFETY: the struct states its size.
    let status = unsafe { (crate::library::LIBRARY.chamfer_options_init)(&mut options) };
    assert_eq!(status, CHAMFER_STATUS_OK);
    options
}
