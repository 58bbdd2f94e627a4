//! `chamfer check` on what a file has beside geometry: skins, morph targets, bones, materials, nodes.
//! Faults are planted in the command's own results, and each is found.

#[path = "support/run.rs"]
#[allow(dead_code)] // Others use more of it.
mod run;

use std::fs;
use std::path::PathBuf;
use std::process::Command;

use chamfer::shapes;
use chamfer_formats::glb;
use serde_json::{Value, json};
use tempfile::TempDir;

use run::Run;

/// A .glb taken apart.
struct Glb {
    json: Value,
    binary: Vec<u8>,
}

impl Glb {
    fn parse(bytes: &[u8]) -> Glb {
        let length = u32::from_le_bytes(bytes[12..16].try_into().unwrap()) as usize;
        let json = serde_json::from_slice(&bytes[20..20 + length]).unwrap();
        Glb { json, binary: bytes[28 + length..].to_vec() }
    }

    fn bytes(&self) -> Vec<u8> {
        let mut text = serde_json::to_vec(&self.json).unwrap();
        text.resize(text.len().next_multiple_of(4), b' ');
        let size = |bytes: usize| (bytes as u32).to_le_bytes();
        let whole = 28 + text.len() + self.binary.len();
        let chunk = |kind: &[u8; 4], data: &[u8]| [&size(data.len()), &kind[..], data].concat();
        let head = [b"glTF", &size(2)[..], &size(whole)].concat();
        [head, chunk(b"JSON", &text), chunk(b"BIN\0", &self.binary)].concat()
    }

    /// Adds an accessor of rows of numbers.
    fn add(&mut self, rows: &[Vec<f32>], shape: &str, component: u32) -> usize {
        let start = self.binary.len();
        for number in rows.iter().flatten() {
            match component {
                5126 => self.binary.extend(number.to_le_bytes()),
                _ => self.binary.push(*number as u8),
            }
        }
        let length = self.binary.len() - start;
        self.json["buffers"][0]["byteLength"] = self.binary.len().into();
        let views = self.json["bufferViews"].as_array_mut().unwrap();
        views.push(json!({"buffer": 0, "byteOffset": start, "byteLength": length}));
        let view = views.len() - 1;
        let accessors = self.json["accessors"].as_array_mut().unwrap();
        accessors.push(json!({
            "bufferView": view, "componentType": component, "count": rows.len(), "type": shape,
        }));
        accessors.len() - 1
    }

    /// Where the data of an accessor stands.
    fn data(&mut self, accessor: &Value) -> &mut [u8] {
        let accessor = &self.json["accessors"][accessor.as_u64().unwrap() as usize];
        let view = &self.json["bufferViews"][accessor["bufferView"].as_u64().unwrap() as usize];
        let number = |value: &Value| value.as_u64().unwrap_or(0) as usize;
        let start = number(&view["byteOffset"]) + number(&accessor["byteOffset"]);
        &mut self.binary[start..start + number(&view["byteLength"])]
    }

    /// The accessor of an attribute of the first primitive.
    fn attribute(&self, name: &str) -> Value {
        self.json["meshes"][0]["primitives"][0]["attributes"][name].clone()
    }
}

/// A plain cube of two materials on two bones that pull with the height, with two morph targets that
/// move it by what its places are: all of it is a plane over each face.
fn model() -> Glb {
    let mut cube = shapes::plain_cube(1.0);
    cube.submesh_index_counts = vec![18, 18];
    let mut glb = Glb::parse(&glb::encode("cube", &cube, &[], &[]).unwrap());
    let rows = |of: &dyn Fn([f32; 3]) -> Vec<f32>| -> Vec<Vec<f32>> {
        cube.positions.iter().map(|&at| of(at)).collect()
    };
    let up = |[_, y, _]: [f32; 3]| (y + 1.0) / 3.0;
    let joints = glb.add(&rows(&|_| vec![0.0, 1.0, 0.0, 0.0]), "VEC4", 5121);
    let weights = glb.add(&rows(&|at| vec![up(at), 1.0 - up(at), 0.0, 0.0]), "VEC4", 5126);
    let wide = glb.add(&rows(&|[x, _, _]| vec![x, 0.0, 0.0]), "VEC3", 5126);
    let tall = glb.add(&rows(&|[_, y, z]| vec![0.0, y + z, 0.0]), "VEC3", 5126);
    for (number, primitive) in
        glb.json["meshes"][0]["primitives"].as_array_mut().unwrap().iter_mut().enumerate()
    {
        primitive["attributes"]["JOINTS_0"] = joints.into();
        primitive["attributes"]["WEIGHTS_0"] = weights.into();
        primitive["targets"] = json!([{"POSITION": wide}, {"POSITION": tall}]);
        primitive["material"] = number.into();
    }
    let root = &mut glb.json;
    root["materials"] = json!([{"name": "wood"}, {"name": "steel"}]);
    root["skins"] = json!([{"joints": [1, 2]}]);
    root["nodes"] = json!([
        {"mesh": 0, "skin": 0, "name": "cube"},
        {"name": "hip", "children": [2]},
        {"name": "knee", "translation": [0, 1, 0]},
        {"name": "lamp", "translation": [0, 5, 0]},
    ]);
    root["scenes"][0]["nodes"] = json!([0, 1, 3]);
    glb
}

struct Folder(TempDir);

impl Folder {
    /// With `before.glb` and `after.glb`, which the command made of it.
    fn new() -> Folder {
        let folder = Folder(tempfile::tempdir().unwrap());
        fs::write(folder.path("before.glb"), model().bytes()).unwrap();
        let run = folder.run("before.glb -o after.glb --width 0.05");
        assert_eq!(run.0.status.code(), Some(0), "{}", String::from_utf8_lossy(&run.0.stderr));
        folder
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn run(&self, arguments: &str) -> Run {
        let mut command = Command::new(env!("CARGO_BIN_EXE_chamfer"));
        Run(command.current_dir(self.0.path()).args(arguments.split(' ')).output().unwrap())
    }

    /// The exit code of a check, and what it says.
    fn check(&self, more: &str) -> (i32, String) {
        let run = self.run(&format!("check before.glb after.glb --no-see-through{more}"));
        let text = String::from_utf8_lossy(&run.0.stdout).into_owned();
        (run.0.status.code().unwrap(), text)
    }
}

/// What is said once `plant` has changed the result.
#[track_caller]
fn assert_found(words: &str, plant: impl FnOnce(&mut Glb)) {
    let folder = Folder::new();
    let mut after = Glb::parse(&fs::read(folder.path("after.glb")).unwrap());
    plant(&mut after);
    fs::write(folder.path("after.glb"), after.bytes()).unwrap();
    let (code, text) = folder.check("");
    assert!(code == 1 && text.contains(words), "{code}: {text}");
}

#[test]
fn what_the_command_makes_is_sound() {
    let folder = Folder::new();
    for more in ["", " --width 0.05"] {
        let (code, text) = folder.check(more);
        // Only that nobody looks for light is named.
        assert!(code == 3 && text.matches("not fully checked").count() == 1, "{code}: {text}");
    }
}

#[test]
fn weights_of_two_vertices_are_swapped() {
    assert_found("skin changed", |after| {
        let weights = after.attribute("WEIGHTS_0");
        let (rows, _) = after.data(&weights).as_chunks_mut::<16>();
        let other = (1..rows.len()).find(|&row| rows[row] != rows[0]).unwrap();
        rows.swap(0, other);
    });
}

#[test]
fn joints_are_renumbered() {
    assert_found("skin changed", |after| after.json["skins"][0]["joints"] = json!([2, 1]));
}

#[test]
fn a_skin_is_gone() {
    assert_found("skin changed", |after| {
        for primitive in after.json["meshes"][0]["primitives"].as_array_mut().unwrap() {
            let attributes = primitive["attributes"].as_object_mut().unwrap();
            attributes.remove("JOINTS_0");
            attributes.remove("WEIGHTS_0");
        }
    });
}

#[test]
fn a_morph_target_is_zeroed() {
    for target in [0, 1] {
        assert_found("morph target changed", |after| {
            let morph = after.json["meshes"][0]["primitives"][0]["targets"][target].clone();
            after.data(&morph["POSITION"]).fill(0);
        });
    }
}

#[test]
fn two_morph_targets_are_exchanged() {
    assert_found("morph target changed", |after| {
        for primitive in after.json["meshes"][0]["primitives"].as_array_mut().unwrap() {
            primitive["targets"].as_array_mut().unwrap().reverse();
        }
    });
}

#[test]
fn materials_are_exchanged() {
    assert_found("material changed", |after| {
        after.json["materials"].as_array_mut().unwrap().reverse();
    });
}

#[test]
fn a_bone_or_a_lamp_is_moved() {
    for (node, name) in [(2, "knee"), (3, "lamp")] {
        assert_found(&format!("node {name}: placed otherwise"), |after| {
            after.json["nodes"][node]["translation"] = json!([0.0, 1.5, 0.0]);
        });
    }
}

#[test]
fn a_chamfer_is_twice_as_wide_as_asked() {
    let folder = Folder::new();
    folder.run("before.glb -o after.glb --width 0.1");
    let (code, text) = folder.check(" --width 0.05");
    assert!(code == 1 && text.contains("chamfer wider than asked: 12"), "{code}: {text}");
}

// What only one of the two formats can tell is named.
#[test]
fn a_skin_that_the_other_format_has_not_is_not_checked() {
    let folder = Folder::new();
    folder.run("before.glb -o after.obj --width 0.05");
    let made = folder.path("after.obj").exists();
    let text = match made {
        true => folder.run("check before.glb after.obj --no-see-through").0.stdout,
        // This pair of formats is not written: the geometry alone, as another tool would.
        false => {
            let (mut text, cube) = (String::new(), shapes::plain_cube(1.0));
            for [x, y, z] in &cube.positions {
                text += &format!("v {x} {y} {z}\n");
            }
            for [a, b, c] in cube.indices.as_chunks::<3>().0 {
                text += &format!("f {} {} {}\n", a + 1, b + 1, c + 1);
            }
            fs::write(folder.path("after.obj"), text).unwrap();
            folder.run("check before.glb after.obj --no-see-through").0.stdout
        }
    };
    let text = String::from_utf8_lossy(&text);
    for rule in ["skin changed", "morph target changed"] {
        let line = format!("not fully checked: {rule}: only one of the two files tells of it");
        assert!(text.contains(&line), "{text}");
    }
}
