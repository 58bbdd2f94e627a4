//! dbg
use chamfer::*;
use chamfer_cli::{document::ReadOptions, format};
fn main() {
    let a: Vec<String> = std::env::args().collect();
    let d =
        format::read(std::path::Path::new(&a[1]), &ReadOptions { smoothing_angle: 30.0 }).unwrap();
    let m = d.meshes().iter().find(|m| m.name == a[2]).unwrap();
    let r = chamfer::chamfer(
        &m.mesh.as_mesh(),
        &Options { width: Width::PercentOfExtent(a[3].parse().unwrap()), ..Options::default() },
    )
    .unwrap();
    for t in &a[4..] {
        let t: usize = t.parse().unwrap();
        let s = r.triangle_sources[t];
        println!("triangle {t} {s:?}");
        for k in 0..3 {
            let o = r.mesh.indices[t * 3 + k] as usize;
            print!("  out {o} {:?} n {:?}", r.mesh.positions[o], r.mesh.normals[o]);
            if s.kind == TriangleKind::Source {
                let i = m.mesh.indices[s.index as usize * 3 + k] as usize;
                print!("   was {i} {:?} n {:?}", m.mesh.positions[i], m.mesh.normals[i]);
            }
            println!();
        }
    }
}
