//! Valid: whether source triangles, strips and fills are as good as they have to be.

use glam::DVec3;

use crate::contacts::Wedge;
use crate::error::Error;
use crate::fills;
use crate::flaps;
use crate::ids::{Edge, Id, Ring, Triangle};
use crate::math::{area_vector, unit};
use crate::placement::Placement;
use crate::strips;
use crate::validity::{keeps_side, opens_along, stays_line, survives};
use crate::view::{Stored, wide};
use crate::watch::Watch;

use super::elements::{Element, flap_joints};
use crate::given::Given;
use crate::room::breadth;

/// Of the cosine of 45 degrees.
const LEAST_SURE_SQUARE: f64 = 0.5;

/// Everything that is bad where the sectors stand now.
///
/// # Errors
/// [`Error::Cancelled`] where the watch stops it.
pub fn bad_elements(
    given: &Given,
    placement: &Placement,
    watch: &dyn Watch,
) -> Result<Vec<Element>, Error> {
    let threads = given.threads;
    let is_bad = |element| !is_valid(given, placement, element);
    let triangles = given.surface.faces.normal.len();
    let triangles = threads.filter_watched(triangles, watch, |triangle| {
        !is_surely_valid(given, placement, triangle)
            && is_touched(given, triangle)
            && is_bad(Element::Surface(triangle))
    })?;
    let edges = threads.filter_watched(given.chamfers.edges.hard.len(), watch, |edge| {
        given.chamfers.edges.hard[edge].skipped.is_none() && !strip_is_valid(given, placement, edge)
    })?;
    let rings = given.chamfers.sectors.rings.len();
    let rings =
        threads.filter_watched(rings, watch, |ring| !fill_is_valid(given, placement, ring))?;
    let surface = triangles.into_iter().map(Element::Surface);
    let strips = edges.into_iter().map(Element::Strip);
    let flaps =
        (0..given.chamfers.edges.parted.len() as u32).map(Element::Flap).filter(|&e| is_bad(e));
    Ok(surface.chain(strips).chain(rings.into_iter().map(Element::Fill)).chain(flaps).collect())
}

fn is_touched(given: &Given, triangle: Triangle) -> bool {
    triangle.corners().iter().any(|&corner| given.chamfers.sectors.sector_of[corner].is_some())
}

/// Whether an element is as good as it has to be where the sectors stand now.
pub fn is_valid(given: &Given, placement: &Placement, element: Element) -> bool {
    match element {
        Element::Surface(triangle) => surface_is_valid(given, placement, triangle),
        Element::Strip(edge) => strip_is_valid(given, placement, edge),
        Element::Fill(ring) => fill_is_valid(given, placement, ring),
        Element::Flap(place) => {
            let joints = flap_joints(given, place);
            let points = joints.map(|joint| placement.position_at(joint));
            flaps::is_valid(given.surface, joints, points)
        }
    }
}

/// Whether a triangle has plenty of room, and is shaded flat before and after: then it cannot be bad. Its
/// normals are within 45 degrees of its old plane's, and its new plane within thirty.
fn is_surely_valid(given: &Given, placement: &Placement, triangle: Triangle) -> bool {
    // What is set apart stands a few steps from where it would.
    if given.apart.is_some() || !given.plenty[triangle] {
        return false;
    }
    let [a, b, c] = triangle.corners();
    let normal = given.surface.view.normal_at(a);
    let upright = normal.dot(given.surface.faces.normal[triangle]);
    upright > 0.0
        && upright * upright >= LEAST_SURE_SQUARE * normal.length_squared()
        && placement.normal_at(a) == normal
        && placement.normal_at(b) == normal
        && placement.normal_at(c) == normal
}

fn surface_is_valid(given: &Given, placement: &Placement, triangle: Triangle) -> bool {
    let old = given.surface.view.triangle(triangle);
    let new = triangle.corners().map(|corner| placement.position_at(corner));
    let faces = given.surface.faces;
    if old == new {
        true
    } else if faces.normal[triangle] == DVec3::ZERO || faces.is_line(triangle) {
        let resolution = given.surface.view.resolution;
        stays_line(old, new, faces.normal[triangle], resolution)
            && opens_along(
                old,
                new,
                [facing_before(given, triangle), facing_after(placement, triangle)].map(unit),
                resolution,
            )
            && keeps_side_as_stored(given, placement, triangle)
    } else {
        survives(old, new)
            && breadth::is_kept(given, triangle, [old, new])
            && still_faces_out(given, placement, triangle, [old, new])
    }
}

/// Whether a line that is measured elsewhere than it is stored keeps its side where it is stored, too: on
/// the way back rounding could turn it over.
fn keeps_side_as_stored(given: &Given, placement: &Placement, line: Triangle) -> bool {
    let view = given.surface.view;
    let Some(Stored { positions, normal_to, .. }) = view.stored else { return true };
    let old = line.corners().map(|corner| wide(positions[view.vertex_at(corner).index()]));
    let new = line.corners().map(|corner| wide(placement.stored_at(corner)));
    keeps_side([old, new], |area| normal_to * area)
}

/// Whether a triangle that faced the way its vertex normals point still does.
fn still_faces_out(
    given: &Given,
    placement: &Placement,
    triangle: Triangle,
    [old, new]: [[DVec3; 3]; 2],
) -> bool {
    area_vector(new).dot(facing_after(placement, triangle)) > 0.0
        || area_vector(old).dot(facing_before(given, triangle)) <= 0.0
}

/// The sum of a triangle's vertex normals in the source.
fn facing_before(given: &Given, triangle: Triangle) -> DVec3 {
    let [a, b, c] = triangle.corners().map(|corner| given.surface.view.normal_at(corner));
    a + b + c
}

/// The same where the sectors stand now.
fn facing_after(placement: &Placement, triangle: Triangle) -> DVec3 {
    let [a, b, c] = triangle.corners().map(|corner| placement.normal_at(corner));
    a + b + c
}

fn strip_is_valid(given: &Given, placement: &Placement, edge: Edge) -> bool {
    let (view, hard) = (given.surface.view, &given.chamfers.edges.hard[edge]);
    let quad = strips::quad(placement, hard);
    let [from, to] = [hard.sides[0], hard.sides[0].next()].map(|c| view.position_at(c));
    strips::is_valid(&quad, strips::cut(quad.points), to - from, view.resolution)
        && contacts_are_kept(given, placement, edge)
}

/// Whether a strip leaves everything covered that rests beside its edge.
#[inline]
pub fn contacts_are_kept(given: &Given, placement: &Placement, edge: Edge) -> bool {
    // Beside most edges nothing rests.
    given.rests.of(edge).is_empty() || rests_are_kept(given, placement, edge)
}

#[inline(never)]
fn rests_are_kept(given: &Given, placement: &Placement, edge: Edge) -> bool {
    let [b1, a1, a2, b2] = strips::corners(&given.chamfers.edges.hard[edge])
        .map(|corner| placement.position_at(corner));
    let wedge =
        Wedge::new(given.surface.view, given.surface.faces, given.chamfers.edges.hard[edge].sides);
    wedge.is_none_or(|wedge| given.rests.are_kept(edge, &wedge, [[a1, b1], [a2, b2]]))
}

fn fill_is_valid(given: &Given, placement: &Placement, ring: Ring) -> bool {
    match *given.chamfers.sectors.ring(ring) {
        [a, b, c] => {
            let sectors = [a, b, c];
            let points = sectors.map(|sector| placement.point[sector]);
            let normals = sectors.map(|sector| placement.normals[sector][0]);
            fills::can_fill(points, normals, given.surface.view.resolution)
        }
        ref sectors => {
            fills::ring_fill(placement, sectors, given.surface.view.resolution).is_some()
        }
    }
}

#[cfg(test)]
mod tests {
    use glam::DMat3;

    use super::*;
    use crate::given::tests::given_of;
    use crate::ids::IdVec;
    use crate::shapes;
    use crate::stages::stages_of;
    use crate::watch::Unwatched;

    #[test]
    fn a_triangle_may_not_turn_from_its_vertex_normals() {
        let mut cube = shapes::plain_cube(1.0);
        let stages = stages_of(&cube, 0.1);
        let placement = stages.placed(0.0);
        let old = stages.view.triangle(Triangle(0));
        let turned = [old[0], old[2], old[1]];
        assert!(still_faces_out(&given_of(&stages), &placement, Triangle(0), [old, old]));
        assert!(!still_faces_out(&given_of(&stages), &placement, Triangle(0), [old, turned]));
        cube.normals.iter_mut().for_each(|normal| *normal = normal.map(|part| -part));
        let stages = stages_of(&cube, 0.1);
        let placement = stages.placed(0.0);
        assert!(
            still_faces_out(&given_of(&stages), &placement, Triangle(0), [old, turned]),
            "it never did"
        );
    }

    /// What is pulled by a tenth where it is measured goes past the other side where it is stored, along one
    /// axis.
    #[test]
    fn a_line_may_not_turn_over_where_it_is_stored() {
        let cube = shapes::plain_cube(1.0);
        let keeps_side = |along_x: f64| {
            let mut stages = stages_of(&cube, 0.1);
            stages.view.stored = Some(Stored {
                positions: &cube.positions,
                normals: &cube.normals,
                to: DMat3::from_diagonal(DVec3::new(1.0 / along_x, 1.0, 1.0)),
                back: DMat3::from_diagonal(DVec3::new(along_x, 1.0, 1.0)),
                normal_to: DMat3::IDENTITY,
            });
            let placement = stages.placed(1.0);
            let given = given_of(&stages);
            let mut triangles = (0..12).map(Triangle);
            triangles.all(|triangle| keeps_side_as_stored(&given, &placement, triangle))
        };
        assert!(keeps_side(1.0));
        assert!(!keeps_side(8.0));
    }

    /// At whatever shares, and of whatever is wide or narrow: where nothing is looked at, nothing would be
    /// found.
    #[test]
    fn what_is_surely_valid_is_valid() {
        let mut sure = 0;
        for (_, mesh) in shapes::demo_models() {
            for width in [0.002, 0.01, 0.05, 0.2] {
                let stages = stages_of(&mesh, width);
                let given = Given { offsets: &stages.narrowed, ..given_of(&stages) };
                for seed in 0..4 {
                    let share = |sector: u32| f64::from((sector * 37 + seed * 11) % 17) / 16.0;
                    let shares = (0..stages.sectors.fans.len() as u32).map(share).collect();
                    let placement = given.placement(IdVec::from_vec(shares), &Unwatched).unwrap();
                    let all = stages.view.triangles();
                    for triangle in all.filter(|&t| is_surely_valid(&given, &placement, t)) {
                        assert!(is_valid(&given, &placement, Element::Surface(triangle)));
                        sure += 1;
                    }
                }
            }
        }
        assert!(sure > 1000, "{sure}");
    }

    // .-------.      a cube's edges pulled past their old lines, and one corner of it pulled by unlike
    // | :...: |      shares: what is new between the faces faces inwards
    // '-------'
    #[test]
    fn strips_and_fills_that_face_inwards_are_bad() {
        let cube = shapes::plain_cube(1.0);
        let stages = stages_of(&cube, 0.1);
        let given = given_of(&stages);
        let strip = |share: f64| is_valid(&given, &stages.placed(share), Element::Strip(Edge(0)));
        assert_eq!([0.0, 1.0, -1.0].map(strip), [true, true, false]);
        let fill = |shares: [f64; 3]| {
            let mut placement = stages.placed(1.0);
            let ring = stages.sectors.ring(Ring(0)).iter();
            ring.zip(shares).for_each(|(&sector, share)| placement.set(sector, share));
            is_valid(&given, &placement, Element::Fill(Ring(0)))
        };
        assert_eq!([[1.0; 3], [0.5, 0.5, 0.0], [0.5, 0.5, -1.0]].map(fill), [true, true, false]);
    }
}
