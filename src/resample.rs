//! Resample: what a stream is worth at a place on the source surface.
//!
//! A moved vertex is a sample of the surface that was there: it blends the three vertices of one
//! source triangle, on which all streams agree (thesis 6.3, sub-step 5 and appendix I).

use glam::DVec3;

use crate::edges::HARD_COSINE;
use crate::ids::{Corner, Sector, Vertex};
use crate::math::unit;
use crate::plan::Plan;
use crate::report::Blend;
use crate::view::View;

/// A way in the plane of a source triangle, in terms of the edges from one of its corners to the
/// next and to the previous one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Foot {
    pub corner: Corner,
    /// Where the way begins: at the corner, but for vertices in the middle of a side.
    pub start: [f64; 2],
    /// The whole way from there.
    pub along: [f64; 2],
}

/// Past so many times a triangle's sides its streams tell nothing, and single precision cannot add
/// the weights up to 1 any more.
const MOST_WEIGHT: f64 = 1024.0;

/// Weights below this are rounding: a vertex that slides along an edge is on that edge.
const LEAST_WEIGHT: f64 = 1e-9;

impl Foot {
    /// No way at all.
    pub fn at(corner: Corner) -> Foot {
        Foot { corner, start: [0.0; 2], along: [0.0; 2] }
    }

    /// How many times as far as along the triangle's sides the way goes.
    pub fn reach(&self) -> f64 {
        self.along[0].abs().max(self.along[1].abs())
    }

    /// The blend of the triangle's vertices at a share of the way.
    pub fn blend(&self, plan: &Plan, share: f64) -> Blend {
        let [to_next, to_prev] = [0, 1].map(|k| self.start[k] + self.along[k] * share);
        if to_next.abs().max(to_prev.abs()) > MOST_WEIGHT {
            return Blend::one(plan.view.vertex_at(self.corner).0);
        }
        let corners = [self.corner, self.corner.next(), self.corner.prev()];
        let vertices = corners.map(|corner| plan.view.vertex_at(corner).0);
        Blend::new(vertices, [1.0 - to_next - to_prev, to_next, to_prev])
    }
}

/// The way from a point along a vector, projected onto the plane of a corner's triangle; none
/// where the triangle has no area.
pub fn locate(view: &View, corner: Corner, from: DVec3, vector: DVec3) -> Option<Foot> {
    let at = view.position_at(corner);
    let to_next = view.position_at(corner.next()) - at;
    let to_prev = view.position_at(corner.prev()) - at;
    let normal = to_next.cross(to_prev);
    let in_edges = |way: DVec3| {
        [way.cross(to_prev), to_next.cross(way)].map(|part| {
            let weight = part.dot(normal) / normal.length_squared();
            if weight.abs() < LEAST_WEIGHT { 0.0 } else { weight }
        })
    };
    // Nearly all ways begin at the corner.
    let start = if from == at { [0.0; 2] } else { in_edges(from - at) };
    let foot = Foot { corner, start, along: in_edges(vector) };
    let is_sound = foot.start.iter().chain(&foot.along).all(|weight| weight.is_finite());
    is_sound.then_some(foot)
}

/// Where a sector's full offset takes one of its corners on the surface: the triangle that the
/// offset lies on, or one of the corner's own vertex if the surface breaks between the two and that
/// has a plane.
pub fn surface_foot(plan: &Plan, sector: Sector, corner: Corner) -> Foot {
    let agree = |one: Vertex, other: Vertex| {
        let (one, other) = (plan.view.normal(one), plan.view.normal(other));
        one.dot(other) >= HARD_COSINE * (one.length_squared() * other.length_squared()).sqrt()
    };
    foot(plan, sector, corner, agree).unwrap_or(plan.offsets[sector].foot)
}

/// As [`surface_foot`], within the corner's own texture chart; where that has no plane, the corner
/// itself.
pub fn chart_foot(plan: &Plan, sector: Sector, corner: Corner) -> Foot {
    let agree = |one, other| same_chart(plan, one, other);
    foot(plan, sector, corner, agree).unwrap_or(Foot::at(corner))
}

fn foot(
    plan: &Plan,
    sector: Sector,
    corner: Corner,
    agree: impl Fn(Vertex, Vertex) -> bool,
) -> Option<Foot> {
    let offset = &plan.offsets[sector];
    let vertex = plan.view.vertex_at(corner);
    let at_offset = plan.view.vertex_at(offset.within);
    // A line's way lies on its neighbour, which may belong to something else.
    let is_carried =
        !plan.faces.is_line(offset.within.triangle()) || lends_chart(plan, offset.within, &agree);
    if (vertex == at_offset || agree(vertex, at_offset)) && is_carried {
        return Some(offset.foot);
    }
    let own = nearest_own(plan, sector, vertex, &agree)?;
    locate(&plan.view, own, plan.view.position_at(own), offset.vector)
}

/// Whether a line's neighbour agrees with it at both ends of the side between them.
fn lends_chart(plan: &Plan, line: Corner, agree: &impl Fn(Vertex, Vertex) -> bool) -> bool {
    let lender = plan.faces.lender[line.triangle()];
    let side = plan.topology.twin[lender];
    let ends = [(lender, side.next()), (lender.next(), side)];
    let vertices = |(one, other)| (plan.view.vertex_at(one), plan.view.vertex_at(other));
    ends.map(vertices).into_iter().all(|(one, other)| one == other || agree(one, other))
}

/// The corner of the sector, of those that have a plane and agree with the vertex, that is fewest
/// steps round the fan from the one that the offset lies on; of two, the earlier.
fn nearest_own(
    plan: &Plan,
    sector: Sector,
    vertex: Vertex,
    agree: &impl Fn(Vertex, Vertex) -> bool,
) -> Option<Corner> {
    let corners = || plan.sectors.corners(&plan.topology, sector).enumerate();
    let within = plan.offsets[sector].within;
    let middle = corners().find(|(_, corner)| *corner == within)?.0;
    let is_own = |(_, corner): &(usize, Corner)| {
        let own = plan.view.vertex_at(*corner);
        let triangle = corner.triangle();
        let has_plane = plan.faces.normal[triangle] != DVec3::ZERO && !plan.faces.is_line(triangle);
        has_plane && (own == vertex || agree(vertex, own))
    };
    let nearest = corners().filter(is_own).min_by_key(|(step, _)| step.abs_diff(middle));
    nearest.map(|(_, corner)| corner)
}

/// Whether two vertices at one position belong to one chart: equal in all that a chart carries.
pub fn same_chart(plan: &Plan, one: Vertex, other: Vertex) -> bool {
    let mesh = &plan.view.mesh;
    let (a, b) = (one.0 as usize, other.0 as usize);
    one == other
        || (mesh.tangents.is_empty() || mesh.tangents[a] == mesh.tangents[b])
            && (mesh.colors.is_empty() || mesh.colors[a] == mesh.colors[b])
            && mesh.uvs.iter().all(|uv| uv_at(uv, a) == uv_at(uv, b))
}

/// One vertex's value in a UV channel; empty where the channel is absent.
pub fn uv_at<'a>(uv: &crate::mesh::Uv<'a>, vertex: usize) -> &'a [f32] {
    let components = uv.components as usize;
    &uv.values[vertex * components..(vertex + 1) * components]
}

/// The unit normal of a blend of source vertices; exactly theirs where they are all equal.
pub fn blended_normal(plan: &Plan, blend: &Blend) -> DVec3 {
    let normals = blend.vertices.map(|vertex| plan.view.normal(Vertex(vertex)));
    if normals[0] == normals[1] && normals[0] == normals[2] {
        return normals[0];
    }
    let mixed = weighted_sum(blend, normals);
    if mixed == DVec3::ZERO { normals[0] } else { unit(mixed) }
}

pub fn weighted_sum(blend: &Blend, values: [DVec3; 3]) -> DVec3 {
    let [a, b, c] = blend.weights.map(f64::from);
    values[0] * a + values[1] * b + values[2] * c
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ids::Id;
    use crate::plan::tests::plan_of;
    use crate::shapes;

    #[test]
    fn a_foot_blends_the_corners_of_its_triangle() {
        let cube = shapes::plain_cube(1.0);
        let plan = plan_of(&cube, 0.1);
        let blend =
            Foot { corner: Corner(1), start: [0.0; 2], along: [0.5, 0.25] }.blend(&plan, 0.5);
        assert_eq!(blend.vertices, [cube.indices[1], cube.indices[2], cube.indices[0]]);
        assert_eq!(blend.weights, [0.625, 0.25, 0.125]);
    }

    #[test]
    fn equal_normals_blend_to_the_very_same() {
        let sphere = shapes::sphere(5, 7);
        let plan = plan_of(&sphere, 0.1);
        let normal = plan.view.normal(Vertex(9));
        let blend = Blend { vertices: [9; 3], weights: [0.3, 0.3, 0.4] };
        assert_eq!(blended_normal(&plan, &blend), normal);
    }

    #[test]
    fn the_two_sides_of_a_seam_are_two_charts() {
        let cylinder = shapes::cylinder(6);
        let plan = plan_of(&cylinder, 0.1);
        let side = |v: &usize| cylinder.normals[*v][1] == 0.0;
        let at = |v: usize| cylinder.positions[v] == [0.0, 1.0, 0.5];
        let seam: Vec<usize> =
            (0..cylinder.positions.len()).filter(|&v| at(v)).filter(side).collect();
        let [one, other] = [0, 1].map(|place| Vertex::new(seam[place]));
        assert!(!same_chart(&plan, one, other));
        assert!(same_chart(&plan, one, one));
    }

    #[test]
    fn a_vector_is_projected_onto_the_plane_of_a_triangle() {
        let cube = shapes::plain_cube(1.0);
        let plan = plan_of(&cube, 0.1);
        let corner = Corner(0);
        let [a, b, _] = plan.view.triangle(corner.triangle());
        let normal = plan.faces.normal[corner.triangle()];
        let foot = locate(&plan.view, corner, a, (b - a) * 0.5 + normal).unwrap();
        assert!((foot.along[0] - 0.5).abs() < 1e-12 && foot.along[1].abs() < 1e-12);
    }

    #[test]
    fn uv_values_are_taken_by_the_width_of_their_channel() {
        let uv = crate::mesh::Uv { components: 3, values: &[1.0, 2.0, 3.0, 4.0, 5.0, 6.0] };
        assert_eq!(uv_at(&uv, 1), [4.0, 5.0, 6.0]);
        assert!(uv_at(&crate::mesh::Uv::default(), 1).is_empty());
    }

    #[test]
    fn far_past_a_sliver_a_vertex_keeps_its_own_values() {
        let cube = shapes::plain_cube(1.0);
        let plan = plan_of(&cube, 0.1);
        let far = Foot { corner: Corner::new(0), start: [0.0; 2], along: [1e7, -1e7] };
        assert_eq!(far.blend(&plan, 1.0), Blend::one(plan.view.vertex_at(far.corner).0));
    }
}
