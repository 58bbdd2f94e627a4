//! Meshes that stand together: none loses what another rests on.

use core::ffi::c_void;
use std::ops::ControlFlow;
use std::ptr;

use super::guard::{caught, guard};
use super::input::{self, SceneArrays, check_array};
use super::status::Failure;
use super::types::*;
use super::{chamfer_result, reporting};
use crate::memory;
use crate::see_through::Eyes;
use crate::view::view;
use crate::{
    Chamfered, Error, Mesh, Options, Placed, Verify, chamfer_scene, chamfer_with_progress,
};

/// With [`Verify::Seen`], the first pass over all meshes is about so much of the work.
const SHARE_BEFORE_LOOKING: f32 = 0.5;

/// Chamfers meshes that stand together: of each, the edges are held that the open border of
/// another object rests on. With `CHAMFER_VERIFY_SEEN` the scene is looked at as a whole, and what
/// lets light through is held too.
///
/// `meshes` holds `mesh_count` pointers, and `objects` says where the meshes stand. A mesh that no
/// object names is chamfered as `chamfer_run` would. On success each of the `mesh_count` places of
/// `results` is a new result, to be freed with `chamfer_result_destroy`; on failure all are NULL,
/// and `mesh` of the error is the number of the mesh at fault. All else is as for `chamfer_run`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn chamfer_scene_run(
    meshes: *const *const chamfer_mesh,
    mesh_count: u32,
    objects: *const chamfer_object,
    object_count: u32,
    options: *const chamfer_options,
    progress: chamfer_progress,
    user: *mut c_void,
    results: *mut *mut chamfer_result,
    error: *mut chamfer_error,
) -> i32 {
    let count = mesh_count as usize;
    let object_count = object_count as usize;
    let scene = SceneArrays { meshes, mesh_count: count, objects, object_count, options };
    // SAFETY: the caller's pointers are NULL or valid, as `chamfer.h` asks.
    let apart = caught(|| unsafe { input::check_scene_apart(&scene, results, error) });
    if let Err(failure) = apart.and_then(|apart| apart) {
        return failure.status;
    }
    let checked = check_array(results, count, "results");
    let write = |place: usize, result| {
        // SAFETY: written only where checked, and the caller vouches for the rest.
        unsafe { results.add(place).write(result) }
    };
    if checked.is_ok() {
        (0..count).for_each(|place| write(place, ptr::null_mut()));
    }
    let body = || {
        checked?;
        // SAFETY: as above, and what is written is not what is read.
        let made = unsafe { chamfered(&scene, &mut reporting(progress, user)) }?;
        let boxed: Vec<_> =
            made.into_iter().map(|made| Box::new(chamfer_result::new(made))).collect();
        let given = boxed.into_iter().map(Box::into_raw);
        given.enumerate().for_each(|(place, result)| write(place, result));
        Ok(())
    };
    // SAFETY: as above.
    unsafe { guard(error, body) }
}

/// `#meshes`.
///
/// # Safety
/// As [`input::check_scene_apart`], and the arrays stay as they are during the call.
unsafe fn chamfered(
    scene: &SceneArrays,
    progress: &mut dyn FnMut(f32) -> ControlFlow<()>,
) -> Result<Vec<Chamfered>, Failure> {
    // SAFETY: as this function's.
    let (options, meshes, objects) = unsafe {
        let options = input::read_options(scene.options)?;
        let pointers = input::required(scene.meshes, scene.mesh_count, "meshes")?;
        let borrowed = pointers.iter().enumerate().map(|(number, &mesh)| {
            input::borrow_mesh(mesh).map_err(|failure| failure.of_mesh(number))
        });
        let meshes = borrowed.collect::<Result<Vec<Mesh>, Failure>>()?;
        (options, meshes, input::required(scene.objects, scene.object_count, "objects")?)
    };
    // Contacts are looked for before a mesh is chamfered, so all must keep the rules by then.
    for (number, mesh) in meshes.iter().enumerate() {
        view(mesh, &options).map_err(|error| Failure::from(error).of_mesh(number))?;
    }
    let placed = objects.iter().enumerate().map(|(number, object)| place(number, object, &meshes));
    let placed = placed.collect::<Result<Vec<Placed>, Failure>>()?;
    if options.verify == Verify::Seen {
        check_memory(&meshes, &placed)?;
    }
    run(&meshes, &placed, &options, progress)
}

fn run(
    meshes: &[Mesh],
    placed: &[Placed],
    options: &Options,
    progress: &mut dyn FnMut(f32) -> ControlFlow<()>,
) -> Result<Vec<Chamfered>, Failure> {
    let looks = options.verify == Verify::Seen;
    let mut stands = vec![false; meshes.len()];
    placed.iter().for_each(|object| stands[object.mesh] = true);
    // What stands in the scene is looked at there, with all others.
    let in_scene =
        Options { verify: if looks { Verify::Full } else { options.verify }, ..*options };
    let mut steps = Steps { of: meshes.len(), begun: 0, done: 0.0, looks };
    let mut chamfer = |number: usize, mesh: &Mesh| {
        let options = if stands[number] { &in_scene } else { options };
        steps.begun += 1;
        let chamfered =
            chamfer_with_progress(mesh, options, &mut |done| progress(steps.rise_to(done)));
        chamfered.map_err(|error| Failure::from(error).of_mesh(number))
    };
    let eyes = looks.then(|| Eyes::default().with_threads(options.threads));
    let scene = chamfer_scene(meshes, placed, eyes, &mut chamfer)?;
    if looks && progress(1.0).is_break() {
        return Err(Error::Cancelled.into());
    }
    Ok(scene.meshes)
}

/// How much of a scene is done. It never falls, although what leaks is chamfered several times.
struct Steps {
    /// How many meshes there are.
    of: usize,
    begun: usize,
    done: f32,
    looks: bool,
}

impl Steps {
    /// The share of the scene, where so much of the mesh is done that was begun last.
    fn rise_to(&mut self, done: f32) -> f32 {
        let share = (self.begun as f32 - 1.0 + done) / self.of as f32;
        let share = share.min(1.0) * if self.looks { SHARE_BEFORE_LOOKING } else { 1.0 };
        self.done = self.done.max(share);
        self.done
    }
}

fn place(number: usize, object: &chamfer_object, meshes: &[Mesh]) -> Result<Placed, Failure> {
    let refused = |status, why: String| {
        let failure = Failure::new(status, format!("object {number} {why}"));
        Err(Failure { element: number as u32, ..failure })
    };
    if object.mesh as usize >= meshes.len() {
        let why = format!("is of mesh {}, but there are {} meshes", object.mesh, meshes.len());
        return refused(CHAMFER_STATUS_OBJECT_MESH, why);
    }
    if object.transform.iter().any(|value| !value.is_finite()) {
        let why = "has a transform that is infinite or not a number: repair the scene".into();
        return refused(CHAMFER_STATUS_BAD_TRANSFORM, why);
    }
    let transform = [0, 1, 2, 3].map(|column| {
        let [x, y, z] = [0, 1, 2].map(|row| object.transform[4 * column + row]);
        [x, y, z, if column == 3 { 1.0 } else { 0.0 }]
    });
    Ok(Placed { mesh: object.mesh as usize, transform })
}

/// Asks for the memory that looking at the scene takes, and gives it back: allocations that fail
/// in there would end the host's process. Each mesh asks for its own when its turn comes.
fn check_memory(meshes: &[Mesh], placed: &[Placed]) -> Result<(), Failure> {
    let corners = placed.iter().map(|object| meshes[object.mesh].indices.len() as u64);
    Ok(memory::ask(memory::of_scene(corners.sum()))?)
}
