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
use crate::sectors::Sectors;
use crate::surface::Surface;
use crate::watch::{Watch, collect, sort, stretches};
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
    let cluster = |sector: Sector| surface.topology.cluster_at[sectors.fans[sector].first].0;
    let is_open = open_rings(sectors, watch)?;
    let skin = |sector: Sector| {
        let ring = sectors.fans[sector].ring;
        if is_open[ring] { sectors.rings.len() as u32 + cluster(sector) } else { ring.0 }
    };
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
