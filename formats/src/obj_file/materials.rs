//! The files that an OBJ refers to: material libraries, and the textures in them.

use std::collections::BTreeSet;
use std::path::{Component, Path, PathBuf};

use anyhow::{Context, Result};

use super::parse::{Item, Obj};
use crate::document::OutputFile;
use crate::paths::{identity, read_beside};

/// Copies for the folder of the result, so that it has its materials there; none where that is
/// the folder of the input. Files that are missing, or not below that folder, are left out.
///
/// # Errors
/// Where a file is there but cannot be read.
pub fn companions(obj: &Obj, from: &Path, output: &Path) -> Result<Vec<OutputFile>> {
    let to = output.parent().unwrap_or(Path::new(""));
    if identity(&from.join("x")) == identity(&to.join("x")) {
        return Ok(Vec::new());
    }
    let mut names = BTreeSet::new();
    for item in &obj.items {
        if let Item::Line(line) = item
            && let Some(rest) = line.strip_prefix(b"mtllib")
        {
            names.extend(file_names(from, rest));
        }
    }
    for library in names.clone() {
        names.extend(textures(from, &library)?);
    }
    let copy = |name: &PathBuf| Ok(OutputFile { path: to.join(name), bytes: read(from, name)? });
    names.iter().map(copy).collect()
}

fn read(folder: &Path, name: &Path) -> Result<Vec<u8>> {
    read_beside(folder, name)
        .with_context(|| format!("cannot read {}", folder.join(name).display()))
}

/// The files that the lines of a material library name, as paths from the folder of the model.
fn textures(folder: &Path, library: &Path) -> Result<Vec<PathBuf>> {
    let text = read(folder, library)?;
    let beside = library.parent().unwrap_or(Path::new(""));
    let mut names = Vec::new();
    for line in text.split(|&byte| byte == b'\n') {
        // Only texture statements name files; other words that happen to be one do no harm.
        let line = line.trim_ascii();
        let end = line.iter().position(u8::is_ascii_whitespace).unwrap_or(line.len());
        let found = file_names(&folder.join(beside), &line[end..]);
        names.extend(found.into_iter().map(|name| beside.join(name)));
    }
    Ok(names)
}

/// The files in what follows a keyword: all of it one name with spaces, or its last words behind
/// options, or each word a name.
fn file_names(folder: &Path, rest: &[u8]) -> Vec<PathBuf> {
    let text = String::from_utf8_lossy(rest.trim_ascii());
    let starts =
        text.char_indices().filter(|&(at, _)| at == 0 || text[..at].ends_with([' ', '\t']));
    let exists = |name: &&str| is_below(name) && folder.join(name).is_file();
    let spaced = starts.map(|(at, _)| &text[at..]).filter(|tail| tail.contains([' ', '\t']));
    match spaced.into_iter().find(exists) {
        Some(name) => vec![name.into()],
        None => text.split_ascii_whitespace().filter(exists).map(PathBuf::from).collect(),
    }
}

fn is_below(name: &str) -> bool {
    Path::new(name)
        .components()
        .all(|part| matches!(part, Component::Normal(_) | Component::CurDir))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::obj_file::parse::parse;
    use std::fs;

    #[test]
    fn libraries_and_textures_are_copied_to_another_folder_only() {
        let root = tempfile::tempdir().unwrap();
        let from = root.path().join("in");
        fs::create_dir_all(from.join("maps")).unwrap();
        fs::write(from.join("my lib.mtl"), "newmtl a\nmap_Kd -s 1 1 1 maps/red wood.png\n")
            .unwrap();
        fs::write(from.join("maps/red wood.png"), "png").unwrap();
        fs::write(root.path().join("secret"), "").unwrap();
        let obj = parse(b"mtllib my lib.mtl\nmtllib gone.mtl\nmtllib ../secret\n").unwrap();

        let to = root.path().join("out");
        let copies = companions(&obj, &from, &to.join("a.obj")).unwrap();
        let paths: Vec<_> = copies.iter().map(|copy| copy.path.clone()).collect();
        assert_eq!(paths, [to.join("maps/red wood.png"), to.join("my lib.mtl")]);
        assert_eq!(copies[0].bytes, b"png");
        assert!(companions(&obj, &from, &from.join("b.obj")).unwrap().is_empty());
    }

    #[test]
    fn a_line_may_name_several_files() {
        let folder = tempfile::tempdir().unwrap();
        for name in ["a.mtl", "b.mtl"] {
            fs::write(folder.path().join(name), "").unwrap();
        }
        let names = file_names(folder.path(), b" a.mtl b.mtl c.mtl");
        assert_eq!(names, [PathBuf::from("a.mtl"), PathBuf::from("b.mtl")]);
    }
}
