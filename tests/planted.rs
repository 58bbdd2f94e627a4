//! Faults planted in the pipeline's own results, one by one, on models of several kinds: each is
//! found, with and without provenance. What changes nothing is no fault.

use chamfer::check::{Findings, check, compare};
use chamfer::shapes;
use chamfer::{Chamfered, MeshBuffers, Options, TriangleKind, Verify, Width, chamfer};
use glam::Vec3;

/// A solid of flat and round faces, one of several parts, an open one, one with a seam, a curved one.
fn models() -> Vec<(&'static str, MeshBuffers)> {
    let all = [
        ("bolt", shapes::bolt()),
        ("table", shapes::table()),
        ("open box", shapes::open_box()),
        ("cube", shapes::cube(1.0)),
        ("cylinder", shapes::cylinder(16)),
    ];
    all.map(|(name, mesh)| (name, dressed(mesh))).into()
}

/// With all streams: a texture, which is the same plane for all parallel faces, tangents, colours.
fn dressed(mut mesh: MeshBuffers) -> MeshBuffers {
    let tangents = mesh.normals.iter().map(|&normal| {
        let normal = Vec3::from(normal);
        let along = if normal.y.abs() > 0.9 { Vec3::X } else { Vec3::Y };
        along.reject_from(normal).normalize().extend(1.0).to_array()
    });
    mesh.tangents = tangents.collect();
    let plane = |(position, normal): (&[f32; 3], &[f32; 3])| {
        let normal = Vec3::from(*normal).abs();
        let [x, y, z] = *position;
        if normal.y > 0.9 { [x + 2.0, z + 3.0] } else { [x + z + 2.0, y + 3.0] }
    };
    mesh.uvs[0].components = 2;
    mesh.uvs[0].values = mesh.positions.iter().zip(&mesh.normals).flat_map(plane).collect();
    mesh.uvs[1] = mesh.uvs[0].clone();
    let extent = mesh.as_mesh().extent();
    let color = |[x, y, z]: &[f32; 3]| [*x, *y, *z, 1.0].map(|along| 0.5 + 0.4 * along / extent);
    mesh.colors = mesh.positions.iter().map(color).collect();
    mesh
}

fn chamfered(before: &MeshBuffers) -> Chamfered {
    let options = Options::default().with_width(Width::PercentOfExtent(2.0));
    chamfer(&before.as_mesh(), &options).unwrap()
}

/// What is found with the provenance, and by the two meshes alone.
fn found(before: &MeshBuffers, after: &Chamfered) -> [Findings; 2] {
    [
        check(&before.as_mesh(), after, Verify::Full),
        compare(&before.as_mesh(), &after.mesh.as_mesh(), Verify::Full),
    ]
}

/// A vertex of a source triangle, in the middle of the list.
fn kept_vertex(mesh: &MeshBuffers, after: &Chamfered) -> usize {
    let triangle = after.triangle_sources.iter().rposition(|s| s.kind == TriangleKind::Source);
    mesh.indices[3 * (triangle.unwrap() / 2)] as usize
}

/// A vertex that the pipeline added and a strip uses.
fn strip_vertex(mesh: &MeshBuffers, after: &Chamfered) -> usize {
    let strip = after.triangle_sources.iter().position(|s| s.kind == TriangleKind::Edge).unwrap();
    mesh.indices[3 * strip] as usize
}

fn turned(normal: [f32; 3], degrees: f32) -> [f32; 3] {
    let normal = Vec3::from(normal);
    let axis = normal.any_orthonormal_vector();
    glam::Quat::from_axis_angle(axis, degrees.to_radians()).mul_vec3(normal).to_array()
}

fn turn_all(after: &mut Chamfered, degrees: f32) {
    for normal in &mut after.mesh.normals {
        *normal = turned(*normal, degrees);
    }
}

fn turn_tangents(after: &mut Chamfered, degrees: f32) {
    for (tangent, normal) in after.mesh.tangents.iter_mut().zip(&after.mesh.normals) {
        let turn = glam::Quat::from_axis_angle(Vec3::from(*normal), degrees.to_radians());
        let [x, y, z, w] = *tangent;
        *tangent = turn.mul_vec3(Vec3::new(x, y, z)).extend(w).to_array();
    }
}

fn each_uv(after: &mut Chamfered, change: impl Fn([f32; 2]) -> [f32; 2]) {
    let values = after.mesh.uvs[0].values.as_chunks_mut::<2>().0;
    values.iter_mut().for_each(|uv| *uv = change(*uv));
}

fn scale(after: &mut Chamfered, by: [f32; 3]) {
    for position in &mut after.mesh.positions {
        *position = [0, 1, 2].map(|k| position[k] * by[k]);
    }
}

fn shift(after: &mut Chamfered, by: [f32; 3]) {
    for position in &mut after.mesh.positions {
        *position = [0, 1, 2].map(|k| position[k] + by[k]);
    }
}

/// Takes a triangle away, with what is told of it.
fn remove(after: &mut Chamfered, triangle: usize) {
    after.mesh.indices.drain(3 * triangle..3 * triangle + 3);
    let mut end = 0;
    for count in &mut after.mesh.submesh_index_counts {
        end += *count as usize / 3;
        if triangle < end {
            *count -= 3;
            break;
        }
    }
    after.triangle_sources.remove(triangle);
}

fn first(after: &Chamfered, kind: TriangleKind) -> usize {
    after.triangle_sources.iter().position(|source| source.kind == kind).unwrap()
}

/// Moves all vertices at the place of one, by a share of the extent.
fn move_place(after: &mut Chamfered, vertex: usize, direction: [f32; 3], share: f32) {
    let extent = after.mesh.as_mesh().extent();
    let from = after.mesh.positions[vertex];
    for position in after.mesh.positions.iter_mut().filter(|position| **position == from) {
        *position = [0, 1, 2].map(|k| position[k] + share * extent * direction[k]);
    }
}

type Plant = fn(&mut Chamfered);

const FAULTS: &[(&str, Plant)] = &[
    ("all normals turned by 30 degrees", |after| turn_all(after, 30.0)),
    ("all normals turned by 5 degrees", |after| turn_all(after, 5.0)),
    ("all normals turned round", |after| turn_all(after, 180.0)),
    ("one normal turned by 90 degrees", |after| {
        let vertex = kept_vertex(&after.mesh, after);
        after.mesh.normals[vertex] = turned(after.mesh.normals[vertex], 90.0);
    }),
    ("one normal turned by 10 degrees", |after| {
        let vertex = kept_vertex(&after.mesh, after);
        after.mesh.normals[vertex] = turned(after.mesh.normals[vertex], 10.0);
    }),
    ("a normal of a strip turned round", |after| {
        let vertex = strip_vertex(&after.mesh, after);
        after.mesh.normals[vertex] = after.mesh.normals[vertex].map(|along| -along);
    }),
    ("a normal twice as long", |after| {
        let vertex = kept_vertex(&after.mesh, after);
        after.mesh.normals[vertex] = after.mesh.normals[vertex].map(|along| 2.0 * along);
    }),
    ("the axes of normals exchanged", |after| {
        after.mesh.normals.iter_mut().for_each(|normal| normal.rotate_left(1));
    }),
    ("twice as large", |after| scale(after, [2.0; 3])),
    ("a tenth of a percent larger", |after| scale(after, [1.001; 3])),
    ("stretched along one axis", |after| scale(after, [1.0, 1.1, 1.0])),
    ("shifted", |after| shift(after, [0.01, 0.0, 0.0])),
    ("shifted far away", |after| shift(after, [100.0, 0.0, 0.0])),
    ("axes exchanged", |after| {
        after.mesh.positions.iter_mut().for_each(|position| position.rotate_left(1));
    }),
    ("a corner pulled out", |after| {
        let vertex = kept_vertex(&after.mesh, after);
        let normal = after.mesh.normals[vertex];
        move_place(after, vertex, normal, 0.01);
    }),
    ("a corner pushed in", |after| {
        let vertex = kept_vertex(&after.mesh, after);
        let normal = after.mesh.normals[vertex];
        move_place(after, vertex, normal, -0.002);
    }),
    ("a strip missing", |after| {
        let strip = first(after, TriangleKind::Edge);
        remove(after, strip);
    }),
    ("all strips missing", |after| {
        while let Some(strip) =
            after.triangle_sources.iter().position(|source| source.kind == TriangleKind::Edge)
        {
            remove(after, strip);
        }
    }),
    ("a face missing", |after| remove(after, 1)),
    ("a face twice", |after| {
        let corners: Vec<u32> = after.mesh.indices[..3].to_vec();
        after.mesh.indices.extend(corners);
        *after.mesh.submesh_index_counts.last_mut().unwrap() += 3;
        let strip = after.triangle_sources[first(after, TriangleKind::Edge)];
        after.triangle_sources.push(strip);
    }),
    ("a face turned over", |after| after.mesh.indices.swap(0, 1)),
    ("all faces turned over", |after| {
        after.mesh.indices.as_chunks_mut::<3>().0.iter_mut().for_each(|corners| corners.swap(0, 1));
    }),
    ("mirrored", |after| scale(after, [-1.0, 1.0, 1.0])),
    ("u and v exchanged", |after| each_uv(after, |[u, v]| [v, u])),
    ("texture coordinates zero", |after| each_uv(after, |_| [0.0; 2])),
    ("texture mirrored", |after| each_uv(after, |[u, v]| [1.0 - u, v])),
    ("texture upside down", |after| each_uv(after, |[u, v]| [u, 1.0 - v])),
    ("texture shifted", |after| each_uv(after, |[u, v]| [u + 0.01, v])),
    ("texture larger", |after| each_uv(after, |[u, v]| [1.01 * u, v])),
    ("one texture coordinate off", |after| {
        let vertex = kept_vertex(&after.mesh, after);
        after.mesh.uvs[0].values[2 * vertex] += 0.05;
    }),
    ("texture of a strip zero", |after| {
        let strip = first(after, TriangleKind::Edge);
        for corner in 3 * strip..3 * strip + 3 {
            let vertex = after.mesh.indices[corner] as usize;
            after.mesh.uvs[0].values[2 * vertex..2 * vertex + 2].fill(0.0);
        }
    }),
    ("the second texture off", |after| {
        after.mesh.uvs[1].values.iter_mut().for_each(|along| *along *= 0.9);
    }),
    ("tangents turned by 90 degrees", |after| turn_tangents(after, 90.0)),
    ("tangents turned by 20 degrees", |after| turn_tangents(after, 20.0)),
    ("tangents of the other handedness", |after| {
        after.mesh.tangents.iter_mut().for_each(|tangent| tangent[3] = -tangent[3]);
    }),
    ("one tangent of the other handedness", |after| {
        let vertex = kept_vertex(&after.mesh, after);
        after.mesh.tangents[vertex][3] *= -1.0;
    }),
    ("one tangent turned round", |after| {
        let vertex = kept_vertex(&after.mesh, after);
        let [x, y, z, w] = after.mesh.tangents[vertex];
        after.mesh.tangents[vertex] = [-x, -y, -z, w];
    }),
    ("no tangents", |after| after.mesh.tangents.clear()),
    ("no colours", |after| after.mesh.colors.clear()),
    ("red and blue exchanged", |after| {
        after.mesh.colors.iter_mut().for_each(|color| color.swap(0, 2));
    }),
    ("one colour off", |after| {
        let vertex = kept_vertex(&after.mesh, after);
        let [red, ..] = &mut after.mesh.colors[vertex];
        *red = if *red > 0.5 { *red - 0.1 } else { *red + 0.1 };
    }),
    ("all of one colour", |after| after.mesh.colors.fill([0.5; 4])),
];

#[test]
fn each_fault_is_found_on_each_model() {
    let mut missed = Vec::new();
    for (name, before) in models() {
        let after = chamfered(&before);
        for (fault, plant) in FAULTS {
            let mut broken = after.clone();
            plant(&mut broken);
            let ways = ["told", "alone"].into_iter().zip(found(&before, &broken));
            missed.extend(
                ways.filter(|(_, found)| found.is_sound())
                    .map(|(way, _)| format!("{name}, {way}: {fault}")),
            );
        }
    }
    assert!(missed.is_empty(), "{} missed:\n{}", missed.len(), missed.join("\n"));
}

/// The numbers below a count in another order.
fn shuffled(count: usize) -> Vec<usize> {
    let mut order: Vec<usize> = (0..count).collect();
    let mut state = 7_u32;
    for place in (1..count).rev() {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        order.swap(place, (state >> 8) as usize % (place + 1));
    }
    order
}

fn in_order(mesh: &mut MeshBuffers, order: &[usize]) {
    let old = mesh.indices.clone();
    mesh.indices = order.iter().flat_map(|&t| [0, 1, 2].map(|k| old[3 * t + k])).collect();
    mesh.submesh_index_counts = vec![mesh.indices.len() as u32];
}

fn turn(mesh: &mut MeshBuffers) {
    let triangles = mesh.indices.as_chunks_mut::<3>().0.iter_mut().enumerate();
    triangles.for_each(|(triangle, corners)| corners.rotate_left(triangle % 3));
}

/// Every corner has a vertex of its own.
fn unwelded(mesh: &MeshBuffers) -> MeshBuffers {
    let pick = |vertex: u32| vertex as usize;
    let mut apart = MeshBuffers {
        positions: mesh.indices.iter().map(|&v| mesh.positions[pick(v)]).collect(),
        normals: mesh.indices.iter().map(|&v| mesh.normals[pick(v)]).collect(),
        tangents: mesh.indices.iter().map(|&v| mesh.tangents[pick(v)]).collect(),
        colors: mesh.indices.iter().map(|&v| mesh.colors[pick(v)]).collect(),
        indices: (0..mesh.indices.len() as u32).collect(),
        submesh_index_counts: mesh.submesh_index_counts.clone(),
        ..MeshBuffers::default()
    };
    for (to, from) in apart.uvs.iter_mut().zip(&mesh.uvs) {
        let width = from.components as usize;
        to.components = from.components;
        let values = mesh.indices.iter().flat_map(|&v| &from.values[pick(v) * width..][..width]);
        to.values = values.copied().collect();
    }
    apart
}

#[test]
fn another_order_is_no_fault() {
    for (name, before) in models() {
        let after = chamfered(&before).mesh;
        let mut turned = after.clone();
        turn(&mut turned);
        let mut other = unwelded(&after);
        in_order(&mut other, &shuffled(after.indices.len() / 3));
        let mut both = other.clone();
        turn(&mut both);
        for (how, mesh) in [("turned", turned), ("shuffled", other), ("both", both)] {
            let found = compare(&before.as_mesh(), &mesh.as_mesh(), Verify::Full);
            assert!(found.is_sound(), "{name}, {how}: {found}");
        }
    }
}

/// The flat faces of a box cut along their other diagonals: the same surface.
#[test]
fn another_diagonal_is_no_fault() {
    let before = dressed(shapes::cube(1.0));
    let mut after = chamfered(&before).mesh;
    let [a, b] = [0, 1].map(|t| [0, 1, 2].map(|k| after.indices[3 * t + k]));
    let shared: Vec<u32> = a.into_iter().filter(|vertex| b.contains(vertex)).collect();
    assert_eq!(shared.len(), 2, "the first two triangles are a face");
    let [alone_a, alone_b] =
        [a, b].map(|t| t.into_iter().find(|vertex| !shared.contains(vertex)).unwrap());
    let replaced = |t: [u32; 3], from: u32, to: u32| t.map(|v| if v == from { to } else { v });
    after.indices[..3].copy_from_slice(&replaced(a, shared[0], alone_b));
    after.indices[3..6].copy_from_slice(&replaced(b, shared[1], alone_a));
    let found = compare(&before.as_mesh(), &after.as_mesh(), Verify::Full);
    assert!(found.is_sound(), "{found}");
}
