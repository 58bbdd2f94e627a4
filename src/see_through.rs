//! See-through: does light show after chamfering where nobody saw through before?
//!
//! Topology cannot tell: game models are put together from open parts that hide each other's
//! holes, and a chamfer may cut away what hid one. So a scene is looked at before and after, from
//! many sides, with faces from behind left out as an engine does. A place *leaks* where the eye now
//! sees farther than it saw anywhere near there before: what lies beside an outline may show where
//! the outline recedes by a chamfer, but nothing else may.

mod raster;
mod sight;

use std::collections::{BTreeSet, HashSet};

use glam::DVec3;

use crate::threads::Threads;
use raster::View;
use raster::{Depths, Faces};
use sight::Sight;
use sight::{Sample, Window};

/// A triangle of a scene, `3 by 3`: counter-clockwise where seen from outside.
pub type SceneTriangle = [[f32; 3]; 3];

/// How a scene is looked at: the defaults, with what a caller wants otherwise.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Eyes {
    /// From how many directions, at most [`Eyes::MOST_VIEWS`].
    pub views: usize,
    /// Samples along each side of a view.
    pub resolution: usize,
    /// How many threads may look; 0 for as many as there are cores, but never more than
    /// [`Eyes::MOST_THREADS`]. What is seen is the same.
    pub threads: u32,
}

impl Eyes {
    /// Further directions are left out.
    pub const MOST_VIEWS: usize = raster::DIRECTIONS.len();

    /// Each thread needs memory for its own pictures.
    pub const MOST_THREADS: u32 = 4;
}

impl Eyes {
    /// The same with another number of [`threads`](field@Eyes::threads).
    #[must_use]
    pub const fn with_threads(self, threads: u32) -> Eyes {
        Eyes { threads, ..self }
    }

    fn threads(&self) -> Threads {
        let cores = || std::thread::available_parallelism().map_or(1, |cores| cores.get() as u32);
        let wanted = if self.threads == 0 { cores() } else { self.threads };
        Threads::new(wanted.min(Eyes::MOST_THREADS), usize::MAX)
    }
}

impl Default for Eyes {
    /// Slits of a thousandth of the scene show, from all directions that there are; one thread.
    fn default() -> Eyes {
        Eyes { views: Eyes::MOST_VIEWS, resolution: 768, threads: 1 }
    }
}

/// An outline may recede by this many widths: farther than that no vertex goes. What lies behind
/// it shows then, and what lies less deep behind the old surface is the chamfer itself.
pub const REACH: f64 = 3.0;

/// So few samples may be a needle's tip that falls on a sample in one picture and beside it in the
/// other.
const LEAST_SAMPLES: usize = 3;

/// In each leak, so many lines of sight are followed through the scene.
const MOST_SIGHTS: usize = 8;

/// A place where light shows.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Leak {
    /// The unit vector from there to the eye.
    pub toward_eye: [f32; 3],
    /// `#samples by 3`: the places on the old surface that the eye now looks through, in scene
    /// units.
    pub places: Vec<[f32; 3]>,
    /// How much farther the eye sees now, in scene units; infinite where it sees nothing.
    pub depth: f32,
    /// Whether the eye looks past outlines that receded, outside of all solids, as through a narrow
    /// hole whose two rims were rounded off. Otherwise it looks into a solid.
    pub is_past_outlines: bool,
}

impl Leak {
    /// A place that the eye looks into a solid at, for those who find leaks in their own way.
    pub fn new(toward_eye: [f32; 3], places: Vec<[f32; 3]>, depth: f32) -> Leak {
        Leak { toward_eye, places, depth, is_past_outlines: false }
    }

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
    let changes = Changes::between(before, after);
    let frame = raster::Frame::around(before).filter(|_| !changes.gone.is_empty());
    let Some(frame) = frame else { return Vec::new() };
    let views: Vec<View> = frame.views(eyes.views, eyes.resolution).collect();
    let reach = f64::from(width) * REACH;
    let look = |pictures: &mut Pictures, view: &View| pictures.leaks(view, &changes, reach);
    eyes.threads().map_large(&views, Pictures::default, look).concat()
}

/// Two scenes, with what is the same in both taken apart: that is drawn once.
struct Changes {
    kept: Vec<SceneTriangle>,
    gone: Vec<SceneTriangle>,
    added: Vec<SceneTriangle>,
}

impl Changes {
    fn between(before: &[SceneTriangle], after: &[SceneTriangle]) -> Changes {
        let bits = |triangle: &SceneTriangle| triangle.map(|corner| corner.map(f32::to_bits));
        let [had, has] =
            [before, after].map(|scene| scene.iter().map(bits).collect::<HashSet<[[u32; 3]; 3]>>());
        let (kept, gone) = before.iter().partition(|triangle| has.contains(&bits(triangle)));
        let added = after.iter().filter(|triangle| !had.contains(&bits(triangle)));
        Changes { kept, gone, added: added.copied().collect() }
    }
}

/// The memory of one view, used for the next.
#[derive(Default)]
struct Pictures {
    kept: Faces,
    gone: Faces,
    added: Faces,
    old: Depths,
    new: Depths,
}

impl Pictures {
    fn leaks(&mut self, view: &View, changes: &Changes, reach: f64) -> Vec<Leak> {
        if !self.draw(view, changes) {
            return Vec::new();
        }
        let radius = (reach / view.sample_size).ceil().min(view.size as f64) as usize + 1;
        let window = Window { radius, reach: reach as f32 };
        let open = window.open_samples(&self.old, &self.new);
        let mut groups = joined(&open);
        groups.retain(|samples| samples.len() >= LEAST_SAMPLES);
        let are_past = self.are_past_outlines(view, changes, window, &groups);
        let leaks = groups.iter().zip(are_past);
        leaks.map(|(samples, is_past)| self.leak(view, samples, is_past)).collect()
    }

    /// The old picture as far as there is something to see, and the new one where something is
    /// gone: it can be deeper only there. Whether there is such a place.
    fn draw(&mut self, view: &View, changes: &Changes) -> bool {
        self.gone.project(view, &changes.gone);
        let gone = self.gone.bounds(view.size);
        if gone.is_empty() {
            return false;
        }
        self.kept.project(view, &changes.kept);
        self.added.project(view, &changes.added);
        let seen = self.kept.bounds(view.size).around(&gone);
        self.old.clear(seen.widened(1, view.size));
        self.old.draw(&self.kept);
        self.new.copy(&self.old, gone);
        self.old.draw(&self.gone);
        self.new.draw(&self.added);
        true
    }

    fn leak(&self, view: &View, samples: &[Sample], is_past_outlines: bool) -> Leak {
        let place = |&[column, row]: &Sample| {
            let depth = f64::from(self.old.at(column, row));
            view.place(column, row, depth).as_vec3().to_array()
        };
        let deeper = samples
            .iter()
            .map(|&[column, row]| self.new.at(column, row) - self.old.at(column, row));
        Leak {
            toward_eye: view.toward_eye.as_vec3().to_array(),
            places: samples.iter().map(place).collect(),
            depth: deeper.fold(0.0, f32::max),
            is_past_outlines,
        }
    }

    /// For each leak. Some samples, spread over it, stand for all.
    fn are_past_outlines(
        &self,
        view: &View,
        changes: &Changes,
        window: Window,
        groups: &[Vec<Sample>],
    ) -> Vec<bool> {
        let step = |samples: &[Sample]| samples.len().div_ceil(MOST_SIGHTS);
        let sights: Vec<Sight> = groups
            .iter()
            .flat_map(|samples| samples.iter().step_by(step(samples)))
            .map(|&sample| self.sight(view, window, sample))
            .collect();
        let Changes { kept, gone, added } = changes;
        let [before, after] =
            [gone, added].map(|changed| sight::meetings(&sights, [kept, changed]));
        let mut outside =
            sights.iter().zip(before.iter().zip(&after)).map(|(sight, (had, has))| {
                let seen_beside = || f64::from(window.farthest(&self.old, sight.sample));
                sight.runs_outside(had, has, seen_beside)
            });
        // All of a leak are taken, so that the next one begins with its own.
        let are_past = groups.iter().map(|samples| {
            let count = samples.iter().step_by(step(samples)).count();
            outside.by_ref().take(count).filter(|&is_outside| !is_outside).count() == 0
        });
        are_past.collect()
    }

    fn sight<'a>(&self, view: &'a View, window: Window, sample: Sample) -> Sight<'a> {
        let [column, row] = sample;
        let span = [&self.old, &self.new].map(|depths| f64::from(depths.at(column, row)));
        Sight { view, sample, span, reach: f64::from(window.reach) }
    }
}

/// Samples that touch, also by a corner, come together.
fn joined(samples: &[Sample]) -> Vec<Vec<Sample>> {
    let mut free: BTreeSet<Sample> = samples.iter().copied().collect();
    let mut groups = Vec::new();
    for &first in samples.iter() {
        let mut group: Vec<Sample> = free.take(&first).into_iter().collect();
        let mut looked = 0;
        while let Some(&[column, row]) = group.get(looked) {
            looked += 1;
            for row in row.saturating_sub(1)..row + 2 {
                for column in column.saturating_sub(1)..column + 2 {
                    group.extend(free.take(&[column, row]));
                }
            }
        }
        groups.push(group);
    }
    groups
}

fn wide(point: [f32; 3]) -> DVec3 {
    DVec3::from(point.map(f64::from))
}

#[cfg(test)]
mod reference;
#[cfg(test)]
mod tests;
