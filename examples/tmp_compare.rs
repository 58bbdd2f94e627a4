#![allow(missing_docs, dead_code)]
#[path = "/tmp/chk/ref/see_through/mod.rs"]
mod old;
use chamfer::see_through::{Eyes, SceneTriangle, leaks};
use chamfer::{MeshBuffers, Options, Verify, Width, chamfer};
use chamfer_cli::document::{Instance, ReadOptions};
use chamfer_cli::format;
use glam::{Mat4, Vec3};
use std::path::{Path, PathBuf};
use std::time::Instant;
fn add(scene: &mut Vec<SceneTriangle>, mesh: &MeshBuffers, instance: &Instance) {
    let transform = Mat4::from_cols_array_2d(&instance.transform);
    let mirrors = transform.determinant() < 0.0;
    let place = |index: u32| {
        transform.transform_point3(Vec3::from(mesh.positions[index as usize])).to_array()
    };
    for t in mesh.indices.chunks_exact(3) {
        let [a, b, c] = [t[0], t[1], t[2]].map(place);
        scene.push(if mirrors { [a, c, b] } else { [a, b, c] });
    }
}
fn main() {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let percent: f32 = args[0].parse().unwrap();
    let mut paths: Vec<PathBuf> = std::fs::read_dir(Path::new("/work/shared/corpus"))
        .unwrap()
        .flatten()
        .map(|e| e.path())
        .collect();
    paths.sort();
    let (mut told, mut tnew) = (0.0, 0.0);
    for path in paths {
        if args.len() > 1 && !path.to_string_lossy().contains(&args[1]) {
            continue;
        }
        let Ok(document) = format::read(&path, &ReadOptions { smoothing_angle: 30.0 }) else {
            continue;
        };
        let options = Options {
            width: Width::PercentOfExtent(percent),
            verify: Verify::Fast,
            ..Options::default()
        };
        let chamfered: Vec<_> = document
            .meshes()
            .iter()
            .map(|m| chamfer(&m.mesh.as_mesh(), &options).unwrap())
            .collect();
        let mut width = 0.0_f32;
        let (mut before, mut after) = (vec![], vec![]);
        for i in document.instances() {
            add(&mut before, &document.meshes()[i.mesh].mesh, &i);
            add(&mut after, &chamfered[i.mesh].mesh, &i);
            let t = Mat4::from_cols_array_2d(&i.transform);
            width = width.max(chamfered[i.mesh].width * t.transform_vector3(Vec3::X).length());
        }
        let s = Instant::now();
        let new = leaks(&before, &after, width, Eyes::default());
        let tn = s.elapsed().as_secs_f64() * 1e3;
        let s = Instant::now();
        let old = old::leaks(&before, &after, width, old::Eyes::default());
        let to = s.elapsed().as_secs_f64() * 1e3;
        told += to;
        tnew += tn;
        let sum = |l: Vec<usize>| (l.len(), l.iter().sum::<usize>());
        let (a, b) = (
            sum(old.iter().map(|l| l.places.len()).collect()),
            sum(new.iter().map(|l| l.places.len()).collect()),
        );
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        println!(
            "{name:40} {:7} -> {:7} tri  old {to:6.0} ms new {tn:6.1} ms x{:.1}  {a:?} {b:?} {}",
            before.len(),
            after.len(),
            to / tn,
            if a == b { "" } else { "DIFFERS" }
        );
    }
    println!("sum old {told:.0} new {tnew:.0}");
}
