//! Selection: which hard edges are chamfered, and how wide at each end.

use glam::DVec3;

use crate::faces::Faces;
use crate::ids::{Cluster, Corner, Triangle, Vertex};
use crate::options::{Convexity, Options, WidthMode};
use crate::tolerance::ANGLE_ROUNDING;
use crate::topology::Topology;
use crate::view::View;
use crate::weld::Weld;

/// Across edges that are flatter than five degrees, or folded further than 175, depths, chords and
/// radii tell nothing of the offset: it would be more than so many times as large.
const MOST_TIMES: f64 = 23.0;

/// An end gets at least this share of the other: a chamfer that tapered to a point could not be
/// closed there.
const LEAST_TAPER: f64 = 1.0 / 16.0;

/// What a caller has asked for.
pub struct Selection<'a> {
    view: &'a View<'a>,
    /// Of the largest and of the least angle.
    cosines: [f64; 2],
    convexity: Convexity,
    mode: WidthMode,
    /// `#submeshes`: the first triangle behind each.
    submesh_ends: Vec<u32>,
    /// The clusters at the ends of listed edges, lower first, with their factors; sorted.
    listed: Vec<([Cluster; 2], f32)>,
}

pub fn selection<'a>(view: &'a View, weld: &Weld, options: &Options) -> Selection<'a> {
    let cosine = |degrees: f32| libm::cos(f64::from(degrees).to_radians());
    let rounded = [-ANGLE_ROUNDING, ANGLE_ROUNDING];
    let angles = [cosine(options.max_angle), cosine(options.min_angle)];
    let mut ends = 0;
    let submesh_ends = view.mesh.submesh_index_counts.iter().map(|count| {
        ends += count / 3;
        ends
    });
    let mut listed: Vec<([Cluster; 2], f32)> = (view.mesh.factors.edges.iter())
        .map(|edge| {
            let [one, two] = edge.vertices.map(|vertex| weld.cluster_of[Vertex(vertex)]);
            ([one.min(two), one.max(two)], edge.factor)
        })
        .collect();
    // Of one that is listed twice, the first counts.
    listed.sort_by_key(|(clusters, _)| *clusters);
    Selection {
        view,
        cosines: [angles[0] + rounded[0], angles[1] + rounded[1]],
        convexity: options.convexity,
        mode: options.width_mode,
        submesh_ends: if view.mesh.factors.submeshes.is_empty() {
            Vec::new()
        } else {
            submesh_ends.collect()
        },
        listed,
    }
}

impl Selection<'_> {
    /// The width in mesh units at both ends of a hard edge, in the direction of its first side; none
    /// where it is not to be chamfered.
    pub fn widths(
        &self,
        topology: &Topology,
        faces: &Faces,
        sides: [Corner; 2],
    ) -> Option<[f64; 2]> {
        let [one, two] = sides.map(|side| faces.normal[side.triangle()]);
        if !self.takes_angle(one.dot(two)) || !self.takes_turn(sides[0], one.cross(two)) {
            return None;
        }
        let width = self.view.width * self.times(one, two);
        if self.has_no_factors() {
            return Some([width; 2]);
        }
        let factor = self.submesh_factor(sides) * self.listed_factor(topology, sides[0])?;
        let ends = self.masked(sides).map(|mask| mask * factor);
        let widest = ends[0].max(ends[1]);
        (widest > 0.0).then(|| ends.map(|end| width * end.max(widest * LEAST_TAPER)))
    }

    /// Whether no edge is asked for more or less wide than others, but by its angle.
    fn has_no_factors(&self) -> bool {
        let masks =
            [self.submesh_ends.len(), self.listed.len(), self.view.mesh.factors.vertices.len()];
        masks == [0; 3]
    }

    fn takes_angle(&self, cosine: f64) -> bool {
        self.cosines[0] <= cosine && cosine <= self.cosines[1]
    }

    /// By the axis about which the first face turns into the second: along the edge, or against it.
    fn takes_turn(&self, side: Corner, axis: DVec3) -> bool {
        let along = || self.view.position_at(side.next()) - self.view.position_at(side);
        match self.convexity {
            Convexity::Both => true,
            Convexity::Convex => axis.dot(along()) > 0.0,
            Convexity::Concave => axis.dot(along()) < 0.0,
        }
    }

    /// How many times the width asked for the offset is.
    fn times(&self, one: DVec3, two: DVec3) -> f64 {
        // Of half the angle between the normals: what the faces open by is the rest to half a turn.
        let (sine, cosine) = (|| (one - two).length() / 2.0, || (one + two).length() / 2.0);
        let times = match self.mode {
            WidthMode::Offset => 1.0,
            WidthMode::Chord => 0.5 / cosine(),
            WidthMode::Depth => 1.0 / sine(),
            WidthMode::Radius => sine() / cosine(),
        };
        times.min(MOST_TIMES)
    }

    fn submesh_factor(&self, sides: [Corner; 2]) -> f64 {
        if self.submesh_ends.is_empty() {
            return 1.0;
        }
        let of = |triangle: Triangle| {
            let submesh = self.submesh_ends.partition_point(|&end| end <= triangle.0);
            f64::from(self.view.mesh.factors.submeshes[submesh])
        };
        let [one, two] = sides.map(|side| of(side.triangle()));
        one.min(two)
    }

    fn listed_factor(&self, topology: &Topology, side: Corner) -> Option<f64> {
        if self.listed.is_empty() {
            return Some(1.0);
        }
        let [one, two] = [side, side.next()].map(|corner| topology.cluster_at[corner]);
        let clusters = [one.min(two), one.max(two)];
        let place = self.listed.partition_point(|(listed, _)| *listed < clusters);
        let (listed, factor) = self.listed.get(place)?;
        (*listed == clusters).then_some(f64::from(*factor))
    }

    fn masked(&self, sides: [Corner; 2]) -> [f64; 2] {
        let mask = self.view.mesh.factors.vertices;
        if mask.is_empty() {
            return [1.0; 2];
        }
        let of = |corner: Corner| f64::from(mask[self.view.vertex_at(corner).0 as usize]);
        let [one, two] = sides;
        [(one, two.next()), (one.next(), two)].map(|(a, b)| (of(a) + of(b)) / 2.0)
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec2;

    use crate::edges::HardEdge;
    use crate::mesh::{EdgeFactor, Factors};
    use crate::report::EdgeVerdict;
    use crate::stages::stages_with;
    use crate::{Chamfered, Convexity, Mesh, MeshBuffers, Options, Reason, Width, WidthMode};
    use crate::{chamfer, shapes};

    fn at(width: f32) -> Options {
        Options::default().with_width(Width::Units(width))
    }

    fn chamfered(mesh: &MeshBuffers, options: Options, factors: Factors) -> Chamfered {
        chamfer(&Mesh { factors, ..mesh.as_mesh() }, &options).unwrap()
    }

    #[test]
    fn what_selects_all_selects_all_and_what_selects_nothing_changes_nothing() {
        let bolt = shapes::bolt();
        let (submeshes, vertices) = (vec![1.0; 2], vec![1.0; bolt.positions.len()]);
        let all = Factors { submeshes: &submeshes, vertices: &vertices, edges: &[] };
        let plain = chamfered(&bolt, at(0.02), Factors::default());
        assert_eq!(chamfered(&bolt, at(0.02), all).mesh, plain.mesh);
        let none = vec![0.0; bolt.positions.len()];
        let none = Factors { vertices: &none, ..Factors::default() };
        let left = chamfered(&bolt, at(0.02), none);
        assert_eq!(left.mesh, bolt);
        assert!(left.verdicts.iter().all(|edge| edge.reason == Reason::NotSelected));
        assert_eq!(left.totals.skipped[Reason::NotSelected], left.totals.hard_edges);
    }

    /// How many edges are selected.
    fn count(mesh: &MeshBuffers, options: Options) -> usize {
        let result = chamfered(mesh, options, Factors::default());
        result.verdicts.iter().filter(|edge| edge.reason != Reason::NotSelected).count()
    }

    // Six sides: the edges around the ends turn by 90 degrees, those along it by 60.
    #[test]
    fn edges_are_selected_by_angle() {
        let prism = shapes::prism(6);
        assert_eq!(count(&prism, at(0.02)), 18);
        assert_eq!(count(&prism, at(0.02).with_angles(60.0, 60.0)), 6);
        assert_eq!(count(&prism, at(0.02).with_angles(61.0, 90.0)), 12);
        assert_eq!(count(&prism, at(0.02).with_angles(91.0, 180.0)), 0);
    }

    #[test]
    fn edges_are_selected_by_convexity() {
        let room = shapes::saddle();
        let [both, convex, concave] = [Convexity::Both, Convexity::Convex, Convexity::Concave]
            .map(|convexity| count(&room, at(0.02).with_convexity(convexity)));
        assert!(convex > 0 && concave > 0);
        assert_eq!(both, convex + concave);
    }

    #[test]
    fn a_mask_tapers_edges() {
        let cube = shapes::plain_cube(1.0);
        let mask: Vec<f32> = cube.positions.iter().map(|at| at[1] + 0.5).collect();
        let factors = Factors { vertices: &mask, ..Factors::default() };
        let result = chamfered(&cube, at(0.1), factors);
        let is_upright = |edge: &&EdgeVerdict| {
            let [a, b] = edge.vertices.map(|v| cube.positions[v as usize][1]);
            a != b
        };
        for edge in result.verdicts.iter().filter(is_upright) {
            let [least, most] =
                [edge.widths[0].min(edge.widths[1]), edge.widths[0].max(edge.widths[1])];
            assert!((most - 0.1).abs() < 1e-6 && least <= 0.1 / 16.0, "{edge:?}");
        }
        let skipped = result.verdicts.iter().filter(|edge| edge.reason == Reason::NotSelected);
        assert_eq!(skipped.count(), 4, "those of the bottom");
    }

    #[test]
    fn listed_edges_alone_are_chamfered() {
        let cube = shapes::plain_cube(1.0);
        let first = chamfered(&cube, at(0.1), Factors::default()).verdicts[0].vertices;
        let edges = [EdgeFactor { vertices: [first[1], first[0]], factor: 0.5 }];
        let result = chamfered(&cube, at(0.1), Factors { edges: &edges, ..Factors::default() });
        let selected = result.verdicts.iter().filter(|edge| edge.reason != Reason::NotSelected);
        assert!(selected.map(|edge| edge.vertices).eq([first]));
        let all: Vec<EdgeFactor> = chamfered(&cube, at(0.1), Factors::default())
            .verdicts
            .iter()
            .map(|edge| EdgeFactor { vertices: edge.vertices, factor: 0.5 })
            .collect();
        let result = chamfered(&cube, at(0.1), Factors { edges: &all, ..Factors::default() });
        let is_half = |width: &f32| (width - 0.05).abs() < 1e-6;
        assert!(result.verdicts.iter().all(|edge| edge.widths.iter().all(is_half)));
    }

    // A wedge that opens by an angle; its long edge is measured.
    #[test]
    fn each_mode_measures_what_it_says() {
        for degrees in (5..=175).step_by(10) {
            let angle = f64::from(degrees).to_radians();
            let mesh = shapes::wedge(angle as f32);
            let half = angle / 2.0;
            let modes = [
                (WidthMode::Offset, 1.0),
                (WidthMode::Chord, 2.0 * half.sin()),
                (WidthMode::Depth, half.cos()),
                (WidthMode::Radius, half.tan()),
            ];
            for (mode, measure) in modes {
                // As much as makes an offset of a thousandth.
                let options = at((1e-3 * measure) as f32).with_width_mode(mode);
                let stages = stages_with(&mesh, &options);
                let is_ridge = |edge: &&HardEdge| {
                    let ends = [edge.sides[0], edge.sides[0].next()];
                    ends.iter().all(|&end| stages.view.position_at(end).truncate() == DVec2::ZERO)
                };
                let widths = stages.edges.hard.iter().find(is_ridge).unwrap().widths;
                let is_right = |width: &f64| (width - 1e-3).abs() < 1e-7;
                assert!(widths.iter().all(is_right), "{mode:?} at {degrees}: {widths:?}");
            }
        }
    }
}
