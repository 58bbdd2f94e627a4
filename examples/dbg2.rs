//! dbg
use chamfer_cli::{document::ReadOptions, format};
fn main() {
    let a: Vec<String> = std::env::args().collect();
    let d =
        format::read(std::path::Path::new(&a[1]), &ReadOptions { smoothing_angle: 30.0 }).unwrap();
    let mi: usize = a[2].parse().unwrap();
    let (x, y): (usize, usize) = (a[3].parse().unwrap(), a[4].parse().unwrap());
    let m = &d.meshes()[mi].mesh;
    let (p, q) = (m.positions[x], m.positions[y]);
    println!("{p:?} {q:?}");
    for (t, tri) in m.indices.chunks(3).enumerate() {
        for k in 0..3 {
            let (u, v) = (m.positions[tri[k] as usize], m.positions[tri[(k + 1) % 3] as usize]);
            if (u == p && v == q) || (u == q && v == p) {
                let w = m.positions[tri[(k + 2) % 3] as usize];
                println!(
                    "tri {t} {} apex {w:?} n {:?} {:?} idx {:?}",
                    if u == p { "fwd" } else { "back" },
                    m.normals[tri[k] as usize],
                    m.normals[tri[(k + 1) % 3] as usize],
                    tri
                );
            }
        }
    }
}
