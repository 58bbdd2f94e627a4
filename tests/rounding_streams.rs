//! Rounded chamfers: what their rows take along in each stream.

use std::collections::{BTreeMap, BTreeSet};

use chamfer::{Blend, Chamfered, MeshBuffers, Options, Width, chamfer, shapes};
use glam::{DVec3, DVec4};

const WIDTH: f64 = 0.2;

fn rounded(mesh: &MeshBuffers, segments: u32) -> Chamfered {
    let options = Options::default().with_width(Width::Units(WIDTH as f32)).with_segments(segments);
    chamfer(&mesh.as_mesh(), &options).unwrap()
}

fn wide(value: [f32; 3]) -> DVec3 {
    DVec3::from(value.map(f64::from))
}

/// A cube from -1 to 1 whose faces each have a colour of their own, and each two across from each
/// other a tangent.
fn painted() -> MeshBuffers {
    let mut cube = shapes::plain_cube(2.0);
    let face = |normal: &[f32; 3]| normal.iter().position(|along| *along != 0.0).unwrap();
    let color = |normal: &[f32; 3]| color(wide(*normal)).as_vec4().to_array();
    cube.colors = cube.normals.iter().map(color).collect();
    cube.tangents = cube.normals.iter().map(|normal| tangent_of(face(normal))).collect();
    cube
}

fn color(normal: DVec3) -> DVec4 {
    let [x, y, z] = normal.to_array();
    DVec4::new(0.5 + x / 4.0, 0.5 + y / 4.0, 0.5 + z / 4.0, 0.5 + (x + y + z) / 8.0)
}

fn tangent_of(axis: usize) -> [f32; 4] {
    [[0.0, 0.6, 0.8, 1.0], [0.8, 0.0, 0.6, 1.0], [1.0, 0.0, 0.0, 1.0]][axis]
}

/// The axes of the faces that a vertex of a rounded cube is between, with their signs.
fn faces_at(normal: DVec3) -> Vec<DVec3> {
    let axes = [DVec3::X, DVec3::Y, DVec3::Z].into_iter();
    let leans = axes.filter(|axis| normal.dot(*axis).abs() > 1e-3);
    leans.map(|axis| axis * normal.dot(axis).signum()).collect()
}

//   red                  the row in the middle of an edge takes half of either side, and the point in
//   ---.                 the middle of a corner a third of each
//       \ half red, half blue
//        | blue
#[test]
fn rows_have_the_mean_of_the_colours_and_tangents_beside_them() {
    for (segments, sides) in [(2, 2), (3, 3)] {
        let result = rounded(&painted(), segments);
        let mesh = &result.mesh;
        let mut seen = 0;
        for vertex in 24..mesh.positions.len() {
            let normal = wide(mesh.normals[vertex]);
            let faces = faces_at(normal);
            if faces.len() != sides {
                continue;
            }
            seen += 1;
            let count = sides as f64;
            let expected = faces.iter().map(|face| color(*face)).sum::<DVec4>() / count;
            let found = DVec4::from_array(mesh.colors[vertex].map(f64::from));
            assert!(found.distance(expected) < 1e-6, "{found} for {expected}");
            let tangents = faces.iter().map(|face| {
                let axis = (0..3).find(|&k| face[k] != 0.0).unwrap();
                let [x, y, z, _] = tangent_of(axis);
                wide([x, y, z])
            });
            let expected = tangents.sum::<DVec3>().reject_from(normal).normalize();
            let [x, y, z, _] = mesh.tangents[vertex];
            assert!(wide([x, y, z]).distance(expected) < 1e-5, "{x} {y} {z} for {expected}");
        }
        assert_eq!(seen, if sides == 2 { 24 } else { 8 });
    }
}

// Each face of the cube is a submesh of its own: all rows of a strip are of the same as the strip
// of one segment.
#[test]
fn all_rows_are_in_the_submesh_of_their_chamfer() {
    let mut cube = shapes::cube(2.0);
    cube.submesh_index_counts = vec![6; 6];
    let of = |segments: u32| {
        let result = rounded(&cube, segments);
        let ends = result.mesh.submesh_index_counts.iter().scan(0, |end, count| {
            *end += count / 3;
            Some(*end)
        });
        let ends: Vec<u32> = ends.collect();
        let mut submeshes: BTreeMap<(u32, u32), BTreeSet<usize>> = BTreeMap::new();
        for (place, source) in (0_u32..).zip(&result.triangle_sources) {
            let submesh = ends.partition_point(|&end| end <= place);
            submeshes.entry((source.kind as u32, source.index)).or_default().insert(submesh);
        }
        submeshes
    };
    let flat = of(1);
    assert!(flat.values().all(|submeshes| submeshes.len() == 1));
    assert_eq!(flat, of(4));
}

fn place_of(mesh: &MeshBuffers, blend: &Blend) -> DVec3 {
    let terms = blend.vertices.iter().zip(blend.weights);
    terms.map(|(&v, weight)| wide(mesh.positions[v as usize]) * f64::from(weight)).sum()
}

/// The vertex at a place, and the blend that its surface has.
fn vertex_at(result: &Chamfered, place: DVec3) -> Blend {
    let way = |v: &usize| wide(result.mesh.positions[*v]).distance(place);
    let all = 0..result.mesh.positions.len();
    let vertex = all.min_by(|one, other| way(one).total_cmp(&way(other))).unwrap();
    assert!(way(&vertex) < 1e-5, "nothing stands at {place}");
    result.vertex_sources.iter().nth(vertex).unwrap().surface
}

//     o------c      The point P on the arc between two pulled vertices takes the mean of what they
//     |     /|      take, and of the old corner c as much as it is bent from the chord towards that.
//    -o . P  |      Both faces are cut through c here, so each pulled vertex is nine tenths c's.
#[test]
fn rows_follow_the_old_corner_as_far_as_they_are_bent_towards_it() {
    let cube = shapes::plain_cube(2.0);
    let corner = DVec3::new(1.0, -1.0, -1.0);
    let weights = |segments: u32, place: DVec3| {
        let result = rounded(&cube, segments);
        let blend = vertex_at(&result, place);
        assert_eq!(wide(cube.positions[blend.vertices[0] as usize]), corner);
        blend.weights.map(f64::from)
    };
    let bent = |place: DVec3, chord: DVec3| {
        let rise = corner - chord;
        (place - chord).dot(rise) / rise.length_squared()
    };
    let assert_close = |found: [f64; 3], flat: [f64; 3], bent: f64| {
        let corner = flat[0] + bent * (1.0 - flat[0]);
        let expected = [corner, flat[1] * (1.0 - bent), flat[2] * (1.0 - bent)];
        let off = (0..3).map(|k| (found[k] - expected[k]).abs()).fold(0.0, f64::max);
        assert!(off < 1e-5, "{found:?} for {expected:?}");
    };
    // On a quarter of a circle.
    let side = 1.0 - WIDTH + WIDTH * 0.5_f64.sqrt();
    let place = DVec3::new(side, -1.0 + WIDTH, -side);
    let bent_by = bent(place, DVec3::new(1.0 - WIDTH / 2.0, -1.0 + WIDTH, WIDTH / 2.0 - 1.0));
    assert_close(weights(2, place), [0.9, 0.05, 0.05], bent_by);
    // In the middle of the corner, which takes of a third vertex too: that part is the corner's.
    let result = rounded(&cube, 3);
    let in_middle = |v: &usize| {
        let way = (wide(result.mesh.positions[*v]) / corner).to_array();
        way.iter().all(|along| (along - way[0]).abs() < 1e-6) && way[0] > 0.0
    };
    let all = 24..result.mesh.positions.len();
    let place = wide(result.mesh.positions[all.clone().find(in_middle).unwrap()]);
    let bent_by = bent(place, corner * (1.0 - 2.0 * WIDTH / 3.0));
    assert_close(weights(3, place), [0.9, 0.2 / 3.0, 0.1 / 3.0], bent_by);
}

//    o---o---o---M     on the way from a pulled vertex to the middle of a fill, a point follows what
//                      both are near to, the more of either the nearer it is
#[test]
fn blends_go_over_into_those_of_the_middle() {
    const NARROW: f64 = 0.05;
    let pyramid = shapes::pyramid(5);
    let options = Options::default().with_width(Width::Units(NARROW as f32)).with_segments(4);
    let result = chamfer(&pyramid.as_mesh(), &options).unwrap();
    let mut seen = 0;
    for (vertex, source) in result.vertex_sources.iter().enumerate() {
        let place = wide(result.mesh.positions[vertex]);
        // Halfway between two edges, and so on the arcs over the middles of the faces.
        let fifths = place.x.atan2(place.z) / std::f64::consts::TAU * 5.0;
        let is_on_arc = (fifths.rem_euclid(1.0) - 0.5).abs() < 1e-4;
        if source.is_between() && is_on_arc && place.y > 0.9 {
            seen += 1;
            let off = place_of(&pyramid, &source.surface).distance(place);
            assert!(off < 0.3 * NARROW, "{off} at {place}");
        }
    }
    assert_eq!(seen, 5 * 3);
}

// Each face has a chart of its own: what a strip shows on the texture is where its provenance says.
#[test]
fn provenance_tells_the_chart_of_the_owner() {
    let cube = shapes::cube(2.0);
    let result = rounded(&cube, 4);
    let uv =
        |mesh: &MeshBuffers, v: usize| [0, 1].map(|k| f64::from(mesh.uvs[0].values[2 * v + k]));
    for (vertex, source) in result.vertex_sources.iter().enumerate() {
        let blend = source.uv(0);
        let terms = blend.vertices.iter().zip(blend.weights);
        let mut off = uv(&result.mesh, vertex);
        for (&from, weight) in terms {
            let at = uv(&cube, from as usize);
            off = [0, 1].map(|k| off[k] - at[k] * f64::from(weight));
        }
        // A face is 0.3 wide on the texture. Of four vertices a blend leaves one out.
        assert!(off.iter().all(|along| along.abs() < 0.02), "{vertex} is {off:?} off");
    }
}
