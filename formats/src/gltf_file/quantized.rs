//! Chamfered meshes whose positions were whole numbers in the file, and may stay so.

use chamfer::check::compare;
use chamfer::{Chamfered, MeshBuffers, Verify};

use super::element::{ElementType, Shape};
use super::geometry::MeshGeometry;

/// A chamfer that is so many steps wide is still one when its corners go to the nearest step.
const LEAST_STEPS: f64 = 16.0;

/// Whether the positions of a chamfered mesh can be whole numbers, as before.
pub enum OnGrid {
    /// They were none before, or are such already.
    NotAsked,
    /// They can: the mesh with all positions moved by at most half a step.
    Yes(Box<Chamfered>),
    No,
}

impl OnGrid {
    /// The mesh to write in the place of the chamfered one.
    pub fn result(&self) -> Option<&Chamfered> {
        match self {
            OnGrid::Yes(result) => Some(result),
            _ => None,
        }
    }
}

/// Moves positions to the nearest steps of the type that the file has them in, if the result is as
/// sound as it was.
pub fn on_grid(geometry: &MeshGeometry, source: &MeshBuffers, result: &Chamfered) -> OnGrid {
    let types = geometry.blocks.iter().filter_map(|block| block.attribute("POSITION"));
    let mut types = types.map(|attribute| attribute.stream.element);
    let Some(first) = types.next() else { return OnGrid::NotAsked };
    let mut is_quantized = first.component.is_integer();
    let is_one_type = types.all(|other| {
        is_quantized |= other.component.is_integer();
        other == first
    });
    if !is_quantized {
        return OnGrid::NotAsked;
    }
    let step = if first.normalized { 1.0 / first.component.one() } else { 1.0 };
    let rounded = result.mesh.positions.iter().map(|position| nearest(first, *position, step));
    let positions: Option<Vec<[f32; 3]>> = rounded.collect();
    if is_one_type && positions.as_ref() == Some(&result.mesh.positions) {
        return OnGrid::NotAsked;
    }
    let is_fine = is_one_type && f64::from(result.width) >= LEAST_STEPS * step;
    let Some(positions) = positions.filter(|_| is_fine) else { return OnGrid::No };
    let mesh = MeshBuffers { positions, ..result.mesh.clone() };
    match compare(&source.as_mesh(), &mesh.as_mesh(), Verify::Fast).breaches.is_empty() {
        true => {
            let mut result = result.clone();
            result.mesh = mesh;
            OnGrid::Yes(Box::new(result))
        }
        false => OnGrid::No,
    }
}

/// The nearest place that the type can hold; none where the next is farther than half a step.
fn nearest(element: ElementType, position: [f32; 3], step: f64) -> Option<[f32; 3]> {
    debug_assert_eq!(element.shape, Shape::VEC3);
    let (mut bytes, mut numbers) = (Vec::new(), Vec::new());
    element.encode(&position.map(f64::from), &mut bytes);
    element.decode(&bytes, &mut numbers);
    let is_near = numbers
        .iter()
        .zip(position)
        .all(|(new, old)| (new - f64::from(old)).abs() <= step * 0.5001);
    is_near.then(|| [0, 1, 2].map(|axis| numbers[axis] as f32))
}
