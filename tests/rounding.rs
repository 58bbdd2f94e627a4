//! Rounded chamfers: where their points lie, and how many there are.

use chamfer::check::assert_sound;
use chamfer::{Chamfered, MeshBuffers, Options, TriangleKind, Verify, Width, chamfer, shapes};
use glam::DVec3;

const HALF: f64 = 1.0;
const WIDTH: f64 = 0.2;

/// A cube from -1 to 1, chamfered.
fn rounded(segments: u32, profile: f32) -> (MeshBuffers, Chamfered) {
    let cube = shapes::plain_cube(2.0 * HALF as f32);
    let options = Options::default()
        .with_width(Width::Units(WIDTH as f32))
        .with_segments(segments)
        .with_profile(profile);
    let result = chamfer(&cube.as_mesh(), &options).unwrap();
    assert_sound("cube", &cube.as_mesh(), &result);
    (cube, result)
}

fn wide(value: [f32; 3]) -> DVec3 {
    DVec3::from(value.map(f64::from))
}

/// The centre of the cube, where a cube is that does not stand around the origin.
fn centre(cube: &MeshBuffers) -> DVec3 {
    let sum: DVec3 = cube.positions.iter().map(|&position| wide(position)).sum();
    sum / cube.positions.len() as f64
}

/// The nearest point of the box that the centres of all circles and spheres bound.
fn axis_at(point: DVec3) -> DVec3 {
    let most = DVec3::splat(HALF - WIDTH);
    point.clamp(-most, most)
}

// Each of the 12 edges has n - 1 rows of two points more, and each of the 8 corners a triangular
// grid of which these are the sides:
//   6 * 4 + 12 * 2 * (n - 1) + 8 * (n - 1) * (n - 2) / 2 points,
//   6 * 2 + 12 * 2 * n + 8 * n * n triangles.
#[test]
fn a_cube_has_the_counts_of_its_grids() {
    for n in [1, 2, 3, 4, 7, 32] {
        let (_, result) = rounded(n, 0.5);
        let n = n as usize;
        let rows = n - 1;
        let points = 24 + 24 * rows + 4 * rows * rows.saturating_sub(1);
        assert_eq!(result.mesh.positions.len(), points, "{n} segments");
        assert_eq!(result.mesh.indices.len() / 3, 12 + 24 * n + 8 * n * n, "{n} segments");
        assert!(result.verdicts.iter().all(|edge| edge.segments as usize == n));
    }
}

#[test]
fn every_point_lies_on_the_cylinders_and_the_spheres() {
    for n in [2, 3, 4, 8] {
        let (cube, result) = rounded(n, 0.5);
        for (point, normal) in result.mesh.positions.iter().zip(&result.mesh.normals) {
            let point = wide(*point) - centre(&cube);
            let way = point - axis_at(point);
            let is_in_corner = way.abs().min_element() > 1e-6;
            let tolerance = if is_in_corner { 0.01 * WIDTH } else { 1e-5 * 2.0 * HALF };
            assert!((way.length() - WIDTH).abs() < tolerance, "{point} is {} off", way.length());
            let angle = way.angle_between(wide(*normal)).to_degrees();
            assert!(angle < 2.0, "the normal at {point} leans by {angle} degrees");
        }
    }
}

#[test]
fn the_profile_moves_between_the_flat_chamfer_and_the_old_corner() {
    let farthest = |profile: f32| {
        let (cube, result) = rounded(4, profile);
        let sources = result.mesh.positions.iter().zip(result.vertex_sources.iter());
        let added = sources.filter(|(_, source)| source.is_between());
        let lengths = added.map(|(&point, _)| (wide(point) - centre(&cube)).abs().element_sum());
        lengths.fold(0.0, f64::max)
    };
    let flat = 3.0 * HALF - 2.0 * WIDTH;
    let sums: Vec<f64> = [0.0, 0.25, 0.5, 0.75, 1.0].map(farthest).to_vec();
    assert!((sums[0] - (3.0 * HALF - 2.0 * WIDTH)).abs() < 1e-5, "{sums:?} is {flat} at first");
    assert!(sums.is_sorted() && sums[4] > 2.8 * HALF, "{sums:?}");
}

#[test]
fn points_of_a_rounded_chamfer_say_that_they_lie_on_no_face() {
    let (_, result) = rounded(4, 0.5);
    let is_joint = |vertex: usize| vertex < 24;
    for (vertex, source) in result.vertex_sources.iter().enumerate() {
        assert_eq!(source.is_between(), !is_joint(vertex));
        assert!((source.surface.weights.iter().sum::<f32>() - 1.0).abs() < 1e-6);
    }
}

#[test]
fn rounding_is_the_same_whatever_is_verified_and_on_threads() {
    let field = shapes::cube_field(64);
    let options = Options::default().with_segments(3);
    let of = |options: &Options| chamfer(&field.as_mesh(), options).unwrap().mesh;
    let full = of(&options);
    assert_eq!(full, of(&options.with_verify(Verify::Fast)));
    assert_eq!(full, of(&options.with_threads(3)));
}

#[test]
fn all_demo_models_are_sound_with_any_number_of_segments() {
    for (name, mesh) in shapes::demo_models() {
        for (segments, profile) in [(2, 0.5), (3, 0.2), (4, 0.5), (5, 0.8), (9, 1.0)] {
            let options = Options::default()
                .with_width(Width::PercentOfExtent(2.0))
                .with_segments(segments)
                .with_profile(profile);
            let result = chamfer(&mesh.as_mesh(), &options).unwrap();
            assert_sound(&format!("{name} at {segments}"), &mesh.as_mesh(), &result);
            let kinds: Vec<TriangleKind> = result.triangle_sources.iter().map(|t| t.kind).collect();
            assert!(kinds.contains(&TriangleKind::Edge), "{name}");
        }
    }
}

/// Vertices at one place follow the surface alike, or a mesh that is bent would open.
#[test]
fn what_stands_at_one_place_comes_from_one_blend() {
    for (name, mesh) in shapes::demo_models() {
        let options = Options::default().with_width(Width::PercentOfExtent(2.0)).with_segments(4);
        let result = chamfer(&mesh.as_mesh(), &options).unwrap();
        let sources = result.vertex_sources.iter().zip(&result.mesh.positions);
        let mut between: Vec<_> = sources
            .filter(|(source, _)| source.is_between())
            .map(|(source, at)| (at.map(f32::to_bits), place_of(&mesh, &source.surface)))
            .collect();
        between.sort_by_key(|(at, _)| *at);
        for pair in between.windows(2).filter(|pair| pair[0].0 == pair[1].0) {
            assert!(pair[0].1.distance(pair[1].1) < 1e-6, "{name}: {pair:?}");
        }
    }
}

fn place_of(mesh: &MeshBuffers, blend: &chamfer::Blend) -> DVec3 {
    let terms = blend.vertices.iter().zip(blend.weights);
    terms.map(|(&v, weight)| wide(mesh.positions[v as usize]) * f64::from(weight)).sum()
}

/// What a point comes from is never farther from it than the width.
#[test]
fn blends_are_near_their_points() {
    let (cube, result) = rounded(8, 0.5);
    for (source, &position) in result.vertex_sources.iter().zip(&result.mesh.positions) {
        let off = place_of(&cube, &source.surface).distance(wide(position));
        assert!(off < if source.is_between() { WIDTH } else { 1e-6 }, "{off}");
    }
}

// The texture of a cube is an atlas with a chart for each face: what a chart has freed around
// itself is all that its chamfers may show.
#[test]
fn rows_stay_in_the_band_of_their_owner() {
    let cube = shapes::cube(1.0);
    let with = |segments: u32| {
        let options = Options::default().with_width(Width::Units(0.1)).with_segments(segments);
        chamfer(&cube.as_mesh(), &options).unwrap()
    };
    let area = |result: &Chamfered| -> f64 {
        let uv = |vertex: u32| {
            let values = &result.mesh.uvs[0].values;
            [0, 1].map(|k| f64::from(values[2 * vertex as usize + k]))
        };
        let twice = |triangle: &[u32]| {
            let [a, b, c] = [0, 1, 2].map(|k| uv(triangle[k]));
            (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
        };
        let all = result.mesh.indices.chunks(3).map(|triangle| twice(triangle).abs());
        all.sum::<f64>() / 2.0
    };
    let (flat, round) = (area(&with(1)), area(&with(4)));
    // Neither more nor less of the texture is shown than with one segment.
    assert!((flat - round).abs() < 1e-6, "{flat} and {round}");
    for (vertex, source) in with(4).vertex_sources.iter().enumerate() {
        assert!(source.uv(0).weights.iter().all(|weight| *weight > -1e-6), "{vertex}: {source:?}");
    }
}

// Each vertex of the rim is a ring of two sectors: the strips on both sides share an arc.
#[test]
fn a_rim_of_two_sectors_is_rounded_all_around() {
    let cylinder = shapes::cylinder(24);
    let options = Options::default().with_width(Width::Units(0.1)).with_segments(4);
    let result = chamfer(&cylinder.as_mesh(), &options).unwrap();
    assert_sound("cylinder", &cylinder.as_mesh(), &result);
    let strips = result.triangle_sources.iter().filter(|t| t.kind == TriangleKind::Edge).count();
    assert_eq!(strips, 2 * 24 * 2 * 4);
    assert!(result.verdicts.iter().all(|edge| edge.segments == 4));
}

#[test]
fn out_of_range_is_refused() {
    let cube = shapes::plain_cube(1.0);
    let told = |options: Options| chamfer(&cube.as_mesh(), &options).unwrap_err().to_string();
    let default = Options::default();
    for segments in [0, 33] {
        let expected = format!("the number of segments is {segments}: give 1 to 32");
        assert_eq!(told(default.with_segments(segments)), expected);
    }
    for profile in [-0.1, 1.1, f32::NAN] {
        assert!(told(default.with_profile(profile)).starts_with("the profile is "));
    }
}
