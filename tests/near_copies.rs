//! Skins that are there twice or more, and lie on each other but for a step of single precision here
//! and there: what rounding leaves of a copy that was moved and moved back. No two vertices that were
//! beside each other may come to stand together, or edges of two faces would be edges of four.

use chamfer::check::check;
use chamfer::{Chamfered, MeshBuffers, Options, Verify, Width, chamfer, shapes};
use glam::{EulerRot, Quat, Vec3};

/// A mesh and copies of it, whose positions are off: each told the number of the copy.
fn copied(mesh: &MeshBuffers, copies: u32, off: impl Fn(u32, [f32; 3]) -> [f32; 3]) -> MeshBuffers {
    let (mut all, vertices) = (mesh.clone(), mesh.positions.len() as u32);
    for copy in 1..=copies {
        all.positions.extend(mesh.positions.iter().map(|&at| off(copy, at)));
        all.normals.extend_from_slice(&mesh.normals);
        all.tangents.extend_from_slice(&mesh.tangents);
        all.colors.extend_from_slice(&mesh.colors);
        all.indices.extend(mesh.indices.iter().map(|vertex| copy * vertices + vertex));
        for (uv, own) in all.uvs.iter_mut().zip(&mesh.uvs) {
            uv.values.extend_from_slice(&own.values);
        }
    }
    all.submesh_index_counts = vec![all.indices.len() as u32];
    all
}

/// A cube with a texture seam on each edge, one of its corners at the origin.
fn cube() -> MeshBuffers {
    let mut cube = shapes::cube(1.0);
    cube.positions.iter_mut().for_each(|at| *at = at.map(|along| along + 0.5));
    cube
}

/// Chamfered soundly.
#[track_caller]
fn chamfered(mesh: &MeshBuffers, options: &Options) -> Chamfered {
    let result = chamfer(&mesh.as_mesh(), options).unwrap();
    let findings = check(&mesh.as_mesh(), &result, options.verify);
    assert!(findings.is_sound(), "{findings}");
    result
}

fn options(segments: u32) -> Options {
    Options::default().with_width(Width::PercentOfExtent(3.0)).with_segments(segments)
}

/// Cubes beside the origin, each with a copy of which two opposite corners are one step off, along one
/// axis: some of their chamfers cross to where steps are longer, others to where they are shorter.
fn cubes_off_at_two_corners() -> impl Iterator<Item = MeshBuffers> {
    let places = [[-0.7, 0.9, 0.4], [-0.2, -0.4, 0.6], [0.5, 0.8, 0.7]];
    let all = [1.3, 1.7].into_iter().flat_map(move |side| places.map(|at| (side, at)));
    let ways = || (0..3).flat_map(|axis| [f32::next_up, f32::next_down].map(|step| (axis, step)));
    all.flat_map(move |cube| ways().map(move |way| off_at_two_corners(cube, way)))
}

fn off_at_two_corners(
    (side, place): (f32, [f32; 3]),
    (axis, step): (usize, fn(f32) -> f32),
) -> MeshBuffers {
    let far = [0, 1, 2].map(|k| side + place[k]);
    let mut cube = cube();
    cube.positions.iter_mut().for_each(|at| *at = [0, 1, 2].map(|k| at[k] * side + place[k]));
    copied(&cube, 1, |_, mut at| {
        if at == place || at == far {
            at[axis] = step(at[axis]);
        }
        at
    })
}

#[test]
fn a_copy_of_a_cube_may_be_off_at_corners() {
    for mesh in cubes_off_at_two_corners() {
        for segments in [1, 4, 6] {
            let result = chamfered(&mesh, &options(segments));
            assert_eq!(result.totals.chamfered, 24, "all of both");
        }
    }
}

/// In the space that a mesh is measured in vertices are rounded, and once more where they are stored.
#[test]
fn a_copy_may_be_off_in_a_scene_that_stretches_it() {
    for mesh in cubes_off_at_two_corners() {
        for [x, y] in [[3.0, 0.7], [0.4, 2.5]] {
            let scale = [[x, 0.0, 0.0], [0.0, y, 0.0], [0.0, 0.0, 1.0]];
            chamfered(&mesh, &options(1).with_scale(scale));
            chamfered(&mesh, &options(4).with_scale(scale));
        }
    }
}

#[test]
fn each_of_many_copies_is_apart_from_all_others() {
    for copies in [2, 3, 5] {
        let mesh = copied(&cube(), copies, |copy, at| {
            if at == [0.0; 3] { [copy as f32 * 1e-9, 0.0, 0.0] } else { at }
        });
        chamfered(&mesh, &options(1));
        chamfered(&mesh, &options(2));
    }
}

/// A mesh as large as a thousand, turned, and a copy that is off by so much at most: nearly everywhere
/// that is less than a step of single precision.
fn nearly_twice(mesh: &MeshBuffers, most: f32) -> MeshBuffers {
    let turn = Quat::from_euler(EulerRot::XYZ, 0.5, 1.0, 0.3);
    let mut mesh = mesh.clone();
    let turned = |at: &mut [f32; 3]| *at = (turn * Vec3::from(*at)).to_array();
    mesh.normals.iter_mut().for_each(turned);
    mesh.positions.iter_mut().for_each(|at| *at = (turn * Vec3::from(*at) * 1000.0).to_array());
    for tangent in &mut mesh.tangents {
        let [x, y, z, handedness] = *tangent;
        let [x, y, z] = (turn * Vec3::new(x, y, z)).to_array();
        *tangent = [x, y, z, handedness];
    }
    copied(&mesh, 1, |_, at| {
        let hash = at.iter().fold(1, |hash: u32, along| {
            (hash ^ (along + 0.0).to_bits()).wrapping_mul(0x9e37_79b1).rotate_left(13)
        });
        let off = |axis: usize| ((hash >> (10 * axis) & 1023) as f32 / 511.5 - 1.0) * most;
        [0, 1, 2].map(|axis| at[axis] + off(axis))
    })
}

#[test]
fn copies_may_be_off_here_and_there() {
    for (name, mesh) in shapes::demo_models() {
        for most in [1e-7, 1e-6, 1e-5, 3e-5] {
            let mesh = nearly_twice(&mesh, most);
            for segments in [1, 2, 3] {
                let options = Options::default().with_segments(segments);
                let options = options.with_width(Width::PercentOfExtent(1.0));
                let result = chamfer(&mesh.as_mesh(), &options).unwrap();
                let findings = check(&mesh.as_mesh(), &result, Verify::Fast);
                assert!(findings.is_sound(), "{name}, {most}, {segments}: {findings}");
            }
        }
    }
}
