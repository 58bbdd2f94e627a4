//! The formats of model files, and which can become which.

use std::fmt;
use std::path::Path;

use anyhow::{Result, bail};

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
    Ok(match Format::of(path) {
        Some(Format::Glb | Format::Gltf) => Box::new(GltfDocument::read(path, options)?),
        Some(Format::Obj) => Box::new(obj_file::read(path, options)?),
        Some(Format::Stl) => Box::new(stl_file::read(path, options)?),
        None => bail!("unknown kind of file: give .glb, .gltf, .obj or .stl"),
    })
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
