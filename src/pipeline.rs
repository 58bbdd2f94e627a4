//! The stages in their order: the only file that knows it.

use std::fmt;
use std::ops::ControlFlow;

use crate::attributes::attributes;
use crate::contacts::contacts;
use crate::edges::{edges, may_be_hard};
use crate::error::Error;
use crate::faces::faces;
use crate::ids::{IdVec, Sector};
use crate::limits::limits;
use crate::memory;
use crate::mesh::Mesh;
use crate::offsets::{Known, Offset, offsets};
use crate::options::{Options, Verify, Width};
use crate::output::{output, unchanged};
use crate::plan::{Plan, Shape};
use crate::refine::{Origins, Refined, refine, restored, shape as finer_shape};
use crate::report::Chamfered;
use crate::scene::{Placed, chamfer_scene};
use crate::sectors::sectors;
use crate::see_through::Eyes;
use crate::strips::strips;
use crate::topology::topology;
use crate::view::{View, view, view_of_checked};
use crate::weld::{Weld, weld};

/// Chamfers all hard edges of a mesh: the method of the thesis (Algma 2018, chapter 6), as
/// `docs/pipeline.md` goes on from there.
///
/// The result depends on nothing but the mesh and the options, to the last bit. At width 0, or
/// without hard edges, it is the mesh as it was. Time and memory grow linearly with the mesh.
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
    if options.verify != Verify::Seen {
        return chamfer_by_stages(mesh, options, &mut |stage| progress(stage.share_done()));
    }
    let alone = [Placed { mesh: 0, transform: IDENTITY }];
    // It may be done again, but what is told never falls.
    let mut told = 0.0_f32;
    let each = Options { verify: Verify::Full, ..*options };
    memory::ask(memory::of_looking(mesh))?;
    let mut run = |_: usize, mesh: &Mesh| {
        chamfer_by_stages(mesh, &each, &mut |stage| {
            told = told.max(stage.share_done());
            progress(told)
        })
    };
    let eyes = Some(Eyes::default().with_threads(options.threads));
    let mut scene = chamfer_scene(&[*mesh], &alone, eyes, &mut run)?;
    Ok(scene.meshes.swap_remove(0))
}

/// Where a mesh stands that is alone.
const IDENTITY: [[f32; 4]; 4] =
    [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]];

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
    let mut done = or_cancelled(after);
    let view = view(mesh, options)?;
    done(Stage::View)?;
    let shape = find_shape(&view, &mut done)?;
    chamfer_shape(view, shape.as_ref(), options, &mut done)
}

/// A mesh with all that is known of it before anybody asks for a width: dragging one only takes
/// the rest.
///
/// ```
/// use chamfer::{Options, Prepared, Width, shapes};
///
/// let cube = shapes::cube(2.0);
/// let prepared = Prepared::new(&cube.as_mesh())?;
/// for step in 1..5 {
///     let width = Width::Units(step as f32 / 10.0);
///     let result = prepared.chamfer(&Options::default().with_width(width))?;
///     assert_eq!(result.width, step as f32 / 10.0);
/// }
/// # Ok::<(), chamfer::Error>(())
/// ```
#[derive(Clone)]
pub struct Prepared<'a> {
    mesh: Mesh<'a>,
    /// None where nothing can be hard.
    shape: Option<Shape>,
}

impl fmt::Debug for Prepared<'_> {
    /// Of what it knows, only how much: arrays as long as the mesh help nobody.
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let hard_edges = self.shape.as_ref().map_or(0, |shape| shape.edges.hard.len());
        let triangles = self.mesh.indices.len() / 3;
        let mut shown = f.debug_struct("Prepared");
        shown
            .field("triangles", &triangles)
            .field("hard_edges", &hard_edges)
            .finish_non_exhaustive()
    }
}

impl<'a> Prepared<'a> {
    /// Finds the hard edges of a mesh, and what moves together around them. The mesh stays
    /// borrowed, so it cannot change in the meantime.
    ///
    /// # Errors
    /// Whatever is wrong with the mesh: see [`Error`].
    pub fn new(mesh: &Mesh<'a>) -> Result<Prepared<'a>, Error> {
        let none = Options { width: Width::Units(0.0), threads: 1, ..Options::default() };
        let view = view(mesh, &none)?;
        Ok(Prepared { mesh: *mesh, shape: find_shape(&view, &mut |_| Ok(()))? })
    }

    /// From what [`Prepared::into_shape`] gave for this very mesh.
    pub(crate) fn of_shape(mesh: Mesh<'a>, shape: Option<Shape>) -> Prepared<'a> {
        Prepared { mesh, shape }
    }

    /// What was found out, without the mesh.
    pub(crate) fn into_shape(self) -> Option<Shape> {
        self.shape
    }

    /// The same as [`chamfer`](crate::chamfer()) of the mesh, sooner.
    ///
    /// # Errors
    /// Whatever is wrong with the options: see [`Error`].
    pub fn chamfer(&self, options: &Options) -> Result<Chamfered, Error> {
        self.chamfer_with_progress(options, &mut |_| ControlFlow::Continue(()))
    }

    /// As [`Prepared::chamfer`], calling `progress` between stages with the share done (0 to 1).
    ///
    /// # Errors
    /// As [`Prepared::chamfer`]; [`Error::Cancelled`] where `progress` breaks.
    pub fn chamfer_with_progress(
        &self,
        options: &Options,
        progress: &mut dyn FnMut(f32) -> ControlFlow<()>,
    ) -> Result<Chamfered, Error> {
        if options.verify == Verify::Seen {
            // What leaks changes what is held, and so all that was prepared.
            return chamfer_with_progress(&self.mesh, options, progress);
        }
        let view = view_of_checked(&self.mesh, options)?;
        let mut after = |stage: Stage| progress(stage.share_done());
        chamfer_shape(view, self.shape.as_ref(), options, &mut or_cancelled(&mut after))
    }
}

fn or_cancelled(
    after: &mut dyn FnMut(Stage) -> ControlFlow<()>,
) -> impl FnMut(Stage) -> Result<(), Error> {
    |stage| match after(stage) {
        ControlFlow::Continue(()) => Ok(()),
        ControlFlow::Break(()) => Err(Error::Cancelled),
    }
}

/// Told whenever a stage ends; an error ends the call.
type Done<'a> = dyn FnMut(Stage) -> Result<(), Error> + 'a;

/// The stages that no width has a say in; none where nothing can be hard.
fn find_shape(view: &View, done: &mut Done) -> Result<Option<Shape>, Error> {
    let weld = weld(&view.mesh);
    done(Stage::Weld)?;
    if !may_be_hard(view, &weld) {
        return Ok(None);
    }
    memory::ask(memory::up_to_edges(&view.mesh))?;
    shape(view, weld, done).map(Some)
}

pub(crate) fn shape(view: &View, weld: Weld, done: &mut Done) -> Result<Shape, Error> {
    let topology = topology(view, &weld);
    done(Stage::Topology)?;
    let faces = faces(view, &topology);
    done(Stage::Faces)?;
    let contacts = contacts(view, &topology, &faces)?;
    let edges = edges(view, &topology, &faces, &contacts);
    done(Stage::Edges)?;
    memory::ask(memory::of_sectors(edges.hard.len()))?;
    let sectors = sectors(view, &topology, &edges, &contacts);
    done(Stage::Sectors)?;
    Ok(Shape {
        weld: weld.into(),
        topology: topology.into(),
        faces: faces.into(),
        contacts: contacts.into(),
        edges: edges.into(),
        sectors: sectors.into(),
    })
}

/// All that is known before the limits.
#[cfg(test)]
pub(crate) fn plan<'a>(view: View<'a>, shape: &Shape) -> Plan<'a> {
    let offsets = offsets_of(&view, shape, None);
    Plan::new(view, shape, offsets)
}

fn offsets_of(view: &View, shape: &Shape, known: Option<&Known>) -> IdVec<Sector, Offset> {
    offsets(view, &shape.topology, &shape.faces, &shape.sectors, known)
}

/// The stages that depend on the width. Where only a part of an edge can have a chamfer, the mesh
/// gets vertices before it goes on.
fn chamfer_shape(
    view: View,
    shape: Option<&Shape>,
    options: &Options,
    done: &mut Done,
) -> Result<Chamfered, Error> {
    let Some(shape) = shape else {
        memory::ask(memory::of_copy(&view.mesh))?;
        let chamfered = unchanged(&view, options.chamfer_submesh);
        done(Stage::Output)?;
        return Ok(chamfered);
    };
    memory::ask(memory::of_chamfers(&view.mesh, shape.work()))?;
    let offsets = offsets_of(&view, shape, None);
    match refine(&view, shape, &offsets)? {
        Some(refined) => chamfer_refined(view, shape, offsets, &refined, options, done),
        None => {
            done(Stage::Offsets)?;
            chamfer_plan(&Plan::new(view, shape, offsets), options, done)
        }
    }
}

/// The same on a finer mesh.
fn chamfer_refined(
    view: View,
    shape: &Shape,
    offsets: IdVec<Sector, Offset>,
    refined: &Refined,
    options: &Options,
    done: &mut Done,
) -> Result<Chamfered, Error> {
    let source = view.mesh;
    let fine = View { mesh: refined.as_mesh(&source), ..view };
    let Some(finer) = finer_shape(&fine, refined, shape) else {
        done(Stage::Offsets)?;
        let plan = Plan::new(View { mesh: source, ..fine }, shape, offsets);
        return chamfer_plan(&plan, options, done);
    };
    let known = Known { sectors: &shape.sectors, offsets: &offsets, is_new: &refined.is_new() };
    memory::ask(memory::of_chamfers(&fine.mesh, finer.work()))?;
    let offsets = offsets_of(&fine, &finer, Some(&known));
    done(Stage::Offsets)?;
    let chamfered = chamfer_plan(&Plan::new(fine, &finer, offsets), options, done)?;
    let origins = Origins::new(&source, refined, &shape.edges.hard, &finer.edges.hard);
    Ok(restored(&origins, chamfered))
}

/// The stages from the limits on.
fn chamfer_plan(plan: &Plan, options: &Options, done: &mut Done) -> Result<Chamfered, Error> {
    let limits = limits(plan, options.verify)?;
    done(Stage::Limits)?;
    let cuts = strips(plan, &limits.placement);
    done(Stage::Strips)?;
    let attributes = attributes(plan, &limits.placement);
    done(Stage::Attributes)?;
    let chamfered = output(plan, &limits, &cuts, attributes, options.chamfer_submesh);
    done(Stage::Output)?;
    Ok(chamfered)
}
