//! Softens all hard edges of a triangle mesh in the layout of a game engine.
//!
//! At a hard edge the vertices exist twice: same position, different normals. They are pulled
//! apart inside their own faces, and the gap is closed with a strip that shades smoothly from
//! one face normal to the other. The method is that of Diana Algma, *Edge Chamfering Algorithm*
//! (Tartu 2018); `docs/pipeline.md` says where this library goes on from there.
//!
//! A mesh goes in as flat arrays ([`Mesh`]), with the distance that its edges are pulled by; out
//! come the same arrays, where each vertex and triangle is from, and what became of each edge:
//!
//! ```
//! use chamfer::{Options, Outcome, Width, chamfer, shapes};
//!
//! let cube = shapes::plain_cube(2.0);
//! let options = Options { width: Width::Units(0.1), ..Options::default() };
//! let result = chamfer(&cube.as_mesh(), &options)?;
//!
//! assert_eq!(result.mesh.positions.len(), 24);
//! assert_eq!(result.mesh.indices.len() / 3, 44);
//! assert!(result.verdicts.iter().all(|edge| edge.outcome == Outcome::Full));
//! # Ok::<(), chamfer::Error>(())
//! ```

pub mod check;
pub mod see_through;
pub mod shapes;

mod attributes;
mod bvh;
mod contacts;
mod corners;
mod edges;
mod error;
mod faces;
#[allow(unsafe_code)]
mod ffi;
#[cfg(test)]
mod figures;
mod groups;
mod ids;
mod intersect;
mod limits;
mod math;
mod memory;
mod mesh;
mod offsets;
mod options;
mod output;
mod pipeline;
mod placement;
mod plan;
mod refine;
mod report;
mod resample;
mod scene;
mod seams;
mod sectors;
mod smoothing;
mod strips;
mod threads;
mod topology;
mod validity;
mod verdicts;
mod view;
mod weld;

pub use error::{Error, Stream};
pub use memory::most_memory;
pub use mesh::{Held, Mesh, MeshBuffers, UV_CHANNELS, Uv, UvBuffer};
pub use options::{ChamferSubmesh, Options, Verify, Width};
pub use pipeline::{Prepared, chamfer, chamfer_with_progress};
pub use report::{
    Blend, Chamfered, EdgeVerdict, Outcome, Piece, Reason, Totals, TriangleKind, TriangleSource,
    VertexSource, VertexSources,
};
pub use scene::{ChamferedScene, Placed, chamfer_scene, scene_triangles};
pub use smoothing::{Smoothed, split_by_angle};

/// For benchmarks, which time each stage.
#[doc(hidden)]
pub use pipeline::{Stage, chamfer_by_stages};

/// The examples of the README, compiled as tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
