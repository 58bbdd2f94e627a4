//! The worst shapes, small enough for the checker: all that is promised holds for them.
//!
//! How their time grows is a matter of `cargo bench --bench worst`.

#[path = "support/shaded.rs"]
mod shaded;
#[path = "support/worst.rs"]
mod worst;

use chamfer::check::assert_sound;
use chamfer::{MeshBuffers, Options, Width, chamfer, shapes};

fn check(name: &str, mesh: &MeshBuffers) {
    for percent in [0.05, 1.0, 15.0] {
        let options = Options::default().with_width(Width::PercentOfExtent(percent));
        let result = chamfer(&mesh.as_mesh(), &options).unwrap();
        assert_sound(&format!("{name} at {percent} %"), &mesh.as_mesh(), &result);
    }
}

#[test]
fn many_triangles_at_one_corner() {
    check("flat fan", &worst::fan(300, true));
    check("smooth fan", &worst::fan(300, false));
    check("pyramid", &shapes::pyramid(300));
}

#[test]
fn many_faces_on_one_edge() {
    check("book", &worst::book(100));
    check("stack", &worst::stack(40));
}

#[test]
fn all_vertices_at_one_place() {
    check("point", &worst::point(50));
}

#[test]
fn surfaces_with_one_side() {
    check("moebius strip", &worst::moebius_strip(40));
    check("klein bottle", &worst::klein_bottle(24));
}

#[test]
fn many_open_parts_that_rest_on_others() {
    check("posts", &worst::posts(12));
}

#[test]
fn parts_whose_boxes_all_overlap() {
    check("spikes", &worst::spikes(200));
    check("star cone", &worst::star_cone(60));
    check("gear cone", &worst::gear_cone(40));
    check("star wheel", &worst::star_wheel(60));
    check("comb", &worst::comb(60));
    check("wedges", &worst::wedges(40));
    check("turned quads", &worst::turned_quads(60));
}

#[test]
fn hills() {
    check("hills", &worst::terrain(12, false));
    check("hills with a texture", &worst::terrain(12, true));
}

#[test]
fn faces_of_many_triangles() {
    check("sieve", &worst::sieve(6));
    check("bar", &worst::bar(50));
    check("disc", &shapes::prism(300));
}

#[test]
fn slivers() {
    check("slivers", &worst::slivers(8));
}

#[test]
fn sizes_at_the_ends_of_single_precision() {
    for scale in [1e30, 1e-30, 1e-38, 1e-42, f32::from_bits(1)] {
        check(&format!("cubes of {scale:e}"), &worst::placed(shapes::cube_field(8), scale, 0.0));
        check(&format!("plate of {scale:e}"), &worst::placed(shapes::plate(), scale, 0.0));
    }
}

#[test]
fn far_from_the_origin() {
    for shift in [1e6, -3e6, 1e7] {
        check(&format!("cubes at {shift:e}"), &worst::placed(shapes::cube_field(8), 1.0, shift));
    }
}
