//! The statements of an OBJ file, in their order.

use std::borrow::Cow;
use std::collections::BTreeSet;

use anyhow::{Context, Result, anyhow, bail};

use crate::foreign::check_encoding;

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
    /// `#polygons`: the smoothing group of each; 0 for none.
    pub smoothing_groups: Vec<u32>,
    /// Keywords of the statements that are not kept.
    pub dropped: BTreeSet<String>,
    /// What was read otherwise than it stands there.
    pub slips: Slips,
}

/// Broken rules that do not matter, each with how often and the line where it was first.
#[derive(Debug, Default)]
pub struct Slips {
    /// Whether a byte-order mark stood in front of the first statement.
    pub byte_order_mark: bool,
    /// Faces of fewer than three corners.
    pub thin_faces: Slip,
    /// Corners whose texture coordinates the file does not have.
    pub texcoords: Slip,
    /// Corners whose normals the file does not have.
    pub normals: Slip,
}

/// How often something is so, and in which line first.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Slip {
    count: usize,
    line: usize,
}

impl Slip {
    fn add(&mut self, line: usize) {
        self.count += 1;
        self.line = if self.count == 1 { line } else { self.line.min(line) };
    }

    fn note(self, what: &str, becomes: &str) -> Option<String> {
        let Slip { count, line } = self;
        (count > 0).then(|| format!("{count} {what}, first in line {line}: {becomes}"))
    }
}

impl Slips {
    /// A sentence each.
    pub fn notes(&self) -> Vec<String> {
        let mark = "the byte-order mark in front was left out";
        [
            self.byte_order_mark.then(|| mark.to_owned()),
            self.thin_faces.note("faces of fewer than three corners", "left out"),
            self.texcoords.note("corners name a vt that is not there", "read without"),
            self.normals.note("corners name a vn that is not there", "normals were made for them"),
        ]
        .into_iter()
        .flatten()
        .collect()
    }
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
    check_encoding(bytes)?;
    let text = bytes.strip_prefix(BYTE_ORDER_MARK).unwrap_or(bytes);
    parser.obj.slips.byte_order_mark = text.len() < bytes.len();
    for (number, line) in Lines::new(text) {
        parser.statement(&line, number).with_context(|| format!("line {number}"))?;
    }
    if parser.statements == 0 && !text.trim_ascii().is_empty() && !parser.commented() {
        bail!("no OBJ statement in this file");
    }
    parser.check_indices()?;
    Ok(parser.obj)
}

/// That of UTF-8, which some editors write in front of a text.
const BYTE_ORDER_MARK: &[u8] = b"\xEF\xBB\xBF";

/// What ends the lines of a text: as of old a carriage return, where there is no line feed at all.
pub fn line_end(text: &[u8]) -> u8 {
    if text.contains(&b'\n') { b'\n' } else { b'\r' }
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
    end: u8,
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
    fn new(text: &'a [u8]) -> Lines<'a> {
        Lines { rest: text, end: line_end(text), number: 0 }
    }

    fn physical(&mut self) -> Option<&'a [u8]> {
        if self.rest.is_empty() {
            return None;
        }
        let end = self.rest.iter().position(|&byte| byte == self.end);
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
    /// The smoothing group of the faces that follow.
    smoothing_group: u32,
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
            b"s" => self.smoothing_group = smoothing_group(rest),
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
            self.obj.corners.truncate(before);
            self.obj.slips.thin_faces.add(number);
            return Ok(());
        }
        self.obj.smoothing_groups.push(self.smoothing_group);
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
        let position = position.map(|given| inside(given, self.obj.positions.len())).transpose()?;
        // One that reaches back too far is told from the others that are not there at the end.
        let known = |given: Option<i64>| given.map(|at| u32::try_from(at).unwrap_or(u32::MAX));
        let texcoord = known(part(self.obj.texcoords.len())?);
        let normal = known(part(self.obj.normals.len())?);
        let position = position.context("a corner without a vertex number")?;
        Ok(Corner { position, texcoord, normal })
    }

    /// At the end only, because some programs write faces above the vertices that they use.
    fn check_indices(&mut self) -> Result<()> {
        let obj = &mut self.obj;
        let counts = [obj.texcoords.len(), obj.normals.len()];
        let mut start = 0;
        for (&end, &line) in obj.polygon_ends.iter().zip(&self.polygon_lines) {
            for corner in &mut obj.corners[start..end] {
                check(line, corner.position, obj.positions.len())?;
                drop_unknown(&mut corner.texcoord, counts[0], line, &mut obj.slips.texcoords);
                drop_unknown(&mut corner.normal, counts[1], line, &mut obj.slips.normals);
            }
            start = end;
        }
        let elements = obj.items.iter().filter_map(|item| match item {
            Item::Element(_, positions) => Some(positions),
            _ => None,
        });
        for (positions, line) in elements.zip(&self.element_lines) {
            for &position in positions {
                check(*line, position, obj.positions.len())?;
            }
        }
        Ok(())
    }
}

fn check(line: usize, position: u32, count: usize) -> Result<()> {
    if position as usize >= count {
        bail!("line {line}: vertex {} of {count} that the file has", u64::from(position) + 1);
    }
    Ok(())
}

/// What geometry can do without need not be there.
fn drop_unknown(index: &mut Option<u32>, count: usize, line: usize, slip: &mut Slip) {
    if index.is_some_and(|index| index as usize >= count) {
        *index = None;
        slip.add(line);
    }
}

/// `off` and all that is no number stand for none.
fn smoothing_group(rest: &[u8]) -> u32 {
    let word = words(rest).next().map(String::from_utf8_lossy);
    word.and_then(|word| word.parse().ok()).unwrap_or(0)
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

/// A zero-based number from one that counts from 1, or backwards from the last of `count`: then it
/// is negative where it reaches back too far.
fn index(text: &[u8], count: usize) -> Result<i64> {
    let text = String::from_utf8_lossy(text);
    let given: i64 = text.parse().with_context(|| format!("\"{text}\" is not an index"))?;
    match given {
        1.. => Ok(given - 1),
        0 => bail!("index 0: OBJ counts from 1"),
        _ => Ok((count as i64).saturating_add(given)),
    }
}

fn inside(zero_based: i64, count: usize) -> Result<u32> {
    u32::try_from(zero_based).map_err(|_| {
        let given = if zero_based < 0 { zero_based - count as i64 } else { zero_based + 1 };
        anyhow!("index {given} is out of range: {count} are defined above it")
    })
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
        let of_old = format!("# made of old\r{CORNERS}f 1 2 \\\n3\nf 3 2 1\n").replace('\n', "\r");
        let obj = parse(of_old.as_bytes()).unwrap();
        assert_eq!([obj.positions.len(), obj.corners.len(), obj.comments.len()], [3, 6, 1]);
        assert!(error("v 0 0 0\rv 0 0 x\r").starts_with("line 2: \"x\""));
    }

    #[test]
    fn a_text_in_utf_16_says_so() {
        let text = format!("{CORNERS}f 1 2 3");
        for marked in [text.clone(), format!("\u{feff}{text}")] {
            for bytes_of in [u16::to_le_bytes, u16::to_be_bytes] {
                let bytes: Vec<u8> = marked.encode_utf16().flat_map(bytes_of).collect();
                let told = parse(&bytes).unwrap_err().to_string();
                assert_eq!(told, "this is text in UTF-16: save it as UTF-8, and read that");
            }
        }
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
        assert!(error(&format!("{CORNERS}f 0 1 2")).contains("index 0"));
        assert!(error(&format!("{CORNERS}f -4 1 2")).contains("index -4 is out of range"));
        assert_eq!(error(&format!("{CORNERS}f 1 2 4")), "line 6: vertex 4 of 3 that the file has");
        assert!(error(&format!("{CORNERS}f 1 2 99999999999")).contains("out of range"));
        assert!(error("solid x\nfacet").contains("no OBJ statement"));
        assert!(error("l 1 2").contains("line 1: vertex 1 of 0"));
    }

    #[test]
    fn a_byte_order_mark_swallows_no_vertex() {
        let obj = parse(format!("\u{feff}{CORNERS}f 1 2 3").as_bytes()).unwrap();
        assert_eq!(obj.positions.len(), 3);
        assert_eq!(obj.slips.notes(), ["the byte-order mark in front was left out"]);
    }

    #[test]
    fn corners_without_what_they_name_lack_it() {
        let text = format!("{CORNERS}f 1/1/1 2/2/1 3/-9/7\nf 1/9/1 2/1/1 3//1\n");
        let obj = parse(text.as_bytes()).unwrap();
        let texcoords: Vec<_> = obj.corners.iter().map(|corner| corner.texcoord).collect();
        assert_eq!(texcoords, [Some(0), None, None, None, Some(0), None]);
        assert_eq!(obj.corners[2].normal, None);
        assert_eq!(
            obj.slips.notes(),
            [
                "3 corners name a vt that is not there, first in line 6: read without",
                "1 corners name a vn that is not there, first in line 6: normals were made for them",
            ]
        );
    }

    #[test]
    fn faces_of_fewer_than_three_corners_are_left_out() {
        let obj = parse(format!("{CORNERS}f 1 2\nf\nf 1 2 3\nf 3\n").as_bytes()).unwrap();
        assert_eq!(obj.polygon_ends, [3]);
        let note = "3 faces of fewer than three corners, first in line 6: left out";
        assert_eq!(obj.slips.notes(), [note]);
    }

    #[test]
    fn faces_remember_their_smoothing_group() {
        let face = "f 1 2 3\n";
        let text = format!("{CORNERS}{face}s 1\n{face}{face}s off\n{face}s 7\n{face}s 0\n{face}");
        assert_eq!(parse(text.as_bytes()).unwrap().smoothing_groups, [0, 1, 1, 0, 7, 0]);
    }

    #[test]
    fn an_empty_file_is_an_empty_model() {
        assert!(parse(b"").unwrap().items.is_empty());
        assert!(parse(b"# nothing\n").unwrap().items.is_empty());
    }
}
