//! Shapes that each show one case of the method.

use glam::Vec3;

use super::builder::{BOX_FACES, Builder, Corner, LID};
use crate::mesh::MeshBuffers;

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
