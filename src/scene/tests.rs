//! Meshes that rest on each other.

use super::*;
use crate::error::Error;
use crate::mesh::MeshBuffers;
use crate::options::{Options, Verify, Width};
use crate::pipeline::chamfer;
use crate::report::{EdgeVerdict, Outcome, Reason};
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

//  +---+
//  | A |        the cubes touch along an edge, half a side apart along it, so that no vertex of
//  +---+---+    one is at a vertex of the other
//      | B |
//      +---+
fn touching_cubes() -> (MeshBuffers, [Placed; 2]) {
    let placed = |x, y, z| Placed { mesh: 0, transform: at(x, y, z) };
    (shapes::plain_cube(2.0), [placed(-1.0, 1.0, 0.0), placed(1.0, -1.0, 1.0)])
}

#[test]
fn closed_objects_that_touch_let_light_through_unless_somebody_looks() {
    let (cube, placed) = touching_cubes();
    let blind = chamfered(&[&cube], &placed, None);
    let scenes = |scene: &ChamferedScene| {
        [cube.as_mesh(), scene.meshes[0].mesh.as_mesh()]
            .map(|mesh| scene_triangles(&[mesh], &placed))
    };
    let [before, after] = scenes(&blind);
    assert!(!leaks(&before, &after, 0.05, Eyes::default()).is_empty());
    let seen = chamfered(&[&cube], &placed, Some(Eyes::default()));
    assert_eq!((seen.rounds, seen.leaks.len()), (1, 0));
    let [before, after] = scenes(&seen);
    assert_eq!(leaks(&before, &after, 0.05, Eyes::default()), []);
    let held = seen.meshes[0].verdicts.iter().filter(|v| v.reason == Reason::Contact).count();
    assert!((2..6).contains(&held), "two edges touch, and few are near: {held}");
}

#[test]
fn one_mesh_is_looked_at_as_a_scene_is() {
    let (cube, placed) = touching_cubes();
    let mut both = MeshBuffers::default();
    for object in placed {
        let first = both.positions.len() as u32;
        let [x, y, z, _] = object.transform[3];
        both.positions.extend(cube.positions.iter().map(|p| [p[0] + x, p[1] + y, p[2] + z]));
        both.normals.extend(&cube.normals);
        both.indices.extend(cube.indices.iter().map(|index| first + index));
    }
    both.submesh_index_counts = vec![both.indices.len() as u32];
    let of = |verify| {
        let options = Options { width: Width::Units(0.05), verify, ..Options::default() };
        chamfer(&both.as_mesh(), &options).unwrap()
    };
    let is_held = |verdict: &&EdgeVerdict| verdict.reason == Reason::Contact;
    let contacts = |result: &Chamfered| result.verdicts.iter().filter(is_held).count();
    assert_eq!(contacts(&of(Verify::Full)), 0);
    assert!(contacts(&of(Verify::Seen)) >= 2);
}

/// Two cubes that touch, and a third one far off, which is a mesh of its own: nobody asks for it again.
#[test]
fn who_is_nowhere_near_is_not_told() {
    let (cube, placed) = touching_cubes();
    let far = Placed { mesh: 1, transform: at(20.0, 0.0, 0.0) };
    let [one, other] = placed;
    let meshes = [cube.as_mesh(), cube.as_mesh()];
    let options = Options { width: Width::Units(0.05), ..Options::default() };
    let mut asked = [0, 0];
    let mut run = |number: usize, mesh: &Mesh| -> Result<Chamfered, Error> {
        asked[number] += 1;
        chamfer(mesh, &options)
    };
    let eyes = Some(Eyes::default());
    let scene = chamfer_scene(&meshes, &[one, other, far], eyes, &mut run).unwrap();
    assert_eq!((scene.rounds, scene.leaks.len()), (1, 0));
    assert_eq!(asked, [2, 1]);
}
