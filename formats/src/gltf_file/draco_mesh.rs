//! Primitives compressed by Draco (`KHR_draco_mesh_compression`).
//!
//! By the crate `draco-core`: it reads all versions of the format that there are files of, in Rust
//! alone, so that no C++ has to be built, and lets its caller say how large a result may be.

use std::panic::{AssertUnwindSafe, catch_unwind};

use anyhow::{Context, Result, anyhow, ensure};
use draco_core::{
    DataType, DecodeLimits, DecoderBuffer, Mesh, MeshDecoder, PointAttribute, PointIndex,
};

use super::element::{Component, ElementType, Shape, Stream};

/// The name of the extension.
pub const NAME: &str = "KHR_draco_mesh_compression";

/// A mesh that was unpacked.
pub struct DracoMesh(Mesh);

impl DracoMesh {
    /// Unpacks the bytes of a mesh to at most so many bytes.
    ///
    /// # Errors
    /// Where they are none that Draco could have made, or too many come out.
    pub fn decode(bytes: &[u8], most: usize) -> Result<DracoMesh> {
        let limits = DecodeLimits::default().with_max_decoded_bytes(most as u64);
        let limits = limits.with_max_points(most as u64 / 4).with_max_faces(most as u64 / 12);
        let decode = || {
            let mut mesh = Mesh::new();
            let mut buffer = DecoderBuffer::new(bytes).with_limits(limits);
            MeshDecoder::new().decode(&mut buffer, &mut mesh).map(|()| mesh)
        };
        // Whatever is wrong with a file, or with the crate, is an error of that file alone.
        let mesh = catch_unwind(AssertUnwindSafe(decode))
            .map_err(|_| anyhow!("the decoder gave up"))?
            .map_err(|error| anyhow!("{error}"))?;
        Ok(DracoMesh(mesh))
    }

    /// `#triangles by 3`, flattened.
    pub fn indices(&self) -> Result<Vec<u32>> {
        let points = self.point_count();
        let indices: Vec<u32> =
            self.0.faces().as_flattened().iter().map(|PointIndex(point)| *point).collect();
        let fit = indices.iter().all(|index| (*index as usize) < points);
        ensure!(fit, "a triangle names a vertex that is not there");
        Ok(indices)
    }

    /// How many vertices there are.
    pub fn point_count(&self) -> usize {
        self.0.num_points()
    }

    /// The attribute of that number by vertex: its numbers as they are stored, in a type without
    /// normalization.
    ///
    /// # Errors
    /// Where it is missing, or not of that shape.
    pub fn attribute(&self, number: u32, component: Component, shape: Shape) -> Result<Stream> {
        let attribute = self.0.attribute_by_unique_id(number).context("it is not there")?;
        let found = usize::from(attribute.num_components());
        let components = shape.components();
        ensure!(found == components, "it has {found} numbers a vertex, not {components}");
        let mut values = Vec::with_capacity(self.point_count() * components);
        for point in 0..self.point_count() {
            let element = element(attribute, point, &mut values);
            element.with_context(|| format!("vertex {point} is not there"))?;
        }
        Ok(Stream { element: ElementType { component, shape, normalized: false }, values })
    }
}

/// Appends the numbers of one vertex.
fn element(attribute: &PointAttribute, point: usize, values: &mut Vec<f64>) -> Option<()> {
    let place = attribute.mapped_index(PointIndex(point as u32)).0 as usize;
    let start = place.checked_mul(usize::try_from(attribute.byte_stride()).ok()?)?;
    let data = attribute.buffer().data().get(start..)?;
    let kind = attribute.data_type();
    for number in 0..usize::from(attribute.num_components()) {
        values.push(number_at(kind, data, number)?);
    }
    Some(())
}

fn number_at(kind: DataType, data: &[u8], place: usize) -> Option<f64> {
    let byte = || data.get(place).copied();
    let short = || Some([*data.get(2 * place)?, *data.get(2 * place + 1)?]);
    let word = || data.as_chunks::<4>().0.get(place).copied();
    Some(match kind {
        DataType::Int8 => f64::from(byte()? as i8),
        DataType::Uint8 | DataType::Bool => f64::from(byte()?),
        DataType::Int16 => f64::from(i16::from_le_bytes(short()?)),
        DataType::Uint16 => f64::from(u16::from_le_bytes(short()?)),
        DataType::Int32 => f64::from(i32::from_le_bytes(word()?)),
        DataType::Uint32 => f64::from(u32::from_le_bytes(word()?)),
        DataType::Float32 => f64::from(f32::from_le_bytes(word()?)),
        _ => return None,
    })
}
