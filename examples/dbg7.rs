//! dbg
use chamfer::*;
fn main() {
    for n in [1000u32, 10000, 83334] {
        let m = shapes::cube_field(n);
        let mesh = m.as_mesh();
        for verify in [Verify::Fast, Verify::Full] {
            let mut best = f64::MAX;
            for _ in 0..3 {
                let t = std::time::Instant::now();
                let mut last = 0.0;
                let mut stamps = vec![];
                let r = chamfer_with_progress(
                    &mesh,
                    &Options { width: Width::Units(0.05), verify, ..Options::default() },
                    &mut |f| {
                        stamps.push((f, t.elapsed().as_secs_f64()));
                        last = f;
                        std::ops::ControlFlow::Continue(())
                    },
                )
                .unwrap();
                let e = t.elapsed().as_secs_f64();
                if e < best {
                    best = e;
                    println!(
                        "{n} {verify:?} {:.0} ns/tri {:?}",
                        e / (n as f64 * 12.0) * 1e9,
                        stamps
                            .iter()
                            .map(|s| (s.0, (s.1 / (n as f64 * 12.0) * 1e9) as i64))
                            .collect::<Vec<_>>()
                    );
                }
                drop(r);
            }
        }
    }
}
