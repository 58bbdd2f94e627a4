//! Resample: what a stream is worth at a place on the source surface.
//!
//! A moved vertex is a sample of the surface that was there: it blends the three vertices of one
//! source triangle, on which all streams agree (thesis 6.3, sub-step 5 and appendix I).

use glam::DVec3;

use crate::breaks::{is_broken, is_hard, same_chart};
use crate::edges::seam_channels;
use crate::foot::{Foot, MOST_WEIGHT, locate};
use crate::ids::{Corner, Few, Sector, Triangle, Vertex};
use crate::math::unit;
use crate::offsets::Offset;
use crate::report::Blend;
use crate::sectors::Sectors;
use crate::surface::Surface;
use crate::tolerance::{CREASE_COSINE, TOUCHING, TOUCHING_STEPS};
use crate::view::{Stored, View, wide};

/// So much nearer than the farthest place that can be told, for the sake of rounding.
const TOLD_SAFETY: f64 = 1.0005;

/// Where a sector's full offset takes one of its corners on the surface: the triangle that the
/// offset lies on, or one of the corner's own vertex if the surface breaks between the two and that
/// has a plane. It stands at a share of the offset.
pub fn surface_foot(
    surface: Surface,
    sectors: &Sectors,
    (offset, share): (&Offset, f64),
    corner: Corner,
) -> Foot {
    let agree = |one: Vertex, other: Vertex| {
        !surface.view.normals_differ([one, other].map(|vertex| surface.view.normal(vertex)))
    };
    let usual = foot(surface, sectors, offset, corner, agree).unwrap_or(offset.foot);
    // Most fans are one part, and most ways lie on a face: there is nothing to walk around for.
    if !sectors.fans[sectors.sector_of[corner]].is_broken && !leaves(surface, offset, corner) {
        return usual;
    }
    let normal = surface.view.normal_at(corner);
    let mut corners = usual.corner.triangle().corners().into_iter();
    if corners.all(|corner| surface.view.normal_at(corner) == normal) {
        return usual;
    }
    let own_part = own_foot(surface, sectors, offset, (corner, is_hard));
    if own_part.is_none() && surface.view.has_soft_breaks() {
        return soft_foot(surface, sectors, (offset, share), corner);
    }
    let told = own_part.unwrap_or(usual);
    lying_on(surface, sectors, (told, offset, share), corner)
}

/// The same where no edge between the corner and the offset is hard, but light breaks at some. What is no hard
/// edge may be left over its other side: then that is the surface there. A face that is shaded flat and that
/// the way does not leave keeps its normal. Where soft edges turn by more than a hard one all together, light
/// would break between the two, so the nearest face around that is hardly left is the surface there.
fn soft_foot(
    surface: Surface,
    sectors: &Sectors,
    (offset, share): (&Offset, f64),
    corner: Corner,
) -> Foot {
    let way = offset.vector * share;
    let lying_on = lying_on(surface, sectors, (offset.foot, offset, share), corner);
    let normal = blended_normal(surface.view, &lying_on.blend(surface.view, share));
    let Some(own) = own_foot(surface, sectors, offset, (corner, is_broken)) else {
        let is_guess = leaves(surface, offset, corner)
            && !lying_on.is_within(share)
            && surface.view.normals_differ([surface.view.normal_at(corner), normal]);
        // A line, past a face that is shaded as a curved one: nobody knows.
        return if is_guess { Foot::at(corner) } else { lying_on };
    };
    if keeps(surface, own.corner, way) {
        return own;
    }
    if is_one(surface, sectors, (normal, offset, share), corner) {
        return lying_on;
    }
    hardly_left(surface, sectors, (offset, share), own.corner).unwrap_or(lying_on)
}

/// Whether a face is shaded flat and a way does not leave it.
fn keeps(surface: Surface, corner: Corner, way: DVec3) -> bool {
    is_flat(surface.view, corner) && lies_on(surface, corner, way)
}

/// The way over the face that is fewest steps around the corner away, of those of its part that are shaded
/// flat and that the way hardly leaves; of two, the earlier. None where that goes with the offset itself.
fn hardly_left(
    surface: Surface,
    sectors: &Sectors,
    (offset, share): (&Offset, f64),
    own: Corner,
) -> Option<Foot> {
    let view = surface.view;
    let fan = fan_of(surface, sectors, own);
    let part = part_of(view, &fan, (own, is_hard))?;
    let middle = part.iter().position(|&corner| corner == own)?;
    let is_near = |&(_, &corner): &(usize, &Corner)| {
        has_plane(surface, corner.triangle())
            && is_flat(view, corner)
            && off_plane(surface, corner, offset.vector * share) <= HARDLY_LEFT * view.extent
    };
    let near = part.iter().enumerate().filter(is_near);
    let (_, &nearest) = near.min_by_key(|(step, _)| step.abs_diff(middle))?;
    if others(view, part, offset.within).all(|&other| other != nearest) {
        return None;
    }
    locate(view, nearest, view.position_at(nearest), offset.vector)
}

/// A face that is left by no more than this share of the extent is as good as the surface there: as near are
/// parts that were modelled to touch.
const HARDLY_LEFT: f64 = 0.5 * TOUCHING;

/// Whether a normal is one with all those that faces of a corner's part keep where its vertex goes that way.
fn is_one(
    surface: Surface,
    sectors: &Sectors,
    (normal, offset, share): (DVec3, &Offset, f64),
    corner: Corner,
) -> bool {
    let view = surface.view;
    let fan = fan_of(surface, sectors, corner);
    part_of(view, &fan, (corner, is_hard)).is_some_and(|part| {
        let way = offset.vector * share;
        let is_kept =
            |own: &&Corner| has_plane(surface, own.triangle()) && keeps(surface, **own, way);
        let mut kept = others(view, part, offset.within).filter(is_kept);
        kept.all(|&own| !view.normals_differ([view.normal_at(own), normal]))
    })
}

/// The corners of a part between which and the one that the offset lies on light breaks: all others go with
/// the offset, also where its face is shaded as a curved one and theirs, in its plane, are not.
fn others<'a>(
    view: &'a View,
    part: &'a [Corner],
    within: Corner,
) -> impl Iterator<Item = &'a Corner> {
    let pieces = part.chunk_by(|&one, &other| !is_broken(view, other, one.prev()));
    pieces.filter(move |piece| !piece.contains(&within)).flatten()
}

/// The corners of the sector that a corner is of.
fn fan_of(surface: Surface, sectors: &Sectors, corner: Corner) -> Few<Corner> {
    sectors.corners(surface.topology, sectors.sector_of[corner]).collect()
}

/// The corners of a fan that are of one part with a corner.
fn part_of<'a>(
    view: &View,
    fan: &'a [Corner],
    (corner, breaks): (Corner, Breaks),
) -> Option<&'a [Corner]> {
    let mut parts = fan.chunk_by(|&one, &other| !breaks(view, other, one.prev()));
    parts.find(|part| part.contains(&corner))
}

/// A way as it is told, or else the one that its end lies on, where it ends past the face that tells it.
fn lying_on(
    surface: Surface,
    sectors: &Sectors,
    (told, offset, share): (Foot, &Offset, f64),
    corner: Corner,
) -> Foot {
    if told.is_within(share) {
        return told;
    }
    below(surface, sectors, (offset, share), corner).unwrap_or(told)
}

/// The way over the face of a corner's part that its end lies on. Past a face that is shaded as a curved one
/// nobody knows, and along an edge that stays hard the two sides are to agree as they did.
fn below(
    surface: Surface,
    sectors: &Sectors,
    (offset, share): (&Offset, f64),
    corner: Corner,
) -> Option<Foot> {
    let fan = fan_of(surface, sectors, corner);
    let part = part_of(surface.view, &fan, (corner, is_hard))?;
    let on = |&own: &Corner| {
        let foot = locate(surface.view, own, surface.view.position_at(own), offset.vector)?;
        let lies_on = lies_on(surface, own, offset.vector * share);
        (lies_on && has_plane(surface, own.triangle()) && foot.is_within(share)).then_some(foot)
    };
    part.iter().find_map(on)
}

/// Whether the surface breaks between two half-edges that are twins.
type Breaks = fn(&View, Corner, Corner) -> bool;

/// The corners of a sector, each with the number of its part: between two of them light breaks. A vertex
/// that is of both has two normals once it moves, if it goes along an edge whose sides are shaded alike at
/// that end alone.
pub fn parts<'a>(
    surface: Surface<'a>,
    sectors: &'a Sectors,
    sector: Sector,
) -> impl Iterator<Item = (Corner, u32)> + 'a {
    let breaks: Breaks = if surface.view.has_soft_breaks() { is_broken } else { is_hard };
    let is_broken = sectors.fans[sector].is_broken;
    let (mut before, mut part) = (None, 0);
    sectors.corners(surface.topology, sector).map(move |corner| {
        let before = before.replace(corner).filter(|_| is_broken);
        let begins = before.is_some_and(|other: Corner| breaks(surface.view, corner, other.prev()));
        part += u32::from(begins);
        (corner, part)
    })
}

/// Whether a corner's triangle is shaded flat: past a curved one nobody knows.
fn is_flat(view: &View, corner: Corner) -> bool {
    let bends = |other: Corner| view.normals_break([corner, other].map(|at| view.normal_at(at)));
    ![corner.next(), corner.prev()].into_iter().any(bends)
}

/// Whether a way from a corner stays in the plane of its triangle.
fn lies_on(surface: Surface, corner: Corner, way: DVec3) -> bool {
    off_plane(surface, corner, way) <= TOUCHING_STEPS * surface.view.resolution
}

/// How far a way from a corner leaves the plane of its triangle.
fn off_plane(surface: Surface, corner: Corner, way: DVec3) -> f64 {
    surface.faces.normal[corner.triangle()].dot(way).abs()
}

/// As [`surface_foot`], within the corner's own texture chart; where that has no plane, the corner
/// itself.
pub fn chart_foot(surface: Surface, sectors: &Sectors, offset: &Offset, corner: Corner) -> Foot {
    let agree = |one, other| same_chart(surface.view, one, other);
    let usual = foot(surface, sectors, offset, corner, agree).unwrap_or(Foot::at(corner));
    let [vertex, carrier] = [corner, usual.corner].map(|at| surface.view.vertex_at(at));
    if vertex == carrier || surface.view.mesh.uvs.iter().all(|uvs| uvs.components == 0) {
        return usual;
    }
    // Two charts may have the same coordinates at the corner, and other ones around it.
    let fan = fan_of(surface, sectors, corner);
    let parts = || fan.chunk_by(|one, other| seam_channels(surface.view, *other, one.prev()) == 0);
    let is_carried = |part: &[Corner]| part.contains(&usual.corner) || !fan.contains(&usual.corner);
    match parts().find(|part| part.contains(&corner)) {
        Some(part) if !is_carried(part) => {
            let own = nearest(surface, &fan, offset, |own| part.contains(&own));
            let way = |own| locate(surface.view, own, surface.view.position_at(own), offset.vector);
            own.and_then(way).unwrap_or(Foot::at(corner))
        }
        _ => usual,
    }
}

/// The share of a sector's offset up to which all its corners can tell what is there: past so many times
/// the sides of a small triangle nobody could, and what is painted there would be torn.
pub fn told_share(surface: Surface, sectors: &Sectors, offset: &Offset, sector: Sector) -> f64 {
    let reach = if offset.is_plain {
        offset.foot.reach()
    } else {
        let may_be_far = |corner: &Corner| {
            let [next, prev] = [corner.next(), corner.prev()]
                .map(|other| surface.view.position_at(other) - surface.view.position_at(*corner));
            let longest = next.length_squared().max(prev.length_squared());
            offset.vector.length_squared() * longest
                > MOST_WEIGHT * MOST_WEIGHT * next.cross(prev).length_squared()
        };
        let small = sectors.corners(surface.topology, sector).filter(may_be_far);
        small.map(|c| chart_foot(surface, sectors, offset, c).reach()).fold(0.0, f64::max)
    };
    if reach > MOST_WEIGHT { MOST_WEIGHT / (reach * TOLD_SAFETY) } else { 1.0 }
}

fn foot(
    surface: Surface,
    sectors: &Sectors,
    offset: &Offset,
    corner: Corner,
    agree: impl Fn(Vertex, Vertex) -> bool,
) -> Option<Foot> {
    let vertex = surface.view.vertex_at(corner);
    let at_offset = surface.view.vertex_at(offset.within);
    // A line's way lies on its neighbour, which may belong to something else.
    let is_carried = !surface.faces.is_line(offset.within.triangle())
        || lends_chart(surface, offset.within, &agree);
    if (vertex == at_offset || agree(vertex, at_offset)) && is_carried {
        return Some(offset.foot);
    }
    let fan = fan_of(surface, sectors, corner);
    let is_own = |own: Corner| {
        let own = surface.view.vertex_at(own);
        own == vertex || agree(vertex, own)
    };
    let own = nearest(surface, &fan, offset, is_own)?;
    locate(surface.view, own, surface.view.position_at(own), offset.vector)
}

/// Whether a line's neighbour agrees with it at both ends of the side between them.
fn lends_chart(surface: Surface, line: Corner, agree: &impl Fn(Vertex, Vertex) -> bool) -> bool {
    let lender = surface.faces.lender[line.triangle()];
    let side = surface.topology.twin[lender];
    let ends = [(lender, side.next()), (lender.next(), side)];
    let vertices = |(one, other)| (surface.view.vertex_at(one), surface.view.vertex_at(other));
    ends.map(vertices).into_iter().all(|(one, other)| one == other || agree(one, other))
}

/// The corner of a fan, of those that have a plane and are the vertex's own, that is fewest steps
/// from the one that the offset lies on; of two, the earlier.
fn nearest(
    surface: Surface,
    fan: &[Corner],
    offset: &Offset,
    is_own: impl Fn(Corner) -> bool,
) -> Option<Corner> {
    let middle = fan.iter().position(|corner| *corner == offset.within)?;
    let own = fan
        .iter()
        .enumerate()
        .filter(|(_, corner)| has_plane(surface, corner.triangle()) && is_own(**corner));
    own.min_by_key(|(step, _)| step.abs_diff(middle)).map(|(_, &corner)| corner)
}

/// The corner of a fan, of those that have a plane, whose normal is nearest to that of a line: rounding
/// turns a line by more than a degree, so that it may have no soft side though it was meant to.
fn likest(surface: Surface, fan: &[Corner], line: Corner) -> Option<Corner> {
    let normal = |corner: Corner| unit(surface.view.normal_at(corner));
    let alike = |corner: Corner| normal(line).dot(normal(corner));
    let own = fan.iter().copied().filter(|corner| has_plane(surface, corner.triangle()));
    let likest = own.rev().max_by(|&one, &other| alike(one).total_cmp(&alike(other)))?;
    (alike(likest) > CREASE_COSINE).then_some(likest)
}

/// The way over a face of the corner's own where the offset leads over one beyond: behind a hard edge
/// that is not chamfered or, from a line, where the faces around the corner have one normal all over,
/// so that they keep it. Where the offset leads a hair out of that face's plane, the place below counts:
/// a face that is shaded flat stays so.
fn own_foot(
    surface: Surface,
    sectors: &Sectors,
    offset: &Offset,
    (corner, breaks): (Corner, Breaks),
) -> Option<Foot> {
    let fan = fan_of(surface, sectors, corner);
    let part = part_of(surface.view, &fan, (corner, breaks))?;
    let own = if !part.contains(&offset.within) {
        nearest(surface, &fan, offset, |own| part.contains(&own))
            .or_else(|| likest(surface, &fan, corner))
    } else if leaves(surface, offset, corner) && is_even(surface, part, corner) {
        let normal = surface.view.normal_at(corner);
        nearest(surface, &fan, offset, |own| surface.view.normal_at(own) == normal)
    } else {
        None
    }?;
    locate(surface.view, own, surface.view.position_at(own), offset.vector)
}

/// Whether a way begins or lies on a triangle that is but a line.
fn leaves(surface: Surface, offset: &Offset, corner: Corner) -> bool {
    [corner, offset.within].iter().any(|at| !has_plane(surface, at.triangle()))
}

/// Whether a triangle is more than a line.
fn has_plane(surface: Surface, triangle: Triangle) -> bool {
    surface.faces.normal[triangle] != DVec3::ZERO && !surface.faces.is_line(triangle)
}

/// Whether the triangles of a part of a fan have one corner's very normal at all their corners.
fn is_even(surface: Surface, part: &[Corner], corner: Corner) -> bool {
    let normal = surface.view.normal_at(corner);
    let is_even = |corner: &Corner| {
        let corners = corner.triangle().corners();
        corners.into_iter().all(|corner| surface.view.normal_at(corner) == normal)
    };
    part.iter().all(is_even)
}

/// The unit normal of a blend of source vertices; exactly theirs where they are all equal. Where the
/// mesh is measured stretched, it is what is stored that is blended, as it is where it is drawn.
pub fn blended_normal(view: &View, blend: &Blend) -> DVec3 {
    let normals = blend.vertices.map(|vertex| view.normal(Vertex(vertex)));
    if normals[0] == normals[1] && normals[0] == normals[2] {
        return normals[0];
    }
    let mixed = match &view.stored {
        Some(Stored { normals, normal_to, .. }) => {
            let stored = blend.vertices.map(|vertex| wide(normals[vertex as usize]));
            *normal_to * weighted_sum(blend, stored)
        }
        None => weighted_sum(blend, normals),
    };
    if mixed == DVec3::ZERO { normals[0] } else { unit(mixed) }
}

/// The same in single precision, where the mesh is the one that is stored.
#[inline]
pub fn stored_normal(view: &View, blend: &Blend) -> [f32; 3] {
    let [a, b, c] = blend.vertices.map(|vertex| view.mesh.normals[vertex as usize]);
    // Most faces are flat: nothing is to be blended.
    if is_same(a, b) && is_same(a, c) {
        a
    } else {
        blended_normal(view, blend).as_vec3().to_array()
    }
}

/// Whether two vectors are equal, without a loop.
#[inline]
pub fn is_same([x, y, z]: [f32; 3], [other_x, other_y, other_z]: [f32; 3]) -> bool {
    x == other_x && y == other_y && z == other_z
}

pub fn weighted_sum(blend: &Blend, values: [DVec3; 3]) -> DVec3 {
    let [a, b, c] = blend.weights.map(f64::from);
    values[0] * a + values[1] * b + values[2] * c
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ids::Id;
    use crate::mesh::MeshBuffers;
    use crate::options::{Options, Width};
    use crate::scale::Scale;
    use crate::shapes;
    use crate::stages::{Stages, stages_of, stages_with};
    use crate::view::view;

    #[test]
    fn equal_normals_blend_to_the_very_same() {
        let sphere = shapes::sphere(5, 7);
        let stages = stages_of(&sphere, 0.1);
        let normal = stages.view.normal(Vertex(9));
        let blend = Blend { vertices: [9; 3], weights: [0.3, 0.3, 0.4] };
        assert_eq!(blended_normal(&stages.view, &blend), normal);
    }

    /// Halfway between the two as they are stored, and that as it stands four times as high: half of the way
    /// between the two as they stand would be what nobody sees there.
    #[test]
    fn normals_are_blended_as_they_are_stored() {
        let cube = shapes::plain_cube(1.0);
        let options =
            Options::default().with_scale([[1.0, 0.0, 0.0], [0.0, 4.0, 0.0], [0.0, 0.0, 1.0]]);
        let scale = Scale::new(&options).unwrap().unwrap();
        let measured = scale.measured(&cube.as_mesh());
        let mesh = measured.mesh(&cube.as_mesh());
        let stored = Some(scale.stored(&cube.as_mesh()));
        let view = View { stored, ..view(&mesh, &options).unwrap() };
        let facing = |way: [f32; 3]| cube.normals.iter().position(|&n| n == way).unwrap() as u32;
        let [x, y] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]].map(facing);
        let normal = blended_normal(&view, &Blend::new([x, y, x], [0.5, 0.5, 0.0]));
        assert!(normal.distance(unit(DVec3::new(1.0, 0.25, 0.0))) < 1e-7, "{normal}");
    }

    #[test]
    fn a_place_is_told_up_to_a_thousand_sides_away() {
        let cube = shapes::cube(1.0);
        for (width, expected) in [(0.1, 1.0), (1000.0, 1.0), (4096.0, 0.25)] {
            let stages = stages_of(&cube, width);
            let (sector, offset) = (Sector(0), stages.offsets[Sector(0)]);
            for is_plain in [offset.is_plain, false] {
                let offset = Offset { is_plain, ..offset };
                let told = told_share(stages.surface(), &stages.sectors, &offset, sector);
                assert!((told - expected).abs() < 0.001, "{width}: {told}");
            }
        }
    }

    //   v---.      each triangle of a cube has a texture of its own, and all have one value at one corner
    //   |\  |      of the cube: what goes along a diagonal from there leads over either triangle, and
    //   | \ |      each keeps to its own
    //   '---'
    #[test]
    fn charts_that_agree_at_a_corner_alone_are_two() {
        let cube = shapes::plain_cube(2.0);
        for tip in &cube.positions {
            let at = |k: &u32| *k as usize;
            let mut apart = cube.clone();
            apart.positions = cube.indices.iter().map(|k| cube.positions[at(k)]).collect();
            apart.normals = cube.indices.iter().map(|k| cube.normals[at(k)]).collect();
            apart.indices = (0..cube.indices.len() as u32).collect();
            apart.uvs[0].components = 2;
            let uv = |k: usize| if apart.positions[k] == *tip { [0.0; 2] } else { [k as f32, 1.0] };
            apart.uvs[0].values = (0..cube.indices.len()).flat_map(uv).collect();
            let stages = stages_of(&apart, 0.1);
            for corner in (0..cube.indices.len()).map(Corner::new) {
                if apart.positions[corner.index()] == *tip {
                    let offset = &stages.offsets[stages.sectors.sector_of[corner]];
                    let foot = chart_foot(stages.surface(), &stages.sectors, offset, corner);
                    assert_eq!(foot.corner.triangle(), corner.triangle(), "{corner:?}");
                }
            }
        }
    }

    //  .---.
    //  |\  |     of the two triangles of a face that is shaded as a curved one, the one that the place is on
    //  | \ |     tells its normal, whichever the way was measured on
    //  '---v
    #[test]
    fn beside_an_edge_that_stays_hard_the_face_below_tells_the_normal() {
        let mut cube = shapes::plain_cube(1.0);
        for (normal, turn) in cube.normals.iter_mut().zip(1..) {
            let turned = wide(*normal) + DVec3::splat(0.002 * f64::from(turn));
            *normal = unit(turned).as_vec3().to_array();
        }
        let mut looked_at = 0;
        for hard_angle in [1.0, 20.0] {
            let mut stages = stages_where(&cube, hard_angle);
            for sector in stages.sectors.fans.ids() {
                stages.sectors.fans[sector].is_broken = true;
                let fan: Vec<Corner> = stages.sectors.corners(&stages.topology, sector).collect();
                let [one, other] = fan[..] else { continue };
                for (on, told_on) in [(one, other), (other, one)] {
                    let at = |corner: Corner| stages.view.position_at(corner);
                    let vector = ((at(on.next()) - at(on)) + (at(on.prev()) - at(on))) * 0.2;
                    let foot = locate(&stages.view, told_on, at(on), vector).unwrap();
                    let usual = stages.offsets[sector];
                    let offset = Offset { vector, foot, within: told_on, is_plain: false, ..usual };
                    let foot = surface_foot(stages.surface(), &stages.sectors, (&offset, 1.0), one);
                    assert_eq!(foot.corner, on);
                    looked_at += 1;
                }
            }
        }
        assert!(looked_at > 0);
    }

    fn stages_where(mesh: &MeshBuffers, hard_angle: f32) -> Stages<'_> {
        let options = Options::default().with_width(Width::Units(0.1)).with_hard_angle(hard_angle);
        stages_with(mesh, &options)
    }

    /// Faces around a tip, each of which turns by less than 20 degrees from the one before, and two walls
    /// that close them.
    fn tip() -> MeshBuffers {
        around(&[-100.0, 0.0, 15.0, 30.0, 45.0, 60.0, 160.0].map(|degrees| (degrees, 0.0)))
    }

    /// Faces around a point at a height of 1, between ways by their degrees and the heights of their ends.
    fn around(ways: &[(f32, f32)]) -> MeshBuffers {
        let at = |(degrees, height): (f32, f32)| {
            [degrees.to_radians().cos(), degrees.to_radians().sin(), height]
        };
        let mut mesh = MeshBuffers::default();
        for pair in ways.windows(2) {
            let corners = [[0.0, 0.0, 1.0], at(pair[0]), at(pair[1])];
            let [a, b, c] = corners.map(wide);
            mesh.normals.extend([unit((b - a).cross(c - a)).as_vec3().to_array(); 3]);
            mesh.positions.extend(corners);
        }
        mesh.indices = (0..mesh.positions.len() as u32).collect();
        mesh.submesh_index_counts = vec![mesh.indices.len() as u32];
        mesh
    }

    /// The way lies in the planes of the first and the last of the faces around the tip, and on the last. The
    /// second goes with that as long as both are one, or else with the first, or keeps its own where it is
    /// hardly left.
    #[test]
    fn what_leaves_its_face_goes_with_one_beside_that_keeps_its_normal() {
        let tip = tip();
        let [first, second, last] = [1, 2, 4].map(|face| Triangle(face).corners()[0]);
        for (hard_angle, leaves_by, on) in
            [(20.0, 1e-3, first), (40.0, 1e-3, last), (20.0, 5e-6, second), (40.0, 5e-6, last)]
        {
            let stages = stages_where(&tip, hard_angle);
            let (view, sector) = (&stages.view, stages.sectors.sector_of[first]);
            assert_eq!(sector, stages.sectors.sector_of[last]);
            let normal = |corner: Corner| stages.faces.normal[corner.triangle()];
            let along = normal(first).cross(normal(last));
            let vector = along * (leaves_by / along.dot(normal(second)));
            let foot = locate(view, last, view.position_at(last), vector).unwrap();
            let offset = Offset { vector, foot, within: last, ..stages.offsets[sector] };
            let foot = surface_foot(stages.surface(), &stages.sectors, (&offset, 1.0), second);
            assert_eq!(foot.corner, on, "{hard_angle}, {leaves_by}");
        }
    }

    /// Four triangles around a point, three of a plane and one that leans. The way lies on the third, which is
    /// shaded as a curved one: so all of the plane go with it, unless light breaks at the first, and so does
    /// the fourth, but where the first keeps another normal and the fourth is hardly left.
    #[test]
    fn what_goes_with_the_offset_keeps_no_normal_of_its_own() {
        let flat = [-45.0, 0.0, 45.0, 90.0].map(|degrees| (degrees, 1.0));
        let leaning = [(-100.0, 0.0), (135.0, 0.85), (200.0, 0.0)];
        let [first, curved, beside] = [1, 3, 4].map(|face| Triangle(face).corners());
        let turned = |degrees: f32| [degrees.to_radians().sin(), 0.0, degrees.to_radians().cos()];
        for (first_turns, aside, on) in [
            (0.0, 0.1, curved[0]),
            (10.0, 0.1, curved[0]),
            (0.0, 2e-5, curved[0]),
            (10.0, 2e-5, beside[0]),
        ] {
            let mut mesh = around(&[&leaning[..1], &flat, &leaning[1..]].concat());
            mesh.normals[curved[2].index()] = turned(-30.0);
            for corner in first {
                mesh.normals[corner.index()] = turned(first_turns);
            }
            let stages = stages_where(&mesh, 20.0);
            let [sector, other] = [curved, beside].map(|at| stages.sectors.sector_of[at[0]]);
            assert_eq!(sector, other);
            let (within, vector) = (curved[0], DVec3::new(aside, 0.85, 0.0));
            let foot = locate(&stages.view, within, DVec3::Z, vector).unwrap();
            let offset = Offset { vector, foot, within, ..stages.offsets[sector] };
            let told = |at: Corner| {
                surface_foot(stages.surface(), &stages.sectors, (&offset, 1.0), at).corner
            };
            assert_eq!(told(Triangle(2).corners()[0]), within);
            assert_eq!(told(first[0]) == within, first_turns == 0.0);
            assert_eq!(told(beside[0]), on, "{first_turns}, {aside}");
        }
    }

    //   .-----.
    //   |     |
    //   '-----*- o   past the side of a face that is shaded as a curved one, from a line: nobody knows
    #[test]
    fn past_a_curved_face_a_line_keeps_its_normal() {
        let mut cube = shapes::plain_cube(1.0);
        for (normal, turn) in cube.normals.iter_mut().zip(1..) {
            let turned = wide(*normal) + DVec3::splat(0.02 * f64::from(turn % 3));
            *normal = unit(turned).as_vec3().to_array();
        }
        let mut stages = stages_where(&cube, 5.0);
        let corner = Corner(0);
        let sector = stages.sectors.sector_of[corner];
        stages.sectors.fans[sector].is_broken = true;
        let at = |corner: Corner| stages.view.position_at(corner);
        let vector = (at(corner) - at(corner.next())) * 20.0;
        let beyond = locate(&stages.view, corner, at(corner), vector).unwrap();
        let offset = Offset { vector, foot: beyond, within: corner, ..stages.offsets[sector] };
        let told = |stages: &Stages| {
            surface_foot(stages.surface(), &stages.sectors, (&offset, 1.0), corner)
        };
        assert_eq!(told(&stages), beyond);
        let lender = stages.topology.twin[corner];
        stages.faces.lender[corner.triangle()] = lender;
        assert_eq!(told(&stages), Foot::at(corner));
    }
}
