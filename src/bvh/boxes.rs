//! Boxes along the axes, and what comes near to a line.

use glam::DVec3;

/// A box along the axes: its low and its high corner.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Aabb {
    pub(super) low: [f32; 3],
    pub(super) high: [f32; 3],
}

impl Aabb {
    /// Overlaps nothing.
    pub const EMPTY: Aabb = Aabb { low: [f32::INFINITY; 3], high: [f32::NEG_INFINITY; 3] };

    /// Overlaps all but what is empty.
    pub const ALL: Aabb = Aabb { low: [f32::NEG_INFINITY; 3], high: [f32::INFINITY; 3] };

    /// The box around some points.
    #[inline]
    pub fn around(points: &[[f32; 3]]) -> Aabb {
        points.iter().fold(Aabb::EMPTY, |sum, &point| sum.union(Aabb { low: point, high: point }))
    }

    #[inline]
    pub fn union(self, other: Aabb) -> Aabb {
        // All numbers are finite: a plain comparison is one instruction, `min` is several.
        let least = |a: f32, b: f32| if a < b { a } else { b };
        let most = |a: f32, b: f32| if a > b { a } else { b };
        Aabb {
            low: [0, 1, 2].map(|axis| least(self.low[axis], other.low[axis])),
            high: [0, 1, 2].map(|axis| most(self.high[axis], other.high[axis])),
        }
    }

    /// So much larger on all sides.
    pub fn grown(self, by: f32) -> Aabb {
        Aabb { low: self.low.map(|low| low - by), high: self.high.map(|high| high + by) }
    }

    #[inline]
    pub fn overlaps(&self, other: &Aabb) -> bool {
        let along = |k: usize| (self.low[k] <= other.high[k]) & (other.low[k] <= self.high[k]);
        along(0) & along(1) & along(2)
    }

    #[inline]
    pub(super) fn holds(&self, point: &[f32; 3]) -> bool {
        let along = |k: usize| (self.low[k] <= point[k]) & (point[k] <= self.high[k]);
        along(0) & along(1) & along(2)
    }

    pub(super) fn middle_and_half(&self) -> (DVec3, DVec3) {
        let [low, high] = [self.low, self.high].map(|corner| DVec3::from(corner.map(f64::from)));
        ((low + high) / 2.0, (high - low) / 2.0)
    }

    /// Whether all of it is farther than this from the plane through the origin with a unit normal.
    pub fn is_beside(&self, normal: DVec3, far: f64) -> bool {
        let (middle, half) = self.middle_and_half();
        middle.dot(normal).abs() - half.dot(normal.abs()) > far
    }

    /// Halved first, so that it cannot overflow.
    pub(super) fn middle(&self, axis: usize) -> f32 {
        self.low[axis] / 2.0 + self.high[axis] / 2.0
    }
}

/// What comes within a distance of a line.
#[derive(Clone, Copy)]
pub(crate) struct Rod {
    /// On the line, as near as single precision tells.
    place: [f32; 3],
    /// Across the line and one of the axes each (the separating axes of a line and a box), and how far
    /// the line lies along them.
    across: [(DVec3, f64); 3],
    far: f64,
}

impl Rod {
    /// Around a line through a point, of a unit direction.
    pub fn new(from: DVec3, along: DVec3, far: f64) -> Rod {
        let across = DVec3::AXES.map(|axis| along.cross(axis));
        let place = from.as_vec3().to_array();
        Rod { place, across: across.map(|across| (across, from.dot(across))), far }
    }

    /// Whether it has nothing to do with a box. For certain: some that it passes by are not told.
    pub(super) fn misses(&self, bounds: &Aabb) -> bool {
        // Of the large boxes most hold what is looked for.
        if bounds.holds(&self.place) {
            return false;
        }
        let (middle, half) = bounds.middle_and_half();
        self.across.iter().any(|&(across, place)| {
            (middle.dot(across) - place).abs() - half.dot(across.abs()) > self.far
        })
    }
}
