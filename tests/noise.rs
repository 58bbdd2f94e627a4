//! Normals with noise, as scans and lossy compression leave them, at the seams of smooth surfaces.

use chamfer::check::{Facts, assert_sound, check};
use chamfer::{Chamfered, EdgeVerdict, MeshBuffers, Options, Verify, Width, chamfer, shapes};
use glam::DVec3;

/// Three numbers from -1 to 1 for each seed.
fn noise(seed: u32) -> DVec3 {
    DVec3::from([0, 1, 2].map(|axis| {
        let mut bits = (3 * seed + axis + 1).wrapping_mul(0x9E37_79B9);
        for step in [15, 13, 16] {
            bits = (bits ^ (bits >> step)).wrapping_mul(0x85EB_CA6B);
        }
        f64::from(bits) / f64::from(u32::MAX) * 2.0 - 1.0
    }))
}

/// The same with normals that are off by up to some degrees, each vertex on its own.
fn noisy(mut mesh: MeshBuffers, degrees: f64, seed: u32) -> MeshBuffers {
    let amount = degrees.to_radians();
    for (vertex, normal) in (0..).zip(&mut mesh.normals) {
        let off = DVec3::from(normal.map(f64::from)) + amount * noise(1_000 * seed + vertex);
        *normal = off.normalize().as_vec3().to_array();
    }
    mesh
}

/// What lies above the middle, with a lid.
fn half(sphere: MeshBuffers) -> MeshBuffers {
    let is_above = |corners: &&[u32]| {
        corners.iter().all(|&vertex| sphere.positions[vertex as usize][1] > -1e-3)
    };
    let mut mesh = MeshBuffers {
        positions: sphere.positions.clone(),
        normals: sphere.normals.clone(),
        ..MeshBuffers::default()
    };
    mesh.indices = sphere.indices.chunks_exact(3).filter(is_above).flatten().copied().collect();
    let lies_on_rim = |vertex: &u32| mesh.positions[*vertex as usize][1].abs() < 1e-3;
    let rim: Vec<[u32; 2]> = mesh
        .indices
        .chunks_exact(3)
        .flat_map(|t| [[t[0], t[1]], [t[1], t[2]], [t[2], t[0]]])
        .filter(|side| side.iter().all(lies_on_rim))
        .collect();
    for side in rim {
        let first = mesh.positions.len() as u32;
        let [from, to] = side.map(|vertex| mesh.positions[vertex as usize]);
        mesh.positions.extend([to, from, [0.0; 3]]);
        mesh.normals.extend([[0.0, -1.0, 0.0]; 3]);
        mesh.indices.extend([first, first + 1, first + 2]);
    }
    mesh.submesh_index_counts = vec![mesh.indices.len() as u32];
    mesh
}

fn chamfered(mesh: &MeshBuffers, percent: f32) -> Chamfered {
    chamfer(&mesh.as_mesh(), &Options::default().with_width(Width::PercentOfExtent(percent)))
        .unwrap()
}

fn facts(mesh: &MeshBuffers) -> Facts {
    check(&mesh.as_mesh(), &chamfered(mesh, 0.0), Verify::Fast).before
}

/// Its seam and its poles are split for the texture. Where noise at a pole happens to be as a crease
/// would be, it is one.
#[test]
fn a_noisy_sphere_has_next_to_no_hard_edges() {
    let (mut hard, mut split) = (0, 0);
    for seed in 0..20 {
        let mesh = noisy(shapes::sphere(12, 24), 1.5, seed);
        let count = chamfered(&mesh, 1.0).totals.hard_edges as usize;
        assert_eq!(facts(&mesh).hard_edges, count, "seed {seed}");
        hard += count;
        split += 2 * 24 + 12;
    }
    assert!(hard < split / 25, "{hard} of {split}");
}

/// The seam ends at the rim, which is sharp: its last edge is, too, where it differs there.
#[test]
fn a_noisy_dome_is_chamfered_at_its_rim() {
    let mut seams_at_rim = 0;
    for seed in 0..20 {
        let mesh = half(noisy(shapes::sphere(12, 24), 1.5, seed));
        for percent in [1.0, 5.0, 20.0] {
            let result = chamfered(&mesh, percent);
            assert_sound(&format!("seed {seed} at {percent} %"), &mesh.as_mesh(), &result);
            assert!((24..30).contains(&result.totals.hard_edges), "{:?}", result.totals);
            let is_low = |vertex: u32| mesh.positions[vertex as usize][1] < 1e-3;
            let leads_up = |verdict: &&EdgeVerdict| {
                verdict.vertices.iter().filter(|&&vertex| is_low(vertex)).count() == 1
            };
            seams_at_rim += result.verdicts.iter().filter(leads_up).count();
        }
    }
    assert!((30..60).contains(&seams_at_rim), "{seams_at_rim} of 60");
}
