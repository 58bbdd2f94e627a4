//! STL: triangles without shared vertices, normals of their own or materials.
//!
//! Read here and not by a crate: those that there are take a binary file whose header begins with
//! "solid" for an ASCII one, and many CAD programs write such headers.

use std::collections::HashMap;
use std::path::Path;

use anyhow::{Context, Result, bail};
use chamfer::{Chamfered, MeshBuffers, split_by_angle};

use crate::document::{
    Document, Encoded, Format, NormalsRead, OutputFile, ReadOptions, SourceMesh,
};
use crate::foreign::check_encoding;
use crate::glb;
use crate::weld;

const HEADER_LENGTH: usize = 80;
/// Header and triangle count.
const PREFIX_LENGTH: usize = HEADER_LENGTH + 4;
/// A normal, three corners and two spare bytes.
const RECORD_LENGTH: usize = 50;

type Triangle = [[f32; 3]; 3];

/// An STL file: one mesh of one submesh.
pub struct StlDocument {
    mesh: SourceMesh,
    normals: NormalsRead,
    /// How many corners were moved onto others.
    welded: usize,
}

/// Reads the bytes of an ASCII or binary STL. Corners at one position become one vertex, split again where
/// faces meet at more than the smoothing angle. The normals in the file are not used.
///
/// # Errors
/// Where it is cut off or holds anything but finite triangles.
pub fn decode(path: &Path, bytes: &[u8], options: &ReadOptions) -> Result<StlDocument> {
    let mut triangles = parse(bytes)?;
    let welded = weld::weld(triangles.as_flattened_mut(), options.weld);
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    let mesh = build(&triangles, options.smoothing_angle)?;
    let normals = NormalsRead { computed: true, ..NormalsRead::default() };
    Ok(StlDocument { mesh: SourceMesh { name: stem.into_owned(), mesh }, normals, welded })
}

impl Document for StlDocument {
    fn meshes(&self) -> &[SourceMesh] {
        std::slice::from_ref(&self.mesh)
    }

    fn normals(&self) -> &[NormalsRead] {
        std::slice::from_ref(&self.normals)
    }

    fn notes(&self) -> Vec<String> {
        weld::note(self.welded).into_iter().collect()
    }

    fn encode(&self, format: Format, output: &Path, chamfered: &[Chamfered]) -> Result<Encoded> {
        let mesh = &chamfered.first().context("the mesh is missing")?.mesh;
        let bytes = match format {
            Format::Stl => binary(mesh)?,
            _ => glb::encode(&self.mesh.name, mesh, &[], &[])?,
        };
        Ok(vec![OutputFile { path: output.to_path_buf(), bytes }].into())
    }
}

fn parse(bytes: &[u8]) -> Result<Vec<Triangle>> {
    let announced = bytes
        .get(HEADER_LENGTH..PREFIX_LENGTH)
        .map(|count| u64::from(u32::from_le_bytes([count[0], count[1], count[2], count[3]])));
    let length = announced.map(|count| PREFIX_LENGTH as u64 + count * RECORD_LENGTH as u64);
    // The length decides first: "solid" begins many a binary header.
    if length != Some(bytes.len() as u64) && is_ascii(bytes) {
        return parse_ascii(bytes);
    }
    if length != Some(bytes.len() as u64) {
        check_encoding(bytes)?;
    }
    let (Some(announced), Some(length)) = (announced, length) else {
        bail!("neither ASCII nor binary STL: {} bytes hold no binary header", bytes.len());
    };
    if length > bytes.len() as u64 {
        let room = (bytes.len() - PREFIX_LENGTH) / RECORD_LENGTH;
        bail!(
            "cut off: the header announces {announced} triangles, the file holds \
            {room}; fetch or export it anew"
        );
    }
    bytes[PREFIX_LENGTH..length as usize]
        .chunks_exact(RECORD_LENGTH)
        .enumerate()
        .map(|(number, record)| parse_record(record).with_context(|| format!("triangle {number}")))
        .collect()
}

fn is_ascii(bytes: &[u8]) -> bool {
    bytes.trim_ascii_start().get(..5).is_some_and(|word| word.eq_ignore_ascii_case(b"solid"))
}

fn parse_record(record: &[u8]) -> Result<Triangle> {
    let mut values = record[12..48].chunks_exact(4).map(|four| {
        let value = f32::from_le_bytes([four[0], four[1], four[2], four[3]]);
        finite(value)
    });
    let mut triangle = Triangle::default();
    for value in triangle.as_flattened_mut() {
        *value = values.next().context("too short")??;
    }
    Ok(triangle)
}

/// Reads the nine numbers behind every three `vertex`, and skips all other words.
fn parse_ascii(bytes: &[u8]) -> Result<Vec<Triangle>> {
    let mut corners = Vec::new();
    let mut ended = false;
    for (number, line) in bytes.split(|&byte| byte == b'\n').enumerate() {
        let line = String::from_utf8_lossy(line.trim_ascii());
        let mut words = line.split_ascii_whitespace();
        match words.next().map(str::to_ascii_lowercase).as_deref() {
            Some("vertex") => {
                let corner = parse_corner(words).with_context(|| format!("line {}", number + 1))?;
                corners.push(corner);
            }
            Some("endsolid") => ended = true,
            Some("endfacet") if corners.len() % 3 != 0 => {
                bail!("line {}: a facet that is not a triangle", number + 1)
            }
            _ => {}
        }
    }
    if !ended || corners.len() % 3 != 0 {
        bail!("cut off: the ASCII STL ends without endsolid; fetch or export it anew");
    }
    Ok(corners.chunks_exact(3).map(|three| [three[0], three[1], three[2]]).collect())
}

fn parse_corner<'a>(mut words: impl Iterator<Item = &'a str>) -> Result<[f32; 3]> {
    let mut corner = [0.0; 3];
    for value in &mut corner {
        let word = words.next().context("a vertex needs three numbers")?;
        *value = finite(word.parse().with_context(|| format!("\"{word}\" is not a number"))?)?;
    }
    Ok(corner)
}

fn finite(value: f32) -> Result<f32> {
    if !value.is_finite() {
        bail!("a coordinate is infinite or not a number: repair the model");
    }
    Ok(value)
}

fn build(triangles: &[Triangle], smoothing_angle: f32) -> Result<MeshBuffers> {
    let mut positions = Vec::new();
    let mut numbers = HashMap::new();
    let mut indices = Vec::with_capacity(triangles.len() * 3);
    for &corner in triangles.as_flattened() {
        // Adding zero turns -0 into 0, so that both are one position.
        let key = corner.map(|value| (value + 0.0).to_bits());
        let index = *numbers.entry(key).or_insert_with(|| {
            positions.push(corner);
            positions.len() as u32 - 1
        });
        indices.push(index);
    }
    let count = u32::try_from(indices.len()).context("more triangles than 32-bit indices allow")?;
    let smoothed = split_by_angle(&positions, &indices, smoothing_angle)?;
    Ok(MeshBuffers {
        positions: smoothed.source_of.iter().map(|&source| positions[source as usize]).collect(),
        normals: smoothed.normals,
        indices: smoothed.indices,
        submesh_index_counts: vec![count],
        ..MeshBuffers::default()
    })
}

fn binary(mesh: &MeshBuffers) -> Result<Vec<u8>> {
    let triangles = mesh.indices.as_chunks::<3>().0;
    let count = u32::try_from(triangles.len()).context("more triangles than STL can count")?;
    let mut bytes = vec![0; HEADER_LENGTH];
    bytes[..7].copy_from_slice(b"chamfer");
    bytes.extend(count.to_le_bytes());
    for triangle in triangles {
        let corners = triangle.map(|index| mesh.positions[index as usize]);
        for value in [face_normal(corners)].iter().chain(&corners).flatten() {
            bytes.extend(value.to_le_bytes());
        }
        bytes.extend([0, 0]);
    }
    Ok(bytes)
}

/// Zero for a triangle without area, as the format has it.
fn face_normal([a, b, c]: Triangle) -> [f32; 3] {
    let side = |to: [f32; 3]| [0, 1, 2].map(|axis| f64::from(to[axis]) - f64::from(a[axis]));
    let (u, v) = (side(b), side(c));
    let cross = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    let length = cross.iter().map(|value| value * value).sum::<f64>().sqrt();
    if length > 0.0 { cross.map(|value| (value / length) as f32) } else { [0.0; 3] }
}

#[cfg(test)]
mod tests {
    use super::*;

    const A: [f32; 3] = [0.0, 0.0, 0.0];
    const B: [f32; 3] = [1.0, 0.0, 0.0];
    const C: [f32; 3] = [0.0, 1.0, 0.0];
    const D: [f32; 3] = [0.0, 0.0, 1.0];

    const ASCII: &str = "solid two words\r
      facet normal 0 0 1\r
        outer loop\r
          vertex 0 0 0\r
          vertex 1e0 -0.0 0\r
          vertex 0 1.0 0\r
        endloop\r
      endfacet\r
    endsolid\r\n";

    fn mesh_of(triangles: &[Triangle]) -> MeshBuffers {
        build(triangles, 30.0).unwrap()
    }

    #[test]
    fn ascii_is_read() {
        assert_eq!(parse(ASCII.as_bytes()).unwrap(), [[A, B, C]]);
    }

    #[test]
    fn what_is_written_is_read_again() {
        let triangles = [[A, B, C], [A, D, B]];
        assert_eq!(parse(&binary(&mesh_of(&triangles)).unwrap()).unwrap(), triangles);
    }

    #[test]
    fn a_binary_file_may_begin_with_solid() {
        let mut bytes = binary(&mesh_of(&[[A, B, C]])).unwrap();
        bytes[..12].copy_from_slice(b"solid cube\nf");
        assert_eq!(parse(&bytes).unwrap(), [[A, B, C]]);
    }

    #[test]
    fn corners_at_one_position_become_one_vertex() {
        let minus_zero = [-0.0, 0.0, 0.0];
        let mesh = mesh_of(&[[A, B, C], [minus_zero, C, B]]);
        let distinct: std::collections::BTreeSet<_> =
            mesh.positions.iter().map(|p| p.map(f32::to_bits)).collect();
        assert_eq!(distinct.len(), 3);
        assert_eq!(mesh.submesh_index_counts, [6]);
    }

    #[test]
    fn broken_files_say_what_is_wrong() {
        let error = |bytes: &[u8]| format!("{:#}", parse(bytes).unwrap_err());
        let mut bytes = binary(&mesh_of(&[[A, B, C]])).unwrap();
        assert!(error(&bytes[..100]).contains("announces 1 triangles, the file holds 0"));
        assert!(error(&[]).contains("0 bytes"));
        assert!(error(&ASCII.as_bytes()[..120]).contains("cut off"));
        assert!(error(ASCII.replace("1.0", "one").as_bytes()).contains("line 6: \"one\""));
        assert!(error(ASCII.replace("1.0", "nan").as_bytes()).contains("not a number"));
        bytes[HEADER_LENGTH..PREFIX_LENGTH].copy_from_slice(&u32::MAX.to_le_bytes());
        assert!(error(&bytes).contains("announces 4294967295 triangles"));
    }

    #[test]
    fn face_normals_follow_the_winding() {
        assert_eq!(face_normal([A, B, C]), [0.0, 0.0, 1.0]);
        assert_eq!(face_normal([A, A, C]), [0.0; 3]);
    }
}
