//! Large meshes of many parts are chamfered block by block: as they would be at once.

#[allow(dead_code)]
#[path = "support/boxes.rs"]
mod boxes;

use std::ops::ControlFlow;

use chamfer::check::assert_sound;
use chamfer::{
    ChamferSubmesh, Chamfered, MeshBuffers, Options, TriangleKind, Verify, Width, chamfer,
    chamfer_by_stages, chamfer_with_progress, shapes,
};

use boxes::{Block, assembly};

/// Bolts of two submeshes, of many sizes, in rows: some fifty thousand triangles.
fn many() -> MeshBuffers {
    let bolt = shapes::bolt();
    let mut all = MeshBuffers { submesh_index_counts: vec![0; 2], ..MeshBuffers::default() };
    for channel in 0..all.uvs.len() {
        all.uvs[channel].components = bolt.uvs[channel].components;
    }
    let counts: Vec<usize> =
        bolt.submesh_index_counts.iter().map(|&count| count as usize).collect();
    let mut indices = [vec![], vec![]];
    for k in 0..500u32 {
        let first = all.positions.len() as u32;
        let (size, row) = (1.0 + (k % 7) as f32 / 8.0, (k / 25) as f32);
        let at = |[x, y, z]: [f32; 3]| {
            [x * size + 8.0 * (k % 25) as f32, y * size, z * size + 8.0 * row]
        };
        all.positions.extend(bolt.positions.iter().map(|&position| at(position)));
        all.normals.extend(&bolt.normals);
        all.tangents.extend(&bolt.tangents);
        all.colors.extend(&bolt.colors);
        for (all, own) in all.uvs.iter_mut().zip(&bolt.uvs) {
            all.values.extend(&own.values);
        }
        let moved = |range: &[u32]| range.iter().map(|index| first + index).collect::<Vec<_>>();
        indices[0].extend(moved(&bolt.indices[..counts[0]]));
        indices[1].extend(moved(&bolt.indices[counts[0]..]));
    }
    all.submesh_index_counts = indices.iter().map(|own| own.len() as u32).collect();
    all.indices = indices.concat();
    assert!(all.indices.len() / 3 > 33_000, "{}", all.indices.len() / 3);
    all
}

/// Boxes of which two share a corner of their tops, where one of them gets a vertex of its own; the top of
/// the first is in two halves, so that its walls come in pieces; in two submeshes, with a texture.
///
/// ```text
///                 +--------+
///                 | second |      seen from above
///   +------+------+--------+
///   |    first    |
///   +------+------+
/// ```
fn corner_to_corner() -> MeshBuffers {
    const ALL_BUT_TOP: u8 = 0b01_1111;
    let (mut tops_and_second, mut walls) = (Vec::new(), Vec::new());
    for k in 0..1500 {
        let (x, y) = (6.0 * f64::from(k % 40), 4.0 * f64::from(k / 40));
        let block = |[x0, x1]: [f64; 2], y0: f64, without: u8| Block {
            without,
            ..Block::new([x + x0, y + y0, 0.0], [x + x1, y + y0 + 1.0, 1.0])
        };
        walls.push(block([0.0, 3.0], 0.0, !ALL_BUT_TOP));
        tops_and_second.push(block([0.0, 1.5], 0.0, ALL_BUT_TOP));
        tops_and_second.push(block([1.5, 3.0], 0.0, ALL_BUT_TOP));
        tops_and_second.push(block([3.0, 4.0], 1.0, 0));
    }
    let of_walls = 30 * walls.len() as u32;
    tops_and_second.append(&mut walls);
    let mut mesh = assembly(&tops_and_second, glam::DMat3::IDENTITY, true);
    mesh.submesh_index_counts = vec![mesh.indices.len() as u32 - of_walls, of_walls];
    mesh.uvs[0].components = 2;
    for (position, normal) in mesh.positions.iter().zip(&mesh.normals) {
        let axis = (0..3).find(|&axis| normal[axis] != 0.0).expect("it points somewhere");
        mesh.uvs[0].values.extend([position[(axis + 1) % 3], position[(axis + 2) % 3]]);
    }
    mesh
}

fn at_once(mesh: &MeshBuffers, options: &Options) -> Chamfered {
    chamfer_by_stages(&mesh.as_mesh(), options, &mut |_| ControlFlow::Continue(())).unwrap()
}

fn options(target: ChamferSubmesh) -> Options {
    let options = Options::default().with_width(Width::Units(0.05)).with_verify(Verify::Fast);
    options.with_chamfer_submesh(target)
}

/// Each triangle by its submesh and all that its corners have, and where it came from, in an order of
/// its own.
fn triangles(result: &Chamfered) -> Vec<Vec<u32>> {
    let (mesh, mut first, mut all) = (&result.mesh, 0, Vec::new());
    for (submesh, count) in mesh.submesh_index_counts.iter().enumerate() {
        for triangle in first..first + *count as usize / 3 {
            let source = result.triangle_sources[triangle];
            let mut told = vec![submesh as u32, source.kind as u32];
            told.extend(match source.kind {
                TriangleKind::Edge => result.verdicts[source.index as usize].vertices,
                _ => [source.index; 2],
            });
            for &vertex in &mesh.indices[3 * triangle..3 * triangle + 3] {
                let at = vertex as usize;
                told.extend(
                    mesh.positions[at].iter().chain(&mesh.normals[at]).map(|x| x.to_bits()),
                );
                for uv in mesh.uvs.iter().filter(|uv| uv.components > 0) {
                    let width = uv.components as usize;
                    told.extend(uv.values[at * width..][..width].iter().map(|x| x.to_bits()));
                }
                let from = result.vertex_sources.get(at);
                told.extend(from.surface.vertices.iter().chain(&from.chart.vertices));
                told.extend(from.owner.vertices.iter().chain([&from.owner_channels]));
                told.extend(from.owner.weights.map(f32::to_bits));
            }
            all.push(told);
        }
        first += *count as usize / 3;
    }
    all.sort_unstable();
    all
}

/// Each piece by the triangle that it is of, and where it lies there, in an order of its own.
fn pieces(result: &Chamfered) -> Vec<(u32, Vec<u32>)> {
    let told = |piece: &chamfer::Piece| {
        let source = result.triangle_sources[piece.triangle as usize];
        assert_eq!(source.kind, TriangleKind::Source);
        (source.index, piece.corners.as_flattened().iter().map(|weight| weight.to_bits()).collect())
    };
    let mut all: Vec<_> = result.pieces.iter().map(told).collect();
    all.sort_unstable();
    all
}

#[test]
fn blocks_change_nothing_but_the_order() {
    let mesh = corner_to_corner();
    let result = chamfer(&mesh.as_mesh(), &options(ChamferSubmesh::Owner)).unwrap();
    let new: Vec<_> = result.vertex_sources.iter().skip(mesh.positions.len()).collect();
    let moved = new.iter().filter(|new| new.owner_channels == 0).count();
    let pieces = result.pieces.len();
    assert!(moved >= 1000 && new.len() > moved + 20_000 && pieces > 800, "{moved} {pieces}");
    for mesh in [many(), mesh] {
        blocks_are_as_the_whole(&mesh);
    }
}

fn blocks_are_as_the_whole(mesh: &MeshBuffers) {
    for target in [ChamferSubmesh::Owner, ChamferSubmesh::Own, ChamferSubmesh::Given(1)] {
        let options = options(target);
        let (whole, joined) =
            (at_once(mesh, &options), chamfer(&mesh.as_mesh(), &options).unwrap());
        assert_eq!(triangles(&whole), triangles(&joined));
        assert_eq!(pieces(&whole), pieces(&joined));
        assert!(joined.pieces.is_sorted_by_key(|piece| piece.triangle));
        assert_eq!(whole.mesh.positions.len(), joined.mesh.positions.len());
        let sorted = |result: &Chamfered| {
            let mut verdicts: Vec<_> =
                result.verdicts.iter().map(|v| (v.vertices, v.widths.map(f32::to_bits))).collect();
            verdicts.sort_unstable();
            verdicts
        };
        assert_eq!(sorted(&whole), sorted(&joined));
        assert_eq!(whole.totals.chamfered, joined.totals.chamfered);
        assert!((whole.totals.mean_width - joined.totals.mean_width).abs() < 1e-5);
        assert_eq!((whole.width, whole.largest_width), (joined.width, joined.largest_width));
        let sources = mesh.positions.len();
        assert_eq!(whole.mesh.positions[..sources], joined.mesh.positions[..sources]);
        assert!(whole.mesh.indices != joined.mesh.indices, "it was done at once");
        let old = mesh.submesh_index_counts[0] as usize;
        assert_eq!(whole.triangle_sources[..old / 3], joined.triangle_sources[..old / 3]);
        // A vertex that has moved away has another number.
        let mut indices = whole.mesh.indices[..old].iter().zip(&joined.mesh.indices[..old]);
        assert!(indices.all(|(&one, &other)| {
            one == other || [one, other].iter().all(|&vertex| vertex as usize >= sources)
        }));
    }
}

#[test]
fn the_result_is_sound_and_the_same_for_any_number_of_threads() {
    let mesh = many();
    let options = options(ChamferSubmesh::Owner);
    let one = chamfer(&mesh.as_mesh(), &options).unwrap();
    let three = chamfer(&mesh.as_mesh(), &options.with_threads(3)).unwrap();
    assert!(one.mesh == three.mesh && one.verdicts == three.verdicts);
    assert!(one.vertex_sources == three.vertex_sources);
    assert_sound("bolts", &mesh.as_mesh(), &one);
    let mesh = corner_to_corner();
    assert_sound("boxes", &mesh.as_mesh(), &chamfer(&mesh.as_mesh(), &options).unwrap());
}

/// What is told of some bolts, and of the result, if the caller breaks when it is told so often.
fn told(mesh: &MeshBuffers, threads: u32, last: usize) -> (bool, Vec<f32>) {
    let mut shares = Vec::new();
    let options = options(ChamferSubmesh::Owner).with_threads(threads);
    let result = chamfer_with_progress(&mesh.as_mesh(), &options, &mut |share| {
        shares.push(share);
        if shares.len() < last { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    });
    (matches!(result, Err(chamfer::Error::Cancelled)), shares)
}

#[test]
fn it_tells_how_far_it_is_and_can_be_cancelled() {
    let mesh = many();
    let (is_cancelled, all) = told(&mesh, 1, usize::MAX);
    assert!(!is_cancelled && all.is_sorted() && all.last() == Some(&1.0), "{all:?}");
    let mut ends = all.clone();
    ends.dedup();
    // Blocks are of two thousand triangles and more each; what is left when the last is done is little.
    assert!(ends.len() > 5 && ends.contains(&0.98), "{ends:?}");
    for &end in &ends[..ends.len() - 2] {
        let times = all.iter().filter(|&&share| share == end).count();
        assert!(times > 2, "within {end} it is told {times} times");
    }
    for last in [1, 3, all.len() / 2, all.len() - 2, all.len()] {
        assert_eq!(told(&mesh, 1, last), (true, all[..last].to_vec()));
        let (is_cancelled, shares) = told(&mesh, 2, last.min(4));
        assert!(is_cancelled && shares.len() == last.min(4) && shares.is_sorted(), "{shares:?}");
    }
}
