//! A curve through the middles of boxes that stays near to where it is (G. Morton, 1966).

use super::{Aabb, Kin};
use crate::error::Error;
use crate::watch::{Watch, collect, sort, stretches};

/// Steps of the curve along each axis, as a power of two.
const CURVE_BITS: u32 = 16;

/// The numbers of some boxes, crowd by crowd along the curve.
pub(super) fn in_order(boxes: &[Aabb], kin: &[Kin], watch: &dyn Watch) -> Result<Vec<u32>, Error> {
    let curve = Curve::through(boxes, watch)?;
    let crowd = |number: usize| kin.get(number).map_or(0, Kin::crowd);
    let place = |number: usize| (crowd(number), curve.place(&boxes[number]), number as u32);
    let mut places = collect(boxes.len(), watch, place)?;
    sort(&mut places, watch)?;
    collect(places.len(), watch, |place| places[place].2)
}

/// A curve through a box that visits each half of it, along one axis after the other, before the
/// other half.
struct Curve {
    low: [f32; 3],
    /// Steps for each unit along the axes.
    scale: [f32; 3],
}

impl Curve {
    fn through(boxes: &[Aabb], watch: &dyn Watch) -> Result<Curve, Error> {
        let mut all = Aabb::EMPTY;
        for stretch in stretches(boxes.len(), watch) {
            let filled = boxes[stretch?].iter().filter(|each| **each != Aabb::EMPTY);
            all = filled.fold(all, |all, &each| all.union(each));
        }
        // Halved, so that the length cannot overflow.
        let steps = (1 << (CURVE_BITS - 1)) as f32;
        let scale = [0, 1, 2].map(|axis| steps / (all.high[axis] / 2.0 - all.low[axis] / 2.0));
        Ok(Curve { low: all.low, scale })
    }

    /// How far along it the middle of a box lies.
    fn place(&self, each: &Aabb) -> u64 {
        let step = |axis: usize| {
            let half = each.middle(axis) / 2.0 - self.low[axis] / 2.0;
            // Not a number where the boxes lie in a plane, and that is 0.
            let step = (half * 2.0 * self.scale[axis]) as u64;
            spread(step.min((1 << CURVE_BITS) - 1)) << axis
        };
        step(0) | step(1) | step(2)
    }
}

/// With two free bits after each of the lowest [`CURVE_BITS`].
fn spread(bits: u64) -> u64 {
    let bits = (bits | bits << 16) & 0xff00_00ff;
    let bits = (bits | bits << 8) & 0x100f_00f0_0f00_f00f;
    let bits = (bits | bits << 4) & 0x10c3_0c30_c30c_30c3;
    (bits | bits << 2) & 0x1249_2492_4924_9249
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bits_are_spread() {
        assert_eq!(spread(0b1011), 0b1_000_001_001);
        assert_eq!(spread(0xffff).count_ones(), 16);
        assert_eq!(spread(0x8000), 1 << 45);
    }
}
