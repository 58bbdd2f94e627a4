//! Files that are no models of the formats here: what they are, and what to do about it.

use std::path::Path;

use anyhow::{Result, ensure};

/// The start of a file that is something else, what that is, and what to do.
const CONTENTS: [(&[u8], &str); 12] = [
    (
        b"version https://git-lfs.github.com/",
        "a Git LFS pointer, not a model: fetch the file itself with \"git lfs pull\"",
    ),
    (b"<!doctype html", "a web page, not a model: download the file itself"),
    (b"<html", "a web page, not a model: download the file itself"),
    (b"<?xml", "XML, not a model of this format: open it in Blender and export glTF (.glb)"),
    (b"BLENDER", "a Blender file: open it in Blender and export glTF (.glb)"),
    (b"PK\x03\x04", "a zip archive: unpack it, and give the model in it"),
    (b"\x1F\x8B", "compressed with gzip: unpack it first"),
    (b"7z\xBC\xAF\x27\x1C", "a 7z archive: unpack it, and give the model in it"),
    (b"Rar!", "a rar archive: unpack it, and give the model in it"),
    (b"\x28\xB5\x2F\xFD", "compressed with zstd, as Blender files are: export glTF (.glb)"),
    (b"\x89PNG", "a picture, not a model: give the model that it belongs to"),
    (b"\xFF\xD8\xFF", "a picture, not a model: give the model that it belongs to"),
];

/// Endings of model files that nothing here reads, and what to do.
const ENDINGS: [(&str, &str); 15] = [
    ("blend", "open it in Blender and export glTF (.glb)"),
    ("max", "export it as glTF or FBX from 3ds Max"),
    ("ma", "export it as FBX from Maya"),
    ("mb", "export it as FBX from Maya"),
    ("c4d", "export it as glTF from Cinema 4D"),
    ("dae", "open it in Blender 4 and export glTF (.glb)"),
    ("3ds", "open it in Blender and export glTF (.glb)"),
    ("usd", "open it in Blender and export glTF (.glb)"),
    ("usda", "open it in Blender and export glTF (.glb)"),
    ("usdc", "open it in Blender and export glTF (.glb)"),
    ("usdz", "open it in Blender and export glTF (.glb)"),
    ("step", "export it as STL or glTF from a CAD program"),
    ("stp", "export it as STL or glTF from a CAD program"),
    ("iges", "export it as STL or glTF from a CAD program"),
    ("igs", "export it as STL or glTF from a CAD program"),
];

/// What the bytes of a file are, if they are no model at all.
pub fn of_content(bytes: &[u8]) -> Option<&'static str> {
    if bytes.is_empty() {
        return Some("the file is empty: export or fetch it anew");
    }
    let text = bytes.trim_ascii_start();
    let starts =
        |start: &[u8]| text.get(..start.len()).is_some_and(|text| text.eq_ignore_ascii_case(start));
    CONTENTS.into_iter().find(|(start, _)| starts(start)).map(|(_, what)| what)
}

/// Refuses a text of two bytes for each letter.
///
/// # Errors
/// Where it is one: says so.
pub fn check_encoding(text: &[u8]) -> Result<()> {
    ensure!(!is_utf_16(text), "this is text in UTF-16: save it as UTF-8, and read that");
    Ok(())
}

/// Whether a text is one of two bytes for each letter, by its mark or its first letters: nothing that
/// a text begins with here has a zero byte.
fn is_utf_16(text: &[u8]) -> bool {
    matches!(
        text,
        [0xFF, 0xFE, ..]
            | [0xFE, 0xFF, ..]
            | [0, 1..=255, 0, 1..=255, ..]
            | [1..=255, 0, 1..=255, 0, ..]
    )
}

/// A text in UTF-8, whatever it was in.
pub fn in_utf_8(text: Vec<u8>) -> Vec<u8> {
    if !is_utf_16(&text) {
        return text;
    }
    let is_big = matches!(text[..], [0xFE, 0xFF, ..] | [0, 1..=255, ..]);
    let bytes_to = if is_big { u16::from_be_bytes } else { u16::from_le_bytes };
    let letters: Vec<u16> = text.chunks_exact(2).map(|pair| bytes_to([pair[0], pair[1]])).collect();
    String::from_utf16_lossy(&letters).trim_start_matches('\u{feff}').to_owned().into_bytes()
}

/// What to do with a model of a format that nothing here reads.
pub fn of_ending(path: &Path) -> Option<&'static str> {
    let ending = path.extension()?.to_str()?;
    ENDINGS.into_iter().find(|(known, _)| known.eq_ignore_ascii_case(ending)).map(|(_, what)| what)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn contents_are_known_by_their_start() {
        let pointer = b"version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 1\n";
        assert!(of_content(pointer).unwrap().contains("git lfs pull"));
        assert!(of_content(b"\n <!DOCTYPE HTML>").unwrap().starts_with("a web page"));
        assert!(of_content(b"").unwrap().contains("empty"));
        assert_eq!(of_content(b"v 0 0 0"), None);
        assert_eq!(of_content(b"glTF\x02"), None);
    }

    #[test]
    fn texts_of_two_bytes_a_letter_are_told_and_turned() {
        for text in ["newmtl a\nKd 1 0 0\n", "\u{feff}newmtl é\n"] {
            for bytes_of in [u16::to_le_bytes, u16::to_be_bytes] {
                let bytes: Vec<u8> = text.encode_utf16().flat_map(bytes_of).collect();
                assert!(check_encoding(&bytes).is_err());
                assert_eq!(in_utf_8(bytes), text.trim_start_matches('\u{feff}').as_bytes());
            }
            assert!(check_encoding(text.as_bytes()).is_ok());
            assert_eq!(in_utf_8(text.into()), text.as_bytes());
        }
    }

    #[test]
    fn endings_say_what_to_do() {
        assert!(of_ending(Path::new("a/b.BLEND")).unwrap().contains("export glTF"));
        assert_eq!(of_ending(Path::new("a.txt")), None);
    }
}
