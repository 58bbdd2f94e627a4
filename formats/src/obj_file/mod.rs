//! Wavefront OBJ, read and written so that objects, groups and materials stay as they are.
//!
//! A reader of our own: the crates for OBJ hand out triangulated models and lose what a writer
//! needs to give the same file back (the difference between objects and groups, vertices without
//! faces, lines and points), and they cut concave polygons as fans.

mod build;
mod materials;
mod parse;
mod write;

use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use chamfer::Chamfered;

use crate::document::{
    Document, Encoded, Format, Look, Looks, NormalsRead, OutputFile, ReadOptions, SourceMesh,
    no_direction,
};
use crate::glb;
use crate::weld;

use build::Origin;
use parse::{Item, Obj};

/// An OBJ file: all its objects are one mesh, because CAD programs put every face of a closed
/// body into an object of its own. Each run of faces of one object, group and material is a
/// submesh.
pub struct ObjDocument {
    mesh: SourceMesh,
    normals: NormalsRead,
    /// The folder that names in the file start from.
    folder: PathBuf,
    obj: Obj,
    origin: Origin,
    /// How many positions were moved onto others.
    welded: usize,
    /// How many corners have a normal that is none.
    without_direction: usize,
    /// The file as it was, where there is no face to change.
    unchanged: Option<Vec<u8>>,
}

/// Reads the bytes of an OBJ file. Polygons are cut into triangles; corners without a normal get one by the
/// smoothing angle.
///
/// # Errors
/// Where a line makes no sense: it is named by its number.
pub fn decode(path: &Path, bytes: Vec<u8>, options: &ReadOptions) -> Result<ObjDocument> {
    let mut obj = parse::parse(&bytes)?;
    let welded = weld::weld(&mut obj.positions, options.weld);
    let build::Built { mesh, origin, normals, without_direction } = build::build(&obj, options)?;
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    Ok(ObjDocument {
        unchanged: mesh.indices.is_empty().then_some(bytes),
        mesh: SourceMesh { name: stem.into_owned(), mesh },
        normals,
        folder: path.parent().unwrap_or(Path::new("")).to_path_buf(),
        obj,
        origin,
        welded,
        without_direction,
    })
}

impl Document for ObjDocument {
    fn meshes(&self) -> &[SourceMesh] {
        std::slice::from_ref(&self.mesh)
    }

    fn normals(&self) -> &[NormalsRead] {
        std::slice::from_ref(&self.normals)
    }

    fn counts_from_below(&self) -> bool {
        true
    }

    fn notes(&self) -> Vec<String> {
        let mut notes = self.obj.slips.notes();
        notes.extend(weld::note(self.welded));
        notes.extend(no_direction(self.without_direction));
        if !self.obj.dropped.is_empty() {
            let names: Vec<&str> = self.obj.dropped.iter().map(String::as_str).collect();
            let names = names.join(", ");
            notes.push(format!("statements left out because nothing is known of them: {names}"));
        }
        notes
    }

    fn materials(&self) -> Vec<Vec<Option<String>>> {
        vec![self.obj.materials_of_runs()]
    }

    fn looks(&self) -> Looks {
        self.known_looks()
    }

    fn encode(&self, format: Format, output: &Path, chamfered: &[Chamfered]) -> Result<Encoded> {
        let result = chamfered.first().context("the mesh is missing")?;
        if format == Format::Glb {
            let (bytes, notes) = self.to_glb(result)?;
            let files = vec![OutputFile { path: output.to_path_buf(), bytes }];
            return Ok(Encoded { files, notes });
        }
        let bytes = match &self.unchanged {
            Some(bytes) => bytes.clone(),
            None => write::write(&self.obj, &self.mesh.mesh, &self.origin, result),
        };
        let mut files = vec![OutputFile { path: output.to_path_buf(), bytes }];
        files.extend(materials::companions(&self.obj, &self.folder, output)?);
        Ok(files.into())
    }
}

impl ObjDocument {
    fn known_looks(&self) -> Looks {
        let mut looks = Looks { meshes: vec![Vec::new()], ..Looks::default() };
        // Without its library it looks like clay.
        let (library, _) = materials::known(&self.obj, &self.folder).unwrap_or_default();
        for name in self.obj.materials_of_runs() {
            let known = library.iter().find(|known| Some(&known.name) == name.as_ref());
            let Some(known) = known else {
                looks.meshes[0].push(Look::default());
                continue;
            };
            let [red, green, blue, _] = known.color;
            let picture = known.texture.as_ref().map(|picture| {
                looks.pictures.push(picture.bytes.clone());
                looks.pictures.len() - 1
            });
            // OBJ counts the second texture coordinate from below.
            looks.meshes[0].push(Look { color: [red, green, blue], picture, flips: true });
        }
        looks
    }

    /// The file, and what it is without.
    fn to_glb(&self, result: &Chamfered) -> Result<(Vec<u8>, Vec<String>)> {
        let mut mesh = result.mesh.clone();
        // OBJ counts the second texture coordinate from below, glTF from above.
        let uv = &mut mesh.uvs[0];
        for v in uv.values.iter_mut().skip(1).step_by(uv.components.max(1) as usize) {
            *v = 1.0 - *v;
        }
        let (library, pictures) = materials::known(&self.obj, &self.folder)?;
        let note = |name| format!("{name} is no PNG or JPEG, which glTF needs: it was left out");
        let mut notes: Vec<String> = pictures.into_iter().map(note).collect();
        if self.obj.items.iter().any(|item| matches!(item, Item::Element(..))) {
            notes.push("its lines and points were left out".into());
        }
        let materials = self.obj.materials_of_runs();
        Ok((glb::encode(&self.mesh.name, &mesh, &materials, &library)?, notes))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const MODEL: &str = "\
mtllib a.mtl\no a\nv 0 0 0\nv 1 0 0 1 0 0\nv 1 1 0\nv 0 1 0\nv 0.5 0.5 1\nvt 0 0\nvt 1 1 0\n
vn 0 0 1\nusemtl m\nf 1/1/1 2/2/1 3/1/1 4/2\nf 1 2 5\nf -1// -2/1 \\\n -3\nl 1 5\np 2\n";

    /// A small generator of repeatable noise (Marsaglia's xorshift).
    fn next(state: &mut u64) -> usize {
        *state ^= *state << 13;
        *state ^= *state >> 7;
        *state ^= *state << 17;
        *state as usize
    }

    fn with_noise(state: &mut u64) -> Vec<u8> {
        const BYTES: &[u8] = b"0123456789-/ .\n\\vfnolpe#\xff";
        let mut bytes = MODEL.as_bytes().to_vec();
        for _ in 0..1 + next(state) % 6 {
            let place = next(state) % bytes.len();
            bytes[place] = BYTES[next(state) % BYTES.len()];
        }
        bytes.truncate(bytes.len() - next(state) % 8);
        bytes
    }

    #[test]
    fn damaged_files_are_read_or_refused_and_what_is_read_is_consistent() {
        let mut state = 1;
        let mut read = 0;
        for _ in 0..4000 {
            let Ok(obj) = parse::parse(&with_noise(&mut state)) else { continue };
            let build::Built { mesh, origin, .. } =
                build::build(&obj, &ReadOptions::default()).unwrap();
            let vertices = mesh.positions.len();
            assert_eq!(mesh.normals.len(), vertices);
            assert_eq!(mesh.uvs[0].values.len(), vertices * mesh.uvs[0].components as usize);
            assert_eq!(origin.position_of.len(), vertices);
            assert!(mesh.indices.iter().all(|&index| (index as usize) < vertices));
            let total: u32 = mesh.submesh_index_counts.iter().sum();
            assert_eq!(total as usize, mesh.indices.len());
            read += 1;
        }
        assert!(read > 100, "only {read} were still readable");
    }
}
