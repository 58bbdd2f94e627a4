//! The stages in their order: the only file that knows it.

use std::ops::ControlFlow;

use crate::attributes::attributes;
use crate::edges::edges;
use crate::error::Error;
use crate::faces::faces;
use crate::limits::limits;
use crate::mesh::Mesh;
use crate::offsets::offsets;
use crate::options::Options;
use crate::output::output;
use crate::plan::Plan;
use crate::report::Chamfered;
use crate::sectors::sectors;
use crate::strips::strips;
use crate::topology::topology;
use crate::view::view;
use crate::weld::weld;

/// Chamfers all hard edges of a mesh.
///
/// # Errors
/// Whatever is wrong with the mesh or the options: see [`Error`].
pub fn chamfer(mesh: &Mesh, options: &Options) -> Result<Chamfered, Error> {
    chamfer_with_progress(mesh, options, &mut |_| ControlFlow::Continue(()))
}

/// As [`chamfer`], calling `progress` between stages with the share done (0 to 1).
///
/// # Errors
/// As [`chamfer`]; [`Error::Cancelled`] where `progress` breaks.
pub fn chamfer_with_progress(
    mesh: &Mesh,
    options: &Options,
    progress: &mut dyn FnMut(f32) -> ControlFlow<()>,
) -> Result<Chamfered, Error> {
    chamfer_by_stages(mesh, options, &mut |stage| progress(stage.share_done()))
}

/// A stage of the pipeline that can be timed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs)] // Each is explained under its name in docs/pipeline.md.
pub enum Stage {
    View,
    Weld,
    Topology,
    Faces,
    Edges,
    Sectors,
    Offsets,
    Limits,
    Strips,
    Attributes,
    Output,
}

impl Stage {
    /// How much of a typical call is done when the stage ends.
    fn share_done(self) -> f32 {
        match self {
            Stage::View => 0.02,
            Stage::Weld => 0.05,
            Stage::Topology => 0.12,
            Stage::Faces => 0.14,
            Stage::Edges => 0.16,
            Stage::Sectors => 0.2,
            Stage::Offsets => 0.25,
            Stage::Limits => 0.5,
            Stage::Strips => 0.52,
            Stage::Attributes => 0.6,
            Stage::Output => 1.0,
        }
    }
}

/// As [`chamfer`], calling `after` whenever a stage ends.
///
/// # Errors
/// As [`chamfer`]; [`Error::Cancelled`] where `after` breaks.
pub fn chamfer_by_stages(
    mesh: &Mesh,
    options: &Options,
    after: &mut dyn FnMut(Stage) -> ControlFlow<()>,
) -> Result<Chamfered, Error> {
    let mut done = |stage: Stage| match after(stage) {
        ControlFlow::Continue(()) => Ok(()),
        ControlFlow::Break(()) => Err(Error::Cancelled),
    };
    let plan = plan(mesh, options, &mut done)?;
    let limits = limits(&plan, options.verify);
    done(Stage::Limits)?;
    let cuts = strips(&plan, &limits.placement);
    done(Stage::Strips)?;
    let attributes = attributes(&plan, &limits.placement);
    done(Stage::Attributes)?;
    let chamfered = output(&plan, &limits, &cuts, attributes, options.chamfer_submesh);
    done(Stage::Output)?;
    Ok(chamfered)
}

/// The stages up to the offsets.
pub(crate) fn plan<'a>(
    mesh: &Mesh<'a>,
    options: &Options,
    done: &mut dyn FnMut(Stage) -> Result<(), Error>,
) -> Result<Plan<'a>, Error> {
    let view = view(mesh, options)?;
    done(Stage::View)?;
    let weld = weld(mesh);
    done(Stage::Weld)?;
    let topology = topology(&view, &weld);
    done(Stage::Topology)?;
    let faces = faces(&view, &topology);
    done(Stage::Faces)?;
    let edges = edges(&view, &topology, &faces);
    done(Stage::Edges)?;
    let sectors = sectors(&topology, &edges);
    done(Stage::Sectors)?;
    let offsets = offsets(&view, &topology, &faces, &sectors);
    done(Stage::Offsets)?;
    Ok(Plan { view, weld, topology, faces, edges, sectors, offsets })
}
