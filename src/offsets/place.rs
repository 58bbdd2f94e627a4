//! Place: a course, measured in an unfolded fan, as a vector in space and a foot on a face.

use glam::DVec3;

use super::{Blade, Course, Offset, arms};
use crate::breaks::seam_between;
use crate::faces::Faces;
use crate::foot::{Foot, locate};
use crate::ids::Corner;
use crate::math::{area_vector, unit};
use crate::mesh::UV_CHANNELS;
use crate::tolerance::{LEVEL_COSINE, LEVEL_HEIGHT};
use crate::view::View;

/// Past this many times a triangle's sides, rounding of its streams shows in what it tells of a
/// place: then a larger triangle in its plane is asked.
const FARTHEST: f64 = 16.0;

/// The offset in space; none where the corner has no plane. Vector and foot lie in one plane, so
/// that the foot blends to the very place.
pub fn place(view: &View, faces: &Faces, spread: &[Blade], course: &Course) -> Option<Offset> {
    let within = course.corner;
    let on = |plane: Corner| {
        let vector = way(view, faces, course, plane);
        let foot = locate(view, carrier(faces, plane), view.position_at(within), vector)?;
        Some((vector, foot))
    };
    let own = on(within)?;
    if is_flat(view, faces, spread, course) && own.1.reach() <= FARTHEST {
        return sound(faces, course, own);
    }
    let steadiest = steadiest(view, faces, spread, within);
    let steady = if steadiest == within { own } else { on(steadiest)? };
    let is_level = own.0.distance(steady.0) <= view.resolution * LEVEL_HEIGHT;
    let is_near = own.1.reach() <= steady.1.reach().max(FARTHEST);
    sound(faces, course, if is_level && is_near { own } else { steady })
}

fn sound(faces: &Faces, course: &Course, (vector, foot): (DVec3, Foot)) -> Option<Offset> {
    let within = course.corner;
    let is_sound = faces.normal[within.triangle()] != DVec3::ZERO && vector.is_finite();
    let Course { is_capped, .. } = *course;
    is_sound.then(|| Offset { vector, foot, is_capped, ..Offset::none(within) })
}

/// Whether all planes in a fan that could be the corner's own lead to the same place.
fn is_flat(view: &View, faces: &Faces, spread: &[Blade], course: &Course) -> bool {
    let own = faces.normal[course.corner.triangle()];
    // A way in a plane turns with its normal, and is then put down onto it.
    let most = view.resolution * LEVEL_HEIGHT / (4.0 * course.distance);
    spread.iter().all(|blade| {
        let normal = faces.normal[blade.corner.triangle()];
        normal.distance_squared(own) <= most * most || normal.dot(own) <= LEVEL_COSINE
    })
}

/// A corner of the triangle whose plane a corner lies in.
fn carrier(faces: &Faces, corner: Corner) -> Corner {
    let lender = faces.lender[corner.triangle()];
    if lender.is_some() { lender } else { corner }
}

/// The way of a course in the plane of a triangle at the fan's centre.
fn way(view: &View, faces: &Faces, course: &Course, plane: Corner) -> DVec3 {
    let normal = faces.normal[plane.triangle()];
    let [ahead, _] = arms(view, course.corner);
    let ahead = unit(ahead);
    let aside = normal.cross(ahead);
    let way = (ahead * course.angle.cos() + aside * course.angle.sin()) * course.distance;
    way - normal * way.dot(normal)
}

/// The corner whose triangle tells best in which plane a corner of a fan lies: of all triangles of
/// its chart whose planes hold the corner's own, the largest.
fn steadiest(view: &View, faces: &Faces, spread: &[Blade], corner: Corner) -> Corner {
    if spread.len() == 1 {
        return corner;
    }
    let area = |corner: &Corner| area_vector(view.triangle(corner.triangle())).length_squared();
    let (arms, own) = (arms(view, corner), faces.normal[corner.triangle()]);
    let holds_own = |other: &Corner| {
        let normal = faces.normal[other.triangle()];
        let is_near = |arm: &DVec3| arm.dot(normal).abs() <= view.resolution * LEVEL_HEIGHT;
        let leans_alike = normal.dot(own) > LEVEL_COSINE;
        leans_alike && arms.iter().all(is_near) && !faces.is_line(other.triangle())
    };
    let level = chart_of(view, spread, corner).filter(holds_own);
    let largest = level.max_by(|one, other| area(one).total_cmp(&area(other)));
    largest.filter(|largest| area(largest) > area(&corner)).unwrap_or(corner)
}

/// The corners of a fan from one seam to the next around a corner.
fn chart_of(view: &View, spread: &[Blade], corner: Corner) -> impl Iterator<Item = Corner> {
    let is_seam = |one: &Blade, other: &Blade| {
        let ends = [(one.corner, other.corner), (one.corner.prev(), other.corner.next())];
        (0..UV_CHANNELS).any(|channel| {
            ends.into_iter().any(|(one, other)| seam_between(view, channel, one, other))
        })
    };
    let charts = spread.chunk_by(move |one, other| !is_seam(one, other));
    let holds = move |chart: &&[Blade]| chart.iter().any(|blade| blade.corner == corner);
    charts.filter(holds).flatten().map(|blade| blade.corner)
}
