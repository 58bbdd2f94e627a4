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
//! let options = Options::default().with_width(Width::Units(0.1));
//! let result = chamfer(&cube.as_mesh(), &options)?;
//!
//! assert_eq!(result.mesh.positions.len(), 24);
//! assert_eq!(result.mesh.indices.len() / 3, 44);
//! assert!(result.verdicts.iter().all(|edge| edge.outcome == Outcome::Full));
//! # Ok::<(), chamfer::Error>(())
//! ```
//!
//! # What may grow
//! A later version may add to what is `#[non_exhaustive]`:
//! - [`Options`] and [`see_through::Eyes`], made from their defaults by `with_..`, or by setting fields;
//! - choices, reasons and errors ([`Width`], [`WidthMode`], [`Convexity`], [`Verify`], [`ChamferSubmesh`], [`Reason`], [`Stream`],
//!   [`Error`]): a `match` has an arm for those to come;
//! - reports ([`Chamfered`], [`ChamferedScene`], [`Smoothed`], [`Totals`] with its [`ByReason`],
//!   [`see_through::Leak`], and those of the checker), which callers read; who makes a [`Chamfered`] of
//!   their own sets the fields of its default.
//!
//! [`Mesh`] and [`MeshBuffers`] may get further streams too, but are written down as literals by every
//! caller: end those with `..Mesh::default()`, and a new stream is absent. All else is what it is:
//! [`Held`], [`Factors`], [`EdgeFactor`], [`Placed`], [`Uv`] and [`UvBuffer`], and the elements of results ([`EdgeVerdict`],
//! [`Blend`], [`VertexSource`], [`TriangleSource`], with [`Outcome`] and [`TriangleKind`]), which lie in
//! memory as in the C interface.
//!
//! # Features
//! - `parallel` (default): shares the work on one large mesh out among threads.
//! - `check`: the checker of whole meshes; in the repository only, not in the published crate.
//! - `shapes`: models made by code, for demonstrations and tests.
//! - `header`: makes the C header anew, for the library's own tests.

#![warn(missing_debug_implementations)]

#[cfg(feature = "check")]
pub mod check;
pub mod see_through;
#[cfg(feature = "shapes")]
pub mod shapes;

mod apart;
mod attributes;
mod blocks;
mod breaks;
mod bvh;
mod chamfers;
mod charts;
mod closers;
mod contacts;
mod edges;
mod error;
mod evenness;
mod faces;
#[allow(unsafe_code)]
mod ffi;
#[cfg(test)]
mod figures;
mod fills;
mod flaps;
mod foot;
mod given;
mod groups;
mod ids;
mod inside_out;
mod intersect;
mod joined;
mod limits;
mod line;
mod lines;
mod math;
mod memory;
mod mesh;
mod offsets;
mod options;
mod output;
mod patches;
mod pipeline;
mod placement;
mod ranks;
mod refine;
mod report;
mod resample;
mod rests;
mod room;
mod rounding;
mod scale;
mod scene;
mod sectors;
mod selection;
mod shape;
mod smoothing;
#[cfg(test)]
mod stages;
mod strips;
mod surface;
mod threads;
mod tolerance;
mod topology;
mod unpaired;
mod validity;
mod vanishing;
mod verdicts;
mod view;
mod watch;
mod weld;

pub use error::{Error, Stream};
pub use mesh::{EdgeFactor, Factors, Held, Mesh, MeshBuffers, UV_CHANNELS, Uv, UvBuffer};
pub use options::{ChamferSubmesh, Convexity, MOST_SEGMENTS, Options, Verify, Width, WidthMode};
pub use pipeline::{chamfer, chamfer_with_progress};
pub use report::{
    Blend, ByReason, Chamfered, EdgeVerdict, Outcome, Piece, Reason, Totals, TriangleKind,
    TriangleSource, VertexSource, VertexSources,
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
