//! Place: a course, measured in an unfolded fan, as a vector in space and a foot on a face.

use glam::DVec3;

use super::{Blade, Course};
use crate::breaks::{is_hard, same_chart, seam_between, uv_at};
use crate::faces::Faces;
use crate::foot::{Foot, arms, in_edges, locate, locate_by};
use crate::ids::{Corner, Few, Id};
use crate::math::{area_vector, unit};
use crate::mesh::{UV_CHANNELS, Uv};
use crate::report::Blend;
use crate::surface::Surface;
use crate::tolerance::{LEVEL_COSINE, LEVEL_HEIGHT};
use crate::view::View;

/// Past this many times a triangle's sides, rounding of its streams shows in what it tells of a
/// place: then a larger triangle in its plane is asked.
pub const FARTHEST: f64 = 16.0;

/// Values are one map over two triangles where that of the one is off that of the other by this share of
/// their size: less than a texel shows.
const ONE_MAP: f64 = 1e-4;

/// So many triangles beyond a fan are looked at for a larger one.
const MOST_BEYOND: usize = 16;

/// A vector, and where it ends.
type Way = (DVec3, Foot);

/// The way in space; none where the corner has no plane. Vector and foot lie in one plane, so that the
/// foot blends to the very place.
#[inline(always)]
pub fn place(
    surface: Surface,
    (spread, is_even): (&[Blade], bool),
    course: &Course,
) -> Option<Way> {
    let Blade { corner, arms, .. } = *course.blade;
    if is_even {
        // Of what is not finite the foot is not, either.
        let vector = way(surface.faces, course, corner);
        let along = in_edges(arms, vector);
        if along.iter().all(|part| part.abs() <= FARTHEST) {
            return Some((vector, Foot { along, ..Foot::at(corner) }));
        }
    }
    place_by_planes(surface, (spread, is_even), course)
}

/// The same where other planes may tell more.
#[inline(never)]
fn place_by_planes(
    surface: Surface,
    (spread, is_even): (&[Blade], bool),
    course: &Course,
) -> Option<Way> {
    let Surface { view, faces, .. } = surface;
    let own = on(surface, course, course.blade.corner)?;
    if (is_even || is_flat(view, faces, spread, course)) && own.1.reach() <= FARTHEST {
        return Some(own).filter(|own| is_sound(faces, course, own));
    }
    let way = by_others(surface, spread, course, own)?;
    Some(way).filter(|way| is_sound(faces, course, way))
}

/// Where a course leads in the plane of a triangle at the fan's centre.
fn on(surface: Surface, course: &Course, plane: Corner) -> Option<Way> {
    let (Surface { view, faces, .. }, blade) = (surface, course.blade);
    let vector = way(faces, course, plane);
    let carrier = carrier(faces, plane);
    let foot = if carrier == blade.corner {
        locate_by(blade.arms, carrier, DVec3::ZERO, vector)
    } else {
        locate(view, carrier, view.position_at(blade.corner), vector)
    };
    Some((vector, foot?))
}

/// The same where larger triangles tell more of it, or the own one too little.
#[inline(never)]
fn by_others(surface: Surface, spread: &[Blade], course: &Course, own: Way) -> Option<Way> {
    let (Surface { view, faces, .. }, within) = (surface, course.blade.corner);
    let on = |plane: Corner| on(surface, course, plane);
    let steadiest = steadiest(view, faces, spread, within);
    let steady = if steadiest == within { own } else { on(steadiest)? };
    let is_level = |one: DVec3, other: DVec3| one.distance(other) <= view.resolution * LEVEL_HEIGHT;
    let is_near = own.1.reach() <= steady.1.reach().max(FARTHEST);
    let told = if is_level(own.0, steady.0) && is_near { own } else { steady };
    if told.1.reach() <= FARTHEST {
        return Some(told);
    }
    let beyond = on(largest_beyond(surface, steadiest)).filter(|far| is_level(far.0, told.0));
    Some(beyond.unwrap_or(told))
}

fn is_sound(faces: &Faces, course: &Course, (vector, _): &Way) -> bool {
    faces.normal[course.blade.corner.triangle()] != DVec3::ZERO && vector.is_finite()
}

/// By so much normals may be off each other where a way of some length leads to the same place: in a plane
/// it turns with the normal, and is then put down onto it.
pub fn most_lean(view: &View, distance: f64) -> f64 {
    view.resolution * LEVEL_HEIGHT / (4.0 * distance)
}

/// Whether all planes in a fan that could be the corner's own lead to the same place.
fn is_flat(view: &View, faces: &Faces, spread: &[Blade], course: &Course) -> bool {
    let own = faces.normal[course.blade.corner.triangle()];
    let most = most_lean(view, course.distance);
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
#[inline(always)]
fn way(faces: &Faces, course: &Course, plane: Corner) -> DVec3 {
    let normal = faces.normal[plane.triangle()];
    let ahead = unit(course.blade.arms[0]);
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
    let level = chart_of(view, spread, corner).filter(holds_plane_of(view, faces, corner));
    largest(view, level, corner)
}

/// Whether a triangle's plane holds that of a corner.
fn holds_plane_of(view: &View, faces: &Faces, corner: Corner) -> impl Fn(&Corner) -> bool {
    let (at, own) = (view.position_at(corner), faces.normal[corner.triangle()]);
    let arms = arms(view, corner);
    move |other| {
        let normal = faces.normal[other.triangle()];
        let beside = view.position_at(*other) - at;
        let is_near = |way: &DVec3| way.dot(normal).abs() <= view.resolution * LEVEL_HEIGHT;
        let leans_alike = normal.dot(own) > LEVEL_COSINE;
        let is_level = arms.iter().chain([&beside]).all(is_near);
        leans_alike && is_level && !faces.is_line(other.triangle())
    }
}

/// Whether all streams of a triangle lead on to those of a corner's, at each corner of that. A texture may
/// bend on the way, and in the middle of many models it is mirrored.
fn leads_on_to(view: &View, corner: Corner) -> impl Fn(&Corner) -> bool {
    let mesh = &view.mesh;
    let colors = Uv { components: 4, values: mesh.colors.as_flattened() };
    let tangents = Uv { components: 4, values: mesh.tangents.as_flattened() };
    let streams = mesh.uvs.into_iter().chain([colors, tangents]);
    let streams: Few<Uv> = streams.filter(|stream| !stream.values.is_empty()).collect();
    move |plane| {
        let tells = |own: Corner| {
            let foot = locate(view, *plane, view.position_at(own), DVec3::ZERO)?;
            let (blend, own) = (foot.blend(view, 0.0), view.vertex_at(own).index());
            Some(streams.iter().all(|stream| tells(stream, &blend, own)))
        };
        corner.triangle().corners().into_iter().all(|own| tells(own).unwrap_or(false))
    }
}

/// Whether a blend has the values of a vertex.
fn tells(stream: &Uv, blend: &Blend, vertex: usize) -> bool {
    let value = |vertex: usize, component: usize| f64::from(uv_at(stream, vertex)[component]);
    (0..stream.components as usize).all(|component| {
        let values = blend.vertices.map(|vertex| value(vertex as usize, component));
        let told: f64 = (0..3).map(|k| values[k] * f64::from(blend.weights[k])).sum();
        let largest = values.iter().fold(0.0, |most: f64, value| most.max(value.abs()));
        (told - value(vertex, component)).abs() <= ONE_MAP * largest
    })
}

/// The corner of the largest triangle of some; another one unless it is larger than that one's.
fn largest(view: &View, corners: impl Iterator<Item = Corner>, other: Corner) -> Corner {
    let area = |corner: &Corner| area_vector(view.triangle(corner.triangle())).length_squared();
    let largest = corners.max_by(|one, other| area(one).total_cmp(&area(other)));
    largest.filter(|largest| area(largest) > area(&other)).unwrap_or(other)
}

/// The same of the triangles around that of a corner, from side to side as far as they are shaded flat
/// as it is and its chart goes: a small triangle tells nothing of where a wide chamfer ends.
fn largest_beyond(surface: Surface, corner: Corner) -> Corner {
    let Surface { view, topology, faces } = surface;
    let holds_plane = holds_plane_of(view, faces, corner);
    let normal = view.normal_at(corner);
    let holds_own = |other: &Corner| {
        let mut corners = other.triangle().corners().into_iter();
        corners.all(|own| view.normal_at(own) == normal) && holds_plane(other)
    };
    let leads_on = leads_on_to(view, corner);
    let mut found: Few<Corner> = [corner].into_iter().collect();
    let mut done = 0;
    while done < found.len() && found.len() < MOST_BEYOND {
        for side in found[done].triangle().corners() {
            let across = topology.twin[side];
            let is_new =
                |across: Corner| found.iter().all(|known| known.triangle() != across.triangle());
            if across.is_some()
                && goes_on(view, side, across)
                && holds_own(&across)
                && is_new(across)
            {
                found.push(across);
            }
        }
        done += 1;
    }
    largest(view, found.iter().copied().filter(leads_on), corner)
}

/// Whether all streams go on from a half-edge to its twin.
fn goes_on(view: &View, side: Corner, across: Corner) -> bool {
    let ends = [(side, across.next()), (side.next(), across)];
    let is_one = |(one, other)| same_chart(view, view.vertex_at(one), view.vertex_at(other));
    !is_hard(view, side, across) && ends.into_iter().all(is_one)
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check::assert_sound;
    use crate::ids::Vertex;
    use crate::mesh::MeshBuffers;
    use crate::offsets::Offset;
    use crate::options::{Options, Width};
    use crate::pipeline::chamfer;
    use crate::shapes::Builder;
    use crate::stages::stages_of;

    /// The corner of a cube, each face with a small triangle right there.
    ///
    /// ```text
    ///  .-----.
    ///  |   ' |
    ///  | .   |
    ///  |\----'
    /// ```
    fn corner_with_small_triangles() -> MeshBuffers {
        faces_with_small_triangles(&[[0, 1], [1, 2], [2, 0]])
    }

    fn faces_with_small_triangles(faces: &[[usize; 2]]) -> MeshBuffers {
        let (small, mut mesh) = (0.001, Builder::with_uvs());
        let along = |axis: usize, way: f32| [0, 1, 2].map(|k| if k == axis { way } else { 0.0 });
        for &[one, other] in faces {
            let across = [0, 1, 2].map(|k| if k == one || k == other { 1.0 } else { 0.0 });
            mesh.polygon(&[
                along(one, small),
                [0.0; 3],
                along(other, small),
                along(other, 1.0),
                across,
                along(one, 1.0),
            ]);
        }
        mesh.finish()
    }

    #[test]
    fn past_a_small_triangle_the_face_around_it_tells_what_is_there() {
        let mesh = corner_with_small_triangles();
        let stages = stages_of(&mesh, 0.1);
        let at_tip = |offset: &&Offset| {
            offset.moves() && stages.view.position_at(offset.within) == DVec3::ZERO
        };
        let offsets: Vec<&Offset> = stages.offsets.iter().filter(at_tip).collect();
        assert_eq!(offsets.len(), 3);
        for Offset { foot, vector, .. } in offsets {
            assert!(foot.reach() <= FARTHEST, "{foot:?}");
            let blend = foot.blend(&stages.view, 1.0);
            let place: DVec3 = (0..3)
                .map(|k| {
                    stages.view.position(Vertex(blend.vertices[k])) * f64::from(blend.weights[k])
                })
                .sum();
            assert!(place.distance(*vector) < 1e-7, "{place} instead of {vector}");
        }
    }

    /// An open edge ends where the small triangles are: what is told by the faces around them lies there all
    /// the same.
    #[test]
    fn where_a_face_tells_what_is_there_the_mesh_may_be_open() {
        let mesh = faces_with_small_triangles(&[[0, 1], [1, 2]]);
        let options = Options { width: Width::Units(0.1), ..Options::default() };
        assert_sound("two faces", &mesh.as_mesh(), &chamfer(&mesh.as_mesh(), &options).unwrap());
    }

    /// ```text
    ///  .-------------.-----.
    ///  |             |     |     the left half of the face has the mirrored texture of the right one, which
    ///  |             |.    |     has a small triangle in its corner: the left one tells nothing of it, though
    ///  |             | '-./|     it is larger
    ///  '-------------'----'v
    /// ```
    #[test]
    fn a_mirrored_half_tells_nothing_of_the_other() {
        let (small, mut mesh) = (0.002, Builder::with_uvs());
        let [left, right] = [-3.0, 1.0];
        mesh.polygon(&[[left, 0.0, 0.0], [0.0; 3], [0.0, 1.0, 0.0], [left, 1.0, 0.0]]);
        let tip = [[right - small, 0.0, 0.0], [right, 0.0, 0.0], [right, small, 0.0]];
        mesh.polygon(&[[0.0; 3], tip[0], tip[2], [right, 1.0, 0.0], [0.0, 1.0, 0.0]]);
        mesh.polygon(&tip);
        mesh.polygon(&[
            [right, 0.0, 0.0],
            [right, 0.0, -1.0],
            [right, 1.0, -1.0],
            [right, 1.0, 0.0],
        ]);
        mesh.polygon(&[[left, 0.0, -1.0], [right, 0.0, -1.0], [right, 0.0, 0.0], [left, 0.0, 0.0]]);
        let mut mesh = mesh.finish();
        let is_left = |at: &[f32; 3]| at[2] == 0.0 && at[0] < 0.0;
        for (at, uv) in mesh.positions.iter().zip(mesh.uvs[0].values.chunks_mut(2)) {
            uv.copy_from_slice(&[if is_left(at) { at[0].abs() } else { at[0] }, at[1] - at[2]]);
        }
        let result =
            chamfer(&mesh.as_mesh(), &Options { width: Width::Units(0.1), ..Options::default() });
        assert_sound("a mirrored half", &mesh.as_mesh(), &result.unwrap());
    }
}
