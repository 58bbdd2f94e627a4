//! The statements of an OBJ file, in their order.

use std::borrow::Cow;
use std::collections::BTreeSet;

use anyhow::{Context, Result, bail};

/// What stands in an OBJ file.
#[derive(Debug, Default)]
pub struct Obj {
    /// Comment lines above the first statement: they say who made the file.
    pub comments: Vec<Vec<u8>>,
    /// `v`.
    pub positions: Vec<[f32; 3]>,
    /// `#positions`: what follows the coordinates; opaque white where nothing does.
    pub colors: Vec<[f32; 4]>,
    /// How many components of the colours the file gives: 0, 3 or 4.
    pub color_components: usize,
    /// `vt`, with 0 for what is not given.
    pub texcoords: Vec<[f32; 3]>,
    /// How many components of the texture coordinates the file gives: 0, 2 or 3.
    pub texcoord_components: u32,
    /// `vn`.
    pub normals: Vec<[f32; 3]>,
    /// The corners of all polygons, one after the other.
    pub corners: Vec<Corner>,
    /// `#polygons`: where the corners of each end.
    pub polygon_ends: Vec<usize>,
    /// All else, in the order of the file.
    pub items: Vec<Item>,
    /// Keywords of the statements that are not kept.
    pub dropped: BTreeSet<String>,
}

/// A corner of a polygon, by zero-based numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Corner {
    /// Of the position.
    pub position: u32,
    /// Of the texture coordinates.
    pub texcoord: Option<u32>,
    /// Of the normal.
    pub normal: Option<u32>,
}

/// A part of the file between vertex data.
#[derive(Debug, PartialEq)]
pub enum Item {
    /// `o`, `g`, `usemtl` or `mtllib`, word for word.
    Line(Vec<u8>),
    /// A run of faces up to this polygon: one submesh.
    Faces(usize),
    /// `l` or `p`, over these positions.
    Element(u8, Vec<u32>),
}

/// Reads the statements.
///
/// # Errors
/// Names the first line that makes no sense.
pub fn parse(bytes: &[u8]) -> Result<Obj> {
    let mut parser = Parser::default();
    for (number, line) in (Lines { rest: bytes, number: 0 }) {
        parser.statement(&line, number).with_context(|| format!("line {number}"))?;
    }
    if parser.statements == 0 && !bytes.trim_ascii().is_empty() && !parser.commented() {
        bail!("no OBJ statement in this file");
    }
    parser.check_indices()?;
    Ok(parser.obj)
}

impl Obj {
    /// `#submeshes`: the material that each run of faces uses.
    pub fn materials_of_runs(&self) -> Vec<Option<String>> {
        let mut material = None;
        let mut materials = Vec::new();
        for item in &self.items {
            match item {
                Item::Line(line) => {
                    if let Some(name) = line.strip_prefix(b"usemtl") {
                        let name = String::from_utf8_lossy(name.trim_ascii()).into_owned();
                        material = (!name.is_empty()).then_some(name);
                    }
                }
                Item::Faces(_) => materials.push(material.clone()),
                Item::Element(..) => {}
            }
        }
        materials
    }
}

/// Lines without their ends; one that ends in a backslash goes on in the next.
struct Lines<'a> {
    rest: &'a [u8],
    number: usize,
}

impl<'a> Iterator for Lines<'a> {
    type Item = (usize, Cow<'a, [u8]>);

    fn next(&mut self) -> Option<Self::Item> {
        let first = self.physical()?;
        let number = self.number;
        let Some(begun) = first.strip_suffix(b"\\") else {
            return Some((number, first.into()));
        };
        let mut joined = begun.to_vec();
        while let Some(line) = self.physical() {
            joined.push(b' ');
            let Some(more) = line.strip_suffix(b"\\") else {
                joined.extend(line);
                break;
            };
            joined.extend(more);
        }
        Some((number, joined.into()))
    }
}

impl<'a> Lines<'a> {
    fn physical(&mut self) -> Option<&'a [u8]> {
        if self.rest.is_empty() {
            return None;
        }
        let end = self.rest.iter().position(|&byte| byte == b'\n');
        let line = &self.rest[..end.unwrap_or(self.rest.len())];
        self.rest = end.map_or(&[], |end| &self.rest[end + 1..]);
        self.number += 1;
        Some(line.trim_ascii())
    }
}

#[derive(Default)]
struct Parser {
    obj: Obj,
    statements: usize,
    /// `#polygons`: the line of each, and `#elements` likewise, for errors found at the end.
    polygon_lines: Vec<usize>,
    element_lines: Vec<usize>,
}

impl Parser {
    fn commented(&self) -> bool {
        !self.obj.comments.is_empty() && self.obj.dropped.is_empty()
    }

    fn statement(&mut self, line: &[u8], number: usize) -> Result<()> {
        if line.first() == Some(&b'#') {
            if self.statements == 0 {
                self.obj.comments.push(line.to_vec());
            }
            return Ok(());
        }
        let end = line.iter().position(u8::is_ascii_whitespace).unwrap_or(line.len());
        let (keyword, rest) = line.split_at(end);
        let known = self.statements;
        self.statements += 1;
        match keyword {
            b"" => self.statements = known,
            b"v" => self.position(rest)?,
            b"vt" => self.texcoord(rest)?,
            b"vn" => self.normal(rest)?,
            b"f" | b"fo" => self.polygon(rest, number)?,
            b"l" | b"p" => self.element(keyword[0], rest, number)?,
            b"o" | b"g" | b"usemtl" | b"mtllib" => self.obj.items.push(Item::Line(line.to_vec())),
            // Smoothing groups say nothing beside normals, and every corner gets one.
            b"s" => {}
            _ => {
                self.statements = known;
                self.obj.dropped.insert(String::from_utf8_lossy(keyword).into_owned());
            }
        }
        Ok(())
    }

    fn position(&mut self, rest: &[u8]) -> Result<()> {
        let (values, count) = numbers::<7>(rest)?;
        if count < 3 {
            bail!("a vertex needs three coordinates");
        }
        let [x, y, z, ref color @ ..] = values;
        // A fourth number alone is the weight of a curve's control point.
        let components = if count < 6 { 0 } else { count - 3 };
        let mut rgba = [1.0; 4];
        rgba[..components].copy_from_slice(&color[..components]);
        self.obj.positions.push([x, y, z]);
        self.obj.colors.push(rgba);
        self.obj.color_components = self.obj.color_components.max(components);
        Ok(())
    }

    fn texcoord(&mut self, rest: &[u8]) -> Result<()> {
        let (values, count) = numbers::<3>(rest)?;
        if count == 0 {
            bail!("texture coordinates need a number");
        }
        self.obj.texcoords.push(values);
        self.obj.texcoord_components = self.obj.texcoord_components.max(count.max(2) as u32);
        Ok(())
    }

    fn normal(&mut self, rest: &[u8]) -> Result<()> {
        let (values, count) = numbers::<3>(rest)?;
        if count < 3 {
            bail!("a normal needs three numbers");
        }
        self.obj.normals.push(values);
        Ok(())
    }

    fn polygon(&mut self, rest: &[u8], number: usize) -> Result<()> {
        let before = self.obj.corners.len();
        for word in words(rest) {
            let corner = self.corner(word)?;
            self.obj.corners.push(corner);
        }
        if self.obj.corners.len() - before < 3 {
            bail!("a face needs at least three corners");
        }
        self.obj.polygon_ends.push(self.obj.corners.len());
        self.polygon_lines.push(number);
        let polygons = self.obj.polygon_ends.len();
        match self.obj.items.last_mut() {
            Some(Item::Faces(end)) => *end = polygons,
            _ => self.obj.items.push(Item::Faces(polygons)),
        }
        Ok(())
    }

    fn element(&mut self, keyword: u8, rest: &[u8], number: usize) -> Result<()> {
        let corners = words(rest).map(|word| self.corner(word));
        let positions = corners.map(|corner| Ok(corner?.position)).collect::<Result<_>>()?;
        self.obj.items.push(Item::Element(keyword, positions));
        self.element_lines.push(number);
        Ok(())
    }

    fn corner(&self, word: &[u8]) -> Result<Corner> {
        let mut parts = word.split(|&byte| byte == b'/');
        let mut part = |count: usize| match parts.next() {
            None | Some(b"") => Ok(None),
            Some(text) => index(text, count).map(Some),
        };
        let position = part(self.obj.positions.len())?;
        let texcoord = part(self.obj.texcoords.len())?;
        let normal = part(self.obj.normals.len())?;
        let position = position.context("a corner without a vertex number")?;
        Ok(Corner { position, texcoord, normal })
    }

    /// At the end only, because some programs write faces above the vertices that they use.
    fn check_indices(&self) -> Result<()> {
        let obj = &self.obj;
        let mut start = 0;
        for (&end, line) in obj.polygon_ends.iter().zip(&self.polygon_lines) {
            for corner in &obj.corners[start..end] {
                check(*line, "vertex", Some(corner.position), obj.positions.len())?;
                check(*line, "vt", corner.texcoord, obj.texcoords.len())?;
                check(*line, "vn", corner.normal, obj.normals.len())?;
            }
            start = end;
        }
        let elements = obj.items.iter().filter_map(|item| match item {
            Item::Element(_, positions) => Some(positions),
            _ => None,
        });
        for (positions, line) in elements.zip(&self.element_lines) {
            for &position in positions {
                check(*line, "vertex", Some(position), obj.positions.len())?;
            }
        }
        Ok(())
    }
}

fn check(line: usize, what: &str, index: Option<u32>, count: usize) -> Result<()> {
    match index {
        Some(index) if index as usize >= count => {
            bail!("line {line}: {what} {} of {count} that the file has", u64::from(index) + 1)
        }
        _ => Ok(()),
    }
}

/// The words of a line, up to a comment.
fn words(rest: &[u8]) -> impl Iterator<Item = &[u8]> {
    let words = rest.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty());
    words.take_while(|word| word[0] != b'#')
}

/// Up to `N` numbers, 0 for those that are missing, and how many there are. More are ignored.
fn numbers<const N: usize>(rest: &[u8]) -> Result<([f32; N], usize)> {
    let mut values = [0.0f32; N];
    let mut count = 0;
    for (value, word) in values.iter_mut().zip(words(rest)) {
        let text = String::from_utf8_lossy(word);
        *value = text.parse().with_context(|| format!("\"{text}\" is not a number"))?;
        if !value.is_finite() {
            bail!("\"{text}\" is too large or not a number: repair the model");
        }
        count += 1;
    }
    Ok((values, count))
}

/// A zero-based number from one that counts from 1, or backwards from the last of `count`.
fn index(text: &[u8], count: usize) -> Result<u32> {
    let text = String::from_utf8_lossy(text);
    let given: i64 = text.parse().with_context(|| format!("\"{text}\" is not an index"))?;
    let zero_based = match given {
        1.. => given - 1,
        0 => bail!("index 0: OBJ counts from 1"),
        _ => count as i64 + given,
    };
    match u32::try_from(zero_based) {
        Ok(index) => Ok(index),
        Err(_) => bail!("index {given} is out of range: {count} are defined above it"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn corner(position: u32, texcoord: Option<u32>, normal: Option<u32>) -> Corner {
        Corner { position, texcoord, normal }
    }

    fn error(text: &str) -> String {
        format!("{:#}", parse(text.as_bytes()).unwrap_err())
    }

    const CORNERS: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\n";

    #[test]
    fn corners_may_lack_texture_and_normal() {
        let obj = parse(format!("{CORNERS}f 1 2/1 3//1\nf 1/1/1 2/ 3//").as_bytes()).unwrap();
        assert_eq!(
            obj.corners,
            [
                corner(0, None, None),
                corner(1, Some(0), None),
                corner(2, None, Some(0)),
                corner(0, Some(0), Some(0)),
                corner(1, None, None),
                corner(2, None, None),
            ]
        );
        assert_eq!(obj.polygon_ends, [3, 6]);
    }

    #[test]
    fn negative_indices_count_back_from_the_line() {
        let obj = parse(format!("{CORNERS}f -3 -2 -1\nv 5 5 5\nf -1 -2 -3").as_bytes()).unwrap();
        let positions: Vec<u32> = obj.corners.iter().map(|c| c.position).collect();
        assert_eq!(positions, [0, 1, 2, 3, 2, 1]);
    }

    #[test]
    fn lines_go_on_after_a_backslash_and_may_end_in_any_way() {
        let text = "v 0 0 \\\r\n 0\r\nv 1 0 0 # corner\r\nv 0 1 0\nf 1 2 \\\n\\\n3";
        let obj = parse(text.as_bytes()).unwrap();
        assert_eq!(obj.positions.len(), 3);
        assert_eq!(obj.corners.len(), 3);
    }

    #[test]
    fn runs_of_faces_break_at_objects_groups_and_materials_only() {
        let text = format!("o a\n{CORNERS}f 1 2 3\ns 1\n# x\nf 1 2 3\nusemtl m #1\nf 1 2 3\n");
        let obj = parse(text.as_bytes()).unwrap();
        assert_eq!(
            obj.items,
            [
                Item::Line(b"o a".to_vec()),
                Item::Faces(2),
                Item::Line(b"usemtl m #1".to_vec()),
                Item::Faces(3),
            ]
        );
        assert_eq!(obj.materials_of_runs(), [None, Some("m #1".into())]);
    }

    #[test]
    fn colours_follow_the_coordinates() {
        let obj = parse(b"v 0 0 0 1\nv 1 2 3 0.25 0.5 0.75\n").unwrap();
        assert_eq!(obj.positions, [[0.0, 0.0, 0.0], [1.0, 2.0, 3.0]]);
        assert_eq!(obj.colors, [[1.0; 4], [0.25, 0.5, 0.75, 1.0]]);
        assert_eq!(obj.color_components, 3);
    }

    #[test]
    fn comments_above_the_first_statement_are_kept() {
        let obj = parse(b"# by me\n\n#free\nv 0 0 0\n# later\n").unwrap();
        assert_eq!(obj.comments, [b"# by me".to_vec(), b"#free".to_vec()]);
    }

    #[test]
    fn unknown_statements_are_remembered() {
        let obj = parse(b"v 0 0 0\ncstype bezier\nparm u 0 1\n").unwrap();
        assert!(obj.dropped.contains("cstype") && obj.dropped.contains("parm"));
    }

    #[test]
    fn nonsense_is_named_by_its_line() {
        assert_eq!(error("v 0 0\n"), "line 1: a vertex needs three coordinates");
        assert!(error("v 0 0 x").starts_with("line 1: \"x\" is not a number"));
        assert!(error("\nv 0 0 nan").starts_with("line 2: \"nan\" is too large"));
        assert!(error("v 0 0 1e39").contains("too large"));
        assert_eq!(
            error(&format!("{CORNERS}f 1 2")),
            "line 6: a face needs at least three corners"
        );
        assert!(error(&format!("{CORNERS}f 0 1 2")).contains("index 0"));
        assert!(error(&format!("{CORNERS}f -4 1 2")).contains("index -4 is out of range"));
        assert_eq!(error(&format!("{CORNERS}f 1 2 4")), "line 6: vertex 4 of 3 that the file has");
        assert!(error(&format!("{CORNERS}f 1 2 3/9")).contains("vt 9 of 1"));
        assert!(error(&format!("{CORNERS}f 1 2 99999999999")).contains("out of range"));
        assert!(error("solid x\nfacet").contains("no OBJ statement"));
        assert!(error("l 1 2").contains("line 1: vertex 1 of 0"));
    }

    #[test]
    fn an_empty_file_is_an_empty_model() {
        assert!(parse(b"").unwrap().items.is_empty());
        assert!(parse(b"# nothing\n").unwrap().items.is_empty());
    }
}
