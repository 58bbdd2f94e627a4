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
    let mut done = |share: f32| match progress(share) {
        ControlFlow::Continue(()) => Ok(()),
        ControlFlow::Break(()) => Err(Error::Cancelled),
    };
    let plan = plan(mesh, options, &mut done)?;
    let limits = limits(&plan, options.verify);
    done(0.8)?;
    let attributes = attributes(&plan, &limits.placement);
    let chamfered = output(&plan, &limits, attributes, options.chamfer_submesh);
    done(1.0)?;
    Ok(chamfered)
}

/// The stages up to the offsets.
pub(crate) fn plan<'a>(
    mesh: &Mesh<'a>,
    options: &Options,
    done: &mut dyn FnMut(f32) -> Result<(), Error>,
) -> Result<Plan<'a>, Error> {
    let view = view(mesh, options)?;
    let weld = weld(mesh);
    done(0.1)?;
    let topology = topology(&view, &weld);
    let faces = faces(&view, &topology);
    let edges = edges(&view, &topology, &faces);
    done(0.3)?;
    let sectors = sectors(&topology, &edges);
    let offsets = offsets(&view, &topology, &faces, &sectors);
    done(0.4)?;
    Ok(Plan { view, topology, faces, edges, sectors, offsets })
}
