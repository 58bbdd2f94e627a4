//! The formats of model files, a row each: the only place that knows all readers.

use std::fs;
use std::path::Path;

use anyhow::{Context, Result, bail};
use chamfer::Chamfered;

use crate::document::{Document, Encoded, Format, ReadOptions};
use crate::gltf_file::GltfDocument;
use crate::{foreign, obj_file, off_file, ply_file, stl_file};

/// A document that was read, of any format.
pub type Read = Box<dyn Document + Send>;

/// What there is to know of a format.
pub struct Row {
    /// Which one it is.
    pub format: Format,
    /// As people call it.
    pub name: &'static str,
    /// As file names have it, without the dot, in lower case.
    pub ending: &'static str,
    /// Reads the bytes of a file that lies, or would lie, at a path.
    reader: fn(&Path, Vec<u8>, &ReadOptions) -> Result<Read>,
    /// What its documents can be written as: first what they become where nobody asks for another.
    pub writes: &'static [Format],
}

/// All formats, in the order of [`Format`].
pub static FORMATS: [Row; 7] = [
    Row {
        format: Format::Glb,
        name: "glTF, binary",
        ending: "glb",
        reader: |path, bytes, options| Ok(Box::new(GltfDocument::decode(path, bytes, options)?)),
        writes: &[Format::Glb, Format::Gltf],
    },
    Row {
        format: Format::Gltf,
        name: "glTF",
        ending: "gltf",
        reader: |path, bytes, options| Ok(Box::new(GltfDocument::decode(path, bytes, options)?)),
        writes: &[Format::Gltf, Format::Glb],
    },
    Row {
        format: Format::Obj,
        name: "Wavefront OBJ",
        ending: "obj",
        reader: |path, bytes, options| Ok(Box::new(obj_file::decode(path, bytes, options)?)),
        writes: &[Format::Obj, Format::Glb],
    },
    Row {
        format: Format::Stl,
        name: "stereolithography, ASCII or binary",
        ending: "stl",
        reader: |path, bytes, options| Ok(Box::new(stl_file::decode(path, &bytes, options)?)),
        writes: &[Format::Glb, Format::Stl],
    },
    Row {
        format: Format::Fbx,
        name: "FBX, binary or ASCII",
        ending: "fbx",
        reader: fbx,
        writes: &[Format::Glb, Format::Gltf],
    },
    Row {
        format: Format::Ply,
        name: "PLY, ASCII or binary",
        ending: "ply",
        reader: |path, bytes, options| Ok(Box::new(ply_file::decode(path, &bytes, options)?)),
        writes: &[Format::Glb],
    },
    Row {
        format: Format::Off,
        name: "OFF, in text",
        ending: "off",
        reader: |path, bytes, options| Ok(Box::new(off_file::decode(path, &bytes, options)?)),
        writes: &[Format::Glb],
    },
];

#[cfg(feature = "fbx")]
fn fbx(path: &Path, bytes: Vec<u8>, options: &ReadOptions) -> Result<Read> {
    Ok(Box::new(crate::fbx_file::decode(path, &bytes, options)?))
}

#[cfg(not(feature = "fbx"))]
fn fbx(_: &Path, _: Vec<u8>, _: &ReadOptions) -> Result<Read> {
    Err(crate::left_out::left_out("FBX", "fbx"))
}

impl Row {
    /// The row of what a model of this format becomes where nobody asks for another.
    pub fn usual_output(&self) -> &'static Row {
        row(self.writes[0])
    }

    /// Fails where a model of this format cannot be written as `output`.
    ///
    /// # Errors
    /// Says what it can be written as.
    pub fn check_conversion(&self, output: &Row) -> Result<()> {
        if !self.writes.contains(&output.format) {
            let possible: Vec<String> =
                self.writes.iter().map(|format| format!(".{}", row(*format).ending)).collect();
            bail!(
                ".{} cannot be written as .{}, only as {}",
                self.ending,
                output.ending,
                possible.join(" or ")
            );
        }
        Ok(())
    }
}

fn row(format: Format) -> &'static Row {
    &FORMATS[format as usize]
}

/// The row of the format that a path's ending names.
pub fn row_of(path: &Path) -> Option<&'static Row> {
    let ending = path.extension()?.to_str()?;
    FORMATS.iter().find(|row| ending.eq_ignore_ascii_case(row.ending))
}

/// The endings of all formats, for a sentence: `.a, .b or .c`.
pub fn endings() -> String {
    let endings: Vec<String> = FORMATS.iter().map(|row| format!(".{}", row.ending)).collect();
    let (last, others) = endings.split_last().map_or(("", &[][..]), |(l, o)| (l.as_str(), o));
    format!("{} or {last}", others.join(", "))
}

/// Reads a model of any format.
///
/// # Errors
/// Where the ending is unknown, the file cannot be read, or what is in it makes no sense.
pub fn read(path: &Path, options: &ReadOptions) -> Result<Read> {
    // Looked at first: whatever a file of an unknown kind holds, there is no need to load it.
    let row = known(path)?;
    decode_as(row, path, fs::read(path)?, options)
}

/// Reads a model from the bytes of its file. What it refers to is looked for beside `path`.
///
/// # Errors
/// As [`read`].
pub fn decode(path: &Path, bytes: Vec<u8>, options: &ReadOptions) -> Result<Read> {
    decode_as(known(path)?, path, bytes, options)
}

fn decode_as(row: &Row, path: &Path, bytes: Vec<u8>, options: &ReadOptions) -> Result<Read> {
    if let Some(what) = foreign::of_content(&bytes) {
        bail!("{what}");
    }
    (row.reader)(path, bytes, options)
}

/// The file with `chamfered[i]` in the place of mesh `i`, in the format that the ending of `output`
/// names: the file of that path first, then those that belong to it.
///
/// # Errors
/// Where the result does not fit the format, or the document cannot become one of that format.
pub fn encode(document: &dyn Document, output: &Path, chamfered: &[Chamfered]) -> Result<Encoded> {
    document.encode(known(output)?.format, output, chamfered)
}

fn known(path: &Path) -> Result<&'static Row> {
    row_of(path).with_context(|| match foreign::of_ending(path) {
        Some(what) => format!("files of this kind are not read: {what}"),
        None => format!("unknown kind of file: give {}", endings()),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_format_has_the_row_of_its_number() {
        assert!((0..).zip(&FORMATS).all(|(number, row)| row.format as usize == number));
    }

    #[test]
    fn endings_are_known_in_any_case() {
        let format = |path: &str| row_of(Path::new(path)).map(|row| row.format);
        assert_eq!(format("a/b.GLB"), Some(Format::Glb));
        assert_eq!(format("b.txt"), None);
        assert_eq!(format("glb"), None);
        assert_eq!(endings(), ".glb, .gltf, .obj, .stl, .fbx, .ply or .off");
    }

    #[test]
    fn a_text_in_utf_16_says_so() {
        let texts = [
            ("a.obj", "v 0 0 0\n"),
            ("a.stl", "solid a\nendsolid a\n"),
            ("a.ply", "ply\nformat ascii 1.0\nend_header\n"),
            ("a.off", "OFF\n0 0 0\n"),
            ("a.gltf", "{\"asset\": {\"version\": \"2.0\"}}"),
        ];
        for (path, text) in texts {
            for text in [text.to_owned(), format!("\u{feff}{text}")] {
                let bytes = text.encode_utf16().flat_map(u16::to_le_bytes).collect();
                let told = decode(Path::new(path), bytes, &ReadOptions::default()).err();
                let told = told.map(|error| error.to_string());
                let said = "this is text in UTF-16: save it as UTF-8, and read that";
                assert_eq!(told.as_deref(), Some(said), "{path}");
            }
        }
    }

    #[test]
    fn an_stl_usually_becomes_a_glb() {
        assert_eq!(row(Format::Stl).usual_output().format, Format::Glb);
        assert_eq!(row(Format::Obj).usual_output().format, Format::Obj);
    }

    #[test]
    fn a_gltf_cannot_become_an_obj() {
        let error = row(Format::Glb).check_conversion(row(Format::Obj)).unwrap_err();
        assert_eq!(error.to_string(), ".glb cannot be written as .obj, only as .glb or .gltf");
        assert!(row(Format::Obj).check_conversion(row(Format::Glb)).is_ok());
    }
}
