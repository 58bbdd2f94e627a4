//! Scenes: meshes that stand together, so that none loses what another rests on.
//!
//! What hides a hole in one mesh may be another mesh, or another object of the same one. So the
//! open borders of all others are told to each mesh as [`Held`] lines before it is chamfered; and
//! where that is asked for, the whole is looked at afterwards ([`see_through`](crate::see_through)):
//! what leaks holds the edges around it, and the meshes that have them are done again.

use std::collections::BTreeSet;

use glam::{DMat4, DVec3};

use crate::bvh::{Aabb, Tree};
use crate::contacts::border_lines;
use crate::mesh::{Held, Mesh};
use crate::report::Chamfered;
use crate::see_through::{Eyes, Leak, REACH, SceneTriangle, leaks};
use crate::view::wide;

/// An object of a scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placed {
    /// Which of the meshes.
    pub mesh: usize,
    /// Column-major, from mesh to scene. It may mirror.
    pub transform: [[f32; 4]; 4],
}

/// The meshes of a scene, chamfered.
#[derive(Clone, Debug, Default)]
#[non_exhaustive]
pub struct ChamferedScene {
    /// `#meshes`.
    pub meshes: Vec<Chamfered>,
    /// In how many rounds edges were held because light would have shown.
    pub rounds: u32,
    /// Where light shows all the same; empty too where nobody looked.
    pub leaks: Vec<Leak>,
}

/// Light that shows is gone after a round or two: the second time, edges farther off are held.
const MOST_ROUNDS: u32 = 6;

/// So many times, what shows past outlines only narrows chamfers. What still shows then is held as all
/// else is.
const GENTLE_ROUNDS: u32 = 2;

/// What lets light through lies within so many widths of where it shows; from the second round on,
/// within [`REACH`].
const FIRST_REACH: f64 = 1.5;

/// Of places that are this share of a width apart, each has its say where they only narrow chamfers.
const FINE: f64 = 0.2;

/// Chamfers the meshes of a scene by `run`, which is given the number of a mesh and the mesh with
/// all that is held, and may be asked for a mesh several times. With `eyes`, the scene is looked at
/// until no light shows. Objects of meshes that there are none of are left out.
///
/// # Errors
/// Whatever `run` gives.
pub fn chamfer_scene<E>(
    meshes: &[Mesh],
    placed: &[Placed],
    eyes: Option<Eyes>,
    run: &mut dyn FnMut(usize, &Mesh) -> Result<Chamfered, E>,
) -> Result<ChamferedScene, E> {
    let objects = objects(meshes, placed);
    let bounds: Vec<[DVec3; 2]> = objects.iter().map(|o| bounds(o, &meshes[o.mesh])).collect();
    let mut held = contacts_across(meshes, &objects, &bounds);
    let mut chamfer = |mesh: usize, held: &[Held]| run(mesh, &Mesh { held, ..meshes[mesh] });
    let all = (0..meshes.len()).map(|mesh| chamfer(mesh, &held[mesh]));
    let mut scene = ChamferedScene { meshes: all.collect::<Result<_, E>>()?, ..Default::default() };
    let Some(eyes) = eyes else { return Ok(scene) };
    let before = triangles(&objects, |mesh| &meshes[mesh]);
    let mut may_leak = true;
    while may_leak {
        let width = width(&objects, &scene.meshes);
        let borrowed: Vec<Mesh> = scene.meshes.iter().map(|mesh| mesh.mesh.as_mesh()).collect();
        let after = triangles(&objects, |mesh| &borrowed[mesh]);
        scene.leaks = leaks(&before, &after, width as f32, eyes);
        may_leak = !scene.leaks.is_empty() && scene.rounds < MOST_ROUNDS;
        if may_leak {
            scene.rounds += 1;
            let grip = Grip::in_round(scene.rounds, width);
            for mesh in hold((&objects, &bounds), &scene.leaks, &grip, &mut held) {
                scene.meshes[mesh] = chamfer(mesh, &held[mesh])?;
            }
        }
    }
    Ok(scene)
}

/// A placed mesh with both ways between mesh and scene.
struct Object {
    mesh: usize,
    to_scene: DMat4,
    /// None where the transform flattens: nothing can be told back to such an object.
    to_mesh: Option<DMat4>,
    /// How much longer lengths of the mesh are in the scene, at most.
    scale: f64,
}

impl Object {
    /// None where the transform is not finite.
    fn new(placed: &Placed) -> Option<Object> {
        let to_scene = DMat4::from_cols_array_2d(&placed.transform.map(|c| c.map(f64::from)));
        let to_mesh = Some(to_scene.inverse()).filter(|inverse| inverse.is_finite());
        let axes = [to_scene.x_axis, to_scene.y_axis, to_scene.z_axis];
        let scale = axes.iter().map(|axis| axis.truncate().length()).fold(0.0, f64::max);
        to_scene.is_finite().then_some(Object { mesh: placed.mesh, to_scene, to_mesh, scale })
    }
}

/// What can be placed; objects of meshes that there are none of are left out.
fn objects(meshes: &[Mesh], placed: &[Placed]) -> Vec<Object> {
    placed.iter().filter(|object| object.mesh < meshes.len()).filter_map(Object::new).collect()
}

/// All triangles of a scene, counter-clockwise where seen from outside.
pub fn scene_triangles(meshes: &[Mesh], placed: &[Placed]) -> Vec<SceneTriangle> {
    let objects = objects(meshes, placed);
    triangles(&objects, |mesh| &meshes[mesh])
}

fn triangles<'a>(objects: &[Object], mesh: impl Fn(usize) -> &'a Mesh<'a>) -> Vec<SceneTriangle> {
    let mut triangles = Vec::new();
    for object in objects {
        let mesh = mesh(object.mesh);
        let mirrors = object.to_scene.determinant() < 0.0;
        let place = |&index: &u32| {
            let position = wide(mesh.positions[index as usize]);
            object.to_scene.transform_point3(position).as_vec3().to_array()
        };
        triangles.extend(mesh.indices.as_chunks::<3>().0.iter().map(|corners| {
            let [a, b, c] = corners.each_ref().map(place);
            if mirrors { [a, c, b] } else { [a, b, c] }
        }));
    }
    triangles
}

/// The largest width in the scene.
fn width(objects: &[Object], meshes: &[Chamfered]) -> f64 {
    let widths =
        objects.iter().map(|object| f64::from(meshes[object.mesh].largest_width) * object.scale);
    widths.fold(0.0, f64::max)
}

/// `#meshes`: what the caller holds, and the open borders of all other objects.
/// `bounds: #objects`.
fn contacts_across(meshes: &[Mesh], objects: &[Object], bounds: &[[DVec3; 2]]) -> Vec<Vec<Held>> {
    let mut held: Vec<Vec<Held>> = meshes.iter().map(|mesh| mesh.held.to_vec()).collect();
    if objects.len() < 2 {
        return held;
    }
    let borders: Vec<Vec<[DVec3; 2]>> = meshes.iter().map(border_lines).collect();
    // Closed objects have nothing that rests on others.
    let has_borders = |object: &Object| !borders[object.mesh].is_empty();
    let boxes = objects.iter().zip(bounds);
    let boxes: Vec<Aabb> = boxes
        .map(|(object, bounds)| if has_borders(object) { aabb(bounds) } else { Aabb::EMPTY })
        .collect();
    let tree = Tree::new(&boxes, &[]);
    for (number, object) in objects.iter().enumerate() {
        let Some(to_mesh) = object.to_mesh else { continue };
        let mut near: Vec<u32> = tree.overlapping(aabb(&bounds[number])).collect();
        near.sort_unstable();
        for other_number in near.into_iter().map(|other| other as usize) {
            let other = &objects[other_number];
            if number == other_number || !overlap(bounds[number], bounds[other_number]) {
                continue;
            }
            // What is nowhere near is not told: a heap of objects would be told all of itself.
            let placed = borders[other.mesh]
                .iter()
                .map(|line| line.map(|point| other.to_scene.transform_point3(point)))
                .filter(|[from, to]| overlap(bounds[number], [from.min(*to), from.max(*to)]));
            let lines = placed.map(|line| {
                let [from, to] =
                    line.map(|point| to_mesh.transform_point3(point).as_vec3().to_array());
                Held { from, to, radius: 0.0 }
            });
            held[object.mesh].extend(lines.filter(is_finite));
        }
    }
    held
}

fn is_finite(held: &Held) -> bool {
    [held.from, held.to].as_flattened().iter().all(|value| value.is_finite())
}

/// The box around an object in the scene: its low and its high corner. Boxes of objects that touch
/// may be apart by rounding, so it is a thousandth larger.
fn bounds(object: &Object, mesh: &Mesh) -> [DVec3; 2] {
    let points = mesh.positions.iter().map(|&at| object.to_scene.transform_point3(wide(at)));
    let start = [DVec3::INFINITY, DVec3::NEG_INFINITY];
    let [low, high] = points.fold(start, |[low, high], point| [low.min(point), high.max(point)]);
    let slack = (high - low).max_element() / 1000.0;
    [low - slack, high + slack]
}

/// In single precision; what is not finite is nowhere.
fn aabb(bounds: &[DVec3; 2]) -> Aabb {
    let corners = bounds.map(|corner| corner.as_vec3());
    let is_finite = corners.iter().all(|corner| corner.is_finite());
    if is_finite { Aabb::around(&corners.map(|corner| corner.to_array())) } else { Aabb::EMPTY }
}

fn overlap(one: [DVec3; 2], other: [DVec3; 2]) -> bool {
    one[0].cmple(other[1]).all() && other[0].cmple(one[1]).all()
}

/// How firmly a round holds what leaks; lengths in scene units.
struct Grip {
    width: f64,
    /// So far around where light shows all edges are held.
    reach: f64,
    /// Whether what shows past outlines is only to be left covered.
    is_gentle: bool,
}

impl Grip {
    fn in_round(round: u32, width: f64) -> Grip {
        let widths = if round == 1 { FIRST_REACH } else { REACH };
        Grip { width, reach: widths * width, is_gentle: round <= GENTLE_ROUNDS }
    }
}

/// Holds what is around the places where light shows; tells the meshes that have something new to
/// hold, in order. Of places within a width of each other one stands for all. Objects that are nowhere near
/// a place (`bounds: #objects`) are not told of it: each of many would be told all that leaks anywhere.
fn hold(
    (objects, bounds): (&[Object], &[[DVec3; 2]]),
    leaks: &[Leak],
    grip: &Grip,
    held: &mut [Vec<Held>],
) -> BTreeSet<usize> {
    let mut cells = BTreeSet::new();
    let mut changed = BTreeSet::new();
    let reach = DVec3::splat(grip.reach.max(grip.width));
    let boxes: Vec<Aabb> =
        bounds.iter().map(|[low, high]| aabb(&[*low - reach, *high + reach])).collect();
    let tree = Tree::new(&boxes, &[]);
    let places = leaks.iter().flat_map(|leak| {
        let is_gentle = grip.is_gentle && leak.is_past_outlines;
        leak.places.iter().map(move |&place| (wide(place), is_gentle))
    });
    for (place, is_gentle) in places {
        let size = if is_gentle { grip.width * FINE } else { grip.width };
        let cell = (place / size).floor().to_array().map(|cell| cell as i64);
        if !cells.insert((cell, is_gentle)) {
            continue;
        }
        let mut near: Vec<u32> = tree.overlapping(aabb(&[place; 2])).collect();
        near.sort_unstable();
        for object in near.into_iter().map(|number| &objects[number as usize]) {
            let Some(to_mesh) = object.to_mesh else { continue };
            let at = to_mesh.transform_point3(place).as_vec3().to_array();
            let reach = if is_gentle { 0.0 } else { grip.reach };
            let new = Held { from: at, to: at, radius: (reach / object.scale) as f32 };
            if is_finite(&new) && new.radius.is_finite() {
                held[object.mesh].push(new);
                changed.insert(object.mesh);
            }
        }
    }
    changed
}

#[cfg(test)]
mod tests;
