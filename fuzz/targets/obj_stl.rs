//! The readers and writers of OBJ and STL, on bytes of any kind and on nearly right files.
#![no_main]

use std::fmt::Write;

use arbitrary::Arbitrary;
use chamfer_fuzz::documents::read_chamfer_write;
use libfuzzer_sys::fuzz_target;

#[derive(Arbitrary, Debug)]
enum Input {
    Obj(Vec<u8>),
    Stl(Vec<u8>),
    Statements(Vec<Statement>),
    Facets(Vec<[[i8; 3]; 3]>, Ending),
    Records(u32, Vec<[[f32; 3]; 4]>, Vec<u8>),
}

#[derive(Arbitrary, Debug)]
enum Statement {
    Vertex([i8; 3]),
    AnyVertex([f32; 3]),
    Colored([i8; 3], [u8; 3]),
    Texcoord([i8; 2]),
    Normal([i8; 3]),
    Face(Vec<i8>),
    Textured(Vec<[i8; 2]>),
    Shaded(Vec<[i8; 3]>),
    /// A polygon over so many vertices from one on, in order.
    Polygon(u8, u8),
    Line(Vec<i8>),
    Group(u8),
    Material(u8),
    Library,
    Raw(Vec<u8>),
}

#[derive(Arbitrary, Debug)]
enum Ending {
    Proper,
    Missing,
    Twice,
}

fuzz_target!(|input: Input| {
    match input {
        Input::Obj(bytes) => read_chamfer_write("obj", &bytes),
        Input::Stl(bytes) => read_chamfer_write("stl", &bytes),
        Input::Statements(statements) => read_chamfer_write("obj", &obj(&statements)),
        Input::Facets(facets, ending) => {
            read_chamfer_write("stl", ascii_stl(&facets, &ending).as_bytes());
        }
        Input::Records(count, records, rest) => {
            read_chamfer_write("stl", &binary_stl(count, &records, &rest));
        }
    }
});

fn obj(statements: &[Statement]) -> Vec<u8> {
    let mut text = Vec::new();
    for statement in statements {
        match statement {
            Statement::Raw(bytes) => text.extend(bytes),
            known => text.extend(line(known).into_bytes()),
        }
        text.push(b'\n');
    }
    text
}

fn line(statement: &Statement) -> String {
    let words = |keyword: &str, words: Vec<String>| format!("{keyword} {}", words.join(" "));
    let each =
        |keyword: &str, values: &[i8]| words(keyword, values.iter().map(i8::to_string).collect());
    let text = |value: &i8| if *value == 0 { String::new() } else { value.to_string() };
    match statement {
        Statement::Vertex(at) => each("v", at),
        Statement::AnyVertex([x, y, z]) => format!("v {x:e} {y} {z}"),
        Statement::Colored([x, y, z], color) => {
            let [r, g, b] = color.map(|part| f32::from(part) / 255.0);
            format!("v {x} {y} {z} {r} {g} {b}")
        }
        Statement::Texcoord(at) => each("vt", at),
        Statement::Normal(way) => each("vn", way),
        Statement::Face(corners) => each("f", corners),
        Statement::Textured(corners) => {
            words("f", corners.iter().map(|[v, t]| format!("{v}/{}", text(t))).collect())
        }
        Statement::Shaded(corners) => {
            let corner = |[v, t, n]: &[i8; 3]| format!("{v}/{}/{}", text(t), text(n));
            words("f", corners.iter().map(corner).collect())
        }
        Statement::Polygon(first, count) => {
            let places = (0..u32::from(*count)).map(|place| u32::from(*first) + place);
            words("f", places.map(|place| place.to_string()).collect())
        }
        Statement::Line(places) => each("l", places),
        Statement::Group(number) => format!("g part{}", number % 4),
        Statement::Material(number) => format!("usemtl m{}", number % 4),
        Statement::Library => "mtllib ../secret.mtl".into(),
        Statement::Raw(_) => String::new(),
    }
}

fn ascii_stl(facets: &[[[i8; 3]; 3]], ending: &Ending) -> String {
    let mut text = String::from("solid\n");
    for facet in facets {
        text.push_str("facet normal 0 0 0\nouter loop\n");
        for [x, y, z] in facet {
            // Writing to a string cannot fail.
            let _ = writeln!(text, "vertex {x} {y} {z}");
        }
        text.push_str("endloop\nendfacet\n");
    }
    text.push_str(match ending {
        Ending::Proper => "endsolid\n",
        Ending::Missing => "",
        Ending::Twice => "endsolid\nsolid\nendsolid\n",
    });
    text
}

/// The count is wrong where it is odd.
fn binary_stl(count: u32, records: &[[[f32; 3]; 4]], rest: &[u8]) -> Vec<u8> {
    let mut bytes = vec![b's'; 80];
    let count = if count.is_multiple_of(2) { records.len() as u32 } else { count };
    bytes.extend(count.to_le_bytes());
    for record in records {
        bytes.extend(record.as_flattened().iter().flat_map(|value| value.to_le_bytes()));
        bytes.extend([0, 0]);
    }
    bytes.extend(rest);
    bytes
}
