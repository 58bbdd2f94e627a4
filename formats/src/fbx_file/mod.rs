//! Reads FBX, binary and ASCII, of all versions since 3: with ufbx, which is made for files that
//! nobody vouches for. What it finds becomes a glTF in memory, and goes on as any other does.
//!
//! There is no writer: FBX is not documented, and what reads FBX reads glTF.

mod materials;
mod mesh;
mod nodes;
mod scene;
mod skin;

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;

use anyhow::{Result, anyhow};
use chamfer::Chamfered;
use ufbx::{
    AllocatorOpts, CoordinateAxes, GeometryTransformHandling, InheritModeHandling, LoadOpts,
    SpaceConversion,
};

use crate::document::{Document, Encoded, Format, Instance, NormalsRead, ReadOptions, SourceMesh};
use crate::gltf_file::GltfDocument;

/// Memory that any file may take, and for each of its bytes if that is more: arrays are compressed.
const FREE_BYTES: usize = 1 << 28;
const BYTES_PER_BYTE: usize = 128;

/// An FBX file, as the glTF that it becomes.
pub struct FbxDocument {
    gltf: GltfDocument,
    notes: Vec<String>,
}

/// Reads the bytes of an FBX file that lies, or would lie, at a path.
///
/// # Errors
/// Where it is no FBX, is cut off, or has geometry that makes no sense.
pub fn decode(path: &Path, bytes: &[u8], options: &ReadOptions) -> Result<FbxDocument> {
    let folder = path.parent().unwrap_or(Path::new(""));
    // Whatever is wrong with a file, or with the reader, is an error of that file alone.
    let convert = || scene::convert(&*load(bytes)?, folder);
    let converted = catch_unwind(AssertUnwindSafe(convert))
        .unwrap_or_else(|_| Err(anyhow!("the reader of FBX gave up")))?;
    let gltf = GltfDocument::decode(path, converted.glb, options)?;
    Ok(FbxDocument { gltf, notes: converted.notes })
}

/// The scene in metres, with y up, as glTF has it.
fn load(bytes: &[u8]) -> Result<ufbx::SceneRoot> {
    let memory_limit = FREE_BYTES.max(bytes.len().saturating_mul(BYTES_PER_BYTE));
    let allocator = || AllocatorOpts { memory_limit, ..AllocatorOpts::default() };
    let options = LoadOpts {
        temp_allocator: allocator(),
        result_allocator: allocator(),
        ignore_animation: true,
        clean_skin_weights: true,
        target_axes: CoordinateAxes::right_handed_y_up(),
        target_unit_meters: 1.0,
        space_conversion: SpaceConversion::ModifyGeometry,
        geometry_transform_handling: GeometryTransformHandling::ModifyGeometry,
        inherit_mode_handling: InheritModeHandling::Compensate,
        file_format: ufbx::FileFormat::Fbx,
        ..LoadOpts::default()
    };
    ufbx::load_memory(bytes, options).map_err(|error| {
        let (what, more) = (error.description.as_ref(), error.info());
        let more = if more.is_empty() { String::new() } else { format!(" ({more})") };
        anyhow!("cannot be read as FBX: {what}{more}: export it anew")
    })
}

impl Document for FbxDocument {
    fn meshes(&self) -> &[SourceMesh] {
        self.gltf.meshes()
    }

    fn normals(&self) -> &[NormalsRead] {
        self.gltf.normals()
    }

    fn instances(&self) -> Vec<Instance> {
        self.gltf.instances()
    }

    fn materials(&self) -> Vec<Vec<Option<String>>> {
        self.gltf.materials()
    }

    fn counts_metres(&self) -> bool {
        true
    }

    fn give_own(&mut self, objects: &[usize]) {
        self.gltf.give_own(objects);
    }

    fn are_written(&self, chamfered: &[Chamfered]) -> Vec<bool> {
        self.gltf.are_written(chamfered)
    }

    fn notes(&self) -> Vec<String> {
        [self.notes.clone(), self.gltf.notes()].concat()
    }

    fn encode(&self, format: Format, output: &Path, chamfered: &[Chamfered]) -> Result<Encoded> {
        self.gltf.encode(format, output, chamfered)
    }
}
