//! Writes the seeds that every run starts from, a folder for each target: noise of several lengths,
//! which the targets make their meshes and files of, and files as bytes.

use std::path::Path;
use std::{env, fs, io};

use chamfer_fuzz::gltf::{rich_binary, rich_json, wrap_in_chunks, wrap_in_json};
use chamfer_fuzz::noise::Noise;

const TARGETS: [&str; 4] = ["core", "abi", "gltf", "obj_stl"];

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
    fs::write(gltf.join("file.gltf"), wrap_in_json(rich_json(), &rich_binary()))
}
