//! The files that an OBJ refers to: material libraries, and the textures in them.

use std::collections::BTreeSet;
use std::path::{Component, Path, PathBuf};

use anyhow::{Context, Result};

use super::parse::{Item, Obj, line_end};
use crate::document::OutputFile;
use crate::foreign::in_utf_8;
use crate::glb::Material;
use crate::paths::{identity, read_beside};
use crate::pictures::Picture;

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
    let mut names = libraries(obj, from);
    for library in names.clone() {
        names.extend(textures(from, &library)?);
    }
    let copy = |name: &PathBuf| Ok(OutputFile { path: to.join(name), bytes: read(from, name)? });
    names.iter().map(copy).collect()
}

/// The material libraries that a file names and that are there.
fn libraries(obj: &Obj, folder: &Path) -> BTreeSet<PathBuf> {
    let line = |item: &Item| match item {
        Item::Line(line) => line.strip_prefix(b"mtllib").map(<[u8]>::to_vec),
        _ => None,
    };
    let lines = obj.items.iter().filter_map(line);
    lines.flat_map(|rest| file_names(folder, &rest)).collect()
}

/// What the material libraries say of each material, and the names of the pictures among it that
/// glTF cannot have.
///
/// # Errors
/// Where a file is there but cannot be read.
pub fn known(obj: &Obj, folder: &Path) -> Result<(Vec<Material>, Vec<String>)> {
    let (mut materials, mut left_out): (Vec<Material>, Vec<String>) = Default::default();
    for library in libraries(obj, folder) {
        let beside = library.parent().unwrap_or(Path::new(""));
        let text = in_utf_8(read(folder, &library)?);
        for line in lines(&text) {
            let line = line.trim_ascii();
            let end = line.iter().position(u8::is_ascii_whitespace).unwrap_or(line.len());
            let (keyword, rest) = line.split_at(end);
            if keyword == b"newmtl" {
                materials.push(Material {
                    name: String::from_utf8_lossy(rest.trim_ascii()).into_owned(),
                    color: [1.0; 4],
                    roughness: 1.0,
                    texture: None,
                });
            } else if let Some(material) = materials.last_mut() {
                set(material, keyword, rest);
                if keyword == b"map_Kd" {
                    let names = file_names(&folder.join(beside), rest);
                    for name in names.into_iter().map(|name| beside.join(name)) {
                        let bytes = read(folder, &name)?;
                        let shown = name.display().to_string();
                        material.texture = Picture::new(shown.clone(), bytes);
                        left_out.extend(material.texture.is_none().then_some(shown));
                    }
                }
            }
        }
    }
    left_out.dedup();
    Ok((materials, left_out))
}

/// Takes over a statement of one to three numbers; others are none of a material's colour.
fn set(material: &mut Material, keyword: &[u8], rest: &[u8]) {
    let text = String::from_utf8_lossy(rest);
    let numbers: Vec<f32> =
        text.split_ascii_whitespace().map_while(|word| word.parse().ok()).collect();
    let share = |number: f32| if number.is_finite() { number.clamp(0.0, 1.0) } else { 1.0 };
    match (keyword, &numbers[..]) {
        (b"Kd", &[r, g, b, ..]) => material.color[..3].copy_from_slice(&[r, g, b].map(share)),
        (b"d", &[opacity, ..]) => material.color[3] = share(opacity),
        (b"Tr", &[transparency, ..]) => material.color[3] = 1.0 - share(transparency),
        // The exponent of a highlight, as wide as that of this roughness (Walter and others, 2007).
        (b"Ns", &[exponent, ..]) if exponent >= 0.0 => {
            material.roughness = share((2.0 / (exponent + 2.0)).sqrt().sqrt());
        }
        (b"Pr", &[roughness, ..]) => material.roughness = share(roughness),
        _ => {}
    }
}

fn read(folder: &Path, name: &Path) -> Result<Vec<u8>> {
    read_beside(folder, name)
        .with_context(|| format!("cannot read {}", folder.join(name).display()))
}

fn lines(text: &[u8]) -> impl Iterator<Item = &[u8]> {
    let end = line_end(text);
    text.split(move |&byte| byte == end)
}

/// The files that the lines of a material library name, as paths from the folder of the model.
fn textures(folder: &Path, library: &Path) -> Result<Vec<PathBuf>> {
    let text = in_utf_8(read(folder, library)?);
    let beside = library.parent().unwrap_or(Path::new(""));
    let mut names = Vec::new();
    for line in lines(&text) {
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
    fn colours_and_pictures_are_known() {
        let folder = tempfile::tempdir().unwrap();
        let library = "Kd 9 9 9\nnewmtl red\nKd 1 0 0.5\nd 0.25\nNs 0\nmap_Kd -s 1 1 1 red.png\n\
                       newmtl wood\nmap_Kd wood.tga\nTr 1\nKd x\n";
        fs::write(folder.path().join("a.mtl"), library).unwrap();
        fs::write(folder.path().join("red.png"), b"\x89PNG\r\n\x1A\n..").unwrap();
        fs::write(folder.path().join("wood.tga"), [0; 9]).unwrap();
        let obj = parse(b"mtllib a.mtl\n").unwrap();
        let (materials, left_out) = known(&obj, folder.path()).unwrap();
        let [red, wood] = &materials[..] else { panic!("{materials:?}") };
        assert_eq!((red.name.as_str(), red.color), ("red", [1.0, 0.0, 0.5, 0.25]));
        assert_eq!(red.texture.as_ref().map(|picture| picture.kind), Some("image/png"));
        assert_eq!((wood.color, &wood.texture), ([1.0, 1.0, 1.0, 0.0], &None));
        assert_eq!(left_out, ["wood.tga"]);
        fs::write(folder.path().join("a.mtl"), library.replace('\n', "\r")).unwrap();
        let of_old = known(&obj, folder.path()).unwrap();
        assert_eq!((of_old.0.len(), of_old.0[0].color, of_old.1), (2, red.color, left_out));
    }

    #[test]
    fn a_library_may_be_in_utf_16() {
        let folder = tempfile::tempdir().unwrap();
        let library = "\u{feff}newmtl red\r\nKd 1 0 0\r\nmap_Kd wood.png\r\n";
        let bytes: Vec<u8> = library.encode_utf16().flat_map(u16::to_le_bytes).collect();
        fs::write(folder.path().join("a.mtl"), bytes).unwrap();
        fs::write(folder.path().join("wood.png"), "").unwrap();
        let obj = parse(b"mtllib a.mtl\n").unwrap();
        let (materials, _) = known(&obj, folder.path()).unwrap();
        assert_eq!(materials.len(), 1);
        assert_eq!((&*materials[0].name, materials[0].color), ("red", [1.0, 0.0, 0.0, 1.0]));
        let found = textures(folder.path(), Path::new("a.mtl")).unwrap();
        assert_eq!(found, [PathBuf::from("wood.png")]);
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
