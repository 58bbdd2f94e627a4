//! Writes the seeds that every run starts from, a folder for each target: noise of several lengths,
//! which the targets make their meshes and files of, and files as bytes.

#[path = "../../../formats/tests/support/draco.rs"]
mod draco;

use std::path::Path;
use std::{env, fs, io};

use chamfer::shapes;
use chamfer_fuzz::compressed::HEAD;
use chamfer_fuzz::cube_fbx::cube_fbx;
use chamfer_fuzz::gltf::{rich_binary, rich_json, wrap_in_chunks, wrap_in_json};
use chamfer_fuzz::noise::Noise;
use draco::draco_bytes;

const TARGETS: [&str; 9] =
    ["core", "abi", "gltf", "obj_stl", "compressed", "fbx", "ply_off", "alike", "planted"];

/// From a few values to more than the largest shapes take.
const LENGTHS: [usize; 5] = [64, 200, 600, 1500, 4000];

const NOISES: u64 = 8;

fn main() -> io::Result<()> {
    let folder = env::args_os().nth(1).unwrap_or("corpus".into());
    for target in TARGETS {
        let folder = Path::new(&folder).join(target);
        fs::create_dir_all(&folder)?;
        for length in LENGTHS {
            for seed in 0..NOISES {
                let mut noise = Noise::new(seed + 1);
                let bytes: Vec<u8> = (0..length).map(|_| noise.bits() as u8).collect();
                fs::write(folder.join(format!("noise-{length}-{seed}")), bytes)?;
            }
        }
    }
    // The first byte of a target's input decides what the rest is taken for.
    let gltf = Path::new(&folder).join("gltf");
    fs::write(gltf.join("file.glb"), wrap_in_chunks(&rich_json(), &rich_binary()))?;
    fs::write(gltf.join("file.gltf"), wrap_in_json(rich_json(), &rich_binary()))?;
    for (number, seed) in compressed().into_iter().enumerate() {
        fs::write(Path::new(&folder).join(format!("compressed/packed-{number}")), seed)?;
    }
    fs::write(Path::new(&folder).join("fbx/cube.fbx"), cube_fbx())
}

/// A cube's positions and triangles by meshopt, and all of it by Draco in two ways.
fn compressed() -> Vec<Vec<u8>> {
    let cube = shapes::plain_cube(1.0);
    let [vertices, corners] = [cube.positions.len() as u8, cube.indices.len() as u8];
    let packed = meshopt::encode_vertex_buffer(&cube.positions).expect("it fits");
    let positions = [&[1, 0, 3, 0, vertices, 0], &packed[..]].concat();
    let packed = meshopt::encode_index_buffer(&cube.indices, cube.positions.len());
    let triangles = [&[1, 1, 0, 0, corners, 0], &packed.expect("it fits")[..]].concat();
    let draco = |speed| [&[0; HEAD], &draco_bytes(&cube, speed)[..]].concat();
    vec![positions, triangles, draco(0), draco(10)]
}
