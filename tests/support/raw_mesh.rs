//! Meshes as files of plain numbers, for test programs in other languages. Every number has four
//! bytes, little-endian; an array is its length and then its numbers.

use chamfer::{MeshBuffers, UV_CHANNELS};

/// A file in the making.
#[derive(Default)]
pub struct Numbers {
    pub bytes: Vec<u8>,
}

impl Numbers {
    pub fn number(&mut self, number: usize) {
        self.bytes.extend((number as u32).to_le_bytes());
    }

    pub fn floats(&mut self, values: &[f32]) {
        self.number(values.len());
        self.bytes.extend(values.iter().flat_map(|value| value.to_le_bytes()));
    }

    pub fn integers(&mut self, values: &[u32]) {
        self.number(values.len());
        self.bytes.extend(values.iter().flat_map(|value| value.to_le_bytes()));
    }

    /// The streams in the order of the C struct, and then the triangles.
    pub fn mesh(&mut self, mesh: &MeshBuffers) {
        self.floats(mesh.positions.as_flattened());
        self.floats(mesh.normals.as_flattened());
        self.floats(mesh.tangents.as_flattened());
        self.floats(mesh.colors.as_flattened());
        for channel in 0..UV_CHANNELS {
            self.number(mesh.uvs[channel].components as usize);
            self.floats(&mesh.uvs[channel].values);
        }
        self.integers(&mesh.submesh_index_counts);
        self.integers(&mesh.indices);
    }
}
