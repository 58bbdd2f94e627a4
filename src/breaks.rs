//! Breaks: whether two corners or vertices at one position differ in some stream.

use glam::DVec3;

use crate::ids::{Corner, Id, Vertex};
use crate::mesh::Uv;
use crate::tolerance::EQUAL_UV;
use crate::view::View;

/// Whether the stored normals differ between two half-edges that are twins.
pub fn is_hard(view: &View, side: Corner, other: Corner) -> bool {
    differ(view, side, other, |normals| view.normals_differ(normals))
}

/// Whether light breaks between two half-edges that are twins, be they a hard edge or not.
pub fn is_broken(view: &View, side: Corner, other: Corner) -> bool {
    differ(view, side, other, |normals| view.normals_break(normals))
}

/// Whether two half-edges that are twins have different normals at either end.
fn differ(view: &View, side: Corner, other: Corner, differ: impl Fn([DVec3; 2]) -> bool) -> bool {
    let differ = |one: Corner, other: Corner| {
        let (one, other) = (view.vertex_at(one), view.vertex_at(other));
        one != other && differ([view.normal(one), view.normal(other)])
    };
    differ(side, other.next()) || differ(side.next(), other)
}

/// Whether two corners at one position differ in a UV channel.
#[inline]
pub fn seam_between(view: &View, channel: usize, one: Corner, other: Corner) -> bool {
    uvs_differ(&view.mesh.uvs[channel], [one, other].map(|corner| view.vertex_at(corner)))
}

/// Whether two vertices at one position differ in a UV channel.
#[inline]
pub fn uvs_differ(uv: &Uv, [one, other]: [Vertex; 2]) -> bool {
    if one == other {
        return false;
    }
    let mut values = uv_at(uv, one.index()).iter().zip(uv_at(uv, other.index()));
    values.any(|(&a, &b)| (a - b).abs() > EQUAL_UV * a.abs().max(1.0))
}

/// Whether two vertices at one position belong to one chart: equal in all that a chart carries.
pub fn same_chart(view: &View, one: Vertex, other: Vertex) -> bool {
    let mesh = &view.mesh;
    let (a, b) = (one.0 as usize, other.0 as usize);
    one == other
        || (mesh.tangents.is_empty() || mesh.tangents[a] == mesh.tangents[b])
            && (mesh.colors.is_empty() || mesh.colors[a] == mesh.colors[b])
            && mesh.uvs.iter().all(|uv| uv_at(uv, a) == uv_at(uv, b))
}

/// One vertex's value in a UV channel; empty where the channel is absent.
pub fn uv_at<'a>(uv: &Uv<'a>, vertex: usize) -> &'a [f32] {
    let components = uv.components as usize;
    &uv.values[vertex * components..(vertex + 1) * components]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes;
    use crate::stages::stages_of;

    #[test]
    fn the_two_sides_of_a_seam_are_two_charts() {
        let cylinder = shapes::cylinder(6);
        let stages = stages_of(&cylinder, 0.1);
        let side = |v: &usize| cylinder.normals[*v][1] == 0.0;
        let at = |v: usize| cylinder.positions[v] == [0.0, 1.0, 0.5];
        let seam: Vec<usize> =
            (0..cylinder.positions.len()).filter(|&v| at(v)).filter(side).collect();
        let [one, other] = [0, 1].map(|place| Vertex::new(seam[place]));
        assert!(!same_chart(&stages.view, one, other));
        assert!(same_chart(&stages.view, one, one));
    }

    #[test]
    fn uv_values_are_taken_by_the_width_of_their_channel() {
        let uv = Uv { components: 3, values: &[1.0, 2.0, 3.0, 4.0, 5.0, 6.0] };
        assert_eq!(uv_at(&uv, 1), [4.0, 5.0, 6.0]);
        assert!(uv_at(&Uv::default(), 1).is_empty());
    }
}
