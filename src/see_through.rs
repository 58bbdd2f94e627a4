//! See-through: does light show after chamfering where nobody saw through before?
//!
//! Topology cannot tell: game models are put together from open parts that hide each other's
//! holes, and a chamfer may cut away what hid one. So a scene is looked at before and after, from
//! many sides, with faces from behind left out as an engine does. A place *leaks* where the eye now
//! sees farther than it saw anywhere near there before: what lies beside an outline may show where
//! the outline recedes by a chamfer, but nothing else may.

mod raster;
mod views;

use glam::DVec3;

use raster::{Depths, farthest_around};
use views::View;

/// A triangle of a scene, `3 by 3`: counter-clockwise where seen from outside.
pub type SceneTriangle = [[f32; 3]; 3];

/// How a scene is looked at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Eyes {
    /// From how many directions, at most [`Eyes::MOST_VIEWS`].
    pub views: usize,
    /// Samples along each side of a view.
    pub resolution: usize,
}

impl Eyes {
    /// Further directions are left out.
    pub const MOST_VIEWS: usize = views::DIRECTIONS.len();
}

impl Default for Eyes {
    /// Slits of a thousandth of the scene show, from all directions that there are.
    fn default() -> Eyes {
        Eyes { views: Eyes::MOST_VIEWS, resolution: 768 }
    }
}

/// An outline may recede by this many widths: farther than that no vertex goes. What lies behind
/// it shows then, and what lies less deep behind the old surface is the chamfer itself.
pub const REACH: f64 = 3.0;

/// So few samples may be a needle's tip that falls on a sample in one picture and beside it in the
/// other.
const LEAST_SAMPLES: usize = 3;

/// A place where light shows.
#[derive(Clone, Debug, PartialEq)]
pub struct Leak {
    /// The unit vector from there to the eye.
    pub toward_eye: [f32; 3],
    /// `#samples by 3`: the places on the old surface that the eye now looks through, in scene
    /// units.
    pub places: Vec<[f32; 3]>,
    /// How much farther the eye sees now, in scene units; infinite where it sees nothing.
    pub depth: f32,
}

impl Leak {
    /// The middle one of its places.
    pub fn middle(&self) -> [f32; 3] {
        self.places[self.places.len() / 2]
    }
}

/// Looks at a scene before and after it was chamfered with a width, in scene units, and tells
/// where light shows. Corners that are not finite are taken as not there.
///
/// Takes time in proportion to the number of triangles plus that of the samples of all views, and
/// gives the same on every machine.
pub fn leaks(
    before: &[SceneTriangle],
    after: &[SceneTriangle],
    width: f32,
    eyes: Eyes,
) -> Vec<Leak> {
    let reach = f64::from(width) * REACH;
    let Some(frame) = views::Frame::around(before) else { return Vec::new() };
    let views = frame.views(eyes.views, eyes.resolution);
    views.flat_map(|view| leaks_in(&view, before, after, reach)).collect()
}

fn leaks_in(
    view: &View,
    before: &[SceneTriangle],
    after: &[SceneTriangle],
    reach: f64,
) -> Vec<Leak> {
    let [old, new] = [before, after].map(|triangles| Depths::of(view, triangles));
    let radius = (reach / view.sample_size).ceil() as usize + 1;
    let most = farthest_around(&old, radius);
    let is_leak = |sample: usize| new.values[sample] > most[sample] + reach as f32;
    let mut open: Vec<bool> = (0..most.len()).map(is_leak).collect();
    let mut leaks = Vec::new();
    for sample in 0..open.len() {
        let samples = take_joined(&mut open, old.size, sample);
        if samples.len() >= LEAST_SAMPLES {
            leaks.push(leak(view, &old, &new, &samples));
        }
    }
    leaks
}

/// The open samples joined to one, itself included; they are no longer open then.
fn take_joined(open: &mut [bool], size: usize, first: usize) -> Vec<usize> {
    let mut joined = Vec::new();
    if std::mem::take(&mut open[first]) {
        joined.push(first);
    }
    let mut looked = 0;
    while let Some(&sample) = joined.get(looked) {
        looked += 1;
        let (column, row) = (sample % size, sample / size);
        for row in row.saturating_sub(1)..(row + 2).min(size) {
            for column in column.saturating_sub(1)..(column + 2).min(size) {
                if std::mem::take(&mut open[row * size + column]) {
                    joined.push(row * size + column);
                }
            }
        }
    }
    joined
}

fn leak(view: &View, old: &Depths, new: &Depths, samples: &[usize]) -> Leak {
    let place = |&sample: &usize| {
        let (column, row) = (sample % old.size, sample / old.size);
        view.place(column, row, f64::from(old.values[sample])).as_vec3().to_array()
    };
    let deeper = samples.iter().map(|&sample| new.values[sample] - old.values[sample]);
    Leak {
        toward_eye: view.toward_eye.as_vec3().to_array(),
        places: samples.iter().map(place).collect(),
        depth: deeper.fold(0.0, f32::max),
    }
}

fn wide(point: [f32; 3]) -> DVec3 {
    DVec3::from(point.map(f64::from))
}

#[cfg(test)]
mod tests;
