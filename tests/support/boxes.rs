//! Boxes put together into one mesh: vertices of their own for each face, flat normals.

use std::collections::BTreeMap;

use chamfer::MeshBuffers;
use glam::{DMat3, DVec3};

/// How often a skin is there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Skin {
    Once,
    /// Copied as it is.
    Copied,
    /// A second one inside, back to back.
    TwoSided,
}

/// One box.
#[derive(Clone, Copy, Debug)]
pub struct Block {
    pub low: [f64; 3],
    pub high: [f64; 3],
    /// As bits: the faces that are missing, by axis, the lower one first.
    pub without: u8,
    pub skin: Skin,
    /// As bits: the faces of the first skin that are cut along the other diagonal, and past these
    /// those of the second.
    pub diagonals: u16,
}

impl Block {
    pub fn new(low: [f64; 3], high: [f64; 3]) -> Block {
        Block { low, high, without: 0, skin: Skin::Once, diagonals: 0 }
    }

    pub fn with(self, skin: Skin) -> Block {
        Block { skin, ..self }
    }
}

/// The mesh of all boxes, turned. Equal vertices are one where `is_merged`.
pub fn assembly(blocks: &[Block], turn: DMat3, is_merged: bool) -> MeshBuffers {
    let mut mesh = MeshBuffers::default();
    let mut known = BTreeMap::new();
    for block in blocks {
        add_skin(&mut mesh, block, turn, false, block.diagonals);
        if block.skin != Skin::Once {
            let inward = block.skin == Skin::TwoSided;
            add_skin(&mut mesh, block, turn, inward, block.diagonals >> 6);
        }
    }
    if is_merged {
        let key = |v: u32| {
            let [p, n] = [mesh.positions[v as usize], mesh.normals[v as usize]];
            [p, n].map(|value| value.map(|along| (along + 0.0).to_bits()))
        };
        let merged = mesh.indices.iter().map(|&v| *known.entry(key(v)).or_insert(v)).collect();
        mesh.indices = merged;
    }
    mesh.submesh_index_counts = vec![mesh.indices.len() as u32];
    mesh
}

fn add_skin(mesh: &mut MeshBuffers, block: &Block, turn: DMat3, inward: bool, diagonals: u16) {
    for face in (0..6).filter(|face| block.without >> face & 1 == 0) {
        let (axis, is_high) = (face / 2, face % 2 == 1);
        let ends = [block.low, block.high];
        let corner = |right: usize, up: usize| {
            let mut at = [0.0; 3];
            at[axis] = ends[usize::from(is_high)][axis];
            at[(axis + 1) % 3] = ends[right][(axis + 1) % 3];
            at[(axis + 2) % 3] = ends[up][(axis + 2) % 3];
            turn * DVec3::from(at)
        };
        let mut corners = [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)];
        let faces_up = is_high != inward;
        if !faces_up {
            corners.reverse();
        }
        let normal = turn * DVec3::AXES[axis] * if faces_up { 1.0 } else { -1.0 };
        let first = mesh.positions.len() as u32;
        mesh.positions.extend(corners.map(|corner| corner.as_vec3().to_array()));
        mesh.normals.extend([normal.as_vec3().to_array(); 4]);
        let triangles =
            if diagonals >> face & 1 == 0 { [0, 1, 2, 0, 2, 3] } else { [1, 2, 3, 1, 3, 0] };
        mesh.indices.extend(triangles.map(|corner| first + corner));
    }
}
