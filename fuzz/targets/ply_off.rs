//! The readers of PLY and OFF, on bytes of any kind and on nearly right files.
#![no_main]

use std::fmt::Write;

use arbitrary::Arbitrary;
use chamfer_fuzz::documents::read_chamfer_write;
use libfuzzer_sys::fuzz_target;

#[derive(Arbitrary, Debug)]
enum Input {
    Ply(Vec<u8>),
    Off(Vec<u8>),
    PlyText(Solid, Vec<Extra>),
    PlyBinary(Solid, Vec<Extra>, bool),
    OffText(Solid, Head),
}

/// Points and faces over them, and how many of each the header tells of.
#[derive(Arbitrary, Debug)]
struct Solid {
    points: Vec<[i8; 3]>,
    faces: Vec<Vec<u8>>,
    off_by: (i8, i8),
    rest: Vec<u8>,
}

/// What a vertex of a PLY has besides.
#[derive(Arbitrary, Clone, Copy, Debug)]
enum Extra {
    Normals,
    Colors,
    Uvs,
    Unknown,
}

#[derive(Arbitrary, Clone, Copy, Debug)]
enum Head {
    Plain,
    Normals,
    Colors,
    Uvs,
    None,
}

fuzz_target!(|input: Input| match input {
    Input::Ply(bytes) => read_chamfer_write("ply", &bytes),
    Input::Off(bytes) => read_chamfer_write("off", &bytes),
    Input::PlyText(solid, extras) => read_chamfer_write("ply", &ply_text(&solid, &extras)),
    Input::PlyBinary(solid, extras, is_little) => {
        read_chamfer_write("ply", &ply_binary(&solid, &extras, is_little));
    }
    Input::OffText(solid, head) => read_chamfer_write("off", &off_text(&solid, head)),
});

impl Solid {
    /// What the header tells.
    fn counts(&self) -> [i64; 2] {
        let off = |count: usize, by: i8| count as i64 + i64::from(by / 64);
        [off(self.points.len(), self.off_by.0), off(self.faces.len(), self.off_by.1)]
    }

    /// Mostly of points that are there.
    fn face(&self, face: &[u8]) -> Vec<usize> {
        let count = self.points.len().max(1) + usize::from(self.off_by.0 == 7);
        face.iter().map(|&place| usize::from(place) % count).collect()
    }
}

fn header(solid: &Solid, extras: &[Extra], format: &str) -> String {
    let [vertices, faces] = solid.counts();
    let mut text = format!("ply\nformat {format} 1.0\nelement vertex {vertices}\n");
    let floats = |names: &[&str]| -> String {
        names.iter().map(|name| format!("property float {name}\n")).collect()
    };
    text += &floats(&["x", "y", "z"]);
    for extra in extras {
        text += &match extra {
            Extra::Normals => floats(&["nx", "ny", "nz"]),
            Extra::Colors => floats(&["red", "green", "blue"]),
            Extra::Uvs => floats(&["s", "t"]),
            Extra::Unknown => floats(&["quality"]),
        };
    }
    text + &format!("element face {faces}\nproperty list uchar int vertex_indices\nend_header\n")
}

fn values<'a>(point: &'a [i8; 3], extras: &'a [Extra]) -> impl Iterator<Item = f32> + 'a {
    let more = extras.iter().flat_map(|extra| match extra {
        Extra::Normals | Extra::Colors => vec![0.0, 1.0, 0.0],
        Extra::Uvs => vec![0.5, 0.25],
        Extra::Unknown => vec![7.0],
    });
    point.iter().map(|&along| f32::from(along)).chain(more)
}

fn ply_text(solid: &Solid, extras: &[Extra]) -> Vec<u8> {
    let mut text = header(solid, extras, "ascii");
    for point in &solid.points {
        values(point, extras).for_each(|value| _ = write!(text, "{value} "));
        text.push('\n');
    }
    for face in &solid.faces {
        write_face(&mut text, &solid.face(face));
    }
    [text.as_bytes(), &solid.rest].concat()
}

fn write_face(text: &mut String, face: &[usize]) {
    _ = write!(text, "{}", face.len());
    face.iter().for_each(|place| _ = write!(text, " {place}"));
    text.push('\n');
}

fn ply_binary(solid: &Solid, extras: &[Extra], is_little: bool) -> Vec<u8> {
    let name = if is_little { "binary_little_endian" } else { "binary_big_endian" };
    let mut bytes = header(solid, extras, name).into_bytes();
    let word = |bits: u32| if is_little { bits.to_le_bytes() } else { bits.to_be_bytes() };
    for point in &solid.points {
        values(point, extras).for_each(|value| bytes.extend(word(value.to_bits())));
    }
    for face in &solid.faces {
        let face = &solid.face(face)[..face.len().min(255)];
        bytes.push(face.len() as u8);
        face.iter().for_each(|&place| bytes.extend(word(place as u32)));
    }
    bytes.extend(&solid.rest);
    bytes
}

fn off_text(solid: &Solid, head: Head) -> Vec<u8> {
    let (name, more) = match head {
        Head::Plain => ("OFF\n", ""),
        Head::Normals => ("NOFF\n", " 0 1 0"),
        Head::Colors => ("COFF\n", " 0.5 0.25 1 1"),
        Head::Uvs => ("STOFF\n", " 0.5 0.25"),
        Head::None => ("", ""),
    };
    let [vertices, faces] = solid.counts();
    let mut text = format!("{name}{vertices} {faces} 0\n");
    for [x, y, z] in &solid.points {
        _ = writeln!(text, "{x} {y} {z}{more}");
    }
    for face in &solid.faces {
        write_face(&mut text, &solid.face(face));
    }
    [text.as_bytes(), &solid.rest].concat()
}
