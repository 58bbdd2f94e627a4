//! Where the eye sees farther than it saw anywhere near.

use super::raster::{Depths, Rect};

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
        (1..=self.radius).all(|step| {
            let across = [column.checked_sub(step), Some(column + step)].into_iter().flatten();
            let along = [row.checked_sub(step), Some(row + step)].into_iter().flatten();
            across.filter(|c| columns.contains(c)).all(|c| self.is_deeper(old.at(c, row), new))
                && along
                    .filter(|r| rows.contains(r))
                    .all(|r| self.is_deeper(old.at(column, r), new))
        })
    }
}

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
    use super::*;

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
