//! What lies along a line of sight: whether a chamfer opened it past outlines, or took away what
//! hid a hole.
//!
//! Chamfers round outlines off, and where two outlines nearly meet, as those of the two rims of a
//! hole, one sees past both. Such a line of sight runs outside of all solids: in the source it went
//! through thin wedges only, in at a front and out at a back, and now it meets nothing at all.
//! Where it met a front that has no back right behind it, or now meets a back, it looks into a
//! solid.
//!
//! Where the eye sees farther than it saw anywhere near.

use glam::DVec3;

use super::raster::View;
use super::raster::{Depths, Rect};
use super::{SceneTriangle, wide};

/// Along a line of sight, a wedge that a chamfer cuts off is no thicker than this many times the
/// reach: along its edge it would be, but there it lies on an outline.
const THICKEST_WEDGE: f64 = 2.0;

/// Wedges that touch leave no gap that one could have looked through: so much of the reach.
const LEAST_GAP: f64 = 0.3;

/// A surface that lies this share of the reach before or behind another is the same.
const SAME_DEPTH: f64 = 1e-3;

/// Where a line of sight meets a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Meeting {
    depth: f64,
    is_front: bool,
}

/// A line of sight between two depths.
#[derive(Clone, Copy)]
pub struct Sight<'a> {
    pub view: &'a View,
    /// Column and row.
    pub sample: [usize; 2],
    /// What was seen, and what is seen now.
    pub span: [f64; 2],
    /// In scene units.
    pub reach: f64,
}

/// What each of some lines of sight of a view meets of a scene in parts, in order. Each triangle is
/// looked at once, so that many lines through a large scene take little longer than one.
pub fn meetings(sights: &[Sight], parts: [&[SceneTriangle]; 2]) -> Vec<Vec<Meeting>> {
    let mut met: Vec<Vec<Meeting>> = vec![Vec::new(); sights.len()];
    let Some(Sight { view, .. }) = sights.first() else { return met };
    let mut by_row: Vec<usize> = (0..sights.len()).collect();
    by_row.sort_by_key(|&sight| sights[sight].sample[1]);
    let places: Vec<[f64; 2]> = by_row.iter().map(|&sight| sights[sight].place()).collect();
    for triangle in parts.into_iter().flatten() {
        let corners = triangle.map(|corner| view.project(wide(corner)));
        let [left, low, right, high] = extent(&corners);
        let first = places.partition_point(|place| place[1] < low);
        for (sight, place) in by_row[first..].iter().zip(&places[first..]) {
            if place[1] > high {
                break;
            }
            if (left..=right).contains(&place[0]) {
                met[*sight].extend(sights[*sight].meeting(&corners));
            }
        }
    }
    for met in &mut met {
        met.sort_by(|one, other| one.depth.total_cmp(&other.depth));
    }
    met
}

/// The least and the greatest places on the picture, with a sample more for what rounding may do.
fn extent(corners: &[DVec3; 3]) -> [f64; 4] {
    let [low, high] =
        [corners.iter().copied().reduce(DVec3::min), corners.iter().copied().reduce(DVec3::max)];
    let (low, high) = (low.unwrap_or_default() - 1.0, high.unwrap_or_default() + 1.0);
    [low.x, low.y, high.x, high.y]
}

impl Sight<'_> {
    /// The middle of its sample.
    fn place(&self) -> [f64; 2] {
        self.sample.map(|place| place as f64 + 0.5)
    }

    /// Whether it runs outside of all solids, past outlines that receded: by what it met before and
    /// meets now, and the farthest that was seen right beside it.
    pub fn runs_outside(
        &self,
        before: &[Meeting],
        after: &[Meeting],
        seen_beside: impl FnOnce() -> f64,
    ) -> bool {
        after.is_empty() && self.are_thin_wedges(before) && self.sees_past(before, seen_beside)
    }

    /// With a triangle as it lies on the picture.
    fn meeting(&self, corners: &[DVec3; 3]) -> Option<Meeting> {
        let [x, y] = self.place();
        let sides = [[0, 1], [1, 2], [2, 0]].map(|side| side.map(|k| corners[k]));
        let crossed = sides.into_iter().filter(|side| is_left_of(x, y, *side)).count();
        if crossed % 2 == 0 {
            return None;
        }
        let [a, b, c] = *corners;
        let normal = (b - a).cross(c - a);
        let depth = a.z - (normal.x * (x - a.x) + normal.y * (y - a.y)) / normal.z;
        let ([from, to], slack) = (self.span, self.reach * SAME_DEPTH);
        let is_between = depth.is_finite() && depth >= from - slack && depth < to - slack;
        is_between.then_some(Meeting { depth, is_front: normal.z > 0.0 })
    }

    /// Whether surfaces come in pairs, a front and a back right behind it, with room between pairs.
    fn are_thin_wedges(&self, met: &[Meeting]) -> bool {
        let is_wedge = |pair: &[Meeting]| match *pair {
            [one, other] => {
                let thickness = other.depth - one.depth;
                one.is_front && !other.is_front && thickness <= self.reach * THICKEST_WEDGE
            }
            _ => false,
        };
        let mut gaps = met.windows(2).skip(1).step_by(2).map(|pair| pair[1].depth - pair[0].depth);
        met.chunks(2).all(is_wedge) && gaps.all(|gap| gap >= self.reach * LEAST_GAP)
    }

    /// Whether the gap behind the first wedge was seen right beside it: nothing recedes but
    /// outlines.
    fn sees_past(&self, met: &[Meeting], seen_beside: impl FnOnce() -> f64) -> bool {
        let [Some(front), Some(back)] = [met.first(), met.get(1)] else { return false };
        let behind = met.get(2).map_or(self.span[1], |next| next.depth);
        let gap = (behind - back.depth).min(self.reach);
        seen_beside() - front.depth >= gap / 2.0
    }
}

/// Whether a side of a triangle runs through the row of a point, on its right. Both triangles of an
/// edge agree to the bit.
fn is_left_of(x: f64, y: f64, [one, other]: [DVec3; 2]) -> bool {
    let [low, high] = if one.y <= other.y { [one, other] } else { [other, one] };
    low.y <= y && y < high.y && x < low.x + (y - low.y) * ((high.x - low.x) / (high.y - low.y))
}

/// How much farther is too far, and what counts as near.
#[derive(Clone, Copy)]
pub struct Window {
    /// Samples to each side.
    pub radius: usize,
    /// In scene units.
    pub reach: f32,
}

/// A column and a row.
pub type Sample = [usize; 2];

impl Window {
    fn is_deeper(&self, old: f32, new: f32) -> bool {
        new > old + self.reach
    }

    /// The samples of the new picture, row by row, that are deeper by more than the reach than all
    /// of the old one in their window. The old picture has a free margin, unless it ends where the
    /// view does.
    ///
    /// Few samples are deeper than at the same place before, and of those most lie near an outline:
    /// a look along their row and column is enough. Windows are looked through for the rest.
    pub fn open_samples(&self, old: &Depths, new: &Depths) -> Vec<Sample> {
        let mut open = self.deeper_samples(old, new);
        open.retain(|&sample| self.is_deeper_than_cross(old, sample, new.at(sample[0], sample[1])));
        if let Some(around) = around(&open) {
            let most = Farthest::new(old, around, self.radius);
            open.retain(|&[column, row]| self.is_deeper(most.at(column, row), new.at(column, row)));
        }
        open
    }

    /// The largest depth around a sample.
    pub fn farthest(&self, depths: &Depths, [column, row]: Sample) -> f32 {
        let here = Rect { columns: column..column + 1, rows: row..row + 1 };
        let around = here.widened(self.radius, usize::MAX).shared(&depths.rect);
        let rows = around.rows.flat_map(|row| depths.row(row, around.columns.clone()));
        rows.copied().fold(f32::NEG_INFINITY, f32::max)
    }

    fn deeper_samples(&self, old: &Depths, new: &Depths) -> Vec<Sample> {
        let columns = new.rect.columns.clone();
        let mut deeper = Vec::new();
        for row in new.rect.rows.clone() {
            let [old, new] = [old, new].map(|depths| depths.row(row, columns.clone()));
            let chunks =
                old.chunks(CHUNK).zip(new.chunks(CHUNK)).zip(columns.clone().step_by(CHUNK));
            for ((old, new), first) in chunks {
                let pairs = || old.iter().zip(new);
                // Without a branch for each sample.
                if pairs().fold(false, |any, (&old, &new)| any | self.is_deeper(old, new)) {
                    let places =
                        pairs().enumerate().filter(|(_, (old, new))| self.is_deeper(**old, **new));
                    deeper.extend(places.map(|(k, _)| [first + k, row]));
                }
            }
        }
        deeper
    }

    /// The nearest first: outlines recede by a part of the window only.
    fn is_deeper_than_cross(&self, old: &Depths, [column, row]: Sample, new: f32) -> bool {
        let Rect { columns, rows } = &old.rect;
        (1..=self.radius.min(LONGEST_LOOK)).all(|step| {
            let across = [column.checked_sub(step), Some(column + step)].into_iter().flatten();
            let along = [row.checked_sub(step), Some(row + step)].into_iter().flatten();
            across.filter(|c| columns.contains(c)).all(|c| self.is_deeper(old.at(c, row), new))
                && along
                    .filter(|r| rows.contains(r))
                    .all(|r| self.is_deeper(old.at(column, r), new))
        })
    }
}

/// So far along a row and a column: with a width as large as the scene, each of half a million samples
/// would look all across the picture.
const LONGEST_LOOK: usize = 64;

/// Samples that are looked at together.
const CHUNK: usize = 32;

/// The least part of a view that holds all samples; none without any.
fn around(samples: &[Sample]) -> Option<Rect> {
    let range = |axis: usize| {
        let places = || samples.iter().map(|sample| sample[axis]);
        Some(places().min()?..places().max()? + 1)
    };
    Some(Rect { columns: range(0)?, rows: range(1)? })
}

/// The largest depth around each sample of a part of a view.
pub struct Farthest {
    rect: Rect,
    /// Samples from one row to the next.
    stride: usize,
    values: Vec<f32>,
}

impl Farthest {
    /// Within a square of `radius` samples to each side, as far as the picture goes.
    pub fn new(depths: &Depths, rect: Rect, radius: usize) -> Farthest {
        let stride = rect.columns.len() + 2 * radius;
        let mut values = vec![f32::NEG_INFINITY; stride * (rect.rows.len() + 2 * radius)];
        let known = rect.widened(radius, usize::MAX).shared(&depths.rect);
        for row in known.rows.clone() {
            let place = |place: usize, start: usize| place + radius - start;
            let first = place(row, rect.rows.start) * stride
                + place(known.columns.start, rect.columns.start);
            let from = depths.row(row, known.columns.clone());
            values[first..][..from.len()].copy_from_slice(from);
        }
        let along_rows = largest_ahead(values, 2 * radius + 1, 1);
        Farthest { rect, stride, values: largest_ahead(along_rows, 2 * radius + 1, stride) }
    }

    pub fn at(&self, column: usize, row: usize) -> f32 {
        let (column, row) = (column - self.rect.columns.start, row - self.rect.rows.start);
        self.values[row * self.stride + column]
    }
}

/// At each place the largest of `count` values, each `step` places after the last: pairs, then
/// pairs of pairs and so on. Values near the end lack some.
fn largest_ahead(mut values: Vec<f32>, count: usize, step: usize) -> Vec<f32> {
    let mut known = 1;
    while known < count {
        let more = known.min(count - known);
        let ahead = values.get(more * step..).unwrap_or_default();
        let larger = |(one, other): (&f32, &f32)| if other > one { *other } else { *one };
        values = values.iter().zip(ahead).map(larger).collect();
        known += more;
    }
    values
}

#[cfg(test)]
mod tests {
    use super::super::raster::Frame;
    use super::*;

    fn met(depths: &[f64]) -> Vec<Meeting> {
        let each = |(k, &depth): (usize, &f64)| Meeting { depth, is_front: k % 2 == 0 };
        depths.iter().enumerate().map(each).collect()
    }

    fn with_sight(test: impl Fn(&Sight)) {
        let frame = Frame::around(&[[[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]]).unwrap();
        let view = frame.views(1, 8).next().unwrap();
        let (sample, span) = ([4, 4], [1.0, 9.0]);
        test(&Sight { view: &view, sample, span, reach: 1.0 });
    }

    //  eye ->   |\      |\
    //           |/      |/
    #[test]
    fn wedges_with_room_between_them_may_be_seen_past() {
        with_sight(|sight| {
            let wedges = met(&[1.0, 1.5, 4.0, 4.2]);
            assert!(sight.runs_outside(&wedges, &[], || 3.0));
            assert!(!sight.runs_outside(&wedges, &[], || 1.1), "no outline is near");
            assert!(!sight.runs_outside(&wedges, &met(&[8.0]), || 3.0), "something is met now");
        });
    }

    #[test]
    fn a_front_without_a_back_hides_a_hole() {
        with_sight(|sight| {
            assert!(!sight.are_thin_wedges(&met(&[1.0])));
            assert!(!sight.are_thin_wedges(&met(&[1.0, 1.5, 4.0])));
            assert!(!sight.are_thin_wedges(&met(&[1.0, 9.0])), "too thick for a wedge");
        });
    }

    #[test]
    fn wedges_that_touch_hid_what_is_behind() {
        with_sight(|sight| assert!(!sight.are_thin_wedges(&met(&[1.0, 1.5, 1.5, 2.0]))));
    }

    //  Some triangles one behind the other, and a line of sight through each sample.
    #[test]
    fn many_lines_of_sight_meet_what_each_meets_alone() {
        let share = |k: usize| (k * 29 % 64) as f32 / 64.0;
        let corner = |k: usize| [share(k), share(5 * k + 1), share(11 * k + 2)];
        let triangles: Vec<SceneTriangle> =
            (0..40).map(|k| [corner(k), corner(k + 7), corner(3 * k + 1)]).collect();
        let (kept, gone) = triangles.split_at(13);
        let view = Frame::around(&triangles).unwrap().views(1, 16).next().unwrap();
        let samples = (0..256).map(|k| [k * 37 % 256 / 16, k * 37 % 16]);
        let sights: Vec<Sight> = samples
            .map(|sample| Sight { view: &view, sample, span: [-0.2, 0.5], reach: 0.01 })
            .collect();
        let met = meetings(&sights, [kept, gone]);
        for (sight, met) in sights.iter().zip(&met) {
            let corners = triangles.iter().map(|t| t.map(|corner| view.project(wide(corner))));
            let mut alone: Vec<Meeting> = corners.filter_map(|c| sight.meeting(&c)).collect();
            alone.sort_by(|one, other| one.depth.total_cmp(&other.depth));
            assert_eq!(*met, alone, "{:?}", sight.sample);
        }
        assert!(met.iter().any(|met| met.len() > 3) && met.iter().any(Vec::is_empty));
    }

    #[test]
    fn the_largest_ahead_is_that_of_each_window() {
        let values: Vec<f32> = (0..40).map(|k| (k * 37 % 11) as f32).collect();
        for (count, step) in [(1, 1), (2, 1), (5, 1), (7, 3), (3, 8)] {
            let found = largest_ahead(values.clone(), count, step);
            for k in 0..values.len() - (count - 1) * step {
                let window = (0..count).map(|place| values[k + place * step]);
                let expected = window.fold(0.0, f32::max);
                assert_eq!(found[k], expected, "{count} values by {step}, place {k}");
            }
        }
    }
}
