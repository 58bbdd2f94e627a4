//! One shape told in two ways: triangles in another order, corners turned, mirrored, axes cycled.
#![no_main]

use arbitrary::Arbitrary;
use chamfer::Reason;
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
    // Who belongs to whom where many faces meet, and which of two sides without a partner has the
    // verdict, goes by number where nothing else tells.
    let paired = |totals: &chamfer::Totals| {
        totals.hard_edges - totals.skipped[Reason::TJunction] - totals.skipped[Reason::Winding]
    };
    if !has_crowded_edges(&mesh) {
        assert_eq!(paired(&one.totals), paired(&other.totals), "{way:?} {options:?}\n{mesh:?}");
    }
});
