//! Meshes compressed with Draco.

use chamfer::MeshBuffers;
use draco_core::{
    DataType, EncoderBuffer, EncoderOptions, GeometryAttributeType, Mesh, MeshEncoder,
    PointAttribute,
};

fn attribute(kind: GeometryAttributeType, values: &[f32], size: usize) -> PointAttribute {
    let mut attribute = PointAttribute::new();
    attribute.init(kind, size as u8, DataType::Float32, false, values.len() / size);
    let bytes: Vec<u8> = values.iter().flat_map(|number| number.to_le_bytes()).collect();
    attribute.buffer_mut().write(0, &bytes);
    attribute
}

/// Positions, normals and texture coordinates, as far as there are some, and triangles.
pub fn draco_bytes(mesh: &MeshBuffers, speed: i32) -> Vec<u8> {
    let mut packed = Mesh::new();
    packed.set_num_points(mesh.positions.len());
    let kinds = [
        (GeometryAttributeType::Position, mesh.positions.as_flattened(), 3),
        (GeometryAttributeType::Normal, mesh.normals.as_flattened(), 3),
        (GeometryAttributeType::TexCoord, &mesh.uvs[0].values, 2),
    ];
    for (kind, values, size) in kinds.into_iter().filter(|(_, values, _)| !values.is_empty()) {
        packed.add_attribute(attribute(kind, values, size));
    }
    packed.set_num_faces(mesh.indices.len() / 3);
    packed.set_faces_from_flat_indices(&mesh.indices);
    let mut encoder = MeshEncoder::new();
    encoder.set_mesh(packed);
    let mut options = EncoderOptions::new();
    options.set_global_int("encoding_speed", speed);
    let mut buffer = EncoderBuffer::new();
    encoder.encode(&options, &mut buffer).expect("a mesh can be encoded");
    buffer.data().to_vec()
}
