//! OFF: one mesh of polygons over numbered places, with what its vertices have.
//!
//! Read here and not by a crate: those that there are know triangles alone, or refuse the headers,
//! comments and colours that files have. Written as .glb.

use std::path::Path;

use anyhow::{Context, Result, bail, ensure};
use chamfer::{Chamfered, MeshBuffers, UvBuffer, split_by_angle};

use crate::document::{
    Document, Encoded, Format, NormalsRead, OutputFile, ReadOptions, SourceMesh,
};
use crate::foreign::check_encoding;
use crate::polygon::triangulate;
use crate::{glb, weld};

/// An OFF file: one mesh of one submesh.
pub struct OffDocument {
    mesh: SourceMesh,
    normals: NormalsRead,
    welded: usize,
    /// What does not go along.
    left_out: Vec<String>,
}

/// Reads the bytes of an OFF in text. Polygons are cut into triangles, and vertices split where
/// faces meet at more than the smoothing angle: few files have normals, and none of them hard edges,
/// as each vertex has one.
///
/// # Errors
/// Where it is binary or cut off, a face names a vertex that is not there, or a position is not
/// finite.
pub fn decode(path: &Path, bytes: &[u8], options: &ReadOptions) -> Result<OffDocument> {
    check_encoding(bytes)?;
    let text = std::str::from_utf8(bytes).ok().context("not text: binary OFF is not read")?;
    let mut lines = Lines::new(text);
    let kind = Kind::read(&mut lines)?;
    ensure!(!kind.has_dimension, "its places have other than three coordinates");
    let counts = lines.next("the counts of vertices and faces")?;
    let count = |k: usize| number::<usize>(&counts, k);
    let (vertices, faces) = (count(0)?, count(1)?);
    let mut mesh = MeshBuffers::default();
    for _ in 0..vertices {
        let line = lines.next("vertices")?;
        add_vertex(&mut mesh, kind, &line).with_context(|| line.place())?;
    }
    let welded = weld::weld(&mut mesh.positions, options.weld);
    let mut colored = 0;
    for _ in 0..faces {
        let line = lines.next("faces")?;
        colored += usize::from(add_face(&mut mesh, &line).with_context(|| line.place())?);
    }
    mesh.submesh_index_counts = vec![mesh.indices.len() as u32];
    split(&mut mesh, options.smoothing_angle)?;
    let normals = kind.has_normals.then(|| "its normals, which have no hard edges,".to_owned());
    let colors = (colored > 0).then(|| format!("the colours of {colored} faces"));
    let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    Ok(OffDocument {
        mesh: SourceMesh { name, mesh },
        normals: NormalsRead { computed: true, ..NormalsRead::default() },
        welded,
        left_out: normals.into_iter().chain(colors).collect(),
    })
}

/// The words of a line, and its number.
struct Line<'a> {
    number: usize,
    words: Vec<&'a str>,
}

impl Line<'_> {
    fn place(&self) -> String {
        format!("line {}", self.number)
    }
}

/// The lines that say something.
struct Lines<'a> {
    lines: Box<dyn Iterator<Item = Line<'a>> + 'a>,
    /// Put back, to be read first.
    left: Option<Line<'a>>,
}

impl<'a> Lines<'a> {
    fn new(text: &'a str) -> Lines<'a> {
        let line = |(number, line): (usize, &'a str)| {
            let said = line.trim_start_matches('\u{feff}').split('#').next().unwrap_or_default();
            Line { number, words: said.split_ascii_whitespace().collect() }
        };
        let lines = (1..).zip(text.lines()).map(line).filter(|line| !line.words.is_empty());
        Lines { lines: Box::new(lines), left: None }
    }

    fn next(&mut self, of: &str) -> Result<Line<'a>> {
        let next = self.left.take().or_else(|| self.lines.next());
        next.with_context(|| format!("cut off: {of} are missing; fetch or export it anew"))
    }
}

/// What each vertex has.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Kind {
    has_uvs: bool,
    has_colors: bool,
    has_normals: bool,
    /// Whether places have other than three coordinates.
    has_dimension: bool,
}

impl Kind {
    /// Of the word that a file begins with, `[ST][C][N][4][n]OFF`. The counts may follow on its line.
    fn read(lines: &mut Lines) -> Result<Kind> {
        let mut line = lines.next("a header and all else")?;
        let word = line.words.remove(0);
        ensure!(line.words.first() != Some(&"BINARY"), "binary OFF is not read: write it as text");
        if !line.words.is_empty() {
            lines.left = Some(line);
        }
        let mut rest = word.strip_suffix("OFF").context("does not begin with OFF")?;
        let mut has = |mark: &str| match rest.strip_prefix(mark) {
            Some(behind) => {
                rest = behind;
                true
            }
            None => false,
        };
        let (has_uvs, has_colors, has_normals) = (has("ST"), has("C"), has("N"));
        let has_dimension = has("4") | has("n");
        ensure!(rest.is_empty(), "does not begin with OFF, but with {word:?}");
        Ok(Kind { has_uvs, has_colors, has_normals, has_dimension })
    }
}

/// One word as a number.
fn number<T: std::str::FromStr>(line: &Line, place: usize) -> Result<T> {
    let word =
        line.words.get(place).with_context(|| format!("line {} is too short", line.number))?;
    word.parse().ok().with_context(|| format!("line {}: no such number: {word}", line.number))
}

/// A place, and, as far as the kind says so, a normal, a colour and a texture coordinate.
fn add_vertex(mesh: &mut MeshBuffers, kind: Kind, line: &Line) -> Result<()> {
    let mut position = [0.0f32; 3];
    for (axis, along) in position.iter_mut().enumerate() {
        *along = number(line, axis)?;
    }
    ensure!(
        position.iter().all(|along| along.is_finite()),
        "a coordinate is infinite or not a number: repair the model"
    );
    mesh.positions.push(position);
    let color = if kind.has_normals { 6 } else { 3 };
    let coordinates = line.words.len().saturating_sub(if kind.has_uvs { 2 } else { 0 });
    if kind.has_colors {
        mesh.colors.push(color_of(line.words.get(color..coordinates).unwrap_or_default()));
    }
    if kind.has_uvs {
        let uvs = [number::<f32>(line, coordinates)?, number(line, coordinates + 1)?];
        ensure!(uvs.iter().all(|uv| uv.is_finite()), "a texture coordinate is not finite");
        mesh.uvs[0].components = 2;
        // Counted from below, in glTF from above.
        mesh.uvs[0].values.extend([uvs[0], 1.0 - uvs[1]]);
    }
    Ok(())
}

/// Linear, from bytes or from shares of one; white where there is none.
fn color_of(words: &[&str]) -> [f32; 4] {
    let is_bytes = words.iter().all(|word| !word.contains('.'));
    let mut color = [1.0; 4];
    for (channel, word) in color.iter_mut().zip(words) {
        let Ok(value) = word.parse::<f32>() else { return [1.0; 4] };
        let share = if is_bytes { value / 255.0 } else { value };
        *channel = if share.is_finite() { share.clamp(0.0, 1.0) } else { 1.0 };
    }
    let [red, green, blue, alpha] = color;
    let [red, green, blue] = [red, green, blue].map(linear);
    [red, green, blue, alpha]
}

/// OFF has colours as pictures have them, glTF linear.
fn linear(share: f32) -> f32 {
    share * share * (0.305 * share + 0.695)
}

/// Cuts a polygon into triangles. Tells whether it has a colour of its own.
fn add_face(mesh: &mut MeshBuffers, line: &Line) -> Result<bool> {
    let count: usize = number(line, 0)?;
    ensure!(count < line.words.len(), "has fewer than the {count} vertices that it announces");
    let corners = (1..=count).map(|place| number::<u32>(line, place));
    let corners = corners.collect::<Result<Vec<u32>>>()?;
    let vertices = mesh.positions.len();
    if let Some(wrong) = corners.iter().find(|corner| **corner as usize >= vertices) {
        bail!("vertex {wrong} of {vertices} that the file has");
    }
    if count >= 3 {
        let places: Vec<[f32; 3]> = corners.iter().map(|&v| mesh.positions[v as usize]).collect();
        let triangles = triangulate(&places).into_iter().flatten();
        mesh.indices.extend(triangles.map(|corner| corners[corner]));
    }
    Ok(line.words.len() > count + 1)
}

/// Gives all vertices normals, and each as many copies as it needs for that.
fn split(mesh: &mut MeshBuffers, angle: f32) -> Result<()> {
    let smoothed = split_by_angle(&mesh.positions, &mesh.indices, angle)?;
    let sources = || smoothed.source_of.iter().map(|source| *source as usize);
    mesh.positions = sources().map(|source| mesh.positions[source]).collect();
    if !mesh.colors.is_empty() {
        mesh.colors = sources().map(|source| mesh.colors[source]).collect();
    }
    let UvBuffer { components, values } = std::mem::take(&mut mesh.uvs[0]);
    if components > 0 {
        let values = sources().flat_map(|s| [values[2 * s], values[2 * s + 1]]).collect();
        mesh.uvs[0] = UvBuffer { components, values };
    }
    (mesh.normals, mesh.indices) = (smoothed.normals, smoothed.indices);
    Ok(())
}

impl Document for OffDocument {
    fn meshes(&self) -> &[SourceMesh] {
        std::slice::from_ref(&self.mesh)
    }

    fn normals(&self) -> &[NormalsRead] {
        std::slice::from_ref(&self.normals)
    }

    fn notes(&self) -> Vec<String> {
        let left_out = self.left_out.iter().map(|what| format!("{what} do not go along"));
        left_out.chain(weld::note(self.welded)).collect()
    }

    fn encode(&self, _: Format, output: &Path, chamfered: &[Chamfered]) -> Result<Encoded> {
        let mesh = &chamfered.first().context("the mesh is missing")?.mesh;
        let bytes = glb::encode(&self.mesh.name, mesh, &[], &[])?;
        Ok(vec![OutputFile { path: output.to_path_buf(), bytes }].into())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<OffDocument> {
        decode(Path::new("a.off"), text.as_bytes(), &ReadOptions::default())
    }

    /// Two squares at a right angle; comments, and a line that says nothing.
    const BENT: &str = "OFF\n# bent\n6 2 0\n\n0 0 0\n1 0 0 # a corner\n1 1 0\n0 1 0\n1 0 -1\n\
        0 0 -1\n4 0 1 2 3\n4 1 0 5 4 0.5 0.5 0.5\n";

    #[test]
    fn polygons_are_cut_and_vertices_split_at_edges() {
        let document = read(BENT).unwrap();
        let mesh = &document.meshes()[0].mesh;
        assert_eq!((mesh.positions.len(), mesh.indices.len()), (8, 12));
        assert_eq!(mesh.normals[mesh.indices[0] as usize], [0.0, 0.0, 1.0]);
        assert_eq!(document.notes(), ["the colours of 1 faces do not go along"]);
        let result = chamfer::chamfer(&mesh.as_mesh(), &chamfer::Options::default()).unwrap();
        assert_eq!(result.totals.hard_edges, 1);
        let path = Path::new("a.glb");
        assert_eq!(document.encode(Format::Glb, path, &[result]).unwrap().files.len(), 1);
    }

    #[test]
    fn counts_may_follow_the_header_and_lines_end_in_any_way() {
        let [one, other] =
            [BENT, &BENT.replace("OFF\n# bent\n", "\u{feff}OFF ").replace('\n', "\r\n")]
                .map(|text| read(text).unwrap().meshes()[0].mesh.positions.clone());
        assert_eq!(one, other);
    }

    #[test]
    fn vertices_have_what_the_header_says() {
        let colors = ["255 0 0 255", "1.0 0.0 0.0", "1.0 0.0 0.0 1.0"];
        for color in colors {
            let line = |x: u8, y: u8| format!("{x} {y} 0 0 0 2 {color} {x} {y}\n");
            let vertices = line(0, 0) + &line(1, 0) + &line(0, 1);
            let document = read(&format!("STCNOFF\n3 1 3\n{vertices}3 0 1 2\n")).unwrap();
            let mesh = &document.meshes()[0].mesh;
            assert_eq!(mesh.colors, [[1.0, 0.0, 0.0, 1.0]; 3], "{color}");
            assert_eq!(mesh.uvs[0].values, [0.0, 1.0, 1.0, 1.0, 0.0, 0.0]);
            let note = "its normals, which have no hard edges, do not go along";
            assert_eq!(document.notes(), [note]);
        }
    }

    #[test]
    fn nonsense_is_refused() {
        let error = |from: &str, to: &str| {
            format!("{:#}", read(&BENT.replacen(from, to, 1)).err().expect(to))
        };
        assert_eq!(error("4 0 1 2 3", "4 0 1 2 9"), "line 11: vertex 9 of 6 that the file has");
        assert!(error("4 0 1 2 3", "5 0 1 2 3").contains("fewer than the 5"));
        assert!(error("4 0 1 2 3", "4 0 1 2 -3").contains("no such number: -3"));
        assert!(error("1 1 0", "1 nan 0").contains("line 7: a coordinate"));
        assert!(error("6 2 0", "7 2 0").contains("cut off: faces are missing"));
        assert!(error("OFF", "4OFF").contains("other than three"));
        assert!(error("OFF", "OFF BINARY").contains("binary OFF is not read"));
        assert!(error("OFF", "COFFEE").contains("does not begin with OFF"));
    }
}
