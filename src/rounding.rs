//! Rounding: patches with more than one segment across.
//!
//! What the limits have found valid with one segment is the control polygon: each patch gets rows
//! of points between that and the old surface. An end of a strip has as many rows as all that stand
//! on it can have, so that nothing gapes; where a patch would fold or cut, its ends get fewer, down
//! to one segment, which is known to be valid.

mod arc;
mod ends;
mod fill;
mod lay;

use glam::DVec3;

use crate::chamfers::Chamfers;
use crate::error::Error;
use crate::ids::{Edge, Few, Id, IdVec, Patch, Vertex};
use crate::intersect::Triangle;
use crate::memory;
use crate::patches::{Parts, Patches, nearest};
use crate::placement::Placement;
use crate::report::Blend;
use crate::threads::Threads;
use crate::view::View;
use crate::watch::{Times, Watch};

use ends::{End, ends_of, near};
pub use ends::{Rows, joined};
use fill::{lay_fill, loose_ends};
pub use lay::Parents;
use lay::{Lay, lay_strip};

/// All rounded patches, by the number of that with one segment.
#[derive(Default)]
pub struct Rounding {
    /// `#hard edges`: how many segments each end got.
    rows: Rows,
    /// `#patches`: where the points and the triangles of each end. A patch without stays as it is.
    ends: Vec<[u32; 2]>,
    points: Vec<Point>,
    triangles: Vec<[u32; 3]>,
}

/// A point of a rounded patch that is no joint.
pub struct Point {
    /// As it is stored.
    pub position: DVec3,
    pub normal: DVec3,
    /// What comes nearest to it on the source.
    pub near: Blend,
    pub parents: Parents,
    /// Whether another patch has it too.
    pub is_shared: bool,
}

/// One rounded patch.
#[derive(Clone, Copy)]
pub struct Rounded<'a> {
    /// First the middles of the patch with one segment, where they are now.
    pub points: &'a [Point],
    /// Places in the joints, and past them in the points.
    pub triangles: &'a [[u32; 3]],
}

/// The triangles of a patch that has more than one segment, by the rows of all, as they are stored.
pub type Triangles<'a> = dyn Fn(&Rows, Patch) -> Option<Vec<Triangle>> + Sync + 'a;

/// Takes rows from patches that cut; false where none had any to give.
pub type Lessen<'a> = dyn FnMut(&mut Rows, &[Patch]) -> Result<bool, Error> + 'a;

/// Lessens rows until nothing cuts.
pub type Search<'a> = dyn Fn(&mut Rows, &Triangles, &mut Lessen) -> Result<(), Error> + 'a;

/// Rounds all patches, with at most so many segments; none where that is one. `search` looks
/// for patches that would cut something, and lessens their rows until none does.
///
/// # Errors
/// [`Error::OutOfMemory`] and [`Error::TooLarge`] where the points cannot be had, and
/// [`Error::Cancelled`] where the watch stops it.
pub fn rounding(
    given: Given,
    patches: &Patches,
    segments: u32,
    (threads, watch): (&Threads, &dyn Watch),
    search: Option<&Search>,
) -> Result<Option<Rounding>, Error> {
    if segments < 2 {
        return Ok(None);
    }
    // Fills have about so many points.
    let work = (threads, &Times((segments * segments) as usize, watch) as &dyn Watch);
    let mut rows = first_rows(given, patches, segments as u8);
    let all: Vec<Patch> = (0..patches.len()).map(Patch::new).collect();
    settle(given, patches, &mut rows, all, work)?;
    if let Some(search) = search {
        let rounded = |rows: &Rows, patch: Patch| triangles_of(given, patches, rows, patch);
        let mut lessen = |rows: &mut Rows, cutting: &[Patch]| {
            let fewer = fewer_rows(given, patches, rows, cutting);
            let is_less = !fewer.is_empty();
            settle(given, patches, rows, fewer, work)?;
            Ok(is_less)
        };
        search(&mut rows, &rounded, &mut lessen)?;
    }
    ask_for_memory(given, patches, &rows)?;
    Ok(Some(made(given, patches, rows, work)?))
}

impl Rounding {
    /// A rounded patch; none where it stays as it is.
    pub fn of(&self, patch: Patch) -> Option<Rounded<'_>> {
        let place = patch.index();
        let [from, to] = [place.checked_sub(1).map_or([0; 2], |k| self.ends[k]), self.ends[place]];
        let range = |k: usize| from[k] as usize..to[k] as usize;
        let rounded =
            Rounded { points: &self.points[range(0)], triangles: &self.triangles[range(1)] };
        (!rounded.triangles.is_empty()).then_some(rounded)
    }

    /// How many triangles there are, of rounded patches and others.
    pub fn triangle_count(&self, patches: &Patches) -> usize {
        let all = (0..patches.len()).map(Patch::new);
        let own = |patch| patches.parts(patch).triangles.len();
        all.map(|patch| self.of(patch).map_or_else(|| own(patch), |r| r.triangles.len())).sum()
    }

    /// How many segments the ends of an edge have; one that does not open, as many as were asked for.
    pub fn rows(&self, edge: Edge) -> [u8; 2] {
        self.rows[edge]
    }

    /// Ends a patch.
    fn end(&mut self) {
        self.ends.push([self.points.len(), self.triangles.len()].map(|count| count as u32));
    }

    fn append(&mut self, others: &mut Rounding) {
        let [points, triangles] = self.ends.last().copied().unwrap_or_default();
        let ends = others.ends.drain(..);
        self.ends.extend(ends.map(|[p, t]| [points + p, triangles + t]));
        self.points.append(&mut others.points);
        self.triangles.append(&mut others.triangles);
    }
}

/// As many as asked for, but at ends that nothing but another strip closes.
fn first_rows(given: Given, patches: &Patches, segments: u8) -> Rows {
    let mut rows = IdVec::filled([segments; 2], given.chamfers.edges.hard.len());
    for ring in given.chamfers.sectors.rings.ids() {
        if given.chamfers.sectors.ring(ring).len() < 3 {
            continue;
        }
        for end in loose_ends(&given, ring, patches.fill(ring)) {
            rows[given.edge(end)][given.place_of(end)] = 1;
        }
    }
    // A flap is flat, and lies along the end of a strip where there is no fill between.
    for parted in &given.chamfers.edges.parted {
        let sectors = given.chamfers.sectors;
        let ring = sectors.ring(sectors.fans[sectors.sector_of[parted.corner]].ring);
        if ring.len() < 3 {
            let ends = ring.iter().filter_map(|&sector| given.after(sector));
            for end in ends.filter(|&end| given.is_open(end)) {
                rows[given.edge(end)][given.place_of(end)] = 1;
            }
        }
    }
    rows
}

/// Gives fewer rows to what is not valid, until all is.
fn settle(
    given: Given,
    patches: &Patches,
    rows: &mut Rows,
    mut suspects: Vec<Patch>,
    (threads, watch): (&Threads, &dyn Watch),
) -> Result<(), Error> {
    while !suspects.is_empty() {
        let is_bad = |&patch: &Patch| {
            let mut lay = Lay::default();
            lay_patch(given, patches, rows, patch, &mut lay) && !lay.is_valid(given.view.resolution)
        };
        let bad = threads.map_each(&suspects, watch, is_bad)?;
        let bad: Vec<Patch> =
            suspects.iter().zip(bad).filter(|(_, bad)| *bad).map(|(&patch, _)| patch).collect();
        suspects = fewer_rows(given, patches, rows, &bad);
    }
    Ok(())
}

/// Halves the rows of the ends that some patches have; tells all patches that have one of these.
fn fewer_rows(given: Given, patches: &Patches, rows: &mut Rows, bad: &[Patch]) -> Vec<Patch> {
    let mut ends: Vec<End> = bad.iter().flat_map(|&p| ends_of_patch(given, patches, p)).collect();
    ends.extend(ends.clone().into_iter().filter_map(|end| given.twin_of(end)));
    ends.sort_unstable_by_key(|end| end.0);
    ends.dedup();
    let mut around = Vec::new();
    for end in ends {
        let count = &mut rows[given.edge(end)][given.place_of(end)];
        if *count > 1 {
            *count /= 2;
            around.push(Patch(given.edge(end).0));
            around.push(patches.fill_of(given.ring_of(end)));
        }
    }
    around.sort_unstable();
    around.dedup();
    around
}

fn ends_of_patch(given: Given, patches: &Patches, patch: Patch) -> Few<End> {
    match patches.edge_or_ring(patch) {
        Ok(edge) => {
            let edge = &given.chamfers.edges.hard[edge];
            End::of(edge).into_iter().filter(|&end| given.is_open(end)).collect()
        }
        Err(ring) => {
            ends_of(&given, ring).map(|(_, end)| end).filter(|&end| given.is_open(end)).collect()
        }
    }
}

/// Lays a patch where it has more than one segment.
fn lay_patch(given: Given, patches: &Patches, rows: &Rows, patch: Patch, lay: &mut Lay) -> bool {
    let parts = patches.parts(patch);
    if parts.triangles.is_empty() {
        return false;
    }
    match patches.edge_or_ring(patch) {
        Ok(edge) => {
            let ends = End::of(&given.chamfers.edges.hard[edge]);
            lay_strip(&given, rows, parts, ends, lay)
        }
        Err(ring) => lay_fill(&given, rows, (ring, parts), lay),
    }
}

/// The triangles of a patch that has more than one segment, as they are stored.
fn triangles_of(
    given: Given,
    patches: &Patches,
    rows: &Rows,
    patch: Patch,
) -> Option<Vec<Triangle>> {
    let mut lay = Lay::default();
    lay_patch(given, patches, rows, patch, &mut lay).then(|| {
        let parts = patches.parts(patch);
        let stored = |place: usize| match parts.joints.get(place) {
            Some(&joint) => given.placement.stored_at(joint),
            None => lay.stored_at(&given, parts, place).as_vec3().to_array(),
        };
        lay.triangles.iter().map(|triangle| triangle.map(|place| stored(place as usize))).collect()
    })
}

/// All points and triangles, with what they come from.
fn made(
    given: Given,
    patches: &Patches,
    rows: Rows,
    (threads, watch): (&Threads, &dyn Watch),
) -> Result<Rounding, Error> {
    let mut rounding = Rounding::default();
    let add = |patch: Patch, block: &mut Rounding| {
        let mut lay = Lay::default();
        if lay_patch(given, patches, &rows, patch, &mut lay) {
            block.add(given, patches, patch, &lay);
        }
        block.end();
    };
    threads.gather((patches.len(), watch), &mut rounding, add, Rounding::append)?;
    Ok(Rounding { rows, ..rounding })
}

impl Rounding {
    fn add(&mut self, given: Given, patches: &Patches, patch: Patch, lay: &Lay) {
        let parts = patches.parts(patch);
        let joints = parts.joints.len();
        for (at, place) in (joints..).zip(&lay.places[joints..joints + parts.middles.len()]) {
            let near = nearest(given.view, parts.joints, place.point);
            let parents = Parents { places: [at as u32; 3], weights: [1.0, 0.0, 0.0] };
            let (position, normal) = (lay.stored_at(&given, parts, at), place.normal);
            self.points.push(Point { position, normal, near, parents, is_shared: false });
        }
        let added = lay.added.iter().zip(joints + parts.middles.len()..);
        for (added, at) in added {
            let place = lay.places[at];
            let near = match &added.end {
                Some((end, point)) => given.near_end(*end, point),
                None => self.near_inside(given, parts, added.parents, place.point),
            };
            self.points.push(Point {
                position: lay.stored_at(&given, parts, at),
                normal: place.normal,
                near,
                parents: added.parents,
                is_shared: added.end.is_some(),
            });
        }
        self.triangles.extend(&lay.triangles);
    }

    /// What a point inside of a fill is nearest to: as its corners, of which one may be a middle.
    fn near_inside(&self, given: Given, parts: Parts, parents: Parents, point: DVec3) -> Blend {
        let joints = parts.joints.len();
        let sector = given.chamfers.sectors.sector_of[parts.joints[0]];
        let of = |k: usize| parents.places[k] as usize;
        let own: Few<usize> = (0..3).filter(|&k| of(k) < joints).collect();
        let corners: Few<_> = own.iter().map(|&k| parts.joints[of(k)]).collect();
        let sum: f64 = own.iter().map(|&k| parents.weights[k]).sum();
        let shares: Few<f64> = own.iter().map(|&k| parents.weights[k] / sum).collect();
        let by_joints = near(&given, sector, &corners, &shares, point);
        if sum >= 1.0 {
            return by_joints;
        }
        let by_middle = nearest(given.view, parts.joints, point);
        let corner = Blend::one(given.view.vertex_at(parts.joints[0]).0);
        let terms = [(corner, 0.0), (by_joints, sum), (by_middle, 1.0 - sum)];
        joined(|vertex| given.view.position(Vertex(vertex)), terms.into_iter())
    }
}

/// What is made of so many rows at most.
fn ask_for_memory(given: Given, patches: &Patches, rows: &Rows) -> Result<(), Error> {
    let rows_at = |end: End| given.rows_at(rows, end) as u64;
    let (mut points, mut triangles) = (0_u64, 0_u64);
    for edge in given.chamfers.edges.hard.ids().filter(|&e| !patches.strip(e).triangles.is_empty())
    {
        let [one, other] = rows[edge].map(u64::from);
        points += one + other;
        triangles += one + other;
    }
    for ring in given.chamfers.sectors.rings.ids() {
        let most = ends_of(&given, ring).map(|(_, end)| rows_at(end)).max().unwrap_or(1);
        let grids = patches.fill(ring).triangles.len() as u64;
        points += grids * (most + 1) * (most + 2) / 2;
        triangles += grids * most * most;
    }
    let mesh = &given.view.mesh;
    let most = u64::from(u32::MAX);
    let [vertices, corners] = [mesh.positions.len(), mesh.indices.len()].map(|count| count as u64);
    // Charts copy vertices, of new points too.
    if 2 * (vertices + points) > most || corners + 3 * triangles > most {
        return Err(Error::TooLarge);
    }
    memory::ask(memory::of_rounding(mesh, points, triangles))
}

/// The arguments of [`rounding`](super::rounding), for the files of this stage alone.
#[derive(Clone, Copy)]
pub struct Given<'a> {
    pub view: &'a View<'a>,
    pub chamfers: Chamfers<'a>,
    pub placement: &'a Placement<'a>,
    pub profile: f64,
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::MeshBuffers;
    use crate::shapes;
    use crate::stages::stages_of;

    /// The rows of each edge after some patches were bad once, of eight at first, and what is to be
    /// looked at again.
    fn lessened(mesh: &MeshBuffers, bad: impl Fn(Given, &Patches) -> Patch) -> (Rows, Vec<Patch>) {
        let stages = stages_of(mesh, 0.1);
        let (placement, chamfers) = (stages.placement(), stages.chamfers());
        let patches = stages.patches(&placement);
        let given = Given { view: &stages.view, chamfers, placement: &placement, profile: 0.5 };
        let mut rows = first_rows(given, &patches, 8);
        assert!(rows.iter().all(|ends| *ends == [8; 2]));
        let bad = bad(given, &patches);
        let around = fewer_rows(given, &patches, &mut rows, &[bad]);
        (rows, around)
    }

    fn count(rows: &Rows, ends: [u8; 2]) -> usize {
        rows.iter().filter(|found| **found == ends).count()
    }

    //   8------4====4------8     a strip halves both of its ends; the fills there, which have these
    //                            ends too, and it itself are looked at again
    #[test]
    fn a_bad_strip_halves_both_ends() {
        let (rows, around) = lessened(&shapes::plain_cube(1.0), |_, _| Patch::new(0));
        assert_eq!(rows[Edge::new(0)], [4; 2]);
        assert_eq!((count(&rows, [4; 2]), count(&rows, [8; 2])), (1, 11));
        let fills = |patch: &&Patch| patch.index() >= 12;
        assert_eq!((around.len(), around.iter().filter(fills).count()), (3, 2));
        assert_eq!(around[0], Patch::new(0));
    }

    #[test]
    fn a_bad_fill_halves_the_ends_around_it() {
        let fill = |given: Given, patches: &Patches| {
            patches.fill_of(given.ring_of(End::of(&given.chamfers.edges.hard[Edge::new(0)])[0]))
        };
        let (rows, around) = lessened(&shapes::plain_cube(1.0), fill);
        assert_eq!(count(&rows, [4, 8]) + count(&rows, [8, 4]), 3);
        assert_eq!(count(&rows, [8; 2]), 9);
        let strips = |patch: &&Patch| patch.index() < 12;
        assert_eq!((around.len(), around.iter().filter(strips).count()), (4, 3));
    }

    //  8----4|4====4|4----8     where two strips have one curve, both get fewer there
    #[test]
    fn a_bad_strip_halves_the_ends_that_it_shares() {
        let (rows, around) = lessened(&shapes::cylinder(8), |_, _| Patch::new(0));
        assert_eq!((count(&rows, [4; 2]), count(&rows, [8; 2])), (1, 13));
        assert_eq!(count(&rows, [4, 8]) + count(&rows, [8, 4]), 2);
        assert_eq!(around.iter().filter(|patch| patch.index() < 16).count(), 3);
    }
}
