//! Everyday solids, and after them shapes that each show one case of the method.

use glam::Vec3;

use super::{BOX_FACES, Builder, Corner, FLOOR, LID, around};
use crate::mesh::{MeshBuffers, UvBuffer};

/// A cube around the origin, its sides of length `size`: 24 vertices, 12 triangles. Each face has
/// its own square in the UV atlas, so that every edge is a seam.
pub fn cube(size: f32) -> MeshBuffers {
    let mut builder = Builder::with_uvs();
    for face in 0..BOX_FACES.len() {
        builder.face(&cube_face(size, face, atlas_square(face)));
    }
    builder.finish()
}

/// A cube around the origin without UVs, its sides of length `size`: 24 vertices, 12 triangles.
pub fn plain_cube(size: f32) -> MeshBuffers {
    let mut builder = Builder::default();
    builder.block([-size / 2.0; 3], [size / 2.0; 3], &[]);
    builder.finish()
}

/// One face of a cube around the origin, with the low and high corner of its UV square.
fn cube_face(size: f32, face: usize, [low, high]: [[f32; 2]; 2]) -> [Corner; 4] {
    let (direction, corners) = BOX_FACES[face];
    let uvs = [low, [high[0], low[1]], high, [low[0], high[1]]];
    [0, 1, 2, 3].map(|corner| {
        let position = corners[corner].map(|end| (end as f32 - 0.5) * size);
        (position, direction.map(|along| along as f32), uvs[corner])
    })
}

/// The low and high corner of a face's square in an atlas of three by two, with a margin.
fn atlas_square(face: usize) -> [[f32; 2]; 2] {
    let (column, row) = (face % 3, face / 3);
    let at = |margin: f32| [(column as f32 + margin) / 3.0, (row as f32 + margin) / 2.0];
    [at(0.05), at(0.95)]
}

/// A cylinder of radius 0.5 and height 1 on the ground: smooth side with a UV seam, flat caps.
/// At least three segments.
pub fn cylinder(segments: u32) -> MeshBuffers {
    let segments = segments.max(3);
    let mut builder = Builder::with_uvs();
    tube(&mut builder, segments, 0.5, [0.0, 1.0]);
    builder.polygon(&circle(segments, 0.5, 1.0));
    builder.polygon(&downward(circle(segments, 0.5, 0.0)));
    builder.finish()
}

/// The smooth side of a cylinder, its u once around, its v from bottom to top.
fn tube(builder: &mut Builder, segments: u32, radius: f32, [low, high]: [f32; 2]) {
    let corner = |step: u32, y: f32, v: f32| {
        // The last step stands where the first does, bit for bit, but has its own u.
        let turns = f64::from(step % segments) / f64::from(segments);
        (around(turns, radius, y), around(turns, 1.0, 0.0), [step as f32 / segments as f32, v])
    };
    for step in 0..segments {
        builder.face(&[
            corner(step, low, 0.0),
            corner(step + 1, low, 0.0),
            corner(step + 1, high, 1.0),
            corner(step, high, 1.0),
        ]);
    }
}

/// `#segments by 3`: a circle around the y axis, counter-clockwise seen from above.
fn circle(segments: u32, radius: f32, y: f32) -> Vec<[f32; 3]> {
    (0..segments).map(|step| around(f64::from(step) / f64::from(segments), radius, y)).collect()
}

/// The same outline, for a face that looks down.
fn downward(mut outline: Vec<[f32; 3]>) -> Vec<[f32; 3]> {
    outline.reverse();
    outline
}

/// A bolt: a hexagonal head (first submesh) on a smooth cylindrical shank (second submesh). The
/// underside of the head is flat, with a hole where the shank begins.
pub fn bolt() -> MeshBuffers {
    const SHANK_RADIUS: f32 = 0.55;
    const SHANK_SEGMENTS: u32 = 18;
    let [tip, neck, top] = [-2.0, 0.0, 0.7];
    let mut builder = Builder::with_uvs();
    let (below, above) = (circle(6, 1.0, neck), circle(6, 1.0, top));
    builder.polygon(&above);
    for side in 0..6 {
        let next = (side + 1) % 6;
        builder.polygon(&[below[side], below[next], above[next], above[side]]);
    }
    head_underside(&mut builder, &below, &circle(SHANK_SEGMENTS, SHANK_RADIUS, neck));
    builder.next_submesh();
    tube(&mut builder, SHANK_SEGMENTS, SHANK_RADIUS, [tip, neck]);
    builder.polygon(&downward(circle(SHANK_SEGMENTS, SHANK_RADIUS, tip)));
    builder.finish()
}

/// A hexagon that looks down, with a hole of three points per side.
fn head_underside(builder: &mut Builder, hexagon: &[[f32; 3]], hole: &[[f32; 3]]) {
    for side in 0..6 {
        let at = |step: usize| hole[(3 * side + step) % hole.len()];
        let next = hexagon[(side + 1) % 6];
        builder.polygon(&[hexagon[side], at(0), at(1), next]);
        builder.polygon(&[next, at(1), at(2), at(3)]);
    }
}

/// A table in one closed body: four legs grow out of the underside of the top. Colours darken
/// toward the ground.
pub fn table() -> MeshBuffers {
    let [ground, underside, top] = [0.0, 0.7, 0.78];
    const XS: [f32; 6] = [-1.0, -0.92, -0.8, 0.8, 0.92, 1.0];
    const ZS: [f32; 6] = [-0.6, -0.52, -0.4, 0.4, 0.52, 0.6];
    let mut builder = Builder::with_uvs();
    builder.block([XS[0], underside, ZS[0]], [XS[5], top, ZS[5]], &[FLOOR]);
    table_underside(&mut builder, |(i, j)| [XS[i], underside, ZS[j]]);
    for (i, j) in [(1, 1), (3, 1), (1, 3), (3, 3)] {
        let foot = [XS[i + 1], underside, ZS[j + 1]];
        builder.block([XS[i], ground, ZS[j]], foot, &[LID]);
    }
    let mut mesh = builder.finish();
    let shade = |&[_, y, _]: &[f32; 3]| [0.3 + 0.6 * y, 0.2 + 0.4 * y, 0.1 + 0.2 * y, 1.0];
    mesh.colors = mesh.positions.iter().map(shade).collect();
    mesh
}

/// The underside on a grid of six by six points, without the legs' cells:
/// ```text
///   +-------------------+
///   | \               / |    The rim has no point between its corners, so that the
///   |  +--+-------+--+  |    table's edges stay whole.
///   |  |L |       |L |  |
///   |  +--+-------+--+  |
///   |  |  |       |  |  |
///   |  +--+-------+--+  |
///   |  |L |       |L |  |
///   |  +--+-------+--+  |
///   | /               \ |
///   +-------------------+
/// ```
fn table_underside(builder: &mut Builder, at: impl Fn((usize, usize)) -> [f32; 3]) {
    for (i, j) in [(2, 1), (1, 2), (2, 2), (3, 2), (2, 3)] {
        builder.polygon(&[(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)].map(&at));
    }
    let mut rim = [(0, 0), (5, 0), (4, 1), (3, 1), (2, 1), (1, 1)];
    for _ in 0..4 {
        builder.polygon(&rim.map(&at));
        rim = rim.map(|(i, j)| (5 - j, i));
    }
}

/// A flat-shaded prism along z of radius 1 and length 2, with `sides` (at least 3) faces around it.
pub fn prism(sides: u32) -> MeshBuffers {
    let outline: Vec<[f32; 2]> =
        circle(sides.max(3), 1.0, 0.0).into_iter().map(|[x, _, z]| [z, x]).collect();
    let mut builder = Builder::default();
    builder.prism(&outline, -1.0, 1.0);
    builder.finish()
}

/// A flat-shaded pyramid of radius and height 1 on the ground, with `sides` (at least 3) faces
/// at the apex.
pub fn pyramid(sides: u32) -> MeshBuffers {
    let base = circle(sides.max(3), 1.0, 0.0);
    let mut builder = Builder::default();
    for (side, &corner) in base.iter().enumerate() {
        builder.polygon(&[corner, base[(side + 1) % base.len()], [0.0, 1.0, 0.0]]);
    }
    builder.polygon(&downward(base));
    builder.finish()
}

/// A smooth unit sphere around the origin with a UV seam; at least two rings of three segments.
pub fn sphere(rings: u32, segments: u32) -> MeshBuffers {
    let (rings, segments) = (rings.max(2), segments.max(3));
    let corner = |ring: u32, step: u32| {
        let (sine, cosine) =
            libm::sincos(f64::from(ring) / f64::from(rings) * std::f64::consts::PI);
        let radius = if ring == rings { 0.0 } else { sine as f32 };
        let turns = f64::from(step % segments) / f64::from(segments);
        let position = around(turns, radius, cosine as f32);
        let uv = [step as f32 / segments as f32, 1.0 - ring as f32 / rings as f32];
        (position, position, uv)
    };
    let mut builder = Builder::with_uvs();
    for (ring, step) in (0..rings).flat_map(|r| (0..segments).map(move |s| (r, s))) {
        let [a, b] = [corner(ring + 1, step), corner(ring + 1, step + 1)];
        let [c, d] = [corner(ring, step + 1), corner(ring, step)];
        match ring {
            0 => builder.face(&[a, b, d]),
            last if last == rings - 1 => builder.face(&[a, c, d]),
            _ => builder.face(&[a, b, c, d]),
        }
    }
    builder.finish()
}

/// Separate flat-shaded unit cubes on a grid, in one mesh: 24 vertices and 12 triangles each,
/// with UVs but no tangents.
pub fn cube_field(cubes: u32) -> MeshBuffers {
    let mut single = Builder::with_uvs();
    for face in 0..BOX_FACES.len() {
        single.face(&cube_face(1.0, face, [[0.0; 2], [1.0; 2]]));
    }
    let single = single.finish();
    let side = libm::ceil(libm::cbrt(f64::from(cubes))) as u32;
    let mut field = MeshBuffers {
        normals: single.normals.repeat(cubes as usize),
        uvs: single.uvs.each_ref().map(|uv| UvBuffer {
            components: uv.components,
            values: uv.values.repeat(cubes as usize),
        }),
        submesh_index_counts: vec![cubes * single.indices.len() as u32],
        ..MeshBuffers::default()
    };
    for cube in 0..cubes {
        let place = [cube % side, cube / side % side, cube / side / side];
        let offset = place.map(|step| 2.0 * step as f32);
        let moved = |p: &[f32; 3]| [p[0] + offset[0], p[1] + offset[1], p[2] + offset[2]];
        let first = field.positions.len() as u32;
        field.indices.extend(single.indices.iter().map(|&index| first + index));
        field.positions.extend(single.positions.iter().map(moved));
    }
    field
}

/// Three unit cubes that extrude from a middle one (thesis 6.2, figure 40). At the inner corner three
/// vertices are corner-connected: each is shared by two coplanar faces that touch nowhere else.
pub fn extruding_cubes() -> MeshBuffers {
    voxels(&[[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])
}

/// A step in two directions: one unit cube on the corner of a floor of four. Where it stands, a convex
/// edge meets two concave ones.
pub fn saddle() -> MeshBuffers {
    voxels(&[[0, 0, 0], [1, 0, 0], [0, 0, 1], [1, 0, 1], [0, 1, 0]])
}

/// The outside of a set of unit cubes, one quad for each free side of a cube.
fn voxels(cells: &[[i32; 3]]) -> MeshBuffers {
    let mut builder = Builder::default();
    for cell in cells {
        for (direction, corners) in BOX_FACES {
            let beside = [0, 1, 2].map(|axis| cell[axis] + direction[axis]);
            if !cells.contains(&beside) {
                let at = |corner: [usize; 3]| {
                    [0, 1, 2].map(|axis| cell[axis] as f32 + corner[axis] as f32)
                };
                builder.polygon(&corners.map(at));
            }
        }
    }
    builder.finish()
}

/// An extruded L of 2 by 2 by 1, with one concave edge.
pub fn l_shape() -> MeshBuffers {
    let mut builder = Builder::with_uvs();
    let outline = [[1.0, 1.0], [1.0, 2.0], [0.0, 2.0], [0.0, 0.0], [2.0, 0.0], [2.0, 1.0]];
    builder.prism(&outline, 0.0, 1.0);
    builder.finish()
}

/// A box whose long edges are divided in four, so that hard edges run on straight through a
/// vertex.
pub fn aligned_strip() -> MeshBuffers {
    const PIECES: usize = 4;
    let mut builder = Builder::with_uvs();
    for piece in 0..PIECES {
        let x = piece as f32;
        // The end faces of a piece: the right one is the first of a box, the left one the second.
        let inner: &[usize] = match piece {
            0 => &[0],
            last if last == PIECES - 1 => &[1],
            _ => &[0, 1],
        };
        builder.block([x, 0.0, 0.0], [x + 1.0, 1.0, 1.0], inner);
    }
    builder.finish()
}

/// A box of 2 by 1 by 2 without lid, of single-sided walls that look outward: open.
pub fn open_box() -> MeshBuffers {
    let mut builder = Builder::with_uvs();
    builder.block([-1.0, 0.0, -1.0], [1.0, 1.0, 1.0], &[LID]);
    builder.finish()
}

/// A square plate of 2 by 0.02 by 2: a hundred times as wide as thick.
pub fn plate() -> MeshBuffers {
    let mut builder = Builder::with_uvs();
    builder.block([-1.0, 0.0, -1.0], [1.0, 0.02, 1.0], &[]);
    builder.finish()
}

/// A wedge along z whose two long faces open by an angle, in radians, from its ridge, which is the
/// z axis from -2 to 2.
pub fn wedge(angle: f32) -> MeshBuffers {
    let mut builder = Builder::default();
    builder.prism(&[[0.0; 2], [1.0, 0.0], [angle.cos(), angle.sin()]], -2.0, 2.0);
    builder.finish()
}

/// A block with a ridge on top that falls into a smooth plain: the ridge's hard edge runs from the
/// rim to the middle of the top and ends there, inside a smooth area.
pub fn wedge_end() -> MeshBuffers {
    let mut builder = Builder::default();
    let bottom = |(x, z): (usize, usize)| [x as f32, 0.0, z as f32];
    for x in 0..2 {
        builder.face(&[(x, 0), (x, 1), (x + 1, 1), (x + 1, 0)].map(|at| ridge_corner(at, -0.5)));
        builder.face(&[(x, 2), (x + 1, 2), (x + 1, 1), (x, 1)].map(|at| ridge_corner(at, 0.5)));
        for z in 0..2 {
            builder.polygon(&[(x, z), (x + 1, z), (x + 1, z + 1), (x, z + 1)].map(bottom));
        }
    }
    let rim = [(0, 0), (0, 1), (0, 2), (1, 2), (2, 2), (2, 1), (2, 0), (1, 0), (0, 0)];
    for pair in rim.windows(2) {
        let [a, b] = [pair[0], pair[1]].map(|at| ridge_corner(at, 0.0).0);
        builder.polygon(&[bottom(pair[0]), bottom(pair[1]), b, a]);
    }
    builder.finish()
}

/// A point of the ridged top on a grid of three by three. Its normal is up, but at the ridge's
/// high end that of the slope, which leans by `lean` along z.
fn ridge_corner((x, z): (usize, usize), lean: f32) -> Corner {
    let high_end = (x, z) == (0, 1);
    let height = if high_end { 1.5 } else { 1.0 };
    let normal = if high_end { Vec3::new(0.5, 1.0, lean).normalize() } else { Vec3::Y };
    ([x as f32, height, z as f32], normal.to_array(), [0.0; 2])
}

/// What two bodies have in common.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Touch {
    /// One corner.
    Vertex,
    /// One edge.
    Edge,
    /// Half of an edge each.
    HalfEdge,
    /// One face.
    Face,
}

/// Two separate closed unit cubes that merely touch and share no vertex index.
pub fn two_cubes_touching(touch: Touch) -> MeshBuffers {
    let low = match touch {
        Touch::Vertex => [1.0, 1.0, 1.0],
        Touch::Edge => [1.0, 1.0, 0.0],
        Touch::HalfEdge => [1.0, 1.0, 0.5],
        Touch::Face => [1.0, 0.0, 0.0],
    };
    let mut builder = Builder::default();
    builder.block([0.0; 3], [1.0; 3], &[]);
    builder.next_body();
    builder.block(low, low.map(|along| along + 1.0), &[]);
    builder.finish()
}
