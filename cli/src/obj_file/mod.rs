//! Wavefront OBJ, read and written so that objects, groups and materials stay as they are.
//!
//! A reader of our own: the crates for OBJ hand out triangulated models and lose what a writer
//! needs to give the same file back (the difference between objects and groups, vertices without
//! faces, lines and points), and they cut concave polygons as fans.

mod build;
mod parse;
mod polygon;
mod write;

use std::fs;
use std::path::Path;

use anyhow::{Context, Result};
use chamfer::Chamfered;

use crate::document::{Document, Instance, OutputFile, ReadOptions, SourceMesh};
use crate::format::Format;
use crate::glb;

use build::Origin;
use parse::Obj;

const IDENTITY: [[f32; 4]; 4] =
    [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]];

/// An OBJ file: all its objects are one mesh, because CAD programs put every face of a closed
/// body into an object of its own. Each run of faces of one object, group and material is a
/// submesh.
pub struct ObjDocument {
    mesh: SourceMesh,
    obj: Obj,
    origin: Origin,
    /// The file as it was, where there is no face to change.
    unchanged: Option<Vec<u8>>,
}

/// Reads an OBJ file. Polygons are cut into triangles; corners without a normal get one by the
/// smoothing angle.
///
/// # Errors
/// Where the file cannot be read, or a line makes no sense: it is named by its number.
pub fn read(path: &Path, options: &ReadOptions) -> Result<ObjDocument> {
    let bytes = fs::read(path)?;
    let obj = parse::parse(&bytes)?;
    let (mesh, origin) = build::build(&obj, options.smoothing_angle)?;
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    Ok(ObjDocument {
        unchanged: mesh.indices.is_empty().then_some(bytes),
        mesh: SourceMesh { name: stem.into_owned(), mesh },
        obj,
        origin,
    })
}

impl Document for ObjDocument {
    fn meshes(&self) -> &[SourceMesh] {
        std::slice::from_ref(&self.mesh)
    }

    fn instances(&self) -> Vec<Instance> {
        vec![Instance { mesh: 0, transform: IDENTITY }]
    }

    fn notes(&self) -> Vec<String> {
        if self.obj.dropped.is_empty() {
            return Vec::new();
        }
        let names: Vec<&str> = self.obj.dropped.iter().map(String::as_str).collect();
        vec![format!("statements left out because nothing is known of them: {}", names.join(", "))]
    }

    fn encode(&self, output: &Path, chamfered: &[Chamfered]) -> Result<Vec<OutputFile>> {
        let result = chamfered.first().context("the mesh is missing")?;
        let bytes = match (Format::of(output), &self.unchanged) {
            (Some(Format::Glb), _) => self.to_glb(result)?,
            (_, Some(bytes)) => bytes.clone(),
            _ => write::write(&self.obj, &self.mesh.mesh, &self.origin, result),
        };
        Ok(vec![OutputFile { path: output.to_path_buf(), bytes }])
    }
}

impl ObjDocument {
    fn to_glb(&self, result: &Chamfered) -> Result<Vec<u8>> {
        let mut mesh = result.mesh.clone();
        // OBJ counts the second texture coordinate from below, glTF from above.
        let uv = &mut mesh.uvs[0];
        for v in uv.values.iter_mut().skip(1).step_by(uv.components.max(1) as usize) {
            *v = 1.0 - *v;
        }
        glb::encode(&self.mesh.name, &mesh, &self.obj.materials_of_runs())
    }
}
