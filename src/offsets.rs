//! Offsets: where each sector's vertex goes at full width (thesis 6.3).
//!
//! Between two chamfered edges with fan angle `a` the vertex moves along the direction at `a / 2`,
//! measured by unfolding the fan, by `h / sin(a / 2)`: on a flat sector that is the bisector, and
//! both pulled edges run parallel to the old ones at distance `h`. The direction lies on the
//! surface of the triangle that contains it, so the vertex stays on the surface.
//!
//! Where that would bend a surface, the vertex slides along the bend instead: along the border at
//! the end of a sector, or along the sharpest crease inside of it.

mod along;
mod fronts;
mod large;
mod place;
mod simple;
mod turned;

use std::sync::{Mutex, PoisonError};

use glam::DVec3;

use crate::breaks::{is_hard, uv_at};
use crate::chamfers::Chamfers;
use crate::edges::Edges;
use crate::error::Error;
use crate::faces::Faces;
use crate::foot::{Arms, Foot, arms};
use crate::ids::{Corner, Id, IdVec, Sector};
use crate::math::Turn;
use crate::sectors::{Fan, Sectors};
use crate::surface::Surface;
use crate::threads::Threads;
use crate::tolerance::{CREASE_COSINE, FLAT_COSINE, LEAST_SLIDE_SINE};
use crate::topology::Topology;
use crate::view::View;
use crate::watch::{Times, Watch};

pub use along::go_along;
pub use fronts::{is_one_face, narrow, narrow_all, parts};
use large::{MANY_CORNERS, offset_of_large};
use place::place;
use simple::offset_of_simple;
pub use turned::turned;

/// No vertex moves farther than this many widths: between edges that meet at less than 39 degrees
/// the exact distance shoots out, and a tip would lose its point. The corners of ramps and
/// triangles, from 45 degrees on, still get the exact one. The thesis gives up there (modifiers
/// above 10); moving less far keeps a chamfer, which narrows towards the tip.
pub const MITER_LIMIT: f64 = 3.0;

/// A vertex slides along a seam of the texture where that opens the narrower of its two edges by at
/// least this share of the wider.
const LEAST_BALANCE: f64 = 0.25;

/// So many steps it takes to unfold a sector and to find its way, as a watch counts them.
const STEPS_OF_SECTOR: usize = 4;

/// Where a sector's vertex goes at full width.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Offset {
    /// From the old position to the new one, in mesh units; zero if the vertex stays.
    pub vector: DVec3,
    /// The corner of the triangle that the direction lies on.
    pub within: Corner,
    /// Where the vector ends on the surface.
    pub foot: Foot,
    /// Whether the distance was cut off at the miter limit.
    pub is_capped: bool,
    /// How much of what was asked for the vector is for the sector's first and for its last edge.
    pub fronts: [f64; 2],
    /// Whether the sector's corners are of one vertex, all on faces that have a plane and no hard edge
    /// between them: then all streams are read at the foot.
    pub is_plain: bool,
    /// Whether these faces are in one plane, too.
    pub is_even: bool,
}

impl Offset {
    /// For a corner that stays.
    fn none(within: Corner) -> Offset {
        Offset {
            vector: DVec3::ZERO,
            within,
            foot: Foot::at(within),
            is_capped: false,
            fronts: [1.0; 2],
            is_plain: false,
            is_even: false,
        }
    }

    pub fn moves(&self) -> bool {
        self.vector != DVec3::ZERO
    }
}

/// What is known of a mesh that was the same but for some triangles.
pub struct Known<'a> {
    pub sectors: &'a Sectors,
    pub offsets: &'a IdVec<Sector, Offset>,
    /// `#triangles`: whether it is not what it was.
    pub is_new: &'a [bool],
}

impl Known<'_> {
    /// The offset of a sector, where nothing of it has changed.
    fn of(&self, topology: &Topology, sectors: &Sectors, sector: Sector) -> Option<Offset> {
        let mut corners = sectors.corners(topology, sector);
        if corners.any(|corner| self.is_new[corner.triangle().index()]) {
            return None;
        }
        let fan = &sectors.fans[sector];
        let before = self.sectors.sector_of[fan.first];
        if before.is_none() || !fan.moves_as(&self.sectors.fans[before]) {
            return None;
        }
        // It may lie on a triangle beside the fan.
        let offset = self.offsets[before];
        (!self.is_new[offset.foot.corner.triangle().index()]).then_some(offset)
    }
}

/// `#sectors`; those that are known are not found anew.
///
/// # Errors
/// [`Error::Cancelled`] where the watch stops it.
pub fn offsets(
    surface: Surface,
    chamfers: Chamfers,
    known: Option<&Known>,
    (threads, watch): (&Threads, &dyn Watch),
) -> Result<IdVec<Sector, Offset>, Error> {
    let (Surface { topology, .. }, Chamfers { sectors, .. }) = (surface, chamfers);
    let count = sectors.fans.len();
    let slow = &Times(STEPS_OF_SECTOR, watch);
    let large = Mutex::new(Vec::new());
    let mut offsets = threads.map_with(
        count,
        slow,
        Vec::new,
        #[inline(always)]
        |spread, sector| {
            if let Some(offset) = known.and_then(|known| known.of(topology, sectors, sector)) {
                return offset;
            }
            let fan = &sectors.fans[sector];
            if let Some(offset) = offset_of_simple(surface, chamfers.edges, fan) {
                return offset;
            }
            let Some(is_even) = unfold(surface, fan, (spread, MANY_CORNERS)) else {
                large.lock().unwrap_or_else(PoisonError::into_inner).push(sector);
                return Offset::none(fan.first);
            };
            offset(surface, chamfers.edges, fan, (spread, is_even))
        },
    )?;
    for sector in large.into_inner().unwrap_or_else(PoisonError::into_inner) {
        offsets[sector] = offset_of_large(surface, chamfers, sector, watch)?;
    }
    go_along(surface, sectors, (&mut offsets, None), watch)?;
    Ok(offsets)
}

/// A corner of a fan, unfolded into the plane.
struct Blade {
    corner: Corner,
    arms: Arms,
    /// The angle from the fan's first edge to the corner's first edge.
    start: Turn,
    /// The angle from the fan's first edge to the corner's last edge.
    end: Turn,
}

impl Blade {
    /// The angle of the corner.
    fn angle(&self) -> Turn {
        Turn::between(self.arms[0], self.arms[1])
    }
}

/// A corner of a fan, unfolded next to the one before it.
#[inline(always)]
fn blade(view: &View, corner: Corner, before: Option<&Blade>) -> Blade {
    let arms = arms(view, corner);
    let angle = Turn::between(arms[0], arms[1]);
    match before {
        None => Blade { corner, arms, start: Turn::ZERO, end: angle },
        Some(&Blade { end: start, .. }) => Blade { corner, arms, start, end: start.plus(angle) },
    }
}

/// Unfolds the corners of a fan, and tells whether it is one flat face with one texture, as most are:
/// nothing in it bends, or parts. None if there are more than so many.
#[inline(always)]
fn unfold(
    Surface { view, topology, faces }: Surface,
    fan: &Fan,
    (spread, most): (&mut Vec<Blade>, usize),
) -> Option<bool> {
    let (mut corner, face) = (fan.first, fan.first.triangle());
    let (vertex, normal) = (view.vertex_at(corner), faces.normal[face]);
    let (at, mut arms) = (view.position(vertex), arms(view, corner));
    let (mut start, mut end) = (Turn::ZERO, Turn::between(arms[0], arms[1]));
    let mut is_even = !fan.is_broken && normal != DVec3::ZERO && !faces.is_line(face);
    spread.clear();
    spread.push(Blade { corner, arms, start, end });
    while corner != fan.last {
        if spread.len() == most {
            return None;
        }
        let before = corner.prev();
        corner = topology.twin[before];
        is_even = is_even
            && view.vertex_at(corner) == vertex
            && view.vertex_at(corner.next()) == view.vertex_at(before)
            && faces.normal[corner.triangle()] == normal
            && !faces.is_line(corner.triangle());
        arms = match is_even {
            true => [arms[1], view.position_at(corner.prev()) - at],
            false => self::arms(view, corner),
        };
        (start, end) = (end, end.plus(Turn::between(arms[0], arms[1])));
        spread.push(Blade { corner, arms, start, end });
    }
    Some(is_even)
}

/// Where the vertex of a fan goes, or that it stays.
#[inline(always)]
fn offset(
    surface: Surface,
    edges: &Edges,
    fan: &Fan,
    (spread, is_even): (&[Blade], bool),
) -> Offset {
    let is_plain = is_even || is_plain(surface, fan, spread);
    let stays = || Offset { is_plain, is_even, ..Offset::none(fan.first) };
    let Some(course) = course(surface, edges, fan, (spread, is_even)) else { return stays() };
    let Some((vector, foot)) = place(surface, (spread, is_even), &course) else { return stays() };
    let (Course { blade, is_capped, .. }, fronts) = (course, [1.0; 2]);
    Offset { vector, within: blade.corner, foot, is_capped, fronts, is_plain, is_even }
}

/// Whether a fan has one vertex, and a plane on every face.
#[inline(never)]
fn is_plain(Surface { view, faces, .. }: Surface, fan: &Fan, spread: &[Blade]) -> bool {
    let vertex = view.vertex_at(spread[0].corner);
    !fan.is_broken
        && spread.iter().all(|blade| {
            let triangle = blade.corner.triangle();
            view.vertex_at(blade.corner) == vertex
                && faces.normal[triangle] != DVec3::ZERO
                && !faces.is_line(triangle)
        })
}

/// A way to go: an angle inside one corner, and a distance.
struct Course<'a> {
    blade: &'a Blade,
    /// From the corner's first edge.
    angle: Turn,
    distance: f64,
    is_capped: bool,
}

/// The widths asked for at a fan's first and at its last edge; at a border, that of the other.
#[inline(always)]
fn widths(edges: &Edges, fan: &Fan) -> [f64; 2] {
    let (first, last) = (fan.first, fan.last.prev());
    let Edges { hard, chamfered_at, .. } = edges;
    let (one, other) = (chamfered_at[first], chamfered_at[last]);
    // The last half-edge ends here: the other side of its edge starts here.
    match (one.is_some(), other.is_some()) {
        (true, true) => [hard[one].width_at_start(first), hard[other].width_at_end(last)],
        (true, false) => [hard[one].width_at_start(first); 2],
        (false, true) => [hard[other].width_at_end(last); 2],
        (false, false) => [0.0; 2],
    }
}

/// Whether a fan lies between two chamfered edges, in a mesh where nothing else matters at its ends.
#[inline(always)]
fn is_between_edges(Surface { topology, .. }: Surface, edges: &Edges, fan: &Fan) -> bool {
    !fan.starts_at_border
        && !fan.ends_at_border()
        && topology.twin[fan.first] != fan.last.prev()
        && topology.contacts.is_empty()
        && edges.parted.is_empty()
}

#[inline(always)]
fn course<'a>(
    surface: Surface,
    edges: &Edges,
    fan: &Fan,
    (spread, is_even): (&'a [Blade], bool),
) -> Option<Course<'a>> {
    // So nearly all are.
    if is_even && is_between_edges(surface, edges, fan) {
        return meet(spread.last()?.end, spread, widths(edges, fan));
    }
    course_beside_others(surface, edges, fan, (spread, is_even))
}

/// The same beside borders, contacts and edges that stay hard, and where the fan bends.
#[inline(never)]
fn course_beside_others<'a>(
    surface: Surface,
    edges: &Edges,
    fan: &Fan,
    (spread, is_even): (&'a [Blade], bool),
) -> Option<Course<'a>> {
    let (Surface { view, topology, faces }, widths) = (surface, widths(edges, fan));
    let (first, last) = (spread.first()?, spread.last()?);
    let total = last.end;
    match (fan.starts_at_border, fan.ends_at_border()) {
        // Light would show where one of the solids left the contact.
        _ if holds_contact(topology, spread) => None,
        (true, true) => None,
        _ if !edges.parted.is_empty() && is_parted(topology, edges, fan) => {
            slide_parted(surface, edges, (fan, spread), widths)
        }
        // Parts that only touch, as at a T-junction, would gape where one of them moves.
        (true, false) | (false, true) if fan.borders_meet => None,
        // At a border the vertex has to stay on it, which no hard edge inside the fan allows.
        (true, false) | (false, true) if !is_even && crease(view, faces, spread).is_hard() => None,
        (true, false) => slide(first, Turn::ZERO, &[(total, widths[1])]),
        (false, true) => slide(last, last.angle(), &[(total, widths[0])]),
        // One edge on both sides: it ends here, and its chamfer tapers to a point.
        (false, false) if topology.twin[fan.first] == fan.last.prev() => None,
        (false, false) if is_even => meet(total, spread, widths),
        (false, false) => match crease(view, faces, spread) {
            Crease::None => {
                slide_on_seam(view, total, spread, widths).or_else(|| meet(total, spread, widths))
            }
            Crease::Soft(blade) => {
                slide_inside(total, blade, widths).or_else(|| meet(total, spread, widths))
            }
            Crease::Hard(blade) => slide_inside(total, blade, widths),
            Crease::Several => None,
        },
    }
}

/// Whether a fan begins or ends at an edge that stays hard.
fn is_parted(topology: &Topology, edges: &Edges, fan: &Fan) -> bool {
    let last = fan.last.prev();
    edges.parted_at(fan.first).is_some()
        || edges.chamfered_at[last].is_none() && edges.parts_at_end(topology, last)
}

/// Along the edge that stays hard: the fan's first one, or the one that it goes on behind.
fn slide_parted<'a>(
    surface: Surface,
    edges: &Edges,
    (fan, spread): (&Fan, &'a [Blade]),
    [first, last]: [f64; 2],
) -> Option<Course<'a>> {
    let Some(parted) = edges.parted_at(fan.first) else {
        let Crease::Hard(blade) = crease(surface.view, surface.faces, spread) else { return None };
        return slide(blade, Turn::ZERO, &[(blade.start, first)]);
    };
    let (blade, whole) = (spread.first()?, spread.last()?);
    if edges.chamfered_at[fan.last.prev()].is_some() {
        return slide(blade, Turn::ZERO, &[(whole.end, last)]);
    }
    Some(Course { blade, angle: Turn::ZERO, distance: parted.width, is_capped: false })
}

/// Whether solids touch along an edge inside the fan.
fn holds_contact(topology: &Topology, spread: &[Blade]) -> bool {
    !topology.contacts.is_empty()
        && spread.iter().skip(1).any(|blade| topology.is_contact(blade.corner))
}

/// To the place that is as far from both edges as asked; half way between them where that is too
/// far away, as where edges of unlike widths run straight on.
#[inline(always)]
fn meet(total: Turn, spread: &[Blade], widths: [f64; 2]) -> Option<Course<'_>> {
    let [first, last] = widths;
    if first == last { bisect(total, spread, first) } else { meet_apart(total, spread, widths) }
}

/// The same where the widths are unlike.
#[inline(never)]
fn meet_apart(total: Turn, spread: &[Blade], [first, last]: [f64; 2]) -> Option<Course<'_>> {
    // From the first edge: so far ahead along it, where it is `first` away.
    let ahead = (last + first * total.cos()) / total.sin();
    let (distance, angle) = (ahead.hypot(first), Turn::toward(ahead, first));
    let is_near = distance <= MITER_LIMIT * first.max(last) && angle < total;
    let blade = spread.iter().find(|blade| angle <= blade.end);
    match blade.filter(|_| is_near) {
        Some(blade) => {
            let angle = angle.minus(blade.start);
            Some(Course { blade, angle, distance, is_capped: false })
        }
        None => {
            let between = bisect(total, spread, (first + last) / 2.0)?;
            Some(Course { is_capped: true, ..between })
        }
    }
}

/// Along the direction at half the fan's angle.
#[inline(always)]
fn bisect(total: Turn, spread: &[Blade], width: f64) -> Option<Course<'_>> {
    let half = total.half();
    let blade = spread.iter().find(|blade| half <= blade.end)?;
    let sine = half.sin();
    let distance = (width / sine).min(width * MITER_LIMIT);
    (sine > 0.0).then(|| Course {
        blade,
        angle: half.minus(blade.start),
        distance,
        is_capped: sine * MITER_LIMIT < 1.0,
    })
}

/// Along an edge of the fan, by the distance that fits the angles to the chamfered edges best.
fn slide<'a>(blade: &'a Blade, angle: Turn, to_chamfered: &[(Turn, f64)]) -> Option<Course<'a>> {
    let sines = || to_chamfered.iter().map(|(turn, _)| turn.sin());
    let may_slide = to_chamfered.iter().all(|(turn, _)| turn.is_convex())
        && sines().any(|sine| sine >= LEAST_SLIDE_SINE);
    let widest = to_chamfered.iter().map(|(_, width)| *width).fold(0.0, f64::max);
    if widest == 0.0 {
        return None;
    }
    // Least squares over the distances that the pulled edges get.
    let asked = to_chamfered.iter().map(|(turn, width)| width / widest * turn.sin());
    let best = asked.sum::<f64>() / sines().map(|sine| sine * sine).sum::<f64>();
    may_slide.then(|| Course {
        blade,
        angle,
        distance: widest * best.min(MITER_LIMIT),
        is_capped: best > MITER_LIMIT,
    })
}

/// Along an edge in the middle of the fan.
fn slide_inside(total: Turn, blade: &Blade, [first, last]: [f64; 2]) -> Option<Course<'_>> {
    let to_chamfered = [(blade.start, first), (total.minus(blade.start), last)];
    slide(blade, Turn::ZERO, &to_chamfered)
}

/// Along the texture seam inside a fan that leads most nearly to the middle, so that the vertices
/// of both charts stay in their own; none where that would narrow the chamfer.
fn slide_on_seam<'a>(
    view: &View,
    total: Turn,
    spread: &'a [Blade],
    widths: [f64; 2],
) -> Option<Course<'a>> {
    let sines = |blade: &Blade| [blade.start.sin(), total.minus(blade.start).sin()];
    let balance = |blade: &Blade| {
        let [one, other] = sines(blade);
        one.min(other) / one.max(other)
    };
    let is_seam = |place: &usize| is_seam(view, spread[*place].corner, spread[*place - 1].corner);
    let blade = (1..spread.len())
        .filter(is_seam)
        .map(|place| &spread[place])
        .max_by(|one, other| balance(one).total_cmp(&balance(other)))?;
    (balance(blade) >= LEAST_BALANCE).then(|| slide_inside(total, blade, widths)).flatten()
}

/// Whether two corners at one position lie in different charts of some UV channel.
fn is_seam(view: &View, one: Corner, other: Corner) -> bool {
    let [one, other] = [one, other].map(|corner| view.vertex_at(corner).index());
    one != other && view.mesh.uvs.iter().any(|uv| uv_at(uv, one) != uv_at(uv, other))
}

/// The bends inside a fan that keep a vertex from leaving them.
enum Crease<'a> {
    /// The fan is flat, or nearly so.
    None,
    /// The vertex may slide along this blade's first edge.
    Soft(&'a Blade),
    /// The vertex may move nowhere but along this blade's first edge, which stays hard.
    Hard(&'a Blade),
    /// The fan bends at a hard edge that stays hard, and elsewhere too: any move would bend a face.
    Several,
}

impl Crease<'_> {
    fn is_hard(&self) -> bool {
        matches!(self, Crease::Hard(_) | Crease::Several)
    }
}

/// The hard edge that is not chamfered, if there is one, or else the sharpest bend.
fn crease<'a>(view: &View, faces: &Faces, spread: &'a [Blade]) -> Crease<'a> {
    // A single triangle does not bend, and most faces of more are flat.
    let normal = |blade: &Blade| faces.normal[blade.corner.triangle()];
    let is_flat = |pair: &[Blade]| {
        normal(&pair[0]) == normal(&pair[1])
            && !is_hard(view, pair[1].corner, pair[0].corner.prev())
    };
    if spread.windows(2).all(is_flat) {
        return Crease::None;
    }
    let mut sharpest = (CREASE_COSINE, Crease::None);
    let mut kept = Crease::None;
    let mut before = DVec3::ZERO;
    let mut crosses_hard = false;
    for (place, blade) in spread.iter().enumerate() {
        let behind = faces.normal[blade.corner.triangle()];
        crosses_hard |= place > 0 && is_hard(view, blade.corner, spread[place - 1].corner.prev());
        // A triangle without area has no normal: the bend is to the face behind it.
        if behind == DVec3::ZERO {
            continue;
        }
        let cosine = before.dot(behind);
        let is_kept =
            crosses_hard && (cosine < FLAT_COSINE || !is_level(view, faces, spread, place));
        if before != DVec3::ZERO && is_kept {
            kept = if matches!(kept, Crease::None) { Crease::Hard(blade) } else { Crease::Several };
        } else if before != DVec3::ZERO && cosine < sharpest.0 {
            sharpest = (cosine, Crease::Soft(blade));
        }
        (before, crosses_hard) = (behind, false);
    }
    match (kept, sharpest.1) {
        (Crease::None, soft) => soft,
        (hard, Crease::None) => hard,
        _ => Crease::Several,
    }
}

/// Whether the surfaces on both sides of a hard edge, that of a place in a fan, lie in one plane. Else
/// a vertex that left the edge would go over one of them, out of the other.
fn is_level(view: &View, faces: &Faces, spread: &[Blade], place: usize) -> bool {
    let (before, behind) = spread.split_at(place);
    let runs_on = |one: &Blade, other: &Blade| !is_hard(view, other.corner, one.corner.prev());
    let sides = [before.chunk_by(runs_on).next_back(), behind.chunk_by(runs_on).next()];
    let blades = sides.into_iter().flatten().flatten();
    let mut normals = blades.map(|blade| faces.normal[blade.corner.triangle()]);
    let first = normals.find(|normal| *normal != DVec3::ZERO);
    first.is_none_or(|first| normals.all(|n| n == DVec3::ZERO || n.dot(first) >= FLAT_COSINE))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ids::Id;
    use crate::mesh::MeshBuffers;
    use crate::shapes;
    use crate::stages::{split, stages_of};

    /// The offsets of the sectors whose vertex stands at a point and has a normal.
    fn offsets_at(mesh: &MeshBuffers, width: f32, at: [f32; 3], normal: [f32; 3]) -> Vec<Offset> {
        let stages = stages_of(mesh, width);
        let is_meant = |sector: &Sector| {
            let vertex = stages.view.vertex_at(stages.sectors.fans[*sector].first).index();
            mesh.positions[vertex] == at && mesh.normals[vertex] == normal
        };
        stages.sectors.fans.ids().filter(is_meant).map(|sector| stages.offsets[sector]).collect()
    }

    #[track_caller]
    fn assert_goes(offsets: &[Offset], expected: [f64; 3]) {
        assert_eq!(offsets.len(), 1);
        let vector = offsets[0].vector;
        assert!(vector.distance(DVec3::from(expected)) < 1e-6, "{vector}");
    }

    const UP: [f32; 3] = [0.0, 1.0, 0.0];

    #[test]
    fn at_a_right_angle_the_vertex_goes_by_the_width_along_both_edges() {
        let cube = shapes::plain_cube(2.0);
        assert_goes(&offsets_at(&cube, 0.1, [1.0; 3], UP), [-0.1, 0.0, -0.1]);
    }

    #[test]
    fn at_a_reflex_angle_the_vertex_goes_away_from_the_notch() {
        let l = shapes::l_shape();
        let front = [0.0, 0.0, 1.0];
        assert_goes(&offsets_at(&l, 0.1, [1.0; 3], front), [-0.1, -0.1, 0.0]);
    }

    #[test]
    fn on_a_crease_the_vertex_slides_along_it() {
        let cylinder = shapes::cylinder(12);
        let front = [0.0, 0.0, 1.0];
        assert_goes(&offsets_at(&cylinder, 0.1, [0.0, 1.0, 0.5], front), [0.0, -0.1, 0.0]);
    }

    #[test]
    fn on_a_border_the_vertex_slides_along_it() {
        let open = shapes::open_box();
        let front = [0.0, 0.0, 1.0];
        assert_goes(&offsets_at(&open, 0.1, [1.0; 3], front), [-0.1, 0.0, 0.0]);
    }

    #[test]
    fn where_one_hard_edge_ends_the_vertex_stays() {
        let block = shapes::wedge_end();
        let at_end = offsets_at(&block, 0.1, [1.0; 3], UP);
        assert_eq!(at_end.len(), 1);
        assert!(!at_end[0].moves());
    }

    // 3 ------------- 0     the top of a box: 5 is off the plane by rounding, so that the small
    // |           5 / |     triangle 0-4-5 leans by a tenth of a degree
    // |            4  |
    // 2 ------------- 1
    #[test]
    fn where_a_small_triangle_leans_by_rounding_a_larger_one_carries_the_vertex() {
        let top = [[1.0, 1.0, 1.0], [1.0, 1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, 1.0, 1.0]];
        let inside = [[0.99, 1.0, 0.985], [0.9985, 1.000_002, 0.999]];
        let bottom = top.map(|[x, _, z]| [x, -1.0, z]);
        let points = [&top[..], &inside[..], &bottom[..]].concat();
        let mut indices = vec![0, 1, 4, 0, 4, 5, 0, 5, 3, 1, 2, 4, 4, 2, 5, 5, 2, 3];
        for (a, b) in [(0, 3), (3, 2), (2, 1), (1, 0)] {
            indices.extend([a, b, b + 6, a, b + 6, a + 6]);
        }
        indices.extend([6, 9, 8, 6, 8, 7]);
        let box_ = split(&points, &indices);
        let stages = stages_of(&box_, 0.1);
        let at_corner = |sector: &Sector| {
            let fan = &stages.sectors.fans[*sector];
            stages.view.position_at(fan.first) == DVec3::ONE
                && stages.faces.normal[fan.first.triangle()].y > 0.5
        };
        let sector = stages.sectors.fans.ids().find(at_corner).unwrap();
        let offset = &stages.offsets[sector];
        assert!(offset.vector.y.abs() < 1e-9, "{}", offset.vector);
        let blend = offset.foot.blend(&stages.view, 1.0);
        let corners = blend.vertices.map(|v| stages.view.position(crate::ids::Vertex(v)));
        let rebuilt = crate::resample::weighted_sum(&blend, corners);
        assert!(rebuilt.distance(DVec3::ONE + offset.vector) < 1e-6, "{rebuilt}");
    }

    /// A blade of 2.3 degrees: the exact distance would be fifty widths.
    #[test]
    fn at_a_sharp_tip_the_distance_is_cut_off() {
        let points = [
            [0.0, 0.0, 0.0],
            [10.0, -0.2, 0.0],
            [10.0, 0.2, 0.0],
            [0.0, 0.0, 1.0],
            [10.0, -0.2, 1.0],
            [10.0, 0.2, 1.0],
        ];
        let sides = [0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4, 2, 0, 3, 2, 3, 5];
        let indices = [&[0, 2, 1, 3, 4, 5][..], &sides[..]].concat();
        let blade = split(&points, &indices);
        let tip = offsets_at(&blade, 0.01, [0.0, 0.0, 1.0], [0.0, 0.0, 1.0]);
        assert!(tip[0].is_capped);
        assert!((tip[0].vector.length() - 0.01 * MITER_LIMIT).abs() < 1e-6);
    }

    // 2
    // | .            a ramp: at its toe the edges meet at 45 degrees
    // |    .
    // 0--------1
    #[test]
    fn the_toe_of_a_ramp_gets_the_exact_distance() {
        let side = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
        let points: Vec<[f32; 3]> =
            [0.0, 1.0].into_iter().flat_map(|z| side.map(|[x, y]| [x, y, z])).collect();
        let indices = vec![0, 2, 1, 3, 4, 5, 0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4, 2, 0, 3, 2, 3, 5];
        let ramp = split(&points, &indices);
        let toe = offsets_at(&ramp, 0.01, [1.0, 0.0, 1.0], [0.0, 0.0, 1.0]);
        assert!(!toe[0].is_capped);
        let exact = 0.01 / (std::f64::consts::FRAC_PI_4 / 2.0).sin();
        assert!((toe[0].vector.length() - exact).abs() < 1e-6);
    }

    /// All sectors at the tip are sharp: their angles are 16 degrees, and the exact distance would
    /// be seven widths.
    #[test]
    fn no_vertex_goes_farther_than_three_widths() {
        let cone = shapes::pyramid(16);
        let stages = stages_of(&cone, 0.01);
        let ways = stages.offsets.iter().map(|offset| offset.vector.length());
        let longest = ways.fold(0.0, f64::max);
        assert!((longest - 0.03).abs() < 1e-6, "{longest}");
    }

    //              .  3
    //          .     /     the edge 0-3 is hard, 0-1 a border: sliding along it, the vertex at 0
    //      .        /      would be a width away from the edge after nine
    //  0 --------- 1
    #[test]
    fn a_vertex_does_not_slide_far_along_a_border() {
        let points = [[0.0, 0.0, 0.0], [9.0, 0.0, 0.0], [9.0, -3.0, 0.0], [9.0, 1.0, 0.0]];
        let folded = [[9.0, 1.0, -5.0]];
        let sheet = split(&[&points[..], &folded[..]].concat(), &[0, 1, 3, 0, 3, 4]);
        let at_origin = offsets_at(&sheet, 0.01, [0.0; 3], [0.0, 0.0, 1.0]);
        assert!(at_origin[0].is_capped);
        assert_goes(&at_origin, [0.01 * MITER_LIMIT, 0.0, 0.0]);
    }
}
