//! Reads and writes glTF 2, as .glb or as .gltf with its buffers beside it or inside it.
//!
//! Triangles of one glTF mesh are one mesh of the core, its triangle primitives the submeshes.
//! Writing changes the JSON that was read: chamfered primitives get new accessors in the places of
//! the old, and all else, unknown extensions included, stays as it is.
//!
//! What is written:
//! - A file in which no mesh changed goes out byte for byte if it keeps its format.
//! - Otherwise all buffers are folded into one: the chunk of a .glb; for a .gltf a file named
//!   after the output, or a data URI where the input had only those.
//! - Images in buffers stay there. Images that are files keep their URIs; where the output goes
//!   to another folder they are copied to the same place beside it. Those of a .gltf that becomes a
//!   .glb go into it.

mod accessor;
mod accessor_writer;
mod budget;
pub mod buffers;
mod compressed;
mod container;
mod copies;
mod core_mesh;
#[cfg(feature = "draco")]
mod draco_mesh;
#[cfg(not(feature = "draco"))]
#[path = "draco_left_out.rs"]
mod draco_mesh;
mod element;
mod extensions;
mod fold;
mod follow;
mod further;
mod geometry;
mod json;
mod labels;
mod looks;
mod materials;
#[cfg(feature = "meshopt")]
mod meshopt_codec;
#[cfg(feature = "meshopt")]
mod meshopt_pack;
#[cfg(not(feature = "meshopt"))]
#[path = "meshopt_left_out.rs"]
mod meshopt_pack;
mod meshopt_views;
mod names;
mod places;
mod quantized;
mod references;
mod resources;
mod rewrite;
mod scene;
mod skin;
mod triangles;
mod unpacked;
mod uri;

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail, ensure};
use chamfer::Chamfered;
use serde_json::Value;

use crate::document::{
    Document, Encoded, Format, Further, Instance, Looks, Normals, NormalsRead, OutputFile, Place,
    ReadOptions, SourceMesh,
};
use crate::weld;
use accessor_writer::AccessorWriter;
use budget::Budget;
use compressed::Plain;
use container::Container;
use extensions::Mentions;
use geometry::{GeometryReader, MeshGeometry};
use quantized::OnGrid;
use references::Replaced;
use rewrite::Rewrite;
use scene::Object;
use uri::Target;

pub(crate) use container::write_glb;
use meshopt_pack::WRITTEN_WITHOUT;
pub use meshopt_pack::compress;

/// A glTF file that was read.
pub struct GltfDocument {
    path: PathBuf,
    /// The file as it was.
    bytes: Vec<u8>,
    format: Format,
    json: Value,
    /// `#buffers`: their content.
    buffers: Vec<Vec<u8>>,
    meshes: Vec<SourceMesh>,
    /// `#meshes`
    geometries: Vec<MeshGeometry>,
    /// `#meshes`
    normals: Vec<NormalsRead>,
    objects: Vec<Object>,
    /// `#meshes`: those of the file, then copies: the mesh that each is like.
    copied: Vec<usize>,
    /// The URIs of the buffers of the file, before any was unpacked.
    buffer_uris: Vec<Option<String>>,
    /// The extensions that it was compressed with.
    compressions: Vec<&'static str>,
    /// What the user should know.
    notes: Vec<String>,
}

/// A file with chamfered meshes.
struct Rewritten {
    json: Value,
    /// The content of its one buffer.
    buffer: Vec<u8>,
    notes: Vec<String>,
}

impl GltfDocument {
    /// Reads a .glb or .gltf; which of the two is seen from its first bytes.
    ///
    /// # Errors
    /// Where the file, or one that it refers to, cannot be read; where it breaks a rule of glTF
    /// that its geometry or its nodes depend on.
    pub fn read(path: &Path, options: &ReadOptions) -> Result<GltfDocument> {
        Self::decode(path, fs::read(path)?, options)
    }

    /// Reads the bytes of a .glb or .gltf that lies, or would lie, at `path`.
    ///
    /// # Errors
    /// As [`GltfDocument::read`].
    pub fn decode(path: &Path, bytes: Vec<u8>, options: &ReadOptions) -> Result<GltfDocument> {
        let Container { format, json, binary, .. } = container::parse(&bytes)?;
        let json: Value = serde_json::from_slice(json).context("the JSON cannot be read")?;
        ensure!(json.is_object(), "the JSON is not an object");
        extensions::refuse_other_versions(&json)?;
        let buffer_uris = buffer_uris(&json);
        let buffers = read_buffers(&json, binary, &resources::folder(path))?;
        let Plain { json, buffers, dropped } = compressed::plain(json, buffers)?;
        extensions::refuse_unreadable(&json)?;
        let mut notes = Vec::new();
        let size = bytes.len() + buffers.iter().map(Vec::len).sum::<usize>();
        let budget = Budget::of_file(size);
        let reader = GeometryReader::new(&json, &buffers, &budget);
        let objects = scene::objects(&json, &|accessor| reader.first_matrix(accessor), &mut notes)?;
        let (mut meshes, mut geometries, mut normals) = (Vec::new(), Vec::new(), Vec::new());
        let mut welded = 0;
        for (index, value) in json::list(&json, "meshes").iter().enumerate() {
            let mut geometry = reader.read(index)?;
            welded += geometry.weld(options.weld);
            let without = core_mesh::without_direction(&geometry);
            if options.normals == Normals::Angle {
                geometry.drop_normals();
            }
            let mesh = core_mesh::build(&mut geometry, options.smoothing_angle)?;
            let read = core_mesh::normals_read(&geometry, &mesh);
            let name = name_of(value, index);
            notes.extend(core_mesh::note(&name, without, &read));
            normals.push(read);
            geometry.forget_core_streams();
            meshes.push(SourceMesh { name, mesh });
            geometries.push(geometry);
        }
        notes.extend(reader.notes());
        notes.extend(weld::note(welded));
        Ok(GltfDocument {
            path: path.to_owned(),
            format,
            copied: (0..meshes.len()).collect(),
            json,
            buffers,
            meshes,
            geometries,
            normals,
            objects,
            buffer_uris,
            compressions: dropped,
            notes,
            bytes,
        })
    }

    /// A further submesh without triangles is no change.
    fn is_changed(&self, mesh: usize, chamfered: &Chamfered) -> bool {
        let (old, new) = (&self.meshes[mesh].mesh, &chamfered.mesh);
        let old_counts = &old.submesh_index_counts[..];
        let further = new.submesh_index_counts.strip_prefix(old_counts);
        !further.is_some_and(|counts| counts.iter().all(|count| *count == 0))
            || new.indices != old.indices
            || new.positions != old.positions
            || new.normals != old.normals
            || new.tangents != old.tangents
            || new.colors != old.colors
            || new.uvs != old.uvs
    }

    fn are_changed(&self, chamfered: &[Chamfered]) -> Vec<bool> {
        let is_changed = |(mesh, result)| self.is_changed(mesh, result);
        chamfered.iter().enumerate().map(is_changed).collect()
    }

    /// The file as it was, and the files it refers to if it goes to another folder.
    fn encode_unchanged(&self, output: &Path) -> Result<Vec<OutputFile>> {
        let mut files = vec![OutputFile { path: output.to_owned(), bytes: self.bytes.clone() }];
        files.extend(self.copies(&self.json, "buffers", output)?);
        files.extend(resources::without_existing(self.copies(&self.json, "images", output)?)?);
        Ok(files)
    }

    fn copies(&self, json: &Value, key: &str, output: &Path) -> Result<Vec<OutputFile>> {
        let (from, to) = (resources::folder(&self.path), resources::folder(output));
        resources::copies(json, key, &from, &to)
    }

    /// The file with all chamfered meshes in it.
    fn rewritten(&self, chamfered: &[Chamfered]) -> Result<Rewritten> {
        let is_changed = self.are_changed(chamfered);
        let numbers = copies::numbers(&self.copied, &is_changed);
        let mut json = copies::without_needless(&self.json, &self.objects, &numbers);
        let mentions = Mentions::of(&json);
        let freed = references::freed(&json, &self.replaced(&is_changed, &numbers), &mentions)?;
        let mut writer = AccessorWriter::new(&json, freed);
        let note = |name| format!("it was compressed ({name}), {WRITTEN_WITHOUT}");
        let mut notes: Vec<String> = self.compressions.iter().map(note).collect();
        for (index, result) in chamfered.iter().enumerate() {
            if !is_changed[index] {
                continue;
            }
            let (geometry, source) = (&self.geometries[index], &self.meshes[index]);
            let on_grid = quantized::on_grid(geometry, &source.mesh, result);
            if matches!(on_grid, OnGrid::No) {
                let name = &source.name;
                notes.push(format!(
                    "mesh {name} was quantized, too coarse for its chamfers: its positions are \
                     written as floats"
                ));
            }
            let rewrite = Rewrite::new(geometry, on_grid.result().unwrap_or(result));
            rewrite
                .and_then(|rewrite| rewrite.write(&mut json["meshes"][numbers[index]], &mut writer))
                .with_context(|| format!("mesh {:?}", self.meshes[index].name))?;
        }
        let needed_quantization = extensions::needs_quantization(&self.json)?;
        let bytes = fold::fold(&mut json, &self.buffers, writer.finish(), !mentions.buffers)?;
        if needed_quantization {
            extensions::drop_unneeded_quantization(&mut json)?;
        }
        extensions::drop_unneeded_restart(&mut json);
        Ok(Rewritten { json, buffer: bytes, notes })
    }

    fn replaced(&self, is_changed: &[bool], numbers: &[usize]) -> BTreeSet<Replaced> {
        let mut replaced = BTreeSet::new();
        for (mesh, geometry) in self.geometries.iter().enumerate() {
            if is_changed[mesh] {
                replaced.extend(geometry.submeshes.iter().map(|submesh| Replaced {
                    mesh: numbers[mesh],
                    primitive: submesh.primitive,
                    drops_tangents: geometry.blocks[submesh.block].smoothed,
                }));
            }
        }
        replaced
    }

    fn encode_glb(&self, output: &Path, json: &Value, buffer: &[u8]) -> Result<Vec<OutputFile>> {
        let further = match self.format {
            Format::Glb => container::parse(&self.bytes)?.further_chunks,
            _ => &[],
        };
        let bytes = container::write_glb(&serde_json::to_vec(json)?, buffer, further)?;
        Ok(vec![OutputFile { path: output.to_owned(), bytes }])
    }

    fn encode_gltf(
        &self,
        output: &Path,
        mut json: Value,
        buffer: Vec<u8>,
    ) -> Result<Vec<OutputFile>> {
        let mut files = Vec::new();
        if !buffer.is_empty() {
            let name = output.with_extension("bin");
            let file_name = name.file_name().and_then(|name| name.to_str());
            let file_name = file_name.context("the output's name is not UTF-8")?;
            json["buffers"][0]["uri"] = match self.has_only_data_uris() {
                true => uri::write_data(&buffer).into(),
                false => uri::write_name(file_name).into(),
            };
            if !self.has_only_data_uris() {
                self.protect_buffers(output, &name)?;
                files.push(OutputFile { path: name, bytes: buffer });
            }
        }
        let bytes = serde_json::to_vec_pretty(&json)?;
        files.insert(0, OutputFile { path: output.to_owned(), bytes });
        Ok(files)
    }

    /// Fails where a new buffer file would take the place of one that the input needs.
    fn protect_buffers(&self, output: &Path, new: &Path) -> Result<()> {
        let is_same = |a: &Path, b: &Path| {
            a.canonicalize().ok().is_some_and(|a| b.canonicalize().ok() == Some(a))
        };
        if is_same(output, &self.path) {
            return Ok(());
        }
        let folder = resources::folder(&self.path);
        for uri in self.buffer_uris.iter().flatten() {
            let Target::Inside(old) = uri::target(uri)? else { continue };
            ensure!(
                !is_same(&folder.join(old), new),
                "{} belongs to the input and would be overwritten: name the output otherwise",
                new.display()
            );
        }
        Ok(())
    }

    fn has_only_data_uris(&self) -> bool {
        let is_data = |uri: &Option<String>| uri.as_ref().is_some_and(|u| u.starts_with("data:"));
        self.format == Format::Gltf && self.buffer_uris.iter().all(is_data)
    }
}

impl Document for GltfDocument {
    fn meshes(&self) -> &[SourceMesh] {
        &self.meshes
    }

    fn normals(&self) -> &[NormalsRead] {
        &self.normals
    }

    fn instances(&self) -> Vec<Instance> {
        self.objects.iter().map(|object| object.instance).collect()
    }

    fn materials(&self) -> Vec<Vec<Option<String>>> {
        materials::names(&self.json, &self.geometries)
    }

    fn further(&self, mesh: usize) -> Option<Further> {
        let count = self.meshes[mesh].mesh.positions.len();
        let names = places::joint_names(&self.json, mesh);
        Some(further::further(&self.geometries[mesh], count, &names))
    }

    fn places(&self) -> Vec<Place> {
        places::places(&self.json, &self.buffers)
    }

    fn counts_metres(&self) -> bool {
        true
    }

    fn give_own(&mut self, objects: &[usize]) {
        let Some(first) = objects.first() else { return };
        let (mesh, copy) = (self.objects[*first].instance.mesh, self.meshes.len());
        copies::add(&mut self.json, mesh);
        for &object in objects {
            self.objects[object].instance.mesh = copy;
            copies::set_mesh(&mut self.json, &self.objects[object], copy);
        }
        let name = name_of(&self.json["meshes"][copy], copy);
        self.meshes.push(SourceMesh { name, ..self.meshes[mesh].clone() });
        self.geometries.push(self.geometries[mesh].clone());
        self.normals.push(self.normals[mesh].clone());
        self.copied.push(self.copied[mesh]);
    }

    fn are_written(&self, chamfered: &[Chamfered]) -> Vec<bool> {
        let numbers = copies::numbers(&self.copied, &self.are_changed(chamfered));
        let is_written = |(mesh, number)| mesh == self.copied[mesh] || number != self.copied[mesh];
        numbers.into_iter().enumerate().map(is_written).collect()
    }

    fn notes(&self) -> Vec<String> {
        self.notes.clone()
    }

    fn looks(&self) -> Looks {
        let folder = resources::folder(&self.path);
        looks::looks(&self.json, &self.buffers, &folder, &self.geometries)
    }

    fn encode(&self, format: Format, output: &Path, chamfered: &[Chamfered]) -> Result<Encoded> {
        ensure!(
            chamfered.len() == self.meshes.len(),
            "{} meshes were read, but {} chamfered",
            self.meshes.len(),
            chamfered.len()
        );
        let changed = chamfered.iter().enumerate().any(|(i, result)| self.is_changed(i, result));
        if !changed && format == self.format && self.compressions.is_empty() {
            return Ok(self.encode_unchanged(output)?.into());
        }
        let Rewritten { mut json, mut buffer, notes } = self.rewritten(chamfered)?;
        if format == Format::Glb && self.format == Format::Gltf {
            resources::embed_images(&mut json, &mut buffer, &resources::folder(&self.path))?;
        }
        let images = resources::without_existing(self.copies(&json, "images", output)?)?;
        let mut files = match format {
            Format::Glb => self.encode_glb(output, &json, &buffer)?,
            _ => self.encode_gltf(output, json, buffer)?,
        };
        files.extend(images);
        Ok(Encoded { files, notes })
    }
}

/// As the file calls a mesh, or its number.
fn name_of(mesh: &Value, number: usize) -> String {
    let name = mesh.get("name").and_then(Value::as_str);
    name.map_or_else(|| format!("mesh {number}"), str::to_owned)
}

fn buffer_uris(json: &Value) -> Vec<Option<String>> {
    let uri = |buffer: &Value| buffer.get("uri").and_then(Value::as_str).map(str::to_owned);
    json::list(json, "buffers").iter().map(uri).collect()
}

/// The content of all buffers; nothing for one that only stands in for compressed ones and is not
/// there.
fn read_buffers(json: &Value, binary: Option<&[u8]>, folder: &Path) -> Result<Vec<Vec<u8>>> {
    let mut buffers = Vec::new();
    for (index, buffer) in json::list(json, "buffers").iter().enumerate() {
        let read = read_buffer(buffer, index, binary, folder);
        buffers.push(match read {
            Err(_) if meshopt_views::is_fallback(buffer) => Vec::new(),
            read => read?,
        });
    }
    Ok(buffers)
}

fn read_buffer(
    buffer: &Value,
    index: usize,
    binary: Option<&[u8]>,
    folder: &Path,
) -> Result<Vec<u8>> {
    let path = format!("buffers[{index}]");
    let length = json::required(buffer, "byteLength", &path)?;
    let mut bytes = match (buffer.get("uri").and_then(Value::as_str), binary) {
        (Some(uri), _) => uri::read(uri, folder).with_context(|| path.clone())?,
        (None, Some(binary)) if index == 0 => binary.to_vec(),
        _ => bail!("{path} has neither a URI nor a chunk of a .glb"),
    };
    ensure!(
        bytes.len() >= length,
        "{path} should have {length} bytes, but has {}: it is cut off, fetch or export it anew",
        bytes.len()
    );
    bytes.truncate(length);
    Ok(bytes)
}
