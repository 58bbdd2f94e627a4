//! One shape told in two ways: triangles in another order, corners turned, mirrored, axes cycled.
#![no_main]

use std::collections::HashSet;

use arbitrary::Arbitrary;
use chamfer::{Chamfered, EdgeVerdict, MeshBuffers, Reason};
use chamfer_fuzz::meshes::{Spec, Wishes};
use chamfer_fuzz::oracle::{chamfer_and_check, has_crowded_edges};
use chamfer_fuzz::retold::Retold;
use libfuzzer_sys::fuzz_target;

#[derive(Arbitrary, Clone, Copy, Debug)]
enum Way {
    Shuffled(u32),
    Renumbered(u32),
    Turned(u32),
    Mirrored,
    Cycled,
}

fuzz_target!(|input: (Spec, Wishes, Way)| {
    let (spec, wishes, way) = input;
    let way = match way {
        Way::Shuffled(seed) => Retold::Shuffled(seed),
        Way::Renumbered(seed) => Retold::Renumbered(seed),
        Way::Turned(seed) => Retold::Turned(seed),
        Way::Mirrored => Retold::Mirrored,
        Way::Cycled => Retold::Cycled,
    };
    let (mesh, options) = (spec.clean_mesh(), wishes.options());
    let Some(one) = chamfer_and_check(&mesh, &options) else { return };
    let again = way.apply(&mesh);
    let other = chamfer_and_check(&again, &options).expect("the same went well before");
    // Which of two sides without a partner has the verdict goes by number where nothing else tells,
    // and so does who belongs to whom where many faces meet.
    if !has_crowded_edges(&mesh) {
        let [one, other] = [paired(&mesh, &one), paired(&again, &other)];
        assert_eq!(one, other, "{way:?} {options:?}\n{mesh:?}");
    }
});

/// How many verdicts are of edges with a face on either side. A face that is wound against its
/// normals has one as well, though its verdict may name the winding.
fn paired(mesh: &MeshBuffers, result: &Chamfered) -> usize {
    let place = |vertex: u32| mesh.positions[vertex as usize].map(|along| (along + 0.0).to_bits());
    let sides = |corners: &[u32]| {
        let [a, b, c] = [corners[0], corners[1], corners[2]].map(place);
        [[a, b], [b, c], [c, a]]
    };
    let sides: HashSet<_> = mesh.indices.chunks_exact(3).flat_map(sides).collect();
    let is_paired = |verdict: &&EdgeVerdict| {
        let [from, to] = verdict.vertices.map(place);
        match verdict.reason {
            Reason::TJunction => false,
            Reason::Winding => sides.contains(&[from, to]) && sides.contains(&[to, from]),
            _ => true,
        }
    };
    result.verdicts.iter().filter(is_paired).count()
}
