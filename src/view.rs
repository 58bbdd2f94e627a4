//! View: the caller's arrays, validated and borrowed.
//!
//! Later stages index without checks of their own, so every rule on the input is tested here.

use glam::{DMat3, DVec3, Vec3};

use crate::error::{Error, Stream};
use crate::ids::{Corner, Id, Triangle, Vertex};
use crate::memory;
use crate::mesh::{Factors, Held, Mesh, UV_CHANNELS, Uv};
use crate::options::{ChamferSubmesh, MOST_SEGMENTS, Options, Width};
use crate::tolerance::{
    ALIKE_COSINE, ALIKE_SHARE, HARD_COSINE, LEAST_ROUNDING, LINE_HEIGHT, RESOLUTION_STEPS,
};
use crate::watch::{Unwatched, Watch};

/// New elements are fewer than eight for each source corner, so ids stay within 32 bits.
pub const MAX_CORNERS: usize = u32::MAX as usize / 8;

/// Below the normal range (1e-38) single precision goes on in steps of this size.
const SMALLEST_STEP: f64 = f32::from_bits(1) as f64;

/// A mesh that keeps all rules.
pub struct View<'a> {
    pub mesh: Mesh<'a>,
    /// The width asked for, in mesh units.
    pub width: f64,
    /// The largest side of the bounds, in mesh units.
    pub extent: f64,
    /// How much of the breadth of each face has to stay, 0 to 1.
    pub least_breadth: f64,
    /// The shortest length that single precision can tell from zero on this mesh.
    pub resolution: f64,
    /// The angle from which on normals differ, where it is not the usual one.
    pub hard_angle: Option<f32>,
    /// Of that angle.
    pub hard_cosine: f64,
    /// Of the angle from which on light breaks between two normals, be their edge hard or not: the usual
    /// one, or that from which on edges are hard, if that is less.
    pub broken_cosine: f64,
    /// Two normals that both differ from a third one by less than this do not differ.
    pub alike_cosine: f64,
    /// How what is measured is stored; none where both are one.
    pub stored: Option<Stored<'a>>,
}

/// The space in which a mesh came, and in which its result is stored.
#[derive(Clone, Copy)]
pub struct Stored<'a> {
    pub positions: &'a [[f32; 3]],
    pub normals: &'a [[f32; 3]],
    /// To where it is measured.
    pub to: DMat3,
    /// From there.
    pub back: DMat3,
    /// How normals go to where it is measured.
    pub normal_to: DMat3,
}

/// As [`view_watched`], with no one to tell.
pub fn view<'a>(mesh: &Mesh<'a>, options: &Options) -> Result<View<'a>, Error> {
    view_watched(mesh, options, &Unwatched)
}

/// Validates a mesh and the options that go with it.
///
/// # Errors
/// The rule that is broken, and [`Error::Cancelled`] where the watch stops it.
pub fn view_watched<'a>(
    mesh: &Mesh<'a>,
    options: &Options,
    watch: &dyn Watch,
) -> Result<View<'a>, Error> {
    check_lengths(mesh)?;
    check_indices(mesh)?;
    watch.worked(mesh.indices.len())?;
    check_finite(mesh, watch)?;
    memory::ask(memory::of_weld(mesh))?;
    if let ChamferSubmesh::Given(submesh) = options.chamfer_submesh {
        let submeshes = mesh.submesh_index_counts.len() as u32;
        if submesh >= submeshes {
            return Err(Error::SubmeshRange { submesh, submeshes });
        }
    }
    check_angles(options)?;
    check_rounding(options)?;
    check_factors(mesh)?;
    let width = width_in_units(mesh, options.width)?;
    let least_breadth = checked_share(options.least_breadth, Error::BadBreadth)?;
    checked_share(options.evenness, Error::BadEvenness)?;
    let mesh = Mesh { factors: that_matter(mesh.factors), ..*mesh };
    Ok(View { width, least_breadth, ..View::new(mesh, options.hard_angle) })
}

/// A mesh that keeps all rules, where it is measured: see [`crate::scale`].
pub fn measured<'a>(mesh: Mesh<'a>, options: &Options) -> Result<View<'a>, Error> {
    check_finite(&mesh, &Unwatched).map_err(|_| Error::BadScale)?;
    let width = width_in_units(&mesh, options.width)?;
    let least_breadth = options.least_breadth.into();
    Ok(View { width, least_breadth, ..View::new(mesh, options.hard_angle) })
}

impl<'a> View<'a> {
    /// A mesh for which no width is asked.
    pub fn new(mesh: Mesh<'a>, hard_angle: f32) -> View<'a> {
        let cosine = |degrees: f64| libm::cos(degrees.to_radians());
        let hard_angle = (hard_angle != Options::default().hard_angle).then_some(hard_angle);
        let (hard_cosine, alike_cosine) = match hard_angle.map(f64::from) {
            None => (HARD_COSINE, ALIKE_COSINE),
            Some(degrees) => (cosine(degrees), cosine(degrees * ALIKE_SHARE)),
        };
        let resolution = resolution(&mesh);
        let extent = mesh.extent().min(f32::MAX).into();
        let (width, least_breadth) = (0.0, 0.0);
        let stored = None;
        View {
            mesh,
            width,
            extent,
            least_breadth,
            resolution,
            hard_angle,
            hard_cosine,
            broken_cosine: hard_cosine.max(HARD_COSINE),
            alike_cosine,
            stored,
        }
    }

    /// What is nearer to each other was set apart by rounding alone; more may have been modelled. As far
    /// as single precision can tell, it is the same wherever the mesh stands.
    pub fn rounding(&self) -> f64 {
        resolution_of(self.extent).max(self.resolution * LEAST_ROUNDING)
    }

    /// What is nearer to a line may have been put on it.
    pub fn reach(&self) -> f64 {
        self.rounding() * LINE_HEIGHT
    }

    /// Whether the mesh has a texture or colours.
    pub fn is_painted(&self) -> bool {
        !self.mesh.colors.is_empty() || self.mesh.uvs.iter().any(|uv| uv.components > 0)
    }

    /// The same with other vertices at its corners, at the same positions.
    pub fn with_indices<'b>(&self, indices: &'b [u32]) -> View<'b>
    where
        'a: 'b,
    {
        View { mesh: Mesh { indices, ..self.mesh }, ..*self }
    }

    #[inline]
    pub fn vertex_at(&self, corner: Corner) -> Vertex {
        Vertex(self.mesh.indices[corner.index()])
    }

    #[inline]
    pub fn position(&self, vertex: Vertex) -> DVec3 {
        wide(self.mesh.positions[vertex.index()])
    }

    /// Where a vertex that has moved to a point is stored. Its move is what is mapped: an axis along
    /// which it did not move keeps its coordinate to the last bit, and so what lay on one line or in one
    /// plane still does.
    #[inline]
    pub fn stored_from(&self, vertex: Vertex, point: DVec3) -> DVec3 {
        self.stored.map_or(point, |stored| {
            wide(stored.positions[vertex.index()]) + stored.back * (point - self.position(vertex))
        })
    }

    /// Where a point is stored that is no vertex of the source.
    #[inline]
    pub fn stored(&self, point: DVec3) -> DVec3 {
        self.stored.map_or(point, |stored| stored.back * point)
    }

    /// The positions of the vertices as they are stored.
    pub fn stored_positions(&self) -> &[[f32; 3]] {
        self.stored.map_or(self.mesh.positions, |stored| stored.positions)
    }

    #[inline]
    pub fn normal(&self, vertex: Vertex) -> DVec3 {
        wide(self.mesh.normals[vertex.index()])
    }

    /// Whether two vertices have the very same normal.
    #[inline]
    pub fn has_one_normal(&self, one: Vertex, other: Vertex) -> bool {
        let [one, other] = [one, other].map(|vertex| self.mesh.normals[vertex.index()]);
        Vec3::from(one) == Vec3::from(other)
    }

    /// Whether two normals are those of a hard edge. One without length differs from none.
    #[inline]
    pub fn normals_differ(&self, normals: [DVec3; 2]) -> bool {
        differ(normals, self.hard_cosine)
    }

    /// Whether light breaks between two normals: what is seen of a face is not what is seen of the other.
    #[inline]
    pub fn normals_break(&self, normals: [DVec3; 2]) -> bool {
        differ(normals, self.broken_cosine)
    }

    /// Whether light breaks at some edges that are not hard.
    pub fn has_soft_breaks(&self) -> bool {
        self.hard_cosine < self.broken_cosine
    }

    #[inline]
    pub fn position_at(&self, corner: Corner) -> DVec3 {
        self.position(self.vertex_at(corner))
    }

    #[inline]
    pub fn normal_at(&self, corner: Corner) -> DVec3 {
        self.normal(self.vertex_at(corner))
    }

    #[inline]
    pub fn triangle(&self, triangle: Triangle) -> [DVec3; 3] {
        triangle.corners().map(|corner| self.position_at(corner))
    }

    /// The middle of the box around the vertices.
    pub fn center(&self) -> DVec3 {
        let positions = self.mesh.positions.iter().map(|&position| Vec3::from(position));
        let sides = |(low, high): (Vec3, Vec3), at: Vec3| (low.min(at), high.max(at));
        let all = (Vec3::INFINITY, Vec3::NEG_INFINITY);
        let (low, high) = positions.fold(all, sides);
        low.as_dvec3().midpoint(high.as_dvec3())
    }

    pub fn corner_count(&self) -> usize {
        self.mesh.indices.len()
    }

    pub fn triangles(&self) -> impl Iterator<Item = Triangle> + use<> {
        (0..self.mesh.indices.len() / 3).map(Triangle::new)
    }
}

#[inline]
fn differ([one, other]: [DVec3; 2], cosine: f64) -> bool {
    let lengths = (one.length_squared() * other.length_squared()).sqrt();
    one.dot(other) < cosine * lengths
}

pub fn wide(value: [f32; 3]) -> DVec3 {
    DVec3::new(f64::from(value[0]), f64::from(value[1]), f64::from(value[2]))
}

fn check_rounding(options: &Options) -> Result<(), Error> {
    if !(1..=MOST_SEGMENTS).contains(&options.segments) {
        return Err(Error::BadSegments(options.segments));
    }
    let is_share = (0.0..=1.0).contains(&options.profile);
    if is_share { Ok(()) } else { Err(Error::BadProfile(options.profile)) }
}

fn checked_share(share: f32, wrong: fn(f32) -> Error) -> Result<f64, Error> {
    if (0.0..=1.0).contains(&share) { Ok(share.into()) } else { Err(wrong(share)) }
}

fn width_in_units(mesh: &Mesh, width: Width) -> Result<f64, Error> {
    let (given, unit) = match width {
        Width::Units(units) => (units, 1.0),
        Width::PercentOfExtent(percent) => (percent, f64::from(mesh.extent()) / 100.0),
    };
    if given.is_finite() && given >= 0.0 {
        Ok(f64::from(given) * unit)
    } else {
        Err(Error::BadWidth(given))
    }
}

/// The shortest length that single precision can tell from zero on a mesh.
pub fn resolution(mesh: &Mesh) -> f64 {
    let largest = mesh.positions.as_flattened().iter().fold(0.0_f32, |m, x| m.max(x.abs()));
    resolution_of(largest.into())
}

/// The same where coordinates are as large as this.
pub fn resolution_of(largest: f64) -> f64 {
    (largest * f64::from(f32::EPSILON)).max(SMALLEST_STEP) * RESOLUTION_STEPS
}

fn check_angles(options: &Options) -> Result<(), Error> {
    let Options { min_angle, max_angle, hard_angle, .. } = *options;
    let ranges = [
        ("min_angle", min_angle, 180.0),
        ("max_angle", max_angle, 180.0),
        ("hard_angle", hard_angle, 90.0),
    ];
    if let Some(&(option, degrees, most)) =
        ranges.iter().find(|(_, degrees, most)| !(0.0..=*most).contains(degrees))
    {
        return Err(Error::BadAngle { option, degrees, most });
    }
    if min_angle > max_angle { Err(Error::AngleOrder { min_angle, max_angle }) } else { Ok(()) }
}

fn check_factors(mesh: &Mesh) -> Result<(), Error> {
    let Factors { submeshes, vertices, edges } = mesh.factors;
    if !submeshes.is_empty() {
        check_length(Stream::SubmeshFactors, mesh.submesh_index_counts.len(), submeshes.len())?;
    }
    if !vertices.is_empty() {
        check_length(Stream::VertexFactors, mesh.positions.len(), vertices.len())?;
    }
    let count = mesh.positions.len() as u32;
    for (edge, listed) in (0..).zip(edges) {
        if let Some(&vertex) = listed.vertices.iter().find(|&&vertex| vertex >= count) {
            return Err(Error::EdgeRange { edge, vertex, vertices: count });
        }
    }
    let bad = |factor: &f32| !(factor.is_finite() && *factor >= 0.0);
    let check = |stream: Stream, place: Option<usize>, factor: &dyn Fn(usize) -> f32| match place {
        Some(place) => Err(Error::BadFactor { stream, place: place as u32, factor: factor(place) }),
        None => Ok(()),
    };
    check(Stream::SubmeshFactors, submeshes.iter().position(bad), &|k| submeshes[k])?;
    check(Stream::VertexFactors, vertices.iter().position(bad), &|k| vertices[k])?;
    let bad_edge = edges.iter().position(|edge| bad(&edge.factor));
    check(Stream::EdgeFactors, bad_edge, &|k| edges[k].factor)
}

/// Factors that are all 1 say nothing, and are left out.
fn that_matter(factors: Factors) -> Factors {
    let matter = |factors| if all_one(factors) { &[] } else { factors };
    let Factors { submeshes, vertices, edges } = factors;
    Factors { submeshes: matter(submeshes), vertices: matter(vertices), edges }
}

fn all_one(factors: &[f32]) -> bool {
    factors.iter().all(|factor| *factor == 1.0)
}

fn check_lengths(mesh: &Mesh) -> Result<(), Error> {
    let vertices = mesh.positions.len();
    if mesh.normals.is_empty() && vertices > 0 {
        return Err(Error::MissingNormals);
    }
    check_length(Stream::Normals, vertices * 3, mesh.normals.len() * 3)?;
    if !mesh.tangents.is_empty() {
        check_length(Stream::Tangents, vertices * 4, mesh.tangents.len() * 4)?;
    }
    if !mesh.colors.is_empty() {
        check_length(Stream::Colors, vertices * 4, mesh.colors.len() * 4)?;
    }
    for channel in 0..UV_CHANNELS as u32 {
        check_uv(channel, mesh.uvs[channel as usize], vertices)?;
    }
    Ok(())
}

fn check_uv(channel: u32, uv: Uv, vertices: usize) -> Result<(), Error> {
    match uv.components {
        0 if uv.values.is_empty() => Ok(()),
        components @ 2..=4 => {
            check_length(Stream::Uv(channel), vertices * components as usize, uv.values.len())
        }
        components => Err(Error::UvComponents { channel, components }),
    }
}

fn check_length(stream: Stream, expected: usize, found: usize) -> Result<(), Error> {
    if expected == found {
        Ok(())
    } else {
        Err(Error::StreamLength { stream, expected: expected as u64, found: found as u64 })
    }
}

/// Whether the indices are in range and make whole triangles.
pub fn check_indices(mesh: &Mesh) -> Result<(), Error> {
    let counts = mesh.submesh_index_counts;
    if let Some(submesh) = counts.iter().position(|count| count % 3 != 0) {
        return Err(Error::IndexCount { submesh: submesh as u32, count: counts[submesh] });
    }
    let expected: u64 = counts.iter().map(|&count| u64::from(count)).sum();
    if expected != mesh.indices.len() as u64 {
        return Err(Error::IndexTotal { expected, found: mesh.indices.len() as u64 });
    }
    if mesh.indices.len() > MAX_CORNERS || mesh.positions.len() > MAX_CORNERS {
        return Err(Error::TooLarge);
    }
    let vertices = mesh.positions.len() as u32;
    match mesh.indices.iter().position(|&index| index >= vertices) {
        None => Ok(()),
        Some(place) => {
            Err(Error::IndexRange { place: place as u32, index: mesh.indices[place], vertices })
        }
    }
}

/// Whether all values of all streams are finite.
///
/// # Errors
/// The first that is not, and [`Error::Cancelled`] where the watch stops it.
pub fn check_finite(mesh: &Mesh, watch: &dyn Watch) -> Result<(), Error> {
    let check_stream = |stream, values: &[f32], components| {
        check_stream(stream, values, components)?;
        watch.worked(values.len())
    };
    check_stream(Stream::Positions, mesh.positions.as_flattened(), 3)?;
    check_stream(Stream::Normals, mesh.normals.as_flattened(), 3)?;
    check_stream(Stream::Tangents, mesh.tangents.as_flattened(), 4)?;
    check_stream(Stream::Colors, mesh.colors.as_flattened(), 4)?;
    if let Some(place) = mesh.held.iter().position(|held| !is_finite(held)) {
        return Err(Error::NotFinite { stream: Stream::Held, vertex: place as u32 });
    }
    for (channel, uv) in mesh.uvs.iter().enumerate() {
        check_stream(Stream::Uv(channel as u32), uv.values, uv.components as usize)?;
    }
    Ok(())
}

fn is_finite(held: &Held) -> bool {
    [held.from, held.to].as_flattened().iter().all(|value| value.is_finite())
        && held.radius.is_finite()
}

/// Whether all values of a stream, so many to a vertex, are finite.
fn check_stream(stream: Stream, values: &[f32], components: usize) -> Result<(), Error> {
    // A plain pass over all values is much faster than a search, and nearly always enough.
    if values.iter().fold(true, |all, value| all & value.is_finite()) {
        return Ok(());
    }
    let place = values.iter().position(|value| !value.is_finite()).unwrap_or(0);
    Err(Error::NotFinite { stream, vertex: (place / components) as u32 })
}

#[cfg(test)]
mod tests {
    use super::*;

    const POSITIONS: [[f32; 3]; 3] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    const NORMALS: [[f32; 3]; 3] = [[0.0, 0.0, 1.0]; 3];

    fn triangle() -> Mesh<'static> {
        Mesh {
            positions: &POSITIONS,
            normals: &NORMALS,
            indices: &[0, 1, 2],
            submesh_index_counts: &[3],
            ..Mesh::default()
        }
    }

    fn error_of(mesh: Mesh) -> Error {
        view(&mesh, &Options::default()).err().expect("the mesh breaks a rule")
    }

    #[test]
    fn a_sound_mesh_is_taken_and_the_width_resolved() {
        let options = Options { width: Width::PercentOfExtent(5.0), ..Options::default() };
        let view = view(&triangle(), &options).unwrap();
        assert!((view.width - 0.05).abs() < 1e-9);
    }

    #[test]
    fn each_broken_rule_names_its_element() {
        assert_eq!(error_of(Mesh { normals: &[], ..triangle() }), Error::MissingNormals);
        assert_eq!(
            error_of(Mesh { normals: &NORMALS[..2], ..triangle() }),
            Error::StreamLength { stream: Stream::Normals, expected: 9, found: 6 }
        );
        assert_eq!(
            error_of(Mesh { indices: &[0, 1, 3], ..triangle() }),
            Error::IndexRange { place: 2, index: 3, vertices: 3 }
        );
        assert_eq!(
            error_of(Mesh { indices: &[0, 1], submesh_index_counts: &[2], ..triangle() }),
            Error::IndexCount { submesh: 0, count: 2 }
        );
        assert_eq!(
            error_of(Mesh { submesh_index_counts: &[], ..triangle() }),
            Error::IndexTotal { expected: 0, found: 3 }
        );
        let broken = [[0.0; 3], [0.0; 3], [0.0, f32::NAN, 0.0]];
        assert_eq!(
            error_of(Mesh { positions: &broken, ..triangle() }),
            Error::NotFinite { stream: Stream::Positions, vertex: 2 }
        );
    }

    //   .--.           .--.
    //   |  |           |  |     as far out as it is large nothing changes; much farther out rounding sets
    //   '--'  origin   '--'     more apart
    #[test]
    fn what_rounding_sets_apart_does_not_depend_on_the_origin() {
        let rounding = |by: f32| {
            let at = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]].map(|at| at.map(|x| x + by));
            view(&Mesh { positions: &at, ..triangle() }, &Options::default()).unwrap().rounding()
        };
        let here = rounding(0.0);
        assert_eq!([-1.0, -0.5, 1.0].map(rounding), [here; 3]);
        assert_eq!(rounding(63.0), here * 32.0);
    }

    #[test]
    fn uv_channels_are_two_to_four_wide() {
        let mut mesh = triangle();
        mesh.uvs[3] = Uv { components: 1, values: &[0.0; 3] };
        assert_eq!(error_of(mesh), Error::UvComponents { channel: 3, components: 1 });
    }

    #[test]
    fn a_negative_width_is_refused() {
        let options = Options { width: Width::Units(-1.0), ..Options::default() };
        assert_eq!(view(&triangle(), &options).err(), Some(Error::BadWidth(-1.0)));
        for share in [-0.1, 1.1, f32::INFINITY] {
            let options = Options { least_breadth: share, ..Options::default() };
            assert_eq!(view(&triangle(), &options).err(), Some(Error::BadBreadth(share)));
        }
        let options = Options { least_breadth: f32::NAN, ..Options::default() };
        assert!(matches!(view(&triangle(), &options).err(), Some(Error::BadBreadth(_))));
    }
}
