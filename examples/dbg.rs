//! dbg
use chamfer::*;
use chamfer_cli::{document::ReadOptions, format};
fn main() {
    let a: Vec<String> = std::env::args().collect();
    let d =
        format::read(std::path::Path::new(&a[1]), &ReadOptions { smoothing_angle: 30.0 }).unwrap();
    for m in d.meshes() {
        let r = chamfer::chamfer(
            &m.mesh.as_mesh(),
            &Options { width: Width::PercentOfExtent(a[2].parse().unwrap()), ..Options::default() },
        )
        .unwrap();
        println!("{} width {}", m.name, r.width);
        for v in &r.verdicts {
            if v.outcome != Outcome::Full {
                let p = v.vertices.map(|i| m.mesh.positions[i as usize]);
                println!(
                    "{:?} {:?} {:?} rel {:.3} {:.3} {:?}",
                    v.vertices,
                    v.outcome,
                    v.reason,
                    v.widths[0] / r.width,
                    v.widths[1] / r.width,
                    p
                );
            }
        }
    }
}
