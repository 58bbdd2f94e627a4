//! What the C# layer makes of models is what the command line makes of them.

use std::fs;
use std::path::{Path, PathBuf};

use chamfer::{MeshBuffers, Options, Width, chamfer, shapes};
use chamfer_formats::gltf_file::GltfDocument;
use chamfer_formats::{Document, ReadOptions, encode};
use serde_json::Value;

use crate::glb::{Glb, with_everything};
use crate::mono::{self, Program};
use crate::raw_mesh::Numbers;

const CORPUS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../shared/corpus");

/// A skin, morph targets, tangents, two UV sets and colours are all in the first; the others have
/// more edges with a skin, and with morph targets.
const MODELS: [&str; 3] =
    ["blenderio_24_animation_pointer.glb", "qmech_George.glb", "khr_AnimatedMorphSphere.glb"];
const PERCENT: f32 = 1.0;

/// What deforms a mesh, in the layout of Unity.
#[derive(Default)]
struct Deformation {
    bones_per_vertex: Vec<u32>,
    bones: Vec<u32>,
    weights: Vec<f32>,
    /// For each target, what it adds to positions, normals and tangents.
    targets: Vec<[Vec<f32>; 3]>,
}

impl Deformation {
    fn of(glb: &Glb, mesh: usize) -> Deformation {
        let primitive = glb.primitive(mesh);
        let mut deformation = Deformation::default();
        let joints = glb.attribute(&primitive["attributes"], "JOINTS_0");
        let weights = glb.attribute(&primitive["attributes"], "WEIGHTS_0");
        for (joints, weights) in joints.chunks_exact(4).zip(weights.chunks_exact(4)) {
            deformation.push_bones(influences(joints, weights));
        }
        for target in primitive["targets"].as_array().into_iter().flatten() {
            let names = ["POSITION", "NORMAL", "TANGENT"];
            deformation.targets.push(names.map(|name| glb.attribute(target, name)));
        }
        deformation
    }

    fn push_bones(&mut self, influences: Vec<(u32, f32)>) {
        self.bones_per_vertex.push(influences.len() as u32);
        self.bones.extend(influences.iter().map(|(bone, _)| bone));
        self.weights.extend(influences.iter().map(|(_, weight)| weight));
    }

    fn write(&self, file: &mut Numbers) {
        file.integers(&self.bones_per_vertex);
        file.integers(&self.bones);
        file.floats(&self.weights);
        file.number(self.targets.len());
        self.targets.iter().flatten().for_each(|stream| file.floats(stream));
    }
}

/// The joints that pull, the strongest first, as Unity has them.
fn influences(joints: &[f32], weights: &[f32]) -> Vec<(u32, f32)> {
    let pairs = joints.iter().zip(weights).filter(|(_, weight)| **weight > 0.0);
    let mut pairs: Vec<(u32, f32)> =
        pairs.map(|(joint, weight)| (*joint as u32, *weight)).collect();
    pairs.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0)));
    pairs
}

/// A model before and after the command line.
struct Model {
    name: String,
    before: Glb,
    after: Glb,
    /// `#meshes`, as the command line read them.
    meshes: Vec<MeshBuffers>,
}

impl Model {
    fn new(path: &Path) -> Model {
        let document = GltfDocument::read(path, &ReadOptions::default()).unwrap();
        let meshes: Vec<_> = document.meshes().iter().map(|mesh| mesh.mesh.clone()).collect();
        let options = Options::default().with_width(Width::PercentOfExtent(PERCENT));
        let chamfered: Vec<_> =
            meshes.iter().map(|mesh| chamfer(&mesh.as_mesh(), &options).unwrap()).collect();
        let files = encode(&document, Path::new("after.glb"), &chamfered).unwrap().files;
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        let before = Glb::parse(&fs::read(path).unwrap());
        assert_eq!(before.mesh_count(), meshes.len(), "{name}");
        Model { name, before, after: Glb::parse(&files[0].bytes), meshes }
    }

    /// Every mesh as C# makes it.
    fn through_c_sharp(&self, program: &Program) -> Vec<Vec<Stream>> {
        let mut file = Numbers::default();
        file.number(self.meshes.len());
        for (index, mesh) in self.meshes.iter().enumerate() {
            file.mesh(mesh);
            Deformation::of(&self.before, index).write(&mut file);
        }
        let [source, result] = ["before", "after"].map(|when| temporary(&self.name, when));
        fs::write(&source, file.bytes).unwrap();
        let [source, result_name] = [&source, &result].map(|path| path.to_str().unwrap());
        program.run(&["carry", source, result_name, &PERCENT.to_string()]);
        let bytes = fs::read(&result).unwrap();
        let mut reader = Reader { rest: &bytes };
        self.meshes.iter().map(|_| reader.corners()).collect()
    }
}

fn temporary(name: &str, when: &str) -> PathBuf {
    Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{name}.{when}.numbers"))
}

/// A value at each corner of each triangle: what is drawn, whatever the order of the vertices.
#[derive(PartialEq)]
struct Stream {
    name: String,
    /// `#corners by width`, flattened, as bits.
    corners: Vec<u32>,
}

fn at_corners(name: &str, values: &[f32], indices: &[u32], vertices: usize) -> Option<Stream> {
    let width = values.len() / vertices.max(1);
    let row = |index: &u32| values[*index as usize * width..][..width].iter();
    let corners = indices.iter().flat_map(row).map(|value| (value + 0.0).to_bits()).collect();
    (width > 0).then(|| Stream { name: name.to_owned(), corners })
}

/// The numbers that C# wrote: of each mesh the indices, and then named streams.
struct Reader<'a> {
    rest: &'a [u8],
}

impl Reader<'_> {
    fn number(&mut self) -> u32 {
        let (word, rest) = self.rest.split_first_chunk().unwrap();
        self.rest = rest;
        u32::from_le_bytes(*word)
    }

    fn numbers(&mut self) -> Vec<u32> {
        (0..self.number()).map(|_| self.number()).collect()
    }

    fn floats(&mut self) -> Vec<f32> {
        self.numbers().into_iter().map(f32::from_bits).collect()
    }

    fn corners(&mut self) -> Vec<Stream> {
        let vertices = self.number() as usize;
        let indices = self.numbers();
        let mut streams = Vec::new();
        for name in ["POSITION", "NORMAL", "TANGENT", "COLOR_0", "TEXCOORD_0", "TEXCOORD_1"] {
            streams.extend(at_corners(name, &self.floats(), &indices, vertices));
        }
        streams.extend(self.bones(&indices));
        for target in 0..self.number() {
            for name in ["POSITION", "NORMAL", "TANGENT"] {
                let name = format!("{target} {name}");
                streams.extend(at_corners(&name, &self.floats(), &indices, vertices));
            }
        }
        streams
    }

    fn bones(&mut self, indices: &[u32]) -> Option<Stream> {
        let [counts, bones] = [self.numbers(), self.numbers()];
        let weights = self.floats();
        let mut first = 0;
        let rows: Vec<_> = counts
            .iter()
            .map(|count| {
                let range = first..first + *count as usize;
                first = range.end;
                bones[range.clone()].iter().copied().zip(weights[range].iter().copied()).collect()
            })
            .collect();
        bone_stream(&rows, indices)
    }
}

fn bone_stream(rows: &[Vec<(u32, f32)>], indices: &[u32]) -> Option<Stream> {
    let row = |index: &u32| rows[*index as usize].iter();
    let corners = indices.iter().flat_map(row).flat_map(|(bone, weight)| [*bone, weight.to_bits()]);
    (!rows.is_empty()).then(|| Stream { name: "BONES".to_owned(), corners: corners.collect() })
}

/// What the command line wrote for a mesh.
fn written(glb: &Glb, mesh: usize) -> Vec<Stream> {
    let primitive = glb.primitive(mesh);
    let attributes = &primitive["attributes"];
    let positions = glb.attribute(attributes, "POSITION").len() / 3;
    let indices = glb.numbers(primitive["indices"].as_u64().unwrap() as usize);
    let indices: Vec<u32> = indices.into_iter().map(|index| index as u32).collect();
    let stream = |from: &Value, name: &str, shown: &str| {
        at_corners(shown, &glb.attribute(from, name), &indices, positions)
    };
    let mut streams = Vec::new();
    for name in ["POSITION", "NORMAL", "TANGENT", "COLOR_0", "TEXCOORD_0", "TEXCOORD_1"] {
        streams.extend(stream(attributes, name, name));
    }
    let joints = glb.attribute(attributes, "JOINTS_0");
    let weights = glb.attribute(attributes, "WEIGHTS_0");
    let rows = joints.chunks_exact(4).zip(weights.chunks_exact(4));
    streams.extend(bone_stream(&rows.map(|(j, w)| influences(j, w)).collect::<Vec<_>>(), &indices));
    for (number, target) in primitive["targets"].as_array().into_iter().flatten().enumerate() {
        for name in ["POSITION", "NORMAL", "TANGENT"] {
            // Unity has all three, and zeros where a file has none.
            let shown = format!("{number} {name}");
            let none = || at_corners(&shown, &vec![0.0; 3 * positions], &indices, positions);
            streams.extend(stream(target, name, &shown).or_else(none));
        }
    }
    streams
}

/// Compares a model's meshes stream by stream; returns the names of what was compared.
fn compare(path: &Path, program: &Program) -> Vec<String> {
    let model = Model::new(path);
    let mut names = Vec::new();
    for (mesh, streams) in model.through_c_sharp(program).into_iter().enumerate() {
        let expected = written(&model.after, mesh);
        let of = |streams: &[Stream]| -> Vec<String> {
            streams.iter().map(|stream| stream.name.clone()).collect()
        };
        assert_eq!(of(&streams), of(&expected), "{} mesh {mesh}", model.name);
        for (stream, expected) in streams.iter().zip(&expected) {
            let pairs = stream.corners.iter().zip(&expected.corners);
            let other = pairs.filter(|(a, b)| a != b).count();
            let equal = other == 0 && stream.corners.len() == expected.corners.len();
            assert!(equal, "{} mesh {mesh}: {other} numbers of {}", model.name, stream.name);
        }
        names.extend(of(&streams));
    }
    names
}

#[test]
fn models_come_out_as_from_the_command_line() {
    let Some(program) = mono::program() else { return };
    let mut names = Vec::new();
    for model in MODELS {
        let path = Path::new(CORPUS).join(model);
        if !path.is_file() {
            mono::skip(&format!("no {}, so no real model went through C#", path.display()));
            return;
        }
        names.extend(compare(&path, program));
    }
    for name in ["TANGENT", "COLOR_0", "TEXCOORD_1", "BONES", "1 POSITION"] {
        assert!(names.iter().any(|known| known == name), "no model has {name}");
    }
}

/// No real model has all of it on one mesh with hard edges.
#[test]
fn a_mesh_with_every_stream_comes_out_as_from_the_command_line() {
    let Some(program) = mono::program() else { return };
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join("everything.glb");
    fs::write(&path, with_everything(&shapes::extruding_cubes())).unwrap();
    let names = compare(&path, program);
    assert_eq!(names.len(), 10, "{names:?}");
}
