//! Crowds: rims that end by the dozen at one position, such as the ridges of a star at its tip.
//!
//! Their boxes all overlap there, and are large beside what they are around, so boxes alone would
//! have each edge ask each of them. What ends where an edge does belongs to it and never rests on it,
//! so a crowd there is passed over whole; of any other only those are asked that lie in the direction
//! of the edge as seen from where they meet.

use std::cell::Cell;
use std::sync::Arc;

use glam::DVec3;

use super::{Rim, distance_between};
use crate::bvh::{Aabb, Kin};
use crate::ids::IdVec;
use crate::intersect::Around;
use crate::math::unit;
use crate::topology::Topology;

/// Where fewer end, asking each costs less than knowing them.
const CROWD: u32 = 32;

/// What comes within a distance of something is turned from it, as a chord, by at most this many
/// times the sine, which is the distance over how far away it is.
const MOST_TURN: f64 = std::f64::consts::SQRT_2;

/// The chord from one direction to the opposite one.
const ANY_TURN: f64 = 2.0;

/// Ends that differ less in their direction make no plane: far more than rounding.
const LEAST_TURN: f64 = 1e-9;

/// Far more than rounding moves a direction off such a plane.
const SLACK: f64 = 1e-6;

/// Where crowds end, sorted by [`place`]; nowhere in nearly all meshes.
#[derive(Clone)]
pub struct Crowds(Arc<[DVec3]>);

/// Where crowds of some rims end.
pub fn crowds<'a>(topology: &Topology, rims: impl ExactSizeIterator<Item = &'a Rim>) -> Crowds {
    if rims.len() < CROWD as usize {
        return Crowds(Arc::default());
    }
    let (mut counts, mut crowds) = (IdVec::filled(0, topology.clusters), Vec::new());
    for rim in rims.filter(|rim| rim.border.is_some()) {
        for (corner, end) in [rim.border, rim.border.next()].into_iter().zip(rim.ends) {
            let count = &mut counts[topology.cluster_at[corner]];
            *count += 1;
            if *count == CROWD {
                crowds.push(end);
            }
        }
    }
    crowds.sort_unstable_by_key(|&end| place(end));
    Crowds(crowds.into())
}

impl Crowds {
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// The crowd that a rim is in, sheets and open borders in different ones, with the directions in
    /// which a line from there may run whose distance from both its ends is at most `reach`.
    pub fn kin(&self, rim: &Rim, is_of_sheet: bool, reach: f64) -> Kin {
        let place_of = |&crowd: &DVec3| place(crowd);
        let at = |end| self.0.binary_search_by_key(&place(end), place_of).ok();
        let ends = rim.ends.into_iter().filter(|_| rim.border.is_some());
        ends.filter_map(at).next().map_or(Kin::NONE, |crowd| {
            let share = reach / rim.ends[0].distance(rim.ends[1]);
            let turn = if share < 0.5 { share * MOST_TURN } else { ANY_TURN };
            let bounds = seen(self.0[crowd], rim.ends).grown(turn as f32);
            Kin::new(crowd as u64 * 2 + u64::from(is_of_sheet), bounds)
        })
    }

    /// Tells what kin is not what is looked for, where what comes within a tolerance touches.
    pub fn apart(&self, search: Search, tolerance: f64) -> impl Fn(&Kin) -> bool {
        // Those of one crowd stand next to each other.
        let last = Cell::new((u64::MAX, Near::ALL));
        move |kin| {
            let crowd = kin.crowd();
            let Some(&from) = self.0.get((crowd / 2) as usize) else { return false };
            if last.get().0 != crowd {
                last.set((crowd, search.near(from, crowd % 2 == 1, tolerance)));
            }
            last.get().1.is_apart(kin.bounds())
        }
    }
}

/// What is looked for.
#[derive(Clone, Copy)]
pub enum Search {
    /// What comes within a distance of an edge, but for the sheets that end where it does: these are
    /// its own.
    Beside([DVec3; 2], f64),
    /// Of that, what comes into a wedge along the edge: seen from there, the corners across it.
    Within([DVec3; 2], f64, [DVec3; 3]),
    /// What runs through a point, but for all that ends there.
    Through(DVec3),
    /// What runs along a border.
    Along([DVec3; 2]),
}

impl Search {
    /// What is looked for comes within a distance of a segment.
    pub fn segment(self) -> ([DVec3; 2], f64) {
        match self {
            Search::Beside(edge, reach) | Search::Within(edge, reach, _) => (edge, reach),
            Search::Through(point) => ([point; 2], 0.0),
            Search::Along(border) => (border, 0.0),
        }
    }

    /// Where it may lie of a crowd.
    fn near(self, from: DVec3, is_of_sheet: bool, tolerance: f64) -> Near {
        match self {
            Search::Beside(edge, _) | Search::Within(edge, ..)
                if is_of_sheet && edge.contains(&from) =>
            {
                Near::NOTHING
            }
            Search::Beside(edge, reach) => Near::segment(from, edge, reach + tolerance),
            Search::Within(edge, reach, across) => {
                let reach = reach + tolerance;
                Near::segment(from, edge, reach).within(from, (edge, reach), across)
            }
            Search::Through(point) if point == from => Near::NOTHING,
            Search::Through(point) => Near::segment(from, [point; 2], tolerance),
            Search::Along(border) if border.contains(&from) => Near::seen(seen(from, border)),
            Search::Along(border) => Near::segment(from, border, tolerance),
        }
    }
}

/// In what directions something lies as seen from a point.
#[derive(Clone, Copy)]
struct Near {
    bounds: Aabb,
    /// Of a plane that it lies in; zero if of none.
    normal: DVec3,
    /// So far beside that plane.
    beside: f64,
}

impl Near {
    const NOTHING: Near = Near::seen(Aabb::EMPTY);
    const ALL: Near = Near::seen(Aabb::ALL);

    const fn seen(bounds: Aabb) -> Near {
        Near { bounds, normal: DVec3::ZERO, beside: 0.0 }
    }

    /// All that comes within a distance of a segment.
    fn segment(from: DVec3, segment: [DVec3; 2], reach: f64) -> Near {
        let far = distance_between(segment, [from; 2]);
        if far <= reach * 2.0 {
            return Near::ALL;
        }
        let [one, other] = segment.map(|end| unit(end - from));
        let bounds = seen(from, segment).grown((reach / far * MOST_TURN) as f32);
        Near { bounds, normal: unit(one.cross(other)), beside: reach / (far - reach) }
    }

    /// The same, of what is no farther from the segment than these ways lead.
    fn within(
        self,
        from: DVec3,
        ([one, other], reach): ([DVec3; 2], f64),
        ways: [DVec3; 3],
    ) -> Near {
        let far = distance_between([one, other], [from; 2]) - reach;
        if unit(one - from).cross(unit(other - from)).length() < LEAST_TURN || far <= reach {
            return self;
        }
        let most = ways.into_iter().map(|way| way.dot(self.normal).abs()).fold(0.0, f64::max);
        Near { beside: self.beside.min(most / far + SLACK), ..self }
    }

    fn is_apart(&self, seen: &Aabb) -> bool {
        !self.bounds.overlaps(seen) || seen.is_beside(self.normal, self.beside)
    }
}

/// A box around the directions in which a segment is seen.
fn seen(from: DVec3, segment: [DVec3; 2]) -> Aabb {
    let [from, one, other] = [from, segment[0], segment[1]].map(|point| point.as_vec3().to_array());
    Around::point(from).seen(&[from, one, other])
}

/// A position by its bits, -0 as 0.
fn place(point: DVec3) -> [u64; 3] {
    point.to_array().map(|along| (along + 0.0).to_bits())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ids::Corner;

    const TIP: DVec3 = DVec3::Y;

    /// Where a ray from the tip ends, of 400 around it.
    fn foot(ray: u32) -> DVec3 {
        let (sin, cos) = (f64::from(ray) / 400.0 * std::f64::consts::TAU).sin_cos();
        DVec3::new(cos, 0.0, sin).as_vec3().as_dvec3()
    }

    /// The rays that may be what is looked for.
    fn found(is_of_sheet: bool, search: Search) -> Vec<u32> {
        let crowds = Crowds([TIP].into());
        let rim = |ray| Rim { ends: [TIP, foot(ray)], radius: 0.0, border: Corner(ray) };
        let is_apart = crowds.apart(search, 1e-5);
        let is_found = |&ray: &u32| !is_apart(&crowds.kin(&rim(ray), is_of_sheet, 1e-6));
        (0..400).filter(is_found).collect()
    }

    //      *
    //    // \\      from one foot to that of the next but one
    //   / | | \
    //  .  ===  .
    #[test]
    fn beside_an_edge_are_those_that_cross_it() {
        let across = [foot(7), foot(9)];
        assert_eq!(found(true, Search::Beside(across, 0.0)), [7, 9], "one passes it by");
        assert_eq!(found(true, Search::Beside(across, 0.001)), [7, 8, 9]);
        let lower = across.map(|end| TIP + (end - TIP) * 2.0);
        assert_eq!(found(true, Search::Beside(lower, 0.001)), [7, 8, 9], "seen from the tip");
        assert_eq!(found(true, Search::Beside(across, 0.02)).len(), 5, "and those a step away");
        let steep = [foot(7) / 2.0, foot(7) * 2.0];
        assert_eq!(found(true, Search::Beside(steep, 0.0)), [7], "in one plane with the tip");
    }

    #[test]
    fn within_a_thin_wedge_are_those_in_its_plane() {
        let steep = [foot(7) / 2.0, foot(7) * 2.0];
        let beside = unit(foot(7).cross(TIP)) * 0.02;
        let along = (foot(7) - TIP) * 0.02;
        let within = |ways| found(true, Search::Within(steep, 0.02, ways));
        let all = found(true, Search::Beside(steep, 0.02));
        assert!(all.len() > 2, "{all:?}");
        assert_eq!(within([DVec3::ZERO, along, DVec3::ZERO]), [7]);
        assert_eq!(within([DVec3::ZERO, along, beside]), all);
        assert_eq!(within([beside; 3]), all);
    }

    #[test]
    fn its_own_sheets_do_not_rest_on_an_edge_but_borders_may() {
        let edge = [foot(7), TIP];
        assert_eq!(found(true, Search::Beside(edge, 1.0)), []);
        assert_eq!(found(false, Search::Beside(edge, 0.0)).len(), 400);
    }

    #[test]
    fn what_ends_at_a_point_does_not_run_through_it() {
        assert_eq!(found(false, Search::Through(TIP)), []);
        assert_eq!(found(false, Search::Through((foot(7) + TIP) / 2.0)), [7]);
    }

    #[test]
    fn a_border_runs_along_those_of_its_direction() {
        let shorter = (foot(7) + TIP) / 2.0;
        assert_eq!(found(false, Search::Along([shorter, TIP])), [7]);
        assert_eq!(found(false, Search::Along([shorter, foot(7) * 2.0 - TIP])), [7]);
    }

    #[test]
    fn what_runs_through_a_point_may_miss_it_by_the_tolerance() {
        let beside = (foot(7) + TIP) / 2.0 + DVec3::new(0.0, 5e-6, 0.0);
        assert_eq!(found(false, Search::Through(beside)), [7]);
    }

    #[test]
    fn a_line_of_a_crowd_is_as_thick_as_its_reach() {
        let crowds = Crowds([TIP].into());
        let rim = Rim { ends: [TIP, foot(7)], radius: 0.0, border: Corner(7) };
        let beside = seen(TIP, [TIP, foot(7) + DVec3::Y * 0.02]);
        let is_within = |reach: f64| crowds.kin(&rim, false, reach).bounds().overlaps(&beside);
        assert!(is_within(0.05) && !is_within(1e-6));
    }

    #[test]
    fn each_crowd_is_seen_from_its_own_place() {
        let far = TIP + DVec3::X * 10.0;
        let crowds = Crowds([TIP, far].into());
        let kin = |tip: DVec3, along: DVec3| {
            let rim = Rim { ends: [tip, tip + along], radius: 0.0, border: Corner(0) };
            crowds.kin(&rim, false, 1e-6)
        };
        // Right above the far tip: of the near one only what points there comes near.
        let is_apart = crowds.apart(Search::Through(far + DVec3::Y), 1e-5);
        assert!(is_apart(&kin(TIP, DVec3::Y)) && !is_apart(&kin(far, DVec3::Y)));
        assert!(is_apart(&kin(TIP, DVec3::Y)) && is_apart(&kin(far, DVec3::X)));
    }
}
