//! A chamfered mesh as OBJ text, in the structure of the file that it came from.

use std::collections::HashMap;
use std::io::Write;

use chamfer::{Chamfered, MeshBuffers, TriangleKind};

use crate::polygon::triangulate;

use super::build::Origin;
use super::parse::{Item, Obj};

/// The group and material of the triangles in a submesh that the file did not have.
const OWN_SUBMESH: &str = "chamfer";

/// Writes the file. Vertices that no face used stay; those that were pulled away go.
pub fn write(obj: &Obj, source: &MeshBuffers, origin: &Origin, result: &Chamfered) -> Vec<u8> {
    let positions = Positions::new(obj, source, origin, &result.mesh);
    let texcoords = texcoords(origin, result);
    let normals = Table::new(result.mesh.normals.iter().map(|&normal| Some(normal)));
    let mut text = Text::default();
    for comment in &obj.comments {
        text.line(comment);
    }
    for value in &positions.lines {
        text.numbers("v", &value[..3 + obj.color_components]);
    }
    for value in &texcoords.values {
        text.numbers("vt", &value[..result.mesh.uvs[0].components as usize]);
    }
    for value in &normals.values {
        text.numbers("vn", value);
    }
    let line_of = Vertices {
        position: &positions.line_of,
        texcoord: &texcoords.number_of,
        normal: &normals.number_of,
    };
    let polygons = polygons(origin, result);
    text.items(obj, &result.mesh, &polygons, &line_of, &positions.line_of_source);
    text.0
}

/// `#triangles` of the result: for the first of a polygon that is still whole its corners, and none
/// for the others of it; for all other triangles themselves.
fn polygons(origin: &Origin, result: &Chamfered) -> Vec<Vec<u32>> {
    let triangles = result.mesh.indices.as_chunks::<3>().0;
    let mut faces: Vec<Vec<u32>> = triangles.iter().map(|triangle| triangle.to_vec()).collect();
    let mut place_of = vec![None; origin.polygon_of.len()];
    for (place, source) in result.triangle_sources.iter().enumerate() {
        if source.kind == TriangleKind::Source {
            place_of[source.index as usize] = Some(place);
        }
    }
    let mut first = 0;
    for polygon in origin.polygon_of.chunk_by(|a, b| a == b) {
        let own = first..first + polygon.len();
        first = own.end;
        let places: Option<Vec<usize>> = place_of[own.clone()].iter().copied().collect();
        if let Some(places) = places.filter(|places| places.len() > 1)
            && let Some(loop_) = whole(&origin.places[own], &places, triangles, &result.mesh)
        {
            places.iter().for_each(|&place| faces[place].clear());
            faces[places[0]] = loop_;
        }
    }
    faces
}

/// The corners of a polygon, if its triangles still agree about them, and whoever reads it would
/// cut it into the same.
fn whole(
    corners: &[[u32; 3]],
    places: &[usize],
    triangles: &[[u32; 3]],
    mesh: &MeshBuffers,
) -> Option<Vec<u32>> {
    let mut polygon = vec![None; corners.len() + 2];
    for (corners, &place) in corners.iter().zip(places) {
        for (&corner, &vertex) in corners.iter().zip(&triangles[place]) {
            let known = polygon.get_mut(corner as usize)?;
            if *known.get_or_insert(vertex) != vertex {
                return None;
            }
        }
    }
    let polygon: Vec<u32> = polygon.into_iter().collect::<Option<_>>()?;
    let points: Vec<_> = polygon.iter().map(|&at| mesh.positions[at as usize]).collect();
    let cut = triangulate(&points).into_iter().map(|triangle| triangle.map(|at| at as u32));
    cut.eq(corners.iter().copied()).then_some(polygon)
}

/// Distinct values, numbered from 1 in the order of first use.
struct Table<const N: usize> {
    values: Vec<[f32; N]>,
    /// `#vertices`: the number of each vertex's value; 0 for those without.
    number_of: Vec<usize>,
}

impl<const N: usize> Table<N> {
    fn new(of_vertices: impl Iterator<Item = Option<[f32; N]>>) -> Self {
        let mut values = Vec::new();
        let mut numbers = HashMap::new();
        let number = |value: Option<[f32; N]>| {
            value.map_or(0, |value| {
                *numbers.entry(value.map(f32::to_bits)).or_insert_with(|| {
                    values.push(value);
                    values.len()
                })
            })
        };
        let number_of = of_vertices.map(number).collect();
        Table { values, number_of }
    }
}

fn texcoords(origin: &Origin, result: &Chamfered) -> Table<3> {
    let uv = &result.mesh.uvs[0];
    let components = uv.components as usize;
    Table::new((0..result.mesh.positions.len()).map(|vertex| {
        let source = result.vertex_sources.get(vertex).uv(0).vertices[0];
        if components == 0 || !origin.has_texcoord[source as usize] {
            return None;
        }
        let mut value = [0.0; 3];
        value[..components].copy_from_slice(&uv.values[vertex * components..][..components]);
        Some(value)
    }))
}

/// The `v` lines of the result.
struct Positions {
    /// Coordinates and colour of each.
    lines: Vec<[f32; 7]>,
    /// `#vertices` of the result: the line of each, from 1.
    line_of: Vec<usize>,
    /// `#v` of the file: the line that each has become; 0 for those that are gone.
    line_of_source: Vec<usize>,
}

impl Positions {
    fn new(obj: &Obj, source: &MeshBuffers, origin: &Origin, mesh: &MeshBuffers) -> Positions {
        let stays = |vertex: usize| {
            let before = source.positions.get(vertex);
            before.is_some_and(|p| p.map(f32::to_bits) == mesh.positions[vertex].map(f32::to_bits))
        };
        let mut positions = Positions {
            lines: Vec::new(),
            line_of: Vec::new(),
            line_of_source: vec![0; obj.positions.len()],
        };
        // New vertices at an old place share its line, so that faces stay joined by number.
        let mut known = HashMap::new();
        let kept = kept(obj, origin, stays);
        for number in (0..kept.len()).filter(|&number| kept[number]) {
            let value = with_color(obj.positions[number], Some(&obj.colors[number]));
            positions.lines.push(value);
            positions.line_of_source[number] = positions.lines.len();
            known.entry(value.map(f32::to_bits)).or_insert(positions.lines.len());
        }
        for (vertex, &position) in mesh.positions.iter().enumerate() {
            let line = if stays(vertex) {
                positions.line_of_source[origin.position_of[vertex] as usize]
            } else {
                let value = with_color(position, mesh.colors.get(vertex));
                *known.entry(value.map(f32::to_bits)).or_insert_with(|| {
                    positions.lines.push(value);
                    positions.lines.len()
                })
            };
            positions.line_of.push(line);
        }
        positions
    }
}

/// `#v`: whether the line is needed: by a vertex that stays in place, by a line or point element,
/// or because no face ever used it.
fn kept(obj: &Obj, origin: &Origin, stays: impl Fn(usize) -> bool) -> Vec<bool> {
    let mut kept = vec![true; obj.positions.len()];
    for &position in &origin.position_of {
        kept[position as usize] = false;
    }
    for (vertex, &position) in origin.position_of.iter().enumerate() {
        kept[position as usize] |= stays(vertex);
    }
    for item in &obj.items {
        if let Item::Element(_, positions) = item {
            positions.iter().for_each(|&position| kept[position as usize] = true);
        }
    }
    kept
}

fn with_color([x, y, z]: [f32; 3], color: Option<&[f32; 4]>) -> [f32; 7] {
    let [r, g, b, a] = color.copied().unwrap_or([1.0; 4]);
    [x, y, z, r, g, b, a]
}

/// `#vertices` each: the lines that a corner refers to.
struct Vertices<'a> {
    position: &'a [usize],
    texcoord: &'a [usize],
    normal: &'a [usize],
}

/// OBJ text under way. Writing to memory cannot fail.
#[derive(Default)]
struct Text(Vec<u8>);

impl Text {
    fn line(&mut self, line: &[u8]) {
        self.0.extend(line);
        self.0.push(b'\n');
    }

    /// Numbers in the shortest form that reads back to the same.
    fn numbers(&mut self, keyword: &str, values: &[f32]) {
        self.0.extend(keyword.as_bytes());
        for value in values {
            let _ = write!(self.0, " {value}");
        }
        self.0.push(b'\n');
    }

    fn items(
        &mut self,
        obj: &Obj,
        mesh: &MeshBuffers,
        faces: &[Vec<u32>],
        vertices: &Vertices,
        line_of_source: &[usize],
    ) {
        let mut rest = faces;
        let mut counts = mesh.submesh_index_counts.iter();
        let mut next_run = || {
            let (run, after) = rest.split_at(*counts.next()? as usize / 3);
            rest = after;
            Some(run)
        };
        for item in &obj.items {
            match item {
                Item::Line(line) => self.line(line),
                Item::Faces(_) => self.faces(next_run().unwrap_or_default(), vertices),
                Item::Element(keyword, positions) => {
                    self.element(*keyword, positions, line_of_source);
                }
            }
        }
        if let Some(run) = next_run().filter(|run| !run.is_empty()) {
            self.line(format!("g {OWN_SUBMESH}\nusemtl {OWN_SUBMESH}").as_bytes());
            self.faces(run, vertices);
        }
    }

    fn element(&mut self, keyword: u8, positions: &[u32], line_of_source: &[usize]) {
        self.0.push(keyword);
        for &position in positions {
            let _ = write!(self.0, " {}", line_of_source[position as usize]);
        }
        self.0.push(b'\n');
    }

    fn faces(&mut self, faces: &[Vec<u32>], vertices: &Vertices) {
        for face in faces.iter().filter(|face| !face.is_empty()) {
            let corners = face.iter().map(|&index| index as usize);
            let textured = corners.clone().all(|corner| vertices.texcoord[corner] > 0);
            self.0.push(b'f');
            for corner in corners {
                let (position, normal) = (vertices.position[corner], vertices.normal[corner]);
                let _ = match vertices.texcoord[corner] {
                    texcoord if textured => write!(self.0, " {position}/{texcoord}/{normal}"),
                    _ => write!(self.0, " {position}//{normal}"),
                };
            }
            self.0.push(b'\n');
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::obj_file::{build, parse};
    use chamfer::{Blend, TriangleSource, VertexSource};

    /// The text after `change` was made to the mesh of another text.
    fn rewritten(text: &str, change: impl FnOnce(&mut MeshBuffers)) -> String {
        let obj = parse::parse(text.as_bytes()).unwrap();
        let build::Built { mesh: source, origin, .. } =
            build::build(&obj, &crate::ReadOptions::default()).unwrap();
        let mut mesh = source.clone();
        change(&mut mesh);
        let one = |_| VertexSource::new(Blend::one(0), Blend::one(0));
        let vertex_sources = (0..mesh.positions.len()).map(one).collect();
        let triangles = source.indices.len() as u32 / 3;
        let kept = |index| TriangleSource { kind: TriangleKind::Source, index };
        let triangle_sources = (0..triangles).map(kept).collect();
        let mut result = Chamfered::default();
        (result.mesh, result.vertex_sources) = (mesh, vertex_sources);
        result.triangle_sources = triangle_sources;
        String::from_utf8(write(&obj, &source, &origin, &result)).unwrap()
    }

    const MODEL: &str = "\
# by me
v 0 0 0
v 1 0 0
v 0 0.1 0
v 9 9 9
vt 0 0
vt 0.5 1
vn 0 0 1
mtllib some.mtl
o first
g a b
usemtl red
f 1/1/1 2/2/1 3/2/1
o empty
l 1 4
o second
f 3/2/1 2/2/1 1/1/1
";

    #[test]
    fn an_unchanged_mesh_is_the_same_file() {
        assert_eq!(rewritten(MODEL, |_| {}), MODEL);
    }

    #[test]
    fn a_vertex_that_was_pulled_away_takes_its_line_with_it() {
        let text = rewritten(MODEL, |mesh| mesh.positions[1] = [0.75, 0.0, 0.0]);
        assert!(text.starts_with("# by me\nv 0 0 0\nv 0 0.1 0\nv 9 9 9\nv 0.75 0 0\nvt"), "{text}");
        assert!(text.contains("f 1/1/1 4/2/1 2/2/1\n"), "{text}");
        assert!(text.contains("l 1 3\n"), "{text}");
    }

    #[test]
    fn a_new_submesh_becomes_a_group() {
        let text = rewritten(MODEL, |mesh| {
            mesh.indices.extend([0, 1, 2]);
            mesh.submesh_index_counts.push(3);
        });
        assert!(text.ends_with("g chamfer\nusemtl chamfer\nf 1/1/1 2/2/1 3/2/1\n"), "{text}");
    }

    #[test]
    fn faces_without_texture_and_vertices_with_colours_stay_so() {
        let model =
            "v 0 0 0 0.5 0 0\nv 1 0 0 1 1 1\nv 0 1 0 0.25 0 1\nvn 0 0 1\nf 1//1 2//1 3//1\n";
        assert_eq!(rewritten(model, |_| {}), model);
    }

    const QUAD: &str = "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nvn 0 0 1\nf 1//1 2//1 3//1 4//1\n";

    #[test]
    fn a_quad_that_is_whole_stays_one() {
        assert_eq!(rewritten(QUAD, |_| {}), QUAD);
        let text = rewritten(QUAD, |mesh| mesh.positions[0] = [0.5, 0.5, 0.0]);
        assert!(text.ends_with("f 4//1 1//1 2//1 3//1\n"), "{text}");
    }

    /// Where its triangles part, and where a reader would cut it along its other diagonal.
    #[test]
    fn a_quad_that_was_cut_is_triangles() {
        let text = rewritten(QUAD, |mesh| {
            mesh.positions.push([0.25, 0.25, 0.0]);
            mesh.normals.push([0.0, 0.0, 1.0]);
            mesh.indices[3] = 4;
        });
        assert_eq!(text.matches("f ").count(), 2, "{text}");
        let text = rewritten(QUAD, |mesh| mesh.positions[1] = [0.5, 1.5, 0.0]);
        assert_eq!(text.matches("f ").count(), 2, "{text}");
    }

    #[test]
    fn numbers_read_back_to_the_same_bits() {
        let mut text = Text::default();
        text.numbers("v", &[0.1, 1e-42, -0.0, f32::MAX]);
        let text = String::from_utf8(text.0).unwrap();
        let read: Vec<f32> = text.split(' ').skip(1).map(|n| n.trim().parse().unwrap()).collect();
        let bits: Vec<u32> = read.iter().map(|n| n.to_bits()).collect();
        assert_eq!(bits, [0.1, 1e-42, -0.0, f32::MAX].map(f32::to_bits));
    }
}
