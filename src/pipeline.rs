//! The stages in their order: the only file that knows it.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicUsize, Ordering};

use glam::DVec3;

use crate::apart::apart;
use crate::attributes::{Attributes, attributes};
use crate::blocks::{Blocks, blocks, cut};
use crate::charts::{Charts, charts};
use crate::closers::closers;
use crate::contacts::contacts;
use crate::edges::{edges, may_be_hard};
use crate::error::Error;
use crate::evenness::evenness;
use crate::faces::faces;
use crate::flaps::{Flap, flaps};
use crate::given::{Given, deep};
use crate::ids::{IdVec, Patch, Sector, Triangle};
use crate::inside_out::{is_inside_out, turned_back, turned_normals};
use crate::joined::Joined;
use crate::limits::{Element, lessen_cuts, limits};
use crate::memory;
use crate::mesh::Mesh;
use crate::offsets::{Known, Offset, go_along, narrow_all, offsets as find_offsets};
use crate::options::{Options, Verify};
use crate::output::{output, unchanged};
use crate::patches::{Patches, patches};
use crate::refine::{
    Left, Origins, Refined, Stitched, refine, restored, shape as finer_shape, stitch, stitched,
    stitches,
};
use crate::report::{Chamfered, EdgeVerdict, Totals};
use crate::rests::{Most, Rests, rests};
use crate::room::{plenty, room};
use crate::rounding::{Given as Rounds, Lessen, Rounding, Rows, Search, Triangles, rounding};
use crate::scale::{Scale, Space};
use crate::scene::{Placed, chamfer_scene};
use crate::sectors::sectors;
use crate::see_through::Eyes;
use crate::selection::selection;
use crate::shape::Shape;
use crate::threads::Threads;
use crate::topology::topology;
use crate::unpaired::{Unpaired, unpaired, with_verdicts};
use crate::vanishing::vanishing;
use crate::verdicts::verdicts;
use crate::view::{View, measured, view_watched};
use crate::watch::{Caller, STEPS, Watch};
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

/// As [`chamfer`], calling `progress` between stages, and again and again within the longest, with
/// the share done (0 to 1).
///
/// # Errors
/// As [`chamfer`]; [`Error::Cancelled`] where `progress` breaks.
pub fn chamfer_with_progress(
    mesh: &Mesh,
    options: &Options,
    progress: &mut dyn FnMut(f32) -> ControlFlow<()>,
) -> Result<Chamfered, Error> {
    if options.verify != Verify::Seen {
        return chamfer_by_blocks(mesh, options, progress);
    }
    let alone = [Placed { mesh: 0, transform: IDENTITY }];
    // It may be done again, but what is told never falls.
    let mut told = 0.0_f32;
    let each = Options { verify: Verify::Full, ..*options };
    memory::ask(memory::of_looking(mesh))?;
    let mut run = |_: usize, mesh: &Mesh| {
        chamfer_by_blocks(mesh, &each, &mut |share| {
            told = told.max(share);
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
    Contacts,
    Edges,
    Sectors,
    Offsets,
    Limits,
    Patches,
    Attributes,
    Charts,
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
            Stage::Contacts => 0.15,
            Stage::Edges => 0.16,
            Stage::Sectors => 0.2,
            Stage::Offsets => 0.25,
            Stage::Limits => 0.5,
            Stage::Patches => 0.55,
            Stage::Attributes => 0.65,
            Stage::Charts => 0.85,
            Stage::Output => 1.0,
        }
    }
}

/// Told whenever a stage ends, and of none where one goes on; an error ends the call.
type Done<'a> = dyn FnMut(Option<Stage>) -> Result<(), Error> + 'a;

/// Chamfers a mesh, a large one of many parts block by block.
fn chamfer_by_blocks(
    mesh: &Mesh,
    options: &Options,
    progress: &mut dyn FnMut(f32) -> ControlFlow<()>,
) -> Result<Chamfered, Error> {
    let view = view_watched(mesh, options, &Caller::new(&mut || told(progress(0.0))))?;
    turned_right(view, |view| {
        let ask = &mut || told(progress(0.0));
        let watch = Caller::new(ask);
        let weld = weld(&view.mesh, &watch)?;
        let is_scaled = Scale::new(options)?.is_some();
        let blocks = if is_scaled { None } else { blocks(&view, &weld, &watch)? };
        match blocks {
            Some(blocks) => {
                drop(weld);
                each_block(&view, &blocks, options, progress)
            }
            None => {
                let mut share = 0.0;
                chamfer_welded(view, weld, options, &mut |stage| {
                    share = stage.map_or(share, Stage::share_done);
                    told(progress(share))
                })
            }
        }
    })
}

/// The stages for each block, and their results put together.
fn each_block(
    view: &View,
    blocks: &Blocks,
    options: &Options,
    progress: &mut dyn FnMut(f32) -> ControlFlow<()>,
) -> Result<Chamfered, Error> {
    let threads = &Threads::new(options.threads, work(view, options.verify));
    let alone = &Options { threads: 1, ..*options };
    let done = AtomicUsize::new(0);
    let chamfered = |watch: &dyn Watch, &block: &usize| {
        let own = cut(view, blocks, block);
        let mesh = Mesh { factors: view.mesh.factors, ..own.as_mesh() };
        let view = View { mesh, ..*view };
        let weld = weld(&view.mesh, watch)?;
        let chamfered = chamfer_welded(view, weld, alone, &mut |_| watch.worked(STEPS));
        done.fetch_add(1, Ordering::Relaxed);
        chamfered
    };
    let share = || done.load(Ordering::Relaxed) as f32 / blocks.len() as f32 * SHARE_OF_BLOCKS;
    let ask = &mut || told(progress(share()));
    let watch = &Caller::new(ask);
    let (mut joined, mut made) = (Joined::new(view, blocks)?, Vec::new());
    let all: Vec<usize> = (0..blocks.len()).collect();
    for some in all.chunks(BLOCKS_AT_ONCE * threads.count()) {
        let before = std::mem::take(&mut made);
        made = threads.map_beside(some, watch, chamfered, || joined.add(before))?;
        watch.worked(STEPS)?;
    }
    joined.add(made)?;
    let joined = joined.finish(watch)?;
    told(progress(1.0))?;
    Ok(joined)
}

/// How much there is to do, in corners of a mesh that is chamfered by `fast`.
fn work(view: &View, verify: Verify) -> usize {
    let times = if verify == Verify::Fast { 1 } else { TIMES_OF_FULL };
    view.corner_count().saturating_mul(times)
}

/// So many times as long as `fast` the search for what cuts takes, and more on most meshes that are large.
const TIMES_OF_FULL: usize = 2;

/// What so many blocks for each thread have made is put together while the next are done: by then that
/// no thread waits long for the others counts for little.
const BLOCKS_AT_ONCE: usize = 8;

/// How much of a call is done when the last block is.
const SHARE_OF_BLOCKS: f32 = 0.98;

fn told(answer: ControlFlow<()>) -> Result<(), Error> {
    match answer {
        ControlFlow::Continue(()) => Ok(()),
        ControlFlow::Break(()) => Err(Error::Cancelled),
    }
}

/// As [`chamfer`] for the whole mesh at once, calling `after` whenever a stage ends.
///
/// # Errors
/// As [`chamfer`]; [`Error::Cancelled`] where `after` breaks.
pub fn chamfer_by_stages(
    mesh: &Mesh,
    options: &Options,
    after: &mut dyn FnMut(Stage) -> ControlFlow<()>,
) -> Result<Chamfered, Error> {
    let done = &mut |stage: Option<Stage>| stage.map_or(Ok(()), |stage| told(after(stage)));
    let view = view_watched(mesh, options, &Caller::new(&mut || done(None)))?;
    turned_right(view, |view| {
        done(Some(Stage::View))?;
        let weld = weld(&view.mesh, &Caller::new(&mut || done(None)))?;
        chamfer_welded(view, weld, options, done)
    })
}

/// A mesh whose normals all point inward is done as if they pointed outward.
fn turned_right(
    view: View,
    chamfered: impl FnOnce(View) -> Result<Chamfered, Error>,
) -> Result<Chamfered, Error> {
    if !is_inside_out(&view) {
        return chamfered(view);
    }
    memory::ask(memory::of_turned(&view.mesh))?;
    let normals = turned_normals(&view);
    let view = View { mesh: Mesh { normals: &normals, ..view.mesh }, ..view };
    Ok(turned_back(chamfered(view)?))
}

/// The stages after the weld.
fn chamfer_welded(
    view: View,
    weld: Weld,
    options: &Options,
    done: &mut Done,
) -> Result<Chamfered, Error> {
    done(Some(Stage::Weld))?;
    let chamfered = in_space(&view, options, |space| {
        if may_be_hard(space.measured, &weld) {
            return chamfer_hard(space, weld, options, done);
        }
        memory::ask(memory::of_copy(&view.mesh))?;
        Ok(unchanged(&view, options.chamfer_submesh))
    })?;
    done(Some(Stage::Output))?;
    Ok(chamfered)
}

/// Does something with a mesh as it came, and as it is measured.
fn in_space<T>(
    view: &View,
    options: &Options,
    with: impl FnOnce(Space) -> Result<T, Error>,
) -> Result<T, Error> {
    let scale = Scale::new(options)?;
    if scale.is_some() {
        memory::ask(memory::of_measured(&view.mesh))?;
    }
    let scaled = scale.map(|scale| scale.measured(&view.mesh));
    let scaled = scaled.as_ref().map(|scaled| measured(scaled.mesh(&view.mesh), options));
    let stored = scale.map(|scale| scale.stored(&view.mesh));
    let scaled = scaled.transpose()?.map(|scaled| View { stored, ..scaled });
    with(Space { source: view, measured: scaled.as_ref().unwrap_or(view), scale })
}

/// The same where there may be hard edges. Where lines close T-junctions without being part of a face,
/// they become so.
fn chamfer_hard(
    space: Space,
    weld: Weld,
    options: &Options,
    done: &mut Done,
) -> Result<Chamfered, Error> {
    let view = space.measured;
    let threads = &Threads::new(options.threads, work(view, options.verify));
    let shape = shape(view, weld, &[], options, (threads, done))?;
    let closers = closers(view, &shape, &Caller::new(&mut || done(None)))?;
    if closers.is_empty() {
        return chamfer_closed(space, shape, options, (threads, done));
    }
    memory::ask(memory::of_indices(&view.mesh))?;
    let indices = closers.indices(view);
    let [source, measured] = &[space.source, view].map(|view| view.with_indices(&indices));
    let weld = shape.weld;
    // These stages were told of.
    let shape = self::shape(measured, weld, &[], options, (threads, &mut |_| done(None)))?;
    let space = Space { source, measured, ..space };
    let chamfered = chamfer_closed(space, shape, options, (threads, done))?;
    Ok(closers.restored(&view.mesh, chamfered))
}

/// The stages after the sectors. Where only a part of an edge can have a chamfer, the mesh gets vertices,
/// and the finer one goes on.
fn chamfer_closed(
    space: Space,
    shape: Shape,
    options: &Options,
    (threads, done): (&Threads, &mut Done),
) -> Result<Chamfered, Error> {
    let view = space.measured;
    let unpaired = unpaired(view, &shape, &Caller::new(&mut || done(None)))?;
    let mut stitches = stitches(view, &shape, &unpaired);
    for _ in 0..MOST_STITCHED {
        let Some(finer) = stitch(&mut stitches, space, &shape)? else { break };
        match chamfer_stitched((space, &shape), &finer, options, (threads, done))? {
            Ok(chamfered) => return Ok(chamfered),
            Err(idle) => stitches.leave(&idle),
        }
    }
    chamfer_found(space, shape, &unpaired, options, (threads, done))
}

/// What brought no chamfer is left, and all done again without it: one time, or nearly always, is
/// enough.
const MOST_STITCHED: usize = 3;

/// The stages from the weld on where an edge is one on one side and several on the other, on a mesh
/// whose sides are alike; told in terms of the source. Or else the sides that got vertices for nothing.
fn chamfer_stitched(
    (space, coarse): (Space, &Shape),
    finer: &Stitched,
    options: &Options,
    (threads, done): (&Threads, &mut Done),
) -> Result<Result<Chamfered, Left>, Error> {
    let source = &space.source.mesh;
    let fine = &View { mesh: finer.as_mesh(source), ..*space.source };
    in_space(fine, options, |space| {
        let view = space.measured;
        // These stages were told of.
        let weld = weld(&fine.mesh, &Caller::new(&mut || done(None)))?;
        let planes = finer.planes(&coarse.faces);
        let shape = shape(view, weld, &planes, options, (threads, &mut |_| done(None)))?;
        let idle = finer.idle(coarse, &shape.edges);
        if !idle.is_empty() {
            return Ok(Err(idle));
        }
        let unpaired = unpaired(view, &shape, &Caller::new(&mut || done(None)))?;
        let hard = shape.edges.hard.iter().map(|edge| edge.sides);
        let sides: Vec<_> = hard.chain(unpaired.iter().map(|&(side, _)| [side; 2])).collect();
        let chamfered = chamfer_found(space, shape, &unpaired, options, (threads, done))?;
        Ok(Ok(stitched(source, finer, &sides, chamfered)))
    })
}

/// The stages from the offsets on.
fn chamfer_found(
    space: Space,
    shape: Shape,
    unpaired: &[Unpaired],
    options: &Options,
    (threads, done): (&Threads, &mut Done),
) -> Result<Chamfered, Error> {
    let view = space.measured;
    memory::ask(memory::of_chamfers(&view.mesh, shape.chamfers().work()))?;
    let ask = &mut || done(None);
    let offsets =
        find_offsets(shape.surface(view), shape.chamfers(), None, (threads, &Caller::new(ask)))?;
    let ask = &mut || done(None);
    let is_plain = space.is_plain(&shape.edges);
    let refined = if is_plain { refine(view, &shape, &offsets, &Caller::new(ask))? } else { None };
    let chamfered = match refined {
        Some(refined) => chamfer_refined(space, (shape, offsets), &refined, options, done),
        None => {
            done(Some(Stage::Offsets))?;
            chamfer_shape(space, (shape, offsets), options, (threads, done))
        }
    };
    Ok(with_verdicts(view, chamfered?, unpaired))
}

/// The stages that find out what a mesh is. Of some triangles it is known in which planes they lie.
pub(crate) fn shape(
    view: &View,
    weld: Weld,
    planes: &[(Triangle, DVec3)],
    options: &Options,
    (threads, done): (&Threads, &mut Done),
) -> Result<Shape, Error> {
    memory::ask(memory::up_to_edges(&view.mesh))?;
    let topology = topology(view, &weld, &Caller::new(&mut || done(None)))?;
    done(Some(Stage::Topology))?;
    let mut faces = faces(view, &topology, (threads, &Caller::new(&mut || done(None))))?;
    faces.lay(planes);
    done(Some(Stage::Faces))?;
    let contacts = contacts(view, &topology, &faces, &Caller::new(&mut || done(None)))?;
    done(Some(Stage::Contacts))?;
    let selection = selection(view, &weld, options);
    let ask = &mut || done(None);
    let work = (threads, &Caller::new(ask) as &dyn Watch);
    let edges = edges(view, (&topology, &faces), &contacts, &selection, work)?;
    done(Some(Stage::Edges))?;
    memory::ask(memory::of_sectors(edges.hard.len()))?;
    let ask = &mut || done(None);
    let sectors = sectors(view, &topology, &edges, &contacts, &Caller::new(ask))?;
    done(Some(Stage::Sectors))?;
    Ok(Shape { weld, topology, faces, contacts, edges, sectors })
}

/// A mesh, and where its sectors go at full width.
type Asked = (Shape, IdVec<Sector, Offset>);

/// The stages from the limits on, on a finer mesh; told in terms of the source.
fn chamfer_refined(
    space: Space,
    (shape, offsets): Asked,
    refined: &Refined,
    options: &Options,
    done: &mut Done,
) -> Result<Chamfered, Error> {
    let view = space.measured;
    let fine = &View { mesh: refined.as_mesh(&view.mesh), ..*view };
    let threads = &Threads::new(options.threads, work(fine, options.verify));
    let ask = &mut || done(None);
    let Some(finer) = finer_shape(fine, refined, &shape, &Caller::new(ask))? else {
        done(Some(Stage::Offsets))?;
        return chamfer_shape(space, (shape, offsets), options, (threads, done));
    };
    let known = Known { sectors: &shape.sectors, offsets: &offsets, is_new: &refined.is_new() };
    memory::ask(memory::of_chamfers(&fine.mesh, finer.chamfers().work()))?;
    let ask = &mut || done(None);
    let (surface, watch) = (finer.surface(fine), Caller::new(ask));
    let offsets = find_offsets(surface, finer.chamfers(), Some(&known), (threads, &watch))?;
    done(Some(Stage::Offsets))?;
    let hard = finer.edges.hard.clone();
    let origins = Origins::new(&view.mesh, refined, &shape.edges.hard, &hard);
    let fine_space = Space { source: fine, measured: fine, scale: None };
    let chamfered = chamfer_shape(fine_space, (finer, offsets), options, (threads, done))?;
    Ok(restored(&origins, chamfered))
}

/// The stages from the room to the output.
fn chamfer_shape(
    space: Space,
    (shape, offsets): Asked,
    options: &Options,
    (threads, done): (&Threads, &mut Done),
) -> Result<Chamfered, Error> {
    let made = make(space, (&shape, offsets), options, (threads, done))?;
    done(None)?;
    let Made { patches, rounding, charts, flaps, attributes, verdicts: (verdicts, totals) } = made;
    let largest_width = (shape.edges.widest(space.measured.width) / space.largest()) as f32;
    // What the output does not read is given back: it is where a call needs the most memory.
    let Shape { weld, topology, faces, contacts, edges, sectors } = shape;
    let (target, ask) = (options.chamfer_submesh, &mut || done(None));
    let watch = &Caller::new(ask);
    drop(topology);
    watch.worked(space.source.corner_count())?;
    drop((faces, contacts, edges, sectors));
    watch.worked(space.source.corner_count())?;
    let patches = (&patches, rounding.as_ref());
    let laid = (&charts, &flaps[..]);
    let output = output(space, &weld, patches, laid, attributes, target, watch)?;
    let scale = space.scale.map(|_| options.scale);
    Ok(Chamfered { verdicts, totals, largest_width, scale, ..output })
}

/// All that the output is put together from.
struct Made {
    patches: Patches,
    rounding: Option<Rounding>,
    charts: Charts,
    flaps: Vec<Flap>,
    attributes: Attributes,
    verdicts: (Vec<EdgeVerdict>, Totals),
}

/// The stages from the limits to the charts.
fn make(
    space: Space,
    (shape, mut offsets): (&Shape, IdVec<Sector, Offset>),
    options: &Options,
    (threads, done): (&Threads, &mut Done),
) -> Result<Made, Error> {
    let view = space.measured;
    let (surface, chamfers) = (shape.surface(view), shape.chamfers());
    let Shape { weld, topology, contacts, .. } = shape;
    let mut ask = || done(None);
    let watch = Caller::new(&mut ask);
    let deep = &deep(topology, chamfers.sectors, &watch)?;
    let (none, nowhere, unknown) = (&Rests::default(), &IdVec::default(), &IdVec::default());
    let work = (threads, &watch as &dyn Watch);
    let mut plenty = self::plenty(surface, chamfers.sectors, &offsets, work)?;
    let vanishing = &vanishing(surface, chamfers, (&mut offsets, &mut plenty), work)?;
    if !vanishing.runs.is_empty() {
        go_along(surface, chamfers.sectors, (&mut offsets, Some(&mut plenty)), &watch)?;
    }
    let base = Given {
        offsets: nowhere,
        vanishing,
        rests: none,
        surface,
        chamfers,
        apart: None,
        deep,
        plenty: unknown,
        threads,
    };
    let asked = &Given { offsets: &offsets, plenty: &plenty, ..base };
    let room = evenness(asked, room(asked, &watch)?, options.evenness.into(), &watch)?;
    let narrowed = (&mut offsets, &mut plenty);
    narrow_all(surface, chamfers.sectors, narrowed, &room.fronts, &watch)?;
    let asked = &Given { offsets: &offsets, plenty: &plenty, ..base };
    let shares = room.shares(asked, &watch)?;
    // The stages to come take far more memory than these, so what they do not read is given back.
    drop(room);
    watch.worked(view.corner_count())?;
    let most = Most { offsets: &offsets, shares: &shares };
    let rests = &rests(surface, chamfers, contacts, most, (threads, &watch))?;
    let given = &Given { rests, ..*asked };
    let mut limits = self::limits(given, &shares, options.verify, &watch)?;
    let apart = apart(surface, chamfers.sectors, &limits.placement, options.segments, &watch)?;
    if apart.is_some() {
        let given = &Given { apart: apart.as_ref(), ..*given };
        limits = self::limits(given, &shares, options.verify, &watch)?;
    }
    drop(shares);
    let placement = &limits.placement;
    done(Some(Stage::Limits))?;
    let mut ask = || done(None);
    let watch = Caller::new(&mut ask);
    let patches = patches(view, chamfers, placement, (threads, &watch))?;
    let search = |rows: &mut Rows, triangles: &Triangles, lessen: &mut Lessen| {
        let patch = |element: Element| match element {
            Element::Surface(_) | Element::Flap(_) => None,
            Element::Strip(edge) => Some(Patch(edge.0)),
            Element::Fill(ring) => Some(patches.fill_of(ring)),
        };
        let rounded = |rows: &Rows, element: Element| triangles(rows, patch(element)?);
        let lessen = |rows: &mut Rows, cutting: &[Element]| {
            lessen(rows, &cutting.iter().filter_map(|&e| patch(e)).collect::<Vec<_>>())
        };
        lessen_cuts(given, placement, (rows, &rounded), &watch, lessen)
    };
    let profile = options.profile.into();
    let round = Rounds { view, chamfers, placement, profile };
    let search: Option<&Search> = (options.verify != Verify::Fast).then_some(&search);
    let rounding = rounding(round, &patches, options.segments, (threads, &watch), search)?;
    let work = (threads, &watch as &dyn Watch);
    let verdicts = verdicts(view, chamfers, &limits, (&patches, rounding.as_ref()), work)?;
    // Nor do the stages to come read these.
    limits.placement.normals = IdVec::default();
    let placement = &limits.placement;
    done(Some(Stage::Patches))?;
    let ask = &mut || done(None);
    let work = (threads, &Caller::new(ask) as &dyn Watch);
    let attributes = attributes(space, surface, weld, chamfers, placement, work)?;
    done(Some(Stage::Attributes))?;
    let ask = &mut || done(None);
    let work = (threads, &Caller::new(ask) as &dyn Watch);
    let charts = charts(surface, chamfers, placement, &patches, &attributes, work)?;
    done(Some(Stage::Charts))?;
    let flaps = flaps(surface, chamfers, placement);
    // Giving back so much memory takes a while, too.
    drop(limits);
    done(None)?;
    drop(offsets);
    done(None)?;
    Ok(Made { patches, rounding, charts, flaps, attributes, verdicts })
}
