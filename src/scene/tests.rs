//! Meshes that rest on each other.

use super::*;
use crate::error::Error;
use crate::mesh::MeshBuffers;
use crate::options::{Options, Verify, Width};
use crate::pipeline::chamfer;
use crate::report::{Outcome, Reason};
use crate::shapes;

fn at(x: f32, y: f32, z: f32) -> [[f32; 4]; 4] {
    let mut transform = glam::Mat4::IDENTITY.to_cols_array_2d();
    transform[3] = [x, y, z, 1.0];
    transform
}

fn chamfered(meshes: &[&MeshBuffers], placed: &[Placed], eyes: Option<Eyes>) -> ChamferedScene {
    let meshes: Vec<Mesh> = meshes.iter().map(|mesh| mesh.as_mesh()).collect();
    let options = Options { width: Width::Units(0.05), verify: Verify::Full, ..Options::default() };
    let mut run = |_: usize, mesh: &Mesh| -> Result<Chamfered, Error> { chamfer(mesh, &options) };
    chamfer_scene(&meshes, placed, eyes, &mut run).unwrap()
}

//    ______
//   | open |     the rim of one box rests on a face of another, along one of its edges
//   |______|____
//   |   box     |
//   |___________|
#[test]
fn the_rim_of_another_object_holds_the_edge_that_it_rests_on() {
    let (below, above) = (shapes::plain_cube(2.0), shapes::open_box());
    let extent = above.as_mesh().extent();
    let placed = [
        Placed { mesh: 0, transform: at(0.0, 0.0, 0.0) },
        Placed { mesh: 1, transform: at(5.0 * extent, 0.0, 0.0) },
    ];
    let apart = chamfered(&[&below, &above], &placed, None);
    let full = |scene: &ChamferedScene| {
        scene.meshes[0].verdicts.iter().filter(|v| v.outcome == Outcome::Full).count()
    };
    assert_eq!(full(&apart), 12);
    // The borders of the open box, moved so that one lies along an edge of the cube.
    let [from, _] = border_lines(&above.as_mesh())[0];
    let shift = DVec3::new(-1.0, 1.0, -1.0) - from;
    let [x, y, z] = shift.as_vec3().to_array();
    let placed = [placed[0], Placed { mesh: 1, transform: at(x, y, z) }];
    let touching = chamfered(&[&below, &above], &placed, None);
    let held = |v: &crate::EdgeVerdict| v.reason == Reason::Contact;
    assert!(touching.meshes[0].verdicts.iter().any(held), "{:?}", touching.meshes[0].totals);
}

#[test]
fn a_mirrored_triangle_still_faces_outward() {
    let triangle = MeshBuffers {
        positions: vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
        indices: vec![0, 1, 2],
        ..MeshBuffers::default()
    };
    let mut transform = at(0.0, 0.0, 5.0);
    transform[0][0] = -2.0;
    let triangles = scene_triangles(&[triangle.as_mesh()], &[Placed { mesh: 0, transform }]);
    assert_eq!(triangles, [[[0.0, 0.0, 5.0], [0.0, 1.0, 5.0], [-2.0, 0.0, 5.0]]]);
}
