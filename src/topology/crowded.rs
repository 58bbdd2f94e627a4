//! Twins where more than two half-edges lie between the same two clusters.
//!
//! Faces belong together by what is seen. Around the edge, each face has air on the side of its
//! normal and a solid behind it. A gap between two neighbours that both face into it is *air*, and
//! those two are visible. All others lie inside the solids that visible ones bound: they are hidden.
//! A hidden face without a partner is left over, as a border. The rest is paired around the solids,
//! so that two boxes that touch stay two boxes.
//!
//! Equal normals do not pair: the flush tops of two boxes side by side would join, and the walls
//! between them stay behind as a fin.

use std::cmp::Ordering;

use glam::DVec3;

use crate::breaks::is_hard;
use crate::ids::Corner;
use crate::math::{area_vector, unit};
use crate::tolerance::{RUNS_ON_COSINE, SAME_DIRECTION};
use crate::view::View;

/// With more faces on one edge, comparing all of them would take quadratic time.
const MOST_FACES: usize = 64;

/// Who belongs to whom on one edge.
#[derive(Default)]
pub struct Crowd {
    /// Half-edges that run forth, each with one that runs back.
    pub pairs: Vec<[Corner; 2]>,
    /// What is left over, each with the visible half-edge that it lies behind.
    pub hidden: Vec<Hidden>,
    /// Whether a chamfer would let light through: from one gap with air to another, or, where solids
    /// touch all around, along the edge.
    pub is_contact: bool,
}

/// A half-edge that is left over where others of its edge are paired in front of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Hidden {
    pub half_edge: Corner,
    /// A half-edge with a twin on the same edge: of the visible ones, the one whose plane is
    /// nearest to its own.
    pub behind: Corner,
}

/// What a face is connected with by other edges.
#[derive(Clone, Copy)]
pub struct Part {
    /// The same for all faces of it.
    pub number: u32,
    /// How many sides of the face itself, and how many triangles, were connected before any crowd was
    /// paired.
    pub sides: u32,
    pub size: u32,
}

/// Pairs half-edges that run forth with some that run back. What is in one part already, as the
/// caller tells, stays together where the faces leave a choice.
pub fn crowd(
    view: &View,
    forth: &[Corner],
    back: &[Corner],
    part: &mut dyn FnMut(Corner) -> Part,
) -> Crowd {
    if forth.is_empty() || back.is_empty() {
        return Crowd::default();
    }
    let around = Around::new(view, forth, back, part);
    let airs = around.airs(view);
    let visible = around.marked(airs.pairs.iter().flatten());
    if airs.are_all {
        // Sheets of two sides: each gap is a room, and its walls meet in it.
        return Crowd { pairs: around.half_edges(&airs.pairs), ..Crowd::default() };
    }
    let apart = around.apart();
    if let Some(Apart { pairs, rest: [forth, back] }) = &apart
        && forth.len() == back.len()
    {
        let rest = crowd(view, forth, back, part);
        let pairs = pairs.iter().copied().chain(rest.pairs).collect();
        return Crowd { pairs, is_contact: airs.gaps != 1, ..rest };
    }
    let left = around.left_over(&visible);
    let mut pairs = around.pairs_of_solids(view, &visible, &left);
    let mut left: Vec<usize> = (0..left.len()).filter(|&place| left[place]).collect();
    around.let_run_on(view, &mut pairs, &mut left);
    let is_left = around.marked(left.iter());
    if let Some(Apart { pairs, .. }) = apart
        && around.has_torn_copies(&pairs, &is_left)
    {
        // One copy would be chamfered along with what it touches, and the other would stay.
        return Crowd { pairs, is_contact: true, ..Crowd::default() };
    }
    let seen = airs.pairs.iter().flatten().copied().filter(|&place| !is_left[place]);
    // Of very many, any one will do.
    let seen: Vec<usize> = seen.take(MOST_FACES).collect();
    let hidden = left.iter().filter_map(|&place| around.hidden(&seen, place)).collect();
    Crowd { pairs: around.half_edges(&pairs), hidden, is_contact: airs.gaps != 1 }
}

/// A face around the edge.
struct Face {
    half_edge: Corner,
    /// Such a face has its air where angles are larger, and its solid where they are smaller.
    runs_forth: bool,
    inward: DVec3,
    part: Part,
    /// Grows with the angle about the edge, from 0 to 4.
    angle: f64,
    /// Which of the directions it lies in.
    ray: usize,
}

impl Face {
    /// Which of the faces in one direction comes first, whatever their numbers: of two that face each
    /// other there, the one that looks forth, as between solids that stand flush; then the one that is
    /// held by more, as a sheet may be laid out of whole faces and scraps of them; then the one that
    /// ends nearer to where it begins.
    fn order(&self, view: &View, other: &Face) -> Ordering {
        let forth = other.runs_forth.cmp(&self.runs_forth);
        let [held, held_other] = [self, other].map(|face| (face.part.sides, face.part.size));
        let [near, near_other] = [self, other].map(|face| face.reach(view));
        let nearer = near[0].total_cmp(&near_other[0]).then(near[1].total_cmp(&near_other[1]));
        forth.then(held_other.cmp(&held)).then(nearer).then(self.half_edge.cmp(&other.half_edge))
    }

    /// How far the corner across is from both ends of the edge, squared.
    fn reach(&self, view: &View) -> [f64; 2] {
        let [across, start, end] = [self.half_edge.prev(), self.half_edge, self.half_edge.next()]
            .map(|corner| view.position_at(corner));
        [start, end].map(|end| across.distance_squared(end))
    }
}

/// The faces around an edge, by direction, and in each as they are ordered there.
struct Around {
    faces: Vec<Face>,
    /// Where the faces of each direction begin, and where the last ones end.
    rays: Vec<usize>,
}

/// Parts that have one face of each kind on the edge, and so are closed there without the others.
struct Apart {
    /// Their faces.
    pairs: Vec<[Corner; 2]>,
    /// All others, forth and back.
    rest: [Vec<Corner>; 2],
}

/// What is seen of the faces.
struct Airs {
    /// Places of faces that see each other across air: one that runs forth, and one that runs back.
    pairs: Vec<[usize; 2]>,
    gaps: usize,
    /// Whether air is in every gap.
    are_all: bool,
}

impl Around {
    fn new(
        view: &View,
        forth: &[Corner],
        back: &[Corner],
        part: &mut dyn FnMut(Corner) -> Part,
    ) -> Around {
        let axis = unit(view.position_at(forth[0].next()) - view.position_at(forth[0]));
        let reference = inward(view, forth[0], axis);
        let mut face = |half_edge: Corner, runs_forth| {
            let inward = inward(view, half_edge, axis);
            // What lies on the first face is not to come last for being a rounding below it.
            let lies_on_first = inward.dot(reference) > SAME_DIRECTION;
            let angle = pseudo_angle(inward, reference, axis.cross(reference));
            let angle = if lies_on_first { 0.0 } else { angle };
            Face { half_edge, runs_forth, inward, part: part(half_edge), angle, ray: 0 }
        };
        let mut faces: Vec<Face> = forth.iter().map(|&half_edge| face(half_edge, true)).collect();
        faces.extend(back.iter().map(|&half_edge| face(half_edge, false)));
        faces.sort_by(|one, other| {
            let rising = one.angle.partial_cmp(&other.angle).unwrap_or(Ordering::Equal);
            rising.then(one.half_edge.cmp(&other.half_edge))
        });
        let mut rays = vec![0];
        for place in 1..faces.len() {
            if faces[place].inward.dot(faces[place - 1].inward) <= SAME_DIRECTION {
                rays.push(place);
            }
            faces[place].ray = rays.len() - 1;
        }
        rays.push(faces.len());
        for ray in rays.windows(2) {
            faces[ray[0]..ray[1]].sort_by(|one, other| one.order(view, other));
        }
        Around { faces, rays }
    }

    /// The places of the faces in a direction that run one way.
    fn at_ray(&self, ray: usize, runs_forth: bool) -> Vec<usize> {
        let places = self.rays[ray]..self.rays[ray + 1];
        places.filter(|&place| self.faces[place].runs_forth == runs_forth).collect()
    }

    /// The gaps between directions that faces look into from both sides.
    fn airs(&self, view: &View) -> Airs {
        let rays = self.rays.len() - 1;
        let mut airs = Airs { pairs: Vec::new(), gaps: 0, are_all: true };
        for ray in 0..rays {
            let sides = [self.at_ray(ray, true), self.at_ray((ray + 1) % rays, false)];
            let seen = self.matched(view, sides);
            airs.gaps += usize::from(!seen.is_empty());
            airs.are_all &= !seen.is_empty();
            airs.pairs.extend(seen);
        }
        airs.are_all &= 2 * airs.pairs.len() == self.faces.len();
        airs
    }

    /// Pairs faces of one place with faces of another: those first that share their vertices and are
    /// in one part, then those of one part, and then those that share their vertices.
    fn matched(&self, view: &View, [mut forth, mut back]: [Vec<usize>; 2]) -> Vec<[usize; 2]> {
        let mut pairs = Vec::new();
        let is_choice = self.is_small() && forth.len().max(back.len()) > 1;
        for (shares, is_part) in [(true, true), (false, true), (true, false)] {
            let joins = |one: usize, other: usize| {
                (!is_part || self.part(one) == self.part(other))
                    && (!shares || self.share_vertices(view, one, other))
            };
            forth.retain(|&one| {
                let found = is_choice.then(|| back.iter().position(|&other| joins(one, other)));
                found.flatten().map(|found| pairs.push([one, back.remove(found)])).is_none()
            });
        }
        pairs.extend(forth.into_iter().zip(back).map(|(one, other)| [one, other]));
        pairs
    }

    /// Whether all faces can be compared with each other.
    fn is_small(&self) -> bool {
        self.faces.len() <= MOST_FACES
    }

    fn part(&self, place: usize) -> u32 {
        self.faces[place].part.number
    }

    fn share_vertices(&self, view: &View, one: usize, other: usize) -> bool {
        let [one, other] = [one, other].map(|place| self.faces[place].half_edge);
        view.vertex_at(one) == view.vertex_at(other.next())
            && view.vertex_at(one.next()) == view.vertex_at(other)
    }

    /// `#faces`: whether each is among some.
    fn marked<'a>(&self, places: impl Iterator<Item = &'a usize>) -> Vec<bool> {
        let mut marked = vec![false; self.faces.len()];
        places.for_each(|&place| marked[place] = true);
        marked
    }

    /// `#faces`: whether each is hidden and finds no other hidden one to face.
    fn left_over(&self, visible: &[bool]) -> Vec<bool> {
        let hidden: Vec<usize> = (0..visible.len()).filter(|&place| !visible[place]).collect();
        let facing = self.nested(&hidden, true);
        let mut left: Vec<bool> = visible.iter().map(|visible| !visible).collect();
        facing.iter().flatten().for_each(|&place| left[place] = false);
        left
    }

    /// None where no part is closed here without the others.
    fn apart(&self) -> Option<Apart> {
        if !self.is_small() {
            return None;
        }
        let mut places: Vec<usize> = (0..self.faces.len()).collect();
        places.sort_by_key(|&place| (self.part(place), !self.faces[place].runs_forth, place));
        let (mut pairs, mut rest) = (Vec::new(), [Vec::new(), Vec::new()]);
        for own in places.chunk_by(|&a, &b| self.part(a) == self.part(b)) {
            match *own {
                [one, other] if self.faces[one].runs_forth != self.faces[other].runs_forth => {
                    pairs.push([one, other].map(|place| self.faces[place].half_edge));
                }
                _ => own.iter().for_each(|&place| {
                    let Face { half_edge, runs_forth, .. } = self.faces[place];
                    rest[usize::from(!runs_forth)].push(half_edge);
                }),
            }
        }
        (!pairs.is_empty()).then_some(Apart { pairs, rest })
    }

    /// Whether of two closed parts that lie on each other one keeps a face that is left over of the
    /// other.
    fn has_torn_copies(&self, closed: &[[Corner; 2]], is_left: &[bool]) -> bool {
        let is_closed =
            |place: &usize| closed.as_flattened().contains(&self.faces[*place].half_edge);
        let kind = |place: usize| (self.faces[place].ray, self.faces[place].runs_forth);
        let own: Vec<usize> = (0..self.faces.len()).filter(is_closed).collect();
        let is_torn = |one: &usize, other: &usize| {
            is_left[*one] && !is_left[*other] && kind(*one) == kind(*other)
        };
        own.iter().any(|one| own.iter().any(|other| is_torn(one, other)))
    }

    /// Pairs around the solids: going round, faces that run back open one, and those that run forth
    /// close one.
    fn pairs_of_solids(&self, view: &View, visible: &[bool], left: &[bool]) -> Vec<[usize; 2]> {
        let mut order: Vec<usize> = (0..left.len()).filter(|&place| !left[place]).collect();
        // In one direction, those first that bound the air before it, and those last that bound
        // the air behind it. Between them solids lie flush: one closes, and the next one opens.
        order.sort_by_key(|&place| {
            let rank = match (visible[place], self.faces[place].runs_forth) {
                (true, false) => 0,
                (false, true) => 1,
                (false, false) => 2,
                (true, true) => 3,
            };
            (self.faces[place].ray, rank)
        });
        let mut pairs = self.nested(&order, false);
        let rays = |pair: &[usize; 2]| pair.map(|place| self.faces[place].ray);
        pairs.sort_by_key(|pair| (rays(pair), *pair));
        // Of solids that lie on each other, each keeps its own faces.
        let same = pairs.chunk_by(|one, other| rays(one) == rays(other));
        same.flat_map(|pairs| {
            let side = |k: usize| {
                let mut side: Vec<usize> = pairs.iter().map(|pair| pair[k]).collect();
                side.sort_unstable();
                side
            };
            self.matched(view, [side(0), side(1)])
        })
        .collect()
    }

    /// Matches faces like parentheses on a circle: each that runs forth with one that runs back,
    /// where those that run forth are the opening ones, or the closing ones.
    fn nested(&self, order: &[usize], forth_opens: bool) -> Vec<[usize; 2]> {
        let mut is_done = vec![false; self.faces.len()];
        let mut open: Vec<usize> = Vec::new();
        let mut pairs = Vec::new();
        for (turn, &place) in order.iter().chain(order).enumerate() {
            if is_done[place] {
                continue;
            }
            if self.faces[place].runs_forth == forth_opens {
                // The second time around they are all open.
                if turn < order.len() {
                    open.push(place);
                }
            } else if let Some(opening) = open.pop() {
                (is_done[opening], is_done[place]) = (true, true);
                pairs.push(if forth_opens { [opening, place] } else { [place, opening] });
            }
        }
        pairs
    }

    /// A smooth surface that runs straight on behind a wall stays whole, and the wall is left over:
    /// nobody can tell whether the wall stands in front of a solid or of another room.
    fn let_run_on(&self, view: &View, pairs: &mut [[usize; 2]], left: &mut [usize]) {
        for place in left.iter_mut().filter(|_| self.is_small()) {
            let side = usize::from(self.faces[*place].runs_forth);
            let continued = pairs.iter_mut().find(|pair| self.runs_on(view, *place, pair[side]));
            if let Some(pair) = continued {
                std::mem::swap(&mut pair[1 - side], place);
            }
        }
    }

    fn runs_on(&self, view: &View, one: usize, other: usize) -> bool {
        let [one, other] = [one, other].map(|place| &self.faces[place]);
        one.inward.dot(other.inward) < RUNS_ON_COSINE
            && !is_hard(view, one.half_edge, other.half_edge)
    }

    fn half_edges(&self, pairs: &[[usize; 2]]) -> Vec<[Corner; 2]> {
        pairs.iter().map(|pair| pair.map(|place| self.faces[place].half_edge)).collect()
    }

    /// What a face that is left over lies behind: the visible face whose plane is nearest. None if
    /// it lies on a visible one, as a copy does: that is seen as well.
    fn hidden(&self, seen: &[usize], place: usize) -> Option<Hidden> {
        let face = &self.faces[place];
        let lean = |other: usize| self.faces[other].inward.cross(face.inward).length_squared();
        let nearest = seen.iter().min_by(|&&a, &&b| lean(a).total_cmp(&lean(b)))?;
        let nearest = &self.faces[*nearest];
        let is_copy = nearest.inward.dot(face.inward) > SAME_DIRECTION;
        (!is_copy).then_some(Hidden { half_edge: face.half_edge, behind: nearest.half_edge })
    }
}

/// From the edge into the face, perpendicular to the edge.
fn inward(view: &View, half_edge: Corner, axis: DVec3) -> DVec3 {
    let points = view.triangle(half_edge.triangle());
    let along = view.position_at(half_edge.next()) - view.position_at(half_edge);
    let direction = unit(area_vector(points).cross(along));
    if direction == DVec3::ZERO { axis.any_orthonormal_vector() } else { direction }
}

/// 0 to 4 as the angle from `x` towards `y` goes from 0 to 360 degrees.
fn pseudo_angle(direction: DVec3, x: DVec3, y: DVec3) -> f64 {
    let (along, across) = (direction.dot(x), direction.dot(y));
    let ratio = along / (along.abs() + across.abs());
    if across >= 0.0 { 1.0 - ratio } else { 3.0 + ratio }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ids::Id;
    use crate::mesh::{Mesh, MeshBuffers};
    use crate::options::Options;
    use crate::view::view;

    /// A face that leaves the edge at an angle in degrees, counter-clockwise as the drawings show
    /// it, and looks that way round too (`Left`), or the other way (`Right`).
    #[derive(Clone, Copy, PartialEq)]
    enum Look {
        Left(f64),
        Right(f64),
    }
    use Look::{Left, Right};

    /// Triangles over one edge along z, each with vertices of its own. The half-edge on the edge is
    /// the first of its triangle.
    fn fan(faces: &[Look]) -> MeshBuffers {
        let mut mesh = MeshBuffers::default();
        for &face in faces {
            let (Left(degrees) | Right(degrees)) = face;
            let (y, x) = degrees.to_radians().sin_cos();
            let [bottom, top] = [[0.0; 3], [0.0, 0.0, 1.0]];
            let far = [x as f32, y as f32, 0.5];
            let (ends, sign) = match face {
                Left(_) => ([bottom, top], 1.0),
                Right(_) => ([top, bottom], -1.0),
            };
            let first = mesh.positions.len() as u32;
            mesh.positions.extend([ends[0], ends[1], far]);
            mesh.normals.extend([[-far[1] * sign, far[0] * sign, 0.0]; 3]);
            mesh.indices.extend([first, first + 1, first + 2]);
        }
        mesh.submesh_index_counts = vec![mesh.indices.len() as u32];
        mesh
    }

    fn crowd_of(mesh: &Mesh, faces: &[Look]) -> Crowd {
        let view = view(mesh, &Options::default()).unwrap();
        let half_edges = (0..faces.len()).map(|face| Corner::new(3 * face));
        let looks_left = |corner: &Corner| matches!(faces[corner.index() / 3], Left(_));
        let (forth, back): (Vec<_>, Vec<_>) = half_edges.partition(looks_left);
        crowd(&view, &forth, &back, &mut |corner| Part { number: corner.0, sides: 0, size: 1 })
    }

    /// The pairs, each and all sorted, and what is left over behind what, as places of faces.
    fn sorted(found: &Crowd) -> (Vec<[usize; 2]>, Vec<[usize; 2]>) {
        let face = |corner: Corner| corner.index() / 3;
        let mut pairs: Vec<[usize; 2]> = found.pairs.iter().map(|pair| pair.map(face)).collect();
        pairs.iter_mut().for_each(|pair| pair.sort_unstable());
        pairs.sort_unstable();
        let hidden = |hidden: &Hidden| [face(hidden.half_edge), face(hidden.behind)];
        (pairs, found.hidden.iter().map(hidden).collect())
    }

    /// What is found, whatever the order in which the faces come; and whether solids touch.
    fn found(faces: &[Look]) -> (Vec<[usize; 2]>, Vec<[usize; 2]>, bool) {
        let first = crowd_of(&fan(faces).as_mesh(), faces);
        let (pairs, hidden) = sorted(&first);
        let count = faces.len();
        for turn in 1..count {
            let turned: Vec<Look> = (0..count).map(|k| faces[(k + turn) % count]).collect();
            let again = crowd_of(&fan(&turned).as_mesh(), &turned);
            let back =
                |list: Vec<[usize; 2]>| list.into_iter().map(|p| p.map(|k| (k + turn) % count));
            let (again_pairs, again_hidden) = sorted(&again);
            let mut renamed: Vec<[usize; 2]> = back(again_pairs).collect();
            renamed.iter_mut().for_each(|pair| pair.sort_unstable());
            renamed.sort_unstable();
            assert_eq!(renamed, pairs, "beginning with face {turn}");
            assert_eq!(
                back(again_hidden).collect::<Vec<_>>(),
                hidden,
                "beginning with face {turn}"
            );
            assert_eq!(again.is_contact, first.is_contact);
        }
        (pairs, hidden, first.is_contact)
    }

    /// The pairs, each and all sorted, of faces of which some are held by more than others, and some
    /// reach farther than others.
    fn pairs_of(faces: &[(Look, u32, f32)]) -> Vec<[usize; 2]> {
        let looks: Vec<Look> = faces.iter().map(|&(look, ..)| look).collect();
        let mut mesh = fan(&looks);
        for (face, &(.., reach)) in faces.iter().enumerate() {
            mesh.positions[3 * face + 2][..2].iter_mut().for_each(|along| *along *= reach);
        }
        let mesh = mesh.as_mesh();
        let view = view(&mesh, &Options::default()).unwrap();
        let (forth, back): (Vec<_>, Vec<_>) = (0..faces.len())
            .map(|face| Corner::new(3 * face))
            .partition(|corner| matches!(looks[corner.index() / 3], Left(_)));
        let held = |corner: Corner| faces[corner.index() / 3].1;
        let mut part = |corner: Corner| Part { number: corner.0, sides: held(corner), size: 1 };
        sorted(&crowd(&view, &forth, &back, &mut part)).0
    }

    //   0 1
    //   # #| |         Two faces lie on each other in both places: a whole one of each, and a scrap.
    //   # #|2|3
    #[test]
    fn of_faces_that_lie_on_each_other_those_that_are_held_go_on_together() {
        let (whole, scrap) = (1, 0);
        let walls = [
            (Right(180.0), whole, 1.0),
            (Right(180.0), scrap, 1.0),
            (Left(270.0), whole, 1.0),
            (Left(270.0), scrap, 1.0),
        ];
        assert_eq!(pairs_of(&walls), [[0, 2], [1, 3]]);
        let swapped = [walls[1], walls[0], walls[2], walls[3]];
        assert_eq!(pairs_of(&swapped), [[0, 3], [1, 2]]);
        assert_eq!(pairs_of(&[walls[0], walls[1], walls[2]]), [[0, 2]]);
        assert_eq!(pairs_of(&[walls[1], walls[0], walls[2]]), [[1, 2]]);
    }

    #[test]
    fn of_faces_held_alike_the_nearer_one_goes_on_whichever_is_told_first() {
        let [near, far, wall] =
            [(Right(180.0), 0, 1.0), (Right(180.0), 0, 2.0), (Left(270.0), 0, 1.0)];
        assert_eq!(pairs_of(&[near, far, wall]), [[0, 2]]);
        assert_eq!(pairs_of(&[far, near, wall]), [[1, 2]]);
    }

    //  # # # # # #
    //  --1--+--0--     The ceiling 0 meets the wall 2. Its lid, 1, is inside, where nobody sees it.
    //  # # #|
    //  # # #|2
    #[test]
    fn of_three_walls_the_one_behind_the_others_is_left_over() {
        let walls = [Right(0.0), Right(180.0), Left(270.0)];
        assert_eq!(found(&walls), (vec![[0, 2]], vec![[1, 0]], false));
    }

    //  |1
    //  |# # 2
    //  |# / #          The same with a wall inside an outer edge.
    //  |/ # #
    //  +----0--
    #[test]
    fn a_wall_inside_an_outer_edge_is_left_over() {
        let walls = [Right(0.0), Left(90.0), Right(50.0)];
        assert_eq!(found(&walls), (vec![[0, 1]], vec![[2, 1]], false));
    }

    //  --2--+--0--
    //  # # # \ # #     A house cut at its mirror plane: the wall at the cut, 1, is still there.
    //  # # # #\1 #
    #[test]
    fn a_wall_at_a_cut_is_left_over_below_a_roof_that_runs_on() {
        let roof = [Left(0.0), Left(300.0), Right(180.0)];
        assert_eq!(found(&roof).0, [[0, 2]]);
        assert_eq!(found(&roof).1.len(), 1);
    }

    //       |1
    //       |          A wall with one side on a smooth floor. Behind it there may be another room,
    //  --2--+--0--     in which the floor is seen.
    //  # # # # # #
    #[test]
    fn a_smooth_floor_runs_on_below_a_wall() {
        let room = [Left(0.0), Left(90.0), Right(180.0)];
        let (pairs, hidden, _) = found(&room);
        assert_eq!((pairs, hidden[0][0]), (vec![[0, 2]], 1));
        // A floor that bends there is two floors, and 2 meets the wall.
        let bent = [Left(20.0), Left(90.0), Right(180.0)];
        assert_eq!(found(&bent), (vec![[1, 2]], vec![[0, 2]], false));
    }

    //  2_ # #1   3# #
    //  # `-_# \ / # #    Two solids with air between them and below; 2 is inside one of them.
    //  ----0---+---4--
    #[test]
    fn five_walls() {
        let walls = [Left(180.0), Right(110.0), Right(150.0), Left(70.0), Right(0.0)];
        let (pairs, hidden, is_contact) = found(&walls);
        assert_eq!(pairs, [[0, 1], [3, 4]]);
        assert_eq!((hidden.len(), hidden[0][0], is_contact), (1, 2, true));
    }

    //  # #1  3 # 2 #
    //  # # \ | / # #    One solid, seen from below, with three walls inside: two of them face each
    //  ----4-+-0----   other and keep to themselves.
    #[test]
    fn of_five_walls_two_are_seen() {
        let walls = [Right(0.0), Left(130.0), Right(50.0), Right(80.0), Left(180.0)];
        let (pairs, hidden, is_contact) = found(&walls);
        assert_eq!((pairs.len(), pairs[0]), (2, [0, 4]));
        assert!(pairs[1].contains(&1) && !is_contact);
        assert_eq!(hidden.len(), 1);
    }

    //      2||1
    //       ||         A wall with two sides between two rooms. It has nothing to cut off, and no
    //  --3--++--0--    chamfer of the floor may leave it.
    //  # # # # # #
    #[test]
    fn a_wall_with_two_sides_stands_on_its_floor() {
        let rooms = [Left(0.0), Right(90.0), Left(90.0), Right(180.0)];
        assert_eq!(found(&rooms), (vec![[0, 3], [1, 2]], vec![], true));
    }

    //   3||2
    //    |+--1--       Two sheets of two sides: the outer skin, and the inner one.
    //    +---0--
    #[test]
    fn sheets_are_paired_skin_by_skin() {
        let sheets = [Right(0.0), Left(0.0), Right(90.0), Left(90.0)];
        assert_eq!(found(&sheets), (vec![[0, 3], [1, 2]], vec![], false));
    }

    //      3||2
    //  --4--+ +--1--   Three of them: each room has its own walls.
    //  --5-------0--
    #[test]
    fn three_sheets_are_paired_room_by_room() {
        let sheets = [Right(0.0), Left(0.0), Right(90.0), Left(90.0), Right(180.0), Left(180.0)];
        assert_eq!(found(&sheets), (vec![[0, 5], [1, 2], [3, 4]], vec![], false));
    }

    //   1||2
    //  # ||# #         Two boxes side by side, flush at the bottom: they stay two, and no fin
    //  # || # #        stands between them.
    //  -0-+---3--
    #[test]
    fn flush_boxes_stay_two() {
        let boxes = [Left(180.0), Right(90.0), Left(90.0), Right(0.0)];
        assert_eq!(found(&boxes), (vec![[0, 1], [2, 3]], vec![], false));
        // And so they do where one reaches further down.
        let step = [Left(225.0), Right(90.0), Left(90.0), Right(0.0)];
        assert_eq!(found(&step), (vec![[0, 1], [2, 3]], vec![], false));
    }

    //  # # |1
    //  # # |           Two boxes that touch along one edge: between them one looks through.
    //  --0-+-3---
    //      | # #
    //     2| # #
    #[test]
    fn boxes_that_touch_along_an_edge_are_a_contact() {
        let boxes = [Left(180.0), Right(90.0), Left(0.0), Right(270.0)];
        assert_eq!(found(&boxes), (vec![[0, 1], [2, 3]], vec![], true));
        // Knife against knife, as in a ring of flat bars.
        let knives = [Right(0.0), Left(140.0), Right(195.0), Left(311.0)];
        assert_eq!(found(&knives), (vec![[0, 1], [2, 3]], vec![], true));
    }

    //  1|# # #
    //  2|# # #         A solid, and an exact copy of it: 0 and 3 lie on each other as well.
    //   +==0,3
    #[test]
    fn of_copies_each_keeps_its_own_faces() {
        let copies = [Right(0.0), Left(90.0), Left(90.0), Right(0.0)];
        let mut mesh = fan(&copies);
        // The half-edges of 0 and 2 share their vertices, and so do those of 1 and 3.
        for (one, other) in [(6, 1), (7, 0), (3, 10), (4, 9)] {
            mesh.indices[one] = other;
        }
        let found = sorted(&crowd_of(&mesh.as_mesh(), &copies));
        assert_eq!(found, (vec![[0, 2], [1, 3]], vec![]));
        // A copy of one face lies behind nothing.
        let three = crowd_of(&fan(&copies[..3]).as_mesh(), &copies[..3]);
        assert_eq!((three.pairs.len(), three.hidden.len()), (1, 0));
    }

    #[test]
    fn what_lies_on_the_first_face_but_for_rounding_does_not_come_last() {
        let boxes = [Left(180.0), Right(90.0), Left(90.0), Right(0.0)];
        for off in [-1e-3, 1e-3] {
            let rounded = boxes.map(|face| match face {
                Left(90.0) => Left(90.0 + off),
                other => other,
            });
            assert_eq!(found(&rounded), (vec![[0, 1], [2, 3]], vec![], false));
        }
    }

    #[test]
    fn many_faces_on_one_edge_are_paired_too() {
        let solids = (0..5_000).flat_map(|k| {
            let start = 0.07 * f64::from(k);
            [Right(start), Left(start + 0.03)]
        });
        let faces: Vec<Look> = solids.collect();
        let (pairs, hidden) = sorted(&crowd_of(&fan(&faces).as_mesh(), &faces));
        assert!(pairs.iter().enumerate().all(|(k, pair)| *pair == [2 * k, 2 * k + 1]));
        assert_eq!((pairs.len(), hidden.len()), (5_000, 0));
    }
}
