//! Small models made by code, for demonstrations and tests.
//!
//! All have split vertices as an engine holds them, stand upright along y, and are wound so that
//! `cross(b - a, c - a)` points outward. Unless their text says otherwise they are closed, have
//! one submesh and no UVs; shapes with UVs have tangents too.

mod builder;
mod cases;
mod solids;

use crate::mesh::MeshBuffers;

pub use cases::{
    Touch, aligned_strip, extruding_cubes, l_shape, open_box, plate, saddle, two_cubes_touching,
    wedge, wedge_end,
};
pub use solids::{bolt, cube, cube_field, cylinder, plain_cube, prism, pyramid, sphere, table};

/// The demonstration models and their names.
pub fn demo_models() -> Vec<(&'static str, MeshBuffers)> {
    vec![
        ("cube", cube(1.0)),
        ("bolt", bolt()),
        ("cylinder", cylinder(24)),
        ("extruding_cubes", extruding_cubes()),
        ("table", table()),
        ("l_shape", l_shape()),
    ]
}

#[cfg(test)]
mod tests;
