//! Apart: what stood beside each other does not come to stand together.
//!
//! A skin that was copied and moved, or came through a file of text, lies on itself but for a step of
//! single precision here and there. Where both skins are pulled, rounding brings such vertices
//! together, and an edge that two faces had would be one of four.

use crate::bvh::{Aabb, Tree};
use crate::error::Error;
use crate::ids::{Id, IdVec, Ring, Sector, Vertex};
use crate::mesh::Mesh;
use crate::placement::Placement;
use crate::ranks::{Ranks, stepped, steps};
use crate::resample::is_same;
use crate::sectors::Sectors;
use crate::surface::Surface;
use crate::watch::{Watch, collect, each, sort, stretches};
use crate::weld::{Weld, weld};

/// Of more skins that lie on each other the next ones begin anew: a place is never off by more steps
/// than half of these.
const MOST_RANKS: u32 = 8;

/// So many neighbours are looked at: where far more lie so near, nothing can be told apart.
const MOST_NEAR: usize = 64;

/// None where none have come together that were apart, as in most meshes. Points inside of rounded
/// chamfers (`segments`) may come together by themselves: there, none where no two vertices nearly touch.
///
/// Where skins lie on each other, they have some vertices in common: there they are apart, too, as next
/// to these they may have two. But open parts may be closed by nothing but that they stand at one place.
///
/// # Errors
/// [`Error::Cancelled`] where the watch stops it.
pub fn apart(
    surface: Surface,
    sectors: &Sectors,
    placement: &Placement,
    segments: u32,
    watch: &dyn Watch,
) -> Result<Option<Ranks>, Error> {
    let near = surface.view.resolution as f32;
    let nearly_touching = sharing_cells(sectors, placement, near, watch)?;
    if nearly_touching.is_empty() {
        return Ok(None);
    }
    let cluster = |sector: Sector| surface.topology.cluster_at[sectors.fans[sector].first].0;
    let is_open = open_rings(sectors, watch)?;
    let skin = |sector: Sector| {
        let ring = sectors.fans[sector].ring;
        if is_open[ring] { sectors.rings.len() as u32 + cluster(sector) } else { ring.0 }
    };
    let skin_of = |ring: Ring| skin(sectors.ring(ring)[0]);
    if nearly_touching.iter().all(|&[one, other]| skin_of(one) == skin_of(other)) {
        return Ok(None);
    }
    if segments == 1 && !has_met(placement, &skin, near, watch)? {
        return Ok(None);
    }
    if ranks(placement, &cluster, near, watch)?.are_one() {
        return Ok(None);
    }
    ranks(placement, &skin, near, watch).map(Some)
}

/// `#rings`: whether it has a border.
///
/// Found once: asked of each sector, a large ring would take quadratic time.
fn open_rings(sectors: &Sectors, watch: &dyn Watch) -> Result<IdVec<Ring, bool>, Error> {
    watch.worked(sectors.fans.len())?;
    let has_border = |sector: &Sector| sectors.fans[*sector].ends_at_border();
    let is_open = |ring| sectors.ring(Ring::new(ring)).iter().any(has_border);
    collect(sectors.rings.len(), watch, is_open).map(IdVec::from_vec)
}

/// Where something stands in the source, in steps of single precision, and its number.
type Place = ([i32; 3], u32);

fn is_near([one, other]: [[f32; 3]; 2], near: f32) -> bool {
    (0..3).all(|k| (one[k] - other[k]).abs() <= near)
}

fn base(placement: &Placement, sector: Sector) -> [f32; 3] {
    placement.base(sector).as_vec3().to_array()
}

/// A cell of the grid by which it is told what may nearly touch is so many times as large as what
/// counts as near: most vertices reach into no other one then, and few share theirs.
const CELL: f32 = 61.0;

/// The cells into which what is near a place reaches, from the lowest to the highest: mostly one.
fn ends(place: [f32; 3], near: f32) -> [[f32; 3]; 2] {
    let share = 1.0 / (CELL * near);
    // Twice as far, for rounding.
    [-2.0, 2.0].map(|far| place.map(|at| ((at + far * near) * share) as i32 as f32))
}

/// The cells from the lowest to the highest of a place.
fn cells([low, high]: [[f32; 3]; 2]) -> impl Iterator<Item = [f32; 3]> {
    let is_other =
        move |k: &usize| (0..3).all(|axis| k >> axis & 1 == 0 || low[axis] != high[axis]);
    let corners = (0..8).filter(is_other);
    corners.map(move |k| [0, 1, 2].map(|axis| [low, high][k >> axis & 1][axis]))
}

/// Rings that share a cell before they move. In most meshes none do, and so none are near each other.
fn sharing_cells(
    sectors: &Sectors,
    placement: &Placement,
    near: f32,
    watch: &dyn Watch,
) -> Result<Vec<[Ring; 2]>, Error> {
    let count = sectors.rings.len();
    let (mut places, mut rings) = (Vec::with_capacity(count), Vec::with_capacity(count));
    each(count, watch, |ring: Ring| {
        let ends = ends(base(placement, sectors.ring(ring)[0]), near);
        if is_same(ends[0], ends[1]) {
            places.push(ends[0]);
        } else {
            places.extend(cells(ends));
        }
        rings.resize(places.len(), ring);
    })?;
    let Weld { cluster_of, first_vertex } =
        weld(&Mesh { positions: &places, ..Mesh::default() }, watch)?;
    if first_vertex.len() == places.len() {
        return Ok(Vec::new());
    }
    let pair = |k: usize| [rings[first_vertex[cluster_of[Vertex::new(k)]].index()], rings[k]];
    Ok((0..rings.len()).map(pair).filter(|[one, other]| one != other).collect())
}

/// Whether some of different skins that have moved have met, of those that were near each other before.
fn has_met(
    placement: &Placement,
    skin: &dyn Fn(Sector) -> u32,
    near: f32,
    watch: &dyn Watch,
) -> Result<bool, Error> {
    watch.worked(placement.share.len())?;
    let moved: Vec<Sector> = placement.share.ids().filter(|&s| placement.has_moved(s)).collect();
    let points = collect(moved.len(), watch, |k| placement.stored(moved[k]).as_vec3().to_array())?;
    let Weld { cluster_of, first_vertex } =
        weld(&Mesh { positions: &points, ..Mesh::default() }, watch)?;
    for stretch in stretches(moved.len(), watch) {
        let has_met = stretch?.any(|k| {
            let first = first_vertex[cluster_of[Vertex::new(k)]].index();
            let [one, other] = [first, k].map(|k| skin(moved[k]));
            one != other && is_near([first, k].map(|k| base(placement, moved[k])), near)
        });
        if has_met {
            return Ok(true);
        }
    }
    Ok(false)
}

/// Of all that nearly touch each has the first rank that none before it has: by where they stand, and
/// only then by their numbers.
fn ranks(
    placement: &Placement,
    number: &dyn Fn(Sector) -> u32,
    near: f32,
    watch: &dyn Watch,
) -> Result<Ranks, Error> {
    let count = placement.share.len();
    let place = |sector: usize| -> Place {
        let sector = Sector::new(sector);
        (base(placement, sector).map(steps), number(sector))
    };
    let mut places = collect(count, watch, place)?;
    sort(&mut places, watch)?;
    places.dedup();
    let at = |place: usize| Aabb::around(&[places[place].0.map(|steps| stepped(0.0, steps))]);
    let boxes = collect(places.len(), watch, |place| at(place).grown(near))?;
    let tree = Tree::watched(&boxes, &[], watch)?;
    let mut rank_at: Vec<u32> = Vec::with_capacity(places.len());
    for place in 0..places.len() {
        watch.worked(1)?;
        let others = tree.overlapping(at(place)).take(MOST_NEAR).map(|other| other as usize);
        let before = others.filter(|&other| other < place);
        let taken = before.fold(0_u32, |taken, other| taken | 1 << rank_at[other]);
        rank_at.push(taken.trailing_ones() % MOST_RANKS);
    }
    let rank = collect(count, watch, |sector| {
        places.binary_search(&place(sector)).map_or(0, |place| rank_at[place])
    })?;
    Ok(Ranks::new(IdVec::from_vec(rank)))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Wherever the borders of cells are between two places.
    #[test]
    fn what_is_near_shares_a_cell() {
        let near = 1.0 / 4096.0;
        let cells_of = |at: [f32; 3]| cells(ends(at, near));
        for step in 0..4000 {
            let at = [step as f32 / 8192.0 - 0.25, 0.3, step as f32 / -1024.0];
            let others = [at.map(|k| k + near), [at[0] + near, at[1], at[2] - near]];
            for other in others {
                let mut shared = cells_of(at).filter(|cell| cells_of(other).any(|c| c == *cell));
                assert!(shared.next().is_some(), "{at:?} {other:?}");
            }
        }
        assert!(cells_of([0.3; 3]).all(|cell| cells_of([0.4; 3]).all(|c| c != cell)));
    }
}
