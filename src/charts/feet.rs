//! Feet: where in its owner's chart the far vertices of a chamfer come to lie.

use glam::DVec3;

use super::{Given, Spread, Way, Wings};
use crate::breaks::seam_between;
use crate::foot::locate;
use crate::ids::{Corner, Few, Sector};
use crate::math::{area_vector, unit};
use crate::report::Blend;
use crate::sectors::{Fan, Sectors};
use crate::surface::Surface;
use crate::view::View;

/// So many sides of a chamfer are tried in pairs: of more, every so manyth.
const MOST_SIDES: usize = 8;

/// A middle vertex lies halfway between the old corner and the pulled one.
const MIDDLE_SHARE: f64 = 0.5;

/// A strip reaches at most so far into its owner's triangle.
const DEEPEST: f64 = 0.9;

/// What is laid flat into a triangle reaches at most so far along its sides.
const WIDEST: f64 = 0.98;

/// One end of a strip, seen from its owner's side.
#[derive(Clone, Copy)]
pub struct End {
    /// The owner's.
    pub half_edge: Corner,
    /// The old edge, from where that starts.
    pub edge: [DVec3; 2],
    /// 0 where that starts, 1 where it ends.
    pub place: f64,
    /// The pulled corner of the owner's side, and of the far one.
    pub near: DVec3,
    pub far: DVec3,
}

impl End {
    /// The distance from the old edge to the pulled one, and from there to the far side.
    fn widths(&self) -> [f64; 2] {
        let [from, to] = self.edge;
        let along = unit(to - from);
        let across = |way: DVec3| (way - along * way.dot(along)).length();
        [self.near - from, self.far - self.near].map(across)
    }
}

fn ends(view: &View, half_edge: Corner) -> [DVec3; 2] {
    [half_edge, half_edge.next()].map(|corner| view.position_at(corner))
}

/// Where the near and the far corner at one end of a strip come to lie; none where one stays in its
/// own chart.
pub fn feet_at(surface: Surface, end: &End, way: Way) -> [Option<Blend>; 2] {
    match way {
        Way::Band(spread) => [None, band_foot(surface, end, spread)],
        Way::Inside => inside(surface.view, end).map(Some),
        Way::Abreast => abreast(surface, end).map_or([None; 2], |feet| feet.map(Some)),
        Way::Kite(_) | Way::Flat | Way::Roomiest => [None; 2],
    }
}

/// Where one far corner of a strip lands on its owner's band.
pub fn band_foot(surface: Surface, end: &End, spread: Spread) -> Option<Blend> {
    let share = match spread {
        Spread::Far | Spread::Narrow => share_of(end.edge, end.far),
        Spread::Near => share_of(end.edge, end.near),
        Spread::Whole => end.place,
    };
    let [band, strip] = if spread == Spread::Narrow { end.widths() } else { [0.0; 2] };
    if strip >= band {
        return Some(on_edge(surface.view, end.half_edge, share));
    }
    let [from, to] = end.edge;
    let inward = surface.faces.normal[end.half_edge.triangle()].cross(unit(to - from));
    let way = (to - from) * share.clamp(0.0, 1.0) + inward * (band - strip);
    locate(surface.view, end.half_edge, from, way).map(|foot| foot.blend(surface.view, 1.0))
}

/// The near and the far corner at one end of a strip that is laid into its owner's triangle, as
/// deep as the strip is wide.
fn inside(view: &View, end: &End) -> [Blend; 2] {
    let [from, to] = end.edge;
    let apex = view.position_at(end.half_edge.prev());
    let height = (to - from).cross(apex - from).length() / (to - from).length();
    let [_, strip] = end.widths();
    let depth = (strip / height).min(DEEPEST);
    let foot = |pulled: DVec3| on_edge(view, end.half_edge, share_of(end.edge, pulled));
    let apex = Blend::one(view.vertex_at(end.half_edge.prev()).0);
    let near = mixed(&[(foot(end.near), 1.0 - depth), (apex, depth)]);
    [near, foot(end.far)]
}

/// As [`inside`], but straight into the owner's plane, past its triangle where that is too small.
fn abreast(surface: Surface, end: &End) -> Option<[Blend; 2]> {
    let [from, to] = end.edge;
    let [_, strip] = end.widths();
    let inward = surface.faces.normal[end.half_edge.triangle()].cross(unit(to - from));
    let way = (to - from) * share_of(end.edge, end.near).clamp(0.0, 1.0) + inward * strip;
    let near = locate(surface.view, end.half_edge, from, way)?.blend(surface.view, 1.0);
    Some([near, on_edge(surface.view, end.half_edge, share_of(end.edge, end.far))])
}

/// Where the foot of the perpendicular from a pulled vertex divides an edge: 0 to 1, or beyond.
#[inline(always)]
pub fn share_of([from, to]: [DVec3; 2], pulled: DVec3) -> f64 {
    (pulled - from).dot(to - from) / (to - from).length_squared()
}

/// The place at a share of a half-edge.
#[inline(always)]
pub fn on_edge(view: &View, half_edge: Corner, share: f64) -> Blend {
    let [from, to] = [half_edge, half_edge.next()].map(|corner| view.vertex_at(corner).0);
    let share = share.clamp(0.0, 1.0);
    match [1.0 - share, share].map(|weight| weight as f32) {
        [0.0, weight] => Blend { vertices: [to; 3], weights: [weight, 0.0, 0.0] },
        [weight, 0.0] => Blend { vertices: [from; 3], weights: [weight, 0.0, 0.0] },
        [near, far] => Blend { vertices: [from, to, from], weights: [near, far, 0.0] },
    }
}

/// A weighted sum of blends that have no more than three vertices between them; of others, those
/// that come first.
pub fn mixed(terms: &[(Blend, f64)]) -> Blend {
    let mut sum = Blend { vertices: [0; 3], weights: [0.0; 3] };
    let mut used = 0;
    for (blend, share) in terms {
        for (&vertex, &weight) in blend.vertices.iter().zip(&blend.weights) {
            let added = (f64::from(weight) * share) as f32;
            if added == 0.0 {
                continue;
            }
            let known = sum.vertices[..used].iter().position(|&other| other == vertex);
            let place = known.unwrap_or(used);
            if place < 3 {
                sum.vertices[place] = vertex;
                sum.weights[place] += added;
                used = used.max(place + 1);
            }
        }
    }
    for place in used..3 {
        sum.vertices[place] = sum.vertices[0];
    }
    sum
}

/// Where a fill lies in its owner's chart.
#[derive(Default)]
pub struct Lay {
    /// `#sectors`: none where a vertex stays in its own chart.
    pub feet: Few<Option<Blend>>,
    /// The sector whose vertex is copied first: the others follow around the ring.
    pub begin: usize,
    /// For each vertex in the middle.
    pub middles: Vec<Blend>,
}

/// The kite between the pulled corner of one of a ring's sectors, the feet on its two edges, and
/// the old corner. The other vertices lie on a bow from foot to foot that bends towards the old
/// corner, so that no three of them are in line.
///
/// `below` is where far corners of strips are known to lie below themselves: see [`feet_of_wings`].
pub fn kite(
    given: &Given,
    sectors: &[Sector],
    (owner, wings, middles): (usize, Wings, usize),
    below: [Option<Blend>; 2],
    lay: &mut Lay,
) {
    let Given { surface, chamfers, placement, .. } = *given;
    let sector = sectors[owner];
    let below = if wings == Wings::Far { below } else { [None; 2] };
    let [behind, before] = feet_of_wings(given, (sector, wings), below);
    let fan = &chamfers.sectors.fans[sector];
    let corner = Blend::one(surface.view.vertex_at(fan.first).0);
    let on_bow = |along: f64| {
        let [from, to] = [1.0 - along, along].map(|share| share * share * share);
        match along {
            0.0 => behind,
            1.0 => before,
            _ => mixed(&[(behind, from), (corner, 1.0 - from - to), (before, to)]),
        }
    };
    let share = placement.share[sector] * MIDDLE_SHARE;
    let middle = |_| placement.chart_foot(sector, fan.first).blend(surface.view, share);
    lay.begin = owner;
    lay.feet.clear();
    lay.feet.extend(on_others(sectors.len(), owner, on_bow));
    lay.middles.clear();
    lay.middles.extend((0..middles).map(middle));
}

/// For each sector of a ring but the owner, what lies at its share of the way from the owner's last
/// edge to its first.
fn on_others(
    count: usize,
    owner: usize,
    at: impl Fn(f64) -> Blend,
) -> impl Iterator<Item = Option<Blend>> {
    let steps = (count - 2).max(1) as f64;
    let foot = move |place: usize| {
        let step = if place < owner { place + count - owner } else { place - owner };
        (step > 0).then(|| at((step - 1) as f64 / steps))
    };
    (0..count).map(foot)
}

/// The feet on a sector's last and first edge; the old corner itself where the last one lies in
/// another chart. Of some it is known where they are, first of that on the first edge.
#[inline(always)]
pub fn feet_of_wings(
    given: &Given,
    (sector, wings): (Sector, Wings),
    [before, behind]: [Option<Blend>; 2],
) -> [Blend; 2] {
    let view = given.surface.view;
    let fan = &given.chamfers.sectors.fans[sector];
    let corner = view.vertex_at(fan.first).0;
    let foot = |half_edge, is_out| foot_of_wing(given, (sector, wings), (half_edge, is_out));
    let before = before.unwrap_or_else(|| foot(fan.first, true));
    if given.channels.iter().any(|&channel| is_broken(view, fan, channel)) {
        return [Blend::one(corner), before];
    }
    let mut behind = behind.unwrap_or_else(|| foot(fan.last.prev(), false));
    let last = view.vertex_at(fan.last).0;
    if last != corner {
        behind.vertices = behind.vertices.map(|v| if v == last { corner } else { v });
    }
    [behind, before]
}

/// The foot on the half-edge out of a sector's corner, or on that back to it.
#[inline(never)]
fn foot_of_wing(
    given: &Given,
    (sector, wings): (Sector, Wings),
    (half_edge, is_out): (Corner, bool),
) -> Blend {
    let Given { surface: Surface { view, .. }, chamfers, placement, .. } = *given;
    let edge = chamfers.edges.chamfered_at[half_edge];
    if wings == Wings::Far && edge.is_some() {
        let [one, two] = chamfers.edges.hard[edge].sides;
        let other = if one == half_edge { two } else { one };
        let across = if is_out { other.next() } else { other };
        let far = placement.point[chamfers.sectors.sector_of[across]];
        return on_edge(view, half_edge, share_of(ends(view, half_edge), far));
    }
    let reach = if let Wings::Near(reach) = wings { reach } else { 1.0 };
    let share = share_of(ends(view, half_edge), placement.point[sector]);
    let reached = if is_out { reach * share } else { 1.0 - reach * (1.0 - share) };
    on_edge(view, half_edge, reached)
}

/// A place to lay a chamfer flat.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Room {
    /// In the triangle at this corner.
    pub corner: Corner,
    /// So many times as large as it is, if there is room.
    pub scale: f64,
}

/// A chamfer laid flat into a triangle.
pub fn flat_lay(view: &View, Room { corner, scale }: Room, frame: &Frame, ring: usize) -> Lay {
    let face = area_vector(view.triangle(corner.triangle())).length();
    let size = (scale * (frame.opening / face).sqrt()).min(WIDEST / frame.farthest);
    let vertices = [corner, corner.next(), corner.prev()].map(|c| view.vertex_at(c).0);
    let blend = |at: &[f64; 2]| {
        let [to_next, to_prev] = at.map(|along| size * along);
        Blend::new(vertices, [1.0 - to_next - to_prev, to_next, to_prev])
    };
    let mut blends = frame.flat.iter().map(blend);
    let feet = blends.by_ref().take(ring).map(Some).collect();
    Lay { feet, begin: 0, middles: blends.collect() }
}

/// A chamfer laid flat, in terms of two of its sides.
pub struct Frame {
    /// `#points`: how far along each of the two sides, from the least.
    flat: Few<[f64; 2]>,
    /// Twice the area between the sides.
    opening: f64,
    /// The greatest sum of both.
    farthest: f64,
}

impl Frame {
    /// Of the frames of the chamfer's sides, the one with the smallest triangle around the whole. Its
    /// points are those around it and then its middles; the normal is that of the whole.
    pub fn new(points: &[DVec3], ring: usize, normal: DVec3) -> Frame {
        let step = ring.div_ceil(MOST_SIDES).max(1);
        let sides = (0..ring).step_by(step);
        let side = |place: usize| points[(place + 1) % ring] - points[place];
        let pairs = sides.clone().flat_map(|one| sides.clone().map(move |other| [one, other]));
        let frames = pairs
            .filter_map(|[one, other]| Frame::of_sides(points, [side(one), -side(other)], normal));
        let closest = frames.min_by(|one, other| one.girth().total_cmp(&other.girth()));
        closest.unwrap_or_else(|| Frame::point(points.len()))
    }

    /// Seen along a unit normal; none where the sides do not open.
    fn of_sides(points: &[DVec3], [one, other]: [DVec3; 2], normal: DVec3) -> Option<Frame> {
        let opening = one.cross(other).dot(normal);
        let along = |point: &DVec3| {
            let way = *point - points[0];
            [way.cross(other), one.cross(way)].map(|part| part.dot(normal) / opening)
        };
        let mut flat: Few<[f64; 2]> = points.iter().map(along).collect();
        let least = [0, 1].map(|k| flat.iter().map(|at| at[k]).fold(0.0, f64::min));
        flat.iter_mut().for_each(|at| *at = [at[0] - least[0], at[1] - least[1]]);
        let farthest = flat.iter().map(|at| at[0] + at[1]).fold(0.0, f64::max);
        (opening > 0.0).then_some(Frame { flat, opening, farthest })
    }

    /// All at one place: what opens nowhere has no area.
    fn point(count: usize) -> Frame {
        let flat = std::iter::repeat_n([0.0; 2], count).collect();
        Frame { flat, opening: 0.0, farthest: 1.0 }
    }

    /// Twice the area of the triangle around the whole that has sides along those of the frame.
    fn girth(&self) -> f64 {
        self.opening * self.farthest * self.farthest
    }
}

/// Whether a sector and one other go all around their cluster.
pub fn is_pair(sectors: &Sectors, sector: Sector) -> bool {
    let ring = sectors.fans[sector].ring;
    sectors.rings[ring].closed && sectors.ring(ring).len() == 2
}

/// Whether a seam of a channel runs through a sector.
#[inline]
pub fn is_broken(view: &View, fan: &Fan, channel: usize) -> bool {
    fan.first != fan.last && seam_between(view, channel, fan.first, fan.last)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ids::Triangle;
    use crate::shapes;
    use crate::stages::stages_of;

    fn weight_of(blend: &Blend, vertex: u32) -> f32 {
        let pairs = blend.vertices.into_iter().zip(blend.weights);
        pairs.filter(|(other, _)| *other == vertex).map(|(_, weight)| weight).sum()
    }

    #[test]
    fn blends_are_summed_vertex_by_vertex() {
        let [a, b] = [Blend::one(3), Blend::one(5)];
        assert_eq!(mixed(&[(a, 1.0), (b, 0.0)]), a);
        let once = mixed(&[(a, 0.75), (b, 0.25)]);
        assert_eq!([3, 5].map(|vertex| weight_of(&once, vertex)), [0.75, 0.25]);
        let twice = mixed(&[(once, 0.5), (a, 0.5)]);
        assert_eq!([3, 5].map(|vertex| weight_of(&twice, vertex)), [0.875, 0.125]);
    }

    #[test]
    fn the_foot_of_a_pulled_vertex_lies_on_the_old_edge() {
        let cube = shapes::cube(1.0);
        let stages = stages_of(&cube, 0.1);
        let mut placement = stages.placed(0.0);
        let sector = Sector(0);
        placement.set(sector, 1.0);
        let side = stages.sectors.fans[sector].first;
        let share = share_of(ends(&stages.view, side), placement.point[sector]);
        let foot = on_edge(&stages.view, side, share);
        let [from, to] = [side, side.next()].map(|corner| stages.view.vertex_at(corner).0);
        assert!((weight_of(&foot, from) - 0.9).abs() < 1e-6, "{foot:?}");
        assert!((weight_of(&foot, to) - 0.1).abs() < 1e-6, "{foot:?}");
    }

    /// Every other side of a regular hexagon lies on the triangle around it, of which it is two
    /// thirds.
    #[test]
    fn what_is_too_large_for_a_face_is_laid_as_large_as_it_can_be() {
        let cube = shapes::cube(1.0);
        let stages = stages_of(&cube, 0.1);
        let at = |k: usize| {
            let (sin, cos) = (k as f64 * std::f64::consts::FRAC_PI_3).sin_cos();
            DVec3::new(cos, sin, 0.0)
        };
        let points: Vec<DVec3> = (0..6).map(at).collect();
        let room = Room { corner: Corner(0), scale: 1.0 };
        let lay = flat_lay(&stages.view, room, &Frame::new(&points, 6, DVec3::Z), 6);
        let place = |blend: &Option<Blend>| {
            let positions =
                blend.unwrap().vertices.map(|v| stages.view.position(crate::ids::Vertex(v)));
            crate::resample::weighted_sum(&blend.unwrap(), positions)
        };
        let laid: Vec<DVec3> = lay.feet.iter().map(place).collect();
        let areas = (1..5).map(|k| area_vector([laid[0], laid[k], laid[k + 1]]).length());
        let share = areas.sum::<f64>() / area_vector(stages.view.triangle(Triangle(0))).length();
        assert!((share - 2.0 / 3.0 * WIDEST * WIDEST).abs() < 1e-6, "{share}");
        let point = Frame::new(&[DVec3::ZERO; 3], 3, DVec3::ZERO);
        let collapsed = flat_lay(&stages.view, room, &point, 3);
        assert!(collapsed.feet.iter().all(|foot| foot.unwrap().weights[0] == 1.0));
    }

    /// A flat right angle of half the face's area, in the face's right angle.
    #[test]
    fn a_fill_in_a_corner_keeps_its_shape_and_area() {
        let cube = shapes::cube(1.0);
        let stages = stages_of(&cube, 0.1);
        let points = [DVec3::ZERO, DVec3::X * 0.5, DVec3::Y * 0.5, DVec3::new(0.1, 0.1, 0.0)];
        let room = Room { corner: Corner(0), scale: 1.0 };
        let lay = flat_lay(&stages.view, room, &Frame::new(&points, 3, DVec3::Z), 3);
        let [from, next, prev] = [0, 1, 2].map(|corner| stages.view.vertex_at(Corner(corner)).0);
        let weights = |blend: &Blend| [from, next, prev].map(|v| weight_of(blend, v));
        let feet: Vec<[f32; 3]> = lay.feet.iter().flatten().map(weights).collect();
        assert_eq!(feet, [[1.0, 0.0, 0.0], [0.5, 0.5, 0.0], [0.5, 0.0, 0.5]]);
        let middle = weights(&lay.middles[0]);
        assert!((middle[0] - 0.8).abs() < 1e-6 && (middle[1] - 0.1).abs() < 1e-6);
    }
}
