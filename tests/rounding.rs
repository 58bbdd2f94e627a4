//! Rounded chamfers: where their points lie, and how many there are.

use chamfer::check::assert_sound;
use chamfer::{
    Chamfered, EdgeFactor, Factors, Mesh, MeshBuffers, Options, TriangleKind, TriangleSource,
    Verify, Width, chamfer, shapes,
};
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
    // Large enough that threads share the work.
    let field = shapes::cube_field(1000);
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

// Seen from above, a corner of a prism of six sides has its edges turn by 60 degrees. Both arcs at
// its rim are one, in the plane through the axis that halves the corner.
//    \_   _ _ the plane of one edge's end would cut off the other one's strip
//      `.'
#[test]
fn an_arc_of_two_edges_lies_halfway_between_them() {
    let cylinder = shapes::cylinder(6);
    let result = with_width(&cylinder.as_mesh(), 0.1, 4);
    let added = result.mesh.positions.iter().zip(result.vertex_sources.iter());
    let added: Vec<DVec3> =
        added.filter(|(_, source)| source.is_between()).map(|(&at, _)| wide(at)).collect();
    assert!(added.len() >= 2 * 6 * 3);
    for point in added {
        let sixths = point.x.atan2(point.z) / std::f64::consts::FRAC_PI_3;
        assert!((sixths - sixths.round()).abs() < 1e-5, "{point} at {sixths}");
    }
}

/// The triangles that an edge or a corner got.
fn triangles_of(result: &Chamfered, kind: TriangleKind, index: u32) -> Vec<[u32; 3]> {
    let source = TriangleSource { kind, index };
    let all = result.mesh.indices.chunks(3).zip(&result.triangle_sources);
    all.filter(|(_, of)| **of == source).map(|(t, _)| [t[0], t[1], t[2]]).collect()
}

fn with_width(mesh: &Mesh, width: f32, segments: u32) -> Chamfered {
    let options = Options::default().with_width(Width::Units(width)).with_segments(segments);
    let result = chamfer(mesh, &options).unwrap();
    assert_sound("rounded", mesh, &result);
    result
}

/// The vertices in the middle of fills: with one segment, those of five triangles and more that
/// are all of corners. For each the old corner, its place and its normal.
fn middles(mesh: &MeshBuffers, flat: &Chamfered) -> Vec<[DVec3; 3]> {
    let mut uses = vec![(0, 0, 0); flat.mesh.positions.len()];
    for (triangle, source) in flat.mesh.indices.chunks(3).zip(&flat.triangle_sources) {
        for &vertex in triangle {
            let (all, corners, index) = &mut uses[vertex as usize];
            *all += 1;
            if source.kind == TriangleKind::Corner {
                (*corners, *index) = (*corners + 1, source.index as usize);
            }
        }
    }
    let is_middle = |(v, (all, corners, _)): &(usize, (u32, u32, usize))| {
        *v >= mesh.positions.len() && *all >= 5 && all == corners
    };
    let place = |(v, (_, _, corner)): (usize, (u32, u32, usize))| {
        [mesh.positions[corner], flat.mesh.positions[v], flat.mesh.normals[v]].map(wide)
    };
    uses.into_iter().enumerate().filter(is_middle).map(place).collect()
}

/// How far a middle has been raised along its normal: a point of the result stands there.
fn rise(result: &Chamfered, [_, at, normal]: [DVec3; 3]) -> f64 {
    let ways = result.mesh.positions.iter().zip(&result.mesh.normals).map(|(&point, &own)| {
        let way = wide(point) - at;
        (way.reject_from(normal).length() + (wide(own) - normal).length(), way.dot(normal))
    });
    let (off, rise) = ways.min_by(|one, other| one.0.total_cmp(&other.0)).unwrap();
    assert!(off < 1e-5, "no point stands above {at}");
    rise
}

//       .-M-.       M is as high as the sphere that touches all five faces where they end
//     P'     `P
//    /         \   the flat fill has its middle between the points P
#[test]
fn the_tip_of_a_pyramid_is_on_the_sphere_that_touches_its_faces() {
    let pyramid = shapes::pyramid(5);
    let flat = with_width(&pyramid.as_mesh(), 0.05, 1);
    let [tip] = middles(&pyramid, &flat)[..] else { panic!("one corner has five edges") };
    let sources = flat.mesh.positions.iter().zip(&flat.mesh.normals);
    let is_at_tip = |(at, normal): &(&[f32; 3], &[f32; 3])| {
        (f64::from(at[1]) - tip[1].y).abs() < 1e-5 && normal[1] < 0.99
    };
    let around: Vec<[DVec3; 2]> =
        sources.filter(is_at_tip).map(|(&at, &normal)| [wide(at), wide(normal)]).collect();
    assert_eq!(around.len(), 5);
    for [point, normal] in around {
        let out = DVec3::new(point.x, 0.0, point.z).length();
        let radius = out / normal.reject_from(DVec3::Y).length();
        let centre = point - normal * radius;
        for segments in [2, 4, 7] {
            let round = with_width(&pyramid.as_mesh(), 0.05, segments);
            let top = tip[1].y + rise(&round, tip);
            assert!((top - (centre.y + radius)).abs() < 1e-5, "{top} with {segments}");
        }
    }
}

/// The same surface seen from the other side.
fn inside_out(mesh: &MeshBuffers) -> MeshBuffers {
    let mut turned = mesh.clone();
    turned.indices.chunks_mut(3).for_each(|triangle| triangle.swap(1, 2));
    turned.normals.iter_mut().flatten().for_each(|along| *along = -*along);
    turned
}

//    \_     _/    the tip of a pit is as round as that of the pyramid that fits into it
//      `-M-'
#[test]
fn a_pit_is_as_round_as_a_peak() {
    let pyramid = shapes::pyramid(5);
    let pit = inside_out(&pyramid);
    let [of_peak, of_pit] = [&pyramid, &pit].map(|mesh| {
        let flat = with_width(&mesh.as_mesh(), 0.05, 1);
        let [tip] = middles(mesh, &flat)[..] else { panic!("one corner has five edges") };
        rise(&with_width(&mesh.as_mesh(), 0.05, 4), tip)
    });
    assert!(of_peak > 0.001 && (of_peak + of_pit).abs() < 1e-5, "{of_peak} and {of_pit}");
}

// Where convex and concave edges meet, arcs to the points around may bend away from the old corner,
// or past it: the middle stays between it and the flat fill.
#[test]
fn a_middle_is_raised_no_higher_than_the_old_corner() {
    for mesh in [shapes::extruding_cubes(), inside_out(&shapes::extruding_cubes())] {
        for width in [0.1, 0.07, 0.03] {
            let half = mesh.indices.len() as u32 / 6 * 3;
            let submesh_index_counts = &[half, mesh.indices.len() as u32 - half];
            let factors = Factors { submeshes: &[1.0, 0.0], ..Factors::default() };
            let view = Mesh { factors, submesh_index_counts, ..mesh.as_mesh() };
            let flat = with_width(&view, width, 1);
            let round = with_width(&view, width, 4);
            let all = middles(&mesh, &flat);
            assert!(!all.is_empty());
            for middle in all {
                let [corner, at, normal] = middle;
                let (rise, most) = (rise(&round, middle), (corner - at).dot(normal));
                let [low, high] = [most.min(0.0) - 1e-6, most.max(0.0) + 1e-6];
                assert!((low..=high).contains(&rise), "{rise} of {most}");
            }
        }
    }
}

/// A block with a ridge that ends in the middle of its top, which is white on one side of it.
fn half_white_ridge() -> MeshBuffers {
    let mut ridge = shapes::wedge_end();
    ridge.colors = vec![[0.0; 4]; ridge.positions.len()];
    let end = ridge.positions.iter().position(|at| *at == [1.0; 3]).unwrap();
    let copy = ridge.positions.len() as u32;
    ridge.positions.push([1.0; 3]);
    ridge.normals.push(ridge.normals[end]);
    ridge.colors.push([1.0; 4]);
    for triangle in ridge.indices.chunks_mut(3) {
        let along: f32 = triangle.iter().map(|&v| ridge.positions[v as usize][2]).sum();
        if along > 3.0 {
            triangle.iter_mut().filter(|v| **v == end as u32).for_each(|v| *v = copy);
        }
    }
    ridge
}

//  4 rows |`--..__      an end that does not open is one point: of four rows each makes one triangle,
//         |___---'' a   with the corner that the strip of one segment has there
#[test]
fn a_strip_that_ends_in_a_point_is_rounded_too() {
    let ridge = half_white_ridge();
    let [flat, round] = [1, 4].map(|segments| with_width(&ridge.as_mesh(), 0.01, segments));
    let is_taper = |edge: &usize| {
        let widths = flat.verdicts[*edge].widths;
        widths.contains(&0.0) && widths != [0.0; 2]
    };
    let tapers: Vec<usize> = (0..flat.verdicts.len()).filter(is_taper).collect();
    assert!(!tapers.is_empty());
    for edge in tapers {
        let of = |result| triangles_of(result, TriangleKind::Edge, edge as u32);
        let ([one], many) = (&of(&flat)[..], of(&round)) else { panic!("one triangle") };
        assert_eq!((many.len(), round.verdicts[edge].segments), (4, 4));
        let tips = (0..3).map(|k| one[k]).filter(|v| many.iter().all(|t| t.contains(v)));
        assert_eq!(tips.count(), 1, "{one:?} and {many:?}");
    }
}

//     | z      three edges of a cube are chamfered. They meet in a fill, and end at flaps, which are
//     |__ x    flat: so each strip has 4 rows at one end and 1 at the other, and 5 triangles; the
//    / y       verdict tells the least
#[test]
fn an_end_at_a_flap_has_one_segment_and_the_other_end_keeps_its_own() {
    let cube = shapes::plain_cube(2.0);
    let is_far = |v: u32| cube.positions[v as usize] != [1.0; 3];
    let all = chamfer(&cube.as_mesh(), &Options::default()).unwrap().verdicts;
    let wanted = all.iter().filter(|edge| edge.vertices.map(is_far) != [true; 2]);
    let edges: Vec<EdgeFactor> =
        wanted.map(|edge| EdgeFactor { vertices: edge.vertices, factor: 1.0 }).collect();
    assert_eq!(edges.len(), 3);
    let factors = Factors { edges: &edges, ..Factors::default() };
    let result = with_width(&Mesh { factors, ..cube.as_mesh() }, 0.2, 4);
    let strips: Vec<usize> =
        (0..12).map(|edge| triangles_of(&result, TriangleKind::Edge, edge).len()).collect();
    let counts = |count: usize| strips.iter().filter(|&&strip| strip == count).count();
    assert_eq!([counts(5), counts(0)], [3, 9], "{strips:?}");
    for (verdict, triangles) in result.verdicts.iter().zip(strips) {
        assert_eq!(verdict.segments, u32::from(triangles == 5));
    }
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
