//! Morph targets and skins of real models, played on the chamfered mesh.

use std::collections::HashSet;
use std::fs;
use std::path::Path;

use chamfer::{Options, Width, chamfer};
use chamfer_formats::{Document, encode};
use glam::DVec3;
use serde_json::Value;

use crate::support::{json_of, path_in, read};

const CORPUS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../shared/corpus");

/// What a morph target turns over.
struct Flips {
    /// `#triangles`.
    flipped: Vec<bool>,
    /// `#triangles`: whether the target turns the normals of its corners more than 90 degrees apart,
    /// so that nothing between them can face along all.
    torn: Vec<bool>,
    /// `#triangles`: where the corners stand without the target.
    places: Vec<[[u64; 3]; 3]>,
}

impl Flips {
    /// How many of the first triangles are flipped.
    fn count(&self, first: usize) -> usize {
        self.flipped[..first].iter().filter(|flipped| **flipped).count()
    }

    /// How many chamfers are flipped but not torn, and touch no face that the target flips in the
    /// source. Such a face may be narrowed so far that it no longer flips; the chamfers around it
    /// then do.
    fn alone(&self, source: &Flips) -> usize {
        let faces = source.flipped.iter().zip(&self.places);
        let touched: HashSet<[u64; 3]> =
            faces.filter(|(flipped, _)| **flipped).flat_map(|(_, at)| *at).collect();
        let is_alone = |at: &[[u64; 3]; 3]| !at.iter().any(|place| touched.contains(place));
        let chamfers = source.flipped.len()..self.flipped.len();
        let flipped = chamfers.filter(|&chamfer| self.flipped[chamfer] && !self.torn[chamfer]);
        flipped.filter(|&chamfer| is_alone(&self.places[chamfer])).count()
    }
}

/// A binary glTF that holds all its data.
struct Glb {
    json: Value,
    bytes: Vec<u8>,
}

impl Glb {
    fn new(file: &[u8]) -> Glb {
        let length = u32::from_le_bytes(file[12..16].try_into().unwrap()) as usize;
        let bytes = file.get(28 + length..).unwrap_or_default().to_vec();
        Glb { json: json_of(file), bytes }
    }

    fn number(value: &Value) -> usize {
        value.as_u64().unwrap_or(0) as usize
    }

    /// The rows of an accessor, sparse or not.
    fn rows(&self, accessor: usize) -> Vec<Vec<f64>> {
        let accessor = &self.json["accessors"][accessor];
        let width = match accessor["type"].as_str() {
            Some("SCALAR") => 1,
            Some("VEC2") => 2,
            Some("VEC3") => 3,
            _ => 4,
        };
        let count = Self::number(&accessor["count"]);
        let mut rows = vec![vec![0.0; width]; count];
        if !accessor["bufferView"].is_null() {
            rows = self.read(accessor, &accessor["componentType"], count, width);
        }
        let sparse = &accessor["sparse"];
        if !sparse.is_null() {
            let changed = Self::number(&sparse["count"]);
            let kind = &sparse["indices"]["componentType"];
            let places = self.read(&sparse["indices"], kind, changed, 1);
            let values = self.read(&sparse["values"], &accessor["componentType"], changed, width);
            places.iter().zip(values).for_each(|(place, row)| rows[place[0] as usize] = row);
        }
        rows
    }

    fn read(&self, at: &Value, kind: &Value, count: usize, width: usize) -> Vec<Vec<f64>> {
        let view = &self.json["bufferViews"][Self::number(&at["bufferView"])];
        let first = Self::number(&view["byteOffset"]) + Self::number(&at["byteOffset"]);
        let kind = Self::number(kind);
        let size = match kind {
            5120 | 5121 => 1,
            5122 | 5123 => 2,
            _ => 4,
        };
        let stride = Self::number(&view["byteStride"]).max(if view["byteStride"].is_null() {
            size * width
        } else {
            0
        });
        let value = |place: usize| {
            let bytes = &self.bytes[place..place + size];
            match kind {
                5121 => f64::from(bytes[0]),
                5123 => f64::from(u16::from_le_bytes(bytes.try_into().unwrap())),
                5125 => f64::from(u32::from_le_bytes(bytes.try_into().unwrap())),
                5126 => f64::from(f32::from_le_bytes(bytes.try_into().unwrap())),
                _ => panic!("component type {kind}"),
            }
        };
        let row = |row: usize| (0..width).map(move |k| first + row * stride + k * size);
        (0..count).map(|at| row(at).map(value).collect()).collect()
    }

    fn vectors(&self, accessor: &Value) -> Vec<DVec3> {
        let rows = self.rows(Self::number(accessor));
        rows.iter().map(|row| DVec3::new(row[0], row[1], row[2])).collect()
    }

    fn primitives(&self) -> impl Iterator<Item = &Value> {
        let meshes = self.json["meshes"].as_array().into_iter().flatten();
        meshes.flat_map(|mesh| mesh["primitives"].as_array().into_iter().flatten())
    }

    /// For each primitive with targets, and each target, whether each triangle faces away from its
    /// normals with the target at weight 1, though it does not without.
    fn flips(&self) -> Vec<Flips> {
        let mut flips = Vec::new();
        for primitive in self.primitives().filter(|primitive| !primitive["targets"].is_null()) {
            let attributes = &primitive["attributes"];
            if attributes["NORMAL"].is_null() || primitive["indices"].is_null() {
                continue;
            }
            let positions = self.vectors(&attributes["POSITION"]);
            let normals = self.vectors(&attributes["NORMAL"]);
            let indices = self.rows(Self::number(&primitive["indices"]));
            for target in primitive["targets"].as_array().into_iter().flatten() {
                let moved = self.added(&positions, &target["POSITION"]);
                let turned = self.added(&normals, &target["NORMAL"]);
                let is_new = |t: &[Vec<f64>]| {
                    is_flipped(t, &moved, &turned) && !is_flipped(t, &positions, &normals)
                };
                let places = indices.chunks_exact(3).map(|triangle| {
                    [0, 1, 2]
                        .map(|k| positions[triangle[k][0] as usize].to_array().map(f64::to_bits))
                });
                let flipped = indices.chunks_exact(3).map(is_new).collect();
                let torn = indices.chunks_exact(3).map(|t| is_torn(t, &turned)).collect();
                flips.push(Flips { flipped, torn, places: places.collect() });
            }
        }
        flips
    }

    fn added(&self, base: &[DVec3], accessor: &Value) -> Vec<DVec3> {
        if accessor.is_null() {
            return base.to_vec();
        }
        base.iter().zip(self.vectors(accessor)).map(|(base, delta)| *base + delta).collect()
    }
}

fn is_flipped(triangle: &[Vec<f64>], positions: &[DVec3], normals: &[DVec3]) -> bool {
    let at = [0, 1, 2].map(|k| triangle[k][0] as usize);
    let [a, b, c] = at.map(|v| positions[v]);
    let normal: DVec3 = at.iter().map(|&v| normals[v]).sum();
    (b - a).cross(c - a).dot(normal) < 0.0
}

fn is_torn(triangle: &[Vec<f64>], normals: &[DVec3]) -> bool {
    let [a, b, c] = [0, 1, 2].map(|k| normals[triangle[k][0] as usize]);
    a.dot(b).min(b.dot(c)).min(c.dot(a)) < 0.0
}

/// The file before, and after chamfering all its meshes by a percentage of their extents.
fn before_and_after(name: &str, percent: f32) -> Option<[Glb; 2]> {
    let path = Path::new(CORPUS).join(name);
    let before = fs::read(&path).ok()?;
    let document = read(&path).unwrap();
    let options = Options::default().with_width(Width::PercentOfExtent(percent));
    let meshes = document.meshes().iter();
    let chamfered: Vec<_> =
        meshes.map(|mesh| chamfer(&mesh.mesh.as_mesh(), &options).unwrap()).collect();
    let output = path_in("played").join(name);
    let files = encode(&document, &output, &chamfered).unwrap().files;
    Some([Glb::new(&before), Glb::new(&files[0].bytes)])
}

/// A target that turns faces of the source over turns over the chamfers between them, and may tear
/// others. The second target of the last model crumples a cube: it flips 358 of its faces. The
/// chamfers that are left there stand where one folds an edge back until a strip lies on the face
/// beside it, at about 160 degrees: what has both for neighbours cannot face as both do.
#[test]
fn a_morph_target_at_full_weight_flips_nothing_away_from_what_the_source_flips() {
    for (name, most_alone) in [
        ("khr_AnimatedMorphCube.glb", [0, 0]),
        ("khr_AnimatedMorphSphere.glb", [0, 1]),
        ("blenderio_24_animation_pointer.glb", [2, 1]),
    ] {
        for (percent, most_alone) in [0.5, 2.0].into_iter().zip(most_alone) {
            let Some([before, after]) = before_and_after(name, percent) else { continue };
            let [source, result] = [before.flips(), after.flips()];
            assert!(!source.is_empty() && source.len() == result.len(), "{name}");
            for (source, result) in source.iter().zip(&result) {
                let faces = source.flipped.len();
                let [was, is] = [source.count(faces), result.count(faces)];
                assert!(is <= was, "{name} at {percent} %: {is} faces, {was} before");
                let alone = result.alone(source);
                assert!(alone <= most_alone, "{name} at {percent} %: {alone} away from those");
            }
        }
    }
}

#[test]
fn skin_weights_add_up_to_one() {
    let Some([_, after]) = before_and_after("qmech_George.glb", 0.5) else { return };
    let mut rows = 0;
    for primitive in after.primitives() {
        let weights = &primitive["attributes"]["WEIGHTS_0"];
        if weights.is_null() || !primitive["attributes"]["WEIGHTS_1"].is_null() {
            continue;
        }
        let accessor = Glb::number(weights);
        let one = match Glb::number(&after.json["accessors"][accessor]["componentType"]) {
            5121 => 255.0,
            5123 => 65535.0,
            _ => 1.0,
        };
        for row in after.rows(accessor) {
            rows += 1;
            assert!((row.iter().sum::<f64>() / one - 1.0).abs() < 1e-5, "{row:?}");
        }
    }
    assert!(rows > 0);
}
