//! Faults planted in what the core makes of closed meshes: the checker finds each, with nothing to
//! tell it what came from what.
#![no_main]

use arbitrary::Arbitrary;
use chamfer::check::compare;
use chamfer::{MeshBuffers, Verify};
use chamfer_fuzz::meshes::{Spec, Wishes};
use chamfer_fuzz::oracle::{chamfer_and_check, has_crowded_edges};
use libfuzzer_sys::fuzz_target;

#[derive(Arbitrary, Clone, Copy, Debug)]
enum Fault {
    Flipped(u16),
    Gone(u16),
    Twice(u16),
    /// A vertex is far away.
    Away(u16),
    NoNormal(u16),
}

fuzz_target!(|input: (Spec, Wishes, Fault)| {
    let (spec, wishes, fault) = input;
    let (mesh, options) = (spec.clean_mesh(), wishes.options());
    let Some(result) = chamfer_and_check(&mesh, &options) else { return };
    let found = compare(&mesh.as_mesh(), &result.mesh.as_mesh(), Verify::Fast);
    let is_closed = found.after.border_half_edges == 0 && found.after.flat_triangles == 0;
    // Where there are several ways to bring two meshes together, a fault may look like another one
    // of these.
    if !found.is_sound() || !is_closed || has_crowded_edges(&mesh) || mesh.indices.is_empty() {
        return;
    }
    if has_crowded_edges(&result.mesh) || found.after.odd_normals > 0 {
        return;
    }
    let mut faulty = result.mesh;
    plant(&mut faulty, fault);
    let found = compare(&mesh.as_mesh(), &faulty.as_mesh(), Verify::Fast);
    assert!(!found.is_sound(), "{fault:?} is not found\n{mesh:?}\n{faulty:?}");
});

fn plant(mesh: &mut MeshBuffers, fault: Fault) {
    let triangles = mesh.indices.len() / 3;
    let triangle = |number: u16| 3 * (usize::from(number) % triangles);
    match fault {
        Fault::Flipped(number) => mesh.indices.swap(triangle(number), triangle(number) + 1),
        Fault::Gone(number) => {
            let last = mesh.indices.len() - 3;
            for k in 0..3 {
                mesh.indices.swap(triangle(number) + k, last + k);
            }
            mesh.indices.truncate(last);
            let counts = mesh.submesh_index_counts.iter_mut();
            if let Some(count) = counts.rev().find(|count| **count > 0) {
                *count -= 3;
            }
        }
        Fault::Twice(number) => {
            let first = triangle(number);
            let copy = [0, 1, 2].map(|k| mesh.indices[first + k]);
            mesh.indices.extend(copy);
            if let Some(count) = mesh.submesh_index_counts.last_mut() {
                *count += 3;
            }
        }
        Fault::Away(number) => {
            let extent = mesh.as_mesh().extent();
            let vertex = mesh.indices[triangle(number)] as usize;
            mesh.positions[vertex][0] += 10.0 * extent;
        }
        Fault::NoNormal(number) => {
            let vertex = mesh.indices[triangle(number)] as usize;
            mesh.normals[vertex] = [0.0; 3];
        }
    }
}
