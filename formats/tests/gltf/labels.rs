//! Numbers that name something are never mixed: a triangle has one.

use chamfer::{MeshBuffers, Options, TriangleKind, Width, chamfer, shapes};
use chamfer_formats::{Document, encode};
use serde_json::json;

use crate::support::{Model, SQUARE, Written, folder, json_of};

/// A cube, each of whose faces is a feature: as floats, as a short, and as two numbers of its own.
fn cube() -> Model {
    let MeshBuffers { positions, normals, indices, .. } = shapes::plain_cube(1.0);
    let face = |vertex: usize| vertex / 4;
    let mut model = Model::new();
    let floats: Vec<[f32; 1]> = (0..24).map(|vertex| [10.0 * face(vertex) as f32]).collect();
    let shorts: Vec<u8> =
        (0..24).flat_map(|vertex| [(face(vertex) as u16).to_le_bytes(), [0; 2]].concat()).collect();
    let pairs: Vec<u8> = (0..24).flat_map(|vertex| [face(vertex) as u8, 7, 0, 0]).collect();
    let attributes = json!({
        "POSITION": model.positions(&positions),
        "NORMAL": model.floats(&normals),
        "_FEATURE_ID_0": model.floats(&floats),
        "_FEATURE_ID_1": model.accessor(5123, "VEC2", 24, &shorts),
        "_OWN": model.accessor(5121, "VEC4", 24, &pairs),
    });
    let bytes: Vec<u8> = indices.iter().map(|index| *index as u8).collect();
    let indices = model.indices(&bytes);
    model.mesh(json!([{"attributes": attributes, "indices": indices}]));
    model
}

fn indices(written: &Written) -> Vec<usize> {
    let accessor = written.accessor("/meshes/0/primitives/0/indices");
    assert_eq!(accessor["componentType"], 5123);
    let (words, _) = written.bytes(accessor).as_chunks();
    words.iter().map(|word| u16::from_le_bytes(*word).into()).collect()
}

#[test]
fn every_triangle_is_of_one_feature() {
    let document = cube().read("labels").unwrap();
    let options = Options::default().with_width(Width::Units(0.2));
    let result = chamfer(&document.meshes()[0].mesh.as_mesh(), &options).unwrap();
    assert_eq!(result.totals.chamfered, 12);
    let triangles = result.triangle_sources.clone();
    let files = encode(&document, &folder("labels").join("out.glb"), &[result]).unwrap().files;
    let start = u32::from_le_bytes(files[0].bytes[12..16].try_into().unwrap()) as usize + 28;
    let written =
        Written { json: json_of(&files[0].bytes), bytes: files[0].bytes[start..].to_vec() };
    let attribute = |name: &str| format!("/meshes/0/primitives/0/attributes/{name}");
    let floats = written.floats(&attribute("_FEATURE_ID_0"));
    let own = written.bytes(written.accessor(&attribute("_OWN"))).to_vec();
    let mut of_chamfer = std::collections::HashMap::new();
    let indices = indices(&written);
    assert_eq!(indices.len(), 44 * 3);
    for (corners, source) in indices.chunks_exact(3).zip(&triangles) {
        let faces = [0, 1, 2].map(|corner| floats[corners[corner]]);
        assert_eq!(faces, [faces[0]; 3]);
        for corner in corners {
            assert_eq!(own[4 * corner..4 * corner + 2], [(faces[0] / 10.0) as u8, 7]);
        }
        match source.kind {
            TriangleKind::Source => assert_eq!(faces[0], 10.0 * (source.index / 2) as f32),
            kind => {
                let first = of_chamfer.entry((kind as u32, source.index)).or_insert(faces[0]);
                assert_eq!(*first, faces[0], "both halves of a chamfer are of one feature");
            }
        }
    }
}

/// Two halves of a square are the same but for their labels, and the core may join their vertices.
#[test]
fn faces_that_differ_only_in_their_labels_keep_them() {
    //  3---2   and a wall down from 0-1
    //  | / |
    //  0---1
    let [a, b, c, d] = SQUARE;
    let (e, f) = ([0.0, 0.0, -1.0], [1.0, 0.0, -1.0]);
    let positions = [a, b, c, a, c, d, a, b, e, f];
    let mut normals = [[0.0f32, 0.0, 1.0]; 10];
    normals[6..].fill([0.0, -1.0, 0.0]);
    let mut model = Model::new();
    let labels: Vec<u8> =
        [1u8, 1, 1, 2, 2, 2, 3, 3, 3, 3].iter().flat_map(|&l| [l, 0, 0, 0]).collect();
    let attributes = json!({
        "POSITION": model.positions(&positions),
        "NORMAL": model.floats(&normals),
        "_PART": model.accessor(5121, "VEC4", 10, &labels),
    });
    let indices = model.indices(&[0, 1, 2, 3, 4, 5, 6, 8, 9, 6, 9, 7]);
    model.mesh(json!([{"attributes": attributes, "indices": indices}]));
    let document = model.read("labels_flat").unwrap();
    let options = Options::default().with_width(Width::Units(0.1));
    let result = chamfer(&document.meshes()[0].mesh.as_mesh(), &options).unwrap();
    assert_eq!(result.totals.hard_edges, 1);
    assert_eq!(result.totals.chamfered, 1);
    let files = encode(&document, &folder("labels_flat").join("o.glb"), &[result]).unwrap().files;
    let start = u32::from_le_bytes(files[0].bytes[12..16].try_into().unwrap()) as usize + 28;
    let written =
        Written { json: json_of(&files[0].bytes), bytes: files[0].bytes[start..].to_vec() };
    let labels = written.accessor("/meshes/0/primitives/0/attributes/_PART");
    let labels = written.bytes(labels);
    let corners = self::indices(&written);
    let told: Vec<u8> = corners[..12].iter().map(|corner| labels[4 * corner]).collect();
    assert_eq!(told, [1, 1, 1, 2, 2, 2, 3, 3, 3, 3, 3, 3]);
}
