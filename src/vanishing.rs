//! Vanishing: short edges, whose pulled side would shrink to nothing before the width is reached.
//!
//! ```text
//!  -----A-----v0        at full width the pulled side of e would turn around, so that it holds A and B
//!                `e     back. But the pulled edges of A and B meet, and go on without it: there stands
//!  - - - - - - .   v1   a small copy of what was between them
//!              :    |
//!              :    B
//! ```
//! Where an edge of a shrinking polygon has come down to nothing, those beside it go on: the *edge
//! event* of straight skeletons (O. Aichholzer and F. Aurenhammer, "Straight Skeletons for General
//! Polygonal Figures in the Plane", 1996). Here every vertex goes straight to where it will be in the
//! end, and no triangle is lost.

use std::collections::{BTreeMap, BTreeSet};

use glam::DVec3;

use crate::chamfers::Chamfers;
use crate::edges::HardEdge;
use crate::error::Error;
use crate::ids::{Corner, Edge, IdVec, Sector, Triangle};
use crate::math::unit;
use crate::offsets::{MITER_LIMIT, Offset, is_one_face, turned};
use crate::surface::Surface;
use crate::threads::Threads;
use crate::tolerance::LEVEL_COSINE;
use crate::watch::Watch;

/// A side that would keep less than this share of its length is taken for one that vanishes, and keeps
/// this. With less, the triangles at it lose the breadth that has to stay; with a half, edges are
/// narrowed that would only just fit.
const LEAST_SIDE: f64 = 0.3;

/// What rounding takes from that.
const ROUNDING: f64 = 1e-3;

/// Two pulled edges that turn by less than this into each other (as a sine, six degrees), or run
/// back beside each other, meet nowhere near.
const LEAST_TURN_SINE: f64 = 0.1;

/// The widths asked for around may differ by as much: else the short edge would get far more than
/// its own.
const MOST_UNLIKE: f64 = 2.0;

/// A vertex may become part of longer runs as others shrink the edges beside them; few do so twice.
const MOST_PASSES: usize = 4;

/// The runs of vertices with sides between them that vanish.
#[derive(Default)]
pub struct Vanishing {
    pub runs: Vec<Run>,
}

/// The sectors along a rim from where a side vanishes to where the next one does not.
pub struct Run {
    /// Each with the offset that keeps its pulled edges as far as asked.
    pub members: Vec<(Sector, Offset)>,
    /// How much of these offsets leaves the sides what they keep.
    pub share: f64,
}

/// Where short edges would hold the others back, their sectors get other offsets. The sides of triangles
/// that have plenty of room do not vanish (`plenty: #triangles`); of those around what goes elsewhere then it
/// is not known any more.
///
/// # Errors
/// [`Error::Cancelled`] where the watch stops it.
pub fn vanishing(
    surface: Surface,
    chamfers: Chamfers,
    (offsets, plenty): (&mut IdVec<Sector, Offset>, &mut IdVec<Triangle, bool>),
    (threads, watch): (&Threads, &dyn Watch),
) -> Result<Vanishing, Error> {
    let mut sides =
        Rims { surface, chamfers, offsets }.vanishing_sides(plenty, (threads, watch))?;
    let mut plain = BTreeMap::new();
    let mut runs: Vec<Gathering> = Vec::new();
    for _ in 0..MOST_PASSES {
        watch.worked(sides.len())?;
        let mut found = Rims { surface, chamfers, offsets }.runs(&sides);
        let is_new = |(sector, offset): &(Sector, Offset)| offsets[*sector] != *offset;
        if !found.iter().flatten().any(is_new) {
            break;
        }
        let mut gathered = BTreeSet::new();
        for &(sector, offset) in found.iter().flatten() {
            let before = std::mem::replace(&mut offsets[sector], offset);
            plain.entry(sector).or_insert(before);
            gathered.insert(sector);
            let corners = chamfers.sectors.corners(surface.topology, sector);
            corners.for_each(|corner| plenty[corner.triangle()] = false);
            let fan = &chamfers.sectors.fans[sector];
            sides.extend([fan.first, fan.last.prev()]);
        }
        sides.sort_unstable();
        sides.dedup();
        // Where a longer run meets nowhere near, the shorter one stays.
        found.extend(runs.into_iter().filter(|run| !gathered.contains(&run[0].0)));
        runs = found;
    }
    let lost = Rims { surface, chamfers, offsets }.on_whole_rims(&runs);
    let (whole, runs): (Vec<_>, Vec<_>) =
        runs.into_iter().partition(|run| lost.contains(&run[0].0));
    whole.into_iter().flatten().for_each(|(sector, _)| offsets[sector] = plain[&sector]);
    let run = |run: Gathering| {
        let members: Vec<(Sector, Offset)> =
            run.into_iter().map(|(sector, _)| (sector, plain[&sector])).collect();
        Run { share: share_that_fits(surface, chamfers, &members), members }
    };
    Ok(Vanishing { runs: runs.into_iter().map(run).collect() })
}

/// The sectors of a run with the offsets by which they gather.
type Gathering = Vec<(Sector, Offset)>;

/// How much of their offsets leaves the sides between sectors what these keep.
fn share_that_fits(surface: Surface, chamfers: Chamfers, members: &[(Sector, Offset)]) -> f64 {
    let at = |sector: Sector| surface.view.position_at(chamfers.sectors.fans[sector].first);
    let fits = |pair: &[(Sector, Offset)]| {
        let [(one, from), (other, to)] = [pair[0], pair[1]];
        let way = at(other) - at(one);
        let lost = -way.dot(to.vector - from.vector) / way.length_squared();
        if lost > 0.0 { (1.0 - LEAST_SIDE) / lost } else { 1.0 }
    };
    members.windows(2).map(fits).fold(1.0, f64::min)
}

/// The rims of faces, along which sectors follow each other.
struct Rims<'a> {
    surface: Surface<'a>,
    chamfers: Chamfers<'a>,
    offsets: &'a IdVec<Sector, Offset>,
}

impl Rims<'_> {
    /// The sides that vanish, in the order of their edges.
    fn vanishing_sides(
        &self,
        plenty: &IdVec<Triangle, bool>,
        (threads, watch): (&Threads, &dyn Watch),
    ) -> Result<Vec<Corner>, Error> {
        let (hard, mut sides) = (&self.chamfers.edges.hard, Vec::new());
        let note = |_: &Vec<Corner>, edge: Edge, notes: &mut Vec<Corner>| {
            let HardEdge { sides, skipped, .. } = hard[edge];
            let may_vanish = |side: &Corner| skipped.is_none() && !plenty[side.triangle()];
            let vanishes = |side: &Corner| may_vanish(side) && self.vanishes(*side);
            notes.extend(sides.into_iter().filter(vanishes));
        };
        threads
            .blocks_then((hard.len(), watch), &mut sides, note, |all, notes| all.append(notes))?;
        Ok(sides)
    }

    /// All runs of such sides, with the offsets that their sectors get.
    fn runs(&self, sides: &[Corner]) -> Vec<Gathering> {
        let is_first = |side: &Corner| self.vanishes(*side) && !self.vanishes(self.before(*side));
        sides.iter().copied().filter(is_first).filter_map(|side| self.run(side)).collect()
    }

    /// The sectors on rims that vanish whole, of those at which runs begin.
    fn on_whole_rims(&self, runs: &[Gathering]) -> BTreeSet<Sector> {
        let mut is_whole = BTreeMap::new();
        for run in runs {
            let first = self.chamfers.sectors.fans[run[0].0].first;
            let (mut seen, mut side) = (Vec::new(), first);
            // Walked again from each of its runs, a rim would take quadratic time.
            let comes_around = loop {
                if !self.vanishes(side) || is_whole.contains_key(&self.at(side)) {
                    break false;
                }
                seen.push(self.at(side));
                side = self.behind(side);
                if side == first {
                    break true;
                }
            };
            is_whole.extend(seen.into_iter().map(|sector| (sector, comes_around)));
        }
        is_whole.into_iter().filter(|(_, whole)| *whole).map(|(sector, _)| sector).collect()
    }

    fn at(&self, corner: Corner) -> Sector {
        self.chamfers.sectors.sector_of[corner]
    }

    fn position(&self, sector: Sector) -> DVec3 {
        self.surface.view.position_at(self.chamfers.sectors.fans[sector].first)
    }

    /// The side before another one along its rim.
    fn before(&self, side: Corner) -> Corner {
        self.chamfers.sectors.fans[self.at(side)].last.prev()
    }

    /// The side behind another one along its rim.
    fn behind(&self, side: Corner) -> Corner {
        self.chamfers.sectors.fans[self.at(side.next())].first
    }

    fn edge(&self, side: Corner) -> &HardEdge {
        &self.chamfers.edges.hard[self.chamfers.edges.chamfered_at[side]]
    }

    /// Whether a side would keep too little of its length, or turn around.
    fn vanishes(&self, side: Corner) -> bool {
        let ends = [self.at(side), self.at(side.next())];
        if ends.iter().any(|end| end.is_none()) {
            return false;
        }
        let way = self.position(ends[1]) - self.position(ends[0]);
        let kept = way + self.offsets[ends[1]].vector - self.offsets[ends[0]].vector;
        way.dot(kept) <= (LEAST_SIDE + ROUNDING) * way.length_squared()
            && ends.iter().all(|&end| self.may_turn(end))
    }

    /// Whether a sector lies between two chamfered edges on a face that is flat around it, and has one
    /// vertex there: then it may go anywhere on that.
    fn may_turn(&self, sector: Sector) -> bool {
        let fan = &self.chamfers.sectors.fans[sector];
        let is_chamfered = |side: Corner| self.chamfers.edges.chamfered_at[side].is_some();
        self.offsets[sector].moves()
            && !fan.is_broken
            && is_chamfered(fan.first)
            && is_chamfered(fan.last.prev())
            && is_one_face(self.surface, self.chamfers.sectors, (sector, &self.offsets[sector]))
    }

    /// The run that begins at a side which vanishes; none where the whole rim does, or the edges beside the
    /// run meet nowhere near.
    fn run(&self, first: Corner) -> Option<Gathering> {
        let (mut sectors, mut side) = (vec![self.at(first)], first);
        while self.vanishes(side) {
            sectors.push(self.at(side.next()));
            side = self.behind(side);
            if side == first {
                return None;
            }
        }
        let vectors = self.gathered(&sectors, [self.before(first), side])?;
        let turned = |(sector, way): (Sector, DVec3)| {
            let offset = &self.offsets[sector];
            Some((sector, turned(self.surface, self.chamfers.sectors, sector, offset, way)?))
        };
        sectors.into_iter().zip(vectors).map(turned).collect()
    }

    /// How the vertices of a run go to a small copy of it, between the pulled edges beside it.
    fn gathered(&self, run: &[Sector], beside: [Corner; 2]) -> Option<Vec<DVec3>> {
        let view = self.surface.view;
        let normal = self.normal(run[0]);
        if beside[0] == beside[1] || !run.iter().all(|&s| self.normal(s).dot(normal) > LEVEL_COSINE)
        {
            return None;
        }
        let [one, other] = beside.map(|side| {
            let along = unit(view.position_at(side.next()) - view.position_at(side));
            (along, normal.cross(along))
        });
        let turn = other.0.dot(one.1);
        let widths = self.widths(run, beside)?;
        if turn < LEAST_TURN_SINE {
            return None;
        }
        let [from, to] = [run[0], run[run.len() - 1]].map(|sector| self.position(sector));
        let aside = one.1 * widths[0] - (to - from) * (1.0 - LEAST_SIDE);
        let ahead = (aside.dot(other.1) - widths[1]) / turn;
        let start = one.1 * widths[0] + one.0 * ahead;
        let way = |&sector: &Sector| start - (self.position(sector) - from) * (1.0 - LEAST_SIDE);
        let most = MITER_LIMIT * widths[0].max(widths[1]);
        let ways: Vec<DVec3> = run.iter().map(way).collect();
        ways.iter().all(|way| way.length() <= most).then_some(ways)
    }

    fn normal(&self, sector: Sector) -> DVec3 {
        self.surface.faces.normal[self.chamfers.sectors.fans[sector].first.triangle()]
    }

    /// The widths asked for of the edges beside a run; none where others there are far from them.
    fn widths(&self, run: &[Sector], beside: [Corner; 2]) -> Option<[f64; 2]> {
        let of_fan = |&sector: &Sector| {
            let side = self.chamfers.sectors.fans[sector].first;
            self.edge(side).width_at_start(side)
        };
        let [before, behind] = beside;
        let first = self.edge(before).width_at_end(before);
        let last = self.edge(behind).width_at_start(behind);
        let all = || run.iter().map(of_fan).chain([first]);
        let (least, most) = (all().fold(f64::INFINITY, f64::min), all().fold(0.0, f64::max));
        (most <= MOST_UNLIKE * least).then_some([first, last])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check::assert_sound;
    use crate::mesh::{EdgeFactor, Factors, Mesh, MeshBuffers};
    use crate::options::{Options, Width};
    use crate::pipeline::chamfer;
    use crate::room::plenty;
    use crate::shapes::{self, Builder};
    use crate::stages::{Stages, stages_of, stages_of_mesh};
    use crate::watch::Unwatched;

    /// A plate over an outline that is seen whole from its first point.
    fn plate(outline: &[[f32; 2]]) -> MeshBuffers {
        let mut plate = Builder::with_uvs();
        plate.prism(outline, 0.0, 1.0);
        plate.finish()
    }

    /// Where the vertex of the front that stands at a point goes.
    fn goal(stages: &Stages, [x, y]: [f32; 2]) -> DVec3 {
        let at = DVec3::from([x, y, 1.0].map(f64::from));
        let is_meant = |sector: &Sector| {
            let first = stages.sectors.fans[*sector].first;
            stages.view.position_at(first) == at && stages.faces.normal[first.triangle()].z > 0.5
        };
        let sector = stages.sectors.fans.ids().find(is_meant).unwrap();
        at + stages.offsets[sector].vector
    }

    #[track_caller]
    fn assert_goes(stages: &Stages, from: [f32; 2], to: [f64; 2]) {
        let goal = goal(stages, from);
        assert!(goal.distance(DVec3::new(to[0], to[1], 1.0)) < 1e-6, "{from:?} goes to {goal}");
    }

    #[track_caller]
    fn assert_chamfers_well(mesh: &MeshBuffers, width: f32) {
        let options = Options::default().with_width(Width::Units(width));
        let result = chamfer(&mesh.as_mesh(), &options).unwrap();
        assert_sound("a plate", &mesh.as_mesh(), &result);
    }

    const BEVELLED: [[f32; 2]; 5] = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.9], [1.9, 2.0], [0.0, 2.0]];

    // .-----------.
    // |     ----.  `     a square with a bevel of half the width
    // |          .  |    three tenths of it are left, between the pulled edges beside it
    // |          :  |
    // '-------------'
    #[test]
    fn around_a_bevel_that_vanishes_both_edges_get_the_whole_width() {
        let mesh = plate(&BEVELLED);
        let stages = stages_of(&mesh, 0.2);
        assert_goes(&stages, [2.0, 1.9], [1.8, 1.77]);
        assert_goes(&stages, [1.9, 2.0], [1.77, 1.8]);
        assert_goes(&stages, [2.0, 0.0], [1.8, 0.2]);
        assert_eq!(stages.vanishing.runs.len(), 2, "front and back");
        assert!(stages.vanishing.runs.iter().all(|run| run.members.len() == 2));
        let both = stages.shares.ids().filter(|&sector| stages.shares[sector] == 1.0).count();
        assert!(both >= 10, "all corners of the front and of the back have room");
        assert_chamfers_well(&mesh, 0.2);
    }

    #[test]
    fn sides_of_what_has_plenty_of_room_do_not_vanish() {
        let (mut with_plenty, mut vanished) = (0, 0);
        let meshes = shapes::demo_models().into_iter().map(|(_, mesh)| mesh);
        for mesh in meshes.chain([plate(&BEVELLED)]) {
            for width in [0.01, 0.05, 0.2] {
                let stages = stages_of(&mesh, width);
                let (surface, chamfers) = (stages.surface(), stages.chamfers());
                let offsets = &stages.narrowed;
                let work: (&Threads, &dyn Watch) = (&stages.threads, &Unwatched);
                let plenty = plenty(surface, &stages.sectors, offsets, work).unwrap();
                let rims = Rims { surface, chamfers, offsets };
                for side in stages.edges.hard.iter().flat_map(|edge| edge.sides) {
                    let vanishes = rims.vanishes(side);
                    assert!(!(plenty[side.triangle()] && vanishes));
                    with_plenty += usize::from(plenty[side.triangle()]);
                    vanished += usize::from(vanishes);
                }
            }
        }
        assert!(with_plenty > 100 && vanished > 0, "{with_plenty} {vanished}");
    }

    // .----.          the bevel of one corner is as long as the width asks for: nothing vanishes
    // |     `.
    // |       |
    // '-------'
    #[test]
    fn an_edge_that_keeps_enough_does_not_vanish() {
        let mesh = plate(&BEVELLED);
        let stages = stages_of(&mesh, 0.1);
        assert!(stages.vanishing.runs.is_empty());
        let aside = 0.1 * (std::f64::consts::PI / 8.0).tan();
        assert_goes(&stages, [2.0, 1.9], [1.9, 1.9 - aside]);
    }

    #[test]
    fn a_corner_of_many_short_edges_goes_as_one() {
        let (c, s) = (0.05 * (1.0 - 0.866_025_4), 0.05 * 0.5);
        let rounded = [
            [0.0, 0.0],
            [2.0, 0.0],
            [2.0, 1.95],
            [2.0 - c, 1.95 + s],
            [1.95 + s, 2.0 - c],
            [1.95, 2.0],
            [0.0, 2.0],
        ];
        let mesh = plate(&rounded);
        let stages = stages_of(&mesh, 0.2);
        let mut lengths: Vec<usize> =
            stages.vanishing.runs.iter().map(|run| run.members.len()).collect();
        lengths.sort_unstable();
        assert_eq!(lengths, [4, 4]);
        assert_goes(&stages, rounded[2], [1.8, 1.785]);
        assert_goes(&stages, rounded[3], [1.8 - 0.3 * f64::from(c), 1.785 + 0.3 * f64::from(s)]);
        assert_goes(&stages, rounded[5], [1.785, 1.8]);
        assert_chamfers_well(&mesh, 0.2);
    }

    // .---.   a pin that is thinner than its chamfers: the whole rim would vanish, and there is nothing to
    // |   |   go on with
    // '---'
    #[test]
    fn a_rim_that_vanishes_whole_stays_as_it_is() {
        let cube = shapes::plain_cube(0.3);
        let stages = stages_of(&cube, 0.2);
        assert!(stages.vanishing.runs.is_empty());
        let way = stages.offsets.iter().map(|offset| offset.vector.length());
        assert!(way.into_iter().all(|way| (way - 0.2 * 2.0_f64.sqrt()).abs() < 1e-6));
    }

    // .-------------------.   the long edges of a bar never meet, and those of a wedge too far away
    // '-------------------'
    #[test]
    fn edges_that_meet_nowhere_near_stay_as_they_are() {
        for narrow in [0.3, 0.2] {
            let bar = plate(&[[0.0, 0.0], [2.0, 0.0], [2.0, narrow], [0.0, 0.3]]);
            assert!(stages_of(&bar, 0.2).vanishing.runs.is_empty(), "{narrow}");
        }
    }

    /// The bevel of the front alone is to be narrower; by half, it goes along.
    #[test]
    fn an_edge_that_is_to_be_far_narrower_does_not_vanish() {
        let mesh = plate(&BEVELLED);
        let whole = stages_of(&mesh, 0.2);
        for (narrow, runs) in [(0.4, 1), (0.6, 2)] {
            let listed = |edge: &HardEdge| {
                let ends = [edge.sides[0], edge.sides[0].next()];
                let at = ends.map(|end| whole.view.position_at(end));
                let is_bevel = at.iter().all(|at| at.z == 1.0 && (at.x + at.y - 3.9).abs() < 1e-6);
                let factor = if is_bevel { narrow } else { 1.0 };
                EdgeFactor { vertices: ends.map(|end| whole.view.vertex_at(end).0), factor }
            };
            let edges: Vec<EdgeFactor> = whole.edges.hard.iter().map(listed).collect();
            let factors = Factors { edges: &edges, ..Factors::default() };
            let options = Options::default().with_width(Width::Units(0.2));
            let stages = stages_of_mesh(Mesh { factors, ..mesh.as_mesh() }, &options);
            assert_eq!(stages.vanishing.runs.len(), runs, "{narrow}");
        }
    }
}
