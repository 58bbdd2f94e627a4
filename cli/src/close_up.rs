//! Pictures of the places where light shows.

use chamfer::see_through::Leak;
use glam::Vec3;

use crate::preview::{Line, Panel, Placed, Zoom};

/// A close-up shows so many widths around a place, so that one can tell where it is.
const SURROUNDINGS: f32 = 24.0;

/// What the light shines through, marked on the model before.
const MARK: [u8; 3] = [255, 60, 40];

/// Half the length of a mark, and how far it is before the surface, in widths.
const MARK_SIZE: f32 = 0.1;

/// The surroundings of a leak before and after, seen from where the light shows, with backs left
/// out. Its places are marked on the model before.
pub fn close_up<'a>(
    caption: String,
    [before, after]: [Vec<Placed<'a>>; 2],
    leak: &Leak,
    width: f32,
) -> Panel<'a> {
    let factor = (size(&before) / shown(leak, width)).max(1.0);
    Panel {
        caption,
        before,
        after,
        before_lines: leak.places.iter().map(|place| mark(*place, leak, width)).collect(),
        toward_eye: Some(leak.toward_eye),
        zoom: Some(Zoom { factor, focus: Some(leak.middle()) }),
        ..Panel::default()
    }
}

fn mark(place: [f32; 3], leak: &Leak, width: f32) -> Line {
    let toward_eye = Vec3::from(leak.toward_eye);
    let middle = Vec3::from(place) + toward_eye * width * MARK_SIZE;
    let step = toward_eye.any_orthonormal_vector() * width * MARK_SIZE;
    Line { ends: [(middle - step).to_array(), (middle + step).to_array()], color: MARK }
}

/// How much of the scene is to be seen.
fn shown(leak: &Leak, width: f32) -> f32 {
    let middle = Vec3::from(leak.middle());
    let spread = leak.places.iter().map(|place| middle.distance(Vec3::from(*place)) * 2.0);
    spread.fold(width * SURROUNDINGS, f32::max)
}

/// The diagonal of the box around what is placed.
fn size(placed: &[Placed]) -> f32 {
    let points = placed.iter().flat_map(|item| {
        let transform = glam::Mat4::from_cols_array_2d(&item.transform);
        let used = item.mesh.indices.iter().map(|&index| item.mesh.positions[index as usize]);
        used.map(move |point| transform.transform_point3(Vec3::from(point)))
    });
    let start = (Vec3::MAX, Vec3::MIN);
    let (low, high) = points
        .filter(|point| point.is_finite())
        .fold(start, |(low, high), point| (low.min(point), high.max(point)));
    (high - low).length()
}
