//! dbg
use chamfer_cli::{document::ReadOptions, format};
fn main() {
    let a: Vec<String> = std::env::args().collect();
    let d =
        format::read(std::path::Path::new(&a[1]), &ReadOptions { smoothing_angle: 30.0 }).unwrap();
    let m = &d.meshes().iter().find(|m| m.name == a[2]).unwrap().mesh;
    let p = m.positions[a[3].parse::<usize>().unwrap()];
    for (t, tri) in m.indices.chunks(3).enumerate() {
        let q: Vec<_> = tri.iter().map(|&i| m.positions[i as usize]).collect();
        if q.contains(&p) {
            let v: Vec<glam::DVec3> = q.iter().map(|p| glam::Vec3::from(*p).as_dvec3()).collect();
            println!("tri {t} {tri:?} {:?} area {:?}", q, (v[1] - v[0]).cross(v[2] - v[0]));
            for &i in tri {
                print!(" n{:?}", m.normals[i as usize]);
            }
            println!();
        }
    }
}
