//! PLY: one mesh of polygons, with what its vertices have. Read by a crate; written as .glb.

use std::io::Cursor;
use std::path::Path;

use anyhow::{Context, Result, bail, ensure};
use chamfer::{Chamfered, MeshBuffers, UvBuffer, split_by_angle};
use glam::Vec3;
use ply_rs_bw::parser::{Parser, Reader};
use ply_rs_bw::ply::{DefaultElement, Property};

use crate::document::{
    Document, Encoded, Format, Normals, NormalsRead, OutputFile, ReadOptions, SourceMesh,
    no_direction,
};
use crate::foreign::check_encoding;
use crate::polygon::triangulate;
use crate::{glb, weld};

/// A PLY file: one mesh of one submesh.
pub struct PlyDocument {
    mesh: SourceMesh,
    normals: NormalsRead,
    welded: usize,
    /// How many normals were none.
    without_direction: usize,
    /// Elements that do not go along.
    left_out: Vec<String>,
}

/// Reads the bytes of an ASCII or binary PLY. Polygons are cut into triangles; without normals,
/// vertices are split where faces meet at more than the smoothing angle.
///
/// # Errors
/// Where it is cut off, a face names a vertex that is not there, or a position is not finite.
pub fn decode(path: &Path, bytes: &[u8], options: &ReadOptions) -> Result<PlyDocument> {
    check_encoding(bytes)?;
    let parser = Parser::<DefaultElement>::new();
    let mut reader = Reader::new(Cursor::new(bytes));
    let header = parser.read_header(&mut reader).context("its header cannot be read")?;
    for (name, element) in &header.elements {
        // Each takes a byte at least, or a few words could ask for any number.
        let fits = element.count <= bytes.len() && !element.properties.is_empty();
        ensure!(
            element.count == 0 || fits,
            "the header announces {} of {name:?}, more than the file can hold",
            element.count
        );
    }
    let payload = parser.read_payload(&mut reader, &header).context("cannot be read as PLY")?;
    let elements = |name: &str| payload.get(name).map_or(&[][..], Vec::as_slice);
    let vertices = elements("vertex");
    let mut mesh = streams(vertices)?;
    let welded = weld::weld(&mut mesh.positions, options.weld);
    for (number, face) in elements("face").iter().enumerate() {
        let corners = corners(face, vertices.len()).with_context(|| format!("face {number}"))?;
        let places: Vec<[f32; 3]> = corners.iter().map(|&v| mesh.positions[v as usize]).collect();
        let triangles = triangulate(&places).into_iter().flatten();
        mesh.indices.extend(triangles.map(|corner| corners[corner]));
    }
    mesh.submesh_index_counts = vec![mesh.indices.len() as u32];
    let without_direction = match options.normals {
        Normals::Keep => zero_normals(&mesh),
        Normals::Angle => Vec::new(),
    };
    let is_without = !mesh.normals.is_empty() && without_direction.len() == mesh.normals.len();
    let computed = mesh.normals.is_empty() || is_without || options.normals == Normals::Angle;
    let normals = NormalsRead { computed, ..NormalsRead::default() };
    if computed {
        split(&mut mesh, options.smoothing_angle)?;
    } else {
        fill_in(&mut mesh, &without_direction)?;
    }
    let without_direction = without_direction.len();
    let is_known = |name: &str| matches!(name, "vertex" | "face");
    let left_out = header.elements.keys().filter(|name| !is_known(name)).cloned().collect();
    let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    Ok(PlyDocument {
        mesh: SourceMesh { name, mesh },
        normals,
        welded,
        without_direction,
        left_out,
    })
}

/// What the vertices have, by the names that most programs use.
fn streams(vertices: &[DefaultElement]) -> Result<MeshBuffers> {
    let has = |names: &[&str]| {
        vertices.first().is_some_and(|vertex| names.iter().all(|name| vertex.contains_key(*name)))
    };
    let mut mesh = MeshBuffers::default();
    for (number, vertex) in vertices.iter().enumerate() {
        let position = ["x", "y", "z"].map(|name| number_of(vertex, name));
        let is_finite = |place: &[f32; 3]| place.iter().all(|at| at.is_finite());
        let place = match position {
            [Some(x), Some(y), Some(z)] => Some([x, y, z]).filter(is_finite),
            _ => None,
        };
        let Some(place) = place else {
            bail!("vertex {number} has no place, or an infinite one or a NaN: repair the model")
        };
        mesh.positions.push(place);
    }
    let all = |names: [&'static str; 3]| {
        vertices.iter().map(move |v| names.map(|name| number_of(v, name).unwrap_or_default()))
    };
    if has(&["nx", "ny", "nz"]) {
        let unit = |normal: [f32; 3]| Vec3::from(normal).normalize_or_zero();
        mesh.normals = all(["nx", "ny", "nz"]).map(|normal| unit(normal).to_array()).collect();
    }
    if has(&["red", "green", "blue"]) {
        let color = |vertex: &DefaultElement| {
            ["red", "green", "blue", "alpha"].map(|name| color_of(vertex, name))
        };
        mesh.colors = vertices.iter().map(color).collect();
    }
    for [u, v] in [["u", "v"], ["s", "t"], ["texture_u", "texture_v"]] {
        if has(&[u, v]) && mesh.uvs[0].values.is_empty() {
            // PLY counts the second coordinate from below, glTF from above.
            let values = all([u, v, v]).flat_map(|[u, v, _]| [u, 1.0 - v]).collect();
            mesh.uvs[0] = UvBuffer { components: 2, values };
        }
    }
    Ok(mesh)
}

fn number_of(vertex: &DefaultElement, name: &str) -> Option<f32> {
    vertex.get(name)?.to_f32_lossy()
}

/// A colour from 0 to 1; opaque where there is none. glTF has them linear, PLY as images have them.
fn color_of(vertex: &DefaultElement, name: &str) -> f32 {
    let Some(value) = vertex.get(name).and_then(Property::to_u8_color_lossy) else { return 1.0 };
    let share = f32::from(value) / 255.0;
    if name == "alpha" { share } else { share * share * (0.305 * share + 0.695) }
}

/// The vertices of a face; none for what is no polygon.
fn corners(face: &DefaultElement, count: usize) -> Result<Vec<u32>> {
    let list = ["vertex_indices", "vertex_index"].iter().find_map(|name| face.get(*name));
    let corners = list.and_then(Property::to_u32_list).context("has no list of vertices")?;
    if let Some(wrong) = corners.iter().find(|corner| **corner as usize >= count) {
        bail!("vertex {wrong} of {count} that the file has");
    }
    Ok(if corners.len() < 3 { Vec::new() } else { corners })
}

/// The vertices whose normal is none.
fn zero_normals(mesh: &MeshBuffers) -> Vec<usize> {
    let is_zero = |vertex: &usize| mesh.normals[*vertex] == [0.0; 3];
    (0..mesh.normals.len()).filter(is_zero).collect()
}

/// Gives vertices the mean normal of the faces around their places, or any where there is none.
fn fill_in(mesh: &mut MeshBuffers, vertices: &[usize]) -> Result<()> {
    if vertices.is_empty() {
        return Ok(());
    }
    let made = split_by_angle(&mesh.positions, &mesh.indices, ALL_FACES)?;
    for &vertex in vertices {
        let normal = Vec3::from(made.normals[vertex]).try_normalize().unwrap_or(Vec3::Z);
        mesh.normals[vertex] = normal.to_array();
    }
    Ok(())
}

/// The angle at which all faces around a place shade as one.
const ALL_FACES: f32 = 180.0;

/// Gives all vertices normals, and each as many copies as it needs for that.
fn split(mesh: &mut MeshBuffers, angle: f32) -> Result<()> {
    let smoothed = split_by_angle(&mesh.positions, &mesh.indices, angle)?;
    let sources = || smoothed.source_of.iter().map(|source| *source as usize);
    mesh.positions = sources().map(|source| mesh.positions[source]).collect();
    if !mesh.colors.is_empty() {
        mesh.colors = sources().map(|source| mesh.colors[source]).collect();
    }
    let uvs = std::mem::take(&mut mesh.uvs[0].values);
    if !uvs.is_empty() {
        mesh.uvs[0].values = sources().flat_map(|s| [uvs[2 * s], uvs[2 * s + 1]]).collect();
    }
    (mesh.normals, mesh.indices) = (smoothed.normals, smoothed.indices);
    Ok(())
}

impl Document for PlyDocument {
    fn meshes(&self) -> &[SourceMesh] {
        std::slice::from_ref(&self.mesh)
    }

    fn normals(&self) -> &[NormalsRead] {
        std::slice::from_ref(&self.normals)
    }

    fn notes(&self) -> Vec<String> {
        let left_out = self.left_out.iter();
        let notes = left_out.map(|name| format!("its elements {name:?} do not go along"));
        notes.chain(weld::note(self.welded)).chain(no_direction(self.without_direction)).collect()
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

    fn read(bytes: &[u8]) -> Result<PlyDocument> {
        decode(Path::new("a.ply"), bytes, &ReadOptions::default())
    }

    /// Two squares at a right angle, of coloured vertices.
    const BENT: &str = "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\n\
        property float y\nproperty float z\nproperty uchar red\nproperty uchar green\n\
        property uchar blue\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n\
        0 0 0 255 0 0\n1 0 0 255 0 0\n1 1 0 255 0 0\n0 1 0 255 0 0\n1 0 -1 0 0 0\n0 0 -1 0 0 0\n\
        4 0 1 2 3\n4 1 0 5 4\n";

    #[test]
    fn polygons_are_cut_and_vertices_split_at_edges() {
        let document = read(BENT.as_bytes()).unwrap();
        let mesh = &document.meshes()[0].mesh;
        assert_eq!((mesh.positions.len(), mesh.indices.len()), (8, 12));
        assert_eq!(mesh.normals[mesh.indices[0] as usize], [0.0, 0.0, 1.0]);
        assert_eq!(mesh.colors[mesh.indices[0] as usize], [1.0, 0.0, 0.0, 1.0]);
        let options = chamfer::Options::default();
        let result = chamfer::chamfer(&mesh.as_mesh(), &options).unwrap();
        assert_eq!(result.totals.hard_edges, 1);
        let path = Path::new("a.glb");
        assert_eq!(document.encode(Format::Glb, path, &[result]).unwrap().files.len(), 1);
    }

    #[test]
    fn binary_files_with_normals_and_coordinates_are_read() {
        let header = "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\n\
            property float y\nproperty float z\nproperty float nx\nproperty float ny\n\
            property float nz\nproperty float s\nproperty float t\nelement face 1\n\
            property list uchar uint vertex_index\nelement edge 0\nproperty int vertex1\nend_header\n";
        let vertices = [[0.0f32, 0.0], [1.0, 0.0], [0.0, 1.0]]
            .map(|[x, y]| [x, y, 0.0, 0.0, 0.0, 2.0, x, y].map(f32::to_le_bytes));
        let face = [&[3u8][..], &[0u32, 1, 2].map(u32::to_le_bytes).concat()].concat();
        let bytes = [header.as_bytes(), vertices.as_flattened().as_flattened(), &face].concat();
        let document = read(&bytes).unwrap();
        let mesh = &document.meshes()[0].mesh;
        assert_eq!(
            (mesh.normals.clone(), &mesh.indices),
            (vec![[0.0, 0.0, 1.0]; 3], &vec![0, 1, 2])
        );
        assert_eq!(mesh.uvs[0].values, [0.0, 1.0, 1.0, 1.0, 0.0, 0.0]);
        assert_eq!(document.notes(), ["its elements \"edge\" do not go along"]);
        let mut infinite = bytes.clone();
        infinite[header.len()..header.len() + 4].copy_from_slice(&f32::NAN.to_le_bytes());
        assert!(format!("{:#}", read(&infinite).err().unwrap()).contains("vertex 0 has no place"));
        for length in 0..bytes.len() {
            assert!(read(&bytes[..length]).is_err(), "{length} bytes");
        }
    }

    #[test]
    fn normals_without_a_direction_are_made() {
        let file = |normals: [&str; 3]| {
            let places = ["0 0 0", "1 0 0", "0 1 0"];
            let vertices =
                places.iter().zip(normals).map(|(at, normal)| format!("{at} {normal}\n"));
            format!(
                "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n\
                 property float z\nproperty float nx\nproperty float ny\nproperty float nz\n\
                 element face 1\nproperty list uchar int vertex_indices\nend_header\n{}3 0 1 2\n",
                vertices.collect::<String>()
            )
        };
        let some = read(file(["1 0 0", "0 0 0", "1 0 0"]).as_bytes()).unwrap();
        let (up, side) = ([0.0, 0.0, 1.0], [1.0, 0.0, 0.0]);
        assert_eq!(some.meshes()[0].mesh.normals, [side, up, side]);
        let note = "1 normals have no direction: they were made from the faces";
        assert_eq!((some.notes(), some.normals()[0].computed), (vec![note.to_owned()], false));
        let all = read(file(["0 0 0"; 3]).as_bytes()).unwrap();
        assert_eq!(all.meshes()[0].mesh.normals, [up; 3]);
        assert!(all.normals()[0].computed && all.notes()[0].starts_with("3 normals"));
    }

    #[test]
    fn nonsense_is_refused() {
        let error = |from: &str, to: &str| {
            format!("{:#}", read(BENT.replacen(from, to, 1).as_bytes()).err().expect(to))
        };
        assert!(error("4 0 1 2 3", "4 0 1 2 9").contains("face 0: vertex 9 of 6"));
        assert!(error("4 0 1 2 3", "4 0 1 2 -3").contains("face 0"));
        let told = error("1 1 0 255", "1 nan 0 255");
        assert!(told.contains("Line 15"), "{told}");
        assert!(error("vertex 6", "vertex 4000000000").contains("more than the file can hold"));
        assert!(error("float x", "float w").contains("vertex 0 has no place"));
    }
}
