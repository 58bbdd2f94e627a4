//! The formats of model files, and which can become which.

use std::path::Path;
use std::{fmt, fs};

use anyhow::{Context, Result, bail};

use crate::document::{Document, ReadOptions};
use crate::gltf_file::GltfDocument;
use crate::{obj_file, stl_file};

/// A format of model files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// glTF in one binary file.
    Glb,
    /// glTF as JSON, with its buffers beside it or inside.
    Gltf,
    /// Wavefront OBJ.
    Obj,
    /// Stereolithography triangles, ASCII or binary.
    Stl,
}

impl Format {
    /// The format that a path's extension names.
    pub fn of(path: &Path) -> Option<Format> {
        let extension = path.extension()?.to_str()?;
        [Format::Glb, Format::Gltf, Format::Obj, Format::Stl]
            .into_iter()
            .find(|format| extension.eq_ignore_ascii_case(format.extension()))
    }

    /// As file names have it, without the dot.
    pub fn extension(self) -> &'static str {
        match self {
            Format::Glb => "glb",
            Format::Gltf => "gltf",
            Format::Obj => "obj",
            Format::Stl => "stl",
        }
    }

    /// What a model of this format becomes where nobody asks for another.
    pub fn usual_output(self) -> Format {
        if self == Format::Stl { Format::Glb } else { self }
    }

    /// Whether a model of this format can be written as `output`.
    ///
    /// # Errors
    /// Says what it can be written as.
    pub fn check_conversion(self, output: Format) -> Result<()> {
        let possible: &[Format] = match self {
            Format::Glb | Format::Gltf => &[Format::Glb, Format::Gltf],
            Format::Obj => &[Format::Obj, Format::Glb],
            Format::Stl => &[Format::Glb, Format::Stl],
        };
        if !possible.contains(&output) {
            bail!(
                "{self} cannot be written as {output}, only as {} or {}",
                possible[0],
                possible[1]
            );
        }
        Ok(())
    }
}

impl fmt::Display for Format {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, ".{}", self.extension())
    }
}

/// Reads a model of any format.
///
/// # Errors
/// Where the extension is unknown, the file cannot be read, or what is in it makes no sense.
pub fn read(path: &Path, options: &ReadOptions) -> Result<Box<dyn Document + Send>> {
    // Looked at first: whatever a file of an unknown kind holds, there is no need to load it.
    let format = known(path)?;
    decode_as(format, path, fs::read(path)?, options)
}

/// Reads a model from the bytes of its file. What it refers to is looked for beside `path`.
///
/// # Errors
/// As [`read`].
pub fn decode(
    path: &Path,
    bytes: Vec<u8>,
    options: &ReadOptions,
) -> Result<Box<dyn Document + Send>> {
    decode_as(known(path)?, path, bytes, options)
}

fn known(path: &Path) -> Result<Format> {
    Format::of(path).context("unknown kind of file: give .glb, .gltf, .obj or .stl")
}

fn decode_as(
    format: Format,
    path: &Path,
    bytes: Vec<u8>,
    options: &ReadOptions,
) -> Result<Box<dyn Document + Send>> {
    Ok(match format {
        Format::Glb | Format::Gltf => Box::new(GltfDocument::decode(path, bytes, options)?),
        Format::Obj => Box::new(obj_file::decode(path, bytes, options)?),
        Format::Stl => Box::new(stl_file::decode(path, &bytes, options)?),
    })
}

/// Reads a file that a model refers to, which the user may know nothing of: a plain one, because a
/// pipe or a device could block for ever, in the model's folder or below, also where links lead.
///
/// # Errors
/// Where it is missing, elsewhere, may not be read, or is something else. Callers say which file it
/// was.
pub fn read_beside(folder: &Path, name: &Path) -> Result<Vec<u8>> {
    let folder = if folder == Path::new("") { Path::new(".") } else { folder };
    let path = folder.join(name).canonicalize()?;
    if !path.starts_with(folder.canonicalize()?) {
        bail!("a link leads out of the model's folder: put the file itself there");
    }
    if !fs::metadata(&path)?.is_file() {
        bail!("not a file");
    }
    Ok(fs::read(&path)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn extensions_are_known_in_any_case() {
        assert_eq!(Format::of(Path::new("a/b.GLB")), Some(Format::Glb));
        assert_eq!(Format::of(Path::new("b.txt")), None);
        assert_eq!(Format::of(Path::new("glb")), None);
    }

    #[test]
    fn an_stl_usually_becomes_a_glb() {
        assert_eq!(Format::Stl.usual_output(), Format::Glb);
        assert_eq!(Format::Obj.usual_output(), Format::Obj);
    }

    #[test]
    fn a_gltf_cannot_become_an_obj() {
        let error = Format::Glb.check_conversion(Format::Obj).unwrap_err();
        assert_eq!(error.to_string(), ".glb cannot be written as .obj, only as .glb or .gltf");
        assert!(Format::Obj.check_conversion(Format::Glb).is_ok());
    }
}
